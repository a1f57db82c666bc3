//! The error that rows of one group share: its standard deviation and its most likely value in each group.
//!
//! Residuals `r_i` with variances `v_i` and a shared error `b` of variance `tau²`: with `S = Σ
//! 1/v_i` and `R = Σ r_i/v_i` over a group, `b = tau² R / (1 + tau² S)` with the variance `tau² /
//! (1 + tau² S)`, and the log likelihood changes by `½ tau² R² / (1 + tau² S) - ½ ln(1 + tau² S)`.
//! `tau` maximises the sum over groups.

/// Standard deviations tried [1].
const SMALLEST_DEVIATION: f64 = 1e-4;
const LARGEST_DEVIATION: f64 = 2.0;
/// Steps of the search for the standard deviation, on a logarithmic scale.
const DEVIATION_STEPS: usize = 28;

/// Sums over the rows of one group, of `e_n` and `e_t`.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct GroupSums {
    /// `Σ 1/v`.
    pub weight: [f64; 2],
    /// `Σ r/v`.
    pub residual: [f64; 2],
    /// Number of rows.
    pub rows: f64,
}

/// The shared errors of all groups.
#[derive(Debug, Clone, Default)]
pub(super) struct SharedErrors {
    /// Standard deviation of the shared error of `e_n` and `e_t` [1].
    pub scatter: [f64; 2],
    groups: Vec<GroupSums>,
}

impl SharedErrors {
    /// The standard deviations of largest likelihood.
    pub fn fit(groups: Vec<GroupSums>) -> Self {
        let scatter = [0, 1].map(|which| {
            let gain = |tau: f64| groups.iter().map(|group| gain(group, which, tau * tau)).sum::<f64>();
            let place = |step: usize| {
                SMALLEST_DEVIATION
                    * (LARGEST_DEVIATION / SMALLEST_DEVIATION).powf(step as f64 / DEVIATION_STEPS as f64)
            };
            let best = (0..=DEVIATION_STEPS)
                .map(place)
                .map(|tau| (tau, gain(tau)))
                .max_by(|a, b| a.1.total_cmp(&b.1));
            best.map_or(0.0, |(tau, gain)| if gain > 0.0 { tau } else { 0.0 })
        });
        Self { scatter, groups }
    }

    /// Most likely shared error of a group [1].
    pub fn offset(&self, group: usize) -> [f64; 2] {
        self.each(group, |square, weight, residual| square * residual / (1.0 + square * weight))
    }

    /// Variance of that value [1].
    pub fn variance(&self, group: usize) -> [f64; 2] {
        self.each(group, |square, weight, _| square / (1.0 + square * weight))
    }

    /// What the log score of each row of a group loses beside the shared errors [nats].
    pub fn cost(&self, group: usize) -> f64 {
        let terms = self.each(group, |square, weight, residual| {
            let b = square * residual / (1.0 + square * weight);
            let prior = if square > 0.0 { 0.5 * b * b / square } else { 0.0 };
            prior + 0.5 * (1.0 + square * weight).ln()
        });
        let rows = self.groups.get(group).map_or(1.0, |sums| sums.rows.max(1.0));
        (terms[0] + terms[1]) / rows
    }

    fn each(&self, group: usize, of: impl Fn(f64, f64, f64) -> f64) -> [f64; 2] {
        let sums = self.groups.get(group).copied().unwrap_or_default();
        [0, 1].map(|which| of(self.scatter[which].powi(2), sums.weight[which], sums.residual[which]))
    }
}

/// Gain of one group by a shared error of this variance [nats].
fn gain(group: &GroupSums, which: usize, square: f64) -> f64 {
    let (weight, residual) = (group.weight[which], group.residual[which]);
    let factor = 1.0 + square * weight;
    0.5 * square * residual * residual / factor - 0.5 * factor.ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marginal_likelihood_of_two_rows_by_hand() {
        // Residuals 1 and 3 with unit variance, tau² = 2: covariance [[3, 2], [2, 3]], determinant 5.
        let group = GroupSums { weight: [2.0, 0.0], residual: [4.0, 0.0], rows: 2.0 };
        let inverse = |x: f64, y: f64| (3.0 * x * x - 4.0 * x * y + 3.0 * y * y) / 5.0;
        let whole = -0.5 * 5f64.ln() - 0.5 * inverse(1.0, 3.0);
        let apart = -0.5 * (1.0 + 9.0);
        assert!((gain(&group, 0, 2.0) - (whole - apart)).abs() < 1e-12);
    }
}
