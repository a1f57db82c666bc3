//! Impacts in blocks, as columns.

use super::{INPUTS, Impact, Outcome};

/// Largest number of impacts in a block: the columns stay in the first-level cache.
pub const BLOCK: usize = 128;

/// Up to [`BLOCK`] impacts on one wall, as columns.
#[derive(Debug, Clone)]
pub struct Block {
    /// A column for each of [`INPUTS`], in their order and units.
    pub inputs: [[f64; BLOCK]; INPUTS.len()],
    /// A column for each input that the model declares, in their order, NaN where an impact does
    /// not state it; may be shorter.
    pub extra: Vec<[f64; BLOCK]>,
    /// Unique key of each impact, for its random numbers.
    pub keys: [u64; BLOCK],
    /// Number of impacts, at most [`BLOCK`].
    pub length: usize,
}

/// The outcomes of a [`Block`], as columns: the fields of [`Outcome`](super::Outcome).
#[derive(Debug, Clone)]
pub struct Outcomes {
    /// Normal restitution `e_n` [1].
    pub normal_restitution: [f64; BLOCK],
    /// Tangential restitution `e_t` [1].
    pub tangential_restitution: [f64; BLOCK],
    /// Probability of capture [1].
    pub sticking_probability: [f64; BLOCK],
    /// Spin after a rebound [rad/s].
    pub spin: [f64; BLOCK],
    /// [`Regime`](super::Regime) as a number.
    pub regime: [u32; BLOCK],
    /// 1 captured, 0 rebounds.
    pub stuck: [u32; BLOCK],
    /// 1 outside the range for which a term or a property is stated.
    pub outside_range: [u32; BLOCK],
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

impl Default for Outcomes {
    fn default() -> Self {
        let (reals, words) = ([0.0; BLOCK], [0; BLOCK]);
        Self {
            normal_restitution: reals,
            tangential_restitution: reals,
            sticking_probability: reals,
            spin: reals,
            regime: words,
            stuck: words,
            outside_range: words,
        }
    }
}

impl Outcomes {
    /// Sets the outcome of one impact.
    pub(crate) fn set(&mut self, index: usize, outcome: &Outcome) {
        self.normal_restitution[index] = outcome.normal_restitution;
        self.tangential_restitution[index] = outcome.tangential_restitution;
        self.sticking_probability[index] = outcome.sticking_probability;
        self.spin[index] = outcome.spin;
        self.regime[index] = outcome.regime as u32;
        self.stuck[index] = u32::from(outcome.stuck);
        self.outside_range[index] = u32::from(outcome.outside_range);
    }
}
