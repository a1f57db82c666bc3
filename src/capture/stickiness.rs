//! The stickiness of particle and bare wall, and the probability that one of them holds the particle.
//!
//! `walsh` (default), a union: `P = P_p + (1 - P_p) P_s - k_e (1 - P_p)(1 - P_s)`, not below 0.
//! `P_p` stickiness of the particle [1], `P_s` of the bare wall [1], `k_e` erosion of the deposit
//! by dry particles [1], 0 unless given. Source: P. M. Walsh, A. N. Sayre, D. O. Loehden, L. S.
//! Monroe, J. M. Beér, A. F. Sarofim, Prog. Energy Combust. Sci. 16 (1990) 327–345 (not re-read).
//!
//! `uintah`: `P = (P_p + sqrt(P_p² + 4 (1 - P_p) P_s)) / 2`, the form in an open solver for
//! slagging gasifiers. It lifts a stiff slag: `P_s` = 0.22 gives 0.47 for a dry particle.
//!
//! Both give 1 for `P_p = 1` or `P_s = 1`, and `P_p` for a wall that is not sticky (`k_e = 0`).
//! Neither knows the speed.

use crate::input::{InputError, Section};

/// Stickiness of particle and wall, each 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stickiness {
    /// Of the particle, `P_p` [1].
    pub particle: f64,
    /// Of the wall that it meets, `P_s` [1].
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
}

/// How the stickiness of particle and wall combine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Combination {
    /// Walsh's union.
    Walsh {
        /// Erosion `k_e` [1].
        erosion: f64,
    },
    /// The root of an open solver.
    Uintah,
}

impl Default for Combination {
    fn default() -> Self {
        Self::Walsh { erosion: 0.0 }
    }
}

impl Combination {
    /// Reads `combination` and `erosion` of a `[capture]` table.
    ///
    /// # Errors
    /// [`InputError::Fault`] for an unknown combination or an erosion outside 0 to 1.
    pub(super) fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let word = section.choice("combination", &["walsh", "uintah"])?;
        let erosion = section.number_within("erosion", 0.0, 1.0)?;
        match (word.as_deref(), erosion) {
            (Some("uintah"), None) => Ok(Self::Uintah),
            (Some("uintah"), Some(_)) => {
                Err(section.fault("erosion", "belongs to `combination = \"walsh\"`"))
            }
            (_, erosion) => Ok(Self::Walsh { erosion: erosion.unwrap_or(0.0) }),
        }
    }

    /// The combination in words.
    pub(super) fn describe(self) -> String {
        match self {
            Self::Walsh { erosion: 0.0 } => "walsh".to_owned(),
            Self::Walsh { erosion } => format!("walsh, erosion {erosion}"),
            Self::Uintah => "uintah".to_owned(),
        }
    }

    /// Probability that a sticky particle or a sticky wall holds the particle [1].
    #[inline(always)]
    pub fn probability(self, stickiness: Stickiness) -> f64 {
        let Stickiness { particle, wall } = stickiness;
        match self {
            Self::Walsh { erosion } => {
                let neither = (1.0 - particle) * (1.0 - wall);
                // Written so that a wall that is not sticky leaves the particle's stickiness bit for bit.
                (particle + (1.0 - particle) * wall - erosion * neither).max(0.0)
            }
            Self::Uintah if wall == 0.0 => particle,
            Self::Uintah => 0.5 * (particle + (particle * particle + 4.0 * (1.0 - particle) * wall).sqrt()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn probability_has_its_limits() {
        for combination in [Combination::default(), Combination::Uintah] {
            let p = |particle, wall| combination.probability(Stickiness { particle, wall });
            assert_eq!(p(0.0, 0.0), 0.0);
            assert_eq!(p(0.3, 0.0), 0.3);
            assert_relative_eq!(p(1.0, 0.2), 1.0);
            assert_relative_eq!(p(0.2, 1.0), 1.0);
            assert!(p(0.3, 0.3) > p(0.3, 0.2) && p(0.4, 0.2) > p(0.3, 0.2));
        }
    }

    /// Two independent chances of 0.3 and 0.4: 1 - 0.7 * 0.6. With erosion 0.5 the rest of 0.42 takes 0.21 off.
    #[test]
    fn walsh_by_hand() {
        let both = Stickiness { particle: 0.3, wall: 0.4 };
        assert_relative_eq!(Combination::default().probability(both), 0.58, max_relative = 1e-15);
        let eroding = Combination::Walsh { erosion: 0.5 };
        assert_relative_eq!(eroding.probability(both), 0.37, max_relative = 1e-15);
        assert_eq!(eroding.probability(Stickiness { particle: 0.1, wall: 0.1 }), 0.0);
        // The root lifts a stiff slag.
        let stiff = Stickiness { particle: 0.0, wall: 0.22 };
        assert_relative_eq!(Combination::Uintah.probability(stiff), 0.469, max_relative = 1e-3);
    }
}
