//! Pictures in a plane as cells with one value each, and a grid where there are too many of them.

use super::range;

/// A part of a picture with one value.
#[derive(Debug, Clone, PartialEq)]
pub struct MapCell {
    /// Its corners in the plane, in turn [m].
    pub outline: Vec<[f64; 2]>,
    /// The area that it stands for [m²].
    pub area: f64,
    /// Its value, the mean over that area.
    pub value: f64,
}

impl MapCell {
    /// A cell that stands for the area of its outline.
    pub fn new(outline: Vec<[f64; 2]>, value: f64) -> Self {
        Self { area: area(&outline), outline, value }
    }
}

/// Area of a polygon [m²].
pub(super) fn area(outline: &[[f64; 2]]) -> f64 {
    // Relative to its first corner, or far from the origin the digits would be lost.
    let Some([x, y]) = outline.first() else { return 0.0 };
    let next = outline.iter().skip(1).chain(outline.first());
    let part = |([a, b], [c, d]): (&[f64; 2], &[f64; 2])| (a - x) * (d - y) - (c - x) * (b - y);
    0.5 * outline.iter().zip(next).map(part).sum::<f64>().abs()
}

/// Ends of some cells along both axes [m]; `None` for cells without an extent.
pub fn extent(cells: &[MapCell]) -> Option<[[f64; 2]; 2]> {
    let ends =
        [0, 1].map(|axis| range(cells.iter().flat_map(|cell| &cell.outline).map(|corner| corner[axis])));
    let has_extent = |[low, high]: &[f64; 2]| low.is_finite() && high.is_finite() && low < high;
    ends.iter().all(has_extent).then_some(ends)
}

/// Equal rectangles side by side.
pub struct Grid {
    low: [f64; 2],
    step: [f64; 2],
    counts: [usize; 2],
}

impl Grid {
    /// So many columns and rows between ends along both axes [m].
    pub fn new(ends: [[f64; 2]; 2], counts: [usize; 2]) -> Self {
        let step = [0, 1].map(|axis| (ends[axis][1] - ends[axis][0]) / counts[axis] as f64);
        Self { low: ends.map(|[low, _]| low), step, counts }
    }

    /// About so many rectangles that are nearly squares.
    pub fn of_squares(ends: [[f64; 2]; 2], most: usize) -> Self {
        let [width, height] = ends.map(|[low, high]| high - low);
        // A long and thin box would else have a row of too many squares.
        let side = (width * height / most as f64).sqrt().max(width.max(height) / 2000.0);
        Self::new(ends, [width, height].map(|length| (length / side).floor().max(1.0) as usize))
    }

    /// The rectangles of which at least a share lies in cells [1], with the mean over that area.
    pub fn means(&self, cells: &[MapCell], least: f64) -> Vec<MapCell> {
        // Area, and area times value.
        let mut sums = vec![[0.0; 2]; self.counts[0] * self.counts[1]];
        for cell in cells {
            for (place, share) in self.shares(&cell.outline) {
                sums[place][0] += share * cell.area;
                sums[place][1] += share * cell.area * cell.value;
            }
        }
        let least = least * self.step[0] * self.step[1];
        let mean = |(place, [area, sum]): (usize, &[f64; 2])| {
            let outline = self.outline(place);
            (*area > least).then(|| MapCell { outline, area: *area, value: sum / area })
        };
        sums.iter().enumerate().filter_map(mean).collect()
    }

    /// All rectangles with the sum of the weights of points in each over its area; points outside are left out.
    pub fn densities(&self, points: &[([f64; 2], f64)]) -> Vec<MapCell> {
        let mut sums = vec![0.0; self.counts[0] * self.counts[1]];
        for (point, weight) in points {
            let way = [0, 1].map(|axis| (point[axis] - self.low[axis]) / self.step[axis]);
            if [0, 1].iter().all(|axis| (0.0..=self.counts[*axis] as f64).contains(&way[*axis])) {
                let [column, row] = [0, 1].map(|axis| self.place(point[axis], axis));
                sums[row * self.counts[0] + column] += weight;
            }
        }
        let area = self.step[0] * self.step[1];
        let cell =
            |(place, sum): (usize, f64)| MapCell { outline: self.outline(place), area, value: sum / area };
        sums.into_iter().enumerate().map(cell).collect()
    }

    /// Column or row of a coordinate.
    fn place(&self, value: f64, axis: usize) -> usize {
        let way = ((value - self.low[axis]) / self.step[axis]).floor();
        way.clamp(0.0, (self.counts[axis] - 1) as f64) as usize
    }

    fn outline(&self, place: usize) -> Vec<[f64; 2]> {
        let from = [place % self.counts[0], place / self.counts[0]];
        let corner = |right: usize, up: usize| {
            [(0, right), (1, up)]
                .map(|(axis, on)| self.low[axis] + (from[axis] + on) as f64 * self.step[axis])
        };
        vec![corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]
    }

    /// The rectangles that a polygon overlaps, and the share of its area in each.
    fn shares(&self, polygon: &[[f64; 2]]) -> Vec<(usize, f64)> {
        let ends = [0, 1]
            .map(|axis| range(polygon.iter().map(|corner| corner[axis])).map(|end| self.place(end, axis)));
        let mut shares = Vec::new();
        for row in ends[1][0]..=ends[1][1] {
            for column in ends[0][0]..=ends[0][1] {
                let place = row * self.counts[0] + column;
                let corners = self.outline(place);
                shares.push((place, area(&within(polygon, corners[0], corners[2]))));
            }
        }
        let whole: f64 = shares.iter().map(|(_, part)| part).sum();
        if whole > 0.0 {
            shares.iter_mut().for_each(|(_, part)| *part /= whole);
            return shares;
        }
        // A face seen from its edge.
        shares.truncate(1);
        shares.iter_mut().for_each(|(_, part)| *part = 1.0);
        shares
    }
}

/// The part of a polygon within a rectangle (Sutherland and Hodgman).
fn within(polygon: &[[f64; 2]], low: [f64; 2], high: [f64; 2]) -> Vec<[f64; 2]> {
    let mut part = polygon.to_vec();
    for axis in 0..2 {
        part = beyond(&part, axis, low[axis], 1.0);
        part = beyond(&part, axis, high[axis], -1.0);
    }
    part
}

/// The part of a polygon on one side of a line: above it for a sign of 1, below it for -1.
fn beyond(polygon: &[[f64; 2]], axis: usize, line: f64, sign: f64) -> Vec<[f64; 2]> {
    let mut part = Vec::new();
    for (place, a) in polygon.iter().enumerate() {
        let b = &polygon[(place + 1) % polygon.len()];
        let [from, to] = [a, b].map(|corner| sign * (corner[axis] - line));
        if from >= 0.0 {
            part.push(*a);
        }
        if (from > 0.0 && to < 0.0) || (from < 0.0 && to > 0.0) {
            let share = from / (from - to);
            part.push([0, 1].map(|i| a[i] + share * (b[i] - a[i])));
        }
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polygon_is_shared_out_over_cells() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let corner = within(&square, [1.5, 1.0], [9.0, 9.0]);
        assert!((area(&corner) - 0.5).abs() < 1e-15, "{corner:?}");
        assert_eq!(within(&square, [3.0, 0.0], [4.0, 1.0]), Vec::<[f64; 2]>::new());
        // Far from the origin.
        let far = square.map(|[x, y]| [1e6 + 1e-3 * x, 1e6 + 1e-3 * y]);
        assert!((area(&far) - 4e-6).abs() < 1e-12);
    }

    #[test]
    fn a_grid_keeps_area_and_values() {
        // 150 by 150 rectangles of 0.02 m by 0.01 m, whose value is their place.
        let cell = |i: usize, j: usize| {
            let [x, y] = [0.02 * i as f64, 0.01 * j as f64];
            MapCell::new(vec![[x, y], [x + 0.02, y], [x + 0.02, y + 0.01], [x, y + 0.01]], x + 0.01)
        };
        let cells: Vec<MapCell> = (0..150).flat_map(|i| (0..150).map(move |j| cell(i, j))).collect();
        let squares = Grid::of_squares(extent(&cells).unwrap(), 20_000).means(&cells, 0.5);
        assert!(squares.len() <= 20_400 && squares.len() > 10_000, "{}", squares.len());
        let sum: f64 = squares.iter().map(|square| area(&square.outline)).sum();
        assert!((sum / 4.5 - 1.0).abs() < 0.02, "{sum}");
        for square in &squares {
            assert!((square.outline[0][0] + square.outline[1][0] - 2.0 * square.value).abs() < 0.0201);
        }
    }

    #[test]
    fn weights_are_summed_up_per_area() {
        let points = [([0.1, 0.1], 2.0), ([0.2, 0.3], 1.0), ([1.9, 0.9], 4.0), ([5.0, 0.0], 9.0)];
        let cells = Grid::new([[0.0, 2.0], [0.0, 1.0]], [2, 1]).densities(&points);
        assert_eq!(cells.iter().map(|cell| cell.value).collect::<Vec<_>>(), [3.0, 4.0]);
    }
}
