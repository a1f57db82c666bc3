//! The fates of char on slag from a model file: entrapment, segregation, coverage, over-layering.

use std::path::Path;

use nearwall::deposit::{Deposit, DepositSource};
use nearwall::{Impact, ImpactRng, Model};

fn model() -> Model {
    Model::from_file(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/char_on_slag.toml")).unwrap()
}

/// Unburnt char of 75 µm and 700 kg/m³ on slag of 1800 K.
fn char_at(normal_speed: f64) -> Impact {
    Impact {
        normal_speed,
        diameter: 75e-6,
        particle_temperature: 1700.0,
        wall_temperature: 1800.0,
        particle_density: 700.0,
        conversion: 0.1,
        ..Impact::default()
    }
}

/// Whether the slag draws the char in; `None` where no liquid decides.
fn submerged(model: &Model, impact: &Impact) -> Option<bool> {
    let (outcome, trace) = model.explain(0, impact, ImpactRng::new(1, 0)).unwrap();
    let entry = trace.iter().find(|entry| entry.quantity == "submerged")?;
    assert!(outcome.stuck, "{outcome:?}");
    Some(entry.value == 1.0)
}

/// By hand: drag takes 18 · 0.1/(700 · 75e-6) = 34.29 m/s, submerging another sqrt(3 · 0.55 · 1.5²/(700 · 75e-6)) = 8.41 m/s.
#[test]
fn fast_char_is_entrapped_and_slower_char_segregates() {
    let model = model();
    for (speed, sinks) in [(2.0, false), (20.0, false), (42.6, false), (42.8, true), (100.0, true)] {
        assert_eq!(submerged(&model, &char_at(speed)), Some(sinks), "{speed} m/s");
    }
}

/// Char of the projected area 2 on the slag covers 1 - exp(-2) of it; what remains bare holds the next one.
#[test]
fn much_char_covers_the_slag_and_lets_the_next_one_go() {
    let (model, impact) = (model(), char_at(2.0));
    let mass = 2.0 / 1.5 * 700.0 * 75e-6;
    let char = model.add_captured(0, &impact, mass, 700.0, DepositSource::default()).unwrap();
    let covered = Deposit::default().with(&char);
    let next = model.apply_deposit(0, &covered, 0.5, &impact).unwrap();
    assert!((next.coverage - 0.8647).abs() < 1e-4, "{next:?}");
    let bare = model.resolve(0, &impact, ImpactRng::new(1, 0)).unwrap().sticking_probability;
    let on_char = model.resolve(0, &next, ImpactRng::new(1, 0)).unwrap().sticking_probability;
    assert_eq!(bare, 1.0);
    assert!((on_char - 0.1353).abs() < 1e-3, "{on_char}");
}

/// Molten ash of the projected area 1 on top, which spreads to 4: ln(1 + exp(-4) (exp(2) - 1)) =
/// 0.1107 of the char's cover of 2 stays outside.
#[test]
fn fresh_slag_lies_over_the_char() {
    let (model, char) = (model(), char_at(2.0));
    let ash = Impact { conversion: 1.0, particle_density: 2750.0, particle_temperature: 1800.0, ..char };
    let source = |impact: &Impact, area: f64, density: f64| {
        let mass = area / 1.5 * density * 75e-6;
        model.add_captured(0, impact, mass, density, DepositSource::default()).unwrap()
    };
    let before = Deposit::default().with(&source(&char, 2.0, 700.0));
    let after = before.with(&source(&ash, 1.0, 2750.0));
    assert!(before.molten == 0.0 && before.coverage() > 0.86);
    assert!((after.coverage() - (1.0 - (-0.1107_f64).exp())).abs() < 1e-4, "{after:?}");
    assert!(
        (after.mass() - before.mass() - 1.0 / 1.5 * 2750.0 * 75e-6).abs() < 1e-9,
        "char is buried, not lost"
    );
    let next = model.apply_deposit(0, &after, 0.5, &char).unwrap();
    let held = model.resolve(0, &next, ImpactRng::new(1, 0)).unwrap().sticking_probability;
    assert!((held - (-0.1107_f64).exp()).abs() < 0.02, "{held}");
}
