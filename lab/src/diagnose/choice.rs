//! A choice of causes on some rows, and the model file that follows from it.

use super::candidate::ScoredCandidate;
use super::curve::ColumnCurve;
use super::data_split::DataSplit;
use super::extend;
use super::groups::GroupColumn;
use super::hypothesis::{Hypothesis, ScatterTrend};
use super::interval::set_intervals;
use super::likelihood::Scatter;
use super::model_selection::{Discovery, ForwardSelection, select};
use super::observable::Observable;
use super::part::FittedPart;
use super::record::GroupsFound;
use super::shared_error::SharedErrors;

/// Least gain in log likelihood [nats] by which residuals show that groups share an error (p = 0.01 for one variance).
const SHARED: f64 = 2.7;

/// What a choice needs beside the rows.
#[derive(Clone, Copy)]
pub(super) struct Task<'a> {
    /// Text of the base model.
    pub text: &'a str,
    /// Accepted share of false discoveries [1].
    pub level: f64,
    /// The columns that group the rows.
    pub groups: &'a [GroupColumn],
    /// Called after each candidate.
    pub progress: &'a (dyn Fn() + Sync),
}

/// The result of a choice on the fitted rows of a [`DataSplit`].
#[derive(Clone)]
pub(super) struct CauseChoice {
    /// The rows, with the groups' shared errors if they have any.
    pub data: DataSplit,
    pub discoveries: Vec<Discovery>,
    pub first_round: Vec<ScoredCandidate>,
    /// Smallest corrected p-value of a candidate beside the base model, and beside the extended one.
    pub structure: [f64; 2],
    /// Errors that groups share in the extended model.
    pub shared: SharedErrors,
    /// The parts, curves and scatter of the search.
    state: FoundParts,
}

/// What was found, without the rows.
#[derive(Clone)]
struct FoundParts {
    parts: Vec<FittedPart>,
    curves: Vec<ColumnCurve>,
    scatter_trends: Vec<ScatterTrend>,
    background_capture: f64,
    scatter: Scatter,
}

impl FoundParts {
    fn without_causes(&self) -> Self {
        Self { parts: Vec::new(), ..self.without_curves() }
    }

    fn without_curves(&self) -> Self {
        Self { curves: Vec::new(), ..self.clone() }
    }
}

/// Whether a curve is over a column of which each group has one value.
fn follows_groups(curve: &ColumnCurve, data: &DataSplit, groups: &GroupColumn) -> bool {
    let constant = |column: usize| {
        let mut of_group: Vec<Option<f64>> = vec![None; groups.count];
        data.search.iter().all(|&row| {
            let cell = data.covariates[column].cell(row);
            *of_group[groups.of_row[row]].get_or_insert(cell) == cell
        })
    };
    curve.form.sides.iter().any(|side| constant(side.0))
}

impl CauseChoice {
    /// Chooses causes on the fitted rows. Groups share an error only if the residuals beside the
    /// causes show it; the choice is then made anew with that error. A curve over a column that is
    /// constant within groups takes their errors for its own, so there the residuals without curves
    /// decide.
    pub fn new(data: &DataSplit, task: Task<'_>) -> Self {
        let plain = Self::once(data, task);
        let bare = Self { state: plain.state.without_curves(), ..plain.clone() };
        let shared = |groups: &GroupColumn| {
            let follows = |curve: &ColumnCurve| {
                curve.form.observable != Observable::Capture && follows_groups(curve, data, groups)
            };
            let judged = if plain.state.curves.iter().any(follows) { &bare } else { &plain };
            judged.shared_errors(&data.with_shared_errors(groups)).gain()
        };
        let gains = task.groups.iter().map(|groups| (shared(groups), groups));
        let largest = gains.max_by(|a, b| a.0.total_cmp(&b.0));
        match largest.filter(|(gain, _)| *gain >= SHARED) {
            Some((_, groups)) => Self::once(&data.with_shared_errors(groups), task),
            None => plain,
        }
    }

    fn once(data: &DataSplit, task: Task<'_>) -> Self {
        let base = Hypothesis::base(data);
        let ForwardSelection { hypothesis, discoveries, first_round, last_round } =
            select(&base, task.level, task.progress);
        let state = FoundParts {
            parts: hypothesis.parts,
            curves: hypothesis.curves,
            scatter_trends: hypothesis.scatter_trends,
            background_capture: hypothesis.background_capture,
            scatter: hypothesis.scatter,
        };
        let smallest = |round: &[ScoredCandidate]| {
            let systematic = round.iter().filter(|scored| scored.addition.is_systematic());
            systematic.map(|scored| scored.q_value).fold(1.0, f64::min)
        };
        let structure = [smallest(&first_round), smallest(&last_round)];
        let (data, shared) = (data.clone(), SharedErrors::default());
        let mut choice = Self { data, discoveries, first_round, structure, shared, state };
        choice.shared = choice.shared_errors(&choice.data);
        choice
    }

    /// The errors that groups share beside the causes.
    fn shared_errors(&self, grouped: &DataSplit) -> SharedErrors {
        let hypothesis = self.hypothesis(grouped);
        let rows = hypothesis.evaluate(&*grouped.search, hypothesis.offsets()).with_fitted_scatter();
        (*rows.shared).clone()
    }

    /// The causes on these rows, as of the search.
    pub fn hypothesis<'a>(&self, data: &'a DataSplit) -> Hypothesis<'a> {
        let FoundParts { parts, curves, scatter_trends, background_capture, scatter } = self.state.clone();
        Hypothesis {
            curves,
            scatter_trends,
            background_capture,
            ..Hypothesis::with_parts(data, parts, scatter)
        }
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
            self.discoveries.iter().map(|found| found.winner.addition.name(&self.data)).collect();
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
        set_intervals(&mut hypothesis, &fine.fit);
        hypothesis
    }

    /// The model file of this choice, for a gain: without intervals.
    pub fn model_text(&self, task: Task<'_>) -> Result<String, toml_edit::TomlError> {
        let fine = self.fine();
        let mut hypothesis = self.hypothesis(&fine);
        hypothesis.fit(&fine.fit);
        extend::extended(task.text, &hypothesis)
    }
}
