//! What files of laboratories say or leave out: outcomes, inputs, limits, units. The truth is that of the generators here.

use std::fmt::Write;

use crate::runner::{WAX, done, folder, refused};
use nearwall::{Impact, ImpactRng, Model};
use serde_json::Value;

/// Approximately normal with mean 0 and deviation 1: the sum of twelve uniform draws.
fn noise(draw: ImpactRng) -> f64 {
    (200..212).map(|stream| draw.uniform(stream)).sum::<f64>() - 6.0
}

/// The cells of an impact: `v_n`, `d`, `T_p`, `e_n`, `outcome`.
type Cells = [String; 5];

/// Rows of the wax model whose `e_n` falls by `softening` about 325 K, where a share `melts` of the particles sticks.
fn rows(seed: u64, count: u64, softening: f64, melts: bool) -> Vec<Cells> {
    let model = Model::from_toml("wax.toml", WAX).unwrap();
    let row = |key: u64| {
        let draw = ImpactRng::new(seed, key);
        let temperature = 290.0 + 60.0 * draw.uniform(2);
        let impact = Impact {
            normal_speed: 0.8 + 3.0 * draw.uniform(0),
            diameter: 5e-5 + 5e-5 * draw.uniform(1),
            ..Impact::default()
        };
        let soft = 1.0 / (1.0 + ((325.0 - temperature) / 8.0_f64).exp());
        let outcome = model.expect(0, &impact, 1).unwrap();
        let e_n = outcome.normal_restitution * (1.0 - softening * soft) + 0.03 * noise(draw);
        let (e_n, outcome) = match melts && draw.uniform(3) < soft {
            true => (String::new(), "stick"),
            false => (format!("{:.4}", e_n.max(0.001)), "rebound"),
        };
        let inputs = [impact.normal_speed, impact.diameter, temperature].map(|number| format!("{number}"));
        let [v_n, d, t_p] = inputs;
        [v_n, d, t_p, e_n, outcome.to_owned()]
    };
    (0..count).map(row).collect()
}

/// The file of these rows with the first `columns` columns.
fn file(rows: &[Cells], columns: usize) -> String {
    let header = ["v_n", "d", "T_p", "e_n", "outcome"];
    let lines = rows.iter().map(|cells| cells[..columns].join(","));
    std::iter::once(header[..columns].join(",")).chain(lines).collect::<Vec<_>>().join("\n") + "\n"
}

fn diagnosed(data: &str, model: &str) -> Value {
    let folder = folder(&[("lab.csv", data), ("base.toml", model)]);
    done(folder.path(), &["diagnose", "lab.csv", "--model", "base.toml", "--out", "out"]);
    serde_json::from_str(&std::fs::read_to_string(folder.path().join("out/diagnosis.json")).unwrap()).unwrap()
}

fn causes(found: &Value) -> Vec<&str> {
    found["findings"].as_array().unwrap().iter().map(|finding| finding["cause"].as_str().unwrap()).collect()
}

/// A row with `e_n` above 0 is a rebound: softening is no reason to expect captures.
#[test]
fn captures_that_never_happened_are_not_named() {
    for seed in 0..4 {
        let found = diagnosed(&file(&rows(seed, 200, 0.4, false), 4), WAX);
        let undecided: Vec<&str> =
            found["undecided"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
        let said = [causes(&found), undecided].concat();
        assert!(!said.is_empty(), "seed {seed}: {found}");
        assert!(!said.contains(&"melting-transition"), "seed {seed}: {found}");
        let observables = found["findings"].as_array().unwrap().iter().map(|finding| &finding["observable"]);
        assert!(observables.clone().all(|observable| observable == "e_n"), "seed {seed}: {found}");
        assert!(found["base"]["log_loss_stick"].is_null(), "no outcome was measured: {found}");
    }
}

/// Melting is found, and its temperature, although every third temperature was lost.
#[test]
fn missing_temperatures_are_no_room_temperature() {
    for seed in 10..13 {
        let mut rows = rows(seed, 300, 0.3, true);
        for (key, cells) in (0..).zip(&mut rows) {
            if ImpactRng::new(seed, key).uniform(9) < 0.33 {
                cells[2].clear();
            }
        }
        let found = diagnosed(&file(&rows, 5), WAX);
        assert_eq!(causes(&found), ["melting-transition"], "seed {seed}: {found}");
        let parameters = &found["findings"][0]["parameters"];
        let temperature = parameters["temperature"]["value"].as_f64().unwrap();
        assert!((temperature - 325.0).abs() < 4.0, "seed {seed}: {parameters}");
        assert!((parameters["softening"]["value"].as_f64().unwrap() - 0.3).abs() < 0.15, "{parameters}");
    }
}

/// The level of `e_n` is that of all rows, not that of those above the limit.
#[test]
fn limits_count_as_limits() {
    let base = WAX.replace("model = \"thornton-ning\"\nyield_ratio = 0.7", "model = \"constant\"\ne_n = 0.5");
    let mut data = "v_n,e_n\n".to_owned();
    for key in 0..300 {
        let draw = ImpactRng::new(21, key);
        let e_n = 0.25 + 0.1 * noise(draw);
        let cell = if e_n < 0.2 { "<0.2".to_owned() } else { format!("{e_n:.4}") };
        writeln!(data, "{},{cell}", 1.0 + draw.uniform(0)).unwrap();
    }
    let found = diagnosed(&data, &base);
    let level = &found["calibration"][0];
    assert_eq!(level["key"], "normal.e_n", "{found}");
    let [low, high] = ["low", "high"].map(|end| level[end].as_f64().unwrap());
    // Above 0.2 the mean is 0.25 + 0.1 phi(0.5)/Phi(0.5) = 0.301.
    assert!(low < 0.25 && 0.25 < high && high < 0.28, "{level}");
}

/// `predict` reads what spreadsheets write, says so, and writes what it can read again.
#[test]
fn predict_reads_a_german_table_and_refuses_metres() {
    let german = "v_n;T_p;d\r\nm/s;C;µm\r\n1,5;20;75\r\n2,5;27,5;50\r\n";
    let bytes: Vec<u8> = german.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let folder = folder(&[("wax.toml", WAX), ("si.csv", "v_n,T_p,d\n1.5,293.15,75e-6\n2.5,300.65,50e-6\n")]);
    std::fs::write(folder.path().join("german.csv"), bytes).unwrap();
    let predict = |file: &str, out: &str| {
        done(folder.path(), &["predict", "--model", "wax.toml", file, "-o", out]);
        let text = std::fs::read_to_string(folder.path().join(out)).unwrap();
        let mut table = csv::Reader::from_reader(text.as_bytes());
        let place = table.headers().unwrap().iter().position(|name| name.starts_with("e_n")).unwrap();
        let e_n = |row: csv::StringRecord| row[place].parse::<f64>().unwrap();
        table.records().map(|row| e_n(row.unwrap())).collect::<Vec<f64>>()
    };
    let expected = predict("si.csv", "si_out.csv");
    let found = predict("german.csv", "german_out.csv");
    assert!(
        expected.iter().zip(&found).all(|(one, other)| (one - other).abs() < 1e-9),
        "{expected:?} {found:?}"
    );
    let again = std::fs::read_to_string(folder.path().join("german_out.csv")).unwrap();
    assert!(again.starts_with("v_n [m/s],T_p [C],d [µm],e_n") && again.contains("\n1.5,20,75,"), "{again}");
    std::fs::write(folder.path().join("metres.csv"), "v_n,d,e_n\n1,88,0.4\n2,75,0.4\n3,66,0.3\n").unwrap();
    let remedy = ["metres.csv:2", "d = 88 m", "`d [um]`", "column map"];
    refused(folder.path(), &["predict", "--model", "wax.toml", "metres.csv"], &remedy);
    refused(folder.path(), &["compare", "metres.csv", "--models", "wax.toml", "wax.toml"], &remedy);
    refused(folder.path(), &["diagnose", "metres.csv", "--model", "wax.toml", "--out", "out"], &remedy);
    assert!(!folder.path().join("out").exists());
}
