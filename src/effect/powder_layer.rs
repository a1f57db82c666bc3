//! `powder-layer`: powder on the wall dissipates part of the rebound.
//!
//! `e_n -> e_n (r + (1-r) exp(-h/h0))`, with `h` the thickness of the layer [m], `h0` [m] the thickness over
//! which the loss builds up, and `r` [1] the share of `e_n` left by a thick layer.
//!
//! Observed with wax at 84° from the surface (Troiano et al., Fig 10): `e_n` 0.28 on the bare
//! target, 0.10 under 0.25 mm and 0.07 under 1.4 mm of wax powder, the same on a dry target as on
//! syrup. The law is exact at `h = 0`; the other two points give `h0 = 0.128 mm` and `r = 0.25`.
//! The form is assumed and untested. Valid for wax powder up to 1.4 mm, near-normal impacts.

use super::{Effect, EffectInfo, Parameter, QuantityKind, Search};
use crate::impact::Impact;
use crate::normal::Contact;

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "powder-layer",
    about: "powder on the wall dissipates the rebound",
    inputs: &["layer_thickness"],
    stream: None,
    parameters: &[
        Parameter::new("thickness", "m", (1e-9, 1.0), Search::InputWidth("layer_thickness"))
            .about("layer thickness over which the loss builds up"),
        Parameter::new("residual", "1", (0.0, 1.0), Search::Linear(0.0, 0.95))
            .kind(QuantityKind::Share)
            .about("share of e_n left over a thick layer"),
    ],
    build: |values| Box::new(PowderLayer { thickness: values[0], residual: values[1] }),
};

#[derive(Debug)]
struct PowderLayer {
    thickness: f64,
    residual: f64,
}

impl Effect for PowderLayer {
    fn normal_restitution(&self, impact: &Impact, _: &Contact, restitution: f64, _: f64) -> Option<f64> {
        let decay = (-impact.layer_thickness / self.thickness).exp();
        Some(restitution * (self.residual + (1.0 - self.residual) * decay))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::wax_on_pyrex;
    use super::*;

    #[test]
    fn troiano_powder_layers() {
        let effect = (INFO.build)(&[0.128e-3, 0.25]);
        let e_n = |layer_thickness: f64| {
            let impact = Impact { layer_thickness, ..Impact::default() };
            effect.normal_restitution(&impact, &wax_on_pyrex(), 0.28, 0.0).unwrap()
        };
        assert_eq!(e_n(0.0), 0.28);
        assert!((e_n(0.25e-3) - 0.10).abs() < 0.005);
        assert!((e_n(1.4e-3) - 0.07).abs() < 0.005);
    }
}
