//! The tables of `nearWallInteraction`: `postProcessing/nearWallInteraction/<cloud>/<start time>/<patch>.dat`.
//!
//! Columns are found by their names in the header line, so older and newer tables can be read. Each start of the solver
//! has a folder of its own; where a run was started again from an earlier time, the later start counts.

use std::path::Path;

use regex_lite::Regex;

use super::distributions::is_other_table;
use super::{folders, time_folders};
use crate::impact::Regime;

/// What happened at one patch, over time. All numbers count from the start of the case.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PatchHistory {
    /// Name of the patch, or the pattern of several.
    pub name: String,
    /// In the order of time.
    pub rows: Vec<PatchRow>,
}

/// Counts and masses of one patch at one time; what is not known is `None`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PatchRow {
    /// Time [s].
    pub time: f64,
    /// Parcels that arrived.
    pub hits: Option<f64>,
    /// Their mass [kg].
    pub hit_mass: Option<f64>,
    /// Parcels that were captured.
    pub sticks: f64,
    /// Their mass at capture [kg].
    pub stick_mass: f64,
    /// Parcels that left here.
    pub escapes: f64,
    /// Their mass [kg].
    pub escape_mass: f64,
    /// Captured mass by regime [kg], in the order of [`Regime::ALL`].
    pub regimes: Option<[f64; 4]>,
    /// Captured mass by conversion in tenths [kg].
    pub conversions: Option<[f64; 10]>,
    /// Sum of the impact speeds [m/s].
    pub speed_sum: Option<f64>,
}

impl PatchRow {
    /// Whether anything has happened yet.
    pub fn is_something(&self) -> bool {
        self.hits.unwrap_or(0.0) > 0.0 || self.sticks > 0.0 || self.escapes > 0.0
    }
}

impl PatchHistory {
    /// The state at a time [s]: the last row before it.
    pub fn at(&self, time: f64) -> Option<&PatchRow> {
        let after = self.rows.partition_point(|row| row.time <= time * (1.0 + 1e-9));
        after.checked_sub(1).map(|index| &self.rows[index])
    }

    /// Whether a patch belongs to this history: by name, or by OpenFOAM's pattern of names.
    pub fn covers(&self, patch: &str) -> bool {
        self.name == patch
            || self.is_pattern()
                && Regex::new(&format!("^(?:{})$", self.name)).is_ok_and(|p| p.is_match(patch))
    }

    /// Whether the name stands for several patches.
    pub fn is_pattern(&self) -> bool {
        self.name.contains(['(', '*', '|', '[', '.'])
    }
}

/// One row of `balance.dat`: names and values.
pub type Balance = Vec<(String, f64)>;

/// Time and injected mass of a balance.
pub(super) fn injected(balance: &Balance) -> Option<[f64; 2]> {
    Some([value(balance, "time_s")?, value(balance, "injected_kg")?])
}

/// The value with this name.
pub fn value(row: &[(String, f64)], name: &str) -> Option<f64> {
    row.iter().find(|(column, _)| column == name).map(|(_, value)| *value)
}

/// Every cloud of a case with its patches and balance.
pub(super) fn read_all(case: &Path) -> Vec<(String, Vec<PatchHistory>, Vec<Balance>)> {
    let root = case.join("postProcessing/nearWallInteraction");
    folders(&root)
        .into_iter()
        .map(|cloud| {
            let (patches, balance) = read_cloud(&root.join(&cloud));
            (cloud, patches, balance)
        })
        .collect()
}

fn read_cloud(folder: &Path) -> (Vec<PatchHistory>, Vec<Balance>) {
    let mut patches: Vec<PatchHistory> = Vec::new();
    let mut balance: Vec<Balance> = Vec::new();
    for (_, start) in time_folders(folder) {
        let mut tables: Vec<_> =
            std::fs::read_dir(&start).into_iter().flatten().flatten().map(|e| e.path()).collect();
        tables.sort();
        for path in tables.iter().filter(|path| path.extension().is_some_and(|e| e == "dat")) {
            let Some(name) = path.file_stem().and_then(|stem| stem.to_str()) else { continue };
            if is_other_table(name) {
                continue;
            }
            let Ok(text) = std::fs::read_to_string(path) else { continue };
            let rows = rows(&text);
            let Some(first) = rows.first().and_then(|row| value(row, "time_s")) else { continue };
            if name == "balance" {
                balance.retain(|row| value(row, "time_s").is_some_and(|time| time < first));
                balance.extend(rows);
                continue;
            }
            let index = patches.iter().position(|patch| patch.name == name).unwrap_or_else(|| {
                patches.push(PatchHistory { name: name.to_owned(), rows: Vec::new() });
                patches.len() - 1
            });
            let history = &mut patches[index].rows;
            history.retain(|row| row.time < first);
            history.extend(rows.iter().filter_map(to_row));
        }
    }
    (patches, balance)
}

/// Rows of a table with a header line; a line that was cut off is left out.
fn rows(text: &str) -> Vec<Balance> {
    let mut header: Vec<&str> = Vec::new();
    let mut rows = Vec::new();
    for line in text.lines() {
        if let Some(names) = line.strip_prefix('#') {
            header = names.split_whitespace().collect();
            continue;
        }
        let values: Option<Vec<f64>> = line.split_whitespace().map(|word| word.parse().ok()).collect();
        match values {
            Some(values) if values.len() == header.len() && !values.is_empty() => {
                rows.push(header.iter().map(|name| (*name).to_owned()).zip(values).collect());
            }
            _ => {}
        }
    }
    rows
}

fn to_row(row: &Balance) -> Option<PatchRow> {
    let get = |name: &str| value(row, name);
    let list = |names: Vec<String>| names.iter().map(|name| get(name)).collect::<Option<Vec<f64>>>();
    let regimes = list(Regime::ALL.iter().map(|regime| format!("stick_mass_{}_kg", regime.name())).collect());
    let conversions = list((0..10).map(|tenth| format!("stick_mass_conversion_0.{tenth}_kg")).collect());
    Some(PatchRow {
        time: get("time_s")?,
        hits: get("hits"),
        hit_mass: get("hit_mass_kg"),
        sticks: get("sticks").unwrap_or(0.0),
        stick_mass: get("stick_mass_kg").unwrap_or(0.0),
        escapes: get("escapes").unwrap_or(0.0),
        escape_mass: get("escape_mass_kg").unwrap_or(0.0),
        regimes: regimes.and_then(|list| list.try_into().ok()),
        conversions: conversions.and_then(|list| list.try_into().ok()),
        speed_sum: get("impact_speed_sum_m_s"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_found_by_name_and_torn_lines_left_out() {
        let text = "# time_s sticks stick_mass_kg hits\n0.1 2 1e-6 5\n0.2 3 2e-6 9\n0.3 4 3e";
        let rows: Vec<PatchRow> = rows(text).iter().filter_map(to_row).collect();
        assert_eq!(rows.len(), 2);
        assert_eq!((rows[1].time, rows[1].sticks, rows[1].hits), (0.2, 3.0, Some(9.0)));
        assert_eq!(rows[1].regimes, None);
        let history = PatchHistory { name: "(hot|cold)Wall".into(), rows };
        assert!(history.covers("coldWall") && !history.covers("outlet"));
        assert_eq!(history.at(0.15).map(|row| row.time), Some(0.1));
        assert_eq!(history.at(0.05), None);
    }
}
