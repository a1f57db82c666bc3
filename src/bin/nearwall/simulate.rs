//! `nearwall simulate`: a standalone case, without OpenFOAM.

use std::path::{Path, PathBuf};

use nearwall::report::percent;
use nearwall::simulate::{Case, Tally, write};

use crate::{CommandResult, progress};

/// Follows particles through a prescribed gas until walls catch them or they are gone
#[derive(clap::Args)]
#[command(after_help = "Example:\n  nearwall simulate tutorials/standalone/waxRig.toml -o waxRig\n\n\
    Writes impacts.csv (every hit, up to a number of rows), summary.json and report.html into the folder.")]
pub struct Arguments {
    /// The case file
    case: PathBuf,
    /// Where to write; the case file's name without its ending if not given
    #[arg(short, value_name = "DIR")]
    output: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> CommandResult {
    let mut case = Case::from_file(&arguments.case)?;
    let beside = || Path::new(arguments.case.file_stem().unwrap_or_default()).to_owned();
    let folder = arguments.output.clone().unwrap_or_else(beside);
    let runs = case.sweep.as_ref().map_or(1, |sweep| sweep.values.len() as u64);
    let bar = progress::count(runs * case.injection.count, "particles");
    let results = write(&mut case, &folder, || bar.inc(1))?;
    bar.finish_and_clear();
    let mut text = String::new();
    for run in &results {
        let tally = &run.tally;
        let swept = case.sweep.as_ref().zip(run.value);
        text += &swept.map_or(String::new(), |(sweep, value)| format!("{} {value}: ", sweep.key));
        text += &format!(
            "{} injected = {} stuck + {} escaped + {} airborne + {} given up + {} unusable; first hits captured {}; balance of mass {:.1e}\n",
            tally.injected.count,
            tally.stuck.count,
            tally.escaped.count,
            tally.airborne.count,
            tally.given_up.count,
            tally.unusable.count,
            first_capture(tally),
            tally.balance_error()
        );
        if let Some(trouble) = &tally.first_trouble {
            eprintln!("nearwall: {} particles could not be used; the first: {trouble}", tally.unusable.count);
        }
    }
    let page = crate::report::whole(&folder.join("report.html"));
    crate::print(&format!("{text}open {}\n", page.display()))
}

/// What a rig that watches single impacts would see, beside what sticks after many.
fn first_capture(tally: &Tally) -> String {
    match tally.first_hits() {
        [0, _] => "–".to_owned(),
        [hits, stuck] => percent(stuck as f64 / hits as f64),
    }
}
