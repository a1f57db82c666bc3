//! `diagnose`: what the command `nearwall diagnose` does with measured impacts.

use std::path::PathBuf;

use nearwall::input::Document;
use nearwall_lab::diagnose::{ImpactDiagnosis, Options, Reach};
use nearwall_lab::report::diagnosis_page;
use pyo3::prelude::*;

use crate::table::TableSource;
use crate::work::run;

/// diagnosis.json, extended.toml, report.html, drawn model files, notes.
type DiagnosisOutput = (String, String, String, Vec<String>, Vec<String>);

/// Diagnoses measured impacts against a model, given by name and text.
#[pyfunction]
#[pyo3(signature = (model, data, columns, group, wall, seed, level, draws, reach))]
#[expect(clippy::too_many_arguments, reason = "the options of the command")]
pub fn diagnose(
    py: Python<'_>,
    model: (String, String),
    data: TableSource,
    columns: Option<PathBuf>,
    group: Option<String>,
    wall: Option<String>,
    seed: u64,
    level: f64,
    draws: usize,
    reach: Vec<(String, [f64; 2])>,
) -> PyResult<DiagnosisOutput> {
    let (name, text) = model;
    run(py, move |tick| {
        let reach = reach.into_iter().map(|(name, range)| Reach { name, range }).collect();
        let options = Options { seed, level, group, reach };
        let document = Document::new(name.as_str(), text);
        let diagnosis = ImpactDiagnosis::new(document, columns.as_deref(), wall.as_deref(), options)?;
        let measured = diagnosis.read(data.name(), data.open()?)?;
        let (diagnosis, extended, drawn) = diagnosis.run(&measured, draws, &|_| tick())?;
        let page = diagnosis_page(&diagnosis, &[measured.file, name], &extended)?;
        let json = serde_json::to_string_pretty(&diagnosis)? + "\n";
        Ok((json, extended, page, drawn, measured.notes))
    })
}
