//! Effective thermal conductivity of a deposit layer, from loose powder to dense slag.
//!
//! **Loose powder** ([`packed_bed`]), after Zehner, Bauer and Schlünder (VDI Heat Atlas, section
//! D6.3), with `p` the porosity [1], `k_p = k_s/k_g`, `k_r = 4 sigma T³ d/((2/epsilon - 1) k_g)`
//! and `B = 1.25 ((1-p)/p)^(10/9)` for spheres:
//!
//! `k/k_g = (1 - sqrt(1-p)) (1 + p k_r) + sqrt(1-p) k_c`, `k_c = k_p + k_p k_r/(B K) - (k_p/K)² (K-1) S(M)`,
//!
//! `K = k_p + k_r`, `M = 1 - B/K`, `S(M) = 2 (M - M²/2 + (1-M) ln(1-M))/M³`.
//!
//! This is the published expression in a form without the differences that cancel where `B`
//! approaches `K` (a test compares both). `k_s`, `k_g` conductivities of solid and gas [W/(m K)],
//! `sigma` the Stefan–Boltzmann constant, `T` temperature [K], `d` diameter of the particles [m],
//! `epsilon` their emissivity [1]. The contacts are points and the gas is dense (mean free path far
//! below `d`). The expression was read in two codes that cite the atlas; with spheres of `k_p` 8 to
//! 1200 and porosities down to 0.2 it agrees with measurements (Kandula, abstract). With spheres of
//! 2.5 to 13.5 mm at 350 to 1300 K it agrees when hot and overpredicts when cool (J. Heat Transfer
//! 116 (1994) 829, abstract).
//!
//! **Dense layer with closed pores** ([`closed_pores`]), Maxwell–Eucken with gas of `k_v = k_g (1 +
//! p k_r)` in the pores:
//!
//! `k = k_s (2 k_s + k_v - 2 p (k_s - k_v))/(2 k_s + k_v + p (k_s - k_v))`,
//!
//! which is also the upper bound of Hashin and Shtrikman (J. Appl. Phys. 33 (1962) 3125).
//!
//! **In between** ([`deposit`]): `k = k_loose + (x/r) (k_dense - k_loose)`, with the neck ratio
//! `x/r` of the sintered particles
//! ([`sintering::neck_of_porosity`](super::sintering::neck_of_porosity)). It is 0 in fresh powder,
//! and at `p = 0` both laws give `k_s`. The weight is *assumed*: the conductance of a narrow neck
//! is proportional to its radius (`2 k_s x`, cubic packing: `k = k_s x/r`), of which the rule gives
//! about half. The rise comes early in sintering and levels off, as Robinson et al. measured
//! (Energy & Fuels 15 (2001) 75, abstract).
//!
//! The result lies between the two bounds of Hashin and Shtrikman. The packed bed's law falls below
//! the lower one for `k_p` up to some 15, and above a porosity of some 0.85 for the 20 to 30 of ash
//! in hot gas; it is raised to the bound there. Above a porosity of 0.9, where `B` and the
//! radiation term lose their meaning, the packed bed is interpolated linearly in `p` to the pore
//! alone.
//!
//! Errors: Robinson et al. measured 0.14 ± 0.03 W/(m K) in loose deposits (Energy & Fuels 15 (2001)
//! 66, abstract), here 0.08 to 0.22 for assumed porosities of 0.8 to 0.6 (test): a factor of 1.7
//! either way, chiefly by the porosity. Their deposit lies midway between the series and the
//! parallel arrangement; if that is meant on a logarithmic scale, its porosity is near 0.8, and the
//! law gives 0.10, too little. Sintered layers: expect a factor of 2, as cracks and layers count.
//! Rezaei et al. (Fuel 79 (2000) 1697) and Zbogar et al. (Prog. Energy Combust. Sci. 31 (2005) 371)
//! compare such laws with ashes; neither could be read.

use super::conduction::STEFAN_BOLTZMANN;

/// Shape factor of spheres [1].
const SPHERES: f64 = 1.25;
/// Porosity [1] up to which the packed bed's law is used.
const LOOSEST: f64 = 0.9;

/// Solid and gas of a layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Phases {
    /// Thermal conductivity of the solid without pores [W/(m K)].
    pub solid: f64,
    /// Thermal conductivity of the gas in the pores [W/(m K)].
    pub gas: f64,
    /// Conductivity of radiation over one particle diameter [W/(m K)], see [`radiative`]; 0 without.
    pub radiative: f64,
}

/// Conductivity [W/(m K)] of radiation across the voids between particles of a diameter [m] and an
/// emissivity [1] at a temperature [K]: `4 sigma T³ d/(2/epsilon - 1)`.
pub fn radiative(temperature: f64, diameter: f64, emissivity: f64) -> f64 {
    4.0 * STEFAN_BOLTZMANN * temperature.powi(3) * diameter * emissivity / (2.0 - emissivity)
}

/// Effective conductivity [W/(m K)] of a layer of a porosity and a neck ratio [both 1].
pub fn deposit(porosity: f64, neck: f64, phases: &Phases) -> f64 {
    let loose = packed_bed(porosity, phases);
    let dense = closed_pores(porosity, phases);
    loose + neck.clamp(0.0, 1.0) * (dense - loose)
}

/// Effective conductivity [W/(m K)] of loose powder of a porosity [1].
pub fn packed_bed(porosity: f64, phases: &Phases) -> f64 {
    let porosity = porosity.clamp(0.0, 1.0);
    let value = if porosity <= LOOSEST {
        zehner_bauer_schluender(porosity, phases)
    } else {
        let solid = (1.0 - porosity) / (1.0 - LOOSEST);
        solid * zehner_bauer_schluender(LOOSEST, phases) + (1.0 - solid) * pore(1.0, phases)
    };
    let [one, other] = [open_grains(porosity, phases), closed_pores(porosity, phases)];
    // A `clamp` would panic between bounds that are not numbers.
    value.max(one.min(other)).min(one.max(other))
}

/// Effective conductivity [W/(m K)] of a solid with closed spherical pores of a porosity [1].
pub fn closed_pores(porosity: f64, phases: &Phases) -> f64 {
    maxwell_eucken(phases.solid, pore(porosity, phases), porosity.clamp(0.0, 1.0))
}

/// Conductivity [W/(m K)] of spherical grains that do not touch: the lower bound.
fn open_grains(porosity: f64, phases: &Phases) -> f64 {
    maxwell_eucken(pore(porosity, phases), phases.solid, 1.0 - porosity)
}

/// Conductivity [W/(m K)] of the gas in the voids with its radiation.
fn pore(porosity: f64, phases: &Phases) -> f64 {
    phases.gas + porosity.clamp(0.0, 1.0) * phases.radiative
}

/// Conductivity [W/(m K)] of a matrix with a share [1] of spheres of another conductivity.
fn maxwell_eucken(matrix: f64, spheres: f64, share: f64) -> f64 {
    let [sum, difference] = [2.0 * matrix + spheres, matrix - spheres];
    matrix * (sum - 2.0 * share * difference) / (sum + share * difference)
}

fn zehner_bauer_schluender(porosity: f64, phases: &Phases) -> f64 {
    if porosity <= 0.0 {
        return phases.solid;
    }
    let solid = phases.solid / phases.gas;
    let radiative = phases.radiative / phases.gas;
    let both = solid + radiative;
    let shape = SPHERES * ((1.0 - porosity) / porosity).powf(10.0 / 9.0);
    let core = solid + solid * radiative / (shape * both)
        - (solid / both).powi(2) * (both - 1.0) * series(1.0 - shape / both);
    let grains = (1.0 - porosity).sqrt();
    phases.gas * ((1.0 - grains) * (1.0 + porosity * radiative) + grains * core)
}

/// `2 (m - m²/2 + (1-m) ln(1-m))/m³`, by its Taylor series `sum of 2 m^(k-3)/(k (k-1))` from `k =
/// 3` where that cancels.
fn series(m: f64) -> f64 {
    if m.abs() < 0.05 {
        let term = |k: i32| 2.0 * m.powi(k - 3) / f64::from(k * (k - 1));
        return (3..16).map(term).sum();
    }
    2.0 * (m - 0.5 * m * m + (1.0 - m) * (-m).ln_1p()) / m.powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deposit::sintering;
    use approx::assert_relative_eq;

    const ASH: Phases = Phases { solid: 1.4, gas: 0.06, radiative: 0.0 };

    fn phases() -> impl Iterator<Item = Phases> {
        let solids = [0.02, 0.06, 0.5, 1.4, 3.0, 16.0, 90.0];
        solids
            .into_iter()
            .flat_map(|solid| [0.0, 1e-3, 0.02].map(|radiative| Phases { solid, gas: 0.06, radiative }))
    }

    #[test]
    fn it_ends_at_the_solid_and_at_the_gas() {
        for phases in phases() {
            for neck in [0.0, 0.3, 1.0] {
                assert_relative_eq!(deposit(0.0, neck, &phases), phases.solid, max_relative = 1e-13);
                assert_relative_eq!(deposit(1e-9, neck, &phases), phases.solid, max_relative = 1e-3);
                let pore = phases.gas + phases.radiative;
                assert_relative_eq!(deposit(1.0, neck, &phases), pore, max_relative = 1e-12);
                assert_relative_eq!(deposit(1.0 - 1e-9, neck, &phases), pore, max_relative = 1e-5);
            }
        }
    }

    /// Series (Reuss) and parallel (Voigt), and the narrower bounds of Hashin and Shtrikman.
    #[test]
    fn it_keeps_its_bounds_and_rises_with_the_necks() {
        for phases in phases() {
            for step in 1..100 {
                let porosity = f64::from(step) / 100.0;
                let void = pore(porosity, &phases);
                let series = 1.0 / (porosity / void + (1.0 - porosity) / phases.solid);
                let parallel = porosity * void + (1.0 - porosity) * phases.solid;
                let ends = [open_grains(porosity, &phases), closed_pores(porosity, &phases)];
                let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                assert!(series <= low * (1.0 + 1e-12) && high <= parallel * (1.0 + 1e-12));
                for neck in [0.0, 0.1, 0.5, 1.0] {
                    let k = deposit(porosity, neck, &phases);
                    assert!(k >= low * (1.0 - 1e-12) && k <= high * (1.0 + 1e-12), "{phases:?} {porosity}");
                }
            }
        }
        let rising: Vec<f64> = (0..=10).map(|i| deposit(0.4, f64::from(i) / 10.0, &ASH)).collect();
        assert!(rising.windows(2).all(|pair| pair[1] > pair[0]));
    }

    /// The expression as the atlas prints it, here with `k_G = 1`, singular where `B` equals `k_p + k_r`.
    fn as_published(porosity: f64, phases: &Phases) -> f64 {
        let [solid, radiative] = [phases.solid / phases.gas, phases.radiative / phases.gas];
        let b = 1.25 * ((1.0 - porosity) / porosity).powf(10.0 / 9.0);
        let n = 1.0 + (radiative - b) / solid;
        let core = 2.0 / n
            * (b * (solid + radiative - 1.0) / (n * n * solid) * ((solid + radiative) / b).ln()
                + (b + 1.0) / (2.0 * b) * (radiative - b)
                - (b - 1.0) / n);
        let grains = (1.0 - porosity).sqrt();
        phases.gas * ((1.0 - grains) * porosity * (1.0 / porosity + radiative) + grains * core)
    }

    #[test]
    fn it_is_the_published_expression() {
        for phases in phases() {
            for porosity in [0.1, 0.26, 0.4, 0.6, 0.8, 0.9] {
                let expected = as_published(porosity, &phases);
                let found = zehner_bauer_schluender(porosity, &phases);
                assert_relative_eq!(found, expected, max_relative = 1e-9);
            }
        }
        // Across the removable singularity nothing jumps.
        let near = |m: f64| series(m);
        assert_relative_eq!(near(0.05 - 1e-12), near(0.05 + 1e-12), max_relative = 1e-9);
        assert_relative_eq!(near(0.0), 1.0 / 3.0, max_relative = 1e-15);
        assert_relative_eq!(near(1.0 - 1e-15), 1.0, max_relative = 1e-12);
        // Solid and gas alike: no structure.
        assert_relative_eq!(packed_bed(0.4, &Phases { solid: 0.06, ..ASH }), 0.06, max_relative = 1e-12);
        // By hand: k_p = 50, p = 0.4: B = 1.961, k/k_g = 7.10.
        assert_relative_eq!(packed_bed(0.4, &Phases { solid: 3.0, ..ASH }), 0.06 * 7.10, max_relative = 1e-3);
    }

    #[test]
    fn radiation_between_fine_particles_is_small() {
        // By hand: 4·5.67e-8·1e9·20e-6·0.8/1.2 = 0.00302.
        assert_relative_eq!(radiative(1000.0, 20e-6, 0.8), 0.003_024, max_relative = 1e-3);
        let with = Phases { radiative: radiative(1000.0, 20e-6, 0.8), ..ASH };
        let rise = packed_bed(0.6, &with) / packed_bed(0.6, &ASH) - 1.0;
        assert!(rise > 0.0 && rise < 0.06, "{rise}");
    }

    /// Robinson, Buckley and Baxter, Energy & Fuels 15 (2001) 66 (abstract): 0.14 ± 0.03 W/(m K),
    /// the mean of loose, unsintered deposits, about midway between the theoretical limits.
    /// Porosity, gas temperature and ash are not in the abstract: 0.6 to 0.8, 0.05 to 0.065 W/(m K)
    /// (air of 650 to 950 K) and 1 to 2 W/(m K) are assumed.
    #[test]
    fn loose_deposits_as_measured() {
        let mut within = 0;
        let mut all = Vec::new();
        for porosity in [0.6, 0.7, 0.8] {
            for gas in [0.05, 0.065] {
                for solid in [1.0, 2.0] {
                    let k = deposit(porosity, 0.0, &Phases { solid, gas, radiative: 0.0 });
                    within += usize::from((k - 0.14).abs() <= 0.03);
                    all.push(k);
                }
            }
        }
        all.sort_by(f64::total_cmp);
        println!("Robinson 0.14 ± 0.03; here {:.3} to {:.3}, {within} of 12 within", all[0], all[11]);
        assert!(within >= 6, "{all:?}");
        assert!(all[0] > 0.08 && all[11] < 0.22, "{all:?}");
    }

    /// Energy and Buildings 81 (2014) 262 (abstract): foamed and sintered fly ash of 86.3 to 94.5 %
    /// porosity; the lowest conductivity is 0.0511 W/(m K), with the least solid. Which porosity
    /// belongs to it is not in the abstract: the highest is assumed, with air of 0.026 W/(m K).
    #[test]
    fn foamed_fly_ash_as_measured() {
        let foam = Phases { solid: 1.4, gas: 0.026, radiative: 0.0 };
        let [loose, dense] = [packed_bed(0.945, &foam), closed_pores(0.945, &foam)];
        println!("foam 0.0511; here loose {loose:.4}, closed pores {dense:.4}");
        assert!(loose < 0.0511 && 0.0511 < dense);
    }

    /// Robinson et al., Energy & Fuels 15 (2001) 75 (abstract): the first sintering raises the
    /// conductivity, later sintering little.
    #[test]
    fn the_first_sintering_counts_most() {
        let at = |porosity: f64| deposit(porosity, sintering::neck_of_porosity(porosity, 0.6), &ASH);
        let [fresh, first, later] = [at(0.6), at(0.58), at(0.56)];
        println!("porosity 0.60, 0.58, 0.56: {fresh:.3}, {first:.3}, {later:.3} W/(m K)");
        assert!(first - fresh > 1.5 * (later - first) && later > first);
    }
}
