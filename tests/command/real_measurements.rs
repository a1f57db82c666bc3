//! What a diagnosis says of measurements from the literature, beside the verdict that was written
//! down before its first run.
//!
//! `tests/real_measurements/README.md` describes the sets and the keys of `expected.json`. The
//! folder `NEARWALL_REAL_OUT`, if set, gets the page and the JSON of each set.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use nearwall::effect::EFFECTS;
use serde_json::Value;

fn folder(set: &str) -> PathBuf {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/..")).join("tests/real_measurements").join(set)
}

fn json(file: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap()
}

fn words(list: &Value) -> Vec<&str> {
    list.as_array().map_or(vec![], |all| all.iter().filter_map(Value::as_str).collect())
}

/// The columns that a cause turns on.
fn columns_of(cause: &str) -> Vec<&str> {
    match cause.strip_prefix("unknown:") {
        Some(column) => vec![column],
        None => EFFECTS.iter().find(|effect| effect.id == cause).map_or(vec![], |e| e.inputs.to_vec()),
    }
}

/// Differences between the verdict and the expectation.
fn differences(said: &Value, expected: &Value) -> Vec<String> {
    let list = |key: &str| said[key].as_array().cloned().unwrap_or_default();
    let findings = list("findings");
    let causes: Vec<&str> = findings.iter().filter_map(|f| f["cause"].as_str()).collect();
    let mut wrong = Vec::new();

    let misfit = said["fit"]["base"]["p_value"].as_f64().is_some_and(|p| p < 0.05);
    let speaks = misfit
        || ["findings", "calibration", "undecided", "rivals"].iter().any(|key| !list(key).is_empty())
        || !said["groups"].is_null();
    if expected["refuted"] == true && !speaks {
        wrong.push("the base model is not refuted".to_owned());
    }

    let may = words(&expected["may_name"]);
    wrong.extend(causes.iter().filter(|c| !may.contains(c)).map(|c| format!("{c} is named")));

    let mut columns: Vec<String> =
        findings.iter().flat_map(|f| words(&f["variables"])).map(Into::into).collect();
    columns.extend(causes.iter().flat_map(|c| columns_of(c)).map(Into::into));
    columns.extend(words(&said["undecided"]).iter().flat_map(|c| columns_of(c)).map(Into::into));
    columns.extend(said["groups"]["column"].as_str().map(Into::into));
    let rivals: String = list("rivals").iter().map(Value::to_string).collect();
    let wanted = words(&expected["depends_on"]);
    let involved = |w: &&str| columns.iter().any(|c| c == w) || rivals.contains(*w);
    if !wanted.is_empty() && !wanted.iter().any(involved) {
        wrong.push(format!("nothing depends on {}", wanted.join(" or ")));
    }

    if let Some(key) = expected["value_of"].as_str() {
        let range = |i: usize, open: f64| expected["value"][i].as_f64().unwrap_or(open);
        for number in list("calibration") {
            let value = number["value"].as_f64().unwrap();
            if number["key"] != key || value < range(0, f64::MIN) || value > range(1, f64::MAX) {
                wrong.push(format!("{} = {value} is set", number["key"]));
            }
        }
    }

    let gain = |observable: &str| list("gains").into_iter().find(|gain| gain["observable"] == observable);
    if let Some(observable) = expected["explains"].as_str() {
        let errors =
            gain(observable).map(|g| [&g["rmse_before"], &g["rmse_after"]].map(|e| e.as_f64().unwrap()));
        if !errors.is_some_and(|[before, after]| after < 0.8 * before) {
            wrong.push(format!("{observable} is not explained"));
        }
    }
    if let Some(range) = expected["rmse_after"].as_array() {
        let [low, high] = [0, 1].map(|end: usize| range[end].as_f64().unwrap());
        match gain("e_n").and_then(|gain| gain["rmse_after"].as_f64()) {
            Some(after) if (low..=high).contains(&after) => {}
            Some(after) => wrong.push(format!("the claimed error of e_n is {after}")),
            None => wrong.push("no gain in e_n is claimed".to_owned()),
        }
    }
    wrong
}

/// The diagnosis of a set.
fn diagnose(set: &str) -> Value {
    let scratch = tempfile::tempdir().unwrap();
    let out = std::env::var_os("NEARWALL_REAL_OUT")
        .map_or(scratch.path().to_owned(), |all| Path::new(&all).join(set));
    let run = Command::new(env!("CARGO_BIN_EXE_nearwall"))
        .args(["diagnose", "data.csv", "--model", "base.toml", "--columns", "columns.toml", "--out"])
        .arg(&out)
        .current_dir(folder(set))
        .output()
        .unwrap();
    if run.status.success() {
        return json(&out.join("diagnosis.json"));
    }
    assert_eq!(run.status.code(), Some(1), "{set}: {}", String::from_utf8_lossy(&run.stderr));
    let refusal = String::from_utf8_lossy(&run.stderr);
    let last = refusal.lines().rfind(|line| !line.trim().is_empty()).unwrap_or_default();
    serde_json::json!({ "verdict": format!("Refused: {}", last.rsplit(": ").next().unwrap().trim()) })
}

/// What is said of a set, and how it differs from what was expected.
struct Outcome {
    verdict: String,
    differences: Vec<String>,
}

/// All sets in the order of their names, each diagnosed once.
fn outcomes() -> &'static BTreeMap<String, Outcome> {
    static ALL: OnceLock<BTreeMap<String, Outcome>> = OnceLock::new();
    ALL.get_or_init(|| {
        let entries = std::fs::read_dir(folder("")).unwrap().map(|entry| entry.unwrap().path());
        let names = entries.filter(|path| path.is_dir()).map(|path| path.file_name().unwrap().to_owned());
        let one = |name: String| {
            let said = diagnose(&name);
            let differences = differences(&said, &json(&folder(&name).join("expected.json")));
            let verdict = said["verdict"].as_str().unwrap().to_owned();
            (name, Outcome { verdict, differences })
        };
        names.map(|name| one(name.into_string().unwrap())).collect()
    })
}

/// Asserts that what is said of the set is what was expected.
fn check(set: &str) {
    let Outcome { verdict, differences } = &outcomes()[set];
    assert!(differences.is_empty(), "{set}: {}.\nSaid: {verdict}", differences.join("; "));
}

const BEGIN: &str = "<!-- verdicts: written by the test -->\n";
const END: &str = "<!-- end of verdicts -->";

/// `docs/why/real-measurements.md` has the verdicts of today; `NEARWALL_BLESS=1` writes them.
#[test]
fn the_page_has_the_verdicts() {
    let (mut expected, mut table) = (Vec::new(), "| set | said | differs |\n|---|---|---|\n".to_owned());
    for (name, Outcome { verdict, differences }) in outcomes() {
        match differences.as_slice() {
            [] => expected.push(format!("`{name}`")),
            some => writeln!(table, "| `{name}` | {verdict} | {} |", some.join("; ")).unwrap(),
        }
    }
    let (sets, names) = (outcomes().len(), expected.join(",\n"));
    let table = format!("{} of {sets} sets are diagnosed as expected:\n{names}.\n\n{table}", expected.len());
    let page = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/..")).join("docs/why/real-measurements.md");
    let text = std::fs::read_to_string(&page).unwrap();
    let (head, rest) = text.split_once(BEGIN).unwrap();
    let (old, tail) = rest.split_once(END).unwrap();
    if std::env::var_os("NEARWALL_BLESS").is_some() {
        std::fs::write(&page, format!("{head}{BEGIN}{table}{END}{tail}")).unwrap();
    } else {
        assert_eq!(old, table, "NEARWALL_BLESS=1 cargo test --test command real_measurements writes it");
    }
}

macro_rules! sets {
    ($($(#[$attribute:meta])* $name:ident: $folder:literal),* $(,)?) => {
        $(#[test] $(#[$attribute])* fn $name() { check($folder); })*

        /// A folder without a test would be checked by nobody.
        #[test]
        fn every_folder_has_a_test() {
            assert_eq!(outcomes().keys().collect::<Vec<_>>(), [$($folder),*]);
        }
    };
}

sets! {
    beads_on_bead_packing: "beads-on-bead-packing",
    golf_ball_averages: "golf-ball-averages",
    golf_ball_bounces: "golf-ball-bounces",
    ping_pong_bounces: "ping-pong-bounces",
    rubber_ball_bounces: "rubber-ball-bounces",
    rubber_ball_heights: "rubber-ball-heights",
    #[should_panic(expected = "e_n is not explained")] // not reached yet: docs/why/real-measurements.md says why
    sand_on_sand_bed: "sand-on-sand-bed",
    squash_ball_temperature: "squash-ball-temperature",
    tennis_ball_bounces: "tennis-ball-bounces",
    tennis_ball_two_methods: "tennis-ball-two-methods",
}
