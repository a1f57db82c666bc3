//! A hypothesis: the base model and what has been added to it so far.

use super::data_split::DataSplit;
use super::forecast::Forecast;
use super::likelihood::{Offset, Scatter, fit_scatter, mean, ordinary, score};
use super::part::{Fitted, Part};
use super::search::descend;
use super::smooth::{Point, surface};
use super::unknown::Unknown;
use crate::dataset::Values;
use crate::effect::Term;
use crate::model::Model;

/// A part acts on an observable where it changes it by this share of its largest change.
const MINOR: f64 = 0.05;
/// Scatter of a capture for comparisons with that of restitutions [1].
const CAPTURE_SCATTER: f64 = 0.25;

/// What a row's observation is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Observable {
    NormalRestitution,
    TangentialRestitution,
    Capture,
}

impl Observable {
    pub const ALL: [Self; 3] = [Self::NormalRestitution, Self::TangentialRestitution, Self::Capture];

    /// The name in the data file.
    pub fn name(self) -> &'static str {
        ["e_n", "e_t", "outcome"][self as usize]
    }

    /// The name for a reader.
    pub fn title(self) -> &'static str {
        ["normal restitution e_n", "tangential restitution e_t", "capture"][self as usize]
    }
}

/// The base and what was added.
#[derive(Debug, Clone, Default)]
pub(super) struct Hypothesis {
    pub parts: Vec<Fitted>,
    /// What each part acts on, in their order, as far as [`Hypothesis::absorb_shape`] has looked.
    pub acts_on: Vec<Vec<Observable>>,
    pub unknowns: Vec<Unknown>,
    /// Log odds of capture that nothing explains.
    pub lapses: f64,
    /// Columns with which the scatter changes: factor and log change a standard deviation of the column.
    pub noise: Vec<(usize, f64)>,
    /// What the named causes' own inputs still leave, row by row: the laws' shape need not be exact.
    pub shape: Option<[Vec<f64>; 2]>,
}

/// How well a hypothesis does on some rows.
pub(super) struct Fit {
    pub scatter: Scatter,
    pub score: f64,
}

impl Hypothesis {
    /// The model with the given parameters in place of the parts' own.
    fn model_at(&self, study: &DataSplit, parts: &[Fitted]) -> Model {
        let mut model = study.base.clone();
        let mut terms: Vec<Term> = model.terms().to_vec();
        for fitted in parts {
            match fitted.part {
                Part::Effect(kind) => terms.push(Term::new(kind, &fitted.values())),
                Part::Number(number) => {
                    if let [value] = fitted.values()[..] {
                        model = number.set(&model, value);
                    }
                }
            }
        }
        model.with_terms(terms)
    }

    /// Whether a part turns on this input and acts on this observable.
    pub fn turns_on(&self, input: &str, observable: Observable) -> bool {
        let acting = self.parts.iter().zip(&self.acts_on).filter(|(_, on)| on.contains(&observable));
        acting.into_iter().any(|(fitted, _)| fitted.part.inputs().contains(&input))
    }

    /// What each part acts on: the observables that it changes by more than a small share of what it changes most.
    fn actions(&self, study: &DataSplit, scatter: Scatter) -> Vec<Vec<Observable>> {
        let whole = Forecast::new(&self.model(study), &study.rows, &study.search, study.draws);
        let without = |place: usize| {
            let mut parts = self.parts.clone();
            parts.remove(place);
            let model = self.model_at(study, &parts);
            let changes = changes(
                study,
                &whole,
                &Forecast::new(&model, &study.rows, &study.search, study.draws),
                scatter,
            );
            let most = changes.iter().copied().fold(0.0, f64::max);
            let strong = |o: &Observable| changes[*o as usize] > MINOR * most;
            Observable::ALL.into_iter().filter(strong).collect()
        };
        (0..self.parts.len()).map(without).collect()
    }

    /// The base with the parts.
    pub fn model(&self, study: &DataSplit) -> Model {
        self.model_at(study, &self.parts)
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

    /// Fits all parameters together to the rows, from where they are, and the curves after them.
    pub fn polish(&mut self, study: &DataSplit, rows: &[usize], first: Scatter) -> Scatter {
        let mut scatter = first;
        for _ in 0..if self.unknowns.is_empty() { 1 } else { 2 } {
            let shifts = self.shifts(study);
            let start = self.coordinates();
            if !start.is_empty() {
                let cost = |at: &[f64]| -self.with_coordinates(at).fit(study, rows, &shifts, scatter).score;
                let (at, _) = descend(cost, &start, 0.06, 60 * start.len() as u64);
                *self = self.with_coordinates(&at);
            }
            scatter = self.fit(study, rows, &shifts, scatter).scatter;
            self.refit_unknowns(study, rows, scatter);
        }
        self.fit(study, rows, &self.shifts(study), scatter).scatter
    }

    /// Fits every curve again to what the rest leaves.
    fn refit_unknowns(&mut self, study: &DataSplit, rows: &[usize], scatter: Scatter) {
        let forecast = Forecast::new(&self.model(study), &study.rows, rows, study.draws);
        for place in 0..self.unknowns.len() {
            let unknown = self.unknowns.remove(place);
            let shifts = self.shifts(study);
            let fitted = unknown.fitted(study, rows, &forecast, &shifts, scatter);
            self.unknowns.insert(place, fitted.unwrap_or(unknown));
        }
    }

    /// What is added to each row's forecast; all rows of the study.
    pub fn shifts(&self, study: &DataSplit) -> Vec<Offset> {
        let mut shifts = vec![Offset { capture: self.lapses, ..Offset::default() }; study.rows.len()];
        for &(factor, change) in &self.noise {
            for (shift, z) in shifts.iter_mut().zip(standardised(&study.factors[factor].values)) {
                shift.spread *= (change * z).exp();
            }
        }
        if let Some([e_n, e_t]) = &self.shape {
            for (index, shift) in shifts.iter_mut().enumerate() {
                shift.e_n += e_n[index];
                shift.e_t += e_t[index];
            }
        }
        if !self.unknowns.is_empty() {
            let all: Vec<usize> = (0..study.rows.len()).collect();
            let forecast = Forecast::new(&self.model(study), &study.rows, &all, study.draws);
            for unknown in &self.unknowns {
                unknown.add(study, &forecast, &all, &mut shifts);
            }
        }
        shifts
    }

    /// How well it does on the rows with these indices.
    pub fn fit(&self, study: &DataSplit, rows: &[usize], shifts: &[Offset], first: Scatter) -> Fit {
        self.fit_at(study, &self.parts, rows, shifts, first)
    }

    /// As [`Hypothesis::fit`] with other parts.
    pub fn fit_at(
        &self,
        study: &DataSplit,
        parts: &[Fitted],
        rows: &[usize],
        shifts: &[Offset],
        first: Scatter,
    ) -> Fit {
        let forecast = Forecast::new(&self.model_at(study, parts), &study.rows, rows, study.draws);
        let scatter = fit_scatter(&study.rows, rows, &forecast, shifts, first);
        Fit { scatter, score: scores(study, rows, &forecast, shifts, scatter).iter().sum() }
    }

    /// Log score of each row under a given scatter.
    pub fn row_scores(
        &self,
        study: &DataSplit,
        rows: &[usize],
        shifts: &[Offset],
        scatter: Scatter,
    ) -> Vec<f64> {
        let forecast = Forecast::new(&self.model(study), &study.rows, rows, study.draws);
        scores(study, rows, &forecast, shifts, scatter)
    }

    /// Takes up what the inputs of the named effects still leave, so that an inexact law does not call for a second cause.
    pub fn absorb_shape(&mut self, study: &DataSplit, scatter: Scatter) {
        self.shape = None;
        self.acts_on = self.actions(study, scatter);
        let shifts = self.shifts(study);
        let all: Vec<usize> = (0..study.rows.len()).collect();
        let forecast = Forecast::new(&self.model(study), &study.rows, &study.search, study.draws);
        let of = |observable| {
            let (own, others) = self.shaping(study, observable);
            if own.is_empty() {
                return vec![0.0; all.len()];
            }
            let points = residuals(study, &study.search, &forecast, &shifts, scatter, observable, false);
            surface(&own, &others, &points, &all)
        };
        self.shape = Some([of(Observable::NormalRestitution), of(Observable::TangentialRestitution)]);
    }

    /// Columns whose effect on an observable the parts answer for: on their own, and together with one of those.
    ///
    /// Speed and size belong to the plain laws: a part with an input of its own answers for them beside that input only.
    fn shaping<'a>(
        &self,
        study: &'a DataSplit,
        observable: Observable,
    ) -> (Vec<&'a Values>, Vec<&'a Values>) {
        let plain = |name: &&str| ["v_n", "d"].contains(name);
        let acting = self.parts.iter().zip(&self.acts_on).filter(|(_, on)| on.contains(&observable));
        let mut own: Vec<&str> = Vec::new();
        for (fitted, _) in acting {
            let inputs = fitted.part.inputs();
            let alone = inputs.iter().all(plain);
            own.extend(inputs.iter().filter(|name| alone || !plain(name)));
        }
        own.sort_unstable();
        own.dedup();
        let others = ["v_n", "d"].into_iter().filter(|name| !own.contains(name));
        let values = |name: &str| study.factor(name).map(|factor| &factor.values);
        (own.iter().copied().filter_map(values).collect(), others.filter_map(values).collect())
    }
}

/// Mean squared change between two forecasts of the search's rows, in units of the scatter, by observable; 0 where it was
/// not observed.
pub(super) fn changes(study: &DataSplit, one: &Forecast, other: &Forecast, scatter: Scatter) -> [f64; 3] {
    let plain = Offset::default();
    let mut sums = [0.0; 3];
    for (place, &index) in study.search.iter().enumerate() {
        let row = &study.rows[index];
        let (a, b) = (mean(one.of(place), &plain), mean(other.of(place), &plain));
        let squared = |x: f64, variance: f64, scatter: f64| (x * x + variance.abs()) / (scatter * scatter);
        if row.e_n.is_some() {
            sums[0] += squared(a.e_n - b.e_n, a.variance_e_n - b.variance_e_n, scatter.e_n);
        }
        if row.e_t.is_some() {
            sums[1] += squared(a.e_t - b.e_t, a.variance_e_t - b.variance_e_t, scatter.e_t);
        }
        if row.captured.is_some() {
            sums[2] += squared(a.capture - b.capture, 0.0, CAPTURE_SCATTER);
        }
    }
    sums.map(|sum| sum / study.search.len() as f64)
}

/// What is left of an observable in each of the rows that have it; `forecast` is of these rows.
pub(super) fn residuals(
    study: &DataSplit,
    rows: &[usize],
    forecast: &Forecast,
    shifts: &[Offset],
    scatter: Scatter,
    observable: Observable,
    factorwise: bool,
) -> Vec<Point> {
    let point = |(place, &index): (usize, &usize)| {
        let (row, shift) = (&study.rows[index], &shifts[index]);
        let said = mean(forecast.of(place), shift);
        let (reading, expected, scatter, chance) = match observable {
            Observable::NormalRestitution => (row.e_n.as_ref(), said.e_n, scatter.e_n, said.variance_e_n),
            Observable::TangentialRestitution => (row.e_t.as_ref(), said.e_t, scatter.e_t, said.variance_e_t),
            Observable::Capture => {
                let spread = said.capture * (1.0 - said.capture);
                return row.captured.map(|share| Point {
                    row: index,
                    // One step of the logistic fit: the residual in log odds and its information.
                    residual: (share - said.capture) / spread,
                    weight: spread * row.impacts,
                    factor: 1.0,
                });
            }
        };
        reading.map(|reading| {
            let residual = reading.value - expected;
            let own = (scatter * shift.spread).powi(2) + chance;
            let variance = reading.error.map_or(own / row.rebounds.max(1.0), |error| own + error * error);
            Point {
                row: index,
                residual,
                weight: ordinary(residual, variance.sqrt()) / variance,
                factor: if factorwise { expected } else { 1.0 },
            }
        })
    };
    rows.iter().enumerate().filter_map(point).collect()
}

fn scores(
    study: &DataSplit,
    rows: &[usize],
    forecast: &Forecast,
    shifts: &[Offset],
    scatter: Scatter,
) -> Vec<f64> {
    let one = |(place, &index): (usize, &usize)| {
        score(&study.rows[index], forecast.of(place), &shifts[index], scatter)
    };
    rows.iter().enumerate().map(one).collect()
}

/// A column in standard deviations from its mean, at most three; words and blanks are 0.
pub(super) fn standardised(values: &Values) -> Vec<f64> {
    let Values::Numbers(numbers) = values else {
        let Values::Words { of_row, .. } = values else { return Vec::new() };
        return vec![0.0; of_row.len()];
    };
    let finite: Vec<f64> = numbers.iter().copied().filter(|value| value.is_finite()).collect();
    let count = finite.len().max(1) as f64;
    let mean = finite.iter().sum::<f64>() / count;
    let deviation = (finite.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt();
    let z = |value: &f64| {
        if value.is_finite() && deviation > 0.0 { ((value - mean) / deviation).clamp(-3.0, 3.0) } else { 0.0 }
    };
    numbers.iter().map(z).collect()
}
