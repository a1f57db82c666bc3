//! Expected hits: a particle that a wall catches with a probability flies on with the rest of its weight.
//!
//! [`crate::simulate::run_once`] decides every capture by a random number. For an expectation that
//! is noise, and it makes the result jump where a parameter changes. Here a hit with the
//! probability `p` catches the share `p` of what is left of the particle, and `1 - p` flies on,
//! until almost nothing is left.
//!
//! [`follow_exactly`] follows one particle so. To compare many models, their flights are shared,
//! which is what takes time ([`PathTree`]): the path up to the first contact does not depend on the
//! model; a rebound flies on with the middle of the cell of a grid into which its restitutions and
//! its spin fall. The grid is shifted for every particle, so that the differences from the middle
//! average out. Where a threshold is sharp some bias is left, which nearly cancels in differences
//! between models.

use std::sync::atomic::{AtomicI64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::Vector3;
use rayon::prelude::*;

use super::case::Case;
use super::error::SimulationError;
use super::near_wall::StayTimes;
use super::tracker::{Start, Tracker, WallContact, impact_random};
use super::trajectory::Fate;
use nearwall::effect::CurveInput;
use nearwall::impact::{Impact, ImpactError, Outcome};
use nearwall::model::Model;
use nearwall::rng::ImpactRng;

/// A share of a particle below this is not followed further [1].
const LEAST_FOLLOWED_SHARE: f64 = 1e-3;

/// Widths of a cell of `ln e_n`, of `e_t` and of the spin over that of rolling with the arriving speed [1].
const CELL_WIDTHS: [f64; 3] = [0.15, 0.15, 0.5];
/// Times as wide in a gas with random motion: its noise hides smaller differences (assumed).
const WIDER: f64 = 3.0;
/// Most hits that are followed: an elastic law would keep a particle in a channel for ever.
const MOST_FOLLOWED_HITS: u64 = 40;
/// Flights that are kept in a sample of a case, for each particle.
const KEPT: u64 = 100;

/// A cell of the grid of outcomes.
type OutcomeCell = [i32; 3];

/// A particle at a contact with a wall.
#[derive(Debug)]
struct Node<'a> {
    tracker: Tracker<'a>,
    /// Index of the surface.
    surface: usize,
    contact: WallContact,
    /// The next contact after a rebound, in the order of the cells; `None` where there is none.
    next: Vec<(OutcomeCell, Option<Box<Node<'a>>>)>,
}

/// The flights of one particle, which all compared models share.
#[derive(Debug)]
pub struct PathTree<'a> {
    case: &'a Case,
    /// The first contact, if there is one.
    first: Mutex<Option<Box<Node<'a>>>>,
    /// From which the random numbers of its hits follow.
    number: u64,
    /// Mass at the start [kg].
    pub mass: f64,
    /// Number of real particles that it represents.
    pub weight: f64,
    /// The shift of the grid, in cells.
    shift: [f64; 3],
    /// Flights after first contacts that may yet be kept.
    room: Room,
}

/// Number of flights that may yet be kept, of all particles together: some rebound often, most hardly ever.
#[derive(Debug, Clone)]
pub struct Room(Arc<AtomicI64>);

impl Room {
    /// For so many flights.
    pub fn new(flights: u64) -> Self {
        Self(Arc::new(AtomicI64::new(i64::try_from(flights).unwrap_or(i64::MAX))))
    }

    /// Takes the place of a flight, if there is one. What is predicted does not depend on it.
    fn take(&self) -> bool {
        self.0.load(Ordering::Relaxed) > 0 && self.0.fetch_sub(1, Ordering::Relaxed) > 0
    }
}

/// A hit of a particle with a share of its weight.
#[derive(Debug, Clone, Copy)]
pub struct ExpectedHit<'a> {
    /// Index of the surface.
    pub surface: usize,
    /// Centre of the particle [m].
    pub position: Vector3<f64>,
    /// The impact.
    pub impact: &'a Impact,
    /// Its outcome if nothing catches the particle, with the probability of capture.
    pub outcome: &'a Outcome,
    /// Share of the particle that arrives [1].
    pub share: f64,
    /// Number of real particles that the whole particle represents.
    pub weight: f64,
    /// Their mass at the hit [kg].
    pub mass: f64,
}

/// Follows a particle under a model from its start, and hands over each of its hits; its mass at the start [kg].
///
/// # Errors
/// Why it cannot be followed.
pub fn follow_exactly(
    case: &Case,
    start: Start,
    model: &Model,
    mut observer: impl FnMut(&ExpectedHit<'_>),
) -> Result<f64, SimulationError> {
    let ([mass, _], mut node) = Node::first(case, start)?;
    let mut share = 1.0;
    for before in 0..case.hit_limit.min(MOST_FOLLOWED_HITS) {
        let Some(at) = node else { break };
        let random = impact_random(case, start.number, before);
        let outcome = at.decide(model, random, &mut share, &mut observer)?;
        node = outcome.and_then(|outcome| at.after_rebound(&outcome));
    }
    Ok(mass)
}

impl<'a> PathTree<'a> {
    /// At most `particles` particles of a case at their first contacts, evenly over all injections,
    /// which are numbered one after the other; or why one cannot be followed.
    pub fn sample(case: &'a Case, particles: u64) -> Vec<Result<Self, SimulationError>> {
        let count = case.count();
        let wanted = particles.min(count).max(1);
        let numbers: Vec<u64> = (0..wanted).map(|place| place * count / wanted).collect();
        let room = Room::new(KEPT * wanted);
        numbers.par_iter().map(|number| Self::new(case, Start::drawn(case, *number).0, &room)).collect()
    }

    /// Flies a particle from its start to its first contact; its later flights are kept while there is room.
    ///
    /// # Errors
    /// Why it cannot be followed.
    pub fn new(case: &'a Case, start: Start, room: &Room) -> Result<Self, SimulationError> {
        let ([mass, weight], first) = Node::first(case, start)?;
        let random = impact_random(case, start.number, 0);
        // Streams that no effect draws from.
        let shift = [100, 101, 102].map(|stream| random.uniform(stream));
        let first = Mutex::new(first.map(Box::new));
        Ok(Self { case, first, number: start.number, mass, weight, shift, room: room.clone() })
    }

    /// Follows the particle under a model, and hands over each of its hits.
    ///
    /// # Errors
    /// [`ImpactError`] when the model cannot decide a hit.
    pub fn follow(
        &self,
        model: &Model,
        mut observer: impl FnMut(&ExpectedHit<'_>),
    ) -> Result<(), ImpactError> {
        let mut first = self.first.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(mut node) = first.as_deref_mut() else { return Ok(()) };
        let mut passing;
        let mut share = 1.0;
        for before in 0..self.case.hit_limit.min(MOST_FOLLOWED_HITS) {
            let random = impact_random(self.case, self.number, before);
            let Some(outcome) = node.decide(model, random, &mut share, &mut observer)? else { return Ok(()) };
            let (cell, middle) = self.cell(&node.contact.impact, &outcome);
            let place = match node.next.binary_search_by(|(known, _)| known.cmp(&cell)) {
                Ok(place) => place,
                Err(place) if self.room.take() => {
                    let next = node.after_rebound(&middle).map(Box::new);
                    node.next.insert(place, (cell, next));
                    place
                }
                Err(_) => {
                    let Some(next) = node.after_rebound(&middle) else { return Ok(()) };
                    passing = next;
                    node = &mut passing;
                    continue;
                }
            };
            match &mut node.next[place].1 {
                Some(next) => node = next,
                None => return Ok(()),
            }
        }
        Ok(())
    }

    /// The cell of an outcome, and the outcome in its middle.
    fn cell(&self, impact: &Impact, outcome: &Outcome) -> (OutcomeCell, Outcome) {
        let wider = if self.case.gas.is_random() { WIDER } else { 1.0 };
        let widths = CELL_WIDTHS.map(|width| wider * width);
        let rolling = 2.0 * impact.tangential_speed / impact.diameter;
        let spin = if rolling > 0.0 { outcome.spin / rolling } else { 0.0 };
        let values = [outcome.normal_restitution.ln(), outcome.tangential_restitution, spin];
        let cell: OutcomeCell =
            std::array::from_fn(|which| (values[which] / widths[which] + self.shift[which]).floor() as i32);
        let [normal_restitution, tangential_restitution, spin] =
            std::array::from_fn(|which| (f64::from(cell[which]) + 0.5 - self.shift[which]) * widths[which]);
        let middle = Outcome {
            normal_restitution: normal_restitution.exp(),
            tangential_restitution: tangential_restitution.max(0.0),
            spin: if outcome.spin == 0.0 { 0.0 } else { spin * rolling },
            ..*outcome
        };
        (cell, middle)
    }

    /// The model of its injection where it is not that of the case.
    pub fn own_model(&self) -> Option<&'a Model> {
        let first = self.first.lock().unwrap_or_else(PoisonError::into_inner);
        first.as_ref()?.tracker.injection.model.as_ref()
    }

    /// An input or group of the first contact with a wall, with what the model file puts on that wall [its unit]; NaN
    /// where it has no value.
    pub fn input(&self, model: &Model, input: CurveInput) -> Option<f64> {
        let first = self.first.lock().unwrap_or_else(PoisonError::into_inner);
        let contact = &first.as_ref()?.contact;
        model.group_value(contact.wall, &contact.impact, input).ok()
    }
}

impl<'a> Node<'a> {
    /// Mass at the start [kg] and number of real particles of a particle, and its first contact, if there is one.
    ///
    /// # Errors
    /// Why it cannot be followed.
    fn first(case: &'a Case, start: Start) -> Result<([f64; 2], Option<Self>), SimulationError> {
        let (tracker, trouble) = Tracker::start(case, None, start, StayTimes::default());
        let amount = [tracker.mass(), tracker.weight];
        match trouble {
            Some(trouble) => Err(trouble),
            None => Ok((amount, Self::after_flight(tracker)?)),
        }
    }

    /// Decides the hit and hands it over; `share` of the particle arrives, and then flies on.
    /// `None` when hardly anything does.
    fn decide(
        &self,
        model: &Model,
        random: ImpactRng,
        share: &mut f64,
        observer: &mut impl FnMut(&ExpectedHit<'_>),
    ) -> Result<Option<Outcome>, ImpactError> {
        let contact = &self.contact;
        let outcome = model.resolve(contact.wall, &contact.impact, random)?;
        observer(&ExpectedHit {
            surface: self.surface,
            position: contact.position,
            impact: &contact.impact,
            outcome: &outcome,
            share: *share,
            weight: self.tracker.weight,
            mass: self.tracker.mass(),
        });
        *share *= 1.0 - outcome.sticking_probability;
        let flies = *share >= LEAST_FOLLOWED_SHARE && outcome.normal_restitution > 0.0;
        Ok(flies.then_some(outcome))
    }

    /// Flies a particle to its next contact with a wall; `None` for one that leaves or stays in the gas.
    ///
    /// # Errors
    /// Why it cannot be followed.
    fn after_flight(mut tracker: Tracker<'a>) -> Result<Option<Self>, SimulationError> {
        match tracker.fly() {
            Ok(surface) => Ok(tracker.bare_contact(surface).map(|contact| {
                let next = Vec::new();
                Self { tracker, surface, contact, next }
            })),
            Err(Fate::Unusable(reason)) => Err(reason),
            Err(_) => Ok(None),
        }
    }

    /// The next contact after a rebound with this outcome.
    fn after_rebound(&self, outcome: &Outcome) -> Option<Self> {
        let mut tracker = self.tracker.clone();
        tracker.give_heat(&self.contact).ok()?;
        let flies = tracker.rebound(&self.contact, outcome);
        if flies { Self::after_flight(tracker).ok().flatten() } else { None }
    }
}
