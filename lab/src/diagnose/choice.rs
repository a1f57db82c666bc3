//! A choice among explanations on some rows, and the model file that follows from it.

use super::beside_laws::{LawsWithInstrument, instruments_beside_laws};
use super::candidate::ScoredCandidate;
use super::constant_capture::ConstantCapture;
use super::constants::Effort;
use super::curve::ColumnCurve;
use super::data_split::DataSplit;
use super::explanation::Exploration;
use super::explanations::{Explanations, Told, distinct};
use super::ground::{Ground, MoreOutliers, grounds};
use super::groups::GroupColumn;
use super::hypothesis::{Hypothesis, ScatterTrend};
use super::impact_search::{ImpactExplanation, ImpactSearch, evidence};
use super::interval::set_intervals;
use super::likelihood::Scatter;
use super::part::FittedPart;
use super::record::GroupsFound;
use super::shared_error::SharedErrors;
use super::{extend, form_finding};

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
    /// The rows, with the groups' shared errors if they have any.
    pub data: DataSplit,
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
    /// The parts, curves and scatter of the search.
    state: FoundParts,
}

/// What was found, without the rows.
#[derive(Clone)]
struct FoundParts {
    parts: Vec<FittedPart>,
    curves: Vec<ColumnCurve>,
    scatter_trends: Vec<ScatterTrend>,
    captures: ConstantCapture,
    scatter: Scatter,
}

impl FoundParts {
    /// Those of a hypothesis that are named, and what is no cause.
    fn of(hypothesis: &Hypothesis<'_>, named: &[String]) -> Self {
        let data = hypothesis.data;
        let part = |one: &&FittedPart| named.contains(&one.part.name());
        let curve = |one: &&ColumnCurve| named.contains(&one.form.key(data));
        Self {
            parts: hypothesis.parts.iter().filter(part).cloned().collect(),
            curves: hypothesis.curves.iter().filter(curve).cloned().collect(),
            scatter_trends: hypothesis.scatter_trends.clone(),
            captures: hypothesis.captures,
            scatter: hypothesis.scatter,
        }
    }

    fn without_causes(&self) -> Self {
        Self { parts: Vec::new(), curves: Vec::new(), ..self.clone() }
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
    /// Chooses among explanations on the fitted rows.
    pub fn new(data: &DataSplit, task: Task<'_>) -> Self {
        let evidence = evidence(data);
        let plain = grounds(data, task.groups, task.text, evidence);
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
        temper(&mut visited, &grounds);
        let ground = |one: &ImpactExplanation<'_>| grounds[one.fitted.ground];
        let units = visited.first().map_or(&data.units, |best| &ground(best).data.units);
        let units: Vec<usize> = data.search.iter().map(|&row| units[row]).collect();
        let told = |one: &ImpactExplanation<'_>| Told {
            causes: causes(one, ground(one)),
            additions: one.fitted.found.clone(),
            rival: ground(one).question.clone().map(|question| (ground(one).key.clone(), question)),
        };
        let explanations = Explanations::new(&visited, evidence, &units, told);
        let best = explanations.best().map(|best| &visited[best.place]);
        Self::of(data, &grounds, best, explanations, task.effort.law_or_curve)
    }

    /// The choice of the best explanation, with what is probable enough to be named.
    fn of(
        data: &DataSplit,
        grounds: &[&Ground],
        best: Option<&ImpactExplanation<'_>>,
        explanations: Explanations<ScoredCandidate>,
        law_or_curve: bool,
    ) -> Self {
        let ground = best.map_or(0, |best| best.fitted.ground);
        // A rival asks the user before any physics is named.
        let data = if grounds[ground].is_rival() { data } else { &grounds[ground].data };
        let hypothesis = best.map_or_else(|| Hypothesis::base(data), |best| best.fitted.hypothesis.clone());
        let discoveries = explanations.named(|one| one.addition.names(data, law_or_curve));
        let keys: Vec<String> = discoveries.iter().map(|one| one.addition.key(data)).collect();
        let state = FoundParts::of(&hypothesis, &keys);
        let causes: Vec<String> = discoveries.iter().map(|one| one.addition.name(data)).collect();
        let structure =
            [&[][..], &distinct(causes.iter())].map(|causes| smallest_beside(&explanations, causes));
        let (data, shared) = (data.clone(), SharedErrors::default());
        let outliers = grounds[ground].outliers;
        let mut choice = Self { data, explanations, discoveries, structure, shared, outliers, state };
        // The scatter about what is named, without the rest of the explanation.
        let mut named = choice.hypothesis(&choice.data);
        named.fit_scatter(&choice.data.search);
        choice.state.scatter = named.scatter;
        choice.shared = choice.shared_errors(&choice.data);
        choice
    }

    /// The most probable addition of this name.
    pub fn addition(&self, cause: &str) -> Option<&ScoredCandidate> {
        let mut all = self.explanations.all().iter().flat_map(|one| &one.told.additions);
        all.find(|one| one.addition.name(&self.data) == cause)
    }

    /// The errors that groups share beside the causes.
    fn shared_errors(&self, grouped: &DataSplit) -> SharedErrors {
        let hypothesis = self.hypothesis(grouped);
        let rows = hypothesis.evaluate(&*grouped.search, hypothesis.offsets()).with_fitted_scatter();
        (*rows.shared).clone()
    }

    /// The causes on these rows, as of the search.
    pub fn hypothesis<'a>(&self, data: &'a DataSplit) -> Hypothesis<'a> {
        let FoundParts { parts, curves, scatter_trends, captures, scatter } = self.state.clone();
        Hypothesis { curves, scatter_trends, captures, ..Hypothesis::with_parts(data, parts, scatter) }
    }

    /// The same without causes.
    pub fn without_causes(&self) -> Self {
        Self { discoveries: Vec::new(), state: self.state.without_causes(), ..self.clone() }
    }

    /// The groups and the error that they share, if they do.
    pub fn groups_found(&self) -> Option<GroupsFound> {
        let groups = self.data.shared.as_ref()?;
        let share = |which: usize| {
            let [shared, own] = [self.shared.scatter[which].powi(2), self.state.scatter[which].powi(2)];
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

    /// The ids of the causes, in alphabetical order.
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> =
            self.discoveries.iter().map(|found| found.addition.name(&self.data)).collect();
        names.sort_unstable();
        names.dedup();
        names
    }

    /// Scatter of single measurements about the causes [1].
    pub fn scatter(&self) -> Scatter {
        self.state.scatter
    }

    /// The rows for the final fit.
    pub fn fine(&self) -> DataSplit {
        self.data.fine(self.state.parts.iter().any(|fitted| fitted.part.is_stochastic()))
    }

    /// All parameters fitted to the fitted rows of `fine`, with their intervals.
    pub fn fitted<'a>(&self, fine: &'a DataSplit) -> Hypothesis<'a> {
        let mut hypothesis = self.hypothesis(fine);
        hypothesis.fit(&fine.fit);
        hypothesis.polish(&fine.fit);
        hypothesis.settle_forms(&fine.fit);
        set_intervals(&mut hypothesis, &fine.fit);
        form_finding::set_intervals(&mut hypothesis);
        hypothesis
    }

    /// The model file of this choice, for a gain: without intervals.
    pub fn model_text(&self, task: Task<'_>) -> Result<String, toml_edit::TomlError> {
        let fine = self.fine();
        let mut hypothesis = self.hypothesis(&fine);
        hypothesis.fit(&fine.fit);
        hypothesis.settle_forms(&fine.fit);
        extend::extended(task.text, &hypothesis)
    }
}
