//! Times, and their ratios within one run. `benches/run` runs it several times and prints the spread of the ratios.
#![allow(unsafe_code, reason = "calls C")]
#![allow(clippy::unwrap_used, reason = "a benchmark may fail")]
#![allow(missing_docs, reason = "criterion's functions")]

use std::fs;
use std::hint::black_box;
use std::path::PathBuf;
use std::ptr::null_mut;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput};
use nearwall::c_api::{
    NW_OK, nw_impact, nw_model, nw_model_find_wall, nw_outcome, nw_resolve, nw_resolve_batch, nw_status,
};
use nearwall::model::block::{BLOCK, Outcomes, Workspace};
use nearwall::normal::Contact;
use nearwall::{Impact, ImpactRng, Model};
use nearwall_benches::*;
use validation::oracle::normal_contact;

fn main() {
    let quick = || Criterion::default().warm_up_time(Duration::from_millis(300));
    let mut criterion =
        quick().measurement_time(Duration::from_secs(1)).sample_size(50).configure_from_args();
    blocks(&mut criterion);
    calls(&mut criterion);
    batches(&mut criterion);
    threads(&mut criterion);
    contact(&mut criterion);
    criterion.final_summary();
    ratios();
}

/// A block in the first-level cache against the divisions and roots alone.
fn blocks(criterion: &mut Criterion) {
    let (model, block) = (model(), block());
    let (mut sink, mut outcomes): (Sink, _) = ([[0.0; BLOCK]; 3], Outcomes::default());
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
                    .resolve_block_at(level, 0, black_box(&block), SEED, &mut outcomes, &mut workspace)
                    .unwrap();
                black_box(&mut outcomes);
            });
        });
    }
    group.finish();
}

type Resolve = unsafe extern "C" fn(*const nw_model, *const nw_impact, *mut nw_outcome) -> nw_status;

/// One call through the C interface, its floating-point guard and its checks included, against C++ that has neither: with
/// the C library's exponential and cube root, and with ours.
fn calls(criterion: &mut Criterion) {
    let (constants, model) = (constants(), handle(MODEL));
    let numbers = impact(1);
    let mut theirs = HandImpact { numbers, key: 0 };
    let ours = called(numbers);
    let (mut hand, mut outcome) = (HandOutcome::default(), nw_outcome::default());
    // A pointer, as a solver has it: nothing is inlined.
    let resolve = black_box(nw_resolve as Resolve);
    let mut group = criterion.benchmark_group("call");
    for (name, options) in [("by hand", &[][..]), ("by hand, own exp", &["-DOWN_ELEMENTARY"])] {
        let by_hand = by_hand(options);
        // SAFETY: live structs of the right types, here and below.
        unsafe {
            by_hand(&constants, &theirs, &mut hand);
            resolve(model, &ours, &mut outcome);
        }
        let same = hand.numbers.iter().zip([outcome.e_n, outcome.e_t, outcome.p_stick, outcome.omega]);
        for (hand, our) in same {
            assert!((hand - our).abs() <= 1e-9 * our.abs(), "{hand:?}, {outcome:?}");
        }
        group.bench_function(name, |b| {
            b.iter(|| {
                theirs.key += 1;
                unsafe { by_hand(black_box(&raw const constants), black_box(&raw const theirs), &mut hand) };
                black_box(&mut hand);
            });
        });
    }
    let slag = handle(GASIFIER);
    let mut wall = 0;
    // SAFETY: as above.
    unsafe { nw_model_find_wall(slag, c"slagWall".as_ptr(), &raw mut wall) };
    let on_slag = nw_impact { wall, T_p: 1600.0, T_w: 1600.0, conversion: 0.9, ..ours };
    for (name, model, mut impact) in [("nw_resolve", model, ours), ("nw_resolve, slag", slag, on_slag)] {
        group.bench_function(name, |b| {
            b.iter(|| {
                impact.key += 1;
                // SAFETY: as above.
                let status = unsafe { resolve(model, black_box(&raw const impact), &raw mut outcome) };
                assert_eq!(status, NW_OK);
                black_box(&mut outcome);
            });
        });
    }
    group.finish();
}

/// Batches through the C interface, from the cache to far beyond it.
fn batches(criterion: &mut Criterion) {
    let model = handle(MODEL);
    let mut group = criterion.benchmark_group("batch");
    group.sample_size(10);
    for count in [1_000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000] {
        let mut columns = Columns::new(count);
        let (impacts, outcomes) = columns.pointers();
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function(BenchmarkId::from_parameter(count), |b| {
            // SAFETY: every array has `count` entries.
            b.iter(|| assert_eq!(unsafe { nw_resolve_batch(model, &impacts, &outcomes, null_mut()) }, 0));
        });
    }
    group.finish();
}

/// Every thread its own ten thousand impacts, which stay in its core's cache, three hundred times: the mean of the times that
/// they were on a core, so that whatever else the machine does is left out.
fn threads(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("threads");
    group.sample_size(10);
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let counts = (0..).map(|power| 1 << power).take_while(|count| *count <= cores);
    for count in counts {
        let mut all: Vec<Columns> = (0..count).map(|_| Columns::new(10_000)).collect();
        let model = handle(MODEL) as usize;
        group.bench_function(BenchmarkId::from_parameter(count), |b| {
            b.iter_custom(|rounds| {
                let work = |columns: &mut Columns| {
                    let (impacts, outcomes) = columns.pointers();
                    let start = on_core();
                    for _ in 0..300 * rounds {
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

/// Wax of 75 µm on Pyrex at 1 m/s with little adhesion (0.01 J/m², so that both rebound): for the integration, and for models
/// with the plain law and with the one whose pull-off yielding raises.
fn followed() -> (normal_contact::Impact, [Model; 2], Impact) {
    let library = nearwall::material::Library::built_in().unwrap();
    let solid = |name: &str| library.get(name).unwrap().mechanical(293.15).unwrap();
    let contact = Contact::new(&solid("montan-wax"), &solid("pyrex"), 0.7, Some(0.01));
    let followed = normal_contact::Impact {
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

/// Prints `ratio;<name>;<value>` from the medians that criterion has written.
fn ratios() {
    let median = |name: &str| {
        let path = target().join("criterion").join(name).join("new/estimates.json");
        let estimates: serde_json::Value = serde_json::from_str(&fs::read_to_string(path).ok()?).ok()?;
        estimates["median"]["point_estimate"].as_f64()
    };
    let say = |name: &str, value: Option<f64>| {
        if let Some(value) = value {
            println!("ratio;{name};{value:.4}");
        }
    };
    for (level, _) in levels() {
        let (floor, resolve) =
            (median(&format!("block/floor/{level}")), median(&format!("block/resolve/{level}")));
        say(
            &format!("block, {level}: time over the divider's floor"),
            resolve.zip(floor).map(|(r, f)| r / f),
        );
        say(&format!("block, {level}: million impacts a second"), resolve.map(|r| 1e3 * BLOCK as f64 / r));
    }
    let call = median("call/nw_resolve");
    for hand in ["by hand", "by hand, own exp"] {
        let ratio = call.zip(median(&format!("call/{hand}"))).map(|(c, h)| c / h);
        say(&format!("one call: time over C++ -O3 {hand}"), ratio);
    }
    say("one call [ns]", call);
    say("one call, coal char on slag [ns]", median("call/nw_resolve, slag"));
    for count in [1_000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000_u32] {
        let time = median(&format!("batch/{count}")).map(|time| time / f64::from(count));
        say(&format!("batch of {count}: ns an impact"), time);
    }
    let alone = median("threads/1");
    for count in [2_u32, 4, 8, 16, 32, 64, 128] {
        let together = median(&format!("threads/{count}"));
        say(
            &format!("{count} threads: times the impacts of one, by time on a core"),
            alone.zip(together).map(|(a, t)| f64::from(count) * a / t),
        );
    }
    let closed = median("contact/closed form");
    for tolerance in ["1e-4", "1e-6", "1e-9"] {
        let followed = median(&format!("contact/followed/{tolerance}"));
        say(
            &format!("contact followed to {tolerance}: time over the closed form"),
            followed.zip(closed).map(|(f, c)| f / c),
        );
    }
    errors();
}

/// How far the integration is from its own limit, and the closed forms from it.
fn errors() {
    let (contact, models, impact) = followed();
    let limit = normal_contact::follow(&contact, 1e-12).rebound_speed;
    println!("ratio;contact followed: e_n;{limit:.5}");
    for tolerance in [1e-4, 1e-6, 1e-9] {
        let error = normal_contact::follow(&contact, tolerance).rebound_speed / limit - 1.0;
        println!("ratio;contact followed to {tolerance:e}: relative error of e_n;{error:.1e}");
    }
    for model in models {
        let e_n = model.resolve(0, &impact, ImpactRng::new(1, 2)).unwrap().normal_restitution;
        println!("ratio;{}: relative error of e_n;{:.4}", model.normal_law().name(), e_n / limit - 1.0);
    }
}

/// Where cargo builds to: two folders above this program's own.
fn target() -> PathBuf {
    let program = std::env::current_exe().unwrap();
    program.ancestors().nth(3).unwrap().to_owned()
}
