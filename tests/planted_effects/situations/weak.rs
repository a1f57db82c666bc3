//! Effects of half, one and two deviations of the noise.

use crate::campaign::System;
use crate::plant::{self, Plant};
use crate::set_rng::SetRng;
use crate::sets;
use crate::world::Inputs;

use super::expected::Expected;
use super::lab::{Lab, Row};
use super::set::Plan;

/// Root mean square of the effect over the rows, in deviations of the noise.
const SIZES: [f64; 3] = [0.5, 1.0, 2.0];
/// Rows.
const COUNTS: [usize; 2] = [100, 300];

/// The effects by their names in the library.
pub const EFFECTS: [&str; 5] =
    ["thermal-softening", "oblique-angle", "size-dependent-yield", "powder-layer", "strain-rate-hardening"];

/// One of the effects.
pub fn known(effect: &'static str, index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = fast_lab(sets::system_for(effect, rng), rng);
    let strength = rng.uniform((0.3, 1.0));
    let plant = sets::plant_effect(effect, strength, &mut lab.campaign, rng);
    lab.fast();
    lab.plant(plant);
    scaled(lab, effect, Expected::effect(effect), index, rng)
}

/// A number that no model knows.
pub fn humidity(index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = fast_lab(sets::any_system(rng), rng);
    lab.campaign.needs("humidity");
    lab.plant(plant::unknown_number(rng.uniform((0.3, 0.6))));
    scaled(lab, "humidity", Expected::cause(&["unknown:humidity"]), index, rng)
}

/// Labels that no model knows, in a column that is not named like a group.
pub fn operator(index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = fast_lab(sets::any_system(rng), rng);
    let size = rng.uniform((0.2, 0.4));
    lab.plant(plant::unknown_group(vec![0.0, -size, 0.3 * size, 0.8 * size]));
    lab.given.push("operator");
    let named = |row: &mut Row| row.given.push(["anna", "bo", "chen", "dara"][row.x.group].into());
    scaled(lab, "operator", Expected::cause(&["unknown:operator"]), index, rng).each(move |row, _| named(row))
}

/// Powder that holds particles: two to nine tenths of the contrast between no and thick layers.
pub fn capture_by_layer(index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = fast_lab(System::Wax, rng);
    lab.campaign.needs("layer_thickness");
    lab.campaign.layer = (2e-5, 1.5e-3);
    let (size, count) = (SIZES[index % 3], COUNTS[index / 3 % 2]);
    let (low, high) = [(0.3, 0.5), (0.2, 0.6), (0.05, 0.9)][index % 3];
    lab.plant(held_by_layer(low, high, rng.uniform((0.1e-3, 0.4e-3))));
    let mut expected = Expected::cause(&["unknown:layer_thickness", "powder-layer"]);
    expected.cell = Some(format!("{:24} {size:3} {count:4}", "capture by layer"));
    Plan::new(lab, count, expected)
}

/// Capture between two probabilities, over the thickness of the layer.
pub fn held_by_layer(low: f64, high: f64, scale: f64) -> Plant {
    Plant::normal("unknown:layer_thickness", move |x: &Inputs, _, n| {
        n.stick = n.stick.max(high + (low - high) * (-x.layer / scale).exp());
    })
}

/// Where every impact rebounds, with some irrelevant columns.
fn fast_lab(system: System, rng: &mut SetRng) -> Lab {
    let mut lab = Lab::new(system, sets::any_law(system, rng), rng);
    lab.fast();
    lab
}

fn scaled(mut lab: Lab, effect: &str, expected: Expected, index: usize, rng: &mut SetRng) -> Plan {
    let (size, count) = (SIZES[index % 3], COUNTS[index / 3 % 2]);
    lab.scale_effect(size, rng);
    let cell = Some(format!("{effect:24} {size:3} {count:4}"));
    Plan::new(lab, count, Expected { cell, ..expected })
}
