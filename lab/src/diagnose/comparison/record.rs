//! The result of a comparison: the content of `compare.json`.

use serde::Serialize;

use super::bootstrap::Bootstrap;
use super::measure::ComparisonMeasure;

/// From this number of groups on, intervals of the bootstrap are reliable.
const RELIABLE_GROUPS: usize = 10;

/// The result of a comparison.
#[derive(Debug, Clone, Serialize)]
pub struct Comparison {
    /// `nearwall.compare/1`.
    pub schema: &'static str,
    /// Seed of the resamples.
    pub seed: u64,
    /// The result in a few sentences.
    pub verdict: String,
    /// The rows that rank the models.
    pub rows: GroupedRows,
    /// The models, the best first.
    pub models: Vec<ModelResult>,
}

/// The rows of the file, and those that rank the models.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct GroupedRows {
    /// Rows in the file.
    pub read: usize,
    /// Usable rows of a large file that were selected at random for every model; `None` if all were.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub selected: Option<usize>,
    /// Rows that every model decides: they rank the models.
    pub used: usize,
    /// Groups that the bootstrap draws.
    pub groups: usize,
    /// `series`, `row`, or `experiment` at a rig.
    pub group_by: &'static str,
}

/// A value with its 95 % interval; `None` with fewer than 3 groups.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Interval {
    /// The value on all rows that every model decides.
    pub value: f64,
    /// The ends of the interval.
    pub ci95: Option<[f64; 2]>,
    /// How much worse than the best model it is.
    pub behind_best: Difference,
}

/// How much worse a model is than the best one in a measure.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Difference {
    /// The difference; 0 for the best model.
    pub value: f64,
    /// The ends of its 95 % interval, with the same resamples for both models.
    pub ci95: Option<[f64; 2]>,
    /// Whether the interval excludes 0; false for the best model.
    pub told_apart: bool,
}

/// A model's measures; `None` where nothing was measured.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct ModelErrors {
    /// Mean log likelihood of a row, all observables together [nats].
    pub log_likelihood: Option<Interval>,
    /// Root mean square error of `e_n` [1].
    pub rmse_e_n: Option<Interval>,
    /// Root mean square error of `e_t` [1].
    pub rmse_e_t: Option<Interval>,
    /// Mean log loss of the capture of an impact [nats].
    pub log_loss_stick: Option<Interval>,
    /// Root mean square error of the shares that a rig reads [1].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rmse_share: Option<Interval>,
}

/// One model.
#[derive(Debug, Clone, Serialize)]
pub struct ModelResult {
    /// Its place, by mean log likelihood, from 1.
    pub rank: usize,
    /// Its file.
    pub model: String,
    /// Its measures.
    #[serde(flatten)]
    pub errors: ModelErrors,
    /// Scatter of single values of `e_n` and `e_t` about it [1]; 0 at a rig.
    pub scatter: [f64; 2],
    /// The rows that it cannot use.
    pub rows: ModelRows,
}

/// The rows that a model cannot use, or only outside its range, and those that fitted it.
#[derive(Debug, Clone, Default, Serialize)]
pub struct ModelRows {
    /// Rows that it cannot decide, or that cannot be read.
    pub undecided: usize,
    /// The first of them.
    pub first_reason: Option<String>,
    /// Rows outside the range that one of its laws is stated for; they are used.
    pub outside_range: usize,
    /// Rows of those that rank the models which fitted it, as its file says.
    pub fitted: usize,
}

/// The record of a comparison of the models `names`.
pub(super) fn comparison(
    names: &[&str],
    bootstrap: &Bootstrap,
    rows: GroupedRows,
    of_model: Vec<ModelRows>,
    scatter: Vec<[f64; 2]>,
    seed: u64,
) -> Comparison {
    let one = |(model, (rows, scatter)): (usize, (ModelRows, [f64; 2]))| ModelResult {
        rank: 0,
        model: names[model].to_owned(),
        errors: errors(bootstrap, model),
        scatter,
        rows,
    };
    let mut models: Vec<ModelResult> = of_model.into_iter().zip(scatter).enumerate().map(one).collect();
    let score =
        |model: &ModelResult| model.errors.log_likelihood.map_or(f64::NEG_INFINITY, |score| score.value);
    // Stable: equal models stay in the order of the command line.
    models.sort_by(|a, b| score(b).total_cmp(&score(a)));
    models.iter_mut().enumerate().for_each(|(place, model)| model.rank = place + 1);
    let verdict = verdict(&models, rows);
    Comparison { schema: "nearwall.compare/1", seed, verdict, rows, models }
}

fn errors(bootstrap: &Bootstrap, model: usize) -> ModelErrors {
    let of = |measure: ComparisonMeasure| {
        let which = measure as usize;
        let best = bootstrap.best(measure)?;
        let value = bootstrap.values[model][which];
        let behind = measure.excess(value, bootstrap.values[best][which]);
        let ci95 = bootstrap.excess_interval(model, best, measure);
        let told_apart = ci95.is_some_and(|[low, high]| low > 0.0 || high < 0.0);
        let behind_best = Difference { value: behind, ci95, told_apart };
        value.is_finite().then(|| Interval { value, ci95: bootstrap.interval(model, measure), behind_best })
    };
    ModelErrors {
        log_likelihood: of(ComparisonMeasure::LogLikelihood),
        rmse_e_n: of(ComparisonMeasure::NormalRestitution),
        rmse_e_t: of(ComparisonMeasure::TangentialRestitution),
        log_loss_stick: of(ComparisonMeasure::Capture),
        rmse_share: of(ComparisonMeasure::Share),
    }
}

/// The ranking in sentences.
fn verdict(models: &[ModelResult], rows: GroupedRows) -> String {
    let Some((best, others)) = models.split_first() else { return String::new() };
    let list = |apart: bool| {
        let told = |model: &&ModelResult| {
            model.errors.log_likelihood.is_some_and(|score| score.behind_best.told_apart) == apart
        };
        others.iter().filter(told).map(|model| model.model.as_str()).collect::<Vec<_>>().join(", ")
    };
    let (equal, worse) = (list(false), list(true));
    let mut text = format!("{} has the highest log likelihood.", best.model);
    if !equal.is_empty() {
        text += &format!(" These data cannot tell it apart from {equal}.");
    }
    if !worse.is_empty() {
        text += &format!(" Worse, beyond chance: {worse}.");
    }
    models.iter().for_each(|model| text += &fitted(model, rows.used));
    if rows.groups < RELIABLE_GROUPS {
        text += &format!(
            " With {} groups the intervals are too narrow; measure at least {RELIABLE_GROUPS}.",
            rows.groups
        );
    }
    text
}

/// What the rows that fitted a model, of so many, make of its comparison.
fn fitted(ModelResult { model, rows, .. }: &ModelResult, used: usize) -> String {
    match rows.fitted {
        0 => String::new(),
        count if count == used => format!(
            " All {used} rows fitted {model}: the comparison only measures its fit. Compare it on other rows."
        ),
        count => format!(
            " {count} of {used} rows of this file fitted {model}: the comparison is not a test of it. Leave them out."
        ),
    }
}
