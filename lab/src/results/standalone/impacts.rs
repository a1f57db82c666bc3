//! `impacts.csv`: the hits of a run as a data file.

use std::io::Write;

use crate::simulate::{Case, Hit, Trajectory};
use nearwall::impact::INPUTS;

/// Columns before and after the inputs of the data file.
const BEFORE: [&str; 4] = ["time", "wall", "particle", "hit"];
const AFTER: [&str; 7] = ["x", "y", "z", "e_n", "e_t", "outcome", "regime"];
/// Inputs that no standalone case sets; the file has no column for them.
const LEFT_OUT: [&str; 1] = ["roughness"];
/// Inputs that the deposit of a case sets; without one the file has no column for them.
const OF_DEPOSIT: [&str; 5] = ["layer_thickness", "film_thickness", "coverage", "melt_thickness", "T_under"];
/// The column of the injection, in a case with several.
const INJECTION: &str = "injection";

/// Writes impacts as a data file that `nearwall predict` and `nearwall diagnose` read, up to a number of rows.
///
/// The rows are all hits of the first particles of each injection: a fair sample, since particles
/// are drawn alike (in a case with a deposit, of the time of the first particles). The first
/// particle whose hits do not all fit ends the record. Each injection and each value of a sweep has
/// an equal number of rows.
pub struct ImpactRecorder<W: Write> {
    writer: csv::Writer<W>,
    /// Rows for each injection in each run of the case.
    limit: u64,
    /// Rows left for each injection in this run.
    left: Vec<u64>,
    /// Value of the swept quantity in this run.
    value: Option<f64>,
    /// Hits that did not fit into the file.
    pub left_out: u64,
}

impl<W: Write> ImpactRecorder<W> {
    /// Writes the header.
    ///
    /// # Errors
    /// When the sink cannot be written to.
    pub fn new(sink: W, case: &Case) -> csv::Result<Self> {
        let mut writer = csv::Writer::from_writer(sink);
        let swept = case.sweep.as_ref().map(|sweep| &sweep.key);
        let inputs = inputs(case).map(|input| input.name);
        let injection = (case.injections.len() > 1).then_some(INJECTION);
        let header = BEFORE.into_iter().chain(inputs).chain(AFTER).chain(injection).map(str::to_owned);
        writer.write_record(header.chain(swept.map(|key| format!("swept_{key}"))))?;
        let runs = case.sweep.as_ref().map_or(1, |sweep| sweep.values.len().max(1));
        let injections = case.injections.len();
        let limit = case.recorded / (runs * injections) as u64;
        Ok(Self { writer, limit, left: vec![limit; injections], value: None, left_out: 0 })
    }

    /// Writes the hits of a particle.
    ///
    /// # Errors
    /// When the sink cannot be written to.
    pub fn record(
        &mut self,
        case: &Case,
        value: Option<f64>,
        number: u64,
        trajectory: &Trajectory,
    ) -> csv::Result<()> {
        if value != self.value {
            self.value = value;
            self.left.fill(self.limit);
        }
        let rows = trajectory.hits.len() as u64;
        let left = &mut self.left[trajectory.injection];
        if rows > *left {
            self.left_out += rows;
            *left = 0;
            return Ok(());
        }
        *left -= rows;
        for (index, hit) in trajectory.hits.iter().enumerate() {
            self.row(case, trajectory, number, index, hit)?;
        }
        Ok(())
    }

    fn row(
        &mut self,
        case: &Case,
        trajectory: &Trajectory,
        number: u64,
        index: usize,
        hit: &Hit,
    ) -> csv::Result<()> {
        let outcome = &hit.outcome;
        let surface = case.surfaces[hit.surface].name.clone();
        let mut cells =
            vec![text(trajectory.released + hit.time), surface, number.to_string(), (index + 1).to_string()];
        cells.extend(inputs(case).map(|input| text((input.value)(&hit.impact))));
        cells.extend(hit.position.iter().map(|coordinate| text(*coordinate)));
        for restitution in [outcome.normal_restitution, outcome.tangential_restitution] {
            cells.push(if outcome.stuck { String::new() } else { text(restitution) });
        }
        cells.push(if outcome.stuck { "stick" } else { "rebound" }.to_owned());
        cells.push(outcome.regime.name().to_owned());
        if case.injections.len() > 1 {
            cells.push(case.injections[trajectory.injection].name.clone());
        }
        cells.extend(self.value.map(text));
        self.writer.write_record(&cells)
    }

    /// Writes the last rows and returns the sink.
    ///
    /// # Errors
    /// When they cannot be written.
    pub fn finish(self) -> Result<W, std::io::Error> {
        self.writer.into_inner().map_err(|error| error.into_error())
    }
}

fn inputs(case: &Case) -> impl Iterator<Item = &'static nearwall::impact::Input> {
    let deposit = case.deposit.is_some();
    INPUTS.iter().filter(move |input| {
        !LEFT_OUT.contains(&input.name) && (deposit || !OF_DEPOSIT.contains(&input.name))
    })
}

/// The shortest text that reads back as the same number.
pub(super) fn text(number: f64) -> String {
    // Without the sign of a negative zero.
    let number = number + 0.0;
    if number != 0.0 && !(1e-3..1e6).contains(&number.abs()) {
        format!("{number:e}")
    } else {
        number.to_string()
    }
}
