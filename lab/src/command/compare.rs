//! `nearwall compare`: models ranked on one file of measured impacts, or on the readings of a rig.

use std::fs::File;
use std::path::{Path, PathBuf};

use crate::atomic_file::write_texts;
use crate::dataset::{ColumnMap, WallChoice};
use crate::diagnose::comparison::{ComparedModel, Comparison, RigComparisonError, compare, compare_rig};
use crate::report::{comparison_page, comparison_text};
use crate::rig::CaseText;
use nearwall::Model;
use nearwall::input::Document;

use super::{CommandResult, progress};

/// Ranks models on measured impacts, or on the readings of a rig, with intervals
#[derive(clap::Args)]
#[command(after_help = "Example:\n  nearwall compare impacts.csv --models wax.toml softer.toml\n  \
    nearwall compare lab.csv --columns lab.map.toml --models wax.toml softer.toml --out compared\n  \
    nearwall compare rig.csv --case case.toml --models wax.toml softer.toml\n\n\
    Prints the ranking, and with --out writes compare.json and compare.html into the folder. The data file is that of\n\
    `nearwall diagnose` (docs/reference/data-file.md); rows of one `series` are drawn together. With --case the rows\n\
    are experiments of a rig (docs/how-to/rig-diagnosis.md), which the case simulates with each model.\n\
    docs/how-to/compare.md describes the method.")]
pub struct Arguments {
    /// The measured impacts
    data: PathBuf,
    /// The model files, two or more
    #[arg(long, required = true, num_args = 2.., value_name = "M.toml")]
    models: Vec<PathBuf>,
    /// A case of `nearwall simulate`: the rows are experiments on a rig; the models take the place of the case's own
    #[arg(long, value_name = "CASE.toml", conflicts_with_all = ["columns", "wall"])]
    case: Option<PathBuf>,
    /// Column map that renames and converts the columns of a laboratory's own file
    #[arg(long, value_name = "MAP.toml")]
    columns: Option<PathBuf>,
    /// Seed of the resamples; the same seed gives the same bytes
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Output folder; without it nothing is written
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The wall that is hit; by default the column `wall`, then the wall `default`, then the only wall
    #[arg(long)]
    wall: Option<String>,
}

pub fn run(arguments: &Arguments) -> CommandResult {
    let files: Vec<Document> =
        arguments.models.iter().map(|path| Document::from_file(path)).collect::<Result<_, _>>()?;
    let model = |file: &Document| Model::from_toml(file.name(), file.text());
    let models: Vec<Model> = files.iter().map(model).collect::<Result<_, _>>()?;
    let (comparison, notes) = match &arguments.case {
        Some(case) => on_rig(arguments, case, &files)?,
        None => on_impacts(arguments, &files, &models)?,
    };
    let text = comparison_text(&comparison);
    let Some(folder) = &arguments.out else { return super::print(&text) };
    write(arguments, folder, &comparison, &notes)?;
    super::print_page(&(text + "\n"), &folder.join("compare.html"))
}

/// A comparison with the notes on its data file.
type Compared = Result<(Comparison, Vec<String>), Box<dyn std::error::Error>>;

/// Compares on the readings of a rig that a case of `nearwall simulate` describes.
fn on_rig(arguments: &Arguments, case: &Path, models: &[Document]) -> Compared {
    let data = super::read_rig(&arguments.data)?;
    let case = CaseText::from_file(case)?;
    let simulated = "models simulated";
    let bar = progress::spinner(simulated);
    let told = |model: &str| progress::tell(&bar, simulated, model);
    let comparison = compare_rig(&case, &data, models, arguments.seed, &told);
    bar.finish_and_clear();
    let comparison = comparison.map_err(|error| match error {
        RigComparisonError::TooFew { .. } => format!("{}: {error}", arguments.data.display()),
        other => other.to_string(),
    });
    Ok((comparison?, data.notes))
}

/// Compares on measured impacts.
fn on_impacts(arguments: &Arguments, files: &[Document], models: &[Model]) -> Compared {
    let map = arguments.columns.as_deref().map(ColumnMap::from_file).transpose()?;
    let candidate = |(file, model): (&Document, _)| {
        let read = read(arguments, map.as_ref(), file.name(), model)?;
        Ok(read.with_fitted_rows(file.text()))
    };
    let candidates: Vec<ComparedModel<'_>> =
        files.iter().zip(models).map(candidate).collect::<Result<_, Box<dyn std::error::Error>>>()?;
    let notes = candidates.first().map_or(Vec::new(), |candidate| candidate.notes().to_vec());
    super::note(&notes);
    let file = arguments.data.display().to_string();
    let comparison = compare(&candidates, arguments.seed).map_err(|error| format!("{file}: {error}"))?;
    Ok((comparison, notes))
}

/// The data as the walls of a model read them.
fn read<'a>(
    arguments: &Arguments,
    map: Option<&ColumnMap>,
    name: &str,
    model: &'a Model,
) -> Result<ComparedModel<'a>, Box<dyn std::error::Error>> {
    let file = arguments.data.display().to_string();
    let source = File::open(&arguments.data).map_err(|error| format!("{file}: {error}"))?;
    let of_model = |error| format!("{name}: {error}");
    let walls = WallChoice::new(model, arguments.wall.as_deref()).map_err(of_model)?;
    let bar = progress::bytes(source.metadata().map_or(0, |data| data.len()), "reading");
    let source = bar.wrap_read(source);
    let read = ComparedModel::read(name.to_owned(), model, &file, source, map, &walls);
    Ok(read.map_err(|error| match error {
        crate::dataset::DatasetError::Wall(error) => of_model(error),
        other => other.to_string(),
    })?)
}

/// Writes both files, or none.
fn write(arguments: &Arguments, folder: &Path, comparison: &Comparison, notes: &[String]) -> CommandResult {
    let page = comparison_page(comparison, &arguments.data.display().to_string(), notes)?;
    let json = serde_json::to_string_pretty(comparison)? + "\n";
    let mut inputs: Vec<&Path> = arguments
        .models
        .iter()
        .chain(&arguments.columns)
        .chain(&arguments.case)
        .map(PathBuf::as_path)
        .collect();
    inputs.push(&arguments.data);
    Ok(write_texts(folder, &inputs, [("compare.json", json), ("compare.html", page)])?)
}
