//! Why a row or a header cannot be used.

use super::WallError;
use nearwall::impact::ImpactError;

/// Why a row cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(super) enum RowFault {
    #[error("{name} `{cell}` is not a number{hint}")]
    NotANumber { name: String, cell: String, hint: &'static str },
    #[error("{0} is not finite")]
    NotFinite(String),
    #[error("{0} is blank")]
    Blank(&'static str),
    #[error("{0} is negative")]
    Negative(&'static str),
    #[error("v_t is blank, but v_n is computed from it")]
    NoTangentialSpeed,
    #[error("angle = {0}°: must be between 0° and 90°")]
    Angle(f64),
    #[error("{0} is 0 at this angle and does not determine the other speed")]
    Undetermined(&'static str),
    #[error("{name} is {value}; it must be a whole number from {least}")]
    NotWhole { name: &'static str, value: f64, least: u8 },
    #[error("the row has no observation: all columns of observations are blank")]
    NoObservation,
    #[error("capture_efficiency is {0}; it must be between 0 and 1")]
    NoShare(f64),
    #[error("capture_efficiency is {0}, but n_impacts is 1")]
    ShareOfOne(f64),
    #[error("captured / n_impacts is {count:.4}, but capture_efficiency is {stated}")]
    TwoShares { count: f64, stated: f64 },
    #[error("one outcome cannot describe {0} impacts; give captured or capture_efficiency")]
    OneOutcome(f64),
    #[error("outcome is {word}, but the captured share is {share}")]
    OtherOutcome { word: &'static str, share: f64 },
    #[error("captured is {count}, more than n_impacts = {impacts}")]
    MoreThanImpacts { count: f64, impacts: f64 },
    #[error("captured is {0}, but n_impacts is blank")]
    NoImpacts(f64),
    #[error("outcome `{cell}` is unknown; use one of {known}")]
    UnknownOutcome { cell: String, known: String },
    #[error("{name} is {value}, below {least}")]
    Below { name: &'static str, value: f64, least: f64 },
    #[error("{name} is {value}, above {most}; check its unit")]
    Above { name: &'static str, value: f64, most: f64 },
    #[error(
        "{name} = {value} m: no length of an impact is above {most} m; state the unit, as `{name} [um]` in the \
            heading or in a column map"
    )]
    TooLong { name: &'static str, value: f64, most: f64 },
    #[error("unterminated quotation mark: a quoted cell contains the following rows")]
    OpenQuote,
    #[error(transparent)]
    Impact(#[from] ImpactError),
    #[error(transparent)]
    Wall(#[from] WallError),
}

/// Why the columns of a file do not determine an impact.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(super) enum HeaderError {
    #[error("there is no column `v_n` (normal speed, m/s)")]
    NoNormalSpeed,
    #[error("{0} over-determine the velocity; keep {SUFFICIENT}")]
    OverDetermined(String),
    #[error("{0} alone does not determine the normal speed; give {SUFFICIENT}")]
    UnderDetermined(String),
    #[error(
        "{map} reads {name} from column `{column}`, but a column `{name}` exists too; list it under [ignore] or use it"
    )]
    TwoColumns { map: String, name: &'static str, column: String },
    #[error("columns `{one}` and `{two}` both mean {name}; rename one")]
    Ambiguous { name: &'static str, one: String, two: String },
    #[error("column `{column}`: unknown unit `{unit}`; use one of {known}")]
    UnknownUnit { column: String, unit: String, known: String },
    #[error("{map} reads {name} from a missing column: {problem}")]
    NoColumn { map: String, name: &'static str, problem: String },
}

impl RowFault {
    /// Whether it is hardly that of one row: the numbers of the column have another unit.
    pub(super) fn is_of_file(&self) -> bool {
        matches!(self, Self::TooLong { .. })
    }
}

/// The columns that determine the velocity.
const SUFFICIENT: &str = "v_n, or v_n and v_t, or angle with one of speed, v_n and v_t";
