//! Which properties are tested for random models and impacts, and how to run the tests.

use nearwall::report::Table;

use crate::study::Part;

pub fn part() -> Part {
    let row = |cells: [&str; 2]| cells.map(str::to_owned).to_vec();
    Part {
        heading: "Properties that hold for every model".to_owned(),
        text: vec![
            "Random models (laws, effects and their parameters) and impacts; a case that fails is cut down to the smallest one, and \
             the seed is printed, so that NEARWALL_TEST_SEED repeats it. All run with cargo test --test properties; add the word of \
             the first column to run one group. The exceptions stand in the files under tests/properties with their reasons."
                .to_owned(),
        ],
        tables: vec![Table {
            caption: String::new(),
            header: ["group", "property"].map(str::to_owned).to_vec(),
            rows: vec![
                row(["bounds", "e_n, e_t and the probability of capture lie in 0 to 1 for every law and effect; exceptions by design: \
                     micro-roughness, agglomerates, gas-lift, a negative oblique-angle, near_normal above 1, e_t with incoming spin"]),
                row(["bounds", "inputs of 1e-300 to 1e300 give numbers, and no panic"]),
                row(["energy", "motion and spin together never gain, for every law and effect but those driven from outside, with any spin"]),
                row(["energy", "a sphere that rolls goes on rolling, whatever the friction"]),
                row(["monotone", "e_n over speed is one hill (falls throughout without adhesion); v_s rises with W and falls with d; e_t of \
                     sliding falls with the angle; capture rises with melting, conversion and thinner slag, and falls with covering; \
                     each effect goes the way it says"]),
                row(["continuous", "no jump at v_adh, v_y, v_s, the critical angle (with any spin), the end of sliding, a film of the \
                     asperities' height, St_c, min(1, mu_ref/mu), no layer, full covering, every onset; sliding-rolling jumps from \
                     1-2k/(7k-1) to 5/7 by design"]),
                row(["units", "the outcome is the same in other kilograms, metres, seconds and kelvins, with every effect; the 1 m/s hidden in \
                     oblique-angle is counted"]),
            ],
            text_columns: 2,
        }],
        ..Part::default()
    }
}
