//! Share of a wall that melt wets: droplets spread at random places.
//!
//! `w = 1 - exp(-6 h/d)`, with `h` the thickness of the melt, evenly spread [m], and `d` the
//! diameter of a droplet [m]. Droplets that spread to `s` times their diameter cover `pi s² d²/4`
//! each, so `3 s² h/(2 d)` of the wall, overlaps counted; *assumed* `s = 2` (molten metal and slag
//! are reported between 1.5 and 5, by speed and viscosity), which gives the 6. The arriving
//! particle represents the earlier ones. 45 % of the wall is wet under `h = d/10`.

/// Diameter of a spread droplet over that of the droplet, `s` [1]; assumed.
pub(super) const SPREAD: f64 = 2.0;

/// Wetted share of the wall [1] under melt of a thickness [m], left by particles of a diameter [m].
pub fn share(melt_thickness: f64, diameter: f64) -> f64 {
    -(-1.5 * SPREAD * SPREAD * melt_thickness / diameter).exp_m1()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Discs dropped at random on a grid of points: the share of points that some disc covers.
    #[test]
    fn discs_at_random_wet_the_share() {
        let (diameter, thickness) = (0.02_f64, 0.002_f64);
        // Enough droplets for the thickness on a unit square that closes on itself.
        let number = (thickness / (std::f64::consts::PI / 6.0 * diameter.powi(3))).round();
        let draw = crate::ImpactRng::new(5, 0);
        let centres: Vec<[f64; 2]> =
            (0..number as u64).map(|i| [draw.uniform(2 * i), draw.uniform(2 * i + 1)]).collect();
        let apart = |a: f64, b: f64| {
            let d = (a - b).abs();
            d.min(1.0 - d)
        };
        let points = 60;
        let wet = (0..points * points)
            .map(|i| [f64::from(i / points), f64::from(i % points)].map(|k| (k + 0.5) / f64::from(points)))
            .filter(|p| centres.iter().any(|c| apart(c[0], p[0]).hypot(apart(c[1], p[1])) < diameter))
            .count();
        let found = wet as f64 / f64::from(points * points);
        // Discs cover many points each: three standard errors of some 480 discs.
        assert!((found - share(thickness, diameter)).abs() < 0.04, "{found}");
        assert_eq!(share(0.0, 1e-4), 0.0);
    }
}
