//! The state of a particle on its way and the equations of its motion.
//!
//! State of a particle: position [m], velocity [m/s], temperature without the heat of fusion [K] ([`super::fusion`]),
//! carbon conversion [1].
//! `dx/dt = v`, `dv/dt = (u - v)/tau + g (1 - rho_g/rho_p)`, `m c_p dT/dt = heat`, `dX/dt` from
//! [`super::conversion`]. Diameter and density follow the conversion ([`super::shrinkage`]).

use std::f64::consts::PI;

use differential_equations::interpolate::Interpolation;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use nalgebra::{SVector, Vector3};

use super::conversion::CarbonConversion;
use super::drag;
use super::fusion::Fusion;
use super::gas::{Gas, GasState};
use super::heating;
use super::shrinkage::Shrinkage;

/// Position, velocity, temperature, conversion.
pub type ParticleState = SVector<f64, 8>;

/// Points on the dense output of a step at which a path is looked at.
pub(super) const PATH_POINTS: u32 = 8;
/// Index of the temperature in a [`ParticleState`].
pub const TEMPERATURE: usize = 6;
/// Index of the conversion in a [`ParticleState`].
pub const CONVERSION: usize = 7;

/// Position of a state [m].
pub fn position(state: &ParticleState) -> Vector3<f64> {
    state.fixed_rows::<3>(0).into()
}

/// Velocity of a state [m/s].
pub fn velocity(state: &ParticleState) -> Vector3<f64> {
    state.fixed_rows::<3>(3).into()
}

/// Assembles a state from position [m], velocity [m/s], temperature [K] and conversion [1].
pub fn state(
    position: &Vector3<f64>,
    velocity: &Vector3<f64>,
    temperature: f64,
    conversion: f64,
) -> ParticleState {
    let mut state = ParticleState::zeros();
    state.fixed_rows_mut::<3>(0).copy_from(position);
    state.fixed_rows_mut::<3>(3).copy_from(velocity);
    state[TEMPERATURE] = temperature;
    state[CONVERSION] = conversion;
    state
}

/// An integration of [`ParticleMotion`] with dense output.
pub(super) trait PathSolver:
    OrdinaryNumericalMethod<f64, ParticleState> + Interpolation<f64, ParticleState>
{
}
impl<S: OrdinaryNumericalMethod<f64, ParticleState> + Interpolation<f64, ParticleState>> PathSolver for S {}

/// What a particle consists of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Diameter before any carbon is gone [m].
    pub diameter: f64,
    /// Density before any carbon is gone [kg/m³].
    pub density: f64,
    /// How size and density follow the conversion.
    pub shrinkage: Shrinkage,
    /// Heat capacity [J/(kg K)]; without it the temperature stays.
    pub heat_capacity: Option<f64>,
    /// Melting, where the case gives a heat of fusion.
    pub fusion: Option<Fusion>,
    /// Emissivity [1] and temperature of the surroundings [K].
    pub radiation: Option<(f64, f64)>,
    /// Law of carbon conversion.
    pub burning: CarbonConversion,
}

impl Body {
    /// Diameter [m] at a conversion [1].
    pub fn diameter_at(&self, conversion: f64) -> f64 {
        let left = self.shrinkage.volume_left(conversion);
        if left == 1.0 { self.diameter } else { self.diameter * left.cbrt() }
    }

    /// Density [kg/m³] at a conversion [1].
    pub fn density_at(&self, conversion: f64) -> f64 {
        self.density * self.shrinkage.mass_left(conversion) / self.shrinkage.volume_left(conversion)
    }

    /// Mass [kg] at a conversion [1].
    pub fn mass_at(&self, conversion: f64) -> f64 {
        PI / 6.0 * self.diameter.powi(3) * self.density * self.shrinkage.mass_left(conversion)
    }

    /// Temperature [K] of a state.
    pub fn temperature(&self, state: &ParticleState) -> f64 {
        let sensible = state[TEMPERATURE];
        self.fusion.map_or(sensible, |fusion| fusion.temperature(sensible))
    }
}

/// A particle in a gas: the equations of its path.
#[derive(Debug, Clone, Copy)]
pub struct ParticleMotion<'a> {
    /// The gas it moves in.
    pub gas: &'a Gas,
    /// Gravity [m/s²].
    pub gravity: Vector3<f64>,
    /// The particle.
    pub body: Body,
}

/// What acts on a particle at one moment.
pub(super) struct Rates {
    /// Rate [1/s] at which it takes on the velocity of the gas.
    pub response: f64,
    /// Acceleration of weight and buoyancy [m/s²].
    pub weight: Vector3<f64>,
    /// Change of temperature [K/s].
    pub heating: f64,
    /// Rate [1/s] at which it takes on the temperature of the gas.
    pub exchange: f64,
    /// Change of conversion [1/s].
    pub conversion: f64,
}

impl ParticleMotion<'_> {
    /// Acceleration of weight and buoyancy [m/s²] in a gas.
    pub(super) fn weight(&self, y: &ParticleState, gas: &GasState) -> Vector3<f64> {
        self.gravity * (1.0 - gas.density / self.body.density_at(y[CONVERSION]))
    }

    /// Reynolds number [1] of a particle in a gas, and the rate [1/s] at which it takes on the velocity of the gas.
    pub(super) fn response(&self, y: &ParticleState, gas: &GasState) -> (f64, f64) {
        let diameter = self.body.diameter_at(y[CONVERSION]);
        let reynolds = gas.density * (gas.velocity - velocity(y)).norm() * diameter / gas.viscosity;
        let density = self.body.density_at(y[CONVERSION]);
        let response = drag::response_rate(reynolds, gas.viscosity, density, diameter)
            / drag::slip_factor(gas.mean_free_path, diameter);
        (reynolds, response)
    }

    /// What acts on a particle in a gas.
    pub(super) fn rates(&self, y: &ParticleState, gas: &GasState) -> Rates {
        let body = &self.body;
        let (temperature, conversion) = (body.temperature(y), y[CONVERSION]);
        let diameter = body.diameter_at(conversion);
        let (reynolds, response) = self.response(y, gas);
        let [heating, exchange] = body.heat_capacity.map_or([0.0; 2], |capacity| {
            let prandtl = gas.heat_capacity * gas.viscosity / gas.conductivity;
            let dense = heating::nusselt(reynolds, prandtl);
            let GasState { mean_free_path, accommodation, .. } = *gas;
            let nusselt = heating::thin_gas_nusselt(dense, mean_free_path, diameter, prandtl, accommodation);
            let difference = gas.temperature - temperature;
            let mut heat = heating::convection(nusselt, gas.conductivity, diameter, difference);
            if let Some((emissivity, surroundings)) = body.radiation {
                heat += heating::radiation(emissivity, diameter, surroundings, temperature);
            }
            let capacity = body.mass_at(conversion) * capacity;
            [heat / capacity, heating::convection(nusselt, gas.conductivity, diameter, 1.0) / capacity]
        });
        Rates {
            response,
            weight: self.weight(y, gas),
            heating,
            exchange,
            conversion: body.burning.rate(temperature, conversion),
        }
    }
}

impl ODE<f64, ParticleState> for ParticleMotion<'_> {
    fn diff(&self, _time: f64, y: &ParticleState, rate: &mut ParticleState) {
        let gas = self.gas.at(&position(y));
        let Rates { response, weight, heating, conversion, .. } = self.rates(y, &gas);
        rate.fixed_rows_mut::<3>(0).copy_from(&velocity(y));
        rate.fixed_rows_mut::<3>(3).copy_from(&((gas.velocity - velocity(y)) * response + weight));
        rate[TEMPERATURE] = heating;
        rate[CONVERSION] = conversion;
    }
}

/// How far [m] from its start a particle can have come in a step, with a margin for a curved path.
pub(super) fn reach(duration: f64, before: &ParticleState, after: &ParticleState) -> f64 {
    2.0 * duration * velocity(before).norm().max(velocity(after).norm())
}
