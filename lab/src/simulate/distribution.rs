//! Distributions that particle states are drawn from.
//!
//! `key = 80e-6` is a fixed number; `key = { distribution = "normal", mean = 80e-6, deviation = 15e-6, min = 50e-6,
//! max = 110e-6 }` is drawn. `min` and `max` truncate: what falls outside is drawn again, so the shape inside is kept.
//!
//! | `distribution` | keys | density or distribution function |
//! |---|---|---|
//! | `fixed` | `value` | |
//! | `uniform` | `min`, `max` | |
//! | `normal` | `mean`, `deviation` | |
//! | `lognormal` | `median`, `geometric_deviation` | `ln x` normal around `ln median` with `ln geometric_deviation` |
//! | `rosin-rammler` | `scale`, `exponent` | `F(x) = 1 - exp(-(x/scale)^exponent)` (Weibull) |

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::Distribution as _;
use rand_distr::{LogNormal, Normal, Uniform, Weibull};
use statrs::function::erf::{erfc, erfc_inv};

use super::geometry::required_within;
use nearwall::input::{InputError, Section};

/// Number of draws before the nearest bound is taken.
const ATTEMPTS: usize = 10_000;
/// Number of trial draws that check whether a new distribution has values within its bounds.
const TRIALS: usize = 1_000;

/// One distribution, with the bounds that truncate it.
#[derive(Debug, Clone, PartialEq)]
pub struct Distribution {
    family: Family,
    min: f64,
    max: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Family {
    Fixed(f64),
    Uniform,
    Normal { mean: f64, deviation: f64 },
    LogNormal { median: f64, geometric_deviation: f64 },
    RosinRammler { scale: f64, exponent: f64 },
}

const NAMES: [&str; 5] = ["fixed", "uniform", "normal", "lognormal", "rosin-rammler"];

/// What a key of a distribution holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DistributionKey {
    /// A middle, in the unit of the quantity.
    Middle,
    /// A standard deviation, in the unit of the quantity.
    Deviation,
    /// A spread without a unit.
    Shape,
    /// An end of the range, in the unit of the quantity.
    Bound,
}

impl DistributionKey {
    const ALL: [(&'static str, Self); 9] = [
        ("value", Self::Middle),
        ("mean", Self::Middle),
        ("median", Self::Middle),
        ("scale", Self::Middle),
        ("deviation", Self::Deviation),
        ("geometric_deviation", Self::Shape),
        ("exponent", Self::Shape),
        ("min", Self::Bound),
        ("max", Self::Bound),
    ];

    /// What this key of a distribution holds; `None` for another key.
    pub fn of(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|(name, _)| *name == key).map(|(_, holds)| holds)
    }

    /// The keys that hold one of these.
    pub fn names(which: &'static [Self]) -> impl Iterator<Item = &'static str> {
        Self::ALL.into_iter().filter(|(_, holds)| which.contains(holds)).map(|(name, _)| name)
    }
}

impl Distribution {
    /// Always the same number.
    pub fn fixed(value: f64) -> Self {
        Self { family: Family::Fixed(value), min: f64::NEG_INFINITY, max: f64::INFINITY }
    }

    /// Evenly between two numbers.
    pub fn uniform(min: f64, max: f64) -> Self {
        Self { family: Family::Uniform, min, max }
    }

    /// Reads `key`, whose values have to lie in `low..=high`; `None` when it is absent.
    ///
    /// # Errors
    /// [`InputError::Fault`] for an unknown distribution, a missing parameter, or bounds that leave nothing.
    pub fn read(section: &Section<'_>, key: &str, low: f64, high: f64) -> Result<Option<Self>, InputError> {
        if !section.has(key) {
            return Ok(None);
        }
        if !section.is_section(key) {
            return Ok(section.number_within(key, low, high)?.map(Self::fixed));
        }
        let table = section.required_section(key)?;
        let min = table.number_within("min", low, high)?;
        let max = table.number_within("max", low, high)?;
        let family = Family::read(&table, low, high)?;
        if family == Family::Uniform && (min.is_none() || max.is_none()) {
            let absent = if min.is_none() { "min" } else { "max" };
            return Err(table.missing(absent, "an end of the range"));
        }
        table.finish()?;
        let read = Self { family, min: min.unwrap_or(low), max: max.unwrap_or(high) };
        if read.min > read.max {
            return Err(section.fault(key, "`min` is above `max`"));
        }
        let mut random = ChaCha8Rng::seed_from_u64(0);
        if !(0..TRIALS).any(|_| (read.min..=read.max).contains(&read.draw(&mut random))) {
            let problem =
                format!("hardly anything of this distribution lies in {} to {}", read.min, read.max);
            return Err(section.fault(key, problem));
        }
        Ok(Some(read))
    }

    /// Draws one value.
    pub fn sample(&self, random: &mut ChaCha8Rng) -> f64 {
        let mut value = f64::NAN;
        for _ in 0..=ATTEMPTS {
            value = self.draw(random);
            if (self.min..=self.max).contains(&value) {
                return value;
            }
        }
        value.clamp(self.min, self.max)
    }

    /// The value below which this share of what lies within the bounds lies [1].
    pub fn quantile(&self, share: f64) -> f64 {
        let [low, high] = [self.min, self.max].map(|bound| self.family.share_below(bound));
        let value = match self.family {
            Family::Uniform => self.min + share * (self.max - self.min),
            family => family.quantile(low + share * (high - low)),
        };
        if let Family::Fixed(_) = self.family { value } else { value.clamp(self.min, self.max) }
    }

    /// A value that may lie out of bounds.
    fn draw(&self, random: &mut ChaCha8Rng) -> f64 {
        // The parameters were checked on reading; one that the crate refuses all the same gives no number, which no
        // bounds contain.
        self.family.draw([self.min, self.max], random).unwrap_or(f64::NAN)
    }

    /// The same shape around another middle: `value`, `mean`, `median` or `scale`; a uniform one is shifted. Bounds of
    /// the others stay.
    #[must_use]
    pub fn centred(&self, middle: f64) -> Self {
        let mut moved = self.clone();
        match &mut moved.family {
            Family::Fixed(value) => *value = middle,
            Family::Uniform => {
                let shift = middle - 0.5 * (self.min + self.max);
                moved.min += shift;
                moved.max += shift;
            }
            Family::Normal { mean, .. } => *mean = middle,
            Family::LogNormal { median, .. } => *median = middle,
            Family::RosinRammler { scale, .. } => *scale = middle,
        }
        moved
    }
}

impl Family {
    fn read(table: &Section<'_>, low: f64, high: f64) -> Result<Self, InputError> {
        let name = table.choice("distribution", &NAMES)?;
        let needed = |key: &str, low: f64, high: f64| required_within(table, key, low, high);
        let positive = f64::MIN_POSITIVE;
        match name.as_deref() {
            None => Err(table.missing("distribution", &format!("one of {}", NAMES.join(", ")))),
            Some("fixed") => Ok(Self::Fixed(needed("value", low, high)?)),
            Some("uniform") => Ok(Self::Uniform),
            Some("normal") => Ok(Self::Normal {
                mean: needed("mean", f64::NEG_INFINITY, f64::INFINITY)?,
                deviation: needed("deviation", 0.0, f64::INFINITY)?,
            }),
            Some("lognormal") => Ok(Self::LogNormal {
                median: needed("median", positive, f64::INFINITY)?,
                geometric_deviation: needed("geometric_deviation", 1.0, f64::INFINITY)?,
            }),
            Some(_) => Ok(Self::RosinRammler {
                scale: needed("scale", positive, f64::INFINITY)?,
                exponent: needed("exponent", 1e-3, 1e3)?,
            }),
        }
    }

    /// Share below a value [1]; of a uniform distribution the bounds decide.
    fn share_below(self, value: f64) -> f64 {
        match self {
            Self::Fixed(_) | Self::Uniform => 0.5,
            Self::Normal { mean, deviation } => normal_below((value - mean) / deviation),
            Self::LogNormal { .. } | Self::RosinRammler { .. } if value <= 0.0 => 0.0,
            Self::LogNormal { median, geometric_deviation } => {
                normal_below((value / median).ln() / geometric_deviation.ln())
            }
            Self::RosinRammler { scale, exponent } => -(-(value / scale).powf(exponent)).exp_m1(),
        }
    }

    /// The value with this share below it [1]; of a uniform distribution the bounds decide.
    fn quantile(self, share: f64) -> f64 {
        match self {
            Self::Fixed(value) => value,
            Self::Uniform => f64::NAN,
            Self::Normal { mean, deviation: 0.0 } => mean,
            Self::Normal { mean, deviation } => mean + deviation * normal_quantile(share),
            Self::LogNormal { median, geometric_deviation } => {
                median * geometric_deviation.powf(normal_quantile(share))
            }
            Self::RosinRammler { scale, exponent } => scale * (-(-share).ln_1p()).powf(1.0 / exponent),
        }
    }

    fn draw(self, [min, max]: [f64; 2], random: &mut ChaCha8Rng) -> Option<f64> {
        Some(match self {
            Self::Fixed(value) => value,
            Self::Uniform => Uniform::new_inclusive(min, max).ok()?.sample(random),
            Self::Normal { mean, deviation } => Normal::new(mean, deviation).ok()?.sample(random),
            Self::LogNormal { median, geometric_deviation } => {
                LogNormal::new(median.ln(), geometric_deviation.ln()).ok()?.sample(random)
            }
            Self::RosinRammler { scale, exponent } => Weibull::new(scale, exponent).ok()?.sample(random),
        })
    }
}

/// Share of the standard normal distribution below a value [1].
fn normal_below(value: f64) -> f64 {
    0.5 * erfc(-value * std::f64::consts::FRAC_1_SQRT_2)
}

/// The value below which this share of the standard normal distribution lies.
fn normal_quantile(share: f64) -> f64 {
    -std::f64::consts::SQRT_2 * erfc_inv(2.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nearwall::input::Document;

    fn read(text: &str) -> Result<Distribution, InputError> {
        Document::new("c.toml", format!("x = {text}"))
            .read(|top| Ok(Distribution::read(top, "x", 0.0, 1e9)?.unwrap()))
    }

    fn draws(text: &str) -> Vec<f64> {
        let distribution = read(text).unwrap();
        let mut random = ChaCha8Rng::seed_from_u64(7);
        (0..200_000).map(|_| distribution.sample(&mut random)).collect()
    }

    fn share_below(draws: &[f64], limit: f64) -> f64 {
        draws.iter().filter(|x| **x < limit).count() as f64 / draws.len() as f64
    }

    /// The distribution functions as the literature states them.
    #[test]
    fn draws_follow_their_distribution_function() {
        let tolerance = 5.0 * (0.25f64 / 200_000.0).sqrt();
        let near = |a: f64, b: f64| assert!((a - b).abs() < tolerance, "{a} {b}");
        let coal = draws("{ distribution = 'rosin-rammler', scale = 60, exponent = 1.4 }");
        near(share_below(&coal, 60.0), 1.0 - (-1f64).exp());
        near(share_below(&coal, 20.0), 1.0 - (-(20f64 / 60.0).powf(1.4)).exp());
        let dust = draws("{ distribution = 'lognormal', median = 5, geometric_deviation = 2 }");
        near(share_below(&dust, 5.0), 0.5);
        near(share_below(&dust, 10.0), 0.841_344_75);
        let speed = draws("{ distribution = 'normal', mean = 10, deviation = 2 }");
        near(share_below(&speed, 8.0), 0.158_655_25);
        let even = draws("{ distribution = 'uniform', min = 2, max = 6 }");
        near(share_below(&even, 3.0), 0.25);
    }

    #[test]
    fn bounds_truncate() {
        let wax = draws("{ distribution = 'normal', mean = 80, deviation = 15, min = 50, max = 110 }");
        assert!(wax.iter().all(|d| (50.0..=110.0).contains(d)));
        // Inside, the shape is kept: half lies below the middle of a symmetric cut.
        assert!((share_below(&wax, 80.0) - 0.5).abs() < 0.006);
    }

    /// A quantile is the value below which that share of the draws lies, with bounds and without.
    #[test]
    fn quantiles_are_those_of_the_draws() {
        for text in [
            "{ distribution = 'rosin-rammler', scale = 60, exponent = 1.4, min = 20 }",
            "{ distribution = 'rosin-rammler', scale = 60, exponent = 4 }",
            "{ distribution = 'lognormal', median = 5, geometric_deviation = 2, max = 9 }",
            "{ distribution = 'normal', mean = 10, deviation = 2, min = 9 }",
            "{ distribution = 'uniform', min = 2, max = 6 }",
        ] {
            let (distribution, draws) = (read(text).unwrap(), draws(text));
            for share in [0.01, 0.2, 0.5, 0.8, 0.99] {
                let below = share_below(&draws, distribution.quantile(share));
                assert!((below - share).abs() < 5.0 * (0.25f64 / 200_000.0).sqrt(), "{text} {share} {below}");
            }
        }
        for (text, value) in [("3.5", 3.5), ("{ distribution = 'normal', mean = 4, deviation = 0 }", 4.0)] {
            assert_eq!(read(text).unwrap().quantile(0.3), value, "{text}");
        }
    }

    #[test]
    fn impossible_ones_are_refused() {
        let message = |text| read(text).unwrap_err().to_string();
        let nothing = message("{ distribution = 'normal', mean = 1, deviation = 0.1, min = 5, max = 6 }");
        assert!(nothing.contains("c.toml:1:1: x: hardly anything"), "{nothing}");
        let unknown = message("{ distribution = 'gauss', mean = 1 }");
        assert!(unknown.contains("x.distribution: unknown value `gauss`"), "{unknown}");
        let missing = message("{ distribution = 'normal', mean = 1 }");
        assert!(missing.contains("x.deviation: missing"), "{missing}");
    }
}
