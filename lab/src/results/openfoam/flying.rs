//! The parcels of a cloud in flight at one time, with their carbon conversion or their temperature.
//!
//! Conversion is 1 - m Y_C / (m_0 Y_C0): the mass m of a particle from its diameter and density (π/6 d³ ρ), the share Y_C of carbon in
//! it from `YC(s)`, its mass at injection from `mass0`, and the share at injection from the cloud's properties
//! (`YSolidTot0` and `C` of the solid). OpenFOAM writes `YC(s)` as a share of the whole parcel, not of its solid. nearWallInteraction
//! computes the same from the parcels themselves (`carbonConversion` of `openfoam/coupling/cloudTraits.H`).

use std::f64::consts::PI;
use std::path::Path;

use super::barycentric::cartesian;
use super::cells::Cells;
use super::foam_file::is_written;
use super::list_file::{Places, numbers, places};
use super::recorded::Carbon;
use crate::results::gas::{FlyingParcel, ParcelQuantity};

/// Carbon of each parcel over its mass [1].
const CARBON: &str = "YC(s)";

/// The parcels of the case or of one rank.
pub(super) struct Flying {
    pub parcels: Vec<FlyingParcel>,
    /// Number of parcels at rest.
    pub resting: usize,
}

/// What the parcels in a folder can be coloured by; `None` where they have neither carbon nor temperature.
pub(super) fn quantity(folder: &Path, carbon: Option<&Carbon>) -> Option<ParcelQuantity> {
    let has = |name: &str| is_written(&folder.join(name));
    if carbon.is_some() && has(CARBON) && has("mass0") {
        return Some(ParcelQuantity::Conversion);
    }
    has("T").then_some(ParcelQuantity::Temperature)
}

/// Reads the parcels in a folder `lagrangian/<cloud>`.
///
/// # Errors
/// File and fault.
pub(super) fn read(
    folder: &Path,
    cells: &Cells,
    quantity: Option<ParcelQuantity>,
    carbon: Option<&Carbon>,
) -> Result<Flying, String> {
    let positions = match places(folder).map_err(with_remedy)? {
        Places::Cartesian(places) => places,
        Places::Barycentric(places) => {
            cartesian(cells, &places).map_err(|fault| format!("{}: {fault}", folder.display()))?
        }
    };
    let count = positions.len();
    let values = match (quantity, carbon) {
        (Some(ParcelQuantity::Conversion), Some(carbon)) => conversions(folder, count, carbon)?,
        (Some(ParcelQuantity::Temperature), _) => list(folder, "T", count)?,
        _ => vec![f64::NAN; count],
    };
    // Not every cloud writes whether a parcel moves.
    let active =
        if is_written(&folder.join("active")) { list(folder, "active", count)? } else { vec![1.0; count] };
    let all = positions.into_iter().zip(values).zip(active);
    let (flying, resting): (Vec<_>, Vec<_>) = all.partition(|(_, active)| *active != 0.0);
    let parcels = flying.into_iter().map(|((position, value), _)| FlyingParcel { position, value });
    Ok(Flying { parcels: parcels.collect(), resting: resting.len() })
}

fn conversions(folder: &Path, count: usize, carbon: &Carbon) -> Result<Vec<f64>, String> {
    let list = |name: &str| list(folder, name, count);
    let (diameters, densities, fresh, shares) = (list("d")?, list("rho")?, list("mass0")?, list(CARBON)?);
    let conversion = |parcel: usize| {
        let mass = PI / 6.0 * diameters[parcel].powi(3) * densities[parcel];
        carbon.conversion_of(fresh[parcel], mass * shares[parcel])
    };
    Ok((0..count).map(conversion).collect())
}

/// A property of all parcels.
fn list(folder: &Path, name: &str, count: usize) -> Result<Vec<f64>, String> {
    let values = numbers(folder, name, count).map_err(with_remedy)?;
    if values.len() != count {
        let path = folder.join(name);
        let fault = format!("{} has {} values for {count} parcels", path.display(), values.len());
        return Err(with_remedy(fault));
    }
    Ok(values)
}

/// A fault of a file of parcels, with what to do.
fn with_remedy(fault: String) -> String {
    format!("{fault}; run gunzip on it if it is compressed, else copy it again from where the case ran")
}
