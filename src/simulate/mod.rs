//! Standalone cases: particles in a prescribed gas hit walls until they are captured or gone.
//!
//! A [`Case`] is read from a TOML file. [`run`] draws its particles and follows each through the gas ([`gas`]) with drag
//! ([`drag`]), weight and heat ([`heating`]); [`crate::Model::resolve`] decides every hit. [`crate::results::standalone`]
//! sums up the [`Trajectory`]s. Particles do not interact with each other and do not act on the gas or the walls. Each has
//! its own random draws, so that results are the same bits on any number of threads.

mod burning;
mod case;
mod distribution;
pub mod drag;
mod flight;
pub mod gas;
mod geometry;
pub mod heating;
mod injection;
mod profile;
mod surface;
mod trajectory;

pub use burning::{Burning, GAS_CONSTANT};
pub use case::{Case, Reference, SWEEP_KEYS, Sweep, sweep_unit};
pub use distribution::Distribution;
pub use flight::{Body, FlightEnd, FlightError, ParticleMotion, State, fly, position, state, velocity};
pub use injection::{Injection, ParticleWeight};
pub use profile::Profile;
pub use surface::{Shape, Surface, SurfaceKind};
pub use trajectory::{Fate, Hit, Trajectory};

use rayon::prelude::*;

/// Particles that are followed in parallel before their trajectories are handed over in order.
const BATCH: u64 = 4096;

/// Runs a case once, or once for each value of its sweep. `observer` receives each trajectory in order with the swept
/// value and the number of the particle.
///
/// # Errors
/// Those of `observer`, and a swept value that cannot be set.
pub fn run<E: From<String>>(
    case: &mut Case,
    mut observer: impl FnMut(&Case, Option<f64>, u64, &Trajectory) -> Result<(), E>,
) -> Result<(), E> {
    let Some(sweep) = case.sweep.clone() else { return run_once(case, None, &mut observer) };
    for value in sweep.values {
        case.set(&sweep.key, value).map_err(E::from)?;
        run_once(case, Some(value), &mut observer)?;
    }
    Ok(())
}

fn run_once<E>(
    case: &Case,
    value: Option<f64>,
    observer: &mut impl FnMut(&Case, Option<f64>, u64, &Trajectory) -> Result<(), E>,
) -> Result<(), E> {
    for from in (0..case.injection.count).step_by(BATCH as usize) {
        let numbers = from..(from + BATCH).min(case.injection.count);
        let trajectories: Vec<Trajectory> =
            numbers.clone().into_par_iter().map(|number| trajectory::follow(case, number)).collect();
        for (number, trajectory) in numbers.zip(&trajectories) {
            observer(case, value, number, trajectory)?;
        }
    }
    Ok(())
}
