//! `gas-lift`: a strong flow of gas along the wall raises `e_n` of glancing impacts.
//!
//! `e_n -> e_n (1 + b v_gas cos(alpha))` with `b` the `strength` [s/m], `v_gas` the speed of the
//! gas along the wall [m/s] and `alpha` counted from the surface, so `cos(alpha) = v_t/v`: no
//! effect head-on, the full effect at grazing incidence.
//!
//! The form is assumed, a straight line through two observations: wax at `v_n = 1 m/s` had `e_n`
//! 0.41 at 35° against 0.28 near normal, where the air that drove it flowed four times as fast
//! (Troiano et al., Fig 6, who name lift as the likely cause and give no gas speed at the wall).
//! They give `b v_gas` = 0.57 at 35°. Valid within the fitted gas speeds; the result does not
//! exceed 1, so that lift alone returns no more speed than came in. Where the solver resolves the
//! boundary layer, its drag and lift may already contain part of this effect.

use super::{Effect, EffectInfo, Parameter, Search};
use crate::impact::Impact;
use crate::normal::Contact;

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "gas-lift",
    about: "gas that flows along the wall raises e_n of glancing impacts",
    inputs: &["v_gas", "v_t"],
    stream: None,
    parameters: &[Parameter::new("strength", "s/m", (0.0, 10.0), Search::Log(1e-3, 1.0))
        .about("relative gain of e_n of a grazing impact per gas speed")],
    build: |values| Box::new(GasLift { strength: values[0] }),
};

#[derive(Debug)]
struct GasLift {
    strength: f64,
}

impl Effect for GasLift {
    fn normal_restitution(&self, impact: &Impact, _: &Contact, restitution: f64, _: f64) -> Option<f64> {
        let speed = impact.speed();
        let cosine = if speed > 0.0 { impact.tangential_speed / speed } else { 0.0 };
        let lifted = restitution * (1.0 + self.strength * impact.gas_speed * cosine);
        Some(lifted.min(restitution.max(1.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::wax_on_pyrex;
    use super::*;

    /// `e_n` of wax whose plain one is 0.28, at `alpha` [degrees] from the surface and `v_n = 1 m/s`.
    fn e_n(alpha: f64, gas_speed: f64) -> f64 {
        let tangential_speed = 1.0 / alpha.to_radians().tan();
        let impact = Impact { normal_speed: 1.0, tangential_speed, gas_speed, ..Impact::default() };
        (INFO.build)(&[0.0567]).normal_restitution(&impact, &wax_on_pyrex(), 0.28, 0.0).unwrap()
    }

    /// With the air four times as fast at 35° as near normal, both of the paper's values come out.
    #[test]
    fn troiano_glancing_wax() {
        assert!((e_n(35.0, 10.0) - 0.41).abs() < 0.005);
        assert!((e_n(85.0, 2.5) - 0.28).abs() < 0.005);
    }

    #[test]
    fn no_more_speed_than_came_in() {
        assert_eq!(e_n(45.0, 1e6), 1.0);
    }

    #[test]
    fn still_gas_does_nothing() {
        assert_eq!(e_n(10.0, 0.0), 0.28);
    }
}
