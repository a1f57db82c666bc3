//! The fuzz targets. Each takes any bytes and panics if nearwall violates one of its guarantees.
//! The fuzzer (`fuzz/run`) and the replay of its corpus (`tests/library/corpus.rs`) call the same
//! functions.

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

/// Name and function of a target.
pub type FuzzTarget = (&'static str, fn(&[u8]));

/// All targets, named as their folders in `fuzz/corpus`.
pub const TARGETS: [FuzzTarget; 6] = [
    ("model", model),
    ("case", case),
    ("dataset", dataset),
    ("diagnose", diagnose),
    ("openfoam", openfoam),
    ("c_api", c_api),
];

/// Asserts that an error names the file and a position in it.
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

/// Asserts that a page is complete and that its figures contain numbers wherever a browser needs one.
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
