//! A closed form over its column, with its 95 % band where it was seen and beyond, and the rows that it was fitted to.

use super::super::chart::Figure;
use super::axis::ColumnAxis;
use super::curve::along;
use super::plot::{EXTENDED, Means, Window, identifier, share_axis, title, triple};
use crate::diagnose::{CauseForm, Diagnosis, Finding, FormPoint, SampleRow};
use nearwall::effect::CurveForm;

/// The figure of a form; `None` where its column does not vary in the sample.
pub(super) fn figure(diagnosis: &Diagnosis, finding: &Finding, form: &CauseForm) -> Option<Figure> {
    let axis = ColumnAxis::new(&diagnosis.sample, finding.variables.first()?)?;
    let ([first, .., last], Some([low, high])) = (form.line.as_slice(), form.seen) else { return None };
    let acts = CurveForm::ALL.into_iter().find(|acts| acts.name() == form.acts)?;
    let is_capture = form.observable == "outcome";
    let quantity = title(form.observable);
    let label = axis_label(acts, is_capture, quantity);
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
        "{} rows. The form was seen {unit}, between the thin lines; beyond them it is an extrapolation, and the band holds \
         the errors of its parameters but not that of the form.{note}",
        points.len()
    );
    Some(chart.figure(&format!("form-{}-{}", identifier(axis.name), identifier(quantity)), &caption))
}

fn axis_label(acts: CurveForm, is_capture: bool, quantity: &str) -> String {
    match acts {
        _ if is_capture => "probability of capture [1]".to_owned(),
        CurveForm::Set => format!("{quantity} [1]"),
        CurveForm::Add => format!("added to {quantity} [1]"),
        CurveForm::Factor | CurveForm::Times => format!("factor on {quantity} [1]"),
    }
}

/// What each row says of the form's value: the measured number without the rest of the model.
fn points(diagnosis: &Diagnosis, form: &CauseForm, acts: CurveForm, axis: &ColumnAxis<'_>) -> Vec<[f64; 2]> {
    let line: Vec<[f64; 2]> = form.line.iter().map(|point| [point.at, point.value]).collect();
    let point = |row: &SampleRow| {
        let x = axis.at(row)?;
        let numbers = triple(row, form.observable)?;
        let (measured, extended, value) = (numbers[0], numbers[EXTENDED], along(&line, x)?);
        let y = match acts {
            CurveForm::Set => measured,
            CurveForm::Add => measured - extended + value,
            CurveForm::Factor | CurveForm::Times => measured / extended * value,
        };
        y.is_finite().then_some([x, y])
    };
    diagnosis.sample.rows.iter().filter_map(point).collect()
}
