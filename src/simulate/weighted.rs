//! Expected hits: a particle that a wall catches with a probability flies on with the rest of its weight.
//!
//! [`crate::simulate::run`] decides every capture by a random number. For an expectation that is noise, and it makes the result jump
//! where a parameter changes. Here a hit with the probability `p` catches the share `p` of what is left of the particle, and `1 - p` flies
//! on, until almost nothing is left. The path up to the first contact does not depend on the model, so it is computed once
//! ([`first_contact`]) for all models that are compared.

use nalgebra::Vector3;

use super::case::Case;
use super::near_wall::StayTimes;
use super::trajectory::{Fate, Tracker};
use crate::impact::{Impact, ImpactError, Outcome};
use crate::model::Model;

/// A share of a particle below this is not followed further [1].
const LEAST_SHARE: f64 = 1e-3;

/// A particle at its first contact with a surface, or the end of one that reaches none.
#[derive(Debug, Clone)]
pub struct FirstContact<'a> {
    tracker: Tracker<'a>,
    /// Mass at the start [kg].
    pub mass: f64,
    /// Index of the surface.
    end: Result<usize, Fate>,
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

/// Flies the particle with this number to its first contact.
///
/// # Errors
/// Why it cannot be followed.
pub fn first_contact(case: &Case, number: u64) -> Result<FirstContact<'_>, String> {
    let (mut tracker, trouble) = Tracker::start(case, None, number, StayTimes::default());
    if let Some(trouble) = trouble {
        return Err(trouble);
    }
    let mass = tracker.mass();
    let end = tracker.fly();
    if let Err(Fate::Unusable(reason)) = &end {
        return Err(reason.clone());
    }
    Ok(FirstContact { tracker, mass, end })
}

impl FirstContact<'_> {
    /// Follows the particle from here under a model, and hands over each of its hits.
    ///
    /// # Errors
    /// [`ImpactError`] when the model cannot decide a hit.
    pub fn follow(
        &self,
        model: &Model,
        mut observer: impl FnMut(&ExpectedHit<'_>),
    ) -> Result<(), ImpactError> {
        let Ok(mut surface) = self.end else { return Ok(()) };
        let mut tracker = self.tracker.clone();
        let mut share = 1.0;
        for before in 0..tracker.case.hit_limit {
            let Some(contact) = tracker.contact(surface, model)? else { return Ok(()) };
            let outcome = model.resolve(contact.wall, &contact.impact, tracker.random(before))?;
            let (position, impact) = (contact.position, &contact.impact);
            let (weight, mass) = (tracker.weight, tracker.mass());
            observer(&ExpectedHit { surface, position, impact, outcome: &outcome, share, weight, mass });
            share *= 1.0 - outcome.sticking_probability;
            if share < LEAST_SHARE || !tracker.rebound(&contact, &outcome) {
                return Ok(());
            }
            let Ok(next) = tracker.fly() else { return Ok(()) };
            surface = next;
        }
        Ok(())
    }

    /// The impact of the first contact with a wall.
    pub fn impact(&self, model: &Model) -> Option<Impact> {
        let surface = *self.end.as_ref().ok()?;
        self.tracker.contact(surface, model).ok()?.map(|contact| contact.impact)
    }

    /// Number of real particles that it represents.
    pub fn weight(&self) -> f64 {
        self.tracker.weight
    }
}
