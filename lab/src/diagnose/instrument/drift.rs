//! Readings that drift in the order of the file: a lamp, a camera, a wall that gets dirty.
//!
//! The row at the share `x` of the lines, 0 the first and 1 the last, reads `e_n + a + s x`: a line
//! through the residuals of the base model, with the drift `s` [1] over the file tried about its
//! slope. `e_t` may drift instead.
//!
//! Rows that are sorted by a column cannot tell a drift from a dependence on it. The drift then counts
//! as `2 + R² (k-2)` parameters, up to the `k` heights of a curve over that column, which explains
//! the share `R²` of the variance of `x`.

use super::super::data_split::DataSplit;
use super::super::hypothesis::Hypothesis;
use super::super::observable::Observable;
use super::super::reading::OtherReading;
use super::super::smooth::{Basis, WeightedResidual, ridge, sum};

/// Drifts that are tried, over the slope of the residuals [1].
const TRIED: [f64; 5] = [0.6, 0.8, 1.0, 1.2, 1.4];

pub(super) fn of_e_n(data: &DataSplit) -> Option<OtherReading> {
    reading(data, Observable::NormalRestitution)
}

pub(super) fn of_e_t(data: &DataSplit) -> Option<OtherReading> {
    reading(data, Observable::TangentialRestitution)
}

fn reading(data: &DataSplit, observable: Observable) -> Option<OtherReading> {
    let lines = || data.rows.iter().map(|row| row.line);
    let (first, last) = (lines().min()? as f64, lines().max()? as f64);
    let place = move |line: u64| (line as f64 - first) / (last - first);
    let base = Hypothesis::base(data);
    let residuals = base.evaluate(&*data.search, base.offsets()).residuals(observable, false);
    let Line { middle, level, slope } = Line::through(&residuals, |row| place(data.rows[row].line))?;
    let mut values = TRIED.map(|factor| factor * slope).to_vec();
    values.sort_by(f64::total_cmp);
    let name = observable.name();
    Some(OtherReading {
        id: "artefact:drift".to_owned(),
        question: Box::new(move |drift: f64| {
            format!(
                "These numbers fit if {name} were read with a drift of {drift:+.3} from the first to the last \
                 row of the file: is that the order of measurement, and do the readings drift (lamp, camera, a \
                 wall that gets dirty)?"
            )
        }),
        change: Box::new(move |row, offset, drift| {
            offset.restitution[observable as usize] += level + drift * (place(row.line) - middle);
            Some(0.0)
        }),
        values,
        freedom: freedom(data, place),
        model: None,
    })
}

/// A straight line of least squares.
struct Line {
    /// Mean place [1], the height there [1] and the slope [1].
    middle: f64,
    level: f64,
    slope: f64,
}

impl Line {
    /// Through residuals over the places of their rows; `None` where there is none.
    fn through(residuals: &[WeightedResidual], place: impl Fn(usize) -> f64) -> Option<Self> {
        let weights = residuals.iter().map(|one| one.weight).sum::<f64>();
        let mean = |of: &dyn Fn(&WeightedResidual) -> f64| {
            residuals.iter().map(|one| one.weight * of(one)).sum::<f64>() / weights
        };
        let (middle, level) = (mean(&|one| place(one.row)), mean(&|one| one.residual));
        let square = mean(&|one| (place(one.row) - middle).powi(2));
        let slope = mean(&|one| (place(one.row) - middle) * (one.residual - level)) / square;
        (slope != 0.0 && slope.is_finite()).then_some(Self { middle, level, slope })
    }
}

/// Number of parameters of a drift that a curve over a column may be.
fn freedom(data: &DataSplit, place: impl Fn(u64) -> f64) -> f64 {
    let point = |&row: &usize| {
        let residual = place(data.rows[row].line);
        WeightedResidual { row, residual, weight: 1.0, scale: 1.0 }
    };
    let points: Vec<WeightedResidual> = data.search.iter().map(point).collect();
    let variance = |of: &dyn Fn(&WeightedResidual) -> f64| {
        let mean = points.iter().map(of).sum::<f64>() / points.len() as f64;
        points.iter().map(|one| (of(one) - mean).powi(2)).sum::<f64>()
    };
    let of_column = |column: usize| {
        let values = data.values(column);
        let basis = Basis::of(values, &data.search)?;
        let curve = ridge(&basis.penalty(), &points, |row| basis.entry(values, row))?;
        let left = |one: &WeightedResidual| one.residual - sum(&basis.entry(values, one.row), &curve.heights);
        let explained = 1.0 - variance(&left) / variance(&|one| one.residual);
        Some(2.0 + explained.clamp(0.0, 1.0) * (basis.len() as f64 - 2.0))
    };
    (0..data.covariates.len()).filter_map(of_column).fold(2.0, f64::max)
}
