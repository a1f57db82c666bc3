//! Numbers of a `[capture]` table that measured captures can correct.
//!
//! `reference_viscosity` [Pa s] and `coefficient` [Pa s] act on the stickiness as a factor on the viscosity of the melt
//! does, `sticky_from` and `flows_from` are shares of liquid [1]. Ashes that stick by their fusion temperatures, and
//! droplets, have no such number: theirs belong to the material.

use super::{Capture, Criterion};

impl Capture {
    /// Key and value [Pa s or 1] of each number; none without a criterion that has one.
    pub fn numbers(mut self) -> Vec<(&'static str, f64)> {
        self.numbers_mut().into_iter().map(|(key, number)| (key, *number)).collect()
    }

    /// The table with another value [Pa s or 1] of a number; a share never passes the other one.
    #[must_use]
    pub fn with_number(mut self, key: &str, value: f64) -> Self {
        if let Some((_, number)) = self.numbers_mut().into_iter().find(|(own, _)| *own == key) {
            *number = value;
        }
        if let Some(Criterion::MeltFraction(criterion)) = &mut self.criterion {
            criterion.order(key);
        }
        self
    }

    fn numbers_mut(&mut self) -> Vec<(&'static str, &mut f64)> {
        match &mut self.criterion {
            Some(Criterion::Viscosity(criterion)) => vec![criterion.number_mut()],
            Some(Criterion::MeltFraction(criterion)) => criterion.numbers_mut().into(),
            Some(Criterion::Fusion(_) | Criterion::Droplet(_)) | None => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::impact::Impact;
    use crate::model::Model;
    use crate::rng::ImpactRng;

    fn text(capture: &str) -> String {
        format!(
            "[materials.ash]\nlike = \"fly-ash\"\n\
             composition = {{ SiO2 = 50, Al2O3 = 25, Fe2O3 = 10, CaO = 15 }}\n\
             melt_fraction = {{ T = [1000, 1600], value = [0, 1] }}\n\
             [particle]\nmaterial = \"ash\"\n[walls.default]\nmaterial = \"ash\"\nslag = \"ash\"\n\
             [normal]\nmodel = \"constant\"\ne_n = 0.5\n[tangential]\nmodel = \"constant\"\ne_t = 0.8\n\
             [capture]\n{capture}\n"
        )
    }

    /// A model with another number is the model that is read with it, for particles and for slag on a wall.
    #[test]
    fn a_corrected_model_is_the_one_that_is_read_so() {
        let viscosity = "model = \"viscosity\"\nlaw = \"urbain\"\nreference_viscosity = ";
        let energy = "model = \"kinetic-energy\"\nlaw = \"urbain\"\ncoefficient = ";
        for (key, before, after, value) in [
            ("reference_viscosity", format!("{viscosity}30"), format!("{viscosity}75"), 75.0),
            ("coefficient", format!("{energy}5e-12"), format!("{energy}2e-13"), 2e-13),
            (
                "sticky_from",
                "model = \"melt-fraction\"".to_owned(),
                "model = \"melt-fraction\"\nsticky_from = 0.3".to_owned(),
                0.3,
            ),
            (
                "flows_from",
                "model = \"melt-fraction\"".to_owned(),
                "model = \"melt-fraction\"\nflows_from = 0.5".to_owned(),
                0.5,
            ),
        ] {
            let [before, after] =
                [before, after].map(|capture| Model::from_toml("m.toml", &text(&capture)).unwrap());
            let corrected = before.with_capture(before.capture().with_number(key, value)).unwrap();
            let mut differ = 0;
            for particle in 0..7 {
                for wall in 0..7 {
                    let at = |step: i32| 1100.0 + 90.0 * f64::from(step);
                    let impact = Impact {
                        diameter: 5e-5,
                        normal_speed: 4.0,
                        particle_temperature: at(particle),
                        wall_temperature: at(wall),
                        ..Impact::default()
                    };
                    let of = |model: &Model| {
                        model.resolve(0, &impact, ImpactRng::new(1, 2)).unwrap().sticking_probability
                    };
                    assert_eq!(of(&corrected), of(&after), "{key} at {impact:?}");
                    differ += usize::from(of(&before) != of(&after));
                }
            }
            assert!(differ > 10, "{key} changes {differ} outcomes of 49");
        }
    }

    /// Sticking cannot begin after it is complete.
    #[test]
    fn shares_of_liquid_stay_in_order() {
        let model = Model::from_toml("m.toml", &text("model = \"melt-fraction\"")).unwrap();
        let numbers = |key, value| model.capture().with_number(key, value).numbers();
        assert_eq!(numbers("sticky_from", 0.9), [("sticky_from", 0.9), ("flows_from", 0.9)]);
        assert_eq!(numbers("flows_from", 0.1), [("sticky_from", 0.1), ("flows_from", 0.1)]);
        assert_eq!(numbers("reference_viscosity", 3.0), model.capture().numbers());
    }
}
