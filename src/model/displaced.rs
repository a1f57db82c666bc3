//! What a number that is used outside of its stated range moves in the outcome.
//!
//! A property is held at its value where its source says nothing, and a law of viscosity goes on
//! beyond the temperatures of its fit. How wrong they are there is not known; the outcome with the
//! property or the viscosity changed both ways shows whether that matters: a property by its stated
//! uncertainty, at least [`LEAST_SHARE`], a viscosity by [`VISCOSITY_FACTOR`].

use super::{Beyond, Expectation, Model, Stated, Wall};
use crate::impact::{Impact, ImpactError};
use crate::material::Material;
use crate::normal::Contact;

/// Smallest share by which a held property is raised and lowered [1]: assumed, as moduli and
/// strengths of metals and glasses change by some 5 to 10 % in 100 K.
pub const LEAST_SHARE: f64 = 0.2;

/// Factor by which a viscosity beyond its fit is raised and lowered [1]: assumed, as laws of viscosity
/// differ by up to a decade on the same slag within their ranges already.
pub const VISCOSITY_FACTOR: f64 = 10.0;

/// Change of an outcome [1] from which a held property matters; assumed, as the scatter of measured
/// restitutions is some 0.01 to 0.05.
pub const MATTERS_FROM: f64 = 0.01;

/// A model with each property that has a stated range, and its viscosities, changed both ways.
#[derive(Debug, Clone)]
pub struct Displaced<'m> {
    model: &'m Model,
    properties: Vec<DisplacedProperty>,
    /// With less and more viscous melts.
    viscosities: Option<[Model; 2]>,
}

/// A property, and the model with it lowered and raised.
#[derive(Debug, Clone)]
struct DisplacedProperty {
    material: String,
    key: &'static str,
    models: [Model; 2],
}

impl<'m> Displaced<'m> {
    /// The displaced models of a model.
    pub fn new(model: &'m Model) -> Self {
        let mut properties: Vec<DisplacedProperty> = Vec::new();
        for solid in model.solids() {
            for (key, share) in solid.limited_properties() {
                let (material, share) = (solid.name(), share.max(LEAST_SHARE));
                if !properties.iter().any(|known| known.key == key && known.material == material) {
                    let models = [1.0 - share, 1.0 + share].map(|factor| model.scaled(material, key, factor));
                    properties.push(DisplacedProperty { material: material.to_owned(), key, models });
                }
            }
        }
        let less = model.more_viscous(1.0 / VISCOSITY_FACTOR);
        let viscosities = less.zip(model.more_viscous(VISCOSITY_FACTOR)).map(<[Model; 2]>::from);
        Self { model, properties, viscosities }
    }

    /// The model that is displaced.
    pub fn model(&self) -> &'m Model {
        self.model
    }

    /// How far what is used beyond its range moves the outcome of an impact [1]: the largest change
    /// of `p_stick`, or of `e_n` and `e_t` times the share that rebounds, over `draws` as in
    /// [`Model::expect`], which gave `plain` with the same. `None` for a law whose alternative nobody
    /// knows.
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn moved(
        &self,
        wall: usize,
        impact: &Impact,
        plain: &Expectation,
        beyond: &Beyond<'_>,
        draws: usize,
    ) -> Result<Option<f64>, ImpactError> {
        let Some(models) = self.models_for(beyond) else { return Ok(None) };
        let mut most: f64 = 0.0;
        for model in models {
            most = most.max(change(plain, &model.expect(wall, impact, draws)?));
        }
        Ok(Some(most))
    }

    /// What happens outside of the range, and what is changed to see whether it matters; `None` where nobody knows the
    /// alternative.
    pub fn trial(&self, beyond: &Beyond<'_>) -> Option<String> {
        self.models_for(beyond)?;
        Some(if beyond.is_held() {
            format!("held there; its uncertainty (at least {} %)", 100.0 * LEAST_SHARE)
        } else {
            format!("used beyond; a viscosity {VISCOSITY_FACTOR} times higher or lower")
        })
    }

    fn models_for(&self, beyond: &Beyond<'_>) -> Option<&[Model; 2]> {
        match beyond.what {
            Stated::Property { material, key } => {
                let mut known = self.properties.iter();
                Some(&known.find(|known| known.key == key && known.material == material)?.models)
            }
            Stated::Criterion { .. } => self.viscosities.as_ref(),
            Stated::CriterionSpeed { .. } | Stated::Law { .. } => None,
        }
    }
}

/// Largest change between two outcomes [1].
fn change(one: &Expectation, other: &Expectation) -> f64 {
    let rebound = 1.0 - one.sticking_probability.min(other.sticking_probability);
    let captured = (one.sticking_probability - other.sticking_probability).abs();
    let normal = (one.normal_restitution - other.normal_restitution).abs();
    let tangential = (one.tangential_restitution - other.tangential_restitution).abs();
    captured.max(rebound * normal.max(tangential))
}

impl Model {
    /// The solids of contacts: those of the particle, of the walls and of the powder on them.
    fn solids(&self) -> impl Iterator<Item = &Material> {
        let of_walls = self.walls.iter().flat_map(|wall| wall.powder.iter().chain([&wall.material]));
        [Some(self.particle()), self.ash()].into_iter().flatten().chain(of_walls)
    }

    /// The same model with every melt `factor` [1] times as viscous; `None` where no viscosity decides.
    fn more_viscous(&self, factor: f64) -> Option<Self> {
        let mut model = self.clone();
        let of_walls = model.walls.iter_mut().map(|wall| &mut wall.melt);
        for melt in [&mut model.stickiness].into_iter().chain(of_walls) {
            if let Some(criterion) = melt {
                *melt = Some(criterion.more_viscous(factor)?);
            }
        }
        Some(model.prepare())
    }

    /// The same model with a mechanical property of a material multiplied by a factor [1].
    fn scaled(&self, material: &str, key: &str, factor: f64) -> Self {
        let mut model = self.clone();
        let change = |solid: &mut Material| {
            if solid.name() == material {
                *solid = solid.scaled(key, factor);
            }
        };
        model.particle.solids_mut().for_each(change);
        for wall in &mut model.walls {
            wall.powder.iter_mut().chain([&mut wall.material]).for_each(change);
        }
        let particle = model.particle().clone();
        model.walls.iter_mut().for_each(|wall| wall.prepare_again(&particle));
        model.prepare()
    }
}

impl Wall {
    /// The contact without temperatures, after a property changed.
    fn prepare_again(&mut self, particle: &Material) {
        // Constants are known at every temperature.
        let solids = [particle, &self.material].map(|solid| solid.mechanical(293.15).ok());
        if let (Some(_), [Some(particle), Some(wall)]) = (self.prepared, solids) {
            self.prepared =
                Some(Contact::new(&particle, &wall, self.adhesion.yield_ratio, self.adhesion.work));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONSTANT: &str = r#"
[particle]
material = "montan-wax"
[walls.default]
material = "stainless-steel"
[normal]
model = "constant"
e_n = 0.4
[tangential]
model = "constant"
e_t = 0.7
"#;

    /// With constant restitutions no property of the wall moves anything. By Thornton and Ning the
    /// restitution far above the yield velocity goes with v_y^(1/4), and v_y with the strength of the
    /// softer solid to the power of 5/2: 20 % less strength is 1 - 0.8^(5/8) less restitution.
    #[test]
    fn a_held_number_moves_what_the_law_says() {
        let plain = Model::from_toml("m", CONSTANT).unwrap();
        let hot = Impact { wall_temperature: 500.0, particle_temperature: 340.0, ..Impact::default() };
        let impact = Impact { normal_speed: 100.0, diameter: 1e-3, ..hot };
        let displaced = Displaced::new(&plain);
        let mean = plain.expect(0, &impact, 64).unwrap();
        for beyond in plain.beyond(0, &impact).unwrap() {
            assert_eq!(displaced.moved(0, &impact, &mean, &beyond, 64), Ok(Some(0.0)), "{beyond}");
        }
        let text = CONSTANT.replace("\"constant\"\ne_n = 0.4", "\"thornton-ning\"\nyield_ratio = 0.7");
        let model = Model::from_toml("m", &text).unwrap();
        let displaced = Displaced::new(&model);
        let reasons = model.beyond(0, &impact).unwrap();
        let strength = |beyond: &&Beyond<'_>| {
            beyond.what == Stated::Property { material: "montan-wax", key: "yield_strength" }
        };
        let strength = reasons.iter().find(strength).unwrap();
        let share = model.particle().property("yield_strength").unwrap().uncertainty().unwrap() / 9.5e6;
        let mean = model.expect(0, &impact, 64).unwrap();
        let moved = displaced.moved(0, &impact, &mean, strength, 64).unwrap().unwrap();
        let expected = mean.normal_restitution * (1.0 - (1.0 - share).powf(0.625));
        assert!((moved / expected - 1.0).abs() < 0.05, "{moved} {expected}");
    }
}
