//! `strain-rate-hardening`: a faster impact meets a stronger solid.
//!
//! `sigma_y -> sigma_y (v_n/v_0)^m` with `v_n` the speed towards the wall [m/s], `v_0` the `speed`
//! [m/s] at which the material's strength holds and `m` the `exponent` [1]. Far above yield `e_n`
//! falls with `v_n^(-1/4)` without this effect and changes with `v_n^((5m/2-1)/4)` with it; `m =
//! 0.4` makes it constant. Strength changes by twelve decades at most.
//!
//! Observed with sand and metals, whose `p_y` rises with impact speed; the power in the impact
//! speed, rather than in the rate of strain, is assumed: the rate is also proportional to `1/d`,
//! which `size-dependent-yield` covers. Valid over the fitted speeds; for much slower impacts the
//! solid is too weak. The sticking velocity is that of a solid with the strength at the speed of
//! the impact.

use super::{Effect, EffectInfo, Parameter, Search, bounded};
use crate::impact::Impact;
use crate::normal::Contact;

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "strain-rate-hardening",
    about: "the yield strength rises with the speed of the impact",
    inputs: &["v_n"],
    stream: None,
    parameters: &[
        Parameter::new("speed", "m/s", (1e-6, 1e4), Search::Log(1e-3, 1e3))
            .about("speed towards the wall at which the material's yield strength holds"),
        Parameter::new("exponent", "1", (0.0, 2.0), Search::Linear(0.03, 0.8))
            .about("power with which the strength rises with the speed"),
    ],
    build: |values| Box::new(StrainRateHardening { speed: values[0], exponent: values[1] }),
};

#[derive(Debug)]
struct StrainRateHardening {
    speed: f64,
    exponent: f64,
}

impl Effect for StrainRateHardening {
    fn contact(&self, impact: &Impact, contact: Contact, _: f64) -> Contact {
        // At rest the bound keeps a strength above zero.
        let factor = bounded((impact.normal_speed / self.speed).powf(self.exponent));
        Contact { yield_strength: contact.yield_strength * factor, ..contact }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::wax_on_pyrex;
    use super::*;
    use crate::normal::NormalLaw;
    use approx::assert_relative_eq;

    /// Without adhesion, far above yield.
    fn e_n(exponent: f64, normal_speed: f64) -> f64 {
        let plain = Contact { work_of_adhesion: 0.0, ..wax_on_pyrex() };
        let impact = Impact { normal_speed, ..Impact::default() };
        let contact = (INFO.build)(&[1e3, exponent]).contact(&impact, plain, 0.0);
        NormalLaw::ThorntonNing.restitution(&contact, impact.diameter, normal_speed).unwrap()
    }

    /// The plain law's power -1/4 in speed, which 0.4 takes away and 0.8 turns round.
    #[test]
    fn hardening_takes_away_the_fall_with_speed() {
        assert_relative_eq!(e_n(0.0, 1.6e4) / e_n(0.0, 1e3), 0.5, max_relative = 1e-3);
        assert_relative_eq!(e_n(0.4, 1.6e4) / e_n(0.4, 1e3), 1.0, max_relative = 1e-3);
        assert_relative_eq!(e_n(0.8, 1.6e4) / e_n(0.8, 1e3), 2.0, max_relative = 1e-2);
        assert_eq!(e_n(0.4, 1e3), e_n(0.0, 1e3));
    }

    #[test]
    fn a_particle_at_rest_has_a_strength() {
        let contact = (INFO.build)(&[1.0, 2.0]).contact(&Impact::default(), wax_on_pyrex(), 0.0);
        assert!(contact.yield_strength > 0.0);
    }
}
