//! What is demanded of many diagnoses at once.

use statrs::distribution::{Binomial, DiscreteCDF};

/// A stated 95 % interval and the true value.
#[derive(Clone, Debug)]
pub struct Interval {
    pub parameter: String,
    pub truth: f64,
    pub low: f64,
    pub high: f64,
}

impl Interval {
    /// Whether the interval covers the truth.
    pub fn holds(&self) -> bool {
        (self.low..=self.high).contains(&self.truth)
    }
}

/// Probability of at most `successes` of `tries` at this true rate.
pub fn at_most(successes: usize, tries: usize, rate: f64) -> f64 {
    Binomial::new(rate, tries as u64).unwrap().cdf(successes as u64)
}

/// Fails only if a true rate this high would show so few successes less than once in a thousand runs.
pub fn require(what: &str, successes: usize, tries: usize, rate: f64) -> Result<(), String> {
    let chance = at_most(successes, tries, rate);
    let line = format!(
        "{what}: {successes} of {tries}; at a true {:.0} % this few comes with p = {chance:.1e}",
        100.0 * rate
    );
    println!("{line}");
    if tries > 0 && chance < 1e-3 { Err(line) } else { Ok(()) }
}
