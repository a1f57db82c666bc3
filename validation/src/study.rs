//! Studies: a source, its parts, and their claims.

use nearwall_lab::report::{Figure, Table};

use crate::claim::{Claim, Verdict};

/// Amount of computation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// As published on the page.
    Full,
    /// Fewer random draws and coarser steps, for the tests.
    Short,
}

impl Extent {
    /// Number of draws or steps: `full`, or a tenth of it.
    pub fn count(self, full: usize) -> usize {
        match self {
            Self::Full => full,
            Self::Short => full.div_ceil(10),
        }
    }
}

/// One subject of a study: text, inputs, figures and claims.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StudyPart {
    /// Its heading.
    pub heading: String,
    /// Paragraphs: the comparison and its result.
    pub text: Vec<String>,
    /// Published inputs and other tables.
    pub tables: Vec<Table>,
    /// Figures.
    pub figures: Vec<Figure>,
    /// Published and computed values.
    pub claims: Vec<Claim>,
}

/// A source and the comparisons with it.
#[derive(Debug, Clone, PartialEq)]
pub struct SourceStudy {
    /// Short name, for the overview.
    pub title: String,
    /// The source in full.
    pub source: String,
    /// The result in two short sentences.
    pub lead: String,
    /// Its parts.
    pub parts: Vec<StudyPart>,
}

impl SourceStudy {
    /// All its claims.
    pub fn claims(&self) -> impl Iterator<Item = &Claim> {
        self.parts.iter().flat_map(|part| &part.claims)
    }

    /// Number of claims with this verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.claims().filter(|claim| claim.verdict == verdict).count()
    }

    /// Claims that differ or cannot be checked and give no reason.
    pub fn unexplained(&self) -> impl Iterator<Item = &Claim> {
        self.claims().filter(|claim| claim.verdict != Verdict::Agrees && claim.why.is_empty())
    }
}

/// A table of the page. `header` holds the columns' names, separated by ` | `; the first `text_columns` contain text.
pub fn table(caption: &str, text_columns: usize, header: &str, rows: Vec<Vec<String>>) -> Table {
    let header = header.split(" | ").map(str::to_owned).collect();
    Table { caption: caption.to_owned(), header, rows, text_columns }
}
