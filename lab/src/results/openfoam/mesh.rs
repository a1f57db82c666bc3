//! The patches of a mesh: `polyMesh/boundary`, and the outlines of their faces from `faces` and `points`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::foam_file::{Entries, FoamFile, is_written};
use super::time_folders;

/// The faces of a patch in the list of all faces.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Patch {
    pub name: String,
    /// The entry `type`.
    pub kind: String,
    pub start: usize,
    pub faces: usize,
}

/// The corners of a face [m].
pub(super) type Outline = Vec<[f64; 3]>;

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
    /// File, fault and remedy.
    pub fn patches(&self) -> Result<Vec<Patch>, String> {
        let mut file = FoamFile::open(&self.path("boundary"))?;
        let count = file.count()?;
        file.expect("(")?;
        let patches: Result<Vec<Patch>, String> = (0..count).map(|_| patch(&mut file)).collect();
        let mut patches = patches?;
        patches.retain(|patch| !patch.kind.starts_with("processor"));
        // Every face takes more than a byte: a damaged number must not fill the memory.
        let path = self.path("faces");
        if !path.is_file() {
            FoamFile::open(&path)?;
        }
        let most = path.metadata().map_or(0, |data| data.len());
        let fits = |patch: &Patch| patch.start.checked_add(patch.faces).is_some_and(|end| end as u64 <= most);
        if let Some(patch) = patches.iter().find(|patch| !fits(patch)) {
            return Err(file.fault(&format!(
                "says that {} has more faces than {}",
                patch.name,
                path.display()
            )));
        }
        Ok(patches)
    }

    /// The outlines of the faces of some patches, by their names.
    ///
    /// # Errors
    /// File, fault and remedy.
    pub fn outlines(&self, patches: &[&Patch]) -> Result<BTreeMap<String, Vec<Outline>>, String> {
        let mut file = FoamFile::open(&self.path("points"))?;
        let points = file.list(Entries::Scalars(3))?.all(0).unwrap_or_default();
        let path = self.path("faces");
        let faces = Faces::open(&path)?;
        let point = |label: usize| -> Option<[f64; 3]> {
            let from = label.checked_mul(3)?;
            points.get(from..from.checked_add(3)?)?.try_into().ok()
        };
        let mut outlines = BTreeMap::new();
        for patch in patches {
            let corners = |face: usize| faces.corners(face)?.iter().map(|label| point(*label)).collect();
            let own: Option<Vec<Outline>> =
                (0..patch.faces).map(|face| corners(patch.start + face)).collect();
            let own = own.ok_or_else(|| {
                format!(
                    "{}: faces of patch {} are absent or have corners that `points` does not have; copy constant/polyMesh \
                     again from where the case ran",
                    path.display(),
                    patch.name
                )
            })?;
            outlines.insert(patch.name.clone(), own);
        }
        Ok(outlines)
    }
}

/// `name { type wall; nFaces 2; startFace 7; }`
fn patch(file: &mut FoamFile) -> Result<Patch, String> {
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

/// Labels of the corners of all faces, one face after the other.
pub(super) struct Faces {
    /// Where each face begins, and the end of the last one.
    starts: Vec<usize>,
    labels: Vec<usize>,
}

impl Faces {
    /// ASCII: a list of lists. Binary: the starts of the faces, and the labels of all.
    ///
    /// # Errors
    /// File, fault and remedy.
    pub(super) fn open(path: &Path) -> Result<Self, String> {
        let mut file = FoamFile::open(path)?;
        if file.is_binary() {
            return Ok(Self { starts: file.labels()?, labels: file.labels()? });
        }
        let mut faces = Self { starts: vec![0], labels: Vec::new() };
        let count = file.count()?;
        file.expect("(")?;
        for _ in 0..count {
            faces.labels.extend(file.labels()?);
            faces.starts.push(faces.labels.len());
        }
        Ok(faces)
    }

    /// Number of faces.
    pub(super) fn count(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Labels of the corners of all faces.
    pub(super) fn all_labels(&self) -> &[usize] {
        &self.labels
    }

    /// Labels of the corners of a face.
    pub(super) fn corners(&self, face: usize) -> Option<&[usize]> {
        self.labels.get(*self.starts.get(face)?..*self.starts.get(face + 1)?)
    }
}
