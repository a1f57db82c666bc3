//! The named causes with their parameters, and the model file that follows from them on some rows.

use super::choice::Task;
use super::constant_capture::ConstantCapture;
use super::curve::ColumnCurve;
use super::data_split::DataSplit;
use super::hypothesis::{Hypothesis, ScatterTrend};
use super::interval::set_intervals;
use super::likelihood::Scatter;
use super::part::FittedPart;
use super::{extend, form_finding};

/// The parts, curves and scatter of a hypothesis, without its rows.
#[derive(Clone)]
pub(super) struct FoundParts {
    parts: Vec<FittedPart>,
    curves: Vec<ColumnCurve>,
    scatter_trends: Vec<ScatterTrend>,
    captures: ConstantCapture,
    scatter: Scatter,
}

impl FoundParts {
    pub fn of(hypothesis: &Hypothesis<'_>) -> Self {
        Self {
            parts: hypothesis.parts.clone(),
            curves: hypothesis.curves.clone(),
            scatter_trends: hypothesis.scatter_trends.clone(),
            captures: hypothesis.captures,
            scatter: hypothesis.scatter,
        }
    }

    /// The causes with these keys, and what is no cause.
    fn only(mut self, keys: &[String], data: &DataSplit) -> Self {
        self.parts.retain(|one| keys.contains(&one.part.name()));
        self.curves.retain(|one| keys.contains(&one.form.key(data)));
        self
    }

    fn without_causes(&self) -> Self {
        Self { parts: Vec::new(), curves: Vec::new(), ..self.clone() }
    }

    fn hypothesis<'a>(&self, data: &'a DataSplit) -> Hypothesis<'a> {
        let Self { parts, curves, scatter_trends, captures, scatter } = self.clone();
        Hypothesis { curves, scatter_trends, captures, ..Hypothesis::with_parts(data, parts, scatter) }
    }
}

/// What is named, on the rows that fit it.
#[derive(Clone)]
pub(super) struct NamedCauses {
    /// The rows, with the groups' shared errors if they have any.
    pub data: DataSplit,
    /// The ids of the causes, in alphabetical order.
    pub names: Vec<String>,
    found: FoundParts,
}

impl NamedCauses {
    /// Of what was found the causes with these keys and ids.
    pub fn new(data: &DataSplit, found: FoundParts, keys: &[String], mut names: Vec<String>) -> Self {
        names.sort_unstable();
        names.dedup();
        let mut new = Self { data: data.clone(), names, found: found.only(keys, data) };
        // The scatter about what is named, without the rest of the explanation.
        let mut named = new.hypothesis(data);
        named.fit_scatter(&data.search);
        new.found.scatter = named.scatter;
        new
    }

    /// The same without causes.
    pub fn without_causes(&self) -> Self {
        Self { data: self.data.clone(), names: Vec::new(), found: self.found.without_causes() }
    }

    /// The causes on these rows, as of the search.
    pub fn hypothesis<'a>(&self, data: &'a DataSplit) -> Hypothesis<'a> {
        self.found.hypothesis(data)
    }

    /// Scatter of single measurements about the causes [1].
    pub fn scatter(&self) -> Scatter {
        self.found.scatter
    }

    /// The rows for the final fit.
    pub fn fine(&self) -> DataSplit {
        self.data.fine(self.found.parts.iter().any(|fitted| fitted.part.is_stochastic()))
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

    /// The model file, for a gain: without intervals.
    pub fn model_text(&self, task: Task<'_>) -> Result<String, toml_edit::TomlError> {
        let fine = self.fine();
        let mut hypothesis = self.hypothesis(&fine);
        hypothesis.fit(&fine.fit);
        hypothesis.settle_forms(&fine.fit);
        extend::extended(task.text, &hypothesis)
    }
}
