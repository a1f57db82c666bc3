//! What could be added beside the causes found so far: every effect whose inputs vary, the numbers
//! of the base model's own laws, levels, curves, thresholds of capture, and powers.

use super::super::part::{LawParameter, Part};
use super::addition::RigAddition;
use super::form::RigForm;
use super::inputs::RigInputs;
use super::noise::Data;
use crate::rig::{FARTHEST, Forward};
use nearwall::effect::CurveTarget;

/// How far beyond the range of an input a law's place is searched, as a share of the range.
const SEARCH_BEYOND: f64 = 0.5;
/// Least change of a reading by a number of the case, far off, that makes it a candidate [1].
const LEAST_CASE_CHANGE: f64 = 1e-3;
/// Whether a number of the case changes readings of the base law.
fn acts(forward: &dyn Forward, number: usize) -> bool {
    let changes = |widths: f64| {
        let of = move |experiment: usize| forward.case_change(experiment, number, widths);
        (0..forward.experiments().len()).flat_map(of).any(|[change, _]| change.abs() > LEAST_CASE_CHANGE)
    };
    [-FARTHEST, FARTHEST].into_iter().any(changes)
}

/// Everything that could be added.
pub(super) fn candidates(forward: &dyn Forward, inputs: &RigInputs, data: &Data) -> Vec<RigAddition> {
    let base = forward.base(0);
    // A transition may begin within the range of the data and have its middle beyond.
    let wider = |input: &str| {
        let [low, high] = inputs.range(input)?;
        let beyond = SEARCH_BEYOND * (high - low);
        Some([low - if low > beyond { beyond } else { 0.0 }, high + beyond])
    };
    // A layer or a film that is the same in all experiments acts nevertheless.
    let wider =
        |input: &str| wider(input).or_else(|| inputs.present(input).map(|value| [0.5 * value, 2.0 * value]));
    let mut all: Vec<RigAddition> =
        Part::all(base).into_iter().filter_map(|part| RigAddition::part(part, wider)).collect();
    let numbers =
        forward.case_numbers().iter().cloned().enumerate().filter(|(place, _)| acts(forward, *place));
    all.extend(numbers.map(|(place, number)| RigAddition::case(place, number)));
    let curves = inputs.curves();
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
        all.extend(curves.iter().map(|over| RigAddition::curve(on, Some(over.clone()))));
        let forms = |over| match on {
            CurveTarget::Capture => RigForm::thresholds(over),
            _ => RigForm::power(on, over).into_iter().collect(),
        };
        all.extend(curves.iter().flat_map(forms).map(|form| RigAddition::form(form, vec![0.5; 2])));
    }
    all
}
