//! Grounds of explanations: the rows as they are, with errors that groups share, or read otherwise.

use std::sync::Arc;

use rayon::prelude::*;

use super::candidate::{Class, FURTHER};
use super::choice::Task;
use super::data_split::DataSplit;
use super::explanation::Evidence;
use super::groups::GroupColumn;
use super::hypothesis::Hypothesis;
use super::input_error::assume;
use super::likelihood::{Offset, Outliers};
use super::missing_inputs::MissingInputs;
use super::reading::{OtherReading, readings};
use super::skew::skewed;
use super::slip::slips;

/// The rows of the search, on which additions are looked for.
#[derive(Debug, Clone)]
pub(super) struct Ground {
    /// Empty for the rows as they are; an id of a rival of physics, or `groups:COLUMN`.
    pub key: String,
    /// What a rival asks the user; `None` for what is no rival.
    pub question: Option<String>,
    pub data: DataSplit,
    /// Added to the log likelihood of each row of the search [nats]: the slope of changed readings.
    pub slope: Vec<f64>,
    /// Number of fitted parameters.
    pub freedom: f64,
    /// Logarithm of the prior probability of a rival over that of the rows as they are; of outliers that of their share
    /// in one noise [nats].
    pub log_prior: f64,
    /// Whether additions can be looked for beside it.
    pub open: bool,
    /// Groups, of all rows of the file, whose rows share an error.
    pub groups: Option<GroupColumn>,
    /// More outliers than expected.
    pub outliers: Option<MoreOutliers>,
}

/// More outliers than expected, of some quantities.
#[derive(Debug, Clone, Copy)]
pub(super) struct MoreOutliers {
    pub shares: Outliers,
    /// Whether `e_n` and `e_t` have them.
    of: [bool; 2],
}

impl MoreOutliers {
    /// The noise of rows with these outliers.
    fn beside(self, noise: &[Offset]) -> Arc<[Offset]> {
        let mut noise = noise.to_vec();
        for row in &mut noise {
            (0..2).filter(|which| self.of[*which]).for_each(|which| row.outliers[which] = self.shares);
        }
        noise.into()
    }

    /// The quantities that have them.
    pub fn names(self) -> impl Iterator<Item = &'static str> {
        ["e_n", "e_t"].into_iter().zip(self.of).filter_map(|(name, has)| has.then_some(name))
    }
}

impl Ground {
    /// The rows as they are.
    pub fn plain(data: &DataSplit) -> Self {
        let slope = vec![0.0; data.search.len()];
        Self {
            key: String::new(),
            question: None,
            data: data.clone(),
            slope,
            freedom: 0.0,
            log_prior: 0.0,
            open: true,
            groups: None,
            outliers: None,
        }
    }

    /// The rows of the search with errors that groups share; `whole` are all rows.
    fn grouped(data: &DataSplit, whole: &DataSplit, groups: &GroupColumn) -> Self {
        Self {
            key: format!("groups:{}", groups.name),
            data: data.with_shared_errors(&groups.of_rows(&whole.search)),
            freedom: 1.0,
            groups: Some(groups.clone()),
            ..Self::plain(data)
        }
    }

    /// All rows as this ground has them. Under a rival they are as they are: it asks the user before any physics is
    /// named.
    pub fn of_all(&self, whole: &DataSplit) -> DataSplit {
        let mut all =
            self.groups.as_ref().map_or_else(|| whole.clone(), |groups| whole.with_shared_errors(groups));
        if let Some(outliers) = self.outliers {
            all.noise = outliers.beside(&whole.noise);
        }
        all
    }

    /// Whether it is another reading of the rows that physics competes with.
    pub fn is_rival(&self) -> bool {
        self.question.is_some()
    }

    /// Log likelihood of each row of the search under a hypothesis on this ground [nats].
    pub fn scores(&self, hypothesis: &Hypothesis<'_>) -> Vec<f64> {
        let rows = hypothesis.evaluate(&*self.data.search, hypothesis.offsets()).with_fitted_scatter();
        rows.scores().into_iter().zip(&self.slope).map(|(score, slope)| score + slope).collect()
    }
}

/// Inputs whose errors may be unknown to the file, and their size as a share of the value.
const UNSTATED: [&str; 3] = ["v_n", "v_t", "d"];
const SHARES: [f64; 8] = [0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3];
/// Shares of gross errors beside the expected one [1].
const RUBBISH: [f64; 2] = [0.1, 0.25];
/// Share of readings in a heavy tail, where there is one [1].
const TAILS: f64 = 0.25;
/// With fewer readings, and beside stated errors, a row that looks like a gross error is evidence.
const LEAST_WITH_RUBBISH: f64 = 12.0;

/// All grounds of the rows of the search, those as they are first; `whole` are all rows, `text` is the file of the base
/// model. Of the other readings those stay that have more evidence than the rows as they are.
pub(super) fn grounds(
    data: &DataSplit,
    whole: &DataSplit,
    task: Task<'_>,
    evidence: Evidence,
) -> Vec<Ground> {
    let mut all = vec![Ground::plain(data)];
    all.extend(task.groups.iter().map(|groups| Ground::grouped(data, whole, groups)));
    let expected = data.noise.iter().any(|offset| offset.outliers.contains(&Outliers::EXPECTED));
    let possible = !evidence.stated && evidence.readings >= LEAST_WITH_RUBBISH;
    let shares = match (expected, possible) {
        (true, _) => &RUBBISH[..],
        (false, true) => &RUBBISH[..1],
        (false, false) => &[],
    };
    let rubbish = shares.iter().map(|gross| Outliers { gross: *gross, tails: 0.0 });
    let gross = if expected { Outliers::EXPECTED } else { Outliers::NONE };
    let tails = possible.then_some(Outliers { tails: TAILS, ..gross });
    all.extend(rubbish.chain(tails).flat_map(|shares| with_outliers(data, shares)));
    all.extend(unstated_errors(data, evidence));
    all.extend(rivals(data, task.text, evidence));
    all
}

/// The other readings that have more evidence than the rows as they are. Slips and instruments are two kinds, as likely
/// as each other; scatter to one side is an instrument's.
fn rivals(data: &DataSplit, text: &str, evidence: Evidence) -> Vec<Ground> {
    let (slips, readings) = (slips(&data.base, text), readings(data));
    let best_of = |others: &[OtherReading]| -> Vec<Ground> {
        others.par_iter().filter_map(|other| best(data, other, evidence)).collect()
    };
    let skewed = skewed(data);
    let mut instruments = best_of(&readings);
    instruments.extend((worth(&skewed, evidence) > 0.0).then_some(skewed));
    let slip_prior = Class::Rival.log_prior(slips.len());
    let kinds = [(slip_prior, best_of(&slips)), (instrument_prior(readings.len()), instruments)];
    let with_prior = |(log_prior, found): (f64, Vec<Ground>)| {
        found.into_iter().map(move |ground| Ground { log_prior, ..ground })
    };
    kinds.into_iter().flat_map(with_prior).collect()
}

/// Logarithm of the prior probability of one of so many instruments' readings, beside scatter to one side [nats].
pub(super) fn instrument_prior(readings: usize) -> f64 {
    Class::Rival.log_prior(readings + 1)
}

/// Log evidence of the base model on a ground over that on the rows as they are [nats].
fn worth(ground: &Ground, evidence: Evidence) -> f64 {
    let score: f64 = ground.scores(&Hypothesis::base(&ground.data)).iter().sum();
    evidence.gain(score, ground.freedom)
}

/// The rows read otherwise with the best value. `None` if the rows as they are have more evidence.
fn best(data: &DataSplit, other: &OtherReading, evidence: Evidence) -> Option<Ground> {
    let score = |value: f64| Some(worth(&read(data, other, value)?, evidence));
    let (value, worth) = other.finer(other.best_value(score)?, score);
    if worth > 0.0 { read(data, other, value) } else { None }
}

/// Inputs and the sizes of their errors, as shares of the value [1].
type Errors = Vec<(&'static str, f64)>;

/// The rows with errors that the file does not state: of each input, and of several inputs where these have more
/// evidence together than one alone.
fn unstated_errors(data: &DataSplit, evidence: Evidence) -> Vec<Ground> {
    let mut found = with_further_errors(data, &Vec::new(), evidence);
    let largest = |found: &[(f64, Errors)]| found.iter().max_by(|a, b| a.0.total_cmp(&b.0)).cloned();
    let mut most = largest(&found);
    while let Some(known) = most {
        most = largest(&with_further_errors(data, &known.1, evidence)).filter(|more| more.0 > known.0);
        found.extend(most.clone());
    }
    found.iter().filter_map(|(_, errors)| with_input_errors(data, errors)).collect()
}

/// For each further input the known errors beside its own best size, with the log evidence over the rows as they
/// are, where that is positive [nats].
fn with_further_errors(data: &DataSplit, known: &Errors, evidence: Evidence) -> Vec<(f64, Errors)> {
    let is_open = |name: &&str| known.iter().all(|one| one.0 != *name) && may_have_errors(data, name);
    let sized = |name: &'static str, share: f64| {
        let errors = known.iter().copied().chain([(name, share)]).collect();
        Some((worth(&with_input_errors(data, &errors)?, evidence), errors))
    };
    let best = |name: &'static str| {
        let sizes = SHARES.iter().filter_map(|share| sized(name, *share));
        sizes.filter(|(worth, _)| *worth > 0.0).max_by(|a, b| a.0.total_cmp(&b.0))
    };
    UNSTATED.into_par_iter().filter(is_open).filter_map(best).collect()
}

/// Whether an input varies and states no errors.
fn may_have_errors(data: &DataSplit, name: &str) -> bool {
    data.range(name).is_some() && data.rows.iter().all(|row| row.input_errors.of(name) <= 0.0)
}

/// The rows with errors of inputs that the file does not state.
fn with_input_errors(data: &DataSplit, errors: &Errors) -> Option<Ground> {
    let (mut rows, mut noise) = (data.rows.to_vec(), data.noise.to_vec());
    for (name, share) in errors {
        assume(&data.base, name, *share, &mut rows, &mut noise)?;
    }
    let decided = |&row: &usize| data.base.check(rows[row].wall, &rows[row].impact).is_ok();
    let names: Vec<&str> = errors.iter().map(|(name, _)| *name).collect();
    let sizes = errors.iter().map(|(name, share)| format!("{name} had errors of {:.0} %", 100.0 * share));
    let question = format!(
        "These numbers fit if {}, which the file does not state: how well {} known?",
        sizes.collect::<Vec<_>>().join(" and "),
        if names.len() == 1 { "is it" } else { "are they" }
    );
    data.search.iter().all(decided).then(|| Ground {
        key: format!("artefact:error-of-{}", names.join("-and-")),
        question: Some(question),
        data: DataSplit { rows: rows.into(), noise: noise.into(), ..data.clone() },
        freedom: errors.len() as f64,
        log_prior: Class::Noise.log_prior(UNSTATED.len()) + (errors.len() - 1) as f64 * FURTHER.ln(),
        ..Ground::plain(data)
    })
}

/// The rows with these outliers: of all readings, and of those of each quantity alone. They share the prior probability.
fn with_outliers(data: &DataSplit, shares: Outliers) -> Vec<Ground> {
    let has = |which: usize| data.rows.iter().any(|row| [row.e_n, row.e_t][which].is_some());
    let kinds: &[[bool; 2]] =
        if has(0) && has(1) { &[[true, true], [true, false], [false, true]] } else { &[[true, true]] };
    let with = |&of: &[bool; 2]| {
        let outliers = MoreOutliers { shares, of };
        Ground {
            key: format!("outliers:{}:{}:{of:?}", shares.gross, shares.tails),
            data: DataSplit { noise: outliers.beside(&data.noise), ..data.clone() },
            freedom: 1.0,
            log_prior: -(kinds.len() as f64).ln(),
            outliers: Some(outliers),
            ..Ground::plain(data)
        }
    };
    kinds.iter().map(with).collect()
}

/// The rows read otherwise; `None` where a row has no such reading.
pub(super) fn read(data: &DataSplit, other: &OtherReading, value: f64) -> Option<Ground> {
    let base = other.model.clone().unwrap_or_else(|| data.base.clone());
    let (mut rows, mut noise) = (data.rows.to_vec(), data.noise.to_vec());
    let mut slope = Vec::with_capacity(data.search.len());
    for &row in &data.search {
        slope.push((other.change)(&mut rows[row], &mut noise[row], value)?);
        base.check(rows[row].wall, &rows[row].impact).ok()?;
    }
    let missing = MissingInputs::of(&rows).into();
    let changed = DataSplit { base, rows: rows.into(), noise: noise.into(), missing, ..data.clone() };
    Some(Ground {
        key: other.id.clone(),
        question: Some((other.question)(value)),
        data: changed,
        slope,
        freedom: other.freedom,
        ..Ground::plain(data)
    })
}
