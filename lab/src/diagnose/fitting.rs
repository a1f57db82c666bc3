//! One round: all candidates tested against the current hypothesis, and the promising ones fitted
//! to all rows of the search.
//!
//! With many readings the p-value is that of the score test ([`super::score_test`]); with few, that
//! of the fit: `F` of the fall of chi-square, or chi-square itself where stated errors explain the
//! rest. A candidate's gain is that of its fit in log likelihood, less its number of parameters
//! (Akaike 1974).

use std::cell::Cell;

use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, Normal};

use super::candidate::{Addition, Candidate, ScoredCandidate, t_statistic};
use super::chi_square;
use super::closed_form::forms;
use super::constant_capture::CaptureConstant;
use super::curve::{ColumnCurve, ColumnCurveForm};
use super::data_split::DataSplit;
use super::evaluation::Evaluation;
use super::few_rows::FewRows;
use super::hypothesis::{Hypothesis, ScatterTrend};
use super::observable::Observable;
use super::part::{FittedPart, Part};
use super::score_test::{self, Shapes, Tested, corrected};
use super::search::{best_of, descend};
use super::shapes::ShapeBuilder;
use super::smooth::Basis;
use nearwall::effect::EFFECTS;

/// Least gain [nats] of each parameter with a default that is fitted.
const REFINEMENT: f64 = 1.0;
/// Rows of the coarse search.
const COARSE_ROWS: usize = 250;
/// Candidates with a larger p-value, corrected for their own shapes, are not fitted, except for
/// curves, whose fits take no time.
const WORTH_A_FIT: f64 = 0.05;
/// A candidate that changes the distribution is fitted, too, if a place of its grid gains this much [nats].
const PROMISING_GAIN: f64 = 2.0;
/// Such a candidate is fitted if its grid gains this share of what the best other one does.
const NEAR_BEST: f64 = 0.5;
/// Least effective number of independent tests with few rows: the laws are several, whatever few rows say.
const FEW_TESTS: f64 = 8.0;
/// Coordinates at which a refinement starts.
const REFINED_STARTS: [f64; 3] = [0.15, 0.5, 0.85];

/// A round: the current hypothesis, which each candidate extends.
pub(super) struct CandidateRound<'a> {
    hypothesis: &'a Hypothesis<'a>,
    /// The rows of the search.
    search: Evaluation<'a>,
    scores: Vec<f64>,
    /// The test for few readings, if they are few.
    few: Option<FewRows>,
}

impl<'a> CandidateRound<'a> {
    pub fn new(hypothesis: &'a Hypothesis<'a>) -> Self {
        let data = hypothesis.data;
        let search = hypothesis.evaluate(&data.search, hypothesis.offsets()).with_fitted_scatter();
        let few = FewRows::of(&search);
        Self { hypothesis, scores: search.scores(), search, few }
    }

    fn data(&self) -> &'a DataSplit {
        self.hypothesis.data
    }

    /// Whether readings are few.
    pub fn is_few(&self) -> bool {
        self.few.is_some()
    }

    /// The promising ones of some candidates with their gains.
    pub fn score(&self, candidates: &[Candidate], done: &(dyn Fn(&str) + Sync)) -> Vec<ScoredCandidate> {
        let builder = ShapeBuilder::new(self.hypothesis, &self.search);
        let shapes: Vec<Shapes> = candidates.par_iter().map(|candidate| builder.shapes(*candidate)).collect();
        let units: Vec<usize> = self.search.rows.iter().map(|&row| self.data().units[row]).collect();
        let classes = self.few.is_some_and(|few| !few.alone);
        let tested = score_test::test(&shapes, &units, classes);
        let score = |(&candidate, tested): (&Candidate, &Tested)| {
            let scored = self.score_candidate(candidate, tested);
            done(&candidate.title(self.data()));
            scored
        };
        let stochastic =
            |pair: &(&Candidate, &Tested)| matches!(pair.0, Candidate::Part(part) if part.is_stochastic());
        let pairs = candidates.iter().zip(&tested);
        let (drawn, plain): (Vec<_>, Vec<_>) = pairs.partition(stochastic);
        let mut scored: Vec<ScoredCandidate> = plain.into_par_iter().filter_map(score).collect();
        // Fits with random draws take long: only of candidates that may become the best.
        let best = scored.iter().map(ScoredCandidate::gain).fold(0.0, f64::max);
        let rivals: Vec<_> = drawn.into_iter().filter(|(_, tested)| tested.gain > NEAR_BEST * best).collect();
        scored.extend(rivals.into_par_iter().filter_map(score).collect::<Vec<_>>());
        scored
    }

    /// What the candidate adds, fitted.
    fn fitted(&self, candidate: Candidate, tested: &Tested) -> Option<Addition> {
        match candidate {
            Candidate::Part(part) => self.fit_part(part, &tested.starts),
            Candidate::Curve { sides, observable } => self.better_curve(sides, observable),
            Candidate::ScatterTrend { covariate } => Some(Addition::ScatterTrend(self.fit_trend(covariate))),
            Candidate::Captures(constant) => self.fit_constant(constant),
        }
    }

    fn score_candidate(&self, candidate: Candidate, tested: &Tested) -> Option<ScoredCandidate> {
        let cheap = matches!(candidate, Candidate::Curve { sides: [_, None], .. } | Candidate::Captures(_))
            || self.is_whole_surface(candidate);
        let hopeless =
            !cheap && self.few.is_none() && tested.p_value > WORTH_A_FIT && tested.gain < PROMISING_GAIN;
        if tested.starts.is_empty() || hopeless {
            return None;
        }
        let addition = self.fitted(candidate, tested)?;
        let extended = addition.evaluate(self.hypothesis, &self.search).with_fitted_scatter();
        let freedom = addition.freedom();
        let differences = self.differences(&addition, &extended);
        let gain: f64 = differences.iter().sum();
        let own_gain = gain - self.level_gain(&addition);
        let raw = own_gain + freedom;
        if raw <= 0.0 {
            return None;
        }
        let p_value = match &self.few {
            Some(few) => {
                let curve = match &addition {
                    Addition::Curve(curve) => Some(curve.form.observable),
                    _ => None,
                };
                let p = few.p_value(&extended, freedom, raw, curve);
                if few.alone { p } else { p.max(tested.p_value) }
            }
            // Units that agree by accident make any t; the likelihood does not.
            None => tested.p_value.max(chance_of_gain(raw)),
        };
        let is_stochastic = matches!(&addition, Addition::Part { part, .. } if part.part.is_stochastic());
        let p_value = if is_stochastic { p_value.min(chance_of_mean(&differences)) } else { p_value };
        // Random signs of few rows do not tell candidates apart that more rows would.
        let least = if self.few.is_some_and(|few| few.alone) { FEW_TESTS } else { 1.0 };
        let q_value = corrected(p_value, tested.tests.max(least));
        Some(ScoredCandidate { addition, differences, own_gain, p_value, q_value, log_prior: 0.0 })
    }

    /// Whether it is a surface over columns on which nothing depends yet: its test is of the interplay alone.
    fn is_whole_surface(&self, candidate: Candidate) -> bool {
        let Candidate::Curve { sides: [Some(one), Some(two)], observable } = candidate else { return false };
        let known = self.hypothesis.columns_of(observable);
        !known.contains(&one) && !known.contains(&two)
    }

    /// Gain of each row, less its share of the number of parameters [nats].
    fn differences(&self, addition: &Addition, extended: &Evaluation<'_>) -> Vec<f64> {
        let penalty = addition.freedom() / self.scores.len() as f64;
        let pairs = extended.scores().into_iter().zip(&self.scores);
        pairs.map(|(after, before)| after - before - penalty).collect()
    }

    /// What a level shift gains of the gain of a curve [nats]; 0 for everything else.
    fn level_gain(&self, addition: &Addition) -> f64 {
        let Addition::Curve(curve) = addition else { return 0.0 };
        if curve.form.sides.is_empty() {
            return 0.0;
        }
        let level = ColumnCurveForm::level(curve.form.observable, curve.form.multiplicative);
        let gain = |level| self.fitted_gain(&Addition::Curve(level)) - 1.0;
        level.fit(&self.search).map_or(0.0, gain).max(0.0)
    }

    /// Gain on the rows of the search, without penalty [nats].
    fn fitted_gain(&self, addition: &Addition) -> f64 {
        let score = self.scores.iter().sum::<f64>();
        addition.evaluate(self.hypothesis, &self.search).with_fitted_scatter().score() - score
    }

    /// The part as it fits best; its parameters with a default are fitted only where they are worth it.
    fn fit_part(&self, part: Part, starts: &[Vec<f64>]) -> Option<Addition> {
        let plain = self.fit_parameters(part, false, starts)?;
        let Part::Effect(effect) = part else { return Some(plain) };
        let refinements = effect.parameters.iter().filter(|parameter| parameter.default.is_some()).count();
        if refinements == 0 || self.few.is_some() {
            return Some(plain);
        }
        let refined_starts = refined_starts(&plain, refinements);
        let Some(refined) = self.fit_parameters(part, true, &refined_starts) else { return Some(plain) };
        let better = self.fitted_gain(&refined) > self.fitted_gain(&plain) + REFINEMENT * refinements as f64;
        Some(if better { refined } else { plain })
    }

    fn fit_parameters(&self, part: Part, refined: bool, starts: &[Vec<f64>]) -> Option<Addition> {
        let parts = &self.hypothesis.parts;
        let blank = FittedPart::middle(part, part.axes(|input| self.data().range(input), refined)?);
        let joint = self.joint(&blank, parts);
        if blank.at.is_empty() {
            return split_last(joint);
        }
        let earlier = self.hypothesis.coordinates();
        let at_new = |at: &[f64]| [&earlier, at].concat();
        // The first descents use some rows only: they have to find the valley, not its floor.
        let some = self.search.select(&(0..self.search.rows.len().min(COARSE_ROWS)).collect::<Vec<_>>());
        let rounds = 20 * blank.at.len() as u64 + 5;
        let coarse = cost(&joint, &some);
        let coarse = |at: &[f64]| coarse(&at_new(at));
        // Those with a large t and those with a gain lie in other valleys; of a grid the best two are enough.
        let count = if refined { 2 } else { starts.len() };
        let descents =
            best_of(coarse, starts, count).into_iter().map(|start| descend(coarse, &start, 0.1, rounds));
        let (start, _) = descents.min_by(|a, b| a.1.total_cmp(&b.1))?;
        let fine = cost(&joint, &self.search);
        let (at, _) = descend(|at| fine(&at_new(at)), &start, 0.06, rounds);
        let joint = joint.with_coordinates(&at_new(&at));
        // With random draws the earlier parts are refitted only beside the one that joins.
        if parts.is_empty() || joint.is_stochastic() {
            return split_last(joint);
        }
        // The earlier parts are refitted beside the new one.
        let start = joint.coordinates();
        let (at, _) = descend(cost(&joint, &self.search), &start, 0.04, 20 * start.len() as u64);
        split_last(joint.with_coordinates(&at))
    }

    /// The hypothesis with a new part beside others.
    fn joint(&self, part: &FittedPart, others: &[FittedPart]) -> Hypothesis<'a> {
        Hypothesis { parts: others.iter().chain([part]).cloned().collect(), ..self.hypothesis.clone() }
    }

    /// The curve over some columns, added or multiplied, whichever fits better.
    fn better_curve(&self, sides: [Option<usize>; 2], observable: Observable) -> Option<Addition> {
        let columns: Vec<usize> = sides.into_iter().flatten().collect();
        let basis = |&column: &usize| {
            let values = self.data().values(column);
            let basis = if columns.len() > 1 {
                Basis::of_side(values, &self.search.rows)
            } else {
                Basis::of(values, &self.search.rows)
            };
            Some((column, basis?))
        };
        let sides = columns.iter().map(basis).collect::<Option<Vec<_>>>()?;
        let fit = |multiplicative| {
            let form = ColumnCurveForm { sides: sides.clone(), observable, multiplicative };
            let curve = form.fit(&self.search)?;
            Some((self.fitted_gain(&Addition::Curve(curve.clone())), curve))
        };
        let multiplied = if observable == Observable::Capture { None } else { fit(true) };
        let better = fit(false).into_iter().chain(multiplied).max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(Addition::Curve(self.closed_or_free(better)))
    }

    /// A curve with its gain [nats], or the closed form that has more evidence.
    fn closed_or_free(&self, (gain, free): (f64, ColumnCurve)) -> ColumnCurve {
        let readings = self.search.residuals(free.form.observable, false).len().max(2) as f64;
        // No form has fewer than two parameters. A free curve of capture misses a threshold that a few captures show.
        if gain < readings.ln() && free.form.observable != Observable::Capture {
            return free;
        }
        let worth = |gain: f64, freedom: f64| gain - 0.5 * freedom * readings.ln();
        // A threshold replaces the probability of capture, and with it what laws and curves do to it.
        let of = self.hypothesis;
        let is_capture = |curve: &ColumnCurve| curve.form.observable == Observable::Capture;
        if is_capture(&free)
            && (free.form.sides.is_empty()
                || !of.parts.is_empty()
                || of.curves.iter().any(is_capture)
                || self.has_law_of_capture(&free))
        {
            return free;
        }
        let best = forms(&free, &self.search).into_iter().next().map(|(closed, _)| free.closed_by(closed));
        let better = best.filter(|closed| {
            let addition = Addition::Curve(closed.clone());
            let form = worth(self.fitted_gain(&addition), closed.freedom) + addition.shape_prior();
            form > worth(gain, free.freedom)
        });
        better.unwrap_or(free)
    }

    /// Whether a law over the columns of a curve changes what is captured here: it is the form over them.
    fn has_law_of_capture(&self, curve: &ColumnCurve) -> bool {
        let laws = curve.form.laws(self.data());
        let effects = EFFECTS.into_iter().filter(|effect| laws.iter().any(|id| id == effect.id));
        let captures = |part: Part| {
            let axes = part.axes(|input| self.data().range(input), false)?;
            let with = self.joint(&FittedPart::middle(part, axes), &self.hypothesis.parts);
            let changes = self.hypothesis.changes(&self.hypothesis.forecast(), &with.forecast());
            Some(changes[Observable::Capture as usize] > 0.0)
        };
        effects.map(Part::Effect).any(|part| captures(part).unwrap_or(false))
    }

    /// A constant of captures; the parts are refitted beside a ceiling, without which they are too wide.
    fn fit_constant(&self, constant: CaptureConstant) -> Option<Addition> {
        let mut joint = self.hypothesis.clone();
        match constant {
            CaptureConstant::Rate => {
                let level = ColumnCurveForm::level(Observable::Capture, false);
                joint.captures.rate = level.fit(&self.search)?.heights.first().copied()?;
            }
            CaptureConstant::Ceiling => {
                joint.captures = joint.captures.free();
                let start = joint.coordinates();
                if !start.is_empty() && !joint.is_stochastic() {
                    let cost = cost(&joint, &self.search);
                    let (at, _) = descend(cost, &start, 0.06, 20 * start.len() as u64);
                    joint = joint.with_coordinates(&at);
                }
                let rows = joint.evaluate(&*self.search.rows, &*self.search.offsets);
                joint.captures = rows.with_scatter(self.search.scatter).with_fitted_scatter().captures;
            }
        }
        Some(Addition::Captures { constant, all: joint.captures, others: joint.parts })
    }

    /// The slope of the scatter that fits best, from -1 to 1.
    fn fit_trend(&self, covariate: usize) -> ScatterTrend {
        let trend = |at: f64| ScatterTrend { covariate, slope: 2.0 * at - 1.0 };
        let cost = |at: &[f64]| -self.fitted_gain(&Addition::ScatterTrend(trend(at[0])));
        let (at, _) = descend(cost, &[0.5], 0.1, 20);
        trend(at[0])
    }
}

/// Probability that one parameter gains this much in log likelihood [nats] by chance.
pub(super) fn chance_of_gain(gain: f64) -> f64 {
    (0.5 * chi_square::p_value(2.0 * gain.max(0.0), 1.0)).clamp(1e-300, 1.0)
}

/// Probability that the mean of a row's gain lies as far above 0 by chance.
fn chance_of_mean(differences: &[f64]) -> f64 {
    Normal::standard().sf(t_statistic(differences)).clamp(1e-300, 1.0)
}

/// The starts of a fit with refinements, from that without.
fn refined_starts(plain: &Addition, refinements: usize) -> Vec<Vec<f64>> {
    let Addition::Part { part, .. } = plain else { return Vec::new() };
    let mut starts = vec![part.at.clone()];
    for _ in 0..refinements {
        let longer = |start: Vec<f64>| REFINED_STARTS.map(|at| [start.as_slice(), &[at]].concat());
        starts = starts.into_iter().flat_map(longer).collect();
    }
    starts
}

/// Minus the log score of these rows as a function of all coordinates. The scatter is fitted from that of the last
/// place, which is near.
fn cost<'b>(joint: &'b Hypothesis<'_>, rows: &'b Evaluation<'_>) -> impl Fn(&[f64]) -> f64 + 'b {
    let last = Cell::new(rows.scatter);
    move |at| {
        let evaluation = joint.with_coordinates(at).evaluate(&*rows.rows, &*rows.offsets);
        let fitted = evaluation.with_scatter(last.get()).with_fitted_scatter();
        last.set(fitted.scatter);
        -fitted.score()
    }
}

/// The last part of a hypothesis as an addition to the others.
fn split_last(mut joint: Hypothesis<'_>) -> Option<Addition> {
    joint.parts.pop().map(|part| Addition::Part { part, others: joint.parts })
}
