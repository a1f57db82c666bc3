//! The shapes of candidates: how each would change the log score of every row, to first order in its amplitude.

use std::sync::Arc;

use super::candidate::Candidate;
use super::constant_capture::CaptureConstant;
use super::curve::ColumnCurveForm;
use super::data_split::standardised;
use super::evaluation::{Evaluation, Slope};
use super::forecast::Forecast;
use super::hypothesis::{Hypothesis, ScatterTrend};
use super::likelihood::{Mean, Offset, mean};
use super::observable::Observable;
use super::part::{FittedPart, Part};
use super::score_test::Shapes;
use super::search::grid;
use super::smooth::Basis;
use crate::dataset::ColumnValues;

/// Largest ratio of likelihoods under two distributions, so that no single row decides.
const LARGEST_LIKELIHOOD_RATIO: f64 = 20.0;
/// Places along each coordinate of a grid, by their number.
const GRID_STEPS: [usize; 5] = [1, 16, 8, 4, 3];
/// Largest square of a standardised residual.
const LARGEST_SQUARE: f64 = 9.0;

/// Builds shapes about the current hypothesis.
pub(super) struct ShapeBuilder<'a, 'b> {
    hypothesis: &'b Hypothesis<'a>,
    search: &'b Evaluation<'a>,
    scores: Vec<f64>,
    slopes: Vec<Slope>,
    /// Slopes with the measured share of captures.
    level_slopes: Vec<Slope>,
    /// Predictions without offsets.
    means: Vec<Mean>,
}

impl<'a, 'b> ShapeBuilder<'a, 'b> {
    pub fn new(hypothesis: &'b Hypothesis<'a>, search: &'b Evaluation<'a>) -> Self {
        let slopes = search.slopes();
        let level = ColumnCurveForm::level(Observable::Capture, false).fit(search);
        let level_slopes = level.map_or_else(
            || slopes.clone(),
            |level| {
                let mut offsets = search.offsets.to_vec();
                level.add_to(&mut offsets, search);
                search.with_offsets(offsets).slopes()
            },
        );
        let plain = Forecast::of_data(&hypothesis.model(), search.data, &search.rows);
        let means = (0..search.rows.len()).map(|place| mean(plain.of(place), &Offset::default())).collect();
        Self { hypothesis, search, scores: search.scores(), slopes, level_slopes, means }
    }

    /// The shapes of a candidate; none if it changes nothing that was measured.
    pub fn shapes(&self, candidate: Candidate) -> Shapes {
        let mut shapes = match candidate {
            Candidate::Part(part) => self.of_part(part),
            Candidate::Curve { sides, observable } => self.of_curve(sides, observable),
            Candidate::ScatterTrend { covariate } => self.of_trend(covariate),
            Candidate::Captures(constant) => self.of_constant(constant),
        };
        let alive: Vec<bool> = shapes.scores.iter().map(|u| u.iter().any(|u| *u != 0.0)).collect();
        let mut keep = alive.iter();
        shapes.scores.retain(|_| *keep.next().unwrap_or(&false));
        let mut keep = alive.iter();
        shapes.at.retain(|_| *keep.next().unwrap_or(&false));
        let mut keep = alive.iter();
        shapes.gains.retain(|_| *keep.next().unwrap_or(&false));
        shapes
    }

    fn of_part(&self, part: Part) -> Shapes {
        let Some(axes) = part.axes(|input| self.search.data.range(input), false) else {
            return Shapes::default();
        };
        let blank = FittedPart::middle(part, axes);
        let both_signs = matches!(part, Part::LawParameter(_));
        let at = grid(blank.axes.len(), GRID_STEPS[blank.axes.len().min(GRID_STEPS.len() - 1)]);
        let place = |at: &Vec<f64>| FittedPart { at: at.clone(), ..blank.clone() };
        let of = |at: &Vec<f64>| {
            if part.is_stochastic() { self.of_distribution(&place(at)) } else { self.of_place(&place(at)) }
        };
        let (scores, gains) = at.iter().map(of).unzip();
        Shapes { both_signs, at, scores, gains, is_random: part.is_stochastic() }
    }

    /// The hypothesis with a part more.
    fn with(&self, part: &FittedPart) -> Hypothesis<'a> {
        let parts = self.hypothesis.parts.iter().chain([part]).cloned().collect();
        Hypothesis { parts, ..self.hypothesis.clone() }
    }

    /// The shape of a part that changes the distribution, and its gain.
    fn of_distribution(&self, part: &FittedPart) -> (Vec<f64>, f64) {
        let evaluation = self.with(part).evaluate(&*self.search.rows, &*self.search.offsets);
        let scores = evaluation.with_scatter(self.search.scatter).scores();
        let ratio =
            |(after, before): (&f64, &f64)| (after - before).exp().min(LARGEST_LIKELIHOOD_RATIO) - 1.0;
        let gain = scores.iter().sum::<f64>() - self.scores.iter().sum::<f64>();
        (scores.iter().zip(&self.scores).map(ratio).collect(), gain)
    }

    /// The shape of a part at one place, and its gain.
    fn of_place(&self, part: &FittedPart) -> (Vec<f64>, f64) {
        let changed = self.with(part);
        let forecast = Forecast::of_data(&changed.model(), self.search.data, &self.search.rows);
        let one = |(place, slope): (usize, &Slope)| {
            let (before, after) = (&self.means[place], mean(forecast.of(place), &Offset::default()));
            let change = |which: usize| after.restitution[which] - before.restitution[which];
            slope.restitution[0] * change(0)
                + slope.restitution[1] * change(1)
                + slope.capture * (after.capture - before.capture)
        };
        let scores = self.slopes.iter().enumerate().map(one).collect();
        let Evaluation { data, rows, offsets, scatter, captures, .. } = self.search;
        let evaluation = Evaluation::of_forecast(data, Arc::new(forecast), &**rows, &**offsets, *scatter);
        let gain = evaluation.with_captures(*captures).score() - self.scores.iter().sum::<f64>();
        (scores, gain)
    }

    fn of_curve(&self, sides: [Option<usize>; 2], observable: Observable) -> Shapes {
        let which = observable as usize;
        let slopes = if observable == Observable::Capture { &self.level_slopes } else { &self.slopes };
        let slope = |place: usize| {
            slopes[place].restitution.get(which).copied().unwrap_or_else(|| self.in_odds(place))
        };
        let information = |place: usize| match observable {
            Observable::Capture => slopes[place].information[2].recip(),
            _ => slopes[place].information[which],
        };
        let usable = |weight: f64| if weight.is_finite() { weight } else { 0.0 };
        let weights: Vec<f64> = (0..slopes.len()).map(|place| usable(information(place))).collect();
        let total: f64 = weights.iter().sum();
        if total <= 0.0 {
            return Shapes::default();
        }
        let functions = match sides {
            [None, None] => vec![vec![1.0; slopes.len()], self.predicted(observable)],
            [Some(column), None] | [None, Some(column)] => self.functions(column),
            [Some(one), Some(two)] => self.product(one, two),
        };
        let centred = |function: &Vec<f64>| {
            // A level is another candidate.
            let mean = if sides == [None; 2] {
                0.0
            } else {
                function.iter().zip(&weights).map(|(f, w)| f * w).sum::<f64>() / total
            };
            function.iter().enumerate().map(|(place, f)| slope(place) * (f - mean)).collect::<Vec<f64>>()
        };
        let scores: Vec<Vec<f64>> = functions.iter().map(centred).collect();
        Shapes { both_signs: true, at: vec![Vec::new(); scores.len()], scores, ..Shapes::default() }
    }

    /// The slope by the log odds of capture.
    fn in_odds(&self, place: usize) -> f64 {
        let Slope { capture, information, .. } = self.level_slopes[place];
        if information[2] > 0.0 { capture / information[2] } else { 0.0 }
    }

    fn predicted(&self, observable: Observable) -> Vec<f64> {
        self.means.iter().map(|mean| observable.predicted(mean)).collect()
    }

    /// Functions of one column: powers, ranks, logarithm and hats, or one for each label.
    fn functions(&self, column: usize) -> Vec<Vec<f64>> {
        let values = self.search.data.values(column);
        let rows = &self.search.rows;
        let Some(basis) = Basis::of(values, rows) else { return Vec::new() };
        let hat = |which: usize| {
            let height = |&row: &usize| {
                basis
                    .entry(values, row)
                    .iter()
                    .find(|(place, _)| *place == which)
                    .map_or(0.0, |(_, share)| *share)
            };
            rows.iter().map(height).collect::<Vec<f64>>()
        };
        let mut functions: Vec<Vec<f64>> = (0..basis.len()).map(hat).collect();
        if let ColumnValues::Numbers(numbers) = values {
            let x = standardised(rows.iter().map(|&row| numbers[row]));
            functions.extend([1, 2, 3].map(|power| x.iter().map(|x| x.powi(power)).collect::<Vec<f64>>()));
            functions.push(ranks(&x));
            if rows.iter().all(|&row| numbers[row] > 0.0) {
                functions.push(standardised(rows.iter().map(|&row| numbers[row].ln())));
            }
        }
        let blank = |&row: &usize| self.search.data.covariates.get(column).is_some_and(|one| one.blank[row]);
        let blank: Vec<bool> = rows.iter().map(blank).collect();
        if blank.contains(&true) {
            functions.iter_mut().for_each(|function| level_blanks(function, &blank));
        }
        functions
    }

    /// The product of two columns, by value and by rank.
    fn product(&self, one: usize, two: usize) -> Vec<Vec<f64>> {
        let column = |index: usize| match self.search.data.values(index) {
            ColumnValues::Numbers(numbers) => {
                Some(standardised(self.search.rows.iter().map(|&row| numbers[row])))
            }
            ColumnValues::Labels { .. } => None,
        };
        let (Some(a), Some(b)) = (column(one), column(two)) else { return Vec::new() };
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).collect::<Vec<f64>>();
        vec![product(&a, &b), product(&ranks(&a), &ranks(&b))]
    }

    fn of_trend(&self, covariate: usize) -> Shapes {
        let z = ScatterTrend { covariate, slope: 1.0 }.standardised(self.search.data);
        let square = |slope: &Slope| {
            let one = |which: usize| {
                let information = slope.information[which];
                (information > 0.0)
                    .then(|| (slope.restitution[which].powi(2) / information).min(LARGEST_SQUARE))
            };
            [one(0), one(1)]
        };
        let squares: Vec<[Option<f64>; 2]> = self.slopes.iter().map(square).collect();
        let mean = |which: usize| {
            let known: Vec<f64> = squares.iter().filter_map(|both| both[which]).collect();
            known.iter().sum::<f64>() / known.len().max(1) as f64
        };
        let means = [mean(0), mean(1)];
        let one = |(both, &row): (&[Option<f64>; 2], &usize)| {
            let excess = |which: usize| both[which].map_or(0.0, |square| square - means[which]);
            z[row] * (excess(0) + excess(1))
        };
        let scores = vec![squares.iter().zip(self.search.rows.iter()).map(one).collect()];
        Shapes { both_signs: true, at: vec![Vec::new()], scores, ..Shapes::default() }
    }

    fn of_constant(&self, constant: CaptureConstant) -> Shapes {
        let one = |(slope, mean): (&Slope, &Mean)| match constant {
            CaptureConstant::Rate if slope.information[2] > 0.0 => slope.capture / slope.information[2],
            CaptureConstant::Rate => 0.0,
            CaptureConstant::Ceiling => -slope.capture * mean.capture,
        };
        let scores = vec![self.slopes.iter().zip(&self.means).map(one).collect()];
        Shapes {
            both_signs: constant == CaptureConstant::Rate,
            at: vec![Vec::new()],
            scores,
            ..Shapes::default()
        }
    }
}

/// Gives rows with a blank cell the mean of the function over the others.
fn level_blanks(function: &mut [f64], blank: &[bool]) {
    let stated = || function.iter().zip(blank).filter(|(_, blank)| !**blank).map(|(value, _)| *value);
    let mean = stated().sum::<f64>() / stated().count().max(1) as f64;
    function.iter_mut().zip(blank).filter(|(_, blank)| **blank).for_each(|(value, _)| *value = mean);
}

/// Ranks from -1 to 1; equal values have equal ranks.
fn ranks(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let rank = |value: &f64| {
        let (below, up_to) = (sorted.partition_point(|v| v < value), sorted.partition_point(|v| v <= value));
        (below + up_to) as f64 / sorted.len() as f64 - 1.0
    };
    values.iter().map(rank).collect()
}
