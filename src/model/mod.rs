//! A model: the materials, the laws and the list of named terms that decide an impact.
//!
//! [`Model::resolve`] is the one door: the command, the C library and OpenFOAM all enter here. An impact walks
//! through in one direction: materials at their temperatures, stickiness of particle and wall, normal law, effects
//! on `e_n`, tangential law, effects on `e_t`, capture. [`Model::explain`] walks the same way and notes what each term
//! did.

mod describe;
mod read;
mod wall;

use std::path::Path;

use crate::capture::{MeltStickiness, Stickiness, ViscosityCriterion};
use crate::draw::Draw;
use crate::effect::Term;
use crate::impact::{Impact, ImpactError, Outcome, Regime};
use crate::input::{Document, InputError};
use crate::material::{Material, overlap};
use crate::normal::{Contact, NormalLaw, Speeds};
use crate::tangential::{Glance, TangentialLaw};

pub use wall::Wall;

/// Everything that decides what happens when a particle hits a wall. Immutable once read.
#[derive(Debug)]
pub struct Model {
    particle: Material,
    particle_melt: Option<MeltStickiness>,
    criterion: Option<ViscosityCriterion>,
    walls: Vec<Wall>,
    normal: NormalLaw,
    tangential: TangentialLaw,
    terms: Vec<Term>,
}

/// What one term did to one impact.
#[derive(Debug, Clone, PartialEq)]
pub struct Share {
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

/// The stream of [`Draw`] that decides capture.
const CAPTURE_STREAM: u64 = 0;

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
        let range = |material: &Material, melt: &Option<MeltStickiness>| {
            let melt = melt.as_ref().map(MeltStickiness::known_range);
            overlap([material.known_range()].into_iter().chain(melt))
        };
        Ok(TemperatureRanges {
            particle: range(&self.particle, &self.particle_melt),
            wall: range(wall.material(), &wall.melt),
        })
    }

    /// Checks that [`Model::resolve`] can decide an impact.
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn check(&self, wall: usize, impact: &Impact) -> Result<(), ImpactError> {
        let (wall, impact) = self.at_wall(wall, impact)?;
        self.contact(wall, &impact)?;
        self.particle_stickiness(&impact, &mut |_, _, _| {})?;
        wall.stickiness(&impact)?;
        Ok(())
    }

    /// Decides one impact on the wall with index `wall`. Pure: the same input gives the same bits.
    ///
    /// # Errors
    /// [`ImpactError`] for an impact without physical meaning, or a temperature outside a property table.
    pub fn resolve(&self, wall: usize, impact: &Impact, draw: Draw) -> Result<Outcome, ImpactError> {
        self.walk(wall, impact, draw, |_, _, _| {})
    }

    /// Decides one impact and notes what each term made of it, in the order of the walk.
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn explain(
        &self,
        wall: usize,
        impact: &Impact,
        draw: Draw,
    ) -> Result<(Outcome, Vec<Share>), ImpactError> {
        let mut shares = Vec::new();
        let outcome = self.walk(wall, impact, draw, |term, quantity, value| {
            shares.push(Share { term, quantity, value });
        })?;
        Ok((outcome, shares))
    }

    /// Adhesive, yield and sticking velocity of an impact's particle and wall (only sizes and temperatures count).
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn speeds(&self, wall: usize, impact: &Impact) -> Result<Speeds, ImpactError> {
        let (wall, impact) = self.at_wall(wall, impact)?;
        Ok(Speeds::of(&self.contact(wall, &impact)?, impact.diameter))
    }

    /// The wall with this index, and the impact as it sees it.
    fn at_wall(&self, wall: usize, impact: &Impact) -> Result<(&Wall, Impact), ImpactError> {
        impact.check()?;
        let wall = self.walls.get(wall).ok_or(ImpactError::NoSuchWall(wall))?;
        Ok((wall, wall.dress(impact)))
    }

    /// The contact of particle and wall at their temperatures, with the effects that act on it.
    fn contact(&self, wall: &Wall, impact: &Impact) -> Result<Contact, ImpactError> {
        let plain = wall.contact(&self.particle, impact)?;
        Ok(self.terms.iter().fold(plain, |contact, term| term.effect().contact(impact, contact)))
    }

    /// How sticky the particle is: the product of what the terms say, 0 when no term speaks of it.
    fn particle_stickiness(
        &self,
        impact: &Impact,
        note: &mut impl FnMut(&'static str, &'static str, f64),
    ) -> Result<f64, ImpactError> {
        let mut product = None;
        if let Some(melt) = &self.particle_melt {
            let share = melt.at(impact.particle_temperature)?;
            note("viscosity", "particle stickiness", share);
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

    fn walk(
        &self,
        wall: usize,
        impact: &Impact,
        draw: Draw,
        mut note: impl FnMut(&'static str, &'static str, f64),
    ) -> Result<Outcome, ImpactError> {
        let (wall, impact) = self.at_wall(wall, impact)?;
        let impact = &impact;
        let contact = self.contact(wall, impact)?;

        let particle = self.particle_stickiness(impact, &mut note)?;
        let sticky = Stickiness { particle, wall: wall.stickiness(impact)? };
        note("wall", "wall stickiness", sticky.wall);

        let dry = self.normal.restitution(&contact, impact.diameter, impact.normal_speed);
        note(self.normal.name(), "e_n", dry.unwrap_or(0.0));
        // What makes a particle sticky also takes up its rebound.
        let mut e_n = dry.unwrap_or(0.0) * (1.0 - sticky.particle);
        note("stickiness", "e_n", e_n);
        for term in &self.terms {
            let changed = term.effect().normal_restitution(impact, e_n);
            if changed != e_n {
                note(term.kind().id, "e_n", changed);
            }
            e_n = changed;
        }

        let rebound = self.tangential.rebound(&Glance {
            normal_speed: impact.normal_speed,
            tangential_speed: impact.tangential_speed,
            diameter: impact.diameter,
            spin: impact.spin,
            normal_restitution: e_n,
            stiffness_ratio: contact.stiffness_ratio,
        });
        note(self.tangential.name(), "e_t", rebound.restitution);
        let mut e_t = rebound.restitution;
        for term in &self.terms {
            let changed = term.effect().tangential_restitution(impact, e_t);
            if changed != e_t {
                note(term.kind().id, "e_t", changed);
            }
            e_t = changed;
        }

        // Adhesion holds the particle for certain; otherwise stickiness decides.
        let probability = if dry.is_none() { 1.0 } else { sticky.probability() };
        note("capture", "p_stick", probability);
        Ok(Outcome {
            normal_restitution: e_n,
            tangential_restitution: e_t,
            sticking_probability: probability,
            stuck: draw.uniform(CAPTURE_STREAM) < probability,
            spin: rebound.spin,
            regime: Regime::of(
                sticky.particle >= Stickiness::THRESHOLD,
                sticky.wall >= Stickiness::THRESHOLD,
            ),
            outside_range: self.outside_range(wall, impact),
        })
    }

    /// Whether a property, a viscosity law or a fitted term is used outside the range it is stated for.
    fn outside_range(&self, wall: &Wall, impact: &Impact) -> bool {
        let holds = |melt: &Option<MeltStickiness>, temperature| {
            melt.as_ref().is_none_or(|melt| melt.holds_at(temperature))
        };
        !(holds(&self.particle_melt, impact.particle_temperature)
            && holds(&wall.melt, impact.wall_temperature)
            && self.particle.holds_at(impact.particle_temperature)
            && wall.material().holds_at(impact.wall_temperature)
            && self.terms.iter().all(|term| term.holds_for(impact)))
    }
}
