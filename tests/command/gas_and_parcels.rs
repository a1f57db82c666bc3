//! The picture of gas and parcels on the page of an OpenFOAM case, from files that OpenFOAM wrote:
//! `tests/data/gas_with_parcels`.

use std::path::{Path, PathBuf};

use crate::report::{ours, write};
use nearwall_lab::report::openfoam_page;
use nearwall_lab::results::MapCell;
use nearwall_lab::results::gas::{GasCut, GasQuantity, ParcelQuantity};
use nearwall_lab::results::openfoam::{self, gas::read_last};

const CLOUD: &str = "kinematicCloud";
/// The places of the injection [m].
const PLACES: [[f64; 3]; 5] =
    [[0.5, 0.1, 0.2], [1.9, 0.26, 0.05], [1.2, 0.249, 0.9], [0.6, 0.24, 0.3], [1.5, 0.45, 0.55]];
/// Parcels of a coal cloud that nearWallInteraction v1912 captured and recorded in the step that
/// ended with the write of these numbers: diameter [m], density [kg/m³], mass at injection [kg],
/// `YC(s)`, and the recorded conversion. They burn on until the end of the step.
const CAPTURED: [([f64; 4], f64); 6] = [
    ([1.4701311077e-4, 614.4774963, 2.1627692012e-9, 0.7969006176], 0.2519964722),
    ([1.2525348598e-4, 628.3887472, 1.3375543552e-9, 0.8013968331], 0.2296589986),
    ([1.6077345503e-4, 732.1352557, 2.828687747e-9, 0.8295396936], 0.0726677461),
    ([1.9167985967e-4, 667.3322123, 4.7937063076e-9, 0.8129866988], 0.1717471626),
    ([4.8557932495e-5, 124.8, 7.7933204773e-11, 0.0], 1.0),
    ([7.1773236329e-5, 484.6293888, 2.5166890703e-10, 0.7424836321], 0.4491994235),
];

fn written(format: &str) -> PathBuf {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/..")).join("tests/data/gas_with_parcels").join(format)
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copy(&path, &target);
        } else {
            std::fs::copy(path, target).unwrap();
        }
    }
}

/// A copy that may be changed.
fn copied(format: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    copy(&written(format), folder.path());
    folder
}

fn read(folder: &Path) -> GasCut {
    read_last(folder, CLOUD).unwrap().unwrap()
}

#[track_caller]
fn assert_places(gas: &GasCut, tolerance: f64) {
    assert_eq!(gas.parcels.len(), PLACES.len());
    for (parcel, wanted) in gas.parcels.iter().zip(PLACES) {
        let off = parcel.position.iter().zip(wanted).map(|(found, wanted)| (found - wanted).abs());
        assert!(off.fold(0.0, f64::max) < tolerance, "{:?} instead of {wanted:?}", parcel.position);
    }
}

#[test]
fn the_cut_has_the_area_of_the_section_and_the_parcels_their_places() {
    for format in ["ascii", "binary"] {
        let gas = read(&written(format));
        assert_eq!((gas.time, gas.quantity, gas.coloured_by), (0.1, GasQuantity::Speed, None));
        assert_eq!(gas.plane.words(), "y = 0.25 m");
        // The two layers of cells along y meet in the middle: the plane, a bit off it, cuts one of them.
        assert_eq!((gas.cells.len(), gas.is_flat), (6, false));
        assert!((gas.area() - 1.7).abs() < 1e-6, "{}", gas.area());
        assert!(gas.cells.iter().all(|cell| (cell.value - 5.0).abs() < 1e-12));
        assert_places(&gas, 1e-9);
        // Those within 0.025 m of y = 0.25 m.
        let shown = gas.shown().into_iter().map(|(place, _)| place.map(|part| (1e3 * part).round()));
        assert_eq!(shown.collect::<Vec<_>>(), [[1900.0, 50.0], [1200.0, 900.0], [600.0, 300.0]]);
    }
}

/// Each cell has its own temperature: blockMesh numbers three cells along x, then two along y, then two along z.
#[test]
fn every_cell_has_its_own_value() {
    let folder = copied("ascii");
    let value = |x: usize, z: usize| 300.0 + (x + 6 * z) as f64 + 3.0;
    let values: Vec<String> = (0..12).map(|cell| format!("{}", 300 + cell)).collect();
    let field = format!(
        "FoamFile\n{{\n    format ascii;\n    class volScalarField;\n}}\ndimensions [0 0 0 1 0 0 0];\n\
         internalField nonuniform List<scalar>\n12\n(\n{}\n);\nboundaryField {{}}\n",
        values.join("\n")
    );
    write(folder.path(), "0.1/T", &field);
    let gas = read(folder.path());
    assert_eq!((gas.quantity, gas.cells.len()), (GasQuantity::Temperature, 6));
    let middle = |outline: &[[f64; 2]], axis: usize| {
        outline.iter().map(|corner| corner[axis]).sum::<f64>() / outline.len() as f64
    };
    for z in [0, 1] {
        let in_row = |cell: &&MapCell| (middle(&cell.outline, 1) > 0.5) == (z == 1);
        let mut row: Vec<&MapCell> = gas.cells.iter().filter(in_row).collect();
        row.sort_by(|a, b| middle(&a.outline, 0).total_cmp(&middle(&b.outline, 0)));
        let found: Vec<f64> = row.iter().map(|cell| cell.value).collect();
        assert_eq!(found, [0, 1, 2].map(|x| value(x, z)));
    }
}

/// The Foundation's OpenFOAM writes only barycentric coordinates, as `positions`; others only as `coordinates`.
#[test]
fn barycentric_coordinates_give_the_same_places() {
    for format in ["ascii", "binary"] {
        let folder = copied(format);
        let cloud = folder.path().join("0.1/lagrangian").join(CLOUD);
        std::fs::remove_file(cloud.join("positions")).unwrap();
        assert_places(&read(folder.path()), 2e-9);
        std::fs::rename(cloud.join("coordinates"), cloud.join("positions")).unwrap();
        assert_places(&read(folder.path()), 2e-9);
    }
}

#[test]
fn ranks_give_the_same_cut() {
    let folder = tempfile::tempdir().unwrap();
    copy(&written("ascii"), &folder.path().join("processor0"));
    // The second rank has no parcels.
    copy(&written("ascii"), &folder.path().join("processor1"));
    std::fs::remove_dir_all(folder.path().join("processor1/0.1/lagrangian")).unwrap();
    let gas = read(folder.path());
    assert!((gas.area() - 3.4).abs() < 1e-6);
    assert_places(&gas, 1e-9);
}

/// Adds what a coal cloud writes to the five parcels.
fn add_coal(root: &Path, parcels: &[([f64; 4], f64)]) {
    let list = |column: usize| {
        let values: Vec<String> = parcels.iter().map(|(values, _)| format!("{:e}", values[column])).collect();
        format!(
            "FoamFile\n{{\n    format ascii;\n}}\n// * * * * //\n\n{}\n(\n{}\n)\n",
            values.len(),
            values.join("\n")
        )
    };
    for (column, name) in ["d", "rho", "mass0", "YC(s)"].into_iter().enumerate() {
        write(root, &format!("0.1/lagrangian/{CLOUD}/{name}"), &list(column));
    }
    write(
        root,
        &format!("constant/{CLOUD}Properties"),
        "singleMixtureFractionCoeffs { phases ( gas { CO 1; } liquid { H2O 1; } solid { C 0.84; ash 0.16; } );\n\
         YGasTot0 0.4; YLiquidTot0 0; YSolidTot0 0.6; }",
    );
}

#[test]
fn conversions_are_those_that_the_wall_model_recorded() {
    for parcels in CAPTURED.chunks(5).chain([&CAPTURED[1..]]) {
        let folder = copied("ascii");
        let padded: Vec<_> = parcels.iter().cycle().take(PLACES.len()).copied().collect();
        add_coal(folder.path(), &padded);
        let gas = read(folder.path());
        assert_eq!(gas.coloured_by, Some(ParcelQuantity::Conversion));
        for (parcel, (_, recorded)) in gas.parcels.iter().zip(&padded) {
            let later = parcel.value - recorded;
            assert!((-1e-9..2e-3).contains(&later), "{} instead of {recorded}", parcel.value);
        }
    }
}

#[test]
fn the_page_shows_gas_and_parcels() {
    let folder = copied("ascii");
    let root = folder.path().join("case");
    ours(&root);
    std::fs::remove_dir_all(root.join("1")).unwrap();
    copy(&written("ascii"), &root);
    add_coal(&root, &CAPTURED[..5]);
    let at = |name: &str| root.join(name.replace("CLOUD", CLOUD));
    std::fs::rename(at("0.1/lagrangian/CLOUD"), root.join("0.1/lagrangian/coalCloud1")).unwrap();
    std::fs::rename(at("constant/CLOUDProperties"), root.join("constant/coalCloud1Properties")).unwrap();
    let results = openfoam::read(&root).unwrap();
    let page = openfoam_page(&results).unwrap();
    let section = page.split_once("Gas and parcels</h2>").unwrap().1.split_once("<h2").unwrap().0;
    assert!(section.contains("Time 0.1 s, cut along y = 0.25 m."), "{section}");
    assert!(
        section.contains("3 of the 5 parcels of the cloud in flight: those within 0.025 m of the plane."),
        "{section}"
    );
    assert!(section.contains("gas speed [m/s]") && section.contains("carbon conversion [1]"), "{section}");
    assert!(section.contains(">x [m]<") && section.contains(">z [m]<"), "{section}");
    let paths = section.split("<path stroke=\"#").skip(1).filter(|path| !path.starts_with("000000")); // no outlines
    let dots: usize = paths.map(|path| path.matches("h0").count()).sum();
    assert_eq!(dots, 3, "{section}");
}

/// `MPPICFoam` names the velocity of the gas after its phase.
#[test]
fn the_gas_may_have_the_name_of_its_phase() {
    let folder = copied("ascii");
    std::fs::rename(folder.path().join("0.1/U"), folder.path().join("0.1/U.air")).unwrap();
    let gas = read(folder.path());
    assert_eq!(gas.quantity, GasQuantity::Speed);
    assert!(gas.cells.iter().all(|cell| (cell.value - 5.0).abs() < 1e-12));
    std::fs::remove_file(folder.path().join("0.1/U.air")).unwrap();
    let error = read_last(folder.path(), CLOUD).unwrap_err().to_string();
    assert!(error.contains("0.1") && error.contains("neither T nor U of the gas"), "{error}");
}

#[test]
fn a_fault_names_the_file_and_a_case_without_gas_has_no_picture() {
    let broken = |name: &str, change: &dyn Fn(&Path)| {
        let folder = copied("ascii");
        change(&folder.path().join(name));
        read_last(folder.path(), CLOUD)
    };
    let cut = |path: &Path| {
        let bytes = std::fs::read(path).unwrap();
        std::fs::write(path, &bytes[..bytes.len() * 7 / 10]).unwrap();
    };
    for name in ["points", "faces", "owner", "neighbour"] {
        let error = broken(&format!("constant/polyMesh/{name}"), &cut).unwrap_err().to_string();
        assert!(error.contains(name) && error.contains("no picture of gas and parcels"), "{error}");
    }
    let swap = |path: &Path| {
        let text = std::fs::read_to_string(path)
            .unwrap()
            .replace("uniform (3 4 0)", "nonuniform List<vector> 1((3 4 0))");
        std::fs::write(path, text).unwrap();
    };
    let error = broken("0.1/U", &swap).unwrap_err().to_string();
    assert!(error.contains("U has 1 values for 12 cells"), "{error}");
    let zip = |path: &Path| std::fs::rename(path, format!("{}.gz", path.display())).unwrap();
    let error = broken("0.1/U", &zip).unwrap_err().to_string();
    assert!(error.contains("U.gz is compressed") && error.contains("gunzip"), "{error}");
    let far = |path: &Path| {
        let text = std::fs::read_to_string(path).unwrap().replace("\n11\n", "\n99999999999\n");
        std::fs::write(path, text).unwrap();
    };
    let error = broken("constant/polyMesh/owner", &far).unwrap_err().to_string();
    assert!(error.contains("owner does not fit"), "{error}");
    let error = broken("0.1/lagrangian/kinematicCloud/positions", &zip).unwrap_err().to_string();
    assert!(error.contains("positions is absent, compressed") && error.contains("gunzip"), "{error}");
    let remove = |path: &Path| std::fs::remove_file(path).unwrap();
    assert_eq!(broken("constant/polyMesh/owner", &remove), Ok(None));
    assert_eq!(read_last(tempfile::tempdir().unwrap().path(), CLOUD), Ok(None));
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "processors2/1/x", "");
    assert!(read_last(folder.path(), CLOUD).unwrap_err().to_string().contains("reconstructPar"));
}
