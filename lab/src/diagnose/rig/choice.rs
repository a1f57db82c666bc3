//! A choice among explanations of a rig's readings, and what is named.

use super::super::constants::Effort;
use super::super::explanation::{Explained as _, explore};
use super::super::explanations::{Explanations, Told};
use super::super::record::FormPoint;
use super::addition::{RigAddition, keys};
use super::rig_search::{RigExplanation, RigSearch};
use super::significance::NullGains;
use super::study::RigStudy;

/// An addition that is named.
#[derive(Debug, Clone)]
pub(super) struct Named {
    /// Fitted together with the others.
    pub addition: RigAddition,
    /// What it gains beside the others in log likelihood, less its number of parameters [nats].
    pub gain: f64,
    /// Corrected for all candidates.
    pub p_value: f64,
    /// Of a closed form its values with a 95 % band, after the final fit.
    pub line: Vec<FormPoint>,
}

/// What was chosen.
#[derive(Debug, Clone)]
pub(super) struct RigChoice {
    pub explanations: Explanations<RigAddition>,
    pub named: Vec<Named>,
    /// Smallest corrected p-value of a candidate beside the base model, and beside what is named.
    pub structure: [f64; 2],
    /// What the search visited.
    pub visited: Vec<RigExplanation>,
}

impl RigChoice {
    /// The choice on all experiments.
    pub fn new(study: &RigStudy<'_>, effort: Effort) -> Self {
        let weights = vec![1.0; study.data.experiments];
        let search = RigSearch::new(study, &weights, effort.refitted, &[]);
        let visited = explore(&search, vec![search.start()], effort.expanded);
        let explanations = explanations(&search, &visited, &weights);
        let named = explanations.named(RigAddition::names, |_| false);
        let best = explanations.best_additions().len();
        let named = if named.len() < best { study.fit(&named, &weights) } else { named };
        let mut choice = Self { explanations, named: Vec::new(), structure: [1.0; 2], visited };
        choice.judge(study, &named, &weights);
        choice
    }

    /// The explanations of experiments with these weights, from the fits of this choice, and what that search visited.
    pub fn again(
        &self,
        study: &RigStudy<'_>,
        effort: Effort,
        weights: &[f64],
    ) -> (Explanations<RigAddition>, Vec<RigExplanation>) {
        let search = RigSearch::new(study, weights, effort.refitted, &self.visited);
        let visited = explore(&search, vec![search.start()], effort.expanded);
        (explanations(&search, &visited, weights), visited)
    }

    /// Sets what is named, with the gains and p-values of these additions.
    fn judge(&mut self, study: &RigStudy<'_>, named: &[RigAddition], weights: &[f64]) {
        let null = NullGains::new(&study.table, &study.data, weights, study.seed);
        self.structure = [&[][..], &keys(named)].map(|keys| null.p_value(self.largest_beside(keys)));
        let all = study.score(named, weights);
        for place in 0..named.len() {
            let mut rest = named.to_vec();
            let addition = rest.remove(place);
            let without = study.score(&study.fit(&rest, weights), weights);
            let gain = all - without - addition.axes.len() as f64;
            self.named.push(Named { addition, gain, p_value: null.p_value(gain), line: Vec::new() });
        }
    }

    /// Largest gain of one addition more beside these, less its number of parameters [nats].
    fn largest_beside(&self, keys: &[String]) -> f64 {
        let has = |one: &&RigExplanation| keys.iter().all(|key| one.keys.contains(key));
        let worth = |one: &RigExplanation| one.score() - one.freedom;
        let of = |count: usize| {
            let beside = self.visited.iter().filter(has).filter(move |one| one.keys.len() == count);
            beside.map(worth).fold(f64::NEG_INFINITY, f64::max)
        };
        of(keys.len() + 1) - of(keys.len())
    }

    /// The same with nothing named.
    pub fn without_causes(&self) -> Self {
        Self { named: Vec::new(), structure: [self.structure[0]; 2], ..self.clone() }
    }

    /// What is named, fitted together.
    pub fn additions(&self) -> Vec<RigAddition> {
        self.named.iter().map(|one| one.addition.clone()).collect()
    }
}

/// The explanations with their probabilities.
fn explanations(
    search: &RigSearch<'_>,
    visited: &[RigExplanation],
    weights: &[f64],
) -> Explanations<RigAddition> {
    let count = weights.iter().filter(|weight| **weight > 0.0).count();
    let units: Vec<usize> = (0..count).collect();
    let told = |one: &RigExplanation| {
        let mut causes: Vec<String> = one.fitted.additions.iter().map(RigAddition::name).collect();
        causes.sort_unstable();
        causes.dedup();
        Told { causes, additions: one.fitted.additions.clone(), rival: None }
    };
    Explanations::new(visited, search.evidence(), &units, told)
}
