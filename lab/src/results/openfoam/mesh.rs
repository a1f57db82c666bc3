//! The mesh of a case: its patches (`polyMesh/boundary`), and the outlines of its faces (`faces` and `points`).

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::foam_file::{FoamError, FoamFile, is_written};
use super::time_folders;
use crate::results::surface::WallFace;

/// The faces of a patch in the list of all faces.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Patch {
    pub name: String,
    /// The entry `type`.
    pub kind: String,
    pub start: usize,
    pub faces: usize,
}

/// The mesh of a case, or of one rank of a decomposed case, at a time.
pub(super) struct Mesh<'a> {
    /// The folder that holds `constant` and the times.
    pub root: &'a Path,
    /// Time [s].
    pub time: f64,
}

impl Mesh<'_> {
    /// A file of `polyMesh`: that of the last time that has one, up to the time of the mesh, else that of `constant`.
    pub(super) fn path(&self, name: &str) -> PathBuf {
        let times = time_folders(self.root).into_iter().rev().filter(|(time, _)| *time <= self.time);
        let moved = times.map(|(_, folder)| folder.join("polyMesh").join(name));
        let fixed = self.root.join("constant/polyMesh").join(name);
        moved.into_iter().find(|path| is_written(path)).unwrap_or(fixed)
    }

    /// The patches, without those between ranks.
    ///
    /// # Errors
    /// [`FoamError`].
    pub fn patches(&self) -> Result<Vec<Patch>, FoamError> {
        let boundary = self.path("boundary");
        let mut patches = patches_in(&boundary)?;
        patches.retain(|patch| !patch.kind.starts_with("processor"));
        // Every face takes more than a byte: a damaged number must not fill the memory.
        let path = self.path("faces");
        if !path.is_file() {
            FoamFile::open(&path)?;
        }
        let most = path.metadata().map_or(0, |data| data.len());
        let fits =
            |patch: &&Patch| patch.start.checked_add(patch.faces).is_some_and(|end| end as u64 <= most);
        match patches.iter().find(|patch| !fits(patch)) {
            Some(Patch { name, .. }) => Err(FoamError::Mesh(format!(
                "{} says that {name} has more faces than {}",
                boundary.display(),
                path.display()
            ))),
            None => Ok(patches),
        }
    }

    /// The faces of some patches, by their names.
    ///
    /// # Errors
    /// [`FoamError`].
    pub fn wall_faces(&self, patches: &[&Patch]) -> Result<BTreeMap<String, Vec<WallFace>>, FoamError> {
        let faces = Faces::read(self)?;
        let of = |patch: &&Patch| {
            let face = |face: usize| faces.outline(patch.start + face).map(WallFace::new);
            let own: Option<Vec<WallFace>> = (0..patch.faces).map(face).collect();
            let absent = || {
                FoamError::Mesh(format!(
                    "{}: faces of patch {} are absent or have corners that `points` does not have",
                    self.path("faces").display(),
                    patch.name
                ))
            };
            Ok((patch.name.clone(), own.ok_or_else(absent)?))
        };
        patches.iter().map(of).collect()
    }
}

/// The patches of a file `boundary`.
///
/// # Errors
/// [`FoamError`].
pub(super) fn patches_in(path: &Path) -> Result<Vec<Patch>, FoamError> {
    let mut file = FoamFile::open(path)?;
    let count = file.count()?;
    file.expect("(")?;
    (0..count).map(|_| patch(&mut file)).collect()
}

/// `name { type wall; nFaces 2; startFace 7; }`
fn patch(file: &mut FoamFile) -> Result<Patch, FoamError> {
    let mut patch = Patch { name: file.some_word()?, kind: String::new(), start: 0, faces: 0 };
    file.expect("{")?;
    loop {
        match file.some_word()?.as_str() {
            "}" => return Ok(patch),
            "type" => patch.kind = file.some_word()?,
            "nFaces" => patch.faces = file.count()?,
            "startFace" => patch.start = file.count()?,
            _ => {
                file.skip_value()?;
                continue;
            }
        }
        file.expect(";")?;
    }
}

/// The corners of all faces.
pub(super) struct Faces {
    /// Places of the points [m].
    pub points: Vec<[f64; 3]>,
    /// Where each face begins in `labels`, and the end of the last one.
    starts: Vec<usize>,
    /// Labels of the corners, one face after the other.
    pub labels: Vec<usize>,
}

impl Faces {
    /// Reads `points` and `faces`. In ASCII the latter is a list of lists, in binary the starts of
    /// the faces and all labels.
    ///
    /// # Errors
    /// [`FoamError`].
    pub fn read(mesh: &Mesh<'_>) -> Result<Self, FoamError> {
        let points = FoamFile::open(&mesh.path("points"))?.vectors()?;
        let mut file = FoamFile::open(&mesh.path("faces"))?;
        if file.is_binary() {
            return Ok(Self { points, starts: file.labels()?, labels: file.labels()? });
        }
        let mut faces = Self { points, starts: vec![0], labels: Vec::new() };
        let count = file.count()?;
        file.expect("(")?;
        for _ in 0..count {
            faces.labels.extend(file.labels()?);
            faces.starts.push(faces.labels.len());
        }
        Ok(faces)
    }

    /// Number of faces.
    pub fn count(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Labels of the corners of a face.
    pub fn corners(&self, face: usize) -> Option<&[usize]> {
        self.labels.get(*self.starts.get(face)?..*self.starts.get(face + 1)?)
    }

    /// Corners of a face in turn [m]; `None` without such a face or corner.
    pub fn outline(&self, face: usize) -> Option<Vec<[f64; 3]>> {
        self.corners(face)?.iter().map(|point| self.points.get(*point).copied()).collect()
    }
}
