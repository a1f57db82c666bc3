//! The inputs of an impact in the cells of a row.

use super::headings::FoundColumn;
use super::number::{NumberColumn, NumberStyle, is_blank};
use super::row_error::RowFault;
use nearwall::impact::{ExtraInput, INPUTS, Impact};

/// The column of each of [`INPUTS`], and of the inputs that the model declares.
pub(super) struct InputColumns {
    columns: [Option<NumberColumn>; INPUTS.len()],
    extra: Vec<ExtraColumn>,
}

/// The column of an input that the model declares.
struct ExtraColumn {
    input: ExtraInput,
    /// Its place in [`Impact::extra`].
    place: usize,
    /// Its column; `None` where the file does not have it.
    column: Option<FoundColumn>,
    style: NumberStyle,
}

/// Largest length of an impact [m]: a larger number is in another unit.
const LONGEST: f64 = 1.0;

/// Whether a row states each of [`INPUTS`].
pub(super) type StatedInputs = [bool; INPUTS.len()];

/// The index of the input of this name; that beyond the last one if there is none.
pub(super) fn position(name: &str) -> usize {
    INPUTS.iter().position(|input| input.name == name).unwrap_or(INPUTS.len())
}

impl InputColumns {
    /// Looks up the column of each input.
    pub(super) fn new(column: impl Fn(&'static str) -> Option<NumberColumn>) -> Self {
        Self { columns: std::array::from_fn(|input: usize| column(INPUTS[input].name)), extra: Vec::new() }
    }

    /// The same with the inputs that the model declares; `find` finds the column of a name.
    pub(super) fn with_extra(
        self,
        inputs: &[ExtraInput],
        style: NumberStyle,
        find: impl Fn(&str) -> Option<FoundColumn>,
    ) -> Self {
        let column = |(place, input): (usize, &ExtraInput)| ExtraColumn {
            input: input.clone(),
            place,
            column: find(&input.name),
            style,
        };
        Self { extra: inputs.iter().enumerate().map(column).collect(), ..self }
    }

    /// The columns of inputs.
    pub(super) fn columns(&self) -> impl Iterator<Item = &NumberColumn> {
        self.columns.iter().flatten()
    }

    /// The inputs that the model declares, by place, and whether they have a column.
    pub(super) fn extra(&self) -> impl Iterator<Item = (&ExtraInput, bool)> {
        self.extra.iter().map(|column| (&column.input, column.column.is_some()))
    }

    /// Whether the column with this index is an input that the model declares.
    pub(super) fn is_extra(&self, index: usize) -> bool {
        self.extra.iter().any(|column| column.column.is_some_and(|found| found.index == index))
    }

    /// Whether this input has a column.
    pub(super) fn gives(&self, name: &str) -> bool {
        self.columns.get(position(name)).is_some_and(Option::is_some)
    }

    /// Reads a row's inputs into `impact`; blank ones have their default, those that the model
    /// declares NaN. The impact is not checked yet.
    ///
    /// # Errors
    /// The reason, for a cell that is not a number, a blank `v_n` or a length in another unit.
    pub(super) fn read(
        &self,
        cells: &csv::StringRecord,
        impact: &mut Impact,
    ) -> Result<StatedInputs, RowFault> {
        *impact = Impact::default();
        let mut stated = StatedInputs::default();
        for (place, (input, column)) in INPUTS.iter().zip(&self.columns).enumerate() {
            let Some(column) = column else { continue };
            match column.read(cells)? {
                Some(value) if input.unit == "m" && value > LONGEST => {
                    return Err(RowFault::TooLong { name: input.name, value, most: LONGEST });
                }
                Some(value) => {
                    (input.set)(impact, value);
                    stated[place] = true;
                }
                None if input.name == "v_n" => return Err(RowFault::Blank("v_n")),
                None => {}
            }
        }
        for column in &self.extra {
            if let Some(value) = column.read(cells)? {
                impact.extra[column.place] = value;
            }
        }
        Ok(stated)
    }
}

impl ExtraColumn {
    fn to_si(&self, number: f64) -> f64 {
        self.column.map_or(number, |found| found.unit.to_si(number))
    }

    /// The value in a row; `None` where it is blank.
    ///
    /// # Errors
    /// The reason, for a cell that should be a number and is not.
    fn read(&self, cells: &csv::StringRecord) -> Result<Option<f64>, RowFault> {
        let cell = self.column.and_then(|found| cells.get(found.index)).unwrap_or("");
        if cell.is_empty() || (self.style.markers && is_blank(cell)) {
            return Ok(None);
        }
        let name = &self.input.name;
        let value = match self.input.is_label() {
            true => self.input.value_of_text(cell),
            false => self.style.parse(cell).map(|number| self.to_si(number)),
        };
        match value {
            None => Err(self.style.not_a_number(name, cell)),
            Some(value) if !value.is_finite() => Err(RowFault::NotFinite(name.clone())),
            value => Ok(value),
        }
    }
}
