//! Whitaker & Bons (2018), in part: the cylinder of `bons` with a yield strength that grows with
//! the speed of the impact.
//!
//! `sigma_y = a |v|`, `v_y = sigma_y/sqrt(rho E_c)`, `e_n = min(1, v_y/v_n)`; no adhesion, no particle sticks.
//!
//! `|v|` speed [m/s], `v_n` speed towards the wall [m/s], `a` `strength_per_speed` [Pa s/m], `rho`
//! density of the particle [kg/m³], `E_c` composite modulus [Pa] (see `bons`). A head-on particle
//! that yields keeps the same share of its speed at any speed, `a/sqrt(rho E_c)`; an oblique one
//! more.
//!
//! Source: S. Whitaker, J. Bons, "An improved particle impact model by accounting for rate of
//! strain and stochastic rebound", ASME GT2018-77158. The paper was not found; the equation is as
//! coded in an open CFD code that names it, the only source. The random part of the paper's model
//! is left out, and no value of `a` was found: there is no default. The case of its fit is not
//! known to us; the limits are those of `bons` (assumed).

use super::bons::{elastic_plastic, yield_velocity};
use super::{ListedNormalLaw, bons};
use crate::law::{Origin, Parameter, Search};

/// The law.
pub(super) static WHITAKER_BONS: ListedNormalLaw = ListedNormalLaw {
    name: "whitaker-bons",
    origin: &Origin {
        source: "Whitaker & Bons 2018, as coded in an open CFD code",
        case: "ash and dust in turbines",
        range: bons::ORIGIN.range,
    },
    parameters: &[Parameter::new("strength_per_speed", "Pa s/m", (1.0, 1e12), Search::Log(1e5, 1e8))
        .about("yield strength over the speed of the impact")],
    restitution: |impact, contact, values| {
        let strength = values[0] * impact.speed();
        Some(elastic_plastic(impact.normal_speed, yield_velocity(strength, contact)))
    },
    sticking_velocity: None,
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::Impact;
    use crate::normal::Contact;
    use approx::assert_relative_eq;

    /// a = 4e6 Pa s/m, sqrt(rho E_c) = 1.118034e7: head-on 0.35777088 at any speed; at 30° from the surface twice that.
    #[test]
    fn the_share_kept_depends_on_the_angle_alone() {
        let contact = Contact { density: 2500.0, reduced_modulus: 50e9, ..Contact::default() };
        let e_n = |speed: f64, degrees: f64| {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let impact =
                Impact { normal_speed: speed * sine, tangential_speed: speed * cosine, ..Impact::default() };
            (WHITAKER_BONS.restitution)(&impact, &contact, &[4e6, 0.0, 0.0, 0.0]).unwrap()
        };
        assert_relative_eq!(e_n(10.0, 90.0), 0.35777088, max_relative = 1e-7);
        assert_relative_eq!(e_n(80.0, 90.0), 0.35777088, max_relative = 1e-7);
        assert_relative_eq!(e_n(80.0, 30.0), 0.71554175, max_relative = 1e-7);
        assert_eq!(e_n(80.0, 15.0), 1.0);
    }
}
