//! Bar charts over named categories.

use kuva::plot::BarPlot;
use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;

use super::axis::drawable;
use super::svg::Figure;
use super::{COLOURS, legend_entry};

/// Bars over named categories, several series side by side or stacked.
#[derive(Default)]
pub struct BarChart {
    title: String,
    y_label: String,
    categories: Vec<String>,
    series: Vec<(String, Vec<f64>)>,
    stacked: bool,
}

impl BarChart {
    /// A chart without a series; the axis label carries its unit.
    pub fn new(title: &str, y_label: &str, categories: &[String]) -> Self {
        let [title, y_label] = [title, y_label].map(str::to_owned);
        Self { title, y_label, categories: categories.to_vec(), ..Self::default() }
    }

    /// Adds a series with one value per category.
    #[must_use]
    pub fn series(mut self, name: &str, values: &[f64]) -> Self {
        self.series.push((name.to_owned(), values.to_vec()));
        self
    }

    /// Stacks the series.
    #[must_use]
    pub fn stacked(mut self) -> Self {
        self.stacked = true;
        self
    }

    /// The figure; `id` is its name on the page.
    pub fn figure(self, id: &str, caption: &str) -> Figure {
        let series = || self.series.iter().zip(COLOURS.into_iter().cycle());
        let mut plot = BarPlot::new();
        for (index, category) in self.categories.iter().enumerate() {
            let value = |values: &[f64]| values.get(index).copied().and_then(drawable).unwrap_or(0.0);
            let bars: Vec<(f64, &str)> =
                series().map(|((_, values), colour)| (value(values), colour)).collect();
            plot = plot.with_group(category.clone(), bars);
        }
        let plots = vec![Plot::Bar(if self.stacked { plot.with_stacked() } else { plot })];
        let layout = Layout::auto_from_plots(&plots).with_y_label(&self.y_label).with_y_axis_min(0.0);
        let legend: Vec<LegendEntry> = series()
            .filter_map(|((name, _), colour)| legend_entry(name, colour, LegendShape::Rect))
            .collect();
        Figure::new([id, &self.title, caption], plots, layout, legend)
    }
}
