//! The test of chi-square.

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Probability of a larger chi-square with so many degrees of freedom [1]; 1 without any.
pub(super) fn p_value(chi_square: f64, freedom: f64) -> f64 {
    ChiSquared::new(freedom).map_or(1.0, |law| law.sf(chi_square))
}

#[cfg(test)]
mod tests {
    /// Abramowitz and Stegun 1964, table 26.8: 3.84146 with one and 18.3070 with ten degrees of freedom are exceeded
    /// once in twenty.
    #[test]
    fn a_twentieth_lies_beyond_the_values_of_the_table() {
        for (chi_square, freedom) in [(3.84146, 1.0), (18.3070, 10.0)] {
            let p = super::p_value(chi_square, freedom);
            assert!((p - 0.05).abs() < 1e-6, "{p}");
        }
        assert_eq!(super::p_value(3.0, 0.0), 1.0);
    }
}
