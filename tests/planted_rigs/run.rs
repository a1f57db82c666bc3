//! Runs the command on a set, and the models that it writes on fresh experiments.

use std::path::{Path, PathBuf};
use std::process::Output;
use std::time::Instant;

use serde_json::Value;

use crate::campaign;
use crate::command::nearwall;
use crate::lab::{Experiment, Lab};
use crate::rig::{Hit, Rig, Track};
use crate::set_rng::SetRng;
use crate::sets::{PREDICTED, Set};
use crate::source::{Knob, Particle};

/// Particles in the case file.
const CASE_COUNT: usize = 500;
/// Models drawn from the fit.
const DRAWS: usize = 39;

/// What the command said.
pub struct Answer {
    pub diagnosis: Result<Value, String>,
    pub seconds: f64,
    /// Predictions of the fresh experiments' readings by the extended model.
    pub predicted: Option<Vec<Vec<f64>>>,
    /// The truth from the same particles as `predicted`.
    pub truth: Vec<Vec<f64>>,
    /// The same as `predicted` by each drawn model, in rigs of one impact.
    pub bands: Vec<Vec<Vec<f64>>>,
}

/// The folder of a set: kept below `NEARWALL_RIGS_OUT`, if that is set.
pub struct Folder {
    pub path: PathBuf,
    _temporary: Option<tempfile::TempDir>,
}

impl Folder {
    pub fn of(name: &str) -> Self {
        let Some(out) = std::env::var_os("NEARWALL_RIGS_OUT") else {
            let temporary = tempfile::tempdir().unwrap();
            return Self { path: temporary.path().into(), _temporary: Some(temporary) };
        };
        let path = Path::new(&out).join(name);
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).unwrap();
        Self { path, _temporary: None }
    }
}

/// Writes the set, has it diagnosed, and predicts fresh experiments.
pub fn run(set: &Set, seed: u64) -> Answer {
    let folder = Folder::of(&set.name);
    let folder = folder.path.as_path();
    write(set, folder);
    let start = Instant::now();
    let with_draws = set.lab().rig.hits_once() && !set.is_null();
    let diagnosis = diagnose_files(folder, seed, with_draws.then_some(DRAWS));
    let seconds = start.elapsed().as_secs_f64();
    let truth = set.fresh.iter().map(|one| one.readings.iter().map(|r| r.truth).collect()).collect();
    let mut answer = Answer { diagnosis, seconds, predicted: None, truth, bands: vec![] };
    if !set.is_null() && folder.join("out/extended.toml").exists() {
        predict_fresh(set, folder, seed, &mut answer);
    }
    answer
}

/// Writes the set and has it diagnosed.
pub fn diagnosed(set: &Set, seed: u64) -> (Result<Value, String>, f64) {
    let folder = Folder::of(&set.name);
    write(set, &folder.path);
    let start = Instant::now();
    let diagnosis = diagnose_files(&folder.path, seed, None);
    (diagnosis, start.elapsed().as_secs_f64())
}

/// Has experiments diagnosed.
pub fn diagnose(lab: &Lab, experiments: &[Experiment], folder: &Path, seed: u64) -> Result<Value, String> {
    write_rig(lab, &lab.csv(experiments, false), folder);
    let _ = std::fs::remove_dir_all(folder.join("out"));
    diagnose_files(folder, seed, None)
}

/// Has the files in a folder diagnosed.
fn diagnose_files(folder: &Path, seed: u64, draws: Option<usize>) -> Result<Value, String> {
    let seed = (seed % 1_000_000).to_string();
    let draws = draws.map(|count| count.to_string());
    let mut arguments =
        vec!["diagnose", "measured.csv", "--case", "case.toml", "--out", "out", "--seed", &seed];
    arguments.extend(draws.iter().flat_map(|count| ["--draws", count.as_str()]));
    answer(folder, &nearwall(folder, &arguments))
}

/// Writes the case, the model and the measurements.
fn write_rig(lab: &Lab, measured: &str, folder: &Path) {
    let text = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    text("measured.csv", measured);
    text("base.toml", &lab.model());
    text("case.toml", &lab.rig.case(&lab.source, "base.toml", CASE_COUNT, 1));
}

/// Writes a set, and the truth about it.
pub fn write(set: &Set, folder: &Path) {
    write_rig(set.lab(), &set.csv(), folder);
    let text = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    text("truth.txt", &format!("{:?} {:?}\n{:?}\n", set.plan.names, set.plan.parameters, set.oracle));
}

fn answer(folder: &Path, output: &Output) -> Result<Value, String> {
    if output.status.code() != Some(0) {
        return Err(format!("{}: {}", output.status, String::from_utf8_lossy(&output.stderr)));
    }
    let text = std::fs::read_to_string(folder.join("out/diagnosis.json")).map_err(|e| e.to_string())?;
    serde_json::from_str(&text).map_err(|e| e.to_string())
}

fn predict_fresh(set: &Set, folder: &Path, seed: u64, answer: &mut Answer) {
    let lab = set.lab();
    if !lab.rig.hits_once() {
        let simulated =
            |one: &Experiment| lab.values(&simulate(lab, folder, "out/extended.toml", one, PREDICTED, 7));
        answer.predicted = Some(set.fresh.iter().map(simulated).collect());
        return;
    }
    let mut rng = SetRng::new(seed, &format!("{}:fresh", set.name));
    let particles: Vec<Vec<Particle>> =
        set.fresh.iter().map(|one| lab.particles(&one.settings, PREDICTED / 4, &mut rng)).collect();
    answer.truth = particles.iter().map(|group| lab.values(&lab.tracks(group, &lab.truth))).collect();
    std::fs::write(folder.join("fresh.csv"), impacts(&particles)).unwrap();
    answer.predicted = Some(predict(lab, folder, "out/extended.toml", &particles));
    let mut drawn: Vec<PathBuf> = std::fs::read_dir(folder.join("out/draws"))
        .into_iter()
        .flatten()
        .map(|one| one.unwrap().path())
        .collect();
    drawn.sort();
    let model = |path: &PathBuf| predict(lab, folder, path.to_str().unwrap(), &particles);
    answer.bands = drawn.iter().map(model).collect();
}

/// The file of first impacts.
pub fn impacts(particles: &[Vec<Particle>]) -> String {
    let columns = ["v_n", "v_t", "d", "T_p", "T_w", "conversion", "layer_thickness", "v_gas"];
    let mut rng = SetRng::new(0, "cells");
    let mut text = columns.join(",");
    for particle in particles.iter().flatten() {
        let x = Rig::first(particle);
        let cells = columns.map(|column| campaign::cell(column, &x, &mut rng));
        text += &format!("\n{}", cells.join(","));
    }
    text + "\n"
}

/// A model's predictions of the impacts in `fresh.csv`, as readings.
pub fn predict(lab: &Lab, folder: &Path, model: &str, particles: &[Vec<Particle>]) -> Vec<Vec<f64>> {
    let output = nearwall(folder, &["predict", "--model", model, "fresh.csv"]);
    assert!(output.status.success(), "{model}: {}", String::from_utf8_lossy(&output.stderr));
    let mut table = csv::Reader::from_reader(output.stdout.as_slice());
    let header = table.headers().unwrap().clone();
    let at = |name: &str| header.iter().position(|column| column == name).unwrap();
    let places = [at("p_stick"), at("e_n"), at("e_t")];
    let mut rows = table.records();
    let mut track = |particle: &Particle| {
        let row = rows.next().unwrap().unwrap();
        let [stick, e_n, e_t] = places.map(|place| row[place].parse().unwrap_or(0.0));
        let mut track = Track::new(particle.inputs.d);
        track.captured[0] = stick;
        track.place = Rig::first_place(particle);
        track.hits.push(Hit { wall: 0, rebounds: 1.0 - stick, e_n, e_t });
        track
    };
    particles.iter().map(|group| lab.values(&group.iter().map(&mut track).collect::<Vec<_>>())).collect()
}

/// An experiment's particles as `nearwall simulate` lets them fly with a model.
pub fn simulate(
    lab: &Lab,
    folder: &Path,
    model: &str,
    one: &Experiment,
    count: usize,
    seed: u64,
) -> Vec<Track> {
    let mut text = std::fs::read_to_string(folder.join(model)).unwrap();
    if let Some(at) = lab.knobs.iter().position(|(knob, _)| *knob == Knob::Layer) {
        let wall = format!("[walls.default]\nlayer_thickness = {:e}", one.settings[at]);
        text = text.replace("[walls.default]", &wall);
    }
    std::fs::write(folder.join("fresh.model.toml"), text).unwrap();
    let case = lab.rig.case(&lab.source_at(&one.settings), "fresh.model.toml", count, seed);
    std::fs::write(folder.join("fresh.toml"), case).unwrap();
    let output = nearwall(folder, &["simulate", "fresh.toml", "-o", "fresh"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    tracks(lab, &folder.join("fresh/impacts.csv"))
}

/// The lives of simulated particles, of which each hits at least once.
fn tracks(lab: &Lab, path: &Path) -> Vec<Track> {
    let mut table = csv::Reader::from_path(path).unwrap();
    let header = table.headers().unwrap().clone();
    let at = |name: &str| header.iter().position(|column| column == name).unwrap();
    let number = |row: &csv::StringRecord, name: &str| row[at(name)].parse::<f64>().unwrap_or(0.0);
    let mut all: std::collections::BTreeMap<u64, Track> = std::collections::BTreeMap::new();
    for row in table.records() {
        let row = row.unwrap();
        let particle = row[at("particle")].parse().unwrap();
        let track = all.entry(particle).or_insert_with(|| Track::new(number(&row, "d")));
        let wall = lab.rig.walls().iter().position(|wall| *wall == &row[at("wall")]).unwrap();
        let sticks = row[at("outcome")].starts_with("st");
        if sticks {
            track.captured[wall] = 1.0;
            track.place = number(&row, "x").hypot(number(&row, "y"));
        }
        let rebounds = f64::from(u8::from(!sticks));
        track.hits.push(Hit { wall, rebounds, e_n: number(&row, "e_n"), e_t: number(&row, "e_t") });
    }
    all.into_values().collect()
}
