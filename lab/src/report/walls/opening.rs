//! The picture at the top of the page: the walls of a case as seen from outside, with their deposit.
//!
//! Walls that turn their back to the viewer are left out, so that the inner sides of the others are seen, as in a box
//! without its front. What lies behind is drawn first.

use nalgebra::Vector3;

use super::surfaces::scale_ends;
use super::{RunComparison, number};
use crate::report::Figure;
use crate::report::chart::{COLUMN_WIDTH, ColourScale, PlanePicture, text_at};
use crate::report::format::{duration, with_unit};
use crate::results::surface::{SurfaceQuantity, WallFace, WallSurface};
use crate::results::{MapCell, RunResults, extent};

/// Direction in which the viewer looks.
const VIEW: [f64; 3] = [-0.55, 0.65, -0.52];
/// Most faces that are drawn.
const MOST_FACES: usize = 8000;
/// Largest width and height of the plot, and least size of the drawing [px].
const MOST: [f64; 2] = [330.0, 300.0];
const LEAST: [f64; 2] = [480.0, 220.0];
/// Length of the arrows that show the axes, as a share of the picture's extent [1].
const ARROW: f64 = 0.08;

/// One picture for each run with a deposit.
pub(super) fn figures(comparison: &RunComparison<'_>) -> Vec<Figure> {
    let figure = |(place, (label, run)): (usize, (&String, &RunResults))| {
        let title = if comparison.is_single() {
            "The walls and what lies on them".to_owned()
        } else {
            format!("The walls of {label} and what lies on them")
        };
        picture(run, &format!("opening-{place}"), &title)
    };
    comparison.each().enumerate().filter_map(figure).collect()
}

/// The deposit of a wall, or what it captured where it keeps no deposit.
fn lying(wall: &WallSurface) -> Option<(SurfaceQuantity, &Vec<f64>)> {
    let wanted = [SurfaceQuantity::Deposit, SurfaceQuantity::Captured];
    let found =
        wanted.iter().find_map(|wanted| wall.quantities.iter().find(|(quantity, _)| quantity == wanted));
    found.map(|(quantity, values)| (*quantity, values))
}

fn picture(run: &RunResults, id: &str, title: &str) -> Option<Figure> {
    let view = View::new();
    let walls = run.surfaces.iter().filter_map(|wall| Some((wall, lying(wall)?)));
    let walls: Vec<(&WallSurface, (SurfaceQuantity, &Vec<f64>))> = walls.collect();
    let quantity = walls.first()?.1.0;
    let faces = walls.iter().flat_map(|(wall, (_, values))| wall.faces.iter().zip(values.iter().copied()));
    let mut seen: Vec<(&WallFace, f64)> = faces.filter(|(face, _)| view.sees(face)).collect();
    if seen.is_empty() || seen.len() > MOST_FACES || seen.iter().all(|(_, value)| *value == 0.0) {
        return None;
    }
    seen.sort_by(|(a, _), (b, _)| view.depth(&b.centre).total_cmp(&view.depth(&a.centre)));
    let cells: Vec<MapCell> = seen.iter().map(|(face, value)| view.cell(face, *value)).collect();
    let ends = extent(&cells)?;
    let [low, high] = scale_ends(quantity, &cells);
    let scale = ColourScale::new(low, high);
    let [width, height] = ends.map(|[low, high]| high - low);
    let factor = (MOST[0] / width).min(MOST[1] / height);
    let mut picture = PlanePicture::new([id, title], ends, [factor * width, factor * height]);
    let fills: Vec<String> = cells.iter().map(|cell| scale.colour_or_grey(cell.value)).collect();
    picture.stacked_cells(&cells, &fills);
    let label = format!("{} [{}]", quantity.name(), quantity.unit());
    picture.bar(&scale, &label, 0, (factor * height).clamp(150.0, 260.0));
    picture.add(&view.arrows(picture.below()));
    let used = picture.beside()[0] + COLUMN_WIDTH;
    let size = [used.max(LEAST[0]), (picture.below()[1] + 24.0).max(LEAST[1])];
    Some(picture.figure(&caption(&walls), size, used))
}

/// Time, sizes, and the mass on each wall.
fn caption(walls: &[(&WallSurface, (SurfaceQuantity, &Vec<f64>))]) -> String {
    let corners = || walls.iter().flat_map(|(wall, _)| &wall.faces).flat_map(|face| &face.corners);
    let size = [0, 1, 2].map(|axis| {
        let [low, high] = crate::results::range(corners().map(|corner| corner[axis]));
        number(high - low)
    });
    let masses = walls
        .iter()
        .map(|(wall, (_, values))| format!("{} {}", wall.wall, with_unit(wall.integral(values), "kg")));
    format!(
        "Seen from outside through the walls in front, at {}; the walls extend over {} m along x, y and z. On them: \
            {}.",
        duration(walls[0].0.time),
        size.join(" × "),
        masses.collect::<Vec<_>>().join(", ")
    )
}

/// A parallel projection: right, up and away from the viewer.
struct View([Vector3<f64>; 3]);

impl View {
    fn new() -> Self {
        let away = Vector3::from(VIEW).normalize();
        let right = away.cross(&Vector3::z()).normalize();
        Self([right, right.cross(&away), away])
    }

    fn plane(&self, place: &Vector3<f64>) -> [f64; 2] {
        [self.0[0].dot(place), self.0[1].dot(place)]
    }

    fn depth(&self, place: &Vector3<f64>) -> f64 {
        self.0[2].dot(place)
    }

    /// Is the side of a wall's face that the gas touches seen? Its normal points out of the gas.
    fn sees(&self, face: &WallFace) -> bool {
        self.depth(&face.normal) > 1e-6 * face.area
    }

    fn cell(&self, face: &WallFace, value: f64) -> MapCell {
        let outline = face.corners.iter().map(|corner| self.plane(corner)).collect();
        MapCell { outline, area: face.area, value }
    }

    /// The three axes as lines with their names, from a place in the drawing [px].
    fn arrows(&self, [left, below]: [f64; 2]) -> String {
        let length = ARROW * MOST[1];
        let arrow = |(axis, name): (Vector3<f64>, &str)| {
            let [right, up] = self.plane(&axis).map(|part| length * part);
            let [x, y] = [left - 20.0, below - 10.0];
            let text = text_at([x + 1.35 * right, y - 1.35 * up + 4.0], "middle", name);
            format!("<path stroke=\"black\" d=\"M{x:.1} {y:.1}l{right:.1} {:.1}\"/>{text}", -up)
        };
        [(Vector3::x(), "x"), (Vector3::y(), "y"), (Vector3::z(), "z")].into_iter().map(arrow).collect()
    }
}
