//! The library: the golden table, independent oracles, effects, fitted curves, groups, listed laws,
//! measured oblique impacts, heat of contact, droplets, slag viscosity, the fuzzer's corpus, the links in the
//! documents, and the C header with everything that is generated from it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may fail")]
#![allow(unsafe_code, reason = "the C interface is compared and fuzzed too")]
#![allow(missing_docs, reason = "the fuzz targets belong to another workspace")]

#[path = "../common/mod.rs"]
mod common;

mod ash_fusion;
mod capture;
mod char_on_slag;
mod contact_heat;
mod contact_integration;
mod docs;
mod drop_bounce;
mod drop_published;
mod droplet;
mod effects;
mod fitted_curves;
mod golden;
mod groups;
mod interface;
mod laws;
mod oblique_impact;
mod published_sticking;
mod resuspension;
mod slag_viscosity;
