//! Calls about what lies on a wall: a wall that the program keeps, and hostile ones.

use std::ptr::null;

use nearwall::c_api::*;

use super::super::bytes::Bytes;
use super::guarded_buffer::{GuardedBuffer, known};
use super::impacts::impact;

/// What a code keeps of a piece of wall.
#[derive(Default)]
pub struct KeptWall {
    deposit: nw_deposit,
    arrivals: nw_deposit_source,
    heat: nw_wall_heat,
}

impl KeptWall {
    pub fn call(&mut self, bytes: &mut Bytes<'_>, model: *const nw_model) {
        let model = if bytes.byte() == 0 { null() } else { model };
        match bytes.byte() % 11 {
            0 => begin(bytes),
            1 => self.start(bytes, model),
            2 => self.add_captured(bytes, model),
            3 => self.add(bytes),
            4 => self.apply_deposit(bytes, model),
            6 => self.heat(bytes, model),
            7 => self.advance(bytes, model),
            8 => ask(bytes, model),
            9 => bring(bytes, model),
            10 => touch(bytes, model),
            _ => self.flow(bytes, model),
        }
    }

    fn start(&mut self, bytes: &mut Bytes<'_>, model: *const nw_model) {
        let voidage = share(bytes);
        let before = self.deposit(bytes);
        let status = changed(bytes, before, |to| {
            // SAFETY: null or what it should be.
            unsafe { nw_deposit_initial(model, voidage, to) }
        });
        let Some(after) = status else { return };
        sound(&after);
        assert!(after.molten == 0.0 && after.wall == before.wall, "{after:?}");
        self.deposit = after;
    }

    fn add_captured(&mut self, bytes: &mut Bytes<'_>, model: *const nw_model) {
        let impact = impact(bytes);
        let mass = if bytes.below(2) == 0 { 1e-3 } else { bytes.number() };
        let density = if bytes.below(2) == 0 { 2e3 } else { bytes.number() };
        let mut asked = GuardedBuffer::holding(bytes, impact);
        let from: *const nw_impact = asked.start_or_null(bytes);
        let before = self.arrivals(bytes);
        let status = changed(bytes, before, |to| {
            // SAFETY: each is null or what it should be.
            unsafe { nw_deposit_source_add(model, from, mass, density, to) }
        });
        asked.assert_guard_intact();
        let Some(after) = status else { return };
        sound_sums(&after);
        assert_eq!(after.count, before.count.saturating_add(1));
        alike(before.molten + before.powder + mass, after.molten + after.powder);
        self.arrivals = after;
    }

    fn add(&mut self, bytes: &mut Bytes<'_>) {
        let arrivals = self.arrivals(bytes);
        let mut asked = GuardedBuffer::holding(bytes, arrivals);
        let from: *const nw_deposit_source = asked.start_or_null(bytes);
        let before = self.deposit(bytes);
        let status = changed(bytes, before, |to| {
            // SAFETY: each is null or what it should be.
            unsafe { nw_deposit_add(from, to) }
        });
        asked.assert_guard_intact();
        let Some(after) = status else { return };
        sound(&after);
        alike(before.molten + before.powder + arrivals.molten + arrivals.powder, after.molten + after.powder);
        assert!(after.frozen == before.frozen, "{after:?} of {before:?}");
        assert!(after.wall == before.wall && after.molten >= before.molten, "{after:?} of {before:?}");
        (self.deposit, self.arrivals) = (after, nw_deposit_source::default());
    }

    fn apply_deposit(&mut self, bytes: &mut Bytes<'_>, model: *const nw_model) {
        let voidage = share(bytes);
        let deposit = self.deposit(bytes);
        let bare = impact(bytes);
        let mut asked = GuardedBuffer::holding(bytes, deposit);
        let from: *const nw_deposit = asked.start_or_null(bytes);
        let status = changed(bytes, bare, |to| {
            // SAFETY: each is null or what it should be.
            unsafe { nw_deposit_apply(model, from, voidage, to) }
        });
        asked.assert_guard_intact();
        let Some(dressed) = status else { return };
        let heights = [dressed.layer_thickness, dressed.melt_thickness];
        assert!(heights.iter().all(|height| height.is_finite() && *height >= 0.0), "{dressed:?}");
        assert!((0.0..=1.0).contains(&dressed.coverage), "{dressed:?}");
        let undressed = nw_impact {
            layer_thickness: bare.layer_thickness,
            coverage: bare.coverage,
            melt_thickness: bare.melt_thickness,
            ..dressed
        };
        assert!(plain(&undressed) == plain(&bare), "more than the dress was changed");
        // What was an impact is one with a deposit, too; that may need a property at a temperature outside its table.
        let resolve = |impact: &nw_impact| {
            let mut outcome = nw_outcome::default();
            // SAFETY: all on the stack.
            unsafe { nw_resolve(model, impact, &raw mut outcome) }
        };
        if resolve(&bare) == NW_OK {
            let status = resolve(&dressed);
            assert!(status == NW_OK || status == NW_OUT_OF_RANGE, "{status}: {dressed:?}");
        }
    }

    fn flow(&mut self, bytes: &mut Bytes<'_>, model: *const nw_model) {
        let t_w = if bytes.below(2) == 0 { 1700.0 } else { bytes.number() };
        let gravity = if bytes.below(2) == 0 { 9.81 } else { bytes.number() };
        let deposit = self.deposit(bytes);
        let mut asked = GuardedBuffer::holding(bytes, deposit);
        let from: *const nw_deposit = asked.start_or_null(bytes);
        let mut buffer = GuardedBuffer::new(bytes, 8);
        let to = buffer.start_or_null(bytes);
        // SAFETY: each is null or what it should be.
        let status = match bytes.below(2) {
            // SAFETY: each is null or what it should be.
            0 => unsafe { nw_film_velocity(model, from, t_w, gravity, to) },
            _ => {
                let flux = if bytes.below(2) == 0 { 1e5 } else { bytes.number() };
                // SAFETY: each is null or what it should be.
                unsafe { nw_cooled_film_velocity(model, from, t_w, flux, gravity, to) }
            }
        };
        known(status);
        asked.assert_guard_intact();
        buffer.assert_guard_intact();
        if status == NW_OK {
            let found = buffer.f64();
            assert!(
                found.is_finite() && found >= 0.0,
                "{found} m/s of {deposit:?} at {t_w} K, {gravity} m/s2"
            );
        } else {
            buffer.assert_untouched();
        }
    }

    fn heat(&mut self, bytes: &mut Bytes<'_>, model: *const nw_model) {
        let voidage = share(bytes);
        let deposit = self.deposit(bytes);
        let cooling = cooling(bytes);
        let mut asked = GuardedBuffer::holding(bytes, deposit);
        let from: *const nw_deposit = asked.start_or_null(bytes);
        let mut sides = GuardedBuffer::holding(bytes, cooling);
        let by: *const nw_wall_cooling = sides.start_or_null(bytes);
        let before = self.temperatures(bytes);
        let status = changed(bytes, before, |to| {
            // SAFETY: each is null or what it should be.
            unsafe { nw_deposit_heat(model, from, voidage, by, to) }
        });
        asked.assert_guard_intact();
        sides.assert_guard_intact();
        let Some(after) = status else { return };
        let found = [after.surface_temperature, after.wall_temperature];
        assert!(found.iter().all(|kelvin| kelvin.is_finite() && *kelvin > 0.0), "{after:?} by {cooling:?}");
        assert!(after.heat_flux.is_finite() && after.coolant_flux.is_finite(), "{after:?} by {cooling:?}");
        assert!(after.deposit_resistance.is_finite() && after.deposit_resistance >= 0.0, "{after:?}");
        if deposit.molten == 0.0 && deposit.frozen == 0.0 && deposit.solid == 0.0 {
            assert!(after.deposit_resistance == 0.0, "{after:?} of a bare wall");
        }
        self.heat = after;
    }

    fn advance(&mut self, bytes: &mut Bytes<'_>, model: *const nw_model) {
        let duration = if bytes.below(2) == 0 { 60.0 } else { bytes.number() };
        let around = self.surroundings(bytes);
        let mut asked = GuardedBuffer::holding(bytes, around);
        let from: *const nw_deposit_surroundings = asked.start_or_null(bytes);
        let mut lost = nw_deposit_losses { mass: [-1.0; NW_PROCESSES], ..Default::default() };
        if bytes.byte() == 0 {
            lost.struct_size = bytes.word() as u32;
        }
        let cooled = cooling(bytes);
        let mut sides = GuardedBuffer::holding(bytes, cooled);
        // Null for a wall that is not cooled.
        let by: *const nw_wall_cooling = sides.start_or_null(bytes);
        let mut losses = GuardedBuffer::holding(bytes, lost);
        let kept = losses.bytes.clone();
        let taken: *mut nw_deposit_losses = losses.start_or_null(bytes);
        let before = self.deposit(bytes);
        let status = changed(bytes, before, |to| {
            // SAFETY: each is null or what it should be.
            unsafe { nw_deposit_advance(model, from, by, duration, to, taken) }
        });
        asked.assert_guard_intact();
        sides.assert_guard_intact();
        losses.assert_guard_intact();
        let Some(after) = status else {
            assert!(losses.bytes == kept, "written on failure");
            return;
        };
        sound(&after);
        // SAFETY: not null, or the call would have been refused; still the losses.
        let lost = unsafe { taken.read_unaligned() };
        assert!(lost.mass.iter().all(|mass| *mass >= 0.0), "{lost:?} of {before:?}");
        let gone: f64 = lost.mass.iter().map(|mass| 0.5 * mass).sum();
        let half = |of: &nw_deposit| 0.5 * of.molten + 0.5 * of.frozen + 0.5 * of.powder;
        alike(half(&before), half(&after) + gone);
        assert!(after.wall == before.wall && after.powder <= before.powder, "{after:?} of {before:?}");
        assert!(after.solid <= before.solid && after.cover <= before.cover, "{after:?} of {before:?}");
        self.deposit = after;
    }

    /// Surroundings at the wall's own temperatures, or hostile ones.
    fn surroundings(&self, bytes: &mut Bytes<'_>) -> nw_deposit_surroundings {
        let mut around = nw_deposit_surroundings {
            voidage: share(bytes),
            wall_temperature: self.heat.wall_temperature,
            gas_density: 1.2,
            kinematic_viscosity: 1.5e-5,
            shear_down: 4.8,
            gravity_along: 9.81,
            draw: share(bytes),
            ..Default::default()
        };
        let which = u16::from_le_bytes([bytes.byte(), bytes.byte()]);
        let fields = [
            &mut around.wall_temperature,
            &mut around.gas_density,
            &mut around.kinematic_viscosity,
            &mut around.shear_down,
            &mut around.shear_across,
            &mut around.gravity_outward,
            &mut around.gravity_along,
        ];
        for (bit, field) in fields.into_iter().enumerate() {
            if which >> bit & 1 == 1 {
                *field = bytes.number();
            }
        }
        if which >> 14 == 3 {
            around.struct_size = bytes.word() as u32;
        }
        around
    }

    /// The wall's own temperatures, or hostile ones.
    fn temperatures(&self, bytes: &mut Bytes<'_>) -> nw_wall_heat {
        let mut heat = self.heat;
        let which = bytes.byte();
        let fields = [
            &mut heat.surface_temperature,
            &mut heat.wall_temperature,
            &mut heat.coolant_flux,
            &mut heat.heat_flux,
            &mut heat.deposit_resistance,
        ];
        for (bit, field) in fields.into_iter().enumerate() {
            if which >> bit & 1 == 1 {
                *field = bytes.number();
            }
        }
        if which >> 6 == 3 {
            heat.struct_size = bytes.word() as u32;
        }
        heat
    }

    /// The wall's own deposit, or a hostile one.
    fn deposit(&self, bytes: &mut Bytes<'_>) -> nw_deposit {
        let mut deposit = self.deposit;
        let which = bytes.byte();
        let fields = [
            &mut deposit.molten,
            &mut deposit.frozen,
            &mut deposit.powder,
            &mut deposit.solid,
            &mut deposit.cover,
            &mut deposit.conversion,
        ];
        for (bit, field) in fields.into_iter().enumerate() {
            if which >> bit & 1 == 1 {
                *field = bytes.number();
            }
        }
        if which >> 5 & 1 == 1 {
            deposit.wall = bytes.below(4) as u32;
        }
        if which >> 6 == 1 {
            deposit.resuspended = share(bytes);
            deposit.behind = share(bytes);
        }
        if which >> 6 == 2 {
            deposit.closed = bytes.number();
        }
        if which >> 6 == 3 {
            deposit.struct_size = bytes.word() as u32;
        }
        deposit
    }

    /// The step's own arrivals, or hostile ones.
    fn arrivals(&self, bytes: &mut Bytes<'_>) -> nw_deposit_source {
        let mut arrivals = self.arrivals;
        let which = bytes.byte();
        let fields = [
            &mut arrivals.molten,
            &mut arrivals.powder,
            &mut arrivals.solid,
            &mut arrivals.cover,
            &mut arrivals.buried,
            &mut arrivals.converted,
        ];
        for (bit, field) in fields.into_iter().enumerate() {
            if which >> bit & 1 == 1 {
                *field = bytes.number();
            }
        }
        if which >> 6 == 2 {
            arrivals.count = bytes.word() as u32;
        }
        if which >> 6 == 3 {
            arrivals.struct_size = bytes.word() as u32;
        }
        arrivals
    }
}

/// What cools and heats an ordinary wall, or a hostile one.
fn cooling(bytes: &mut Bytes<'_>) -> nw_wall_cooling {
    let mut cooling = nw_wall_cooling {
        coolant_temperature: 600.0,
        coolant_coefficient: f64::INFINITY,
        wall_resistance: 1e-3,
        gas_temperature: 1700.0,
        gas_coefficient: 60.0,
        emissivity: 0.8,
        irradiation: 3e5,
        further_flux: 0.0,
        gas_conductivity: 0.06,
        ..nw_wall_cooling::default()
    };
    let which = [bytes.byte(), bytes.byte()];
    let fields = [
        &mut cooling.coolant_temperature,
        &mut cooling.coolant_coefficient,
        &mut cooling.wall_resistance,
        &mut cooling.gas_temperature,
        &mut cooling.gas_coefficient,
        &mut cooling.emissivity,
        &mut cooling.irradiation,
        &mut cooling.further_flux,
        &mut cooling.gas_conductivity,
        &mut cooling.void_temperature,
        &mut cooling.other_conductivity,
        &mut cooling.other_temperature,
        &mut cooling.vapour_fraction,
    ];
    let which = u16::from_le_bytes(which);
    for (bit, field) in fields.into_iter().enumerate() {
        if which >> bit & 1 == 1 {
            *field = bytes.number();
        }
    }
    if which >> 14 == 3 {
        cooling.struct_size = bytes.word() as u32;
    }
    cooling
}

/// Which processes act on a wall, and the names of one.
fn ask(bytes: &mut Bytes<'_>, model: *const nw_model) {
    let wall = bytes.below(4) as u32;
    let mut buffer = GuardedBuffer::new(bytes, 4);
    let to = buffer.start_or_null(bytes);
    // SAFETY: each is null or what it should be.
    let status = unsafe { nw_wall_processes(model, wall, to) };
    known(status);
    buffer.assert_guard_intact();
    if status != NW_OK {
        buffer.assert_untouched();
    }
    let process = bytes.word() as u32;
    let unknown = process as usize >= NW_PROCESSES;
    assert!(nw_process_name(process).is_null() == unknown && nw_process_loss(process).is_null() == unknown);
    assert_eq!(nw_process_gain(process).is_null(), unknown);
}

/// Heat that a captured particle brings.
fn bring(bytes: &mut Bytes<'_>, model: *const nw_model) {
    let capacity = if bytes.below(2) == 0 { 1e3 } else { bytes.number() };
    // SAFETY: each pointer is null or what it should be.
    ask_heat(bytes, |impact, heat| unsafe { nw_heat_brought(model, impact, capacity, heat) });
}

/// Heat of a particle that rebounds.
fn touch(bytes: &mut Bytes<'_>, model: *const nw_model) {
    // SAFETY: each pointer is null or what it should be.
    ask_heat(bytes, |impact, heat| unsafe { nw_contact_heat(model, impact, heat) });
}

/// Asks for the heat of an impact.
fn ask_heat(bytes: &mut Bytes<'_>, ask: impl FnOnce(*const nw_impact, *mut f64) -> nw_status) {
    let given = impact(bytes);
    let mut asked = GuardedBuffer::holding(bytes, given);
    let from: *const nw_impact = asked.start_or_null(bytes);
    let mut buffer = GuardedBuffer::new(bytes, 8);
    let to = buffer.start_or_null(bytes);
    let status = ask(from, to);
    known(status);
    asked.assert_guard_intact();
    buffer.assert_guard_intact();
    if status == NW_OK {
        assert!(buffer.f64().is_finite());
    } else {
        buffer.assert_untouched();
    }
}

fn begin(bytes: &mut Bytes<'_>) {
    let mut deposit = GuardedBuffer::new(bytes, size_of::<nw_deposit>());
    let mut arrivals = GuardedBuffer::new(bytes, size_of::<nw_deposit_source>());
    let mut cooling = GuardedBuffer::new(bytes, size_of::<nw_wall_cooling>());
    let mut heat = GuardedBuffer::new(bytes, size_of::<nw_wall_heat>());
    let (to_deposit, to_arrivals) = (deposit.start_or_null(bytes), arrivals.start_or_null(bytes));
    let (to_cooling, to_heat) = (cooling.start_or_null(bytes), heat.start_or_null(bytes));
    let mut around = GuardedBuffer::new(bytes, size_of::<nw_deposit_surroundings>());
    let mut losses = GuardedBuffer::new(bytes, size_of::<nw_deposit_losses>());
    let (to_around, to_losses) = (around.start_or_null(bytes), losses.start_or_null(bytes));
    // SAFETY: each is null or a buffer large enough for what is written.
    let found = unsafe {
        [
            nw_deposit_init(to_deposit),
            nw_deposit_source_init(to_arrivals),
            nw_wall_cooling_init(to_cooling),
            nw_wall_heat_init(to_heat),
            nw_deposit_surroundings_init(to_around),
            nw_deposit_losses_init(to_losses),
        ]
    };
    for (buffer, status) in [deposit, arrivals, cooling, heat, around, losses].iter().zip(found) {
        known(status);
        buffer.assert_guard_intact();
        if status != NW_OK {
            buffer.assert_untouched();
        }
    }
}

/// A call that changes what it is given: what that is afterwards, `None` where it was refused and so left alone.
fn changed<T: Copy>(bytes: &mut Bytes<'_>, before: T, call: impl FnOnce(*mut T) -> nw_status) -> Option<T> {
    let mut buffer = GuardedBuffer::holding(bytes, before);
    let kept = buffer.bytes.clone();
    let to: *mut T = buffer.start_or_null(bytes);
    let status = call(to);
    known(status);
    buffer.assert_guard_intact();
    if status != NW_OK {
        assert!(buffer.bytes == kept, "written on failure");
        return None;
    }
    // SAFETY: not null, or the call would have been refused; still a `T`.
    Some(unsafe { to.read_unaligned() })
}

/// A share that is ordinary or hostile.
fn share(bytes: &mut Bytes<'_>) -> f64 {
    match bytes.byte() {
        0 => 0.4,
        choice @ 1..=128 => f64::from(choice - 1) / 128.0,
        _ => bytes.number(),
    }
}

fn sound(deposit: &nw_deposit) {
    let sizes =
        [deposit.molten, deposit.frozen, deposit.powder, deposit.solid, deposit.cover, deposit.closed];
    assert!(sizes.iter().all(|size| size.is_finite() && *size >= 0.0), "{deposit:?}");
    assert!(
        [deposit.conversion, deposit.resuspended, deposit.behind]
            .iter()
            .all(|share| (0.0..=1.0).contains(share)),
        "{deposit:?}"
    );
}

fn sound_sums(sums: &nw_deposit_source) {
    let sizes = [sums.molten, sums.powder, sums.solid, sums.cover, sums.buried, sums.converted];
    assert!(sizes.iter().all(|size| size.is_finite() && *size >= 0.0), "{sums:?}");
}

/// Mass is kept to the rounding of a few additions, also of denormals; halves keep the sum of two large masses finite.
fn alike(before: f64, after: f64) {
    assert!(
        (before - after).abs() <= 1e-12 * before + f64::MIN_POSITIVE,
        "{before} kg/m2 before, {after} after"
    );
}

/// An impact's bytes, so that numbers that are no numbers can be compared.
fn plain(impact: &nw_impact) -> [u8; size_of::<nw_impact>()] {
    // SAFETY: an impact is plain bytes without padding.
    unsafe { std::mem::transmute(*impact) }
}
