//! Sums over weighted hits: the observables of a rig with their Monte Carlo error.
//!
//! Every observable but a quantile is a ratio of two sums over particles, `sum a / sum b`. Its
//! Monte Carlo variance is that of the ratio estimator, `n/(n-1) sum (a - r b)² / (sum b)²`, since
//! particles are independent. A quantile is that of the weighted values; its variance is `q (1 - q)
//! / (n f²)`, with the density `f` from the values around it.

use crate::dataset::{Restitution, RigQuantity, RigReading};
use crate::simulate::BLOCKS;
use nearwall::impact::{Impact, Outcome};

/// Half the width in probability of the interval from which the density at a quantile is taken [1].
const QUANTILE_WINDOW: f64 = 0.1;

/// Standard deviation of what is doubtful, as a share of it [1]; assumed.
const DOUBTFUL_DEVIATION: f64 = 0.5;

/// A predicted reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PredictedReading {
    /// The value [1]; NaN where nothing happens that could be measured, as no rebound.
    pub value: f64,
    /// Its Monte Carlo variance [1].
    pub variance: f64,
    /// Variance of what is not known of this prediction [1]: what a replay cannot know ([`Tally::set_doubt`]), and the
    /// noise of a difference in a gas with random motion.
    pub doubt: f64,
    /// Number of particles on which it rests.
    pub particles: f64,
    /// How far each block of particles moves the value [1]: their squares add up to the variance; 0 without blocks.
    pub blocks: [f64; BLOCKS],
}

/// Distance that a predicted share keeps from 0 and 1 [1]: a stray particle must not refute a law.
const SHARE_MARGIN: f64 = 0.003;

/// A predicted share away from 0 and 1.
pub(crate) fn away_from_edges(share: f64) -> f64 {
    share.clamp(SHARE_MARGIN, 1.0 - SHARE_MARGIN)
}

impl PredictedReading {
    /// This better known value with the difference between two predictions for the same particles.
    /// Its variance stays; that of the difference is doubt.
    pub fn moved(&self, from: &Self, to: &Self) -> Self {
        let value = self.value + (to.value - from.value);
        let doubt = self.doubt + from.variance_of_difference(to);
        if value.is_finite() { Self { value, doubt, ..*self } } else { *to }
    }

    /// Variance of the difference from a prediction for the same blocks of particles [1].
    pub(super) fn variance_of_difference(&self, other: &Self) -> f64 {
        self.blocks.iter().zip(&other.blocks).map(|(one, other)| (one - other).powi(2)).sum()
    }
}

/// A hit as the tally takes it.
#[derive(Debug, Clone, Copy)]
pub struct TalliedHit<'a> {
    /// The place of the wall in the list that the tally was made with.
    pub wall: usize,
    /// Coordinate along the wall [m].
    pub coordinate: f64,
    /// The impact.
    pub impact: &'a Impact,
    /// Its outcome if nothing catches the particle.
    pub outcome: &'a Outcome,
    /// Share of the particle that arrives [1].
    pub share: f64,
    /// Share of what arrives that the wall catches [1].
    pub caught: f64,
    /// Number of real particles that the whole particle represents.
    pub weight: f64,
    /// Their mass [kg].
    pub mass: f64,
}

/// A ratio of sums over particles.
#[derive(Debug, Clone, Default)]
struct Ratio {
    /// The sums of each block.
    blocks: Vec<[f64; 2]>,
    particles: f64,
    sums: [f64; 2],
    /// Sums of `a²`, `a b` and `b²`.
    squares: [f64; 3],
}

impl Ratio {
    fn add(&mut self, [a, b]: [f64; 2]) {
        self.particles += f64::from(u8::from(b > 0.0));
        self.sums[0] += a;
        self.sums[1] += b;
        self.squares[0] += a * a;
        self.squares[1] += a * b;
        self.squares[2] += b * b;
    }

    fn predicted(&self) -> PredictedReading {
        let [a, b] = self.sums;
        let (particles, ratio) = (self.particles, a / b);
        let [aa, ab, bb] = self.squares;
        let scatter = (aa - 2.0 * ratio * ab + ratio * ratio * bb).max(0.0) / (b * b);
        let small = particles / (particles - 1.0).max(1.0);
        let mut blocks = [0.0; BLOCKS];
        for (moved, [a, b]) in blocks.iter_mut().zip(&self.blocks) {
            *moved = (a - ratio * b) / self.sums[1] * small.sqrt();
        }
        PredictedReading { value: ratio, variance: scatter * small, doubt: 0.0, particles, blocks }
    }
}

/// What one reading needs.
#[derive(Debug)]
struct ReadingSums {
    quantity: RigQuantity,
    wall: usize,
    ratio: Ratio,
    /// Sums of the present particle.
    own: [f64; 2],
    /// Whether the present particle has hit the wall.
    arrived: bool,
    /// Values and weights, for a quantile.
    values: Vec<(f64, f64)>,
    /// Sum of what is doubtful in the numerator of the ratio.
    doubtful: f64,
}

/// Sums for the readings of one experiment.
#[derive(Debug)]
pub struct Tally {
    lines: Vec<ReadingSums>,
    /// Share of the next hits that is doubtful [1].
    doubt: f64,
}

impl Tally {
    /// Sums for these readings; `walls` are the names to which [`TalliedHit::wall`] refers. A wall
    /// that is not among them is never hit.
    pub fn new(readings: &[RigReading], walls: &[String]) -> Self {
        let line = |reading: &RigReading| ReadingSums {
            quantity: reading.quantity,
            wall: walls.iter().position(|wall| *wall == reading.wall).unwrap_or(usize::MAX),
            ratio: Ratio::default(),
            own: [0.0; 2],
            arrived: false,
            values: Vec::new(),
            doubtful: 0.0,
        };
        Self { lines: readings.iter().map(line).collect(), doubt: 0.0 }
    }

    /// Adds a hit of the present particle.
    pub fn hit(&mut self, hit: &TalliedHit<'_>) {
        for line in self.lines.iter_mut().filter(|line| line.wall == hit.wall) {
            let before = line.own[0];
            line.hit(hit);
            line.doubtful += self.doubt * (line.own[0] - before);
        }
    }

    /// Of the next hits, this share may happen elsewhere or not at all [1]: a systematic error, of
    /// which half counts as a standard deviation (assumed): the doubt of what is a ratio, not of
    /// quantiles.
    pub fn set_doubt(&mut self, share: f64) {
        self.doubt = share;
    }

    /// Ends the present particle, whose mass at the start is `injected` [kg]. It is independent of all others.
    pub fn end_particle(&mut self, injected: f64) {
        self.end_particle_of_block(injected);
        for line in &mut self.lines {
            line.ratio.add(std::mem::take(&mut line.own));
        }
    }

    /// Ends the present particle; only its block as a whole is independent of others.
    pub fn end_particle_of_block(&mut self, injected: f64) {
        use RigQuantity::{Captured, CapturedAlong, CapturedBySize};
        for line in &mut self.lines {
            line.arrived = false;
            let by_mass = matches!(line.quantity, Captured | CapturedAlong(_) | CapturedBySize(_));
            line.own[1] += if by_mass { injected } else { 0.0 };
        }
    }

    /// Adds what another tally of the same readings has of its present block.
    pub fn add(&mut self, other: Self) {
        for (line, own) in self.lines.iter_mut().zip(other.lines) {
            line.own[0] += own.own[0];
            line.own[1] += own.own[1];
            line.values.extend(own.values);
        }
    }

    /// Ends a block of particles.
    pub fn end_block(&mut self) {
        for line in &mut self.lines {
            line.ratio.blocks.push(line.own);
            line.ratio.add(std::mem::take(&mut line.own));
        }
    }

    /// Ends this number of particles that hit no wall; `injected` is the mass of each at the start [kg].
    pub fn end_missed(&mut self, count: f64, injected: f64) {
        use RigQuantity::{Captured, CapturedAlong, CapturedBySize};
        let by_mass = |line: &&mut ReadingSums| {
            matches!(line.quantity, Captured | CapturedAlong(_) | CapturedBySize(_))
        };
        for line in self.lines.iter_mut().filter(by_mass) {
            line.ratio.particles += if injected > 0.0 { count } else { 0.0 };
            line.ratio.sums[1] += count * injected;
            line.ratio.squares[2] += count * injected * injected;
        }
    }

    /// The predictions, in the order of the readings.
    pub fn predicted(mut self) -> Vec<PredictedReading> {
        self.lines.iter_mut().map(ReadingSums::predicted).collect()
    }
}

impl ReadingSums {
    fn hit(&mut self, hit: &TalliedHit<'_>) {
        let caught = hit.share * hit.caught;
        let rebounds = hit.share * (1.0 - hit.caught) * hit.weight;
        let within = |value: f64, [low, high]: [f64; 2]| (low..high).contains(&value);
        let value = |which: Restitution| match which {
            Restitution::Normal => hit.outcome.normal_restitution,
            Restitution::Tangential => hit.outcome.tangential_restitution,
        };
        let mut add = |a: f64, b: f64| {
            self.own[0] += a;
            self.own[1] += b;
        };
        match self.quantity {
            RigQuantity::Captured => add(caught * hit.mass, 0.0),
            RigQuantity::CapturedAlong(range) if within(hit.coordinate, range) => add(caught * hit.mass, 0.0),
            RigQuantity::CapturedBySize(range) if within(hit.impact.diameter, range) => {
                add(caught * hit.mass, 0.0);
            }
            RigQuantity::CapturedAlong(_) | RigQuantity::CapturedBySize(_) => {}
            RigQuantity::CaptureEfficiency => {
                add(caught * hit.weight, if self.arrived { 0.0 } else { hit.share * hit.weight });
                self.arrived = true;
            }
            RigQuantity::Mean(which) => add(rebounds * value(which), rebounds),
            RigQuantity::ShareBelow(which, threshold) => {
                add(if value(which) < threshold { rebounds } else { 0.0 }, rebounds);
            }
            RigQuantity::MeanConversion => {
                add(caught * hit.mass * hit.impact.conversion, caught * hit.mass);
            }
            RigQuantity::Quantile(which, _) if rebounds > 0.0 => self.values.push((value(which), rebounds)),
            RigQuantity::Quantile(..) => {}
        }
    }

    fn predicted(&mut self) -> PredictedReading {
        let RigQuantity::Quantile(_, probability) = self.quantity else {
            let sampled = self.ratio.predicted();
            let doubt = if self.doubtful > 0.0 {
                DOUBTFUL_DEVIATION * self.doubtful / self.ratio.sums[1]
            } else {
                0.0
            };
            return PredictedReading { doubt: doubt * doubt, ..sampled };
        };
        self.values.sort_by(|a, b| a.0.total_cmp(&b.0));
        let total: f64 = self.values.iter().map(|(_, weight)| weight).sum();
        let quantile = |probability: f64| {
            let mut below = 0.0;
            let found = self.values.iter().find(|(_, weight)| {
                below += weight;
                below >= probability * total
            });
            found.or(self.values.last()).map_or(f64::NAN, |(value, _)| *value)
        };
        let [low, high] =
            [(probability - QUANTILE_WINDOW).max(0.0), (probability + QUANTILE_WINDOW).min(1.0)];
        let slope = (quantile(high) - quantile(low)) / (high - low);
        let particles = self.values.len() as f64;
        let variance = probability * (1.0 - probability) / particles.max(1.0) * slope * slope;
        let blocks = [0.0; BLOCKS];
        PredictedReading { value: quantile(probability), variance, doubt: 0.0, particles, blocks }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nearwall::impact::Regime;

    fn reading(column: &str) -> RigReading {
        let (name, wall) = column.split_once('@').unwrap();
        RigReading {
            line: 1,
            column: column.to_owned(),
            quantity: RigQuantity::parse(name).unwrap(),
            wall: wall.to_owned(),
            value: 0.0,
            error: None,
            count: None,
        }
    }

    fn rebound(normal_restitution: f64) -> Outcome {
        Outcome {
            normal_restitution,
            tangential_restitution: 0.0,
            sticking_probability: 0.0,
            stuck: false,
            spin: 0.0,
            regime: Regime::ALL[0],
            outside_range: false,
        }
    }

    /// Ten particles of mass 1 and 3 in turn: the first hit catches half, the rest rebounds with
    /// 0.1 i and is caught by the other wall.
    #[test]
    fn sums_are_those_counted_by_hand() {
        let readings = [
            "captured@a",
            "captured@b",
            "capture_efficiency@a",
            "mean_e_n@a",
            "share_e_n_below_0.45@a",
            "quantile_0.5_e_n@a",
            "captured_from_0_to_5@a",
            "captured_d_0_to_1e-5@a",
            "mean_conversion@b",
            "mean_e_n@b",
            "captured@nowhere",
        ]
        .map(reading);
        let mut tally = Tally::new(&readings, &["a".to_owned(), "b".to_owned()]);
        for particle in 0..10u8 {
            let mass = if particle % 2 == 0 { 1.0 } else { 3.0 };
            let impact =
                Impact { diameter: 1e-6, conversion: 0.1 * f64::from(particle), ..Impact::default() };
            let outcome = rebound(0.1 * f64::from(particle));
            let mut hit = TalliedHit {
                wall: 0,
                coordinate: f64::from(particle),
                impact: &impact,
                outcome: &outcome,
                share: 1.0,
                caught: 0.5,
                weight: 1.0,
                mass,
            };
            tally.hit(&hit);
            hit.wall = 1;
            hit.share = 0.5;
            hit.caught = 1.0;
            tally.hit(&hit);
            tally.end_particle(mass);
        }
        let value: Vec<f64> = tally.predicted().iter().map(|predicted| predicted.value).collect();
        let expected = [0.5, 0.5, 0.5, 0.45, 0.5, 0.4, 0.5 * 9.0 / 20.0, 0.5, 0.475];
        for (value, expected) in value.iter().zip(expected) {
            assert!((value - expected).abs() < 1e-12, "{value} {expected}");
        }
        assert!(value[9].is_nan() && value[10] == 0.0);
    }

    /// Four blocks of ten particles that catch 1, 2, 4 and 5 of them: the share is 0.3, its variance that of the
    /// mean of four numbers. A prediction with one more in each block differs without noise; one with the blocks in the
    /// reverse order differs by twice the distances.
    #[test]
    fn blocks_carry_the_variance() {
        let readings = [reading("captured@a")];
        let predicted = |caught: [u32; 4]| {
            let mut tally = Tally::new(&readings, &["a".to_owned()]);
            let (impact, outcome) = (Impact::default(), rebound(0.0));
            for caught in caught {
                for particle in 0..10 {
                    let caught = if particle < caught { 1.0 } else { 0.0 };
                    let (wall, coordinate, share, weight, mass) = (0, 0.0, 1.0, 1.0, 1.0);
                    let (impact, outcome) = (&impact, &outcome);
                    tally.hit(&TalliedHit { wall, coordinate, impact, outcome, share, caught, weight, mass });
                    tally.end_particle_of_block(1.0);
                }
                tally.end_block();
            }
            tally.predicted()[0]
        };
        let one = predicted([1, 2, 4, 5]);
        assert!((one.value - 0.3).abs() < 1e-12);
        // The squared distances from 0.3 add up to 0.1.
        assert!((one.variance - 0.1 / 3.0 / 4.0).abs() < 1e-12);
        assert!((one.blocks.iter().map(|part| part * part).sum::<f64>() - one.variance).abs() < 1e-12);
        assert!(one.variance_of_difference(&predicted([2, 3, 5, 6])) < 1e-12);
        let turned = predicted([5, 4, 2, 1]);
        assert!((one.variance_of_difference(&turned) - 4.0 * one.variance).abs() < 1e-12);
    }

    #[test]
    fn the_variance_of_a_share_is_binomial() {
        let readings = [reading("captured@a")];
        let mut tally = Tally::new(&readings, &["a".to_owned()]);
        let (impact, outcome) = (Impact::default(), rebound(0.0));
        for particle in 0..100 {
            let caught = if particle < 30 { 1.0 } else { 0.0 };
            let (wall, coordinate, share, weight, mass) = (0, 0.0, 1.0, 1.0, 2.0);
            tally.hit(&TalliedHit {
                wall,
                coordinate,
                impact: &impact,
                outcome: &outcome,
                share,
                caught,
                weight,
                mass,
            });
            tally.end_particle(2.0);
        }
        let PredictedReading { value, variance, particles, .. } = tally.predicted()[0];
        assert!((value - 0.3).abs() < 1e-12 && particles == 100.0);
        assert!((variance - 0.21 / 99.0).abs() < 1e-12);
    }
}
