//! Places of parcels [m] from their coordinates within tetrahedra of the cells.
//!
//! OpenFOAM follows a parcel in a tetrahedron of a cell: its centre C, the base point B of one of its faces, and two corners V, W
//! beside each other on that face. The place is a C + b B + c V + d W with a + b + c + d = 1 (`particle::position`). A face that
//! belongs to another cell is walked the other way round. The base point is the first corner of the face; on a face where that
//! would give a tetrahedron turned inside out OpenFOAM takes another one, and the place is off by up to the size of the face.

use std::collections::BTreeMap;

use super::cells::Cells;
use super::list_file::TetPlace;
use crate::results::surface::WallFace;

/// Places of parcels [m].
///
/// # Errors
/// When the mesh has no such cell or face.
pub(super) fn cartesian(cells: &Cells, places: &[TetPlace]) -> Result<Vec<[f64; 3]>, String> {
    let mut centres = BTreeMap::new();
    for (cell, faces) in cells.faces_of(places.iter().map(|place| place.cell)) {
        centres.insert(cell, centre(cells, &faces));
    }
    let place = |place: &TetPlace| {
        let corners: Vec<[f64; 3]> =
            [[*centres.get(&place.cell)?].as_slice(), &cells.triangle(place)?].concat();
        Some([0, 1, 2].map(|axis| {
            corners.iter().zip(place.weights).map(|(corner, weight)| weight * corner[axis]).sum()
        }))
    };
    let all: Option<Vec<[f64; 3]>> = places.iter().map(place).collect();
    all.ok_or_else(|| "the parcels are in cells that the mesh does not have".to_owned())
}

/// Centre of a cell [m] as OpenFOAM defines it: the mean of the centres of pyramids from its faces to the mean of the faces'
/// centres, by volume.
fn centre(cells: &Cells, faces: &[usize]) -> [f64; 3] {
    let faces: Vec<WallFace> =
        faces.iter().filter_map(|face| Some(WallFace::new(cells.outline(*face)?))).collect();
    let count = faces.len().max(1) as f64;
    let middle: [f64; 3] =
        std::array::from_fn(|axis| faces.iter().map(|face| face.centre[axis]).sum::<f64>() / count);
    let (mut moment, mut volume) = ([0.0; 3], 0.0);
    for face in &faces {
        let height: f64 = (0..3).map(|axis| face.normal[axis] * (face.centre[axis] - middle[axis])).sum();
        volume += height.abs();
        for axis in 0..3 {
            moment[axis] += height.abs() * (0.75 * face.centre[axis] + 0.25 * middle[axis]);
        }
    }
    if volume > 0.0 { moment.map(|sum| sum / volume) } else { middle }
}
