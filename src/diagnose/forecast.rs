//! What a model says of every measured row, under several draws of what it leaves to chance.

use rayon::prelude::*;

use crate::dataset::Measurement;
use crate::draw::Draw;
use crate::model::Model;

/// What a model says of one row under one draw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Said {
    /// Normal restitution of a rebound [1].
    pub e_n: f64,
    /// Tangential restitution of a rebound [1].
    pub e_t: f64,
    /// Probability of capture [1].
    pub capture: f64,
}

/// What a model says of several rows: `draws` answers a row.
#[derive(Debug, Clone)]
pub(super) struct Forecast {
    /// Answers a row.
    pub draws: usize,
    said: Vec<Said>,
}

/// Draws a row for models that leave something to chance.
const DRAWS: usize = 16;
/// Steps of the lattice of draws, one a stream: odd, so that each visits all of [`DRAWS`].
const STEPS: [usize; 6] = [1, 1, 3, 5, 7, 11];
/// Rows below which threads cost more than they bring.
const WORTH_THREADS: usize = 20_000;

impl Forecast {
    /// Asks the model about the rows with these indices.
    pub fn new(model: &Model, all: &[Measurement], rows: &[usize]) -> Self {
        let by_chance = model.terms().iter().any(|term| !term.kind().streams.is_empty());
        let draws = if by_chance { DRAWS } else { 1 };
        let ask = |&index: &usize| (0..draws).map(move |draw| ask(model, &all[index], index, draw));
        let said = if rows.len() * draws > WORTH_THREADS {
            rows.par_iter().flat_map_iter(ask).collect()
        } else {
            rows.iter().flat_map(ask).collect()
        };
        Self { draws, said }
    }

    /// The answers to the rows at these places.
    pub fn of_places(&self, places: impl Iterator<Item = usize>) -> Self {
        Self { draws: self.draws, said: places.flat_map(|place| self.of(place)).copied().collect() }
    }

    /// The answers to the row at this place of the list of rows.
    pub fn of(&self, place: usize) -> &[Said] {
        &self.said[place * self.draws..(place + 1) * self.draws]
    }
}

fn ask(model: &Model, row: &Measurement, index: usize, draw: usize) -> Said {
    // A lattice that is turned at random for every row: even within a row, smooth over all of them.
    let turn = Draw::new(0, index as u64);
    let uniform = |stream: u64| {
        let step = STEPS[stream as usize % STEPS.len()];
        let place = ((draw * step) % DRAWS) as f64 / DRAWS as f64;
        (place + turn.uniform(stream)).fract()
    };
    match model.resolve_with(row.wall, &row.impact, uniform) {
        Ok(outcome) => Said {
            e_n: outcome.normal_restitution,
            e_t: outcome.tangential_restitution,
            capture: outcome.sticking_probability,
        },
        // Rows that the base model cannot answer were left out before; effects change no property's range.
        Err(_) => Said { e_n: 0.0, e_t: 0.0, capture: 0.5 },
    }
}
