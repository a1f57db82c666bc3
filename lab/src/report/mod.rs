//! Pages of results, as the command writes them.
//!
//! A [`Chart`] or [`BarChart`] becomes a [`Figure`]: an SVG with a title and a caption. A [`Page`]
//! is a self-contained HTML file of text, tables and figures, readable on paper.
//! [`standalone_page`] and [`openfoam_page`] show [`crate::results`], [`sweep`] a table of runs,
//! [`map_page`] a map of a model, [`comparison_page`] several models on one data file,
//! [`diagnosis_page`] what a model lacks to explain impacts, [`rig_page`] the same for what a whole
//! rig shows.

mod bench;
mod chart;
mod compare;
mod diagnosis;
mod format;
mod map;
mod page;
mod rig;
mod sensitivity;
pub mod sweep;
mod walls;

pub use bench::text as benchmark_text;
pub use chart::{BarChart, Chart, ErrorBars, Figure, round_edges};
pub use compare::{page as comparison_page, text as comparison_text};
pub use diagnosis::page as diagnosis_page;
pub use format::{number, percent};
pub use map::page as map_page;
pub use page::{Page, RowStatus, Table};
pub use rig::{RigPage, RigSource, page as rig_page};
pub use sensitivity::page as sensitivity_page;
pub use walls::{openfoam_page, standalone_page};
