//! Results of standalone cases: sums over the trajectories of [`crate::simulate`], `summary.json`, `impacts.csv` and
//! `deposit.csv`.

mod deposits;
mod doubts;
mod impacts;
mod summary;
mod totals;

pub use deposits::write as write_deposits;
pub use doubts::Doubts;
pub use impacts::ImpactRecorder;
pub use summary::{Summary, summary};
pub use totals::{ParticleEnds, RESTITUTION_STEP, RunTotals};

use crate::range::RangeReader;
use crate::results::RunResults;
use crate::rig::CaptureBand;
use crate::simulate::{self, Case, DepositHistory, SimulationError, Trajectory};

/// Results of a case at one value of its sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Value of the swept quantity, if there is a sweep.
    pub value: Option<f64>,
    /// Sums over all particles.
    pub totals: RunTotals,
    /// What lay on the walls over time, where the case keeps it.
    pub deposits: Option<DepositHistory>,
    /// The bands of the walls' captures over models drawn from a fit; empty without such models.
    pub bands: Vec<CaptureBand>,
}

impl Run {
    /// The results for the page.
    pub fn results(&self, case: &Case) -> RunResults {
        RunResults { deposits: deposits::by_wall(case, self), ..self.totals.results(case) }
    }
}

/// Runs a case once, or once for each value of its sweep. `observer` receives each trajectory in order with the swept
/// value and the number of the particle.
///
/// # Errors
/// Those of `observer`, and a swept value that cannot be set.
pub fn run<E: From<SimulationError>>(
    case: &mut Case,
    mut observer: impl FnMut(&Case, Option<f64>, u64, &Trajectory) -> Result<(), E>,
) -> Result<Vec<Run>, E> {
    let Some(sweep) = case.sweep.clone() else { return Ok(vec![run_once(case, None, &mut observer)?]) };
    let mut runs = Vec::new();
    for value in sweep.values {
        case.set(&sweep.key, value)?;
        runs.push(run_once(case, Some(value), &mut observer)?);
    }
    Ok(runs)
}

fn run_once<E: From<SimulationError>>(
    case: &Case,
    value: Option<f64>,
    observer: &mut impl FnMut(&Case, Option<f64>, u64, &Trajectory) -> Result<(), E>,
) -> Result<Run, E> {
    let mut totals = RunTotals::new(case);
    let ranges = RangeReader::new(&case.model);
    let deposits = simulate::run_once(case, value, &mut |case, value, number, trajectory| {
        totals.add(trajectory);
        totals.doubts.count(case, &ranges, trajectory);
        observer(case, value, number, trajectory)
    })?;
    Ok(Run { value, totals, deposits, bands: Vec::new() })
}
