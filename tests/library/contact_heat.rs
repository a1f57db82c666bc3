//! The heat of a touch against conduction that is integrated through the growing and shrinking area of contact, and
//! that of a model by hand.

use approx::assert_relative_eq;
use nearwall::normal::{HalfSpace, Touch, contact_heat, touch};
use nearwall::{Impact, Model};

/// Area of the contact over its largest one [1], at even times from the first touch to the last: the motion
/// `x'' = -x^(3/2)` of Hertz' force by small steps.
fn hertz_areas() -> Vec<f64> {
    let (step, mut x, mut v) = (1e-3_f64, 0.0_f64, 1.0_f64);
    let force = |x: f64| -x.max(0.0).powf(1.5);
    let mut path = vec![0.0];
    while x >= 0.0 {
        let half = v + 0.5 * step * force(x);
        x += step * half;
        v = half + 0.5 * step * force(x);
        path.push(x.max(0.0));
    }
    let most = path.iter().copied().fold(0.0, f64::max);
    path.iter().map(|x| x / most).collect()
}

/// One of two half-spaces in cells of rings and layers of the same thickness.
struct Solid {
    temperatures: Vec<f64>,
    layers: usize,
    conductivity: f64,
    capacity: f64,
}

impl Solid {
    fn new(of: &HalfSpace, temperature: f64, cells: f64, rings: usize) -> Self {
        let capacity = of.density * of.heat_capacity;
        let layers = (3.5 * cells * (of.conductivity / capacity).sqrt()) as usize + 8;
        let temperatures = vec![temperature; rings * layers];
        Self { temperatures, layers, conductivity: of.conductivity, capacity }
    }

    /// One explicit step; no heat crosses the outer borders.
    fn conduct(&mut self, rings: usize, size: f64, step: f64) {
        let rate = step * self.conductivity / (self.capacity * size * size);
        let before = self.temperatures.clone();
        for (place, after) in self.temperatures.iter_mut().enumerate() {
            let (layer, ring) = (place / rings, place % rings);
            let here = before[place];
            let middle = ring as f64 + 0.5;
            let mut gain = 0.0;
            if ring > 0 {
                gain += ring as f64 / middle * (before[place - 1] - here);
            }
            if ring + 1 < rings {
                gain += (ring + 1) as f64 / middle * (before[place + 1] - here);
            }
            if layer > 0 {
                gain += before[place - rings] - here;
            }
            if layer + 1 < self.layers {
                gain += before[place + rings] - here;
            }
            *after = here + rate * gain;
        }
    }
}

/// Heat that a touch of radius 1 m for 1 s conducts, per kelvin, with so many cells over the radius.
fn integrated(particle: &HalfSpace, wall: &HalfSpace, cells: usize) -> f64 {
    let size = 1.0 / cells as f64;
    let diffusivity = |of: &HalfSpace| of.conductivity / (of.density * of.heat_capacity);
    let most = diffusivity(particle).max(diffusivity(wall));
    let rings = (cells as f64 * (1.0 + 3.5 * most.sqrt())) as usize + 2;
    let steps = (5.0 * most / (size * size)).ceil();
    let areas = hertz_areas();
    let mut solids = [(particle, 1.0), (wall, 0.0)].map(|(of, t)| Solid::new(of, t, cells as f64, rings));
    let across = 2.0 / (size / particle.conductivity + size / wall.conductivity);
    let mut heat = 0.0;
    for step in 0..steps as usize {
        let place = (step as f64 + 0.5) / steps * (areas.len() - 1) as f64;
        let between = place.fract();
        let area = areas[place as usize] * (1.0 - between) + areas[place as usize + 1] * between;
        let flows: Vec<f64> = (0..rings)
            .map_while(|ring| {
                let [inner, outer] = [ring, ring + 1].map(|edge| (edge as f64 * size).powi(2));
                let touched = area.clamp(inner, outer) - inner;
                let [hot, cold] = solids.each_ref().map(|solid| solid.temperatures[ring]);
                (touched > 0.0).then_some(touched / (outer - inner) * across * (hot - cold) / steps)
            })
            .collect();
        solids.iter_mut().for_each(|solid| solid.conduct(rings, size, 1.0 / steps));
        for (ring, flow) in flows.into_iter().enumerate() {
            heat += flow * std::f64::consts::PI * size * size * (2 * ring + 1) as f64;
            solids[0].temperatures[ring] -= flow / (size * solids[0].capacity);
            solids[1].temperatures[ring] += flow / (size * solids[1].capacity);
        }
    }
    heat
}

/// Equal and different solids, from quick to slow touches; the grid costs up to 2 %.
#[test]
fn conduction_through_the_contact_integrated() {
    let one = |conductivity, capacity| HalfSpace { density: 1.0, heat_capacity: capacity, conductivity };
    let cases = [
        (one(1.0, 10.0), one(1.0, 10.0), 24),
        (one(1.0, 1.0), one(1.0, 1.0), 16),
        (one(1.0, 0.3), one(1.0, 0.3), 10),
        (one(1.0, 10.0), one(0.1, 10.0), 24),
        (one(1.0, 10.0), one(10.0, 30.0), 20),
    ];
    for (particle, wall, cells) in cases {
        let ours = contact_heat(&Touch { duration: 1.0, radius: 1.0 }, &particle, &wall);
        assert_relative_eq!(ours, integrated(&particle, &wall, cells), max_relative = 0.05);
    }
}

const SAND: &str = r#"
[particle]
material = "sand"
[walls.default]
material = "steel"
contact_heat = true
[walls.plain]
material = "steel"
[normal]
model = "thornton-ning"
yield_ratio = 1.6
work_of_adhesion = 0.0
[tangential]
model = "constant"
e_t = 1
[materials.sand]
density = 2600
youngs_modulus = 7e10
poisson_ratio = 0.2
yield_strength = 1e12
surface_energy = 0.05
heat_capacity = 800
thermal_conductivity = 1.4
[materials.steel]
like = "sand"
density = 7900
youngs_modulus = 2e11
poisson_ratio = 0.3
heat_capacity = 480
thermal_conductivity = 15
"#;

fn heat(text: &str, wall: usize, impact: &Impact) -> f64 {
    Model::from_toml("m", text).unwrap().contact_heat(wall, impact).unwrap()
}

/// A grain of 200 µm and 900 K at 5 m/s on a wall of 400 K.
fn grain() -> Impact {
    Impact {
        normal_speed: 5.0,
        diameter: 200e-6,
        particle_temperature: 900.0,
        wall_temperature: 400.0,
        ..Impact::default()
    }
}

/// Sand of 200 µm at 900 K and 5 m/s on steel of 400 K, elastic: Hertz' radius and time and the quick touch by hand.
#[test]
fn an_elastic_grain_by_hand() {
    let impact = grain();
    let modulus = 1.0 / ((1.0 - 0.04) / 7e10 + (1.0 - 0.09) / 2e11);
    let mass = 2600.0 * std::f64::consts::PI / 6.0 * 200e-6_f64.powi(3);
    let depth = (15.0 * mass * 25.0 / (16.0 * modulus * 1e-2)).powf(0.4);
    let (area, time) = (std::f64::consts::PI * 100e-6 * depth, 2.943 * depth / 5.0);
    let [sand, steel] = [2600.0 * 800.0 * 1.4_f64, 7900.0 * 480.0 * 15.0].map(f64::sqrt);
    let quick = 0.87 * area * time.sqrt() / (1.0 / sand + 1.0 / steel);
    let ours = heat(SAND, 0, &impact);
    // The Fourier number of the sand is 0.004: slower conduction to the sides adds to the quick touch.
    assert!((1.0..1.06).contains(&(ours / (500.0 * quick))), "{ours:e} J, {:e} J", 500.0 * quick);
    let cold = Impact { particle_temperature: 400.0, wall_temperature: 900.0, ..impact };
    assert_relative_eq!(heat(SAND, 0, &cold), -ours, max_relative = 1e-12);
    assert_eq!(heat(SAND, 1, &impact), 0.0);
    assert_eq!(heat(SAND, 0, &Impact { normal_speed: 0.0, ..impact }), 0.0);
    assert_eq!(heat(SAND, 0, &Impact { wall_temperature: 900.0, ..impact }), 0.0);
}

/// A wall of one half covered by powder: the mean of both; none of a particle gives more than it has.
#[test]
fn powder_counts_by_its_area_and_heat_has_an_end() {
    let powder =
        format!("{SAND}[materials.wool]\nlike = \"sand\"\ndensity = 100\nthermal_conductivity = 0.05\n");
    let covered = powder.replace("contact_heat", "powder = \"wool\"\ncontact_heat");
    let impact = grain();
    let at = |coverage| heat(&covered, 0, &Impact { coverage, ..impact });
    assert_relative_eq!(at(0.5), 0.5 * (at(0.0) + at(1.0)), max_relative = 1e-12);
    assert!(at(1.0) < 0.2 * at(0.0));
    // So soft that it is flattened.
    let soft = SAND.replace("youngs_modulus = 7e10", "youngs_modulus = 1e3");
    let slow = Impact { normal_speed: 0.1, diameter: 1e-6, ..impact };
    let all = 800.0 * 2600.0 * std::f64::consts::PI / 6.0 * 1e-18 * 500.0;
    assert_relative_eq!(heat(&soft, 0, &slow), all, max_relative = 1e-12);
}

/// The file names the material that lacks a property.
#[test]
fn thermal_properties_are_required() {
    for (key, line) in
        [("heat_capacity", "heat_capacity = 800\n"), ("thermal_conductivity", "thermal_conductivity = 1.4\n")]
    {
        let error = Model::from_toml("m", &SAND.replace(line, "")).unwrap_err().to_string();
        assert!(error.contains(&format!("walls.default.contact_heat: `sand` has no {key}")), "{error}");
    }
}

/// The energy of a soft grain is the work against the yield pressure on Thornton's area `pi a² = pi R delta`:
/// `m v²/2 = p_y pi R delta²/2` without the elastic part.
#[test]
fn plastic_touches_are_as_wide_as_their_energy_says() {
    let text = SAND.replace("yield_strength = 1e12", "yield_strength = 1e7");
    let model = Model::from_toml("m", &text).unwrap();
    let impact = Impact { normal_speed: 20.0, diameter: 200e-6, ..Impact::default() };
    let contact = nearwall::normal::Contact {
        density: 2600.0,
        reduced_modulus: 1.0 / ((1.0 - 0.04) / 7e10 + (1.0 - 0.09) / 2e11),
        yield_strength: 1e7,
        yield_ratio: 1.6,
        ..Default::default()
    };
    let mass = 2600.0 * std::f64::consts::PI / 6.0 * 200e-6_f64.powi(3);
    let radius = (mass * 400.0 * 100e-6 / (std::f64::consts::PI * 1.6e7)).powf(0.25);
    let found = touch(&contact, impact.diameter, impact.normal_speed);
    assert_relative_eq!(found.radius, radius, max_relative = 1e-2);
    assert_relative_eq!(found.duration, model.contact_time(0, &impact).unwrap(), max_relative = 1e-12);
}
