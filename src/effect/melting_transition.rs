//! `melting-transition`: a particle becomes sticky as it melts.
//!
//! Particle stickiness `S = (1 + (2^(1/a) - 1) exp((T_50 - T_p) / width))^-a`, with the default asymmetry `a` = 1 the
//! logistic `1 / (1 + exp((T_50 - T_p) / width))`: capture rises with it and `e_n` falls, to
//! `e_n (1 - softening S)`; `softening` [1] is 1 unless given.
//! `T_50` [K] is the particle temperature at which half of head-on impacts stick, `width` [K] the sharpness.
//! Valid around the melting range of one material.
//!
//! Observed with wax on Pyrex (Troiano et al., Figs 12 and 13): capture practically 0 below 50 °C,
//! 8 % at 70 °C and 93 % at 105 °C, which `T_50 = 360.1 K` (87 °C) and `width = 6.96 K` reproduce.
//! The flow test of the same wax (1, 50 and 70 % at 65, 71.1 and 74.6 °C) is sharper and lies
//! lower: a particle sticks later than the wax starts to flow.

use super::transition::{ASYMMETRY, Variable, transition};
use super::{EffectInfo, Parameter, QuantityKind, Search};

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "melting-transition",
    about: "capture rises and e_n falls as the particle melts",
    inputs: &["T_p"],
    stream: None,
    parameters: &[
        Parameter::new("temperature", "K", (100.0, 1e4), Search::InputRange("T_p"))
            .kind(QuantityKind::Temperature)
            .about("particle temperature at which half of the impacts stick"),
        Parameter::new("width", "K", (1e-3, 1e4), Search::InputWidth("T_p"))
            .about("temperature over which the odds of sticking change by e"),
        Parameter::new("softening", "1", (0.0, 1.0), Search::Linear(0.0, 1.0))
            .kind(QuantityKind::Share)
            .default(1.0)
            .about("share of e_n that a molten particle loses where it still rebounds"),
        ASYMMETRY,
    ],
    build: |values| transition(Variable::Temperature, values),
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Model;
    use crate::impact::Impact;

    #[test]
    fn celsius_is_refused_with_the_value_in_kelvin() {
        let model = |temperature: &str| {
            let text = "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n\
                [normal]\nmodel = \"constant\"\ne_n = 0.5\n[tangential]\nmodel = \"constant\"\ne_t = 0.5\n\
                [[effects]]\nkind = \"melting-transition\"\nwidth = 7\ntemperature = ";
            Model::from_toml("model", &format!("{text}{temperature}\n"))
        };
        assert!(model("353.15").is_ok());
        for given in ["80", "{ value = 80, low = 78, high = 82 }"] {
            let message = model(given).unwrap_err().to_string();
            assert!(
                message.contains("nothing softens or melts at 80 K") && message.contains("353.15"),
                "{message}"
            );
        }
    }

    #[test]
    fn troiano_capture_against_temperature() {
        let effect = (INFO.build)(&[360.1, 6.96, 1.0, 1.0]);
        let capture = |celsius: f64| {
            let impact = Impact { particle_temperature: celsius + 273.15, ..Impact::default() };
            effect.particle_stickiness(&impact).unwrap()
        };
        assert!(capture(50.0) < 0.01);
        assert!((capture(70.0) - 0.08).abs() < 0.005);
        assert!((capture(105.0) - 0.93).abs() < 0.005);
        assert!(capture(120.0) > 0.85);
    }
}
