//! Captures: a threshold of energy, a layer, a temperature; as single outcomes and as classes.

use std::f64::consts::PI;

use crate::campaign::System;
use crate::own_laws;
use crate::plant::Plant;
use crate::set_rng::SetRng;
use crate::sets;

use super::exact;
use super::expected::Expected;
use super::lab::{Lab, Outcomes};
use super::set::Plan;
use super::weak::held_by_layer;

/// Even indices: single outcomes; odd ones: classes with correlated outcomes.
fn plan(mut lab: Lab, names: &[&'static str], index: usize, rng: &mut SetRng) -> Plan {
    let expected = Expected::cause(names);
    if index.is_multiple_of(2) {
        return Plan::new(lab, 200 + rng.below(301), expected);
    }
    lab.outcomes = classes(rng);
    Plan::new(lab, 30 + rng.below(51), expected)
}

fn classes(rng: &mut SetRng) -> Outcomes {
    Outcomes::Classes { impacts: (15, 60), correlation: rng.log_uniform((0.02, 0.15)) }
}

fn lab(rng: &mut SetRng) -> Lab {
    let mut lab = Lab::new(System::Wax, sets::any_law(System::Wax, rng), rng);
    lab.fast();
    lab
}

/// Particles stick below a kinetic energy, so below a speed that falls with the size.
pub fn energy(index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    let density = lab.truth.contact.density;
    let energy = move |v: f64, d: f64| PI / 12.0 * density * d.powi(3) * v * v;
    let (v, d) = (lab.campaign.v_n, lab.campaign.d);
    let (threshold, power) = (energy((v.0 * v.1).sqrt(), (d.0 * d.1).sqrt()), rng.uniform((2.0, 8.0)));
    lab.plant(Plant::normal("adhesion-energy", move |x, _, n| {
        n.stick = n.stick.max(1.0 / (1.0 + (energy(x.v_n, x.d) / threshold).powf(power)));
    }));
    let names = ["unknown:v_n/v_s", "unknown:v_n", "adhesion-energy", "unknown:d", "v_n*d"];
    plan(lab, &names, index, rng)
}

/// Powder holds particles.
pub fn layer(index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    lab.campaign.needs("layer_thickness");
    lab.campaign.layer = (2e-5, 1.5e-3);
    let most = rng.uniform((0.6, 0.95));
    lab.plant(held_by_layer(0.0, most, rng.uniform((0.1e-3, 0.4e-3))));
    plan(lab, &["unknown:layer_thickness", "powder-layer"], index, rng)
}

/// Particles stick from a temperature on.
pub fn temperature(index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    lab.campaign.t_p = (300.0, 390.0);
    let (half, width) = (rng.uniform((340.0, 365.0)), rng.uniform((4.0, 12.0)));
    lab.plant(own_laws::melting(half, width, 0.0));
    plan(lab, &["melting-transition"], index, rng)
}

/// Classes of correlated outcomes; the base is right.
pub fn null(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = Lab::new(System::Char, sets::any_law(System::Char, rng), rng);
    lab.fast();
    exact::melting_base(&mut lab, rng);
    lab.outcomes = classes(rng);
    Plan::new(lab, 40 + rng.below(61), Expected::nothing())
}

/// One in ten of the particles that stick is missed, whatever the impact.
fn missed() -> Plant {
    Plant::normal("capture-ceiling", |_, _, n| n.stick *= 0.9)
}

/// Particles stick from a temperature on by the library's own law, and one in ten of them is missed.
pub fn missed_beside_a_law(index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    lab.campaign.t_p = (300.0, 390.0);
    let law = own_laws::melting(rng.uniform((335.0, 355.0)), rng.uniform((4.0, 12.0)), 0.0);
    let of_law = |(name, value): &(&'static str, f64)| ("melting-transition", *name, *value);
    let parameters = law.parameters.iter().map(of_law).collect();
    lab.plant(law);
    lab.plant(missed());
    let mut plan = plan(lab, &["melting-transition", "unknown:T_p"], index, rng);
    plan.expected.parameters = parameters;
    plan
}

/// One in ten of the particles that stick by the base is missed.
pub fn missed_alone(index: usize, rng: &mut SetRng) -> Plan {
    let mut plan = null(index, rng);
    plan.lab.plant(missed());
    plan
}

/// Particles stick from a temperature on, but at most 70 or 90 % of them.
pub fn saturated(index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    lab.campaign.t_p = (300.0, 400.0);
    let (half, width) = (rng.uniform((335.0, 360.0)), rng.uniform((4.0, 10.0)));
    let ceiling = [0.7, 0.9][index / 2 % 2];
    lab.plant(Plant::normal("melting-transition", move |x, _, n| {
        n.stick = n.stick.max(ceiling / (1.0 + ((half - x.t_p) / width).exp()));
    }));
    let mut plan = plan(lab, &["melting-transition", "unknown:T_p"], index, rng);
    plan.expected.parameters = vec![("melting-transition", "temperature", half)];
    plan
}
