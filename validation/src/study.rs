//! A source and all that is compared with it.

use nearwall::report::{Figure, Table};

use crate::claim::{Claim, Verdict};

/// How much is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Everything, as published on the page.
    Full,
    /// Fewer draws and coarser steps: for every run of the tests.
    Short,
}

impl Extent {
    /// A number of draws or steps: `full` of them, or a tenth.
    pub fn count(self, full: usize) -> usize {
        match self {
            Self::Full => full,
            Self::Short => full.div_ceil(10),
        }
    }
}

/// What a study says about one thing: text, inputs, pictures and claims.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Part {
    /// Its heading.
    pub heading: String,
    /// Paragraphs: what is compared, what comes out.
    pub text: Vec<String>,
    /// The inputs as published, and other tables.
    pub tables: Vec<Table>,
    /// Pictures.
    pub figures: Vec<Figure>,
    /// Statements of the source beside ours.
    pub claims: Vec<Claim>,
}

/// A source and all that is compared with it.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// Short name, for the overview.
    pub title: String,
    /// The source in full.
    pub source: String,
    /// The result in two or three sentences.
    pub lead: String,
    /// What it consists of.
    pub parts: Vec<Part>,
}

impl Study {
    /// All its claims.
    pub fn claims(&self) -> impl Iterator<Item = &Claim> {
        self.parts.iter().flat_map(|part| &part.claims)
    }

    /// How many of its claims stand so.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.claims().filter(|claim| claim.verdict == verdict).count()
    }

    /// Claims that differ or cannot be checked and do not say why.
    pub fn unexplained(&self) -> impl Iterator<Item = &Claim> {
        self.claims().filter(|claim| claim.verdict != Verdict::Agrees && claim.why.is_empty())
    }
}

/// One study: its name on the command line and what makes it.
pub type Maker = (&'static str, fn(Extent) -> Result<Study, Box<dyn std::error::Error>>);

/// Every study, in the order of the page.
pub const STUDIES: [Maker; 4] = [
    ("migraine", crate::migraine::study),
    ("troiano", crate::troiano::study),
    ("checks", crate::checks::study),
    ("materials", crate::materials::study),
];
