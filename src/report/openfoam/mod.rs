//! Finished OpenFOAM cases: what the solvers left behind, and a page that sets cases side by side.
//!
//! Read are, where they are there: the tables of `nearWallInteraction` ([`tables`], [`distributions`]), the fates of parcels
//! in the logs of the stock models ([`log`]), the arrivals that the stock cloud function `patchPostProcessing` recorded
//! ([`arrivals`]), and the parcels of the last written time ([`parcels`]). What is missing is noted and said on the page.

pub mod arrivals;
mod arriving;
mod compare;
pub mod distributions;
pub mod log;
pub mod parcels;
pub mod tables;

pub use compare::page;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use arrivals::Arrival;
use distributions::Distributions;
use parcels::Parcel;
use tables::PatchHistory;

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
    /// A case that has not run, or whose results are not where they are looked for; the second text as above.
    #[error(
        "{0}: no results found: neither postProcessing/nearWallInteraction nor a log.* with \"Parcel fate\" lines; run \
         the case first and keep the solver's output in log.<solver>{1}"
    )]
    NoResults(String, String),
}

/// What a finished case has to say about one cloud.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CloudResult {
    /// The case's folder name.
    pub case: String,
    /// The cloud's name.
    pub cloud: String,
    /// The patch interaction model that the case names, for instance `localInteraction`.
    pub model: Option<String>,
    /// What happened at each patch.
    pub patches: Vec<PatchHistory>,
    /// What arrived at each patch by speed, angle and size; empty for other models.
    pub distributions: Vec<Distributions>,
    /// Time [s] and injected mass [kg].
    pub injected: Vec<[f64; 2]>,
    /// Time [s] and mass [kg] that left through any patch, where a log says so.
    pub escaped: Vec<[f64; 2]>,
    /// The last row of the mass balance: name and value.
    pub balance: Vec<(String, f64)>,
    /// Arrivals at the walls, in the order of time; empty where none were recorded.
    pub arrivals: Vec<Arrival>,
    /// Parcels at the last written time.
    pub parcels: Vec<Parcel>,
    /// The mesh's patches of type `wall`; empty where the mesh is not there.
    pub wall_patches: Vec<String>,
    /// Whether the cloud's properties name solid carbon.
    pub has_carbon: bool,
    /// What could not be found.
    pub missing: Vec<String>,
}

impl CloudResult {
    /// Whether our model decided the hits.
    pub fn is_ours(&self) -> bool {
        self.model.as_deref() == Some("nearWallInteraction")
    }

    /// Injected mass [kg] at a time [s]: the last known before it.
    pub fn injected_at(&self, time: f64) -> Option<f64> {
        self.injected.iter().take_while(|[t, _]| *t <= time * (1.0 + 1e-9)).last().map(|[_, mass]| *mass)
    }

    /// Mass [kg] that has left: our balance, else the patches that count it, else the log's sum over all patches, else
    /// what was recorded at patches that are no walls. `None` where nothing tells.
    pub fn escaped_mass(&self) -> Option<f64> {
        if let Some(mass) = tables::value(&self.balance, "escaped_kg") {
            return Some(mass);
        }
        let rows = self.patches.iter().filter_map(|patch| patch.rows.last());
        let counted: f64 = rows.map(|row| row.escape_mass).sum();
        if counted > 0.0 || self.is_ours() {
            return Some(counted);
        }
        if let Some([_, mass]) = self.escaped.last() {
            return Some(*mass);
        }
        let leaving = self.arrivals.iter().filter(|arrival| !self.wall_patches.contains(&arrival.patch));
        let recorded: f64 = leaving.map(|arrival| arrival.mass).sum();
        (!self.wall_patches.is_empty() && recorded > 0.0).then_some(recorded)
    }

    /// The last time [s] of which anything is known.
    pub fn last_time(&self) -> f64 {
        let tables = self.patches.iter().filter_map(|patch| patch.rows.last()).map(|row| row.time);
        let injected = self.injected.iter().map(|[time, _]| *time);
        tables.chain(injected).fold(0.0, f64::max)
    }

    /// The patch of this name.
    pub fn patch(&self, name: &str) -> Option<&PatchHistory> {
        self.patches.iter().find(|patch| patch.covers(name))
    }
}

/// Reads a finished case: one result for each cloud that did anything.
///
/// # Errors
/// [`CaseError`] when the folder is no case or holds no results.
pub fn read(folder: &Path) -> Result<Vec<CloudResult>, CaseError> {
    let shown = folder.display().to_string();
    if !folder.is_dir() {
        return Err(CaseError::NoFolder(shown));
    }
    if !folder.join("system/controlDict").is_file() {
        let below = cases_below(folder);
        return Err(CaseError::NotACase(shown, below));
    }
    let whole = std::fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
    let case = whole.file_name().map_or(shown.clone(), |name| name.to_string_lossy().into_owned());
    let logs = log::read_all(folder);
    let mut clouds: BTreeMap<String, CloudResult> = BTreeMap::new();
    for (cloud, patches, balance) in tables::read_all(folder) {
        let result = clouds.entry(cloud).or_default();
        result.patches = patches;
        result.injected = balance.iter().filter_map(tables::injected).collect();
        result.balance = balance.last().cloned().unwrap_or_default();
    }
    for (cloud, fates) in logs {
        let result = clouds.entry(cloud).or_default();
        if result.patches.is_empty() {
            result.patches = fates.patches;
        }
        if result.injected.is_empty() {
            result.injected = fates.injected;
        }
        result.escaped = fates.escaped;
    }
    clouds.retain(|_, result| result.did_anything());
    if clouds.is_empty() {
        return Err(CaseError::NoResults(shown, cases_below(folder)));
    }
    Ok(clouds.into_iter().map(|(cloud, result)| finish(folder, &case, cloud, result)).collect())
}

impl CloudResult {
    fn did_anything(&self) -> bool {
        self.injected.last().is_some_and(|[_, mass]| *mass > 0.0)
            || self.patches.iter().any(|patch| patch.rows.last().is_some_and(|row| row.is_something()))
    }
}

/// A hint at the cases in a folder, one or two levels down; empty when there are none.
fn cases_below(folder: &Path) -> String {
    let is_case = |path: &PathBuf| path.join("system/controlDict").is_file();
    let inside = |path: &Path| folders(path).into_iter().map(|name| path.join(name)).collect::<Vec<_>>();
    let mut cases = Vec::new();
    for path in inside(folder) {
        if is_case(&path) {
            cases.push(path);
        } else {
            cases.extend(inside(&path).into_iter().filter(is_case));
        }
    }
    if cases.is_empty() {
        return String::new();
    }
    let more = if cases.len() > 5 { format!(" and {} more", cases.len() - 5) } else { String::new() };
    let shown: Vec<String> = cases.iter().take(5).map(|path| path.display().to_string()).collect();
    format!(". Cases below it: {}{more}", shown.join(" "))
}

/// Adds what is kept per cloud elsewhere in the case.
fn finish(folder: &Path, case: &str, cloud: String, mut result: CloudResult) -> CloudResult {
    case.clone_into(&mut result.case);
    result.model = interaction_model(folder, &cloud);
    result.wall_patches = wall_patches(folder);
    result.distributions = distributions::read_all(folder, &cloud);
    let carbon = arrivals::Carbon::of(folder, &cloud);
    result.has_carbon = carbon.is_some();
    result.arrivals = arrivals::read_all(folder, &cloud, carbon.as_ref());
    let mut note = |what: String| result.missing.push(what);
    if result.arrivals.is_empty() {
        note(
            "no record of arrivals (cloud function patchPostProcessing), so where and in which state parcels arrive is \
             not shown"
                .into(),
        );
    } else if carbon.is_none() {
        note("no solid carbon in the cloud's properties, so conversion on arrival is not shown".into());
    }
    match parcels::read_last(folder, &cloud) {
        Ok(parcels) => result.parcels = parcels,
        Err(reason) => note(reason),
    }
    if result.injected.is_empty() {
        note("no injected mass in the tables or logs, so nothing is shown as a share of it".into());
    }
    result.cloud = cloud;
    result
}

/// The `patchInteractionModel` of a cloud: from its own properties, else from the one file of `constant` that names one.
fn interaction_model(folder: &Path, cloud: &str) -> Option<String> {
    let own = folder.join(format!("constant/{cloud}Properties"));
    let mut others = files(&folder.join("constant"));
    others.sort();
    std::iter::once(own).chain(others).find_map(|path| {
        let text = std::fs::read_to_string(path).ok()?;
        let mut words = text.split_whitespace().skip_while(|word| *word != "patchInteractionModel").skip(1);
        let word = words.next()?.trim_end_matches(';');
        (word != "none" && !word.is_empty()).then(|| word.to_owned())
    })
}

/// The patches of type `wall` in `constant/polyMesh/boundary`.
fn wall_patches(folder: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(folder.join("constant/polyMesh/boundary")).unwrap_or_default();
    let body = text.split_once('(').map_or("", |(_, body)| body);
    let wall = |entry: &str| {
        let (name, content) = entry.split_once('{')?;
        let kind = content.split_whitespace().skip_while(|word| *word != "type").nth(1)?;
        (kind.trim_end_matches(';') == "wall").then(|| name.trim().to_owned())
    };
    body.split('}').filter_map(wall).collect()
}

/// The files of a folder that are not larger than a dictionary may be.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let small = |path: &PathBuf| path.metadata().is_ok_and(|data| data.is_file() && data.len() < 1 << 20);
    entries.map(|entry| entry.path()).filter(small).collect()
}

/// Sub-folders whose names are times, in the order of time.
fn time_folders(folder: &Path) -> Vec<(f64, PathBuf)> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut times: Vec<(f64, PathBuf)> = entries
        .filter(|path| path.is_dir())
        .filter_map(|path| Some((path.file_name()?.to_str()?.parse::<f64>().ok()?, path)))
        .filter(|(time, _)| time.is_finite())
        .collect();
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    times
}

/// Names of the sub-folders, sorted.
fn folders(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries
        .filter(|entry| entry.path().is_dir())
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}
