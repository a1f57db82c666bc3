//! OpenFOAM's recorded impacts as the forward model of a rig.
//!
//! The run's own model, the base, let each parcel go on or caught it; the record holds the impacts up to the capture. A changed law
//! decides the same impacts again. With the probabilities of capture `b_j` of the base and `p_j` of the changed law, the share of a parcel that
//! arrives at its impact `i` under the changed law is
//!
//! `share_i = prod_{j<i} (1 - p_j)/(1 - b_j)`,
//!
//! since the record holds that impact only with the probability `prod_{j<i} (1 - b_j)`. The sums over `share_i p_i` have the expectation of
//! a run with the changed law, if only capture changes. Two limits, which [`ReplayAccount`] states:
//! - Where the base holds a parcel with (almost) certainty, the record says nothing about what follows. What the changed law lets go there is
//!   *without a record*.
//! - If a rebound changes, later impacts are an approximation. Between flat parallel walls the flight begins again with the new rebound
//!   ([`Flight`]): the next impact has other speeds and another place, or is missed. Elsewhere later impacts stay as recorded. The relative
//!   change of the rebound velocity, of a flight begun again a quarter of its square, is the share of what follows that is doubtful; it adds
//!   to the variance of the prediction ([`Tally::set_doubt`]).

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::recorded_flight::{End, FlatWall, Flight, Landing};
use super::tally::{Predicted, TalliedHit, Tally};
use super::{Forward, ModelChange};
use crate::dataset::{Experiment, RigMeasurements, RigQuantity};
use crate::results::openfoam::impact_history::{self, Decision, HistoryError, ImpactHistory, ParcelId};
use nearwall::impact::{INPUTS, Impact, ImpactError, Outcome};
use nearwall::model::Model;
use nearwall::rng::ImpactRng;

/// Most impacts of an experiment that are replayed; of more, whole parcels are left out evenly.
const MOST_IMPACTS: u64 = 20_000;
/// Probability of capture of the base from which too few parcels go on to stand for the others [1].
const CERTAIN: f64 = 0.99;
/// What is doubtful after a flight that begins again, over the square of the relative change of the rebound [1]; assumed.
const FLOWN_AGAIN: f64 = 0.25;
/// Largest share of a parcel that arrives [1]: one parcel must not stand for more.
const MOST_SHARE: f64 = 100.0;
/// Random draws over which the base is averaged.
const DRAWS: usize = 64;
/// Standard errors by which the captures of a record may differ from those of the base model, and the share of its impacts that
/// may contradict the base model.
const ERRORS: f64 = 4.5;
const CONTRADICTIONS: f64 = 1e-3;
/// Relative change of a rebound up to which it is the recorded one [1].
const SAME: f64 = 1e-12;
/// Difference between recorded and recomputed restitution that rounding explains [1].
const ROUNDING: f64 = 1e-6;

/// Why a record cannot be replayed.
#[derive(Debug, thiserror::Error)]
pub enum ReplayError {
    /// The record cannot be read, or is a part of the impacts.
    #[error(transparent)]
    History(#[from] HistoryError),
    /// An experiment has no folder.
    #[error(
        "{place}: there is no folder {}; the column `experiment` names the sub-folders of --impacts with the recorded cases{}",
        .folder.display(), list(": there are ", .found)
    )]
    NoCase {
        /// File, line and name of the experiment.
        place: String,
        /// The folder that is missing.
        folder: PathBuf,
        /// The folders beside it.
        found: Vec<String>,
    },
    /// The model has no wall of this name.
    #[error("{}: the run's model has a wall `{wall}`, the model file has none; give the model file of the run", .file.display())]
    NoWall {
        /// The record.
        file: PathBuf,
        /// The wall.
        wall: String,
    },
    /// A reading is of a patch without recorded impacts.
    #[error(
        "{place}: `{column}`: {} has no impact on a patch of this name{}; what follows the @ is a patch that `record` of \
         nearWallInteraction includes",
        .file.display(), list(", only on ", .found)
    )]
    NoPatch {
        /// File, line and name of the experiment.
        place: String,
        /// The column.
        column: String,
        /// The record.
        file: PathBuf,
        /// The patches with impacts.
        found: Vec<String>,
    },
    /// The model file decides otherwise than the record.
    #[error(
        "{}: the model file is not the one of the run: {reason}; give the model file with which the case was run (walls with \
         a memory cannot be replayed)",
        .file.display()
    )]
    OtherModel {
        /// The record.
        file: PathBuf,
        /// What differs.
        reason: String,
    },
    /// The model cannot decide an impact.
    #[error("{}:{line}: the model file cannot decide this impact: {reason}; give the model file of the run", .file.display())]
    Undecided {
        /// The record.
        file: PathBuf,
        /// The line, counted from 1.
        line: u64,
        /// The reason.
        reason: String,
    },
    /// The record is empty.
    #[error("{}: no impact is recorded; run the case until particles arrive at the walls", .0.display())]
    Empty(PathBuf),
}

fn list(before: &str, names: &[String]) -> String {
    if names.is_empty() { String::new() } else { format!("{before}{}", names.join(", ")) }
}

/// An impact, with what does not depend on the changed law.
#[derive(Debug, Clone)]
struct Step {
    impact: Impact,
    /// Index of the model's wall.
    wall: usize,
    /// Index of the patch.
    patch: usize,
    position: [f64; 3],
    /// Time that the parcel has moved [s].
    age: f64,
    /// Probability of capture of the base [1].
    base: f64,
    captured: bool,
    /// Recorded normal and tangential speed of a rebound [m/s].
    recorded: [f64; 2],
    /// The same by the base with the random numbers of the replay [m/s].
    rebound: [f64; 2],
    /// From here to the next recorded impact of the parcel, between flat parallel walls.
    flight: Option<Flight>,
    random: ImpactRng,
    /// Mass of all particles [kg].
    mass: f64,
    /// Line in the record.
    line: u64,
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
enum Onward {
    /// As recorded, with the relative change of the rebound velocity.
    AsRecorded(f64),
    /// With other speeds, elsewhere.
    Shifted(Landing, f64),
    /// No impact is known.
    Away,
}

impl Step {
    /// What follows a rebound with these speeds [m/s].
    ///
    /// The change is that of the normal or the tangential speed, the larger one, at most 1: across the wall it decides when, and whether,
    /// the next wall is met, along the wall where.
    fn onward(&self, speeds: [f64; 2]) -> Onward {
        let change = |(now, then): (f64, f64)| if now == then { 0.0 } else { (now / then - 1.0).abs() };
        let changes = speeds.into_iter().zip(self.rebound).map(change);
        let changed = changes.fold(0.0, |most: f64, one| if one > most { one } else { most }).min(1.0);
        let Some(flight) = self.flight.as_ref().filter(|_| changed > SAME) else {
            return Onward::AsRecorded(changed);
        };
        let now = |which: usize| self.recorded[which] + speeds[which] - self.rebound[which];
        match flight.again([now(0), now(1)]) {
            // Its first-order error is gone.
            Some(landing) => Onward::Shifted(landing, FLOWN_AGAIN * changed * changed),
            None => Onward::Away,
        }
    }
}

/// A parcel with its place among the steps.
#[derive(Debug, Clone)]
struct Parcel {
    steps: Range<usize>,
    /// Mass at the injection [kg].
    injected: f64,
    /// Number of particles.
    particles: f64,
}

/// A replayed experiment.
#[derive(Debug)]
struct Recording {
    file: PathBuf,
    patches: Vec<String>,
    /// The axis of each patch along which its coordinates are.
    axes: Vec<usize>,
    /// The patches that are flat.
    flat: Vec<Option<FlatWall>>,
    steps: Vec<Step>,
    parcels: Vec<Parcel>,
    /// Parcels without an impact, and the mass of one [kg].
    missed: (f64, f64),
    /// Mass that all of these have at the injection [kg].
    injected: f64,
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

/// Recorded impacts of all experiments, decided again for each law.
#[derive(Debug)]
pub struct Replayed {
    base: Model,
    runs: Vec<Recording>,
    experiments: Vec<Experiment>,
    notes: Vec<String>,
}

impl Replayed {
    /// Reads the records of all experiments below `folder`, of cases that were run with the model `base`.
    ///
    /// # Errors
    /// [`ReplayError`] of the first experiment that has one.
    pub fn new(folder: &Path, data: &RigMeasurements, base: &Model) -> Result<Self, ReplayError> {
        let mut notes = Vec::new();
        let mut runs = Vec::new();
        let mut unrecorded: Vec<Vec<String>> = Vec::new();
        for (number, experiment) in data.experiments.iter().enumerate() {
            let place = format!("{}:{}: experiment `{}`", data.file, experiment.line, experiment.name);
            let case = case_of(folder, experiment, data.experiments.len(), &place)?;
            let history = impact_history::read(&case, None, base.extra_inputs())?;
            history.check_complete()?;
            let run = Recording::new(&history, base, number as u64)?;
            run.check(&history, base)?;
            unrecorded.push(history.unrecorded.iter().map(|(patch, _)| patch.clone()).collect());
            if history.unusable > 0 {
                notes.push(format!(
                    "{}: the run's model refused {} impacts, which are not on record.",
                    history.file.display(),
                    history.unusable
                ));
            }
            runs.push(run.thinned(&mut notes));
        }
        check_patches(data, &runs, &unrecorded)?;
        let mut replayed = Self { base: base.clone(), runs, experiments: data.experiments.clone(), notes };
        replayed.find_axes();
        replayed.find_flights();
        Ok(replayed)
    }

    /// What was assumed about the records.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// How well the record of an experiment answers for a model.
    ///
    /// # Errors
    /// Why the model cannot decide an impact.
    pub fn account(&self, experiment: usize, model: &Model) -> Result<ReplayAccount, String> {
        self.runs[experiment].replay(model, |_, _| {}, |_| {})
    }

    /// The same in sentences, over all experiments.
    ///
    /// # Errors
    /// Why the model cannot decide an impact.
    pub fn account_notes(&self, model: &Model) -> Result<Vec<String>, String> {
        let accounts =
            (0..self.runs.len()).map(|number| self.account(number, model)).collect::<Result<Vec<_>, _>>()?;
        let largest = |of: &dyn Fn(&ReplayAccount) -> f64| {
            let all = accounts.iter().map(of).zip(&self.experiments);
            let (share, experiment) = all.max_by(|a, b| a.0.total_cmp(&b.0))?;
            Some((100.0 * share, experiment.name.clone()))
        };
        let mut notes = Vec::new();
        if let Some((percent, name)) =
            largest(&|one| one.without_record).filter(|(percent, _)| *percent >= 0.1)
        {
            notes.push(format!(
                "Without a record: the extended model lets up to {percent:.1} % of the injected mass (experiment `{name}`) \
                 go where the run caught it. Later impacts of it are unknown and counted as not caught; run the cases with \
                 extended.toml, and diagnose again with that record."
            ));
        }
        let later = |one: &ReplayAccount| if one.caught > 0.0 { one.caught_later / one.caught } else { 0.0 };
        if let Some((percent, name)) = largest(&later).filter(|(percent, _)| *percent >= 0.1) {
            let of = |one: &ReplayAccount| if one.caught > 0.0 { one.doubtful / one.caught } else { 0.0 };
            let (doubtful, other) = largest(&of).unwrap_or_default();
            notes.push(format!(
                "Up to {percent:.1} % of the caught mass (experiment `{name}`) is caught at a second or later impact: exact for a \
                 change of capture, approximate for a change of rebounds, which makes up to {doubtful:.1} % of the caught mass \
                 doubtful (experiment `{other}`)."
            ));
        }
        if let Some((percent, name)) = largest(&|one| one.led_away).filter(|(percent, _)| *percent >= 0.1) {
            notes.push(format!(
                "Changed rebounds lead up to {percent:.1} % of the injected mass (experiment `{name}`) to where the run recorded no \
                 impact. It is counted as not caught from there on; run the cases with extended.toml to see."
            ));
        }
        Ok(notes)
    }

    /// Measures coordinates along the axis of each patch in which its impacts extend farthest.
    fn find_axes(&mut self) {
        let along =
            |reading: &&crate::dataset::RigReading| matches!(reading.quantity, RigQuantity::CapturedAlong(_));
        let readings = self.experiments.iter().flat_map(|experiment| &experiment.readings);
        let patches: BTreeSet<String> = readings.filter(along).map(|reading| reading.wall.clone()).collect();
        for patch in patches {
            let on_patch = |run: &Recording| run.patches.iter().position(|name| *name == patch);
            let mut ends = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
            for run in &self.runs {
                let Some(number) = on_patch(run) else { continue };
                for step in run.steps.iter().filter(|step| step.patch == number) {
                    for (ends, at) in ends.iter_mut().zip(step.position) {
                        *ends = [ends[0].min(at), ends[1].max(at)];
                    }
                }
            }
            let length = |axis: usize| ends[axis][1] - ends[axis][0];
            // Of equal ones the first.
            let axis = (0..3).rev().max_by(|a, b| length(*a).total_cmp(&length(*b))).unwrap_or(0);
            for run in &mut self.runs {
                if let Some(number) = on_patch(run) {
                    run.axes[number] = axis;
                }
            }
            let [low, high] = ends[axis];
            self.notes.push(format!(
                "captured_from_Z1_to_Z2@{patch} is along {}, in which the recorded impacts extend farthest: {low:.4} to \
                 {high:.4} m.",
                ["x", "y", "z"][axis]
            ));
        }
    }

    /// Finds the flat patches, from their impacts in all experiments, and the flights between parallel ones.
    fn find_flights(&mut self) {
        let mut points: BTreeMap<&str, Vec<[f64; 3]>> = BTreeMap::new();
        for run in &self.runs {
            for step in &run.steps {
                points.entry(&run.patches[step.patch]).or_default().push(step.position);
            }
        }
        let flat: BTreeMap<String, FlatWall> = points
            .into_iter()
            .filter_map(|(patch, points)| Some((patch.to_owned(), FlatWall::of(&points)?)))
            .collect();
        for run in &mut self.runs {
            run.flat = run.patches.iter().map(|patch| flat.get(patch).cloned()).collect();
            for parcel in &run.parcels {
                for place in parcel.steps.clone().skip(1) {
                    let [from, to] = [&run.steps[place - 1], &run.steps[place]];
                    let arriving = [to.impact.normal_speed, to.impact.tangential_speed];
                    let end = |step: &Step, speeds: [f64; 2]| {
                        let wall = run.flat[step.patch].as_ref()?;
                        Some(End { wall, position: step.position, age: step.age, speeds })
                    };
                    let ends = end(from, from.recorded).zip(end(to, arriving));
                    let flight = ends.and_then(|(from, to)| Flight::new(&from, &to));
                    run.steps[place - 1].flight = flight;
                }
            }
        }
    }
}

/// The case of an experiment: the sub-folder of its name. Rows without a name, and a single experiment, may be of `folder` itself.
fn case_of(
    folder: &Path,
    experiment: &Experiment,
    count: usize,
    place: &str,
) -> Result<PathBuf, ReplayError> {
    let own = folder.join(&experiment.name);
    if own.is_dir() {
        return Ok(own);
    }
    let nameless = experiment.name == format!("line {}", experiment.line);
    let has_cases = folder.join("system").is_dir() || folder.join("postProcessing").is_dir();
    if nameless || !folder.is_dir() || (count == 1 && has_cases) {
        return Ok(folder.to_owned());
    }
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let folders = entries.filter(|entry| entry.path().is_dir());
    let mut found: Vec<String> =
        folders.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    found.sort();
    found.truncate(12);
    Err(ReplayError::NoCase { place: place.to_owned(), folder: own, found })
}

/// Checks that the patches of all readings are recorded. Where a patch has impacts in another experiment, and none in this one, none
/// arrived.
fn check_patches(
    data: &RigMeasurements,
    runs: &[Recording],
    unrecorded: &[Vec<String>],
) -> Result<(), ReplayError> {
    let found: BTreeSet<String> = runs.iter().flat_map(|run| run.patches.clone()).collect();
    for ((experiment, run), unrecorded) in data.experiments.iter().zip(runs).zip(unrecorded) {
        let known =
            |wall: &String| run.patches.contains(wall) || found.contains(wall) && !unrecorded.contains(wall);
        if let Some(reading) = experiment.readings.iter().find(|reading| !known(&reading.wall)) {
            let place = format!("{}:{}: experiment `{}`", data.file, reading.line, experiment.name);
            let (column, file) = (reading.column.clone(), run.file.clone());
            return Err(ReplayError::NoPatch { place, column, file, found: found.into_iter().collect() });
        }
    }
    Ok(())
}

impl Recording {
    fn new(history: &ImpactHistory, base: &Model, seed: u64) -> Result<Self, ReplayError> {
        let file = || history.file.clone();
        let mut patches: Vec<String> = Vec::new();
        let mut walls: BTreeMap<&str, usize> = BTreeMap::new();
        let (mut steps, mut parcels) = (Vec::new(), Vec::new());
        for parcel in &history.parcels {
            let Some(first) = parcel.impacts.first() else { continue };
            let start = steps.len();
            for (index, recorded) in parcel.impacts.iter().enumerate() {
                let patch =
                    patches.iter().position(|patch| **patch == *recorded.patch).unwrap_or_else(|| {
                        patches.push(recorded.patch.to_string());
                        patches.len() - 1
                    });
                let wall = match walls.get(&*recorded.wall) {
                    Some(wall) => *wall,
                    None => {
                        let missing =
                            || ReplayError::NoWall { file: file(), wall: recorded.wall.to_string() };
                        let wall = base.find_wall(&recorded.wall).ok_or_else(missing)?;
                        walls.insert(&recorded.wall, wall);
                        wall
                    }
                };
                let undecided = |error: ImpactError| ReplayError::Undecided {
                    file: file(),
                    line: recorded.line,
                    reason: error.to_string(),
                };
                let decided = base.expect(wall, &recorded.impact, DRAWS).map_err(undecided)?;
                let random = ImpactRng::new(seed, key(parcel.id, index));
                let own = base.resolve(wall, &recorded.impact, random).map_err(undecided)?;
                let rebound = rebound_speeds(&recorded.impact, &own);
                steps.push(Step {
                    impact: recorded.impact,
                    wall,
                    patch,
                    position: recorded.position,
                    age: recorded.age,
                    base: decided.sticking_probability,
                    captured: recorded.decision == Decision::Captured,
                    recorded: match recorded.decision {
                        Decision::Captured => [0.0; 2],
                        Decision::Rebound { e_n, e_t } => {
                            [e_n * recorded.impact.normal_speed, e_t * recorded.impact.tangential_speed]
                        }
                    },
                    rebound,
                    flight: None,
                    random,
                    mass: recorded.mass,
                    line: recorded.line,
                });
            }
            parcels.push(Parcel {
                steps: start..steps.len(),
                injected: first.mass,
                particles: first.particles,
            });
        }
        if steps.is_empty() {
            return Err(ReplayError::Empty(file()));
        }
        // The record states no mass at the injection: that of the first impact, and the rest is that of parcels without an impact.
        let arrived: f64 = parcels.iter().map(|parcel| parcel.injected).sum();
        let injected = history.injected_mass.unwrap_or(arrived);
        let others = history.injected_parcels.unwrap_or(0).saturating_sub(parcels.len() as u64) as f64;
        let factor = if others > 0.0 { (injected / arrived).min(1.0) } else { injected / arrived };
        for parcel in &mut parcels {
            parcel.injected *= factor;
        }
        let rest = (injected - factor * arrived).max(0.0);
        let missed = if others > 0.0 { (others, rest / others) } else { (0.0, 0.0) };
        let (axes, flat) = (vec![0; patches.len()], vec![None; patches.len()]);
        Ok(Self { file: file(), patches, axes, flat, steps, parcels, missed, injected })
    }

    /// Checks that the base model decides as the record says.
    fn check(&self, history: &ImpactHistory, base: &Model) -> Result<(), ReplayError> {
        let other = |reason: String| Err(ReplayError::OtherModel { file: self.file.clone(), reason });
        let count = self.steps.len() as f64;
        let allowed = CONTRADICTIONS * count;
        let impossible =
            |step: &&Step| step.base <= 0.0 && step.captured || step.base >= 1.0 && !step.captured;
        let mut contradicting = self.steps.iter().filter(impossible);
        let first = contradicting.next().map(|step| (step.line, step.captured));
        if let Some((line, captured)) = first.filter(|_| 1.0 + contradicting.count() as f64 > allowed) {
            let did = if captured { ["captured", "never captures"] } else { ["let go", "always captures"] };
            return other(format!(
                "on line {line} the run {} a parcel that the model file {}",
                did[0], did[1]
            ));
        }
        let expected: f64 = self.steps.iter().map(|step| step.base).sum();
        let error = self.steps.iter().map(|step| step.base * (1.0 - step.base)).sum::<f64>().sqrt();
        let captured = self.steps.iter().filter(|step| step.captured).count() as f64;
        if (captured - expected).abs() > ERRORS * error + allowed + 0.5 {
            return other(format!(
                "the run captured {captured} of {count} impacts, the model file {expected:.1} +- {error:.1}"
            ));
        }
        if base.terms().iter().any(|term| term.kind().stream.is_some()) {
            return Ok(());
        }
        let mut differing = 0.0;
        let recorded = history.parcels.iter().flat_map(|parcel| &parcel.impacts);
        for (step, recorded) in self.steps.iter().zip(recorded) {
            let Decision::Rebound { e_n, e_t } = recorded.decision else { continue };
            let Ok(mean) = base.expect(step.wall, &step.impact, 1) else { continue };
            let own = [mean.normal_restitution, mean.tangential_restitution];
            if mean.variances != [0.0; 2]
                || (own[0] - e_n).abs() <= ROUNDING * (1.0 + e_n.abs())
                    && (own[1] - e_t).abs() <= ROUNDING * (1.0 + e_t.abs())
            {
                continue;
            }
            differing += 1.0;
            if differing > allowed {
                return other(format!(
                    "on line {} the run has e_n = {e_n:.6} and e_t = {e_t:.6}, the model file {:.6} and {:.6}",
                    step.line, own[0], own[1]
                ));
            }
        }
        Ok(())
    }

    /// Leaves out whole parcels evenly where there are more impacts than are replayed.
    fn thinned(self, notes: &mut Vec<String>) -> Self {
        let all = self.parcels.len();
        let one_in = self.steps.len() as u64 as f64 / MOST_IMPACTS as f64;
        if one_in <= 1.0 {
            return self;
        }
        let kept = ((all as f64 / one_in) as usize).max(1);
        let (mut steps, mut parcels) = (Vec::new(), Vec::with_capacity(kept));
        for place in 0..kept {
            let parcel = &self.parcels[place * all / kept];
            let start = steps.len();
            steps.extend_from_slice(&self.steps[parcel.steps.clone()]);
            parcels.push(Parcel { steps: start..steps.len(), ..parcel.clone() });
        }
        notes.push(format!(
            "{}: {kept} of {all} parcels are replayed, with {} of {} impacts.",
            self.file.display(),
            steps.len(),
            self.steps.len()
        ));
        let missed = (self.missed.0 * kept as f64 / all as f64, self.missed.1);
        let injected = parcels.iter().map(|parcel| parcel.injected).sum::<f64>() + missed.0 * missed.1;
        Self { steps, parcels, missed, injected, ..self }
    }

    /// Decides all impacts again. `hit` gets each of them with the share that is doubtful, `end` each parcel after its last one.
    fn replay(
        &self,
        model: &Model,
        mut hit: impl FnMut(&TalliedHit<'_>, f64),
        mut end: impl FnMut(&Parcel),
    ) -> Result<ReplayAccount, String> {
        let mut account = ReplayAccount::default();
        for parcel in &self.parcels {
            let (mut share, mut doubt) = (1.0, 0.0_f64);
            let mut landing: Option<Landing> = None;
            for (index, step) in self.steps[parcel.steps.clone()].iter().enumerate() {
                let (mut impact, mut position) = (step.impact, step.position);
                if let Some(Landing { speeds, shift }) = landing {
                    [impact.normal_speed, impact.tangential_speed] = speeds;
                    position = std::array::from_fn(|axis| position[axis] + shift[axis]);
                    if self.flat[step.patch].as_ref().is_some_and(|wall| !wall.has(position)) {
                        account.led_away += share * step.mass;
                        break;
                    }
                }
                let outcome: Outcome = model
                    .resolve(step.wall, &impact, step.random)
                    .map_err(|error| format!("{}:{}: {error}", self.file.display(), step.line))?;
                let caught = outcome.sticking_probability;
                let tallied = TalliedHit {
                    wall: step.patch,
                    coordinate: position[self.axes[step.patch]],
                    impact: &impact,
                    outcome: &outcome,
                    share,
                    caught,
                    weight: parcel.particles,
                    mass: step.mass,
                };
                hit(&tallied, doubt);
                let mass = share * caught * step.mass;
                account.caught += mass;
                account.caught_later += if index > 0 { mass } else { 0.0 };
                account.doubtful += doubt * mass;
                let left = share * (1.0 - caught);
                if step.base >= CERTAIN {
                    account.without_record += left * step.mass;
                    break;
                }
                if step.captured || left <= 0.0 {
                    break;
                }
                share = left / (1.0 - step.base);
                account.without_record += (share - MOST_SHARE).max(0.0) * step.mass;
                share = share.min(MOST_SHARE);
                match step.onward(rebound_speeds(&impact, &outcome)) {
                    Onward::AsRecorded(change) => {
                        // A flight that is not known again leads to the recorded impact.
                        (doubt, landing) = (doubt.max(change), None);
                    }
                    Onward::Shifted(next, change) => {
                        let shift = landing.map_or([0.0; 3], |landing| landing.shift);
                        let shift = std::array::from_fn(|axis| shift[axis] + next.shift[axis]);
                        (doubt, landing) = (doubt.max(change), Some(Landing { shift, ..next }));
                    }
                    Onward::Away => {
                        account.led_away += share * step.mass;
                        break;
                    }
                }
            }
            end(parcel);
        }
        let of = |mass: f64| mass / self.injected;
        Ok(ReplayAccount {
            caught: of(account.caught),
            caught_later: of(account.caught_later),
            doubtful: of(account.doubtful),
            without_record: of(account.without_record),
            led_away: of(account.led_away),
        })
    }
}

/// The key of an impact's random numbers: always the same, so that predictions change smoothly with a parameter.
fn key(parcel: ParcelId, index: usize) -> u64 {
    let parcel = (parcel.number as u64).wrapping_add((parcel.rank as u64) << 40);
    parcel.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(index as u64)
}

impl Forward for Replayed {
    fn experiments(&self) -> &[Experiment] {
        &self.experiments
    }

    fn base(&self, _experiment: usize) -> &Model {
        &self.base
    }

    fn predict(&self, experiment: usize, change: &ModelChange<'_>) -> Result<Vec<Predicted>, String> {
        let run = &self.runs[experiment];
        let model = change(&self.base);
        let tally = std::cell::RefCell::new(Tally::new(&self.experiments[experiment].readings, &run.patches));
        run.replay(
            &model,
            |hit, doubt| {
                let mut tally = tally.borrow_mut();
                tally.set_doubt(doubt);
                tally.hit(hit);
            },
            |parcel| tally.borrow_mut().end_particle(parcel.injected),
        )?;
        let mut tally = tally.into_inner();
        tally.end_missed(run.missed.0, run.missed.1);
        Ok(tally.predicted())
    }

    fn most_causes(&self) -> usize {
        // A second cause would be judged by impacts that the first one has changed.
        1
    }

    fn input_values(&self, experiment: usize, input: usize) -> Vec<(f64, f64)> {
        let Some(input) = INPUTS.get(input) else { return Vec::new() };
        let run = &self.runs[experiment];
        let first = |parcel: &Parcel| {
            let step = run.steps.get(parcel.steps.start)?;
            // With what the model file puts on the wall.
            let impact = self.base.met(step.wall, &step.impact).ok()?;
            Some(((input.value)(&impact), parcel.particles))
        };
        run.parcels.iter().filter_map(first).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "time,x,y,z,origProcId,origId,parcel_age,n_particles,v_n,v_t,d,T_p,patch,wall,injector,mass,regime,outcome,e_n,e_t";

    /// Rebounds with e_n 0.5 and e_t 0.8; captures half of the particles at this temperature, a fifth of those 6.93 K below.
    fn model(temperature: f64, e_n: f64) -> Model {
        let text = format!(
            "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n[normal]\nmodel = \"constant\"\n\
             e_n = {e_n}\n[tangential]\nmodel = \"constant\"\ne_t = 0.8\n[[effects]]\nkind = \"melting-transition\"\n\
             temperature = {temperature}\nwidth = 5\nsoftening = 0\n"
        );
        Model::from_toml("base.toml", &text).unwrap()
    }

    /// An impact to be recorded.
    struct Hit {
        parcel: usize,
        number: usize,
        temperature: f64,
        mass: f64,
        captured: bool,
    }

    /// Writes the case `folder` with these impacts; impact `number` of a parcel is at z = 0.1 `number`.
    fn write(folder: &Path, hits: &[Hit], injected: f64, parcels: usize) {
        let tables = folder.join("postProcessing/nearWallInteraction/cloud/0");
        std::fs::create_dir_all(&tables).unwrap();
        let row = |hit: &Hit| {
            let Hit { parcel, number, temperature, mass, captured } = hit;
            let outcome = if *captured { "stick,," } else { "rebound,0.5,0.8" };
            format!(
                "{number},0.01,0,{},0,{parcel},{number},1,{},1,1e-4,{temperature},floor,default,jet,{mass},SP-NSW,{outcome}\n",
                0.1 * *number as f64,
                2.0 * 0.5_f64.powi(*number as i32)
            )
        };
        let rows: String = hits.iter().map(row).collect();
        std::fs::write(tables.join("impacts.csv"), format!("# recorded impacts: all\n{HEADER}\n{rows}"))
            .unwrap();
        let sticks = hits.iter().filter(|hit| hit.captured).count();
        let rebounds = hits.len() - sticks;
        let floor =
            format!("# time_s hits rebounds sticks e_n_sum\n9 {} {rebounds} {sticks} 1\n", hits.len());
        std::fs::write(tables.join("floor.dat"), floor).unwrap();
        let balance = format!("# time_s injected_kg injected_parcels residual\n9 {injected} {parcels} 0\n");
        std::fs::write(tables.join("balance.dat"), balance).unwrap();
    }

    fn data(text: &str) -> RigMeasurements {
        RigMeasurements::read("rig.csv", text.as_bytes()).unwrap()
    }

    fn captures(pattern: &[(usize, f64, &str)], temperature: f64) -> Vec<Hit> {
        let all = pattern.iter().flat_map(|(parcel, mass, path)| {
            path.chars().enumerate().map(move |(number, decision)| (*parcel, *mass, number, decision == 'c'))
        });
        let hit = |(parcel, mass, number, captured)| Hit { parcel, number, temperature, mass, captured };
        all.map(hit).collect()
    }

    #[test]
    fn capture_is_reweighted_as_by_hand() {
        let folder = tempfile::tempdir().unwrap();
        let hits = captures(&[(1, 1.0, "rrc"), (2, 2.0, "c"), (3, 1.0, "rr")], 350.0);
        write(&folder.path().join("a"), &hits, 5.0, 4);
        let data = data(
            "experiment,captured@floor,capture_efficiency@floor,captured_from_0.05_to_0.15@floor,mean_e_n@floor\n\
             a,0.5,0.5,0.1,0.5\n",
        );
        let replayed = Replayed::new(folder.path(), &data, &model(350.0, 0.5)).unwrap();
        assert!(replayed.notes()[0].contains("along z"), "{:?}", replayed.notes());
        // p = 0.5 in the run, 0.2 in the changed law: shares 1, 1.6, 2.56.
        let changed = model(350.0 + 5.0 * 4.0_f64.ln(), 0.5);
        let predicted = replayed.predict(0, &|_| changed.clone()).unwrap();
        let expected =
            [0.2 * (5.16 + 2.0 + 2.6) / 5.0, 0.2 * (5.16 + 1.0 + 2.6) / 3.0, 0.2 * (1.6 + 1.6) / 5.0, 0.5];
        for (predicted, expected) in predicted.iter().zip(expected) {
            assert!((predicted.value - expected).abs() < 1e-9, "{} {expected}", predicted.value);
        }
        let account = replayed.account(0, &changed).unwrap();
        assert!((account.caught - expected[0]).abs() < 1e-9);
        assert!((account.caught_later - 0.2 * (4.16 + 1.6) / 5.0).abs() < 1e-9);
        assert_eq!(account.without_record, 0.0);
        // The base itself has weights of 1.
        let base = replayed.predict(0, &Model::clone).unwrap();
        assert!((base[0].value - 0.5 * (3.0 + 2.0 + 2.0) / 5.0).abs() < 1e-9);
        assert_eq!(base[0].particles, 4.0);
        let temperature = INPUTS.iter().position(|input| input.name == "T_p").unwrap();
        assert_eq!(replayed.input_values(0, temperature), vec![(350.0, 1.0); 3]);
    }

    #[test]
    fn changed_rebounds_lead_elsewhere() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &captures(&[(1, 1.0, "rrr"), (2, 1.0, "c")], 350.0), 2.0, 2);
        let data = data(
            "captured_from_0_to_0.01@floor,captured_from_0.047_to_0.048@floor,captured_from_0.067_to_0.069@floor,\
             captured_from_0.09_to_0.3@floor\n0.5,0.1,0.1,0.1\n",
        );
        let replayed = Replayed::new(folder.path(), &data, &model(350.0, 0.5)).unwrap();
        // Bounces of 1 s with 1 and 0.5 m/s take 0.5 and 0.25 s with 0.5 and 0.125 m/s. Along the floor the speed grows by 0.2 m/s in
        // a second: of 0.9 m, 0.1 m in the record, the particle gets 0.425 m and 0.18625 m far.
        let predicted = replayed.predict(0, &|_| model(350.0, 0.25)).unwrap();
        for (predicted, expected) in predicted.iter().zip([0.5, 0.25, 0.25, 0.0]) {
            assert!((predicted.value - expected).abs() < 1e-9, "{} {expected}", predicted.value);
        }
        assert_eq!(replayed.account(0, &model(350.0, 0.25)).unwrap().led_away, 0.0);
        // Twice as fast it leaves the floor that the record knows.
        let account = replayed.account(0, &model(350.0, 0.99)).unwrap();
        assert!(account.led_away > 0.2, "{account:?}");
    }

    #[test]
    fn what_a_certain_capture_hides_is_stated() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &captures(&[(1, 1.0, "c"), (2, 3.0, "c")], 500.0), 8.0, 4);
        let data = data("captured@floor\n0.5\n");
        let replayed = Replayed::new(folder.path(), &data, &model(350.0, 0.5)).unwrap();
        let changed = model(500.0 + 5.0 * 4.0_f64.ln(), 0.5);
        let account = replayed.account(0, &changed).unwrap();
        assert!((account.caught - 0.1).abs() < 1e-9 && (account.without_record - 0.4).abs() < 1e-9);
        let notes = replayed.account_notes(&changed).unwrap();
        assert!(notes[0].contains("up to 40.0 % of the injected mass"), "{notes:?}");
    }

    #[test]
    fn a_wrong_model_file_and_wrong_names_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let hits = captures(&[(1, 1.0, "rrc"), (2, 2.0, "c"), (3, 1.0, "rr")], 350.0);
        write(&folder.path().join("a"), &hits, 5.0, 4);
        let fault = |text: &str, model: &Model| {
            Replayed::new(folder.path(), &data(text), model).unwrap_err().to_string()
        };
        let good = "experiment,captured@floor\na,0.5\n";
        let said = fault(good, &model(350.0, 0.6));
        assert!(said.contains("not the one of the run: on line 3 the run has e_n = 0.500000"), "{said}");
        let said = fault(good, &model(900.0, 0.5));
        assert!(said.contains("the run captured 2 of 6 impacts, the model file 0.0"), "{said}");
        let said = fault("experiment,captured@floor\nb,0.5\n", &model(350.0, 0.5));
        assert!(said.contains("there is no folder") && said.contains("there are a"), "{said}");
        let said = fault("experiment,captured@lid\na,0.5\n", &model(350.0, 0.5));
        assert!(said.contains("`captured@lid`") && said.contains("only on floor"), "{said}");
    }

    /// Random numbers of a world, each with its place.
    fn chance(seed: u64, parcel: usize, number: usize) -> f64 {
        ImpactRng::new(seed, (parcel * 64 + number) as u64).uniform(7)
    }

    /// A world in which a particle rebounds up to six times: its hits under a law, with random captures.
    fn world(law: &Model, seed: u64, parcels: usize) -> Vec<Hit> {
        let mut hits = Vec::new();
        for parcel in 0..parcels {
            let temperature = 335.0 + 25.0 * chance(seed, parcel, 60);
            let mass = 0.5 + chance(seed, parcel, 61);
            for number in 0..6 {
                let impact = Impact {
                    normal_speed: 2.0 * 0.5_f64.powi(number as i32),
                    tangential_speed: 1.0,
                    diameter: 1e-4,
                    particle_temperature: temperature,
                    ..Impact::default()
                };
                let captured = chance(seed, parcel, number)
                    < law.resolve(0, &impact, ImpactRng::default()).unwrap().sticking_probability;
                hits.push(Hit { parcel, number, temperature, mass, captured });
                if captured {
                    break;
                }
            }
        }
        hits
    }

    #[test]
    fn replay_and_brute_force_agree() {
        let (base, changed) = (model(355.0, 0.5), model(362.0, 0.5));
        let parcels = 4000;
        let folder = tempfile::tempdir().unwrap();
        let mass = |hits: &[Hit]| hits.iter().filter(|hit| hit.number == 0).map(|hit| hit.mass).sum::<f64>();
        let run = world(&base, 1, parcels);
        write(folder.path(), &run, mass(&run), parcels);
        let bins = [0.0, 0.05, 0.15, 0.35, 0.6];
        let columns: Vec<String> =
            bins.windows(2).map(|bin| format!("captured_from_{}_to_{}@floor", bin[0], bin[1])).collect();
        let cells = vec!["0.1"; columns.len()].join(",");
        let data = data(&format!("captured@floor,{}\n0.5,{cells}\n", columns.join(",")));
        let replayed = Replayed::new(folder.path(), &data, &base).unwrap();
        // Both better and worse capture than in the run.
        for law in [&changed, &model(349.0, 0.5)] {
            let predicted = replayed.predict(0, &|_| law.clone()).unwrap();
            let truth = world(law, 2, 10 * parcels);
            let caught = |low: f64, high: f64| {
                let inside = truth.iter().filter(|hit| hit.captured);
                let inside = inside.filter(|hit| (low..high).contains(&(0.1 * hit.number as f64)));
                inside.map(|hit| hit.mass).sum::<f64>() / mass(&truth)
            };
            let mut expected = vec![caught(0.0, 1.0)];
            expected.extend(bins.windows(2).map(|bin| caught(bin[0], bin[1])));
            for (predicted, expected) in predicted.iter().zip(&expected) {
                let error =
                    (predicted.variance + 1.3 * expected * (1.0 - expected) / (10 * parcels) as f64).sqrt();
                let off = (predicted.value - expected) / error;
                println!("{:.4} {expected:.4} +- {error:.4}", predicted.value);
                assert!(off.abs() < 4.0, "{} {expected} +- {error}", predicted.value);
                assert!(error < 0.02, "{error}");
            }
        }
    }

    #[test]
    fn large_records_are_thinned_evenly() {
        let base = model(365.0, 0.5);
        let run = world(&base, 1, 8000);
        let folder = tempfile::tempdir().unwrap();
        let mass: f64 = run.iter().filter(|hit| hit.number == 0).map(|hit| hit.mass).sum();
        write(folder.path(), &run, 2.0 * mass, 16000);
        let replayed = Replayed::new(folder.path(), &data("captured@floor\n0.5\n"), &base).unwrap();
        assert!(replayed.notes()[0].contains("of 8000 parcels are replayed"), "{:?}", replayed.notes());
        let [predicted] = replayed.predict(0, &Model::clone).unwrap()[..] else { unreachable!() };
        let counted: f64 =
            run.iter().filter(|hit| hit.captured).map(|hit| hit.mass).sum::<f64>() / (2.0 * mass);
        assert!(
            (predicted.value - counted).abs() < 4.0 * predicted.variance.sqrt(),
            "{predicted:?} {counted}"
        );
    }
}
