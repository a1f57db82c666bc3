//! `fitted-curve` and `level-shift`: corrections that a fit found without a law for them.
//!
//! A curve gives a value `f` over one input: linear between its knots, constant beyond the first
//! and the last. A surface does so over two inputs, bilinear. A level shift has the same `f` for
//! every impact. After all laws and effects, in the order of the file, `e_n -> e_n + f` and `e_t ->
//! e_t + f` (`add`), or `e_n -> e_n (1 + f)` and `e_t -> e_t (1 + f)` (`factor`); then `e_n` is at
//! least
//! 0. On capture, the factors `1 + f` of all terms are multiplied with the probability `p` [1], and then `f` of all
//! others is added to its log odds: `b = 0.005 + 0.99 p`, `p -> clamp((logistic(logit(b) + f) - 0.005)/0.99, 0, 1)`.
//! So 0 changes nothing, and 0 and 1 can be moved.
//!
//! `f` is a pure number [1]; knots have the unit of their input. No physics: the values hold for
//! the data of the fit (`valid`). An input of words has a value for each word, and none between
//! them; a word without a value, and a word that is not stated, leave the impact unchanged.

use super::{Effect, EffectInfo, Parameter, Search};
use crate::impact::{ExtraInput, INPUTS, Impact};

/// Largest value [1], either way.
pub(super) const LARGEST_VALUE: f64 = 100.0;

/// Distance that the probability of capture keeps from 0 and 1 while its log odds are shifted [1].
const MARGIN: f64 = 0.005;

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

/// What a curve corrects.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveTarget {
    /// `e_n`.
    NormalRestitution,
    /// `e_t`.
    TangentialRestitution,
    /// The probability of capture, or its log odds.
    Capture,
}

impl CurveTarget {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::NormalRestitution, Self::TangentialRestitution, Self::Capture];

    /// Its name in model files.
    pub fn name(self) -> &'static str {
        ["e_n", "e_t", "capture"][self as usize]
    }
}

/// How a curve corrects.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveForm {
    /// The value is added; on capture to the log odds.
    Add,
    /// One plus the value is a factor.
    Factor,
}

impl CurveForm {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Add, Self::Factor];

    /// Its name in model files.
    pub fn name(self) -> &'static str {
        ["add", "factor"][self as usize]
    }

    /// A number [1] with a correction [1].
    pub fn apply(self, number: f64, value: f64) -> f64 {
        match self {
            Self::Add => number + value,
            Self::Factor => number * (1.0 + value),
        }
    }
}

/// An input of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveInput {
    /// One of [`INPUTS`], by place.
    Input(usize),
    /// A number that the model file declares, by place in [`Impact::extra`].
    Extra(usize),
    /// A word of a list that the model file declares, by place in [`Impact::extra`].
    Label(usize),
}

impl CurveInput {
    /// The value of an impact; NaN where it is not stated.
    pub fn value(self, impact: &Impact) -> f64 {
        match self {
            Self::Input(place) => INPUTS.get(place).map_or(f64::NAN, |input| (input.value)(impact)),
            Self::Extra(place) | Self::Label(place) => impact.extra.get(place).copied().unwrap_or(f64::NAN),
        }
    }

    /// Its name; `extra` are the inputs that the model file declares.
    pub fn name(self, extra: &[ExtraInput]) -> &str {
        match self {
            Self::Input(place) => INPUTS.get(place).map_or("?", |input| input.name),
            Self::Extra(place) | Self::Label(place) => extra.get(place).map_or("?", |input| &input.name),
        }
    }
}

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
    fn place(&self, impact: &Impact) -> Option<(usize, f64)> {
        let value = self.input.value(impact);
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
    pub form: CurveForm,
    /// Its inputs.
    pub axes: Vec<CurveAxis>,
    /// The value [1] at each combination of knots; that of the last axis changes first. A curve
    /// with another number of values corrects nothing.
    pub values: Vec<f64>,
}

impl FittedCurve {
    /// A level of `e_n`; without a value it corrects nothing.
    fn level(values: &[f64]) -> Self {
        let (on, form) = (CurveTarget::NormalRestitution, CurveForm::Add);
        Self { on, form, axes: Vec::new(), values: values.to_vec() }
    }

    /// The correction [1] of an impact, 0 where the curve has none.
    pub fn value(&self, impact: &Impact) -> f64 {
        interpolated(&self.axes, &self.values, impact).unwrap_or(0.0)
    }

    /// The curve in words; `extra` are the inputs that the model file declares.
    pub(super) fn describe(&self, extra: &[ExtraInput]) -> String {
        let on = match (self.on, self.form) {
            (CurveTarget::Capture, CurveForm::Add) => "log odds of capture",
            (CurveTarget::Capture, CurveForm::Factor) => "p_stick",
            (other, _) => other.name(),
        };
        let operation = match self.form {
            CurveForm::Add => format!("{on} + f"),
            CurveForm::Factor => format!("{on} (1 + f)"),
        };
        let [low, high] =
            self.values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
                [low.min(*value), high.max(*value)]
            });
        if self.axes.is_empty() {
            return format!("{operation}, f = {low}");
        }
        let axes: Vec<String> = self.axes.iter().map(|axis| axis.describe(extra)).collect();
        format!("{operation}, f {low} to {high} over {}", axes.join(" and "))
    }
}

impl CurveAxis {
    fn describe(&self, extra: &[ExtraInput]) -> String {
        let name = self.input.name(extra);
        let ends = self.knots.first().zip(self.knots.last());
        match (self.input, ends) {
            (CurveInput::Input(_) | CurveInput::Extra(_), Some((low, high))) => {
                format!("{name} ({} knots from {low} to {high})", self.knots.len())
            }
            _ => format!("{name} ({} labels)", self.knots.len()),
        }
    }
}

/// The value of a grid; `None` where an axis has no value for the impact.
fn interpolated(axes: &[CurveAxis], values: &[f64], impact: &Impact) -> Option<f64> {
    let Some((axis, rest)) = axes.split_first() else {
        let [value] = values else { return None };
        return Some(*value);
    };
    if axis.knots.is_empty() || !values.len().is_multiple_of(axis.knots.len()) {
        return None;
    }
    let block = values.len() / axis.knots.len();
    let (knot, share) = axis.place(impact)?;
    let at = |knot: usize| interpolated(rest, values.get(knot * block..(knot + 1) * block)?, impact);
    let low = at(knot)?;
    if share == 0.0 { Some(low) } else { Some((1.0 - share) * low + share * at(knot + 1)?) }
}

/// A probability of capture [1] with a factor, whose log odds are then shifted.
pub(crate) fn shifted_probability(probability: f64, factor: f64, shift: f64) -> f64 {
    let probability = (factor * probability).clamp(0.0, 1.0);
    if shift == 0.0 {
        return probability;
    }
    let width = 1.0 - 2.0 * MARGIN;
    let plain = MARGIN + width * probability;
    let against = (1.0 - plain) / plain * (-shift).exp();
    ((1.0 / (1.0 + against) - MARGIN) / width).clamp(0.0, 1.0)
}

impl Effect for FittedCurve {
    fn correction(&self) -> Option<&FittedCurve> {
        Some(self)
    }
}
