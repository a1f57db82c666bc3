//! `nearwall bench`: laws, models and other programs on every measured set of the project.

use std::path::{Path, PathBuf};

use crate::diagnose::benchmark::{Benchmark, BenchmarkEntry, EntryKind};
use crate::report::benchmark_text;
use crate::rig::DrawnModels;
use nearwall::Model;
use nearwall::input::{Document, unknown};

use super::CommandResult;

/// The law whose failures are shown where none is asked for.
const DEFAULT_LAW: &str = "thornton-ning";

/// Scores laws, a model or another program on all measured sets of the project
#[derive(clap::Args)]
#[command(
    after_help = "Examples:\n  nearwall bench                               all laws, and where the default one \
        fails\n  nearwall bench bons                          the same for another law\n  \
    nearwall bench my.toml                       the laws of a model file with the materials of each set\n  \
    nearwall bench --external 'python3 law.py'   a program that reads impacts and writes e_n,e_t,p\n\n\
    A program reads the table that --impacts prints on standard input and writes a heading with e_n, e_t and p (and\n\
    e_n_low, e_n_high, e_t_low, e_t_high if it has bands) and one row for each impact; a blank cell is no answer.\n\
    docs/how-to/bench.md describes the method."
)]
pub struct Arguments {
    /// A model file, or the name of a law
    #[arg(value_name = "MODEL.toml | LAW")]
    model: Option<String>,
    /// A program that turns a table of impacts into one of e_n, e_t and p; run by `sh`
    #[arg(long, value_name = "COMMAND")]
    external: Option<String>,
    /// Folder of model files that `nearwall diagnose --draws` wrote: tells how many readings lie in the model's bands
    #[arg(long, value_name = "FOLDER", requires = "model")]
    draws: Option<PathBuf>,
    /// Folder with further measured sets: sub-folders with data.csv, base.toml and, if needed, columns.toml
    #[arg(long, value_name = "FOLDER")]
    data: Option<PathBuf>,
    /// Print the table of impacts that --external reads, and stop
    #[arg(long, conflicts_with_all = ["model", "external"])]
    impacts: bool,
}

pub fn run(arguments: &Arguments) -> CommandResult {
    let names = Benchmark::law_names();
    let named = arguments.model.as_deref();
    let is_file = |name: &str| Path::new(name).is_file() || name.ends_with(".toml");
    let (file, law) = (named.filter(|name| is_file(name)), named.filter(|name| !is_file(name)));
    if let Some(law) = law.filter(|law| !names.iter().any(|name| name == law)) {
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        return Err(format!("{}; or give a model file", unknown(law, "law", &names)).into());
    }
    let file = file.map(|path| Document::from_file(path.as_ref())).transpose()?;
    let mut benchmark = Benchmark::new(arguments.data.as_deref())?;
    if arguments.impacts {
        return super::print(&benchmark.impacts()?);
    }
    if let Some(file) = &file {
        benchmark.add_model(file.name(), file.text(), &drawn_texts(file, arguments.draws.as_deref())?)?;
    }
    if let Some(command) = &arguments.external {
        benchmark.add_external(command)?;
    }
    let result = benchmark.run();
    let own = file.is_some() || arguments.external.is_some();
    let is_chosen = |entry: &&BenchmarkEntry| match (law, own) {
        (Some(law), _) if entry.name == law => true,
        (None, false) => entry.name == DEFAULT_LAW,
        _ => entry.kind == EntryKind::Whole,
    };
    let chosen = result.entries.iter().filter(is_chosen);
    let chosen: Vec<_> = chosen.map(|entry| (entry, benchmark.shortfalls(entry))).collect();
    super::print(&benchmark_text(&result, &chosen, own || law.is_some()))
}

/// The texts of the models that were drawn from the fit of a model, which is checked; none without a folder.
fn drawn_texts(file: &Document, folder: Option<&Path>) -> CommandResult<Vec<String>> {
    let model = Model::from_toml(file.name(), file.text())?;
    let drawn = folder.map(|folder| DrawnModels::from_folder(folder, &model)).transpose()?;
    let files = drawn.into_iter().flat_map(|drawn| drawn.files);
    Ok(files.map(std::fs::read_to_string).collect::<Result<_, _>>()?)
}
