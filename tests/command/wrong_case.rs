//! A rig of whose case one number is wrong: the tutorial.

use std::f64::consts::PI;
use std::path::Path;

use nearwall::transport::thermophoresis;
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

/// Readings that lie above what the case predicts by one standard error each: with the errors of the case they agree
/// with it, and nobody has a share of a misfit.
#[test]
fn nobody_is_blamed_where_the_readings_agree() {
    let given = |name: &str| text(&Path::new(FOLDER).join(name));
    let [case, base, data] = ["case.toml", "base.toml", "measured.csv"].map(given);
    let folder = folder(&[("case.toml", &case), ("base.toml", &base), ("measured.csv", &data)]);
    let diagnosed = || -> Value {
        done(folder.path(), &["diagnose", "measured.csv", "--case", "case.toml", "--out", "out"]);
        serde_json::from_str(&text(&folder.path().join("out/diagnosis.json"))).unwrap()
    };
    let mut lines = data.lines();
    let mut near = lines.next().unwrap().to_owned() + "\n";
    for (line, reading) in lines.zip(diagnosed()["readings"].as_array().unwrap()) {
        let cells: Vec<&str> = line.split(',').collect();
        let (settings, error) = (cells[..4].join(","), cells[5]);
        let value = reading["base"].as_f64().unwrap() + error.parse::<f64>().unwrap();
        near += &format!("{settings},{value:.5},{error}\n");
    }
    std::fs::write(folder.path().join("measured.csv"), near).unwrap();
    let found = diagnosed();
    assert!(found["blame"].as_array().unwrap().is_empty(), "{}", found["blame"]);
    assert!(!found["verdict"].as_str().unwrap().contains("Shares of the misfit"), "{}", found["verdict"]);
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

/// Soot of a micrometre between a cold and a hot plate, whose case knows no thermophoresis. Of particles that begin on a
/// disc those below a height are caught: from `z` the way takes `(T(z)² - T(0)²)/(2 C' nu grad(T)²)`.
#[test]
fn thermophoresis_that_a_case_leaves_out_is_found() {
    let [diameter, height, radius, time, total]: [f64; 5] = [1e-6, 2e-3, 0.9e-3, 1.0, 2000.0];
    let knudsen = 2.0 * thermophoresis::mean_free_path(1.8e-5, 1.2, 101_325.0) / diameter;
    let slip = 1.0 + knudsen * (1.257 + 0.4 * (-1.1_f64 / knudsen).exp());
    let drift = thermophoresis::coefficient(knudsen, 0.026 / 0.5) * slip / (3.0 * PI) * 1.5e-5;
    let captured = |difference: f64| {
        let gradient = difference / height;
        let reached = (300.0_f64.powi(2) + 2.0 * drift * time * gradient * gradient).sqrt();
        // The part of the disc below that height, which is so many radii above its centre.
        let above = (((reached - 300.0) / gradient - 0.5 * height) / radius).clamp(-1.0, 1.0);
        ((-above).acos() + above * (1.0 - above * above).sqrt()) / PI
    };
    let mut data = String::from("experiment,gas.temperature.value,captured@cold,captured@cold_n\n");
    for (run, difference) in [40.0, 60.0, 80.0, 100.0, 120.0, 140.0, 160.0].into_iter().enumerate() {
        let share = (captured(difference) * total).round() / total;
        data += &format!("run {run},\"[300, {}]\",{share},{total}\n", 300.0 + difference);
    }
    let plate = |name: &str, z: f64, up: f64, temperature: f64| {
        format!(
            "[[walls]]\nname = \"{name}\"\nshape = \"plane\"\npoint = [0, 0, {z}]\nnormal = [0, 0, {up}]\n\
             temperature = {temperature}\n"
        )
    };
    let case = format!(
        "model = \"base.toml\"\n[run]\ntime_limit = {time}\ngravity = [0, 0, 0]\nhit_limit = 1\n[gas]\nfield = \"duct\"\n\
         direction = [1, 0, 0]\nup = [0, 0, 1]\nheight = {height}\ncentre = [0, 0, 0.001]\nspeed = 0.1\n\
         flow = \"laminar\"\ntemperature = {{ axis = \"z\", at = [0, {height}], value = [300, 400] }}\ndensity = 1.2\n\
         viscosity = 1.8e-5\nheat_capacity = 1005\nconductivity = 0.026\n[particles]\ncount = 100\n\
         position = {{ shape = \"disc\", center = [0, 0, 0.001], radius = {radius}, normal = [1, 0, 0] }}\n\
         direction = [1, 0, 0]\nspeed = 0.1\ndiameter = {diameter}\ntemperature = 350\ndensity = 2000\n\
         conductivity = 0.5\n{}{}",
        plate("cold", 0.0, 1.0, 300.0),
        plate("hot", height, -1.0, 400.0)
    );
    let base = "[particle]\nmaterial = \"fly-ash\"\n[walls.default]\nmaterial = \"stainless-steel\"\n[normal]\n\
                model = \"thornton-ning\"\nyield_ratio = 1.6\n[tangential]\nmodel = \"constant\"\ne_t = 0\n";
    let folder = folder(&[("case.toml", &case), ("base.toml", base), ("measured.csv", &data)]);
    let said = done(folder.path(), &["diagnose", "measured.csv", "--case", "case.toml", "--out", "out"]);
    let found: Value = serde_json::from_str(&text(&folder.path().join("out/diagnosis.json"))).unwrap();
    assert_eq!(found["findings"][0]["cause"], "case:without-thermophoresis", "{data}{said}");
    assert!(found["parties"]["case"].as_f64().unwrap() > 0.95, "{}", found["parties"]);
    let extended = text(&folder.path().join("out/extended_case.toml"));
    assert!(extended.contains("thermophoresis = true"), "{extended}");
}

/// Fly ash at room temperature, below which its stiffness is not known: what to measure next lies where it is.
#[test]
fn what_to_measure_next_stays_where_the_materials_are_known() {
    let case = text(&Path::new(FOLDER).join("case.toml")).replace("value = 293,", "value = 294,");
    let base = "[particle]\nmaterial = \"fly-ash\"\n[walls.default]\nmaterial = \"stainless-steel\"\n[normal]\n\
                model = \"thornton-ning\"\nyield_ratio = 1.6\n[tangential]\nmodel = \"constant\"\ne_t = 0.8\n";
    // With particles faster by 8 % than the case says.
    let data = "particles.speed,mean_e_n@plate,mean_e_n@plate_err\n1,0.3809,0.004\n1.5,0.3631,0.004\n2,0.3596,0.004\n\
                3,0.3404,0.004\n4,0.3258,0.004\n";
    let folder = folder(&[("case.toml", &case), ("base.toml", base), ("measured.csv", data)]);
    done(folder.path(), &["diagnose", "measured.csv", "--case", "case.toml", "--out", "out"]);
    let next = text(&folder.path().join("out/next_experiments.csv"));
    let table: Vec<Vec<&str>> = next.lines().map(|line| line.split(',').collect()).collect();
    assert!(table.len() > 1, "{next}");
    let temperatures = (0..table[0].len()).filter(|place| table[0][*place].contains("temperature"));
    for place in temperatures {
        let values = table[1..].iter().filter_map(|row| row[place].parse::<f64>().ok());
        values.for_each(|value| assert!(value >= 293.15, "{next}"));
    }
}
