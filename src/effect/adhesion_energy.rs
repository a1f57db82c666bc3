//! `adhesion-energy`: the work of adhesion differs from that of the surface energies.
//!
//! `W -> work_of_adhesion` [J/m²], in place of `2 sqrt(gamma_1 gamma_2)` or of the model's own `work_of_adhesion`. The
//! adhesive velocity is proportional to `W^(5/6)`. It overrides changes of `W` by effects before it in the file.
//!
//! Observed with tungsten on steel: 0.13 J/m² measured, far below the value of clean metals; oxide,
//! gas and roughness separate the solids. Valid with `thornton-ning`, whose adhesion is that of
//! JKR: for contacts soft and wide against the range of the surface forces. Slow impacts determine
//! it; fast ones do not.

use super::{Effect, EffectInfo, Parameter, Precomputed, Search};
use crate::impact::Impact;
use crate::normal::Contact;

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "adhesion-energy",
    about: "the work of adhesion differs from that of the surface energies",
    inputs: &[],
    stream: None,
    parameters: &[Parameter::new("work_of_adhesion", "J/m2", (0.0, 1e3), Search::Log(1e-3, 20.0))
        .about("work that separates a unit of contact area")],
    build: |values| Box::new(AdhesionEnergy { work_of_adhesion: values[0] }),
};

#[derive(Debug)]
struct AdhesionEnergy {
    work_of_adhesion: f64,
}

impl Effect for AdhesionEnergy {
    fn contact(&self, _: &Impact, contact: Contact, _: f64) -> Contact {
        Contact { work_of_adhesion: self.work_of_adhesion, ..contact }
    }

    fn precompute(&self) -> Option<Precomputed> {
        Some(Precomputed::WorkOfAdhesion(self.work_of_adhesion))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::wax_on_pyrex;
    use super::*;
    use crate::normal::adhesive_velocity;
    use approx::assert_relative_eq;

    fn holds_up_to(work_of_adhesion: f64) -> f64 {
        let plain = Contact { work_of_adhesion: 7.0, ..wax_on_pyrex() };
        adhesive_velocity(&(INFO.build)(&[work_of_adhesion]).contact(&Impact::default(), plain, 0.0), 75e-6)
    }

    /// Troiano Eq. 1 for wax on Pyrex, `W = 0.346 J/m²`: 0.116 m/s, which is 0.953 of the right number.
    #[test]
    fn troiano_adhesive_velocity() {
        assert_relative_eq!(holds_up_to(0.346), 0.116 / 0.953, max_relative = 0.01);
    }

    #[test]
    fn the_adhesive_velocity_goes_with_the_power_five_sixths() {
        assert_relative_eq!(holds_up_to(6.4) / holds_up_to(0.1), 32.0, max_relative = 1e-12);
        assert_eq!(holds_up_to(0.0), 0.0);
    }
}
