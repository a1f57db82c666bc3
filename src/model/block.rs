//! Impacts in blocks, as columns: [`Model::resolve_block`].

pub use fearless_simd::Level;

use super::Model;
use crate::impact::{INPUTS, Impact, ImpactError};
use crate::rng::ImpactRng;

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

/// The outcomes of a [`Block`], as columns: the fields of [`Outcome`](crate::Outcome).
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
    /// [`Regime`](crate::Regime) as a number.
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

impl Default for Outcomes {
    fn default() -> Self {
        Self {
            normal_restitution: [0.0; BLOCK],
            tangential_restitution: [0.0; BLOCK],
            sticking_probability: [0.0; BLOCK],
            spin: [0.0; BLOCK],
            regime: [0; BLOCK],
            stuck: [0; BLOCK],
            outside_range: [0; BLOCK],
        }
    }
}

impl Block {
    /// One of the impacts.
    fn impact(&self, index: usize) -> Impact {
        let mut impact = Impact::default();
        for (input, column) in INPUTS.iter().zip(&self.inputs) {
            (input.set)(&mut impact, column[index]);
        }
        for (value, column) in impact.extra.iter_mut().zip(&self.extra) {
            *value = column[index];
        }
        impact
    }
}

impl Model {
    /// Decides a block of impacts on the wall with index `wall`, with the widest vectors of this machine. The bits are those of
    /// [`Model::resolve`] one by one.
    ///
    /// On a [prepared](Model::is_prepared) wall the caller must have checked the impacts ([`Impact::check`]); numbers without
    /// meaning give outcomes without meaning.
    ///
    /// # Errors
    /// As [`Model::resolve`], for a wall that is not prepared. Part of the outcomes is then that of the previous block.
    pub fn resolve_block(
        &self,
        wall: usize,
        block: &Block,
        seed: u64,
        outcomes: &mut Outcomes,
    ) -> Result<(), ImpactError> {
        self.resolve_block_at(Level::new(), wall, block, seed, outcomes)
    }

    /// As [`Model::resolve_block`] with the vectors of `level`; for benchmarks, and for tests that compare the bits.
    ///
    /// # Errors
    /// As [`Model::resolve_block`].
    pub fn resolve_block_at(
        &self,
        level: Level,
        wall: usize,
        block: &Block,
        seed: u64,
        outcomes: &mut Outcomes,
    ) -> Result<(), ImpactError> {
        if let Some(prepared) = self.prepared.get(wall).ok_or(ImpactError::NoSuchWall(wall))? {
            // Prepared walls do not support a melt layer.
            let melt = &block.inputs[Impact::MELT_THICKNESS][..block.length.min(BLOCK)];
            if melt.iter().all(|thickness| *thickness == 0.0) {
                prepared.resolve_block(block, seed, outcomes, level);
                return Ok(());
            }
        }
        for index in 0..block.length.min(BLOCK) {
            let outcome =
                self.resolve(wall, &block.impact(index), ImpactRng::new(seed, block.keys[index]))?;
            outcomes.normal_restitution[index] = outcome.normal_restitution;
            outcomes.tangential_restitution[index] = outcome.tangential_restitution;
            outcomes.sticking_probability[index] = outcome.sticking_probability;
            outcomes.spin[index] = outcome.spin;
            outcomes.regime[index] = outcome.regime as u32;
            outcomes.stuck[index] = u32::from(outcome.stuck);
            outcomes.outside_range[index] = u32::from(outcome.outside_range);
        }
        Ok(())
    }

    /// Whether the wall is prepared: only [`Impact::check`] can then refuse an impact on it.
    pub fn is_prepared(&self, wall: usize) -> bool {
        self.prepared.get(wall).is_some_and(Option::is_some)
    }
}
