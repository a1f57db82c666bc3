//! Describes each discovery: its parameters, its alternatives and what cannot be distinguished from it.

use statrs::distribution::{ContinuousCDF, Normal};

use super::advice::advise;
use super::candidate::{Addition, ScoredCandidate};
use super::choice::CauseChoice;
use super::curve::ColumnCurve;
use super::explanations::FoundExplanation;
use super::form_finding;
use super::hypothesis::Hypothesis;
use super::observable::Observable;
use super::part::{FittedPart, Part, rounded};
use super::reach::Reach;
use super::record::{Calibration, CauseCurve, CauseForm, CauseSurface, Finding, NextMeasurement};
use super::smooth::Basis;
use crate::dataset::ColumnValues;
use nearwall::effect::EFFECTS;
use nearwall::group::GROUPS;

/// Builds findings from the final fit.
pub(super) struct FindingBuilder<'a> {
    /// After the final fit.
    pub hypothesis: &'a Hypothesis<'a>,
    pub choice: &'a CauseChoice,
    /// What can be varied in the next measurement.
    pub reach: &'a [Reach],
}

/// Most explanations from which the most probable one is told by a measurement.
const MOST_TOLD: usize = 3;

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
    pub fn finding(&self, winner: &ScoredCandidate) -> Finding {
        let cause = self.name(winner);
        let observable = self.observable(winner);
        let explanations = &self.choice.explanations;
        let rivals = explanations.in_stead_of(&cause);
        let advice = |rival: &String| {
            let other = self.alone(self.choice.addition(rival)?);
            advise([&self.alone(winner), &other], [&cause, rival], self.reach)
        };
        let form = self.final_curve(winner).and_then(|curve| form_finding::found(self.hypothesis, curve));
        let estimates = form.iter().flat_map(|form| form.parameters.clone()).collect::<Vec<_>>();
        let part = self.final_part(&cause).into_iter().flat_map(FittedPart::estimates);
        let mut finding = Finding {
            observable: observable.name(),
            variables: winner.addition.variables(self.hypothesis.data),
            gain: winner.gain(),
            chi_square: 2.0 * (winner.gain() + winner.addition.freedom()),
            sigma: sigma(winner.q_value),
            probability: explanations.probability_of_any(&winner.addition.names(self.hypothesis.data, false)),
            certainty: explanations.certainty(&cause),
            lack_of_fit: self.lack_of_fit(winner),
            not_separable: self.final_part(&cause).map(FittedPart::not_separable).unwrap_or_default(),
            p_value: winner.p_value,
            q_value: winner.q_value,
            parameters: part.chain(estimates).collect(),
            alternatives: explanations.alternatives(&cause),
            measure_next: rivals.iter().filter_map(&advice).collect(),
            indistinguishable_from: rivals,
            curve: self.final_curve(winner).and_then(|curve| self.curve(curve)),
            forms: form.into_iter().collect(),
            surface: self.final_curve(winner).and_then(|curve| self.surface(curve)),
            explanation: String::new(),
            cause,
        };
        let level = self.final_curve(winner).filter(|curve| curve.is_level());
        finding.explanation =
            level.map_or_else(|| explain(&finding, observable), |level| explain_level(level, observable));
        finding
    }

    /// The measurements that tell the most probable explanation from the others.
    pub fn separating(&self) -> Vec<NextMeasurement> {
        let mut listed = self.choice.explanations.listed().iter().filter(|one| one.is_physics());
        let Some(first) = listed.next() else { return Vec::new() };
        let measurement = |other: &FoundExplanation<ScoredCandidate>| {
            let names = [first, other].map(|one| one.told.causes.join(" and "));
            let [one, two] = [first, other].map(|one| self.explained(one));
            advise([&one, &two], [&names[0], &names[1]], self.reach)
        };
        listed
            .filter(|one| one.told.causes != first.told.causes)
            .take(MOST_TOLD)
            .filter_map(measurement)
            .collect()
    }

    /// The base model with what an explanation adds.
    fn explained(&self, one: &FoundExplanation<ScoredCandidate>) -> Hypothesis<'_> {
        let mut hypothesis =
            Hypothesis::with_parts(self.hypothesis.data, Vec::new(), self.hypothesis.scatter);
        one.told.additions.iter().for_each(|scored| scored.addition.add_to(&mut hypothesis));
        hypothesis
    }

    /// The curve of this addition after the final fit.
    fn final_curve(&self, winner: &ScoredCandidate) -> Option<&ColumnCurve> {
        let Addition::Curve(first) = &winner.addition else { return None };
        let data = self.hypothesis.data;
        self.hypothesis.curves.iter().find(|curve| curve.form.key(data) == first.form.key(data))
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

    /// p-value of a free surface over the inputs of a law beside the law.
    fn lack_of_fit(&self, winner: &ScoredCandidate) -> Option<f64> {
        let Addition::Part { .. } = winner.addition else { return None };
        let mut with = self.hypothesis.clone();
        with.fit_discrepancy();
        with.lack_of_fit()
    }

    /// A curve of one column for the page.
    fn curve(&self, fitted: &ColumnCurve) -> Option<CauseCurve> {
        let [side] = fitted.form.sides.as_slice() else { return None };
        if fitted.closed.is_some() {
            return None;
        }
        let adds = fitted.heights.iter().map(|height| rounded(*height)).collect();
        Some(CauseCurve { factor: fitted.form.multiplicative, at: self.places(side), adds })
    }

    /// A surface over two columns for the page.
    fn surface(&self, fitted: &ColumnCurve) -> Option<CauseSurface> {
        let [one, two] = fitted.form.sides.as_slice() else { return None };
        let at = [one, two].map(|side| self.places(side));
        let row = |heights: &[f64]| heights.iter().map(|height| rounded(*height)).collect();
        let adds = fitted.heights.chunks(at[1].len().max(1)).map(row).collect();
        Some(CauseSurface { factor: fitted.form.multiplicative, at, adds })
    }

    /// The knots or the labels of a side of a curve.
    fn places(&self, (column, basis): &(usize, Basis)) -> Vec<String> {
        match (basis, self.hypothesis.data.values(*column)) {
            (Basis::Hats(knots), _) => knots.iter().map(|knot| rounded(*knot).to_string()).collect(),
            (Basis::Labels(_), ColumnValues::Labels { levels, .. }) => levels.clone(),
            _ => Vec::new(),
        }
    }
}

/// Standard deviations of a normal distribution with this tail.
pub(super) fn sigma(p_value: f64) -> f64 {
    let p = p_value.clamp(1e-300, 0.5);
    // The quantile by its asymptotic form, where the tail is too thin for an inverse.
    let far = (-2.0 * p.ln() - (std::f64::consts::TAU * -2.0 * p.ln()).ln()).sqrt();
    if p < 1e-12 { far } else { Normal::standard().inverse_cdf(1.0 - p) }
}

impl Finding {
    /// Adds what the same cause does to another observable.
    pub(super) fn join(&mut self, other: Self) {
        self.explanation += &other.forms.iter().map(equation).collect::<String>();
        self.forms.extend(other.forms);
    }
}

/// A closed form in a sentence.
pub(super) fn equation(form: &CauseForm) -> String {
    let mut text = format!(" Its form: {}", form.equation);
    if let [first, ..] = form.others.as_slice() {
        text += &format!(
            " (probability {:.2} among forms; {} {:.2})",
            form.probability, first.form, first.probability
        );
    }
    text += ".";
    if let Some(law) = form.resembles {
        text += &format!(" It looks like {law}.");
    }
    text
}

/// A dimensionless group with its formula; `None` for any other name.
pub(super) fn group_words(name: &str) -> Option<String> {
    let group = GROUPS.iter().find(|group| group.name == name)?;
    Some(format!("group {} = {}", group.name, group.formula))
}

/// The explanation of a level for a reader.
fn explain_level(level: &ColumnCurve, observable: Observable) -> String {
    let shift = level.heights.first().copied().unwrap_or(0.0);
    let from_model = match level.form.multiplicative {
        true => format!("are {:.3} times those of the model", 1.0 + shift),
        false if shift < 0.0 => format!("lie {:.3} below the model", -shift),
        false => format!("lie {shift:.3} above the model"),
    };
    format!(
        "All readings of the {} {from_model}: an error of the instrument, or a wrong level of the model.",
        observable.title()
    )
}

/// The explanation of a finding for a reader.
fn explain(finding: &Finding, observable: Observable) -> String {
    let Finding { cause, variables, indistinguishable_from, .. } = finding;
    let quantity = observable.title();
    if cause.starts_with("unknown:") {
        let columns = variables.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>();
        let noun = variables.first().and_then(|name| group_words(name));
        let noun = noun.unwrap_or_else(|| match columns.as_slice() {
            [_, _, ..] => format!("columns {}", columns.join(" and ")),
            _ => format!("column {}", columns.join("")),
        });
        let is_law = |name: &&String| EFFECTS.iter().any(|effect| effect.id == **name);
        let laws: Vec<&str> = indistinguishable_from.iter().filter(is_law).map(String::as_str).collect();
        let text = match laws.as_slice() {
            [] => "No effect of the library explains this dependence.".to_owned(),
            laws => {
                format!("{} may explain this dependence: these data do not exclude it.", laws.join(" or "))
            }
        };
        let text = format!("The {quantity} depends on the {noun}. {text}");
        return finding.forms.iter().fold(text, |text, form| text + &equation(form));
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
