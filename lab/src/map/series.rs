//! Maps of one model over the values of a third input.

use super::{InputAxis, Map};
use crate::range::RangeCounts;
use nearwall::impact::{INPUTS, Impact, Input};
use nearwall::model::Model;

/// A map, or one for each value of a third input. All have the same axes.
#[derive(Debug, Clone)]
pub struct MapSeries {
    /// The third input; `None` for a single map.
    pub third: Option<InputAxis>,
    /// The maps, in the order of the values of the third input; at least one.
    pub maps: Vec<Map>,
}

impl MapSeries {
    /// Decides the impacts `fixed` on the wall with index `wall` over both axes, for each value of the third input.
    pub fn new(
        model: &Model,
        wall: usize,
        axes: [InputAxis; 2],
        third: Option<InputAxis>,
        fixed: Impact,
    ) -> Self {
        let map = |fixed: Impact| Map::new(model, wall, axes, fixed);
        let at = |third: InputAxis, value: f64| {
            let mut impact = fixed;
            (third.input().set)(&mut impact, value);
            map(impact)
        };
        let maps = match third {
            Some(third) => third.values().into_iter().map(|value| at(third, value)).collect(),
            None => vec![map(fixed)],
        };
        Self { third, maps }
    }

    /// The inputs along x, along y and, if there is one, the third one.
    pub fn axes(&self) -> Vec<&InputAxis> {
        let first = self.maps.first().into_iter().flat_map(|map| [&map.x, &map.y]);
        first.chain(&self.third).collect()
    }

    /// The value of the third input of each map, with the map.
    pub fn by_value(&self) -> impl Iterator<Item = (Option<f64>, &Map)> {
        let value = |map: &Map| self.third.map(|third| (third.input().value)(&map.fixed));
        self.maps.iter().map(move |map| (value(map), map))
    }

    /// The inputs that are the same in all impacts, with their values.
    pub fn fixed_inputs(&self) -> Vec<(&'static Input, f64)> {
        let varied: Vec<&str> = self.axes().iter().map(|axis| axis.input().name).collect();
        let fixed = INPUTS.iter().filter(|input| !varied.contains(&input.name));
        let Some(map) = self.maps.first() else { return Vec::new() };
        fixed.map(|input| (input, (input.value)(&map.fixed))).collect()
    }

    /// Number of impacts.
    pub fn count(&self) -> usize {
        self.maps.iter().map(|map| map.cells.len()).sum()
    }

    /// Number of impacts that could not be decided.
    pub fn undecided(&self) -> usize {
        self.maps.iter().map(Map::undecided).sum()
    }

    /// Why the first undecided impact could not be decided.
    pub fn first_refusal(&self) -> Option<&str> {
        self.maps.iter().find_map(|map| map.first_refusal.as_deref())
    }

    /// The stated ranges that the impacts leave.
    pub fn ranges(&self) -> RangeCounts {
        let mut all = RangeCounts::default();
        self.maps.iter().for_each(|map| all.merge(map.ranges.clone()));
        all
    }
}
