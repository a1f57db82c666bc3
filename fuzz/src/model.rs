//! A model file.

use nearwall::{Impact, ImpactRng, Model};

use super::bytes::file;
use super::place;

const FILE: &str = "m.toml";

/// Models that are accepted, with all laws and effects.
const WHOLE_MODEL: [&str; 7] = [
    include_str!("../../tutorials/slaggingGasifier/constant/nearWall.toml"),
    include_str!("../../tutorials/standalone/waxRig.model.toml"),
    include_str!("../../tutorials/standalone/tungstenDust.model.toml"),
    include_str!("models/own-materials.toml"),
    include_str!("models/effects.toml"),
    include_str!("models/droplet.toml"),
    include_str!("models/groups.toml"),
];

/// Any text is refused with its place, or is a model that decides every impact or says why not.
pub fn model(bytes: &[u8]) {
    let Some(text) = file(&WHOLE_MODEL, bytes) else { return };
    let text = text.as_ref();
    match Model::from_toml(FILE, text) {
        Err(error) => place(&error.to_string(), FILE, text),
        Ok(model) => {
            assert!(model.describe().len() > 2);
            let again = Model::from_toml(FILE, text).expect("what was accepted once");
            decides(&model, &again);
        }
    }
}

/// Impacts that reach into every law.
fn impacts() -> [Impact; 8] {
    let usual = Impact { normal_speed: 2.0, tangential_speed: 1.0, ..Impact::default() };
    [
        usual,
        Impact { normal_speed: 0.0, tangential_speed: 0.0, ..usual },
        Impact { particle_temperature: 1700.0, wall_temperature: 1700.0, conversion: 0.8, ..usual },
        Impact { layer_thickness: 1e-4, film_thickness: 1e-5, gas_speed: 20.0, roughness: 1e-7, ..usual },
        Impact { spin: -1e4, coverage: 0.5, conversion: 0.0, ..usual },
        Impact { normal_speed: 5e-324, tangential_speed: 5e-324, diameter: 5e-324, spin: 5e-324, ..usual },
        Impact {
            normal_speed: f64::MAX,
            tangential_speed: f64::MAX,
            diameter: f64::MAX,
            spin: f64::MAX,
            ..usual
        },
        Impact {
            normal_speed: 1e-160,
            diameter: 1e-160,
            particle_temperature: 1e300,
            wall_temperature: 1e-300,
            ..usual
        },
    ]
}

/// Every answer is a number, a probability lies between 0 and 1, and the same model gives the same bits.
fn decides(model: &Model, again: &Model) {
    for wall in 0..=model.walls().len().min(3) {
        for (key, impact) in impacts().iter().enumerate() {
            let draw = ImpactRng::new(7, key as u64);
            let checked = model.check(wall, impact);
            let found = model.resolve(wall, impact, draw);
            assert_eq!(checked.is_ok(), found.is_ok(), "check {checked:?}, resolve {found:?}");
            let explained = model.explain(wall, impact, draw).map(|(outcome, _)| outcome);
            let speeds = model.speeds(wall, impact);
            let Ok(outcome) = found else { continue };
            let bits = |outcome: &nearwall::Outcome| {
                let o = outcome;
                [o.normal_restitution, o.tangential_restitution, o.sticking_probability, o.spin]
                    .map(f64::to_bits)
            };
            for other in [again.resolve(wall, impact, draw), explained] {
                let other = other.expect("as the first time");
                assert_eq!((bits(&other), other.stuck), (bits(&outcome), outcome.stuck));
            }
            let ordinary = (1e-100..1e100).contains(&impact.diameter) && impact.particle_temperature < 1e100;
            assert!((0.0..=1.0).contains(&outcome.sticking_probability), "{outcome:?} of {impact:?}");
            assert!(outcome.normal_restitution >= 0.0, "{outcome:?} of {impact:?}");
            assert!(
                !outcome.tangential_restitution.is_nan() && !outcome.spin.is_nan(),
                "{outcome:?} of {impact:?}"
            );
            if ordinary {
                assert!(outcome.normal_restitution.is_finite(), "{outcome:?} of {impact:?}");
            }
            let speeds = speeds.expect("as resolve");
            assert!(
                speeds.sticking >= 0.0 && speeds.adhesive >= 0.0 && speeds.yielding >= 0.0,
                "{speeds:?} of {impact:?}"
            );
        }
        if let Ok(ranges) = model.temperature_ranges(wall) {
            assert!(!ranges.particle[0].is_nan() && !ranges.wall[1].is_nan());
        }
    }
    for wall in model.walls() {
        assert!(model.find_wall(wall.name()).is_some());
    }
    let _ = model.find_wall("quenchRing");
}
