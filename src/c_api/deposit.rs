//! The deposit on a wall.
#![allow(non_camel_case_types)]

use super::boundary::{check_size, guarded_status, initialise, reader, sized};
use super::impact::nw_impact;
use super::types::{NW_BAD_STATE, NW_NULL_POINTER, nw_model, nw_status, zero_by_default};
use crate::deposit::{Deposit, DepositSource};

/// The deposit on a piece of wall, per wall area. `nw_deposit_init` makes a bare wall.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct nw_deposit {
    /// `sizeof(nw_deposit)`.
    pub struct_size: u32,
    /// Index of the wall, from `nw_model_find_wall`.
    pub wall: u32,
    /// Mass of molten slag [kg/m2].
    pub molten: f64,
    /// Mass of powder [kg/m2], outside of the slag and enclosed by it.
    pub powder: f64,
    /// Volume of the powder's particles without the voids between them [m3/m2].
    pub solid: f64,
    /// Projected area of the powder's particles [1], overlaps included.
    pub cover: f64,
    /// Carbon conversion [1], mean by mass of the whole deposit.
    pub conversion: f64,
    /// Volume of the powder's voids that sintering has closed [m3/m2].
    pub closed: f64,
    /// Share of the outer powder that landed and has left with the gas [1].
    pub resuspended: f64,
    /// Mass of frozen slag [kg/m2], below the molten slag.
    pub frozen: f64,
    /// Share of the powder that slag has enclosed [1]; it lies below the slag.
    pub behind: f64,
}

/// Sum of the particles that a piece of wall captured in a step, per wall area.
/// `nw_deposit_source_init` makes an empty sum.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct nw_deposit_source {
    /// `sizeof(nw_deposit_source)`.
    pub struct_size: u32,
    /// Number of particles.
    pub count: u32,
    /// Molten mass [kg/m2].
    pub molten: f64,
    /// Mass of powder [kg/m2].
    pub powder: f64,
    /// Volume of the powder's particles [m3/m2].
    pub solid: f64,
    /// Projected area of the powder's particles [1].
    pub cover: f64,
    /// Area that the molten particles cover once they have spread [1].
    pub buried: f64,
    /// Mass times carbon conversion [kg/m2].
    pub converted: f64,
}

zero_by_default!(nw_deposit, nw_deposit_source);

impl nw_deposit {
    pub(super) fn to_deposit(self) -> Deposit {
        let Self { molten, powder, solid, cover, conversion, closed, resuspended, frozen, behind, .. } = self;
        Deposit { molten, powder, solid, cover, conversion, closed, resuspended, frozen, behind }
    }

    pub(super) fn with(self, deposit: &Deposit) -> Self {
        let Deposit { molten, powder, solid, cover, conversion, closed, resuspended, frozen, behind } =
            *deposit;
        Self { molten, powder, solid, cover, conversion, closed, resuspended, frozen, behind, ..self }
    }

    /// Refuses overflowed sums, so that every other call accepts what this one writes.
    pub(super) fn sound(self) -> Result<Self, nw_status> {
        let sizes = are_sizes(&[self.molten, self.powder, self.solid, self.cover, self.closed, self.frozen]);
        let shares =
            [self.conversion, self.resuspended, self.behind].map(|share| (0.0..=1.0).contains(&share));
        if sizes && shares == [true; 3] { Ok(self) } else { Err(NW_BAD_STATE) }
    }
}

impl nw_deposit_source {
    fn to_source(self) -> DepositSource {
        let Self { molten, powder, solid, cover, buried, converted, .. } = self;
        DepositSource { molten, powder, solid, cover, buried, converted }
    }

    fn with(self, source: &DepositSource) -> Self {
        let DepositSource { molten, powder, solid, cover, buried, converted } = *source;
        let count = self.count.saturating_add(1);
        Self { count, molten, powder, solid, cover, buried, converted, ..self }
    }

    /// As [`nw_deposit::sound`].
    fn sound(self) -> Result<Self, nw_status> {
        let Self { molten, powder, solid, cover, buried, converted, .. } = self;
        let sizes = are_sizes(&[molten, powder, solid, cover, buried, converted]);
        if sizes { Ok(self) } else { Err(NW_BAD_STATE) }
    }
}

fn are_sizes(numbers: &[f64]) -> bool {
    numbers.iter().all(|number| number.is_finite() && *number >= 0.0)
}

/// Initialises a deposit: its size, wall 0, a bare wall.
///
/// # Safety
/// `deposit` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_deposit_init(deposit: *mut nw_deposit) -> nw_status {
    // SAFETY: the caller's promise.
    unsafe { initialise(deposit) }
}

/// Sets a deposit to the initial deposit that the model file states for its `wall`. `voidage` is the share of voids in
/// the powder [1].
///
/// # Safety
/// `model` is a loaded model; `deposit` begins with its `struct_size`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_deposit_initial(
    model: *const nw_model,
    voidage: f64,
    deposit: *mut nw_deposit,
) -> nw_status {
    let start = || {
        // SAFETY: the caller's promises. All but size and wall may be unset, so it is not read.
        let (model, wall) = unsafe {
            let model = reader(model)?;
            check_size(deposit.cast_const())?;
            (model, (&raw const (*deposit).wall).read_unaligned())
        };
        let found = model.inner().initial_deposit(wall as usize, voidage)?;
        let initial = nw_deposit { wall, ..nw_deposit::default() }.with(&found).sound()?;
        // SAFETY: checked just above.
        unsafe { deposit.write_unaligned(initial) };
        Ok(())
    };
    guarded_status(start)
}

/// Initialises a deposit source: its size and zeros.
///
/// # Safety
/// `source` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_deposit_source_init(source: *mut nw_deposit_source) -> nw_status {
    // SAFETY: the caller's promise.
    unsafe { initialise(source) }
}

/// Adds a captured particle: its `mass` per wall area [kg/m2] and its `density` [kg/m3]. It counts
/// as molten if the wall is hotter than its material is solid, as powder otherwise. The order of
/// particles affects the sums only by rounding. Sources of several threads or ranks are summed
/// field by field (`count` too) before one `nw_deposit_add`.
///
/// # Safety
/// `model` is a loaded model; `impact` and `source` begin with their `struct_size`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_deposit_source_add(
    model: *const nw_model,
    impact: *const nw_impact,
    mass: f64,
    density: f64,
    source: *mut nw_deposit_source,
) -> nw_status {
    let add = || {
        // SAFETY: the caller's promises.
        let (model, impact, sum) = unsafe { (reader(model)?, sized(impact)?, sized(source.cast_const())?) };
        let (wall, before) = (impact.wall as usize, sum.sound()?.to_source());
        let found = model.inner().add_captured(wall, &impact.to_impact(), mass, density, before)?;
        let found = sum.with(&found).sound()?;
        // SAFETY: checked just above.
        unsafe { source.write_unaligned(found) };
        Ok(())
    };
    guarded_status(add)
}

/// Adds the source of a step to a deposit. Powder that melt buries lies below the slag then; nothing
/// melts or freezes here, and mass is conserved.
///
/// # Safety
/// `source` and `deposit` begin with their `struct_size`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_deposit_add(
    source: *const nw_deposit_source,
    deposit: *mut nw_deposit,
) -> nw_status {
    let add = || {
        // SAFETY: the caller's promises.
        let (source, before) = unsafe { (sized(source)?, sized(deposit.cast_const())?) };
        let after = before.sound()?.to_deposit().with(&source.sound()?.to_source());
        let after = before.with(&after).sound()?;
        // SAFETY: checked just above.
        unsafe { deposit.write_unaligned(after) };
        Ok(())
    };
    guarded_status(add)
}

/// Sets the `layer_thickness` and `coverage` of the powder, and the `melt_thickness` of the slag, which
/// is stiff or liquid by `T_w`, of an impact on a deposit. `voidage` is the share of voids in the powder [1]. The
/// wall is that of the impact.
///
/// # Safety
/// `model` is a loaded model; `deposit` and `impact` begin with their `struct_size`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_deposit_apply(
    model: *const nw_model,
    deposit: *const nw_deposit,
    voidage: f64,
    impact: *mut nw_impact,
) -> nw_status {
    let apply = || {
        // SAFETY: the caller's promises.
        let (model, deposit, before) =
            unsafe { (reader(model)?, sized(deposit)?, sized(impact.cast_const())?) };
        let (wall, deposit) = (before.wall as usize, deposit.sound()?.to_deposit());
        let found = model.inner().apply_deposit(wall, &deposit, voidage, &before.to_impact())?;
        if !(found.layer_thickness.is_finite() && found.melt_thickness.is_finite()) {
            return Err(NW_BAD_STATE);
        }
        let after = nw_impact {
            layer_thickness: found.layer_thickness,
            coverage: found.coverage,
            melt_thickness: found.melt_thickness,
            ..before
        };
        // SAFETY: checked just above.
        unsafe { impact.write_unaligned(after) };
        Ok(())
    };
    guarded_status(apply)
}

/// Computes the mean speed [m/s] at which the melt of a deposit runs down its wall as a laminar film. `T_w` is the wall
/// temperature [K], `gravity_along` the component of gravity along the wall [m/s2], not negative. The speed is 0 if the
/// model has no viscosity of the melt or the melt is colder than its measured range; a hotter melt is accepted.
///
/// # Safety
/// `model` is a loaded model; `deposit` begins with its `struct_size`; `velocity` can be written.
#[unsafe(no_mangle)]
#[allow(non_snake_case)]
pub unsafe extern "C" fn nw_film_velocity(
    model: *const nw_model,
    deposit: *const nw_deposit,
    T_w: f64,
    gravity_along: f64,
    velocity: *mut f64,
) -> nw_status {
    // SAFETY: the caller's promises.
    unsafe { nw_cooled_film_velocity(model, deposit, T_w, 0.0, gravity_along, velocity) }
}

/// As `nw_film_velocity`, for melt through which heat flows to a cooled wall: its surface has
/// `T_surface` [K], and it is colder and stiffer below, by the `heat_flux` [W/m2] of
/// `nw_deposit_heat` over the conductivity of the melt. `NW_NO_CONDUCTIVITY` if the melt has none.
///
/// # Safety
/// `model` is a loaded model; `deposit` begins with its `struct_size`; `velocity` can be written.
#[unsafe(no_mangle)]
#[allow(non_snake_case)]
pub unsafe extern "C" fn nw_cooled_film_velocity(
    model: *const nw_model,
    deposit: *const nw_deposit,
    T_surface: f64,
    heat_flux: f64,
    gravity_along: f64,
    velocity: *mut f64,
) -> nw_status {
    let flow = || {
        // SAFETY: the caller's promises.
        let (model, deposit) = unsafe { (reader(model)?, sized(deposit)?) };
        if velocity.is_null() {
            return Err(NW_NULL_POINTER);
        }
        if !(are_sizes(&[T_surface, gravity_along]) && T_surface > 0.0 && heat_flux.is_finite()) {
            return Err(NW_BAD_STATE);
        }
        let deposit = deposit.sound()?;
        let wall = deposit.wall as usize;
        let found = model.inner().film_velocity(wall, deposit.molten, T_surface, heat_flux, gravity_along)?;
        if !found.is_finite() {
            return Err(NW_BAD_STATE);
        }
        // SAFETY: not null, and writable by the caller's promise.
        unsafe { velocity.write_unaligned(found) };
        Ok(())
    };
    guarded_status(flow)
}
