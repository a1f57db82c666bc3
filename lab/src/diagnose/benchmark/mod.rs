//! Benchmark: laws, models and other programs scored on every measured set of the project.
//!
//! A measured row is split into readings of one observable; each source of measurements is predicted
//! with numbers and a scatter that were fitted to the other sources only, and each source counts
//! once. The likelihood is that of [`super::comparison`]. Laws are put on the materials of each set.
//! The reference is a level: the mean of the other sources. Method for users: `docs/how-to/bench.md`.

mod contestant;
mod external;
mod laws;
mod measured_set;
mod published;
mod read_set;
mod reading;
mod score;
mod shortfall;

use std::collections::BTreeSet;
use std::path::Path;

use super::observable::Observable;
use contestant::Contestant;
use laws::{NamedLaw, adhesion_alone, capture_laws, named_laws};
use measured_set::MeasuredSet;
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
    /// A law of the library: 0 for one of `e_n`, 1 for one of `e_t`, 2 for one of capture by a melt.
    Law(usize),
    /// A model or a program, with everything that it says.
    Whole,
}

impl EntryKind {
    /// Whether it says something about an observable: a law of `e_n` nothing about `e_t`.
    fn answers_for(self, observable: Observable) -> bool {
        match self {
            Self::Law(1) => observable == Observable::TangentialRestitution,
            Self::Law(2) => observable == Observable::Capture,
            Self::Law(_) => observable != Observable::TangentialRestitution,
            Self::Level | Self::Whole => true,
        }
    }
}

/// The measured sets and what is scored on them.
pub struct Benchmark {
    sets: Vec<ReadSet>,
    sources: Vec<String>,
    contestants: Vec<Contestant>,
    /// Adhesion alone, then the laws of capture by a melt: each is scored on the sets that have what it needs.
    captures: Vec<Contestant>,
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
        let mut whole = Self::of_sets(measured, &named_laws())?;
        let laws = [vec![adhesion_alone()], capture_laws()].concat();
        let captures = laws.iter().map(|law| Contestant::law(law, &whole.sets));
        whole.captures = captures.collect::<Result<_, _>>()?;
        Ok(whole)
    }

    /// These laws on these sets.
    fn of_sets(measured: Vec<MeasuredSet>, laws: &[NamedLaw]) -> Result<Self, BenchmarkError> {
        let mut sources = Vec::new();
        let sets = measured.into_iter().map(|set| ReadSet::new(set, &mut sources));
        let sets = sets.collect::<Result<Vec<_>, _>>()?;
        let contestants = laws.iter().map(|law| Contestant::law(law, &sets)).collect::<Result<_, _>>()?;
        Ok(Self { sets, sources, contestants, captures: Vec::new() })
    }

    /// The names of the laws of the library, each once.
    #[must_use]
    pub fn law_names() -> Vec<String> {
        let laws = named_laws().into_iter().chain(capture_laws());
        let names: BTreeSet<String> = laws.map(|law| law.name()).collect();
        names.into_iter().collect()
    }

    /// Adds the laws of a model file; `name` is that of the file, `text` its content, `drawn` the texts of models
    /// that were drawn from its fit, for its bands; possibly none.
    ///
    /// # Errors
    /// [`BenchmarkError::Toml`], [`BenchmarkError::NothingDecided`].
    pub fn add_model(&mut self, name: &str, text: &str, drawn: &[String]) -> Result<(), BenchmarkError> {
        let model = Contestant::model(name, text, &self.sets)?;
        self.add(if drawn.is_empty() { model } else { model.with_draws(drawn, &self.sets)? })
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

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: &str = "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n\
        [normal]\nmodel = \"constant\"\ne_n = 0.5\n[tangential]\nmodel = \"constant\"\ne_t = 0.5\n";

    /// A source of averages whose `e_n` is in turn the one and the other value.
    fn source(name: &str, values: [f64; 2]) -> MeasuredSet {
        let rows: String = (1..=30).map(|row| format!("{row},2,{}\n", values[row % 2])).collect();
        MeasuredSet {
            name: name.to_owned(),
            source: name.to_owned(),
            data: format!("v_n,n_impacts,e_n\n{rows}").into(),
            columns: "".into(),
            base: MODEL.into(),
        }
    }

    /// `ln(0.98 N(distance; deviation) + 0.02 * 0.8)`, as `docs/how-to/diagnosis.md` states the likelihood.
    fn log_density(distance: f64, deviation: f64) -> f64 {
        let normal =
            (-0.5 * (distance / deviation).powi(2)).exp() / (deviation * std::f64::consts::TAU.sqrt());
        (0.98 * normal + 0.016).ln()
    }

    /// By hand: what is predicted for one source, and how uncertain, follows from the other one alone.
    #[test]
    fn a_source_is_scored_with_the_scatter_and_the_level_of_the_other() {
        let sets = vec![source("a", [0.4, 0.6]), source("b", [0.6, 0.8])];
        let mut benchmark = Benchmark::of_sets(sets, &[]).unwrap();
        benchmark.add_model("half", MODEL, &[]).unwrap();
        let result = benchmark.run();
        assert_eq!((result.readings, result.sources.len()), ([60, 60], 2));
        let [level, half] = result.entries.as_slice() else { panic!("{:?}", result.entries.len()) };
        let of =
            |entry: &BenchmarkEntry, set: usize| (entry.sets[set].means[1], entry.sets[set].measure.score);
        // The model says 0.5 everywhere: b lies 0.1 and 0.3 off, a 0.1.
        let scatter_of_b = (0.5 * (0.1_f64.powi(2) + 0.3_f64.powi(2))).sqrt();
        let expected =
            [log_density(0.1, scatter_of_b), 0.5 * (log_density(0.1, 0.1) + log_density(0.3, 0.1))];
        // The level is 0.7 for a, 0.5 for b; the other source scatters about it by 0.1.
        let at_level = 0.5 * (log_density(0.1, 0.1) + log_density(0.3, 0.1));
        for set in [0, 1] {
            let (predicted, score) = of(half, set);
            assert!(
                (predicted - 0.5).abs() < 1e-12 && (score - expected[set]).abs() < 0.05,
                "{score} {expected:?}"
            );
            let (predicted, score) = of(level, set);
            assert!(
                (predicted - [0.7, 0.5][set]).abs() < 1e-12 && (score - at_level).abs() < 0.05,
                "{score} {at_level}"
            );
        }
        let gain = 0.5 * (expected[0] + expected[1]) - at_level;
        assert!((half.whole.gain - gain).abs() < 0.05, "{} {gain}", half.whole.gain);
        assert!((half.by_observable[0].unwrap().rms - f64::sqrt(0.5 * (0.01 + 0.05))).abs() < 1e-9);
    }
}
