//! The random numbers of the generator: an independent stream for each set, from the run's seed and the set's name.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rand_distr::{Beta, Distribution, StandardNormal};

/// The random stream of one set.
#[derive(Clone)]
pub struct SetRng {
    stream: ChaCha8Rng,
}

impl SetRng {
    /// The stream that belongs to `seed` and `name`, whatever other sets are made.
    pub fn new(seed: u64, name: &str) -> Self {
        let hash = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        let key = name.bytes().fold(seed ^ 0xcbf2_9ce4_8422_2325, hash);
        Self { stream: ChaCha8Rng::seed_from_u64(key) }
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.stream.next_u64() >> 11) as f64 * 2_f64.powi(-53)
    }

    /// Uniform in the range.
    pub fn uniform(&mut self, (low, high): (f64, f64)) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform in the logarithm.
    pub fn log_uniform(&mut self, (low, high): (f64, f64)) -> f64 {
        self.uniform((low.ln(), high.ln())).exp()
    }

    /// Standard normal.
    pub fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.stream)
    }

    /// True with this probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// A whole number below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    /// Normal noise of this deviation that cannot turn `mean` negative: cut on both sides alike, so it has no bias.
    pub fn noise(&mut self, mean: f64, deviation: f64) -> f64 {
        for _ in 0..1000 {
            let noise = deviation * self.normal();
            if noise.abs() < mean {
                return noise;
            }
        }
        0.0
    }

    /// Of `count` impacts, those with an outcome of this mean probability; `correlation` of two outcomes of one class.
    pub fn beta_binomial(&mut self, count: u32, mean: f64, correlation: f64) -> u32 {
        let size = (1.0 - correlation) / correlation;
        let certain = mean <= 0.0 || mean >= 1.0;
        let share = if certain || correlation <= 0.0 {
            mean
        } else {
            Beta::new(mean * size, (1.0 - mean) * size).unwrap().sample(&mut self.stream)
        };
        (0..count).filter(|_| self.chance(share)).count() as u32
    }
}
