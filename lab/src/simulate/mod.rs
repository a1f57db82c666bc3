//! Standalone cases: particles in a prescribed gas hit walls until they are captured or gone.
//!
//! A [`Case`] is read from a TOML file. [`run_once`] draws its particles and follows each through
//! the gas ([`gas`]) with drag ([`drag`]), weight and heat ([`heating`]);
//! [`nearwall::Model::resolve`] decides every hit. [`crate::results::standalone`] sums up the
//! [`Trajectory`]s. Turbulence, thermophoresis and Brownian motion are those of [`nearwall::transport`]. Particles
//! do not interact with each other and do not act on the gas. A `[deposit]` gives the walls a memory: the particles
//! are released over a duration, and at the end of each of its steps the captured ones are added to the walls
//! ([`DepositSettings`]). Each particle has its own random draws, so that results are the same bits on any number of
//! threads.

mod case;
mod conversion;
mod cooling;
mod deposit_settings;
mod dispersed_flight;
mod distribution;
pub mod drag;
mod error;
mod even_starts;
mod flight;
mod fusion;
pub mod gas;
mod geometry;
pub mod heating;
mod injection;
mod linear_profile;
mod motion;
mod near_wall;
mod shrinkage;
mod stated_error;
mod surface;
mod tracker;
mod trajectory;
mod wall_deposits;
mod wall_surroundings;
mod weighted;

pub use case::{Case, SWEEP_KEYS, Sweep, SweepReference, sweep_unit};
pub use conversion::{CarbonConversion, GAS_CONSTANT};
pub use deposit_settings::DepositSettings;
pub use distribution::{Distribution, DistributionKey};
pub use error::SimulationError;
pub use even_starts::{BLOCKS, even_starts};
pub use flight::{FlightEnd, fly};
pub use fusion::Fusion;
pub use injection::{Injection, ParticleWeight};
pub use linear_profile::LinearProfile;
pub use motion::{Body, ParticleMotion, ParticleState, position, state, velocity};
pub use near_wall::StayTime;
pub use shrinkage::Shrinkage;
pub use stated_error::{number_of, split_errors};
pub use surface::{Surface, SurfaceKind, SurfaceShape};
pub use tracker::Start;
pub use trajectory::{Fate, Hit, Trajectory};
pub use wall_deposits::{BinHistory, DepositHistory, WallHistory};
pub use weighted::{ExpectedHit, PathTree, Room, follow_exactly};

use rayon::prelude::*;

use wall_deposits::WallDeposits;

/// Particles that are followed in parallel before their trajectories are handed over in order.
const BATCH: usize = 4096;

/// Runs a case as it is; `value` is passed on to the observer. Returns what lies on the walls over
/// time, where they keep it.
///
/// # Errors
/// Those of `observer`, and a deposit that cannot be formed.
pub fn run_once<E: From<SimulationError>>(
    case: &Case,
    value: Option<f64>,
    observer: &mut impl FnMut(&Case, Option<f64>, u64, &Trajectory) -> Result<(), E>,
) -> Result<Option<DepositHistory>, E> {
    let walls = case.deposit.map(|settings| WallDeposits::new(case, settings)).transpose();
    let mut walls = walls.map_err(E::from)?;
    for step in 0..case.deposit.map_or(1, |deposit| deposit.steps) {
        for numbers in released(case, step).chunks(BATCH) {
            let frozen = walls.as_ref();
            let follow = |number: &u64| tracker::follow(case, frozen, *number);
            let trajectories: Vec<Trajectory> = numbers.par_iter().map(follow).collect();
            for (number, trajectory) in numbers.iter().zip(&trajectories) {
                if let Some(walls) = &mut walls {
                    walls.collect(case, trajectory).map_err(E::from)?;
                }
                observer(case, value, *number, trajectory)?;
            }
        }
        if let Some(walls) = &mut walls {
            walls.end_step(case).map_err(E::from)?;
        }
    }
    Ok(walls.map(WallDeposits::into_history))
}

/// Numbers of the particles that are released in a step of the feed; all of them in a case without deposit.
fn released(case: &Case, step: u64) -> Vec<u64> {
    let mut numbers = Vec::new();
    let mut first = 0;
    for injection in &case.injections {
        let own = case.deposit.map_or(0..injection.count, |deposit| deposit.released(step, injection.count));
        numbers.extend(own.map(|own| first + own));
        first += injection.count;
    }
    numbers
}
