//! Published observations of sticking and rebound as rows of impacts.
//!
//! A critical velocity [m/s] becomes two impacts: at half of it the particle stays, at twice it
//! rebounds (assumed: outside the scatter of the threshold; the sources state no errors). A captured
//! share or an `e_n` over a range of speeds stands at the geometric mean of its ends. Observations
//! whose source does not state the size, and those of the wax paper that its own set has, are left
//! out.

use std::borrow::Cow;
use std::fmt::Write;

use super::BenchmarkError;
use super::measured_set::MeasuredSet;

const OBSERVATIONS: &str = include_str!("../../../../tests/data/published_sticking.csv");

/// The model files that the table names; of each the materials and walls are used.
macro_rules! models {
    ($($path:literal),* $(,)?) => {
        [$(($path, include_str!(concat!("../../../../", $path)))),*]
    };
}
static MODELS: [(&str, &str); 8] = models![
    "tests/data/published_sticking/fly-ash-on-steel.toml",
    "tests/data/published_sticking/silver-on-aluminium.toml",
    "tests/data/published_sticking/fluorescein-on-hard-target.toml",
    "tests/data/published_sticking/hot-glass-on-glass.toml",
    "validation/migraine/plain.toml",
    "validation/migraine/molybdenum.toml",
    "validation/troiano/char.toml",
    "validation/troiano/droplet.toml",
];
const HEADER: &str = "v_n,v_t,d,T_p,T_w,conversion,n_impacts,e_n,e_n_err,capture_efficiency\n";
/// Impacts of a row: it is an average, of which the benchmark counts one reading.
const AVERAGED: usize = 2;

/// The observations as sets, one for each model file and source.
pub(super) fn published_sets() -> Result<Vec<MeasuredSet>, BenchmarkError> {
    let fault = |error: csv::Error| BenchmarkError::Set {
        set: "published_sticking.csv".to_owned(),
        problem: error.to_string(),
    };
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(OBSERVATIONS.as_bytes());
    let header = reader.headers().map_err(fault)?.clone();
    let mut sets: Vec<MeasuredSet> = Vec::new();
    for record in reader.into_records() {
        let record = record.map_err(fault)?;
        let observation = Observation { header: &header, record: &record };
        let Some(&(_, base)) = MODELS.iter().find(|(path, _)| *path == observation.text("model")) else {
            continue;
        };
        let rows = observation.rows();
        if rows.is_empty() {
            continue;
        }
        let source = observation.source();
        let known = sets.iter_mut().find(|set| set.source == source && set.base == base);
        match known {
            Some(set) => set.data.to_mut().push_str(&rows),
            None => sets.push(MeasuredSet {
                name: observation.text("what").to_owned(),
                source: source.to_owned(),
                data: format!("{HEADER}{rows}").into(),
                columns: Cow::Borrowed(""),
                base: base.into(),
            }),
        }
    }
    Ok(sets)
}

/// A row of the table.
struct Observation<'a> {
    header: &'a csv::StringRecord,
    record: &'a csv::StringRecord,
}

impl Observation<'_> {
    fn text(&self, column: &str) -> &str {
        self.header
            .iter()
            .position(|name| name == column)
            .and_then(|at| self.record.get(at))
            .unwrap_or_default()
    }

    fn number(&self, column: &str) -> Option<f64> {
        self.text(column).parse().ok()
    }

    /// The publication, without the place in it.
    fn source(&self) -> &str {
        let source = self.text("source");
        source.rsplit_once(", ").map_or(source, |(publication, _)| publication)
    }

    /// The geometric mean of a range.
    fn middle(&self, low: &str, high: &str) -> Option<f64> {
        Some((self.number(low)? * self.number(high)?).sqrt())
    }

    /// Its impacts as rows of a data file; none if it is no statement about single impacts.
    fn rows(&self) -> String {
        let mut rows = String::new();
        match (self.text("quantity"), self.number("measured")) {
            ("critical_velocity", Some(speed)) if self.text("d_low") == self.text("d_high") => {
                self.add(&mut rows, Some(0.5 * speed), ",,1");
                self.add(&mut rows, Some(2.0 * speed), ",,0");
            }
            ("capture", Some(share)) => {
                self.add(&mut rows, self.middle("v_low", "v_high"), &format!(",,{share}"));
            }
            ("e_n", Some(e_n)) => {
                // The stated range is taken as two standard errors either way.
                let error = self
                    .number("high")
                    .zip(self.number("low"))
                    .map_or(0.0, |(high, low)| 0.25 * (high - low));
                self.add(&mut rows, self.middle("v_low", "v_high"), &format!("{e_n},{error},"));
            }
            _ => {}
        }
        rows
    }

    /// Adds an impact at a total speed, or at a normal speed where no angle is given.
    fn add(&self, rows: &mut String, speed: Option<f64>, observed: &str) {
        let (Some(speed), Some(diameter)) = (speed, self.middle("d_low", "d_high")) else { return };
        // Head-on has no tangential speed, not one of rounding.
        let along = |angle: f64| angle.to_radians().sin_cos();
        let oblique = self.number("angle").filter(|angle| *angle < 90.0);
        let (sine, cosine) = oblique.map_or((1.0, 0.0), along);
        let (normal, tangential) = (speed * sine, speed * cosine);
        let [particle, wall, conversion] = ["T_p", "T_w", "conversion"].map(|column| self.text(column));
        // Writing to a text does not fail.
        let _ = writeln!(
            rows,
            "{normal},{tangential},{diameter},{particle},{wall},{conversion},{AVERAGED},{observed}"
        );
    }
}
