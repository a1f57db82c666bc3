//! Everything around an impact: what laboratories measure, what rigs catch, and pages that show it.
//! Impacts themselves are decided by the library [`nearwall`], through its public functions.
//!
//! # Modules, in the order in which data pass through them
//! 1. [`dataset`] reads tables of measured impacts and of readings of a rig.
//! 2. [`predict`] adds predictions to a table of impacts; [`map`] shows a model over two inputs;
//!    [`simulate`] follows particles in a prescribed gas flow; [`rig`] predicts what a whole rig
//!    measures.
//!    [`range`] says what impacts use outside of its stated range.
//! 3. [`results`] reads what `simulate` and OpenFOAM wrote.
//! 4. [`diagnose`] finds what a model lacks, from impacts or from readings of a rig.
//! 5. [`report`] draws the pages.
//! 6. [`command`] is the command `nearwall`, with all of the above.
//!
//! [`atomic_file`] writes results aside and moves them into place when they are whole.

// Units stand in brackets, which rustdoc takes for links.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod atomic_file;
pub mod command;
pub mod dataset;
pub mod diagnose;
pub mod map;
pub mod predict;
pub mod range;
pub mod report;
pub mod results;
pub mod rig;
pub mod simulate;
