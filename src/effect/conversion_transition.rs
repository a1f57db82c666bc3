//! `conversion-transition`: char becomes sticky once most of its carbon is gone.
//!
//! Capture rises with the particle's stickiness, and `e_n` falls to `e_n (1 - softening S)`;
//! `softening` is 0 unless given. `S = (1 + (2^(1/a) - 1) exp((X_50 - X_c) / width))^-a`; with the
//! default asymmetry `a` = 1 the logistic `1 / (1 + exp((X_50 - X_c) / width))`: below the
//! threshold the refractory carbon encloses the molten ash, beyond it the ash encloses the
//! remaining carbon. `X_c` carbon conversion [1], `X_50` threshold [1], `width` [1]. With
//! `melting-transition` a particle needs both to stick, so the two are multiplied.
//!
//! Observed with coal on a deposition plate (Li et al., in Troiano et al., Fig 12): the sharp rise
//! lies at a conversion of 0.88 to 0.90. Valid for one coal; particles without carbon have `X_c =
//! 1`.

use super::transition::{ASYMMETRY, Variable, transition};
use super::{EffectInfo, Parameter, QuantityKind, Search};

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "conversion-transition",
    about: "capture rises past a carbon conversion",
    inputs: &["conversion"],
    stream: None,
    parameters: &[
        Parameter::new("threshold", "1", (0.0, 1.0), Search::InputRange("conversion"))
            .kind(QuantityKind::Share)
            .about("carbon conversion at which half of the impacts stick"),
        Parameter::new("width", "1", (1e-6, 10.0), Search::InputWidth("conversion"))
            .about("conversion over which the odds of sticking change by e"),
        Parameter::new("softening", "1", (0.0, 1.0), Search::Linear(0.0, 1.0))
            .kind(QuantityKind::Share)
            .default(0.0)
            .about("share of e_n that a sticky particle loses where it still rebounds"),
        ASYMMETRY,
    ],
    build: |values| transition(Variable::Conversion, values),
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::Impact;

    #[test]
    fn capture_rises_past_the_threshold() {
        let effect = (INFO.build)(&[0.89, 0.01, 0.0, 1.0]);
        let stickiness = |conversion: f64| {
            effect.particle_stickiness(&Impact { conversion, ..Impact::default() }).unwrap()
        };
        assert!(stickiness(0.8) < 1e-3);
        assert!((stickiness(0.89) - 0.5).abs() < 1e-12);
        assert!(stickiness(0.95) > 0.99);
    }
}
