//! Bootstrap over groups, with the same resamples for all models and measures: differences of models are paired.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::super::constants::BOOTSTRAP_RESAMPLES;
use super::measure::{ComparisonMeasure, MEASURES, Totals};

/// Least number of groups for an interval.
const LEAST_BOOTSTRAP_GROUPS: usize = 3;

/// The measures of all models on all rows and on every resample.
pub(super) struct Bootstrap {
    /// By model and measure; not a number where nothing was measured.
    pub values: Vec<[f64; MEASURES]>,
    /// By resample, model and measure; empty where there are too few groups.
    resampled: Vec<Vec<[f64; MEASURES]>>,
}

impl Bootstrap {
    pub fn new(totals: &[Totals], groups: usize, seed: u64) -> Self {
        let values = measures(totals, 0..groups);
        let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x636f_6d70);
        let mut resample = |_| {
            let mut draw = || (random.next_u64() % groups as u64) as usize;
            let drawn: Vec<usize> = (0..groups).map(|_| draw()).collect();
            measures(totals, drawn.into_iter())
        };
        let count = if groups < LEAST_BOOTSTRAP_GROUPS { 0 } else { BOOTSTRAP_RESAMPLES };
        Self { values, resampled: (0..count).map(&mut resample).collect() }
    }

    /// 95 % interval of a measure of a model.
    pub fn interval(&self, model: usize, measure: ComparisonMeasure) -> Option<[f64; 2]> {
        ends(self.resampled.iter().map(|models| models[model][measure as usize]))
    }

    /// 95 % interval of how much worse a model is than `best` in a measure.
    pub fn excess_interval(&self, model: usize, best: usize, measure: ComparisonMeasure) -> Option<[f64; 2]> {
        let which = measure as usize;
        ends(self.resampled.iter().map(|models| measure.excess(models[model][which], models[best][which])))
    }

    /// The best model in a measure, the first of equals; `None` where nothing was measured.
    pub fn best(&self, measure: ComparisonMeasure) -> Option<usize> {
        let value = |model: usize| self.values[model][measure as usize];
        let models = (0..self.values.len()).filter(|model| value(*model).is_finite());
        models.min_by(|a, b| measure.excess(value(*a), value(*b)).total_cmp(&0.0))
    }
}

/// The measures of every model over some groups.
fn measures(totals: &[Totals], groups: impl Iterator<Item = usize> + Clone) -> Vec<[f64; MEASURES]> {
    let of_model = |totals: &Totals| {
        let mut sums = [[0.0; 2]; MEASURES];
        for group in groups.clone() {
            let own = totals.of_group[group].as_flattened();
            sums.as_flattened_mut().iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
        }
        ComparisonMeasure::ALL.map(|measure| measure.value(sums[measure as usize]))
    };
    totals.iter().map(of_model).collect()
}

/// The middle 95 % of the finite values; `None` without any.
fn ends(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let mut sorted: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    let cut = sorted.len() / 40;
    Some([sorted[cut], sorted[last - cut]])
}
