//! The commands of `README.md` and of the book's pages for beginners, run as they stand there, in their order, in one
//! shell for each page.

use std::path::Path;
use std::process::Command;

/// Lines that install or that other tests run.
const LEFT_OUT: [&str; 4] =
    ["cargo install", "pip install", "tutorials/slaggingGasifier/Allrun", "tests/run"];

/// Runs the `sh` blocks of a page in a folder with `bindings` and `tutorials`. Written cases get few particles.
fn run(page: &str) {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let text = std::fs::read_to_string(root.join(page)).unwrap();
    let blocks = text.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    let lines =
        blocks.flat_map(str::lines).filter(|line| !LEFT_OUT.iter().any(|left| line.starts_with(left)));
    let mut script = String::new();
    for line in lines {
        script += &format!("{line}\n");
        if let Some(kind) = line.strip_prefix("nearwall init ").and_then(|rest| rest.split(' ').next()) {
            script += &format!("sed -i 's/^count = .*/count = 200/' {kind}/*.toml\n");
        }
    }
    assert!(script.lines().count() > 3, "{page}: {script}");
    let scratch = tempfile::tempdir().unwrap();
    for folder in ["bindings", "tutorials"] {
        std::os::unix::fs::symlink(root.canonicalize().unwrap().join(folder), scratch.path().join(folder))
            .unwrap();
    }
    let program = Path::new(env!("CARGO_BIN_EXE_nearwall")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let output = Command::new("sh")
        .args(["-e", "-c", &script])
        .current_dir(scratch.path())
        .env("PATH", path)
        .output()
        .unwrap();
    assert!(output.status.success(), "{page}\n{script}\n{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn every_block_runs_as_it_stands() {
    run("README.md");
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../README.md");
    assert!(std::fs::read_to_string(page).unwrap().lines().count() <= 120, "a visitor reads two screens");
}

#[test]
fn the_book_begins_with_commands_that_run() {
    for field in ["gasifier", "superheater", "tokamak", "turbine", "laboratory"] {
        run(&format!("docs/begin/{field}.md"));
    }
}
