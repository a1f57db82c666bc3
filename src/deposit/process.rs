//! What a process that changes a deposit is, and what it is given.

use std::fmt::Debug;
use std::sync::Arc;

use super::Deposit;
use super::conduction::{Coolant, HotSide};
use super::front::{FrontStep, HeatFlow};
use crate::impact::ImpactError;
use crate::input::{InputError, Section};

/// What surrounds a piece of wall with a deposit during a time step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Surroundings {
    /// Share of voids in fresh powder [1].
    pub voidage: f64,
    /// Cooling and heating of the wall. Without it powder neither melts nor sinters.
    pub cooling: Option<WallCooling>,
    /// Temperature [K] of a wall that is not cooled: its slag is liquid or solid by it. `None` where it
    /// is not known: slag stays as it is.
    pub wall_temperature: Option<f64>,
    /// The gas at the wall.
    pub gas: WallGas,
    /// Gravity outward from the wall [m/s²], negative where it presses the deposit on.
    pub gravity_outward: f64,
    /// Gravity along the wall [m/s²], not negative.
    pub gravity_along: f64,
    /// Rank of this piece of wall [1] from the weakest, 0, to below 1, the strongest. A piece keeps its
    /// rank, so that results do not depend on the length of time steps.
    pub draw: f64,
}

/// A cooled wall, and what heats it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallCooling {
    /// What cools it from behind.
    pub coolant: Coolant,
    /// Thickness of the wall over its conductivity [m² K/W].
    pub wall_resistance: f64,
    /// What heats its surface.
    pub hot: HotSide,
    /// The gas in the voids of the powder.
    pub void_gas: VoidGas,
    /// The vapour that may condense.
    pub vapour: VapourSide,
}

/// The gas at a surface on which vapour may condense; what is `None` is that of the gas or of the model file.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct VapourSide {
    /// Heat transfer coefficient [W/(m² K)].
    pub coefficient: Option<f64>,
    /// Mass fraction of the vapour [1].
    pub fraction: Option<f64>,
}

impl WallCooling {
    /// The gas as vapour sees it.
    pub fn vapour_side(&self) -> VapourSide {
        let coefficient = self.vapour.coefficient.unwrap_or(self.hot.coefficient);
        VapourSide { coefficient: Some(coefficient), ..self.vapour }
    }
}

/// Conductivity of the gas in the voids of powder: `k (T/T_0)^n` at the powder's own temperature, the
/// one law of it in every program.
///
/// `k` is that of the gas at the wall, at the gas's own temperature `T_0`. [`VoidGas::through`] takes
/// `n` from the same gas at another temperature. Kinetic theory has `n` = 0.5 for rigid molecules and
/// more for real ones; a lower one is a number that stands for one temperature, such as a constant
/// viscosity in a flow solver, and says nothing of others. Air has `n` = 0.8 within 5 % from 300 to
/// 1500 K (0.0263, 0.0667 and 0.100 W/(m K) at 300, 1000 and 1500 K; Incropera et al., table A.4, from
/// memory).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VoidGas {
    /// Conductivity at `temperature`, `k` [W/(m K)].
    pub conductivity: f64,
    /// Temperature `T_0` [K].
    pub temperature: f64,
    /// Exponent `n` [1].
    pub exponent: f64,
}

impl VoidGas {
    /// Exponent of air [1].
    pub const AIR: f64 = 0.8;
    /// Least exponent of a gas [1], that of rigid molecules, and one that no gas reaches: steam has 1.4.
    const OF_GASES: [f64; 2] = [0.5, 2.0];
    /// Least logarithm of the ratio of two temperatures [1] that tells an exponent.
    const APART: f64 = 0.01;

    /// Through the temperature [K] and the conductivity [W/(m K)] of a gas, and the same of it at
    /// another temperature. Where there is no such point, or too near, or one that no gas has, the
    /// exponent is that of air.
    pub fn through([temperature, conductivity]: [f64; 2], other: Option<[f64; 2]>) -> Self {
        let exponent = other.and_then(|[at, there]| {
            let apart = (at / temperature).ln();
            let exponent = (there / conductivity).ln() / apart;
            let [least, most] = Self::OF_GASES;
            (apart.abs() > Self::APART && (least..=most).contains(&exponent)).then_some(exponent)
        });
        Self { conductivity, temperature, exponent: exponent.unwrap_or(Self::AIR) }
    }

    /// The conductivity at a temperature [W/(m K)].
    pub fn at(&self, temperature: f64) -> f64 {
        self.conductivity * (temperature / self.temperature).powf(self.exponent)
    }
}

/// The gas at a wall. Without shear stress the other numbers do not matter.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WallGas {
    /// Density [kg/m³].
    pub density: f64,
    /// Kinematic viscosity `nu` [m²/s].
    pub kinematic_viscosity: f64,
    /// Shear stress [Pa] down the slope and across it.
    pub shear: [f64; 2],
}

impl WallGas {
    /// Friction velocity `u*` [m/s], the root of shear stress over density.
    pub fn friction_velocity(&self) -> f64 {
        let [down, across] = self.shear;
        (down.hypot(across) / self.density).sqrt()
    }

    /// Whether the gas neither shears the wall nor carries anything away.
    pub fn is_calm(&self) -> bool {
        self.shear == [0.0; 2]
    }
}

impl Surroundings {
    /// Refuses surroundings without physical meaning.
    ///
    /// # Errors
    /// [`ImpactError::Unusable`] naming the number.
    pub fn check(&self) -> Result<(), ImpactError> {
        let Self { voidage, wall_temperature, gas, gravity_outward, gravity_along, draw, .. } = *self;
        let positive = |value: f64| value.is_finite() && value > 0.0;
        let calm = gas.is_calm();
        let surface = wall_temperature.unwrap_or(1.0);
        let share = "must be at least 0 and below 1";
        let above = "must be positive and finite";
        let rules = [
            ("voidage", voidage, (0.0..1.0).contains(&voidage), share),
            ("wall temperature", surface, positive(surface), above),
            ("shear of the gas", gas.shear[0], gas.shear[0].is_finite(), "must be finite"),
            ("shear of the gas", gas.shear[1], gas.shear[1].is_finite(), "must be finite"),
            ("density of the gas", gas.density, calm || positive(gas.density), above),
            (
                "kinematic viscosity of the gas",
                gas.kinematic_viscosity,
                calm || positive(gas.kinematic_viscosity),
                above,
            ),
            ("gravity outward", gravity_outward, gravity_outward.is_finite(), "must be finite"),
            (
                "gravity along the wall",
                gravity_along,
                gravity_along.is_finite() && gravity_along >= 0.0,
                "must be finite and not negative",
            ),
            ("draw", draw, (0.0..1.0).contains(&draw), share),
        ];
        match rules.into_iter().find(|(_, _, sound, _)| !sound) {
            Some((quantity, value, _, reason)) => {
                Err(ImpactError::Unusable { quantity: quantity.into(), value, reason })
            }
            None => Ok(()),
        }
    }
}

/// What processes ask of the powder's material.
pub trait PowderMaterial {
    /// Viscosity [Pa s] and surface tension [N/m] with which grains sinter at a temperature [K]; `None`
    /// where the model does not know both.
    fn sintering(&self, temperature: f64) -> Option<[f64; 2]>;
}

/// What heat does to a deposit in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DepositHeat {
    /// Nothing is known.
    Unknown,
    /// All of it has the temperature of its wall, at which its slag is liquid or not.
    Isothermal {
        /// Whether slag is liquid; `None` where that is not known.
        liquid: Option<bool>,
    },
    /// On a cooled wall.
    Cooled {
        /// At the start of the step.
        flow: HeatFlow,
        /// Over the step.
        front: FrontStep,
        /// What processes released at the surface [J/m²].
        released: f64,
        /// Thermal resistance at the start of the step [m² K/W].
        resistance: f64,
    },
}

impl DepositHeat {
    /// The heat that crossed the deposit.
    pub(crate) fn crossed(&self) -> StepHeat {
        match *self {
            Self::Cooled { front, released, resistance, .. } => StepHeat {
                from_gas: front.from_gas - released,
                released,
                to_coolant: front.to_coolant,
                fusion: front.fusion,
                deposit_resistance: resistance,
            },
            _ => StepHeat::default(),
        }
    }
}

/// Heat that crossed the deposit on a cooled wall in a step: `from_gas + released = to_coolant + fusion`. Zeros on
/// a wall that is not cooled.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StepHeat {
    /// What the surface took from gas, radiation and particles [J/m²].
    pub from_gas: f64,
    /// What processes released at the surface, such as condensation [J/m²].
    pub released: f64,
    /// What went into the coolant [J/m²].
    pub to_coolant: f64,
    /// What melting took, negative where slag froze [J/m²].
    pub fusion: f64,
    /// Thermal resistance of the deposit at the start of the step [m² K/W].
    pub deposit_resistance: f64,
}

/// A time step of a deposit.
pub struct Step<'a> {
    /// The powder's material.
    pub powder: &'a dyn PowderMaterial,
    /// What surrounds the wall.
    pub surroundings: &'a Surroundings,
    /// What heat does.
    pub heat: DepositHeat,
    /// Length of the step [s].
    pub duration: f64,
}

impl Step<'_> {
    /// The gas as vapour sees it, and the temperature of the surface [K] at the start of the step; `None` where that is
    /// not known.
    pub fn surface(&self) -> Option<(VapourSide, f64)> {
        match (&self.surroundings.cooling, &self.heat) {
            (Some(cooling), DepositHeat::Cooled { flow, .. }) => {
                Some((cooling.vapour_side(), flow.surface()))
            }
            (None, _) => {
                let temperature = self.surroundings.wall_temperature;
                temperature.map(|temperature| (VapourSide::default(), temperature))
            }
            _ => None,
        }
    }
}

/// A process with the numbers of one wall.
pub trait Process: Debug + Send + Sync {
    /// The deposit after a time step.
    fn after(&self, deposit: &Deposit, step: &Step<'_>) -> Deposit;

    /// Heat flux [W/m²] that it releases at a surface of a temperature [K]; the heat balance of a cooled wall has it.
    fn heat_flux(&self, _gas: &VapourSide, _surface: f64) -> f64 {
        0.0
    }

    /// Its numbers in words, for `nearwall check`; empty where the model file gives none.
    fn describe(&self) -> String {
        String::new()
    }
}

/// A process with the numbers of a wall; `None` where it does not act there.
pub type WallProcess = Option<Arc<dyn Process>>;

/// Name of a process and how it is read.
#[derive(Debug)]
pub struct ProcessInfo {
    /// Its name, and that of its table `[walls.NAME.<process>]` in the model file, if it has a table.
    pub name: &'static str,
    /// How tables name the mass that it takes from the wall; `None` for a process that takes none.
    pub loss: Option<&'static str>,
    /// How tables name the mass that it brings to the wall; `None` for a process that brings none.
    pub gain: Option<&'static str>,
    /// Reads the process from the table of a wall.
    pub read: fn(&Section<'_>) -> Result<WallProcess, InputError>,
}

/// Reads the table of a process in that of a wall, and refuses its unknown keys.
pub(super) fn own_table<T: Process + 'static>(
    wall: &Section<'_>,
    name: &str,
    read: fn(&Section<'_>) -> Result<T, InputError>,
) -> Result<WallProcess, InputError> {
    let Some(table) = wall.section(name)? else { return Ok(None) };
    let process = read(&table)?;
    table.finish()?;
    Ok(Some(Arc::new(process)))
}

#[cfg(test)]
mod tests {
    use super::VoidGas;
    use approx::assert_relative_eq;

    /// Air of 300 and 1000 K (Incropera, table A.4): in between within 5 % of the table, at 1500 K 9 % low. A
    /// constant, an exponent that no gas has and temperatures side by side tell nothing of the slope.
    #[test]
    fn the_gas_in_the_voids_goes_through_both_points() {
        let air = VoidGas::through([1000.0, 0.0667], Some([300.0, 0.0263]));
        assert_relative_eq!(air.at(300.0), 0.0263, max_relative = 1e-12);
        for (temperature, table, error) in
            [(500.0, 0.0407, 0.05), (700.0, 0.0524, 0.05), (1500.0, 0.100, 0.1)]
        {
            assert_relative_eq!(air.at(temperature), table, max_relative = error);
        }
        let alone = VoidGas::through([1000.0, 0.0667], None);
        assert_relative_eq!(alone.at(500.0), 0.0667 * 0.5_f64.powf(0.8), max_relative = 1e-12);
        for other in [[500.0, 0.0667], [500.0, 0.0667 * (1.0 + 1e-9)], [500.0, 0.01], [999.0, 0.0666]] {
            assert_eq!(VoidGas::through([1000.0, 0.0667], Some(other)), alone, "{other:?}");
        }
    }
}

/// Helpers for the tests of processes.
#[cfg(test)]
pub(super) mod testing {
    use super::{DepositHeat, PowderMaterial, Step, Surroundings};

    /// Powder that does not sinter.
    pub struct Stiff;

    /// A step [s] of such powder without heat.
    pub fn step(surroundings: &Surroundings, duration: f64) -> Step<'_> {
        Step { powder: &Stiff, surroundings, heat: DepositHeat::Unknown, duration }
    }

    impl PowderMaterial for Stiff {
        fn sintering(&self, _temperature: f64) -> Option<[f64; 2]> {
            None
        }
    }
}
