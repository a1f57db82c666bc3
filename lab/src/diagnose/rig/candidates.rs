//! What could be added beside the causes found so far: every effect whose inputs vary, the numbers
//! of the base model's own laws, levels, and curves.

use super::super::part::{LawParameter, Part};
use super::addition::RigAddition;
use super::noise::Data;
use crate::rig::{FARTHEST, Forward};
use nearwall::effect::{CurveTarget, EFFECTS};
use nearwall::impact::{INPUTS, Impact};

/// How far beyond the range of an input a law's place is searched, as a share of the range.
const SEARCH_BEYOND: f64 = 0.5;
/// Least standard deviation of an input's mean over the experiments, as a share of its range, from
/// which on it is changed on purpose: for a curve over it.
const LEAST_INPUT_CHANGE: f64 = 0.05;
/// Least change of a reading by a number of the case, far off, that makes it a candidate [1].
const LEAST_CASE_CHANGE: f64 = 1e-3;
/// Correlation from which two inputs change together.
const TOGETHER: f64 = 0.98;

/// The range of an input over the first impacts of all experiments, without the outermost
/// hundredths; `None` if it does not vary.
pub(super) fn range(forward: &dyn Forward, input: &str) -> Option<[f64; 2]> {
    let sorted = sorted_values(forward, input)?;
    let at = |share: f64| sorted[((sorted.len() - 1) as f64 * share).round() as usize];
    let [low, high] = [at(0.005), at(0.995)];
    (high - low > 1e-6 * high.abs()).then_some([low, high])
}

/// The value of an input that does not vary and that an impact does not have by itself, as the thickness of a layer.
fn present(forward: &dyn Forward, input: &str) -> Option<f64> {
    let absent = INPUTS.iter().find(|one| one.name == input).map(|one| (one.value)(&Impact::default()))?;
    let value = *sorted_values(forward, input)?.first()?;
    (absent == 0.0 && value > 0.0).then_some(value)
}

fn sorted_values(forward: &dyn Forward, input: &str) -> Option<Vec<f64>> {
    let place = INPUTS.iter().position(|one| one.name == input)?;
    let all = (0..forward.experiments().len()).flat_map(|one| forward.input_values(one, place));
    let mut sorted: Vec<f64> = all.map(|(value, _)| value).filter(|value| value.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    (!sorted.is_empty()).then_some(sorted)
}

/// The inputs over which a curve could be seen, with its knots: those whose mean changes from
/// experiment to experiment. Of inputs that change together the first one.
fn curve_inputs(forward: &dyn Forward) -> Vec<(usize, Vec<f64>)> {
    let mut means_of_earlier: Vec<Vec<f64>> = Vec::new();
    let mut curves = Vec::new();
    for (place, input) in INPUTS.iter().enumerate() {
        let Some([low, high]) = range(forward, input.name) else { continue };
        let mut means = means(forward, place);
        if !changes(&means, [low, high]) || means_of_earlier.iter().any(|one| together(one, &means)) {
            continue;
        }
        means_of_earlier.push(means.clone());
        means.retain(|mean| mean.is_finite());
        means.sort_by(f64::total_cmp);
        let middle = means[means.len() / 2];
        let inside = middle > low + 0.1 * (high - low) && middle < high - 0.1 * (high - low);
        curves.push((place, vec![low, if inside { middle } else { 0.5 * (low + high) }, high]));
    }
    curves
}

/// The mean of an input, by place, over the first impacts of each experiment.
fn means(forward: &dyn Forward, place: usize) -> Vec<f64> {
    let mean = |experiment: usize| {
        let values = forward.input_values(experiment, place);
        let weight: f64 = values.iter().map(|(_, weight)| weight).sum();
        values.iter().map(|(value, weight)| value * weight).sum::<f64>() / weight
    };
    (0..forward.experiments().len()).map(mean).collect()
}

/// Whether an input with these means and this range changes from experiment to experiment.
fn changes(means: &[f64], [low, high]: [f64; 2]) -> bool {
    deviation(means) >= LEAST_INPUT_CHANGE * (high - low)
}

fn deviation(values: &[f64]) -> f64 {
    let finite: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    let mean = finite.iter().sum::<f64>() / finite.len().max(1) as f64;
    (finite.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / finite.len().max(1) as f64).sqrt()
}

/// Whether two inputs are correlated so well over the experiments that a curve over one is a curve over the other.
fn together(one: &[f64], other: &[f64]) -> bool {
    let centred = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        values.iter().map(|value| value - mean).collect::<Vec<f64>>()
    };
    let (a, b) = (centred(one), centred(other));
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    product(&a, &b).abs() > TOGETHER * (product(&a, &a) * product(&b, &b)).sqrt()
}

/// Inputs that vary over the impacts of an experiment, but not from one experiment to the other.
pub(super) fn unchanged_inputs(forward: &dyn Forward) -> Vec<&'static str> {
    let is_unchanged = |place: usize, name: &str| {
        range(forward, name).is_some_and(|range| !changes(&means(forward, place), range))
    };
    let inputs = INPUTS.iter().enumerate().filter(|(place, input)| is_unchanged(*place, input.name));
    inputs.map(|(_, input)| input.name).collect()
}

/// Whether a number of the case changes readings of the base law.
fn acts(forward: &dyn Forward, number: usize) -> bool {
    let changes = |widths: f64| {
        let of = move |experiment: usize| forward.case_change(experiment, number, widths);
        (0..forward.experiments().len()).flat_map(of).any(|change| change.abs() > LEAST_CASE_CHANGE)
    };
    [-FARTHEST, FARTHEST].into_iter().any(changes)
}

/// Everything that could be added.
pub(super) fn candidates(forward: &dyn Forward, data: &Data) -> Vec<RigAddition> {
    let ranges: Vec<(&str, Option<[f64; 2]>)> =
        INPUTS.iter().map(|input| (input.name, range(forward, input.name))).collect();
    let range_of = |input: &str| ranges.iter().find(|(name, _)| *name == input).and_then(|(_, range)| *range);
    let base = forward.base(0);
    let has = |id: &str| base.terms().iter().any(|term| term.kind().id == id);
    let effects = EFFECTS.into_iter().filter(|effect| !has(effect.id)).map(Part::Effect);
    let numbers = LawParameter::ALL.into_iter().filter(|parameter| parameter.of(base).is_some());
    let parts = effects.chain(numbers.map(Part::LawParameter));
    // A transition may begin within the range of the data and have its middle beyond.
    let wider = |input: &str| {
        let [low, high] = range_of(input)?;
        let beyond = SEARCH_BEYOND * (high - low);
        Some([low - if low > beyond { beyond } else { 0.0 }, high + beyond])
    };
    // A layer or a film that is the same in all experiments acts nevertheless.
    let wider = |input: &str| {
        wider(input).or_else(|| present(forward, input).map(|value| [0.5 * value, 2.0 * value]))
    };
    let mut all: Vec<RigAddition> = parts.filter_map(|part| RigAddition::part(part, wider)).collect();
    let numbers =
        forward.case_numbers().iter().cloned().enumerate().filter(|(place, _)| acts(forward, *place));
    all.extend(numbers.map(|(place, number)| RigAddition::case(place, number)));
    let curves = curve_inputs(forward);
    let measured = |part: &str| data.kinds.iter().any(|kind| kind.contains(part));
    let targets = [
        (CurveTarget::Capture, "capture", false),
        (CurveTarget::NormalRestitution, "e_n", LawParameter::NormalRestitution.of(base).is_some()),
        (CurveTarget::TangentialRestitution, "e_t", LawParameter::TangentialRestitution.of(base).is_some()),
    ];
    for (on, _, has_level) in targets.into_iter().filter(|(_, part, _)| measured(part)) {
        if !has_level {
            all.push(RigAddition::curve(on, None));
        }
        for (place, knots) in &curves {
            all.push(RigAddition::curve(on, Some((*place, knots.clone()))));
        }
    }
    all
}
