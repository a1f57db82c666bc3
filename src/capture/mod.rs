//! Capture: whether a particle stays on the wall. One criterion a file.
//!
//! Either of two mechanisms captures a particle: adhesion holds one that is too slow (see the
//! normal law), or particle or wall are sticky (melting, conversion, viscosity, a droplet that does
//! not splash).
//!
//! A wall is a patchwork: the share `c` is covered by powder or char that is not sticky, the share
//! `1 - c` is bare. An impact meets one of the two, so `P = c P_covered + (1 - c) P_bare`: the
//! covered share stands outside both probabilities, and a particle that only slag can hold is held
//! with a probability of at most `1 - c`.

mod correction;
mod criterion;
pub mod drop_bounce;
pub mod drop_freezing;
pub mod drop_pinning;
pub mod drop_rebound;
pub mod drop_restitution;
mod droplet;
mod fusion;
mod kinetic_energy;
mod melt;
mod melt_fraction;
mod rebound_from_slag;
mod solidification;
mod stickiness;
mod viscosity;

pub(crate) use criterion::{CAPTURE_KINDS, lowest};
pub use criterion::{Capture, Criterion, MeltStates, StickinessCriterion, Unsuitable, WallState};
pub use droplet::{Droplet, DropletCriterion, DropletNumbers, SPLASH_K, deposited_share};
pub use fusion::{FusionCriterion, FusionStickiness, fusion_stickiness};
pub use kinetic_energy::{critical_viscosity, kinetic_energy};
pub use melt_fraction::{
    FLOWS_FROM, MeltFractionCriterion, MeltFractionStickiness, STICKY_FROM, melt_fraction_stickiness,
};
pub(crate) use rebound_from_slag::{rebound_from_slag, sinks_into_slag};
pub use solidification::Solidification;
pub use stickiness::{Combination, Stickiness};
pub use viscosity::{FASTEST_WITHOUT_SPEED, MeltStickiness, ViscosityCriterion, sticking_probability};
