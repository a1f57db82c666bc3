//! Calls about impacts: one, many, and what can be asked of them.

use std::ffi::{CStr, c_char};
use std::ptr::null;

use nearwall::Impact;
use nearwall::c_api::*;
use nearwall::impact::INPUTS;

use super::super::bytes::Bytes;
use super::guarded_buffer::{GuardedBuffer, known};

/// An impact of which most is ordinary.
pub fn impact(bytes: &mut Bytes<'_>) -> nw_impact {
    let mut inputs = Impact { normal_speed: 1.0, tangential_speed: 1.0, ..Impact::default() };
    let which = bytes.word();
    for (bit, input) in INPUTS.iter().enumerate() {
        if which >> bit & 1 == 1 {
            (input.set)(&mut inputs, bytes.number());
        }
    }
    let mut impact = nw_impact::from(&inputs);
    if which >> 19 & 3 == 3 {
        for value in &mut impact.extra[..3] {
            *value = bytes.number();
        }
    }
    // Bits of their own: a hostile melt has to meet a wall that is there.
    if which >> 13 & 7 == 7 {
        impact.wall = bytes.word() as u32;
    } else {
        impact.wall = (which >> 13 & 1) as u32;
    }
    (impact.seed, impact.key) = (which >> 32, which >> 48);
    if which >> 16 & 7 == 7 {
        impact.struct_size = bytes.word() as u32;
    }
    impact
}

fn size_is_known(size: u32, right: usize) -> bool {
    size as usize == right
}

/// One impact, resolved where it stands and once more on an even address.
pub fn one(bytes: &mut Bytes<'_>, model: *const nw_model) {
    let impact = impact(bytes);
    let mut asked = GuardedBuffer::holding(bytes, impact);
    let mut outcome = nw_outcome::default();
    if bytes.byte() == 0 {
        outcome.struct_size = bytes.word() as u32;
    }
    let mut buffer = GuardedBuffer::holding(bytes, outcome);
    let before = buffer.bytes.clone();
    let from: *const nw_impact = asked.start_or_null(bytes);
    let to: *mut nw_outcome = buffer.start_or_null(bytes);
    let model = if bytes.byte() == 0 { null() } else { model };
    // SAFETY: each is null or what it should be, and begins with its size.
    let status = unsafe { nw_resolve(model, from, to) };
    known(status);
    asked.assert_guard_intact();
    buffer.assert_guard_intact();
    if status != NW_OK {
        assert!(buffer.bytes == before, "written on failure");
    } else {
        assert!(size_is_known(impact.struct_size, size_of::<nw_impact>()));
        // SAFETY: an outcome was written there.
        sane(&unsafe { to.read_unaligned() });
        let mut again = nw_outcome::default();
        // SAFETY: as above.
        assert_eq!(unsafe { nw_resolve(model, &raw const impact, &raw mut again) }, NW_OK);
        // SAFETY: an outcome is plain bytes without padding.
        let bytes: [u8; size_of::<nw_outcome>()] = unsafe { std::mem::transmute(again) };
        assert!(bytes == buffer.inside(), "other bits on another address");
    }
}

/// Names, defaults and values of the inputs that the model file declares.
pub fn extra(bytes: &mut Bytes<'_>, model: *const nw_model) {
    let (index, size) = (bytes.below(4) as u32, [0, 1, 3, 8, 40][bytes.below(5)]);
    let known_words = [c"glass", c"steel", c"0.3", c"inf", c"", c"gl\xc3\xa9", c"\xff"];
    let text = known_words[bytes.below(known_words.len())].as_ptr();
    let text = if bytes.byte() == 0 { null() } else { text };
    let mut texts: [GuardedBuffer; 3] = std::array::from_fn(|_| GuardedBuffer::new(bytes, size));
    let mut numbers: [GuardedBuffer; 2] = std::array::from_fn(|_| GuardedBuffer::new(bytes, 8));
    let mut count = GuardedBuffer::new(bytes, 4);
    let [name, message, word] = texts.each_mut().map(|buffer| buffer.start_or_null(bytes));
    let [default, value] = numbers.each_mut().map(|buffer| buffer.start_or_null::<f64>(bytes));
    let to_count = count.start_or_null::<u32>(bytes);
    let model = if bytes.byte() == 0 { null() } else { model };
    // SAFETY: each is null or what it should be.
    let statuses = unsafe {
        [
            nw_extra_input_name(model, index, name, size),
            nw_extra_input_value(model, index, text, value, message, size),
            nw_extra_input_default(model, index, default),
            nw_extra_input_count(model, to_count),
            nw_extra_input_word(model, index, size as u32 % 3, word, size),
        ]
    };
    statuses.into_iter().for_each(known);
    let buffers = [(&texts[0], statuses[0]), (&numbers[1], statuses[1]), (&numbers[0], statuses[2])];
    for (buffer, status) in buffers.into_iter().chain([(&count, statuses[3])]) {
        buffer.assert_guard_intact();
        if status != NW_OK {
            buffer.assert_untouched();
        }
    }
    let written = [statuses[0] == NW_OK, statuses[1] != NW_OK && size > 0, statuses[4] == NW_OK];
    texts.iter().for_each(GuardedBuffer::assert_guard_intact);
    for (buffer, written) in texts.iter().zip(written).filter(|(buffer, _)| buffer.is_changed()) {
        assert!(written, "written without need");
        let text = CStr::from_bytes_until_nul(buffer.inside()).expect("a closing zero");
        text.to_str().expect("whole characters");
    }
}

fn sane(outcome: &nw_outcome) {
    assert!((0.0..=1.0).contains(&outcome.p_stick), "{outcome:?}");
    assert!(outcome.e_n >= 0.0 && !outcome.e_t.is_nan() && !outcome.omega.is_nan(), "{outcome:?}");
    assert!(outcome.stuck <= 1 && outcome.regime <= NW_SP_SW && outcome.flags <= 1, "{outcome:?}");
}

pub fn speeds(bytes: &mut Bytes<'_>, model: *const nw_model) {
    let impact = impact(bytes);
    let mut asked = GuardedBuffer::holding(bytes, impact);
    let mut buffers: [GuardedBuffer; 3] = std::array::from_fn(|_| GuardedBuffer::new(bytes, 8));
    let from: *const nw_impact = asked.start_or_null(bytes);
    let [a, b, c] = buffers.each_mut().map(|buffer| buffer.start_or_null::<f64>(bytes));
    // SAFETY: each is null or what it should be.
    let status = unsafe { nw_speeds(model, from, a, b, c) };
    known(status);
    for (buffer, to) in buffers.iter_mut().zip([a, b, c]) {
        buffer.assert_guard_intact();
        if status == NW_OK && !to.is_null() {
            assert!(buffer.f64() >= 0.0, "{} of {impact:?}", buffer.f64());
        } else {
            buffer.assert_untouched();
        }
    }
}

/// The density of the particles and what they erode.
pub fn of_particles(bytes: &mut Bytes<'_>, model: *const nw_model) {
    let impact = impact(bytes);
    let mass = bytes.number();
    let mut asked = GuardedBuffer::holding(bytes, impact);
    let mut buffers: [GuardedBuffer; 2] = std::array::from_fn(|_| GuardedBuffer::new(bytes, 8));
    let from: *const nw_impact = asked.start_or_null(bytes);
    let [density, volume] = buffers.each_mut().map(|buffer| buffer.start_or_null::<f64>(bytes));
    // SAFETY: each is null or what it should be.
    let statuses =
        unsafe { [nw_particle_density(model, from, density), nw_erosion(model, from, mass, volume)] };
    for (buffer, status) in buffers.iter_mut().zip(statuses) {
        known(status);
        buffer.assert_guard_intact();
        if status == NW_OK {
            assert!(buffer.f64() >= 0.0, "{} of {impact:?}, {mass} kg", buffer.f64());
        } else {
            buffer.assert_untouched();
        }
    }
    explained(bytes, model, from);
    unlikely(bytes, from);
    beyond(bytes, model, from);
}

/// Which stated ranges an impact leaves.
fn beyond(bytes: &mut Bytes<'_>, model: *const nw_model, impact: *const nw_impact) {
    let size = [0, 1, 2, 3, 40, 4000][bytes.below(6)];
    // SAFETY: each is null or what it should be.
    said(bytes, size, |text, size| unsafe { nw_beyond(model, impact, text, size) });
}

/// Which input is probably in another unit.
fn unlikely(bytes: &mut Bytes<'_>, impact: *const nw_impact) {
    let size = [0, 1, 2, 3, 40, 400][bytes.below(6)];
    // SAFETY: each is null or what it should be.
    said(bytes, size, |text, size| unsafe { nw_unlikely(impact, text, size) });
}

/// A call that writes a text where it succeeds, and nothing where it fails.
fn said(bytes: &mut Bytes<'_>, size: usize, call: impl FnOnce(*mut c_char, usize) -> nw_status) {
    let mut buffer = GuardedBuffer::new(bytes, size);
    let text = buffer.start_or_null(bytes);
    let status = call(text, size);
    known(status);
    buffer.assert_guard_intact();
    if status == NW_OK {
        let text = CStr::from_bytes_until_nul(buffer.inside()).expect("a closing zero");
        text.to_str().expect("whole characters");
    } else {
        buffer.assert_untouched();
    }
}

/// The key of some values, which begin at any address.
pub fn key(bytes: &mut Bytes<'_>) {
    let values: Vec<f64> = (0..bytes.below(12)).map(|_| bytes.number()).collect();
    let mut given = GuardedBuffer::new(bytes, 8 * values.len());
    let to = given.start_or_null::<f64>(bytes);
    for (index, value) in values.iter().enumerate().filter(|_| !to.is_null()) {
        // SAFETY: the buffer has room for the values.
        unsafe { to.add(index).write_unaligned(*value) };
    }
    let count = if bytes.byte() == 0 { usize::MAX } else { values.len() };
    let mut found = GuardedBuffer::new(bytes, 8);
    let key = found.start_or_null::<u64>(bytes);
    // SAFETY: null, or as many values as the count unless that is refused.
    let status = unsafe { nw_key_of_values(to.cast_const(), count, key) };
    known(status);
    found.assert_guard_intact();
    let good = !values.is_empty() && values.iter().all(|value| value.is_finite());
    let accepted = good && !to.is_null() && !key.is_null() && count == values.len();
    assert_eq!(status == NW_OK, accepted, "{values:?}");
    if status != NW_OK {
        found.assert_untouched();
    }
}

/// A walk with any inputs.
pub fn walk(bytes: &mut Bytes<'_>) {
    let mut walk = nw_walk::default();
    // SAFETY: a whole walk.
    assert_eq!(unsafe { nw_walk_init(&raw mut walk) }, NW_OK);
    [walk.seed, walk.key, walk.step] = std::array::from_fn(|_| bytes.word());
    for value in [
        &mut walk.duration,
        &mut walk.relaxation_time,
        &mut walk.friction_velocity,
        &mut walk.kinematic_viscosity,
        &mut walk.wall_distance,
        &mut walk.core_fluctuation,
        &mut walk.core_time,
    ] {
        *value = bytes.number();
    }
    for vector in [&mut walk.normal, &mut walk.flow, &mut walk.core_gradient, &mut walk.values] {
        *vector = std::array::from_fn(|_| bytes.number());
    }
    // SAFETY: whole walks.
    let status = unsafe { nw_walk_advance(&raw mut walk) };
    known(status);
    assert!(status != NW_OK || walk.velocity.iter().all(|part| part.is_finite()), "{walk:?}");
    let given: [f64; 7] = std::array::from_fn(|_| bytes.number());
    let mut force = 0.0;
    let [a, b, c, d, e, f, g] = given;
    // SAFETY: the force can be written.
    let status = unsafe { nw_thermophoresis(a, b, c, d, e, f, g, &raw mut force) };
    known(status);
    assert!(status != NW_OK || (force.is_finite() && force <= 0.0), "{given:?}");
}

pub fn ranges(bytes: &mut Bytes<'_>, model: *const nw_model) {
    let wall = [0, 1, 2, u32::MAX][bytes.below(4)];
    let mut buffers: [GuardedBuffer; 4] = std::array::from_fn(|_| GuardedBuffer::new(bytes, 8));
    let to = buffers.each_mut().map(|buffer| buffer.start_or_null::<f64>(bytes));
    let model = if bytes.byte() == 0 { null() } else { model };
    // SAFETY: each is null or what it should be.
    let status = unsafe { nw_temperature_ranges(model, wall, to[0], to[1], to[2], to[3]) };
    known(status);
    for (buffer, to) in buffers.iter_mut().zip(to) {
        buffer.assert_guard_intact();
        if status == NW_OK && !to.is_null() {
            assert!(buffer.f64() >= 0.0);
        } else {
            buffer.assert_untouched();
        }
    }
}

/// The arrays of up to seven impacts, each there or not, on any address.
struct BatchArrays {
    count: usize,
    columns: [(*const f64, GuardedBuffer); INPUTS.len()],
    extra: [(*const f64, Vec<f64>); 2],
    keys: Vec<u64>,
    walls: Vec<u32>,
}

impl BatchArrays {
    fn new(bytes: &mut Bytes<'_>) -> Self {
        let count = bytes.below(8);
        let cases: Vec<nw_impact> = (0..count).map(|_| impact(bytes)).collect();
        let columns = INPUTS.each_ref().map(|input| {
            let mut buffer = GuardedBuffer::new(bytes, 8 * count);
            let start: *mut f64 = buffer.start();
            for (index, case) in cases.iter().enumerate() {
                // SAFETY: a buffer of `count` numbers.
                unsafe { start.add(index).write_unaligned((input.value)(&case.to_impact())) };
            }
            (buffer.start_or_null::<f64>(bytes).cast_const(), buffer)
        });
        let extra = std::array::from_fn(|place| {
            let values: Vec<f64> = cases.iter().map(|case| case.extra[place]).collect();
            (if bytes.below(2) == 0 { null() } else { values.as_ptr() }, values)
        });
        let keys = cases.iter().map(|case| case.key).collect();
        let walls = cases.iter().map(|case| case.wall).collect();
        Self { count, columns, extra, keys, walls }
    }

    /// The batch of these arrays; its count and its size may be such that it is refused.
    fn asked(&self, bytes: &mut Bytes<'_>) -> nw_impacts {
        let right = size_of::<nw_impacts>() as u32;
        let claimed = match bytes.byte() {
            0 => usize::MAX,
            1 => isize::MAX as usize / 8 + 1,
            2 => usize::MAX / 8,
            _ => self.count,
        };
        let mut asked = nw_impacts {
            struct_size: if bytes.byte() == 0 { bytes.word() as u32 } else { right },
            wall: bytes.below(3) as u32,
            count: claimed,
            seed: bytes.word(),
            walls: if bytes.below(2) == 0 { null() } else { self.walls.as_ptr() },
            key: if bytes.below(2) == 0 { null() } else { self.keys.as_ptr() },
            ..nw_impacts::default()
        };
        for (array, (column, _room)) in asked.columns_mut().into_iter().zip(&self.columns) {
            *array = *column;
        }
        for (array, (column, _values)) in asked.extra.iter_mut().zip(&self.extra) {
            *array = *column;
        }
        asked
    }
}

/// Up to seven impacts in arrays, each array there or not, on any address; or a count that is refused.
pub fn batch(bytes: &mut Bytes<'_>, model: *const nw_model) {
    let arrays = BatchArrays::new(bytes);
    let (count, asked) = (arrays.count, arrays.asked(bytes));
    let mut numbers: [GuardedBuffer; 4] = std::array::from_fn(|_| GuardedBuffer::new(bytes, 8 * count));
    let mut marks: [GuardedBuffer; 3] = std::array::from_fn(|_| GuardedBuffer::new(bytes, 4 * count));
    let [e_n, e_t, p_stick, omega] = numbers.each_mut().map(|buffer| buffer.start_or_null(bytes));
    let [regime, stuck, flags] = marks.each_mut().map(|buffer| buffer.start_or_null(bytes));
    let struct_size = size_of::<nw_outcomes>() as u32;
    let struct_size = if bytes.byte() == 0 { bytes.word() as u32 } else { struct_size };
    let wanted = nw_outcomes { struct_size, e_n, e_t, p_stick, omega, regime, stuck, flags };
    let mut asked = GuardedBuffer::holding(bytes, asked);
    let mut wanted = GuardedBuffer::holding(bytes, wanted);
    let mut first_bad = GuardedBuffer::new(bytes, size_of::<usize>());
    let (from, to, bad): (*const nw_impacts, *const nw_outcomes, *mut usize) =
        (asked.start_or_null(bytes), wanted.start_or_null(bytes), first_bad.start_or_null(bytes));
    let model = if bytes.byte() == 0 { null() } else { model };
    // SAFETY: arrays of `count` entries or null, or a count that is refused.
    let status = unsafe { nw_resolve_batch(model, from, to, bad) };
    known(status);
    for buffer in numbers.iter().chain(&marks).chain([&asked, &wanted, &first_bad]) {
        buffer.assert_guard_intact();
    }
    let of_an_impact = [NW_UNKNOWN_WALL, NW_BAD_STATE, NW_OUT_OF_RANGE].contains(&status);
    if of_an_impact && !bad.is_null() {
        // SAFETY: an index was written there.
        assert!(unsafe { bad.read_unaligned() } < count);
    } else {
        first_bad.assert_untouched();
    }
    if status != NW_OK {
        return numbers.iter().chain(&marks).for_each(GuardedBuffer::assert_untouched);
    }
    alike(model, from, &mut numbers, [e_n, e_t, p_stick, omega]);
}

/// The batch's numbers are those of its impacts one by one.
fn alike(
    model: *const nw_model,
    asked: *const nw_impacts,
    found: &mut [GuardedBuffer; 4],
    wanted: [*mut f64; 4],
) {
    // SAFETY: a batch that was accepted.
    let asked = unsafe { asked.read_unaligned() };
    for index in 0..asked.count {
        let mut inputs = Impact::default();
        for (array, input) in asked.columns().into_iter().zip(&INPUTS) {
            if !array.is_null() {
                // SAFETY: the array has `count` entries.
                (input.set)(&mut inputs, unsafe { array.add(index).read_unaligned() });
            }
        }
        for (array, value) in asked.extra.into_iter().zip(inputs.extra.iter_mut()) {
            if !array.is_null() {
                // SAFETY: the array has `count` entries.
                *value = unsafe { array.add(index).read_unaligned() };
            }
        }
        let one = nw_impact {
            // SAFETY: as above.
            wall: if asked.walls.is_null() { asked.wall } else { unsafe { *asked.walls.add(index) } },
            seed: asked.seed,
            // SAFETY: as above.
            key: if asked.key.is_null() { index as u64 } else { unsafe { *asked.key.add(index) } },
            ..nw_impact::from(&inputs)
        };
        let mut outcome = nw_outcome::default();
        // SAFETY: all on the stack.
        assert_eq!(unsafe { nw_resolve(model, &raw const one, &raw mut outcome) }, NW_OK);
        sane(&outcome);
        let expected = [outcome.e_n, outcome.e_t, outcome.p_stick, outcome.omega];
        for ((buffer, to), expected) in found.iter().zip(wanted).zip(expected) {
            if !to.is_null() {
                let bits = &buffer.inside()[8 * index..8 * index + 8];
                assert_eq!(bits, expected.to_ne_bytes(), "impact {index} of a batch");
            }
        }
    }
}

/// Why an impact cannot be decided.
fn explained(bytes: &mut Bytes<'_>, model: *const nw_model, impact: *const nw_impact) {
    let size = [0, 1, 2, 3, 40, 400][bytes.below(6)];
    let mut message = GuardedBuffer::new(bytes, size);
    let text = message.start_or_null(bytes);
    // SAFETY: each is null or what it should be.
    let status = unsafe { nw_explain(model, impact, text, size) };
    known(status);
    message.assert_guard_intact();
    if status == NW_OK || text.is_null() || size == 0 {
        message.assert_untouched();
    } else {
        let text = CStr::from_bytes_until_nul(message.inside()).expect("a closing zero");
        text.to_str().expect("whole characters");
    }
}
