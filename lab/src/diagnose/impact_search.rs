//! The search among explanations of measured impacts.
//!
//! An addition is an effect, a number of the base's laws, a level, a curve or surface over columns, a
//! trend of the scatter, or captures at a constant rate; a start is a [`Ground`]. What joins beside
//! a law is measured beside a smooth remainder over that law's inputs, so that an inexact law needs
//! no second cause; a law that pays for its remainder competes with the curve that needs no law.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::candidate::{Addition, Candidate, Class, FURTHER, SAME_CAUSE, ScoredCandidate};
use super::candidate_list::candidates;
use super::constant_capture::CaptureConstant;
use super::curve::ColumnCurve;
use super::data_split::DataSplit;
use super::explanation::{Evidence, Explained, Explanation};
use super::fitting::CandidateRound;
use super::ground::Ground;
use super::hidden_laws::{HiddenLaw, hidden_laws, levels};
use super::hypothesis::Hypothesis;
use super::inexact::{INEXACT, LEAST_LAWS, gains_of_inexact_laws};
use super::likelihood::SMALLEST_SCATTER;
use super::observable::Observable;
use super::part::Part;

/// Effort of an expansion beside an effect with random draws, in that of the base model.
const RANDOM_DRAWS: usize = 5;
/// By so much a surface has more evidence than the curve in its place [nats]: a factor of 20.
const SEEN: f64 = 3.0;

/// An explanation of impacts, fitted.
#[derive(Debug, Clone)]
pub(super) struct FittedImpacts<'a> {
    /// Index of its ground.
    pub ground: usize,
    pub hypothesis: Hypothesis<'a>,
    /// What was added, in this order.
    pub found: Vec<ScoredCandidate>,
}

/// An explanation of impacts.
pub(super) type ImpactExplanation<'a> = Explanation<FittedImpacts<'a>>;

/// The search on some grounds.
pub(super) struct ImpactSearch<'a> {
    grounds: Vec<&'a Ground>,
    evidence: Evidence,
    /// Explanations of each expansion that are fitted together.
    refitted: usize,
    progress: &'a (dyn Fn(&str) + Sync),
}

/// Evidence on the rows of the search.
pub(super) fn evidence(data: &DataSplit) -> Evidence {
    let base = Hypothesis::base(data);
    // Every impact of a class of captures is one.
    let measured = |one: &Observable| {
        let rows = data.search.iter().map(|&row| &data.rows[row]).filter(|row| one.measured(row).is_some());
        rows.map(|row| if *one == Observable::Capture { row.impacts } else { 1.0 }).sum::<f64>()
    };
    let [e_n, e_t, captures] = Observable::ALL.map(|one| measured(&one));
    let rows = base.evaluate(&*data.search, base.offsets());
    let stated = rows.stated_chi_square().is_some() || e_n + e_t == 0.0;
    Evidence { base: base.search_score(), readings: e_n.max(e_t).max(captures), stated }
}

impl<'a> ImpactSearch<'a> {
    pub fn new(
        grounds: Vec<&'a Ground>,
        evidence: Evidence,
        refitted: usize,
        progress: &'a (dyn Fn(&str) + Sync),
    ) -> Self {
        Self { grounds, evidence, refitted, progress }
    }

    /// The base model on every ground that is no noise.
    pub fn starts(&self) -> Vec<ImpactExplanation<'a>> {
        let start = |(place, ground): (usize, &&'a Ground)| {
            let hypothesis = Hypothesis::base(&ground.data);
            let keys = if ground.key.is_empty() { Vec::new() } else { vec![ground.key.clone()] };
            let scores = ground.scores(&hypothesis);
            let freedom = ground.freedom + self.beyond_stated(&hypothesis);
            let fitted = FittedImpacts { ground: place, hypothesis, found: Vec::new() };
            Explanation { keys, fitted, scores, freedom, log_prior: ground.log_prior }
        };
        let is_start = |(place, ground): &(usize, &&Ground)| *place == 0 || ground.is_rival();
        self.grounds.iter().enumerate().filter(is_start).map(start).collect()
    }

    /// Laws with an instrument: the laws of an explanation at coordinates, fitted on the ground of this place.
    pub fn with_instrument(
        &self,
        of: &ImpactExplanation<'a>,
        at: &[f64],
        place: usize,
    ) -> ImpactExplanation<'a> {
        let ground = self.grounds[place];
        let mut new = of.clone();
        new.log_prior += ground.log_prior - self.grounds[of.fitted.ground].log_prior;
        new.keys.retain(|key| *key != ground.key);
        new.keys.push(ground.key.clone());
        new.fitted.ground = place;
        new.fitted.hypothesis = new.fitted.hypothesis.with_coordinates(at);
        new.fitted.hypothesis.data = &ground.data;
        new.fitted.hypothesis.fit_with_discrepancy();
        self.with_or_without_remainder(new)
    }

    /// Number of parameters of a scatter beyond stated errors.
    fn beyond_stated(&self, hypothesis: &Hypothesis<'_>) -> f64 {
        let found = hypothesis.scatter.iter().any(|one| *one > 2.0 * SMALLEST_SCATTER);
        if self.evidence.stated && found { 1.0 } else { 0.0 }
    }

    /// The explanation with a candidate as it was fitted in the round.
    fn beside(&self, of: &ImpactExplanation<'a>, scored: ScoredCandidate) -> ImpactExplanation<'a> {
        let freedom = scored.addition.freedom();
        let share = freedom / of.scores.len().max(1) as f64;
        let more = |(before, gain): (&f64, &f64)| before + gain + share;
        let scores = of.scores.iter().zip(&scored.differences).map(more).collect();
        let mut fitted = of.fitted.clone();
        let mut keys = of.keys.clone();
        keys.push(scored.addition.key(fitted.hypothesis.data));
        scored.addition.add_to(&mut fitted.hypothesis);
        let log_prior = of.log_prior + scored.log_prior;
        fitted.found.push(scored);
        Explanation { keys, fitted, scores, freedom: of.freedom + freedom, log_prior }
    }

    /// The same with all parameters fitted together.
    fn refitted(&self, of: &ImpactExplanation<'a>, mut new: ImpactExplanation<'a>) -> ImpactExplanation<'a> {
        let ground = self.grounds[of.fitted.ground];
        // With random draws a fit of all takes long, and the last addition is fitted.
        if new.fitted.hypothesis.is_stochastic() {
            new.fitted.hypothesis.fit_scatter(&ground.data.search);
            new.fitted.hypothesis.fit_discrepancy();
        } else {
            new.fitted.hypothesis.fit_with_discrepancy();
        }
        if of.fitted.hypothesis.parts.is_empty() {
            return self.with_or_without_remainder(new);
        }
        let before = ground.scores(&of.fitted.hypothesis);
        // Beside the remainder of the earlier laws, or beside its own as well, for which it pays.
        let with = &new.fitted.hypothesis;
        let mut alone = with.clone();
        alone.fit_discrepancy_of(of.fitted.hypothesis.parts.len());
        let paid = (with.discrepancy_freedom - alone.discrepancy_freedom).max(0.0);
        let worth = |scores: &[f64], freedom| self.evidence.gain(scores.iter().sum(), freedom);
        let choices = [(&alone, new.freedom), (with, new.freedom + paid)]
            .map(|(hypothesis, freedom)| (moved(&of.scores, &before, &ground.scores(hypothesis)), freedom));
        for (scores, freedom) in choices {
            if worth(&scores, freedom) > worth(&new.scores, new.freedom) {
                (new.scores, new.freedom) = (scores, freedom);
            }
        }
        new
    }

    /// The scores of an explanation by its laws alone, or with the remainder if this pays for its parameters.
    fn with_or_without_remainder(&self, mut new: ImpactExplanation<'a>) -> ImpactExplanation<'a> {
        let ground = self.grounds[new.fitted.ground];
        let hypothesis = &new.fitted.hypothesis;
        let own = ground.freedom + hypothesis.freedom() + self.beyond_stated(hypothesis);
        let alone = ground.scores(&hypothesis.without_discrepancy());
        let with = ground.scores(hypothesis);
        let all = own + hypothesis.discrepancy_freedom;
        let worth = |scores: &[f64], freedom| self.evidence.gain(scores.iter().sum(), freedom);
        (new.scores, new.freedom) =
            if worth(&with, all) > worth(&alone, own) { (with, all) } else { (alone, own) };
        new
    }

    /// The explanation with a ceiling of captures and each of the laws that gain most, fitted together: few
    /// rebounds refute a law that captures all, so that it would not be pursued alone.
    fn below_ceiling(
        &self,
        of: &ImpactExplanation<'a>,
        scored: &[ScoredCandidate],
        prior: &(dyn Fn(Class, usize) -> f64 + Sync),
    ) -> Vec<ImpactExplanation<'a>> {
        let mut laws: Vec<(f64, Candidate)> = scored.iter().filter_map(ScoredCandidate::plain_law).collect();
        laws.sort_by(|a, b| b.0.total_cmp(&a.0));
        let laws: Vec<Candidate> = laws.into_iter().take(self.refitted).map(|(_, law)| law).collect();
        let hypothesis = &of.fitted.hypothesis;
        let before = self.grounds[of.fitted.ground].scores(hypothesis);
        let all = hypothesis.captures.free();
        let addition =
            Addition::Captures { constant: CaptureConstant::Ceiling, all, others: hypothesis.parts.clone() };
        let bare = Hypothesis { captures: all, ..hypothesis.clone() };
        let after = self.grounds[of.fitted.ground].scores(&bare);
        let share = 1.0 / before.len().max(1) as f64;
        let differences = after.iter().zip(&before).map(|(after, before)| after - before - share).collect();
        let ceiling = ScoredCandidate::unproven(addition, differences, prior(Class::Noise, 0));
        let below = self.beside(of, ceiling);
        let round = CandidateRound::new(&below.fitted.hypothesis);
        let inside = round.score(&laws, &|_| ()).into_par_iter().filter(|one| !one.addition.at_bound());
        let with = inside.map(|one| {
            let log_prior = prior(one.addition.class(hypothesis.data), 1);
            self.refitted(&below, self.beside(&below, ScoredCandidate { log_prior, ..one }))
        });
        with.collect()
    }

    /// Explanations, the one with most evidence first.
    fn best_first(&self, mut all: Vec<ImpactExplanation<'a>>) -> Vec<ImpactExplanation<'a>> {
        all.sort_by(|a, b| self.evidence.of(b).total_cmp(&self.evidence.of(a)));
        all
    }

    /// The explanation without what was added in this place, fitted anew.
    fn without(&self, of: &ImpactExplanation<'a>, place: usize) -> ImpactExplanation<'a> {
        let mut new = Explanation { keys: keys_without(of, place), ..of.clone() };
        let ScoredCandidate { addition: removed, log_prior, .. } = new.fitted.found.remove(place);
        remove(&mut new.fitted.hypothesis, &removed);
        new.log_prior -= log_prior;
        new.fitted.hypothesis.fit_with_discrepancy();
        self.with_or_without_remainder(new)
    }

    /// Surfaces in the place of a curve over one of their columns: beside the curve they gain little.
    fn with_surfaces(
        &self,
        of: &ImpactExplanation<'a>,
        list: &[Candidate],
        prior: &(dyn Fn(Class, usize) -> f64 + Sync),
    ) -> Vec<ImpactExplanation<'a>> {
        let in_place = |place: usize| {
            let surfaces: Vec<Candidate> = match &of.fitted.found[place].addition {
                Addition::Curve(curve) => {
                    list.iter().copied().filter(|one| one.is_surface_over(&curve.form)).collect()
                }
                _ => Vec::new(),
            };
            if surfaces.is_empty() {
                return Vec::new();
            }
            let before = self.without(of, place);
            let scored = CandidateRound::new(&before.fitted.hypothesis).score(&surfaces, &|_| ());
            let beside = |one: ScoredCandidate| {
                let log_prior = prior(one.addition.class(before.fitted.hypothesis.data), 0);
                self.beside(&before, ScoredCandidate { log_prior, ..one })
            };
            let mut all = self.best_first(scored.into_iter().map(beside).collect());
            all.truncate(self.refitted);
            // A product with a column that hardly varies is the curve once more: the interplay has to be seen.
            let is_seen = |new: &ImpactExplanation<'a>| self.evidence.of(new) > self.evidence.of(of) + SEEN;
            let all = all.into_par_iter().map(|new| self.refitted(&before, new));
            all.filter(is_seen).collect::<Vec<_>>()
        };
        (0..of.fitted.found.len()).flat_map(in_place).collect()
    }

    /// Laws with a level of `e_n` or `e_t` that adds or multiplies, fitted together: a law takes on a level as far as
    /// it can, so that the level gains nothing beside the law as it is; and a level may hide a law.
    fn with_levels(
        &self,
        of: &ImpactExplanation<'a>,
        list: &[Candidate],
        prior: &(dyn Fn(Class, usize) -> f64 + Sync),
    ) -> Vec<ImpactExplanation<'a>> {
        let hypothesis = &of.fitted.hypothesis;
        let (levels, is_base) = (levels(list), of.fitted.found.is_empty());
        let has_laws = !hypothesis.parts.is_empty() && !hypothesis.is_stochastic();
        if !(is_base || has_laws) || self.has_shared_errors(of, &levels) {
            return Vec::new();
        }
        let share = 1.0 / of.scores.len().max(1) as f64;
        let unproven = |addition: Addition, joined: usize| {
            let prior = prior(addition.class(hypothesis.data), joined);
            let differences = vec![-share * addition.freedom(); of.scores.len()];
            ScoredCandidate::unproven(addition, differences, prior)
        };
        if has_laws {
            let with = |level| self.refitted(of, self.beside(of, unproven(Addition::Curve(level), 0)));
            return levels.into_par_iter().map(with).collect();
        }
        let with = |HiddenLaw { law, level, .. }| {
            let law = self.beside(of, unproven(Addition::Part { part: law, others: Vec::new() }, 0));
            self.refitted(of, self.beside(&law, unproven(Addition::Curve(level), 1)))
        };
        hidden_laws(hypothesis, list, &levels, self.refitted).into_par_iter().map(with).collect()
    }

    /// Whether errors that groups share explain more than independent ones beside a level: their mean looks like one.
    fn has_shared_errors(&self, of: &ImpactExplanation<'a>, levels: &[ColumnCurve]) -> bool {
        let mut centred = of.fitted.hypothesis.clone();
        for level in levels.iter().filter(|level| !level.form.multiplicative) {
            let rows = centred.evaluate(&*centred.data.search, centred.offsets()).with_fitted_scatter();
            centred.curves.extend(level.again(&rows));
        }
        let evidence = |ground: &Ground| {
            let hypothesis = Hypothesis { data: &ground.data, ..centred.clone() };
            self.evidence.gain(ground.scores(&hypothesis).iter().sum(), ground.freedom)
        };
        let plain = evidence(self.grounds[0]);
        self.grounds.iter().any(|ground| ground.key.starts_with("groups:") && evidence(ground) > plain)
    }

    /// The explanation with errors that groups share.
    fn grouped(&self, of: &ImpactExplanation<'a>) -> Vec<ImpactExplanation<'a>> {
        if of.fitted.ground != 0 {
            return Vec::new();
        }
        let noise = self.grounds.iter().enumerate().filter(|(place, one)| *place > 0 && !one.is_rival());
        // Variants of one noise share its prior probability.
        let count = noise.clone().map(|(_, ground)| ground.log_prior.exp()).sum::<f64>().round() as usize;
        let before = self.grounds[0].scores(&of.fitted.hypothesis);
        let on = |(place, ground): (usize, &&'a Ground)| {
            let mut new = of.clone();
            new.keys.push(ground.key.clone());
            new.fitted.ground = place;
            new.fitted.hypothesis.data = &ground.data;
            new.fitted.hypothesis.fit_scatter(&ground.data.search);
            new.scores = moved(&of.scores, &before, &ground.scores(&new.fitted.hypothesis));
            new.freedom += ground.freedom;
            new.log_prior += ground.log_prior + Class::Noise.log_prior(count);
            new
        };
        noise.map(on).collect()
    }
}

impl<'a> Explained for ImpactSearch<'a> {
    type Fitted = FittedImpacts<'a>;

    fn evidence(&self) -> Evidence {
        self.evidence
    }

    fn effort(&self, of: &ImpactExplanation<'a>) -> usize {
        if of.fitted.hypothesis.is_stochastic() { RANDOM_DRAWS } else { 1 }
    }

    fn extended(&self, of: &ImpactExplanation<'a>) -> Vec<ImpactExplanation<'a>> {
        if !self.grounds[of.fitted.ground].open || is_twin(of) {
            return Vec::new();
        }
        let hypothesis = &of.fitted.hypothesis;
        let round = CandidateRound::new(hypothesis);
        let list = candidates(hypothesis, round.is_few());
        let mut counts: BTreeMap<Class, usize> = BTreeMap::new();
        list.iter().for_each(|one| *counts.entry(one.class(hypothesis.data)).or_default() += 1);
        let prior = |class: Class, joined: usize| {
            let further = (of.fitted.found.len() + joined) as f64 * FURTHER.ln();
            class.log_prior(counts.get(&class).copied().unwrap_or(1)) + further
        };
        let scored = round.score(&list, self.progress);
        let is_ceiling = |one: &Candidate| matches!(one, Candidate::Captures(CaptureConstant::Ceiling));
        let below =
            if list.iter().any(is_ceiling) { self.below_ceiling(of, &scored, &prior) } else { Vec::new() };
        let inside = scored.into_iter().filter(|one| !one.addition.at_bound());
        let is_known = |one: &ScoredCandidate| {
            let name = one.addition.name(hypothesis.data);
            of.fitted.found.iter().any(|found| found.addition.name(hypothesis.data) == name)
        };
        let beside = inside.map(|one| {
            let class = one.addition.class(hypothesis.data);
            let cause = if is_known(&one) { SAME_CAUSE.ln() } else { prior(class, 0) };
            let log_prior = cause + one.addition.shape_prior();
            self.beside(of, ScoredCandidate { log_prior, ..one })
        });
        let mut all = self.best_first(beside.collect());
        let rest = all.split_off(all.len().min(self.refitted));
        let mut found: Vec<_> = all.into_par_iter().map(|new| self.refitted(of, new)).collect();
        found.extend(below.into_iter().chain(rest));
        found.extend(self.with_levels(of, &list, &prior));
        found.extend(self.with_surfaces(of, &list, &prior));
        found.retain(|new| !new.fitted.hypothesis.at_bound());
        found.extend(found.iter().filter_map(inexact).collect::<Vec<_>>());
        found.extend(self.grouped(of));
        found
    }

    fn reduced(
        &self,
        of: &ImpactExplanation<'a>,
        known: &dyn Fn(&[String]) -> bool,
    ) -> Vec<ImpactExplanation<'a>> {
        if of.fitted.found.len() < 2 || is_twin(of) {
            return Vec::new();
        }
        let places: Vec<usize> =
            (0..of.fitted.found.len()).filter(|place| !known(&keys_without(of, *place))).collect();
        places.into_par_iter().map(|place| self.without(of, place)).collect()
    }
}

/// The keys of an explanation without that of what was added in this place.
fn keys_without(of: &ImpactExplanation<'_>, place: usize) -> Vec<String> {
    let removed = of.fitted.found[place].addition.key(of.fitted.hypothesis.data);
    of.keys.iter().filter(|own| **own != removed).cloned().collect()
}

/// Scores with what others gain from before to after [nats].
fn moved(scores: &[f64], before: &[f64], after: &[f64]) -> Vec<f64> {
    let changes = before.iter().zip(after);
    scores.iter().zip(changes).map(|(own, (before, after))| own + (after - before)).collect()
}

/// Whether it is a twin of [`inexact`], beside which nothing else is looked for.
fn is_twin(of: &ImpactExplanation<'_>) -> bool {
    of.keys.iter().any(|key| key == INEXACT)
}

/// The twin of an explanation with a level beside several laws, in which these are not exact; `None` for others.
fn inexact<'a>(of: &ImpactExplanation<'a>) -> Option<ImpactExplanation<'a>> {
    let is_level =
        |one: &ScoredCandidate| matches!(&one.addition, Addition::Curve(curve) if curve.is_level());
    let hypothesis = of.fitted.hypothesis.without_discrepancy();
    let laws = hypothesis.parts.iter().filter(|part| matches!(part.part, Part::Effect(_))).count();
    let place = of.fitted.found.iter().position(is_level)?;
    if laws < LEAST_LAWS || hypothesis.is_stochastic() {
        return None;
    }
    let mut twin = of.clone();
    let level = twin.fitted.found.remove(place).addition;
    let key = level.key(hypothesis.data);
    twin.keys.retain(|own| *own != key);
    twin.keys.push(INEXACT.to_owned());
    remove(&mut twin.fitted.hypothesis, &level);
    let gains = gains_of_inexact_laws(&hypothesis, &twin.fitted.hypothesis.without_discrepancy());
    twin.scores.iter_mut().zip(gains).for_each(|(score, gain)| *score += gain);
    Some(twin)
}

/// Removes an addition from a hypothesis.
fn remove(hypothesis: &mut Hypothesis<'_>, addition: &Addition) {
    match addition {
        Addition::Part { part, .. } => {
            let name = part.part.name();
            hypothesis.parts.retain(|own| own.part.name() != name);
        }
        Addition::Curve(curve) => hypothesis.remove_curve(curve),
        Addition::ScatterTrend(trend) => {
            hypothesis.scatter_trends.retain(|own| own.covariate != trend.covariate);
        }
        Addition::Captures { constant, .. } => hypothesis.captures = hypothesis.captures.without(*constant),
    }
}
