//! Impacts drawn as a set's printed ranges allow. The paper prints ranges, a mean angle and most
//! probable sizes, no distributions: two assumptions stand side by side, so that a reader sees what
//! they are worth.

use crate::Result;
use nearwall::{Impact, ImpactRng};

use super::published::{FIGURE_TEMPERATURES, Set};

/// How impacts lie within the printed ranges. Both are assumed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spread {
    /// `v_n` evenly; angle exponential between its ends; size a triangle with the printed peak.
    Even,
    /// `v_n` evenly in its logarithm, so slower; angle a power of an even number; size evenly.
    Slow,
}

impl Spread {
    /// Both, with their names.
    pub const ALL: [(Self, &'static str); 2] = [(Self::Even, "v_n even"), (Self::Slow, "v_n log-even")];
}

/// Draws impacts of one set.
#[derive(Debug, Clone, Copy)]
pub struct Sampler {
    set: Set,
    spread: Spread,
    /// What makes the mean angle come out.
    lean: f64,
}

/// First stream of the draws of an impact; the effects' own lie below.
const STREAM: u64 = 100;
/// Streams of one attempt.
const ATTEMPT: u64 = 4;
/// Impacts that the mean angle is set with.
const TRIAL: u64 = 1000;

impl Sampler {
    /// A sampler whose mean angle, after impacts outside the printed `v_t` are thrown away, is the printed one.
    pub fn new(set: Set, spread: Spread) -> Result<Self> {
        let with = |lean| Self { set, spread, lean };
        let mean = |lean| {
            let sampler = with(lean);
            let angles = (0..TRIAL).map(|key| angle(&sampler.impact(ImpactRng::new(0, key))));
            angles.sum::<f64>() / TRIAL as f64
        };
        let (mut low, mut high) = match spread {
            Spread::Even => (-30.0, 30.0),
            Spread::Slow => (-4.0, 4.0),
        };
        for _ in 0..16 {
            let middle = 0.5 * (low + high);
            if mean(middle) < set.angle[1] { low = middle } else { high = middle }
        }
        let sampler = with(0.5 * (low + high));
        let off = (mean(sampler.lean) - set.angle[1]).abs();
        if off > 0.5 {
            return Err(format!("{}: no such mean angle, {off}° off", set.name()).into());
        }
        Ok(sampler)
    }

    /// The set.
    pub fn set(&self) -> &Set {
        &self.set
    }

    /// An impact at the paper's temperatures.
    pub fn impact(&self, draw: ImpactRng) -> Impact {
        let attempt = |round: u64| self.attempt(|place| draw.uniform(STREAM + ATTEMPT * round + place));
        let [low, high] = self.set.along;
        let fits = |impact: &Impact| (low..=high).contains(&impact.tangential_speed);
        (0..).map(attempt).take(400).find(fits).unwrap_or_else(|| attempt(0))
    }

    fn attempt(&self, uniform: impl Fn(u64) -> f64) -> Impact {
        let Set { normal: [slow, fast], angle: [least, _, largest], .. } = self.set;
        let (speed, lean) = (uniform(0), uniform(1));
        let (normal_speed, share) = match self.spread {
            Spread::Even => (slow + speed * (fast - slow), exponential(lean, self.lean)),
            Spread::Slow => (slow * (fast / slow).powf(speed), lean.powf((-self.lean).exp())),
        };
        let angle = (least + share * (largest - least)).to_radians();
        Impact {
            normal_speed,
            tangential_speed: normal_speed * angle.tan(),
            diameter: 1e-6 * self.size(uniform(2)),
            particle_temperature: FIGURE_TEMPERATURES[0],
            wall_temperature: FIGURE_TEMPERATURES[1],
            ..Impact::default()
        }
    }

    fn size(&self, uniform: f64) -> f64 {
        let [small, peak, large] = self.set.size;
        if self.spread == Spread::Slow {
            return small + uniform * (large - small);
        }
        let below = (peak - small) / (large - small);
        if uniform < below {
            small + ((large - small) * (peak - small) * uniform).sqrt()
        } else {
            large - ((large - small) * (large - peak) * (1.0 - uniform)).sqrt()
        }
    }
}

/// Angle from the normal [degrees].
pub fn angle(impact: &Impact) -> f64 {
    90.0 - impact.angle_from_surface().to_degrees()
}

/// A number of 0 to 1 with a density that goes with `exp(lean x)`, from an even one.
fn exponential(uniform: f64, lean: f64) -> f64 {
    if lean.abs() < 1e-9 { uniform } else { (uniform * lean.exp_m1()).ln_1p() / lean }
}

#[cfg(test)]
mod tests {
    use super::super::published::SETS;
    use super::*;

    #[test]
    fn impacts_lie_in_the_printed_ranges_with_the_printed_mean_angle() {
        for (set, (spread, name)) in SETS.iter().flat_map(|set| Spread::ALL.map(|spread| (set, spread))) {
            let sampler = Sampler::new(*set, spread).unwrap();
            let impacts: Vec<Impact> = (0..2000).map(|key| sampler.impact(ImpactRng::new(5, key))).collect();
            let inside =
                |value: f64, [low, high]: [f64; 2]| (low * 0.999999..=high * 1.000001).contains(&value);
            for impact in &impacts {
                assert!(inside(impact.normal_speed, set.normal), "{name}: {impact:?}");
                assert!(inside(impact.tangential_speed, set.along), "{name}: {impact:?}");
                assert!(inside(angle(impact), [set.angle[0], set.angle[2]]), "{name}: {impact:?}");
            }
            let mean = impacts.iter().map(angle).sum::<f64>() / impacts.len() as f64;
            assert!((mean - set.angle[1]).abs() < 2.0, "seed 5, {} {name}: {mean}", set.name());
        }
    }
}
