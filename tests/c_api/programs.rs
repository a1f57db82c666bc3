//! C and C++ programs of `tests/c`, compiled with strict warnings, linked to the library and run.

use std::path::Path;

use nearwall::c_api::nw_impact;
use nearwall::{Impact, ImpactRng, Model};

use crate::calls::{c_case, c_outcome};
use crate::common::compile::{Build, Language, Program, compiles, next_version, shared_library};
use crate::common::golden::{Golden, golden_cases};
use crate::common::random::{Case, EVERY_REGIME, hostile_cases, random_cases, seed};
use crate::interface::{for_each_number, for_each_struct};

const BUILDS: [Build; 2] = [Build::Tested, Build::Shipped];

#[test]
fn a_c99_program_gets_the_golden_bits() {
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/thornton_ning.csv");
    let bits = |numbers: [f64; 4]| numbers.map(|number| format!("{:016x} ", number.to_bits())).concat();
    let rust = |golden: &Golden| {
        let model = Model::from_toml("m", &golden.model()).unwrap();
        let impact = golden_impact(golden);
        let (outcome, speeds) =
            (model.resolve(0, &impact, ImpactRng::default()), model.speeds(0, &impact).unwrap());
        bits([outcome.unwrap().normal_restitution, speeds.adhesive, speeds.yielding, speeds.sticking])
    };
    let expected: Vec<String> = golden_cases().iter().map(rust).collect();
    for build in BUILDS {
        let printed = Program::build(Language::C("c99"), "golden.c", build).run(&[&table]);
        assert_eq!(printed.lines().collect::<Vec<_>>(), expected, "{build:?}");
    }
}

#[test]
fn a_cpp11_program_gets_the_bits_and_the_exceptions() {
    let model = Model::from_toml("m", EVERY_REGIME).unwrap();
    let mut cases = random_cases(seed(), 500);
    cases.retain(|(wall, impact, draw)| model.resolve(*wall, impact, *draw).is_ok());
    let expected: Vec<u8> = cases
        .iter()
        .flat_map(|(wall, impact, draw)| c_outcome(&model.resolve(*wall, impact, *draw).unwrap()))
        .collect();
    for (language, build) in
        [(Language::Cpp("c++11"), Build::Tested), (Language::Cpp("c++17"), Build::Shipped)]
    {
        let program = Program::build(language, "shim.cpp", build);
        write(program.folder(), 0, EVERY_REGIME, &cases);
        let printed = program.run(&[program.folder()]);
        assert_eq!(printed, format!("{} impacts, 8 threads\n", cases.len()));
        assert!(std::fs::read(program.folder().join("outcomes.bin")).unwrap() == expected);
    }
}

/// The optimised library, because optimised code computes both sides of a branch.
#[test]
#[cfg(target_arch = "x86_64")]
fn any_floating_point_state_is_survived_and_kept() {
    let program = Program::build(Language::C("c99"), "floating_point_state.c", Build::Shipped);
    let hostile: Vec<Case> = hostile_cases().into_iter().step_by(21).collect();
    let cases = [random_cases(seed(), 300), hostile].concat();
    write(program.folder(), 0, EVERY_REGIME, &cases);
    let golden = golden_cases();
    for (row, golden) in golden.iter().enumerate() {
        write(
            program.folder(),
            row + 1,
            &golden.model(),
            &[(0, golden_impact(golden), ImpactRng::default())],
        );
    }
    println!("{}", program.run(&[program.folder()]));
}

#[test]
fn the_library_is_loaded_and_unloaded_a_thousand_times() {
    for build in BUILDS {
        let program = Program::build(Language::C("c99"), "load_and_unload.c", build);
        write(program.folder(), 0, EVERY_REGIME, &[]);
        let printed = program.run(&[&shared_library(build), &program.folder().join("0.toml")]);
        assert_eq!(printed, "1000 rounds\n");
    }
}

/// A solver with two plugins, each of which brought its own: both answer for themselves, with the same bits.
#[test]
fn two_versions_live_in_one_process() {
    let program = Program::build(Language::C("c99"), "two_versions.c", Build::Shipped);
    write(program.folder(), 0, EVERY_REGIME, &random_cases(seed(), 300));
    let printed = program.run(&[&next_version(), program.folder()]);
    let (abi, version) = (nearwall::c_api::NW_ABI_VERSION, env!("CARGO_PKG_VERSION"));
    assert_eq!(printed, format!("{abi} {version} and 99 99.0.0, 300 impacts\n"));
}

/// Writes a model and its impacts, as the programs read them.
fn write(folder: &Path, number: usize, toml: &str, cases: &[Case]) {
    std::fs::write(folder.join(format!("{number}.toml")), toml).unwrap();
    let bytes =
        |case: &Case| -> [u8; size_of::<nw_impact>()] { unsafe { std::mem::transmute(c_case(case)) } };
    let bytes: Vec<u8> = cases.iter().flat_map(bytes).collect();
    std::fs::write(folder.join(format!("{number}.bin")), bytes).unwrap();
}

fn golden_impact(golden: &Golden) -> Impact {
    Impact { normal_speed: golden.v_n, diameter: golden.d, ..Impact::default() }
}

/// `static_assert`s that C lays a struct out as Rust does.
macro_rules! layout {
    ($($name:ident { $($field:ident)* })*) => {
        [$(
            format!("SAME(sizeof({0}), {1});\n", stringify!($name), size_of::<nearwall::c_api::$name>()),
            format!("SAME(ALIGNOF({0}), {1});\n", stringify!($name), align_of::<nearwall::c_api::$name>()),
            $(format!(
                "SAME(offsetof({0}, {1}), {2});\n", stringify!($name), stringify!($field),
                std::mem::offset_of!(nearwall::c_api::$name, $field)
            ),)*
        )*].concat()
    };
}

/// The same for numbers.
macro_rules! constants {
    ($($name:ident)*) => {
        [$(format!("SAME({0}, {1});\n", stringify!($name), nearwall::c_api::$name)),*].concat()
    };
}

#[test]
fn c_and_rust_agree_on_layout_and_numbers() {
    let same = for_each_struct!(layout) + &for_each_number!(constants);
    let text = |assert: &str, alignof: &str| {
        format!(
            "#include \"nearwall.h\"\n#define ALIGNOF(T) {alignof}(T)\n\
             #define SAME(c, rust) {assert}((c) == (rust), #c)\n{same}"
        )
    };
    compiles(Language::C("c11"), &text("_Static_assert", "_Alignof"));
    compiles(Language::Cpp("c++11"), &text("static_assert", "alignof"));
}
