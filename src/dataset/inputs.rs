//! The inputs of an impact in the cells of a row.

use super::number::NumberColumn;
use crate::impact::{INPUTS, Impact};

/// The column of each of [`INPUTS`].
pub(super) struct InputColumns {
    columns: [Option<NumberColumn>; INPUTS.len()],
}

/// Whether a row states each of [`INPUTS`].
pub(super) type Stated = [bool; INPUTS.len()];

/// The index of the input of this name; that beyond the last one if there is none.
pub(super) fn position(name: &str) -> usize {
    INPUTS.iter().position(|input| input.name == name).unwrap_or(INPUTS.len())
}

impl InputColumns {
    /// Looks up the column of each input.
    pub(super) fn new(column: impl Fn(&'static str) -> Option<NumberColumn>) -> Self {
        Self { columns: std::array::from_fn(|input: usize| column(INPUTS[input].name)) }
    }

    /// Whether this input has a column.
    pub(super) fn gives(&self, name: &str) -> bool {
        self.columns.get(position(name)).is_some_and(Option::is_some)
    }

    /// Reads a row's inputs; blank ones keep their default. The impact is not checked yet.
    ///
    /// # Errors
    /// The reason, for a cell that is not a number or a blank `v_n`.
    pub(super) fn read(&self, cells: &csv::StringRecord) -> Result<(Impact, Stated), String> {
        let mut impact = Impact::default();
        let mut stated = Stated::default();
        for (place, (input, column)) in INPUTS.iter().zip(&self.columns).enumerate() {
            let Some(column) = column else { continue };
            match column.read(cells)? {
                Some(value) => {
                    (input.set)(&mut impact, value);
                    stated[place] = true;
                }
                None if input.name == "v_n" => return Err("v_n is blank".to_owned()),
                None => {}
            }
        }
        Ok((impact, stated))
    }
}
