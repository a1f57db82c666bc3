//! What a wall of a case loses again: the gas carries loose powder away, and what the wall cannot hold falls off.
//!
//! By the tables `resuspension` and `shedding` of the wall in the model file, at the end of a step of the deposit. The `friction_velocity` u*
//! of a wall of the case [m/s] (0 unless given) sets the shear of the gas, `rho u*²`. *Assumed*: that it points down the slope.

use nalgebra::Vector3;

use super::case::Case;
use super::surface::{Surface, SurfaceKind};
use nearwall::deposit::Deposit;
use nearwall::deposit::resuspension::WallGas;
use nearwall::deposit::shedding::Load;
use nearwall::impact::ImpactError;

/// Rank of a bin by its strength [1], from 0 to below 1: a golden-ratio sequence, which is even for any number of bins and gives the first
/// one the median.
fn rank(bin: usize) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    (0.5 + bin as f64 * GOLDEN).fract()
}

/// The deposit of a bin of a wall, at a place of it: after the gas carried powder away for a time [s], and after what the wall cannot hold
/// has fallen off as well.
pub(super) fn after(
    case: &Case,
    surface: &Surface,
    place: &Vector3<f64>,
    bin: usize,
    deposit: &Deposit,
    voidage: f64,
    duration: f64,
) -> Result<[Deposit; 2], ImpactError> {
    let SurfaceKind::Wall { model: wall, friction_velocity, .. } = surface.kind else {
        return Ok([*deposit; 2]);
    };
    let gas = case.gas.at(place);
    let kinematic_viscosity = gas.viscosity / gas.density;
    let gas = WallGas { density: gas.density, kinematic_viscosity, friction_velocity };
    let blown = case.model.resuspended(wall, deposit, voidage, &gas, duration)?;

    let normal = surface.shape.normal(place);
    let gravity_outward = case.gravity.dot(&normal);
    let gravity_along = (case.gravity - gravity_outward * normal).norm();
    let shear = gas.density * friction_velocity * friction_velocity;
    let load = Load { gravity_outward, gravity_along, gas_shear: [shear, 0.0] };
    Ok([blown, case.model.shed(wall, &blown, &load, rank(bin))?])
}
