//! The published tungsten campaign: six sets with their counts, sizes, speeds and angles.
//! Counts and ranges: `published_scalars.csv`, rows W0 to Mo6. Where a range is not stated it is marked below.

use crate::campaign::{Campaign, Series, System};
use crate::contact::Tangential;
use crate::plant;
use crate::set_rng::SetRng;
use crate::sets::Design;

/// The yield ratio to be found.
pub const YIELD_RATIO: f64 = 4.0;
/// The tangential restitution to be found.
pub const E_T: f64 = 0.8;

/// A set as published.
type Published = (usize, (f64, f64), (f64, f64, f64), (f64, f64));

/// Rows, v_n, least mean and largest angle from the normal, sizes in µm. Set 6 is molten molybdenum.
const SETS: [Published; 6] = [
    (230, (1.36, 12.95), (0.0, 24.3, 73.4), (8.0, 10.0)),
    (65, (0.70, 8.86), (0.0, 22.9, 70.0), (8.0, 10.0)), // ends of the angle assumed
    (122, (0.78, 7.71), (0.0, 19.0, 70.0), (8.0, 10.0)), // ends of the angle assumed
    (41, (0.88, 4.50), (42.9, 60.6, 77.3), (8.0, 10.0)),
    (49, (0.57, 7.90), (0.0, 21.7, 70.0), (12.0, 16.0)), // ends of the angle assumed
    (13, (0.60, 8.00), (0.0, 22.0, 70.0), (12.0, 16.0)), // speeds and angles assumed
];

fn series(index: usize) -> Series {
    let (rows, v_n, theta, (small, large)) = SETS[index];
    let t_p = if index == 5 { 2950.0 } else { 3000.0 };
    Series { rows, v_n, theta, d: (small * 1e-6, large * 1e-6), t_p }
}

/// The campaign over a base with yield ratio 2.8 and e_t = 1.
pub fn plan(rng: &mut SetRng) -> Design {
    let mut campaign = Campaign::new(System::HotTungsten, Tangential::Constant(1.0), rng);
    campaign.columns = vec!["T_w"];
    campaign.extras = vec!["series"];
    campaign.series = (0..SETS.len()).map(series).collect();
    campaign.rows = SETS.iter().map(|set| set.0).sum();
    campaign.noise_e_n = rng.uniform((0.03, 0.06));
    campaign.noise_e_t = 1.2 * campaign.noise_e_n;
    let plants = vec![
        plant::yield_ratio(YIELD_RATIO),
        plant::nano_roughness(1.0, 0.7),
        plant::agglomerates(0.25, 0.62, 0.92),
        plant::oblique_loss(1.6, 1.5),
        plant::molten_series(5),
        plant::tangential_level(E_T),
    ];
    Design { campaign, plants }
}
