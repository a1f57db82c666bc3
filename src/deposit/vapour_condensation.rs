//! Condensation of an alkali salt from the gas on a surface that is colder than its dew point: the first, sticky layer
//! on the superheaters of a boiler that burns biomass or waste.
//!
//! Film theory with Stefan flow, the mass transfer from the heat transfer (Chilton and Colburn 1934):
//!
//! `j = M h/(c_p M_g Le^(2/3)) ln((1 - y_s)/(1 - y_g))`, `y_s = p_s(T_s)/p`, `ln p_s = a - b/T - c ln T`
//!
//! and the heat that it brings to the surface is `j L`, `L = R (b - c T_s)/M` (Clausius and Clapeyron).
//!
//! `j` condensed mass over area and time [kg/(m² s)], `M M_g` molar masses of salt and gas [kg/mol], `h` heat transfer
//! coefficient of the gas [W/(m² K)], `c_p` its heat capacity [J/(kg K)], `Le` its thermal diffusivity over the
//! diffusivity of the vapour [1], `y_g y_s` mole fractions of the vapour in the gas and at the surface [1], `T_s`
//! temperature of the surface [K], `p` pressure [Pa], `p_s` saturation pressure [Pa], `L` heat of condensation [J/kg],
//! `R` the gas constant. The mole flux is `k_c p/(R T) ln(...)` (Bird, Stewart and Lightfoot, Transport Phenomena,
//! chapter 18 and 22, from memory) with `h/k_c = rho c_p Le^(2/3)` and `rho = p M_g/(R T)`, so that `p` and `T` of
//! the film cancel.
//!
//! Saturation pressures are those of the JANAF tables (Chase 1998; KCl 3/66, NaCl 9/64), which NASA fits (Cantera's
//! `nasa_condensed.yaml` and `nasa_gas.yaml`), of monomers, fitted within 0.4 % from 600 K to the melting point and
//! within 0.2 % from there to 1700 K. Second source: Stull 1947 in the NIST WebBook measured all vapour over the
//! melt, the tests compare. Dimers add a fifth to a third below 1100 K and are left out, as in the gas, where the
//! little vapour is monomer.
//!
//! *Assumed*: the vapour reaches the surface as such and does not form fume in the boundary layer; the salt takes no
//! part in reactions (sulphation) and dissolves in nothing; what has condensed does not evaporate again; it lies there
//! as fine powder, also above its melting point; its sensible heat is small against `L` (2.8 MJ/kg at 900 K).

use super::process::{Process, ProcessInfo, Step, VapourSide, own_table};
use super::{CapturedParticles, Deposit, DepositSource};
use crate::input::{InputError, Section};

/// Gas constant [J/(mol K)] (CODATA 2018, exact to its last digit).
pub const GAS_CONSTANT: f64 = 8.314_462_618;
/// Standard pressure [Pa].
const ATMOSPHERE: f64 = 101_325.0;
/// Heat capacity [J/(kg K)] and molar mass [kg/mol] of a flue gas of some 1000 K with a tenth of steam: assumed.
const FLUE_GAS: [f64; 2] = [1200.0, 0.029];
/// Lewis number of these vapours in flue gas [1]: assumed.
const LEWIS: f64 = 2.0;
/// Diameter of the condensed grains [m]: assumed.
const GRAIN: f64 = 1e-6;
/// Largest mole fraction at the surface [1], above which the salt boils.
const BOILING: f64 = 0.999;

pub(super) const INFO: ProcessInfo = ProcessInfo {
    name: "condensation",
    loss: None,
    gain: Some("condensed"),
    read: |wall| own_table(wall, "condensation", Condensation::read),
};

/// A salt and its saturation pressure.
#[derive(Debug, PartialEq)]
pub struct Salt {
    /// Its formula, as in the model file.
    pub name: &'static str,
    /// Molar mass [kg/mol].
    pub molar_mass: f64,
    /// Density of the solid [kg/m³] (Haynes, CRC Handbook, from memory).
    pub density: f64,
    /// Melting point [K].
    melts_at: f64,
    /// `a`, `b` [K] and `c` of the solid, and of the liquid.
    pressure: [[f64; 3]; 2],
}

/// The salts that are known.
pub const SALTS: [Salt; 2] = [
    Salt {
        name: "KCl",
        molar_mass: 0.074_551,
        density: 1988.0,
        melts_at: 1044.0,
        pressure: [[49.0614, 27_756.6, 2.709_04], [58.1002, 26_099.8, 4.238_22]],
    },
    Salt {
        name: "NaCl",
        molar_mass: 0.058_443,
        density: 2170.0,
        melts_at: 1073.8,
        pressure: [[48.8524, 28_670.8, 2.657_21], [52.9849, 26_158.1, 3.584_94]],
    },
];

impl Salt {
    fn constants(&self, temperature: f64) -> [f64; 3] {
        self.pressure[usize::from(temperature > self.melts_at)]
    }

    /// Saturation pressure [Pa] at a temperature [K].
    pub fn saturation_pressure(&self, temperature: f64) -> f64 {
        let [a, b, c] = self.constants(temperature);
        (a - b / temperature - c * temperature.ln()).exp()
    }

    /// Heat of condensation [J/kg] at a temperature [K].
    pub fn heat_of_condensation(&self, temperature: f64) -> f64 {
        let [_, b, c] = self.constants(temperature);
        GAS_CONSTANT * (b - c * temperature) / self.molar_mass
    }
}

/// The vapour beside a wall: a `condensation` table of the model file.
#[derive(Debug)]
struct Condensation {
    salt: &'static Salt,
    /// Mass fraction of the vapour in the gas [1].
    mass_fraction: f64,
    /// Pressure of the gas [Pa].
    pressure: f64,
    /// Heat capacity [J/(kg K)] and molar mass [kg/mol] of the gas.
    gas: [f64; 2],
    lewis: f64,
    /// Heat transfer coefficient [W/(m² K)] where the surroundings give none.
    coefficient: f64,
    /// Diameter of the condensed grains [m].
    grain: f64,
}

impl Condensation {
    /// Reads the table.
    fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let names = SALTS.each_ref().map(|salt| salt.name);
        let name = section.choice("vapour", &names)?;
        let salt = SALTS.iter().find(|salt| name.as_deref() == Some(salt.name));
        let salt = salt.ok_or_else(|| section.missing("vapour", "\"KCl\" or \"NaCl\""))?;
        let fraction = section.number_within("mass_fraction", 0.0, 0.5)?;
        let positive = |key: &str, default: f64| {
            let given = section.number_within(key, f64::MIN_POSITIVE, f64::MAX)?;
            Ok::<f64, InputError>(given.unwrap_or(default))
        };
        let [heat_capacity, molar_mass] = FLUE_GAS;
        Ok(Self {
            salt,
            mass_fraction: fraction.ok_or_else(|| {
                section.missing(
                    "mass_fraction",
                    "that of the vapour in the gas [1], some 1e-4 in biomass boilers",
                )
            })?,
            pressure: positive("pressure", ATMOSPHERE)?,
            gas: [positive("gas_heat_capacity", heat_capacity)?, positive("gas_molar_mass", molar_mass)?],
            lewis: positive("lewis_number", LEWIS)?,
            coefficient: section.number_within("gas_coefficient", 0.0, 1e6)?.unwrap_or(0.0),
            grain: positive("grain_diameter", GRAIN)?,
        })
    }

    /// Condensed mass over area and time [kg/(m² s)] on a surface of a temperature [K].
    fn flux(&self, gas: &VapourSide, surface: f64) -> f64 {
        let coefficient = gas.coefficient.unwrap_or(self.coefficient);
        let fraction = gas.fraction.unwrap_or(self.mass_fraction);
        let [heat_capacity, molar_mass] = self.gas;
        let moles = fraction / self.salt.molar_mass;
        let in_gas = moles / (moles + (1.0 - fraction) / molar_mass);
        let at_surface = (self.salt.saturation_pressure(surface) / self.pressure).min(BOILING);
        let driven = ((1.0 - at_surface) / (1.0 - in_gas)).ln().max(0.0);
        let per_area = coefficient / (heat_capacity * molar_mass * self.lewis.powf(2.0 / 3.0));
        self.salt.molar_mass * per_area * driven
    }
}

impl Process for Condensation {
    fn after(&self, deposit: &Deposit, step: &Step<'_>) -> Deposit {
        let Some((gas, surface)) = step.surface() else { return *deposit };
        let mass = self.flux(&gas, surface) * step.duration;
        if mass <= 0.0 {
            return *deposit;
        }
        let (density, diameter) = (self.salt.density, self.grain);
        let condensed = CapturedParticles { mass, density, diameter, conversion: 1.0, molten: false };
        deposit.with(&DepositSource::default().with(&condensed))
    }

    fn heat_flux(&self, gas: &VapourSide, surface: f64) -> f64 {
        self.flux(gas, surface) * self.salt.heat_of_condensation(surface)
    }

    fn describe(&self) -> String {
        let Self { salt, mass_fraction, pressure, .. } = self;
        format!(
            ", condenses {} from a gas with a mass fraction of {mass_fraction} at {pressure} Pa",
            salt.name
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Document;
    use approx::assert_relative_eq;

    /// By hand: 60 W/(m² K), a mass fraction of 1e-4 of KCl at 1 atm and a surface of 800 K, where the salt's
    /// saturation pressure is 0.0237 Pa (JANAF). `y_g = 1.341364e-3/(1.341364e-3 + 34.47931) = 3.890195e-5`, `y_s =
    /// 2.337e-7`, `h/(c_p M_g Le^(2/3)) = 60/(1200 0.029 1.587401) = 1.086139` mol/(m² s), times `3.86690e-5` of the
    /// logarithm times 0.074551 kg/mol: 3.1311e-6 kg/(m² s), 11 kg/m² in 1000 h.
    #[test]
    fn the_flux_is_that_by_hand() {
        let table = Document::new("test", "vapour = \"KCl\"\nmass_fraction = 1e-4\n");
        let condensation = table.read(Condensation::read).unwrap();
        let gas = VapourSide { coefficient: Some(60.0), fraction: None };
        assert_relative_eq!(condensation.flux(&gas, 800.0), 3.1311e-6, max_relative = 2e-5);
        assert_eq!(condensation.flux(&gas, 960.0), 0.0);
    }

    /// Stull (1947) as Antoine's law in the NIST WebBook, `log10(p/bar) = A - B/(T + C)`, over the melt, for all
    /// vapour. The JANAF tables have 23 to 31 % of dimers there, by which monomers are less.
    #[test]
    fn saturation_pressures_are_those_measured_less_dimers() {
        for (salt, [a, b, c], monomers) in [
            (&SALTS[0], [4.782_36, 7440.691, -122.709], [0.688, 0.699, 0.728]),
            (&SALTS[1], [5.071_84, 8388.497, -82.638], [0.696, 0.722, 0.769]),
        ] {
            for (temperature, monomers) in [1100.0, 1200.0, 1400.0].into_iter().zip(monomers) {
                let measured = 1e5 * 10_f64.powf(a - b / (temperature + c));
                let ratio = salt.saturation_pressure(temperature) / monomers / measured;
                assert!((0.9..1.3).contains(&ratio), "{} {temperature}: {ratio}", salt.name);
            }
        }
    }

    /// Gibbs energies of the JANAF tables, as NASA fits them, at 900 K: `p = p_0 exp((G_s - G_g)/(R T))`.
    #[test]
    fn saturation_over_the_solid_follows_from_gibbs_energies() {
        assert_relative_eq!(SALTS[0].saturation_pressure(900.0), 0.814_08, max_relative = 4e-3);
        assert_relative_eq!(SALTS[1].saturation_pressure(900.0), 0.340_34, max_relative = 4e-3);
        assert_relative_eq!(SALTS[0].heat_of_condensation(900.0) * 0.074_551, 210.5e3, max_relative = 2e-3);
        for salt in &SALTS {
            let [solid, liquid] = [-1e-9, 1e-9].map(|off| salt.saturation_pressure(salt.melts_at + off));
            assert_relative_eq!(solid, liquid, max_relative = 1e-2);
        }
    }
}
