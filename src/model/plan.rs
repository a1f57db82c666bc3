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
        let plain = match self.normal {
            Normal::ThorntonNing(law) => law.restitution(impact.diameter, impact.normal_speed),
            Normal::Constant(restitution) => restitution,
        };
        let (temperature, conversion) = (impact.particle_temperature, impact.conversion);
        let sticky = match self.transitions {
            Transitions::None => 0.0,
            Transitions::One(one) => one.at(temperature, conversion),
            Transitions::Two(one, other) => {
                one.at(temperature, conversion) * other.at(temperature, conversion)
            }
        };
        let chance = match self.transitions {
            Transitions::None => 0.5,
            _ => draw.uniform(stream::CAPTURE),
        };
        let e_n = self.softened(plain, sticky);
        let along = self.tangential.rebound(&Glance {
            normal_speed: impact.normal_speed,
            tangential_speed: impact.tangential_speed,
            diameter: impact.diameter,
            spin: impact.spin,
            normal_restitution: e_n,
            stiffness_ratio: self.stiffness_ratio,
        });
        let (probability, stuck) = self.capture(plain, sticky, chance);
        Outcome {
            normal_restitution: e_n,
            tangential_restitution: along.restitution,
            sticking_probability: probability,
            stuck,
            spin: along.spin,
            regime: Regime::of(sticky >= Stickiness::THRESHOLD, false),
            outside_range: !self
                .valid
                .iter()
                .all(|(input, range)| within((INPUTS[*input].value)(impact), *range)),
        }
    }

    /// Decides a block of impacts that have been checked, with the instructions of `level`.
    pub fn many(&self, block: &Block, seed: u64, outcomes: &mut Outcomes, level: Level) {
        dispatch!(level, _simd => self.fill(block, seed, outcomes));
    }

    /// The steps of [`Plan::one`], each for the whole block: short loops keep a processor's divider busy, while in a long one
    /// every impact waits for its own chain of results.
    #[inline(always)]
    fn fill(&self, block: &Block, seed: u64, outcomes: &mut Outcomes) {
        let length = block.length.min(BLOCK);
        let [speed, diameter] = [Impact::NORMAL_SPEED, Impact::DIAMETER].map(|input| &block.inputs[input]);
        let [mut plain, mut sticky, mut chance] = [[0.0; BLOCK], [0.0; BLOCK], [0.5; BLOCK]];
        match self.normal {
            Normal::ThorntonNing(law) => {
                for i in 0..length {
                    plain[i] = law.adhesive_squared(diameter[i]);
                }
                for i in 0..length {
                    plain[i] = law.rebound(speed[i], plain[i]);
                }
            }
            Normal::Constant(restitution) => plain = [restitution; BLOCK],
        }
        let [temperature, conversion] =
            [Impact::PARTICLE_TEMPERATURE, Impact::CONVERSION].map(|input| &block.inputs[input]);
        match self.transitions {
            Transitions::None => {}
            Transitions::One(one) => {
                for i in 0..length {
                    sticky[i] = one.at(temperature[i], conversion[i]);
                }
            }
            Transitions::Two(one, other) => {
                for i in 0..length {
                    sticky[i] =
                        one.at(temperature[i], conversion[i]) * other.at(temperature[i], conversion[i]);
                }
            }
        }
        if !matches!(self.transitions, Transitions::None) {
            for i in 0..length {
                chance[i] = Draw::new(seed, block.keys[i]).uniform(stream::CAPTURE);
            }
        }
        for i in 0..length {
            let (probability, stuck) = self.capture(plain[i], sticky[i], chance[i]);
            outcomes.sticking_probability[i] = probability;
            outcomes.stuck[i] = u32::from(stuck);
            outcomes.regime[i] = Regime::of(sticky[i] >= Stickiness::THRESHOLD, false) as u32;
            outcomes.normal_restitution[i] = self.softened(plain[i], sticky[i]);
            outcomes.outside_range[i] = 0;
        }
        match self.tangential {
            TangentialLaw::Constant { restitution } => {
                self.slide(block, TangentialLaw::Constant { restitution }, outcomes);
            }
            TangentialLaw::Sliding { friction } => {
                self.slide(block, TangentialLaw::Sliding { friction }, outcomes);
            }
            TangentialLaw::SlidingRolling { friction } => {
                self.slide(block, TangentialLaw::SlidingRolling { friction }, outcomes);
            }
        }
        for &(input, range) in &self.valid {
            for i in 0..length {
                outcomes.outside_range[i] |= u32::from(!within(block.inputs[input][i], range));
            }
        }
    }

    #[inline(always)]
    fn slide(&self, block: &Block, law: TangentialLaw, outcomes: &mut Outcomes) {
        for i in 0..block.length.min(BLOCK) {
            let along = law.rebound(&Glance {
                normal_speed: block.inputs[Impact::NORMAL_SPEED][i],
                tangential_speed: block.inputs[Impact::TANGENTIAL_SPEED][i],
                diameter: block.inputs[Impact::DIAMETER][i],
                spin: block.inputs[Impact::SPIN][i],
                normal_restitution: outcomes.normal_restitution[i],
                stiffness_ratio: self.stiffness_ratio,
            });
            outcomes.tangential_restitution[i] = along.restitution;
            outcomes.spin[i] = along.spin;
        }
    }

    /// `e_n` [1] less what stickiness takes of it.
    #[inline(always)]
    fn softened(&self, plain: f64, sticky: f64) -> f64 {
        plain * (1.0 - self.rebound_loss * sticky)
    }

    /// Probability of capture, and whether it comes to that.
    #[inline(always)]
    fn capture(&self, plain: f64, sticky: f64, chance: f64) -> (f64, bool) {
        // Adhesion holds the particle for certain; otherwise stickiness decides.
        let held = matches!(self.normal, Normal::ThorntonNing(_)) & (plain <= 0.0);
        let free = Stickiness { particle: sticky, wall: 0.0 }.probability();
        let probability = if held { 1.0 } else { free };
        (probability, captured(probability, chance))
    }
}

#[inline(always)]
fn within(value: f64, [low, high]: [f64; 2]) -> bool {
    (value >= low) & (value <= high)
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
