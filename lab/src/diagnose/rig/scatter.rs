//! Scatter between runs beyond what the readings state.
//!
//! Two runs with the same settings differ by more than the error of a reading: the plate is never
//! quite as hot, the powder never quite the same. Readings of one kind of observable with stated
//! errors, and those of one kind with counts, are a [`Group`] whose readings share one scatter `s`:
//!
//! - stated: variance `e² + m + s² a`, with the stated error `e`, the Monte Carlo variance `m` of
//!   the base model's prediction, and `a = 1`, of a share `4 y (1 - y)` with the middle `y` of the
//!   measured and the base's value: a share near 0 or 1 cannot scatter as one of a half does;
//! - counted: beta-binomial (Skellam 1948) with the correlation `s² + m/(p q)` between two particles
//!   of a run.
//!
//! No explanation has a scatter of its own to fit. The likelihood is the mean over the scatter,
//!
//! `L = P L(0) + (1 - P) ∫ L(s) p(s) ds`,
//!
//! with the probability `P` that the stated errors are complete, and otherwise a half-Cauchy
//! distribution of `s` with the typical error of the group as scale (Gelman 2006): as much scatter
//! again is usual, ten times as much is not. The integral is a sum over a grid that is even in
//! `ln(V + s²)`, in which the integrand is near normal: a sum with steps up to twice its standard
//! deviation is exact to a few percent.

use statrs::function::gamma::ln_gamma;

/// Values of the scatter.
pub(super) const GRID: usize = 16;
/// Probability that readings scatter as their errors and counts say [1]; assumed.
const COMPLETE: f64 = 0.8;
/// Largest scatter: standard deviation of a reading, and correlation of a share, squared [1].
const LARGEST: [f64; 2] = [0.25, 0.5];
/// Largest correlation with that of a Monte Carlo error [1].
const LARGEST_CORRELATION: f64 = 0.9;
/// Times the largest squared misfit of the base model, up to which the grid reaches: data sets drawn
/// with its scatter have larger ones.
const BEYOND_MISFIT: f64 = 4.0;
/// Terms that are smaller than the largest one by more than this do not count [nats].
const NEGLIGIBLE: f64 = 30.0;

/// A value for each scatter of the grid.
pub(super) type OverGrid = [f64; GRID];

/// Readings that share a scatter.
#[derive(Debug, Clone)]
pub(super) struct Group {
    /// Place of the kind of observable.
    pub kind: usize,
    pub counted: bool,
    /// The scatter squared that is as large as the own variance of a typical reading [1].
    pub unit: f64,
    /// The scatter squared [1], ascending from 0.
    pub squares: OverGrid,
    /// Logarithm of the prior probability of each [nats].
    prior: OverGrid,
}

/// What a group knows of one of its readings.
#[derive(Debug, Clone, Copy)]
pub(super) struct GroupedReading {
    /// Variance without scatter between runs [1]; of a counted share the number of particles.
    pub own: f64,
    /// What the scatter squared is multiplied by; of a counted share the Monte Carlo variance over
    /// `p q`, which adds to it [1].
    pub with: f64,
    /// Squared distance from the base model, of a counted share over `p q` [1].
    pub misfit: f64,
}

/// `constant - weight (y - mean)²` is the log density of a stated reading, for each scatter.
#[derive(Debug, Clone)]
pub(super) struct NormalDensity {
    pub constant: OverGrid,
    pub weight: OverGrid,
}

/// Places of a predicted share, evenly over its log odds, at which the density of a count is tabled.
const PLACES: usize = 200;
/// The outermost log odds: those of the shares that a prediction can have.
const OUTERMOST: f64 = 5.82;

/// Log density of a count at the places, for each scatter [nats], without the binomial coefficient.
#[derive(Debug, Clone)]
pub(super) struct CountDensity(Vec<OverGrid>);

impl CountDensity {
    /// For each scatter at the log odds of a predicted share.
    pub fn at(&self, log_odds: f64) -> OverGrid {
        let place = (log_odds / OUTERMOST + 1.0) * 0.5 * (PLACES - 1) as f64;
        let below = (place.max(0.0) as usize).min(PLACES - 2);
        let share = (place - below as f64).clamp(0.0, 1.0);
        let [low, high] = [&self.0[below], &self.0[below + 1]];
        std::array::from_fn(|which| low[which] + share * (high[which] - low[which]))
    }
}

/// Log density of a count `caught` of `count` particles, of which two of a run are correlated [nats], without
/// the binomial coefficient.
fn beta_binomial(caught: f64, count: f64, p: f64, correlation: f64) -> f64 {
    if correlation < UNCORRELATED / count {
        return caught * p.ln() + (count - caught) * (1.0 - p).ln();
    }
    let size = 1.0 / correlation - 1.0;
    let part = |hits: f64, mean: f64| ln_gamma(hits + mean * size) - ln_gamma(mean * size);
    part(caught, p) + part(count - caught, 1.0 - p) + ln_gamma(size) - ln_gamma(count + size)
}

/// Correlation times count below which a beta-binomial is a binomial [1].
const UNCORRELATED: f64 = 1e-4;

impl Group {
    pub fn new(kind: usize, counted: bool, readings: &[GroupedReading]) -> Self {
        let mut own: Vec<f64> = readings.iter().map(|one| one.own).collect();
        own.sort_by(f64::total_cmp);
        let typical = own.get(own.len() / 2).copied().unwrap_or(1.0);
        // The scatter squared that is as large as a typical reading's own variance.
        let unit = if counted { 1.0 / (typical - 1.0).max(1.0) } else { typical };
        let misfit = readings.iter().map(|one| one.misfit).fold(0.0, f64::max);
        let largest = (BEYOND_MISFIT * misfit).min(LARGEST[usize::from(counted)]);
        let range = (1.0 + largest / unit).ln().max(1.0);
        let step = range / (GRID - 1) as f64;
        // Probability of a scatter below the middle between a place and the next one.
        let below =
            |place: usize| (step * (place as f64 + 0.5)).exp_m1().sqrt().atan() * std::f64::consts::FRAC_2_PI;
        let prior = |place: usize| match place {
            0 => COMPLETE + (1.0 - COMPLETE) * below(0),
            _ => (1.0 - COMPLETE) * (below(place) - below(place - 1)),
        };
        Self {
            kind,
            counted,
            unit,
            squares: std::array::from_fn(|place| unit * (step * place as f64).exp_m1()),
            prior: std::array::from_fn(|place| prior(place).ln()),
        }
    }

    /// The density of a stated reading about a prediction.
    pub fn normal(&self, one: &GroupedReading) -> NormalDensity {
        let variance = self.squares.map(|square| one.own + square * one.with);
        NormalDensity { constant: variance.map(|v| -0.5 * v.ln()), weight: variance.map(|v| 0.5 / v) }
    }

    /// The density of a share `value` of a count.
    pub fn counted(&self, one: &GroupedReading, value: f64) -> CountDensity {
        let at = |place: usize| {
            let log_odds = OUTERMOST * (2.0 * place as f64 / (PLACES - 1) as f64 - 1.0);
            let p = 1.0 / (1.0 + (-log_odds).exp());
            let correlation = |square: f64| (square + one.with).min(LARGEST_CORRELATION);
            self.squares.map(|square| beta_binomial(value * one.own, one.own, p, correlation(square)))
        };
        CountDensity((0..PLACES).map(at).collect())
    }

    /// Logarithm of the mean likelihood over the scatter, from its logarithm for each [nats].
    pub fn log_mean(&self, likelihood: &OverGrid) -> f64 {
        let sum: OverGrid = std::array::from_fn(|place| self.prior[place] + likelihood[place]);
        log_sum(&sum)
    }

    /// Probability of each scatter under these log likelihoods.
    pub fn probabilities(&self, likelihood: &OverGrid) -> OverGrid {
        let all = self.log_mean(likelihood);
        std::array::from_fn(|place| (self.prior[place] + likelihood[place] - all).exp())
    }
}

/// `ln sum exp`.
pub(super) fn log_sum(terms: &OverGrid) -> f64 {
    let largest = terms.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let counts = terms.iter().filter(|term| **term > largest - NEGLIGIBLE);
    largest + counts.map(|term| (term - largest).exp()).sum::<f64>().ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean likelihood of normal readings over their scatter, by a sum over 20,000 steps.
    #[test]
    fn the_grid_integrates() {
        for (count, scatter) in [(8, 0.0), (8, 4.0), (30, 1.0), (30, 10.0), (100, 3.0)] {
            let error = 0.02_f64;
            let squares: f64 = f64::from(count) * error * error * (1.0 + scatter * scatter);
            let misfit = 6.0 * squares / f64::from(count);
            let reading = GroupedReading { own: error * error, with: 1.0, misfit };
            let group = Group::new(0, false, &[reading]);
            let log = |variance: f64| -0.5 * f64::from(count) * variance.ln() - 0.5 * squares / variance;
            let density = group.normal(&reading);
            let likelihood: OverGrid = std::array::from_fn(|place| {
                f64::from(count) * density.constant[place] - density.weight[place] * squares
            });
            let top = log(squares / f64::from(count));
            let steps = 20_000;
            let last = (1.0 + group.squares[GRID - 1] / (error * error)).ln();
            let at = |step: i32| last * (f64::from(step) + 0.5) / f64::from(steps);
            // Half-Cauchy over `ln(1 + s²/e²)`.
            let prior = |u: f64| std::f64::consts::FRAC_1_PI / u.exp_m1().sqrt();
            let term = |step: i32| prior(at(step)) * (log(error * error * at(step).exp()) - top).exp();
            let integral: f64 = (0..steps).map(term).sum::<f64>() * last / f64::from(steps);
            let mean = 0.8 * (log(error * error) - top).exp() + 0.2 * integral;
            let found = group.log_mean(&likelihood) - top;
            assert!((found - mean.ln()).abs() < 0.15, "{count} {scatter}: {found} {}", mean.ln());
        }
    }

    /// The tabled density of a count against the exact beta-binomial between the places, and that sums over
    /// all counts are 1.
    #[test]
    fn counts_scatter_as_a_beta_binomial() {
        let count = 60.0_f64;
        let choose =
            |caught: f64| ln_gamma(count + 1.0) - ln_gamma(caught + 1.0) - ln_gamma(count - caught + 1.0);
        let reading = GroupedReading { own: count, with: 0.0, misfit: 1.0 };
        let group = Group::new(0, true, &[reading]);
        for p in [0.004_f64, 0.03, 0.31, 0.77] {
            let mut sums = [0.0; GRID];
            for caught in (0..=60).map(f64::from) {
                let tabled = group.counted(&reading, caught / count).at((p / (1.0 - p)).ln());
                for (which, square) in group.squares.iter().enumerate() {
                    let exact = beta_binomial(caught, count, p, *square);
                    assert!(
                        (tabled[which] - exact).abs() < 0.02,
                        "{caught} {p} {square}: {} {exact}",
                        tabled[which]
                    );
                    sums[which] += (exact + choose(caught)).exp();
                }
            }
            assert!(sums.iter().all(|sum| (sum - 1.0).abs() < 1e-3), "{p}: {sums:?}");
        }
    }
}
