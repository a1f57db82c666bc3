//! Names of what a rig measures, as a laboratory calls them.

use crate::dataset::{Restitution, RigQuantity};
use crate::diagnose::Finding;

/// A kind of readings.
pub(super) fn kind(name: &'static str) -> &'static str {
    match name {
        "captured" => "captured share of the injected mass",
        "capture_efficiency" => "captured share of the arriving particles",
        "mean_e_n" => "mean e_n",
        "mean_e_t" => "mean e_t",
        "share_e_n_below" => "share of rebounds with e_n below a threshold",
        "share_e_t_below" => "share of rebounds with e_t below a threshold",
        "quantile_e_n" => "quantile of e_n",
        "quantile_e_t" => "quantile of e_t",
        "mean_conversion" => "mean conversion of the catch",
        other => other,
    }
}

/// The short name of a column's quantity, for an axis, and its wall.
pub(super) fn axis(column: &str) -> (String, &str) {
    let (name, wall) = column.split_once('@').unwrap_or((column, ""));
    let which = |one: Restitution| match one {
        Restitution::Normal => "e_n",
        Restitution::Tangential => "e_t",
    };
    let text = match RigQuantity::parse(name) {
        Some(RigQuantity::Captured) => "captured / injected mass".to_owned(),
        Some(RigQuantity::CapturedAlong([from, to])) => {
            format!("captured from {from} to {to} m / injected mass")
        }
        Some(RigQuantity::CapturedBySize([from, to])) => {
            format!("captured, d from {from} to {to} m / injected mass")
        }
        Some(RigQuantity::CaptureEfficiency) => "captured / arriving particles".to_owned(),
        Some(RigQuantity::Mean(one)) => format!("mean {}", which(one)),
        Some(RigQuantity::ShareBelow(one, threshold)) => {
            format!("share of rebounds with {} below {threshold}", which(one))
        }
        Some(RigQuantity::Quantile(one, probability)) => {
            format!("{} % quantile of {}", 100.0 * probability, which(one))
        }
        Some(RigQuantity::MeanConversion) => "mean conversion of the catch".to_owned(),
        None => name.to_owned(),
    };
    (text, wall)
}

/// A column in a title: "Mean e_n, wall lid".
pub(super) fn column(column: &str) -> String {
    let (text, wall) = axis(column);
    let mut letters = text.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    format!("{first}{}, wall {wall}", letters.as_str())
}

/// The findings with the kinds that they act on in words.
pub(super) fn findings(findings: &[Finding]) -> Vec<Finding> {
    let one = |finding: &Finding| Finding { observable: kind(finding.observable), ..finding.clone() };
    findings.iter().map(one).collect()
}
