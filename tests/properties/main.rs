//! What holds for every model and impact, whatever its numbers: bounds, monotony, continuity, units, energy.
//!
//! Random cases are drawn and cut down by `proptest`. A failing test prints `NEARWALL_TEST_SEED=...`; the same variable in the
//! environment repeats the run: `NEARWALL_TEST_SEED=... cargo test --test properties`.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

#[path = "../common/mod.rs"]
mod common;

mod bits;
mod blocks;
mod bounds;
mod cases;
mod continuous;
mod energy;
mod monotone;
mod units;
