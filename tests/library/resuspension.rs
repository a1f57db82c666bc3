//! Resuspension beside measured fractions of alumina spheres that remain on steel.

use crate::common::measured_resuspension::{Measured, alumina, measured};

/// Root mean square and mean of computed less measured over points with a friction velocity in a range.
fn difference(points: &[Measured], range: &std::ops::Range<f64>) -> [f64; 2] {
    let errors: Vec<f64> = points
        .iter()
        .filter(|point| range.contains(&point.friction_velocity))
        .map(|point| {
            alumina(point.diameter, point.friction_velocity).fraction_remaining(1.0) - point.remaining
        })
        .collect();
    let mean = |f: fn(&f64) -> f64| errors.iter().map(f).sum::<f64>() / errors.len() as f64;
    [mean(|e| e * e).sqrt(), mean(|e| *e)]
}

/// The bounds are what was found, rounded up; they are no claim of accuracy.
#[test]
fn measured_fractions_of_alumina_on_steel() {
    for (diameter, count, bounds) in [(10, 34, [0.075, 0.12, 0.055]), (20, 39, [0.115, 0.15, 0.035])] {
        let points = measured(diameter);
        assert_eq!(points.len(), count);
        for (range, bound) in [0.0..9.0, 0.0..1.0, 1.0..9.0].into_iter().zip(bounds) {
            let [rms, bias] = difference(&points, &range);
            println!("{diameter} µm, {range:?} m/s: rms difference {rms:.3}, mean {bias:+.3}");
            assert!(rms < bound);
        }
    }
}
