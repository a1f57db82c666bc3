//! What a run leaves in a folder: `impacts.csv` and `summary.json`.

use std::io::Write;

use serde::Serialize;

use super::case::{Case, sweep_unit};
use super::tally::{Share, Tally, WallTally, ratio};
use super::trajectory::{Hit, Trajectory};
use super::{Run, page};
use crate::atomic_file::{AtomicFile, of_csv, refused};
use crate::impact::{INPUTS, Regime};

/// Columns before and after the inputs of the data file.
const BEFORE: [&str; 4] = ["time", "wall", "particle", "hit"];
const AFTER: [&str; 7] = ["x", "y", "z", "e_n", "e_t", "outcome", "regime"];
/// Inputs that this program does not set are left out of the file.
const LEFT_OUT: [&str; 5] = ["layer_thickness", "film_thickness", "roughness", "coverage", "melt_thickness"];

/// Writes impacts as a data file that `nearwall predict` and `nearwall diagnose` read, up to a number of rows.
///
/// The rows are all hits of the first particles: particles are alike, so these are a fair sample, and each one's story
/// is whole. A particle whose hits do not fit any more ends the record. Each value of a sweep has an equal share of rows.
pub struct ImpactRecorder<W: Write> {
    writer: csv::Writer<W>,
    /// Rows for each run of the case, and how many are left in this one.
    share: u64,
    left: u64,
    swept: Option<String>,
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
        let swept = case.sweep.as_ref().map(|sweep| sweep.key.clone());
        let inputs = inputs().map(|input| input.name);
        let header = BEFORE.into_iter().chain(inputs).chain(AFTER).map(str::to_owned);
        writer.write_record(header.chain(swept.iter().map(|key| format!("swept_{key}"))))?;
        let runs = case.sweep.as_ref().map_or(1, |sweep| sweep.values.len().max(1));
        let share = case.recorded / runs as u64;
        Ok(Self { writer, share, left: share, swept, value: None, left_out: 0 })
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
        life: &Trajectory,
    ) -> csv::Result<()> {
        if value != self.value {
            (self.value, self.left) = (value, self.share);
        }
        let rows = life.hits.len() as u64;
        if rows > self.left {
            self.left_out += rows;
            self.left = 0;
            return Ok(());
        }
        self.left -= rows;
        for (index, hit) in life.hits.iter().enumerate() {
            self.row(case, value, number, index, hit)?;
        }
        Ok(())
    }

    fn row(
        &mut self,
        case: &Case,
        value: Option<f64>,
        number: u64,
        index: usize,
        hit: &Hit,
    ) -> csv::Result<()> {
        let (outcome, place) = (&hit.outcome, &hit.position);
        let mut record = csv::StringRecord::new();
        let mut put = |text: &str| record.push_field(text);
        put(&text(hit.time));
        put(&case.surfaces[hit.surface].name);
        put(&number.to_string());
        put(&(index + 1).to_string());
        for input in inputs() {
            put(&text((input.value)(&hit.impact)));
        }
        for number in [place.x, place.y, place.z] {
            put(&text(number));
        }
        let (e_n, e_t) = if outcome.stuck {
            (String::new(), String::new())
        } else {
            (text(outcome.normal_restitution), text(outcome.tangential_restitution))
        };
        put(&e_n);
        put(&e_t);
        put(if outcome.stuck { "stick" } else { "rebound" });
        put(outcome.regime.name());
        if self.swept.is_some() {
            put(&value.map_or(String::new(), text));
        }
        self.writer.write_record(&record)
    }

    /// Hands back what was written to.
    ///
    /// # Errors
    /// When the last rows cannot be written.
    pub fn finish(self) -> Result<W, std::io::Error> {
        self.writer.into_inner().map_err(|error| error.into_error())
    }
}

fn inputs() -> impl Iterator<Item = &'static crate::impact::Input> {
    INPUTS.iter().filter(|input| !LEFT_OUT.contains(&input.name))
}

/// The shortest text that reads back as the same number.
fn text(number: f64) -> String {
    if number != 0.0 && !(1e-3..1e6).contains(&number.abs()) {
        format!("{number:e}")
    } else {
        number.to_string()
    }
}

/// `summary.json`.
#[derive(Serialize)]
pub struct Summary {
    schema: &'static str,
    title: String,
    seed: u64,
    particles: u64,
    runs: Vec<RunSummary>,
}

#[derive(Serialize)]
struct RunSummary {
    #[serde(skip_serializing_if = "Option::is_none")]
    swept: Option<Swept>,
    injected: Amount,
    stuck: Amount,
    escaped: Amount,
    airborne: Amount,
    given_up: Amount,
    unusable: Amount,
    reacted_mass: f64,
    balance_error: f64,
    capture_share: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    first_trouble: Option<String>,
    walls: Vec<WallSummary>,
    exits: Vec<ExitSummary>,
}

#[derive(Serialize)]
struct Swept {
    key: String,
    value: f64,
    unit: &'static str,
}

#[derive(Serialize)]
struct Amount {
    count: u64,
    mass: f64,
}

#[derive(Serialize)]
struct ExitSummary {
    name: String,
    #[serde(flatten)]
    amount: Amount,
}

#[derive(Serialize)]
struct WallSummary {
    name: String,
    hits: u64,
    rebounds: u64,
    stuck: u64,
    stuck_mass: f64,
    capture_efficiency: f64,
    first_hits: u64,
    first_hits_stuck: u64,
    first_hit_capture_efficiency: f64,
    e_n: MeanSummary,
    e_t: MeanSummary,
    first_hit_e_n: MeanSummary,
    speed: MeanSummary,
    angle_deg: MeanSummary,
    conversion_at_capture: MeanSummary,
    conversion_at_capture_mass: Vec<f64>,
    regimes: Vec<RegimeSummary>,
    outside_range: u64,
}

#[derive(Serialize)]
struct RegimeSummary {
    regime: &'static str,
    hits: u64,
    stuck: u64,
    stuck_mass: f64,
}

#[derive(Serialize)]
struct MeanSummary {
    count: u64,
    mean: f64,
    deviation: f64,
}

impl From<&Share> for Amount {
    fn from(share: &Share) -> Self {
        Self { count: share.count, mass: share.mass() }
    }
}

impl From<&super::tally::Moments> for MeanSummary {
    fn from(moments: &super::tally::Moments) -> Self {
        Self { count: moments.count, mean: moments.mean, deviation: moments.deviation() }
    }
}

/// The numbers of all runs, ready to be written as JSON.
pub fn summary(case: &Case, runs: &[Run]) -> Summary {
    Summary {
        schema: "nearwall.simulation/1",
        title: case.title.clone(),
        seed: case.seed,
        particles: case.injection.count,
        runs: runs.iter().map(|run| run_summary(case, run)).collect(),
    }
}

fn run_summary(case: &Case, run: &Run) -> RunSummary {
    let tally: &Tally = &run.tally;
    let name = |surface: usize| case.surfaces[surface].name.clone();
    let swept = case.sweep.as_ref().zip(run.value);
    RunSummary {
        swept: swept.map(|(sweep, value)| Swept {
            key: sweep.key.clone(),
            value,
            unit: sweep_unit(&sweep.key),
        }),
        injected: (&tally.injected).into(),
        stuck: (&tally.stuck).into(),
        escaped: (&tally.escaped).into(),
        airborne: (&tally.airborne).into(),
        given_up: (&tally.given_up).into(),
        unusable: (&tally.unusable).into(),
        reacted_mass: tally.reacted.total(),
        balance_error: tally.balance_error(),
        capture_share: tally.capture_share(),
        first_trouble: tally.first_trouble.clone(),
        walls: tally.walls.iter().map(|wall| wall_summary(name(wall.surface), wall)).collect(),
        exits: tally
            .exits
            .iter()
            .map(|(surface, share)| ExitSummary { name: name(*surface), amount: share.into() })
            .collect(),
    }
}

fn wall_summary(name: String, wall: &WallTally) -> WallSummary {
    let regimes = Regime::ALL.iter().map(|&regime| {
        let stuck = &wall.regime_stuck[regime as usize];
        RegimeSummary {
            regime: regime.name(),
            hits: wall.regime_hits[regime as usize],
            stuck: stuck.count,
            stuck_mass: stuck.mass(),
        }
    });
    WallSummary {
        name,
        hits: wall.hits.count,
        rebounds: wall.hits.count - wall.stuck.count,
        stuck: wall.stuck.count,
        stuck_mass: wall.stuck.mass(),
        capture_efficiency: wall.capture_efficiency(),
        first_hits: wall.first_hits[0],
        first_hits_stuck: wall.first_hits[1],
        first_hit_capture_efficiency: ratio(wall.first_hits[1] as f64, wall.first_hits[0] as f64),
        e_n: (&wall.e_n).into(),
        e_t: (&wall.e_t).into(),
        first_hit_e_n: (&wall.first_e_n).into(),
        speed: (&wall.speed).into(),
        angle_deg: (&wall.angle).into(),
        conversion_at_capture: (&wall.captured_conversion).into(),
        conversion_at_capture_mass: wall.conversion_at_capture.to_vec(),
        regimes: regimes.collect(),
        outside_range: wall.outside_range,
    }
}

/// Runs a case and writes `impacts.csv`, `summary.json` and `report.html` into a folder, which is made if need be.
/// `progress` is told after each particle.
///
/// # Errors
/// What cannot be written, with its path.
pub fn write(
    case: &mut Case,
    folder: &std::path::Path,
    mut progress: impl FnMut(),
) -> Result<Vec<Run>, String> {
    std::fs::create_dir_all(folder).map_err(|error| refused(folder, &error))?;
    let open = |name: &str| AtomicFile::new(&folder.join(name), &[]);
    let (impacts, mut json, mut html) = (open("impacts.csv")?, open("summary.json")?, open("report.html")?);
    let at_impacts = |error: csv::Error| refused(&folder.join("impacts.csv"), &of_csv(error));
    let mut recorder = ImpactRecorder::new(impacts, case).map_err(at_impacts)?;
    let runs = super::run(case, |case, value, number, life| {
        progress();
        recorder.record(case, value, number, life).map_err(at_impacts)
    })?;
    let left_out = recorder.left_out;
    let impacts = recorder.finish().map_err(|error| at_impacts(error.into()))?;
    let summary = serde_json::to_string_pretty(&summary(case, &runs));
    json.put(&(summary.map_err(|error| format!("summary.json: {error}"))? + "\n"))?;
    html.put(&page::page(case, &runs, left_out)?)?;
    AtomicFile::commit(vec![impacts, json, html])?;
    Ok(runs)
}
