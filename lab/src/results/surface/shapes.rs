//! What a map draws: the faces of an unrolled wall, or cells of a grid where there are too many.

use super::{Unrolled, WallFace};

/// A wall with more faces is drawn as a grid.
pub const MOST_FACES: usize = 4000;
/// Columns and rows of the grid.
pub const GRID: [usize; 2] = [100, 60];

/// A part of a map with one value.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// Its corners in the plane [m].
    pub outline: Vec<[f64; 2]>,
    /// The area of wall that it stands for [m²].
    pub area: f64,
    /// Its value, the mean over that area.
    pub value: f64,
}

/// The shapes of a map: one for each face, or the cells of a grid with the mean over the area that lies in each.
pub fn shapes(faces: &[WallFace], unrolled: &Unrolled, values: &[f64]) -> Vec<Shape> {
    let each = faces.iter().zip(&unrolled.outlines).zip(values);
    let shapes = each.map(|((face, outline), value)| Shape {
        outline: outline.clone(),
        area: face.area,
        value: *value,
    });
    let shapes: Vec<Shape> = shapes.collect();
    if shapes.len() > MOST_FACES { Grid::of(&shapes).cells(&shapes) } else { shapes }
}

/// Area of a polygon [m²].
pub(super) fn area(outline: &[[f64; 2]]) -> f64 {
    // Relative to its first corner, or far from the origin the digits would be lost.
    let Some([x, y]) = outline.first() else { return 0.0 };
    let next = outline.iter().skip(1).chain(outline.first());
    let part = |([a, b], [c, d]): (&[f64; 2], &[f64; 2])| (a - x) * (d - y) - (c - x) * (b - y);
    0.5 * outline.iter().zip(next).map(part).sum::<f64>().abs()
}

/// A grid over the extent of some shapes.
struct Grid {
    low: [f64; 2],
    step: [f64; 2],
}

impl Grid {
    fn of(shapes: &[Shape]) -> Self {
        let corners = || shapes.iter().flat_map(|shape| &shape.outline);
        let end = |axis: usize, start: f64, pick: fn(f64, f64) -> f64| {
            corners().map(|corner| corner[axis]).fold(start, pick)
        };
        let low = [0, 1].map(|axis| end(axis, f64::INFINITY, f64::min));
        let high = [0, 1].map(|axis| end(axis, f64::NEG_INFINITY, f64::max));
        Self { low, step: [0, 1].map(|axis| (high[axis] - low[axis]) / GRID[axis] as f64) }
    }

    /// Column or row of a coordinate.
    fn place(&self, value: f64, axis: usize) -> usize {
        ((value - self.low[axis]) / self.step[axis]).floor().clamp(0.0, (GRID[axis] - 1) as f64) as usize
    }

    /// The cells in which there is some wall.
    fn cells(&self, shapes: &[Shape]) -> Vec<Shape> {
        // Area, and area times value.
        let mut sums = vec![[0.0; 2]; GRID[0] * GRID[1]];
        for shape in shapes {
            for (cell, share) in self.shares(&shape.outline) {
                sums[cell][0] += share * shape.area;
                sums[cell][1] += share * shape.area * shape.value;
            }
        }
        let cell = |(cell, [area, sum]): (usize, &[f64; 2])| {
            let outline = self.outline(cell % GRID[0], cell / GRID[0]);
            (*area > 0.0).then(|| Shape { outline, area: *area, value: sum / area })
        };
        sums.iter().enumerate().filter_map(cell).collect()
    }

    fn outline(&self, column: usize, row: usize) -> Vec<[f64; 2]> {
        let [left, right] = [column, column + 1].map(|place| self.low[0] + place as f64 * self.step[0]);
        let [bottom, top] = [row, row + 1].map(|place| self.low[1] + place as f64 * self.step[1]);
        vec![[left, bottom], [right, bottom], [right, top], [left, top]]
    }

    /// The cells that a polygon overlaps, and the share of its area in each.
    fn shares(&self, polygon: &[[f64; 2]]) -> Vec<(usize, f64)> {
        let end = |axis: usize, start: f64, pick: fn(f64, f64) -> f64| {
            self.place(polygon.iter().map(|corner| corner[axis]).fold(start, pick), axis)
        };
        let from = [0, 1].map(|axis| end(axis, f64::INFINITY, f64::min));
        let to = [0, 1].map(|axis| end(axis, f64::NEG_INFINITY, f64::max));
        let mut shares = Vec::new();
        for row in from[1]..=to[1] {
            for column in from[0]..=to[0] {
                let cell = self.outline(column, row);
                shares.push((row * GRID[0] + column, area(&within(polygon, cell[0], cell[2]))));
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
}
