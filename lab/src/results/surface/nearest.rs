//! The faces on which captured parcels lie.

use std::collections::HashMap;

use super::axis::{cross, dot, from_to, length};
use super::{WallFace, WallSurface};
use crate::results::Capture;

/// Cells along the longest side of the box around all walls.
const CELLS: f64 = 40.0;
/// Distance from a face up to which a parcel lies on it, over the root of the face's area [1]; its diameter comes on top.
const REACH: f64 = 0.1;

/// Gives each wall the mass of the parcels on its faces by regime; walls without such parcels stay as they are. Parcels away
/// from all walls, or of an unknown regime, are left out.
pub(in crate::results) fn add_regimes(walls: &mut [WallSurface], captures: &[Capture]) {
    let known = captures.iter().filter_map(|capture| Some((capture, capture.regime?)));
    let places = Places::of(walls);
    let mut found = Vec::new();
    for (capture, regime) in known {
        if let Some(face) = places.nearest(walls, capture) {
            found.push((face, regime, capture.mass));
        }
    }
    for ((wall, face), regime, mass) in found {
        let wall = &mut walls[wall];
        let count = wall.faces.len();
        let sums = wall.captured.get_or_insert_with(|| std::array::from_fn(|_| vec![0.0; count]));
        sums[regime as usize][face] += mass / wall.faces[face].area;
    }
}

/// Wall and face.
type Place = (usize, usize);

/// Faces by the cells of a grid that they may be near to.
struct Places {
    low: [f64; 3],
    step: f64,
    cells: HashMap<[i64; 3], Vec<Place>>,
}

impl Places {
    fn of(walls: &[WallSurface]) -> Self {
        let corners = || walls.iter().flat_map(|wall| &wall.faces).flat_map(|face| &face.corners);
        let end = |axis: usize, start: f64, pick: fn(f64, f64) -> f64| {
            corners().map(|corner| corner[axis]).fold(start, pick)
        };
        let low = [0, 1, 2].map(|axis| end(axis, f64::INFINITY, f64::min));
        let sides = [0, 1, 2].map(|axis| end(axis, f64::NEG_INFINITY, f64::max) - low[axis]);
        let longest = sides.into_iter().fold(0.0, f64::max);
        let step = if longest > 0.0 && longest.is_finite() { longest / CELLS } else { 1.0 };
        let mut places = Self { low, step, cells: HashMap::new() };
        for (wall, surface) in walls.iter().enumerate() {
            for (face, area) in surface.faces.iter().enumerate() {
                places.add((wall, face), area);
            }
        }
        places
    }

    /// Adds a face to all cells that its box overlaps, and their neighbours.
    fn add(&mut self, place: Place, face: &WallFace) {
        if !face.corners.iter().flatten().all(|part| part.is_finite()) {
            return;
        }
        let end = |axis: usize, start: f64, pick: fn(f64, f64) -> f64| {
            self.cell(face.corners.iter().map(|corner| corner[axis]).fold(start, pick), axis)
        };
        let from = [0, 1, 2].map(|axis| end(axis, f64::INFINITY, f64::min) - 1);
        let to = [0, 1, 2].map(|axis| end(axis, f64::NEG_INFINITY, f64::max) + 1);
        for x in from[0]..=to[0] {
            for y in from[1]..=to[1] {
                for z in from[2]..=to[2] {
                    self.cells.entry([x, y, z]).or_default().push(place);
                }
            }
        }
    }

    fn cell(&self, value: f64, axis: usize) -> i64 {
        ((value - self.low[axis]) / self.step).floor() as i64
    }

    /// The face on which a parcel lies.
    fn nearest(&self, walls: &[WallSurface], capture: &Capture) -> Option<Place> {
        let cell = [0, 1, 2].map(|axis| self.cell(capture.position[axis], axis));
        let near = self.cells.get(&cell)?.iter().map(|(wall, face)| {
            let surface = &walls[*wall].faces[*face];
            (distance(surface, &capture.position), surface, (*wall, *face))
        });
        let (distance, face, place) = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (distance <= capture.diameter + REACH * face.area.sqrt() && face.area > 0.0).then_some(place)
    }
}

/// Distance of a place from a face [m].
fn distance(face: &WallFace, place: &[f64; 3]) -> f64 {
    let next = face.corners.iter().cycle().skip(1);
    let triangles = face.corners.iter().zip(next);
    triangles.map(|(a, b)| from_triangle([&face.centre, a, b], place)).fold(f64::INFINITY, f64::min)
}

/// Distance of a place from a triangle [m]: from its plane where the foot is inside, else from the nearest edge.
fn from_triangle(triangle: [&[f64; 3]; 3], place: &[f64; 3]) -> f64 {
    let [a, b, c] = triangle;
    let normal = cross(from_to(a, b), from_to(a, c));
    let edges = [(a, b), (b, c), (c, a)];
    let is_inside =
        edges.iter().all(|(from, to)| dot(cross(from_to(from, to), from_to(from, place)), normal) >= 0.0);
    if is_inside && length(normal) > 0.0 {
        return (dot(from_to(a, place), normal) / length(normal)).abs();
    }
    edges.iter().map(|(from, to)| from_edge(from, to, place)).fold(f64::INFINITY, f64::min)
}

/// Distance of a place from a line between two others [m].
fn from_edge(from: &[f64; 3], to: &[f64; 3], place: &[f64; 3]) -> f64 {
    let (edge, way) = (from_to(from, to), from_to(from, place));
    let square = dot(edge, edge);
    let share = if square > 0.0 { (dot(way, edge) / square).clamp(0.0, 1.0) } else { 0.0 };
    length(std::array::from_fn(|i| way[i] - share * edge[i]))
}
