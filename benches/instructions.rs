//! Instructions, counted under valgrind: the same on every run, whatever else the machine does.
//! Valgrind knows AVX2 but not AVX-512.
#![allow(unsafe_code, reason = "calls C")]
#![allow(clippy::unwrap_used, reason = "a benchmark may fail")]
#![allow(missing_docs, reason = "gungraun's functions")]

use std::hint::black_box;

use fearless_simd::Level;
use gungraun::{LibraryBenchmarkConfig, library_benchmark, library_benchmark_group, main};
use nearwall::Model;
use nearwall::c_api::{nw_impact, nw_model, nw_outcome, nw_resolve};
use nearwall::model::block::{Block, Outcomes, Workspace};
use nearwall_benches::*;

/// On the heap, so that what is counted does not move it about.
type BlockRun = Box<(Model, Block, Level, Outcomes, Workspace)>;

fn at(name: &str) -> BlockRun {
    let level = levels().into_iter().find(|level| level.0 == name).unwrap().1;
    Box::new((model(), block(), level, Outcomes::default(), Workspace::default()))
}

#[library_benchmark]
#[bench::sse2(args = ("SSE2"), setup = at)]
#[bench::avx2(args = ("AVX2"), setup = at)]
fn block_of_128(mut blocks: BlockRun) -> BlockRun {
    let (model, block, level, outcomes, workspace) = &mut *blocks;
    model.resolve_block_at(*level, 0, black_box(block), BENCH_SEED, outcomes, workspace).unwrap();
    blocks
}

fn c_interface() -> (*const nw_model, nw_impact) {
    (handle(MODEL), called(impact(1)))
}

#[library_benchmark]
#[bench::once(setup = c_interface)]
fn one_call((model, impact): (*const nw_model, nw_impact)) -> nw_outcome {
    let mut outcome = nw_outcome::default();
    // SAFETY: live structs of the right types.
    unsafe { nw_resolve(model, black_box(&impact), &mut outcome) };
    outcome
}

fn by_hand_ready(own_elementary: bool) -> (Side, HandImpact) {
    let ready = (wax(own_elementary), HandImpact { numbers: impact(1), key: 0 });
    // Once, so that the loader has found `cbrt` and `exp`.
    unsafe { (ready.0.one)(&ready.0.constants, &ready.1, &mut HandOutcome::default()) };
    ready
}

#[library_benchmark]
#[bench::c_library(args = (false), setup = by_hand_ready)]
#[bench::own_elementary(args = (true), setup = by_hand_ready)]
fn one_call_by_hand((side, impact): (Side, HandImpact)) -> HandOutcome {
    let mut outcome = HandOutcome::default();
    // SAFETY: as above.
    unsafe { (side.one)(&side.constants, black_box(&impact), &mut outcome) };
    outcome
}

library_benchmark_group!(name = counts, benchmarks = [block_of_128, one_call, one_call_by_hand]);
main!(
    // The compiler of the C++ is found by it.
    config = LibraryBenchmarkConfig::default().pass_through_env("PATH"),
    library_benchmark_groups = counts
);
