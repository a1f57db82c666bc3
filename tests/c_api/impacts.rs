//! One impact: the bits of the Rust library, and every way to be refused.

use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use nearwall::c_api::*;
use nearwall::{Impact, ImpactError, ImpactRng, Model};

use crate::calls::{Calls, bytes, c_case, c_outcome, poisoned};
use crate::common::golden::golden_cases;
use crate::common::random::{EVERY_REGIME, hostile_cases, random_cases, seed};

/// The status that belongs to a refusal of the Rust library.
pub fn status_of(error: &ImpactError) -> i32 {
    match error {
        ImpactError::Unusable { .. } => NW_BAD_STATE,
        ImpactError::OutOfRange { .. } => NW_OUT_OF_RANGE,
        ImpactError::NoSuchWall(_) => NW_UNKNOWN_WALL,
    }
}

#[test]
fn golden_random_and_hostile_impacts_have_the_bits_of_the_rust_library() {
    let calls = Calls::load();
    let rust = Model::from_toml("m", EVERY_REGIME).unwrap();
    let model = calls.parse(EVERY_REGIME);
    let cases = [random_cases(seed(), 1000), hostile_cases()].concat();
    let mut refused = [0; 10];
    for case in &cases {
        let ours = calls.resolve(model, &c_case(case));
        match rust.resolve(case.0, &case.1, case.2) {
            Ok(theirs) => {
                assert_eq!(ours.map(|ours| bytes(&ours)), Ok(c_outcome(&theirs)), "{case:?}");
                let numbers = [theirs.normal_restitution, theirs.sticking_probability];
                assert!(numbers.iter().all(|number| (0.0..=1.0).contains(number)), "{case:?} {theirs:?}");
                assert!(!theirs.tangential_restitution.is_nan() && !theirs.spin.is_nan(), "{case:?}");
            }
            Err(error) => {
                assert_eq!(ours.map(|ours| bytes(&ours)), Err(status_of(&error)), "{case:?}");
                refused[status_of(&error) as usize] += 1;
            }
        }
    }
    calls.free(model);
    println!("{} impacts, refused by status: {refused:?}", cases.len());
    assert!([NW_UNKNOWN_WALL, NW_BAD_STATE, NW_OUT_OF_RANGE].iter().all(|s| refused[*s as usize] > 0));

    for (row, golden) in golden_cases().iter().enumerate() {
        let model = calls.parse(&golden.model());
        let impact = Impact { normal_speed: golden.v_n, diameter: golden.d, ..Impact::default() };
        let case = (0, impact, ImpactRng::default());
        let ours = calls.resolve(model, &c_case(&case)).unwrap();
        let rust = Model::from_toml("m", &golden.model()).unwrap();
        assert_eq!(bytes(&ours), c_outcome(&rust.resolve(0, &case.1, case.2).unwrap()), "case {row}");
        let agree = |ours: f64, golden: f64, absolute: f64| {
            let allowed = (1e-11 * golden.abs()).max(absolute);
            assert!((ours - golden).abs() <= allowed, "case {row}: {ours:e}, golden {golden:e}");
        };
        let [adhesive, yielding, sticking] = calls.speeds(model, &c_case(&case));
        agree(adhesive, golden.v_adh, 0.0);
        agree(yielding, golden.v_yield, 0.0);
        agree(sticking, golden.v_stick, 0.0);
        agree(ours.e_n, golden.e_n, 1e-9);
        calls.free(model);
    }
}

/// Density and erosion of particles, by both libraries, to the last bit; a wall without a law loses nothing.
#[test]
fn density_and_erosion_are_those_of_the_rust_library() {
    let calls = Calls::load();
    let text = format!("{EVERY_REGIME}\n[erosion]\nlaw = \"oka\"\nhardness = 2e9\n");
    let (rust, model, plain) =
        (Model::from_toml("m", &text).unwrap(), calls.parse(&text), calls.parse(EVERY_REGIME));
    for case in [random_cases(seed(), 200), hostile_cases()].concat() {
        let impact = c_case(&case);
        let (mut density, mut volume, mut none) = (-1.0, -1.0, -1.0);
        let statuses = unsafe {
            [
                (calls.nw_particle_density)(model, &raw const impact, &raw mut density),
                (calls.nw_erosion)(model, &raw const impact, 0.25, &raw mut volume),
                (calls.nw_erosion)(plain, &raw const impact, 0.25, &raw mut none),
            ]
        };
        match case.1.check().and_then(|()| rust.particle_density(&case.1)) {
            Ok(theirs) => assert_eq!((statuses[0], density), (NW_OK, theirs)),
            Err(error) => assert_eq!((statuses[0], density), (status_of(&error), -1.0)),
        }
        match rust.erosion(case.0, &case.1, 0.25) {
            Ok(theirs) if theirs.is_finite() => assert_eq!((statuses[1], volume, none), (NW_OK, theirs, 0.0)),
            Ok(_) => assert_eq!((statuses[1], volume), (NW_BAD_STATE, -1.0)),
            Err(error) => assert_eq!((statuses[1], volume, none), (status_of(&error), -1.0, -1.0)),
        }
    }
    let impact = nw_impact::default();
    let status = unsafe { (calls.nw_erosion)(model, &raw const impact, 1.0, null_mut()) };
    assert_eq!(status, NW_NULL_POINTER);
    calls.free(model);
    calls.free(plain);
}

/// Ranges by both libraries, a line each; empty exactly where no range is left.
#[test]
fn ranges_that_an_impact_leaves_are_named() {
    let calls = Calls::load();
    let (rust, model) = (Model::from_toml("m", EVERY_REGIME).unwrap(), calls.parse(EVERY_REGIME));
    let mut left = 0;
    for case in random_cases(seed(), 200) {
        let (impact, mut text) = (c_case(&case), [1 as std::ffi::c_char; 4000]);
        let status = unsafe { (calls.nw_beyond)(model, &raw const impact, text.as_mut_ptr(), text.len()) };
        match rust.beyond(case.0, &case.1) {
            Ok(beyond) => {
                let end = text.iter().position(|byte| *byte == 0).unwrap();
                let said: String = text[..end].iter().map(|byte| char::from(*byte as u8)).collect();
                let lines: Vec<String> = beyond.iter().map(nearwall::model::Beyond::stated).collect();
                assert_eq!((status, said), (NW_OK, lines.join("\n")));
                left += usize::from(!beyond.is_empty());
            }
            Err(error) => assert_eq!(status, status_of(&error)),
        }
    }
    assert!(left > 20, "{left} left a range");
    let impact = nw_impact::default();
    assert_eq!(unsafe { (calls.nw_beyond)(model, &raw const impact, null_mut(), 9) }, NW_NULL_POINTER);
    calls.free(model);
}

/// A temperature in degrees Celsius and a diameter in micrometres are seen; ordinary impacts pass in silence.
#[test]
fn unlikely_units_are_named() {
    let calls = Calls::load();
    let said = |impact: Impact, room: usize| {
        let (impact, mut text) = (c_case(&(0, impact, ImpactRng::default())), [1 as std::ffi::c_char; 200]);
        let status = unsafe { (calls.nw_unlikely)(&raw const impact, text.as_mut_ptr(), room) };
        let end = text.iter().position(|byte| *byte == 0).unwrap_or(0);
        (status, text[..end].iter().map(|byte| char::from(*byte as u8)).collect::<String>())
    };
    let ordinary = Impact { normal_speed: 2.0, ..Impact::default() };
    assert_eq!(said(ordinary, 200), (NW_OK, String::new()));
    assert_eq!(said(Impact { wall_temperature: 25.0, ..ordinary }, 14), (NW_OK, "T_w = 25 K; i".to_owned()));
    let large = said(Impact { diameter: 75.0, ..ordinary }, 200).1;
    assert_eq!(large, "d = 75 m is unusually large; check its unit");
    let impact = nw_impact::default();
    assert_eq!(unsafe { (calls.nw_unlikely)(&raw const impact, null_mut(), 9) }, NW_NULL_POINTER);
    let wrong = nw_impact { struct_size: 8, ..impact };
    let mut text = [0 as std::ffi::c_char; 9];
    assert_eq!(unsafe { (calls.nw_unlikely)(&raw const wrong, text.as_mut_ptr(), 9) }, NW_STRUCT_SIZE);
}

/// The key is that of the Rust library, from values at any address; a refusal leaves it untouched.
#[test]
fn keys_of_values() {
    let calls = Calls::load();
    let values = [0.25_f64, -0.5, 75e-6, 1300.0, 2.0];
    let mut bytes = vec![0_u8];
    bytes.extend(values.iter().flat_map(|value| value.to_ne_bytes()));
    let mut key = 0;
    let odd = bytes[1..].as_ptr().cast::<f64>();
    assert_eq!(unsafe { (calls.nw_key_of_values)(odd, values.len(), &raw mut key) }, NW_OK);
    assert_eq!((key, Some(key)), (0x7304_CDEA_CCF4_7FD1, nearwall::key::key_of_values(values.into_iter())));
    let refusals = [
        (unsafe { (calls.nw_key_of_values)(values.as_ptr(), 0, &raw mut key) }, NW_BAD_STATE),
        (unsafe { (calls.nw_key_of_values)([1.0, f64::NAN].as_ptr(), 2, &raw mut key) }, NW_BAD_STATE),
        (unsafe { (calls.nw_key_of_values)(values.as_ptr(), usize::MAX, &raw mut key) }, NW_STRUCT_SIZE),
        (unsafe { (calls.nw_key_of_values)(null(), 1, &raw mut key) }, NW_NULL_POINTER),
        (unsafe { (calls.nw_key_of_values)(values.as_ptr(), 1, null_mut()) }, NW_NULL_POINTER),
    ];
    assert!(refusals.iter().all(|(status, expected)| status == expected), "{refusals:?}");
    assert_eq!(key, 0x7304_CDEA_CCF4_7FD1);
}

/// The reason of a refusal is that of the Rust library, cut to the caller's room.
#[test]
fn a_refusal_is_explained() {
    let calls = Calls::load();
    let tabled = "[materials.tabled]\ndensity = 1000\npoisson_ratio = 0.4\nyield_strength = 1e7\nsurface_energy = 0.03\n\
                  youngs_modulus = { T = [290, 400], value = [1e9, 5e8] }\n[particle]\nmaterial = \"tabled\"\n\
                  [walls.default]\nmaterial = \"pyrex\"\n[normal]\nmodel = \"thornton-ning\"\nyield_ratio = 1\n\
                  [tangential]\nmodel = \"constant\"\ne_t = 0.8\n";
    let (rust, model) = (Model::from_toml("m", tabled).unwrap(), calls.parse(tabled));
    let hot = Impact { normal_speed: 2.0, diameter: 5e-5, particle_temperature: 2000.0, ..Impact::default() };
    let warm = Impact { particle_temperature: 350.0, ..hot };
    let explain = |impact: Impact, room: usize| {
        let (impact, mut text) = (c_case(&(0, impact, ImpactRng::default())), [1 as std::ffi::c_char; 200]);
        let status = unsafe { (calls.nw_explain)(model, &raw const impact, text.as_mut_ptr(), room) };
        let end = text.iter().position(|byte| *byte == 0).unwrap_or(0);
        (status, text[..end].iter().map(|byte| char::from(*byte as u8)).collect::<String>())
    };
    let reason = rust.check(0, &hot).unwrap_err();
    assert!(
        reason.to_string().contains("youngs_modulus") && reason.to_string().contains("290 to 400 K"),
        "{reason}"
    );
    assert_eq!(explain(hot, 200), (status_of(&reason), reason.to_string()));
    assert_eq!(explain(hot, 9), (status_of(&reason), reason.to_string()[..8].to_owned()));
    assert_eq!(explain(warm, 200).0, NW_OK);
    calls.free(model);
}

#[test]
fn initialised_structs_are_the_defaults() {
    let calls = Calls::load();
    unsafe {
        let mut outcome = poisoned();
        assert_eq!((calls.nw_outcome_init)(&raw mut outcome), NW_OK);
        assert_eq!(bytes(&outcome), bytes(&nw_outcome::default()));
        let mut impact: nw_impact = std::mem::zeroed();
        assert_eq!((calls.nw_impact_init)(&raw mut impact), NW_OK);
        assert_eq!(
            format!("{impact:?}"),
            format!("{:?}", c_case(&(0, Impact::default(), ImpactRng::default())))
        );
        assert_eq!((calls.nw_impact_init)(null_mut()), NW_NULL_POINTER);
        assert_eq!((calls.nw_outcome_init)(null_mut()), NW_NULL_POINTER);
    }
}

#[test]
fn null_pointers_and_other_sizes_are_refused() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let impact = nw_impact { v_n: 1.0, ..nw_impact::default() };
    assert_eq!(calls.resolve(null(), &impact).map(|_| ()), Err(NW_NULL_POINTER));
    let size = size_of::<nw_impact>() as u32;
    for struct_size in [0, 1, 4, size - 8, size - 1, size + 1, size + 8, u32::MAX] {
        let other = nw_impact { struct_size, ..impact };
        assert_eq!(calls.resolve(model, &other).map(|_| ()), Err(NW_STRUCT_SIZE));
        let speeds =
            unsafe { (calls.nw_speeds)(model, &raw const other, null_mut(), null_mut(), null_mut()) };
        assert_eq!(speeds, NW_STRUCT_SIZE);
    }
    let size = size_of::<nw_outcome>() as u32;
    for struct_size in [0, 1, 4, size - 8, size - 1, size + 1, size + 8, u32::MAX] {
        let mut outcome = nw_outcome { struct_size, ..poisoned() };
        let before = bytes(&outcome);
        let status = unsafe { (calls.nw_resolve)(model, &raw const impact, &raw mut outcome) };
        assert_eq!((status, bytes(&outcome)), (NW_STRUCT_SIZE, before));
    }
    unsafe {
        let mut outcome = poisoned();
        assert_eq!((calls.nw_resolve)(model, null(), &raw mut outcome), NW_NULL_POINTER);
        assert_eq!(bytes(&outcome), bytes(&poisoned()));
        assert_eq!((calls.nw_resolve)(model, &raw const impact, null_mut()), NW_NULL_POINTER);
        calls.free(model);
    }
}

/// The header asks for no more. What is unset must have no influence; `tests/hard full` runs this
/// under the memory sanitizer.
#[test]
fn an_outcome_needs_no_more_than_its_size() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let impact = nw_impact { v_n: 1.0, ..nw_impact::default() };
    let expected = calls.resolve(model, &impact).unwrap();
    let mut outcome = MaybeUninit::<nw_outcome>::uninit();
    let found = unsafe {
        (&raw mut (*outcome.as_mut_ptr()).struct_size).write(size_of::<nw_outcome>() as u32);
        assert_eq!((calls.nw_resolve)(model, &raw const impact, outcome.as_mut_ptr()), NW_OK);
        calls.free(model);
        outcome.assume_init()
    };
    assert_eq!(bytes(&found), bytes(&expected));
}

#[test]
fn speeds_are_written_where_wanted_and_never_on_failure() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let rust = Model::from_toml("m", EVERY_REGIME).unwrap();
    let case = (
        1,
        Impact { normal_speed: 1.0, wall_temperature: 1200.0, ..Impact::default() },
        ImpactRng::default(),
    );
    let speeds = rust.speeds(1, &case.1).unwrap();
    let expected = [speeds.adhesive, speeds.yielding, speeds.sticking];
    let impact = c_case(&case);
    for wanted in 0..8 {
        let mut found = [-1.0; 3];
        let [a, b, c] =
            std::array::from_fn(|i| if wanted >> i & 1 == 1 { &raw mut found[i] } else { null_mut() });
        assert_eq!(unsafe { (calls.nw_speeds)(model, &raw const impact, a, b, c) }, NW_OK);
        let allowed: [f64; 3] =
            std::array::from_fn(|i| if wanted >> i & 1 == 1 { expected[i] } else { -1.0 });
        assert_eq!(found, allowed);
    }
    let refuse = |model: *const nw_model, impact: *const nw_impact| {
        let mut found = [-1.0; 3];
        let [a, b, c] = found.each_mut().map(std::ptr::from_mut);
        let status = unsafe { (calls.nw_speeds)(model, impact, a, b, c) };
        assert_eq!(found, [-1.0; 3]);
        status
    };
    assert_eq!(refuse(null(), &raw const impact), NW_NULL_POINTER);
    assert_eq!(refuse(model, null()), NW_NULL_POINTER);
    assert_eq!(refuse(model, &nw_impact { d: f64::NAN, ..impact }), NW_BAD_STATE);
    assert_eq!(refuse(model, &nw_impact { wall: 3, ..impact }), NW_UNKNOWN_WALL);
    assert_eq!(refuse(model, &nw_impact { wall: 2, ..impact }), NW_OUT_OF_RANGE);
    calls.free(model);
}

/// C forbids it, but Fortran, Python and packed structs hand such pointers over.
#[test]
fn structs_need_no_alignment() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let impact = nw_impact { v_n: 2.0, v_t: 1.0, ..nw_impact::default() };
    let expected = bytes(&calls.resolve(model, &impact).unwrap());
    let mut room = [0_u8; 512];
    for offset in 1..8 {
        unsafe {
            let inside = room.as_mut_ptr().add(offset).cast::<nw_impact>();
            inside.write_unaligned(impact);
            let outside = room.as_mut_ptr().add(offset + size_of::<nw_impact>()).cast::<nw_outcome>();
            outside.write_unaligned(nw_outcome::default());
            assert_eq!((calls.nw_resolve)(model, inside, outside), NW_OK);
            assert_eq!(bytes(&outside.read_unaligned()), expected);
        }
    }
    calls.free(model);
}

#[test]
fn temperature_ranges_are_those_of_the_model() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let rust = Model::from_toml("m", EVERY_REGIME).unwrap();
    for wall in 0..rust.walls().len() {
        let ranges = rust.temperature_ranges(wall).unwrap();
        let mut found = [-1.0; 4];
        let [a, b, c, d] = found.each_mut().map(std::ptr::from_mut);
        let status = unsafe { (calls.nw_temperature_ranges)(model, wall as u32, a, b, c, d) };
        assert_eq!(status, NW_OK);
        assert_eq!(found[..2], ranges.particle);
        assert_eq!(found[2..], ranges.wall);
    }
    let none = null_mut();
    unsafe {
        assert_eq!((calls.nw_temperature_ranges)(model, 99, none, none, none, none), NW_UNKNOWN_WALL);
        assert_eq!((calls.nw_temperature_ranges)(null(), 0, none, none, none, none), NW_NULL_POINTER);
        assert_eq!((calls.nw_temperature_ranges)(model, 0, none, none, none, none), NW_OK);
        calls.free(model);
    }
}

/// A walk of the C interface has the statistics of its wall: 4000 walks of 60 steps at y+ = 20.
#[test]
fn walks_have_the_fluctuations_of_the_wall() {
    let calls = Calls::load();
    let (count, mut squares) = (4000, [0.0; 3]);
    for key in 0..count {
        let mut walk = nw_walk::default();
        assert_eq!(unsafe { (calls.nw_walk_init)(&raw mut walk) }, NW_OK);
        (walk.seed, walk.key) = (7, key);
        (walk.friction_velocity, walk.kinematic_viscosity, walk.wall_distance) = (0.3, 1.5e-5, 1e-3);
        (walk.normal, walk.flow) = ([0.0, 0.0, 1.0], [5.0, 0.0, 0.0]);
        // So heavy that it is not pushed off the wall.
        (walk.duration, walk.relaxation_time) = (1e-4, 1e9);
        for step in 1..=60 {
            assert_eq!(unsafe { (calls.nw_walk_advance)(&raw mut walk) }, NW_OK);
            assert_eq!(walk.step, step);
        }
        (0..3).for_each(|axis| squares[axis] += walk.velocity[axis].powi(2) / count as f64);
    }
    // The fits by hand at y+ = 20, along x, y (across) and z (away).
    for (square, expected) in squares.into_iter().zip([2.5704, 1.3127, 0.6594]) {
        let ratio = square.sqrt() / (0.3 * expected);
        assert!((ratio - 1.0).abs() < 5.0 / f64::sqrt(2.0 * count as f64), "{expected}: {ratio}");
    }
    let mut walk = nw_walk::default();
    assert_eq!(unsafe { (calls.nw_walk_advance)(&raw mut walk) }, NW_BAD_STATE);
    let mut force = 1.0;
    let call = calls.nw_thermophoresis;
    assert_eq!(unsafe { call(300.0, 1.2, 1.8e-5, 0.026, 0.0, 1e-6, 0.0, &raw mut force) }, NW_BAD_STATE);
    assert_eq!(force, 1.0);
    // By hand in a dense gas: -6 pi 1.17 K/(1 + 2 K) mu² d/(rho T) with K = 0.026.
    assert_eq!(unsafe { call(300.0, 1.2, 1.8e-5, 0.026, 0.0, 1e-6, 1.0, &raw mut force) }, NW_OK);
    assert!((force / -4.905e-19 - 1.0).abs() < 1e-3, "{force}");
}
