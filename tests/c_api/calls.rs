//! `libnearwall.so` of this build, loaded at run time as a stranger loads it.

use std::ffi::{CStr, c_char};

use libloading::Library;
use nearwall::c_api::{
    NW_OK, nw_deposit, nw_deposit_losses, nw_deposit_source, nw_deposit_surroundings, nw_impact, nw_impacts,
    nw_model, nw_outcome, nw_outcomes, nw_walk, nw_wall_cooling, nw_wall_heat,
};
use nearwall::{Impact, ImpactRng, Outcome};

use crate::common::compile::library_path;
use crate::interface::for_each_function;

macro_rules! define_calls {
    ($($name:ident: $signature:ty,)*) => {
        /// Every function of `nearwall.h`.
        pub struct Calls {
            _library: Library,
            $(pub $name: $signature,)*
        }

        impl Calls {
            /// From the library that was built with the test.
            pub fn load() -> Self {
                let library = unsafe { Library::new(library_path()) }.unwrap();
                unsafe {
                    Self {
                        $($name: *library.get::<$signature>(stringify!($name).as_bytes()).unwrap(),)*
                        _library: library,
                    }
                }
            }
        }

        /// Their names.
        pub const NAMES: &[&str] = &[$(stringify!($name)),*];
    };
}

for_each_function!(define_calls);

impl Calls {
    /// A model from text; `free` it.
    pub fn parse(&self, toml: &str) -> *mut nw_model {
        let mut model = std::ptr::null_mut();
        let (null, none) = (std::ptr::null(), std::ptr::null_mut());
        let status =
            unsafe { (self.nw_model_parse)(toml.as_ptr().cast(), toml.len(), null, &raw mut model, none, 0) };
        assert_eq!(status, NW_OK);
        model
    }

    pub fn free(&self, model: *mut nw_model) {
        unsafe { (self.nw_model_free)(model) };
    }

    /// One impact; an outcome with `Ok`, the status with `Err`, and then nothing was written.
    pub fn resolve(&self, model: *const nw_model, impact: &nw_impact) -> Result<nw_outcome, i32> {
        let mut outcome = poisoned();
        let before = bytes(&outcome);
        let status = unsafe { (self.nw_resolve)(model, impact, &raw mut outcome) };
        if status == NW_OK {
            return Ok(outcome);
        }
        assert_eq!(bytes(&outcome), before, "status {status}, yet something was written");
        Err(status)
    }

    /// Adhesive, yield and sticking velocity [m/s].
    pub fn speeds(&self, model: *const nw_model, impact: &nw_impact) -> [f64; 3] {
        let mut found = [0.0; 3];
        let [a, b, c] = found.each_mut().map(std::ptr::from_mut);
        assert_eq!(unsafe { (self.nw_speeds)(model, impact, a, b, c) }, NW_OK);
        found
    }

    /// A static text of the library.
    pub fn text(&self, text: *const c_char) -> &str {
        unsafe { CStr::from_ptr(text) }.to_str().unwrap()
    }
}

/// An outcome with its size and otherwise 0xA5 in every byte.
pub fn poisoned() -> nw_outcome {
    let mut outcome = std::mem::MaybeUninit::<nw_outcome>::uninit();
    unsafe {
        outcome.as_mut_ptr().cast::<u8>().write_bytes(0xA5, size_of::<nw_outcome>());
        outcome.as_mut_ptr().cast::<u32>().write(size_of::<nw_outcome>() as u32);
        outcome.assume_init()
    }
}

/// Every byte of an outcome (it has no padding).
pub fn bytes(outcome: &nw_outcome) -> [u8; size_of::<nw_outcome>()] {
    unsafe { std::mem::transmute_copy(outcome) }
}

/// A Rust outcome as the C library has to give it, bit for bit.
pub fn c_outcome(outcome: &Outcome) -> [u8; size_of::<nw_outcome>()] {
    bytes(&nw_outcome {
        regime: outcome.regime as u32,
        stuck: outcome.stuck.into(),
        flags: outcome.outside_range.into(),
        e_n: outcome.normal_restitution,
        e_t: outcome.tangential_restitution,
        p_stick: outcome.sticking_probability,
        omega: outcome.spin,
        ..nw_outcome::default()
    })
}

/// A case as the C library takes it.
pub fn c_case((wall, impact, draw): &(usize, Impact, ImpactRng)) -> nw_impact {
    let wall = u32::try_from(*wall).unwrap();
    nw_impact { wall, seed: draw.seed, key: draw.key, ..nw_impact::from(impact) }
}
