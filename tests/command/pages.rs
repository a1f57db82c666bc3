//! The pages in a real browser: nothing loaded from elsewhere, no complaint on the console, every figure there.

use std::path::Path;

use crate::common::browser::{Seen, browse};
use crate::runner::{done, refused};

/// Asserts that the page stands alone and shows at least `figures` pictures, each with a heading and axes.
fn looks_right(page: &Path, figures: usize) {
    let html = std::fs::read_to_string(page).unwrap();
    let namespaces = html.replace("http://www.w3.org/", "");
    for elsewhere in ["http://", "https://", "src=", "url(//", "@import"] {
        assert!(!namespaces.contains(elsewhere), "{} asks for {elsewhere}", page.display());
    }
    assert!(!html.contains("NaN"), "{} shows a number that is none", page.display());
    let Some(Seen { dom, complaints }) = browse(page) else { return };
    assert!(complaints.is_empty(), "{complaints:?}");
    let found = dom.matches("<svg").count();
    assert!(found >= figures, "{}: {found} figures, {figures} expected", page.display());
    assert_eq!(dom.matches("<figure").count(), found, "a figure without its picture, or the other way round");
    for svg in dom.split("<svg").skip(1) {
        let svg = svg.split("</svg>").next().unwrap();
        assert!(svg.contains("<text") && svg.contains("["), "an axis without its unit");
    }
}

/// An example with fewer particles, in a folder of its own.
fn simulated(name: &str, count: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let examples = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/..")).join("tutorials/standalone");
    let case = std::fs::read_to_string(examples.join(format!("{name}.toml"))).unwrap();
    let line = case.lines().find(|line| line.starts_with("count = ")).unwrap();
    std::fs::write(folder.path().join("case.toml"), case.replace(line, &format!("count = {count}"))).unwrap();
    let model = format!("{name}.model.toml");
    std::fs::copy(examples.join(&model), folder.path().join(&model)).unwrap();
    let path = |file: &str| folder.path().join(file).to_str().unwrap().to_owned();
    done(Path::new("."), &["simulate", &path("case.toml"), "-o", &path("out")]);
    folder
}

/// Silence on the console means something only if a complaint would be heard.
#[test]
fn a_complaint_on_the_console_is_heard() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.html");
    std::fs::write(&page, "<html><body><script>console.error('planted')</script></body></html>").unwrap();
    if let Some(seen) = browse(&page) {
        assert!(seen.complaints.iter().any(|line| line.contains("planted")), "{:?}", seen.complaints);
    }
}

#[test]
fn pages_of_the_standalone_examples() {
    for (name, count, figures) in [("waxRig", "100", 3), ("tungstenDust", "100", 5), ("gasifier", "50", 3)] {
        looks_right(&simulated(name, count).path().join("out/report.html"), figures);
    }
}

/// Cold solid tungsten on cold solid walls: neither is ever sticky, and nothing burns.
#[test]
fn a_page_names_only_what_occurs() {
    let page =
        |name, count| std::fs::read_to_string(simulated(name, count).path().join("out/report.html")).unwrap();
    let [dust, coal] = [page("tungstenDust", "50"), page("gasifier", "300")];
    let entry = |name: &str| format!(">{name}</text>");
    assert!(dust.contains(&entry("NSP-NSW")));
    for regime in ["NSP-SW", "SP-NSW", "SP-SW"] {
        assert!(!dust.contains(&entry(regime)), "{regime}");
    }
    assert!(coal.contains(&entry("NSP-SW")));
    for of_coal in ["conversion at capture", "law of carbon conversion", "the carbon in the powder burns"] {
        assert!(coal.contains(of_coal), "{of_coal}");
    }
    assert!(!dust.contains("carbon") && !dust.contains("conversion"));
}

#[test]
fn page_of_a_table_of_runs() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("runs.csv");
    let text = "run,T_C,capture,capture_low95,capture_high95,capture_paper,e_n,e_n_standard_error,e_n_paper\n\
                a,20,0.001,0,0.002,0,0.28,0.001,0.28\nb,120,0.99,0.98,0.995,>0.85,0,0,-\n";
    std::fs::write(&table, text).unwrap();
    let page = folder.path().join("page.html");
    done(Path::new("."), &["report", table.to_str().unwrap(), "-o", page.to_str().unwrap()]);
    looks_right(&page, 2);
}

/// Six experiments on two walls, whose rebounds are weaker than the base model says.
#[test]
fn page_of_a_rig() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write(
        "base.toml",
        "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n\
         [normal]\nmodel = \"constant\"\ne_n = 0.5\n[tangential]\nmodel = \"constant\"\ne_t = 0.8\n",
    );
    let wall = |name: &str, z: f64, normal: i32| {
        format!(
            "[[walls]]\nname = \"{name}\"\nwall = \"default\"\nshape = \"plane\"\npoint = [0, 0, {z}]\nnormal = [0, 0, {normal}]\n\
             radius = 10\ntemperature = 295\n"
        )
    };
    let case = "model = \"base.toml\"\n[run]\nseed = 1\ntime_limit = 0.06\ngravity = [0, 0, 0]\n\
                [gas]\nfield = \"uniform\"\nvelocity = [0, 0, 0]\ntemperature = 300\ndensity = 1e-9\nviscosity = 1e-15\n\
                conductivity = 1e-9\nheat_capacity = 1000\n\
                [particles]\ncount = 50\nposition = { shape = \"point\", at = [0, 0, 0.01] }\ndirection = [0, 0, -1]\n\
                diameter = 8e-5\nspeed = 3\nangle_deg = 70\ntemperature = 300\n";
    let walls = [wall("target", 0.0, 1), wall("lid", 0.02, -1)].concat();
    write("case.toml", &format!("{case}{walls}"));
    let mut data =
        "experiment,particles.speed,mean_e_n@target,mean_e_n@target_err,mean_e_t@lid,mean_e_t@lid_err\n"
            .to_owned();
    for run in 1..=6 {
        let off = if run % 2 == 0 { 0.01 } else { -0.01 };
        data += &format!("run {run},{run},{},0.01,{},0.01\n", 0.4 + off, 0.8 - off);
    }
    write("rig.csv", &data);
    let path = |file: &str| folder.path().join(file).to_str().unwrap().to_owned();
    let [data, case, out] = ["rig.csv", "case.toml", "out"].map(path);
    let arguments = ["diagnose", &data, "--case", &case, "--draws", "2", "--out", &out, "--reach"];
    refused(Path::new("."), &[&arguments[..], &["v_n=8:20"]].concat(), &["`v_n`", "as particles.speed"]);
    done(Path::new("."), &[&arguments[..], &["particles.speed=8:20"]].concat());
    // What to measure next lies where the laboratory says that it can measure.
    let next = std::fs::read_to_string(folder.path().join("out/next_experiments.csv")).unwrap();
    let speeds: Vec<f64> =
        next.lines().skip(1).map(|line| line.split(',').nth(1).unwrap().parse().unwrap()).collect();
    assert!(!speeds.is_empty() && speeds.iter().all(|speed| (8.0..=20.0).contains(speed)), "{next}");
    let page = folder.path().join("out/report.html");
    looks_right(&page, 4);
    let html = std::fs::read_to_string(&page).unwrap();
    assert!(
        html.contains("Mean e_n, wall target, over particles.speed") && html.contains("normal.e_n"),
        "{html}"
    );
}
