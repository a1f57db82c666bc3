//! A rig whose particles melt: shares caught and mean restitution over temperature.

use serde_json::Value;

use crate::runner::{done, folder};

/// Temperature at half of the captures [K], width [K], and share of `e_n` that molten particles lose [1].
const PLANTED: [f64; 3] = [355.0, 5.0, 0.4];
/// Restitution of the base [1].
const RESTITUTION: f64 = 0.5;

const BASE: &str = "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n[normal]\n\
                    model = \"constant\"\ne_n = 0.5\n[tangential]\nmodel = \"constant\"\ne_t = 0.8\n";
const CASE: &str = "model = \"base.toml\"\n[run]\ntime_limit = 10\ngravity = [0, 0, 0]\nhit_limit = 1\n[gas]\n\
                    field = \"uniform\"\nvelocity = [0, 0, 0]\ntemperature = 300\ndensity = 1e-9\nviscosity = 1e-15\n\
                    conductivity = 1e-9\nheat_capacity = 1000\n[particles]\ncount = 100\n\
                    position = { shape = \"point\", at = [0, 0, 0.01] }\ndirection = [0, 0, -1]\ndiameter = 80e-6\n\
                    speed = 2\ntemperature = 300\n[[walls]]\nname = \"target\"\nshape = \"plane\"\npoint = [0, 0, 0]\n\
                    normal = [0, 0, 1]\ntemperature = 295\n";

/// The readings where so much of what is molten sticks.
fn measured(temperatures: &[f64], ceiling: f64) -> String {
    let [middle, width, softening] = PLANTED;
    let mut data = String::from("particles.temperature,captured@target,captured@target_n,mean_e_n@target");
    data += ",mean_e_n@target_err\n";
    for temperature in temperatures {
        let molten = 1.0 / (1.0 + f64::exp((middle - temperature) / width));
        let caught = (400.0 * ceiling * molten).round() / 400.0;
        let restitution = RESTITUTION * (1.0 - softening * molten);
        // Where all are caught none rebounds.
        let mean = if caught < 0.97 { format!("{restitution:.4},0.004") } else { ",".to_owned() };
        data += &format!("{temperature},{caught},400,{mean}\n");
    }
    data
}

/// What is found: name and parameters of each cause, sorted, and the verdict.
fn found(data: &str) -> (Vec<(String, Value)>, String) {
    let folder = folder(&[("case.toml", CASE), ("base.toml", BASE), ("measured.csv", data)]);
    let said = done(folder.path(), &["diagnose", "measured.csv", "--case", "case.toml", "--out", "out"]);
    let text = std::fs::read_to_string(folder.path().join("out/diagnosis.json")).unwrap();
    let found: Value = serde_json::from_str(&text).unwrap();
    let cause = |one: &Value| (one["cause"].as_str().unwrap().to_owned(), one["parameters"].clone());
    let mut causes: Vec<_> = found["findings"].as_array().unwrap().iter().map(cause).collect();
    causes.sort_by(|a, b| a.0.cmp(&b.0));
    (causes, said)
}

/// Whether an interval holds the planted value, and is no wider than half of it.
fn holds(stated: &Value, planted: f64) -> bool {
    let [low, high] = ["low", "high"].map(|end| stated[end].as_f64().unwrap_or(f64::NAN));
    low < planted && planted < high && high - low < 0.5 * planted
}

/// The share of `e_n` that melting takes is a number with a default, which the readings contradict, and one experiment
/// far above the others leaves the width narrow beside their range.
#[test]
fn softening_is_fitted_with_the_place_and_the_width_of_melting() {
    let temperatures = [310.0, 330.0, 342.0, 348.0, 352.0, 356.0, 360.0, 366.0, 372.0, 500.0];
    let (causes, said) = found(&measured(&temperatures, 1.0));
    assert!(causes.len() == 1 && causes[0].0 == "melting-transition", "{said}");
    for (name, planted) in ["temperature", "width", "softening"].into_iter().zip(PLANTED) {
        assert!(holds(&causes[0].1[name], planted), "{name}: {said}");
    }
}

/// Three of ten molten particles bounce.
#[test]
fn a_ceiling_of_captures_is_found_beside_melting() {
    let temperatures = [310.0, 325.0, 340.0, 346.0, 351.0, 355.0, 359.0, 364.0, 372.0, 380.0, 390.0, 400.0];
    let (causes, said) = found(&measured(&temperatures, 0.7));
    assert_eq!(causes.len(), 2, "{said}");
    assert!(causes[0].0 == "capture-ceiling" && holds(&causes[0].1["share"], 0.7), "{said}");
    assert_eq!(causes[1].0, "melting-transition", "{said}");
    for (name, planted) in ["temperature", "width", "softening"].into_iter().zip(PLANTED) {
        assert!(holds(&causes[1].1[name], planted), "{name}: {said}");
    }
}

/// Two digits are wrong: 0.19 for 0.50, the restitution of the coldest, which no law explains. Without the chance of gross
/// errors a further cause is claimed, the softening is anything from 0.14 to 0.67, and a misfit is left.
#[test]
fn a_mistyped_reading_hides_no_law_and_is_said() {
    let temperatures = [310.0, 330.0, 342.0, 348.0, 352.0, 356.0, 360.0, 366.0, 372.0];
    let data = measured(&temperatures, 1.0);
    let mistyped = data.replacen(",0.5000,", ",0.1900,", 1);
    assert_ne!(data, mistyped);
    let (causes, said) = found(&mistyped);
    assert!(causes.len() == 1 && causes[0].0 == "melting-transition", "{said}");
    for (name, planted) in ["temperature", "width", "softening"].into_iter().zip(PLANTED) {
        assert!(holds(&causes[0].1[name], planted), "{name}: {said}");
    }
    assert!(
        said.contains("Line 2 counts as a gross error (probability 1.00): mean_e_n is 0.19 where"),
        "{said}"
    );
    assert!(!said.contains("A misfit is left") && !said.contains("further cause"), "{said}");
}
