//! Swirling pipe flow along the z axis, towards larger z.
//!
//! Axial: `plug`, `u_z = U`; or `parabolic`, `u_z = 2 U (1 - r²/R²)` (laminar, Poiseuille), with `U` the bulk speed
//! [m/s] and `R` the pipe's radius [m]. Swirl: a vortex core that turns like a solid body (Lamb–Oseen profile) and
//! dies out along the pipe (exponential decay, Kitoh 1991):
//!
//! `u_theta = Omega (r_c²/r) (1 - exp(-r²/r_c²)) exp(-z/L)`, `Omega` [rad/s] at `z = 0` on the axis, `r_c` the core
//! radius [m] (without it a solid body, `u_theta = Omega r`), `L` the decay length [m] (without it no decay).
//!
//! Continuity is fulfilled: `u_theta` does not depend on the angle, `u_z` not on z. There is no wall boundary layer in
//! a plug flow and no turbulence.

use nalgebra::Vector3;

use super::VelocityField;
use crate::simulate::geometry::required_within;
use nearwall::input::{InputError, Section};

/// Flow along the z axis that turns about it.
#[derive(Debug)]
pub struct SwirlingPipe {
    speed: f64,
    /// The radius of a parabolic profile.
    parabola: Option<f64>,
    swirl: f64,
    core: Option<f64>,
    decay: Option<f64>,
}

impl SwirlingPipe {
    /// Reads `axial_speed` [m/s], `profile`, `radius` [m], `swirl` [rad/s], `core_radius` and `decay_length` [m].
    ///
    /// # Errors
    /// [`InputError::Fault`] when one is missing or out of bounds.
    pub fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let positive = f64::MIN_POSITIVE;
        let profile = section.choice("profile", &["plug", "parabolic"])?;
        let parabola = match profile.as_deref() {
            Some("parabolic") => Some(required_within(section, "radius", positive, f64::INFINITY)?),
            _ => None,
        };
        Ok(Self {
            speed: section.required_number("axial_speed")?,
            parabola,
            swirl: section.required_number("swirl")?,
            core: section.number_within("core_radius", positive, f64::INFINITY)?,
            decay: section.number_within("decay_length", positive, f64::INFINITY)?,
        })
    }
}

impl VelocityField for SwirlingPipe {
    fn velocity(&self, position: &Vector3<f64>) -> Vector3<f64> {
        let square = position.x * position.x + position.y * position.y;
        let axial = match self.parabola {
            Some(radius) => 2.0 * self.speed * (1.0 - square / (radius * radius)).max(0.0),
            None => self.speed,
        };
        // u_theta / r: the solid body's rate times what is left of it outside the core.
        let within = match self.core {
            Some(core) if square > 0.0 => {
                let ratio = square / (core * core);
                -(-ratio).exp_m1() / ratio
            }
            _ => 1.0,
        };
        let left = self.decay.map_or(1.0, |length| (-position.z.max(0.0) / length).exp());
        let rate = self.swirl * within * left;
        Vector3::new(-rate * position.y, rate * position.x, axial)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn core_turns_like_a_solid_body_and_the_outside_like_a_free_vortex() {
        let pipe = |core| SwirlingPipe { speed: 1.0, parabola: Some(0.1), swirl: 50.0, core, decay: None };
        let solid = pipe(None).velocity(&Vector3::new(0.02, 0.0, 0.3));
        assert_eq!(solid.y, 1.0);
        assert!((solid.z - 2.0 * (1.0 - 0.04)).abs() < 1e-15);
        let inner = pipe(Some(0.05)).velocity(&Vector3::new(1e-4, 0.0, 0.0));
        assert!((inner.y - 50.0 * 1e-4).abs() < 1e-8);
        let speed = |r: f64| pipe(Some(0.01)).velocity(&Vector3::new(r, 0.0, 0.0)).y * r;
        assert!((speed(0.08) / speed(0.05) - 1.0).abs() < 1e-9, "r u_theta is constant");
    }
}
