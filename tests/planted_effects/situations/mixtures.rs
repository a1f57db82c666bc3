//! Agglomerates, two causes, and a cause seen by two laboratories.

use crate::plant;
use crate::set_rng::SetRng;
use crate::sets::{self, Design};

use super::expected::{Expected, names_of};
use super::lab::Lab;
use super::nulls::two_laboratories;
use super::set::Plan;

/// A plan of a design of the other sets.
fn of(design: Design) -> Plan {
    let planted = design.plants.iter().map(|plant| names_of(plant.cause)).collect();
    let count = design.campaign.rows;
    Plan::new(Lab::of(design), count, Expected { planted, ..Expected::default() })
}

/// A share of agglomerates: the mean hardly changes.
pub fn agglomerates(index: usize, rng: &mut SetRng) -> Plan {
    of(sets::plan("agglomerates", 1 + index % 2, rng))
}

/// Two effects on different inputs.
pub fn two_causes(index: usize, rng: &mut SetRng) -> Plan {
    let (one, other) = sets::PAIRS[index % sets::PAIRS.len()];
    of(sets::plan_pair(one, other, rng))
}

/// One effect, and two laboratories that differ by an offset; the fresh rows have none.
pub fn laboratories(index: usize, rng: &mut SetRng) -> Plan {
    let effect = ["powder-layer", "thermal-softening", "size-dependent-yield", "oblique-angle"][index % 4];
    let mut plan = of(sets::plan(effect, 2, rng)).grouped(two_laboratories(rng));
    plan.expected.allowed = vec!["unknown:laboratory"];
    plan.expected.gain_may_be_larger = true;
    plan.fresh_alike = false;
    plan.count = 200 + rng.below(301);
    plan
}

/// Powder, softening and a weak third effect: half of the noise.
pub fn three_causes(index: usize, rng: &mut SetRng) -> Plan {
    let mut design = sets::plan_pair("powder-layer", "thermal-softening", rng);
    let noise = design.campaign.noise_e_n;
    let third = if index.is_multiple_of(2) {
        design.campaign.needs("humidity");
        // A smooth step has a deviation of 0.35 over its range; e_n is about 0.4.
        plant::unknown_number(0.5 * noise / (0.35 * 0.4))
    } else {
        sets::plant_effect("size-dependent-yield", 0.0, &mut design.campaign, rng)
    };
    design.plants.push(third);
    of(design)
}
