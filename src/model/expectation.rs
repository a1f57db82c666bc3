//! The mean of what a model decides for an impact, over what it draws by chance.
//!
//! The random numbers of the terms form a lattice, which covers the draws more evenly than random
//! numbers do and is denser at both ends, where rare branches and long tails are; each draw has a
//! weight. The share of the wall that is met, covered or bare, is not drawn for a mean: both are
//! evaluated.

use super::Model;
use super::general_wall::Unwatched;
use crate::effect::stream;
use crate::impact::{Impact, ImpactError, Outcome, Regime};
use crate::rng::ImpactRng;

/// What a model predicts for an impact, on average over its random draws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expectation {
    /// Mean `e_n` [1] of the rebounds; where none rebounds, of all draws.
    pub normal_restitution: f64,
    /// Mean `e_t` [1] of the same.
    pub tangential_restitution: f64,
    /// Probability of capture [1].
    pub sticking_probability: f64,
    /// Variances of `e_n` and `e_t` [1] over the draws; 0 for a model without chance.
    pub variances: [f64; 2],
    /// The most frequent regime over the draws, at the share of the wall, covered or bare, that the
    /// impact more probably meets.
    pub regime: Regime,
    /// Whether a law or a term is used outside the range that it is stated for, in any draw.
    pub outside_range: bool,
}

/// Steps of the lattice of draws, one a stream. They are odd, so each stream visits all places.
const STREAM_STEPS: [usize; 5] = [1, 3, 5, 7, 9];

/// The random draws over which a model is averaged.
#[derive(Debug, Clone)]
pub struct DrawLattice {
    streams: Vec<u64>,
    /// The place of each stream in each draw, in 0 to 1, before a rotation.
    places: Vec<[f64; STREAM_STEPS.len()]>,
}

/// A [`DrawLattice`] with a rotation of its own: even by itself and together with others.
pub struct RotatedLattice<'a> {
    lattice: &'a DrawLattice,
    /// Rotation of each stream, by its number.
    rotations: [f64; STREAM_STEPS.len()],
}

impl DrawLattice {
    /// The draws of a model's terms and, if `place`, of the share of the wall that is met: `count`,
    /// or one where nothing is drawn.
    pub fn new(model: &Model, place: bool, count: usize) -> Self {
        let mut streams: Vec<u64> = model.terms().iter().filter_map(|term| term.kind().stream).collect();
        if place {
            streams.push(stream::COVER);
        }
        let count = if streams.is_empty() { 1 } else { count.max(1) };
        let of_draw = |draw| STREAM_STEPS.map(|step| (draw * step % count) as f64 / count as f64);
        Self { streams, places: (0..count).map(of_draw).collect() }
    }

    /// Number of draws.
    pub fn count(&self) -> usize {
        self.places.len()
    }

    /// The lattice with the rotation of a key.
    pub fn rotated(&self, key: u64) -> RotatedLattice<'_> {
        let random = ImpactRng::new(0, key);
        let mut rotations = [0.0; STREAM_STEPS.len()];
        for &stream in &self.streams {
            rotations[stream as usize % STREAM_STEPS.len()] = random.uniform(stream);
        }
        RotatedLattice { lattice: self, rotations }
    }
}

impl RotatedLattice<'_> {
    /// The random number of a stream in a draw.
    pub fn uniform(&self, draw: usize, stream: u64) -> f64 {
        stretched(self.place(draw, stream))
    }

    /// The weight of a draw [1].
    pub fn weight(&self, draw: usize) -> f64 {
        self.lattice.streams.iter().map(|&stream| density(self.place(draw, stream))).product()
    }

    /// The place of a draw, in 0 to 1.
    fn place(&self, draw: usize, stream: u64) -> f64 {
        let which = stream as usize % STREAM_STEPS.len();
        (self.lattice.places[draw][which] + self.rotations[which]).fract()
    }
}

/// Moves places towards both ends, where rare branches and long tails are.
fn stretched(place: f64) -> f64 {
    0.3 * place + 0.7 * place * place * (3.0 - 2.0 * place)
}

/// The part of the unit interval that a stretched place represents: the derivative of [`stretched`].
fn density(place: f64) -> f64 {
    0.3 + 4.2 * place * (1.0 - place)
}

/// Weighted sums over draws.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    weight: f64,
    restitution: [f64; 2],
    squares: [f64; 2],
}

impl Sums {
    fn add(&mut self, weight: f64, outcome: &Outcome) {
        self.weight += weight;
        for (which, e) in [outcome.normal_restitution, outcome.tangential_restitution].into_iter().enumerate()
        {
            self.restitution[which] += weight * e;
            self.squares[which] += weight * e * e;
        }
    }

    /// Means and variances [1].
    fn moments(&self) -> [[f64; 2]; 2] {
        let means = self.restitution.map(|sum| sum / self.weight);
        let variance = |which: usize| (self.squares[which] / self.weight - means[which].powi(2)).max(0.0);
        [means, [variance(0), variance(1)]]
    }
}

impl Model {
    /// What the model predicts for an impact on average, over `draws` draws of what its terms draw
    /// by chance and over covered and bare wall. Without either the outcome is that of
    /// [`Model::resolve`]. Pure: the same input gives the same bits.
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn expect(&self, wall: usize, impact: &Impact, draws: usize) -> Result<Expectation, ImpactError> {
        let single = self.resolve(wall, impact, ImpactRng::default())?;
        let lattice = DrawLattice::new(self, false, draws);
        let covered = self.drawn_cover(wall, impact);
        if lattice.streams.is_empty() && covered.is_none() {
            return Ok(Expectation::of(&single));
        }
        let likelier = covered.map_or(0.5, |share| if share < 0.5 { 0.0 } else { 1.0 });
        // What is met, as the random number that decides it, and its share.
        let places = covered.map_or([(0.5, 1.0), (0.5, 0.0)], |share| [(0.0, 1.0 - share), (1.0, share)]);
        let rotated = lattice.rotated(0);
        let (mut all, mut rebounds) = (Sums::default(), Sums::default());
        let (mut captured, mut outside_range, mut regimes) = (0.0, false, [0.0; Regime::ALL.len()]);
        for draw in 0..lattice.count() {
            for (place, share) in places.into_iter().filter(|(_, share)| *share > 0.0) {
                let uniform =
                    |wanted| if wanted == stream::COVER { place } else { rotated.uniform(draw, wanted) };
                let outcome = self.at_place_met(wall, impact, uniform, &mut Unwatched)?;
                if place == likelier {
                    regimes[outcome.regime as usize] += rotated.weight(draw);
                }
                let weight = share * rotated.weight(draw);
                all.add(weight, &outcome);
                rebounds.add(weight * (1.0 - outcome.sticking_probability), &outcome);
                captured += weight * outcome.sticking_probability;
                outside_range |= outcome.outside_range;
            }
        }
        let [means, variances] = if rebounds.weight > 0.0 { rebounds.moments() } else { all.moments() };
        Ok(Expectation {
            normal_restitution: means[0],
            tangential_restitution: means[1],
            sticking_probability: (captured / all.weight).min(1.0),
            variances,
            regime: most_frequent(regimes),
            outside_range,
        })
    }
}

/// The regime with the largest weight; of equal ones the first.
fn most_frequent(weights: [f64; Regime::ALL.len()]) -> Regime {
    let weight = |regime: Regime| weights[regime as usize];
    Regime::ALL
        .into_iter()
        .fold(Regime::NspNsw, |most, one| if weight(one) > weight(most) { one } else { most })
}

impl Expectation {
    /// Of a model without chance.
    fn of(outcome: &Outcome) -> Self {
        Self {
            normal_restitution: outcome.normal_restitution,
            tangential_restitution: outcome.tangential_restitution,
            sticking_probability: outcome.sticking_probability,
            variances: [0.0; 2],
            regime: outcome.regime,
            outside_range: outcome.outside_range,
        }
    }
}
