//! Calls about impacts: one, many, and what can be asked of them.

use std::ptr::null;

use nearwall::c_api::*;

use super::super::bytes::Bytes;
use super::room::{Room, known};

/// An impact of which most is ordinary.
pub fn impact(bytes: &mut Bytes<'_>) -> nw_impact {
    let mut impact = nw_impact { v_n: 1.0, v_t: 1.0, ..nw_impact::default() };
    let which = bytes.word();
    let fields = [
        &mut impact.v_n,
        &mut impact.v_t,
        &mut impact.d,
        &mut impact.T_p,
        &mut impact.T_w,
        &mut impact.conversion,
        &mut impact.layer_thickness,
        &mut impact.film_thickness,
        &mut impact.v_gas,
        &mut impact.roughness,
        &mut impact.omega,
        &mut impact.coverage,
        &mut impact.melt_thickness,
    ];
    for (bit, field) in fields.into_iter().enumerate() {
        if which >> bit & 1 == 1 {
            *field = bytes.number();
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
    let mut asked = Room::holding(bytes, impact);
    let mut outcome = nw_outcome::default();
    if bytes.byte() == 0 {
        outcome.struct_size = bytes.word() as u32;
    }
    let mut room = Room::holding(bytes, outcome);
    let before = room.bytes.clone();
    let from: *const nw_impact = asked.perhaps(bytes);
    let to: *mut nw_outcome = room.perhaps(bytes);
    let model = if bytes.byte() == 0 { null() } else { model };
    // SAFETY: each is null or what it should be, and begins with its size.
    let status = unsafe { nw_resolve(model, from, to) };
    known(status);
    asked.kept();
    room.kept();
    if status != NW_OK {
        assert!(room.bytes == before, "written on failure");
    } else {
        assert!(size_is_known(impact.struct_size, size_of::<nw_impact>()));
        // SAFETY: an outcome was written there.
        sane(&unsafe { to.read_unaligned() });
        let mut again = nw_outcome::default();
        // SAFETY: as above.
        assert_eq!(unsafe { nw_resolve(model, &raw const impact, &raw mut again) }, NW_OK);
        // SAFETY: an outcome is plain bytes without padding.
        let bytes: [u8; size_of::<nw_outcome>()] = unsafe { std::mem::transmute(again) };
        assert!(bytes == room.inside(), "other bits on another address");
    }
}

fn sane(outcome: &nw_outcome) {
    assert!((0.0..=1.0).contains(&outcome.p_stick), "{outcome:?}");
    assert!(outcome.e_n >= 0.0 && !outcome.e_t.is_nan() && !outcome.omega.is_nan(), "{outcome:?}");
    assert!(outcome.stuck <= 1 && outcome.regime <= NW_SP_SW && outcome.flags <= 1, "{outcome:?}");
}

pub fn speeds(bytes: &mut Bytes<'_>, model: *const nw_model) {
    let impact = impact(bytes);
    let mut asked = Room::holding(bytes, impact);
    let mut rooms: [Room; 3] = std::array::from_fn(|_| Room::new(bytes, 8));
    let from: *const nw_impact = asked.perhaps(bytes);
    let [a, b, c] = rooms.each_mut().map(|room| room.perhaps::<f64>(bytes));
    // SAFETY: each is null or what it should be.
    let status = unsafe { nw_speeds(model, from, a, b, c) };
    known(status);
    for (room, to) in rooms.iter_mut().zip([a, b, c]) {
        room.kept();
        if status == NW_OK && !to.is_null() {
            assert!(room.f64() >= 0.0, "{} of {impact:?}", room.f64());
        } else {
            room.untouched();
        }
    }
}

pub fn ranges(bytes: &mut Bytes<'_>, model: *const nw_model) {
    let wall = [0, 1, 2, u32::MAX][bytes.below(4)];
    let mut rooms: [Room; 4] = std::array::from_fn(|_| Room::new(bytes, 8));
    let to = rooms.each_mut().map(|room| room.perhaps::<f64>(bytes));
    let model = if bytes.byte() == 0 { null() } else { model };
    // SAFETY: each is null or what it should be.
    let status = unsafe { nw_temperature_ranges(model, wall, to[0], to[1], to[2], to[3]) };
    known(status);
    for (room, to) in rooms.iter_mut().zip(to) {
        room.kept();
        if status == NW_OK && !to.is_null() {
            assert!(room.f64() >= 0.0);
        } else {
            room.untouched();
        }
    }
}

/// Up to seven impacts in arrays, each array there or not, on any address; or a count that is refused.
pub fn batch(bytes: &mut Bytes<'_>, model: *const nw_model) {
    let count = bytes.below(8);
    let cases: Vec<nw_impact> = (0..count).map(|_| impact(bytes)).collect();
    let mut column = |value: fn(&nw_impact) -> f64| {
        let mut room = Room::new(bytes, 8 * count);
        let start: *mut f64 = room.start();
        for (index, case) in cases.iter().enumerate() {
            // SAFETY: room for `count` numbers.
            unsafe { start.add(index).write_unaligned(value(case)) };
        }
        (room.perhaps::<f64>(bytes).cast_const(), room)
    };
    let (v_n, _keep_0) = column(|c| c.v_n);
    let (v_t, _keep_1) = column(|c| c.v_t);
    let (d, _keep_2) = column(|c| c.d);
    let (t_p, _keep_3) = column(|c| c.T_p);
    let (t_w, _keep_4) = column(|c| c.T_w);
    let (conversion, _keep_5) = column(|c| c.conversion);
    let (omega, _keep_6) = column(|c| c.omega);
    let (coverage, _keep_7) = column(|c| c.coverage);
    let (film_thickness, _keep_8) = column(|c| c.film_thickness);
    let (layer_thickness, _keep_9) = column(|c| c.layer_thickness);
    let (v_gas, _keep_10) = column(|c| c.v_gas);
    let (roughness, _keep_11) = column(|c| c.roughness);
    let (melt_thickness, _keep_12) = column(|c| c.melt_thickness);
    let keys: Vec<u64> = cases.iter().map(|case| case.key).collect();
    let walls: Vec<u32> = cases.iter().map(|case| case.wall).collect();
    let right = size_of::<nw_impacts>() as u32;
    let claimed = match bytes.byte() {
        0 => usize::MAX,
        1 => isize::MAX as usize / 8 + 1,
        2 => usize::MAX / 8,
        _ => count,
    };
    let asked = nw_impacts {
        struct_size: if bytes.byte() == 0 { bytes.word() as u32 } else { right },
        wall: bytes.below(3) as u32,
        count: claimed,
        seed: bytes.word(),
        walls: if bytes.below(2) == 0 { null() } else { walls.as_ptr() },
        v_n,
        v_t,
        d,
        T_p: t_p,
        T_w: t_w,
        conversion,
        layer_thickness,
        film_thickness,
        v_gas,
        roughness,
        omega,
        coverage,
        key: if bytes.below(2) == 0 { null() } else { keys.as_ptr() },
        melt_thickness,
    };
    let mut numbers: [Room; 4] = std::array::from_fn(|_| Room::new(bytes, 8 * count));
    let mut marks: [Room; 3] = std::array::from_fn(|_| Room::new(bytes, 4 * count));
    let [e_n, e_t, p_stick, omega] = numbers.each_mut().map(|room| room.perhaps(bytes));
    let [regime, stuck, flags] = marks.each_mut().map(|room| room.perhaps(bytes));
    let struct_size = size_of::<nw_outcomes>() as u32;
    let struct_size = if bytes.byte() == 0 { bytes.word() as u32 } else { struct_size };
    let wanted = nw_outcomes { struct_size, e_n, e_t, p_stick, omega, regime, stuck, flags };
    let mut asked = Room::holding(bytes, asked);
    let mut wanted = Room::holding(bytes, wanted);
    let mut first_bad = Room::new(bytes, size_of::<usize>());
    let (from, to, bad): (*const nw_impacts, *const nw_outcomes, *mut usize) =
        (asked.perhaps(bytes), wanted.perhaps(bytes), first_bad.perhaps(bytes));
    let model = if bytes.byte() == 0 { null() } else { model };
    // SAFETY: arrays of `count` entries or null, or a count that is refused.
    let status = unsafe { nw_resolve_batch(model, from, to, bad) };
    known(status);
    for room in numbers.iter().chain(&marks).chain([&asked, &wanted, &first_bad]) {
        room.kept();
    }
    let of_an_impact = [NW_UNKNOWN_WALL, NW_BAD_STATE, NW_OUT_OF_RANGE].contains(&status);
    if of_an_impact && !bad.is_null() {
        // SAFETY: an index was written there.
        assert!(unsafe { bad.read_unaligned() } < count);
    } else {
        first_bad.untouched();
    }
    if status != NW_OK {
        return numbers.iter().chain(&marks).for_each(Room::untouched);
    }
    alike(model, from, &mut numbers, [e_n, e_t, p_stick, omega]);
}

/// The batch's numbers are those of its impacts one by one.
fn alike(model: *const nw_model, asked: *const nw_impacts, found: &mut [Room; 4], wanted: [*mut f64; 4]) {
    // SAFETY: a batch that was accepted.
    let asked = unsafe { asked.read_unaligned() };
    let usual = nw_impact::default();
    for index in 0..asked.count {
        // SAFETY: each array is null or has `count` entries.
        let at = |array: *const f64, usual| unsafe {
            if array.is_null() { usual } else { array.add(index).read_unaligned() }
        };
        let one = nw_impact {
            // SAFETY: as above.
            wall: if asked.walls.is_null() { asked.wall } else { unsafe { *asked.walls.add(index) } },
            v_n: at(asked.v_n, usual.v_n),
            v_t: at(asked.v_t, usual.v_t),
            d: at(asked.d, usual.d),
            T_p: at(asked.T_p, usual.T_p),
            T_w: at(asked.T_w, usual.T_w),
            conversion: at(asked.conversion, usual.conversion),
            layer_thickness: at(asked.layer_thickness, usual.layer_thickness),
            film_thickness: at(asked.film_thickness, usual.film_thickness),
            roughness: at(asked.roughness, usual.roughness),
            v_gas: at(asked.v_gas, usual.v_gas),
            omega: at(asked.omega, usual.omega),
            coverage: at(asked.coverage, usual.coverage),
            melt_thickness: at(asked.melt_thickness, usual.melt_thickness),
            seed: asked.seed,
            // SAFETY: as above.
            key: if asked.key.is_null() { index as u64 } else { unsafe { *asked.key.add(index) } },
            ..usual
        };
        let mut outcome = nw_outcome::default();
        // SAFETY: all on the stack.
        assert_eq!(unsafe { nw_resolve(model, &raw const one, &raw mut outcome) }, NW_OK);
        sane(&outcome);
        let expected = [outcome.e_n, outcome.e_t, outcome.p_stick, outcome.omega];
        for ((room, to), expected) in found.iter().zip(wanted).zip(expected) {
            if !to.is_null() {
                let bits = &room.inside()[8 * index..8 * index + 8];
                assert_eq!(bits, expected.to_ne_bytes(), "impact {index} of a batch");
            }
        }
    }
}
