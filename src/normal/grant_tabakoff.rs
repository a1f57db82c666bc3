//! Grant & Tabakoff (1975): normal restitution of sand on an aluminium alloy, fitted over the impact angle.
//!
//! ```text
//! e_n   = 0.993 - 1.76 b + 1.56 b² - 0.49 b³
//! sd(e_n) = 2.15 b - 5.02 b² + 4.05 b³ - 1.085 b⁴
//! ```
//!
//! `b` is the angle between path and SURFACE [rad]: 0 glancing, pi/2 head-on. The result is the
//! mean plus `deviation` [1] times the standard deviation, 0 by default, kept between 0 and 1. No
//! particle sticks.
//!
//! Source: G. Grant, W. Tabakoff, "Erosion prediction in turbomachinery resulting from
//! environmental solid particles", J. Aircraft 12 (1975) 471–478, not re-read; the numbers agree in
//! two compilations. An open CFD code has `0.99288 - 0.030708 b + 4.7389e-4 b²
//! - 2.5845e-6 b³` with `b` in degrees, which is the same curve within 0.006.
//!
//! Quartz sand of 20 to 200 µm on 2024 aluminium at some 60 to 190 m/s (particles, target and range
//! from memory). Speed, size and materials do not enter: elsewhere the outcome is marked as outside
//! the range.

use super::ListedNormalLaw;
use crate::law::{FitLimit, Origin, Parameter, Search, polynomial};

/// The case of the fit, for both restitutions.
pub(crate) static ORIGIN: Origin = Origin {
    source: "Grant & Tabakoff 1975",
    case: "quartz sand on 2024 aluminium",
    range: &[FitLimit::angle(5.0, 90.0), FitLimit::diameter(20e-6, 200e-6), FitLimit::speed(60.0, 190.0)],
};

/// How far from the mean, for both restitutions.
pub(crate) static DEVIATION: [Parameter; 1] =
    [Parameter::new("deviation", "1", (-3.0, 3.0), Search::Linear(-2.0, 2.0))
        .default(0.0)
        .about("standard deviations added to the mean")];

/// The law.
pub(super) static GRANT_TABAKOFF: ListedNormalLaw = ListedNormalLaw {
    name: "grant-tabakoff",
    origin: &ORIGIN,
    parameters: &DEVIATION,
    restitution: |impact, _, values| {
        let angle = impact.angle_from_surface();
        let mean = polynomial(&[0.993, -1.76, 1.56, -0.49], angle);
        let scatter = polynomial(&[0.0, 2.15, -5.02, 4.05, -1.085], angle).max(0.0);
        Some((mean + values[0] * scatter).clamp(0.0, 1.0))
    },
    sticking_velocity: None,
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::Impact;
    use crate::normal::Contact;
    use approx::assert_abs_diff_eq;

    fn e_n(degrees: f64, deviation: f64) -> f64 {
        let (normal_speed, tangential_speed) = degrees.to_radians().sin_cos();
        let impact = Impact { normal_speed, tangential_speed, ..Impact::default() };
        (GRANT_TABAKOFF.restitution)(&impact, &Contact::default(), &[deviation, 0.0, 0.0, 0.0]).unwrap()
    }

    /// The polynomial in degrees of another compilation, from the surface.
    #[test]
    fn the_curve_agrees_with_the_one_in_degrees() {
        for degrees in [5.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0] {
            let other = polynomial(&[0.99288, -0.030708, 4.7389e-4, -2.5845e-6], degrees);
            assert_abs_diff_eq!(e_n(degrees, 0.0), other, epsilon = 0.006);
        }
    }

    /// By hand at 30°, b = 0.5235988: 0.993 - 0.9215338 + 0.4276829 - 0.0703383 = 0.4288107;
    /// scatter 1.1257374 - 1.3762615
    /// + 0.5813677 - 0.0815501 = 0.2492935. Glancing particles keep more: the angle is counted from the surface.
    #[test]
    fn mean_and_scatter_by_hand() {
        assert_abs_diff_eq!(e_n(30.0, 0.0), 0.4288107, epsilon = 1e-6);
        assert_abs_diff_eq!(e_n(30.0, 1.0), 0.6781042, epsilon = 1e-6);
        assert!(e_n(5.0, 0.0) > 0.8 && e_n(85.0, 0.0) < 0.25);
    }
}
