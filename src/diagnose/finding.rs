//! Describes each discovery: its parameters, its alternatives and what cannot be distinguished from it.

use std::collections::BTreeMap;

use super::advice::advise;
use super::candidate::{Addition, ScoredCandidate};
use super::curve::ColumnCurve;
use super::hypothesis::Hypothesis;
use super::model_selection::{DISTINGUISHABLE, Discovery};
use super::observable::Observable;
use super::part::{FittedPart, Part, rounded};
use super::record::{Alternative, Calibration, Finding, FittedCurve};
use super::smooth::Basis;
use crate::dataset::Values;
use crate::effect::EFFECTS;

/// Largest number of alternatives listed.
const ALTERNATIVES: usize = 6;

/// Builds findings from the final fit.
pub(super) struct FindingBuilder<'a> {
    /// After the final fit.
    pub hypothesis: &'a Hypothesis<'a>,
    /// Accepted share of false discoveries [1].
    pub level: f64,
}

impl FindingBuilder<'_> {
    fn name(&self, scored: &ScoredCandidate) -> String {
        scored.addition.name(self.hypothesis.data)
    }

    /// A part after the final fit.
    fn final_part(&self, name: &str) -> Option<&FittedPart> {
        self.hypothesis.parts.iter().find(|fitted| fitted.part.name() == name)
    }

    /// The recalibrated parameter of a law.
    pub fn calibration(&self, winner: &ScoredCandidate) -> Option<Calibration> {
        let key = self.name(winner);
        let fitted = self.final_part(&key)?;
        let Part::LawParameter(parameter) = fitted.part else { return None };
        let [low, high] = fitted.intervals.first()?.map(rounded);
        Some(Calibration {
            key,
            from: parameter.of(&self.hypothesis.data.base)?,
            value: rounded(*fitted.values().first()?),
            low,
            high,
            p_value: winner.p_value,
            q_value: winner.q_value,
        })
    }

    /// The finding of a cause.
    pub fn finding(&self, Discovery { winner, others }: &Discovery) -> Finding {
        let cause = self.name(winner);
        let observable = self.observable(winner);
        let rivals = self.indistinguishable(winner, others);
        let advice =
            |rival: &&ScoredCandidate| advise(&self.alone(winner), &self.alone(rival), &self.name(rival));
        let mut finding = Finding {
            observable: observable.name(),
            variables: winner.addition.variables(self.hypothesis.data),
            gain: winner.gain(),
            chi_square: 2.0 * winner.gain(),
            sigma: 0.0,
            certainty: 1.0,
            lack_of_fit: None,
            not_separable: Vec::new(),
            p_value: winner.p_value,
            q_value: winner.q_value,
            parameters: self.final_part(&cause).into_iter().flat_map(FittedPart::estimates).collect(),
            alternatives: self.alternatives(winner, others),
            measure_next: rivals.iter().filter_map(advice).collect(),
            indistinguishable_from: rivals.iter().map(|rival| self.name(rival)).collect(),
            curve: self.final_curve(winner).map(|curve| self.curve(curve)),
            explanation: String::new(),
            cause,
        };
        finding.explanation = explain(&finding, observable);
        finding
    }

    /// The curve of this addition after the final fit.
    fn final_curve(&self, winner: &ScoredCandidate) -> Option<&ColumnCurve> {
        let Addition::Curve(first) = &winner.addition else { return None };
        let key = |curve: &ColumnCurve| (curve.form.covariate, curve.form.observable);
        self.hypothesis.curves.iter().find(|curve| key(curve) == key(first))
    }

    /// The observable that a cause changes most, in units of the scatter.
    fn observable(&self, winner: &ScoredCandidate) -> Observable {
        if let Addition::Curve(curve) = &winner.addition {
            return curve.form.observable;
        }
        let base = Hypothesis::with_parts(self.hypothesis.data, Vec::new(), self.hypothesis.scatter);
        let changes = base.changes(&base.forecast(), &self.alone(winner).forecast());
        let larger = |a: &Observable, b: &Observable| changes[*a as usize].total_cmp(&changes[*b as usize]);
        // Of equal changes the first one: a file may contain one observable only.
        Observable::ALL.into_iter().rev().max_by(larger).unwrap_or(Observable::NormalRestitution)
    }

    /// The base model with this candidate alone, if it is a part.
    fn alone(&self, candidate: &ScoredCandidate) -> Hypothesis<'_> {
        let parts = match &candidate.addition {
            Addition::Part { part, .. } => vec![part.clone()],
            _ => Vec::new(),
        };
        Hypothesis::with_parts(self.hypothesis.data, parts, self.hypothesis.scatter)
    }

    /// The best candidates of other causes in the round.
    fn alternatives(&self, winner: &ScoredCandidate, others: &[ScoredCandidate]) -> Vec<Alternative> {
        let data = self.hypothesis.data;
        let variables = winner.addition.variables(data);
        let is_rival = |other: &&ScoredCandidate| match &other.addition {
            Addition::Part { .. } => true,
            // A curve over the winner's own inputs is no other cause, and an insignificant one is mostly its constant.
            Addition::Curve(curve) => {
                other.q_value <= self.level
                    && !variables.contains(&data.covariates[curve.form.covariate].name)
            }
            Addition::ScatterTrend(_) | Addition::BackgroundCapture(_) => false,
        };
        let mut best: BTreeMap<String, f64> = BTreeMap::new();
        for other in others.iter().filter(is_rival) {
            let difference = winner.gain() - other.gain();
            let kept = best.entry(self.name(other)).or_insert(difference);
            *kept = kept.min(difference);
        }
        let of = |(cause, score_difference)| Alternative { cause, score_difference };
        let mut all: Vec<Alternative> = best.into_iter().map(of).collect();
        all.sort_by(|a, b| a.score_difference.total_cmp(&b.score_difference));
        all.truncate(ALTERNATIVES);
        all
    }

    /// Significant causes that are not distinguishable from the winner and not more flexible, the best first.
    fn indistinguishable<'b>(
        &self,
        winner: &ScoredCandidate,
        others: &'b [ScoredCandidate],
    ) -> Vec<&'b ScoredCandidate> {
        let most_parameters = winner.addition.parameters().max(2);
        let is_rival = |other: &&ScoredCandidate| {
            let comparable = match &other.addition {
                Addition::Part { .. } => {
                    other.addition.parameters() <= most_parameters || other.gain() > winner.gain()
                }
                Addition::Curve(curve) => !self.hypothesis.data.covariates[curve.form.covariate].input,
                Addition::ScatterTrend(_) | Addition::BackgroundCapture(_) => false,
            };
            comparable
                && !other.addition.is_calibration()
                && other.q_value <= self.level
                && winner.lead(other) < DISTINGUISHABLE
        };
        let mut rivals: Vec<&ScoredCandidate> = others.iter().filter(is_rival).collect();
        rivals.sort_by(|a, b| b.gain().total_cmp(&a.gain()));
        rivals.dedup_by_key(|rival| self.name(rival));
        rivals
    }

    fn curve(&self, fitted: &ColumnCurve) -> FittedCurve {
        let at = match (&fitted.form.basis, self.hypothesis.data.values(fitted.form.covariate)) {
            (Basis::Hats(knots), _) => knots.iter().map(|knot| rounded(*knot).to_string()).collect(),
            (Basis::Labels(_), Values::Labels { levels, .. }) => levels.clone(),
            _ => Vec::new(),
        };
        let adds = fitted.heights.iter().map(|height| rounded(*height)).collect();
        FittedCurve { factor: fitted.form.multiplicative, at, adds }
    }
}

/// The explanation of a finding for a reader.
fn explain(finding: &Finding, observable: Observable) -> String {
    let Finding { cause, variables, indistinguishable_from, .. } = finding;
    let quantity = observable.title();
    if let Some(column) = cause.strip_prefix("unknown:") {
        return format!(
            "The {quantity} depends on the column `{column}`. No effect of the library explains this dependence."
        );
    }
    let about = EFFECTS.iter().find(|effect| effect.id == cause).map_or("", |effect| effect.about);
    let mut text = format!("The effect `{cause}` is significant for the {quantity}: {about}.");
    if !variables.is_empty() {
        text += &format!(" The effect depends on {}.", variables.join(", "));
    }
    if !indistinguishable_from.is_empty() {
        text += &format!(" These data cannot distinguish it from {}.", indistinguishable_from.join(", "));
    }
    text
}
