//! What happens when a particle hits a wall.
//!
//! Codes that follow particles through a gas describe a wall impact with two constants. Real
//! particles stick, rebound, slide or roll, depending on speed, angle, size, temperature, melting,
//! carbon conversion and the deposit on the wall. This crate decides an impact from physics:
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
//! # An impact, step by step
//! All callers (OpenFOAM, the C library, the command) use [`Model::resolve`], or
//! [`Model::resolve_block`] for many impacts at once, with the same bits. Both run these steps:
//!
//! 1. [`impact`]: the caller's [`Impact`] holds speeds, size, temperatures and what lies on the
//!    wall. The wall adds the powder and the covering of its entry in the model file.
//! 2. [`material`]: the properties of particle and wall at their temperatures give the contact
//!    ([`Contact`](normal::Contact)). Effects may change it, and may tilt the wall locally.
//! 3. [`capture`]: how sticky the particle and the wall are, from viscosity ([`slag`]), melting or conversion.
//! 4. [`normal`]: the normal law gives `e_n`, or says that adhesion holds the particle. Effects
//!    change `e_n`; a sticky particle loses part of it.
//! 5. [`tangential`]: the tangential law gives `e_t` and the spin. Effects change them. `e_n` and
//!    `e_t` are then referred to the mean wall again, if an effect tilted it.
//! 6. [`capture`] again: the probability of capture. On a wall with slag or powder it is the mean
//!    over the covered and the bare share; a random draw decides which of them gives `e_n` and `e_t`.
//! 7. Fitted corrections ([`effect::FittedCurve`], [`effect::FittedForm`]) of `e_n`, `e_t` and the
//!    probability, over inputs and dimensionless groups ([`group`]), where a model has them; then the
//!    random draw ([`rng`]) decides whether the particle stays.
//! 8. [`Outcome`]: `e_n`, `e_t`, spin, probability, regime, and whether a law was used outside its stated range.
//!
//! An [`effect`] is a named, removable term that acts on some of these steps.
//! `src/model/evaluation.rs` holds the order.
//!
//! # Around an impact
//! [`input`] reads TOML files with errors that name line and key. [`law`] has what laws by name
//! share: parameters, source and range. A [`deposit`] is what earlier particles left on a piece of
//! wall; a code may keep one for each face and pass it to later impacts. [`erosion`] sums what
//! impacts remove of a wall. [`transport`] brings particles to the wall: turbulence, thermophoresis,
//! Brownian motion. [`c_api`] is the C interface.
//!
//! The crate `nearwall-lab` (folder `lab`) has everything around the library: measurements,
//! standalone cases, diagnosis, HTML pages and the command `nearwall`.

// Units stand in brackets, which rustdoc takes for links.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod c_api;
pub mod capture;
pub mod deposit;
pub mod effect;
pub mod erosion;
pub mod group;
pub mod impact;
pub mod input;
pub mod key;
pub mod law;
pub mod material;
pub mod model;
pub mod normal;
pub mod rng;
pub mod slag;
pub mod tangential;
pub mod transport;
mod vector_math;

pub use impact::{Impact, ImpactError, Outcome, Regime, global_restitution};
pub use input::InputError;
pub use model::Model;
pub use rng::ImpactRng;
