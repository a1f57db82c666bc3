//! Heat conduction through a wall and its deposit, in one dimension: layers in series between a coolant and the gas.
//!
//! Steady: `q = (T_s - T_c)/R` with `R = 1/h_c + sum(delta_i/k_i)`. The hot side gives
//!
//! `q(T_s) = h (T_g - T_s) + epsilon (G - sigma T_s^4) + q_p`
//!
//! and both are equal at one surface temperature `T_s` only, since the first rises with it and the second falls.
//!
//! Transient: `c dT/dt = dq/dx` in cells of a capacity per area `c` with half of their resistance on either side, by the implicit Euler
//! method with Newton's for the hot side. What enters is what leaves plus what is stored, to rounding, in steps of any length; the
//! error in time is of first order. An infinite step gives the steady state.
//!
//! `q` heat flux into the wall [W/m²], `T_s T_c T_g` temperatures of surface, coolant and gas [K], `delta` thickness [m], `k` conductivity
//! [W/(m K)], `h_c h` heat transfer coefficients of coolant and gas [W/(m² K)], `epsilon` emissivity of the surface [1], `G`
//! irradiation [W/m²], `sigma` the Stefan–Boltzmann constant, `q_p` what particles bring [W/m²]. Valid for grey opaque surfaces and layers
//! thin against the curvature of the wall.
//!
//! Source: Incropera et al., Fundamentals of Heat and Mass Transfer, chapters 3 and 5 (not re-read); the tests hold it against series
//! and closed solutions.

/// Stefan–Boltzmann constant [W/(m² K⁴)], exact to its last digit in the SI of 2019.
pub const STEFAN_BOLTZMANN: f64 = 5.670_374_419e-8;

/// Largest number of Newton steps; some five are needed.
const MOST_STEPS: usize = 100;
/// Relative change of a temperature at which Newton's method ends [1].
const CONVERGED: f64 = 1e-14;

/// A layer of one material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Thickness, `delta` [m].
    pub thickness: f64,
    /// Thermal conductivity, `k` [W/(m K)].
    pub conductivity: f64,
    /// Heat capacity of its mass per area of wall, `c` [J/(m² K)].
    pub heat_capacity: f64,
}

impl Layer {
    /// Thermal resistance [m² K/W].
    pub fn resistance(&self) -> f64 {
        if self.thickness == 0.0 { 0.0 } else { self.thickness / self.conductivity }
    }

    /// So many equal cells.
    fn cells(&self, count: usize) -> impl Iterator<Item = Layer> + use<> {
        let share = 1.0 / count as f64;
        let cell =
            Self { thickness: self.thickness * share, heat_capacity: self.heat_capacity * share, ..*self };
        std::iter::repeat_n(cell, count)
    }
}

/// What cools the wall from behind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coolant {
    /// Temperature, `T_c` [K].
    pub temperature: f64,
    /// Heat transfer coefficient, `h_c` [W/(m² K)]; infinite where the back of the wall has the temperature of the coolant, 0 for
    /// a wall without heat loss.
    pub coefficient: f64,
}

/// What heats the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HotSide {
    /// Temperature of the gas, `T_g` [K].
    pub gas_temperature: f64,
    /// Heat transfer coefficient of the gas, `h` [W/(m² K)]; infinite for [`steady`] where the temperature of the surface is known.
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

    /// How fast the heat flux falls with the temperature of the surface [W/(m² K)].
    fn slope(&self, surface: f64) -> f64 {
        self.coefficient + 4.0 * self.emissivity * STEFAN_BOLTZMANN * surface.powi(3)
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

/// Steady state of `layers`, from the coolant to the gas. With an infinite heat transfer coefficient of the gas the surface has its
/// temperature, and the flux is what the layers conduct.
///
/// # Errors
/// [`ConductionError`].
pub fn steady(layers: &[Layer], coolant: &Coolant, hot: &HotSide) -> Result<SteadyWall, ConductionError> {
    let is_known = hot.coefficient == f64::INFINITY;
    check(layers, coolant, &HotSide { coefficient: if is_known { 0.0 } else { hot.coefficient }, ..*hot })?;
    let resistance = 1.0 / coolant.coefficient + layers.iter().map(Layer::resistance).sum::<f64>();
    let surface_temperature = if is_known {
        hot.gas_temperature
    } else {
        surface_temperature(resistance, coolant.temperature, hot)?
    };
    let heat_flux = match resistance {
        0.0 if is_known => return Err(ConductionError::NoBalance),
        0.0 => hot.heat_flux(surface_temperature),
        _ => (surface_temperature - coolant.temperature) / resistance,
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
    if resistance == 0.0 {
        return Ok(behind);
    }
    let conductance = 1.0 / resistance;
    // Everything that does not depend on the surface.
    let given = hot.heat_flux(0.0) + conductance * behind;
    let [linear, quartic] = [conductance + hot.coefficient, hot.emissivity * STEFAN_BOLTZMANN];
    if !(given.is_finite() && given > 0.0 && linear + quartic > 0.0) {
        return Err(ConductionError::NoBalance);
    }
    // Without one of the two losses the surface is hotter than with both.
    let mut temperature = (given / linear).min((given / quartic).sqrt().sqrt());
    for _ in 0..MOST_STEPS {
        let excess = given - linear * temperature - quartic * temperature.powi(4);
        let change = excess / (linear + 4.0 * quartic * temperature.powi(3));
        temperature += change;
        if change.abs() <= CONVERGED * temperature {
            break;
        }
    }
    Ok(temperature)
}

/// What crossed the sides of a wall over a step, and its surface then.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatStep {
    /// Heat flux from the gas into the surface [W/m²].
    pub from_gas: f64,
    /// Heat flux into the coolant [W/m²].
    pub to_coolant: f64,
    /// Temperature of the surface at the end, `T_s` [K].
    pub surface_temperature: f64,
}

/// Advances the temperatures [K] of the middles of cells, from the coolant to the gas, by a step [s]; `cells` are layers, one each.
///
/// # Errors
/// [`ConductionError`]; the temperatures then are as before.
pub fn advance(
    cells: &[Layer],
    temperatures: &mut [f64],
    coolant: &Coolant,
    hot: &HotSide,
    duration: f64,
) -> Result<HeatStep, ConductionError> {
    check(cells, coolant, hot)?;
    let before = temperatures.to_vec();
    if let Some(value) = before.iter().find(|value| !(value.is_finite() && **value > 0.0)) {
        return Err(ConductionError::Meaningless { quantity: "temperature", value: *value });
    }
    if duration.is_nan() || duration <= 0.0 || cells.len() != before.len() || cells.is_empty() {
        return Err(ConductionError::Meaningless {
            quantity: "duration or number of cells",
            value: duration,
        });
    }
    let half = |cell: &Layer| 0.5 * cell.resistance();
    // Conductances between the middles, from the coolant, and to the surface.
    let mut conductance = vec![1.0 / (1.0 / coolant.coefficient + half(&cells[0]))];
    conductance.extend(cells.windows(2).map(|pair| 1.0 / (half(&pair[0]) + half(&pair[1]))));
    let to_surface = 1.0 / half(&cells[cells.len() - 1]);
    let capacity: Vec<f64> = cells.iter().map(|cell| cell.heat_capacity / duration).collect();

    let mut now = before.clone();
    let mut surface = before[before.len() - 1];
    for _ in 0..MOST_STEPS {
        // The hot side, linear about the present surface, seen from the last cell: q = gain - loss T_N.
        let [flux, slope] = [hot.heat_flux(surface), hot.slope(surface)];
        let through = if to_surface.is_finite() { to_surface / (to_surface + slope) } else { 1.0 };
        let [gain, loss] = [(flux + slope * surface) * through, slope * through];
        let next = solve(&conductance, &capacity, &before, coolant.temperature, gain, loss)
            .ok_or(ConductionError::NoBalance)?;
        let last = next[next.len() - 1];
        let entering = gain - loss * last;
        let moved = if to_surface.is_finite() { last + entering / to_surface } else { last };
        if !(moved.is_finite() && moved > 0.0) {
            return Err(ConductionError::NoBalance);
        }
        let change = (moved - surface).abs();
        (now, surface) = (next, moved);
        if change <= CONVERGED * moved {
            break;
        }
    }
    let to_coolant = conductance[0] * (now[0] - coolant.temperature);
    let stored: f64 =
        capacity.iter().zip(now.iter().zip(&before)).map(|(c, (now, then))| c * (now - then)).sum();
    temperatures.copy_from_slice(&now);
    let from_gas = hot.heat_flux(surface);
    debug_assert!((from_gas - to_coolant - stored).abs() <= 1e-6 * (from_gas.abs() + stored.abs() + 1.0));
    Ok(HeatStep { from_gas, to_coolant, surface_temperature: surface })
}

/// Temperatures at the end of a step: a tridiagonal system, by elimination from the cold side; `None` where no heat can leave.
fn solve(
    conductance: &[f64],
    capacity: &[f64],
    before: &[f64],
    behind: f64,
    gain: f64,
    loss: f64,
) -> Option<Vec<f64>> {
    let count = before.len();
    // What is eliminated of each cell: T_i = factor_i T_(i+1) + rest_i.
    let [mut factor, mut rest] = [vec![0.0; count], vec![0.0; count]];
    let [mut passed, mut source] = [conductance[0], conductance[0] * behind];
    for i in 0..count {
        let outer = if i + 1 < count { conductance[i + 1] } else { loss };
        let heat = source + capacity[i] * before[i] + if i + 1 < count { 0.0 } else { gain };
        let sum = passed + capacity[i] + outer;
        if sum.is_nan() || sum <= 0.0 {
            return None;
        }
        (factor[i], rest[i]) = (outer / sum, heat / sum);
        // The next cell sees what lies behind it through its conductance.
        passed = outer * (passed + capacity[i]) / sum;
        source = outer * rest[i];
    }
    let mut temperatures = rest.clone();
    for i in (0..count - 1).rev() {
        temperatures[i] += factor[i] * temperatures[i + 1];
    }
    Some(temperatures)
}

/// Layers cut into so many cells each, for [`advance`].
pub fn cells(layers: &[Layer], of_each: usize) -> Vec<Layer> {
    layers
        .iter()
        .filter(|layer| layer.thickness > 0.0)
        .flat_map(|layer| layer.cells(of_each.max(1)))
        .collect()
}

fn check(layers: &[Layer], coolant: &Coolant, hot: &HotSide) -> Result<(), ConductionError> {
    let positive = |value: f64| value.is_finite() && value > 0.0;
    let at_least_zero = |value: f64| value.is_finite() && value >= 0.0;
    let of_layers = layers.iter().flat_map(|layer| {
        [
            ("thickness", layer.thickness, at_least_zero(layer.thickness)),
            ("conductivity", layer.conductivity, positive(layer.conductivity)),
            ("heat capacity", layer.heat_capacity, at_least_zero(layer.heat_capacity)),
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
    use std::f64::consts::PI;

    const WATER: Coolant = Coolant { temperature: 600.0, coefficient: 1e4 };
    const FURNACE: HotSide = HotSide {
        gas_temperature: 1700.0,
        coefficient: 60.0,
        emissivity: 0.8,
        irradiation: 3e5,
        particle_flux: 2e3,
    };
    /// Steel and ash.
    const TUBE: [Layer; 2] = [
        Layer { thickness: 6e-3, conductivity: 35.0, heat_capacity: 6e-3 * 4e6 },
        Layer { thickness: 3e-3, conductivity: 0.6, heat_capacity: 3e-3 * 1.2e6 },
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
        let bad = [Layer { conductivity: 0.0, ..TUBE[0] }];
        let error = steady(&bad, &WATER, &FURNACE).unwrap_err();
        assert_eq!(error.to_string(), "conductivity is 0, which has no physical meaning");
        assert!(steady(&TUBE, &WATER, &HotSide { emissivity: f64::NAN, ..FURNACE }).is_err());
        assert!(advance(&TUBE, &mut [600.0, f64::NAN], &WATER, &FURNACE, 1.0).is_err());
        assert!(advance(&TUBE, &mut [600.0], &WATER, &FURNACE, 1.0).is_err());
        assert!(advance(&TUBE, &mut [600.0; 2], &WATER, &FURNACE, 0.0).is_err());
    }

    /// Slab of the diffusivity `a`, one side held at 0 above the start, the other heated by a constant flux: the classical series
    /// (Carslaw & Jaeger), `T - T_0 = q/k (x - 8 L/pi^2 sum (-1)^n/(2n+1)^2 sin((2n+1) pi x/2L) exp(-(2n+1)^2 pi^2 a t/4L^2))`.
    #[test]
    fn transient_slab() {
        let (length, k, capacity, flux) = (0.02, 1.5, 2e6, 4e4);
        let slab = Layer { thickness: length, conductivity: k, heat_capacity: capacity * length };
        let held = Coolant { temperature: 500.0, coefficient: f64::INFINITY };
        let heated = HotSide { coefficient: 0.0, emissivity: 0.0, particle_flux: flux, ..FURNACE };
        let series = |x: f64, time: f64| {
            let term = |n: i32| {
                let m = f64::from(2 * n + 1);
                let decay = (-(m * PI / (2.0 * length)).powi(2) * k / capacity * time).exp();
                f64::from(1 - 2 * (n % 2)) / (m * m) * (m * PI * x / (2.0 * length)).sin() * decay
            };
            500.0 + flux / k * (x - 8.0 * length / (PI * PI) * (0..200).map(term).sum::<f64>())
        };
        let time = 60.0;
        let error = |count: usize, steps: u32| {
            let cells = cells(&[slab], count);
            let mut temperatures = vec![500.0; count];
            let mut end = None;
            for _ in 0..steps {
                end = Some(
                    advance(&cells, &mut temperatures, &held, &heated, time / f64::from(steps)).unwrap(),
                );
            }
            let middle = |i: usize| (i as f64 + 0.5) / count as f64 * length;
            let inside = temperatures.iter().enumerate().map(|(i, t)| (t - series(middle(i), time)).abs());
            inside.fold((end.unwrap().surface_temperature - series(length, time)).abs(), f64::max)
        };
        let [coarse, fine] = [error(20, 100), error(40, 400)];
        // Of 300 K; first order in time, second in space.
        assert!(coarse < 2.0 && fine < 0.3 * coarse, "{coarse} {fine}");
    }

    /// Semi-infinite body under a constant flux: its surface rises by `2 q sqrt(t/(pi k rho c))`.
    #[test]
    fn a_thick_wall_warms_with_the_root_of_time() {
        let (k, capacity, flux, time) = (1.0, 1e6, 1e4, 10.0_f64);
        let slab = Layer { thickness: 0.1, conductivity: k, heat_capacity: capacity * 0.1 };
        let heated = HotSide { coefficient: 0.0, emissivity: 0.0, particle_flux: flux, ..FURNACE };
        let cells = cells(&[slab], 400);
        let mut temperatures = vec![600.0; 400];
        let mut surface = 0.0;
        for _ in 0..2000 {
            surface = advance(&cells, &mut temperatures, &WATER, &heated, time / 2000.0)
                .unwrap()
                .surface_temperature;
        }
        assert_relative_eq!(
            surface - 600.0,
            2.0 * flux * (time / (PI * k * capacity)).sqrt(),
            max_relative = 1e-3
        );
    }

    /// In steps from a microsecond to a day.
    #[test]
    fn what_enters_leaves_or_is_stored() {
        for duration in [1e-6, 1e-3, 1.0, 3600.0, 86400.0] {
            let cells = cells(&TUBE, 5);
            let mut temperatures: Vec<f64> = (0..10).map(|i| 650.0 + 7.0 * f64::from(i * i)).collect();
            let before = temperatures.clone();
            let step = advance(&cells, &mut temperatures, &WATER, &FURNACE, duration).unwrap();
            let rises = temperatures.iter().zip(&before).map(|(now, then)| now - then);
            let stored: f64 = rises.zip(&cells).map(|(rise, cell)| rise * cell.heat_capacity).sum();
            let [entered, left] = [step.from_gas, step.to_coolant].map(|flux| flux * duration);
            // A temperature has 16 digits, which limits what is stored in the shortest steps.
            let digits: f64 =
                temperatures.iter().zip(&cells).map(|(t, cell)| f64::EPSILON * t * cell.heat_capacity).sum();
            let allowed = 1e-9 * entered.abs().max(left.abs()) + digits;
            assert!((entered - left - stored).abs() < allowed, "{duration}: {entered} {left} {stored}");
        }
    }

    #[test]
    fn a_long_step_is_the_steady_state() {
        let wall = steady(&TUBE, &WATER, &FURNACE).unwrap();
        for duration in [1e12, f64::INFINITY] {
            let mut temperatures = vec![300.0; 8];
            let step = advance(&cells(&TUBE, 4), &mut temperatures, &WATER, &FURNACE, duration).unwrap();
            assert_relative_eq!(step.surface_temperature, wall.surface_temperature, max_relative = 1e-9);
            assert_relative_eq!(step.from_gas, wall.heat_flux, max_relative = 1e-6);
            assert_relative_eq!(step.to_coolant, wall.heat_flux, max_relative = 1e-6);
        }
    }
}
