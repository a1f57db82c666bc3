//! What varies over the impacts of a rig: the inputs and dimensionless groups at the first contact of every particle.

use nearwall::effect::CurveInput;
use nearwall::group::GROUPS;
use nearwall::impact::{INPUTS, Impact};
use rayon::prelude::*;
use toml_edit::InlineTable;

use super::super::extend::ranges;
use crate::rig::Forward;

/// Least standard deviation of an input's mean over the experiments, as a share of its range, from
/// which on it is changed on purpose: for a curve over it.
const LEAST_INPUT_CHANGE: f64 = 0.05;
/// Correlation from which two inputs change together.
const TOGETHER: f64 = 0.98;
/// Correlation of their order from which one of them is as good as the other: a group may be any power of an input.
const SAME_ORDER: f64 = 0.999;
/// Correlation of their order from which curves over two inputs describe one dependence: each tells four fifths of the
/// variance of the other.
const OVERLAP: f64 = 0.9;

/// An input or a group over which a curve could be seen.
#[derive(Debug, Clone)]
pub(super) struct Over {
    pub input: CurveInput,
    pub name: String,
    /// SI unit.
    pub unit: &'static str,
    /// Its range over the impacts, without the outermost hundredths [its unit].
    pub seen: [f64; 2],
    /// A usual value within it [its unit].
    pub middle: f64,
    /// Others that change together with it from experiment to experiment.
    pub also: Vec<String>,
    /// Others over which a curve describes the same dependence, though the experiments may tell them apart.
    pub overlapping: Vec<String>,
}

impl Over {
    /// The ranges of the inputs of a fit, with that of a group.
    pub fn valid(&self, inputs: &InlineTable) -> InlineTable {
        let mut all = inputs.clone();
        if self.input.is_group() {
            all.extend(ranges(std::iter::once((self.name.as_str(), self.seen))));
        }
        all
    }
}

/// An input or a group over the impacts.
#[derive(Debug)]
struct Spread {
    input: CurveInput,
    name: String,
    /// Least value [its unit].
    least: Option<f64>,
    /// Its range, without the outermost hundredths; `None` if it does not vary, or a group has no value somewhere.
    range: Option<[f64; 2]>,
    /// Its mean in each experiment [its unit].
    means: Vec<f64>,
}

impl Spread {
    fn new(forward: &dyn Forward, input: CurveInput) -> Self {
        let name = input.name(&forward.base(0).declared()).to_owned();
        let experiments = 0..forward.experiments().len();
        let values: Vec<Vec<(f64, f64)>> = experiments.map(|one| forward.input_values(one, input)).collect();
        let mean = |values: &Vec<(f64, f64)>| {
            let weight: f64 = values.iter().map(|(_, weight)| weight).sum();
            values.iter().map(|(value, weight)| value * weight).sum::<f64>() / weight
        };
        let means = values.iter().map(mean).collect();
        let all = || values.iter().flatten().map(|(value, _)| *value);
        let mut sorted: Vec<f64> = all().filter(|value| value.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let at = |share: f64| sorted.get((sorted.len().saturating_sub(1) as f64 * share).round() as usize);
        let whole = !input.is_group() || sorted.len() == all().count();
        let ends = at(0.005).zip(at(0.995)).filter(|_| whole).map(|(low, high)| [*low, *high]);
        let range = ends.filter(|[low, high]| high - low > 1e-6 * high.abs());
        Self { input, name, least: sorted.first().copied(), range, means }
    }

    /// Whether it changes from experiment to experiment.
    fn changes(&self) -> bool {
        self.range.is_some_and(|[low, high]| deviation(&self.means) >= LEAST_INPUT_CHANGE * (high - low))
    }

    /// Whether a curve over another one is a curve over this one: the means of inputs are correlated, those of a
    /// group, which may be any power of the other one, in their order.
    fn is_together(&self, other: &Self) -> bool {
        if self.input.is_group() {
            correlation(&ranks(&self.means), &ranks(&other.means)) > SAME_ORDER
        } else {
            correlation(&self.means, &other.means) > TOGETHER
        }
    }

    /// With the middle of its means, or of its range where that is near an end.
    fn over(&self, [low, high]: [f64; 2], also: Vec<String>) -> Over {
        let mut means: Vec<f64> = self.means.iter().copied().filter(|mean| mean.is_finite()).collect();
        means.sort_by(f64::total_cmp);
        let middle = means.get(means.len() / 2).copied().unwrap_or(low);
        let inside = middle > low + 0.1 * (high - low) && middle < high - 0.1 * (high - low);
        let unit = match self.input {
            CurveInput::Input(place) => INPUTS.get(place).map_or("", |input| input.unit),
            _ => "1",
        };
        let middle = if inside { middle } else { 0.5 * (low + high) };
        let overlapping = Vec::new();
        Over {
            input: self.input,
            name: self.name.clone(),
            unit,
            seen: [low, high],
            middle,
            also,
            overlapping,
        }
    }
}

/// All inputs, and the groups that the base model can compute.
#[derive(Debug)]
pub(super) struct RigInputs(Vec<Spread>);

impl RigInputs {
    pub fn new(forward: &dyn Forward) -> Self {
        let base = forward.base(0);
        let inputs = (0..INPUTS.len()).map(CurveInput::Input);
        let products = (0..base.products().len()).map(CurveInput::Product);
        let declared = base.declared();
        // What the model file declares hides a group of the library with the same name.
        let shown = |place: &usize| {
            CurveInput::named(GROUPS[*place].name, &declared) == Some(CurveInput::Group(*place))
        };
        let groups = base.groups_known(&[]).into_iter().filter(shown).map(CurveInput::Group);
        let all: Vec<CurveInput> = inputs.chain(groups).chain(products).collect();
        Self(all.into_par_iter().map(|input| Spread::new(forward, input)).collect())
    }

    fn inputs(&self) -> impl Iterator<Item = &Spread> {
        self.0.iter().filter(|one| !one.input.is_group())
    }

    fn input(&self, name: &str) -> Option<&Spread> {
        self.inputs().find(|one| one.name == name)
    }

    /// The range of an input over the first impacts of all experiments; `None` if it does not vary.
    pub fn range(&self, input: &str) -> Option<[f64; 2]> {
        self.input(input)?.range
    }

    /// The value of an input that does not vary and that an impact does not have by itself, as the thickness of a
    /// layer.
    pub fn present(&self, input: &str) -> Option<f64> {
        let absent =
            INPUTS.iter().find(|one| one.name == input).map(|one| (one.value)(&Impact::default()))?;
        let value = self.input(input)?.least?;
        (absent == 0.0 && value > 0.0).then_some(value)
    }

    /// Inputs that vary over the impacts of an experiment, but not from one experiment to the other.
    pub fn unchanged(&self) -> impl Iterator<Item = &str> {
        let unchanged = self.inputs().filter(|one| one.range.is_some() && !one.changes());
        unchanged.map(|one| one.name.as_str())
    }

    /// The ranges of the inputs of a fit.
    pub fn valid(&self) -> InlineTable {
        ranges(self.inputs().filter_map(|one| Some((one.name.as_str(), one.range?))))
    }

    /// The inputs and groups over which a curve could be seen: those that change from experiment to experiment. Of
    /// those that change together the first one, inputs before groups.
    pub fn curves(&self) -> Vec<Over> {
        let mut found: Vec<(&Spread, Vec<String>)> = Vec::new();
        for one in self.0.iter().filter(|one| one.changes()) {
            match found.iter_mut().find(|(earlier, _)| one.is_together(earlier)) {
                Some((_, also)) => also.push(one.name.clone()),
                None => found.push((one, Vec::new())),
            }
        }
        let all: Vec<&Spread> = found.iter().map(|(one, _)| *one).collect();
        let overlapping = |one: &Spread| {
            let others = all.iter().filter(|other| other.name != one.name);
            let near = |other: &&&Spread| correlation(&ranks(&one.means), &ranks(&other.means)) > OVERLAP;
            others.filter(near).map(|other| other.name.clone()).collect()
        };
        let of = |(one, also): (&Spread, Vec<String>)| {
            Some(Over { overlapping: overlapping(one), ..one.over(one.range?, also) })
        };
        found.into_iter().filter_map(of).collect()
    }
}

fn deviation(values: &[f64]) -> f64 {
    let finite: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    let mean = finite.iter().sum::<f64>() / finite.len().max(1) as f64;
    (finite.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / finite.len().max(1) as f64).sqrt()
}

/// Size of the correlation of values [1]; NaN where one of them does not vary or is not a number.
fn correlation(one: &[f64], other: &[f64]) -> f64 {
    let centred = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        values.iter().map(|value| value - mean).collect::<Vec<f64>>()
    };
    let (a, b) = (centred(one), centred(other));
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    product(&a, &b).abs() / (product(&a, &a) * product(&b, &b)).sqrt()
}

/// The place of each value in their order, NaN last.
fn ranks(values: &[f64]) -> Vec<f64> {
    let below = |value: &f64| values.iter().filter(|other| other.total_cmp(value).is_lt()).count() as f64;
    values.iter().map(below).collect()
}
