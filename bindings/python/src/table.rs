//! Tables between Python and the library: columns of numbers or of texts.

use std::fmt::Write as _;
use std::io::Read;

use pyo3::prelude::*;
use pyo3::types::PyByteArray;

use crate::work::{Failure, run};

/// The rows of a table as Python hands them over.
#[derive(FromPyObject)]
pub enum TableSource {
    /// Path of a CSV file.
    #[pyo3(transparent)]
    File(String),
    /// Names and columns.
    #[pyo3(transparent)]
    Columns(Vec<(String, InputColumn)>),
}

/// A column.
#[derive(FromPyObject)]
pub enum InputColumn {
    /// 64-bit floats in the order of this machine; NaN is a blank.
    #[pyo3(transparent)]
    Numbers(Vec<u8>),
    /// Texts; none is a blank.
    #[pyo3(transparent)]
    Texts(Vec<Option<String>>),
}

/// A column for Python: its name, and a `bytearray` of 64-bit floats or a list of texts.
pub type ForPython = (String, Py<PyAny>);

/// Name of a table without a file in messages.
const FRAME: &str = "frame";

impl TableSource {
    /// Its name in messages.
    pub fn name(&self) -> &str {
        match self {
            Self::File(path) => path,
            Self::Columns(_) => FRAME,
        }
    }

    /// The text of the file, or CSV text of the columns: line 1 has the names, line 2 the first
    /// row. Numbers read back to the same bits.
    ///
    /// # Errors
    /// A file that cannot be opened.
    pub fn open(&self) -> Result<Box<dyn Read + Send>, Failure> {
        match self {
            Self::File(path) => {
                Ok(Box::new(std::fs::File::open(path).map_err(|error| format!("{path}: {error}"))?))
            }
            Self::Columns(columns) => Ok(Box::new(std::io::Cursor::new(csv_text(columns)?))),
        }
    }
}

impl InputColumn {
    fn len(&self) -> usize {
        match self {
            Self::Numbers(bytes) => bytes.len() / size_of::<f64>(),
            Self::Texts(texts) => texts.len(),
        }
    }

    /// The cell of a row. Whole numbers have no point, so that labels such as 3 stay as they are.
    fn cell(&self, row: usize, cell: &mut String) -> std::fmt::Result {
        match self {
            Self::Numbers(bytes) => {
                let number = bytes.as_chunks().0.get(row).map(|number| f64::from_ne_bytes(*number));
                let Some(number) = number.filter(|number| !number.is_nan()) else { return Ok(()) };
                let plain = number == 0.0 || (1e-5..1e16).contains(&number.abs());
                if plain { write!(cell, "{number}") } else { write!(cell, "{number:e}") }
            }
            Self::Texts(texts) => {
                cell.write_str(texts.get(row).and_then(Option::as_deref).unwrap_or_default())
            }
        }
    }
}

fn csv_text(columns: &[(String, InputColumn)]) -> Result<Vec<u8>, Failure> {
    // A row that begins with # would be a comment, and a row of one blank cell no row.
    let mut writer = csv::WriterBuilder::new().comment(Some(b'#')).from_writer(Vec::new());
    writer.write_record(columns.iter().map(|(name, _)| name))?;
    let rows = columns.iter().map(|(_, column)| column.len()).max().unwrap_or_default();
    let mut cell = String::new();
    for row in 0..rows {
        for (_, column) in columns {
            cell.clear();
            column.cell(row, &mut cell)?;
            writer.write_field(&cell)?;
        }
        writer.write_record(None::<&[u8]>)?;
    }
    Ok(writer.into_inner().map_err(|error| error.to_string())?)
}

/// The columns of a table whose cells are texts.
pub struct TableCells {
    header: Vec<String>,
    columns: Vec<Vec<String>>,
}

impl TableCells {
    /// An empty table.
    pub fn new(header: impl IntoIterator<Item = String>) -> Self {
        let header: Vec<String> = header.into_iter().collect();
        let columns = header.iter().map(|_| Vec::new()).collect();
        Self { header, columns }
    }

    /// Adds a row.
    pub fn push<'a>(&mut self, cells: impl IntoIterator<Item = &'a str>) {
        for (column, cell) in self.columns.iter_mut().zip(cells) {
            column.push(cell.to_owned());
        }
    }

    /// Reads CSV text; lines that begin with `#` are comments.
    pub fn read(source: impl Read) -> Result<Self, Failure> {
        let mut reader =
            csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::Headers).from_reader(source);
        let mut table = Self::new(reader.headers()?.iter().map(str::to_owned));
        for record in reader.into_records() {
            table.push(&record?);
        }
        Ok(table)
    }

    /// Columns of which every cell is a number or blank become numbers; a blank is NaN.
    pub fn for_python(self, py: Python<'_>) -> PyResult<Vec<ForPython>> {
        self.header
            .into_iter()
            .zip(self.columns)
            .map(|(name, cells)| Ok((name, column(py, cells)?)))
            .collect()
    }
}

fn column(py: Python<'_>, cells: Vec<String>) -> PyResult<Py<PyAny>> {
    let number = |cell: &String| {
        let cell = cell.trim();
        if cell.is_empty() { Some(f64::NAN) } else { cell.parse().ok() }
    };
    let parsed: Option<Vec<f64>> = cells.iter().map(number).collect();
    match parsed {
        Some(values) => Ok(floats(py, &values)),
        None => {
            let texts = cells.into_iter().map(|cell| (!cell.is_empty()).then_some(cell));
            Ok(texts.collect::<Vec<_>>().into_pyobject(py)?.unbind())
        }
    }
}

/// A `bytearray` with these numbers.
pub fn floats(py: Python<'_>, values: &[f64]) -> Py<PyAny> {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_ne_bytes()).collect();
    PyByteArray::new(py, &bytes).into_any().unbind()
}

/// The text of a table as a CSV file.
#[pyfunction]
pub fn csv_of(py: Python<'_>, data: TableSource) -> PyResult<Vec<u8>> {
    run(py, |_| {
        let mut text = Vec::new();
        data.open()?.read_to_end(&mut text)?;
        Ok(text)
    })
}

/// Reads the columns of a CSV file.
#[pyfunction]
pub fn read_csv(py: Python<'_>, path: String) -> PyResult<Vec<ForPython>> {
    let cells = run(py, |_| {
        let source = std::fs::File::open(&path).map_err(|error| format!("{path}: {error}"))?;
        TableCells::read(source).map_err(|error| format!("{path}: {error}").into())
    })?;
    cells.for_python(py)
}
