//! What a model says of every measured row, under several draws of what it leaves to chance.

use rayon::prelude::*;

use crate::dataset::Measurement;
use crate::model::Model;
use crate::rng::ImpactRng;

/// What a model says of one row under one draw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Prediction {
    /// Normal restitution of a rebound [1].
    pub e_n: f64,
    /// Tangential restitution of a rebound [1].
    pub e_t: f64,
    /// Probability of capture [1].
    pub capture: f64,
    /// Share of the row's draws that this one stands for [1].
    pub weight: f64,
    /// How far it stands from its neighbours among the row's draws, in `e_n` and `e_t` [1]: what lies between two draws
    /// is as likely as they are.
    pub reach: [f64; 2],
}

/// What a model says of several rows: `draws` answers a row.
#[derive(Debug, Clone)]
pub(super) struct Forecast {
    /// Answers a row.
    pub draws: usize,
    said: Vec<Prediction>,
}

/// Draws a row for models that leave something to chance: while candidates are compared, and for the last fit.
pub(super) const COARSE: usize = 16;
pub(super) const FINE: usize = 64;
/// Steps of the lattice of draws, one a stream: odd, so that each visits all places.
const STEPS: [usize; 4] = [1, 3, 5, 7];
/// No draw stands for more than this on either side [1].
const FARTHEST: f64 = 0.1;
/// Rows below which threads cost more than they bring.
const WORTH_THREADS: usize = 20_000;

impl Forecast {
    /// Asks the model about the rows with these indices, `draws` times each where it leaves something to chance.
    pub fn new(model: &Model, all: &[Measurement], rows: &[usize], draws: usize) -> Self {
        let streams: Vec<u64> = model.terms().iter().filter_map(|t| t.kind().stream).collect();
        let draws = if streams.is_empty() { 1 } else { draws };
        let (streams, count) = (&streams, draws);
        let ask = |&index: &usize| {
            let draws = Draws::new(index, streams, count);
            let mut said: Vec<Prediction> =
                (0..count).map(|draw| ask(model, &all[index], streams, &draws, draw)).collect();
            set_reach(&mut said);
            said
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
    pub fn of(&self, place: usize) -> &[Prediction] {
        &self.said[place * self.draws..(place + 1) * self.draws]
    }
}

/// The draws of one row.
struct Draws {
    /// How far the lattice is turned in each stream, by its number.
    turns: [f64; STEPS.len()],
    count: usize,
}

impl Draws {
    fn new(row: usize, streams: &[u64], count: usize) -> Self {
        let turn = ImpactRng::new(0, row as u64);
        let mut turns = [0.0; STEPS.len()];
        for &stream in streams {
            turns[stream as usize % STEPS.len()] = turn.uniform(stream);
        }
        Self { turns, count }
    }

    /// A place in 0 to 1: a lattice that is turned at random for every row, even within a row and smooth over all.
    fn place(&self, draw: usize, stream: u64) -> f64 {
        let which = stream as usize % STEPS.len();
        let place = ((draw * STEPS[which]) % self.count) as f64 / self.count as f64;
        (place + self.turns[which]).fract()
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

/// Half the mean gap to both neighbours; the geometric mean, so that draws that agree stay sharp.
fn set_reach(said: &mut [Prediction]) {
    if said.len() < 2 {
        return;
    }
    let quantities: [fn(&Prediction) -> f64; 2] = [|one| one.e_n, |one| one.e_t];
    let mut order: Vec<usize> = (0..said.len()).collect();
    for (place, of) in quantities.into_iter().enumerate() {
        order.sort_unstable_by(|&a, &b| of(&said[a]).total_cmp(&of(&said[b])));
        let mut before = None;
        for rank in 0..order.len() {
            let after = order.get(rank + 1).map(|&next| of(&said[next]) - of(&said[order[rank]]));
            let gap = match (before, after) {
                (Some(before), Some(after)) => f64::sqrt(before * after),
                (one, other) => one.or(other).unwrap_or(0.0),
            };
            said[order[rank]].reach[place] = (0.5 * gap).min(FARTHEST);
            before = after;
        }
    }
}

fn ask(model: &Model, row: &Measurement, streams: &[u64], draws: &Draws, draw: usize) -> Prediction {
    let weight = streams.iter().map(|&stream| share(draws.place(draw, stream))).product::<f64>();
    match model.resolve_with(row.wall, &row.impact, |stream| stretched(draws.place(draw, stream))) {
        Ok(outcome) => Prediction {
            e_n: outcome.normal_restitution,
            e_t: outcome.tangential_restitution,
            capture: outcome.sticking_probability,
            weight,
            reach: [0.0; 2],
        },
        // Rows that the base model cannot answer were left out before; effects change no property's range.
        Err(_) => Prediction { e_n: 0.0, e_t: 0.0, capture: 0.5, weight, reach: [0.0; 2] },
    }
}
