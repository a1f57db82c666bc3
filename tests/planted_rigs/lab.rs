//! A laboratory with a rig: what it varies, what it reads, and how it errs.

use std::fmt::Write;

use crate::campaign::System;
use crate::contact::Tangential;
use crate::rig::{Observable, Rig, Track, WALLS};
use crate::set_rng::SetRng;
use crate::source::{Knob, Particle, Source};
use crate::world::World;
use crate::wrong_case::CaseError;

/// Particles of an experiment in the generator's Monte Carlo.
pub const PARTICLES: usize = 6000;
/// Least distance of a probability from 0 and 1 in a likelihood.
pub const FLOOR: f64 = 0.002;

/// How the file states errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Errors {
    /// The standard error of every reading.
    Stated,
    /// The count of a share; the standard error of a mean.
    Counts,
    /// Nothing.
    Absent,
}

/// The laboratory.
pub struct Lab {
    pub rig: Rig,
    pub system: System,
    pub law: Tangential,
    /// A constant `e_n` of the base in place of Thornton–Ning.
    pub constant_e_n: Option<f64>,
    /// `[[effects]]` of the model file.
    pub effects: String,
    pub source: Source,
    /// What experiments set, and its range; the first is that of the effect.
    pub knobs: Vec<(Knob, (f64, f64))>,
    /// Observables with their wall.
    pub readings: Vec<(Observable, usize)>,
    /// Deviation of a single value of a mean.
    pub deviation: f64,
    pub errors: Errors,
    /// The model file and the truth.
    pub base: World,
    pub truth: World,
    /// Surface tension and viscosity of a liquid that particles of char are instead, N/m and Pa s.
    pub liquid: Option<[f64; 2]>,
    /// What is wrong with the case file.
    pub case_error: Option<CaseError>,
}

/// One reading of an experiment.
#[derive(Clone, Copy, Debug)]
pub struct Reading {
    pub base: f64,
    pub truth: f64,
    pub value: f64,
    /// The count of a share, if the file states it.
    pub count: Option<f64>,
    pub sigma: f64,
    /// Particles that it rests on.
    pub particles: f64,
}

/// An experiment: its settings and readings.
#[derive(Clone, Debug)]
pub struct Experiment {
    pub settings: Vec<f64>,
    pub readings: Vec<Reading>,
}

impl Lab {
    /// The particles under these settings.
    pub fn source_at(&self, settings: &[f64]) -> Source {
        let mut source = self.source.clone();
        self.knobs.iter().zip(settings).for_each(|((knob, _), value)| source.set(*knob, *value));
        source
    }

    /// Settings of experiments: the first evenly over its range in random order, the others at random.
    pub fn design(&self, count: usize, rng: &mut SetRng) -> Vec<Vec<f64>> {
        let setting = |index: usize, rng: &mut SetRng| -> Vec<f64> {
            let one = |(place, (knob, (low, high))): (usize, &(Knob, (f64, f64)))| {
                let share = if place == 0 { (index as f64 + rng.unit()) / count as f64 } else { rng.unit() };
                Self::within(*knob, (*low, *high), share)
            };
            self.knobs.iter().enumerate().map(one).collect()
        };
        let mut all: Vec<_> = (0..count).map(|index| setting(index, rng)).collect();
        for i in (1..count).rev() {
            all.swap(i, rng.below(i + 1));
        }
        all
    }

    /// The value of a setting at this share of its range.
    pub fn within(knob: Knob, (low, high): (f64, f64), share: f64) -> f64 {
        let value = if matches!(knob, Knob::Speed | Knob::Size) {
            low * (high / low).powf(share)
        } else {
            low + (high - low) * share
        };
        rounded(value)
    }

    /// Particles of an experiment.
    pub fn particles(&self, settings: &[f64], count: usize, rng: &mut SetRng) -> Vec<Particle> {
        let source = self.source_at(settings);
        (0..count).map(|_| source.draw(rng)).collect()
    }

    /// The lives of particles in a world.
    pub fn tracks(&self, particles: &[Particle], world: &World) -> Vec<Track> {
        particles.iter().map(|particle| self.rig.follow(particle, world)).collect()
    }

    /// The lives of particles in the rig as it really was.
    fn true_tracks(&self, particles: &[Particle]) -> Vec<Track> {
        let rig = self.case_error.map_or(self.rig, |error| error.rig(self.rig));
        particles.iter().map(|particle| rig.follow(particle, &self.truth)).collect()
    }

    /// Every reading's value.
    pub fn values(&self, tracks: &[Track]) -> Vec<f64> {
        self.readings.iter().map(|(observable, wall)| observable.of(tracks, *wall)).collect()
    }

    /// Base and truth of every reading under these settings, from the same particles.
    pub fn expected(&self, settings: &[f64], count: usize, rng: &mut SetRng) -> [Vec<f64>; 2] {
        let mut same = rng.clone();
        let particles = self.particles(settings, count, rng);
        let base = self.values(&self.tracks(&particles, &self.base));
        let Some(error) = &self.case_error else {
            return [base, self.values(&self.tracks(&particles, &self.truth))];
        };
        let mut source = self.source_at(settings);
        error.apply(&mut source);
        let particles: Vec<Particle> = (0..count).map(|_| source.draw(&mut same)).collect();
        [base, self.values(&self.true_tracks(&particles))]
    }

    /// Square of the true effect in deviations, if every reading rested on one particle; `None` if one is not defined.
    pub fn information(&self, designs: &[Vec<f64>], count: usize, rng: &mut SetRng) -> Option<f64> {
        let mut sum = 0.0;
        for settings in designs {
            let [base, truth] = self.expected(settings, count, rng);
            for ((observable, _), (base, truth)) in self.readings.iter().zip(base.iter().zip(&truth)) {
                sum += if observable.is_share() && self.errors == Errors::Stated {
                    (truth - base).powi(2) / (truth * (1.0 - truth)).max(FLOOR)
                } else if observable.is_share() {
                    2.0 * divergence(*truth, *base)
                } else {
                    ((truth - base) / self.deviation).powi(2)
                };
            }
        }
        Some(sum).filter(|sum| sum.is_finite())
    }

    /// Measures an experiment with so many particles.
    pub fn measure(&self, settings: Vec<f64>, count: f64, rng: &mut SetRng) -> Option<Experiment> {
        let [base, truth] = self.expected(&settings, PARTICLES, rng);
        let (mut left, mut rest) = (count.round(), 1.0);
        let mut readings = vec![];
        for (index, (observable, _)) in self.readings.iter().enumerate() {
            let (base, truth) = (base[index], truth[index]);
            if !(base.is_finite() && truth.is_finite()) {
                return None;
            }
            let reading = Reading { base, truth, value: truth, count: None, sigma: 0.0, particles: count };
            let reading = if !observable.is_share() {
                let sigma = self.deviation / count.sqrt();
                Reading { value: truth + rng.noise(truth, sigma), sigma, ..reading }
            } else {
                let all = count.round();
                // Bins of one run share its particles.
                let bin = matches!(observable, Observable::CapturedFrom(..) | Observable::CapturedSize(..));
                let (tries, share) = if bin { (left, (truth / rest).min(1.0)) } else { (all, truth) };
                let caught = binomial(tries, share, rng);
                (left, rest) = if bin { (left - caught, (rest - truth).max(1e-9)) } else { (left, rest) };
                let sigma = (truth * (1.0 - truth) / all).sqrt().max(0.5 / all);
                let stated = (self.errors == Errors::Counts).then_some(all);
                Reading { value: caught / all, count: stated, sigma, ..reading }
            };
            readings.push(reading);
        }
        Some(Experiment { settings, readings })
    }

    /// Errors that are not stated are the same for all readings of an observable.
    pub fn even_errors(&self, experiments: &mut [Experiment]) {
        if self.errors != Errors::Absent {
            return;
        }
        for index in 0..self.readings.len() {
            let squares: f64 = experiments.iter().map(|one| one.readings[index].sigma.powi(2)).sum();
            let sigma = (squares / experiments.len() as f64).sqrt();
            experiments.iter_mut().for_each(|one| one.readings[index].sigma = sigma);
        }
    }

    /// The base model's file.
    pub fn model(&self) -> String {
        let text = self.system.model(self.law);
        let text = match self.constant_e_n {
            None => text,
            Some(e_n) => {
                let from = text.find("model = \"thornton-ning\"").unwrap();
                let to = from + text[from..].find("\n\n").unwrap();
                format!("{}model = \"constant\"\ne_n = {e_n}{}", &text[..from], &text[to..])
            }
        };
        let text = match self.liquid {
            None => text,
            Some([tension, viscosity]) => {
                let properties = format!("surface_tension = {tension}\nviscosity = {viscosity}\n");
                text.replacen("[materials.char-bits]\n", &format!("[materials.char-bits]\n{properties}"), 1)
            }
        };
        text + &self.effects
    }

    /// The file of measurements; each reading in a column, or bins in rows of their own.
    pub fn csv(&self, experiments: &[Experiment], rows_apart: bool) -> String {
        let mut header = vec!["experiment".to_string()];
        header.extend(self.knobs.iter().map(|(knob, _)| self.source.key(*knob)));
        for (observable, wall) in &self.readings {
            let name = format!("{}@{}", observable.name(), WALLS[*wall]);
            let counted = self.errors == Errors::Counts && observable.is_share();
            header.push(name.clone());
            match self.errors {
                Errors::Absent => {}
                _ if counted => header.push(format!("{name}_n")),
                _ => header.push(format!("{name}_err")),
            }
        }
        let mut text = header.join(",");
        for (number, experiment) in experiments.iter().enumerate() {
            let settings: Vec<String> = self
                .knobs
                .iter()
                .zip(&experiment.settings)
                .map(|((knob, _), value)| Source::cell(*knob, *value))
                .collect();
            let cells: Vec<Vec<String>> =
                experiment.readings.iter().map(|reading| self.cells(reading)).collect();
            let rows = if rows_apart { cells.len() } else { 1 };
            for row in 0..rows {
                write!(text, "\nrun {},{}", number + 1, settings.join(",")).unwrap();
                for (index, cells) in cells.iter().enumerate() {
                    for cell in cells {
                        let shown = !rows_apart || index == row;
                        write!(text, ",{}", if shown { cell } else { "" }).unwrap();
                    }
                }
            }
        }
        text + "\n"
    }

    fn cells(&self, reading: &Reading) -> Vec<String> {
        let value = format!("{:.5}", reading.value);
        match (self.errors, reading.count) {
            (Errors::Absent, _) => vec![value],
            (Errors::Counts, Some(count)) => vec![format!("{:.8}", reading.value), count.to_string()],
            _ => vec![value, format!("{:.3e}", reading.sigma)],
        }
    }
}

/// A binomial number.
fn binomial(tries: f64, share: f64, rng: &mut SetRng) -> f64 {
    (0..tries as usize).filter(|_| rng.chance(share)).count() as f64
}

/// Kullback–Leibler divergence of two shares, nats.
fn divergence(truth: f64, base: f64) -> f64 {
    let (p, q) = (truth.clamp(FLOOR, 1.0 - FLOOR), base.clamp(FLOOR, 1.0 - FLOOR));
    p * (p / q).ln() + (1.0 - p) * ((1.0 - p) / (1.0 - q)).ln()
}

/// To four digits, so that the file contains the value exactly.
pub fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap()
}
