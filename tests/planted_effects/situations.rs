//! Situations of a laboratory: few averages, weak effects, nulls of every kind, slips, captures, two laboratories.
//!
//! - `cargo test --release --test planted_effects -- --nocapture situations` prints situation by
//!   situation what is said.
//! - `NEARWALL_PLANTED_OUT=DIR cargo test --release --test planted_effects -- --ignored
//!   write_situations` writes the sets.
//!
//! `NEARWALL_COVERAGE_SETS` is the number of sets whose law is the library's own, for the coverage of intervals.

mod captures;
mod check;
mod exact;
mod expected;
mod few;
mod file;
mod judge;
mod lab;
mod mixtures;
mod nulls;
mod oracle;
mod run;
mod set;
mod slips;
mod table;
mod unknown_laws;
mod weak;

use std::path::Path;
use std::sync::Arc;

use rayon::prelude::*;

use crate::random;
use crate::set_rng::SetRng;
use crate::sets::is_wanted;
use set::{Plan, PlanOf, Recipe};

/// Name, sets and plan of a situation.
type Situation = (&'static str, usize, fn(usize, &mut SetRng) -> Plan);

const SITUATIONS: [Situation; 37] = [
    ("few-null", 5, few::null),
    ("few-level", 5, few::level),
    ("few-angle", 5, few::angle),
    ("few-size", 4, few::size),
    ("few-layer", 6, few::layer),
    ("few-temperature", 4, few::temperature),
    ("weak-humidity", 6, weak::humidity),
    ("weak-operator", 6, weak::operator),
    ("weak-capture-by-layer", 6, weak::capture_by_layer),
    ("law-rise", 2, unknown_laws::rise),
    ("law-hump", 2, unknown_laws::hump),
    ("law-friction", 2, unknown_laws::friction),
    ("law-product", 2, unknown_laws::product),
    ("null-clean", 3, nulls::clean),
    ("null-bursts", 4, nulls::bursts),
    ("null-days", 3, nulls::days),
    ("null-repeated", 3, nulls::repeated),
    ("null-input-errors", 3, nulls::input_errors),
    ("null-truncated", 3, nulls::truncated),
    ("null-truncated-stated", 3, nulls::truncated_stated),
    ("null-skewed", 4, nulls::skewed),
    ("null-rounded", 3, nulls::rounded),
    ("null-drift", 3, nulls::drift),
    ("null-heavy-tails", 3, nulls::heavy_tails),
    ("null-growing-noise", 3, nulls::growing),
    ("null-laboratories", 3, nulls::laboratories),
    ("null-20-columns", 3, nulls::irrelevant),
    ("null-classes", 3, captures::null),
    ("slip-density", 2, slips::density),
    ("slip-modulus", 2, slips::modulus),
    ("slip-radius", 2, slips::radius),
    ("slip-speed", 2, slips::speed),
    ("slip-angle", 2, slips::angle),
    ("slip-celsius", 2, slips::celsius),
    ("slip-energy", 2, slips::energy),
    ("agglomerates", 3, mixtures::agglomerates),
    ("two-causes", 4, mixtures::two_causes),
];

const CAPTURES: [Situation; 4] = [
    ("capture-energy", 4, captures::energy),
    ("capture-layer", 4, captures::layer),
    ("capture-temperature", 4, captures::temperature),
    ("two-laboratories", 4, mixtures::laboratories),
];

/// The sets of every situation that this run is asked for.
fn wanted() -> Vec<Recipe> {
    let number = |name: &str| std::env::var(name).ok().map(|count| count.parse::<usize>().unwrap());
    let repeats = number("NEARWALL_PLANTED_SETS").unwrap_or(1);
    let own = number("NEARWALL_COVERAGE_SETS").map_or(2 * repeats, |sets| sets.div_ceil(exact::CAUSES.len()));
    let mut all: Vec<Recipe> = vec![];
    let mut add = |name: &str, count: usize, plan: PlanOf| {
        all.extend((0..count).map(|index| Recipe::new(name, index, plan.clone())));
    };
    for (name, count, plan) in SITUATIONS.iter().chain(&CAPTURES) {
        add(name, count * repeats, Arc::new(plan));
    }
    for effect in weak::EFFECTS {
        let plan = move |index, rng: &mut SetRng| weak::known(effect, index, rng);
        add(&format!("weak-{effect}"), 6 * repeats, Arc::new(plan));
    }
    for cause in exact::CAUSES {
        let plan = move |index, rng: &mut SetRng| exact::plan(cause, index, rng);
        add(&format!("own-{}", cause.rsplit(':').next().unwrap()), own, Arc::new(plan));
    }
    all.retain(|recipe| is_wanted(&recipe.name));
    all
}

/// Right or honest, silent on every null, and gains that the written model keeps.
#[test]
#[cfg_attr(
    debug_assertions,
    ignore = "minutes in a debug build: cargo test --release --test planted_effects -- --nocapture situations"
)]
fn diagnoses_hold_in_a_laboratory() {
    let seed = random::seed();
    let one = |recipe: &Recipe| {
        let set = recipe.make(seed);
        let judged = judge::judge(&set, &run::run(&set, seed));
        println!("{:?} {} {:.1} s", judged.verdict, judged.name, judged.seconds);
        judged
    };
    let all: Vec<_> = wanted().par_iter().map(one).collect();
    let failures = table::report(&all);
    assert!(failures.is_empty(), "NEARWALL_TEST_SEED={seed}\n{}", failures.join("\n"));
}

/// Writes every set to the folder `NEARWALL_PLANTED_OUT`: data, base model, column map, truth and fresh rows.
#[test]
#[ignore = "writes files on request"]
fn write_situations() {
    let folder = std::env::var("NEARWALL_PLANTED_OUT").unwrap();
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder).unwrap();
    let seed = random::seed();
    for recipe in wanted() {
        let set = recipe.make(seed);
        let write = |ending: &str, text: &str| {
            std::fs::write(folder.join(format!("{}.{ending}", set.name.replace(':', "-"))), text).unwrap();
        };
        write("csv", &set.data);
        write("fresh.csv", &set.fresh_data);
        write("toml", &set.model);
        write("truth.json", &serde_json::to_string_pretty(&set.truth()).unwrap());
        set.map.iter().for_each(|map| write("map.toml", map));
    }
}
