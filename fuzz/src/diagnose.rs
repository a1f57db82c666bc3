//! A readable data set through a whole diagnosis.
//!
//! The bytes are the file; or, if they begin with one of 0xF8 to 0xFF, as no UTF-8 text does, they
//! describe a table: its columns, the course of each, and extreme numbers. A short table of few
//! columns keeps one diagnosis cheap.

use std::fmt::Write as _;

use nearwall::Model;
use nearwall_lab::dataset::{Measurements, WallChoice};
use nearwall_lab::diagnose::{Diagnosis, Options, diagnose as judge};
use nearwall_lab::report::diagnosis_page;

use super::bytes::{Bytes, WRITTEN};
use super::whole;

const FILE: &str = "d.csv";

/// Rows and columns of the file's own that a diagnosis gets at most; an average stands for few
/// impacts or is not unfolded.
const FUZZED_ROWS: usize = 24;
const FUZZED_COLUMNS: usize = 2;
const UNFOLDED: f64 = 3.0;

const MODELS: [&str; 3] = [
    "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n[walls.roof]\nmaterial = \
     \"stainless-steel\"\n[normal]\nmodel = \"thornton-ning\"\nyield_ratio = 0.7\n[tangential]\nmodel = \"constant\"\ne_t = \
     0.76\n",
    "effects = []\n[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n[normal]\nmodel = \
     \"constant\"\ne_n = 0.5\n[tangential]\nmodel = \"sliding-rolling\"\nfriction = 0.3 # of a plate\n",
    include_str!("models/effects.toml"),
];

/// Any file is refused in words, or is diagnosed: numbers that are numbers, a model that can be read, JSON and a page.
pub fn diagnose(bytes: &[u8]) {
    let (choice, text) = match bytes {
        [0xF8..=0xFF, rest @ ..] => {
            let mut rest = Bytes(rest);
            (rest.byte(), table(&mut rest).into_bytes())
        }
        _ => (0, bytes.to_vec()),
    };
    let text_of_model = MODELS[usize::from(choice) % MODELS.len()];
    let model = Model::from_toml("m.toml", text_of_model).expect("our own model");
    let walls = WallChoice::new(&model, (choice >= 128).then_some("default")).expect("there is a default");
    let Ok(mut data) = Measurements::read(FILE, text.as_slice(), None, &walls) else { return };
    data.columns.truncate(FUZZED_COLUMNS);
    let most = data.rows.iter().map(|row| row.line).nth(FUZZED_ROWS - 1).unwrap_or(u64::MAX);
    let data = data.without(|row| {
        let long = row.impacts > UNFOLDED && row.impacts <= 1000.0;
        (row.line > most || long).then(|| "more than the fuzzer has time for".to_owned())
    });
    let options = Options { seed: u64::from(choice >> 4), ..Options::default() };
    let (diagnosis, extended) = match judge(&model, text_of_model, &data, &options, &|_| ()) {
        Ok(found) => found,
        Err(error) => {
            let said = error.to_string();
            return assert!(said.len() > 20 && !said.contains("panicked"), "{said}");
        }
    };
    if let Err(error) = Model::from_toml("extended.toml", &extended) {
        panic!("{error}\n{extended}");
    }
    numbers(&diagnosis);
    let json = serde_json::to_string_pretty(&diagnosis).expect("JSON");
    let _: serde::de::IgnoredAny = serde_json::from_str(&json).expect("JSON that can be read");
    let names = [FILE, "m.toml"].map(str::to_owned);
    whole(&diagnosis_page(&diagnosis, &names, &extended).expect("a page"));
}

/// How a column runs.
fn cell(bytes: &mut Bytes<'_>, pattern: u8, usual: f64, row: usize) -> String {
    let along = row as f64 + 1.0;
    match pattern % 8 {
        0 => format!("{usual}"),
        1 => format!("{:e}", usual * along),
        2 => format!("{:e}", usual * (0.5 + f64::from(bytes.byte()) / 255.0)),
        3 => format!("{:e}", if row.is_multiple_of(2) { usual } else { 2.0 * usual }),
        4 => WRITTEN[bytes.below(WRITTEN.len())].replace(", ", " "),
        5 => format!("{:e}", bytes.number()),
        6 => String::new(),
        _ => format!("w{}", bytes.below(3)),
    }
}

/// Columns, with a value that is usual there.
const COLUMN_NAMES: [(&str, f64); 24] = [
    ("v_n", 1.0),
    ("e_n", 0.2),
    ("e_t", 0.3),
    ("outcome", 0.0),
    ("v_t", 0.5),
    ("d", 75e-6),
    ("T_p", 290.0),
    ("T_w", 290.0),
    ("layer_thickness", 1e-5),
    ("film_thickness", 1e-6),
    ("v_gas", 3.0),
    ("roughness", 1e-7),
    ("omega", 100.0),
    ("coverage", 0.05),
    ("melt_thickness", 1e-6),
    ("conversion", 0.06),
    ("e_n_err", 0.01),
    ("n_impacts", 1.0),
    ("capture_efficiency", 0.05),
    ("rig", 1.0),
    ("\"a\\\nb\"", 1.0),
    ("d_err", 1e-6),
    ("T_p_err", 2.0),
    ("batch", 1.0),
];

fn table(bytes: &mut Bytes<'_>) -> String {
    let which = bytes.word() & 0x00FF_FFFF | 0b1;
    let chosen: Vec<(&str, f64, u8)> = COLUMN_NAMES
        .into_iter()
        .enumerate()
        .filter(|(place, _)| which >> place & 1 == 1)
        .map(|(_, (name, usual))| (name, usual, bytes.byte()))
        .collect();
    let rows = 7 + bytes.below(FUZZED_ROWS - 6);
    let mut text = chosen.iter().map(|(name, ..)| *name).collect::<Vec<_>>().join(",");
    let twice = bytes.byte() == 0;
    let mut last = String::new();
    for row in 0..rows {
        let cells: Vec<String> = chosen
            .iter()
            .map(|(name, usual, pattern)| match *name {
                "outcome" => ["rebound", "stick", ""][usize::from(bytes.byte()) % 3].to_owned(),
                _ => cell(bytes, *pattern, *usual, row),
            })
            .collect();
        if !(twice && row % 2 == 1) {
            last = cells.join(",");
        }
        write!(text, "\n{last}").expect("a text");
    }
    text
}

fn finite(numbers: &[f64], of: &dyn std::fmt::Debug) {
    assert!(numbers.iter().all(|number| number.is_finite()), "{of:?}");
}

/// `diagnosis.json` has a number wherever its description does not say that there may be none.
fn numbers(diagnosis: &Diagnosis) {
    assert!(diagnosis.verdict.len() > 20, "{}", diagnosis.verdict);
    let base = diagnosis.base;
    for error in [base.rmse_e_n, base.rmse_e_t, base.log_loss_stick].into_iter().flatten() {
        assert!(error.is_finite() && error >= 0.0, "{base:?}");
    }
    for misfit in &diagnosis.misfit {
        finite(&[misfit.gain], misfit);
        assert!((0.0..=1.0).contains(&misfit.q_value), "{misfit:?}");
    }
    for finding in &diagnosis.findings {
        finite(&[finding.gain], finding);
        let chances = [finding.p_value, finding.q_value];
        assert!(chances.iter().all(|chance| (0.0..=1.0).contains(chance)), "{finding:?}");
        for estimate in finding.parameters.values() {
            finite(&[estimate.low, estimate.value, estimate.high], finding);
            assert!(estimate.low <= estimate.value && estimate.value <= estimate.high, "{finding:?}");
        }
        finding.alternatives.iter().for_each(|other| finite(&[other.score_difference], finding));
        finding.measure_next.iter().for_each(|measure| finite(&measure.range, finding));
        if let Some(shape) = &finding.curve {
            finite(&shape.adds, finding);
        }
    }
    for found in &diagnosis.calibration {
        finite(&[found.from, found.low, found.value, found.high], found);
        assert!(found.low <= found.value && found.value <= found.high, "{found:?}");
    }
    finite(&[diagnosis.scatter.e_n, diagnosis.scatter.e_t], &diagnosis.scatter);
    if let Some(captured) = diagnosis.unexplained_capture {
        finite(&[captured.measured, captured.expected], &captured);
    }
    for gain in &diagnosis.gains {
        finite(&[gain.rmse_before, gain.rmse_after, gain.log_score_before, gain.log_score_after], gain);
        finite(&gain.ci95, gain);
    }
}
