//! What can be known: a test of the true shape's amplitude among thirty candidates.

use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use super::lab::{Outcome, Outcomes, Row};

/// Chance of a false alarm of one of thirty candidates, one-sided.
const LEVEL: f64 = 0.05 / 30.0;
/// Bound of the probabilities of capture.
const FLOOR: f64 = 0.005;

/// The oracle's answer.
#[derive(Clone, Copy, Debug)]
pub struct Oracle {
    /// Probability with which it sees the effect.
    pub power: f64,
    /// Whether it sees it in these rows.
    pub sees: bool,
}

impl Oracle {
    /// Of a design that is known to be informative.
    pub const CERTAIN: Self = Self { power: 1.0, sees: true };
    /// Nothing is there.
    pub const NOTHING: Self = Self { power: 0.0, sees: false };

    /// Of rows with stated errors or not: the better of the tests of restitutions and of captures.
    pub fn of(rows: &[Row], stated: bool, outcomes: Outcomes) -> Self {
        let (one, other) = (restitutions(rows, stated), captures(rows, outcomes));
        Self { power: one.power.max(other.power), sees: one.sees || other.sees }
    }
}

/// Projects the residuals of the base on the true change, each in deviations of its noise. A row without a
/// temperature is of no use.
fn restitutions(rows: &[Row], stated: bool) -> Oracle {
    let (mut shape, mut product, mut square, mut count) = (0.0, 0.0, 0.0, 0.0);
    for row in rows.iter().filter(|row| !row.seen.t_p.is_nan()) {
        let (base, truth) = ([row.base.e_n, row.base.e_t], [row.truth.e_n, row.truth.e_t]);
        for i in 0..2 {
            let Some(value) = row.measured[i] else { continue };
            let (change, residual) = ((truth[i] - base[i]) / row.sigma[i], (value - base[i]) / row.sigma[i]);
            shape += change * change;
            product += change * residual;
            square += residual * residual;
            count += 1.0;
        }
    }
    if shape < 1e-12 {
        return Oracle::NOTHING;
    }
    let (expected, t) = (f64::sqrt(shape), product / f64::sqrt(shape));
    let normal = Normal::standard();
    if stated || count < 2.0 {
        let critical = normal.inverse_cdf(1.0 - LEVEL);
        return Oracle { power: normal.cdf(expected - critical), sees: t > critical };
    }
    let freedom = count - 1.0;
    let critical = StudentsT::new(0.0, 1.0, freedom).unwrap().inverse_cdf(1.0 - LEVEL);
    let scale = f64::sqrt((square - t * t).max(0.0) / freedom);
    Oracle { power: normal.cdf(expected - critical), sees: t > critical * scale }
}

/// Log-likelihood ratio of the true probabilities against the base with captures at the best constant rate.
fn captures(rows: &[Row], outcomes: Outcomes) -> Oracle {
    let counts: Vec<(f64, f64, &Row)> = rows
        .iter()
        .filter(|row| !row.seen.t_p.is_nan())
        .filter_map(|row| counts(row, outcomes).map(|(n, k)| (n, k, row)))
        .collect();
    let likelihood = |p: &dyn Fn(&Row) -> f64, k: &dyn Fn(f64, f64, &Row) -> f64| -> f64 {
        let one = |(n, seen, row): &(f64, f64, &Row)| {
            let (p, k) = (p(row).clamp(FLOOR, 1.0 - FLOOR), k(*n, *seen, row));
            k * p.ln() + (n - k) * (1.0 - p).ln()
        };
        counts.iter().map(one).sum()
    };
    let truth = |row: &Row| row.truth.stick;
    let gain = |k: &dyn Fn(f64, f64, &Row) -> f64| {
        let with_rate = |rate: f64| likelihood(&|row| row.base.stick + (1.0 - row.base.stick) * rate, k);
        let best = (0..100).map(|i| with_rate(f64::from(i) / 100.0)).fold(f64::NEG_INFINITY, f64::max);
        2.0 * (likelihood(&truth, k) - best)
    };
    let normal = Normal::standard();
    let critical = normal.inverse_cdf(1.0 - LEVEL);
    let expected = gain(&|n, _, row| n * row.truth.stick).max(0.0).sqrt();
    if expected < 1e-6 {
        return Oracle::NOTHING;
    }
    Oracle { power: normal.cdf(expected - critical), sees: gain(&|_, k, _| k) > critical.powi(2) }
}

/// Impacts and captures of a row, as many as would be worth the same if they were independent.
fn counts(row: &Row, outcomes: Outcomes) -> Option<(f64, f64)> {
    match row.outcome {
        Outcome::Unknown => None,
        Outcome::Stuck => Some((1.0, 1.0)),
        Outcome::Rebound => Some((1.0, 0.0)),
        Outcome::Counts { impacts, captured } => {
            let Outcomes::Classes { correlation, .. } = outcomes else { return None };
            let worth = 1.0 / (1.0 + f64::from(impacts - 1) * correlation);
            Some((worth * f64::from(impacts), worth * f64::from(captured)))
        }
    }
}
