//! Runs the command on a set, and its extended model on fresh impacts.

use std::path::Path;
use std::time::Instant;

use serde_json::Value;

use crate::command::nearwall;

use super::lab::{Outcome, Row};
use super::set::Set;

/// What the command answered.
pub struct Answer {
    /// The diagnosis, or why there is none.
    pub diagnosis: Result<Value, String>,
    /// The stated gain against fresh rows, if one is stated.
    pub gain: Option<Result<GainCheck, String>>,
    /// Mean probability of capture of the fresh rows by the extended model, if it is wanted.
    pub captures: Option<f64>,
    pub seconds: f64,
}

/// A stated gain, and the one that the written model has on fresh rows.
pub struct GainCheck {
    pub observable: String,
    /// Error of the extended model over that of the base model on the fresh rows.
    pub ratio: f64,
    /// Stated 95 % interval.
    pub stated: [f64; 2],
}

impl GainCheck {
    /// Whether the interval holds; with `larger`, whether its upper end does.
    pub fn holds(&self, larger: bool) -> bool {
        self.ratio <= self.stated[1] && (larger || self.stated[0] <= self.ratio)
    }
}

/// Diagnoses the set.
pub fn run(set: &Set, seed: u64) -> Answer {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("data.csv", &set.data);
    write("base.toml", &set.model);
    let seed = (seed % 1_000_000).to_string();
    let mut arguments =
        vec!["diagnose", "data.csv", "--model", "base.toml", "--out", "out", "--seed", seed.as_str()];
    if let Some(map) = &set.map {
        write("map.toml", map);
        arguments.extend(["--columns", "map.toml"]);
    }
    let start = Instant::now();
    let output = nearwall(folder.path(), &arguments);
    let seconds = start.elapsed().as_secs_f64();
    let diagnosis = if output.status.success() {
        read(folder.path())
    } else {
        Err(String::from_utf8_lossy(&output.stderr).trim().replace('\n', "; "))
    };
    let gain = diagnosis.as_ref().ok().and_then(|diagnosis| check_gain(set, folder.path(), diagnosis));
    let captures = diagnosis.as_ref().ok().filter(|_| set.expected.no_captures);
    let captures = captures.and_then(|diagnosis| captures_of(set, folder.path(), diagnosis));
    Answer { diagnosis, gain, captures, seconds }
}

fn read(folder: &Path) -> Result<Value, String> {
    let text = std::fs::read_to_string(folder.join("out/diagnosis.json")).map_err(|e| e.to_string())?;
    let diagnosis: Value = serde_json::from_str(&text).map_err(|e| e.to_string())?;
    if diagnosis["findings"].is_array() { Ok(diagnosis) } else { Err("no findings in diagnosis.json".into()) }
}

/// The file of the extended model.
fn extended(diagnosis: &Value) -> String {
    format!("out/{}", diagnosis["extended_model"].as_str().unwrap_or("extended.toml"))
}

/// Mean probability of capture of the fresh rows.
fn captures_of(set: &Set, folder: &Path, diagnosis: &Value) -> Option<f64> {
    std::fs::write(folder.join("fresh.csv"), &set.fresh_inputs).unwrap();
    let predicted = predict(folder, &extended(diagnosis), set.fresh.len()).ok()?;
    Some(predicted.iter().map(|[_, _, stick]| stick).sum::<f64>() / predicted.len() as f64)
}

/// The stated gain beside that of `extended.toml` on the fresh rows.
fn check_gain(set: &Set, folder: &Path, diagnosis: &Value) -> Option<Result<GainCheck, String>> {
    let gain = &diagnosis["gain"];
    let observable = gain["observable"].as_str()?;
    let stated = [0, 1].map(|end| gain["ci95"][end].as_f64().unwrap_or(f64::NAN));
    std::fs::write(folder.join("fresh.csv"), &set.fresh_inputs).unwrap();
    let before = predict(folder, "base.toml", set.fresh.len());
    let after = predict(folder, &extended(diagnosis), set.fresh.len());
    let errors = before.and_then(|before| Ok([before, after?].map(|p| error(&set.fresh, &p, observable))));
    let check = |[before, after]: [f64; 2]| GainCheck {
        observable: observable.into(),
        ratio: if before > 0.0 { after / before } else { 1.0 },
        stated,
    };
    Some(errors.map(check))
}

/// `e_n`, `e_t` and `p_stick` of every impact.
fn predict(folder: &Path, model: &str, count: usize) -> Result<Vec<[f64; 3]>, String> {
    let output = nearwall(folder, &["predict", "--model", model, "fresh.csv"]);
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).trim().into());
    }
    let mut table = csv::Reader::from_reader(output.stdout.as_slice());
    let header = table.headers().map_err(|e| e.to_string())?.clone();
    let place = |name: &str| header.iter().position(|column| column == name);
    let places = ["e_n", "e_t", "p_stick"].map(|name| place(name).unwrap());
    let number = |cell: &str| cell.parse().unwrap_or(0.0);
    let rows: Vec<[f64; 3]> =
        table.records().map(|row| row.map(|row| places.map(|at| number(&row[at]))).unwrap()).collect();
    if rows.len() == count { Ok(rows) } else { Err(format!("predict left out {}", count - rows.len())) }
}

/// Root mean square error; for `outcome` that of the probability of capture, each impact of a class by itself.
fn error(rows: &[Row], predicted: &[[f64; 3]], observable: &str) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for (row, [e_n, e_t, stick]) in rows.iter().zip(predicted) {
        let values = match observable {
            "e_n" => [(1.0, row.measured[0], e_n), (0.0, None, e_n)],
            "e_t" => [(1.0, row.measured[1], e_t), (0.0, None, e_t)],
            _ => {
                let [captured, rebounds] = outcomes(row);
                [(captured, Some(1.0), stick), (rebounds, Some(0.0), stick)]
            }
        };
        for (weight, measured, predicted) in values {
            if let Some(measured) = measured {
                sum += weight * (measured - predicted).powi(2);
                count += weight;
            }
        }
    }
    (sum / f64::max(count, 1.0)).sqrt()
}

/// Captures and rebounds.
fn outcomes(row: &Row) -> [f64; 2] {
    match row.outcome {
        Outcome::Unknown => [0.0, 0.0],
        Outcome::Stuck => [1.0, 0.0],
        Outcome::Rebound => [0.0, 1.0],
        Outcome::Counts { impacts, captured } => [f64::from(captured), f64::from(impacts - captured)],
    }
}
