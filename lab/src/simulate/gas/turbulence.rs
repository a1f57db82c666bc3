//! `[gas.turbulence]`: fluctuations of the gas, from the friction velocity at the walls or from `k` and `epsilon`.
//!
//! Each place belongs to its nearest wall, whose layer [`nearwall::transport::near_wall`] describes. A wall with a
//! `friction_velocity` of its own has that one; the others have that of this table, of the duct, or
//! `0.09^(1/4) sqrt(k)`, which holds where production and dissipation of `k` are in balance.

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
}

impl Turbulence {
    /// Reads `friction_velocity` [m/s], `k` [m²/s²] and `epsilon` [m²/s³]. `of_field` is the friction velocity that
    /// the mean flow has.
    ///
    /// # Errors
    /// [`InputError::Fault`] when neither is known, or one of `k` and `epsilon` is missing.
    pub fn read(section: &Section<'_>, of_field: Option<f64>) -> Result<Self, InputError> {
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
        let friction_velocity = given.or(of_field).or(in_balance);
        let friction_velocity = friction_velocity
            .ok_or_else(|| section.missing("friction_velocity", "a speed [m/s], or k and epsilon,"))?;
        section.finish()?;
        Ok(Self { friction_velocity, core })
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
        Some(GasTurbulence::beside(&layer, self.core.as_ref(), gas.velocity.into()))
    }
}
