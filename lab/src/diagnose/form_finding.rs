//! What a finding says of a closed form: its equation with numbers, how sure the form is, and the law that it resembles.

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::closed_form::{ClosedForm, Rated, forms, intervals};
use super::curve::ColumnCurve;
use super::evaluation::Evaluation;
use super::hypothesis::Hypothesis;
use super::observable::Observable;
use super::part::rounded;
use super::record::{CauseForm, Estimate, OtherForm};
use nearwall::effect::CurveForm;

/// Forms less probable than this are not listed [1].
const LEAST_LISTED: f64 = 0.02;

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
    let observable = curve.form.observable;
    let mut bare = hypothesis.clone();
    bare.remove_curve(curve);
    let rows = bare.evaluate(hypothesis.data.fit.clone(), bare.offsets()).with_fitted_scatter();
    // The data do not know that the defaults are right.
    let freed = closed.freed().again(curve, &rows).unwrap_or_else(|| closed.clone());
    let ends = intervals(curve, &freed, &with_curve(hypothesis), quantile(hypothesis, closed));
    let estimate = |place: usize| {
        let (value, [low, high]) = (closed.parameters[place], ends[place]);
        let parameter = &closed.info.parameters[place];
        let [value, low, high] = [value, low.min(value), high.max(value)].map(rounded);
        (parameter.name, Estimate { value, low, high, unit: unit(parameter.unit, column.unit) })
    };
    let record = CauseForm {
        observable: observable.name(),
        form: closed.info.name,
        acts: closed.acts.name(),
        equation: equation(closed, observable, &column.name),
        parameters: (0..closed.parameters.len()).filter(|place| closed.free[*place]).map(estimate).collect(),
        probability: 1.0,
        others: Vec::new(),
        resembles: resemblance(closed, observable, &column.name),
    };
    Some(with_probabilities(record, curve, &rows))
}

/// The unit of a parameter of a form over a column with this unit; empty where it is not known.
fn unit(of_parameter: &str, of_column: &'static str) -> &'static str {
    match (of_parameter, of_column) {
        ("1", _) | (_, "1") => "1",
        ("input", unit) => unit,
        ("1/input", "m/s") => "s/m",
        ("1/input", "K") => "1/K",
        ("1/input", "m") => "1/m",
        _ => "",
    }
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

/// The probability of the form among all forms on rows without the curve, and the others.
fn with_probabilities(mut record: CauseForm, curve: &ColumnCurve, rows: &Evaluation<'_>) -> CauseForm {
    let all: Vec<Rated> = forms(curve, rows);
    let best = |name: &str| {
        let own = all.iter().filter(|(form, _)| form.info.name == name).map(|(_, cost)| *cost);
        own.fold(f64::INFINITY, f64::min)
    };
    let least = all.iter().map(|(_, cost)| *cost).fold(f64::INFINITY, f64::min);
    let names: std::collections::BTreeSet<&'static str> =
        all.iter().map(|(form, _)| form.info.name).collect();
    let weight = |name: &str| (least - best(name)).exp();
    let total: f64 = names.iter().map(|name| weight(name)).sum();
    let share = |name: &str| rounded(weight(name) / total.max(f64::MIN_POSITIVE));
    record.probability = share(record.form);
    let others = names.iter().filter(|name| **name != record.form);
    let others = others.map(|name| OtherForm { form: name, probability: share(name) });
    record.others = others.filter(|other| other.probability > LEAST_LISTED).collect();
    record.others.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    record
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
    let word = |word: &str| {
        let place = closed.info.parameters.iter().position(|parameter| parameter.name == word);
        match place {
            Some(place) => number(closed.parameters[place]),
            None if word == "x" => column.to_owned(),
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
    let value = replaced(formula, word).replace("(1 - 0)", "1").replace("0 + ", "");
    match closed.acts {
        CurveForm::Set => format!("{name} = {value}"),
        CurveForm::Add => format!("{name} = base + ({value})"),
        CurveForm::Factor => format!("{name} = base (1 + {value})"),
        CurveForm::Times => format!("{name} = base ({value})"),
    }
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
