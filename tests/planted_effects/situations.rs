//! Situations of a laboratory: few averages, weak effects, nulls of every kind, instruments, slips, captures.
//!
//! - `cargo test --release --test planted_effects -- --nocapture situations` prints situation by
//!   situation what is said.
//! - `NEARWALL_PLANTED_OUT=DIR cargo test --release --test planted_effects -- --ignored
//!   write_situations` writes the sets.
//!
//! A run takes every third set, and the seed says which ones; `NEARWALL_PLANTED_SETS=1` takes all of them.
//! `NEARWALL_COVERAGE_SETS` is the number of sets whose law is the library's own, for the coverage of intervals.
//! `NEARWALL_PLANTED_TABLE` names a file to which each set adds a line, to compare two commands set by set.

mod advice;
mod captures;
mod check;
mod dependent;
mod exact;
mod expected;
mod few;
mod file;
mod instrument;
mod judge;
mod lab;
mod missing;
mod mixtures;
mod nulls;
mod oracle;
mod probabilities;
mod rubbish;
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
use judge::Verdict;
use set::{Plan, PlanOf, Recipe};

/// Name, sets and plan of a situation.
type Situation = (&'static str, usize, fn(usize, &mut SetRng) -> Plan);

/// Sets of a run that multiplies nothing.
const SITUATIONS: [Situation; 74] = [
    ("few-null", 3, few::null),
    ("few-level", 3, few::level),
    ("few-angle", 3, few::angle),
    ("few-size", 2, few::size),
    ("few-layer", 3, few::layer),
    ("few-temperature", 2, few::temperature),
    ("few-twelve-shots", 2, few::twelve),
    ("weak-humidity", 3, weak::humidity),
    ("weak-operator", 3, weak::operator),
    ("weak-capture-by-layer", 3, weak::capture_by_layer),
    ("law-rise", 1, unknown_laws::rise),
    ("law-hump", 1, unknown_laws::hump),
    ("law-friction", 1, unknown_laws::friction),
    ("law-product", 1, unknown_laws::product),
    ("law-charge", 1, unknown_laws::charge),
    ("law-granular-bed", 1, unknown_laws::granular_bed),
    ("null-clean", 2, nulls::clean),
    ("null-bursts", 2, nulls::bursts),
    ("null-days", 2, nulls::days),
    ("null-repeated", 2, nulls::repeated),
    ("null-input-errors", 2, nulls::input_errors),
    ("null-input-errors-unstated", 2, nulls::unstated_input_errors),
    ("null-truncated", 2, nulls::truncated),
    ("null-truncated-stated", 2, nulls::truncated_stated),
    ("null-skewed", 2, nulls::skewed),
    ("null-rounded", 2, nulls::rounded),
    ("null-drift", 2, nulls::drift),
    ("null-heavy-tails", 2, nulls::heavy_tails),
    ("null-growing-noise", 2, nulls::growing),
    ("null-laboratories", 2, nulls::laboratories),
    ("null-20-columns", 2, nulls::irrelevant),
    ("null-classes", 2, captures::null),
    ("null-swept", 2, dependent::swept),
    ("null-bursts-unlabelled", 1, dependent::bursts),
    ("null-three-readings", 1, dependent::three_readings),
    ("null-blocks", 2, dependent::blocks),
    ("null-measured-on", 1, dependent::measured_on),
    ("null-rubbish", 1, rubbish::null),
    ("null-everything", 1, rubbish::everything),
    ("null-blank", 2, missing::null),
    ("null-merged-cells", 1, missing::merged_captures),
    ("merged-melting", 1, missing::merged_melting),
    ("blank-melting", 1, missing::melting),
    ("rebounds-only", 2, missing::rebounds_only),
    ("rubbish-law", 1, rubbish::law),
    ("instrument-tilt", 2, instrument::tilted),
    ("instrument-drag", 1, instrument::drag),
    ("instrument-drift", 2, instrument::drift),
    ("sorted-by-speed", 2, instrument::sorted),
    ("instrument-noted-as-stuck", 1, instrument::noted_as_stuck),
    ("instrument-unseen", 1, instrument::unseen),
    ("instrument-projection", 1, instrument::projected),
    ("instrument-bias-and-law", 2, instrument::bias),
    ("instrument-tilt-and-law", 4, instrument::tilted_law),
    ("instrument-drag-and-law", 2, instrument::dragged_law),
    ("instrument-unseen-and-law", 2, instrument::unseen_law),
    ("slip-density", 1, slips::density),
    ("slip-modulus", 1, slips::modulus),
    ("slip-radius", 1, slips::radius),
    ("slip-speed", 1, slips::speed),
    ("slip-angle", 1, slips::angle),
    ("slip-celsius", 1, slips::celsius),
    ("slip-energy", 1, slips::energy),
    ("slip-harmless", 2, slips::harmless),
    ("agglomerates", 2, mixtures::agglomerates),
    ("two-causes", 2, mixtures::two_causes),
    ("three-causes", 2, mixtures::three_causes),
    ("capture-energy", 2, captures::energy),
    ("capture-layer", 2, captures::layer),
    ("capture-temperature", 2, captures::temperature),
    ("capture-ceiling", 2, captures::missed_beside_a_law),
    ("null-ceiling", 2, captures::missed_alone),
    ("capture-saturated", 2, captures::saturated),
    ("two-laboratories", 2, mixtures::laboratories),
];

/// Sets of each weak effect and of each of the library's own laws.
const WEAK: usize = 3;
const OWN: usize = 2;

/// Name, sets and plan of every situation.
fn situations() -> Vec<(String, usize, PlanOf)> {
    let mut all: Vec<(String, usize, PlanOf)> = vec![];
    for (name, count, plan) in SITUATIONS {
        all.push((name.into(), count, Arc::new(plan)));
    }
    for effect in weak::EFFECTS {
        let plan = move |index, rng: &mut SetRng| weak::known(effect, index, rng);
        all.push((format!("weak-{effect}"), WEAK, Arc::new(plan)));
    }
    for cause in exact::CAUSES {
        let plan = move |index, rng: &mut SetRng| exact::plan(cause, index, rng);
        all.push((format!("own-{}", cause.rsplit(':').next().unwrap()), OWN, Arc::new(plan)));
    }
    all
}

/// The sets of every situation that this run is asked for.
fn wanted() -> Vec<Recipe> {
    let number = |name: &str| std::env::var(name).ok().map(|count| count.parse::<usize>().unwrap());
    let repeats = number("NEARWALL_PLANTED_SETS").unwrap_or(1);
    let own = number("NEARWALL_COVERAGE_SETS").map(|sets| sets.div_ceil(exact::CAUSES.len()));
    let mut all: Vec<Recipe> = vec![];
    for (name, count, plan) in situations() {
        let own = own.filter(|_| name.starts_with("own-"));
        all.extend((0..own.unwrap_or(count * repeats)).map(|index| Recipe::new(&name, index, plan.clone())));
    }
    all.retain(|recipe| is_wanted(&recipe.name));
    all
}

/// Every third set, or all that are asked for.
fn of_this_run(seed: u64) -> Vec<Recipe> {
    let asked = ["NEARWALL_PLANTED_SETS", "NEARWALL_PLANTED_ONLY", "NEARWALL_COVERAGE_SETS"];
    let all_of_them = asked.iter().any(|name| std::env::var_os(name).is_some());
    let taken = |place: u64| all_of_them || (place + seed % 3).is_multiple_of(3);
    (0..).zip(wanted()).filter(|(place, _)| taken(*place)).map(|(_, recipe)| recipe).collect()
}

/// Right or honest, silent on every null, and gains that the written model keeps.
#[test]
#[cfg_attr(
    debug_assertions,
    ignore = "minutes in a debug build: cargo test --release --test planted_effects -- --nocapture situations"
)]
fn diagnoses_hold_in_a_laboratory() {
    let seed = random::seed();
    let lines = table::Lines::new();
    let one = |recipe: &Recipe| {
        let set = recipe.make(seed);
        let judged = judge::judge(&set, &run::run(&set, seed));
        println!("{:?} {} {:.1} s", judged.verdict, judged.name, judged.seconds);
        lines.add(&judged);
        judged
    };
    let all: Vec<_> = of_this_run(seed).par_iter().map(one).collect();
    let failures = table::report(&all);
    assert!(failures.is_empty(), "NEARWALL_TEST_SEED={seed}\n{}", failures.join("\n"));
}

/// Two sets on which lift of the gas was named for what a smooth remainder over its inputs gained from the noise.
#[test]
#[cfg_attr(debug_assertions, ignore = "slow in a debug build, as all situations")]
fn diagnoses_hold_where_a_remainder_gains() {
    let seed = 20_261_130_001;
    for wanted in ["own-tangential.e_t", "capture-temperature"] {
        let (name, _, plan) = situations().into_iter().find(|(name, ..)| name == wanted).unwrap();
        let set = Recipe::new(&name, 0, plan).make(seed);
        let judged = judge::judge(&set, &run::run(&set, seed));
        assert!(judged.verdict != Verdict::False, "{}: {:?}", judged.name, judged.verdict);
    }
}

/// The advice on what to measure next names the law with fewer shots than even shots.
#[test]
#[ignore = "minutes: cargo test --release --test planted_effects -- --nocapture --ignored advice_names"]
fn advice_names_the_law() {
    let seed = random::seed();
    let all = advice::compare(seed, 24, 64);
    let named = [0, 1].map(|design| all.iter().filter(|one| one.needed[design].is_some()).count());
    println!("of {} laboratories the advice decides {}, even shots {}", all.len(), named[0], named[1]);
    all.iter().for_each(|one| println!("| {} | {:?} | {:?} |", one.name, one.needed[0], one.needed[1]));
    assert!(named[0] >= named[1], "NEARWALL_TEST_SEED={seed}");
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
