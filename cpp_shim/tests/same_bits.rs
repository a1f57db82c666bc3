//! The C++ shim decides as the Rust library does, bit for bit, and its exceptions carry the library's words.
#![allow(unsafe_code, reason = "arrays of the C interface")]
#![allow(clippy::unwrap_used, reason = "clippy.toml's leave for tests does not reach their helpers")]

#[path = "../../tests/common/golden.rs"]
mod golden;
#[path = "../../tests/common/random.rs"]
mod random;

use golden::golden_cases;
use nearwall::c_api::{nw_impact, nw_impacts, nw_outcome, nw_outcomes};
use nearwall::impact::{INPUTS, Input};
use nearwall::{Impact as RustImpact, ImpactRng, Model, Outcome as RustOutcome};
use nearwall_cpp_shim::{Impact, Impacts, Outcome, Outcomes, ffi};
use random::{Case, EVERY_REGIME, hostile_cases, random_cases, seed};

fn cpp_impact(&(wall, impact, draw): &Case) -> Impact {
    let wall = u32::try_from(wall).unwrap();
    Impact(nw_impact { wall, seed: draw.seed, key: draw.key, ..nw_impact::from(&impact) })
}

/// Every bit of an outcome, from C++ and from Rust.
type Bits = [u64; 7];

fn cpp_bits(outcome: &nw_outcome) -> Bits {
    let nw_outcome { regime, stuck, flags, e_n, e_t, p_stick, omega, .. } = *outcome;
    let [e_n, e_t, p_stick, omega] = [e_n, e_t, p_stick, omega].map(f64::to_bits);
    [regime.into(), stuck.into(), flags.into(), e_n, e_t, p_stick, omega]
}

fn rust_bits(outcome: &RustOutcome) -> Bits {
    [
        outcome.regime as u64,
        outcome.stuck.into(),
        outcome.outside_range.into(),
        outcome.normal_restitution.to_bits(),
        outcome.tangential_restitution.to_bits(),
        outcome.sticking_probability.to_bits(),
        outcome.spin.to_bits(),
    ]
}

fn both(toml: &str) -> (cxx::UniquePtr<ffi::Model>, Model) {
    (ffi::from_toml(toml, "test.toml").unwrap(), Model::from_toml("test.toml", toml).unwrap())
}

#[test]
fn golden_cases_have_the_same_bits() {
    for (row, case) in golden_cases().iter().enumerate() {
        let (cpp, rust) = both(&case.model());
        let impact = RustImpact { normal_speed: case.v_n, diameter: case.d, ..RustImpact::default() };
        let case = (0, impact, ImpactRng::default());
        let ours = ffi::resolve(&cpp, &cpp_impact(&case)).unwrap();
        let theirs = rust.resolve(0, &impact, ImpactRng::default()).unwrap();
        assert_eq!(cpp_bits(&ours.0), rust_bits(&theirs), "case {row}");
        let speeds = rust.speeds(0, &impact).unwrap();
        let [adhesive, yielding, sticking] = ffi::speeds(&cpp, &cpp_impact(&case)).unwrap();
        let ranges = rust.temperature_ranges(0).unwrap();
        let found = ffi::ranges(&cpp, 0).unwrap();
        assert_eq!(found, [ranges.particle[0], ranges.particle[1], ranges.wall[0], ranges.wall[1]]);
        assert_eq!([adhesive, yielding, sticking], [speeds.adhesive, speeds.yielding, speeds.sticking]);
    }
}

#[test]
fn random_and_hostile_cases_have_the_same_bits_or_fail_alike() {
    let (cpp, rust) = both(EVERY_REGIME);
    let cases = [random_cases(seed(), 1200), hostile_cases()].concat();
    let (mut regimes, mut stuck, mut failed) = ([0; 4], 0, 0);
    for case in &cases {
        let mut outcome = Outcome(nw_outcome { e_n: 4321.0, ..nw_outcome::default() });
        let status = ffi::resolve_status(&cpp, &cpp_impact(case), &mut outcome);
        match (ffi::resolve(&cpp, &cpp_impact(case)), rust.resolve(case.0, &case.1, case.2)) {
            (Ok(ours), Ok(theirs)) => {
                assert_eq!(cpp_bits(&ours.0), rust_bits(&theirs), "{case:?}");
                assert_eq!((status, cpp_bits(&outcome.0)), (0, cpp_bits(&ours.0)), "{case:?}");
                regimes[theirs.regime as usize] += 1;
                stuck += u32::from(theirs.stuck);
            }
            (Err(ours), Err(theirs)) => {
                assert!(ours.what().starts_with("nw_resolve: "), "{ours}: {theirs}");
                assert!((6..=8).contains(&status) && outcome.0.e_n == 4321.0, "{case:?}");
                failed += 1;
            }
            (ours, theirs) => panic!("{case:?}: C++ {:?}, Rust {theirs:?}", ours.is_ok()),
        }
    }
    println!("{} impacts: regimes {regimes:?}, {stuck} stuck, {failed} refused", cases.len());
    assert!(regimes.iter().all(|count| *count > 10) && stuck > 50 && failed > 50);
}

#[test]
fn batches_are_one_by_one() {
    let (cpp, rust) = both(EVERY_REGIME);
    let mut cases = random_cases(seed(), 600);
    cases.retain(|(wall, impact, draw)| rust.resolve(*wall, impact, *draw).is_ok());
    let impacts: Vec<Impact> = cases.iter().map(cpp_impact).collect();
    let expected: Vec<Bits> = cases
        .iter()
        .map(|(wall, impact, draw)| rust_bits(&rust.resolve(*wall, impact, *draw).unwrap()))
        .collect();

    let mut each = vec![Outcome(nw_outcome::default()); cases.len()];
    ffi::resolve_each(&cpp, &impacts, &mut each).unwrap();
    assert_eq!(each.iter().map(|outcome| cpp_bits(&outcome.0)).collect::<Vec<_>>(), expected);

    let e_n = arrays(&cpp, &cases).unwrap();
    assert_eq!(
        e_n.iter().map(|e_n| e_n.to_bits()).collect::<Vec<_>>(),
        expected.iter().map(|b| b[3]).collect::<Vec<_>>()
    );
}

/// `e_n` of a batch of arrays; untouched entries would be -1.
fn arrays(cpp: &ffi::Model, cases: &[Case]) -> Result<Vec<f64>, String> {
    let walls: Vec<u32> = cases.iter().map(|case| case.0 as u32).collect();
    let column = |input: &Input| cases.iter().map(|case| (input.value)(&case.1)).collect();
    let columns: Vec<Vec<f64>> = INPUTS.iter().map(column).collect();
    let keys: Vec<u64> = cases.iter().map(|case| case.2.key).collect();
    let (count, seed) = (cases.len(), cases[0].2.seed);
    let mut impacts =
        nw_impacts { count, seed, walls: walls.as_ptr(), key: keys.as_ptr(), ..nw_impacts::default() };
    for (array, column) in impacts.columns_mut().into_iter().zip(&columns) {
        *array = column.as_ptr();
    }
    let mut e_n = vec![-1.0; count];
    let (impacts, outcomes) =
        (Impacts(impacts), Outcomes(nw_outcomes { e_n: e_n.as_mut_ptr(), ..nw_outcomes::default() }));
    // SAFETY: every array that is given has an entry for each case.
    match unsafe { ffi::resolve_arrays(cpp, &impacts, &outcomes) } {
        Ok(()) => Ok(e_n),
        Err(error) => {
            assert!(e_n.iter().all(|e_n| *e_n == -1.0), "something was written");
            Err(error.what().to_owned())
        }
    }
}

#[test]
fn exceptions_carry_the_librarys_words() {
    let what = |toml: &str| ffi::from_toml(toml, "mine.toml").err().unwrap().what().to_owned();
    for toml in ["x = = 1", "nothing = 1", &EVERY_REGIME.replace("fly-ash", "fly-ach"), "a\0b = 1", "ü = 1"]
    {
        let rust = Model::from_toml("mine.toml", toml).unwrap_err().to_string();
        assert_eq!(what(toml), rust);
    }
    let missing = ffi::from_file("/nowhere/nearWall.toml").err().unwrap();
    let rust = Model::from_file("/nowhere/nearWall.toml".as_ref()).unwrap_err();
    assert_eq!(missing.what(), rust.to_string());
    let cut = ffi::from_file("/dev/null\0/nearWall.toml").err().unwrap();
    assert_eq!(cut.what(), "the path has a zero in it: /dev/null");

    let (cpp, _) = both(EVERY_REGIME);
    let wall = |name| ffi::find_wall(&cpp, name).map_err(|error| error.what().to_owned());
    assert_eq!((wall("slag"), wall("quenchRing")), (Ok(1), Ok(2)));
    assert_eq!(wall("roof").unwrap_err(), "wall 'roof': the model has no such wall");
    assert_eq!(wall("slag\0x").unwrap_err(), "the wall's name has a zero in it: slag");

    let mut cases = random_cases(1, 20);
    for case in &mut cases {
        case.0 = 0;
    }
    cases[17].1.diameter = 0.0;
    let impacts: Vec<Impact> = cases.iter().map(cpp_impact).collect();
    let mut each = vec![Outcome(nw_outcome::default()); cases.len()];
    let error = ffi::resolve_each(&cpp, &impacts, &mut each).unwrap_err();
    assert!(error.what().starts_with("impact 17: an input is not finite or outside its bounds"), "{error}");
    assert_eq!(arrays(&cpp, &cases).unwrap_err(), error.what());
}

#[test]
fn models_move() {
    ffi::move_about(EVERY_REGIME).unwrap();
}
