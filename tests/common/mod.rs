//! What several tests share: the golden table, the measured slags, random impacts, the C library loaded as a stranger loads it.
#![allow(dead_code, reason = "each test uses its part")]
#![allow(unsafe_code, reason = "calling a C library")]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "clippy.toml's leave for tests does not reach their helpers"
)]

pub mod browser;
pub mod compile;
pub mod golden;
pub mod measured_slags;
pub mod random;

use std::ffi::{CString, c_char};
use std::path::PathBuf;

use libloading::{Library, Symbol};
use nearwall::Impact;
use nearwall::c_api::{NW_OK, nw_impact, nw_model, nw_outcome};

/// `libnearwall.so` of this build, loaded at run time.
pub struct CLibrary {
    library: Library,
}

/// A model of the C library; freed with it.
pub struct CModel<'a> {
    library: &'a CLibrary,
    pub handle: *mut nw_model,
}

impl Drop for CModel<'_> {
    fn drop(&mut self) {
        unsafe { self.library.symbol::<unsafe extern "C" fn(*mut nw_model)>("nw_model_free")(self.handle) }
    }
}

/// Where cargo puts the shared library that belongs to the running test.
pub fn library_path() -> PathBuf {
    let exe = std::env::current_exe().unwrap();
    exe.parent().unwrap().join("libnearwall.so")
}

impl CLibrary {
    pub fn load() -> Self {
        let path = library_path();
        let library =
            unsafe { Library::new(&path) }.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        Self { library }
    }

    pub fn symbol<T>(&self, name: &str) -> Symbol<'_, T> {
        unsafe { self.library.get(name.as_bytes()) }.unwrap()
    }

    pub fn try_parse(&self, toml: &str) -> Result<CModel<'_>, (i32, String)> {
        type Parse = unsafe extern "C" fn(
            *const c_char,
            usize,
            *const c_char,
            *mut *mut nw_model,
            *mut c_char,
            usize,
        ) -> i32;
        let name = CString::new("test.toml").unwrap();
        let mut handle = std::ptr::null_mut();
        let mut message = vec![0_u8; 512];
        let status = unsafe {
            self.symbol::<Parse>("nw_model_parse")(
                toml.as_ptr().cast(),
                toml.len(),
                name.as_ptr(),
                &raw mut handle,
                message.as_mut_ptr().cast(),
                message.len(),
            )
        };
        if status == NW_OK {
            return Ok(CModel { library: self, handle });
        }
        assert!(handle.is_null(), "nothing is written on failure");
        let end = message.iter().position(|byte| *byte == 0).unwrap();
        Err((status, String::from_utf8(message[..end].to_vec()).unwrap()))
    }

    pub fn parse(&self, toml: &str) -> CModel<'_> {
        self.try_parse(toml).unwrap()
    }

    pub fn try_resolve(&self, model: &CModel<'_>, impact: &nw_impact) -> Result<nw_outcome, i32> {
        type Resolve = unsafe extern "C" fn(*const nw_model, *const nw_impact, *mut nw_outcome) -> i32;
        let mut outcome = nw_outcome::default();
        let status = unsafe { self.symbol::<Resolve>("nw_resolve")(model.handle, impact, &raw mut outcome) };
        if status == NW_OK { Ok(outcome) } else { Err(status) }
    }

    pub fn resolve(&self, model: &CModel<'_>, impact: &Impact) -> nw_outcome {
        self.try_resolve(model, &nw_impact::from(impact)).unwrap()
    }

    pub fn speeds(&self, model: &CModel<'_>, impact: &Impact) -> [f64; 3] {
        type Speeds =
            unsafe extern "C" fn(*const nw_model, *const nw_impact, *mut f64, *mut f64, *mut f64) -> i32;
        let [mut adhesive, mut yielding, mut sticking] = [0.0; 3];
        let status = unsafe {
            self.symbol::<Speeds>("nw_speeds")(
                model.handle,
                &nw_impact::from(impact),
                &raw mut adhesive,
                &raw mut yielding,
                &raw mut sticking,
            )
        };
        assert_eq!(status, NW_OK);
        [adhesive, yielding, sticking]
    }
}
