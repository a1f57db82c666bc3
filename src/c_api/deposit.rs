//! What lies on a wall, for codes that remember it.
#![allow(non_camel_case_types)]

use super::boundary::{guarded_status, reader};
use super::types::{NW_NULL_POINTER, NW_OK, nw_impact, nw_model, nw_status};
use super::{check_size, sized, types::NW_BAD_STATE};
use crate::deposit::{Deposit, DepositSource};
use crate::slag::film;

/// What lies on a piece of wall, per area of it. A bare wall is what `nw_deposit_init` gives.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct nw_deposit {
    /// `sizeof(nw_deposit)`.
    pub struct_size: u32,
    /// Index of the wall, from `nw_model_find_wall`.
    pub wall: u32,
    /// Molten mass [kg/m2].
    pub molten: f64,
    /// Mass of powder [kg/m2].
    pub powder: f64,
    /// Volume of the powder's particles without the voids between them [m3/m2].
    pub solid: f64,
    /// Projected area of the powder's particles [1], overlaps counted.
    pub cover: f64,
    /// Carbon conversion of all that lies there, its mean by mass.
    pub conversion: f64,
}

/// What arrived on a piece of wall in a step and stayed, summed, per area of it. Nothing is what `nw_deposit_source_init` gives.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct nw_deposit_source {
    /// `sizeof(nw_deposit_source)`.
    pub struct_size: u32,
    /// How many were added.
    pub count: u32,
    /// Molten mass [kg/m2].
    pub molten: f64,
    /// Mass of powder [kg/m2].
    pub powder: f64,
    /// Volume of the powder's particles [m3/m2].
    pub solid: f64,
    /// Projected area of the powder's particles [1].
    pub cover: f64,
    /// Projected area of the molten particles [1].
    pub buried: f64,
    /// Mass times carbon conversion [kg/m2].
    pub converted: f64,
}

impl Default for nw_deposit {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            wall: 0,
            molten: 0.0,
            powder: 0.0,
            solid: 0.0,
            cover: 0.0,
            conversion: 0.0,
        }
    }
}

impl Default for nw_deposit_source {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            count: 0,
            molten: 0.0,
            powder: 0.0,
            solid: 0.0,
            cover: 0.0,
            buried: 0.0,
            converted: 0.0,
        }
    }
}

impl nw_deposit {
    fn to_deposit(self) -> Deposit {
        let Self { molten, powder, solid, cover, conversion, .. } = self;
        Deposit { molten, powder, solid, cover, conversion }
    }

    fn with(self, deposit: &Deposit) -> Self {
        let Deposit { molten, powder, solid, cover, conversion } = *deposit;
        Self { molten, powder, solid, cover, conversion, ..self }
    }

    fn is_sound(&self) -> bool {
        let sizes = [self.molten, self.powder, self.solid, self.cover];
        sizes.iter().all(|size| size.is_finite() && *size >= 0.0) && (0.0..=1.0).contains(&self.conversion)
    }

    /// Itself, unless a sum has overflowed: what is written can be given to every other call.
    fn sound(self) -> Result<Self, nw_status> {
        if self.is_sound() { Ok(self) } else { Err(NW_BAD_STATE) }
    }
}

impl nw_deposit_source {
    fn to_arrivals(self) -> DepositSource {
        let Self { molten, powder, solid, cover, buried, converted, .. } = self;
        DepositSource { molten, powder, solid, cover, buried, converted }
    }

    fn with(self, arrivals: &DepositSource) -> Self {
        let DepositSource { molten, powder, solid, cover, buried, converted } = *arrivals;
        let count = self.count.saturating_add(1);
        Self { count, molten, powder, solid, cover, buried, converted, ..self }
    }

    fn is_sound(&self) -> bool {
        let sizes = [self.molten, self.powder, self.solid, self.cover, self.buried, self.converted];
        sizes.iter().all(|size| size.is_finite() && *size >= 0.0)
    }

    /// As that of a deposit.
    fn sound(self) -> Result<Self, nw_status> {
        if self.is_sound() { Ok(self) } else { Err(NW_BAD_STATE) }
    }
}

/// Fills a deposit with its size and a bare wall: wall 0, all else 0.
///
/// # Safety
/// `deposit` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_deposit_init(deposit: *mut nw_deposit) -> nw_status {
    if deposit.is_null() {
        return NW_NULL_POINTER;
    }
    // SAFETY: not null, and writable by the caller's promise.
    unsafe { deposit.write_unaligned(nw_deposit::default()) };
    NW_OK
}

/// Sets a deposit to what the model file says lies on its `wall`, with a share `voidage` of voids in the powder: where a
/// memory begins.
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
        let begun = nw_deposit { wall, ..nw_deposit::default() }.with(&found).sound()?;
        // SAFETY: checked just above.
        unsafe { deposit.write_unaligned(begun) };
        Ok(())
    };
    guarded_status(start)
}

/// Fills arrivals with their size and zeros.
///
/// # Safety
/// `arrivals` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_deposit_source_init(arrivals: *mut nw_deposit_source) -> nw_status {
    if arrivals.is_null() {
        return NW_NULL_POINTER;
    }
    // SAFETY: not null, and writable by the caller's promise.
    unsafe { arrivals.write_unaligned(nw_deposit_source::default()) };
    NW_OK
}

/// Adds a particle that stayed: `mass` of it per area of wall [kg/m2], with the particle's `density` [kg/m3]. It counts as
/// molten when it is sticky at the temperature of the wall, as powder otherwise. The order changes sums by rounding alone; arrivals of
/// several threads or ranks are added field by field (`count` too) before one `nw_deposit_add`.
///
/// # Safety
/// `model` is a loaded model; `impact` and `arrivals` begin with their `struct_size`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_deposit_source_add(
    model: *const nw_model,
    impact: *const nw_impact,
    mass: f64,
    density: f64,
    arrivals: *mut nw_deposit_source,
) -> nw_status {
    let add = || {
        // SAFETY: the caller's promises.
        let (model, impact, sum) = unsafe { (reader(model)?, sized(impact)?, sized(arrivals.cast_const())?) };
        let (wall, before) = (impact.wall as usize, sum.sound()?.to_arrivals());
        let found = model.inner().add_captured(wall, &impact.to_impact(), mass, density, before)?;
        let found = sum.with(&found).sound()?;
        // SAFETY: checked just above.
        unsafe { arrivals.write_unaligned(found) };
        Ok(())
    };
    guarded_status(add)
}

/// Adds the arrivals of a step to a deposit. Powder that melt buries becomes part of the melt; mass is kept.
///
/// # Safety
/// `arrivals` and `deposit` begin with their `struct_size`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_deposit_add(
    arrivals: *const nw_deposit_source,
    deposit: *mut nw_deposit,
) -> nw_status {
    let add = || {
        // SAFETY: the caller's promises.
        let (arrivals, before) = unsafe { (sized(arrivals)?, sized(deposit.cast_const())?) };
        let after = before.sound()?.to_deposit().with(&arrivals.sound()?.to_arrivals());
        let after = before.with(&after).sound()?;
        // SAFETY: checked just above.
        unsafe { deposit.write_unaligned(after) };
        Ok(())
    };
    guarded_status(add)
}

/// Tells an impact of the deposit that it meets: sets its `layer_thickness` (powder with a share `voidage` of voids),
/// `coverage` and `melt_thickness`. The wall is that of the impact.
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
    let dress = || {
        // SAFETY: the caller's promises.
        let (model, deposit, bare) =
            unsafe { (reader(model)?, sized(deposit)?, sized(impact.cast_const())?) };
        let wall = bare.wall as usize;
        let found =
            model.inner().apply_deposit(wall, &deposit.sound()?.to_deposit(), voidage, &bare.to_impact())?;
        if !(found.layer_thickness.is_finite() && found.melt_thickness.is_finite()) {
            return Err(NW_BAD_STATE);
        }
        let dressed = nw_impact {
            layer_thickness: found.layer_thickness,
            coverage: found.coverage,
            melt_thickness: found.melt_thickness,
            ..bare
        };
        // SAFETY: checked just above.
        unsafe { impact.write_unaligned(dressed) };
        Ok(())
    };
    guarded_status(dress)
}

/// Mean speed [m/s] of the melt of a deposit that runs down its wall as a laminar film: at a temperature of the wall `T_w`
/// [K], with `gravity_along` the part of gravity along the wall [m/s2]. 0 where the model knows no viscosity of the melt, or
/// it is colder than a measured one. `gravity_along` is not negative; a melt hotter than its measured range is answered.
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
    let flow = || {
        // SAFETY: the caller's promises.
        let (model, deposit) = unsafe { (reader(model)?, sized(deposit)?) };
        if velocity.is_null() {
            return Err(NW_NULL_POINTER);
        }
        let possible = T_w.is_finite() && T_w > 0.0 && gravity_along.is_finite() && gravity_along >= 0.0;
        if !(possible && deposit.is_sound()) {
            return Err(NW_BAD_STATE);
        }
        let melt = model.inner().melt(deposit.wall as usize, T_w)?;
        let thickness = deposit.molten / melt.density;
        let found = film::mean_velocity(thickness, melt.density, melt.viscosity, gravity_along);
        if !found.is_finite() {
            return Err(NW_BAD_STATE);
        }
        // SAFETY: not null, and writable by the caller's promise.
        unsafe { velocity.write_unaligned(found) };
        Ok(())
    };
    guarded_status(flow)
}
