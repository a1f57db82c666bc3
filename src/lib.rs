//! What happens when a particle hits a wall.
//!
//! Codes that follow particles through a gas treat a wall hit with two constants. Real particles stick, bounce,
//! slide or roll depending on speed, angle, size, temperature, melting, carbon conversion and what already lies on
//! the wall. This crate decides it from physics:
//!
//! ```
//! use nearwall::{ImpactRng, Impact, Model};
//!
//! let model = Model::from_toml("wax.toml", r#"
//!     [particle]
//!     material = "montan-wax"
//!     [walls.default]
//!     material = "pyrex"
//!     [normal]
//!     model = "thornton-ning"
//!     yield_ratio = 0.7
//!     [tangential]
//!     model = "constant"
//!     e_t = 0.76
//! "#)?;
//! let impact = Impact { normal_speed: 1.0, tangential_speed: 0.5, diameter: 75e-6, ..Impact::default() };
//! let outcome = model.resolve(0, &impact, ImpactRng::new(1, 0))?;
//! assert!(!outcome.stuck && outcome.normal_restitution < 0.4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! What earlier particles left on a wall is a [`deposit`]; a code may keep it and tell the next impacts of it.
//!
//! The walk of an impact: [`Impact`] → [`material`] at temperature → [`normal`] law → [`tangential`] law →
//! [`effect`]s → [`capture`] → [`Outcome`]. The one door is [`Model::resolve`]; OpenFOAM, the C library and the command
//! all enter there.

// Units stand in brackets, which rustdoc takes for links.
#![allow(rustdoc::broken_intra_doc_links)]

#[cfg(feature = "command")]
pub mod atomic_file;
pub mod c_api;
pub mod capture;
#[cfg(feature = "command")]
pub mod dataset;
pub mod deposit;
#[cfg(feature = "command")]
pub mod diagnose;
pub mod effect;
pub mod impact;
pub mod input;
pub mod material;
pub mod model;
pub mod normal;
#[cfg(feature = "command")]
pub mod report;
#[cfg(feature = "command")]
pub mod results;
pub mod rng;
#[cfg(feature = "command")]
pub mod simulate;
pub mod slag;
pub mod tangential;
mod vector_math;

pub use impact::{Impact, ImpactError, Outcome, Regime, global_restitution};
pub use input::InputError;
pub use model::Model;
pub use rng::ImpactRng;
