//! The laboratory: base systems, ranges of inputs, nuisance columns, noise, and the files.

use std::fmt::Write;

use crate::contact::{Body, Contact, Tangential};
use crate::set_rng::SetRng;
use crate::world::{Inputs, World};

/// Particles and target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum System {
    /// Montan wax on Pyrex.
    Wax,
    /// Tungsten dust on tungsten.
    Tungsten,
    /// Char on a brick.
    Char,
    /// Tungsten dust of 3000 K on tungsten of 1000 K.
    HotTungsten,
}

impl System {
    /// The base contact.
    pub fn contact(self) -> Contact {
        let body = |modulus, poisson| Body { modulus, poisson };
        let (particle, wall, density, yield_strength, yield_ratio, adhesion) = match self {
            Self::Wax => (body(700e6, 0.49), body(64e9, 0.2), 1000.0, 9.5e6, 0.7, 2.0 * 0.03_f64.sqrt()),
            Self::Tungsten => (body(398e9, 0.28), body(398e9, 0.28), 19250.0, 0.6e9, 2.8, 2.0 * 3.265),
            Self::Char => (body(1e9, 0.25), body(30e9, 0.2), 900.0, 11e6, 1.2, 2.0 * (0.05_f64 * 0.5).sqrt()),
            Self::HotTungsten => (body(190e9, 0.308), body(382e9, 0.287), 18290.0, 300e6, 2.8, 2.0 * 3.265),
        };
        Contact { particle, wall, density, yield_strength, yield_ratio, adhesion }
    }

    /// The model file of base and law.
    pub fn model(self, law: Tangential) -> String {
        self.model_of(&self.contact(), law)
    }

    /// The model file of another contact and law.
    pub fn model_of(self, contact: &Contact, law: Tangential) -> String {
        let (particle, wall) = match self {
            Self::Wax => ("montan-wax", "pyrex"),
            Self::Tungsten => ("w-dust", "w-dust"),
            Self::Char => ("char-bits", "brick"),
            Self::HotTungsten => ("w-dust", "w-plate"),
        };
        let law = match law {
            Tangential::Constant(e_t) => format!("model = \"constant\"\ne_t = {e_t}"),
            Tangential::Sliding { friction } => format!("model = \"sliding\"\nfriction = {friction}"),
            Tangential::SlidingRolling { friction } => {
                format!("model = \"sliding-rolling\"\nfriction = {friction}")
            }
        };
        let ratio = contact.yield_ratio;
        format!(
            "[particle]\nmaterial = \"{particle}\"\n\n[walls.default]\nmaterial = \"{wall}\"\n\n[normal]\n\
             model = \"thornton-ning\"\nyield_ratio = {ratio}\n\n[tangential]\n{law}\n{}",
            self.materials(contact)
        )
    }

    /// The materials that are not built in.
    fn materials(self, contact: &Contact) -> String {
        let Contact { particle, wall, density, yield_strength, .. } = *contact;
        let particle = |name, energy| material(name, density, particle, yield_strength, energy);
        match self {
            Self::Wax => String::new(),
            Self::Tungsten => particle("w-dust", 3.265),
            Self::Char => particle("char-bits", 0.05) + &material("brick", 3000.0, wall, 60e6, 0.5),
            Self::HotTungsten => {
                particle("w-dust", 3.265) + &material("w-plate", 19050.0, wall, 800e6, 3.265)
            }
        }
    }
}

/// A material of a model file.
fn material(name: &str, density: f64, body: Body, yield_strength: f64, surface_energy: f64) -> String {
    let Body { modulus, poisson } = body;
    format!(
        "\n[materials.{name}]\ndensity = {density}\nyoungs_modulus = {modulus:e}\npoisson_ratio = {poisson}\n\
         yield_strength = {yield_strength:e}\nsurface_energy = {surface_energy}\nsource = \"assumed\"\n"
    )
}

type Range = (f64, f64);

/// How the noise depends on the row, in null sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spread {
    /// The same everywhere.
    Even,
    /// Drawn for each row.
    Random,
    /// Grows with the normal speed.
    WithSpeed,
    /// Grows with a nuisance column.
    WithForeign,
}

/// A campaign: ranges of what is varied, and noise.
#[derive(Clone, Debug)]
pub struct Campaign {
    pub system: System,
    pub law: Tangential,
    pub rows: usize,
    pub v_n: Range,
    /// Angle from the normal, degrees.
    pub theta: Range,
    pub d: Range,
    pub t_p: Range,
    pub t_w: Range,
    pub v_gas: Range,
    pub layer: Range,
    pub film: Range,
    pub roughness: Range,
    pub conversion: Range,
    /// Known input columns that are written, beyond v_n v_t d T_p.
    pub columns: Vec<&'static str>,
    /// Further columns that are written.
    pub extras: Vec<&'static str>,
    /// The input that the foreign number is correlated with, if any.
    pub decoy: Option<Decoy>,
    pub noise_e_n: f64,
    pub noise_e_t: f64,
    pub spread: Spread,
    /// Share of gross outliers.
    pub outliers: f64,
    /// Share of blank observations.
    pub blanks: f64,
    /// Broken rows to mix in.
    pub broken: usize,
    /// Series that replace the common ranges, if any.
    pub series: Vec<Series>,
}

/// Correlation of a decoy with its input.
pub const CORRELATION: f64 = 0.85;

/// The input that the foreign number is correlated with, its mean and deviation.
#[derive(Clone, Copy, Debug)]
pub struct Decoy {
    pub input: &'static str,
    pub mean: f64,
    pub deviation: f64,
}

/// One series of a campaign.
#[derive(Clone, Copy, Debug)]
pub struct Series {
    pub rows: usize,
    pub v_n: Range,
    /// Least, mean and largest angle from the normal, degrees.
    pub theta: (f64, f64, f64),
    pub d: Range,
    pub t_p: f64,
}

impl Series {
    /// An angle with the stated mean, between the ends.
    fn angle(&self, rng: &mut SetRng) -> f64 {
        let (low, mean, high) = self.theta;
        low + (high - low) * rng.unit().powf((high - low) / (mean - low) - 1.0)
    }

    /// One impact of the series.
    fn inputs(&self, group: usize, common: Inputs, rng: &mut SetRng) -> Inputs {
        let v_n = rng.log_uniform(self.v_n);
        let v_t = v_n * self.angle(rng).max(0.5).to_radians().tan();
        Inputs { v_n, v_t, d: rng.uniform(self.d), t_p: self.t_p, t_w: 1000.0, group, ..common }
    }
}

/// Inputs that a campaign can vary beside v_n, v_t, d and T_p.
pub const KNOWN: [&str; 6] = ["T_w", "v_gas", "layer_thickness", "film_thickness", "roughness", "conversion"];

/// Columns that no model knows.
pub const FOREIGN: [&str; 12] = [
    "humidity",
    "batch",
    "day",
    "operator",
    "lens",
    "pressure",
    "voltage",
    "camera_gain",
    "frame",
    "note",
    "room_temperature",
    "plate_id",
];

impl Campaign {
    /// A campaign on this system, with irrelevant inputs chosen at random.
    pub fn new(system: System, law: Tangential, rng: &mut SetRng) -> Self {
        let (v_n, d, t_p) = match system {
            System::Wax => ((0.3, 5.0), (50e-6, 120e-6), (290.0, 320.0)),
            System::Tungsten => ((0.5, 13.0), (5e-6, 20e-6), (290.0, 320.0)),
            System::HotTungsten => ((0.5, 13.0), (8e-6, 16e-6), (2900.0, 3000.0)),
            System::Char => ((0.5, 6.0), (40e-6, 120e-6), (1500.0, 1700.0)),
        };
        let noise_e_n = rng.uniform((0.02, 0.08));
        let columns = KNOWN.into_iter().filter(|_| rng.chance(0.6)).collect();
        let extras = FOREIGN[2..].iter().copied().filter(|_| rng.chance(0.25)).collect();
        Self {
            system,
            law,
            rows: 250 + rng.below(751),
            v_n,
            theta: (5.0, 70.0),
            d,
            t_p,
            t_w: (285.0, 305.0),
            v_gas: (0.0, 15.0),
            layer: (1e-5, 4e-4),
            film: (1e-6, 5e-5),
            roughness: (1e-8, 1e-6),
            conversion: (0.0, 1.0),
            columns,
            extras,
            decoy: None,
            noise_e_n,
            noise_e_t: noise_e_n * rng.uniform((0.6, 1.0)),
            spread: Spread::Even,
            outliers: 0.0,
            blanks: 0.0,
            broken: 0,
            series: vec![],
        }
    }

    /// Makes sure that a known or foreign column is written.
    pub fn needs(&mut self, column: &'static str) {
        let list = if KNOWN.contains(&column) { &mut self.columns } else { &mut self.extras };
        if column != "d" && column != "T_p" && !list.contains(&column) {
            list.push(column);
        }
    }

    /// Draws the inputs of one impact.
    pub fn inputs(&self, rng: &mut SetRng) -> Inputs {
        let v_n = rng.log_uniform(self.v_n);
        let v_t = v_n * rng.uniform(self.theta).to_radians().tan();
        let mut x = Inputs {
            v_n,
            v_t,
            d: rng.log_uniform(self.d),
            t_p: rng.uniform(self.t_p),
            t_w: rng.uniform(self.t_w),
            v_gas: rng.uniform(self.v_gas),
            layer: sometimes(rng, self.layer),
            film: sometimes(rng, self.film),
            roughness: sometimes(rng, self.roughness),
            conversion: rng.uniform(self.conversion),
            foreign: rng.uniform((10.0, 90.0)),
            group: rng.below(4),
        };
        if let Some(decoy) = self.decoy {
            let part = (x.value(decoy.input) - decoy.mean) / decoy.deviation;
            let own = (1.0 - CORRELATION * CORRELATION).sqrt() * rng.normal();
            x.foreign = 50.0 + 10.0 * (CORRELATION * part + own);
        }
        x
    }

    /// Correlates the foreign number with an input.
    pub fn follow(&mut self, input: &'static str, rng: &mut SetRng) {
        let values: Vec<f64> = (0..4000).map(|_| self.inputs(rng).value(input)).collect();
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let deviation = (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt();
        self.decoy = Some(Decoy { input, mean, deviation });
    }

    /// Measures one impact.
    pub fn measure(&self, world: &World, x: Inputs, rng: &mut SetRng) -> Row {
        let r = world.truth(&x, [rng.unit(), rng.unit()]);
        let stuck = rng.chance(r.stick);
        let size = match self.spread {
            Spread::Even => 1.0,
            Spread::Random => rng.log_uniform((0.3, 2.5)),
            Spread::WithSpeed => 0.3 + 1.7 * (x.v_n / self.v_n.0).ln() / (self.v_n.1 / self.v_n.0).ln(),
            Spread::WithForeign => 0.3 + 1.7 * (x.foreign - 10.0) / 80.0,
        };
        let mut e_n = r.e_n + rng.noise(r.e_n, size * self.noise_e_n);
        let mut e_t = r.e_t + rng.noise(r.e_t, size * self.noise_e_t);
        if rng.chance(self.outliers) {
            e_n = outlier(e_n, rng);
            e_t = outlier(e_t, rng);
        }
        let mut shown = |value: f64| (!stuck && !rng.chance(self.blanks)).then_some(value);
        let (e_n, e_t) = (shown(e_n), shown(e_t));
        Row { x, stuck, e_n, e_t, outcome: e_n.is_none() || !rng.chance(self.blanks) }
    }

    /// Draws all impacts.
    pub fn impacts(&self, rng: &mut SetRng) -> Vec<Inputs> {
        if self.series.is_empty() {
            return (0..self.rows).map(|_| self.inputs(rng)).collect();
        }
        let mut all = vec![];
        for (group, series) in self.series.iter().enumerate() {
            for _ in 0..series.rows {
                let common = self.inputs(rng);
                all.push(series.inputs(group, common, rng));
            }
        }
        all
    }

    /// Measures the whole campaign.
    pub fn run(&self, world: &World, rng: &mut SetRng) -> Vec<Row> {
        self.impacts(rng).into_iter().map(|x| self.measure(world, x, rng)).collect()
    }

    /// The names of the input columns, in order.
    pub fn header(&self) -> Vec<&'static str> {
        ["v_n", "v_t", "d", "T_p"]
            .into_iter()
            .chain(self.columns.clone())
            .chain(self.extras.clone())
            .collect()
    }

    /// The file of inputs alone.
    pub fn inputs_csv(&self, inputs: &[Inputs]) -> String {
        let mut rng = SetRng::new(0, "cells");
        let mut text = self.header().join(",");
        for x in inputs {
            let cells: Vec<_> = self.header().iter().map(|column| cell(column, x, &mut rng)).collect();
            write!(text, "\n{}", cells.join(",")).unwrap();
        }
        text + "\n"
    }

    /// The file of a campaign, and the lines of its invalid rows.
    pub fn csv(&self, rows: &[Row], rng: &mut SetRng) -> (String, Vec<usize>) {
        let mut lines: Vec<_> = rows.iter().map(|row| (self.line(row, rng), false)).collect();
        for kind in 0..self.broken {
            let at = rng.below(lines.len());
            let line = self.broken_line(&rows[at % rows.len()], kind, rng);
            lines.insert(at, (line, true));
        }
        let mut text = format!("{},e_n,e_t,outcome", self.header().join(","));
        for (line, _) in &lines {
            write!(text, "\n{line}").unwrap();
        }
        let broken = lines.iter().enumerate().filter(|(_, line)| line.1).map(|(i, _)| i + 2).collect();
        (text + "\n", broken)
    }

    fn line(&self, row: &Row, rng: &mut SetRng) -> String {
        let mut cells: Vec<_> = self.header().iter().map(|column| cell(column, &row.x, rng)).collect();
        let number = |value: Option<f64>| value.map(|value| format!("{value:.4}")).unwrap_or_default();
        cells.extend([number(row.e_n), number(row.e_t)]);
        let outcome = if row.stuck { "stick" } else { "rebound" };
        cells.push(if row.outcome { outcome.into() } else { String::new() });
        cells.join(",")
    }

    /// A row that cannot be used, of one of six kinds.
    fn broken_line(&self, row: &Row, kind: usize, rng: &mut SetRng) -> String {
        let rebound = Row { stuck: false, e_n: Some(0.3), e_t: Some(0.7), outcome: true, ..*row };
        let line = self.line(&rebound, rng);
        let mut cells: Vec<String> = line.split(',').map(String::from).collect();
        let (e_n, outcome) = (cells.len() - 3, cells.len() - 1);
        match kind % 6 {
            0 => cells[0] = "fast".into(),
            1 => cells[e_n] = "-0.31".into(),
            2 => cells[0] = String::new(),
            3 => cells[outcome] = "perhaps".into(),
            4 => cells[2] = "-8e-5".into(),
            _ => cells[0] = "-1.5".into(),
        }
        cells.join(",")
    }
}

/// 0 in four of ten cases, else log-uniform.
fn sometimes(rng: &mut SetRng, range: Range) -> f64 {
    if rng.chance(0.4) { 0.0 } else { rng.log_uniform(range) }
}

/// A slipped decimal point, a wrong particle, or anything.
fn outlier(value: f64, rng: &mut SetRng) -> f64 {
    match rng.below(4) {
        0 => value * 10.0,
        1 => value / 10.0,
        _ => rng.uniform((0.02, 1.2)),
    }
}

/// A cell of an input column.
pub fn cell(column: &str, x: &Inputs, rng: &mut SetRng) -> String {
    let pick = |names: &[&str], rng: &mut SetRng| names[rng.below(names.len())].to_string();
    match column {
        "v_n" => format!("{:e}", x.v_n),
        "v_t" => format!("{:e}", x.v_t),
        "d" => format!("{:e}", x.d),
        "T_p" => x.t_p.to_string(),
        "T_w" => x.t_w.to_string(),
        "v_gas" => x.v_gas.to_string(),
        "layer_thickness" => format!("{:e}", x.layer),
        "film_thickness" => format!("{:e}", x.film),
        "roughness" => format!("{:e}", x.roughness),
        "conversion" => x.conversion.to_string(),
        "humidity" => format!("{:.3}", x.foreign),
        "series" => format!("set{}", x.group + 1),
        "batch" => format!("lot-{}", ["K", "M", "Q", "T"][x.group]),
        "operator" => pick(&["anna", "bo", "chen"], rng),
        "note" => pick(&["", "", "", "ok", "blurred"], rng),
        "plate_id" => pick(&["P1", "P2", "P3", "P4", "P5", "P6"], rng),
        "day" => (1 + rng.below(5)).to_string(),
        "lens" => pick(&["50", "85", "105"], rng),
        "frame" => rng.below(100_000).to_string(),
        _ => format!("{:.4}", 10.0 + rng.normal()),
    }
}

/// One measured impact.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    pub x: Inputs,
    pub stuck: bool,
    pub e_n: Option<f64>,
    pub e_t: Option<f64>,
    /// Whether the outcome is written.
    pub outcome: bool,
}
