//! A model: the materials, the laws and the list of named terms that decide an impact.
//!
//! [`Model::resolve`] is the one door: the command, the C library and OpenFOAM all enter here. An impact walks
//! through in one direction: tilt of the wall, contact of the materials at their temperatures and the effects on it,
//! stickiness of particle and wall, normal law, effects on `e_n`, what stickiness takes of it, tangential law, effects on
//! `e_t`, back to the mean wall, capture. [`Model::explain`] walks the same way and notes what each term did.

pub mod block;
mod deposit;
mod describe;
mod prepared_wall;
mod read;
mod tilted_frame;
mod wall;

use std::path::Path;

use crate::capture::{Criterion, MeltStickiness, ParticleStickiness, Stickiness};
use crate::effect::{Term, stream};
use crate::impact::{Impact, ImpactError, Outcome, Regime};
use crate::input::{Document, InputError};
use crate::material::{Material, overlap};
use crate::normal::{Contact, NormalLaw, Speeds};
use crate::rng::ImpactRng;
use crate::tangential::{ImpactKinematics, TangentialLaw};

pub use deposit::Melt;
use prepared_wall::PreparedWall;
use tilted_frame::TiltedFrame;
pub use wall::Wall;

/// Everything that decides what happens when a particle hits a wall. Immutable once read.
#[derive(Debug, Clone)]
pub struct Model {
    particle: Material,
    criterion: Option<Criterion>,
    /// The criterion for the particle's material, where it has something to say of it.
    stickiness: Option<ParticleStickiness>,
    walls: Vec<Wall>,
    normal: NormalLaw,
    tangential: TangentialLaw,
    terms: Vec<Term>,
    /// For each wall its prepared numbers, where that is all its impacts need.
    plans: Vec<Option<PreparedWall>>,
}

/// What one term did to one impact.
#[derive(Debug, Clone, PartialEq)]
pub struct TraceEntry {
    /// Name of the law or effect.
    pub term: &'static str,
    /// The quantity it set, for instance `e_n`.
    pub quantity: &'static str,
    /// The quantity after the term.
    pub value: f64,
}

/// Lowest and highest temperature [K] at which every property is known: 0 and infinity where none has a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TemperatureRanges {
    /// Of the particle.
    pub particle: [f64; 2],
    /// Of the wall.
    pub wall: [f64; 2],
}

impl Model {
    /// Reads a model file.
    ///
    /// # Errors
    /// [`InputError`] naming file, line, column and key.
    pub fn from_file(path: &Path) -> Result<Self, InputError> {
        Self::read(&Document::from_file(path)?)
    }

    /// Reads a model from TOML text; `name` stands for the file in messages.
    ///
    /// # Errors
    /// [`InputError`] naming line, column and key.
    pub fn from_toml(name: &str, text: &str) -> Result<Self, InputError> {
        Self::read(&Document::new(name, text))
    }

    /// The material of the particles.
    pub fn particle(&self) -> &Material {
        &self.particle
    }

    /// The walls, in the order of the file.
    pub fn walls(&self) -> &[Wall] {
        &self.walls
    }

    /// The effects, in the order in which they act.
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// The normal law.
    pub fn normal_law(&self) -> NormalLaw {
        self.normal
    }

    /// The tangential law.
    pub fn tangential_law(&self) -> TangentialLaw {
        self.tangential
    }

    /// The same model with other terms.
    #[must_use]
    pub fn with_terms(&self, terms: Vec<Term>) -> Self {
        Self { terms, ..self.clone() }.prepared()
    }

    /// The same model with other laws.
    #[must_use]
    pub fn with_laws(&self, normal: NormalLaw, tangential: TangentialLaw) -> Self {
        Self { normal, tangential, ..self.clone() }.prepared()
    }

    /// The model with the plans that belong to it.
    fn prepared(mut self) -> Self {
        self.plans = self.walls.iter().map(|wall| PreparedWall::new(&self, wall)).collect();
        self
    }

    /// The index of the wall that a patch name belongs to: the wall of that name, else the last one whose name is a
    /// regular expression that fits. There is no fall-back to `default`; callers decide that.
    pub fn find_wall(&self, name: &str) -> Option<usize> {
        let exact = self.walls.iter().position(|wall| wall.name() == name);
        exact.or_else(|| self.walls.iter().rposition(|wall| wall.fits(name)))
    }

    /// Temperatures at which impacts on a wall can be decided: what the tables of all properties have in common.
    ///
    /// # Errors
    /// [`ImpactError::NoSuchWall`].
    pub fn temperature_ranges(&self, wall: usize) -> Result<TemperatureRanges, ImpactError> {
        let wall = self.walls.get(wall).ok_or(ImpactError::NoSuchWall(wall))?;
        let range = |material: &Material, stickiness: Option<[f64; 2]>| {
            overlap([material.known_range()].into_iter().chain(stickiness))
        };
        Ok(TemperatureRanges {
            particle: range(&self.particle, self.stickiness.as_ref().map(ParticleStickiness::known_range)),
            wall: range(wall.material(), wall.melt.as_ref().map(MeltStickiness::known_range)),
        })
    }

    /// Checks that [`Model::resolve`] can decide an impact.
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn check(&self, wall: usize, impact: &Impact) -> Result<(), ImpactError> {
        let (wall, impact) = self.at_wall(wall, impact)?;
        self.contact(wall, &impact, &|_| 0.5)?;
        self.particle_stickiness(&impact, &mut |_, _, _| {})?;
        self.wall_stickiness(wall, &impact)?;
        Ok(())
    }

    /// Decides one impact on the wall with index `wall`. Pure: the same input gives the same bits.
    ///
    /// # Errors
    /// [`ImpactError`] for an impact without physical meaning, or a temperature outside a property table.
    #[inline(always)]
    pub fn resolve(&self, wall: usize, impact: &Impact, draw: ImpactRng) -> Result<Outcome, ImpactError> {
        // A plan knows no melt on the wall.
        if let (Some(Some(plan)), 0.0) = (self.plans.get(wall), impact.melt_thickness) {
            impact.check()?;
            return Ok(plan.one(impact, draw));
        }
        self.walk_drawn(wall, impact, draw)
    }

    /// Apart, so that the short way above stays short and its numbers in registers.
    #[inline(never)]
    fn walk_drawn(&self, wall: usize, impact: &Impact, draw: ImpactRng) -> Result<Outcome, ImpactError> {
        self.walk(wall, impact, |stream| draw.uniform(stream), |_, _, _| {})
    }

    /// Decides one impact with the caller's random numbers: `uniform` gives each stream's, in (0, 1). For averages over
    /// what is left to chance.
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn resolve_with(
        &self,
        wall: usize,
        impact: &Impact,
        uniform: impl Fn(u64) -> f64,
    ) -> Result<Outcome, ImpactError> {
        self.walk(wall, impact, uniform, |_, _, _| {})
    }

    /// Decides one impact and notes what each term made of it, in the order of the walk.
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn explain(
        &self,
        wall: usize,
        impact: &Impact,
        draw: ImpactRng,
    ) -> Result<(Outcome, Vec<TraceEntry>), ImpactError> {
        let mut shares = Vec::new();
        let uniform = |stream| draw.uniform(stream);
        let outcome = self.walk(wall, impact, uniform, |term, quantity, value| {
            shares.push(TraceEntry { term, quantity, value });
        })?;
        Ok((outcome, shares))
    }

    /// Adhesive, yield and sticking velocity of an impact's particle and wall, where chance is at its median.
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn speeds(&self, wall: usize, impact: &Impact) -> Result<Speeds, ImpactError> {
        let (wall, impact) = self.at_wall(wall, impact)?;
        Ok(self.normal.speeds(&self.contact(wall, &impact, &|_| 0.5)?, impact.diameter))
    }

    /// The wall with this index, and the impact as it sees it.
    fn at_wall(&self, wall: usize, impact: &Impact) -> Result<(&Wall, Impact), ImpactError> {
        impact.check()?;
        let wall = self.walls.get(wall).ok_or(ImpactError::NoSuchWall(wall))?;
        Ok((wall, wall.apply_deposit(impact)))
    }

    /// The contact of particle and wall at their temperatures, with the effects that act on it.
    fn contact(
        &self,
        wall: &Wall,
        impact: &Impact,
        uniform: &impl Fn(u64) -> f64,
    ) -> Result<Contact, ImpactError> {
        let plain = wall.contact(&self.particle, impact)?;
        let change = |contact, term: &Term| term.effect().contact(impact, contact, term.chance(uniform));
        Ok(self.terms.iter().fold(plain, change))
    }

    /// How sticky the particle is: the product of what the terms say, 0 when no term speaks of it.
    fn particle_stickiness(
        &self,
        impact: &Impact,
        note: &mut impl FnMut(&'static str, &'static str, f64),
    ) -> Result<f64, ImpactError> {
        let mut product = None;
        if let Some(stickiness) = &self.stickiness {
            let share = stickiness.at(impact)?;
            note(stickiness.name(), "particle stickiness", share);
            product = Some(share);
        }
        for term in &self.terms {
            if let Some(share) = term.effect().particle_stickiness(impact) {
                note(term.kind().id, "particle stickiness", share);
                product = Some(product.unwrap_or(1.0) * share);
            }
        }
        Ok(product.unwrap_or(0.0))
    }

    /// Share of `e_n` that full stickiness of the particle takes [1]: all of it by a capture criterion.
    fn rebound_loss(&self) -> f64 {
        let criterion = if self.stickiness.is_some() { 1.0 } else { 0.0 };
        self.terms.iter().map(|term| term.effect().rebound_loss()).fold(criterion, f64::max)
    }

    fn walk(
        &self,
        wall: usize,
        impact: &Impact,
        uniform: impl Fn(u64) -> f64,
        mut note: impl FnMut(&'static str, &'static str, f64),
    ) -> Result<Outcome, ImpactError> {
        let (wall, arriving) = self.at_wall(wall, impact)?;
        let tilt = self.terms.iter().map(|term| term.effect().tilt(&arriving, term.chance(&uniform))).sum();
        let facet = TiltedFrame { tilt };
        let impact = &facet.turn(&arriving);
        let contact = self.contact(wall, impact, &uniform)?;

        let particle = self.particle_stickiness(impact, &mut note)?;
        let sticky = Stickiness { particle, wall: self.wall_stickiness(wall, impact)? };
        note("wall", "wall stickiness", sticky.wall);

        let mut rebound = self.normal.restitution(&contact, impact.diameter, impact.normal_speed);
        note(self.normal.name(), "e_n", rebound.unwrap_or(0.0));
        for term in &self.terms {
            let Some(e_n) = rebound else { break };
            rebound = term.effect().normal_restitution(impact, &contact, e_n, term.chance(&uniform));
            if rebound != Some(e_n) {
                note(term.kind().id, "e_n", rebound.unwrap_or(0.0));
            }
        }
        // What makes a particle sticky may also take up its rebound.
        let e_n = rebound.unwrap_or(0.0) * (1.0 - self.rebound_loss() * sticky.particle);
        note("stickiness", "e_n", e_n);

        let kinematics = ImpactKinematics {
            normal_speed: impact.normal_speed,
            tangential_speed: impact.tangential_speed,
            diameter: impact.diameter,
            spin: impact.spin,
            normal_restitution: e_n,
            stiffness_ratio: contact.stiffness_ratio,
        };
        let mut along = self.tangential.rebound(&kinematics);
        note(self.tangential.name(), "e_t", along.restitution);
        for term in &self.terms {
            let changed = term.effect().tangential(&kinematics, along);
            if changed != along {
                note(term.kind().id, "e_t", changed.restitution);
            }
            along = changed;
        }
        let [e_n, e_t] = facet.turn_back(&arriving, impact, [e_n, along.restitution]);
        let spin = facet.spin_back(&arriving, along.spin);

        // Adhesion holds the particle for certain; otherwise stickiness decides, of a droplet its own alone.
        let splashes = |criterion: &ParticleStickiness| criterion.is_droplet(impact.particle_temperature);
        let probability = match rebound {
            None => 1.0,
            Some(_) if self.stickiness.as_ref().is_some_and(splashes) => sticky.particle,
            Some(_) => sticky.probability(),
        };
        note("capture", "p_stick", probability);
        Ok(Outcome {
            normal_restitution: e_n,
            tangential_restitution: e_t,
            sticking_probability: probability,
            stuck: captured(probability, uniform(stream::CAPTURE)),
            spin,
            regime: Regime::of(
                sticky.particle >= Stickiness::THRESHOLD,
                sticky.wall >= Stickiness::THRESHOLD,
            ),
            outside_range: self.outside_range(wall, &arriving),
        })
    }

    /// Whether a property, a capture criterion or a fitted term is used outside the range it is stated for.
    fn outside_range(&self, wall: &Wall, impact: &Impact) -> bool {
        !(self.stickiness.as_ref().is_none_or(|criterion| criterion.holds_at(impact.particle_temperature))
            && wall.melt.as_ref().is_none_or(|melt| melt.holds_at(impact.wall_temperature))
            && self.melt_holds(impact)
            && self.particle.holds_at(impact.particle_temperature)
            && wall.material().holds_at(impact.wall_temperature)
            && self.terms.iter().all(|term| term.holds_for(impact)))
    }
}

/// Whether a particle is captured: for certain, or by a number in (0, 1) that was drawn for it.
#[inline(always)]
fn captured(probability: f64, drawn: f64) -> bool {
    (probability >= 1.0) | (drawn < probability)
}
