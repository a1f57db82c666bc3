//! The cells of a mesh where a plane cuts them, and the places of parcels in them.
//!
//! `polyMesh/owner` and `neighbour` tell which cells a face belongs to. The plane crosses edges of a cell's faces; the
//! crossings, in turn around their middle, are the corners of the cut. This holds for convex cells.
//!
//! OpenFOAM follows a parcel in a tetrahedron of a cell: its centre C, the base point B of one of
//! its faces, and two corners V, W beside each other on that face. The place is a C + b B + c V + d
//! W with a + b + c + d = 1 (`particle::position`). A face that belongs to another cell is walked
//! the other way round. The base point is the first corner of the face; on a face where that would
//! give a tetrahedron turned inside out OpenFOAM takes another one, and the place is off by up to
//! the size of the face.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::foam_file::{FoamError, FoamFile};
use super::mesh::{Faces, Mesh};
use super::parcel_lists::TetPlace;
use crate::results::gas::CutPlane;
use crate::results::surface::WallFace;

/// Faces and cells of a mesh.
pub(super) struct MeshCells {
    faces: Faces,
    /// The cell of each face, and the cell behind each face that lies between two.
    owner: Vec<usize>,
    neighbour: Vec<usize>,
    /// Number of cells.
    pub count: usize,
}

impl MeshCells {
    /// Reads a mesh.
    ///
    /// # Errors
    /// [`FoamError`].
    pub fn read(mesh: &Mesh<'_>) -> Result<Self, FoamError> {
        let faces = Faces::read(mesh)?;
        let path = mesh.path("owner");
        let owner = FoamFile::open(&path)?.labels()?;
        let neighbour = FoamFile::open(&mesh.path("neighbour"))?.labels()?;
        let most = owner.iter().chain(&neighbour).max().copied();
        // Every cell has more than one face: a damaged number must not fill the memory.
        let count = most.and_then(|most| most.checked_add(1)).filter(|count| *count <= owner.len());
        let fits = faces.count() == owner.len()
            && neighbour.len() <= owner.len()
            && faces.labels.iter().all(|label| *label < faces.points.len());
        match count {
            Some(count) if fits => Ok(Self { faces, owner, neighbour, count }),
            _ => Err(FoamError::Mesh(format!(
                "{} does not fit to points, faces and neighbour beside it",
                path.display()
            ))),
        }
    }

    /// The places of all points [m].
    pub fn points(&self) -> &[[f64; 3]] {
        &self.faces.points
    }

    /// The cells of a face.
    fn cells_of(&self, face: usize) -> impl Iterator<Item = usize> {
        [self.owner.get(face), self.neighbour.get(face)].into_iter().flatten().copied()
    }

    /// Places of parcels [m]; `None` when the mesh has no such cell or face.
    pub fn cartesian(&self, places: &[TetPlace]) -> Option<Vec<[f64; 3]>> {
        let mut faces: BTreeMap<usize, Vec<WallFace>> =
            places.iter().map(|place| (place.cell, Vec::new())).collect();
        for face in 0..self.owner.len() {
            for cell in self.cells_of(face) {
                if let Some(own) = faces.get_mut(&cell) {
                    own.extend(self.faces.outline(face).map(WallFace::new));
                }
            }
        }
        let centres: BTreeMap<usize, Vector3<f64>> =
            faces.iter().filter_map(|(cell, faces)| Some((*cell, centre(faces)?))).collect();
        let place = |place: &TetPlace| {
            let [base, left, right] = self.triangle(place)?;
            let corners = [*centres.get(&place.cell)?, base, left, right];
            let sum: Vector3<f64> = corners.iter().zip(place.weights).map(|(corner, w)| corner * w).sum();
            Some(sum.into())
        };
        places.iter().map(place).collect()
    }

    /// The corners of a tetrahedron on a face of its cell [m]: base point, and two beside each other.
    fn triangle(&self, place: &TetPlace) -> Option<[Vector3<f64>; 3]> {
        let outline = self.faces.outline(place.face).filter(|outline| outline.len() > 2)?;
        let first = place.corner % outline.len();
        let second = (first + 1) % outline.len();
        let is_own = self.owner.get(place.face) == Some(&place.cell);
        let [left, right] = if is_own { [first, second] } else { [second, first] };
        Some([0, left, right].map(|corner| outline[corner].into()))
    }

    /// The cells that a plane cuts, in their order, and the corners of each cut in the plane [m].
    pub fn cut(&self, plane: &CutPlane) -> Vec<(usize, Vec<[f64; 2]>)> {
        let mut crossings: BTreeMap<usize, BTreeMap<[usize; 2], [f64; 2]>> = BTreeMap::new();
        for face in 0..self.owner.len() {
            let Some(corners) = self.faces.corners(face) else { continue };
            let next = corners.iter().cycle().skip(1);
            for (from, to) in corners.iter().zip(next) {
                let edge = [*from.min(to), *from.max(to)];
                let Some(place) = self.crossing(edge, plane) else { continue };
                for cell in self.cells_of(face) {
                    crossings.entry(cell).or_default().insert(edge, place);
                }
            }
        }
        let outline = |places: BTreeMap<[usize; 2], [f64; 2]>| in_turn(places.into_values().collect());
        let cells = crossings.into_iter().map(|(cell, places)| (cell, outline(places)));
        let is_polygon =
            |outline: &[[f64; 2]]| outline.len() > 2 && outline.iter().flatten().all(|part| part.is_finite());
        cells.filter(|(_, outline)| is_polygon(outline)).collect()
    }

    /// Where an edge crosses a plane [m].
    fn crossing(&self, edge: [usize; 2], plane: &CutPlane) -> Option<[f64; 2]> {
        let [from, to] = edge.map(|point| &self.faces.points[point]);
        let [before, behind] = [plane.distance(from), plane.distance(to)];
        if (before < 0.0) == (behind < 0.0) {
            return None;
        }
        let share = before / (before - behind);
        let [from, to] = [plane.project(from), plane.project(to)];
        Some([0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis])))
    }
}

/// Corners of a convex polygon in turn around their middle.
fn in_turn(mut corners: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let count = corners.len().max(1) as f64;
    let middle = [0, 1].map(|axis| corners.iter().map(|corner| corner[axis]).sum::<f64>() / count);
    let angle = |corner: &[f64; 2]| (corner[1] - middle[1]).atan2(corner[0] - middle[0]);
    corners.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    corners
}

/// Centre of a cell [m] as OpenFOAM defines it: the mean of the centres of pyramids from its faces
/// to the mean of the faces' centres, by volume. `None` without faces.
fn centre(faces: &[WallFace]) -> Option<Vector3<f64>> {
    let middle = faces.iter().map(|face| face.centre).sum::<Vector3<f64>>() / faces.len() as f64;
    let (mut moment, mut volume) = (Vector3::zeros(), 0.0);
    for face in faces {
        let height = face.normal.dot(&(face.centre - middle)).abs();
        volume += height;
        moment += height * (0.75 * face.centre + 0.25 * middle);
    }
    (!faces.is_empty()).then(|| if volume > 0.0 { moment / volume } else { middle })
}
