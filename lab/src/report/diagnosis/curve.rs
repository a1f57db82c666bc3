//! The fitted curve over a column that no effect explains, with the rows that it was fitted to.

use super::super::chart::Figure;
use super::axis::ColumnAxis;
use super::plot::{EXTENDED, Means, Window, title, triple};
use crate::diagnose::{CauseCurve, Diagnosis, Finding};

/// The curve, with the rows that it was fitted to; `None` where its column does not vary in the sample.
pub(super) fn figure(
    diagnosis: &Diagnosis,
    finding: &Finding,
    shape: &CauseCurve,
    id: &str,
) -> Option<Figure> {
    let sample = &diagnosis.sample;
    let axis = ColumnAxis::new(sample, finding.variables.first()?)?;
    let bends = shape.at.iter().zip(&shape.adds);
    let mut bends: Vec<[f64; 2]> =
        bends.filter_map(|(at, adds)| Some([axis.find(sample, at)?, *adds])).collect();
    bends.sort_by(|a, b| a[0].total_cmp(&b[0]));
    // Beyond its outermost bends the curve is level.
    let mut line = bends.clone();
    line.extend(axis.ends().into_iter().flatten().filter_map(|end| Some([end, along(&bends, end)?])));
    line.sort_by(|a, b| a[0].total_cmp(&b[0]));

    let quantity = title(finding.observable);
    let label = match (finding.observable, shape.factor) {
        ("outcome", _) => "added to the log odds of capture [1]".to_owned(),
        (_, true) => format!("relative change of {quantity} [1]"),
        (_, false) => format!("added to {quantity} [1]"),
    };
    let points = points(diagnosis, finding, shape, &axis, &line);
    let means = Means::new(&points, axis.has_words());
    let window = Window::new(&points, line.iter().map(|point| point[1]).chain(means.reach()).chain([0.0]));
    let chart = axis.chart(&format!("Fitted curve over {}", axis.name), &label).mark_y(0.0, "");
    let (chart, note) = window.draw(chart, "rows without the curve", &points);
    let mut chart = if axis.has_words() {
        chart.reference("fitted level", &line)
    } else {
        chart.line("fitted curve", &line)
    };
    if !points.is_empty() {
        chart = chart.measured("mean ± standard error", &means.points, &means.errors);
    }
    let caption = format!(
        "{} rows: what the rest of the model leaves, and the curve fitted to it. The curve is a description, not a \
            law.{note}",
        points.len()
    );
    Some(chart.figure(&format!("curve-{id}"), &caption))
}

/// Measured value against the extended model without the curve, for each row; none for captures.
fn points(
    diagnosis: &Diagnosis,
    finding: &Finding,
    shape: &CauseCurve,
    axis: &ColumnAxis<'_>,
    line: &[[f64; 2]],
) -> Vec<[f64; 2]> {
    let rows = diagnosis.sample.rows.iter().filter(|_| finding.observable != "outcome");
    rows.filter_map(|row| {
        let numbers = triple(row, finding.observable)?;
        let x = axis.at(row)?;
        let (measured, extended, adds) = (numbers[0], numbers[EXTENDED], along(line, x)?);
        let y = if shape.factor {
            measured / (extended / (1.0 + adds)) - 1.0
        } else {
            measured - extended + adds
        };
        y.is_finite().then_some([x, y])
    })
    .collect()
}

/// A line of points at `x`, level beyond its ends.
pub(super) fn along(line: &[[f64; 2]], x: f64) -> Option<f64> {
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
