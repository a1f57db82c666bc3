//! Splits the measured rows: three quarters for fits and choices, the last quarter for the gain alone.

use std::sync::Arc;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::dataset::{Column, Measurement, Measurements, Values};
use crate::impact::INPUTS;
use crate::model::Model;

/// Folds of the cross-validation.
const FOLDS: usize = 5;
/// Largest number of rows in the search for causes; more rows would only take longer.
const SEARCH_ROWS: usize = 1000;
/// Largest number of rows in the final fit of the parameters.
const FIT_ROWS: usize = 10_000;
/// The same for a stochastic model.
const STOCHASTIC_FIT_ROWS: usize = 1000;
/// Largest number of rows on which the gain is measured.
const GAIN_ROWS: usize = 20_000;
/// Random draws a row of a stochastic model, in the search and in the final fit.
const COARSE_DRAWS: usize = 16;
const FINE_DRAWS: usize = 64;

/// A column that may explain the residuals: an input of the model or a further column of the file.
#[derive(Debug, Clone)]
pub(super) struct Covariate {
    pub name: String,
    /// SI unit of an input; empty for a further column.
    pub unit: &'static str,
    pub values: Values,
    /// Whether it is an input of the model.
    pub input: bool,
}

impl Covariate {
    fn varies(&self) -> bool {
        match &self.values {
            Values::Numbers(numbers) => {
                let mut finite = numbers.iter().filter(|value| value.is_finite());
                finite.next().is_some_and(|first| finite.any(|value| value != first))
            }
            Values::Labels { levels, .. } => levels.len() > 1,
        }
    }

    /// A row's number or the index of its label; NaN where blank.
    pub fn cell(&self, row: usize) -> f64 {
        match &self.values {
            Values::Numbers(numbers) => numbers[row],
            Values::Labels { of_row, .. } => of_row[row].map_or(f64::NAN, |level| level as f64),
        }
    }

    /// Distance from the mean in standard deviations, at most three; labels and blanks are 0.
    pub fn standardised(&self) -> Vec<f64> {
        let numbers = match &self.values {
            Values::Numbers(numbers) => numbers,
            Values::Labels { of_row, .. } => return vec![0.0; of_row.len()],
        };
        let finite: Vec<f64> = numbers.iter().copied().filter(|value| value.is_finite()).collect();
        let count = finite.len().max(1) as f64;
        let mean = finite.iter().sum::<f64>() / count;
        let deviation = (finite.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt();
        let z = |value: &f64| {
            if value.is_finite() && deviation > 0.0 {
                ((value - mean) / deviation).clamp(-3.0, 3.0)
            } else {
                0.0
            }
        };
        numbers.iter().map(z).collect()
    }
}

/// One fold of the cross-validation, as places in [`DataSplit::search`].
#[derive(Debug, Clone)]
pub(super) struct Fold {
    /// Rows that are scored.
    pub inside: Vec<usize>,
    /// Rows that are fitted.
    pub outside: Vec<usize>,
}

/// The base model and the measured rows, with the role of each row. It does not change during a diagnosis.
#[derive(Debug, Clone)]
pub(super) struct DataSplit {
    pub base: Model,
    pub rows: Arc<[Measurement]>,
    /// All columns that vary.
    pub covariates: Arc<[Covariate]>,
    /// Rows of the search for causes.
    pub search: Vec<usize>,
    pub folds: Vec<Fold>,
    /// Rows of the final fit: those of the search and more.
    pub fit: Vec<usize>,
    /// Rows that no fit and no choice uses.
    pub held_out: Vec<usize>,
    /// Random draws a row where a model is stochastic.
    pub draws: usize,
}

/// The numbers below `count` in random order; the same seed gives the same order.
pub(super) fn shuffled(count: usize, seed: u64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    for place in (1..count).rev() {
        let other = (random.next_u64() % (place as u64 + 1)) as usize;
        order.swap(place, other);
    }
    order
}

impl DataSplit {
    /// Shuffles and splits the rows; the same seed gives the same split.
    pub fn new(base: &Model, data: Measurements, seed: u64) -> Self {
        let mut order = shuffled(data.rows.len(), seed);
        let mut held_out = order.split_off(order.len() - order.len() / 4);
        held_out.truncate(GAIN_ROWS);
        order.truncate(FIT_ROWS);
        let search = order[..order.len().min(SEARCH_ROWS)].to_vec();
        let places = |fold: usize| (fold..search.len()).step_by(FOLDS);
        let fold = |fold: usize| Fold {
            inside: places(fold).collect(),
            outside: (0..FOLDS).filter(|other| *other != fold).flat_map(places).collect(),
        };
        Self {
            base: base.clone(),
            covariates: covariates(&data).into(),
            folds: (0..FOLDS).map(fold).collect(),
            search,
            fit: order,
            held_out,
            rows: data.rows.into(),
            draws: COARSE_DRAWS,
        }
    }

    /// The split for the final fit: more draws a row, and fewer rows for a stochastic model.
    pub fn fine(&self, stochastic: bool) -> Self {
        let mut fine = Self { draws: FINE_DRAWS, ..self.clone() };
        if stochastic {
            fine.fit.truncate(STOCHASTIC_FIT_ROWS);
        }
        fine
    }

    /// Other rows under the same base model, none of them fitted.
    pub fn with_rows(&self, rows: Vec<Measurement>, covariates: Vec<Covariate>) -> Self {
        let (search, folds, fit, held_out) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (rows, covariates) = (rows.into(), covariates.into());
        Self { base: self.base.clone(), rows, covariates, search, folds, fit, held_out, draws: COARSE_DRAWS }
    }

    /// The indices of all rows.
    pub fn all(&self) -> Vec<usize> {
        (0..self.rows.len()).collect()
    }

    /// The cells of a covariate; none if no column varies. A constant offset needs none.
    pub fn values(&self, covariate: usize) -> &Values {
        static NONE: Values = Values::Numbers(Vec::new());
        self.covariates.get(covariate).map_or(&NONE, |covariate| &covariate.values)
    }

    /// The covariate of this name.
    pub fn covariate(&self, name: &str) -> Option<&Covariate> {
        self.covariates.iter().find(|covariate| covariate.name == name)
    }

    /// The least and largest value of an input in the fitted rows, if it varies.
    pub fn range(&self, input: &str) -> Option<[f64; 2]> {
        let Values::Numbers(numbers) = &self.covariate(input)?.values else { return None };
        let fitted = self.fit.iter().map(|&row| numbers[row]).filter(|value| value.is_finite());
        let [low, high] = fitted.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)]);
        (high > low).then_some([low, high])
    }
}

/// The inputs that the file states and its further columns, if they vary.
fn covariates(data: &Measurements) -> Vec<Covariate> {
    let given = INPUTS.iter().filter(|input| data.given.contains(&input.name));
    let inputs = given.map(|input| Covariate {
        name: input.name.to_owned(),
        unit: input.unit,
        values: Values::Numbers(data.rows.iter().map(|row| (input.value)(&row.impact)).collect()),
        input: true,
    });
    let further = data.columns.iter().map(|Column { name, values }| Covariate {
        name: name.clone(),
        unit: "",
        values: values.clone(),
        input: false,
    });
    inputs.chain(further).filter(Covariate::varies).collect()
}
