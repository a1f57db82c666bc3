//! Benchmark: laws, models and other programs scored on every measured set of the project.
//!
//! A measured row is split into readings of one observable; each source of measurements is predicted
//! with numbers and a scatter that were fitted to the other sources only, and each source counts
//! once. The likelihood is that of [`super::comparison`]. Laws are put on the materials of each set.
//! The reference is a level: the mean of the other sources. Method for users: `docs/bench.md`.

mod contestant;
mod external;
mod laws;
mod measured_set;
mod published;
mod read_set;
mod reading;
mod score;
mod shortfall;

use std::path::Path;

use contestant::Contestant;
use laws::named_laws;
use read_set::ReadSet;

pub use score::{BenchmarkEntry, BenchmarkMeasure, BenchmarkResult, SetMeasure};
pub use shortfall::Shortfall;

/// Why a benchmark cannot be run.
#[derive(Debug, thiserror::Error)]
pub enum BenchmarkError {
    /// A measured set cannot be read.
    #[error("{set}: {problem}")]
    Set {
        /// The set, or its file.
        set: String,
        /// The reason.
        problem: String,
    },
    /// The model file is no TOML.
    #[error(transparent)]
    Toml(#[from] toml_edit::TomlError),
    /// The other program gives no usable answer.
    #[error("--external {command}: {problem}")]
    External {
        /// The command.
        command: String,
        /// What is wrong with its answer, and the remedy.
        problem: String,
    },
    /// The table of impacts cannot be written.
    #[error(transparent)]
    Csv(#[from] csv::Error),
    /// A model or program decides nothing.
    #[error("{name} decides no reading of any set. {reason}")]
    NothingDecided {
        /// The model or the command.
        name: String,
        /// The first reason.
        reason: String,
    },
}

/// What is scored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EntryKind {
    /// The reference: the means of the other sources.
    Level,
    /// A law of the library: 0 for one of `e_n`, 1 for one of `e_t`.
    Law(usize),
    /// A model or a program, with everything that it says.
    Whole,
}

/// The measured sets and what is scored on them.
pub struct Benchmark {
    sets: Vec<ReadSet>,
    sources: Vec<String>,
    contestants: Vec<Contestant>,
}

impl Benchmark {
    /// All laws of the library on the sets of the project, and on those of a folder.
    ///
    /// # Errors
    /// [`BenchmarkError::Set`].
    pub fn new(folder: Option<&Path>) -> Result<Self, BenchmarkError> {
        let mut measured = measured_set::project_sets()?;
        if let Some(folder) = folder {
            measured.extend(measured_set::folder_sets(folder)?);
        }
        let mut sources = Vec::new();
        let sets = measured.into_iter().map(|set| ReadSet::new(set, &mut sources));
        let sets = sets.collect::<Result<Vec<_>, _>>()?;
        let laws = named_laws();
        let contestants = laws.iter().map(|law| Contestant::law(law, &sets)).collect::<Result<_, _>>()?;
        Ok(Self { sets, sources, contestants })
    }

    /// The names of the laws of the library.
    #[must_use]
    pub fn law_names() -> Vec<&'static str> {
        named_laws().iter().map(|law| law.name).collect()
    }

    /// Adds the laws of a model file; `name` is that of the file, `text` its content.
    ///
    /// # Errors
    /// [`BenchmarkError::Toml`], [`BenchmarkError::NothingDecided`].
    pub fn add_model(&mut self, name: &str, text: &str) -> Result<(), BenchmarkError> {
        self.add(Contestant::model(name, text, &self.sets)?)
    }

    /// Adds another program.
    ///
    /// # Errors
    /// [`BenchmarkError::External`], [`BenchmarkError::NothingDecided`].
    pub fn add_external(&mut self, command: &str) -> Result<(), BenchmarkError> {
        self.add(Contestant::external(command, &self.sets)?)
    }

    fn add(&mut self, contestant: Contestant) -> Result<(), BenchmarkError> {
        if contestant.decided.iter().flatten().all(|decided| !decided) {
            let reason = contestant.refusal.clone().unwrap_or_default();
            return Err(BenchmarkError::NothingDecided { name: contestant.name, reason });
        }
        self.contestants.push(contestant);
        Ok(())
    }

    /// The table of impacts that another program reads.
    ///
    /// # Errors
    /// [`BenchmarkError::Csv`].
    pub fn impacts(&self) -> Result<String, BenchmarkError> {
        read_set::impacts(&self.sets)
    }
}
