//! The steps of an impact on a wall whose contact differs between impacts: properties over temperature, char that becomes ash, slag, powder.
//!
//! Everything that model and wall decide is looked up when the model is read. A single impact ([`VaryingWall::resolve`]) and a block of
//! impacts ([`VaryingWall::resolve_block`]) run the same steps; in a block each set of steps is a loop without branches over columns. A
//! model with a law by name, or with a term that has no precomputed form ([`Precomputed`]), runs its impacts one by one.
//!
//! An impact of a patchwork meets its covered or its bare share (`general_wall.rs`): the share that it meets is evaluated whole, of the
//! other one only what the probability of capture and the range need.

use std::sync::Arc;

use super::evaluation::{
    Corrected, ImpactState, NormalRebound, OnBareWall, StepSet, WallSteps, both_shares, evaluate,
};
use super::particle::{contact_of, density_of};
use super::prepared_wall::{Tangential, Transitions, within};
use super::wall::{Adhesion, Wall};
use super::{Model, TemperatureRanges};
use crate::capture::{Combination, Stickiness, StickinessCriterion, WallState};
use crate::deposit::WallMelt;
use crate::effect::{DryOnMelt, OnMelt, Precomputed, Term, stream};
use crate::impact::{INPUTS, Impact, Outcome};
use crate::material::{Material, Mechanical, Property};
use crate::normal::{Contact, NormalLaw, work_of_adhesion};
use crate::rng::ImpactRng;
use crate::tangential::{ImpactKinematics, Rebound};

/// What is known of a wall and its particles before an impact.
#[derive(Debug, Clone)]
pub(super) struct VaryingWall {
    /// Char, ash, the bare wall and the powder on it; ash and powder are as char and wall where there are none.
    pub(super) solids: Arc<[Solid; 4]>,
    has_powder: bool,
    /// Whether covered and bare share differ.
    pub(super) patchwork: bool,
    pub(super) in_flight: Option<Arc<dyn StickinessCriterion>>,
    pub(super) slag: Option<Arc<dyn StickinessCriterion>>,
    pub(super) constants: Constants,
    pub(super) known: TemperatureRanges,
    /// Which of [`INPUTS`] has to lie in which range for the terms.
    pub(super) valid: Vec<(usize, [f64; 2])>,
    /// Whether a term has no precomputed form, or a law is one by name.
    pub(super) one_by_one: bool,
}

/// What the steps need of the wall.
#[derive(Debug, Clone, Copy)]
pub(super) struct Constants {
    pub has_ash: bool,
    /// Whether char and ash have a fitted work of adhesion.
    pub fitted: [bool; 2],
    /// Work of adhesion [J/m²] of char and ash with the bare wall and with powder, where it is the same for all impacts.
    pub works: Option<[[f64; 2]; 2]>,
    pub adhesion: Adhesion,
    /// `e_n` [1] of the constant law; `None` for Thornton–Ning.
    pub constant: Option<f64>,
    pub tangential: Tangential,
    /// Surface tension [N/m] of the slag; NaN without slag or where it has none.
    pub surface_tension: f64,
    pub transitions: Transitions,
    pub on_melt: Option<DryOnMelt>,
    pub combination: Combination,
    pub rebound_loss: f64,
    /// Temperatures [K] for which the properties of char, ash and wall are stated.
    pub stated: [[f64; 2]; 3],
}

/// The mechanical properties of a solid.
#[derive(Debug, Clone)]
pub(super) struct Solid {
    /// Values of the properties in the order of [`Mechanical`]; those that vary have none here.
    pub constant: [f64; 6],
    /// Those that depend on temperature.
    pub varying: [Option<Box<Property>>; 6],
    /// Whether it has a fitted work of adhesion.
    pub fitted: bool,
}

/// The state of particle and wall in an impact, whatever place it meets.
pub(super) struct Met {
    /// Char and ash.
    pub particle_solids: [Mechanical; 2],
    /// Stickiness of the particle [1].
    pub particle: f64,
    pub flight_holds: bool,
    pub slag: WallState,
    /// The melt for terms that ask for it.
    pub melt: Option<WallMelt>,
    /// Restitution [1] that the melt leaves a dry particle: 0 where it holds it, NaN without a liquid or a term for it.
    pub on_melt: f64,
    /// Random number of the capture.
    pub chance: f64,
    /// Density of the particle [kg/m³].
    pub density: f64,
}

/// One impact at one place; `TERMS` where terms without a precomputed form or a law by name act.
pub(super) struct VaryingImpact<'a, const TERMS: bool> {
    pub wall: &'a Constants,
    /// The terms, where they have no precomputed form.
    pub terms: &'a [Term],
    pub met: &'a Met,
    /// The model, for laws by name and corrections, and the impact on the wall as a whole.
    pub reaching: Option<(&'a Model, &'a Impact)>,
    pub covered: bool,
    /// What it meets there.
    pub partner: Mechanical,
    /// Restitution [1] that the melt leaves a dry particle: 0 where it holds it, NaN without a liquid wall.
    pub on_melt: f64,
    pub left_range: bool,
}

impl VaryingWall {
    /// Prepares a wall; `None` where its impacts need the general steps.
    pub fn new(model: &Model, wall: &Wall) -> Option<Self> {
        // A law by name is asked of the model, one impact at a time.
        let (constant, named) = match model.normal {
            NormalLaw::ThorntonNing => (None, false),
            NormalLaw::Constant { restitution } => (Some(restitution), false),
            NormalLaw::PlasticJkr | NormalLaw::Listed { .. } => (None, true),
        };
        let tangential = Tangential::new(model.tangential);
        let random = model.terms.iter().any(|term| term.kind().stream.is_some());
        if random || model.has_droplets() || !model.extra_inputs.is_empty() {
            return None;
        }
        let particle = &model.particle;
        let partner = wall.material();
        let materials =
            [particle.material(), particle.melting(), partner, wall.powder.as_ref().unwrap_or(partner)];
        let [char, ash, bare, powder] = materials.map(Solid::new);
        let (char, ash, bare, powder) = (char?, ash?, bare?, powder?);
        let [of_char, of_ash, of_wall, _] = materials.map(Material::stated_range);
        let mut prepared = Self {
            has_powder: wall.powder.is_some(),
            patchwork: wall.melt.is_some() || wall.powder.is_some(),
            in_flight: model.stickiness.clone(),
            slag: wall.melt.clone(),
            constants: Constants {
                has_ash: particle.ash().is_some(),
                fitted: [char.fitted, ash.fitted],
                works: constant_works(materials, wall.adhesion.work),
                adhesion: wall.adhesion,
                constant,
                tangential: tangential.unwrap_or(Tangential::Constant(0.0)),
                surface_tension: wall.slag.as_ref().map_or(Some(f64::NAN), constant_surface_tension)?,
                transitions: Transitions::None,
                on_melt: None,
                combination: model.capture.combination,
                rebound_loss: model.rebound_loss(),
                stated: [of_char?, of_ash?, of_wall?],
            },
            known: model.ranges_of(wall),
            solids: Arc::new([char, ash, bare, powder]),
            valid: model.terms.iter().flat_map(Term::valid).copied().collect(),
            one_by_one: false,
        };
        prepared.one_by_one = prepared.precompute(&model.terms).is_none() || named || tangential.is_none();
        Some(prepared)
    }

    /// Takes the precomputed forms of all terms; `None` where one has none, or depends on what the place changes.
    fn precompute(&mut self, terms: &[Term]) -> Option<()> {
        let changed = |name| name == "layer_thickness" || name == "coverage" || name == "film_thickness";
        if self.valid.iter().any(|(input, _)| changed(INPUTS[*input].name)) {
            return None;
        }
        let constants = &mut self.constants;
        for term in terms {
            match term.effect().precompute()? {
                Precomputed::YieldRatio(ratio) => constants.adhesion.yield_ratio = ratio,
                Precomputed::WorkOfAdhesion(work) => constants.adhesion.set = Some(work),
                Precomputed::Transition(one) => constants.transitions = constants.transitions.and(one)?,
                Precomputed::OnMelt(on_melt) => constants.on_melt = constants.on_melt.or(Some(on_melt)),
            }
        }
        Some(())
    }

    /// Whether every property is known for an impact.
    #[inline(always)]
    pub fn decides(&self, impact: &Impact) -> bool {
        within(impact.particle_temperature, self.known.particle)
            & within(impact.wall_temperature, self.known.wall)
    }

    /// Decides one impact that has been checked and that [`Self::decides`].
    pub fn resolve(&self, model: &Model, wall: &Wall, impact: &Impact, rng: ImpactRng) -> Outcome {
        if self.one_by_one {
            self.resolve_with::<true>(model, wall, impact, rng)
        } else {
            self.resolve_with::<false>(model, wall, impact, rng)
        }
    }

    #[inline(always)]
    fn resolve_with<const TERMS: bool>(
        &self,
        model: &Model,
        wall: &Wall,
        impact: &Impact,
        rng: ImpactRng,
    ) -> Outcome {
        let mut impact = *impact;
        wall.apply_deposit(&mut impact);
        let met = self.meet::<TERMS>(model, wall, &impact, rng);
        let coverage = impact.coverage;
        let drawn = coverage > 0.0 && (self.patchwork || impact.melt_thickness > 0.0);
        let covered = drawn && rng.uniform(stream::COVER) >= 1.0 - coverage;
        let outcome = self.at_place::<TERMS>(model, &impact, &met, drawn.then_some(covered));
        let share = if covered { 1.0 - coverage } else { coverage };
        if !drawn || share == 0.0 {
            return outcome;
        }
        let other = self.at_place::<TERMS>(model, &impact, &met, Some(!covered));
        Outcome {
            sticking_probability: both_shares(
                share,
                outcome.sticking_probability,
                other.sticking_probability,
            ),
            outside_range: outcome.outside_range | other.outside_range,
            ..outcome
        }
    }

    /// The state of particle and wall.
    #[inline(always)]
    fn meet<const TERMS: bool>(&self, model: &Model, wall: &Wall, impact: &Impact, rng: ImpactRng) -> Met {
        let temperature = impact.particle_temperature;
        let [char, ash, ..] = &*self.solids;
        let char = char.at(temperature);
        let ash = if self.constants.has_ash { ash.at(temperature) } else { char };
        let mut slag = self.slag.as_deref().map_or(DRY, |slag| slag.wall_state(impact));
        let mut surface_tension = self.constants.surface_tension;
        if impact.melt_thickness > 0.0 {
            (slag, surface_tension) = model.with_melt(wall, impact, slag);
        }
        let density = density_of(impact, &char, self.constants.has_ash.then_some(&ash));
        let criterion = self.in_flight.as_deref();
        Met {
            particle_solids: [char, ash],
            // In the known range there is no error.
            particle: if TERMS {
                model.particle_stickiness(impact, &mut |_, _, _| {}).unwrap_or(f64::NAN)
            } else {
                let product = criterion.map(|criterion| criterion.in_flight(impact).unwrap_or(f64::NAN));
                self.constants.transitions.after(product, temperature, impact.conversion)
            },
            flight_holds: criterion.is_none_or(|criterion| criterion.holds_in_flight(temperature)),
            on_melt: if TERMS {
                f64::NAN
            } else {
                self.constants.rebound_on_melt(impact, density, [slag.viscosity, surface_tension])
            },
            slag,
            melt: if TERMS && model.uses_melt { model.melt_met(wall, impact).unwrap_or(None) } else { None },
            chance: rng.uniform(stream::CAPTURE),
            density,
        }
    }

    /// Decides an impact at one place: where the wall has two, whether it is the covered one.
    #[inline(always)]
    fn at_place<const TERMS: bool>(
        &self,
        model: &Model,
        impact: &Impact,
        met: &Met,
        place: Option<bool>,
    ) -> Outcome {
        let covered = place == Some(true);
        let here = match place {
            Some(true) if TERMS => {
                Impact { coverage: 1.0, film_thickness: 0.0, melt_thickness: 0.0, ..*impact }
            }
            Some(false) if TERMS => Impact { coverage: 0.0, layer_thickness: 0.0, ..*impact },
            _ => *impact,
        };
        let [.., bare, powder] = &*self.solids;
        let partner = if covered && self.has_powder { powder } else { bare };
        let mut steps = VaryingImpact::<TERMS> {
            wall: &self.constants,
            terms: &model.terms,
            partner: partner.at(impact.wall_temperature),
            met,
            reaching: Some((model, impact)),
            covered,
            on_melt: f64::NAN,
            left_range: false,
        };
        let mut state = ImpactState { impact: here, ..ImpactState::default() };
        let Ok(()) = evaluate(&mut steps, StepSet::ALL, &mut state);
        let outcome = state.outcome();
        let holds = if TERMS {
            model.tangential.holds_for(&here) && model.terms.iter().all(|term| term.holds_for(&here))
        } else {
            self.valid.iter().all(|&(input, range)| within((INPUTS[input].value)(impact), range))
        };
        Outcome { outside_range: outcome.outside_range | !holds, ..outcome }
    }
}

impl Model {
    /// The bare wall with melt of earlier particles on it, and the surface tension [N/m] of the melt, NaN for one without; `slag` is the
    /// wall without them.
    #[cold]
    fn with_melt(&self, wall: &Wall, impact: &Impact, slag: WallState) -> (WallState, f64) {
        // The density, the only property that may be unknown, is known at the nearest temperature.
        let melt = self.melt_met(wall, impact).unwrap_or(None);
        let state = WallState {
            stickiness: self.wall_stickiness(wall, impact),
            viscosity: melt.map_or(f64::INFINITY, |melt| melt.viscosity),
            holds: slag.holds && self.melt_holds(impact),
        };
        (state, melt.and_then(|melt| melt.surface_tension).unwrap_or(f64::NAN))
    }
}

/// A wall without slag.
const DRY: WallState = WallState { stickiness: 0.0, viscosity: f64::INFINITY, holds: true };

/// Works of adhesion [J/m²] of char and ash with bare wall and powder, in this order, where no temperature changes them.
fn constant_works([char, ash, bare, powder]: [&Material; 4], given: Option<f64>) -> Option<[[f64; 2]; 2]> {
    let constant = |material: &Material, key| material.property(key).is_none_or(Property::is_constant);
    let known = |solid: &&Material| constant(solid, "surface_energy") && constant(solid, "work_of_adhesion");
    if ![char, ash, bare, powder].iter().all(known) {
        return None;
    }
    // The other properties, which may not be known at one temperature, have no say.
    let adhesive = |solid: &Material| {
        let at = |key| solid.property(key).map(|property| property.within_range(293.15));
        let surface_energy = at("surface_energy")?;
        Some(Mechanical { surface_energy, work_of_adhesion: at("work_of_adhesion"), ..Mechanical::default() })
    };
    let [char, ash, bare, powder] = [adhesive(char)?, adhesive(ash)?, adhesive(bare)?, adhesive(powder)?];
    Some([bare, powder].map(|wall| [char, ash].map(|solid| work_of_adhesion(&solid, &wall, given))))
}

/// Surface tension [N/m] of a slag that has one for all temperatures, NaN for one without; `None` where it depends on temperature.
fn constant_surface_tension(slag: &Material) -> Option<f64> {
    match slag.property("surface_tension") {
        Some(property) if !property.is_constant() => None,
        _ => Some(slag.surface_tension_near(293.15).unwrap_or(f64::NAN)),
    }
}

impl Constants {
    #[inline(always)]
    fn normal(&self) -> NormalLaw {
        self.constant.map_or(NormalLaw::ThorntonNing, |restitution| NormalLaw::Constant { restitution })
    }
}

impl Constants {
    /// Restitution [1] that melt of a viscosity [Pa s] and a surface tension [N/m] leaves a dry particle of a density [kg/m³]; see
    /// [`Met::on_melt`].
    #[inline(always)]
    pub fn rebound_on_melt(
        &self,
        impact: &Impact,
        density: f64,
        [viscosity, surface_tension]: [f64; 2],
    ) -> f64 {
        let Some(on_melt) = self.on_melt else { return f64::NAN };
        let e_n = on_melt.rebound(impact, density, viscosity, surface_tension);
        let liquid = (viscosity < f64::INFINITY) & !surface_tension.is_nan();
        if liquid { e_n } else { f64::NAN }
    }
}

impl Solid {
    fn new(material: &Material) -> Option<Self> {
        let (fields, work_of_adhesion) = material.mechanical_by_field()?;
        let fitted = work_of_adhesion.is_some();
        let mut solid = Self { constant: [0.0; 6], varying: [const { None }; 6], fitted };
        for (place, property) in fields.into_iter().chain(work_of_adhesion).enumerate() {
            if property.is_constant() {
                solid.constant[place] = property.within_range(293.15);
            } else {
                solid.varying[place] = Some(Box::new(property.clone()));
            }
        }
        Some(solid)
    }

    /// The properties at a temperature [K] at which all are known.
    #[inline(always)]
    fn at(&self, temperature: f64) -> Mechanical {
        let value = |place: usize| match &self.varying[place] {
            Some(property) => property.within_range(temperature),
            None => self.constant[place],
        };
        mechanical([value(0), value(1), value(2), value(3), value(4), value(5)], self.fitted)
    }
}

/// The properties in their order; the last has no meaning where none is `fitted`.
#[inline(always)]
pub(super) fn mechanical(values: [f64; 6], fitted: bool) -> Mechanical {
    let [density, youngs_modulus, poisson_ratio, yield_strength, surface_energy, work] = values;
    let work_of_adhesion = fitted.then_some(work);
    Mechanical { density, youngs_modulus, poisson_ratio, yield_strength, surface_energy, work_of_adhesion }
}

impl<const TERMS: bool> VaryingImpact<'_, TERMS> {
    #[inline(always)]
    fn terms(&self) -> &[Term] {
        if TERMS { self.terms } else { &[] }
    }

    #[inline(always)]
    fn normal(&self) -> NormalLaw {
        match self.reaching {
            Some((model, _)) if TERMS => model.normal,
            _ => self.wall.normal(),
        }
    }

    /// What the melt on the wall does to a dry particle by the terms.
    fn on_melt_by_terms(&self, impact: &Impact, contact: &Contact) -> f64 {
        let by = |term: &Term| term.effect().on_melt(impact, contact);
        match contact.melt.and_then(|_| self.terms().iter().find_map(by)) {
            Some(OnMelt::Rebounds(e_n)) => e_n,
            Some(OnMelt::Held) => 0.0,
            None => f64::NAN,
        }
    }
}

impl<const TERMS: bool> WallSteps for VaryingImpact<'_, TERMS> {
    type Contact = Contact;
    type Fault = std::convert::Infallible;

    #[inline(always)]
    fn outside_range(&mut self, impact: &Impact) -> bool {
        let [char, ash, wall] = self.wall.stated;
        let temperature = impact.particle_temperature;
        let burnt = self.wall.has_ash & (impact.conversion > 0.5);
        let particle = if burnt { within(temperature, ash) } else { within(temperature, char) };
        !(particle
            & within(impact.wall_temperature, wall)
            & self.met.flight_holds
            & (self.covered | self.met.slag.holds))
    }

    #[inline(always)]
    fn contact(&mut self, impact: &Impact) -> Result<Contact, Self::Fault> {
        let [char, ash] = &self.met.particle_solids;
        let partner = &self.partner;
        let Adhesion { yield_ratio, work, set } = self.wall.adhesion;
        let works = match self.wall.works {
            Some([[a, b], [c, d]]) => [if self.covered { c } else { a }, if self.covered { d } else { b }],
            None => [char, ash].map(|solid| work_of_adhesion(solid, partner, work)),
        };
        let ash = self.wall.has_ash.then_some(ash);
        let mut contact =
            contact_of(impact.conversion, self.met.density, (char, ash), partner, yield_ratio, works);
        contact.work_of_adhesion = set.unwrap_or(contact.work_of_adhesion);
        if TERMS {
            contact.melt = self.met.melt.filter(|_| !self.covered);
            let change = |contact, term: &Term| term.effect().contact(impact, contact, 0.0);
            contact = self.terms().iter().fold(contact, change);
        }
        self.on_melt = match TERMS {
            true => self.on_melt_by_terms(impact, &contact),
            false if self.covered => f64::NAN,
            false => self.met.on_melt,
        };
        Ok(contact)
    }

    #[inline(always)]
    fn stickiness(&mut self, _: &Impact) -> Result<Stickiness, Self::Fault> {
        let wall = if self.covered { 0.0 } else { self.met.slag.stickiness };
        Ok(Stickiness { particle: self.met.particle, wall })
    }

    #[inline(always)]
    fn normal_law(&mut self, impact: &Impact, contact: &Contact, _: f64) -> NormalRebound {
        let law = self.normal();
        let rebounds = self.on_melt > 0.0;
        self.left_range = !rebounds & !law.holds_for(contact, impact);
        let (restitution, held) = law.restitution_or_held(contact, impact);
        NormalRebound {
            restitution: if rebounds { self.on_melt } else { restitution },
            held: held & !rebounds,
        }
    }

    #[inline(always)]
    fn normal_effects(
        &mut self,
        impact: &Impact,
        contact: &Contact,
        rebound: NormalRebound,
    ) -> NormalRebound {
        if !TERMS || rebound.held {
            return rebound;
        }
        let change = |e_n, term: &Term| term.effect().normal_restitution(impact, contact, e_n, 0.0);
        NormalRebound::of(self.terms().iter().try_fold(rebound.restitution, change))
    }

    #[inline(always)]
    fn draw(&mut self) -> f64 {
        self.met.chance
    }

    #[inline(always)]
    fn rebound_loss(&self) -> f64 {
        self.wall.rebound_loss
    }

    #[inline(always)]
    fn stiffness_ratio(&self, contact: &Contact) -> f64 {
        contact.stiffness_ratio
    }

    #[inline(always)]
    fn tangential_law(&mut self, kinematics: &ImpactKinematics) -> Rebound {
        match self.reaching {
            Some((model, _)) if TERMS => model.tangential.rebound(kinematics),
            _ => self.wall.tangential.rebound(kinematics),
        }
    }

    #[inline(always)]
    fn tangential_effects(&mut self, kinematics: &ImpactKinematics, rebound: Rebound) -> Rebound {
        self.terms().iter().fold(rebound, |rebound, term| term.effect().tangential(kinematics, rebound))
    }

    #[inline(always)]
    fn capture_probability(&mut self, _: &Impact, stickiness: Stickiness) -> f64 {
        let place = OnBareWall {
            rebounds_from_melt: self.on_melt > 0.0,
            dry: self.on_melt.is_nan(),
            contact_law: self.normal().is_contact_law(),
        };
        let probability;
        (probability, self.left_range) =
            place.capture_probability(self.wall.combination, stickiness, self.left_range);
        probability
    }

    #[inline(always)]
    fn correct(&mut self, plain: Corrected) -> Corrected {
        match self.reaching {
            Some((model, reaching)) if TERMS => model.corrected(reaching, plain, &mut |_, _, _| {}),
            _ => plain,
        }
    }

    #[inline(always)]
    fn left_range(&self) -> bool {
        self.left_range
    }
}
