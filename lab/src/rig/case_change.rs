//! What a wrong number of the case changes about the readings of an experiment.
//!
//! The case is simulated with the base law at a few places of the number, with the same random
//! numbers. Between them the change of a reading is interpolated by cubic curves that do not
//! overshoot (Fritsch and Carlson 1980, with the slopes of Fritsch and Butland 1984). In a gas with random motion all
//! places together tell a smooth one ([`NoisyChange`]).

use super::noisy_change::{NoisyChange, NoisyPlace};
use super::tally::{PredictedReading, away_from_edges};

/// Places of the number, in its standard errors: within three the instrument errs.
pub(super) const NEAR: [f64; 2] = [-3.0, 3.0];
/// Beyond it is a mistake.
pub(super) const FAR: [f64; 4] = [-10.0, -6.0, 6.0, 10.0];
/// Place of a force that the case leaves out, without which it is at 0.
pub const PRESENT: f64 = 1.0;
/// The farthest of them.
pub const FARTHEST: f64 = 10.0;

/// The places that tell what a number changes from the least to the largest of these standard errors: up to the first
/// beyond each.
pub(super) fn places_over([least, most]: [f64; 2]) -> Vec<f64> {
    let all = || NEAR.into_iter().chain(FAR);
    let is_needed = |place: &f64| {
        let inner = all().map(f64::abs).filter(|one| *one < place.abs()).fold(0.0, f64::max);
        NEAR.contains(place) || inner < if *place < 0.0 { -least } else { most }
    };
    all().filter(is_needed).collect()
}

/// Predictions of all readings at a place of a number [standard errors].
pub(super) type Moved = (f64, Vec<PredictedReading>);

/// The changes of all readings of one experiment at places of a number.
#[derive(Debug, Clone, Default)]
pub struct CaseChanges {
    /// Ascending, with 0 [standard errors].
    at: Vec<f64>,
    /// By place and reading: the change, of a share in log odds.
    changes: Vec<Vec<f64>>,
    /// By reading: its changes with their noise at the places other than 0 at which it exists.
    noisy: Vec<Vec<NoisyPlace>>,
    /// By reading: the curve through these; none without noise.
    smooth: Vec<Option<NoisyChange>>,
}

impl CaseChanges {
    /// Adds further places, from the predictions at the case's own number and there. A reading
    /// that does not exist at a place, as a rebound where all are caught, changes no further.
    pub(super) fn add(&mut self, shares: &[bool], base: &[PredictedReading], moved: &[Moved]) {
        let of = |(at, predicted): &Moved| -> Vec<NoisyPlace> {
            let change = |((share, from), to): ((&bool, &PredictedReading), &PredictedReading)| {
                let change = scale(*share, to.value) - scale(*share, from.value);
                let slope = slope(*share, 0.5 * (from.value + to.value));
                let blocks = std::array::from_fn(|block| (to.blocks[block] - from.blocks[block]) / slope);
                NoisyPlace { at: *at, change, blocks }
            };
            shares.iter().zip(base).zip(predicted).map(change).collect()
        };
        if self.at.is_empty() {
            (self.at, self.changes) = (vec![0.0], vec![vec![0.0; shares.len()]]);
            self.noisy = vec![Vec::new(); shares.len()];
        }
        let known = std::mem::take(&mut self.at).into_iter().zip(std::mem::take(&mut self.changes));
        let mut all: Vec<(f64, Vec<f64>)> = known.collect();
        for place in moved {
            let found = of(place);
            let exists = found.iter().zip(&mut self.noisy).filter(|(one, _)| one.change.is_finite());
            exists.for_each(|(one, known)| known.push(*one));
            all.push((place.0, found.iter().map(|one| one.change).collect()));
        }
        self.smooth = self.noisy.iter().map(|places| NoisyChange::new(places)).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (at, mut changes): (Vec<f64>, Vec<Vec<f64>>) = all.into_iter().unzip();
        let middle = at.iter().position(|widths| *widths == 0.0).unwrap_or(0);
        let outwards = (middle + 1..at.len()).map(|place| (place, place - 1));
        let inwards = (0..middle).rev().map(|place| (place, place + 1));
        for (place, before) in outwards.chain(inwards) {
            let known = changes[before].clone();
            for (one, known) in changes[place].iter_mut().zip(known).filter(|(one, _)| !one.is_finite()) {
                *one = known;
            }
        }
        (self.at, self.changes) = (at, changes);
    }

    /// The change of every reading with the number moved by so many standard errors, and its variance; in proportion to
    /// them beyond the places.
    pub fn at(&self, widths: f64) -> Vec<[f64; 2]> {
        if let [first, _, .., last] = self.at[..]
            && !(first..=last).contains(&widths)
        {
            let end = widths.clamp(first, last);
            let farther = widths / end;
            let of = |[change, variance]: [f64; 2]| [change * farther, variance * farther * farther];
            return self.at(end).into_iter().map(of).collect();
        }
        let count = self.at.len();
        if count < 2 {
            return vec![[0.0; 2]; self.smooth.len()];
        }
        let after = self.at.partition_point(|place| *place <= widths).clamp(1, count - 1);
        let (low, step) = (after - 1, self.at[after] - self.at[after - 1]);
        let share = ((widths - self.at[low]) / step).clamp(0.0, 1.0);
        let one = |reading: usize| {
            if let Some(smooth) = &self.smooth[reading] {
                return smooth.at(widths);
            }
            let [from, to] = [low, after].map(|place| self.changes[place][reading]);
            let slopes = [self.slope(low, reading), self.slope(after, reading)];
            let rest = 1.0 - share;
            let change = from * (1.0 + 2.0 * share) * rest * rest
                + to * (3.0 - 2.0 * share) * share * share
                + step * share * rest * (slopes[0] * rest - slopes[1] * share);
            [change, 0.0]
        };
        (0..self.changes[low].len()).map(one).collect()
    }

    /// Slope at a place: the weighted harmonic mean of those beside it, none at an extreme, and at an
    /// end that of the last part.
    fn slope(&self, place: usize, reading: usize) -> f64 {
        let part = |low: usize| {
            let step = self.at[low + 1] - self.at[low];
            (step, (self.changes[low + 1][reading] - self.changes[low][reading]) / step)
        };
        if place == 0 {
            return part(0).1;
        }
        if place + 1 == self.at.len() {
            return part(place - 1).1;
        }
        let [(h1, d1), (h2, d2)] = [part(place - 1), part(place)];
        if d1 * d2 <= 0.0 {
            return 0.0;
        }
        let [w1, w2] = [2.0 * h2 + h1, h2 + 2.0 * h1];
        (w1 + w2) / (w1 / d1 + w2 / d2)
    }
}

/// The scale on which changes of a reading add: of a share its log odds.
fn scale(is_share: bool, value: f64) -> f64 {
    if !is_share {
        return value;
    }
    let p = away_from_edges(value);
    (p / (1.0 - p)).ln()
}

/// How much a value changes with that scale.
pub fn slope(is_share: bool, value: f64) -> f64 {
    let p = away_from_edges(value);
    if is_share { p * (1.0 - p) } else { 1.0 }
}

/// A predicted value with such a change.
pub fn changed(is_share: bool, value: f64, change: f64) -> f64 {
    if !is_share {
        return value + change;
    }
    // Where nothing changes an edge stays what it is.
    if change == 0.0 { value } else { 1.0 / (1.0 + (-(scale(true, value) + change)).exp()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::BLOCKS;

    #[test]
    fn places_lie_around_a_range() {
        assert_eq!(places_over([-1.0, 2.0]), [-3.0, 3.0]);
        assert_eq!(places_over([-1.0, 4.0]), [-3.0, 3.0, 6.0]);
        assert_eq!(places_over([-7.0, 0.0]), [-3.0, 3.0, -10.0, -6.0]);
    }

    fn reading(value: f64) -> PredictedReading {
        PredictedReading { value, variance: 0.0, doubt: 0.0, particles: 100.0, blocks: [0.0; BLOCKS] }
    }

    /// A straight line stays one, the places are met, and what does not exist keeps the last change.
    #[test]
    fn changes_are_interpolated() {
        let at = |widths: f64| {
            vec![reading(0.5 + 0.02 * widths), reading(if widths < -4.0 { f64::NAN } else { 0.3 })]
        };
        let mut changes = CaseChanges::default();
        for places in [&NEAR[..], &FAR[..]] {
            let moved: Vec<Moved> = places.iter().map(|widths| (*widths, at(*widths))).collect();
            changes.add(&[false, true], &at(0.0), &moved);
            for widths in [-10.0, -4.5, 0.0, 1.0, 7.0] {
                let found = changes.at(widths);
                assert!((found[0][0] - 0.02 * widths).abs() < 1e-12, "{widths} {found:?}");
                assert_eq!(found[1], [0.0; 2]);
            }
        }
        let share = changed(true, 0.3, 1.0);
        assert!((share / (1.0 - share) - std::f64::consts::E * 0.3 / 0.7).abs() < 1e-12);
    }
}
