//! The C library: every call and status, hostile input, threads, floating-point state, the shared library's file, the header,
//! the binary interface and the dependencies.
#![allow(unsafe_code, reason = "calling a C library")]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "clippy.toml's leave for tests does not reach their helpers"
)]

#[path = "../common/mod.rs"]
mod common;

mod abi;
mod allocations;
mod batch;
mod calls;
mod dependencies;
mod deposit;
mod header;
mod impacts;
mod library_file;
mod loading;
mod programs;
mod threads;
