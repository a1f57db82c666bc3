//! `summary.json`: the numbers of all runs of a case.

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use super::Run;
use crate::impact::Regime;
use crate::results::{Amount, WallTotals};
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

/// The numbers of all runs, ready to be written as JSON.
pub fn summary<'a>(case: &'a Case, runs: &'a [Run]) -> Summary<'a> {
    Summary {
        schema: "nearwall.simulation/1",
        title: &case.title,
        seed: case.seed,
        particles: case.injection.count,
        runs: runs.iter().map(|run| RunSummary { case, run }).collect(),
    }
}

struct RunSummary<'a> {
    case: &'a Case,
    run: &'a Run,
}

impl Serialize for RunSummary<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let totals = &self.run.totals;
        let name = |surface: usize| self.case.surfaces[surface].name.as_str();
        let walls = totals.walls.iter().map(|(surface, wall)| WallSummary { name: name(*surface), wall });
        let exit =
            |(surface, amount): &(usize, Amount)| ExitSummary { name: name(*surface), amount: *amount };
        let mut object = serializer.serialize_map(None)?;
        if let Some((sweep, value)) = self.case.sweep.as_ref().zip(self.run.value) {
            object.serialize_entry(
                "swept",
                &SweptValue { key: &sweep.key, value, unit: sweep_unit(&sweep.key) },
            )?;
        }
        object.serialize_entry("injected", &totals.injected)?;
        object.serialize_entry("stuck", &totals.captured)?;
        object.serialize_entry("escaped", &totals.escaped)?;
        object.serialize_entry("airborne", &totals.airborne)?;
        object.serialize_entry("given_up", &totals.given_up)?;
        object.serialize_entry("unusable", &totals.unusable)?;
        object.serialize_entry("reacted_mass", &totals.reacted)?;
        object.serialize_entry("balance_error", &totals.balance_error())?;
        object.serialize_entry("capture_share", &over(totals.captured.mass(), totals.injected.mass()))?;
        if let Some(trouble) = &totals.first_trouble {
            object.serialize_entry("first_trouble", trouble)?;
        }
        object.serialize_entry("walls", &walls.collect::<Vec<_>>())?;
        object.serialize_entry("exits", &totals.exits.iter().map(exit).collect::<Vec<_>>())?;
        object.end()
    }
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

struct WallSummary<'a> {
    name: &'a str,
    wall: &'a WallTotals,
}

impl Serialize for WallSummary<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { name, wall } = self;
        let (hits, captured) = (wall.hits.unwrap_or_default().count, &wall.captured);
        let [first, first_captured] = wall.first_hits.unwrap_or_default();
        let regime_hits = wall.regime_hits.unwrap_or_default();
        let regimes = Regime::ALL.iter().zip(regime_hits).zip(wall.regimes.unwrap_or_default());
        let regimes = regimes.map(|((regime, hits), captured)| RegimeSummary {
            regime: regime.name(),
            hits,
            stuck: captured.count,
            stuck_mass: captured.mass(),
        });
        let mut object = serializer.serialize_map(None)?;
        object.serialize_entry("name", name)?;
        object.serialize_entry("hits", &hits)?;
        object.serialize_entry("rebounds", &(hits - captured.count))?;
        object.serialize_entry("stuck", &captured.count)?;
        object.serialize_entry("stuck_mass", &captured.mass())?;
        object.serialize_entry("capture_efficiency", &over(captured.count as f64, hits as f64))?;
        object.serialize_entry("first_hits", &first)?;
        object.serialize_entry("first_hits_stuck", &first_captured)?;
        object.serialize_entry("first_hit_capture_efficiency", &over(first_captured as f64, first as f64))?;
        object.serialize_entry("e_n", &wall.e_n)?;
        object.serialize_entry("e_t", &wall.e_t)?;
        object.serialize_entry("first_hit_e_n", &wall.first_e_n)?;
        object.serialize_entry("speed", &wall.speed)?;
        object.serialize_entry("angle_deg", &wall.angle)?;
        object.serialize_entry("conversion_at_capture", &wall.captured_conversion)?;
        object.serialize_entry("conversion_at_capture_mass", &wall.conversions.unwrap_or_default())?;
        object.serialize_entry("regimes", &regimes.collect::<Vec<_>>())?;
        object.serialize_entry("outside_range", &wall.outside_range.unwrap_or(0))?;
        object.end()
    }
}

#[derive(Serialize)]
struct RegimeSummary {
    regime: &'static str,
    hits: u64,
    stuck: u64,
    stuck_mass: f64,
}

/// `part / whole`; 0 when `whole` is 0.
pub(super) fn over(part: f64, whole: f64) -> f64 {
    if whole == 0.0 { 0.0 } else { part / whole }
}
