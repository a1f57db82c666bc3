//! `validation`: runs every study and writes the page.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use validation::{Claim, Extent, STUDIES, SourceStudy, Verdict, page, summary};

/// Both source papers and independent checks, reproduced on one page.
#[derive(Debug, Parser)]
#[command(after_help = "Example: validation --out target/validation")]
struct Arguments {
    /// Folder for report.html and claims.csv.
    #[arg(long, default_value = "target/validation")]
    out: PathBuf,
    /// Fewer draws and coarser steps, as in the tests; the summary is then not compared.
    #[arg(long)]
    short: bool,
    /// The summary kept beside the code: the run fails when it says something else. NEARWALL_BLESS=1 writes it anew.
    #[arg(long, default_value = "docs/why/validation.md")]
    summary: PathBuf,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("validation: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Whether every statement agrees or says why it does not.
fn run(arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let extent = if arguments.short { Extent::Short } else { Extent::Full };
    let mut studies = Vec::new();
    for (name, make) in STUDIES {
        let study = make(extent).map_err(|error| format!("{name}: {error}"))?;
        let [agree, differ, open] =
            [Verdict::Agrees, Verdict::Differs, Verdict::Unchecked].map(|verdict| study.count(verdict));
        println!("{name}: {agree} agree, {differ} differ, {open} cannot be checked");
        studies.push(study);
    }
    let folder = &arguments.out;
    let written =
        |path: PathBuf, text: String| fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()));
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    written(folder.join("report.html"), page::page(&studies).html()?)?;
    println!("{}", folder.join("report.html").display());
    let unexplained: Vec<&Claim> = studies.iter().flat_map(SourceStudy::unexplained).collect();
    for claim in &unexplained {
        eprintln!(
            "no reason given: {} {}: {} here, {} there",
            claim.place, claim.what, claim.ours, claim.published
        );
    }
    let kept = arguments.short || keep(&arguments.summary, &summary::summary(&studies))?;
    Ok(unexplained.is_empty() && kept)
}

/// Whether the kept summary is the one of this run; writes it where the caller wants that.
fn keep(path: &Path, text: &str) -> Result<bool, Box<dyn Error>> {
    let fault = |error: std::io::Error| format!("{}: {error}", path.display());
    if std::env::var_os("NEARWALL_BLESS").is_some() {
        fs::write(path, text).map_err(fault)?;
        return Ok(true);
    }
    let kept = fs::read_to_string(path).map_err(fault)?;
    let mut pairs = kept.lines().zip(text.lines());
    if let Some((old, new)) = pairs.find(|(old, new)| !summary::alike(old, new)) {
        eprintln!(
            "{} is not what this run says; look at the difference, then NEARWALL_BLESS=1 validation/run",
            path.display()
        );
        eprintln!("  kept: {old}\n  now:  {new}");
        return Ok(false);
    }
    Ok(kept.lines().count() == text.lines().count())
}
