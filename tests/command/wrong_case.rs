//! A rig of whose case one number is wrong: the tutorial.

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
