//! Heat of fusion of a particle in flight.
//!
//! Between `T_m - r/2` and `T_m + r/2` the particle takes up the heat of fusion `L` beside its heat
//! capacity `c_p`, evenly over the range: an apparent heat capacity `c_p + L/r` there. The
//! integrated quantity is the heat taken up, `H(T)`, as the temperature `H/c_p` that the particle
//! would have without fusion, so that no step can pass over the range, however narrow; with `r = 0`
//! the temperature stays at `T_m` until all is molten. Freezing runs the same way back: there is no
//! undercooling.
//!
//! `L` [J/kg] of the whole particle, `c_p` [J/(kg K)], `T_m`, `r` [K]. The enthalpy and apparent
//! heat capacity methods are textbook forms of the same balance (Voller and Cross 1981; not
//! re-read). The particle has one temperature throughout.

/// Melting of a particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fusion {
    /// Where melting begins, `T_m - r/2` [K].
    begins: f64,
    /// `r` [K].
    range: f64,
    /// `L/c_p` [K].
    rise: f64,
}

impl Fusion {
    /// From the heat of fusion [J/kg], the heat capacity [J/(kg K)], the melting point and the range around it [K].
    pub fn new(heat: f64, heat_capacity: f64, melting_point: f64, range: f64) -> Self {
        Self { begins: melting_point - 0.5 * range, range, rise: heat / heat_capacity }
    }

    /// Temperature [K] of a particle that has taken up the heat that would bring it to `sensible` [K] without fusion.
    pub fn temperature(&self, sensible: f64) -> f64 {
        let above = sensible - self.begins;
        let whole = self.range + self.rise;
        if above <= 0.0 {
            sensible
        } else if above >= whole {
            sensible - self.rise
        } else {
            self.begins + above * self.range / whole
        }
    }

    /// The inverse of [`Fusion::temperature`]; a particle at a sharp melting point is solid.
    pub fn sensible(&self, temperature: f64) -> f64 {
        let above = temperature - self.begins;
        if above <= 0.0 {
            temperature
        } else if above >= self.range {
            temperature + self.rise
        } else {
            self.begins + above * (self.range + self.rise) / self.range
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// The heat between two temperatures is c_p dT plus the share of L that lies between them.
    #[test]
    fn the_heat_is_the_integral_of_the_apparent_capacity() {
        let fusion = Fusion::new(2e5, 1000.0, 1500.0, 40.0);
        let steps = 200_000;
        let width = 200.0 / f64::from(steps);
        let mut heat = 0.0;
        for step in 0..steps {
            let temperature = 1400.0 + (f64::from(step) + 0.5) * width;
            let melting = (temperature - 1500.0).abs() < 20.0;
            heat += width * (1000.0 + if melting { 2e5 / 40.0 } else { 0.0 });
        }
        let taken_up = 1000.0 * (fusion.sensible(1600.0) - fusion.sensible(1400.0));
        assert_relative_eq!(taken_up, heat, max_relative = 1e-9);
        assert_relative_eq!(taken_up, 4e5, max_relative = 1e-12);
        for temperature in [1400.0, 1479.0, 1481.0, 1500.0, 1519.0, 1530.0] {
            let back = fusion.temperature(fusion.sensible(temperature));
            assert_relative_eq!(back, temperature, max_relative = 1e-14);
        }
    }

    #[test]
    fn a_sharp_melting_point_is_a_plateau() {
        let fusion = Fusion::new(2e5, 1000.0, 1500.0, 0.0);
        assert_eq!(
            [1499.0, 1500.0, 1600.0, 1700.0].map(|s| fusion.temperature(s)),
            [1499.0, 1500.0, 1500.0, 1500.0]
        );
        assert_eq!(fusion.temperature(1750.0), 1550.0);
        assert_eq!((fusion.sensible(1500.0), fusion.sensible(1550.0)), (1500.0, 1750.0));
    }
}
