//! Licences, versions and sources of the dependencies follow the rules of `deny.toml`, which `cargo deny` reads, too.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

use serde_json::Value;
use toml_edit::{Array, DocumentMut, InlineTable};

fn text(value: &Value) -> &str {
    value.as_str().unwrap()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

fn strings(array: Option<&Array>) -> Vec<&str> {
    array.unwrap().iter().map(|one| one.as_str().unwrap()).collect()
}

/// The entries of a list whose elements are tables with the key `crate`.
fn entries(array: Option<&Array>) -> Vec<(&str, &InlineTable)> {
    let tables = array.unwrap().iter().map(|one| one.as_inline_table().unwrap());
    tables.map(|table| (table["crate"].as_str().unwrap(), table)).collect()
}

fn rules() -> DocumentMut {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../deny.toml");
    std::fs::read_to_string(file).unwrap().parse().unwrap()
}

/// What cargo says of the workspace and its dependencies on one machine.
fn metadata(machine: &str) -> Value {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--all-features", "--locked"])
        .args(["--filter-platform", machine])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Packages that a member of the workspace needs to be built, by their identity; those that only tests need are left out.
fn needed(metadata: &Value) -> BTreeSet<&str> {
    let nodes: BTreeMap<&str, &Value> =
        list(&metadata["resolve"]["nodes"]).iter().map(|node| (text(&node["id"]), node)).collect();
    let mut open: Vec<&str> = list(&metadata["workspace_members"]).iter().map(text).collect();
    let mut found = BTreeSet::new();
    while let Some(id) = open.pop() {
        if !found.insert(id) {
            continue;
        }
        let built = |other: &&Value| list(&other["dep_kinds"]).iter().any(|kind| kind["kind"] != "dev");
        open.extend(list(&nodes[id]["deps"]).iter().filter(built).map(|other| text(&other["pkg"])));
    }
    found
}

/// Whether an SPDX expression holds when these licences are accepted.
fn holds(expression: &str, accepted: &[&str]) -> bool {
    let spaced = expression.replace('/', " OR ").replace('(', " ( ").replace(')', " ) ");
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
fn licences_and_sources_follow_the_rules() {
    let rules = rules();
    for machine in strings(rules["graph"]["targets"].as_array()) {
        for package in list(&metadata(machine)["packages"]) {
            let (name, source) = (text(&package["name"]), package["source"].as_str());
            let licence = package["license"].as_str().unwrap_or_default();
            assert!(holds(licence, &accepted(&rules, name)), "{name}: licence {licence:?}, see deny.toml");
            if let Some(source) = source {
                assert_eq!(source, "registry+https://github.com/rust-lang/crates.io-index", "{name}");
                continue;
            }
            for dependency in list(&package["dependencies"]) {
                let stated = dependency["req"] != "*" || dependency["path"].is_string();
                assert!(stated, "{name} takes any version of {}", dependency["name"]);
            }
        }
    }
}

#[test]
fn no_crate_comes_in_twice_without_a_reason() {
    let rules = rules();
    let skip = entries(rules["bans"]["skip"].as_array());
    let skip: BTreeSet<&str> = skip.into_iter().map(|(crate_name, _)| crate_name).collect();
    let mut twice = BTreeSet::new();
    for machine in strings(rules["graph"]["targets"].as_array()) {
        let metadata = metadata(machine);
        let needed = needed(&metadata);
        assert!(needed.len() > 100);
        let mut versions: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        let packages = list(&metadata["packages"]).iter();
        for package in packages.filter(|package| needed.contains(text(&package["id"]))) {
            versions.entry(text(&package["name"])).or_default().insert(text(&package["version"]));
        }
        for (name, versions) in versions.iter().filter(|(_, versions)| versions.len() > 1) {
            let reason = |version: &str| {
                let entry = |asked: &str| asked.strip_prefix(name)?.strip_prefix('@').map(str::to_owned);
                let fits = |asked: String| version == asked || version.starts_with(&format!("{asked}."));
                skip.iter().copied().find(|asked| entry(asked).is_some_and(fits))
            };
            let reasons: Vec<&str> = versions.iter().filter_map(|version| reason(version)).collect();
            assert!(reasons.len() + 1 >= versions.len(), "{name} comes in as {versions:?}, see deny.toml");
            twice.extend(reasons);
        }
    }
    assert_eq!(twice, skip, "deny.toml skips a crate that comes in once");
}
