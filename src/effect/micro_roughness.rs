//! `micro-roughness`: a particle hits a randomly tilted part of the wall.
//!
//! The wall is tilted towards the particle by `delta = sigma z` [rad], `sigma` the `angle` [rad]
//! and `z` a standard normal number truncated to tilts that the particle can hit: `delta > -alpha`
//! (from the outer side; `alpha` is the angle of the path from the mean surface) and `delta < pi/2`
//! (no overhangs). The laws then act in the local frame, and `e_n` and `e_t` are turned back to the
//! mean wall (`src/model/tilted_frame.rs`), where `e_n` may exceed 1.
//!
//! That the geometry of an impact is drawn at random follows the MIGRAINE dust study; a normal
//! distribution of the tilt is the model of Sommerfeld & Huber (1999) for rough channels. Observed
//! as scatter at glancing angles and as `e_n` above 1. Limits: tilts lie in the plane of the
//! impact, so no particle is deflected sideways; and tilts within the bounds are not weighted by
//! how often a path meets them (no shadow weighting). At glancing angles the mean tilt is above 0
//! by the truncation alone. Valid for facets wide against the contact and narrow against the flight
//! between two hits. One draw, stream `stream::MICRO_ROUGHNESS`.

use std::f64::consts::{FRAC_PI_2, SQRT_2};

use statrs::function::erf::{erfc, erfc_inv};

use super::{Effect, EffectInfo, Parameter, Search, stream};
use crate::impact::Impact;

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "micro-roughness",
    about: "the wall is tilted at random where it is hit",
    inputs: &["v_t", "v_n"],
    stream: Some(stream::MICRO_ROUGHNESS),
    parameters: &[Parameter::new("angle", "rad", (0.0, 1.0), Search::Log(0.01, 0.5))
        .about("standard deviation of the facets' tilt")],
    build: |values| Box::new(MicroRoughness { angle: values[0] }),
};

#[derive(Debug)]
struct MicroRoughness {
    angle: f64,
}

impl Effect for MicroRoughness {
    fn tilt(&self, impact: &Impact, draw: f64) -> f64 {
        if self.angle <= 0.0 {
            return 0.0;
        }
        let (lowest, highest) = (-impact.angle_from_surface(), FRAC_PI_2);
        let [above_lowest, above_highest] = [lowest, highest].map(|tilt| share_above(tilt / self.angle));
        let share = above_lowest + draw.clamp(0.0, 1.0) * (above_highest - above_lowest);
        // The cut once more: rounding, and the infinity of a share of 0 or 1.
        (self.angle * quantile_above(share)).max(lowest).min(highest)
    }
}

/// Share of a standard normal distribution above `z`.
fn share_above(z: f64) -> f64 {
    0.5 * erfc(z / SQRT_2)
}

/// The `z` above which this share of a standard normal distribution lies.
fn quantile_above(share: f64) -> f64 {
    SQRT_2 * erfc_inv(2.0 * share)
}

#[cfg(test)]
mod tests {
    use super::super::testing::even;
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    fn tilt(angle: f64, alpha: f64, draw: f64) -> f64 {
        let (normal_speed, tangential_speed) = alpha.sin_cos();
        let impact = Impact { normal_speed, tangential_speed, ..Impact::default() };
        (INFO.build)(&[angle]).tilt(&impact, draw)
    }

    /// Mean of a normal density between the cuts, by the trapezoidal rule.
    fn mean_between(angle: f64, low: f64, high: f64) -> f64 {
        let count = 200_000;
        let step = (high - low) / f64::from(count);
        let (mut weight, mut moment) = (0.0, 0.0);
        for index in 0..=count {
            let tilt = low + step * f64::from(index);
            let end = if index == 0 || index == count { 0.5 } else { 1.0 };
            let density = end * (-0.5 * (tilt / angle).powi(2)).exp();
            weight += density;
            moment += density * tilt;
        }
        moment / weight
    }

    #[test]
    fn tilts_are_normal_where_nothing_is_cut() {
        let mean = even(20_000).map(|draw| tilt(0.05, 1.2, draw)).sum::<f64>() / 20_000.0;
        let square = even(20_000).map(|draw| tilt(0.05, 1.2, draw).powi(2)).sum::<f64>() / 20_000.0;
        assert!(mean.abs() < 1e-6);
        assert_relative_eq!(square.sqrt(), 0.05, max_relative = 1e-3);
        // The table's 97.5 % point.
        assert_relative_eq!(tilt(0.05, 1.2, 0.975), 0.05 * 1.959_964, max_relative = 1e-5);
    }

    #[test]
    fn glancing_particles_hit_only_facets_that_face_them() {
        for (angle, alpha) in [(0.1, 0.0), (0.1, 0.05), (0.5, 0.02), (1.0, 0.7), (1.0, 1.5)] {
            let mean = even(20_000).map(|draw| tilt(angle, alpha, draw)).sum::<f64>() / 20_000.0;
            assert_relative_eq!(mean, mean_between(angle, -alpha, PI / 2.0), epsilon = 2e-4 * angle);
            assert!(even(1000).all(|draw| tilt(angle, alpha, draw) >= -alpha));
        }
        // Half a normal distribution: sigma sqrt(2/pi).
        let grazing = even(20_000).map(|draw| tilt(0.1, 0.0, draw)).sum::<f64>() / 20_000.0;
        assert_relative_eq!(grazing, 0.1 * (2.0 / PI).sqrt(), max_relative = 1e-3);
    }

    #[test]
    fn the_ends_of_chance_stay_on_the_wall() {
        for draw in [0.0, 1.0] {
            for alpha in [0.0, 0.3, PI / 2.0] {
                for angle in [0.0, 1e-300, 0.01, 1.0] {
                    assert!((-alpha..=PI / 2.0).contains(&tilt(angle, alpha, draw)));
                }
            }
        }
    }
}
