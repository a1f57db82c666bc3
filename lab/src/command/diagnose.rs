//! `nearwall diagnose`: the effects that a model lacks to explain measured impacts, or the readings of a rig, and the
//! extended model.

use std::fs::File;
use std::path::{Path, PathBuf};

use crate::atomic_file::{make_folder, write_texts};
use crate::dataset::RigMeasurements;
use crate::diagnose::rig::{RigDiagnosis, RigError, diagnose_rig};
use crate::diagnose::{Diagnosis, ImpactDiagnosis, Options, Reach};
use crate::report::{RigPage, RigSource, diagnosis_page, rig_page};
use crate::rig::{CaseText, Forward, ReplayedRig, RigCase, SimulatedRig};
use nearwall::Model;
use nearwall::input::Document;

use super::{CommandResult, progress};

/// What the progress counts.
const TESTED: &str = "candidates tested";

/// Finds the effects that a model lacks to explain measured impacts, and extends the model
#[derive(clap::Args)]
#[command(group(clap::ArgGroup::new("rig").args(["case", "impacts"])))]
#[command(after_help = "Example:\n  nearwall diagnose impacts.csv --model wax.toml --out diagnosis\n  \
    nearwall diagnose lab.csv --columns lab.map.toml --group batch --model wax.toml --out diagnosis\n  \
    nearwall diagnose rig.csv --case case.toml --draws 39 --out diagnosis\n  \
    nearwall diagnose impacts.csv --model wax.toml --draws 39 --out diagnosis\n  \
    nearwall diagnose deposits.csv --impacts runs --model wax.toml --out diagnosis --draws 39\n\n\
    Writes report.html, diagnosis.json and extended.toml into the folder. The data file needs v_n and at least one of\n\
    e_n, e_t, outcome or capture_efficiency; every other column is a possible cause. docs/reference/data-file.md\n\
    describes the data file and --columns, docs/how-to/diagnosis.md the method. With --case the rows are experiments \
    of a rig:\n\
    settings of the case, and observables as captured@WALL (docs/how-to/rig-diagnosis.md).")]
pub struct Arguments {
    /// The measured impacts
    data: PathBuf,
    /// The base model
    #[arg(long, required_unless_present = "case")]
    model: Option<PathBuf>,
    /// A case of `nearwall simulate`: the rows are experiments on a rig, which it simulates
    #[arg(long, value_name = "CASE.toml", conflicts_with_all = ["model", "columns", "group", "wall"])]
    case: Option<PathBuf>,
    /// OpenFOAM cases with recorded impacts: the rows are experiments on a rig; their column `experiment` names the
    /// sub-folder of the case. --model is the model file of these runs
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["case", "columns", "group", "wall"])]
    impacts: Option<PathBuf>,
    /// Model files to draw from the fit, written to draws/ in the output folder; the range over 39 is a 95 % band
    #[arg(long, value_name = "N", default_value_t = 0)]
    draws: usize,
    /// Output folder
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Seed of the split into fitted and held-out rows; the same seed gives the same bytes
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Accepted share of false alarms: of columns that shape the residuals, and of causes at a rig
    #[arg(long, default_value_t = 0.05)]
    level: f64,
    /// Column map that renames and converts the columns of a laboratory's own file
    #[arg(long, value_name = "MAP.toml")]
    columns: Option<PathBuf>,
    /// Column that tells groups of rows apart that may share an error; its numbers are labels. By
    /// default columns such as series, day, batch or lab (docs/reference/data-file.md lists them)
    #[arg(long, value_name = "COLUMN")]
    group: Option<String>,
    /// What can be varied in the next measurement, in SI units: an input of the impacts (T_p=290:400), or with --case
    /// a key of the case (particles.speed=0.5:20). May be given several times. By default what varies in the file,
    /// and with --case the usual settings of a rig
    #[arg(long, value_name = "NAME=LOW:HIGH", conflicts_with = "impacts")]
    reach: Vec<Reach>,
    /// The wall that is hit; by default the column `wall`, then the wall `default`, then the only wall
    #[arg(long)]
    wall: Option<String>,
}

pub fn run(arguments: &Arguments) -> CommandResult {
    if !(arguments.level > 0.0 && arguments.level < 0.5) {
        return Err(format!("--level {}: must lie between 0 and 0.5", arguments.level).into());
    }
    match (&arguments.case, &arguments.impacts, &arguments.model) {
        (Some(case), ..) => run_simulated(arguments, case),
        (None, Some(folder), Some(model)) => run_recorded(arguments, folder, model),
        (None, None, Some(model)) => run_impacts(arguments, model),
        (None, _, None) => Err("give --model M.toml, or --case CASE.toml for experiments on a rig".into()),
    }
}

fn options(arguments: &Arguments) -> Options {
    let Arguments { seed, level, group, reach, .. } = arguments;
    Options { seed: *seed, level: *level, group: group.clone(), reach: reach.clone() }
}

/// Diagnoses measured impacts.
fn run_impacts(arguments: &Arguments, file_of_model: &Path) -> CommandResult {
    // Read only once: the file may be replaced while this runs.
    let document = Document::from_file(file_of_model)?;
    let (columns, wall) = (arguments.columns.as_deref(), arguments.wall.as_deref());
    let options = options(arguments);
    let diagnosis = ImpactDiagnosis::new(document, columns, wall, options)?;
    let file = arguments.data.display().to_string();
    let source = File::open(&arguments.data).map_err(|error| format!("{file}: {error}"))?;
    let bar = progress::bytes(source.metadata().map_or(0, |data| data.len()), "reading");
    let data = diagnosis.read(&file, bar.wrap_read(source))?;
    bar.finish_and_clear();
    super::note(&data.notes);
    let bar = progress::spinner(TESTED);
    let (diagnosis, extended, draws) =
        diagnosis.run(&data, arguments.draws, &|what| progress::tell(&bar, TESTED, what))?;
    bar.finish_and_clear();
    if arguments.draws > 0 && draws.is_empty() {
        eprintln!("nearwall: no parameter was fitted, so no model files were drawn");
    }
    write_impacts(arguments, file_of_model, &diagnosis, &extended, &draws)?;
    super::print_page(&summary(&diagnosis), &arguments.out.join("report.html"))
}

/// Diagnoses the readings of a rig that a case of `nearwall simulate` describes.
fn run_simulated(arguments: &Arguments, case: &Path) -> CommandResult {
    let data = super::read_rig(&arguments.data)?;
    let text = CaseText::from_file(case)?;
    let rigs = RigCase::all(&text, &data)?;
    let forward = SimulatedRig::new(&rigs)?.with_told_numbers();
    let found = diagnosed(arguments, &forward, &data, text.model.text(), Some(&text))?;
    let source = RigSource::Case { file: &case.display().to_string(), number: &|key| text.number(key) };
    write_rig(arguments, &[case], source, &found)?;
    super::print_page(&summary(&found.diagnosis), &arguments.out.join("report.html"))
}

/// Diagnoses with the impacts that OpenFOAM recorded below `folder`, in runs with the model file `model`.
fn run_recorded(arguments: &Arguments, folder: &Path, model: &Path) -> CommandResult {
    let mut data = super::read_rig(&arguments.data)?;
    let document = Document::from_file(model)?;
    let base = Model::from_toml(document.name(), document.text())?;
    let forward = ReplayedRig::new(folder, &data, &base)?;
    super::note(forward.notes());
    data.notes.extend_from_slice(forward.notes());
    let mut found = diagnosed(arguments, &forward, &data, document.text(), None)?;
    let limits = forward.account_notes(&Model::from_toml("extended.toml", &found.extended)?)?;
    found.notes.extend_from_slice(&limits);
    let [folder, file] = [folder, model].map(|path| path.display().to_string());
    write_rig(arguments, &[model], RigSource::Recorded { folder: &folder, model: &file }, &found)?;
    let limits: String = limits.iter().map(|note| format!("{note}\n")).collect();
    super::print_page(&(limits + &summary(&found.diagnosis)), &arguments.out.join("report.html"))
}

fn diagnosed(
    arguments: &Arguments,
    forward: &dyn Forward,
    data: &RigMeasurements,
    model: &str,
    case: Option<&CaseText>,
) -> Result<RigDiagnosis, RigError> {
    let bar = progress::spinner(TESTED);
    let options = options(arguments);
    let found = diagnose_rig(forward, data, model, &options, arguments.draws, case, &|what| {
        progress::tell(&bar, TESTED, what)
    });
    bar.finish_and_clear();
    found
}

fn write_impacts(
    arguments: &Arguments,
    model: &Path,
    diagnosis: &Diagnosis,
    extended: &str,
    draws: &[String],
) -> CommandResult {
    let Arguments { data, columns, .. } = arguments;
    let names = [data.as_path(), model].map(|path| path.display().to_string());
    let page = diagnosis_page(diagnosis, &names, extended)?;
    let json = serde_json::to_string_pretty(diagnosis)? + "\n";
    let inputs: Vec<&Path> = [data.as_path(), model].into_iter().chain(columns.as_deref()).collect();
    let results = [("extended.toml", extended), ("diagnosis.json", &json), ("report.html", &page)];
    write(&arguments.out, &inputs, &results, draws)
}

fn write_rig(
    arguments: &Arguments,
    inputs: &[&Path],
    source: RigSource<'_>,
    found: &RigDiagnosis,
) -> CommandResult {
    let name = arguments.data.display().to_string();
    let page = rig_page(found, &RigPage { data: &name, source })?;
    let json = serde_json::to_string_pretty(found)? + "\n";
    let inputs: Vec<&Path> =
        std::iter::once(arguments.data.as_path()).chain(inputs.iter().copied()).collect();
    let mut results =
        vec![("report.html", page.as_str()), ("extended.toml", &found.extended), ("diagnosis.json", &json)];
    if let Some(case) = &found.extended_case {
        results.push(("extended_case.toml", case));
    }
    if !found.next.is_empty() {
        results.push(("next_experiments.csv", &found.next_table));
    }
    write(&arguments.out, &inputs, &results, &found.draws)
}

/// Writes all of these names and texts and the drawn model files into a folder, or none; no file
/// may be one of `inputs`.
fn write(out: &Path, inputs: &[&Path], results: &[(&str, &str)], draws: &[String]) -> CommandResult {
    if !draws.is_empty() {
        make_folder(&out.join("draws"))?;
    }
    let named = results.iter().map(|(name, text)| ((*name).to_owned(), *text));
    let name = |number: usize| format!("draws/{:02}.toml", number + 1);
    let drawn = draws.iter().enumerate().map(|(number, text)| (name(number), text.as_str()));
    Ok(write_texts(out, inputs, named.chain(drawn))?)
}

fn summary(diagnosis: &Diagnosis) -> String {
    let mut text = format!("{}\n", diagnosis.verdict);
    for finding in &diagnosis.findings {
        let parameters: Vec<String> = finding
            .parameters
            .iter()
            .map(|(name, p)| format!("{name} = {} ({} to {}) {}", p.value, p.low, p.high, p.unit))
            .collect();
        text += &format!("  {}: {}\n", finding.cause, parameters.join(", "));
    }
    let rows = &diagnosis.rows;
    if rows.left_out() > 0 {
        text += &format!(
            "{} of {} rows were left out; report.html lists them with the reasons\n",
            rows.left_out(),
            rows.read
        );
    }
    text
}
