//! Maps of the deposit on the page of an OpenFOAM case: reading of meshes and fields as OpenFOAM
//! writes them, and unrolling.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::path::Path;

use crate::report::{ours, write};
use nearwall_lab::report::openfoam_page;
use nearwall_lab::results::openfoam::{self, surfaces::read_last};
use nearwall_lab::results::surface::{
    PlaneAxis, SurfaceQuantity, Unrolled, Unrolling, WALL_GRID, WallFace, WallSurface, shapes, unroll,
};

const CLOUD: &str = "coalCloud1";
/// Sides, radius [m], and places of the rings of the pipe along x [m].
const SIDES: usize = 8;
const RADIUS: f64 = 0.5;
const RINGS: [f64; 4] = [1.0, 1.5, 2.5, 3.0];
/// Centre of the pipe in y and z [m].
const CENTRE: [f64; 2] = [2.0, -3.0];
/// Powder on each face [kg/m²], beside molten mass that differs.
const POWDER: f64 = 0.25;

/// How the files of a case are written.
#[derive(Clone, Copy)]
enum Format {
    Ascii,
    /// Bytes of a label.
    Binary(usize),
}

impl Format {
    fn header(self, class: &str) -> Vec<u8> {
        let (name, arch) = match self {
            Self::Ascii => ("ascii", String::new()),
            Self::Binary(label) => ("binary", format!("    arch \"LSB;label={};scalar=64\";\n", 8 * label)),
        };
        let head = format!(
            "/* C++ */\nFoamFile\n{{\n    version 2.0;\n    format {name};\n    class {class};\n{arch}}}\n"
        );
        format!("{head}// * * * //\n\n").into_bytes()
    }

    fn scalars(self, parts: usize, numbers: &[f64]) -> Vec<u8> {
        let mut text = format!("{}\n(", numbers.len() / parts).into_bytes();
        match self {
            Self::Binary(_) => text.extend(numbers.iter().flat_map(|number| number.to_le_bytes())),
            Self::Ascii => {
                for entry in numbers.chunks(parts) {
                    let words: Vec<String> = entry.iter().map(|number| format!("{number:e}")).collect();
                    let words = words.join(" ");
                    text.extend(
                        if parts > 1 { format!("\n({words})") } else { format!("\n{words}") }.bytes(),
                    );
                }
                text.push(b'\n');
            }
        }
        text.extend(b")\n");
        text
    }

    fn labels(self, labels: &[usize]) -> Vec<u8> {
        let mut text = format!("{}\n(", labels.len()).into_bytes();
        match self {
            Self::Ascii => text.extend(labels.iter().flat_map(|label| format!("{label} ").into_bytes())),
            Self::Binary(bytes) => {
                text.extend(labels.iter().flat_map(|label| label.to_le_bytes()[..bytes].to_vec()));
            }
        }
        text.extend(b")\n");
        text
    }

    fn faces(self, faces: &[[usize; 4]]) -> Vec<u8> {
        if let Self::Binary(_) = self {
            let starts: Vec<usize> = (0..=faces.len()).map(|face| 4 * face).collect();
            return [self.header("faceCompactList"), self.labels(&starts), self.labels(&faces.concat())]
                .concat();
        }
        let lists = faces.iter().map(|[a, b, c, d]| format!("4({a} {b} {c} {d})\n"));
        let body = format!("{}\n(\n{})\n", faces.len(), lists.collect::<String>());
        [self.header("faceList"), body.into_bytes()].concat()
    }
}

/// A patch: name, type, corners of its faces, deposit and temperature on each face.
struct Patch {
    name: &'static str,
    kind: &'static str,
    faces: Vec<[usize; 4]>,
    molten: Vec<f64>,
}

/// Points and patches of a plate of 1.5 by 0.5 m in the plane z = 0, and a pipe along x. The faces
/// of the plate have 0.5 m by 0.5 m.
fn mesh() -> (Vec<[f64; 3]>, Vec<Patch>) {
    let mut points: Vec<[f64; 3]> =
        (0..8).map(|i| [0.5 * f64::from(i % 4), 0.5 * f64::from(i / 4), 0.0]).collect();
    let plate = (0..3).map(|i| [i, i + 1, i + 5, i + 4]).collect();
    let first = points.len();
    for x in RINGS {
        points.extend((0..SIDES).map(|side| {
            let turn = TAU * side as f64 / SIDES as f64;
            [x, CENTRE[0] + RADIUS * turn.cos(), CENTRE[1] + RADIUS * turn.sin()]
        }));
    }
    let corner = |ring: usize, side: usize| first + ring * SIDES + side % SIDES;
    let face = |ring, side| {
        [corner(ring, side), corner(ring, side + 1), corner(ring + 1, side + 1), corner(ring + 1, side)]
    };
    let pipe = (0..3).flat_map(|ring| (0..SIDES).map(move |side| face(ring, side))).collect();
    let ramp = |count: usize| (1..=count).map(|face| face as f64).collect();
    let patches = vec![
        Patch { name: "outlet", kind: "patch", faces: vec![[8, 10, 12, 14]], molten: vec![0.0] },
        Patch { name: "plate", kind: "wall", faces: plate, molten: ramp(3) },
        Patch { name: "pipe", kind: "wall", faces: pipe, molten: ramp(3 * SIDES) },
    ];
    (points, patches)
}

fn write_bytes(root: &Path, name: &str, bytes: &[u8]) {
    write(root, name, "");
    std::fs::write(root.join(name), bytes).unwrap();
}

/// Writes mesh and fields of a case or of one rank.
fn write_case(root: &Path, format: Format, points: &[[f64; 3]], patches: &[Patch]) {
    let inner = [[0, 1, 5, 4]; 2];
    let faces: Vec<[usize; 4]> =
        inner.into_iter().chain(patches.iter().flat_map(|patch| patch.faces.clone())).collect();
    let points = [format.header("vectorField"), format.scalars(3, &points.concat())].concat();
    write_bytes(root, "constant/polyMesh/points", &points);
    write_bytes(root, "constant/polyMesh/faces", &format.faces(&faces));
    let mut boundary = format!("{}\n(\n", patches.len());
    let mut start = inner.len();
    for Patch { name, kind, faces, .. } in patches {
        let count = faces.len();
        let groups = if *kind == "wall" { "inGroups List<word> 1(wall);" } else { "" };
        writeln!(boundary, "{name}\n{{\n type {kind};\n {groups}\n nFaces {count};\n startFace {start};\n}}")
            .unwrap();
        start += count;
    }
    let boundary = [format.header("polyBoundaryMesh"), (boundary + ")\n").into_bytes()].concat();
    write_bytes(root, "constant/polyMesh/boundary", &boundary);
    let uniform = |value: f64| move |_: &Patch| format!("uniform {value}").into_bytes();
    let molten =
        |patch: &Patch| [b"nonuniform List<scalar> \n".to_vec(), format.scalars(1, &patch.molten)].concat();
    write_field(root, format, "moltenMass", patches, molten);
    write_field(root, format, "powderMass", patches, uniform(POWDER));
    write_field(root, format, "wallTemperature", patches, uniform(1400.0));
    // Of a case without memory: it is not shown beside the deposit.
    write_field(root, format, "depositedMass", patches, uniform(7.0));
}

/// A field as OpenFOAM writes it; the values inside, whose bytes look like brackets, have to be skipped.
fn write_field(
    root: &Path,
    format: Format,
    name: &str,
    patches: &[Patch],
    value: impl Fn(&Patch) -> Vec<u8>,
) {
    let brackets = f64::from_le_bytes(*b"{(;{(;{(");
    let mut text = format.header("volScalarField");
    text.extend(b"dimensions [1 -2 0 0 0 0 0];\n\ninternalField nonuniform List<scalar> \n");
    text.extend(format.scalars(1, &[brackets, brackets]));
    text.extend(b";\n\nboundaryField\n{\n");
    for patch in patches {
        text.extend(format!("    {}\n    {{\n        type calculated;\n        value ", patch.name).bytes());
        text.extend(value(patch));
        text.extend(b";\n    }\n");
    }
    text.extend(b"}\n\n// *** //\n");
    write_bytes(root, &format!("1/{CLOUD}:{name}"), &text);
}

/// The case of one piece.
fn whole(format: Format) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let (points, patches) = mesh();
    write_case(folder.path(), format, &points, &patches);
    folder
}

/// The case in two ranks: every second face of each patch, and a patch between them.
fn in_ranks(format: Format) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for rank in 0..2 {
        let (points, patches) = mesh();
        let mut own: Vec<Patch> = patches
            .into_iter()
            .map(|patch| Patch {
                faces: patch.faces.into_iter().skip(rank).step_by(2).collect(),
                molten: patch.molten.into_iter().skip(rank).step_by(2).collect(),
                ..patch
            })
            .collect();
        own.push(Patch { name: "between", kind: "processor", faces: vec![[0, 1, 5, 4]], molten: vec![9.0] });
        write_case(&folder.path().join(format!("processor{rank}")), format, &points, &own);
    }
    folder
}

fn read(folder: &tempfile::TempDir) -> [WallSurface; 3] {
    read_last(folder.path(), CLOUD).unwrap().try_into().unwrap()
}

/// Area of polygons by the trapezoid formula [m²].
fn drawn_area(outlines: &[Vec<[f64; 2]>]) -> f64 {
    let area = |outline: &Vec<[f64; 2]>| {
        let next = outline.iter().cycle().skip(1);
        outline.iter().zip(next).map(|(a, b)| 0.5 * (a[0] - b[0]) * (a[1] + b[1])).sum::<f64>().abs()
    };
    outlines.iter().map(area).sum()
}

/// Smallest and largest coordinate along an axis of the plane [m].
fn ends(unrolled: &Unrolled, axis: usize) -> [f64; 2] {
    let places = unrolled.outlines.iter().flatten().map(|corner| corner[axis]);
    places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

#[track_caller]
fn assert_near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-12 * (1.0 + wanted.abs()), "{found} instead of {wanted}");
}

fn deposit(wall: &WallSurface) -> &[f64] {
    &wall.quantities.iter().find(|(quantity, _)| *quantity == SurfaceQuantity::Deposit).unwrap().1
}

/// Area of the pipe, whose sides are flat [m²], and of each of its rings.
fn pipe_area() -> [f64; 4] {
    let around = SIDES as f64 * 2.0 * RADIUS * (PI / SIDES as f64).sin();
    let rings = [0, 1, 2].map(|ring| around * (RINGS[ring + 1] - RINGS[ring]));
    [rings.iter().sum(), rings[0], rings[1], rings[2]]
}

#[test]
fn a_flat_patch_is_drawn_in_its_plane_with_its_mass() {
    let [_, plate, _] = read(&whole(Format::Ascii));
    assert_eq!((plate.wall.as_str(), plate.time, plate.faces.len()), ("plate", 1.0, 3));
    let quantities: Vec<SurfaceQuantity> = plate.quantities.iter().map(|(quantity, _)| *quantity).collect();
    assert_eq!(quantities, [SurfaceQuantity::Deposit, SurfaceQuantity::Temperature]);
    assert_near(plate.area(), 0.75);
    // (1 + 2 + 3 + 3*0.25) kg/m² on faces of 0.25 m².
    let mass = 1.6875;
    assert_near(plate.integral(deposit(&plate)), mass);
    let unrolled = unroll(&plate.faces);
    assert_eq!(unrolled.how, Unrolling::Flat);
    assert_eq!(unrolled.axes, [PlaneAxis::Along([1.0, 0.0, 0.0]), PlaneAxis::Along([0.0, 1.0, 0.0])]);
    assert_eq!([ends(&unrolled, 0), ends(&unrolled, 1)], [[0.0, 1.5], [0.0, 0.5]]);
    let drawn = shapes(&plate.faces, &unrolled, deposit(&plate));
    let mass_drawn =
        drawn.iter().map(|shape| shape.value * drawn_area(std::slice::from_ref(&shape.outline))).sum();
    assert_near(mass_drawn, mass);
}

#[test]
fn a_pipe_is_unrolled_with_the_area_of_its_flat_sides() {
    let [_, _, pipe] = read(&whole(Format::Ascii));
    let [area, rings @ ..] = pipe_area();
    assert_near(pipe.area(), area);
    let unrolled = unroll(&pipe.faces);
    let Unrolling::Section(axis) = unrolled.how else { panic!("{:?}", unrolled.how) };
    assert_eq!(axis.direction, [1.0, 0.0, 0.0]);
    assert_near(axis.place[1], CENTRE[0]);
    assert_near(axis.place[2], CENTRE[1]);
    assert_near(drawn_area(&unrolled.outlines), area);
    // Around is longer than along, so it is the horizontal axis.
    assert_eq!(unrolled.axes, [PlaneAxis::Around, PlaneAxis::Along([1.0, 0.0, 0.0])]);
    assert_near(ends(&unrolled, 0)[0], 0.0);
    assert_near(ends(&unrolled, 0)[1], area / 2.0);
    assert_eq!(ends(&unrolled, 1), [1.0, 3.0]);
    // The means of 1 to 8, 9 to 16 and 17 to 24, and the powder.
    let mass = 4.5 * rings[0] + 12.5 * rings[1] + 20.5 * rings[2] + POWDER * area;
    assert_near(pipe.integral(deposit(&pipe)), mass);
    let drawn = shapes(&pipe.faces, &unrolled, deposit(&pipe));
    let each = drawn.iter().map(|shape| shape.value * drawn_area(std::slice::from_ref(&shape.outline)));
    assert_near(each.sum(), mass);
}

#[test]
fn binary_files_and_ranks_give_the_same_walls() {
    let wanted = read(&whole(Format::Ascii));
    for width in [4, 8] {
        assert_eq!(read(&whole(Format::Binary(width))), wanted, "labels of {width} bytes");
    }
    let sorted = |mut wall: WallSurface| {
        let mut order: Vec<usize> = (0..wall.faces.len()).collect();
        order.sort_by(|a, b| deposit(&wall)[*a].total_cmp(&deposit(&wall)[*b]));
        wall.faces = order.iter().map(|face| wall.faces[*face].clone()).collect();
        for (_, values) in &mut wall.quantities {
            *values = order.iter().map(|face| values[*face]).collect();
        }
        wall
    };
    for format in [Format::Ascii, Format::Binary(4)] {
        assert_eq!(read(&in_ranks(format)).map(sorted), wanted.clone().map(sorted));
    }
}

/// Faces between rings of corners that `place` gives: `columns` around or across, `rows` along.
fn patch(columns: usize, rows: usize, place: impl Fn(f64, f64) -> [f64; 3]) -> Vec<WallFace> {
    let corner = |i: usize, j: usize| place(i as f64 / columns as f64, j as f64 / rows as f64);
    let face =
        |i, j| WallFace::new(vec![corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)]);
    (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))).map(|(i, j)| face(i, j)).collect()
}

fn total_area(faces: &[WallFace]) -> f64 {
    faces.iter().map(|face| face.area).sum()
}

#[test]
fn every_form_of_wall_is_drawn_and_named() {
    let turned = |[x, y, z]: [f64; 3]| {
        let (sin, cos) = 0.5f64.sin_cos();
        [cos * x + sin * z, y, cos * z - sin * x]
    };
    // Half a pipe of 64 sides, open downwards, about an axis that is no main axis.
    let half = patch(64, 5, |i, j| turned([(PI * i).cos(), (PI * i).sin(), 9.0 * j]));
    let unrolled = unroll(&half);
    assert!(
        matches!(unrolled.how, Unrolling::Section(axis) if (axis.direction[2] - 0.5f64.cos()).abs() < 1e-9)
    );
    assert_near(drawn_area(&unrolled.outlines), total_area(&half));
    // A square duct.
    let square = |i: f64| {
        let side = (4.0 * i).floor().min(3.0);
        let way = 2.0 * (4.0 * i - side) - 1.0;
        [[1.0, way], [-way, 1.0], [-1.0, -way], [way, -1.0]][side as usize]
    };
    let duct = patch(16, 3, |i, j| [square(i)[0], square(i)[1], j]);
    let unrolled = unroll(&duct);
    assert!(matches!(unrolled.how, Unrolling::Section(_)), "{:?}", unrolled.how);
    assert_near(drawn_area(&unrolled.outlines), 8.0);
    assert_near(ends(&unrolled, 0)[1], 8.0);
    // A cone: no face keeps its width, but all of them together keep the area.
    let cone =
        patch(24, 6, |i, j| [(1.0 - 0.5 * j) * (TAU * i).cos(), (1.0 - 0.5 * j) * (TAU * i).sin(), 3.0 * j]);
    let unrolled = unroll(&cone);
    assert!(
        matches!(unrolled.how, Unrolling::Angle { radii, .. } if (radii[1] - 2.0 * radii[0]).abs() < 1e-9),
        "{:?}",
        unrolled.how
    );
    assert_near(drawn_area(&unrolled.outlines), total_area(&cone));
    // A plate that leans and is turned in its plane.
    let plate = patch(4, 3, |i, j| turned([3.0 * i - j, i + 3.0 * j, 0.0]));
    let unrolled = unroll(&plate);
    assert_eq!(unrolled.how, Unrolling::Flat);
    let sides = [0, 1].map(|axis| ends(&unrolled, axis)[1] - ends(&unrolled, axis)[0]);
    assert!(sides.iter().all(|side| (side - 10f64.sqrt()).abs() < 1e-9), "{sides:?}");
    // The corner of a box.
    let sides = [
        patch(3, 3, |i, j| [i, j, 0.0]),
        patch(3, 3, |i, j| [0.0, i, j]),
        patch(3, 3, |i, j| [i, 0.0, 2.0 * j]),
    ];
    let unrolled = unroll(&sides.concat());
    assert_eq!(unrolled.how, Unrolling::Projected);
    assert!(unrolled.axes[0] == PlaneAxis::Along([0.0, 0.0, 1.0]), "{:?}", unrolled.axes);
}

#[test]
fn a_grid_of_a_large_wall_keeps_mass_and_mean() {
    let faces = patch(97, 71, |i, j| [i + 0.3 * j, 0.4 * j + 0.1 * i * i, 0.0]);
    let unrolled = unroll(&faces);
    let values: Vec<f64> = faces.iter().map(|face| face.centre[0].powi(2)).collect();
    let cells = shapes(&faces, &unrolled, &values);
    assert!(cells.len() < WALL_GRID[0] * WALL_GRID[1], "{} cells", cells.len());
    let sum: f64 = faces.iter().zip(&values).map(|(face, value)| face.area * value).sum();
    assert_near(cells.iter().map(|cell| cell.value * cell.area).sum(), sum);
    assert_near(cells.iter().map(|cell| cell.area).sum(), total_area(&faces));
    let even = shapes(&faces, &unrolled, &vec![3.0; faces.len()]);
    even.iter().for_each(|cell| assert_near(cell.value, 3.0));
    // A cell that lies within the wall stands for just its own area.
    let full = cells
        .iter()
        .filter(|cell| (cell.area / drawn_area(std::slice::from_ref(&cell.outline)) - 1.0).abs() < 1e-9);
    assert!(full.count() > cells.len() / 2);
}

#[test]
fn the_page_has_a_map_of_what_differs_and_a_sentence_of_what_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("case");
    ours(&root);
    let (points, patches) = mesh();
    write_case(&root, Format::Ascii, &points, &patches);
    let results = openfoam::read(&root).unwrap();
    let page = openfoam_page(&results).unwrap();
    let section = page.split_once("Deposit on the walls</h2>").unwrap().1.split_once("<h2").unwrap().0;
    assert!(section.contains("Surface temperature: 1400 K everywhere."), "{section}");
    assert!(section.contains("Deposit: 0.25 kg/m² everywhere."), "{section}");
    assert!(!section.contains("Surface temperature [K]") && !section.contains("Captured mass"), "{section}");
    assert!(section.contains("Unrolled around the axis x through (0, 2, -3) m"), "{section}");
    let maps: Vec<&str> = section.split("<figure ").skip(1).collect();
    assert_eq!(maps.len(), 2);
    for (map, (faces, mass)) in maps.iter().zip([(3, "1.688 kg in all"), (24, "kg in all")]) {
        assert!(map.contains("Deposit [kg/m²]") && map.contains(mass), "{map}");
        let outlines = map.split(" d=\"").skip(1).map(|path| path.split('"').next().unwrap());
        assert_eq!(outlines.map(|path| path.matches('z').count()).sum::<usize>(), faces, "{map}");
    }
}

/// Place [m], mass [kg] and number of the regime.
type Parcel = ([f64; 3], f64, i32);

#[test]
fn regimes_are_those_of_the_parcels_on_each_face() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("case");
    ours(&root);
    let (points, patches) = mesh();
    write_case(&root, Format::Ascii, &points, &patches);
    // On the first face of the plate 3 g as NSP-SW and 1 g as SP-SW, on the second one 2 g as
    // SP-SW; 5 g on a side of the pipe, between the rings at 1.5 and 2.5 m; one parcel flies far
    // away, and one stuck at a patch that holds all.
    let turn = PI / SIDES as f64;
    let flat = RADIUS * turn.cos() - 1e-7;
    let side = [1.6, CENTRE[0] + flat * turn.cos(), CENTRE[1] + flat * turn.sin()];
    let places = [
        ([0.1, 0.1, 0.0], 3e-3, 1),
        ([0.4, 0.4, 1e-7], 1e-3, 3),
        ([0.51, 0.1, 0.0], 2e-3, 3),
        (side, 5e-3, 2),
        ([0.1, 0.1, 0.3], 7e-3, 0),
        ([0.1, 0.1, 0.0], 9e-3, -1),
    ];
    let list = |entry: &dyn Fn(&Parcel) -> String| {
        let entries: Vec<String> = places.iter().map(entry).collect();
        format!("FoamFile\n{{\n format ascii;\n}}\n// * * * //\n\n6\n(\n{}\n)\n", entries.join("\n"))
    };
    let deposit = format!("1/lagrangian/{CLOUD}Deposit");
    write(&root, &format!("{deposit}/positions"), &list(&|([x, y, z], ..)| format!("({x} {y} {z}) 0")));
    write(&root, &format!("{deposit}/d"), &list(&|_| "1e-4".to_owned()));
    write(&root, &format!("{deposit}/mass"), &list(&|(_, mass, _)| mass.to_string()));
    write(&root, &format!("{deposit}/regime"), &list(&|(.., regime)| regime.to_string()));
    let results = openfoam::read(&root).unwrap();
    let [_, plate, pipe] = &results[0].surfaces[..] else { panic!("three walls") };
    let masses =
        |wall: &WallSurface| wall.captured.as_ref().unwrap().each_ref().map(|values| wall.integral(values));
    for (found, wanted) in [(masses(plate), [0.0, 3e-3, 0.0, 3e-3]), (masses(pipe), [0.0, 0.0, 5e-3, 0.0])] {
        found.iter().zip(wanted).for_each(|(found, wanted)| assert_near(*found, wanted));
    }
    // 0.25 m² each, and the ninth face of the pipe is the first one of its second ring.
    assert_eq!(plate.captured.as_ref().unwrap()[3], [4e-3, 8e-3, 0.0]);
    assert!(pipe.captured.as_ref().unwrap()[2][SIDES] > 0.0);
    let page = openfoam_page(&results).unwrap();
    let map = page.split_once("Regime of capture</h3>").unwrap().1.split_once("</figure>").unwrap().0;
    let path = |colour: &str| map.split_once(&format!("<path fill=\"{colour}\" d=\"")).map(|(_, path)| path);
    // NSP-SW on the first face, SP-SW on the second one, nothing on the third one.
    for (colour, from) in
        [("#56b4e9", "M62.0"), ("#d55e00", "M149.3"), ("url(#surface-0-1-regime-hatch)", "M236.7")]
    {
        assert!(path(colour).unwrap().starts_with(from), "{map}");
    }
    assert!(map.contains(">NSP-SW<") && map.contains(">50.0 %<"), "{map}");
    assert!(page.contains("All parcels of the deposit cloud that lie on it were captured as SP-NSW."));
}

#[test]
fn a_fault_names_the_file_and_the_remedy() {
    let broken = |change: &dyn Fn(&Path)| {
        let folder = whole(Format::Binary(4));
        change(folder.path());
        read_last(folder.path(), CLOUD).unwrap_err().to_string()
    };
    let cut = |name: &'static str, part: f64| {
        move |root: &Path| {
            let bytes = std::fs::read(root.join(name)).unwrap();
            std::fs::write(root.join(name), &bytes[..(part * bytes.len() as f64) as usize]).unwrap();
        }
    };
    let molten = "1/coalCloud1:moltenMass";
    for (name, part) in [("constant/polyMesh/points", 0.9), ("constant/polyMesh/faces", 0.9), (molten, 0.7)] {
        let error = broken(&cut(name, part));
        assert!(error.contains(name) && error.contains("copy it again"), "{error}");
    }
    let error =
        broken(&|root| std::fs::rename(root.join(molten), root.join(format!("{molten}.gz"))).unwrap());
    assert!(error.contains("moltenMass.gz is compressed") && error.contains("gunzip"), "{error}");
    let error = broken(&|root| {
        let points = [Format::Ascii.header("vectorField"), Format::Ascii.scalars(3, &[0.0; 9])].concat();
        std::fs::write(root.join("constant/polyMesh/points"), points).unwrap();
    });
    assert!(error.contains("polyMesh/faces: faces of patch") && error.contains("copy constant"), "{error}");
    let error = broken(&|root| {
        let path = root.join("constant/polyMesh/boundary");
        let text = std::fs::read_to_string(&path).unwrap().replace("nFaces 3;", "nFaces 4;");
        std::fs::write(path, text).unwrap();
    });
    assert!(error.contains("moltenMass has 3 values for 4 faces"), "{error}");
    // Numbers that would fill the memory.
    for count in ["nFaces 99999999999999999;", "nFaces 18446744073709551615;"] {
        let error = broken(&|root| {
            let path = root.join("constant/polyMesh/boundary");
            let text = std::fs::read_to_string(&path).unwrap().replace("nFaces 3;", count);
            std::fs::write(path, text).unwrap();
        });
        assert!(error.contains("plate has more faces than"), "{error}");
    }
    // All ranks in one file.
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "processors2/1/x", "");
    let error = read_last(folder.path(), CLOUD).unwrap_err().to_string();
    assert!(error.contains("reconstructPar"), "{error}");
    // Without fields there is nothing to say.
    assert_eq!(read_last(tempfile::tempdir().unwrap().path(), CLOUD), Ok(Vec::new()));
}
