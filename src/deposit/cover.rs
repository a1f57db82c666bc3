//! Share of a wall that non-sticky particles cover: random landing and burial.
//!
//! `c = 1 - exp(-A)`, with `c` the covered share [1] and `A` the projected area of the particles
//! per area of wall [1]: each lands at a random place, overlaps included (a Poisson process of
//! discs). Molten particles bury what they hit: over a step in which a projected area `a` of powder
//! and `b` of melt arrive, evenly mixed, `dA = a ds - b c(A) ds` for `s` from 0 to 1, so with `x =
//! a - b`
//!
//! `A(1) = ln(exp(A + x) + b (exp(x) - 1)/x)`.
//!
//! A thin cover (`A << 1`) decays as `exp(-b)`, by a factor e for each particle height (`2 d/3`,
//! volume over projected area) of fresh melt; a thick one disappears particle for particle.
//! `b` is the area that molten particles cover once they have spread, four times their projected area
//! (`wetting.rs`). *Assumed*: that char does not float up through melt, sink into it or drift
//! together. Segregation and coverage: Troiano et al., section 1 and
//! the regimes they cite; they give no law.

/// Covered share [1] by a projected area of particles per area of wall [1].
pub fn share(cover: f64) -> f64 {
    -(-cover).exp_m1()
}

/// Projected area per area of wall [1] of an evenly spread layer of a thickness [m] of grains of a
/// diameter [m]: `3 h (1 - voidage)/(2 d)`, with half of the layer voids (*assumed*).
pub fn of_layer(thickness: f64, diameter: f64) -> f64 {
    1.5 * thickness * (1.0 - VOIDAGE) / diameter
}

/// Share of voids in a layer that is given by its thickness alone [1].
const VOIDAGE: f64 = 0.5;

/// Projected area [1] after `landed` of powder and `buried` of melt [both 1] have arrived on
/// `before` [1], evenly mixed.
pub fn after(before: f64, landed: f64, buried: f64) -> f64 {
    if buried <= 0.0 {
        return before + landed;
    }
    let x = landed - buried;
    let end = before + x;
    let growth = if x == 0.0 { 1.0 } else { x.exp_m1() / x };
    // The same equation in three forms: accurate for a thin cover, and without overflow for a thick one.
    if before <= 30.0 && x <= 30.0 {
        (x.exp() * before.exp_m1() + landed * growth).ln_1p()
    } else if end > 0.0 {
        let rest = if x == 0.0 { (-before).exp() } else { ((-before).exp() - (-end).exp()) / x };
        end + (buried * rest).ln_1p()
    } else {
        (end.exp() - x.exp() + landed * growth).ln_1p()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// The differential equation in small steps of the classical Runge–Kutta method.
    fn integrated(before: f64, landed: f64, buried: f64) -> f64 {
        let rate = |cover: f64| landed - buried * (1.0 - (-cover).exp());
        let steps = 20_000;
        let h = 1.0 / f64::from(steps);
        (0..steps).fold(before, |cover, _| {
            let k1 = rate(cover);
            let k2 = rate(cover + 0.5 * h * k1);
            let k3 = rate(cover + 0.5 * h * k2);
            let k4 = rate(cover + h * k3);
            cover + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        })
    }

    #[test]
    fn it_solves_its_differential_equation() {
        for before in [0.0, 1e-3, 0.4, 2.0, 9.0] {
            for landed in [0.0, 1e-4, 0.3, 1.0, 5.0] {
                for buried in [0.0, 1e-4, 0.3, 1.0, 5.0] {
                    let found = after(before, landed, buried);
                    let expected = integrated(before, landed, buried);
                    assert!(
                        (found - expected).abs() <= 1e-11 * (1.0 + expected),
                        "{before} {landed} {buried}"
                    );
                }
            }
        }
    }

    #[test]
    fn it_has_its_limits() {
        assert_eq!(after(0.3, 0.2, 0.0), 0.5);
        assert_relative_eq!(after(1e-9, 0.0, 2.0), 1e-9 * (-2.0_f64).exp(), max_relative = 1e-8);
        // Thick: one for one. Neither exp(A) nor exp(-x) overflows.
        assert_relative_eq!(after(2000.0, 0.0, 900.0), 1100.0, max_relative = 1e-14);
        assert_relative_eq!(after(2000.0, 1000.0, 0.5), 2999.5, max_relative = 1e-14);
        assert_eq!(after(0.0, 0.0, 5000.0), 0.0);
        // Much melt and some char settle where as much lands as is buried: share = landed/buried.
        assert_relative_eq!(share(after(30.0, 3000.0, 9000.0)), 1.0 / 3.0, max_relative = 1e-12);
        assert_relative_eq!(share(after(0.0, 3000.0, 9000.0)), 1.0 / 3.0, max_relative = 1e-12);
    }
}
