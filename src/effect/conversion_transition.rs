//! `conversion-transition`: char becomes sticky once most of its carbon is gone.
//!
//! Particle stickiness `S = 1 / (1 + exp((X_50 - X_c) / width))`: below the threshold the refractory carbon encloses
//! the molten ash, beyond it the ash encloses what carbon is left. `X_c` carbon conversion [1], `X_50` threshold [1],
//! `width` [1]. Together with `melting-transition` both are needed, so their stickiness is multiplied.
//!
//! Seen with coal on a deposition plate (Li et al., in Troiano et al., Fig 12): the sharp rise lies at a conversion of
//! 0.88 to 0.90. Valid for one coal; particles without carbon have `X_c = 1`.

use super::{Effect, Kind, Parameter, Search, logistic};
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
    ],
    build: |values| Box::new(ConversionTransition { threshold: values[0], width: values[1] }),
};

#[derive(Debug)]
struct ConversionTransition {
    threshold: f64,
    width: f64,
}

impl Effect for ConversionTransition {
    fn particle_stickiness(&self, impact: &Impact) -> Option<f64> {
        Some(logistic(impact.conversion, self.threshold, self.width))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn capture_rises_past_the_threshold() {
        let effect = (KIND.build)(&[0.89, 0.01]);
        let stickiness = |conversion: f64| {
            effect.particle_stickiness(&Impact { conversion, ..Impact::default() }).unwrap()
        };
        assert!(stickiness(0.8) < 1e-3);
        assert!((stickiness(0.89) - 0.5).abs() < 1e-12);
        assert!(stickiness(0.95) > 0.99);
    }
}
