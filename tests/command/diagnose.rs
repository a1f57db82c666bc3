//! `nearwall diagnose` as a laboratory uses it: a file of measured impacts in, page, JSON and extended model out.

use std::fmt::Write;
use std::path::Path;

use crate::common::browser::{Seen, browse};
use crate::runner::{WAX, done, refused};
use nearwall::{Impact, ImpactRng, Model};
use serde_json::Value;

/// Invalid rows with their lines.
const BROKEN: [(usize, &str); 2] = [(8, "fast,0.5,7e-5,0,dry,0.3,0.7"), (21, "1.5,0.5,-7e-5,0,dry,0.3,0.7")];

/// Approximately normal with mean 0 and deviation 1: the sum of twelve uniform draws.
fn noise(draw: ImpactRng, first: u64) -> f64 {
    (first..first + 12).map(|stream| draw.uniform(stream)).sum::<f64>() - 6.0
}

/// Measured impacts: the wax model with `e_n` multiplied by `planted` of layer and plate, and noise.
fn measured(rows: u64, planted: impl Fn(f64, &str) -> f64) -> String {
    let model = Model::from_toml("wax.toml", WAX).unwrap();
    let mut text = "v_n,v_t,d,layer_thickness,plate,e_n,e_t\n".to_owned();
    for key in 0..rows {
        let draw = ImpactRng::new(11, key);
        let layer_thickness = if key % 5 == 0 { 0.0 } else { 8e-4 * draw.uniform(103) };
        let plate = ["dry", "old, worn", "wet"][(3.0 * draw.uniform(104)) as usize];
        let impact = Impact {
            normal_speed: 0.5 + 3.0 * draw.uniform(100),
            tangential_speed: 2.0 * draw.uniform(101),
            diameter: 5e-5 + 5e-5 * draw.uniform(102),
            layer_thickness,
            ..Impact::default()
        };
        let outcome = model.resolve(0, &impact, draw).unwrap();
        let e_n = outcome.normal_restitution * planted(layer_thickness, plate) + 0.02 * noise(draw, 200);
        let e_t = outcome.tangential_restitution + 0.03 * noise(draw, 300);
        writeln!(
            text,
            "{},{},{:e},{layer_thickness:e},\"{plate}\",{:.4},{e_t:.4}",
            impact.normal_speed,
            impact.tangential_speed,
            impact.diameter,
            e_n.max(0.0)
        )
        .unwrap();
    }
    let mut lines: Vec<&str> = text.lines().collect();
    for (line, row) in BROKEN {
        if line <= lines.len() {
            lines.insert(line - 1, row);
        }
    }
    lines.join("\n") + "\n"
}

/// The gain on the page is what `predict` gives with the written model on the rows that it has not
/// seen: a column that the library does not know is an input of that model.
#[test]
fn the_gain_is_that_of_the_written_model() {
    let base =
        WAX.replace("[normal]\nmodel = \"thornton-ning\"", "[normal]\nmodel = \"constant\"\ne_n = 0.5");
    let mut data = "v_n,v_t,humidity,plate,e_n\n".to_owned();
    for key in 0..300 {
        let draw = ImpactRng::new(5, key);
        let humidity = 100.0 * draw.uniform(1);
        let plate = ["dry", "wet"][usize::from(draw.uniform(2) > 0.5)];
        let lost = 0.002 * humidity + if plate == "wet" { 0.1 } else { 0.0 };
        let (v_n, v_t) = (0.5 + draw.uniform(3), draw.uniform(4));
        writeln!(data, "{v_n},{v_t},{humidity},{plate},{}", 0.5 - lost + 0.02 * noise(draw, 200)).unwrap();
    }
    let folder = crate::runner::folder(&[("lab.csv", &data), ("base.toml", &base)]);
    done(folder.path(), &["diagnose", "lab.csv", "--model", "base.toml", "--out", "out"]);
    let found = json(folder.path());
    let gain = &found["gain"];
    assert_eq!(gain["measured"], "held-out", "{found}");

    let lines = unseen_lines(&found);
    assert_eq!(lines.len(), 75);
    let all: Vec<&str> = data.lines().collect();
    let rows: Vec<&str> = std::iter::once(all[0]).chain(lines.iter().map(|line| all[line - 1])).collect();
    std::fs::write(folder.path().join("unseen.csv"), rows.join("\n") + "\n").unwrap();
    for (model, stated) in [("base.toml", "rmse_before"), ("out/extended.toml", "rmse_after")] {
        let table = done(folder.path(), &["predict", "--model", model, "unseen.csv"]);
        let mut table = csv::Reader::from_reader(table.as_bytes());
        let header = table.headers().unwrap().clone();
        let place = |name: &str| header.iter().position(|column| column == name).unwrap();
        let (measured, predicted) = (place("e_n"), place("e_n_predicted"));
        let square = |row: csv::StringRecord| {
            (row[measured].parse::<f64>().unwrap() - row[predicted].parse::<f64>().unwrap()).powi(2)
        };
        let squares: Vec<f64> = table.records().map(|row| square(row.unwrap())).collect();
        let rmse = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
        let stated = gain[stated].as_f64().unwrap();
        assert!((rmse / stated - 1.0).abs() < 1e-9, "{model}: {rmse} by predict, {stated} on the page");
    }
    assert!(gain["rmse_after"].as_f64().unwrap() < 0.027, "{gain}");
}

/// The lines that `extended.toml` has not seen, by the JSON.
fn unseen_lines(found: &Value) -> Vec<usize> {
    let lines = found["rows"]["held_out_lines"].as_array().unwrap();
    lines.iter().map(|line| line.as_u64().unwrap() as usize).collect()
}

/// The interval of a level is Student's on the rows that the file has seen.
#[test]
fn the_interval_of_a_level_is_students() {
    let base =
        WAX.replace("[normal]\nmodel = \"thornton-ning\"", "[normal]\nmodel = \"constant\"\ne_n = 0.5");
    let mut data = "v_n,e_n\n".to_owned();
    for key in 0..80 {
        let draw = ImpactRng::new(6, key);
        writeln!(data, "{},{}", 0.5 + draw.uniform(3), 0.6 + 0.03 * noise(draw, 200)).unwrap();
    }
    let folder = crate::runner::folder(&[("lab.csv", &data), ("base.toml", &base)]);
    done(folder.path(), &["diagnose", "lab.csv", "--model", "base.toml", "--out", "out"]);
    let found = json(folder.path());
    let level = &found["calibration"][0];
    assert_eq!(level["key"], "normal.e_n", "{found}");
    let unseen = unseen_lines(&found);
    let seen: Vec<f64> = data
        .lines()
        .enumerate()
        .skip(1)
        .filter(|(line, _)| !unseen.contains(&(line + 1)))
        .map(|(_, row)| row.split(',').nth(1).unwrap().parse().unwrap())
        .collect();
    let count = seen.len() as f64;
    let mean = seen.iter().sum::<f64>() / count;
    let deviation = (seen.iter().map(|e_n| (e_n - mean).powi(2)).sum::<f64>() / (count - 1.0)).sqrt();
    // Student's t for 95 % at 59 or more degrees of freedom is 1.99 to 2.00.
    let half = 2.0 * deviation / count.sqrt();
    let [low, high] = ["low", "high"].map(|end| level[end].as_f64().unwrap());
    assert!((0.5 * (low + high) - mean).abs() < 0.1 * half, "{low} to {high} about {mean}");
    // Gross errors are expected, and the rows' own scatter can only widen it.
    let ratio = 0.5 * (high - low) / half;
    assert!((0.95..1.2).contains(&ratio), "{ratio}");
}

/// Days that share an error are held out as a whole.
#[test]
fn whole_groups_are_held_out() {
    let mut data = "v_n,v_t,d,layer_thickness,day,e_n\n".to_owned();
    let model = Model::from_toml("wax.toml", WAX).unwrap();
    for key in 0..600 {
        let (draw, day) = (ImpactRng::new(8, key), key % 60);
        let layer_thickness = 8e-4 * draw.uniform(103);
        let impact =
            Impact { normal_speed: 3.0 + 3.0 * draw.uniform(100), diameter: 8e-5, ..Impact::default() };
        let plain = model.resolve(0, &impact, draw).unwrap().normal_restitution;
        let shared = 0.05 * noise(ImpactRng::new(9, day), 0);
        let e_n = plain * (0.4 + 0.6 * (-layer_thickness / 2e-4).exp()) + shared + 0.02 * noise(draw, 200);
        writeln!(data, "{},0.5,8e-5,{layer_thickness:e},{day},{}", impact.normal_speed, e_n.max(0.0))
            .unwrap();
    }
    let folder = folder(&data);
    done(folder.path(), &DIAGNOSE);
    let found = json(folder.path());
    assert_eq!(found["groups"]["column"], "day", "{found}");
    assert_eq!(found["findings"][0]["cause"], "powder-layer", "{found}");
    // Line `n` has the key `n - 2`.
    let days: Vec<usize> = unseen_lines(&found).iter().map(|line| (line - 2) % 60).collect();
    let all: std::collections::BTreeSet<usize> = days.iter().copied().collect();
    assert_eq!((all.len(), days.len()), (15, 150), "{found}");
}

/// Share of `e_n` that a layer leaves [1]; another law than the library's.
fn rational(layer: f64) -> f64 {
    0.4 + 0.6 / (1.0 + (layer / 1.5e-4).powi(2))
}

fn folder(data: &str) -> tempfile::TempDir {
    crate::runner::folder(&[("wax.toml", WAX), ("lab.csv", data)])
}

const DIAGNOSE: [&str; 6] = ["diagnose", "lab.csv", "--model", "wax.toml", "--out", "out"];

fn json(folder: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(folder.join("out/diagnosis.json")).unwrap()).unwrap()
}

/// Asserts that the page needs no other file, and contains a figure for each of `ids` and each of `words`.
fn page_shows(folder: &Path, ids: &[&str], words: &[&str]) {
    let page = folder.join("out/report.html");
    let html = std::fs::read_to_string(&page).unwrap();
    let namespaces = html.replace("http://www.w3.org/", "");
    for elsewhere in ["http://", "https://", "src=", "url(//", "@import", "NaN"] {
        assert!(!namespaces.contains(elsewhere), "the page holds {elsewhere}");
    }
    for word in words {
        assert!(html.contains(word), "`{word}` is not on the page");
    }
    let mut named: Vec<&str> =
        html.split("<figure id=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
    named.sort_unstable();
    assert!(named.windows(2).all(|pair| pair[0] != pair[1]), "two figures of one name: {named:?}");
    let Some(Seen { dom, complaints }) = browse(&page) else { return };
    assert!(complaints.is_empty(), "{complaints:?}");
    for id in ids {
        let figure = dom.split_once(&format!("<figure id=\"{id}\">"));
        let figure = figure.and_then(|(_, rest)| rest.split("</figure>").next()).unwrap_or_default();
        assert!(figure.contains("<svg") && figure.contains("<text"), "no figure {id} among {named:?}");
        let caption = figure.split("<figcaption>").nth(1).unwrap_or_default();
        assert!(caption.len() > 20, "{id} has no caption");
    }
}

#[test]
fn a_planted_layer_is_found_and_the_three_files_are_consistent() {
    let folder = folder(&measured(300, |layer, _| rational(layer)));
    let folder = folder.path();
    let printed = done(folder, &DIAGNOSE);
    assert!(printed.contains("powder-layer") && printed.contains("report.html"), "{printed}");

    let json = json(folder);
    assert_eq!(json["schema"], "nearwall.diagnosis/2");
    assert_eq!((json["seed"].as_u64(), json["level"].as_f64()), (Some(1), Some(0.05)));
    assert_eq!((json["rows"]["read"].as_u64(), json["rows"]["used"].as_u64()), (Some(302), Some(300)));
    assert_eq!(json["rows"]["held_out"], 75);
    let lines: Vec<u64> = json["rows"]["rejected"]
        .as_array()
        .unwrap()
        .iter()
        .map(|bad| bad["line"].as_u64().unwrap())
        .collect();
    assert_eq!(lines, BROKEN.map(|(line, _)| line as u64));
    assert!(json["base"]["rmse_e_n"].as_f64().unwrap() > 0.03);
    assert!((json["base"]["rmse_e_t"].as_f64().unwrap() - 0.03).abs() < 0.005);
    assert!(json["base"]["log_loss_stick"].is_null());
    assert_eq!(json["misfit"][0]["column"], "layer_thickness");
    assert_eq!(json["extended_model"], "extended.toml");

    let finding = &json["findings"][0];
    assert_eq!(
        (finding["cause"].as_str(), finding["observable"].as_str()),
        (Some("powder-layer"), Some("e_n"))
    );
    assert_eq!(finding["variables"], serde_json::json!(["layer_thickness"]));
    assert!(finding["p_value"].as_f64().unwrap() <= finding["q_value"].as_f64().unwrap());
    assert!(finding["q_value"].as_f64().unwrap() < 1e-3);
    let residual = &finding["parameters"]["residual"];
    let [low, value, high] = ["low", "value", "high"].map(|key| residual[key].as_f64().unwrap());
    assert!(
        low < value && value < high && (0.2..0.6).contains(&value) && residual["unit"] == "1",
        "{residual}"
    );
    assert!(!finding["alternatives"].as_array().unwrap().is_empty());
    assert!(finding["alternatives"][0]["score_difference"].is_number());
    assert!(
        finding["indistinguishable_from"].is_array() && finding["explanation"].as_str().unwrap().len() > 20
    );
    let gain = &json["gain"];
    let [before, after] = ["rmse_before", "rmse_after"].map(|key| gain[key].as_f64().unwrap());
    assert!(after < 0.7 * before && gain["ci95"][1].as_f64().unwrap() < 0.8, "{gain}");
    // The remaining error is the noise and the difference of the two laws.
    assert!((0.015..0.028).contains(&after), "{after}");

    page_shows(
        folder,
        &["misfit-e-n-layer-thickness", "cause-powder-layer", "parity-e-n-before", "parity-e-n-after"],
        &[
            "<td class=\"w\">8</td>",
            "<td class=\"w\">21</td>",
            "nearwall predict --model extended.toml",
            "nearWallInteractionCoeffs",
        ],
    );
}

#[test]
fn the_extended_model_is_accepted_and_predicts_the_effect() {
    let folder = folder(&measured(300, |layer, _| rational(layer)));
    let folder = folder.path();
    done(folder, &DIAGNOSE);
    assert!(done(folder, &["check", "out/extended.toml"]).contains("accepted"));
    std::fs::write(folder.join("two.csv"), "v_n,d,layer_thickness\n2,7e-5,0\n2,7e-5,8e-4\n").unwrap();
    let predicted = done(folder, &["predict", "--model", "out/extended.toml", "two.csv"]);
    let mut lines = predicted.lines().map(|line| line.split(',').collect::<Vec<&str>>());
    let place = lines.next().unwrap().iter().position(|name| *name == "e_n").unwrap();
    let e_n: Vec<f64> = lines.map(|cells| cells[place].parse().unwrap()).collect();
    let (found, planted) = (e_n[1] / e_n[0], rational(8e-4));
    assert!((found - planted).abs() < 0.06, "a thick layer leaves {found}, planted was {planted}");
}

#[test]
fn the_same_seed_gives_the_same_bytes() {
    let folder = folder(&measured(150, |layer, _| rational(layer)));
    let folder = folder.path();
    let files = || {
        done(folder, &DIAGNOSE);
        ["extended.toml", "diagnosis.json", "report.html"]
            .map(|name| std::fs::read(folder.join("out").join(name)).unwrap())
    };
    assert!(files() == files(), "two runs differ");
}

#[test]
fn a_plate_that_no_effect_explains_is_shown_by_label() {
    let plates = |_, plate: &str| if plate == "old, worn" { 0.6 } else { 1.0 };
    let folder = folder(&measured(300, plates));
    let folder = folder.path();
    done(folder, &DIAGNOSE);
    let json = json(folder);
    assert_eq!(json["findings"][0]["cause"], "unknown:plate", "{json}");
    assert!(done(folder, &["check", "out/extended.toml"]).contains("accepted"));
    page_shows(
        folder,
        &["misfit-e-n-plate", "curve-unknown-plate", "cause-unknown-plate"],
        &[">old, worn<", "named in"],
    );
}

#[test]
fn a_group_is_a_column_of_labels() {
    let folder = folder(&measured(40, |_, _| 1.0));
    let folder = folder.path();
    let group = |name| [&DIAGNOSE[..], &["--group", name]].concat();
    done(folder, &group("plate"));
    let remedy = ["lab.csv", "unknown group column `plates`", "did you mean `plate`?", "(known here: plate)"];
    refused(folder, &group("plates"), &remedy);
    refused(folder, &group("d"), &["lab.csv", "`d` is an input", "plate"]);
}

#[test]
fn a_correct_model_has_no_finding() {
    let folder = folder(&measured(120, |_, _| 1.0));
    let folder = folder.path();
    done(folder, &DIAGNOSE);
    let json = json(folder);
    assert_eq!(json["findings"], serde_json::json!([]), "{json}");
    let extended = std::fs::read_to_string(folder.join("out/extended.toml")).unwrap();
    assert_eq!(extended, WAX);
    page_shows(
        folder,
        &["misfit-e-n-v-n", "parity-e-n-before"],
        &["No column stands out", "Nothing was added"],
    );
}

#[test]
fn unusable_data_are_refused_with_the_remedy() {
    let folder = folder("v_n,d\n1,7e-5\n2,7e-5\n");
    let folder = folder.path();
    refused(folder, &DIAGNOSE, &["lab.csv", "e_n", "capture_efficiency"]);
    refused(folder, &["diagnose", "lab.csv", "--model", "absent.toml", "--out", "out"], &["absent.toml"]);
    refused(folder, &["diagnose", "absent.csv", "--model", "wax.toml", "--out", "out"], &["absent.csv"]);
    std::fs::write(folder.join("lab.csv"), "v_n,e_n\n1,0.3\n2,0.3\nslow,0.3\n").unwrap();
    refused(folder, &DIAGNOSE, &["lab.csv", "2 of 3 rows", "at least 3", "Line 4"]);
    for level in ["2", "0", "nan"] {
        let mut arguments = DIAGNOSE.to_vec();
        arguments.extend(["--level", level]);
        refused(folder, &arguments, &["--level", "between 0 and 0.5"]);
    }
    assert!(!folder.join("out").exists(), "a refused diagnosis leaves nothing behind");
}

/// Nothing varies, a column name contains line breaks, a temperature has a digit too many, a gas is faster than light.
#[test]
fn odd_files_give_a_readable_extended_model() {
    let constant = "v_n,v_t,e_n,e_t\n".to_owned() + &"0.5,0.5,0.5,0.5\n".repeat(12);
    let rows = |of: &dyn Fn(u32) -> String| (0..24).map(of).collect::<String>();
    let broken = "v_n,\"a\nb = [1]\r\n[walls.x]\",e_n\n".to_owned()
        + &rows(&|i| format!("1.{i},{},{}\n", i % 12, 0.1 + 0.02 * f64::from(i % 12)));
    let hot = "v_n,T_p,outcome\n".to_owned()
        + &rows(&|i| format!("1.{i},{},{}\n", 28_292 + i, if i > 12 { "stick" } else { "rebound" }));
    let fast = "v_n,v_gas,e_n\n".to_owned()
        + &rows(&|i| format!("1.{i},{},0.2{i}\n", if i == 7 { "1e308" } else { "3" }));
    for (data, rejected) in [(constant, 0), (broken, 0), (hot, 0), (fast, 1)] {
        let folder = folder(&data);
        done(folder.path(), &DIAGNOSE);
        let text = std::fs::read_to_string(folder.path().join("out/extended.toml")).unwrap();
        Model::from_toml("extended.toml", &text).unwrap();
        let found = json(folder.path());
        assert_eq!(found["rows"]["rejected"].as_array().unwrap().len(), rejected, "{data}");
        for finding in found["findings"].as_array().unwrap() {
            assert!(finding["gain"].is_number(), "{finding}");
        }
    }
}

/// The effect of a diameter that is not in the file cannot be examined, although the laws depend on it.
#[test]
fn an_effect_of_a_constant_diameter_is_not_examined() {
    let mut data = "v_n,v_t,captured\n".to_owned();
    for row in 0..12 {
        writeln!(data, "{},{},1", 1.0 + 0.2 * f64::from(row), 0.3 * f64::from(row % 4)).unwrap();
    }
    let folder = folder(&data);
    done(folder.path(), &DIAGNOSE);
    let json = json(folder.path());
    let named = json["findings"].as_array().unwrap();
    assert!(named.iter().all(|finding| finding["cause"] != "size-dependent-yield"), "{named:?}");
    let unexamined = json["not_examined"].as_array().unwrap();
    let reason = |cause: &str| unexamined.iter().find(|one| one["cause"] == cause).map(|one| &one["reason"]);
    assert_eq!(reason("size-dependent-yield").unwrap(), "d does not vary in the data");
    assert_eq!(reason("strain-rate-hardening"), None);
}
