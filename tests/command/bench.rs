//! `nearwall bench`: what the page prints is what the command prints; planted sets and other programs are scored.

use std::path::Path;

use crate::runner::{WAX, done, folder, nearwall, refused};

const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/how-to/bench.md");

/// The code blocks of the page, by the word after the fence.
fn blocks(page: &str, kind: &str) -> Vec<String> {
    let fence = format!("```{kind}\n");
    page.split(&fence).skip(1).map(|rest| rest.split("```").next().unwrap().to_owned()).collect()
}

/// The page with other contents of its blocks of text.
fn with_texts(page: &str, texts: [String; 2]) -> String {
    const FENCE: &str = "```text\n";
    let mut parts = page.split(FENCE);
    let mut whole = parts.next().unwrap().to_owned();
    for (part, text) in parts.zip(texts) {
        whole += &format!("{FENCE}{text}```{}", part.split_once("```").unwrap().1);
    }
    whole
}

/// `docs/how-to/bench.md` has what `nearwall bench` prints, and what its example scores; `NEARWALL_BLESS=1` writes
/// both.
#[test]
fn the_page_has_the_tables() {
    let page = std::fs::read_to_string(PAGE).unwrap();
    let folder = folder(&[("law.awk", &blocks(&page, "awk")[0])]);
    let program = blocks(&page, "sh")[0].split('\'').nth(1).unwrap().to_owned();
    let own = done(folder.path(), &["bench", "--external", &program]);
    let table = own.split("\n\n").find(|part| part.starts_with("Models and programs")).unwrap();
    let expected = with_texts(&page, [done(folder.path(), &["bench"]), format!("{table}\n")]);
    if std::env::var_os("NEARWALL_BLESS").is_some() {
        std::fs::write(PAGE, expected).unwrap();
    } else {
        assert_eq!(page, expected, "NEARWALL_BLESS=1 cargo test --test command bench writes it");
    }
}

/// A set of a user's own: e_n is 0.4 and 0.6 in turn, and so is the captured share.
fn planted() -> tempfile::TempDir {
    let folder = folder(&[]);
    let set = folder.path().join("sets/planted");
    std::fs::create_dir_all(&set).unwrap();
    let rows: String =
        (1..=20).map(|row| format!("{row},1e-4,{}\n", if row % 2 == 0 { 0.4 } else { 0.6 })).collect();
    std::fs::write(set.join("data.csv"), format!("v_n,d,e_n\n{rows}")).unwrap();
    std::fs::write(set.join("base.toml"), WAX).unwrap();
    folder
}

/// The line of a table that begins with these words, as cells.
fn line<'a>(text: &'a str, words: &[&str]) -> Vec<&'a str> {
    let cells = |line: &'a str| {
        line.trim().split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect::<Vec<_>>()
    };
    text.lines()
        .map(cells)
        .find(|cells| cells.starts_with(words))
        .unwrap_or_else(|| panic!("{words:?}: {text}"))
}

/// By hand: the mean is 0.50, every reading is 0.10 away from it.
#[test]
fn a_set_of_ones_own_is_scored() {
    let folder = planted();
    let half =
        "awk 'NR == 1 { print \"e_n,e_t,p,e_n_low,e_n_high\" } NR > 1 { print \"0.5,0.5,0,0.45,0.65\" }'";
    let text = done(folder.path(), &["bench", "--external", half, "--data", "sets"]);
    let planted = line(&text, &["planted", "planted", "e_n"]);
    assert_eq!(planted[3..7], ["20", "0.50", "0.50", "0.10"], "{text}");
    assert!(text.contains("its own bands hold"), "{text}");
    refused(folder.path(), &["bench", "--data", "."], &["sub-folder", "data.csv, base.toml"]);
}

/// Two sources with an ash above its flow temperature, which sticks, and a cold one, which does
/// not: only the hot ones are a matter of a melt, and the law of fusion is right about them.
#[test]
fn a_law_of_capture_is_scored_where_a_melt_may_matter() {
    let folder = folder(&[]);
    let ash = "[particle]\nmaterial = \"ash\"\n[walls.default]\nmaterial = \"stainless-steel\"\n\
        [normal]\nmodel = \"constant\"\ne_n = 0.5\n[tangential]\nmodel = \"constant\"\ne_t = 0.5\n\
        [materials.ash]\nlike = \"fly-ash\"\nfusion_temperatures = { deformation = 1300, softening = 1350, flow = 1400 }\n";
    for source in ["one", "other"] {
        let set = folder.path().join("sets").join(source);
        std::fs::create_dir_all(&set).unwrap();
        std::fs::write(set.join("base.toml"), ash).unwrap();
        let rows = "5,1e-4,1500,1\n6,1e-4,1600,1\n5,1e-4,300,0\n6,1e-4,400,0\n";
        std::fs::write(set.join("data.csv"), format!("v_n,d,T_p,capture_efficiency\n{rows}")).unwrap();
    }
    let fusion = |text: &str| -> Vec<f64> {
        line(text, &["fusion"])[1..5].iter().map(|cell| cell.parse().unwrap()).collect()
    };
    let [without, with] =
        [&["bench"][..], &["bench", "--data", "sets"]].map(|words| fusion(&done(folder.path(), words)));
    // The cold impacts are no matter of a melt.
    assert_eq!([with[2] - without[2], with[3] - without[3]], [4.0, 2.0], "{with:?} {without:?}");
    assert!(with[0] > with[1] + 1.0, "beyond level with the law, and by adhesion alone: {with:?}");
}

/// The same numbers and bands from a model file with drawn ones and from another program score the same.
#[test]
fn a_model_and_a_program_with_the_same_numbers_are_equal() {
    let model = |e_n: f64, e_t: f64| {
        let law = format!("\"constant\"\ne_n = {e_n}");
        WAX.replace("\"thornton-ning\"\nyield_ratio = 0.7", &law).replace("0.76", &e_t.to_string())
    };
    let folder = folder(&[("m.toml", &model(0.65, 0.6))]);
    std::fs::create_dir(folder.path().join("draws")).unwrap();
    for (name, [e_n, e_t]) in [("a.toml", [0.4003, 0.5003]), ("b.toml", [0.9003, 0.7003])] {
        std::fs::write(folder.path().join("draws").join(name), model(e_n, e_t)).unwrap();
    }
    std::fs::write(folder.path().join("law.awk"), CONSTANT).unwrap();
    let program = "awk -f law.awk";
    let text = done(folder.path(), &["bench", "m.toml", "--draws", "draws", "--external", program]);
    let table = text.split("Models and programs").nth(1).unwrap();
    let [by_file, by_program] = ["m.toml", program].map(|name| {
        let line = table.lines().find(|line| line.trim_start().starts_with(name)).unwrap();
        line.trim_start()[name.len()..].trim().to_owned()
    });
    assert_eq!(by_file, by_program);
    let bands: Vec<&str> = text.lines().filter(|line| line.contains("its own bands hold")).collect();
    assert!(bands.len() == 2 && bands[0] == bands[1], "{bands:?}");
}

/// A law without physics, as another program. No reading lies on an end of its bands.
const CONSTANT: &str = "NR == 1 { print \"e_n,e_t,p,e_n_low,e_n_high,e_t_low,e_t_high\"; next }\n\
                        { print \"0.65,0.6,0,0.4003,0.9003,0.5003,0.7003\" }\n";

/// What fitted a model is no test of it, nor is any other reading of that source.
#[test]
fn the_source_of_a_fit_is_left_out() {
    let folder = folder(&[]);
    done(folder.path(), &["init", "laboratory", "."]);
    done(folder.path(), &["diagnose", "measured.csv", "--model", "base.toml", "--out", "out"]);
    let [base, extended] =
        ["base.toml", "out/extended.toml"].map(|model| done(folder.path(), &["bench", model]));
    // Of a column of sources: another one is "Li et al. in Troiano et al.".
    assert!(base.contains("  Troiano") && !base.contains("left out"), "{base}");
    assert!(!extended.contains("  Troiano"), "{extended}");
    assert!(
        extended.contains("wax-on-pyrex: its rows fitted the model, so its source is left out"),
        "{extended}"
    );
}

#[test]
fn faults_name_the_place_and_the_remedy() {
    let folder = folder(&[("m.toml", WAX)]);
    let at = folder.path();
    refused(at, &["bench", "borns"], &["unknown law `borns`", "did you mean `bons`", "model file"]);
    refused(at, &["bench", "absent.toml"], &["absent.toml"]);
    refused(at, &["bench", "--external", "exit 4"], &["--external exit 4", "exit status: 4"]);
    refused(at, &["bench", "--external", "echo e_n; cat >/dev/null"], &["0 rows for", "in the same order"]);
    assert_eq!(nearwall(at, &["bench", "--impacts", "m.toml"]).status.code(), Some(2));
    let table = done(Path::new("."), &["bench", "--impacts"]);
    assert!(table.starts_with("set,particle,wall,v_n,v_t,omega,d,T_p,"), "{table}");
}
