//! Figures and the page that holds them: what `simulate`, `report` and other commands show their results with.
//!
//! A [`Figure`] is an SVG with a title and a caption; a [`Page`] is a self-contained HTML file of paragraphs, tables and
//! figures, readable on paper. [`openfoam`] reads finished OpenFOAM cases and makes a page of them, [`sweep`] a table of runs.

mod diagnosis;
mod figure;
pub mod openfoam;
mod page;
pub mod sweep;

pub use diagnosis::page as diagnosis_page;
pub use figure::{Bars, Chart, Errors, Figure, FigureMap, round_edges};
pub use page::{Block, Mark, Page, Table, number, percent};
