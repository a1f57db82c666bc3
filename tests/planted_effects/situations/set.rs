//! A set of a situation: its plan, drawn from a seed.

use serde_json::{Value, json};

use crate::set_rng::SetRng;

use super::expected::Expected;
use super::file;
use super::lab::{Groups, Lab, Row};
use super::oracle::Oracle;

/// Rows on which the gain is checked.
const FRESH: usize = 4000;

type Change = Box<dyn Fn(&mut Vec<Row>, &mut SetRng) + Send + Sync>;

/// What is to be measured, and what is right to say of it.
pub struct Plan {
    pub lab: Lab,
    /// Rows.
    pub count: usize,
    pub expected: Expected,
    /// What happens to the rows after the measurement.
    pub change: Option<Change>,
    /// The column map, if there is one.
    pub map: Option<String>,
    /// Whether the fresh rows have the groups' errors and the change too.
    pub fresh_alike: bool,
}

impl Plan {
    pub fn new(lab: Lab, count: usize, expected: Expected) -> Self {
        Self { lab, count, expected, change: None, map: None, fresh_alike: true }
    }

    /// With something that happens to all rows after the measurement.
    pub fn changed(self, change: impl Fn(&mut Vec<Row>, &mut SetRng) + Send + Sync + 'static) -> Self {
        Self { change: Some(Box::new(change)), ..self }
    }

    /// With something that happens to each row after the measurement.
    pub fn each(self, change: impl Fn(&mut Row, &mut SetRng) + Send + Sync + 'static) -> Self {
        self.changed(move |rows, rng| rows.iter_mut().for_each(|row| change(row, rng)))
    }

    /// With rows that share an error.
    pub fn grouped(mut self, groups: Groups) -> Self {
        groups.column.into_iter().for_each(|column| self.lab.given.insert(0, column));
        self.lab.groups = Some(groups);
        self
    }

    fn rows(&self, count: usize, rng: &mut SetRng) -> Vec<Row> {
        let mut rows = self.lab.rows(count, rng);
        if let Some(change) = &self.change {
            change(&mut rows, rng);
        }
        for row in &mut rows {
            row.base = self.lab.base(&row.seen);
        }
        rows
    }
}

/// A set.
pub struct Set {
    pub name: String,
    pub expected: Expected,
    pub oracle: Oracle,
    pub model: String,
    pub map: Option<String>,
    pub rows: Vec<Row>,
    /// The file of the measurements.
    pub data: String,
    pub fresh: Vec<Row>,
    /// The file of the fresh impacts, inputs alone.
    pub fresh_inputs: String,
    /// The same with what was measured.
    pub fresh_data: String,
}

impl Set {
    /// Draws the plan's rows and so many fresh ones.
    pub fn draw(name: &str, mut plan: Plan, fresh: usize, rng: &mut SetRng) -> Self {
        let rows = plan.rows(plan.count, rng);
        let data = file::measurements(&plan.lab, &rows, rng);
        if !plan.fresh_alike {
            let groups = plan.lab.groups.take();
            plan.lab.given.retain(|name| groups.as_ref().is_none_or(|groups| groups.column != Some(*name)));
            plan.change = None;
        }
        let fresh = plan.rows(fresh, rng);
        let oracle = match plan.expected.planted.is_empty() && plan.expected.rival.is_none() {
            true => Oracle::NOTHING,
            false if plan.lab.truth.scatters() => Oracle::CERTAIN,
            false => Oracle::of(&rows, plan.lab.stated, plan.lab.outcomes),
        };
        Self {
            name: name.into(),
            model: file::model(&plan.lab),
            fresh_inputs: file::inputs(&plan.lab, &fresh, rng),
            fresh_data: file::measurements(&plan.lab, &fresh, rng),
            expected: plan.expected,
            map: plan.map,
            oracle,
            rows,
            data,
            fresh,
        }
    }

    /// The name without its index.
    pub fn situation(&self) -> &str {
        self.name.split(':').next().unwrap()
    }

    /// What a diagnosis should find.
    pub fn truth(&self) -> Value {
        let Expected { planted, allowed, never, rival, parameters, cell, .. } = &self.expected;
        let parameters: Vec<Value> = parameters
            .iter()
            .map(|(cause, name, value)| json!({ "cause": cause, "name": name, "value": value }))
            .collect();
        json!({
            "name": self.name, "situation": self.situation(), "rows": self.rows.len(), "cell": cell,
            "causes": planted, "allowed": allowed, "never": never, "parameters": parameters,
            "rival": rival.map(|rival| format!("{rival:?}").to_lowercase()),
            "oracle": { "power": self.oracle.power, "sees": self.oracle.sees },
        })
    }
}

/// A situation's set of this index; nothing is drawn before `make`.
pub struct Recipe {
    pub name: String,
    index: usize,
    plan: PlanOf,
}

/// The plan of the set of an index.
pub type PlanOf = std::sync::Arc<dyn Fn(usize, &mut SetRng) -> Plan + Send + Sync>;

impl Recipe {
    pub fn new(situation: &str, index: usize, plan: PlanOf) -> Self {
        Self { name: format!("{situation}:{index}"), index, plan }
    }

    /// The set of this seed.
    pub fn make(&self, seed: u64) -> Set {
        self.with_fresh(seed, FRESH)
    }

    /// The same with so many fresh rows.
    pub fn with_fresh(&self, seed: u64, fresh: usize) -> Set {
        let mut rng = SetRng::new(seed, &self.name);
        let plan = (self.plan)(self.index, &mut rng);
        Set::draw(&self.name, plan, fresh, &mut rng)
    }
}
