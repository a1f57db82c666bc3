//! Impacts in blocks, as columns.

use super::{INPUTS, Impact};

/// Largest number of impacts in a block: the columns stay in the first-level cache.
pub const BLOCK: usize = 128;

/// Up to [`BLOCK`] impacts on one wall, as columns.
#[derive(Debug, Clone)]
pub struct Block {
    /// A column for each of [`INPUTS`], in their order and units.
    pub inputs: [[f64; BLOCK]; INPUTS.len()],
    /// A column for each input that the model declares, in their order, NaN where an impact does not state it; may be shorter.
    pub extra: Vec<[f64; BLOCK]>,
    /// Unique key of each impact, for its random numbers.
    pub keys: [u64; BLOCK],
    /// Number of impacts, at most [`BLOCK`].
    pub length: usize,
}

impl Default for Block {
    fn default() -> Self {
        let impact = Impact::default();
        let inputs = std::array::from_fn(|input| [(INPUTS[input].value)(&impact); BLOCK]);
        Self { inputs, extra: Vec::new(), keys: [0; BLOCK], length: 0 }
    }
}

impl Block {
    /// The [`INPUTS`] of one of the impacts.
    #[inline(always)]
    pub(crate) fn inputs_of(&self, index: usize) -> Impact {
        Impact::from_inputs(|input| self.inputs[input][index])
    }

    /// One of the impacts.
    #[inline]
    pub(crate) fn impact(&self, index: usize) -> Impact {
        let mut impact = self.inputs_of(index);
        for (value, column) in impact.extra.iter_mut().zip(&self.extra) {
            *value = column[index];
        }
        impact
    }
}
