//! The curve over a column that no effect explains, with what the rest of the model leaves of the rows.

use super::super::chart::Figure;
use super::axis::Axis;
use super::plot::{EXTENDED, Window, running, title, triple};
use crate::diagnose::{Diagnosis, Finding, FittedCurve};

/// The curve, with the rows that it was fitted to; `None` where its column does not vary in the sample.
pub(super) fn figure(
    diagnosis: &Diagnosis,
    finding: &Finding,
    shape: &FittedCurve,
    id: &str,
) -> Option<Figure> {
    let sample = &diagnosis.sample;
    let axis = Axis::new(sample, finding.variables.first()?)?;
    let mut line: Vec<[f64; 2]> = shape
        .at
        .iter()
        .zip(&shape.adds)
        .filter_map(|(at, adds)| Some([axis.find(sample, at)?, *adds]))
        .collect();
    line.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let bends = line.clone();
    // Beyond its outermost bends the curve is level.
    if let (Some([low, high]), Some(first), Some(last)) =
        (axis.ends(), bends.first().copied(), bends.last().copied())
    {
        if low < first[0] {
            line.insert(0, [low, first[1]]);
        }
        if high > last[0] {
            line.push([high, last[1]]);
        }
    }
    let quantity = title(finding.observable);
    let heading = format!("What goes with {}", axis.name);
    let (label, points) = match (finding.observable, shape.factor) {
        ("outcome", _) => ("added to the log odds of capture [1]".to_owned(), Vec::new()),
        (observable, true) => {
            let share = |measured: f64, extended: f64, adds: f64| measured / (extended / (1.0 + adds)) - 1.0;
            (
                format!("change of {quantity}, as a share of it [1]"),
                left(diagnosis, &axis, observable, &line, share),
            )
        }
        (observable, false) => {
            let rest = |measured: f64, extended: f64, adds: f64| measured - (extended - adds);
            (format!("added to {quantity} [1]"), left(diagnosis, &axis, observable, &line, rest))
        }
    };
    let means = running(&points, axis.has_words());
    let window = Window::new(&points, line.iter().map(|point| point[1]).chain(means.reach()));
    let mut chart = window.on(axis.chart(&heading, &label)).mark_y(0.0, "");
    if !points.is_empty() {
        chart = chart.cloud("rows without the curve", &window.inside);
        if !axis.has_words() {
            chart = chart.points_with_errors("mean ± standard error", &means.means, &means.errors);
        }
    }
    chart = if axis.has_words() {
        chart.reference("fitted level", &line).points_with_errors(
            "mean ± standard error",
            &means.means,
            &means.errors,
        )
    } else {
        chart.line("fitted curve", &line)
    };
    let caption = format!(
        "What the rest of the model leaves, and the curve fitted to it. This is a description, not a law: the cause has yet \
         to be found.{}",
        window.note()
    );
    Some(chart.figure(&format!("curve-{id}"), &caption))
}

/// What the model without the curve leaves of each row.
fn left(
    diagnosis: &Diagnosis,
    axis: &Axis<'_>,
    observable: &str,
    line: &[[f64; 2]],
    of: impl Fn(f64, f64, f64) -> f64,
) -> Vec<[f64; 2]> {
    let rows = diagnosis.sample.rows.iter();
    rows.filter_map(|row| {
        let numbers = triple(row, observable)?;
        let x = axis.at(row)?;
        let y = of(numbers[0], numbers[EXTENDED], along(line, x)?);
        y.is_finite().then_some([x, y])
    })
    .collect()
}

/// A line of points at `x`.
fn along(line: &[[f64; 2]], x: f64) -> Option<f64> {
    let right = line.partition_point(|point| point[0] <= x);
    match (right.checked_sub(1).and_then(|left| line.get(left)), line.get(right)) {
        (Some(a), Some(b)) => Some(a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0])),
        (Some(one), None) | (None, Some(one)) => Some(one[1]),
        (None, None) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_level_beyond_its_ends() {
        let line = [[1.0, 2.0], [3.0, 4.0]];
        let at = |x| along(&line, x).unwrap();
        assert_eq!([at(0.0), at(2.0), at(3.0), at(9.0)], [2.0, 3.0, 4.0, 4.0]);
        assert!(along(&[], 1.0).is_none());
    }
}
