//! The diagnosis of a file of measured impacts, from its reading to the drawn models: what the
//! command `nearwall diagnose` and the Python package have in common.

use std::io::Read;
use std::path::Path;

use super::{Diagnosis, DiagnosisError, Options, diagnose_with_draws, read_measurements};
use crate::dataset::{ColumnMap, DatasetError, Measurements, WallChoice};
use nearwall::input::{Document, InputError};
use nearwall::model::Model;

/// A base model, how a data file is read, and options.
pub struct ImpactDiagnosis {
    document: Document,
    model: Model,
    columns: ColumnMap,
    wall: Option<String>,
    options: Options,
}

/// Why a file of measured impacts has no diagnosis.
#[derive(Debug, thiserror::Error)]
#[error("{file}: {reason}")]
pub struct FileDiagnosisError {
    /// The file at fault: the data or the model.
    pub file: String,
    /// The reason.
    pub reason: DiagnosisError,
}

impl ImpactDiagnosis {
    /// A diagnosis against the model file `document`. `columns` is a column map, `wall` the wall
    /// that the user gives for all rows; the group of `options` is named as in the data file or as
    /// in nearwall.
    ///
    /// # Errors
    /// An error in the model file or in the column map.
    pub fn new(
        document: Document,
        columns: Option<&Path>,
        wall: Option<&str>,
        mut options: Options,
    ) -> Result<Self, InputError> {
        let model = Model::from_toml(document.name(), document.text())?;
        let mut columns = columns.map(ColumnMap::from_file).transpose()?.unwrap_or_default();
        options.group = options.group.map(|column| columns.label(&column));
        Ok(Self { document, model, columns, wall: wall.map(str::to_owned), options })
    }

    /// Reads measured impacts in bounded memory; `file` names the source in messages.
    ///
    /// # Errors
    /// As [`read_measurements`], and a group that no column of labels gives.
    pub fn read(&self, file: &str, source: impl Read) -> Result<Measurements, DatasetError> {
        let walls = WallChoice::new(&self.model, self.wall.as_deref())?;
        let data = read_measurements(file, source, Some(&self.columns), &walls, &self.model)?;
        if let Some(group) = &self.options.group {
            data.check_group(group)?;
        }
        Ok(data)
    }

    /// Diagnoses measured impacts, with `draws` drawn models, as [`diagnose_with_draws`].
    ///
    /// # Errors
    /// Why there is no diagnosis, with the file at fault.
    pub fn run(
        &self,
        data: &Measurements,
        draws: usize,
        progress: &(dyn Fn(&str) + Sync),
    ) -> Result<(Diagnosis, String, Vec<String>), FileDiagnosisError> {
        let text = self.document.text();
        diagnose_with_draws(&self.model, text, data, &self.options, draws, progress).map_err(|reason| {
            let file = match reason {
                DiagnosisError::TooFewRows { .. } | DiagnosisError::NoInput { .. } => &data.file,
                DiagnosisError::Unextendable(_) => self.document.name(),
            };
            FileDiagnosisError { file: file.to_owned(), reason }
        })
    }
}
