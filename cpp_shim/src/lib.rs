//! `nearwall.hpp` as Rust sees it, to test it: `tests/same_bits.rs` sets it beside `nearwall::Model`.
#![allow(unsafe_code, reason = "cxx writes the calls")]

use nearwall::c_api::{nw_impact, nw_impacts, nw_outcome, nw_outcomes};

/// A C struct under a name of this crate, which cxx may pass by value.
macro_rules! pass_as {
    ($name:ident, $c:ident, $id:literal) => {
        #[doc = concat!("`", $id, "`.")]
        #[repr(transparent)]
        #[derive(Debug, Clone, Copy)]
        pub struct $name(pub $c);

        // SAFETY: cbindgen wrote the C struct from the Rust one; plain data, no destructor.
        unsafe impl cxx::ExternType for $name {
            type Id = cxx::type_id!($id);
            type Kind = cxx::kind::Trivial;
        }
    };
}

pass_as!(Impact, nw_impact, "nw_impact");
pass_as!(Outcome, nw_outcome, "nw_outcome");
pass_as!(Impacts, nw_impacts, "nw_impacts");
pass_as!(Outcomes, nw_outcomes, "nw_outcomes");

/// The calls.
#[cxx::bridge]
#[allow(clippy::missing_safety_doc, reason = "it is there, but cxx moves it out of clippy's sight")]
pub mod ffi {
    #[namespace = "nearwall_bridge"]
    #[allow(missing_docs)]
    unsafe extern "C++" {
        include!("src/bridge.h");

        #[namespace = ""]
        #[cxx_name = "nw_impact"]
        type Impact = super::Impact;
        #[namespace = ""]
        #[cxx_name = "nw_outcome"]
        type Outcome = super::Outcome;
        #[namespace = ""]
        #[cxx_name = "nw_impacts"]
        type Impacts = super::Impacts;
        #[namespace = ""]
        #[cxx_name = "nw_outcomes"]
        type Outcomes = super::Outcomes;
        #[namespace = "nearwall"]
        #[cxx_name = "model"]
        type Model;

        fn from_file(path: &str) -> Result<UniquePtr<Model>>;
        fn from_toml(text: &str, name: &str) -> Result<UniquePtr<Model>>;
        fn find_wall(model: &Model, name: &str) -> Result<u32>;
        fn resolve(model: &Model, impact: &Impact) -> Result<Outcome>;
        fn resolve_status(model: &Model, impact: &Impact, outcome: &mut Outcome) -> i32;
        fn resolve_each(model: &Model, impacts: &[Impact], outcomes: &mut [Outcome]) -> Result<()>;
        fn speeds(model: &Model, impact: &Impact) -> Result<[f64; 3]>;
        fn ranges(model: &Model, wall: u32) -> Result<[f64; 4]>;
        fn move_about(text: &str) -> Result<()>;

        /// # Safety
        /// As `nw_resolve_batch`.
        unsafe fn resolve_arrays(model: &Model, impacts: &Impacts, outcomes: &Outcomes) -> Result<()>;
    }
}
