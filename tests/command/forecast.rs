//! Forecasts with their uncertainty, and which numbers matter: against answers that are known without the code.

use std::collections::BTreeMap;
use std::path::Path;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution as _, StandardUniform};
use rayon::prelude::*;
use serde_json::Value;

use crate::runner::{done, folder, refused};

const CONSTANT: &str = r#"
[particle]
material = "montan-wax"
[walls.default]
material = "pyrex"
[normal]
model = "constant"
e_n = 0.5
[tangential]
model = "constant"
e_t = 0.8
"#;

/// Stickiness of the planted transition at a temperature [K].
fn sticking(temperature: f64, [middle, width]: [f64; 2]) -> f64 {
    1.0 / (1.0 + ((middle - temperature) / width).exp())
}

/// A sequence without a pattern that matters here, in 0 to 1 (the golden ratio's multiples, and
/// those of another irrational).
fn spread(number: u32, irrational: f64) -> f64 {
    (f64::from(number) * irrational).fract()
}

fn rows(text: &str) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    reader.deserialize().map(Result::unwrap).collect()
}

fn value(row: &BTreeMap<String, String>, key: &str) -> f64 {
    row[key].parse().unwrap()
}

/// 160 impacts with a planted melting transition: outcomes only.
fn planted(parameters: [f64; 2]) -> String {
    let mut text = "v_n,v_t,d,T_p,T_w,e_n,outcome\n".to_owned();
    for number in 1..=160 {
        let temperature = 320.0 + 70.0 * spread(number, 0.618_033_988_749);
        let stickiness = sticking(temperature, parameters);
        let chance = spread(number, 0.754_877_666_246);
        let noise = 0.1 * (spread(number, 0.569_840_290_998) - 0.5);
        text += &if chance < stickiness {
            format!("2,0.1,8e-5,{temperature},300,,stick\n")
        } else {
            format!(
                "2,0.1,8e-5,{temperature},300,{},rebound\n",
                (0.5 * (1.0 - stickiness) + noise).max(0.001)
            )
        };
    }
    text
}

#[test]
fn bands_of_drawn_models_hold_the_planted_law() {
    let truth = [355.0, 6.0];
    let files = folder(&[("base.toml", CONSTANT), ("data.csv", &planted(truth))]);
    let path = files.path();
    done(path, &["diagnose", "data.csv", "--model", "base.toml", "--draws", "39", "--out", "out"]);
    assert_eq!(std::fs::read_dir(path.join("out/draws")).unwrap().count(), 39);
    for name in ["01", "39"] {
        done(path, &["check", &format!("out/draws/{name}.toml")]);
    }
    let impacts: Vec<String> = (0..13).map(|step| format!("2,0.1,8e-5,{},300", 330 + 4 * step)).collect();
    std::fs::write(path.join("fresh.csv"), format!("v_n,v_t,d,T_p,T_w\n{}\n", impacts.join("\n"))).unwrap();
    let with = ["predict", "--model", "out/extended.toml", "--draws", "out/draws", "fresh.csv"];
    let printed = done(path, &with);
    let mut inside = 0;
    for row in rows(&printed) {
        for name in ["e_n", "e_t", "p_stick"] {
            let [low, high] = ["low", "high"].map(|end| value(&row, &format!("{name}_{end}")));
            assert!(low <= high && high - low < 0.6, "{name} {low} {high}");
        }
        let expected = sticking(value(&row, "T_p"), truth);
        let [low, high] = ["p_stick_low", "p_stick_high"].map(|end| value(&row, end));
        inside += u32::from((low - 1e-6..=high + 1e-6).contains(&expected));
    }
    // A band that is right 95 % of the time, for impacts that share two parameters.
    assert!(inside >= 10, "{inside} of 13\n{printed}");
    // The same seed gives the same draws, and the band does not change what the model predicts.
    done(path, &["diagnose", "data.csv", "--model", "base.toml", "--draws", "2", "--out", "again"]);
    let text = |name: &str| std::fs::read_to_string(path.join(name)).unwrap();
    assert_eq!(text("out/draws/02.toml"), text("again/draws/02.toml"));
    let plain = done(path, &["predict", "--model", "out/extended.toml", "fresh.csv"]);
    // The bands stand after the regime, before the ranges that are left.
    let before =
        |line: &str| line.find("SP-").map_or(line.replace(",beyond", ""), |at| line[..at].to_owned());
    for (plain, with) in plain.lines().zip(printed.lines()) {
        assert!(with.starts_with(&before(plain)), "{plain}\n{with}");
    }
    refused(path, &["predict", "--model", "out/extended.toml", "--draws", "none", "fresh.csv"], &["none: "]);
}

/// Planted sets with this number of impacts and softening: the shares of fresh impacts whose true
/// `p_stick` and `e_n` lie within the band, over the sets that were diagnosed rightly.
fn coverage(sets: u64, impacts: usize, softening: f64) -> [f64; 2] {
    let one = |seed: u64| {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut uniform = |low: f64, high: f64| {
            let share: f64 = StandardUniform.sample(&mut random);
            low + (high - low) * share
        };
        let truth = [uniform(345.0, 365.0), uniform(4.0, 9.0)];
        let mut data = "v_n,v_t,d,T_p,T_w,e_n,outcome\n".to_owned();
        for _ in 0..impacts {
            let (speed, temperature) = (uniform(1.0, 3.0), uniform(310.0, 395.0));
            let stickiness = sticking(temperature, truth);
            // Twelve uniform numbers make a nearly normal one.
            let noise = 0.05 * ((0..12).map(|_| uniform(0.0, 1.0)).sum::<f64>() - 6.0);
            data += &if uniform(0.0, 1.0) < stickiness {
                format!("{speed},0.1,8e-5,{temperature},300,,stick\n")
            } else {
                let e_n = (0.5 * (1.0 - softening * stickiness) + noise).max(0.001);
                format!("{speed},0.1,8e-5,{temperature},300,{e_n},rebound\n")
            };
        }
        let mut fresh = "v_n,v_t,d,T_p,T_w\n".to_owned();
        (0..40).for_each(|_| {
            fresh += &format!("{},0.1,8e-5,{},300\n", uniform(1.0, 3.0), uniform(325.0, 385.0))
        });
        let files = folder(&[("base.toml", CONSTANT), ("data.csv", &data), ("fresh.csv", &fresh)]);
        let path = files.path();
        done(path, &["diagnose", "data.csv", "--model", "base.toml", "--draws", "39", "--out", "out"]);
        let findings = json(&path.join("out/diagnosis.json"))["findings"].clone();
        if findings.as_array().unwrap().len() != 1 || findings[0]["cause"] != "melting-transition" {
            println!("{impacts} impacts, set {seed}: {findings}");
            return None;
        }
        let with = ["predict", "--model", "out/extended.toml", "--draws", "out/draws", "fresh.csv"];
        let predicted = rows(&done(path, &with));
        let inside = |name: &str, truth: &dyn Fn(f64) -> f64| {
            let holds = |row: &&BTreeMap<String, String>| {
                let [low, high] = ["low", "high"].map(|end| value(row, &format!("{name}_{end}")));
                (low - 1e-9..=high + 1e-9).contains(&truth(value(row, "T_p")))
            };
            predicted.iter().filter(holds).count() as f64 / predicted.len() as f64
        };
        let stickiness = |temperature: f64| sticking(temperature, truth);
        Some([
            inside("p_stick", &stickiness),
            inside("e_n", &|temperature| 0.5 * (1.0 - softening * stickiness(temperature))),
        ])
    };
    let found: Vec<[f64; 2]> = (0..sets).into_par_iter().filter_map(one).collect();
    assert!(found.len() as u64 * 4 >= sets * 3, "{} of {sets} sets were diagnosed rightly", found.len());
    [0, 1].map(|which| found.iter().map(|one| one[which]).sum::<f64>() / found.len() as f64)
}

/// `NEARWALL_FORECAST_SETS=30 cargo test --test command coverage -- --nocapture` makes the table of
/// `docs/how-to/forecast.md`.
#[test]
fn coverage_of_the_bands_is_near_what_they_say() {
    let sets = std::env::var("NEARWALL_FORECAST_SETS").map_or(8, |sets| sets.parse().unwrap());
    for (impacts, softening) in [(60, 1.0), (150, 1.0), (400, 0.7)] {
        let [stick, e_n] = coverage(sets, impacts, softening);
        println!("{sets} sets of {impacts} impacts, softening {softening}: p_stick {stick:.3}, e_n {e_n:.3}");
        // Few sets scatter: a set's impacts share the fitted parameters.
        assert!(stick > 0.8 && e_n > 0.8, "{impacts}: {stick} {e_n}");
    }
}

/// Particles fly through a vacuum onto a plate, 1 m/s head-on; those that rebound leave through the ceiling.
fn plate(model: &str, particles: &str, more: &str) -> String {
    format!(
        r#"{model}
[run]
time_limit = 100
gravity = [0, 0, 0]
[gas]
field = "uniform"
velocity = [0, 0, 0]
temperature = 300
density = 1e-9
viscosity = 1e-15
conductivity = 1e-9
heat_capacity = 1000
[particles]
count = 50
position = {{ shape = "point", at = [0, 0, 0.01] }}
direction = [0, 0, -1]
diameter = 5e-5
temperature = 300
{particles}
[[walls]]
name = "plate"
wall = "default"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
temperature = 300
[[exits]]
name = "ceiling"
shape = "plane"
point = [0, 0, 0.1]
normal = [0, 0, -1]
{more}"#
    )
}

fn nested(model: &str) -> String {
    model.replace("\n[", "\n[model.").replace("\n[model.[", "\n[[model.")
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn simulated_bands_are_the_range_over_the_draws() {
    // The probability of capture at the particles' 300 K is known; each particle hits once.
    let melting = |temperature: f64| {
        format!(
            "{CONSTANT}[[effects]]\nkind = \"melting-transition\"\ntemperature = {temperature}\nwidth = 10\n"
        )
    };
    let model = melting(300.0);
    let case = plate(&nested(&model), "speed = 1\ndensity = 1000", "");
    let sweep = "[sweep]\nkey = \"speed\"\nvalues = [1, 2]\n";
    let files = folder(&[
        ("case.toml", &case),
        ("sweep.toml", &plate(&nested(&model), "speed = 1\ndensity = 1000", sweep)),
    ]);
    let path = files.path();
    std::fs::create_dir(path.join("draws")).unwrap();
    for (number, temperature) in [310.0, 300.0, 295.0, 290.0].into_iter().enumerate() {
        std::fs::write(path.join(format!("draws/{number}.toml")), melting(temperature)).unwrap();
    }
    let printed = done(path, &["simulate", "case.toml", "--draws", "draws", "-o", "out"]);
    let band = &json(&path.join("out/summary.json"))["runs"][0]["band"][0];
    let share = |end: &str| band["mass_share"][end].as_f64().unwrap();
    let first = json(&path.join("out/summary.json"));
    assert_eq!(band["wall"], "plate");
    assert_eq!(band["draws"], 4);
    let expected = |middle: f64| sticking(300.0, [middle, 10.0]);
    assert!((share("low") - expected(310.0)).abs() < 1e-9, "{band}");
    assert!((share("high") - expected(290.0)).abs() < 1e-9, "{band}");
    assert!((share("median") - 0.5 * (expected(300.0) + expected(295.0))).abs() < 1e-9, "{band}");
    assert!(printed.contains("plate: captured"), "{printed}");
    let mass = band["captured_mass"]["high"].as_f64().unwrap();
    let injected = first["runs"][0]["injected"]["mass"].as_f64().unwrap();
    assert!((mass / injected - share("high")).abs() < 1e-12);
    done(path, &["simulate", "sweep.toml", "--draws", "draws", "-o", "swept"]);
    assert_eq!(json(&path.join("swept/summary.json"))["runs"][1]["band"][0]["draws"], 4);
    assert!(
        std::fs::read_to_string(path.join("swept/report.html"))
            .unwrap()
            .contains("Captures over the drawn models")
    );
    std::fs::write(path.join("draws/0.toml"), CONSTANT.replace("walls.default", "walls.other")).unwrap();
    refused(path, &["simulate", "case.toml", "--draws", "draws"], &["0.toml", "other walls"]);
}

/// All temperatures of a sheet move together by its uncertainty: half way between 1300 and 1500 K, 40 K
/// warmer and colder ash is sticky with 0.3 and 0.7.
#[test]
fn an_ash_sheet_is_moved_as_a_whole() {
    let model = r#"
[particle]
material = "ash"
[walls.default]
material = "ash"
[normal]
model = "constant"
e_n = 0.5
[tangential]
model = "constant"
e_t = 0.8
[capture]
model = "fusion"
[materials.ash]
density = 2500
youngs_modulus = 7e10
poisson_ratio = 0.2
yield_strength = 1e10
surface_energy = 0.5
fusion_temperatures = { deformation = 1300, softening = 1366.6667, flow = 1500 }
"#;
    let case = plate(&nested(model), "speed = 1", "")
        .replace("temperature = 300\nspeed", "temperature = 1400\nspeed");
    let sweep = "[sweep]\nkey = \"gas_temperature\"\nvalues = [300, 310]\n";
    let case = case.replace("count = 50", "count = 2000") + sweep;
    let files = folder(&[("case.toml", &case)]);
    let path = files.path();
    let command = "sensitivity case.toml -o out --clean-walls --set model.tangential.e_t=0.7";
    done(path, &command.split(' ').collect::<Vec<_>>());
    let found = json(&path.join("out/sensitivity.json"));
    // What makes the base another one than that of `simulate`.
    let page = std::fs::read_to_string(path.join("out/report.html")).unwrap();
    for said in [
        "changed by --set: model.tangential.e_t=0.7",
        "the [sweep] is left out",
        "1000 of the case&#39;s 2000 particles are followed",
        "Share of the injected mass, of 1000 particles",
    ] {
        assert!(page.contains(said), "{said}");
    }
    let numbers = found["numbers"].as_array().unwrap();
    let key = "model.materials.ash.fusion_temperatures";
    let sheet = numbers.iter().find(|number| number["key"] == key).unwrap();
    assert_eq!((&sheet["low"], &sheet["high"]), (&(-40.0).into(), &40.0.into()));
    let wall = &sheet["walls"][0];
    for (end, share) in [("captured_low", 0.7), ("captured", 0.5), ("captured_high", 0.3)] {
        let captured = wall[end].as_f64().unwrap();
        assert!((captured - share).abs() < 0.05, "{end} {captured}");
    }
}

/// Thornton and Ning in a vacuum: below the sticking velocity all stick. That depends on the
/// materials, but not on a thermal property of the gas, and not on the particle's yield strength if
/// the wall is far softer.
#[test]
fn a_number_that_cannot_matter_has_exactly_no_effect() {
    let model = r#"
[particle]
material = "hard"
[walls.default]
material = "soft"
[normal]
model = "thornton-ning"
yield_ratio = 1.6
[tangential]
model = "constant"
e_t = 0.8
[materials.hard]
density = { value = 2500, uncertainty = 100, source = "a scale" }
youngs_modulus = { value = 7e10, source = "a table" }
poisson_ratio = { value = 0.2, source = "a table" }
yield_strength = { value = 1e10, source = "assumed: hard" }
surface_energy = { value = 0.5, source = "assumed" }
[materials.base]
density = { value = 2000, source = "a table" }
youngs_modulus = { T = [290, 400], value = [1e9, 1e9], source = "a table" }
poisson_ratio = { value = 0.3, source = "a table" }
yield_strength = { value = 1e6, source = "assumed: uncertain by a factor 10" }
surface_energy = { value = 0.2, source = "a table" }
[materials.soft]
like = "base"
surface_energy = { value = 0.1, source = "a table" }
"#;
    let speeds = "speed = { distribution = \"uniform\", min = 0.02, max = 1.5 }";
    let files = folder(&[("case.toml", &plate(&nested(model), speeds, ""))]);
    let path = files.path();
    let printed = done(path, &["sensitivity", "case.toml", "-o", "out"]);
    let found = json(&path.join("out/sensitivity.json"));
    let numbers = found["numbers"].as_array().unwrap();
    let number = |key: &str| {
        let found = numbers.iter().find(|number| number["key"] == key);
        found.unwrap_or_else(|| panic!("{key} is not in {printed}"))
    };
    let largest = |key: &str| number(key)["largest"].as_f64().unwrap();
    assert_eq!(numbers[0]["key"], "model.materials.soft.yield_strength", "{printed}");
    assert!(largest("model.materials.soft.yield_strength") > 0.2, "{printed}");
    for key in [
        "model.materials.hard.yield_strength",
        "model.materials.soft.density",
        "model.tangential.e_t",
        "gas.heat_capacity",
        "gas.conductivity",
        "gas.temperature",
        "walls.plate.temperature",
    ] {
        assert_eq!(largest(key), 0.0, "{key}\n{printed}");
    }
    // The stated ranges.
    let soft = number("model.materials.soft.yield_strength");
    assert!(
        (soft["low"].as_f64().unwrap() - 1e5).abs() < 1.0
            && (soft["high"].as_f64().unwrap() - 1e7).abs() < 1.0
    );
    assert_eq!(soft["quality"], "stated");
    assert_eq!([&soft["name"], &soft["unit"], &soft["scale"]], ["yield strength of soft", "Pa", "value"]);
    assert_eq!(number("model.materials.hard.density")["high"], 2600.0);
    assert_eq!(number("model.materials.hard.surface_energy")["quality"], "assumed");
    assert_eq!(number("model.materials.hard.surface_energy")["high"], 1.0);
    // The wall is known from 290 K: of 300 K less 50, 25, 12.5 and 6.25 K only the last can be decided.
    assert_eq!(number("walls.plate.temperature")["low"], 293.75);
    // A softer wall holds more.
    let wall = &soft["walls"][0];
    assert!(wall["captured_low"].as_f64() > wall["captured_high"].as_f64(), "{wall}");
    let table = std::fs::read_to_string(path.join("out/sensitivity.csv")).unwrap();
    assert_eq!(rows(&table).len(), numbers.len());
    // The tornado names each number with its range, the largest change first.
    let page = std::fs::read_to_string(path.join("out/report.html")).unwrap();
    let texts = page.split("<text ").skip(1).filter_map(|text| text.split("</text>").next());
    let names: Vec<&str> = texts.filter(|text| text.contains(" to ")).collect();
    assert!(names[0].ends_with(">yield strength of soft: 100000 to 1e7 Pa"), "{names:?}");
    assert!(!names.iter().any(|name| name.contains("yield strength of hard")), "{names:?}");
    refused(path, &["sensitivity", "case.toml", "--set", "gas.none.x=3"], &["gas.none.x"]);
}
