//! Which properties are tested for random models and impacts, and how to run the tests.

use crate::study::{StudyPart, table};

/// Group of tests (a file of tests/properties) and what it says.
const PROPERTY_TESTS: [[&str; 2]; 13] = [
    ["bounds", "e_n, e_t and the probability of capture lie in 0 to 1 for every law and effect (1)"],
    ["bounds", "inputs of 1e-300 to 1e300 give numbers, and no panic"],
    ["energy", "motion and spin together never gain, with any spin, for every law and effect (2)"],
    ["energy", "a sphere that rolls goes on rolling, whatever the friction"],
    [
        "monotone",
        "e_n over speed is one hill, and falls throughout without adhesion; the rebound speed rises",
    ],
    ["monotone", "v_s rises with W and falls with d; e_n rises with strength and size, falls with W"],
    ["monotone", "e_t of sliding falls with the angle from the surface"],
    ["monotone", "capture rises with melting, conversion and thinner slag, falls with covering"],
    ["monotone", "every effect goes the way it says: powder, film, heat, size, speed, gas, obliquity"],
    [
        "continuous",
        "no jump at v_adh, v_y, v_s, the critical angle of tangential-compliance, the end of sliding",
    ],
    ["continuous", "no jump at h = asperity, St_c, min(1, mu_ref/mu), layer 0, coverage 0 and 1, any onset"],
    ["continuous", "sliding-rolling jumps from 1-2k/(7k-1) to 5/7, as the paper has it"],
    ["units", "the same outcome in other kilograms, metres, seconds and kelvins, with every effect (3)"],
];

pub fn part() -> StudyPart {
    StudyPart {
        heading: "Properties that hold for every model".to_owned(),
        text: vec![
            "Random models (laws, effects and their parameters) and impacts; a case that fails is cut down \
             to the smallest one, and the seed is printed, so that NEARWALL_TEST_SEED repeats it. All run \
             with cargo test --test properties; add the word of the first column to run one group."
                .to_owned(),
            "Exceptions by design: (1) micro-roughness, agglomerates, gas-lift and a negative \
             oblique-angle, which may raise e_n above 1, near_normal above 1, and e_t with incoming spin. \
             (2) gas-lift and agglomerates, into which energy comes from elsewhere; a negative \
             oblique-angle, which raises e_n and leaves e_t as it is; near_normal outside 3/7 to 1. (3) the \
             1 m/s in oblique-angle, which is counted; polynomials and the viscosity fits of slags, which \
             are relations between numbers."
                .to_owned(),
        ],
        tables: vec![table(
            "",
            2,
            "group | property",
            PROPERTY_TESTS.map(|row| row.map(str::to_owned).to_vec()).to_vec(),
        )],
        ..StudyPart::default()
    }
}
