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
use std::path::{Path, PathBuf};

use super::tables::{PatchHistory, PatchRow};

/// What the logs say of one cloud.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Fates {
    /// What happened at each patch.
    pub patches: Vec<PatchHistory>,
    /// Time [s] and injected mass [kg].
    pub injected: Vec<[f64; 2]>,
    /// Time [s] and mass [kg] that left through any patch.
    pub escaped: Vec<[f64; 2]>,
}

/// Reads every `log.*` of a case.
pub(super) fn read_all(case: &Path) -> BTreeMap<String, Fates> {
    let entries = std::fs::read_dir(case).into_iter().flatten().flatten().map(|entry| entry.path());
    let is_log = |path: &PathBuf| {
        path.file_name()
            .and_then(|n| n.to_str())
            .is_some_and(|n| n.starts_with("log.") || n.ends_with(".log"))
    };
    let mut paths: Vec<PathBuf> = entries.filter(|path| path.is_file() && is_log(path)).collect();
    paths.sort();
    let mut clouds = BTreeMap::new();
    for path in paths {
        if let Ok(file) = std::fs::File::open(path) {
            read(BufReader::new(file), &mut clouds);
        }
    }
    for fates in clouds.values_mut() {
        sort(fates);
    }
    clouds
}

/// Reads one log.
pub fn read(source: impl BufRead, clouds: &mut BTreeMap<String, Fates>) {
    let mut reader = Reader { clouds, time: 0.0, cloud: None, patch: None, of_system: false, injected: 0.0 };
    // A log may hold bytes that are no UTF-8 (paths, terminals); such a line is skipped.
    for line in source.split(b'\n').map_while(Result::ok) {
        if let Ok(line) = std::str::from_utf8(&line) {
            reader.line(line.trim());
        }
    }
}

struct Reader<'a> {
    clouds: &'a mut BTreeMap<String, Fates>,
    time: f64,
    cloud: Option<String>,
    patch: Option<String>,
    /// Whether the lines that come are those of the whole cloud.
    of_system: bool,
    /// Injected by the injectors of this cloud that came so far in this step.
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
        let fates = self.clouds.entry(cloud.clone()).or_default();
        if what == "mass introduced" {
            if let Ok(mass) = value.trim().parse::<f64>() {
                self.injected += mass;
                let now = [self.time, self.injected];
                match fates.injected.last_mut() {
                    Some(last) if last[0] == self.time => *last = now,
                    _ => fates.injected.push(now),
                }
            }
            return;
        }
        let Some((count, mass)) = value.split_once(',') else { return };
        let (Ok(count), Ok(mass)) = (count.trim().parse::<f64>(), mass.trim().parse::<f64>()) else { return };
        let Some(patch) = &self.patch else {
            if what == "escape" && self.of_system {
                match fates.escaped.last_mut() {
                    Some(last) if last[0] == self.time => last[1] += mass,
                    _ => fates.escaped.push([self.time, mass]),
                }
            }
            return;
        };
        let row = row_of(fates, patch, self.time);
        // Later versions tell injectors apart by repeating the lines.
        match what {
            "escape" => {
                row.escapes += count;
                row.escape_mass += mass;
            }
            "stick" => {
                row.sticks += count;
                row.stick_mass += mass;
            }
            _ => {}
        }
    }
}

/// The patch in `patch NAME (number, mass)` or `patch (number, mass) NAME`; none for `system`.
fn patch_name(rest: &str) -> Option<String> {
    let rest = rest.trim().strip_prefix("patch")?.trim();
    let name = rest.replacen("(number, mass)", "", 1);
    let name = name.trim();
    (!name.is_empty()).then(|| name.to_owned())
}

/// The row of a patch at a time, made if need be. A time that comes again (a restart) begins anew.
fn row_of<'a>(fates: &'a mut Fates, patch: &str, time: f64) -> &'a mut PatchRow {
    let index = fates.patches.iter().position(|p| p.name == patch).unwrap_or_else(|| {
        fates.patches.push(PatchHistory { name: patch.to_owned(), rows: Vec::new() });
        fates.patches.len() - 1
    });
    let rows = &mut fates.patches[index].rows;
    if rows.last().is_none_or(|row| row.time != time) {
        rows.push(PatchRow { time, ..PatchRow::default() });
    }
    let last = rows.len() - 1;
    &mut rows[last]
}

/// Brings several logs into the order of time; of equal times the one read last stays.
fn sort(fates: &mut Fates) {
    for list in [&mut fates.injected, &mut fates.escaped] {
        list.sort_by(|a, b| a[0].total_cmp(&b[0]));
        list.reverse();
        list.dedup_by(|a, b| a[0] == b[0]);
        list.reverse();
    }
    for patch in &mut fates.patches {
        patch.rows.sort_by(|a, b| a.time.total_cmp(&b.time));
        patch.rows.reverse();
        patch.rows.dedup_by(|a, b| a.time == b.time);
        patch.rows.reverse();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> BTreeMap<String, Fates> {
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
        assert_eq!(coal.patches.len(), 2);
        assert!(coal.patches[0].covers("a") && coal.patches[1].covers("slagWall"));
        let row = &coal.patches[1].rows[0];
        assert_eq!((row.sticks, row.stick_mass, row.escapes), (4.0, 5e-6, 0.0));
    }

    #[test]
    fn two_injectors_add_up() {
        let clouds = parse(
            "Time = 1\nCloud: c\n Injector a:\n - mass introduced = 1\n Injector b:\n - mass introduced = 2\n",
        );
        assert_eq!(clouds["c"].injected, [[1.0, 3.0]]);
    }
}
