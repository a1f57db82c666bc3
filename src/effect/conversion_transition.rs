//! `conversion-transition`: char becomes sticky once most of its carbon is gone.
//!
//! Capture rises with the particle's stickiness, and `e_n` falls to `e_n (1 - softening S)`; `softening` is 0 unless given.
//! `S = (1 + (2^(1/a) - 1) exp((X_50 - X_c) / width))^-a`, with the asymmetry `a` = 1, unless given, the
//! logistic `1 / (1 + exp((X_50 - X_c) / width))`: below the threshold the refractory carbon encloses
//! the molten ash, beyond it the ash encloses what carbon is left. `X_c` carbon conversion [1], `X_50` threshold [1],
//! `width` [1]. Together with `melting-transition` both are needed, so their stickiness is multiplied.
//!
//! Seen with coal on a deposition plate (Li et al., in Troiano et al., Fig 12): the sharp rise lies at a conversion of
//! 0.88 to 0.90. Valid for one coal; particles without carbon have `X_c = 1`.

use super::{Effect, Kind, Parameter, Search, Simple, Transition, rise};
use crate::impact::Impact;

pub(super) const KIND: Kind = Kind {
    id: "conversion-transition",
    about: "capture rises past a carbon conversion",
    inputs: &["conversion"],
    stream: None,
    parameters: &[
        Parameter {
            name: "threshold",
            unit: "1",
            bounds: (0.0, 1.0),
            default: None,
            search: Search::Over("conversion"),
            about: "carbon conversion at which half of the impacts stick",
        },
        Parameter {
            name: "width",
            unit: "1",
            bounds: (1e-6, 10.0),
            default: None,
            search: Search::Across("conversion"),
            about: "conversion over which the odds of sticking change by e",
        },
        Parameter {
            name: "softening",
            unit: "1",
            bounds: (0.0, 1.0),
            default: Some(0.0),
            search: Search::Linear(0.0, 1.0),
            about: "share of e_n that a sticky particle loses where it still rebounds",
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
        Box::new(ConversionTransition {
            threshold: values[0],
            width: values[1],
            softening: values[2],
            asymmetry: values[3],
        })
    },
};

#[derive(Debug)]
struct ConversionTransition {
    threshold: f64,
    width: f64,
    softening: f64,
    asymmetry: f64,
}

impl Effect for ConversionTransition {
    fn particle_stickiness(&self, impact: &Impact) -> Option<f64> {
        Some(rise(impact.conversion, self.threshold, self.width, self.asymmetry))
    }

    fn rebound_loss(&self) -> f64 {
        self.softening
    }

    fn simple(&self) -> Option<Simple> {
        Transition::simple(true, self.threshold, self.width, self.asymmetry)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn capture_rises_past_the_threshold() {
        let effect = (KIND.build)(&[0.89, 0.01, 0.0, 1.0]);
        let stickiness = |conversion: f64| {
            effect.particle_stickiness(&Impact { conversion, ..Impact::default() }).unwrap()
        };
        assert!(stickiness(0.8) < 1e-3);
        assert!((stickiness(0.89) - 0.5).abs() < 1e-12);
        assert!(stickiness(0.95) > 0.99);
    }
}
