//! Properties of every model and impact: bounds, monotonicity, continuity, units, energy.
//!
//! `proptest` draws random cases and minimises failures. A failing test prints
//! `NEARWALL_TEST_SEED=...`; the same variable in the environment repeats the run:
//! `NEARWALL_TEST_SEED=... cargo test --test properties`.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

#[path = "../common/mod.rs"]
mod common;

mod bits;
mod blocks;
mod bounds;
mod cases;
mod continuous;
mod deposit;
mod drops;
mod energy;
mod monotone;
mod slag;
mod units;
