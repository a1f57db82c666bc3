//! A finished OpenFOAM case as `report` reads it.
//!
//! The bytes are the files of a case, each after a zero: a letter selects a file of
//! [`DAMAGED_PLACES`], the rest is its text. The bytes before the first zero are the table of runs
//! that `report` accepts instead of a case.

use std::path::Path;

use nearwall_lab::report::{openfoam_page, sweep};
use nearwall_lab::results::openfoam::read;
use nearwall_lab::results::{RunResults, WallModel};

use super::whole;

/// Files of a case, from `a` on.
const DAMAGED_PLACES: [&str; 23] = [
    "constant/polyMesh/boundary",
    "constant/wallInteraction",
    "constant/coalProperties",
    "log.solver",
    "log.again",
    "postProcessing/nearWallInteraction/coal/0/slag.dat",
    "postProcessing/nearWallInteraction/coal/0.5/slag.dat",
    "postProcessing/nearWallInteraction/coal/0/balance.dat",
    "postProcessing/nearWallInteraction/coal/0/slag.distributions.dat",
    "postProcessing/nearWallInteraction/coal/0.5/slag.distributions.dat",
    "postProcessing/nearWallInteraction/coal/0/slag.wall.dat",
    "postProcessing/nearWallInteraction/coal/0/(slag|quench).dat",
    "postProcessing/nearWallInteraction/clay/0/quench.dat",
    "postProcessing/lagrangian/coal/walls/0/slag.post",
    "postProcessing/lagrangian/coal/walls/0.5/quench.post",
    "0.1/lagrangian/coal/positions",
    "0.1/lagrangian/coal/active",
    "0.1/lagrangian/coal/d",
    "0.1/lagrangian/coal/rho",
    "0.1/lagrangian/coal/nParticle",
    "0.1/lagrangian/coalDeposit/positions",
    "0.1/lagrangian/coalDeposit/d",
    "0.1/lagrangian/coalDeposit/mass",
];

const BOUNDARY: &str =
    "2\n(\nslag\n{\n type wall;\n}\nquench\n{\n type wall;\n}\noutlet\n{\n type patch;\n}\n)\n";

/// Any files are refused in words, or make a page.
pub fn openfoam(bytes: &[u8]) {
    let folder = scratch();
    let mut parts = bytes.split(|byte| *byte == 0);
    let table = parts.next().unwrap_or_default();
    if !table.is_empty() {
        runs(folder.path(), table);
    }
    let case = folder.path().join("case");
    put(&case, "system/controlDict", b"");
    put(&case, DAMAGED_PLACES[0], BOUNDARY.as_bytes());
    put(&case, DAMAGED_PLACES[1], b"patchInteractionModel nearWallInteraction;");
    for part in parts.take(30) {
        if let [place, content @ ..] = part {
            put(&case, DAMAGED_PLACES[usize::from(place.wrapping_sub(b'a')) % DAMAGED_PLACES.len()], content);
        }
    }
    match read(&case) {
        Err(error) => words(&error.to_string(), "case"),
        Ok(results) => pages(&results),
    }
}

/// A temporary folder, in memory where possible, which is some forty times faster.
fn scratch() -> tempfile::TempDir {
    let memory = tempfile::tempdir_in("/dev/shm").or_else(|_| tempfile::tempdir());
    memory.expect("a scratch folder")
}

fn put(case: &Path, place: &str, content: &[u8]) {
    let path = case.join(place);
    std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
    std::fs::write(path, content).expect("a file");
}

fn words(said: &str, file: &str) {
    assert!(said.contains(file) && said.len() > 10 && !said.contains("panicked"), "{said}");
}

/// The page of the case alone, and beside one with another wall model.
fn pages(results: &[RunResults]) {
    whole(&openfoam_page(results).expect("a page"));
    let stock = results.iter().map(|result| RunResults {
        case: "stock".into(),
        wall_model: WallModel::Other("localInteraction".into()),
        ..result.clone()
    });
    let beside: Vec<RunResults> = results.iter().cloned().chain(stock).collect();
    whole(&openfoam_page(&beside).expect("a page"));
}

fn runs(folder: &Path, table: &[u8]) {
    let path = folder.join("runs.csv");
    std::fs::write(&path, table).expect("a file");
    match sweep::page(&path) {
        Err(error) => words(&error.to_string(), "runs.csv"),
        Ok(page) => whole(&page),
    }
}
