//! `thermal-softening`: a hot particle is weaker and softer.
//!
//! `sigma_y -> sigma_y s` and `E* -> E* sqrt(s)` with `s = exp(-max(0, T_p - onset)/scale)`; `T_p`
//! particle temperature [K], `onset` [K], `scale` [K]. The yield velocity is proportional to
//! `s^(3/2)`. Strength changes by twelve decades at most.
//!
//! Assumed: the exponential, and that the modulus falls more slowly than the strength (`sqrt(s)`).
//! Both are known to fall for tungsten (the MIGRAINE dust study lets them depend on temperature,
//! without giving the laws) and expected of hot ash. Valid below melting; beyond it use
//! `melting-transition`. It multiplies the temperature tables of a material, if any. It softens the
//! whole contact: the particle is assumed to yield before the wall and to contribute most of the
//! compliance.

use super::{Effect, EffectInfo, Parameter, QuantityKind, Search, bounded};
use crate::impact::Impact;
use crate::normal::Contact;

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "thermal-softening",
    about: "yield strength and modulus fall with the particle's temperature",
    inputs: &["T_p"],
    stream: None,
    parameters: &[
        Parameter::new("onset", "K", (100.0, 1e4), Search::InputRange("T_p"))
            .kind(QuantityKind::Temperature)
            .about("particle temperature from which it softens"),
        Parameter::new("scale", "K", (1.0, 1e5), Search::InputWidth("T_p"))
            .about("temperature over which the yield strength falls by e"),
    ],
    build: |values| Box::new(ThermalSoftening { onset: values[0], scale: values[1] }),
};

#[derive(Debug)]
struct ThermalSoftening {
    onset: f64,
    scale: f64,
}

impl Effect for ThermalSoftening {
    fn contact(&self, impact: &Impact, contact: Contact, _: f64) -> Contact {
        let excess = (impact.particle_temperature - self.onset).max(0.0);
        let share = bounded((-excess / self.scale).exp());
        Contact {
            yield_strength: contact.yield_strength * share,
            reduced_modulus: contact.reduced_modulus * share.sqrt(),
            ..contact
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::wax_on_pyrex;
    use super::*;
    use crate::normal::yield_velocity;
    use approx::assert_relative_eq;

    fn softened(particle_temperature: f64) -> Contact {
        let impact = Impact { particle_temperature, ..Impact::default() };
        (INFO.build)(&[400.0, 100.0]).contact(&impact, wax_on_pyrex(), 0.0)
    }

    #[test]
    fn cold_particles_keep_their_strength() {
        assert_eq!(softened(293.15), wax_on_pyrex());
        assert_eq!(softened(400.0), wax_on_pyrex());
    }

    /// At the onset plus scale · ln 4 = 138.63 K a quarter of the strength, half of the modulus, and by
    /// `v_y ~ sqrt(sigma_y⁵/E*⁴)` an eighth of the yield velocity.
    #[test]
    fn a_quarter_of_the_strength_goes_with_half_of_the_modulus() {
        let (hot, cold) = (softened(538.6294), wax_on_pyrex());
        assert_relative_eq!(hot.yield_strength / cold.yield_strength, 0.25, max_relative = 1e-6);
        assert_relative_eq!(hot.reduced_modulus / cold.reduced_modulus, 0.5, max_relative = 1e-6);
        assert_relative_eq!(yield_velocity(&hot) / yield_velocity(&cold), 0.125, max_relative = 1e-6);
    }
}
