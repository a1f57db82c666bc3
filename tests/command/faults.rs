//! What goes wrong around the command: full disks, folders that take nothing, files cut off or
//! replaced while it runs. Nothing that was there is lost, the exit code is 1, and the message
//! names the place and what to do.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::runner::{WAX, is_refusal};
use tempfile::TempDir;

const BINARY: &str = env!("CARGO_BIN_EXE_nearwall");
const PRECIOUS: &str = "precious";

/// Every run that writes, with the results it leaves in the folder.
const RUNS: [(&str, &[&str]); 4] = [
    ("predict --model m.toml i.csv -o out.csv", &["out.csv"]),
    (
        "diagnose i.csv --model m.toml --out out",
        &["out/extended.toml", "out/diagnosis.json", "out/report.html"],
    ),
    ("simulate c.toml -o out", &["out/impacts.csv", "out/summary.json", "out/report.html"]),
    ("report runs.csv -o out.html", &["out.html"]),
];

/// A folder with inputs for all runs.
fn inputs() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let mut rows = "v_n,d,e_n\n".to_owned();
    for i in 0..1000 {
        writeln!(rows, "{},75e-6,{}", 1.0 + f64::from(i % 50) / 20.0, 0.3 + 0.01 * f64::from(i % 7)).unwrap();
    }
    let tutorials = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/..")).join("tutorials/standalone");
    let case = std::fs::read_to_string(tutorials.join("waxRig.toml")).unwrap();
    let few = case.replace("count = 4000", "count = 20");
    assert!(few != case);
    std::fs::write(at.join("c.toml"), few).unwrap();
    std::fs::copy(tutorials.join("waxRig.model.toml"), at.join("waxRig.model.toml")).unwrap();
    std::fs::write(at.join("m.toml"), WAX).unwrap();
    std::fs::write(at.join("i.csv"), rows).unwrap();
    std::fs::write(at.join("runs.csv"), RUNS_TABLE).unwrap();
    folder
}

const RUNS_TABLE: &str = "run,T_C,capture,capture_paper\na,20,0.01,0\nb,120,0.99,0.9\n";

/// Every file of a folder with its content.
fn tree(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() {
            found.extend(tree(&path).into_iter().map(|(below, bytes)| (format!("{name}/{below}"), bytes)));
        } else if path.is_file() {
            found.insert(name, std::fs::read(&path).unwrap());
        }
    }
    found
}

/// Runs a shell line in a folder, with `$nearwall` for the command.
fn shell(folder: &Path, line: &str) -> Output {
    let mut sh = Command::new("sh");
    sh.args(["-c", line]).env("nearwall", BINARY).current_dir(folder).stdin(Stdio::null());
    sh.output().unwrap()
}

/// Puts something in the place of each result.
fn precious(folder: &Path, results: &[&str]) {
    for result in results {
        let place = folder.join(result);
        std::fs::create_dir_all(place.parent().unwrap()).unwrap();
        std::fs::write(place, PRECIOUS).unwrap();
    }
}

#[test]
fn every_run_works_where_nothing_is_wrong() {
    for (run, results) in RUNS {
        let folder = inputs();
        precious(folder.path(), results);
        let output = shell(folder.path(), &format!("$nearwall {run}"));
        assert!(output.status.success(), "{run}: {}", String::from_utf8_lossy(&output.stderr));
        let after = tree(folder.path());
        for result in results {
            assert!(after[*result].len() > 20 && after[*result] != PRECIOUS.as_bytes(), "{run}: {result}");
        }
        assert!(after.keys().all(|name| !name.contains(".part")), "{run}: {:?}", after.keys());
    }
}

/// The kernel's limit on the size of files: the first write that does not fit fails as on a full disk.
#[test]
fn files_that_may_not_grow_leave_what_was_there() {
    for (run, results) in RUNS {
        let folder = inputs();
        precious(folder.path(), results);
        let before = tree(folder.path());
        let output = shell(folder.path(), &format!("trap '' XFSZ; ulimit -f 1; exec $nearwall {run}"));
        is_refusal(&output, &[results[0].split('/').next().unwrap(), "make room or write elsewhere"]);
        assert!(tree(folder.path()) == before, "{run}");
    }
}

/// A disk that is full to its last block.
#[test]
fn a_full_disk_leaves_what_was_there() {
    for (run, results) in RUNS {
        let folder = inputs();
        let disk = folder.path().join("disk");
        std::fs::create_dir(&disk).unwrap();
        let run = results.iter().fold(run.to_owned(), |run, _| run.replace(" out", " disk/out"));
        let fill: String = results
            .iter()
            .map(|r| format!("mkdir -p disk/$(dirname {r}) && printf {PRECIOUS} > disk/{r} && "))
            .collect();
        let keep: String =
            results.iter().map(|r| format!("test \"$(cat disk/{r})\" = {PRECIOUS} || exit 7; ")).collect();
        let line = format!(
            "mount -t tmpfs -o size=64k none disk && {fill} true || exit 9
             cat /dev/zero > disk/ballast 2> ballast.full
             find disk | sort > before; $nearwall {run} 2> said; code=$?; find disk | sort > after
             {keep} cmp before after || exit 8; cat said >&2; exit $code"
        );
        let mut unshare = Command::new("unshare");
        unshare.args(["--map-root-user", "--mount", "sh", "-c", &line]).env("nearwall", BINARY);
        let output = unshare.current_dir(folder.path()).output();
        let Ok(output) = output.inspect_err(|error| println!("SKIPPED, no unshare: {error}")) else { return };
        let said = String::from_utf8_lossy(&output.stderr);
        if output.status.code() == Some(9) || said.contains("unshare") {
            return println!("SKIPPED, no disk can be mounted here: {said}");
        }
        is_refusal(&output, &["disk/out", "No space left", "make room or write elsewhere"]);
    }
}

#[test]
fn standard_output_and_devices_that_are_full_are_named() {
    let folder = inputs();
    let predict = "$nearwall predict --model m.toml i.csv";
    is_refusal(&shell(folder.path(), &format!("{predict} > /dev/full")), &["standard output: No space left"]);
    is_refusal(
        &shell(folder.path(), &format!("{predict} -o /dev/full")),
        &["/dev/full: No space left", "elsewhere"],
    );
    for line in ["check m.toml", "materials", "predict --model m.toml i.csv --explain 2"] {
        is_refusal(&shell(folder.path(), &format!("$nearwall {line} > /dev/full")), &["No space left"]);
    }
    assert!(shell(folder.path(), &format!("{predict} -o /dev/null")).status.success());
    let piped = shell(folder.path(), &format!("{predict} -o /dev/stdout | wc -l"));
    assert_eq!(String::from_utf8_lossy(&piped.stdout).trim(), "1001");
}

/// Root may write anywhere: it steps down to nobody, who may not write here.
#[test]
fn folders_that_take_nothing_are_named() {
    let open_to_all = std::os::unix::fs::PermissionsExt::from_mode(0o755);
    let bin = tempfile::tempdir().unwrap();
    std::fs::set_permissions(bin.path(), open_to_all).unwrap();
    let copy = bin.path().join("nearwall");
    std::fs::copy(BINARY, &copy).unwrap();
    for (run, results) in RUNS {
        let folder = inputs();
        precious(folder.path(), results);
        let before = tree(folder.path());
        let line = format!(
            "chmod -R a+rX,go-w .
             if [ $(id -u) = 0 ]; then down='setpriv --reuid=65534 --clear-groups'; else chmod -R u-w .; fi
             $down {} {run}; code=$?; chmod -R u+w .; exit $code",
            copy.display()
        );
        let output = shell(folder.path(), &line);
        is_refusal(&output, &["out", "ermission denied", "allow writing there or write elsewhere"]);
        assert!(tree(folder.path()) == before, "{run}");
    }
}

#[test]
fn folders_that_are_not_there_are_made_or_named() {
    for (run, _) in RUNS {
        let folder = inputs();
        let output =
            shell(folder.path(), &format!("$nearwall {}", run.replace(" out", " nowhere/at/all/out")));
        if run.starts_with("simulate") || run.starts_with("diagnose") {
            assert!(output.status.success(), "{run} makes its folder");
        } else {
            is_refusal(&output, &["nowhere/at/all/out", "make the folder first"]);
        }
        let output = shell(folder.path(), &format!("$nearwall {}", run.replace(" out", " m.toml/out")));
        is_refusal(&output, &["m.toml/out", "ot a directory", "make the folder first"]);
    }
}

#[test]
fn results_that_are_write_protected_stay() {
    for (run, results) in RUNS {
        let folder = inputs();
        precious(folder.path(), results);
        let before = tree(folder.path());
        let protect = format!("chmod a-w {}; exec $nearwall {run}", results[0]);
        is_refusal(&shell(folder.path(), &protect), &[results[0], "allow writing there"]);
        assert!(tree(folder.path()) == before, "{run}");
    }
}

#[test]
fn inputs_are_never_written_over() {
    for (line, name) in [
        ("predict --model m.toml i.csv -o i.csv", "i.csv"),
        ("predict --model m.toml i.csv -o ./m.toml", "./m.toml"),
        ("predict --model m.toml i.csv -o link.csv", "link.csv"),
        ("report runs.csv -o runs.csv", "runs.csv"),
        ("diagnose i.csv --model out/extended.toml --out out", "out/extended.toml"),
    ] {
        let folder = inputs();
        let at = folder.path();
        std::os::unix::fs::symlink("i.csv", at.join("link.csv")).unwrap();
        std::fs::create_dir(at.join("out")).unwrap();
        std::fs::copy(at.join("m.toml"), at.join("out/extended.toml")).unwrap();
        let before = tree(at);
        is_refusal(&shell(at, &format!("$nearwall {line}")), &[name, "is read as an input", "elsewhere"]);
        assert!(tree(at) == before, "{line}");
    }
}

#[test]
fn a_link_stays_a_link_and_its_end_is_replaced() {
    let folder = inputs();
    let at = folder.path();
    std::fs::create_dir(at.join("store")).unwrap();
    std::fs::write(at.join("store/real.csv"), PRECIOUS).unwrap();
    std::os::unix::fs::symlink("store/real.csv", at.join("out.csv")).unwrap();
    assert!(shell(at, "$nearwall predict --model m.toml i.csv -o out.csv").status.success());
    assert!(at.join("out.csv").is_symlink());
    assert!(std::fs::read_to_string(at.join("store/real.csv")).unwrap().starts_with("v_n,d,e_n"));
}

/// Wherever a model file is cut off, it is refused with a place in it or is a whole model.
#[test]
fn models_that_are_cut_off() {
    let folder = inputs();
    let whole = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
        .join("tutorials/slaggingGasifier/constant/nearWall.toml");
    let whole = std::fs::read(whole).unwrap();
    let (mut refusals, step) = (0, whole.len() / 60);
    for end in (0..whole.len()).step_by(step) {
        std::fs::write(folder.path().join("cut.toml"), &whole[..end]).unwrap();
        let output = shell(folder.path(), "exec $nearwall check cut.toml");
        if output.status.success() {
            continue;
        }
        refusals += 1;
        is_refusal(&output, &["nearwall: cut.toml:"]);
    }
    assert!(refusals > 20, "{refusals}");
}

/// A run that waits for its impacts in the middle: what happens then?
struct Paused {
    child: std::process::Child,
    rows: std::fs::File,
}

impl Paused {
    /// The model is read and a row is predicted once this returns.
    fn start(folder: &Path) -> Self {
        assert!(Command::new("mkfifo").arg(folder.join("pipe.csv")).status().unwrap().success());
        let child = Command::new(BINARY)
            .args(["predict", "--model", "m.toml", "pipe.csv", "-o", "out.csv"])
            .current_dir(folder)
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        // Opens once the other side does, which has read its model by then.
        let mut rows = std::fs::File::options().write(true).open(folder.join("pipe.csv")).unwrap();
        rows.write_all(b"v_n,d\n1,75e-6\n").unwrap();
        Self { child, rows }
    }

    fn finish(mut self) -> Output {
        self.rows.write_all(b"2,75e-6\n").unwrap();
        drop(self.rows);
        self.child.wait_with_output().unwrap()
    }
}

#[test]
fn files_that_are_replaced_while_it_runs() {
    let folder = inputs();
    let at = folder.path();
    std::fs::write(at.join("two.csv"), "v_n,d\n1,75e-6\n2,75e-6\n").unwrap();
    assert!(shell(at, "$nearwall predict --model m.toml two.csv -o expected.csv").status.success());
    let expected = std::fs::read(at.join("expected.csv")).unwrap();
    let changes: [&dyn Fn(); 4] = [
        &|| std::fs::write(at.join("m.toml"), "garbage").unwrap(),
        &|| std::fs::remove_file(at.join("m.toml")).unwrap(),
        &|| std::fs::write(at.join("out.csv"), "another's").unwrap(),
        &|| std::fs::remove_file(at.join("out.csv")).unwrap(),
    ];
    for change in changes {
        precious(at, &["out.csv"]);
        std::fs::write(at.join("m.toml"), WAX).unwrap();
        let paused = Paused::start(at);
        change();
        let output = paused.finish();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        assert_eq!(std::fs::read(at.join("out.csv")).unwrap(), expected);
        std::fs::remove_file(at.join("pipe.csv")).unwrap();
    }
}

#[test]
fn a_run_that_is_killed_leaves_what_was_there() {
    let folder = inputs();
    precious(folder.path(), &["out.csv"]);
    let mut paused = Paused::start(folder.path());
    paused.child.kill().unwrap();
    paused.child.wait().unwrap();
    assert_eq!(std::fs::read_to_string(folder.path().join("out.csv")).unwrap(), PRECIOUS);
}

/// Every text of a model replaced by a path and by a shell line: nothing is written, nothing runs.
#[test]
fn no_text_in_a_model_writes_or_runs_anything() {
    let folder = inputs();
    let at = folder.path();
    let victim = at.join("victim");
    std::fs::write(&victim, PRECIOUS).unwrap();
    let path = victim.display();
    let whole = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
        .join("tutorials/slaggingGasifier/constant/nearWall.toml");
    let whole = std::fs::read_to_string(whole).unwrap();
    let pieces: Vec<&str> = whole.split('"').collect();
    assert!(pieces.len() > 10 && pieces.len() % 2 == 1);
    let mut lines = String::new();
    for text in (1..pieces.len()).step_by(2) {
        for (number, put) in [
            format!("{path}"),
            format!("file://{path}"),
            format!("$(touch {path}.ran)"),
            format!("| touch {path}.ran"),
            format!("`touch {path}.ran`"),
            format!("../{}/victim", at.file_name().unwrap().to_str().unwrap()),
        ]
        .into_iter()
        .enumerate()
        {
            let mut changed: Vec<&str> = pieces.clone();
            changed[text] = &put;
            let name = format!("evil-{text}-{number}.toml");
            std::fs::write(at.join(&name), changed.join("\"")).unwrap();
            writeln!(lines, "$nearwall check {name}; $nearwall predict --model {name} i.csv > /dev/null")
                .unwrap();
            // The library itself, too.
            let _ = nearwall::Model::from_file(&at.join(name));
        }
    }
    let before = tree(at);
    shell(at, &format!("{{ {lines} }} 2> /dev/null"));
    assert!(tree(at) == before, "something was written");
}

/// The one file that writes and makes folders is `lab/src/atomic_file.rs`; nothing runs other programs.
#[test]
fn the_source_writes_in_one_place() {
    const WRITES: [&str; 10] = [
        "File::create",
        "fs::write",
        "OpenOptions",
        "File::options",
        "fs::rename",
        "fs::remove",
        "fs::copy",
        "process::Command",
        "create_dir",
        "NamedTempFile",
    ];
    let leave = |file: &str, word: &str| {
        file == "atomic_file.rs" && ["create_dir", "File::options", "NamedTempFile"].contains(&word)
    };
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let [library, lab] = ["src", "lab/src"].map(|folder| tree(&root.join(folder)));
    assert!(library.len() > 100 && lab.len() > 100 && lab.contains_key("atomic_file.rs"));
    for (file, bytes) in library.into_iter().chain(lab) {
        let text = String::from_utf8(bytes).unwrap();
        let shipped = text.split("#[cfg(test)]").next().unwrap();
        for word in WRITES {
            assert!(!shipped.contains(word) || leave(&file, word), "{file} has {word}");
        }
    }
}
