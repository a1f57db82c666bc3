//! Causes that act at random: they show in the distribution of the measured values.

use super::super::chart::{Chart, Figure};
use super::super::format::{number, whole_percent};
use super::plot::{BASE, span, triple};
use crate::diagnose::{Diagnosis, Finding};

/// Bins of a histogram, about.
const HISTOGRAM_BINS: usize = 30;

/// Histograms of the values and of the residuals of the base model.
pub(super) fn figures(diagnosis: &Diagnosis, finding: &Finding, id: &str) -> Vec<Figure> {
    let scatter = &diagnosis.scatter;
    let (observable, scatter) =
        if finding.observable == "e_t" { ("e_t", scatter.e_t) } else { ("e_n", scatter.e_n) };
    let rows = diagnosis.sample.rows.iter();
    let rows: Vec<[f64; 3]> = rows.filter_map(|row| triple(row, observable)).collect();
    if rows.len() < 2 { Vec::new() } else { histograms(&rows, observable, scatter, id).to_vec() }
}

fn histograms(rows: &[[f64; 3]], observable: &str, scatter: f64, id: &str) -> [Figure; 2] {
    let of = |which: usize| rows.iter().map(|numbers| numbers[which]).collect::<Vec<f64>>();
    let y_label = "share of the rows [%]";
    let bins = edges([of(0), of(BASE)].concat());
    let heading = format!("{observable}, measured and predicted");
    let values = Chart::new(&heading, &format!("{observable} [1]"), y_label)
        .histogram("measured", &bins, &shares(&of(0), &bins))
        .histogram("base model, without scatter", &bins, &shares(&of(BASE), &bins));
    let residuals: Vec<f64> = rows.iter().map(|numbers| numbers[0] - numbers[BASE]).collect();
    let bins = edges(residuals.clone());
    let label = format!("{observable}, measured − base model [1]");
    let mut left = Chart::new(&format!("Residuals of {observable}"), &label, y_label).histogram(
        "measured − base model",
        &bins,
        &shares(&residuals, &bins),
    );
    if scatter > 0.0 {
        left = left.line("scatter of single values alone", &bell(&bins, scatter));
    }
    [
        values.figure(&format!("spread-{id}"), &spread_caption(&of(0), &of(BASE))),
        left.figure(&format!("residuals-{id}"), &residuals_caption(&residuals, scatter)),
    ]
}

/// The spread of the measured and the predicted values.
fn spread_caption(measured: &[f64], predicted: &[f64]) -> String {
    format!(
        "{} rows. The measured values have a standard deviation of {}, the predictions of one per impact {}.",
        measured.len(),
        number(deviation(measured)),
        number(deviation(predicted))
    )
}

/// How many residuals lie beyond what scatter alone gives.
fn residuals_caption(residuals: &[f64], scatter: f64) -> String {
    let n = residuals.len();
    if scatter <= 0.0 {
        return format!("{n} rows.");
    }
    let share = residuals.iter().filter(|residual| residual.abs() > 2.0 * scatter).count() as f64 / n as f64;
    format!(
        "{n} rows. The line is the normal distribution that the scatter of single values, {}, gives by itself: 5 % \
            would lie beyond twice the scatter, {} do.",
        number(scatter),
        whole_percent(share)
    )
}

/// Standard deviation.
fn deviation(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (count - 1.0)).sqrt()
}

/// Edges of bins over all but the outermost few values.
fn edges(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    let beyond = values.len() / 400;
    span(values[beyond], values[values.len() - 1 - beyond], HISTOGRAM_BINS)
}

/// Shares [%] of the values between edges.
fn shares(values: &[f64], edges: &[f64]) -> Vec<f64> {
    let (low, step, bins) = (edges[0], edges[1] - edges[0], edges.len() - 1);
    let mut shares = vec![0.0; bins];
    for value in values {
        let place = (value - low) / step;
        // Rounding may lift the largest value above the last edge.
        if place >= 0.0 && place <= bins as f64 + 1e-9 {
            shares[(place as usize).min(bins - 1)] += 100.0 / values.len() as f64;
        }
    }
    shares
}

/// A normal distribution about zero, in per cent a bin.
fn bell(edges: &[f64], deviation: f64) -> Vec<[f64; 2]> {
    let (low, high, step) = (edges[0], edges[edges.len() - 1], edges[1] - edges[0]);
    let height = 100.0 * step / (deviation * (2.0 * std::f64::consts::PI).sqrt());
    let xs = (0..=200).map(|i| low + (high - low) * f64::from(i) / 200.0);
    xs.map(|x| [x, height * (-0.5 * (x / deviation).powi(2)).exp()]).collect()
}

#[cfg(test)]
mod tests {
    use super::super::super::chart::round_edges;
    use super::*;

    #[test]
    fn histograms_hold_all_rows_and_the_bell_its_whole() {
        let edges = round_edges(-1.0, 1.0, 20);
        assert!((shares(&[-0.95, 0.0, 0.5, 1.0], &edges).iter().sum::<f64>() - 100.0).abs() < 1e-9);
        let bell = bell(&edges, 0.1);
        let sum: f64 = bell.iter().map(|point| point[1]).sum::<f64>() * (2.0 / 200.0) / (edges[1] - edges[0]);
        assert!((sum - 100.0).abs() < 0.1, "{sum}");
    }

    #[test]
    fn a_cause_of_chance_shows_in_histograms() {
        let rows: Vec<[f64; 3]> = (0..200)
            .map(|i| f64::from(i % 20) * 0.01)
            .map(|e| [if e < 0.05 { 0.1 + e } else { 0.5 + e }, 0.6, 0.5])
            .collect();
        let [values, left] = histograms(&rows, "e_n", 0.05, "agglomerates");
        assert_eq!([values.id.as_str(), left.id.as_str()], ["spread-agglomerates", "residuals-agglomerates"]);
        for figure in [values, left] {
            assert!(figure.svg.contains("[1]") && !figure.svg.contains("NaN"), "{}", figure.svg);
        }
    }
}
