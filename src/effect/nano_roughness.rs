//! `nano-roughness`: nanometre asperities separate the solids, and adhesion varies from impact to impact.
//!
//! `W -> W (1 - s u)` with `u` drawn uniformly from 0 to 1 and `s` the `spread` [1]: the work of adhesion lies between
//! `1 - s` and 1 times that of two smooth solids (JKR). The mean falls by `s/2`.
//!
//! That adhesion is drawn at random follows the MIGRAINE dust study, which names reduced adhesion
//! on nanometre roughness as one cause of the scatter of `e_n` at low speed; the uniform
//! distribution is assumed. Valid with `thornton-ning` at speeds where adhesion matters. The height
//! of the asperities does not enter; `spread` represents it. One draw, stream
//! `stream::NANO_ROUGHNESS`.

use super::{Effect, EffectInfo, Parameter, Search, stream};
use crate::impact::Impact;
use crate::normal::Contact;

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "nano-roughness",
    about: "adhesion is drawn between a part and all of its value on smooth solids",
    inputs: &[],
    stream: Some(stream::NANO_ROUGHNESS),
    parameters: &[Parameter::new("spread", "1", (0.0, 1.0), Search::Linear(0.2, 1.0))
        .about("largest share of the work of adhesion that roughness takes")],
    build: |values| Box::new(NanoRoughness { spread: values[0] }),
};

#[derive(Debug)]
struct NanoRoughness {
    spread: f64,
}

impl Effect for NanoRoughness {
    fn contact(&self, _: &Impact, contact: Contact, draw: f64) -> Contact {
        Contact { work_of_adhesion: contact.work_of_adhesion * (1.0 - self.spread * draw), ..contact }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{even, wax_on_pyrex};
    use super::*;
    use approx::assert_relative_eq;

    /// An even distribution over a width `s` has the mean `1 - s/2` and the variance `s²/12`.
    #[test]
    fn adhesion_is_even_between_a_part_and_all_of_it() {
        let effect = (INFO.build)(&[0.6]);
        let plain = wax_on_pyrex();
        let share = |draw| {
            let rough = effect.contact(&Impact::default(), plain, draw);
            rough.work_of_adhesion / plain.work_of_adhesion
        };
        let mean = even(1000).map(share).sum::<f64>() / 1000.0;
        let variance = even(1000).map(|draw| (share(draw) - mean).powi(2)).sum::<f64>() / 1000.0;
        assert_relative_eq!(mean, 0.7, max_relative = 1e-9);
        assert_relative_eq!(variance, 0.03, max_relative = 1e-4);
        assert!(even(1000).map(share).all(|share| (0.4..1.0).contains(&share)));
    }
}
