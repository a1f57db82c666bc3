//! The search among explanations of a rig's readings: the base model with additions.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::super::candidate::{Class, FURTHER};
use super::super::constant_capture::CaptureConstant;
use super::super::explanation::{Evidence, Explained, Explanation, WINDOW};
use super::super::part::Part;
use super::addition::{Kind, RigAddition, keys};
use super::form::RigForm;
use super::noise::{Noise, PreparedReadings, WeightedValues};
use super::prediction_table::{TabledCandidate, TabledPlace, predict};
use super::study::RigStudy;
use nearwall::group::GROUPS;

/// Prior odds of a law for each of its inputs that no experiment changes on purpose [1]: over such an
/// input a law is hardly more than a level.
const UNCHANGED: f64 = 1.0 / 3.0;
/// Fewest candidates of an expansion that are fitted, however little they promise.
const LEAST_FITTED: usize = 3;
/// Ceilings of captures that are tried first [1].
const CEILINGS: [f64; 3] = [0.9, 0.7, 0.4];
/// One cause, and one more for so many readings; and most causes.
const READINGS_A_CAUSE: usize = 3;
const MOST_RIG_CAUSES: usize = 5;

/// Additions, fitted together, and their predictions.
#[derive(Debug, Clone)]
pub(super) struct FittedRig {
    pub additions: Vec<RigAddition>,
    pub prepared: Arc<PreparedReadings>,
}

/// An explanation of a rig's readings.
pub(super) type RigExplanation = Explanation<FittedRig>;

/// The search on experiments with weights, 0 or 1.
pub(super) struct RigSearch<'a> {
    study: &'a RigStudy<'a>,
    weights: &'a [f64],
    evidence: Evidence,
    /// Number of candidates of each class.
    counts: BTreeMap<Class, usize>,
    /// Largest number of additions.
    most: usize,
    /// Explanations of each expansion of which all parameters are fitted together.
    refitted: usize,
    /// Explanations that another search has fitted: places where candidates are looked at, too.
    known: &'a [RigExplanation],
}

impl<'a> RigSearch<'a> {
    pub fn new(
        study: &'a RigStudy<'a>,
        weights: &'a [f64],
        refitted: usize,
        known: &'a [RigExplanation],
    ) -> Self {
        let table = &study.table;
        let mut counts: BTreeMap<Class, usize> = BTreeMap::new();
        // A curve and a form over one input are one candidate.
        let different: BTreeMap<String, Class> =
            table.candidates.iter().map(|one| (one.addition.key(), class(&one.addition))).collect();
        different.into_values().for_each(|class| *counts.entry(class).or_default() += 1);
        // A group is one of all groups, however few a model can compute.
        counts.entry(Class::Group).and_modify(|count| *count = GROUPS.len().max(*count));
        let readings = study.data.count(weights);
        let stated = study.data.readings.iter().all(|one| !matches!(one.noise, Noise::Shared { .. }));
        let base = study.data.score(&table.base_prepared, study.data.values(), weights);
        let evidence = Evidence { base, readings: readings as f64, stated };
        let most = MOST_RIG_CAUSES.min(1 + readings / READINGS_A_CAUSE).min(study.forward.most_causes());
        Self { study, weights, evidence, counts, most, refitted, known }
    }

    /// An explanation with these additions; `None` where the model refuses an impact.
    pub fn explanation(&self, additions: Vec<RigAddition>) -> Option<RigExplanation> {
        let predicted = predict(self.study.forward, &additions).ok()?;
        Some(self.of(additions, Arc::new(self.study.data.prepare(&predicted))))
    }

    fn of(&self, additions: Vec<RigAddition>, prepared: Arc<PreparedReadings>) -> RigExplanation {
        let mut keys = keys(&additions);
        keys.sort_unstable();
        let freedom = additions.iter().map(|one| one.axes.len() as f64).sum();
        let log_prior = additions.iter().enumerate().map(|(place, one)| self.prior(place, one)).sum();
        let scores = self.study.data.shares(&prepared, self.weights);
        Explanation { keys, fitted: FittedRig { additions, prepared }, scores, freedom, log_prior }
    }

    /// Logarithm of the prior probability of an addition beside so many others, over that of none [nats].
    fn prior(&self, others: usize, one: &RigAddition) -> f64 {
        let class = class(one);
        let over = one.variables();
        let idle = self.study.inputs.unchanged().filter(|input| over.iter().any(|own| own == input)).count();
        let count = self.counts.get(&class).copied().unwrap_or(1);
        let shape = one.shape_prior();
        class.log_prior(count) + idle as f64 * UNCHANGED.ln() + others as f64 * FURTHER.ln() + shape
    }

    /// The base model.
    pub fn start(&self) -> RigExplanation {
        self.of(Vec::new(), Arc::clone(&self.study.table.base_prepared))
    }

    /// A candidate at its best place, of the table and of earlier fits.
    fn looked_at(
        &self,
        of: &RigExplanation,
        candidate: &TabledCandidate,
        values: &WeightedValues<'_>,
    ) -> RigExplanation {
        let base = &self.study.table.base_prepared;
        let with = |at: &[f64]| [&of.fitted.additions[..], &[candidate.addition.moved(at)]].concat();
        let score = |prepared: &PreparedReadings| self.study.data.score_weighted(prepared, values);
        let place = |place: &TabledPlace| {
            let prepared = of.fitted.prepared.shifted(base, &place.prepared);
            let fitted = FittedRig { additions: with(&place.at), prepared: Arc::new(prepared) };
            (score(&fitted.prepared), fitted)
        };
        let mut own = keys(&of.fitted.additions);
        own.push(candidate.addition.key());
        let known = self.known.iter().filter(|known| keys(&known.fitted.additions) == own);
        let known = known.map(|known| (score(&known.fitted.prepared), known.fitted.clone()));
        let best = candidate.places.iter().map(place).chain(known).max_by(|a, b| a.0.total_cmp(&b.0));
        best.map_or_else(|| of.clone(), |(_, FittedRig { additions, prepared })| self.of(additions, prepared))
    }

    /// The same with all parameters fitted together; those of the last addition that have a default only where
    /// that has more evidence.
    fn refitted(&self, new: RigExplanation) -> RigExplanation {
        (self.study.progress)(&new.keys.join(" and "));
        let fit = |additions: &[RigAddition]| self.explanation(self.study.fit(additions, self.weights));
        let fitted = fit(&new.fitted.additions);
        let mut best = fitted.filter(|fitted| fitted.score() > new.score()).unwrap_or(new);
        let mut wider = best.fitted.additions.clone();
        while let Some(last) = wider.pop() {
            let Some(freer) = last.with_default_free() else { break };
            wider.push(freer);
            // The simplex begins anew: with a default far off it comes to rest on its way.
            let Some(freed) = fit(&wider).and_then(|once| fit(&once.fitted.additions)) else { break };
            wider.clone_from(&freed.fitted.additions);
            let is_law = !wider.iter().any(RigAddition::at_bound);
            if is_law && self.evidence.of(&freed) > self.evidence.of(&best) {
                best = freed;
            }
        }
        best
    }

    /// The same with the closed form in the place of the last curve or form that has the most evidence, if it has more.
    fn best_form(&self, one: RigExplanation) -> RigExplanation {
        let additions = &one.fitted.additions;
        let open =
            additions.iter().map(RigAddition::closed_forms).enumerate().rfind(|(_, all)| !all.is_empty());
        let Some((place, forms)) = open else { return one };
        let with = |form: RigAddition| {
            let mut additions = additions.clone();
            additions[place] = form;
            self.explanation(self.study.fit(&additions, self.weights))
        };
        let fitted: Vec<RigExplanation> = forms.into_iter().filter_map(with).collect();
        let name = |one: &RigExplanation| one.fitted.additions[place].as_form().map_or("", RigForm::name);
        let tried = fitted.iter().map(|one| (name(one), self.evidence.of(one))).collect::<Vec<_>>();
        let all = fitted.into_iter().chain([one.clone()]);
        let best = all.max_by(|a, b| self.evidence.of(a).total_cmp(&self.evidence.of(b)));
        let mut best = best.unwrap_or(one);
        if let Kind::Form(form) = &mut best.fitted.additions[place].kind {
            form.tried = tried;
        }
        best
    }

    /// Whether an addition could pay for itself: predictions that equal all measured values gain more
    /// than the least that one has to.
    fn has_room(&self, of: &RigExplanation) -> bool {
        let Ok(predicted) = predict(self.study.forward, &of.fitted.additions) else { return false };
        let room = self.study.data.room(&predicted, self.weights);
        self.evidence.gain(of.score() + room, of.freedom + 1.0) > self.evidence.gain(of.score(), of.freedom)
    }

    /// Explanations with a ceiling of captures and one more law at most: alone a ceiling changes nothing, and a law that
    /// captures all is refuted by the few that rebound, so that both are fitted together.
    fn with_ceiling(&self, of: &RigExplanation) -> Vec<RigExplanation> {
        let name = CaptureConstant::Ceiling.name();
        let has = |one: &RigExplanation| one.keys.iter().any(|key| key == name);
        if has(of) || !self.study.data.kinds.iter().any(|kind| kind.starts_with("capture")) {
            return Vec::new();
        }
        if self.refitted == 0 {
            let wider = |one: &&RigExplanation| has(one) && of.keys.iter().all(|key| one.keys.contains(key));
            let known = |one: &RigExplanation| {
                self.of(one.fitted.additions.clone(), Arc::clone(&one.fitted.prepared))
            };
            return self.known.iter().filter(wider).map(known).collect();
        }
        let own = &of.fitted.additions;
        let starts = if own.is_empty() {
            self.laws_below_ceilings()
        } else if own.iter().any(|one| class(one) == Class::Law) {
            vec![[&own[..], &[RigAddition::ceiling(CEILINGS[0])]].concat()]
        } else {
            Vec::new()
        };
        let fitted = starts.into_iter().filter_map(|start| self.explanation(start));
        fitted.map(|one| self.refitted(one)).collect()
    }

    /// A ceiling and each of the laws that gain most below one, at their best places of the table.
    fn laws_below_ceilings(&self) -> Vec<Vec<RigAddition>> {
        let data = &self.study.data;
        let values = data.weighted(data.values(), self.weights);
        let best = |law: &TabledCandidate| {
            let places = law.places.iter().flat_map(|place| CEILINGS.map(|share| (place, share)));
            let scored = places.map(|(place, share)| {
                let score = data.score_weighted(&data.below(&place.prepared, share), &values);
                (score, vec![RigAddition::ceiling(share), law.addition.moved(&place.at)])
            });
            scored.max_by(|a, b| a.0.total_cmp(&b.0))
        };
        let laws = self.study.table.candidates.iter().filter(|one| class(&one.addition) == Class::Law);
        let mut laws: Vec<_> = laws.filter_map(best).collect();
        laws.sort_by(|a, b| b.0.total_cmp(&a.0));
        laws.into_iter().take(LEAST_FITTED).map(|(_, start)| start).collect()
    }

    /// All candidates beside an explanation that are not part of it, the most probable first.
    fn beside(&self, of: &RigExplanation) -> Vec<RigExplanation> {
        let others = self.study.table.candidates.iter().filter(|one| !of.keys.contains(&one.addition.key()));
        let values = self.study.data.weighted(self.study.data.values(), self.weights);
        let mut all: Vec<RigExplanation> = others.map(|one| self.looked_at(of, one, &values)).collect();
        all.sort_by(|a, b| self.evidence.of(b).total_cmp(&self.evidence.of(a)));
        all
    }
}

impl Explained for RigSearch<'_> {
    type Fitted = FittedRig;

    fn evidence(&self) -> Evidence {
        self.evidence
    }

    fn effort(&self, _: &RigExplanation) -> usize {
        1
    }

    fn extended(&self, of: &RigExplanation) -> Vec<RigExplanation> {
        if of.fitted.additions.len() >= self.most || !self.has_room(of) {
            return Vec::new();
        }
        let mut all = self.beside(of);
        // What is less probable at first look by more is not worth a fit.
        let least = self.evidence.of(of) - WINDOW;
        let promising = all.iter().take_while(|new| self.evidence.of(new) > least).count();
        let rest = all.split_off(all.len().min(promising.max(LEAST_FITTED).min(self.refitted)));
        let fitted: Vec<RigExplanation> = all.into_iter().map(|new| self.refitted(new)).collect();
        let best = fitted.iter().map(|one| self.evidence.of(one)).fold(f64::NEG_INFINITY, f64::max);
        let is_open = |one: &RigExplanation| self.evidence.of(one) > best - WINDOW;
        let formed = |one: RigExplanation| if is_open(&one) { self.best_form(one) } else { one };
        let mut found: Vec<_> = fitted.into_iter().map(formed).chain(rest).collect();
        found.extend(self.with_ceiling(of));
        found.retain(|new| !new.fitted.additions.iter().any(RigAddition::at_bound));
        found
    }

    fn reduced(&self, of: &RigExplanation, known: &dyn Fn(&[String]) -> bool) -> Vec<RigExplanation> {
        if of.fitted.additions.len() < 2 {
            return Vec::new();
        }
        let without = |place: usize| {
            let mut rest = of.fitted.additions.clone();
            let removed = rest.remove(place).key();
            let keys: Vec<String> = of.keys.iter().filter(|key| **key != removed).cloned().collect();
            if known(&keys) {
                return None;
            }
            self.explanation(self.study.fit(&rest, self.weights))
        };
        (0..of.fitted.additions.len()).filter_map(without).collect()
    }
}

/// What kind of addition it is, for its prior probability.
fn class(addition: &RigAddition) -> Class {
    match &addition.kind {
        Kind::Part(Part::Effect(_)) => Class::Law,
        Kind::Part(Part::LawParameter(_)) => Class::Number,
        Kind::Curve { .. } | Kind::Form(_) => match addition.over() {
            None => Class::Level,
            Some(over) if over.input.is_group() => Class::Group,
            Some(_) => Class::Input,
        },
        Kind::Case { .. } => Class::Case,
        Kind::Ceiling => Class::Noise,
    }
}
