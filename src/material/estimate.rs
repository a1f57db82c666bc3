//! Properties that follow from the composition of an ash, for a material that does not give them.
//!
//! Density, Young's modulus and Poisson's ratio of a silicate glass; its viscosity follows by the law of `[capture]`,
//! its surface tension by [`crate::slag::surface_tension`]. No law gives yield strength and surface energy: the
//! strength of a glass is that of its flaws, and ash that has met air adheres by far less than its clean melt.

use super::Property;
use crate::slag::{Composition, density, elastic};

/// Temperatures [K] at which the density is tabulated.
const DENSITY_AT: [f64; 6] = [1.0, density::FROZEN, 1300.0, 1600.0, 2000.0, 3000.0];

/// Temperatures [K] of the modulus, and its share [1] of that of the cold glass: as `coal-slag`, 20 GPa at 1000 °C
/// and 5 GPa at 1450 °C of 75 GPa (Troiano Table 1; the rest assumed there).
const MODULUS_AT: [f64; 5] = [1.0, 293.15, 1273.15, 1723.15, 2273.15];
const SOFTENING: [f64; 5] = [1.0, 1.0, 20.0 / 75.0, 5.0 / 75.0, 5.0 / 75.0];

/// Keys of the properties that [`estimated`] knows.
pub(super) const ESTIMATED: [&str; 3] = ["density", "youngs_modulus", "poisson_ratio"];

/// The property of this key of a silicate of a composition; `None` where no law gives it.
pub(super) fn estimated(key: &str, composition: &Composition) -> Option<Property> {
    let cold = density::silicate_density(composition, 293.15)?;
    let density_at = |t: f64| density::silicate_density(composition, t).map(|rho| [t, rho]);
    let glass = || elastic::makishima_mackenzie(composition, cold);
    match key {
        "density" => {
            let points = DENSITY_AT.into_iter().map(density_at).collect::<Option<Vec<_>>>()?;
            let source = "estimated from the composition by partial molar volumes, src/slag/density.rs: within 4 % \
                without pores";
            Property::estimated(&points, [273.15, 2300.0], source)
        }
        "youngs_modulus" => {
            let [modulus, _] = glass()?;
            let points = MODULUS_AT.into_iter().zip(SOFTENING).map(|(t, share)| [t, share * modulus]);
            let source = "estimated from the composition after Makishima and Mackenzie, src/slag/elastic.rs: the cold \
                          glass within 12 %; softens as coal-slag (assumed)";
            Property::estimated(&points.collect::<Vec<_>>(), [273.15, 1723.15], source)
        }
        "poisson_ratio" => {
            let [_, poisson] = glass()?;
            let source = "estimated from the composition after Makishima and Mackenzie, src/slag/elastic.rs: within \
                0.06";
            Property::estimated(&[[1.0, poisson], [3000.0, poisson]], [273.15, 2300.0], source)
        }
        _ => None,
    }
}
