//! Everything that follows from `src/c_api` and the table of inputs: `nearwall.h`, the bindings, the documents.
//! `NEARWALL_BLESS=1 cargo test --test library interface` writes it again.
//!
//! This binary does not use what it generates, so that it compiles when generated files are out of date.

mod abi;
mod c_header;
mod write;

use std::collections::BTreeSet;
use std::path::Path;

use crate::common::compile::{Language, compiles};
use c_header::Header;
use nearwall::impact::INPUTS;

fn read(path: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

/// A text with `block` between the lines that mark its generated part.
fn with_block(text: &str, block: &str) -> String {
    let start = text.find("GENERATED").and_then(|at| Some(at + text[at..].find('\n')? + 1)).unwrap();
    let end = text[..text.find("END GENERATED").unwrap()].rfind('\n').unwrap() + 1;
    format!("{}{block}{}", &text[..start], &text[end..])
}

#[test]
fn generated_files_are_up_to_date() {
    let header = Header::generate();
    let block = |path, block: String| (path, with_block(&read(path), &block));
    let rust = "bindings/rust/src/main.rs";
    let files = [
        ("cpp_shim/nearwall.h", header.text.clone()),
        block("bindings/fortran/nearwall.f90", write::fortran(&header)),
        block("bindings/python/nearwall/library.py", write::python(&header)),
        block(rust, write::rust_example(&header, &read(rust))),
        ("tests/c_api/interface.rs", write::rust_tests(&header)),
        block("docs/reference/data-file.md", write::inputs_table()),
        ("fuzz/words.dict", words(&read("fuzz/words.dict"))),
    ];
    for (path, fresh) in files {
        let place = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
        if std::env::var_os("NEARWALL_BLESS").is_some() {
            // Atomically: the other tests read it meanwhile.
            let draft = place.with_extension("new");
            std::fs::write(&draft, fresh).unwrap();
            std::fs::rename(draft, place).unwrap();
            continue;
        }
        let kept = std::fs::read_to_string(place).unwrap_or_default();
        let differs = kept.lines().zip(fresh.lines()).position(|(kept, fresh)| kept != fresh);
        assert!(
            kept == fresh,
            "{path} is out of date from line {} on; `NEARWALL_BLESS=1 cargo test --test library interface` writes it again",
            differs.unwrap_or(kept.lines().count().min(fresh.lines().count())) + 1
        );
    }
}

/// The fuzzer's words, with the name of every input.
fn words(kept: &str) -> String {
    let names = INPUTS.iter().map(|input| format!("\"{}\"", input.name));
    let words: BTreeSet<String> = kept.lines().map(str::to_owned).chain(names).collect();
    words.into_iter().map(|word| word + "\n").collect()
}

/// Functions without a wrapper, and why.
const NOT_WRAPPED: [(&str, &[&str]); 2] = [
    // No C++ of their own.
    ("cpp_shim/nearwall.hpp", &["nw_regime_name"]),
    // `Model.resolve` hands arrays over, also for one impact; REGIMES has the names.
    ("bindings/python/nearwall/library.py", &["nw_resolve", "nw_outcome_init", "nw_regime_name"]),
];

/// The functions that a text calls outside its generated part.
fn not_called<'a>(header: &'a Header, text: &str) -> BTreeSet<&'a str> {
    let text = if text.contains("END GENERATED") { with_block(text, "") } else { text.to_owned() };
    let code: Vec<&str> = text.lines().map(|line| line.split("//").next().unwrap()).collect();
    let words: BTreeSet<&str> =
        code.iter().flat_map(|line| line.split(|c: char| !(c.is_alphanumeric() || c == '_'))).collect();
    header
        .functions
        .iter()
        .map(|function| function.name.as_str())
        .filter(|name| !words.contains(name))
        .collect()
}

#[test]
fn bindings_call_every_function() {
    let mut header = Header::generate();
    assert!(header.functions.len() > 15 && header.structs.len() == 11, "the header is not parsed");
    for (path, left_out) in NOT_WRAPPED {
        let expected: BTreeSet<&str> = left_out.iter().copied().collect();
        assert_eq!(not_called(&header, &read(path)), expected, "{path} does not call them");
    }
    header.functions[0].name = "nw_more".to_owned();
    for (path, _) in NOT_WRAPPED {
        assert!(not_called(&header, &read(path)).contains("nw_more"), "{path}");
    }
}

const C: [Language; 3] = [Language::C("c99"), Language::C("c11"), Language::C("c17")];
const CPP: [Language; 3] = [Language::Cpp("c++11"), Language::Cpp("c++17"), Language::Cpp("c++20")];

#[test]
fn the_headers_compile_alone_and_included_twice() {
    for language in C.into_iter().chain(CPP) {
        compiles(language, "#include \"nearwall.h\"\n#include \"nearwall.h\"\nint unused_;\n");
    }
    for language in CPP {
        compiles(language, "#include \"nearwall.hpp\"\n#include \"nearwall.hpp\"\nint unused_;\n");
    }
}
