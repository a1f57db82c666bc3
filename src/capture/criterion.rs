//! The `[capture]` table: the criterion for the stickiness of a melt, and how particle and wall combine.
//!
//! A criterion applies to the particle at its own temperature, and to the melt on a wall at the
//! wall's: to the slag that the model file puts there and to what molten particles left. `droplet`
//! applies to particles alone: a deposit has no speed and is sticky when it is molten.

use std::sync::Arc;

use fearless_simd::Level;

use super::drop_bounce::StatedNumber;
use super::droplet::DropletCriterion;
use super::fusion::FusionCriterion;
use super::melt_fraction::MeltFractionCriterion;
use super::stickiness::{Combination, Stickiness};
use super::viscosity::ViscosityCriterion;
use crate::impact::{BLOCK, Block, Impact, ImpactError};
use crate::input::{InputError, Section};
use crate::law::QuantityKind;
use crate::material::Material;
use crate::slag::{OutsideAshes, UnsuitableComposition};

/// The kinds of the numbers of a `[capture]` table.
pub(crate) const CAPTURE_KINDS: [(&str, QuantityKind); 4] = [
    ("sticky_from", QuantityKind::Share),
    ("flows_from", QuantityKind::Share),
    ("contact_angle", QuantityKind::Angle),
    ("receding_angle", QuantityKind::Angle),
];

/// A `[capture]` table.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Capture {
    /// The criterion; `None` for `model = "none"`.
    pub criterion: Option<Criterion>,
    /// How the stickiness of particle and wall combine.
    pub combination: Combination,
}

/// The criterion of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Criterion {
    /// A melt of low viscosity sticks; the limit is constant or falls with the kinetic energy.
    Viscosity(ViscosityCriterion),
    /// A particle with enough liquid sticks.
    MeltFraction(MeltFractionCriterion),
    /// An ash sticks between its deformation and its flow temperature.
    Fusion(FusionCriterion),
    /// A droplet that does not splash stays.
    Droplet(DropletCriterion),
}

/// Why a criterion does not apply to a material.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Unsuitable {
    /// The viscosity law does not apply to its composition.
    #[error(transparent)]
    Composition(#[from] UnsuitableComposition),
    /// Its viscosity has to follow from its composition, and no law is given.
    #[error(
        "`{material}` has a composition but no viscosity; add law = \"{}\" to [capture], or give viscosity to the \
            material",
        crate::slag::urbain::KALMANOVITCH_FRANK.name
    )]
    NoLaw {
        /// The material's name.
        material: String,
    },
    /// Its fusion temperatures have to follow from its composition, which no fitted ash has.
    #[error("`{material}`: {reason}; give fusion_temperatures to the material")]
    NoEstimate {
        /// The material's name.
        material: String,
        /// What is outside the fitted ashes.
        reason: OutsideAshes,
    },
    /// The criterion needs properties that it lacks.
    #[error(
        "`{material}` has no {}, which [capture] {needed_by} needs; give it to the material in [materials.{material}]",
        .lacking.join(", no ")
    )]
    Lacking {
        /// The material's name.
        material: String,
        /// The key of the `[capture]` table that needs them, with its value.
        needed_by: &'static str,
        /// The keys that it lacks.
        lacking: Vec<&'static str>,
    },
}

impl Capture {
    /// Reads a `[capture]` table.
    ///
    /// # Errors
    /// [`InputError::Fault`] for an unknown model or law, or a missing or impossible number.
    pub fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let models = ["none", "viscosity", "kinetic-energy", "melt-fraction", "fusion", "droplet"];
        let criterion = match section.choice("model", &models)?.as_deref() {
            Some("viscosity") => Some(Criterion::Viscosity(ViscosityCriterion::read(section)?)),
            Some("kinetic-energy") => {
                Some(Criterion::Viscosity(ViscosityCriterion::read_with_energy(section)?))
            }
            Some("melt-fraction") => Some(Criterion::MeltFraction(MeltFractionCriterion::read(section)?)),
            Some("fusion") => Some(Criterion::Fusion(FusionCriterion::read(section)?)),
            Some("droplet") => Some(Criterion::Droplet(DropletCriterion::read(section)?)),
            _ => None,
        };
        Ok(Self { criterion, combination: Combination::read(section)? })
    }

    /// The table in words; `None` without a criterion.
    pub fn describe(self) -> Option<String> {
        let combination = self.combination.describe();
        self.criterion.map(|criterion| format!("{}, combination {combination}", criterion.describe()))
    }

    /// The stickiness of particles of a material; `None` without a criterion that applies to it.
    ///
    /// # Errors
    /// As [`Criterion::of_particle`].
    pub(crate) fn of_particle(
        self,
        material: &Material,
    ) -> Result<Option<Arc<dyn StickinessCriterion>>, Unsuitable> {
        Ok(self.criterion.map(|criterion| criterion.of_particle(material)).transpose()?.flatten())
    }

    /// The stickiness of slag on a wall that particles of a material meet; `None` as in [`Self::of_particle`].
    ///
    /// # Errors
    /// As [`Criterion::of_slag`].
    pub(crate) fn of_slag(
        self,
        slag: &Material,
        particle: &Material,
    ) -> Result<Option<Arc<dyn StickinessCriterion>>, Unsuitable> {
        Ok(self.criterion.map(|criterion| criterion.of_slag(slag, particle)).transpose()?.flatten())
    }
}

impl Criterion {
    fn describe(self) -> String {
        match self {
            Self::Viscosity(criterion) => criterion.describe(),
            Self::MeltFraction(criterion) => criterion.describe(),
            Self::Fusion(criterion) => criterion.describe(),
            Self::Droplet(criterion) => criterion.describe(),
        }
    }

    /// The criterion for particles of a material; `None` when it does not apply to that.
    ///
    /// # Errors
    /// [`Unsuitable`] when the material lacks what the criterion needs.
    pub fn of_particle(
        self,
        material: &Material,
    ) -> Result<Option<Arc<dyn StickinessCriterion>>, Unsuitable> {
        match self {
            Self::Viscosity(_) | Self::MeltFraction(_) | Self::Fusion(_) => self.of_slag(material, material),
            Self::Droplet(criterion) => Ok(Some(Arc::new(criterion.prepare(material)?))),
        }
    }

    /// The criterion for slag of a material on a wall that particles of the material `particle`
    /// meet; `None` when it does not apply to that slag.
    ///
    /// # Errors
    /// As [`Criterion::of_particle`].
    pub fn of_slag(
        self,
        slag: &Material,
        particle: &Material,
    ) -> Result<Option<Arc<dyn StickinessCriterion>>, Unsuitable> {
        match self {
            Self::Viscosity(criterion) => {
                Ok(criterion.prepare(slag, particle)?.map(|melt| Arc::new(melt) as _))
            }
            Self::MeltFraction(criterion) => Ok(criterion.prepare(slag).map(|melt| Arc::new(melt) as _)),
            Self::Fusion(criterion) => Ok(criterion.prepare(slag)?.map(|melt| Arc::new(melt) as _)),
            Self::Droplet(_) => Ok(None),
        }
    }

    /// What a melt needs so that the criterion applies to it, in words.
    pub fn needs(self) -> &'static str {
        match self {
            Self::Viscosity(_) => "a composition or a viscosity",
            Self::MeltFraction(_) => "a melt_fraction",
            Self::Fusion(_) => "fusion_temperatures or a composition",
            Self::Droplet(_) => "a melt",
        }
    }
}

/// A material on a wall, as one impact meets it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallState {
    /// Its stickiness [1].
    pub stickiness: f64,
    /// Its viscosity [Pa s], infinite where it is stiff.
    pub viscosity: f64,
    /// Whether the criterion is stated for it.
    pub holds: bool,
}

/// A material in flight or on a wall, as a block of impacts meets it.
#[derive(Debug, Clone)]
pub struct MeltStates {
    /// Its stickiness [1].
    pub stickiness: [f64; BLOCK],
    /// Its viscosity [Pa s], infinite where it is stiff.
    pub viscosity: [f64; BLOCK],
    /// 1 where the criterion is stated for it, else 0.
    pub holds: [u64; BLOCK],
}

impl Default for MeltStates {
    /// A material that is never sticky.
    fn default() -> Self {
        Self { stickiness: [0.0; BLOCK], viscosity: [f64::INFINITY; BLOCK], holds: [1; BLOCK] }
    }
}

/// Highest temperature [K] at which a deposit is asked whether it is liquid.
const HOTTEST: f64 = 6000.0;

/// The lowest temperature [K] at which a condition holds that holds above it; `None` where it does not
/// hold at [`HOTTEST`], 0 where it always holds.
pub(crate) fn lowest(holds: impl Fn(f64) -> bool) -> Option<f64> {
    let [mut low, mut high] = [1.0, HOTTEST];
    if holds(low) {
        return Some(0.0);
    }
    if !holds(high) {
        return None;
    }
    while high - low > 1e-12 * high {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if holds(middle) { high = middle } else { low = middle }
    }
    Some(high)
}

/// A criterion for one material.
pub trait StickinessCriterion: std::fmt::Debug + Send + Sync {
    /// The model's name in the `[capture]` table.
    fn name(&self) -> &'static str;

    /// Stickiness of the particle [1], at its own temperature: quenched in flight, its melt does not crystallise.
    ///
    /// # Errors
    /// [`ImpactError::OutOfRange`] where a required property is not known.
    fn in_flight(&self, impact: &Impact) -> Result<f64, ImpactError>;

    /// Both ends of the 90 % band of [`Self::in_flight`]; `None` where it is not known.
    fn in_flight_band(&self, _impact: &Impact) -> Option<[f64; 2]> {
        None
    }

    /// Stickiness [1] of the material on a wall, at the wall's temperature, where it had time to
    /// crystallise. Outside a table the value at its nearest end, or 0 where that is colder. By the
    /// droplet criterion it is 1 above the melting point and 0 below.
    fn on_wall(&self, impact: &Impact) -> f64;

    /// [`Self::on_wall`], [`Self::film_viscosity`] and [`Self::holds_for_wall`] of one impact.
    fn wall_state(&self, impact: &Impact) -> WallState {
        let temperature = impact.wall_temperature;
        WallState {
            stickiness: self.on_wall(impact),
            viscosity: self.film_viscosity(temperature),
            holds: self.holds_for_wall(impact),
        }
    }

    /// [`Self::in_flight`] and [`Self::holds_for_particle`] of a block of impacts whose particles have a temperature in
    /// [`Self::known_range`], with the vectors of `level`.
    fn in_flight_each(&self, _level: Level, block: &Block, states: &mut MeltStates) {
        for index in 0..block.length.min(BLOCK) {
            let impact = block.impact(index);
            // In the known range there is no error.
            states.stickiness[index] = self.in_flight(&impact).unwrap_or(f64::NAN);
            states.holds[index] = u64::from(self.holds_for_particle(&impact));
        }
    }

    /// [`Self::wall_state`] of a block of impacts, with the vectors of `level`.
    fn on_wall_each(&self, _level: Level, block: &Block, states: &mut MeltStates) {
        for index in 0..block.length.min(BLOCK) {
            let WallState { stickiness, viscosity, holds } = self.wall_state(&block.impact(index));
            states.stickiness[index] = stickiness;
            states.viscosity[index] = viscosity;
            states.holds[index] = u64::from(holds);
        }
    }

    /// Viscosity [Pa s] of the material on a wall at a temperature [K]: infinite where it is
    /// frozen, too stiff to flow, or below a measured table, and that at the end of the table above
    /// it.
    fn film_viscosity(&self, temperature: f64) -> f64;

    /// Viscosity [Pa s] at a temperature [K] of what has not crystallised, as quenched particles
    /// that sinter: infinite where it is not known.
    fn glass_viscosity(&self, _temperature: f64) -> f64 {
        f64::INFINITY
    }

    /// Viscosity [Pa s] of the liquid in flight at a temperature [K]; `None` where the criterion has none or does
    /// not know it.
    fn liquid_viscosity(&self, _temperature: f64) -> Option<f64> {
        None
    }

    /// Viscosity [Pa s] at and below which this impact sticks; `None` for a criterion without one.
    fn reference_viscosity(&self, _impact: &Impact) -> Option<f64> {
        None
    }

    /// Normal restitution [1] of a droplet that bounces whole from a wall of this material; `None`
    /// for one that does not, and for what is not a droplet.
    ///
    /// # Errors
    /// As [`StickinessCriterion::in_flight`].
    fn droplet_rebound(&self, _impact: &Impact, _wall: &Material) -> Result<Option<f64>, ImpactError> {
        Ok(None)
    }

    /// The numbers of a droplet's rebound that lie outside of the range of its law; none for what has no such law.
    fn left_by_rebound(&self, _impact: &Impact) -> Vec<StatedNumber> {
        Vec::new()
    }

    /// Temperature [K] below which the material is stiff on a wall; `None` for one without such a temperature.
    fn stiff_below(&self) -> Option<f64> {
        None
    }

    /// Whether it is known where the material stiffens on a wall; otherwise it counts as a liquid.
    fn stiffening_is_known(&self) -> bool {
        true
    }

    /// What the criterion knows of the material, in words, where a model file does not show it.
    fn describe(&self) -> Option<String> {
        None
    }

    /// Temperature [K] below which what lies on a wall is solid: that of [`Self::stiff_below`], else that
    /// at which it is sticky without an impact. It depends on no speed. `None` for a material that is
    /// solid at every temperature; 0 for one that is liquid at every temperature.
    fn solid_below(&self) -> Option<f64> {
        let sticky = |temperature: f64| {
            let lying = Impact { wall_temperature: temperature, ..Impact::default() };
            self.on_wall(&lying) >= Stickiness::THRESHOLD
        };
        self.stiff_below().or_else(|| lowest(sticky))
    }

    /// Whether particles may be droplets.
    fn has_droplets(&self) -> bool {
        false
    }

    /// Whether a particle at a temperature [K] is a droplet, whose capture does not depend on the wall.
    fn is_droplet(&self, _temperature: f64) -> bool {
        false
    }

    /// Temperatures [K] at which the criterion can be evaluated.
    fn known_range(&self) -> [f64; 2];

    /// The criterion for a material that is `factor` [1] times as viscous; `None` where no viscosity decides.
    fn more_viscous(&self, _factor: f64) -> Option<Arc<dyn StickinessCriterion>> {
        None
    }

    /// Temperatures [K] for which the criterion is stated for this material; from infinity to 0 for none.
    fn stated_range(&self) -> [f64; 2] {
        self.known_range()
    }

    /// The compositions for which it is stated, in words, where this material's is none of them.
    fn stated_for(&self) -> Option<&'static str> {
        None
    }

    /// Speed towards the wall [m/s] up to which the criterion is stated; infinite for one that knows the speed.
    fn fastest(&self) -> f64 {
        f64::INFINITY
    }

    /// Whether the criterion is stated for an impact of a particle of this material, by temperature and
    /// speed. What does not stick at any speed is stated at every speed.
    fn holds_for_particle(&self, impact: &Impact) -> bool {
        self.holds_in_flight(impact.particle_temperature)
            && (impact.normal_speed <= self.fastest() || self.in_flight(impact) == Ok(0.0))
    }

    /// As [`Self::holds_for_particle`], of an impact on a wall with this material on it.
    fn holds_for_wall(&self, impact: &Impact) -> bool {
        self.holds_on_wall(impact.wall_temperature)
            && (impact.normal_speed <= self.fastest() || self.on_wall(impact) == 0.0)
    }

    /// Whether the criterion is stated for this material in flight at a temperature [K].
    fn holds_in_flight(&self, temperature: f64) -> bool;

    /// Whether the criterion is stated for this material on a wall at a temperature [K].
    fn holds_on_wall(&self, temperature: f64) -> bool {
        self.holds_in_flight(temperature)
    }
}
