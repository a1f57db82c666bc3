//! Laws that are none of the library's, over inputs that it knows.

use crate::campaign::System;
use crate::contact::Tangential;
use crate::plant::Plant;
use crate::set_rng::SetRng;
use crate::sets;
use crate::world::Inputs;

use super::expected::{Bound, Expected};
use super::lab::{Lab, Row};
use super::set::Plan;

/// Share of the range that a value has passed.
fn part(value: f64, (low, high): (f64, f64)) -> f64 {
    ((value - low) / (high - low)).clamp(0.0, 1.0)
}

fn lab(rng: &mut SetRng) -> Lab {
    let system = [System::Wax, System::Char][rng.below(2)];
    let mut lab = Lab::new(system, sets::any_law(system, rng), rng);
    lab.fast();
    lab.campaign.noise_e_n = rng.uniform((0.02, 0.04));
    lab.campaign.noise_e_t = lab.campaign.noise_e_n;
    lab
}

/// The level of a curve is a number of the base as well.
const LEVEL: [&str; 3] = ["level*", "calibration:normal*", "calibration:tangential*"];

fn plan(lab: Lab, names: &[&'static str], rng: &mut SetRng) -> Plan {
    Plan::new(lab, 250 + rng.below(551), Expected::cause(names).allowing(&LEVEL).or_refuted())
}

/// e_n rises in a straight line with the temperature.
pub fn rise(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    let (range, most) = (lab.campaign.t_p, rng.uniform((0.3, 0.7)));
    lab.plant(Plant::normal("unknown:T_p", move |x, _, n| n.e_n *= 1.0 + most * part(x.t_p, range)));
    plan(lab, &["unknown:T_p"], rng)
}

/// e_n has a maximum or minimum over the temperature.
pub fn hump(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    let (range, middle) = (lab.campaign.t_p, rng.uniform((0.35, 0.65)));
    let (width, most) = (rng.uniform((0.12, 0.2)), rng.uniform((0.3, 0.5)));
    let most = if rng.chance(0.5) { most } else { -most };
    lab.plant(Plant::normal("unknown:T_p", move |x, _, n| {
        let off = (part(x.t_p, range) - middle) / width;
        n.e_n *= 1.0 + most * (-off * off / 2.0).exp();
    }));
    plan(lab, &["unknown:T_p"], rng)
}

/// Friction falls with the temperature.
pub fn friction(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    let cold = sets::rounded(rng.uniform((0.2, 0.35)));
    let law = Tangential::SlidingRolling { friction: cold };
    (lab.model.tangential, lab.truth.tangential) = (law, law);
    lab.campaign.theta = (20.0, 80.0);
    let (range, lost) = (lab.campaign.t_p, rng.uniform((0.4, 0.8)));
    lab.plant(Plant::tangential("unknown:T_p", move |x, e_n, stiffness_ratio, _| {
        let friction = cold * (1.0 - lost * part(x.t_p, range));
        Tangential::SlidingRolling { friction }.restitution(stiffness_ratio, e_n, x.v_n, x.v_t)
    }));
    // Friction acts on what slides: on the angle and on the temperature.
    let mut plan = plan(lab, &["unknown:T_p"], rng);
    plan.expected.allowed.push("unknown:tan_alpha");
    plan
}

/// A loss with the product of speed and layer.
pub fn product(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    lab.campaign.needs("layer_thickness");
    lab.campaign.layer = (2e-5, 1e-3);
    let (fastest, most) = (lab.campaign.v_n.1, rng.uniform((0.6, 0.9)));
    lab.plant(Plant::normal("unknown:v_n*layer_thickness", move |x, _, n| {
        n.e_n *= 1.0 - most * (x.v_n / fastest) * (x.layer / 1e-3);
    }));
    plan(lab, &["v_n*layer_thickness"], rng)
}

/// Longest time since the particles were charged [s].
const LONGEST: f64 = 600.0;

/// A charge takes speed away until it has decayed, which nearly all of the particles wait for.
pub fn charge(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    lab.given = vec!["since_charging"];
    let since = |x: &Inputs| LONGEST * (x.foreign - 10.0) / 80.0;
    let (decay, most) = (rng.uniform((15.0, 40.0)), rng.uniform((0.4, 0.7)));
    lab.plant(Plant::normal("unknown:since_charging", move |x, _, n| {
        n.e_n *= 1.0 - most * (-since(x) / decay).exp();
    }));
    let given = move |row: &mut Row| row.given = vec![format!("{:.1}", since(&row.x))];
    plan(lab, &["unknown:since_charging"], rng).each(move |row, _| given(row))
}

/// On a bed of grains e_n is a straight line over the inverse sine of the angle of impact (Beladjine et al.
/// 2007): a factor that does not depend on the speed.
pub fn granular_bed(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    lab.campaign.theta = (5.0, 78.0);
    let soft = lab.truth.contact.yield_ratio * rng.uniform((0.2, 0.35));
    lab.truth.contact.yield_ratio = soft;
    lab.model.contact.yield_ratio = soft;
    lab.fast();
    let slope = rng.uniform((1.0, 1.8));
    lab.plant(Plant::normal("unknown:v_t", move |x, _, n| {
        n.e_n *= 1.0 + slope * (x.v_t.hypot(x.v_n) / x.v_n - 1.0);
    }));
    let mut plan = plan(lab, &["unknown:tan_alpha", "unknown:v_t", "v_n*v_t", "oblique-angle"], rng);
    plan.expected.bound = Some(Bound { cause: "oblique-angle", parameter: "strength", range: (-1.5, 3.0) });
    plan
}
