//! Five-fold cross-validation of all candidates of a round.
//!
//! The gain of a candidate is the sum over rows of the difference in log score to the current hypothesis, each row scored
//! by a fit that did not use it. The p-value is that of a one-sided paired t-test of these differences, corrected for
//! skewness; the q-values are those of Benjamini and Hochberg (1995) over all candidates of the round. A curve over a
//! column contains a constant offset, which a curve over any column would: it is tested against the constant alone.

use std::collections::BTreeMap;

use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::candidate::{Addition, Candidate, ScoredCandidate, t_statistic};
use super::curve::{ColumnCurve, CurveForm};
use super::data_split::{DataSplit, Fold};
use super::evaluation::Evaluation;
use super::forecast::Forecast;
use super::hypothesis::{Hypothesis, ScatterTrend};
use super::likelihood::Scatter;
use super::observable::Observable;
use super::part::{FittedPart, LawParameter, Part};
use super::search::{best_of_grid, descend};
use super::smooth::Basis;
use crate::dataset::Values;
use crate::effect::EFFECTS;

/// Least gain on the fitted rows [nats] of a candidate that is cross-validated.
const LEAST_FITTED_GAIN: f64 = 2.0;
/// Least gain on the fitted rows [nats] of each parameter with a default that is fitted.
const REFINEMENT: f64 = 1.0;
/// Rows of the coarse search.
const COARSE_ROWS: usize = 250;
/// Grid points from which a descent starts.
const STARTS: usize = 2;
/// Least gain on the rows of the coarse search [nats] of a candidate that is searched further.
const PROMISING: f64 = 0.3;
/// Least number of measurements for a curve.
const CURVE_ROWS: usize = 10;

/// Gains of constant offsets, row by row, by observable and whether they are multiplied.
type ConstantGains = BTreeMap<(Observable, bool), Vec<f64>>;

/// The rows of a fold under the current hypothesis.
struct FoldEvaluation<'a> {
    outside: Evaluation<'a>,
    /// With the scatter that fits the rows outside.
    inside: Evaluation<'a>,
    scores: Vec<f64>,
}

/// A round: the current hypothesis, which each candidate extends.
pub(super) struct Round<'a> {
    hypothesis: &'a Hypothesis<'a>,
    /// The rows of the search.
    search: Evaluation<'a>,
    score: f64,
    folds: Vec<FoldEvaluation<'a>>,
}

impl<'a> Round<'a> {
    pub fn new(hypothesis: &'a Hypothesis<'a>) -> Self {
        let data = hypothesis.data;
        let search = hypothesis.evaluate(&data.search, hypothesis.offsets());
        let fold = |fold: &Fold| {
            let outside = search.select(&fold.outside);
            let scatter = outside.clone().with_fitted_scatter().scatter;
            let inside = search.select(&fold.inside).with_scatter(scatter);
            FoldEvaluation { outside, scores: inside.scores(), inside }
        };
        Self { hypothesis, score: search.score(), folds: data.folds.iter().map(fold).collect(), search }
    }

    fn data(&self) -> &'a DataSplit {
        self.hypothesis.data
    }

    /// All candidates with their gains, without the hopeless ones; `done` is called after each.
    pub fn score_candidates(&self, done: &(dyn Fn() + Sync)) -> Vec<ScoredCandidate> {
        let candidates = self.candidates();
        let constants = self.constant_gains();
        let score = |&candidate: &Candidate| {
            let scored = self.score_candidate(candidate, &constants);
            done();
            scored
        };
        let mut scored: Vec<ScoredCandidate> = candidates.par_iter().filter_map(score).collect();
        set_q_values(&mut scored, candidates.len());
        scored
    }

    fn candidates(&self) -> Vec<Candidate> {
        let Hypothesis { data, parts, scatter_trends, .. } = self.hypothesis;
        let effects = EFFECTS.iter().map(|effect| Part::Effect(effect));
        let parameters = LawParameter::ALL.into_iter().filter(|parameter| parameter.of(&data.base).is_some());
        let taken = |name: String| {
            parts.iter().any(|part| part.part.name() == name)
                || data.base.terms().iter().any(|term| term.kind().id == name)
        };
        let base = Forecast::new(&data.base, &data.rows, &data.search, 1);
        let mut candidates: Vec<Candidate> = effects
            .chain(parameters.map(Part::LawParameter))
            .filter(|part| !taken(part.name()) && self.has_effect(*part, &base))
            .map(Candidate::Part)
            .collect();
        for (covariate, column) in data.covariates.iter().enumerate() {
            // An effect that depends on the input explains it; the rest is the discrepancy of its law.
            let open = |o: &Observable| self.varies(*o) && !self.hypothesis.explains(&column.name, *o);
            let observables = Observable::ALL.into_iter().filter(open);
            candidates.extend(observables.map(|observable| Candidate::Curve { covariate, observable }));
            let numeric = matches!(column.values, Values::Numbers(_));
            if numeric && !scatter_trends.iter().any(|trend| trend.covariate == covariate) {
                candidates.push(Candidate::ScatterTrend { covariate });
            }
        }
        if self.hypothesis.background_capture == 0.0 && self.varies(Observable::Capture) {
            candidates.push(Candidate::BackgroundCapture);
        }
        candidates
    }

    /// Whether a part, at the middle of its search ranges, changes anything that was measured.
    fn has_effect(&self, part: Part, base: &Forecast) -> bool {
        let Some(axes) = part.axes(self.data(), false) else { return false };
        let parts = vec![FittedPart::middle(part, axes)];
        let changed = Hypothesis::with_parts(self.data(), parts, self.hypothesis.scatter).forecast();
        self.hypothesis.changes(base, &changed).iter().any(|change| *change > 0.0)
    }

    /// Whether there are enough different measurements of an observable for a curve.
    fn varies(&self, observable: Observable) -> bool {
        let data = self.data();
        let measured = |&row: &usize| observable.measured(&data.rows[row]);
        let values: Vec<f64> = data.search.iter().filter_map(measured).collect();
        values.len() >= CURVE_ROWS && values.iter().any(|value| *value != values[0])
    }

    fn score_candidate(&self, candidate: Candidate, constants: &ConstantGains) -> Option<ScoredCandidate> {
        let addition = match candidate {
            Candidate::Part(part) => self.fit_part(part)?,
            Candidate::Curve { covariate, observable } => self.better_curve(covariate, observable)?,
            Candidate::ScatterTrend { covariate } => {
                Addition::ScatterTrend(self.fit_trend(ScatterTrend { covariate, slope: 0.0 }, &self.search))
            }
            Candidate::BackgroundCapture => fit_background(&self.search)?,
        };
        if self.fitted_gain(&addition) < LEAST_FITTED_GAIN {
            return None;
        }
        let differences = self.cross_validate(&addition);
        let tested: Vec<f64> = match &addition {
            Addition::Curve(ColumnCurve { form, .. }) => {
                let constant = constants.get(&(form.observable, form.multiplicative))?;
                differences.iter().zip(constant).map(|(whole, constant)| whole - constant).collect()
            }
            _ => differences.clone(),
        };
        let freedom = (tested.len() as f64 - 1.0).max(1.0);
        let t = t_statistic(&tested);
        let p_value = StudentsT::new(0.0, 1.0, freedom).map_or(1.0, |law| law.sf(t)).max(1e-300);
        Some(ScoredCandidate { addition, differences, own_gain: tested.iter().sum(), p_value, q_value: 1.0 })
    }

    fn constant_gains(&self) -> ConstantGains {
        let gain = |(observable, multiplicative)| {
            let form = CurveForm { covariate: 0, observable, multiplicative, basis: Basis::Constant };
            let gains = form.fit(&self.search).map(|curve| self.cross_validate(&Addition::Curve(curve)));
            ((observable, multiplicative), gains.unwrap_or(vec![0.0; self.search.rows.len()]))
        };
        let [e_n, e_t, capture] = Observable::ALL;
        [(e_n, false), (e_n, true), (e_t, false), (e_t, true), (capture, false)].map(gain).into()
    }

    /// Gain of each row of the search by fits that did not use it [nats]; 0 where there is no fit.
    fn cross_validate(&self, addition: &Addition) -> Vec<f64> {
        let mut differences = vec![0.0; self.search.rows.len()];
        for (places, fold) in self.data().folds.iter().zip(&self.folds) {
            let Some((refitted, scatter)) = self.refit(addition, fold) else { continue };
            let inside = refitted.evaluate(self.hypothesis, &fold.inside).with_scatter(scatter);
            for ((&place, after), before) in places.inside.iter().zip(inside.scores()).zip(&fold.scores) {
                differences[place] = after - before;
            }
        }
        differences
    }

    /// Gain on the rows of the search [nats].
    fn fitted_gain(&self, addition: &Addition) -> f64 {
        addition.evaluate(self.hypothesis, &self.search).with_fitted_scatter().score() - self.score
    }

    /// The addition fitted to the rows outside a fold, and the scatter there.
    fn refit(&self, addition: &Addition, fold: &FoldEvaluation<'_>) -> Option<(Addition, Scatter)> {
        let FoldEvaluation { outside, inside, .. } = fold;
        let with_own_scatter = || outside.clone().with_scatter(inside.scatter);
        let (refitted, start) = match addition {
            Addition::Part { part, others } => {
                let joint = self.joint(part, others);
                let start = joint.coordinates();
                let rounds = 8 * start.len() as u64 + 7;
                let (at, _) = descend(|at| cost(&joint, at, outside), &start, 0.05, rounds);
                (split_last(joint.with_coordinates(&at))?, with_own_scatter())
            }
            Addition::Curve(curve) => {
                (Addition::Curve(curve.form.clone().fit(&with_own_scatter())?), outside.clone())
            }
            Addition::ScatterTrend(trend) => {
                (Addition::ScatterTrend(self.fit_trend(*trend, outside)), outside.clone())
            }
            Addition::BackgroundCapture(_) => return Some((fit_background(outside)?, inside.scatter)),
        };
        let scatter = refitted.evaluate(self.hypothesis, &start).with_fitted_scatter().scatter;
        Some((refitted, scatter))
    }

    /// The part as it fits best; its parameters with a default are fitted only where they are worth it.
    fn fit_part(&self, part: Part) -> Option<Addition> {
        let plain = self.fit_parameters(part, false);
        let Part::Effect(effect) = part else { return plain };
        let refinements = effect.parameters.iter().filter(|parameter| parameter.default.is_some()).count();
        if refinements == 0 {
            return plain;
        }
        let refined = self.fit_parameters(part, true);
        let gain = |fitted: &Option<Addition>| fitted.as_ref().map_or(0.0, |fitted| self.fitted_gain(fitted));
        if gain(&refined) > gain(&plain) + REFINEMENT * refinements as f64 { refined } else { plain }
    }

    fn fit_parameters(&self, part: Part, refined: bool) -> Option<Addition> {
        let parts = &self.hypothesis.parts;
        let blank = FittedPart::middle(part, part.axes(self.data(), refined)?);
        let joint = self.joint(&blank, parts);
        let earlier = self.hypothesis.coordinates();
        let at_new = |at: &[f64]| [&earlier, at].concat();
        // Grid and first descents use some rows only: they have to find the valley, not its floor.
        let some = self.search.select(&(0..self.search.rows.len().min(COARSE_ROWS)).collect::<Vec<_>>());
        let rounds = 20 * blank.at.len() as u64 + 5;
        let coarse = |at: &[f64]| cost(&joint, &at_new(at), &some);
        let starts = best_of_grid(coarse, blank.at.len(), STARTS);
        let size = 0.5 / starts.len().max(5) as f64;
        let descents = starts.iter().map(|start| descend(coarse, start, size, rounds));
        let (start, loss) = descents.min_by(|a, b| a.1.total_cmp(&b.1))?;
        if loss > -some.score() - PROMISING {
            return None;
        }
        let (at, loss) = descend(|at| cost(&joint, &at_new(at), &self.search), &start, 0.06, rounds);
        let joint = joint.with_coordinates(&at_new(&at));
        if parts.is_empty() || loss > -self.score {
            return split_last(joint);
        }
        // The earlier parts are refitted beside the new one.
        let start = joint.coordinates();
        let (at, _) = descend(|at| cost(&joint, at, &self.search), &start, 0.04, 20 * start.len() as u64);
        split_last(joint.with_coordinates(&at))
    }

    /// The hypothesis with a new part beside others.
    fn joint(&self, part: &FittedPart, others: &[FittedPart]) -> Hypothesis<'a> {
        Hypothesis { parts: others.iter().chain([part]).cloned().collect(), ..self.hypothesis.clone() }
    }

    /// The curve over a covariate, added or multiplied, whichever fits better.
    fn better_curve(&self, covariate: usize, observable: Observable) -> Option<Addition> {
        let basis = Basis::of(self.data().values(covariate), &self.search.rows)?;
        let fit = |multiplicative| {
            let form = CurveForm { covariate, observable, multiplicative, basis: basis.clone() };
            let curve = Addition::Curve(form.fit(&self.search)?);
            Some((self.fitted_gain(&curve), curve))
        };
        let multiplied = if observable == Observable::Capture { None } else { fit(true) };
        let better = fit(false).into_iter().chain(multiplied).max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(better.1)
    }

    /// The slope that fits these rows best, from -1 to 1.
    fn fit_trend(&self, start: ScatterTrend, rows: &Evaluation<'_>) -> ScatterTrend {
        let trend = |at: f64| ScatterTrend { slope: 2.0 * at - 1.0, ..start };
        let cost = |at: &[f64]| {
            let addition = Addition::ScatterTrend(trend(at[0]));
            -addition.evaluate(self.hypothesis, rows).with_fitted_scatter().score()
        };
        let (at, _) = descend(cost, &[0.5 * (start.slope + 1.0)], 0.1, 20);
        trend(at[0])
    }
}

/// Minus the log score of these rows as a function of all coordinates.
fn cost(joint: &Hypothesis<'_>, at: &[f64], rows: &Evaluation<'_>) -> f64 {
    -joint.with_coordinates(at).evaluate(&*rows.rows, &*rows.offsets).with_fitted_scatter().score()
}

/// The last part of a hypothesis as an addition to the others.
fn split_last(mut joint: Hypothesis<'_>) -> Option<Addition> {
    joint.parts.pop().map(|part| Addition::Part { part, others: joint.parts })
}

/// The log odds by which captures are more or less frequent than predicted.
fn fit_background(rows: &Evaluation<'_>) -> Option<Addition> {
    let observable = Observable::Capture;
    let form = CurveForm { covariate: 0, observable, multiplicative: false, basis: Basis::Constant };
    form.fit(rows)?.heights.first().copied().map(Addition::BackgroundCapture)
}

/// The q-values of Benjamini and Hochberg for `count` candidates, of which the hopeless are not listed.
fn set_q_values(scored: &mut [ScoredCandidate], count: usize) {
    let mut order: Vec<usize> = (0..scored.len()).collect();
    order.sort_by(|&a, &b| scored[b].p_value.total_cmp(&scored[a].p_value));
    let mut smallest = 1.0_f64;
    for (above, &index) in order.iter().enumerate() {
        let rank = scored.len() - above;
        smallest = smallest.min(scored[index].p_value * count as f64 / rank as f64);
        scored[index].q_value = smallest;
    }
}
