//! `nearwall diagnose --case`: the wall effects that a simulated rig lacks to explain measured experiments.

use std::fs::File;
use std::path::Path;

use nearwall::atomic_file::{AtomicFile, refused};
use nearwall::dataset::RigMeasurements;
use nearwall::diagnose::Options;
use nearwall::diagnose::rig::{RigDiagnosis, diagnose_rig};
use nearwall::report::{RigPage, rig_page};
use nearwall::rig::{CaseText, RigCase, Simulated, particles_for};

use crate::diagnose::{Arguments, drawn_files, summary};
use crate::{CommandResult, progress};

pub fn run(arguments: &Arguments, case: &Path) -> CommandResult {
    let file = arguments.data.display().to_string();
    let source = File::open(&arguments.data).map_err(|error| format!("{file}: {error}"))?;
    let data = RigMeasurements::read(&file, source)?;
    for note in &data.notes {
        eprintln!("nearwall: {note}");
    }
    let text = CaseText::from_file(case)?;
    let rigs = RigCase::all(&text, &data)?;
    let bar = progress::spinner("candidates tested");
    let forward = Simulated::new(&rigs, particles_for(&data))?;
    let options = Options { seed: arguments.seed, level: arguments.level, group: None };
    let model = text.model.text();
    let found = diagnose_rig(&forward, &data, model, &options, arguments.draws, Some(&text), &|| bar.inc(1))?;
    bar.finish_and_clear();
    let case_file = case.display().to_string();
    let page = RigPage { data: &file, case: &case_file, in_case: &|key| text.number(key) };
    let page = rig_page(&found, &page)?;
    write(arguments, case, &found, &page)?;
    crate::print(&summary(&found.diagnosis, &arguments.out))
}

/// Writes all output files, or none.
fn write(arguments: &Arguments, case: &Path, found: &RigDiagnosis, page: &str) -> CommandResult {
    let Arguments { data, out, .. } = arguments;
    let json = serde_json::to_string_pretty(found)? + "\n";
    std::fs::create_dir_all(out).map_err(|error| refused(out, &error))?;
    let inputs: [&Path; 2] = [data, case];
    let texts =
        [("report.html", page), ("extended.toml", found.extended.as_str()), ("diagnosis.json", &json)];
    let mut results: Vec<(String, &str)> =
        texts.into_iter().map(|(name, text)| (name.to_owned(), text)).collect();
    if !found.next.is_empty() {
        results.push(("next_experiments.csv".to_owned(), &found.next_table));
    }
    results.extend(drawn_files(out, &found.draws)?);
    let write = |(name, text): (String, &str)| {
        let mut file = AtomicFile::new(&out.join(name), &inputs)?;
        file.put(text)?;
        Ok::<_, String>(file)
    };
    let files = results.into_iter().map(write).collect::<Result<Vec<_>, _>>()?;
    Ok(AtomicFile::commit(files)?)
}
