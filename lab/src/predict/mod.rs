//! Predictions for a table of impacts: what `nearwall predict` and the Python package add to each row.
//!
//! Data flow: [`ImpactReader`] → row → [`Predictor`] → [`PredictedRow`]; [`RowNotes`] counts the
//! rows and keeps the warnings about them, [`file_notes`] has those about the columns. Rows do not
//! depend on each other, so they may be predicted on several threads.

mod notes;

use std::io::Read;
use std::path::Path;

use crate::dataset::{BadRow, ImpactReader, ImpactRow, WallChoice, WallError};
use crate::range::{RangeReader, Reason};
use crate::rig::{Band, DrawnModels, DrawsError};
use nearwall::impact::ImpactError;
use nearwall::model::{Expectation, Model};

pub use notes::{RowNotes, file_notes};

/// The predicted numbers of a row [1].
pub const VALUES: [&str; 3] = ["e_n", "e_t", "p_stick"];
/// The ends of the 95 % bands of [`VALUES`] over drawn models [1].
pub const BANDS: [&str; 6] = ["e_n_low", "e_n_high", "e_t_low", "e_t_high", "p_stick_low", "p_stick_high"];

/// The column of the stated ranges that a row leaves.
pub const BEYOND: &str = "beyond";
/// The time of contact of a row [s].
pub const CONTACT_TIME: &str = "contact_time";

/// Draws of what a model draws by chance, for the mean of each row.
const DRAWS_A_ROW: usize = 64;

/// Predicts the rows of a file.
pub struct Predictor<'a> {
    model: &'a Model,
    drawn: Vec<Model>,
    ranges: RangeReader<'a>,
    walls: WallChoice<'a>,
    /// The column that names the wall of a row.
    wall_column: Option<usize>,
    contact_time: bool,
}

/// The prediction for a row.
#[derive(Debug, Clone, PartialEq)]
pub struct PredictedRow {
    /// The numbers named in [`VALUES`].
    pub values: [f64; 3],
    /// Low and high end of the band of each value; empty without drawn models.
    pub bands: Vec<[f64; 2]>,
    /// Time [s] that a solid particle touches the wall, where it is asked for.
    pub contact_time: Option<f64>,
    /// Name of the regime.
    pub regime: &'static str,
    /// The stated ranges that the impact leaves.
    pub beyond: Vec<Reason>,
}

impl PredictedRow {
    /// The cell of the column [`BEYOND`]: the ranges that the impact leaves.
    pub fn beyond_text(&self) -> String {
        self.beyond.iter().map(Reason::to_string).collect::<Vec<_>>().join("; ")
    }
}

/// Why a row cannot be predicted.
#[derive(Debug, thiserror::Error)]
enum PredictError {
    #[error(transparent)]
    Wall(#[from] WallError),
    #[error(transparent)]
    Impact(#[from] ImpactError),
}

impl<'a> Predictor<'a> {
    /// A predictor for the rows of `reader`; `wall` is the wall that the user gives for all rows.
    ///
    /// # Errors
    /// [`WallError::NotInModel`], [`WallError::Undecided`].
    pub fn new(
        model: &'a Model,
        wall: Option<&str>,
        reader: &ImpactReader<impl Read>,
    ) -> Result<Self, WallError> {
        let (walls, wall_column) = (WallChoice::new(model, wall)?, reader.column("wall"));
        walls.check(wall_column.is_some())?;
        let ranges = RangeReader::new(model);
        Ok(Self { model, drawn: Vec::new(), ranges, walls, wall_column, contact_time: false })
    }

    /// Adds the time of contact to each row.
    #[must_use]
    pub fn with_contact_time(self, contact_time: bool) -> Self {
        Self { contact_time, ..self }
    }

    /// Whether rows have a time of contact.
    pub fn has_contact_time(&self) -> bool {
        self.contact_time
    }

    /// Adds the models of a folder that were drawn from the fit of the model; each row then has bands.
    ///
    /// # Errors
    /// As [`DrawnModels::from_folder`].
    pub fn read_draws(&mut self, folder: &Path) -> Result<(), DrawsError> {
        self.drawn = DrawnModels::from_folder(folder, self.model)?.models;
        Ok(())
    }

    /// The model.
    pub fn model(&self) -> &'a Model {
        self.model
    }

    /// Whether rows have bands.
    pub fn has_bands(&self) -> bool {
        !self.drawn.is_empty()
    }

    /// Index of the wall that the impact of a row hits.
    ///
    /// # Errors
    /// [`WallError::Unknown`].
    pub fn wall(&self, row: &ImpactRow) -> Result<usize, WallError> {
        self.walls.of(self.wall_column.and_then(|column| row.cells.get(column)))
    }

    /// Predicts a row.
    ///
    /// # Errors
    /// The line of the row, and why the model cannot decide the impact.
    pub fn row(&self, row: &ImpactRow) -> Result<PredictedRow, BadRow> {
        self.predict(row).map_err(|error| BadRow { line: row.line, reason: error.to_string() })
    }

    fn predict(&self, row: &ImpactRow) -> Result<PredictedRow, PredictError> {
        let wall = self.wall(row)?;
        let expect = |model: &Model| model.expect(wall, &row.impact, DRAWS_A_ROW);
        let mean = expect(self.model)?;
        let drawn = self.drawn.iter().map(|model| expect(model).map(|mean| values(&mean)));
        let drawn: Vec<[f64; 3]> = drawn.collect::<Result<_, _>>()?;
        let contact_time =
            self.contact_time.then(|| self.model.contact_time(wall, &row.impact)).transpose()?;
        let beyond = if mean.outside_range { self.ranges.reasons(wall, &row.impact) } else { Vec::new() };
        Ok(PredictedRow {
            values: values(&mean),
            contact_time,
            bands: bands(&drawn),
            regime: mean.regime.name(),
            beyond,
        })
    }
}

/// The numbers named in [`VALUES`].
fn values(mean: &Expectation) -> [f64; 3] {
    [mean.normal_restitution, mean.tangential_restitution, mean.sticking_probability]
}

/// The ends of the band of each value over draws; empty without draws.
fn bands(drawn: &[[f64; 3]]) -> Vec<[f64; 2]> {
    if drawn.is_empty() {
        return Vec::new();
    }
    let band = |which: usize| {
        let Band { low, high, .. } = Band::of(drawn.iter().map(|values| values[which]).collect());
        [low, high]
    };
    (0..VALUES.len()).map(band).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: &str = "[particle]\nmaterial = \"montan-wax\"\n[walls.glass]\nmaterial = \"pyrex\"\n\
        [walls.steel]\nmaterial = \"stainless-steel\"\n[normal]\nmodel = \"thornton-ning\"\nyield_ratio = 0.7\n\
        [tangential]\nmodel = \"constant\"\ne_t = 0.76\n";

    #[test]
    fn rows_are_predicted_on_their_wall_and_counted() {
        let model = Model::from_toml("m.toml", MODEL).unwrap();
        let text = "v_n,wall\n1,glass\n1,wood\nfast,glass\n1,steel\n";
        let mut reader = ImpactReader::new("t.csv", text.as_bytes()).unwrap();
        let predictor = Predictor::new(&model, None, &reader).unwrap();
        let (mut notes, mut found) = (RowNotes::default(), Vec::new());
        while let Some(next) = reader.next_row().unwrap() {
            found.push(notes.predict(&predictor, next.as_ref()).map(|(_, predicted)| predicted));
        }
        for (row, wall) in [(0, 0), (3, 1)] {
            let impact = nearwall::Impact { normal_speed: 1.0, ..nearwall::Impact::default() };
            let mean = model.expect(wall, &impact, DRAWS_A_ROW).unwrap();
            let predicted = found[row].as_ref().unwrap();
            assert_eq!((predicted.values, predicted.regime), (values(&mean), mean.regime.name()));
            assert!(predicted.bands.is_empty() && !predictor.has_bands());
        }
        let bad = |row: usize| found[row].as_ref().unwrap_err();
        assert_eq!((bad(1).line, bad(2).line), (3, 4));
        assert!(bad(1).reason.contains("no wall `wood`"), "{}", bad(1).reason);
        assert_eq!((notes.predicted(), notes.left_out()), (2, 2));
    }

    #[test]
    fn a_file_without_walls_needs_one() {
        let model = Model::from_toml("m.toml", MODEL).unwrap();
        let reader = ImpactReader::new("t.csv", "v_n\n1\n".as_bytes()).unwrap();
        assert!(matches!(Predictor::new(&model, None, &reader), Err(WallError::Undecided { .. })));
        assert!(Predictor::new(&model, Some("steel"), &reader).is_ok());
    }

    #[test]
    fn bands_hold_the_ends_of_each_value() {
        let drawn: Vec<[f64; 3]> =
            (1..=39).map(|draw| [1.0, 2.0, 3.0].map(|v| v * f64::from(draw))).collect();
        assert_eq!(bands(&drawn), [[1.0, 39.0], [2.0, 78.0], [3.0, 117.0]]);
        assert!(bands(&[]).is_empty());
    }
}
