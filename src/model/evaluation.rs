//! The steps of an impact in their order, for every kind of wall.
//!
//! [`evaluate`] is the order. Two kinds of walls follow it through [`WallSteps`]: a `GeneralWall`
//! with every law, effect, draw and trace, and a `PreparedWall` whose constants were computed when
//! the model was read. A step that a prepared wall does not need keeps the trait's default and
//! costs nothing.
//!
//! A new quantity of an impact is a field of [`ImpactState`]; a new step is a method of
//! [`WallSteps`] and a line of [`evaluate`].
//!
//! A single impact runs all steps at once. A block of impacts runs them in groups ([`StepSet`]),
//! each group in a loop of its own over the block: short loops keep a processor's divider busy,
//! while in one long loop every step waits for
//! the result of the one before. The functions are the
//! same, so both give the same bits.

use crate::capture::{Combination, Stickiness};
use crate::impact::{Impact, Outcome, Regime};
use crate::normal::Contact;
use crate::tangential::{ImpactKinematics, Rebound};

/// A set of steps.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepSet(u8);

impl StepSet {
    /// Whether properties, criteria and fitted terms are used within their stated ranges.
    pub const RANGE: Self = Self(1);
    /// Tilt of the wall, and the contact with the effects on it.
    pub const CONTACT: Self = Self(2);
    /// Stickiness of particle and wall.
    pub const STICKINESS: Self = Self(4);
    /// The part of the normal law that does not depend on speed.
    pub const ADHESION: Self = Self(8);
    /// Normal law and the effects on `e_n`.
    pub const NORMAL: Self = Self(16);
    /// Random number of the capture.
    pub const DRAW: Self = Self(32);
    /// Loss by stickiness, tangential law with the effects on `e_t`, capture, and the fitted corrections.
    pub const REBOUND: Self = Self(64);
    /// Every step.
    pub const ALL: Self = Self(127);

    /// Both sets.
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    #[inline(always)]
    pub const fn contains(self, step: Self) -> bool {
        self.0 & step.0 != 0
    }
}

/// Normal restitution, and whether the particle is held.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct NormalRebound {
    /// Normal restitution `e_n` [1]; 0 when the particle is held.
    pub restitution: f64,
    /// Whether adhesion or a film holds the particle with certainty.
    pub held: bool,
}

impl NormalRebound {
    /// From the restitution [1] of a particle that rebounds, `None` for one that is held.
    pub fn of(restitution: Option<f64>) -> Self {
        Self { restitution: restitution.unwrap_or(0.0), held: restitution.is_none() }
    }
}

/// What fitted corrections change.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corrected {
    /// `e_n` and `e_t` [1] with regard to the mean wall.
    pub restitution: [f64; 2],
    /// Probability of capture [1].
    pub probability: f64,
}

/// What is known of an impact between two steps.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ImpactState {
    /// The impact with regard to the local, tilted wall.
    pub impact: Impact,
    pub outside_range: bool,
    pub contact: Contact,
    pub sticky: Stickiness,
    /// `rho v_adh²` [Pa], density [kg/m³] times the adhesive velocity [m/s] squared; 0 where the
    /// normal law computes it itself.
    pub adhesion: f64,
    pub normal: NormalRebound,
    /// Random number of the capture, in (0, 1).
    pub chance: f64,
    /// `e_n` [1] after all losses, with regard to the mean wall.
    pub normal_restitution: f64,
    /// `e_t` [1] and spin [rad/s] with regard to the mean wall.
    pub rebound: Rebound,
    /// Probability of capture [1].
    pub probability: f64,
    pub captured: bool,
}

impl ImpactState {
    /// The outcome after the last step.
    #[inline(always)]
    pub fn outcome(&self) -> Outcome {
        Outcome {
            normal_restitution: self.normal_restitution,
            tangential_restitution: self.rebound.restitution,
            sticking_probability: self.probability,
            stuck: self.captured,
            spin: self.rebound.spin,
            regime: Regime::of(self.sticky.is_particle_sticky(), self.sticky.is_wall_sticky()),
            outside_range: self.outside_range,
        }
    }
}

/// The steps of an impact, as a kind of wall implements them.
pub(super) trait WallSteps {
    /// Why an impact cannot be decided.
    type Fault;

    /// Whether a property, a capture criterion or a fitted term is used outside the range that it is stated for.
    fn outside_range(&mut self, arriving: &Impact) -> bool;

    /// Turns the impact into the frame of the local wall, which effects may tilt.
    #[inline(always)]
    fn turn(&mut self, _: &mut Impact) {}

    /// The contact at the temperatures of the impact, with the effects on it.
    fn contact(&mut self, impact: &Impact) -> Result<Contact, Self::Fault>;

    /// Stickiness of particle and wall.
    fn stickiness(&mut self, impact: &Impact) -> Result<Stickiness, Self::Fault>;

    /// The part of the normal law that does not depend on speed, where a block computes it apart: `rho v_adh²` [Pa].
    #[inline(always)]
    fn adhesion(&self, _: &Impact, _: &Contact) -> f64 {
        0.0
    }

    /// What the normal law gives.
    fn normal_law(&mut self, impact: &Impact, contact: &Contact, adhesion: f64) -> NormalRebound;

    /// The normal rebound after the effects on it.
    #[inline(always)]
    fn normal_effects(&mut self, _: &Impact, _: &Contact, rebound: NormalRebound) -> NormalRebound {
        rebound
    }

    /// Random number of the capture, in (0, 1).
    fn draw(&mut self) -> f64;

    /// Share of `e_n` [1] that a fully sticky particle loses where it still rebounds.
    fn rebound_loss(&self) -> f64;

    /// What the tangential law gives.
    fn tangential_law(&mut self, kinematics: &ImpactKinematics) -> Rebound;

    /// The tangential rebound after the effects on it.
    #[inline(always)]
    fn tangential_effects(&mut self, _: &ImpactKinematics, rebound: Rebound) -> Rebound {
        rebound
    }

    /// `e_n` [1] that makes no energy with this tangential rebound. Only effects without a precomputed form
    /// can make any.
    #[inline(always)]
    fn energy_bound(&mut self, kinematics: &ImpactKinematics, _: Rebound) -> f64 {
        kinematics.normal_restitution
    }

    /// `e_n` [1] and the tangential rebound with regard to the mean wall, from those with regard to the local one.
    #[inline(always)]
    fn turn_back(&self, _: &Impact, e_n: f64, rebound: Rebound) -> (f64, Rebound) {
        (e_n, rebound)
    }

    /// Probability that the stickiness of particle or wall holds the particle [1].
    #[inline(always)]
    fn capture_probability(&mut self, _: &Impact, stickiness: Stickiness) -> f64 {
        stickiness.particle
    }

    /// The outcome after the fitted corrections, which are not based on a law.
    #[inline(always)]
    fn correct(&mut self, plain: Corrected) -> Corrected {
        plain
    }

    /// Whether a law, or a term with a range of a group, was used outside the range that it is stated for, known
    /// after the last step.
    #[inline(always)]
    fn left_range(&self) -> bool {
        false
    }

    /// Records the value of a quantity after a term.
    #[inline(always)]
    fn trace(&mut self, _term: &'static str, _quantity: &'static str, _value: f64) {}
}

/// Probability of capture [1] of a wall with a covered and a bare share: the impact meets one of
/// them, with the probability `met`; the other has the share `share` [1] of the wall and the
/// probability `other`.
#[inline(always)]
pub(super) fn both_shares(share: f64, met: f64, other: f64) -> f64 {
    (1.0 - share) * met + share * other
}

/// What decides the capture of a particle that is no droplet, by a sticky particle or wall.
#[derive(Debug, Clone, Copy)]
pub(super) struct OnBareWall {
    /// Whether the particle rebounds from the melt on the wall.
    pub rebounds_from_melt: bool,
    /// Whether no melt acts on it.
    pub dry: bool,
    /// Whether the normal law describes the contact of two solids.
    pub contact_law: bool,
}

impl OnBareWall {
    /// Probability of capture [1], and whether the normal law was used outside its range;
    /// `left_range` says so of the law alone. A dry particle leaves a melt that it rebounds from. A
    /// particle that rebounds from a sticky wall by the law of a dry contact is outside that law's
    /// range.
    #[inline(always)]
    pub fn capture_probability(
        self,
        combination: Combination,
        stickiness: Stickiness,
        left_range: bool,
    ) -> (f64, bool) {
        let wall = if self.rebounds_from_melt { 0.0 } else { stickiness.wall };
        let probability = combination.probability(Stickiness { wall, ..stickiness });
        let [law, dry_contact] = self.ranges_left(stickiness, probability, left_range);
        (probability, law | dry_contact)
    }

    /// Whether the normal law is left by its own range, and whether as a dry contact on a sticky wall.
    #[inline(always)]
    pub fn ranges_left(self, stickiness: Stickiness, probability: f64, left_range: bool) -> [bool; 2] {
        let dry_rebound = (probability < 1.0) & self.dry & stickiness.is_wall_sticky();
        // Slag that holds every particle does so whatever the law of a dry contact says.
        let holds_all = !self.rebounds_from_melt & (stickiness.wall >= 1.0);
        [left_range & !holds_all, dry_rebound & self.contact_law]
    }
}

/// Runs the steps of `selected` on an impact, in their order.
///
/// # Errors
/// What [`WallSteps::contact`] and [`WallSteps::stickiness`] return.
#[inline(always)]
pub(super) fn evaluate<S: WallSteps>(
    steps: &mut S,
    selected: StepSet,
    state: &mut ImpactState,
) -> Result<(), S::Fault> {
    if selected.contains(StepSet::RANGE) {
        state.outside_range = steps.outside_range(&state.impact);
    }
    if selected.contains(StepSet::CONTACT) {
        steps.turn(&mut state.impact);
        state.contact = steps.contact(&state.impact)?;
    }
    if selected.contains(StepSet::STICKINESS) {
        state.sticky = steps.stickiness(&state.impact)?;
        steps.trace("wall", "wall stickiness", state.sticky.wall);
    }
    if selected.contains(StepSet::ADHESION) {
        state.adhesion = steps.adhesion(&state.impact, &state.contact);
    }
    if selected.contains(StepSet::NORMAL) {
        let rebound = steps.normal_law(&state.impact, &state.contact, state.adhesion);
        state.normal = steps.normal_effects(&state.impact, &state.contact, rebound);
    }
    if selected.contains(StepSet::DRAW) {
        state.chance = steps.draw();
    }
    if selected.contains(StepSet::REBOUND) {
        rebound(steps, state);
    }
    Ok(())
}

/// The step [`StepSet::REBOUND`]: restitution, probability of capture and decision.
#[inline(always)]
fn rebound<S: WallSteps>(steps: &mut S, state: &mut ImpactState) {
    let normal_restitution = state.normal.restitution * (1.0 - steps.rebound_loss() * state.sticky.particle);
    steps.trace("stickiness", "e_n", normal_restitution);
    let kinematics = ImpactKinematics {
        normal_speed: state.impact.normal_speed,
        tangential_speed: state.impact.tangential_speed,
        diameter: state.impact.diameter,
        spin: state.impact.spin,
        normal_restitution,
        stiffness_ratio: state.contact.stiffness_ratio,
    };
    let rebound = steps.tangential_law(&kinematics);
    let rebound = steps.tangential_effects(&kinematics, rebound);
    let normal_restitution = steps.energy_bound(&kinematics, rebound);
    (state.normal_restitution, state.rebound) = steps.turn_back(&state.impact, normal_restitution, rebound);
    // The probability is 1 if adhesion or a film holds the particle.
    let by_stickiness = steps.capture_probability(&state.impact, state.sticky);
    let probability = if state.normal.held { 1.0 } else { by_stickiness };
    steps.trace("capture", "p_stick", probability);
    let restitution = [state.normal_restitution, state.rebound.restitution];
    let corrected = steps.correct(Corrected { restitution, probability });
    state.outside_range |= steps.left_range();
    [state.normal_restitution, state.rebound.restitution] = corrected.restitution;
    state.probability = corrected.probability;
    state.captured = (state.probability >= 1.0) | (state.chance < state.probability);
}
