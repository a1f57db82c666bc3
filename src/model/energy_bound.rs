//! No impact returns more energy than came in, whatever its effects do to `e_n`.
//!
//! ```text
//! e_n² <= 1 + (1 - e_t²) (v_t/v_n)² + (omega² - omega2²) d²/(10 v_n²)
//! ```
//!
//! the kinetic energy of a solid sphere, moment of inertia `m d²/10`, before and after the impact.
//! `v_n`, `v_t` speeds towards and along the wall [m/s], `e_n`, `e_t` restitutions [1], `omega` and `omega2`
//! spin before and after [rad/s], `d` diameter [m]. Without spin and loss along the wall it is `e_n <= 1`.
//!
//! The laws keep the bound by themselves. It acts in models with an effect whose parameters allow a gain
//! ([`may_add_energy`](crate::effect::Effect::may_add_energy)): `oblique-angle` with a negative strength,
//! `agglomerates`, `tangential-compliance`. `gas-lift` may
//! add the work of the gas, but bounds `e_n` at 1 itself, so nothing is left to cut. The rebound along the
//! wall stays as it is. Not bounded: fitted curves, which say what was measured. Where `e_t` alone makes more
//! energy than came in (`tangential-compliance` with `near_normal` above 1 near grazing), `e_n` is 0.

use crate::tangential::{ImpactKinematics, Rebound};

/// Relative rounding error of an energy that counts as none.
const ROUNDING: f64 = 1e-12;

/// `e_n` [1], lowered to the bound where the impact would return more energy than came in.
pub(super) fn bounded(kinematics: &ImpactKinematics, rebound: Rebound) -> f64 {
    let ImpactKinematics { normal_speed, tangential_speed, diameter, spin, normal_restitution: e_n, .. } =
        *kinematics;
    let along = tangential_speed / normal_speed;
    let rim = |spin: f64| spin * diameter / normal_speed;
    let [arriving, leaving] = [(along, rim(spin)), (rebound.restitution * along, rim(rebound.spin))]
        .map(|(u, r)| u * u + 0.1 * r * r);
    let allowed = 1.0 + arriving - leaving;
    // A speed or a spin beyond all numbers leaves nothing to compare.
    let exceeds = e_n * e_n > allowed + ROUNDING * (1.0 + arriving);
    if exceeds { allowed.max(0.0).sqrt().min(e_n) } else { e_n }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn e_n(e_n: f64, e_t: f64, [along, spin, spin_after]: [f64; 3]) -> f64 {
        let kinematics = ImpactKinematics {
            normal_speed: 2.0,
            tangential_speed: along,
            diameter: 1e-4,
            spin,
            normal_restitution: e_n,
            stiffness_ratio: 0.8,
        };
        bounded(&kinematics, Rebound { restitution: e_t, spin: spin_after })
    }

    /// By hand: at v_t = 4 and v_n = 2 m/s, e_t = 0.8 leaves 0.36 · 16/4 = 1.44, so e_n <= sqrt(2.44). A
    /// sphere of 100 µm with 2e4 rad/s that stops turning gives 4e8 · 1e-8/(10 · 4) = 0.1.
    #[test]
    fn what_is_lost_along_the_wall_and_by_spin_is_left_for_the_normal_speed() {
        assert_relative_eq!(e_n(3.0, 0.8, [4.0, 0.0, 0.0]), 2.44f64.sqrt(), max_relative = 1e-14);
        assert_relative_eq!(e_n(3.0, 1.0, [4.0, 2e4, 0.0]), 1.1f64.sqrt(), max_relative = 1e-14);
        assert_relative_eq!(e_n(1.4, 1.0, [0.0, 0.0, 0.0]), 1.0);
    }

    #[test]
    fn what_makes_no_energy_keeps_its_bits() {
        for (normal, along) in [(0.3, 0.7), (1.0, 1.0), (0.999_999_999, 1.0)] {
            assert_eq!(e_n(normal, along, [3.0, 5e3, 5e3]).to_bits(), normal.to_bits());
        }
        assert_eq!(e_n(1.5, 0.5, [1e300, 0.0, 0.0]), 1.5);
        assert_eq!(e_n(0.4, 1.4, [4.0, 0.0, 0.0]), 0.0);
    }
}
