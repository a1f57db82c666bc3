//! The local frame of a rough wall, whose normal is tilted within the plane of the impact.
//!
//! The laws act in the local frame. With `v_n`, `v_t` the speeds towards and along the mean wall
//! and `delta` the tilt towards the particle [rad]: `v_n' = v_n cos(delta) + v_t sin(delta)`, `v_t'
//! = v_t cos(delta) - v_n sin(delta)`. The rebound is turned back, so `e_n` and `e_t` are ratios of
//! speeds towards and along the mean wall, as a camera measures them; `e_n` may then exceed 1. A
//! rebound that still points into the mean wall is mirrored (it hits the wall again).

use crate::impact::Impact;

/// Tilt of the local wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TiltedFrame {
    /// Angle towards the particle [rad].
    pub tilt: f64,
}

impl TiltedFrame {
    /// Turns an impact into the local frame.
    pub fn turn(self, impact: &mut Impact) {
        if self.tilt == 0.0 {
            return;
        }
        let [normal, tangential] = self.speeds(impact);
        impact.normal_speed = normal.max(0.0);
        impact.tangential_speed = tangential.abs();
        impact.spin = impact.spin.copysign(impact.spin * tangential);
    }

    /// `e_n` and `e_t` [1] with regard to the mean wall, from those of the local frame. Without
    /// speed along the wall `e_t` stays that of the local frame.
    pub fn turn_back(self, arriving: &Impact, turned: &Impact, [e_n, e_t]: [f64; 2]) -> [f64; 2] {
        if self.tilt == 0.0 {
            return [e_n, e_t];
        }
        let (sine, cosine) = self.tilt.sin_cos();
        let [_, tangential] = self.speeds(arriving);
        let (normal, tangential) = (finite(e_n * turned.normal_speed), finite(e_t * tangential));
        let ratio = |speed: f64, before: f64, otherwise: f64| {
            if before > 0.0 { finite(speed / before) } else { otherwise }
        };
        [
            ratio((normal * cosine + tangential * sine).abs(), arriving.normal_speed, e_n),
            ratio(tangential * cosine - normal * sine, arriving.tangential_speed, e_t),
        ]
    }

    /// The spin [rad/s] with the sign of the mean wall: the local frame counts it with the opposite
    /// sign where it reverses `v_t`.
    pub fn spin_back(self, arriving: &Impact, spin: f64) -> f64 {
        if self.tilt != 0.0 && self.speeds(arriving)[1] < 0.0 { -spin } else { spin }
    }

    /// Speeds towards and along the local wall [m/s], the latter with its sign.
    fn speeds(self, impact: &Impact) -> [f64; 2] {
        let (sine, cosine) = self.tilt.sin_cos();
        let (normal, tangential) = (impact.normal_speed, impact.tangential_speed);
        [finite(normal * cosine + tangential * sine), finite(tangential * cosine - normal * sine)]
    }
}

/// Prevents an overflow to infinity, and from there to NaN.
fn finite(number: f64) -> f64 {
    number.clamp(f64::MIN, f64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// A smooth mirror (both restitutions 1) turns the path by twice the tilt.
    #[test]
    fn a_tilted_mirror_turns_the_path_by_twice_the_tilt() {
        let impact = Impact { normal_speed: 1.0, tangential_speed: 2.0, ..Impact::default() };
        for tilt in [-0.2, 0.0, 0.1, 0.3] {
            let frame = TiltedFrame { tilt };
            let mut turned = impact;
            frame.turn(&mut turned);
            let [e_n, e_t] = frame.turn_back(&impact, &turned, [1.0, 1.0]);
            let out = 1f64.atan2(2.0) + 2.0 * tilt;
            let speed = 5f64.sqrt();
            assert_relative_eq!(e_n, speed * out.sin(), max_relative = 1e-12);
            assert_relative_eq!(e_t, speed * out.cos() / 2.0, max_relative = 1e-12);
        }
    }

    #[test]
    fn spin_keeps_its_sense() {
        let impact = Impact { normal_speed: 1.0, tangential_speed: 0.1, spin: 5.0, ..Impact::default() };
        let frame = TiltedFrame { tilt: 0.3 };
        let mut turned = impact;
        frame.turn(&mut turned);
        assert_eq!(turned.spin, -5.0);
        assert_eq!(frame.spin_back(&impact, -5.0), 5.0);
    }
}
