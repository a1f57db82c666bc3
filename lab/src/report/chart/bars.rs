//! Bar charts over named categories.

use kuva::plot::BarPlot;
use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;

use super::axis::{drawable, tick_format};
use super::svg::Figure;
use super::{COLOURS, legend_entry};

/// Bars over named categories, several series side by side or stacked.
#[derive(Default)]
pub struct BarChart {
    title: String,
    y_label: String,
    categories: Vec<String>,
    /// Name, colour and values.
    series: Vec<(String, String, Vec<f64>)>,
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
    pub fn series(self, name: &str, values: &[f64]) -> Self {
        let colour = COLOURS[self.series.len() % COLOURS.len()];
        self.coloured(name, colour, values)
    }

    /// Adds a series in a colour of its own.
    #[must_use]
    pub fn coloured(mut self, name: &str, colour: &str, values: &[f64]) -> Self {
        self.series.push((name.to_owned(), colour.to_owned(), values.to_vec()));
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
        let mut plot = BarPlot::new();
        for (index, category) in self.categories.iter().enumerate() {
            let value = |values: &[f64]| values.get(index).copied().and_then(drawable).unwrap_or(0.0);
            let bars: Vec<(f64, &str)> =
                self.series.iter().map(|(_, colour, values)| (value(values), colour.as_str())).collect();
            plot = plot.with_group(category.clone(), bars);
        }
        let plots = vec![Plot::Bar(if self.stacked { plot.with_stacked() } else { plot })];
        let layout = Layout::auto_from_plots(&plots).with_y_label(&self.y_label).with_y_axis_min(0.0);
        let layout = layout.with_tick_format(tick_format(1.0));
        let entry =
            |(name, colour, _): &(String, String, Vec<f64>)| legend_entry(name, colour, LegendShape::Rect);
        let legend: Vec<LegendEntry> = self.series.iter().filter_map(entry).collect();
        Figure::new([id, &self.title, caption], plots, layout, legend)
    }
}
