//! Viscous sintering of a deposit: necks and densification.
//!
//! With the reduced time `s = gamma t/(mu r)` ([`reduced_time`]), which is summed over steps of any length:
//!
//! - necks, Frenkel (J. Phys. USSR 9 (1945) 385): `(x/r)² = (3/2) s`;
//! - open pores, Frenkel's shrinkage `1 - (rho_0/rho)^(1/3) = (3/8) s`, from the packing `rho_0` to `rho` = 0.8;
//! - closed pores, Mackenzie & Shuttleworth (Proc. Phys. Soc. B 62 (1949) 833): `1 - rho = 0.2
//!   exp(-(3/2) (r/a_0) (s - s_c))`, with `s_c` the time at which `rho` = 0.8, and `a_0` such that
//!   the same exponential leads from the packing at `s = 0` to `rho` = 0.8 at `s_c`: `(3/2) r/a_0 =
//!   ln((1 - rho_0)/0.2)/s_c`.
//!
//! `gamma` surface tension [N/m], `mu` viscosity [Pa s], `r` radius of the particles [m], `x`
//! radius of the neck [m], `rho = 1 - p` relative density [1], `p` porosity [1], `a_0` radius of
//! the pores [m]. The change of law at 0.8 and the rule for `a_0` are those of the model of
//! clusters (Prado, Zanotto & Müller, J. Non-Cryst. Solids 279 (2001) 169), for one particle size.
//! Read were abstracts and two codes that write the factors 3/2, 3/8 and 3/2 and the rule;
//! Eshelby's correction of Frenkel's balance gives 1 for the first 3/2 (not re-read). All three are
//! closed forms of `s`: two half steps are one step.
//!
//! Below a residual porosity (0.03 by default) nothing shrinks: pores are isolated and keep their
//! gas. Measured: 0.01 to 0.03 in volcanic glass (Wadsworth et al., Earth Planet. Sci. Lett. 525
//! (2019) 115726), 0.02 to 0.05 in obsidian (Gardner et al., Bull. Volcanol. 80 (2018) 23; both
//! abstracts).
//!
//! Valid for spheres of one size that flow as a Newtonian liquid by their own surface tension;
//! `x/r` up to some 0.3 and shrinkage up to some 0.1 for Frenkel's law. A powder of cordierite
//! glass followed it until it was almost dense (Giess et al., abstract); the change at 0.8 makes
//! such a powder slower: `rho` = 0.88 when Frenkel's law would make it dense. Looser packings
//! (`rho_0` below 0.5) are an extrapolation. Neglected: crystals, which stop sintering (give an
//! infinite viscosity), load, and the spread of sizes: fine particles sinter first, by `1/r`.
//! Errors: the rate is as uncertain as `1/mu`, so a factor of 2 to 10 for an ash; by shape a factor
//! of 2 more.

use std::sync::Arc;

use super::Deposit;
use super::process::{DepositHeat, Process, ProcessInfo, Step};

pub(super) const INFO: ProcessInfo =
    ProcessInfo { name: "sintering", loss: None, gain: None, read: |_| Ok(Some(Arc::new(Sintering))) };

/// Relative density [1] at which the pores close.
const CLOSED: f64 = 0.8;
/// Residual porosity [1] of isolated pores, unless another is given.
const RESIDUAL_POROSITY: f64 = 0.03;

#[derive(Debug)]
struct Sintering;

impl Process for Sintering {
    /// Inner and outer powder sinter at their own mean temperatures.
    fn after(&self, deposit: &Deposit, step: &Step<'_>) -> Deposit {
        let DepositHeat::Cooled { flow, .. } = step.heat else { return *deposit };
        let radius = 0.5 * deposit.powder_diameter();
        if radius <= 0.0 {
            return *deposit;
        }
        let voidage = step.surroundings.voidage;
        let before = deposit.porosity(voidage);
        let after = |[cold, hot]: [f64; 2]| {
            let known = step.powder.sintering(0.5 * (cold + hot));
            known.map_or(before, |[viscosity, tension]| {
                let time = reduced_time(step.duration, tension, viscosity, radius);
                porosity(before, &Packing::new(voidage), time)
            })
        };
        deposit.sintered(voidage, [flow.sides.inner_powder, flow.sides.outer_powder].map(after))
    }
}

/// Packing of a powder, and the porosity at which its sintering ends.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Packing {
    /// Porosity of the fresh powder [1], above 0 and below 1.
    porosity: f64,
    /// Residual porosity [1].
    residual: f64,
}

impl Packing {
    /// A packing of a porosity [1] with the usual residual porosity.
    fn new(porosity: f64) -> Self {
        Self { porosity, residual: RESIDUAL_POROSITY }
    }
}

/// Reduced time `gamma t/(mu r)` [1] of a time [s]; 0 for an infinite viscosity.
fn reduced_time(time: f64, surface_tension: f64, viscosity: f64, radius: f64) -> f64 {
    surface_tension * time / (viscosity * radius)
}

/// Neck ratio `x/r` [1] of a powder that sintered from a packing to a porosity [both 1]: necks of the height `x²/(4 r)`
/// bring the centres together by `1 - (rho_0/rho)^(1/3) = (x/r)²/4`.
pub fn neck_of_porosity(porosity: f64, packing_porosity: f64) -> f64 {
    (4.0 * shrinkage(porosity, packing_porosity)).max(0.0).sqrt().min(1.0)
}

/// Porosity [1] after a reduced time [1], from a porosity before it; the time must not be NaN.
fn porosity(before: f64, packing: &Packing, reduced_time: f64) -> f64 {
    if before <= packing.residual {
        return before;
    }
    let left = closing_time(before, packing.porosity);
    let after = if reduced_time <= left {
        let contraction = 1.0 - shrinkage(before, packing.porosity) - 0.375 * reduced_time;
        1.0 - (1.0 - packing.porosity) / contraction.powi(3)
    } else {
        before.min(1.0 - CLOSED) * (-closed_rate(packing.porosity) * (reduced_time - left)).exp()
    };
    after.max(packing.residual)
}

/// Linear shrinkage `1 - (rho_0/rho)^(1/3)` [1].
fn shrinkage(porosity: f64, packing_porosity: f64) -> f64 {
    1.0 - ((1.0 - packing_porosity) / (1.0 - porosity)).cbrt()
}

/// Reduced time [1] until the pores close.
fn closing_time(porosity: f64, packing_porosity: f64) -> f64 {
    let rest = shrinkage(1.0 - CLOSED, packing_porosity) - shrinkage(porosity, packing_porosity);
    (rest / 0.375).max(0.0)
}

/// Decay `(3/2) r/a_0` [1] of closed pores over the reduced time. A powder packed as densely as
/// closed pores has the limit for that packing, 4.5.
fn closed_rate(packing_porosity: f64) -> f64 {
    let excess = packing_porosity / (1.0 - CLOSED) - 1.0;
    if excess < 1e-6 {
        return 0.9 / (1.0 - CLOSED);
    }
    excess.ln_1p() / closing_time(packing_porosity, packing_porosity)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Rate `dp/ds` [1] of the porosity over the reduced time, from the laws in differential form.
    fn densification_rate(porosity: f64, packing: &Packing) -> f64 {
        let dense = 1.0 - porosity;
        if dense < CLOSED {
            -1.125 * dense / (1.0 - shrinkage(porosity, packing.porosity))
        } else {
            -closed_rate(packing.porosity) * porosity
        }
    }

    /// Neck ratio `x/r` [1] after a reduced time [1], by Frenkel.
    fn neck(reduced_time: f64) -> f64 {
        (1.5 * reduced_time).sqrt()
    }

    const PACKINGS: [f64; 7] = [0.15, 0.2, 0.3, 0.4, 0.6, 0.8, 0.95];

    #[test]
    fn necks_and_shrinkage_follow_frenkel() {
        // By hand: 0.4·60/(1e8·1e-5) = 0.024.
        let s = reduced_time(60.0, 0.4, 1e8, 1e-5);
        assert_relative_eq!(s, 0.024, max_relative = 1e-14);
        assert_relative_eq!(neck(s).powi(2), 3.0 * 0.4 * 60.0 / (2.0 * 1e-5 * 1e8), max_relative = 1e-14);
        let packing = Packing::new(0.4);
        let dense = 1.0 - porosity(0.4, &packing, s);
        assert_relative_eq!(dense, 0.6 / (1.0 - 3.0 * s / 8.0).powi(3), max_relative = 1e-14);
        // Both by the same necks.
        assert_relative_eq!(neck_of_porosity(1.0 - dense, 0.4), neck(s), max_relative = 1e-12);
        assert_eq!(neck_of_porosity(0.4, 0.4), 0.0);
        assert_eq!(neck_of_porosity(0.5, 0.4), 0.0);
        // Stiff: nothing happens.
        assert_eq!(reduced_time(1e9, 0.4, f64::INFINITY, 1e-5), 0.0);
        assert_eq!(porosity(0.4, &packing, 0.0), 0.4);
    }

    /// Mackenzie & Shuttleworth's exponential, with the rule for the pores' radius by hand: `rho_0` = 0.6 closes at
    /// `s_c` = (8/3) (1 - 0.75^(1/3)) = 0.2438, `ln 2/s_c` = 2.843, so `a_0` = 0.528 r.
    #[test]
    fn closed_pores_follow_mackenzie_and_shuttleworth() {
        let packing = Packing { porosity: 0.4, residual: 0.0 };
        let close = 8.0 / 3.0 * (1.0 - 0.75_f64.cbrt());
        assert_relative_eq!(close, 0.243_8, max_relative = 1e-3);
        assert_relative_eq!(porosity(0.4, &packing, close), 0.2, max_relative = 1e-12);
        assert_relative_eq!(1.5 / closed_rate(0.4), 0.528, max_relative = 1e-3);
        for s in [0.3, 0.7, 2.0] {
            assert_relative_eq!(
                porosity(0.4, &packing, s),
                0.4 * 2.0_f64.powf(-s / close),
                max_relative = 1e-12
            );
        }
        assert_relative_eq!(closed_rate(0.2 * (1.0 + 2e-6)), closed_rate(0.2), max_relative = 1e-4);
    }

    /// Steps of 1e-3 s and of hours alike: any division of a time gives the same porosity.
    #[test]
    fn steps_add_up() {
        for packing in PACKINGS.map(Packing::new) {
            for whole in [1e-9, 1e-3, 0.1, 0.3, 1.0, 3.0, 40.0, 1e6] {
                let one = porosity(packing.porosity, &packing, whole);
                for parts in [2_u32, 7, 1000] {
                    let part = whole / f64::from(parts);
                    let many = (0..parts).fold(packing.porosity, |p, _| porosity(p, &packing, part));
                    assert_relative_eq!(one, many, max_relative = 1e-11);
                }
            }
        }
    }

    #[test]
    fn porosity_falls_at_its_rate_to_the_residual() {
        for packing in PACKINGS.map(Packing::new) {
            let mut before = packing.porosity;
            for _ in 0..4000 {
                let (half, step) = (5e-6, 1e-5);
                let middle = porosity(before, &packing, half);
                let after = porosity(before, &packing, step);
                assert!(after <= before && after >= packing.residual);
                let away = (middle - 0.2).abs() > 1e-4 && after > packing.residual;
                if away {
                    let rate = (after - before) / step;
                    assert_relative_eq!(rate, densification_rate(middle, &packing), max_relative = 1e-6);
                }
                before = porosity(before, &packing, 1e-3);
            }
            assert_eq!(porosity(packing.porosity, &packing, 1e9), RESIDUAL_POROSITY);
            assert_eq!(porosity(packing.porosity, &packing, f64::INFINITY), RESIDUAL_POROSITY);
            assert_eq!(porosity(0.01, &packing, 1.0), 0.01);
        }
    }

    /// No measured curve with its viscosity could be read. Giess et al. (abstract): pressed
    /// cordierite glass followed Frenkel's law until it was almost dense, and shrank to full
    /// density by 0.12 along the axis and 0.17 across, which is a packing of 0.88·0.83² = 0.606.
    /// Here Frenkel's law ends at a shrinkage of 0.088, after 58 % of the way in length, and the
    /// powder reaches 0.88 when Frenkel's law would make it dense: slower than measured.
    #[test]
    fn a_glass_powder_shrinks_as_far_as_its_packing_allows() {
        let packing = 1.0 - 0.88 * 0.83 * 0.83;
        assert_relative_eq!(shrinkage(0.0, packing), 0.1537, max_relative = 2e-3);
        assert_relative_eq!(shrinkage(0.2, packing), 0.0884, max_relative = 5e-3);
        let when_dense = shrinkage(0.0, packing) / 0.375;
        assert_relative_eq!(
            porosity(packing, &Packing::new(packing), when_dense),
            0.121,
            max_relative = 5e-3
        );
    }
}
