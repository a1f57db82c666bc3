//! Times, and their ratios within one run. `benches/run` runs it several times and writes the medians and their spread.
#![allow(unsafe_code, reason = "calls C")]
#![allow(clippy::unwrap_used, reason = "a benchmark may fail")]
#![allow(missing_docs, reason = "criterion's functions")]

use std::fs;
use std::hint::black_box;
use std::path::PathBuf;
use std::ptr::null_mut;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput};
use nearwall::c_api::{NW_OK, nw_impact, nw_model, nw_outcome, nw_resolve, nw_resolve_batch, nw_status};
use nearwall::model::block::{BLOCK, Outcomes, Workspace};
use nearwall::normal::Contact;
use nearwall::{Impact, ImpactRng, Model};
use nearwall_benches::*;
use validation::oracle::normal_contact;

fn main() {
    let quick = || Criterion::default().warm_up_time(Duration::from_millis(200)).without_plots();
    let mut criterion =
        quick().measurement_time(Duration::from_millis(500)).sample_size(30).configure_from_args();
    blocks(&mut criterion);
    calls(&mut criterion);
    slag(&mut criterion);
    batches(&mut criterion);
    threads(&mut criterion);
    contact(&mut criterion);
    criterion.final_summary();
    rows();
}

/// A block in the first-level cache against the divisions and roots alone.
fn blocks(criterion: &mut Criterion) {
    let (model, block) = (model(), block());
    let (mut sink, mut outcomes): (BlockSink, _) = ([[0.0; BLOCK]; 3], Outcomes::default());
    let mut workspace = Workspace::default();
    let mut group = criterion.benchmark_group("block");
    group.throughput(Throughput::Elements(BLOCK as u64));
    for (name, level) in levels() {
        group.bench_function(BenchmarkId::new("floor", name), |b| {
            b.iter(|| {
                floor(level, black_box(&block), &mut sink);
                black_box(&mut sink);
            });
        });
        group.bench_function(BenchmarkId::new("resolve", name), |b| {
            b.iter(|| {
                model
                    .resolve_block_at(level, 0, black_box(&block), BENCH_SEED, &mut outcomes, &mut workspace)
                    .unwrap();
                black_box(&mut outcomes);
            });
        });
    }
    group.finish();
}

type Resolve = unsafe extern "C" fn(*const nw_model, *const nw_impact, *mut nw_outcome) -> nw_status;

/// Impacts of a batch that stays in the cache of a core.
const CACHED: usize = 10_000;

/// Names of the groups of criterion, in the order of [`sides`].
const SIDES: [&str; 4] = ["wax", "wax, own exp", "bons", "fouling"];

/// The models that are written by hand as well.
fn sides() -> [Side; 4] {
    [wax(false), wax(true), bons(), fouling()]
}

/// One call and a batch through the C interface, its floating-point guard and its checks included,
/// against C++ that has neither.
fn calls(criterion: &mut Criterion) {
    // A pointer, as a solver has it: nothing is inlined.
    let resolve = black_box(nw_resolve as Resolve);
    for (group, side) in SIDES.into_iter().zip(sides()) {
        let model = handle(side.toml);
        let [mut near, mut hand] = [0; 2].map(|_| ImpactColumns::new(CACHED, side.impact));
        let ((impacts, outcomes), by_hand) = (near.pointers(), hand.by_hand());
        // SAFETY: a live model and columns of one length.
        unsafe {
            assert_eq!(nw_resolve_batch(model, &impacts, &outcomes, null_mut()), NW_OK);
            (side.many)(&side.constants, &by_hand);
        }
        check_agreement(&side, &near, &hand);
        let ((impacts, outcomes), by_hand) = (near.pointers(), hand.by_hand());

        // Calls walk through a list of impacts, as those of a solver do.
        let list: Vec<[f64; 5]> = (0..1024).map(side.impact).collect();
        let ours: Vec<nw_impact> = list.iter().map(|numbers| called(*numbers)).collect();
        let theirs: Vec<HandImpact> =
            list.iter().map(|numbers| HandImpact { numbers: *numbers, key: 0 }).collect();
        let mut group = criterion.benchmark_group(group);
        group.throughput(Throughput::Elements(list.len() as u64));
        group.bench_function("call", |b| b.iter(|| each_call(resolve, model, &ours)));
        group.bench_function("call by hand", |b| {
            b.iter(|| {
                for impact in &theirs {
                    let mut outcome = HandOutcome::default();
                    // SAFETY: live structs of the right types.
                    unsafe { (side.one)(black_box(&raw const side.constants), impact, &mut outcome) };
                    black_box(&mut outcome);
                }
            });
        });
        group.throughput(Throughput::Elements(CACHED as u64));
        // SAFETY: as above.
        group.bench_function("batch", |b| {
            b.iter(|| unsafe { nw_resolve_batch(model, &impacts, &outcomes, null_mut()) })
        });
        group.bench_function("batch by hand", |b| {
            b.iter(|| unsafe { (side.many)(&side.constants, black_box(&by_hand)) })
        });
        group.finish();
    }
}

/// Each impact of a list by a call of its own.
fn each_call(resolve: Resolve, model: *const nw_model, impacts: &[nw_impact]) {
    for impact in impacts {
        let mut outcome = nw_outcome::default();
        // SAFETY: a live model and structs of the right types.
        let status = unsafe { resolve(model, impact, &raw mut outcome) };
        assert_eq!(status, NW_OK);
        black_box(&mut outcome);
    }
}

/// Coal char on slag: calls and a batch. Both shares of the wall are decided, with the properties
/// at the temperatures of each impact.
fn slag(criterion: &mut Criterion) {
    let resolve = black_box(nw_resolve as Resolve);
    let (model, wall) = gasifier();
    let mut columns = ImpactColumns::on_slag(CACHED, wall);
    let (impacts, outcomes) = columns.pointers();
    let list: Vec<nw_impact> = (0..1024).map(|index| called_on_slag(index, wall)).collect();
    let mut group = criterion.benchmark_group("slag");
    group.bench_function("call", |b| b.iter(|| each_call(resolve, model, &list)));
    group.bench_function("batch", |b| {
        // SAFETY: every array has as many entries as `count` says.
        b.iter(|| assert_eq!(unsafe { nw_resolve_batch(model, &impacts, &outcomes, null_mut()) }, NW_OK));
    });
    group.finish();
}

/// Sizes of batches, from the cache to beyond it.
const BATCH_SIZES: [usize; 4] = [1_000, 10_000, 100_000, 1_000_000];

/// Batches through the C interface.
fn batches(criterion: &mut Criterion) {
    let model = handle(MODEL);
    let mut group = criterion.benchmark_group("batch");
    group.sample_size(10);
    for count in BATCH_SIZES {
        let mut columns = ImpactColumns::new(count, impact);
        let (impacts, outcomes) = columns.pointers();
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function(BenchmarkId::from_parameter(count), |b| {
            // SAFETY: every array has `count` entries.
            b.iter(|| assert_eq!(unsafe { nw_resolve_batch(model, &impacts, &outcomes, null_mut()) }, 0));
        });
    }
    group.finish();
}

/// Every thread its own ten thousand impacts, which stay in its core's cache, thirty times: the mean of the times that
/// they were on a core, so that whatever else the machine does is left out.
fn threads(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("threads");
    group.sample_size(10);
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let counts = (0..).map(|power| 1 << power).take_while(|count| *count <= cores);
    for count in counts {
        let mut all: Vec<ImpactColumns> = (0..count).map(|_| ImpactColumns::new(CACHED, impact)).collect();
        let model = handle(MODEL) as usize;
        group.bench_function(BenchmarkId::from_parameter(count), |b| {
            b.iter_custom(|rounds| {
                let work = |columns: &mut ImpactColumns| {
                    let (impacts, outcomes) = columns.pointers();
                    let start = on_core();
                    for _ in 0..30 * rounds {
                        // SAFETY: a live model, and every array has `count` entries.
                        let status =
                            unsafe { nw_resolve_batch(model as *const _, &impacts, &outcomes, null_mut()) };
                        assert_eq!(status, 0);
                    }
                    on_core() - start
                };
                let total: Duration = std::thread::scope(|scope| {
                    let workers: Vec<_> =
                        all.iter_mut().map(|columns| scope.spawn(|| work(columns))).collect();
                    workers.into_iter().map(|worker| worker.join().unwrap()).sum()
                });
                total / count as u32
            });
        });
    }
    group.finish();
}

/// How long this thread has been on a core (Linux).
fn on_core() -> Duration {
    let statistics = fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    Duration::from_nanos(statistics.split(' ').next().unwrap().parse().unwrap())
}

/// The closed form against the same contact followed through time.
fn contact(criterion: &mut Criterion) {
    let (contact, [model, _], impact) = followed();
    let mut group = criterion.benchmark_group("contact");
    group.bench_function("closed form", |b| {
        b.iter(|| model.resolve(0, black_box(&impact), ImpactRng::new(1, 2)))
    });
    for tolerance in [1e-4, 1e-6, 1e-9] {
        group.bench_function(BenchmarkId::new("followed", format!("{tolerance:e}")), |b| {
            b.iter(|| normal_contact::follow(black_box(&contact), tolerance));
        });
    }
    group.finish();
}

/// Wax of 75 µm on Pyrex at 1 m/s with little adhesion (0.01 J/m², so that both rebound): for the
/// integration, and for models with the plain law and with the one whose pull-off yielding raises.
fn followed() -> (normal_contact::ContactImpact, [Model; 2], Impact) {
    let library = nearwall::material::Library::built_in().unwrap();
    let solid = |name: &str| library.get(name).unwrap().mechanical(293.15).unwrap();
    let contact = Contact::new(&solid("montan-wax"), &solid("pyrex"), 0.7, Some(0.01));
    let followed = normal_contact::ContactImpact {
        radius: 37.5e-6,
        density: contact.density,
        reduced_modulus: contact.reduced_modulus,
        work_of_adhesion: contact.work_of_adhesion,
        limiting_pressure: contact.limiting_pressure(),
        speed: 1.0,
    };
    let impact = Impact { normal_speed: 1.0, diameter: 75e-6, ..Impact::default() };
    let plain = MODEL.replace("yield_ratio = 0.7", "yield_ratio = 0.7\nwork_of_adhesion = 0.01");
    let plain = plain.split("[[effects]]").next().unwrap();
    let raised = plain.replace("thornton-ning", "thornton-ning-raised-pull-off");
    (followed, [plain, &raised].map(|text| Model::from_toml("wax", text).unwrap()), impact)
}

/// The median time [ns] that criterion has written for a benchmark, over `count`.
fn median(name: &str, count: usize) -> Option<f64> {
    let path = target().join("criterion").join(name).join("new/estimates.json");
    let estimates: serde_json::Value = serde_json::from_str(&fs::read_to_string(path).ok()?).ok()?;
    Some(estimates["median"]["point_estimate"].as_f64()? / count as f64)
}

/// Prints `row;<what>;<unit>;<nearwall>;<the other>;<its value>`, where both were measured.
fn row(what: &str, unit: &str, ours: Option<f64>, other: &str, theirs: Option<f64>) {
    if let (Some(ours), Some(theirs)) = (ours, theirs) {
        println!("row;{what};{unit};{ours:.4};{other};{theirs:.4}");
    }
}

/// As [`row`], without another to compare with.
fn alone(what: &str, unit: &str, ours: Option<f64>) {
    if let Some(ours) = ours {
        println!("row;{what};{unit};{ours:.4};;");
    }
}

/// The rows of the table, from the medians of criterion.
fn rows() {
    for (group, side) in SIDES.into_iter().zip(sides()) {
        let model = group.split(',').next().unwrap_or_default();
        let row = |what: &str, of: &str, count| {
            let theirs = median(&format!("{group}/{of} by hand"), count);
            row(
                &format!("{model}: {what}"),
                "ns",
                median(&format!("{group}/{of}"), count),
                side.name,
                theirs,
            );
        };
        row("one call", "call", 1024);
        row("batch of 10,000, an impact", "batch", CACHED);
    }
    let one = "coal char on slag: one call";
    row(one, "ns", median("slag/call", 1024), "nearwall, wax: one call", median("wax/call", 1024));
    let (many, wax) = ("coal char on slag: batch of 10,000, an impact", "nearwall, wax: batch");
    row(many, "ns", median("slag/batch", CACHED), wax, median("wax/batch", CACHED));
    for (level, _) in levels() {
        let [ours, floor] = ["resolve", "floor"].map(|of| median(&format!("block/{of}/{level}"), BLOCK));
        let what = format!("wax: block of 128 in the cache, {level}, an impact");
        row(&what, "ns", ours, "its divisions and roots alone", floor);
    }
    for count in BATCH_SIZES {
        let time = median(&format!("batch/{count}"), count);
        alone(&format!("wax: batch of {count}, an impact"), "ns", time);
    }
    let single = median("threads/1", 1);
    for count in [2_u32, 4, 8, 16, 32, 64, 128] {
        let together = median(&format!("threads/{count}"), 1);
        let times = single.zip(together).map(|(single, together)| f64::from(count) * single / together);
        alone(&format!("wax: {count} threads, by time on a core, over one"), "times the impacts", times);
    }
    let closed = median("contact/closed form", 1);
    for tolerance in ["1e-4", "1e-6", "1e-9"] {
        let followed = median(&format!("contact/followed/{tolerance}"), 1);
        row(
            "wax: one impact, Rust",
            "ns",
            closed,
            &format!("contact integrated in time to {tolerance}"),
            followed,
        );
    }
    errors();
}

/// How far the integration is from its own limit, and the closed forms from it.
fn errors() {
    let (contact, models, impact) = followed();
    let limit = normal_contact::follow(&contact, 1e-12).rebound_speed;
    for tolerance in [1e-4, 1e-6, 1e-9] {
        let error = normal_contact::follow(&contact, tolerance).rebound_speed / limit - 1.0;
        println!("note;integrated to {tolerance:e}: relative error of e_n {error:.1e}");
    }
    for model in models {
        let e_n = model.resolve(0, &impact, ImpactRng::new(1, 2)).unwrap().normal_restitution;
        println!("note;{}: relative error of e_n {:.4}", model.normal_law().name(), e_n / limit - 1.0);
    }
}

/// Where cargo builds to: two folders above this program's own.
fn target() -> PathBuf {
    let program = std::env::current_exe().unwrap();
    program.ancestors().nth(3).unwrap().to_owned()
}
