//! What surrounds the deposit on a wall of a case: the gas that shears it, and gravity.
//!
//! The `friction_velocity` u* of a wall of the case [m/s] (0 unless given) sets the shear of the gas,
//! `rho u*²`. *Assumed*: that it points down the slope.

use nalgebra::Vector3;

use super::case::Case;
use super::surface::Surface;
use nearwall::deposit::{Surroundings, WallCooling, WallGas};

/// Rank of a bin by its strength [1], from 0 to below 1: a golden-ratio sequence, which is even for any
/// number of bins and gives the first one the median.
fn rank(bin: usize) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    (0.5 + bin as f64 * GOLDEN).fract()
}

/// The surroundings of a bin of a wall at a place of it, with the friction velocity of the wall [m/s],
/// the voids of fresh powder [1], and the cooling of the wall or its temperature [K].
pub(super) fn surroundings(
    case: &Case,
    surface: &Surface,
    friction_velocity: f64,
    place: &Vector3<f64>,
    bin: usize,
    voidage: f64,
    heat: Result<WallCooling, f64>,
) -> Surroundings {
    let gas = case.gas.at(place);
    let normal = surface.shape.normal(place);
    let gravity_outward = case.gravity.dot(&normal);
    Surroundings {
        voidage,
        cooling: heat.ok(),
        wall_temperature: heat.err(),
        gas: WallGas {
            density: gas.density,
            kinematic_viscosity: gas.viscosity / gas.density,
            shear: [gas.density * friction_velocity * friction_velocity, 0.0],
        },
        gravity_outward,
        gravity_along: (case.gravity - gravity_outward * normal).norm(),
        draw: rank(bin),
    }
}
