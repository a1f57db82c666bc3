//! How often chance alone gains as much as a candidate, corrected for all candidates and all their places.
//!
//! Data sets are drawn from the base model, with the noise of the readings. In each,
//! the largest gain of any candidate at any place is found, exactly as in the measured data. The
//! share of data sets in which it reaches that of a candidate is the candidate's corrected p-value
//! (the max-T test of Westfall and Young); beyond the largest drawn gains the tail is continued as
//! an exponential.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rayon::prelude::*;

use super::noise::Data;
use super::prediction_table::{PredictionTable, TabledCandidate};

/// Data sets drawn.
const DRAWN: u64 = 200;
/// Share of the largest drawn gains that shape the tail.
const TAIL: usize = 10;

/// Largest gains of data sets without an effect, ascending [nats].
#[derive(Debug)]
pub(super) struct NullGains(Vec<f64>);

impl NullGains {
    pub fn new(table: &PredictionTable, data: &Data, weights: &[f64], seed: u64) -> Self {
        let scatter = data.scatter(&table.base, weights);
        let one = |number: u64| {
            let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x006e_756c);
            random.set_stream(number);
            let values = data.draw(&table.base, &scatter, &mut random);
            let base = data.score(&table.base_prepared, &values, weights);
            let weighted = data.weighted(&values, weights);
            let gain =
                |candidate: &TabledCandidate| candidate.best(data, &weighted) - base - candidate.cost();
            table.candidates.iter().map(gain).fold(f64::NEG_INFINITY, f64::max)
        };
        let mut gains: Vec<f64> = (0..DRAWN).into_par_iter().map(one).collect();
        gains.sort_by(f64::total_cmp);
        Self(gains)
    }

    /// Probability of a gain at least as large without an effect.
    pub fn p_value(&self, gain: f64) -> f64 {
        let count = self.0.len();
        let reached = count - self.0.partition_point(|one| *one < gain);
        let tail = &self.0[count - count / TAIL..];
        let (Some(start), true) = (tail.first(), reached < count / TAIL) else {
            return reached as f64 / count as f64;
        };
        let mean = tail.iter().map(|one| one - start).sum::<f64>() / tail.len() as f64;
        // Twice a gain is a chi-square: its tail falls at least by e in a nat.
        (1.0 / TAIL as f64) * (-(gain - start) / mean.max(1.0)).exp()
    }
}
