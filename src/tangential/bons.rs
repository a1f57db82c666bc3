//! Bons, Prenter & Whitaker (2017): friction that weakens towards head-on.
//!
//! `u2 = u1 - f (1+e_n) v_n cos² b`, so `e_t = 1 - f (1+e_n) sin b cos b`.
//!
//! `u` speed along the wall [m/s], `v_n` speed towards it [m/s], `b` the angle between path and
//! SURFACE [rad]: 0 glancing, pi/2 head-on; `f` friction coefficient [1]; `e_t` is kept at 0 or
//! above. Spin stays as it was: the model has none.
//!
//! Source as for the normal law of the same name; the equation agrees with an open CFD code that
//! names the paper (0.3 was the friction of an earlier version), with friction after Barker et al.
//! 2013 and the cosine by Bons et al. The lift of adhesion and the shear of the gas, which the
//! paper adds, are left out.

use super::{ListedTangentialLaw, Rebound};
use crate::law::{Parameter, QuantityKind, Search};

/// The law.
pub(super) static BONS: ListedTangentialLaw = ListedTangentialLaw {
    name: "bons",
    origin: &crate::normal::BONS,
    parameters: &[Parameter::new("friction", "1", (0.0, 2.0), Search::Linear(0.03, 0.9))
        .kind(QuantityKind::Share)
        .about("friction coefficient of the sliding contact")],
    rebound: |kinematics, values| {
        let (sine, cosine) = kinematics.angle_from_surface().sin_cos();
        let lost = values[0] * (1.0 + kinematics.normal_restitution) * sine * cosine;
        Rebound { restitution: (1.0 - lost).max(0.0), spin: kinematics.spin }
    },
};

#[cfg(test)]
mod tests {
    use super::super::testing::kinematics;
    use super::*;
    use approx::assert_relative_eq;

    /// f = 0.3, e_n = 0.39: at 45° 1 - 0.3 * 1.39/2 = 0.7915; at 5° nearly, at 90° exactly all is kept.
    #[test]
    fn one_angle_by_hand_and_both_ends() {
        let e_t = |degrees| (BONS.rebound)(&kinematics(degrees, 0.0), &[0.3, 0.0, 0.0, 0.0]).restitution;
        assert_relative_eq!(e_t(45.0), 0.7915, max_relative = 1e-12);
        assert!(e_t(5.0) > 0.96 && (e_t(90.0) - 1.0).abs() < 1e-12);
    }
}
