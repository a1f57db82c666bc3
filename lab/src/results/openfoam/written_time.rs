//! Where a case wrote something last: in its own folder or, when it is decomposed and not
//! reconstructed up to that time, in the folders of the ranks.

use std::path::{Path, PathBuf};

use super::mesh::Mesh;
use super::{entries, file_name, time_folders};

/// The folder of the case or those of its ranks, and the time.
pub(super) struct WrittenTime {
    pub roots: Vec<PathBuf>,
    /// Time [s].
    pub time: f64,
    /// Name of its folder.
    folder: String,
}

impl WrittenTime {
    /// The last time [s] whose folder has what is wanted.
    pub fn last(case: &Path, has: impl Fn(f64, &Path) -> bool) -> Option<Self> {
        let newest = |root: &PathBuf| {
            let mut times = time_folders(root).into_iter().rev();
            let (time, folder) = times.find(|(time, folder)| has(*time, folder))?;
            Some((time, file_name(&folder).to_owned()))
        };
        let case = case.to_owned();
        let (ranks, whole) = (ranks(&case), newest(&case));
        let split = ranks.iter().filter_map(newest).max_by(|a, b| a.0.total_cmp(&b.0));
        let newer = |(time, _): &(f64, String)| whole.as_ref().is_none_or(|(other, _)| time > other);
        let (roots, (time, folder)) = match split.filter(newer) {
            Some(split) => (ranks, split),
            None => (vec![case], whole?),
        };
        Some(Self { roots, time, folder })
    }

    /// A file or folder of one root at this time.
    pub fn file(&self, root: &Path, name: &str) -> PathBuf {
        root.join(&self.folder).join(name)
    }

    /// The mesh of one root at this time.
    pub fn mesh<'a>(&self, root: &'a Path) -> Mesh<'a> {
        Mesh { root, time: self.time }
    }
}

/// The folders of the ranks of a decomposed case, in their order.
fn ranks(case: &Path) -> Vec<PathBuf> {
    let number = |path: &PathBuf| file_name(path).strip_prefix("processor")?.parse::<usize>().ok();
    let folders = entries(case, Path::is_dir).into_iter();
    let mut ranks: Vec<(usize, PathBuf)> = folders.filter_map(|path| Some((number(&path)?, path))).collect();
    ranks.sort();
    ranks.into_iter().map(|(_, path)| path).collect()
}

/// Whether there are folders `processors4`, which hold all ranks in one file.
pub(super) fn has_collated(case: &Path) -> bool {
    entries(case, Path::is_dir).iter().any(|path| file_name(path).starts_with("processors"))
}
