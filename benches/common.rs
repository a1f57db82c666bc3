//! Common parts of the benchmarks: models, their impacts, the lower limit set by the divider of a
//! processor, and the same models written by hand in C++.
#![allow(unsafe_code, reason = "calls C")]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a benchmark may fail")]

use std::path::Path;
use std::process::Command;
use std::ptr::{null, null_mut};

use fearless_simd::{Level, Simd, dispatch};
use libloading::Library;
use nearwall::c_api::{nw_impact, nw_impacts, nw_model, nw_model_find_wall, nw_model_parse, nw_outcomes};
use nearwall::model::block::{BLOCK, Block};
use nearwall::normal::{Contact, yield_velocity};
use nearwall::{ImpactRng, Model, material};

/// Wax on Pyrex (Troiano et al.): Thornton–Ning, sliding and rolling, capture by melting.
pub const MODEL: &str = r#"
[particle]
material = "montan-wax"
[walls.default]
material = "pyrex"
[normal]
model = "thornton-ning"
yield_ratio = 0.7
[tangential]
model = "sliding-rolling"
friction = 0.28
[[effects]]
kind = "melting-transition"
temperature = 360.1
width = 6.96
"#;

/// Seed of the draws, and of the impacts.
pub const BENCH_SEED: u64 = 7;

/// The model.
pub fn model() -> Model {
    Model::from_toml("wax", MODEL).unwrap()
}

/// The model of the slagging gasifier: coal char on slag, a wall of properties that depend on temperature.
pub const GASIFIER: &str = include_str!("../tutorials/slaggingGasifier/constant/nearWall.toml");

/// A model behind the C interface. It is never freed.
pub fn handle(toml: &str) -> *const nw_model {
    let mut model = null_mut();
    // SAFETY: text and length belong together, and `model` can be written.
    let status =
        unsafe { nw_model_parse(toml.as_ptr().cast(), toml.len(), null(), &raw mut model, null_mut(), 0) };
    assert_eq!(status, 0);
    model
}

/// The vectors of this machine, by name.
pub fn levels() -> Vec<(&'static str, Level)> {
    let best = Level::new();
    #[cfg(target_arch = "x86_64")]
    {
        let levels = [
            ("SSE2", best.as_sse2().map(Simd::level)),
            ("AVX2", best.as_avx2().map(Simd::level)),
            ("AVX-512", best.as_avx512().map(Simd::level)),
        ];
        levels.into_iter().filter_map(|(name, level)| Some((name, level?))).collect()
    }
    #[cfg(not(target_arch = "x86_64"))]
    vec![("baseline", best)]
}

/// An even random number of an impact, one for each `stream`.
fn even(index: usize, stream: u64) -> f64 {
    ImpactRng::new(BENCH_SEED, index as u64).uniform(stream)
}

/// `v_n`, `v_t` [m/s], `d` [m], `T_p` [K] and `omega` [rad/s] of an impact: all branches of the laws occur.
pub fn impact(index: usize) -> [f64; 5] {
    let even = |stream| even(index, stream);
    let spin = if even(14) < 0.5 { 0.0 } else { 2e4 * (even(15) - 0.5) };
    [0.05 + 3.0 * even(10), 3.0 * even(11), 1e-5 + 1e-4 * even(12), 320.0 + 80.0 * even(13), spin]
}

/// As [`impact`], for [`BONS_MODEL`]: particles of 1 to 50 µm at 5 to 100 m/s, some of which stick.
fn impact_in_turbine(index: usize) -> [f64; 5] {
    let even = |stream| even(index, stream);
    [5.0 + 95.0 * even(10), 100.0 * even(11), 1e-6 + 49e-6 * even(12), 293.15, 0.0]
}

/// As [`impact`], for [`FOULING`]: from stiff ash to ash that always sticks.
fn impact_of_ash(index: usize) -> [f64; 5] {
    let [v_n, v_t, d, ..] = impact(index);
    [v_n, v_t, d, 1200.0 + 600.0 * even(index, 13), 0.0]
}

/// `T_w` [K] and `conversion` [1] of an impact on the slag of [`GASIFIER`], and `T_p` [K] of the particle.
fn on_slag(index: usize) -> [f64; 3] {
    [1400.0 + 300.0 * even(index, 16), even(index, 17), 1500.0 + 300.0 * even(index, 13)]
}

/// An impact for the C interface.
pub fn called([v_n, v_t, d, t_p, omega]: [f64; 5]) -> nw_impact {
    nw_impact { v_n, v_t, d, T_p: t_p, omega, seed: BENCH_SEED, ..nw_impact::default() }
}

/// An impact of coal char on the slag of [`GASIFIER`].
pub fn called_on_slag(index: usize, wall: u32) -> nw_impact {
    let ([v_n, v_t, d, _, omega], [t_w, conversion, t_p]) = (impact(index), on_slag(index));
    nw_impact { wall, T_w: t_w, conversion, ..called([v_n, v_t, d, t_p, omega]) }
}

/// [`GASIFIER`] behind the C interface, and its wall with slag.
pub fn gasifier() -> (*const nw_model, u32) {
    let (model, mut wall) = (handle(GASIFIER), 0);
    // SAFETY: a live model, text that ends with 0, and a place to write to.
    assert_eq!(unsafe { nw_model_find_wall(model, c"slagWall".as_ptr(), &raw mut wall) }, 0);
    (model, wall)
}

/// A full block of impacts.
pub fn block() -> Block {
    let mut block = Block { length: BLOCK, ..Block::default() };
    for index in 0..BLOCK {
        let places = [0, 1, 2, 3, 10];
        places.into_iter().zip(impact(index)).for_each(|(place, value)| block.inputs[place][index] = value);
        block.keys[index] = index as u64;
    }
    block
}

/// What the kernel of the floor writes.
pub type BlockSink = [[f64; BLOCK]; 3];

/// The divisions and square roots of an impact and nothing else: 1/v, w/(w + ...), two along the wall and one of the
/// logistic, three roots of the normal law.
pub fn floor(level: Level, block: &Block, sink: &mut BlockSink) {
    dispatch!(level, simd => floor_with(simd, block, sink));
}

#[inline(always)]
fn floor_with<S: Simd>(_: S, block: &Block, sink: &mut BlockSink) {
    let [v_n, v_t, d, t_p, ..] = &block.inputs;
    for i in 0..BLOCK {
        sink[0][i] = (1.0 / v_n[i]).sqrt() + v_n[i] / d[i];
        sink[1][i] = (t_p[i] / v_t[i]).sqrt() + v_t[i] / d[i];
        sink[2][i] = (d[i] / t_p[i]).sqrt();
    }
}

/// Ash on a turbine vane after Bons, Prenter & Whitaker (2017).
const BONS_MODEL: &str = r#"
[particle]
material = "ash"
[walls.default]
material = "vane"
[normal]
model = "bons"
work_of_adhesion = 0.8
[tangential]
model = "bons"
friction = 0.3
[materials.ash]
density = 2500
youngs_modulus = 70e9
poisson_ratio = 0.2
yield_strength = 200e6
surface_energy = 0.5
[materials.vane]
density = 8000
youngs_modulus = 200e9
poisson_ratio = 0.3
yield_strength = 900e6
surface_energy = 0.5
"#;

/// Fly ash that sticks with the probability critical viscosity over viscosity after Watt & Fereday,
/// and else loses no speed.
const FOULING: &str = r#"
[particle]
material = "fly-ash"
[walls.default]
material = "refractory"
[normal]
model = "constant"
e_n = 1
[tangential]
model = "constant"
e_t = 1
[capture]
model = "viscosity"
law = "watt-fereday"
reference_viscosity = 1e4
"#;

/// `Constants` of the C++: numbers of the law, and the seed.
#[repr(C)]
pub struct Constants([f64; 7], u64);

/// `Impact` of `handwritten.h`.
#[repr(C)]
pub struct HandImpact {
    /// `v_n`, `v_t`, `d`, `T_p`, `omega`.
    pub numbers: [f64; 5],
    /// Key of the draw.
    pub key: u64,
}

/// `Outcome` of `handwritten.h`.
#[repr(C)]
#[derive(Debug, Default)]
pub struct HandOutcome {
    /// `e_n`, `e_t`, `p_stick`, `omega`.
    pub numbers: [f64; 4],
    /// Captured; regime.
    pub words: [u32; 2],
}

/// `ImpactColumns` of `handwritten.h`.
#[repr(C)]
pub struct HandColumns {
    count: usize,
    inputs: [*const f64; 5],
    floats: [*mut f64; 4],
    words: [*mut u32; 2],
}

/// The function in C++ for one impact.
pub type ByHand = unsafe extern "C" fn(*const Constants, *const HandImpact, *mut HandOutcome);

/// The function in C++ for many impacts.
pub type ManyByHand = unsafe extern "C" fn(*const Constants, *const HandColumns);

/// A model of nearwall, and the same model written by hand in C++.
pub struct Side {
    /// What the C++ is, for the table.
    pub name: &'static str,
    /// The model in nearwall.
    pub toml: &'static str,
    /// Inputs of an impact.
    pub impact: fn(usize) -> [f64; 5],
    /// The numbers of the model for the C++.
    pub constants: Constants,
    /// Whether both say the same of the speed after a rebound.
    pub same_rebound: bool,
    /// One impact in C++.
    pub one: ByHand,
    /// Many impacts in C++.
    pub many: ManyByHand,
}

/// Compiles a source of this folder with `c++ -O3` and these further `options`, and loads it for good.
fn compiled(source: &str, options: &[&str]) -> (ByHand, ManyByHand) {
    let folder = tempfile::tempdir().unwrap();
    let library = folder.path().join("handwritten.so");
    let mut compiler = Command::new(std::env::var_os("CXX").unwrap_or_else(|| "c++".into()));
    compiler.args(["-O3", "-Wall", "-Wextra", "-shared", "-fPIC"]).args(options).arg("-o").arg(&library);
    assert!(
        compiler.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join(source)).status().unwrap().success(),
        "{source}"
    );
    // SAFETY: our own library, which does nothing when loaded; the types are those of its source.
    unsafe {
        let library = Box::leak(Box::new(Library::new(library).unwrap()));
        (*library.get(b"impact_by_hand").unwrap(), *library.get(b"impacts_by_hand").unwrap())
    }
}

/// The wax impact by hand: with the exponential and the cube root of the C library, or with nearwall's.
pub fn wax(own_elementary: bool) -> Side {
    let options: &[&str] = if own_elementary { &["-DOWN_ELEMENTARY"] } else { &[] };
    let name = if own_elementary { "C++ -O3 by hand, nearwall's exp and cbrt" } else { "C++ -O3 by hand" };
    let (one, many) = compiled("handwritten.cpp", options);
    Side { name, toml: MODEL, impact, constants: wax_constants(), same_rebound: true, one, many }
}

/// The model of Bons, Prenter & Whitaker by hand.
pub fn bons() -> Side {
    let (name, impact) = ("Bons law, C++ -O3 by hand", impact_in_turbine as _);
    let (one, many) = compiled("bons.cpp", &[]);
    // As in [`BONS_MODEL`]: [Pa], [1], [Pa], [J/m²], [kg/m³].
    let compliance = |modulus: f64, ratio: f64| (1.0 - ratio * ratio) / modulus;
    let modulus = 1.0 / (compliance(70e9, 0.2) + compliance(200e9, 0.3));
    let (strength, work, density): (f64, f64, f64) = (200e6, 0.8, 2500.0);
    let yielding = strength / (density * modulus).sqrt();
    let adhesive = 3.0 * work / (density * (1.0 - strength / modulus));
    let constants = Constants([yielding, adhesive, 0.1, 1.0 / 7.0, 0.5, 0.3, 0.0], BENCH_SEED);
    Side { name, toml: BONS_MODEL, impact, constants, same_rebound: true, one, many }
}

/// Fouling by molten ash, as in code_saturne, by hand. Only the capture is the same: nearwall's
/// particles bounce less the stickier they are, `e_n (1 - p_stick)`.
pub fn fouling() -> Side {
    let (name, impact) = ("code_saturne's fouling, C++ -O3 by hand", impact_of_ash as _);
    let (one, many) = compiled("fouling.cpp", &[]);
    // SiO2, Al2O3, Fe2O3, CaO and MgO of the built-in fly ash [wt%], over their sum.
    let oxides = [49.2, 28.4, 11.1, 2.1, 0.8];
    let [silica, alumina, iron, lime, _] = oxides.map(|share| 100.0 * share / oxides.iter().sum::<f64>());
    let slope = 0.00835 * silica + 0.00601 * alumina - 0.109;
    let intercept = 0.0415 * silica + 0.0192 * alumina + 0.0276 * iron + 0.0160 * lime - 3.92;
    let constants = Constants([slope, intercept, 1e4, 873.15, 0.0, 0.0, 0.0], BENCH_SEED);
    Side { name, toml: FOULING, impact, constants, same_rebound: false, one, many }
}

/// The constants of [`MODEL`] for the function in C++.
fn wax_constants() -> Constants {
    let library = material::Library::built_in().unwrap();
    let solid = |name: &str| library.get(name).unwrap().mechanical(293.15).unwrap();
    let contact = Contact::new(&solid("montan-wax"), &solid("pyrex"), 0.7, None);
    // `C1` of the law: see src/normal/thornton_ning.rs.
    let adhesive_factor: f64 = 1.840_183_180_799_056_5;
    let size = contact.reduced_modulus / (2.0 * contact.work_of_adhesion);
    let adhesive = adhesive_factor.powi(2) * contact.reduced_modulus / contact.density;
    let numbers = [size, adhesive, yield_velocity(&contact), 0.28, contact.stiffness_ratio, 360.1, 6.96];
    Constants(numbers, BENCH_SEED)
}

/// Arrays for a batch.
pub struct ImpactColumns {
    inputs: [Vec<f64>; 5],
    /// Temperature of the wall and conversion, where they are given.
    slag: Option<[Vec<f64>; 2]>,
    wall: u32,
    /// `e_n`, `e_t`, `p_stick`, `omega`.
    pub floats: [Vec<f64>; 4],
    /// Regime, captured, flags.
    pub words: [Vec<u32>; 3],
}

impl ImpactColumns {
    /// `count` impacts, repeated from a short list.
    pub fn new(count: usize, impact: fn(usize) -> [f64; 5]) -> Self {
        let list: Vec<[f64; 5]> = (0..1024).map(impact).collect();
        Self {
            inputs: std::array::from_fn(|input| (0..count).map(|i| list[i % list.len()][input]).collect()),
            slag: None,
            wall: 0,
            floats: std::array::from_fn(|_| vec![0.0; count]),
            words: std::array::from_fn(|_| vec![0; count]),
        }
    }

    /// `count` impacts of coal char on a wall with slag.
    pub fn on_slag(count: usize, wall: u32) -> Self {
        let list: Vec<[f64; 3]> = (0..1024).map(on_slag).collect();
        let column = |input: usize| (0..count).map(|i| list[i % list.len()][input]).collect();
        let mut columns = Self { slag: Some([column(0), column(1)]), wall, ..Self::new(count, impact) };
        columns.inputs[3] = column(2);
        columns
    }

    /// The structs of the call.
    pub fn pointers(&mut self) -> (nw_impacts, nw_outcomes) {
        let [v_n, v_t, d, t_p, omega] = self.inputs.each_ref().map(|column| column.as_ptr());
        let [t_w, conversion] = self.slag.as_ref().map_or([null(); 2], |s| s.each_ref().map(|c| c.as_ptr()));
        let impacts = nw_impacts {
            count: self.inputs[0].len(),
            seed: BENCH_SEED,
            wall: self.wall,
            v_n,
            v_t,
            d,
            T_p: t_p,
            T_w: t_w,
            conversion,
            omega,
            ..nw_impacts::default()
        };
        let [e_n, e_t, p_stick, omega] = self.floats.each_mut().map(|column| column.as_mut_ptr());
        let [regime, stuck, flags] = self.words.each_mut().map(|column| column.as_mut_ptr());
        let struct_size = size_of::<nw_outcomes>() as u32;
        (impacts, nw_outcomes { struct_size, e_n, e_t, p_stick, omega, regime, stuck, flags })
    }

    /// The struct for the C++.
    pub fn by_hand(&mut self) -> HandColumns {
        let inputs = self.inputs.each_ref().map(|column| column.as_ptr());
        let floats = self.floats.each_mut().map(|column| column.as_mut_ptr());
        let [regime, stuck, _] = self.words.each_mut().map(|column| column.as_mut_ptr());
        HandColumns { count: self.inputs[0].len(), inputs, floats, words: [stuck, regime] }
    }
}

/// Checks that a batch by nearwall and one by hand say the same: `p_stick` and, where both do, the
/// rebound to 1e-9, and who is captured.
pub fn check_agreement(side: &Side, near: &ImpactColumns, hand: &ImpactColumns) {
    let names = ["e_n", "e_t", "p_stick", "omega"];
    let captured = |columns: &ImpactColumns| columns.words[1].iter().filter(|stuck| **stuck != 0).count();
    let (count, stuck) = (near.words[1].len(), captured(near));
    assert!(0 < stuck && stuck < count, "{}: {stuck} of {count} captured", side.name);
    for i in 0..count {
        assert_eq!(near.words[1][i], hand.words[1][i], "{}: capture of impact {i}", side.name);
        // What a held particle keeps along the wall and of its spin is a matter of convention.
        let rebounds = side.same_rebound && near.floats[0][i] > 0.0;
        let compared: &[usize] = if rebounds { &[0, 1, 2, 3] } else { &[2] };
        for &quantity in compared {
            let [ours, theirs] = [near, hand].map(|columns| columns.floats[quantity][i]);
            let quantity = names[quantity];
            assert!(
                (ours - theirs).abs() <= 1e-9 * ours.abs(),
                "{}: {quantity} of impact {i}: {ours}, by hand {theirs}",
                side.name
            );
        }
    }
}
