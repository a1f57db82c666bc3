//! Closed forms in the place of a free curve over one column: `e_n = a We^b` rather than eight heights.
//!
//! Every form of the library ([`FORMS`]) is fitted in each way in which it can act, and competes with the free curve by
//! evidence (Schwarz 1978). Of `e_n` and `e_t` the sum of weighted squares is minimised: a form is linear in most of
//! its parameters, which a least-squares solution gives for each place of the others (variable projection; Golub and
//! Pereyra 1973). Captures have a threshold with a width, or level off, by the likelihood of the outcomes.

use nalgebra::{DMatrix, DVector};

use super::curve::ColumnCurve;
use super::evaluation::Evaluation;
use super::likelihood::{capture_odds, visible_capture};
use super::observable::Observable;
use super::part::rounded;
use super::record::{Estimate, FormPoint};
use super::search::{SearchAxis, best_of, descend, grid};
use crate::dataset::ColumnValues;
use nearwall::effect::{FORMS, FormInfo, Operation};

/// Places of a nonlinear parameter at which fits begin: of one, and of each of two.
const PLACES: [usize; 2] = [40, 12];
/// Places of each parameter of a threshold on the grid of its intervals.
const FINE_PLACES: usize = 80;
/// Range of the exponent of a power [1].
pub(super) const EXPONENTS: [f64; 2] = [-4.0, 4.0];
/// Range of the steepness of a threshold [1].
pub(super) const STEEPNESS: [f64; 2] = [1.0, 200.0];
/// A scale of the column may lie beyond its range by this factor [1].
pub(super) const BEYOND: f64 = 10.0;
/// Points that choose among these places.
const COARSE_POINTS: usize = 200;
/// Iterations a parameter of a descent.
const ITERATIONS: u64 = 40;
/// Size of its first simplex.
const SIMPLEX: f64 = 0.03;
/// First guess of a share of captures that has no default [1].
const FIRST_SHARE: f64 = 0.7;
/// Least number of points of a form beyond its parameters.
const LEAST_LEFT: usize = 2;

/// A closed form over one column.
#[derive(Debug, Clone)]
pub(super) struct ClosedForm {
    pub info: &'static FormInfo,
    pub acts: Operation,
    /// In the order of the form.
    pub parameters: Vec<f64>,
    /// Whether each parameter is fitted; others are at their defaults.
    pub free: Vec<bool>,
    /// 95 % intervals of the parameters; empty before the final fit.
    pub intervals: Vec<[f64; 2]>,
    /// Its values with their 95 % band; empty before the final fit.
    pub line: Vec<FormPoint>,
}

/// A form with its criterion: minus the log likelihood plus half the logarithm of the number of readings a parameter.
pub(super) type Rated = (ClosedForm, f64);

impl ClosedForm {
    /// The value at `x`, in the unit of the column; `None` where it has none.
    pub fn value(&self, x: f64) -> Option<f64> {
        Some(self.info.value(&self.parameters, x)).filter(|value| !value.is_nan())
    }

    /// Number of fitted parameters.
    pub fn freedom(&self) -> f64 {
        self.free.iter().filter(|free| **free).count() as f64
    }

    /// What it adds to a prediction; of capture to the log odds.
    pub fn change(&self, x: f64, predicted: f64, observable: Observable) -> f64 {
        let Some(value) = self.value(x) else { return 0.0 };
        match observable {
            Observable::Capture => capture_odds(value.clamp(0.0, 1.0)) - capture_odds(predicted),
            _ => self.acts.apply(predicted, value) - predicted,
        }
    }

    /// The form that replaces a prediction which is the same everywhere, in the stead of a factor on it or of a term;
    /// `None` where no parameter takes the prediction in.
    pub fn replacing(&self, prediction: f64) -> Option<Self> {
        let (nonlinear, intercepts) = (nonlinear(self.info), intercepts(self.info));
        let taken = |(place, value): (usize, &f64)| match self.acts {
            Operation::Times if !nonlinear.contains(&place) => value * prediction,
            Operation::Add if intercepts.contains(&self.info.parameters[place].name) => value + prediction,
            _ => *value,
        };
        let parameters = self.parameters.iter().enumerate().map(taken).collect();
        let possible =
            self.acts == Operation::Times || (self.acts == Operation::Add && !intercepts.is_empty());
        possible.then(|| Self { parameters, acts: Operation::Set, ..self.clone() })
    }

    /// The fitted parameters by name, with six digits; none before the final fit. The unit of the column is `unit`.
    pub fn estimates(&self, unit: &'static str) -> impl Iterator<Item = (&'static str, Estimate)> {
        let all = self.info.parameters.iter().zip(&self.parameters).zip(&self.intervals).zip(&self.free);
        all.filter(|(_, free)| **free).map(move |(((parameter, value), [low, high]), _)| {
            let [value, low, high] = [*value, low.min(*value), high.max(*value)].map(rounded);
            (parameter.name, Estimate { value, low, high, unit: unit_of(parameter.unit, unit) })
        })
    }

    /// The same form with all of its parameters fitted; a threshold of capture as it is.
    pub fn freed(&self) -> Self {
        let keeps_ends = self.info.name == "logistic";
        let free = self.free.iter().map(|free| *free || !keeps_ends).collect();
        Self { free, ..self.clone() }
    }

    /// The same form fitted again.
    pub fn again(&self, curve: &ColumnCurve, evaluation: &Evaluation<'_>) -> Option<Self> {
        let points = Points::new(curve, evaluation)?;
        let kind = Kind { info: self.info, acts: self.acts, free: self.free.clone() };
        Some(points.fit(&kind)?.0)
    }
}

/// All forms that can stand in the place of a curve, the best first.
pub(super) fn forms(curve: &ColumnCurve, evaluation: &Evaluation<'_>) -> Vec<Rated> {
    let Some(points) = Points::new(curve, evaluation) else { return Vec::new() };
    let mut all: Vec<Rated> = points.kinds().iter().filter_map(|kind| points.fit(kind)).collect();
    all.sort_by(|a, b| a.1.total_cmp(&b.1));
    all
}

/// The 95 % interval of each parameter of a form, NaN for one that is not fitted. `with` has the curve in its offsets,
/// `quantile` is that of Student's t.
pub(super) fn intervals(
    curve: &ColumnCurve,
    closed: &ClosedForm,
    with: &Evaluation<'_>,
    quantile: f64,
) -> Vec<[f64; 2]> {
    let nothing = || vec![[f64::NAN; 2]; closed.parameters.len()];
    let Some(points) = Points::new(curve, with) else { return nothing() };
    let found = match curve.form.observable {
        Observable::Capture => Some(points.credible(closed)),
        _ => points.standard_errors(closed).map(|errors| symmetric(closed, &errors, quantile)),
    };
    found.unwrap_or_else(nothing)
}

/// The 95 % band of a form at these places of its column, in its unit; `None` where it cannot be had.
pub(super) fn band(
    curve: &ColumnCurve,
    closed: &ClosedForm,
    with: &Evaluation<'_>,
    quantile: f64,
    at: &[f64],
) -> Option<Vec<[f64; 2]>> {
    let points = Points::new(curve, with)?;
    if curve.form.observable == Observable::Capture {
        return Some(points.credible_values(closed, at));
    }
    let errors = points.errors_of_values(closed, at)?;
    let one = |(x, error): (&f64, f64)| {
        let value = closed.value(*x)?;
        Some([value - quantile * error, value + quantile * error])
    };
    at.iter().zip(errors).map(one).collect()
}

/// Intervals from standard errors; of a positive scale in its logarithm.
fn symmetric(closed: &ClosedForm, errors: &[f64], quantile: f64) -> Vec<[f64; 2]> {
    let one = |(place, (value, error)): (usize, (&f64, &f64))| {
        let is_scale = ["input", "1/input^b"].contains(&closed.info.parameters[place].unit) && *value > 0.0;
        let reach = quantile * error;
        if is_scale {
            [-1.0, 1.0].map(|sign| value * (sign * reach / value).exp())
        } else {
            [value - reach, value + reach]
        }
    };
    closed.parameters.iter().zip(errors).enumerate().map(one).collect()
}

/// The unit of a parameter of a form over a column with this unit; empty where it is not known.
fn unit_of(parameter: &str, column: &'static str) -> &'static str {
    match (parameter, column) {
        ("1", _) | (_, "1") => "1",
        ("input", unit) => unit,
        ("1/input", "m/s") => "s/m",
        ("1/input", "K") => "1/K",
        ("1/input", "m") => "1/m",
        _ => "",
    }
}

/// A form, how it acts, and which of its parameters are fitted.
struct Kind {
    info: &'static FormInfo,
    acts: Operation,
    free: Vec<bool>,
}

impl Kind {
    /// The parameters at their defaults, 0 without one.
    fn defaults(&self) -> Vec<f64> {
        self.info.parameters.iter().map(|parameter| parameter.default.unwrap_or(0.0)).collect()
    }
}

/// The parameters in which a form is not linear, by place.
fn nonlinear(form: &FormInfo) -> Vec<usize> {
    let names: &[&str] = match form.name {
        "power" => &["b"],
        "exponential" | "saturating" => &["x_0"],
        "logistic" => &["x_0", "n"],
        _ => &[],
    };
    (0..form.parameters.len()).filter(|place| names.contains(&form.parameters[*place].name)).collect()
}

/// The parameters to which a constant can be added.
fn intercepts(form: &FormInfo) -> &'static [&'static str] {
    match form.name {
        "constant" | "line" => &["a"],
        "exponential" | "saturating" => &["floor"],
        "logistic" => &["low", "high"],
        _ => &[],
    }
}

/// One reading over the column.
struct Point {
    /// Value of the column over [`Points::unit`] [1].
    x: f64,
    /// Measured minus predicted value [1]; of capture the share captured.
    residual: f64,
    /// Predicted value [1]; not used for captures.
    predicted: f64,
    /// One over the variance; of capture the number of impacts.
    weight: f64,
}

/// The readings over the column of a curve.
struct Points {
    points: Vec<Point>,
    observable: Observable,
    /// The column is measured in this many of its units, so that no power of it is huge.
    unit: f64,
    /// Least and largest of the positive values, over [`Self::unit`].
    range: [f64; 2],
    /// Whether all values are positive, and whether none is negative.
    positive: bool,
    not_negative: bool,
}

impl Points {
    fn new(curve: &ColumnCurve, evaluation: &Evaluation<'_>) -> Option<Self> {
        let [(column, _)] = curve.form.sides.as_slice() else { return None };
        let (data, observable) = (evaluation.data, curve.form.observable);
        let covariate = data.covariates.get(*column)?;
        let ColumnValues::Numbers(numbers) = &covariate.values else { return None };
        let usable = |row: usize| !covariate.blank[row] && numbers[row].is_finite();
        let points: Vec<Point> = match observable {
            Observable::Capture => evaluation
                .shares()
                .filter(|(row, _)| usable(*row))
                .map(|(row, [impacts, share])| Point {
                    x: numbers[row],
                    residual: share,
                    predicted: 0.0,
                    weight: impacts,
                })
                .collect(),
            _ => {
                let readings = evaluation.residuals(observable, true).into_iter();
                let point = |one: super::smooth::WeightedResidual| Point {
                    x: numbers[one.row],
                    residual: one.residual,
                    predicted: one.scale,
                    weight: one.weight,
                };
                readings.filter(|one| usable(one.row)).map(point).collect()
            }
        };
        Self::scaled(points, observable)
    }

    /// The points with their column in a unit near their middle.
    fn scaled(mut points: Vec<Point>, observable: Observable) -> Option<Self> {
        let mut positive: Vec<f64> = points.iter().map(|point| point.x).filter(|x| *x > 0.0).collect();
        positive.sort_by(f64::total_cmp);
        let unit = *positive.get(positive.len() / 2).unwrap_or(&1.0);
        let range = [*positive.first().unwrap_or(&1.0) / unit, *positive.last().unwrap_or(&1.0) / unit];
        let all_positive = positive.len() == points.len();
        let not_negative = points.iter().all(|point| point.x >= 0.0);
        points.iter_mut().for_each(|point| point.x /= unit);
        let first = points.first()?.x;
        let varies = points.iter().any(|point| point.x != first);
        varies.then_some(Self { points, observable, unit, range, positive: all_positive, not_negative })
    }

    /// The forms to fit. A factor leaves to laws that join later what they change.
    fn kinds(&self) -> Vec<Kind> {
        let acts = match self.observable {
            Observable::Capture => vec![Operation::Set],
            _ => vec![Operation::Times, Operation::Add],
        };
        let is_offered = |form: &&FormInfo| match form.name {
            "constant" => false,
            "logistic" => self.not_negative && self.range[1] > self.range[0],
            "saturating" => self.not_negative,
            _ if self.observable == Observable::Capture => false,
            "power" => self.positive,
            _ => true,
        };
        let forms = FORMS.iter().filter(is_offered);
        let of = |form: &'static FormInfo| acts.iter().flat_map(move |acts| variants(form, *acts));
        // A step of `e_n` or `e_t` has no natural ends.
        let has_ends = |kind: &Kind| {
            self.observable == Observable::Capture
                || kind.info.name != "logistic"
                || kind.free.iter().all(|free| *free)
        };
        forms.flat_map(of).filter(has_ends).collect()
    }

    /// The search ranges of the nonlinear parameters.
    fn axes(&self, kind: &Kind) -> Vec<SearchAxis> {
        let [low, high] = self.range;
        let axis = |place: usize| match kind.info.parameters[place].name {
            "b" => SearchAxis::linear(EXPONENTS[0], EXPONENTS[1]),
            "n" => SearchAxis::logarithmic(STEEPNESS[0], STEEPNESS[1]),
            _ if kind.info.name == "logistic" => SearchAxis::logarithmic(low, high),
            _ if self.positive => SearchAxis::logarithmic(low, BEYOND * high),
            _ => SearchAxis::logarithmic(high / 50.0, BEYOND * high),
        };
        nonlinear(kind.info).into_iter().map(axis).collect()
    }

    /// The best parameters of a form; `None` where there are too few points.
    fn fit(&self, kind: &Kind) -> Option<Rated> {
        let count = kind.free.iter().filter(|free| **free).count();
        if self.points.len() < count + LEAST_LEFT {
            return None;
        }
        let (parameters, misfit) = match self.observable {
            Observable::Capture => self.fit_captures(kind)?,
            _ => self.fit_readings(kind)?,
        };
        let number: f64 = match self.observable {
            Observable::Capture => self.points.iter().map(|point| point.weight).sum(),
            _ => self.points.len() as f64,
        };
        let form = ClosedForm {
            info: kind.info,
            acts: kind.acts,
            parameters: self.in_units(kind, parameters),
            free: kind.free.clone(),
            intervals: Vec::new(),
            line: Vec::new(),
        };
        Some((form, misfit + 0.5 * count as f64 * number.ln()))
    }

    /// Parameters with the column in its own unit.
    fn in_units(&self, kind: &Kind, parameters: Vec<f64>) -> Vec<f64> {
        let exponent = nonlinear(kind.info).first().map_or(0.0, |place| parameters[*place]);
        let scaled = |(parameter, value): (&nearwall::effect::Parameter, f64)| match parameter.unit {
            "input" => value * self.unit,
            "1/input" => value / self.unit,
            "1/input^b" => value * self.unit.powf(-exponent),
            _ => value,
        };
        kind.info.parameters.iter().zip(parameters).map(scaled).collect()
    }

    /// Parameters and minus the log likelihood of `e_n` or `e_t` [nats], with a scatter that fits.
    fn fit_readings(&self, kind: &Kind) -> Option<(Vec<f64>, f64)> {
        let axes = self.axes(kind);
        let nonlinear = nonlinear(kind.info);
        let solved = |at: &[f64], step: usize| {
            let mut parameters = kind.defaults();
            let values = axes.iter().zip(at).map(|(axis, at)| axis.value(*at));
            nonlinear.iter().zip(values).for_each(|(place, value)| parameters[*place] = value);
            self.solve(kind, parameters, step)
        };
        let cost = |at: &[f64], step: usize| {
            let number = self.points.len().div_ceil(step) as f64;
            solved(at, step).map_or(f64::INFINITY, |(_, sum)| 0.5 * number * (sum / number).max(1e-12).ln())
        };
        if axes.is_empty() {
            return Some((solved(&[], 1)?.0, cost(&[], 1)));
        }
        // The places need only some of the points.
        let coarse = self.points.len().div_ceil(COARSE_POINTS);
        let starts = best_of(|at| cost(at, coarse), &grid(axes.len(), PLACES[axes.len().min(2) - 1]), 2);
        let rounds = ITERATIONS * axes.len() as u64;
        let descents = starts.into_iter().map(|start| descend(|at| cost(at, 1), &start, SIMPLEX, rounds));
        let (at, least) = descents.min_by(|a, b| a.1.total_cmp(&b.1))?;
        let inside = axes.iter().zip(&at).all(|(axis, at)| !axis.is_at_end(*at));
        let (parameters, _) = solved(&at, 1).filter(|_| inside && least.is_finite())?;
        Some((parameters, least))
    }

    /// The linear parameters by least squares over every `step`th point, and the sum of weighted squares [1].
    fn solve(&self, kind: &Kind, mut parameters: Vec<f64>, step: usize) -> Option<(Vec<f64>, f64)> {
        let nonlinear = nonlinear(kind.info);
        let linear: Vec<usize> =
            (0..kind.free.len()).filter(|p| kind.free[*p] && !nonlinear.contains(p)).collect();
        linear.iter().for_each(|place| parameters[*place] = 0.0);
        let mut zero = kind.defaults();
        (0..zero.len()).for_each(|p| zero[p] = if nonlinear.contains(&p) { parameters[p] } else { 0.0 });
        let unit = |place: &usize| {
            let mut one = zero.clone();
            one[*place] = 1.0;
            one
        };
        let units: Vec<Vec<f64>> = linear.iter().map(unit).collect();
        let has_fixed = parameters != zero;
        let count = linear.len();
        let (mut normal, mut right) = (DMatrix::zeros(count, count), DVector::zeros(count));
        let mut square = 0.0;
        let mut shapes = vec![0.0; count];
        for point in self.points.iter().step_by(step) {
            let scale = if kind.acts == Operation::Times { point.predicted } else { 1.0 };
            let fixed = if has_fixed { scale * kind.info.value(&parameters, point.x) } else { 0.0 };
            let replaced = if kind.acts == Operation::Add { 0.0 } else { point.predicted };
            let target = point.residual + replaced - fixed;
            for (shape, unit) in shapes.iter_mut().zip(&units) {
                *shape = scale * kind.info.value(unit, point.x);
            }
            for i in 0..count {
                right[i] += point.weight * shapes[i] * target;
                (0..count).for_each(|j| normal[(i, j)] += point.weight * shapes[i] * shapes[j]);
            }
            square += point.weight * target * target;
        }
        let solution = normal.clone().cholesky()?.solve(&right);
        let sum = square - 2.0 * solution.dot(&right) + (&normal * &solution).dot(&solution);
        linear.iter().zip(solution.iter()).for_each(|(place, value)| parameters[*place] = *value);
        let finite = sum.is_finite() && parameters.iter().all(|value| value.is_finite());
        finite.then_some((parameters, sum.max(0.0)))
    }

    /// Parameters and minus the log likelihood of the outcomes [nats].
    fn fit_captures(&self, kind: &Kind) -> Option<(Vec<f64>, f64)> {
        let has_sign = kind.info.parameters.iter().any(|parameter| parameter.name == "n");
        let signs: &[f64] = if has_sign { &[1.0, -1.0] } else { &[1.0] };
        let fits = signs.iter().filter_map(|sign| self.fit_capture(kind, *sign));
        fits.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The same for a threshold that rises or falls.
    fn fit_capture(&self, kind: &Kind, sign: f64) -> Option<(Vec<f64>, f64)> {
        let mut axes = self.axes(kind);
        let mut places = nonlinear(kind.info);
        let further =
            (0..kind.free.len()).filter(|p| kind.free[*p] && !places.contains(p)).collect::<Vec<_>>();
        let starts = grid(axes.len(), PLACES[1]).into_iter().map(|mut at| {
            at.extend(
                further.iter().map(|place| kind.info.parameters[*place].default.unwrap_or(FIRST_SHARE)),
            );
            at
        });
        let starts: Vec<Vec<f64>> = starts.collect();
        axes.extend(further.iter().map(|_| SearchAxis::linear(0.0, 1.0)));
        places.extend(further);
        let parameters = |at: &[f64]| {
            let mut parameters = kind.defaults();
            for ((place, axis), at) in places.iter().zip(&axes).zip(at) {
                let steep = kind.info.parameters[*place].name == "n";
                parameters[*place] = axis.value(*at) * if steep { sign } else { 1.0 };
            }
            parameters
        };
        let cost = |at: &[f64]| self.surprise(kind, &parameters(at));
        let descents = best_of(cost, &starts, 2).into_iter();
        let descents = descents.map(|start| descend(cost, &start, SIMPLEX, ITERATIONS * axes.len() as u64));
        let (at, least) = descents.min_by(|a, b| a.1.total_cmp(&b.1))?;
        least.is_finite().then(|| (parameters(&at), least))
    }

    /// Minus the log likelihood of the outcomes [nats].
    fn surprise(&self, kind: &Kind, parameters: &[f64]) -> f64 {
        let one = |point: &Point| {
            let p = visible_capture(kind.info.value(parameters, point.x).clamp(0.0, 1.0));
            -point.weight * (point.residual * p.ln() + (1.0 - point.residual) * (1.0 - p).ln())
        };
        self.points.iter().map(one).sum()
    }
}

impl Points {
    /// Standard errors of the fitted parameters, NaN of others, about a fit whose residuals these points are.
    fn standard_errors(&self, closed: &ClosedForm) -> Option<Vec<f64>> {
        let covariances = self.covariances(closed)?;
        let mut errors = vec![f64::NAN; closed.free.len()];
        for (row, place) in fitted(closed).into_iter().enumerate() {
            errors[place] = largest(covariances.iter().map(|one| one[(row, row)])).sqrt();
        }
        Some(errors)
    }

    /// Covariances of the fitted parameters: by the weights of the readings, and by how they scatter (sandwich). The
    /// larger one counts.
    fn covariances(&self, closed: &ClosedForm) -> Option<[DMatrix<f64>; 2]> {
        let count = fitted(closed).len();
        let (mut normal, mut outer) =
            (DMatrix::<f64>::zeros(count, count), DMatrix::<f64>::zeros(count, count));
        for point in &self.points {
            let scale = if closed.acts == Operation::Times { point.predicted } else { 1.0 };
            let slopes = scale * slopes(closed, point.x * self.unit);
            let product = &slopes * slopes.transpose();
            outer += &product * (point.weight * point.residual).powi(2);
            normal += product * point.weight;
        }
        let inverse = normal.cholesky()?.inverse();
        let sandwich = &inverse * outer * &inverse;
        Some([inverse, sandwich])
    }

    /// Standard errors of the value at these places of the column.
    fn errors_of_values(&self, closed: &ClosedForm, at: &[f64]) -> Option<Vec<f64>> {
        let covariances = self.covariances(closed)?;
        let one = |x: &f64| {
            let slopes = slopes(closed, *x);
            largest(covariances.iter().map(|one| slopes.dot(&(one * &slopes)))).sqrt()
        };
        Some(at.iter().map(one).collect())
    }

    /// Forms of capture on a grid of two parameters, with their weights.
    fn weighted_forms(&self, closed: &ClosedForm) -> Vec<(Vec<f64>, f64)> {
        let kind = Kind { info: closed.info, acts: closed.acts, free: closed.free.clone() };
        let (mut axes, places) = (self.axes(&kind), on_grid(closed));
        axes.resize_with(places.len(), || SearchAxis::linear(0.0, 1.0));
        let parameters = |at: &Vec<f64>| {
            let mut parameters = closed.parameters.clone();
            for ((place, axis), at) in places.iter().zip(&axes).zip(at) {
                parameters[*place] = axis.value(*at).copysign(closed.parameters[*place]);
            }
            parameters
        };
        let all: Vec<Vec<f64>> = grid(axes.len(), FINE_PLACES).iter().map(parameters).collect();
        let costs: Vec<f64> = all.iter().map(|parameters| self.surprise(&kind, parameters)).collect();
        let least = costs.iter().copied().fold(f64::INFINITY, f64::min);
        all.into_iter().zip(costs).map(|(parameters, cost)| (parameters, (least - cost).exp())).collect()
    }

    /// Intervals of two parameters of a form of captures: of a threshold its place and its steepness.
    fn credible(&self, closed: &ClosedForm) -> Vec<[f64; 2]> {
        let weighted = self.weighted_forms(closed);
        let mut ends = vec![[f64::NAN; 2]; closed.parameters.len()];
        for place in on_grid(closed) {
            let unit = if closed.info.parameters[place].unit == "input" { self.unit } else { 1.0 };
            let values = weighted.iter().map(|(parameters, weight)| (unit * parameters[place], *weight));
            ends[place] = middle(values);
        }
        ends
    }

    /// The middle 95 % of the probability of capture at these places of the column.
    fn credible_values(&self, closed: &ClosedForm, at: &[f64]) -> Vec<[f64; 2]> {
        let weighted = self.weighted_forms(closed);
        let one = |x: &f64| {
            let value = |parameters: &[f64]| closed.info.value(parameters, x / self.unit).clamp(0.0, 1.0);
            middle(weighted.iter().map(|(parameters, weight)| (value(parameters), *weight)))
        };
        at.iter().map(one).collect()
    }
}

/// The places of the two parameters of a form of capture whose probabilities are given.
fn on_grid(closed: &ClosedForm) -> Vec<usize> {
    let mut places = nonlinear(closed.info);
    let linear: Vec<usize> = fitted(closed).into_iter().filter(|place| !places.contains(place)).collect();
    places.extend(linear);
    places.truncate(2);
    places
}

/// The places of the fitted parameters.
fn fitted(closed: &ClosedForm) -> Vec<usize> {
    (0..closed.free.len()).filter(|place| closed.free[*place]).collect()
}

/// Slopes of the value at `x`, in the unit of the column, by the fitted parameters.
fn slopes(closed: &ClosedForm, x: f64) -> DVector<f64> {
    let slope = |place: usize| {
        let step = 1e-6 * closed.parameters[place].abs().max(1e-6);
        let at = |sign: f64| {
            let mut moved = closed.parameters.clone();
            moved[place] += sign * step;
            closed.info.value(&moved, x)
        };
        (at(1.0) - at(-1.0)) / (2.0 * step)
    };
    let all: Vec<f64> = fitted(closed).into_iter().map(slope).collect();
    DVector::from_vec(all)
}

fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(0.0, f64::max)
}

/// The middle 95 % of weighted values.
fn middle(values: impl Iterator<Item = (f64, f64)>) -> [f64; 2] {
    let mut sorted: Vec<(f64, f64)> = values.collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = sorted.iter().map(|(_, weight)| weight).sum();
    let end = |share: f64| {
        let mut sum = 0.0;
        let reached = sorted.iter().find(|(_, weight)| {
            sum += weight;
            sum >= share * total
        });
        reached.map_or(f64::NAN, |(value, _)| *value)
    };
    [end(0.025), end(0.975)]
}

/// The form with its defaults kept, and with each and all of them fitted.
fn variants(info: &'static FormInfo, acts: Operation) -> Vec<Kind> {
    let optional: Vec<usize> =
        (0..info.parameters.len()).filter(|place| info.parameters[*place].default.is_some()).collect();
    let of = |mask: usize| {
        let mut free = vec![true; info.parameters.len()];
        optional.iter().enumerate().for_each(|(bit, place)| free[*place] = mask >> bit & 1 == 1);
        Kind { info, acts, free }
    };
    (0..1 << optional.len()).map(of).collect()
}
