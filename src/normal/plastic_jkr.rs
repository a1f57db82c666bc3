//! `thornton-ning-raised-pull-off` (its name in model files): a plastic JKR contact, that is
//! Thornton–Ning with the pull-off raised by yielding.
//!
//! Yielding flattens the contact: it separates along the JKR curve of a larger radius of curvature
//! `R_p`, with a larger pull-off force and more adhesive work than on loading (Thornton & Ning,
//! Powder Technology 99 (1998) 154, who integrate such a contact numerically). This law is the
//! exact energy balance of that contact under three assumptions:
//! - `delta = a²/R - sqrt(2πWa/E*)` (JKR) holds while the contact grows, elastic or plastic, from `delta = 0` on;
//! - the JKR pressure `p(r) = p0 u - p1/u`, `u = sqrt(1 - r²/a²)`, `p0 = 2E*a/πR`, `p1 = sqrt(2WE*/πa)`, is limited
//!   to `p_y` where it would be higher, first at the centre: adhesion takes `p1` of the pressure there;
//! - at the largest `a` the JKR curve of `R_p` has the same force: `1/R_p = 3 (F + sqrt(8πWE*a³))/(4E*a³)`. The contact
//!   unloads along it and breaks at the minimum of `delta`, as after an elastic impact.
//!
//! In the units of the yield of a Hertz contact (`a_h = πp_yR/2E*`, its force, `a_h²/R`, and `½mv_y²`), with
//! `t² = a/a_h` and `beta = p1/p_y` at `a_h`, which is `(2/π)(C2 v_adh/(C1 v_y))^(3/5)`:
//! - elastic force `t⁶/rho - 3 beta t³`, displacement `t⁴/rho - 2 beta t`, `rho = R_p/R`, and their work
//!   `phi(t, rho) = t¹⁰/rho² - 5 beta t⁷/rho + (15/4) beta² t⁴`;
//! - past yield the pressure is limited up to the `u` with `t u = 1/y`, `t = y(1 + beta y)`, and in
//!   `y` force and work are polynomials: with `s = beta y`, `F = 3t⁴/2 - (1+s)²(1/2 + 2s)`;
//! - first contact `t³ = 2 beta`, yield `y²(1 + beta y) = 1`, parting `t³ = beta rho/2`;
//! - `e_n² = [phi(t, rho) - (3/2) beta² (beta rho/2)^(4/3)] / (v/v_y)²` with the `t` that `v` reaches.
//!
//! Below yield this is Thornton–Ning to the last bit. Without adhesion it is their `P(v_y/v)`. Its
//! own yield velocity is that of the JKR contact: `v_y (1 - 3.1 beta²)` for weak adhesion, and 0
//! from `v_adh = 0.61 v_y` on, where adhesion alone makes the contact yield. The sticking velocity
//! is that of Thornton–Ning up to `v_adh = 0.48 v_y` and higher from there on.
//!
//! Adhesion also lowers the pressure at the centre, so that a fast contact flattens less: far above
//! `v_s`, `e_n` is up to 0.01 higher than by Thornton–Ning.
//!
//! Symbols: as in `thornton_ning.rs`. Valid as Thornton–Ning, for `a` small against `R`; at the
//! sticking velocity `a` is 0.7 to 1.2 times `a_h v_adh/v_y` for `v_adh/v_y` of 3 to 1000, and much
//! of it exists at rest, since adhesion alone pulls the particle in. The change of `delta(a)` under
//! the pressure limit is neglected. For 4.9 µm ammonium fluorescein the sticking velocity is 1.46
//! m/s, against 0.69 m/s of the closed form and about 1.6 m/s that Thornton & Ning found. Their
//! paper was not available; the three assumptions are taken from accounts of it. A force past yield
//! of `dF/da = 2πap_y - sqrt(2πWE*a)`, which keeps the pull at the rim as at yield, would give 1.82
//! m/s: a measure of the uncertainty.

use super::thornton_ning::{ADHESIVE_FACTOR, YIELD_FACTOR, restitution as plain_restitution};

/// Normal restitution `e_n` [1] at the normal speed `v`, with `v_adh` and `v_y` of Thornton–Ning in the same unit.
pub fn restitution(speed: f64, adhesive: f64, yielding: f64) -> f64 {
    let impact = YieldingContact::new(adhesive, yielding);
    let energy = (speed / yielding).powi(2);
    if energy <= impact.yield_energy {
        return plain_restitution(speed, adhesive, f64::INFINITY);
    }
    // Adhesion of a contact that yields holds no less than that of an elastic one.
    if speed <= adhesive {
        return 0.0;
    }
    let y = crossing(impact.start, |y| impact.work(y) - energy);
    (impact.recovered(y) / energy).max(0.0).sqrt()
}

/// Yield and sticking velocity `[v_y, v_s]` [m/s] of the law, from `v_adh` and `v_y` [m/s] of Thornton–Ning.
pub fn speeds(adhesive: f64, yielding: f64) -> [f64; 2] {
    if !adhesive.is_finite() {
        return [0.0, adhesive];
    }
    let impact = YieldingContact::new(adhesive, yielding);
    // The last `max` of each is for contacts so small that the polynomials overflow.
    let own_yield = (yielding * impact.yield_energy.max(0.0).sqrt()).max(0.0);
    if adhesive <= own_yield {
        return [own_yield, adhesive];
    }
    let y = crossing(impact.start, |y| impact.recovered(y));
    [own_yield, (yielding * impact.work(y).max(0.0).sqrt()).max(adhesive)]
}

/// A contact in the units of its Hertz yield.
struct YieldingContact {
    /// `beta` [1]: pressure that adhesion removes at the centre when a Hertz contact yields, over
    /// the limiting pressure.
    beta: f64,
    /// `y` where the pressure limit begins to act: at yield, or at first contact when that already yields.
    start: f64,
    /// Kinetic energy that brings the contact to yield; negative where adhesion does.
    yield_energy: f64,
    /// Constant of the polynomial in [`Self::work`].
    offset: f64,
}

impl YieldingContact {
    fn new(adhesive: f64, yielding: f64) -> Self {
        let ratio = YIELD_FACTOR / ADHESIVE_FACTOR * (adhesive / yielding);
        let beta = std::f64::consts::FRAC_2_PI * ratio.powf(0.6);
        let contact = Self { beta, start: 0.0, yield_energy: 0.0, offset: 0.0 };
        let first = (2.0 * beta).cbrt();
        let at_first = 2.0 * first / (1.0 + (1.0 + 4.0 * beta * first).sqrt());
        let at_yield = yield_parameter(beta);
        let start = at_yield.max(at_first);
        let reached = contact.elastic(start * (1.0 + beta * start), 1.0) - contact.elastic(first, 1.0);
        // Where first contact is past yield, the way to `start` has no length and takes no energy.
        let reached = if at_yield > at_first { reached } else { 0.0 };
        Self { start, yield_energy: reached, offset: reached - contact.plastic_primitive(start), ..contact }
    }

    /// `phi(t, rho)`: work that the JKR curve of the curvature `1/rho` has taken up to `t`.
    fn elastic(&self, t: f64, curvature: f64) -> f64 {
        let pressed = t.powi(3) * curvature;
        t.powi(4) * (pressed * (pressed - 5.0 * self.beta) + 3.75 * self.beta * self.beta)
    }

    /// Kinetic energy that a contact takes to reach `y` past yield.
    fn work(&self, y: f64) -> f64 {
        self.offset + self.plastic_primitive(y)
    }

    /// `(5/2)∫F d(delta)` past yield, a polynomial in `y` and `s = beta y`.
    fn plastic_primitive(&self, y: f64) -> f64 {
        // (1+s)⁵(2+8s)(1+2s) and (1+s)²(1+4s)(1+2s), lowest power first.
        const HELD: [f64; 8] = [2.0, 22.0, 96.0, 220.0, 290.0, 222.0, 92.0, 16.0];
        const PULLED: [f64; 5] = [1.0, 8.0, 21.0, 22.0, 8.0];
        let s = self.beta * y;
        let t = y * (1.0 + s);
        let limited = 0.75 * t.powi(8) - 0.6 * self.beta * t.powi(5);
        let rest = s * integral(&PULLED, 1, s) - y.powi(4) * integral(&HELD, 4, s);
        2.5 * (limited + rest)
    }

    /// Energy left after the contact has parted from `y`; negative where adhesion holds it.
    fn recovered(&self, y: f64) -> f64 {
        let s = self.beta * y;
        let t = y * (1.0 + s);
        let force = 1.5 * t.powi(4) - (1.0 + s).powi(2) * (0.5 + 2.0 * s);
        let curvature = (force + 3.0 * self.beta * t.powi(3)) / t.powi(6);
        let parted = 1.5 * self.beta * self.beta * (0.5 * self.beta / curvature).cbrt().powi(4);
        self.elastic(t, curvature) - parted
    }
}

/// `∫ s^(k-1) poly(s) ds / s^k`, from 0, with coefficients lowest power first.
fn integral(polynomial: &[f64], k: usize, s: f64) -> f64 {
    let terms = polynomial.iter().enumerate().rev();
    terms.fold(0.0, |sum, (power, coefficient)| sum * s + coefficient / (power + k) as f64)
}

/// The `y` in 0 to 1 with `y²(1 + beta y) = 1`, where the contact yields.
fn yield_parameter(beta: f64) -> f64 {
    // Halving, from an interval that contains it: y² <= 1 and beta y³ <= 1.
    let high = 1f64.min(1.0 / beta.cbrt());
    halve(0.5 * high, high, |y| y * y * (1.0 + beta * y) - 1.0)
}

/// Where `excess`, negative or zero at `low`, turns positive above it.
fn crossing(low: f64, excess: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (low, 2.0 * low);
    // Two hundred doublings are beyond any contact: its size grows with no more than the fourth root of the energy.
    for _ in 0..200 {
        if excess(high) > 0.0 {
            break;
        }
        (low, high) = (high, 2.0 * high);
    }
    halve(low, high, excess)
}

/// Root of a function that rises through zero between `low` and `high`, to the last bit, by halving.
fn halve(mut low: f64, mut high: f64, excess: impl Fn(f64) -> f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if !(low < middle && middle < high) {
            return middle;
        }
        *(if excess(middle) > 0.0 { &mut high } else { &mut low }) = middle;
    }
}

#[cfg(test)]
mod tests {
    use super::super::thornton_ning::{plastic_term, sticking_velocity};
    use super::*;
    use approx::assert_relative_eq;

    /// Found by fuzzing: the polynomials of a contact far below an atom overflow, and it has to stick nevertheless.
    #[test]
    fn adhesion_beyond_all_numbers_holds() {
        for adhesive in [1e30, 1e100, 1e200, 1e300, f64::MAX, f64::INFINITY] {
            for yielding in [5e-324, 1e-100, 1e-3, 1.0] {
                let [own_yield, sticking] = speeds(adhesive, yielding);
                assert!(
                    own_yield == 0.0 && sticking >= adhesive,
                    "{adhesive:e} {yielding:e}: {own_yield} {sticking:e}"
                );
                assert_eq!(restitution(0.5 * adhesive.min(f64::MAX), adhesive, yielding), 0.0);
            }
        }
    }

    #[test]
    fn without_adhesion_it_is_the_plastic_term() {
        for w in [0.999, 0.9, 0.5, 0.1, 1e-3, 1e-6] {
            let e_n = restitution(1.0 / w, 0.0, 1.0);
            assert_relative_eq!(e_n * e_n, plastic_term(w), max_relative = 1e-12);
        }
    }

    #[test]
    fn elastic_impacts_are_those_of_thornton_and_ning() {
        let (adhesive, yielding) = (0.01, 0.1);
        let [own_yield, sticking] = speeds(adhesive, yielding);
        assert_eq!(sticking, adhesive);
        for share in [0.05, 0.2, 0.5, 0.99] {
            let speed = share * own_yield;
            let plain = plain_restitution(speed, adhesive, yielding);
            assert_eq!(restitution(speed, adhesive, yielding).to_bits(), plain.to_bits());
        }
    }

    /// Also at the yield velocity, and where yield begins at first contact: `e_n` has no jump.
    #[test]
    fn restitution_is_continuous_at_yield_and_at_sticking() {
        for ratio in [1e-6, 0.01, 0.3, 0.7] {
            let [own_yield, _] = speeds(ratio, 1.0);
            let at = |share: f64| restitution(own_yield * share, ratio, 1.0);
            assert!((at(1.0 - 1e-9) - at(1.0 + 1e-9)).abs() < 1e-6, "v_adh/v_y {ratio}");
        }
        for ratio in [1.0, 3.0, 17.0, 300.0, 1e4, 1e7] {
            let [_, sticking] = speeds(ratio, 1.0);
            assert_eq!(restitution(sticking * (1.0 - 1e-9), ratio, 1.0), 0.0);
            let above = restitution(sticking * (1.0 + 1e-6), ratio, 1.0);
            assert!(above > 0.0 && above < 0.01, "v_adh/v_y {ratio}: e_n {above}");
        }
    }

    #[test]
    fn yielding_never_lowers_the_sticking_velocity() {
        for tenth in -40..=70 {
            let ratio = 10f64.powf(0.1 * f64::from(tenth));
            let [_, sticking] = speeds(ratio, 1.0);
            let plain = sticking_velocity(ratio, 1.0);
            assert!(sticking >= plain * (1.0 - 1e-12), "v_adh/v_y {ratio}: {sticking} below {plain}");
        }
    }

    /// What a hostile model file can give leaves numbers in 0 to 1.
    #[test]
    fn extremes_leave_numbers() {
        for adhesive in [0.0, 1e-30, 1.0, 1e30] {
            for yielding in [1e-30, 1.0, 1e30] {
                for speed in [0.0, 1e-20, 1.0, 1e6] {
                    let e_n = restitution(speed, adhesive, yielding);
                    assert!((0.0..=1.0).contains(&e_n), "{speed} {adhesive} {yielding}: {e_n}");
                }
                assert!(speeds(adhesive, yielding).iter().all(|speed| !speed.is_nan()));
            }
        }
    }
}
