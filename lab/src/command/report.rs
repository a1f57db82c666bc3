//! `nearwall report`: the page of finished OpenFOAM cases.

use std::path::{Path, PathBuf};

use crate::atomic_file::AtomicFile;
use crate::report::{openfoam_page, sweep};
use crate::results::openfoam;

use super::CommandResult;

/// Plots finished OpenFOAM cases, one or several side by side
#[derive(clap::Args)]
#[command(
    after_help = "Example:\n  nearwall report run/nearWall run/localInteraction run/standardWall -o report.html\n\n\
    Reads postProcessing/nearWallInteraction, log.* (the stock models' parcel fates), postProcessing/lagrangian\n\
    (patchPostProcessing) and the parcels of the last time, as far as they exist; the page lists what is missing."
)]
pub struct Arguments {
    /// Folders of finished cases, or one table of runs (.csv) with simulated and published numbers
    #[arg(required = true)]
    cases: Vec<PathBuf>,
    /// Output file; by default report.html in the folder of a single case, else in the current folder
    #[arg(short, value_name = "FILE")]
    output: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> CommandResult {
    if let [table] = arguments.cases.as_slice()
        && table.extension().is_some_and(|ending| ending == "csv")
    {
        let output = arguments.output.clone().unwrap_or_else(|| table.with_extension("html"));
        return write(&output, &[table], &sweep::page(table)?);
    }
    let folders: Vec<&Path> = arguments.cases.iter().map(PathBuf::as_path).collect();
    let results = openfoam::read_all(&folders)?;
    let output = match (&arguments.output, arguments.cases.as_slice()) {
        (Some(output), _) => output.clone(),
        (None, [case]) => case.join("report.html"),
        (None, _) => PathBuf::from("report.html"),
    };
    write(&output, &[], &openfoam_page(&results)?)
}

fn write(output: &Path, inputs: &[&Path], page: &str) -> CommandResult {
    let mut file = AtomicFile::new(output, inputs)?;
    file.put(page)?;
    AtomicFile::commit([file])?;
    super::print_page("", output)
}
