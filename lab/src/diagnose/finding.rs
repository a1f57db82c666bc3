//! Describes each discovery: its parameters, its alternatives and what cannot be distinguished from it.

use std::collections::{BTreeMap, BTreeSet};

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use statrs::distribution::{ContinuousCDF, Normal};

use super::advice::advise;
use super::candidate::{Addition, ScoredCandidate};
use super::constants::{CERTAINTY_RESAMPLES, NEARLY_BEST};
use super::curve::ColumnCurve;
use super::hypothesis::Hypothesis;
use super::model_selection::{DISTINGUISHABLE_LEAD, Discovery};
use super::observable::Observable;
use super::part::{FittedPart, Part, rounded};
use super::record::{Alternative, Calibration, CauseCurve, CauseSurface, Finding};
use super::smooth::Basis;
use crate::dataset::ColumnValues;
use nearwall::effect::EFFECTS;

/// Gain at which a resample names a cause [nats].
const NOTICEABLE: f64 = 3.0;
/// Least gain of a curve beyond a level at which it is listed beside a level [nats].
const BESIDE_LEVEL: f64 = 0.3;
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
    pub fn finding(&self, Discovery { winner, others, lack_of_fit }: &Discovery) -> Finding {
        let cause = self.name(winner);
        let observable = self.observable(winner);
        let rivals = self.indistinguishable(winner, others);
        let advice =
            |rival: &&ScoredCandidate| advise(&self.alone(winner), &self.alone(rival), &self.name(rival));
        let mut finding = Finding {
            observable: observable.name(),
            variables: winner.addition.variables(self.hypothesis.data),
            gain: winner.gain(),
            chi_square: 2.0 * (winner.gain() + winner.addition.freedom()),
            sigma: sigma(winner.q_value),
            certainty: certainty(winner, others),
            lack_of_fit: *lack_of_fit,
            not_separable: self.final_part(&cause).map(FittedPart::not_separable).unwrap_or_default(),
            p_value: winner.p_value,
            q_value: winner.q_value,
            parameters: self.final_part(&cause).into_iter().flat_map(FittedPart::estimates).collect(),
            alternatives: self.alternatives(winner, others),
            measure_next: rivals.iter().filter_map(advice).collect(),
            indistinguishable_from: rivals.iter().map(|rival| self.name(rival)).collect(),
            curve: self.final_curve(winner).and_then(|curve| self.curve(curve)),
            surface: self.final_curve(winner).and_then(|curve| self.surface(curve)),
            explanation: String::new(),
            cause,
        };
        finding.explanation = explain(&finding, observable);
        finding
    }

    /// The curve of this addition after the final fit.
    fn final_curve(&self, winner: &ScoredCandidate) -> Option<&ColumnCurve> {
        let Addition::Curve(first) = &winner.addition else { return None };
        let data = self.hypothesis.data;
        let key = |curve: &ColumnCurve| (curve.form.name(data), curve.form.observable);
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
                let columns = curve.form.columns(data);
                other.q_value <= self.level && !columns.iter().any(|column| variables.contains(column))
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
        let plain = |name: &String| ["v_n", "d"].contains(&name.as_str());
        let level_like = winner.addition.variables(self.hypothesis.data).iter().all(plain);
        let is_rival = |other: &&ScoredCandidate| {
            let comparable = match &other.addition {
                Addition::Part { .. } => {
                    other.addition.parameters() <= most_parameters || other.gain() > winner.gain()
                }
                // A level shift, a column that no law knows, or beside a cause without an input of
                // its own any column that matters.
                Addition::Curve(curve) => {
                    let input = |column: &usize| self.hypothesis.data.covariates[*column].input;
                    let known = curve.form.sides.iter().any(|side| input(&side.0));
                    !known || (level_like && other.own_gain > BESIDE_LEVEL)
                }
                Addition::ScatterTrend(_) | Addition::BackgroundCapture(_) => false,
            };
            let curve_beside_level =
                level_like && other.own_gain > BESIDE_LEVEL && matches!(other.addition, Addition::Curve(_));
            comparable
                && !other.addition.is_calibration()
                && (other.q_value <= self.level || curve_beside_level)
                && winner.lead(other) < DISTINGUISHABLE_LEAD
        };
        let mut rivals: Vec<&ScoredCandidate> = others.iter().filter(is_rival).collect();
        rivals.sort_by(|a, b| b.gain().total_cmp(&a.gain()));
        // A column may explain e_n and e_t.
        let mut named = BTreeSet::new();
        rivals.retain(|rival| named.insert(self.name(rival)));
        rivals
    }

    /// A curve of one column for the page.
    fn curve(&self, fitted: &ColumnCurve) -> Option<CauseCurve> {
        let [side] = fitted.form.sides.as_slice() else { return None };
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

/// Share of resamples of the rows in which this cause gains something, and about as much as the best other one [1].
fn certainty(winner: &ScoredCandidate, others: &[ScoredCandidate]) -> f64 {
    let rows = winner.differences.len();
    let mut random = ChaCha8Rng::seed_from_u64(0x7375_7265);
    let rivals: Vec<&ScoredCandidate> =
        others.iter().filter(|other| other.addition.is_systematic()).collect();
    let wins = (0..CERTAINTY_RESAMPLES).filter(|_| {
        let drawn: Vec<usize> =
            (0..rows).map(|_| (random.next_u64() % rows.max(1) as u64) as usize).collect();
        let gain = |one: &ScoredCandidate| drawn.iter().map(|&row| one.differences[row]).sum::<f64>();
        let own = gain(winner);
        own > NOTICEABLE && rivals.iter().all(|rival| NEARLY_BEST * gain(rival) <= own)
    });
    wins.count() as f64 / CERTAINTY_RESAMPLES as f64
}

/// The explanation of a finding for a reader.
fn explain(finding: &Finding, observable: Observable) -> String {
    let Finding { cause, variables, indistinguishable_from, .. } = finding;
    let quantity = observable.title();
    if cause.starts_with("unknown:") {
        let columns = variables.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>();
        let noun = if columns.len() > 1 { "columns" } else { "column" };
        return format!(
            "The {quantity} depends on the {noun} {}. No effect of the library explains this dependence.",
            columns.join(" and ")
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
