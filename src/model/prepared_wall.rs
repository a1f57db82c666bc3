//! A wall's impacts, prepared: what depends on material and model alone is worked out when the model is read.
//!
//! A plan exists where the walk of an impact needs no more than constant properties, a Thornton–Ning or constant normal law,
//! any tangential law, and the effects that name what they come down to ([`Precomputed`]). It gives the bits of the walk in
//! `mod.rs`: the laws are the same functions, and this file only leaves out what the model does not have. One formula serves
//! a single impact and a block of them; it has no branches, so the compiler makes vectors of it.

use fearless_simd::{Level, dispatch};

use super::block::{BLOCK, Block, Outcomes};
use super::wall::Wall;
use super::{Model, captured};
use crate::capture::Stickiness;
use crate::effect::{Precomputed, Term, Transition, stream};
use crate::impact::{INPUTS, Impact, Outcome, Regime};
use crate::normal::{self, NormalLaw};
use crate::rng::ImpactRng;
use crate::tangential::{ImpactKinematics, TangentialLaw};

/// The prepared numbers of one wall.
#[derive(Debug, Clone)]
pub(super) struct PreparedWall {
    normal: Normal,
    tangential: TangentialLaw,
    /// Mindlin's `k` [1].
    stiffness_ratio: f64,
    transitions: Transitions,
    /// Share of `e_n` that full stickiness takes [1].
    rebound_loss: f64,
    /// Temperatures [K] at which the properties of particle and wall are stated to hold.
    materials: [[f64; 2]; 2],
    /// Which of [`INPUTS`] has to lie where as well, for the outcome to be inside its range.
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

impl PreparedWall {
    /// The plan of a wall; `None` where the walk needs more than a plan has.
    pub fn new(model: &Model, wall: &Wall) -> Option<Self> {
        if model.stickiness.is_some() || wall.melt.is_some() {
            return None;
        }
        let mut contact = wall.prepared?;
        let mut transitions = Transitions::None;
        for term in &model.terms {
            match term.effect().precompute()? {
                Precomputed::Contact => contact = term.effect().contact(&Impact::default(), contact, 0.0),
                Precomputed::Transition(transition) => transitions = transitions.and(transition)?,
            }
        }
        let normal = match model.normal {
            NormalLaw::ThorntonNing => Normal::ThorntonNing(normal::Prepared::new(&contact)),
            NormalLaw::Constant { restitution } => Normal::Constant(restitution),
            NormalLaw::PlasticJkr => return None,
        };
        // The wall's own powder changes these two on the way.
        let dressed = |name| name == "layer_thickness" || name == "coverage";
        let valid: Vec<_> = model.terms.iter().flat_map(Term::valid).copied().collect();
        if valid.iter().any(|(input, _)| dressed(INPUTS[*input].name)) {
            return None;
        }
        Some(Self {
            normal,
            tangential: model.tangential,
            stiffness_ratio: contact.stiffness_ratio,
            transitions,
            rebound_loss: model.rebound_loss(),
            materials: [model.particle.valid_range(), wall.material().valid_range()],
            valid,
        })
    }

    /// Decides one impact that has been checked.
    #[inline(always)]
    pub fn one(&self, impact: &Impact, draw: ImpactRng) -> Outcome {
        // First, while nothing has to be kept over a call.
        let holds = self.holds_at(impact.particle_temperature, impact.wall_temperature)
            && (self.valid.is_empty() || self.terms_hold_for(impact));
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
        let along = self.tangential.rebound(&ImpactKinematics {
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
            outside_range: !holds,
        }
    }

    /// Decides a block of impacts that have been checked, with the instructions of `level`.
    pub fn many(&self, block: &Block, seed: u64, outcomes: &mut Outcomes, level: Level) {
        dispatch!(level, _simd => self.fill(block, seed, outcomes));
    }

    /// The steps of [`PreparedWall::one`], each for the whole block: short loops keep a processor's divider busy, while in a long one
    /// every impact waits for its own chain of results. What needs the divider goes with what does not.
    #[inline(always)]
    #[allow(clippy::needless_range_loop, reason = "one index over many columns")]
    fn fill(&self, block: &Block, seed: u64, outcomes: &mut Outcomes) {
        // Where a step leaves what the next one needs, until the outcome itself takes the place.
        let Outcomes { normal_restitution: plain, sticking_probability: sticky, spin: chance, .. } = outcomes;
        let length = block.length.min(BLOCK);
        let column = |input: usize| &block.inputs[input];
        let (speed, diameter) = (column(Impact::NORMAL_SPEED), column(Impact::DIAMETER));
        let (temperature, conversion) = (column(Impact::PARTICLE_TEMPERATURE), column(Impact::CONVERSION));
        match self.transitions {
            Transitions::None => sticky.fill(0.0),
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
        match self.normal {
            Normal::Constant(restitution) => plain.fill(restitution),
            Normal::ThorntonNing(law) => {
                for i in 0..length {
                    plain[i] = law.adhesive_squared(diameter[i]);
                }
            }
        }
        let draws = !matches!(self.transitions, Transitions::None);
        match (self.normal, draws) {
            (Normal::ThorntonNing(law), true) => {
                for i in 0..length {
                    plain[i] = law.rebound(speed[i], plain[i]);
                    chance[i] = ImpactRng::new(seed, block.keys[i]).uniform(stream::CAPTURE);
                }
            }
            (Normal::ThorntonNing(law), false) => {
                for i in 0..length {
                    plain[i] = law.rebound(speed[i], plain[i]);
                }
            }
            (Normal::Constant(_), true) => {
                for i in 0..length {
                    chance[i] = ImpactRng::new(seed, block.keys[i]).uniform(stream::CAPTURE);
                }
            }
            (Normal::Constant(_), false) => {}
        }
        if !draws {
            chance.fill(0.5);
        }
        match self.tangential {
            TangentialLaw::Constant { restitution } => {
                self.finish(block, TangentialLaw::Constant { restitution }, outcomes);
            }
            TangentialLaw::Sliding { friction } => {
                self.finish(block, TangentialLaw::Sliding { friction }, outcomes);
            }
            TangentialLaw::SlidingRolling { friction } => {
                self.finish(block, TangentialLaw::SlidingRolling { friction }, outcomes);
            }
        }
        for &(input, range) in &self.valid {
            for i in 0..length {
                outcomes.outside_range[i] |= u32::from(!within(block.inputs[input][i], range));
            }
        }
    }

    /// The last step of a block.
    #[inline(always)]
    fn finish(&self, block: &Block, law: TangentialLaw, outcomes: &mut Outcomes) {
        for i in 0..block.length.min(BLOCK) {
            let (plain, sticky) = (outcomes.normal_restitution[i], outcomes.sticking_probability[i]);
            let (probability, stuck) = self.capture(plain, sticky, outcomes.spin[i]);
            let e_n = self.softened(plain, sticky);
            let along = law.rebound(&ImpactKinematics {
                normal_speed: block.inputs[Impact::NORMAL_SPEED][i],
                tangential_speed: block.inputs[Impact::TANGENTIAL_SPEED][i],
                diameter: block.inputs[Impact::DIAMETER][i],
                spin: block.inputs[Impact::SPIN][i],
                normal_restitution: e_n,
                stiffness_ratio: self.stiffness_ratio,
            });
            outcomes.normal_restitution[i] = e_n;
            outcomes.tangential_restitution[i] = along.restitution;
            outcomes.sticking_probability[i] = probability;
            outcomes.spin[i] = along.spin;
            outcomes.stuck[i] = u32::from(stuck);
            outcomes.regime[i] = 2 * u32::from(sticky >= Stickiness::THRESHOLD);
            outcomes.outside_range[i] = u32::from(!self.holds_at(
                block.inputs[Impact::PARTICLE_TEMPERATURE][i],
                block.inputs[Impact::WALL_TEMPERATURE][i],
            ));
        }
    }

    /// Whether the materials are stated for these temperatures [K].
    #[inline(always)]
    fn holds_at(&self, particle: f64, wall: f64) -> bool {
        within(particle, self.materials[0]) & within(wall, self.materials[1])
    }

    /// Whether the terms are stated for such an impact. Apart, so that the usual impact keeps its numbers in registers.
    #[inline(never)]
    fn terms_hold_for(&self, impact: &Impact) -> bool {
        self.valid.iter().all(|&(input, range)| within((INPUTS[input].value)(impact), range))
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
