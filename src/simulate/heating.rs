//! Heat to a particle: convection (Ranz and Marshall 1952) and, where asked for, radiation.
//!
//! `Nu = 2 + 0.6 Re^(1/2) Pr^(1/3)`, heat flow `Nu k pi d (T_g - T_p)`; a grey sphere in surroundings of one
//! temperature absorbs `epsilon sigma pi d² (T_r⁴ - T_p⁴)`. The particle has one temperature throughout (Biot number
//! well below 0.1), and no heat of melting or reaction.

use std::f64::consts::PI;

/// Stefan–Boltzmann constant [W/(m² K⁴)] (CODATA 2018, exact).
pub const STEFAN_BOLTZMANN: f64 = 5.670_374_419e-8;

/// Nusselt number [1] from Reynolds and Prandtl numbers [1].
pub fn nusselt(reynolds: f64, prandtl: f64) -> f64 {
    2.0 + 0.6 * reynolds.sqrt() * prandtl.cbrt()
}

/// Heat [W] that flows into a sphere by convection.
///
/// `nusselt` [1], `conductivity` of the gas [W/(m K)], `diameter` [m], `difference` gas minus particle [K].
pub fn convection(nusselt: f64, conductivity: f64, diameter: f64, difference: f64) -> f64 {
    nusselt * conductivity * PI * diameter * difference
}

/// Heat [W] that a grey sphere absorbs from surroundings of one temperature.
///
/// `emissivity` [1], `diameter` [m], `surroundings` and `particle` temperatures [K].
pub fn radiation(emissivity: f64, diameter: f64, surroundings: f64, particle: f64) -> f64 {
    emissivity * STEFAN_BOLTZMANN * PI * diameter * diameter * (surroundings.powi(4) - particle.powi(4))
}
