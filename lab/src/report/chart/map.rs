//! Maps: a quantity over two coordinates, as coloured cells.

use kuva::plot::{ColorMap, Heatmap};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;

use super::axis::tick_format;
use super::svg::Figure;

/// A quantity over two coordinates. The colour map is cividis, which reads the same with every kind of colour vision and
/// has evenly growing brightness.
pub struct FigureMap {
    title: String,
    labels: [String; 2],
    ranges: [[f64; 2]; 2],
    cells: Vec<Vec<f64>>,
}

impl FigureMap {
    /// Sums weighted points in `columns` by `rows` cells over the given ranges; points outside are left out.
    pub fn of_points(
        title: &str,
        labels: [&str; 2],
        ranges: [[f64; 2]; 2],
        [columns, rows]: [usize; 2],
        points: impl Iterator<Item = ([f64; 2], f64)>,
    ) -> Self {
        let mut cells = vec![vec![0.0; columns]; rows];
        let place = |value: f64, [low, high]: [f64; 2], count: usize| {
            let share = (value - low) / (high - low);
            (0.0..=1.0).contains(&share).then(|| ((share * count as f64) as usize).min(count - 1))
        };
        for ([x, y], weight) in points {
            if let (Some(column), Some(row)) = (place(x, ranges[0], columns), place(y, ranges[1], rows)) {
                cells[row][column] += weight;
            }
        }
        Self { title: title.to_owned(), labels: labels.map(str::to_owned), ranges, cells }
    }

    /// Divides every cell by its area: points per area, mass per area.
    #[must_use]
    pub fn per_area(mut self) -> Self {
        let count = self.cells.first().map_or(1, Vec::len) * self.cells.len();
        let area = self.ranges.iter().map(|[low, high]| high - low).product::<f64>() / count as f64;
        self.cells.iter_mut().flatten().for_each(|cell| *cell /= area);
        self
    }

    /// The figure; `id` is its name on the page, `quantity` the meaning of the colours with its unit.
    pub fn figure(self, id: &str, quantity: &str, caption: &str) -> Figure {
        let [[left, right], [bottom, top]] = self.ranges;
        let plot = Heatmap::new()
            .with_data(self.cells)
            .with_x_range(left, right)
            .with_y_range(bottom, top)
            .with_cell_size(1.0)
            .with_color_map(ColorMap::Cividis);
        let plots = vec![Plot::Heatmap(plot)];
        let [x_label, y_label] = self.labels;
        let layout = Layout::auto_from_plots(&plots)
            .with_x_label(x_label)
            .with_y_label(y_label)
            .with_clamp_axis()
            .with_colorbar_tick_format(tick_format());
        let title = format!("{}: {quantity}", self.title);
        Figure::new([id, &title, caption], plots, layout, Vec::new())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_sum_up_weights_per_area() {
        let points = [([0.1, 0.1], 2.0), ([0.2, 0.3], 1.0), ([1.9, 0.9], 4.0), ([5.0, 0.0], 9.0)];
        let map = FigureMap::of_points(
            "m",
            ["x [m]", "y [m]"],
            [[0.0, 2.0], [0.0, 1.0]],
            [2, 1],
            points.into_iter(),
        );
        assert_eq!(map.per_area().cells, [[3.0, 4.0]]);
    }
}
