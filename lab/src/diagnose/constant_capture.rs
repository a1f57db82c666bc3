//! What captures have in common beside all laws and columns: a background rate and a ceiling.
//!
//! Of the probability of capture `p` by the laws, at most the ceiling `c` [1] is captured, because a
//! few particles bounce for another reason or are missed; the rate `f` is added to the log odds:
//! `b = 0.005 + 0.99 c p`, `P = logistic(logit(b) + f)`.

use super::likelihood::Offset;

/// Least ceiling that is one [1]: below, most of what the laws capture is not.
const LEAST_CEILING: f64 = 0.5;
/// Ceiling from which a fit starts [1].
const FIRST_CEILING: f64 = 0.9;

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

    /// The same with a ceiling to be fitted.
    pub fn free(self) -> Self {
        Self { ceiling: self.ceiling.or(Some(FIRST_CEILING)), ..self }
    }

    /// Number of fitted parameters.
    pub fn freedom(&self) -> f64 {
        CaptureConstant::ALL.into_iter().filter(|one| self.has(*one)).count() as f64
    }

    /// An offset of a row with both.
    #[inline]
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The likelihood of 30 and 45 captures of 100 impacts each, with 0.4 and 0.8 by the laws, is largest at
    /// `c = 0.610`: by a table of `30 ln 0.4 c + 70 ln(1 - 0.4 c) + 45 ln 0.8 c + 55 ln(1 - 0.8 c)`.
    #[test]
    fn the_ceiling_has_the_largest_likelihood() {
        let log_likelihood = |c: f64| {
            [(30.0, 0.4), (45.0, 0.8)]
                .map(|(captured, p): (f64, f64)| {
                    captured * (p * c).ln() + (100.0 - captured) * (1.0 - p * c).ln()
                })
                .iter()
                .sum::<f64>()
        };
        let mut found = ConstantCapture { rate: 0.0, ceiling: Some(FIRST_CEILING) };
        for _ in 0..20 {
            let ceiling = found.ceiling.unwrap();
            let rows = [[100.0, 0.3, 0.4 * ceiling], [100.0, 0.45, 0.8 * ceiling]];
            found = found.stepped(rows.into_iter());
        }
        let table = (501..1000).map(|c| f64::from(c) / 1000.0);
        let best = table.max_by(|a, b| log_likelihood(*a).total_cmp(&log_likelihood(*b))).unwrap();
        assert!((found.ceiling.unwrap() - best).abs() < 1e-3, "{found:?}, {best}");
        assert!(!found.at_bound());
        let few = found.stepped([[100.0, 0.01, 0.5]].into_iter());
        assert!(few.at_bound() && !ConstantCapture::default().at_bound());
    }
}
