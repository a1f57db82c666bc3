//! The rows of a diagnosis and who sees them: three quarters for fits and choices, in five folds, one quarter for nobody
//! until the gain is measured.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::forecast::{COARSE, FINE};
use crate::dataset::{Column, Measurement, Measurements, Values};
use crate::impact::INPUTS;
use crate::model::Model;

/// Folds of the cross-validation.
const FOLDS: usize = 5;
/// Rows that the search for causes looks at; more would not change a choice, only take longer.
const SEARCH_ROWS: usize = 1000;
/// Rows that the last fit of the chosen parameters looks at.
const FIT_ROWS: usize = 10_000;
/// The same where a model leaves something to chance.
const FIT_ROWS_BY_CHANCE: usize = 1000;
/// Rows that the gain is measured on.
const GAIN_ROWS: usize = 20_000;

/// A column that may matter: an input of the model or one of the file's own.
#[derive(Debug, Clone)]
pub(super) struct Factor {
    pub name: String,
    /// SI unit of an input, empty for the file's own columns.
    pub unit: &'static str,
    pub values: Values,
    /// Whether it is an input of the model.
    pub input: bool,
}

/// Everything that stays the same during a diagnosis.
#[derive(Debug)]
pub(super) struct DataSplit {
    pub base: Model,
    pub rows: Vec<Measurement>,
    pub factors: Vec<Factor>,
    /// Rows that the search sees, by fold.
    pub folds: Vec<Vec<usize>>,
    /// All of [`DataSplit::folds`].
    pub search: Vec<usize>,
    /// Rows that the last fit sees: those of the search and more.
    pub fit: Vec<usize>,
    /// Rows that no fit and no choice sees.
    pub held_out: Vec<usize>,
    /// Draws a row where a model leaves something to chance.
    pub draws: usize,
}

impl DataSplit {
    /// Deals the rows out; the same seed deals the same.
    pub fn new(base: &Model, data: &Measurements, seed: u64) -> Self {
        let mut order: Vec<usize> = (0..data.rows.len()).collect();
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        for place in (1..order.len()).rev() {
            let other = (random.next_u64() % (place as u64 + 1)) as usize;
            order.swap(place, other);
        }
        let held_out = order.split_off(order.len() - order.len() / 4);
        let search: Vec<usize> = order.iter().copied().take(SEARCH_ROWS).collect();
        let folds =
            (0..FOLDS).map(|fold| search.iter().copied().skip(fold).step_by(FOLDS).collect()).collect();
        Self {
            base: base.clone(),
            factors: factors(data),
            folds,
            fit: order.into_iter().take(FIT_ROWS).collect(),
            search,
            held_out: held_out.into_iter().take(GAIN_ROWS).collect(),
            rows: data.rows.clone(),
            draws: COARSE,
        }
    }

    /// For the last fit: more draws a row, and fewer rows where there is chance, since each costs more.
    #[must_use]
    pub fn fine(mut self, by_chance: bool) -> Self {
        self.draws = FINE;
        if by_chance {
            self.fit.truncate(FIT_ROWS_BY_CHANCE);
        }
        self
    }

    /// The rows of the search outside one fold.
    pub fn outside(&self, fold: usize) -> Vec<usize> {
        let others = self.folds.iter().enumerate().filter(|(index, _)| *index != fold);
        others.flat_map(|(_, rows)| rows.iter().copied()).collect()
    }

    /// The cells of a factor; none where no column varies, as a level asks for, which looks at no column.
    pub fn values(&self, factor: usize) -> &Values {
        static NONE: Values = Values::Numbers(Vec::new());
        self.factors.get(factor).map_or(&NONE, |factor| &factor.values)
    }

    /// The factor of this name.
    pub fn factor(&self, name: &str) -> Option<&Factor> {
        self.factors.iter().find(|factor| factor.name == name)
    }

    /// The least and largest value of an input in the rows that fits see, where it varies.
    pub fn range(&self, input: &str) -> Option<[f64; 2]> {
        let Values::Numbers(numbers) = &self.factor(input)?.values else { return None };
        let seen = self.fit.iter().map(|&row| numbers[row]).filter(|value| value.is_finite());
        let [low, high] = seen.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)]);
        (high > low).then_some([low, high])
    }
}

/// The inputs that the file gives and its own columns, as far as they vary.
fn factors(data: &Measurements) -> Vec<Factor> {
    let given = INPUTS.iter().filter(|input| data.given.contains(&input.name));
    let inputs = given.map(|input| Factor {
        name: input.name.to_owned(),
        unit: input.unit,
        values: Values::Numbers(data.rows.iter().map(|row| (input.value)(&row.impact)).collect()),
        input: true,
    });
    let own = data.columns.iter().map(|Column { name, values }| Factor {
        name: name.clone(),
        unit: "",
        values: values.clone(),
        input: false,
    });
    inputs.chain(own).filter(varies).collect()
}

fn varies(factor: &Factor) -> bool {
    match &factor.values {
        Values::Numbers(numbers) => {
            let mut finite = numbers.iter().filter(|value| value.is_finite());
            finite.next().is_some_and(|first| finite.any(|value| value != first))
        }
        Values::Words { levels, .. } => levels.len() > 1,
    }
}
