//! Does a candidate explain anything? A score test of its shapes, corrected for the number of shapes and candidates.
//!
//! A shape is the change of the predictions that a candidate makes at one place of its search
//! range; with the slope of the log score of each row it gives one number a row, and by addition
//! one number `u_g` for each independent unit. Without the candidate the sum of `u_g` has the mean
//! zero; `t = Σ u_g / sqrt(Σ u_g²)` needs no assumption about the noise (Lagrange multiplier test
//! with a heteroscedasticity-consistent variance; White 1982). It is at most the square root of the
//! number of units, so few units never say much. For classes of captures its p-value is that of
//! Student's t with the effective number of units `(Σ u²)²/Σ u⁴`.
//!
//! Shapes of one candidate, and candidates, resemble each other. How many independent tests they
//! amount to follows from the largest `t` of units with random signs (multiplier bootstrap;
//! Chernozhukov, Chetverikov and Kato 2013; minimum p-value of Westfall and Young 1993): `m =
//! ln(0.95) / ln(1 - p_5)`, where `p_5` is the 5 % quantile of the smallest p-value. The corrected
//! p-value is `1 - (1 - p)^m`.

use nalgebra::DMatrix;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

/// Draws of random signs.
const SIGN_DRAWS: usize = 400;
/// Shapes from which fits start: with the largest `t`, and with the largest gain.
const STARTS: usize = 2;
/// Shapes whose p-values are computed: those with the largest `t`.
const TESTED_SHAPES: usize = 10;
/// Smallest p-value.
const SMALLEST_P_VALUE: f64 = 1e-300;

/// The shapes of one candidate.
#[derive(Debug, Clone, Default)]
pub(super) struct Shapes {
    /// Whether the opposite of a shape is possible, too.
    pub both_signs: bool,
    /// Place of each shape in the search range.
    pub at: Vec<Vec<f64>>,
    /// The number `u` of each row of the search, by shape.
    pub scores: Vec<Vec<f64>>,
    /// Gain in log likelihood at each shape at its full size [nats]; none for shapes without a size.
    pub gains: Vec<f64>,
    /// Whether the candidate changes the distribution rather than the mean.
    pub is_random: bool,
}

/// The result for one candidate.
#[derive(Debug, Clone, Default)]
pub(super) struct Tested {
    /// Corrected for the number of its shapes.
    pub p_value: f64,
    /// Effective number of independent tests of all candidates [1].
    pub tests: f64,
    /// Largest of [`Shapes::gains`] [nats].
    pub gain: f64,
    /// Places of the shapes with the largest `t`, and of those with the largest gain.
    pub starts: Vec<Vec<f64>>,
}

/// Tests all candidates; `units` is the independent unit of each row. Units that are `skewed`, as
/// classes of captures are, say less.
pub(super) fn test(candidates: &[Shapes], units: &[usize], skewed: bool) -> Vec<Tested> {
    let (units, count) = compact(units);
    let by_unit: Vec<Vec<Vec<f64>>> = candidates.iter().map(|shapes| sums(shapes, &units, count)).collect();
    let largest = largest_of_random_signs(candidates, &by_unit, count);
    let mut results: Vec<Tested> = Vec::new();
    let mut corrected_draws = vec![1.0_f64; SIGN_DRAWS];
    for (place, (shapes, sums)) in candidates.iter().zip(&by_unit).enumerate() {
        let drawn: Vec<f64> = largest.iter().map(|row| tail(row[place], shapes.both_signs)).collect();
        let tests = independent_tests(&drawn);
        for (smallest, p) in corrected_draws.iter_mut().zip(&drawn) {
            *smallest = smallest.min(corrected(*p, tests));
        }
        results.push(one(shapes, sums, tests, skewed));
    }
    let tests = independent_tests(&corrected_draws);
    results.iter_mut().for_each(|result| result.tests = tests);
    results
}

/// The p-value of one candidate, and its best shapes.
fn one(shapes: &Shapes, sums: &[Vec<f64>], tests: f64, skewed: bool) -> Tested {
    let signed = |t: f64| if shapes.both_signs { t.abs() } else { t };
    let mut order: Vec<(usize, f64)> = sums.iter().map(|u| signed(statistic(u))).enumerate().collect();
    order.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut by_gain: Vec<(usize, f64)> = shapes.gains.iter().copied().enumerate().collect();
    by_gain.sort_by(|a, b| b.1.total_cmp(&a.1));
    // A large t may lie beyond a valley that is narrow, and a gain before one. Of a distribution, of which
    // fits take long, the t may be that of a few rows.
    let by_t = &order[..if shapes.is_random { 0 } else { order.len().min(STARTS) }];
    let best = by_t.iter().chain(by_gain.iter().take(STARTS)).map(|(shape, _)| *shape);
    let mut starts: Vec<Vec<f64>> = Vec::new();
    for start in best.filter_map(|shape| shapes.at.get(shape)) {
        if !starts.contains(start) {
            starts.push(start.clone());
        }
    }
    let p = if skewed {
        // Of shapes that rest on few units a smaller t may be the better evidence.
        let chance =
            |&(shape, t): &(usize, f64)| student_tail(t, effective(&sums[shape]) - 1.0, shapes.both_signs);
        order.iter().take(TESTED_SHAPES).map(chance).fold(1.0, f64::min)
    } else {
        order.first().map_or(1.0, |(_, t)| tail(*t, shapes.both_signs))
    };
    let gain = by_gain.first().map_or(0.0, |(_, gain)| *gain);
    Tested { p_value: corrected(p, tests), tests: 1.0, starts, gain }
}

/// The p-value of the best of `tests` independent tests.
pub(super) fn corrected(p: f64, tests: f64) -> f64 {
    (-f64::exp_m1(tests.max(1.0) * f64::ln_1p(-p.min(1.0 - 1e-16)))).clamp(SMALLEST_P_VALUE, 1.0)
}

/// The number of independent tests whose smallest p-values are distributed like these.
fn independent_tests(smallest: &[f64]) -> f64 {
    let mut sorted = smallest.to_vec();
    sorted.sort_by(f64::total_cmp);
    let fifth = sorted.get(sorted.len() / 20).copied().unwrap_or(1.0).clamp(1e-12, 0.05);
    0.95_f64.ln() / (-fifth).ln_1p()
}

/// The sum of the units in its standard errors.
fn statistic(units: &[f64]) -> f64 {
    let (sum, square) = units.iter().fold((0.0, 0.0), |(s, q), u| (s + u, q + u * u));
    if square > 0.0 { sum / square.sqrt() } else { 0.0 }
}

/// Effective number of units, `(Σ u²)²/Σ u⁴`.
fn effective(units: &[f64]) -> f64 {
    let (square, fourth) = units.iter().fold((0.0, 0.0), |(q, f), u| (q + u * u, f + u.powi(4)));
    if fourth > 0.0 { square * square / fourth } else { 1.0 }
}

/// Probability of a sum at least as large, of few units.
fn student_tail(t: f64, freedom: f64, both_signs: bool) -> f64 {
    let one = StudentsT::new(0.0, 1.0, freedom.max(1.0)).map_or(1.0, |law| law.sf(t));
    if both_signs { (2.0 * one).min(1.0) } else { one }
}

/// Probability of a sum at least as large, of many units.
fn tail(t: f64, both_signs: bool) -> f64 {
    let one = Normal::standard().sf(t);
    if both_signs { (2.0 * one).min(1.0) } else { one }
}

/// Units numbered from 0 without gaps.
fn compact(units: &[usize]) -> (Vec<usize>, usize) {
    let mut known: Vec<usize> = units.to_vec();
    known.sort_unstable();
    known.dedup();
    let number = |unit: &usize| known.binary_search(unit).unwrap_or(0);
    (units.iter().map(number).collect(), known.len())
}

/// The sums of every shape over each unit.
fn sums(shapes: &Shapes, units: &[usize], count: usize) -> Vec<Vec<f64>> {
    let of = |scores: &Vec<f64>| {
        let mut sums = vec![0.0; count];
        scores.iter().zip(units).for_each(|(score, &unit)| sums[unit] += score);
        sums
    };
    shapes.scores.iter().map(of).collect()
}

/// The largest `t` of each candidate (columns) under random signs of the units (rows).
fn largest_of_random_signs(candidates: &[Shapes], by_unit: &[Vec<Vec<f64>>], count: usize) -> Vec<Vec<f64>> {
    let shapes: usize = by_unit.iter().map(Vec::len).sum();
    let mut random = ChaCha8Rng::seed_from_u64(0x7369_676e);
    let signs =
        DMatrix::from_fn(SIGN_DRAWS, count, |_, _| if random.next_u32() & 1 == 0 { 1.0 } else { -1.0 });
    let mut normed = DMatrix::zeros(count, shapes);
    for (column, u) in by_unit.iter().flatten().enumerate() {
        let norm = u.iter().map(|u| u * u).sum::<f64>().sqrt();
        if norm > 0.0 {
            u.iter().enumerate().for_each(|(row, u)| normed[(row, column)] = u / norm);
        }
    }
    let drawn = signs * normed;
    let of_draw = |draw: usize| {
        let mut first = 0;
        let of = |(shapes, sums): (&Shapes, &Vec<Vec<f64>>)| {
            let range = first..first + sums.len();
            first += sums.len();
            range
                .map(
                    |column| {
                        if shapes.both_signs { drawn[(draw, column)].abs() } else { drawn[(draw, column)] }
                    },
                )
                .fold(f64::NEG_INFINITY, f64::max)
        };
        candidates.iter().zip(by_unit).map(of).collect::<Vec<f64>>()
    };
    (0..SIGN_DRAWS).map(of_draw).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(count: usize, seed: u64) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut uniform = || (random.next_u32() as f64 + 0.5) / 2f64.powi(32);
        (0..count).map(|_| (0..12).map(|_| uniform()).sum::<f64>() - 6.0).collect()
    }

    #[test]
    fn equal_shapes_are_one_test_and_independent_ones_many() {
        let shape = |seed| Shapes { scores: vec![noise(300, seed)], ..Shapes::default() };
        let units: Vec<usize> = (0..300).collect();
        let same: Vec<Shapes> = (0..20).map(|_| shape(3)).collect();
        assert!(test(&same, &units, false)[0].tests < 1.7, "{}", test(&same, &units, false)[0].tests);
        let apart: Vec<Shapes> = (0..20).map(shape).collect();
        let tests = test(&apart, &units, false)[0].tests;
        assert!((12.0..32.0).contains(&tests), "{tests}");
    }

    #[test]
    fn a_null_is_significant_as_often_as_it_should_be() {
        let units: Vec<usize> = (0..60).collect();
        let significant = (0..200_u64).filter(|seed| {
            let shape = |part: u64| Shapes {
                both_signs: true,
                scores: vec![noise(60, 1000 * part + *seed)],
                ..Shapes::default()
            };
            let tested = test(&(0..5).map(shape).collect::<Vec<_>>(), &units, false);
            tested.iter().any(|one| corrected(one.p_value, one.tests) < 0.05)
        });
        let count = significant.count();
        assert!((2..=22).contains(&count), "{count} of 200");
    }
}
