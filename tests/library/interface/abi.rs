//! The binary interface of the C library, as `cpp_shim/abi.txt` keeps it: symbols, sizes and places
//! of struct fields, numbers, prototypes. Any change needs another `NW_ABI_VERSION`, because
//! programs that were built before would go wrong.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::c_header::{Header, Struct};
use crate::common::compile::{Build, library_path, run, shared_library};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Numbers and structs of the header as the C compiler sees them.
fn layout(header: &Header) -> String {
    let mut program = String::from(
        "#include \"nearwall.h\"\n#include <stdio.h>\n#define SIZE(x) (unsigned)sizeof(x)\nint main(void) {\n",
    );
    let mut line = |format: &str, values: &str| {
        writeln!(program, "printf(\"{format}\\n\", {values});").unwrap();
    };
    for (name, _) in &header.numbers {
        line(&format!("number {name} %lld"), &format!("(long long){name}"));
    }
    for Struct { name, fields } in &header.structs {
        let values = format!("SIZE({name}), (unsigned)_Alignof({name})");
        line(&format!("struct {name} size %u align %u"), &values);
        for field in fields.iter().map(|field| &field.name) {
            let values = format!("(unsigned)offsetof({name}, {field}), SIZE((({name} *)0)->{field})");
            line(&format!("field {name}.{field} at %u size %u"), &values);
        }
    }
    program.push_str("return 0; }\n");
    let folder = tempfile::tempdir().unwrap();
    let [source, built] = ["abi.c", "abi"].map(|name| folder.path().join(name));
    std::fs::write(folder.path().join("nearwall.h"), &header.text).unwrap();
    std::fs::write(&source, program).unwrap();
    let mut compiler = Command::new(std::env::var_os("CC").unwrap_or_else(|| "cc".into()));
    compiler.args(["-std=c11", "-Wall", "-Werror"]);
    run(compiler.arg(source).arg("-o").arg(&built));
    run(&mut Command::new(built))
}

/// Every type and function of the header, without the names of arguments: those may change.
fn prototypes(header: &Header) -> String {
    let mut found = String::new();
    for alias in &header.types {
        writeln!(found, "type {} {}", alias.kind, alias.name).unwrap();
    }
    for function in &header.functions {
        let kinds: Vec<&str> = function.arguments.iter().map(|argument| argument.kind.as_str()).collect();
        writeln!(found, "function {} {}({})", function.result, function.name, kinds.join(", ")).unwrap();
    }
    found
}

/// What the shared library of this build exports, and its soname.
fn symbols() -> String {
    let library = library_path();
    let printed = run(Command::new("nm").args(["--dynamic", "--defined-only"]).arg(&library));
    let names: BTreeSet<&str> = printed.lines().map(|line| line.rsplit(' ').next().unwrap()).collect();
    let dynamic = run(Command::new("readelf").args(["--dynamic", "--wide"]).arg(&library).env("LC_ALL", "C"));
    let soname = dynamic.lines().find(|line| line.contains("(SONAME)")).unwrap();
    let soname = soname.split(['[', ']']).nth(1).unwrap();
    names.iter().fold(format!("soname {soname}\n"), |text, name| format!("{text}symbol {name}\n"))
}

fn fresh() -> String {
    let header = Header::generate();
    symbols() + &layout(&header) + &prototypes(&header)
}

/// Whether the interface that is kept may become this one, and why not.
fn may_follow(kept: &str, fresh: &str) -> Result<(), String> {
    let version = |text: &str| -> Option<u32> {
        text.lines().find_map(|line| line.strip_prefix("number NW_ABI_VERSION "))?.parse().ok()
    };
    let set = |text: &str| text.lines().map(str::to_owned).collect::<BTreeSet<_>>();
    let (old, new) = (set(kept), set(fresh));
    if old == new {
        return Ok(());
    }
    match (version(kept), version(fresh)) {
        (Some(before), Some(now)) if now > before => return Ok(()),
        (Some(_), Some(_)) => {}
        (before, now) => return Err(format!("no NW_ABI_VERSION: {before:?}, {now:?}")),
    }
    let gone = old.difference(&new).map(|line| format!("  - {line}\n"));
    let come = new.difference(&old).map(|line| format!("  + {line}\n"));
    Err(format!(
        "the binary interface changed, but NW_ABI_VERSION did not rise:\n{}raise it in src/c_api and the soname in build.rs; \
         then `NEARWALL_BLESS=1 cargo test --test library interface`",
        gone.chain(come).collect::<String>()
    ))
}

fn path() -> PathBuf {
    root().join("cpp_shim/abi.txt")
}

#[test]
fn no_change_without_another_version() {
    let fresh = fresh();
    let kept = std::fs::read_to_string(path()).unwrap_or_default();
    let bless = std::env::var_os("NEARWALL_BLESS").is_some();
    if !kept.is_empty() {
        may_follow(&kept, &fresh).unwrap_or_else(|fault| panic!("{fault}"));
    }
    if bless {
        std::fs::write(path(), fresh).unwrap();
        return;
    }
    assert!(
        kept == fresh,
        "cpp_shim/abi.txt is of another version; `NEARWALL_BLESS=1 cargo test --test library interface` writes it"
    );
}

/// Every kind of change is seen; with a risen version it passes, with a fallen one it does not.
#[test]
fn every_kind_of_change_is_refused() {
    let kept = fresh();
    // The first line that begins so, altered: its last word replaced, or the line dropped or followed by another.
    let changed = |start: &str, change: &dyn Fn(&str) -> String| {
        let line = kept.lines().find(|line| line.starts_with(start));
        let line = line.unwrap_or_else(|| panic!("no line '{start}'"));
        kept.replacen(&format!("{line}\n"), &change(line), 1)
    };
    let last_word = |word: &'static str| {
        move |line: &str| format!("{} {word}\n", line.rsplit_once(' ').map_or("", |(before, _)| before))
    };
    let with_version = |text: &str, step: i64| {
        let version = "number NW_ABI_VERSION ";
        let line = text.lines().find(|line| line.starts_with(version)).unwrap();
        let number: i64 = line[version.len()..].parse().unwrap();
        text.replace(line, &format!("{version}{}", number + step))
    };
    let changes = [
        ("a symbol goes", changed("symbol nw_resolve", &|_| String::new())),
        ("a symbol comes", changed("symbol nw_resolve", &|line| format!("{line}\n{line}_twice\n"))),
        ("a struct's size", changed("struct nw_impact size", &|line| line.replace("size ", "size 1") + "\n")),
        ("a struct's alignment", changed("struct nw_impact size", &last_word("16"))),
        ("a field moves", changed("field nw_outcome.e_n at", &|line| line.replace("at ", "at 1") + "\n")),
        ("a field's size", changed("field nw_outcome.e_n at", &last_word("4"))),
        ("a field's name", changed("field nw_impact.v_n ", &|line| line.replace("v_n", "v_normal") + "\n")),
        ("a number", changed("number NW_BAD_STATE", &last_word("77"))),
        ("an argument", changed("function nw_status nw_speeds(", &last_word("float *)"))),
        ("a type", changed("type uint32_t nw_regime", &|_| "type uint8_t nw_regime\n".to_owned())),
        ("the soname", changed("soname", &last_word("libnearwall.so.77"))),
    ];
    for (what, text) in &changes {
        let fault = may_follow(&kept, text).expect_err(what);
        assert!(fault.contains("NW_ABI_VERSION did not rise"), "{what}: {fault}");
        assert_eq!(may_follow(&kept, &with_version(text, 1)), Ok(()), "{what}, with another version");
        assert!(may_follow(&kept, &with_version(text, -1)).is_err(), "{what}, with an older version");
    }
    assert_eq!(may_follow(&kept, &kept), Ok(()));
    assert!(may_follow(&kept, "").is_err() && may_follow("", &kept).is_err());
}

/// The numbers and names of `docs/how-to/other-codes.md`, and the soname in the bindings that ask the loader for it.
#[test]
fn the_page_for_other_codes_is_true() {
    let read = |path: &str| std::fs::read_to_string(root().join(path)).unwrap();
    let (page, fresh) = (read("docs/how-to/other-codes.md"), fresh());
    let soname = fresh.lines().next().unwrap().strip_prefix("soname ").unwrap();
    for path in [
        "docs/how-to/other-codes.md",
        "build.rs",
        "bindings/python/nearwall/library.py",
        "bindings/rust/src/main.rs",
    ] {
        let text = read(path);
        let named: Vec<&str> = text.match_indices("libnearwall.so.").map(|(at, _)| &text[at..]).collect();
        assert!(!named.is_empty(), "{path} does not name the library");
        for words in named.into_iter().filter(|words| !words.starts_with("libnearwall.so.{")) {
            let whole = words.split(|c: char| !(c.is_ascii_alphanumeric() || c == '.')).next().unwrap();
            assert_eq!(whole.trim_end_matches('.'), soname, "{path}");
        }
    }
    // Every name that begins as the library's do is one of its functions, structs or numbers.
    let words = |text: &str| -> BTreeSet<String> {
        text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).map(str::to_owned).collect()
    };
    let (there, asked) = (words(&fresh), words(&page));
    let named: Vec<_> =
        asked.iter().filter(|word| word.starts_with("nw_") || word.starts_with("NW_")).collect();
    assert!(named.len() > 5, "{named:?}");
    for name in named {
        assert!(there.contains(name), "the page names {name}, which is not there");
    }
    let version = env!("CARGO_PKG_VERSION").rsplit_once('.').unwrap().0;
    let megabytes = std::fs::metadata(shared_library(Build::Shipped)).unwrap().len() as f64 / 1e6;
    let cases = read("tests/data/thornton_ning.csv").lines().count() - 1;
    let compared = read("tests/bindings/compare.py");
    let grid = compared.split(&format!("len(other) == {cases} + ")).nth(1).unwrap();
    let grid: usize = grid.split(',').next().unwrap().parse().unwrap();
    for stated in [
        format!("needs Rust {}", env!("CARGO_PKG_RUST_VERSION")),
        format!("find_package(nearwall {version} REQUIRED)"),
        format!("shared library, {megabytes:.0} MB"),
        format!("{cases} cases computed with 40 digits"),
        format!("{} impacts between languages", cases + grid),
    ] {
        assert!(page.contains(&stated), "the page does not say '{stated}'");
    }
}
