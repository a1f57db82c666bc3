//! Planted laws over dimensionless groups of drops, and thresholds of capture: whether the group, the form and its
//! numbers are found.
//!
//! Groups and forms are written here by hand, not taken from the library. Fresh rows go through the written model.

use std::fmt::Write;
use std::path::Path;

use rayon::prelude::*;
use serde_json::Value;

use crate::command::nearwall;
use crate::random;
use crate::set_rng::SetRng;

/// Density [kg/m³] and surface tension [N/m] of the liquid.
const DENSITY: f64 = 1000.0;
const SURFACE_TENSION: f64 = 0.03;
/// Fresh rows of each set.
const FRESH: usize = 500;

const BASE: &str = "[particle]\nmaterial = \"oil\"\n[materials.oil]\ndensity = 1000\nyoungs_modulus = 1e9\n\
    poisson_ratio = 0.3\nyield_strength = 1e8\nsurface_energy = 0.03\nsurface_tension = 0.03\nviscosity = 0.02\n\
    [walls.default]\nmaterial = \"pyrex\"\n[normal]\nmodel = \"constant\"\ne_n = 0.5\n\
    [tangential]\nmodel = \"constant\"\ne_t = 0.7\n";

/// One impact: speed [m/s], diameter [m], viscosity [Pa s].
#[derive(Clone, Copy)]
struct Drop([f64; 3]);

impl Drop {
    fn new(rng: &mut SetRng) -> Self {
        Self([(0.3, 10.0), (3e-5, 5e-4), (0.002, 0.2)].map(|range| rng.log_uniform(range)))
    }

    fn weber(self) -> f64 {
        let [v, d, _] = self.0;
        DENSITY * v * v * d / SURFACE_TENSION
    }

    fn reynolds(self) -> f64 {
        let [v, d, mu] = self.0;
        DENSITY * v * d / mu
    }

    /// The group with its middle.
    fn group(self, name: &str) -> [f64; 2] {
        let [v, d, mu] = self.0;
        match name {
            "We" => [self.weber(), 30.0],
            "Re" => [self.reynolds(), 60.0],
            "Oh" => [mu / (DENSITY * SURFACE_TENSION * d).sqrt(), 0.12],
            "Ca" => [mu * v / SURFACE_TENSION, 1.3],
            _ => [self.weber().sqrt() * self.reynolds().powf(0.25), 10.0],
        }
    }
}

const GROUPS: [&str; 5] = ["We", "Re", "Oh", "Ca", "K"];

/// A planted form over `x` with its middle, and its parameters by name.
type Planted = (&'static str, fn(f64, f64) -> f64, fn(f64) -> Vec<(&'static str, f64)>);

const FORMS: [Planted; 5] = [
    ("power", |x, m| 0.5 * (x / m).powf(-0.2), |m| vec![("a", 0.5 * m.powf(0.2)), ("b", -0.2)]),
    ("exponential", |x, m| 0.2 + 0.5 * (-x / m).exp(), |m| vec![("a", 0.5), ("x_0", m), ("floor", 0.2)]),
    ("logistic", |x, m| 0.2 + 0.5 / (1.0 + (x / m).powi(3)), |m| vec![("x_0", m)]),
    ("saturating", |x, m| 0.1 + 0.6 * x / (x + m), |m| vec![("a", 0.6), ("x_0", m), ("floor", 0.1)]),
    ("line", |x, m| 0.7 - 0.012 * x / m, |m| vec![("a", 0.7), ("b", -0.012 / m)]),
];

/// What a set plants.
#[derive(Clone, Copy)]
struct Recipe {
    /// Places in [`GROUPS`] and [`FORMS`]; `None` for a set without a dependence.
    planted: Option<[usize; 2]>,
    rows: usize,
    noise: f64,
    number: usize,
}

/// What the command says of a set.
#[derive(Default)]
struct Found {
    name: String,
    right: bool,
    honest: bool,
    /// Causes that are named, and those that stay open.
    said: String,
    /// Whether the form is the planted one or stays open; `None` without a form.
    form: Option<bool>,
    /// Parameters of the right form, and how many of them lie within their intervals.
    intervals: [usize; 2],
    /// Error on fresh rows over the noise.
    fresh: f64,
}

impl Recipe {
    fn e_n(self, drop: Drop) -> f64 {
        self.planted.map_or(0.5, |[group, form]| {
            let [x, middle] = drop.group(GROUPS[group]);
            FORMS[form].1(x, middle)
        })
    }

    fn name(self) -> String {
        let planted = self
            .planted
            .map_or("null".into(), |[group, form]| format!("{}-{}", GROUPS[group], FORMS[form].0));
        format!("{planted}:{}-rows-{}", self.rows, self.number)
    }

    fn table(self, drops: &[Drop], rng: &mut SetRng) -> String {
        let mut text = "v_n,d,mu_p,e_n\n".to_owned();
        for drop in drops {
            let [v, d, mu] = drop.0;
            writeln!(text, "{v:.6e},{d:.6e},{mu:.6e},{:.5}", self.e_n(*drop) + self.noise * rng.normal())
                .unwrap();
        }
        text
    }

    fn run(self, seed: u64) -> Found {
        let mut rng = SetRng::new(seed, &self.name());
        let mut drops = |count: usize| (0..count).map(|_| Drop::new(&mut rng)).collect::<Vec<Drop>>();
        let (measured, fresh) = (drops(self.rows), drops(FRESH));
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("data.csv"), self.table(&measured, &mut rng)).unwrap();
        let inputs =
            |line: &str| line.rsplit_once(',').map_or(String::new(), |(inputs, _)| format!("{inputs}\n"));
        let fresh_inputs: String = self.table(&fresh, &mut rng).lines().map(inputs).collect();
        std::fs::write(folder.path().join("fresh.csv"), fresh_inputs).unwrap();
        let diagnosis = diagnose(folder.path());
        let truth: Vec<f64> = fresh.iter().map(|drop| self.e_n(*drop)).collect();
        self.judged(&diagnosis, error(folder.path(), &truth) / self.noise)
    }

    fn judged(self, diagnosis: &Value, apart: f64) -> Found {
        let causes = names(&diagnosis["findings"]);
        let open = diagnosis["undecided"].as_array().map_or(0, Vec::len);
        let said = format!("named {causes:?}, open {}", diagnosis["undecided"]);
        let mut found =
            Found { name: self.name(), said, fresh: (1.0 + apart * apart).sqrt(), ..Found::default() };
        let Some([group, form]) = self.planted else {
            found.right = causes.is_empty() && open == 0;
            return found;
        };
        let cause = format!("unknown:{}", GROUPS[group]);
        let undecided = diagnosis["undecided"].to_string();
        found.right = causes == [cause.as_str()];
        found.honest = causes.is_empty() && undecided.contains(&cause);
        let said = &diagnosis["findings"][0]["forms"][0];
        let is = |one: &Value| one["form"] == FORMS[form].0;
        let others = said["others"].as_array().into_iter().flatten();
        found.form = said["form"].is_string().then(|| is(said) || others.into_iter().any(is));
        if found.right && is(said) {
            found.intervals =
                covered(&said["parameters"], &FORMS[form].2(Drop([1.0; 3]).group(GROUPS[group])[1]));
        }
        found
    }
}

/// How many parameters are stated, and how many intervals of them hold the planted value.
fn covered(parameters: &Value, planted: &[(&str, f64)]) -> [usize; 2] {
    let mut counts = [0; 2];
    for (name, value) in planted {
        let end = |end: &str| parameters[*name][end].as_f64();
        let Some((low, high)) = end("low").zip(end("high")) else { continue };
        counts[0] += 1;
        counts[1] += usize::from((low..=high).contains(value));
    }
    counts
}

fn diagnose(folder: &Path) -> Value {
    std::fs::write(folder.join("base.toml"), BASE).unwrap();
    let output = nearwall(folder, &["diagnose", "data.csv", "--model", "base.toml", "--out", "out"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_str(&std::fs::read_to_string(folder.join("out/diagnosis.json")).unwrap()).unwrap()
}

fn names(findings: &Value) -> Vec<&str> {
    findings.as_array().into_iter().flatten().filter_map(|one| one["cause"].as_str()).collect()
}

/// Root mean square distance of the written model from the planted law on the fresh rows.
fn error(folder: &Path, truth: &[f64]) -> f64 {
    let output = nearwall(folder, &["predict", "--model", "out/extended.toml", "fresh.csv"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mut table = csv::Reader::from_reader(output.stdout.as_slice());
    let place = table.headers().unwrap().iter().position(|name| name == "e_n").unwrap();
    let predicted: Vec<f64> = table.records().map(|row| row.unwrap()[place].parse().unwrap()).collect();
    assert_eq!(predicted.len(), truth.len());
    let squares = predicted.iter().zip(truth).map(|(one, truth)| (one - truth).powi(2));
    (squares.sum::<f64>() / truth.len() as f64).sqrt()
}

/// Sets of every group and form in a run. About 95 % of them come close to the noise, and 94 % of the intervals hold: with
/// one set of each, chance alone puts one run in twenty below the 85 % that are demanded; with three, one in a thousand.
const REPEATS: usize = 3;

/// The sets of this run.
fn recipes() -> Vec<Recipe> {
    let repeats = std::env::var("NEARWALL_PLANTED_SETS").map_or(1, |count| count.parse().unwrap());
    let mut all = vec![];
    for number in 0..REPEATS * repeats {
        for group in 0..GROUPS.len() {
            for form in 0..FORMS.len() {
                let (rows, noise) =
                    ([100, 300][(group + form + number) % 2], [0.02, 0.06][(form + number) % 2]);
                all.push(Recipe { planted: Some([group, form]), rows, noise, number });
            }
        }
        // A set is drawn by its name: two of the same would be one set that counts twice.
        let null = |(place, rows)| Recipe { planted: None, rows, noise: 0.05, number: 3 * number + place };
        all.extend([100, 300, 300].into_iter().enumerate().map(null));
    }
    all
}

/// The group is named, its form is right or left open, fresh rows and intervals hold, and nulls stay silent.
#[test]
#[cfg_attr(
    debug_assertions,
    ignore = "minutes in a debug build: cargo test --release --test planted_effects -- --nocapture diagnose_finds_groups"
)]
fn diagnose_finds_groups_and_forms() {
    let seed = random::seed();
    let all: Vec<(Recipe, Found)> = recipes().into_par_iter().map(|one| (one, one.run(seed))).collect();
    let (planted, nulls): (Vec<_>, Vec<_>) = all.iter().partition(|(recipe, _)| recipe.planted.is_some());
    let count = |is: fn(&Found) -> bool| planted.iter().filter(|(_, found)| is(found)).count();
    let (right, honest) = (count(|one| one.right), count(|one| one.honest));
    let (forms, open) = (count(|one| one.form.is_some()), count(|one| one.form == Some(true)));
    let close = count(|one| !one.right || one.fresh <= 1.1);
    let intervals =
        planted.iter().fold([0; 2], |[a, b], (_, one)| [a + one.intervals[0], b + one.intervals[1]]);
    let silent = nulls.iter().filter(|(_, found)| found.right).count();
    println!("right cause: {right} of {} groups, {honest} left open", planted.len());
    println!("right cause: form right or open in {open} of {forms}");
    println!("held-out error: at most 1.1 times the noise in {close} of {}", planted.len());
    println!("intervals hold: {} of {}", intervals[1], intervals[0]);
    println!("silent on: {silent} of {} null sets", nulls.len());
    for (_, found) in all.iter().filter(|(_, one)| !one.right || one.fresh > 1.1 || one.form == Some(false)) {
        let Found { name, said, form, fresh, .. } = found;
        println!("   {name}: {said}, form {form:?}, error {fresh:.2} times the noise");
    }
    let share = |part: usize, of: usize| part as f64 / of.max(1) as f64;
    assert!(share(right, planted.len()) >= 0.8, "NEARWALL_TEST_SEED={seed}");
    assert!(share(right + honest, planted.len()) >= 0.9, "NEARWALL_TEST_SEED={seed}");
    assert!(share(open, forms) >= 0.85 && share(close, planted.len()) >= 0.85, "NEARWALL_TEST_SEED={seed}");
    assert!(
        share(intervals[1], intervals[0]) >= 0.85 && silent + 1 >= nulls.len(),
        "NEARWALL_TEST_SEED={seed}"
    );
}

/// The captures of a file that are exactly its lowest Weber numbers: `captures` of `rows`.
fn lowest_captured(rows: usize, captures: usize, rng: &mut SetRng) -> String {
    let drop = |rng: &mut SetRng| Drop([rng.log_uniform((0.05, 3.0)), rng.log_uniform((3e-4, 3e-3)), 0.02]);
    let drops: Vec<Drop> = (0..rows).map(|_| drop(rng)).collect();
    let mut sorted: Vec<f64> = drops.iter().map(|drop| drop.weber()).collect();
    sorted.sort_by(f64::total_cmp);
    let mut text = "v_n,d,e_n,outcome\n".to_owned();
    for drop in &drops {
        let [v, d, _] = drop.0;
        let e_n = 0.85 * drop.weber().max(0.05).powf(-0.05) + 0.03 * rng.normal();
        let outcome =
            if drop.weber() < sorted[captures] { ",stick".to_owned() } else { format!("{e_n:.4},rebound") };
        writeln!(text, "{v:.6e},{d:.6e},{outcome}").unwrap();
    }
    text
}

/// Seven captures of 174 show a threshold over Weber's number, and the model file has it. At one viscosity `K` orders
/// speed and size nearly as Weber's number does, so that about half of the sets cannot tell them and must say so.
#[test]
#[cfg_attr(
    debug_assertions,
    ignore = "minutes in a debug build: cargo test --release --test planted_effects -- --nocapture diagnose_finds_thresholds"
)]
fn diagnose_finds_thresholds_of_few_captures() {
    let seed = random::seed();
    let one = |number: usize| {
        let mut rng = SetRng::new(seed, &format!("threshold:{number}"));
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("data.csv"), lowest_captured(174, 7, &mut rng)).unwrap();
        let diagnosis = diagnose(folder.path());
        let forms = diagnosis["findings"][0]["forms"].as_array().cloned().unwrap_or_default();
        let is_open = diagnosis["undecided"].to_string().contains("unknown:We");
        let named = names(&diagnosis["findings"]).contains(&"unknown:We");
        let has_threshold =
            forms.iter().any(|form| form["observable"] == "outcome" && form["form"] == "logistic");
        [named && has_threshold, is_open]
    };
    let all: Vec<[bool; 2]> = (0..16).into_par_iter().map(one).collect();
    let found = all.iter().filter(|one| one[0]).count();
    let open = all.iter().filter(|one| one[1]).count();
    println!("right cause: {found} of 16 thresholds of seven captures, {open} left open");
    assert!(found >= 2 && found + open >= 13, "NEARWALL_TEST_SEED={seed}");
}

/// What products of columns plant: the name of the product, and `e_n` over size, gap [m], speed [m/s] and time [s].
type PlantedProduct = (&'static str, fn([f64; 4]) -> f64);

const PRODUCTS: [PlantedProduct; 3] = [
    ("unknown:d/gap", |[d, gap, _, _]| 0.3 + 0.4 * d / (d + 8.0 * gap)),
    ("unknown:v_n tau/d", |[d, _, v, tau]| 0.35 + 0.35 * (-v * tau / d / 2.0).exp()),
    ("", |_| 0.5),
];

/// Columns in the units of a laboratory: one product of three columns orders the rows, or nothing does.
fn product_table(law: fn([f64; 4]) -> f64, rows: usize, noise: f64, rng: &mut SetRng) -> (String, Vec<f64>) {
    let mut text = "v_n,d (um),gap [um],tau [us],humidity [%],e_n\n".to_owned();
    let mut truth = Vec::new();
    for _ in 0..rows {
        let [v, d, gap, tau] =
            [(0.5, 10.0), (30.0, 300.0), (1.0, 40.0), (5.0, 200.0)].map(|r| rng.log_uniform(r));
        truth.push(law([1e-6 * d, 1e-6 * gap, v, 1e-6 * tau]));
        let e_n = truth[truth.len() - 1] + noise * rng.normal();
        writeln!(text, "{v:.6e},{d:.6e},{gap:.6e},{tau:.6e},{:.3},{e_n:.5}", rng.log_uniform((20.0, 60.0)))
            .unwrap();
    }
    (text, truth)
}

/// A product of columns with units is found, runs in `predict`, and is not seen where there is none.
#[test]
#[cfg_attr(
    debug_assertions,
    ignore = "minutes in a debug build: cargo test --release --test planted_effects -- --nocapture diagnose_finds_products"
)]
fn diagnose_finds_products_of_columns() {
    let seed = random::seed();
    let noise = 0.03;
    let one = |number: usize| {
        let (name, law) = PRODUCTS[number % PRODUCTS.len()];
        let mut rng = SetRng::new(seed, &format!("product:{number}"));
        let folder = tempfile::tempdir().unwrap();
        let write = |file: &str, text: String| std::fs::write(folder.path().join(file), text).unwrap();
        write("data.csv", product_table(law, 150, noise, &mut rng).0);
        let (fresh, truth) = product_table(law, FRESH, 0.0, &mut rng);
        // Of rows with a measured value `predict` repeats it.
        let without =
            |line: &str| line.rsplit_once(',').map_or(String::new(), |(inputs, _)| format!("{inputs}\n"));
        write("fresh.csv", fresh.lines().map(without).collect());
        let diagnosis = diagnose(folder.path());
        let found = names(&diagnosis["findings"]);
        let right = if name.is_empty() { found.is_empty() } else { found == [name] };
        if !right {
            println!("   set {number}: {found:?} in place of {name:?}");
        }
        let apart = error(folder.path(), &truth) / noise;
        (right, (1.0 + apart * apart).sqrt())
    };
    let all: Vec<(bool, f64)> = (0..12).into_par_iter().map(one).collect();
    let right = all.iter().filter(|(right, _)| *right).count();
    let close = all.iter().filter(|(right, apart)| !right || *apart <= 1.1).count();
    println!(
        "right cause: {right} of 12 products of columns and nulls; error at most 1.1 times the noise in {close}"
    );
    assert!(right >= 10 && close >= 10, "NEARWALL_TEST_SEED={seed}");
}
