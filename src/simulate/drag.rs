//! Drag on a sphere (Schiller and Naumann 1933).
//!
//! `C_D Re = 24 (1 + 0.15 Re^0.687)` up to `Re = 1000`, `0.44 Re` above, with `Re = rho_g |u - v| d / mu`. The sphere is
//! rigid, smooth and far from walls and from other particles; slip (Cunningham), lift, added mass and history forces
//! are left out, which holds for `rho_p >> rho_g` and particles well above the gas's mean free path.

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
