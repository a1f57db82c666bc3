//! Initial positions and states of the particles.
//!
//! Each particle draws its state from its own stream of a seeded generator (ChaCha8, stream = number of the particle),
//! so it is the same on any thread and however many particles there are.

use std::f64::consts::TAU;
use std::path::Path;

use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::Distribution as _;
use rand_distr::StandardUniform;

use super::conversion::CarbonConversion;
use super::distribution::Distribution;
use super::error::SimulationError;
use super::fusion::Fusion;
use super::geometry::{across, direction, required_vector, required_within, vector};
use super::motion::{Body, ParticleState, state};
use super::shrinkage::{ASH_DENSITY, Shrinkage};
use nearwall::input::{InputError, Section};
use nearwall::model::Model;

/// The `[particles]` of a case, or one of several `[[particles]]`.
#[derive(Debug, Clone)]
pub struct Injection {
    /// Its name; `particles` for a single one without a name.
    pub name: String,
    /// Model of its particles where it is not that of the case.
    pub model: Option<Model>,
    /// The wall of its model for each wall of the case's model.
    walls: Vec<usize>,
    /// How many particles are followed.
    pub count: u64,
    place: ReleaseShape,
    /// Mean direction of flight, length 1.
    along: Vector3<f64>,
    diameter: Distribution,
    speed: Distribution,
    /// Whether the speed comes on top of the gas's own velocity.
    pub relative_to_gas: bool,
    angle: Distribution,
    azimuth: Distribution,
    temperature: Distribution,
    conversion: Distribution,
    /// Density before any carbon is gone [kg/m³]; otherwise that of the model's particle.
    pub density: Option<f64>,
    /// Heat capacity [J/(kg K)]; without it the temperature stays.
    pub heat_capacity: Option<f64>,
    /// Thermal conductivity [W/(m K)]; otherwise that of the model's particle.
    pub conductivity: Option<f64>,
    fusion: Option<FusionKeys>,
    /// Emissivity [1] and temperature of the surroundings [K].
    pub radiation: Option<(f64, f64)>,
    /// Real particles that each followed particle represents.
    pub weight: ParticleWeight,
    /// Law of carbon conversion, with the combustible share of these particles.
    pub burning: CarbonConversion,
}

/// Keys of the heat of fusion.
#[derive(Debug, Clone, Copy, PartialEq)]
struct FusionKeys {
    /// [J/kg].
    heat: f64,
    /// [K]; otherwise that of the model's particle.
    melting_point: Option<f64>,
    /// [K].
    range: f64,
}

/// Number of real particles that one followed particle represents.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ParticleWeight {
    /// One real particle: the size distribution counts particles.
    One,
    /// An equal share of this mass [kg]: the size distribution counts mass.
    EqualShare(f64),
}

#[derive(Debug, Clone, PartialEq)]
enum ReleaseShape {
    Point(Vector3<f64>),
    Disc { centre: Vector3<f64>, normal: Vector3<f64>, radii: [f64; 2] },
}

/// The numbers from which a particle's start follows: random ones, or such that are evenly spread over all particles.
pub(super) trait StartNumbers {
    /// A number between 0 and 1.
    fn share(&mut self) -> f64;

    /// A value of a distribution.
    fn of(&mut self, distribution: &Distribution) -> f64;
}

impl StartNumbers for ChaCha8Rng {
    fn share(&mut self) -> f64 {
        StandardUniform.sample(self)
    }

    fn of(&mut self, distribution: &Distribution) -> f64 {
        distribution.sample(self)
    }
}

/// Quantities of particles that a sweep can change, in SI units or degrees.
pub const SWEEPABLE: [&str; 5] = ["diameter", "speed", "angle_deg", "particle_temperature", "conversion"];

impl Injection {
    /// Reads a `[particles]` table.
    ///
    /// # Errors
    /// [`InputError::Fault`] for a missing or impossible state.
    pub fn read(
        section: &Section<'_>,
        burning: CarbonConversion,
        case_model: &Model,
        folder: &Path,
    ) -> Result<Self, InputError> {
        let needed = |key: &str, what: &str, low: f64, high: f64| {
            Distribution::read(section, key, low, high)?.ok_or_else(|| section.missing(key, what))
        };
        let or = |key: &str, low: f64, high: f64, default: Distribution| {
            Distribution::read(section, key, low, high).map(|given| given.unwrap_or(default))
        };
        let positive = f64::MIN_POSITIVE;
        let carbon = section.number_within("carbon", 0.0, 0.999)?.unwrap_or(burning.carbon);
        let heat_capacity = section.number_within("heat_capacity", positive, 1e6)?;
        let model = section.text("model")?.map(|name| model_file(section, &name, folder)).transpose()?;
        Ok(Self {
            name: section.text("name")?.unwrap_or_else(|| "particles".to_owned()),
            walls: same_walls(section, case_model, model.as_ref())?,
            model,
            count: read_count(section)?,
            place: ReleaseShape::read(&section.required_section("position")?)?,
            along: direction(section, "direction")?,
            diameter: needed("diameter", "a diameter [m]", positive, 1.0)?,
            speed: needed("speed", "a speed [m/s]", 0.0, 1e5)?,
            relative_to_gas: section.boolean("relative_to_gas")?.unwrap_or(false),
            angle: or("angle_deg", -90.0, 90.0, Distribution::fixed(90.0))?,
            azimuth: or("azimuth_deg", -360.0, 360.0, Distribution::uniform(0.0, 360.0))?,
            temperature: needed("temperature", "a temperature [K]", 1.0, 1e5)?,
            conversion: or("conversion", 0.0, 1.0, Distribution::fixed(1.0))?,
            density: section.number_within("density", positive, 1e6)?,
            conductivity: section.number_within("conductivity", positive, 1e5)?,
            fusion: read_fusion(section, heat_capacity)?,
            heat_capacity,
            radiation: read_radiation(section)?,
            weight: read_weight(section)?,
            burning: burning.with_carbon(carbon),
        })
    }

    /// The wall of this injection's model that stands for a wall of the case's model.
    pub(super) fn wall(&self, of_case: usize) -> usize {
        self.walls.get(of_case).copied().unwrap_or(of_case)
    }

    /// Density of the ash [kg/m³]: that of the case, else that of the model's ash near a
    /// temperature [K], else an assumed one.
    pub(super) fn ash_density(&self, model: &Model, temperature: f64) -> f64 {
        let of_model = || model.ash().and_then(|ash| ash.density_near(temperature).ok());
        self.burning.ash_density.or_else(of_model).unwrap_or(ASH_DENSITY)
    }

    /// What a particle of a diameter and a density before any carbon is gone [m, kg/m³] consists
    /// of, with the `temperature` [K] of its start.
    ///
    /// # Errors
    /// [`SimulationError`] when its ash does not fit into it, or when no melting point is known.
    pub(super) fn body(
        &self,
        diameter: f64,
        density: f64,
        temperature: f64,
        model: &Model,
    ) -> Result<Body, SimulationError> {
        let Self { heat_capacity, radiation, burning, .. } = *self;
        let mut ash_density = self.ash_density(model, temperature);
        if burning.ash_density.is_none() {
            // A density that the case does not state must not refuse a heavy particle.
            ash_density = ash_density.max((1.0 - burning.carbon) * density);
        }
        let shrinkage = Shrinkage::new(density, burning.carbon, burning.diameter_exponent, ash_density)?;
        let fusion = match self.fusion.zip(heat_capacity) {
            None => None,
            Some((keys, capacity)) => {
                let point = match keys.melting_point {
                    Some(point) => point,
                    None => melting_point(model, temperature)?,
                };
                Some(Fusion::new(keys.heat, capacity, point, keys.range))
            }
        };
        Ok(Body { diameter, density, shrinkage, heat_capacity, fusion, radiation, burning })
    }

    /// Draws the diameter [m] and the first state of the particle with this number. Its velocity is on top of the gas's
    /// where the case says so.
    pub fn draw(&self, seed: u64, number: u64) -> (f64, ParticleState) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(number);
        self.start(&mut random)
    }

    /// The diameter [m] and the first state that these numbers give.
    pub(super) fn start(&self, numbers: &mut impl StartNumbers) -> (f64, ParticleState) {
        let position = self.place.start(numbers);
        let diameter = numbers.of(&self.diameter);
        let speed = numbers.of(&self.speed);
        let angle = numbers.of(&self.angle).to_radians();
        let azimuth = numbers.of(&self.azimuth).to_radians();
        let [first, second] = across(&self.along);
        let sideways = first * azimuth.cos() + second * azimuth.sin();
        let velocity = speed * (self.along * angle.sin() + sideways * angle.cos());
        let (temperature, conversion) = (numbers.of(&self.temperature), numbers.of(&self.conversion));
        (diameter, state(&position, &velocity, temperature, conversion))
    }

    /// Whether any of its particles starts with carbon.
    pub(super) fn has_carbon(&self) -> bool {
        self.conversion.quantile(0.0) < 1.0
    }

    /// The middle of the place from which its particles come [m].
    pub(crate) fn release(&self) -> Vector3<f64> {
        match self.place {
            ReleaseShape::Point(point) => point,
            ReleaseShape::Disc { centre, .. } => centre,
        }
    }

    /// Centres one of [`SWEEPABLE`] on a value.
    pub(super) fn centre(&mut self, what: &str, value: f64) {
        let distribution = match what {
            "diameter" => &mut self.diameter,
            "speed" => &mut self.speed,
            "angle_deg" => &mut self.angle,
            "conversion" => &mut self.conversion,
            _ => &mut self.temperature,
        };
        *distribution = distribution.centred(value);
    }
}

impl ReleaseShape {
    fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let place = match section.choice("shape", &["point", "disc"])?.as_deref() {
            Some("point") => Self::Point(required_vector(section, "at")?),
            Some(_) => {
                let outer = required_within(section, "radius", 0.0, f64::INFINITY)?;
                let inner = section.number_within("inner_radius", 0.0, outer)?.unwrap_or(0.0);
                let centre = vector(section, "center")?;
                Self::Disc {
                    centre: centre.ok_or_else(|| section.missing("center", "[x, y, z] [m]"))?,
                    normal: direction(section, "normal")?,
                    radii: [inner, outer],
                }
            }
            None => return Err(section.missing("shape", "\"point\" or \"disc\"")),
        };
        section.finish()?;
        Ok(place)
    }

    /// Evenly over the area.
    fn start(&self, numbers: &mut impl StartNumbers) -> Vector3<f64> {
        match self {
            Self::Point(point) => *point,
            Self::Disc { centre, normal, radii: [inner, outer] } => {
                let share = numbers.share();
                let radius = (inner * inner + share * (outer * outer - inner * inner)).sqrt();
                let angle = TAU * numbers.share();
                let [first, second] = across(normal);
                centre + radius * (first * angle.cos() + second * angle.sin())
            }
        }
    }
}

/// The model file `name`, looked for in `folder`.
pub(super) fn model_file(section: &Section<'_>, name: &str, folder: &Path) -> Result<Model, InputError> {
    let path = folder.join(name);
    if !path.is_file() {
        let problem = format!("there is no file {}; the name is relative to the case file", path.display());
        return Err(section.fault("model", problem));
    }
    Model::from_file(&path)
}

/// Melting point [K] of the model's ash, or of its particle where it has none.
fn melting_point(model: &Model, temperature: f64) -> Result<f64, SimulationError> {
    let material = model.ash().unwrap_or_else(|| model.particle());
    let known = material.property("melting_point").and_then(|property| property.at(temperature).ok());
    known.ok_or_else(|| SimulationError::NoMeltingPoint(material.name().to_owned()))
}

/// For each wall of the case's model the one of the same name in `own`, else its `default`.
fn same_walls(
    section: &Section<'_>,
    case_model: &Model,
    own: Option<&Model>,
) -> Result<Vec<usize>, InputError> {
    let Some(own) = own else { return Ok((0..case_model.walls().len()).collect()) };
    let same = |name: &str| {
        let found = own.find_wall(name).or_else(|| own.find_wall("default"));
        found.ok_or_else(|| {
            section.fault("model", format!("has neither a wall `{name}` nor a wall `default`"))
        })
    };
    case_model.walls().iter().map(|wall| same(wall.name())).collect()
}

fn read_count(section: &Section<'_>) -> Result<u64, InputError> {
    let count = required_within(section, "count", 1.0, 1e8)?;
    if count.fract() != 0.0 {
        return Err(section.fault("count", "a whole number of particles"));
    }
    Ok(count as u64)
}

fn read_fusion(section: &Section<'_>, heat_capacity: Option<f64>) -> Result<Option<FusionKeys>, InputError> {
    let heat = section.number_within("heat_of_fusion", 0.0, 1e8)?;
    let melting_point = section.number_within("melting_point", 0.1, 5e4)?;
    let range = section.number_within("melting_range", 0.0, 1e4)?;
    let Some(heat) = heat else {
        let alone = [("melting_point", melting_point), ("melting_range", range)];
        return match alone.iter().find(|(_, value)| value.is_some()) {
            Some((key, _)) => Err(section.fault(key, "needs `heat_of_fusion`")),
            None => Ok(None),
        };
    };
    if heat_capacity.is_none() {
        return Err(
            section.missing("heat_capacity", "a heat capacity [J/(kg K)], which `heat_of_fusion` needs,")
        );
    }
    Ok(Some(FusionKeys { heat, melting_point, range: range.unwrap_or(0.0) }))
}

fn read_radiation(section: &Section<'_>) -> Result<Option<(f64, f64)>, InputError> {
    let emissivity = section.number_within("emissivity", 0.0, 1.0)?;
    let surroundings = section.number_within("radiation_temperature", 1.0, 1e5)?;
    match (emissivity, surroundings) {
        (Some(emissivity), Some(temperature)) => Ok(Some((emissivity, temperature))),
        (None, None) => Ok(None),
        (Some(_), None) => Err(section.missing("radiation_temperature", "the temperature around [K]")),
        (None, Some(_)) => Err(section.missing("emissivity", "a number 0 to 1")),
    }
}

fn read_weight(section: &Section<'_>) -> Result<ParticleWeight, InputError> {
    let mass = section.number_within("mass", f64::MIN_POSITIVE, f64::INFINITY)?;
    match (section.choice("sizes_count", &["particles", "mass"])?.as_deref(), mass) {
        (Some("mass"), Some(mass)) => Ok(ParticleWeight::EqualShare(mass)),
        (Some("mass"), None) => Err(section.missing("mass", "the mass of all particles [kg]")),
        (_, Some(_)) => Err(section.fault("mass", "needs `sizes_count = \"mass\"`")),
        (_, None) => Ok(ParticleWeight::One),
    }
}
