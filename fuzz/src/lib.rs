//! What is fuzzed: one function a door. Each takes any bytes and panics where a promise of nearwall is broken. The fuzzer
//! (`fuzz/run`) and the replay of what it found (`tests/library/corpus.rs`) call the same functions.

mod bytes;
mod c_api;
mod case;
mod dataset;
mod diagnose;
mod model;
mod openfoam;

pub use c_api::c_api;
pub use case::case;
pub use dataset::dataset;
pub use diagnose::diagnose;
pub use model::model;
pub use openfoam::openfoam;

/// A door: what it is called, and what is fed.
pub type Target = (&'static str, fn(&[u8]));

/// Every door, by the name of its folder in `fuzz/corpus`.
pub const TARGETS: [Target; 6] = [
    ("model", model),
    ("case", case),
    ("dataset", dataset),
    ("diagnose", diagnose),
    ("openfoam", openfoam),
    ("c_api", c_api),
];

/// An error names the file and a place that is in it.
fn place(error: &str, file: &str, text: &str) {
    let rest = error.strip_prefix(file).and_then(|rest| rest.strip_prefix(':'));
    let mut parts = rest.unwrap_or_else(|| panic!("no file in: {error}")).splitn(3, ':');
    let mut number = || parts.next().and_then(|part| part.parse::<usize>().ok());
    let (line, column) = (number(), number());
    let (line, column) = line.zip(column).unwrap_or_else(|| panic!("no place in: {error}"));
    let lines = text.split('\n').count();
    assert!((1..=lines).contains(&line), "line {line} of {lines}: {error}");
    let width = text.split('\n').nth(line - 1).unwrap_or("").chars().count();
    assert!((1..=width + 1).contains(&column), "column {column} of {width}: {error}");
    assert!(!error.contains("panicked"), "{error}");
}

/// A page that is whole, and whose figures have a number wherever a browser needs one.
fn whole(page: &str) {
    assert!(page.contains("</html>") && page.len() > 1000);
    for bare in ["=\"NaN\"", "=\"inf\"", "=\"-inf\""] {
        assert!(!page.contains(bare), "{bare}");
    }
    for path in [" d=\"", " points=\"", " transform=\""] {
        let ends = page.split(path).skip(1).filter_map(|rest| rest.split('"').next());
        for drawn in ends {
            assert!(!drawn.contains("NaN") && !drawn.contains("inf"), "{drawn}");
        }
    }
}
