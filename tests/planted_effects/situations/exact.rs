//! Causes whose true law is the library's own.

use crate::campaign::System;
use crate::contact::Tangential;
use crate::own_laws::{melting, powder_layer, size, softening, viscous};
use crate::plant::{self, Plant};
use crate::set_rng::SetRng;
use crate::sets;

use super::expected::Expected;
use super::lab::Lab;
use super::set::Plan;

/// What is planted.
pub const CAUSES: [&str; 8] = [
    "yield-ratio",
    "adhesion-energy",
    "powder-layer",
    "melting-transition",
    "size-dependent-yield",
    "thermal-softening",
    "viscoelastic-loss",
    "calibration:tangential.e_t",
];

/// One of the causes, with its true parameters.
pub fn plan(cause: &'static str, _: usize, rng: &mut SetRng) -> Plan {
    let tungsten = matches!(cause, "yield-ratio" | "adhesion-energy" | "size-dependent-yield");
    let system = if tungsten { sets::any_system(rng) } else { System::Wax };
    let mut lab = Lab::new(system, sets::any_law(system, rng), rng);
    if cause == "adhesion-energy" {
        sets::slow_down(&mut lab.campaign, 1.0);
    } else {
        lab.fast();
    }
    let plant = plant(cause, &mut lab, rng);
    let mut expected = Expected::cause(&[cause]);
    expected.parameters = plant.parameters.iter().map(|(name, value)| (cause, *name, *value)).collect();
    lab.plant(plant);
    Plan::new(lab, rng.log_uniform((80.0, 1000.0)) as usize, expected)
}

fn plant(cause: &'static str, lab: &mut Lab, rng: &mut SetRng) -> Plant {
    let contact = lab.truth.contact;
    let either = |factor: f64, rng: &mut SetRng| if rng.chance(0.5) { factor } else { 1.0 / factor };
    match cause {
        "yield-ratio" => plant::yield_ratio(contact.yield_ratio * either(rng.uniform((1.15, 2.0)), rng)),
        "adhesion-energy" => plant::adhesion_energy(contact.adhesion * rng.uniform((0.2, 0.7))),
        "powder-layer" => {
            lab.campaign.needs("layer_thickness");
            lab.campaign.layer = (2e-5, 1.5e-3);
            powder_layer(rng.uniform((0.08e-3, 0.4e-3)), rng.uniform((0.2, 0.7)))
        }
        "melting-transition" => {
            lab.campaign.t_p = (300.0, 390.0);
            melting(rng.uniform((340.0, 365.0)), rng.uniform((4.0, 12.0)), rng.uniform((0.3, 0.9)))
        }
        "size-dependent-yield" => {
            let tungsten = lab.campaign.system == System::Tungsten;
            lab.campaign.d = if tungsten { (4e-6, 24e-6) } else { (35e-6, 180e-6) };
            lab.fast();
            size(rng.log_uniform(lab.campaign.d), rng.uniform((0.4, 1.2)))
        }
        "thermal-softening" => {
            lab.campaign.t_p = (288.0, 342.0);
            softening(rng.uniform((290.0, 310.0)), rng.uniform((10.0, 40.0)))
        }
        "viscoelastic-loss" => {
            viscous(rng.log_uniform((1.5, 5.0)) * lab.campaign.v_n.1, rng.uniform((0.4, 1.2)))
        }
        _ => {
            let (old, new) = (sets::rounded(rng.uniform((0.6, 0.9))), rng.uniform((0.6, 0.9)));
            lab.model.tangential = Tangential::Constant(old);
            lab.truth.tangential = Tangential::Constant(old);
            let far = if (new - old).abs() < 0.05 { old - 0.1 } else { new };
            let level = Plant::tangential("calibration:tangential.e_t", move |_, _, _, _| far);
            level.with("value", far)
        }
    }
}

/// A base that melts within the range of its particles, in the model file and in truth.
pub fn melting_base(lab: &mut Lab, rng: &mut SetRng) {
    let (low, high) = lab.campaign.t_p;
    let half = (low + (high - low) * rng.uniform((0.35, 0.65))).round();
    let width = (rng.uniform((0.06, 0.15)) * (high - low)).round();
    lab.effects += &format!(
        "\n[[effects]]\nkind = \"melting-transition\"\ntemperature = {half}\nwidth = {width}\nsoftening = 0.5\n"
    );
    let plant = std::sync::Arc::new(melting(half, width, 0.5));
    lab.model.plants.push(plant.clone());
    lab.truth.plants.push(plant);
}
