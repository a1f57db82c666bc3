//! Grant & Tabakoff (1975): tangential restitution of sand on an aluminium alloy, fitted over the impact angle.
//!
//! ```text
//! e_t   = 0.988 - 1.66 b + 2.11 b² - 0.67 b³
//! sd(e_t) = -0.0005 + 0.62 b - 0.535 b² + 0.089 b³
//! ```
//!
//! `b` is the angle between path and SURFACE [rad]: 0 glancing, pi/2 head-on. The result is the
//! mean plus `deviation` [1] times the standard deviation, 0 by default, kept between 0 and 1. The
//! fit says nothing of spin, which stays as it was.
//!
//! Source, particles, target and range as for the normal law of the same name; the numbers agree in
//! two compilations. An open CFD code has `0.98723 - 0.030354 b + 7.1913e-4 b² - 4.2979e-6 b³` with
//! `b` in degrees, another curve: higher by 0.03 at 60°, lower by 0.04 head-on.

use super::{ListedTangentialLaw, Rebound};
use crate::law::polynomial;
use crate::normal::grant_tabakoff::{DEVIATION, ORIGIN};

/// The law.
pub(super) static GRANT_TABAKOFF: ListedTangentialLaw = ListedTangentialLaw {
    name: "grant-tabakoff",
    origin: &ORIGIN,
    parameters: &DEVIATION,
    rebound: |kinematics, values| {
        let angle = kinematics.angle_from_surface();
        let mean = polynomial(&[0.988, -1.66, 2.11, -0.67], angle);
        let scatter = polynomial(&[-0.0005, 0.62, -0.535, 0.089], angle).max(0.0);
        Rebound { restitution: (mean + values[0] * scatter).clamp(0.0, 1.0), spin: kinematics.spin }
    },
};

#[cfg(test)]
mod tests {
    use super::super::testing::kinematics;
    use super::*;
    use approx::assert_abs_diff_eq;

    fn e_t(degrees: f64, deviation: f64) -> f64 {
        (GRANT_TABAKOFF.rebound)(&kinematics(degrees, 0.0), &[deviation, 0.0, 0.0, 0.0]).restitution
    }

    /// By hand at 30°, b = 0.5235988: 0.988 - 0.8691740 + 0.5784685 - 0.0961769 = 0.6011176;
    /// scatter -0.0005 + 0.3246312
    /// - 0.1466733 + 0.0127757 = 0.1902337.
    #[test]
    fn mean_and_scatter_by_hand() {
        assert_abs_diff_eq!(e_t(30.0, 0.0), 0.6011176, epsilon = 1e-6);
        assert_abs_diff_eq!(e_t(30.0, -1.0), 0.4108840, epsilon = 1e-6);
    }

    /// The polynomial in degrees of another compilation differs by up to 0.043.
    #[test]
    fn the_curve_in_degrees_is_another() {
        for degrees in [5.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0] {
            let other = polynomial(&[0.98723, -0.030354, 7.1913e-4, -4.2979e-6], degrees);
            assert_abs_diff_eq!(e_t(degrees, 0.0), other, epsilon = 0.043);
        }
    }
}
