//! The cells of a mesh where a plane cuts them.
//!
//! `polyMesh/owner` and `neighbour` tell which cells a face belongs to. The plane crosses edges of a cell's faces; the crossings,
//! in turn around their middle, are the corners of the cut. This holds for convex cells.

use std::collections::BTreeMap;

use super::foam_file::{Entries, FoamFile};
use super::list_file::TetPlace;
use super::mesh::{Faces, Mesh};
use crate::results::gas::Plane;

/// Points, faces and cells of a mesh.
pub(super) struct Cells {
    /// Places of the points [m].
    points: Vec<[f64; 3]>,
    faces: Faces,
    /// The cell of each face, and the cell behind each face that lies between two.
    owner: Vec<usize>,
    neighbour: Vec<usize>,
    /// Number of cells.
    pub count: usize,
}

impl Cells {
    /// Reads a mesh.
    ///
    /// # Errors
    /// File, fault and remedy.
    pub fn read(mesh: &Mesh<'_>) -> Result<Self, String> {
        let mut file = FoamFile::open(&mesh.path("points"))?;
        let points = file.list(Entries::Scalars(3))?.all(0).unwrap_or_default();
        let points: Vec<[f64; 3]> =
            points.chunks_exact(3).map(|place| [place[0], place[1], place[2]]).collect();
        let faces = Faces::open(&mesh.path("faces"))?;
        let owner_path = mesh.path("owner");
        let mut owner_file = FoamFile::open(&owner_path)?;
        let owner = owner_file.labels()?;
        let neighbour = FoamFile::open(&mesh.path("neighbour"))?.labels()?;
        let most = owner.iter().chain(&neighbour).max().copied();
        // Every cell has more than one face: a damaged number must not fill the memory.
        let count = most.and_then(|most| most.checked_add(1)).filter(|count| *count <= owner.len());
        let fits = faces.count() == owner.len()
            && neighbour.len() <= owner.len()
            && faces.all_labels().iter().all(|label| *label < points.len());
        match count {
            Some(count) if fits => Ok(Self { points, faces, owner, neighbour, count }),
            _ => Err(format!(
                "{} does not fit to points, faces and neighbour beside it; copy constant/polyMesh again from where the case ran",
                owner_path.display()
            )),
        }
    }

    /// Widens the ends of a box along each axis [m] to hold all points.
    pub fn widen(&self, ends: &mut [[f64; 2]; 3]) {
        for point in &self.points {
            for (end, place) in ends.iter_mut().zip(point) {
                *end = [end[0].min(*place), end[1].max(*place)];
            }
        }
    }

    /// Corners of a face in turn [m]; `None` without such a face.
    pub fn outline(&self, face: usize) -> Option<Vec<[f64; 3]>> {
        Some(self.faces.corners(face)?.iter().map(|point| self.points[*point]).collect())
    }

    /// The faces of some cells.
    pub fn faces_of(&self, cells: impl Iterator<Item = usize>) -> BTreeMap<usize, Vec<usize>> {
        let mut faces: BTreeMap<usize, Vec<usize>> = cells.map(|cell| (cell, Vec::new())).collect();
        for (face, owner) in self.owner.iter().enumerate() {
            for cell in [Some(owner), self.neighbour.get(face)].into_iter().flatten() {
                if let Some(own) = faces.get_mut(cell) {
                    own.push(face);
                }
            }
        }
        faces.retain(|_, own| !own.is_empty());
        faces
    }

    /// The corners of a tetrahedron on a face of its cell [m]: base point, and two beside each other.
    pub fn triangle(&self, place: &TetPlace) -> Option<[[f64; 3]; 3]> {
        let outline = self.outline(place.face).filter(|outline| outline.len() > 2)?;
        let first = place.corner % outline.len();
        let second = (first + 1) % outline.len();
        let is_own = self.owner.get(place.face) == Some(&place.cell);
        let [left, right] = if is_own { [first, second] } else { [second, first] };
        Some([outline[0], outline[left], outline[right]])
    }

    /// The cells that a plane cuts, in their order, and the corners of each cut in the plane [m].
    pub fn cut(&self, plane: &Plane) -> Vec<(usize, Vec<[f64; 2]>)> {
        let mut crossings: BTreeMap<usize, BTreeMap<[usize; 2], [f64; 2]>> = BTreeMap::new();
        for (face, owner) in self.owner.iter().enumerate() {
            let Some(corners) = self.faces.corners(face) else { continue };
            let next = corners.iter().cycle().skip(1);
            for (from, to) in corners.iter().zip(next) {
                let edge = [*from.min(to), *from.max(to)];
                let Some(place) = self.crossing(edge, plane) else { continue };
                for cell in [Some(owner), self.neighbour.get(face)].into_iter().flatten() {
                    crossings.entry(*cell).or_default().insert(edge, place);
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
    fn crossing(&self, edge: [usize; 2], plane: &Plane) -> Option<[f64; 2]> {
        let [from, to] = edge.map(|point| &self.points[point]);
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
