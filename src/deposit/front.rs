//! The front between solid and liquid in a deposit: it melts and freezes with the heat that comes and goes.
//!
//! Heat crosses the layers of `layers.rs` in series between coolant and gas. Slag is solid below the
//! temperature `T_m`; where solid and liquid meet, the front has `T_m`. With the heat flux `q_g` that
//! reaches it from the gas and `q_c` that leaves it to the coolant,
//!
//! `L dm/dt = q_g - q_c`, `q_c = (T_m - T_c)/(1/h_c + R_w + R_i + R_f)`,
//! `q_g = (T_s - T_m)/(R_m + R_o) = q(T_s)` of [`HotSide::heat_flux`].
//!
//! `m` mass that has melted [kg/m²], `L` heat of fusion [J/kg], `T_c T_s` temperatures of coolant and
//! surface [K], `h_c` coefficient of the coolant [W/(m² K)], `R` thermal resistances [m² K/W] of wall,
//! inner powder, frozen and molten slag and outer powder, each proportional to its mass; the two fluxes
//! in W/m². Over a step the balance holds with the masses at its end (backward Euler), so that no step
//! passes the balance; where all solid or all liquid is used up earlier, the rest of the step is
//! steady. Without a heat of fusion the front is at its balance after every step.
//!
//! Stefan's problem in its quasi-steady form (Carslaw & Jaeger, Conduction of Heat in Solids, chapter
//! 11; not re-read): the sensible heat of the layers is left out, which holds for a Stefan number `c_p
//! dT/L` below 1 or for changes that are slow against `delta²/alpha`, half a minute for 5 mm of slag.
//! The tests integrate the front on their own. The heat comes from the gas: a surface that is held at
//! a temperature has none to give, and is refused.

use super::conduction::{self, ConductingLayer, ConductionError, Coolant, HotSide};
use super::layers::Layers;

/// Largest number of halvings in the search of a front.
const MOST_HALVINGS: u32 = 200;
/// Relative width [1] at which the search ends.
const FOUND: f64 = 1e-15;

/// How the layers of a deposit conduct and melt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThermalLayers {
    /// What cools the wall from behind.
    pub coolant: Coolant,
    /// Thickness of the wall over its conductivity, `R_w` [m² K/W].
    pub wall_resistance: f64,
    /// What heats the surface.
    pub hot: HotSide,
    /// Thermal resistance over mass of each layer [m² K/W per kg/m²].
    pub resistance_per_mass: Layers<f64>,
    /// Temperature below which slag is solid, `T_m` [K]; `None` where it is not known: nothing freezes.
    pub slag_melts_at: Option<f64>,
    /// Temperature from which the outer powder melts [K]; infinite for powder that does not.
    pub powder_melts_at: f64,
    /// Heat of fusion, `L` [J/kg]; 0 where it is not known.
    pub heat_of_fusion: f64,
}

/// Temperatures and heat fluxes of a wall with a deposit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatFlow {
    /// Temperatures of the cold and the hot side of each layer [K].
    pub sides: Layers<[f64; 2]>,
    /// Heat flux from the gas into the surface [W/m²].
    pub from_gas: f64,
    /// Heat flux into the coolant [W/m²]; the rest melts slag.
    pub to_coolant: f64,
    /// Temperature [K] of what holds it behind the surface, the coolant or a front that moves, and the
    /// thermal resistance [m² K/W] in between.
    pub behind: [f64; 2],
}

/// What a time step did to the layers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrontStep {
    /// Their masses after it [kg/m²].
    pub masses: Layers<f64>,
    /// Heat that came from the gas [J/m²].
    pub from_gas: f64,
    /// Heat that went into the coolant [J/m²].
    pub to_coolant: f64,
    /// Mass that melted [kg/m²]; negative where it froze.
    pub melted: f64,
    /// Heat that melting took [J/m²], this mass times the heat of fusion.
    pub fusion: f64,
}

impl HeatFlow {
    /// Temperature of the surface [K].
    pub fn surface(&self) -> f64 {
        self.sides.outer_powder[1]
    }

    /// Temperature of the wall under the deposit [K].
    pub fn wall(&self) -> f64 {
        self.sides.inner_powder[0]
    }
}

impl ThermalLayers {
    /// Temperatures and fluxes with these masses of the layers [kg/m²]. Where slag is melting or
    /// freezing and has a heat of fusion, the front has its temperature; otherwise one flux crosses all
    /// layers.
    ///
    /// # Errors
    /// [`ConductionError`].
    pub fn flow(&self, masses: &Layers<f64>) -> Result<HeatFlow, ConductionError> {
        let steady = self.steady(masses)?;
        match self.moving_front(masses, &steady) {
            Some(front) => self.at_front(masses, front),
            None => Ok(steady),
        }
    }

    /// The temperature of the front [K] where it moves and takes heat.
    fn moving_front(&self, masses: &Layers<f64>, steady: &HeatFlow) -> Option<f64> {
        let melts_at = self.slag_melts_at?;
        let here = steady.sides.molten[0];
        let freezes = masses.molten > 0.0 && here < melts_at;
        let melts = masses.frozen + masses.inner_powder > 0.0 && here > melts_at;
        let takes_heat = self.heat_of_fusion > 0.0 && self.hot.coefficient.is_finite();
        // What touches the coolant has its temperature.
        let held = self.inside(masses) > 0.0;
        (takes_heat && held && (freezes || melts)).then_some(melts_at)
    }

    fn steady(&self, masses: &Layers<f64>) -> Result<HeatFlow, ConductionError> {
        let resistances = self.resistances(masses).outwards();
        let layer = |resistance| ConductingLayer { thickness: resistance, conductivity: 1.0 };
        let [inner, frozen, molten, outer] = resistances.map(layer);
        let all = [layer(self.wall_resistance), inner, frozen, molten, outer];
        let steady = conduction::steady(&all, &self.coolant, &self.hot)?;
        let [_, inner, frozen, molten, outer] = [0, 1, 2, 3, 4].map(|place| steady.cold_sides[place]);
        let surface = steady.surface_temperature;
        let sides = [[inner, frozen], [frozen, molten], [molten, outer], [outer, surface]];
        let (from_gas, to_coolant) = (steady.heat_flux, steady.heat_flux);
        let resistance = self.inside(masses) + resistances[2] + resistances[3];
        let behind = [self.coolant.temperature, resistance];
        Ok(HeatFlow { sides: Layers::from_outwards(sides), from_gas, to_coolant, behind })
    }

    fn at_front(&self, masses: &Layers<f64>, front: f64) -> Result<HeatFlow, ConductionError> {
        let of = self.resistances(masses);
        let [from_gas, to_coolant] = self.fluxes_at(masses, front)?;
        let frozen = front - to_coolant * of.frozen;
        let molten = front + from_gas * of.molten;
        let sides = Layers {
            inner_powder: [frozen - to_coolant * of.inner_powder, frozen],
            frozen: [frozen, front],
            molten: [front, molten],
            outer_powder: [molten, molten + from_gas * of.outer_powder],
        };
        Ok(HeatFlow { sides, from_gas, to_coolant, behind: [front, of.molten + of.outer_powder] })
    }

    /// Thermal resistance of all layers [m² K/W].
    pub(crate) fn resistance(&self, masses: &Layers<f64>) -> f64 {
        self.resistances(masses).outwards().iter().sum()
    }

    /// Thermal resistances [m² K/W].
    fn resistances(&self, masses: &Layers<f64>) -> Layers<f64> {
        let [of, per] = [masses.outwards(), self.resistance_per_mass.outwards()];
        Layers::from_outwards([0, 1, 2, 3].map(|i| of[i] * per[i]))
    }

    /// Heat fluxes [W/m²] from the gas to a front of a temperature [K] and from it to the coolant.
    fn fluxes_at(&self, masses: &Layers<f64>, front: f64) -> Result<[f64; 2], ConductionError> {
        let of = self.resistances(masses);
        let outside = of.molten + of.outer_powder;
        let surface = conduction::surface_temperature(outside, front, &self.hot)?;
        let from_gas = conduction::heat_flux(outside, front, surface, &self.hot);
        Ok([from_gas, (front - self.coolant.temperature) / self.inside(masses)])
    }

    /// Thermal resistance between coolant and front [m² K/W].
    fn inside(&self, masses: &Layers<f64>) -> f64 {
        let of = self.resistances(masses);
        1.0 / self.coolant.coefficient + self.wall_resistance + of.inner_powder + of.frozen
    }

    /// The layers after a time step [s].
    ///
    /// # Errors
    /// [`ConductionError`]; a surface that is held at a temperature is refused.
    pub fn after(&self, masses: &Layers<f64>, duration: f64) -> Result<FrontStep, ConductionError> {
        self.after_flow(masses, &self.flow(masses)?, duration)
    }

    /// [`Self::after`] where the [`Self::flow`] at the start is known.
    pub(crate) fn after_flow(
        &self,
        masses: &Layers<f64>,
        flow: &HeatFlow,
        duration: f64,
    ) -> Result<FrontStep, ConductionError> {
        if !self.hot.coefficient.is_finite() {
            let (quantity, value) = ("gas coefficient", self.hot.coefficient);
            return Err(ConductionError::Meaningless { quantity, value });
        }
        if masses.outer_powder > 0.0 && flow.surface() > self.powder_melts_at {
            let inner_powder = masses.inner_powder + masses.outer_powder;
            let enclosed = Layers { inner_powder, outer_powder: 0.0, ..*masses };
            let step = self.moved(&enclosed, duration)?;
            if step.masses.molten > 0.0 {
                return Ok(step);
            }
        }
        self.moved(masses, duration)
    }

    /// [`Self::after`] where the front moves through what is slag or enclosed.
    fn moved(&self, masses: &Layers<f64>, duration: f64) -> Result<FrontStep, ConductionError> {
        let still = FrontStep { masses: *masses, from_gas: 0.0, to_coolant: 0.0, melted: 0.0, fusion: 0.0 };
        let Some(front) = self.slag_melts_at.filter(|_| duration > 0.0) else {
            return self.rest(still, duration);
        };
        let net = |melted: f64| {
            let [from_gas, to_coolant] = self.fluxes_at(&melt(masses, melted), front)?;
            Ok::<f64, ConductionError>(from_gas - to_coolant)
        };
        let now = net(0.0)?;
        let end = if now > 0.0 { masses.frozen + masses.inner_powder } else { -masses.molten };
        if now == 0.0 || now.is_nan() || end == 0.0 {
            return self.rest(still, duration);
        }
        let heat = |melted: f64| self.heat_of_fusion * melted;
        let at_end = net(end)?;
        let all = heat(end).abs() <= duration * at_end * end.signum();
        let (melted, time) = if all && at_end * now >= 0.0 {
            (end, if heat(end) == 0.0 { 0.0 } else { heat(end) / at_end })
        } else {
            (root(|melted| Ok(duration * net(melted)? - heat(melted)), end)?, duration)
        };
        let masses = melt(masses, melted);
        let [from_gas, to_coolant] = self.fluxes_at(&masses, front)?;
        let from_gas = from_gas * time;
        // Without a resistance the coolant gives or takes all at once.
        let to_coolant = if to_coolant.is_finite() { to_coolant * time } else { from_gas - heat(melted) };
        self.rest(FrontStep { masses, from_gas, to_coolant, melted, fusion: heat(melted) }, duration - time)
    }

    /// A step with the heat of its steady rest [s].
    fn rest(&self, step: FrontStep, rest: f64) -> Result<FrontStep, ConductionError> {
        if rest <= 0.0 {
            return Ok(step);
        }
        let flow = self.steady(&step.masses)?;
        let from_gas = step.from_gas + flow.from_gas * rest;
        Ok(FrontStep { from_gas, to_coolant: step.to_coolant + flow.to_coolant * rest, ..step })
    }
}

/// The layers after a mass [kg/m²] has melted, or frozen where it is negative.
fn melt(masses: &Layers<f64>, melted: f64) -> Layers<f64> {
    if melted <= 0.0 {
        let molten = (masses.molten + melted).max(0.0);
        return Layers { frozen: masses.frozen - melted, molten, ..*masses };
    }
    let of_powder = (melted - masses.frozen).max(0.0);
    Layers {
        inner_powder: (masses.inner_powder - of_powder).max(0.0),
        frozen: (masses.frozen - melted).max(0.0),
        molten: masses.molten + melted,
        ..*masses
    }
}

/// The place between 0 and `end` where a function changes its sign, by halving: a front next to nothing
/// is found as well as any other.
fn root(excess: impl Fn(f64) -> Result<f64, ConductionError>, end: f64) -> Result<f64, ConductionError> {
    let (mut near, mut far) = (0.0, end);
    for _ in 0..MOST_HALVINGS {
        let middle = 0.5 * (near + far);
        if excess(middle)? * end.signum() > 0.0 {
            near = middle
        } else {
            far = middle
        }
        if (far - near).abs() <= FOUND * far.abs() {
            break;
        }
    }
    Ok(0.5 * (near + far))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deposit::{Deposit, DepositSource};
    use approx::assert_relative_eq;

    const FURNACE: HotSide = HotSide {
        gas_temperature: 1700.0,
        coefficient: 60.0,
        emissivity: 0.8,
        irradiation: 6e5,
        particle_flux: 0.0,
    };
    /// Slag of 2500 kg/m³ and 1.5 W/(m K), powder of 1000 kg/m³ and 0.3 W/(m K).
    const LAYERS: ThermalLayers = ThermalLayers {
        coolant: Coolant { temperature: 600.0, coefficient: 1e4 },
        wall_resistance: 2e-4,
        hot: FURNACE,
        resistance_per_mass: Layers {
            inner_powder: 1.0 / 300.0,
            frozen: 1.0 / 3750.0,
            molten: 1.0 / 3750.0,
            outer_powder: 1.0 / 300.0,
        },
        slag_melts_at: Some(1400.0),
        powder_melts_at: 1400.0,
        heat_of_fusion: 3e5,
    };
    const COLD: HotSide = HotSide { gas_temperature: 900.0, emissivity: 0.8, irradiation: 3e4, ..FURNACE };

    fn slag(frozen: f64, molten: f64) -> Layers<f64> {
        Layers { frozen, molten, ..Layers::default() }
    }

    /// Root of a falling function by halving.
    fn halved(excess: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if excess(middle) > 0.0 { low = middle } else { high = middle }
        }
        low
    }

    /// Heat fluxes to and from a front at 1400 K, written out on its own.
    fn fluxes(hot: &HotSide, of: Layers<f64>) -> [f64; 2] {
        let outside = of.molten / 3750.0 + of.outer_powder / 300.0;
        let from_gas = |surface: f64| {
            hot.coefficient * (hot.gas_temperature - surface)
                + hot.emissivity * (hot.irradiation - 5.670_374_419e-8 * surface.powi(4))
        };
        let surface = halved(|s| from_gas(s) * outside - (s - 1400.0), 1.0, 1e4);
        let inside = 1e-4 + 2e-4 + of.inner_powder / 300.0 + of.frozen / 3750.0;
        [from_gas(surface), 800.0 / inside]
    }

    /// Runge–Kutta in small steps for `L dm/dt = q_g - q_c`: the mass that melts, and the two heats.
    fn integrated(hot: &HotSide, start: Layers<f64>, duration: f64, steps: u32) -> [f64; 3] {
        let step = duration / f64::from(steps);
        let at = |melted: f64| {
            let [frozen, molten] = [start.frozen - melted, start.molten + melted];
            fluxes(hot, Layers { frozen, molten, ..start })
        };
        let rate = |melted: f64| {
            let [from_gas, to_coolant] = at(melted);
            (from_gas - to_coolant) / 3e5
        };
        let mut sums = [0.0; 3];
        for _ in 0..steps {
            let melted = sums[0];
            let k1 = rate(melted);
            let k2 = rate(melted + 0.5 * step * k1);
            let k3 = rate(melted + 0.5 * step * k2);
            let k4 = rate(melted + step * k3);
            let next = melted + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
            let [before, middle, after] = [melted, 0.5 * (melted + next), next].map(at);
            for of in [0, 1] {
                sums[1 + of] += step / 6.0 * (before[of] + 4.0 * middle[of] + after[of]);
            }
            sums[0] = next;
        }
        sums
    }

    /// By the library in equal steps.
    fn stepped(hot: HotSide, start: Layers<f64>, duration: f64, steps: u32) -> (Layers<f64>, [f64; 3]) {
        let (mut masses, mut sums) = (start, [0.0; 3]);
        for _ in 0..steps {
            let step = ThermalLayers { hot, ..LAYERS }.after(&masses, duration / f64::from(steps)).unwrap();
            let latent = step.melted * 3e5;
            let scale = step.from_gas.abs().max(step.to_coolant.abs()).max(latent.abs());
            assert!((step.from_gas - step.to_coolant - latent).abs() <= 1e-9 * scale, "{step:?}");
            masses = step.masses;
            for (sum, more) in sums.iter_mut().zip([step.melted, step.from_gas, step.to_coolant]) {
                *sum += more;
            }
        }
        (masses, sums)
    }

    /// Melting and freezing against the separate integration: the error falls with the step.
    #[test]
    fn a_front_moves_as_integrated() {
        for (hot, start, time) in [(FURNACE, slag(12.0, 0.2), 10.0), (COLD, slag(1.0, 8.0), 1.5)] {
            let expected = integrated(&hot, start, time, 2000);
            assert!(expected[0].abs() > 0.5, "{expected:?}");
            let error = |steps: u32| {
                let (masses, found) = stepped(hot, start, time, steps);
                assert_relative_eq!(
                    masses.frozen + masses.molten,
                    start.frozen + start.molten,
                    epsilon = 1e-12
                );
                (0..3).map(|i| (found[i] / expected[i] - 1.0).abs()).fold(0.0, f64::max)
            };
            let [coarse, fine] = [error(50), error(500)];
            assert!(coarse < 2e-2 && fine < 2e-3 && fine < 0.2 * coarse, "{coarse} {fine}");
        }
    }

    /// After a long time nothing moves: the front lies where both fluxes are equal, by halving of the
    /// balance; with and without a heat of fusion, from above and from below.
    #[test]
    fn a_front_comes_to_rest_at_the_balance() {
        let balance = halved(
            |frozen| {
                let [from_gas, to_coolant] = fluxes(&FURNACE, slag(frozen, 20.0 - frozen));
                to_coolant - from_gas
            },
            0.0,
            20.0,
        );
        assert!(balance > 1.0 && balance < 19.0, "{balance}");
        for start in [slag(19.0, 1.0), slag(0.0, 20.0), slag(20.0, 0.0)] {
            let (masses, _) = stepped(FURNACE, start, 1e6, 40);
            assert_relative_eq!(masses.frozen, balance, max_relative = 1e-9);
            let at_once = ThermalLayers { heat_of_fusion: 0.0, ..LAYERS }.after(&start, 1e-3).unwrap();
            assert_relative_eq!(at_once.masses.frozen, balance, max_relative = 1e-9);
            assert_relative_eq!(at_once.from_gas, at_once.to_coolant, max_relative = 1e-9);
        }
    }

    /// All melts or all freezes before the step ends: the latent heat is that of what there was, and the
    /// rest of the step is steady.
    #[test]
    fn a_front_that_reaches_its_end_leaves_a_steady_rest() {
        let insulated = ThermalLayers { coolant: Coolant { coefficient: 1.0, ..LAYERS.coolant }, ..LAYERS };
        let step = insulated.after(&slag(0.5, 0.5), 3600.0).unwrap();
        assert_eq!((step.masses.frozen, step.masses.molten, step.melted), (0.0, 1.0, 0.5));
        assert_relative_eq!(step.from_gas - step.to_coolant, 1.5e5, max_relative = 1e-9);
        let cold = ThermalLayers { hot: COLD, ..LAYERS };
        let step = cold.after(&slag(0.5, 0.5), 3600.0).unwrap();
        assert_eq!((step.masses.frozen, step.masses.molten, step.melted), (1.0, 0.0, -0.5));
        assert_relative_eq!(step.to_coolant - step.from_gas, 1.5e5, max_relative = 1e-9);
        // The melting front goes on through powder that the slag has enclosed.
        let enclosed = Layers { inner_powder: 0.3, frozen: 0.1, molten: 0.5, outer_powder: 0.0 };
        let step = insulated.after(&enclosed, 3600.0).unwrap();
        assert_relative_eq!(step.masses.molten, 0.9, max_relative = 1e-15);
        assert_eq!((step.masses.inner_powder, step.masses.frozen), (0.0, 0.0));
    }

    /// Powder whose outside is hotter than it melts, on frozen slag: a skin melts and the cold rest
    /// stays powder, below it; cooled again, the skin freezes.
    #[test]
    fn powder_melts_from_outside_and_the_cold_rest_stays_powder() {
        let powder = Layers { frozen: 1.0, outer_powder: 1.5, ..Layers::default() };
        let before = LAYERS.flow(&powder).unwrap();
        assert!(before.surface() > 1400.0 && before.sides.outer_powder[0] < 1300.0);
        let step = LAYERS.after(&powder, 1.0).unwrap();
        let Layers { inner_powder, frozen, molten, outer_powder } = step.masses;
        assert!(molten > 0.01 && molten < 1.0 && inner_powder == 1.5 && outer_powder == 0.0, "{step:?}");
        assert_relative_eq!(inner_powder + frozen + molten, 2.5, max_relative = 1e-14);
        let after = LAYERS.flow(&step.masses).unwrap();
        assert!(after.sides.inner_powder[0] > 600.0 && after.sides.molten[0] == 1400.0);
        let cooled = ThermalLayers { hot: COLD, ..LAYERS }.after(&step.masses, 600.0).unwrap();
        assert_eq!(cooled.masses.molten, 0.0);
        // Powder that does not melt stays where it is.
        let char = ThermalLayers { powder_melts_at: f64::INFINITY, ..LAYERS };
        let dry = Layers { outer_powder: 1.5, ..Layers::default() };
        assert_eq!(char.after(&dry, 600.0).unwrap().masses, dry);
    }

    /// Powder from 580 to 1300 K under melt whose surface has 1438 K, heated with 125 kW/m²: the
    /// resistances of both follow, by hand. Arriving melt buries the powder and a minute passes; all of
    /// it stays powder. As melt, of half its resistance, it would let 184 kW/m² pass at 1328 K.
    #[test]
    fn cold_powder_under_a_hot_surface_stays_powder() {
        let gas = (184e3 - 125e3) / (1438.0 - 1328.0);
        let hot = HotSide {
            gas_temperature: 1438.0 + 125e3 / gas,
            coefficient: gas,
            emissivity: 0.0,
            irradiation: 0.0,
            particle_flux: 0.0,
        };
        let [powder, melt, wall] = [720.0 / 125e3, 138.0 / 125e3, 30.0 / 125e3];
        let layers = ThermalLayers {
            coolant: Coolant { temperature: 550.0, coefficient: f64::INFINITY },
            wall_resistance: wall,
            hot,
            resistance_per_mass: Layers {
                inner_powder: powder / 1.5,
                frozen: melt,
                molten: melt,
                outer_powder: powder / 1.5,
            },
            slag_melts_at: Some(1300.0),
            powder_melts_at: 1300.0,
            heat_of_fusion: 3e5,
        };
        let buried = Deposit { powder: 1.5, solid: 6e-4, cover: 9.0, ..Deposit::default() };
        let buried = buried.with(&DepositSource { molten: 1.0, buried: 400.0, ..DepositSource::default() });
        let after = buried.with_layers(layers.after(&buried.layers(), 60.0).unwrap().masses);
        assert_relative_eq!(after.layers().inner_powder, 1.5, max_relative = 1e-9);
        assert_relative_eq!(after.molten, 1.0, max_relative = 1e-9);
        let flow = layers.flow(&after.layers()).unwrap();
        assert_relative_eq!(flow.from_gas, 125e3, max_relative = 1e-9);
        assert_relative_eq!(flow.surface(), 1438.0, max_relative = 1e-9);
        assert_relative_eq!(flow.wall(), 580.0, max_relative = 1e-9);
        let all_melt = (1328.0 - 550.0) / 184e3 - wall - melt;
        let molten = ThermalLayers { slag_melts_at: None, ..layers };
        let flow = molten.flow(&slag(0.0, 1.0 + all_melt / melt)).unwrap();
        assert_relative_eq!(flow.from_gas, 184e3, max_relative = 1e-9);
    }

    /// A layer next to nothing, and one of no thickness, have the flux of the gas.
    #[test]
    fn thin_layers_have_the_flux_of_the_gas() {
        for molten in [6e-318, 1e-302, 1e-35, 1e-12] {
            let flow = LAYERS.flow(&slag(20.0, molten)).unwrap();
            assert_relative_eq!(flow.from_gas, FURNACE.heat_flux(1400.0), max_relative = 1e-6);
        }
        let held = HotSide { coefficient: f64::INFINITY, ..FURNACE };
        assert!(ThermalLayers { hot: held, ..LAYERS }.after(&slag(1.0, 1.0), 1.0).is_err());
    }
}
