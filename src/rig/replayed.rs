//! OpenFOAM's recorded impacts as the forward model of a rig.

/// Why a record cannot be replayed.
#[derive(Debug, thiserror::Error)]
pub enum ReplayError {}

/// Recorded impacts.
#[derive(Debug)]
pub struct Replayed {}
