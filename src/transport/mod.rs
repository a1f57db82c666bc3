//! What carries a particle to a wall besides the mean flow: turbulence, thermophoresis, Brownian motion.
//!
//! Pure functions, one law a file. `simulate` of the crate `nearwall-lab` and OpenFOAM, through [`crate::c_api`], use
//! the same ones.
//!
//! - [`near_wall`]: fluctuations and time scale of the gas beside a smooth wall.
//! - [`langevin`]: the walk that draws the fluctuating velocity along the path of a particle.
//! - [`thermophoresis`]: the force down a gradient of temperature.
//! - [`brownian`]: the random displacement of fine particles.
//!
//! Vectors are `[x, y, z]`. Random numbers are inputs, see [`crate::ImpactRng::normal`].

pub mod brownian;
pub mod langevin;
pub mod near_wall;
pub mod thermophoresis;

pub use langevin::GasTurbulence;
pub use near_wall::{Core, WallLayer};
