//! Closed forms with two parameters over an input or a group, in the place of a curve with three knots.
//!
//! A form of `e_n` or `e_t` is a factor on the base model's, found by its value at one or two places of the range and
//! the parameter in which it is not linear. Captures have a threshold with a width, which replaces the base model's
//! probability. Forms with more parameters would need more than the readings of a rig hold.

use nearwall::effect::{CurveTarget, FORMS, FittedForm, FormInfo, Operation};

use super::super::closed_form::{BEYOND, ClosedForm, EXPONENTS, STEEPNESS};
use super::super::observable::Observable;
use super::super::search::{SearchAxis, best_of, descend, grid};
use super::addition::RESTITUTION_REACH;
use super::inputs::Over;

/// Places of each parameter at which a form is compared with a curve, and rounds and simplex of the descent from them.
const COMPARED: usize = 15;
const ROUNDS: u64 = 100;
const SIMPLEX: f64 = 0.04;
/// Places of the threshold and of its steepness at which captures are predicted.
const THRESHOLDS: [usize; 2] = [12, 3];
/// Factors in the middle of the range, and exponents, at which a power is predicted.
const FACTORS: [f64; 6] = [0.4, 0.6, 0.8, 0.92, 1.0, 1.1];
const POWERS: [f64; 8] = [-1.2, -0.4, -0.15, -0.05, 0.05, 0.15, 0.4, 1.2];
/// A range whose ends differ by more than this factor is wide: three knots do not show a power over it [1].
const WIDE: f64 = 10.0;
/// Places at which a form is compared with others.
const SHOWN: usize = 5;
/// Least place of a threshold or a scale, where the range begins at 0, as a share of its end [1].
const LEAST_SCALE: f64 = 0.02;

/// A form over an input or a group.
#[derive(Debug, Clone)]
pub(super) struct RigForm {
    pub on: CurveTarget,
    pub over: Over,
    info: &'static FormInfo,
    /// Whether it is a threshold beyond which less is captured.
    falls: bool,
    /// The forms that were tried, with the logarithm of the evidence of each [nats].
    pub tried: Vec<(&'static str, f64)>,
}

impl RigForm {
    fn new(on: CurveTarget, over: &Over, name: &str, falls: bool) -> Option<Self> {
        let info = FormInfo::from_name(name)?;
        Some(Self { on, over: over.clone(), info, falls, tried: Vec::new() })
    }

    /// Thresholds of capture that rise and fall; none over an input with values below 0.
    pub fn thresholds(over: &Over) -> Vec<Self> {
        if over.seen[0] < 0.0 {
            return Vec::new();
        }
        let one = |falls| Self::new(CurveTarget::Capture, over, "logistic", falls);
        [false, true].into_iter().filter_map(one).collect()
    }

    /// The power of `e_n` or `e_t` over an input or group with a wide range.
    pub fn power(on: CurveTarget, over: &Over) -> Option<Self> {
        let [low, high] = over.seen;
        let is_wide = low > 0.0 && high > WIDE * low;
        is_wide.then(|| Self::new(on, over, "power", false)).flatten()
    }

    /// The forms of `e_n` or `e_t` that come near factors on it at some places, with their coordinates.
    pub fn near(on: CurveTarget, over: &Over, factors: &[[f64; 2]]) -> Vec<(Self, Vec<f64>)> {
        let [low, high] = over.seen;
        let is_offered = |info: &&FormInfo| match info.name {
            "line" | "exponential" => true,
            "power" => low > 0.0,
            "saturating" => low >= 0.0 && high > 0.0,
            _ => false,
        };
        let forms = FORMS.iter().filter(is_offered).filter_map(|info| Self::new(on, over, info.name, false));
        forms.map(|form| (form.nearest(factors), form)).map(|(at, form)| (form, at)).collect()
    }

    /// The coordinates at which it comes nearest to values at some places.
    fn nearest(&self, values: &[[f64; 2]]) -> Vec<f64> {
        let axes = self.axes();
        let misfit = |at: &[f64]| {
            let found: Vec<f64> = axes.iter().zip(at).map(|(axis, at)| axis.value(*at)).collect();
            let parameters = self.parameters(&found);
            values.iter().map(|[x, value]| (self.info.value(&parameters, *x) - value).powi(2)).sum::<f64>()
        };
        // The descent ends at differences of its cost that matter to a likelihood.
        let cost = |at: &[f64]| 1e4 * misfit(at);
        let start = best_of(cost, &grid(axes.len(), COMPARED), 1).into_iter().next();
        start.map_or_else(|| vec![0.5; axes.len()], |start| descend(cost, &start, SIMPLEX, ROUNDS).0)
    }

    /// Its name in model files.
    pub fn name(&self) -> &'static str {
        self.info.name
    }

    /// What is searched: values at places of the range, and the parameters in which the form is not linear.
    pub fn axes(&self) -> Vec<SearchAxis> {
        let [low, high] = self.over.seen;
        let value = SearchAxis::linear(1.0 - RESTITUTION_REACH, 1.0 + RESTITUTION_REACH);
        let least = low.max(LEAST_SCALE * high);
        match self.info.name {
            "line" => vec![value; 2],
            "power" => vec![value, SearchAxis::linear(EXPONENTS[0], EXPONENTS[1])],
            "logistic" => vec![
                SearchAxis::logarithmic(least, high),
                SearchAxis::logarithmic(STEEPNESS[0], STEEPNESS[1]),
            ],
            _ => vec![value, SearchAxis::logarithmic(least, BEYOND * high)],
        }
    }

    /// Places of these axes at which it is looked at first.
    pub fn places(&self) -> Vec<Vec<f64>> {
        if let ("power", [factor, power]) = (self.info.name, &self.axes()[..]) {
            let with = |value: f64| POWERS.map(|one| vec![factor.coordinate(value), power.coordinate(one)]);
            return FACTORS.into_iter().flat_map(with).collect();
        }
        let [places, widths] = THRESHOLDS;
        let middle = |place: usize, count: usize| (place as f64 + 0.5) / count as f64;
        let of =
            |place: usize| (0..widths).map(move |width| vec![middle(place, places), middle(width, widths)]);
        (0..places).flat_map(of).collect()
    }

    /// The parameters of the form, from the values on the axes.
    pub fn parameters(&self, values: &[f64]) -> Vec<f64> {
        let &[first, second] = values else { return Vec::new() };
        let [low, high] = self.over.seen;
        match self.info.name {
            "line" => {
                let slope = (second - first) / (high - low);
                vec![first - slope * low, slope]
            }
            "power" => vec![first / (low * high).sqrt().powf(second), second],
            "exponential" => vec![first * (low / second).exp(), second, 0.0],
            "saturating" => vec![first * (high + second) / high, second, 0.0],
            _ => vec![first, if self.falls { -second } else { second }, 0.0, 1.0],
        }
    }

    /// Its values at some places of the range, as factors.
    pub fn factors(&self, parameters: &[f64]) -> Vec<[f64; 2]> {
        let [low, high] = self.over.seen;
        let share = |place: usize| place as f64 / (SHOWN - 1) as f64;
        let at = |place: usize| {
            if low > 0.0 { low * (high / low).powf(share(place)) } else { low + share(place) * (high - low) }
        };
        (0..SHOWN).map(at).map(|x| [x, self.info.value(parameters, x)]).collect()
    }

    fn acts(&self) -> Operation {
        if self.on == CurveTarget::Capture { Operation::Set } else { Operation::Times }
    }

    /// As an effect with these parameters.
    pub fn fitted(&self, parameters: Vec<f64>) -> FittedForm {
        let Self { on, info: form, .. } = *self;
        FittedForm { on, acts: self.acts(), form, input: self.over.input, parameters }
    }

    /// As the diagnosis of impacts has it.
    pub fn closed(&self, parameters: Vec<f64>, intervals: Vec<[f64; 2]>) -> ClosedForm {
        let free = self.info.parameters.iter().map(|parameter| parameter.default.is_none()).collect();
        ClosedForm { info: self.info, acts: self.acts(), parameters, free, intervals, line: Vec::new() }
    }

    pub fn observable(&self) -> Observable {
        match self.on {
            CurveTarget::NormalRestitution => Observable::NormalRestitution,
            CurveTarget::TangentialRestitution => Observable::TangentialRestitution,
            CurveTarget::Capture => Observable::Capture,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nearwall::effect::CurveInput;

    fn over(seen: [f64; 2]) -> Over {
        let (name, also, overlapping) = ("We".to_owned(), Vec::new(), Vec::new());
        Over { input: CurveInput::Group(0), name, unit: "1", seen, middle: 2.0, also, overlapping }
    }

    fn form(name: &str, on: CurveTarget, falls: bool) -> RigForm {
        RigForm::new(on, &over([1.0, 4.0]), name, falls).unwrap()
    }

    /// By hand: a line through (1, 1.2) and (4, 0.6); a power with 0.5 at the geometric middle 2; a decay from 0.5
    /// at 1; a rise to 0.9 at 4.
    #[test]
    fn forms_follow_from_values_at_places_of_the_range() {
        for (name, values, parameters) in [
            ("line", [1.2, 0.6], vec![1.4, -0.2]),
            ("power", [0.5, -1.0], vec![1.0, -1.0]),
            ("exponential", [0.5, 2.0], vec![0.5 * f64::exp(0.5), 2.0, 0.0]),
            ("saturating", [0.9, 1.0], vec![1.125, 1.0, 0.0]),
        ] {
            let found = form(name, CurveTarget::NormalRestitution, false).parameters(&values);
            assert_eq!(found.len(), parameters.len());
            found.iter().zip(&parameters).for_each(|(found, by_hand)| {
                assert_relative_eq!(*found, *by_hand, max_relative = 1e-12);
            });
        }
        let falling = form("logistic", CurveTarget::Capture, true).parameters(&[3.0, 5.0]);
        assert_eq!(falling, [3.0, -5.0, 0.0, 1.0]);
    }

    /// Factors of an exact power lead back to it.
    #[test]
    fn the_nearest_form_is_the_one_that_made_the_factors() {
        let factors = [1.0, 1.5, 2.0, 3.0, 4.0].map(|x: f64| [x, 0.9 * x.powf(-0.4)]);
        let near = RigForm::near(CurveTarget::NormalRestitution, &over([1.0, 4.0]), &factors);
        let (power, at) = near.into_iter().find(|(form, _)| form.name() == "power").unwrap();
        let values: Vec<f64> = power.axes().iter().zip(&at).map(|(axis, at)| axis.value(*at)).collect();
        let found = power.parameters(&values);
        assert_relative_eq!(found[0], 0.9, max_relative = 0.02);
        assert_relative_eq!(found[1], -0.4, max_relative = 0.05);
    }
}
