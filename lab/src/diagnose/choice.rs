//! A choice among explanations on some rows, and what fewer rows would choose.

use std::sync::Arc;

use super::beside_laws::{LawsWithInstrument, instruments_beside_laws};
use super::candidate::ScoredCandidate;
use super::constants::Effort;
use super::data_split::DataSplit;
use super::explanation::{Evidence, Explanation, Exploration};
use super::explanations::{Explanations, Told};
use super::ground::{Ground, MoreOutliers, grounds};
use super::groups::GroupColumn;
use super::impact_search::{ImpactExplanation, ImpactSearch, evidence};
use super::named_causes::{FoundParts, NamedCauses};
use super::record::GroupsFound;
use super::shared_error::SharedErrors;

/// What a choice needs beside the rows.
#[derive(Clone, Copy)]
pub(super) struct Task<'a> {
    /// Text of the base model.
    pub text: &'a str,
    /// The columns that group the rows, and groups that no name tells.
    pub groups: &'a [GroupColumn],
    pub effort: Effort,
    /// Told each candidate.
    pub progress: &'a (dyn Fn(&str) + Sync),
}

/// The result of a choice on the fitted rows of a [`DataSplit`].
#[derive(Clone)]
pub(super) struct CauseChoice {
    /// What is named.
    pub causes: NamedCauses,
    /// What the search visited, the most probable first.
    pub explanations: Explanations<ScoredCandidate>,
    /// The additions that are named, in the order in which they joined.
    pub discoveries: Vec<ScoredCandidate>,
    /// Smallest corrected p-value of a candidate beside the base model, and beside what is named.
    pub structure: [f64; 2],
    /// Errors that groups share in the extended model.
    pub shared: SharedErrors,
    /// The outliers of the best explanation, where more than expected fit better.
    pub outliers: Option<MoreOutliers>,
    /// What was visited, in the order of the explanations.
    visited: Arc<Visited>,
}

/// What a search visited.
struct Visited {
    all: Vec<Explanation<Kept>>,
    /// All rows as they are.
    whole: DataSplit,
    grounds: Vec<Ground>,
    evidence: Evidence,
    /// The independent unit of each row of the search.
    units: Arc<[usize]>,
}

/// An explanation that was visited, without its rows.
struct Kept {
    /// Index of its ground.
    ground: usize,
    found: FoundParts,
}

impl Visited {
    /// The explanations on some of the rows, with the parameters of all; their indices instead of what was fitted.
    fn on(&self, places: &[usize]) -> Vec<Explanation<usize>> {
        let on = |(index, one): (usize, &Explanation<Kept>)| Explanation {
            keys: one.keys.clone(),
            fitted: index,
            scores: places.iter().map(|&place| one.scores[place]).collect(),
            freedom: one.freedom,
            log_prior: one.log_prior,
        };
        self.all.iter().enumerate().map(on).collect()
    }

    /// All rows, as the ground of an explanation has them.
    fn data(&self, one: &Explanation<Kept>) -> DataSplit {
        self.grounds[one.fitted.ground].of_all(&self.whole)
    }
}

/// Divides the gains of explanations by the dispersion of captures in classes about the best one, where
/// impacts of a class are not independent (quasi-likelihood; McCullagh and Nelder 1989, ch. 9).
fn temper(visited: &mut [ImpactExplanation<'_>], grounds: &[&Ground]) {
    let Some(best) = visited.first() else { return };
    let hypothesis = &best.fitted.hypothesis;
    let data = &grounds[best.fitted.ground].data;
    let rows = hypothesis.evaluate(&*data.search, hypothesis.offsets());
    let (pearson, classes) = rows.dispersion();
    let left = classes as f64 - best.freedom;
    if left < 1.0 || pearson <= left {
        return;
    }
    let base = visited.iter().find(|one| one.keys.is_empty()).map(|one| one.scores.clone());
    let Some(base) = base else { return };
    for one in visited {
        let scores = one.scores.iter().zip(&base);
        one.scores = scores.map(|(own, base)| base + (own - base) * left / pearson).collect();
    }
}

/// The ids of the causes of an explanation and of its rival, in alphabetical order.
fn causes(one: &ImpactExplanation<'_>, ground: &Ground) -> Vec<String> {
    let systematic = one.fitted.found.iter().filter(|found| found.addition.is_systematic());
    let mut names: Vec<String> = systematic.map(|found| found.addition.name(&ground.data)).collect();
    names.extend(ground.is_rival().then(|| ground.key.clone()));
    names.sort_unstable();
    names.dedup();
    names
}

/// Smallest corrected p-value of a candidate beside these causes.
fn smallest_beside(explanations: &Explanations<ScoredCandidate>, causes: &[String]) -> f64 {
    let larger = explanations.all().iter().filter(|one| one.told.causes.len() == causes.len() + 1);
    let beside = larger.filter(|one| one.is_physics() && causes.iter().all(|cause| one.has(cause)));
    let last = beside.filter_map(|one| one.told.additions.last()).filter(|one| one.addition.is_systematic());
    last.map(|one| one.q_value).fold(1.0, f64::min)
}

impl CauseChoice {
    /// Chooses among explanations on the fitted rows of `whole`.
    pub fn new(whole: &DataSplit, task: Task<'_>) -> Self {
        let data = &whole.searched();
        let evidence = evidence(data);
        let plain = grounds(data, whole, task, evidence);
        let grounds: Vec<&Ground> = plain.iter().collect();
        let search = |grounds| ImpactSearch::new(grounds, evidence, task.effort.refitted, task.progress);
        let first = search(grounds.clone());
        let mut exploration = Exploration::new(first.starts(), evidence);
        exploration.expand(&first, 1);
        let beside = instruments_beside_laws(exploration.visited(), &grounds, data, evidence);
        let grounds = [grounds, beside.iter().map(|one| &one.ground).collect()].concat();
        let search = search(grounds.clone());
        let place = |index: usize| grounds.len() - beside.len() + index;
        let with = |(index, one): (usize, &LawsWithInstrument)| {
            search.with_instrument(&exploration.visited()[one.laws], &one.at, place(index))
        };
        let mut found: Vec<ImpactExplanation<'_>> = beside.iter().enumerate().map(with).collect();
        found.retain(|one| !one.fitted.hypothesis.at_bound());
        exploration.add(found);
        exploration.expand(&search, task.effort.expanded);
        let mut visited = exploration.finish(&search);
        if visited.is_empty() {
            // Without any evidence the base model stays.
            visited.extend(search.starts().into_iter().take(1));
        }
        temper(&mut visited, &grounds);
        let ground = |one: &ImpactExplanation<'_>| grounds[one.fitted.ground];
        let units = visited.first().map_or(&data.units, |best| &ground(best).data.units).clone();
        let told = |one: &ImpactExplanation<'_>| Told {
            causes: causes(one, ground(one)),
            additions: one.fitted.found.clone(),
            rival: ground(one).question.clone().map(|question| (ground(one).key.clone(), question)),
        };
        let explanations = Explanations::new(&visited, evidence, &units, told);
        let all = explanations.all().iter().map(|one| kept(&visited[one.place])).collect();
        let grounds = plain.into_iter().chain(beside.into_iter().map(|one| one.ground)).collect();
        Self::of(Visited { all, whole: whole.clone(), grounds, evidence, units }, explanations)
    }

    /// The choice of the best explanation, with what is probable enough to be named.
    fn of(visited: Visited, explanations: Explanations<ScoredCandidate>) -> Self {
        let best = &visited.all[0];
        let data = visited.data(best);
        let discoveries = explanations.named(|one| one.addition.names(&data, false), |_| false);
        let causes = named(&data, best, discoveries.iter());
        let structure = [&[][..], &causes.names].map(|causes| smallest_beside(&explanations, causes));
        let outliers = visited.grounds[best.fitted.ground].outliers;
        let shared = SharedErrors::default();
        let visited = Arc::new(visited);
        let mut choice = Self { causes, explanations, discoveries, structure, shared, outliers, visited };
        choice.shared = choice.shared_errors();
        choice
    }

    /// What some of the rows would name of the explanations that were visited: of the best one what all rows name, and
    /// what is probable enough by these rows. A law counts with a curve over its inputs: they predict the same.
    pub fn again(&self, fitted: &[usize]) -> NamedCauses {
        let (visited, told) = (&self.visited, self.explanations.all());
        let rows = &visited.whole;
        let mut inside = vec![false; rows.rows.len()];
        fitted.iter().for_each(|&row| inside[row] = true);
        let places: Vec<usize> = (0..rows.search.len()).filter(|&place| inside[rows.search[place]]).collect();
        let some = visited.on(&places);
        let share = places.len() as f64 / rows.search.len() as f64;
        let base = some.iter().find(|one| one.keys.is_empty()).map_or(0.0, Explanation::score);
        let evidence = Evidence { base, readings: share * visited.evidence.readings, ..visited.evidence };
        let units: Vec<usize> = places.iter().map(|&place| visited.units[place]).collect();
        let tell = |one: &Explanation<usize>| {
            let Told { causes, additions, rival } = &told[one.fitted].told;
            Told { causes: causes.clone(), additions: additions.iter().collect(), rival: rival.clone() }
        };
        let explanations = Explanations::new(&some, evidence, &units, tell);
        let best = &visited.all[explanations.best().map_or(0, |best| best.place)];
        let data = visited.data(best);
        let by_all = |one: &&ScoredCandidate| self.causes.names.contains(&one.addition.name(&data));
        let found = explanations.named(|one| one.addition.names(&data, true), by_all);
        named(&data.fitting(fitted), best, found.into_iter())
    }

    /// The most probable addition of this name.
    pub fn addition(&self, cause: &str) -> Option<&ScoredCandidate> {
        let mut all = self.explanations.all().iter().flat_map(|one| &one.told.additions);
        all.find(|one| one.addition.name(&self.causes.data) == cause)
    }

    /// The errors that groups share beside the causes.
    fn shared_errors(&self) -> SharedErrors {
        let data = &self.causes.data;
        let hypothesis = self.causes.hypothesis(data);
        let rows = hypothesis.evaluate(&*data.search, hypothesis.offsets()).with_fitted_scatter();
        (*rows.shared).clone()
    }

    /// The same without causes.
    pub fn without_causes(&self) -> Self {
        Self { discoveries: Vec::new(), causes: self.causes.without_causes(), ..self.clone() }
    }

    /// The groups and the error that they share, if they do.
    pub fn groups_found(&self) -> Option<GroupsFound> {
        let groups = self.causes.data.shared.as_ref()?;
        let share = |which: usize| {
            let [shared, own] = [self.shared.scatter[which].powi(2), self.causes.scatter()[which].powi(2)];
            if shared > 0.0 { shared / (shared + own) } else { 0.0 }
        };
        Some(GroupsFound {
            column: groups.name.clone(),
            count: groups.count,
            declared: groups.declared,
            scatter: self.shared.scatter,
            share: [share(0), share(1)],
        })
    }
}

/// An explanation without its rows.
fn kept(one: &ImpactExplanation<'_>) -> Explanation<Kept> {
    Explanation {
        keys: one.keys.clone(),
        fitted: Kept { ground: one.fitted.ground, found: FoundParts::of(&one.fitted.hypothesis) },
        scores: one.scores.clone(),
        freedom: one.freedom,
        log_prior: one.log_prior,
    }
}

/// The causes of an explanation that are named, on these rows.
fn named<'a>(
    data: &DataSplit,
    of: &Explanation<Kept>,
    additions: impl Iterator<Item = &'a ScoredCandidate> + Clone,
) -> NamedCauses {
    let keys: Vec<String> = additions.clone().map(|one| one.addition.key(data)).collect();
    let names = additions.map(|one| one.addition.name(data)).collect();
    NamedCauses::new(data, of.fitted.found.clone(), &keys, names)
}
