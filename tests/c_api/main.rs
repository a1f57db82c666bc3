//! The C library: every call and status, hostile input, threads, floating-point state, the shared
//! library's file and the dependencies. `tests/library/interface` tests the header.
#![allow(unsafe_code, reason = "calling a C library")]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "clippy.toml's leave for tests does not reach their helpers"
)]

#[path = "../common/mod.rs"]
mod common;

mod allocations;
mod batch;
mod calls;
mod dependencies;
mod deposit;
mod extra;
mod impacts;
mod interface;
mod library_file;
mod loading;
mod programs;
mod threads;
