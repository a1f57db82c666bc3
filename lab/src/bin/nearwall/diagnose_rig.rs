//! `nearwall diagnose --case` and `--impacts`: the wall effects that a simulated rig lacks to explain measured experiments.

use std::fs::File;
use std::path::Path;

use nearwall::Model;
use nearwall::input::Document;
use nearwall_lab::atomic_file::write_texts;
use nearwall_lab::dataset::RigMeasurements;
use nearwall_lab::diagnose::Options;
use nearwall_lab::diagnose::rig::{RigDiagnosis, RigError, diagnose_rig};
use nearwall_lab::report::{RigPage, rig_page};
use nearwall_lab::rig::{CaseText, Forward, Replayed, RigCase, Simulated, particles_for};

use crate::diagnose::{Arguments, drawn_files, summary};
use crate::{CommandResult, progress};

pub fn run(arguments: &Arguments, case: &Path) -> CommandResult {
    let data = read(arguments)?;
    let text = CaseText::from_file(case)?;
    let rigs = RigCase::all(&text, &data)?;
    let forward = Simulated::new(&rigs, particles_for(&data))?;
    let found = diagnosed(arguments, &forward, &data, text.model.text(), Some(&text))?;
    write(arguments, case, &|key| text.number(key), &found)?;
    crate::print_page(&summary(&found.diagnosis), &arguments.out.join("report.html"))
}

/// Diagnoses with the impacts that OpenFOAM recorded below `folder`, in runs with the model file `model`.
pub fn run_recorded(arguments: &Arguments, folder: &Path, model: &Path) -> CommandResult {
    let mut data = read(arguments)?;
    let document = Document::from_file(model)?;
    let base = Model::from_toml(document.name(), document.text())?;
    let forward = Replayed::new(folder, &data, &base)?;
    crate::note(forward.notes());
    data.notes.extend_from_slice(forward.notes());
    let mut found = diagnosed(arguments, &forward, &data, document.text(), None)?;
    let limits = forward.account_notes(&Model::from_toml("extended.toml", &found.extended)?)?;
    found.notes.extend_from_slice(&limits);
    write(arguments, model, &|_| None, &found)?;
    let limits: String = limits.iter().map(|note| format!("{note}\n")).collect();
    crate::print_page(&(limits + &summary(&found.diagnosis)), &arguments.out.join("report.html"))
}

/// Reads the readings of the rig.
fn read(arguments: &Arguments) -> Result<RigMeasurements, Box<dyn std::error::Error>> {
    let file = arguments.data.display().to_string();
    let source = File::open(&arguments.data).map_err(|error| format!("{file}: {error}"))?;
    let data = RigMeasurements::read(&file, source)?;
    crate::note(&data.notes);
    Ok(data)
}

fn diagnosed(
    arguments: &Arguments,
    forward: &dyn Forward,
    data: &RigMeasurements,
    model: &str,
    case: Option<&CaseText>,
) -> Result<RigDiagnosis, RigError> {
    let bar = progress::spinner("candidates tested");
    let options = Options { seed: arguments.seed, level: arguments.level, group: None };
    let found = diagnose_rig(forward, data, model, &options, arguments.draws, case, &|| bar.inc(1));
    bar.finish_and_clear();
    found
}

/// Writes all output files, or none; `source` is the case or the model file, `in_case` the number of a setting in the case.
fn write(
    arguments: &Arguments,
    source: &Path,
    in_case: &dyn Fn(&str) -> Option<f64>,
    found: &RigDiagnosis,
) -> CommandResult {
    let Arguments { data, out, .. } = arguments;
    let names = [data.as_path(), source].map(|path| path.display().to_string());
    let page = rig_page(found, &RigPage { data: &names[0], case: &names[1], in_case })?;
    let json = serde_json::to_string_pretty(found)? + "\n";
    let inputs: [&Path; 2] = [data, source];
    let texts = [
        ("report.html", page.as_str()),
        ("extended.toml", found.extended.as_str()),
        ("diagnosis.json", &json),
    ];
    let mut results: Vec<(String, &str)> =
        texts.into_iter().map(|(name, text)| (name.to_owned(), text)).collect();
    if !found.next.is_empty() {
        results.push(("next_experiments.csv".to_owned(), &found.next_table));
    }
    results.extend(drawn_files(out, &found.draws)?);
    Ok(write_texts(out, &inputs, results)?)
}
