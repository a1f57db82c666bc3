//! The faces on which captured parcels lie.

use std::collections::HashMap;

use nalgebra::Vector3;

use super::{WallFace, WallSurface};
use crate::results::{Capture, range};

/// Cells along the longest side of the box around all walls.
const CELLS_ALONG: f64 = 40.0;
/// Distance from a face up to which a parcel lies on it, over the root of the face's area [1]; its
/// diameter comes on top.
const REACH_OF_FACE: f64 = 0.1;

/// Gives each wall the mass of the parcels on its faces by regime; walls without such parcels stay
/// as they are. Parcels away from all walls, or of an unknown regime, are left out.
pub(in crate::results) fn add_regimes(walls: &mut [WallSurface], captures: &[Capture]) {
    let faces = FacesByPlace::of(walls);
    let found: Vec<_> = captures
        .iter()
        .filter_map(|capture| Some((faces.nearest(walls, capture)?, capture.regime?, capture.mass)))
        .collect();
    for ((wall, face), regime, mass) in found {
        let wall = &mut walls[wall];
        let count = wall.faces.len();
        let sums = wall.captured.get_or_insert_with(|| std::array::from_fn(|_| vec![0.0; count]));
        sums[regime as usize][face] += mass / wall.faces[face].area;
    }
}

/// Index of a wall and of a face.
type FaceIndex = (usize, usize);

/// Faces by the cells of a grid that they may be near to.
struct FacesByPlace {
    low: [f64; 3],
    step: f64,
    cells: HashMap<[i64; 3], Vec<FaceIndex>>,
}

impl FacesByPlace {
    fn of(walls: &[WallSurface]) -> Self {
        let corners = || walls.iter().flat_map(|wall| &wall.faces).flat_map(|face| &face.corners);
        let ends = [0, 1, 2].map(|axis| range(corners().map(|corner| corner[axis])));
        let longest = ends.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
        let step = if longest > 0.0 && longest.is_finite() { longest / CELLS_ALONG } else { 1.0 };
        let mut faces = Self { low: ends.map(|[low, _]| low), step, cells: HashMap::new() };
        for (wall, surface) in walls.iter().enumerate() {
            for (face, shape) in surface.faces.iter().enumerate() {
                faces.add((wall, face), shape);
            }
        }
        faces
    }

    /// Adds a face to all cells that its box overlaps, and their neighbours.
    fn add(&mut self, index: FaceIndex, face: &WallFace) {
        if !face.corners.iter().flatten().all(|part| part.is_finite()) {
            return;
        }
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let [from, to] =
                range(face.corners.iter().map(|corner| corner[axis])).map(|end| self.cell(end, axis));
            from - 1..=to + 1
        });
        for x in x {
            for y in y.clone() {
                for z in z.clone() {
                    self.cells.entry([x, y, z]).or_default().push(index);
                }
            }
        }
    }

    fn cell(&self, value: f64, axis: usize) -> i64 {
        ((value - self.low[axis]) / self.step).floor() as i64
    }

    /// The face on which a parcel lies.
    fn nearest(&self, walls: &[WallSurface], capture: &Capture) -> Option<FaceIndex> {
        let place = Vector3::from(capture.position);
        let near = self.cells.get(&[0, 1, 2].map(|axis| self.cell(place[axis], axis)))?.iter();
        let near = near.map(|index| {
            let face = &walls[index.0].faces[index.1];
            (distance(face, &place), face, *index)
        });
        let (distance, face, index) = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (distance <= capture.diameter + REACH_OF_FACE * face.area.sqrt() && face.area > 0.0).then_some(index)
    }
}

/// Distance of a place from a face [m].
fn distance(face: &WallFace, place: &Vector3<f64>) -> f64 {
    let next = face.corners.iter().cycle().skip(1);
    let triangles = face.corners.iter().zip(next);
    triangles.map(|(a, b)| from_triangle([face.centre, *a, *b], place)).fold(f64::INFINITY, f64::min)
}

/// Distance of a place from a triangle [m]: from its plane where the foot is inside, else from the nearest edge.
fn from_triangle([a, b, c]: [Vector3<f64>; 3], place: &Vector3<f64>) -> f64 {
    let normal = (b - a).cross(&(c - a));
    let edges = [(a, b), (b, c), (c, a)];
    let is_inside = edges.iter().all(|(from, to)| (to - from).cross(&(place - from)).dot(&normal) >= 0.0);
    if is_inside && normal.norm() > 0.0 {
        return ((place - a).dot(&normal) / normal.norm()).abs();
    }
    let from_edge = |(from, to): &(Vector3<f64>, Vector3<f64>)| {
        let (edge, way) = (to - from, place - from);
        let square = edge.norm_squared();
        let share = if square > 0.0 { (way.dot(&edge) / square).clamp(0.0, 1.0) } else { 0.0 };
        (way - share * edge).norm()
    };
    edges.iter().map(from_edge).fold(f64::INFINITY, f64::min)
}
