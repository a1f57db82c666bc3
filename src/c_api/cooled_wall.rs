//! Temperatures of a wall under its deposit.
#![allow(non_camel_case_types)]

use super::boundary::{guarded_status, initialise, reader, sized};
use super::deposit::nw_deposit;
use super::impact::nw_impact;
use super::types::{
    NW_BAD_STATE, NW_NO_HEAT_CAPACITY, NW_NULL_POINTER, NW_UNKNOWN_WALL, nw_model, nw_status, zero_by_default,
};
use crate::deposit::conduction::{Coolant, HotSide};
use crate::deposit::{VapourSide, VoidGas};
use crate::model::{WallCooling, WallHeat};

/// What cools and heats a wall. Fill it with `nw_wall_cooling_init`, then set what there is.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct nw_wall_cooling {
    /// `sizeof(nw_wall_cooling)`.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// Temperature of the coolant behind the wall [K], positive.
    pub coolant_temperature: f64,
    /// Heat transfer coefficient of the coolant [W/(m2 K)]; infinite where the back of the wall has its temperature.
    pub coolant_coefficient: f64,
    /// Thickness of the wall over its conductivity [m2 K/W], not negative.
    pub wall_resistance: f64,
    /// Temperature of the gas [K], positive.
    pub gas_temperature: f64,
    /// Heat transfer coefficient of the gas [W/(m2 K)], not negative: in a flow solver the
    /// conductivity of the gas over the distance between wall and cell. Infinite where the
    /// temperature of the surface is known: it is `gas_temperature`.
    pub gas_coefficient: f64,
    /// Emissivity of the surface [1], 0 to 1.
    pub emissivity: f64,
    /// Irradiation of the surface [W/m2], not negative: 5.670374419e-8 T^4 of surroundings of one temperature.
    pub irradiation: f64,
    /// Further heat flux into the surface [W/m2], of particles or the net one of a radiation model.
    pub further_flux: f64,
    /// Conductivity of the gas at the wall [W/(m K)] at its own temperature `void_temperature`, positive.
    /// In the voids of the powder it changes with the powder's temperature by a power, see `other_conductivity`.
    pub gas_conductivity: f64,
    /// Temperature [K] for which `gas_conductivity` is given, positive.
    pub void_temperature: f64,
    /// Conductivity of the same gas [W/(m K)] at another temperature, such as that of the surface: it tells
    /// the power. 0 where it is not known; then, and where no gas has such a power, it is the 0.8 of air.
    pub other_conductivity: f64,
    /// Temperature [K] for which `other_conductivity` is given; 0 where there is none.
    pub other_temperature: f64,
    /// Mass fraction of the vapour of the table `condensation` in the gas [1], 0 to 0.5; below 0 where it is that of
    /// the model file.
    pub vapour_fraction: f64,
    /// Heat transfer coefficient of the gas that carries the vapour [W/(m2 K)], where `gas_coefficient` has more than
    /// that gas in it, such as what lands; 0 where it is `gas_coefficient`.
    pub vapour_coefficient: f64,
}

/// Temperatures of a wall with a deposit.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct nw_wall_heat {
    /// `sizeof(nw_wall_heat)`.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// Temperature of the surface that impacts meet [K].
    pub surface_temperature: f64,
    /// Temperature of the wall under the deposit [K].
    pub wall_temperature: f64,
    /// Heat flux from the gas into the surface [W/m2].
    pub heat_flux: f64,
    /// Heat flux into the coolant [W/m2]: `heat_flux` unless slag melts or freezes.
    pub coolant_flux: f64,
    /// Thermal resistance of the deposit [m2 K/W].
    pub deposit_resistance: f64,
    /// Change of temperature [K] in the last round of the solver: above 1e-9 where conductivities and
    /// temperatures did not come to agree.
    pub disagreement: f64,
    /// Temperature of what holds it behind the surface [K]: the coolant, or slag that melts or freezes.
    pub behind_temperature: f64,
    /// Thermal resistance between there and the surface [m2 K/W]: the surface gives the difference of both
    /// temperatures over it.
    pub behind_resistance: f64,
}

zero_by_default!(nw_wall_heat);

impl Default for nw_wall_cooling {
    /// An ideal coolant, air at room temperature in the voids, and zeros.
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved: 0,
            coolant_temperature: 0.0,
            coolant_coefficient: f64::INFINITY,
            wall_resistance: 0.0,
            gas_temperature: 0.0,
            gas_coefficient: 0.0,
            emissivity: 0.0,
            irradiation: 0.0,
            further_flux: 0.0,
            gas_conductivity: 0.026,
            void_temperature: 293.15,
            other_conductivity: 0.0,
            other_temperature: 0.0,
            vapour_fraction: -1.0,
            vapour_coefficient: 0.0,
        }
    }
}

impl nw_wall_cooling {
    /// Refuses temperatures and a gas that are no numbers, before the model takes a property there.
    pub(super) fn sound(self) -> Result<Self, nw_status> {
        let given =
            [self.coolant_temperature, self.gas_temperature, self.gas_conductivity, self.void_temperature];
        let other = [self.other_conductivity, self.other_temperature];
        let sound =
            given.into_iter().all(is_positive) && (other == [0.0; 2] || other.into_iter().all(is_positive));
        let carried = self.vapour_coefficient;
        let sound = sound && self.vapour_fraction <= 0.5 && (carried == 0.0 || is_positive(carried));
        if sound { Ok(self) } else { Err(NW_BAD_STATE) }
    }

    pub(super) fn to_cooling(self) -> WallCooling {
        WallCooling {
            coolant: Coolant { temperature: self.coolant_temperature, coefficient: self.coolant_coefficient },
            wall_resistance: self.wall_resistance,
            hot: HotSide {
                gas_temperature: self.gas_temperature,
                coefficient: self.gas_coefficient,
                emissivity: self.emissivity,
                irradiation: self.irradiation,
                particle_flux: self.further_flux,
            },
            void_gas: VoidGas::through(
                [self.void_temperature, self.gas_conductivity],
                (self.other_temperature > 0.0).then_some([self.other_temperature, self.other_conductivity]),
            ),
            vapour: VapourSide {
                coefficient: (self.vapour_coefficient > 0.0).then_some(self.vapour_coefficient),
                fraction: (self.vapour_fraction >= 0.0).then_some(self.vapour_fraction),
            },
        }
    }
}

impl nw_wall_heat {
    fn with(self, heat: &WallHeat) -> Self {
        let WallHeat { surface_temperature, wall_temperature, heat_flux, coolant_flux, .. } = *heat;
        let WallHeat {
            deposit_resistance,
            disagreement,
            behind: [behind_temperature, behind_resistance],
            ..
        } = *heat;
        Self {
            surface_temperature,
            wall_temperature,
            heat_flux,
            coolant_flux,
            deposit_resistance,
            disagreement,
            behind_temperature,
            behind_resistance,
            ..self
        }
    }
}

fn is_positive(number: f64) -> bool {
    number.is_finite() && number > 0.0
}

/// Initialises what cools and heats a wall: its size, an infinite `coolant_coefficient`, 0.026 W/(m
/// K) at 293.15 K for the gas in the voids (air), the vapour of the model file, zeros. The temperatures of coolant
/// and gas must be set.
///
/// # Safety
/// `cooling` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_wall_cooling_init(cooling: *mut nw_wall_cooling) -> nw_status {
    // SAFETY: the caller's promise.
    unsafe { initialise(cooling) }
}

/// Initialises the temperatures of a wall for `nw_deposit_heat`: their size and zeros.
///
/// # Safety
/// `heat` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_wall_heat_init(heat: *mut nw_wall_heat) -> nw_status {
    // SAFETY: the caller's promise.
    unsafe { initialise(heat) }
}

/// Computes the temperatures of a wall under its deposit: steady, but for slag that melts or freezes
/// and takes heat or gives it. `voidage` is the share of voids in
/// fresh powder [1]. The surface temperature is the `T_w` of the next impact. `NW_NO_CONDUCTIVITY`
/// if a layer's material has none.
///
/// # Safety
/// `model` is a loaded model; `deposit`, `cooling` and `heat` begin with their `struct_size`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_deposit_heat(
    model: *const nw_model,
    deposit: *const nw_deposit,
    voidage: f64,
    cooling: *const nw_wall_cooling,
    heat: *mut nw_wall_heat,
) -> nw_status {
    let conduct = || {
        // SAFETY: the caller's promises.
        let (model, deposit, cooling, before) =
            unsafe { (reader(model)?, sized(deposit)?, sized(cooling)?, sized(heat.cast_const())?) };
        let cooling = cooling.sound()?.to_cooling();
        let (wall, deposit) = (deposit.wall as usize, deposit.sound()?.to_deposit());
        let after = before.with(&model.inner().wall_heat(wall, &deposit, voidage, &cooling)?);
        // As `nw_deposit_advance` accepts them: an infinite resistance leaves no temperature below it.
        let found = [after.surface_temperature, after.wall_temperature];
        let others =
            [after.heat_flux, after.coolant_flux, after.deposit_resistance, after.behind_temperature];
        let others = others.into_iter().all(f64::is_finite);
        if !(found.into_iter().all(is_positive) && others) {
            return Err(NW_BAD_STATE);
        }
        // SAFETY: checked just above.
        unsafe { heat.write_unaligned(after) };
        Ok(())
    };
    guarded_status(conduct)
}

/// Computes the heat [J] that one particle of this impact gives to the wall while it touches it and rebounds; negative
/// for a colder particle. 0 where the model file does not ask for it (`contact_heat` of a wall), for a droplet, and on
/// melt. The particle's temperature falls by the heat over mass and heat capacity.
///
/// # Safety
/// `model` is a loaded model; `impact` begins with its `struct_size`; `heat` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_contact_heat(
    model: *const nw_model,
    impact: *const nw_impact,
    heat: *mut f64,
) -> nw_status {
    let touch = || {
        // SAFETY: the caller's promises.
        let (model, impact) = unsafe { (reader(model)?, sized(impact)?) };
        if heat.is_null() {
            return Err(NW_NULL_POINTER);
        }
        let found = model.inner().contact_heat(impact.wall as usize, &impact.to_impact())?;
        if !found.is_finite() {
            return Err(NW_BAD_STATE);
        }
        // SAFETY: not null, and writable by the caller's promise.
        unsafe { heat.write_unaligned(found) };
        Ok(())
    };
    guarded_status(touch)
}

/// Computes the heat [J/kg] that a captured particle of this impact brings to the surface that it lands on: sensible
/// heat down to the temperature of that surface, and the heat of fusion where it was liquid and lands as a solid; less
/// that heat where it was solid and lands as melt. What lies on a wall has the temperature of the wall, so that this is
/// all that it brings. `heat_capacity` [J/(kg K)] is that of the particle, or 0 for that of the model's material;
/// `NW_NO_HEAT_CAPACITY` if that has none. The sum over what lands in a step, over area and duration, is a
/// `further_flux`.
///
/// # Safety
/// `model` is a loaded model; `impact` begins with its `struct_size`; `heat` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_heat_brought(
    model: *const nw_model,
    impact: *const nw_impact,
    heat_capacity: f64,
    heat: *mut f64,
) -> nw_status {
    let bring = || {
        // SAFETY: the caller's promises.
        let (model, impact) = unsafe { (reader(model)?, sized(impact)?) };
        if heat.is_null() {
            return Err(NW_NULL_POINTER);
        }
        if impact.wall as usize >= model.inner().walls().len() {
            return Err(NW_UNKNOWN_WALL);
        }
        let impact = impact.to_impact();
        let temperatures = [impact.particle_temperature, impact.wall_temperature];
        let is_sound = temperatures.into_iter().all(is_positive) && (0.0..=1.0).contains(&impact.conversion);
        if !is_sound || !heat_capacity.is_finite() || heat_capacity < 0.0 {
            return Err(NW_BAD_STATE);
        }
        let given = (heat_capacity > 0.0).then_some(heat_capacity);
        let found = model.inner().heat_brought(&impact, given).ok_or(NW_NO_HEAT_CAPACITY)?;
        if !found.is_finite() {
            return Err(NW_BAD_STATE);
        }
        // SAFETY: not null, and writable by the caller's promise.
        unsafe { heat.write_unaligned(found) };
        Ok(())
    };
    guarded_status(bring)
}
