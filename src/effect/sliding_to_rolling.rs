//! `sliding-to-rolling`: the particle slides at glancing angles and leaves rolling at steep ones.
//!
//! Replaces the result of the tangential law and of effects before it with the law `sliding-rolling`
//! (`src/tangential/sliding_rolling.rs`) of friction `f` [1]: `e_t = 1 - f (1+e_n) v_n/v_t` up to the critical angle
//! from the surface `alpha_cr = acot((7k-1)/k · f/2 · (1+e_n))`, 5/7 above; spin counts in both.
//!
//! Observed with wax on Pyrex (Troiano et al., Figs 6 and 7): a straight line with `f = 0.28` up to
//! 45°, where the data leave it; `alpha_cr` is 43°. Valid for a rigid sphere; near normal real ones
//! keep more (0.85 at 80°), see `tangential-compliance`. It exists as an effect besides the law so
//! that a diagnosis can propose it.

use super::{Effect, EffectInfo, Parameter, QuantityKind, Search};
use crate::tangential::{ImpactKinematics, Rebound, TangentialLaw};

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "sliding-to-rolling",
    about: "sliding ends at a critical angle, beyond which the particle rolls",
    inputs: &["v_t", "v_n"],
    stream: None,
    parameters: &[Parameter::new("friction", "1", (0.0, 10.0), Search::Linear(0.03, 0.9))
        .kind(QuantityKind::Share)
        .about("friction coefficient of the sliding contact")],
    build: |values| Box::new(SlidingToRolling { friction: values[0] }),
};

#[derive(Debug)]
struct SlidingToRolling {
    friction: f64,
}

impl Effect for SlidingToRolling {
    fn tangential(&self, kinematics: &ImpactKinematics, _: Rebound) -> Rebound {
        TangentialLaw::SlidingRolling { friction: self.friction }.rebound(kinematics)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::kinematics;
    use super::*;

    const BEFORE: Rebound = Rebound { restitution: 0.1, spin: 7.0 };

    /// Troiano Fig 7: `f = 0.28` is the slope of `1 - e_t` over `(1+e_n) tan(alpha)` from 10 to 45°; rolling is 5/7.
    #[test]
    fn troiano_sliding_and_rolling() {
        let effect = (INFO.build)(&[0.28]);
        let e_t = |alpha| effect.tangential(&kinematics(alpha, 0.0), BEFORE).restitution;
        for alpha in [10.0, 20.0, 30.0, 42.0_f64] {
            let slope = (1.0 - e_t(alpha)) / (1.39 * alpha.to_radians().tan());
            assert!((slope - 0.28).abs() < 1e-12, "{slope} at {alpha}");
        }
        for alpha in [45.0, 60.0, 80.0] {
            assert!((e_t(alpha) - 0.714).abs() < 0.001);
        }
    }
}
