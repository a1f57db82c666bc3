//! `libnearwall.so` as a C program meets it: every status, hostile input, threads, floating-point state, the file itself.
#![allow(unsafe_code, reason = "calling a C library")]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "clippy.toml's leave for tests does not reach their helpers"
)]

#[path = "../common/mod.rs"]
mod common;

mod batch;
mod calls;
mod deposit;
mod impacts;
mod library_file;
mod loading;
mod programs;
mod threads;
