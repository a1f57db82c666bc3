//! What captures have in common beside all laws and columns: a background rate and a ceiling.
//!
//! Of the probability of capture `p` by the laws, at most the ceiling `c` [1] is captured, because a
//! few particles bounce for another reason or are missed; the rate `f` is added to the log odds:
//! `b = 0.005 + 0.99 c p`, `P = logistic(logit(b) + f)`.

use super::likelihood::Offset;

/// Least ceiling that is one [1]: below, most of what the laws capture is not.
const LEAST_CEILING: f64 = 0.5;
/// Ceiling from which a fit starts [1].
pub(super) const FIRST_CEILING: f64 = 0.9;

/// One of the two.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CaptureConstant {
    Rate,
    Ceiling,
}

impl CaptureConstant {
    pub const ALL: [Self; 2] = [Self::Rate, Self::Ceiling];

    /// The id of the addition.
    pub fn name(self) -> &'static str {
        ["background-capture", "capture-ceiling"][self as usize]
    }
}

/// Both.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct ConstantCapture {
    /// Offset of the log odds of capture [1]; 0 for none.
    pub rate: f64,
    /// Factor on the probability of capture [1]; `None` for none.
    pub ceiling: Option<f64>,
}

impl ConstantCapture {
    /// Whether it has one of the two.
    pub fn has(&self, constant: CaptureConstant) -> bool {
        match constant {
            CaptureConstant::Rate => self.rate != 0.0,
            CaptureConstant::Ceiling => self.ceiling.is_some(),
        }
    }

    /// The same without one of the two.
    pub fn without(self, constant: CaptureConstant) -> Self {
        match constant {
            CaptureConstant::Rate => Self { rate: 0.0, ..self },
            CaptureConstant::Ceiling => Self { ceiling: None, ..self },
        }
    }

    /// Number of fitted parameters.
    pub fn freedom(&self) -> f64 {
        CaptureConstant::ALL.into_iter().filter(|one| self.has(*one)).count() as f64
    }

    /// An offset of a row with both.
    pub fn beside(&self, offset: &Offset) -> Offset {
        let ceiling = self.ceiling.unwrap_or(1.0);
        Offset { capture: offset.capture + self.rate, ceiling: offset.ceiling * ceiling, ..*offset }
    }

    /// Whether the ceiling is at the bound of its range.
    pub fn at_bound(&self) -> bool {
        self.ceiling.is_some_and(|ceiling| ceiling <= LEAST_CEILING)
    }

    /// The ceiling after one step of Fisher's scoring: rows with their number of impacts, the share
    /// captured and the predicted one, each [1].
    pub fn stepped(&self, rows: impl Iterator<Item = [f64; 3]>) -> Self {
        let Some(ceiling) = self.ceiling else { return *self };
        let sums = rows.fold([0.0; 2], |[slope, information], [impacts, captured, predicted]| {
            let by_ceiling = predicted / ceiling;
            let variance = predicted * (1.0 - predicted);
            let weight = impacts * by_ceiling / variance;
            [slope + weight * (captured - predicted), information + weight * by_ceiling]
        });
        let next = ceiling + sums[0] / sums[1];
        let next = if next.is_finite() { next.clamp(LEAST_CEILING, 1.0) } else { ceiling };
        Self { ceiling: Some(next), ..*self }
    }
}
