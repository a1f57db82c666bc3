//! The criteria of `[capture]` through `Model::resolve`: melt fraction, kinetic energy, droplets of
//! ash, droplets that bounce.

use crate::common::random::hostile_cases;
use nearwall::{Impact, ImpactRng, Model, Outcome, Regime};

/// A model with particles of `own` on pyrex, and what else the file says.
fn text(capture: &str, own: &str, more: &str) -> String {
    format!(
        "[particle]\nmaterial = \"own\"\n[walls.default]\nmaterial = \"target\"\n\
         [normal]\nmodel = \"thornton-ning\"\nyield_ratio = 2.8\n[tangential]\nmodel = \"constant\"\ne_t = 0.8\n\
         [capture]\n{capture}\n{more}\n\
         [materials.own]\ndensity = 2500\nyoungs_modulus = 5e10\npoisson_ratio = 0.2\nyield_strength = 3e8\n\
         surface_energy = 0.05\n{own}\n\
         [materials.target]\ndensity = 7800\nyoungs_modulus = 2e11\npoisson_ratio = 0.3\nyield_strength = 1e9\n\
         surface_energy = 0.05\n"
    )
}

fn model(capture: &str, own: &str, more: &str) -> Model {
    Model::from_toml("m.toml", &text(capture, own, more)).unwrap()
}

fn error(capture: &str, own: &str, more: &str) -> String {
    Model::from_toml("m.toml", &text(capture, own, more)).unwrap_err().to_string()
}

fn hit(model: &Model, impact: &Impact) -> Outcome {
    model.resolve(0, impact, ImpactRng::new(1, 0)).unwrap()
}

fn at(normal_speed: f64, particle_temperature: f64) -> Impact {
    Impact { normal_speed, diameter: 50e-6, particle_temperature, ..Impact::default() }
}

const SALT: &str = "melt_fraction = { T = [800, 900, 1000], value = [0, 0.5, 1] }\n";

/// 15 % at 830 K, 42.5 % (half sticky) at 885 K, 70 % at 940 K, by hand.
#[test]
fn a_salt_is_sticky_by_its_share_of_liquid() {
    let salt = model("model = \"melt-fraction\"", SALT, "");
    let p = |temperature| hit(&salt, &at(10.0, temperature)).sticking_probability;
    assert_eq!([700.0, 829.0].map(p), [0.0; 2]);
    assert!((p(885.0) - 0.5).abs() < 1e-9 && (p(940.0) - 1.0).abs() < 1e-9);
    assert_eq!(p(2000.0), 1.0);
    // Beyond the table, all solid or all liquid, nothing is extrapolated that could be wrong.
    assert!(!hit(&salt, &at(10.0, 2000.0)).outside_range);
    let step = model("model = \"melt-fraction\"\nflows_from = 0.15", SALT, "");
    assert_eq!(hit(&step, &at(10.0, 831.0)).sticking_probability, 1.0);
    let wrong = error("model = \"melt-fraction\"\nflows_from = 0.1", SALT, "");
    assert!(wrong.contains("capture.flows_from: below `sticky_from`, 0.15"), "{wrong}");
    let none = error("model = \"melt-fraction\"", "", "");
    assert!(none.contains("has a melt_fraction; give one to a material"), "{none}");
}

/// A dry particle on salt that lies on the wall, judged at the wall's temperature.
#[test]
fn a_salt_on_the_wall_holds_by_its_share_of_liquid() {
    let slag = format!(
        "[materials.salt]\ndensity = 2000\nyoungs_modulus = 1e10\npoisson_ratio = 0.2\nyield_strength = 1e8\n\
         surface_energy = 0.1\n{SALT}"
    );
    let text = text("model = \"melt-fraction\"", "", &slag);
    let text =
        text.replace("material = \"target\"\n[normal]", "material = \"target\"\nslag = \"salt\"\n[normal]");
    let model = Model::from_toml("m.toml", &text).unwrap();
    let p =
        |wall_temperature| hit(&model, &Impact { wall_temperature, ..at(10.0, 500.0) }).sticking_probability;
    assert_eq!(p(820.0), 0.0);
    assert!((p(885.0) - 0.5).abs() < 1e-9);
    assert_eq!(p(1000.0), 1.0);
}

/// A glass of CMAS softens; crystals of the same melt at 1500 K do not stick at 1300 K, however slow or fast.
#[test]
fn crystals_do_not_stick_below_their_melting_point() {
    const CMAS: &str = "composition = { CaO = 33, MgO = 9, Al2O3 = 13, SiO2 = 45 }\nmelting_point = 1500";
    let capture =
        "model = \"viscosity\"\nlaw = \"urbain\"\nreference_viscosity = 1e5\nsolidification = \"none\"";
    let [glass, crystals] =
        ["", "\ncrystalline = true"].map(|more| model(capture, &format!("{CMAS}{more}"), ""));
    let p = |model: &Model, speed, t| hit(model, &at(speed, t)).sticking_probability;
    for speed in [1.0, 30.0, 300.0] {
        assert_eq!(p(&crystals, speed, 1300.0), 0.0);
        assert!(p(&glass, speed, 1300.0) > 0.01);
        assert_eq!(p(&crystals, speed, 1501.0), p(&glass, speed, 1501.0));
    }
    let energy = ["", "\ncrystalline = true"].map(|more| model(ENERGY, &format!("{CMAS}{more}"), ""));
    assert!(p(&energy[0], 0.5, 1300.0) > 0.1 && p(&energy[1], 0.5, 1300.0) == 0.0);
    let missing = error(capture, "crystalline = true\ncomposition = { SiO2 = 50, CaO = 50 }", "");
    assert!(missing.contains("materials.own.melting_point: missing; add the temperature [K]"), "{missing}");
}

/// What does not know the speed is marked above 30 m/s where it says that something sticks.
#[test]
fn a_criterion_without_speed_is_marked_at_high_speed() {
    let capture =
        "model = \"viscosity\"\nlaw = \"urbain\"\nreference_viscosity = 1e3\nsolidification = \"none\"";
    let outside = |model: &Model, speed, t| hit(model, &at(speed, t)).outside_range;
    let crystals = format!("{ASH}\nmelting_point = 1650\ncrystalline = true");
    let own = model(capture, &crystals, "");
    assert!(!outside(&own, 3.0, 1700.0) && outside(&own, 300.0, 1700.0));
    // The contact law of a fast impact is tested elsewhere; here nothing sticks at any speed.
    let hard =
        text(capture, &crystals, "").replace("thornton-ning\"\nyield_ratio = 2.8", "constant\"\ne_n = 0.5");
    let hard = Model::from_toml("m.toml", &hard).unwrap();
    assert!(!outside(&hard, 300.0, 1600.0) && outside(&hard, 300.0, 1700.0));
    let energy = text(ENERGY, ASH, "").replace("thornton-ning\"\nyield_ratio = 2.8", "constant\"\ne_n = 0.5");
    assert!(!outside(&Model::from_toml("m.toml", &energy).unwrap(), 300.0, 1700.0));
    let salt = text("model = \"melt-fraction\"", SALT, "")
        .replace("thornton-ning\"\nyield_ratio = 2.8", "constant\"\ne_n = 0.5");
    let salt = Model::from_toml("m.toml", &salt).unwrap();
    assert!(outside(&salt, 300.0, 900.0) && !outside(&salt, 3.0, 900.0) && !outside(&salt, 300.0, 700.0));
}

const ENERGY: &str = "model = \"kinetic-energy\"\nlaw = \"urbain\"";
const ASH: &str = "composition = { SiO2 = 50, Al2O3 = 25, CaO = 15, FeO = 10 }";

/// `A E^-n/mu` from the written formula: 50 µm, 2500 kg/m³ and a viscosity of 1e6 Pa s; 3 m/s
/// 7.363e-10 J, 9.03e4 Pa s: 0.0903.
#[test]
fn fast_and_large_impacts_stick_less() {
    let glass = "viscosity = 1e6";
    let stiff = model(ENERGY, glass, "");
    let p = |impact: Impact| hit(&stiff, &impact).sticking_probability;
    assert!((p(at(3.0, 1200.0)) - 0.0903).abs() < 3e-4, "{}", p(at(3.0, 1200.0)));
    let falls: Vec<f64> = (4..40_u8).map(|half| p(at(0.5 * f64::from(half), 1200.0))).collect();
    assert!(falls.windows(2).all(|pair| pair[1] < pair[0]), "{falls:?}");
    assert!(p(Impact { diameter: 80e-6, ..at(3.0, 1200.0) }) < p(at(3.0, 1200.0)));
    // The density that the solver gives counts.
    let light = p(Impact { particle_density: 250.0, ..at(3.0, 1200.0) });
    assert!((light / 0.0903 - 10_f64.powf(1.78)).abs() < 0.3 || light == 1.0, "{light}");
    let own = model(&format!("{ENERGY}\ncoefficient = 1e-4\nexponent = 1"), glass, "");
    let expected = 1e-4 / 7.363e-10 / 1e6;
    assert!((hit(&own, &at(3.0, 1200.0)).sticking_probability / expected - 1.0).abs() < 1e-3);
    assert!(stiff.describe().iter().any(|line| line.1.contains("kinetic-energy") && line.1.contains("E/J")));
}

/// The wall's slag holds a slow dry particle rather than a fast one.
#[test]
fn slag_on_a_wall_holds_by_the_energy_of_the_particle() {
    let slag = format!(
        "[materials.slag]\ndensity = 2700\nyoungs_modulus = 1e10\npoisson_ratio = 0.2\nyield_strength = 1e8\n\
         surface_energy = 0.4\ncritical_viscosity_temperature = 1400\n{ASH}\n"
    );
    let text = text(ENERGY, "", &slag);
    let text =
        text.replace("material = \"target\"\n[normal]", "material = \"target\"\nslag = \"slag\"\n[normal]");
    let model = Model::from_toml("m.toml", &text).unwrap();
    let p = |normal_speed: f64, wall_temperature: f64| {
        hit(&model, &Impact { wall_temperature, ..at(normal_speed, 500.0) }).sticking_probability
    };
    assert!(p(100.0, 1450.0) < p(50.0, 1450.0) && p(50.0, 1450.0) <= p(20.0, 1450.0));
    // Below the temperature of critical viscosity it holds nothing, however slow.
    assert_eq!(p(1.0, 1399.0), 0.0);
}

/// The built-in fly ash has a composition and no viscosity.
#[test]
fn ash_is_a_droplet_by_its_composition() {
    let text = text("model = \"droplet\"", ASH, "").replace("material = \"own\"", "material = \"fly-ash\"");
    let no_law = Model::from_toml("m.toml", &text).unwrap_err().to_string();
    assert!(no_law.contains("`fly-ash` has a composition but no viscosity; add law = "), "{no_law}");
    let text = text.replace("\"droplet\"", "\"droplet\"\nlaw = \"kalmanovitch-frank\"");
    let model = Model::from_toml("m.toml", &text).unwrap();
    let outcome = hit(&model, &at(5.0, 1750.0));
    assert_eq!((outcome.sticking_probability, outcome.regime), (1.0, Regime::SpNsw));
    assert_eq!(hit(&model, &at(5.0, 1500.0)).regime, Regime::NspNsw);
}

/// As if the surface tension of `nearwall::slag` were written down. 100 µm with 0.4 N/m and 0.1 Pa
/// s by hand: at 10 m/s We 62, Re 25, K = 18, all stays; at 100 m/s We 6200, Re 250, K = 313, three
/// quarters splash.
#[test]
fn the_surface_tension_of_ash_follows_from_its_composition() {
    let given = format!("viscosity = 0.1\nmelting_point = 1500\n{ASH}");
    let splash = |own: &str, speed: f64| {
        let impact = Impact { diameter: 100e-6, ..at(speed, 1700.0) };
        hit(&model("model = \"droplet\"", own, ""), &impact).sticking_probability
    };
    use nearwall::slag::{Composition, surface_tension};
    let oxides = [("SiO2", 50.0), ("Al2O3", 25.0), ("CaO", 15.0), ("FeO", 10.0)];
    let sigma = surface_tension::kucuk(&Composition::new(oxides).unwrap()).unwrap();
    for speed in [10.0, 25.0, 100.0] {
        let same = format!("{given}\nsurface_tension = {sigma:e}");
        assert_eq!(splash(&given, speed), splash(&same, speed));
    }
    assert_eq!((splash(&given, 10.0), splash(&given, 100.0)), (1.0, 0.25));
}

/// Without a melting point a glass counts as a droplet from 1e3 Pa s down. By Urbain's law for this composition, from
/// `nearwall::slag`, which other tests compare with hand values.
#[test]
fn a_glass_is_a_droplet_from_the_working_point_on() {
    use nearwall::slag::{Composition, urbain};
    let composition =
        Composition::new([("SiO2", 50.0), ("Al2O3", 25.0), ("CaO", 15.0), ("FeO", 10.0)]).unwrap();
    let viscosity = |temperature| urbain::URBAIN.at(&composition, temperature);
    let model = model("model = \"droplet\"\nlaw = \"urbain\"", ASH, "");
    for temperature in (1200..1900_u16).step_by(20).map(f64::from) {
        let sticks = hit(&model, &at(5.0, temperature)).sticking_probability;
        assert_eq!(sticks, f64::from(viscosity(temperature) <= 1e3), "{temperature}");
    }
}

const WATER: &str = "viscosity = 1e-3\nsurface_tension = 0.072\nmelting_point = 273.15\n";

fn water(contact_angle: f64, properties: &str) -> Model {
    let capture = format!("model = \"droplet\"\ncontact_angle = {contact_angle}");
    Model::from_toml("m.toml", &text(&capture, properties, "").replace("density = 2500", "density = 1000"))
        .unwrap()
}

/// Water of 0.5 mm at 2 m/s (We 27.8, Re 1000) on 120°: by hand xi = 2.07, E = 0.103, e_n = sqrt(12 E/We) = 0.211.
#[test]
fn a_droplet_bounces_where_it_does_not_wet() {
    let drop = Impact { diameter: 0.5e-3, ..at(2.0, 300.0) };
    let outcome = hit(&water(120.0, WATER), &drop);
    assert_eq!((outcome.sticking_probability, outcome.stuck), (0.0, false));
    assert_eq!(outcome.regime, Regime::NspNsw);
    assert!((outcome.normal_restitution - 0.211).abs() < 0.003, "{outcome:?}");
    for contact_angle in [0.0, 40.0] {
        let outcome = hit(&water(contact_angle, WATER), &drop);
        assert!(outcome.stuck && outcome.normal_restitution == 0.0, "{outcome:?}");
    }
    // What splashes is judged by its splash; what is frozen is no droplet.
    let splashes = hit(&water(120.0, WATER), &Impact { normal_speed: 30.0, ..drop });
    assert!(splashes.sticking_probability >= 0.25);
    assert_eq!(
        hit(&water(120.0, WATER), &Impact { particle_temperature: 270.0, ..drop }).sticking_probability,
        0.0
    );
}

/// MIGRAINE, Fig 7b: molten molybdenum freezes on tungsten below 1000 K before it can recoil. On a
/// wall near the melting point it would bounce, if it did not wet it.
#[test]
fn a_metal_droplet_is_arrested_by_a_cold_wall() {
    let text = text("model = \"droplet\"\ncontact_angle = 150", "", "");
    let text = text.replace("\"own\"", "\"molybdenum\"").replace("\"target\"", "\"tungsten\"");
    let model = Model::from_toml("m.toml", &text).unwrap();
    let p = |wall_temperature| {
        let impact = Impact { diameter: 30e-6, wall_temperature, ..at(10.0, 2900.0) };
        hit(&model, &impact).sticking_probability
    };
    assert_eq!([300.0, 700.0, 1000.0].map(p), [1.0; 3]);
    assert_eq!([2850.0, 2895.0].map(p), [0.0; 2]);
    // Where a thermal property is not known, freezing is not judged.
    let unknown = Model::from_toml("m.toml", &text.replace("\"tungsten\"", "\"teflon\"")).unwrap();
    let impact = Impact { diameter: 30e-6, ..at(10.0, 2900.0) };
    assert_eq!(hit(&unknown, &impact).sticking_probability, 0.0);
}

/// A rise by `conversion-transition` that is complete, then the fall: by hand 1 at the peak 0.9,
/// 0.75 halfway, 0.5 at the end.
#[test]
fn stickiness_falls_again_past_its_peak() {
    let effects = "[[effects]]\nkind = \"conversion-decline\"\npeak = 0.9\nresidual = 0.5\n\
                   [[effects]]\nkind = \"conversion-transition\"\nthreshold = 0.5\nwidth = 0.01\n";
    let char = model("model = \"none\"", "", effects);
    let p = |conversion| hit(&char, &Impact { conversion, ..at(10.0, 300.0) }).sticking_probability;
    assert!(p(0.4) < 1e-3);
    for (conversion, expected) in [(0.9, 1.0), (0.95, 0.75), (1.0, 0.5)] {
        assert!((p(conversion) - expected).abs() < 1e-9, "{conversion}");
    }
    let alone =
        model("model = \"none\"", "", effects.split("[[effects]]\nkind = \"conversion-t").next().unwrap());
    assert_eq!(hit(&alone, &at(10.0, 300.0)).sticking_probability, 0.0);
}

#[test]
fn a_temperature_that_counts_twice_is_noted() {
    let effect = "[[effects]]\nkind = \"melting-transition\"\ntemperature = 900\nwidth = 10\n";
    let noted =
        |model: &Model| model.describe().iter().any(|line| line.0 == "note" && line.1.contains("twice"));
    assert!(noted(&model("model = \"melt-fraction\"", SALT, effect)));
    assert!(!noted(&model("model = \"melt-fraction\"", SALT, "")));
    assert!(!noted(&model("model = \"none\"", SALT, effect)));
}

/// Impacts with numbers that break arithmetic, by every criterion.
#[test]
fn hostile_impacts_have_a_probability() {
    let metal = "viscosity = 1e-3\nsurface_tension = 0.5\nmelting_point = 300\nheat_capacity = 400\n\
                 thermal_conductivity = 80\nheat_of_fusion = 4e5\n";
    let models = [
        model("model = \"melt-fraction\"", SALT, ""),
        model("model = \"melt-fraction\"\nsticky_from = 0\nflows_from = 0", SALT, ""),
        model(ENERGY, ASH, ""),
        model(ENERGY, "viscosity = 1e6", ""),
        model("model = \"droplet\"\nlaw = \"urbain\"\ncontact_angle = 180", ASH, ""),
        model("model = \"droplet\"\ncontact_angle = 0", metal, ""),
        model("model = \"droplet\"\ncontact_angle = 150", metal, ""),
    ];
    let cases: Vec<_> = hostile_cases().into_iter().filter(|case| case.1.check().is_ok()).collect();
    assert!(cases.len() > 1000);
    for (number, model) in models.iter().enumerate() {
        for (_, impact, draw) in &cases {
            let outcome = model.resolve(0, impact, *draw).unwrap();
            let Outcome { normal_restitution: e_n, sticking_probability: p, .. } = outcome;
            assert!(
                e_n.is_finite() && e_n >= 0.0 && (0.0..=1.0).contains(&p),
                "{number} {outcome:?} {impact:?}"
            );
        }
    }
}
