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
    /// Share of the row's draws that this one stands for [1].
    pub weight: f64,
}

/// What a model says of several rows: `draws` answers a row.
#[derive(Debug, Clone)]
pub(super) struct Forecast {
    /// Answers a row.
    pub draws: usize,
    said: Vec<Said>,
}

/// Draws a row for models that leave something to chance: while candidates are compared, and for the last fit.
pub(super) const COARSE: usize = 16;
pub(super) const FINE: usize = 64;
/// Steps of the lattice of draws, one a stream: odd, so that each visits all places.
const STEPS: [usize; 6] = [1, 1, 3, 5, 7, 11];
/// Rows below which threads cost more than they bring.
const WORTH_THREADS: usize = 20_000;

impl Forecast {
    /// Asks the model about the rows with these indices, `draws` times each where it leaves something to chance.
    pub fn new(model: &Model, all: &[Measurement], rows: &[usize], draws: usize) -> Self {
        let streams: Vec<u64> = model.terms().iter().flat_map(|t| t.kind().streams.iter().copied()).collect();
        let draws = if streams.is_empty() { 1 } else { draws };
        let (streams, count) = (&streams, draws);
        let ask = |&index: &usize| {
            let row = &all[index];
            (0..count).map(move |draw| ask(model, row, streams, Node { row: index, draw, count }))
        };
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

/// One draw of a row's.
#[derive(Clone, Copy)]
struct Node {
    row: usize,
    draw: usize,
    count: usize,
}

impl Node {
    /// A place in 0 to 1: a lattice that is turned at random for every row, even within a row and smooth over all.
    fn place(self, stream: u64) -> f64 {
        let step = STEPS[stream as usize % STEPS.len()];
        let place = ((self.draw * step) % self.count) as f64 / self.count as f64;
        (place + Draw::new(0, self.row as u64).uniform(stream)).fract()
    }
}

/// Moves places towards both ends, where rare branches and long tails are.
fn stretched(place: f64) -> f64 {
    0.3 * place + 0.7 * place * place * (3.0 - 2.0 * place)
}

/// How much of the unit interval a stretched place stands for: the derivative of [`stretched`].
fn share(place: f64) -> f64 {
    0.3 + 4.2 * place * (1.0 - place)
}

fn ask(model: &Model, row: &Measurement, streams: &[u64], node: Node) -> Said {
    let weight = streams.iter().map(|&stream| share(node.place(stream))).product::<f64>();
    match model.resolve_with(row.wall, &row.impact, |stream| stretched(node.place(stream))) {
        Ok(outcome) => Said {
            e_n: outcome.normal_restitution,
            e_t: outcome.tangential_restitution,
            capture: outcome.sticking_probability,
            weight,
        },
        // Rows that the base model cannot answer were left out before; effects change no property's range.
        Err(_) => Said { e_n: 0.0, e_t: 0.0, capture: 0.5, weight },
    }
}
