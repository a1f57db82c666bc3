//! One statement of a source beside what the library says of it.

use nearwall::report::number;

/// What a source prints about a quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Published {
    /// A value that holds between two ends: its stated uncertainty, or half a digit of a number as it is printed.
    Value {
        /// As printed.
        value: f64,
        /// Smallest value that still agrees.
        low: f64,
        /// Largest value that still agrees.
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
    /// A number that is right to `tolerance` (same unit): a stated uncertainty, or half of its last digit.
    pub fn within(value: f64, tolerance: f64) -> Self {
        Self::Value { value, low: value - tolerance, high: value + tolerance }
    }

    /// Whether a number agrees.
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

/// A number that a source does not print but whose counts imply: three digits say enough.
fn short(value: f64) -> String {
    number(format!("{value:.2e}").parse().unwrap_or(value))
}

/// Where our number comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// From the model and the source's inputs; the number itself was not used.
    Predicted,
    /// A parameter of the model was set so that it comes out: agreement proves little.
    Fitted,
    /// Follows from equations alone, without a material's numbers.
    Derived,
}

impl Basis {
    /// One word for a table.
    pub fn name(self) -> &'static str {
        match self {
            Self::Predicted => "predicted",
            Self::Fitted => "fitted",
            Self::Derived => "derived",
        }
    }
}

/// How a statement stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Our number lies where the source says.
    Agrees,
    /// It does not; the claim says why.
    Differs,
    /// The source does not give what it takes to compare; the claim says what is missing.
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

/// A statement of a source and what the library says of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// Where in the source: `Fig 6`, `Table 4`.
    pub place: String,
    /// What it is about, in words, with the unit.
    pub what: String,
    /// What the source says.
    pub published: String,
    /// What the library says.
    pub ours: String,
    /// Where our number comes from.
    pub basis: Basis,
    /// How it stands.
    pub verdict: Verdict,
    /// Why it differs or cannot be checked; where it agrees, what one has to know about it. May be empty where it agrees.
    pub why: String,
}

impl Claim {
    /// Compares a number of ours with a published one; the verdict follows from the two.
    pub fn number(place: &str, what: &str, published: Published, ours: f64, basis: Basis) -> Self {
        let verdict = if published.holds(ours) { Verdict::Agrees } else { Verdict::Differs };
        Self {
            place: place.to_owned(),
            what: what.to_owned(),
            published: published.text(),
            ours: number(ours),
            basis,
            verdict,
            why: String::new(),
        }
    }

    /// A statement in words, which holds or does not.
    pub fn statement(
        place: &str,
        what: &str,
        published: &str,
        ours: &str,
        holds: bool,
        basis: Basis,
    ) -> Self {
        Self {
            place: place.to_owned(),
            what: what.to_owned(),
            published: published.to_owned(),
            ours: ours.to_owned(),
            basis,
            verdict: if holds { Verdict::Agrees } else { Verdict::Differs },
            why: String::new(),
        }
    }

    /// A statement that nothing can be held against; `why` says what is missing.
    pub fn unchecked(place: &str, what: &str, published: &str, why: &str) -> Self {
        Self {
            place: place.to_owned(),
            what: what.to_owned(),
            published: published.to_owned(),
            ours: "–".to_owned(),
            basis: Basis::Predicted,
            verdict: Verdict::Unchecked,
            why: why.to_owned(),
        }
    }

    /// Where our number comes from, in a word for a table.
    pub fn basis_name(&self) -> &'static str {
        if self.verdict == Verdict::Unchecked { "–" } else { self.basis.name() }
    }

    /// Why it stands as it stands.
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
        let claim =
            |ours| Claim::number("Fig 1", "e_n", Published::within(0.28, 0.005), ours, Basis::Predicted);
        assert_eq!(claim(0.284).verdict, Verdict::Agrees);
        assert_eq!(claim(0.286).verdict, Verdict::Differs);
        assert_eq!(claim(0.284).published, "0.28 ± 0.005");
        assert!(!Published::Above(0.85).holds(0.85) && Published::Below(0.6).holds(0.59));
        assert!(!Published::within(1.0, 0.1).holds(f64::NAN));
    }
}
