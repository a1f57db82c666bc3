//! `[gas.turbulence]`: fluctuations of the gas, from the friction velocity at the walls or from `k` and `epsilon`.
//!
//! Each place belongs to its nearest wall, whose layer [`nearwall::transport::near_wall`] describes. A wall with a
//! `friction_velocity` of its own has that one; the others have that of this table, of the duct, or
//! `0.09^(1/4) sqrt(k)`, which holds where production and dissipation of `k` are in balance.
//!
//! Without `k` and `epsilon` the core of a turbulent duct of half the height `h` is that of open channels, with the
//! friction velocity `u_tau` and the distance `y` from the nearest wall (Nezu and Nakagawa, Turbulence in Open-Channel
//! Flows, 1993; from memory, not re-read): `k = 4.78 u_tau² exp(-2 y/h)`, `epsilon = 9.8 u_tau³/h (y/h)^(-1/2) exp(-3
//! y/h)`. Its eddy diffusivity is that of ducts (tested).

use nalgebra::Vector3;

use super::GasState;
use crate::simulate::surface::{Surface, SurfaceKind};
use nearwall::input::{InputError, Section};
use nearwall::transport::{Core, GasTurbulence, WallLayer};

/// The fluctuations of a gas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turbulence {
    friction_velocity: f64,
    core: Option<Core>,
    /// Half the height of the duct [m].
    half: Option<f64>,
}

impl Turbulence {
    /// Reads `friction_velocity` [m/s], `k` [m²/s²] and `epsilon` [m²/s³]. `of_field` are the friction velocity that
    /// the mean flow has and half the height of its duct [m].
    ///
    /// # Errors
    /// [`InputError::Fault`] when neither is known, or one of `k` and `epsilon` is missing.
    pub fn read(section: &Section<'_>, of_field: Option<[f64; 2]>) -> Result<Self, InputError> {
        let positive = |key: &str| section.number_within(key, f64::MIN_POSITIVE, f64::INFINITY);
        let (given, energy, dissipation) =
            (positive("friction_velocity")?, positive("k")?, positive("epsilon")?);
        let core = match (energy, dissipation) {
            (Some(energy), Some(dissipation)) => Some(Core::uniform(energy, dissipation)),
            (None, None) => None,
            (None, _) => return Err(section.missing("k", "the turbulent kinetic energy [m2/s2]")),
            (_, None) => return Err(section.missing("epsilon", "its dissipation [m2/s3]")),
        };
        let in_balance = energy.map(|energy| 0.09_f64.powf(0.25) * energy.sqrt());
        let friction_velocity = given.or(of_field.map(|[speed, _]| speed)).or(in_balance);
        let friction_velocity = friction_velocity
            .ok_or_else(|| section.missing("friction_velocity", "a speed [m/s], or k and epsilon,"))?;
        section.finish()?;
        Ok(Self { friction_velocity, core, half: of_field.map(|[_, half]| half) })
    }

    /// Whether a particle of a relaxation time [s] is one of those that reach walls too seldom: of 0.3 to 4 viscous
    /// times, above those that diffusion brings and below those that sweeps throw there (measured,
    /// `docs/why/physics.md`).
    pub fn is_slow(&self, relaxation: f64, gas: &GasState) -> bool {
        let viscous_time = gas.viscosity / gas.density / (self.friction_velocity * self.friction_velocity);
        (0.3..4.0).contains(&(relaxation / viscous_time))
    }

    /// The fluctuations at a position [m] where the gas has this state; `None` far from walls without `k`.
    pub(crate) fn at(
        &self,
        surfaces: &[Surface],
        position: &Vector3<f64>,
        gas: &GasState,
    ) -> Option<GasTurbulence> {
        let mut nearest: Option<(f64, &Surface, f64)> = None;
        for surface in surfaces {
            let SurfaceKind::Wall { friction_velocity, .. } = surface.kind else { continue };
            let distance = surface.shape.distance(position);
            if surface.shape.covers(position) && nearest.is_none_or(|(nearer, ..)| distance < nearer) {
                nearest = Some((distance, surface, friction_velocity));
            }
        }
        let Some((distance, surface, own)) = nearest else {
            return self.core.as_ref().map(GasTurbulence::free);
        };
        let layer = WallLayer {
            distance,
            normal: surface.shape.normal(position).into(),
            divergence: surface.shape.normal_divergence(position),
            friction_velocity: if own > 0.0 { own } else { self.friction_velocity },
            kinematic_viscosity: gas.viscosity / gas.density,
        };
        let core = self.core.or_else(|| self.half.map(|half| duct_core(&layer, half)));
        Some(GasTurbulence::beside(&layer, core.as_ref(), gas.velocity.into()))
    }
}

/// The core of a turbulent duct of half the height [m] at a distance from its nearest wall.
fn duct_core(wall: &WallLayer, half: f64) -> Core {
    let (place, speed) = ((wall.distance / half).clamp(1e-3, 1.0), wall.friction_velocity);
    let energy = 4.78 * speed * speed * (-2.0 * place).exp();
    let dissipation = 9.8 * speed.powi(3) / half * (-3.0 * place).exp() / place.sqrt();
    let core = Core::uniform(energy, dissipation);
    Core { gradient: wall.normal.map(|part| -core.fluctuation / half * part), ..core }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The eddy diffusivity of ducts over `u_tau h` is `0.41 y/h (1 - y/h)` up to half of the way to the middle, as the
    /// logarithmic law and a linear shear stress ask for, and 0.07 there (Hinze, Turbulence, 1975, pipes).
    #[test]
    fn the_core_of_a_duct_mixes_as_measured() {
        for (place, measured) in [(0.2, 0.066), (0.3, 0.086), (0.5, 0.1), (0.9, 0.07), (1.0, 0.07)] {
            let wall = WallLayer {
                distance: 0.01 * place,
                normal: [0.0, 0.0, 1.0],
                divergence: 0.0,
                friction_velocity: 0.3,
                kinematic_viscosity: 1.5e-5,
            };
            let core = duct_core(&wall, 0.01);
            let ratio = core.fluctuation.powi(2) * core.time_scale / (0.3 * 0.01) / measured;
            assert!((0.85..1.3).contains(&ratio), "{place}: {ratio}");
            let farther = duct_core(&WallLayer { distance: wall.distance - 1e-7, ..wall }, 0.01);
            let slope = (core.fluctuation - farther.fluctuation) / 1e-7;
            assert!((slope / core.gradient[2] - 1.0).abs() < 1e-4, "{place}: {slope}");
        }
    }
}
