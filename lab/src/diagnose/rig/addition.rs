//! What a rig's data can add to the wall law: an effect, another value of a law's own number, a
//! level or a curve over an input.

use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Table, Value, value};

use super::super::extend::{curve_effect, effect, list, with_effects};
use super::super::part::{FittedPart, Part, rounded};
use super::super::record::Estimate;
use super::super::search::SearchAxis;
use crate::rig::{CaseNumber, FARTHEST};
use nearwall::effect::{CurveAxis, CurveForm, CurveInput, CurveTarget, FittedCurve, Term};
use nearwall::group::Declared;
use nearwall::impact::INPUTS;
use nearwall::model::Model;

/// Largest value of a curve or a level: of `e_n` and `e_t` as a share, of capture in log odds.
const RESTITUTION_REACH: f64 = 0.8;
const CAPTURE_REACH: f64 = 7.0;

/// A kind of addition.
#[derive(Debug, Clone)]
pub(super) enum Kind {
    Part(Part),
    /// A curve over one of [`INPUTS`], by place, with its knots; a level without any.
    Curve {
        on: CurveTarget,
        over: Option<(usize, Vec<f64>)>,
    },
    /// Another value of a number of the case, by place; the parameter is its distance from the case's
    /// value in standard errors.
    Case {
        place: usize,
        number: CaseNumber,
    },
}

/// An addition with the values of its parameters.
#[derive(Debug, Clone)]
pub(super) struct RigAddition {
    pub kind: Kind,
    pub axes: Vec<SearchAxis>,
    /// Coordinates on the axes.
    pub at: Vec<f64>,
    /// 95 % intervals of the parameters in SI units; empty before the final fit.
    pub intervals: Vec<[f64; 2]>,
}

impl RigAddition {
    /// An effect or a law's number; `range` gives the least and largest value of an input. `None`
    /// if the impacts do not vary in what it depends on.
    pub fn part(part: Part, range: impl Fn(&str) -> Option<[f64; 2]>) -> Option<Self> {
        let axes = part.axes(range, false)?;
        Some(Self { kind: Kind::Part(part), at: vec![0.5; axes.len()], axes, intervals: Vec::new() })
    }

    /// A curve over an input with these knots; a level without any.
    pub fn curve(on: CurveTarget, over: Option<(usize, Vec<f64>)>) -> Self {
        let reach = if on == CurveTarget::Capture { CAPTURE_REACH } else { RESTITUTION_REACH };
        let count = over.as_ref().map_or(1, |(_, knots)| knots.len());
        Self {
            kind: Kind::Curve { on, over },
            axes: vec![SearchAxis::linear(-reach, reach); count],
            at: vec![0.5; count],
            intervals: Vec::new(),
        }
    }

    /// A number of the case that is grossly wrong.
    pub fn case(place: usize, number: CaseNumber) -> Self {
        Self {
            kind: Kind::Case { place, number },
            axes: vec![SearchAxis::linear(-FARTHEST, FARTHEST)],
            at: vec![0.5],
            intervals: Vec::new(),
        }
    }

    /// The number of the case that it changes, with its place and its distance in standard errors.
    pub fn case_number(&self) -> Option<(usize, &CaseNumber, f64)> {
        let Kind::Case { place, number } = &self.kind else { return None };
        Some((*place, number, *self.values().first()?))
    }

    /// The same at other coordinates.
    pub fn moved(&self, at: &[f64]) -> Self {
        Self { at: at.to_vec(), ..self.clone() }
    }

    /// The id of the cause.
    pub fn name(&self) -> String {
        match &self.kind {
            Kind::Part(part) => part.name(),
            Kind::Curve { over: Some((input, _)), .. } => format!("unknown:{}", input_name(*input)),
            Kind::Curve { on, over: None } => format!("level:{}", on.name()),
            Kind::Case { number, .. } => format!("case:{}", number.key),
        }
    }

    /// Tells it from all other additions: a curve over one input may act on several observables.
    pub fn key(&self) -> String {
        match &self.kind {
            Kind::Part(_) | Kind::Case { .. } => self.name(),
            Kind::Curve { on, .. } => format!("{} on {}", self.name(), on.name()),
        }
    }

    /// The present value of a law's number in a model.
    pub fn present(&self, model: &Model) -> Option<f64> {
        if let Kind::Part(Part::LawParameter(parameter)) = self.kind { parameter.of(model) } else { None }
    }

    /// Whether it is an effect with a parameter at the bound of its range: no law then, whatever it gains.
    pub fn at_bound(&self) -> bool {
        let is_effect = matches!(self.kind, Kind::Part(Part::Effect(_)));
        is_effect && self.fitted().is_some_and(|part| part.at_bound())
    }

    /// The inputs that it depends on.
    pub fn variables(&self) -> Vec<String> {
        match &self.kind {
            Kind::Part(part) => part.inputs().iter().map(|&input| input.to_owned()).collect(),
            Kind::Curve { over, .. } => over.iter().map(|(input, _)| input_name(*input).to_owned()).collect(),
            Kind::Case { .. } => Vec::new(),
        }
    }

    /// The parameters in SI units; those without an axis have their defaults.
    pub fn values(&self) -> Vec<f64> {
        self.axes.iter().zip(&self.at).map(|(axis, at)| axis.value(*at)).collect()
    }

    /// A model with this addition.
    pub fn apply(&self, model: &Model) -> Model {
        match &self.kind {
            Kind::Part(Part::LawParameter(parameter)) => match self.values().first() {
                Some(value) => parameter.set(model, *value),
                None => model.clone(),
            },
            Kind::Part(Part::Effect(info)) => {
                let values = self.fitted().map(|part| part.values()).unwrap_or_default();
                with_term(model, Term::new(info, &values))
            }
            Kind::Curve { .. } => {
                self.fitted_curve().map_or(model.clone(), |curve| with_term(model, Term::fitted_curve(curve)))
            }
            Kind::Case { .. } => model.clone(),
        }
    }

    /// As the diagnosis of impacts has it; `None` for a curve.
    fn fitted(&self) -> Option<FittedPart> {
        let Self { kind: Kind::Part(part), axes, at, intervals } = self.clone() else { return None };
        Some(FittedPart { part, axes, at, intervals, inseparable: Vec::new() })
    }

    /// The curve with its present heights.
    pub fn fitted_curve(&self) -> Option<FittedCurve> {
        let Kind::Curve { on, over } = &self.kind else { return None };
        let form = if *on == CurveTarget::Capture { CurveForm::Add } else { CurveForm::Factor };
        let axis = |(input, knots): &(usize, Vec<f64>)| CurveAxis {
            input: CurveInput::Input(*input),
            knots: knots.clone(),
        };
        Some(FittedCurve { on: *on, form, axes: over.iter().map(axis).collect(), values: self.values() })
    }

    /// The parameters of an effect by name with their intervals; none before the final fit.
    pub fn estimates(&self) -> Vec<(&'static str, Estimate)> {
        match self.kind {
            Kind::Part(Part::Effect(_)) => {
                self.fitted().map(|part| part.estimates().collect()).unwrap_or_default()
            }
            Kind::Case { ref number, .. } => {
                let [low, high] = self.intervals.first().copied().unwrap_or([self.values()[0]; 2]);
                let [value, low, high] =
                    [self.values()[0], low, high].map(|widths| rounded(number.moved(number.value, widths)));
                let [low, high] = [low.min(high), low.max(high)];
                vec![("value", Estimate { value, low, high, unit: number.unit })]
            }
            _ => Vec::new(),
        }
    }

    /// Adds it to a model file. `valid` are the ranges of the inputs of the fit.
    fn write(&self, document: &mut DocumentMut, added: &mut ArrayOfTables, valid: &InlineTable) {
        match &self.kind {
            Kind::Part(Part::LawParameter(parameter)) => {
                if let Some(number) = self.values().first() {
                    let [table, key] = parameter.key();
                    document[table][key] = value(rounded(*number));
                }
            }
            Kind::Part(Part::Effect(info)) => {
                added.extend(self.fitted().map(|part| effect(&part, info, valid.clone())));
            }
            Kind::Curve { .. } => {
                if let Some(curve) = self.fitted_curve() {
                    added.push(curve_table(&curve, valid));
                }
            }
            Kind::Case { .. } => {}
        }
    }
}

fn input_name(input: usize) -> &'static str {
    INPUTS.get(input).map_or("?", |input| input.name)
}

fn with_term(model: &Model, term: Term) -> Model {
    let mut terms = model.terms().to_vec();
    terms.push(term);
    model.with_terms(terms)
}

fn curve_table(curve: &FittedCurve, valid: &InlineTable) -> Table {
    let inputs: Vec<&str> = curve.axes.iter().map(|axis| axis.input.name(&Declared::default())).collect();
    let knots: Vec<Value> = curve.axes.iter().map(|axis| list(&axis.knots)).collect();
    let on = [curve.on.name(), curve.form.name()];
    curve_effect(on, &inputs, &knots, (&curve.values, 1), valid.clone())
}

/// The text of a model file with additions. `valid` are the ranges of the inputs of the fit.
///
/// # Errors
/// When the text cannot be edited.
pub(super) fn extended_text(
    base: &str,
    additions: &[RigAddition],
    valid: &InlineTable,
) -> Result<String, toml_edit::TomlError> {
    let mut document: DocumentMut = base.parse()?;
    let mut added = ArrayOfTables::new();
    for addition in additions {
        addition.write(&mut document, &mut added, valid);
    }
    Ok(with_effects(document, added))
}

/// What tells additions from others, in their order.
pub(super) fn keys(additions: &[RigAddition]) -> Vec<String> {
    additions.iter().map(RigAddition::key).collect()
}

/// A model with all of these.
pub(super) fn apply_all(additions: &[RigAddition], model: &Model) -> Model {
    additions.iter().fold(model.clone(), |model, addition| addition.apply(&model))
}

/// Additions with all parameters at these coordinates, one addition after the other.
pub(super) fn moved(additions: &[RigAddition], at: &[f64]) -> Vec<RigAddition> {
    let mut rest = at;
    let one = |addition: &RigAddition| {
        let (own, others) = rest.split_at(addition.axes.len().min(rest.len()));
        rest = others;
        addition.moved(own)
    };
    additions.iter().map(one).collect()
}
