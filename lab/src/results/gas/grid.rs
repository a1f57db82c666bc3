//! A cut through many cells as the values at the centres of equal squares, so that its picture stays small.

use super::CutCell;

/// Most squares of a grid, and most cells that are drawn one by one.
pub const GRID_CELLS: usize = 20_000;

/// The cut as equal squares, each with the value at its centre: at most [`GRID_CELLS`] over the box around the cut. The cells
/// themselves when they are not more than that.
pub fn on_grid(cells: &[CutCell]) -> Vec<CutCell> {
    if cells.len() <= GRID_CELLS {
        return cells.to_vec();
    }
    let Some(grid) = Grid::around(cells) else { return Vec::new() };
    let mut values = vec![None; grid.columns * grid.rows];
    for cell in cells {
        let [columns, rows] = grid.centres_within(&cell.outline);
        for row in rows {
            for column in columns.clone() {
                if contains(&cell.outline, grid.centre(column, row)) {
                    values[row * grid.columns + column] = Some(cell.value);
                }
            }
        }
    }
    let square = |(place, value): (usize, &Option<f64>)| {
        let outline = grid.outline(place % grid.columns, place / grid.columns);
        value.map(|value| CutCell { outline, value })
    };
    values.iter().enumerate().filter_map(square).collect()
}

/// Equal squares.
struct Grid {
    /// The lower left corner [m].
    origin: [f64; 2],
    /// Length of a side [m].
    side: f64,
    columns: usize,
    rows: usize,
}

impl Grid {
    /// `None` around nothing.
    fn around(cells: &[CutCell]) -> Option<Self> {
        let corners = || cells.iter().flat_map(|cell| &cell.outline);
        let [x, y] = [0, 1].map(|axis| {
            corners().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], corner| {
                [low.min(corner[axis]), high.max(corner[axis])]
            })
        });
        let [width, height] = [x[1] - x[0], y[1] - y[0]];
        if !(width > 0.0 && height > 0.0 && width.is_finite() && height.is_finite()) {
            return None;
        }
        // A long and thin box would else have a row of too many squares.
        let side = (width * height / GRID_CELLS as f64).sqrt().max(width.max(height) / 2000.0);
        let count = |length: f64| (length / side).ceil().max(1.0) as usize;
        Some(Self { origin: [x[0], y[0]], side, columns: count(width), rows: count(height) })
    }

    fn centre(&self, column: usize, row: usize) -> [f64; 2] {
        [self.origin[0] + (column as f64 + 0.5) * self.side, self.origin[1] + (row as f64 + 0.5) * self.side]
    }

    /// Columns and rows whose centres may lie in an outline.
    fn centres_within(&self, outline: &[[f64; 2]]) -> [std::ops::Range<usize>; 2] {
        [(0, self.columns), (1, self.rows)].map(|(axis, count)| {
            let places = || outline.iter().map(|corner| (corner[axis] - self.origin[axis]) / self.side - 0.5);
            let low = places().fold(f64::INFINITY, f64::min).max(0.0);
            let high = places().fold(f64::NEG_INFINITY, f64::max) + 1.0;
            low as usize..(high.max(0.0) as usize).min(count)
        })
    }

    fn outline(&self, column: usize, row: usize) -> Vec<[f64; 2]> {
        let corner = |right: usize, up: usize| {
            [
                self.origin[0] + (column + right) as f64 * self.side,
                self.origin[1] + (row + up) as f64 * self.side,
            ]
        };
        vec![corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]
    }
}

/// Whether a place lies in a polygon: a ray from it crosses the outline an odd number of times.
fn contains(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let next = outline.iter().cycle().skip(1);
    let crosses = |(a, b): &(&[f64; 2], &[f64; 2])| {
        (a[1] > y) != (b[1] > y) && x < a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1])
    };
    outline.iter().zip(next).filter(crosses).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::gas::area;

    #[test]
    fn a_grid_keeps_area_and_values() {
        // 150 by 150 rectangles of 0.02 m by 0.01 m, whose value is their place.
        let cell = |i: usize, j: usize| {
            let [x, y] = [0.02 * i as f64, 0.01 * j as f64];
            CutCell {
                outline: vec![[x, y], [x + 0.02, y], [x + 0.02, y + 0.01], [x, y + 0.01]],
                value: x + 0.01,
            }
        };
        let cells: Vec<CutCell> = (0..150).flat_map(|i| (0..150).map(move |j| cell(i, j))).collect();
        let squares = on_grid(&cells);
        assert!(squares.len() <= GRID_CELLS + 400 && squares.len() > GRID_CELLS / 2, "{}", squares.len());
        let sum: f64 = squares.iter().map(|square| area(&square.outline)).sum();
        assert!((sum / 4.5 - 1.0).abs() < 0.02, "{sum}");
        for square in &squares {
            assert!((square.outline[0][0] + square.outline[1][0] - 2.0 * square.value).abs() < 0.0201);
        }
        assert_eq!(on_grid(&cells[..3]), cells[..3]);
    }
}
