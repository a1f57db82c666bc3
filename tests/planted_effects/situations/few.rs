//! A few averages with stated errors.

use crate::campaign::System;
use crate::contact::Tangential;
use crate::plant;
use crate::set_rng::SetRng;
use crate::sets;

use super::expected::Expected;
use super::lab::{Lab, Outcomes};
use super::set::Plan;
use super::weak;

/// Numbers of averages.
const COUNTS: [usize; 5] = [3, 5, 8, 12, 20];

/// Averages over the speed, each with its error.
fn averages(system: System, rng: &mut SetRng) -> Lab {
    let mut lab = Lab::new(system, sets::any_law(system, rng), rng);
    lab.fast();
    lab.only_speed();
    lab.stated = true;
    lab.outcomes = Outcomes::Absent;
    lab.observed = [true, false];
    lab.averaged = rng.chance(0.5).then(|| 10 + rng.below(51) as u32);
    lab.campaign.noise_e_n = rng.log_uniform((0.003, 0.03));
    lab.campaign.noise_e_t = lab.campaign.noise_e_n;
    lab
}

/// The base is right.
pub fn null(index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = averages(sets::any_system(rng), rng);
    if rng.chance(0.3) {
        lab.campaign.theta = (5.0, 75.0);
        lab.observed = [rng.chance(0.5), true];
    }
    Plan::new(lab, COUNTS[index % 5], Expected::nothing())
}

/// The base misses the level by 5 to 50 stated errors.
pub fn level(index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = averages(sets::any_system(rng), rng);
    let factor = rng.uniform((1.2, 2.2));
    let ratio = lab.truth.contact.yield_ratio * if rng.chance(0.5) { factor } else { 1.0 / factor };
    lab.plant(plant::yield_ratio(ratio));
    lab.campaign.noise_e_n = lab.effect(rng)[0] / rng.log_uniform((5.0, 50.0));
    let names = ["yield-ratio", "calibration:normal*", "level*"];
    Plan::new(lab, COUNTS[index % 5], Expected::cause(&names).or_refuted())
}

/// Another law of e_t over the angle than the base has: it misses by 5 to 50 stated errors.
pub fn angle(index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = averages(sets::any_system(rng), rng);
    lab.campaign.theta = (5.0, rng.uniform((70.0, 82.0)));
    lab.campaign.v_n.1 = lab.campaign.v_n.0 * 1.3;
    lab.observed = [rng.chance(0.5), true];
    let friction = rng.uniform((0.12, 0.35));
    let constant = index.is_multiple_of(2);
    lab.model.tangential = if constant {
        Tangential::Constant(sets::rounded(rng.uniform((0.6, 0.9))))
    } else {
        Tangential::SlidingRolling { friction: sets::rounded(friction * rng.uniform((1.4, 2.0))) }
    };
    lab.truth.tangential = Tangential::SlidingRolling { friction };
    lab.campaign.noise_e_t = lab.effect(rng)[1] / rng.log_uniform((5.0, 50.0));
    let names = ["sliding-to-rolling", "calibration:tangential*"];
    let names = if constant { &names[..1] } else { &names[..] };
    Plan::new(lab, COUNTS[index % 5], Expected::cause(names).or_refuted())
}

/// The strength depends on the size.
pub fn size(index: usize, rng: &mut SetRng) -> Plan {
    effect("size-dependent-yield", None, index, rng)
}

/// Powder on the wall, with errors of 0.03, 0.01 and 0.001.
pub fn layer(index: usize, rng: &mut SetRng) -> Plan {
    effect("powder-layer", Some([0.03, 0.01, 0.001][index % 3]), index, rng)
}

/// The strength falls with the temperature.
pub fn temperature(index: usize, rng: &mut SetRng) -> Plan {
    effect("thermal-softening", None, index, rng)
}

fn effect(effect: &'static str, error: Option<f64>, index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = averages(sets::system_for(effect, rng), rng);
    let strength = rng.uniform((0.2, 1.0));
    let plant = sets::plant_effect(effect, strength, &mut lab.campaign, rng);
    lab.plant(plant);
    if rng.chance(0.5) {
        lab.campaign.v_n.1 = 1.2 * lab.campaign.v_n.0;
    }
    lab.campaign.noise_e_n = error.unwrap_or_else(|| rng.log_uniform((0.003, 0.03)));
    Plan::new(lab, COUNTS[1..][index % 4], Expected::effect(effect).or_refuted())
}

/// Twelve shots and an effect of two deviations of their noise, which half of the sets state.
pub fn twelve(index: usize, rng: &mut SetRng) -> Plan {
    let effect = weak::EFFECTS[index % weak::EFFECTS.len()];
    let mut plan = weak::known(effect, 2, rng);
    plan.lab.stated = rng.chance(0.5);
    plan.count = 12;
    plan.expected = Expected::effect(effect).or_refuted();
    plan
}
