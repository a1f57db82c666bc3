//! Heat to a particle: convection (Ranz and Marshall 1952) and, where asked for, radiation.
//!
//! `Nu = 2 + 0.6 Re^(1/2) Pr^(1/3)`, heat flow `Nu k pi d (T_g - T_p)`; a grey sphere in surroundings of one
//! temperature absorbs `epsilon sigma pi d² (T_r⁴ - T_p⁴)`. The particle has one temperature throughout (Biot number
//! well below 0.1); `fusion.rs` gives its heat of fusion. Heat of reaction is left out.

use std::f64::consts::PI;

use nearwall::deposit::conduction::STEFAN_BOLTZMANN;

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

/// Nusselt number [1] in a thin gas (Kavanau 1955; McCoy and Cha 1974): the jump of temperature at
/// the surface in series with the gas around it,
///
/// `Nu = Nu_0 / (1 + (Nu_0/2) G lambda/d)`, `G = 8 gamma/((gamma + 1) alpha Pr)`.
///
/// `dense` is `Nu_0` [1], `mean_free_path` `lambda` [m], `diameter` `d` [m], `prandtl` [1],
/// `accommodation` `alpha` [1] the share of the exchanged heat that molecules take over on hitting
/// the surface. `gamma` = 1.4, *assumed* (a diatomic gas; 7 % less heat resistance at 1.2, 7 % more
/// at 5/3). At rest and `lambda >> d` this is the free molecular flux exactly, with `lambda = mu
/// sqrt(pi R T/2)/p`. Kavanau's form for air, `Nu_0/(1 + 3.42 Nu_0 Ma/(Re Pr))` with `alpha` = 1
/// and the same `lambda`, has 3.42 where this has 3.46. Near `lambda << d`, Smoluchowski's jump
/// with `alpha` = 1 is half of this one: there the correction itself is a few per cent. (McCoy and
/// Cha's formula and Kavanau's coefficient from secondary sources.)
pub fn thin_gas_nusselt(
    dense: f64,
    mean_free_path: f64,
    diameter: f64,
    prandtl: f64,
    accommodation: f64,
) -> f64 {
    const GAMMA: f64 = 1.4;
    let jump = 8.0 * GAMMA / ((GAMMA + 1.0) * accommodation * prandtl);
    dense / (1.0 + 0.5 * dense * jump * mean_free_path / diameter)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Kinetic theory: q = alpha (p c/8) (gamma + 1)/(gamma - 1) dT/T per area with the mean molecular speed
    /// c = sqrt(8 R T/pi), and lambda = mu sqrt(pi R T/2)/p.
    #[test]
    fn far_apart_molecules_carry_the_free_molecular_heat() {
        let (gamma, gas, temperature, pressure, viscosity, prandtl) = (1.4, 287.0, 300.0, 1e-3, 1.8e-5, 0.7);
        let conductivity = viscosity * gamma / (gamma - 1.0) * gas / prandtl;
        let path = viscosity * (PI * gas * temperature / 2.0_f64).sqrt() / pressure;
        for (diameter, accommodation) in [(1e-6, 1.0), (1e-6, 0.3)] {
            let nusselt = thin_gas_nusselt(2.0, path, diameter, prandtl, accommodation);
            let ours = convection(nusselt, conductivity, diameter, 1.0);
            let speed = (8.0 * gas * temperature / PI).sqrt();
            let flux = accommodation * pressure * speed / 8.0 * (gamma + 1.0) / (gamma - 1.0) / temperature;
            assert_relative_eq!(ours, flux * PI * diameter * diameter, max_relative = 1e-4);
        }
    }

    /// Kavanau's form for air, with Ma/Re = Kn sqrt(2/(pi gamma)).
    #[test]
    fn it_is_kavanau_s_form_within_two_per_cent() {
        for knudsen in [0.001, 0.01, 0.1, 1.0, 10.0] {
            for dense in [2.0, 5.0] {
                let ours = thin_gas_nusselt(dense, knudsen, 1.0, 0.71, 1.0);
                let mach_over_reynolds = knudsen * (2.0 / (PI * 1.4)).sqrt();
                let kavanau = dense / (1.0 + 3.42 * dense * mach_over_reynolds / 0.71);
                assert_relative_eq!(ours, kavanau, max_relative = 0.02);
            }
        }
        assert_eq!(thin_gas_nusselt(3.0, 0.0, 1e-6, 0.7, 1.0), 3.0);
    }
}
