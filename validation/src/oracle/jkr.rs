//! What adhesion costs an elastic sphere: the work of the JKR force over a whole impact, by quadrature.
//!
//! Johnson, Kendall & Roberts (Proc. R. Soc. A 324 (1971) 301), with the contact radius `a` [m] as the parameter:
//! `F(a) = 4 E* a³/(3R) - sqrt(8 pi W E* a³)` [N], positive where the solids push apart, and
//! `delta(a) = a²/R - sqrt(2 pi W a/E*)` [m], positive where they overlap. `R` radius of the sphere [m], `E*` reduced
//! modulus [Pa], `W` work of adhesion [J/m²].
//!
//! The impact, as Thornton & Ning let it run: contact forms at `delta = 0`, where the force snaps
//! to that of `a_0` with `delta(a_0) = 0` (no displacement, no work); in and out along the curve,
//! past zero load, until the contact cannot be kept even with the displacement held (`d delta/da =
//! 0`, "fixed grips"), where it opens at once. The work of a piece of the curve is `∫ F d delta`.
//! With `x = sqrt(a)` both are polynomials, which Gauss–Legendre sums are good at.
//!
//! Limits: quasi-static, no waves, no plasticity, surface forces of no range.

use std::f64::consts::PI;

/// An elastic sphere that meets a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jkr {
    /// Radius `R` [m].
    pub radius: f64,
    /// Density `rho` [kg/m³].
    pub density: f64,
    /// Reduced modulus `E*` [Pa].
    pub reduced_modulus: f64,
    /// Work of adhesion `W` [J/m²].
    pub work_of_adhesion: f64,
}

/// Where the contact begins and ends: what is called lost differs between authors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cycle {
    /// Forms at zero separation without work, opens at fixed grips: Thornton & Ning.
    FixedGrips,
    /// Forms at zero separation without work, opens at the largest pull: what a dead weight would do.
    FixedLoad,
    /// The surface energy set free when the contact forms also speeds the particle up; opens at fixed grips.
    SnapInCounted,
}

impl Jkr {
    /// All units of one: for factors.
    pub const UNIT: Self = Self { radius: 1.0, density: 1.0, reduced_modulus: 1.0, work_of_adhesion: 1.0 };

    /// Contact force [N] at the contact radius `a` [m].
    pub fn force(&self, a: f64) -> f64 {
        let Self { radius, reduced_modulus, work_of_adhesion, .. } = *self;
        4.0 * reduced_modulus * a.powi(3) / (3.0 * radius)
            - (8.0 * PI * work_of_adhesion * reduced_modulus * a.powi(3)).sqrt()
    }

    /// Approach `delta` [m] at the contact radius `a` [m].
    pub fn approach(&self, a: f64) -> f64 {
        a * a / self.radius - (2.0 * PI * self.work_of_adhesion * a / self.reduced_modulus).sqrt()
    }

    /// `d delta/da` [1].
    fn slope(&self, a: f64) -> f64 {
        let rooted = 2.0 * PI * self.work_of_adhesion / (self.reduced_modulus * a);
        2.0 * a / self.radius - 0.5 * rooted.sqrt()
    }

    /// Mass [kg].
    pub fn mass(&self) -> f64 {
        4.0 / 3.0 * PI * self.radius.powi(3) * self.density
    }

    /// Contact radius `a_0` [m] right after the contact forms: `delta(a_0) = 0`.
    pub fn formed(&self) -> f64 {
        self.root(|a| self.approach(a))
    }

    /// Contact radius [m] at which the contact opens with the displacement held: `d delta/da = 0`.
    pub fn opens_at_fixed_grips(&self) -> f64 {
        self.root(|a| self.slope(a))
    }

    /// Contact radius [m] at which it opens under a dead weight: `dF/da = 0`, the largest pull.
    pub fn opens_at_fixed_load(&self) -> f64 {
        let Self { radius, reduced_modulus, work_of_adhesion, .. } = *self;
        let rooted = 8.0 * PI * work_of_adhesion * reduced_modulus;
        self.root(|a| 4.0 * reduced_modulus * a * a / radius - 1.5 * (rooted * a).sqrt())
    }

    /// The root of a function that is negative for small `a` and positive for large: bisection over the size that
    /// dimensional analysis gives, `(W R²/E*)^(1/3)`.
    fn root(&self, of: impl Fn(f64) -> f64) -> f64 {
        let size = (self.work_of_adhesion * self.radius.powi(2) / self.reduced_modulus).cbrt();
        bisect(1e-6 * size, 1e3 * size, of)
    }

    /// Work [J] that the contact takes from the particle between two contact radii [m]: `∫ F d delta`.
    pub fn work(&self, from: f64, to: f64) -> f64 {
        let integrand = |x: f64| self.force(x * x) * self.slope(x * x) * 2.0 * x;
        gauss(from.sqrt(), to.sqrt(), integrand)
    }

    /// Energy [J] that a whole impact loses.
    pub fn lost(&self, cycle: Cycle) -> f64 {
        let formed = self.formed();
        match cycle {
            Cycle::FixedGrips => self.work(formed, self.opens_at_fixed_grips()),
            Cycle::FixedLoad => self.work(formed, self.opens_at_fixed_load()),
            // Elastic energy less surface energy at a_0 is the work along the curve from nothing.
            Cycle::SnapInCounted => self.work(0.0, formed) + self.work(formed, self.opens_at_fixed_grips()),
        }
    }

    /// Fastest impact that adhesion holds [m/s]: its energy is what the impact loses.
    pub fn adhesive_velocity(&self, cycle: Cycle) -> f64 {
        (2.0 * self.lost(cycle) / self.mass()).sqrt()
    }

    /// Normal restitution [1] at `speed` [m/s]: in until the particle stands, out until the contact opens.
    pub fn restitution(&self, speed: f64) -> f64 {
        let energy = 0.5 * self.mass() * speed * speed;
        let formed = self.formed();
        let deepest = self.deepest(energy, formed);
        let back = -self.work(deepest, self.opens_at_fixed_grips());
        (back / energy).max(0.0).sqrt()
    }

    /// Contact radius [m] at which the energy of arrival is used up.
    fn deepest(&self, energy: f64, formed: f64) -> f64 {
        let mut far = 2.0 * formed;
        while self.work(formed, far) < energy {
            far *= 2.0;
        }
        // The force pulls first: the root of interest lies where the work rises, beyond the radius of zero force.
        let unloaded = self.root(|a| self.force(a));
        bisect(unloaded.max(formed), far, |a| self.work(formed, a) - energy)
    }
}

/// The root between `low`, where the function is negative, and `high`, to the last digit.
fn bisect(mut low: f64, mut high: f64, of: impl Fn(f64) -> f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if of(middle) < 0.0 { low = middle } else { high = middle }
    }
}

/// `∫ f dx` by five points of Gauss and Legendre on each of 16 pieces.
fn gauss(from: f64, to: f64, of: impl Fn(f64) -> f64) -> f64 {
    let near = (5.0 - 2.0 * (10f64 / 7.0).sqrt()).sqrt() / 3.0;
    let far = (5.0 + 2.0 * (10f64 / 7.0).sqrt()).sqrt() / 3.0;
    let near_weight = (322.0 + 13.0 * 70f64.sqrt()) / 900.0;
    let far_weight = (322.0 - 13.0 * 70f64.sqrt()) / 900.0;
    let points = [
        (0.0, 128.0 / 225.0),
        (near, near_weight),
        (-near, near_weight),
        (far, far_weight),
        (-far, far_weight),
    ];
    let pieces = 16;
    let half = 0.5 * (to - from) / f64::from(pieces);
    let piece = |index: i32| {
        let middle = from + half * f64::from(2 * index + 1);
        points.iter().map(|(place, weight)| weight * of(middle + half * place)).sum::<f64>()
    };
    half * (0..pieces).map(piece).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(ours: f64, expected: f64, relative: f64) {
        assert!((ours / expected - 1.0).abs() < relative, "{ours} against {expected}");
    }

    /// JKR's own landmarks: pull-off 3 pi W R/2 at fixed load, 5/9 of it at fixed grips, 8/9 of it
    /// when the contact forms.
    #[test]
    fn landmarks_of_the_curve() {
        let sphere = Jkr { radius: 2.0, density: 3.0, reduced_modulus: 5.0, work_of_adhesion: 0.7 };
        let pull_off = 1.5 * PI * 0.7 * 2.0;
        near(-sphere.force(sphere.opens_at_fixed_load()), pull_off, 1e-12);
        near(-sphere.force(sphere.opens_at_fixed_grips()), 5.0 / 9.0 * pull_off, 1e-12);
        near(-sphere.force(sphere.formed()), 8.0 / 9.0 * pull_off, 1e-12);
        near(sphere.approach(sphere.formed()) + 1.0, 1.0, 1e-12);
    }

    /// Without adhesion the curve is Hertz's: `F = 4/3 E* sqrt(R) delta^(3/2)`, work `8/15 E* sqrt(R) delta^(5/2)`.
    #[test]
    fn without_adhesion_it_is_hertz() {
        let sphere = Jkr { work_of_adhesion: 0.0, ..Jkr::UNIT };
        let depth = sphere.approach(0.3);
        near(sphere.force(0.3), 4.0 / 3.0 * depth.powf(1.5), 1e-13);
        near(sphere.work(1e-12, 0.3), 8.0 / 15.0 * depth.powf(2.5), 1e-12);
    }

    /// Along the curve the energy from nothing is elastic less surface energy. With the displacement held it falls by
    /// `pi a²` per work of adhesion, which is what "work of adhesion" means.
    #[test]
    fn surface_energy_is_work_of_adhesion_times_area() {
        let (a, step) = (1.7, 1e-5);
        let energy_at = |work_of_adhesion: f64| {
            let sphere = Jkr { work_of_adhesion, ..Jkr::UNIT };
            let depth = Jkr::UNIT.approach(a);
            let here = bisect(1.0, 3.0, |a| sphere.approach(a) - depth);
            sphere.work(0.0, here)
        };
        let slope = (energy_at(1.0 + step) - energy_at(1.0 - step)) / (2.0 * step);
        near(slope, -PI * a * a, 1e-6);
    }
}
