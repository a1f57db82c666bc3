//! `nearwall map`: values at corners by hand, regimes and captured shares of a patchwork, blanks, faults.

use std::collections::BTreeMap;
use std::path::Path;

use crate::common::browser::browse;
use crate::runner::{WAX, done, folder, nearwall, refused};

/// A hard particle on a rigid wall: elastic, with a work of adhesion of 0.1 J/m².
const ELASTIC: &str = "[particle]\nmaterial = \"own\"\n[walls.default]\nmaterial = \"rigid\"\n\
    [normal]\nmodel = \"thornton-ning\"\nyield_ratio = 1\nwork_of_adhesion = 0.1\n\
    [tangential]\nmodel = \"constant\"\ne_t = 0.7\n\
    [materials.own]\ndensity = 2000\nyoungs_modulus = 1e9\npoisson_ratio = 0\nyield_strength = 1e12\nsurface_energy = 0.05\n\
    [materials.rigid]\ndensity = 8000\nyoungs_modulus = 1e13\npoisson_ratio = 0\nyield_strength = 1e12\n\
    surface_energy = 0.05\n";

/// Char that burns out on a wall with liquid slag, part of which char covers.
const PATCHWORK: &str = "[particle]\nmaterial = \"own\"\n[walls.slagged]\nmaterial = \"own\"\nslag = \"melt\"\n\
    coverage = 0.4\n[walls.dry]\nmaterial = \"own\"\n\
    [normal]\nmodel = \"constant\"\ne_n = 0.5\n[tangential]\nmodel = \"constant\"\ne_t = 0.7\n\
    [capture]\nmodel = \"viscosity\"\nreference_viscosity = 25\nlaw = \"kalmanovitch-frank\"\n\
    [[effects]]\nkind = \"conversion-transition\"\nthreshold = 0.9\nwidth = 0.001\nvalid = { v_n = [1, 10] }\n\
    [materials.own]\ndensity = 2000\nyoungs_modulus = { T = [290, 2000], value = [1e9, 1e9] }\npoisson_ratio = 0.3\n\
    yield_strength = 1e8\nsurface_energy = 0.05\n\
    [materials.melt]\ndensity = 2500\nyoungs_modulus = 1e9\npoisson_ratio = 0.3\nyield_strength = 1e8\n\
    surface_energy = 0.3\nviscosity = 25\n";

/// The rows of the table by their two inputs, without them.
fn table(folder: &Path) -> (String, BTreeMap<[String; 2], Vec<String>>) {
    let text = std::fs::read_to_string(folder.join("map/map.csv")).unwrap();
    let mut lines = text.lines();
    let header = lines.next().unwrap().to_owned();
    let row = |line: &str| {
        let cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        ([cells[0].clone(), cells[1].clone()], cells[2..].to_vec())
    };
    (header, lines.map(row).collect())
}

fn key(x: &str, y: &str) -> [String; 2] {
    [x.to_owned(), y.to_owned()]
}

#[test]
fn corners_agree_with_elastic_adhesion_by_hand() {
    let folder = folder(&[("m.toml", ELASTIC)]);
    let at = folder.path();
    let printed = done(at, &["map", "m.toml", "--x", "v_n=0.01:10:4", "--y", "d=1e-6:1e-4:3"]);
    assert!(printed.contains("12 impacts") && printed.contains("map.html"), "{printed}");
    let (header, rows) = table(at);
    assert_eq!(header, "v_n,d,e_n,e_t,p_stick,regime,outside_range,matters");
    assert_eq!(rows.len(), 12);
    // JKR: v_s = (sqrt3/2) pi^(1/3) sqrt((1 + 6 2^(2/3))/5) (W^5 / (rho^3 E*^2 R^5))^(1/6)
    let reduced: f64 = 1.0 / (1e-9 + 1e-13);
    let factor = 3f64.sqrt() / 2.0 * std::f64::consts::PI.cbrt() * ((1.0 + 6.0 * 4f64.cbrt()) / 5.0).sqrt();
    let sticking = |d: f64| {
        factor * (0.1_f64.powi(5) / (2000_f64.powi(3) * reduced.powi(2) * (d / 2.0).powi(5))).powf(1.0 / 6.0)
    };
    for (speed, size) in [("0.01", "0.000001"), ("10", "0.000001"), ("0.01", "0.0001"), ("10", "0.0001")] {
        let cells = &rows[&key(speed, size)];
        let (v, limit) = (speed.parse::<f64>().unwrap(), sticking(size.parse().unwrap()));
        if v <= limit {
            assert_eq!(cells[..4], ["", "", "1.0000000000000000e0", "NSP-NSW"], "at {speed} m/s, {size} m");
            continue;
        }
        let numbers: Vec<f64> = cells[..3].iter().map(|cell| cell.parse().unwrap()).collect();
        let expected = (1.0 - (limit / v).powi(2)).sqrt();
        assert!((numbers[0] - expected).abs() < 1e-9, "{numbers:?}, expected {expected}");
        assert_eq!(numbers[1..], [0.7, 0.0]);
    }
    let stuck = rows.values().filter(|cells| cells[0].is_empty()).count();
    assert!((1..12).contains(&stuck), "both outcomes belong on the map");
}

#[test]
fn a_patchwork_has_its_regimes_and_the_capture_of_both_shares() {
    let folder = folder(&[("m.toml", PATCHWORK)]);
    let at = folder.path();
    let map = ["map", "m.toml", "--wall", "slagged", "--x", "coverage=0:1:3", "--y", "conversion=0:1:2"];
    let slagged = [&map[..], &["--set", "v_n=2", "--set", "T_p=1700", "--set", "T_w=1700"]].concat();
    done(at, &slagged);
    let (_, rows) = table(at);
    let row = |x: &str, y: &str| {
        let cells = &rows[&key(x, y)];
        (cells[2].parse::<f64>().unwrap(), cells[3].clone())
    };
    let near = |(p, regime): (f64, String), expected: f64, name: &str| {
        assert!((p - expected).abs() < 1e-12 && regime == name, "{p} {regime}, expected {expected} {name}");
    };
    // Slag of 25 Pa s holds everything, its covered share nothing. The file puts 0.4 on the wall, so 0 means 0.4.
    near(row("0", "0"), 0.6, "NSP-SW");
    near(row("0.5", "0"), 0.5, "NSP-NSW");
    near(row("1", "0"), 0.0, "NSP-NSW");
    near(row("0", "1"), 1.0, "SP-SW");
    near(row("1", "1"), 1.0, "SP-NSW");
    assert_eq!(rows[&key("1", "0")][0].parse::<f64>().unwrap(), 0.5);
    assert!(rows.values().all(|cells| cells[4] == "false"), "2 m/s is within the fitted range");
    let html = std::fs::read_to_string(at.join("map/map.html")).unwrap();
    for name in ["NSP-SW", "NSP-NSW", "SP-SW", "SP-NSW"] {
        assert!(html.contains(name), "{name}");
    }
}

#[test]
fn marks_blanks_and_ranges_are_on_the_page() {
    let folder = folder(&[("m.toml", PATCHWORK)]);
    let at = folder.path();
    let map = ["map", "m.toml", "--wall", "dry", "--x", "v_n=0.5:20", "--y", "T_p=200:1000:9", "-o", "map"];
    let printed = done(at, &map);
    // 200 K of 200, 300, ... is below the table of the modulus.
    assert!(printed.contains("61 of 549 could not be decided"), "{printed}");
    assert!(printed.contains("youngs_modulus is given for 290 to 2000 K, asked for 200 K"), "{printed}");
    let (_, rows) = table(at);
    assert_eq!(rows[&key("0.5", "200")], ["", "", "", "", "", ""]);
    assert_eq!(rows[&key("0.5", "300")][4], "true");
    assert_eq!(rows[&key("20", "300")][4], "true");
    let page = at.join("map/map.html");
    let html = std::fs::read_to_string(&page).unwrap();
    for part in
        ["61 of 549 impacts could not be decided", "not decided", "outside a stated range", "logarithmic"]
    {
        assert!(html.contains(part), "`{part}` is not on the page");
    }
    assert!(!html.contains("NaN") && !html.replace("http://www.w3.org/", "").contains("http://"));
    if let Some(seen) = browse(&page) {
        assert!(seen.complaints.is_empty(), "{:?}", seen.complaints);
        assert_eq!((seen.dom.matches("<figure").count(), seen.dom.matches("<svg").count()), (4, 4));
        for svg in seen.dom.split("<svg").skip(1) {
            assert!(
                svg.contains("<text") && svg.contains("[m/s]") && svg.contains("[K]"),
                "an axis without unit"
            );
        }
    }
}

/// Each part of a map over three inputs is the map of two with the third one set.
#[test]
fn a_slider_has_the_map_of_each_value() {
    let folder = folder(&[("m.toml", ELASTIC)]);
    let at = folder.path();
    let axes = ["map", "m.toml", "--x", "v_n=0.01:10:4", "--y", "v_t=0:1:3"];
    let printed = done(at, &[&axes[..], &["--slider", "d=1e-6:1e-4:3", "-o", "all"]].concat());
    assert!(printed.contains("36 impacts on the wall default: v_n x v_t x d"), "{printed}");
    let all = std::fs::read_to_string(at.join("all/map.csv")).unwrap();
    assert!(all.starts_with("v_n,v_t,d,e_n,"), "{all}");
    let html = std::fs::read_to_string(at.join("all/map.html")).unwrap();
    assert!(html.contains("Particle diameter, d = 10 µm"), "the values stand over their figures");
    assert_eq!(html.matches("<figure ").count(), 12);
    for (place, size) in ["1e-6", "1e-5", "1e-4"].into_iter().enumerate() {
        done(at, &[&axes[..], &["--set", &format!("d={size}")]].concat());
        let (_, rows) = table(at);
        for line in all.lines().skip(1 + 12 * place).take(12) {
            let cells: Vec<&str> = line.split(',').collect();
            let own = &rows[&key(cells[0], cells[1])];
            // The middle of a logarithmic axis is 1e-5 but for the last digit.
            let near = |a: &str, b: &str| match (a.parse::<f64>(), b.parse::<f64>()) {
                (Ok(a), Ok(b)) => (a - b).abs() < 1e-12,
                _ => a == b,
            };
            assert!(cells[3..].iter().zip(own).all(|(a, b)| near(a, b)), "{line} and {own:?}");
        }
    }
    refused(at, &[&axes[..], &["--slider", "v_t=0:1"]].concat(), &["--slider v_t", "along an axis"]);
    refused(at, &["map", "m.toml", "--slider", "d=1e-6:1e-4", "--set", "d=1"], &["--set d", "along an axis"]);
}

#[test]
fn random_effects_are_averaged() {
    let part = "[[effects]]\nkind = \"agglomerates\"\nfraction = 0.25\nrestitution = 0.1\nspread = 0\n";
    let constant =
        WAX.replace("model = \"thornton-ning\"\nyield_ratio = 0.7", "model = \"constant\"\ne_n = 0.5");
    let folder = folder(&[("m.toml", &(constant + part))]);
    done(folder.path(), &["map", "m.toml", "--x", "v_n=1:2:2", "--y", "d=1e-5:1e-4:2"]);
    for cells in table(folder.path()).1.values() {
        let e_n: f64 = cells[0].parse().unwrap();
        assert!((e_n - (0.75 * 0.5 + 0.25 * 0.1)).abs() < 0.005, "{e_n}");
    }
}

#[test]
fn default_axes_are_inputs_that_matter() {
    let folder = folder(&[("m.toml", WAX), ("p.toml", PATCHWORK)]);
    let header = |arguments: &[&str]| {
        done(folder.path(), arguments);
        table(folder.path()).0.split(",e_n").next().unwrap().to_owned()
    };
    // Wax on glass knows no temperature; the stickiness of the char depends on conversion alone.
    assert_eq!(header(&["map", "m.toml"]), "v_n,d");
    assert_eq!(header(&["map", "p.toml", "--wall", "dry"]), "v_n,conversion");
    assert_eq!(header(&["map", "m.toml", "--y", "v_n=1:2"]), "d,v_n");
}

#[test]
fn wrong_usage_is_exit_2_and_a_fault_of_the_input_exit_1() {
    let folder = folder(&[("m.toml", WAX), ("p.toml", PATCHWORK)]);
    let at = folder.path();
    for (axis, part) in
        [("coverge=0:1", "did you mean `coverage`"), ("v_n=2:1", "not below"), ("v_n", "INPUT=LOW:HIGH")]
    {
        let output = nearwall(at, &["map", "m.toml", "--x", axis]);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(part), "{message}");
    }
    assert_eq!(nearwall(at, &["map"]).status.code(), Some(2));
    assert_eq!(nearwall(at, &["map", "m.toml", "--set", "T_p=-3"]).status.code(), Some(2));
    refused(at, &["map", "absent.toml"], &["absent.toml"]);
    refused(
        at,
        &["map", "m.toml", "--x", "d=1e-6:1e-3", "--y", "d=1e-6:1e-3"],
        &["--y d", "already along x"],
    );
    refused(at, &["map", "m.toml", "--x", "v_n=1:2", "--set", "v_n=1"], &["--set v_n", "along an axis"]);
    refused(at, &["map", "m.toml", "--set", "T_p=300", "--set", "T_p=400"], &["--set T_p", "twice"]);
    refused(at, &["map", "p.toml"], &["--wall", "slagged", "dry"]);
    refused(at, &["map", "m.toml", "--wall", "roof"], &["roof", "default"]);
    let cold = ["map", "p.toml", "--wall", "dry", "--x", "v_n=1:2", "--y", "v_t=0:1", "--set", "T_p=100"];
    refused(at, &cold, &["p.toml", "no impact of this map", "asked for 100 K"]);
    assert!(!at.join("map").exists(), "a refused map leaves nothing behind");
}
