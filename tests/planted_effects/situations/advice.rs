//! Following the advice on what to measure next names the planted law with fewer shots than even shots.
//!
//! Both laboratories begin with the same few shots from the middle of their ranges, which leave the law
//! open. In every round they then take the same number of shots: one at the two values of the inputs
//! that the diagnosis advises, everything else in the middle, the other spread over all ranges. A
//! laboratory stops when the diagnosis names the planted law, and it alone.

use std::path::Path;

use rayon::prelude::*;
use serde_json::Value;

use crate::campaign::Campaign;
use crate::command::nearwall;
use crate::set_rng::SetRng;
use crate::world::Inputs;

use super::exact::{self, CAUSES};
use super::file;
use super::lab::{Lab, Row};

/// Shots that both begin with, and of each round; and rounds.
const FIRST: usize = 12;
const SHOTS: usize = 12;
const ROUNDS: usize = 3;
/// Part of each range in which the first shots lie.
const MIDDLE: (f64, f64) = (0.35, 0.65);

/// How a laboratory chooses what to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Design {
    Advice,
    Even,
}

/// What both laboratories needed: shots until the law is named, if it is.
pub struct Comparison {
    pub name: String,
    pub needed: [Option<usize>; 2],
}

/// Laboratories whose first shots leave the law open, so many of the first `most`.
pub fn compare(seed: u64, wanted: usize, most: usize) -> Vec<Comparison> {
    let one = |number: usize| {
        let cause = CAUSES[number % CAUSES.len()];
        let name = format!("advice-{cause}#{number}");
        let mut rng = SetRng::new(seed, &name);
        let mut lab = exact::plan(cause, number, &mut rng).lab;
        lab.campaign.columns.retain(|column| *column == "layer_thickness");
        lab.campaign.extras.clear();
        let start = Start { name, cause, rows: first(&mut lab, &mut rng), lab };
        let said = start.diagnose(&start.rows)?;
        (!start.is_named(&said)).then(|| {
            let needed = [Design::Advice, Design::Even].map(|design| start.follow(design, &said, seed));
            println!("{}: {needed:?}", start.name);
            Comparison { name: start.name.clone(), needed }
        })
    };
    let mut all: Vec<Comparison> = (0..most).into_par_iter().filter_map(one).collect();
    all.truncate(wanted);
    all
}

/// The first shots.
fn first(lab: &mut Lab, rng: &mut SetRng) -> Vec<Row> {
    let whole = lab.campaign.clone();
    for range in ranges(&mut lab.campaign) {
        let (low, high) = *range;
        *range = (low + MIDDLE.0 * (high - low), low + MIDDLE.1 * (high - low));
    }
    let rows = lab.rows(FIRST, rng);
    lab.campaign = whole;
    rows
}

fn ranges(campaign: &mut Campaign) -> [&mut (f64, f64); 5] {
    [&mut campaign.v_n, &mut campaign.theta, &mut campaign.d, &mut campaign.t_p, &mut campaign.layer]
}

/// A laboratory with its first shots.
struct Start {
    name: String,
    cause: &'static str,
    lab: Lab,
    rows: Vec<Row>,
}

impl Start {
    /// The ranges that it states, as options.
    fn reach(&self) -> Vec<String> {
        let Campaign { v_n, theta, d, t_p, layer, columns, .. } = &self.lab.campaign;
        let tangent = |degrees: f64| degrees.to_radians().tan();
        let v_t = (v_n.0 * tangent(theta.0), v_n.1 * tangent(theta.1));
        let mut all = vec![("v_n", *v_n), ("v_t", v_t), ("d", *d), ("T_p", *t_p)];
        all.extend(columns.first().map(|column| (*column, *layer)));
        let varies = all.into_iter().filter(|(_, (low, high))| low < high);
        varies
            .flat_map(|(name, (low, high))| ["--reach".to_owned(), format!("{name}={low}:{high}")])
            .collect()
    }

    fn diagnose(&self, rows: &[Row]) -> Option<Value> {
        let folder = tempfile::tempdir().unwrap();
        let mut rng = SetRng::new(1, &self.name);
        let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
        write("data.csv", &file::measurements(&self.lab, rows, &mut rng));
        write("base.toml", &file::model(&self.lab));
        let reach = self.reach();
        let mut arguments = vec!["diagnose", "data.csv", "--model", "base.toml", "--out", "out"];
        arguments.extend(reach.iter().map(String::as_str));
        let output = nearwall(folder.path(), &arguments);
        assert!(output.status.success(), "{}: {}", self.name, String::from_utf8_lossy(&output.stderr));
        read(folder.path())
    }

    /// Whether the planted law is named, and it alone.
    fn is_named(&self, said: &Value) -> bool {
        let list = |key: &str| said[key].as_array().cloned().unwrap_or_default();
        let findings = list("findings");
        let named = findings.iter().filter_map(|one| one["cause"].as_str().map(str::to_owned));
        let changed = list("calibration");
        let changed = changed.iter().filter_map(|one| Some(format!("calibration:{}", one["key"].as_str()?)));
        named.chain(changed).collect::<Vec<_>>() == [self.cause]
    }

    /// Shots after the first ones until the law is named.
    fn follow(&self, design: Design, said: &Value, seed: u64) -> Option<usize> {
        let mut rng = SetRng::new(seed, &format!("{}-{design:?}", self.name));
        let (mut rows, mut said) = (self.rows.clone(), said.clone());
        for round in 1..=ROUNDS {
            let advised = if design == Design::Advice { advice(&said) } else { vec![] };
            let until = rows.len() + SHOTS;
            while rows.len() < until {
                let mut x = self.lab.campaign.inputs(&mut rng);
                if !advised.is_empty() {
                    let (input, ends) = &advised[rows.len() / 2 % advised.len()];
                    x = with(middle(&self.rows), input, ends[rows.len() % 2]);
                }
                rows.extend(self.lab.measure(x, [0.0; 2], &mut rng));
            }
            said = self.diagnose(&rows)?;
            if self.is_named(&said) {
                return Some(round * SHOTS);
            }
        }
        None
    }
}

fn read(folder: &Path) -> Option<Value> {
    serde_json::from_str(&std::fs::read_to_string(folder.join("out/diagnosis.json")).ok()?).ok()
}

/// The inputs to vary and the two values of each.
fn advice(said: &Value) -> Vec<(String, [f64; 2])> {
    let all = [&said["measure_next"], &said["findings"][0]["measure_next"]];
    let all = all.into_iter().flat_map(|list| list.as_array().into_iter().flatten());
    let one = |one: &Value| {
        let ends = [one["range"][0].as_f64()?, one["range"][1].as_f64()?];
        Some((one["vary"].as_str()?.to_owned(), ends))
    };
    all.filter_map(one).collect()
}

/// The middle of some shots.
fn middle(rows: &[Row]) -> Inputs {
    let median = |of: fn(&Inputs) -> f64| {
        let mut values: Vec<f64> = rows.iter().map(|row| of(&row.x)).collect();
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let [v_n, v_t, d] = [median(|x| x.v_n), median(|x| x.v_t), median(|x| x.d)];
    Inputs { v_n, v_t, d, t_p: median(|x| x.t_p), layer: median(|x| x.layer), ..rows[0].x }
}

/// Inputs with another value of one of them.
fn with(x: Inputs, input: &str, value: f64) -> Inputs {
    match input {
        "v_n" => Inputs { v_n: value, ..x },
        "v_t" => Inputs { v_t: value, ..x },
        "d" => Inputs { d: value, ..x },
        "T_p" => Inputs { t_p: value, ..x },
        "layer_thickness" => Inputs { layer: value, ..x },
        _ => panic!("{input} was not offered"),
    }
}
