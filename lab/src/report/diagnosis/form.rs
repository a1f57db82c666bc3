//! A closed form over its column, with its 95 % band where it was seen and beyond, and the rows that it was fitted to.

use super::super::chart::{Chart, Figure};
use super::axis::ColumnAxis;
use super::curve::along;
use super::plot::{EXTENDED, Means, Window, identifier, share_axis, title, triple};
use crate::diagnose::{CauseForm, Diagnosis, Finding, FormPoint, SampleRow};
use nearwall::effect::Operation;

/// The observable of captures.
const CAPTURE: &str = "outcome";

/// The figure of a form; `None` where its column does not vary in the sample.
pub(super) fn figure(diagnosis: &Diagnosis, finding: &Finding, form: &CauseForm) -> Option<Figure> {
    let axis = ColumnAxis::new(&diagnosis.sample, finding.variables.first()?)?;
    let ([first, .., last], Some([low, high])) = (form.line.as_slice(), form.seen) else { return None };
    let acts = Operation::ALL.into_iter().find(|acts| acts.name() == form.acts)?;
    let is_capture = form.observable == CAPTURE;
    let quantity = title(form.observable);
    let label = label(form, acts);
    let points = points(diagnosis, form, acts, &axis);
    let means = Means::new(&points, false);
    let line: Vec<[f64; 2]> = form.line.iter().map(|point| [point.at, point.value]).collect();
    let seen = |point: &&FormPoint| (low..=high).contains(&point.at);
    let always = form.line.iter().filter(seen).flat_map(|point| [point.low, point.high]).chain(means.reach());
    let window = Window::new(&points, always.chain(line.iter().map(|point| point[1])));
    let chart = axis.chart_between(&form.equation, &label, [first.at, last.at]);
    let (chart, note) = if is_capture {
        (share_axis(chart), String::new())
    } else {
        window.draw(chart, "rows without the form", &points)
    };
    let side = |of: fn(&FormPoint) -> f64| form.line.iter().map(of).collect::<Vec<f64>>();
    let [lows, highs] = [side(|point| point.low), side(|point| point.high)];
    let [lows, highs] = [lows, highs].map(|ends| if is_capture { ends } else { window.clamped(&ends) });
    let chart = chart
        .band(&side(|point| point.at), &lows, &highs)
        .line("form, 95 % band", &line)
        .mark_x(low, "")
        .mark_x(high, "")
        .measured("mean ± standard error", &means.points, &means.errors);
    let unit = axis.describe([low, high]);
    let caption = format!(
        "{} rows. The form was seen {unit}, between the thin lines; beyond them it is an extrapolation, and the band \
            holds the errors of its parameters but not that of the form.{note}",
        points.len()
    );
    Some(chart.figure(&format!("form-{}-{}", identifier(axis.name), identifier(quantity)), &caption))
}

/// The form over its column as a rig shows it, which has no rows of single impacts.
pub(in crate::report) fn alone(form: &CauseForm, name: &str, unit: &str) -> Option<Figure> {
    let ([first, .., last], Some([low, high])) = (form.line.as_slice(), form.seen) else { return None };
    let acts = Operation::ALL.into_iter().find(|acts| acts.name() == form.acts)?;
    let line: Vec<[f64; 2]> = form.line.iter().map(|point| [point.at, point.value]).collect();
    let side = |of: fn(&FormPoint) -> f64| form.line.iter().map(of).collect::<Vec<f64>>();
    let seen = form.line.iter().filter(|point| (low..=high).contains(&point.at));
    let window = Window::new(&[], seen.flat_map(|point| [point.low, point.high]));
    let chart = Chart::new(&form.equation, &format!("{name} [{unit}]"), &label(form, acts));
    let chart = chart.x_range(first.at, last.at);
    let (chart, lows, highs) = if form.observable == CAPTURE {
        (share_axis(chart), side(|point| point.low), side(|point| point.high))
    } else {
        let [lows, highs] =
            [side(|point| point.low), side(|point| point.high)].map(|ends| window.clamped(&ends));
        (window.draw(chart, "", &[]).0, lows, highs)
    };
    let chart = chart.band(&side(|point| point.at), &lows, &highs).line("form, 95 % band", &line);
    let caption = format!(
        "Fitted to all readings together over {name} of the impacts. Between the thin lines the form was seen; \
         beyond them it is an extrapolation, and the band holds the errors of its parameters but not that of the form."
    );
    let id = format!("form-{}-{}", identifier(name), identifier(title(form.observable)));
    Some(chart.mark_x(low, "").mark_x(high, "").figure(&id, &caption))
}

/// What a form gives.
fn label(form: &CauseForm, acts: Operation) -> String {
    let quantity = title(form.observable);
    match acts {
        _ if form.observable == CAPTURE => "probability of capture [1]".to_owned(),
        Operation::Set => format!("{quantity} [1]"),
        Operation::Add => format!("added to {quantity} [1]"),
        Operation::Factor | Operation::Times => format!("factor on {quantity} [1]"),
    }
}

/// What each row says of the form's value: the measured number without the rest of the model.
fn points(diagnosis: &Diagnosis, form: &CauseForm, acts: Operation, axis: &ColumnAxis<'_>) -> Vec<[f64; 2]> {
    let line: Vec<[f64; 2]> = form.line.iter().map(|point| [point.at, point.value]).collect();
    let point = |row: &SampleRow| {
        let x = axis.at(row)?;
        let numbers = triple(row, form.observable)?;
        let (measured, extended, value) = (numbers[0], numbers[EXTENDED], along(&line, x)?);
        let y = match acts {
            Operation::Set => measured,
            Operation::Add => measured - extended + value,
            Operation::Factor | Operation::Times => measured / extended * value,
        };
        y.is_finite().then_some([x, y])
    };
    diagnosis.sample.rows.iter().filter_map(point).collect()
}
