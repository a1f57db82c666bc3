//! Results of standalone cases: sums over the trajectories of [`crate::simulate`], `summary.json` and `impacts.csv`.

mod impacts;
mod summary;
mod totals;

pub use impacts::ImpactRecorder;
pub use summary::{Summary, summary};
pub use totals::{RESTITUTION_STEP, RunTotals};

use crate::simulate::{self, Case, Trajectory};

/// Results of a case at one value of its sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Value of the swept quantity, if there is a sweep.
    pub value: Option<f64>,
    /// Sums over all particles.
    pub totals: RunTotals,
}

/// Runs a case once, or once for each value of its sweep. `observer` receives each trajectory in order with the swept
/// value and the number of the particle.
///
/// # Errors
/// Those of `observer`, and a swept value that cannot be set.
pub fn run<E: From<String>>(
    case: &mut Case,
    mut observer: impl FnMut(&Case, Option<f64>, u64, &Trajectory) -> Result<(), E>,
) -> Result<Vec<Run>, E> {
    let mut runs: Vec<Run> = Vec::new();
    simulate::run(case, |case, value, number, trajectory| {
        if number == 0 {
            runs.push(Run { value, totals: RunTotals::new(&case.surfaces) });
        }
        if let Some(run) = runs.last_mut() {
            run.totals.add(trajectory);
        }
        observer(case, value, number, trajectory)
    })?;
    Ok(runs)
}
