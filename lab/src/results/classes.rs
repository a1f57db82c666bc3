//! What arrives at a wall, in classes of impact speed, angle and diameter.

use super::wilson;

/// The quantity that is divided into classes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ClassQuantity {
    /// Speed relative to the wall [m/s].
    Speed,
    /// Angle from the wall [degrees]: 0 is grazing, 90 is head-on.
    Angle,
    /// Diameter [m].
    Diameter,
}

/// One class of one quantity, of one injector or of several together.
#[derive(Debug, Clone, PartialEq)]
pub struct Class {
    /// The injector's name, or the number of its parcels.
    pub injector: String,
    /// The classed quantity.
    pub quantity: ClassQuantity,
    /// Lower end, which belongs to the class.
    pub low: f64,
    /// Upper end; infinite for the last class.
    pub high: f64,
    /// What arrived.
    pub sums: ClassSums,
}

/// What arrived in a class.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ClassSums {
    /// Number of parcels.
    pub hits: f64,
    /// Number of particles.
    pub particles: f64,
    /// Sum over the parcels of their squared number of particles.
    pub particles_squared: f64,
    /// Mass [kg].
    pub mass: f64,
    /// Number of captured particles.
    pub captured_particles: f64,
    /// Their mass [kg].
    pub captured_mass: f64,
    /// Kinetic energy before the hits [J].
    pub energy_in: f64,
    /// Kinetic energy after the hits [J].
    pub energy_out: f64,
}

impl ClassSums {
    fn add(&mut self, other: &Self) {
        self.hits += other.hits;
        self.particles += other.particles;
        self.particles_squared += other.particles_squared;
        self.mass += other.mass;
        self.captured_particles += other.captured_particles;
        self.captured_mass += other.captured_mass;
        self.energy_in += other.energy_in;
        self.energy_out += other.energy_out;
    }

    /// Share of the particles that were captured [1] and its 95 % interval; `None` when nothing arrived.
    ///
    /// The number of independent trials is that of equally heavy parcels with the same information (Kish 1965):
    /// (sum of weights)² / sum of squared weights.
    pub fn captured(&self) -> Option<[f64; 3]> {
        let trials = self.particles * self.particles / self.particles_squared;
        if trials.is_nan() || trials <= 0.0 {
            return None;
        }
        let share = self.captured_particles / self.particles;
        let [low, high] = wilson(share, trials);
        Some([share, low, high])
    }
}

/// The classes of a quantity in the order of size, all injectors together.
pub fn together(classes: &[Class], quantity: ClassQuantity) -> Vec<Class> {
    let mut all: Vec<Class> = classes.iter().filter(|class| class.quantity == quantity).cloned().collect();
    all.sort_by(|a, b| a.low.total_cmp(&b.low));
    let mut merged: Vec<Class> = Vec::new();
    for class in all {
        match merged.last_mut() {
            Some(last) if last.low == class.low => last.sums.add(&class.sums),
            _ => merged.push(Class { injector: String::new(), ..class }),
        }
    }
    merged
}

/// The sum over all classes, of one injector or of all.
pub fn total(classes: &[Class], injector: Option<&str>) -> ClassSums {
    let mut sums = ClassSums::default();
    for class in classes.iter().filter(|class| class.quantity == ClassQuantity::Diameter) {
        if injector.is_none_or(|injector| class.injector == injector) {
            sums.add(&class.sums);
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Wilson's interval for 3 of 10 as statistics books print it: 0.108 to 0.603.
    #[test]
    fn equal_weights_give_the_binomial_interval() {
        let sums = |weight: f64| ClassSums {
            particles: 10.0 * weight,
            particles_squared: 10.0 * weight * weight,
            captured_particles: 3.0 * weight,
            ..ClassSums::default()
        };
        for weight in [1.0, 250.0] {
            let [share, low, high] = sums(weight).captured().unwrap();
            assert!(
                (share - 0.3).abs() < 1e-12 && (low - 0.1078).abs() < 5e-5 && (high - 0.6032).abs() < 5e-5
            );
        }
        // One heavy parcel among nine light ones is worth little more than one trial.
        let uneven = ClassSums {
            particles: 109.0,
            particles_squared: 10_009.0,
            captured_particles: 100.0,
            ..ClassSums::default()
        };
        let [_, low, high] = uneven.captured().unwrap();
        assert!(low < 0.25 && high > 0.99, "{low} {high}");
        assert_eq!(ClassSums::default().captured(), None);
    }
}
