//! `fitted-curve` and `level-shift`: corrections that a fit found without a law for them.
//!
//! A curve gives a value `f` over one input or group: linear between its knots, constant beyond the first
//! and the last. A surface does so over two, bilinear. A level shift has the same `f` for
//! every impact. How `f` acts stands in [`correction`](super::correction).
//!
//! `f` is a pure number [1]; knots have the unit of their input. No physics: the values hold for
//! the data of the fit (`valid`). An input of words has a value for each word, and none between
//! them; a word without a value, and what is not stated or has no value, leave the impact unchanged.

use super::correction::LARGEST_VALUE;
use super::{Correction, CurveInput, CurveTarget, Effect, EffectInfo, Operation, Parameter, Search};
use crate::group::{Circumstances, Declared};

const ABOUT_VALUE: &str = "correction of e_n, of e_t or of capture";

pub(super) const FITTED_CURVE: EffectInfo = EffectInfo {
    id: "fitted-curve",
    about: "a correction over one or two inputs, fitted without a law",
    inputs: &[],
    stream: None,
    parameters: &[],
    build: |values| Box::new(FittedCurve::level(values)),
};

pub(super) const LEVEL_SHIFT: EffectInfo = EffectInfo {
    id: "level-shift",
    about: "one correction for all impacts, fitted without a law",
    inputs: &[],
    stream: None,
    parameters: &[Parameter::new("value", "1", (-LARGEST_VALUE, LARGEST_VALUE), Search::Linear(-1.0, 1.0))
        .about(ABOUT_VALUE)],
    build: |values| Box::new(FittedCurve::level(values)),
};

/// One input of a curve with its knots.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveAxis {
    /// The input.
    pub input: CurveInput,
    /// Ascending values of the input, in its unit; of a word the indices of the words that have a value, in any order.
    pub knots: Vec<f64>,
}

impl CurveAxis {
    /// The knot at or below an impact, and the share [1] of the next knot; `None` where the axis
    /// has no value for the impact.
    fn place(&self, of: &dyn Circumstances) -> Option<(usize, f64)> {
        let value = self.input.value(of);
        if let CurveInput::Label(_) = self.input {
            return Some((self.knots.iter().position(|knot| *knot == value)?, 0.0));
        }
        if value.is_nan() {
            return None;
        }
        let above = self.knots.partition_point(|knot| *knot <= value);
        let below = above.saturating_sub(1);
        let [low, high] = [*self.knots.get(below)?, *self.knots.get(above).unwrap_or(&f64::INFINITY)];
        let share = ((value - low) / (high - low)).max(0.0);
        // Beyond the first and the last knot the share is 0, at any distance.
        Some((below, if above == 0 || above == self.knots.len() { 0.0 } else { share }))
    }
}

/// A correction over no input (a level), one (a curve) or two (a surface).
#[derive(Debug, Clone, PartialEq)]
pub struct FittedCurve {
    /// What it corrects.
    pub on: CurveTarget,
    /// How.
    pub form: Operation,
    /// Its inputs.
    pub axes: Vec<CurveAxis>,
    /// The value [1] at each combination of knots; that of the last axis changes first. A curve
    /// with another number of values corrects nothing.
    pub values: Vec<f64>,
}

impl FittedCurve {
    /// A level of `e_n`; without a value it corrects nothing.
    fn level(values: &[f64]) -> Self {
        let (on, form) = (CurveTarget::NormalRestitution, Operation::Add);
        Self { on, form, axes: Vec::new(), values: values.to_vec() }
    }
}

impl CurveAxis {
    fn describe(&self, declared: &Declared<'_>) -> String {
        let name = self.input.name(declared);
        let ends = self.knots.first().zip(self.knots.last());
        match (self.input, ends) {
            (CurveInput::Label(_), _) | (_, None) => format!("{name} ({} labels)", self.knots.len()),
            (_, Some((low, high))) => format!("{name} ({} knots from {low} to {high})", self.knots.len()),
        }
    }
}

/// The value of a grid; `None` where an axis has no value for the impact.
fn interpolated(axes: &[CurveAxis], values: &[f64], of: &dyn Circumstances) -> Option<f64> {
    let Some((axis, rest)) = axes.split_first() else {
        let [value] = values else { return None };
        return Some(*value);
    };
    if axis.knots.is_empty() || !values.len().is_multiple_of(axis.knots.len()) {
        return None;
    }
    let block = values.len() / axis.knots.len();
    let (knot, share) = axis.place(of)?;
    let at = |knot: usize| interpolated(rest, values.get(knot * block..(knot + 1) * block)?, of);
    let low = at(knot)?;
    if share == 0.0 { Some(low) } else { Some((1.0 - share) * low + share * at(knot + 1)?) }
}

impl Effect for FittedCurve {
    fn correction(&self) -> Option<&dyn Correction> {
        Some(self)
    }
}

impl Correction for FittedCurve {
    fn on(&self) -> CurveTarget {
        self.on
    }

    fn acts(&self) -> Operation {
        self.form
    }

    fn value(&self, of: &dyn Circumstances) -> Option<f64> {
        interpolated(&self.axes, &self.values, of)
    }

    fn inputs(&self) -> Vec<CurveInput> {
        self.axes.iter().map(|axis| axis.input).collect()
    }

    fn describe(&self, declared: &Declared<'_>) -> String {
        let operation = self.form.describe(self.on);
        let [low, high] =
            self.values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
                [low.min(*value), high.max(*value)]
            });
        if self.axes.is_empty() {
            return format!("{operation}, f = {low}");
        }
        let axes: Vec<String> = self.axes.iter().map(|axis| axis.describe(declared)).collect();
        format!("{operation}, f {low} to {high} over {}", axes.join(" and "))
    }
}
