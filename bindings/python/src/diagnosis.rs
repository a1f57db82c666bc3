//! `diagnose`: what the command `nearwall diagnose` does with measured impacts.

use std::path::Path;

use nearwall::Model;
use nearwall::dataset::{ColumnMap, Measurements, WallChoice};
use nearwall::diagnose::{DiagnosisError, Options, diagnose_with_draws};
use nearwall::report::diagnosis_page;
use pyo3::prelude::*;

use crate::table::Source;
use crate::work::run;

/// diagnosis.json, extended.toml, report.html, drawn model files, notes.
type Found = (String, String, String, Vec<String>, Vec<String>);

/// Diagnoses measured impacts against a model, given by name and text.
#[pyfunction]
#[pyo3(signature = (model, data, columns, group, wall, seed, level, draws))]
#[expect(clippy::too_many_arguments, reason = "the options of the command")]
pub fn diagnose(
    py: Python<'_>,
    model: (String, String),
    data: Source,
    columns: Option<String>,
    group: Option<String>,
    wall: Option<String>,
    seed: u64,
    level: f64,
    draws: usize,
) -> PyResult<Found> {
    let (name, text) = model;
    run(py, move |tick| {
        let base = Model::from_toml(&name, &text)?;
        let map = columns.map(|path| ColumnMap::from_file(Path::new(&path))).transpose()?;
        let mut map = map.unwrap_or_default();
        let group = group.map(|column| map.label(&column));
        let file = data.name();
        let source = data.open()?;
        let walls = WallChoice::new(&base, wall.as_deref())?;
        let measured = Measurements::read(file, source, Some(&map), &walls)?;
        if let Some(group) = &group {
            measured.check_group(group)?;
        }
        let options = Options { seed, level, group };
        let found = diagnose_with_draws(&base, &text, &measured, &options, draws, tick);
        let (diagnosis, extended, drawn) = found.map_err(|error| match error {
            DiagnosisError::TooFewRows { .. } => format!("{file}: {error}"),
            DiagnosisError::Unextendable(_) => format!("{name}: {error}"),
        })?;
        let page = diagnosis_page(&diagnosis, &[file.to_owned(), name.clone()], &extended)?;
        let json = serde_json::to_string_pretty(&diagnosis)? + "\n";
        Ok((json, extended, page, drawn, measured.notes))
    })
}
