//! A wall's deposit and its temperatures through the C library: the numbers of the Rust library,
//! and every way to be refused.

use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use nearwall::c_api::*;
use nearwall::deposit::conduction::{Coolant, HotSide};
use nearwall::deposit::{
    Deposit, DepositSource, Losses, PROCESSES, Surroundings, VapourSide, VoidGas, WallGas,
};
use nearwall::model::{WallCooling, WallHeat};
use nearwall::{Impact, Model};

use crate::calls::Calls;
use crate::common::random::{EVERY_REGIME, random_cases, seed};
use crate::impacts::status_of;

/// Glass on glass, with heat of contact.
const GLASS: &str = r#"
[particle]
material = "glass"
[walls.default]
material = "glass"
contact_heat = true
[normal]
model = "thornton-ning"
yield_ratio = 0.7
[tangential]
model = "constant"
e_t = 0.76
[materials.glass]
like = "pyrex"
heat_capacity = 800
thermal_conductivity = 1
"#;

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
        assert_eq!(deposit_in_rust(&deposit), expected);
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

/// Through a film with a heat flux the hot outside carries the flow: by hand, the sum over 20000
/// slices of `rho g y²/mu(T(y)) dy`, `y` from the surface, over the thickness.
#[test]
fn a_cooled_film_is_stiff_inside() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let deposit = nw_deposit { wall: 1, molten: 13.75, ..nw_deposit::default() };
    let ask = |t_surface: f64, flux: f64| {
        let mut velocity = -1.0;
        let status = unsafe {
            (calls.nw_cooled_film_velocity)(
                model,
                &raw const deposit,
                t_surface,
                flux,
                9.81,
                &raw mut velocity,
            )
        };
        (status, velocity)
    };
    let mut whole = -1.0;
    let status = unsafe { (calls.nw_film_velocity)(model, &raw const deposit, 1750.0, 9.81, &raw mut whole) };
    assert_eq!((status, ask(1750.0, 0.0)), (NW_OK, (NW_OK, whole)));

    let (flux, rust) = (5e4, Model::from_toml("m", EVERY_REGIME).unwrap());
    let of_slag = EVERY_REGIME.replace("\"refractory\"\nslag", "\"coal-slag\"\nslag");
    let of_slag = Model::from_toml("m", &of_slag).unwrap();
    let conductivity = of_slag.walls()[1].material().thermal_conductivity_near(1750.0).unwrap();
    let (thickness, slices) = (13.75 / 2750.0, 20_000);
    let slice = thickness / f64::from(slices);
    let by_hand: f64 = (0..slices)
        .map(|index| {
            let depth = slice * (f64::from(index) + 0.5);
            let melt = rust.melt(1, 1750.0 - flux * depth / conductivity).unwrap();
            2750.0 * 9.81 * depth * depth / melt.viscosity * slice / thickness
        })
        .sum();
    let (status, cooled) = ask(1750.0, flux);
    calls.free(model);
    assert_eq!(status, NW_OK);
    assert!(cooled < 0.5 * whole && (cooled - by_hand).abs() < 1e-3 * by_hand, "{cooled} {by_hand} {whole}");
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

/// 600 K behind 1 mm of 1 W/(m K), a gas of 1500 K, no radiation.
fn by_hand() -> nw_wall_cooling {
    nw_wall_cooling {
        coolant_temperature: 600.0,
        coolant_coefficient: 2000.0,
        wall_resistance: 1e-3,
        gas_temperature: 1500.0,
        gas_coefficient: 100.0,
        gas_conductivity: 0.06,
        ..nw_wall_cooling::default()
    }
}

fn in_rust(cooling: &nw_wall_cooling) -> WallCooling {
    WallCooling {
        coolant: Coolant {
            temperature: cooling.coolant_temperature,
            coefficient: cooling.coolant_coefficient,
        },
        wall_resistance: cooling.wall_resistance,
        hot: HotSide {
            gas_temperature: cooling.gas_temperature,
            coefficient: cooling.gas_coefficient,
            emissivity: cooling.emissivity,
            irradiation: cooling.irradiation,
            particle_flux: cooling.further_flux,
        },
        void_gas: VoidGas {
            conductivity: cooling.gas_conductivity,
            temperature: cooling.void_temperature,
            exponent: 0.8,
        },
        vapour: VapourSide::default(),
    }
}

/// What C tells of the temperatures.
fn heat_in_c(heat: &WallHeat) -> [f64; 8] {
    [
        heat.surface_temperature,
        heat.wall_temperature,
        heat.heat_flux,
        heat.coolant_flux,
        heat.deposit_resistance,
        heat.disagreement,
        heat.behind[0],
        heat.behind[1],
    ]
}

fn heat_numbers(heat: &nw_wall_heat) -> [f64; 8] {
    [
        heat.surface_temperature,
        heat.wall_temperature,
        heat.heat_flux,
        heat.coolant_flux,
        heat.deposit_resistance,
        heat.disagreement,
        heat.behind_temperature,
        heat.behind_resistance,
    ]
}

fn deposit_in_rust(deposit: &nw_deposit) -> Deposit {
    let nw_deposit { molten, powder, solid, cover, conversion, closed, resuspended, .. } = *deposit;
    let nw_deposit { frozen, behind, .. } = *deposit;
    Deposit { molten, powder, solid, cover, conversion, closed, resuspended, frozen, behind }
}

/// A heat with its size and -1 in every field, which no call writes.
fn unset_heat() -> nw_wall_heat {
    nw_wall_heat {
        surface_temperature: -1.0,
        wall_temperature: -1.0,
        heat_flux: -1.0,
        coolant_flux: -1.0,
        deposit_resistance: -1.0,
        disagreement: -1.0,
        behind_temperature: -1.0,
        behind_resistance: -1.0,
        ..nw_wall_heat::default()
    }
}

/// The temperatures with `Ok`, the status with `Err`, and then nothing was written.
fn heat(
    calls: &Calls,
    model: *const nw_model,
    deposit: &nw_deposit,
    voidage: f64,
    cooling: &nw_wall_cooling,
) -> Result<nw_wall_heat, i32> {
    let mut found = unset_heat();
    let status = unsafe { (calls.nw_deposit_heat)(model, deposit, voidage, cooling, &raw mut found) };
    if status == NW_OK {
        return Ok(found);
    }
    assert_eq!(format!("{found:?}"), format!("{:?}", unset_heat()), "written on failure");
    Err(status)
}

fn surroundings_in_rust(around: &nw_deposit_surroundings, cooling: Option<&nw_wall_cooling>) -> Surroundings {
    let nw_deposit_surroundings { voidage, wall_temperature, .. } = *around;
    let nw_deposit_surroundings { gas_density: density, kinematic_viscosity, .. } = *around;
    let nw_deposit_surroundings { gravity_outward, gravity_along, draw, .. } = *around;
    Surroundings {
        voidage,
        cooling: cooling.map(in_rust),
        wall_temperature: (wall_temperature > 0.0).then_some(wall_temperature),
        gas: WallGas { density, kinematic_viscosity, shear: [around.shear_down, around.shear_across] },
        gravity_outward,
        gravity_along,
        draw,
    }
}

/// The deposit afterwards and the losses with `Ok`, the status with `Err`, and then both are as before.
fn advance(
    calls: &Calls,
    model: *const nw_model,
    deposit: &nw_deposit,
    around: *const nw_deposit_surroundings,
    duration: f64,
) -> Result<(nw_deposit, Losses), i32> {
    advance_cooled(calls, model, deposit, around, null(), duration)
}

/// As [`advance`], on a cooled wall.
fn advance_cooled(
    calls: &Calls,
    model: *const nw_model,
    deposit: &nw_deposit,
    around: *const nw_deposit_surroundings,
    cooling: *const nw_wall_cooling,
    duration: f64,
) -> Result<(nw_deposit, Losses), i32> {
    let (mut after, mut losses) =
        (*deposit, nw_deposit_losses { mass: [-1.0; NW_PROCESSES], ..Default::default() });
    let (to, lost) = (&raw mut after, &raw mut losses);
    let status = unsafe { (calls.nw_deposit_advance)(model, around, cooling, duration, to, lost) };
    if status == NW_OK {
        return Ok((after, losses.mass));
    }
    assert_eq!(format!("{after:?}"), format!("{deposit:?}"), "written on failure");
    assert_eq!(losses.mass, [-1.0; NW_PROCESSES], "written on failure");
    Err(status)
}

fn near(found: f64, expected: f64) {
    assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
}

/// Deposits that grow, melt and sinter on a cooled wall, by both libraries, to the last bit.
#[test]
fn a_cooled_wall_is_that_of_the_rust_library() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let rust = Model::from_toml("m", EVERY_REGIME).unwrap();
    let [mut melted, mut frozen, mut sintered] = [0; 3];
    for (_, impact, draw) in random_cases(seed(), 300) {
        let uniform = |stream, low: f64, high: f64| low + (high - low) * draw.uniform(stream);
        let thickness = 10_f64.powf(uniform(1, -5.0, -2.0));
        let voidage = uniform(2, 0.0, 0.8);
        let deposit = nw_deposit {
            wall: (3.0 * draw.uniform(3)) as u32,
            molten: 2000.0 * thickness * uniform(4, -1.0, 1.0).max(0.0),
            powder: 2300.0 * thickness,
            solid: thickness,
            cover: 1.5 * thickness / impact.diameter,
            conversion: uniform(5, 0.5, 1.0),
            closed: thickness * voidage * uniform(6, -1.0, 0.8).max(0.0),
            frozen: 2000.0 * thickness * uniform(14, -1.0, 1.0).max(0.0),
            behind: uniform(15, -1.0, 1.0).max(0.0),
            ..nw_deposit::default()
        };
        let cooling = nw_wall_cooling {
            coolant_temperature: uniform(7, 300.0, 1300.0),
            gas_temperature: uniform(8, 900.0, 2500.0),
            gas_coefficient: uniform(9, 0.0, 300.0),
            emissivity: draw.uniform(10),
            irradiation: uniform(11, 0.0, 1.2e6),
            further_flux: uniform(12, -1e4, 1e5),
            ..by_hand()
        };
        let found = heat(&calls, model, &deposit, voidage, &cooling).unwrap();
        let wall = deposit.wall as usize;
        let expected = rust.wall_heat(wall, &deposit_in_rust(&deposit), voidage, &in_rust(&cooling));
        assert_eq!(heat_numbers(&found), heat_in_c(&expected.unwrap()));
        let nw_wall_cooling { coolant_temperature, gas_temperature, emissivity, .. } = cooling;
        let surface = found.surface_temperature;
        // The balance of both sides, written down again.
        let taken = cooling.gas_coefficient * (gas_temperature - surface)
            + emissivity * (cooling.irradiation - 5.670_374_419e-8 * surface.powi(4))
            + cooling.further_flux;
        let given = (surface - coolant_temperature) / (5e-4 + 1e-3 + found.deposit_resistance);
        let scale = cooling.irradiation + cooling.gas_coefficient * surface + 1e5;
        assert!((taken - given).abs() < 1e-9 * scale && (given - found.heat_flux).abs() < 1e-9 * scale);

        let duration = 10_f64.powf(uniform(13, 0.0, 6.0));
        let around = nw_deposit_surroundings { voidage, ..Default::default() };
        let (aged, losses) = advance_cooled(&calls, model, &deposit, &around, &cooling, duration).unwrap();
        let surroundings = surroundings_in_rust(&around, Some(&cooling));
        let expected = rust.advance(wall, &deposit_in_rust(&deposit), &surroundings, duration);
        let (left, _, crossed) = expected.unwrap();
        assert_eq!((deposit_in_rust(&aged), aged.wall), (left, deposit.wall));
        let scale = crossed.from_gas.abs().max(crossed.fusion.abs()).max(crossed.to_coolant.abs());
        let rest = crossed.from_gas - crossed.to_coolant - crossed.fusion;
        assert!(rest.abs() < 1e-8 * scale && crossed.deposit_resistance == found.deposit_resistance);
        assert_eq!(losses, [0.0; NW_PROCESSES]);
        near(deposit_in_rust(&aged).mass(), deposit_in_rust(&deposit).mass());
        melted += usize::from(aged.molten > deposit.molten);
        frozen += usize::from(aged.frozen > deposit.frozen);
        // Not by rounding alone.
        let before = 1.001 * deposit.closed / thickness + 1e-9;
        sintered += usize::from(aged.powder > 0.0 && aged.closed / aged.solid > before);
    }
    calls.free(model);
    assert!(
        melted > 20 && frozen > 20 && sintered > 20,
        "{melted} melted, {frozen} froze, {sintered} sintered"
    );
}

/// A particle of 1200 J/(kg K) at 1500 K on a wall of 900 K brings 1200*600 J/kg where nothing melts; without a
/// heat capacity on either side the status says so.
#[test]
fn what_a_captured_particle_brings_by_hand() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let rust = Model::from_toml("m", EVERY_REGIME).unwrap();
    let bring = |impact: &nw_impact, capacity| {
        let mut heat = -1.0;
        let status = unsafe { (calls.nw_heat_brought)(model, impact, capacity, &raw mut heat) };
        if status == NW_OK { Ok(heat) } else { Err((status, heat)) }
    };
    let hot = nw_impact { T_p: 1500.0, T_w: 900.0, ..nw_impact::default() };
    assert_eq!(bring(&hot, 1200.0), Ok(1200.0 * 600.0));
    for (_, impact, _) in random_cases(seed(), 100) {
        let expected = rust.heat_brought(&impact, None).ok_or((NW_NO_HEAT_CAPACITY, -1.0));
        assert_eq!(bring(&nw_impact::from(&impact), 0.0), expected);
    }
    assert_eq!(bring(&nw_impact { wall: 99, ..hot }, 1200.0), Err((NW_UNKNOWN_WALL, -1.0)));
    assert_eq!(bring(&nw_impact { T_p: 0.0, ..hot }, 1200.0), Err((NW_BAD_STATE, -1.0)));
    assert_eq!(bring(&hot, f64::NAN), Err((NW_BAD_STATE, -1.0)));
    let status = unsafe { (calls.nw_heat_brought)(model, &raw const hot, 0.0, null_mut()) };
    assert_eq!(status, NW_NULL_POINTER);
    calls.free(model);
}

/// Heat of contact by both libraries, to the last bit; 0 where no wall asks for it.
#[test]
fn heat_of_contact_is_that_of_the_rust_library() {
    let calls = Calls::load();
    let (rust, model, plain) =
        (Model::from_toml("m", GLASS).unwrap(), calls.parse(GLASS), calls.parse(EVERY_REGIME));
    let give = |model, impact: &nw_impact| {
        let mut heat = -1.0;
        let status = unsafe { (calls.nw_contact_heat)(model, impact, &raw mut heat) };
        if status == NW_OK { Ok(heat) } else { Err((status, heat)) }
    };
    let hot = nw_impact { v_n: 1.0, T_p: 320.0, T_w: 300.0, ..nw_impact::default() };
    assert!(give(model, &hot).unwrap() > 0.0);
    for (_, impact, _) in random_cases(seed(), 100) {
        let raw = nw_impact::from(&impact);
        let expected = rust.contact_heat(0, &impact).map_err(|error| (status_of(&error), -1.0));
        assert_eq!(give(model, &nw_impact { wall: 0, ..raw }), expected);
    }
    assert_eq!(give(plain, &hot), Ok(0.0));
    assert_eq!(give(model, &nw_impact { wall: 99, ..hot }), Err((NW_UNKNOWN_WALL, -1.0)));
    assert_eq!(give(model, &nw_impact { T_p: 0.0, ..hot }), Err((NW_BAD_STATE, -1.0)));
    let status = unsafe { (calls.nw_contact_heat)(model, &raw const hot, null_mut()) };
    assert_eq!(status, NW_NULL_POINTER);
    calls.free(model);
    calls.free(plain);
}

/// Without radiation the resistances are in series: 1/2000, 1e-3, the deposit and 1/100.
#[test]
fn a_cooled_wall_by_hand() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let bare = heat(&calls, model, &nw_deposit::default(), 0.4, &by_hand()).unwrap();
    let flux = 900.0 / 0.0115;
    near(bare.heat_flux, flux);
    near(bare.surface_temperature, 1500.0 - flux / 100.0);
    near(bare.wall_temperature, bare.surface_temperature);
    near(bare.coolant_flux, flux);
    assert_eq!(bare.deposit_resistance, 0.0);
    near(bare.behind_temperature, 600.0);
    near(bare.behind_resistance, 1.5e-3);
    let (mut wall, mut crossed) = (nw_deposit::default(), nw_deposit_losses::default());
    let around = nw_deposit_surroundings { voidage: 0.4, ..Default::default() };
    let cooling = by_hand();
    let (from, by, to) = (&raw const around, &raw const cooling, &raw mut wall);
    let status = unsafe { (calls.nw_deposit_advance)(model, from, by, 60.0, to, &raw mut crossed) };
    assert_eq!((status, crossed.heat_of_fusion), (NW_OK, 0.0));
    near(crossed.heat_taken, 60.0 * flux);
    near(crossed.heat_to_coolant, 60.0 * flux);

    // 2 mm of slag, 2750 kg/m3 and 1.5 W/(m K), under 1 mm of ash without voids, 1.4 W/(m K).
    let [melt, powder] = [2e-3 / 1.5, 1e-3 / 1.4];
    let deposit =
        nw_deposit { wall: 1, molten: 5.5, powder: 2.3, solid: 1e-3, cover: 30.0, ..nw_deposit::default() };
    let covered = heat(&calls, model, &deposit, 0.0, &by_hand()).unwrap();
    let flux = 900.0 / (0.0115 + melt + powder);
    near(covered.deposit_resistance, melt + powder);
    near(covered.heat_flux, flux);
    near(covered.surface_temperature, 1500.0 - flux / 100.0);
    near(covered.wall_temperature, 600.0 + flux * 1.5e-3);
    near(covered.coolant_flux, flux);
    assert!(covered.disagreement <= 1e-9);

    // With voids it insulates better than without, and less than their gas would at the same thickness.
    let powder = nw_deposit { molten: 0.0, ..deposit };
    let loose = heat(&calls, model, &powder, 0.5, &by_hand()).unwrap().deposit_resistance;
    assert!(loose > 2e-3 / 1.4 && loose < 2e-3 / 0.06, "{loose}");
    // Sintering closed 0.6 of 1 mm of voids.
    let closed = nw_deposit { closed: 0.6e-3, ..powder };
    let dense = heat(&calls, model, &closed, 0.5, &by_hand()).unwrap().deposit_resistance;
    assert!(dense > 1.4e-3 / 1.4 && dense < 0.5 * loose, "{dense}");
    // The gas is given at two temperatures, with the exponent 1.2 between them; or as a constant: air's.
    for (other_conductivity, expected) in [(0.06 * (750.0_f64 / 293.15).powf(1.2), 1.2), (0.06, 0.8)] {
        let cooling = nw_wall_cooling { other_conductivity, other_temperature: 750.0, ..by_hand() };
        let found = heat(&calls, model, &powder, 0.5, &cooling).unwrap().deposit_resistance;
        let mut cooling = in_rust(&by_hand());
        cooling.void_gas.exponent = expected;
        let rust = Model::from_toml("m", EVERY_REGIME).unwrap();
        near(found, rust.wall_heat(1, &deposit_in_rust(&powder), 0.5, &cooling).unwrap().deposit_resistance);
    }
    calls.free(model);
}

/// Slag that cools freezes and powder that is nowhere hot enough stays, powder that is hot throughout
/// melts, and no time changes nothing.
#[test]
fn a_deposit_ages() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let deposit = nw_deposit {
        wall: 1,
        molten: 0.5,
        powder: 2.3,
        solid: 1e-3,
        cover: 30.0,
        conversion: 1.0,
        closed: 1e-5,
        ..nw_deposit::default()
    };
    let age = |coolant_temperature, gas_temperature, gas_coefficient, duration| {
        let around = nw_deposit_surroundings { voidage: 0.4, ..Default::default() };
        let cooling = nw_wall_cooling { coolant_temperature, gas_temperature, gas_coefficient, ..by_hand() };
        advance_cooled(&calls, model, &deposit, &around, &cooling, duration).map(|(after, _)| after)
    };
    let unchanged = age(900.0, 1100.0, 100.0, 0.0).unwrap();
    near(unchanged.closed, deposit.closed);
    let unchanged = nw_deposit { closed: deposit.closed, ..unchanged };
    assert_eq!(format!("{unchanged:?}"), format!("{deposit:?}"));
    let cold = age(300.0, 350.0, 100.0, 3600.0).unwrap();
    assert_eq!((cold.molten, cold.frozen, cold.powder, cold.behind), (0.0, 0.5, 2.3, 0.0));
    let molten = age(1800.0, 1900.0, 100.0, 1.0).unwrap();
    assert_eq!((molten.molten, molten.frozen, molten.solid, molten.closed), (2.8, 0.0, 0.0, 0.0));
    let half = age(900.0, 1900.0, 1000.0, 1.0).unwrap();
    assert!(half.powder > 0.0 && half.powder < 2.3 && half.molten > 0.5, "{half:?}");
    near(half.molten + half.frozen + half.powder, 2.8);
    // Until the pores that stay: 0.03 of the layer are voids, of 0.4.
    let dense = age(1200.0, 1300.0, 100.0, 1e12).unwrap();
    near(dense.closed, 1e-3 / 0.6 - 1e-3 / 0.97);
    assert_eq!((dense.powder, dense.frozen, dense.cover), (2.3, 0.5, 30.0));
    // A wall that is not cooled: slag is liquid or frozen by its temperature, powder outside stays.
    let lying = |wall_temperature| {
        let around = nw_deposit_surroundings { voidage: 0.4, wall_temperature, ..Default::default() };
        advance(&calls, model, &nw_deposit { behind: 0.5, ..deposit }, &around, 60.0).unwrap().0
    };
    assert_eq!((lying(300.0).frozen, lying(300.0).powder), (0.5, 2.3));
    assert_eq!((lying(1900.0).molten, lying(1900.0).powder), (0.5 + 1.15, 1.15));
    // A surface that is held at a temperature could give any heat.
    assert_eq!(age(900.0, 1900.0, f64::INFINITY, 1.0).unwrap_err(), NW_BAD_STATE);
    calls.free(model);
}

/// A vertical wall that holds 100 Pa: 100/9.81 = 10.19 kg/m2. A ceiling that holds 200 Pa: 20.39 kg/m2.
#[test]
fn a_deposit_falls_off() {
    let calls = Calls::load();
    let shedding = "[walls.slag.shedding]\ntensile_strength = 200\nshear_strength = 100\n[walls.\"quench.*\".shedding]\n\
         tensile_strength = 200\nshear_strength = 100\nspread = 2\n";
    let model = calls.parse(&format!("{EVERY_REGIME}\n{shedding}"));
    let held = |wall: u32, mass: f64, [outward, along]: [f64; 2], [down, across]: [f64; 2], draw: f64| {
        // By a third molten.
        let deposit = nw_deposit {
            wall,
            molten: mass / 3.0,
            powder: mass * 2.0 / 3.0,
            solid: mass / 4000.0,
            cover: 3.0,
            conversion: 0.5,
            closed: mass / 1e4,
            ..nw_deposit::default()
        };
        let around = nw_deposit_surroundings {
            gas_density: 1.2,
            kinematic_viscosity: 1.5e-5,
            shear_down: down,
            shear_across: across,
            gravity_outward: outward,
            gravity_along: along,
            draw,
            ..Default::default()
        };
        let (after, losses) = advance(&calls, model, &deposit, &around, 60.0).unwrap();
        let after = format!("{after:?}");
        let is_held = after == format!("{deposit:?}");
        assert_eq!(losses, [0.0, 0.0, 0.0, 0.0, if is_held { 0.0 } else { deposit.molten + deposit.powder }]);
        assert!(is_held || after == format!("{:?}", nw_deposit { wall, ..nw_deposit::default() }), "{after}");
        is_held
    };
    let calm = [0.0, 0.0];
    let [vertical, ceiling, floor] = [[0.0, 9.81], [9.81, 0.0], [-9.81, 0.0]];
    for draw in [0.0, 0.5, 0.999] {
        // Wall 0 has no table.
        assert!(held(0, 1e6, vertical, [1e6, 1e6], draw) && held(0, 1e6, ceiling, calm, draw));
        let critical = 100.0 / 9.81;
        assert!(held(1, 0.9999 * critical, vertical, calm, draw));
        assert!(!held(1, 1.0001 * critical, vertical, calm, draw));
        let critical = 200.0 / 9.81;
        assert!(held(1, 0.9999 * critical, ceiling, calm, draw));
        assert!(!held(1, 1.0001 * critical, ceiling, calm, draw));
        assert!(held(1, 1e9, floor, calm, draw) && held(1, 0.0, ceiling, calm, draw));
        // 60 Pa of gas leave (100 - 60)/9.81 down the slope, and 80 = sqrt(100² - 60²) across it.
        let critical = 40.0 / 9.81;
        assert!(held(1, 0.9999 * critical, vertical, [60.0, 0.0], draw));
        assert!(!held(1, 1.0001 * critical, vertical, [60.0, 0.0], draw));
        let critical = 80.0 / 9.81;
        assert!(held(1, 0.9999 * critical, vertical, [0.0, 60.0], draw));
        assert!(!held(1, 1.0001 * critical, vertical, [0.0, 60.0], draw));
    }
    // Half of the median strength with a spread of 2: of all places the weakest Phi(-1) = 0.1587 lose it.
    let half = 50.0 / 9.81;
    let lost = |draw| !held(2, half, vertical, calm, draw);
    assert_eq!([0.0, 0.15, 0.158, 0.159, 0.2, 0.999].map(lost), [true, true, true, false, false, false]);
    calls.free(model);
}

const ADHESION: &str = "[walls.slag.resuspension]\nwork_of_adhesion = 0.5\n[walls.\"quench.*\".resuspension]\n\
     work_of_adhesion = 0.3\nadhesion_median = 0.02\nadhesion_spread = 3\n";

/// Powder of random size under random gas, twice in a row, by both libraries, to the last bit. The
/// first wall has no table.
#[test]
fn the_gas_carries_away_as_in_the_rust_library() {
    let calls = Calls::load();
    let text = format!("{EVERY_REGIME}\n{ADHESION}");
    let model = calls.parse(&text);
    let rust = Model::from_toml("m", &text).unwrap();
    let [mut lost, mut kept, mut bare] = [0, 0, 0];
    for (_, _, draw) in random_cases(seed(), 600) {
        let power = |stream, low: f64, high: f64| 10_f64.powf(low + (high - low) * draw.uniform(stream));
        let wall = (3.0 * draw.uniform(1)) as u32;
        let (solid, diameter, voidage) = (power(2, -8.0, -3.0), power(3, -6.0, -3.5), 0.8 * draw.uniform(4));
        let rarely = |stream, number: f64| if draw.uniform(stream) < 0.1 { number } else { 0.0 };
        let mut deposit = nw_deposit {
            wall,
            molten: rarely(5, 0.1),
            powder: 2300.0 * solid,
            solid,
            cover: 1.5 * solid / diameter,
            conversion: draw.uniform(6),
            closed: rarely(7, 0.2 * solid),
            resuspended: 0.5 * draw.uniform(8),
            ..nw_deposit::default()
        };
        for step in 0..2 {
            let friction_velocity = if draw.uniform(30) < 0.05 { 0.0 } else { power(40 + step, -2.0, 1.0) };
            let gas_density = power(10 + step, -1.0, 1.0);
            let around = nw_deposit_surroundings {
                voidage,
                gas_density,
                kinematic_viscosity: power(20 + step, -6.0, -3.0),
                shear_down: 0.6 * gas_density * friction_velocity * friction_velocity,
                shear_across: -0.8 * gas_density * friction_velocity * friction_velocity,
                ..Default::default()
            };
            let duration = if draw.uniform(50) < 0.05 { 0.0 } else { power(60 + step, -3.0, 5.0) };
            let before = deposit_in_rust(&deposit);
            let expected =
                rust.advance(wall as usize, &before, &surroundings_in_rust(&around, None), duration);
            let (after, losses) = advance(&calls, model, &deposit, &around, duration).unwrap();
            let (left, mass, _) = expected.unwrap();
            assert_eq!((deposit_in_rust(&after), losses), (left, mass));
            assert_eq!(losses, [0.0, 0.0, 0.0, before.mass() - deposit_in_rust(&after).mass(), 0.0]);
            assert_eq!((after.wall, after.molten), (wall, deposit.molten));
            if format!("{after:?}") == format!("{deposit:?}") {
                kept += i32::from(wall > 0);
            } else {
                let share = after.powder / deposit.powder;
                let remaining = (1.0 - deposit.resuspended) * share;
                assert!(wall > 0 && share <= 1.0 && deposit.molten == 0.0, "{after:?} of {deposit:?}");
                assert!((1.0 - after.resuspended - remaining).abs() < 1e-12, "{after:?} of {deposit:?}");
                lost += 1;
                bare += i32::from(share < 0.1);
            }
            deposit = after;
        }
    }
    calls.free(model);
    println!("{lost} lost powder, {bare} of them most of it; {kept} kept all on walls that may lose it");
    assert!(lost > 50 && kept > 50 && bare > 5, "{lost} {kept} {bare}");
}

#[test]
fn a_cooled_wall_that_cannot_be_is_refused_and_nothing_written() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let mut cooling = by_hand();
    let mut temperatures = unset_heat();
    unsafe {
        assert_eq!((calls.nw_wall_cooling_init)(&raw mut cooling), NW_OK);
        let initial = nw_wall_cooling {
            coolant_coefficient: f64::INFINITY,
            gas_conductivity: 0.026,
            ..nw_wall_cooling::default()
        };
        assert_eq!(format!("{cooling:?}"), format!("{initial:?}"));
        assert_eq!((calls.nw_wall_heat_init)(&raw mut temperatures), NW_OK);
        assert_eq!(format!("{temperatures:?}"), format!("{:?}", nw_wall_heat::default()));
        assert_eq!((calls.nw_wall_cooling_init)(null_mut()), NW_NULL_POINTER);
        assert_eq!((calls.nw_wall_heat_init)(null_mut()), NW_NULL_POINTER);
    }
    let deposit =
        nw_deposit { wall: 1, molten: 1.0, powder: 2.3, solid: 1e-3, cover: 30.0, ..nw_deposit::default() };
    let refused = |deposit: &nw_deposit, voidage, cooling: &nw_wall_cooling| {
        heat(&calls, model, deposit, voidage, cooling).unwrap_err()
    };
    // As they were initialised there is no temperature.
    assert_eq!(refused(&deposit, 0.4, &cooling), NW_BAD_STATE);
    let cooling = by_hand();
    assert!(heat(&calls, model, &deposit, 0.4, &cooling).is_ok());
    for voidage in [-0.1, 1.0, f64::NAN] {
        assert_eq!(refused(&deposit, voidage, &cooling), NW_BAD_STATE);
    }
    let fields: [fn(&mut nw_wall_cooling) -> &mut f64; 11] = [
        |cooling| &mut cooling.coolant_temperature,
        |cooling| &mut cooling.gas_temperature,
        |cooling| &mut cooling.gas_conductivity,
        |cooling| &mut cooling.coolant_coefficient,
        |cooling| &mut cooling.wall_resistance,
        |cooling| &mut cooling.gas_coefficient,
        |cooling| &mut cooling.emissivity,
        |cooling| &mut cooling.irradiation,
        |cooling| &mut cooling.further_flux,
        |cooling| &mut cooling.other_conductivity,
        |cooling| &mut cooling.other_temperature,
    ];
    for (index, field) in fields.into_iter().enumerate() {
        let mut bad = vec![f64::NAN, f64::NEG_INFINITY];
        // The flux may have any sign, coefficients may be infinite, the first three must not be 0, and one
        // of the last two is nothing without the other.
        bad.extend((index != 8).then_some(-1.0));
        bad.extend((index > 8).then_some(0.1));
        bad.extend((index != 3 && index != 5).then_some(f64::INFINITY));
        bad.extend((index < 3).then_some(0.0));
        for number in bad {
            let mut cooling = cooling;
            *field(&mut cooling) = number;
            for deposit in [&deposit, &nw_deposit::default()] {
                assert_eq!(refused(deposit, 0.4, &cooling), NW_BAD_STATE, "field {index}: {number}");
            }
        }
    }
    assert_eq!(refused(&deposit, 0.4, &nw_wall_cooling { emissivity: 1.1, ..cooling }), NW_BAD_STATE);
    // No heat leaves; the surface would be colder than 0 K.
    let closed = nw_wall_cooling { coolant_coefficient: 0.0, gas_coefficient: 0.0, ..cooling };
    assert_eq!(refused(&deposit, 0.4, &closed), NW_BAD_STATE);
    assert_eq!(refused(&deposit, 0.4, &nw_wall_cooling { further_flux: -1e9, ..cooling }), NW_BAD_STATE);
    // A deposit so thick that its resistance overflows, too cold for radiation within it.
    let cold = nw_wall_cooling { coolant_temperature: 1.0, gas_temperature: 2.0, ..cooling };
    assert!(heat(&calls, model, &deposit, 0.99, &cold).is_ok());
    let thick = nw_deposit { solid: 1e306, cover: 1e308, ..deposit };
    assert_eq!(refused(&thick, 0.99, &cold), NW_BAD_STATE);
    for bad in [f64::NAN, -1.0, f64::INFINITY] {
        assert_eq!(refused(&nw_deposit { closed: bad, ..deposit }, 0.4, &cooling), NW_BAD_STATE);
    }
    assert_eq!(refused(&nw_deposit { wall: 77, ..deposit }, 0.4, &cooling), NW_UNKNOWN_WALL);
    assert_eq!(refused(&nw_deposit { struct_size: 48, ..deposit }, 0.4, &cooling), NW_STRUCT_SIZE);
    assert_eq!(refused(&deposit, 0.4, &nw_wall_cooling { struct_size: 0, ..cooling }), NW_STRUCT_SIZE);
    unsafe {
        let mut found = nw_wall_heat { struct_size: 8, ..unset_heat() };
        let kept = format!("{found:?}");
        let mut ask = |model, deposit, cooling, size: u32| {
            found.struct_size = size;
            (calls.nw_deposit_heat)(model, deposit, 0.4, cooling, &raw mut found)
        };
        let size = size_of::<nw_wall_heat>() as u32;
        let (from, by) = (&raw const deposit, &raw const cooling);
        assert_eq!(ask(null(), from, by, size), NW_NULL_POINTER);
        assert_eq!(ask(model, null(), by, size), NW_NULL_POINTER);
        assert_eq!(ask(model, from, null(), size), NW_NULL_POINTER);
        assert_eq!(ask(model, from, by, 8), NW_STRUCT_SIZE);
        assert_eq!(format!("{found:?}"), kept);
        assert_eq!((calls.nw_deposit_heat)(model, from, 0.4, by, null_mut()), NW_NULL_POINTER);
    }

    // A material without conductivity matters where a layer consists of it.
    let wax = calls.parse(
        "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n[normal]\nmodel = \
         \"constant\"\ne_n = 0.4\n[tangential]\nmodel = \"constant\"\ne_t = 0.7\n",
    );
    assert!(heat(&calls, wax, &nw_deposit::default(), 0.4, &cooling).is_ok());
    for (molten, solid) in [(0.0, 1e-3), (1.0, 0.0), (1.0, 1e-3)] {
        let deposit = nw_deposit { wall: 0, molten, solid, ..deposit };
        assert_eq!(heat(&calls, wax, &deposit, 0.4, &cooling).unwrap_err(), NW_NO_CONDUCTIVITY);
        let nowhere = nw_wall_cooling { gas_temperature: f64::NAN, ..cooling };
        assert_eq!(heat(&calls, wax, &deposit, 0.4, &nowhere).unwrap_err(), NW_BAD_STATE);
    }
    assert!(
        calls.text(unsafe { (calls.nw_status_text)(NW_NO_CONDUCTIVITY) }).contains("thermal_conductivity")
    );
    calls.free(wax);
    calls.free(model);
}

/// Each number of the surroundings, with values that are refused.
type Numbers = [(fn(&mut nw_deposit_surroundings) -> &mut f64, &'static [f64]); 9];
const NO_NUMBERS: &[f64] = &[f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
const NOT_POSITIVE: &[f64] = &[0.0, -1.0, f64::NAN, f64::INFINITY];
const NO_SHARES: &[f64] = &[-0.1, 1.0, f64::NAN, f64::INFINITY];
const REFUSED: Numbers = [
    (|around| &mut around.voidage, NO_SHARES),
    (|around| &mut around.wall_temperature, &[-1.0, f64::NAN, f64::INFINITY]),
    (|around| &mut around.gas_density, NOT_POSITIVE),
    (|around| &mut around.kinematic_viscosity, NOT_POSITIVE),
    (|around| &mut around.shear_down, NO_NUMBERS),
    (|around| &mut around.shear_across, NO_NUMBERS),
    (|around| &mut around.gravity_outward, NO_NUMBERS),
    (|around| &mut around.gravity_along, &[-1.0, f64::NAN, f64::INFINITY]),
    (|around| &mut around.draw, NO_SHARES),
];

#[test]
fn a_step_that_cannot_be_is_refused_and_nothing_written() {
    let calls = Calls::load();
    let tables = "[walls.slag.shedding]\ntensile_strength = 0\nshear_strength = 0\n";
    let model = calls.parse(&format!("{EVERY_REGIME}\n{ADHESION}{tables}"));
    let deposit = nw_deposit {
        wall: 1,
        molten: 1.0,
        powder: 2.3,
        solid: 1e-3,
        cover: 30.0,
        conversion: 1.0,
        ..nw_deposit::default()
    };
    let around = nw_deposit_surroundings {
        voidage: 0.4,
        wall_temperature: 1900.0,
        gas_density: 1.2,
        kinematic_viscosity: 1.5e-5,
        shear_down: 4.8,
        gravity_along: 9.81,
        draw: 0.5,
        ..Default::default()
    };
    let step = |deposit: &nw_deposit, around: &nw_deposit_surroundings, duration| {
        advance(&calls, model, deposit, around, duration).map(|_| ())
    };
    for wall in [0, 1] {
        // Also where no table asks for the number.
        let deposit = nw_deposit { wall, ..deposit };
        assert_eq!(step(&deposit, &around, 60.0), Ok(()));
        for (index, (number, values)) in REFUSED.into_iter().enumerate() {
            for value in values {
                let mut around = around;
                *number(&mut around) = *value;
                assert_eq!(step(&deposit, &around, 60.0), Err(NW_BAD_STATE), "number {index}: {value}");
            }
        }
        for duration in [-1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(step(&deposit, &around, duration), Err(NW_BAD_STATE));
        }
    }
    for (bad, status) in [
        (nw_deposit { closed: f64::NAN, ..deposit }, NW_BAD_STATE),
        (nw_deposit { powder: -1.0, ..deposit }, NW_BAD_STATE),
        (nw_deposit { conversion: 2.0, ..deposit }, NW_BAD_STATE),
        (nw_deposit { resuspended: -0.1, ..deposit }, NW_BAD_STATE),
        (nw_deposit { resuspended: 1.1, ..deposit }, NW_BAD_STATE),
        (nw_deposit { resuspended: f64::NAN, ..deposit }, NW_BAD_STATE),
        (nw_deposit { wall: 77, ..deposit }, NW_UNKNOWN_WALL),
        (nw_deposit { struct_size: 48, ..deposit }, NW_STRUCT_SIZE),
        (nw_deposit { struct_size: 0, ..deposit }, NW_STRUCT_SIZE),
        // What melts makes more than there can be.
        (nw_deposit { wall: 1, molten: f64::MAX, powder: f64::MAX, behind: 1.0, ..deposit }, NW_BAD_STATE),
    ] {
        assert_eq!(step(&bad, &around, 60.0), Err(status), "{bad:?}");
    }
    let old = nw_deposit_surroundings { struct_size: 8, ..around };
    assert_eq!(step(&deposit, &old, 60.0), Err(NW_STRUCT_SIZE));
    assert_eq!(advance(&calls, null(), &deposit, &around, 60.0).map(|_| ()), Err(NW_NULL_POINTER));
    assert_eq!(advance(&calls, model, &deposit, null(), 60.0).map(|_| ()), Err(NW_NULL_POINTER));
    unsafe {
        let (mut kept, mut losses) = (deposit, nw_deposit_losses::default());
        let mut ask = |to: *mut nw_deposit, size: u32, is_null: bool| {
            losses.struct_size = size;
            let lost = if is_null { null_mut() } else { &raw mut losses };
            (calls.nw_deposit_advance)(model, &raw const around, null(), 60.0, to, lost)
        };
        let size = size_of::<nw_deposit_losses>() as u32;
        assert_eq!(ask(null_mut(), size, false), NW_NULL_POINTER);
        assert_eq!(ask(&raw mut kept, size, true), NW_NULL_POINTER);
        assert_eq!(ask(&raw mut kept, 8, false), NW_STRUCT_SIZE);
        assert_eq!(format!("{kept:?}"), format!("{deposit:?}"));
        assert_eq!((calls.nw_deposit_surroundings_init)(null_mut()), NW_NULL_POINTER);
        assert_eq!((calls.nw_deposit_losses_init)(null_mut()), NW_NULL_POINTER);
        let mut initial = around;
        assert_eq!((calls.nw_deposit_surroundings_init)(&raw mut initial), NW_OK);
        assert_eq!(format!("{initial:?}"), format!("{:?}", nw_deposit_surroundings::default()));
        losses.mass = [9.0; NW_PROCESSES];
        assert_eq!((calls.nw_deposit_losses_init)(&raw mut losses), NW_OK);
        assert_eq!(losses.mass, [0.0; NW_PROCESSES]);
    }
    calls.free(model);
}

/// A calm gas, no time, and a wall without the table: nothing leaves.
#[test]
fn without_wind_time_or_a_table_powder_stays() {
    let calls = Calls::load();
    let model = calls.parse(&format!("{EVERY_REGIME}\n{ADHESION}"));
    let deposit = nw_deposit { wall: 1, powder: 2.3e-3, solid: 1e-6, cover: 0.05, ..nw_deposit::default() };
    let wind = nw_deposit_surroundings {
        voidage: 0.4,
        gas_density: 1.2,
        kinematic_viscosity: 1.5e-5,
        shear_down: 4.8,
        ..Default::default()
    };
    let (left, losses) = advance(&calls, model, &deposit, &wind, 60.0).unwrap();
    assert!(left.powder < deposit.powder && left.resuspended > 0.0, "{left:?}");
    assert_eq!(losses, [0.0, 0.0, 0.0, deposit.powder - left.powder, 0.0]);
    let calm = nw_deposit_surroundings { shear_down: 0.0, ..wind };
    let unknown = nw_deposit_surroundings { gas_density: 0.0, kinematic_viscosity: 0.0, ..calm };
    for (wall, around, duration) in
        [(1, calm, 60.0), (1, unknown, 60.0), (1, wind, 0.0), (0, wind, 60.0), (0, calm, 0.0)]
    {
        let deposit = nw_deposit { wall, ..deposit };
        let (unchanged, losses) = advance(&calls, model, &deposit, &around, duration).unwrap();
        assert_eq!(format!("{unchanged:?}"), format!("{deposit:?}"));
        assert_eq!(losses, [0.0; NW_PROCESSES]);
    }
    calls.free(model);
}

/// The table of processes as C sees it, and which of them act where.
#[test]
fn processes_have_names_and_walls() {
    let calls = Calls::load();
    let model = calls.parse(&format!(
        "{EVERY_REGIME}\n{ADHESION}[walls.slag.shedding]\ntensile_strength = 1\nshear_strength = 1\n"
    ));
    let text = |found| calls.text(found);
    for (index, process) in (0..).zip(PROCESSES) {
        assert_eq!(text(unsafe { (calls.nw_process_name)(index) }), process.name);
        assert_eq!(text(unsafe { (calls.nw_process_loss)(index) }), process.loss.unwrap_or(""));
        assert_eq!(text(unsafe { (calls.nw_process_gain)(index) }), process.gain.unwrap_or(""));
    }
    let beyond = NW_PROCESSES as u32;
    assert!(unsafe {
        (calls.nw_process_name)(beyond).is_null()
            && (calls.nw_process_loss)(beyond).is_null()
            && (calls.nw_process_gain)(beyond).is_null()
    });
    let acting = |model, wall| {
        let mut bits = 77;
        let status = unsafe { (calls.nw_wall_processes)(model, wall, &raw mut bits) };
        (status, bits)
    };
    // Melting and sintering everywhere.
    assert_eq!(
        [0, 1, 2].map(|wall| acting(model, wall)),
        [0b0_0011, 0b1_1011, 0b0_1011].map(|bits| (NW_OK, bits))
    );
    assert_eq!(acting(model, 77), (NW_UNKNOWN_WALL, 77));
    assert_eq!(acting(null(), 0), (NW_NULL_POINTER, 77));
    assert_eq!(unsafe { (calls.nw_wall_processes)(model, 0, null_mut()) }, NW_NULL_POINTER);
    calls.free(model);
}

/// Vapour condenses on a bare cooled wall with the fraction of the model file or of the call, and warms it.
#[test]
fn vapour_condenses_on_a_cooled_wall() {
    let calls = Calls::load();
    let vapour = "[walls.slag.condensation]\nvapour = \"KCl\"\nmass_fraction = 2e-4\n";
    let model = calls.parse(&format!("{EVERY_REGIME}\n{vapour}"));
    let gained = |vapour_fraction: f64| {
        let mut deposit = nw_deposit { wall: 1, ..nw_deposit::default() };
        let around = nw_deposit_surroundings { voidage: 0.4, ..nw_deposit_surroundings::default() };
        let cooling = nw_wall_cooling { gas_temperature: 1100.0, vapour_fraction, ..by_hand() };
        let mut lost = nw_deposit_losses::default();
        let found = heat(&calls, model, &deposit, 0.4, &cooling).unwrap();
        let status = unsafe {
            (calls.nw_deposit_advance)(
                model,
                &raw const around,
                &raw const cooling,
                3600.0,
                &raw mut deposit,
                &raw mut lost,
            )
        };
        assert_eq!(status, NW_OK);
        assert_eq!(lost.mass, [0.0, 0.0, -deposit.powder, 0.0, 0.0]);
        (deposit.powder, found.heat_flux)
    };
    let [(none, dry), (half, less), (all, more), (given, same)] = [0.0, 1e-4, 2e-4, -1.0].map(gained);
    assert_eq!((none, given, same), (0.0, all, more));
    assert!(
        (0.49..0.51).contains(&(half / all)) && dry < less && less < more,
        "{half} {all} {dry} {less} {more}"
    );
    let bad = nw_wall_cooling { vapour_fraction: 0.6, ..by_hand() };
    assert_eq!(heat(&calls, model, &nw_deposit::default(), 0.4, &bad).unwrap_err(), NW_BAD_STATE);
    calls.free(model);
}

/// The table `resuspension` of a wall: the work of adhesion, the other two together or not at all, and nothing else.
#[test]
fn a_resuspension_table_is_checked() {
    let told = |keys: &str| {
        let text = format!("{EVERY_REGIME}\n[walls.slag.resuspension]\n{keys}");
        Model::from_toml("m", &text).map(|_| ()).map_err(|fault| fault.to_string())
    };
    let all = "work_of_adhesion = 0.5\nadhesion_median = 0.02\nadhesion_spread = 3\n";
    assert_eq!((told("work_of_adhesion = 0.5\n"), told(all)), (Ok(()), Ok(())));
    for (keys, word) in [
        ("", "work_of_adhesion"),
        ("adhesion_median = 0.02\nadhesion_spread = 3\n", "work_of_adhesion"),
        ("work_of_adhesion = 0.5\nadhesion_spread = 3\n", "adhesion_median"),
        ("work_of_adhesion = 0.5\nadhesion_median = 0.02\n", "adhesion_spread"),
        ("work_of_adhesion = 0\n", "work_of_adhesion"),
        ("work_of_adhesion = 1001\n", "work_of_adhesion"),
        ("work_of_adhesion = nan\n", "work_of_adhesion"),
        ("work_of_adhesion = 0.5\nadhesion_median = 0\nadhesion_spread = 3\n", "adhesion_median"),
        ("work_of_adhesion = 0.5\nadhesion_median = 0.02\nadhesion_spread = 1\n", "adhesion_spread"),
        ("work_of_adhesion = 0.5\nadhesion_median = 0.02\nadhesion_spread = 101\n", "adhesion_spread"),
        ("work_of_adhesion = 0.5\nadhesion_medium = 0.02\n", "adhesion_median"),
    ] {
        let fault = told(keys).unwrap_err();
        assert!(fault.contains(word), "{keys}: {fault}");
    }
    // Covered by powder that has no mass.
    let covered = format!(
        "{EVERY_REGIME}\n[walls.dusty]\nmaterial = \"pyrex\"\ncoverage = 0.3\n\
                           [walls.dusty.resuspension]\nwork_of_adhesion = 0.5\n"
    );
    let fault = Model::from_toml("m", &covered).map(|_| ()).unwrap_err().to_string();
    assert!(fault.contains("walls.dusty.coverage: is powder without a mass"), "{fault}");
}

/// The table `shedding` of a wall: both strengths, in their bounds, and nothing else.
#[test]
fn a_shedding_table_is_checked() {
    let told = |keys: &str| {
        let text = format!("{EVERY_REGIME}\n[walls.slag.shedding]\n{keys}");
        Model::from_toml("m", &text).map(|_| ()).map_err(|fault| fault.to_string())
    };
    assert_eq!(told("tensile_strength = 1\nshear_strength = 0\nspread = 1.5\n"), Ok(()));
    for (keys, word) in [
        ("shear_strength = 1\n", "tensile_strength"),
        ("tensile_strength = 1\n", "shear_strength"),
        ("tensile_strength = -1\nshear_strength = 1\n", "tensile_strength"),
        ("tensile_strength = nan\nshear_strength = 1\n", "tensile_strength"),
        ("tensile_strength = 1\nshear_strength = 1\nspread = 0.9\n", "spread"),
        ("tensile_strength = 1\nshear_strength = 1\nspreed = 2\n", "spread"),
    ] {
        let fault = told(keys).unwrap_err();
        assert!(fault.contains(word), "{fault}");
    }
}
