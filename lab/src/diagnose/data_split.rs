//! The measured rows and their roles: all of them for a choice, or some held out for the gain.

use std::sync::Arc;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::group_column::group_columns;
use super::groups::{GroupColumn, units};
use super::input_error::corrected;
use super::likelihood::{Offset, Outliers};
use super::missing_inputs::MissingInputs;
use super::rounding::Rounding;
use crate::dataset::{ColumnValues, DataColumn, Measurement, Measurements};
use nearwall::impact::INPUTS;
use nearwall::model::Model;

/// Largest number of rows in the search for causes; more rows would only take longer.
const SEARCH_ROWS: usize = 1000;
/// Largest number of rows in the final fit of the parameters.
const FIT_ROWS: usize = 10_000;
/// The same for a stochastic model.
const STOCHASTIC_FIT_ROWS: usize = 1000;
/// Random draws a row of a stochastic model, in the search and in the final fit.
pub(super) const COARSE_DRAWS: usize = 16;
const FINE_DRAWS: usize = 64;
/// So many groups can be tested as units.
const MANY_GROUPS: usize = 10;
/// Largest distance from the mean that counts [standard deviations].
const FARTHEST_DEVIATION: f64 = 4.0;
/// With fewer readings no gross errors are expected: a row that looks like one is evidence.
const MANY_READINGS: usize = 30;

/// What a column is.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ColumnKind {
    /// An input of every impact.
    Input,
    /// Another column of the file.
    Further,
    /// A dimensionless group.
    Group {
        /// The columns with their exponents of a product of columns; empty for a built-in group.
        factors: Vec<(String, f64)>,
        /// The columns of the file that it needs, with their medians.
        needs: Vec<(String, f64)>,
    },
}

/// A column that may explain the residuals.
#[derive(Debug, Clone)]
pub(super) struct Covariate {
    pub name: String,
    /// SI unit; empty for a further column without one.
    pub unit: &'static str,
    /// Blank cells of numbers have the median, which has no effect of its own.
    pub values: ColumnValues,
    /// Rows with a blank cell.
    pub blank: Arc<[bool]>,
    pub kind: ColumnKind,
}

impl Covariate {
    pub fn new(name: &str, unit: &'static str, mut values: ColumnValues, kind: ColumnKind) -> Self {
        let blank = match &mut values {
            ColumnValues::Numbers(numbers) => {
                let blank: Vec<bool> = numbers.iter().map(|number| !number.is_finite()).collect();
                let middle = median(numbers.iter().copied().filter(|number| number.is_finite()));
                numbers.iter_mut().filter(|number| !number.is_finite()).for_each(|number| *number = middle);
                blank
            }
            ColumnValues::Labels { of_row, .. } => of_row.iter().map(Option::is_none).collect(),
        };
        Self { name: name.to_owned(), unit, values, blank: blank.into(), kind }
    }

    pub fn is_input(&self) -> bool {
        self.kind == ColumnKind::Input
    }

    pub fn is_group(&self) -> bool {
        matches!(self.kind, ColumnKind::Group { .. })
    }

    fn varies(&self) -> bool {
        match &self.values {
            ColumnValues::Numbers(numbers) => {
                let mut finite = numbers.iter().filter(|value| value.is_finite());
                finite.next().is_some_and(|first| finite.any(|value| value != first))
            }
            ColumnValues::Labels { levels, .. } => levels.len() > 1,
        }
    }

    /// A row's number or the index of its label; NaN where blank.
    pub fn cell(&self, row: usize) -> f64 {
        match &self.values {
            ColumnValues::Numbers(_) if self.blank[row] => f64::NAN,
            ColumnValues::Numbers(numbers) => numbers[row],
            ColumnValues::Labels { of_row, .. } => of_row[row].map_or(f64::NAN, |level| level as f64),
        }
    }

    /// The median of a column of numbers.
    pub fn median(&self) -> f64 {
        match &self.values {
            ColumnValues::Numbers(numbers) => median(numbers.iter().copied()),
            ColumnValues::Labels { .. } => f64::NAN,
        }
    }

    /// Distance from the mean in standard deviations; labels are 0.
    pub fn standardised(&self) -> Vec<f64> {
        match &self.values {
            ColumnValues::Numbers(numbers) => standardised(numbers.iter().copied()),
            ColumnValues::Labels { of_row, .. } => vec![0.0; of_row.len()],
        }
    }
}

/// Distances from the mean in standard deviations, at most [`FARTHEST_DEVIATION`].
pub(super) fn standardised(values: impl Iterator<Item = f64> + Clone) -> Vec<f64> {
    let count = values.clone().count().max(1) as f64;
    let mean = values.clone().sum::<f64>() / count;
    let deviation = (values.clone().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt();
    let z = |value: f64| {
        if deviation > 0.0 {
            ((value - mean) / deviation).clamp(-FARTHEST_DEVIATION, FARTHEST_DEVIATION)
        } else {
            0.0
        }
    };
    values.map(z).collect()
}

/// The median of some numbers; NaN of none.
pub(super) fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = numbers.collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The base model and the measured rows, with the role of each row. It does not change during a choice.
#[derive(Debug, Clone)]
pub(super) struct DataSplit {
    pub base: Model,
    /// The rows; inputs with stated errors have their expected values.
    pub rows: Arc<[Measurement]>,
    /// What the file shows of inputs that some rows lack.
    pub missing: Arc<MissingInputs>,
    /// All columns that vary.
    pub covariates: Arc<[Covariate]>,
    /// What is known of the noise of each row.
    pub noise: Arc<[Offset]>,
    /// The independent unit of each row.
    pub units: Arc<[usize]>,
    /// Number of units.
    pub unit_count: usize,
    /// Groups whose rows share an error that is estimated.
    pub shared: Option<GroupColumn>,
    /// Rows of the search for causes.
    pub search: Vec<usize>,
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
    /// All rows for the choice and the fit, none held out; `groups` are the columns that group them.
    pub fn new(base: &Model, data: &Measurements, groups: &[GroupColumn]) -> Self {
        let readings =
            data.rows.iter().map(|row| usize::from(row.e_n.is_some()) + usize::from(row.e_t.is_some()));
        let is_few = readings.sum::<usize>() < MANY_READINGS;
        let outliers = if is_few { Outliers::NONE } else { Outliers::EXPECTED };
        let (rows, mut noise) = corrected(base, data);
        Rounding::of(&rows).note(&rows, &mut noise);
        for (offset, row) in noise.iter_mut().zip(&rows) {
            offset.outliers = [outliers; 2];
            let least = data.detection.least_e_n(&row.impact);
            offset.visible_from = if least > 0.0 { least } else { f64::NEG_INFINITY };
        }
        let (units, unit_count) = units(data);
        let missing = MissingInputs::of(&rows);
        let excluded: Vec<&str> = groups.iter().map(|groups| groups.name.as_str()).collect();
        let all: Vec<usize> = (0..rows.len()).collect();
        let whole = Self {
            base: base.clone(),
            covariates: covariates(base, data, &missing, &excluded).into(),
            missing: missing.into(),
            rows: rows.into(),
            noise: noise.into(),
            units,
            unit_count,
            shared: None,
            search: Vec::new(),
            fit: Vec::new(),
            held_out: Vec::new(),
            draws: COARSE_DRAWS,
        };
        whole.fitting(&all)
    }

    /// The same rows, of which only `fitted` are used for choices and fits, and all others are held out.
    pub fn fitting(&self, fitted: &[usize]) -> Self {
        // A fixed order that no column follows, so that the search of a large file sees all of it.
        let mut fit: Vec<usize> = shuffled(fitted.len(), 0).into_iter().map(|place| fitted[place]).collect();
        let mut used = vec![false; self.rows.len()];
        fit.iter().for_each(|&row| used[row] = true);
        let held_out = (0..self.rows.len()).filter(|&row| !used[row]).collect();
        fit.truncate(FIT_ROWS);
        let search = fit[..fit.len().min(SEARCH_ROWS)].to_vec();
        Self { search, fit, held_out, ..self.clone() }
    }

    /// Whether the search for causes would use these rows no better than three quarters of them.
    pub fn is_large(&self) -> bool {
        3 * self.rows.len() >= 4 * SEARCH_ROWS
    }

    /// The same rows with an error that the rows of each group share; each of many groups is then one unit.
    pub fn with_shared_errors(&self, groups: &GroupColumn) -> Self {
        // Few groups cannot be tested as units; the likelihood then takes care of what their rows share.
        let (units, unit_count) = match groups.count >= MANY_GROUPS {
            true => (groups.of_row.clone(), groups.count),
            false => (self.units.clone(), self.unit_count),
        };
        Self { shared: Some(groups.clone()), units, unit_count, ..self.clone() }
    }

    /// Shares of the readings of `e_n` and `e_t` in a heavy tail, the same for all rows [1].
    pub fn tails(&self) -> [f64; 2] {
        self.noise.first().map_or([0.0; 2], |offset| offset.outliers.map(|one| one.tails))
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
        let missing = self.missing.clone();
        Self { covariates: covariates.into(), missing, ..Self::bare(&self.base, &rows, COARSE_DRAWS) }
    }

    /// The rows of the search alone, in its order; all of them are fitted.
    pub fn searched(&self) -> Self {
        let places = &self.search;
        let covariate = |one: &Covariate| Covariate {
            values: one.values.at(places),
            blank: places.iter().map(|&row| one.blank[row]).collect(),
            ..one.clone()
        };
        let all: Vec<usize> = (0..places.len()).collect();
        Self {
            rows: places.iter().map(|&row| self.rows[row]).collect(),
            covariates: self.covariates.iter().map(covariate).collect(),
            noise: places.iter().map(|&row| self.noise[row]).collect(),
            units: places.iter().map(|&row| self.units[row]).collect(),
            shared: self.shared.as_ref().map(|groups| groups.of_rows(places)),
            search: all.clone(),
            fit: all,
            held_out: Vec::new(),
            ..self.clone()
        }
    }

    /// Rows without columns, none of them fitted, for the errors of a finished model.
    pub fn bare(base: &Model, rows: &[Measurement], draws: usize) -> Self {
        Self {
            base: base.clone(),
            rows: rows.into(),
            missing: MissingInputs::of(rows).into(),
            covariates: Arc::new([]),
            noise: vec![Offset::default(); rows.len()].into(),
            units: (0..rows.len()).collect(),
            unit_count: rows.len(),
            shared: None,
            search: Vec::new(),
            fit: Vec::new(),
            held_out: Vec::new(),
            draws,
        }
    }

    /// The indices of all rows.
    pub fn all(&self) -> Vec<usize> {
        (0..self.rows.len()).collect()
    }

    /// Number of independent units among these rows.
    pub fn unit_count_of(&self, rows: &[usize]) -> usize {
        rows.iter().map(|&row| self.units[row]).collect::<std::collections::HashSet<_>>().len()
    }

    /// Number of rows in the search with a measured `e_n`, and with a measured `e_t`.
    pub fn readings(&self) -> [usize; 2] {
        let count =
            |of: fn(&Measurement) -> bool| self.search.iter().filter(|&&row| of(&self.rows[row])).count();
        [count(|row| row.e_n.is_some()), count(|row| row.e_t.is_some())]
    }

    /// The cells of a covariate; none if no column varies. A constant offset needs none.
    pub fn values(&self, covariate: usize) -> &ColumnValues {
        static NONE: ColumnValues = ColumnValues::Numbers(Vec::new());
        self.covariates.get(covariate).map_or(&NONE, |covariate| &covariate.values)
    }

    /// The values that stand for a blank cell of an input; none for other cells.
    pub fn shown_instead(&self, covariate: usize, row: usize) -> &[f64] {
        let blank =
            self.covariates.get(covariate).filter(|covariate| covariate.is_input() && covariate.blank[row]);
        let input = blank.and_then(|blank| INPUTS.iter().position(|input| input.name == blank.name));
        input.map_or(&[], |input| self.missing.values(input))
    }

    /// The covariate of this name.
    pub fn covariate(&self, name: &str) -> Option<&Covariate> {
        self.covariates.iter().find(|covariate| covariate.name == name)
    }

    /// The least and largest value of an input in the fitted rows, if it varies.
    pub fn range(&self, input: &str) -> Option<[f64; 2]> {
        let ColumnValues::Numbers(numbers) = &self.covariate(input)?.values else { return None };
        let fitted = self.fit.iter().map(|&row| numbers[row]).filter(|value| value.is_finite());
        let [low, high] = fitted.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)]);
        (high > low).then_some([low, high])
    }
}

/// The inputs that the file states, its further columns and the groups of both, if they vary; without columns that
/// group the rows.
fn covariates(base: &Model, data: &Measurements, missing: &MissingInputs, groups: &[&str]) -> Vec<Covariate> {
    let given = INPUTS.iter().enumerate().filter(|(_, input)| data.given.contains(&input.name));
    let inputs = given.map(|(place, input)| {
        let lacks = |row: &Measurement| !row.stated[place] && !missing.values(place).is_empty();
        let cell = |row: &Measurement| if lacks(row) { f64::NAN } else { (input.value)(&row.impact) };
        let numbers = data.rows.iter().map(cell).collect();
        Covariate::new(input.name, input.unit, ColumnValues::Numbers(numbers), ColumnKind::Input)
    });
    let declared = data.given_extra.iter().filter_map(|&place| {
        let input = base.extra_inputs().get(place)?;
        let cell = |row: &Measurement| row.impact.extra[place];
        let values = if input.is_label() {
            let label = |row: &Measurement| (cell(row) >= 0.0).then(|| cell(row) as usize);
            ColumnValues::Labels {
                levels: input.labels.clone(),
                of_row: data.rows.iter().map(label).collect(),
            }
        } else {
            ColumnValues::Numbers(data.rows.iter().map(cell).collect())
        };
        Some(Covariate::new(&input.name, "", values, ColumnKind::Further))
    });
    let further = data.columns.iter().filter(|column| !groups.contains(&column.name.as_str()));
    let further = further.map(|DataColumn { name, unit, values }| {
        Covariate::new(name, unit, values.clone(), ColumnKind::Further)
    });
    let mut all: Vec<Covariate> = inputs.chain(declared).chain(further).filter(Covariate::varies).collect();
    let groups = group_columns(base, data, &all, &|row| missing.lacks(row));
    all.extend(groups.into_iter().filter(Covariate::varies));
    all
}
