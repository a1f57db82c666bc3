//! A wall's deposit through the C library: the numbers of the Rust library, and every way to be refused.

use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use nearwall::c_api::*;
use nearwall::deposit::{Deposit, DepositSource};
use nearwall::{Impact, Model};

use crate::calls::Calls;
use crate::common::random::{EVERY_REGIME, random_cases, seed};

/// One wall after many particles, by both libraries, to the last bit.
#[test]
fn a_wall_grows_as_in_the_rust_library() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let rust = Model::from_toml("m", EVERY_REGIME).unwrap();
    let mut deposit = nw_deposit::default();
    let mut expected = Deposit::default();
    let mut both = [0, 0];
    for (_, impact, draw) in random_cases(seed(), 300) {
        let impact = Impact { layer_thickness: 0.0, coverage: 0.0, melt_thickness: 0.0, ..impact };
        let (mass, density) = (0.1 * draw.uniform(1), 500.0 + 2000.0 * draw.uniform(2));
        let bare = nw_impact { wall: 1, ..nw_impact::from(&impact) };
        let mut source = nw_deposit_source::default();
        let mut dressed = bare;
        unsafe {
            assert_eq!((calls.nw_deposit_apply)(model, &raw const deposit, 0.4, &raw mut dressed), NW_OK);
            let status =
                (calls.nw_deposit_source_add)(model, &raw const dressed, mass, density, &raw mut source);
            assert_eq!(status, NW_OK);
        }
        let met = rust.apply_deposit(1, &expected, 0.4, &impact).unwrap();
        let found = [dressed.layer_thickness, dressed.coverage, dressed.melt_thickness];
        assert_eq!(found, [met.layer_thickness, met.coverage, met.melt_thickness]);
        let stayed = rust.add_captured(1, &met, mass, density, DepositSource::default()).unwrap();
        both[usize::from(stayed.molten > 0.0)] += 1;
        assert_eq!((source.count, source.molten, source.powder), (1, stayed.molten, stayed.powder));
        assert_eq!(unsafe { (calls.nw_deposit_add)(&raw const source, &raw mut deposit) }, NW_OK);
        expected = expected.with(&stayed);
        let nw_deposit { molten, powder, solid, cover, conversion, .. } = deposit;
        assert_eq!(Deposit { molten, powder, solid, cover, conversion }, expected);
    }
    calls.free(model);
    assert!(both.iter().all(|count| *count > 20), "{both:?}");
}

/// A deposit that starts may lie anywhere and be unset but for its size and its wall.
#[test]
fn a_deposit_starts_from_its_wall() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let mut expected = nw_deposit { wall: 1, ..nw_deposit::default() };
    let mut bytes = [MaybeUninit::<u8>::uninit(); size_of::<nw_deposit>() + 1];
    let found = unsafe {
        assert_eq!((calls.nw_deposit_initial)(model, 0.4, &raw mut expected), NW_OK);
        let deposit = bytes.as_mut_ptr().add(1).cast::<nw_deposit>();
        (&raw mut (*deposit).struct_size).write_unaligned(size_of::<nw_deposit>() as u32);
        (&raw mut (*deposit).wall).write_unaligned(1);
        assert_eq!((calls.nw_deposit_initial)(model, 0.4, deposit), NW_OK);
        calls.free(model);
        deposit.read_unaligned()
    };
    assert_eq!(format!("{found:?}"), format!("{expected:?}"));
}

/// Nusselt's film of 1 mm of slag, by hand: 2750 * 9.81 * 1e-6/(3 mu).
#[test]
fn the_film_runs_as_nusselt_says() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let deposit = nw_deposit { wall: 1, molten: 2.75, ..nw_deposit::default() };
    let mut velocity = -1.0;
    let ask = |deposit: &nw_deposit, t_w: f64, g: f64, out: *mut f64| unsafe {
        (calls.nw_film_velocity)(model, deposit, t_w, g, out)
    };
    assert_eq!(ask(&deposit, 1600.0, 9.81, &raw mut velocity), NW_OK);
    let law = &nearwall::slag::urbain::KALMANOVITCH_FRANK;
    let oxides = [
        ("SiO2", 45.0),
        ("Al2O3", 18.0),
        ("FeO", 18.0),
        ("CaO", 7.0),
        ("MgO", 1.0),
        ("Na2O", 0.6),
        ("K2O", 1.9),
        ("TiO2", 1.0),
        ("P2O5", 0.2),
    ];
    let viscosity = law.at(&nearwall::slag::Composition::new(oxides).unwrap(), 1600.0);
    let by_hand = 2750.0 * 9.81 * 1e-6 / (3.0 * viscosity);
    assert!((velocity / by_hand - 1.0).abs() < 1e-12, "{velocity} {by_hand}");
    assert_eq!(ask(&deposit, 1600.0, 0.0, &raw mut velocity), NW_OK);
    assert_eq!(velocity, 0.0);

    let mut kept = -1.0;
    for (t_w, g) in [(0.0, 9.81), (f64::NAN, 9.81), (1600.0, -1.0), (1600.0, f64::INFINITY)] {
        assert_eq!(ask(&deposit, t_w, g, &raw mut kept), NW_BAD_STATE);
    }
    let bad = nw_deposit { molten: -1.0, ..deposit };
    assert_eq!(ask(&bad, 1600.0, 9.81, &raw mut kept), NW_BAD_STATE);
    let nowhere = nw_deposit { wall: 77, ..deposit };
    assert_eq!(ask(&nowhere, 1600.0, 9.81, &raw mut kept), NW_UNKNOWN_WALL);
    assert_eq!(ask(&deposit, 1600.0, 9.81, null_mut()), NW_NULL_POINTER);
    assert_eq!(kept, -1.0);
    calls.free(model);
}

#[test]
fn what_cannot_be_is_refused_and_nothing_written() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let impact = nw_impact { v_n: 1.0, T_p: 1600.0, T_w: 1600.0, ..nw_impact::default() };
    unsafe {
        let mut deposit = nw_deposit { wall: 9, molten: 9.0, ..nw_deposit::default() };
        assert_eq!((calls.nw_deposit_init)(&raw mut deposit), NW_OK);
        assert_eq!(format!("{deposit:?}"), format!("{:?}", nw_deposit::default()));
        let mut source = nw_deposit_source { count: 9, molten: 9.0, ..nw_deposit_source::default() };
        assert_eq!((calls.nw_deposit_source_init)(&raw mut source), NW_OK);
        assert_eq!(format!("{source:?}"), format!("{:?}", nw_deposit_source::default()));
        assert_eq!((calls.nw_deposit_init)(null_mut()), NW_NULL_POINTER);
        assert_eq!((calls.nw_deposit_source_init)(null_mut()), NW_NULL_POINTER);

        let mut start = nw_deposit { wall: 2, molten: 9.0, ..nw_deposit::default() };
        assert_eq!((calls.nw_deposit_initial)(model, 0.4, &raw mut start), NW_OK);
        // 10 um of powder with 0.4 voids, of the fly ash's 2300 kg/m3.
        assert!((start.powder / (6e-6 * 2300.0) - 1.0).abs() < 1e-14, "{start:?}");
        assert_eq!((start.molten, start.solid, start.wall), (0.0, 6e-6, 2));
        let kept = format!("{start:?}");
        assert_eq!((calls.nw_deposit_initial)(model, 1.0, &raw mut start), NW_BAD_STATE);
        assert_eq!((calls.nw_deposit_initial)(null(), 0.4, &raw mut start), NW_NULL_POINTER);
        assert_eq!((calls.nw_deposit_initial)(model, 0.4, null_mut()), NW_NULL_POINTER);
        assert_eq!(format!("{start:?}"), kept);

        let mut add = |model, impact: *const nw_impact, mass, density| {
            let before = format!("{source:?}");
            let status = (calls.nw_deposit_source_add)(model, impact, mass, density, &raw mut source);
            assert_eq!(format!("{source:?}"), before);
            status
        };
        assert_eq!(add(null(), &raw const impact, 1.0, 1e3), NW_NULL_POINTER);
        assert_eq!(add(model, null(), 1.0, 1e3), NW_NULL_POINTER);
        for (mass, density) in [(-1.0, 1e3), (f64::NAN, 1e3), (1.0, 0.0), (1.0, f64::INFINITY)] {
            assert_eq!(add(model, &raw const impact, mass, density), NW_BAD_STATE);
        }
        let old = nw_impact { struct_size: impact.struct_size - 8, ..impact };
        assert_eq!(add(model, &raw const old, 1.0, 1e3), NW_STRUCT_SIZE);
        let nowhere = nw_impact { wall: 77, ..impact };
        assert_eq!(add(model, &raw const nowhere, 1.0, 1e3), NW_UNKNOWN_WALL);

        let mut grow = |source: *const nw_deposit_source| {
            let before = format!("{deposit:?}");
            let status = (calls.nw_deposit_add)(source, &raw mut deposit);
            assert_eq!(format!("{deposit:?}"), before);
            status
        };
        assert_eq!(grow(null()), NW_NULL_POINTER);
        assert_eq!(grow(&nw_deposit_source { buried: -1.0, ..nw_deposit_source::default() }), NW_BAD_STATE);
        assert_eq!(
            grow(&nw_deposit_source { struct_size: 8, ..nw_deposit_source::default() }),
            NW_STRUCT_SIZE
        );

        let dress = |deposit: &nw_deposit, voidage| {
            let mut dressed = impact;
            let status = (calls.nw_deposit_apply)(model, deposit, voidage, &raw mut dressed);
            assert_eq!(format!("{dressed:?}"), format!("{impact:?}"));
            status
        };
        for voidage in [-0.1, 1.0, f64::NAN] {
            assert_eq!(dress(&nw_deposit::default(), voidage), NW_BAD_STATE);
        }
        assert_eq!(dress(&nw_deposit { cover: f64::NAN, ..nw_deposit::default() }, 0.5), NW_BAD_STATE);
        assert_eq!(dress(&nw_deposit { struct_size: 0, ..nw_deposit::default() }, 0.5), NW_STRUCT_SIZE);
        calls.free(model);
    }
}

/// What is written can be given to every other call: sums, heights and speeds that overflow are refused.
#[test]
fn what_overflows_is_refused_and_nothing_written() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let impact = nw_impact { v_n: 1.0, T_p: 1600.0, T_w: 1600.0, ..nw_impact::default() };
    let huge = nw_deposit { wall: 1, molten: f64::MAX, solid: f64::MAX, ..nw_deposit::default() };
    let many = nw_deposit_source { molten: f64::MAX, powder: 1e300, ..nw_deposit_source::default() };
    unsafe {
        let (mut deposit, mut source, mut dressed, mut velocity) = (huge, many, impact, -1.0);
        let found = [
            (calls.nw_deposit_add)(&raw const many, &raw mut deposit),
            (calls.nw_deposit_source_add)(model, &raw const impact, f64::MAX, 1e-300, &raw mut source),
            (calls.nw_deposit_apply)(model, &raw const huge, 0.5, &raw mut dressed),
            (calls.nw_film_velocity)(model, &raw const huge, 1600.0, 9.81, &raw mut velocity),
        ];
        assert_eq!(found, [NW_BAD_STATE; 4]);
        assert_eq!(format!("{deposit:?}{source:?}{dressed:?}"), format!("{huge:?}{many:?}{impact:?}"));
        assert_eq!(velocity, -1.0);
        let no_number = nw_deposit_source { converted: f64::NAN, ..nw_deposit_source::default() };
        source = no_number;
        let status = (calls.nw_deposit_source_add)(model, &raw const impact, 1.0, 1e3, &raw mut source);
        assert_eq!((status, source.count), (NW_BAD_STATE, 0));
        calls.free(model);
    }
}
