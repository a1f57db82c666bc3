//! `summary.json`: the numbers of all runs of a case.

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use super::{ParticleEnds, Run};
use crate::results::{Amount, Moments, NearWall, WallTotals};
use crate::simulate::{BinHistory, Case, WallHistory, sweep_unit};
use nearwall::impact::Regime;

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
        particles: case.count(),
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
        serialize_ends(&mut object, &totals.ends)?;
        if let Some(trouble) = &totals.first_trouble {
            object.serialize_entry("first_trouble", trouble)?;
        }
        object.serialize_entry("walls", &walls.collect::<Vec<_>>())?;
        object.serialize_entry("exits", &totals.exits.iter().map(exit).collect::<Vec<_>>())?;
        if self.case.injections.len() > 1 {
            let named = self.case.injections.iter().zip(&totals.injections);
            let injections = named.map(|(injection, ends)| InjectionSummary { name: &injection.name, ends });
            object.serialize_entry("injections", &injections.collect::<Vec<_>>())?;
        }
        if !self.run.bands.is_empty() {
            object.serialize_entry("band", &self.run.bands)?;
        }
        if let Some(deposits) = &self.run.deposits {
            let walls = deposits.walls.iter().map(|wall| DepositSummary::new(name(wall.surface), wall));
            object.serialize_entry("deposits", &walls.collect::<Vec<_>>())?;
        }
        object.end()
    }
}

fn serialize_ends<M: SerializeMap>(object: &mut M, ends: &ParticleEnds) -> Result<(), M::Error> {
    object.serialize_entry("injected", &ends.injected)?;
    object.serialize_entry("stuck", &ends.captured)?;
    object.serialize_entry("escaped", &ends.escaped)?;
    object.serialize_entry("airborne", &ends.airborne)?;
    object.serialize_entry("given_up", &ends.given_up)?;
    object.serialize_entry("unusable", &ends.unusable)?;
    object.serialize_entry("reacted_mass", &ends.reacted)?;
    object.serialize_entry("balance_error", &ends.balance_error())?;
    object.serialize_entry("capture_share", &over(ends.captured.mass(), ends.injected.mass()))
}

struct InjectionSummary<'a> {
    name: &'a str,
    ends: &'a ParticleEnds,
}

impl Serialize for InjectionSummary<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_map(None)?;
        object.serialize_entry("name", self.name)?;
        serialize_ends(&mut object, self.ends)?;
        object.end()
    }
}

/// Masses of one wall's deposit at the end.
#[derive(Serialize)]
struct DepositSummary<'a> {
    name: &'a str,
    initial_mass: f64,
    arrived_mass: f64,
    burnt_mass: f64,
    molten_mass: f64,
    frozen_mass: f64,
    powder_mass: f64,
    /// Records of a cooled wall whose temperatures and conductivities did not come to agree.
    unsettled_records: usize,
    mean_coverage: f64,
    /// Initial + arrived - burnt - what lies there, over initial + arrived [1].
    balance_error: f64,
}

impl<'a> DepositSummary<'a> {
    fn new(name: &'a str, wall: &WallHistory) -> Self {
        let sum = |of: &dyn Fn(&BinHistory) -> Option<f64>| wall.bins.iter().filter_map(of).sum::<f64>();
        let area = sum(&|bin| Some(bin.area));
        let initial_mass = sum(&|bin| Some(bin.states.first()?.mass() * bin.area));
        let arrived_mass = sum(&|bin| bin.arrived.last().copied());
        let burnt_mass = sum(&|bin| bin.burnt.last().copied());
        let molten_mass = sum(&|bin| Some(bin.states.last()?.molten * bin.area));
        let frozen_mass = sum(&|bin| Some(bin.states.last()?.frozen * bin.area));
        let records = wall.bins.iter().flat_map(|bin| &bin.heat);
        let unsettled_records = records.filter(|heat| !heat.has_settled()).count();
        let powder_mass = sum(&|bin| Some(bin.states.last()?.powder * bin.area));
        let all = initial_mass + arrived_mass;
        Self {
            name,
            initial_mass,
            arrived_mass,
            burnt_mass,
            molten_mass,
            frozen_mass,
            powder_mass,
            unsettled_records,
            mean_coverage: sum(&|bin| Some(bin.states.last()?.coverage() * bin.area)) / area,
            balance_error: over(all - burnt_mass - molten_mass - frozen_mass - powder_mass, all),
        }
    }
}

/// Stays near a wall.
#[derive(Serialize)]
struct NearWallSummary {
    distance: f64,
    /// Followed particles that came near.
    particles: u64,
    /// Of those [s].
    residence_time: Moments,
    /// Real particles times time [s], and mass times time [kg s].
    particle_seconds: f64,
    mass_seconds: f64,
    /// Over the mean in the cross-section of the pipe [1].
    number_concentration_ratio: Option<f64>,
    mass_concentration_ratio: Option<f64>,
}

impl NearWallSummary {
    fn new(near: &NearWall) -> Self {
        let ratio =
            |of: usize| near.concentration().map(|ratios| ratios[of]).filter(|ratio| ratio.is_finite());
        Self {
            distance: near.distance,
            particles: near.stays.count,
            residence_time: near.stays,
            particle_seconds: near.near[0].total(),
            mass_seconds: near.near[1].total(),
            number_concentration_ratio: ratio(0),
            mass_concentration_ratio: ratio(1),
        }
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
        object.serialize_entry("eroded_volume", &wall.eroded.unwrap_or(0.0))?;
        object.serialize_entry("contact_heat", &wall.contact_heat.unwrap_or(0.0))?;
        object.serialize_entry("near_wall", &wall.near_wall.as_ref().map(NearWallSummary::new))?;
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
