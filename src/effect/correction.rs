//! What fitted corrections have in common: on what they act, and how.
//!
//! After all laws and effects, in the order of the file, a correction with the value `f` [1] makes
//! `e_n -> e_n + f` and `e_t -> e_t + f` (`add`), `e_n -> e_n (1 + f)` and `e_t -> e_t (1 + f)`
//! (`factor`), `e_n -> e_n f` and `e_t -> e_t f` (`times`), or `e_n -> f` and `e_t -> f` (`set`); then
//! `e_n` is at least 0. On capture, `set` replaces
//! the probability `p` [1] and what corrections before it did to `p`; the factors `1 + f` and `f` of all others are
//! multiplied with `p`, and then their `f` is added to its log odds: `b = 0.005 + 0.99 p`, `p ->
//! clamp((logistic(logit(b) + f) - 0.005)/0.99, 0, 1)`. So 0 added changes nothing, and 0 and 1 can be moved.

use super::CurveInput;
use crate::group::{Circumstances, Declared};

/// Largest value [1], either way.
pub(super) const LARGEST_VALUE: f64 = 100.0;

/// Distance that the probability of capture keeps from 0 and 1 while its log odds are shifted [1].
const MARGIN: f64 = 0.005;

/// What a correction acts on.
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

/// How a correction acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operation {
    /// The value is added; on capture to the log odds.
    Add,
    /// One plus the value is a factor.
    Factor,
    /// The value is a factor; curves do not offer it.
    Times,
    /// The value replaces the number; curves do not offer it.
    Set,
}

impl Operation {
    /// Those of curves.
    pub const OF_CURVES: [Self; 2] = [Self::Add, Self::Factor];
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Add, Self::Factor, Self::Times, Self::Set];

    /// Its name in model files.
    pub fn name(self) -> &'static str {
        ["add", "factor", "times", "set"][self as usize]
    }

    /// A number [1] with a correction [1].
    pub fn apply(self, number: f64, value: f64) -> f64 {
        match self {
            Self::Add => number + value,
            Self::Factor => number * (1.0 + value),
            Self::Times => number * value,
            Self::Set => value,
        }
    }

    /// What it makes of `e_n`, `e_t` or capture with the value `f`, in words.
    pub(super) fn describe(self, on: CurveTarget) -> String {
        let name = match (on, self) {
            (CurveTarget::Capture, Self::Add) => "log odds of capture",
            (CurveTarget::Capture, _) => "p_stick",
            (other, _) => other.name(),
        };
        match self {
            Self::Add => format!("{name} + f"),
            Self::Factor => format!("{name} (1 + f)"),
            Self::Times => format!("{name} f"),
            Self::Set => format!("{name} = f"),
        }
    }
}

/// A correction after all laws and effects.
pub trait Correction {
    /// What it acts on.
    fn on(&self) -> CurveTarget;

    /// How it acts.
    fn acts(&self) -> Operation;

    /// Its value `f` [1] for an impact; `None` where it has none and leaves the impact unchanged.
    fn value(&self, of: &dyn Circumstances) -> Option<f64>;

    /// The inputs and groups that it depends on.
    fn inputs(&self) -> Vec<CurveInput>;

    /// The correction in words, with the names that the model file declares.
    fn describe(&self, declared: &Declared<'_>) -> String;
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
