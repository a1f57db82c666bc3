//! A model's predictions of measured rows, with several random draws a row for a stochastic model.

use rayon::prelude::*;

use super::data_split::DataSplit;
use super::missing_inputs::MissingInputs;
use crate::dataset::Measurement;
use nearwall::impact::Impact;
use nearwall::model::{DrawLattice, Model, RotatedLattice};

/// The prediction of one row under one draw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Prediction {
    /// `e_n` and `e_t` of a rebound [1].
    pub restitution: [f64; 2],
    /// Probability of capture [1].
    pub capture: f64,
    /// Share of the row's draws that this draw represents [1].
    pub weight: f64,
    /// Half the distance to the neighbouring draws in `e_n` and `e_t` [1]: values between two draws are as likely as
    /// the draws.
    pub reach: [f64; 2],
    /// The choice of the row's missing inputs that it belongs to.
    pub filling: usize,
}

/// The predictions of several rows.
#[derive(Debug, Clone)]
pub(super) struct Forecast {
    /// Where the predictions of each row end.
    ends: Vec<usize>,
    predictions: Vec<Prediction>,
}

/// Largest reach of a draw [1].
const LARGEST_REACH: f64 = 0.1;
/// Number of predictions from which threads pay off.
const PARALLEL: usize = 20_000;
/// Rows that a thread predicts at a time.
const CHUNK: usize = 512;

impl Forecast {
    /// Predicts the rows with these indices, `draws` times each if the model is stochastic.
    pub fn new(model: &Model, all: &[Measurement], rows: &[usize], draws: usize) -> Self {
        Self::filled(model, all, rows, draws, &MissingInputs::default())
    }

    /// Predicts rows of the data: for each choice of the inputs that a row lacks.
    pub fn of_data(model: &Model, data: &DataSplit, rows: &[usize]) -> Self {
        Self::filled(model, &data.rows, rows, data.draws, &data.missing)
    }

    /// Predictions that are known, one for each row.
    pub fn stated(of_rows: Vec<Prediction>) -> Self {
        Self { ends: (1..=of_rows.len()).collect(), predictions: of_rows }
    }

    fn filled(
        model: &Model,
        all: &[Measurement],
        rows: &[usize],
        draws: usize,
        missing: &MissingInputs,
    ) -> Self {
        let place = rows.iter().any(|&row| model.draws_place(all[row].wall, &all[row].impact));
        let lattice = DrawLattice::new(model, place, draws);
        let one = |rows: &[usize]| {
            let mut new = Self::with_capacity(rows.len(), lattice.count());
            rows.iter().for_each(|&index| new.push(model, index, &all[index], &lattice, missing));
            new
        };
        if rows.len() * lattice.count() <= PARALLEL {
            return one(rows);
        }
        let parts: Vec<Self> = rows.par_chunks(CHUNK).map(one).collect();
        Self::joined(parts.iter().flat_map(|part| (0..part.ends.len()).map(|place| part.of(place))))
    }

    fn with_capacity(rows: usize, draws: usize) -> Self {
        Self { ends: Vec::with_capacity(rows), predictions: Vec::with_capacity(rows * draws) }
    }

    /// Adds the predictions of the row of this index.
    fn push(
        &mut self,
        model: &Model,
        index: usize,
        row: &Measurement,
        lattice: &DrawLattice,
        missing: &MissingInputs,
    ) {
        let start = self.predictions.len();
        let draws = 0..lattice.count();
        let rotated = lattice.rotated(index as u64);
        if missing.lacks(row) {
            for filling in 0..missing.fillings(row) {
                let impact = missing.filled(row, filling);
                let one = |draw| Prediction { filling, ..predict(model, row.wall, &impact, &rotated, draw) };
                self.predictions.extend(draws.clone().map(one));
            }
        } else {
            self.predictions.extend(draws.map(|draw| predict(model, row.wall, &row.impact, &rotated, draw)));
        }
        set_reach(&mut self.predictions[start..]);
        self.ends.push(self.predictions.len());
    }

    fn joined<'a>(of_rows: impl Iterator<Item = &'a [Prediction]>) -> Self {
        let (mut ends, mut predictions) = (Vec::new(), Vec::new());
        for own in of_rows {
            predictions.extend_from_slice(own);
            ends.push(predictions.len());
        }
        Self { ends, predictions }
    }

    /// The predictions of the rows at these places.
    pub fn select(&self, places: &[usize]) -> Self {
        Self::joined(places.iter().map(|&place| self.of(place)))
    }

    /// The predictions of the row at this place in the list of rows.
    #[inline]
    pub fn of(&self, place: usize) -> &[Prediction] {
        let start = if place == 0 { 0 } else { self.ends[place - 1] };
        &self.predictions[start..self.ends[place]]
    }
}

/// Half the mean distance to both neighbours: the geometric mean, so that equal draws have no reach.
fn set_reach(predictions: &mut [Prediction]) {
    if predictions.len() < 2 {
        return;
    }
    let mut order: Vec<usize> = (0..predictions.len()).collect();
    for which in 0..2 {
        let value = |index: usize| predictions[index].restitution[which];
        order.sort_unstable_by(|&a, &b| value(a).total_cmp(&value(b)));
        let gaps: Vec<f64> = order.windows(2).map(|pair| value(pair[1]) - value(pair[0])).collect();
        for (rank, &index) in order.iter().enumerate() {
            let before = rank.checked_sub(1).map(|rank| gaps[rank]);
            let gap = match (before, gaps.get(rank).copied()) {
                (Some(before), Some(after)) => f64::sqrt(before * after),
                (one, other) => one.or(other).unwrap_or(0.0),
            };
            predictions[index].reach[which] = (0.5 * gap).min(LARGEST_REACH);
        }
    }
}

#[inline]
fn predict(
    model: &Model,
    wall: usize,
    impact: &Impact,
    lattice: &RotatedLattice<'_>,
    draw: usize,
) -> Prediction {
    let uniform = |stream| lattice.uniform(draw, stream);
    let (restitution, capture) = match model.resolve_place_with(wall, impact, uniform) {
        Ok(outcome) => {
            ([outcome.normal_restitution, outcome.tangential_restitution], outcome.sticking_probability)
        }
        // Unreachable: rows that the base model refuses were removed, and no effect narrows a property's range.
        Err(_) => ([0.0; 2], 0.5),
    };
    Prediction { restitution, capture, weight: lattice.weight(draw), reach: [0.0; 2], filling: 0 }
}
