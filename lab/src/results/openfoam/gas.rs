//! The gas in a plane with the parcels of a cloud near it, at the last written time that has parcels.
//!
//! The mesh, `T` or else `U`, and the cloud are read from the case or, when it is decomposed and not reconstructed up to that time,
//! from the folders of the ranks.

use std::path::{Path, PathBuf};

use super::cells::Cells;
use super::flying::{self, Flying};
use super::foam_file::is_written;
use super::mesh::Mesh;
use super::recorded::Carbon;
use super::surfaces::{has_collated, ranks};
use super::{file_name, internal_field, time_folders};
use crate::results::gas::{CutCell, GasCut, GasQuantity, Plane};

/// Largest size of the files `faces` of a mesh that is cut, in all [bytes]: some four million cells, for which reading takes a gigabyte.
const LARGEST_MESH: u64 = 250_000_000;

/// Why there is no picture of gas and parcels.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum GasError {
    /// A file that is damaged or compressed: file, fault and remedy.
    #[error("{0}. Until then there is no picture of gas and parcels")]
    Unreadable(String),
    /// The fields of all ranks are in one file each.
    #[error(
        "{0}: the fields of all ranks are in one file each (collated), which are not read; run reconstructPar for a picture of gas and \
         parcels"
    )]
    Collated(String),
    /// The mesh is too large to be cut.
    #[error(
        "{0}: the mesh is too large for a picture of gas and parcels here; openfoam/paraview/gasWithParcels.py shows it in ParaView"
    )]
    TooLarge(String),
}

/// Reads gas and parcels; `None` when the case has no parcels, no mesh, or neither `T` nor `U` at that time.
///
/// # Errors
/// Why they cannot be read, for the page.
pub fn read_last(case: &Path, cloud: &str) -> Result<Option<GasCut>, GasError> {
    let Some(source) = Source::of(case, cloud) else {
        return if has_collated(case) {
            Err(GasError::Collated(case.display().to_string()))
        } else {
            Ok(None)
        };
    };
    let Some(quantity) = source.quantity() else { return Ok(None) };
    if source.size() > LARGEST_MESH {
        return Err(GasError::TooLarge(case.display().to_string()));
    }
    source.read(case, cloud, quantity).map_err(GasError::Unreadable)
}

/// Where the last parcels are: the folder of the case or those of its ranks, and the time.
struct Source {
    roots: Vec<PathBuf>,
    /// Time [s] and the name of its folder.
    time: f64,
    folder: String,
}

impl Source {
    /// `None` without parcels or mesh.
    fn of(case: &Path, cloud: &str) -> Option<Self> {
        let ranks = ranks(case);
        let whole = last_time(case, cloud);
        let split = ranks.iter().filter_map(|rank| last_time(rank, cloud)).max_by(|a, b| a.0.total_cmp(&b.0));
        let newer = |(time, _): &(f64, String)| whole.as_ref().is_none_or(|(other, _)| time > other);
        let (roots, (time, folder)) = match split.filter(newer) {
            Some(split) => (ranks, split),
            None => (vec![case.to_owned()], whole?),
        };
        let has_mesh = |root: &PathBuf| is_written(&Mesh { root, time }.path("owner"));
        roots.iter().all(has_mesh).then_some(Self { roots, time, folder })
    }

    /// Size of the files `faces` [bytes].
    fn size(&self) -> u64 {
        let faces = self.roots.iter().map(|root| Mesh { root, time: self.time }.path("faces"));
        faces.filter_map(|path| std::fs::metadata(path).ok()).map(|file| file.len()).sum()
    }

    fn file(&self, root: &Path, name: &str) -> PathBuf {
        root.join(&self.folder).join(name)
    }

    /// What can colour the gas.
    fn quantity(&self) -> Option<GasQuantity> {
        let has = |name: &str| self.roots.iter().all(|root| is_written(&self.file(root, name)));
        let speed = || has("U").then_some(GasQuantity::Speed);
        has("T").then_some(GasQuantity::Temperature).or_else(speed)
    }

    /// The values of the gas in all cells of the case or of one rank.
    fn values(&self, root: &Path, quantity: GasQuantity, cells: usize) -> Result<Vec<f64>, String> {
        match quantity {
            GasQuantity::Temperature => internal_field::read(&self.file(root, "T"), 1, cells),
            GasQuantity::Speed => {
                let parts = internal_field::read(&self.file(root, "U"), 3, cells)?;
                let speed = |velocity: &[f64]| velocity.iter().map(|part| part * part).sum::<f64>().sqrt();
                Ok(parts.chunks_exact(3).map(speed).collect())
            }
        }
    }

    fn read(&self, case: &Path, cloud: &str, quantity: GasQuantity) -> Result<Option<GasCut>, String> {
        let meshes: Result<Vec<Cells>, String> =
            self.roots.iter().map(|root| Cells::read(&Mesh { root, time: self.time })).collect();
        let meshes = meshes?;
        let mut ends = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
        meshes.iter().for_each(|cells| cells.widen(&mut ends));
        let Some(plane) = Plane::through(&ends) else { return Ok(None) };
        let carbon = Carbon::of(case, cloud);
        let clouds = self.roots.iter().map(|root| self.file(root, "lagrangian").join(cloud));
        // A rank without parcels may have no files of them.
        let clouds: Vec<PathBuf> = clouds.collect();
        let coloured_by = clouds.iter().find_map(|folder| flying::quantity(folder, carbon.as_ref()));
        let mut cut = GasCut {
            time: self.time,
            plane,
            is_flat: false,
            quantity,
            cells: Vec::new(),
            coloured_by,
            parcels: Vec::new(),
            resting: 0,
        };
        for ((root, cells), folder) in self.roots.iter().zip(&meshes).zip(&clouds) {
            let values = self.values(root, quantity, cells.count)?;
            let own = cells.cut(&plane).into_iter();
            cut.cells.extend(own.map(|(cell, outline)| CutCell { outline, value: values[cell] }));
            if has_places(folder) {
                let Flying { parcels, resting } = flying::read(folder, cells, coloured_by, carbon.as_ref())?;
                cut.parcels.extend(parcels);
                cut.resting += resting;
            }
        }
        cut.is_flat = cut.cells.len() == meshes.iter().map(|cells| cells.count).sum::<usize>();
        Ok((!cut.cells.is_empty()).then_some(cut))
    }
}

/// Whether a folder holds places of parcels.
fn has_places(folder: &Path) -> bool {
    ["positions", "coordinates"].iter().any(|name| is_written(&folder.join(name)))
}

/// The last time of a folder with parcels: time [s] and name.
fn last_time(root: &Path, cloud: &str) -> Option<(f64, String)> {
    let has_parcels = |folder: &Path| has_places(&folder.join("lagrangian").join(cloud));
    let (time, folder) = time_folders(root).into_iter().rev().find(|(_, folder)| has_parcels(folder))?;
    Some((time, file_name(&folder).to_owned()))
}
