//! `nearwall simulate`: a standalone case, without OpenFOAM.

use std::path::{Path, PathBuf};

use crate::atomic_file::{AtomicFile, WriteError, make_folder};
use crate::report::{number, percent, standalone_page};
use crate::results::share;
use crate::results::standalone::{Doubts, ImpactRecorder, Run, run as run_case, summary, write_deposits};
use crate::rig::{CaptureBand, CaseText, DrawnModels, add_capture_bands};
use crate::simulate::Case;

use super::{CommandResult, progress};

/// Follows particles through a prescribed gas until walls capture them or they leave
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  nearwall simulate tutorials/standalone/waxRig.toml -o waxRig\n  \
    nearwall simulate rig.toml --draws diagnosis/draws\n  \
    nearwall simulate rig.toml --set gas.temperature=350 --set particles.count=1000 -o warmer\n\n\
    Writes impacts.csv (every hit, up to a number of rows), summary.json and report.html into the folder;\n\
    with a [deposit], also deposit.csv (what lies on the walls over time).")]
pub struct Arguments {
    /// The case file
    case: PathBuf,
    /// Output folder; the case file's name without its extension by default
    #[arg(short, value_name = "DIR")]
    output: Option<PathBuf>,
    /// A setting of the case, as a dotted key; can be repeated. A [sweep] is then left out
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Folder of model files that `nearwall diagnose --draws` wrote: adds the 95 % bands of what the walls capture
    #[arg(long, value_name = "FOLDER")]
    draws: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> CommandResult {
    let mut case = read(arguments)?;
    let beside = || Path::new(arguments.case.file_stem().unwrap_or_default()).to_owned();
    let folder = arguments.output.clone().unwrap_or_else(beside);
    let draws =
        arguments.draws.as_deref().map(|draws| DrawnModels::from_folder(draws, &case.model)).transpose()?;
    let runs = write(&mut case, &folder, draws.as_ref())?;
    super::note(runs.iter().filter_map(|run| run.totals.trouble_note()));
    let mut text: String = runs.iter().map(|run| summary_of_run(&case, run)).collect();
    let doubts = Doubts::of_all(runs.iter().map(|run| &run.totals.doubts));
    doubts.lines().iter().for_each(|line| text += &format!("  {line}\n"));
    super::print_page(&text, &folder.join("report.html"))
}

/// The case with the settings that are changed, which its title then names.
fn read(arguments: &Arguments) -> CommandResult<Case> {
    if arguments.set.is_empty() {
        return Ok(Case::from_file(&arguments.case)?);
    }
    let text = CaseText::from_file(&arguments.case)?;
    let mut case = text.with("--set", &super::case_settings(&arguments.set)?)?;
    super::note(text.has_sweep().then_some("with --set the case's [sweep] is left out"));
    case.title += &format!(", {}", arguments.set.join(", "));
    Ok(case)
}

/// The particles of a run and, with drawn models, the bands of what its walls capture.
fn summary_of_run(case: &Case, run: &Run) -> String {
    let Run { totals, .. } = run;
    let swept = case.sweep.as_ref().zip(run.value);
    let mut text = swept.map_or(String::new(), |(sweep, value)| format!("{} {value}: ", sweep.key));
    let [hits, captured] = totals.first_hits();
    text += &format!(
        "{} injected = {} stuck + {} escaped + {} airborne + {} given up + {} unusable; \
         first hits captured {}; balance of mass {:.1e}\n",
        totals.ends.injected.count,
        totals.ends.captured.count,
        totals.ends.escaped.count,
        totals.ends.airborne.count,
        totals.ends.given_up.count,
        totals.ends.unusable.count,
        percent(share(captured as f64, hits as f64)),
        totals.ends.balance_error()
    );
    for CaptureBand { wall, draws, captured_mass, captured_particles, mass_share } in &run.bands {
        text += &format!(
            "  {wall}: captured {} to {} of the mass (median {}, {draws} draws), {} to {} kg, {} to {} particles\n",
            percent(mass_share.low),
            percent(mass_share.high),
            percent(mass_share.median),
            number(captured_mass.low),
            number(captured_mass.high),
            captured_particles.low.round(),
            captured_particles.high.round(),
        );
    }
    text
}

/// Runs a case and writes its files into a folder, which is created if it does not exist.
fn write(case: &mut Case, folder: &Path, draws: Option<&DrawnModels>) -> CommandResult<Vec<Run>> {
    make_folder(folder)?;
    let open = |name: &str| AtomicFile::new(&folder.join(name), &[]);
    let (impacts, mut json, mut html) = (open("impacts.csv")?, open("summary.json")?, open("report.html")?);
    let at_impacts = |error: csv::Error| WriteError::new(&folder.join("impacts.csv"), error);
    let mut recorder = ImpactRecorder::new(impacts, case).map_err(at_impacts)?;
    let runs = case.sweep.as_ref().map_or(1, |sweep| sweep.values.len() as u64);
    let bar = progress::count(runs * case.count(), "particles");
    let mut runs = run_case(case, |case, value, number, trajectory| {
        bar.inc(1);
        Ok::<_, Box<dyn std::error::Error>>(
            recorder.record(case, value, number, trajectory).map_err(at_impacts)?,
        )
    })?;
    bar.finish_and_clear();
    if let Some(draws) = draws {
        add_bands(case, &mut runs, draws)?;
    }
    let left_out = recorder.left_out;
    let impacts = recorder.finish().map_err(|error| at_impacts(error.into()))?;
    json.put(&(serde_json::to_string_pretty(&summary(case, &runs))? + "\n"))?;
    html.put(&standalone_page(case, &runs, left_out)?)?;
    let mut files = vec![impacts, json, html];
    if case.deposit.is_some() {
        let at_deposit = |error: csv::Error| WriteError::new(&folder.join("deposit.csv"), error);
        files.push(write_deposits(open("deposit.csv")?, case, &runs).map_err(at_deposit)?);
    }
    AtomicFile::commit(files)?;
    Ok(runs)
}

/// Adds the bands of the captures to each run.
fn add_bands(case: &mut Case, runs: &mut [Run], draws: &DrawnModels) -> Result<(), String> {
    if case.has_own_models() {
        eprintln!(
            "nearwall: particles with a model file of their own keep it; --draws changes only the case's model"
        );
    }
    let bar = progress::count((runs.len() * draws.models.len()) as u64, "draws");
    add_capture_bands(case, runs, draws, &|| bar.inc(1)).map_err(|error| error.to_string())?;
    bar.finish_and_clear();
    Ok(())
}
