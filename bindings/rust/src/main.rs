//! Resolves the impacts of a file with the C library loaded at run time.
//!
//! ```sh
//! cargo run -- nearWall.toml impacts.csv
//! ```
//!
//! It loads the library that `NEARWALL_LIBRARY` names, else the one on the loader's path. The table has the columns
//! `v_n,v_t,d,T_p,T_w` (SI units) and one header line; more pairs of model and table may follow. Prints `e_n`, `e_t`,
//! the capture probability and 1 (captured) or 0 for each impact.
#![allow(unsafe_code, reason = "a C library")]
#![allow(non_camel_case_types, non_snake_case, reason = "the names of nearwall.h")]

use std::error::Error;
use std::ffi::{CStr, CString, c_char};
use std::ptr::null_mut;

use libloading::Library;

// GENERATED from nearwall.h: `NEARWALL_BLESS=1 cargo test --test library interface` writes it again.
const NW_ABI_VERSION: u32 = 1;

#[repr(C)]
struct nw_model {
    _opaque: [u8; 0],
}

#[repr(C)]
#[derive(Default)]
struct nw_impact {
    struct_size: u32,
    wall: u32,
    seed: u64,
    key: u64,
    v_n: f64,
    v_t: f64,
    omega: f64,
    d: f64,
    T_p: f64,
    rho_p: f64,
    conversion: f64,
    T_w: f64,
    T_under: f64,
    roughness: f64,
    coverage: f64,
    layer_thickness: f64,
    film_thickness: f64,
    melt_thickness: f64,
    v_gas: f64,
    extra: [f64; 8],
}

#[repr(C)]
#[derive(Default)]
struct nw_outcome {
    struct_size: u32,
    regime: u32,
    stuck: u32,
    flags: u32,
    e_n: f64,
    e_t: f64,
    p_stick: f64,
    omega: f64,
}

type nw_abi_version = unsafe extern "C" fn() -> u32;
type nw_status_text = unsafe extern "C" fn(i32) -> *const c_char;
type nw_model_load = unsafe extern "C" fn(*const c_char, *mut *mut nw_model, *mut c_char, usize) -> i32;
type nw_model_free = unsafe extern "C" fn(*mut nw_model);
type nw_model_find_wall = unsafe extern "C" fn(*const nw_model, *const c_char, *mut u32) -> i32;
type nw_impact_init = unsafe extern "C" fn(*mut nw_impact) -> i32;
type nw_outcome_init = unsafe extern "C" fn(*mut nw_outcome) -> i32;
type nw_resolve = unsafe extern "C" fn(*const nw_model, *const nw_impact, *mut nw_outcome) -> i32;
// END GENERATED

/// The functions that this program needs, and the library that has them.
struct Nearwall {
    status_text: nw_status_text,
    load: nw_model_load,
    free: nw_model_free,
    find_wall: nw_model_find_wall,
    impact_init: nw_impact_init,
    outcome_init: nw_outcome_init,
    resolve: nw_resolve,
    _library: Library,
}

impl Nearwall {
    fn open() -> Result<Self, Box<dyn Error>> {
        let path = std::env::var_os("NEARWALL_LIBRARY").unwrap_or_else(|| "libnearwall.so.1".into());
        // SAFETY: the library's initialisers are the C and Rust runtimes'; names and types are those of nearwall.h, and
        // the version is checked before any other call.
        unsafe {
            let library = Library::new(path)?;
            let version = library.get::<nw_abi_version>(b"nw_abi_version")?();
            if version != NW_ABI_VERSION {
                return Err(
                    format!("libnearwall has interface version {version}, not {NW_ABI_VERSION}").into()
                );
            }
            Ok(Self {
                status_text: *library.get(b"nw_status_text")?,
                load: *library.get(b"nw_model_load")?,
                free: *library.get(b"nw_model_free")?,
                find_wall: *library.get(b"nw_model_find_wall")?,
                impact_init: *library.get(b"nw_impact_init")?,
                outcome_init: *library.get(b"nw_outcome_init")?,
                resolve: *library.get(b"nw_resolve")?,
                _library: library,
            })
        }
    }

    fn check(&self, status: i32) -> Result<(), Box<dyn Error>> {
        if status == 0 {
            return Ok(());
        }
        // SAFETY: a static text.
        Err(unsafe { CStr::from_ptr((self.status_text)(status)) }.to_string_lossy().into())
    }

    fn model(&self, path: &str) -> Result<Model<'_>, Box<dyn Error>> {
        let (path, mut handle, mut message) = (CString::new(path)?, null_mut(), vec![0_u8; 512]);
        // SAFETY: a closing zero, a place for the handle, and room for the message as stated.
        let status = unsafe {
            (self.load)(path.as_ptr(), &raw mut handle, message.as_mut_ptr().cast(), message.len())
        };
        if status != 0 {
            return Err(CStr::from_bytes_until_nul(&message)?.to_string_lossy().into());
        }
        Ok(Model { library: self, handle })
    }
}

/// A loaded model.
struct Model<'a> {
    library: &'a Nearwall,
    handle: *mut nw_model,
}

impl Drop for Model<'_> {
    fn drop(&mut self) {
        // SAFETY: the handle came from `nw_model_load` and goes with its owner.
        unsafe { (self.library.free)(self.handle) }
    }
}

impl Model<'_> {
    fn impact(&self, wall: &CStr) -> Result<nw_impact, Box<dyn Error>> {
        let mut impact = nw_impact::default();
        // SAFETY: the struct is the library's, as the version says.
        self.library.check(unsafe { (self.library.impact_init)(&raw mut impact) })?;
        // SAFETY: a loaded model, a text with a closing zero, a place for the index.
        let status = unsafe { (self.library.find_wall)(self.handle, wall.as_ptr(), &raw mut impact.wall) };
        self.library.check(status)?;
        Ok(impact)
    }

    fn resolve(&self, impact: &nw_impact) -> Result<nw_outcome, Box<dyn Error>> {
        let mut outcome = nw_outcome::default();
        // SAFETY: both structs are the library's and hold their size.
        self.library.check(unsafe { (self.library.outcome_init)(&raw mut outcome) })?;
        // SAFETY: as above.
        self.library.check(unsafe { (self.library.resolve)(self.handle, impact, &raw mut outcome) })?;
        Ok(outcome)
    }
}

fn decide(library: &Nearwall, model_file: &str, table_file: &str) -> Result<(), Box<dyn Error>> {
    let model = library.model(model_file)?;
    let mut impact = model.impact(c"default")?;
    impact.seed = 1;
    for (row, line) in std::fs::read_to_string(table_file)?.lines().skip(1).enumerate() {
        let cells: Vec<f64> = line.split(',').map(str::parse).collect::<Result<_, _>>()?;
        let [v_n, v_t, d, t_p, t_w] = cells[..] else { return Err(format!("five numbers: {line}").into()) };
        (impact.v_n, impact.v_t, impact.d, impact.T_p, impact.T_w) = (v_n, v_t, d, t_p, t_w);
        impact.key = row as u64; // unique: random draws depend only on seed and key
        let out = model.resolve(&impact)?;
        println!("{:.16e} {:.16e} {:.16e} {}", out.e_n, out.e_t, out.p_stick, out.stuck);
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let library = Nearwall::open()?;
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    arguments.chunks_exact(2).try_for_each(|pair| decide(&library, &pair[0], &pair[1]))
}
