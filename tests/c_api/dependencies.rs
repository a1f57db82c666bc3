//! What comes in with the library is what `docs/why/dependencies.md` says, and asks for no younger Rust than we
//! promise.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use crate::common::compile::{Build, run, shared_library};
use serde_json::Value;

fn cargo(arguments: &[&str]) -> String {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(arguments).args(["--locked", "--offline"]);
    run(cargo.current_dir(env!("CARGO_MANIFEST_DIR")))
}

fn page() -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/why/dependencies.md")).unwrap()
}

/// The crates that `cargo tree` names for the library: those in it, and those that only compile it.
fn crates() -> [BTreeSet<String>; 2] {
    let tree = cargo(&[
        "tree",
        "-p",
        "nearwall",
        "-e",
        "normal,build",
        "--prefix",
        "depth",
        "--no-dedupe",
        "--target",
        "x86_64-unknown-linux-gnu",
        "--format",
        " {p}",
    ]);
    let [mut inside, mut compiling] = [BTreeSet::new(), BTreeSet::new()];
    // What a procedural macro or a build script needs is not in the library either.
    let mut tool_depth = None;
    for line in tree.lines().skip(1) {
        let Some((depth, rest)) = line.split_once(' ') else { continue };
        let Ok(depth) = depth.parse::<usize>() else { panic!("{line}") };
        let name = rest.split(' ').next().unwrap().to_owned();
        if tool_depth.is_some_and(|tool| depth <= tool) {
            tool_depth = None;
        }
        let tool = rest.contains("(proc-macro)") || name == "autocfg";
        if tool && tool_depth.is_none() {
            tool_depth = Some(depth);
        }
        if tool_depth.is_some() {
            compiling.insert(name)
        } else {
            inside.insert(name)
        };
    }
    [inside, compiling]
}

#[test]
fn the_page_lists_what_is_in_the_library() {
    let page = page();
    let table = page.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| crate"));
    let listed: BTreeSet<String> = table
        .flat_map(|line| line.split('|').nth(1).unwrap().split(','))
        .map(|name| name.trim().to_owned())
        .collect();
    let [inside, compiling] = crates();
    assert_eq!(listed, inside);
    let line = page.lines().find_map(|line| line.strip_prefix("Only while compiling: ")).unwrap();
    let listed: BTreeSet<String> = line.trim_end_matches('.').split(", ").map(str::to_owned).collect();
    assert_eq!(listed, compiling);
}

/// The size is that of one compiler; another's may differ by a fifth.
#[test]
fn the_page_states_the_size_of_the_library() {
    let page = page();
    let before = page.split(" kB and holds").next().unwrap();
    let stated: f64 = before.rsplit(' ').next().unwrap().parse().unwrap();
    let size = std::fs::metadata(shared_library(Build::Shipped)).unwrap().len() as f64 / 1000.0;
    println!("{size:.0} kB");
    assert!((size / stated - 1.0).abs() < 0.2, "{size:.0} kB, stated {stated} kB");
}

/// Not even the means to harm: no function of libc that changes a file system, runs a program or opens a connection.
#[test]
fn the_library_imports_nothing_that_writes_files_or_runs_programs() {
    let printed =
        run(Command::new("nm").args(["--dynamic", "--undefined-only"]).arg(shared_library(Build::Shipped)));
    let imported: BTreeSet<&str> =
        printed.lines().filter_map(|line| line.split_whitespace().last()?.split('@').next()).collect();
    assert!(imported.contains("open64") && imported.contains("read"), "{imported:?}");
    for name in [
        "creat",
        "creat64",
        "unlink",
        "unlinkat",
        "rename",
        "renameat",
        "link",
        "symlink",
        "mkdir",
        "rmdir",
        "remove",
        "chmod",
        "fchmod",
        "truncate",
        "ftruncate",
        "ftruncate64",
        "fork",
        "vfork",
        "execve",
        "execvp",
        "execv",
        "posix_spawn",
        "posix_spawnp",
        "system",
        "popen",
        "dlopen",
        "socket",
        "connect",
        "bind",
        "sendto",
        "kill",
    ] {
        assert!(!imported.contains(name), "{name}");
    }
}

#[test]
fn no_dependency_asks_for_a_younger_rust() {
    let metadata =
        cargo(&["metadata", "--format-version", "1", "--filter-platform", "x86_64-unknown-linux-gnu"]);
    let metadata: Value = serde_json::from_str(&metadata).unwrap();
    let version =
        |text: &str| -> Vec<u32> { text.split('.').take(2).map(|part| part.parse().unwrap()).collect() };
    let ours = version(env!("CARGO_PKG_RUST_VERSION"));
    let packages = metadata["packages"].as_array().unwrap();
    assert!(packages.len() > 50);
    for package in packages {
        if let Some(asked) = package["rust_version"].as_str() {
            assert!(version(asked) <= ours, "{} asks for Rust {asked}", package["name"]);
        }
    }
}
