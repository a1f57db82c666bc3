//! One round of the contest: every candidate is fitted to four fifths of the rows and scored on the last, five times over.
//!
//! A candidate's gain is the sum over rows of the difference in log score to the hypothesis that stands, each row scored
//! by a fit that did not see it. Its p-value is that of a paired t-test of these differences (one-sided, corrected for skewness); q-values are
//! Benjamini and Hochberg's over all candidates of the round, so the level is the share of false discoveries. A curve over
//! a column has a level too, which any column could carry: its test is against the level alone.

use std::collections::BTreeMap;

use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::data_split::DataSplit;
use super::forecast::Forecast;
use super::hypothesis::{Hypothesis, Observable, changes, standardised};
use super::likelihood::{Offset, Scatter, fit_scatter, score};
use super::part::{Fitted, Number, Part};
use super::search::{best_of_grid, descend};
use super::smooth::{Basis, Curve};
use super::unknown::Unknown;
use crate::dataset::Values;
use crate::effect::EFFECTS;

/// Gain on the rows of the fit [nats] below which a candidate is not worth a cross-validation.
const HOPELESS: f64 = 2.0;

/// Gain on the rows of the fit [nats] that each refinement of a law has to bring.
const REFINEMENT: f64 = 1.0;
/// Rows that the first search looks at.
const SOME_ROWS: usize = 250;
/// Places of the grid that a first descent starts from.
const STARTS: usize = 2;
/// Gain on these rows [nats] that a candidate has to show after the first descents.
const PROMISING: f64 = 0.3;

/// A coordinate nearer than this to 0 or 1 lies at an end.
const END: f64 = 0.03;
/// Largest correction for skewness, as a share of the mean.
const LARGEST_SKEW: f64 = 0.3;

/// What may be added to a hypothesis.
#[derive(Debug, Clone, Copy)]
pub(super) enum Candidate {
    /// An effect, or another value for a number of the base.
    Part(Part),
    /// A curve over a factor.
    Unknown {
        /// Place among the study's factors.
        factor: usize,
        /// What it acts on.
        observable: Observable,
    },
    /// Captures at a constant rate that nothing explains.
    BackgroundCapture,
    /// Scatter that changes with a factor.
    Noise {
        /// Place among the study's factors.
        factor: usize,
    },
}

/// A candidate with what the fit made of it.
#[derive(Debug, Clone)]
pub(super) enum Added {
    /// A part, and the parts that stood before as they fit best beside it.
    Part(Fitted, Vec<Fitted>),
    Unknown(Unknown),
    Noise(usize, f64),
    /// Log odds of capture that no column explains.
    BackgroundCapture(f64),
}

/// A candidate after the round.
#[derive(Debug, Clone)]
pub(super) struct ScoredCandidate {
    pub added: Added,
    /// Difference in log score of each row of [`DataSplit::search`].
    pub differences: Vec<f64>,
    /// Gain that is its own rather than that of a mere level [nats].
    pub own_gain: f64,
    pub p_value: f64,
    pub q_value: f64,
}

impl ScoredCandidate {
    /// Sum of the differences [nats].
    pub fn gain(&self) -> f64 {
        self.differences.iter().sum()
    }

    /// How many standard errors its gain lies above another's.
    pub fn lead(&self, other: &Self) -> f64 {
        let pairs = self.differences.iter().zip(&other.differences);
        t_statistic(&pairs.map(|(a, b)| a - b).collect::<Vec<_>>())
    }

    /// Count of its free numbers; those with a default refine a law and are not held against it.
    pub fn parameters(&self) -> usize {
        match &self.added {
            Added::Part(Fitted { part: Part::Effect(kind), .. }, _) => {
                kind.parameters.iter().filter(|parameter| parameter.default.is_none()).count()
            }
            Added::Part(fitted, _) => fitted.at.len(),
            Added::Unknown(unknown) => unknown.curve.heights.len(),
            Added::Noise(..) | Added::BackgroundCapture(_) => 1,
        }
    }

    /// Whether one of its parameters lies at an end of its range: such a fit stands for something simpler.
    pub fn at_an_end(&self) -> bool {
        let at_end = |at: &f64| !(END..=1.0 - END).contains(at);
        matches!(&self.added, Added::Part(fitted, _) if fitted.at.len() > 1 && fitted.at.iter().any(at_end))
    }
}

/// Gains of mere levels, row by row, by observable and whether they multiply.
type Levels = BTreeMap<(Observable, bool), Vec<f64>>;

/// The round as the hypothesis stands.
pub(super) struct Round<'a> {
    study: &'a DataSplit,
    hypothesis: &'a Hypothesis,
    shifts: Vec<Offset>,
    /// The hypothesis' forecast of [`DataSplit::search`].
    forecast: Forecast,
    /// The place of each row in the forecast.
    places: Vec<usize>,
    scatter: Scatter,
    score: f64,
    /// Each fold's scatter outside the fold, and the score of the fold's rows.
    folds: Vec<(Vec<usize>, Scatter, Vec<f64>)>,
}

impl<'a> Round<'a> {
    pub fn new(study: &'a DataSplit, hypothesis: &'a Hypothesis, first: Scatter) -> Self {
        let shifts = hypothesis.shifts(study);
        let forecast = Forecast::new(&hypothesis.model(study), &study.rows, &study.search, study.draws);
        let mut places = vec![usize::MAX; study.rows.len()];
        for (place, &row) in study.search.iter().enumerate() {
            places[row] = place;
        }
        let scatter = fit_scatter(&study.rows, &study.search, &forecast, &shifts, first);
        let mut round =
            Self { study, hypothesis, shifts, forecast, places, scatter, score: 0.0, folds: Vec::new() };
        round.score = round.scores(&study.search, &round.shifts, scatter).iter().sum();
        for (fold, rows) in study.folds.iter().enumerate() {
            let outside = study.outside(fold);
            let own = round.fit_scatter(&outside, &round.shifts);
            let scores = round.scores(rows, &round.shifts, own);
            round.folds.push((outside, own, scores));
        }
        round
    }

    /// The scatter about the hypothesis that stands.
    pub fn scatter(&self) -> Scatter {
        self.scatter
    }

    /// All candidates with their gains, those without hope left out; `done` is called after each.
    pub fn contenders(&self, done: &(dyn Fn() + Sync)) -> Vec<ScoredCandidate> {
        let candidates = self.candidates();
        let levels = self.levels();
        let mut contenders: Vec<ScoredCandidate> = candidates
            .par_iter()
            .filter_map(|&candidate| {
                let contender = self.contend(candidate, &levels);
                done();
                contender
            })
            .collect();
        let count = candidates.len();
        adjust(&mut contenders, count);
        contenders
    }

    fn candidates(&self) -> Vec<Candidate> {
        let study = self.study;
        let taken = |name: &str| self.hypothesis.parts.iter().any(|fitted| fitted.part.name() == name);
        let in_base = |id: &str| study.base.terms().iter().any(|term| term.kind().id == id);
        let effects = EFFECTS.iter().map(|kind| Part::Effect(kind));
        let numbers = [Number::NormalRestitution, Number::TangentialRestitution, Number::Friction];
        let numbers = numbers.into_iter().filter(|number| number.of(&study.base).is_some()).map(Part::Number);
        let parts = effects.chain(numbers).filter(|part| !taken(&part.name()) && !in_base(&part.name()));
        let plain = Forecast::new(&study.base, &study.rows, &study.search, 1);
        let parts = parts.filter(|part| self.shows(*part, &plain));
        let mut candidates: Vec<Candidate> = parts.map(Candidate::Part).collect();
        for factor in 0..study.factors.len() {
            for observable in Observable::ALL {
                // An input that a named effect turns on is not blamed again: what is left is the law's shape.
                if !self.observed(observable)
                    || self.hypothesis.turns_on(&study.factors[factor].name, observable)
                {
                    continue;
                }
                candidates.push(Candidate::Unknown { factor, observable });
            }
            let numeric = matches!(study.factors[factor].values, Values::Numbers(_));
            if numeric && !self.hypothesis.noise.iter().any(|&(other, _)| other == factor) {
                candidates.push(Candidate::Noise { factor });
            }
        }
        if self.hypothesis.lapses == 0.0 && self.observed(Observable::Capture) {
            candidates.push(Candidate::BackgroundCapture);
        }
        candidates
    }

    /// Whether a part, at the middle of its ranges, changes anything that was observed; `plain` is the base's forecast.
    fn shows(&self, part: Part, plain: &Forecast) -> bool {
        let Some(axes) = part.axes(self.study, false) else { return false };
        let middle = Fitted { part, at: vec![0.5; axes.len()], axes };
        let model = self.joined(&middle, &[]).model(self.study);
        let changed = Forecast::new(&model, &self.study.rows, &self.study.search, self.study.draws);
        changes(self.study, plain, &changed, self.scatter).iter().any(|change| *change > 0.0)
    }

    /// Whether there is enough of an observable for a curve.
    fn observed(&self, observable: Observable) -> bool {
        let rows = self.study.search.iter().map(|&row| &self.study.rows[row]);
        let values: Vec<f64> = rows
            .filter_map(|row| match observable {
                Observable::NormalRestitution => row.e_n.as_ref().map(|reading| reading.value),
                Observable::TangentialRestitution => row.e_t.as_ref().map(|reading| reading.value),
                Observable::Capture => row.captured,
            })
            .collect();
        values.len() >= 10 && values.iter().any(|value| *value != values[0])
    }

    fn contend(&self, candidate: Candidate, levels: &Levels) -> Option<ScoredCandidate> {
        let added = match candidate {
            Candidate::Part(part) => self.fit_part(part)?,
            Candidate::Unknown { factor, observable } => self.better_curve(factor, observable)?,
            Candidate::Noise { factor } => self.fit_noise(factor, &self.study.search, 0.0),
            Candidate::BackgroundCapture => Added::BackgroundCapture(self.fit_lapses(&self.study.search)?),
        };
        if self.gain_in_sample(&added) < HOPELESS {
            return None;
        }
        let differences = self.unseen(&added);
        let tested: Vec<f64> = match &added {
            Added::Unknown(unknown) => {
                let level = levels.get(&(unknown.observable, unknown.factorwise))?;
                differences.iter().zip(level).map(|(whole, level)| whole - level).collect()
            }
            _ => differences.clone(),
        };
        let own_gain = tested.iter().sum();
        let freedom = (tested.len() as f64 - 1.0).max(1.0);
        let t = t_statistic(&tested);
        let p_value = StudentsT::new(0.0, 1.0, freedom).map_or(1.0, |law| law.sf(t)).max(1e-300);
        Some(ScoredCandidate { added, differences, own_gain, p_value, q_value: 1.0 })
    }

    /// What a mere level gains in each observable, added or multiplied.
    fn levels(&self) -> Levels {
        let mut levels = Levels::new();
        for (observable, factorwise) in Observable::ALL.into_iter().flat_map(|o| [(o, false), (o, true)]) {
            let curve = Curve { basis: Basis::Level, heights: Vec::new() };
            let blank = Unknown { factor: 0, observable, factorwise, curve };
            let fitted = self.fit_unknown(&blank, &self.study.search, self.scatter);
            let gained = fitted.map(|unknown| self.unseen(&Added::Unknown(unknown)));
            levels.insert((observable, factorwise), gained.unwrap_or(vec![0.0; self.study.search.len()]));
        }
        levels
    }

    /// Gain of each row by fits that did not see it.
    fn unseen(&self, added: &Added) -> Vec<f64> {
        let mut differences = vec![0.0; self.study.search.len()];
        for (fold, (outside, scatter, before)) in self.study.folds.iter().zip(&self.folds) {
            let after = self.score_fold(added, outside, *scatter, fold);
            for ((row, after), before) in fold.iter().zip(after).zip(before) {
                differences[self.places[*row]] = after - before;
            }
        }
        differences
    }

    fn scores(&self, rows: &[usize], shifts: &[Offset], scatter: Scatter) -> Vec<f64> {
        let one = |&row: &usize| {
            score(&self.study.rows[row], self.forecast.of(self.places[row]), &shifts[row], scatter)
        };
        rows.iter().map(one).collect()
    }

    fn fit_scatter(&self, rows: &[usize], shifts: &[Offset]) -> Scatter {
        let forecast = self.forecast.of_places(rows.iter().map(|&row| self.places[row]));
        fit_scatter(&self.study.rows, rows, &forecast, shifts, self.scatter)
    }

    fn gain_in_sample(&self, added: &Added) -> f64 {
        let rows = &self.study.search;
        let after = match added {
            Added::Part(fitted, others) => {
                let joint = self.joined(fitted, others);
                self.joint_cost(&joint, rows)(&joint.coordinates())
            }
            Added::Unknown(unknown) => self.cost_with_shifts(&self.with_unknown(unknown), rows),
            Added::Noise(factor, change) => self.cost_with_shifts(&self.with_noise(*factor, *change), rows),
            Added::BackgroundCapture(odds) => self.cost_with_shifts(&self.with_lapses(*odds), rows),
        };
        -after - self.score
    }

    /// Scores of a fold's rows by a fit to the rows outside it.
    fn score_fold(&self, added: &Added, outside: &[usize], scatter: Scatter, fold: &[usize]) -> Vec<f64> {
        let nothing = Vec::new;
        match added {
            Added::Part(fitted, others) => {
                let joint = self.joined(fitted, others);
                let start = joint.coordinates();
                let rounds = 8 * start.len() as u64 + 7;
                let (at, _) = descend(self.joint_cost(&joint, outside), &start, 0.05, rounds);
                let refitted = joint.with_coordinates(&at);
                let fit = refitted.fit(self.study, outside, &self.shifts, scatter);
                refitted.row_scores(self.study, fold, &self.shifts, fit.scatter)
            }
            Added::Unknown(unknown) => match self.fit_unknown(unknown, outside, scatter) {
                Some(unknown) => {
                    let shifts = self.with_unknown(&unknown);
                    self.scores(fold, &shifts, self.fit_scatter(outside, &shifts))
                }
                None => nothing(),
            },
            Added::BackgroundCapture(_) => match self.fit_lapses(outside) {
                Some(odds) => self.scores(fold, &self.with_lapses(odds), scatter),
                None => nothing(),
            },
            Added::Noise(factor, change) => match self.fit_noise(*factor, outside, *change) {
                Added::Noise(factor, change) => {
                    let shifts = self.with_noise(factor, change);
                    self.scores(fold, &shifts, self.fit_scatter(outside, &shifts))
                }
                _ => nothing(),
            },
        }
    }

    /// Minus the log score as a function of a new part's coordinates.
    fn cost_of<'b>(&'b self, fitted: &'b Fitted, rows: &'b [usize]) -> impl Fn(&[f64]) -> f64 + 'b {
        let mut parts = self.hypothesis.parts.clone();
        parts.push(fitted.clone());
        move |at: &[f64]| {
            let mut parts = parts.clone();
            if let Some(last) = parts.last_mut() {
                at.clone_into(&mut last.at);
            }
            -self.hypothesis.fit_at(self.study, &parts, rows, &self.shifts, self.scatter).score
        }
    }

    fn cost_with_shifts(&self, shifts: &[Offset], rows: &[usize]) -> f64 {
        -self.scores(rows, shifts, self.fit_scatter(rows, shifts)).iter().sum::<f64>()
    }

    /// The part as it fits best; its refinements are free only where they are worth it.
    fn fit_part(&self, part: Part) -> Option<Added> {
        let plain = self.fit_with(part, false);
        let Part::Effect(kind) = part else { return plain };
        let refinements = kind.parameters.iter().filter(|parameter| parameter.default.is_some()).count();
        if refinements == 0 {
            return plain;
        }
        let refined = self.fit_with(part, true);
        let gain = |added: &Option<Added>| added.as_ref().map_or(0.0, |added| self.gain_in_sample(added));
        if gain(&refined) > gain(&plain) + REFINEMENT * refinements as f64 { refined } else { plain }
    }

    fn fit_with(&self, part: Part, refined: bool) -> Option<Added> {
        let axes = part.axes(self.study, refined)?;
        let dimensions = axes.len();
        let blank = Fitted { part, axes, at: vec![0.5; dimensions] };
        // Grid and first descents look at some rows only: they have to find the valley, not its floor.
        let some: Vec<usize> = self.study.search.iter().copied().take(SOME_ROWS).collect();
        let rounds = 20 * dimensions as u64 + 5;
        let cost = self.cost_of(&blank, &some);
        let starts = best_of_grid(&cost, dimensions, STARTS);
        let descents =
            starts.iter().map(|start| descend(&cost, start, 0.5 / starts.len().max(5) as f64, rounds));
        let (start, loss) = descents.min_by(|a, b| a.1.total_cmp(&b.1))?;
        let standing: f64 = self.scores(&some, &self.shifts, self.scatter).iter().sum();
        if loss > -standing - PROMISING {
            return None;
        }
        drop(cost);
        let (at, loss) = descend(self.cost_of(&blank, &self.study.search), &start, 0.06, rounds);
        let fitted = Fitted { at, ..blank };
        if self.hypothesis.parts.is_empty() || loss > -self.score {
            return Some(Added::Part(fitted, self.hypothesis.parts.clone()));
        }
        // The parts that stand make room for the new one.
        let joint = self.joined(&fitted, &self.hypothesis.parts);
        let start = joint.coordinates();
        let (at, _) =
            descend(self.joint_cost(&joint, &self.study.search), &start, 0.04, 20 * start.len() as u64);
        let mut parts = joint.with_coordinates(&at).parts;
        parts.pop().map(|fitted| Added::Part(fitted, parts))
    }

    /// The hypothesis with a new part beside others.
    fn joined(&self, fitted: &Fitted, others: &[Fitted]) -> Hypothesis {
        let parts = others.iter().chain([fitted]).cloned().collect();
        Hypothesis { parts, ..self.hypothesis.clone() }
    }

    /// Minus the log score as a function of all coordinates.
    fn joint_cost<'b>(&'b self, joint: &'b Hypothesis, rows: &'b [usize]) -> impl Fn(&[f64]) -> f64 + 'b {
        move |at: &[f64]| -joint.with_coordinates(at).fit(self.study, rows, &self.shifts, self.scatter).score
    }

    /// The curve over a factor, added or multiplied, whichever fits better.
    fn better_curve(&self, factor: usize, observable: Observable) -> Option<Added> {
        let basis = Basis::of(&self.study.factors[factor].values, &self.study.search)?;
        let fit = |factorwise| {
            let curve = Curve { basis: basis.clone(), heights: Vec::new() };
            let blank = Unknown { factor, observable, factorwise, curve };
            let added = Added::Unknown(self.fit_unknown(&blank, &self.study.search, self.scatter)?);
            Some((self.gain_in_sample(&added), added))
        };
        let multiplied = if observable == Observable::Capture { None } else { fit(true) };
        let better = fit(false).into_iter().chain(multiplied).max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(better.1)
    }

    /// The curve that the residuals of these rows ask for, over the factor and basis of `blank`.
    fn fit_unknown(&self, blank: &Unknown, rows: &[usize], scatter: Scatter) -> Option<Unknown> {
        let Unknown { factor, observable, factorwise, ref curve } = *blank;
        let forecast = self.forecast.of_places(rows.iter().map(|&row| self.places[row]));
        let blank = Unknown { factor, observable, factorwise, curve: curve.clone() };
        blank.fitted(self.study, rows, &forecast, &self.shifts, scatter)
    }

    fn with_unknown(&self, unknown: &Unknown) -> Vec<Offset> {
        let mut shifts = self.shifts.clone();
        unknown.add(self.study, &self.forecast, &self.study.search, &mut shifts);
        shifts
    }

    fn with_noise(&self, factor: usize, change: f64) -> Vec<Offset> {
        let mut shifts = self.shifts.clone();
        for (shift, z) in shifts.iter_mut().zip(standardised(&self.study.factors[factor].values)) {
            shift.spread *= (change * z).exp();
        }
        shifts
    }

    /// The log odds by which captures are more or less frequent than forecast.
    fn fit_lapses(&self, rows: &[usize]) -> Option<f64> {
        let curve = Curve { basis: Basis::Level, heights: Vec::new() };
        let blank = Unknown { factor: 0, observable: Observable::Capture, factorwise: false, curve };
        self.fit_unknown(&blank, rows, self.scatter)?.curve.heights.first().copied()
    }

    fn with_lapses(&self, odds: f64) -> Vec<Offset> {
        let mut shifts = self.shifts.clone();
        shifts.iter_mut().for_each(|shift| shift.capture += odds);
        shifts
    }

    fn fit_noise(&self, factor: usize, rows: &[usize], start: f64) -> Added {
        // The coordinate runs from a fall to a rise by e a standard deviation.
        let change = |at: f64| 2.0 * at - 1.0;
        let cost = |at: &[f64]| self.cost_with_shifts(&self.with_noise(factor, change(at[0])), rows);
        let (at, _) = descend(cost, &[0.5 * (start + 1.0)], 0.1, 20);
        Added::Noise(factor, change(at[0]))
    }
}

/// Mean over its standard error, corrected for skewness (Johnson 1978): a rare kind of impact gains much in few rows.
fn t_statistic(differences: &[f64]) -> f64 {
    let count = differences.len() as f64;
    let mean = differences.iter().sum::<f64>() / count;
    let moment = |power: i32| differences.iter().map(|d| (d - mean).powi(power)).sum::<f64>() / count;
    let (variance, third) = (moment(2), moment(3));
    if variance <= 0.0 {
        return 0.0;
    }
    let skew = third / (6.0 * variance * count) + third * mean * mean / (3.0 * variance * variance);
    // The correction is the first term of a series: where it is large, the mean is far from nought anyhow.
    let skew = skew.clamp(-LARGEST_SKEW * mean.abs(), LARGEST_SKEW * mean.abs());
    (mean + skew) / (variance / (count - 1.0).max(1.0)).sqrt()
}

/// Benjamini and Hochberg's q-values for `count` candidates, of which those without hope are not in the list.
fn adjust(contenders: &mut [ScoredCandidate], count: usize) {
    let mut order: Vec<usize> = (0..contenders.len()).collect();
    order.sort_by(|&a, &b| contenders[b].p_value.total_cmp(&contenders[a].p_value));
    let mut smallest = 1.0_f64;
    for (above, &index) in order.iter().enumerate() {
        let rank = contenders.len() - above;
        smallest = smallest.min(contenders[index].p_value * count as f64 / rank as f64);
        contenders[index].q_value = smallest;
    }
}
