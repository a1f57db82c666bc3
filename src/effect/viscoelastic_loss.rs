//! `viscoelastic-loss`: a loss in the solids that grows with speed.
//!
//! `e_n -> e_n exp(-(v_n/v_0)^m)` with `v_n` the speed towards the wall [m/s], `v_0` the `speed`
//! [m/s] at which the loss leaves `1/e` of `e_n`, and `m` the `exponent` [1].
//!
//! For slow impacts the loss is `(v_n/v_0)^m`; the theory of viscoelastic spheres begins with `m =
//! 1/5` (Kuwabara & Kono 1987; Ramírez et al., Phys. Rev. E 60 (1999) 4465). Assumed: the
//! exponential beyond small losses, and that it multiplies the result of plasticity and adhesion.
//! Expected of soft particles. Valid over the fitted speeds; size and temperature enter only
//! through the fitted values.

use super::{Effect, EffectInfo, Parameter, Search};
use crate::impact::Impact;
use crate::normal::Contact;

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "viscoelastic-loss",
    about: "a further loss of e_n that grows with speed",
    inputs: &["v_n"],
    stream: None,
    parameters: &[
        Parameter::new("speed", "m/s", (1e-6, 1e9), Search::Log(0.5, 200.0))
            .about("speed towards the wall at which the loss leaves 1/e of e_n"),
        Parameter::new("exponent", "1", (0.1, 3.0), Search::Linear(0.2, 1.5))
            .about("power with which the loss grows with the speed"),
    ],
    build: |values| Box::new(ViscoelasticLoss { speed: values[0], exponent: values[1] }),
};

#[derive(Debug)]
struct ViscoelasticLoss {
    speed: f64,
    exponent: f64,
}

impl Effect for ViscoelasticLoss {
    fn normal_restitution(&self, impact: &Impact, _: &Contact, restitution: f64, _: f64) -> Option<f64> {
        Some(restitution * (-(impact.normal_speed / self.speed).powf(self.exponent)).exp())
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::wax_on_pyrex;
    use super::*;
    use approx::assert_relative_eq;

    fn e_n(exponent: f64, normal_speed: f64) -> f64 {
        let impact = Impact { normal_speed, ..Impact::default() };
        (INFO.build)(&[50.0, exponent]).normal_restitution(&impact, &wax_on_pyrex(), 1.0, 0.0).unwrap()
    }

    /// Viscoelastic spheres lose `v^(1/5)` at first: 32 times the speed, twice the loss.
    #[test]
    fn slow_spheres_lose_with_the_fifth_root_of_speed() {
        let loss = |speed: f64| 1.0 - e_n(0.2, speed);
        assert_relative_eq!(loss(32e-14) / loss(1e-14), 2.0, max_relative = 2e-3);
    }

    #[test]
    fn the_speed_is_where_1_over_e_is_left() {
        assert_relative_eq!(e_n(1.3, 50.0), 0.367_879_441, max_relative = 1e-6);
        assert_eq!(e_n(1.3, 0.0), 1.0);
        assert_eq!(e_n(3.0, 1e9), 0.0);
    }
}
