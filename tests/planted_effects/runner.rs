//! Runs the command on a set and its extended model on fresh impacts.

use std::path::Path;
use std::process::Output;
use std::time::Instant;

use serde_json::{Value, json};

use crate::command::nearwall;
use crate::score::{HeldOut, Judgement, Verdict, judge};
use crate::set_rng::SetRng;
use crate::sets::{Kind, Set};
use crate::world::{Inputs, Response};

/// Fresh impacts for the held-out error.
const FRESH: usize = 400;

/// Diagnoses the set and judges the answer.
pub fn run(set: &Set, seed: u64) -> Judgement {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("data.csv"), &set.csv).unwrap();
    std::fs::write(folder.path().join("base.toml"), set.model()).unwrap();
    let start = Instant::now();
    let seed_text = (seed % 1_000_000).to_string();
    let arguments =
        ["diagnose", "data.csv", "--model", "base.toml", "--out", "out", "--seed", seed_text.as_str()];
    let output = nearwall(folder.path(), &arguments);
    let seconds = start.elapsed().as_secs_f64();
    match answer(folder.path(), &output) {
        Ok(diagnosis) => {
            let held_out = held_out(set, folder.path(), seed, &diagnosis);
            Judgement { seconds, held_out, ..judge(set, &diagnosis) }
        }
        Err(message) => crashed(set, &message, seconds),
    }
}

/// The diagnosis, or why there is none.
fn answer(folder: &Path, output: &Output) -> Result<Value, String> {
    if output.status.code() != Some(0) {
        return Err(format!("{}: {}", output.status, String::from_utf8_lossy(&output.stderr)));
    }
    let text = std::fs::read_to_string(folder.join("out/diagnosis.json")).map_err(|e| e.to_string())?;
    let diagnosis: Value = serde_json::from_str(&text).map_err(|e| e.to_string())?;
    let complete = diagnosis["findings"].is_array()
        && diagnosis["rows"]["rejected"].is_array()
        && diagnosis["calibration"].is_array();
    if complete {
        Ok(diagnosis)
    } else {
        Err("diagnosis.json lacks findings, rows.rejected or calibration".into())
    }
}

/// The judgement where there is no diagnosis.
fn crashed(set: &Set, message: &str, seconds: f64) -> Judgement {
    let empty = json!({ "findings": [], "rows": { "rejected": [] } });
    let crash = Some(format!("{}: {message}", set.name));
    let verdict = Verdict::False;
    Judgement { verdict, exact: false, trap_passed: false, seconds, crash, ..judge(set, &empty) }
}

/// Reached and attainable errors, for sets without hidden draws.
fn held_out(set: &Set, folder: &Path, seed: u64, diagnosis: &Value) -> Vec<HeldOut> {
    if set.kind != Kind::Planted || set.world.scatters() {
        return vec![];
    }
    let model = diagnosis["extended_model"].as_str().map(|name| format!("out/{name}"));
    let model = model.filter(|name| folder.join(name).exists()).unwrap_or_else(|| "base.toml".into());
    let fresh = fresh_impacts(set, seed);
    let predicted = predict(set, folder, &model, &fresh);
    let truth: Vec<_> = fresh.iter().map(|x| set.world.truth(x, [0.5; 2])).collect();
    set.world.plants.iter().map(|plant| compare(set, plant.observable, &truth, &predicted)).collect()
}

/// New impacts of the same campaign.
pub fn fresh_impacts(set: &Set, seed: u64) -> Vec<Inputs> {
    let mut rng = SetRng::new(seed, &format!("{}:fresh", set.name));
    (0..FRESH).map(|_| set.campaign.inputs(&mut rng)).collect()
}

/// The predictions of a model for these impacts, through the command.
pub fn predict(set: &Set, folder: &Path, model: &str, impacts: &[Inputs]) -> Vec<Response> {
    std::fs::write(folder.join("fresh.csv"), set.campaign.inputs_csv(impacts)).unwrap();
    let output = nearwall(folder, &["predict", "--model", model, "fresh.csv"]);
    assert!(output.status.success(), "{}: {}", set.name, String::from_utf8_lossy(&output.stderr));
    let mut table = csv::Reader::from_reader(output.stdout.as_slice());
    let header = table.headers().unwrap().clone();
    let place = |name: &str| header.iter().position(|column| column == name).unwrap();
    let places = [place("p_stick"), place("e_n"), place("e_t")];
    let rows: Vec<Response> = table
        .records()
        .map(|row| {
            let row = row.unwrap();
            let [stick, e_n, e_t] = places.map(|at| row[at].parse().unwrap());
            Response { stick, e_n, e_t }
        })
        .collect();
    assert_eq!(rows.len(), impacts.len(), "{}: predict left rows out", set.name);
    rows
}

/// The error due to noise and misfit against that of noise; for capture, the log loss of the prediction against that of
/// the truth.
pub fn compare(set: &Set, observable: &'static str, truth: &[Response], predicted: &[Response]) -> HeldOut {
    if observable == "stick" {
        let loss = |of: &[Response]| mean(truth.iter().zip(of).map(|(t, p)| cross_entropy(t.stick, p.stick)));
        return HeldOut { observable, reached: loss(predicted), attainable: loss(truth) };
    }
    let (noise, pick): (f64, fn(&Response) -> f64) = match observable {
        "e_n" => (set.campaign.noise_e_n, |r| r.e_n),
        _ => (set.campaign.noise_e_t, |r| r.e_t),
    };
    let rebounds = truth.iter().zip(predicted).filter(|(t, _)| t.stick < 0.5);
    let misfit = mean(rebounds.map(|(t, p)| (pick(t) - pick(p)).powi(2)));
    HeldOut { observable, reached: (noise * noise + misfit).sqrt(), attainable: noise }
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / f64::max(count, 1.0)
}

/// Expected log loss, nats; nothing is called more certain than 1 %.
fn cross_entropy(truth: f64, predicted: f64) -> f64 {
    let predicted = predicted.clamp(0.01, 0.99);
    -truth * predicted.ln() - (1.0 - truth) * (1.0 - predicted).ln()
}
