//! Data sets with planted causes for `nearwall diagnose`, generated without the crate's own laws.
//!
//! - `cargo test --release --test planted_effects -- --nocapture diagnose` scores the command on all sets.
//! - `NEARWALL_PLANTED_OUT=DIR cargo test --release --test planted_effects -- --ignored write_sets` writes them.
//! - `cargo test --release --test planted_effects -- --nocapture situations` scores it on data as
//!   laboratories have them.
//!
//! `NEARWALL_TEST_SEED` repeats a run, `NEARWALL_PLANTED_SETS` multiplies the sets,
//! `NEARWALL_PLANTED_ONLY` selects some.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "clippy.toml's leave for tests does not reach their helpers"
)]

mod campaign;
mod check;
mod command;
mod contact;
mod gain;
mod gates;
mod groups;
mod migraine;
mod own_laws;
mod plant;
#[path = "../common/random.rs"]
mod random;
mod runner;
mod score;
mod set_rng;
mod sets;
mod situations;
mod world;

use std::path::Path;

use rayon::prelude::*;

/// The right cause first, no finding in null sets, errors near the attainable, intervals that cover, no crash.
#[test]
#[cfg_attr(
    debug_assertions,
    ignore = "minutes in a debug build: cargo test --release --test planted_effects -- --nocapture"
)]
fn diagnose_finds_what_is_planted() {
    let seed = random::seed();
    let one = |recipe: &sets::Recipe| runner::run(&recipe.make(seed), seed);
    let all: Vec<_> = sets::wanted().par_iter().map(one).collect();
    let failures = score::report(&all);
    assert!(failures.is_empty(), "NEARWALL_TEST_SEED={seed}\n{}", failures.join("\n"));
}

/// Writes every set to the folder `NEARWALL_PLANTED_OUT`.
#[test]
#[ignore = "writes files on request"]
fn write_sets() {
    let folder = std::env::var("NEARWALL_PLANTED_OUT").unwrap();
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder).unwrap();
    let seed = random::seed();
    for recipe in sets::wanted() {
        let set = recipe.make(seed);
        let file = |ending: &str| folder.join(format!("{}.{ending}", set.name.replace(':', "-")));
        std::fs::write(file("csv"), &set.csv).unwrap();
        std::fs::write(file("toml"), set.model()).unwrap();
        std::fs::write(file("truth.json"), serde_json::to_string_pretty(&set.truth()).unwrap()).unwrap();
        println!("{:45} {} rows, {}", set.name, set.rows.len(), set.truth()["gain_nats"]);
    }
}
