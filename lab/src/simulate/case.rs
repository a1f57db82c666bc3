//! A case file, which contains everything that a run depends on.

use std::path::Path;

use nalgebra::Vector3;

use super::conversion::CarbonConversion;
use super::deposit_settings::DepositSettings;
use super::error::SimulationError;
use super::gas::Gas;
use super::geometry::{vector, whole};
use super::injection::{Injection, SWEEPABLE, model_file};
use super::linear_profile::LinearProfile;
use super::stated_error::split_errors;
use super::surface::{Surface, SurfaceKind, SurfaceShape};
use nearwall::impact::ImpactError;
use nearwall::input::{Document, InputError, Section};
use nearwall::model::{Model, Wall};

/// Number of low bits of the key of random draws that count the hits of a particle.
pub(super) const HIT_BITS: u32 = 24;
/// Gap up to which a particle is near a wall, over the mean diameter of the particles.
const NEAR_WALL_DIAMETERS: f64 = 5.0;

/// Everything that a run depends on. Only a sweep changes it after reading.
#[derive(Debug)]
pub struct Case {
    /// Title of the page.
    pub title: String,
    /// One or more sentences for the page.
    pub about: Option<String>,
    /// Seed of all draws.
    pub seed: u64,
    /// Longest time that a particle is followed [s].
    pub time_limit: f64,
    /// Largest number of hits of one particle.
    pub hit_limit: u64,
    /// Relative error per step of the integration [1].
    pub tolerance: f64,
    /// Gravity [m/s²].
    pub gravity: Vector3<f64>,
    /// The gas.
    pub gas: Gas,
    /// Where particles come from, one or more.
    pub injections: Vec<Injection>,
    /// Walls and exits.
    pub surfaces: Vec<Surface>,
    /// The impact model of injections without their own.
    pub model: Model,
    /// The memory of the walls, if they keep one.
    pub deposit: Option<DepositSettings>,
    /// Gap between particle and wall [m] up to which a particle is near the wall.
    pub near_wall_distance: f64,
    /// Largest number of rows of `impacts.csv`.
    pub recorded: u64,
    /// A quantity that is varied over a list of values.
    pub sweep: Option<Sweep>,
}

/// A `[sweep]`: the case is run once for each value.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// The swept quantity, one of [`SWEEP_KEYS`].
    pub key: String,
    /// The values, SI or degrees.
    pub values: Vec<f64>,
    /// Measured or computed points to show beside the result.
    pub references: Vec<SweepReference>,
}

/// Points to show beside a sweep's result.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepReference {
    /// `capture` (share of hits) or `e_n`.
    pub quantity: String,
    /// Values of the swept quantity.
    pub at: Vec<f64>,
    /// Values of the quantity.
    pub value: Vec<f64>,
    /// Their source.
    pub source: String,
}

/// Quantities that a sweep can change. `temperature` sets gas, particles and walls.
pub const SWEEP_KEYS: [&str; 8] = {
    let [diameter, speed, angle, particle, conversion] = SWEEPABLE;
    ["temperature", "gas_temperature", "wall_temperature", diameter, speed, angle, particle, conversion]
};

/// The unit of one of [`SWEEP_KEYS`].
pub fn sweep_unit(key: &str) -> &'static str {
    unit_and_range(key).0
}

/// The unit of one of [`SWEEP_KEYS`] and the values that it may have.
fn unit_and_range(key: &str) -> (&'static str, [f64; 2]) {
    match key {
        "diameter" => ("m", [f64::MIN_POSITIVE, 1.0]),
        "speed" => ("m/s", [0.0, 1e5]),
        "angle_deg" => ("°", [-90.0, 90.0]),
        "conversion" => ("1", [0.0, 1.0]),
        _ => ("K", [1.0, 1e5]),
    }
}

impl Case {
    /// Reads a case file; a model file that it names is looked for beside it.
    ///
    /// # Errors
    /// [`InputError`] naming file, line, column and key.
    pub fn from_file(path: &Path) -> Result<Self, InputError> {
        let folder = path.parent().unwrap_or(Path::new(""));
        let document = Document::from_file(path)?;
        Self::from_toml(document.name(), document.text(), folder)
    }

    /// Reads a case from text; `name` stands for the file in messages, model files are looked for in `folder`.
    ///
    /// # Errors
    /// [`InputError`] naming line, column and key.
    pub fn from_toml(name: &str, text: &str, folder: &Path) -> Result<Self, InputError> {
        // What the instruments state of their errors is no part of a simulation.
        let (text, _) = split_errors(text);
        Document::new(name, text).read(|top| Self::read(top, folder))
    }

    /// Whether some particles have a model file of their own.
    pub fn has_own_models(&self) -> bool {
        self.injections.iter().any(|injection| injection.model.is_some())
    }

    /// Whether any particle starts with carbon.
    pub fn has_carbon(&self) -> bool {
        self.injections.iter().any(Injection::has_carbon)
    }

    fn read(top: &Section<'_>, folder: &Path) -> Result<Self, InputError> {
        let title = top.text("title")?.unwrap_or_else(|| "Standalone case".to_owned());
        let about = top.text("about")?;
        let model = read_model(top, folder)?;
        let burning =
            top.section("conversion")?.map_or(Ok(CarbonConversion::NONE), |s| CarbonConversion::read(&s))?;
        let gas_section = top.required_section("gas")?;
        let gas = Gas::read(&gas_section)?;
        let sweep = top.section("sweep")?.map(|s| read_sweep(&s)).transpose()?;
        check_temperatures(top, &gas_section, &gas, sweep.as_ref())?;
        gas_section.finish()?;
        let injections = read_injections(top, burning, &model, folder)?;
        let surfaces = Surface::read_all(top, &model)?;
        let deposit = top.section("deposit")?.map(|s| DepositSettings::read(&s, &surfaces)).transpose()?;
        let run = top.required_section("run")?;
        let hit_limit = whole(&run, "hit_limit", (1u64 << HIT_BITS) as f64)?.unwrap_or(1000);
        let time_limit = run.number_within("time_limit", f64::MIN_POSITIVE, f64::INFINITY)?;
        let near_wall_distance = run.number_within("near_wall_distance", f64::MIN_POSITIVE, f64::INFINITY)?;
        let seed = whole(&run, "seed", 2f64.powi(53))?.unwrap_or(1);
        let case = Self {
            title,
            about,
            seed,
            time_limit: time_limit.ok_or_else(|| run.missing("time_limit", "a time [s]"))?,
            hit_limit,
            tolerance: run.number_within("tolerance", 1e-13, 1e-3)?.unwrap_or(1e-6),
            gravity: vector(&run, "gravity")?.unwrap_or(Vector3::new(0.0, 0.0, -9.81)),
            recorded: whole(&run, "recorded_impacts", 1e9)?.unwrap_or(100_000),
            near_wall_distance: near_wall_distance
                .unwrap_or_else(|| NEAR_WALL_DIAMETERS * mean_diameter(&injections, seed)),
            gas,
            injections,
            surfaces,
            deposit,
            sweep,
            model,
        };
        case.check_walls(top, &run)?;
        run.finish()?;
        Ok(case)
    }

    /// Checks that a cooled wall has a deposit, and that gravity does not point across a pipe that sheds its deposit.
    fn check_walls(&self, top: &Section<'_>, run: &Section<'_>) -> Result<(), InputError> {
        let sideways = self.gravity.xy().norm() > 0.0;
        let sheds = |wall: &Wall| wall.processes().any(|(_, process)| process.name == "shedding");
        for Surface { name, shape, kind } in &self.surfaces {
            let SurfaceKind::Wall { model, cooling, .. } = kind else { continue };
            if cooling.is_some() && self.deposit.is_none() {
                let problem = format!(
                    "the temperature of the cooled wall `{name}` follows from its deposit; add a table [deposit]"
                );
                return Err(top.fault("walls", problem));
            }
            let is_pipe = matches!(shape, SurfaceShape::Pipe { .. });
            if is_pipe && sideways && self.deposit.is_some() && sheds(&self.model.walls()[*model]) {
                let problem = format!(
                    "pulls across the pipe `{name}`, whose bins go all around it and cannot tell above from below; \
                     a wall with `shedding` needs a pipe along gravity, or the shape \"plane\""
                );
                return Err(run.fault("gravity", problem));
            }
        }
        Ok(())
    }

    /// Number of all particles.
    pub fn count(&self) -> u64 {
        self.injections.iter().map(|injection| injection.count).sum()
    }

    /// The impact model of an injection.
    pub fn model_of<'a>(&'a self, injection: &'a Injection) -> &'a Model {
        injection.model.as_ref().unwrap_or(&self.model)
    }

    /// The injection that a particle comes from, by its index, and its number among the injection's
    /// particles. Particles are numbered through all injections, in their order.
    pub(super) fn origin(&self, number: u64) -> Option<(usize, u64)> {
        let mut own = number;
        for (index, injection) in self.injections.iter().enumerate() {
            if own < injection.count {
                return Some((index, own));
            }
            own -= injection.count;
        }
        None
    }

    /// Density of an unburnt particle [kg/m³] that starts at a temperature [K].
    ///
    /// # Errors
    /// [`ImpactError::OutOfRange`] when neither the case nor the model gives it at this temperature.
    pub fn density(&self, injection: &Injection, temperature: f64) -> Result<f64, ImpactError> {
        injection.density.map_or_else(|| self.model_of(injection).particle().density(temperature), Ok)
    }

    /// Sets the swept quantity.
    ///
    /// # Errors
    /// [`SimulationError`] for a temperature that the gas or a cooled wall cannot have.
    pub fn set(&mut self, key: &str, value: f64) -> Result<(), SimulationError> {
        let everything = key == "temperature";
        if everything || key == "gas_temperature" {
            self.gas.set_temperature(value)?;
        }
        if everything || key == "wall_temperature" {
            for surface in &mut self.surfaces {
                if let SurfaceKind::Wall { temperature, cooling, .. } = &mut surface.kind {
                    if cooling.is_some() {
                        return Err(SimulationError::CooledWall(surface.name.clone()));
                    }
                    *temperature = LinearProfile::constant(value);
                }
            }
        }
        for injection in &mut self.injections {
            if everything {
                injection.centre("particle_temperature", value);
            } else if SWEEPABLE.contains(&key) {
                injection.centre(key, value);
            }
        }
        Ok(())
    }
}

/// Checks before the first run that the gas is known at its temperatures, or at those that a sweep puts in their place.
fn check_temperatures(
    top: &Section<'_>,
    section: &Section<'_>,
    gas: &Gas,
    sweep: Option<&Sweep>,
) -> Result<(), InputError> {
    match sweep.filter(|sweep| ["temperature", "gas_temperature"].contains(&sweep.key.as_str())) {
        None => gas.check(section),
        Some(sweep) => sweep
            .values
            .iter()
            .try_for_each(|value| gas.known_at(*value).map_err(|problem| top.fault("sweep", problem))),
    }
}

/// `model = "file.toml"` beside the case, or the tables of a model in `[model]`.
fn read_model(top: &Section<'_>, folder: &Path) -> Result<Model, InputError> {
    if top.is_section("model") {
        let section = top.required_section("model")?;
        let model = Model::read_section(&section)?;
        section.finish()?;
        return Ok(model);
    }
    let named = top.text("model")?;
    let named = named.ok_or_else(|| top.missing("model", "the model file, or a table [model],"))?;
    model_file(top, &named, folder)
}

/// One `[particles]`, or several `[[particles]]` with names.
fn read_injections(
    top: &Section<'_>,
    burning: CarbonConversion,
    model: &Model,
    folder: &Path,
) -> Result<Vec<Injection>, InputError> {
    let read = |section: &Section<'_>| {
        let injection = Injection::read(section, burning, model, folder)?;
        section.finish()?;
        Ok(injection)
    };
    if !top.has("particles") || top.is_section("particles") {
        return Ok(vec![read(&top.required_section("particles")?)?]);
    }
    let sections = top.sections("particles")?;
    if sections.is_empty() {
        return Err(top.missing("particles", "at least one [[particles]]"));
    }
    let mut injections: Vec<Injection> = Vec::new();
    for section in &sections {
        let injection = read(section)?;
        section.required_text("name")?;
        if injections.iter().any(|earlier| earlier.name == injection.name) {
            let problem = format!("the name `{}` is given twice; rename one", injection.name);
            return Err(section.fault("name", problem));
        }
        if let Some(first) = injections.first()
            && std::mem::discriminant(&first.weight) != std::mem::discriminant(&injection.weight)
        {
            let problem = "has to be the same in all [[particles]], so that their masses can be compared";
            return Err(section.fault("sizes_count", problem));
        }
        injections.push(injection);
    }
    Ok(injections)
}

/// Mean diameter [m] of the first thousand particles of each injection.
fn mean_diameter(injections: &[Injection], seed: u64) -> f64 {
    let drawn = |injection: &Injection| {
        let numbers = 0..injection.count.min(1000);
        let sum: f64 = numbers.clone().map(|number| injection.draw(seed, number).0).sum();
        (sum, numbers.end as f64)
    };
    let (sum, count) =
        injections.iter().map(drawn).fold((0.0, 0.0), |(a, b), (sum, count)| (a + sum, b + count));
    sum / count
}

fn read_sweep(section: &Section<'_>) -> Result<Sweep, InputError> {
    let key = section.choice("key", &SWEEP_KEYS)?;
    let key = key.ok_or_else(|| section.missing("key", &format!("one of {}", SWEEP_KEYS.join(", "))))?;
    let values = section.numbers("values")?.unwrap_or_default();
    if values.is_empty() {
        return Err(section.missing("values", "a list of numbers"));
    }
    let (_, [low, high]) = unit_and_range(&key);
    if let Some(value) = values.iter().find(|value| !(low..=high).contains(*value)) {
        return Err(section.fault("values", format!("{value} is outside {low} to {high}")));
    }
    let references = section.sections("reference")?;
    let references = references.iter().map(read_reference).collect::<Result<_, _>>()?;
    section.finish()?;
    Ok(Sweep { key, values, references })
}

fn read_reference(section: &Section<'_>) -> Result<SweepReference, InputError> {
    let quantity = section.choice("quantity", &["capture", "e_n"])?;
    let list = |key: &str| section.numbers(key)?.ok_or_else(|| section.missing(key, "a list of numbers"));
    let reference = SweepReference {
        quantity: quantity.ok_or_else(|| section.missing("quantity", "\"capture\" or \"e_n\""))?,
        at: list("at")?,
        value: list("value")?,
        source: section.required_text("source")?,
    };
    section.finish()?;
    if reference.at.len() != reference.value.len() {
        return Err(section.fault("value", "`at` and `value` need the same number of entries"));
    }
    Ok(reference)
}
