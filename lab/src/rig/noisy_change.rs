//! What a number of the case changes about a reading where the gas moves particles at random.
//!
//! Each simulated change `c_p` at a place `w_p` of the number has noise of its own, so that no curve goes through all of
//! them. A polynomial without a constant, `c(w) = Σ a_j q_j(w)`, is fitted with the weights `g_p = 1/(v_p + v)`, from
//! the variances `v_p` of the changes and their mean `v`. With the `q_j` orthogonal under these weights
//! (Gram and Schmidt), `a_j = Σ g q_j c / Σ g q_j²` each for itself. The blocks of particles, through the same sums,
//! tell the variance `s_j` of each. Of a coefficient `a_j max(0, 1 - s_j/a_j²)` is taken (James and Stein's estimate,
//! which is 0 for what may be noise alone).

use crate::simulate::BLOCKS;

/// Most powers of a polynomial: no more than places, and the third only with a fourth place.
const POWERS: usize = 3;

/// A change at a place of a number.
#[derive(Debug, Clone, Copy)]
pub(super) struct NoisyPlace {
    /// The place [standard errors].
    pub at: f64,
    /// The change, of a share in log odds.
    pub change: f64,
    /// How far each block of particles moves it.
    pub blocks: [f64; BLOCKS],
}

impl NoisyPlace {
    /// Variance of the change.
    pub fn variance(&self) -> f64 {
        self.blocks.iter().map(|one| one * one).sum()
    }
}

/// One of the orthogonal polynomials with what the changes hold of it.
#[derive(Debug, Clone, Copy)]
struct Term {
    /// Coefficients of the powers from the first on.
    powers: [f64; POWERS],
    /// Its coefficient, as far as it is no noise.
    coefficient: f64,
    variance: f64,
}

impl Term {
    fn at(&self, place: f64) -> f64 {
        self.powers.iter().rev().fold(0.0, |sum, own| (sum + own) * place)
    }

    /// The same with its coefficient, from places with their weights.
    fn fitted(self, weighted: &[(f64, &NoisyPlace)]) -> Self {
        let square: f64 = weighted.iter().map(|(weight, one)| weight * self.at(one.at).powi(2)).sum();
        let sum = |of: &dyn Fn(&NoisyPlace) -> f64| {
            weighted.iter().map(|(weight, one)| weight * self.at(one.at) * of(one)).sum::<f64>() / square
        };
        let found = sum(&|one| one.change);
        let variance: f64 = (0..BLOCKS).map(|block| sum(&|one| one.blocks[block]).powi(2)).sum();
        let kept = if variance > 0.0 { (1.0 - variance / (found * found)).max(0.0) } else { 1.0 };
        Self { coefficient: kept * found, variance, ..self }
    }
}

/// The change of a reading over the number.
#[derive(Debug, Clone)]
pub(super) struct NoisyChange(Vec<Term>);

impl NoisyChange {
    /// Through changes that exist; `None` without any noise.
    pub fn new(places: &[NoisyPlace]) -> Option<Self> {
        let mean = places.iter().map(NoisyPlace::variance).sum::<f64>() / places.len() as f64;
        if !(mean > 0.0 && mean.is_finite()) {
            return None;
        }
        let weighted: Vec<(f64, &NoisyPlace)> =
            places.iter().map(|one| (1.0 / (one.variance() + mean), one)).collect();
        let count = places.len().min(if places.len() > POWERS { POWERS } else { 2 });
        let mut terms: Vec<Term> = Vec::new();
        for power in 0..count {
            let mut term = Term { powers: [0.0; POWERS], coefficient: 0.0, variance: 0.0 };
            term.powers[power] = 1.0;
            let mut own = term;
            for other in &terms {
                let [both, square] = weighted.iter().fold([0.0; 2], |[both, square], (weight, one)| {
                    let q = other.at(one.at);
                    [both + weight * q * term.at(one.at), square + weight * q * q]
                });
                own.powers.iter_mut().zip(other.powers).for_each(|(own, q)| *own -= both / square * q);
            }
            terms.push(own.fitted(&weighted));
        }
        Some(Self(terms))
    }

    /// The change at a place and its variance.
    pub fn at(&self, place: f64) -> [f64; 2] {
        self.0.iter().fold([0.0; 2], |[change, variance], term| {
            let q = term.at(place);
            [change + term.coefficient * q, variance + term.variance * q * q]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Changes with a standard error of 0.2 in a block of each place's own.
    fn places(of: &[(f64, f64)]) -> Vec<NoisyPlace> {
        let one = |(block, (at, change)): (usize, &(f64, f64))| {
            let mut blocks = [0.0; BLOCKS];
            blocks[block] = 0.2;
            NoisyPlace { at: *at, change: *change, blocks }
        };
        of.iter().enumerate().map(one).collect()
    }

    /// A slope seen at -3, 3 and 6 has the variance 0.04/54: at 3 it is 0.04/6, to which the curve adds its own.
    #[test]
    fn all_places_tell_a_line() {
        let line = NoisyChange::new(&places(&[(-3.0, -3.0), (3.0, 3.0), (6.0, 6.0)])).unwrap();
        let [slope, curve] = &line.0[..] else { panic!("{line:?}") };
        assert!((slope.coefficient - (1.0 - 0.04 / 54.0)).abs() < 1e-12, "{slope:?}");
        assert!((slope.variance - 0.04 / 54.0).abs() < 1e-15 && curve.coefficient.abs() < 1e-12);
        let [change, variance] = line.at(3.0);
        assert!((change - 3.0).abs() < 0.01 && variance > 0.04 / 6.0 && variance < 0.04, "{variance}");
    }

    #[test]
    fn noise_is_no_change() {
        let noise = NoisyChange::new(&places(&[(-3.0, 0.1), (3.0, 0.15), (6.0, -0.1)])).unwrap();
        assert_eq!(noise.at(5.0)[0], 0.0);
        assert!(NoisyChange::new(&[NoisyPlace { at: 3.0, change: 1.0, blocks: [0.0; BLOCKS] }]).is_none());
    }

    /// A parabola is met from -3 and 3, a cubic from four places, but for what may be noise.
    #[test]
    fn curves_are_met() {
        let cubic = |w: f64| w + 0.1 * w * w - 0.01 * w * w * w;
        for at in [&[-3.0, 3.0][..], &[-6.0, -3.0, 3.0, 6.0, 10.0]] {
            let own: Vec<(f64, f64)> = at.iter().map(|w| (*w, 10.0 * cubic(*w))).collect();
            let found = NoisyChange::new(&places(&own)).unwrap();
            for (w, change) in own {
                assert!((found.at(w)[0] - change).abs() < 0.1, "{w}: {:?} {change}", found.at(w));
            }
        }
    }
}
