//! A wall's impacts, prepared: what depends on material and model alone is worked out when the model is read.
//!
//! A plan exists where the walk of an impact needs no more than constant properties, a Thornton–Ning or constant normal law,
//! any tangential law, and the effects that name what they come down to ([`Simple`]). It gives the bits of the walk in
//! `mod.rs`: the laws are the same functions, and this file only leaves out what the model does not have. One formula serves
//! a single impact and a block of them; it has no branches, so the compiler makes vectors of it.

use fearless_simd::{Level, dispatch};

use super::block::{BLOCK, Block, Outcomes};
use super::wall::Wall;
use super::{Model, captured};
use crate::capture::Stickiness;
use crate::draw::Draw;
use crate::effect::{Simple, Term, Transition, stream};
use crate::impact::{INPUTS, Impact, Outcome, Regime};
use crate::normal::{self, NormalLaw};
use crate::tangential::{Glance, TangentialLaw};

/// The prepared numbers of one wall.
#[derive(Debug, Clone)]
pub(super) struct Plan {
    normal: Normal,
    tangential: TangentialLaw,
    /// Mindlin's `k` [1].
    stiffness_ratio: f64,
    transitions: Transitions,
    /// Share of `e_n` that full stickiness takes [1].
    rebound_loss: f64,
    /// Which of [`INPUTS`] has to lie where, for the outcome to be inside its range.
    valid: Vec<(usize, [f64; 2])>,
}

#[derive(Debug, Clone, Copy)]
enum Normal {
    ThorntonNing(normal::Prepared),
    Constant(f64),
}

/// What makes the particle sticky; several multiply.
#[derive(Debug, Clone, Copy)]
enum Transitions {
    None,
    One(Transition),
    Two(Transition, Transition),
}

/// One impact's numbers as far as a plan looks at them.
struct Row {
    normal_speed: f64,
    tangential_speed: f64,
    diameter: f64,
    spin: f64,
    particle_temperature: f64,
    conversion: f64,
    key: u64,
}

/// What becomes of it.
struct Decision {
    normal_restitution: f64,
    tangential_restitution: f64,
    probability: f64,
    stuck: bool,
    spin: f64,
    sticky: bool,
}

/// What is done with the formula, once the model has chosen it: one impact, or a block of them.
trait Task {
    type Result;
    fn run(self, decide: impl Fn(&Row) -> Decision) -> Self::Result;
}

impl Plan {
    /// The plan of a wall; `None` where the walk needs more than a plan has.
    pub fn new(model: &Model, wall: &Wall) -> Option<Self> {
        if model.stickiness.is_some() || wall.melt.is_some() {
            return None;
        }
        let mut contact = wall.prepared?;
        let mut transitions = Transitions::None;
        for term in &model.terms {
            match term.effect().simple()? {
                Simple::Contact => contact = term.effect().contact(&Impact::default(), contact, 0.0),
                Simple::Transition(transition) => transitions = transitions.and(transition)?,
            }
        }
        let normal = match model.normal {
            NormalLaw::ThorntonNing => Normal::ThorntonNing(normal::Prepared::new(&contact)),
            NormalLaw::Constant { restitution } => Normal::Constant(restitution),
            NormalLaw::RaisedPullOff => return None,
        };
        // The wall's own powder changes these two on the way.
        let dressed = |name| name == "layer_thickness" || name == "coverage";
        let valid: Vec<_> = model.terms.iter().flat_map(Term::valid).copied().collect();
        if valid.iter().any(|(input, _)| dressed(INPUTS[*input].name)) {
            return None;
        }
        let of_materials = [
            (Impact::PARTICLE_TEMPERATURE, model.particle.valid_range()),
            (Impact::WALL_TEMPERATURE, wall.material().valid_range()),
        ];
        Some(Self {
            normal,
            tangential: model.tangential,
            stiffness_ratio: contact.stiffness_ratio,
            transitions,
            rebound_loss: model.rebound_loss(),
            valid: valid.into_iter().chain(of_materials).collect(),
        })
    }

    /// Decides one impact that has been checked.
    #[inline]
    pub fn one(&self, impact: &Impact, draw: Draw) -> Outcome {
        let decision = self.choose(One { impact, key: draw.key }, draw.seed);
        let inside = |&(input, [low, high]): &(usize, [f64; 2])| {
            let value = (INPUTS[input].value)(impact);
            (low..=high).contains(&value)
        };
        Outcome {
            normal_restitution: decision.normal_restitution,
            tangential_restitution: decision.tangential_restitution,
            sticking_probability: decision.probability,
            stuck: decision.stuck,
            spin: decision.spin,
            regime: Regime::of(decision.sticky, false),
            outside_range: !self.valid.iter().all(inside),
        }
    }

    /// Decides a block of impacts that have been checked, with the instructions of `level`.
    pub fn many(&self, block: &Block, seed: u64, outcomes: &mut Outcomes, level: Level) {
        dispatch!(level, _simd => self.fill(block, seed, outcomes));
    }

    #[inline(always)]
    fn fill(&self, block: &Block, seed: u64, outcomes: &mut Outcomes) {
        let length = block.length.min(BLOCK);
        self.choose(Many { block, length, outcomes: &mut *outcomes }, seed);
        for flag in &mut outcomes.outside_range[..length] {
            *flag = 0;
        }
        for &(input, [low, high]) in &self.valid {
            let column = &block.inputs[input];
            for i in 0..length {
                let inside = (column[i] >= low) & (column[i] <= high);
                outcomes.outside_range[i] |= u32::from(!inside);
            }
        }
    }

    #[inline(always)]
    fn choose<T: Task>(&self, task: T, seed: u64) -> T::Result {
        match self.normal {
            Normal::ThorntonNing(law) => self.choose_tangential(
                task,
                seed,
                #[inline(always)]
                move |diameter, speed| {
                    let e_n = law.restitution(diameter, speed);
                    (e_n, e_n <= 0.0)
                },
            ),
            Normal::Constant(e_n) => self.choose_tangential(
                task,
                seed,
                #[inline(always)]
                move |_, _| (e_n, false),
            ),
        }
    }

    #[inline(always)]
    fn choose_tangential<T: Task>(
        &self,
        task: T,
        seed: u64,
        normal: impl Fn(f64, f64) -> (f64, bool) + Copy,
    ) -> T::Result {
        match self.tangential {
            TangentialLaw::SlidingRolling { friction } => {
                let law = TangentialLaw::SlidingRolling { friction };
                self.choose_stickiness(task, seed, normal, law)
            }
            TangentialLaw::Sliding { friction } => {
                self.choose_stickiness(task, seed, normal, TangentialLaw::Sliding { friction })
            }
            TangentialLaw::Constant { restitution } => {
                self.choose_stickiness(task, seed, normal, TangentialLaw::Constant { restitution })
            }
        }
    }

    #[inline(always)]
    fn choose_stickiness<T: Task>(
        &self,
        task: T,
        seed: u64,
        normal: impl Fn(f64, f64) -> (f64, bool) + Copy,
        tangential: TangentialLaw,
    ) -> T::Result {
        let loss = self.rebound_loss;
        let k = self.stiffness_ratio;
        match self.transitions {
            Transitions::None => task.run(
                #[inline(always)]
                |row| decide(row, normal, tangential, k, loss, 0.0, 0.5),
            ),
            Transitions::One(one) => task.run(
                #[inline(always)]
                |row| {
                    let sticky = one.at(row.particle_temperature, row.conversion);
                    decide(row, normal, tangential, k, loss, sticky, drawn(seed, row.key))
                },
            ),
            Transitions::Two(one, other) => task.run(
                #[inline(always)]
                |row| {
                    let [t, x] = [row.particle_temperature, row.conversion];
                    let sticky = one.at(t, x) * other.at(t, x);
                    decide(row, normal, tangential, k, loss, sticky, drawn(seed, row.key))
                },
            ),
        }
    }
}

impl Transitions {
    fn and(self, transition: Transition) -> Option<Self> {
        match self {
            Self::None => Some(Self::One(transition)),
            Self::One(first) => Some(Self::Two(first, transition)),
            Self::Two(..) => None,
        }
    }
}

#[inline(always)]
fn drawn(seed: u64, key: u64) -> f64 {
    Draw::new(seed, key).uniform(stream::CAPTURE)
}

/// The walk of an impact, as far as a plan has to go.
#[inline(always)]
fn decide(
    row: &Row,
    normal: impl Fn(f64, f64) -> (f64, bool),
    tangential: TangentialLaw,
    stiffness_ratio: f64,
    rebound_loss: f64,
    sticky: f64,
    drawn: f64,
) -> Decision {
    let (plain, held) = normal(row.diameter, row.normal_speed);
    let e_n = plain * (1.0 - rebound_loss * sticky);
    let along = tangential.rebound(&Glance {
        normal_speed: row.normal_speed,
        tangential_speed: row.tangential_speed,
        diameter: row.diameter,
        spin: row.spin,
        normal_restitution: e_n,
        stiffness_ratio,
    });
    let free = Stickiness { particle: sticky, wall: 0.0 }.probability();
    let probability = if held { 1.0 } else { free };
    Decision {
        normal_restitution: e_n,
        tangential_restitution: along.restitution,
        probability,
        stuck: captured(probability, drawn),
        spin: along.spin,
        sticky: sticky >= Stickiness::THRESHOLD,
    }
}

struct One<'a> {
    impact: &'a Impact,
    key: u64,
}

impl Task for One<'_> {
    type Result = Decision;

    #[inline(always)]
    fn run(self, decide: impl Fn(&Row) -> Decision) -> Decision {
        let impact = self.impact;
        decide(&Row {
            normal_speed: impact.normal_speed,
            tangential_speed: impact.tangential_speed,
            diameter: impact.diameter,
            spin: impact.spin,
            particle_temperature: impact.particle_temperature,
            conversion: impact.conversion,
            key: self.key,
        })
    }
}

struct Many<'a> {
    block: &'a Block,
    length: usize,
    outcomes: &'a mut Outcomes,
}

impl Task for Many<'_> {
    type Result = ();

    #[inline(always)]
    fn run(self, decide: impl Fn(&Row) -> Decision) {
        let Self { block: Block { inputs, keys, .. }, length, outcomes } = self;
        for i in 0..length {
            let decision = decide(&Row {
                normal_speed: inputs[Impact::NORMAL_SPEED][i],
                tangential_speed: inputs[Impact::TANGENTIAL_SPEED][i],
                diameter: inputs[Impact::DIAMETER][i],
                spin: inputs[Impact::SPIN][i],
                particle_temperature: inputs[Impact::PARTICLE_TEMPERATURE][i],
                conversion: inputs[Impact::CONVERSION][i],
                key: keys[i],
            });
            outcomes.normal_restitution[i] = decision.normal_restitution;
            outcomes.tangential_restitution[i] = decision.tangential_restitution;
            outcomes.sticking_probability[i] = decision.probability;
            outcomes.spin[i] = decision.spin;
            outcomes.regime[i] = 2 * u32::from(decision.sticky);
            outcomes.stuck[i] = u32::from(decision.stuck);
        }
    }
}
