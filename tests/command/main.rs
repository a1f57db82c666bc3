//! The command as a user runs it: each subcommand, its pages in a browser, and what goes wrong around it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may fail")]
#![allow(unsafe_code, reason = "the shared helpers call the C library")]

#[path = "../common/mod.rs"]
mod common;

mod arguments;
mod bench;
mod compare;
mod corpus;
mod deposit_probe;
mod diagnose;
mod dispersion;
mod extra_inputs;
#[cfg(unix)]
mod faults;
mod forecast;
mod gas_and_parcels;
mod init;
mod laboratory_files;
mod licences;
mod map;
mod melting_rig;
mod pages;
mod published;
#[cfg(unix)]
mod readme;
mod real_measurements;
mod recorded;
mod report;
mod runner;
mod scale;
mod simulate;
mod slag_viscosity_study;
mod wall_maps;
mod wrong_case;
