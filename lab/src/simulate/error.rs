//! Why a case cannot be run or a particle cannot be followed.

use nearwall::impact::ImpactError;
use nearwall::material::OutOfRange;

/// Why a case cannot be run or a particle cannot be followed.
#[expect(missing_docs, reason = "the message of a variant says what its fields are")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SimulationError {
    /// A model cannot decide an impact, or lacks a property.
    #[error(transparent)]
    Impact(#[from] ImpactError),
    /// The deposit of a wall cannot be formed.
    #[error("{wall}: {reason}")]
    Wall { wall: String, reason: String },
    /// A path needs more steps of integration than allowed.
    #[error("the path takes more than {0} integration steps")]
    TooManySteps(usize),
    /// The equations of motion give no finite number.
    #[error("the state of the particle is no longer finite")]
    NotFinite,
    /// A sweep cannot set the temperature of a cooled wall.
    #[error("the wall `{0}` is cooled, so its temperature cannot be set")]
    CooledWall(String),
    /// A property of the gas is not known at its temperature [K], but in a range [K].
    #[error(
        "gas.{key} is given for {} to {} K, but the gas has {temperature} K in this case; widen the table",
        .known.low, .known.high
    )]
    GasProperty { key: &'static str, temperature: f64, known: OutOfRange },
    /// The ash of a particle is larger than the particle: densities of both [kg/m³], share of the ash [% of mass].
    #[error(
        "ash of {ash_density} kg/m3 does not fit into a particle of {density} kg/m3 with {ash_percent} % ash; \
         raise ash_density"
    )]
    AshTooLarge { ash_density: f64, density: f64, ash_percent: f64 },
    /// A particle melts and no melting point is known.
    #[error("the material `{0}` has no melting_point; add melting_point to the particles")]
    NoMeltingPoint(String),
    /// Thermophoresis pushes a particle whose thermal conductivity is not known.
    #[error("the material `{0}` has no thermal_conductivity; add conductivity to the particles")]
    NoConductivity(String),
    /// A particle starts in or behind a surface.
    #[error("starts in or behind `{0}`; move the start or turn the normal")]
    Misplaced(String),
}

impl SimulationError {
    /// Adds the name of the wall to a reason.
    pub(super) fn at_wall<E: ToString>(wall: &str) -> impl Fn(E) -> Self {
        move |error| Self::Wall { wall: wall.to_owned(), reason: error.to_string() }
    }
}

impl From<SimulationError> for String {
    fn from(error: SimulationError) -> Self {
        error.to_string()
    }
}
