//! Tabakoff & Wakeman (1981): normal restitution of sand on a turbomachine's metal, fitted over the impact angle.
//!
//! `e_n = 1 - 0.0211 b + 2.28e-4 b² - 8.76e-7 b³`, `b` the angle between path and SURFACE
//! [degrees]: 0 glancing, 90 head-on. No particle sticks.
//!
//! Source: W. Tabakoff, T. Wakeman, "Basic erosion investigation in small turbomachinery",
//! University of Cincinnati, 1981, as coded in an open CFD code, the only source. Particles and
//! target are not stated there (quartz on a nickel or steel alloy at some 100 m/s is assumed), nor
//! is the scatter. The fits for other alloys (Tabakoff, Hamed & Murugan 1996) were not found.
//! Stated for 5 to 70°, where the tangential fit of the same source stays below 1.

use super::ListedNormalLaw;
use crate::law::{FitLimit, Origin, polynomial};

/// The case of the fit, for both restitutions.
pub(crate) static ORIGIN: Origin = Origin {
    source: "Tabakoff & Wakeman 1981, as coded in an open CFD code",
    case: "sand on an alloy of turbomachines",
    range: &[FitLimit::angle(5.0, 70.0), FitLimit::speed(60.0, 190.0)],
};

/// The law.
pub(super) static TABAKOFF_WAKEMAN: ListedNormalLaw = ListedNormalLaw {
    name: "tabakoff-wakeman",
    origin: &ORIGIN,
    parameters: &[],
    restitution: |impact, _, _| {
        let degrees = impact.angle_from_surface().to_degrees();
        Some(polynomial(&[1.0, -0.0211, 2.28e-4, -8.76e-7], degrees).clamp(0.0, 1.0))
    },
    sticking_velocity: None,
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::Impact;
    use crate::normal::Contact;
    use approx::assert_abs_diff_eq;

    /// By hand at 30° from the surface: 1 - 0.633 + 0.2052 - 0.023652 = 0.548548.
    #[test]
    fn one_angle_by_hand() {
        let (normal_speed, tangential_speed) = 30f64.to_radians().sin_cos();
        let impact = Impact { normal_speed, tangential_speed, ..Impact::default() };
        let e_n = (TABAKOFF_WAKEMAN.restitution)(&impact, &Contact::default(), &[0.0; 4]).unwrap();
        assert_abs_diff_eq!(e_n, 0.548548, epsilon = 1e-9);
    }
}
