//! The measures of a model: log likelihood of a row, root mean square errors, log loss of capture.

use super::groups::RowGroups;
use super::score::ScoredRows;

/// Number of measures.
pub(super) const MEASURES: usize = 5;

/// A measure of the agreement of a model with the data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ComparisonMeasure {
    /// Mean log likelihood of a row, all observables together [nats]; higher is better.
    LogLikelihood,
    /// Root mean square error of `e_n` [1].
    NormalRestitution,
    /// Root mean square error of `e_t` [1].
    TangentialRestitution,
    /// Mean log loss of the capture of an impact [nats].
    Capture,
    /// Root mean square error of the other readings of a rig: shares [1].
    Share,
}

impl ComparisonMeasure {
    pub const ALL: [Self; MEASURES] = [
        Self::LogLikelihood,
        Self::NormalRestitution,
        Self::TangentialRestitution,
        Self::Capture,
        Self::Share,
    ];

    /// The measure of a sum over its weight.
    pub fn value(self, [sum, weight]: [f64; 2]) -> f64 {
        let mean = sum / weight;
        match self {
            Self::NormalRestitution | Self::TangentialRestitution | Self::Share => mean.sqrt(),
            Self::LogLikelihood | Self::Capture => mean,
        }
    }

    /// How much worse `value` is than `best`.
    pub fn excess(self, value: f64, best: f64) -> f64 {
        if self == Self::LogLikelihood { best - value } else { value - best }
    }
}

/// The sums of a model over each group.
pub(super) struct Totals {
    /// Sum and weight of each measure, by group.
    pub of_group: Vec<[[f64; 2]; MEASURES]>,
}

impl Totals {
    pub fn new(rows: &ScoredRows, groups: &RowGroups) -> Self {
        let mut of_group = vec![[[0.0; 2]; MEASURES]; groups.count];
        for (row, group) in groups.of_row.iter().enumerate() {
            let terms = ComparisonMeasure::ALL.map(|measure| term(measure, rows, row));
            for (sum, term) in of_group[*group].as_flattened_mut().iter_mut().zip(terms.as_flattened()) {
                *sum += term;
            }
        }
        Self { of_group }
    }
}

/// What a row adds to sum and weight of a measure; nothing where it was not measured.
fn term(measure: ComparisonMeasure, rows: &ScoredRows, row: usize) -> [f64; 2] {
    let pair = |which: usize| rows.pairs[which][row];
    let squared = |[measured, predicted]: [f64; 2]| [(measured - predicted).powi(2), 1.0];
    let term = match measure {
        ComparisonMeasure::LogLikelihood => Some([rows.likelihood[row], 1.0]),
        ComparisonMeasure::NormalRestitution => pair(0).map(squared),
        ComparisonMeasure::TangentialRestitution => pair(1).map(squared),
        ComparisonMeasure::Capture => pair(2).map(|[share, p]| {
            let loss = -(share * p.ln() + (1.0 - share) * (1.0 - p).ln());
            [rows.impacts[row] * loss, rows.impacts[row]]
        }),
        ComparisonMeasure::Share => None,
    };
    term.unwrap_or_default()
}
