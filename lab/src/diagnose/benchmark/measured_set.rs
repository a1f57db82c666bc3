//! Sets of measured impacts: those of the project, which the command carries, and folders of a user's own.

use std::borrow::Cow;
use std::path::Path;

use super::BenchmarkError;
use super::published::published_sets;
use crate::dataset::{ColumnMap, Measurements, WallChoice};
use nearwall::model::Model;

/// Measured impacts with the materials of particle and wall.
#[derive(Debug, Clone)]
pub(super) struct MeasuredSet {
    pub name: String,
    /// Sets of one source are left out of a fit together.
    pub source: String,
    /// The table of impacts; the format of `nearwall diagnose`.
    pub data: Cow<'static, str>,
    /// The column map of the table; may be empty.
    pub columns: Cow<'static, str>,
    /// A model file: of it the materials and the walls are used.
    pub base: Cow<'static, str>,
}

impl MeasuredSet {
    /// Reads the impacts as the walls of a model with the materials of this set see them.
    pub fn read(&self, base: &Model) -> Result<Measurements, BenchmarkError> {
        let fault = |problem: String| BenchmarkError::Set { set: self.name.clone(), problem };
        let map = ColumnMap::from_toml("columns.toml", &self.columns).map_err(|e| fault(e.to_string()))?;
        let walls = WallChoice::new(base, only_wall(base)).map_err(|e| fault(e.to_string()))?;
        let read = Measurements::read("data.csv", self.data.as_bytes(), Some(&map), &walls);
        read.map_err(|error| fault(error.to_string()))
    }
}

/// The wall of a model with one wall, whatever its name.
fn only_wall(model: &Model) -> Option<&str> {
    match model.walls() {
        [only] => Some(only.name()),
        _ => None,
    }
}

/// The sets of one folder of the project, each with its table, column map and base model.
macro_rules! real_measurements {
    ($($name:literal: $source:literal),* $(,)?) => {
        [$(MeasuredSet {
            name: $name.to_owned(),
            source: $source.to_owned(),
            data: include_str!(concat!("../../../../tests/real_measurements/", $name, "/data.csv")).into(),
            columns: include_str!(concat!("../../../../tests/real_measurements/", $name, "/columns.toml")).into(),
            base: include_str!(concat!("../../../../tests/real_measurements/", $name, "/base.toml")).into(),
        }),*]
    };
}

/// Every measured set of the project.
pub(super) fn project_sets() -> Result<Vec<MeasuredSet>, BenchmarkError> {
    let mut sets = Vec::from(real_measurements! {
        "beads-on-bead-packing": "Beladjine et al. 2007",
        "golf-ball-averages": "Ali, Broggi & Cantarini",
        "golf-ball-bounces": "Ali, Broggi & Cantarini",
        "ping-pong-bounces": "Ali, Broggi & Cantarini",
        "rubber-ball-bounces": "Ali, Broggi & Cantarini",
        "rubber-ball-heights": "Panduga",
        "sand-on-sand-bed": "Willetts, Rice & McEwan",
        "squash-ball-temperature": "Shah",
        "tennis-ball-bounces": "Ali, Broggi & Cantarini",
        "tennis-ball-two-methods": "Ali, Broggi & Cantarini",
    });
    sets.push(MeasuredSet {
        name: "wax-on-pyrex".to_owned(),
        source: "Troiano et al.".to_owned(),
        data: include_str!("../../../../tutorials/waxImpactor/measured/troiano.csv").into(),
        columns: "".into(),
        base: include_str!("../../../../tutorials/waxImpactor/measured/base.toml").into(),
    });
    sets.extend(published_sets()?);
    Ok(sets)
}

/// The sets of a folder: each sub-folder with `data.csv` and `base.toml`, and `columns.toml` if it has one, is a set
/// and a source of its own.
pub(super) fn folder_sets(folder: &Path) -> Result<Vec<MeasuredSet>, BenchmarkError> {
    let unreadable = |path: &Path, problem: &dyn std::fmt::Display| BenchmarkError::Set {
        set: path.display().to_string(),
        problem: problem.to_string(),
    };
    let entries = std::fs::read_dir(folder).map_err(|error| unreadable(folder, &error))?;
    let mut paths: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.retain(|path| path.join("data.csv").is_file());
    paths.sort();
    if paths.is_empty() {
        let problem = "no sub-folder has a data.csv; a set is a folder with data.csv, base.toml and, if it needs \
                       one, columns.toml";
        return Err(unreadable(folder, &problem));
    }
    let text = |path: &Path| std::fs::read_to_string(path).map_err(|error| unreadable(path, &error));
    let one = |path: &std::path::PathBuf| {
        let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let map = path.join("columns.toml");
        let columns = if map.is_file() { text(&map)? } else { String::new() };
        Ok(MeasuredSet {
            source: name.clone(),
            name,
            data: text(&path.join("data.csv"))?.into(),
            columns: columns.into(),
            base: text(&path.join("base.toml"))?.into(),
        })
    };
    paths.iter().map(one).collect()
}
