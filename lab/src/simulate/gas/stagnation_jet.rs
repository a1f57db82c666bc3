//! Stagnation-point jet: gas comes down uniformly and turns aside in front of the plane `z = 0`.
//!
//! Inviscid flow between a porous plate of uniform injection and a wall (Taylor 1956; the plug-flow form of opposed
//! jets, Seshadri and Williams 1978), with `U` the speed of the jet [m/s], `H` the height from which it feels the wall
//! [m], and `r` the distance from its axis, the z axis [m]:
//!
//! `u_z = -U sin(pi z / 2H)`, `u_r = (pi U r / 4H) cos(pi z / 2H)` for `0 <= z <= H`; `u_z = -U`, `u_r = 0` above.
//!
//! It fulfils continuity and Euler's equations, its stream function is `psi = U r²/2 sin(pi z / 2H)`, and near the wall
//! it is the linear flow `u_z = -a z`, `u_r = a r/2` with `a = pi U / 2H`. Valid near the axis of a jet that is wide
//! against the particles' sideways motion; the boundary layer on the wall is left out.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use nalgebra::Vector3;

use super::VelocityField;
use crate::simulate::geometry::required_within;
use nearwall::input::{InputError, Section};

/// A jet onto the plane `z = 0`, along the z axis.
#[derive(Debug)]
pub struct StagnationJet {
    speed: f64,
    height: f64,
}

impl StagnationJet {
    /// Reads `speed` [m/s] and `height` [m].
    ///
    /// # Errors
    /// [`InputError::Fault`] when one is missing or not positive.
    pub fn read(section: &Section<'_>) -> Result<Self, InputError> {
        Ok(Self {
            speed: required_within(section, "speed", 0.0, f64::INFINITY)?,
            height: required_within(section, "height", f64::MIN_POSITIVE, f64::INFINITY)?,
        })
    }
}

impl VelocityField for StagnationJet {
    fn velocity(&self, position: &Vector3<f64>) -> Vector3<f64> {
        let phase = FRAC_PI_2 * (position.z / self.height).clamp(0.0, 1.0);
        let (sine, cosine) = phase.sin_cos();
        let outward = FRAC_PI_4 * self.speed / self.height * cosine;
        Vector3::new(outward * position.x, outward * position.y, -self.speed * sine)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn continuity_holds_and_the_wall_is_tight() {
        let jet = StagnationJet { speed: 2.0, height: 0.03 };
        let (position, step) = (Vector3::new(0.004, -0.003, 0.011), 1e-6);
        let slope = |axis: usize| {
            let offset = Vector3::ith(axis, step);
            (jet.velocity(&(position + offset)) - jet.velocity(&(position - offset)))[axis] / (2.0 * step)
        };
        assert!((slope(0) + slope(1) + slope(2)).abs() < 1e-6 * slope(2).abs());
        assert_eq!(jet.velocity(&Vector3::new(0.01, 0.0, 0.0)).z, 0.0);
        assert!((jet.velocity(&Vector3::new(0.0, 0.01, 0.03)) - Vector3::new(0.0, 0.0, -2.0)).norm() < 1e-15);
    }
}
