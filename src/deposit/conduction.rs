//! Heat conduction through a wall and its deposit, in one dimension: layers in series between a coolant and the gas.
//!
//! Steady: `q = (T_s - T_c)/R` with `R = 1/h_c + sum(delta_i/k_i)`. The hot side gives
//!
//! `q(T_s) = h (T_g - T_s) + epsilon (G - sigma T_s^4) + q_p`
//!
//! and both are equal at one surface temperature `T_s` only, since the first rises with it and the second falls.
//!
//! `q` heat flux into the wall [W/m²], `T_s T_c T_g` temperatures of surface, coolant and gas [K],
//! `delta` thickness [m], `k` conductivity [W/(m K)], `h_c h` heat transfer coefficients of coolant
//! and gas [W/(m² K)], `epsilon` emissivity of the surface [1], `G` irradiation [W/m²], `sigma` the
//! Stefan–Boltzmann constant, `q_p` what particles bring [W/m²]. Valid for grey opaque surfaces and
//! layers thin against the curvature of the wall.
//!
//! Source: Incropera et al., Fundamentals of Heat and Mass Transfer, chapter 3 (not re-read); the tests
//! hold it against resistances in series.

/// Stefan–Boltzmann constant [W/(m² K⁴)], exact to its last digit in the SI of 2019.
pub const STEFAN_BOLTZMANN: f64 = 5.670_374_419e-8;

/// Largest number of Newton steps; some five are needed.
const MOST_NEWTON_STEPS: usize = 100;
/// Relative change of a temperature at which Newton's method ends [1].
const CONVERGED: f64 = 1e-14;

/// A layer of one material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConductingLayer {
    /// Thickness, `delta` [m].
    pub thickness: f64,
    /// Thermal conductivity, `k` [W/(m K)].
    pub conductivity: f64,
}

impl ConductingLayer {
    /// Thermal resistance [m² K/W].
    pub fn resistance(&self) -> f64 {
        if self.thickness == 0.0 { 0.0 } else { self.thickness / self.conductivity }
    }
}

/// What cools the wall from behind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coolant {
    /// Temperature, `T_c` [K].
    pub temperature: f64,
    /// Heat transfer coefficient, `h_c` [W/(m² K)]; infinite where the back of the wall has the
    /// temperature of the coolant, 0 for a wall without heat loss.
    pub coefficient: f64,
}

/// What heats the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HotSide {
    /// Temperature of the gas, `T_g` [K].
    pub gas_temperature: f64,
    /// Heat transfer coefficient of the gas, `h` [W/(m² K)]; infinite for [`steady`] where the
    /// temperature of the surface is known.
    pub coefficient: f64,
    /// Emissivity of the surface, `epsilon` [1].
    pub emissivity: f64,
    /// Irradiation, `G` [W/m²]: `sigma T^4` of surroundings of one temperature.
    pub irradiation: f64,
    /// What particles bring, `q_p` [W/m²].
    pub particle_flux: f64,
}

impl HotSide {
    /// Heat flux into a surface of this temperature [W/m²].
    pub fn heat_flux(&self, surface: f64) -> f64 {
        self.coefficient * (self.gas_temperature - surface)
            + self.emissivity * (self.irradiation - STEFAN_BOLTZMANN * surface.powi(4))
            + self.particle_flux
    }
}

/// Why there is no temperature.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ConductionError {
    /// A number without physical meaning.
    #[error("{quantity} is {value}, which has no physical meaning")]
    Meaningless {
        /// Its name.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// No heat leaves on either side, or the surface would be colder than 0 K.
    #[error(
        "the heat balance of the wall has no solution: give a coolant, or a gas that takes or gives heat"
    )]
    NoBalance,
}

/// The steady state of a wall.
#[derive(Debug, Clone, PartialEq)]
pub struct SteadyWall {
    /// Temperature of the surface towards the gas, `T_s` [K].
    pub surface_temperature: f64,
    /// Heat flux from the gas to the coolant, `q` [W/m²].
    pub heat_flux: f64,
    /// Temperatures of the cold side of each layer [K], in the order of the layers.
    pub cold_sides: Vec<f64>,
}

/// Steady state of `layers`, from the coolant to the gas. With an infinite heat transfer
/// coefficient of the gas the surface has its temperature, and the flux is what the layers conduct.
///
/// # Errors
/// [`ConductionError`].
pub fn steady(
    layers: &[ConductingLayer],
    coolant: &Coolant,
    hot: &HotSide,
) -> Result<SteadyWall, ConductionError> {
    let is_known = hot.coefficient == f64::INFINITY;
    check(layers, coolant, &HotSide { coefficient: if is_known { 0.0 } else { hot.coefficient }, ..*hot })?;
    let resistance = 1.0 / coolant.coefficient + layers.iter().map(ConductingLayer::resistance).sum::<f64>();
    let surface_temperature = if is_known {
        hot.gas_temperature
    } else {
        surface_temperature(resistance, coolant.temperature, hot)?
    };
    let heat_flux = match resistance {
        0.0 if is_known => return Err(ConductionError::NoBalance),
        0.0 => hot.heat_flux(surface_temperature),
        _ if is_known => (surface_temperature - coolant.temperature) / resistance,
        _ => heat_flux(resistance, coolant.temperature, surface_temperature, hot),
    };
    let mut temperature = surface_temperature;
    let inwards = layers.iter().rev().map(|layer| {
        temperature -= heat_flux * layer.resistance();
        temperature
    });
    let mut cold_sides: Vec<f64> = inwards.collect();
    cold_sides.reverse();
    Ok(SteadyWall { surface_temperature, heat_flux, cold_sides })
}

/// Temperature [K] of a surface with a resistance [m² K/W] between it and a temperature behind it [K]: the root of
/// `q(T_s) - (T_s - T_c)/R`. That function falls and is concave, so Newton's method converges from above.
///
/// # Errors
/// [`ConductionError::NoBalance`].
pub fn surface_temperature(resistance: f64, behind: f64, hot: &HotSide) -> Result<f64, ConductionError> {
    let conductance = 1.0 / resistance;
    // Nothing lies between, or a film so thin that this overflows.
    if (conductance * behind).is_infinite() {
        return Ok(behind);
    }
    // Everything that does not depend on the surface.
    let given = hot.heat_flux(0.0) + conductance * behind;
    let [linear, quartic] = [conductance + hot.coefficient, hot.emissivity * STEFAN_BOLTZMANN];
    if !(given.is_finite() && given > 0.0 && linear + quartic > 0.0) {
        return Err(ConductionError::NoBalance);
    }
    // Without one of the two losses the surface is hotter than with both.
    let mut temperature = (given / linear).min((given / quartic).sqrt().sqrt());
    for _ in 0..MOST_NEWTON_STEPS {
        let excess = given - linear * temperature - quartic * temperature.powi(4);
        let change = excess / (linear + 4.0 * quartic * temperature.powi(3));
        temperature += change;
        if change.abs() <= CONVERGED * temperature {
            break;
        }
    }
    Ok(temperature)
}

/// Heat flux [W/m²] through a resistance [m² K/W] to a temperature behind it [K], with the surface of
/// [`surface_temperature`] [K]: from the side that resists more, since the difference of temperatures
/// over a small resistance is rounding.
pub(super) fn heat_flux(resistance: f64, behind: f64, surface: f64, hot: &HotSide) -> f64 {
    let gas = hot.coefficient + 4.0 * hot.emissivity * STEFAN_BOLTZMANN * surface.powi(3);
    if resistance * gas < 1.0 { hot.heat_flux(surface) } else { (surface - behind) / resistance }
}

fn check(layers: &[ConductingLayer], coolant: &Coolant, hot: &HotSide) -> Result<(), ConductionError> {
    let positive = |value: f64| value.is_finite() && value > 0.0;
    let at_least_zero = |value: f64| value.is_finite() && value >= 0.0;
    let of_layers = layers.iter().flat_map(|layer| {
        [
            ("thickness", layer.thickness, at_least_zero(layer.thickness)),
            ("conductivity", layer.conductivity, positive(layer.conductivity)),
        ]
    });
    let of_sides = [
        ("coolant temperature", coolant.temperature, positive(coolant.temperature)),
        ("coolant coefficient", coolant.coefficient, coolant.coefficient >= 0.0),
        ("gas temperature", hot.gas_temperature, positive(hot.gas_temperature)),
        ("gas coefficient", hot.coefficient, at_least_zero(hot.coefficient)),
        ("emissivity", hot.emissivity, (0.0..=1.0).contains(&hot.emissivity)),
        ("irradiation", hot.irradiation, at_least_zero(hot.irradiation)),
        ("particle flux", hot.particle_flux, hot.particle_flux.is_finite()),
    ];
    match of_layers.chain(of_sides).find(|(_, _, sound)| !sound) {
        Some((quantity, value, _)) => Err(ConductionError::Meaningless { quantity, value }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const WATER: Coolant = Coolant { temperature: 600.0, coefficient: 1e4 };
    const FURNACE: HotSide = HotSide {
        gas_temperature: 1700.0,
        coefficient: 60.0,
        emissivity: 0.8,
        irradiation: 3e5,
        particle_flux: 2e3,
    };
    /// Steel and ash.
    const TUBE: [ConductingLayer; 2] = [
        ConductingLayer { thickness: 6e-3, conductivity: 35.0 },
        ConductingLayer { thickness: 3e-3, conductivity: 0.6 },
    ];

    /// A surface whose temperature is known: what a very good heat transfer approaches.
    #[test]
    fn a_known_surface_is_the_limit_of_good_heat_transfer() {
        let known = HotSide { coefficient: f64::INFINITY, gas_temperature: 1000.0, ..FURNACE };
        let wall = steady(&TUBE, &WATER, &known).unwrap();
        let near = steady(&TUBE, &WATER, &HotSide { coefficient: 1e12, ..known }).unwrap();
        assert_eq!(wall.surface_temperature, 1000.0);
        assert_relative_eq!(wall.heat_flux, near.heat_flux, max_relative = 1e-6);
        assert_relative_eq!(wall.cold_sides[1], near.cold_sides[1], max_relative = 1e-6);
        let bare = Coolant { coefficient: f64::INFINITY, ..WATER };
        assert_eq!(steady(&[], &bare, &known).unwrap_err(), ConductionError::NoBalance);
    }

    /// Radiation left out, the balance is linear: resistances in series.
    #[test]
    fn layers_in_series() {
        let gas = HotSide { emissivity: 0.0, particle_flux: 0.0, ..FURNACE };
        let wall = steady(&TUBE, &WATER, &gas).unwrap();
        let resistances = [1e-4, 6e-3 / 35.0, 3e-3 / 0.6, 1.0 / 60.0];
        let flux = 1100.0 / resistances.iter().sum::<f64>();
        assert_relative_eq!(wall.heat_flux, flux, max_relative = 1e-12);
        assert_relative_eq!(wall.surface_temperature, 1700.0 - flux / 60.0, max_relative = 1e-13);
        assert_relative_eq!(wall.cold_sides[0], 600.0 + flux * 1e-4, max_relative = 1e-12);
        assert_relative_eq!(wall.cold_sides[1], 600.0 + flux * (1e-4 + 6e-3 / 35.0), max_relative = 1e-12);
    }

    /// The root of the balance by bisection.
    #[test]
    fn radiation_and_conduction_balance() {
        for resistance in [1e-9, 1e-4, 5e-3, 1.0, 1e6] {
            let excess = |surface: f64| {
                60.0 * (1700.0 - surface) + 0.8 * (3e5 - 5.670374419e-8 * surface.powi(4)) + 2e3
                    - (surface - 600.0) / resistance
            };
            let [mut low, mut high] = [1.0, 1e4];
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                if excess(middle) > 0.0 { low = middle } else { high = middle }
            }
            let found = surface_temperature(resistance, 600.0, &FURNACE).unwrap();
            assert_relative_eq!(found, low, max_relative = 1e-12);
        }
        assert_eq!(surface_temperature(0.0, 600.0, &FURNACE).unwrap(), 600.0);
    }

    #[test]
    fn sides_without_heat() {
        let none = HotSide { coefficient: 0.0, emissivity: 0.0, particle_flux: 0.0, ..FURNACE };
        assert_relative_eq!(
            steady(&TUBE, &WATER, &none).unwrap().surface_temperature,
            600.0,
            max_relative = 1e-14
        );
        let insulated = Coolant { coefficient: 0.0, ..WATER };
        let wall = steady(&TUBE, &insulated, &FURNACE).unwrap();
        assert_eq!(wall.heat_flux, 0.0);
        assert_eq!(wall.cold_sides, [wall.surface_temperature; 2]);
        assert!(FURNACE.heat_flux(wall.surface_temperature).abs() < 1e-6);
        assert_eq!(steady(&TUBE, &insulated, &none), Err(ConductionError::NoBalance));
        let perfect = Coolant { coefficient: f64::INFINITY, ..WATER };
        assert_eq!(steady(&[], &perfect, &FURNACE).unwrap().heat_flux, FURNACE.heat_flux(600.0));
    }

    #[test]
    fn nonsense_is_named() {
        let bad = [ConductingLayer { conductivity: 0.0, ..TUBE[0] }];
        let error = steady(&bad, &WATER, &FURNACE).unwrap_err();
        assert_eq!(error.to_string(), "conductivity is 0, which has no physical meaning");
        assert!(steady(&TUBE, &WATER, &HotSide { emissivity: f64::NAN, ..FURNACE }).is_err());
    }
}
