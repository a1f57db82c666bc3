//! The recorded impacts of one experiment, decided again by a changed law.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::PathBuf;

use nalgebra::Vector3;

use super::PredictionError;
use super::recorded_flight::{FlatWall, Landing, RecordedFlight};
use super::replay_error::ReplayError;
use super::tally::TalliedHit;
use crate::results::openfoam::impact_history::{Decision, ImpactHistory, ParcelId, RecordedImpact};
use nearwall::impact::{Impact, ImpactError, Outcome};
use nearwall::model::Model;
use nearwall::rng::ImpactRng;

/// Most impacts of an experiment that are replayed; of more, whole parcels are left out evenly.
const MOST_REPLAYED: u64 = 20_000;
/// Probability of capture of the base from which too few parcels go on to stand for the others [1].
const CERTAIN: f64 = 0.99;
/// What is doubtful after a flight that begins again, over the square of the relative change of the
/// rebound [1]; assumed.
const FLOWN_AGAIN: f64 = 0.25;
/// Largest share of a parcel that arrives [1]: one parcel must not stand for more.
const MOST_SHARE: f64 = 100.0;
/// Random draws over which the base is averaged.
const BASE_DRAWS: usize = 64;
/// Standard errors by which the captures of a record may differ from those of the base model, and
/// the share of its impacts that may contradict the base model.
const ERRORS: f64 = 4.5;
const CONTRADICTIONS: f64 = 1e-3;
/// Relative change of a rebound up to which it is the recorded one [1].
const UNCHANGED_REBOUND: f64 = 1e-12;
/// Difference between recorded and recomputed restitution that rounding explains [1].
const RESTITUTION_ROUNDING: f64 = 1e-6;

/// An impact, with what does not depend on the changed law.
#[derive(Debug, Clone)]
pub(super) struct ReplayedImpact {
    pub impact: Impact,
    /// Index of the model's wall.
    pub wall: usize,
    /// Index of the patch.
    pub patch: usize,
    pub position: Vector3<f64>,
    /// Time that the parcel has moved [s].
    pub age: f64,
    /// Probability of capture of the base [1].
    pub base: f64,
    pub captured: bool,
    /// Recorded normal and tangential speed of a rebound [m/s].
    pub recorded: [f64; 2],
    /// The same by the base with the random numbers of the replay [m/s].
    pub rebound: [f64; 2],
    /// From here to the next recorded impact of the parcel, between flat parallel walls.
    pub flight: Option<RecordedFlight>,
    pub random: ImpactRng,
    /// Mass of all particles [kg].
    pub mass: f64,
    /// Line in the record.
    pub line: u64,
}

/// Normal and tangential speed of a rebound [m/s].
fn rebound_speeds(impact: &Impact, outcome: &Outcome) -> [f64; 2] {
    [
        impact.normal_speed * outcome.normal_restitution,
        impact.tangential_speed * outcome.tangential_restitution,
    ]
}

/// Where the changed law leads a parcel: the next impact, with the share that is doubtful.
#[derive(Debug, Clone, Copy, PartialEq)]
enum NextImpact {
    /// As recorded, with the relative change of the rebound velocity.
    AsRecorded(f64),
    /// With other speeds, elsewhere.
    Shifted(Landing, f64),
    /// No impact is known.
    Away,
}

impl ReplayedImpact {
    /// What follows a rebound with these speeds [m/s].
    ///
    /// The change is that of the normal or the tangential speed, the larger one, at most 1: across
    /// the wall it decides when, and whether, the next wall is met, along the wall where.
    fn next(&self, speeds: [f64; 2]) -> NextImpact {
        let change = |(now, then): (f64, f64)| if now == then { 0.0 } else { (now / then - 1.0).abs() };
        let changes = speeds.into_iter().zip(self.rebound).map(change);
        let changed = changes.fold(0.0, |most: f64, one| if one > most { one } else { most }).min(1.0);
        let Some(flight) = self.flight.as_ref().filter(|_| changed > UNCHANGED_REBOUND) else {
            return NextImpact::AsRecorded(changed);
        };
        let now = |which: usize| self.recorded[which] + speeds[which] - self.rebound[which];
        match flight.again([now(0), now(1)]) {
            // Its first-order error is gone.
            Some(landing) => NextImpact::Shifted(landing, FLOWN_AGAIN * changed * changed),
            None => NextImpact::Away,
        }
    }
}

/// A parcel with its place among the impacts.
#[derive(Debug, Clone)]
pub(super) struct Parcel {
    pub impacts: Range<usize>,
    /// Mass at the injection [kg].
    pub injected: f64,
    /// Number of particles.
    pub particles: f64,
}

/// A replayed experiment.
#[derive(Debug)]
pub(super) struct Recording {
    pub file: PathBuf,
    pub patches: Vec<String>,
    /// The axis of each patch along which its coordinates are.
    pub axes: Vec<usize>,
    /// The patches that are flat.
    pub flat: Vec<Option<FlatWall>>,
    pub impacts: Vec<ReplayedImpact>,
    pub parcels: Vec<Parcel>,
    /// Parcels without an impact, and the mass of one [kg].
    pub missed: (f64, f64),
    /// Mass that all of these have at the injection [kg].
    pub injected: f64,
}

/// How well the record of an experiment answers for a changed law; shares of the injected mass [1].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ReplayAccount {
    /// Caught on all recorded patches.
    pub caught: f64,
    /// Caught at the second or a later impact: these are as the base's rebounds led to them.
    pub caught_later: f64,
    /// Of this what is doubtful since rebounds before it change.
    pub doubtful: f64,
    /// Let go where the record ends: what becomes of it is not known.
    pub without_record: f64,
    /// Led by changed rebounds to where the run has no impact: taken as not caught.
    pub led_away: f64,
}

impl ReplayAccount {
    /// Adds a caught mass, `later` at an impact after the first one.
    fn catch(&mut self, mass: f64, later: bool, doubt: f64) {
        self.caught += mass;
        self.caught_later += if later { mass } else { 0.0 };
        self.doubtful += doubt * mass;
    }

    /// Masses as shares of the injected mass.
    fn over(self, injected: f64) -> Self {
        Self {
            caught: self.caught / injected,
            caught_later: self.caught_later / injected,
            doubtful: self.doubtful / injected,
            without_record: self.without_record / injected,
            led_away: self.led_away / injected,
        }
    }
}

impl ReplayedImpact {
    /// The random draws depend only on `seed` and the place of the impact, so that predictions
    /// change smoothly with a parameter.
    fn new(
        recorded: &RecordedImpact,
        wall: usize,
        patch: usize,
        base: &Model,
        random: ImpactRng,
    ) -> Result<Self, ImpactError> {
        let impact = recorded.impact;
        let base_probability = base.expect(wall, &impact, BASE_DRAWS)?.sticking_probability;
        let rebound = rebound_speeds(&impact, &base.resolve(wall, &impact, random)?);
        let (captured, speeds) = match recorded.decision {
            Decision::Captured => (true, [0.0; 2]),
            Decision::Rebound { e_n, e_t } => {
                (false, [e_n * impact.normal_speed, e_t * impact.tangential_speed])
            }
        };
        Ok(Self {
            impact,
            wall,
            patch,
            position: recorded.position.into(),
            age: recorded.age,
            base: base_probability,
            captured,
            recorded: speeds,
            rebound,
            flight: None,
            random,
            mass: recorded.mass,
            line: recorded.line,
        })
    }
}

impl Recording {
    /// The recorded impacts of a run, which the base model decides as well; `seed` tells experiments apart.
    ///
    /// # Errors
    /// [`ReplayError`] for a record without impacts, with another wall, or with an impact that the
    /// base model cannot decide.
    pub fn new(history: &ImpactHistory, base: &Model, seed: u64) -> Result<Self, ReplayError> {
        let file = || history.file.clone();
        let mut patches: Vec<String> = Vec::new();
        let mut walls: BTreeMap<&str, usize> = BTreeMap::new();
        let (mut impacts, mut parcels) = (Vec::new(), Vec::new());
        for parcel in &history.parcels {
            let Some(first) = parcel.impacts.first() else { continue };
            let start = impacts.len();
            for (index, recorded) in parcel.impacts.iter().enumerate() {
                let patch = patches.iter().position(|patch| **patch == *recorded.patch);
                let patch = patch.unwrap_or_else(|| {
                    patches.push(recorded.patch.to_string());
                    patches.len() - 1
                });
                let wall = match walls.get(&*recorded.wall) {
                    Some(wall) => *wall,
                    None => {
                        let wall = base.find_wall(&recorded.wall).ok_or_else(|| ReplayError::NoWall {
                            file: file(),
                            wall: recorded.wall.to_string(),
                        })?;
                        walls.insert(&recorded.wall, wall);
                        wall
                    }
                };
                let random = ImpactRng::new(seed, key(parcel.id, index));
                let one = ReplayedImpact::new(recorded, wall, patch, base, random);
                let undecided = |reason| ReplayError::Undecided { file: file(), line: recorded.line, reason };
                impacts.push(one.map_err(undecided)?);
            }
            let (impacts, injected) = (start..impacts.len(), first.mass);
            parcels.push(Parcel { impacts, injected, particles: first.particles });
        }
        if impacts.is_empty() {
            return Err(ReplayError::Empty(file()));
        }
        let (injected, missed) = balance(history, &mut parcels);
        let (axes, flat) = (vec![0; patches.len()], vec![None; patches.len()]);
        Ok(Self { file: file(), patches, axes, flat, impacts, parcels, missed, injected })
    }

    /// Checks that the base model decides as the record says.
    ///
    /// # Errors
    /// [`ReplayError::OtherModel`].
    pub fn check(&self, history: &ImpactHistory, base: &Model) -> Result<(), ReplayError> {
        let difference = self.capture_difference().or_else(|| self.restitution_difference(history, base));
        difference.map_or(Ok(()), |reason| Err(ReplayError::OtherModel { file: self.file.clone(), reason }))
    }

    /// Where the run captured what the base model cannot have captured, or too much or little in all.
    fn capture_difference(&self) -> Option<String> {
        let count = self.impacts.len() as f64;
        let allowed = CONTRADICTIONS * count;
        let impossible =
            |one: &&ReplayedImpact| one.base <= 0.0 && one.captured || one.base >= 1.0 && !one.captured;
        let mut contradicting = self.impacts.iter().filter(impossible);
        let first = contradicting.next().map(|one| (one.line, one.captured));
        if let Some((line, captured)) = first.filter(|_| 1.0 + contradicting.count() as f64 > allowed) {
            let did = if captured { ["captured", "never captures"] } else { ["let go", "always captures"] };
            let [run, file] = did;
            return Some(format!("on line {line} the run {run} a parcel that the model file {file}"));
        }
        let expected: f64 = self.impacts.iter().map(|one| one.base).sum();
        let error = self.impacts.iter().map(|one| one.base * (1.0 - one.base)).sum::<f64>().sqrt();
        let captured = self.impacts.iter().filter(|one| one.captured).count() as f64;
        let differs = (captured - expected).abs() > ERRORS * error + allowed + 0.5;
        differs.then(|| {
            format!(
                "the run captured {captured} of {count} impacts, the model file {expected:.1} +- {error:.1}"
            )
        })
    }

    /// Where the run's restitution is not that of the base model; laws with random draws are not compared.
    fn restitution_difference(&self, history: &ImpactHistory, base: &Model) -> Option<String> {
        if base.terms().iter().any(|term| term.kind().stream.is_some()) {
            return None;
        }
        let allowed = CONTRADICTIONS * self.impacts.len() as f64;
        let mut differing = 0.0;
        let recorded = history.parcels.iter().flat_map(|parcel| &parcel.impacts);
        for (one, recorded) in self.impacts.iter().zip(recorded) {
            let Decision::Rebound { e_n, e_t } = recorded.decision else { continue };
            let Ok(mean) = base.expect(one.wall, &one.impact, 1) else { continue };
            let own = [mean.normal_restitution, mean.tangential_restitution];
            if mean.variances != [0.0; 2]
                || (own[0] - e_n).abs() <= RESTITUTION_ROUNDING * (1.0 + e_n.abs())
                    && (own[1] - e_t).abs() <= RESTITUTION_ROUNDING * (1.0 + e_t.abs())
            {
                continue;
            }
            differing += 1.0;
            if differing > allowed {
                return Some(format!(
                    "on line {} the run has e_n = {e_n:.6} and e_t = {e_t:.6}, the model file {:.6} and {:.6}",
                    one.line, own[0], own[1]
                ));
            }
        }
        None
    }

    /// Leaves out whole parcels evenly where there are more impacts than are replayed.
    pub fn thinned(self, notes: &mut Vec<String>) -> Self {
        let all = self.parcels.len();
        let one_in = self.impacts.len() as u64 as f64 / MOST_REPLAYED as f64;
        if one_in <= 1.0 {
            return self;
        }
        let kept = ((all as f64 / one_in) as usize).max(1);
        let (mut impacts, mut parcels) = (Vec::new(), Vec::with_capacity(kept));
        for place in 0..kept {
            let parcel = &self.parcels[place * all / kept];
            let start = impacts.len();
            impacts.extend_from_slice(&self.impacts[parcel.impacts.clone()]);
            parcels.push(Parcel { impacts: start..impacts.len(), ..parcel.clone() });
        }
        notes.push(format!(
            "{}: {kept} of {all} parcels are replayed, with {} of {} impacts.",
            self.file.display(),
            impacts.len(),
            self.impacts.len()
        ));
        let missed = (self.missed.0 * kept as f64 / all as f64, self.missed.1);
        let injected = parcels.iter().map(|parcel| parcel.injected).sum::<f64>() + missed.0 * missed.1;
        Self { impacts, parcels, missed, injected, ..self }
    }

    /// Decides all impacts again. `hit` gets each of them with the share that is doubtful, `end`
    /// each parcel after its last one.
    ///
    /// # Errors
    /// [`PredictionError`] for an impact that the model cannot decide.
    pub fn replay(
        &self,
        model: &Model,
        mut hit: impl FnMut(&TalliedHit<'_>, f64),
        mut end: impl FnMut(&Parcel),
    ) -> Result<ReplayAccount, PredictionError> {
        let mut account = ReplayAccount::default();
        for parcel in &self.parcels {
            self.replay_parcel(parcel, model, &mut account, &mut hit)?;
            end(parcel);
        }
        Ok(account.over(self.injected))
    }

    /// The impact of a parcel that a changed flight may have led elsewhere, and its place; `None`
    /// where the wall has no impact.
    fn arrival(&self, one: &ReplayedImpact, landing: Option<Landing>) -> Option<(Impact, Vector3<f64>)> {
        let Some(Landing { speeds, shift }) = landing else { return Some((one.impact, one.position)) };
        let [normal_speed, tangential_speed] = speeds;
        let position = one.position + shift;
        let inside = self.flat[one.patch].as_ref().is_none_or(|wall| wall.has(position));
        inside.then_some((Impact { normal_speed, tangential_speed, ..one.impact }, position))
    }

    /// Decides the impacts of a parcel again and adds its masses [kg] to the account.
    fn replay_parcel(
        &self,
        parcel: &Parcel,
        model: &Model,
        account: &mut ReplayAccount,
        hit: &mut impl FnMut(&TalliedHit<'_>, f64),
    ) -> Result<(), PredictionError> {
        let mut way = Way { share: 1.0, doubt: 0.0, landing: None };
        for (index, one) in self.impacts[parcel.impacts.clone()].iter().enumerate() {
            let Some((impact, position)) = self.arrival(one, way.landing) else {
                account.led_away += way.share * one.mass;
                break;
            };
            let outcome = model.resolve(one.wall, &impact, one.random).map_err(|error| {
                PredictionError::new(&format!("{}:{}", self.file.display(), one.line), &error)
            })?;
            let caught = outcome.sticking_probability;
            let tallied = TalliedHit {
                wall: one.patch,
                coordinate: position[self.axes[one.patch]],
                impact: &impact,
                outcome: &outcome,
                share: way.share,
                caught,
                weight: parcel.particles,
                mass: one.mass,
            };
            hit(&tallied, way.doubt);
            account.catch(way.share * caught * one.mass, index > 0, way.doubt);
            let left = way.share * (1.0 - caught);
            if one.base >= CERTAIN {
                account.without_record += left * one.mass;
                break;
            }
            if one.captured || left <= 0.0 {
                break;
            }
            way.share = left / (1.0 - one.base);
            account.without_record += (way.share - MOST_SHARE).max(0.0) * one.mass;
            way.share = way.share.min(MOST_SHARE);
            if !way.leads_on(one.next(rebound_speeds(&impact, &outcome))) {
                account.led_away += way.share * one.mass;
                break;
            }
        }
        Ok(())
    }
}

/// A parcel on its way from impact to impact.
struct Way {
    /// Weight of the record: how much more of the parcel goes on than in the run [1].
    share: f64,
    /// Share of what lands that a changed flight makes doubtful [1].
    doubt: f64,
    /// Where a changed flight leads.
    landing: Option<Landing>,
}

impl Way {
    /// Goes on after a rebound; whether there is a next impact.
    fn leads_on(&mut self, next: NextImpact) -> bool {
        let (change, landing) = match next {
            // A flight that is not known again leads to the recorded impact.
            NextImpact::AsRecorded(change) => (change, None),
            NextImpact::Shifted(next, change) => {
                let shift = self.landing.map_or(next.shift, |landing| landing.shift + next.shift);
                (change, Some(Landing { shift, ..next }))
            }
            NextImpact::Away => return false,
        };
        (self.doubt, self.landing) = (self.doubt.max(change), landing);
        true
    }
}

/// The mass at the injection [kg], and the number of parcels without an impact with the mass of
/// one. The record states no mass of a parcel at the injection: that of its first impact is taken,
/// and the rest is that of parcels without an impact.
fn balance(history: &ImpactHistory, parcels: &mut [Parcel]) -> (f64, (f64, f64)) {
    let arrived: f64 = parcels.iter().map(|parcel| parcel.injected).sum();
    let injected = history.injected_mass.unwrap_or(arrived);
    let others = history.injected_parcels.unwrap_or(0).saturating_sub(parcels.len() as u64) as f64;
    let factor = if others > 0.0 { (injected / arrived).min(1.0) } else { injected / arrived };
    for parcel in parcels {
        parcel.injected *= factor;
    }
    let rest = (injected - factor * arrived).max(0.0);
    (injected, if others > 0.0 { (others, rest / others) } else { (0.0, 0.0) })
}

/// The key of an impact's random numbers: always the same, so that predictions change smoothly with a parameter.
fn key(parcel: ParcelId, index: usize) -> u64 {
    let parcel = (parcel.number as u64).wrapping_add((parcel.rank as u64) << 40);
    parcel.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(index as u64)
}
