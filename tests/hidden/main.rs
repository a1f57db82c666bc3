//! Sets with a planted cause that `nearwall diagnose` has to find, made without any of the crate's own laws.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "clippy.toml's leave for tests does not reach their helpers"
)]

mod campaign;
mod contact;
mod dice;
mod gain;
mod migraine;
mod plant;
#[path = "../common/random.rs"]
mod random;
mod sets;
mod world;

use std::path::Path;

/// Writes every set to the folder `NEARWALL_HIDDEN_OUT`.
#[test]
#[ignore = "writes files on request"]
fn write_sets() {
    let folder = std::env::var("NEARWALL_HIDDEN_OUT").unwrap();
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder).unwrap();
    let seed = random::seed();
    for recipe in sets::recipes(1) {
        let set = recipe.make(seed);
        let file = |ending: &str| folder.join(format!("{}.{ending}", set.name.replace(':', "-")));
        std::fs::write(file("csv"), &set.csv).unwrap();
        std::fs::write(file("toml"), set.model()).unwrap();
        std::fs::write(file("truth.json"), serde_json::to_string_pretty(&set.truth()).unwrap()).unwrap();
        println!(
            "{:45} rows {:4} base {:8.1} refit {:8.1} stuck {}",
            set.name,
            set.rows.len(),
            set.gain.over_base,
            set.gain.over_refitted,
            set.rows.iter().filter(|r| r.stuck).count()
        );
    }
}
