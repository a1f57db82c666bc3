//! `agglomerates`: a fraction of the particles are clusters, which rebound with little loss.
//!
//! With the probability `fraction` [1] `e_n` is drawn anew, uniformly around `restitution` [1] with
//! the standard deviation `spread` [1]: `e_n -> restitution + sqrt(12) spread (u - 1/2)`, clamped
//! to 0 to 1.5; otherwise `e_n` is unchanged. Particles held by adhesion stay held.
//!
//! Observed with tungsten dust on tungsten at near-normal incidence: about 25 % of the rebounds
//! lose little (`e_n` above 0.6) and lie off the Thornton–Ning curve that the other 75 % follow;
//! doublets in the deposit suggest agglomerates, besides nanometre roughness and spin (MIGRAINE
//! dust study). Assumed: the draw is uniform and independent of speed and size. Valid for a
//! population, not for one particle. One draw, stream `stream::AGGLOMERATES`: below `fraction` the
//! particle is an agglomerate, and the draw over `fraction`, `u`, sets its rebound.

use super::{Effect, EffectInfo, Parameter, QuantityKind, Search, stream};
use crate::impact::Impact;
use crate::normal::Contact;

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "agglomerates",
    about: "a fraction of the particles rebounds with little loss",
    inputs: &[],
    stream: Some(stream::AGGLOMERATES),
    parameters: &[
        Parameter::new("fraction", "1", (0.0, 1.0), Search::Linear(0.03, 0.6))
            .kind(QuantityKind::Share)
            .about("share of the rebounds that are agglomerates'"),
        Parameter::new("restitution", "1", (0.0, 1.5), Search::Linear(0.5, 1.0))
            .kind(QuantityKind::Share)
            .about("mean e_n of agglomerates"),
        Parameter::new("spread", "1", (0.0, 0.5), Search::Log(0.01, 0.2))
            .about("standard deviation of e_n of agglomerates"),
    ],
    build: |values| Box::new(Agglomerates { fraction: values[0], restitution: values[1], spread: values[2] }),
};

#[derive(Debug)]
struct Agglomerates {
    fraction: f64,
    restitution: f64,
    spread: f64,
}

/// Largest `e_n` [1] that is drawn: spin and tilt can add to what came towards the wall, up to the energy
/// that came in (`src/model/energy_bound.rs`).
const LARGEST_RESTITUTION: f64 = 1.5;

impl Effect for Agglomerates {
    fn may_add_energy(&self) -> bool {
        true
    }

    fn normal_restitution(&self, _: &Impact, _: &Contact, restitution: f64, draw: f64) -> Option<f64> {
        if draw >= self.fraction {
            return Some(restitution);
        }
        let place = draw / self.fraction;
        let drawn = self.restitution + self.spread * 12f64.sqrt() * (place - 0.5);
        Some(drawn.clamp(0.0, LARGEST_RESTITUTION))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{even, wax_on_pyrex};
    use super::*;
    use approx::assert_relative_eq;

    fn e_n(parameters: [f64; 3], chance: f64) -> f64 {
        let effect = (INFO.build)(&parameters);
        effect.normal_restitution(&Impact::default(), &wax_on_pyrex(), 0.3, chance).unwrap()
    }

    /// A quarter of the rebounds lies above 0.6, the rest on the curve.
    #[test]
    fn tungsten_has_a_quarter_above_0_6() {
        let drawn: Vec<f64> = even(20_000).map(|draw| e_n([0.25, 0.8, 0.1], draw)).collect();
        let share =
            |test: fn(&f64) -> bool| drawn.iter().filter(|e_n| test(e_n)).count() as f64 / drawn.len() as f64;
        assert_relative_eq!(share(|e_n| *e_n > 0.6), 0.25, max_relative = 1e-12);
        assert_relative_eq!(share(|e_n| *e_n == 0.3), 0.75, max_relative = 1e-12);
    }

    #[test]
    fn agglomerates_have_the_stated_mean_and_deviation() {
        let drawn: Vec<f64> = even(2000).map(|place| e_n([1.0, 0.8, 0.1], place)).collect();
        let mean = drawn.iter().sum::<f64>() / 2000.0;
        let variance = drawn.iter().map(|e_n| (e_n - mean).powi(2)).sum::<f64>() / 2000.0;
        assert_relative_eq!(mean, 0.8, max_relative = 1e-9);
        assert_relative_eq!(variance.sqrt(), 0.1, max_relative = 1e-4);
        assert_eq!(e_n([1.0, 1.5, 0.5], 1.0 - 1e-9), 1.5);
        assert_eq!(e_n([1.0, 0.0, 0.5], 0.0), 0.0);
    }
}
