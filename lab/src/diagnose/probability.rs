//! Probabilities of explanations from their evidence.
//!
//! Bayes' theorem over the explanations that the search visited, averaged over draws of the rows: in
//! each draw the rows' log likelihoods have independent random weights with mean 1 (Bayesian
//! bootstrap, Rubin 1981; averaged posterior, Huggins and Miller 2023). Where rows disagree about
//! two explanations more than the likelihood expects, as under a wrong law of the noise, the
//! probabilities become less extreme.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution as _, Gamma};

use super::explanation::{Evidence, Explanation};

/// Draws of the weights.
const DRAWS: usize = 400;
/// Inverse variance of the weight of a unit [1]: 1 is as many units drawn as there are, larger values
/// trust the likelihood more.
const TRUST: f64 = 3.0;

/// Probabilities of explanations, in their order.
#[derive(Debug, Clone)]
pub(super) struct Probabilities {
    /// Of each explanation [1].
    pub of: Vec<f64>,
    /// Share of the draws in which each explanation is the most likely one [1].
    pub first: Vec<f64>,
}

impl Probabilities {
    /// Of `explanations` on rows of which each belongs to a unit.
    pub fn new<F>(explanations: &[Explanation<F>], evidence: Evidence, units: &[usize]) -> Self {
        let sums: Vec<Vec<f64>> = explanations.iter().map(|one| by_unit(&one.scores, units)).collect();
        let fixed: Vec<f64> = explanations.iter().map(|one| evidence.of(one) - one.score()).collect();
        let count = sums.first().map_or(0, Vec::len);
        let mut random = ChaCha8Rng::seed_from_u64(0x7765_6967);
        let mut found = Self { of: vec![0.0; sums.len()], first: vec![0.0; sums.len()] };
        let Ok(law) = Gamma::new(TRUST, 1.0 / TRUST) else { return found };
        for _ in 0..DRAWS {
            let weights: Vec<f64> = (0..count).map(|_| law.sample(&mut random)).collect();
            let total = |(sums, fixed): (&Vec<f64>, &f64)| {
                sums.iter().zip(&weights).map(|(sum, weight)| sum * weight).sum::<f64>() + fixed
            };
            found.add(&sums.iter().zip(&fixed).map(total).collect::<Vec<f64>>());
        }
        found
    }

    /// Adds the probabilities of one draw from its log evidences [nats].
    fn add(&mut self, evidence: &[f64]) {
        let Some((best, most)) = evidence.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)) else {
            return;
        };
        let shares: Vec<f64> = evidence.iter().map(|one| (one - most).exp()).collect();
        let total: f64 = shares.iter().sum();
        self.of.iter_mut().zip(shares).for_each(|(sum, share)| *sum += share / total / DRAWS as f64);
        self.first[best] += 1.0 / DRAWS as f64;
    }
}

/// The sums of the scores of each unit.
fn by_unit(scores: &[f64], units: &[usize]) -> Vec<f64> {
    let mut sums: std::collections::BTreeMap<usize, f64> = std::collections::BTreeMap::new();
    scores.iter().zip(units).for_each(|(score, unit)| *sums.entry(*unit).or_default() += score);
    sums.into_values().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn explanation(scores: Vec<f64>) -> Explanation<()> {
        Explanation { keys: Vec::new(), fitted: (), scores, freedom: 0.0, log_prior: 0.0 }
    }

    /// Rows that agree keep the odds of their sum; rows that contradict each other do not.
    #[test]
    fn contradicting_rows_lower_a_probability() {
        let evidence = Evidence { base: 0.0, readings: 100.0, stated: true };
        let units: Vec<usize> = (0..100).collect();
        let of = |scores: Vec<f64>| {
            let both = [explanation(vec![0.0; 100]), explanation(scores)];
            Probabilities::new(&both, evidence, &units).of[1]
        };
        let odds = f64::exp(4.0);
        let agreeing = of(vec![0.04; 100]);
        assert!((agreeing - odds / (1.0 + odds)).abs() < 0.005, "{agreeing}");
        let contradicting = of((0..100).map(|i| if i % 2 == 0 { 2.04 } else { -1.96 }).collect());
        assert!(contradicting < 0.75, "{contradicting}");
    }
}
