//! Effects: named, removable terms that change the results of the laws. One effect a file.
//!
//! A new effect is one file with an [`EffectInfo`] and one line in [`EFFECTS`]; the model file, the
//! C library and OpenFOAM then know it, and tests demand its line in the documents.

mod adhesion_energy;
mod agglomerates;
mod closed_form;
mod conversion_decline;
mod conversion_transition;
mod correction;
mod curve_input;
mod curve_reader;
mod dry_on_melt;
mod fitted_curve;
mod fitted_form;
mod form_reader;
mod gas_lift;
mod liquid_film;
mod melting_transition;
mod micro_roughness;
mod nano_roughness;
mod oblique_angle;
mod powder_layer;
mod size_dependent_yield;
mod sliding_to_rolling;
mod strain_rate_hardening;
mod tangential_compliance;
mod thermal_softening;
mod transition;
mod viscoelastic_loss;
mod yield_ratio;

use std::sync::Arc;

pub use closed_form::{FORMS, FormInfo};
pub(crate) use correction::shifted_probability;
pub use correction::{Correction, CurveTarget, Operation};
pub use curve_input::CurveInput;
pub use fitted_curve::{CurveAxis, FittedCurve};
pub use fitted_form::FittedForm;

use crate::group::Declared;
use crate::impact::Impact;
use crate::input::{InputError, Section, unknown};
use crate::law::describe_values;
pub use crate::law::{Parameter, QuantityKind, Search};
use crate::normal::Contact;
use crate::tangential::{ImpactKinematics, Rebound};
pub use dry_on_melt::DryOnMelt;
pub use transition::Transition;

/// Every effect that is a law. A diagnosis takes its candidates from here.
pub const EFFECTS: [&EffectInfo; 19] = [
    &yield_ratio::INFO,
    &adhesion_energy::INFO,
    &oblique_angle::INFO,
    &gas_lift::INFO,
    &sliding_to_rolling::INFO,
    &tangential_compliance::INFO,
    &nano_roughness::INFO,
    &micro_roughness::INFO,
    &agglomerates::INFO,
    &powder_layer::INFO,
    &liquid_film::INFO,
    &dry_on_melt::INFO,
    &melting_transition::INFO,
    &conversion_transition::INFO,
    &conversion_decline::INFO,
    &thermal_softening::INFO,
    &size_dependent_yield::INFO,
    &strain_rate_hardening::INFO,
    &viscoelastic_loss::INFO,
];

/// Corrections without a law, which a diagnosis fits where no law explains the data.
pub const CURVES: [&EffectInfo; 3] =
    [&fitted_curve::FITTED_CURVE, &fitted_form::INFO, &fitted_curve::LEVEL_SHIFT];

/// Streams of [`ImpactRng`](crate::ImpactRng). Each random effect has its own, so that no two draw the same number.
pub mod stream {
    /// Whether a particle is captured (no effect).
    pub const CAPTURE: u64 = 0;
    /// How much of the work of adhesion is left.
    pub const NANO_ROUGHNESS: u64 = 1;
    /// Tilt of the local wall.
    pub const MICRO_ROUGHNESS: u64 = 2;
    /// Whether a particle is an agglomerate, and how it rebounds.
    pub const AGGLOMERATES: u64 = 3;
    /// Whether the impact meets the covered or the bare share of the wall (no effect).
    pub const COVER: u64 = 4;
}

/// A named term of a model. Each method belongs to one step of an impact; an effect overrides those on which it acts.
///
/// `chance` is a uniform random number in (0, 1), drawn for each impact and each effect with an
/// [`EffectInfo::stream`]; other effects receive zero.
pub trait Effect: Send + Sync + std::fmt::Debug {
    /// Tilt of the local wall towards the particle [rad]; tilts of several effects add.
    fn tilt(&self, _impact: &Impact, _chance: f64) -> f64 {
        0.0
    }

    /// Changes the contact before the normal law.
    fn contact(&self, _impact: &Impact, contact: Contact, _chance: f64) -> Contact {
        contact
    }

    /// Stickiness of the particle, 0 to 1; that of several effects is multiplied. `None` for an
    /// effect that does not act on it.
    fn particle_stickiness(&self, _impact: &Impact) -> Option<f64> {
        None
    }

    /// Factor on the particle's stickiness [1], 0 to 1; it makes nothing sticky by itself.
    fn stickiness_factor(&self, _impact: &Impact) -> f64 {
        1.0
    }

    /// Share of `e_n` that a fully sticky particle loses where it still rebounds [1]; of several effects the largest.
    fn rebound_loss(&self) -> f64 {
        0.0
    }

    /// Changes the normal restitution `e_n` [1] of a particle that rebounds; `None` holds it on the
    /// wall. `contact` is that of the normal law.
    fn normal_restitution(
        &self,
        _impact: &Impact,
        _contact: &Contact,
        restitution: f64,
        _chance: f64,
    ) -> Option<f64> {
        Some(restitution)
    }

    /// Whether the effect may leave more energy than came in, so that the model has to bound it; such an
    /// effect has no precomputed form.
    fn may_add_energy(&self) -> bool {
        false
    }

    /// Whether the effect depends on [`Contact::melt`], the melt that the particle meets.
    fn uses_melt(&self) -> bool {
        false
    }

    /// What the melt on the wall does to a dry particle; `None` for an effect that does not say.
    fn on_melt(&self, _impact: &Impact, _contact: &Contact) -> Option<OnMelt> {
        None
    }

    /// The precomputed form of the effect, if any.
    fn precompute(&self) -> Option<Precomputed> {
        None
    }

    /// What the effect corrects after all laws and effects, in the last step of an impact; `None`
    /// for an effect that is a law.
    fn correction(&self) -> Option<&dyn Correction> {
        None
    }

    /// Viscosity [Pa s] of the liquid film on the wall, where the effect states one.
    fn film_viscosity(&self) -> Option<f64> {
        None
    }

    /// Changes the result of the tangential law.
    fn tangential(&self, _kinematics: &ImpactKinematics, rebound: Rebound) -> Rebound {
        rebound
    }
}

/// What a melt on the wall does to a dry particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OnMelt {
    /// It sinks: the melt draws it in.
    Sinks,
    /// Drag and surface tension hold it on the surface.
    Held,
    /// It leaves with this normal restitution [1].
    Rebounds(f64),
}

/// An effect that is computed when the model is read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Precomputed {
    /// It sets `c = p_y / sigma_y` [1] of every contact.
    YieldRatio(f64),
    /// It sets the work of adhesion [J/m²] of every contact.
    WorkOfAdhesion(f64),
    /// It decides what a melt on the wall does to a dry particle, and nothing else.
    OnMelt(DryOnMelt),
    /// It makes the particle sticky by one input, and reduces its rebound.
    Transition(Transition),
}

/// Id, description and parameters of an effect.
#[derive(Debug)]
pub struct EffectInfo {
    /// The id in model files and diagnoses.
    pub id: &'static str,
    /// One line of description.
    pub about: &'static str,
    /// Names of the [`INPUTS`](crate::impact::INPUTS) on which it depends.
    pub inputs: &'static [&'static str],
    /// Its own stream of random numbers; `None` for an effect without random draws.
    pub stream: Option<u64>,
    /// Its parameters; those without a default must be given.
    pub parameters: &'static [Parameter],
    /// Builds the effect from the values of its parameters, in their order.
    pub build: fn(&[f64]) -> Box<dyn Effect>,
}

/// An effect of a model with its parameters and the range of the data to which it was fitted.
#[derive(Debug, Clone)]
pub struct Term {
    kind: &'static EffectInfo,
    values: Vec<f64>,
    valid: Vec<(usize, [f64; 2])>,
    /// The same for the inputs that the model file declares, by place in [`Impact::extra`].
    valid_extra: Vec<(usize, [f64; 2])>,
    /// The same for groups.
    valid_groups: Vec<(CurveInput, [f64; 2])>,
    effect: Arc<dyn Effect>,
}

impl Term {
    /// The effect of this kind with the given parameters, in the order of [`EffectInfo::parameters`].
    pub fn new(kind: &'static EffectInfo, values: &[f64]) -> Self {
        Self::of(kind, values.to_vec(), (kind.build)(values).into())
    }

    /// The same with other parameters, in the order of [`EffectInfo::parameters`].
    #[must_use]
    pub fn with_values(&self, values: &[f64]) -> Self {
        Self { values: values.to_vec(), effect: (self.kind.build)(values).into(), ..self.clone() }
    }

    /// A correction without a law; without axes it is a level shift.
    pub fn fitted_curve(curve: FittedCurve) -> Self {
        if curve.axes.is_empty() {
            return Self::of(&fitted_curve::LEVEL_SHIFT, curve.values.clone(), Arc::new(curve));
        }
        Self::of(&fitted_curve::FITTED_CURVE, Vec::new(), Arc::new(curve))
    }

    /// A closed form without a law.
    pub fn fitted_form(form: FittedForm) -> Self {
        Self::of(&fitted_form::INFO, Vec::new(), Arc::new(form))
    }

    fn of(kind: &'static EffectInfo, values: Vec<f64>, effect: Arc<dyn Effect>) -> Self {
        let (valid, valid_extra, valid_groups) = Default::default();
        Self { kind, values, valid, valid_extra, valid_groups, effect }
    }

    /// Reads one `[[effects]]` table; `declared` is what the model file declares.
    ///
    /// # Errors
    /// [`InputError::Fault`] for an unknown kind, or a parameter that is unknown, missing or out of bounds.
    pub fn read(section: &Section<'_>, declared: &Declared<'_>) -> Result<Self, InputError> {
        let id = section.required_text("kind")?;
        let law = EFFECTS.into_iter().find(|kind| kind.id == id);
        let curve = CURVES.into_iter().find(|kind| kind.id == id);
        let term = match (law, curve) {
            (Some(kind), _) => {
                let values = kind.parameters.iter().map(|parameter| parameter.read(section));
                Self::new(kind, &values.collect::<Result<Vec<f64>, _>>()?)
            }
            (None, Some(kind)) if kind.id == fitted_form::INFO.id => {
                Self::fitted_form(form_reader::read(section, declared)?)
            }
            (None, Some(kind)) => Self::fitted_curve(curve_reader::read(kind, section, declared)?),
            (None, None) => {
                let ids: Vec<&str> = EFFECTS.iter().chain(&CURVES).map(|kind| kind.id).collect();
                return Err(section.fault("kind", unknown(&id, "effect", &ids)));
            }
        };
        section.text("source")?;
        let ranges = section.section("valid")?.map(|table| read_valid(&table, declared)).transpose()?;
        section.finish()?;
        let Ranges { inputs: valid, extra: valid_extra, groups: valid_groups } = ranges.unwrap_or_default();
        Ok(Self { valid, valid_extra, valid_groups, ..term })
    }

    /// What kind of effect it is.
    pub fn kind(&self) -> &'static EffectInfo {
        self.kind
    }

    /// Its parameters, in the order of [`EffectInfo::parameters`].
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The ranges of [`INPUTS`](crate::impact::INPUTS) to which the term was fitted, by place in that list.
    pub fn valid(&self) -> &[(usize, [f64; 2])] {
        &self.valid
    }

    /// As [`Self::valid`] of the inputs that the model file declares.
    pub(crate) fn valid_extra(&self) -> &[(usize, [f64; 2])] {
        &self.valid_extra
    }

    /// As [`Self::valid`] of groups.
    pub fn valid_groups(&self) -> &[(CurveInput, [f64; 2])] {
        &self.valid_groups
    }

    /// The inputs and groups that a correction depends on; none for a law.
    pub fn corrected_by(&self) -> Vec<CurveInput> {
        self.effect().correction().map(Correction::inputs).unwrap_or_default()
    }

    /// The effect itself.
    pub fn effect(&self) -> &dyn Effect {
        self.effect.as_ref()
    }

    /// The random number of the effect for one impact; `uniform` gives the number of each stream.
    pub fn chance(&self, uniform: &impl Fn(u64) -> f64) -> f64 {
        self.kind.stream.map_or(0.0, uniform)
    }

    /// Its kind and its numbers in words, with the names that the model file declares.
    pub(crate) fn describe(&self, declared: &Declared<'_>) -> String {
        let details = match self.effect().correction() {
            Some(correction) => correction.describe(declared),
            None => describe_values(self.kind.parameters, &self.values).join(", "),
        };
        format!("{}: {details}", self.kind.id)
    }
}

/// The ranges of a `valid` table.
#[derive(Default)]
struct Ranges {
    inputs: Vec<(usize, [f64; 2])>,
    extra: Vec<(usize, [f64; 2])>,
    groups: Vec<(CurveInput, [f64; 2])>,
}

/// Reads `valid = { v_n = [0.5, 3], ... }`: the range of inputs and groups in the data of a fit.
fn read_valid(section: &Section<'_>, declared: &Declared<'_>) -> Result<Ranges, InputError> {
    let mut ranges = Ranges::default();
    for name in CurveInput::names(declared) {
        let range = || section.range(name);
        match CurveInput::named(name, declared) {
            Some(CurveInput::Input(place)) => ranges.inputs.extend(range()?.map(|range| (place, range))),
            Some(CurveInput::Extra(place)) => ranges.extra.extend(range()?.map(|range| (place, range))),
            Some(group @ (CurveInput::Group(_) | CurveInput::Product(_))) => {
                ranges.groups.extend(range()?.map(|range| (group, range)));
            }
            Some(CurveInput::Label(_)) | None => {}
        }
    }
    section.finish()?;
    Ok(ranges)
}

/// A factor on a strength, clamped to twelve decades either way; beyond, numbers would overflow.
fn bounded(factor: f64) -> f64 {
    factor.clamp(1e-12, 1e12)
}

/// Helpers for the tests of effects.
#[cfg(test)]
mod testing {
    use crate::material::Library;
    use crate::normal::Contact;
    pub use crate::tangential::testing::{kinematics, momentum_is_kept};

    /// Troiano's wax on Pyrex, with `c = 0.7`.
    pub fn wax_on_pyrex() -> Contact {
        let library = Library::built_in().unwrap();
        let solid = |name: &str| library.get(name).unwrap().mechanical(293.15).unwrap();
        Contact::new(&solid("montan-wax"), &solid("pyrex"), 0.7, None)
    }

    /// Evenly spaced numbers in (0, 1).
    pub fn even(count: u32) -> impl Iterator<Item = f64> {
        (0..count).map(move |index| (f64::from(index) + 0.5) / f64::from(count))
    }
}
