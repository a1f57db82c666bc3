//! Forces that a case leaves out and [`crate::simulate`] has: weight, thermophoresis, Brownian motion, turbulence.
//!
//! A case without a force where it can act is wrong in a way that no number of it tells. Each such force is tried with
//! what the case states and usual values of what it does not (assumed):
//!
//! | force | left out | tried with |
//! |---|---|---|
//! | weight | `gravity = [0, 0, 0]` | -9.81 m/s² along z |
//! | thermophoresis | in a gas with a gradient of temperature | 101325 Pa and 1 W/(m K) where nothing is stated |
//! | Brownian motion | of particles below 2 µm | 101325 Pa where no pressure is stated |
//! | turbulence | in a gas that moves, of particles that follow it | friction velocity: the duct's, or 5 % of the speed |
//!
//! The friction velocity over the mean speed of a smooth pipe is 0.062 to 0.047 at Reynolds numbers of 1e4 to 1e5
//! (`sqrt(f/8)` of Moody's diagram).

use toml_edit::{DocumentMut, InlineTable, Item, TableLike, Value};

use super::case_text::find_mut;
use crate::simulate::{Case, Injection, number_of};

/// Weight of a kilogram [m/s²].
const GRAVITY: f64 = 9.81;
/// Pressure of the atmosphere [Pa].
const PRESSURE: f64 = 101_325.0;
/// Thermal conductivity of particles of which none is known [W/(m K)].
const CONDUCTIVITY: f64 = 1.0;
/// Largest diameter of particles that molecules push about [m].
const FINE: f64 = 2e-6;
/// Friction velocity over the speed of the gas [1].
const FRICTION: f64 = 0.05;
/// Particles of an injection of which the size is looked at.
const LOOKED_AT: u64 = 64;
/// Flow times within which a particle takes on the velocity of the gas, if it follows turbulence at all [1].
const FOLLOWS: f64 = 10.0;
/// Keys of a gas that hold its speed [m/s].
const SPEEDS: [&str; 3] = ["velocity", "speed", "axial_speed"];

/// A force that a case leaves out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum MissingForce {
    Gravity,
    /// Whether the conductivity of the particles is not known.
    Thermophoresis {
        assumed_conductivity: bool,
    },
    Brownian,
    Turbulence,
}

impl MissingForce {
    /// The forces that a case leaves out and that could act in it.
    pub fn all(case: &Case, document: &DocumentMut) -> Vec<Self> {
        let mut found = Vec::new();
        if case.gravity.norm() == 0.0 {
            found.push(Self::Gravity);
        }
        let has_gradient =
            case.injections.iter().any(|one| case.gas.temperature_gradient(&one.release()).norm() > 0.0);
        if !case.gas.thermophoresis && has_gradient {
            found.push(Self::Thermophoresis { assumed_conductivity: !knows_conductivity(case) });
        }
        if !case.gas.brownian && smallest(case) < FINE {
            found.push(Self::Brownian);
        }
        if case.gas.turbulence.is_none() && turbulence(document).is_some() && follows_gas(case) {
            found.push(Self::Turbulence);
        }
        found
    }

    /// The end of its cause's id.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gravity => "without-gravity",
            Self::Thermophoresis { .. } => "without-thermophoresis",
            Self::Brownian => "without-brownian",
            Self::Turbulence => "without-turbulence",
        }
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Gravity => "the weight of the particles",
            Self::Thermophoresis { .. } => "thermophoresis",
            Self::Brownian => "Brownian motion",
            Self::Turbulence => "turbulence",
        }
    }

    /// What tells whether it acts.
    pub fn instrument(self) -> &'static str {
        match self {
            Self::Gravity => "the rig turned by 90 degrees",
            Self::Thermophoresis { .. } => "a run with wall and gas at one temperature",
            Self::Brownian => "a run with larger particles",
            Self::Turbulence => "the fluctuation of the velocity of the gas at the wall",
        }
    }

    /// Adds it to the text of a case.
    pub fn add(self, document: &mut DocumentMut) {
        match self {
            Self::Gravity => {
                let down = Value::from_iter([0.0, 0.0, -GRAVITY]);
                set(document, "run", "gravity", down);
            }
            Self::Thermophoresis { assumed_conductivity } => {
                set(document, "gas", "thermophoresis", Value::from(true));
                set_pressure(document);
                if assumed_conductivity {
                    set_conductivity(document);
                }
            }
            Self::Brownian => {
                set(document, "gas", "brownian", Value::from(true));
                set_pressure(document);
            }
            Self::Turbulence => {
                if let Some(table) = turbulence(document) {
                    set(document, "gas", "turbulence", Value::InlineTable(table));
                }
            }
        }
    }
}

/// Whether the conductivity of all particles is known.
fn knows_conductivity(case: &Case) -> bool {
    let of_material = |model: &nearwall::Model, temperature: f64| {
        model.particle().thermal_conductivity_near(temperature).is_some()
    };
    case.injections.iter().all(|one| {
        let temperature = case.gas.at(&one.release()).temperature;
        one.conductivity.is_some() || of_material(case.model_of(one), temperature)
    })
}

/// Diameters of some particles [m].
fn sizes(case: &Case) -> impl Iterator<Item = f64> {
    let seed = case.seed;
    let of = move |one| {
        let one: &Injection = one;
        (0..LOOKED_AT.min(one.count)).map(move |number| one.draw(seed, number).0)
    };
    case.injections.iter().flat_map(of)
}

fn smallest(case: &Case) -> f64 {
    sizes(case).fold(f64::INFINITY, f64::min)
}

/// Whether some particles take on the velocity of the gas within a few times of flight.
fn follows_gas(case: &Case) -> bool {
    let diameter = smallest(case);
    case.injections.iter().any(|one| {
        let gas = case.gas.at(&one.release());
        let density = case.density(one, gas.temperature).unwrap_or(f64::INFINITY);
        density * diameter * diameter / (18.0 * gas.viscosity) < FOLLOWS * case.time_limit
    })
}

/// The turbulence that is tried: none in a gas that is laminar or does not move; a turbulent duct knows its own.
fn turbulence(document: &DocumentMut) -> Option<InlineTable> {
    let gas = document.get("gas")?.as_table_like()?;
    let mut table = InlineTable::new();
    if gas.get("field").and_then(Item::as_str) == Some("duct") {
        return (gas.get("flow").and_then(Item::as_str) == Some("turbulent")).then_some(table);
    }
    let speed = SPEEDS.iter().find_map(|key| gas.get(key)?.as_value().and_then(size))?;
    table.insert("friction_velocity", Value::from(FRICTION * speed));
    (speed > 0.0).then_some(table)
}

/// A number, or the length of a vector.
pub(super) fn size(value: &Value) -> Option<f64> {
    let Value::Array(list) = value else { return number_of(value) };
    let squares: Option<Vec<f64>> = list.iter().map(|one| number_of(one).map(|one| one * one)).collect();
    Some(squares?.iter().sum::<f64>().sqrt())
}

fn set(document: &mut DocumentMut, table: &str, key: &str, value: Value) {
    if let Some(table) = find_mut(document, table).and_then(Item::as_table_like_mut) {
        table.insert(key, Item::Value(value));
    }
}

/// The pressure of the atmosphere, where the case tells no mean free path.
fn set_pressure(document: &mut DocumentMut) {
    let gas = find_mut(document, "gas").and_then(Item::as_table_like_mut);
    let Some(gas) = gas.filter(|gas| !gas.contains_key("pressure") && !gas.contains_key("mean_free_path"))
    else {
        return;
    };
    gas.insert("pressure", Item::Value(Value::from(PRESSURE)));
}

fn set_conductivity(document: &mut DocumentMut) {
    let with = |table: &mut dyn TableLike| {
        if !table.contains_key("conductivity") {
            table.insert("conductivity", Item::Value(Value::from(CONDUCTIVITY)));
        }
    };
    match document.get_mut("particles") {
        Some(Item::ArrayOfTables(tables)) => tables.iter_mut().for_each(|table| with(table)),
        Some(item) => {
            if let Some(table) = item.as_table_like_mut() {
                with(table);
            }
        }
        None => {}
    }
}
