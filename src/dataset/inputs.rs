//! The inputs of an impact in the cells of a row.

use super::number::NumberColumn;
use crate::impact::{INPUTS, Impact};

/// For each of [`INPUTS`] the column that gives it.
pub(super) struct InputColumns {
    columns: [Option<NumberColumn>; INPUTS.len()],
}

/// For each of [`INPUTS`] whether a row states it.
pub(super) type Stated = [bool; INPUTS.len()];

/// Which of [`INPUTS`] has this name; beyond the last for a name that is none.
pub(super) fn position(name: &str) -> usize {
    INPUTS.iter().position(|input| input.name == name).unwrap_or(INPUTS.len())
}

impl InputColumns {
    /// Asks for the column of each name.
    pub(super) fn new(column: impl Fn(&'static str) -> Option<NumberColumn>) -> Self {
        Self { columns: std::array::from_fn(|input: usize| column(INPUTS[input].name)) }
    }

    /// Whether a column gives this input.
    pub(super) fn gives(&self, name: &str) -> bool {
        self.columns.get(position(name)).is_some_and(Option::is_some)
    }

    /// Reads a row's inputs; blank ones keep their default. The impact is not checked yet.
    ///
    /// # Errors
    /// The reason, for a cell that is no number or a blank `v_n`.
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
