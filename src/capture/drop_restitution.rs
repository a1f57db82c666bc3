//! Whether and how fast a drop leaves a wall, by contact angle: two laws and what lies between.
//!
//! Up to 120° the balance on spreading and recoil holds (`drop_rebound`, Mao, Kuhn & Tran), which was fitted
//! there. From 150° on the drop hardly touches the wall and bounces by its own surface (`drop_bounce`).
//! Between both the energy that is left, negative for a drop that stays, goes over from one to the
//! other with `w = s² (3 - 2 s)`, `s = (theta - 120°)/30°`: `E = (1 - w) E_spreading + w E_bounce`
//! (*assumed*; no measurement was at hand). Pinning takes its work from each (`drop_pinning`): by a given
//! `receding_angle` on both sides; without one by 5° from 150° on, and nothing up to 120°, as the walls of Mao, Kuhn &
//! Tran had theirs.
//!
//! The drop leaves when `E > 0`, and from 150° on when it also lifts its weight (`w` of that before), with `e_n
//! = sqrt(12 E/We)`. Both energies are below the kinetic energy `We/12` that arrives, so `e_n` is below 1.
//! Energies over the surface energy `pi d² sigma` of the drop, angles [rad].

use super::drop_bounce::{BounceNumbers, bounce_energy, contact_diameter, lift_energy};
use super::drop_pinning::{ContactAngles, USUAL_HYSTERESIS};
use super::drop_rebound::{excess_rebound_energy, maximum_spread};

/// Contact angle [rad] up to which the balance on spreading holds alone.
pub const SPREADS_UP_TO: f64 = 120.0 * std::f64::consts::PI / 180.0;
/// Contact angle [rad] from which a drop bounces by its own surface alone.
pub const BOUNCES_FROM: f64 = 150.0 * std::f64::consts::PI / 180.0;

/// Share [1] of the bounce in what is left, `w`, from the contact angle [rad].
pub fn bounce_share(contact_angle: f64) -> f64 {
    let share = ((contact_angle - SPREADS_UP_TO) / (BOUNCES_FROM - SPREADS_UP_TO)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

/// Kinetic energy [1, of the drop's surface energy] that is left for a drop to leave with; one that
/// stays has too little, or a negative one.
pub fn energy_left(numbers: &BounceNumbers, angles: &ContactAngles) -> f64 {
    let share = bounce_share(angles.contact);
    let bounce = || {
        let pinning = angles.pinning_work(contact_diameter(numbers.weber, numbers.bond), USUAL_HYSTERESIS);
        bounce_energy(numbers) - pinning
    };
    if share == 1.0 {
        return bounce();
    }
    let spreading = spreading_energy(numbers, angles);
    if share == 0.0 { spreading } else { (1.0 - share) * spreading + share * bounce() }
}

/// Energy left by the balance on spreading; where it has no root, that of a disc as wide as the drop,
/// with which the roots end and which never leaves.
fn spreading_energy(numbers: &BounceNumbers, angles: &ContactAngles) -> f64 {
    let reynolds = numbers.weber.sqrt() / numbers.ohnesorge;
    let spread = maximum_spread(numbers.weber, reynolds, angles.contact).unwrap_or(1.0);
    excess_rebound_energy(spread, angles.contact) - angles.pinning_work(spread, 0.0)
}

/// Normal restitution `e_n` [1] of a drop that leaves the wall; `None` for one that stays.
pub fn drop_restitution(numbers: &BounceNumbers, angles: &ContactAngles) -> Option<f64> {
    let left = energy_left(numbers, angles);
    let lift = bounce_share(angles.contact) * lift_energy(numbers);
    (left > lift).then(|| (12.0 * left / numbers.weber).sqrt().min(1.0))
}
