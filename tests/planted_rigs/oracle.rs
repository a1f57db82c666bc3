//! What can be known: a test of the true effect's amplitude, among thirty candidates.

use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use crate::lab::{Errors, Experiment, FLOOR, Reading};

/// Deviations at which one of thirty candidates may be named.
const CRITICAL: f64 = 3.4;

/// The oracle's answer.
#[derive(Clone, Copy, Debug)]
pub struct Oracle {
    /// Deviations of the amplitude that these readings show.
    pub seen: f64,
    /// Deviations that are expected.
    pub expected: f64,
    /// Whether it notices the effect.
    pub notices: bool,
}

impl Oracle {
    /// The likelihood of the true effect's best amplitude against that of none.
    pub fn of(experiments: &[Experiment], errors: Errors) -> Self {
        let readings: Vec<Reading> = experiments.iter().flat_map(|one| one.readings.clone()).collect();
        let truth: Vec<Reading> =
            readings.iter().map(|reading| Reading { value: reading.truth, ..*reading }).collect();
        let (seen, expected) = (amplitude(&readings), amplitude(&truth));
        if errors != Errors::Absent || expected < 1e-6 {
            return Self { seen, expected, notices: seen > CRITICAL };
        }
        let (seen, freedom) = scattered(&readings);
        let level = Normal::standard().cdf(CRITICAL);
        let critical = StudentsT::new(0.0, 1.0, freedom).unwrap().inverse_cdf(level);
        Self { seen, expected, notices: seen > critical }
    }
}

/// Root of twice the gain in log-likelihood of the best amplitude.
fn amplitude(readings: &[Reading]) -> f64 {
    let of = |share: f64| readings.iter().map(|reading| likelihood(reading, share)).sum::<f64>();
    let none = of(0.0);
    let best = (0..=80).map(|step| of(f64::from(step) / 40.0)).fold(none, f64::max);
    (2.0 * (best - none)).sqrt()
}

/// Log-likelihood of a reading with this share of the effect.
fn likelihood(reading: &Reading, share: f64) -> f64 {
    let expected = reading.base + share * (reading.truth - reading.base);
    match reading.count {
        Some(count) => {
            let p = expected.clamp(FLOOR, 1.0 - FLOOR);
            count * (reading.value * p.ln() + (1.0 - reading.value) * (1.0 - p).ln())
        }
        None => -((reading.value - expected) / reading.sigma).powi(2) / 2.0,
    }
}

/// Student's t of the amplitude where only the scatter tells the errors, and its degrees of freedom.
fn scattered(readings: &[Reading]) -> (f64, f64) {
    let (mut shape, mut product, mut square) = (0.0, 0.0, 0.0);
    for Reading { base, truth, value, sigma, .. } in readings {
        let (change, residual) = ((truth - base) / sigma, (value - base) / sigma);
        shape += change * change;
        product += change * residual;
        square += residual * residual;
    }
    let (freedom, t) = (readings.len() as f64 - 1.0, product / shape.sqrt());
    (t / ((square - t * t).max(1e-12) / freedom).sqrt(), freedom)
}
