//! The `[deposit]` of a case: the duration of the feed, its steps, and the bins of a wall.

use std::ops::Range;

use super::geometry::{required_within, whole};
use super::surface::{Surface, SurfaceKind};
use nearwall::input::{InputError, Section};

/// Largest number of states that are kept of one wall.
const MOST_STATES: u64 = 1_000_000;

/// A `[deposit]` table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DepositSettings {
    /// Duration of the feed [s].
    pub duration: f64,
    /// Number of its steps.
    pub steps: u64,
    /// Share of voids in the powder [1].
    pub voidage: f64,
    /// Number of bins of each wall.
    pub bins: usize,
}

impl DepositSettings {
    pub(super) fn read(section: &Section<'_>, surfaces: &[Surface]) -> Result<Self, InputError> {
        let endless = |s: &&Surface| matches!(s.kind, SurfaceKind::Wall { .. }) && s.shape.extent().is_none();
        if let Some(wall) = surfaces.iter().find(endless) {
            let problem = format!("the wall `{}` has no end, so no area; give it a radius", wall.name);
            return Err(section.fault("duration", problem));
        }
        let settings = Self {
            duration: required_within(section, "duration", f64::MIN_POSITIVE, f64::INFINITY)?,
            steps: whole(section, "steps", 1e6)?.unwrap_or(100).max(1),
            voidage: section.number_within("voidage", 0.0, 0.99)?.unwrap_or(0.5),
            bins: whole(section, "bins", 1e4)?.unwrap_or(10).max(1) as usize,
        };
        section.finish()?;
        if settings.steps.saturating_mul(settings.bins as u64) > MOST_STATES {
            let problem = format!("`steps` times `bins` is more than {MOST_STATES}, which no table can show");
            return Err(section.fault("steps", problem));
        }
        Ok(settings)
    }

    /// Time [s] at which particle number `own` of `count` is released.
    pub(super) fn release(&self, own: u64, count: u64) -> f64 {
        self.duration * (own as f64 + 0.5) / count as f64
    }

    /// The particles of `count` that are released in a step.
    pub(super) fn released(&self, step: u64, count: u64) -> Range<u64> {
        // Those released before the time of the step: own + 1/2 <= count step/steps.
        let [count, steps] = [count, self.steps].map(u128::from);
        let before = |step: u64| ((2 * count * u128::from(step) + steps) / (2 * steps)) as u64;
        before(step)..before(step + 1)
    }

    /// Length of a step [s].
    pub(super) fn step(&self) -> f64 {
        self.duration / self.steps as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_particle_is_released_once_and_in_the_step_of_its_time() {
        for (count, steps) in [(1, 1), (7, 3), (3, 7), (100, 10), (1001, 17)] {
            let settings = DepositSettings { duration: 5.0, steps, voidage: 0.5, bins: 1 };
            let mut next = 0;
            for step in 0..steps {
                for own in settings.released(step, count) {
                    assert_eq!(own, next);
                    next += 1;
                    let time = settings.release(own, count) / settings.step();
                    assert!(
                        (step as f64 - 1e-9..=step as f64 + 1.0 + 1e-9).contains(&time),
                        "{count} {steps} {own}"
                    );
                }
            }
            assert_eq!(next, count);
        }
    }
}
