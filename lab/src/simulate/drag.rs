//! Drag on a sphere (Schiller and Naumann 1933).
//!
//! `C_D Re = 24 (1 + 0.15 Re^0.687)` up to `Re = 1000`, `0.44 Re` above, with `Re = rho_g |u - v| d
//! / mu`. The sphere is rigid, smooth and far from walls and from other particles; lift, added mass
//! and history forces are left out, which holds for `rho_p >> rho_g`. In a thin gas
//! ([`slip_factor`]) the drag is divided by Cunningham's factor.

/// Drag coefficient times Reynolds number [1] at a Reynolds number [1].
pub fn coefficient_times_reynolds(reynolds: f64) -> f64 {
    if reynolds > 1000.0 { 0.44 * reynolds } else { 24.0 * (1.0 + 0.15 * reynolds.powf(0.687)) }
}

/// Response rate `1/tau` [1/s] of a particle: it accelerates by the rate times the slip velocity.
///
/// `1/tau = (3/4) C_D Re mu / (rho_p d²)`; without inertia effects (`Re -> 0`) `tau = rho_p d² / (18 mu)`.
/// `reynolds` [1], `viscosity` [Pa s] of the gas, `density` [kg/m³] of the particle, `diameter` [m].
pub fn response_rate(reynolds: f64, viscosity: f64, density: f64, diameter: f64) -> f64 {
    0.75 * coefficient_times_reynolds(reynolds) * viscosity / (density * diameter * diameter)
}

/// Cunningham's slip factor [1] by which drag is less than in a dense gas (Davies 1945):
/// `1 + Kn (1.257 + 0.4 exp(-1.1/Kn))` with `Kn = 2 lambda/d`.
///
/// `mean_free_path` of the gas, `lambda` [m], and `diameter` [m]. Holds from continuum to free molecular flow at small
/// `Re` and Mach numbers.
pub fn slip_factor(mean_free_path: f64, diameter: f64) -> f64 {
    if mean_free_path <= 0.0 {
        return 1.0;
    }
    let knudsen = 2.0 * mean_free_path / diameter;
    1.0 + knudsen * (1.257 + 0.4 * (-1.1 / knudsen).exp())
}

/// Rate [1/s] at which a particle's spin dies out in the gas.
///
/// Torque `pi mu d³ omega` on a slowly turning sphere (Kirchhoff 1876) over its inertia `m d²/10`:
/// `60 mu / (rho_p d²)`. Holds for `rho_g omega d²/(4 mu)` below about 10.
pub fn spin_decay_rate(viscosity: f64, density: f64, diameter: f64) -> f64 {
    60.0 * viscosity / (density * diameter * diameter)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tabulated slip factors (Hinds, Aerosol Technology, table A11: standard air, 0.066 µm).
    #[test]
    fn meets_tabulated_slip_factors() {
        for (micrometres, factor) in [(0.01, 22.2), (0.1, 2.85), (1.0, 1.15), (10.0, 1.02)] {
            let ours = slip_factor(0.066e-6, micrometres * 1e-6);
            assert!((ours / factor - 1.0).abs() < 0.03, "{micrometres} µm: {ours}");
        }
        assert_eq!(slip_factor(0.0, 1e-6), 1.0);
    }

    /// Standard drag curve of a sphere (Clift, Grace and Weber 1978, table 5.1), within the law's stated 5 %.
    #[test]
    fn meets_the_standard_drag_curve() {
        for (reynolds, coefficient) in [(0.1, 243.0), (1.0, 27.2), (10.0, 4.26), (100.0, 1.09), (500.0, 0.55)]
        {
            let ours = coefficient_times_reynolds(reynolds) / reynolds;
            assert!((ours / coefficient - 1.0).abs() < 0.05, "Re {reynolds}: {ours}");
        }
    }
}
