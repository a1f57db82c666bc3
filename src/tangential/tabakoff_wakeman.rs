//! Tabakoff & Wakeman (1981): tangential restitution of sand on a turbomachine's metal, fitted over the impact angle.
//!
//! `e_t = 0.953 - 4.46e-4 b² + 6.48e-6 b³`, `b` the angle between path and SURFACE [degrees]: 0
//! glancing, 90 head-on. Kept at 1 or below: the polynomial passes 1 at 70°, where its range ends,
//! and reaches 2 head-on. Spin stays as it was.
//!
//! Source as for the normal law of the same name, the only one; an older version of that code has
//! other powers of ten, which make `e_t` negative at 15°.

use super::{ListedTangentialLaw, Rebound};
use crate::law::polynomial;
use crate::normal::tabakoff_wakeman::ORIGIN;

/// The law.
pub(super) static TABAKOFF_WAKEMAN: ListedTangentialLaw = ListedTangentialLaw {
    name: "tabakoff-wakeman",
    origin: &ORIGIN,
    parameters: &[],
    rebound: |kinematics, _| {
        let degrees = kinematics.angle_from_surface().to_degrees();
        let e_t = polynomial(&[0.953, 0.0, -4.46e-4, 6.48e-6], degrees);
        Rebound { restitution: e_t.clamp(0.0, 1.0), spin: kinematics.spin }
    },
};

#[cfg(test)]
mod tests {
    use super::super::testing::kinematics;
    use super::*;
    use approx::assert_abs_diff_eq;

    /// By hand at 30° from the surface: 0.953 - 0.4014 + 0.17496 = 0.72656; at 80° the polynomial is 1.416.
    #[test]
    fn one_angle_by_hand_and_the_bound() {
        let e_t = |degrees| (TABAKOFF_WAKEMAN.rebound)(&kinematics(degrees, 5.0), &[0.0; 4]);
        assert_abs_diff_eq!(e_t(30.0).restitution, 0.72656, epsilon = 1e-9);
        assert_eq!((e_t(80.0).restitution, e_t(80.0).spin), (1.0, 5.0));
    }
}
