//! `nearwall init`: each case is written, runs with the command that is printed, and is not overwritten.

use std::path::Path;
use std::process::Command;

use crate::runner::{done, folder, refused};

/// Fewer particles than the written cases have: the gasifier with memory takes a minute.
const FEW: &str = "count = 200";

/// Runs a command line as a shell does, with the built `nearwall`.
fn run(at: &Path, line: &str) {
    let program = Path::new(env!("CARGO_BIN_EXE_nearwall")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let output = Command::new("sh").args(["-c", line]).current_dir(at).env("PATH", path).output().unwrap();
    assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
}

/// Writes a case, runs it with the printed command and returns the folder.
fn written_and_run(kind: &str, result: &str) -> tempfile::TempDir {
    let folder = folder(&[]);
    let said = done(folder.path(), &["init", kind]);
    let next = said.lines().find_map(|line| line.strip_prefix("next: ")).unwrap().to_owned();
    for file in said.lines().filter(|line| !line.starts_with("next: ")) {
        let path = folder.path().join(file);
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.starts_with("# "), "{file} begins with a comment");
        let count = text.lines().find(|line| line.starts_with("count = "));
        std::fs::write(&path, count.map_or(text.clone(), |count| text.replace(count, FEW))).unwrap();
    }
    run(folder.path(), &next);
    assert!(folder.path().join(kind).join(result).is_file(), "{next}");
    let again = format!("nearwall init {kind} {kind}.new");
    refused(folder.path(), &["init", kind], &["exists and is not overwritten", &again]);
    run(folder.path(), &again);
    folder
}

#[test]
fn the_cases_of_the_fields_run() {
    for kind in ["gasifier", "tokamak"] {
        let folder = written_and_run(kind, "results/report.html");
        let summary = std::fs::read_to_string(folder.path().join(kind).join("results/summary.json")).unwrap();
        assert!(!summary.contains("first_trouble"), "a particle could not be followed: {summary}");
    }
}

/// An hour of ash is more than the disc can hold: it insulates, and parts of it fall.
#[test]
fn the_superheater_fouls_and_sheds() {
    let folder = written_and_run("superheater", "results/deposit.csv");
    let table = std::fs::read(folder.path().join("superheater/results/deposit.csv")).unwrap();
    let mut reader = csv::Reader::from_reader(table.as_slice());
    let header = reader.headers().unwrap().clone();
    let place = |name: &str| header.iter().position(|head| head == name).unwrap();
    let [time, flux, shed] = ["time_s", "coolant_flux_W_m2", "shed_kg"].map(place);
    let rows: Vec<Vec<f64>> = reader
        .records()
        .map(|row| row.unwrap().iter().map(|cell| cell.parse().unwrap_or(0.0)).collect())
        .collect();
    let at = |wanted: f64| rows.iter().filter(move |row| row[time] == wanted);
    let mean = |wanted: f64| at(wanted).map(|row| row[flux]).sum::<f64>() / at(wanted).count() as f64;
    assert!(mean(3600.0) < 0.9 * mean(0.0), "{} of {}", mean(3600.0), mean(0.0));
    assert!(at(3600.0).map(|row| row[shed]).sum::<f64>() > 0.0);
}

/// Dust that has begun to melt stays, cold dust mostly does not.
#[test]
fn the_vane_catches_what_melts() {
    let folder = written_and_run("turbine", "results/summary.json");
    let text = std::fs::read_to_string(folder.path().join("turbine/results/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
    let stuck: Vec<f64> = summary["runs"]
        .as_array()
        .unwrap()
        .iter()
        .map(|run| run["stuck"]["count"].as_f64().unwrap())
        .collect();
    assert!(stuck.last() > Some(&(3.0 * stuck[0])), "{stuck:?}");
}

#[test]
fn the_laboratory_diagnoses_its_table() {
    written_and_run("laboratory", "diagnosis/extended.toml");
}

#[test]
fn files_of_another_folder_stay() {
    let folder = folder(&[("turbine.toml", "mine")]);
    refused(folder.path(), &["init", "turbine", "."], &["turbine.toml", "not overwritten"]);
    assert_eq!(std::fs::read_to_string(folder.path().join("turbine.toml")).unwrap(), "mine");
    assert!(!folder.path().join("turbine.model.toml").exists());
}
