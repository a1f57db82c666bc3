//! Results of finished OpenFOAM cases.
//!
//! Sources are the tables of nearWallInteraction ([`tables`], [`deposit`]), the counts of the stock
//! models in the logs ([`log`]), the arrivals that the cloud function `patchPostProcessing`
//! recorded ([`recorded`]), and the captured parcels of the last written time ([`parcels`]), its
//! fields on the walls ([`surfaces`]), and the gas with the parcels in it ([`gas`]).
//! [`impact_history`] reads the impacts of each parcel. What is missing is listed in
//! [`RunResults::missing`].

mod cells;
pub mod deposit;
mod foam_file;
pub mod gas;
pub mod impact_history;
pub mod log;
mod mesh;
mod outside_ranges;
mod parcel_lists;
pub mod parcels;
pub mod recorded;
pub mod surfaces;
pub mod table;
pub mod tables;
mod written_time;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::surface::add_regimes;
use super::{BalanceLine, RunResults, WallModel, common_time};

pub use foam_file::FoamError;

/// A folder that holds no case.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CaseError {
    /// There is no such folder.
    #[error("{0}: there is no such folder; give the folder of a finished OpenFOAM case")]
    NoFolder(String),
    /// The folder is something else; the second text names the cases below it.
    #[error(
        "{0}: not an OpenFOAM case (it has no system/controlDict); give the folder that the solver ran in{1}"
    )]
    NotACase(String, String),
    /// A case that ran, but into which no parcel came.
    #[error(
        "{0}: the run has results, but no parcel was injected or hit a wall until its end; run it beyond the start of \
            the injection (SOI of its injectors)"
    )]
    NoParcels(String),
    /// A case that has not run, or whose results are not where they are looked for; the second text as above.
    #[error(
        "{0}: no results found: neither postProcessing/nearWallInteraction nor a log.* with \"Parcel fate\" lines; run \
         the case first and keep the solver's output in log.<solver>{1}"
    )]
    NoResults(String, String),
}

/// Reads a finished case: one result for each cloud with an injection or a hit.
///
/// # Errors
/// [`CaseError`] when the folder is no case or holds no results.
pub fn read(folder: &Path) -> Result<Vec<RunResults>, CaseError> {
    read_all(&[folder])
}

/// Reads finished cases for a comparison: as [`read`], with the recorded arrivals up to the last
/// time that all have reached.
///
/// # Errors
/// [`CaseError`] of the first folder that is no case or holds no results.
pub fn read_all(folders: &[&Path]) -> Result<Vec<RunResults>, CaseError> {
    let mut runs: Vec<(&Path, RunResults)> = Vec::new();
    for folder in folders {
        runs.extend(read_tables(folder)?.into_iter().map(|results| (*folder, results)));
    }
    let until = common_time(runs.iter().map(|(_, results)| results));
    Ok(runs.into_iter().map(|(folder, results)| complete(folder, results, until)).collect())
}

/// Reads the tables and logs of a case.
fn read_tables(folder: &Path) -> Result<Vec<RunResults>, CaseError> {
    let shown = folder.display().to_string();
    if !folder.is_dir() {
        return Err(CaseError::NoFolder(shown));
    }
    if !folder.join("system/controlDict").is_file() {
        return Err(CaseError::NotACase(shown, cases_below(folder)));
    }
    let whole = std::fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
    let case = whole.file_name().map_or(shown.clone(), |name| name.to_string_lossy().into_owned());
    let mut clouds: BTreeMap<String, RunResults> = BTreeMap::new();
    let tables = folder.join("postProcessing/nearWallInteraction");
    for cloud in entries(&tables, Path::is_dir) {
        tables::read_into(clouds.entry(file_name(&cloud).to_owned()).or_default(), &cloud);
    }
    for (cloud, log) in log::read_all(folder) {
        let results = clouds.entry(cloud).or_default();
        if results.walls.is_empty() {
            results.walls = log.walls;
        }
        if results.injected.is_empty() {
            results.injected = log.injected;
        }
        results.escaped = log.escaped;
    }
    let has_run = !clouds.is_empty();
    clouds.retain(|_, results| is_active(results));
    if has_run && clouds.is_empty() {
        return Err(CaseError::NoParcels(shown));
    }
    if clouds.is_empty() {
        return Err(CaseError::NoResults(shown, cases_below(folder)));
    }
    let names = |(cloud, results)| RunResults { case: case.clone(), cloud, ..results };
    Ok(clouds.into_iter().map(names).collect())
}

fn is_active(results: &RunResults) -> bool {
    let mut totals = results.walls.iter().filter_map(|wall| wall.rows.last());
    results.injected.last().is_some_and(|[_, mass]| *mass > 0.0)
        || totals.any(|(_, totals)| {
            let hits = totals.hits.unwrap_or_default();
            [hits, totals.captured, totals.escaped].iter().any(|amount| amount.count > 0)
        })
}

/// A hint at the cases in a folder, one or two levels down; empty when there are none.
fn cases_below(folder: &Path) -> String {
    let is_case = |path: &PathBuf| path.join("system/controlDict").is_file();
    let mut cases = Vec::new();
    for path in entries(folder, Path::is_dir) {
        if is_case(&path) {
            cases.push(path);
        } else {
            cases.extend(entries(&path, Path::is_dir).into_iter().filter(is_case));
        }
    }
    if cases.is_empty() {
        return String::new();
    }
    let more = if cases.len() > 5 { format!(" and {} more", cases.len() - 5) } else { String::new() };
    let shown: Vec<String> = cases.iter().take(5).map(|path| path.display().to_string()).collect();
    format!(". Cases below it: {}{more}", shown.join(" "))
}

/// Adds what other files of the case state about the cloud; `until` is the time of the comparison [s].
fn complete(folder: &Path, mut results: RunResults, until: f64) -> RunResults {
    let cloud = results.cloud.clone();
    let properties = interaction_properties(folder, &cloud);
    results.wall_model = match properties.as_deref().and_then(|text| entry(text, "patchInteractionModel")) {
        Some("nearWallInteraction") => WallModel::Nearwall,
        Some(name) => WallModel::Other(name.to_owned()),
        None => WallModel::Unknown,
    };
    results.steady = is_steady(folder, &cloud);
    if results.is_ours() {
        let stuck = properties.as_deref().and_then(|text| entry(text, "stuck"));
        results.stuck = Some(stuck.unwrap_or("keep").to_owned());
    }
    let patches = mesh::patches_in(&folder.join("constant/polyMesh/boundary")).unwrap_or_default();
    let walls = patches.into_iter().filter(|patch| patch.kind == "wall");
    results.wall_patches = walls.map(|patch| patch.name).collect();
    let tables = folder.join("postProcessing/nearWallInteraction").join(&cloud);
    results.outside_ranges = outside_ranges::read_last(&tables);
    add_arrivals(folder, &mut results, until);
    match parcels::read_last(folder, &cloud) {
        Ok(captures) => results.captures = captures,
        Err(error) => results.missing.push(error.to_string()),
    }
    match surfaces::read_last(folder, &cloud) {
        Ok(surfaces) => results.surfaces = surfaces,
        Err(error) => results.missing.push(error.to_string()),
    }
    add_regimes(&mut results.surfaces, &results.captures);
    match gas::read_last(folder, &cloud) {
        Ok(gas) => results.gas = gas,
        Err(error) => results.missing.push(error.to_string()),
    }
    if results.injected.is_empty() {
        let note = "neither tables nor logs give the injected mass, so shares of it are unknown";
        results.missing.push(note.to_owned());
    }
    complete_balance(&mut results);
    results
}

/// Adds the recorded arrivals.
fn add_arrivals(folder: &Path, results: &mut RunResults, until: f64) {
    let carbon = recorded::Carbon::of(folder, &results.cloud);
    results.has_carbon = carbon.is_some();
    results.arrivals = recorded::read_all(folder, &results.cloud, carbon.as_ref(), until);
    let counted =
        results.walls.iter().any(|wall| wall.rows.last().is_some_and(|(_, row)| row.hits.is_some()));
    if results.arrivals.is_empty() {
        let unknown = if counted { "the conversion of arriving parcels is" } else { "arrivals are" };
        let note =
            format!("the cloud function patchPostProcessing recorded no arrivals, so {unknown} unknown");
        results.missing.push(note);
    } else if carbon.is_none() {
        let note =
            "the cloud's properties name no solid carbon, so the conversion of arriving parcels is unknown";
        results.missing.push(note.to_owned());
    }
}

/// Adds to the balance the captured mass and, for a stock model, the injected and the escaped mass.
fn complete_balance(results: &mut RunResults) {
    let line = |what: &str, mass| BalanceLine { what: what.to_owned(), count: None, mass };
    if results.balance.is_empty() {
        let injected = results.injected.last().map(|[_, mass]| *mass);
        results.balance = vec![line("injected", injected), line("escaped", escaped_mass(results))];
    }
    let captured = results.captured_mass(f64::MAX);
    results.balance.insert(1, line("captured, mass at capture", Some(captured)));
}

/// Mass [kg] that has left a case without a balance: what the patches count, else the log's sum over all patches, else
/// what was recorded at patches that are no walls.
fn escaped_mass(results: &RunResults) -> Option<f64> {
    let rows = results.walls.iter().filter_map(|wall| wall.rows.last());
    let counted: f64 = rows.map(|(_, totals)| totals.escaped.mass()).sum();
    if counted > 0.0 || results.is_ours() {
        return Some(counted);
    }
    if let Some([_, mass]) = results.escaped.last() {
        return Some(*mass);
    }
    let leaving = results.arrivals.iter().filter(|arrivals| !results.wall_patches.contains(&arrivals.patch));
    let recorded: f64 = leaving.map(|arrivals| arrivals.whole_run.mass()).sum();
    (!results.wall_patches.is_empty() && recorded > 0.0).then_some(recorded)
}

/// The text of the file that names the cloud's `patchInteractionModel`: its own properties, else another file of
/// `constant`.
fn interaction_properties(folder: &Path, cloud: &str) -> Option<String> {
    let own = folder.join(format!("constant/{cloud}Properties"));
    let small = |path: &PathBuf| path.metadata().is_ok_and(|data| data.len() < 1 << 20);
    let others = entries(&folder.join("constant"), Path::is_file).into_iter().filter(small);
    std::iter::once(own).chain(others).find_map(|path| {
        let text = std::fs::read_to_string(path).ok()?;
        entry(&text, "patchInteractionModel").is_some_and(|model| model != "none").then_some(text)
    })
}

/// Whether the cloud's own file says `transient no`.
fn is_steady(folder: &Path, cloud: &str) -> bool {
    let text =
        std::fs::read_to_string(folder.join(format!("constant/{cloud}Properties"))).unwrap_or_default();
    matches!(entry(&text, "transient"), Some("no" | "off" | "false"))
}

/// The value of a dictionary entry `key value;`.
fn entry<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let mut words = text.split_whitespace().skip_while(|word| *word != key).skip(1);
    words.next().map(|word| word.trim_end_matches(';')).filter(|word| !word.is_empty())
}

/// Sub-folders whose names are times, in the order of time.
fn time_folders(folder: &Path) -> Vec<(f64, PathBuf)> {
    let time = |path: PathBuf| Some((file_name(&path).parse::<f64>().ok()?, path));
    let mut times: Vec<(f64, PathBuf)> = entries(folder, Path::is_dir)
        .into_iter()
        .filter_map(time)
        .filter(|(time, _)| time.is_finite())
        .collect();
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    times
}

/// The files or the sub-folders of a folder in the order of their names.
fn entries(folder: &Path, is_wanted: fn(&Path) -> bool) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut paths: Vec<PathBuf> = entries.filter(|path| is_wanted(path)).collect();
    paths.sort();
    paths
}

/// The last part of a path; empty when it is not UTF-8.
fn file_name(path: &Path) -> &str {
    path.file_name().and_then(|name| name.to_str()).unwrap_or_default()
}
