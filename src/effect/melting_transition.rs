//! `melting-transition`: a particle becomes sticky as it melts.
//!
//! Particle stickiness `S = (1 + (2^(1/a) - 1) exp((T_50 - T_p) / width))^-a`, with the asymmetry `a` = 1, unless given, the
//! logistic `1 / (1 + exp((T_50 - T_p) / width))`: capture rises with it and `e_n` falls, to
//! `e_n (1 - softening S)`; `softening` [1] is 1 unless given.
//! `T_50` [K] is the particle temperature at which half of head-on impacts stick, `width` [K] the sharpness.
//! Valid around the melting range of one material.
//!
//! Seen with wax on Pyrex (Troiano et al., Figs 12 and 13): capture practically 0 below 50 °C, 8 % at 70 °C and 93 % at
//! 105 °C, which `T_50 = 360.1 K` (87 °C) and `width = 6.96 K` reproduce. The flow test of the same wax (1, 50 and 70 %
//! at 65, 71.1 and 74.6 °C) is sharper and lies lower: a particle sticks later than the wax starts to flow.

use super::{Effect, Kind, Parameter, Search, Simple, Transition, rise};
use crate::impact::Impact;

pub(super) const KIND: Kind = Kind {
    id: "melting-transition",
    about: "capture rises and e_n falls as the particle melts",
    inputs: &["T_p"],
    stream: None,
    parameters: &[
        Parameter {
            name: "temperature",
            unit: "K",
            bounds: (1.0, 1e4),
            default: None,
            search: Search::Over("T_p"),
            about: "particle temperature at which half of the impacts stick",
        },
        Parameter {
            name: "width",
            unit: "K",
            bounds: (1e-3, 1e4),
            default: None,
            search: Search::Across("T_p"),
            about: "temperature over which the odds of sticking change by e",
        },
        Parameter {
            name: "softening",
            unit: "1",
            bounds: (0.0, 1.0),
            default: Some(1.0),
            search: Search::Linear(0.0, 1.0),
            about: "share of e_n that a molten particle loses where it still rebounds",
        },
        Parameter {
            name: "asymmetry",
            unit: "1",
            bounds: (0.01, 100.0),
            default: Some(1.0),
            search: Search::Log(0.2, 10.0),
            about: "above 1 the rise begins steeply and ends slowly, below 1 the other way round",
        },
    ],
    build: |values| {
        Box::new(MeltingTransition {
            temperature: values[0],
            width: values[1],
            softening: values[2],
            asymmetry: values[3],
        })
    },
};

#[derive(Debug)]
struct MeltingTransition {
    temperature: f64,
    width: f64,
    softening: f64,
    asymmetry: f64,
}

impl Effect for MeltingTransition {
    fn particle_stickiness(&self, impact: &Impact) -> Option<f64> {
        Some(rise(impact.particle_temperature, self.temperature, self.width, self.asymmetry))
    }

    fn rebound_loss(&self) -> f64 {
        self.softening
    }

    fn simple(&self) -> Option<Simple> {
        Transition::simple(false, self.temperature, self.width, self.asymmetry)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn troiano_capture_against_temperature() {
        let effect = (KIND.build)(&[360.1, 6.96, 1.0, 1.0]);
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
