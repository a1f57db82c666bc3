//! The C interface: the bytes are a program of calls with hostile pointers, sizes, numbers and texts.
//!
//! What the header asks of a caller is kept: a pointer that is not null points to what it should, though on any address
//! where the header asks for no alignment, and an array is as long as its count where a count is accepted.

use std::ffi::{CStr, CString, c_char};
use std::ptr::{null, null_mut};

use nearwall::c_api::*;

use super::bytes::Bytes;

const MODELS: [&str; 2] = [
    include_str!("../../tutorials/slaggingGasifier/constant/nearWall.toml"),
    "[particle]\nmaterial = \"montan-wax\"\n[walls.\"w.*\"]\nmaterial = \"pyrex\"\n[walls.hot]\nmaterial = \
     \"stainless-steel\"\n[normal]\nmodel = \"thornton-ning\"\nyield_ratio = 0.7\n[tangential]\nmodel = \
     \"sliding-rolling\"\nfriction = 0.3\n[[effects]]\nkind = \"melting-transition\"\ntemperature = 360\nwidth = 7\n",
];

/// What no call may write over.
const POISON: u8 = 0xA5;

/// Runs the program: no crash, no panic, nothing written on failure, nothing written beyond.
pub fn c_api(bytes: &[u8]) {
    let mut bytes = Bytes(bytes);
    let mut model = parsed(MODELS[bytes.below(MODELS.len())]);
    let mut steps = 0;
    while !bytes.is_empty() && steps < 100 {
        steps += 1;
        match bytes.byte() % 9 {
            0 => parse(&mut bytes),
            1 => load(&mut bytes),
            2 => find_wall(&mut bytes, model),
            3 => one(&mut bytes, model),
            4 => speeds(&mut bytes, model),
            5 => ranges(&mut bytes, model),
            6 => batch(&mut bytes, model),
            7 => texts(&mut bytes),
            _ => {
                // SAFETY: our own model, freed once.
                unsafe { nw_model_free(model) };
                model = parsed(MODELS[bytes.below(MODELS.len())]);
            }
        }
    }
    // SAFETY: as above.
    unsafe { nw_model_free(model) };
}

fn parsed(toml: &str) -> *mut nw_model {
    let mut model = null_mut();
    // SAFETY: the size is that of the text.
    let status =
        unsafe { nw_model_parse(toml.as_ptr().cast(), toml.len(), null(), &raw mut model, null_mut(), 0) };
    assert_eq!(status, NW_OK);
    model
}

/// Room on any address, with poison around.
struct Room {
    bytes: Vec<u8>,
    offset: usize,
    size: usize,
}

impl Room {
    fn new(bytes: &mut Bytes<'_>, size: usize) -> Self {
        let offset = bytes.below(16);
        Self { bytes: vec![POISON; offset + size + 16], offset, size }
    }

    fn holding<T: Copy>(bytes: &mut Bytes<'_>, value: T) -> Self {
        let mut room = Self::new(bytes, size_of::<T>());
        // SAFETY: as large as a `T`.
        unsafe { room.start::<T>().write_unaligned(value) };
        room
    }

    fn start<T>(&mut self) -> *mut T {
        self.bytes[self.offset..].as_mut_ptr().cast()
    }

    /// The room, or no room at all.
    fn perhaps<T>(&mut self, bytes: &mut Bytes<'_>) -> *mut T {
        if bytes.byte() == 0 { null_mut() } else { self.start() }
    }

    fn inside(&self) -> &[u8] {
        &self.bytes[self.offset..self.offset + self.size]
    }

    /// Nothing around was written.
    fn kept(&self) {
        let end = self.offset + self.size;
        let around = self.bytes[..self.offset].iter().chain(&self.bytes[end..]);
        assert!(around.copied().all(|byte| byte == POISON), "written beside");
    }

    fn untouched(&self) {
        assert!(self.bytes.iter().all(|byte| *byte == POISON), "written on failure");
    }

    fn f64(&mut self) -> f64 {
        // SAFETY: as large as a number.
        unsafe { self.start::<f64>().read_unaligned() }
    }
}

fn known(status: nw_status) {
    assert!((NW_OK..NW_PANIC).contains(&status), "status {status}");
}

/// A call that makes a model and may leave a message.
fn making(
    bytes: &mut Bytes<'_>,
    call: impl FnOnce(*mut *mut nw_model, *mut c_char, usize) -> nw_status,
) -> nw_status {
    let size = [0, 1, 2, 3, 40, 400][bytes.below(6)];
    let mut message = Room::new(bytes, size);
    let mut handle = Room::new(bytes, size_of::<*mut nw_model>());
    let (to, text) = (handle.perhaps(bytes), message.perhaps(bytes));
    let status = call(to, text, size);
    known(status);
    message.kept();
    handle.kept();
    if status == NW_OK {
        message.untouched();
        // SAFETY: a model was written there.
        unsafe { nw_model_free(to.read_unaligned()) };
    } else {
        handle.untouched();
        if text.is_null() || size == 0 {
            message.untouched();
        } else {
            let text = CStr::from_bytes_until_nul(message.inside()).expect("a closing zero");
            text.to_str().expect("whole characters");
        }
    }
    status
}

/// A model with some of its bytes replaced.
fn parse(bytes: &mut Bytes<'_>) {
    let mut toml = MODELS[bytes.below(MODELS.len())].as_bytes().to_vec();
    let at = bytes.word() as u16 as usize % toml.len();
    let (cut, put) = (bytes.below(8), bytes.below(12));
    let end = (at + cut).min(toml.len());
    toml.splice(at..end, bytes.take(put).iter().copied());
    let name = c_text(bytes);
    let name = if bytes.byte() == 0 { null() } else { name.as_ptr() };
    let (text, size) = match bytes.byte() {
        0 => (null(), toml.len()),
        1 => (toml.as_ptr().cast(), usize::MAX),
        2 => (toml.as_ptr().cast(), isize::MAX as usize + 1),
        3 => (toml.as_ptr().cast(), 0),
        4 => (null(), 0),
        cut if cut < 128 => (toml.as_ptr().cast(), toml.len() - usize::from(cut).min(toml.len())),
        _ => (toml.as_ptr().cast(), toml.len()),
    };
    // SAFETY: no more bytes than the text has, or a size that is refused.
    making(bytes, |model, message, room| unsafe { nw_model_parse(text, size, name, model, message, room) });
}

/// Some bytes, not always UTF-8, up to their first zero.
fn c_text(bytes: &mut Bytes<'_>) -> CString {
    let count = bytes.below(40);
    let text: Vec<u8> = bytes.take(count).iter().copied().take_while(|byte| *byte != 0).collect();
    CString::new(text).expect("no zero is left")
}

fn load(bytes: &mut Bytes<'_>) {
    let text = c_text(bytes);
    let nowhere = CString::new([b"/nowhere/", text.as_bytes()].concat()).expect("no zero");
    let path = match bytes.byte() {
        0 => null(),
        1 => c"".as_ptr(),
        2 => c"/".as_ptr(),
        3 => c"/dev/null".as_ptr(),
        4 => c"/proc/self/cmdline".as_ptr(),
        _ => nowhere.as_ptr(),
    };
    // SAFETY: zero-terminated or null.
    let status = making(bytes, |model, message, room| unsafe { nw_model_load(path, model, message, room) });
    assert_ne!(status, NW_OK, "none of these is a model");
}

fn find_wall(bytes: &mut Bytes<'_>, model: *const nw_model) {
    let name = c_text(bytes);
    let mut wall = Room::new(bytes, 4);
    let to = wall.perhaps(bytes);
    let model = if bytes.byte() == 0 { null() } else { model };
    let name = if bytes.byte() == 0 { null() } else { name.as_ptr() };
    // SAFETY: a live model, a zero-terminated text, a number that can be written, or null.
    let status = unsafe { nw_model_find_wall(model, name, to) };
    known(status);
    wall.kept();
    if status != NW_OK {
        wall.untouched();
    }
}

/// An impact of which most is ordinary.
fn impact(bytes: &mut Bytes<'_>) -> nw_impact {
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
    if which >> 12 & 1 == 1 {
        impact.wall = bytes.word() as u32;
    } else {
        impact.wall = (which >> 13 & 1) as u32;
    }
    (impact.seed, impact.key) = (which >> 32, which >> 48);
    if which >> 14 & 3 == 3 {
        impact.struct_size = bytes.word() as u32;
    }
    impact
}

fn size_is_known(size: u32, right: usize) -> bool {
    size as usize == right
}

/// One impact, resolved where it stands and once more on an even address.
fn one(bytes: &mut Bytes<'_>, model: *const nw_model) {
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

fn speeds(bytes: &mut Bytes<'_>, model: *const nw_model) {
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

fn ranges(bytes: &mut Bytes<'_>, model: *const nw_model) {
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
fn batch(bytes: &mut Bytes<'_>, model: *const nw_model) {
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
        layer_thickness: null(),
        film_thickness,
        v_gas: v_n,
        roughness: null(),
        omega,
        coverage,
        key: null(),
        melt_thickness: film_thickness,
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
            film_thickness: at(asked.film_thickness, usual.film_thickness),
            v_gas: at(asked.v_gas, usual.v_gas),
            omega: at(asked.omega, usual.omega),
            coverage: at(asked.coverage, usual.coverage),
            melt_thickness: at(asked.melt_thickness, usual.melt_thickness),
            seed: asked.seed,
            key: index as u64,
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

fn texts(bytes: &mut Bytes<'_>) {
    let number = bytes.word();
    // SAFETY: static texts.
    let (status, regime) = unsafe {
        (CStr::from_ptr(nw_status_text(number as i32)), CStr::from_ptr(nw_regime_name(number as u32)))
    };
    assert!(status.to_bytes().len() > 3 && regime.to_bytes().len() > 3);
    let mut room = Room::new(bytes, size_of::<nw_impact>());
    let to = room.perhaps(bytes);
    // SAFETY: null or room for an impact.
    known(unsafe { nw_impact_init(to) });
    room.kept();
    let mut room = Room::new(bytes, size_of::<nw_outcome>());
    let to = room.perhaps(bytes);
    // SAFETY: null or room for an outcome.
    known(unsafe { nw_outcome_init(to) });
    room.kept();
}
