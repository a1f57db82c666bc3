//! Instruments beside laws.
//!
//! A law may hide what an instrument does to the readings, and without the law a tilt or a drag seems larger or smaller
//! than it is. So instruments are asked about once more beside the best explanations by laws alone: size of the
//! instrument and parameters of the laws in turn.

use rayon::prelude::*;

use super::candidate::Addition;
use super::data_split::DataSplit;
use super::explanation::Evidence;
use super::ground::{Ground, instrument_prior, read};
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

/// Laws as they are without an instrument, and the size of the instrument that fits best beside them.
struct Pair<'a> {
    laws: usize,
    hypothesis: Hypothesis<'a>,
    other: &'a OtherReading,
    size: f64,
    /// Log evidence [nats].
    worth: f64,
}

/// The pairs of laws and an instrument with the largest evidence; `plain` are the rows of the search as they are.
pub(super) fn instruments_beside_laws(
    visited: &[ImpactExplanation<'_>],
    grounds: &[&Ground],
    plain: &DataSplit,
    evidence: Evidence,
) -> Vec<LawsWithInstrument> {
    let readings = readings(plain);
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
        let pairs = readings.iter().filter(fits).filter_map(|other| {
            let (size, score) = other.best_value(|size| score(plain, other, &hypothesis, size))?;
            let hides_nothing = hides_nothing(&read(plain, other, size)?.data, hypothesis.scatter[0]);
            let worth = evidence.gain(score, hypothesis.freedom() + other.freedom);
            let is_better = score > before || ground.is_rival();
            let hypothesis = hypothesis.clone();
            (is_better && !hides_nothing).then_some(Pair { laws, hypothesis, other, size, worth })
        });
        pairs.collect::<Vec<_>>()
    };
    laws.truncate(LAWS);
    let pairs: Vec<Vec<Pair<'_>>> = laws.into_par_iter().map(pairs_of).collect();
    let mut pairs: Vec<Pair<'_>> = pairs.into_iter().flatten().collect();
    pairs.sort_by(|a, b| b.worth.total_cmp(&a.worth));
    pairs.truncate(FITTED);
    let log_prior = instrument_prior(readings.len());
    let fitted = |pair: Pair<'_>| {
        let (at, size) = in_turn(&pair, plain)?;
        let ground = Ground { log_prior, ..read(plain, pair.other, size)? };
        Some(LawsWithInstrument { laws: pair.laws, at, ground })
    };
    pairs.into_par_iter().filter_map(fitted).collect()
}

/// Whether an instrument leaves out only what lies within the scatter of `e_n`: such a limit says no more than that
/// readings are not negative.
fn hides_nothing(data: &DataSplit, scatter: f64) -> bool {
    let limit = data.search.iter().map(|&row| data.noise[row].visible_from).fold(f64::NEG_INFINITY, f64::max);
    limit > f64::NEG_INFINITY && limit < scatter
}

/// Log likelihood of laws beside an instrument of a size [nats].
fn score(plain: &DataSplit, other: &OtherReading, laws: &Hypothesis<'_>, size: f64) -> Option<f64> {
    let ground = read(plain, other, size)?;
    let here = Hypothesis { data: &ground.data, ..laws.clone() };
    Some(ground.scores(&here).iter().sum())
}

/// Coordinates of the laws' parameters and size of the instrument, fitted in turn.
fn in_turn(pair: &Pair<'_>, plain: &DataSplit) -> Option<(Vec<f64>, f64)> {
    let Pair { hypothesis, other, size, .. } = pair;
    let (mut laws, mut best) = (hypothesis.clone(), (*size, f64::NAN));
    for _ in 0..TURNS {
        let ground = read(plain, other, best.0)?;
        let mut here = Hypothesis { data: &ground.data, ..laws.clone() };
        here.fit(&ground.data.search);
        laws = laws.with_coordinates(&here.coordinates());
        let before = best.0;
        best = other.best_value(|size| score(plain, other, &laws, size))?;
        if best.0 == before {
            break;
        }
    }
    let (size, _) = other.finer(best, |size| score(plain, other, &laws, size));
    Some((laws.coordinates(), size))
}
