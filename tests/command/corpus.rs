//! Replays the corpus of the fuzzer (`fuzz/corpus`, `fuzz/run`) on the same targets.

#[path = "../../fuzz/src/lib.rs"]
mod fuzz_targets;

use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn what_the_fuzzer_kept_breaks_nothing() {
    let corpus = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/..")).join("fuzz/corpus");
    for (name, target) in fuzz_targets::TARGETS {
        let begun = std::time::Instant::now();
        let mut files: Vec<_> =
            std::fs::read_dir(corpus.join(name)).unwrap().map(|entry| entry.unwrap().path()).collect();
        files.sort();
        assert!(files.len() >= 50, "{name}: {} files", files.len());
        for file in &files {
            // The message of a panic does not name the file.
            let bytes = std::fs::read(file).unwrap();
            let done = std::panic::catch_unwind(|| target(&bytes));
            assert!(done.is_ok(), "{} breaks {name}", file.display());
        }
        println!("{name}: {} files, {:.1} s", files.len(), begun.elapsed().as_secs_f64());
    }
}

/// Functions that a text calls or declares: names that begin with `nw_` before a bracket, comments left out.
fn functions(text: &str) -> BTreeSet<&str> {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    let before_brackets = code.flat_map(|line| line.match_indices('(').map(move |(at, _)| &line[..at]));
    let in_a_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let names = before_brackets.map(|code| &code[code.trim_end_matches(in_a_name).len()..]);
    names.filter(|name| name.starts_with("nw_")).collect()
}

#[test]
fn the_fuzzer_calls_every_entry_of_the_header() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let header = std::fs::read_to_string(root.join("cpp_shim/nearwall.h")).unwrap();
    let files = std::fs::read_dir(root.join("fuzz/src/c_api")).unwrap();
    let files: Vec<String> =
        files.map(|file| std::fs::read_to_string(file.unwrap().path()).unwrap()).collect();
    let called: BTreeSet<&str> = files.iter().flat_map(|text| functions(text)).collect();
    let declared = functions(&header);
    assert!(declared.len() > 15, "{declared:?}");
    let missing: Vec<_> = declared.difference(&called).collect();
    assert!(missing.is_empty(), "fuzz/src/c_api does not call {missing:?}");
}
