//! Where a candidate is looked at first: places of its search range.

use super::addition::{Kind, RigAddition};
use crate::diagnose::part::Part;

/// Places of the range of a law's own number, of an effect's only parameter, and along each of two.
/// With `sliding-to-rolling` a reading jumps where the critical angle passes its angle: only
/// between two such angles the law is right.
const OF_A_NUMBER: usize = 20;
const OF_AN_EFFECT: usize = 48;
const SIDE: usize = 6;
/// Places of a range with three or more parameters.
const HALTON_PLACES: usize = 48;
/// Bases of the Halton sequence.
const BASES: [usize; 6] = [2, 3, 5, 7, 11, 13];
/// Sizes of a curve, as a share of its reach, and changes of a law's own number, as a share of its
/// range: small ones too, where many readings show them.
const CURVE_SIZES: [f64; 4] = [0.03, 0.1, 0.3, 0.9];
const NUMBER_CHANGES: [f64; 4] = [0.01, 0.025, 0.06, 0.15];
/// Distances of a number of the case from its value, in standard errors.
const CASE_CHANGES: [f64; 16] =
    [-10.0, -8.0, -6.5, -5.0, -4.0, -3.0, -2.0, -1.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.5, 8.0, 10.0];
/// Shapes of a curve over three knots.
const SHAPES: [[f64; 3]; 7] = [
    [1.0, 1.0, 1.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [-1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [1.0, 1.0, 0.0],
];

impl RigAddition {
    /// Places at which its predictions are computed; `now` is the present value of a law's number.
    pub fn places(&self, now: Option<f64>) -> Vec<Vec<f64>> {
        match (&self.kind, self.axes.first()) {
            (Kind::Curve { .. }, _) => curves(self.axes.len()),
            (Kind::Form(form), _) => form.places(),
            (Kind::Case { .. }, Some(axis)) => {
                CASE_CHANGES.map(|widths| vec![axis.coordinate(widths)]).to_vec()
            }
            (Kind::Part(Part::LawParameter(_)), Some(axis)) => {
                let mut all = even(OF_A_NUMBER);
                let here = now.map(|value| axis.coordinate(value));
                let near =
                    here.into_iter().flat_map(|at| NUMBER_CHANGES.iter().flat_map(move |c| [at - c, at + c]));
                all.extend(near.filter(|at| (0.0..=1.0).contains(at)).map(|at| vec![at]));
                all
            }
            _ => cube(self.axes.len()),
        }
    }
}

/// Shapes of a curve with so many knots, of both signs and several sizes, about the middle of the axes.
fn curves(knots: usize) -> Vec<Vec<f64>> {
    let shapes: Vec<Vec<f64>> = match knots {
        3 => SHAPES.iter().map(|shape| shape.to_vec()).collect(),
        _ => vec![vec![1.0; knots]],
    };
    let sized = |shape: Vec<f64>| {
        let all = CURVE_SIZES.iter().flat_map(|size| [-size, *size]);
        all.map(move |size| shape.iter().map(|height| 0.5 + 0.5 * size * height).collect())
            .collect::<Vec<_>>()
    };
    shapes.into_iter().flat_map(sized).collect()
}

/// Places of a unit cube of this many dimensions.
fn cube(dimensions: usize) -> Vec<Vec<f64>> {
    match dimensions {
        0 => vec![Vec::new()],
        1 => even(OF_AN_EFFECT),
        2 => even(SIDE)
            .into_iter()
            .flat_map(|x| even(SIDE).into_iter().map(move |y| [&x[..], &y].concat()))
            .collect(),
        _ => (1..=HALTON_PLACES)
            .map(|number| (0..dimensions).map(|d| halton(number, BASES[d % 6])).collect())
            .collect(),
    }
}

/// So many places of one dimension, at the middles of equal parts.
fn even(count: usize) -> Vec<Vec<f64>> {
    (0..count).map(|place| vec![(place as f64 + 0.5) / count as f64]).collect()
}

/// The element of a Halton sequence with this base.
pub(super) fn halton(mut number: usize, base: usize) -> f64 {
    let (mut value, mut digit) = (0.0, 1.0);
    while number > 0 {
        digit /= base as f64;
        value += digit * (number % base) as f64;
        number /= base;
    }
    value
}
