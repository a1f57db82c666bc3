//! `nearwall sensitivity`: the numbers on which the captures of a standalone case depend.

use std::path::{Path, PathBuf};

use crate::atomic_file::{AtomicFile, WriteError, make_folder};
use crate::report::{number, percent, sensitivity_page};
use crate::rig::CaseText;
use crate::rig::sensitivity::{Quality, Sensitivity, SensitivityCase};

use super::{CommandResult, progress};

/// Ranks the numbers of a case by their effect on what its walls capture
#[derive(clap::Args)]
#[command(
    after_help = "Examples:\n  nearwall sensitivity tutorials/standalone/gasifier.toml --clean-walls -o \
        gasifierNumbers\n  nearwall sensitivity tutorials/standalone/waxRig.toml --set gas.temperature=358.15 \\\n    \
    --set particles.temperature=358.15 --set walls.target.temperature=358.15\n\n\
    Moves each number of the materials, the model and the case down and up within its range, and writes \
    sensitivity.csv,\n\
    sensitivity.json and report.html into the folder. docs/how-to/forecast.md describes the ranges. A [sweep] is left \
    out."
)]
pub struct Arguments {
    /// The case file
    case: PathBuf,
    /// Output folder; the case file's name without its extension and `-sensitivity` by default
    #[arg(short, value_name = "DIR")]
    output: Option<PathBuf>,
    /// A setting of the case, as a dotted key; can be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Most particles that are followed for each number
    #[arg(long, value_name = "N", default_value_t = 1000)]
    particles: u64,
    /// Leave out the case's [deposit]: walls without a memory take far less time and have no random captures
    #[arg(long)]
    clean_walls: bool,
}

/// Numbers that are printed.
const PRINTED: usize = 20;

pub fn run(arguments: &Arguments) -> CommandResult {
    let mut text = CaseText::from_file(&arguments.case)?;
    text.change("--set", &super::case_settings(&arguments.set)?)?;
    let case = SensitivityCase::new(text, arguments.particles.max(1), arguments.clean_walls);
    let at_case = |error: crate::rig::PredictionError| format!("{}: {error}", arguments.case.display());
    let case = case.map_err(at_case)?;
    let bar = progress::count(case.count() as u64, "numbers");
    let mut found = case.run(&|| bar.inc(1)).map_err(at_case)?;
    bar.finish_and_clear();
    if !arguments.set.is_empty() {
        found.notes.insert(0, format!("changed by --set: {}", arguments.set.join(", ")));
    }
    let beside = || {
        let name = arguments.case.file_stem().unwrap_or_default().to_string_lossy();
        Path::new(&format!("{name}-sensitivity")).to_owned()
    };
    let folder = arguments.output.clone().unwrap_or_else(beside);
    write(&found, &folder, &arguments.case)?;
    super::note(&found.notes);
    super::print_page(&table(&found), &folder.join("report.html"))
}

fn table(found: &Sensitivity) -> String {
    let mut text = format!(
        "{:<52} {:>10} {:>10} {:>10}  captured low / as it is / high\n",
        "number", "low", "value", "high"
    );
    for effect in found.numbers.iter().take(PRINTED) {
        let walls = effect.walls.iter().map(|wall| {
            let shares = [wall.captured_low, wall.captured, wall.captured_high].map(percent);
            format!("{} {}", wall.wall, shares.join(" / "))
        });
        let quality = if effect.quality == Quality::Assumed { "  assumed" } else { "" };
        text += &format!(
            "{:<52} {:>10} {:>10} {:>10}  {}{quality}\n",
            effect.key,
            number(effect.low),
            number(effect.value),
            number(effect.high),
            walls.collect::<Vec<_>>().join("; ")
        );
    }
    let none = found.numbers.iter().filter(|effect| effect.largest == 0.0).count();
    text += &format!("{} numbers moved, {none} of them without any effect\n", found.numbers.len());
    text
}

/// Writes all output files, or none.
fn write(found: &Sensitivity, folder: &Path, case: &Path) -> CommandResult {
    make_folder(folder)?;
    let open = |name: &str| AtomicFile::new(&folder.join(name), &[case]);
    let (mut json, mut html) = (open("sensitivity.json")?, open("report.html")?);
    let at_csv = |error: csv::Error| WriteError::new(&folder.join("sensitivity.csv"), error);
    let csv = found.write_csv(open("sensitivity.csv")?).map_err(at_csv)?;
    json.put(&(serde_json::to_string_pretty(found)? + "\n"))?;
    html.put(&sensitivity_page(found)?)?;
    Ok(AtomicFile::commit([csv, json, html])?)
}
