//! Files of any size: memory that does not grow with the rows, and results that do not depend on how rows are read.

use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::report::write;
use crate::runner::{WAX, done, folder};

/// The largest memory of the command [MB], as the system reports it while the command runs.
fn peak_memory(folder: &Path, arguments: &[&str]) -> f64 {
    let mut command = Command::new(env!("CARGO_BIN_EXE_nearwall"));
    command.current_dir(folder).args(arguments).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut peak = 0.0;
    while child.try_wait().unwrap().is_none() {
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = line.and_then(|rest| rest.split_whitespace().next()?.parse::<f64>().ok());
        peak = kilobytes.map_or(peak, |kilobytes| kilobytes / 1000.0);
        std::thread::sleep(Duration::from_millis(2));
    }
    assert!(peak > 0.0, "the command ended before its memory was read");
    peak
}

/// Measured impacts, all with this diameter.
fn impacts(rows: usize, d: &str) -> String {
    let mut text = "v_n,v_t,d,T_p,e_n,operator,day\n".to_owned();
    for row in 0..rows {
        let (speed, operator) = (0.3 + (row % 977) as f64 * 3e-3, ["Ann", "Bob"][row % 2]);
        writeln!(text, "{speed},{},{d},{},0.4,{operator},{}", row % 7, 300 + row % 80, row % 12).unwrap();
    }
    text
}

#[test]
fn the_memory_of_a_prediction_does_not_grow_with_the_rows() {
    let folder = folder(&[("wax.toml", WAX)]);
    let [few, many] = [40_000, 200_000].map(|rows| {
        std::fs::write(folder.path().join("impacts.csv"), impacts(rows, "1e-4")).unwrap();
        peak_memory(folder.path(), &["predict", "--model", "wax.toml", "impacts.csv", "-o", "out.csv"])
    });
    assert!(many < few + 15.0, "{few} MB, then {many} MB");
}

/// No row has a plausible size, so the diagnosis ends when all are read.
#[test]
fn the_memory_of_a_diagnosis_does_not_grow_beyond_the_selected_rows() {
    let folder = folder(&[("wax.toml", WAX)]);
    let [few, many] = [150_000, 450_000].map(|rows| {
        std::fs::write(folder.path().join("impacts.csv"), impacts(rows, "1e-16")).unwrap();
        peak_memory(folder.path(), &["diagnose", "impacts.csv", "--model", "wax.toml", "--out", "out"])
    });
    assert!(many < few + 20.0, "{few} MB, then {many} MB");
}

/// No row has a plausible size, so the comparison ends when all are read for both models.
#[test]
fn the_memory_of_a_comparison_does_not_grow_beyond_the_selected_rows() {
    let folder = folder(&[("wax.toml", WAX), ("same.toml", WAX)]);
    let [few, many] = [150_000, 450_000].map(|rows| {
        std::fs::write(folder.path().join("impacts.csv"), impacts(rows, "1e-16")).unwrap();
        peak_memory(folder.path(), &["compare", "impacts.csv", "--models", "wax.toml", "same.toml"])
    });
    assert!(many < few + 20.0, "{few} MB, then {many} MB");
}

#[test]
fn the_memory_of_a_report_does_not_grow_with_the_recorded_arrivals() {
    let folder = tempfile::tempdir().unwrap();
    let case = folder.path().join("stock");
    crate::report::stock(&case);
    let [few, many] = [20_000, 200_000].map(|rows| {
        let mut text = "# Time currentProc d (U0 U1 U2) rho nParticle\n".to_owned();
        for row in 0..rows {
            writeln!(text, "{} 0 1e-4 (3 0 {}) 1000 10", 0.2 + 0.8 * row as f64 / rows as f64, row % 5)
                .unwrap();
        }
        write(&case, "postProcessing/lagrangian/coalCloud1/wallHits/0.2/slagWall.post", &text);
        peak_memory(folder.path(), &["report", "stock"])
    });
    assert!(many < few + 5.0, "{few} MB, then {many} MB");
}

#[test]
fn a_long_file_is_predicted_in_its_order() {
    let text = impacts(20_000, "1e-4").replace("\n0.3,", "\nfast,");
    let (header, rows) = text.split_once('\n').unwrap();
    let rows: Vec<&str> = rows.lines().collect();
    let part = |rows: &[&str]| format!("{header}\n{}\n", rows.join("\n"));
    let files =
        [("all.csv", text.clone()), ("first.csv", part(&rows[..7001])), ("rest.csv", part(&rows[7001..]))];
    let folder = folder(&[("wax.toml", WAX)]);
    let [all, first, rest] = files.map(|(name, text)| {
        std::fs::write(folder.path().join(name), text).unwrap();
        done(folder.path(), &["predict", "--model", "wax.toml", name])
    });
    assert!(all.lines().count() < 20_001, "rows are left out");
    assert!(all == first + rest.split_once('\n').unwrap().1);
}
