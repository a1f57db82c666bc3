//! Slips of the user: the model or the file does not say what was meant.

use crate::campaign::System;
use crate::set_rng::SetRng;
use crate::sets;

use super::exact;
use super::expected::Expected;
use super::lab::Lab;
use super::set::Plan;

/// Materials stand in the model file; speeds from below sticking on, so that size and density matter.
fn lab(rng: &mut SetRng) -> Lab {
    let system = [System::Tungsten, System::Char][rng.below(2)];
    let mut lab = Lab::new(system, sets::any_law(system, rng), rng);
    sets::slow_down(&mut lab.campaign, 1.0);
    lab
}

fn plan(lab: Lab, rng: &mut SetRng) -> Plan {
    Plan::new(lab, 150 + rng.below(351), Expected::slip())
}

/// The density in g/cm³.
pub fn density(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    lab.model.contact.density /= 1000.0;
    plan(lab, rng)
}

/// Ten times the modulus.
pub fn modulus(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    lab.model.contact.particle.modulus *= 10.0;
    if lab.campaign.system == System::Tungsten {
        lab.model.contact.wall = lab.model.contact.particle;
    }
    plan(lab, rng)
}

/// The radius for the diameter.
pub fn radius(_: usize, rng: &mut SetRng) -> Plan {
    let lab = lab(rng);
    plan(lab, rng).each(|row, _| row.seen.d = row.x.d / 2.0)
}

/// Speeds in mm/s or cm/s.
pub fn speed(index: usize, rng: &mut SetRng) -> Plan {
    let factor = [1000.0, 100.0][index % 2];
    let mut lab = lab(rng);
    lab.fast();
    plan(lab, rng).each(move |row, _| {
        row.seen.v_n = factor * row.x.v_n;
        row.seen.v_t = factor * row.x.v_t;
    })
}

/// The angle from the other side.
pub fn angle(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    lab.fast();
    lab.campaign.theta = (5.0, rng.uniform((30.0, 40.0)));
    plan(lab, rng).each(|row, _| (row.seen.v_n, row.seen.v_t) = (row.x.v_t, row.x.v_n))
}

/// The temperature in °C, where the base melts.
pub fn celsius(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = Lab::new(System::Char, sets::any_law(System::Char, rng), rng);
    lab.fast();
    exact::melting_base(&mut lab, rng);
    plan(lab, rng).each(|row, _| row.seen.t_p = row.x.t_p - 273.15)
}

/// The ratio of energies for that of speeds.
pub fn energy(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    lab.fast();
    plan(lab, rng).each(|row, _| {
        for i in 0..2 {
            row.sigma[i] *= 2.0 * row.measured[i].unwrap_or(1.0).max(0.05);
            row.measured[i] = row.measured[i].map(|value| value * value);
        }
        (row.truth.e_n, row.truth.e_t) = (row.truth.e_n.powi(2), row.truth.e_t.powi(2));
    })
}

/// A misplaced digit where it hardly matters: ten times the modulus of a wall that is 90 times as stiff as
/// the particle, which changes the contact by 1 %. In two thirds of the sets an effect acts; no slip may be
/// asked about.
pub fn harmless(index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = Lab::new(System::Char, sets::any_law(System::Char, rng), rng);
    lab.fast();
    lab.truth.contact.wall.modulus = 90e9;
    lab.model.contact.wall.modulus = 900e9;
    let cause = [None, Some("powder-layer"), Some("size-dependent-yield")][index % 3];
    let expected = cause.map_or_else(Expected::nothing, |cause| {
        let plant = sets::plant_effect(cause, rng.uniform((0.3, 1.0)), &mut lab.campaign, rng);
        lab.plant(plant);
        lab.fast();
        Expected::effect(cause)
    });
    Plan::new(lab, 150 + rng.below(351), expected.never(&["slip:*"]))
}
