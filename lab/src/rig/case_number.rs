//! Numbers of a case that may be wrong: what the instruments of a rig told.
//!
//! A wrong number is wrong in all experiments in the same way: a temperature or an angle by a
//! difference, anything else by a factor. An experiment that sets the number itself used the same
//! instrument. How far it may be off is the standard error that the case states, or a usual one.
//!
//! The place of injection may be off along each axis; its usual error is 5 % of the distance to the nearest wall. About
//! the z axis, where no vector of the case has another part, x stands for both. A force that the case leaves out is
//! none of the instruments' errors: it is missing, or it is not.

use std::collections::BTreeMap;

use toml_edit::{DocumentMut, Item, TableLike, Value};

use super::case_text::{change_value, find_mut};
use super::missing_force::{MissingForce, size};
use crate::simulate::{Case, DistributionKey, Injection, SurfaceKind, number_of};

/// How a number changes.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Shift {
    Factor,
    Difference,
    /// A part of a vector, by a difference.
    Part(usize),
    /// A force that is added.
    Force(MissingForce),
}

/// A kind of number.
struct NumberKind {
    /// Its last key.
    key: &'static str,
    unit: &'static str,
    shift: Shift,
    /// The usual standard error: of a factor as a share, otherwise in the unit and as a share, of
    /// which the larger counts.
    usual: [f64; 2],
    /// The instrument that tells it.
    instrument: &'static str,
}

/// The numbers that are looked for: of the gas, of particles and of walls.
const KINDS: [NumberKind; 8] = [
    speed("velocity"),
    speed("speed"),
    speed("axial_speed"),
    NumberKind {
        key: "temperature",
        unit: "K",
        shift: Shift::Difference,
        usual: [10.0, 0.01],
        instrument: "a thermometer that does not depend on the first",
    },
    NumberKind {
        key: "diameter",
        unit: "m",
        shift: Shift::Factor,
        usual: [0.0, 0.05],
        instrument: "a second sizing of the powder",
    },
    NumberKind {
        key: "diameter spread",
        unit: "m",
        shift: Shift::Factor,
        usual: [0.0, 0.1],
        instrument: "a second sizing of the powder",
    },
    NumberKind {
        key: "angle_deg",
        unit: "degrees",
        shift: Shift::Difference,
        usual: [2.0, 0.0],
        instrument: "a picture of the jet beside the wall",
    },
    NumberKind {
        key: "position.radius",
        unit: "m",
        shift: Shift::Factor,
        usual: [0.0, 0.05],
        instrument: "the width of the particle beam without the wall",
    },
];

const fn speed(key: &'static str) -> NumberKind {
    NumberKind {
        key,
        unit: "m/s",
        shift: Shift::Factor,
        usual: [0.0, 0.05],
        instrument: "a blank run: the speed without the wall",
    }
}

/// The axes, and the keys of a place.
const AXES: [&str; 3] = ["x", "y", "z"];
const PLACES: [&str; 2] = ["at", "center"];
/// Usual error of the place of injection over its distance from the nearest wall [1].
const PLACE_ERROR: f64 = 0.05;

/// What the keys of a distribution hold that are its middle, its spread, and the ends of an even one.
const MIDDLE: &[DistributionKey] = &[DistributionKey::Middle];
pub(super) const SPREAD: &[DistributionKey] = &[DistributionKey::Deviation, DistributionKey::Shape];
const ENDS: &[DistributionKey] = &[DistributionKey::Bound];

/// A number of a case with its standard error.
#[derive(Debug, Clone)]
pub struct CaseNumber {
    /// Dotted key, down to that of a distribution.
    pub key: String,
    /// Its value in the case [its unit].
    pub value: f64,
    /// Its standard error [its unit].
    pub error: f64,
    /// Whether the case states the error.
    pub stated: bool,
    /// SI unit or degrees.
    pub unit: &'static str,
    /// What tells it once more.
    pub instrument: &'static str,
    /// Dotted key of the quantity.
    quantity: String,
    spread: bool,
    shift: Shift,
}

impl CaseNumber {
    /// The numbers of a case of these texts; `errors` are the stated ones by key.
    pub(super) fn all(document: &DocumentMut, errors: &BTreeMap<String, f64>) -> Vec<Self> {
        let mut found = Vec::new();
        for table in ["gas", "particles", "walls"] {
            match document.get(table) {
                Some(Item::ArrayOfTables(tables)) => {
                    for one in tables {
                        let name = one.get("name").and_then(Item::as_str).unwrap_or("?");
                        Self::of_table(one, &format!("{table}.{name}"), errors, &mut found);
                    }
                }
                Some(item) => {
                    if let Some(one) = item.as_table_like() {
                        Self::of_table(one, table, errors, &mut found);
                    }
                }
                None => {}
            }
        }
        found
    }

    /// The places of injection of a case.
    pub(super) fn places(case: &Case, document: &DocumentMut, errors: &BTreeMap<String, f64>) -> Vec<Self> {
        let axes = if is_about_z(document.as_item()) { &[0, 2][..] } else { &[0, 1, 2] };
        let is_list = matches!(document.get("particles"), Some(Item::ArrayOfTables(_)));
        let one = |injection: &Injection| {
            let name = if is_list { format!("particles.{}", injection.name) } else { "particles".to_owned() };
            let quantity = format!("{name}.position");
            let place = injection.release();
            let walls = case.surfaces.iter().filter(|one| matches!(one.kind, SurfaceKind::Wall { .. }));
            let nearest = walls.map(|one| one.shape.distance(&place).abs()).fold(f64::INFINITY, f64::min);
            let stated = errors.get(&quantity).copied();
            let error = stated.unwrap_or(PLACE_ERROR * nearest);
            let of = move |axis: &usize| Self {
                key: format!("{quantity}.{}", AXES[*axis]),
                value: place[*axis],
                error,
                stated: stated.is_some(),
                unit: "m",
                instrument: "the place of the nozzle beside the wall",
                quantity: quantity.clone(),
                spread: false,
                shift: Shift::Part(*axis),
            };
            axes.iter().map(of).filter(|one| one.error > 0.0 && one.error.is_finite()).collect::<Vec<_>>()
        };
        case.injections.iter().flat_map(one).collect()
    }

    /// The forces that a case leaves out.
    pub(super) fn forces(case: &Case, document: &DocumentMut) -> Vec<Self> {
        let one = |force: MissingForce| Self {
            key: force.name().to_owned(),
            value: 0.0,
            error: 1.0,
            stated: false,
            unit: "1",
            instrument: force.instrument(),
            quantity: String::new(),
            spread: false,
            shift: Shift::Force(force),
        };
        MissingForce::all(case, document).into_iter().map(one).collect()
    }

    /// In words, if it is no number but a force that the case leaves out.
    pub fn missing_force(&self) -> Option<&'static str> {
        if let Shift::Force(force) = self.shift { Some(force.words()) } else { None }
    }

    fn of_table(table: &dyn TableLike, path: &str, errors: &BTreeMap<String, f64>, found: &mut Vec<Self>) {
        for kind in &KINDS {
            let (key, spread) = kind.key.split_once(' ').map_or((kind.key, false), |(key, _)| (key, true));
            let mut parts = key.split('.');
            let first = parts.next().and_then(|part| table.get(part));
            let item = parts.fold(first, |item, part| item?.get(part));
            let quantity = format!("{path}.{key}");
            let Some((end, value)) = item.and_then(|item| middle(item, spread)) else { continue };
            if value == 0.0 {
                continue;
            }
            let stated = errors.get(&quantity).copied().filter(|_| !spread);
            let usual = kind.usual[0].max(kind.usual[1] * value.abs());
            found.push(Self {
                key: format!("{quantity}{end}"),
                value,
                error: stated.unwrap_or(usual),
                stated: stated.is_some(),
                unit: kind.unit,
                instrument: kind.instrument,
                quantity,
                spread,
                shift: kind.shift,
            });
        }
    }

    /// A value moved by so many standard errors [its unit].
    pub fn moved(&self, value: f64, widths: f64) -> f64 {
        let factor = |widths: f64| (widths * self.error / self.value.abs()).exp();
        match self.shift {
            // An exponent is the less the wider; a geometric deviation is that of a logarithm.
            Shift::Factor if self.key.ends_with(".exponent") => value * factor(-widths),
            Shift::Factor if self.key.ends_with(".geometric_deviation") => value.powf(factor(widths)),
            Shift::Factor => value * factor(widths),
            Shift::Difference | Shift::Part(_) => value + widths * self.error,
            Shift::Force(_) => value,
        }
    }

    /// Moves the number in the text of a case by so many standard errors.
    pub(super) fn shift(&self, document: &mut DocumentMut, widths: f64) {
        if let Shift::Force(force) = self.shift {
            return force.add(document);
        }
        let Some(item) = find_mut(document, &self.quantity) else { return };
        match item.as_table_like_mut() {
            None => self.change(item, &|value| self.moved(value, widths)),
            Some(table) if matches!(self.shift, Shift::Part(_)) => self.shift_place(table, widths),
            Some(table) => {
                let is_even = table.get("distribution").and_then(Item::as_str) == Some("uniform");
                let keys = match (self.spread, is_even) {
                    (true, _) => SPREAD,
                    (false, true) => ENDS,
                    (false, false) => MIDDLE,
                };
                for key in DistributionKey::names(keys) {
                    if let Some(item) = table.get_mut(key) {
                        self.change(item, &|value| self.moved(value, widths));
                    }
                }
            }
        }
    }

    /// Moves a place along an axis.
    fn shift_place(&self, table: &mut dyn TableLike, widths: f64) {
        let Shift::Part(axis) = self.shift else { return };
        let Some(key) = PLACES.into_iter().find(|key| table.contains_key(key)) else { return };
        let place = table.get_mut(key).and_then(Item::as_value_mut).and_then(Value::as_array_mut);
        if let Some(value) = place.and_then(|list| list.get_mut(axis)) {
            change_value(value, &|value| self.moved(value, widths));
        }
    }

    /// Changes a number, or all of a list.
    fn change(&self, item: &mut Item, with: &dyn Fn(f64) -> f64) {
        // Beyond the normal of the wall the angle grows less again.
        let within = |value: f64| if self.unit == "degrees" && value > 90.0 { 180.0 - value } else { value };
        if let Some(value) = item.as_value_mut() {
            change_value(value, &|number| within(with(number)));
        }
    }
}

/// The end of the key and the value of the middle of a quantity, or of its spread.
fn middle(item: &Item, spread: bool) -> Option<(String, f64)> {
    let number = |key: &str| item.get(key).and_then(Item::as_value).and_then(number_of);
    let Some(table) = item.as_table_like() else {
        return if spread { None } else { Some((String::new(), size(item.as_value()?)?)) };
    };
    if table.get("distribution").and_then(Item::as_str) == Some("uniform") {
        let [low, high] = [number("min")?, number("max")?];
        return (!spread).then_some((String::new(), 0.5 * (low + high)));
    }
    if let Some(values) = table.get("value").and_then(Item::as_value).filter(|_| !spread) {
        let first = values.as_array().and_then(|list| list.get(0)).unwrap_or(values);
        return Some((String::new(), number_of(first)?));
    }
    let mut keys = DistributionKey::names(if spread { SPREAD } else { MIDDLE });
    keys.find_map(|key| Some((format!(".{key}"), number(key)?)))
}

/// Whether all vectors point along the z axis.
fn is_about_z(item: &Item) -> bool {
    let of_value = |value: &Value| match value {
        Value::Array(list) if list.len() == 3 => {
            let numbers: Vec<f64> = list.iter().filter_map(number_of).collect();
            numbers.len() < 3 || numbers[..2].iter().all(|number| *number == 0.0)
        }
        Value::InlineTable(table) => table.iter().all(|(_, value)| is_about_z(&Item::Value(value.clone()))),
        _ => true,
    };
    match item {
        Item::Value(value) => of_value(value),
        Item::Table(table) => table.iter().all(|(key, item)| key == "model" || is_about_z(item)),
        Item::ArrayOfTables(tables) => tables.iter().all(|one| one.iter().all(|(_, item)| is_about_z(item))),
        Item::None => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CASE: &str = "[gas]\nvelocity = [0, 3, -4]\ntemperature = 300\n[particles]\nspeed = { distribution \
        = \"uniform\", min = 1, max = 3 }\ndiameter = { distribution = \"rosin-rammler\", scale = 60e-6, exponent = 2 \
        }\n\
                        angle_deg = 88\ntemperature = 2000\nposition = { shape = \"point\", at = [0, 0, 1] }\n\
                        [[walls]]\nname = \"plate\"\ntemperature = { axis = \"z\", at = [0, 1], value = [400, 500] }\n";

    /// The numbers of a case, and each two standard errors up, by hand.
    #[test]
    fn numbers_of_a_case_are_found_and_moved() {
        let document: DocumentMut = CASE.parse().unwrap();
        let errors = BTreeMap::from([("gas.temperature".to_owned(), 4.0)]);
        let numbers = CaseNumber::all(&document, &errors);
        let of = |key: &str, path: &str| {
            let number = numbers.iter().find(|one| one.key == key).unwrap();
            let mut moved = document.clone();
            number.shift(&mut moved, 2.0);
            let mut item = find_mut(&mut moved, path).unwrap().clone();
            let value = item.as_value_mut().unwrap();
            let value = value.as_array().and_then(|list| list.get(list.len() - 1)).unwrap_or(value).clone();
            (number.error, number_of(&value).unwrap())
        };
        let speed = (0.05_f64 * 2.0).exp();
        for (key, path, error, moved) in [
            ("gas.velocity", "gas.velocity", 0.25, -4.0 * speed),
            ("gas.temperature", "gas.temperature", 4.0, 308.0),
            ("particles.speed", "particles.speed.max", 0.1, 3.0 * speed),
            ("particles.diameter.scale", "particles.diameter.scale", 3e-6, 60e-6 * speed),
            ("particles.diameter.exponent", "particles.diameter.exponent", 0.2, 2.0 * (-0.2_f64).exp()),
            ("particles.angle_deg", "particles.angle_deg", 2.0, 88.0),
            ("particles.temperature", "particles.temperature", 20.0, 2040.0),
            ("walls.plate.temperature", "walls.plate.temperature.value", 10.0, 520.0),
        ] {
            let (own, value) = of(key, path);
            assert!(
                (own / error - 1.0).abs() < 1e-12 && (value / moved - 1.0).abs() < 1e-12,
                "{key}: {own} {value}"
            );
        }
        assert_eq!(numbers.len(), 8);
    }
}
