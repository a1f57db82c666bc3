//! One cell of a map: what a model decides for one impact, on average over its random draws.

use nearwall::effect::stream;
use nearwall::impact::{Impact, ImpactError, Outcome, Regime};
use nearwall::model::Model;

/// Draws a cell of a model with random effects.
const DRAWS_A_CELL: usize = 64;
/// Steps of the lattice of draws, one a stream. They are odd, so each stream visits all places.
const LATTICE_STEPS: [usize; 3] = [1, 19, 27];
/// A random number that selects the more probable one of bare and covered share.
const MEDIAN: f64 = 0.5;
/// The smallest and the largest random number.
const EXTREMES: [f64; 2] = [f64::EPSILON / 4.0, 1.0 - f64::EPSILON / 2.0];

/// What a model decides for one impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// Mean normal and tangential restitution `e_n` and `e_t` [1] of particles that rebound; `None` where none does.
    pub restitution: Option<[f64; 2]>,
    /// Probability of capture [1], that of covered and bare share together.
    pub sticking_probability: f64,
    /// The most frequent regime.
    pub regime: Regime,
    /// Whether a law or a term is used outside the range that it is stated for.
    pub outside_range: bool,
    /// Whether that matters for the outcome.
    pub beyond: bool,
}

/// The random draws over which a cell is averaged.
pub(super) struct Draws {
    streams: Vec<u64>,
}

impl Draws {
    /// The draws of a model's effects.
    pub fn of(model: &Model) -> Self {
        let mut streams: Vec<u64> = model.terms().iter().filter_map(|term| term.kind().stream).collect();
        streams.sort_unstable();
        streams.dedup();
        Self { streams }
    }

    /// Number of draws.
    pub fn count(&self) -> usize {
        if self.streams.is_empty() { 1 } else { DRAWS_A_CELL }
    }

    /// The mean over all draws. Restitution and regime are those of the share of the wall that an
    /// impact more probably meets, covered or bare; where that share holds every particle,
    /// restitution is that of the other share.
    ///
    /// # Errors
    /// [`ImpactError`] where the model cannot decide the impact.
    pub fn decide(&self, model: &Model, wall: usize, impact: &Impact) -> Result<Cell, ImpactError> {
        let outcomes = self.outcomes(model, wall, impact, MEDIAN)?;
        let mut restitution = mean_rebound(&outcomes);
        for cover in EXTREMES {
            if restitution.is_none() {
                restitution = mean_rebound(&self.outcomes(model, wall, impact, cover)?);
            }
        }
        let mean_probability = outcomes.iter().map(|outcome| outcome.sticking_probability).sum::<f64>();
        Ok(Cell {
            restitution,
            sticking_probability: mean_probability / outcomes.len() as f64,
            regime: model.expect(wall, impact, DRAWS_A_CELL)?.regime,
            outside_range: outcomes.iter().any(|outcome| outcome.outside_range),
            beyond: false,
        })
    }

    /// One outcome a draw; `cover` decides between bare and covered share. With the largest number
    /// for the capture, only a particle that is held with certainty is captured.
    fn outcomes(
        &self,
        model: &Model,
        wall: usize,
        impact: &Impact,
        cover: f64,
    ) -> Result<Vec<Outcome>, ImpactError> {
        let one = |draw: usize| {
            let uniform = |wanted: u64| match wanted {
                stream::COVER => cover,
                stream::CAPTURE => EXTREMES[1],
                _ => self.streams.iter().position(|own| *own == wanted).map_or(MEDIAN, |place| {
                    let step = LATTICE_STEPS[place % LATTICE_STEPS.len()];
                    (((draw * step) % DRAWS_A_CELL) as f64 + 0.5) / DRAWS_A_CELL as f64
                }),
            };
            model.resolve_with(wall, impact, uniform)
        };
        (0..self.count()).map(one).collect()
    }
}

/// Mean `e_n` and `e_t` [1], each draw weighted with its probability of a rebound; `None` where no particle rebounds.
fn mean_rebound(outcomes: &[Outcome]) -> Option<[f64; 2]> {
    let (mut sums, mut weights) = ([0.0; 2], 0.0);
    for outcome in outcomes.iter().filter(|outcome| !outcome.stuck) {
        let weight = 1.0 - outcome.sticking_probability;
        weights += weight;
        sums[0] += weight * outcome.normal_restitution;
        sums[1] += weight * outcome.tangential_restitution;
    }
    (weights > 0.0).then(|| sums.map(|sum| sum / weights))
}
