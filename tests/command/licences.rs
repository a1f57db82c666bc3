//! Licences, versions and sources of the dependencies follow the rules of `deny.toml`, which `cargo deny` reads, too.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use toml_edit::{Array, DocumentMut, InlineTable};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(file: &str) -> DocumentMut {
    std::fs::read_to_string(root().join(file)).unwrap().parse().unwrap()
}

fn strings(array: Option<&Array>) -> Vec<&str> {
    array.unwrap().iter().map(|one| one.as_str().unwrap()).collect()
}

/// The entries of a list whose elements are tables with the key `crate`.
fn entries(array: Option<&Array>) -> Vec<(&str, &InlineTable)> {
    let tables = array.unwrap().iter().map(|one| one.as_inline_table().unwrap());
    tables.map(|table| (table["crate"].as_str().unwrap(), table)).collect()
}

/// Name, version and licence of every crate that compiles or is part of library, command and Python
/// module, on the machines of `deny.toml`.
fn compiled(rules: &DocumentMut) -> BTreeSet<[String; 3]> {
    let mut crates = BTreeSet::new();
    for machine in strings(rules["graph"]["targets"].as_array()) {
        let output = Command::new(env!("CARGO"))
            .args(["tree", "--locked", "--quiet", "--all-features", "--edges", "normal,build"])
            .args(["-p", "nearwall", "-p", "nearwall-lab", "-p", "nearwall-python"])
            .args(["--prefix", "none", "--no-dedupe", "--format", "{p} | {l}", "--target", machine])
            .current_dir(root())
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        for line in String::from_utf8(output.stdout).unwrap().lines().filter(|line| !line.is_empty()) {
            let (package, licence) = line.split_once(" | ").unwrap();
            let mut words = package.split(' ');
            let mut word = || words.next().unwrap().to_owned();
            crates.insert([word(), word(), licence.to_owned()]);
        }
    }
    assert!(crates.len() > 100);
    crates
}

/// Whether an SPDX expression holds when these licences are accepted.
fn holds(expression: &str, accepted: &[&str]) -> bool {
    let spaced = expression.replace('/', " OR ").replace('(', " ( ").replace(')', " ) ");
    let spaced = spaced.replace(" or ", " OR ").replace(" and ", " AND ");
    let mut words = spaced.split_whitespace().peekable();
    let value = either(&mut words, accepted);
    assert!(words.next().is_none(), "{expression}");
    value
}

type Words<'a> = std::iter::Peekable<std::str::SplitWhitespace<'a>>;

fn either(words: &mut Words, accepted: &[&str]) -> bool {
    let mut value = all(words, accepted);
    while words.next_if_eq(&"OR").is_some() {
        value |= all(words, accepted);
    }
    value
}

fn all(words: &mut Words, accepted: &[&str]) -> bool {
    let mut value = one(words, accepted);
    while words.next_if_eq(&"AND").is_some() {
        value &= one(words, accepted);
    }
    value
}

fn one(words: &mut Words, accepted: &[&str]) -> bool {
    let name = words.next().unwrap();
    if name == "(" {
        let value = either(words, accepted);
        assert_eq!(words.next(), Some(")"));
        return value;
    }
    match words.next_if_eq(&"WITH") {
        Some(_) => accepted.contains(&format!("{name} WITH {}", words.next().unwrap()).as_str()),
        None => accepted.contains(&name),
    }
}

#[test]
fn an_expression_of_licences_is_understood() {
    for (expression, expected) in [
        ("MIT", true),
        ("GPL-3.0-only", false),
        ("MIT/GPL-3.0-only", true),
        ("GPL-3.0-only or MIT", true),
        ("GPL-3.0-only OR MIT AND Zlib", false),
        ("(GPL-3.0-only OR MIT) AND Apache-2.0", true),
        ("(MIT OR Apache-2.0) AND Unicode-3.0", false),
        ("Apache-2.0 WITH LLVM-exception", false),
        ("Apache-2.0 WITH LLVM-exception OR MIT", true),
    ] {
        assert_eq!(holds(expression, &["MIT", "Apache-2.0"]), expected, "{expression}");
    }
}

/// The licences that one crate may have.
fn accepted<'a>(rules: &'a DocumentMut, name: &str) -> Vec<&'a str> {
    let licences = &rules["licenses"];
    let exceptions = entries(licences["exceptions"].as_array()).into_iter();
    let own = exceptions.filter(|(crate_name, _)| *crate_name == name);
    let own = own.flat_map(|(_, entry)| strings(entry["allow"].as_array()));
    strings(licences["allow"].as_array()).into_iter().chain(own).collect()
}

#[test]
fn licences_follow_the_rules() {
    let rules = read("deny.toml");
    for [name, version, licence] in compiled(&rules) {
        assert!(holds(&licence, &accepted(&rules, &name)), "{name} {version}: {licence}, see deny.toml");
    }
}

#[test]
fn crates_come_from_one_registry() {
    for package in read("Cargo.lock")["package"].as_array_of_tables().unwrap() {
        if let Some(source) = package.get("source") {
            let name = &package["name"];
            assert_eq!(
                source.as_str(),
                Some("registry+https://github.com/rust-lang/crates.io-index"),
                "{name}"
            );
        }
    }
}

#[test]
fn no_crate_comes_in_twice_without_a_reason() {
    let rules = read("deny.toml");
    let skip = entries(rules["bans"]["skip"].as_array());
    let skip: BTreeSet<&str> = skip.into_iter().map(|(crate_name, _)| crate_name).collect();
    let mut versions: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for [name, version, _] in compiled(&rules) {
        versions.entry(name).or_default().insert(version.trim_start_matches('v').to_owned());
    }
    versions.retain(|_, versions| versions.len() > 1);
    let mut used = BTreeSet::new();
    for (name, versions) in &versions {
        let reason = |version: &String| {
            skip.iter().find(|asked| format!("{name}@{version}.").starts_with(&format!("{asked}.")))
        };
        let reasons: Vec<&str> = versions.iter().filter_map(reason).copied().collect();
        assert!(reasons.len() + 1 >= versions.len(), "{name} comes in as {versions:?}, see deny.toml");
        used.extend(reasons);
    }
    assert_eq!(used, skip, "deny.toml skips a crate that comes in once");
}
