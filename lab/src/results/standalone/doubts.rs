//! What the results of standalone cases are not good for.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use crate::range::{RangeCounts, RangeReader};
use crate::simulate::{Case, SurfaceKind, Trajectory};
use nearwall::Model;

/// Reasons to doubt the results of one run or of several, and how many particles or hits they concern.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Doubts {
    /// Particles released.
    injected: u64,
    /// The stated ranges that hits left.
    ranges: RangeCounts,
    /// Particles that turbulence brings to walls too seldom.
    too_seldom: u64,
    /// Particles that ended where the gas has no gradient of temperature, though thermophoresis is on.
    without_gradient: u64,
    /// Why the gas would hardly flow as the case says.
    flow: Option<String>,
    /// What in the models is probably a mistake.
    models: BTreeSet<String>,
}

impl Doubts {
    pub(super) fn new(case: &Case) -> Self {
        let models = case.injections.iter().map(|injection| case.model_of(injection));
        Self { flow: case.gas.doubt(), models: models.flat_map(Model::notes).collect(), ..Self::default() }
    }

    /// Counts a particle.
    pub(super) fn count(&mut self, case: &Case, ranges: &RangeReader<'_>, trajectory: &Trajectory) {
        self.injected += 1;
        self.count_ranges(case, ranges, trajectory);
        self.count_too_seldom(case, trajectory);
        let is_flat = case.gas.temperature_gradient(&trajectory.position).norm() == 0.0;
        self.without_gradient += u64::from(case.gas.thermophoresis && is_flat);
    }

    /// Counts the stated ranges that the hits of a particle leave.
    fn count_ranges(&mut self, case: &Case, ranges: &RangeReader<'_>, trajectory: &Trajectory) {
        for hit in &trajectory.hits {
            if let SurfaceKind::Wall { model: wall, .. } = case.surfaces[hit.surface].kind {
                self.ranges.count(ranges, wall, &hit.impact, hit.outcome.outside_range);
            }
        }
    }

    /// Counts a particle whose deposition is known to be too low.
    fn count_too_seldom(&mut self, case: &Case, trajectory: &Trajectory) {
        let Some(turbulence) = &case.gas.turbulence else { return };
        let ([_, mass], diameter) = (trajectory.mass, trajectory.diameter);
        let gas = case.gas.at(&trajectory.position);
        let relaxation = mass / trajectory.weight / (3.0 * PI * gas.viscosity * diameter);
        self.too_seldom += u64::from(turbulence.is_slow(relaxation, &gas));
    }

    /// The doubts about several runs of a case.
    pub fn of_all<'a>(runs: impl IntoIterator<Item = &'a Self>) -> Self {
        runs.into_iter().cloned().reduce(Self::with).unwrap_or_default()
    }

    fn with(mut self, other: Self) -> Self {
        self.ranges.merge(other.ranges);
        Self {
            injected: self.injected + other.injected,
            ranges: self.ranges,
            too_seldom: self.too_seldom + other.too_seldom,
            without_gradient: self.without_gradient + other.without_gradient,
            flow: self.flow.or(other.flow),
            models: self.models,
        }
    }

    /// The doubts in words, a line for each reason.
    pub fn lines(&self) -> Vec<String> {
        let Self { injected, too_seldom, .. } = self;
        let mut lines = self.ranges.lines("hits");
        lines.extend(self.flow.iter().chain(&self.models).cloned());
        if *too_seldom > 0 {
            lines.push(format!(
                "{too_seldom} of {injected} particles have relaxation times of 0.3 to 4 in wall units: turbulence \
                 brings fewer than half as many to walls as measured, down to hardly any at 1"
            ));
        }
        if *injected > 0 && self.without_gradient == *injected {
            lines.push(
                "thermophoresis acts along the temperature gradient of the gas field, which has none here: colder \
                 walls draw nothing; give `gas.temperature` as a profile across the gas"
                    .to_owned(),
            );
        }
        lines
    }
}
