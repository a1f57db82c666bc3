//! Calls about what lies on a wall: a wall that the program keeps, and hostile ones.

use std::ptr::null;

use nearwall::c_api::*;

use super::super::bytes::Bytes;
use super::guarded_buffer::{GuardedBuffer, known};
use super::impacts::impact;

/// What a code keeps of a piece of wall.
#[derive(Default)]
pub struct Wall {
    deposit: nw_deposit,
    arrivals: nw_deposit_source,
}

impl Wall {
    pub fn call(&mut self, bytes: &mut Bytes<'_>, model: *const nw_model) {
        let model = if bytes.byte() == 0 { null() } else { model };
        match bytes.byte() % 6 {
            0 => begin(bytes),
            1 => self.start(bytes, model),
            2 => self.add_captured(bytes, model),
            3 => self.add(bytes),
            4 => self.apply_deposit(bytes, model),
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
        // What was an impact is one with a deposit, too.
        let resolve = |impact: &nw_impact| {
            let mut outcome = nw_outcome::default();
            // SAFETY: all on the stack.
            unsafe { nw_resolve(model, impact, &raw mut outcome) }
        };
        if resolve(&bare) == NW_OK {
            assert_eq!(resolve(&dressed), NW_OK, "{dressed:?}");
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
        let status = unsafe { nw_film_velocity(model, from, t_w, gravity, to) };
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

    /// The wall's own deposit, or a hostile one.
    fn deposit(&self, bytes: &mut Bytes<'_>) -> nw_deposit {
        let mut deposit = self.deposit;
        let which = bytes.byte();
        let fields = [
            &mut deposit.molten,
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

fn begin(bytes: &mut Bytes<'_>) {
    let mut deposit = GuardedBuffer::new(bytes, size_of::<nw_deposit>());
    let mut arrivals = GuardedBuffer::new(bytes, size_of::<nw_deposit_source>());
    let (to_deposit, to_arrivals) = (deposit.start_or_null(bytes), arrivals.start_or_null(bytes));
    // SAFETY: each is null or a buffer large enough for what is written.
    let found = unsafe { [nw_deposit_init(to_deposit), nw_deposit_source_init(to_arrivals)] };
    for (buffer, status) in [deposit, arrivals].iter().zip(found) {
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
    let sizes = [deposit.molten, deposit.powder, deposit.solid, deposit.cover];
    assert!(sizes.iter().all(|size| size.is_finite() && *size >= 0.0), "{deposit:?}");
    assert!((0.0..=1.0).contains(&deposit.conversion), "{deposit:?}");
}

fn sound_sums(sums: &nw_deposit_source) {
    let sizes = [sums.molten, sums.powder, sums.solid, sums.cover, sums.buried, sums.converted];
    assert!(sizes.iter().all(|size| size.is_finite() && *size >= 0.0), "{sums:?}");
}

/// Mass is kept to the rounding of a few additions; the halves keep the sum of two large masses finite.
fn alike(before: f64, after: f64) {
    assert!((before - after).abs() <= 1e-12 * before, "{before} kg/m2 before, {after} after");
}

/// An impact's bytes, so that numbers that are no numbers can be compared.
fn plain(impact: &nw_impact) -> [u8; size_of::<nw_impact>()] {
    // SAFETY: an impact is plain bytes without padding.
    unsafe { std::mem::transmute(*impact) }
}
