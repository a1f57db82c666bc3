//! Common parts of the benchmarks: the model, its impacts, the lower limit set by the divider of a processor, and the same
//! impact written by hand in C++.
#![allow(unsafe_code, reason = "calls C")]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a benchmark may fail")]

use std::process::Command;
use std::ptr::{null, null_mut};

use fearless_simd::{Level, Simd, dispatch};
use libloading::Library;
use nearwall::c_api::{nw_impact, nw_impacts, nw_model, nw_model_parse, nw_outcomes};
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
pub const SEED: u64 = 7;

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

/// `v_n`, `v_t` [m/s], `d` [m], `T_p` [K] and `omega` [rad/s] of an impact: all branches of the laws occur.
pub fn impact(index: usize) -> [f64; 5] {
    let even = |stream| ImpactRng::new(SEED, index as u64).uniform(stream);
    let spin = if even(14) < 0.5 { 0.0 } else { 2e4 * (even(15) - 0.5) };
    [0.05 + 3.0 * even(10), 3.0 * even(11), 1e-5 + 1e-4 * even(12), 320.0 + 80.0 * even(13), spin]
}

/// An impact for the C interface.
pub fn called([v_n, v_t, d, t_p, omega]: [f64; 5]) -> nw_impact {
    nw_impact { v_n, v_t, d, T_p: t_p, omega, seed: SEED, ..nw_impact::default() }
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
pub type Sink = [[f64; BLOCK]; 3];

/// The divisions and square roots of an impact and nothing else: 1/v, w/(w + ...), two along the wall and one of the
/// logistic, three roots of the normal law.
pub fn floor(level: Level, block: &Block, sink: &mut Sink) {
    dispatch!(level, simd => floor_with(simd, block, sink));
}

#[inline(always)]
fn floor_with<S: Simd>(_: S, block: &Block, sink: &mut Sink) {
    let [v_n, v_t, d, t_p, ..] = &block.inputs;
    for i in 0..BLOCK {
        sink[0][i] = (1.0 / v_n[i]).sqrt() + v_n[i] / d[i];
        sink[1][i] = (t_p[i] / v_t[i]).sqrt() + v_t[i] / d[i];
        sink[2][i] = (d[i] / t_p[i]).sqrt();
    }
}

/// `Constants` of `handwritten.cpp`.
#[repr(C)]
pub struct Constants([f64; 7], u64);

/// `Impact` of `handwritten.cpp`.
#[repr(C)]
pub struct HandImpact {
    /// `v_n`, `v_t`, `d`, `T_p`, `omega`.
    pub numbers: [f64; 5],
    /// Key of the draw.
    pub key: u64,
}

/// `Outcome` of `handwritten.cpp`.
#[repr(C)]
#[derive(Debug, Default)]
pub struct HandOutcome {
    /// `e_n`, `e_t`, `p_stick`, `omega`.
    pub numbers: [f64; 4],
    /// Captured; regime.
    pub words: [u32; 2],
}

/// The function in C++.
pub type ByHand = unsafe extern "C" fn(*const Constants, *const HandImpact, *mut HandOutcome);

/// Compiles `handwritten.cpp` with `c++ -O3` and these further `options`, and loads it for good.
pub fn by_hand(options: &[&str]) -> ByHand {
    let folder = tempfile::tempdir().unwrap();
    let library = folder.path().join("handwritten.so");
    let mut compiler = Command::new(std::env::var_os("CXX").unwrap_or_else(|| "c++".into()));
    compiler.args(["-O3", "-shared", "-fPIC"]).args(options).arg("-o").arg(&library);
    assert!(
        compiler.arg(concat!(env!("CARGO_MANIFEST_DIR"), "/handwritten.cpp")).status().unwrap().success()
    );
    // SAFETY: our own library, which does nothing when loaded; the type is that of its source.
    unsafe {
        let library = Box::leak(Box::new(Library::new(library).unwrap()));
        *library.get::<ByHand>(b"impact_by_hand").unwrap()
    }
}

/// The constants of [`MODEL`] for the function in C++.
pub fn constants() -> Constants {
    let library = material::Library::built_in().unwrap();
    let solid = |name: &str| library.get(name).unwrap().mechanical(293.15).unwrap();
    let contact = Contact::new(&solid("montan-wax"), &solid("pyrex"), 0.7, None);
    // `C1` of the law: see src/normal/thornton_ning.rs.
    let adhesive_factor: f64 = 1.840_183_180_799_056_5;
    let size = contact.reduced_modulus / (2.0 * contact.work_of_adhesion);
    let adhesive = adhesive_factor.powi(2) * contact.reduced_modulus / contact.density;
    let numbers = [size, adhesive, yield_velocity(&contact), 0.28, contact.stiffness_ratio, 360.1, 6.96];
    Constants(numbers, SEED)
}

/// Arrays for a batch through the C interface.
pub struct Columns {
    inputs: [Vec<f64>; 5],
    floats: [Vec<f64>; 4],
    words: [Vec<u32>; 3],
}

impl Columns {
    /// `count` impacts, repeated from a short list.
    pub fn new(count: usize) -> Self {
        let list: Vec<[f64; 5]> = (0..1024).map(impact).collect();
        Self {
            inputs: std::array::from_fn(|input| (0..count).map(|i| list[i % list.len()][input]).collect()),
            floats: std::array::from_fn(|_| vec![0.0; count]),
            words: std::array::from_fn(|_| vec![0; count]),
        }
    }

    /// The structs of the call.
    pub fn pointers(&mut self) -> (nw_impacts, nw_outcomes) {
        let [v_n, v_t, d, t_p, omega] = self.inputs.each_ref().map(|column| column.as_ptr());
        let impacts = nw_impacts {
            count: self.inputs[0].len(),
            seed: SEED,
            v_n,
            v_t,
            d,
            T_p: t_p,
            omega,
            ..nw_impacts::default()
        };
        let [e_n, e_t, p_stick, omega] = self.floats.each_mut().map(|column| column.as_mut_ptr());
        let [regime, stuck, flags] = self.words.each_mut().map(|column| column.as_mut_ptr());
        let struct_size = size_of::<nw_outcomes>() as u32;
        (impacts, nw_outcomes { struct_size, e_n, e_t, p_stick, omega, regime, stuck, flags })
    }
}
