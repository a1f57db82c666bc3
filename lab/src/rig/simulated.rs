//! `nearwall simulate` as the forward model of a rig.
//!
//! The base law is followed once, with many particles on their exact paths
//! ([`crate::simulate::follow_exactly`]). For a changed law the difference from the base is
//! computed with fewer particles, whose flights all laws share ([`crate::simulate::PathTree`]): up
//! to the first contact their paths do not depend on the wall law, and after it they have the share
//! of their weight that is not caught and the same random numbers, so that predictions change
//! smoothly with a parameter. Every experiment has its own seed: their Monte Carlo errors are
//! independent. It has as many particles as its readings need, within what its hits cost. Walls with
//! a memory (`[deposit]`) have no such paths: their case is run anew for each law, with its own random
//! captures.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::case_change::{CaseChanges, FAR, Moved, NEAR, PRESENT, changed, places_over};
use super::case_number::CaseNumber;
use super::case_text::{CaseText, SettingError, SettingFault};
use super::tally::{PredictedReading, TalliedHit, Tally, away_from_edges};
use super::{Forward, ModelChange, PredictionError};
use crate::dataset::{Experiment, RigMeasurements, RigReading};
use crate::simulate::{
    BLOCKS, Case, ExpectedHit, PathTree, Room, Start, even_starts, follow_exactly, run_once,
};
use nearwall::effect::CurveInput;
use nearwall::model::Model;

/// An experiment with its case.
#[derive(Debug)]
pub struct RigCase {
    experiment: Experiment,
    case: Case,
    text: CaseText,
    /// File, line and name of the experiment.
    place: String,
}

impl RigCase {
    /// The cases of all experiments.
    ///
    /// # Errors
    /// [`SettingError`] of the first experiment that has one.
    pub fn all(text: &CaseText, data: &RigMeasurements) -> Result<Vec<Self>, SettingError> {
        let one = |(number, experiment): (usize, &Experiment)| {
            let place = format!("{}:{}: experiment `{}`", data.file, experiment.line, experiment.name);
            Self::new(text, experiment, place, number as u64)
        };
        data.experiments.iter().enumerate().map(one).collect()
    }

    /// The case of an experiment that nobody has made yet.
    ///
    /// # Errors
    /// [`SettingError`] for settings that the case refuses.
    pub fn proposed(text: &CaseText, experiment: &Experiment) -> Result<Self, SettingError> {
        Self::new(text, experiment, experiment.name.clone(), 0)
    }

    /// The case of an experiment; `place` names it in messages.
    ///
    /// # Errors
    /// [`SettingError`] for a setting that the case does not have, or an observable of a wall that it does not have.
    fn new(
        text: &CaseText,
        experiment: &Experiment,
        place: String,
        number: u64,
    ) -> Result<Self, SettingError> {
        let mut case = text.with(&place, &experiment.settings)?;
        case.seed = case.seed.wrapping_add(number);
        case.tolerance = case.tolerance.max(PATH_TOLERANCE);
        let walls: Vec<&str> = case.surfaces.iter().map(|surface| surface.name.as_str()).collect();
        if let Some(reading) = experiment.readings.iter().find(|r| !walls.contains(&r.wall.as_str())) {
            let reason = SettingFault::NoWall { wall: reading.wall.clone(), walls: walls.join(", ") };
            return Err(SettingError::Setting { experiment: place, key: reading.column.clone(), reason });
        }
        if case.has_own_models() {
            let (key, reason) = ("particles.model".to_owned(), SettingFault::OwnModels);
            return Err(SettingError::Setting { experiment: place, key, reason });
        }
        Ok(Self { experiment: experiment.clone(), case, text: text.clone(), place })
    }
}

/// The paths of one experiment.
#[derive(Debug)]
struct Paths<'a> {
    rig: &'a RigCase,
    walls: Vec<String>,
    /// In independent blocks.
    blocks: Vec<Vec<PathTree<'a>>>,
    /// Held by the thread that follows a block.
    followed: Vec<Mutex<()>>,
    /// What the base law gives with many particles, and in these blocks.
    base: Vec<[PredictedReading; 2]>,
    /// Number of particles that tell what numbers of the case change.
    moved_particles: u64,
    /// What the base law gives with them, once that was computed.
    unmoved: Vec<PredictedReading>,
    /// What each number of the case changes, once that was computed.
    changes: Vec<CaseChanges>,
}

/// All experiments with the paths of their particles up to the first contact.
#[derive(Debug)]
pub struct SimulatedRig<'a> {
    runs: Vec<Paths<'a>>,
    experiments: Vec<Experiment>,
    numbers: Vec<CaseNumber>,
}

/// Relative error of a step of a path: far below the Monte Carlo error [1].
const PATH_TOLERANCE: f64 = 1e-4;
/// Fewest particles of an experiment. They are doubled while there are fewer than the first number
/// of hits, or than the second where the Monte Carlo error is not small, at most to the largest.
const PARTICLE_RANGE: [u64; 2] = [128, 1024];
const HITS: [f64; 2] = [256.0, 512.0];
/// Monte Carlo variance that is small beside that of a reading [1].
const SMALL_VARIANCE: f64 = 0.1;
/// Variance of a count of 0 [1]: half a particle, as Jeffreys' prior of a share counts.
const UNSEEN: f64 = 0.5;
/// At most so many times as many follow the base law [1]; fewer where the Monte Carlo variance needs no more.
const BASE_PARTICLES: u64 = 4;
/// Particles that follow the base law over those that tell what a number of the case changes [1]: with the same random
/// numbers a change has a small error.
const BASE_OVER_MOVED: u64 = 16;
/// Particles that tell whether a number changes anything at all.
const SCREENED: u64 = 64;
/// Most flights that are kept, of all experiments together [1]: a diagnosis of ten turbulent ducts takes 0.3 to 0.4 GB.
const KEPT_FLIGHTS: u64 = 1_000_000;
/// Fall of the sum of squared residuals by a move of a number, from which on the readings speak for it [1]: a right
/// number exceeds it in a sixth of cases.
const TOLD: f64 = 2.0;
/// Standard error of a reading that states none [1].
const USUAL_ERROR: f64 = 0.02;

impl<'a> SimulatedRig<'a> {
    /// Flies particles of each case to their first contact: as many as its readings need.
    ///
    /// # Errors
    /// Why no particle of an experiment can be followed.
    pub fn new(rigs: &'a [RigCase]) -> Result<Self, PredictionError> {
        let room = Room::new(KEPT_FLIGHTS);
        let runs = rigs.par_iter().map(|rig| Paths::adapted(rig, &room)).collect::<Result<Vec<_>, _>>()?;
        Ok(Self::of(rigs, runs))
    }

    /// The same of experiments that nobody has made yet, with about `particles` particles of each; without those whose
    /// walls or particles get where the model is not known.
    pub fn of_proposals(rigs: &'a [RigCase], particles: u64) -> Self {
        let room = Room::new(KEPT_FLIGHTS);
        let fly = |rig| Paths::new(rig, particles, &room)?.with_base(1);
        Self::of(rigs, rigs.par_iter().filter_map(|rig| fly(rig).ok()).collect())
    }

    fn of(rigs: &[RigCase], runs: Vec<Paths<'a>>) -> Self {
        let experiments = runs.iter().map(|run| run.rig.experiment.clone()).collect();
        let followed_anew = rigs.first().filter(|rig| rig.case.deposit.is_none());
        let numbers = followed_anew.map(|rig| rig.text.numbers()).unwrap_or_default();
        Self { runs, experiments, numbers }
    }

    /// Computes what numbers of the case change, by their places, from the least to the largest of these standard
    /// errors: until then they change nothing.
    #[must_use]
    pub fn with_case_numbers(mut self, ranges: &BTreeMap<usize, [f64; 2]>) -> Self {
        for (number, range) in ranges {
            self.add_changes(&[*number], &places_over(*range));
        }
        self
    }

    /// Computes what all numbers of the case change within the errors of their instruments, and beyond on the side that
    /// the readings speak for.
    #[must_use]
    pub fn with_told_numbers(mut self) -> Self {
        let unmoved: Vec<_> = self.runs.par_iter().map(|run| run.screened(&run.rig.case)).collect();
        let matters = |number: &usize| {
            let runs = self.runs.par_iter().zip(&unmoved);
            runs.any(|(run, unmoved)| run.depends_on(&self.numbers[*number], unmoved))
        };
        let all: Vec<usize> = (0..self.numbers.len()).filter(matters).collect();
        self.add_changes(&all, &NEAR);
        for side in NEAR {
            let is_told = |number: &usize| {
                self.numbers[*number].missing_force().is_none() && self.is_told(*number, side)
            };
            let told: Vec<usize> = all.iter().copied().filter(is_told).collect();
            let beyond: Vec<f64> = FAR.into_iter().filter(|widths| widths * side > 0.0).collect();
            self.add_changes(&told, &beyond);
        }
        self
    }

    fn add_changes(&mut self, places: &[usize], widths: &[f64]) {
        let Self { runs, numbers, .. } = self;
        if places.is_empty() {
            return;
        }
        runs.par_iter_mut().for_each(|run| run.add_changes(numbers, places, widths));
    }

    /// Whether the readings may be the better explained by a number moved by so many standard errors.
    fn is_told(&self, number: usize, widths: f64) -> bool {
        let terms = self.runs.iter().flat_map(|run| run.terms(number, widths));
        let [along, square] = terms.fold([0.0; 2], |[along, square], [residual, change]| {
            [along + residual * change, square + change * change]
        });
        along > 0.0 && along * along > TOLD * square
    }
}

/// The places of a number among these: a force is there or not.
fn places_of<'w>(number: &CaseNumber, widths: &'w [f64]) -> &'w [f64] {
    if number.missing_force().is_some() { &[PRESENT] } else { widths }
}

/// Variance of a reading about a predicted value [1].
fn variance(reading: &RigReading, predicted: f64) -> f64 {
    let p = away_from_edges(predicted);
    match (reading.error, reading.count) {
        (Some(error), _) => error * error,
        (None, Some(count)) if reading.quantity.is_share() => p * (1.0 - p) / count,
        _ => USUAL_ERROR * USUAL_ERROR,
    }
}

/// Monte Carlo variance of a predicted value [1]; a share that no particle shows, or all of them, is not known exactly.
fn possible_variance(reading: &RigReading, predicted: &PredictedReading) -> f64 {
    let unseen = if reading.quantity.is_share() { UNSEEN / predicted.particles.powi(2) } else { 0.0 };
    predicted.variance.max(unseen)
}

/// The largest of some Monte Carlo variances over what is small beside that of their readings [1].
fn largest_share<'r>(known: impl Iterator<Item = (f64, &'r RigReading, &'r PredictedReading)>) -> f64 {
    let shares = known.map(|(own, reading, one)| own / (SMALL_VARIANCE * variance(reading, one.value)));
    shares.filter(|share| share.is_finite()).fold(0.0, f64::max)
}

impl<'a> Paths<'a> {
    /// With as many particles as the readings need, within what their hits cost.
    fn adapted(rig: &'a RigCase, room: &Room) -> Result<Self, PredictionError> {
        let [mut particles, most] = PARTICLE_RANGE;
        loop {
            let paths = Self::new(rig, particles, room)?;
            if rig.case.deposit.is_some() {
                return Ok(paths);
            }
            let (predicted, hits) = paths.tallied(&rig.case.model)?;
            let readings = || rig.experiment.readings.iter().zip(&predicted);
            let seen = largest_share(readings().map(|(reading, one)| (one.variance, reading, one)));
            // Hits grow, and variances fall, with the number of particles.
            let is_enough = |times: f64| times * hits >= HITS[usize::from(seen > times)];
            if particles >= most || is_enough(1.0) {
                let possible =
                    readings().map(|(reading, one)| (possible_variance(reading, one), reading, one));
                let times = largest_share(possible).ceil().clamp(1.0, BASE_PARTICLES as f64);
                return paths.with_base(times as u64);
            }
            let own = particles;
            while particles < most && !is_enough((particles / own) as f64) {
                particles *= 2;
            }
        }
    }

    /// Follows the base law with so many times as many particles.
    fn with_base(mut self, times: u64) -> Result<Self, PredictionError> {
        if self.rig.case.deposit.is_none() {
            let (own, _) = self.tallied(&self.rig.case.model)?;
            let particles = times * self.particles();
            let known = self.exactly(&self.rig.case, particles);
            self.moved_particles = (particles / BASE_OVER_MOVED).max(PARTICLE_RANGE[0]);
            self.base = known.into_iter().zip(own).map(|(known, own)| [known, own]).collect();
        }
        Ok(self)
    }

    /// Number of particles whose flights are kept.
    fn particles(&self) -> u64 {
        self.blocks.iter().map(Vec::len).sum::<usize>() as u64
    }

    fn new(rig: &'a RigCase, particles: u64, room: &Room) -> Result<Self, PredictionError> {
        let walls = rig.case.surfaces.iter().map(|surface| surface.name.clone()).collect();
        let starts = even_starts(&rig.case, particles);
        let fly = |block: &Vec<Start>| -> Vec<_> {
            block.par_iter().map(|start| PathTree::new(&rig.case, *start, room)).collect()
        };
        let flown: Vec<_> = starts.iter().map(fly).collect();
        let first_trouble = flown.iter().flatten().find_map(|one| one.as_ref().err().cloned());
        let usable = |block: Vec<_>| block.into_iter().filter_map(Result::ok).collect();
        let blocks: Vec<Vec<PathTree<'a>>> = flown.into_iter().map(usable).collect();
        if let Some(trouble) = first_trouble
            && blocks.iter().all(Vec::is_empty)
        {
            return Err(PredictionError::new(&rig.place, &trouble));
        }
        let followed = blocks.iter().map(|_| Mutex::default()).collect();
        let (base, moved_particles, unmoved, changes) = Default::default();
        Ok(Self { rig, walls, blocks, followed, base, moved_particles, unmoved, changes })
    }

    fn predict(&self, change: &ModelChange<'_>) -> Result<Vec<PredictedReading>, PredictionError> {
        let RigCase { case, experiment, .. } = self.rig;
        let model = change(&case.model);
        if case.deposit.is_some() {
            let mut tally = Tally::new(&experiment.readings, &self.walls);
            self.run_with_memory(model, &mut tally)?;
            return Ok(tally.predicted());
        }
        let (changed, _) = self.tallied(&model)?;
        Ok(changed.iter().zip(&self.base).map(|(to, [known, from])| known.moved(from, to)).collect())
    }

    /// Computes what numbers of the case change at further places of them.
    fn add_changes(&mut self, numbers: &[CaseNumber], places: &[usize], widths: &[f64]) {
        let particles = self.moved_particles;
        if self.unmoved.is_empty() {
            self.unmoved = self.exactly(&self.rig.case, particles);
        }
        let shares: Vec<bool> =
            self.rig.experiment.readings.iter().map(|one| one.quantity.is_share()).collect();
        self.changes.resize(numbers.len(), CaseChanges::default());
        for number in places.iter().copied() {
            let at = |widths: &f64| {
                Some((*widths, self.exactly(&self.moved(&numbers[number], *widths)?, particles)))
            };
            let moved: Vec<Moved> = places_of(&numbers[number], widths).par_iter().filter_map(at).collect();
            self.changes[number].add(&shares, &self.unmoved, &moved);
        }
    }

    /// The case with a number moved by so many standard errors; one that the case refuses is none that was.
    fn moved(&self, number: &CaseNumber, widths: f64) -> Option<Case> {
        let RigCase { experiment, text, place, case } = self.rig;
        let mut moved = text.with_moved(place, &experiment.settings, (number, widths)).ok()?;
        (moved.seed, moved.tolerance) = (case.seed, case.tolerance);
        Some(moved)
    }

    /// The bits of what few particles give in a case.
    fn screened(&self, case: &Case) -> Vec<u64> {
        self.exactly(case, SCREENED).iter().map(|one| one.value.to_bits()).collect()
    }

    /// Whether a number of the case changes anything at all about what few particles give in it, be it by rounding.
    fn depends_on(&self, number: &CaseNumber, unmoved: &[u64]) -> bool {
        let mut moved = places_of(number, &NEAR).iter().filter_map(|widths| self.moved(number, *widths));
        moved.any(|case| self.screened(&case) != unmoved)
    }

    /// Residual of each reading and what a number, moved by so many standard errors, changes, both over the error.
    fn terms(&self, number: usize, widths: f64) -> Vec<[f64; 2]> {
        let changes = self.changes.get(number).map(|known| known.at(widths)).unwrap_or_default();
        let predicted = self.base.iter().map(|[known, _]| known).zip(changes);
        let of = |(reading, (one, [change, _])): (&RigReading, (&PredictedReading, [f64; 2]))| {
            let to = changed(reading.quantity.is_share(), one.value, change);
            let error = (variance(reading, one.value) + one.variance).sqrt();
            let [residual, change] = [reading.value - one.value, to - one.value].map(|gap| gap / error);
            (residual.is_finite() && change.is_finite()).then_some([residual, change])
        };
        self.rig.experiment.readings.iter().zip(predicted).filter_map(of).collect()
    }

    /// What the base law gives in a case with this number of particles on exact paths.
    fn exactly(&self, case: &Case, particles: u64) -> Vec<PredictedReading> {
        let experiment = &self.rig.experiment;
        let mut tally = Tally::new(&experiment.readings, &self.walls);
        for block in even_starts(case, particles) {
            let of = |start: &Start| {
                let mut own = Tally::new(&experiment.readings, &self.walls);
                let followed = follow_exactly(case, *start, &case.model, |hit| own.hit(&tallied(case, hit)));
                followed.map(|mass| own.end_particle_of_block(mass)).map(|()| own)
            };
            // A particle that cannot be followed is left out, as `simulate` does.
            block
                .par_iter()
                .filter_map(|start| of(start).ok())
                .collect::<Vec<_>>()
                .into_iter()
                .for_each(|own| tally.add(own));
            tally.end_block();
        }
        self.predicted(tally)
    }

    /// What a model gives for these particles, and how often they hit a wall.
    fn tallied(&self, model: &Model) -> Result<(Vec<PredictedReading>, f64), PredictionError> {
        let mut left: Vec<usize> = (0..self.blocks.len()).collect();
        let mut done: Vec<(usize, Tally, f64)> = Vec::new();
        while let Some(&first) = left.first() {
            // Two threads that follow the same particles one after the other would wait for each other's flights.
            let free = left.iter().find_map(|&block| Some((block, self.followed[block].try_lock().ok()?)));
            let (block, _guard) = free.unwrap_or_else(|| {
                (first, self.followed[first].lock().unwrap_or_else(PoisonError::into_inner))
            });
            let (tally, hits) = self.tallied_block(&self.blocks[block], model)?;
            done.push((block, tally, hits));
            left.retain(|one| *one != block);
        }
        done.sort_unstable_by_key(|(block, ..)| *block);
        let mut all = Tally::new(&self.rig.experiment.readings, &self.walls);
        let mut hits = 0.0;
        for (_, tally, own) in done {
            all.add(tally);
            all.end_block();
            hits += own;
        }
        Ok((self.predicted(all), hits))
    }

    /// The same of one block.
    fn tallied_block(&self, block: &[PathTree<'_>], model: &Model) -> Result<(Tally, f64), PredictionError> {
        let RigCase { case, experiment, place, .. } = self.rig;
        let mut tally = Tally::new(&experiment.readings, &self.walls);
        let mut hits = 0.0;
        for particle in block {
            let followed = particle.follow(model, |hit| {
                hits += 1.0;
                tally.hit(&tallied(case, hit));
            });
            followed.map_err(|error| PredictionError::new(place, &error))?;
            tally.end_particle_of_block(particle.mass);
        }
        Ok((tally, hits))
    }

    /// The predictions of a tally. Where nothing moves particles at random, the noise of differences between
    /// predictions for the same particles is left out: next to none.
    fn predicted(&self, tally: Tally) -> Vec<PredictedReading> {
        let mut predicted = tally.predicted();
        if !self.rig.case.gas.is_random() {
            predicted.iter_mut().for_each(|one| one.blocks = [0.0; BLOCKS]);
        }
        predicted
    }

    /// Runs the whole case, whose walls change with what they caught.
    fn run_with_memory(&self, model: Model, tally: &mut Tally) -> Result<(), PredictionError> {
        let RigCase { experiment, text, place, case: base } = self.rig;
        let mut case = text.with(place, &experiment.settings)?;
        case.model = model;
        case.seed = base.seed;
        let ran = run_once::<String>(&case, None, &mut |case, _, _, trajectory| {
            for hit in &trajectory.hits {
                tally.hit(&TalliedHit {
                    wall: hit.surface,
                    coordinate: case.surfaces[hit.surface].shape.coordinate(&hit.position),
                    impact: &hit.impact,
                    outcome: &hit.outcome,
                    share: 1.0,
                    caught: f64::from(u8::from(hit.outcome.stuck)),
                    weight: trajectory.weight,
                    mass: hit.mass,
                });
            }
            tally.end_particle(trajectory.mass[0]);
            Ok(())
        });
        ran.map(drop).map_err(|error| PredictionError::new(place, &error))
    }
}

fn tallied<'h>(case: &Case, hit: &ExpectedHit<'h>) -> TalliedHit<'h> {
    TalliedHit {
        wall: hit.surface,
        coordinate: case.surfaces[hit.surface].shape.coordinate(&hit.position),
        impact: hit.impact,
        outcome: hit.outcome,
        share: hit.share,
        caught: hit.outcome.sticking_probability,
        weight: hit.weight,
        mass: hit.mass,
    }
}

impl Forward for SimulatedRig<'_> {
    fn experiments(&self) -> &[Experiment] {
        &self.experiments
    }

    fn base(&self, experiment: usize) -> &Model {
        &self.runs[experiment].rig.case.model
    }

    fn predict(
        &self,
        experiment: usize,
        change: &ModelChange<'_>,
    ) -> Result<Vec<PredictedReading>, PredictionError> {
        self.runs[experiment].predict(change)
    }

    fn case_numbers(&self) -> &[CaseNumber] {
        &self.numbers
    }

    fn case_change(&self, experiment: usize, number: usize, widths: f64) -> Vec<[f64; 2]> {
        self.runs[experiment].changes.get(number).map(|known| known.at(widths)).unwrap_or_default()
    }

    fn input_values(&self, experiment: usize, input: CurveInput) -> Vec<(f64, f64)> {
        let Paths { rig, blocks, .. } = &self.runs[experiment];
        let of = |particle: &PathTree<'_>| Some((particle.input(&rig.case.model, input)?, particle.weight));
        blocks.iter().flatten().filter_map(of).collect()
    }
}
