//! The steps of an impact on any wall: properties over temperature, slag, every law and effect, draws and a trace.
//!
//! A wall with slag or powder is a patchwork: an impact meets its covered or its bare share. A draw
//! decides which; the outcome is that of the share met, and its probability of capture is that of
//! both, `c P_covered + (1 - c) P_bare`.

use super::beyond::{self, Beyond};
use super::energy_bound;
use super::evaluation::{
    Corrected, ImpactState, NormalRebound, OnBareWall, StepSet, WallSteps, both_shares, evaluate,
};
use super::groups::ImpactOnWall;
use super::tilted_frame::TiltedFrame;
use super::wall::WallPlace;
use super::{Model, Wall};
use crate::capture::Stickiness;
use crate::deposit::layers;
use crate::effect::{CurveInput, CurveTarget, OnMelt, Operation, Term, shifted_probability, stream};
use crate::group::GROUPS;
use crate::impact::{Impact, ImpactError, Outcome};
use crate::normal::Contact;
use crate::tangential::{ImpactKinematics, Rebound};

/// Both ends of the 90 % band of the stickiness, in a trace.
const BAND: [&str; 2] = ["stickiness at 5 %", "stickiness at 95 %"];

/// What watches the steps of an impact on a model.
pub(super) trait Watcher<'m> {
    /// Whether it shows what it receives: only then are bands computed.
    const SHOWS: bool = false;
    /// Whether it is told what is used outside of its range; else the outcome does not say so either.
    const JUDGES_RANGE: bool = true;

    /// Receives a quantity after a term.
    fn trace(&mut self, _term: &'static str, _quantity: &'static str, _value: f64) {}

    /// Receives what is used outside of its range.
    fn beyond(&mut self, _beyond: Beyond<'m>) {}

    /// Receives `e_n` [1] before the fitted corrections.
    fn before_corrections(&mut self, _normal_restitution: f64) {}
}

/// Watches nothing.
pub(super) struct Unwatched;

impl Watcher<'_> for Unwatched {}

/// Watches nothing, not even ranges: for means over many draws.
struct RangeIgnored;

impl Watcher<'_> for RangeIgnored {
    const JUDGES_RANGE: bool = false;
}

/// The share of the wall that is not met: its ranges count, its terms are not shown.
struct NotMet<'w, W>(&'w mut W);

impl<'m, W: Watcher<'m>> Watcher<'m> for NotMet<'_, W> {
    fn beyond(&mut self, beyond: Beyond<'m>) {
        self.0.beyond(beyond);
    }
}

/// One impact on a wall of a model. `uniform` gives the random number of each stream, in (0, 1).
struct GeneralWall<'m, 'a, U, W> {
    model: &'m Model,
    wall: &'m Wall,
    place: WallPlace,
    /// The impact on the wall as a whole, covered or not: fitted corrections depend on it.
    reaching: &'a Impact,
    /// The impact with regard to the mean wall.
    arriving: &'a Impact,
    frame: TiltedFrame,
    /// What the melt on the wall does to a dry particle, where a term says it.
    on_melt: Option<OnMelt>,
    /// Normal restitution [1] of a droplet that bounces whole.
    droplet_rebound: Option<f64>,
    /// Whether a law was used outside its range.
    left_range: bool,
    contact: Contact,
    uniform: &'a U,
    watcher: &'a mut W,
}

impl Model {
    /// Decides an impact by the general steps.
    pub(super) fn evaluate<'m>(
        &'m self,
        wall: usize,
        impact: &Impact,
        uniform: impl Fn(u64) -> f64,
        watcher: &mut impl Watcher<'m>,
    ) -> Result<Outcome, ImpactError> {
        let mut arriving = *impact;
        let wall = self.at_wall(wall, &mut arriving)?;
        let met = place_met(wall, &arriving, &uniform);
        let outcome = self.evaluate_place(wall, &arriving, met, &uniform, watcher)?;
        let (other, share) = match met {
            WallPlace::Anywhere => return Ok(outcome),
            WallPlace::Bare => (WallPlace::Covered, arriving.coverage),
            WallPlace::Covered => (WallPlace::Bare, 1.0 - arriving.coverage),
        };
        if share == 0.0 {
            return Ok(outcome);
        }
        let elsewhere = self.evaluate_place(wall, &arriving, other, &uniform, &mut NotMet(watcher))?;
        let sticking_probability =
            both_shares(share, outcome.sticking_probability, elsewhere.sticking_probability);
        watcher.trace("cover", "p_stick", sticking_probability);
        let outside_range = outcome.outside_range | elsewhere.outside_range;
        Ok(Outcome { sticking_probability, outside_range, ..outcome })
    }

    /// Decides an impact with the caller's random numbers; the probability of capture is that of
    /// the place met, covered or bare. For averages over the random draws in which a rebound counts
    /// where it happens. Ranges are not judged: `outside_range` is false.
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn resolve_place_with(
        &self,
        wall: usize,
        impact: &Impact,
        uniform: impl Fn(u64) -> f64,
    ) -> Result<Outcome, ImpactError> {
        self.at_place_met(wall, impact, uniform, &mut RangeIgnored)
    }

    /// The same with a watcher.
    pub(super) fn at_place_met<'m>(
        &'m self,
        wall: usize,
        impact: &Impact,
        uniform: impl Fn(u64) -> f64,
        watcher: &mut impl Watcher<'m>,
    ) -> Result<Outcome, ImpactError> {
        let mut arriving = *impact;
        let wall = self.at_wall(wall, &mut arriving)?;
        let met = place_met(wall, &arriving, &uniform);
        self.evaluate_place(wall, &arriving, met, &uniform, watcher)
    }

    /// Whether a draw decides if the impact meets the covered or the bare share of the wall.
    pub fn draws_place(&self, wall: usize, impact: &Impact) -> bool {
        self.drawn_cover(wall, impact).is_some()
    }

    /// The covered share of the wall [1] where a draw decides if the impact meets it or the bare share.
    pub(super) fn drawn_cover(&self, wall: usize, impact: &Impact) -> Option<f64> {
        if !self.walls.get(wall)?.is_patchwork(impact) {
            return None;
        }
        let mut arriving = *impact;
        self.at_wall(wall, &mut arriving).ok()?;
        (arriving.coverage > 0.0 && arriving.coverage < 1.0).then_some(arriving.coverage)
    }

    /// Decides an impact at one place of a wall.
    fn evaluate_place<'m>(
        &'m self,
        wall: &'m Wall,
        reaching: &Impact,
        place: WallPlace,
        uniform: &impl Fn(u64) -> f64,
        watcher: &mut impl Watcher<'m>,
    ) -> Result<Outcome, ImpactError> {
        let at_place;
        let arriving = match place {
            WallPlace::Anywhere => reaching,
            WallPlace::Bare => {
                at_place = layers::bare(reaching);
                &at_place
            }
            WallPlace::Covered => {
                at_place = layers::covered(reaching);
                &at_place
            }
        };
        let frame = TiltedFrame { tilt: 0.0 };
        let mut steps = GeneralWall {
            model: self,
            wall,
            place,
            reaching,
            arriving,
            frame,
            on_melt: None,
            droplet_rebound: None,
            left_range: false,
            contact: Contact::default(),
            uniform,
            watcher,
        };
        let mut state = ImpactState { impact: *arriving, ..ImpactState::default() };
        evaluate(&mut steps, StepSet::ALL, &mut state)?;
        Ok(state.outcome())
    }

    /// The wall with this index. The impact receives what the model file puts on that wall and assumes.
    pub(super) fn at_wall(&self, wall: usize, impact: &mut Impact) -> Result<&Wall, ImpactError> {
        impact.check()?;
        let wall = self.walls.get(wall).ok_or(ImpactError::NoSuchWall(wall))?;
        wall.covering.apply(impact);
        self.complete(impact)?;
        Ok(wall)
    }

    /// The impact as it meets the wall with this index: with what the model file puts on that wall and assumes.
    ///
    /// # Errors
    /// [`ImpactError`] for an impact that cannot be, or a wall that the model does not have.
    pub fn met(&self, wall: usize, impact: &Impact) -> Result<Impact, ImpactError> {
        let mut met = *impact;
        self.at_wall(wall, &mut met)?;
        Ok(met)
    }

    /// Gives the inputs that the model file declares their default where the impact does not state them.
    fn complete(&self, impact: &mut Impact) -> Result<(), ImpactError> {
        for (input, value) in self.extra_inputs.iter().zip(impact.extra.iter_mut()) {
            if value.is_nan() {
                *value = input.default;
            }
            if value.is_infinite() {
                let (quantity, reason) = (input.name.clone().into(), "must be finite");
                return Err(ImpactError::Unusable { quantity, value: *value, reason });
            }
        }
        Ok(())
    }

    /// The contact of particle and wall at their temperatures, with the effects on it.
    pub(super) fn contact(
        &self,
        wall: &Wall,
        impact: &Impact,
        place: WallPlace,
        uniform: &impl Fn(u64) -> f64,
    ) -> Result<Contact, ImpactError> {
        let frozen = self.frozen_slag(wall, impact);
        let mut of_materials = wall.contact(&self.particle, impact, place, frozen)?;
        if self.uses_melt && place != WallPlace::Covered {
            of_materials.melt = self.melt_met(wall, impact)?;
        }
        let change = |contact, term: &Term| term.effect().contact(impact, contact, term.chance(uniform));
        Ok(self.terms.iter().fold(of_materials, change))
    }

    /// Stickiness of the particle [1]: the product of what the capture criterion and the effects give, 0 without any.
    pub(super) fn particle_stickiness(
        &self,
        impact: &Impact,
        trace: &mut impl FnMut(&'static str, &'static str, f64),
    ) -> Result<f64, ImpactError> {
        let mut product = None;
        if let Some(criterion) = &self.stickiness {
            let stickiness = criterion.in_flight(impact)?;
            trace(criterion.name(), "particle stickiness", stickiness);
            product = Some(stickiness);
        }
        for term in &self.terms {
            if let Some(stickiness) = term.effect().particle_stickiness(impact) {
                trace(term.kind().id, "particle stickiness", stickiness);
                product = Some(product.unwrap_or(1.0) * stickiness);
            }
        }
        let factors = self.terms.iter().map(|term| term.effect().stickiness_factor(impact));
        Ok(factors.fold(product.unwrap_or(0.0), |product, factor| product * factor))
    }

    /// Normal restitution [1] of a droplet that bounces whole; `None` for any other particle. In
    /// melt on the wall it merges.
    fn droplet_rebound(
        &self,
        wall: &Wall,
        impact: &Impact,
        place: WallPlace,
    ) -> Result<Option<f64>, ImpactError> {
        let Some(criterion) = &self.stickiness else { return Ok(None) };
        // Only the droplet criterion has such rebounds; the viscosity of the melt is computed for them alone.
        let rebound = criterion.droplet_rebound(impact, wall.partner(place))?;
        if rebound.is_some() && !self.may_bounce(wall, place, impact)? { Ok(None) } else { Ok(rebound) }
    }

    /// Whether a droplet meets a wall without melt, in which it merges.
    pub(super) fn may_bounce(
        &self,
        wall: &Wall,
        place: WallPlace,
        impact: &Impact,
    ) -> Result<bool, ImpactError> {
        Ok(place == WallPlace::Covered || self.melt_met(wall, impact)?.is_none())
    }

    /// The outcome after the fitted corrections, in the order of the file; of capture, the factors
    /// are multiplied and the shifts of the log odds added up. `of` is the impact on the wall as a whole.
    pub(super) fn corrected(
        &self,
        of: &ImpactOnWall<'_>,
        plain: Corrected,
        trace: &mut impl FnMut(&'static str, &'static str, f64),
    ) -> Corrected {
        if !self.has_corrections {
            return plain;
        }
        let Corrected { restitution: [mut e_n, mut e_t], mut probability } = plain;
        let (mut capture, mut factor, mut shift) = (probability, 1.0, 0.0);
        for term in &self.terms {
            let Some(correction) = term.effect().correction() else { continue };
            let Some(value) = correction.value(of) else { continue };
            let (quantity, corrected) = match correction.on() {
                CurveTarget::NormalRestitution => ("e_n", &mut e_n),
                CurveTarget::TangentialRestitution => ("e_t", &mut e_t),
                CurveTarget::Capture => ("p_stick", &mut probability),
            };
            *corrected = match correction.on() {
                CurveTarget::Capture => {
                    match correction.acts() {
                        Operation::Add => shift += value,
                        Operation::Factor => factor *= 1.0 + value,
                        Operation::Times => factor *= value,
                        Operation::Set => (capture, factor, shift) = (value, 1.0, 0.0),
                    }
                    shifted_probability(capture, factor, shift)
                }
                _ => correction.acts().apply(*corrected, value),
            };
            trace(term.kind().id, quantity, *corrected);
        }
        if e_n < 0.0 && e_n != plain.restitution[0] {
            e_n = 0.0;
            trace("correction", "e_n", e_n);
        }
        Corrected { restitution: [e_n, e_t], probability }
    }

    /// Share of `e_n` [1] that full stickiness of the particle takes: all of it by a capture criterion.
    pub(super) fn rebound_loss(&self) -> f64 {
        let by_criterion = if self.stickiness.is_some() { 1.0 } else { 0.0 };
        self.terms.iter().map(|term| term.effect().rebound_loss()).fold(by_criterion, f64::max)
    }
}

impl<'m, U: Fn(u64) -> f64, W: Watcher<'m>> GeneralWall<'m, '_, U, W> {
    /// Traces the built-in groups on which corrections depend.
    fn show_groups(&mut self, of: &ImpactOnWall<'_>) {
        for term in &self.model.terms {
            for input in term.corrected_by() {
                let group = match input {
                    CurveInput::Group(place) => GROUPS.get(place),
                    _ => None,
                };
                if let Some(group) = group {
                    self.watcher.trace(term.kind().id, group.name, group.value(of));
                }
            }
        }
    }
}

/// The place that an impact meets.
fn place_met(wall: &Wall, arriving: &Impact, uniform: &impl Fn(u64) -> f64) -> WallPlace {
    if arriving.coverage == 0.0 || !wall.is_patchwork(arriving) {
        WallPlace::Anywhere
    } else if uniform(stream::COVER) < 1.0 - arriving.coverage {
        WallPlace::Bare
    } else {
        WallPlace::Covered
    }
}

impl<'m, U: Fn(u64) -> f64, W: Watcher<'m>> WallSteps for GeneralWall<'m, '_, U, W> {
    type Fault = ImpactError;

    fn outside_range(&mut self, arriving: &Impact) -> bool {
        if !W::JUDGES_RANGE {
            return false;
        }
        let Self { model, wall, place, watcher, .. } = self;
        let mut any = false;
        model.beyond_before(wall, *place, arriving, &mut |beyond| {
            any = true;
            watcher.beyond(beyond);
        });
        any
    }

    fn turn(&mut self, impact: &mut Impact) {
        let tilt = |term: &Term| term.effect().tilt(impact, term.chance(self.uniform));
        self.frame = TiltedFrame { tilt: self.model.terms.iter().map(tilt).sum() };
        self.frame.turn(impact);
    }

    fn contact(&mut self, impact: &Impact) -> Result<Contact, ImpactError> {
        let contact = self.model.contact(self.wall, impact, self.place, self.uniform)?;
        self.contact = contact;
        self.on_melt = match contact.melt {
            Some(_) => self.model.terms.iter().find_map(|term| term.effect().on_melt(impact, &contact)),
            None => None,
        };
        if let Some(held @ (OnMelt::Sinks | OnMelt::Held)) = self.on_melt {
            self.trace("melt", "submerged", f64::from(held == OnMelt::Sinks));
        }
        self.droplet_rebound = self.model.droplet_rebound(self.wall, impact, self.place)?;
        Ok(contact)
    }

    fn stickiness(&mut self, impact: &Impact) -> Result<Stickiness, ImpactError> {
        let mut trace = |term, quantity, value| self.watcher.trace(term, quantity, value);
        let mut particle = self.model.particle_stickiness(impact, &mut trace)?;
        if let Some(criterion) = self.model.stickiness.as_ref().filter(|_| W::SHOWS) {
            let ends = criterion.in_flight_band(impact);
            for (quantity, end) in BAND.into_iter().zip(ends.into_iter().flatten()) {
                self.watcher.trace(criterion.name(), quantity, end);
            }
        }
        if self.droplet_rebound.is_some() {
            self.watcher.trace("droplet rebound", "particle stickiness", 0.0);
            particle = 0.0;
        }
        let wall = match self.place {
            WallPlace::Covered => 0.0,
            WallPlace::Anywhere | WallPlace::Bare => self.model.wall_stickiness(self.wall, impact),
        };
        Ok(Stickiness { particle, wall })
    }

    fn normal_law(&mut self, impact: &Impact, contact: &Contact, _: f64) -> NormalRebound {
        if let Some(OnMelt::Rebounds(e_n)) = self.on_melt {
            self.watcher.trace("melt", "e_n", e_n);
            return NormalRebound { restitution: e_n, held: false };
        }
        if let Some(e_n) = self.droplet_rebound {
            self.watcher.trace("droplet rebound", "e_n", e_n);
            return NormalRebound { restitution: e_n, held: false };
        }
        let law = self.model.normal;
        self.left_range = W::JUDGES_RANGE && !law.holds_for(contact, impact);
        let e_n = law.rebound(contact, impact);
        self.watcher.trace(law.name(), "e_n", e_n.unwrap_or(0.0));
        NormalRebound::of(e_n)
    }

    fn normal_effects(
        &mut self,
        impact: &Impact,
        contact: &Contact,
        rebound: NormalRebound,
    ) -> NormalRebound {
        let NormalRebound { restitution: mut e_n, held } = rebound;
        if held {
            return rebound;
        }
        for term in &self.model.terms {
            let chance = term.chance(self.uniform);
            let changed = term.effect().normal_restitution(impact, contact, e_n, chance);
            if changed != Some(e_n) {
                self.watcher.trace(term.kind().id, "e_n", changed.unwrap_or(0.0));
            }
            let Some(changed) = changed else { return NormalRebound::of(None) };
            e_n = changed;
        }
        NormalRebound::of(Some(e_n))
    }

    fn draw(&mut self) -> f64 {
        (self.uniform)(stream::CAPTURE)
    }

    fn rebound_loss(&self) -> f64 {
        self.model.rebound_loss()
    }

    fn tangential_law(&mut self, kinematics: &ImpactKinematics) -> Rebound {
        let law = self.model.tangential;
        let rebound = law.rebound(kinematics);
        self.watcher.trace(law.name(), "e_t", rebound.restitution);
        rebound
    }

    fn tangential_effects(&mut self, kinematics: &ImpactKinematics, mut rebound: Rebound) -> Rebound {
        for term in &self.model.terms {
            let changed = term.effect().tangential(kinematics, rebound);
            if changed != rebound {
                self.watcher.trace(term.kind().id, "e_t", changed.restitution);
            }
            rebound = changed;
        }
        rebound
    }

    fn energy_bound(&mut self, kinematics: &ImpactKinematics, rebound: Rebound) -> f64 {
        if !self.model.adds_energy {
            return kinematics.normal_restitution;
        }
        let e_n = energy_bound::bounded(kinematics, rebound);
        if e_n != kinematics.normal_restitution {
            self.trace("energy bound", "e_n", e_n);
        }
        e_n
    }

    fn turn_back(&self, impact: &Impact, e_n: f64, rebound: Rebound) -> (f64, Rebound) {
        let [e_n, e_t] = self.frame.turn_back(self.arriving, impact, [e_n, rebound.restitution]);
        (e_n, Rebound { restitution: e_t, spin: self.frame.spin_back(self.arriving, rebound.spin) })
    }

    /// A droplet's capture does not depend on the wall.
    fn capture_probability(&mut self, impact: &Impact, stickiness: Stickiness) -> f64 {
        let model = self.model;
        let mut found = |beyond| self.watcher.beyond(beyond);
        let droplet = |t| model.stickiness.as_ref().is_some_and(|criterion| criterion.is_droplet(t));
        if droplet(impact.particle_temperature) {
            if self.left_range {
                beyond::of_normal_law(model.normal, &self.contact, impact, &mut found);
            }
            return stickiness.particle;
        }
        let place = OnBareWall {
            rebounds_from_melt: matches!(self.on_melt, Some(OnMelt::Rebounds(_))),
            dry: self.on_melt.is_none(),
            contact_law: model.normal.is_contact_law(),
        };
        let law_left = self.left_range;
        let probability;
        (probability, self.left_range) =
            place.capture_probability(model.capture.combination, stickiness, law_left);
        if !W::JUDGES_RANGE {
            self.left_range = false;
            return probability;
        }
        let [law, dry_contact] = place.ranges_left(stickiness, probability, law_left);
        if law {
            beyond::of_normal_law(model.normal, &self.contact, impact, &mut found);
        }
        if dry_contact {
            beyond::of_dry_contact(model.normal, stickiness.wall, &mut found);
        }
        probability
    }

    fn correct(&mut self, plain: Corrected) -> Corrected {
        let Self { model, wall, reaching, .. } = *self;
        let [normal_restitution, _] = plain.restitution;
        let of = ImpactOnWall { model, wall, impact: reaching, normal_restitution };
        self.watcher.before_corrections(normal_restitution);
        if W::SHOWS {
            self.show_groups(&of);
        }
        if model.has_group_ranges {
            model.beyond_groups(&of, &mut |beyond| {
                self.left_range = true;
                self.watcher.beyond(beyond);
            });
        }
        let mut trace = |term, quantity, value| self.watcher.trace(term, quantity, value);
        model.corrected(&of, plain, &mut trace)
    }

    fn left_range(&self) -> bool {
        self.left_range
    }

    fn trace(&mut self, term: &'static str, quantity: &'static str, value: f64) {
        self.watcher.trace(term, quantity, value);
    }
}
