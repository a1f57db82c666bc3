//! A model that shows every regime, and impacts for it: ordinary ones at random, hostile ones on purpose.
#![allow(dead_code, reason = "each test uses its part")]
#![allow(clippy::unwrap_used, reason = "clippy.toml's leave for tests does not reach their helpers")]

use nearwall::impact::INPUTS;
use nearwall::{Impact, ImpactRng};

/// Ash that melts and burns out, a bare and a slag-covered wall, powder, and a steel wall known up to 873 K only.
pub const EVERY_REGIME: &str = r#"
[particle]
material = "fly-ash"
[walls.default]
material = "refractory"
[walls.slag]
material = "refractory"
slag = "coal-slag"
[walls."quench.*"]
material = "stainless-steel"
layer_thickness = 1e-5
[normal]
model = "thornton-ning"
yield_ratio = 1.6
[tangential]
model = "sliding-rolling"
friction = 0.3
[capture]
model = "viscosity"
law = "kalmanovitch-frank"
reference_viscosity = 1e4
[[effects]]
kind = "conversion-transition"
threshold = 0.7
width = 0.05
[[effects]]
kind = "powder-layer"
thickness = 0.128e-3
residual = 0.25
"#;

/// How many walls `EVERY_REGIME` has.
pub const WALLS: usize = 3;

/// A seed that differs from run to run; printed, and taken from `NEARWALL_TEST_SEED` to repeat a run.
pub fn seed() -> u64 {
    let given = std::env::var("NEARWALL_TEST_SEED").ok().map(|seed| seed.parse().unwrap());
    let clock = || std::time::UNIX_EPOCH.elapsed().unwrap().as_nanos() as u64;
    let seed = given.unwrap_or_else(clock);
    println!("NEARWALL_TEST_SEED={seed}");
    seed
}

/// One impact with its wall and its draw.
pub type Case = (usize, Impact, ImpactRng);

/// Impacts over all regimes, some of them on a wall that is too hot for its table.
pub fn random_cases(seed: u64, count: u64) -> Vec<Case> {
    (0..count).map(|index| random_case(seed, index)).collect()
}

fn random_case(seed: u64, index: u64) -> Case {
    let draw = ImpactRng::new(seed, index);
    let mut stream = 100;
    let mut uniform = |low: f64, high: f64| {
        stream += 1;
        low + (high - low) * draw.uniform(stream)
    };
    let mut impact = Impact::default();
    for input in &INPUTS {
        let value = match (input.name, input.unit) {
            ("d", _) => 10_f64.powf(uniform(-6.0, -3.0)),
            ("T_p", _) => uniform(600.0, 2200.0),
            ("T_w", _) => uniform(600.0, 1950.0),
            // A wall under a deposit, in part of the cases.
            ("T_under", _) => Some(uniform(-870.0, 870.0)).filter(|kelvin| *kelvin > 300.0).unwrap_or(0.0),
            ("conversion", _) => uniform(0.5, 1.0),
            ("omega", _) => uniform(-1e4, 1e4),
            ("film_thickness", _) => uniform(-1e-3, 1e-3).max(0.0),
            ("layer_thickness", _) => uniform(-3e-4, 1e-4).max(0.0),
            ("roughness", _) => uniform(-1e-6, 1e-6).max(0.0),
            (_, "m/s") => 10_f64.powf(uniform(-3.0, 2.0)),
            (_, "m") => uniform(-1e-4, 1e-4).max(0.0),
            _ => uniform(-2.0, 1.0).max(0.0),
        };
        (input.set)(&mut impact, value);
    }
    ((uniform(0.0, 1.0) * WALLS as f64) as usize, impact, draw)
}

/// Numbers that break arithmetic.
pub const HOSTILE: [f64; 15] = [
    0.0,
    -0.0,
    5e-324,
    f64::MIN_POSITIVE,
    1e-300,
    1e-30,
    1.0,
    1e30,
    1e300,
    f64::MAX,
    -1.0,
    -f64::MAX,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// Ordinary impacts with one or two inputs replaced by each hostile number, and one on a wall that is not there.
pub fn hostile_cases() -> Vec<Case> {
    let base = Impact { normal_speed: 1.0, tangential_speed: 0.5, ..Impact::default() };
    let mut cases = vec![(usize::try_from(u32::MAX).unwrap(), base, ImpactRng::default())];
    for (first, one) in INPUTS.iter().enumerate() {
        for other in &INPUTS[first..] {
            for (index, a) in HOSTILE.iter().enumerate() {
                for b in &HOSTILE {
                    let mut impact = base;
                    (other.set)(&mut impact, *b);
                    (one.set)(&mut impact, *a);
                    cases.push((index % WALLS, impact, ImpactRng::new(7, cases.len() as u64)));
                }
            }
        }
    }
    cases
}
