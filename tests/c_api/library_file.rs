//! The shared library as a file: its name, its symbols, what it needs, its size.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use nearwall::c_api::NW_ABI_VERSION;

use crate::calls::NAMES;
use crate::common::compile::{Build, run, shared_library};

const BUILDS: [Build; 2] = [Build::Tested, Build::Shipped];

/// The values of a tag in the dynamic section.
fn dynamic(library: &Path, tag: &str) -> Vec<String> {
    let printed = run(Command::new("readelf").args(["--dynamic", "--wide"]).arg(library).env("LC_ALL", "C"));
    let lines = printed.lines().filter(|line| line.contains(&format!("({tag})")));
    lines.map(|line| line.split_once(')').unwrap().1.trim().to_owned()).collect()
}

#[test]
fn it_has_a_soname_and_is_never_unloaded() {
    for build in BUILDS {
        let library = shared_library(build);
        let soname = format!("Library soname: [libnearwall.so.{NW_ABI_VERSION}]");
        assert_eq!(dynamic(&library, "SONAME"), [soname]);
        assert!(dynamic(&library, "FLAGS_1").iter().any(|flags| flags.contains("NODELETE")), "{build:?}");
        assert_eq!(dynamic(&library, "TEXTREL"), [""; 0], "{build:?}");
        let needed = dynamic(&library, "NEEDED").join(" ");
        println!("{build:?} needs {needed}");
        for allowed in needed.split_whitespace().filter(|word| word.starts_with('[')) {
            let usual = ["libc.so", "libm.so", "libgcc_s.so", "ld-linux"];
            assert!(usual.iter().any(|name| allowed[1..].starts_with(name)), "{build:?}: {allowed}");
        }
    }
}

#[test]
fn it_exports_what_the_header_declares_and_nothing_else() {
    let declared: BTreeSet<String> = NAMES.iter().map(|name| (*name).to_owned()).collect();
    for build in BUILDS {
        let printed =
            run(Command::new("nm").args(["--dynamic", "--defined-only"]).arg(shared_library(build)));
        let exported: BTreeSet<String> =
            printed.lines().map(|line| line.rsplit(' ').next().unwrap().to_owned()).collect();
        assert_eq!(exported, declared, "{build:?}");
    }
}

#[test]
fn the_shipped_build_is_small() {
    let size = |build| std::fs::metadata(shared_library(build)).unwrap().len();
    println!(
        "libnearwall.so: {} kB shipped, {} kB as tested",
        size(Build::Shipped) / 1000,
        size(Build::Tested) / 1000
    );
    assert!(size(Build::Shipped) < 3_000_000, "what came in?");
}
