//! The measured values against the inputs that matter, with both models' curves.

use super::super::chart::Figure;
use super::super::page::Page;
use super::axis::ColumnAxis;
use super::plot::{
    BASE, EXTENDED, FEW_DRAWN, Means, OBSERVABLES, PlotRow, Window, agreement, identifier, share_axis,
    stated_error, title, triple,
};
use crate::diagnose::{DataView, Diagnosis, Sample, SampleRow};

/// Relative difference below which both models are the same.
const SAME_MODELS: f64 = 1e-9;

pub(super) fn add(page: &mut Page, diagnosis: &Diagnosis) {
    let sample = &diagnosis.sample;
    let (mut whole, mut parts) = (Vec::new(), Vec::new());
    for observable in OBSERVABLES {
        let views: Vec<&DataView> =
            sample.views.iter().filter(|view| view.observable == observable).collect();
        let selections: Vec<SelectedRows<'_>> =
            views.iter().filter_map(|view| SelectedRows::new(sample, view)).collect();
        // All figures of an observable have the same y axis.
        let Some(window) = selections.first().map(SelectedRows::window) else { continue };
        let figures =
            selections.iter().enumerate().map(|(place, selection)| selection.figure(&window, place));
        let mut figures = figures.collect::<Vec<Figure>>().into_iter();
        whole.extend(figures.next());
        if let Some((second, _)) = selections.last().and_then(|last| last.second.as_ref()) {
            let split =
                format!("{} against {}, rows split by {}:", title(observable), views[0].column, second.name);
            parts.push((split, figures));
        }
    }
    if whole.is_empty() {
        return;
    }
    page.heading("Measured values and models");
    page.text(
        "Black points are measured. Lines are the models: at each value of the x axis their mean over the nearest \
            measured rows, with the other inputs as measured. Where there is one line only, both models are the same.",
    );
    page.figures(whole);
    for (split, figures) in parts {
        page.text(split);
        page.panels(figures);
    }
}

/// A view with the rows that it selects.
struct SelectedRows<'a> {
    view: &'a DataView,
    axis: ColumnAxis<'a>,
    /// The column that selects the rows, and its range.
    second: Option<(ColumnAxis<'a>, [f64; 2])>,
    rows: Vec<PlotRow>,
    few: bool,
}

impl<'a> SelectedRows<'a> {
    /// `None` where there is nothing to show.
    fn new(sample: &'a Sample, view: &'a DataView) -> Option<Self> {
        let axis = ColumnAxis::new(sample, &view.column)?;
        let second = match &view.within {
            Some((column, range)) => Some((ColumnAxis::new(sample, column)?, *range)),
            None => None,
        };
        let selected = |row: &SampleRow| {
            if let Some((second, [low, high])) = &second {
                second.cell(row).filter(|cell| (*low..=*high).contains(cell))?;
            }
            Some((axis.at(row)?, stated_error(row, view.observable), triple(row, view.observable)?))
        };
        let rows: Vec<_> = sample.rows.iter().filter_map(selected).collect();
        let few = rows.len() <= FEW_DRAWN && view.observable != "outcome";
        (!rows.is_empty()).then_some(Self { view, axis, second, rows, few })
    }

    /// The rows' points: measured (0) or one of the models.
    fn points(&self, which: usize) -> Vec<[f64; 2]> {
        self.rows.iter().map(|(x, _, numbers)| [*x, numbers[which]]).collect()
    }

    /// Single rows behind the means. Captures lie at two heights only: a cloud of them shows nothing.
    fn cloud(&self) -> Vec<[f64; 2]> {
        if self.few || self.view.observable == "outcome" { Vec::new() } else { self.points(0) }
    }

    fn measured(&self) -> Means {
        if self.few {
            let errors = self.rows.iter().map(|(_, error, _)| (*error, *error)).collect();
            return Means::single(self.points(0), errors);
        }
        Means::new(&self.points(0), self.axis.has_words())
    }

    fn window(&self) -> Window {
        let curves = self.view.curve.iter().flat_map(|[_, base, extended]| [*base, *extended]);
        Window::new(&self.cloud(), self.measured().reach().chain(curves))
    }

    /// What the error bars of the points are.
    fn bars(&self, measured: &Means) -> &'static str {
        let stated = |(error, _): &(f64, f64)| *error != 0.0;
        match self.few {
            true if !measured.errors.iter().any(stated) => "; no errors are stated.",
            true if measured.errors.iter().all(stated) => "; bars are the stated standard errors.",
            true => "; bars are the stated standard errors, points without a bar state none.",
            false if self.axis.has_words() => "; points are means for each word, bars their standard errors.",
            false => "; points are means over neighbouring rows, bars their standard errors.",
        }
    }

    fn figure(&self, window: &Window, place: usize) -> Figure {
        let (view, quantity) = (self.view, title(self.view.observable));
        let capture = view.observable == "outcome";
        let unit = if capture { "impacts" } else { "rows" };
        let mut caption = format!("{} {unit}", self.rows.len());
        let heading = match &self.second {
            None => format!("{quantity} against {}", self.axis.name),
            Some((second, range)) => {
                let range = format!("{} {}", second.name, second.describe(*range));
                caption += &format!(" with {range}");
                range
            }
        };
        let label =
            if capture { "share captured [1]".to_owned() } else { format!("{quantity} measured [1]") };
        let chart = self.axis.chart(&heading, &label);
        let chart = if place > 0 { chart.panel() } else { chart };
        let (mut chart, note) = window.draw(chart, "single rows", &self.cloud());
        chart = if capture { share_axis(chart) } else { chart };
        let numbers = view.curve.iter().chain(self.rows.iter().map(|(_, _, numbers)| numbers));
        let both = { numbers }.any(|[_, base, extended]| (extended - base).abs() > SAME_MODELS * base.abs());
        let models = [(BASE, "base"), (EXTENDED, "extended")];
        let models = &models[..if both { 2 } else { 1 }];
        for (which, name) in models {
            let name = &format!("{name} model");
            chart = if view.curve.is_empty() {
                let means = Means::new(&self.points(*which), self.axis.has_words());
                chart.points(&format!("mean, {name}"), &means.points)
            } else {
                let line: Vec<[f64; 2]> = view.curve.iter().map(|point| [point[0], point[*which]]).collect();
                chart.line(name, &line)
            };
        }
        let measured = self.measured();
        caption += self.bars(&measured);
        if self.second.is_none() {
            caption += &agreement(&self.rows, models);
        }
        let id = if place == 0 { String::new() } else { format!("-{place}") };
        let id = format!("data-{}{id}", identifier(view.observable));
        let name = if self.few { "measured" } else { "mean, measured" };
        chart.measured(name, &measured.points, &measured.errors).figure(&id, &(caption + &note))
    }
}
