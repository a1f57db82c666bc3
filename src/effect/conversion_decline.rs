//! `conversion-decline`: past a carbon conversion, sticky ash is caught less and less.
//!
//! The particle's stickiness, as the capture criterion and the other effects give it, is multiplied
//! by 1 up to `X_c = peak`, and by `1 - (1 - residual) (X_c - peak)/(1 - peak)` above, which ends
//! at `residual` for `X_c = 1`. `X_c` carbon conversion [1] (a burnt-out particle has 1), `peak`
//! [1] the conversion at which most is caught, `residual` [1] the share of the stickiness left at
//! full conversion. Without a criterion or another effect that makes particles sticky it does
//! nothing.
//!
//! Observed: on a deposition probe in burning coal the collection efficiency rises sharply to a
//! maximum as the burnout approaches a critical value, and decreases slightly beyond (Bool &
//! Johnson, in the introduction of Troiano et al.). The rise is the effect `conversion-transition`;
//! this is the fall. *Assumed*: the straight line and both numbers, which Troiano does not give. A
//! likely cause is the collapse of the porous char to a denser, smaller and smoother particle in
//! the char-slag transition (Li & Whitty, in Troiano et al.; the mechanism not re-read). If the
//! density and the diameter of the impact already follow the conversion, part of the fall is in
//! them: fit `residual` together with them. Valid from `peak` on, for one coal.
//!
//! The deposit that has formed is judged without it: melt that lies on the wall no longer has to be caught.

use super::{Effect, EffectInfo, Parameter, QuantityKind, Search};
use crate::impact::Impact;

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "conversion-decline",
    about: "capture falls again past the conversion at which it is largest",
    inputs: &["conversion"],
    stream: None,
    parameters: &[
        // Below 1, so that the line has a length.
        Parameter::new("peak", "1", (0.0, 0.999_999), Search::InputRange("conversion"))
            .kind(QuantityKind::Share)
            .about("carbon conversion at which most is caught"),
        Parameter::new("residual", "1", (0.0, 1.0), Search::Linear(0.0, 1.0))
            .kind(QuantityKind::Share)
            .about("share of the stickiness left at full conversion"),
    ],
    build: |values| Box::new(ConversionDecline { peak: values[0], residual: values[1] }),
};

#[derive(Debug)]
struct ConversionDecline {
    peak: f64,
    residual: f64,
}

impl Effect for ConversionDecline {
    fn stickiness_factor(&self, impact: &Impact) -> f64 {
        let past = ((impact.conversion - self.peak) / (1.0 - self.peak)).max(0.0);
        1.0 - (1.0 - self.residual) * past
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn factor(peak: f64, residual: f64, conversion: f64) -> f64 {
        (INFO.build)(&[peak, residual]).stickiness_factor(&Impact { conversion, ..Impact::default() })
    }

    /// By hand: peak at 0.9, 0.8 left at 1; halfway, at 0.95, 0.9.
    #[test]
    fn it_falls_in_a_straight_line_from_the_peak_to_the_residual() {
        assert_eq!((factor(0.9, 0.8, 0.0), factor(0.9, 0.8, 0.9)), (1.0, 1.0));
        assert_relative_eq!(factor(0.9, 0.8, 0.95), 0.9, max_relative = 1e-12);
        assert_relative_eq!(factor(0.9, 0.8, 1.0), 0.8, max_relative = 1e-12);
        assert_eq!(factor(0.9, 1.0, 1.0), 1.0);
    }

    #[test]
    fn it_makes_nothing_sticky_by_itself() {
        assert_eq!((INFO.build)(&[0.9, 0.8]).particle_stickiness(&Impact::default()), None);
    }
}
