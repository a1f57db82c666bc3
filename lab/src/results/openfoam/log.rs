//! What the stock patch interaction models leave in a solver's log.
//!
//! In OpenFOAM v1912 each step prints for each cloud
//! ```text
//! Cloud: coalCloud1
//!       - mass introduced             = 0.0065
//!     Parcel fate: patch slagWall (number, mass)          (localInteraction: a patch or a pattern)
//!     Parcel fate: patch (number, mass) slagWall          (standardWallInteraction)
//!       - escape                      = 0, 0
//!       - stick                       = 4994, 0.000735
//! ```
//! `Parcel fate: system` counts what left through any patch; `standardWallInteraction` counts it there and at no patch.
//! Counts are of parcels, masses in kg, both from the start of the case. Several logs of one case (a restart) are read
//! in the order of the times in them.

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader};
use std::path::Path;

use super::super::{Amount, History, WallTotals, history_of};
use super::{entries, file_name};

/// What the logs state of one cloud.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LogResults {
    /// Totals of each patch or pattern.
    pub walls: Vec<History<WallTotals>>,
    /// Time [s] and injected mass [kg].
    pub injected: Vec<[f64; 2]>,
    /// Time [s] and mass [kg] that left through any patch.
    pub escaped: Vec<[f64; 2]>,
}

/// Reads every `log.*` and `*.log` of a case.
pub(super) fn read_all(case: &Path) -> BTreeMap<String, LogResults> {
    let mut clouds = BTreeMap::new();
    for path in entries(case, Path::is_file) {
        let name = file_name(&path);
        if (name.starts_with("log.") || name.ends_with(".log"))
            && let Ok(file) = std::fs::File::open(&path)
        {
            read(BufReader::new(file), &mut clouds);
        }
    }
    for results in clouds.values_mut() {
        in_order(&mut results.injected, |row| row[0]);
        in_order(&mut results.escaped, |row| row[0]);
        results.walls.iter_mut().for_each(|wall| in_order(&mut wall.rows, |row| row.0));
    }
    clouds
}

/// Sorts the rows of several logs by time; of equal times the one read last stays.
fn in_order<T>(rows: &mut Vec<T>, time: impl Fn(&T) -> f64) {
    rows.sort_by(|a, b| time(a).total_cmp(&time(b)));
    rows.reverse();
    rows.dedup_by(|a, b| time(a) == time(b));
    rows.reverse();
}

/// Reads one log.
pub fn read(source: impl BufRead, clouds: &mut BTreeMap<String, LogResults>) {
    let mut reader = Reader { clouds, time: 0.0, cloud: None, patch: None, of_system: false, injected: 0.0 };
    // A log may hold bytes that are no UTF-8 (paths, terminals); such a line is skipped.
    for line in source.split(b'\n').map_while(Result::ok) {
        if let Ok(line) = std::str::from_utf8(&line) {
            reader.line(line.trim());
        }
    }
}

struct Reader<'a> {
    clouds: &'a mut BTreeMap<String, LogResults>,
    time: f64,
    cloud: Option<String>,
    patch: Option<String>,
    /// Whether the next lines count the whole cloud.
    of_system: bool,
    /// Mass [kg] injected by the injectors of this cloud that were read so far in this step.
    injected: f64,
}

impl Reader<'_> {
    fn line(&mut self, line: &str) {
        if let Some(time) = line.strip_prefix("Time = ") {
            if let Ok(time) = time.trim_end_matches('s').parse() {
                (self.time, self.cloud, self.patch, self.of_system) = (time, None, None, false);
            }
        } else if let Some(rest) = line.strip_prefix("Cloud: ") {
            // Also printed as "Cloud: name injector: name" before the step.
            let name = rest.split_whitespace().next().unwrap_or_default();
            self.cloud = (!name.is_empty() && !rest.contains("injector:")).then(|| name.to_owned());
            (self.patch, self.of_system, self.injected) = (None, false, 0.0);
        } else if let Some(rest) = line.strip_prefix("Parcel fate:") {
            self.patch = patch_name(rest);
            self.of_system = rest.trim().starts_with("system");
        } else if let Some(rest) = line.strip_prefix("- ") {
            self.item(rest);
        }
    }

    fn item(&mut self, item: &str) {
        let (Some(cloud), Some((what, value))) = (&self.cloud, item.split_once('=')) else { return };
        let what = what.trim();
        let results = self.clouds.entry(cloud.clone()).or_default();
        if what == "mass introduced" {
            if let Ok(mass) = value.trim().parse::<f64>() {
                self.injected += mass;
                row_at(&mut results.injected, self.time)[1] = self.injected;
            }
            return;
        }
        let Some((count, mass)) = value.split_once(',') else { return };
        let (Ok(count), Ok(mass)) = (count.trim().parse::<f64>(), mass.trim().parse::<f64>()) else { return };
        let Some(patch) = &self.patch else {
            if what == "escape" && self.of_system {
                row_at(&mut results.escaped, self.time)[1] += mass;
            }
            return;
        };
        let rows = &mut history_of(&mut results.walls, patch).rows;
        if rows.last().is_none_or(|(time, _)| *time != self.time) {
            rows.push((self.time, WallTotals::default()));
        }
        let Some((_, totals)) = rows.last_mut() else { return };
        let amount = match what {
            "escape" => &mut totals.escaped,
            "stick" => &mut totals.captured,
            _ => return,
        };
        // Later versions repeat the lines for each injector.
        *amount = Amount::new(amount.count as f64 + count, amount.mass() + mass);
    }
}

/// The row of a time [s] at the end of a list, added when it is missing.
fn row_at(rows: &mut Vec<[f64; 2]>, time: f64) -> &mut [f64; 2] {
    if rows.last().is_none_or(|row| row[0] != time) {
        rows.push([time, 0.0]);
    }
    let last = rows.len() - 1;
    &mut rows[last]
}

/// The patch in `patch NAME (number, mass)` or `patch (number, mass) NAME`; none for `system`.
fn patch_name(rest: &str) -> Option<String> {
    let rest = rest.trim().strip_prefix("patch")?.trim();
    let name = rest.replacen("(number, mass)", "", 1);
    let name = name.trim();
    (!name.is_empty()).then(|| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> BTreeMap<String, LogResults> {
        let mut clouds = BTreeMap::new();
        read(text.as_bytes(), &mut clouds);
        clouds
    }

    #[test]
    fn both_forms_of_the_stock_models_are_read() {
        let clouds = parse(
            "Time = 0.1\n\nCloud: coal injector: nozzle\n    Added 3 new parcels\n\nCloud: coal\n    Injector nozzle:\n\
             \x20     - parcels added               = 9\n      - mass introduced             = 0.002\n\
             \x20   Parcel fate: system (number, mass)\n      - escape                      = 5, 1e-5\n\
             \x20   Parcel fate: patch (a|b) (number, mass)\n      - escape                      = 1, 1e-6\n\
             \x20     - stick                       = 2, 3e-6\n\
             \x20   Parcel fate: patch (number, mass) slagWall\n      - escape                      = 0, 0\n\
             \x20     - stick                       = 4, 5e-6\n",
        );
        let coal = &clouds["coal"];
        assert_eq!(coal.injected, [[0.1, 0.002]]);
        assert_eq!(coal.escaped, [[0.1, 1e-5]]);
        assert_eq!(coal.walls.len(), 2);
        assert!(coal.walls[0].covers("a") && coal.walls[1].covers("slagWall"));
        let (_, totals) = &coal.walls[1].rows[0];
        assert_eq!((totals.captured, totals.escaped.count), (Amount::new(4.0, 5e-6), 0));
    }

    #[test]
    fn two_injectors_add_up() {
        let clouds = parse(
            "Time = 1\nCloud: c\n Injector a:\n - mass introduced = 1\n Injector b:\n - mass introduced = 2\n",
        );
        assert_eq!(clouds["c"].injected, [[1.0, 3.0]]);
    }
}
