//! Drops on walls: energy, bounds and order of the restitution.

use nearwall::capture::drop_bounce::{BounceNumbers, contact_diameter, weightless_restitution};
use nearwall::capture::drop_pinning::ContactAngles;
use nearwall::capture::drop_restitution::{BOUNCES_FROM, drop_restitution, energy_left};
use proptest::prelude::*;

use crate::cases::{config, decades};

fn numbers() -> impl Strategy<Value = BounceNumbers> {
    (decades(1e-5, 1e3), decades(1e-4, 10.0), decades(1e-6, 10.0))
        .prop_map(|(weber, ohnesorge, bond)| BounceNumbers { weber, ohnesorge, bond })
}

fn angles() -> impl Strategy<Value = ContactAngles> {
    (0.0..=180.0_f64, 0.0..=1.0_f64, any::<bool>()).prop_map(|(contact, share, given)| ContactAngles {
        contact: contact.to_radians(),
        receding: given.then(|| (contact * share).to_radians()),
    })
}

proptest! {
    #![proptest_config(config(2000))]

    /// What leaves is at most what arrives, `We/12` of the drop's surface energy, less what is lost.
    #[test]
    fn no_drop_leaves_with_more_than_arrives(numbers in numbers(), angles in angles()) {
        let arriving = numbers.weber / 12.0;
        let left = energy_left(&numbers, &angles);
        prop_assert!(left <= arriving * (1.0 + 1e-9), "{left} of {arriving}");
        if angles.contact >= BOUNCES_FROM {
            let oscillations = 1.0 - weightless_restitution(numbers.weber, numbers.ohnesorge).powi(2);
            let pinning = angles.pinning_work(contact_diameter(numbers.weber, numbers.bond), 0.0);
            let kept = arriving * (1.0 - oscillations) - pinning;
            prop_assert!(left <= kept.max(0.0) + 1e-12 * arriving, "{left} of {kept}");
        }
        let e_n = drop_restitution(&numbers, &angles);
        prop_assert!(e_n.is_none_or(|e_n| e_n > 0.0 && e_n <= 1.0), "{e_n:?}");
        prop_assert!(e_n.is_none() || left > 0.0);
    }

    /// A more viscous, a heavier and a more pinned drop never leaves faster.
    #[test]
    fn viscosity_weight_and_pinning_only_take(
        numbers in numbers(),
        contact in 150.0..=180.0_f64,
        receding in 0.0..=1.0_f64,
        more in decades(1.0, 100.0),
    ) {
        let contact = contact.to_radians();
        let wall = |share: f64| ContactAngles { contact, receding: Some(contact * share) };
        let e_n = |numbers: &BounceNumbers, share| drop_restitution(numbers, &wall(share)).unwrap_or(0.0);
        let plain = e_n(&numbers, receding);
        let stiffer = BounceNumbers { ohnesorge: more * numbers.ohnesorge, ..numbers };
        let heavier = BounceNumbers { bond: more * numbers.bond, ..numbers };
        for (what, changed) in
            [("Oh", e_n(&stiffer, receding)), ("Bo", e_n(&heavier, receding)), ("angle", e_n(&numbers, receding / more))]
        {
            prop_assert!(changed <= plain + 1e-12, "{what}: {changed} from {plain}");
        }
    }

    /// The energy left has no step over the contact angle: both laws meet between 120 and 150 degrees.
    #[test]
    fn the_laws_go_over_into_each_other(numbers in numbers(), contact in 60.0..179.0_f64) {
        let at = |contact: f64| {
            energy_left(&numbers, &ContactAngles { contact: contact.to_radians(), receding: None })
        };
        let (step, size) = (at(contact + 1e-6) - at(contact), 1.0 + numbers.weber);
        prop_assert!(step.abs() < 1e-5 * size, "{step} at {contact}");
    }

    /// Nor has it one over the Weber number, where the balance on spreading loses its root.
    #[test]
    fn the_energy_left_has_no_step_over_speed(numbers in numbers(), angles in angles()) {
        let at = |weber: f64| energy_left(&BounceNumbers { weber, ..numbers }, &angles);
        let step = at(numbers.weber * (1.0 + 1e-7)) - at(numbers.weber);
        prop_assert!(step.abs() < 1e-3 * (1.0 + numbers.weber), "{step}");
    }
}
