//! Numbers from one end to the other, for curves and tables; ends and lines of numbers that are there.

/// `count` numbers from `low` to `high`, both among them, evenly.
pub fn even([low, high]: [f64; 2], count: usize) -> impl Iterator<Item = f64> + Clone {
    (0..count).map(move |place| low + (high - low) * place as f64 / (count - 1).max(1) as f64)
}

/// The same evenly in the logarithm; both ends above zero.
pub fn even_in_logarithm(ends: [f64; 2], count: usize) -> impl Iterator<Item = f64> + Clone {
    even(ends.map(f64::ln), count).map(f64::exp)
}

/// Smallest and largest of some numbers.
pub fn range(numbers: impl Iterator<Item = f64>) -> [f64; 2] {
    numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], next| [low.min(next), high.max(next)])
}

/// The straight line from point to point at `x`; level beyond the first and the last of them.
pub fn through(points: &[[f64; 2]], x: f64) -> f64 {
    let after = points.iter().position(|point| point[0] >= x).unwrap_or(points.len() - 1).max(1);
    let ([a, low], [b, high]) = (points[after - 1], points[after]);
    low + (high - low) * ((x - a) / (b - a)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ends_are_among_them() {
        assert_eq!([0.0, 1.0, 1.5, 9.0].map(|x| through(&[[1.0, 2.0], [2.0, 4.0]], x)), [2.0, 2.0, 3.0, 4.0]);
        assert_eq!(even([1.0, 3.0], 3).collect::<Vec<f64>>(), [1.0, 2.0, 3.0]);
        let decades: Vec<f64> = even_in_logarithm([0.1, 10.0], 3).collect();
        assert!(
            decades.iter().zip([0.1, 1.0, 10.0]).all(|(a, b)| (a / b - 1.0).abs() < 1e-14),
            "{decades:?}"
        );
    }
}
