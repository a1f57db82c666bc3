//! Gross sliding: friction acts through the whole contact (Troiano et al., Eq. 10; MIGRAINE, Eq. 4).
//!
//! The normal impulse per mass is `(1+e_n) v_n`; Coulomb friction `f` reduces the tangential speed
//! by that share of it and converts it to spin: `u2 = u1 - f (1+e_n) v_n`, `omega2 = omega1 + 5 f
//! (1+e_n) v_n / d`, hence `e_t = 1 - f (1+e_n) tan(alpha)`.
//!
//! `u` tangential speed [m/s], `omega` spin [rad/s], `d` diameter [m]. Friction follows the slip of the contact
//! point, `s = u1 - omega1 d/2`, so fast forward spin accelerates the particle and backspin may reverse it. Valid below
//! the critical angle of `sliding_rolling`, while the contact slips.
//!
//! Beyond that the law is used as printed, with two limits. Friction without spin can stop the
//! particle but not reverse it. And an impulse `J` per mass changes the energy of motion and spin
//! by `-|s| J + 7/4 J²`, so friction beyond `J = 4|s|/7` would create energy: neither the spin nor,
//! with spin, the speed changes by more than that.

use super::{ImpactKinematics, Rebound};

/// Speed along the wall [m/s], and spin as `[omega_0, x]` for `omega_0 + x/d`, after gross sliding.
/// Without branches, for vectors.
#[inline(always)]
pub(super) fn motion(friction: f64, kinematics: &ImpactKinematics) -> [f64; 3] {
    let slip = kinematics.slip();
    let keeps_energy = 4.0 / 7.0 * slip.abs();
    let most = larger(smaller(kinematics.tangential_speed, slip), keeps_energy);
    let change = smaller(impulse(friction, kinematics), most).copysign(slip);
    let turning = larger(smaller(change, keeps_energy), -keeps_energy);
    [kinematics.tangential_speed - change, kinematics.spin, 5.0 * turning]
}

/// Tangential restitution and spin after gross sliding.
#[inline(always)]
pub(super) fn rebound(friction: f64, kinematics: &ImpactKinematics) -> Rebound {
    kinematics.rebound(motion(friction, kinematics), 0.0)
}

/// Largest change of tangential speed that friction allows [m/s].
#[inline(always)]
pub(super) fn impulse(friction: f64, kinematics: &ImpactKinematics) -> f64 {
    friction * (1.0 + kinematics.normal_restitution) * kinematics.normal_speed
}

/// `f64::min` handles NaN, which costs a vector three instructions instead of one.
#[inline(always)]
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
