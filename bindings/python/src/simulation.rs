//! `simulate`: what the command `nearwall simulate` does with a standalone case.

use std::path::PathBuf;

use nearwall_lab::report::standalone_page;
use nearwall_lab::results::standalone::{ImpactRecorder, run as run_case, summary, write_deposits};
use nearwall_lab::rig::{DrawnModels, add_capture_bands};
use nearwall_lab::simulate::Case;
use pyo3::prelude::*;

use crate::table::{ForPython, TableCells};
use crate::work::{Failure, run};

/// summary.json; impacts.csv and deposit.csv as texts and as columns; report.html; notes.
type SimulationOutput =
    (String, String, Vec<ForPython>, Option<(String, Vec<ForPython>)>, String, Vec<String>);

/// Runs a case file.
#[pyfunction]
pub fn simulate(py: Python<'_>, case: PathBuf, draws: Option<PathBuf>) -> PyResult<SimulationOutput> {
    let (json, impacts, deposit, page, notes) = run(py, |tick| {
        let mut case = Case::from_file(&case)?;
        let draws = draws.map(|folder| DrawnModels::from_folder(&folder, &case.model)).transpose()?;
        let mut recorder = ImpactRecorder::new(Vec::new(), &case)?;
        let mut runs = run_case(&mut case, |case, value, number, trajectory| {
            tick();
            recorder.record(case, value, number, trajectory).map_err(|error| error.to_string())
        })?;
        let mut notes: Vec<String> = runs.iter().filter_map(|run| run.totals.trouble_note()).collect();
        if let Some(draws) = &draws {
            if case.has_own_models() {
                let note =
                    "particles with a model file of their own keep it; draws change only the case's model";
                notes.push(note.to_owned());
            }
            add_capture_bands(&mut case, &mut runs, draws, tick)?;
        }
        let left_out = recorder.left_out;
        let impacts = String::from_utf8(recorder.finish()?)?;
        let json = serde_json::to_string_pretty(&summary(&case, &runs))? + "\n";
        let page = standalone_page(&case, &runs, left_out)?;
        let deposit = case.deposit.is_some().then(|| write_deposits(Vec::new(), &case, &runs)).transpose()?;
        Ok::<_, Failure>((json, impacts, deposit.map(String::from_utf8).transpose()?, page, notes))
    })?;
    let columns = |text: &str| match TableCells::read(text.as_bytes()) {
        Ok(cells) => cells.for_python(py),
        Err(error) => Err(crate::work::error(py, &error.to_string())),
    };
    let impact_columns = columns(&impacts)?;
    let deposit = deposit.map(|text| columns(&text).map(|columns| (text, columns))).transpose()?;
    Ok((json, impacts, impact_columns, deposit, page, notes))
}
