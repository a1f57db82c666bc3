//! Scatter between runs beyond what the readings state.
//!
//! Two runs with the same settings differ by more than the error of a reading: the plate is never
//! quite as hot, the powder never quite the same. Readings of one kind of observable with stated
//! errors, and those of one kind with counts, are a [`Group`] whose readings share one scatter `s`:
//!
//! - stated: variance `e² + m + s² a`, with the stated error `e`, the Monte Carlo variance `m` of
//!   the base model's prediction, and `a = 1`, of a share `4 y (1 - y)` with the middle `y` of the
//!   measured and the base's value: a share near 0 or 1 cannot scatter as one of a half does;
//! - counted: the correlation between two particles of a run is `s² + m/(p q)`, as of a
//!   beta-binomial (Skellam 1948). The likelihood is that of a binomial of `n` particles to the power
//!   `1/φ` over `sqrt(φ)`, with `φ = 1 + (n-1) s²` (Efron 1986, double exponential families): within a
//!   third of a nat of the beta-binomial where a probability doubles, and quick. Where none
//!   or all were caught, `φ = x/ln(1 + x)` with `x = n s²`, and there is no root: the limit of the
//!   beta-binomial for small probabilities.
//!
//! No explanation has a scatter of its own to fit. The likelihood is the mean over the scatter,
//!
//! `L = P L(0) + (1 - P)/R ∫ L(s) d ln(V + s²)`,
//!
//! with the probability `P` that the stated errors are complete, the typical variance `V` of the
//! group and the range `R` of the logarithm. The integral is a sum over a grid; the integrand is
//! near normal in the logarithm, for which a sum with steps up to twice its standard deviation is
//! exact to a few percent.

/// Values of the scatter.
pub(super) const GRID: usize = 16;
/// Probability that readings scatter as their errors and counts say [1]; assumed.
const COMPLETE: f64 = 0.8;
/// Range of the logarithm of the variance over which a scatter is looked for, otherwise [nats]:
/// up to a hundred stated errors.
const RANGE: f64 = 9.2;
/// Largest scatter: standard deviation of a reading, and correlation of a share, squared [1].
const LARGEST: [f64; 2] = [0.25, 0.5];
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

/// `constant - weight distance` is the log density of a reading, for each scatter.
#[derive(Debug, Clone)]
pub(super) struct Density {
    pub constant: OverGrid,
    pub weight: OverGrid,
}

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
        let rest = ((1.0 - COMPLETE) * step / RANGE).ln();
        Self {
            kind,
            counted,
            unit,
            squares: std::array::from_fn(|place| unit * (step * place as f64).exp_m1()),
            prior: std::array::from_fn(|place| if place == 0 { COMPLETE.ln() } else { rest }),
        }
    }

    /// The densities of a reading about a prediction: inside, and where a count is none or all.
    pub fn densities(&self, one: &GroupedReading) -> [Density; 2] {
        let density = |of: &dyn Fn(f64) -> [f64; 2]| {
            let both = self.squares.map(of);
            Density { constant: both.map(|[constant, _]| constant), weight: both.map(|[_, weight]| weight) }
        };
        if !self.counted {
            let normal = density(&|square| {
                let variance = one.own + square * one.with;
                [-0.5 * variance.ln(), 0.5 / variance]
            });
            return [normal.clone(), normal];
        }
        let inside = |square: f64| {
            let dispersion = 1.0 + (one.own - 1.0).max(0.0) * (square + one.with);
            [-0.5 * dispersion.ln(), one.own / dispersion]
        };
        let outside = |square: f64| {
            let excess = (one.own * (square + one.with)).max(1e-9);
            [0.0, one.own * excess.ln_1p() / excess]
        };
        [density(&inside), density(&outside)]
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
            let [density, _] = group.densities(&reading);
            let likelihood: OverGrid = std::array::from_fn(|place| {
                f64::from(count) * density.constant[place] - density.weight[place] * squares
            });
            let top = log(squares / f64::from(count));
            let steps = 20_000;
            let last = (1.0 + group.squares[GRID - 1] / (error * error)).ln();
            let at = |step: i32| last * (f64::from(step) + 0.5) / f64::from(steps);
            let integral: f64 =
                (0..steps).map(|step| (log(error * error * at(step).exp()) - top).exp()).sum::<f64>() * last
                    / f64::from(steps);
            let mean = 0.8 * (log(error * error) - top).exp() + 0.2 / RANGE * integral;
            let found = group.log_mean(&likelihood) - top;
            assert!((found - mean.ln()).abs() < 0.15, "{count} {scatter}: {found} {}", mean.ln());
        }
    }

    /// The likelihood of counts of a beta-binomial, as a function of the mean, against the exact one.
    #[test]
    fn counts_scatter_as_a_beta_binomial() {
        let (count, correlation) = (100.0_f64, 0.05);
        let size = 1.0 / correlation - 1.0;
        let gamma = statrs::function::gamma::ln_gamma;
        let exact = |caught: f64, p: f64| {
            gamma(caught + p * size) - gamma(p * size) + gamma(count - caught + (1.0 - p) * size)
                - gamma((1.0 - p) * size)
        };
        let reading = GroupedReading { own: count, with: correlation, misfit: 0.0 };
        let densities = Group::new(0, true, &[reading]).densities(&reading);
        let ours = |caught: f64, p: f64| {
            let y = caught / count;
            let part = |y: f64, p: f64| if y > 0.0 { y * (y / p).ln() } else { 0.0 };
            let edge = usize::from(caught == 0.0 || caught == count);
            -densities[edge].weight[0] * (part(y, p) + part(1.0 - y, 1.0 - p))
        };
        for (caught, ps) in [(0.0, [0.01, 0.05]), (10.0, [0.07, 0.15]), (50.0, [0.4, 0.65])] {
            let [low, high] = ps;
            let exact = exact(caught, low) - exact(caught, high);
            let ours = ours(caught, low) - ours(caught, high);
            assert!((exact - ours).abs() < 0.33 + 0.15 * exact.abs(), "{caught} of {count}: {ours} {exact}");
        }
    }
}
