//! Expected hits: a particle that a wall catches with a probability flies on with the rest of its weight.
//!
//! [`crate::simulate::run`] decides every capture by a random number. For an expectation that is noise, and it makes the result jump
//! where a parameter changes. Here a hit with the probability `p` catches the share `p` of what is left of the particle, and `1 - p` flies
//! on, until almost nothing is left.
//!
//! Flights are what takes time, so they are shared by all models that are compared ([`PathTree`]): the path up to the first contact does not
//! depend on the model; a rebound flies on with the middle of the cell of a grid into which its restitutions and its spin fall. The grid is
//! shifted for every particle, so that the differences from the middle average out.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use nalgebra::Vector3;
use rayon::prelude::*;

use super::case::Case;
use super::near_wall::StayTimes;
use super::trajectory::{Fate, Tracker, WallContact};
use crate::impact::{Impact, ImpactError, Outcome};
use crate::model::Model;

/// A share of a particle below this is not followed further [1].
const LEAST_SHARE: f64 = 1e-3;

/// Widths of a cell of `e_n`, `e_t` and of the spin over that of rolling with the arriving speed [1].
const CELLS: [f64; 3] = [0.05, 0.05, 0.2];
/// Most rebounds after each of which a cell is twice as wide: later hits matter less.
const WIDER: u64 = 2;
/// Most hits that are followed: an elastic law would keep a particle in a channel for ever.
const MOST_HITS: u64 = 40;
/// Most flights of a particle that are kept.
const KEPT: usize = 100;

/// A cell of the grid of outcomes.
type Cell = [i32; 3];

/// A particle at a contact with a wall.
#[derive(Debug)]
struct Node<'a> {
    tracker: Tracker<'a>,
    /// Index of the surface.
    surface: usize,
    contact: WallContact,
    /// The next contact after a rebound, by the cell; `None` where there is none.
    next: HashMap<Cell, Option<Box<Node<'a>>>>,
}

/// The flights of one particle, which all compared models share.
#[derive(Debug)]
pub struct PathTree<'a> {
    /// The first contact, if there is one, and the number of flights kept after it.
    first: Mutex<(Option<Box<Node<'a>>>, usize)>,
    /// Mass at the start [kg].
    pub mass: f64,
    /// Number of real particles that it represents.
    pub weight: f64,
    /// The shift of the grid, in cells.
    shift: [f64; 3],
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

impl<'a> PathTree<'a> {
    /// At most `particles` particles of a case at their first contacts, evenly over all injections, which are numbered one after the
    /// other; or why one cannot be followed.
    pub fn sample(case: &'a Case, particles: u64) -> Vec<Result<Self, String>> {
        let count = case.count();
        let wanted = particles.min(count).max(1);
        let numbers: Vec<u64> = (0..wanted).map(|place| place * count / wanted).collect();
        numbers.par_iter().map(|number| Self::new(case, *number)).collect()
    }

    /// Flies the particle with this number to its first contact.
    ///
    /// # Errors
    /// Why it cannot be followed.
    pub fn new(case: &'a Case, number: u64) -> Result<Self, String> {
        let (tracker, trouble) = Tracker::start(case, None, number, StayTimes::default());
        if let Some(trouble) = trouble {
            return Err(trouble);
        }
        let (mass, weight, random) = (tracker.mass(), tracker.weight, tracker.random(0));
        let first = Node::after_flight(tracker)?.map(Box::new);
        // Streams that no effect draws from.
        let shift = [100, 101, 102].map(|stream| random.uniform(stream));
        Ok(Self { first: Mutex::new((first, 0)), mass, weight, shift })
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
        let (first, kept) = &mut *first;
        let Some(mut node) = first.as_deref_mut() else { return Ok(()) };
        let mut passing;
        let mut share = 1.0;
        for before in 0..node.tracker.case.hit_limit.min(MOST_HITS) {
            let (tracker, contact) = (&node.tracker, &node.contact);
            let outcome = model.resolve(contact.wall, &contact.impact, tracker.random(before))?;
            observer(&ExpectedHit {
                surface: node.surface,
                position: contact.position,
                impact: &contact.impact,
                outcome: &outcome,
                share,
                weight: tracker.weight,
                mass: tracker.mass(),
            });
            share *= 1.0 - outcome.sticking_probability;
            if share < LEAST_SHARE {
                return Ok(());
            }
            let (cell, middle) = self.cell(&contact.impact, &outcome, before);
            if *kept >= KEPT && !node.next.contains_key(&cell) {
                let Some(next) = node.after_rebound(&middle) else { return Ok(()) };
                passing = next;
                node = &mut passing;
                continue;
            }
            if !node.next.contains_key(&cell) {
                let next = node.after_rebound(&middle).map(Box::new);
                node.next.insert(cell, next);
                *kept += 1;
            }
            match node.next.get_mut(&cell) {
                Some(Some(next)) => node = next,
                _ => return Ok(()),
            }
        }
        Ok(())
    }

    /// The cell of an outcome, and the outcome in its middle.
    fn cell(&self, impact: &Impact, outcome: &Outcome, before: u64) -> (Cell, Outcome) {
        let widths = CELLS.map(|width| width * f64::from(1u32 << before.min(WIDER)));
        let rolling = 2.0 * impact.tangential_speed / impact.diameter;
        let spin = if rolling > 0.0 { outcome.spin / rolling } else { 0.0 };
        let values = [outcome.normal_restitution, outcome.tangential_restitution, spin];
        let cell: Cell =
            std::array::from_fn(|which| (values[which] / widths[which] + self.shift[which]).floor() as i32);
        let [normal_restitution, tangential_restitution, spin] =
            std::array::from_fn(|which| (f64::from(cell[which]) + 0.5 - self.shift[which]) * widths[which]);
        let middle = Outcome {
            normal_restitution: normal_restitution.max(0.0),
            tangential_restitution: tangential_restitution.max(0.0),
            spin: if outcome.spin == 0.0 { 0.0 } else { spin * rolling },
            ..*outcome
        };
        (cell, middle)
    }

    /// The model of its injection where it is not that of the case.
    pub fn own_model(&self) -> Option<&'a Model> {
        let first = self.first.lock().unwrap_or_else(PoisonError::into_inner);
        first.0.as_ref()?.tracker.injection.model.as_ref()
    }

    /// The impact of the first contact with a wall, with what the model file puts on that wall.
    pub fn impact(&self, model: &Model) -> Option<Impact> {
        let first = self.first.lock().unwrap_or_else(PoisonError::into_inner);
        let contact = &first.0.as_ref()?.contact;
        model.met(contact.wall, &contact.impact).ok()
    }
}

impl<'a> Node<'a> {
    /// Flies a particle to its next contact with a wall; `None` for one that leaves or stays in the gas.
    ///
    /// # Errors
    /// Why it cannot be followed.
    fn after_flight(mut tracker: Tracker<'a>) -> Result<Option<Self>, String> {
        match tracker.fly() {
            Ok(surface) => Ok(tracker.bare_contact(surface).map(|contact| {
                let next = HashMap::new();
                Self { tracker, surface, contact, next }
            })),
            Err(Fate::Unusable(reason)) => Err(reason),
            Err(_) => Ok(None),
        }
    }

    /// The next contact after a rebound with this outcome.
    fn after_rebound(&self, outcome: &Outcome) -> Option<Self> {
        let mut tracker = self.tracker.clone();
        let flies = tracker.rebound(&self.contact, outcome);
        if flies { Self::after_flight(tracker).ok().flatten() } else { None }
    }
}
