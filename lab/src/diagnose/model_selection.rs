//! Forward selection: in each round the best significant candidate joins the hypothesis, until none is significant.

use super::candidate::{Addition, ScoredCandidate};
use super::candidate_list::surfaces_over;
use super::curve::ColumnCurve;
use super::few_rows::MANY_ROWS;
use super::fitting::CandidateRound;
use super::hypothesis::{Hypothesis, own_inputs};
use super::part::{FittedPart, Part};

/// Largest number of causes.
const MOST_CAUSES: usize = 6;
/// Least gain of a further cause, as a share of the gain of the first one: less is ascribed to inexact laws.
const FURTHER_GAIN: f64 = 0.05;
/// Least gain of any cause [nats]; its significance is tested apart.
const LEAST_CAUSE_GAIN: f64 = 0.5;
/// Causes within this gain are about as good [nats], and a redundant one gains less beside its parameters.
const CLOSE_GAIN: f64 = 3.0;
/// Least share of a curve's gain that a constant offset does not give, if the curve is preferred to an effect.
const OWN_SHARE: f64 = 0.25;
/// A law reaches a free curve if it gains this share of what the curve does.
const LAW_REACH: f64 = 0.75;
/// The same with few readings, which a curve follows too closely.
const FEW_REACH: f64 = 0.5;
/// A law fails if a free surface over its inputs gains this share of what the law does.
const FAILURE: f64 = 0.12;
/// Least such gain [nats].
const LEAST_FAILURE: f64 = 8.0;
/// Least gain of a surface beyond that of a curve over one of its columns, as a share of it and at all [nats].
const INTERACTION: f64 = 0.25;
const LEAST_INTERACTION: f64 = 4.0;
/// Gain and lead in standard errors by which a cause of captures must exceed a constant rate [nats].
const BEYOND_RATE: f64 = 5.0;
const LEAD_OVER_RATE: f64 = 2.5;
/// So many rows allow one further cause, as long as they are few.
const ROWS_A_CAUSE: usize = 12;
/// Least share of the gain of a scatter trend at which a stochastic effect is preferred to the trend.
const STOCHASTIC_SHARE: f64 = 0.85;
/// Lead in standard errors at which one candidate is distinguishable from another (5 %, one-sided).
pub(super) const DISTINGUISHABLE_LEAD: f64 = 1.645;

/// A cause or a calibration that joined the hypothesis.
#[derive(Clone)]
pub(super) struct Discovery {
    pub winner: ScoredCandidate,
    /// The other candidates of its round.
    pub others: Vec<ScoredCandidate>,
    /// p-value of a free surface over the inputs of a law beside the law.
    pub lack_of_fit: Option<f64>,
}

/// The result of the forward selection.
pub(super) struct ForwardSelection<'a> {
    pub hypothesis: Hypothesis<'a>,
    pub discoveries: Vec<Discovery>,
    /// All candidates of the first round: how each alone improves the base model.
    pub first_round: Vec<ScoredCandidate>,
    /// All candidates of the last round, in which nothing significant was left.
    pub last_round: Vec<ScoredCandidate>,
}

/// Extends `base`; `level` is the accepted share of false discoveries, `progress` is called after each candidate.
pub(super) fn select<'a>(
    base: &Hypothesis<'a>,
    level: f64,
    progress: &(dyn Fn() + Sync),
) -> ForwardSelection<'a> {
    let data = base.data;
    let mut hypothesis = base.clone();
    let mut discoveries: Vec<Discovery> = Vec::new();
    let few = data.search.len() < MANY_ROWS;
    let (mut first_round, mut last_round) = (None, Vec::new());
    for _ in 0..2 * MOST_CAUSES {
        hypothesis.fit_scatter(&data.search);
        let scored = CandidateRound::new(&hypothesis).score_all(progress);
        first_round.get_or_insert_with(|| scored.clone());
        let least = LEAST_CAUSE_GAIN.max(FURTHER_GAIN * first_gain(&discoveries));
        let Some(mut winner) = choose(&scored, few, level, least) else {
            last_round = scored;
            break;
        };
        let before = hypothesis.clone();
        join(&mut hypothesis, &mut winner, &mut discoveries);
        let without = || {
            better_without_law(&before, &hypothesis, &scored, &winner, level)
                .or_else(|| better_surface(&before, &hypothesis, &winner, level))
        };
        if let Some(curve) = (!few).then(without).flatten() {
            hypothesis = before;
            winner = curve;
            join(&mut hypothesis, &mut winner, &mut discoveries);
        }
        if winner.addition.is_systematic() {
            let others = scored.into_iter().filter(|c| c.addition.name(data) != winner.addition.name(data));
            let lack_of_fit =
                hypothesis.lack_of_fit().filter(|_| matches!(winner.addition, Addition::Part { .. }));
            discoveries.push(Discovery { others: others.collect(), winner, lack_of_fit });
        }
        remove_redundant(&mut hypothesis, &mut discoveries);
        let most = if few { 1 + data.search.len() / ROWS_A_CAUSE } else { MOST_CAUSES };
        if discoveries.len() >= most.min(MOST_CAUSES) {
            break;
        }
    }
    drop_rate(&mut hypothesis);
    ForwardSelection { hypothesis, discoveries, first_round: first_round.unwrap_or_default(), last_round }
}

/// Drops the constant rate of captures if the causes explain the captures without it.
fn drop_rate(hypothesis: &mut Hypothesis<'_>) {
    if hypothesis.background_capture == 0.0 {
        return;
    }
    let data = hypothesis.data;
    let mut without = Hypothesis { background_capture: 0.0, ..hypothesis.clone() };
    without.fit(&data.search);
    if hypothesis.search_score() - without.search_score() < CLOSE_GAIN {
        without.fit_discrepancy();
        *hypothesis = without;
    }
}

/// Adds a candidate. A surface takes the place of the curves and laws over its columns.
fn join(hypothesis: &mut Hypothesis<'_>, winner: &mut ScoredCandidate, discoveries: &mut Vec<Discovery>) {
    if let Addition::Curve(surface) = &winner.addition
        && surface.form.sides.len() > 1
    {
        let inside = |curve: &ColumnCurve| {
            let sides = &curve.form.sides;
            let own = |side: &(usize, _)| surface.form.sides.iter().any(|other| other.0 == side.0);
            sides.len() == 1 && curve.form.observable == surface.form.observable && sides.iter().all(own)
        };
        let data = hypothesis.data;
        let replaced: Vec<String> = hypothesis
            .curves
            .iter()
            .filter(|curve| inside(curve))
            .map(|curve| curve.form.name(data))
            .collect();
        hypothesis.curves.retain(|curve| !inside(curve));
        let columns = surface.form.columns(data);
        let covered = |part: &FittedPart| {
            let own = own_inputs(part.part.inputs());
            !own.is_empty() && own.iter().all(|input| columns.iter().any(|column| column == input))
        };
        let replaced: Vec<String> = replaced
            .into_iter()
            .chain(hypothesis.parts.iter().filter(|part| covered(part)).map(|part| part.part.name()))
            .collect();
        hypothesis.parts.retain(|part| !covered(part));
        // The surface stands for what they explained, too.
        let is_replaced = |found: &Discovery| replaced.contains(&found.winner.addition.name(data));
        for found in discoveries.iter().filter(|found| is_replaced(found)) {
            winner.p_value = winner.p_value.min(found.winner.p_value);
            winner.q_value = winner.q_value.min(found.winner.q_value);
        }
        discoveries.retain(|found| !is_replaced(found));
    }
    winner.addition.add_to(hypothesis);
    hypothesis.fit_with_discrepancy();
}

/// The curve that takes the place of a law which does not fit: a free surface over the law's inputs gains much more.
fn better_without_law(
    before: &Hypothesis<'_>,
    with: &Hypothesis<'_>,
    scored: &[ScoredCandidate],
    winner: &ScoredCandidate,
    level: f64,
) -> Option<ScoredCandidate> {
    let Addition::Part { part: FittedPart { part: Part::Effect(effect), .. }, .. } = &winner.addition else {
        return None;
    };
    if with.discrepancy_gain() < (FAILURE * winner.gain()).max(LEAST_FAILURE) {
        return None;
    }
    let own = own_inputs(effect.inputs);
    let over_own = |c: &&ScoredCandidate| {
        let Addition::Curve(curve) = &c.addition else { return false };
        let columns = curve.form.columns(before.data);
        columns.len() == 1 && own.contains(&columns[0].as_str())
    };
    let significant = scored.iter().filter(|c| c.q_value <= level && c.own_gain > OWN_SHARE * c.gain());
    best(significant.filter(over_own)).filter(|curve| curve.gain() > winner.gain()).cloned()
}

/// The surface over a law's input and a speed or size that takes the law's place: beside the law
/// the product of both is significant, and the surface alone gains more than the law.
fn better_surface(
    before: &Hypothesis<'_>,
    with: &Hypothesis<'_>,
    winner: &ScoredCandidate,
    level: f64,
) -> Option<ScoredCandidate> {
    let Addition::Part { part: FittedPart { part: Part::Effect(effect), .. }, .. } = &winner.addition else {
        return None;
    };
    let law = with.without_discrepancy();
    let beside = CandidateRound::new(&law).score(&surfaces_over(before, effect.inputs), &|| {});
    let round = CandidateRound::new(before);
    let needed = beside.iter().filter(|surface| surface.q_value <= level);
    let alone = needed.filter_map(|surface| match &surface.addition {
        Addition::Curve(curve) => round.surface_instead(curve, surface),
        _ => None,
    });
    let better = |surface: &ScoredCandidate| surface.gain() > winner.gain() + LEAST_INTERACTION;
    alone.filter(better).max_by(|a, b| a.gain().total_cmp(&b.gain()))
}

/// The candidate that joins, if any is significant.
fn choose(scored: &[ScoredCandidate], few: bool, level: f64, least: f64) -> Option<ScoredCandidate> {
    let significant =
        || scored.iter().filter(|c| c.q_value <= level && c.gain() >= least && !is_weak_surface(c, scored));
    let is_part = |c: &&ScoredCandidate| matches!(c.addition, Addition::Part { .. });
    let parts: Vec<&ScoredCandidate> = significant().filter(is_part).collect();
    let part = simplest_of_best(&parts);
    let curve = best(significant().filter(|c| matches!(c.addition, Addition::Curve(_))));
    let cause = match (part, curve) {
        (Some(part), Some(curve)) if beats(curve, part, few) => Some(curve),
        (part, curve) => part.or(curve),
    };
    let rate = significant().find(|c| matches!(c.addition, Addition::BackgroundCapture(_)));
    let noise = rate.or_else(|| best(significant().filter(|c| !c.addition.is_systematic())));
    let chosen = match (cause, noise) {
        // Captures at a constant rate need no cause: one must explain more than a rate.
        (Some(cause), Some(rate))
            if matches!(rate.addition, Addition::BackgroundCapture(_))
                && (cause.gain() < rate.gain() + BEYOND_RATE || cause.lead(rate) < LEAD_OVER_RATE) =>
        {
            Some(rate)
        }
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
        (best.lead(part) < DISTINGUISHABLE_LEAD || best.addition.at_bound())
            && (part.gain() > 0.9 * best.gain() || best.gain() - part.gain() < CLOSE_GAIN)
    };
    // Another value of a parameter that the model has is simpler than an effect.
    let key = |part: &&&ScoredCandidate| {
        (part.addition.parameters(), !part.addition.is_calibration(), -part.gain())
    };
    parts
        .iter()
        .filter(about_as_good)
        .min_by(|a, b| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal))
        .copied()
}

/// Whether a surface gains little more than a curve over one of its columns.
fn is_weak_surface(one: &ScoredCandidate, scored: &[ScoredCandidate]) -> bool {
    let Addition::Curve(surface) = &one.addition else { return false };
    let side = |other: &&ScoredCandidate| {
        let Addition::Curve(curve) = &other.addition else { return false };
        let inside = |side: &(usize, _)| surface.form.sides.iter().any(|own| own.0 == side.0);
        curve.form.sides.len() == 1
            && curve.form.observable == surface.form.observable
            && curve.form.sides.iter().all(inside)
    };
    let best = best(scored.iter().filter(side)).map_or(0.0, ScoredCandidate::gain).max(0.0);
    surface.form.sides.len() > 1 && one.gain() < best + (INTERACTION * best).max(LEAST_INTERACTION)
}

/// Whether a curve is preferred to a law, which does not reach it.
fn beats(curve: &ScoredCandidate, part: &ScoredCandidate, few: bool) -> bool {
    let level = matches!(&curve.addition, Addition::Curve(one) if one.form.sides.is_empty());
    let own = level || curve.own_gain > OWN_SHARE * curve.gain();
    let reach = if few { FEW_REACH } else { LAW_REACH };
    own && curve.lead(part) > DISTINGUISHABLE_LEAD && part.gain() < reach * curve.gain()
}

/// The gain of the first cause [nats]; 0 before.
fn first_gain(discoveries: &[Discovery]) -> f64 {
    discoveries.iter().find(|d| !d.winner.addition.is_calibration()).map_or(0.0, |d| d.winner.gain())
}

/// Removes parts that a later addition made redundant.
fn remove_redundant(hypothesis: &mut Hypothesis<'_>, discoveries: &mut Vec<Discovery>) {
    let data = hypothesis.data;
    // The newest part has just been found necessary.
    let newest = discoveries.last().is_some_and(|d| matches!(d.winner.addition, Addition::Part { .. }));
    let mut place = 0;
    while place + usize::from(newest) < hypothesis.parts.len() {
        let mut reduced = hypothesis.without_discrepancy();
        let with = reduced.search_score();
        let removed = reduced.parts.remove(place);
        reduced.fit(&data.search);
        let least = (CLOSE_GAIN + removed.at.len() as f64).max(FURTHER_GAIN * first_gain(discoveries));
        if with - reduced.search_score() < least {
            discoveries.retain(|d| d.winner.addition.name(data) != removed.part.name());
            reduced.fit_discrepancy();
            *hypothesis = reduced;
        } else {
            place += 1;
        }
    }
}
