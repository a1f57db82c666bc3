//! Numbers that several files of this module use.

use super::likelihood::Scatter;

/// Least number of rows of a diagnosis, of a comparison, and of held-out rows for a gain.
pub(super) const LEAST_ROWS: usize = 3;
/// Random draws a row of a stochastic model, as many as `nearwall predict` takes.
pub(super) const ROW_DRAWS: usize = 64;
/// First guess of the scatter of `e_n` and `e_t` [1].
pub(super) const FIRST_SCATTER: Scatter = [0.1, 0.1];
/// Resamples of a bootstrap of errors.
pub(super) const BOOTSTRAP_RESAMPLES: usize = 1000;
/// p-value at which a model is refuted [1].
pub(super) const REFUTED: f64 = 0.01;
/// Probability from which on a cause is named [1].
pub(super) const NAMED: f64 = 0.8;
/// Probability of the listed explanations together [1].
pub(super) const LISTED: f64 = 0.95;

/// How far the search among explanations goes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Effort {
    /// Expansions of explanations, in that of the base model.
    pub expanded: usize,
    /// Explanations of each expansion of which all parameters are fitted together.
    pub refitted: usize,
}

/// Of measured impacts.
pub(super) const THOROUGH: Effort = Effort { expanded: 6, refitted: 3 };
/// Of rigs, whose candidates are looked at in one table: only fits cost predictions.
pub(super) const THOROUGH_RIG: Effort = Effort { expanded: 4, refitted: 12 };
pub(super) const QUICK_RIG: Effort = Effort { expanded: 3, refitted: 0 };
