//! Inputs that a model file declares, in the command: columns of `predict`, `compare` and `check`;
//! and means over chance in `predict`.

use nearwall::{Impact, Model};
use nearwall_lab::dataset::{ColumnMap, Measurements, WallChoice};

use crate::runner::{WAX, done, folder, nearwall, refused};

const DECLARED: &str = "[inputs.humidity]\ndefault = 40\n[inputs.operator]\nlabels = [\"Ann\", \"Bob\"]\n";

const INPUTS: &str = r#"
[inputs.humidity]
default = 40
[inputs.operator]
labels = ["Ann", "Bob"]
[[effects]]
kind = "fitted-curve"
input = "humidity"
on = "e_t"
knots = [0, 100]
values = [0, -0.1]
[[effects]]
kind = "fitted-curve"
input = "operator"
on = "e_t"
form = "factor"
knots = ["Bob"]
values = [0.5]
"#;

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// The predicted `e_t` of each row, and what was said.
fn predicted(rows: &str) -> (Vec<f64>, String) {
    let folder = folder(&[("m.toml", &format!("{WAX}{INPUTS}")), ("i.csv", rows)]);
    let output = nearwall(folder.path(), &["predict", "--model", "m.toml", "i.csv"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let table = text(&output.stdout);
    let place = table.lines().next().unwrap().split(',').position(|name| name == "e_t").unwrap();
    let e_t = |line: &str| line.split(',').nth(place).unwrap().parse().unwrap();
    (table.lines().skip(1).map(e_t).collect(), text(&output.stderr))
}

#[test]
fn predict_reads_declared_inputs_by_their_column() {
    let (e_t, said) = predicted("v_n,humidity,operator\n1,100,Ann\n1,50,Bob\n1,,\n1,0,Eve\n1,wet,Bob\n");
    for (value, expected) in e_t.iter().zip([0.66, 0.71 * 1.5, 0.72, 0.76]) {
        assert!((value - expected).abs() < 1e-12, "{e_t:?}");
    }
    assert_eq!(e_t.len(), 4);
    assert!(said.contains("line 6 left out: humidity `wet` is not a number"), "{said}");
    assert!(
        said.contains("line 5: operator is none of Ann, Bob; such rows are predicted without it"),
        "{said}"
    );
    assert!(!said.contains("humidity = 40"), "{said}");
}

#[test]
fn predict_says_which_default_it_assumed() {
    let (e_t, said) = predicted("v_n,d,T_p,T_w,conversion\n1,1e-4,300,300,1\n");
    assert!((e_t[0] - 0.72).abs() < 1e-12, "{e_t:?}");
    assert!(said.contains("not in i.csv, assumed: humidity = 40\n"), "{said}");
    let (_, said) = predicted("v_n\n1\n");
    assert!(said.contains("conversion = 1") && said.contains(", humidity = 40\n"), "{said}");
}

#[test]
fn check_and_explain_show_inputs_and_corrections() {
    let folder = folder(&[("m.toml", &format!("{WAX}{INPUTS}")), ("i.csv", "v_n,operator\n1,Bob\n")]);
    let output = text(&nearwall(folder.path(), &["check", "m.toml"]).stdout);
    for part in [
        "humidity, default 40",
        "operator, one of Ann, Bob, no default",
        "e_t (1 + f), f 0.5 to 0.5 over operator",
    ] {
        assert!(output.contains(part), "{output}");
    }
    let output = nearwall(folder.path(), &["predict", "--model", "m.toml", "i.csv", "--explain", "2"]);
    let lines = text(&output.stdout);
    let steps: Vec<&str> = lines.lines().filter(|line| line.starts_with("fitted-curve")).collect();
    assert_eq!(steps.len(), 2, "{lines}");
    assert!(steps[0].ends_with("0.720000") && steps[1].ends_with("1.080000"), "{lines}");
}

#[test]
fn a_declared_name_that_is_taken_is_refused() {
    let taken = format!("{WAX}[inputs.e_n]\ndefault = 1\n");
    let folder = folder(&[("m.toml", &taken), ("i.csv", "v_n\n1\n")]);
    refused(
        folder.path(),
        &["predict", "--model", "m.toml", "i.csv"],
        &["inputs", "`e_n` is an observed column of data files"],
    );
}

/// Noise of +-0.01 about the curve: the model that knows the column wins, and only its residual is the noise.
#[test]
fn compare_gives_declared_inputs_to_each_model() {
    let row = |row: u64| {
        let humidity = (row * 37) % 101;
        let noise = if row.is_multiple_of(3) { 0.01 } else { -0.01 };
        format!("1,{humidity},{}\n", 0.76 - 0.001 * humidity as f64 + noise)
    };
    let rows: String = (0..60).map(row).collect();
    let files = [
        ("plain.toml", WAX.to_owned()),
        ("curve.toml", format!("{WAX}{INPUTS}")),
        ("lab.csv", format!("v_n,humidity,e_t\n{rows}")),
    ];
    let folder = folder(&files.each_ref().map(|(name, text)| (*name, text.as_str())));
    done(folder.path(), &["compare", "lab.csv", "--models", "plain.toml", "curve.toml", "--out", "out"]);
    let json = std::fs::read_to_string(folder.path().join("out/compare.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let best = &json["models"][0];
    assert_eq!(best["model"], "curve.toml");
    assert!((best["rmse_e_t"]["value"].as_f64().unwrap() - 0.01).abs() < 1e-9, "{best}");
}

/// A quarter of the particles are agglomerates with `e_n` of 0.8 on average: the row has the mean, not one draw.
#[test]
fn predict_averages_what_is_drawn_by_chance() {
    let chance = "[[effects]]\nkind = \"agglomerates\"\nfraction = 0.25\nrestitution = 0.8\nspread = 0.1\n";
    let rows = "v_n,d\n1,75e-6\n2,75e-6\n";
    let e_n = |model: &str| {
        let folder = folder(&[("m.toml", model), ("i.csv", rows)]);
        let table = done(folder.path(), &["predict", "--model", "m.toml", "i.csv"]);
        let e_n = |line: &str| line.split(',').nth(2).unwrap().parse::<f64>().unwrap();
        table.lines().skip(1).map(e_n).collect::<Vec<_>>()
    };
    let mean = e_n(&format!("{WAX}{chance}"));
    for (mean, plain) in mean.into_iter().zip(e_n(WAX)) {
        assert!((mean - (0.75 * plain + 0.25 * 0.8)).abs() < 0.01, "{mean}, plain {plain}");
    }
}

#[test]
fn measured_data_state_declared_inputs() {
    let model = Model::from_toml("m.toml", &format!("{WAX}{DECLARED}")).unwrap();
    let walls = WallChoice::new(&model, None).unwrap();
    let read = |text: &str, map: &str| {
        let map = ColumnMap::from_toml("map.toml", map).unwrap();
        Measurements::read("t.csv", text.as_bytes(), Some(&map), &walls).unwrap()
    };
    let data = read(
        "v_n;e_t;humidity;operator;plate\n1;0,5;12,5;Bob;3\n1;0,5;NA;;3\n1;0,5;20;Eve;3\n1;0,5;wet;Ann;3\n",
        "separator = \";\"\ndecimal = \",\"\n",
    );
    assert_eq!((data.given, data.given_extra), (vec!["v_n"], vec![0, 1]));
    let extra: Vec<_> = data.rows.iter().map(|row| [row.impact.extra[0], row.impact.extra[1]]).collect();
    assert_eq!(extra[0], [12.5, 1.0]);
    assert!(extra[1].iter().all(|value| value.is_nan()));
    assert!(extra[2][0] == 20.0 && model.extra_inputs()[1].is_unknown(extra[2][1]));
    assert_eq!(data.rejected[0].reason, "humidity `wet` is not a number");
    assert_eq!(data.columns.iter().map(|column| column.name.as_str()).collect::<Vec<_>>(), ["plate"]);
    for note in [
        "humidity is blank in 1 of 3 rows, taken as the default",
        "operator is blank in 1 of 3 rows, without a correction",
        "operator is no label of the model in 1 of 3 rows, without a correction",
    ] {
        assert!(data.notes.iter().any(|own| own == note), "{note} is not in {:?}", data.notes);
    }
    let data = read("v_n,e_t\n1,0.5\n", "");
    assert_eq!(
        (data.given_extra.len(), data.rows[0].impact),
        (0, Impact { normal_speed: 1.0, ..Impact::default() })
    );
    assert!(
        data.notes.iter().any(|note| note == "not in the file, assumed: humidity = 40"),
        "{:?}",
        data.notes
    );
}

/// At We = 1000 · 25 · 120e-6/0.03 = 100 the curve is half way up from 0 to 0.2, and the form is 2/sqrt(100).
#[test]
fn predict_and_explain_compute_groups() {
    let model = "[inputs.sigma_p]\ndefault = 0.03\n[[effects]]\nkind = \"fitted-form\"\ninput = \"We\"\non = \"e_t\"\n\
                form = \"power\"\na = 2\nb = -0.5\nvalid = { We = [1, 150] }\n[[effects]]\nkind = \"fitted-curve\"\n\
                input = \"We\"\non = \"e_t\"\nknots = [50, 150]\nvalues = [0, 0.2]\n";
    let rows = "v_n,d,T_p,sigma_p\n5,120e-6,393.15,\n5,120e-6,393.15,0.06\n5,120e-6,393.15,0.012\n";
    let folder = folder(&[("m.toml", &format!("{WAX}{model}")), ("i.csv", rows)]);
    let output = nearwall(folder.path(), &["predict", "--model", "m.toml", "i.csv"]);
    let table = text(&output.stdout);
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let heads = lines.next().unwrap();
    let place = |name: &str| heads.iter().position(|head| *head == name).unwrap();
    for (row, expected) in lines.by_ref().zip([0.3, 2.0 / 50_f64.sqrt(), 2.0 / 250_f64.sqrt() + 0.2]) {
        let e_t: f64 = row[place("e_t")].parse().unwrap();
        assert!((e_t - expected).abs() < 1e-6, "{e_t} against {expected}: {table}");
    }
    assert!(table.contains("fitted-form is stated for We 1 to 150"), "{table}");
    let explained = nearwall(folder.path(), &["predict", "--model", "m.toml", "i.csv", "--explain", "2"]);
    let lines = text(&explained.stdout);
    let steps: Vec<&str> = lines.lines().filter(|line| line.starts_with("fitted-")).collect();
    assert!(steps.iter().any(|line| line.contains(" We ") && line.ends_with("100.000000")), "{lines}");
    let checked = text(&nearwall(folder.path(), &["check", "m.toml"]).stdout);
    assert!(checked.contains("e_t = f, f = a x^b, a = 2, b = -0.5, x = We"), "{checked}");
}
