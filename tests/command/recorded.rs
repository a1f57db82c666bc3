//! `nearwall diagnose MEASURED.csv --impacts`: deposits of a rig, and impacts as
//! nearWallInteraction records them, written by a small computation of particles that bounce along
//! a floor.

use std::fmt::Write as _;
use std::path::Path;

use crate::runner::{done, refused};
use nearwall::ImpactRng;
use serde_json::Value;

const HEADER: &str = "time,x,y,z,origProcId,origId,parcel_age,n_particles,v_n,v_t,d,T_p,patch,wall,injector,mass,regime,outcome,e_n,e_t";
const BASE: &str = "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n[normal]\n\
    model = \"constant\"\ne_n = 0.5\n[tangential]\nmodel = \"constant\"\ne_t = 0.8\n";
const TEMPERATURES: [u32; 8] = [310, 320, 330, 340, 350, 360, 370, 380];
const BOUNCES: u64 = 3;

/// What is planted: the share of the particles of a temperature [K] that stick at each impact.
fn sticky(temperature: f64) -> f64 {
    1.0 / (1.0 + ((348.0 - temperature) / 8.0).exp())
}

fn never(_: f64) -> f64 {
    0.0
}

/// The temperature of a particle [K] of a batch, and at which of its impacts it sticks.
fn particle(batch: u64, number: u64, mean: u32, capture: fn(f64) -> f64) -> (f64, Option<u64>) {
    let draw = ImpactRng::new(batch, number);
    let temperature = f64::from(mean) - 3.0 + 6.0 * draw.uniform(100);
    (temperature, (0..BOUNCES).find(|bounce| draw.uniform(200 + bounce) < capture(temperature)))
}

/// Writes the case of an experiment: a record with its tables.
fn record(case: &Path, mean: u32, capture: fn(f64) -> f64) {
    const PARCELS: u64 = 400;
    let (mut rows, mut hits, mut sticks) = (String::new(), 0, 0);
    for parcel in 0..PARCELS {
        let (temperature, caught) = particle(u64::from(mean), parcel, mean, capture);
        let (mut v_n, mut v_t, mut age) = (2.0, 1.0, 0.01);
        let start = ImpactRng::new(9, parcel);
        let (mut x, y) = (0.1 * start.uniform(0), 0.1 * start.uniform(1));
        for bounce in 0..BOUNCES {
            let stuck = caught == Some(bounce);
            let outcome = if stuck { "stick,," } else { "rebound,0.5,0.8" };
            writeln!(
                rows,
                "{age},{x},{y},0,0,{parcel},{age},1,{v_n},{v_t},1e-4,{temperature},floor,default,jet,1e-9,SP-NSW,{outcome}"
            )
            .unwrap();
            hits += 1;
            if stuck {
                sticks += 1;
                break;
            }
            (v_n, v_t) = (0.5 * v_n, 0.8 * v_t);
            let flight = 2.0 * v_n / 9.81;
            (age, x) = (age + flight, x + v_t * flight);
        }
    }
    let tables = case.join("postProcessing/nearWallInteraction/kinematicCloud/0");
    std::fs::create_dir_all(&tables).unwrap();
    let write = |name: &str, text: String| std::fs::write(tables.join(name), text).unwrap();
    write("impacts.csv", format!("# recorded impacts: all\n{HEADER}\n{rows}"));
    let rebounds = hits - sticks;
    write("floor.dat", format!("# time_s hits rebounds sticks e_n_sum\n9 {hits} {rebounds} {sticks} 1\n"));
    let injected = PARCELS as f64 * 1e-9;
    write(
        "balance.dat",
        format!("# time_s injected_kg injected_parcels residual\n9 {injected:e} {PARCELS} 0\n"),
    );
}

/// A folder with `base.toml`, the recorded cases below `runs`, which capture so, and `measured.csv`
/// of a laboratory that captures so.
fn rig(model: &str, base: fn(f64) -> f64, laboratory: fn(f64) -> f64) -> tempfile::TempDir {
    const WEIGHED: u64 = 300;
    let mut data = "experiment,captured@floor,captured@floor_n\n".to_owned();
    let folder = crate::runner::folder(&[("base.toml", model)]);
    for mean in TEMPERATURES {
        record(&folder.path().join(format!("runs/T{mean}")), mean, base);
        let caught = |number: &u64| particle(1000 + u64::from(mean), *number, mean, laboratory).1.is_some();
        let share = (0..WEIGHED).filter(caught).count() as f64 / WEIGHED as f64;
        writeln!(data, "T{mean},{share},{WEIGHED}").unwrap();
    }
    std::fs::write(folder.path().join("measured.csv"), data).unwrap();
    folder
}

const DIAGNOSE: [&str; 8] =
    ["diagnose", "measured.csv", "--impacts", "runs", "--model", "base.toml", "--out", "out"];

fn diagnosis(folder: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(folder.join("out/diagnosis.json")).unwrap()).unwrap()
}

#[test]
fn a_planted_cause_is_named_and_its_model_predicts() {
    let folder = rig(BASE, never, sticky);
    let printed = done(folder.path(), &DIAGNOSE);
    let found = diagnosis(folder.path());
    assert_eq!(found["findings"][0]["cause"], "melting-transition", "{printed}");
    assert_eq!(found["findings"].as_array().unwrap().len(), 1, "{printed}");
    assert!(folder.path().join("out/report.html").is_file());
    assert!(!folder.path().join("out/next_experiments.csv").exists());

    std::fs::write(
        folder.path().join("fresh.csv"),
        "v_n,v_t,d,T_p\n2,1,1e-4,320\n2,1,1e-4,340\n2,1,1e-4,348\n2,1,1e-4,356\n2,1,1e-4,376\n",
    )
    .unwrap();
    let table = done(folder.path(), &["predict", "--model", "out/extended.toml", "fresh.csv"]);
    let mut table = csv::Reader::from_reader(table.as_bytes());
    let header = table.headers().unwrap().clone();
    let place = |name: &str| header.iter().position(|column| column == name).unwrap();
    let (temperature, sticking) = (place("T_p"), place("p_stick"));
    for row in table.records().map(Result::unwrap) {
        let expected = sticky(row[temperature].parse().unwrap());
        let own: f64 = row[sticking].parse().unwrap();
        assert!((own - expected).abs() < 0.06, "{own} {expected}");
    }
}

/// The law of the laboratory is that of the run.
#[test]
fn nothing_is_named_where_nothing_is_hidden() {
    let model = BASE.to_owned()
        + "[[effects]]\nkind = \"melting-transition\"\ntemperature = 348\nwidth = 8\nsoftening = 0\n";
    let folder = rig(&model, sticky, sticky);
    let printed = done(folder.path(), &DIAGNOSE);
    assert_eq!(diagnosis(folder.path())["findings"], Value::Array(Vec::new()), "{printed}");
    assert!(printed.contains("agree with the base model"), "{printed}");
}

#[test]
fn an_unknown_patch_and_an_old_record_name_file_and_remedy() {
    let folder = rig(BASE, never, sticky);
    let measured = folder.path().join("measured.csv");
    let good = std::fs::read_to_string(&measured).unwrap();
    std::fs::write(&measured, good.replace("@floor", "@lid")).unwrap();
    let file = "runs/T310/postProcessing/nearWallInteraction/kinematicCloud/0/impacts.csv";
    let parts = ["measured.csv:2: experiment `T310`: `captured@lid`", file, "only on floor", "`record`"];
    refused(folder.path(), &DIAGNOSE, &parts);
    assert!(!folder.path().join("out").exists());

    std::fs::write(&measured, good).unwrap();
    let record = std::fs::read_to_string(folder.path().join(file)).unwrap();
    let mut old = String::new();
    for line in record.lines() {
        let cells: Vec<&str> = line.split(',').collect();
        // Without origProcId, origId, parcel_age and n_particles.
        let kept = if cells.len() > 8 { [&cells[..4], &cells[8..]].concat() } else { cells };
        writeln!(old, "{}", kept.join(",")).unwrap();
    }
    std::fs::write(folder.path().join(file), old).unwrap();
    let parts = ["impacts.csv:2: ", "no column origProcId", "run the case again"];
    refused(folder.path(), &DIAGNOSE, &parts);
}
