//! `summary.json`: the numbers of all runs of a case.

use serde::Serialize;

use super::{Run, RunTotals};
use crate::impact::Regime;
use crate::results::{Amount, ByConversion, Moments, WallTotals};
use crate::simulate::{Case, sweep_unit};

/// `summary.json`.
#[derive(Serialize)]
pub struct Summary<'a> {
    schema: &'static str,
    title: &'a str,
    seed: u64,
    particles: u64,
    runs: Vec<RunSummary<'a>>,
}

#[derive(Serialize)]
struct RunSummary<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    swept: Option<SweptValue<'a>>,
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
    first_trouble: Option<&'a str>,
    walls: Vec<WallSummary<'a>>,
    exits: Vec<ExitSummary<'a>>,
}

#[derive(Serialize)]
struct SweptValue<'a> {
    key: &'a str,
    value: f64,
    unit: &'static str,
}

#[derive(Serialize)]
struct ExitSummary<'a> {
    name: &'a str,
    #[serde(flatten)]
    amount: Amount,
}

#[derive(Serialize)]
struct WallSummary<'a> {
    name: &'a str,
    hits: u64,
    rebounds: u64,
    stuck: u64,
    stuck_mass: f64,
    capture_efficiency: f64,
    first_hits: u64,
    first_hits_stuck: u64,
    first_hit_capture_efficiency: f64,
    e_n: Moments,
    e_t: Moments,
    first_hit_e_n: Moments,
    speed: Moments,
    angle_deg: Moments,
    conversion_at_capture: Moments,
    conversion_at_capture_mass: ByConversion,
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

/// The numbers of all runs, ready to be written as JSON.
pub fn summary<'a>(case: &'a Case, runs: &'a [Run]) -> Summary<'a> {
    Summary {
        schema: "nearwall.simulation/1",
        title: &case.title,
        seed: case.seed,
        particles: case.injection.count,
        runs: runs.iter().map(|run| run_summary(case, run)).collect(),
    }
}

fn run_summary<'a>(case: &'a Case, run: &'a Run) -> RunSummary<'a> {
    let totals: &RunTotals = &run.totals;
    let name = |surface: usize| case.surfaces[surface].name.as_str();
    let swept = case.sweep.as_ref().zip(run.value);
    RunSummary {
        swept: swept.map(|(sweep, value)| SweptValue {
            key: &sweep.key,
            value,
            unit: sweep_unit(&sweep.key),
        }),
        injected: totals.injected,
        stuck: totals.captured,
        escaped: totals.escaped,
        airborne: totals.airborne,
        given_up: totals.given_up,
        unusable: totals.unusable,
        reacted_mass: totals.reacted.total(),
        balance_error: totals.balance_error(),
        capture_share: over(totals.captured.mass(), totals.injected.mass()),
        first_trouble: totals.first_trouble.as_deref(),
        walls: totals.walls.iter().map(|(surface, wall)| wall_summary(name(*surface), wall)).collect(),
        exits: totals
            .exits
            .iter()
            .map(|(surface, amount)| ExitSummary { name: name(*surface), amount: *amount })
            .collect(),
    }
}

fn wall_summary<'a>(name: &'a str, wall: &WallTotals) -> WallSummary<'a> {
    let hits = wall.hits.unwrap_or_default().count;
    let regime_hits = wall.regime_hits.unwrap_or_default();
    let amounts = wall.regimes.unwrap_or_default();
    let regimes = Regime::ALL.iter().map(|&regime| {
        let captured = &amounts[regime as usize];
        RegimeSummary {
            regime: regime.name(),
            hits: regime_hits[regime as usize],
            stuck: captured.count,
            stuck_mass: captured.mass(),
        }
    });
    let [first_hits, first_hits_stuck] = wall.first_hits.unwrap_or_default();
    WallSummary {
        name,
        hits,
        rebounds: hits - wall.captured.count,
        stuck: wall.captured.count,
        stuck_mass: wall.captured.mass(),
        capture_efficiency: over(wall.captured.count as f64, hits as f64),
        first_hits,
        first_hits_stuck,
        first_hit_capture_efficiency: over(first_hits_stuck as f64, first_hits as f64),
        e_n: wall.e_n,
        e_t: wall.e_t,
        first_hit_e_n: wall.first_e_n,
        speed: wall.speed,
        angle_deg: wall.angle,
        conversion_at_capture: wall.captured_conversion,
        conversion_at_capture_mass: wall.conversions.unwrap_or_default(),
        regimes: regimes.collect(),
        outside_range: wall.outside_range.unwrap_or(0),
    }
}

/// `part / whole`; 0 when `whole` is 0.
pub(super) fn over(part: f64, whole: f64) -> f64 {
    if whole == 0.0 { 0.0 } else { part / whole }
}
