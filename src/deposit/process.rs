//! What a process that changes a deposit is, and what it is given.

use std::fmt::Debug;
use std::sync::Arc;

use super::Deposit;
use crate::impact::ImpactError;
use crate::input::{InputError, Section};

/// What surrounds a piece of wall with a deposit during a time step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Surroundings {
    /// Share of voids in fresh powder [1].
    pub voidage: f64,
    /// Temperatures [K] of the cold and the hot side of the powder, of
    /// [`WallHeat`](crate::model::WallHeat); `None` where they are not known: nothing melts or sinters.
    pub powder_sides: Option<[f64; 2]>,
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
        let Self { voidage, powder_sides, gas, gravity_outward, gravity_along, draw } = *self;
        let positive = |value: f64| value.is_finite() && value > 0.0;
        let calm = gas.is_calm();
        let [cold, hot] = powder_sides.unwrap_or([1.0; 2]);
        let share = "must be at least 0 and below 1";
        let above = "must be positive and finite";
        let rules = [
            ("voidage", voidage, (0.0..1.0).contains(&voidage), share),
            ("wall temperature", cold, positive(cold), above),
            ("powder temperature", hot, positive(hot), above),
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
    /// Whether powder of a carbon conversion [1] melts at a temperature [K].
    fn melts(&self, conversion: f64, temperature: f64) -> bool;

    /// Viscosity [Pa s] and surface tension [N/m] with which grains sinter at a temperature [K]; `None`
    /// where the model does not know both.
    fn sintering(&self, temperature: f64) -> Option<[f64; 2]>;
}

/// A process with the numbers of one wall.
pub trait Process: Debug + Send + Sync {
    /// The deposit after a time step [s].
    fn after(
        &self,
        deposit: &Deposit,
        powder: &dyn PowderMaterial,
        surroundings: &Surroundings,
        duration: f64,
    ) -> Deposit;

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
    /// How tables name the mass that it takes from the wall; `None` for a process that conserves mass.
    pub loss: Option<&'static str>,
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

/// Helpers for the tests of processes.
#[cfg(test)]
pub(super) mod testing {
    use super::PowderMaterial;

    /// Powder that neither melts nor sinters.
    pub struct Stiff;

    impl PowderMaterial for Stiff {
        fn melts(&self, _conversion: f64, _temperature: f64) -> bool {
            false
        }

        fn sintering(&self, _temperature: f64) -> Option<[f64; 2]> {
            None
        }
    }
}
