//! Sums and their statistics: masses, amounts, moments, histograms, and Wilson's interval.

use serde::{Serialize, Serializer, ser::SerializeStruct};

/// A mass that many small ones are added to without loss (Neumaier's sum) [kg].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Mass {
    sum: f64,
    correction: f64,
}

impl Mass {
    /// Adds a mass [kg].
    pub fn add(&mut self, mass: f64) {
        let sum = self.sum + mass;
        self.correction +=
            if self.sum.abs() >= mass.abs() { (self.sum - sum) + mass } else { (mass - sum) + self.sum };
        self.sum = sum;
    }

    /// The total [kg].
    pub fn total(self) -> f64 {
        self.sum + self.correction
    }
}

impl Serialize for Mass {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(self.total())
    }
}

/// A number of particles or parcels and their mass.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Amount {
    /// Number of particles or parcels.
    pub count: u64,
    mass: Mass,
}

impl Amount {
    /// `count` particles or parcels of `mass` [kg] in all. A count from a file is rounded down.
    pub fn new(count: f64, mass: f64) -> Self {
        Self { count: count as u64, mass: Mass { sum: mass, correction: 0.0 } }
    }

    /// Adds one particle or parcel of a mass [kg].
    pub fn add(&mut self, mass: f64) {
        self.count += 1;
        self.mass.add(mass);
    }

    /// Mass [kg].
    pub fn mass(&self) -> f64 {
        self.mass.total()
    }
}

/// Number, mean and spread of a quantity (Welford's sums).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Moments {
    /// Number of values.
    pub count: u64,
    /// Their mean.
    pub mean: f64,
    squares: f64,
}

impl Moments {
    /// Moments from sums in a file; `squares` is NaN when the file has no sum of squares.
    pub fn from_sums(count: f64, sum: f64, squares: f64) -> Self {
        let mean = if count > 0.0 { sum / count } else { 0.0 };
        let squares = squares - mean * sum;
        Self { count: count as u64, mean, squares: if squares < 0.0 { 0.0 } else { squares } }
    }

    /// Adds a value.
    pub fn add(&mut self, value: f64) {
        self.count += 1;
        let before = value - self.mean;
        self.mean += before / self.count as f64;
        self.squares += before * (value - self.mean);
    }

    /// Standard deviation of the values; NaN when it is not known.
    pub fn deviation(&self) -> f64 {
        if self.count < 2 { 0.0 } else { (self.squares / (self.count - 1) as f64).sqrt() }
    }

    /// Standard error of the mean.
    pub fn error(&self) -> f64 {
        if self.count < 2 { 0.0 } else { self.deviation() / (self.count as f64).sqrt() }
    }
}

impl Serialize for Moments {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("Moments", 3)?;
        fields.serialize_field("count", &self.count)?;
        fields.serialize_field("mean", &self.mean)?;
        fields.serialize_field("deviation", &self.deviation())?;
        fields.end()
    }
}

/// Bin of a value between 0 and `top`; a value outside belongs to the nearest bin.
pub fn bin(value: f64, top: f64, bins: usize) -> usize {
    ((value / top * bins as f64) as usize).min(bins - 1)
}

/// Smallest and largest of some numbers; infinite without any.
pub fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}

/// `part / whole`; NaN, which a page shows as "–", when `whole` is not positive.
pub fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { f64::NAN }
}

/// Wilson's 95 % interval of a share [1] observed in `count` independent trials; 0 to 1 without a trial.
pub fn wilson(share: f64, count: f64) -> [f64; 2] {
    /// 97.5 % point of the normal distribution.
    const Z: f64 = 1.959_963_984_540_054;
    if count <= 0.0 {
        return [0.0, 1.0];
    }
    let spread = 1.0 + Z * Z / count;
    let middle = (share + Z * Z / (2.0 * count)) / spread;
    let half = Z / spread * (share * (1.0 - share) / count + Z * Z / (4.0 * count * count)).sqrt();
    [(middle - half).min(share), (middle + half).max(share)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_those_of_the_textbook() {
        let values = [2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0];
        let mut moments = Moments::default();
        values.iter().for_each(|value| moments.add(*value));
        let read = Moments::from_sums(8.0, values.iter().sum(), values.iter().map(|v| v * v).sum());
        for moments in [moments, read] {
            assert_eq!((moments.count, moments.mean), (8, 5.0));
            assert!((moments.deviation() - (32.0f64 / 7.0).sqrt()).abs() < 1e-15);
        }
        assert!(Moments::from_sums(8.0, 40.0, f64::NAN).deviation().is_nan());
    }

    #[test]
    fn small_masses_are_not_lost() {
        let mut mass = Mass::default();
        for part in [1.0, 1e-17, 1e-17, -1.0] {
            mass.add(part);
        }
        assert_eq!(mass.total(), 2e-17);
    }
}
