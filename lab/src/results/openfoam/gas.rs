//! The gas in a plane with the parcels of a cloud near it, at the last written time that has parcels.
//!
//! The mesh, `T` or else `U`, and the cloud are read from the case or from the folders of its ranks.
//!
//! The conversion of a parcel is 1 - m Y_C / (m_0 Y_C0): the mass m of a particle from its diameter
//! and density (π/6 d³ ρ), the share Y_C of carbon in it from `YC(s)`, its mass at injection from
//! `mass0`, and the share at injection from the cloud's properties (`YSolidTot0` and `C` of the
//! solid). OpenFOAM writes `YC(s)` as a share of the whole parcel, not of its solid.
//! nearWallInteraction computes the same (`carbonConversion` of `openfoam/coupling/cloudTraits.H`).

use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use super::cells::MeshCells;
use super::foam_file::{FoamError, FoamFile, is_written};
use super::parcel_lists::{ParcelPlaces, numbers, places};
use super::recorded::Carbon;
use super::written_time::{WrittenTime, has_collated};
use super::{entries, file_name};
use crate::results::gas::{CutPlane, FlyingParcel, GasCut, GasQuantity, ParcelQuantity};
use crate::results::{MapCell, range};

/// Largest size of the files `faces` of a mesh that is cut, in all [bytes]: some four million
/// cells, for which reading takes a gigabyte.
const LARGEST_MESH: u64 = 250_000_000;
/// Carbon of each parcel over its mass [1].
const CARBON: &str = "YC(s)";

/// Why there is no picture of gas and parcels.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum GasError {
    /// A file that is damaged or compressed.
    #[error("{0}. Until then there is no picture of gas and parcels")]
    Unreadable(#[from] FoamError),
    /// A file of parcels.
    #[error(
        "{0}; run gunzip on it if it is compressed, else copy it again from where the case ran. Until then there is no \
         picture of gas and parcels"
    )]
    Parcels(FoamError),
    /// The fields of all ranks are in one file each.
    #[error(
        "{0}: the fields of all ranks are in one file each (collated), which are not read; run reconstructPar for a \
            picture of gas and parcels"
    )]
    Collated(String),
    /// No field of the gas.
    #[error("{0}: it holds neither T nor U of the gas. Until then there is no picture of gas and parcels")]
    NoGas(String),
    /// The mesh is too large to be cut.
    #[error(
        "{0}: the mesh is too large for a picture of gas and parcels here; openfoam/paraview/gasWithParcels.py shows \
            it in ParaView"
    )]
    TooLarge(String),
}

/// Reads gas and parcels; `None` when the case has no parcels or no mesh.
///
/// # Errors
/// Why they cannot be read, for the page.
pub fn read_last(case: &Path, cloud: &str) -> Result<Option<GasCut>, GasError> {
    let shown = || case.display().to_string();
    let has_parcels = |_: f64, folder: &Path| has_places(&folder.join("lagrangian").join(cloud));
    let source = WrittenTime::last(case, has_parcels)
        .filter(|source| source.roots.iter().all(|root| is_written(&source.mesh(root).path("owner"))));
    let Some(source) = source else {
        return if has_collated(case) { Err(GasError::Collated(shown())) } else { Ok(None) };
    };
    let temperature = gas_field(&source, "T").map(|name| (GasQuantity::Temperature, name));
    let speed = || gas_field(&source, "U").map(|name| (GasQuantity::Speed, name));
    let Some(gas) = temperature.or_else(speed) else {
        let root = source.roots.first().map_or(case, PathBuf::as_path);
        return Err(GasError::NoGas(source.file(root, "").display().to_string()));
    };
    let faces = source.roots.iter().map(|root| source.mesh(root).path("faces"));
    let size: u64 = faces.filter_map(|path| std::fs::metadata(path).ok()).map(|file| file.len()).sum();
    if size > LARGEST_MESH {
        return Err(GasError::TooLarge(shown()));
    }
    cut(&source, cloud, gas, Carbon::of(case, cloud).as_ref())
}

/// The name of a field of the gas at the written time: its own, or with that of its phase, as `U.air` of MPPICFoam.
fn gas_field(source: &WrittenTime, name: &str) -> Option<String> {
    let has = |name: &str| source.roots.iter().all(|root| is_written(&source.file(root, name)));
    if has(name) {
        return Some(name.to_owned());
    }
    let folder = source.file(source.roots.first()?, "");
    let names = entries(&folder, Path::is_file)
        .into_iter()
        .map(|path| file_name(&path).trim_end_matches(".gz").to_owned());
    names
        .filter(|file| file.strip_prefix(name).is_some_and(|phase| phase.starts_with('.')))
        .find(|file| has(file))
}

fn cut(
    source: &WrittenTime,
    cloud: &str,
    (quantity, field): (GasQuantity, String),
    carbon: Option<&Carbon>,
) -> Result<Option<GasCut>, GasError> {
    let read = |root: &PathBuf| MeshCells::read(&source.mesh(root));
    let meshes: Vec<MeshCells> = source.roots.iter().map(read).collect::<Result<_, _>>()?;
    let points = || meshes.iter().flat_map(MeshCells::points);
    let ends = [0, 1, 2].map(|axis| range(points().map(|point| point[axis])));
    let Some(plane) = CutPlane::through(&ends) else { return Ok(None) };
    let clouds = source.roots.iter().map(|root| source.file(root, "lagrangian").join(cloud));
    let clouds: Vec<PathBuf> = clouds.collect();
    // A rank without parcels may have no files of them.
    let coloured_by = clouds.iter().find_map(|folder| parcel_quantity(folder, carbon));
    let (mut cells, mut parcels, mut resting) = (Vec::new(), Vec::new(), 0);
    for ((root, mesh), folder) in source.roots.iter().zip(&meshes).zip(&clouds) {
        let values = gas_values(&source.file(root, &field), quantity, mesh.count)?;
        let own = mesh.cut(&plane).into_iter();
        cells.extend(own.map(|(cell, outline)| MapCell::new(outline, values[cell])));
        if has_places(folder) {
            let all = read_parcels(folder, mesh, coloured_by, carbon)?;
            let (flying, still): (Vec<_>, Vec<_>) = all.into_iter().partition(|(_, moves)| *moves);
            parcels.extend(flying.into_iter().map(|(parcel, _)| parcel));
            resting += still.len();
        }
    }
    let is_flat = cells.len() == meshes.iter().map(|mesh| mesh.count).sum::<usize>();
    let time = source.time;
    let cut = GasCut { time, plane, is_flat, quantity, cells, coloured_by, parcels, resting };
    Ok((!cut.cells.is_empty()).then_some(cut))
}

/// The values of the gas in all cells of the case or of one rank.
fn gas_values(path: &Path, quantity: GasQuantity, cells: usize) -> Result<Vec<f64>, FoamError> {
    let parts = match quantity {
        GasQuantity::Temperature => 1,
        GasQuantity::Speed => 3,
    };
    let mut file = FoamFile::open(path)?;
    file.seek("internalField")?;
    let values = file.field_values(parts, cells, "cells")?;
    let speed = |velocity: &[f64]| velocity.iter().map(|part| part * part).sum::<f64>().sqrt();
    Ok(if parts == 3 { values.chunks_exact(3).map(speed).collect() } else { values })
}

/// Whether a folder holds places of parcels.
fn has_places(folder: &Path) -> bool {
    ["positions", "coordinates"].iter().any(|name| is_written(&folder.join(name)))
}

/// What the parcels in a folder can be coloured by; `None` where they have neither carbon nor temperature.
fn parcel_quantity(folder: &Path, carbon: Option<&Carbon>) -> Option<ParcelQuantity> {
    let has = |name: &str| is_written(&folder.join(name));
    if carbon.is_some() && has(CARBON) && has("mass0") {
        return Some(ParcelQuantity::Conversion);
    }
    has("T").then_some(ParcelQuantity::Temperature)
}

/// The parcels in a folder `lagrangian/<cloud>`, and whether each moves.
fn read_parcels(
    folder: &Path,
    cells: &MeshCells,
    quantity: Option<ParcelQuantity>,
    carbon: Option<&Carbon>,
) -> Result<Vec<(FlyingParcel, bool)>, GasError> {
    let positions = match places(folder).map_err(GasError::Parcels)? {
        ParcelPlaces::Cartesian(places) => places,
        ParcelPlaces::Barycentric(places) => {
            cells.cartesian(&places).ok_or_else(|| FoamError::NoCell(folder.display().to_string()))?
        }
    };
    let count = positions.len();
    let list = |name: &str| {
        let values = numbers(folder, name, count).map_err(GasError::Parcels)?;
        if values.len() == count {
            return Ok(values);
        }
        let path = folder.join(name).display().to_string();
        Err(GasError::Parcels(FoamError::Parcels(path, values.len(), count)))
    };
    let values = match (quantity, carbon) {
        (Some(ParcelQuantity::Conversion), Some(carbon)) => {
            let (diameters, densities, fresh) = (list("d")?, list("rho")?, list("mass0")?);
            let shares = list(CARBON)?;
            let conversion = |parcel: usize| {
                let mass = PI / 6.0 * diameters[parcel].powi(3) * densities[parcel];
                carbon.conversion_of(fresh[parcel], mass * shares[parcel])
            };
            (0..count).map(conversion).collect()
        }
        (Some(ParcelQuantity::Temperature), _) => list("T")?,
        _ => vec![f64::NAN; count],
    };
    // Not every cloud writes whether a parcel moves.
    let active = if is_written(&folder.join("active")) { list("active")? } else { vec![1.0; count] };
    let parcels = positions.into_iter().zip(values).zip(active);
    Ok(parcels.map(|((position, value), active)| (FlyingParcel { position, value }, active != 0.0)).collect())
}
