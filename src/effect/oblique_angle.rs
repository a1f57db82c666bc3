//! `oblique-angle`: `e_n` falls or rises with the obliquity of the impact, the more the faster the impact.
//!
//! `e_n -> e_n exp(-a s^q (v_n / 1 m/s)^p)` with `s = sin²(theta) = v_t²/(v_n²+v_t²)`, `theta`
//! counted from the normal, `a` the `strength` [1] (positive lowers `e_n`, negative raises it), `p`
//! the `speed_exponent` [1] and `q` the `sharpness` [1], 2 unless given. Where it raises `e_n`, the
//! normal speed after the impact is at most the total speed `v = sqrt(v_n² + v_t²)` before it, `e_n
//! <= v/v_n`; after the tangential law the model bounds it to the energy that is left
//! (`src/model/energy_bound.rs`).
//!
//! The form is assumed. Observations: Theories let `e_n` depend on `v_n` alone up to about 45° and
//! on the angle beyond (with `q = 2` at most a quarter of `a` acts up to 45°). Tungsten dust on
//! tungsten at a mean `theta` of 60.6° rebounds slower than by Thornton–Ning, the more so the
//! higher `v_n` (set 4 of the dust impacts in the MIGRAINE paper, see docs/why/validation.md). Broom's
//! 11 µm glass on aluminium gained 5 to 10 % from 0 to 45°, finer glass had a lower `e_n` there
//! (cited by Troiano et al.). The sign is therefore free. Valid within the angles and speeds it was
//! fitted on.

use super::{Effect, EffectInfo, Parameter, Search};
use crate::impact::Impact;
use crate::normal::Contact;

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "oblique-angle",
    about: "e_n falls (or rises) with obliquity, the more the faster the impact",
    inputs: &["v_t", "v_n"],
    stream: None,
    parameters: &[
        Parameter::new("strength", "1", (-20.0, 20.0), Search::Linear(-1.5, 3.0))
            .about("loss of ln e_n of a grazing impact at v_n = 1 m/s; negative for a gain"),
        Parameter::new("speed_exponent", "1", (0.0, 3.0), Search::Linear(0.0, 1.5))
            .about("power of v_n with which the loss grows"),
        Parameter::new("sharpness", "1", (0.1, 20.0), Search::Linear(0.5, 4.0)).default(2.0).about(
            "power of sin² of the angle from the normal: the higher, the more \
                 only glancing impacts are concerned",
        ),
    ],
    build: |values| {
        Box::new(ObliqueAngle { strength: values[0], speed_exponent: values[1], sharpness: values[2] })
    },
};

#[derive(Debug)]
struct ObliqueAngle {
    strength: f64,
    speed_exponent: f64,
    sharpness: f64,
}

/// Largest gain of `ln e_n`; only keeps a number finite, as the speed of arrival limits `e_n` far below.
const LARGEST_GAIN: f64 = 600.0;

impl Effect for ObliqueAngle {
    fn may_add_energy(&self) -> bool {
        self.strength < 0.0
    }

    fn normal_restitution(&self, impact: &Impact, _: &Contact, restitution: f64, _: f64) -> Option<f64> {
        let loss = self.strength
            * obliquity(impact).powf(self.sharpness)
            * impact.normal_speed.powf(self.speed_exponent);
        let changed = restitution * (-loss).min(LARGEST_GAIN).exp();
        let no_faster = restitution.max(impact.speed() / impact.normal_speed);
        // Without speed towards the wall there is nothing to limit.
        Some(if impact.normal_speed > 0.0 { changed.min(no_faster) } else { changed })
    }
}

/// `sin²(theta)` [1]: 0 head-on, 1 grazing.
fn obliquity(impact: &Impact) -> f64 {
    let speed = impact.speed();
    if speed > 0.0 { (impact.tangential_speed / speed).powi(2) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::super::testing::wax_on_pyrex;
    use super::*;
    use approx::assert_relative_eq;

    /// `e_n` of an impact whose plain one is 0.4, at `theta` [degrees] from the normal.
    fn e_n([strength, speed_exponent]: [f64; 2], theta: f64, normal_speed: f64) -> f64 {
        let tangential_speed = normal_speed * theta.to_radians().tan();
        let impact = Impact { normal_speed, tangential_speed, ..Impact::default() };
        (INFO.build)(&[strength, speed_exponent, 2.0])
            .normal_restitution(&impact, &wax_on_pyrex(), 0.4, 0.0)
            .unwrap()
    }

    #[test]
    fn head_on_impacts_are_left_alone() {
        assert_eq!(e_n([3.0, 1.5], 0.0, 20.0), 0.4);
        assert_eq!(e_n([-1.5, 1.5], 0.0, 20.0), 0.4);
    }

    /// sin⁴(60.6°) = 0.5761, e^-0.5761 = 0.5621.
    #[test]
    fn tungsten_loses_more_at_higher_speed() {
        assert_relative_eq!(e_n([1.0, 0.5], 60.6, 1.0) / 0.4, 0.5621, max_relative = 1e-3);
        assert!(e_n([1.0, 0.5], 60.6, 2.0) < 0.8 * e_n([1.0, 0.5], 60.6, 1.0));
        assert!(e_n([1.0, 0.0], 30.0, 1.0) > 0.93 * 0.4);
    }

    /// Broom: 5 to 10 % more at 45°.
    #[test]
    fn broom_glass_on_aluminium() {
        let gain = e_n([-0.3, 0.0], 45.0, 10.0) / 0.4;
        assert!((1.05..1.10).contains(&gain), "{gain}");
    }

    #[test]
    fn the_speed_away_from_the_wall_stays_below_that_of_arrival() {
        assert_relative_eq!(e_n([-20.0, 3.0], 60.0, 100.0), 2.0, max_relative = 1e-12);
    }
}
