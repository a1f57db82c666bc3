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
//!
//! Some files hold gross errors, as a number mistyped: with the probability `Q` a reading is one with
//! the probability `q`, and then anything within the range of its kind. The grid has a second, coarser
//! part with gross errors, and no explanation decides which readings they are:
//! `p(y) = (1 - q) N(y) + q U(y)`.

use statrs::function::gamma::ln_gamma;

use super::super::likelihood::GROSS_DENSITY;

/// Values of the scatter without gross errors, one of them in so many of those with gross errors, and all together.
const SCATTERS: usize = 16;
const COARSER: usize = 3;
pub(super) const GRID: usize = SCATTERS + (SCATTERS - 1) / COARSER + 1;
/// Probability that a file holds gross errors, and of a reading there that it is one [1]; assumed.
const WITH_GROSS: f64 = 0.05;
const GROSS: f64 = 0.05;
/// Beyond this difference one of two terms is negligible [nats].
const FAR: f64 = 36.0;
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

/// `constant - weight (y - mean)²` is the log density of a stated reading that is no gross error, for each scatter.
#[derive(Debug, Clone)]
pub(super) struct NormalDensity {
    pub constant: OverGrid,
    pub weight: OverGrid,
}

impl NormalDensity {
    /// Log density at a squared distance [1] for each scatter [nats]; `added` is part of it.
    pub fn at(&self, square: f64, added: f64) -> OverGrid {
        // Without the factor of a normal density, as the others.
        let gross = (GROSS * GROSS_DENSITY * std::f64::consts::TAU.sqrt()).ln();
        std::array::from_fn(|place| {
            with_gross(place, self.constant[place] + added - self.weight[place] * square, gross)
        })
    }
}

/// The place of the same scatter without gross errors.
fn without_gross(place: usize) -> usize {
    place.checked_sub(SCATTERS).map_or(place, |coarse| COARSER * coarse)
}

/// Log density of a reading that may be a gross error where the grid has them, from those if it is none and if it is.
#[inline]
fn with_gross(place: usize, regular: f64, gross: f64) -> f64 {
    if place < SCATTERS {
        return regular;
    }
    let regular = regular + (1.0 - GROSS).ln();
    match gross - regular {
        odds if odds > FAR => gross,
        odds if odds < -FAR => regular,
        // Few terms of the logarithm's series take a third of its time.
        odds if odds < -3.0 => {
            let small = odds.exp();
            regular + small * (1.0 - small * (0.5 - small / 3.0))
        }
        odds => regular + odds.exp().ln_1p(),
    }
}

/// The probability that a reading is no gross error, for each scatter, from its log densities.
pub(super) fn regular(density: &OverGrid) -> OverGrid {
    std::array::from_fn(|place| match without_gross(place) {
        same if same == place => 1.0,
        without => (1.0 - GROSS) * (density[without] - density[place]).exp(),
    })
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
        let step = range / (SCATTERS - 1) as f64;
        // Probability of a scatter below the middle between a place and the next one, with places so far apart.
        let below = |place: usize, apart: usize| {
            let middle = apart as f64 * (place as f64 + 0.5);
            (step * middle).exp_m1().sqrt().atan() * std::f64::consts::FRAC_2_PI
        };
        let prior = |place: usize, apart: usize| match place {
            0 => COMPLETE + (1.0 - COMPLETE) * below(0, apart),
            _ => (1.0 - COMPLETE) * (below(place, apart) - below(place - 1, apart)),
        };
        Self {
            kind,
            counted,
            unit,
            squares: std::array::from_fn(|place| unit * (step * without_gross(place) as f64).exp_m1()),
            prior: std::array::from_fn(|place| match place.checked_sub(SCATTERS) {
                None => ((1.0 - WITH_GROSS) * prior(place, 1)).ln(),
                Some(place) => (WITH_GROSS * prior(place, COARSER)).ln(),
            }),
        }
    }

    /// The density of a stated reading about a prediction.
    pub fn normal(&self, one: &GroupedReading) -> NormalDensity {
        let variance = self.squares.map(|square| one.own + square * one.with);
        NormalDensity { constant: variance.map(|v| -0.5 * v.ln()), weight: variance.map(|v| 0.5 / v) }
    }

    /// The density of a share `value` of a count.
    pub fn counted(&self, one: &GroupedReading, value: f64) -> CountDensity {
        let count = one.own;
        let caught = value * count;
        // Every count is as likely, and the binomial coefficient is left out.
        let ways = ln_gamma(count + 1.0) - ln_gamma(caught + 1.0) - ln_gamma(count - caught + 1.0);
        let gross = GROSS.ln() - (count + 1.0).ln() - ways;
        let at = |place: usize| -> OverGrid {
            let log_odds = OUTERMOST * (2.0 * place as f64 / (PLACES - 1) as f64 - 1.0);
            let p = 1.0 / (1.0 + (-log_odds).exp());
            let correlation = |square: f64| (square + one.with).min(LARGEST_CORRELATION);
            let regular = |place: usize| beta_binomial(caught, count, p, correlation(self.squares[place]));
            let regular: [f64; SCATTERS] = std::array::from_fn(regular);
            std::array::from_fn(|place| with_gross(place, regular[without_gross(place)], gross))
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
            let last = (1.0 + group.squares[SCATTERS - 1] / (error * error)).ln();
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

    /// With gross errors a density is still one: sums over 2 million values, of which a gross error can be those between
    /// 0 and 1. A reading 20 errors off is a gross error, one at 2 is not.
    #[test]
    fn a_gross_error_has_its_density() {
        let reading = GroupedReading { own: 0.02_f64.powi(2), with: 1.0, misfit: 0.01 };
        let group = Group::new(0, false, &[reading]);
        let density = group.normal(&reading);
        let (step, place) = (1e-5, SCATTERS);
        let values = (-1_000_000..1_000_000).map(|at| 0.6 + step * f64::from(at));
        let sum: f64 = values
            .map(|y| {
                let outside = if (0.0..1.0).contains(&y) { 0.0 } else { GROSS };
                let density = density.at((y - 0.6).powi(2), 0.0)[place].exp() / std::f64::consts::TAU.sqrt();
                (density - outside) * step
            })
            .sum();
        assert!((sum - 1.0).abs() < 1e-6, "{sum}");
        let [near, far] = [0.04_f64, 0.4].map(|off| regular(&density.at(off.powi(2), 0.0))[place]);
        assert!(near > 0.95 && far < 1e-6, "{near} {far}");
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
                    let regular = beta_binomial(caught, count, p, *square);
                    // Any count is as likely where it is a gross error.
                    let gross = if which < SCATTERS { 0.0 } else { GROSS };
                    let all = (1.0 - gross) * (regular + choose(caught)).exp() + gross / (count + 1.0);
                    let exact = all.ln() - choose(caught);
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
