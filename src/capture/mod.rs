//! Capture: whether a particle stays on the wall. One criterion a file.
//!
//! Either of two mechanisms captures a particle: adhesion holds one that is too slow (see the normal law), or particle and
//! wall are sticky (melting, conversion, viscosity, a droplet that does not splash).

mod char_on_slag;
mod criterion;
mod droplet;
mod viscosity;

pub use char_on_slag::{CharFate, CharOnSlag, Judgement, char_coverage, holding_force, submerging_work};
pub use criterion::{Criterion, ParticleStickiness, Unsuitable};
pub use droplet::{Droplet, DropletCriterion, DropletNumbers, SPLASH_K, deposited_share};
pub use viscosity::{MeltStickiness, ViscosityCriterion, sticking_probability};

/// Stickiness of particle and wall, each 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stickiness {
    /// Of the particle, `P_p` [1].
    pub particle: f64,
    /// Of the wall, `P_s` [1].
    pub wall: f64,
}

impl Stickiness {
    /// Stickiness [1] from which a particle or a wall counts as sticky in a regime.
    pub const THRESHOLD: f64 = 0.5;

    /// Whether the particle counts as sticky.
    #[inline(always)]
    pub fn is_particle_sticky(self) -> bool {
        self.particle >= Self::THRESHOLD
    }

    /// Whether the wall counts as sticky.
    #[inline(always)]
    pub fn is_wall_sticky(self) -> bool {
        self.wall >= Self::THRESHOLD
    }

    /// Probability that a sticky particle or a sticky wall holds the particle [1]:
    /// `P = (P_p + sqrt(P_p² + 4 (1 - P_p) P_s)) / 2`, as in an open solver for slagging gasifiers (Uintah).
    ///
    /// One sticky surface is enough: `P = 1` for `P_p = 1` or `P_s = 1`; a wall that is not sticky leaves `P = P_p`.
    #[inline(always)]
    pub fn probability(self) -> f64 {
        let Self { particle, wall } = self;
        if wall == 0.0 {
            return particle;
        }
        0.5 * (particle + (particle * particle + 4.0 * (1.0 - particle) * wall).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn probability_has_its_limits() {
        let p = |particle, wall| Stickiness { particle, wall }.probability();
        assert_eq!(p(0.0, 0.0), 0.0);
        assert_relative_eq!(p(0.3, 0.0), 0.3);
        assert_relative_eq!(p(1.0, 0.2), 1.0);
        assert_relative_eq!(p(0.2, 1.0), 1.0);
        assert!(p(0.3, 0.3) > p(0.3, 0.2) && p(0.4, 0.2) > p(0.3, 0.2));
    }
}
