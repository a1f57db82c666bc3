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

use super::case::Case;
use super::near_wall::StayTimes;
use super::trajectory::{Fate, Tracker};
use crate::impact::{Impact, ImpactError, Outcome};
use crate::model::Model;

/// A share of a particle below this is not followed further [1].
const LEAST_SHARE: f64 = 1e-3;

/// Widths of a cell of `e_n`, `e_t` and of the spin over that of rolling with the arriving speed [1].
const CELLS: [f64; 3] = [0.03, 0.03, 0.2];
/// Rebounds in a row whose flights are kept.
const KEPT_REBOUNDS: u64 = 8;

/// A particle at a contact, or the end of one that reaches none.
#[derive(Debug)]
struct Node<'a> {
    tracker: Tracker<'a>,
    /// Index of the surface.
    end: Result<usize, Fate>,
    /// Where the particle comes after a rebound, by the cell.
    next: HashMap<[i64; 3], Node<'a>>,
}

/// The flights of one particle, which all compared models share.
#[derive(Debug)]
pub struct PathTree<'a> {
    first: Mutex<Node<'a>>,
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
        let first = Node::flown(tracker);
        if let Err(Fate::Unusable(reason)) = &first.end {
            return Err(reason.clone());
        }
        // Streams that no effect draws from.
        let shift = [100, 101, 102].map(|stream| random.uniform(stream));
        Ok(Self { first: Mutex::new(first), mass, weight, shift })
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
        let mut node: &mut Node<'a> = &mut first;
        let mut passing;
        let mut share = 1.0;
        for before in 0..node.tracker.case.hit_limit {
            let Ok(surface) = node.end else { return Ok(()) };
            let tracker = &node.tracker;
            let Some(contact) = tracker.contact(surface, model)? else { return Ok(()) };
            let outcome = model.resolve(contact.wall, &contact.impact, tracker.random(before))?;
            observer(&ExpectedHit {
                surface,
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
            let (cell, middle) = self.cell(&contact.impact, &outcome);
            let fly = || {
                let mut tracker = node.tracker.clone();
                tracker.rebound(&contact, &middle).then(|| Node::flown(tracker))
            };
            if before < KEPT_REBOUNDS {
                if !node.next.contains_key(&cell) {
                    let Some(next) = fly() else { return Ok(()) };
                    node.next.insert(cell, next);
                }
                let Some(next) = node.next.get_mut(&cell) else { return Ok(()) };
                node = next;
            } else {
                let Some(next) = fly() else { return Ok(()) };
                passing = next;
                node = &mut passing;
            }
        }
        Ok(())
    }

    /// The cell of an outcome, and the outcome in its middle.
    fn cell(&self, impact: &Impact, outcome: &Outcome) -> ([i64; 3], Outcome) {
        let rolling = 2.0 * impact.tangential_speed / impact.diameter;
        let spin = if rolling > 0.0 { outcome.spin / rolling } else { 0.0 };
        let values = [outcome.normal_restitution, outcome.tangential_restitution, spin];
        let cell: [i64; 3] =
            std::array::from_fn(|which| (values[which] / CELLS[which] + self.shift[which]).floor() as i64);
        let [normal_restitution, tangential_restitution, spin] =
            std::array::from_fn(|which| (cell[which] as f64 + 0.5 - self.shift[which]) * CELLS[which]);
        let middle = Outcome {
            normal_restitution: normal_restitution.max(0.0),
            tangential_restitution: tangential_restitution.max(0.0),
            spin: if outcome.spin == 0.0 { 0.0 } else { spin * rolling },
            ..*outcome
        };
        (cell, middle)
    }

    /// The impact of the first contact with a wall.
    pub fn impact(&self, model: &Model) -> Option<Impact> {
        let first = self.first.lock().unwrap_or_else(PoisonError::into_inner);
        let surface = *first.end.as_ref().ok()?;
        first.tracker.contact(surface, model).ok()?.map(|contact| contact.impact)
    }
}

impl<'a> Node<'a> {
    /// Flies a particle to its next contact.
    fn flown(mut tracker: Tracker<'a>) -> Self {
        let end = tracker.fly();
        Self { tracker, end, next: HashMap::new() }
    }
}
