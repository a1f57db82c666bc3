//! The trajectory of one particle: its hits and how it ended.

use nalgebra::Vector3;

use super::error::SimulationError;
use super::near_wall::StayTime;
use nearwall::impact::{Impact, Outcome};

/// How a particle ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Fate {
    /// Captured by the surface with this index.
    Stuck(usize),
    /// Left through the surface with this index.
    Escaped(usize),
    /// Still in the gas at the time limit.
    Airborne,
    /// Given up: too many hits, or at rest on a wall that does not capture it.
    GivenUp,
    /// The model cannot decide a hit, or the path cannot be integrated; with the reason.
    Unusable(SimulationError),
}

/// One hit on a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Time since the particle started [s].
    pub time: f64,
    /// Index of the surface.
    pub surface: usize,
    /// Centre of the particle [m].
    pub position: Vector3<f64>,
    /// The impact.
    pub impact: Impact,
    /// Its outcome.
    pub outcome: Outcome,
    /// Density of the particle [kg/m³].
    pub density: f64,
    /// Volume of wall that the real particles remove [m³].
    pub eroded: f64,
    /// Mass of all real particles that this one represents [kg].
    pub mass: f64,
    /// Heat that they gave to the wall while they touched it and rebounded [J].
    pub heat: f64,
}

/// The hits of a particle and its end.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    /// How it ended.
    pub fate: Fate,
    /// Its hits in order.
    pub hits: Vec<Hit>,
    /// Index of its injection.
    pub injection: usize,
    /// Time of its start since the start of the feed [s]; 0 in a case without deposit.
    pub released: f64,
    /// Diameter at the end [m].
    pub diameter: f64,
    /// Number of real particles that it represents [1].
    pub weight: f64,
    /// Time near each surface, in the order of the surfaces.
    pub stays: Vec<StayTime>,
    /// Mass of all real particles that it represents, at the start and at the end [kg].
    pub mass: [f64; 2],
    /// Where it ended [m].
    pub position: Vector3<f64>,
    /// Temperature at the end [K].
    pub temperature: f64,
    /// Conversion at the end [1].
    pub conversion: f64,
}
