//! The commands of `README.md`, run as they stand there, in their order, in one shell.

use std::path::Path;
use std::process::Command;

/// Lines that install or that other tests run.
const LEFT_OUT: [&str; 4] =
    ["cargo install", "pip install", "tutorials/slaggingGasifier/Allrun", "tests/run"];

#[test]
fn every_block_runs_as_it_stands() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let page = std::fs::read_to_string(root.join("README.md")).unwrap();
    assert!(page.lines().count() <= 120, "a visitor reads two screens");
    let blocks = page.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    let lines =
        blocks.flat_map(str::lines).filter(|line| !LEFT_OUT.iter().any(|left| line.starts_with(left)));
    let script = lines.collect::<Vec<_>>().join("\n");
    assert!(script.lines().count() > 10, "{script}");
    // The folder of the project without what the commands write into it.
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
    assert!(output.status.success(), "{script}\n{}", String::from_utf8_lossy(&output.stderr));
}
