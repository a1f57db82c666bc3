//! Random numbers as a pure function of seed, key and stream number.
//!
//! Philox4x32-10 (Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC
//! 2011): ten rounds scramble a 128-bit counter under a 64-bit key. The generator has no state, so
//! an impact draws the same number on any thread, rank or restart. It is not taken from a crate:
//! its bits are part of the contract of the C library and must not change with a dependency.

use std::f64::consts::TAU;

/// The random numbers of one impact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ImpactRng {
    /// The run's seed.
    pub seed: u64,
    /// Unique key of this impact within the run.
    pub key: u64,
}

impl ImpactRng {
    /// Random numbers for the impact `key` of the run `seed`.
    pub fn new(seed: u64, key: u64) -> Self {
        Self { seed, key }
    }

    /// A number in the open interval (0, 1), uniformly distributed; each `stream` is independent.
    #[inline(always)]
    pub fn uniform(self, stream: u64) -> f64 {
        let [a, b, ..] = self.words(stream);
        unit_number(a, b)
    }

    /// Two independent numbers of the standard normal distribution (Box and Muller 1958).
    pub fn normal(self, stream: u64) -> [f64; 2] {
        let [a, b, c, d] = self.words(stream);
        let (radius, angle) = ((-2.0 * unit_number(a, b).ln()).sqrt(), TAU * unit_number(c, d));
        [radius * angle.cos(), radius * angle.sin()]
    }

    #[inline(always)]
    fn words(self, stream: u64) -> [u64; 4] {
        philox([low(self.key), high(self.key), low(stream), high(stream)], [low(self.seed), high(self.seed)])
    }
}

/// A number in (0, 1) from two words of 32 bits.
#[inline(always)]
fn unit_number(a: u64, b: u64) -> f64 {
    // The upper 53 bits `n` of both words give `(n + 1/2) / 2^53`. Integers are converted
    // through the last bits of 2^84 and 2^52, which vector instructions can do.
    let upper = f64::from_bits(TWO_84.to_bits() | a >> 11) - (TWO_84 + TWO_52);
    let lower = f64::from_bits(TWO_52.to_bits() | (a << 21 & 0xFFFF_FFFF) | b >> 11);
    ((upper + lower) + 0.5) * (1.0 / (1u64 << 53) as f64)
}

/// `2^52`.
const TWO_52: f64 = 4_503_599_627_370_496.0;
/// `2^84`.
const TWO_84: f64 = TWO_52 * 4_294_967_296.0;

#[inline(always)]
fn low(word: u64) -> u64 {
    word & 0xFFFF_FFFF
}

#[inline(always)]
fn high(word: u64) -> u64 {
    word >> 32
}

/// Words of 32 bits are kept in 64, so that vectors never change their width.
#[inline(always)]
fn philox(mut counter: [u64; 4], mut key: [u64; 2]) -> [u64; 4] {
    const MULTIPLIERS: [u64; 2] = [0xD251_1F53, 0xCD9E_8D57];
    const STEPS: [u64; 2] = [0x9E37_79B9, 0xBB67_AE85];
    for _ in 0..10 {
        let first = MULTIPLIERS[0] * counter[0];
        let second = MULTIPLIERS[1] * counter[2];
        counter =
            [high(second) ^ counter[1] ^ key[0], low(second), high(first) ^ counter[3] ^ key[1], low(first)];
        key = [low(key[0] + STEPS[0]), low(key[1] + STEPS[1])];
    }
    counter
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The known answers that the generator's authors publish.
    #[test]
    fn philox_gives_the_published_answers() {
        assert_eq!(philox([0; 4], [0; 2]), [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
        assert_eq!(
            philox([u64::from(u32::MAX); 4], [u64::from(u32::MAX); 2]),
            [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]
        );
    }

    /// As `(n + 1/2) / 2^53` with the conversion that the processor has for one number.
    #[test]
    fn numbers_are_the_upper_bits_of_the_words() {
        for key in 0..100_000 {
            let [a, b, ..] = philox([key, 0, 3, 0], [9, 0]);
            let n = (a << 32 | b) >> 11;
            assert_eq!(ImpactRng::new(9, key).uniform(3), (n as f64 + 0.5) / (1u64 << 53) as f64);
        }
    }

    /// Moments of a million: 0, 1, 0, 3; both numbers of a pair are independent.
    #[test]
    fn normal_numbers_have_the_moments_of_the_distribution() {
        let mut sums = [0.0; 5];
        let count = 500_000;
        for key in 0..count {
            let pair = ImpactRng::new(4, key).normal(7);
            for number in pair {
                (0..4).for_each(|power| sums[power] += number.powi(power as i32 + 1));
            }
            sums[4] += pair[0] * pair[1];
        }
        let means = sums.map(|sum| sum / (2 * count) as f64);
        for (mean, (expected, variance)) in
            means.into_iter().zip([(0.0, 1.0), (1.0, 2.0), (0.0, 15.0), (3.0, 96.0), (0.0, 0.25)])
        {
            let error = f64::sqrt(variance / (2 * count) as f64);
            assert!((mean - expected).abs() < 5.0 * error, "{mean} instead of {expected}");
        }
    }

    #[test]
    fn draws_are_uniform_and_independent_of_order() {
        let count = 100_000_u64;
        let mean = (0..count).map(|key| ImpactRng::new(1, key).uniform(0)).sum::<f64>() / count as f64;
        let error = (1.0 / 12.0 / count as f64).sqrt();
        assert!((mean - 0.5).abs() < 5.0 * error, "mean {mean}");
        assert_eq!(ImpactRng::new(3, 5).uniform(2), ImpactRng::new(3, 5).uniform(2));
        assert_ne!(ImpactRng::new(3, 5).uniform(2), ImpactRng::new(3, 5).uniform(1));
    }
}
