//! What a finding says of a closed form: its equation with numbers, how sure the form is, and the law that it
//! resembles.

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::closed_form::{ClosedForm, Rated, band, forms, intervals};
use super::curve::ColumnCurve;
use super::evaluation::Evaluation;
use super::hypothesis::Hypothesis;
use super::observable::Observable;
use super::part::rounded;
use super::record::{CauseForm, FormPoint, OtherForm};
use nearwall::effect::Operation;

/// Forms less probable than this are not listed [1].
const LEAST_LISTED: f64 = 0.02;

/// A form over a wide range is shown beyond both of its ends by this factor [1].
const BEYOND_SEEN: f64 = 3.0;
/// A range whose ends differ by more than this factor is wide [1].
const WIDE: f64 = 30.0;
/// Points of a form's line.
const LINE_POINTS: usize = 61;

/// From this steepness on a threshold of capture is a step for a reader [1].
const STEEP: f64 = 30.0;

/// A law that a form over a column resembles.
struct Resemblance {
    column: &'static str,
    observable: Observable,
    /// A parameter and its range; `None` for every form over the column.
    parameter: Option<(&'static str, [f64; 2])>,
    sentence: &'static str,
}

const fn resembles(column: &'static str, observable: Observable, sentence: &'static str) -> Resemblance {
    Resemblance { column, observable, parameter: None, sentence }
}

/// The exponent of a fully plastic contact, -1/4, with room for an inexact law.
const PLASTIC: Option<(&str, [f64; 2])> = Some(("b", [-0.35, -0.15]));
const PLASTIC_CONTACT: &str = "the power -1/4 of a fully plastic contact (Johnson 1985)";

const RESEMBLANCES: [Resemblance; 11] = [
    Resemblance {
        column: "v_n",
        observable: Observable::NormalRestitution,
        parameter: PLASTIC,
        sentence: PLASTIC_CONTACT,
    },
    Resemblance {
        column: "v_n/v_y",
        observable: Observable::NormalRestitution,
        parameter: PLASTIC,
        sentence: PLASTIC_CONTACT,
    },
    resembles(
        "We",
        Observable::NormalRestitution,
        "drops whose surface stores the energy of the impact (capture model `droplet`)",
    ),
    resembles("We", Observable::Capture, "drops that the surface holds or lets go (capture model `droplet`)"),
    resembles("K", Observable::Capture, "the splashing limit of drops (capture model `droplet`, `splash_K`)"),
    resembles("Oh", Observable::NormalRestitution, "drops whose viscosity takes the energy of the impact"),
    resembles("T_p/T_melt", Observable::Capture, "melting (effect `melting-transition`)"),
    resembles("mu/mu_ref", Observable::Capture, "capture by viscosity (capture model `viscosity`)"),
    resembles(
        "St_film",
        Observable::NormalRestitution,
        "a liquid film whose drag stops slow particles (effect `liquid-film`)",
    ),
    resembles(
        "tan_alpha",
        Observable::TangentialRestitution,
        "the change from sliding to rolling (effect `sliding-to-rolling`)",
    ),
    resembles(
        "layer/d",
        Observable::NormalRestitution,
        "a powder layer that dampens (effect `powder-layer`)",
    ),
];

/// The form of a curve after the final fit; `None` for a free curve.
pub(super) fn found(hypothesis: &Hypothesis<'_>, curve: &ColumnCurve) -> Option<CauseForm> {
    let closed = curve.closed.as_ref()?;
    let column = hypothesis.data.covariates.get(curve.form.sides.first()?.0)?;
    let all: Vec<Rated> = forms(curve, &without(hypothesis, curve));
    let tried: Vec<(&'static str, f64)> = all.iter().map(|(form, cost)| (form.info.name, -cost)).collect();
    let seen = hypothesis.data.range(&column.name);
    Some(record(closed, curve.form.observable, (&column.name, column.unit, seen), &tried))
}

/// What a finding says of a form over a column with its unit and its range; `tried` are the compared forms, with the
/// logarithm of the evidence of each [nats].
pub(super) fn record(
    closed: &ClosedForm,
    observable: Observable,
    (column, unit, seen): (&str, &'static str, Option<[f64; 2]>),
    tried: &[(&'static str, f64)],
) -> CauseForm {
    let (probability, others) = probabilities(closed.info.name, tried);
    CauseForm {
        observable: observable.name(),
        form: closed.info.name,
        acts: closed.acts.name(),
        equation: equation(closed, observable, column),
        parameters: closed.estimates(unit).collect(),
        seen,
        line: closed.line.clone(),
        probability,
        others,
        resembles: resemblance(closed, observable, column),
    }
}

/// Sets the intervals of the parameters and the band of every closed form.
pub(super) fn set_intervals(hypothesis: &mut Hypothesis<'_>) {
    let one = |curve: &ColumnCurve| {
        let closed = curve.closed.as_ref()?;
        let fit = FormFit::new(hypothesis, curve, closed);
        let column = &hypothesis.data.covariates.get(curve.form.sides.first()?.0)?.name;
        let line = hypothesis.data.range(column).map(|seen| fit.line(seen)).unwrap_or_default();
        Some((intervals(curve, &fit.freed, &fit.with, fit.quantile), line))
    };
    let found: Vec<_> = hypothesis.curves.iter().map(one).collect();
    for (curve, found) in hypothesis.curves.iter_mut().zip(found) {
        if let (Some(closed), Some(found)) = (&mut curve.closed, found) {
            (closed.intervals, closed.line) = found;
        }
    }
}

/// A form in the hypothesis that it belongs to.
struct FormFit<'a, 'b> {
    curve: &'a ColumnCurve,
    closed: &'a ClosedForm,
    /// The form with its defaults fitted too: the data do not know that they are right.
    freed: ClosedForm,
    /// The fitted rows with the form.
    with: Evaluation<'b>,
    /// Student's quantile of a 95 % interval.
    quantile: f64,
}

impl<'a, 'b> FormFit<'a, 'b> {
    fn new(hypothesis: &Hypothesis<'b>, curve: &'a ColumnCurve, closed: &'a ClosedForm) -> Self {
        let rows = without(hypothesis, curve);
        let freed = closed.freed().again(curve, &rows).unwrap_or_else(|| closed.clone());
        let (with, quantile) = (with_curve(hypothesis), quantile(hypothesis, closed));
        Self { curve, closed, freed, with, quantile }
    }

    /// The form with its 95 % band over the range where it was seen and [`BEYOND_SEEN`] further on either side.
    fn line(&self, seen: [f64; 2]) -> Vec<FormPoint> {
        let at = places(seen);
        let Some(band) = band(self.curve, &self.freed, &self.with, self.quantile, &at) else {
            return Vec::new();
        };
        let one = |(at, [low, high]): (f64, [f64; 2])| {
            let value = self.closed.value(at)?;
            let point = FormPoint { at, value, low: low.min(value), high: high.max(value) };
            (point.low.is_finite() && point.high.is_finite()).then_some(point)
        };
        at.into_iter().zip(band).filter_map(one).collect()
    }
}

/// Places over a range and beyond: by a factor where the range is positive and wide, else by half of its width.
pub(super) fn places([low, high]: [f64; 2]) -> Vec<f64> {
    let is_wide = low > 0.0 && high > WIDE * low;
    let [from, to] = if is_wide {
        [(low / BEYOND_SEEN).ln(), (high * BEYOND_SEEN).ln()]
    } else {
        let half = 0.5 * (high - low);
        [if low >= 0.0 { (low - half).max(0.0) } else { low - half }, high + half]
    };
    let share = |place: usize| place as f64 / (LINE_POINTS - 1) as f64;
    let at = (0..LINE_POINTS).map(|place| from + share(place) * (to - from));
    at.map(|at| if is_wide { at.exp() } else { at }).collect()
}

/// The fitted rows under the hypothesis without a curve.
fn without<'b>(hypothesis: &Hypothesis<'b>, curve: &ColumnCurve) -> Evaluation<'b> {
    let mut bare = hypothesis.clone();
    bare.remove_curve(curve);
    bare.evaluate(hypothesis.data.fit.clone(), bare.offsets()).with_fitted_scatter()
}

/// The fitted rows under the hypothesis with its curves.
fn with_curve<'b>(hypothesis: &Hypothesis<'b>) -> Evaluation<'b> {
    hypothesis.evaluate(hypothesis.data.fit.clone(), hypothesis.offsets()).with_fitted_scatter()
}

/// Student's quantile of a 95 % interval.
fn quantile(hypothesis: &Hypothesis<'_>, closed: &ClosedForm) -> f64 {
    let units = hypothesis.data.unit_count_of(&hypothesis.data.fit) as f64;
    let freedom = (units - closed.freedom()).max(1.0);
    StudentsT::new(0.0, 1.0, freedom).map_or(2.0, |law| law.inverse_cdf(0.975))
}

/// The probability of a form among all that were tried, and the others.
fn probabilities(own: &str, tried: &[(&'static str, f64)]) -> (f64, Vec<OtherForm>) {
    let best = |name: &str| {
        let of_name = tried.iter().filter(|(form, _)| *form == name).map(|(_, evidence)| *evidence);
        of_name.fold(f64::NEG_INFINITY, f64::max)
    };
    let most = tried.iter().map(|(_, evidence)| *evidence).fold(f64::NEG_INFINITY, f64::max);
    let names: std::collections::BTreeSet<&'static str> = tried.iter().map(|(name, _)| *name).collect();
    let weight = |name: &str| (best(name) - most).exp();
    let total: f64 = names.iter().map(|name| weight(name)).sum();
    let share = |name: &str| rounded(weight(name) / total.max(f64::MIN_POSITIVE));
    let others = names.iter().filter(|name| **name != own);
    let others = others.map(|name| OtherForm { form: name, probability: share(name) });
    let mut others: Vec<OtherForm> = others.filter(|other| other.probability > LEAST_LISTED).collect();
    others.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    (if names.is_empty() { 1.0 } else { share(own) }, others)
}

/// The law that a form resembles.
fn resemblance(closed: &ClosedForm, observable: Observable, column: &str) -> Option<&'static str> {
    let within = |(name, [low, high]): (&str, [f64; 2])| {
        let names = closed.info.parameters.iter().zip(&closed.parameters);
        names.into_iter().any(|(own, value)| own.name == name && (low..=high).contains(value))
    };
    let fits = |one: &&Resemblance| {
        one.column == column && one.observable == observable && one.parameter.is_none_or(within)
    };
    RESEMBLANCES.iter().find(fits).map(|one| one.sentence)
}

/// The equation with numbers, as in `e_n = 0.98 We^-0.2`.
fn equation(closed: &ClosedForm, observable: Observable, column: &str) -> String {
    let name = if observable == Observable::Capture { "p_stick" } else { observable.name() };
    let number = |value: f64| {
        let text = format!("{value:.3e}").parse::<f64>().unwrap_or(value).to_string();
        if text.starts_with('-') { format!("({text})") } else { text }
    };
    // A quotient or a product has a letter of its own in a formula.
    let is_plain = column.chars().all(|letter| letter.is_alphanumeric() || letter == '_');
    let word = |word: &str| {
        let place = closed.info.parameters.iter().position(|parameter| parameter.name == word);
        match place {
            Some(place) => number(closed.parameters[place]),
            None if word == "x" && is_plain => column.to_owned(),
            None => word.to_owned(),
        }
    };
    if observable == Observable::Capture
        && closed.free == [true, true, false, false]
        && steepness(closed) > STEEP
    {
        let side = if closed.parameters[1] < 0.0 { "below" } else { "above" };
        return format!("captured {side} {column} = {}", number(closed.parameters[0]));
    }
    let formula = closed.info.equation.split(", ").next().unwrap_or_default();
    let value = without_zeros(&replaced(formula, word));
    let value = twice_negative(&value).unwrap_or(value);
    let formula = match closed.acts {
        Operation::Set => format!("{name} = {value}"),
        Operation::Add => format!("{name} = base + ({value})"),
        Operation::Factor => format!("{name} = base (1 + {value})"),
        Operation::Times => format!("{name} = base ({value})"),
    };
    if is_plain { formula } else { format!("{formula} with x = {column}") }
}

/// An equation without terms that are 0.
fn without_zeros(equation: &str) -> String {
    let text = equation.strip_prefix("0 + ").unwrap_or(equation);
    let text = text.strip_suffix(" + 0").unwrap_or(text);
    match text.split_once(" - 0)").and_then(|(before, after)| Some((before.strip_prefix('(')?, after))) {
        Some((before, after)) => format!("{before}{after}"),
        None => text.to_owned(),
    }
}

/// An equation without a power `^-(-n)`; `None` where there is none.
fn twice_negative(equation: &str) -> Option<String> {
    let (before, rest) = equation.split_once("^-(-")?;
    let (exponent, after) = rest.split_once(')')?;
    Some(format!("{before}^{exponent}{after}"))
}

/// How steep a threshold is [1]; 0 for another form.
fn steepness(closed: &ClosedForm) -> f64 {
    let place = closed.info.parameters.iter().position(|parameter| parameter.name == "n");
    place.map_or(0.0, |place| closed.parameters[place].abs())
}

/// A formula with every word replaced.
fn replaced(formula: &str, word: impl Fn(&str) -> String) -> String {
    let is_part = |character: char| character.is_alphanumeric() || character == '_';
    let mut text = String::new();
    let mut rest = formula;
    while let Some(start) = rest.find(is_part) {
        let (before, from) = rest.split_at(start);
        let end = from.find(|character| !is_part(character)).unwrap_or(from.len());
        let (own, after) = from.split_at(end);
        text += before;
        text += &word(own);
        rest = after;
    }
    text + rest
}
