//! The steps of an impact on a prepared wall: what model and wall decide is computed when the model is read.
//!
//! A wall is prepared when every effect of the model has a precomputed form ([`Precomputed`]),
//! particles are no droplets, and the model file declares no inputs and no range of a group. The
//! contact of particle and wall is the same for all impacts ([`PreparedImpact`] with `CONSTANT`), or it varies
//! ([`VaryingContact`]): properties over temperature, char that becomes ash, slag, powder. Both
//! follow the same steps, alone and in blocks (`prepared_block.rs`). The steps have no branches, so
//! the compiler turns a loop over a block into vector instructions; only a law by name is called
//! for each impact.
//!
//! An impact of a patchwork meets its covered or its bare share (`general_wall.rs`): the share that
//! it meets is evaluated whole, of the other one only what the probability of capture and the range
//! need.

use std::convert::Infallible;
use std::sync::Arc;

use super::evaluation::{ImpactState, NormalRebound, OnBareWall, StepSet, WallSteps, both_shares, evaluate};
use super::particle::{contact_of, density_of};
use super::wall::{ContactSettings, Covering, Wall};
use super::{Model, TemperatureRanges};
use crate::capture::{Combination, Stickiness, StickinessCriterion, WallState};
use crate::deposit::layers;
use crate::effect::{DryOnMelt, Precomputed, Term, Transition, stream};
use crate::impact::{INPUTS, Impact, Outcome};
use crate::law::ParameterValues;
use crate::material::{Material, Mechanical, Property};
use crate::normal::{Contact, NormalLaw, ThorntonNingConstants, work_of_adhesion};
use crate::rng::ImpactRng;
use crate::tangential::{ImpactKinematics, ListedTangentialLaw, Rebound, TangentialLaw};

/// What is known of a wall and its particles before an impact.
#[derive(Debug, Clone)]
pub(super) struct PreparedWall {
    pub constants: WallConstants,
    /// What a contact that differs between impacts depends on; `None` where it is [`WallConstants::contact`].
    pub varying: Option<Arc<VaryingContact>>,
    /// Temperatures at which every property is known.
    pub known: TemperatureRanges,
    /// Temperature [K] below which slag on the wall is solid; 0 where it is liquid or not known.
    pub slag_melts_at: f64,
    /// Which of [`INPUTS`] has to lie in which range for the terms.
    pub valid: Vec<(usize, [f64; 2])>,
}

/// What the steps need of the wall.
#[derive(Debug, Clone, Copy)]
pub(super) struct WallConstants {
    pub normal: NormalLaw,
    pub tangential: TangentialLaw,
    /// The contact where it is the same for all impacts, with the density of the particle's material.
    pub contact: Contact,
    /// Constants of Thornton–Ning for that contact.
    pub thornton_ning: ThorntonNingConstants,
    pub transitions: [Option<Transition>; 2],
    /// Whether a probability other than 0 and 1 may occur, and with it a draw.
    pub draws: bool,
    /// Share of `e_n` that full stickiness takes [1].
    pub rebound_loss: f64,
    pub combination: Combination,
    /// What the model file puts on the wall.
    pub covering: Covering,
    /// Temperatures [K] for which the properties of char, ash and wall are stated.
    pub stated: [[f64; 2]; 3],
    pub has_ash: bool,
    /// Whether char and ash have a fitted work of adhesion.
    pub fitted: [bool; 2],
    /// Whether covered and bare share differ.
    pub patchwork: bool,
    /// Work of adhesion [J/m²] of char and ash with the bare wall and with powder, where it is the
    /// same for all impacts.
    pub works: Option<[[f64; 2]; 2]>,
    pub adhesion: ContactSettings,
    /// Surface tension [N/m] of the slag; NaN without slag or where it has none.
    pub surface_tension: f64,
    pub on_melt: Option<DryOnMelt>,
}

/// What a contact that differs between impacts depends on.
#[derive(Debug)]
pub(super) struct VaryingContact {
    /// Char, ash, the bare wall and the powder on it; ash and powder are as char and wall where there are none.
    pub solids: [SolidProperties; 4],
    pub in_flight: Option<Arc<dyn StickinessCriterion>>,
    pub slag: Option<Arc<dyn StickinessCriterion>>,
}

/// The mechanical properties of a solid.
#[derive(Debug)]
pub(super) struct SolidProperties {
    /// Values of the properties in the order of [`Mechanical`]; those that vary have none here.
    pub constant: [f64; 6],
    /// Those that depend on temperature.
    pub varying: [Option<Property>; 6],
    /// Whether it has a fitted work of adhesion.
    pub fitted: bool,
}

/// The state of particle and wall in an impact, at its covered and its bare share.
pub(super) struct Surfaces {
    /// Char and ash.
    pub particle: [Mechanical; 2],
    /// Density of the particle [kg/m³].
    pub density: f64,
    /// Stickiness of the particle [1].
    pub stickiness: f64,
    /// Whether the criterion of the particle's stickiness is stated for it.
    pub flight_holds: bool,
    pub slag: WallState,
    /// Restitution [1] that the melt leaves a dry particle: 0 where it holds it, NaN without a liquid or a term for it.
    pub on_melt: f64,
}

/// One impact at one place; `CONSTANT` where the contact is the same for all impacts.
pub(super) struct PreparedImpact<'a, const CONSTANT: bool> {
    pub wall: &'a WallConstants,
    pub surfaces: &'a Surfaces,
    pub covered: bool,
    /// What it meets there; without meaning where the contact is constant.
    pub partner: Mechanical,
    /// As [`Surfaces::on_melt`], at this place.
    pub on_melt: f64,
    /// Whether the normal law was used outside its range.
    pub left_range: bool,
    pub rng: ImpactRng,
}

impl PreparedWall {
    /// Prepares a wall; `None` where its impacts need the general steps.
    pub fn new(model: &Model, wall: &Wall) -> Option<Self> {
        if model.has_droplets() || model.has_group_ranges || !model.extra_inputs.is_empty() {
            return None;
        }
        // What lies on the wall changes these inputs before a range is checked.
        let changed = [Impact::COVERAGE, Impact::LAYER_THICKNESS, Impact::FILM_THICKNESS];
        let valid: Vec<_> = model.terms.iter().flat_map(Term::valid).copied().collect();
        if valid.iter().any(|(input, _)| changed.contains(input)) {
            return None;
        }
        let mut constants = WallConstants::new(model, wall)?;
        let dry = wall.melt.is_none() && model.stickiness.is_none();
        let plain = constants.combination == Combination::default();
        let varying = if wall.prepared.is_some() && wall.powder.is_none() && dry && plain {
            constants.draws = constants.transitions[0].is_some();
            None
        } else {
            Some(Arc::new(VaryingContact::new(model, wall)?))
        };
        let slag_melts_at = model.slag_melts_at(wall).unwrap_or(0.0);
        Some(Self { constants, varying, known: model.ranges_of(wall), slag_melts_at, valid })
    }

    /// Whether every property is known for an impact.
    #[inline(always)]
    pub fn decides(&self, impact: &Impact) -> bool {
        // Frozen slag, and a wall of its own temperature under a deposit, need the general steps.
        within(impact.particle_temperature, self.known.particle)
            & within(impact.wall_temperature, self.known.wall)
            & (impact.temperature_under == 0.0)
            & ((impact.melt_thickness == 0.0) | (impact.wall_temperature >= self.slag_melts_at))
    }

    /// Decides one impact that has been checked, without melt on the wall, where the contact is constant.
    #[inline(always)]
    pub fn resolve_constant(&self, impact: &Impact, rng: ImpactRng) -> Outcome {
        // First: no number has to be kept over the call.
        let holds = self.valid.is_empty() || self.terms_hold_for(impact);
        let surfaces = self.constants.dry_surfaces(impact, self.constants.stickiness(None, impact));
        self.constants.decide::<true>(&surfaces, false, Mechanical::default(), holds, impact, rng)
    }

    /// Decides one impact that has been checked and that [`Self::decides`], where the contact is `varying`.
    pub fn resolve_varying(
        &self,
        varying: &VaryingContact,
        model: &Model,
        wall: &Wall,
        impact: &Impact,
        rng: ImpactRng,
    ) -> Outcome {
        let constants = &self.constants;
        let mut impact = *impact;
        constants.covering.apply(&mut impact);
        let surfaces = varying.surfaces(constants, model, wall, &impact);
        let coverage = impact.coverage;
        let drawn = coverage > 0.0 && (constants.patchwork || impact.melt_thickness > 0.0);
        let covered = drawn && rng.uniform(stream::COVER) >= 1.0 - coverage;
        let holds = self.terms_hold_for(&impact);
        let partner = |covered: bool| varying.solids[if covered { 3 } else { 2 }].at(impact.wall_temperature);
        // Twice by name, not by a closure: of the other place only what is used is computed.
        let outcome = constants.decide::<false>(&surfaces, covered, partner(covered), holds, &impact, rng);
        let share = if covered { 1.0 - coverage } else { coverage };
        if !drawn || share == 0.0 {
            return outcome;
        }
        let other = constants.decide::<false>(&surfaces, !covered, partner(!covered), holds, &impact, rng);
        let [met, elsewhere] = [outcome, other].map(|outcome| outcome.sticking_probability);
        Outcome {
            sticking_probability: both_shares(share, met, elsewhere),
            outside_range: outcome.outside_range | other.outside_range,
            ..outcome
        }
    }

    /// Whether the terms are stated for such an impact. Not inlined: the usual impact keeps its numbers in registers.
    #[inline(never)]
    fn terms_hold_for(&self, impact: &Impact) -> bool {
        self.valid.iter().all(|&(input, range)| within((INPUTS[input].value)(impact), range))
    }
}

impl WallConstants {
    fn new(model: &Model, wall: &Wall) -> Option<Self> {
        let solids = solids_of(model, wall);
        let [of_char, of_ash, of_wall, _] = solids.map(Material::stated_range);
        let fitted = |solid: &Material| solid.property("work_of_adhesion").is_some();
        let mut constants = Self {
            normal: model.normal,
            tangential: model.tangential,
            contact: wall.prepared.unwrap_or_default(),
            thornton_ning: ThorntonNingConstants::default(),
            transitions: [None; 2],
            draws: true,
            rebound_loss: model.rebound_loss(),
            combination: model.capture.combination,
            covering: wall.covering,
            stated: [of_char?, of_ash?, of_wall?],
            has_ash: model.ash().is_some(),
            fitted: [fitted(solids[0]), fitted(solids[1])],
            patchwork: wall.melt.is_some() || wall.powder.is_some(),
            works: constant_works(solids, wall.adhesion.work),
            adhesion: wall.adhesion,
            surface_tension: wall.slag.as_ref().map_or(Some(f64::NAN), constant_surface_tension)?,
            on_melt: None,
        };
        for term in &model.terms {
            constants.precompute(term.effect().precompute()?)?;
        }
        let ContactSettings { yield_ratio, set, .. } = constants.adhesion;
        let work_of_adhesion = set.unwrap_or(constants.contact.work_of_adhesion);
        constants.contact = Contact { yield_ratio, work_of_adhesion, ..constants.contact };
        constants.thornton_ning = ThorntonNingConstants::new(&constants.contact);
        Some(constants)
    }

    /// Takes the precomputed form of a term; `None` for a third transition.
    fn precompute(&mut self, form: Precomputed) -> Option<()> {
        match form {
            Precomputed::YieldRatio(ratio) => self.adhesion.yield_ratio = ratio,
            Precomputed::WorkOfAdhesion(work) => self.adhesion.set = Some(work),
            Precomputed::Transition(one) => {
                *self.transitions.iter_mut().find(|slot| slot.is_none())? = Some(one)
            }
            Precomputed::OnMelt(on_melt) => self.on_melt = self.on_melt.or(Some(on_melt)),
        }
        Some(())
    }

    /// Stickiness [1] of the particle of an impact, from that which a criterion gives where there is one.
    #[inline(always)]
    fn stickiness(&self, criterion: Option<f64>, impact: &Impact) -> f64 {
        let (temperature, conversion) = (impact.particle_temperature, impact.conversion);
        let [first, second] = self.transitions;
        let Some(first) = first else { return criterion.unwrap_or(0.0) };
        let stickiness = first.at(temperature, conversion);
        let product = criterion.map_or(stickiness, |product| product * stickiness);
        second.map_or(product, |second| product * second.at(temperature, conversion))
    }

    /// A particle of a stickiness [1] and a wall without slag, where the contact is constant.
    #[inline(always)]
    pub fn dry_surfaces(&self, impact: &Impact, stickiness: f64) -> Surfaces {
        let given = impact.particle_density;
        Surfaces {
            particle: [Mechanical::default(); 2],
            density: if given > 0.0 { given } else { self.contact.density },
            stickiness,
            flight_holds: true,
            slag: DRY,
            on_melt: f64::NAN,
        }
    }

    /// Decides an impact at one place. `holds` says whether the terms are stated for it.
    #[inline(always)]
    fn decide<const CONSTANT: bool>(
        &self,
        surfaces: &Surfaces,
        covered: bool,
        partner: Mechanical,
        holds: bool,
        impact: &Impact,
        rng: ImpactRng,
    ) -> Outcome {
        let (on_melt, left_range) = (f64::NAN, false);
        let mut steps =
            PreparedImpact::<CONSTANT> { wall: self, surfaces, covered, partner, on_melt, left_range, rng };
        let mut state = ImpactState { impact: *impact, ..ImpactState::default() };
        let Ok(()) = evaluate(&mut steps, StepSet::ALL, &mut state);
        let outcome = state.outcome();
        Outcome { outside_range: outcome.outside_range | !holds, ..outcome }
    }

    /// Restitution [1] that melt of a viscosity [Pa s] and a surface tension [N/m] leaves a dry
    /// particle of a density [kg/m³]; see [`Surfaces::on_melt`].
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

    /// The covered share of the wall [1] that an impact meets.
    #[inline(always)]
    pub fn coverage(&self, impact: &Impact) -> f64 {
        let mut impact = *impact;
        self.covering.apply(&mut impact);
        impact.coverage
    }

    /// The impact as a law by name receives it, at its place on the wall.
    fn at_place(&self, mut impact: Impact, covered: bool) -> Impact {
        self.covering.apply(&mut impact);
        let patchwork = self.patchwork || impact.melt_thickness > 0.0;
        if covered {
            layers::covered(&impact)
        } else if patchwork && impact.coverage > 0.0 {
            layers::bare(&impact)
        } else {
            impact
        }
    }

    /// Calls the normal law: its rebound, and whether it is stated for the impact. Not inlined and
    /// with copies, so that the numbers of an impact by another law stay in registers.
    #[cold]
    #[inline(never)]
    fn call_normal(&self, contact: Contact, impact: Impact, covered: bool) -> (NormalRebound, bool) {
        let impact = self.at_place(impact, covered);
        (NormalRebound::of(self.normal.rebound(&contact, &impact)), self.normal.holds_for(&contact, &impact))
    }

    /// Whether the tangential law is stated for an impact; not inlined, as [`Self::call_normal`].
    #[cold]
    #[inline(never)]
    fn tangential_holds(&self, impact: Impact, covered: bool) -> bool {
        self.tangential.holds_for(&self.at_place(impact, covered))
    }
}

/// Calls a tangential law by name; not inlined, as [`WallConstants::call_normal`].
#[cold]
#[inline(never)]
fn call_tangential(
    law: &ListedTangentialLaw,
    values: ParameterValues,
    kinematics: ImpactKinematics,
) -> Rebound {
    (law.rebound)(&kinematics, &values)
}

impl VaryingContact {
    fn new(model: &Model, wall: &Wall) -> Option<Self> {
        let [char, ash, bare, powder] = solids_of(model, wall).map(SolidProperties::new);
        let solids = [char?, ash?, bare?, powder?];
        Some(Self { solids, in_flight: model.stickiness.clone(), slag: wall.melt.clone() })
    }

    /// The state of particle and wall.
    #[inline(always)]
    fn surfaces(&self, constants: &WallConstants, model: &Model, wall: &Wall, impact: &Impact) -> Surfaces {
        let temperature = impact.particle_temperature;
        let [char, ash, ..] = &self.solids;
        let char = char.at(temperature);
        let ash = if constants.has_ash { ash.at(temperature) } else { char };
        let mut slag = self.slag.as_deref().map_or(DRY, |slag| slag.wall_state(impact));
        let mut surface_tension = constants.surface_tension;
        if impact.melt_thickness > 0.0 {
            (slag, surface_tension) = model.with_melt(wall, impact, slag);
        }
        let density = density_of(impact, &char, constants.has_ash.then_some(&ash));
        let criterion = self.in_flight.as_deref();
        // In the known range there is no error.
        let product = criterion.map(|criterion| criterion.in_flight(impact).unwrap_or(f64::NAN));
        Surfaces {
            particle: [char, ash],
            density,
            stickiness: constants.stickiness(product, impact),
            flight_holds: criterion.is_none_or(|criterion| criterion.holds_for_particle(impact)),
            on_melt: constants.rebound_on_melt(impact, density, [slag.viscosity, surface_tension]),
            slag,
        }
    }
}

impl Model {
    /// The bare wall with melt of earlier particles on it, and the surface tension [N/m] of the
    /// melt, NaN for one without; `slag` is the wall without them.
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

/// Char, ash, bare wall and powder, in the order of [`VaryingContact::solids`].
fn solids_of<'a>(model: &'a Model, wall: &'a Wall) -> [&'a Material; 4] {
    let (particle, bare) = (&model.particle, wall.material());
    [particle.material(), particle.melting(), bare, wall.powder.as_ref().unwrap_or(bare)]
}

/// Works of adhesion [J/m²] of char and ash with bare wall and powder, in this order, where no
/// temperature changes them.
fn constant_works(solids: [&Material; 4], given: Option<f64>) -> Option<[[f64; 2]; 2]> {
    let constant = |material: &Material, key| material.property(key).is_none_or(Property::is_constant);
    let known = |solid: &&Material| constant(solid, "surface_energy") && constant(solid, "work_of_adhesion");
    if !solids.iter().all(known) {
        return None;
    }
    // No work of adhesion depends on the other properties, which may not be known at one temperature.
    let adhesive = |solid: &Material| {
        let at = |key| solid.property(key).map(|property| property.within_range(293.15));
        let surface_energy = at("surface_energy")?;
        Some(Mechanical { surface_energy, work_of_adhesion: at("work_of_adhesion"), ..Mechanical::default() })
    };
    let [char, ash, bare, powder] = solids.map(adhesive);
    let (particle, walls) = ([char?, ash?], [bare?, powder?]);
    Some(walls.map(|wall| particle.map(|solid| work_of_adhesion(&solid, &wall, given))))
}

/// Surface tension [N/m] of a slag that has one for all temperatures, NaN for one without; `None`
/// where it depends on temperature.
fn constant_surface_tension(slag: &Material) -> Option<f64> {
    match slag.property("surface_tension") {
        Some(property) if !property.is_constant() => None,
        _ => Some(slag.surface_tension_near(293.15).unwrap_or(f64::NAN)),
    }
}

impl SolidProperties {
    fn new(material: &Material) -> Option<Self> {
        let (fields, work_of_adhesion) = material.mechanical_by_field()?;
        let fitted = work_of_adhesion.is_some();
        let mut solid = Self { constant: [0.0; 6], varying: [const { None }; 6], fitted };
        for (place, property) in fields.into_iter().chain(work_of_adhesion).enumerate() {
            if property.is_constant() {
                solid.constant[place] = property.within_range(293.15);
            } else {
                solid.varying[place] = Some(property.clone());
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

impl<const CONSTANT: bool> PreparedImpact<'_, CONSTANT> {
    #[inline(always)]
    fn thornton_ning(&self, contact: &Contact) -> ThorntonNingConstants {
        if CONSTANT { self.wall.thornton_ning } else { ThorntonNingConstants::new(contact) }
    }
}

impl<const CONSTANT: bool> WallSteps for PreparedImpact<'_, CONSTANT> {
    type Fault = Infallible;

    #[inline(always)]
    fn outside_range(&mut self, impact: &Impact) -> bool {
        let [char, ash, wall] = self.wall.stated;
        let temperature = impact.particle_temperature;
        let burnt = !CONSTANT & self.wall.has_ash & (impact.conversion > 0.5);
        let particle = if burnt { within(temperature, ash) } else { within(temperature, char) };
        let law = match self.wall.tangential {
            TangentialLaw::Listed { .. } => self.wall.tangential_holds(*impact, self.covered),
            _ => true,
        };
        !(particle
            & within(impact.wall_temperature, wall)
            & self.surfaces.flight_holds
            & (self.covered | self.surfaces.slag.holds)
            & law)
    }

    #[inline(always)]
    fn contact(&mut self, impact: &Impact) -> Result<Contact, Infallible> {
        let density = self.surfaces.density;
        if CONSTANT {
            return Ok(Contact { density, ..self.wall.contact });
        }
        let [char, ash] = &self.surfaces.particle;
        let partner = &self.partner;
        let ContactSettings { yield_ratio, work, set } = self.wall.adhesion;
        let works = match self.wall.works {
            Some([[a, b], [c, d]]) => [if self.covered { c } else { a }, if self.covered { d } else { b }],
            None => [char, ash].map(|solid| work_of_adhesion(solid, partner, work)),
        };
        let ash = self.wall.has_ash.then_some(ash);
        let mut contact = contact_of(impact.conversion, density, (char, ash), partner, yield_ratio, works);
        contact.work_of_adhesion = set.unwrap_or(contact.work_of_adhesion);
        self.on_melt = if self.covered { f64::NAN } else { self.surfaces.on_melt };
        Ok(contact)
    }

    #[inline(always)]
    fn stickiness(&mut self, _: &Impact) -> Result<Stickiness, Infallible> {
        let wall = if self.covered { 0.0 } else { self.surfaces.slag.stickiness };
        Ok(Stickiness { particle: self.surfaces.stickiness, wall })
    }

    #[inline(always)]
    fn adhesion(&self, impact: &Impact, contact: &Contact) -> f64 {
        match self.wall.normal {
            NormalLaw::ThorntonNing => self.thornton_ning(contact).adhesive_pressure(impact.diameter),
            _ => 0.0,
        }
    }

    #[inline(always)]
    fn normal_law(&mut self, impact: &Impact, contact: &Contact, adhesion: f64) -> NormalRebound {
        let (rebound, holds) = match self.wall.normal {
            NormalLaw::ThorntonNing => {
                let speed = impact.normal_speed;
                let energy = self.thornton_ning(contact).energy(contact.density, speed, adhesion);
                // Who asks only whether it is held needs no root.
                let rebound = NormalRebound { restitution: energy.sqrt(), held: energy <= 0.0 };
                (rebound, NormalLaw::ThorntonNing.holds_for(contact, impact))
            }
            NormalLaw::Constant { restitution } => (NormalRebound { restitution, held: false }, true),
            NormalLaw::PlasticJkr | NormalLaw::Listed { .. } => {
                self.wall.call_normal(*contact, *impact, self.covered)
            }
        };
        let rebounds = self.on_melt > 0.0;
        self.left_range = !rebounds & !holds;
        NormalRebound {
            restitution: if rebounds { self.on_melt } else { rebound.restitution },
            held: rebound.held & !rebounds,
        }
    }

    #[inline(always)]
    fn draw(&mut self) -> f64 {
        if self.wall.draws { self.rng.uniform(stream::CAPTURE) } else { 0.5 }
    }

    #[inline(always)]
    fn rebound_loss(&self) -> f64 {
        self.wall.rebound_loss
    }

    #[inline(always)]
    fn tangential_law(&mut self, kinematics: &ImpactKinematics) -> Rebound {
        match self.wall.tangential {
            TangentialLaw::Listed { law, values } => call_tangential(law, values, *kinematics),
            law => law.rebound(kinematics),
        }
    }

    #[inline(always)]
    fn capture_probability(&mut self, _: &Impact, stickiness: Stickiness) -> f64 {
        if CONSTANT {
            return stickiness.particle;
        }
        let place = OnBareWall {
            rebounds_from_melt: self.on_melt > 0.0,
            dry: self.on_melt.is_nan(),
            contact_law: self.wall.normal.is_contact_law(),
        };
        let probability;
        (probability, self.left_range) =
            place.capture_probability(self.wall.combination, stickiness, self.left_range);
        probability
    }

    #[inline(always)]
    fn left_range(&self) -> bool {
        self.left_range
    }
}

#[inline(always)]
pub(super) fn within(value: f64, [low, high]: [f64; 2]) -> bool {
    (value >= low) & (value <= high)
}
