//! Penalised regression of residuals on one column or two.
//!
//! Numbers: a linear spline with up to eight knots at quantiles of the column and a penalty on its bends (P-spline of
//! degree one; Eilers and Marx 1996). Labels: a ridge-penalised height for each label. The penalty minimises the
//! generalised cross-validation error. Blank cells have no effect.

use nalgebra::{DMatrix, DVector};

use crate::dataset::ColumnValues;

/// Largest number of knots of a curve.
const KNOTS: usize = 8;
/// Largest number of knots of one side of a surface.
const SIDE_KNOTS: usize = 5;
/// Least number of points of a curve with so many parameters.
const LEAST_CURVE_POINTS: usize = 4;
/// Largest number of different labels.
const LABELS: usize = 40;
/// Penalties tried, relative to the mean diagonal of the normal matrix.
const PENALTIES: [f64; 9] = [1e-3, 1e-2, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 1e4];

/// The nonzero basis functions of a row: places in the basis and values.
pub(super) type Entry = Vec<(usize, f64)>;

/// The basis functions of a curve over a column.
#[derive(Debug, Clone)]
pub(super) enum Basis {
    /// Hat functions over these knots, in ascending order.
    Hats(Vec<f64>),
    /// One indicator function a label.
    Labels(usize),
}

impl Basis {
    /// The basis for a column; `None` if the rows with these indices do not vary enough in it.
    pub fn of(values: &ColumnValues, rows: &[usize]) -> Option<Self> {
        match values {
            ColumnValues::Numbers(numbers) => Self::of_numbers(rows.iter().map(|&row| numbers[row]), KNOTS),
            ColumnValues::Labels { levels, of_row } => {
                let used =
                    (0..levels.len()).filter(|&l| rows.iter().any(|&row| of_row[row] == Some(l))).count();
                // Nearly as many labels as rows identify the row and predict nothing for another one.
                (used > 1 && levels.len() <= LABELS && used * 4 <= rows.len())
                    .then_some(Self::Labels(levels.len()))
            }
        }
    }

    /// The basis of one side of a surface.
    pub fn of_side(values: &ColumnValues, rows: &[usize]) -> Option<Self> {
        match values {
            ColumnValues::Numbers(numbers) => {
                Self::of_numbers(rows.iter().map(|&row| numbers[row]), SIDE_KNOTS)
            }
            ColumnValues::Labels { .. } => Self::of(values, rows),
        }
    }

    fn of_numbers(numbers: impl Iterator<Item = f64>, most: usize) -> Option<Self> {
        let mut sorted: Vec<f64> = numbers.filter(|value| value.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let (low, high) = (*sorted.first()?, *sorted.last()?);
        if high <= low || sorted.len() < 4 {
            return None;
        }
        let most = most.min(sorted.len() / 3).max(2);
        let quantile = |i: usize| sorted[(i * (sorted.len() - 1)) / (most - 1)];
        let mut knots: Vec<f64> = (0..most).map(quantile).collect();
        knots.dedup_by(|a, b| *a - *b < 1e-9 * (high - low));
        Some(Self::Hats(knots))
    }

    pub fn len(&self) -> usize {
        match self {
            Self::Hats(knots) => knots.len(),
            Self::Labels(count) => *count,
        }
    }

    /// The basis functions at a row.
    pub fn entry(&self, values: &ColumnValues, row: usize) -> Entry {
        match (self, values) {
            (Self::Hats(knots), ColumnValues::Numbers(numbers)) => hats(knots, numbers[row]),
            (Self::Labels(_), ColumnValues::Labels { of_row, .. }) => {
                of_row[row].map_or(Vec::new(), |level| vec![(level, 1.0)])
            }
            _ => Vec::new(),
        }
    }

    /// The penalty on the heights: bends for numbers, size for labels.
    pub fn penalty(&self) -> DMatrix<f64> {
        let count = self.len();
        let Self::Hats(knots) = self else { return DMatrix::identity(count, count) };
        let mut penalty = DMatrix::zeros(count, count);
        let span = knots[count - 1] - knots[0];
        for i in 1..count - 1 {
            let (left, right) = ((knots[i] - knots[i - 1]) / span, (knots[i + 1] - knots[i]) / span);
            let bend = [(i - 1, 1.0 / left), (i, -1.0 / left - 1.0 / right), (i + 1, 1.0 / right)];
            // The penalty of a bend does not depend on the length of its intervals.
            let scale = 0.5 * (left + right);
            for &(a, x) in &bend {
                for &(b, y) in &bend {
                    penalty[(a, b)] += x * y * scale * scale;
                }
            }
        }
        // A small ridge penalty keeps a column with two knots regular.
        penalty + DMatrix::identity(count, count) * 1e-6
    }
}

impl Basis {
    /// The mean of the basis functions over some numbers; none over labels.
    pub fn mean_entry(&self, numbers: &[f64]) -> Entry {
        let Self::Hats(knots) = self else { return Vec::new() };
        let share = 1.0 / numbers.len() as f64;
        let one =
            |number: &f64| hats(knots, *number).into_iter().map(move |(at, height)| (at, share * height));
        numbers.iter().flat_map(one).collect()
    }
}

/// The two hats over a number, constant beyond the ends.
fn hats(knots: &[f64], value: f64) -> Entry {
    if !value.is_finite() {
        return Vec::new();
    }
    let right = knots.partition_point(|knot| *knot <= value);
    if right == 0 {
        return vec![(0, 1.0)];
    }
    if right == knots.len() {
        return vec![(right - 1, 1.0)];
    }
    let share = (value - knots[right - 1]) / (knots[right] - knots[right - 1]);
    vec![(right - 1, 1.0 - share), (right, share)]
}

/// One row as a curve is fitted to it.
#[derive(Debug, Clone, Copy)]
pub(super) struct WeightedResidual {
    /// Index of the row.
    pub row: usize,
    /// Measured minus predicted value.
    pub residual: f64,
    /// Weight: one over the variance, less for gross errors.
    pub weight: f64,
    /// Factor on the curve in this row: the prediction for a multiplicative curve, otherwise 1.
    pub scale: f64,
}

/// The sum of the basis functions of a row, each with its height.
pub(super) fn sum(entry: &Entry, heights: &[f64]) -> f64 {
    entry.iter().map(|&(place, share)| share * heights[place]).sum()
}

/// A fitted curve.
#[derive(Debug, Clone)]
pub(super) struct Smoothed {
    /// Heights of the basis functions.
    pub heights: Vec<f64>,
    /// Effective number of parameters.
    pub freedom: f64,
    /// What the penalty minimises.
    pub criterion: f64,
}

/// Heights of the basis functions `entry` of each row: penalised least squares with the penalty of smallest generalised
/// cross-validation error. `None` where there are too few points.
pub(super) fn ridge(
    penalty: &DMatrix<f64>,
    points: &[WeightedResidual],
    entry: impl Fn(usize) -> Entry,
) -> Option<Smoothed> {
    let error = |left: f64, freedom: f64, rows: f64| left / (1.0 - freedom / rows).max(0.05).powi(2);
    smoothed(penalty, points, entry, error)
}

/// The same with the penalty of most evidence (Schwarz 1978), which is larger; the criterion is minus twice the log
/// evidence but for a constant of the points.
pub(super) fn evident(
    penalty: &DMatrix<f64>,
    points: &[WeightedResidual],
    entry: impl Fn(usize) -> Entry,
) -> Option<Smoothed> {
    smoothed(penalty, points, entry, |left, freedom, rows| rows * left.ln() + freedom * rows.ln())
}

/// Heights by penalised least squares; of the penalties the one with the least `worst` of the squares that are left,
/// the freedom and the number of rows.
fn smoothed(
    penalty: &DMatrix<f64>,
    points: &[WeightedResidual],
    entry: impl Fn(usize) -> Entry,
    worst: impl Fn(f64, f64, f64) -> f64,
) -> Option<Smoothed> {
    let count = penalty.nrows();
    let mut normal: DMatrix<f64> = DMatrix::zeros(count, count);
    let mut right: DVector<f64> = DVector::zeros(count);
    let (mut square, mut weights) = (0.0_f64, 0.0_f64);
    for point in points {
        let mut entry = entry(point.row);
        entry.iter_mut().for_each(|(_, value)| *value *= point.scale);
        for &(a, x) in &entry {
            right[a] += point.weight * x * point.residual;
            for &(b, y) in &entry {
                normal[(a, b)] += point.weight * x * y;
            }
        }
        square += point.weight * point.residual * point.residual;
        weights += point.weight;
    }
    if weights <= 0.0 || points.len() < count.min(LEAST_CURVE_POINTS) {
        return None;
    }
    let scale = normal.trace() / count as f64;
    let rows = points.len() as f64;
    let attempt = |relative: f64| {
        let inverse = (&normal + penalty * (relative * scale)).cholesky()?.inverse();
        let heights = &inverse * &right;
        let freedom = (&inverse * &normal).trace();
        let left = square - 2.0 * heights.dot(&right) + (&normal * &heights).dot(&heights);
        Some((worst(left.max(0.0), freedom, rows), heights, freedom))
    };
    let best = PENALTIES.into_iter().filter_map(attempt).min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Smoothed { heights: best.1.iter().copied().collect(), freedom: best.2, criterion: best.0 })
}

/// Fits curves over the columns `own`, and interactions of each of them with another of `own` or `others`, which have
/// no curve of their own. Returns the fitted values at the rows `targets`, with mean zero over the points, and the
/// effective number of parameters.
pub(super) fn surface(
    own: &[&ColumnValues],
    others: &[&ColumnValues],
    points: &[WeightedResidual],
    targets: &[usize],
) -> (Vec<f64>, f64) {
    let rows: Vec<usize> = points.iter().map(|point| point.row).collect();
    let with_basis = |values: &&ColumnValues| Some((Basis::of(values, &rows)?, (*values).clone()));
    let based = |values: &[&ColumnValues]| values.iter().filter_map(with_basis).collect::<Vec<_>>();
    let (own, others) = (based(own), based(others));
    let mut left: Vec<WeightedResidual> = points.to_vec();
    let mut fitted = vec![0.0; targets.len()];
    let mut parameters = 0.0;
    let mut take = |left: &mut Vec<WeightedResidual>, at: &dyn Fn(usize) -> f64| {
        subtract(left, at);
        fitted.iter_mut().zip(targets).for_each(|(sum, &row)| *sum += at(row));
    };
    // The second pass distributes the effect over correlated columns (backfitting).
    for pass in 0..2 {
        for (basis, values) in &own {
            if let Some(Smoothed { heights, freedom, .. }) =
                ridge(&basis.penalty(), &left, |row| basis.entry(values, row))
            {
                parameters += if pass == 0 { freedom } else { 0.0 };
                take(&mut left, &|row| sum(&basis.entry(values, row), &heights));
            }
        }
    }
    // What another column does by itself is no interaction with it: a further law may do that.
    let mut apart = left.clone();
    for (basis, values) in &others {
        if let Some(Smoothed { heights, .. }) =
            ridge(&basis.penalty(), &apart, |row| basis.entry(values, row))
        {
            subtract(&mut apart, &|row| sum(&basis.entry(values, row), &heights));
        }
    }
    for first in 0..own.len() {
        for (basis, values) in own[first + 1..].iter().chain(&others) {
            let pair = [(&own[first].0, &own[first].1), (basis, values)];
            let count = pair[0].0.len() * basis.len();
            let entry = |row: usize| products(&pair, row);
            if let Some(Smoothed { heights, freedom, .. }) =
                ridge(&DMatrix::identity(count, count), &apart, entry)
            {
                parameters += freedom;
                take(&mut left, &|row| sum(&entry(row), &heights));
                subtract(&mut apart, &|row| sum(&entry(row), &heights));
            }
        }
    }
    // The mean stays with the model.
    let mean = mean_taken(points, &left);
    fitted.iter_mut().for_each(|value| *value -= mean);
    (fitted, parameters)
}

/// Takes the value at each row from its residual.
fn subtract(points: &mut [WeightedResidual], at: &dyn Fn(usize) -> f64) {
    points.iter_mut().for_each(|point| point.residual -= point.scale * at(point.row));
}

/// Weighted mean of what a fit took from the residuals.
fn mean_taken(before: &[WeightedResidual], after: &[WeightedResidual]) -> f64 {
    let weights: f64 = before.iter().map(|point| point.weight).sum();
    let taken =
        before.iter().zip(after).map(|(before, after)| before.weight * (before.residual - after.residual));
    if weights > 0.0 { taken.sum::<f64>() / weights } else { 0.0 }
}

/// The basis functions of an interaction: all products.
pub(super) fn products(pair: &[(&Basis, &ColumnValues); 2], row: usize) -> Entry {
    let [one, two] = pair.map(|(basis, values)| basis.entry(values, row));
    product(&one, &two, pair[1].0.len())
}

/// All products of two sides, of which the second has `wide` basis functions.
pub(super) fn product(one: &Entry, two: &Entry, wide: usize) -> Entry {
    let product = |&(a, x): &(usize, f64)| two.iter().map(move |&(b, y)| (a * wide + b, x * y));
    one.iter().flat_map(product).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(count: usize, of: impl Fn(usize) -> f64) -> Vec<WeightedResidual> {
        (0..count).map(|row| WeightedResidual { row, residual: of(row), weight: 1.0, scale: 1.0 }).collect()
    }

    #[test]
    fn a_curve_follows_a_sine() {
        let x: Vec<f64> = (0..200).map(|i| f64::from(i) / 200.0).collect();
        let values = ColumnValues::Numbers(x.clone());
        let rows: Vec<usize> = (0..200).collect();
        let basis = Basis::of(&values, &rows).unwrap();
        let fit =
            ridge(&basis.penalty(), &points(200, |i| (3.0 * x[i]).sin()), |row| basis.entry(&values, row));
        let heights = fit.unwrap().heights;
        let error = |&i: &usize| (sum(&basis.entry(&values, i), &heights) - (3.0 * x[i]).sin()).abs();
        let worst = rows.iter().map(error).fold(0.0, f64::max);
        assert!(worst < 0.03, "{worst}");
    }

    /// What `y` does by itself stays in the residuals; what it does with `x` does not.
    #[test]
    fn a_surface_leaves_the_curve_of_another_column() {
        let x = ColumnValues::Numbers((0..400).map(|i| f64::from(i % 20) / 20.0).collect());
        let y = ColumnValues::Numbers((0..400).map(|i| f64::from(i / 20) / 20.0).collect());
        let at = |i: usize| [(i % 20) as f64 / 20.0 - 0.475, (i / 20) as f64 / 20.0 - 0.475];
        let all: Vec<usize> = (0..400).collect();
        let size = |of: &dyn Fn([f64; 2]) -> f64| {
            let (fitted, _) = surface(&[&x], &[&y], &points(400, |i| of(at(i))), &all);
            (fitted.iter().map(|one| one * one).sum::<f64>() / 400.0).sqrt()
        };
        assert!(size(&|[_, y]| y) < 0.02, "{}", size(&|[_, y]| y));
        // Root mean square of the product: 0.288 squared.
        assert!(size(&|[x, y]| x * y) > 0.06, "{}", size(&|[x, y]| x * y));
        assert!(size(&|[x, _]| x) > 0.2, "{}", size(&|[x, _]| x));
    }

    #[test]
    fn labels_have_heights_and_identifiers_of_rows_are_refused() {
        let of_row = (0..60).map(|i| Some(i % 3)).collect();
        let values = ColumnValues::Labels { levels: vec!["a".into(), "b".into(), "c".into()], of_row };
        let rows: Vec<usize> = (0..60).collect();
        let basis = Basis::of(&values, &rows).unwrap();
        let points = points(60, |i| [0.5, -0.25, -0.25][i % 3]);
        let fit = ridge(&basis.penalty(), &points, |row| basis.entry(&values, row)).unwrap();
        assert!((fit.heights[0] - 0.5).abs() < 0.01 && fit.freedom < 3.01);
        let labels = ColumnValues::Labels {
            levels: (0..30).map(|i| i.to_string()).collect(),
            of_row: (0..60).map(|i| Some(i % 30)).collect(),
        };
        assert!(Basis::of(&labels, &rows).is_none());
    }
}
