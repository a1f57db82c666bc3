//! The contact of a particle and a wall, each at its own temperature.

use crate::deposit::WallMelt;
use crate::material::Mechanical;

/// Contact radius over particle radius [1] up to which the contact of a sphere with a half-space is
/// a fair description: Hertz's theory is for small contacts, and 0.3 is a usual bound (assumed).
pub const LARGEST_CONTACT_RADIUS: f64 = 0.3;

/// Properties of the two solids that the impact laws use.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Contact {
    /// Particle density `rho` [kg/m³].
    pub density: f64,
    /// Reduced Young's modulus `E*` [Pa].
    pub reduced_modulus: f64,
    /// Work of adhesion `W` [J/m²].
    pub work_of_adhesion: f64,
    /// Yield strength `sigma_y` of the weaker solid [Pa].
    pub yield_strength: f64,
    /// `c = p_y / sigma_y` [1].
    pub yield_ratio: f64,
    /// Tangential over normal stiffness, Mindlin's `k` [1].
    pub stiffness_ratio: f64,
    /// The melt that the particle meets on the wall; `None` on a dry, frozen or covered wall.
    pub melt: Option<WallMelt>,
}

impl Contact {
    /// The contact of two solids.
    ///
    /// `yield_ratio` is `c = p_y / sigma_y` [1]; the weaker solid yields first. `work_of_adhesion` [J/m²] as in
    /// [`work_of_adhesion`].
    #[inline(always)]
    pub fn new(
        particle: &Mechanical,
        wall: &Mechanical,
        yield_ratio: f64,
        work_of_adhesion: Option<f64>,
    ) -> Self {
        Self {
            density: particle.density,
            reduced_modulus: reduced_modulus(particle, wall),
            work_of_adhesion: self::work_of_adhesion(particle, wall, work_of_adhesion),
            yield_strength: particle.yield_strength.min(wall.yield_strength),
            yield_ratio,
            stiffness_ratio: stiffness_ratio(particle, wall),
            melt: None,
        }
    }

    /// Largest `rho v_n²` [Pa] at which a sphere that flows plastically stays below
    /// [`LARGEST_CONTACT_RADIUS`]: `a/R = (8 rho v_n²/(3 p_y))^(1/4)`, from the kinetic energy that
    /// the pressure `p_y` takes up on the area `pi a² = 2 pi R h` (indentation `h`).
    #[inline(always)]
    pub fn largest_impact_pressure(&self) -> f64 {
        0.375 * LARGEST_CONTACT_RADIUS.powi(4) * self.limiting_pressure()
    }

    /// Limiting contact pressure `p_y = c sigma_y` [Pa].
    #[inline(always)]
    pub fn limiting_pressure(&self) -> f64 {
        self.yield_ratio * self.yield_strength
    }
}

/// Work of adhesion `W` [J/m²] of two solids: the one `given`, else the particle's own, else `2 sqrt(gamma_1 gamma_2)`.
#[inline(always)]
pub fn work_of_adhesion(particle: &Mechanical, wall: &Mechanical, given: Option<f64>) -> f64 {
    let geometric = || 2.0 * (particle.surface_energy * wall.surface_energy).sqrt();
    given.or(particle.work_of_adhesion).unwrap_or_else(geometric)
}

/// Reduced modulus `E*` [Pa]: `1/E* = (1-nu1²)/E1 + (1-nu2²)/E2` (Hertz), here with one division.
#[inline(always)]
pub fn reduced_modulus(particle: &Mechanical, wall: &Mechanical) -> f64 {
    let normal = |m: &Mechanical| 1.0 - m.poisson_ratio * m.poisson_ratio;
    let (a, b) = (normal(particle), normal(wall));
    particle.youngs_modulus * wall.youngs_modulus / (a * wall.youngs_modulus + b * particle.youngs_modulus)
}

/// Mindlin's ratio of tangential to normal stiffness [1]:
/// `k = [(1-nu1)/G1 + (1-nu2)/G2] / [(1-nu1/2)/G1 + (1-nu2/2)/G2]`, `G = E / 2(1+nu)`, here multiplied by `E1 E2 / 2`.
///
/// Troiano et al. print Eq. 12 with equal numerator and denominator; the halves in the denominator are
/// Mindlin's. Wax on Pyrex gives 0.675 to 0.678.
#[inline(always)]
pub fn stiffness_ratio(particle: &Mechanical, wall: &Mechanical) -> f64 {
    let normal = |m: &Mechanical| 1.0 - m.poisson_ratio * m.poisson_ratio;
    let tangential = |m: &Mechanical| (1.0 - 0.5 * m.poisson_ratio) * (1.0 + m.poisson_ratio);
    let sum = |a: f64, b: f64| a * wall.youngs_modulus + b * particle.youngs_modulus;
    sum(normal(particle), normal(wall)) / sum(tangential(particle), tangential(wall))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Library;

    /// The model file's number goes before the material's, and that before the geometric mean. That
    /// of a wall has no say.
    #[test]
    fn the_work_of_adhesion_is_the_nearest_one_given() {
        let plain = Mechanical {
            density: 2300.0,
            youngs_modulus: 7e10,
            poisson_ratio: 0.2,
            yield_strength: 3e8,
            surface_energy: 0.04,
            work_of_adhesion: None,
        };
        let fitted = Mechanical { work_of_adhesion: Some(5.0), ..plain };
        let work = |particle, given| Contact::new(particle, &fitted, 1.0, given).work_of_adhesion;
        assert_eq!(work(&plain, None), 0.08);
        assert_eq!(work(&fitted, None), 5.0);
        assert_eq!(work(&fitted, Some(0.0)), 0.0);
    }

    /// Troiano Eq. 12 with Mindlin's denominator, wax on Pyrex; as printed it would be 1.
    #[test]
    fn mindlin_ratio_of_wax_on_pyrex() {
        let library = Library::built_in().unwrap();
        let solid = |name: &str| library.get(name).unwrap().mechanical(293.15).unwrap();
        let k = stiffness_ratio(&solid("montan-wax"), &solid("pyrex"));
        assert!((0.675..=0.678).contains(&k), "{k}");
    }
}
