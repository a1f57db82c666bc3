//! Starts of particles that are spread evenly over their distributions, for expectations.
//!
//! The states of particles that are drawn at random miss an expectation by their scatter over the
//! root of their number. Here they are the quantiles of an Owen-scrambled Sobol sequence (Owen,
//! "Scrambled net variance for integrals of smooth functions", Annals of Statistics 25, 1997): each
//! particle is still a fair draw, but together they leave no gaps, and a mean over them is off by
//! far less. They come in blocks, each scrambled anew, so that the scatter of the blocks' means
//! tells the error that is left.

use super::case::Case;
use super::distribution::Distribution;
use super::injection::StartNumbers;
use super::tracker::Start;

/// Number of blocks.
pub const BLOCKS: usize = 16;

/// A point of the sequence, of which each use takes the next coordinate.
struct SobolPoint {
    index: u32,
    scramble: u32,
    used: u32,
}

impl StartNumbers for SobolPoint {
    fn share(&mut self) -> f64 {
        let coordinate = sobol_burley::sample(self.index, self.used, self.scramble);
        self.used += 1;
        // In the middle of the last bit, so that it is neither 0 nor 1.
        f64::from(coordinate) + 0.5 / f64::from(1u32 << 24)
    }

    fn of(&mut self, distribution: &Distribution) -> f64 {
        distribution.quantile(self.share())
    }
}

/// About this number of particles, the same share of each injection as the case has, block by
/// block; at least one of each in each block.
pub fn even_starts(case: &Case, particles: u64) -> Vec<Vec<Start>> {
    let all = case.count().max(1) as f64;
    let mut numbers = 0..;
    let mut block = |block: u64| {
        let mut starts = Vec::new();
        for (place, injection) in case.injections.iter().enumerate() {
            let share = particles as f64 / BLOCKS as f64 * injection.count as f64 / all;
            for index in 0..share.round().max(1.0) as u32 {
                // Every block of every injection of every seed has a scrambling of its own.
                let scramble = (case.seed as u32)
                    .wrapping_mul(0x9E37_79B9)
                    .wrapping_add((block as u32) << 8)
                    .wrapping_add(place as u32);
                let (diameter, state) = injection.start(&mut SobolPoint { index, scramble, used: 0 });
                let number = numbers.next().unwrap_or_default();
                starts.push(Start { number, injection: place, diameter, state });
            }
        }
        starts
    };
    (0..BLOCKS as u64).map(&mut block).collect()
}
