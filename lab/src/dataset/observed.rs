//! The observations of a row: of one impact, or an average over several.

use super::measurements::{Limit, Measurement, Reading};
use super::number::{NamedColumns, is_blank};
use super::row_error::RowFault;
use nearwall::input::{InputError, Section};

/// Largest plausible restitution [1]. Rough walls and spin give more than 1; a larger value is in another unit.
const HIGHEST: f64 = 3.0;

/// Largest difference [1] between a counted and a stated share of captures, due to rounding.
const SHARE_ROUNDING: f64 = 0.01;

/// What is unusual about the observations of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Remarks {
    /// Whether the captured share is that of an unknown number of impacts.
    pub(super) uncounted: bool,
    /// Whether a standard error is 0, which is treated as unknown.
    pub(super) no_error: bool,
}

/// The words of the column `outcome`, in lower case.
#[derive(Debug, Clone, Default)]
pub(super) struct OutcomeWords {
    rebound: Vec<String>,
    stick: Vec<String>,
}

impl OutcomeWords {
    const REBOUND: [&str; 2] = ["rebound", "bounce"];
    const STICK: [&str; 3] = ["stick", "stuck", "captured"];

    /// Reads the words that a column map adds.
    pub(super) fn read(details: &Section<'_>) -> Result<Self, InputError> {
        let words = |key: &str| -> Result<Vec<String>, InputError> {
            let list = details.texts(key)?.unwrap_or_default();
            Ok(list.iter().map(|word| word.trim().to_lowercase()).collect())
        };
        let all = Self { rebound: words("rebound")?, stick: words("stick")? };
        if let Some(word) = all.rebound.iter().find(|word| all.stick.contains(word)) {
            return Err(details
                .fault("stick", format!("`{word}` is also listed under rebound; remove one of the two")));
        }
        Ok(all)
    }

    /// Whether the word means capture; the words of the map take precedence over nearwall's own.
    fn captured(&self, cell: &str) -> Option<bool> {
        let word = cell.to_lowercase();
        let own = |list: &[String]| list.contains(&word);
        match (own(&self.stick), own(&self.rebound)) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ if Self::STICK.contains(&word.as_str()) => Some(true),
            _ if Self::REBOUND.contains(&word.as_str()) => Some(false),
            _ => None,
        }
    }

    fn unknown(&self, cell: &str) -> RowFault {
        let own = self.rebound.iter().chain(&self.stick).map(String::as_str);
        let known: Vec<&str> = Self::REBOUND.into_iter().chain(Self::STICK).chain(own).collect();
        RowFault::UnknownOutcome { cell: cell.to_owned(), known: known.join(", ") }
    }
}

/// What a cell of `e_n` or `e_t` says.
#[derive(Debug, Clone, Copy)]
enum Seen {
    Reading(Reading),
    Limit(Limit),
}

/// A value, or what bounds it.
fn split(seen: Option<Seen>) -> (Option<Reading>, Option<Limit>) {
    match seen {
        Some(Seen::Reading(reading)) => (Some(reading), None),
        Some(Seen::Limit(limit)) => (None, Some(limit)),
        None => (None, None),
    }
}

/// The cells of a row with an observation.
pub(super) struct ObservedCells<'a> {
    pub(super) columns: &'a NamedColumns,
    pub(super) words: &'a OutcomeWords,
    pub(super) cells: &'a csv::StringRecord,
}

impl ObservedCells<'_> {
    /// Reads the observations into their row.
    ///
    /// # Errors
    /// The reason why the row cannot be used.
    pub(super) fn read_into(&self, row: &mut Measurement) -> Result<Remarks, RowFault> {
        let counted = self.number("n_impacts")?;
        row.impacts = counted.unwrap_or(1.0);
        if row.impacts < 1.0 || row.impacts.fract() != 0.0 {
            return Err(RowFault::NotWhole { name: "n_impacts", value: row.impacts, least: 1 });
        }
        row.captured = self.share_captured(counted)?;
        let uncounted = counted.is_none() && row.captured.is_some_and(|share| share.fract() != 0.0);
        let mut no_error = false;
        // Without rebounds there is no e_n and e_t.
        if row.captured != Some(1.0) {
            let seen = [
                self.reading(["e_n", "e_n_err"], 0.0, &mut no_error)?,
                self.reading(["e_t", "e_t_err"], -HIGHEST, &mut no_error)?,
            ];
            let [e_n, e_t] = seen.map(split);
            (row.e_n, row.e_t, row.limits) = (e_n.0, e_t.0, [e_n.1, e_t.1]);
        }
        let no_rebound = row.e_n.is_some_and(|e| e.value == 0.0) && row.e_t.is_none_or(|e| e.value == 0.0);
        let no_rebound = no_rebound && row.limits[1].is_none();
        if row.captured.is_none() && no_rebound {
            // A particle that does not rebound is captured (Troiano et al., Eq. 14).
            (row.captured, row.e_n, row.e_t, no_error) = (Some(1.0), None, None, false);
        }
        // At least one of the rebounds, although the captured share may be rounded.
        row.rebounds = match row.captured {
            None => row.impacts,
            Some(1.0) => 0.0,
            Some(share) => (row.impacts * (1.0 - share)).max(1.0),
        };
        let limited = row.limits.iter().any(Option::is_some);
        if row.captured.is_none() && row.e_n.is_none() && row.e_t.is_none() && !limited {
            return Err(RowFault::NoObservation);
        }
        Ok(Remarks { uncounted, no_error })
    }

    /// The captured share of the impacts [1], if recorded.
    fn share_captured(&self, counted: Option<f64>) -> Result<Option<f64>, RowFault> {
        let impacts = counted.unwrap_or(1.0);
        let count = self.count_captured(counted)?.map(|count| count / impacts);
        let stated = self.number("capture_efficiency")?;
        if let Some(share) = stated.filter(|share| !(0.0..=1.0).contains(share)) {
            return Err(RowFault::NoShare(share));
        }
        if let (Some(share), Some(1.0)) = (stated.filter(|share| share.fract() != 0.0), counted) {
            return Err(RowFault::ShareOfOne(share));
        }
        if let (Some(count), Some(stated)) = (count, stated)
            && (count - stated).abs() > SHARE_ROUNDING
        {
            return Err(RowFault::TwoShares { count, stated });
        }
        let share = count.or(stated);
        match (self.outcome()?, share) {
            (None, share) => Ok(share),
            (Some(_), None) if impacts > 1.0 => Err(RowFault::OneOutcome(impacts)),
            (Some(stuck), None) => Ok(Some(f64::from(stuck))),
            (Some(stuck), Some(share)) if f64::from(stuck) == share => Ok(Some(share)),
            (Some(stuck), Some(share)) => {
                let word = if stuck { "stick" } else { "rebound" };
                Err(RowFault::OtherOutcome { word, share })
            }
        }
    }

    fn count_captured(&self, counted: Option<f64>) -> Result<Option<f64>, RowFault> {
        let Some(count) = self.number("captured")? else { return Ok(None) };
        if count < 0.0 || count.fract() != 0.0 {
            return Err(RowFault::NotWhole { name: "captured", value: count, least: 0 });
        }
        match counted {
            Some(impacts) if count > impacts => Err(RowFault::MoreThanImpacts { count, impacts }),
            None if count > 1.0 => Err(RowFault::NoImpacts(count)),
            _ => Ok(Some(count)),
        }
    }

    fn outcome(&self) -> Result<Option<bool>, RowFault> {
        let cell = self.columns.index("outcome").and_then(|index| self.cells.get(index)).unwrap_or("");
        match self.words.captured(cell) {
            None if is_blank(cell) => Ok(None),
            None => Err(self.words.unknown(cell)),
            known => Ok(known),
        }
    }

    /// A restitution of at least `lowest`, or a limit of it, with its standard error; one of 0 sets `no_error`.
    fn reading(
        &self,
        [name, error]: [&'static str; 2],
        lowest: f64,
        no_error: &mut bool,
    ) -> Result<Option<Seen>, RowFault> {
        let limit = self.columns.column(name).map_or(Ok(None), |column| column.read_limit(self.cells))?;
        let value = limit.map_or_else(|| self.number(name), |(value, _)| Ok(Some(value)))?;
        let Some(value) = value else { return Ok(None) };
        if value < lowest {
            return Err(match lowest {
                0.0 => RowFault::Negative(name),
                _ => RowFault::Below { name, value, least: lowest },
            });
        }
        if value > HIGHEST {
            return Err(RowFault::Above { name, value, most: HIGHEST });
        }
        let stated = self.number(error)?;
        if stated.is_some_and(|stated| stated < 0.0) {
            return Err(RowFault::Negative(error));
        }
        *no_error |= stated == Some(0.0);
        let reading = Reading { value, error: stated.filter(|stated| *stated > 0.0) };
        Ok(Some(match limit {
            Some((_, below)) => Seen::Limit(Limit { reading, below }),
            None => Seen::Reading(reading),
        }))
    }

    fn number(&self, name: &str) -> Result<Option<f64>, RowFault> {
        self.columns.column(name).map_or(Ok(None), |column| column.read_finite(self.cells))
    }
}
