//! Impacts in blocks, as columns: [`Model::resolve_block`].

pub use fearless_simd::Level;

use super::prepared_block::{ContactColumns, StepColumns};
use super::{Model, TemperatureRanges};
use crate::impact::ImpactError;
pub use crate::impact::{BLOCK, Block};
use crate::rng::ImpactRng;

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

/// Room for the steps between the loops over a block. One serves any number of blocks.
#[derive(Debug, Clone, Default)]
pub struct Workspace {
    pub(super) steps: StepColumns,
    /// `None` until a wall needs it.
    pub(super) contacts: Option<ContactColumns>,
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
        workspace: &mut Workspace,
    ) -> Result<(), ImpactError> {
        self.resolve_block_at(Level::new(), wall, block, seed, outcomes, workspace)
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
        workspace: &mut Workspace,
    ) -> Result<(), ImpactError> {
        let prepared = self.prepared.get(wall).ok_or(ImpactError::NoSuchWall(wall))?;
        if let Some(prepared) = prepared
            && prepared.decides_block(block)
        {
            prepared.resolve_block(block, seed, outcomes, workspace, level);
            return Ok(());
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

    /// Whether the wall is prepared: within its [temperatures](Model::temperature_ranges) only [`Impact::check`] can then refuse an
    /// impact on it.
    pub fn is_prepared(&self, wall: usize) -> bool {
        matches!(self.prepared.get(wall), Some(Some(_)))
    }

    /// The temperatures [K] within which only [`Impact::check`] can refuse an impact on a wall; `None` for a wall of which a single
    /// impact has to be asked ([`Model::check`]).
    pub(crate) fn decided_temperatures(&self, wall: usize) -> Option<TemperatureRanges> {
        *self.decided.get(wall)?
    }
}
