//! Does a model fit at all? An absolute test of the base and of the extended model.
//!
//! Where all readings have stated errors: chi-square against those errors. Otherwise, where inputs
//! repeat exactly: the residuals between the means of replicates against those within (pure error;
//! Draper and Smith 1998, ch. 2). Otherwise only the structure of the residuals can be tested: the
//! smallest corrected p-value of any candidate of the round.

use std::collections::BTreeMap;

use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::chi_square;
use super::evaluation::{Evaluation, StatedResidual};
use super::hypothesis::Hypothesis;
use super::record::{Fit, FitTest, LargeMisfit};
use nearwall::impact::INPUTS;

/// Largest number of misfits listed, and least size of a listed one in standard errors.
pub(super) const MOST_LISTED: usize = 5;
const LEAST_MISFIT: f64 = 2.0;
/// Least number of degrees of freedom within replicates.
const LEAST_REPLICATES: usize = 5;

/// The tests of both models on the rows of the search; `structure` is the smallest corrected
/// p-value of a candidate beside each.
pub(super) fn fit(base: &Hypothesis<'_>, extended: &Hypothesis<'_>, structure: [f64; 2]) -> Fit {
    let parameters = extended.freedom();
    let [before, after] = [base, extended].map(rows_alone);
    let largest = before.stated_residuals().map(largest).unwrap_or_default();
    Fit { base: test(&before, 0.0, structure[0]), extended: test(&after, parameters, structure[1]), largest }
}

/// The rows of the search without discrepancy and without shared errors of groups: these are no part of the model.
fn rows_alone<'a>(hypothesis: &Hypothesis<'a>) -> Evaluation<'a> {
    let bare = hypothesis.without_discrepancy();
    bare.evaluate(bare.data.search.clone(), bare.offsets()).with_fitted_scatter().without_shared_errors()
}

fn test(rows: &Evaluation<'_>, parameters: f64, structure: f64) -> FitTest {
    if let Some((chi_square, count)) = rows.stated_chi_square() {
        let freedom = (count as f64 - parameters).max(1.0);
        let p_value = chi_square::p_value(chi_square, freedom);
        return FitTest {
            against: "stated errors",
            chi_square: Some(chi_square),
            degrees_of_freedom: Some(freedom.round() as usize),
            p_value: Some(p_value.max(1e-300)),
        };
    }
    if let Some(test) = replicates(rows, parameters) {
        return test;
    }
    FitTest { against: "structure", p_value: Some(structure), ..FitTest::default() }
}

/// The F test of replicates of `e_n`; `None` where too few inputs repeat.
fn replicates(rows: &Evaluation<'_>, parameters: f64) -> Option<FitTest> {
    // Copies of rows, or rows that share an error, are no replicates.
    if rows.data.shared.is_some() || rows.data.unit_count < rows.data.rows.len() {
        return None;
    }
    let mut cells: BTreeMap<Vec<u64>, Vec<f64>> = BTreeMap::new();
    let pairs: Vec<Option<[f64; 2]>> = rows.pairs(super::observable::Observable::NormalRestitution).collect();
    for (&row, pair) in rows.rows.iter().zip(pairs) {
        let Some([measured, predicted]) = pair else { continue };
        let one = &rows.data.rows[row];
        if one.impacts > 1.0 {
            return None;
        }
        // Inputs that are not known do not repeat.
        if rows.data.missing.lacks(one) {
            continue;
        }
        let key = INPUTS.iter().map(|input| (input.value)(&one.impact).to_bits()).collect();
        cells.entry(key).or_default().push(measured - predicted);
    }
    let (mut within, mut between, mut count) = (0.0, 0.0, 0.0);
    for residuals in cells.values() {
        let mean = residuals.iter().sum::<f64>() / residuals.len() as f64;
        within += residuals.iter().map(|r| (r - mean).powi(2)).sum::<f64>();
        between += mean * mean * residuals.len() as f64;
        count += residuals.len() as f64;
    }
    let (freedom_within, freedom) = (count - cells.len() as f64, cells.len() as f64 - parameters);
    if freedom_within < LEAST_REPLICATES as f64 || freedom < 1.0 || within <= 0.0 {
        return None;
    }
    let ratio = (between / freedom) / (within / freedom_within);
    let p_value = FisherSnedecor::new(freedom, freedom_within).map_or(1.0, |law| law.sf(ratio));
    Some(FitTest {
        against: "replicates",
        chi_square: Some(between / (within / freedom_within)),
        degrees_of_freedom: Some(freedom.round() as usize),
        p_value: Some(p_value.max(1e-300)),
    })
}

/// The largest misfits, the largest first.
fn largest(mut residuals: Vec<StatedResidual>) -> Vec<LargeMisfit> {
    residuals.retain(|residual| residual.standard_errors.abs() >= LEAST_MISFIT);
    residuals.sort_by(|a, b| b.standard_errors.abs().total_cmp(&a.standard_errors.abs()));
    let one = |residual: StatedResidual| LargeMisfit {
        line: residual.line,
        observable: residual.observable.name(),
        measured: residual.measured,
        predicted: residual.predicted,
        standard_errors: residual.standard_errors,
    };
    residuals.into_iter().take(MOST_LISTED).map(one).collect()
}
