//! Impacts in blocks, as columns: [`Model::resolve_block`].

pub use fearless_simd::Level;

pub use super::prepared_block::Workspace;
use super::{Model, TemperatureRanges};
use crate::impact::ImpactError;
pub use crate::impact::{BLOCK, Block, Outcomes};
use crate::rng::ImpactRng;

impl Model {
    /// Decides a block of impacts on the wall with index `wall`, with the widest vectors of this
    /// machine. The bits are those of [`Model::resolve`] one by one.
    ///
    /// On a [prepared](Model::is_prepared) wall the caller must have checked the impacts
    /// ([`Impact::check`]); numbers without meaning give outcomes without meaning.
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
            outcomes.set(index, &outcome);
        }
        Ok(())
    }

    /// Whether the wall is prepared: within its [temperatures](Model::temperature_ranges) only
    /// [`Impact::check`] can then refuse an impact on it.
    pub fn is_prepared(&self, wall: usize) -> bool {
        matches!(self.prepared.get(wall), Some(Some(_)))
    }

    /// The temperatures [K] within which only [`Impact::check`] can refuse an impact on a wall;
    /// `None` for a wall of which a single impact has to be asked ([`Model::check`]).
    pub(crate) fn decided_temperatures(&self, wall: usize) -> Option<TemperatureRanges> {
        *self.decided.get(wall)?
    }
}
