//! Blocks of impacts on a [`PreparedWall`]: each set of steps is a loop without branches over columns.
//!
//! A law is matched outside its loop ([`with_normal`], [`with_tangential`]) and is then a constant
//! within it. Matching through the reference matters: of a local copy the compiler makes one enum
//! again, whose variant every impact would have to ask for. The grouping of the steps is the
//! fastest measured: steps that divide stand beside steps that do not.

use std::sync::Arc;

use fearless_simd::{Level, dispatch};

use super::evaluation::{ImpactState, NormalRebound, StepSet, both_shares, evaluate};
use super::prepared_wall::{
    PreparedImpact, PreparedWall, SolidProperties, Surfaces, VaryingContact, WallConstants, mechanical,
    within,
};
use crate::capture::{MeltStates, WallState};
use crate::effect::stream;
use crate::impact::{BLOCK, Block, Impact, Outcomes};
use crate::material::Mechanical;
use crate::normal::{Contact, NormalLaw};
use crate::rng::ImpactRng;
use crate::tangential::TangentialLaw;

/// The steps after the normal rebound.
const AFTER_NORMAL: StepSet = StepSet::REBOUND.union(StepSet::RANGE).union(StepSet::STICKINESS);

/// A column of numbers.
type Reals = [f64; BLOCK];

/// A column of words as wide as its numbers: 1 for yes, 0 for no.
type Flags = [u64; BLOCK];

/// Room for the steps between the loops over a block. One serves any number of blocks.
#[derive(Debug, Clone, Default)]
pub struct Workspace {
    steps: StepColumns,
    /// `None` until a wall needs it.
    contacts: Option<ContactColumns>,
}

/// What the steps keep between two loops.
#[derive(Debug, Clone)]
struct StepColumns {
    /// Stickiness of the particle.
    stickiness: Reals,
    adhesion: Reals,
    restitution: Reals,
    held: Flags,
    left_range: Flags,
    /// Random number of the capture.
    chance: Reals,
}

/// What a contact that differs between impacts depends on.
#[derive(Debug, Clone)]
struct ContactColumns {
    /// Char, ash, bare wall, powder.
    solids: [SolidColumns; 4],
    /// Whose constant properties `solids` holds.
    constants_of: Option<Arc<VaryingContact>>,
    flight: MeltStates,
    slag: MeltStates,
    coverage: Reals,
    /// Whether the impact meets the covered share.
    covered: Flags,
    density: Reals,
    /// [`Surfaces::on_melt`].
    slag_rebound: Reals,
    /// [`PreparedImpact::on_melt`].
    on_melt: Reals,
    /// Reduced modulus, work of adhesion, yield strength, stiffness ratio.
    contact: [Reals; 4],
}

/// The properties of a solid at the temperatures of a block, in the order of [`Mechanical`].
#[derive(Debug, Clone)]
struct SolidColumns([Reals; 6]);

impl Default for StepColumns {
    fn default() -> Self {
        let (reals, flags) = ([0.0; BLOCK], [0; BLOCK]);
        let (held, left_range) = (flags, flags);
        Self { stickiness: reals, adhesion: reals, restitution: reals, held, left_range, chance: reals }
    }
}

impl Default for ContactColumns {
    fn default() -> Self {
        let reals = [0.0; BLOCK];
        Self {
            solids: std::array::from_fn(|_| SolidColumns([reals; 6])),
            constants_of: None,
            flight: MeltStates::default(),
            slag: MeltStates::default(),
            coverage: reals,
            covered: [0; BLOCK],
            density: reals,
            slag_rebound: reals,
            on_melt: reals,
            contact: [reals; 4],
        }
    }
}

/// Evaluates an expression once for each variant, with the constants of a wall in which the compiler knows the variant.
macro_rules! in_variants {
    ($of:expr, $wall:ident => $body:expr; $on:expr; $($variant:pat => { $($field:ident: $value:expr),* })+) => {
        match $on {
            $($variant => {
                let $wall = &WallConstants { $($field: $value,)* ..*$of };
                $body
            })+
        }
    };
}

/// Evaluates an expression with the constants of a wall in which the compiler knows the normal law.
macro_rules! with_normal {
    ($of:expr, $wall:ident => $body:expr) => {
        in_variants! { $of, $wall => $body; $of.normal;
            NormalLaw::ThorntonNing => { normal: NormalLaw::ThorntonNing }
            NormalLaw::Constant { restitution } => { normal: NormalLaw::Constant { restitution } }
            law @ (NormalLaw::PlasticJkr | NormalLaw::Listed { .. }) => { normal: law }
        }
    };
}

/// As [`with_normal`], for the tangential law.
macro_rules! with_tangential {
    ($of:expr, $wall:ident => $body:expr) => {
        in_variants! { $of, $wall => $body; $of.tangential;
            TangentialLaw::Constant { restitution } => { tangential: TangentialLaw::Constant { restitution } }
            TangentialLaw::Sliding { friction } => { tangential: TangentialLaw::Sliding { friction } }
            TangentialLaw::SlidingRolling { friction } => { tangential: TangentialLaw::SlidingRolling { friction } }
            law @ TangentialLaw::Listed { .. } => { tangential: law }
        }
    };
}

/// As [`with_normal`], for what decides the work of adhesion of the contact: a wall without ash
/// does not mix, a known work is not computed again.
macro_rules! with_works {
    ($of:expr, $wall:ident => $body:expr) => {
        in_variants! { $of, $wall => $body; ($of.has_ash, $of.works);
            (true, Some(works)) => { has_ash: true, works: Some(works) }
            (false, Some(works)) => { has_ash: false, works: Some(works) }
            (true, None) => { has_ash: true, works: None }
            (false, None) => { has_ash: false, works: None }
        }
    };
}

/// What the loops over a block share; `CONSTANT` where the contact is the same for all impacts.
struct Loops<'a, const CONSTANT: bool> {
    wall: &'a WallConstants,
    block: &'a Block,
    seed: u64,
}

impl PreparedWall {
    /// Whether [`Self::resolve_block`] decides a block.
    pub fn decides_block(&self, block: &Block) -> bool {
        let all_within = |input: usize, range| {
            let column = &block.inputs[input][..block.length.min(BLOCK)];
            column.iter().fold(true, |all, value| all & within(*value, range))
        };
        let known = || {
            all_within(Impact::PARTICLE_TEMPERATURE, self.known.particle)
                && all_within(Impact::WALL_TEMPERATURE, self.known.wall)
        };
        all_within(Impact::MELT_THICKNESS, [0.0, 0.0])
            && (self.varying.is_none() || (known() && all_within(Impact::TEMPERATURE_UNDER, [0.0, 0.0])))
    }

    /// Decides a block of impacts that have been checked and that [`Self::decides_block`], with the
    /// instructions of `level`.
    pub fn resolve_block(
        &self,
        block: &Block,
        seed: u64,
        outcomes: &mut Outcomes,
        workspace: &mut Workspace,
        level: Level,
    ) {
        let wall = &self.constants;
        let steps = &mut workspace.steps;
        if let Some(varying) = &self.varying {
            let columns = workspace.contacts.get_or_insert_default();
            if let Some(criterion) = &varying.in_flight {
                criterion.in_flight_each(level, block, &mut columns.flight);
            }
            if let Some(slag) = &varying.slag {
                slag.on_wall_each(level, block, &mut columns.slag);
            }
            columns.keep_constants(varying);
            let loops = Loops::<false> { wall, block, seed };
            dispatch!(level, _simd => loops.vary(varying, steps, columns, outcomes));
        } else {
            let loops = Loops::<true> { wall, block, seed };
            dispatch!(level, _simd => loops.all(steps, outcomes));
        }
        for &(input, range) in &self.valid {
            for i in 0..block.length.min(BLOCK) {
                outcomes.outside_range[i] |= u32::from(!within(block.inputs[input][i], range));
            }
        }
    }
}

impl ContactColumns {
    /// Fills the columns of the constant properties, unless the last block had the same.
    fn keep_constants(&mut self, contact: &Arc<VaryingContact>) {
        if self.constants_of.as_ref().is_some_and(|of| Arc::ptr_eq(of, contact)) {
            return;
        }
        for (columns, solid) in self.solids.iter_mut().zip(&contact.solids) {
            columns.0.iter_mut().zip(solid.constant).for_each(|(column, value)| column.fill(value));
        }
        self.constants_of = Some(Arc::clone(contact));
    }

    /// The state of particle and wall in the impact `i`, of a particle of this stickiness [1].
    #[inline(always)]
    fn surfaces(&self, i: usize, fitted: [bool; 2], stickiness: f64) -> Surfaces {
        let [char, ash, ..] = &self.solids;
        Surfaces {
            particle: [char.at(i, fitted[0]), ash.at(i, fitted[1])],
            density: self.density[i],
            stickiness,
            flight_holds: self.flight.holds[i] == 1,
            slag: WallState {
                stickiness: self.slag.stickiness[i],
                viscosity: self.slag.viscosity[i],
                holds: self.slag.holds[i] == 1,
            },
            on_melt: self.slag_rebound[i],
        }
    }

    /// The contact of the impact `i`.
    #[inline(always)]
    fn contact(&self, i: usize, yield_ratio: f64) -> Contact {
        let [reduced_modulus, work_of_adhesion, yield_strength, stiffness_ratio] =
            self.contact.each_ref().map(|column| column[i]);
        let density = self.density[i];
        Contact {
            density,
            reduced_modulus,
            work_of_adhesion,
            yield_strength,
            yield_ratio,
            stiffness_ratio,
            melt: None,
        }
    }
}

impl SolidColumns {
    /// These properties of an impact, or where `covered` is 1 those of `powder`. Both are read, so
    /// that this is no choice of addresses, for which there is no vector instruction.
    #[inline(always)]
    fn or(&self, powder: &Self, index: usize, covered: u64) -> Mechanical {
        let mask = covered.wrapping_neg();
        let pick = |bare: f64, powder: f64| f64::from_bits(bare.to_bits() & !mask | powder.to_bits() & mask);
        let place = |place: usize| pick(self.0[place][index], powder.0[place][index]);
        // No contact depends on the density and the fitted work of adhesion of what is hit.
        mechanical([0.0, place(1), place(2), place(3), place(4), 0.0], false)
    }

    #[inline(always)]
    fn at(&self, index: usize, fitted: bool) -> Mechanical {
        mechanical(self.0.each_ref().map(|column| column[index]), fitted)
    }

    /// Sets the properties that depend on temperature.
    #[inline(always)]
    fn fill(&mut self, solid: &SolidProperties, temperatures: &[f64]) {
        for (column, varying) in self.0.iter_mut().zip(&solid.varying) {
            if let Some(property) = varying {
                property.within_range_each(temperatures, &mut column[..temperatures.len()]);
            }
        }
    }
}

impl Loops<'_, true> {
    #[inline(always)]
    fn all(&self, steps: &mut StepColumns, outcomes: &mut Outcomes) {
        self.stickiness(None, steps);
        self.normal(steps, None);
        self.rebound(steps, None, outcomes);
    }
}

impl Loops<'_, false> {
    #[inline(always)]
    fn vary(
        &self,
        varying: &VaryingContact,
        steps: &mut StepColumns,
        columns: &mut ContactColumns,
        outcomes: &mut Outcomes,
    ) {
        let [particle, wall] = [Impact::PARTICLE_TEMPERATURE, Impact::WALL_TEMPERATURE]
            .map(|input| &self.block.inputs[input][..self.length()]);
        for ((solid, temperatures), columns) in
            varying.solids.iter().zip([particle, particle, wall, wall]).zip(&mut columns.solids)
        {
            columns.fill(solid, temperatures);
        }
        self.stickiness(varying.in_flight.is_some().then_some(&columns.flight.stickiness), steps);
        self.cover(&mut columns.coverage);
        let drawn =
            self.wall.patchwork && columns.coverage[..self.length()].iter().any(|coverage| *coverage > 0.0);
        self.draw_place(drawn, columns);
        self.density(columns);
        self.on_melt(columns);
        self.contact::<true>(steps, columns);
        self.normal(steps, Some(columns));
        self.rebound(steps, Some(columns), outcomes);
        if drawn {
            columns.covered[..self.length()].iter_mut().for_each(|covered| *covered ^= 1);
            self.contact::<false>(steps, columns);
            self.other(steps, columns, outcomes);
        }
    }

    /// The covered share of the wall that each impact meets.
    #[inline(always)]
    fn cover(&self, coverage: &mut Reals) {
        let layers = &self.block.inputs[Impact::LAYER_THICKNESS][..self.length()];
        if self.wall.covering.layer_thickness == 0.0 && layers.iter().all(|thickness| *thickness == 0.0) {
            for (covered, given) in coverage.iter_mut().zip(&self.block.inputs[Impact::COVERAGE]) {
                *covered = self.wall.covering.coverage.max(*given);
            }
        } else {
            for (i, covered) in coverage.iter_mut().enumerate().take(self.length()) {
                *covered = self.wall.coverage(&self.block.inputs_of(i));
            }
        }
    }

    /// Draws the place that each impact meets.
    #[inline(always)]
    fn draw_place(&self, drawn: bool, columns: &mut ContactColumns) {
        columns.covered[..self.length()].fill(0);
        if drawn {
            for i in 0..self.length() {
                let uniform = ImpactRng::new(self.seed, self.block.keys[i]).uniform(stream::COVER);
                columns.covered[i] = u64::from(uniform >= 1.0 - columns.coverage[i]);
            }
        }
    }

    /// Density of the particles.
    #[inline(always)]
    fn density(&self, columns: &mut ContactColumns) {
        let given = &self.block.inputs[Impact::PARTICLE_DENSITY];
        let [char, ash, ..] = &columns.solids;
        let (char, ash) = (&char.0[0], &ash.0[0]);
        let conversion = &self.block.inputs[Impact::CONVERSION];
        for i in 0..self.length() {
            let mixed =
                if self.wall.has_ash { char[i] + (ash[i] - char[i]) * conversion[i] } else { char[i] };
            columns.density[i] = if given[i] > 0.0 { given[i] } else { mixed };
        }
    }

    /// What the slag does to dry particles.
    #[inline(always)]
    fn on_melt(&self, columns: &mut ContactColumns) {
        let length = self.length();
        let Some(on_melt) = self.wall.on_melt else { return columns.slag_rebound[..length].fill(f64::NAN) };
        let wall = WallConstants { on_melt: Some(on_melt), ..*self.wall };
        for i in 0..length {
            let melt = [columns.slag.viscosity[i], wall.surface_tension];
            columns.slag_rebound[i] =
                wall.rebound_on_melt(&self.block.inputs_of(i), columns.density[i], melt);
        }
    }

    /// The contact; the stiffness ratio only where it is asked for.
    #[inline(always)]
    fn contact<const STIFFNESS: bool>(&self, steps: &StepColumns, columns: &mut ContactColumns) {
        with_works!(self.wall, wall => for i in 0..self.length() {
            let (state, on_melt, _) = self.run(i, StepSet::CONTACT, wall, steps, Some(&*columns));
            let Contact { reduced_modulus, work_of_adhesion, yield_strength, stiffness_ratio, .. } =
                state.contact;
            let [a, b, c, d] = &mut columns.contact;
            (a[i], b[i], c[i]) = (reduced_modulus, work_of_adhesion, yield_strength);
            if STIFFNESS {
                d[i] = stiffness_ratio;
            }
            columns.on_melt[i] = on_melt;
        });
    }

    /// Probability of capture and range of both shares, with those of the place that the impact does not meet.
    #[inline(always)]
    fn other(&self, steps: &StepColumns, columns: &ContactColumns, outcomes: &mut Outcomes) {
        with_normal!(self.wall, wall => in_variants! {
            wall, wall => self.other_with(wall, steps, columns, outcomes); wall.tangential;
            law @ TangentialLaw::Listed { .. } => { tangential: law }
            // Only a law by name has a range; no rebound is asked for.
            _ => { tangential: TangentialLaw::Constant { restitution: 0.0 } }
        });
    }

    #[inline(always)]
    fn other_with(
        &self,
        wall: &WallConstants,
        steps: &StepColumns,
        columns: &ContactColumns,
        outcomes: &mut Outcomes,
    ) {
        let selected = StepSet::ADHESION.union(StepSet::NORMAL).union(AFTER_NORMAL);
        for i in 0..self.length() {
            let (state, ..) = self.run(i, selected, wall, steps, Some(columns));
            let coverage = columns.coverage[i];
            let share = if columns.covered[i] == 1 { coverage } else { 1.0 - coverage };
            let met = outcomes.sticking_probability[i];
            let both = both_shares(share, met, state.probability);
            outcomes.sticking_probability[i] = if share == 0.0 { met } else { both };
            outcomes.outside_range[i] |= u32::from(state.outside_range) & u32::from(share != 0.0);
        }
    }
}

impl<const CONSTANT: bool> Loops<'_, CONSTANT> {
    #[inline(always)]
    fn length(&self) -> usize {
        self.block.length.min(BLOCK)
    }

    /// Stickiness of the particles: the product of the criterion's, where there is one, and the transitions'.
    #[inline(always)]
    fn stickiness(&self, criterion: Option<&Reals>, steps: &mut StepColumns) {
        let stickiness = &mut steps.stickiness[..self.length()];
        match criterion {
            Some(criterion) => stickiness.copy_from_slice(&criterion[..self.length()]),
            None => stickiness.fill(0.0),
        }
        let mut product = criterion.is_some();
        for one in self.wall.transitions.into_iter().flatten() {
            for (before, value) in stickiness.iter_mut().zip(&self.block.inputs[one.input()]) {
                let stickiness = one.at_value(*value);
                *before = if product { *before * stickiness } else { stickiness };
            }
            product = true;
        }
    }

    /// The normal rebound and the draw of the capture.
    #[inline(always)]
    fn normal(&self, steps: &mut StepColumns, columns: Option<&ContactColumns>) {
        with_normal!(self.wall, wall => {
            if matches!(wall.normal, NormalLaw::ThorntonNing) {
                for i in 0..self.length() {
                    steps.adhesion[i] = self.run(i, StepSet::ADHESION, wall, steps, columns).0.adhesion;
                }
            }
            in_variants! { wall, wall => self.normal_with(wall, steps, columns); wall.draws;
                true => { draws: true }
                false => { draws: false }
            }
        });
    }

    #[inline(always)]
    fn normal_with(&self, wall: &WallConstants, steps: &mut StepColumns, columns: Option<&ContactColumns>) {
        for i in 0..self.length() {
            let selected = StepSet::NORMAL.union(StepSet::DRAW);
            let (state, _, left_range) = self.run(i, selected, wall, steps, columns);
            steps.restitution[i] = state.normal.restitution;
            steps.held[i] = u64::from(state.normal.held);
            steps.left_range[i] = u64::from(left_range);
            steps.chance[i] = state.chance;
        }
    }

    /// The steps after the normal rebound, at the place that the impact meets.
    #[inline(always)]
    fn rebound(&self, steps: &StepColumns, columns: Option<&ContactColumns>, outcomes: &mut Outcomes) {
        with_tangential!(self.wall, wall => for i in 0..self.length() {
            let (state, ..) = self.run(i, AFTER_NORMAL, wall, steps, columns);
            outcomes.normal_restitution[i] = state.normal_restitution;
            outcomes.tangential_restitution[i] = state.rebound.restitution;
            outcomes.sticking_probability[i] = state.probability;
            outcomes.spin[i] = state.rebound.spin;
            outcomes.stuck[i] = u32::from(state.captured);
            outcomes.outside_range[i] = u32::from(state.outside_range);
            let [particle, wall] = [state.sticky.is_particle_sticky(), state.sticky.is_wall_sticky()];
            outcomes.regime[i] = 2 * u32::from(particle) + u32::from(wall);
        });
    }

    /// Runs the steps of `selected` on the impact `i`, from what the columns hold; `columns` where
    /// the contact is not constant. With the state, what the melt leaves a dry particle and whether
    /// the normal law was left.
    #[inline(always)]
    fn run(
        &self,
        i: usize,
        selected: StepSet,
        wall: &WallConstants,
        steps: &StepColumns,
        columns: Option<&ContactColumns>,
    ) -> (ImpactState, f64, bool) {
        let impact = self.block.inputs_of(i);
        let stickiness = steps.stickiness[i];
        let (surfaces, covered, partner, on_melt) = match columns {
            None => (wall.dry_surfaces(&impact, stickiness), false, Mechanical::default(), f64::NAN),
            Some(columns) => {
                let ([.., bare, powder], covered) = (&columns.solids, columns.covered[i]);
                let surfaces = columns.surfaces(i, wall.fitted, stickiness);
                (surfaces, covered == 1, bare.or(powder, i, covered), columns.on_melt[i])
            }
        };
        let contact = match columns {
            None => Contact { density: surfaces.density, ..wall.contact },
            Some(columns) => columns.contact(i, wall.adhesion.yield_ratio),
        };
        let mut state = ImpactState {
            impact,
            contact,
            adhesion: steps.adhesion[i],
            normal: NormalRebound { restitution: steps.restitution[i], held: steps.held[i] == 1 },
            chance: steps.chance[i],
            ..ImpactState::default()
        };
        let mut prepared = PreparedImpact::<CONSTANT> {
            wall,
            surfaces: &surfaces,
            covered,
            partner,
            on_melt,
            left_range: steps.left_range[i] == 1,
            rng: ImpactRng::new(self.seed, self.block.keys[i]),
        };
        let Ok(()) = evaluate(&mut prepared, selected, &mut state);
        (state, prepared.on_melt, prepared.left_range)
    }
}
