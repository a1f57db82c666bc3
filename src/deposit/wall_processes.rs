//! Processes that change a deposit over a time step: the table [`PROCESSES`], in the order in which they
//! act.
//!
//! A process is one file in `src/deposit/` with a [`ProcessInfo`], and one line of the table. The model
//! file, the columns of `simulate` and OpenFOAM, and the C interface follow from the table.
//!
//! The end of a time step, for every code that keeps deposits:
//!
//! 1. The liquid film flows along the wall, with the deposit as it was at the start of the step. It
//!    couples neighbouring pieces of wall, so the code
//!    that has the mesh moves it ([`Model::film_velocity`](crate::Model::film_velocity)); all processes
//!    here see one piece of wall.
//! 2. Captured particles are added ([`Deposit::with`]). Where powder burns, it does so while they arrive
//!    ([`super::burn_off`]).
//! 3. The processes of the table act in their order ([`Model::advance`](crate::Model::advance)).

use super::process::{ProcessInfo, Step, VapourSide, WallProcess};
use super::{Deposit, melting, resuspension, shedding, sintering, vapour_condensation};
use crate::input::{InputError, Section};

/// All processes, in the order in which they act.
pub const PROCESSES: &[&ProcessInfo] =
    &[&melting::INFO, &sintering::INFO, &vapour_condensation::INFO, &resuspension::INFO, &shedding::INFO];

/// Number of processes.
pub const PROCESS_COUNT: usize = PROCESSES.len();

/// Mass that each process took from a piece of wall [kg/m²], in the order of [`PROCESSES`]; negative for one that
/// brings mass.
pub type Losses = [f64; PROCESS_COUNT];

/// The processes that act on one wall.
#[derive(Debug, Clone)]
pub struct WallProcesses([WallProcess; PROCESS_COUNT]);

impl WallProcesses {
    /// Reads them from the table of a wall.
    pub(crate) fn read(wall: &Section<'_>) -> Result<Self, InputError> {
        let mut found = [const { None }; PROCESS_COUNT];
        for (process, info) in found.iter_mut().zip(PROCESSES) {
            *process = (info.read)(wall)?;
        }
        Ok(Self(found))
    }

    /// Their entries in [`PROCESSES`], with their places there.
    pub fn acting(&self) -> impl Iterator<Item = (usize, &'static ProcessInfo)> {
        let all = self.0.iter().zip(PROCESSES).enumerate();
        all.filter_map(|(place, (process, info))| process.as_ref().map(|_| (place, *info)))
    }

    /// Their numbers in words, in their order.
    pub(crate) fn describe(&self) -> String {
        self.0.iter().flatten().map(|process| process.describe()).collect()
    }

    /// Heat flux [W/m²] that they release at a surface of a temperature [K].
    pub(crate) fn heat_flux(&self, gas: &VapourSide, surface: f64) -> f64 {
        self.0.iter().flatten().map(|process| process.heat_flux(gas, surface)).sum()
    }

    /// The deposit after a time step, and what each process took from it.
    pub(crate) fn advance(&self, deposit: &Deposit, step: &Step<'_>) -> (Deposit, Losses) {
        let (mut now, mut losses) = (*deposit, Losses::default());
        for ((process, info), loss) in self.0.iter().zip(PROCESSES).zip(&mut losses) {
            let Some(process) = process else { continue };
            let next = process.after(&now, step);
            if info.loss.is_some() || info.gain.is_some() {
                *loss = now.mass() - next.mass();
            }
            now = next;
        }
        (now, losses)
    }
}
