//! Claims: a statement of a source, the library's number, and the verdict.

use nearwall_lab::report::number;

/// A published quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Published {
    /// A value with an interval: its stated uncertainty, or half of the last printed digit.
    Value {
        /// As printed.
        value: f64,
        /// Lower end of the interval.
        low: f64,
        /// Upper end of the interval.
        high: f64,
    },
    /// Below this.
    Below(f64),
    /// Above this.
    Above(f64),
    /// Between two ends.
    Between(f64, f64),
}

impl Published {
    /// A value with a symmetric interval of half-width `tolerance` (same unit).
    pub fn within(value: f64, tolerance: f64) -> Self {
        Self::Value { value, low: value - tolerance, high: value + tolerance }
    }

    /// Whether a number agrees with it.
    pub fn holds(self, ours: f64) -> bool {
        match self {
            Self::Value { low, high, .. } | Self::Between(low, high) => (low..=high).contains(&ours),
            Self::Below(limit) => ours < limit,
            Self::Above(limit) => ours > limit,
        }
    }

    fn text(self) -> String {
        match self {
            Self::Value { value, low, high } => {
                let (below, above) = (value - low, high - value);
                if (below - above).abs() <= 1e-9 * value.abs().max(1e-30) {
                    format!("{} ± {}", number(value), number(above))
                } else {
                    format!("{} ({} to {})", short(value), short(low), short(high))
                }
            }
            Self::Below(limit) => format!("< {}", number(limit)),
            Self::Above(limit) => format!("> {}", number(limit)),
            Self::Between(low, high) => format!("{} to {}", number(low), number(high)),
        }
    }
}

/// Rounded to three digits, for numbers that follow from published counts.
fn short(value: f64) -> String {
    number(format!("{value:.2e}").parse().unwrap_or(value))
}

/// Origin of the computed number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ClaimBasis {
    /// Computed from the model and the source's inputs; the published number was not used.
    Predicted,
    /// A parameter of the model was fitted to the published number, so agreement proves little.
    Fitted,
    /// Follows from equations alone, without material data.
    Derived,
}

impl ClaimBasis {
    /// One word for a table.
    pub fn name(self) -> &'static str {
        match self {
            Self::Predicted => "predicted",
            Self::Fitted => "fitted",
            Self::Derived => "derived",
        }
    }

    /// A claim that compares a computed number with a published one; the verdict follows from the two.
    pub fn number(self, place: &str, what: &str, published: Published, ours: f64) -> Claim {
        self.statement(place, what, &published.text(), &number(ours), published.holds(ours))
    }

    /// A claim in words that holds or does not.
    pub fn statement(self, place: &str, what: &str, published: &str, ours: &str, holds: bool) -> Claim {
        Claim {
            place: place.to_owned(),
            what: what.to_owned(),
            published: published.to_owned(),
            ours: ours.to_owned(),
            basis: self,
            verdict: if holds { Verdict::Agrees } else { Verdict::Differs },
            why: String::new(),
        }
    }
}

/// Result of a comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// The computed number lies in the published interval.
    Agrees,
    /// It does not; the claim gives the reason.
    Differs,
    /// The source lacks data for a comparison; the claim says which.
    Unchecked,
}

impl Verdict {
    /// Words for a table.
    pub fn name(self) -> &'static str {
        match self {
            Self::Agrees => "agrees",
            Self::Differs => "differs",
            Self::Unchecked => "cannot be checked",
        }
    }
}

/// A statement of a source and the library's result.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// Place in the source: `Fig 6`, `Table 4`.
    pub place: String,
    /// The quantity, with its unit.
    pub what: String,
    /// The published value.
    pub published: String,
    /// The library's value.
    pub ours: String,
    /// Origin of the library's value.
    pub basis: ClaimBasis,
    /// Result of the comparison.
    pub verdict: Verdict,
    /// Reason for a difference, or a remark. May be empty only if the claim agrees.
    pub why: String,
}

impl Claim {
    /// A comparison of numbers. The published number was not used.
    pub fn predicted(place: &str, what: &str, published: Published, ours: f64) -> Self {
        ClaimBasis::Predicted.number(place, what, published, ours)
    }

    /// A statement in words. The published number was not used.
    pub fn predicted_statement(place: &str, what: &str, published: &str, ours: &str, holds: bool) -> Self {
        ClaimBasis::Predicted.statement(place, what, published, ours, holds)
    }

    /// A comparison of numbers. A parameter was fitted to the number.
    pub fn fitted(place: &str, what: &str, published: Published, ours: f64) -> Self {
        ClaimBasis::Fitted.number(place, what, published, ours)
    }

    /// A statement in words. A parameter was fitted to the number.
    pub fn fitted_statement(place: &str, what: &str, published: &str, ours: &str, holds: bool) -> Self {
        ClaimBasis::Fitted.statement(place, what, published, ours, holds)
    }

    /// A comparison of numbers. It follows from equations alone.
    pub fn derived(place: &str, what: &str, published: Published, ours: f64) -> Self {
        ClaimBasis::Derived.number(place, what, published, ours)
    }

    /// A statement in words. It follows from equations alone.
    pub fn derived_statement(place: &str, what: &str, published: &str, ours: &str, holds: bool) -> Self {
        ClaimBasis::Derived.statement(place, what, published, ours, holds)
    }

    /// A claim that cannot be checked; `why` says what is missing.
    pub fn unchecked(place: &str, what: &str, published: &str, why: &str) -> Self {
        let claim = Self::predicted_statement(place, what, published, "–", false);
        Self { verdict: Verdict::Unchecked, ..claim }.because(why)
    }

    /// Origin of the library's value, in one word for a table.
    pub fn basis_name(&self) -> &'static str {
        if self.verdict == Verdict::Unchecked { "–" } else { self.basis.name() }
    }

    /// Adds the reason or remark.
    #[must_use]
    pub fn because(mut self, why: &str) -> Self {
        why.clone_into(&mut self.why);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_verdict_follows_from_the_numbers() {
        let claim = |ours| Claim::predicted("Fig 1", "e_n", Published::within(0.28, 0.005), ours);
        assert_eq!(claim(0.284).verdict, Verdict::Agrees);
        assert_eq!(claim(0.286).verdict, Verdict::Differs);
        assert_eq!(claim(0.284).published, "0.28 ± 0.005");
        assert!(!Published::Above(0.85).holds(0.85) && Published::Below(0.6).holds(0.59));
        assert!(!Published::within(1.0, 0.1).holds(f64::NAN));
    }
}
