//! Covering char that burns off a wall.
//!
//! Outer powder of mass `P` [kg/m²], volume of its particles `V` [m³/m²] and projected area `A` [1]
//! contains combustible matter `C` [kg/m²]. Over a time step the law of carbon conversion at the
//! temperature of the wall leaves the share `r` of it (first order: `r = exp(-k(T_w) dt)`); the
//! mass `C (1 - r)` goes into the gas. What becomes of the ash depends on the wall:
//!
//! | ash at the temperature of the wall | powder after the step | to the melt |
//! |---|---|---|
//! | solid: particles shrink | `P - C (1 - r)`; `V' = V_ash + (V - V_ash) r^(3a)`; `A (V'/V)^(2/3)` | – |
//! | molten: particles are used up one by one | `r P`, `r V`, `r A` | `(P - C) (1 - r)` |
//!
//! with `V_ash = (P - C)/rho_ash` and the exponent `a` of the particles in flight. The first row is
//! the particle's own law of shrinkage for every mixture of conversions, exact for particles of one
//! size and conversion. The second is exact for particles whose burn-out times are distributed
//! exponentially: the ash of the carbon that is gone joins the melt. *Assumed*: that the powder
//! burns through its whole thickness, as fast as a particle in the gas at the temperature of the
//! wall, and that melt does not burn. No source gives a law for the cover; both rows conserve
//! carbon and ash.

use super::{Deposit, Powder};

/// What burns in the powder of a piece of wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowderBurning {
    /// Combustible mass in the powder, `C` [kg/m²].
    pub combustible: f64,
    /// Share of it that is left after the step, `r` [1].
    pub left: f64,
    /// Carbon conversion of the powder before the step, `X` [1].
    pub conversion: f64,
    /// Exponent `a` of the size of the combustible matter [1]; 0 for particles of constant size.
    pub diameter_exponent: f64,
    /// Density of the ash, `rho_ash` [kg/m³].
    pub ash_density: f64,
    /// Whether the ash is molten at the temperature of the wall.
    pub ash_melts: bool,
}

/// The deposit after the step. In the mean conversion, powder that shrinks counts with `1 - (1 - X)
/// r`, powder that is left beside melting ash with `X`, and that ash with 1.
#[must_use]
pub fn after(deposit: &Deposit, burning: &PowderBurning) -> Deposit {
    let PowderBurning { combustible, left, conversion, diameter_exponent, ash_density, ash_melts } = *burning;
    let [inner, outer] = deposit.powders();
    let combustible = combustible.min(outer.mass);
    if combustible <= 0.0 || left >= 1.0 {
        return *deposit;
    }
    let ash = outer.mass - combustible;
    let (burnt, melted) = if ash_melts {
        (outer.times(left), ash * (1.0 - left))
    } else {
        let ash_volume = (ash / ash_density).min(outer.solid);
        let shrunk = if diameter_exponent == 0.0 { 1.0 } else { left.powf(3.0 * diameter_exponent) };
        let solid = ash_volume + (outer.solid - ash_volume) * shrunk;
        let ratio = if outer.solid > 0.0 { solid / outer.solid } else { 1.0 };
        let (cover, closed) = (outer.cover * ratio.powf(2.0 / 3.0), outer.closed * ratio);
        (Powder { mass: ash + combustible * left, solid, cover, closed }, 0.0)
    };
    let after = Deposit { molten: deposit.molten + melted, ..*deposit }.with_powders([inner, burnt]);
    let of_powder = if ash_melts { conversion } else { 1.0 - (1.0 - conversion) * left };
    let elsewhere = deposit.mass() * deposit.conversion - outer.mass * conversion;
    let converted = elsewhere + burnt.mass * of_powder + melted;
    let mean = if after.mass() > 0.0 { converted / after.mass() } else { 1.0 };
    Deposit { conversion: mean.clamp(0.0, 1.0), ..after }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deposit::{CapturedParticles, DepositSource};
    use approx::assert_relative_eq;

    const CHAR: CapturedParticles =
        CapturedParticles { mass: 2e-3, density: 800.0, diameter: 60e-6, conversion: 0.0, molten: false };

    fn char() -> Deposit {
        let deposit = Deposit::default().with(&DepositSource::default().with(&CHAR));
        // The melt has no carbon.
        Deposit { molten: 0.3, conversion: 0.3 / (deposit.mass() + 0.3), ..deposit }
    }

    const BURNING: PowderBurning = PowderBurning {
        combustible: 1.8e-3,
        left: 0.25,
        conversion: 0.0,
        diameter_exponent: 0.25,
        ash_density: 2400.0,
        ash_melts: false,
    };

    #[test]
    fn carbon_leaves_and_ash_stays() {
        for ash_melts in [false, true] {
            let deposit = after(&char(), &PowderBurning { ash_melts, ..BURNING });
            assert_relative_eq!(deposit.mass(), char().mass() - 0.75 * 1.8e-3, max_relative = 1e-14);
            assert!(deposit.cover < char().cover && deposit.solid < char().solid);
        }
        assert_eq!(after(&char(), &PowderBurning { left: 1.0, ..BURNING }), char());
        assert_eq!(after(&char(), &PowderBurning { combustible: 0.0, ..BURNING }), char());
    }

    /// Equal spheres: their number does not change, so the projected area goes as the square of the diameter.
    #[test]
    fn on_a_cold_wall_equal_spheres_shrink_to_dense_ash() {
        let number = CHAR.mass / (CHAR.density * std::f64::consts::PI / 6.0 * CHAR.diameter.powi(3));
        let burnt_out = after(&char(), &PowderBurning { left: 0.0, ..BURNING });
        let diameter = (0.2e-3 / number / 2400.0 * 6.0 / std::f64::consts::PI).cbrt();
        assert_relative_eq!(
            burnt_out.cover,
            number * std::f64::consts::PI / 4.0 * diameter.powi(2),
            max_relative = 1e-12
        );
        assert_relative_eq!(burnt_out.powder, 0.2e-3, max_relative = 1e-12);
        assert_relative_eq!(burnt_out.powder / burnt_out.solid, 2400.0, max_relative = 1e-12);
    }

    #[test]
    fn on_a_slagging_wall_the_cover_decays_with_the_carbon() {
        let melting = PowderBurning { ash_melts: true, ..BURNING };
        let deposit = after(&char(), &melting);
        assert_relative_eq!(deposit.cover, 0.25 * char().cover, max_relative = 1e-14);
        assert_relative_eq!(deposit.powder, 0.25 * char().powder, max_relative = 1e-12);
        assert_relative_eq!(deposit.molten, 0.3 + 0.75 * 0.2e-3, max_relative = 1e-14);
        let gone = after(&char(), &PowderBurning { left: 0.0, ..melting });
        assert_eq!((gone.solid, gone.cover), (0.0, 0.0));
        assert!(gone.powder.abs() < 1e-18);
    }

    /// Char of conversion 0 beside melt of conversion 1: by mass.
    #[test]
    fn the_mean_conversion_is_that_of_the_parts() {
        let shrunk = after(&char(), &BURNING);
        let mean = (0.3 + shrunk.powder * 0.75) / (0.3 + shrunk.powder);
        assert_relative_eq!(shrunk.conversion, mean, max_relative = 1e-12);
        let melted = after(&char(), &PowderBurning { ash_melts: true, ..BURNING });
        assert_relative_eq!(melted.conversion, melted.molten / melted.mass(), max_relative = 1e-12);
    }

    /// Two steps are one of both durations, since r multiplies.
    #[test]
    fn the_length_of_a_step_does_not_count() {
        for ash_melts in [false, true] {
            let whole = after(&char(), &PowderBurning { left: 0.09, ash_melts, ..BURNING });
            let first = PowderBurning { left: 0.3, ash_melts, ..BURNING };
            let half = after(&char(), &first);
            let twice = after(&half, &PowderBurning { combustible: 0.3 * BURNING.combustible, ..first });
            assert_relative_eq!(twice.mass(), whole.mass(), max_relative = 1e-14);
            assert_relative_eq!(twice.powder, whole.powder, max_relative = 1e-12);
            assert_relative_eq!(twice.solid, whole.solid, max_relative = 1e-12);
            assert_relative_eq!(twice.cover, whole.cover, max_relative = 1e-12);
        }
    }
}
