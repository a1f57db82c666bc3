//! `cpp_shim/nearwall.h` is what cbindgen writes from `src/c_api`, and it compiles wherever it should.

use std::path::Path;

use crate::common::compile::{Language, compiles};

/// The header as cbindgen writes it now.
fn generated() -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(root.join("cbindgen.toml")).unwrap();
    let builder = cbindgen::Builder::new().with_config(config).with_src(root.join("src/c_api/mod.rs"));
    let mut text = Vec::new();
    builder.generate().unwrap().write(&mut text);
    String::from_utf8(text).unwrap()
}

#[test]
fn the_header_in_the_repository_is_the_generated_one() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cpp_shim/nearwall.h");
    let fresh = generated();
    if std::env::var_os("NEARWALL_BLESS").is_some() {
        // Whole or not at all: the other test compiles it meanwhile.
        let draft = path.with_extension("h.new");
        std::fs::write(&draft, fresh).unwrap();
        std::fs::rename(draft, path).unwrap();
        return;
    }
    let kept = std::fs::read_to_string(&path).unwrap();
    let place = kept.lines().zip(fresh.lines()).position(|(kept, fresh)| kept != fresh);
    assert!(
        kept == fresh,
        "cpp_shim/nearwall.h differs from src/c_api from line {} on; \
         `NEARWALL_BLESS=1 cargo test --test c_api header` writes it again",
        place.map_or(kept.lines().count().min(fresh.lines().count()), |line| line) + 1
    );
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
