//! What a rig's data can add to the wall law: an effect, another value of a law's own number, a
//! level, or a curve or closed form over an input or group.

use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Table, Value};

use super::super::closed_form::ClosedForm;
use super::super::constant_capture::CaptureConstant;
use super::super::extend::{curve_effect, effect, form_effect, list, with_effects};
use super::super::part::{FittedPart, Part, rounded};
use super::super::record::Estimate;
use super::super::search::SearchAxis;
use super::form::RigForm;
use super::inputs::Over;
use crate::rig::{CaseNumber, FARTHEST, PRESENT};
use nearwall::effect::{CurveAxis, CurveTarget, FORMS, FittedCurve, Operation, Search, Term};
use nearwall::model::Model;

/// Largest value of a curve or a level: of `e_n` and `e_t` as a share, of capture in log odds.
pub(super) const RESTITUTION_REACH: f64 = 0.8;
const CAPTURE_REACH: f64 = 7.0;
/// Narrowest width of a law over the usual one [1]: shares of many particles tell widths that are small beside the
/// distance of two experiments.
const NARROWEST: f64 = 0.25;
/// Least ceiling of captures that is searched [1]: shares of a rig tell it where outcomes of single impacts do not.
const LEAST_CEILING: f64 = 0.1;
/// Knots of a curve.
const KNOTS: usize = 3;

/// A kind of addition.
#[derive(Debug, Clone)]
pub(super) enum Kind {
    Part(Part),
    /// A curve over an input or group, with knots at the ends and the middle of its range; a level without any.
    Curve {
        on: CurveTarget,
        over: Option<Over>,
    },
    /// A closed form in the place of a curve.
    Form(RigForm),
    /// At most a share of what the laws capture is captured; the parameter is that share.
    Ceiling,
    /// Another value of a number of the case, by place; the parameter is its distance from the case's
    /// value in standard errors. A force that the case leaves out has no parameter.
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
    /// An effect or a law's number; `range` gives the range of an input in which its place is searched. `None`
    /// if the impacts do not vary in what it depends on.
    pub fn part(part: Part, range: impl Fn(&str) -> Option<[f64; 2]>) -> Option<Self> {
        let mut axes = part.axes(range, false)?;
        if let Part::Effect(effect) = part {
            let both = axes.iter_mut().zip(effect.parameters);
            let widths = both.filter(|(_, one)| matches!(one.search, Search::InputWidth(_)));
            widths.for_each(|(axis, one)| *axis = axis.lowered(NARROWEST, one));
        }
        Some(Self { kind: Kind::Part(part), at: vec![0.5; axes.len()], axes, intervals: Vec::new() })
    }

    /// A curve over an input or group; a level without any.
    pub fn curve(on: CurveTarget, over: Option<Over>) -> Self {
        let reach = if on == CurveTarget::Capture { CAPTURE_REACH } else { RESTITUTION_REACH };
        let count = if over.is_some() { KNOTS } else { 1 };
        Self {
            kind: Kind::Curve { on, over },
            axes: vec![SearchAxis::linear(-reach, reach); count],
            at: vec![0.5; count],
            intervals: Vec::new(),
        }
    }

    /// A ceiling of captures at this share.
    pub fn ceiling(share: f64) -> Self {
        let axis = SearchAxis::linear(LEAST_CEILING, 1.0);
        Self {
            kind: Kind::Ceiling,
            at: vec![axis.coordinate(share)],
            axes: vec![axis],
            intervals: Vec::new(),
        }
    }

    /// A closed form at these coordinates.
    pub fn form(form: RigForm, at: Vec<f64>) -> Self {
        Self { axes: form.axes(), at, kind: Kind::Form(form), intervals: Vec::new() }
    }

    /// The closed forms that come near a curve or form of `e_n` or `e_t`; none of anything else.
    pub fn closed_forms(&self) -> Vec<Self> {
        let (on, over, factors) = match (&self.kind, self.fitted_curve()) {
            (Kind::Curve { on, over: Some(over) }, Some(curve)) => (*on, over, factors_of(&curve)),
            (Kind::Form(form), _) => (form.on, &form.over, form.factors(&self.values())),
            _ => return Vec::new(),
        };
        if on == CurveTarget::Capture {
            return Vec::new();
        }
        RigForm::near(on, over, &factors).into_iter().map(|(form, at)| Self::form(form, at)).collect()
    }

    /// A number of the case that is grossly wrong, or a force that it leaves out.
    pub fn case(place: usize, number: CaseNumber) -> Self {
        let count = usize::from(number.missing_force().is_none());
        Self {
            kind: Kind::Case { place, number },
            axes: vec![SearchAxis::linear(-FARTHEST, FARTHEST); count],
            at: vec![0.5; count],
            intervals: Vec::new(),
        }
    }

    /// The number of the case that it changes, with its place and its distance in standard errors.
    pub fn case_number(&self) -> Option<(usize, &CaseNumber, f64)> {
        let Kind::Case { place, number } = &self.kind else { return None };
        Some((*place, number, self.values().first().copied().unwrap_or(PRESENT)))
    }

    /// A number of the case farther by so many standard errors, as far as it is searched, with half of its interval.
    pub fn moved_on(&self, widths: f64, half: f64) -> Self {
        let (Some((_, _, now)), [axis]) = (self.case_number(), &self.axes[..]) else { return self.clone() };
        let moved = self.moved(&[axis.coordinate(now + widths).clamp(0.0, 1.0)]);
        let intervals = moved.values().iter().map(|value| [value - half, value + half]).collect();
        Self { intervals, ..moved }
    }

    /// The same with one more parameter of the effect free that has a default, from there; none if it has none left.
    pub fn with_default_free(&self) -> Option<Self> {
        let Kind::Part(Part::Effect(effect)) = &self.kind else { return None };
        let parameter = effect.parameters.get(self.axes.len())?;
        let axis = SearchAxis::of(parameter, |_| None)?;
        let mut freer = self.clone();
        freer.at.push(axis.coordinate(parameter.default?));
        freer.axes.push(axis);
        Some(freer)
    }

    /// The same at other coordinates.
    pub fn moved(&self, at: &[f64]) -> Self {
        Self { at: at.to_vec(), ..self.clone() }
    }

    /// The id of the cause.
    pub fn name(&self) -> String {
        match &self.kind {
            Kind::Part(part) => part.name(),
            Kind::Curve { over: Some(over), .. } | Kind::Form(RigForm { over, .. }) => {
                format!("unknown:{}", over.name)
            }
            Kind::Curve { on, over: None } => format!("level:{}", on.name()),
            Kind::Ceiling => CaptureConstant::Ceiling.name().to_owned(),
            Kind::Case { number, .. } => format!("case:{}", number.key),
        }
    }

    /// The id of the cause, and of curves that describe the same dependence.
    pub fn names(&self) -> Vec<String> {
        let others = self.over().into_iter().flat_map(|over| &over.overlapping);
        std::iter::once(self.name()).chain(others.map(|name| format!("unknown:{name}"))).collect()
    }

    /// Tells it from all other additions: a curve over one input may act on several observables.
    pub fn key(&self) -> String {
        match &self.kind {
            Kind::Part(_) | Kind::Case { .. } | Kind::Ceiling => self.name(),
            Kind::Curve { on, .. } | Kind::Form(RigForm { on, .. }) => {
                format!("{} on {}", self.name(), on.name())
            }
        }
    }

    /// The closed form that it is.
    pub fn as_form(&self) -> Option<&RigForm> {
        if let Kind::Form(form) = &self.kind { Some(form) } else { None }
    }

    /// The input or group of a curve or form.
    pub fn over(&self) -> Option<&Over> {
        match &self.kind {
            Kind::Curve { over, .. } => over.as_ref(),
            Kind::Form(form) => Some(&form.over),
            Kind::Part(_) | Kind::Case { .. } | Kind::Ceiling => None,
        }
    }

    /// Logarithm of the prior probability of its shape: closed forms share that of the free curve [nats].
    pub fn shape_prior(&self) -> f64 {
        if self.as_form().is_some() { -(FORMS.len() as f64).ln() } else { 0.0 }
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
            Kind::Curve { .. } | Kind::Form(_) => {
                self.over().map(|over| over.name.clone()).into_iter().collect()
            }
            Kind::Case { .. } | Kind::Ceiling => Vec::new(),
        }
    }

    /// The parameters in SI units; those without an axis have their defaults.
    pub fn values(&self) -> Vec<f64> {
        let values: Vec<f64> = self.axes.iter().zip(&self.at).map(|(axis, at)| axis.value(*at)).collect();
        self.as_form().map_or(values.clone(), |form| form.parameters(&values))
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
            Kind::Curve { .. } | Kind::Ceiling => {
                self.fitted_curve().map_or(model.clone(), |curve| with_term(model, Term::fitted_curve(curve)))
            }
            Kind::Form(form) => with_term(model, Term::fitted_form(form.fitted(self.values()))),
            Kind::Case { .. } => model.clone(),
        }
    }

    /// A closed form as the diagnosis of impacts has it.
    pub fn closed_form(&self) -> Option<ClosedForm> {
        Some(self.as_form()?.closed(self.values(), self.intervals.clone()))
    }

    /// The value of a closed form at a place of its input.
    pub fn value_of_form(&self, at: f64) -> Option<f64> {
        self.closed_form()?.value(at)
    }

    /// As the diagnosis of impacts has it; `None` for a curve.
    fn fitted(&self) -> Option<FittedPart> {
        let Self { kind: Kind::Part(part), axes, at, intervals } = self.clone() else { return None };
        Some(FittedPart { part, axes, at, intervals, inseparable: Vec::new() })
    }

    /// The curve with its present heights.
    pub fn fitted_curve(&self) -> Option<FittedCurve> {
        let (on, over) = match &self.kind {
            Kind::Curve { on, over } => (*on, over.as_ref()),
            Kind::Ceiling => (CurveTarget::Capture, None),
            _ => return None,
        };
        let is_ceiling = matches!(self.kind, Kind::Ceiling);
        let form = if on == CurveTarget::Capture && !is_ceiling { Operation::Add } else { Operation::Factor };
        let mut values = self.values();
        // A factor is written by its distance from 1.
        values.iter_mut().filter(|_| is_ceiling).for_each(|share| *share -= 1.0);
        let axis = |over: &Over| {
            let [low, high] = over.seen;
            CurveAxis { input: over.input, knots: vec![low, over.middle, high] }
        };
        Some(FittedCurve { on, form, axes: over.into_iter().map(axis).collect(), values })
    }

    /// The parameters of an effect by name with their intervals; none before the final fit.
    pub fn estimates(&self) -> Vec<(&'static str, Estimate)> {
        match self.kind {
            Kind::Part(Part::Effect(_)) => {
                self.fitted().map(|part| part.estimates().collect()).unwrap_or_default()
            }
            Kind::Case { ref number, .. } => {
                let Some(now) = self.values().first().copied() else { return Vec::new() };
                let [low, high] = self.intervals.first().copied().unwrap_or([now; 2]);
                let [value, low, high] =
                    [now, low, high].map(|widths| rounded(number.moved(number.value, widths)));
                let [low, high] = [low.min(high), low.max(high)];
                vec![("value", Estimate { value, low, high, unit: number.unit })]
            }
            Kind::Form(ref form) => self
                .closed_form()
                .map(|closed| closed.estimates(form.over.unit).collect())
                .unwrap_or_default(),
            Kind::Ceiling => match (&self.values()[..], &self.intervals[..]) {
                (&[value], &[interval]) => {
                    let [value, low, high] = [value, interval[0], interval[1]].map(rounded);
                    vec![("share", Estimate { value, low, high, unit: "1" })]
                }
                _ => Vec::new(),
            },
            _ => Vec::new(),
        }
    }

    /// Adds it to a model file. `valid` are the ranges of the inputs of the fit.
    fn write(&self, document: &mut DocumentMut, added: &mut ArrayOfTables, valid: &InlineTable) {
        match &self.kind {
            Kind::Part(Part::LawParameter(parameter)) => {
                if let Some(number) = self.values().first() {
                    parameter.write(document, *number);
                }
            }
            Kind::Part(Part::Effect(info)) => {
                added.extend(self.fitted().map(|part| effect(&part, info, valid.clone())));
            }
            Kind::Curve { .. } | Kind::Ceiling => {
                if let Some(curve) = self.fitted_curve() {
                    added.push(curve_table(&curve, self.over(), valid));
                }
            }
            Kind::Form(RigForm { on, over, .. }) => {
                let table =
                    |closed| form_effect(on.name(), (&over.name, over.unit), &closed, over.valid(valid));
                added.extend(self.closed_form().map(table));
            }
            Kind::Case { .. } => {}
        }
    }
}

/// The factors of a curve at its knots and between them.
fn factors_of(curve: &FittedCurve) -> Vec<[f64; 2]> {
    let knots = curve.axes.iter().flat_map(|axis| &axis.knots).zip(&curve.values);
    let mut factors: Vec<[f64; 2]> = knots.map(|(x, value)| [*x, 1.0 + value]).collect();
    let between = |pair: &[[f64; 2]]| [0, 1].map(|i| 0.5 * (pair[0][i] + pair[1][i]));
    factors.extend(factors.windows(2).map(between).collect::<Vec<_>>());
    factors
}

fn with_term(model: &Model, term: Term) -> Model {
    let mut terms = model.terms().to_vec();
    terms.push(term);
    model.with_terms(terms)
}

fn curve_table(curve: &FittedCurve, over: Option<&Over>, valid: &InlineTable) -> Table {
    let inputs: Vec<&str> = over.map(|over| over.name.as_str()).into_iter().collect();
    let knots: Vec<Value> = curve.axes.iter().map(|axis| list(&axis.knots)).collect();
    let on = [curve.on.name(), curve.form.name()];
    let valid = over.map_or_else(|| valid.clone(), |over| over.valid(valid));
    curve_effect(on, &inputs, &knots, (&curve.values, 1), valid)
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

/// The same with the closed form of each: additions of which the coordinates mean the same.
pub(super) fn shapes(additions: &[RigAddition]) -> Vec<(String, Option<&'static str>)> {
    additions.iter().map(|one| (one.key(), one.as_form().map(RigForm::name))).collect()
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
