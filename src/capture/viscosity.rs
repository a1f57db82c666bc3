//! Viscosity criterion: a melt thinner than a reference viscosity sticks (Walsh et al. 1990).
//!
//! `P = min(1, mu_ref / mu(T))`, with `mu` the viscosity of ash or slag [Pa s] at its own
//! temperature and `mu_ref` the viscosity [Pa s] at and below which every impact sticks. The
//! literature's `mu_ref` spans 8 to 1e7 Pa s: it has no default. Valid for glassy silicate melts;
//! on a wall, where a melt has time to crystallise, it is stiff below its temperature of critical
//! viscosity ([`super::Solidification`]). A `crystalline` material below its melting point has no
//! viscosity and does not stick. The constant reference knows no speed: faster than
//! [`FASTEST_WITHOUT_SPEED`] the outcome is marked. It does not include residual carbon (see the effect
//! `conversion-transition`).

use std::sync::Arc;

use fearless_simd::{Level, dispatch};

use super::criterion::lowest;
use super::kinetic_energy::EnergyLaw;
use super::melt::{Melt, MeltLaws};
use super::{MeltStates, StickinessCriterion, Unsuitable, WallState};
use crate::impact::{BLOCK, Block, Impact, ImpactError};
use crate::input::{InputError, Limits, Section};
use crate::material::Material;

/// Speed towards the wall [m/s] up to which criteria that do not know the speed are used without a mark.
/// *Assumed*: they come from tubes and walls of furnaces, where the gas flows with some 1 to 30 m/s; blades of
/// turbines are hit with 100 to 300 m/s.
pub const FASTEST_WITHOUT_SPEED: f64 = 30.0;

/// Probability of sticking [1] from the viscosity and the reference viscosity [both Pa s].
#[inline(always)]
pub fn sticking_probability(viscosity: f64, reference: f64) -> f64 {
    // Without motion every viscosity is below an infinite reference; a solid has none.
    let melt = if reference == f64::INFINITY { 1.0 } else { (reference / viscosity).min(1.0) };
    if viscosity == f64::INFINITY { 0.0 } else { melt }
}

/// From a tenth of the thinnest liquid to far above the viscosity of a solid glass.
const REFERENCE: Limits =
    Limits { unit: "Pa s", low: 1e-7, high: 1e20, known: "literature 8 to 1e7; glass is solid above 1e12" };

/// Viscosity [Pa s] above which melt on a wall counts as solid where no temperature says it: 1e5 poise,
/// between the working point of glass and the point at which it softens under its own weight; assumed.
const SOLID: f64 = 1e4;

/// The reference viscosity of an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
enum ReferenceViscosity {
    /// The same for all [Pa s].
    Constant(f64),
    /// By kinetic energy.
    Energy(EnergyLaw),
}

/// The criterion of viscosity of a `[capture]` table: with a constant reference (`viscosity`), or
/// with one that falls with the kinetic energy (`kinetic-energy`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViscosityCriterion {
    laws: MeltLaws,
    reference: ReferenceViscosity,
}

impl ViscosityCriterion {
    pub(super) fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let laws = MeltLaws::read(section)?;
        let reference = section.quantity("reference_viscosity", &REFERENCE)?.ok_or_else(|| {
            let what = "the viscosity [Pa s] at which every impact sticks (literature: 8 to 1e7)";
            section.missing("reference_viscosity", what)
        })?;
        Ok(Self { laws, reference: ReferenceViscosity::Constant(reference) })
    }

    pub(super) fn read_with_energy(section: &Section<'_>) -> Result<Self, InputError> {
        Ok(Self {
            laws: MeltLaws::read(section)?,
            reference: ReferenceViscosity::Energy(EnergyLaw::read(section)?),
        })
    }

    pub(super) fn describe(self) -> String {
        let reference = match self.reference {
            ReferenceViscosity::Constant(reference) => format!("reference_viscosity {reference} Pa s"),
            ReferenceViscosity::Energy(law) => law.describe(),
        };
        let Self { laws, .. } = self;
        let (law, solidification) = (laws.describe().unwrap_or_default(), laws.solidification());
        format!("{} ({law}), {reference}, solidification {solidification}", self.name())
    }

    /// Key and value [Pa s] of what a reference viscosity is proportional to.
    pub(super) fn number_mut(&mut self) -> (&'static str, &mut f64) {
        match &mut self.reference {
            ReferenceViscosity::Constant(reference) => ("reference_viscosity", reference),
            ReferenceViscosity::Energy(law) => ("coefficient", law.coefficient_mut()),
        }
    }

    /// The model's name in the `[capture]` table.
    pub fn name(self) -> &'static str {
        match self.reference {
            ReferenceViscosity::Constant(_) => "viscosity",
            ReferenceViscosity::Energy(_) => "kinetic-energy",
        }
    }

    /// The criterion for a melt that meets or carries particles of the material `particle`; `None`
    /// for one with neither a viscosity of its own nor an oxide composition. Its own viscosity has
    /// priority.
    ///
    /// # Errors
    /// [`Unsuitable`] when the law cannot be applied to the composition, or the material lacks what
    /// `solidification` needs.
    pub fn prepare(
        self,
        material: &Material,
        particle: &Material,
    ) -> Result<Option<MeltStickiness>, Unsuitable> {
        let (melt, name) = (self.laws.prepare(material)?, material.name().to_owned());
        let of = |melt| MeltStickiness { name, criterion: self, melt, particle: Box::new(particle.clone()) };
        Ok(melt.map(of))
    }
}

/// The criterion for one melt.
#[derive(Debug, Clone)]
pub struct MeltStickiness {
    name: String,
    criterion: ViscosityCriterion,
    melt: Melt,
    /// For the density, where the impact does not give it.
    particle: Box<Material>,
}

impl MeltStickiness {
    /// Viscosity of the liquid [Pa s] at a temperature [K].
    ///
    /// # Errors
    /// [`ImpactError::OutOfRange`] where the material's own viscosity is not known.
    pub fn viscosity(&self, temperature: f64) -> Result<f64, ImpactError> {
        self.melt.viscosity(temperature)
    }

    /// The viscosity [Pa s] up to which this impact sticks.
    fn reference(&self, impact: &Impact) -> f64 {
        match self.criterion.reference {
            ReferenceViscosity::Constant(reference) => reference,
            ReferenceViscosity::Energy(law) => {
                // An unknown density is taken as too large to stick; a material always has one at
                // the nearest temperature.
                let own = self.particle.density_near(impact.particle_temperature).unwrap_or(f64::INFINITY);
                law.at(if impact.particle_density > 0.0 { impact.particle_density } else { own }, impact)
            }
        }
    }
}

impl MeltStickiness {
    /// Sets the stickiness of a block from its viscosities.
    fn each_reference(&self, level: Level, block: &Block, states: &mut MeltStates) {
        let length = block.length.min(BLOCK);
        match self.criterion.reference {
            ReferenceViscosity::Constant(reference) => dispatch!(level, _simd => {
                let (reference, MeltStates { stickiness: sticky, viscosity, .. }) = (reference, &mut *states);
                for index in 0..length {
                    sticky[index] = sticking_probability(viscosity[index], reference);
                }
            }),
            ReferenceViscosity::Energy(_) => {
                for index in 0..length {
                    let reference = self.reference(&block.impact(index));
                    states.stickiness[index] = sticking_probability(states.viscosity[index], reference);
                }
            }
        }
    }

    /// Takes from [`MeltStates::holds`] what is too fast for the criterion, as
    /// [`StickinessCriterion::holds_for_particle`].
    fn hold_by_speed(&self, level: Level, block: &Block, states: &mut MeltStates) {
        let (fastest, length) = (self.fastest(), block.length.min(BLOCK));
        let speeds = &block.inputs[Impact::NORMAL_SPEED][..length];
        let MeltStates { stickiness, holds, .. } = states;
        dispatch!(level, _simd => {
            for index in 0..length {
                holds[index] &= u64::from((speeds[index] <= fastest) | (stickiness[index] == 0.0));
            }
        });
    }
}

impl StickinessCriterion for MeltStickiness {
    fn name(&self) -> &'static str {
        self.criterion.name()
    }

    fn in_flight(&self, impact: &Impact) -> Result<f64, ImpactError> {
        Ok(sticking_probability(self.viscosity(impact.particle_temperature)?, self.reference(impact)))
    }

    /// With the viscosity at both ends of the band of its law.
    fn in_flight_band(&self, impact: &Impact) -> Option<[f64; 2]> {
        let factor = self.melt.band_at(impact.particle_temperature)?;
        let (viscosity, reference) =
            (self.viscosity(impact.particle_temperature).ok()?, self.reference(impact));
        Some([viscosity * factor, viscosity / factor].map(|end| sticking_probability(end, reference)))
    }

    fn describe(&self) -> Option<String> {
        Some(format!("{}: {}", self.name, self.melt.describe()?))
    }

    fn on_wall(&self, impact: &Impact) -> f64 {
        sticking_probability(self.film_viscosity(impact.wall_temperature), self.reference(impact))
    }

    fn wall_state(&self, impact: &Impact) -> WallState {
        let viscosity = self.film_viscosity(impact.wall_temperature);
        WallState {
            stickiness: sticking_probability(viscosity, self.reference(impact)),
            viscosity,
            holds: self.holds_for_wall(impact),
        }
    }

    fn in_flight_each(&self, level: Level, block: &Block, states: &mut MeltStates) {
        let temperatures = &block.inputs[Impact::PARTICLE_TEMPERATURE][..block.length.min(BLOCK)];
        self.melt.viscosities(level, temperatures, &mut states.viscosity);
        self.melt.hold_in_flight(level, temperatures, &mut states.holds);
        self.each_reference(level, block, states);
        self.hold_by_speed(level, block, states);
    }

    fn on_wall_each(&self, level: Level, block: &Block, states: &mut MeltStates) {
        let temperatures = &block.inputs[Impact::WALL_TEMPERATURE][..block.length.min(BLOCK)];
        self.melt.film_viscosities(level, temperatures, &mut states.viscosity);
        self.melt.hold_on_wall(level, temperatures, &mut states.holds);
        self.each_reference(level, block, states);
        self.hold_by_speed(level, block, states);
    }

    fn film_viscosity(&self, temperature: f64) -> f64 {
        self.melt.film_viscosity(temperature)
    }

    fn glass_viscosity(&self, temperature: f64) -> f64 {
        self.viscosity(temperature).unwrap_or(f64::INFINITY)
    }

    fn liquid_viscosity(&self, temperature: f64) -> Option<f64> {
        self.viscosity(temperature).ok()
    }

    fn reference_viscosity(&self, impact: &Impact) -> Option<f64> {
        Some(self.reference(impact))
    }

    fn stiff_below(&self) -> Option<f64> {
        self.melt.stiff_below()
    }

    fn stiffening_is_known(&self) -> bool {
        self.melt.stiffening_is_known()
    }

    /// Where no temperature is known, below a viscosity of [`SOLID`].
    fn solid_below(&self) -> Option<f64> {
        self.melt
            .stiff_below()
            .or_else(|| lowest(|temperature| self.melt.film_viscosity(temperature) <= SOLID))
    }

    fn known_range(&self) -> [f64; 2] {
        self.melt.known_range()
    }

    /// Only the ratio of the viscosity to its limit counts, so the limit changes.
    fn more_viscous(&self, factor: f64) -> Option<Arc<dyn StickinessCriterion>> {
        let ReferenceViscosity::Constant(reference) = self.criterion.reference else { return None };
        let reference = ReferenceViscosity::Constant(reference / factor);
        Some(Arc::new(Self { criterion: ViscosityCriterion { reference, ..self.criterion }, ..self.clone() }))
    }

    fn stated_range(&self) -> [f64; 2] {
        self.melt.stated_range()
    }

    fn stated_for(&self) -> Option<&'static str> {
        self.melt.stated_for()
    }

    fn fastest(&self) -> f64 {
        match self.criterion.reference {
            ReferenceViscosity::Constant(_) => FASTEST_WITHOUT_SPEED,
            ReferenceViscosity::Energy(_) => f64::INFINITY,
        }
    }

    fn holds_in_flight(&self, temperature: f64) -> bool {
        self.melt.holds_in_flight(temperature)
    }

    fn holds_on_wall(&self, temperature: f64) -> bool {
        self.melt.holds_on_wall(temperature)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thin_melts_stick_always_and_thick_ones_in_proportion() {
        assert_eq!(sticking_probability(10.0, 100.0), 1.0);
        assert_eq!(sticking_probability(1000.0, 100.0), 0.1);
    }
}
