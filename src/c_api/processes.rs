//! One time step of a deposit, and the processes that act in it.
#![allow(non_camel_case_types)]

use std::ffi::{CString, c_char};
use std::sync::LazyLock;

use super::boundary::{guarded_status, initialise, reader, sized};
use super::cooled_wall::nw_wall_cooling;
use super::deposit::nw_deposit;
use super::types::{NW_BAD_STATE, NW_NULL_POINTER, NW_UNKNOWN_WALL, nw_model, nw_status, zero_by_default};
use crate::deposit::{PROCESS_COUNT, PROCESSES, Surroundings, WallCooling, WallGas};

/// Number of processes that change a deposit.
pub const NW_PROCESSES: usize = 5;

const _: () = assert!(NW_PROCESSES == PROCESS_COUNT);

/// What surrounds a piece of wall with a deposit. Fill it with `nw_deposit_surroundings_init`, then set what there is.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct nw_deposit_surroundings {
    /// `sizeof(nw_deposit_surroundings)`.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// Share of voids in fresh powder [1].
    pub voidage: f64,
    /// Temperature of a wall that is not cooled [K]: its slag is liquid or frozen by it. 0 where it is
    /// not known, and slag stays as it is.
    pub wall_temperature: f64,
    /// Density of the gas at the wall [kg/m3]; needed where it shears the wall.
    pub gas_density: f64,
    /// Its kinematic viscosity [m2/s]; needed where it shears the wall.
    pub kinematic_viscosity: f64,
    /// Shear stress of the gas down the slope of the wall [Pa].
    pub shear_down: f64,
    /// Shear stress of the gas across the slope [Pa].
    pub shear_across: f64,
    /// Component of gravity away from the wall [m/s2], negative where it presses the deposit on.
    pub gravity_outward: f64,
    /// Component of gravity along the wall [m/s2], not negative.
    pub gravity_along: f64,
    /// Rank of this piece of wall from the weakest, 0, to below 1, the strongest [1]; a piece keeps its rank.
    pub draw: f64,
}

/// Mass that a deposit lost in a time step, and the heat that crossed it.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct nw_deposit_losses {
    /// `sizeof(nw_deposit_losses)`.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// Mass by process [kg/m2]; `nw_process_loss` names the entries. Negative for a process that brings mass, which
    /// `nw_process_gain` names; 0 for one that conserves mass.
    pub mass: [f64; NW_PROCESSES],
    /// Heat that the surface of a cooled wall took from gas, radiation and `further_flux` [J/m2]: the sum
    /// of the next two less `heat_released`. 0, as they are, on a wall that is not cooled.
    pub heat_taken: f64,
    /// Heat that went into the coolant [J/m2].
    pub heat_to_coolant: f64,
    /// Heat that melting took [J/m2], negative where slag froze.
    pub heat_of_fusion: f64,
    /// Heat that processes released at the surface, such as condensation [J/m2].
    pub heat_released: f64,
    /// Thermal resistance of the deposit on a cooled wall at the start of the step [m2 K/W].
    pub deposit_resistance: f64,
}

zero_by_default!(nw_deposit_surroundings, nw_deposit_losses);

impl nw_deposit_surroundings {
    fn to_surroundings(self, cooling: Option<WallCooling>) -> Surroundings {
        Surroundings {
            voidage: self.voidage,
            cooling,
            wall_temperature: (self.wall_temperature != 0.0).then_some(self.wall_temperature),
            gas: WallGas {
                density: self.gas_density,
                kinematic_viscosity: self.kinematic_viscosity,
                shear: [self.shear_down, self.shear_across],
            },
            gravity_outward: self.gravity_outward,
            gravity_along: self.gravity_along,
            draw: self.draw,
        }
    }
}

/// Initialises surroundings: their size and zeros, so that nothing is known but that the gas is calm.
///
/// # Safety
/// `surroundings` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_deposit_surroundings_init(
    surroundings: *mut nw_deposit_surroundings,
) -> nw_status {
    // SAFETY: the caller's promise.
    unsafe { initialise(surroundings) }
}

/// Initialises losses for `nw_deposit_advance`: their size and zeros.
///
/// # Safety
/// `losses` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_deposit_losses_init(losses: *mut nw_deposit_losses) -> nw_status {
    // SAFETY: the caller's promise.
    unsafe { initialise(losses) }
}

/// Advances a deposit by a time step of a `duration` [s]: slag and powder melt and freeze with the heat
/// that comes and goes, powder sinters; the gas carries loose powder away (table `resuspension` of the
/// wall in the model file); what the wall cannot hold falls off (table `shedding`); vapour condenses on
/// a surface of a known temperature (table `condensation`). `losses`
/// receives the mass that each process took and the heat that crossed the deposit. Add the particles captured in the
/// step first, with `nw_deposit_add`. `cooling` is null, or as it was initialised, for a wall that is not cooled;
/// its `gas_coefficient` must be finite, since a surface that is held at a temperature could give any heat.
///
/// # Safety
/// `model` is a loaded model; `surroundings`, `deposit` and `losses` begin with their `struct_size`, and
/// so does `cooling` unless it is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_deposit_advance(
    model: *const nw_model,
    surroundings: *const nw_deposit_surroundings,
    cooling: *const nw_wall_cooling,
    duration: f64,
    deposit: *mut nw_deposit,
    losses: *mut nw_deposit_losses,
) -> nw_status {
    let advance = || {
        // SAFETY: the caller's promises.
        let (model, surroundings, before, lost) = unsafe {
            (reader(model)?, sized(surroundings)?, sized(deposit.cast_const())?, sized(losses.cast_const())?)
        };
        // SAFETY: the caller's promise.
        let cooling = unsafe { cooling_of(cooling)? };
        let (wall, given) = (before.wall as usize, before.sound()?.to_deposit());
        let surroundings = surroundings.to_surroundings(cooling);
        let (left, mass, heat) = model.inner().advance(wall, &given, &surroundings, duration)?;
        let after = before.with(&left).sound()?;
        let lost = nw_deposit_losses {
            mass,
            heat_taken: heat.from_gas,
            heat_to_coolant: heat.to_coolant,
            heat_of_fusion: heat.fusion,
            heat_released: heat.released,
            deposit_resistance: heat.deposit_resistance,
            ..lost
        };
        if !is_finite(&lost) {
            return Err(NW_BAD_STATE);
        }
        // SAFETY: both checked just above.
        unsafe {
            deposit.write_unaligned(after);
            losses.write_unaligned(lost);
        }
        Ok(())
    };
    guarded_status(advance)
}

/// The cooling of a wall; `None` where the pointer is null or nothing was set.
///
/// # Safety
/// `cooling` begins with its `struct_size` unless it is null.
unsafe fn cooling_of(cooling: *const nw_wall_cooling) -> Result<Option<WallCooling>, nw_status> {
    if cooling.is_null() {
        return Ok(None);
    }
    // SAFETY: not null, and the caller's promise.
    let cooling = unsafe { sized(cooling)? };
    let is_given = cooling.coolant_temperature != 0.0 || cooling.gas_temperature != 0.0;
    if is_given { Ok(Some(cooling.sound()?.to_cooling())) } else { Ok(None) }
}

fn is_finite(lost: &nw_deposit_losses) -> bool {
    let heats = [lost.heat_taken, lost.heat_to_coolant, lost.heat_of_fusion, lost.heat_released];
    lost.mass.iter().chain(&heats).chain([&lost.deposit_resistance]).all(|number| number.is_finite())
}

/// Finds the processes that act on a wall of the model: bit `i` of `processes` is set where process
/// `i` does. Melting and sintering act on every wall whose temperatures are known, the others where
/// the model file has a table of their name.
///
/// # Safety
/// `model` is a loaded model, `processes` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_wall_processes(
    model: *const nw_model,
    wall: u32,
    processes: *mut u32,
) -> nw_status {
    let find = || {
        // SAFETY: the caller's promise.
        let model = unsafe { reader(model)? };
        if processes.is_null() {
            return Err(NW_NULL_POINTER);
        }
        let wall = model.inner().walls().get(wall as usize).ok_or(NW_UNKNOWN_WALL)?;
        let bits = wall.processes().fold(0, |bits, (place, _)| bits | 1_u32 << place);
        // SAFETY: not null, and writable by the caller's promise.
        unsafe { processes.write_unaligned(bits) };
        Ok(())
    };
    guarded_status(find)
}

/// Name, loss and gain of each process.
static PROCESS_NAMES: LazyLock<[[CString; 3]; NW_PROCESSES]> = LazyLock::new(|| {
    let text = |text: &str| CString::new(text).unwrap_or_default();
    std::array::from_fn(|index| {
        let process = PROCESSES[index];
        [process.name, process.loss.unwrap_or_default(), process.gain.unwrap_or_default()].map(text)
    })
});

/// Returns the name of a process, for instance `resuspension`, as a static string; processes act in
/// the order of their index. Null from `NW_PROCESSES` on.
#[unsafe(no_mangle)]
pub extern "C" fn nw_process_name(process: u32) -> *const c_char {
    PROCESS_NAMES.get(process as usize).map_or(std::ptr::null(), |[name, ..]| name.as_ptr())
}

/// Returns how tables name the mass that a process takes, for instance `resuspended`, as a static
/// string: empty for a process that takes none, null from `NW_PROCESSES` on.
#[unsafe(no_mangle)]
pub extern "C" fn nw_process_loss(process: u32) -> *const c_char {
    PROCESS_NAMES.get(process as usize).map_or(std::ptr::null(), |[_, loss, _]| loss.as_ptr())
}

/// Returns how tables name the mass that a process brings, for instance `condensed`, as a static
/// string: empty for a process that brings none, null from `NW_PROCESSES` on.
#[unsafe(no_mangle)]
pub extern "C" fn nw_process_gain(process: u32) -> *const c_char {
    PROCESS_NAMES.get(process as usize).map_or(std::ptr::null(), |[_, _, gain]| gain.as_ptr())
}
