//! The command as a user types it: results, exit codes, and messages that name the place and the remedy.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::common::golden::{Golden, golden_cases};
use crate::runner::{WAX, done, folder, nearwall, refused};
use nearwall::{Impact, ImpactRng, Model};

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

#[test]
fn predict_agrees_with_the_golden_table() {
    let cases = golden_cases();
    let worker = |chunk: &[Golden]| {
        let folder = tempfile::tempdir().unwrap();
        for case in chunk {
            std::fs::write(folder.path().join("m.toml"), case.model()).unwrap();
            let impact = format!("d,v_n\n{:e},{:e}\n", case.d, case.v_n);
            std::fs::write(folder.path().join("i.csv"), impact).unwrap();
            let output = nearwall(folder.path(), &["predict", "--model", "m.toml", "i.csv"]);
            assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
            let table = text(&output.stdout);
            let row: Vec<&str> = table.lines().nth(1).unwrap().split(',').collect();
            let e_n: f64 = row[2].parse().unwrap();
            let model = Model::from_toml("m.toml", &case.model()).unwrap();
            let impact = Impact { normal_speed: case.v_n, diameter: case.d, ..Impact::default() };
            let outcome = model.resolve(0, &impact, ImpactRng::default()).unwrap();
            assert_eq!(e_n.to_bits(), outcome.normal_restitution.to_bits(), "{} has other bits", row[2]);
            assert!((e_n - case.e_n).abs() <= (1e-11 * case.e_n).max(1e-9), "{e_n} against {case:?}");
        }
    };
    std::thread::scope(|scope| {
        for chunk in cases.chunks(200) {
            scope.spawn(move || worker(chunk));
        }
    });
}

/// The printed block is a material of a model file, with the same numbers.
#[test]
fn a_built_in_material_is_printed_as_a_block_to_paste() {
    let folder = folder(&[("i.csv", "v_n,d\n1,75e-6\n")]);
    let block = done(folder.path(), &["materials", "pyrex", "--toml"]);
    assert!(block.starts_with("[materials.pyrex]\nabout = "), "{block}");
    let own = format!(
        "{}{}",
        WAX.replace("\"pyrex\"", "\"own\""),
        block.replace("[materials.pyrex]", "[materials.own]")
    );
    for (name, model) in [("plain.toml", WAX), ("own.toml", own.as_str())] {
        std::fs::write(folder.path().join(name), model).unwrap();
    }
    let predicted =
        ["plain.toml", "own.toml"].map(|model| done(folder.path(), &["predict", "--model", model, "i.csv"]));
    assert_eq!(predicted[0], predicted[1]);
}

/// An ash of a model file has its viscosity by every law: that of Kalmanovitch and Frank is 15.12 Pa s at 1700 K by hand.
#[test]
fn an_ash_of_a_model_file_shows_its_melt() {
    let ash = "[materials.my-ash]\nlike = \"coal-slag\"\n\
               composition = { SiO2 = 50, Al2O3 = 25, CaO = 15, FeO = 10 }\n";
    let folder =
        folder(&[("m.toml", &format!("{WAX}{ash}")), ("bad.toml", "[materials.my-ash]\ndensty = 1\n")]);
    let shown = done(folder.path(), &["materials", "my-ash", "--model", "m.toml"]);
    let head: Vec<&str> = line_of(&shown, "T [K]").split_whitespace().skip(2).collect();
    let cells: Vec<&str> = line_of(&shown, " 1700 ").split_whitespace().skip(1).collect();
    let place = head.iter().position(|law| *law == "kalmanovitch-frank").unwrap();
    assert_eq!(cells[place], "15.1", "{shown}");
    assert!(done(folder.path(), &["materials", "--model", "m.toml"]).contains("\nmy-ash "), "{shown}");
    refused(folder.path(), &["materials", "--model", "bad.toml"], &["bad.toml:2", "densty", "density"]);
    refused(folder.path(), &["materials", "my-ash"], &["unknown material `my-ash`"]);
}

/// The first line with a text.
fn line_of<'a>(text: &'a str, with: &str) -> &'a str {
    text.lines().find(|line| line.contains(with)).unwrap_or_default()
}

/// Elastic wax of 75 µm would touch for microseconds; soft and plastic it touches longer, by the model's own time.
#[test]
fn predict_adds_the_time_of_contact_when_asked() {
    let folder = folder(&[("m.toml", WAX), ("i.csv", "v_n,d\n1,75e-6\n2,75e-6\n")]);
    let table = done(folder.path(), &["predict", "--model", "m.toml", "i.csv", "--contact-time"]);
    let lines: Vec<&str> = table.lines().collect();
    assert!(lines[0].ends_with(",regime,contact_time,beyond"), "{table}");
    let model = Model::from_toml("m.toml", WAX).unwrap();
    for (line, normal_speed) in [(lines[1], 1.0), (lines[2], 2.0)] {
        let time: f64 = line.split(',').nth(6).unwrap().parse().unwrap();
        let impact = Impact { normal_speed, diameter: 75e-6, ..Impact::default() };
        assert_eq!(time, model.contact_time(0, &impact).unwrap());
        assert!((1e-7..1e-5).contains(&time), "{time:e}");
    }
}

#[test]
fn predict_keeps_other_columns_and_lists_bad_rows() {
    let rows = "operator,v_n,d,e_n\nAnn,1,75e-6,0.3\nBob,-1,75e-6,0.3\nCem,2,75e-6,\n";
    let folder = folder(&[("m.toml", WAX), ("i.csv", rows)]);
    let output = nearwall(folder.path(), &["predict", "--model", "m.toml", "i.csv", "-o", "out.csv"]);
    assert_eq!(output.status.code(), Some(0));
    let said = text(&output.stderr);
    assert!(said.contains("line 3 left out: v_n = -1"), "{said}");
    let plain = std::fs::metadata(folder.path().join("i.csv")).unwrap().permissions();
    assert_eq!(std::fs::metadata(folder.path().join("out.csv")).unwrap().permissions(), plain);
    let table = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines[0], "operator,v_n,d,e_n,e_n_predicted,e_t,p_stick,regime,beyond");
    assert_eq!(lines.len(), 3);
    assert!(lines[1].starts_with("Ann,1,75e-6,0.3,") && lines[2].starts_with("Cem,2,75e-6,,"));
    assert!(lines[1].ends_with(",NSP-NSW,"));
}

#[test]
fn predict_quotes_cells_where_it_has_to() {
    let rows = "v_n,\"a, \"\"b\"\"\",c\n1,\"two\nlines\",\n2,plain,\"x\"\"y\"\n3,\"a,5\",µ\n";
    let folder = folder(&[("m.toml", WAX), ("i.csv", rows)]);
    let table = done(folder.path(), &["predict", "--model", "m.toml", "i.csv"]);
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    assert_eq!(
        reader.headers().unwrap(),
        vec!["v_n", "a, \"b\"", "c", "e_n", "e_t", "p_stick", "regime", "beyond"]
    );
    let cells: Vec<[String; 3]> = reader
        .records()
        .map(|row| row.unwrap())
        .map(|row| [0, 1, 2].map(|cell| row[cell].to_owned()))
        .collect();
    assert_eq!(cells, [["1", "two\nlines", ""], ["2", "plain", "x\"y"], ["3", "a,5", "µ"]]);
    assert!(table.contains("\n2,plain,\"x\"\"y\","), "only what needs quotation marks has them: {table}");
}

#[test]
fn predict_says_what_it_assumed_and_what_looks_wrong() {
    let rows = "v_n,Tp,T_w\n1,300,20\n";
    let folder = folder(&[("m.toml", WAX), ("i.csv", rows)]);
    let said = text(&nearwall(folder.path(), &["predict", "--model", "m.toml", "i.csv"]).stderr);
    for part in
        ["`Tp` is not used", "`T_p`", "assumed: d = 0.0001 m", "20 K; is that °C?", "1 of 1 rows lie outside"]
    {
        assert!(said.contains(part), "`{part}` is not in: {said}");
    }
}

#[test]
fn check_says_all_that_the_model_contains() {
    let model = concat!(env!("CARGO_MANIFEST_DIR"), "/../tutorials/slaggingGasifier/constant/nearWall.toml");
    let said = text(&nearwall(Path::new("."), &["check", model]).stdout);
    for part in [
        "coal-slag",
        "coverage 0.4",
        "yield_ratio 1.6",
        "friction 0.3",
        "kalmanovitch-frank",
        "25 Pa s",
        "0.89",
    ] {
        assert!(said.contains(part), "`{part}` is not in: {said}");
    }
}

#[test]
fn a_failed_run_spoils_nothing() {
    let folder = folder(&[("m.toml", WAX), ("i.csv", "v_n\nfast\n"), ("out.csv", "precious")]);
    refused(
        folder.path(),
        &["predict", "--model", "m.toml", "i.csv", "-o", "out.csv"],
        &["line 2 left out", "no row could be used"],
    );
    assert_eq!(std::fs::read_to_string(folder.path().join("out.csv")).unwrap(), "precious");
}

#[test]
fn bad_input_is_refused_with_its_place() {
    let misspelt = WAX.replace("yield_ratio", "yield_ration");
    let hot = WAX.replace("montan-wax", "own")
        + "[materials.own]\ndensity = 1000\nyoungs_modulus = { T = [300, 400], value = [1e9, 1e8] }\n\
           poisson_ratio = 0.3\nyield_strength = 1e7\nsurface_energy = 0.03\n";
    let folder = folder(&[
        ("m.toml", WAX),
        ("misspelt.toml", &misspelt),
        ("hot.toml", &hot),
        ("stiff.toml", &hot.replace("1e9", "70e90")),
        ("i.csv", "v_n,T_p\n1,500\n"),
        ("no_speed.csv", "speed\n1\n"),
    ]);
    let at = folder.path();
    refused(at, &["check", "misspelt.toml"], &["misspelt.toml:8:1", "did you mean `yield_ratio`"]);
    let stiff = [
        "stiff.toml:14:1: materials.own.youngs_modulus: 7e91 at 300 K",
        "1 to 1e13",
        "check the exponent, the temperatures and the unit, Pa",
    ];
    refused(at, &["check", "stiff.toml"], &stiff);
    refused(at, &["check", "absent.toml"], &["absent.toml", "No such file"]);
    refused(at, &["predict", "--model", "m.toml", "absent.csv"], &["absent.csv"]);
    refused(at, &["predict", "--model", "m.toml", "no_speed.csv"], &["no_speed.csv:1", "v_n", "speed"]);
    refused(
        at,
        &["predict", "--model", "hot.toml", "i.csv"],
        &["line 2", "own: youngs_modulus is given for 300 to 400 K, asked for 500 K"],
    );
    refused(at, &["predict", "--model", "m.toml", "i.csv", "--wall", "roof"], &["roof", "default"]);
    refused(at, &["materials", "tungstn"], &["did you mean `tungsten`"]);
    refused(at, &["materials", "kcl"], &["did you mean `potassium-chloride`?"]);
    refused(at, &["materials", "tungsten", "--temperature=-3"], &["--temperature"]);
    let ash = done(at, &["materials", "fly-ash"]);
    assert!(ash.contains(" K (90 % band, estimated from the composition)"), "{ash}");
}

#[test]
fn usage_is_exit_2_and_every_help_has_an_example() {
    let here = Path::new(".");
    assert_eq!(nearwall(here, &["predict"]).status.code(), Some(2));
    assert_eq!(nearwall(here, &["fly"]).status.code(), Some(2));
    let help = text(&nearwall(here, &["--help"]).stdout);
    let commands: Vec<&str> = help
        .lines()
        .skip_while(|line| !line.starts_with("Commands:"))
        .skip(1)
        .take_while(|line| !line.is_empty())
        .filter_map(|line| line.split_whitespace().next())
        .filter(|name| *name != "help")
        .collect();
    assert!(commands.len() >= 3, "{help}");
    for command in commands {
        let help = text(&nearwall(here, &[command, "--help"]).stdout);
        assert!(help.contains(&format!("nearwall {command}")) && help.contains("Example"), "{help}");
    }
}

#[test]
fn explain_names_the_terms() {
    let folder = folder(&[("m.toml", WAX), ("i.csv", "v_n,d\n1,75e-6\n")]);
    let output = nearwall(folder.path(), &["predict", "--model", "m.toml", "i.csv", "--explain", "2"]);
    let said = text(&output.stdout);
    assert!(said.contains("thornton-ning") && said.contains("constant") && said.contains("v_s"), "{said}");
}

#[test]
fn a_reader_that_goes_away_is_no_panic() {
    let rows = "v_n\n".to_owned() + &"1\n".repeat(100_000);
    let folder = folder(&[("m.toml", WAX), ("i.csv", &rows)]);
    let mut child = Command::new(env!("CARGO_BIN_EXE_nearwall"))
        .current_dir(folder.path())
        .args(["predict", "--model", "m.toml", "i.csv"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    std::io::stdout().flush().unwrap();
    assert!(!text(&output.stderr).contains("panicked"));
    assert_eq!(output.status.code(), Some(0));
}
