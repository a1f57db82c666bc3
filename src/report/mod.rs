//! Pages of results, as `diagnose`, `simulate` and `report` write them.
//!
//! A [`Chart`], [`BarChart`] or [`FigureMap`] becomes a [`Figure`]: an SVG with a title and a caption. A [`Page`] is a
//! self-contained HTML file of text, tables and figures, readable on paper. [`openfoam`] reads finished OpenFOAM cases
//! and writes a page about them, [`sweep`] a page about a table of runs.

mod chart;
mod diagnosis;
mod format;
pub mod openfoam;
mod page;
pub mod sweep;

pub use chart::{BarChart, Chart, ErrorBars, Figure, FigureMap, round_edges};
pub use diagnosis::page as diagnosis_page;
pub use format::{number, percent};
pub use page::{Page, RowStatus, Table};
