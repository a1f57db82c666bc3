//! What disperses particles in standalone cases: turbulence, thermophoresis, Brownian motion, against exact solutions
//! and published deposition.

use std::f64::consts::PI;

use nearwall::transport::brownian::BOLTZMANN;
use nearwall::transport::thermophoresis;
use nearwall_lab::simulate::{Fate, Trajectory};

use crate::simulate::{AIR, trajectories_of};

/// Every particle that touches a wall stays there.
const MODEL: &str = r#"
[model.particle]
material = "montan-wax"
[model.walls.default]
material = "pyrex"
[model.normal]
model = "constant"
e_n = 0
[model.tangential]
model = "constant"
e_t = 0
"#;

/// Kinematic viscosity of [`AIR`] [m²/s].
const VISCOSITY: f64 = 1.5e-5;
const RADIUS: f64 = 0.01;
const FRICTION_VELOCITY: f64 = 0.3;

fn trajectories(text: &str) -> Vec<Trajectory> {
    trajectories_of(text).0
}

/// A turbulent pipe of `y+` = 200 from wall to axis, filled evenly with particles.
fn pipe(count: u32, diameter: f64, time: f64, more: &str) -> Vec<Trajectory> {
    rough_pipe(count, diameter, time, more, 0.0)
}

/// The same with peaks of a height [m] on its wall.
fn rough_pipe(count: u32, diameter: f64, time: f64, more: &str, peak_height: f64) -> Vec<Trajectory> {
    trajectories(&format!(
        "{MODEL}[run]\ntime_limit = {time}\ngravity = [0, 0, 0]\nseed = 3\n\
         [gas]\nfield = \"duct\"\ndirection = [0, 0, 1]\ndiameter = {}\nspeed = 5\nflow = \"turbulent\"\n\
         friction_velocity = {FRICTION_VELOCITY}\ntemperature = 300\n{AIR}\n{more}\n[gas.turbulence]\n\
         [particles]\ncount = {count}\n\
         position = {{ shape = \"disc\", center = [0, 0, 0], normal = [0, 0, 1], radius = {} }}\n\
         direction = [0, 0, 1]\nspeed = 0\nrelative_to_gas = true\ndiameter = {diameter}\ntemperature = 300\n\
         density = 1000\n[[walls]]\nname = \"pipe\"\nshape = \"pipe\"\nradius = {RADIUS}\nzone = [-10, 1e4]\n\
         temperature = 300\npeak_height = {peak_height}\n",
        2.0 * RADIUS,
        0.99 * RADIUS
    ))
}

/// Relaxation time over `nu/u_tau²` to diameter [m], without slip.
fn diameter_of(relaxation_plus: f64) -> f64 {
    let relaxation = relaxation_plus * VISCOSITY / (FRICTION_VELOCITY * FRICTION_VELOCITY);
    (18.0 * 1.8e-5 * relaxation / 1000.0).sqrt()
}

/// A tracer that fills the pipe evenly keeps filling it: ten rings of equal area hold as many particles each, within
/// five standard errors, after 8000 viscous times (1.3 s). They start up to 0.99 of the radius, so that the last ring
/// lacks a fifth: a tracer hardly moves at `y+` below 2.
#[test]
fn a_tracer_stays_mixed() {
    let count = 4000;
    let mut rings = [0.0; 10];
    for trajectory in pipe(count, 1e-7, 1.3, "") {
        assert_eq!(trajectory.fate, Fate::Airborne);
        let share = trajectory.position.xy().norm_squared() / (RADIUS * RADIUS);
        rings[((10.0 * share) as usize).min(9)] += 1.0;
    }
    let expected = f64::from(count) / 10.0;
    println!("particles in rings of equal area, from the axis: {rings:?}");
    assert!(rings.iter().all(|ring| (ring - expected).abs() < 5.0 * expected.sqrt()), "{rings:?}");
}

/// Deposition velocity over friction velocity in the pipe, between 1/4 and all of the time.
fn deposition(diameter: f64, count: u32, time: f64, more: &str) -> [f64; 2] {
    deposition_of(&pipe(count, diameter, time, more), time)
}

/// The same of these particles of a pipe, which flew for a time [s].
fn deposition_of(all: &[Trajectory], time: f64) -> [f64; 2] {
    let hits: Vec<f64> =
        all.iter().map(|trajectory| trajectory.hits.first().map_or(f64::INFINITY, |hit| hit.time)).collect();
    let (from, to) = (0.25 * time, time);
    let stayed: f64 = hits.iter().map(|hit| (hit.min(to) - from).max(0.0)).sum();
    let landed = hits.iter().filter(|hit| (from..to).contains(*hit)).count() as f64;
    // Particles over area and time, over particles over volume.
    [landed / stayed * 0.5 * RADIUS / FRICTION_VELOCITY, 1.0 / landed.sqrt()]
}

/// Fits of measured deposition, `V+ = 3.25e-4 tau+²` (McCoy and Hanratty 1977) to `6e-4 tau+²` (Liu and Agarwal 1974)
/// up to 10, 0.1 to 0.17 above: within a factor of two from 5 on, known to be low below. Particles below 10 gather at
/// the wall for a thousand viscous times first; those of Liu and Agarwal had 3000 to 10 000.
#[test]
fn particles_deposit_as_measured() {
    for (relaxation, low, high, factor, count, time) in [
        (3.0, 2.9e-3, 5.4e-3, 3.0, 2000, 0.5),
        (5.0, 8.1e-3, 0.015, 2.0, 1000, 0.5),
        (10.0, 0.0325, 0.06, 2.0, 1000, 0.3),
        (30.0, 0.1, 0.17, 2.0, 1000, 0.12),
        (100.0, 0.1, 0.17, 2.0, 1000, 0.12),
        (1000.0, 0.1, 0.17, 2.0, 1000, 0.12),
    ] {
        let [ours, error] = deposition(diameter_of(relaxation), count, time, "");
        println!("tau+ {relaxation}: V+ {ours:.4} +- {:.0} %", 100.0 * error);
        assert!((low / factor..factor * high).contains(&ours), "tau+ {relaxation}: {ours}");
    }
}

/// Tubes that count as smooth have peaks: on peaks of a quarter of the viscous length the particles of tau+ = 3, which
/// reach a smooth wall too seldom, deposit as measured, within a factor of two: 3.25e-4 tau+² to 6e-4 tau+². A particle
/// that touches them touched at no greater distance.
#[test]
fn peaks_catch_fine_particles_as_measured() {
    let (diameter, time) = (diameter_of(3.0), 0.5);
    let peak_height = 0.25 * VISCOSITY / FRICTION_VELOCITY;
    let all = rough_pipe(1000, diameter, time, "", peak_height);
    let [ours, error] = deposition_of(&all, time);
    println!("tau+ 3 on peaks of 0.25 viscous lengths: V+ {ours:.4} +- {:.0} %", 100.0 * error);
    assert!((2.9e-3 / 2.0..2.0 * 5.4e-3).contains(&ours), "{ours}");
    for hit in all.iter().filter_map(|trajectory| trajectory.hits.first()) {
        let gap = RADIUS - hit.position.xy().norm() - 0.5 * diameter - peak_height;
        assert!(gap.abs() < 1e-3 * diameter, "{gap}");
    }
}

/// Particles that diffuse to the wall through the weak end of turbulence: V+ = 0.084 Sc^(-2/3) (Cleaver and Yates) to
/// 0.057 Sc^(-2/3) (Davies), within a factor of two.
#[test]
fn the_finest_particles_deposit_by_diffusion() {
    let diameter = 1e-8;
    let knudsen = 2.0 * thermophoresis::mean_free_path(1.8e-5, 1.2, 101_325.0) / diameter;
    let slip = 1.0 + knudsen * (1.257 + 0.4 * (-1.1_f64 / knudsen).exp());
    let schmidt = VISCOSITY * 3.0 * PI * 1.8e-5 * diameter / (BOLTZMANN * 300.0 * slip);
    let [ours, error] = deposition(diameter, 4000, 0.12, "brownian = true\npressure = 101325");
    let fit = |factor: f64| factor * schmidt.powf(-2.0 / 3.0);
    println!(
        "Sc {schmidt:.0}: V+ {ours:.2e} +- {:.0} %, fits {:.2e} {:.2e}",
        100.0 * error,
        fit(0.057),
        fit(0.084)
    );
    assert!((0.5 * fit(0.057)..2.0 * fit(0.084)).contains(&ours), "Sc {schmidt}: {ours}");
}

/// One particle between walls of 300 and 400 K, 2 mm apart, without weight: it drifts with `-C' nu grad(T)/T`, so that
/// the time from the middle to the cold wall is `(T_0² - T_1²)/(2 C' nu grad(T)²)`.
#[test]
fn thermophoresis_drifts_to_the_cold_wall() {
    let pressure = 101_325.0;
    for diameter in [1e-8, 1e-7, 1e-6, 1e-5] {
        let text = format!(
            "{MODEL}[run]\ntime_limit = 1000\ngravity = [0, 0, 0]\n[gas]\nfield = \"duct\"\ndirection = [1, 0, 0]\n\
             up = [0, 0, 1]\nheight = 0.002\ncentre = [0, 0, 0.001]\nspeed = 1\nflow = \"laminar\"\n\
             thermophoresis = true\npressure = {pressure}\n\
             temperature = {{ axis = \"z\", at = [0, 0.002], value = [300, 400] }}\n{AIR}\n\
             [particles]\ncount = 1\nposition = {{ shape = \"point\", at = [0, 0, 0.001] }}\ndirection = [1, 0, 0]\n\
             speed = 1.5\ndiameter = {diameter}\ntemperature = 350\ndensity = 1000\nconductivity = 0.5\n\
             [[walls]]\nname = \"cold\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\ntemperature = 300\n\
             [[walls]]\nname = \"hot\"\nshape = \"plane\"\npoint = [0, 0, 0.002]\nnormal = [0, 0, -1]\n\
             temperature = 400\n"
        );
        let hit = trajectories(&text)[0].hits[0];
        assert_eq!(hit.surface, 0);
        let knudsen = 2.0 * thermophoresis::mean_free_path(1.8e-5, 1.2, pressure) / diameter;
        let slip = 1.0 + knudsen * (1.257 + 0.4 * (-1.1_f64 / knudsen).exp());
        let drift = thermophoresis::coefficient(knudsen, 0.026 / 0.5) * slip / (3.0 * PI);
        let gradient = 100.0 / 0.002;
        let cold = 300.0 + gradient * 0.5 * diameter;
        let time = (350.0_f64.powi(2) - cold * cold) / (2.0 * drift * VISCOSITY * gradient * gradient);
        let ratio = hit.time / time;
        println!("{diameter} m: {} s by hand {time} s", hit.time);
        assert!((ratio - 1.0).abs() < 2e-3, "{diameter}: {ratio}");
    }
}

/// Gas at rest over a plane: of particles at a height `h` the share `erfc(h/sqrt(4 D t))` has reached it (Smoluchowski).
#[test]
fn brownian_motion_reaches_a_wall_as_diffusion_does() {
    let (diameter, count) = (2e-8, 4000.0);
    let knudsen = 2.0 * thermophoresis::mean_free_path(1.8e-5, 1.2, 101_325.0) / diameter;
    let slip = 1.0 + knudsen * (1.257 + 0.4 * (-1.1_f64 / knudsen).exp());
    let diffusivity = BOLTZMANN * 300.0 * slip / (3.0 * PI * 1.8e-5 * diameter);
    let time = 0.5;
    let height = (2.0 * diffusivity * time).sqrt();
    let text = format!(
        "{MODEL}[run]\ntime_limit = {time}\ngravity = [0, 0, 0]\n[gas]\nfield = \"uniform\"\nvelocity = [0, 0, 0]\n\
         temperature = 300\npressure = 101325\nbrownian = true\n{AIR}\n\
         [particles]\ncount = {count}\nposition = {{ shape = \"point\", at = [0, 0, {}] }}\n\
         direction = [1, 0, 0]\nspeed = 0\ndiameter = {diameter}\ntemperature = 300\ndensity = 1000\n\
         [[walls]]\nname = \"floor\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\ntemperature = 300\n",
        height + 0.5 * diameter
    );
    let reached =
        trajectories(&text).iter().filter(|trajectory| !trajectory.hits.is_empty()).count() as f64 / count;
    // erfc(1/sqrt 2): the share of a normal distribution beyond one standard deviation.
    let exact = 0.317_310_5;
    println!("share at the wall {reached}, exact {exact}");
    assert!((reached - exact).abs() < 4.0 * (exact * (1.0 - exact) / count).sqrt(), "{reached}");
}

/// A gas of one temperature pushes nothing by thermophoresis, so that the path is the one that Dormand–Prince finds,
/// within 1 %: particles that are thrown onto a wall in a jet, slow and fast against the gas.
#[test]
fn without_a_push_the_path_is_that_of_the_mean_flow() {
    for diameter in [1e-5, 3e-5, 2e-4] {
        let hit = |more: &str| {
            let text = format!(
                "{MODEL}[run]\ntime_limit = 10\n[gas]\nfield = \"stagnation-jet\"\nspeed = 2\nheight = 0.03\n\
                 temperature = 300\n{AIR}\n{more}\n[particles]\ncount = 1\n\
                 position = {{ shape = \"point\", at = [0.001, 0, 0.05] }}\ndirection = [0.1, 0, -1]\nspeed = 5\n\
                 diameter = {diameter}\ntemperature = 300\ndensity = 2000\nconductivity = 1\n\
                 [[walls]]\nname = \"floor\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n\
                 temperature = 300\n"
            );
            trajectories(&text)[0].hits[0]
        };
        let (exact, ours) = (hit(""), hit("pressure = 1e9\nthermophoresis = true"));
        let pairs = [
            [exact.time, ours.time],
            [exact.impact.normal_speed, ours.impact.normal_speed],
            [exact.position.x, ours.position.x],
        ];
        println!("{diameter} m: {pairs:?}");
        assert!(pairs.iter().all(|[exact, ours]| (ours / exact - 1.0).abs() < 0.01), "{diameter}: {pairs:?}");
    }
}

/// A horizontal square duct with gravity down: the floor catches most, the ceiling least.
#[test]
fn a_horizontal_duct_has_a_floor_walls_and_a_ceiling() {
    let plane = |name: &str, point: &str, normal: &str| {
        format!(
            "[[walls]]\nname = \"{name}\"\nshape = \"plane\"\npoint = {point}\nnormal = {normal}\ntemperature = 300\n"
        )
    };
    let text = format!(
        "{MODEL}[run]\ntime_limit = 2\n[gas]\nfield = \"duct\"\ndirection = [1, 0, 0]\nup = [0, 0, 1]\nheight = 0.15\n\
         width = 0.15\nspeed = 5\nflow = \"turbulent\"\ntemperature = 300\n{AIR}\n[gas.turbulence]\n\
         [particles]\ncount = 1000\nposition = {{ shape = \"disc\", center = [0, 0, 0], normal = [1, 0, 0], \
         radius = 0.074 }}\ndirection = [1, 0, 0]\nspeed = 0\nrelative_to_gas = true\ndiameter = 40e-6\n\
         temperature = 300\ndensity = 1000\n{}{}{}{}",
        plane("floor", "[0, 0, -0.075]", "[0, 0, 1]"),
        plane("ceiling", "[0, 0, 0.075]", "[0, 0, -1]"),
        plane("left", "[0, -0.075, 0]", "[0, 1, 0]"),
        plane("right", "[0, 0.075, 0]", "[0, -1, 0]"),
    );
    let mut hits = [0; 4];
    for trajectory in trajectories(&text) {
        if let Some(hit) = trajectory.hits.first() {
            hits[hit.surface] += 1;
        }
    }
    println!("floor, ceiling, left, right: {hits:?}");
    let [floor, ceiling, left, right] = hits;
    assert!(floor > left + right && left + right > ceiling, "{hits:?}");
}
