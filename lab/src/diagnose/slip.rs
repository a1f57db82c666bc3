//! Slips of a user: units, radius for diameter, the angle from the other side, Celsius, energy for speed.

use toml_edit::{DocumentMut, Item, Value};

use super::reading::OtherReading;
use crate::dataset::{Measurement, Reading};
use crate::simulate::number_of;
use nearwall::impact::INPUTS;
use nearwall::model::Model;

/// Factors on the diameter: what is given, and the factor to the true one.
const SIZE_SLIPS: [(&str, f64, &str); 5] = [
    ("diameter-is-radius", 2.0, "twice as large: is the column d the radius?"),
    ("diameter-doubled", 0.5, "half as large: is the column d twice the diameter?"),
    ("diameter-in-micrometres", 1e-6, "a millionth of what is given: is it in micrometres?"),
    ("diameter-in-millimetres", 1e-3, "a thousandth of what is given: is it in millimetres?"),
    ("diameter-factor-1000", 1e3, "a thousand times as large: which unit has the column d?"),
];
/// The same for speeds.
const SPEED_SLIPS: [(&str, f64, &str); 4] = [
    ("speed-in-millimetres", 1e-3, "a thousandth of what is given: are they in mm/s?"),
    ("speed-in-centimetres", 1e-2, "a hundredth of what is given: are they in cm/s?"),
    ("speed-in-kilometres-per-hour", 1.0 / 3.6, "divided by 3.6: are they in km/h?"),
    ("speed-factor-1000", 1e3, "a thousand times as large: which unit do they have?"),
];
/// Numbers of a material, and factors that a unit or a misplaced digit makes.
const MATERIAL_SLIPS: [(&str, &[f64]); 3] = [
    ("density", &[1e3, 1e-3]),
    ("youngs_modulus", &[0.1, 10.0, 1e-3, 1e3]),
    ("yield_strength", &[0.1, 10.0, 1e-3, 1e3]),
];
/// From degrees Celsius to kelvin.
const CELSIUS: f64 = 273.15;

/// Inputs that may be off by a factor that nothing tells, and the factors tried.
const SCALED: [&str; 3] = ["v_n", "v_t", "d"];
const FACTORS: [f64; 12] = [0.2, 0.3, 0.45, 0.6, 0.7, 0.85, 1.18, 1.4, 1.7, 2.2, 3.3, 5.0];

/// All slips that a model and its file allow.
pub(super) fn slips(base: &Model, text: &str) -> Vec<OtherReading> {
    let mut all = Vec::new();
    for (id, factor, words) in SIZE_SLIPS {
        all.push(of_rows(id, format!("These numbers fit if d were {words}"), move |row| {
            scale("d", row, factor);
        }));
    }
    for (id, factor, words) in SPEED_SLIPS {
        all.push(of_rows(id, format!("These numbers fit if the speeds were {words}"), move |row| {
            for name in ["v_n", "v_t", "v_gas"] {
                scale(name, row, factor);
            }
        }));
    }
    let angle = "These numbers fit if v_n and v_t were exchanged: is the angle measured from the other side?";
    all.push(of_rows("angle-from-other-side", angle.to_owned(), |row| {
        std::mem::swap(&mut row.impact.normal_speed, &mut row.impact.tangential_speed);
    }));
    let celsius = "These numbers fit if the temperatures were 273.15 K higher: are they in degrees Celsius?";
    all.push(of_rows("temperature-in-celsius", celsius.to_owned(), |row| {
        row.impact.particle_temperature += CELSIUS;
        row.impact.wall_temperature += CELSIUS;
    }));
    let words =
        "These numbers fit if the particle temperature were 273.15 K higher: is it in degrees Celsius?";
    all.push(of_rows("particle-temperature-in-celsius", words.to_owned(), |row| {
        row.impact.particle_temperature += CELSIUS;
    }));
    all.push(energy_for_speed());
    all.extend(SCALED.map(by_a_factor));
    all.extend(of_materials(base, text));
    all
}

fn of_rows(
    id: &str,
    explanation: String,
    change: impl Fn(&mut Measurement) + Send + Sync + 'static,
) -> OtherReading {
    OtherReading {
        id: format!("slip:{id}"),
        question: Box::new(move |_| explanation.clone()),
        change: Box::new(move |row, _, _| {
            change(row);
            Some(0.0)
        }),
        values: vec![1.0],
        freedom: 0.0,
        model: None,
    }
}

/// Ratios of energies given for ratios of speeds.
fn energy_for_speed() -> OtherReading {
    let words =
        "These numbers fit if the readings were ratios of energies: are e_n and e_t squared speed ratios?";
    let change = |row: &mut Measurement| {
        if row.limits.iter().any(Option::is_some) {
            return None;
        }
        let readings = [&mut row.e_n, &mut row.e_t].into_iter().flatten();
        readings.map(root).sum::<Option<f64>>()
    };
    let of_rows = of_rows("energy-for-speed", words.to_owned(), |_| {});
    OtherReading { change: Box::new(move |row, _, _| change(row)), ..of_rows }
}

/// Takes the square root of a reading; returns the logarithm of the slope. `None` for a reading that is no square.
fn root(reading: &mut Reading) -> Option<f64> {
    if reading.value <= 0.0 {
        return None;
    }
    let value = reading.value.sqrt();
    *reading = Reading { value, error: reading.error.map(|error| error / (2.0 * value)) };
    Some(-(2.0 * value).ln())
}

/// An input that is off by a factor, as in a wrong calibration.
fn by_a_factor(name: &'static str) -> OtherReading {
    let question = move |factor: f64| {
        format!(
            "These numbers fit if {name} were {factor:.2} times what is given: check its unit and calibration."
        )
    };
    OtherReading {
        question: Box::new(question),
        change: Box::new(move |row, _, factor| {
            scale(name, row, factor);
            Some(0.0)
        }),
        values: FACTORS.to_vec(),
        freedom: 1.0,
        ..of_rows(&format!("{name}-by-a-factor"), String::new(), |_| {})
    }
}

/// Multiplies the input of this name.
fn scale(name: &str, row: &mut Measurement, factor: f64) {
    if let Some(input) = INPUTS.iter().find(|input| input.name == name) {
        let value = (input.value)(&row.impact);
        (input.set)(&mut row.impact, factor * value);
    }
}

/// Slips in the numbers of the materials that the model file defines: in all of them together, and in each.
fn of_materials(base: &Model, text: &str) -> Vec<OtherReading> {
    let Ok(document) = text.parse::<DocumentMut>() else { return Vec::new() };
    let Some(materials) = document.get("materials").and_then(Item::as_table_like) else { return Vec::new() };
    let names: Vec<String> = materials.iter().map(|(name, _)| name.to_owned()).collect();
    let mut groups: Vec<Vec<String>> = names.iter().map(|name| vec![name.clone()]).collect();
    if names.len() > 1 {
        groups.insert(0, names);
    }
    let mut all = Vec::new();
    for (key, factors) in MATERIAL_SLIPS {
        for &factor in factors {
            for group in &groups {
                let Some(model) = scaled(&document, group, key, factor) else { continue };
                if model.walls().len() != base.walls().len() {
                    continue;
                }
                let of = group.join(" and ");
                let times = if factor >= 1.0 { format!("{factor}") } else { format!("1/{}", 1.0 / factor) };
                let explanation = format!(
                    "These numbers fit if {key} of {of} were {times} times what is given: check its unit and digits."
                );
                let id = format!("{key}-of-{}-times-{times}", group.join("-"));
                all.push(OtherReading { model: Some(model), ..of_rows(&id, explanation, |_| {}) });
            }
        }
    }
    all
}

/// The model with one number of some materials multiplied; `None` where none of them states it.
fn scaled(document: &DocumentMut, group: &[String], key: &str, factor: f64) -> Option<Model> {
    let mut changed = document.clone();
    let mut any = false;
    for name in group {
        let item = changed.get_mut("materials").and_then(|materials| materials.get_mut(name));
        if let Some(item) = item.and_then(|material| material.get_mut(key)) {
            any |= multiply(item, factor);
        }
    }
    any.then(|| Model::from_toml("slip.toml", &changed.to_string()).ok()).flatten()
}

/// Multiplies a number, or the values of a table over temperature.
fn multiply(item: &mut Item, factor: f64) -> bool {
    let product = |value: &Value| number_of(value).map(|number| number * factor);
    if let Some(number) = item.as_value().and_then(product) {
        *item = toml_edit::value(number);
        return true;
    }
    let Some(values) = item.get_mut("value").and_then(Item::as_array_mut) else { return false };
    let numbers: Option<Vec<f64>> = values.iter().map(product).collect();
    let Some(numbers) = numbers else { return false };
    *values = numbers.into_iter().collect();
    true
}
