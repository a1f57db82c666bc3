//! Deposits that grow, melt and freeze in any order: mass and energy are kept, and no layer is colder than
//! the coldest or hotter than the hottest of what surrounds it.

use nearwall::Model;
use nearwall::deposit::conduction::{Coolant, HotSide, STEFAN_BOLTZMANN};
use nearwall::deposit::{
    CapturedParticles, Deposit, DepositSource, PROCESS_COUNT, Surroundings, VapourSide, VoidGas, WallCooling,
};
use proptest::prelude::*;

use crate::cases::{config, decades};

const MELTS_AT: f64 = 1400.0;
const HEAT_OF_FUSION: f64 = 3e5;

fn model(heat_of_fusion: bool) -> Model {
    let heat = if heat_of_fusion { format!("heat_of_fusion = {HEAT_OF_FUSION}\n") } else { String::new() };
    let text = format!(
        "[particle]\nmaterial = \"ash\"\n[walls.default]\nmaterial = \"refractory\"\n\
         [normal]\nmodel = \"constant\"\ne_n = 0.4\n[tangential]\nmodel = \"constant\"\ne_t = 0.7\n\
         [capture]\nmodel = \"viscosity\"\nlaw = \"kalmanovitch-frank\"\nreference_viscosity = 1e4\n\
         [materials.ash]\ndensity = 2500\nyoungs_modulus = 1e10\npoisson_ratio = 0.2\nyield_strength = 1e8\n\
         surface_energy = 0.1\nsurface_tension = 0.4\nviscosity = {{ arrhenius = [1e-7, 30000], valid = [300, 4000] }}\n\
         critical_viscosity_temperature = {MELTS_AT}\n{heat}\
         thermal_conductivity = {{ T = [400, 1200, 2500], value = [0.8, 2.0, 1.2] }}\n"
    );
    Model::from_toml("ash", &text).unwrap()
}

/// What happens in one step.
#[derive(Debug, Clone)]
struct Event {
    arrivals: Vec<CapturedParticles>,
    cooling: WallCooling,
    duration: f64,
}

fn cooling() -> impl Strategy<Value = WallCooling> {
    let coolant = (300.0..1500.0, prop_oneof![Just(f64::INFINITY), decades(1.0, 1e4), Just(0.0)]);
    let gas = (
        300.0..2500.0,
        decades(1.0, 1e3),
        0.0..=1.0,
        300.0..2500.0,
        prop_oneof![Just(0.0), decades(1e-6, 1e-1)],
    );
    (coolant, gas).prop_map(
        |((temperature, coefficient), (gas_temperature, gas, emissivity, radiation, wall))| {
            let radiation: f64 = radiation;
            WallCooling {
                coolant: Coolant { temperature, coefficient },
                wall_resistance: wall,
                hot: HotSide {
                    gas_temperature,
                    coefficient: gas,
                    emissivity,
                    irradiation: STEFAN_BOLTZMANN * radiation.powi(4),
                    particle_flux: 0.0,
                },
                void_gas: VoidGas { conductivity: 0.06, temperature: 800.0, exponent: VoidGas::AIR },
                vapour: VapourSide::default(),
            }
        },
    )
}

fn particles() -> impl Strategy<Value = CapturedParticles> {
    (decades(1e-9, 10.0), 800.0..3000.0, decades(1e-6, 1e-3), any::<bool>()).prop_map(
        |(mass, density, diameter, molten)| CapturedParticles {
            mass,
            density,
            diameter,
            conversion: 1.0,
            molten,
        },
    )
}

fn events() -> impl Strategy<Value = Vec<Event>> {
    let event =
        (prop::collection::vec(particles(), 0..3), cooling(), prop_oneof![Just(0.0), decades(1e-4, 1e6)])
            .prop_map(|(arrivals, cooling, duration)| Event { arrivals, cooling, duration });
    prop::collection::vec(event, 1..20)
}

/// The temperatures [K] between which every layer lies.
fn extremes(cooling: &WallCooling, slag: bool) -> [f64; 2] {
    let hot = &cooling.hot;
    let radiation = (hot.irradiation / STEFAN_BOLTZMANN).sqrt().sqrt();
    let radiates = (hot.emissivity > 0.0).then_some(radiation);
    let cools = (cooling.coolant.coefficient > 0.0).then_some(cooling.coolant.temperature);
    let front = slag.then_some(MELTS_AT);
    let all = [Some(hot.gas_temperature), radiates, cools, front].into_iter().flatten();
    all.fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], of| [low.min(of), high.max(of)])
}

fn close(found: f64, expected: f64, scale: f64, tolerance: f64) -> Result<(), TestCaseError> {
    prop_assert!((found - expected).abs() <= tolerance * scale, "{found} {expected}");
    Ok(())
}

proptest! {
    #![proptest_config(config(300))]

    #[test]
    fn mass_and_energy_are_kept(events in events(), latent in any::<bool>(), voidage in 0.2..0.8) {
        let model = model(latent);
        let mut deposit = Deposit::default();
        for Event { arrivals, cooling, duration } in &events {
            let source = arrivals.iter().fold(DepositSource::default(), DepositSource::with);
            let grown = deposit.with(&source);
            let arrived: f64 = arrivals.iter().map(|one| one.mass).sum();
            close(grown.mass(), deposit.mass() + arrived, grown.mass(), 1e-12)?;
            prop_assert!(grown.layers().outwards().iter().all(|mass| *mass >= 0.0), "{grown:?}");

            let step = model.front_step(0, &grown, voidage, cooling, *duration).unwrap();
            let heat = if latent { HEAT_OF_FUSION } else { 0.0 };
            let scale = step.from_gas.abs().max(step.to_coolant.abs()).max(heat * step.melted.abs());
            close(step.from_gas - step.to_coolant, heat * step.melted, scale, 1e-8)?;
            close(step.masses.molten - grown.molten, step.melted, grown.mass(), 1e-12)?;

            let around = Surroundings { voidage, cooling: Some(*cooling), ..Surroundings::default() };
            let (after, losses, crossed) = model.advance(0, &grown, &around, *duration).unwrap();
            prop_assert_eq!(losses, [0.0; PROCESS_COUNT]);
            close(crossed.from_gas - crossed.to_coolant, crossed.fusion, scale, 1e-8)?;
            close(crossed.fusion, heat * step.melted, scale, 1e-12)?;
            close(after.mass(), grown.mass(), grown.mass(), 1e-12)?;
            close(after.molten, step.masses.molten, grown.mass(), 1e-12)?;
            prop_assert!(after.slag() > 0.0 || after.enclosed() == 0.0);
            prop_assert!(after.closed >= 0.0 && after.solid >= 0.0 && after.cover >= 0.0, "{after:?}");

            let found = model.wall_heat(0, &after, voidage, cooling).unwrap();
            let [low, high] = extremes(cooling, after.slag() > 0.0);
            for [cold, hot] in found.sides.outwards() {
                for kelvin in [cold, hot] {
                    prop_assert!(kelvin >= low * (1.0 - 1e-9) && kelvin <= high * (1.0 + 1e-9), "{found:?}");
                }
            }
            deposit = after;
        }
    }

    /// However it came to lie there, slag that is cooled for long is frozen, and slag that is heated for
    /// long has no solid below it.
    #[test]
    fn slag_freezes_when_it_is_cooled_and_melts_when_it_is_heated(
        events in events(), voidage in 0.2..0.8, cold in 400.0..1300.0, hot in 1500.0..2500.0,
    ) {
        let model = model(true);
        let mut deposit = Deposit::default();
        for Event { arrivals, cooling, duration } in &events {
            let around = Surroundings { voidage, cooling: Some(*cooling), ..Surroundings::default() };
            let grown = deposit.with(&arrivals.iter().fold(DepositSource::default(), DepositSource::with));
            deposit = model.advance(0, &grown, &around, *duration).unwrap().0;
        }
        for (kelvin, frozen) in [(cold, true), (hot, false), (cold, true)] {
            let same = WallCooling {
                coolant: Coolant { temperature: kelvin, coefficient: 1e3 },
                wall_resistance: 1e-4,
                hot: HotSide {
                    gas_temperature: kelvin,
                    coefficient: 100.0,
                    emissivity: 0.0,
                    irradiation: 0.0,
                    particle_flux: 0.0,
                },
                void_gas: VoidGas { conductivity: 0.06, temperature: 800.0, exponent: VoidGas::AIR },
                vapour: VapourSide::default(),
            };
            let around = Surroundings { voidage, cooling: Some(same), ..Surroundings::default() };
            for _ in 0..3 {
                deposit = model.advance(0, &deposit, &around, 1e9).unwrap().0;
            }
            if frozen {
                prop_assert_eq!(deposit.molten, 0.0);
            } else {
                prop_assert_eq!((deposit.frozen, deposit.powder), (0.0, 0.0));
            }
        }
    }
}
