//! The particles of a rig: distributions of their states, and the settings that an experiment changes.

use crate::set_rng::SetRng;
use crate::world::Inputs;

/// How a state is distributed over the particles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spread {
    /// Every particle has the same value.
    Fixed,
    /// Normal, with a deviation, within two deviations.
    Normal { deviation: f64 },
    /// Even, this far to both sides.
    Uniform { half: f64 },
    /// `F(x) = 1 - exp(-(x/scale)^exponent)` between these bounds.
    RosinRammler { exponent: f64, min: f64, max: f64 },
}

/// One state: its middle and its spread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    pub middle: f64,
    pub spread: Spread,
    /// Bounds of a normal distribution.
    pub bounds: (f64, f64),
    /// Standard error of the middle, if the case states one.
    pub error: Option<f64>,
}

impl State {
    /// The same for every particle.
    pub fn fixed(middle: f64) -> Self {
        Self { middle, spread: Spread::Fixed, bounds: (f64::NEG_INFINITY, f64::INFINITY), error: None }
    }

    /// Normal between bounds that do not move with the mean.
    pub fn normal(middle: f64, deviation: f64, bounds: (f64, f64)) -> Self {
        Self { middle, spread: Spread::Normal { deviation }, bounds, error: None }
    }

    fn draw(&self, rng: &mut SetRng) -> f64 {
        let middle = self.middle;
        match self.spread {
            Spread::Fixed => middle,
            Spread::Uniform { half } => rng.uniform((middle - half, middle + half)),
            Spread::Normal { deviation } => within(self.bounds, || deviation.mul_add(rng.normal(), middle)),
            Spread::RosinRammler { exponent, min, max } => {
                within((min, max), || middle * (-(1.0 - rng.unit()).ln()).powf(1.0 / exponent))
            }
        }
    }

    /// The value of its key in a case file.
    fn toml(&self) -> String {
        let Self { middle, spread, bounds: (low, high), error } = self;
        let keys = match spread {
            Spread::Fixed if error.is_none() => return format!("{middle:e}"),
            Spread::Fixed => format!("value = {middle:e}"),
            Spread::Uniform { half } => {
                let (min, max) = (middle - half, middle + half);
                format!("distribution = \"uniform\", min = {min:e}, max = {max:e}")
            }
            Spread::Normal { deviation } => format!(
                "distribution = \"normal\", mean = {middle:e}, deviation = {deviation:e}, min = {low:e}, \
                 max = {high:e}"
            ),
            Spread::RosinRammler { exponent, min, max } => format!(
                "distribution = \"rosin-rammler\", scale = {middle:e}, exponent = {exponent}, min = {min:e}, \
                 max = {max:e}"
            ),
        };
        let stated = error.map_or(String::new(), |error| format!(", error = {error:e}"));
        format!("{{ {keys}{stated} }}")
    }

    /// The end of the key that a setting names.
    fn key(&self) -> &'static str {
        match self.spread {
            Spread::Fixed => "",
            Spread::Normal { .. } => ".mean",
            Spread::RosinRammler { .. } => ".scale",
            Spread::Uniform { .. } => panic!("a uniform distribution has no middle to set"),
        }
    }
}

/// Drawn again until it lies within the bounds.
fn within((low, high): (f64, f64), mut draw: impl FnMut() -> f64) -> f64 {
    (0..100_000).map(|_| draw()).find(|value| (low..=high).contains(value)).unwrap()
}

/// What an experiment sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Knob {
    Speed,
    Angle,
    Size,
    Temperature,
    Conversion,
    WallTemperature,
    Layer,
    GasSpeed,
    /// The gas is so thin that its temperature does nothing.
    GasTemperature,
}

/// The particles, and what they meet.
#[derive(Clone, Debug)]
pub struct Source {
    pub speed: State,
    /// Degrees from the wall.
    pub angle: State,
    pub diameter: State,
    pub temperature: State,
    pub conversion: f64,
    pub wall_temperature: f64,
    pub layer: f64,
    pub gas_speed: f64,
    pub gas_temperature: f64,
    /// How far beside and above the stated place particles really start, m.
    pub offset: [f64; 2],
}

/// A particle at its start.
#[derive(Clone, Copy, Debug)]
pub struct Particle {
    pub speed: f64,
    /// Radians from the wall.
    pub angle: f64,
    pub azimuth: f64,
    /// How far beside and above the stated place it starts, m.
    pub offset: [f64; 2],
    /// All that an impact needs, but the velocity.
    pub inputs: Inputs,
    /// Seed of its random draws.
    pub seed: u64,
}

impl Source {
    /// The column of a setting.
    pub fn key(&self, knob: Knob) -> String {
        match knob {
            Knob::Speed => format!("particles.speed{}", self.speed.key()),
            Knob::Angle => format!("particles.angle_deg{}", self.angle.key()),
            Knob::Size => format!("particles.diameter{}", self.diameter.key()),
            Knob::Temperature => format!("particles.temperature{}", self.temperature.key()),
            Knob::Conversion => "particles.conversion".into(),
            Knob::WallTemperature => "walls.target.temperature".into(),
            Knob::Layer => "model.walls.default.layer_thickness".into(),
            Knob::GasSpeed => "gas.velocity".into(),
            Knob::GasTemperature => "gas.temperature".into(),
        }
    }

    /// The cell of a setting.
    pub fn cell(knob: Knob, value: f64) -> String {
        if knob == Knob::GasSpeed { format!("\"[{value:e}, 0, 0]\"") } else { format!("{value:e}") }
    }

    /// The value in such a cell.
    pub fn value(cell: &str) -> f64 {
        cell.trim_start_matches('[').split(',').next().unwrap().parse().unwrap()
    }

    /// The present value of a setting.
    pub fn get(&self, knob: Knob) -> f64 {
        match knob {
            Knob::Speed => self.speed.middle,
            Knob::Angle => self.angle.middle,
            Knob::Size => self.diameter.middle,
            Knob::Temperature => self.temperature.middle,
            Knob::Conversion => self.conversion,
            Knob::WallTemperature => self.wall_temperature,
            Knob::Layer => self.layer,
            Knob::GasSpeed => self.gas_speed,
            Knob::GasTemperature => self.gas_temperature,
        }
    }

    /// Applies a setting.
    pub fn set(&mut self, knob: Knob, value: f64) {
        *match knob {
            Knob::Speed => &mut self.speed.middle,
            Knob::Angle => &mut self.angle.middle,
            Knob::Size => &mut self.diameter.middle,
            Knob::Temperature => &mut self.temperature.middle,
            Knob::Conversion => &mut self.conversion,
            Knob::WallTemperature => &mut self.wall_temperature,
            Knob::Layer => &mut self.layer,
            Knob::GasSpeed => &mut self.gas_speed,
            Knob::GasTemperature => &mut self.gas_temperature,
        } = value;
    }

    /// Draws a particle.
    pub fn draw(&self, rng: &mut SetRng) -> Particle {
        let inputs = Inputs {
            d: self.diameter.draw(rng),
            t_p: self.temperature.draw(rng),
            t_w: self.wall_temperature,
            v_gas: self.gas_speed,
            layer: self.layer,
            conversion: self.conversion,
            ..Inputs::default()
        };
        Particle {
            speed: self.speed.draw(rng),
            angle: self.angle.draw(rng).to_radians(),
            azimuth: rng.uniform((0.0, std::f64::consts::TAU)),
            offset: self.offset,
            inputs,
            seed: (rng.unit() * 2_f64.powi(53)) as u64,
        }
    }

    /// The states in `[particles]` of a case file.
    pub fn toml(&self) -> String {
        let Self { speed, angle, diameter, temperature, conversion, .. } = self;
        format!(
            "diameter = {}\nspeed = {}\nangle_deg = {}\ntemperature = {}\nconversion = {conversion:e}\n",
            diameter.toml(),
            speed.toml(),
            angle.toml(),
            temperature.toml()
        )
    }
}
