//! Maps of a model: what it decides over two inputs of an impact while the other inputs are fixed.
//!
//! A [`Map`] has a [`Cell`] for each pair of values of two [`InputAxis`], a [`MapSeries`] a map for each value of a
//! third input. Random draws are averaged. Format for users: `docs/how-to/map.md`.

mod axis;
mod cell;
mod series;

use rayon::prelude::*;

use crate::range::{RangeCounts, RangeReader, Reason};
use nearwall::impact::Impact;
use nearwall::model::Model;

pub use axis::{AxisError, DEFAULT_POINTS, InputAxis, SLIDER_POINTS, Setting};
pub use cell::Cell;
use cell::Draws;
pub use series::MapSeries;

/// What a model decides over two inputs.
#[derive(Debug, Clone)]
pub struct Map {
    /// Name of the wall.
    pub wall: String,
    /// The input along the x axis.
    pub x: InputAxis,
    /// The input along the y axis.
    pub y: InputAxis,
    /// The other inputs.
    pub fixed: Impact,
    /// Random draws behind each cell; 1 for a model without random effects.
    pub draws: usize,
    /// One cell for each pair of values, `x` running fastest; `None` where the impact cannot be decided.
    pub cells: Vec<Option<Cell>>,
    /// Why the first undecided cell could not be decided.
    pub first_refusal: Option<String>,
    /// The stated ranges that the cells leave.
    pub ranges: RangeCounts,
}

impl Map {
    /// Decides the impacts `fixed` on the wall with index `wall` over both axes.
    pub fn new(model: &Model, wall: usize, [x, y]: [InputAxis; 2], fixed: Impact) -> Self {
        let draws = Draws::of(model);
        let columns = x.values();
        let impact = |row: f64, column: f64| {
            let mut impact = fixed;
            (y.input().set)(&mut impact, row);
            (x.input().set)(&mut impact, column);
            impact
        };
        let impacts = y.values().into_iter().flat_map(|row| columns.iter().map(move |column| (row, *column)));
        let impacts: Vec<Impact> = impacts.map(|(row, column)| impact(row, column)).collect();
        let decided: Vec<_> = impacts.par_iter().map(|impact| draws.decide(model, wall, impact)).collect();
        let refusal = |cell: &Result<Cell, _>| cell.as_ref().err().map(ToString::to_string);
        let first_refusal = decided.iter().find_map(refusal);
        let mut cells: Vec<Option<Cell>> = decided.into_iter().map(Result::ok).collect();
        let ranges = count_ranges(model, wall, &impacts, &mut cells);
        let wall = model.walls().get(wall).map_or("", |wall| wall.name()).to_owned();
        Self { wall, x, y, fixed, draws: draws.count(), cells, first_refusal, ranges }
    }

    /// Number of cells that could not be decided.
    pub fn undecided(&self) -> usize {
        self.cells.iter().filter(|cell| cell.is_none()).count()
    }

    /// Number of cells outside a stated range in a way that matters.
    pub fn beyond(&self) -> usize {
        self.cells.iter().flatten().filter(|cell| cell.beyond).count()
    }

    /// Both values of each cell, in the order of the cells.
    pub fn places(&self) -> impl Iterator<Item = [f64; 2]> {
        let columns = self.x.values();
        let pair = move |row: f64| columns.clone().into_iter().map(move |column| [column, row]);
        self.y.values().into_iter().flat_map(pair)
    }
}

/// Counts the stated ranges that cells leave, and marks those for which it matters.
fn count_ranges(model: &Model, wall: usize, impacts: &[Impact], cells: &mut [Option<Cell>]) -> RangeCounts {
    let reader = RangeReader::new(model);
    let find = |(cell, impact): (&mut Option<Cell>, &Impact)| {
        let cell = cell.as_mut()?;
        let reasons = if cell.outside_range { reader.reasons(wall, impact) } else { Vec::new() };
        cell.beyond = reasons.iter().any(Reason::matters);
        Some(reasons)
    };
    let reasons: Vec<Option<Vec<Reason>>> = cells.par_iter_mut().zip(impacts).map(find).collect();
    let mut counts = RangeCounts::default();
    reasons.iter().flatten().for_each(|reasons| counts.add(reasons));
    counts
}

/// Speeds [m/s] at which the dependence on an input is tried.
const TRIED_SPEEDS: [f64; 3] = [0.3, 3.0, 30.0];

/// The axes of a map where the user gives one or none: `v_n`, and the first of `T_w`, `d`, `T_p`,
/// `conversion` and `v_t` that changes an outcome; none of them is the third input.
pub fn default_axes(
    model: &Model,
    wall: usize,
    fixed: &Impact,
    [x, y, third]: [Option<InputAxis>; 3],
    points: usize,
) -> Option<[InputAxis; 2]> {
    let mut candidates = Vec::new();
    for name in ["v_n", "T_w", "d", "T_p", "conversion", "v_t"] {
        let Some(axis) = InputAxis::over_default_range(name, model, wall, points) else { continue };
        let taken = [&x, &y, &third].into_iter().flatten().any(|given| given.input().name == name);
        if !taken && (name == "v_n" || depends_on(model, wall, fixed, &axis)) {
            candidates.push(axis);
        }
    }
    // A model that depends on nothing else still has a map.
    for name in ["d", "T_w"].into_iter().filter(|name| third.is_none_or(|third| third.input().name != *name))
    {
        candidates.extend(InputAxis::over_default_range(name, model, wall, points));
    }
    let mut next = candidates.into_iter();
    let x = x.or_else(|| next.next())?;
    let y = y.or_else(|| next.find(|axis| axis.input().name != x.input().name))?;
    Some([x, y])
}

/// Whether an input changes what the model decides, at some speeds.
fn depends_on(model: &Model, wall: usize, fixed: &Impact, axis: &InputAxis) -> bool {
    let draws = Draws::of(model);
    let varies = |speed: f64| {
        let decide = |value: f64| {
            let mut impact = Impact { normal_speed: speed, ..*fixed };
            (axis.input().set)(&mut impact, value);
            // The range that a law is stated for is no outcome.
            draws.decide(model, wall, &impact).ok().map(|cell| Cell { outside_range: false, ..cell })
        };
        let mut outcomes = axis.with_points(16).values().into_iter().filter_map(decide);
        outcomes.next().is_some_and(|first| outcomes.any(|other| other != first))
    };
    TRIED_SPEEDS.into_iter().any(varies)
}
