//! What carries a particle to a wall: the walk of the gas's fluctuation, and thermophoresis.
#![allow(non_camel_case_types)]

use super::boundary::{guarded_status, initialise, sized};
use super::types::{NW_BAD_STATE, NW_NULL_POINTER, nw_status, zero_by_default};
use crate::rng::ImpactRng;
use crate::transport::thermophoresis::{ThermalGas, force_over_gradient};
use crate::transport::{Core, GasTurbulence, WallLayer};

/// Number of directions of space.
pub const NW_DIRECTIONS: usize = 3;

/// The walk of the gas's fluctuating velocity along the path of a particle, and the gas at the particle's place.
/// Fill it with `nw_walk_init`, then set what there is.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct nw_walk {
    /// `sizeof(nw_walk)`.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// Seed of the run.
    pub seed: u64,
    /// Key of the particle, unique within the run.
    pub key: u64,
    /// Number of the step, 0 at the start of the particle; `nw_walk_advance` adds 1.
    pub step: u64,
    /// Duration of the step that has brought the particle here [s], not negative.
    pub duration: f64,
    /// Relaxation time of the particle [s], not negative.
    pub relaxation_time: f64,
    /// Friction velocity at the nearest wall [m/s]; 0 far from walls, where `core_fluctuation` is needed.
    pub friction_velocity: f64,
    /// Kinematic viscosity of the gas [m2/s]; needed beside a wall.
    pub kinematic_viscosity: f64,
    /// Distance from the wall [m], not negative.
    pub wall_distance: f64,
    /// Direction away from the wall, of length 1.
    pub normal: [f64; NW_DIRECTIONS],
    /// Mean velocity of the gas [m/s].
    pub flow: [f64; NW_DIRECTIONS],
    /// Standard deviation of each component of the velocity away from walls [m/s], `sqrt(2 k/3)`; 0 where it is
    /// not known, then it is the friction velocity.
    pub core_fluctuation: f64,
    /// Lagrangian time scale away from walls [s], some `k/(7 epsilon)`.
    pub core_time: f64,
    /// Gradient of `core_fluctuation` [1/s].
    pub core_gradient: [f64; NW_DIRECTIONS],
    /// The walk [1]: kept by the caller from step to step.
    pub values: [f64; NW_DIRECTIONS],
    /// Fluctuating velocity of the gas [m/s].
    pub velocity: [f64; NW_DIRECTIONS],
    /// Longest next step [s] that does not change the statistics.
    pub longest_step: f64,
}

zero_by_default!(nw_walk);

impl nw_walk {
    /// The turbulence at the place, if the inputs describe one.
    fn turbulence(&self) -> Result<GasTurbulence, nw_status> {
        let positive = |value: f64| value.is_finite() && value > 0.0;
        let not_negative = |value: f64| value.is_finite() && value >= 0.0;
        let vectors = [self.normal, self.flow, self.core_gradient, self.values];
        let steps = [self.duration, self.relaxation_time, self.wall_distance, self.friction_velocity];
        let has_core = self.core_fluctuation != 0.0;
        let core_is_sound = !has_core || (positive(self.core_fluctuation) && positive(self.core_time));
        let has_wall = self.friction_velocity != 0.0;
        let wall_is_sound = if has_wall { positive(self.kinematic_viscosity) } else { has_core };
        let finite = vectors.iter().flatten().all(|part| part.is_finite());
        if !(finite && steps.into_iter().all(not_negative) && core_is_sound && wall_is_sound) {
            return Err(NW_BAD_STATE);
        }
        let (fluctuation, gradient) = (self.core_fluctuation, self.core_gradient);
        let core = Core { fluctuation, gradient, time_scale: self.core_time };
        if !has_wall {
            return Ok(GasTurbulence::free(&core));
        }
        let wall = WallLayer {
            distance: self.wall_distance,
            normal: self.normal,
            divergence: 0.0,
            friction_velocity: self.friction_velocity,
            kinematic_viscosity: self.kinematic_viscosity,
        };
        if has_core && !wall.reaches() {
            return Ok(GasTurbulence::free(&core));
        }
        Ok(GasTurbulence::beside(&wall, has_core.then_some(&core), self.flow))
    }

    fn advanced(self) -> Result<Self, nw_status> {
        let turbulence = self.turbulence()?;
        let random = ImpactRng::new(self.seed, self.key);
        let stream = |half| self.step.wrapping_mul(2).wrapping_add(half);
        let ([one, two], [three, _]) = (random.normal(stream(0)), random.normal(stream(1)));
        let draws = [one, two, three];
        let values = if self.step == 0 {
            draws
        } else {
            turbulence.advance(self.values, self.relaxation_time, self.duration, draws)
        };
        let (velocity, longest_step) = (turbulence.velocity(values), turbulence.longest_step());
        if !values.iter().chain(&velocity).chain([&longest_step]).all(|part| part.is_finite()) {
            return Err(NW_BAD_STATE);
        }
        Ok(Self { step: self.step.wrapping_add(1), values, velocity, longest_step, ..self })
    }
}

/// Initialises a walk: its size and zeros.
///
/// # Safety
/// `walk` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_walk_init(walk: *mut nw_walk) -> nw_status {
    // SAFETY: the caller's promise.
    unsafe { initialise(walk) }
}

/// Takes the walk on by the step that has brought the particle to its place, or starts it at step 0, and gives the
/// fluctuating velocity of the gas there. The draws depend on seed, key and step alone. `NW_BAD_STATE` if an input is
/// not finite, negative or missing.
///
/// # Safety
/// `walk` begins with its `struct_size`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_walk_advance(walk: *mut nw_walk) -> nw_status {
    let advance = || {
        // SAFETY: the caller's promise.
        let after = unsafe { sized(walk.cast_const())? }.advanced()?;
        // SAFETY: checked just above.
        unsafe { walk.write_unaligned(after) };
        Ok(())
    };
    guarded_status(advance)
}

/// Computes the thermophoretic force on a sphere over the gradient of the gas's temperature [N m/K], negative: the
/// force points to the cold. Of the gas: `temperature` [K], `density` [kg/m3], `viscosity` [Pa s], `conductivity`
/// [W/(m K)], `mean_free_path` [m] (0 in a dense gas); of the particle: `diameter` [m], `particle_conductivity`
/// [W/(m K)]. `NW_BAD_STATE` if one is not finite or not positive.
///
/// # Safety
/// `force` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_thermophoresis(
    temperature: f64,
    density: f64,
    viscosity: f64,
    conductivity: f64,
    mean_free_path: f64,
    diameter: f64,
    particle_conductivity: f64,
    force: *mut f64,
) -> nw_status {
    let found = || {
        if force.is_null() {
            return Err(NW_NULL_POINTER);
        }
        let positive = [temperature, density, viscosity, conductivity, diameter, particle_conductivity];
        let gas = ThermalGas { temperature, density, viscosity, conductivity, mean_free_path };
        let found = force_over_gradient(&gas, diameter, particle_conductivity);
        if !(positive.iter().all(|value| *value > 0.0) && mean_free_path >= 0.0 && found.is_finite()) {
            return Err(NW_BAD_STATE);
        }
        // SAFETY: not null, and writable by the caller's promise.
        unsafe { force.write_unaligned(found) };
        Ok(())
    };
    guarded_status(found)
}
