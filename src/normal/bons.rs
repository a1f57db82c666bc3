//! Bons, Prenter & Whitaker (2017), the deposition model of Ohio State University: an
//! elastic–plastic cylinder with adhesion.
//!
//! The particle is a cylinder with its diameter and volume, so of length `l = 2d/3`, which is
//! pressed flat against the wall:
//!
//! ```text
//! v_y   = sigma_y/sqrt(rho E_c)                       yield begins: w/w_crit = v/v_y,  w_crit = sigma_y l/E_c
//! e_0   = 1 up to v_y,  v_y/v above                   the elastic energy at yield comes back
//! A     = V/(l - w_crit) (a + b (v/v_y)^c)            area of contact
//! e_n²  = e_0² - 2 W A/(m v²)                         adhesion; the particle sticks where this is not positive
//! ```
//!
//! `v` speed towards the wall [m/s], `d` diameter [m], `V` volume [m³], `m` mass [kg], `rho`
//! density of the particle [kg/m³], `E_c` composite modulus [Pa], `1/E_c = (1-nu_p²)/E_p +
//! (1-nu_w²)/E_w` (the contact's `E*`), `sigma_y` yield strength [Pa] (the contact's `p_y`;
//! `yield_ratio` is 1 unless given), `W` work of adhesion [J/m²], `w` deformation and `w_crit` that
//! at yield [m], `l` length [m], `A` area of contact [m²], `e_0` restitution without adhesion [1],
//! `e_n` normal restitution [1], `a`, `b`, `c` `contact_offset`, `contact_slope`,
//! `contact_exponent` [1], by default 0.1, 1/7 and 0.5.
//!
//! Source: J. P. Bons, R. Prenter, S. Whitaker, "A simple physics-based model for particle rebound
//! and deposition in turbomachinery", ASME J. Turbomach. 139 (2017) 081009, not re-read. `v_y` and
//! `e_0` agree with an open CFD code that names the paper (an earlier version of it; the present
//! one lacks `1/sqrt(pi)` in `w`, so that its `e_0` reaches 1.77). The area of contact with `a`,
//! `b`, `c` was recalled from the paper and not checked against a second text. The paper takes 200 MPa and 0.8
//! J/m² for ash, and lets strength and modulus fall above 1000 K: give these in the material. Its
//! removal of deposit by the shear of the gas is left out: an impact does not know that shear.
//!
//! The paper compares with quartz and ash at 20 to 100 m/s and with deposits on hot vanes (range
//! from memory; 5 to 200 m/s is assumed here). Above yield the rebound speed is `v_y` at any speed
//! while the area of contact grows, so fast particles stick again. `w_crit/l` counts as at most one
//! half: beyond that no solid is meant.

use super::{Contact, ListedNormalLaw};
use crate::impact::Impact;
use crate::law::{FitLimit, Origin, Parameter, ParameterValues, Search};

/// The case of the law, for both restitutions.
pub(crate) static ORIGIN: Origin = Origin {
    source: "Bons, Prenter & Whitaker 2017",
    case: "quartz and ash on metals, deposition in turbines",
    range: &[FitLimit::diameter(0.5e-6, 200e-6), FitLimit::speed(5.0, 200.0)],
};

/// The law.
pub(super) static BONS: ListedNormalLaw = ListedNormalLaw {
    name: "bons",
    origin: &ORIGIN,
    parameters: &[
        Parameter::new("contact_offset", "1", (0.0, 10.0), Search::Log(0.01, 1.0))
            .default(0.1)
            .about("area of contact without deformation, over that at yield"),
        Parameter::new("contact_slope", "1", (0.0, 10.0), Search::Log(0.01, 1.0))
            .default(1.0 / 7.0)
            .about("how much the area of contact grows with deformation"),
        Parameter::new("contact_exponent", "1", (0.05, 2.0), Search::Linear(0.2, 1.0))
            .default(0.5)
            .about("power of the deformation in the area of contact"),
    ],
    restitution,
    sticking_velocity: Some(sticking_velocity),
};

fn restitution(impact: &Impact, contact: &Contact, values: &ParameterValues) -> Option<f64> {
    let speed = impact.normal_speed;
    let yielding = yield_velocity(contact.limiting_pressure(), contact);
    let squared = elastic_plastic(speed, yielding).powi(2)
        - adhesion(impact.diameter, contact, values) * area(speed / yielding, values) / (speed * speed);
    // Also no rebound where it is not a number: without speed.
    (squared > 0.0).then(|| squared.min(1.0).sqrt())
}

/// Speed [m/s] at which a cylinder of this strength [Pa] begins to yield.
pub(super) fn yield_velocity(strength: f64, contact: &Contact) -> f64 {
    strength / (contact.density * contact.reduced_modulus).sqrt()
}

/// Restitution without adhesion [1].
pub(super) fn elastic_plastic(speed: f64, yielding: f64) -> f64 {
    if speed > yielding { yielding / speed } else { 1.0 }
}

/// `2 W V/((l - w_crit) m)` [m²/s²]: the squared speed that adhesion takes per share of the area of contact.
fn adhesion(diameter: f64, contact: &Contact, _: &ParameterValues) -> f64 {
    let length = 2.0 / 3.0 * diameter;
    let pressed = (contact.limiting_pressure() / contact.reduced_modulus).min(0.5);
    2.0 * contact.work_of_adhesion / (contact.density * length * (1.0 - pressed))
}

/// Area of contact over `V/(l - w_crit)` [1].
fn area(deformation: f64, values: &ParameterValues) -> f64 {
    values[0] + values[1] * deformation.powf(values[2])
}

/// The slowest speed at which a particle rebounds; infinite where none does. Up to yield the energy
/// grows with `v²` and the adhesion with at most `v²`; bisection.
fn sticking_velocity(impact: &Impact, contact: &Contact, values: &ParameterValues) -> f64 {
    let yielding = yield_velocity(contact.limiting_pressure(), contact);
    let adhesion = adhesion(impact.diameter, contact, values);
    let sticks = |share: f64| (share * yielding).powi(2) <= adhesion * area(share, values);
    if sticks(1.0) {
        return f64::INFINITY;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if sticks(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low * yielding
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const DEFAULTS: ParameterValues = [0.1, 1.0 / 7.0, 0.5, 0.0];

    /// sigma_y = 200 MPa, E_c = 50 GPa, rho = 2500 kg/m³: sqrt(rho E_c) = 1.118034e7, v_y = 17.888544 m/s.
    fn ash(work_of_adhesion: f64) -> Contact {
        Contact {
            density: 2500.0,
            reduced_modulus: 50e9,
            work_of_adhesion,
            yield_strength: 200e6,
            yield_ratio: 1.0,
            stiffness_ratio: 0.8,
            ..Contact::default()
        }
    }

    fn e_n(work: f64, diameter: f64, speed: f64) -> Option<f64> {
        let impact = Impact { diameter, normal_speed: speed, ..Impact::default() };
        restitution(&impact, &ash(work), &DEFAULTS)
    }

    /// Without adhesion: 1 below 17.888544 m/s, 17.888544/60 at 60 m/s.
    #[test]
    fn elastic_then_plastic_by_hand() {
        assert_eq!(e_n(0.0, 1e-5, 17.0), Some(1.0));
        assert_relative_eq!(e_n(0.0, 1e-5, 60.0).unwrap(), 0.298142397, max_relative = 1e-8);
    }

    /// 10 µm, 0.8 J/m², 60 m/s: l = 6.6667e-6 m, w_crit/l = 0.004, 2W/(rho l 0.996) = 96.385542
    /// m²/s²; v/v_y = 3.3541020, root 1.8314207, area 0.36163152; loss 34.856050/3600 = 0.0096822;
    /// e_n² = 0.08888889 - 0.00968224 = 0.07920665.
    #[test]
    fn adhesion_by_hand() {
        assert_relative_eq!(e_n(0.8, 1e-5, 60.0).unwrap(), 0.07920665f64.sqrt(), max_relative = 1e-6);
    }

    #[test]
    fn the_sticking_velocity_is_where_the_rebound_begins() {
        let contact = ash(0.8);
        let impact = Impact { diameter: 1e-5, ..Impact::default() };
        let sticking = sticking_velocity(&impact, &contact, &DEFAULTS);
        assert_eq!(e_n(0.8, 1e-5, sticking * (1.0 - 1e-9)), None);
        assert!(e_n(0.8, 1e-5, sticking * (1.0 + 1e-9)).unwrap() < 1e-3);
        // Small particles never rebound.
        let small = Impact { diameter: 1e-7, ..Impact::default() };
        assert_eq!(sticking_velocity(&small, &contact, &DEFAULTS), f64::INFINITY);
        assert_eq!(e_n(0.8, 1e-7, 10.0), None);
    }
}
