//! Laws that a constant error of `e_n` or `e_t` hides: they gain little alone, and nothing shows a level before them.

use rayon::prelude::*;

use super::candidate::Candidate;
use super::curve::{ColumnCurve, ColumnCurveForm};
use super::evaluation::Evaluation;
use super::hypothesis::{Hypothesis, with_levels};
use super::observable::Observable;
use super::part::{FittedPart, Part};
use super::search::{descend, grid};

/// Rows that are looked at.
const ROWS: usize = 250;
/// Places along each coordinate of a grid, by their number.
const GRID_STEPS: [usize; 4] = [1, 12, 6, 3];

/// A law with the level that fits best beside it.
#[derive(Debug, Clone)]
pub(super) struct HiddenLaw {
    pub law: FittedPart,
    pub level: ColumnCurve,
    /// Log likelihood of the rows that are looked at [nats].
    score: f64,
}

/// The levels of `e_n` and `e_t` among candidates, that add and that multiply.
pub(super) fn levels(candidates: &[Candidate]) -> Vec<ColumnCurve> {
    let observables = candidates.iter().filter_map(|one| match one {
        Candidate::Curve { sides: [None, None], observable } => Some(*observable),
        _ => None,
    });
    let forms = observables
        .filter(|one| *one != Observable::Capture)
        .flat_map(|one| [false, true].map(|multiplicative| ColumnCurveForm::level(one, multiplicative)));
    forms.map(|form| ColumnCurve::constant(form, 0.0)).collect()
}

/// Those laws among candidates that explain most with one of these levels, at most `count`, the best first.
pub(super) fn hidden_laws(
    hypothesis: &Hypothesis<'_>,
    candidates: &[Candidate],
    levels: &[ColumnCurve],
    count: usize,
) -> Vec<HiddenLaw> {
    let rows = &hypothesis.data.search[..hypothesis.data.search.len().min(ROWS)];
    let search = hypothesis.evaluate(rows, hypothesis.offsets()).with_fitted_scatter();
    let of = |candidate: &Candidate| match candidate {
        Candidate::Part(part) if !part.is_stochastic() => Some(on_grid(hypothesis, *part, levels, &search)),
        _ => None,
    };
    let best_first = |laws: &mut Vec<HiddenLaw>| laws.sort_by(|a, b| b.score.total_cmp(&a.score));
    let mut found: Vec<Vec<HiddenLaw>> = candidates.par_iter().filter_map(of).collect();
    found.iter_mut().for_each(&best_first);
    found.retain(|places| !places.is_empty());
    found.sort_by(|a, b| b[0].score.total_cmp(&a[0].score));
    found.truncate(2 * count);
    let refine = |places: &Vec<HiddenLaw>| {
        let refined = places.iter().map(|start| start.refined(hypothesis, &search));
        refined.max_by(|a, b| a.score.total_cmp(&b.score))
    };
    let mut refined: Vec<HiddenLaw> = found.par_iter().filter_map(refine).collect();
    best_first(&mut refined);
    refined.truncate(count);
    refined
}

/// A law beside each of some levels, at the best place of a grid.
fn on_grid(
    hypothesis: &Hypothesis<'_>,
    part: Part,
    levels: &[ColumnCurve],
    search: &Evaluation<'_>,
) -> Vec<HiddenLaw> {
    let Some(axes) = part.axes(|input| search.data.range(input), false) else { return Vec::new() };
    let blank = FittedPart::middle(part, axes);
    let places = grid(blank.axes.len(), GRID_STEPS[blank.axes.len().min(GRID_STEPS.len() - 1)]);
    let best = |level: &ColumnCurve| {
        let law = |at: &Vec<f64>| FittedPart { at: at.clone(), ..blank.clone() };
        let of = places.iter().filter_map(|at| HiddenLaw::of(law(at), level, hypothesis, search));
        of.max_by(|a, b| a.score.total_cmp(&b.score))
    };
    levels.iter().filter_map(best).collect()
}

impl HiddenLaw {
    /// A law with a level as it fits best; `None` without a finite likelihood.
    fn of(
        law: FittedPart,
        level: &ColumnCurve,
        hypothesis: &Hypothesis<'_>,
        search: &Evaluation<'_>,
    ) -> Option<Self> {
        let parts = hypothesis.parts.iter().cloned().chain([law.clone()]).collect();
        let joint = Hypothesis { parts, ..hypothesis.clone() };
        let rows = joint.evaluate(&*search.rows, &*search.offsets).with_scatter(search.scatter);
        let (rows, fitted) = with_levels(rows, std::slice::from_ref(level));
        let score = rows.with_fitted_scatter().score();
        let level = fitted.into_iter().next().filter(|_| score.is_finite())?;
        Some(Self { law, level, score })
    }

    /// The same at the maximum nearby.
    fn refined(&self, hypothesis: &Hypothesis<'_>, search: &Evaluation<'_>) -> Self {
        let law = |at: &[f64]| FittedPart { at: at.to_vec(), ..self.law.clone() };
        let of = |at: &[f64]| Self::of(law(at), &self.level, hypothesis, search);
        let cost = |at: &[f64]| of(at).map_or(f64::INFINITY, |one| -one.score);
        let (at, _) = descend(cost, &self.law.at, 0.1, 20 * self.law.at.len() as u64 + 5);
        of(&at).unwrap_or_else(|| self.clone())
    }
}
