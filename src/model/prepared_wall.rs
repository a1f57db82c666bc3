//! The steps of an impact on a prepared wall: what depends on materials and model alone is computed when the model is read.
//!
//! A wall is prepared when constant properties, the two laws and effects with a precomputed form ([`Precomputed`]) decide its impacts.
//! The steps have no branches, so the compiler turns a loop over a block into vector instructions. Where one of the laws has no prepared
//! form, both are called for each impact ([`CalledWall`]), and a block runs one by one.

use std::convert::Infallible;

use fearless_simd::{Level, dispatch};

use super::Model;
use super::block::{BLOCK, Block, Outcomes};
use super::evaluation::{ImpactState, NormalRebound, StepSet, WallSteps, evaluate};
use super::wall::Wall;
use crate::capture::{Combination, Stickiness};
use crate::effect::{Precomputed, Term, Transition, stream};
use crate::impact::{INPUTS, Impact, Outcome};
use crate::normal::{self, Contact, NormalLaw};
use crate::rng::ImpactRng;
use crate::tangential::{ImpactKinematics, Rebound, TangentialLaw};

/// The prepared numbers of one wall.
#[derive(Debug, Clone)]
pub(super) struct PreparedWall {
    constants: Constants,
    /// Which of [`INPUTS`] has to lie in which range for the outcome to be inside its range.
    valid: Vec<(usize, [f64; 2])>,
}

/// A prepared wall of which a law has no prepared form.
#[derive(Debug, Clone)]
pub(super) struct CalledWall {
    /// The wall, whose own laws have no meaning.
    pub prepared: PreparedWall,
    pub laws: Laws,
}

/// Laws that are called for each impact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Laws {
    normal: NormalLaw,
    contact: Contact,
    tangential: TangentialLaw,
}

/// What the steps need of a wall.
#[derive(Debug, Clone, Copy)]
struct Constants {
    normal: Normal,
    tangential: Tangential,
    /// Mindlin's `k` [1].
    stiffness_ratio: f64,
    transitions: Transitions,
    /// Whether a probability other than 0 and 1 may occur, and with it a draw.
    draws: bool,
    /// Share of `e_n` that full stickiness takes [1].
    rebound_loss: f64,
    /// Temperatures [K] for which the properties of particle and wall are stated.
    materials: [[f64; 2]; 2],
    /// Density of the particle's material [kg/m³].
    density: f64,
    /// Largest `rho v_n²` [Pa] for which the normal law is stated.
    largest_pressure: f64,
}

#[derive(Debug, Clone, Copy)]
enum Normal {
    ThorntonNing(normal::Prepared),
    Constant(f64),
}

/// The tangential laws that can be prepared.
#[derive(Debug, Clone, Copy)]
pub(super) enum Tangential {
    Constant(f64),
    Sliding(f64),
    SlidingRolling(f64),
}

/// What makes the particle sticky; the stickiness of two transitions is multiplied.
#[derive(Debug, Clone, Copy)]
pub(super) enum Transitions {
    None,
    One(Transition),
    Two(Transition, Transition),
}

/// One impact on a prepared wall.
struct PreparedImpact<'a> {
    wall: &'a Constants,
    /// `None` where the laws of `wall` decide: the compiler then leaves the calls out.
    laws: Option<&'a Laws>,
    rng: ImpactRng,
}

impl PreparedWall {
    /// Prepares a wall, with its laws where they have to be called ([`CalledWall`]); `None` where its impacts need the general steps.
    pub fn new(model: &Model, wall: &Wall) -> Option<(Self, Option<Laws>)> {
        let plain = model.capture.combination == Combination::default();
        if model.stickiness.is_some()
            || wall.melt.is_some()
            || wall.powder.is_some()
            || !plain
            || !model.extra_inputs.is_empty()
        {
            return None;
        }
        let mut contact = wall.prepared?;
        let mut transitions = Transitions::None;
        for term in &model.terms {
            match term.effect().precompute()? {
                Precomputed::YieldRatio(yield_ratio) => contact = Contact { yield_ratio, ..contact },
                Precomputed::WorkOfAdhesion(work_of_adhesion) => {
                    contact = Contact { work_of_adhesion, ..contact };
                }
                // There is no melt on a prepared wall.
                Precomputed::OnMelt(_) => {}
                Precomputed::Transition(transition) => transitions = transitions.and(transition)?,
            }
        }
        let normal = match model.normal {
            NormalLaw::ThorntonNing => Some(Normal::ThorntonNing(normal::Prepared::new(&contact))),
            NormalLaw::Constant { restitution } => Some(Normal::Constant(restitution)),
            NormalLaw::PlasticJkr | NormalLaw::Listed { .. } => None,
        };
        let tangential = Tangential::new(model.tangential);
        let laws = Laws { normal: model.normal, contact, tangential: model.tangential };
        let called = normal.is_none() || tangential.is_none();
        // The powder of the model file changes these two inputs before a range is checked.
        let changed = |name| name == "layer_thickness" || name == "coverage";
        let valid: Vec<_> = model.terms.iter().flat_map(Term::valid).copied().collect();
        if valid.iter().any(|(input, _)| changed(INPUTS[*input].name)) {
            return None;
        }
        let constants = Constants {
            // Without meaning where the laws are called.
            normal: normal.unwrap_or(Normal::Constant(f64::NAN)),
            tangential: tangential.unwrap_or(Tangential::Constant(f64::NAN)),
            stiffness_ratio: contact.stiffness_ratio,
            transitions,
            draws: !matches!(transitions, Transitions::None),
            rebound_loss: model.rebound_loss(),
            materials: [model.particle().valid_range(), wall.material().valid_range()],
            density: contact.density,
            largest_pressure: if model.normal.is_contact_law() {
                contact.largest_impact_pressure()
            } else {
                f64::INFINITY
            },
        };
        Some((Self { constants, valid }, called.then_some(laws)))
    }

    /// Whether [`Self::resolve_block`] decides a block.
    pub fn decides_block(&self, block: &Block) -> bool {
        // A prepared wall does not support a melt layer.
        let melt = &block.inputs[Impact::MELT_THICKNESS][..block.length.min(BLOCK)];
        melt.iter().all(|thickness| *thickness == 0.0)
    }

    /// Decides one impact that has been checked.
    #[inline(always)]
    pub fn resolve(&self, impact: &Impact, rng: ImpactRng) -> Outcome {
        // First: no number has to be kept over the call.
        let holds = self.valid.is_empty() || self.terms_hold_for(impact);
        self.steps(None, holds, impact, rng)
    }

    #[inline(always)]
    fn steps(&self, laws: Option<&Laws>, holds: bool, impact: &Impact, rng: ImpactRng) -> Outcome {
        let mut state = ImpactState { impact: *impact, ..ImpactState::default() };
        let mut steps = PreparedImpact { wall: &self.constants, laws, rng };
        let Ok(()) = evaluate(&mut steps, StepSet::ALL, &mut state);
        let outcome = state.outcome();
        Outcome { outside_range: outcome.outside_range | !holds, ..outcome }
    }

    /// Decides a block of impacts that have been checked and that [`Self::decides_block`], with the instructions of `level`.
    pub fn resolve_block(&self, block: &Block, seed: u64, outcomes: &mut Outcomes, level: Level) {
        dispatch!(level, _simd => self.resolve_loops(block, seed, outcomes));
    }

    /// The steps in four loops, the fastest grouping measured: steps that divide stand beside steps that do not.
    #[inline(always)]
    fn resolve_loops(&self, block: &Block, seed: u64, outcomes: &mut Outcomes) {
        let wall = &self.constants;
        // Each law is matched outside its loop and is then a constant within it. Matching through the reference matters: of a
        // local copy the compiler makes one enum again, whose variant every impact would have to ask for.
        match wall.transitions {
            Transitions::None => {
                let wall = Constants { transitions: Transitions::None, ..*wall };
                run(StepSet::STICKINESS, &wall, block, seed, outcomes);
            }
            Transitions::One(one) => {
                let wall = Constants { transitions: Transitions::One(one), ..*wall };
                run(StepSet::STICKINESS, &wall, block, seed, outcomes);
            }
            Transitions::Two(one, two) => {
                let wall = Constants { transitions: Transitions::Two(one, two), ..*wall };
                run(StepSet::STICKINESS, &wall, block, seed, outcomes);
            }
        }
        match wall.normal {
            Normal::Constant(restitution) => {
                let wall = Constants { normal: Normal::Constant(restitution), ..*wall };
                normal_and_draw(&wall, block, seed, outcomes);
            }
            Normal::ThorntonNing(law) => {
                let wall = Constants { normal: Normal::ThorntonNing(law), ..*wall };
                run(StepSet::ADHESION, &wall, block, seed, outcomes);
                normal_and_draw(&wall, block, seed, outcomes);
            }
        }
        match wall.tangential {
            Tangential::Constant(restitution) => {
                let wall = Constants { tangential: Tangential::Constant(restitution), ..*wall };
                run(StepSet::REBOUND.union(StepSet::RANGE), &wall, block, seed, outcomes);
            }
            Tangential::Sliding(friction) => {
                let wall = Constants { tangential: Tangential::Sliding(friction), ..*wall };
                run(StepSet::REBOUND.union(StepSet::RANGE), &wall, block, seed, outcomes);
            }
            Tangential::SlidingRolling(friction) => {
                let wall = Constants { tangential: Tangential::SlidingRolling(friction), ..*wall };
                run(StepSet::REBOUND.union(StepSet::RANGE), &wall, block, seed, outcomes);
            }
        }
        for &(input, range) in &self.valid {
            for i in 0..block.length.min(BLOCK) {
                outcomes.outside_range[i] |= u32::from(!within(block.inputs[input][i], range));
            }
        }
    }

    /// Whether the terms are stated for such an impact. Not inlined: the usual impact keeps its numbers in registers.
    #[inline(never)]
    fn terms_hold_for(&self, impact: &Impact) -> bool {
        self.valid.iter().all(|&(input, range)| within((INPUTS[input].value)(impact), range))
    }
}

impl CalledWall {
    /// Decides one impact that has been checked.
    pub fn resolve(&self, impact: &Impact, rng: ImpactRng) -> Outcome {
        let Self { prepared, laws } = self;
        let holds = prepared.terms_hold_for(impact)
            && laws.normal.holds_for(&prepared.constants.with_density(laws.contact, impact), impact)
            && laws.tangential.holds_for(impact);
        prepared.steps(Some(laws), holds, impact, rng)
    }
}

/// Runs the normal law, with the draw where there is one.
#[inline(always)]
fn normal_and_draw(wall: &Constants, block: &Block, seed: u64, outcomes: &mut Outcomes) {
    if wall.draws {
        run(StepSet::NORMAL.union(StepSet::DRAW), &Constants { draws: true, ..*wall }, block, seed, outcomes);
    } else {
        run(
            StepSet::NORMAL.union(StepSet::DRAW),
            &Constants { draws: false, ..*wall },
            block,
            seed,
            outcomes,
        );
    }
}

/// Runs some steps on each impact of a block. Between two loops the columns of the outcomes hold the quantities of the
/// [`ImpactState`].
#[inline(always)]
fn run(selected: StepSet, wall: &Constants, block: &Block, seed: u64, outcomes: &mut Outcomes) {
    for i in 0..block.length.min(BLOCK) {
        let rng = ImpactRng::new(seed, block.keys[i]);
        let mut state = load(i, wall, block, outcomes);
        let Ok(()) = evaluate(&mut PreparedImpact { wall, laws: None, rng }, selected, &mut state);
        store(i, selected, &state, outcomes);
    }
}

/// The state of the impact `i` before a loop.
#[inline(always)]
fn load(i: usize, wall: &Constants, block: &Block, outcomes: &Outcomes) -> ImpactState<()> {
    let input = |input: usize| block.inputs[input][i];
    let normal = outcomes.normal_restitution[i];
    ImpactState {
        impact: Impact {
            normal_speed: input(Impact::NORMAL_SPEED),
            tangential_speed: input(Impact::TANGENTIAL_SPEED),
            diameter: input(Impact::DIAMETER),
            particle_temperature: input(Impact::PARTICLE_TEMPERATURE),
            wall_temperature: input(Impact::WALL_TEMPERATURE),
            particle_density: input(Impact::PARTICLE_DENSITY),
            conversion: input(Impact::CONVERSION),
            spin: input(Impact::SPIN),
            ..Impact::default()
        },
        adhesion: normal,
        sticky: Stickiness { particle: outcomes.sticking_probability[i], wall: 0.0 },
        normal: wall.normal_rebound(normal),
        chance: outcomes.spin[i],
        ..ImpactState::default()
    }
}

/// Stores what the steps of `selected` have set for the impact `i`.
#[inline(always)]
fn store(i: usize, selected: StepSet, state: &ImpactState<()>, outcomes: &mut Outcomes) {
    if selected.contains(StepSet::STICKINESS) {
        outcomes.sticking_probability[i] = state.sticky.particle;
    }
    if selected.contains(StepSet::ADHESION) {
        outcomes.normal_restitution[i] = state.adhesion;
    }
    if selected.contains(StepSet::NORMAL) {
        outcomes.normal_restitution[i] = state.normal.restitution;
    }
    if selected.contains(StepSet::DRAW) {
        outcomes.spin[i] = state.chance;
    }
    if selected.contains(StepSet::RANGE) {
        outcomes.outside_range[i] = u32::from(state.outside_range);
    }
    if selected.contains(StepSet::REBOUND) {
        outcomes.normal_restitution[i] = state.normal_restitution;
        outcomes.tangential_restitution[i] = state.rebound.restitution;
        outcomes.sticking_probability[i] = state.probability;
        outcomes.spin[i] = state.rebound.spin;
        outcomes.stuck[i] = u32::from(state.captured);
        let [particle, wall] = [state.sticky.is_particle_sticky(), state.sticky.is_wall_sticky()];
        outcomes.regime[i] = 2 * u32::from(particle) + u32::from(wall);
    }
}

impl Constants {
    /// Density of the particle [kg/m³]: that of its material where the impact does not give it.
    #[inline(always)]
    fn density(&self, impact: &Impact) -> f64 {
        if impact.particle_density > 0.0 { impact.particle_density } else { self.density }
    }

    #[inline(always)]
    fn with_density(&self, contact: Contact, impact: &Impact) -> Contact {
        Contact { density: self.density(impact), ..contact }
    }

    #[inline(always)]
    fn normal_rebound(&self, restitution: f64) -> NormalRebound {
        let held = matches!(self.normal, Normal::ThorntonNing(_)) & (restitution <= 0.0);
        NormalRebound { restitution, held }
    }
}

impl WallSteps for PreparedImpact<'_> {
    type Contact = ();
    type Fault = Infallible;

    #[inline(always)]
    fn outside_range(&mut self, impact: &Impact) -> bool {
        let [particle, wall] = self.wall.materials;
        let speed = impact.normal_speed;
        let small_contact = self.wall.density(impact) * speed * speed <= self.wall.largest_pressure;
        !(within(impact.particle_temperature, particle)
            & within(impact.wall_temperature, wall)
            & small_contact)
    }

    #[inline(always)]
    fn contact(&mut self, _: &Impact) -> Result<(), Infallible> {
        Ok(())
    }

    #[inline(always)]
    fn adhesion(&self, impact: &Impact, (): &()) -> f64 {
        match self.wall.normal {
            Normal::ThorntonNing(law) => law.adhesive_pressure(impact.diameter),
            Normal::Constant(_) => 0.0,
        }
    }

    #[inline(always)]
    fn stickiness(&mut self, impact: &Impact) -> Result<Stickiness, Infallible> {
        let (temperature, conversion) = (impact.particle_temperature, impact.conversion);
        let particle = match self.wall.transitions {
            Transitions::None => 0.0,
            Transitions::One(one) => one.at(temperature, conversion),
            Transitions::Two(one, two) => one.at(temperature, conversion) * two.at(temperature, conversion),
        };
        Ok(Stickiness { particle, wall: 0.0 })
    }

    #[inline(always)]
    fn normal_law(&mut self, impact: &Impact, (): &(), adhesive_pressure: f64) -> NormalRebound {
        if let Some(laws) = self.laws {
            let contact = self.wall.with_density(laws.contact, impact);
            return NormalRebound::of(laws.normal.rebound(&contact, impact));
        }
        self.wall.normal_rebound(match self.wall.normal {
            Normal::ThorntonNing(law) => {
                law.rebound(self.wall.density(impact), impact.normal_speed, adhesive_pressure)
            }
            Normal::Constant(restitution) => restitution,
        })
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
    fn stiffness_ratio(&self, (): &()) -> f64 {
        self.wall.stiffness_ratio
    }

    #[inline(always)]
    fn tangential_law(&mut self, kinematics: &ImpactKinematics) -> Rebound {
        match self.laws {
            Some(laws) => laws.tangential.rebound(kinematics),
            None => self.wall.tangential.rebound(kinematics),
        }
    }
}

#[inline(always)]
pub(super) fn within(value: f64, [low, high]: [f64; 2]) -> bool {
    (value >= low) & (value <= high)
}

impl Tangential {
    pub fn new(law: TangentialLaw) -> Option<Self> {
        match law {
            TangentialLaw::Constant { restitution } => Some(Self::Constant(restitution)),
            TangentialLaw::Sliding { friction } => Some(Self::Sliding(friction)),
            TangentialLaw::SlidingRolling { friction } => Some(Self::SlidingRolling(friction)),
            TangentialLaw::Listed { .. } => None,
        }
    }

    #[inline(always)]
    pub fn rebound(self, kinematics: &ImpactKinematics) -> Rebound {
        match self {
            Self::Constant(restitution) => TangentialLaw::Constant { restitution }.rebound(kinematics),
            Self::Sliding(friction) => TangentialLaw::Sliding { friction }.rebound(kinematics),
            Self::SlidingRolling(friction) => TangentialLaw::SlidingRolling { friction }.rebound(kinematics),
        }
    }
}

impl Transitions {
    pub fn and(self, transition: Transition) -> Option<Self> {
        match self {
            Self::None => Some(Self::One(transition)),
            Self::One(first) => Some(Self::Two(first, transition)),
            Self::Two(..) => None,
        }
    }

    /// The transitions, in the order of the file.
    pub fn each(self) -> [Option<Transition>; 2] {
        match self {
            Self::None => [None, None],
            Self::One(one) => [Some(one), None],
            Self::Two(one, two) => [Some(one), Some(two)],
        }
    }

    /// Stickiness [1] of a particle with a temperature [K] and a conversion [1], from that which a criterion gives where there is one.
    #[inline(always)]
    pub fn after(self, criterion: Option<f64>, temperature: f64, conversion: f64) -> f64 {
        let times = |one: Transition| {
            let stickiness = one.at(temperature, conversion);
            criterion.map_or(stickiness, |product| product * stickiness)
        };
        match self {
            Self::None => criterion.unwrap_or(0.0),
            Self::One(one) => times(one),
            Self::Two(one, two) => times(one) * two.at(temperature, conversion),
        }
    }
}
