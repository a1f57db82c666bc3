//! Scatter to one side: the readings of `e_n` and `e_t` are wider below the prediction than above it.
//!
//! The density of a residual `r` is that of two halves of normal distributions with widths `s_1`
//! below and `s_2 < s_1` above, of equal height at 0 (split normal distribution), beside the share
//! of gross errors. It competes with effects that lower some rebounds.

use super::data_split::DataSplit;
use super::ground::Ground;
use super::hypothesis::Hypothesis;
use super::likelihood::{GROSS_DENSITY, GROSS_SHARE, SMALLEST_SCATTER};
use super::observable::Observable;

/// Steps of each width, and the factor between them.
const WIDTHS: i32 = 20;
const WIDTH_STEP: f64 = 1.3;
/// Narrowest width, as a share of the scatter.
const NARROWEST: f64 = 0.03;

/// The ground with scatter to one side about the base model; nothing can be added beside it.
pub(super) fn skewed(data: &DataSplit) -> Ground {
    let base = Hypothesis::base(data);
    let rows = base.evaluate(&*data.search, base.offsets()).with_fitted_scatter();
    let mut slope = vec![0.0; data.search.len()];
    for observable in [Observable::NormalRestitution, Observable::TangentialRestitution] {
        let residual = |[measured, predicted]: [f64; 2]| measured - predicted;
        let residuals: Vec<Option<f64>> = rows.pairs(observable).map(|pair| pair.map(residual)).collect();
        let scatter = rows.scatter[observable as usize].max(SMALLEST_SCATTER);
        // Of rounded readings nothing is seen within a step.
        let steps = data.noise.iter().map(|offset| offset.step[observable as usize]);
        let narrowest = (NARROWEST * scatter).max(0.5 * steps.fold(0.0, f64::max));
        let even = best(&residuals, narrowest, (0..WIDTHS).map(|step| [step; 2]));
        let below =
            best(&residuals, narrowest, (0..WIDTHS).flat_map(|one| (0..one).map(move |two| [one, two])));
        let gain = below.iter().zip(&even).map(|(below, even)| below - even);
        slope.iter_mut().zip(gain).for_each(|(sum, gain)| *sum += gain);
    }
    let question = "These numbers fit if the scatter were one-sided, downwards only: does the model give the upper \
                    bound of the rebounds, or do some impacts lose energy in another way?";
    Ground {
        key: "artefact:skewed-scatter".to_owned(),
        question: Some(question.to_owned()),
        slope,
        freedom: 1.0,
        open: false,
        ..Ground::plain(data)
    }
}

/// Log likelihood of each residual with the widths that fit best [nats]; `steps` from the narrowest, below and above.
fn best(residuals: &[Option<f64>], narrowest: f64, steps: impl Iterator<Item = [i32; 2]>) -> Vec<f64> {
    let width = |step: i32| narrowest * WIDTH_STEP.powi(step);
    let of = |steps: [i32; 2]| -> Vec<f64> {
        residuals.iter().map(|one| one.map_or(0.0, |one| log_density(one, steps.map(width)))).collect()
    };
    let sum = |all: &Vec<f64>| all.iter().sum::<f64>();
    steps.map(of).max_by(|a, b| sum(a).total_cmp(&sum(b))).unwrap_or_default()
}

/// Log density of a residual about 0 with one width below and another above [nats].
fn log_density(residual: f64, [below, above]: [f64; 2]) -> f64 {
    let height = 2.0 / ((below + above) * std::f64::consts::TAU.sqrt());
    let z = residual / if residual < 0.0 { below } else { above };
    ((1.0 - GROSS_SHARE) * height * (-0.5 * z * z).exp() + GROSS_SHARE * GROSS_DENSITY).ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each half of the density has its share of the whole: `s_1/(s_1 + s_2)` below.
    #[test]
    fn the_density_is_one_in_all() {
        let step = 1e-4;
        let sum = |from: i32, to: i32| {
            let at = |place: i32| (log_density((f64::from(place) + 0.5) * step, [0.2, 0.1])).exp() * step;
            (from..to).map(at).sum::<f64>()
        };
        let gross = GROSS_SHARE * GROSS_DENSITY;
        let [below, above] = [sum(-20_000, 0) - 2.0 * gross, sum(0, 20_000) - 2.0 * gross];
        assert!((below - (1.0 - GROSS_SHARE) * 2.0 / 3.0).abs() < 1e-4, "{below}");
        assert!((above - (1.0 - GROSS_SHARE) / 3.0).abs() < 1e-4, "{above}");
    }
}
