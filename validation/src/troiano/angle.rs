//! Figs 6 and 7: restitution against the impact angle.

use nearwall::normal::Contact;
use nearwall::report::Chart;
use nearwall::{Impact, Model, Outcome, global_restitution};

use super::published::{
    E_N_GLANCING, E_N_NEAR_NORMAL, E_T_GLANCING, E_T_LEAST, E_T_STEEP, FIT_E_N, FIT_E_T, FRICTION,
    SLIDING_END, SLIDING_END_ANGLE, STEEP,
};
use super::{Answer, arriving, contact, decide, even, model, passes, thornton_ning};
use crate::oracle::carried::{Air, terminal_speed};
use crate::{Basis, Claim, Part, Published};

/// Where e_n was 0.41.
const GLANCING: f64 = 35.0;

/// The air's speed in the tube that makes `v_n = 1 m/s` at an angle [degrees]: what is left of 1/sin(angle) after the
/// terminal velocity [m/s].
fn tube_air(angle: f64) -> f64 {
    1.0 / angle.to_radians().sin() - terminal_speed(super::published::DIAMETER, &Air::at(293.15))
}

fn at(model: &Model, angle: f64, gas_speed: f64) -> Answer<Outcome> {
    let impact = Impact { gas_speed, ..arriving(1.0, angle) };
    decide(model, "default", &impact)
}

/// Both parts on the angle.
pub(super) fn parts() -> Answer<[Part; 2]> {
    Ok([restitutions()?, best_fit()?])
}

fn restitutions() -> Answer<Part> {
    let plain = model!("wax-on-pyrex.toml")?;
    let refined = model!("angle.toml")?;
    let pyrex = |c: f64| -> Answer<Contact> { contact(&plain, "default", c, |_| {}) };
    let base = at(&plain, STEEP, 0.0)?.normal_restitution;
    let stated = pyrex(0.7)?;
    let ratio = passes(
        |c| thornton_ning(&Contact { yield_ratio: c, ..stated }, super::published::DIAMETER, 1.0),
        0.28,
        [0.3, 1.0],
    );
    let four = 4.0 * tube_air(90.0);
    let lifted = |angle: f64, gas: f64| at(&refined, angle, gas);
    let gain = 0.41 / 0.28 - 1.0;
    let cosine = GLANCING.to_radians().cos();
    let by_tube = gain / (cosine * tube_air(GLANCING));
    let by_four = gain / (cosine * four);
    let at_13 = lifted(13.0, four)?;
    let with_tube_13 =
        0.28 * (1.0 + gain / cosine / tube_air(GLANCING) * tube_air(13.0) * 13f64.to_radians().cos());
    let angles = even([5.0, 89.5], 340);
    let curve = |of: &dyn Fn(f64) -> Answer<f64>| -> Answer<Vec<[f64; 2]>> {
        angles.iter().map(|angle| Ok([*angle, of(*angle)?])).collect()
    };
    let least = |model: &Model| -> Answer<f64> {
        let line = curve(&|angle| Ok(at(model, angle, 0.0)?.tangential_restitution))?;
        Ok(line.iter().min_by(|a, b| a[1].total_cmp(&b[1])).map_or(f64::NAN, |point| point[0]))
    };
    let sliding_at_13 = at(&plain, 13.0, 0.0)?;
    let intercept = 0.8 + FRICTION.value * 1.41 * 13f64.to_radians().tan();
    let e_n_figure = Chart::new("Normal restitution over the angle", "angle from the surface [°]", "e_n [1]")
        .x_range(0.0, 90.0)
        .y_range(0.0, 0.8)
        .line("T–N, c = 0.7", &curve(&|angle| Ok(at(&plain, angle, 0.0)?.normal_restitution))?)
        .line("with lift, air 4 times at all", &curve(&|angle| Ok(lifted(angle, four)?.normal_restitution))?)
        .line(
            "with lift, air as the tube's",
            &curve(&|angle| {
                let gas = tube_air(angle) * by_tube / by_four;
                Ok(lifted(angle, gas)?.normal_restitution)
            })?,
        )
        .reference("stated", &[[GLANCING, 0.41], [STEEP, 0.28]]);
    let e_t_figure =
        Chart::new("Tangential restitution over the angle", "angle from the surface [°]", "e_t [1]")
            .x_range(0.0, 90.0)
            .y_range(0.4, 1.0)
            .line(
                "sliding, then rolling",
                &curve(&|angle| Ok(at(&plain, angle, 0.0)?.tangential_restitution))?,
            )
            .line(
                "with tangential compliance",
                &curve(&|angle| Ok(lifted(angle, four)?.tangential_restitution))?,
            )
            .reference("stated", &[[13.0, 0.8], [45.0, 1.0 - 0.28 * 1.31], [80.0, 0.85]]);
    Ok(Part {
        heading: "Figs 6 and 7: the angle".to_owned(),
        text: vec![
            format!(
                "Plain laws: e_n depends on v_n alone, which Fig. 6 keeps at 1 m/s, so it is {base:.3} at \
                 every angle; e_t slides down to 0.63 and jumps to 5/7. The paper names what is missing: air \
                 that lifts particles at glancing angles, and tangential compliance. Both are effects here. \
                 Each has one number set to one of the paper's (e_n at 35°, e_t at 80°), and c is lowered so \
                 that e_n is 0.28 near the normal at 1 m/s ({ratio:.2} without lift).",
            ),
            format!(
                "What lift would have to be: e_n a factor {:.2} at 35°, that is strength {by_four:.2} s/m if \
                 the air was four times as fast as the {:.2} m/s of normal impacts. But at v_n = 1 m/s the \
                 impact speed at 35° is only 1.74 times that of a normal impact; four times belongs to \
                 14.5°. With the air that 35° needs the strength is {by_tube:.2} s/m, and e_n at 13° would \
                 be {with_tube_13:.2}. The paper has no e_n above 0.41. Its explanation and its data agree \
                 only if lift saturates, or if the cause at 35° is another.",
                1.0 + gain,
                tube_air(90.0)
            ),
            format!(
                "The paper's numbers for e_t do not agree among themselves: the line e_t = 1 - 0.28 (1+e_n) \
                 tan(alpha) gives {:.2} at 13°, Fig. 6 says 0.8. Sliding holds this whatever the spin, so \
                 rotation does not explain it; it would take f = {:.2}. A line of the same slope that is not \
                 forced through e_t = 1 would meet 0.8 with an intercept of {intercept:.2}, and then falls \
                 to {:.2} at 1.31; the paper does not say which line it drew.",
                sliding_at_13.tangential_restitution,
                0.2 / (1.41 * 13f64.to_radians().tan()),
                intercept - FRICTION.value * 1.31
            ),
        ],
        figures: vec![
            e_n_figure.figure(
                "troiano-angle-normal",
                "v_n = 1 m/s, wax of 75 µm on Pyrex. Lift that grows with the air along the wall overshoots \
                 below 35°.",
            ),
            e_t_figure.figure(
                "troiano-angle-tangential",
                "The point at 45° is the end of the stated sliding line (1.31); compliance is set to the one \
                 at 80°.",
            ),
        ],
        claims: angle_claims(
            &plain,
            &refined,
            four,
            [ratio, with_tube_13, at_13.normal_restitution],
            least(&plain)?,
        )?,
        ..Part::default()
    })
}

fn angle_claims(
    plain: &Model,
    refined: &Model,
    four: f64,
    [ratio, tube_at_13, four_at_13]: [f64; 3],
    least: f64,
) -> Answer<Vec<Claim>> {
    let end = at(plain, 41.0, 0.0)?;
    let slope =
        (1.0 - end.tangential_restitution) / ((1.0 + end.normal_restitution) * 41f64.to_radians().tan());
    let implied = 1.31 / 45f64.to_radians().tan() - 1.0;
    Ok(vec![
        E_N_NEAR_NORMAL.beside(at(plain, STEEP, 0.0)?.normal_restitution, Basis::Predicted).because(
            &format!(
                "With c = 0.7, which the paper fitted to Fig. 8. Fig. 6 alone asks for c = {ratio:.2}. The \
             deviation is within what sigma_y = 9.5 ± 2.5 MPa leaves open (part on speed)."
            ),
        ),
        E_N_NEAR_NORMAL
            .beside(at(refined, STEEP, four / 4.0)?.normal_restitution, Basis::Fitted)
            .because("c set to it, 0.58; lift adds 1.5 % at 84°."),
        E_N_GLANCING
            .beside(at(plain, GLANCING, 0.0)?.normal_restitution, Basis::Predicted)
            .because("The plain law knows no angle."),
        E_N_GLANCING
            .beside(at(refined, GLANCING, four)?.normal_restitution, Basis::Fitted)
            .because("Lift set to it."),
        Claim::number(
            "Fig 6",
            "e_n at 13° by the lift that fits 35°; \"the largest value\" was 0.41",
            Published::Below(0.42),
            tube_at_13,
            Basis::Predicted,
        )
        .because(&format!(
            "Air as fast as each angle needs. With four times the air of normal impacts at 35° and 13° alike \
             it is {four_at_13:.2}. A gain that is proportional to the air along the wall cannot stop at \
             35°."
        )),
        Claim::statement(
            "Sec 4.1",
            "air at small angles over air at normal impact, v_n = 1 m/s [1]",
            "around 4",
            &format!(
                "{:.1} at 35°, {:.1} at 13°",
                tube_air(35.0) / tube_air(90.0),
                tube_air(13.0) / tube_air(90.0)
            ),
            (3.5..4.5).contains(&(tube_air(35.0) / tube_air(90.0))),
            Basis::Derived,
        )
        .because(
            "Follows from v_i = 1/sin(alpha) less terminal velocity; 4 is right near 16°, not at 35°, where \
         e_n was 0.41.",
        ),
        FRICTION
            .beside(slope, Basis::Fitted)
            .because("The law's own parameter; checks only that 10° to 45° is sliding."),
        E_T_GLANCING.beside(at(plain, 13.0, 0.0)?.tangential_restitution, Basis::Predicted).because(
            "The paper contradicts itself here: its own f = 0.28 in its own Eq. 10 gives 0.91 (e_n 0.41) to \
             0.92 (0.28).",
        ),
        E_T_LEAST
            .beside(least, Basis::Predicted)
            .because("Where sliding ends. ± 5°, for it is read off points that lie some 5° to 10° apart."),
        SLIDING_END
            .beside((1.0 + end.normal_restitution) * least.to_radians().tan(), Basis::Predicted)
            .because(
                "For finite k the law ends at 2/(7 - 1/k)/f = 1.29 at any e_n; 1.31 is 43.3° for e_n = \
             0.39.",
            ),
        Claim::statement(
            "Fig 7",
            "\"1.31, corresponding to 45°\": the e_n that this takes",
            "Fig. 6: 0.41 at 35°, 0.28 near normal",
            &format!("{implied:.2}"),
            (0.28..=0.41).contains(&implied),
            Basis::Derived,
        )
        .because(
            "It is the best-fit mean of all angles, not a value between 0.41 at 35° and 0.28 (some 0.38 at \
             45°), for which 1.31 lies at 43.5°. Within the scatter the two cannot be told apart.",
        ),
        SLIDING_END_ANGLE
            .beside(least, Basis::Predicted)
            .because("e_n of the plain law, 0.32; 42.9° with e_n = 0.39, see Eq. 11."),
        E_T_STEEP
            .beside(at(plain, 80.0, 0.0)?.tangential_restitution, Basis::Predicted)
            .because("Rigid rolling gives 5/7, as the paper says; compliance is what it leaves out."),
        E_T_STEEP
            .beside(at(refined, 80.0, four / 4.0)?.tangential_restitution, Basis::Fitted)
            .because("The exponent of tangential-compliance is set to it, with e_t = 1 assumed head-on."),
    ])
}

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

/// Straight lines through points.
fn through(points: &[[f64; 2]], x: f64) -> f64 {
    let after = points.iter().position(|point| point[0] >= x).unwrap_or(points.len() - 1).max(1);
    let ([a, low], [b, high]) = (points[after - 1], points[after]);
    low + (high - low) * ((x - a) / (b - a)).clamp(0.0, 1.0)
}

fn best_fit() -> Answer<Part> {
    let e_n = |angle: f64| through(&[[0.0, 0.41], [35.0, 0.41], [84.0, 0.28], [90.0, 0.28]], angle);
    let stated = [[0.0, 0.8], [13.0, 0.8], [43.0, 0.633], [80.0, 0.85], [90.0, 0.85]];
    let line = |angle: f64| {
        let slid = 1.0 - FRICTION.value * (1.0 + e_n(angle)) * angle.to_radians().tan();
        if angle <= 43.0 { slid } else { through(&[[43.0, 0.633], [80.0, 0.85], [90.0, 0.85]], angle) }
    };
    let e_g = |angle: f64, e_t: f64| global_restitution(e_n(angle), e_t, angle.to_radians());
    let fits = |of: &dyn Fn(f64) -> f64, count: usize| {
        let points: Vec<[f64; 2]> =
            even([10.0, 90.0], count).into_iter().map(|angle| [angle, e_g(angle, of(angle))]).collect();
        fit(&points)
    };
    let points = fits(&|angle| through(&stated, angle), 17);
    let coarse = fits(&|angle| through(&stated, angle), 9);
    let slid = fits(&line, 17);
    let curve = |of: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
        even([5.0, 90.0], 171).into_iter().map(|angle| [angle, of(angle)]).collect()
    };
    let paper = |angle: f64| global_restitution(FIT_E_N.value, FIT_E_T.value, angle.to_radians());
    let offset = even([10.0, 90.0], 161)
        .into_iter()
        .map(|angle| (paper(angle) - e_g(angle, through(&stated, angle))).abs())
        .fold(0.0, f64::max);
    Ok(Part {
        heading: "Fig 6: Eq. 9 with constant e_n and e_t".to_owned(),
        text: vec![format!(
            "The paper fits e_g over all angles with two constants. Its points are in a figure only; here \
             e_n and e_t are drawn straight through the values that the text states (0.41 up to 35°, falling \
             to 0.28 at 84°; 0.8 up to 13°, 0.633 at 43°, 0.85 from 80° on) and Eq. 9 is fitted to the e_g \
             that follow, every 5° from 10° to 90°. Through the stated points: {:.3} and {:.3}; every 10°: \
             {:.3} and {:.3}. With the sliding line up to 43° in place of 0.8 at 13°: {:.3} and {:.3}. The \
             paper's pair fits the stated points, not the line of its Fig. 7, and never misses their e_g by \
             more than {offset:.2}.",
            points[0], points[1], coarse[0], coarse[1], slid[0], slid[1]
        )],
        figures: vec![
            Chart::new("Global restitution over the angle", "angle from the surface [°]", "e_g [1]")
                .x_range(0.0, 90.0)
                .y_range(0.2, 1.0)
                .line("Eq. 9 with 0.31 and 0.76", &curve(&paper))
                .line("through the stated points", &curve(&|angle| e_g(angle, through(&stated, angle))))
                .line("with the sliding line", &curve(&|angle| e_g(angle, line(angle))))
                .figure("troiano-angle-global", "What the stated numbers make of e_g, and the paper's fit."),
        ],
        claims: vec![
            FIT_E_N.beside(points[0], Basis::Predicted).because(
                "From stated values at five angles in place of the figure's points; where those lie, and how \
                 they are weighted, moves the result by 0.01 to 0.02.",
            ),
            FIT_E_T.beside(points[1], Basis::Predicted).because(
                "As above. With the line f = 0.28 it would be 0.82: the fit confirms 0.8 at 13° against Fig. \
                 7's line.",
            ),
        ],
        ..Part::default()
    })
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
