//! Energy: an impact never increases the energy of motion and spin.

use nearwall::{Impact, ImpactRng, Outcome};
use proptest::prelude::*;

use crate::cases::{config, decades, effects_but, normal_laws, spinning, table, tangential_laws, wax};

/// Motion and spin of a solid sphere per mass [m²/s²].
fn before(impact: &Impact) -> f64 {
    energy(impact.normal_speed, impact.tangential_speed, impact.spin * impact.diameter)
}

fn after(impact: &Impact, outcome: &Outcome) -> f64 {
    energy(
        outcome.normal_restitution * impact.normal_speed,
        outcome.tangential_restitution * impact.tangential_speed,
        outcome.spin * impact.diameter,
    )
}

/// Moment of inertia `m d²/10`, so `omega² d²/20` per mass.
fn energy(normal: f64, along: f64, rim: f64) -> f64 {
    0.5 * (normal * normal + along * along) + rim * rim / 20.0
}

/// Its `near_normal` outside 3/7 to 1 makes `e_t` alone add energy: tested within.
const DRIVEN: [&str; 1] = ["tangential-compliance"];

proptest! {
    #![proptest_config(config(600))]

    #[test]
    fn no_law_and_no_effect_makes_energy(
        normal in normal_laws(),
        tangential in tangential_laws(),
        effects in effects_but(&DRIVEN),
        impact in spinning(),
        oblique in (-20.0..20.0, 0.0..3.0),
        still in any::<bool>(),
        key in any::<u64>(),
    ) {
        let impact = Impact { spin: if still { 0.0 } else { impact.spin }, ..impact };
        let effects = effects + &table("oblique-angle", &[oblique.0, oblique.1, 2.0]);
        let outcome = wax(&normal, &tangential, &effects).resolve(0, &impact, ImpactRng::new(1, key)).unwrap();
        let (before, after) = (before(&impact), after(&impact, &outcome));
        prop_assert!(after <= before * (1.0 + 1e-12), "{before} -> {after}: {outcome:?}\n{tangential}\n{effects}");
    }

    /// Within `near_normal` of 3/7 (the slip comes back whole) to 1 (nothing is lost).
    #[test]
    fn tangential_compliance_makes_no_energy(
        friction in decades(1e-3, 10.0),
        near_normal in 3.0 / 7.0..=1.0,
        exponent in decades(0.05, 20.0),
        e_n in 0.0..=1.0,
        impact in spinning(),
    ) {
        let normal = crate::cases::constant_normal(e_n);
        let effect = table("tangential-compliance", &[friction, near_normal, exponent]);
        let outcome = wax(&normal, crate::cases::FREE, &effect).resolve(0, &impact, ImpactRng::default()).unwrap();
        let (before, after) = (before(&impact), after(&impact, &outcome));
        prop_assert!(after <= before * (1.0 + 1e-12), "{before} -> {after}: {outcome:?}");
    }

    /// Where the contact does not slip any friction is idle: a sphere that rolls goes on rolling.
    #[test]
    fn rolling_spheres_keep_rolling(tangential in tangential_laws(), e_n in 0.0..=1.0, impact in spinning()) {
        let by_friction = ["\"sliding", "maw-barber-fawcett"].iter().any(|law| tangential.contains(law));
        prop_assume!(by_friction && impact.tangential_speed > 0.0);
        let impact = Impact { spin: 2.0 * impact.tangential_speed / impact.diameter, ..impact };
        let model = wax(&crate::cases::constant_normal(e_n), &tangential, "");
        let outcome = model.resolve(0, &impact, ImpactRng::default()).unwrap();
        prop_assert!((outcome.tangential_restitution - 1.0).abs() < 1e-12, "{outcome:?}");
        prop_assert!((outcome.spin / impact.spin - 1.0).abs() < 1e-12, "{outcome:?}");
    }
}
