//! Forward selection: in each round the best significant candidate joins the hypothesis, until none is significant.

use super::candidate::{Addition, ScoredCandidate};
use super::cross_validation::Round;
use super::hypothesis::Hypothesis;
use crate::effect::EFFECTS;

/// Largest number of causes.
const MOST_CAUSES: usize = 6;
/// Least gain of a further cause, as a share of the gain of the first one: less is ascribed to inexact laws.
const FURTHER_GAIN: f64 = 0.05;
/// Least gain of any cause [nats].
const LEAST_GAIN: f64 = 3.0;
/// Least share of a curve's gain that a constant offset does not give, if the curve is preferred to an effect.
const OWN_SHARE: f64 = 0.25;
/// An effect that gains this share of what a curve over an input does is preferred to the curve.
const ENOUGH: f64 = 0.1;
/// Least share of the gain of a scatter trend at which a stochastic effect is preferred to the trend.
const STOCHASTIC_SHARE: f64 = 0.85;
/// Lead in standard errors at which one candidate is distinguishable from another (5 %, one-sided).
pub(super) const DISTINGUISHABLE: f64 = 1.645;

/// A cause or a calibration that joined the hypothesis.
pub(super) struct Discovery {
    pub winner: ScoredCandidate,
    /// The other candidates of its round.
    pub others: Vec<ScoredCandidate>,
}

/// The result of the forward selection.
pub(super) struct Selection<'a> {
    pub hypothesis: Hypothesis<'a>,
    pub discoveries: Vec<Discovery>,
    /// All candidates of the first round: how each alone improves the base model.
    pub first_round: Vec<ScoredCandidate>,
}

/// Extends `base`; `level` is the accepted share of false discoveries, `progress` is called after each candidate.
pub(super) fn select<'a>(base: &Hypothesis<'a>, level: f64, progress: &(dyn Fn() + Sync)) -> Selection<'a> {
    let data = base.data;
    let mut hypothesis = base.clone();
    let mut discoveries: Vec<Discovery> = Vec::new();
    let mut first_round = None;
    for _ in 0..2 * MOST_CAUSES {
        hypothesis.fit_scatter(&data.search);
        let scored = Round::new(&hypothesis).score_candidates(progress);
        first_round.get_or_insert_with(|| scored.clone());
        let least = LEAST_GAIN.max(FURTHER_GAIN * first_gain(&discoveries));
        let Some(winner) = choose(&hypothesis, &scored, level, least) else { break };
        winner.addition.add_to(&mut hypothesis);
        hypothesis.fit_with_discrepancy();
        if winner.addition.is_systematic() {
            let others = scored.into_iter().filter(|c| c.addition.name(data) != winner.addition.name(data));
            discoveries.push(Discovery { others: others.collect(), winner });
        }
        remove_redundant(&mut hypothesis, &mut discoveries);
        if discoveries.len() >= MOST_CAUSES {
            break;
        }
    }
    Selection { hypothesis, discoveries, first_round: first_round.unwrap_or_default() }
}

/// The candidate that joins, if any is significant.
fn choose(
    hypothesis: &Hypothesis<'_>,
    scored: &[ScoredCandidate],
    level: f64,
    least: f64,
) -> Option<ScoredCandidate> {
    let significant = || scored.iter().filter(|c| c.q_value <= level && c.gain() >= least);
    let is_part = |c: &&ScoredCandidate| matches!(c.addition, Addition::Part { .. });
    let parts: Vec<&ScoredCandidate> = significant().filter(is_part).collect();
    let part = simplest_of_best(&parts);
    let curve = best(significant().filter(|c| is_open_curve(hypothesis, c, &parts)));
    let cause = match (part, curve) {
        (Some(part), Some(curve))
            if curve.lead(part) > DISTINGUISHABLE && curve.own_gain > OWN_SHARE * curve.gain() =>
        {
            Some(curve)
        }
        (part, curve) => part.or(curve),
    };
    let noise = best(significant().filter(|c| !c.addition.is_systematic()));
    let chosen = match (cause, noise) {
        (Some(cause), Some(noise)) => {
            // A stochastic effect makes scatter; a trend of the noise has to be clearly better.
            let stochastic =
                matches!(&cause.addition, Addition::Part { part, .. } if part.part.is_stochastic());
            let share = if stochastic { STOCHASTIC_SHARE } else { 1.0 };
            Some(if cause.gain() >= share * noise.gain() { cause } else { noise })
        }
        (cause, noise) => cause.or(noise),
    };
    chosen.cloned()
}

fn best<'a>(scored: impl Iterator<Item = &'a ScoredCandidate>) -> Option<&'a ScoredCandidate> {
    scored.max_by(|a, b| a.gain().total_cmp(&b.gain()))
}

/// Among parts that are about as good as the best, the one with the fewest parameters.
fn simplest_of_best<'a>(parts: &[&'a ScoredCandidate]) -> Option<&'a ScoredCandidate> {
    let best = best(parts.iter().copied())?;
    let about_as_good = |part: &&&ScoredCandidate| {
        (best.lead(part) < DISTINGUISHABLE || best.addition.at_bound())
            && (part.gain() > 0.9 * best.gain() || best.gain() - part.gain() < LEAST_GAIN)
    };
    let key = |part: &&&ScoredCandidate| (part.addition.parameters(), -part.gain());
    parts
        .iter()
        .filter(about_as_good)
        .min_by(|a, b| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal))
        .copied()
}

/// Whether this is a curve that need not wait for effects. A curve over an input waits while some effect depends on the
/// input and some part gains enough: several causes together may shape the residuals over one input.
fn is_open_curve(hypothesis: &Hypothesis<'_>, scored: &ScoredCandidate, parts: &[&ScoredCandidate]) -> bool {
    let Addition::Curve(curve) = &scored.addition else { return false };
    let column = &hypothesis.data.covariates[curve.form.covariate];
    let has_effect = EFFECTS.iter().any(|effect| effect.inputs.contains(&column.name.as_str()));
    !(column.input && has_effect && parts.iter().any(|part| part.gain() > ENOUGH * scored.gain()))
}

/// The gain of the first cause [nats]; 0 before.
fn first_gain(discoveries: &[Discovery]) -> f64 {
    discoveries.iter().find(|d| !d.winner.addition.is_calibration()).map_or(0.0, |d| d.winner.gain())
}

/// Removes parts that a later one made redundant.
fn remove_redundant(hypothesis: &mut Hypothesis<'_>, discoveries: &mut Vec<Discovery>) {
    let data = hypothesis.data;
    let score = |h: &Hypothesis<'_>| h.evaluate(&data.search, h.offsets()).with_fitted_scatter().score();
    let mut place = 0;
    while place + 1 < hypothesis.parts.len() {
        let mut reduced = Hypothesis { discrepancy: None, ..hypothesis.clone() };
        let with = score(&reduced);
        let removed = reduced.parts.remove(place);
        reduced.fit(&data.search);
        let least = (LEAST_GAIN + removed.at.len() as f64).max(FURTHER_GAIN * first_gain(discoveries));
        if with - score(&reduced) < least {
            discoveries.retain(|d| d.winner.addition.name(data) != removed.part.name());
            reduced.fit_discrepancy();
            *hypothesis = reduced;
        } else {
            place += 1;
        }
    }
}
