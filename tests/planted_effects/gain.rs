//! The information of the data: log-likelihood of the truth against the base and against a refitted base.

use crate::campaign::{Campaign, Row};
use crate::contact::Tangential;
use crate::world::{Inputs, Response, World};

/// Share of the rows that a fit may see.
const FITTED: f64 = 0.75;
/// Bound of predicted probabilities.
const FLOOR: f64 = 0.01;
/// Hidden draws a row over which a scattering truth is averaged.
const GRID: usize = 24;

/// Nats by which the truth beats the base as given, and the best base with another yield ratio, work of adhesion
/// and level of e_t.
#[derive(Clone, Copy, Debug)]
pub struct Gain {
    pub over_base: f64,
    pub over_refitted: f64,
    /// Gain of the least important plant [nats].
    pub least_plant: f64,
}

/// Of the rows that a fit may see.
pub fn gain(campaign: &Campaign, world: &World, rows: &[Row]) -> Gain {
    let truth = likelihood_of_truth(campaign, world, rows);
    let base = likelihood_of_model(rows, |x| world.base(x));
    let best = base.max(best_refitted(world, rows)) + level_gain(world, rows);
    let without = |index| likelihood_of_truth(campaign, &world.without(index), rows);
    let least = (0..world.plants.len()).map(|index| truth - without(index)).fold(f64::INFINITY, f64::min);
    Gain {
        over_base: FITTED * (truth - base),
        over_refitted: FITTED * (truth - best),
        least_plant: FITTED * least,
    }
}

/// The best of the base laws with another yield ratio and work of adhesion; the one that is planted is not free.
fn best_refitted(world: &World, rows: &[Row]) -> f64 {
    let planted = |cause| world.plants.iter().any(|plant| plant.cause == cause);
    let ratios = if planted("yield-ratio") { 0..=0 } else { -12..=12 };
    let works = if planted("adhesion-energy") { 0..=0 } else { -6..=4 };
    let grid = ratios.flat_map(|ratio| works.clone().map(move |work| (ratio, work)));
    let likelihood = |(ratio, work): (i32, i32)| {
        let mut contact = world.contact;
        contact.yield_ratio *= 1.15_f64.powi(ratio);
        contact.adhesion *= 1.4_f64.powi(work);
        let other = World { contact, tangential: world.tangential, plants: vec![] };
        likelihood_of_model(rows, |x| other.base(x))
    };
    grid.map(likelihood).fold(f64::NEG_INFINITY, f64::max)
}

/// What a free constant e_t adds to a base of constant e_t.
fn level_gain(world: &World, rows: &[Row]) -> f64 {
    let Tangential::Constant(level) = world.tangential else { return 0.0 };
    let off: Vec<f64> = rows.iter().filter_map(|row| row.e_t).map(|e_t| e_t - level).collect();
    let count = off.len().max(1) as f64;
    let (mean, square) = (off.iter().sum::<f64>() / count, off.iter().map(|o| o * o).sum::<f64>() / count);
    count / 2.0 * (square / (square - mean * mean)).ln()
}

/// Of the truth, averaged over its hidden draws.
fn likelihood_of_truth(campaign: &Campaign, world: &World, rows: &[Row]) -> f64 {
    let grid = if world.scatters() { GRID } else { 1 };
    let share = |i: usize| (i as f64 + 0.5) / grid as f64;
    let one = |row: &Row| {
        let draws = (0..grid * grid).map(|i| [share(i / grid), share(i % grid)]);
        let sum: f64 = draws.map(|draws| probability(campaign, row, world.truth(&row.x, draws))).sum();
        (sum / (grid * grid) as f64).max(1e-12).ln()
    };
    rows.iter().map(one).sum()
}

/// Probability (density) of what was seen, given the response.
fn probability(campaign: &Campaign, row: &Row, r: Response) -> f64 {
    let density = |seen: Option<f64>, mean: f64, deviation: f64| match seen {
        Some(seen) => gauss(seen - mean, deviation),
        None => 1.0,
    };
    let stick = r.stick.clamp(FLOOR, 1.0 - FLOOR);
    if row.stuck {
        return stick;
    }
    (1.0 - stick) * density(row.e_n, r.e_n, campaign.noise_e_n) * density(row.e_t, r.e_t, campaign.noise_e_t)
}

fn gauss(off: f64, deviation: f64) -> f64 {
    (-(off / deviation).powi(2) / 2.0).exp() / deviation / std::f64::consts::TAU.sqrt()
}

/// Of a model without hidden draws, its deviations the ones that fit best.
fn likelihood_of_model(rows: &[Row], model: impl Fn(&Inputs) -> Response) -> f64 {
    let [mut outcome, mut off_n, mut off_t] = [0.0, 0.0, 0.0];
    let [mut count_n, mut count_t] = [0.0, 0.0];
    for row in rows {
        let r = model(&row.x);
        let stick = r.stick.clamp(FLOOR, 1.0 - FLOOR);
        outcome += if row.stuck { stick } else { 1.0 - stick }.ln();
        for (seen, mean, off, count) in
            [(row.e_n, r.e_n, &mut off_n, &mut count_n), (row.e_t, r.e_t, &mut off_t, &mut count_t)]
        {
            if let Some(seen) = seen {
                *off += (seen - mean).powi(2);
                *count += 1.0;
            }
        }
    }
    outcome + profile(off_n, count_n) + profile(off_t, count_t)
}

/// Gaussian log-likelihood at the best deviation.
fn profile(squares: f64, count: f64) -> f64 {
    if count == 0.0 { 0.0 } else { -count / 2.0 * ((std::f64::consts::TAU * squares / count).ln() + 1.0) }
}
