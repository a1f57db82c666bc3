//! Everything that the fuzzer kept (`fuzz/corpus`, `fuzz/run`), fed to the same functions without a fuzzer.
#![allow(unsafe_code, reason = "the C interface is one of the doors")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may fail")]
#![allow(missing_docs, reason = "the doors belong to the fuzzer's own workspace")]

#[path = "../fuzz/src/lib.rs"]
mod doors;

use std::path::Path;

#[test]
fn what_the_fuzzer_kept_breaks_nothing() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus");
    for (name, feed) in doors::TARGETS {
        let mut files: Vec<_> =
            std::fs::read_dir(corpus.join(name)).unwrap().map(|entry| entry.unwrap().path()).collect();
        files.sort();
        assert!(files.len() > 50, "{name}: {} files", files.len());
        for file in &files {
            // The name comes before a panic's own words.
            let bytes = std::fs::read(file).unwrap();
            let done = std::panic::catch_unwind(|| feed(&bytes));
            assert!(done.is_ok(), "{} breaks {name}", file.display());
        }
        println!("{name}: {} files", files.len());
    }
}
