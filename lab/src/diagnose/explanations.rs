//! Explanations with their probabilities: what is named, what is left open, and what stands in its stead.

use std::collections::BTreeSet;

use super::constants::{LISTED, NAMED};
use super::explanation::{Evidence, Explanation};
use super::probability::Probabilities;
use super::record::{Alternative, ExplanationFound, Rival};

/// Largest number of alternatives, and of undecided causes, that are listed.
const ALTERNATIVES: usize = 6;

/// What an explanation says, without its data.
#[derive(Debug, Clone)]
pub(super) struct Told<A> {
    /// Ids of its causes and of its rival, in alphabetical order; none for the base model as it is.
    pub causes: Vec<String>,
    /// Its additions, in the order in which they joined.
    pub additions: Vec<A>,
    /// Id and question of another reading of the data.
    pub rival: Option<(String, String)>,
}

/// An explanation with its probability.
#[derive(Debug, Clone)]
pub(super) struct FoundExplanation<A> {
    pub told: Told<A>,
    /// Its place among those that the search visited.
    pub place: usize,
    /// Probability of it [1].
    pub probability: f64,
    /// Share of the draws in which it is the most likely one [1].
    first: f64,
    /// Gain in log likelihood over the base model, less its number of parameters [nats].
    pub gain: f64,
}

impl<A> FoundExplanation<A> {
    /// Whether a cause or a rival takes part.
    pub fn has(&self, cause: &str) -> bool {
        self.told.causes.iter().any(|own| own == cause)
    }

    /// Whether it is physics rather than another reading of the data.
    pub fn is_physics(&self) -> bool {
        self.told.rival.is_none()
    }
}

/// What a search visited, the most probable first.
#[derive(Debug, Clone)]
pub(super) struct Explanations<A>(Vec<FoundExplanation<A>>);

impl<A: Clone> Explanations<A> {
    /// Those that a search visited; `units` has the independent unit of each score.
    pub fn new<F>(
        visited: &[Explanation<F>],
        evidence: Evidence,
        units: &[usize],
        tell: impl Fn(&Explanation<F>) -> Told<A>,
    ) -> Self {
        let probabilities = Probabilities::new(visited, evidence, units);
        let found = |(place, one): (usize, &Explanation<F>)| FoundExplanation {
            told: tell(one),
            place,
            probability: probabilities.of[place],
            first: probabilities.first[place],
            gain: one.score() - evidence.base - one.freedom,
        };
        let mut all: Vec<FoundExplanation<A>> = visited.iter().enumerate().map(found).collect();
        all.sort_by(|a, b| b.probability.total_cmp(&a.probability));
        Self(all)
    }

    /// All, the most probable first.
    pub fn all(&self) -> &[FoundExplanation<A>] {
        &self.0
    }

    /// The most probable one.
    pub fn best(&self) -> Option<&FoundExplanation<A>> {
        self.0.first()
    }

    /// The additions of the most probable one.
    pub fn best_additions(&self) -> &[A] {
        self.best().map_or(&[], |best| best.told.additions.as_slice())
    }

    /// Probability that a cause or a rival takes part [1].
    pub fn probability(&self, cause: &str) -> f64 {
        self.0.iter().filter(|one| one.has(cause)).map(|one| one.probability).sum()
    }

    /// Probability that any of these causes takes part [1].
    pub fn probability_of_any(&self, names: &[String]) -> f64 {
        let any = self.0.iter().filter(|one| names.iter().any(|name| one.has(name)));
        any.map(|one| one.probability).sum()
    }

    /// Share of the draws in which an explanation with this cause is the most likely one [1].
    pub fn certainty(&self, cause: &str) -> f64 {
        self.0.iter().filter(|one| one.has(cause)).map(|one| one.first).sum()
    }

    /// The smallest number of explanations that hold 95 %, the most probable first.
    pub fn listed(&self) -> &[FoundExplanation<A>] {
        let mut held = 0.0;
        let inside = |one: &&FoundExplanation<A>| {
            let open = held < LISTED;
            held += one.probability;
            open
        };
        &self.0[..self.0.iter().take_while(inside).count()]
    }

    /// The additions of the most probable explanation that are probable enough to be named, or `known` to be. None
    /// beside a rival, which asks the user before any physics is named. `names` are the cause and those that describe
    /// the same dependence, which count together; none for what is noise.
    pub fn named(&self, names: impl Fn(&A) -> Vec<String>, known: impl Fn(&A) -> bool) -> Vec<A> {
        let probable = |one: &&A| known(one) || self.probability_of_any(&names(one)) >= NAMED;
        match self.best() {
            Some(best) if best.is_physics() => best.told.additions.iter().filter(probable).cloned().collect(),
            _ => Vec::new(),
        }
    }

    /// Whether a cause is in the most probable explanation.
    pub fn is_in_best(&self, cause: &str) -> bool {
        self.best().is_some_and(|best| best.has(cause))
    }

    /// Additions that were fitted alone beside the base model.
    pub fn singles(&self) -> impl Iterator<Item = &A> {
        self.0.iter().filter(|one| one.is_physics()).filter_map(|one| match &one.told.additions[..] {
            [single] => Some(single),
            _ => None,
        })
    }

    /// Other causes in the stead of this one, the most probable first.
    pub fn alternatives(&self, cause: &str) -> Vec<Alternative> {
        let gain = self.best().map_or(0.0, |best| best.gain);
        let mut all: Vec<Alternative> = Vec::new();
        for one in self.0.iter().filter(|one| !one.has(cause) && one.is_physics()) {
            for name in one.told.causes.iter().filter(|name| !self.is_in_best(name)) {
                if all.iter().all(|known| known.cause != *name) {
                    let instead = self.0.iter().filter(|one| !one.has(cause) && one.has(name));
                    let probability = instead.map(|one| one.probability).sum();
                    let score_difference = gain - one.gain;
                    all.push(Alternative { cause: name.clone(), score_difference, probability });
                }
            }
        }
        all.sort_by(|a, b| b.probability.total_cmp(&a.probability));
        all.truncate(ALTERNATIVES);
        all
    }

    /// Causes that stand in the stead of this one in the explanations that hold 95 %.
    pub fn in_stead_of(&self, cause: &str) -> Vec<String> {
        let others = self.listed().iter().filter(|one| !one.has(cause));
        distinct(others.flat_map(|one| &one.told.causes).filter(|name| !self.is_in_best(name)))
    }

    /// The explanations that hold 95 %; those that differ only in the noise are one.
    pub fn record(&self) -> Vec<ExplanationFound> {
        let mut all: Vec<ExplanationFound> = Vec::new();
        for one in self.listed() {
            match all.iter_mut().find(|known| known.causes == one.told.causes) {
                Some(known) => known.probability += one.probability,
                None => {
                    let (causes, probability) = (one.told.causes.clone(), one.probability);
                    all.push(ExplanationFound { causes, probability });
                }
            }
        }
        all.sort_by(|a, b| b.probability.total_cmp(&a.probability));
        all
    }

    /// The rivals of physics in the explanations that hold 95 %, the most probable first.
    pub fn rivals(&self, observable: &'static str) -> Vec<Rival> {
        let physics = self.0.iter().filter(|one| one.is_physics());
        let best = physics.map(|one| one.gain).fold(0.0, f64::max);
        let mut all: Vec<Rival> = Vec::new();
        for one in self.listed() {
            let Some((id, question)) = &one.told.rival else { continue };
            let probability = self.probability(id);
            if probability > 1.0 - LISTED && all.iter().all(|known| known.id != *id) {
                let (id, explanation) = (id.clone(), question.clone());
                let [gain, lead] = [one.gain, one.gain - best];
                all.push(Rival { id, observable, gain, lead, probability, explanation });
            }
        }
        all.sort_by(|a, b| b.probability.total_cmp(&a.probability));
        all
    }

    /// Causes of which one takes part more probably than not, though none is probable enough to be named.
    pub fn undecided(&self) -> Vec<String> {
        let base = self.0.iter().filter(|one| one.told.causes.is_empty());
        if base.map(|one| one.probability).sum::<f64>() > 0.5 {
            return Vec::new();
        }
        let physics = self.listed().iter().filter(|one| one.is_physics());
        let mut names = distinct(physics.flat_map(|one| &one.told.causes));
        // Numbers of a case take no place from causes at the wall.
        let mut left = [ALTERNATIVES; 2];
        names.retain(|name| {
            let places = &mut left[usize::from(name.starts_with("case:"))];
            let has_place = *places > 0;
            *places = places.saturating_sub(1);
            has_place
        });
        names
    }
}

/// Names in the order of their first appearance.
pub(super) fn distinct<'a>(names: impl Iterator<Item = &'a String>) -> Vec<String> {
    let mut seen = BTreeSet::new();
    names.filter(|name| seen.insert(*name)).cloned().collect()
}
