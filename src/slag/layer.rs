//! Slag on a cooled wall: liquid that flows over solid, which ends at the temperature of critical viscosity.
//!
//! The temperature falls from the surface `T_s` to `T_cv` across the liquid `delta_l`, from there through the solid `delta_s` and the wall
//! to the coolant `T_c`; conduction across is quasi-steady and linear in each part:
//!
//! `q = q_hot(T_s) = k_l (T_s - T_cv)/delta_l = (T_cv - T_c)/(R + delta_s/k_s)`
//!
//! The liquid flows under gravity with the viscosity of its temperature at each depth, at rest on the solid and free of stress outside,
//! so that the mass flow per width is
//!
//! `F = rho² g_t ∫ (delta_l - y)²/mu(T(y)) dy`, `y` from 0 on the solid to `delta_l`.
//!
//! A wall on which `m` arrives everywhere carries `F = m x` at the distance `x` below its upper edge: thickness and temperatures
//! follow ([`steady`]). A wall whose slag has not grown or run off yet has a given thickness, of which a part is liquid ([`split`]).
//! Where the wall itself is hotter than `T_cv` there is no solid, and the liquid ends at the wall.
//!
//! `q` heat flux [W/m²], `k_l k_s` conductivities [W/(m K)], `R` resistance of wall and coolant [m² K/W], `mu` viscosity [Pa s], `rho`
//! density [kg/m³], `g_t` gravity along the wall [m/s²], `m` arrival [kg/m²/s]. What arrives heats by its own `q_p` of the hot side.
//! Neglected: heat carried along by the film, shear by the gas, curvature.
//!
//! Source: M. Seggiani, Modelling and simulation of time varying slag flow in a Prenflo entrained-flow gasifier, Fuel 77 (1998) 1611
//! (not re-read; solid and liquid divided at `T_cv`, linear temperature, viscosity over the depth). The tests hold `F` against the
//! closed integral for `mu` exponential in depth, and `film` for a constant one.

use crate::deposit::conduction::{ConductionError, Coolant, HotSide, surface_temperature};

/// Points and weights of Gauss and Legendre on -1 to 1, of one panel.
const GAUSS: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_86),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_86),
];
/// Panels over the depth: viscosity may fall a hundredfold across it.
const PANELS: u32 = 16;
/// Thinnest and thickest liquid that is looked for [m].
const THINNEST: f64 = 1e-9;
const THICKEST: f64 = 10.0;
/// Steps of a bisection, enough for all digits.
const BISECTIONS: u32 = 100;

/// A wall that may carry slag, and the slag's numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CooledWall {
    /// Coolant, `T_c`.
    pub coolant: Coolant,
    /// Resistance of the wall without coolant and slag [m² K/W].
    pub wall_resistance: f64,
    /// What heats the surface.
    pub hot: HotSide,
    /// Temperature of critical viscosity, `T_cv` [K].
    pub critical_temperature: f64,
    /// Conductivities of solid and liquid slag, `k_s k_l` [W/(m K)].
    pub conductivities: [f64; 2],
}

/// Slag on a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlagLayer {
    /// Thickness of the solid, `delta_s` [m].
    pub solid: f64,
    /// Thickness of the liquid, `delta_l` [m].
    pub liquid: f64,
    /// Temperature where the liquid ends [K]: `T_cv`, or that of the wall where there is no solid.
    pub bottom_temperature: f64,
    /// Temperature of the surface, `T_s` [K].
    pub surface_temperature: f64,
    /// Heat flux, `q` [W/m²].
    pub heat_flux: f64,
}

impl CooledWall {
    /// Wall and coolant, `R` [m² K/W].
    fn resistance(&self) -> f64 {
        self.wall_resistance + 1.0 / self.coolant.coefficient
    }

    /// The slag with this much liquid on as much solid as its heat flux leaves.
    ///
    /// # Errors
    /// [`ConductionError::NoBalance`].
    pub fn with_liquid(&self, liquid: f64) -> Result<SlagLayer, ConductionError> {
        let [k_solid, k_liquid] = self.conductivities;
        let (critical, behind) = (self.critical_temperature, self.coolant.temperature);
        let surface = surface_temperature(liquid / k_liquid, critical, &self.hot)?;
        let heat_flux = self.hot.heat_flux(surface);
        let solid = k_solid * ((critical - behind) / heat_flux - self.resistance());
        if heat_flux > 0.0 && solid >= 0.0 {
            return Ok(SlagLayer {
                solid,
                liquid,
                bottom_temperature: critical,
                surface_temperature: surface,
                heat_flux,
            });
        }
        self.of_resistance(0.0, liquid)
    }

    /// Slag of which the thicknesses are known.
    fn of_resistance(&self, solid: f64, liquid: f64) -> Result<SlagLayer, ConductionError> {
        let [k_solid, k_liquid] = self.conductivities;
        let resistance = self.resistance() + solid / k_solid + liquid / k_liquid;
        let surface = surface_temperature(resistance, self.coolant.temperature, &self.hot)?;
        let heat_flux = self.hot.heat_flux(surface);
        let bottom_temperature = surface - heat_flux * liquid / k_liquid;
        Ok(SlagLayer { solid, liquid, bottom_temperature, surface_temperature: surface, heat_flux })
    }
}

/// Divides slag of a thickness [m] into solid and liquid.
///
/// # Errors
/// [`ConductionError::NoBalance`].
pub fn split(wall: &CooledWall, thickness: f64) -> Result<SlagLayer, ConductionError> {
    let [mut low, mut high] = [0.0, thickness];
    let all_liquid = wall.of_resistance(0.0, thickness)?;
    if all_liquid.bottom_temperature >= wall.critical_temperature {
        return Ok(all_liquid);
    }
    // With more liquid its bottom lies deeper and is colder.
    for _ in 0..BISECTIONS {
        let liquid = 0.5 * (low + high);
        let bottom = wall.of_resistance(thickness - liquid, liquid)?.bottom_temperature;
        if bottom > wall.critical_temperature { low = liquid } else { high = liquid }
    }
    wall.of_resistance(thickness - low, low)
}

/// Slag that carries a mass flow per width [kg/m/s]: `density` of the liquid, `gravity_along` the wall [m/s²], `viscosity` [Pa s] at a
/// temperature [K].
///
/// # Errors
/// [`ConductionError::NoBalance`]; also where no film up to 10 m carries that flow.
pub fn steady(
    wall: &CooledWall,
    flow_per_width: f64,
    density: f64,
    gravity_along: f64,
    viscosity: impl Fn(f64) -> f64,
) -> Result<SlagLayer, ConductionError> {
    if flow_per_width == 0.0 {
        return wall.with_liquid(0.0);
    }
    let [mut low, mut high] = [THINNEST, THICKEST];
    let carried = |liquid: f64| {
        let slag = wall.with_liquid(liquid)?;
        Ok::<_, ConductionError>(flow(&slag, density, gravity_along, &viscosity))
    };
    if !(flow_per_width > 0.0 && carried(high)? >= flow_per_width) {
        return Err(ConductionError::NoBalance);
    }
    for _ in 0..BISECTIONS {
        let liquid = (low * high).sqrt();
        if carried(liquid)? < flow_per_width { low = liquid } else { high = liquid }
    }
    wall.with_liquid(high)
}

/// Mass flow per width, `F` [kg/m/s].
pub fn flow(slag: &SlagLayer, density: f64, gravity_along: f64, viscosity: impl Fn(f64) -> f64) -> f64 {
    let temperatures = [slag.bottom_temperature, slag.surface_temperature];
    density * slag.liquid * mean_velocity(slag.liquid, temperatures, density, gravity_along, viscosity)
}

/// Mean speed [m/s] of a film of a thickness [m] with these temperatures [K] of its bottom and its surface and a straight line in between. A
/// part whose viscosity is infinite does not move.
pub fn mean_velocity(
    thickness: f64,
    [bottom, surface]: [f64; 2],
    density: f64,
    gravity_along: f64,
    viscosity: impl Fn(f64) -> f64,
) -> f64 {
    let rise = surface - bottom;
    let panel = |number: u32| {
        let width = 1.0 / f64::from(PANELS);
        let point = |(x, weight): (f64, f64)| {
            let depth = width * (f64::from(number) + 0.5 * (1.0 + x));
            0.5 * width * weight * (1.0 - depth).powi(2) / viscosity(bottom + rise * depth)
        };
        GAUSS.into_iter().map(point).sum::<f64>()
    };
    let mobility: f64 = (0..PANELS).map(panel).sum();
    density * gravity_along * thickness * thickness * mobility
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::slag::film;
    use approx::assert_relative_eq;

    const WALL: CooledWall = CooledWall {
        coolant: Coolant { temperature: 540.0, coefficient: 5e3 },
        wall_resistance: 2e-3,
        hot: HotSide {
            gas_temperature: 1850.0,
            coefficient: 100.0,
            emissivity: 0.83,
            irradiation: 6e5,
            particle_flux: 1e4,
        },
        critical_temperature: 1550.0,
        conductivities: [1.6, 1.6],
    };
    const RHO: f64 = 2700.0;
    const G: f64 = 9.81;

    #[test]
    fn constant_viscosity_is_the_nusselt_film() {
        let slag = WALL.with_liquid(2e-3).unwrap();
        assert_relative_eq!(
            flow(&slag, RHO, G, |_| 20.0),
            film::flow(2e-3, RHO, 20.0, G),
            max_relative = 1e-13
        );
    }

    /// `mu = mu_s exp(a (1 - y/delta))`: `F = rho² g delta³/mu_s (2 - (a² + 2a + 2) exp(-a))/a³`.
    #[test]
    fn viscosity_exponential_in_depth_has_a_closed_integral() {
        let slag = WALL.with_liquid(3e-3).unwrap();
        for a in [0.5, 2.0, 6.0_f64] {
            let depth =
                |t: f64| (t - slag.bottom_temperature) / (slag.surface_temperature - slag.bottom_temperature);
            let found = flow(&slag, RHO, G, |t| 5.0 * (a * (1.0 - depth(t))).exp());
            let closed = RHO * RHO * G * 3e-3_f64.powi(3) / 5.0
                * (2.0 - (a * a + 2.0 * a + 2.0) * (-a).exp())
                / a.powi(3);
            assert_relative_eq!(found, closed, max_relative = 1e-9);
        }
    }

    /// The same heat flux through gas, liquid, solid, wall and coolant; and the flow that was asked for.
    #[test]
    fn steady_slag_balances_heat_and_mass() {
        let viscosity = |t: f64| 3.0 * (8000.0 / t - 8000.0 / 1700.0).exp();
        for wanted in [1e-4, 5e-3, 0.1] {
            let slag = steady(&WALL, wanted, RHO, G, viscosity).unwrap();
            assert_relative_eq!(flow(&slag, RHO, G, viscosity), wanted, max_relative = 1e-9);
            let q = slag.heat_flux;
            assert_relative_eq!(
                q,
                1.6 * (slag.surface_temperature - 1550.0) / slag.liquid,
                max_relative = 1e-6
            );
            assert_relative_eq!(1550.0 - 540.0, q * (2e-4 + 2e-3 + slag.solid / 1.6), max_relative = 1e-12);
            assert_relative_eq!(q, WALL.hot.heat_flux(slag.surface_temperature), max_relative = 1e-12);
        }
        // More slag insulates more: less heat, hotter surface, thicker liquid, and a thinner solid only where heat rises.
        let [little, much] = [1e-3, 0.1].map(|wanted| steady(&WALL, wanted, RHO, G, viscosity).unwrap());
        assert!(much.liquid > little.liquid && much.surface_temperature > little.surface_temperature);
        assert!(much.heat_flux < little.heat_flux && much.solid > little.solid);
    }

    #[test]
    fn a_given_thickness_is_divided_where_it_has_the_critical_temperature() {
        let steady = steady(&WALL, 0.01, RHO, G, |_| 10.0).unwrap();
        let again = split(&WALL, steady.solid + steady.liquid).unwrap();
        assert_relative_eq!(again.liquid, steady.liquid, max_relative = 1e-9);
        assert_relative_eq!(again.surface_temperature, steady.surface_temperature, max_relative = 1e-12);
        let thin = split(&WALL, 1e-5).unwrap();
        assert!(thin.liquid < 1e-15 && thin.surface_temperature < 1550.0);
        let uncooled = CooledWall { wall_resistance: 1.0, ..WALL };
        assert_eq!(split(&uncooled, 1e-3).unwrap().solid, 0.0);
    }

    /// A wall cut into strips, from bare to steady: each strip receives what arrives and what runs down. The end is the
    /// steady profile; nothing is lost on the way.
    #[test]
    fn growth_ends_at_the_steady_profile() {
        let (strips, height, arrival) = (8, 2.0, 0.02);
        let width = height / strips as f64;
        let viscosity = |t: f64| 3.0 * (8000.0 / t - 8000.0 / 1700.0).exp();
        let mut thickness = vec![0.0; strips];
        let (mut arrived, mut left) = (0.0, 0.0);
        let step = 200.0;
        for _ in 0..250 {
            let mut above = 0.0;
            for own in &mut thickness {
                // Implicit for the strip: mass/step rises by arrival and inflow, falls by outflow.
                let inflow = arrival * width + above;
                let rate = |d: f64| {
                    let slag = split(&WALL, d).unwrap();
                    RHO * width * (d - *own) / step + flow(&slag, RHO, G, viscosity) - inflow
                };
                let [mut low, mut high] = [*own * 0.5, *own + inflow * step / (RHO * width) + 1e-12];
                for _ in 0..40 {
                    let middle = 0.5 * (low + high);
                    if rate(middle) > 0.0 { high = middle } else { low = middle }
                }
                above = inflow - RHO * width * (low - *own) / step;
                *own = low;
            }
            arrived += arrival * height * step;
            left += above * step;
        }
        let on_wall: f64 = thickness.iter().map(|d| RHO * width * d).sum();
        assert_relative_eq!(arrived, left + on_wall, max_relative = 1e-9);
        for (number, own) in thickness.iter().enumerate() {
            let slag = steady(&WALL, arrival * width * (number as f64 + 1.0), RHO, G, viscosity).unwrap();
            assert_relative_eq!(*own, slag.solid + slag.liquid, max_relative = 1e-4);
        }
    }
}
