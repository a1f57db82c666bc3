//! Standalone cases: particles in a prescribed gas hit walls again and again until they are stuck or gone.
//!
//! A [`Case`] is read from a TOML file. [`run`] draws its particles, follows each through the gas ([`gas`]) with drag
//! ([`drag`]), weight and heat ([`heating`]), lets [`crate::Model::resolve`] decide every hit, and sums up what happened
//! in a [`Tally`]. Particles do not meet each other and do not act on the gas or the walls. Each is its own world with
//! its own random draws, so results are the same bits on any number of threads.

mod burning;
mod case;
mod distribution;
pub mod drag;
mod flight;
pub mod gas;
mod geometry;
pub mod heating;
mod injection;
mod output;
mod page;
mod profile;
mod surface;
mod tally;
mod trajectory;

pub use burning::{Burning, GAS_CONSTANT};
pub use case::{Case, Reference, SWEEP_KEYS, Sweep, sweep_unit};
pub use distribution::Distribution;
pub use flight::{Arrival, Body, Lost, Motion, State, fly, position, state, velocity};
pub use injection::{Injection, Load, Start};
pub use output::{ImpactRecorder, summary, write};
pub use page::page;
pub use profile::Profile;
pub use surface::{Role, Shape, Surface};
pub use tally::{Capture, Mass, Moments, Share, Tally, WallTally};
pub use trajectory::{Fate, Hit, Trajectory};

use rayon::prelude::*;

/// Particles that are followed side by side before their results are summed up in order.
const BATCH: u64 = 4096;

/// One run of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Value of the swept quantity, if there is one.
    pub value: Option<f64>,
    /// What happened.
    pub tally: Tally,
}

/// Runs a case once, or once for each value of its sweep. Each particle's life is handed to `observer` in order, then
/// forgotten.
///
/// # Errors
/// What `observer` returns, and a swept value that cannot be set.
pub fn run<E: From<String>>(
    case: &mut Case,
    mut observer: impl FnMut(&Case, Option<f64>, u64, &Trajectory) -> Result<(), E>,
) -> Result<Vec<Run>, E> {
    let Some(sweep) = case.sweep.clone() else {
        let tally = run_once(case, |number, life| observer(case, None, number, life))?;
        return Ok(vec![Run { value: None, tally }]);
    };
    let mut runs = Vec::new();
    for &value in &sweep.values {
        case.set(&sweep.key, value).map_err(E::from)?;
        let tally = run_once(case, |number, life| observer(case, Some(value), number, life))?;
        runs.push(Run { value: Some(value), tally });
    }
    Ok(runs)
}

fn run_once<E>(case: &Case, mut observer: impl FnMut(u64, &Trajectory) -> Result<(), E>) -> Result<Tally, E> {
    let mut tally = Tally::new(&case.surfaces);
    let count = case.injection.count;
    let mut from = 0;
    while from < count {
        let to = (from + BATCH).min(count);
        let lives: Vec<Trajectory> =
            (from..to).into_par_iter().map(|number| trajectory::live(case, number)).collect();
        for (number, life) in (from..to).zip(&lives) {
            tally.add(life, &case.surfaces);
            observer(number, life)?;
        }
        from = to;
    }
    Ok(tally)
}
