//! Settings of experiments as x axes.

use super::super::diagnosis::axis::ColumnAxis;
use crate::diagnose::rig::RigRow;
use crate::diagnose::{Sample, SampleRow};
use crate::simulate::DistributionKey;

/// Fewest values of a setting that is an x axis; with fewer the experiments stand side by side.
const LEAST_VALUES: usize = 3;
/// Most experiments side by side; more are numbered.
const SIDE_BY_SIDE: usize = 16;

/// Readings with their place on an x axis.
pub(super) struct Placed<'a> {
    pub rows: Vec<&'a RigRow>,
    pub sample: Sample,
    /// The name of the column in `sample`.
    pub name: String,
    /// The setting; `None` for experiments side by side.
    pub setting: Option<String>,
    /// Whether the readings differ in this setting only.
    pub alone: bool,
}

impl<'a> Placed<'a> {
    /// Places readings of one column over the setting that varies most, else over the experiments.
    pub fn new(rows: &[&'a RigRow], in_case: &dyn Fn(&str) -> Option<f64>) -> Self {
        match varied(rows, in_case) {
            Some(key) => {
                let numbers = rows.iter().map(|row| value(row, &key, in_case).unwrap_or(f64::NAN));
                let alone = !keys(rows).iter().any(|other| *other != key && cells(rows, other) > 1);
                let vector = rows.iter().any(|row| cell(row, &key).is_some_and(|cell| cell.starts_with('[')));
                let name = if vector { format!("{key}, magnitude") } else { key.clone() };
                let setting = Some(key.clone());
                Self { alone, setting, ..Self::of_numbers(rows, &name, unit(&key), numbers) }
            }
            None => Self::of_experiments(rows),
        }
    }

    /// Places readings at these numbers.
    pub fn of_numbers(
        rows: &[&'a RigRow],
        name: &str,
        unit: &str,
        numbers: impl Iterator<Item = f64>,
    ) -> Self {
        let cells = numbers.map(sample_row).collect();
        let sample = Sample {
            columns: vec![(name.to_owned(), unit.to_owned())],
            words: vec![None],
            rows: cells,
            ..Sample::default()
        };
        Self { rows: rows.to_vec(), sample, name: name.to_owned(), setting: None, alone: true }
    }

    fn of_experiments(rows: &[&'a RigRow]) -> Self {
        let mut names: Vec<String> = Vec::new();
        for row in rows {
            if !names.contains(&row.experiment) {
                names.push(row.experiment.clone());
            }
        }
        let place = |row: &&RigRow| names.iter().position(|name| *name == row.experiment).unwrap_or(0) as f64;
        if names.len() > SIDE_BY_SIDE {
            let numbers: Vec<f64> = rows.iter().map(|row| place(row) + 1.0).collect();
            let name = "experiment, numbered as in the file";
            return Self { alone: false, ..Self::of_numbers(rows, name, "", numbers.into_iter()) };
        }
        let cells = rows.iter().map(|row| sample_row(place(row))).collect();
        let columns = vec![("experiment".to_owned(), String::new())];
        let sample = Sample { columns, words: vec![Some(names)], rows: cells, ..Sample::default() };
        Self { rows: rows.to_vec(), sample, name: "experiment".to_owned(), setting: None, alone: false }
    }

    /// The axis; `None` where there is one place only.
    pub fn axis(&self) -> Option<ColumnAxis<'_>> {
        ColumnAxis::new(&self.sample, &self.name)
    }
}

fn sample_row(x: f64) -> SampleRow {
    SampleRow { held_out: false, cells: vec![x], errors: [None; 2], values: [None; 3] }
}

/// The cell of a setting, if the experiment changes it.
fn cell<'a>(row: &'a RigRow, key: &str) -> Option<&'a str> {
    row.settings.iter().find(|(name, _)| name == key).map(|(_, cell)| cell.as_str())
}

/// A setting as a number: the magnitude of a vector.
fn value(row: &RigRow, key: &str, in_case: &dyn Fn(&str) -> Option<f64>) -> Option<f64> {
    let Some(cell) = cell(row, key) else { return in_case(key) };
    let Some(inner) = cell.strip_prefix('[').and_then(|cell| cell.strip_suffix(']')) else {
        return cell.parse().ok();
    };
    let parts = inner.split(',').map(|part| part.trim().parse::<f64>()).collect::<Result<Vec<f64>, _>>();
    parts.ok().map(|parts| parts.iter().map(|part| part * part).sum::<f64>().sqrt())
}

fn keys(rows: &[&RigRow]) -> Vec<String> {
    let mut keys: Vec<String> = Vec::new();
    for (key, _) in rows.iter().flat_map(|row| &row.settings) {
        if !keys.contains(key) {
            keys.push(key.clone());
        }
    }
    keys
}

/// Number of different cells of a setting, a blank one among them.
fn cells(rows: &[&RigRow], key: &str) -> usize {
    let mut all: Vec<Option<&str>> = rows.iter().map(|row| cell(row, key)).collect();
    all.sort_unstable();
    all.dedup();
    all.len()
}

/// The setting with the most values; of several with nearly as many, the one with which the
/// additions change most, else the readings.
fn varied(rows: &[&RigRow], in_case: &dyn Fn(&str) -> Option<f64>) -> Option<String> {
    let numbers =
        |key: &String| rows.iter().map(|row| value(row, key, in_case)).collect::<Option<Vec<f64>>>();
    let known: Vec<(String, Vec<f64>)> =
        keys(rows).into_iter().filter_map(|key| numbers(&key).map(|numbers| (key, numbers))).collect();
    let count = |numbers: &[f64]| {
        let mut sorted = numbers.to_vec();
        sorted.sort_by(f64::total_cmp);
        sorted.dedup();
        sorted.len()
    };
    let most = known.iter().map(|(_, numbers)| count(numbers)).max().filter(|most| *most >= LEAST_VALUES)?;
    let change = |row: &&RigRow| Some(row.extended? - row.base?);
    let changes: Vec<f64> = rows.iter().map(|row| change(row).unwrap_or(0.0)).collect();
    let changed = changes.iter().any(|change| change.abs() > 1e-12);
    let target = if changed { changes } else { rows.iter().map(|row| row.measured).collect() };
    let candidates = known.into_iter().filter(|(_, numbers)| 2 * count(numbers) >= most);
    let rated = candidates.map(|(key, numbers)| (dependence(&numbers, &target), key));
    // Of equal ones the first.
    rated.reduce(|best, next| if next.0 > best.0 + 1e-9 { next } else { best }).map(|(_, key)| key)
}

/// Rank correlation with `x`, or with the distance from its median.
fn dependence(x: &[f64], y: &[f64]) -> f64 {
    let mut sorted = x.to_vec();
    sorted.sort_by(f64::total_cmp);
    let median = sorted[sorted.len() / 2];
    let bent: Vec<f64> = x.iter().map(|x| (x - median).abs()).collect();
    let y = ranks(y);
    correlation(&ranks(x), &y).abs().max(0.9 * correlation(&ranks(&bent), &y).abs())
}

/// The mean rank of each value.
fn ranks(values: &[f64]) -> Vec<f64> {
    let rank = |value: &f64| {
        let below = values.iter().filter(|other| *other < value).count();
        let equal = values.iter().filter(|other| *other == value).count();
        below as f64 + 0.5 * equal as f64
    };
    values.iter().map(rank).collect()
}

/// Correlation; 0 where a side does not vary.
fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let sum =
        |of: &dyn Fn(f64, f64) -> f64| a.iter().zip(b).map(|(a, b)| of(a - mean_a, b - mean_b)).sum::<f64>();
    let scale = (sum(&|a, _| a * a) * sum(&|_, b| b * b)).sqrt();
    if scale > 0.0 { sum(&|a, b| a * b) / scale } else { 0.0 }
}

/// The unit of a key of a case or model file; empty where it is not known.
fn unit(key: &str) -> &'static str {
    let mut parts: Vec<&str> = key.split('.').collect();
    // Keys of a distribution have the unit of their quantity.
    match parts.last().and_then(|last| DistributionKey::of(last)) {
        Some(DistributionKey::Shape) => return "1",
        Some(_) => drop(parts.pop()),
        None => {}
    }
    match parts.last().copied().unwrap_or("") {
        "temperature" | "onset" => "K",
        "velocity" | "speed" => "m/s",
        "diameter" | "layer_thickness" | "roughness" | "film_thickness" => "m",
        "angle_deg" => "°",
        "pressure" => "Pa",
        "density" => "kg/m3",
        "viscosity" => "Pa s",
        "mass_flow" => "kg/s",
        "conversion" | "coverage" | "e_n" | "e_t" | "friction" => "1",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(settings: &[(&str, &str)], measured: f64) -> RigRow {
        RigRow {
            experiment: "a".into(),
            line: 2,
            observable: "captured@plate".into(),
            settings: settings.iter().map(|(key, cell)| ((*key).into(), (*cell).into())).collect(),
            measured,
            error: 0.01,
            base: None,
            extended: None,
            held_out: None,
        }
    }

    #[test]
    fn the_setting_that_moves_the_readings_is_the_axis() {
        let cells = [("300", "[3, 0, 4]"), ("310", "[1, 0, 0]"), ("320", "[2, 0, 0]"), ("", "[9, 0, 0]")];
        let row = |(i, (t, u)): (usize, &(&str, &str))| {
            let all = [("gas.temperature", *t), ("gas.velocity", *u)];
            let own: Vec<_> = all.into_iter().filter(|(_, cell)| !cell.is_empty()).collect();
            row(&own, 0.1 * i as f64)
        };
        let rows: Vec<RigRow> = cells.iter().enumerate().map(row).collect();
        let rows: Vec<&RigRow> = rows.iter().collect();
        let placed = Placed::new(&rows, &|key| (key == "gas.temperature").then_some(330.0));
        assert_eq!(placed.setting.as_deref(), Some("gas.temperature"));
        assert!(!placed.alone);
        let x: Vec<f64> = placed.sample.rows.iter().map(|row| row.cells[0]).collect();
        assert_eq!(x, [300.0, 310.0, 320.0, 330.0]);
        assert_eq!(value(rows[0], "gas.velocity", &|_| None), Some(5.0));
        // Without the number of the case the other setting is left.
        assert_eq!(Placed::new(&rows, &|_| None).setting.as_deref(), Some("gas.velocity"));
        assert_eq!(Placed::new(&rows[..2], &|_| None).name, "experiment");
    }

    #[test]
    fn keys_of_a_distribution_have_the_unit_of_the_quantity() {
        assert_eq!(["particles.speed.mean", "walls.lid.temperature", "model.x"].map(unit), ["m/s", "K", ""]);
    }
}
