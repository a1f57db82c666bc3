//! Vectors, and the axis of a round wall.

/// The vector from one place to another.
pub(super) fn from_to(from: &[f64; 3], to: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| to[i] - from[i])
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// The direction of a vector; a vector without length stays.
pub(super) fn unit(a: [f64; 3]) -> [f64; 3] {
    let size = length(a);
    if size > 0.0 { a.map(|x| x / size) } else { a }
}

/// A direction as it is given to a reader: along its largest part, and the axis itself where it is nearly one.
pub(super) fn tidy(direction: [f64; 3]) -> [f64; 3] {
    let largest = largest_part(direction);
    let direction = if direction[largest] < 0.0 { direction.map(|x| -x) } else { direction };
    if direction[largest] > 0.99995 { main_axis(largest) } else { direction }
}

/// The unit vector of x, y or z.
pub(super) fn main_axis(which: usize) -> [f64; 3] {
    std::array::from_fn(|i| if i == which { 1.0 } else { 0.0 })
}

/// Which part of a vector is the largest.
pub(super) fn largest_part(a: [f64; 3]) -> usize {
    (0..3).max_by(|i, j| a[*i].abs().total_cmp(&a[*j].abs())).unwrap_or(0)
}

/// The sum of weighted squares of some vectors as a matrix: its eigenvectors are the directions in which they spread.
pub(super) fn second_moment(vectors: impl Iterator<Item = ([f64; 3], f64)>) -> [[f64; 3]; 3] {
    let mut sum = [[0.0; 3]; 3];
    for (vector, weight) in vectors {
        for i in 0..3 {
            for j in 0..3 {
                sum[i][j] += weight * vector[i] * vector[j];
            }
        }
    }
    sum
}

/// Eigenvectors of a symmetric matrix, that of the smallest eigenvalue first (Jacobi's rotations).
pub(super) fn eigenvectors(mut a: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let mut vectors = [main_axis(0), main_axis(1), main_axis(2)];
    for round in 0..60 {
        let [p, q] = [[0, 1], [0, 2], [1, 2]][round % 3];
        if a[p][q] == 0.0 {
            continue;
        }
        let half_turn = 0.5 * (2.0 * a[p][q]).atan2(a[q][q] - a[p][p]);
        let (sin, cos) = half_turn.sin_cos();
        // Rows and columns p and q of the matrix turn by this angle, and the vectors with them.
        for row in &mut a {
            (row[p], row[q]) = (cos * row[p] - sin * row[q], sin * row[p] + cos * row[q]);
        }
        let (old_p, old_q) = (a[p], a[q]);
        a[p] = std::array::from_fn(|i| cos * old_p[i] - sin * old_q[i]);
        a[q] = std::array::from_fn(|i| sin * old_p[i] + cos * old_q[i]);
        let (old_p, old_q) = (vectors[p], vectors[q]);
        vectors[p] = std::array::from_fn(|i| cos * old_p[i] - sin * old_q[i]);
        vectors[q] = std::array::from_fn(|i| sin * old_p[i] + cos * old_q[i]);
    }
    let mut order = [0, 1, 2];
    order.sort_by(|i, j| a[*i][*i].total_cmp(&a[*j][*j]));
    order.map(|i| vectors[i])
}

/// Centre of the circle that fits some points best (Kåsa's least squares); `None` where they lie on a line.
pub(super) fn circle_centre(points: &[[f64; 2]]) -> Option<[f64; 2]> {
    let count = points.len() as f64;
    let mean: [f64; 2] = std::array::from_fn(|i| points.iter().map(|point| point[i]).sum::<f64>() / count);
    let [mut uu, mut uv, mut vv, mut u_square, mut v_square] = [0.0; 5];
    for point in points {
        let [u, v] = [point[0] - mean[0], point[1] - mean[1]];
        let square = u * u + v * v;
        uu += u * u;
        uv += u * v;
        vv += v * v;
        u_square += 0.5 * u * square;
        v_square += 0.5 * v * square;
    }
    let determinant = uu * vv - uv * uv;
    let size = uu + vv;
    (determinant > 1e-9 * size * size).then(|| {
        let [a, b] = [u_square * vv - v_square * uv, v_square * uu - u_square * uv];
        [mean[0] + a / determinant, mean[1] + b / determinant]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvectors_are_in_the_order_of_their_eigenvalues() {
        // Eigenvalues 1, 2, 4 about axes that are turned by 30 degrees about z.
        let (sin, cos) = 30f64.to_radians().sin_cos();
        let axes = [[cos, sin, 0.0], [0.0, 0.0, 1.0], [-sin, cos, 0.0]];
        let matrix = second_moment(axes.into_iter().zip([1.0, 2.0, 4.0]));
        for (found, wanted) in eigenvectors(matrix).into_iter().zip(axes) {
            assert!((dot(found, wanted).abs() - 1.0).abs() < 1e-12, "{found:?} {wanted:?}");
        }
    }

    #[test]
    fn part_of_a_circle_has_its_centre() {
        let points: Vec<[f64; 2]> = (0..9)
            .map(|i| 0.2 * f64::from(i))
            .map(|turn| [3.0 + 2.0 * turn.cos(), -1.0 + 2.0 * turn.sin()])
            .collect();
        let centre = circle_centre(&points).unwrap();
        assert!((centre[0] - 3.0).abs() < 1e-12 && (centre[1] + 1.0).abs() < 1e-12, "{centre:?}");
        assert_eq!(circle_centre(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]), None);
    }
}
