//! The captured parcels of a cloud at the last written time.
//!
//! `<time>/lagrangian/<cloud>/positions`, `active`, `d`, `rho`, `nParticle`, and the deposit of
//! `nearWallInteraction`, `<time>/lagrangian/<cloud>Deposit/positions`, `d`, `mass`, `regime`,
//! ASCII or binary. Compressed files are not read; the page then states it.

use std::f64::consts::PI;
use std::path::Path;

use super::super::Capture;
use super::foam_file::FoamError;
use super::parcel_lists::{numbers, positions};
use super::time_folders;
use nearwall::impact::Regime;

/// Why the places of captured parcels are unknown.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ParcelError {
    /// No written time has parcels of this cloud; the second text is a hint at the remedy.
    #[error("no parcels of {0} at a written time{1}, so the places of captured parcels are unknown")]
    NoParcels(String, &'static str),
    /// A file that cannot be read.
    #[error("{0}, so the places of captured parcels are unknown")]
    Unreadable(#[from] FoamError),
}

/// Reads the parcels that lie still at the last time that has any parcels, in the cloud or in its deposit.
///
/// # Errors
/// Why they cannot be read, for the page.
pub fn read_last(case: &Path, cloud: &str) -> Result<Vec<Capture>, ParcelError> {
    let mut folders = time_folders(case).into_iter().rev().map(|(_, time)| {
        let lagrangian = time.join("lagrangian");
        (lagrangian.join(cloud), lagrangian.join(format!("{cloud}Deposit")))
    });
    let Some((own, deposit)) = folders.find(|(own, deposit)| own.is_dir() || deposit.is_dir()) else {
        let hint = if case.join("processor0").is_dir() { " (run reconstructPar)" } else { "" };
        return Err(ParcelError::NoParcels(cloud.to_owned(), hint));
    };
    // OpenFOAM writes no folder for a cloud that is empty
    let mut parcels = if own.is_dir() { read_cloud(&own)? } else { Vec::new() };
    if deposit.is_dir() {
        parcels.extend(read_deposit(&deposit)?);
    }
    Ok(parcels)
}

fn read_cloud(folder: &Path) -> Result<Vec<Capture>, FoamError> {
    let positions = positions(folder)?;
    let numbers = |name: &str| numbers(folder, name, positions.len());
    let (active, diameters, densities) = (numbers("active")?, numbers("d")?, numbers("rho")?);
    let particles = numbers("nParticle").unwrap_or_default();
    let parcels = positions.iter().enumerate().filter_map(|(index, position)| {
        let diameter = *diameters.get(index)?;
        let count = particles.get(index).copied().unwrap_or(1.0);
        let mass = count * PI / 6.0 * diameter.powi(3) * densities.get(index)?;
        (*active.get(index)? == 0.0).then(|| capture(*position, mass, diameter))
    });
    Ok(parcels.collect())
}

fn read_deposit(folder: &Path) -> Result<Vec<Capture>, FoamError> {
    let positions = positions(folder)?;
    let numbers = |name: &str| numbers(folder, name, positions.len());
    let (diameters, masses) = (numbers("d")?, numbers("mass")?);
    // -1 where no model decided.
    let regimes = numbers("regime").unwrap_or_default();
    let regime = |index: usize| {
        Regime::ALL.into_iter().find(|regime| regimes.get(index) == Some(&f64::from(*regime as u8)))
    };
    let parcels = positions.iter().zip(diameters).zip(masses).enumerate();
    let parcels = parcels.map(|(index, ((position, diameter), mass))| Capture {
        regime: regime(index),
        ..capture(*position, mass, diameter)
    });
    Ok(parcels.collect())
}

fn capture(position: [f64; 3], mass: f64, diameter: f64) -> Capture {
    Capture { wall: None, position, mass, diameter, regime: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parcels_of_the_deposit_are_read_when_the_cloud_is_empty() {
        let case = tempfile::tempdir().unwrap();
        let write = |path: &str, body: &str| {
            let path = case.path().join(path);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, format!("FoamFile\n{{\n}}\n// * * * //\n\n{body}\n")).unwrap();
        };
        for (file, body) in
            [("positions", "1\n(\n(1 2 3) 0\n)"), ("active", "1{1}"), ("d", "1{2e-3}"), ("rho", "1{1000}")]
        {
            write(&format!("0.1/lagrangian/coal/{file}"), body);
        }
        for (file, body) in [
            ("positions", "2\n(\n(0 0 1) 7\n(0 0 2) 8\n)"),
            ("d", "2{1e-4}"),
            ("mass", "2(3e-6 4e-6)"),
            ("regime", "2(-1 2)"),
        ] {
            write(&format!("0.2/lagrangian/coalDeposit/{file}"), body);
        }
        let parcels = read_last(case.path(), "coal");
        let lying = |z, mass| capture([0.0, 0.0, z], mass, 1e-4);
        let sticky = Capture { regime: Some(Regime::SpNsw), ..lying(2.0, 4e-6) };
        assert_eq!(parcels.unwrap(), [lying(1.0, 3e-6), sticky]);
    }
}
