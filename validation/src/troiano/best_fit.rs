//! Fig 6: Eq. 9 with constant e_n and e_t, fitted to what the stated values make of e_g.

use nearwall::global_restitution;
use nearwall_lab::report::{Chart, Figure};

use super::angle::{sliding, stated_e_n};
use super::published::{
    CRITICAL_ANGLE, E_N_GLANCING, E_N_NEAR_NORMAL, E_T_GLANCING, E_T_STEEP, FIT_E_N, FIT_E_T, GLANCING,
    NEARLY_STEEP, SHALLOW, SLIDING_END, STEEP, WAX_FRICTION,
};
use crate::steps::{even, through};
use crate::{ClaimBasis, StudyPart};

/// Angles [degrees] that are fitted.
const FITTED_ANGLES: [f64; 2] = [10.0, 90.0];

/// Least squares of Eq. 9 with constant `e_n` and `e_t` on points (angle [degrees], e_g): Gauss and Newton's method.
fn fit(points: &[[f64; 2]]) -> [f64; 2] {
    let (mut e_n, mut e_t) = (0.3, 0.7);
    for _ in 0..50 {
        let (mut matrix, mut right) = ([0.0; 3], [0.0; 2]);
        for [angle, e_g] in points {
            let (sine, cosine) = angle.to_radians().sin_cos();
            let ours = global_restitution(e_n, e_t, angle.to_radians());
            let slope = [e_n * sine * sine / ours, e_t * cosine * cosine / ours];
            matrix[0] += slope[0] * slope[0];
            matrix[1] += slope[0] * slope[1];
            matrix[2] += slope[1] * slope[1];
            right[0] += slope[0] * (e_g - ours);
            right[1] += slope[1] * (e_g - ours);
        }
        let determinant = matrix[0] * matrix[2] - matrix[1] * matrix[1];
        e_n += (matrix[2] * right[0] - matrix[1] * right[1]) / determinant;
        e_t += (matrix[0] * right[1] - matrix[1] * right[0]) / determinant;
    }
    [e_n, e_t]
}

/// `e_t` where the stated sliding line ends.
fn end_of_sliding() -> f64 {
    1.0 - WAX_FRICTION.value * SLIDING_END.value
}

/// `e_t` drawn straight through the stated values; angle in degrees.
fn stated_e_t(angle: f64) -> f64 {
    let points = [
        [SHALLOW, E_T_GLANCING.value],
        [CRITICAL_ANGLE.value, end_of_sliding()],
        [NEARLY_STEEP, E_T_STEEP.value],
    ];
    through(&points, angle)
}

/// The same with the sliding line of Fig. 7 as far as it goes.
fn slid_e_t(angle: f64) -> f64 {
    if angle <= CRITICAL_ANGLE.value { sliding(stated_e_n(angle), angle) } else { stated_e_t(angle) }
}

/// `e_g` with the stated `e_n` and an `e_t` over the angle [degrees].
fn e_g(e_t: fn(f64) -> f64, angle: f64) -> f64 {
    global_restitution(stated_e_n(angle), e_t(angle), angle.to_radians())
}

/// `e_g` of the paper's fit.
fn paper(angle: f64) -> f64 {
    global_restitution(FIT_E_N.value, FIT_E_T.value, angle.to_radians())
}

/// Constant `e_n` and `e_t` that fit best at angles so many degrees apart.
fn fitted(e_t: fn(f64) -> f64, apart: f64) -> [f64; 2] {
    let count = 1 + ((FITTED_ANGLES[1] - FITTED_ANGLES[0]) / apart) as usize;
    fit(&even(FITTED_ANGLES, count).map(|angle| [angle, e_g(e_t, angle)]).collect::<Vec<_>>())
}

/// The part on the fit.
pub(super) fn part() -> StudyPart {
    let points = fitted(stated_e_t, 5.0);
    let slid = fitted(slid_e_t, 5.0);
    StudyPart {
        heading: "Fig 6: Eq. 9 with constant e_n and e_t".to_owned(),
        text: vec![text(points, slid)],
        figures: vec![chart()],
        claims: vec![
            FIT_E_N.beside(points[0], ClaimBasis::Predicted).because(&format!(
                "From stated values at five angles instead of the figure's points. Sensitivity to the \
                 points: every 10° in place of 5° by {:.3}, the sliding line by {:.3}.",
                (fitted(stated_e_t, 10.0)[0] - points[0]).abs(),
                (slid[0] - points[0]).abs()
            )),
            FIT_E_T.beside(points[1], ClaimBasis::Predicted).because(&format!(
                "As above; with the line f = {} it would be {:.2}: the paper's fit agrees with {} at \
                 {SHALLOW}°, not with Fig. 7's line.",
                WAX_FRICTION.value, slid[1], E_T_GLANCING.value
            )),
        ],
        ..StudyPart::default()
    }
}

/// From the fits through the stated points and with the sliding line.
fn text(points: [f64; 2], slid: [f64; 2]) -> String {
    let coarse = fitted(stated_e_t, 10.0);
    let offset = even(FITTED_ANGLES, 161)
        .map(|angle| (paper(angle) - e_g(stated_e_t, angle)).abs())
        .fold(0.0, f64::max);
    let [low, high] = FITTED_ANGLES;
    format!(
        "The paper fits e_g over all angles with two constants. Its points are in a figure only; here e_n \
         and e_t are drawn straight through the values that the text states ({} up to {GLANCING}°, falling \
         to {} at {STEEP}°; {e_t} up to {SHALLOW}°, {:.3} at {end}°, {} from {NEARLY_STEEP}° on) and Eq. 9 \
         is fitted to the e_g that follow, every 5° from {low}° to {high}°. Through the stated points: \
         {:.3} and {:.3}; every 10°: {:.3} and {:.3}. With the sliding line up to {end}° in place of {e_t} \
         at {SHALLOW}°: {:.3} and {:.3}. The paper's pair fits the stated points, not the line of its Fig. \
         7, and never misses their e_g by more than {offset:.2}.",
        E_N_GLANCING.value,
        E_N_NEAR_NORMAL.value,
        end_of_sliding(),
        E_T_STEEP.value,
        points[0],
        points[1],
        coarse[0],
        coarse[1],
        slid[0],
        slid[1],
        e_t = E_T_GLANCING.value,
        end = CRITICAL_ANGLE.value
    )
}

fn chart() -> Figure {
    let curve = |of: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
        even([5.0, 90.0], 171).map(|angle| [angle, of(angle)]).collect()
    };
    Chart::new("Global restitution over the angle", "angle from the surface [°]", "e_g [1]")
        .x_range(0.0, 90.0)
        .y_range(0.2, 1.0)
        .line("Eq. 9 with 0.31 and 0.76", &curve(&paper))
        .line("through the stated points", &curve(&|angle| e_g(stated_e_t, angle)))
        .line("with the sliding line", &curve(&|angle| e_g(slid_e_t, angle)))
        .figure("troiano-angle-global", "What the stated numbers make of e_g, and the paper's fit.")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fit_finds_what_was_put_in() {
        let points: Vec<[f64; 2]> = (2..18)
            .map(|i| 5.0 * f64::from(i))
            .map(|a| [a, global_restitution(0.31, 0.76, a.to_radians())])
            .collect();
        let [e_n, e_t] = fit(&points);
        assert!((e_n - 0.31).abs() < 1e-12 && (e_t - 0.76).abs() < 1e-12);
    }
}
