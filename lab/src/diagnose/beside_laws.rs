//! Instruments beside laws.
//!
//! A law may hide what an instrument does to the readings, and without the law a tilt or a drag seems larger or smaller
//! than it is. So instruments are asked about once more beside the best explanations by laws alone: size of the
//! instrument and parameters of the laws in turn.

use rayon::prelude::*;

use super::candidate::{Addition, Class};
use super::data_split::DataSplit;
use super::explanation::Evidence;
use super::ground::{Ground, read};
use super::hypothesis::Hypothesis;
use super::impact_search::ImpactExplanation;
use super::reading::{OtherReading, readings};

/// Explanations by laws beside which instruments are asked about.
const LAWS: usize = 4;
/// Pairs of laws and an instrument that are fitted.
const FITTED: usize = 3;
/// Largest number of times that size and parameters are fitted in turn.
const TURNS: usize = 3;

/// Laws with an instrument.
pub(super) struct LawsWithInstrument {
    /// The place of the laws' explanation among those that were visited.
    pub laws: usize,
    /// Coordinates of the laws' parameters.
    pub at: Vec<f64>,
    /// The rows as the instrument has them.
    pub ground: Ground,
}

/// Laws and an instrument whose size is not fitted yet.
struct Pair<'a> {
    laws: usize,
    hypothesis: Hypothesis<'a>,
    other: &'a OtherReading,
    /// Log likelihood with the best size of the instrument beside the laws as they are [nats].
    score: f64,
    freedom: f64,
}

/// The pairs of laws and an instrument with the largest evidence; `plain` are the rows as they are.
pub(super) fn instruments_beside_laws(
    visited: &[ImpactExplanation<'_>],
    grounds: &[&Ground],
    plain: &DataSplit,
    evidence: Evidence,
) -> Vec<LawsWithInstrument> {
    let readings = readings(plain);
    let searched = plain.searched();
    let is_by_laws = |one: &ImpactExplanation<'_>| {
        let found = &one.fitted.found;
        let are_laws = found.iter().all(|one| matches!(one.addition, Addition::Part { .. }));
        !found.is_empty() && are_laws && !one.fitted.hypothesis.is_stochastic()
    };
    let mut laws: Vec<usize> = (0..visited.len()).filter(|place| is_by_laws(&visited[*place])).collect();
    laws.sort_by(|a, b| evidence.of(&visited[*b]).total_cmp(&evidence.of(&visited[*a])));
    let pairs_of = |laws: usize| {
        let one = &visited[laws];
        let (ground, hypothesis) = (grounds[one.fitted.ground], one.fitted.hypothesis.without_discrepancy());
        let before: f64 = ground.scores(&hypothesis).iter().sum();
        // On a rival's ground its size alone is fitted anew.
        let fits = |other: &&OtherReading| ground.key.is_empty() || ground.key == other.id;
        let pair = |other| {
            let (score, size) = best_size(&searched, other, &hypothesis, other.values.clone())?;
            if hides_nothing(&read(&searched, other, size)?.data, hypothesis.scatter[0]) {
                return None;
            }
            let freedom = hypothesis.freedom() + other.freedom;
            let hypothesis = hypothesis.clone();
            (score > before || ground.is_rival()).then_some(Pair { laws, hypothesis, other, score, freedom })
        };
        readings.iter().filter(fits).filter_map(pair).collect::<Vec<_>>()
    };
    laws.truncate(LAWS);
    let pairs: Vec<Vec<Pair<'_>>> = laws.into_par_iter().map(pairs_of).collect();
    let mut pairs: Vec<Pair<'_>> = pairs.into_iter().flatten().collect();
    let worth = |pair: &Pair<'_>| evidence.gain(pair.score, pair.freedom);
    pairs.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
    let log_prior = Class::Rival.log_prior(readings.len() + 1);
    let fitted = |pair: Pair<'_>| {
        let (at, size) = in_turn(&pair, &searched)?;
        let ground = Ground { log_prior, ..read(plain, pair.other, size)? };
        Some(LawsWithInstrument { laws: pair.laws, at, ground })
    };
    pairs.truncate(FITTED);
    pairs.into_par_iter().filter_map(fitted).collect()
}

/// Whether all that an instrument does not see lies within the scatter of `e_n`: a law explains more there if readings
/// cannot be negative, whatever is seen.
fn hides_nothing(data: &DataSplit, scatter: f64) -> bool {
    let limit = data.search.iter().map(|&row| data.noise[row].visible_from).fold(f64::NEG_INFINITY, f64::max);
    limit > f64::NEG_INFINITY && limit < scatter
}

/// The size of an instrument among these at which the laws as they are have the largest log likelihood [nats].
fn best_size(
    searched: &DataSplit,
    other: &OtherReading,
    laws: &Hypothesis<'_>,
    sizes: Vec<f64>,
) -> Option<(f64, f64)> {
    let scored = sizes.into_iter().filter_map(|size| {
        let ground = read(searched, other, size)?;
        let here = Hypothesis { data: &ground.data, ..laws.clone() };
        Some((ground.scores(&here).iter().sum::<f64>(), size))
    });
    scored.filter(|(score, _)| score.is_finite()).max_by(|a, b| a.0.total_cmp(&b.0))
}

/// Coordinates of the laws' parameters and size of the instrument, fitted in turn.
fn in_turn(pair: &Pair<'_>, searched: &DataSplit) -> Option<(Vec<f64>, f64)> {
    let Pair { hypothesis, other, .. } = pair;
    let best = |laws: &Hypothesis<'_>| best_size(searched, other, laws, other.values.clone());
    let (mut laws, mut size) = (hypothesis.clone(), best(hypothesis)?.1);
    for _ in 0..TURNS {
        let ground = read(searched, other, size)?;
        let mut here = Hypothesis { data: &ground.data, ..laws.clone() };
        here.fit(&ground.data.search);
        laws = laws.with_coordinates(&here.coordinates());
        let next = best(&laws)?.1;
        if next == size {
            break;
        }
        size = next;
    }
    let [coarse, fine] = [vec![size], other.near(size)].map(|sizes| best_size(searched, other, &laws, sizes));
    let finer = fine.filter(|fine| coarse.is_none_or(|coarse| fine.0 > coarse.0));
    Some((laws.coordinates(), finer.map_or(size, |finer| finer.1)))
}
