//! A hypothesis: the base model with everything that was added to it so far, and the scatter about it.

use std::borrow::Cow;
use std::cell::Cell;

use super::chi_square;
use super::constant_capture::{CaptureConstant, ConstantCapture};
use super::constants::FIRST_SCATTER;
use super::curve::{ColumnCurve, ColumnCurveForm};
use super::data_split::DataSplit;
use super::evaluation::Evaluation;
use super::forecast::Forecast;
use super::likelihood::{Mean, Offset, Scatter, mean};
use super::observable::Observable;
use super::part::{FittedPart, Part};
use super::search::{descend, descend_to};
use super::smooth::surface;
use crate::dataset::ColumnValues;
use nearwall::effect::Term;
use nearwall::model::Model;

/// A part acts on an observable if it changes it by more than this share of its largest change.
const MINOR: f64 = 0.05;
/// Scatter of a capture in comparisons with that of restitutions [1].
const CAPTURE_WEIGHT_SCATTER: f64 = 0.25;
/// Tolerance of the log score in [`Hypothesis::polish`] [nats].
const SUMMIT: f64 = 1e-4;

/// A scatter that changes with a covariate.
#[derive(Debug, Clone, Copy)]
pub(super) struct ScatterTrend {
    /// Index among the covariates.
    pub covariate: usize,
    /// Change of the logarithm of the scatter per standard deviation of the covariate [1].
    pub slope: f64,
}

impl ScatterTrend {
    /// The covariate in standard deviations, by row.
    pub fn standardised(&self, data: &DataSplit) -> Vec<f64> {
        data.covariates[self.covariate].standardised()
    }

    pub fn add_to(&self, offsets: &mut [Offset], data: &DataSplit) {
        for (offset, z) in offsets.iter_mut().zip(self.standardised(data)) {
            offset.spread *= (self.slope * z).exp();
        }
    }
}

/// The base model, the additions and the scatter. All fits and comparisons start from here.
#[derive(Debug, Clone)]
pub(super) struct Hypothesis<'a> {
    pub data: &'a DataSplit,
    pub parts: Vec<FittedPart>,
    /// The observables that each part acts on, in their order, as of the last [`Hypothesis::fit_discrepancy`].
    pub acts_on: Vec<Vec<Observable>>,
    pub curves: Vec<ColumnCurve>,
    /// What captures have in common beside the parts and curves.
    pub captures: ConstantCapture,
    pub scatter_trends: Vec<ScatterTrend>,
    /// Offsets of `e_n` and `e_t` by row: residuals over the parts' own inputs, where a law is inexact.
    pub discrepancy: Option<[Vec<f64>; 2]>,
    /// Its effective number of parameters.
    pub discrepancy_freedom: f64,
    /// Scatter of single measurements [1].
    pub scatter: Scatter,
}

/// Rows with levels as they fit these predictions best, and those levels.
pub(super) fn with_levels<'a>(
    rows: Evaluation<'a>,
    levels: &[ColumnCurve],
) -> (Evaluation<'a>, Vec<ColumnCurve>) {
    let mut rows = rows;
    let mut fitted = Vec::new();
    for level in levels {
        // Beside a scatter without the level its residuals would look like gross errors.
        let wide = rows.clone().with_fitted_scatter();
        let level = level.again(&wide).unwrap_or_else(|| level.clone());
        let mut offsets = rows.offsets.to_vec();
        level.add_to(&mut offsets, &rows);
        rows = rows.with_offsets(offsets);
        fitted.push(level);
    }
    (rows, fitted)
}

impl<'a> Hypothesis<'a> {
    /// The base model with these parts.
    pub fn with_parts(data: &'a DataSplit, parts: Vec<FittedPart>, scatter: Scatter) -> Self {
        Self {
            data,
            parts,
            acts_on: Vec::new(),
            curves: Vec::new(),
            captures: ConstantCapture::default(),
            scatter_trends: Vec::new(),
            discrepancy: None,
            discrepancy_freedom: 0.0,
            scatter,
        }
    }

    /// The base model with the scatter that fits it best.
    pub fn base(data: &'a DataSplit) -> Self {
        let mut base = Self::with_parts(data, Vec::new(), FIRST_SCATTER);
        base.fit_scatter(&data.search);
        base
    }

    /// The base model with the parts. Curves, trends and discrepancy are in [`Hypothesis::offsets`].
    pub fn model(&self) -> Model {
        let mut model = self.data.base.clone();
        let mut added = Vec::new();
        for part in &self.parts {
            match (part.part, part.values().as_slice()) {
                (Part::Effect(effect), values) => added.push(Term::new(effect, values)),
                (Part::LawParameter(parameter), [value]) => model = parameter.set(&model, *value),
                (Part::LawParameter(_), _) => {}
            }
        }
        model.with_terms([model.terms(), &added].concat())
    }

    /// The offsets of all rows, without what their captures have in common.
    pub fn offsets(&self) -> Vec<Offset> {
        let data = self.data;
        let mut offsets = data.noise.to_vec();
        for trend in &self.scatter_trends {
            trend.add_to(&mut offsets, data);
        }
        for (which, values) in self.discrepancy.iter().flatten().enumerate() {
            for (offset, value) in offsets.iter_mut().zip(values) {
                offset.restitution[which] += value;
            }
        }
        if !self.curves.is_empty() {
            let all = self.evaluate(data.all(), &*data.noise);
            self.curves.iter().for_each(|curve| curve.add_to(&mut offsets, &all));
        }
        offsets
    }

    /// Predicts these rows.
    pub fn evaluate<'b>(
        &self,
        rows: impl Into<Cow<'b, [usize]>>,
        offsets: impl Into<Cow<'b, [Offset]>>,
    ) -> Evaluation<'b>
    where
        'a: 'b,
    {
        let plain = Evaluation::new(self.data, &self.model(), rows, offsets, self.scatter);
        plain.with_captures(self.captures)
    }

    /// Whether an outcome is drawn at random.
    pub fn is_stochastic(&self) -> bool {
        self.parts.iter().any(|part| part.part.is_stochastic())
    }

    /// The predictions of the rows of the search.
    pub fn forecast(&self) -> Forecast {
        Forecast::of_data(&self.model(), self.data, &self.data.search)
    }

    /// p-value of the discrepancy; `None` without one.
    pub fn lack_of_fit(&self) -> Option<f64> {
        let freedom = self.discrepancy_freedom;
        let fall = 2.0 * (self.discrepancy_gain() + freedom).max(0.0);
        (freedom > 0.0).then(|| chi_square::p_value(fall, freedom).max(1e-300))
    }

    /// The number of fitted parameters.
    pub fn freedom(&self) -> f64 {
        let parts = self.parts.iter().map(|part| part.at.len() as f64).sum::<f64>();
        let curves = self.curves.iter().map(|curve| curve.freedom).sum::<f64>();
        parts + curves + self.scatter_trends.len() as f64 + self.captures.freedom()
    }

    /// Whether a parameter is at an end of its search range, where it is no law.
    pub fn at_bound(&self) -> bool {
        self.captures.at_bound() || self.parts.iter().any(FittedPart::at_bound)
    }

    /// The coordinates of all parts, one part after the other.
    pub fn coordinates(&self) -> Vec<f64> {
        self.parts.iter().flat_map(|part| part.at.iter().copied()).collect()
    }

    /// The same with all parts at these coordinates, one part after the other.
    pub fn with_coordinates(&self, at: &[f64]) -> Self {
        let mut moved = self.clone();
        let mut rest = at;
        for part in &mut moved.parts {
            let (own, others) = rest.split_at(part.axes.len().min(rest.len()));
            own.clone_into(&mut part.at);
            rest = others;
        }
        moved
    }

    /// Makes the parameters that are left at their defaults free.
    pub fn free_defaults(&mut self) {
        let data = self.data;
        self.parts.iter_mut().for_each(|part| part.free_defaults(data));
    }

    /// Fits the scatter and the ceiling of captures to these rows.
    pub fn fit_scatter(&mut self, rows: &[usize]) {
        self.set_noise(self.evaluate(rows, self.offsets()));
    }

    fn set_noise(&mut self, rows: Evaluation<'_>) {
        let Evaluation { scatter, captures, .. } = rows.with_fitted_scatter();
        (self.scatter, self.captures) = (scatter, captures);
    }

    /// Fits all parameters together to these rows, from their present values, then the curves and the scatter.
    pub fn fit(&mut self, rows: &[usize]) {
        self.fit_rate(rows);
        for _ in 0..if self.curves.is_empty() { 1 } else { 2 } {
            // Laws take on a level as far as they can: it is fitted anew beside each of their values.
            let (levels, curves): (Vec<_>, Vec<_>) =
                std::mem::take(&mut self.curves).into_iter().partition(ColumnCurve::is_level);
            self.curves = curves;
            let offsets = self.offsets();
            let start = self.coordinates();
            if !start.is_empty() {
                // The scatter is fitted from that of the last place, which is near.
                let last = Cell::new(self.scatter);
                let cost = |at: &[f64]| {
                    let rows = self.with_coordinates(at).evaluate(rows, &offsets).with_scatter(last.get());
                    let fitted = with_levels(rows, &levels).0.with_fitted_scatter();
                    last.set(fitted.scatter);
                    -fitted.score()
                };
                let (at, _) = descend(cost, &start, 0.06, 60 * start.len() as u64);
                *self = self.with_coordinates(&at);
            }
            let (fitted, levels) = with_levels(self.evaluate(rows, &offsets), &levels);
            self.set_noise(fitted);
            self.curves.extend(levels);
            for place in 0..self.curves.len() {
                let curve = self.curves.remove(place);
                let fitted = curve.again(&self.evaluate(rows, self.offsets()).with_fitted_scatter());
                self.curves.insert(place, fitted.unwrap_or(curve));
            }
        }
        self.fit_scatter(rows);
    }

    /// Moves all parameters to the maximum of the likelihood of these rows, from near it.
    pub fn polish(&mut self, rows: &[usize]) {
        let offsets = self.offsets();
        let start = self.coordinates();
        if start.is_empty() {
            return;
        }
        let cost =
            |at: &[f64]| -self.with_coordinates(at).evaluate(rows, &offsets).with_fitted_scatter().score();
        let (at, _) = descend_to(SUMMIT, cost, &start, 0.01, 60 * start.len() as u64);
        *self = self.with_coordinates(&at);
        self.fit_scatter(rows);
    }

    /// Lets closed forms replace predictions that are the same in all these rows, where nothing else acts.
    pub fn settle_forms(&mut self, rows: &[usize]) {
        if !self.parts.is_empty() {
            return;
        }
        let plain = self.evaluate(rows, &*self.data.noise);
        let observables: Vec<Observable> = self.curves.iter().map(|curve| curve.form.observable).collect();
        for curve in &mut self.curves {
            let alone = observables.iter().filter(|own| **own == curve.form.observable).count() == 1;
            let mut predicted = plain.plain(curve.form.observable).map(|(_, value)| value);
            let first = predicted.next().filter(|first| alone && predicted.all(|value| value == *first));
            let settled =
                curve.closed.as_ref().zip(first).and_then(|(closed, value)| closed.replacing(value));
            curve.closed = settled.or(curve.closed.take());
        }
    }

    /// Takes out the curve over the same columns of the same observable.
    pub fn remove_curve(&mut self, curve: &ColumnCurve) {
        let data = self.data;
        self.curves.retain(|own| own.form.key(data) != curve.form.key(data));
    }

    /// Fits the constant rate of captures, if there is one; 0 where a curve of capture takes its place.
    fn fit_rate(&mut self, rows: &[usize]) {
        if !self.captures.has(CaptureConstant::Rate) {
            return;
        }
        let before = std::mem::take(&mut self.captures.rate);
        if self.curves.iter().any(|curve| curve.form.observable == Observable::Capture) {
            return;
        }
        let level = ColumnCurveForm::level(Observable::Capture, false);
        let fitted = level.fit(&self.evaluate(rows, self.offsets()).with_fitted_scatter());
        self.captures.rate = fitted.and_then(|curve| curve.heights.first().copied()).unwrap_or(before);
    }

    /// Fits all parameters together to the rows of the search, then the discrepancy.
    pub fn fit_with_discrepancy(&mut self) {
        let data = self.data;
        self.discrepancy = None;
        self.fit(&data.search);
        self.fit_discrepancy();
    }

    /// Fits a smooth surface to the residuals over the parts' inputs, so that an inexact law needs no second cause.
    pub fn fit_discrepancy(&mut self) {
        self.acts_on = self.actions();
        self.fit_discrepancy_of(self.parts.len());
    }

    /// The same over the inputs of the first so many parts, of which it is known what they act on.
    pub fn fit_discrepancy_of(&mut self, parts: usize) {
        self.discrepancy = None;
        let all = self.data.all();
        let evaluation = self.evaluate(&self.data.search, self.offsets()).with_fitted_scatter();
        let of = |observable| {
            let (own, others) = self.discrepancy_columns(observable, parts);
            if own.is_empty() {
                return (vec![0.0; all.len()], 0.0);
            }
            surface(&own, &others, &evaluation.residuals(observable, false), &all)
        };
        let [e_n, e_t] = [of(Observable::NormalRestitution), of(Observable::TangentialRestitution)];
        self.discrepancy_freedom = e_n.1 + e_t.1;
        self.discrepancy = Some([e_n.0, e_t.0]);
    }

    /// The same without the discrepancy, which is no part of the model.
    pub fn without_discrepancy(&self) -> Self {
        Self { discrepancy: None, ..self.clone() }
    }

    /// Log score of the rows of the search with the scatter that fits them best [nats].
    pub fn search_score(&self) -> f64 {
        self.evaluate(&*self.data.search, self.offsets()).with_fitted_scatter().score()
    }

    /// What the discrepancy gains on the rows of the search, less its effective number of parameters [nats].
    pub fn discrepancy_gain(&self) -> f64 {
        self.search_score() - self.without_discrepancy().search_score() - self.discrepancy_freedom
    }

    /// The columns of the discrepancy of an observable: those with a curve of their own, and those that only interact
    /// with one of them.
    ///
    /// The plain laws explain speed and diameter: for a part with another input they only interact with that input.
    fn discrepancy_columns(
        &self,
        observable: Observable,
        parts: usize,
    ) -> (Vec<&'a ColumnValues>, Vec<&'a ColumnValues>) {
        let plain = |name: &&str| ["v_n", "d"].contains(name);
        let mut own: Vec<&str> = Vec::new();
        for part in self.acting_on(observable, parts) {
            let inputs = part.part.inputs();
            let alone = inputs.iter().all(plain);
            own.extend(inputs.iter().filter(|name| alone || !plain(name)));
        }
        own.sort_unstable();
        own.dedup();
        let others = ["v_n", "d"].into_iter().filter(|name| !own.contains(name));
        let data = self.data;
        let values = |name: &str| data.covariate(name).map(|covariate| &covariate.values);
        (own.iter().copied().filter_map(values).collect(), others.filter_map(values).collect())
    }

    /// Those of the first so many parts that act on an observable.
    fn acting_on(&self, observable: Observable, parts: usize) -> impl Iterator<Item = &FittedPart> {
        let all = self.parts.iter().zip(&self.acts_on).take(parts);
        all.filter(move |(_, on)| on.contains(&observable)).map(|(part, _)| part)
    }

    /// The columns on which a part or a curve of this observable depends, by index; of a part those
    /// beside speed and diameter, if any.
    pub fn columns_of(&self, observable: Observable) -> Vec<usize> {
        let of_parts =
            self.acting_on(observable, self.parts.len()).flat_map(|part| own_inputs(part.part.inputs()));
        let index = |name: &str| self.data.covariates.iter().position(|column| column.name == name);
        let curves = self.curves.iter().filter(|curve| curve.form.observable == observable);
        let of_curves =
            curves.filter(|curve| curve.form.sides.len() == 1).flat_map(|curve| &curve.form.sides);
        let mut columns: Vec<usize> =
            of_parts.filter_map(index).chain(of_curves.map(|side| side.0)).collect();
        columns.sort_unstable();
        columns.dedup();
        columns
    }

    /// The observables that each part acts on.
    fn actions(&self) -> Vec<Vec<Observable>> {
        let whole = self.forecast();
        let of_part = |place: usize| {
            let mut without = self.clone();
            without.parts.remove(place);
            let changes = self.changes(&whole, &without.forecast());
            let most = changes.iter().copied().fold(0.0, f64::max);
            let acts = |observable: &Observable| changes[*observable as usize] > MINOR * most;
            Observable::ALL.into_iter().filter(acts).collect()
        };
        (0..self.parts.len()).map(of_part).collect()
    }

    /// Mean squared difference of two forecasts of the search's rows (of the means, plus the difference
    /// of the variances), in units of the scatter squared, by
    /// observable; 0 where it was not measured.
    pub fn changes(&self, one: &Forecast, other: &Forecast) -> [f64; 3] {
        let [e_n, e_t] = self.scatter;
        let scatter = [e_n, e_t, CAPTURE_WEIGHT_SCATTER];
        let mut sums = [0.0; 3];
        for (place, &index) in self.data.search.iter().enumerate() {
            let row = &self.data.rows[index];
            let [a, b] = [one, other].map(|forecast| mean(forecast.of(place), &Offset::default()));
            for observable in Observable::ALL.into_iter().filter(|o| o.measured(row).is_some()) {
                let which = observable as usize;
                let difference = observable.predicted(&a) - observable.predicted(&b);
                let variance = |mean: &Mean| mean.variance.get(which).copied().unwrap_or(0.0);
                let squared = difference * difference + (variance(&a) - variance(&b)).abs();
                sums[which] += squared / (scatter[which] * scatter[which]);
            }
        }
        sums.map(|sum| sum / self.data.search.len() as f64)
    }
}

/// The inputs that tell a law from others: those beside speed and diameter, or all if there are no others.
pub(super) fn own_inputs(inputs: &'static [&'static str]) -> Vec<&'static str> {
    let plain = |name: &&str| ["v_n", "d"].contains(name);
    let own: Vec<&str> = inputs.iter().copied().filter(|name| !plain(name)).collect();
    if own.is_empty() { inputs.to_vec() } else { own }
}
