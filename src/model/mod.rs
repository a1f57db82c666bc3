//! A model: the materials, the laws and the list of named terms that decide an impact.
//!
//! The command, the C library and OpenFOAM call [`Model::resolve`], or [`Model::resolve_block`] for
//! many impacts at once, with the same bits. The order of the steps stands in `evaluation.rs`: tilt
//! of the wall, contact of the materials at their temperatures with the effects on it, stickiness
//! of particle and wall, normal law, effects on `e_n`, loss by stickiness, tangential law, effects
//! on `e_t`, back to the mean wall, capture, fitted corrections. [`Model::explain`] runs the same
//! steps and records the value after each term.

mod beyond;
pub mod block;
mod contact_heat;
mod deposit;
mod describe;
mod displaced;
mod energy_bound;
mod evaluation;
mod expectation;
mod general_wall;
mod groups;
mod particle;
mod prepared_block;
mod prepared_wall;
mod quantity;
mod read;
mod tilted_frame;
mod wall;
mod wall_heat;

use std::path::Path;
use std::sync::Arc;

use crate::capture::{Capture, StickinessCriterion, Unsuitable};
use crate::effect::Term;
use crate::group::ProductGroup;
use crate::impact::{EXTRA_INPUTS, ExtraInput, Impact, ImpactError, Outcome};
use crate::input::{Document, InputError};
use crate::material::{Material, overlap};
use crate::normal::{self, NormalLaw, Speeds};
use crate::rng::ImpactRng;
use crate::tangential::TangentialLaw;

pub use crate::deposit::WallMelt;
pub use beyond::{Beyond, Limit, Stated};
pub use displaced::{Displaced, LEAST_SHARE, MATTERS_FROM};
pub use expectation::Expectation;
pub use expectation::{DrawLattice, RotatedLattice};
use general_wall::{Unwatched, Watcher};
pub use particle::Particle;
use prepared_wall::PreparedWall;
pub use quantity::{kind_of, unit_of};
pub use wall::Wall;
use wall::WallPlace;
pub use wall_heat::{WallCooling, WallHeat, WallHeatError};

/// Everything that decides an impact of a particle on a wall. Immutable after reading.
#[derive(Debug, Clone)]
pub struct Model {
    particle: Particle,
    capture: Capture,
    /// The criterion for the particle's material or ash, where it applies to that.
    stickiness: Option<Arc<dyn StickinessCriterion>>,
    /// Temperature [K] below which that criterion says that the material is solid on a wall.
    solid_below: Option<f64>,
    /// Temperature [K] from which particles without carbon are liquid on a wall.
    liquid_from: Option<f64>,
    walls: Vec<Wall>,
    normal: NormalLaw,
    tangential: TangentialLaw,
    /// Inputs that the model file declares.
    extra_inputs: Vec<ExtraInput>,
    /// Groups that the model file declares.
    products: Vec<ProductGroup>,
    terms: Vec<Term>,
    /// Whether a term depends on the melt on the wall.
    uses_melt: bool,
    /// Whether a term may leave more energy than came in.
    adds_energy: bool,
    /// Whether a term is a fitted correction.
    has_corrections: bool,
    /// Whether a term is stated for a range of a group.
    has_group_ranges: bool,
    /// For each wall its prepared form; `None` where every impact needs the general steps.
    prepared: Vec<Option<PreparedWall>>,
    /// For each wall the temperatures [K] within which only [`Impact::check`] can refuse an impact;
    /// `None` where a single impact has to be asked ([`Model::check`]).
    decided: Vec<Option<TemperatureRanges>>,
}

/// The effect of one term on one impact.
#[derive(Debug, Clone, PartialEq)]
pub struct TraceEntry {
    /// Name of the law or effect.
    pub term: &'static str,
    /// The quantity that it set, for instance `e_n`.
    pub quantity: &'static str,
    /// The quantity after the term.
    pub value: f64,
}

/// Lowest and highest temperature [K] at which every property is known; 0 and infinity where no property has a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TemperatureRanges {
    /// Of the particle.
    pub particle: [f64; 2],
    /// Of the wall.
    pub wall: [f64; 2],
}

impl Watcher<'_> for Vec<TraceEntry> {
    const SHOWS: bool = true;

    fn trace(&mut self, term: &'static str, quantity: &'static str, value: f64) {
        self.push(TraceEntry { term, quantity, value });
    }
}

impl TemperatureRanges {
    /// Every temperature.
    pub(crate) const ALL: Self = Self { particle: [0.0, f64::INFINITY], wall: [0.0, f64::INFINITY] };
}

impl Model {
    /// Reads a model file.
    ///
    /// # Errors
    /// [`InputError`] naming file, line, column and key.
    pub fn from_file(path: &Path) -> Result<Self, InputError> {
        Self::read(&Document::from_file(path)?)
    }

    /// Reads a model from TOML text; messages call the file `name`.
    ///
    /// # Errors
    /// [`InputError`] naming line, column and key.
    pub fn from_toml(name: &str, text: &str) -> Result<Self, InputError> {
        Self::read(&Document::new(name, text))
    }

    /// The material of the unburnt particles.
    pub fn particle(&self) -> &Material {
        self.particle.material()
    }

    /// What is left of a particle when all carbon is gone, where the model file says so.
    pub fn ash(&self) -> Option<&Material> {
        self.particle.ash()
    }

    /// The walls, in the order of the file.
    pub fn walls(&self) -> &[Wall] {
        &self.walls
    }

    /// The inputs that the model file declares, in the order of [`Impact::extra`].
    pub fn extra_inputs(&self) -> &[ExtraInput] {
        &self.extra_inputs
    }

    /// The same model with other inputs of its own; those beyond the first [`EXTRA_INPUTS`] are left out.
    #[must_use]
    pub fn with_extra_inputs(&self, mut extra_inputs: Vec<ExtraInput>) -> Self {
        extra_inputs.truncate(EXTRA_INPUTS);
        Self { extra_inputs, ..self.clone() }.prepare()
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

    /// The `[capture]` table.
    pub fn capture(&self) -> Capture {
        self.capture
    }

    /// The same model with another `[capture]` table.
    ///
    /// # Errors
    /// [`Unsuitable`] when a material lacks what the criterion needs.
    pub fn with_capture(&self, capture: Capture) -> Result<Self, Unsuitable> {
        let mut model = Self { capture, ..self.clone() };
        let melting = model.particle.melting();
        model.stickiness = capture.of_particle(melting)?;
        for wall in &mut model.walls {
            wall.melt = match &wall.slag {
                Some(slag) => capture.of_slag(slag, melting)?,
                None => None,
            };
        }
        Ok(model.prepare())
    }

    /// The same model with other terms.
    #[must_use]
    pub fn with_terms(&self, terms: Vec<Term>) -> Self {
        Self { terms, ..self.clone() }.prepare()
    }

    /// The same model with other laws.
    #[must_use]
    pub fn with_laws(&self, normal: NormalLaw, tangential: TangentialLaw) -> Self {
        Self { normal, tangential, ..self.clone() }.prepare()
    }

    /// Whether particles may be droplets.
    fn has_droplets(&self) -> bool {
        self.stickiness.as_ref().is_some_and(|criterion| criterion.has_droplets())
    }

    /// Prepares the walls that can be prepared.
    fn prepare(mut self) -> Self {
        self.set_melting();
        self.uses_melt = self.terms.iter().any(|term| term.effect().uses_melt());
        self.adds_energy = self.terms.iter().any(|term| term.effect().may_add_energy());
        self.has_corrections = self.terms.iter().any(|term| term.effect().correction().is_some());
        self.has_group_ranges = self.terms.iter().any(|term| !term.valid_groups().is_empty());
        self.prepared = self.walls.iter().map(|wall| PreparedWall::new(&self, wall)).collect();
        let decided = !self.has_droplets() && self.extra_inputs.is_empty();
        self.decided = self.walls.iter().map(|wall| decided.then(|| self.ranges_of(wall))).collect();
        self
    }

    /// The index of the wall for a patch name: the wall of that name, else the last one whose name
    /// is a regular expression that matches it. There is no fall-back to `default`; callers decide
    /// that.
    pub fn find_wall(&self, name: &str) -> Option<usize> {
        let exact = self.walls.iter().position(|wall| wall.name() == name);
        exact.or_else(|| self.walls.iter().rposition(|wall| wall.fits(name)))
    }

    /// Temperatures at which impacts on a wall can be decided: the intersection of all property tables.
    ///
    /// # Errors
    /// [`ImpactError::NoSuchWall`].
    pub fn temperature_ranges(&self, wall: usize) -> Result<TemperatureRanges, ImpactError> {
        let wall = self.walls.get(wall).ok_or(ImpactError::NoSuchWall(wall))?;
        Ok(self.ranges_of(wall))
    }

    fn ranges_of(&self, wall: &Wall) -> TemperatureRanges {
        let solids = |solids: [Option<&Material>; 2]| {
            solids.into_iter().flatten().map(Material::known_range).collect::<Vec<_>>()
        };
        let particle = solids([Some(self.particle()), self.ash()]);
        let melt = self.stickiness.as_ref().map(|criterion| criterion.known_range());
        TemperatureRanges {
            particle: overlap(particle.into_iter().chain(melt)),
            wall: overlap(solids([Some(wall.material()), wall.powder.as_ref()]).into_iter()),
        }
    }

    /// Checks that [`Model::resolve`] can decide an impact.
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn check(&self, wall: usize, impact: &Impact) -> Result<(), ImpactError> {
        let mut impact = *impact;
        let wall = self.at_wall(wall, &mut impact)?;
        let patchwork = wall.is_patchwork(&impact);
        if !patchwork || impact.coverage < 1.0 {
            self.contact(wall, &impact, WallPlace::Bare, &|_| 0.5)?;
        }
        if patchwork && impact.coverage > 0.0 {
            self.contact(wall, &impact, WallPlace::Covered, &|_| 0.5)?;
        }
        self.particle_stickiness(&impact, &mut |_, _, _| {})?;
        Ok(())
    }

    /// Decides one impact on the wall with index `wall`. Pure: the same input gives the same bits.
    ///
    /// # Errors
    /// [`ImpactError`] for an impact without physical meaning, or a temperature outside a property table.
    #[inline(always)]
    pub fn resolve(&self, wall: usize, impact: &Impact, rng: ImpactRng) -> Result<Outcome, ImpactError> {
        // A constant contact has no melt layer.
        if let (Some(Some(prepared)), 0.0) = (self.prepared.get(wall), impact.melt_thickness)
            && prepared.varying.is_none()
        {
            impact.check()?;
            return Ok(prepared.resolve_constant(impact, rng));
        }
        self.resolve_varying(wall, impact, rng)
    }

    /// Not inlined, so that the numbers of a constant contact stay in registers.
    #[inline(never)]
    fn resolve_varying(&self, wall: usize, impact: &Impact, rng: ImpactRng) -> Result<Outcome, ImpactError> {
        if let (Some(Some(prepared)), Some(of)) = (self.prepared.get(wall), self.walls.get(wall))
            && let Some(varying) = &prepared.varying
            && prepared.decides(impact)
        {
            impact.check()?;
            return Ok(prepared.resolve_varying(varying, self, of, impact, rng));
        }
        self.evaluate_general(wall, impact, rng)
    }

    #[inline(never)]
    fn evaluate_general(&self, wall: usize, impact: &Impact, rng: ImpactRng) -> Result<Outcome, ImpactError> {
        self.evaluate(wall, impact, |stream| rng.uniform(stream), &mut Unwatched)
    }

    /// Decides one impact with the caller's random numbers: `uniform` gives the number of each
    /// stream, in (0, 1). For averages over the random draws.
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn resolve_with(
        &self,
        wall: usize,
        impact: &Impact,
        uniform: impl Fn(u64) -> f64,
    ) -> Result<Outcome, ImpactError> {
        self.evaluate(wall, impact, uniform, &mut Unwatched)
    }

    /// Decides one impact and records the value after each term, in the order of the steps.
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn explain(
        &self,
        wall: usize,
        impact: &Impact,
        rng: ImpactRng,
    ) -> Result<(Outcome, Vec<TraceEntry>), ImpactError> {
        self.explain_with(wall, impact, |stream| rng.uniform(stream))
    }

    /// As [`Model::explain`], with the random numbers of [`Model::resolve_with`].
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn explain_with(
        &self,
        wall: usize,
        impact: &Impact,
        uniform: impl Fn(u64) -> f64,
    ) -> Result<(Outcome, Vec<TraceEntry>), ImpactError> {
        let mut trace = Vec::new();
        let outcome = self.evaluate(wall, impact, uniform, &mut trace)?;
        Ok((outcome, trace))
    }

    /// Volume of wall [m³] that particles of a total `mass` [kg] remove by impacts like this one; 0
    /// where the model file gives the wall no erosion law. Independent of what becomes of the
    /// particles.
    ///
    /// # Errors
    /// [`ImpactError`] for an impact or a mass without physical meaning, or an unknown wall.
    pub fn erosion(&self, wall: usize, impact: &Impact, mass: f64) -> Result<f64, ImpactError> {
        let wall = self.walls.get(wall).ok_or(ImpactError::NoSuchWall(wall))?;
        impact.check()?;
        deposit::at_least_zero("mass", mass)?;
        Ok(wall.erosion.as_ref().map_or(0.0, |law| mass * law.volume_per_mass(impact)))
    }

    /// Density [kg/m³] of the particle's material, which an impact without a density of its own takes.
    ///
    /// # Errors
    /// [`ImpactError::OutOfRange`] outside a table.
    pub fn particle_density(&self, impact: &Impact) -> Result<f64, ImpactError> {
        self.particle.density_of_materials(impact)
    }

    /// Time [s] that a solid particle of this impact touches the wall ([`normal::contact_time`]); random numbers
    /// are at their median, 0.5.
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn contact_time(&self, wall: usize, impact: &Impact) -> Result<f64, ImpactError> {
        let mut impact = *impact;
        let wall = self.at_wall(wall, &mut impact)?;
        let contact = self.contact(wall, &impact, WallPlace::Anywhere, &|_| 0.5)?;
        Ok(normal::contact_time(&contact, impact.diameter, impact.normal_speed))
    }

    /// Adhesive, yield and sticking velocity of an impact's particle and wall; random numbers are at their median, 0.5.
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn speeds(&self, wall: usize, impact: &Impact) -> Result<Speeds, ImpactError> {
        let mut impact = *impact;
        let wall = self.at_wall(wall, &mut impact)?;
        let contact = self.contact(wall, &impact, WallPlace::Anywhere, &|_| 0.5)?;
        Ok(self.normal.speeds_of(&contact, &impact))
    }
}
