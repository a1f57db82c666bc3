//! Thornton & Ning (Powder Technology 99 (1998) 154): elastic–perfectly plastic spheres with adhesion.
//!
//! With `w = v_y / v`:
//! - `v_adh = C1 (W⁵ / (rho³ E*² R⁵))^(1/6)`, the fastest elastic impact that adhesion holds (JKR);
//! - `v_y = C2 sqrt(p_y⁵ / (rho E*⁴))`, the slowest impact that yields;
//! - `P(w) = (6 sqrt3 / 5)(1 - w²/6) sqrt(w / (w + 2 sqrt((6 - w²)/5)))`, what plasticity leaves;
//! - `e_n² = P(v_y/v) - (v_adh/v)²` above `v_y`, `1 - (v_adh/v)²` below, and `e_n = 0` up to `v_s`.
//!
//! The sticking velocity is `v_s = v_adh` where `v_adh <= v_y`, otherwise `v_y / w0` with
//! `P(w0) = (v_adh/v_y)² w0²`. `e_n` is continuous at `v_y`, since `P(1) = 1`.
//!
//! Symbols: `W` work of adhesion [J/m²], `rho` particle density [kg/m³], `E*` reduced modulus [Pa], `R = d/2` [m],
//! `p_y` limiting contact pressure [Pa], `v` normal impact speed [m/s]. Valid for one sphere on a smooth, thick,
//! dry plane, for contacts small against `R` and impacts slow against the speed of sound. The closed form adds the
//! losses of adhesion and of plasticity. It neglects that yielding flattens the contact and so raises the pull-off;
//! `plastic_jkr.rs` includes this.
//!
//! Misprints: Troiano et al., Eq. 1, has 4/3 in place of 16/9 (their `K` is `4E*/3`), which makes
//! `v_s` 0.953 of the above; Eq. 6 lacks a minus sign under its inner root. Tests below state both.

use super::{Contact, Speeds};
use crate::vector_math::inverse_cube_root;

/// `C1 = (sqrt3/2) π^(1/3) sqrt((1 + 6·2^(2/3))/5)`.
pub(super) const ADHESIVE_FACTOR: f64 = 1.840_183_180_799_056_5;
/// `C2 = π²/(2 sqrt10)`.
pub(super) const YIELD_FACTOR: f64 = 1.560_521_475_613_219_8;

/// The constants of the law for a contact.
///
/// `rho v_adh² = C1² E* u^(-5/3)` with `u = d E*/2W` [1]: the formula above in other symbols.
/// Density enters only with the kinetic energy, so the law works with `sqrt(rho) v` [Pa^½] in place
/// of every speed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ThorntonNingConstants {
    /// `E*/2W` [1/m], infinite without adhesion.
    inverse_length: f64,
    /// `C1² E*` [Pa].
    adhesion_scale: f64,
    /// `sqrt(rho) v_y` [Pa^½].
    yielding: f64,
}

impl ThorntonNingConstants {
    /// The constants for a contact; its density is not used.
    #[inline(always)]
    pub fn new(contact: &Contact) -> Self {
        let Contact { reduced_modulus, work_of_adhesion, .. } = *contact;
        let adhesion_scale = ADHESIVE_FACTOR * ADHESIVE_FACTOR * reduced_modulus;
        Self {
            inverse_length: reduced_modulus / (2.0 * work_of_adhesion),
            // Prevents 0 times infinity for impossible solids.
            adhesion_scale: adhesion_scale.clamp(f64::MIN_POSITIVE, f64::MAX),
            yielding: yielding(contact),
        }
    }

    /// `rho v_adh²` [Pa] of a particle of `diameter` [m].
    #[inline(always)]
    pub fn adhesive_pressure(&self, diameter: f64) -> f64 {
        let root = inverse_cube_root(diameter * self.inverse_length);
        let square = root * root;
        self.adhesion_scale * (square * square * root)
    }

    /// Share of the kinetic energy `e_n²` [1] that a particle of `density` [kg/m³] keeps at
    /// `normal_speed` [m/s], from its [`Self::adhesive_pressure`] [Pa]; 0 when adhesion holds it.
    #[inline(always)]
    pub fn energy(&self, density: f64, normal_speed: f64, adhesive_pressure: f64) -> f64 {
        energy(density.sqrt() * normal_speed, adhesive_pressure, self.yielding)
    }
}

/// The three speeds of a particle of `diameter` [m].
pub fn speeds(contact: &Contact, diameter: f64) -> Speeds {
    let adhesive = adhesive_velocity(contact, diameter);
    let yielding = yield_velocity(contact);
    Speeds { adhesive, yielding, sticking: sticking_velocity(adhesive, yielding) }
}

/// Adhesive velocity `v_adh` [m/s] of a particle of `diameter` [m].
pub fn adhesive_velocity(contact: &Contact, diameter: f64) -> f64 {
    (ThorntonNingConstants::new(contact).adhesive_pressure(diameter) / contact.density).sqrt()
}

/// Yield velocity `v_y` [m/s].
#[inline]
pub fn yield_velocity(contact: &Contact) -> f64 {
    yielding(contact) / contact.density.sqrt()
}

/// `sqrt(rho) v_y` [Pa^½].
#[inline(always)]
fn yielding(contact: &Contact) -> f64 {
    let limiting_pressure = contact.limiting_pressure();
    let strain = limiting_pressure / contact.reduced_modulus;
    YIELD_FACTOR * strain * strain * limiting_pressure.sqrt()
}

/// Plastic term `P(w)` [1] for `w = v_y / v` in 0 to 1.
#[inline(always)]
pub fn plastic_term(w: f64) -> f64 {
    /// `6 sqrt3 / 5`.
    const FACTOR: f64 = 2.078_460_969_082_653;
    let square = w * w;
    FACTOR * (1.0 - square * (1.0 / 6.0)) * (w / (w + 2.0 * (1.2 - 0.2 * square).sqrt())).sqrt()
}

/// Normal restitution `e_n` [1] at the normal speed `v`, with `v_adh` and `v_y` in the same unit.
pub fn restitution(speed: f64, adhesive: f64, yielding: f64) -> f64 {
    energy(speed, adhesive * adhesive, yielding).sqrt()
}

/// `e_n²` [1], from `v_adh²`; otherwise as [`restitution`]. Without branches, for vectors: both
/// sides of a choice are computed.
#[inline(always)]
fn energy(speed: f64, adhesive_squared: f64, yielding: f64) -> f64 {
    let inverse_speed = 1.0 / speed;
    let adhesion = (adhesive_squared * inverse_speed) * inverse_speed;
    let w = yielding * inverse_speed;
    let plastic = plastic_term(w);
    let elastic = if w < 1.0 { plastic } else { 1.0 };
    // Negative exactly where speed < v_s: the sticking velocity is the root of this expression.
    let square = elastic - adhesion;
    if (adhesion < 1.0) & (square > 0.0) { square } else { 0.0 }
}

/// Sticking velocity `v_s` [m/s], from `v_adh` and `v_y` [m/s].
pub fn sticking_velocity(adhesive: f64, yielding: f64) -> f64 {
    if adhesive <= yielding {
        return adhesive;
    }
    yielding / plastic_root(2.0 * (adhesive / yielding).ln())
}

/// The root `w0` in (0, 1) of `ln P(w) - 2 ln w = log_ratio`, for `log_ratio >= 0`.
///
/// In `x = ln w` the left side falls with a slope between -2 and -3/2 and is nearly straight, so Newton's step
/// converges from the asymptote for small `w` in a few rounds.
fn plastic_root(log_ratio: f64) -> f64 {
    let excess = |x: f64| plastic_term(x.exp()).ln() - 2.0 * x - log_ratio;
    let small_w = (1.2 * 3f64.sqrt() / (2.0 * 1.2f64.sqrt()).sqrt()).ln();
    let mut x = ((small_w - log_ratio) / 1.5).min(0.0);
    for _ in 0..60 {
        let step = excess(x) / log_slope(x.exp());
        x = (x - step).min(0.0);
        if step.abs() <= 4.0 * f64::EPSILON * x.abs().max(1.0) {
            break;
        }
    }
    x.exp()
}

/// `d(ln P - 2 ln w) / d(ln w)` at `w`.
fn log_slope(w: f64) -> f64 {
    let root = ((6.0 - w * w) / 5.0).sqrt();
    let bulk = -2.0 * w * w / (6.0 - w * w);
    let denominator_slope = w - 0.4 * w * w / root;
    bulk + 0.5 * (1.0 - denominator_slope / (w + 2.0 * root)) - 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Mechanical;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    /// A solid of these properties, in the order of [`Mechanical`].
    fn solid(
        [density, youngs_modulus, poisson_ratio, yield_strength, surface_energy]: [f64; 5],
    ) -> Mechanical {
        Mechanical {
            density,
            youngs_modulus,
            poisson_ratio,
            yield_strength,
            surface_energy,
            work_of_adhesion: None,
        }
    }

    /// Found by fuzzing: half of this diameter is 0.
    #[test]
    fn without_adhesion_nothing_adheres_at_any_diameter() {
        let solid = solid([1000.0, 1e9, 0.3, 1e7, 0.03]);
        let contact = Contact::new(&solid, &solid, 1.0, Some(0.0));
        for diameter in [5e-324, 1e-300, 1e-4, f64::MAX] {
            assert_eq!(adhesive_velocity(&contact, diameter), 0.0);
        }
        let beyond = Contact { reduced_modulus: 1e300, work_of_adhesion: 1e308, ..contact };
        assert_eq!(adhesive_velocity(&beyond, 1e-4), f64::INFINITY);
        // E*/rho below and above all numbers.
        let soft = Contact { reduced_modulus: 1e-298, density: 1.7e308, work_of_adhesion: 0.1, ..contact };
        assert_eq!(adhesive_velocity(&soft, 1e-4), f64::INFINITY);
        let stiff = Contact { reduced_modulus: 1e308, density: 1e-300, work_of_adhesion: 1e-300, ..contact };
        assert_eq!(adhesive_velocity(&stiff, 1e-4), 0.0);
    }

    #[test]
    fn factors_are_the_closed_forms() {
        let adhesive = 3f64.sqrt() / 2.0 * PI.cbrt() * ((1.0 + 6.0 * 4f64.cbrt()) / 5.0).sqrt();
        assert_relative_eq!(ADHESIVE_FACTOR, adhesive, max_relative = 1e-15);
        assert_relative_eq!(YIELD_FACTOR, PI * PI / (2.0 * 10f64.sqrt()), max_relative = 1e-15);
    }

    #[test]
    fn restitution_is_continuous_at_yield_and_vanishes_at_the_sticking_velocity() {
        assert_relative_eq!(plastic_term(1.0), 1.0, max_relative = 1e-15);
        let (adhesive, yielding) = (0.116, 6.8e-3);
        let sticking = sticking_velocity(adhesive, yielding);
        assert_eq!(restitution(sticking * (1.0 - 1e-9), adhesive, yielding), 0.0);
        assert!(restitution(sticking * (1.0 + 1e-9), adhesive, yielding) > 0.0);
        let below = restitution(0.5 - 1e-12, 0.1, 0.5);
        assert_relative_eq!(below, restitution(0.5 + 1e-12, 0.1, 0.5), max_relative = 1e-9);
    }

    #[test]
    fn the_sticking_root_solves_its_equation_over_sixteen_decades() {
        for decade in 0..16 {
            let ratio = 10f64.powi(decade) * 1.000_001;
            let w = plastic_root(2.0 * ratio.ln());
            assert_relative_eq!(plastic_term(w), (ratio * w).powi(2), max_relative = 1e-13);
        }
    }

    /// Troiano Eq. 1 with its printed 4/3, or the right 16/9, as `factor`; `K = 4E*/3`.
    fn troiano_equation_1(factor: f64, contact: &Contact, diameter: f64) -> f64 {
        let k = 4.0 / 3.0 * contact.reduced_modulus;
        let group = 2.0 * contact.work_of_adhesion / diameter;
        1.84 * (factor * group.powi(5) / (contact.density.powi(3) * k * k)).powf(1.0 / 6.0)
    }

    fn wax_on(gamma: f64, youngs_modulus: f64, poisson_ratio: f64) -> Contact {
        let wax = solid([1000.0, 700e6, 0.49, 9.5e6, 0.03]);
        let target = solid([2000.0, youngs_modulus, poisson_ratio, 1e9, gamma]);
        Contact::new(&wax, &target, 0.7, None)
    }

    /// Targets of Troiano Table 4: gamma [J/m²], E [Pa], nu; printed v_s; v_s of Eq. 1 as printed; v_y of Eq. 3 [m/s].
    ///
    /// Teflon's printed v_s agrees with Eq. 1, wax is 10 % off, steel and Pyrex slipped by a factor of ten. The printed
    /// v_y = 6.8e-3 holds for the two hard targets only.
    #[test]
    fn troiano_table_4_with_its_misprints() {
        let teflon = (wax_on(0.02, 0.5e9, 0.46), 3.02e-2, 0.0304, 0.040);
        let wax = (wax_on(0.03, 0.7e9, 0.49), 3.03e-2, 0.0336, 0.027);
        let steel = (wax_on(0.80, 190e9, 0.30), 1.04e-2, 0.105, 6.7e-3);
        let pyrex = (wax_on(1.00, 64e9, 0.20), 1.15e-2, 0.116, 6.8e-3);
        for (contact, _, stick, yielding) in [&teflon, &wax, &steel, &pyrex] {
            let by_equation_1 = troiano_equation_1(4.0 / 3.0, contact, 75e-6);
            assert_relative_eq!(by_equation_1, stick, max_relative = 0.01);
            assert_relative_eq!(yield_velocity(contact), yielding, max_relative = 0.02);
        }
        assert_relative_eq!(teflon.1, teflon.2, max_relative = 0.01);
        assert_relative_eq!(wax.2 / wax.1, 1.11, max_relative = 0.01);
        assert_relative_eq!(steel.2 / steel.1, 10.1, max_relative = 0.01);
        assert_relative_eq!(pyrex.2 / pyrex.1, 10.1, max_relative = 0.01);
    }

    /// Troiano Eq. 1 as printed gives 0.953 of Thornton & Ning; with 16/9 in place of 4/3 it is the same.
    #[test]
    fn troiano_equation_1_needs_sixteen_ninths() {
        let contact = wax_on(1.0, 64e9, 0.2);
        let ours = adhesive_velocity(&contact, 75e-6);
        let printed = troiano_equation_1(4.0 / 3.0, &contact, 75e-6);
        assert_relative_eq!(printed / ours, 0.953, max_relative = 1e-3);
        let right = troiano_equation_1(16.0 / 9.0, &contact, 75e-6);
        assert_relative_eq!(right / ours, 1.0, max_relative = 2e-4);
    }

    /// Troiano Eq. 6 with a plus where the minus was lost would not join the elastic branch at v_y.
    #[test]
    fn troiano_equation_6_needs_its_minus_sign() {
        let with_sign = |sign: f64, w: f64| {
            let inner = (1.2 + sign * w * w / 5.0).sqrt();
            1.2 * 3f64.sqrt() * (1.0 - w * w / 6.0) * (w / (w + 2.0 * inner)).sqrt()
        };
        assert_relative_eq!(with_sign(-1.0, 1.0), 1.0, max_relative = 1e-14);
        assert!((with_sign(1.0, 1.0) - 1.0).abs() > 0.04);
        assert_relative_eq!(with_sign(-1.0, 0.3), plastic_term(0.3), max_relative = 1e-14);
    }

    /// Figs 8 and 10: mean e_n of 0.28 for wax on Pyrex and on smooth wax at v_n 0.5 to 3 m/s, with c = 0.7.
    #[test]
    fn troiano_figures_8_and_10() {
        let contact = wax_on(1.0, 64e9, 0.2);
        let speeds: Vec<f64> = (0..26).map(|i| 0.5 + 0.1 * f64::from(i)).collect();
        let adhesive = adhesive_velocity(&contact, 75e-6);
        let mean = speeds.iter().map(|v| restitution(*v, adhesive, yield_velocity(&contact))).sum::<f64>()
            / speeds.len() as f64;
        assert!((mean - 0.28).abs() < 0.03, "mean e_n {mean}");
    }
}
