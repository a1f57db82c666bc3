//! A rig of whose case one number is wrong, the tutorial, and one whose case leaves a force out.

use std::f64::consts::PI;
use std::path::Path;

use nearwall_lab::simulate::Case;
use serde_json::Value;

use crate::runner::{done, folder};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../tutorials/wrongGasSpeed");

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap()
}

/// The readings were made with a gas 1.4 times as fast as the case says, and the right wall law.
#[test]
fn a_wrong_gas_speed_is_found_and_the_wall_law_is_not_blamed() {
    let given = |name: &str| text(&Path::new(FOLDER).join(name));
    let [case, base, data] = ["case.toml", "base.toml", "measured.csv"].map(given);
    let folder = folder(&[("case.toml", &case), ("base.toml", &base), ("measured.csv", &data)]);
    let said = done(folder.path(), &["diagnose", "measured.csv", "--case", "case.toml", "--out", "out"]);
    let found: Value = serde_json::from_str(&text(&folder.path().join("out/diagnosis.json"))).unwrap();
    let findings = found["findings"].as_array().unwrap();
    assert_eq!(findings.len(), 1, "{said}");
    assert_eq!(findings[0]["cause"], "case:gas.speed");
    let number = &findings[0]["parameters"]["value"];
    let [low, high] = ["low", "high"].map(|end| number[end].as_f64().unwrap());
    assert!(low < 1.4 * 4.0 && 1.4 * 4.0 < high && high - low < 0.8, "{number}");
    // The verdict has the probability of the party.
    let case = found["parties"]["case"].as_f64().unwrap();
    assert!(case > 0.8, "{}", found["parties"]);
    let verdict = format!("The case is at fault, not the wall (probability {case:.2}): gas.speed (");
    assert!(said.contains(&verdict), "{said}");
    assert_eq!(found["blame"][0]["party"], "case:gas.speed");
    assert!(found["blame"][0]["share"].as_f64().unwrap() > 0.9);
    assert_eq!(text(&folder.path().join("out/extended.toml")), base);
    let extended = Case::from_file(&folder.path().join("out/extended_case.toml"));
    assert!(extended.is_ok(), "{extended:?}");
}

/// A stated error is no part of a simulation, and a mistake beside it is found where it stands.
#[test]
fn stated_errors_change_no_simulation() {
    let case = text(&Path::new(FOLDER).join("case.toml"));
    let wrong =
        case.replace("angle_deg = { value = 80, error = 1 }", "angel_deg = { value = 80, error = 1 }");
    let read = Case::from_toml("case.toml", &wrong, Path::new(FOLDER));
    let place = wrong.lines().position(|line| line.starts_with("angel_deg")).unwrap() + 1;
    let message = read.unwrap_err().to_string();
    assert!(message.contains(&format!("case.toml:{place}:1")) && message.contains("angle_deg"), "{message}");
}

/// Gradient of the temperature of a gas over a plate of 300 K [K/m], its kinematic viscosity [m²/s], and the radius of
/// the disc of injection and of the plate [m].
const GRADIENT: f64 = 5e4;
const VISCOSITY: f64 = 1.5e-5;
const DISC: f64 = 5e-4;
const PLATE: f64 = 0.05;
const DIAMETER: f64 = 1e-6;

/// Fine particles pass over a cold plate; nothing but thermophoresis brings them there.
fn over_a_plate(more: &str) -> String {
    format!(
        "model = \"base.toml\"\n[run]\ntime_limit = 2\ngravity = [0, 0, -9.81]\n[gas]\nfield = \"uniform\"\n\
         velocity = [0.2, 0, 0]\ntemperature = {{ axis = \"z\", at = [0, 0.002], value = [300, 400] }}\n\
         density = 1.2\nviscosity = 1.8e-5\nconductivity = 0.026\nheat_capacity = 1005\npressure = 101325\n{more}\n\
         [particles]\ncount = 500\nposition = {{ shape = \"disc\", center = [{}, 0, {}], normal = [1, 0, 0], \
         radius = {DISC} }}\ndirection = [1, 0, 0]\nspeed = 0\nrelative_to_gas = true\ndiameter = {DIAMETER}\n\
         temperature = 325\ndensity = 100\nconductivity = 0.5\n\
         [[walls]]\nname = \"plate\"\nwall = \"default\"\nshape = \"plane\"\npoint = [0, 0, 0]\n\
         normal = [0, 0, 1]\nradius = {PLATE}\ntemperature = 300\n",
        -PLATE,
        DISC + DIAMETER
    )
}

/// The share that reaches the plate: what drifts to it with `-C' nu grad(T)/T` while it passes. `C'` by Talbot's
/// formula and Cunningham's slip, by hand; the weight of these light particles is 0.4 % of that.
fn arriving(speed: f64) -> f64 {
    let knudsen = 2.0 * 1.8e-5 * (PI / (2.0 * 1.2 * 101_325.0)).sqrt() / DIAMETER;
    let ratio = 0.026 / 0.5;
    let jump = 2.18 * knudsen;
    let coefficient =
        6.0 * PI * 1.17 * (ratio + jump) / ((1.0 + 3.0 * 1.14 * knudsen) * (1.0 + 2.0 * ratio + 2.0 * jump));
    let slip = 1.0 + knudsen * (1.257 + 0.4 * (-1.1_f64 / knudsen).exp());
    let drift = coefficient * slip / (3.0 * PI);
    let touched = 300.0 + GRADIENT * 0.5 * DIAMETER;
    let time = 2.0 * PLATE / speed;
    let hottest = (touched * touched + 2.0 * drift * VISCOSITY * GRADIENT * GRADIENT * time).sqrt();
    // The segment of the disc below that height.
    let above = ((hottest - 300.0) / GRADIENT - DISC - DIAMETER) / DISC;
    let above = above.clamp(-1.0, 1.0);
    ((-above).acos() + above * (1.0 - above * above).sqrt()) / PI
}

/// A case without thermophoresis is told that it leaves it out, and one with it agrees.
#[test]
fn a_force_that_the_case_leaves_out_is_named() {
    let base = "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n[normal]\n\
                model = \"thornton-ning\"\nyield_ratio = 0.7\n[tangential]\nmodel = \"constant\"\ne_t = 0.8\n";
    let mut data = "experiment,gas.velocity,captured@plate,captured@plate_n\n".to_owned();
    for (number, speed) in [0.12, 0.15, 0.2, 0.25, 0.3, 0.4, 0.6, 0.8].into_iter().enumerate() {
        let caught = (300.0 * arriving(speed)).round() / 300.0;
        data += &format!("run {number},\"[{speed}, 0, 0]\",{caught},300\n");
    }
    let diagnosed = |more: &str| {
        let case = over_a_plate(more);
        let folder = folder(&[("case.toml", &case), ("base.toml", base), ("measured.csv", &data)]);
        let said = done(folder.path(), &["diagnose", "measured.csv", "--case", "case.toml", "--out", "out"]);
        let found: Value = serde_json::from_str(&text(&folder.path().join("out/diagnosis.json"))).unwrap();
        (said, found, folder)
    };
    let (said, found, folder) = diagnosed("");
    assert_eq!(found["findings"][0]["cause"], "case:without-thermophoresis", "{said}\n{found:#}");
    assert_eq!(found["findings"].as_array().unwrap().len(), 1, "{said}");
    assert_eq!(found["blame"][0]["party"], "case:without-thermophoresis", "{}", found["blame"]);
    assert!(said.contains("The case is at fault, not the wall"), "{said}");
    let extended = text(&folder.path().join("out/extended_case.toml"));
    assert!(extended.contains("thermophoresis = true"), "{extended}");
    assert!(Case::from_file(&folder.path().join("out/extended_case.toml")).is_ok());
    let (said, found, _folder) = diagnosed("thermophoresis = true");
    assert_eq!(found["findings"].as_array().unwrap().len(), 0, "{said}");
}
