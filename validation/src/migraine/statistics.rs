//! Intervals of counts, and quantiles.

use crate::Result;
use statrs::distribution::{Beta, ContinuousCDF};

/// Clopper and Pearson's interval of a probability [1] after `hits` of `trials`: each end leaves `tail` outside.
pub fn binomial(hits: usize, trials: usize, tail: f64) -> Result<[f64; 2]> {
    let (hits, misses) = (hits as f64, (trials - hits) as f64);
    let low = if hits > 0.0 { Beta::new(hits, misses + 1.0)?.inverse_cdf(tail) } else { 0.0 };
    let high = if misses > 0.0 { Beta::new(hits + 1.0, misses)?.inverse_cdf(1.0 - tail) } else { 1.0 };
    Ok([low, high])
}

/// The value below which this share of the numbers lies; no number for none.
pub fn quantile(numbers: &[f64], share: f64) -> f64 {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    let place = (share * sorted.len() as f64).floor() as usize;
    sorted.get(place.min(sorted.len().saturating_sub(1))).copied().unwrap_or(f64::NAN)
}

/// Arithmetic mean; no number for none.
pub fn mean(numbers: &[f64]) -> f64 {
    numbers.iter().sum::<f64>() / numbers.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All of n: the lower end solves p^n = tail; none of n: the upper end solves (1-p)^n = tail.
    #[test]
    fn the_ends_solve_their_equations() {
        let [low, high] = binomial(13, 13, 0.05).unwrap();
        assert!((low - 0.05f64.powf(1.0 / 13.0)).abs() < 1e-9 && high == 1.0);
        let [low, high] = binomial(0, 41, 0.05).unwrap();
        assert!((high - (1.0 - 0.05f64.powf(1.0 / 41.0))).abs() < 1e-9 && low == 0.0);
        // 1 of 2 with 0.25 outside at each end: P(X >= 1) = 1 - (1-p)² = 0.25.
        assert!((binomial(1, 2, 0.25).unwrap()[0] - (1.0 - 0.75f64.sqrt())).abs() < 1e-6);
    }
}
