//! Blocks of impacts on a [`VaryingWall`]: each set of steps is a loop without branches over columns.

use std::sync::Arc;

use fearless_simd::{Level, dispatch};

use super::block::{BLOCK, Block, Outcomes};
use super::evaluation::{ImpactState, NormalRebound, StepSet, both_shares, evaluate};
use super::prepared_wall::{Tangential, within};
use super::varying_wall::{Constants, Met, Solid, VaryingImpact, VaryingWall, mechanical};
use super::wall::Wall;
use crate::capture::{MeltStates, Stickiness, WallState};
use crate::effect::stream;
use crate::impact::Impact;
use crate::material::Mechanical;
use crate::normal::Contact;
use crate::rng::ImpactRng;

/// The steps after the normal rebound.
const LAST: StepSet = StepSet::REBOUND.union(StepSet::RANGE).union(StepSet::STICKINESS).union(StepSet::DRAW);

/// The properties of a solid at the temperatures of a block, as columns in the order of [`Mechanical`].
#[derive(Debug, Clone)]
struct SolidColumns([[f64; BLOCK]; 6]);

/// What the steps of a block keep between two loops, as columns.
#[derive(Debug, Clone)]
pub(super) struct Columns {
    /// Char, ash, bare wall, powder.
    solids: [SolidColumns; 4],
    /// Whose constant properties `solids` holds.
    constants_of: Option<Arc<[Solid; 4]>>,
    flight: MeltStates,
    slag: MeltStates,
    coverage: [f64; BLOCK],
    /// Stickiness of the particle.
    particle: [f64; BLOCK],
    /// 1 where the impact meets the covered share, else 0.
    covered: [u64; BLOCK],
    /// Random number of the capture.
    chance: [f64; BLOCK],
    density: [f64; BLOCK],
    /// [`Met::on_melt`].
    slag_rebound: [f64; BLOCK],
    /// Reduced modulus, work of adhesion, yield strength, stiffness ratio.
    contact: [[f64; BLOCK]; 4],
    on_melt: [f64; BLOCK],
    restitution: [f64; BLOCK],
    held: [u64; BLOCK],
    left_range: [u64; BLOCK],
}

impl Default for Columns {
    fn default() -> Self {
        let solid = || SolidColumns([[0.0; BLOCK]; 6]);
        Self {
            solids: std::array::from_fn(|_| solid()),
            constants_of: None,
            flight: MeltStates::default(),
            slag: MeltStates::default(),
            coverage: [0.0; BLOCK],
            particle: [0.0; BLOCK],
            covered: [0; BLOCK],
            chance: [0.0; BLOCK],
            density: [0.0; BLOCK],
            slag_rebound: [0.0; BLOCK],
            contact: [[0.0; BLOCK]; 4],
            on_melt: [0.0; BLOCK],
            restitution: [0.0; BLOCK],
            held: [0; BLOCK],
            left_range: [0; BLOCK],
        }
    }
}

/// What the loops over a block share.
struct Loops<'a> {
    wall: &'a Constants,
    block: &'a Block,
}

impl VaryingWall {
    /// Whether [`Self::resolve_block`] decides a block.
    pub fn decides_block(&self, block: &Block) -> bool {
        let all_within = |input: usize, range| {
            let column = &block.inputs[input][..block.length.min(BLOCK)];
            column.iter().fold(true, |all, value| all & within(*value, range))
        };
        !self.one_by_one
            && all_within(Impact::PARTICLE_TEMPERATURE, self.known.particle)
            && all_within(Impact::WALL_TEMPERATURE, self.known.wall)
            && all_within(Impact::MELT_THICKNESS, [0.0, 0.0])
    }

    /// Decides a block of impacts that have been checked and that [`Self::decides_block`], with the instructions of `level`.
    pub fn resolve_block(
        &self,
        wall: &Wall,
        block: &Block,
        seed: u64,
        outcomes: &mut Outcomes,
        columns: &mut Columns,
        level: Level,
    ) {
        if let Some(criterion) = &self.in_flight {
            criterion.in_flight_each(level, block, &mut columns.flight);
        }
        if let Some(slag) = &self.slag {
            slag.on_wall_each(level, block, &mut columns.slag);
        }
        cover(wall, block, &mut columns.coverage);
        dispatch!(level, _simd => self.loops(block, seed, columns, outcomes));
    }

    #[inline(always)]
    fn loops(&self, block: &Block, seed: u64, columns: &mut Columns, outcomes: &mut Outcomes) {
        let length = block.length.min(BLOCK);
        let [particle, wall] = [Impact::PARTICLE_TEMPERATURE, Impact::WALL_TEMPERATURE]
            .map(|input| &block.inputs[input][..length]);
        columns.keep_constants(&self.solids);
        for ((solid, temperatures), columns) in
            self.solids.iter().zip([particle, particle, wall, wall]).zip(&mut columns.solids)
        {
            columns.fill(solid, temperatures);
        }
        let loops = Loops { wall: &self.constants, block };
        loops.stickiness(self.in_flight.is_some(), columns);
        let drawn = self.patchwork && columns.coverage[..length].iter().any(|coverage| *coverage > 0.0);
        draw(block, seed, drawn, columns);
        loops.density(columns);
        loops.on_melt(columns);
        loops.contact::<true>(columns);
        loops.normal(columns);
        loops.rebound(columns, outcomes);
        if drawn {
            (0..length).for_each(|i| columns.covered[i] ^= 1);
            loops.contact::<false>(columns);
            loops.other(columns, outcomes);
        }
        for &(input, range) in &self.valid {
            for i in 0..length {
                outcomes.outside_range[i] |= u32::from(!within(block.inputs[input][i], range));
            }
        }
    }
}

/// The covered share of the wall that each impact meets.
fn cover(wall: &Wall, block: &Block, coverage: &mut [f64; BLOCK]) {
    let length = block.length.min(BLOCK);
    let no_layer = wall.layer_thickness == 0.0
        && block.inputs[Impact::LAYER_THICKNESS][..length].iter().all(|thickness| *thickness == 0.0);
    let given = &block.inputs[Impact::COVERAGE];
    for i in 0..length {
        coverage[i] = if no_layer {
            wall.coverage.max(given[i])
        } else {
            let mut impact = Impact {
                coverage: given[i],
                layer_thickness: block.inputs[Impact::LAYER_THICKNESS][i],
                diameter: block.inputs[Impact::DIAMETER][i],
                ..Impact::default()
            };
            wall.apply_deposit(&mut impact);
            impact.coverage
        };
    }
}

/// Draws the capture, and where a share is covered the place.
#[inline(always)]
fn draw(block: &Block, seed: u64, drawn: bool, columns: &mut Columns) {
    let length = block.length.min(BLOCK);
    for i in 0..length {
        columns.chance[i] = ImpactRng::new(seed, block.keys[i]).uniform(stream::CAPTURE);
    }
    columns.covered[..length].fill(0);
    if drawn {
        for i in 0..length {
            let uniform = ImpactRng::new(seed, block.keys[i]).uniform(stream::COVER);
            columns.covered[i] = u64::from(uniform >= 1.0 - columns.coverage[i]);
        }
    }
}

impl Columns {
    /// Fills the columns of the constant properties, unless the last block had the same.
    fn keep_constants(&mut self, solids: &Arc<[Solid; 4]>) {
        if self.constants_of.as_ref().is_some_and(|of| Arc::ptr_eq(of, solids)) {
            return;
        }
        for (columns, solid) in self.solids.iter_mut().zip(solids.iter()) {
            columns.0.iter_mut().zip(solid.constant).for_each(|(column, value)| column.fill(value));
        }
        self.constants_of = Some(Arc::clone(solids));
    }
}

impl SolidColumns {
    /// These properties of an impact, or where `covered` is 1 those of `powder`. Both are read: a choice of addresses would be no vector.
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
    fn fill(&mut self, solid: &Solid, temperatures: &[f64]) {
        for (column, varying) in self.0.iter_mut().zip(&solid.varying) {
            if let Some(property) = varying {
                property.within_range_each(temperatures, &mut column[..temperatures.len()]);
            }
        }
    }
}

impl Loops<'_> {
    #[inline(always)]
    fn length(&self) -> usize {
        self.block.length.min(BLOCK)
    }

    /// Stickiness of the particles: the product of the criterion's and the transitions'.
    #[inline(always)]
    fn stickiness(&self, criterion: bool, columns: &mut Columns) {
        let length = self.length();
        let mut product = criterion;
        if criterion {
            columns.particle[..length].copy_from_slice(&columns.flight.stickiness[..length]);
        } else {
            columns.particle[..length].fill(0.0);
        }
        for one in self.wall.transitions.each().into_iter().flatten() {
            let values = &self.block.inputs[one.input()];
            for (before, value) in columns.particle[..length].iter_mut().zip(values) {
                let stickiness = one.at_value(*value);
                *before = if product { *before * stickiness } else { stickiness };
            }
            product = true;
        }
    }

    /// Density of the particles, and what the slag does to those that are dry.
    #[inline(always)]
    fn density(&self, columns: &mut Columns) {
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
    fn on_melt(&self, columns: &mut Columns) {
        let length = self.length();
        let Some(on_melt) = self.wall.on_melt else { return columns.slag_rebound[..length].fill(f64::NAN) };
        let wall = Constants { on_melt: Some(on_melt), ..*self.wall };
        for i in 0..length {
            let impact = Impact {
                normal_speed: self.block.inputs[Impact::NORMAL_SPEED][i],
                diameter: self.block.inputs[Impact::DIAMETER][i],
                ..Impact::default()
            };
            columns.slag_rebound[i] = wall.rebound_on_melt(
                &impact,
                columns.density[i],
                [columns.slag.viscosity[i], wall.surface_tension],
            );
        }
    }

    /// The contact; the stiffness ratio only where it is asked for.
    #[inline(always)]
    fn contact<const STIFFNESS: bool>(&self, columns: &mut Columns) {
        // Matched outside the loop: a wall without ash does not mix, a known work of adhesion is not computed again.
        match (self.wall.has_ash, self.wall.works) {
            (true, Some(works)) => {
                let wall = Constants { has_ash: true, works: Some(works), ..*self.wall };
                self.contact_with::<STIFFNESS>(&wall, columns);
            }
            (false, Some(works)) => {
                let wall = Constants { has_ash: false, works: Some(works), ..*self.wall };
                self.contact_with::<STIFFNESS>(&wall, columns);
            }
            (true, None) => {
                let wall = Constants { has_ash: true, works: None, ..*self.wall };
                self.contact_with::<STIFFNESS>(&wall, columns);
            }
            (false, None) => {
                let wall = Constants { has_ash: false, works: None, ..*self.wall };
                self.contact_with::<STIFFNESS>(&wall, columns);
            }
        }
    }

    #[inline(always)]
    fn contact_with<const STIFFNESS: bool>(&self, wall: &Constants, columns: &mut Columns) {
        for i in 0..self.length() {
            let (state, on_melt, _) = self.run(i, StepSet::CONTACT, wall, columns);
            let Contact { reduced_modulus, work_of_adhesion, yield_strength, stiffness_ratio, .. } =
                state.contact;
            let [a, b, c, d] = &mut columns.contact;
            (a[i], b[i], c[i]) = (reduced_modulus, work_of_adhesion, yield_strength);
            if STIFFNESS {
                d[i] = stiffness_ratio;
            }
            columns.on_melt[i] = on_melt;
        }
    }

    #[inline(always)]
    fn normal(&self, columns: &mut Columns) {
        match self.wall.constant {
            None => self.normal_with(&Constants { constant: None, ..*self.wall }, columns),
            Some(e_n) => self.normal_with(&Constants { constant: Some(e_n), ..*self.wall }, columns),
        }
    }

    #[inline(always)]
    fn normal_with(&self, wall: &Constants, columns: &mut Columns) {
        for i in 0..self.length() {
            let (state, _, left_range) = self.run(i, StepSet::NORMAL, wall, columns);
            columns.restitution[i] = state.normal.restitution;
            columns.held[i] = u64::from(state.normal.held);
            columns.left_range[i] = u64::from(left_range);
        }
    }

    /// The steps after the normal rebound, at the place that the impact meets.
    #[inline(always)]
    fn rebound(&self, columns: &Columns, outcomes: &mut Outcomes) {
        match self.wall.tangential {
            Tangential::Constant(restitution) => {
                let tangential = Tangential::Constant(restitution);
                self.rebound_with(&Constants { tangential, ..*self.wall }, columns, outcomes);
            }
            Tangential::Sliding(friction) => {
                let tangential = Tangential::Sliding(friction);
                self.rebound_with(&Constants { tangential, ..*self.wall }, columns, outcomes);
            }
            Tangential::SlidingRolling(friction) => {
                let tangential = Tangential::SlidingRolling(friction);
                self.rebound_with(&Constants { tangential, ..*self.wall }, columns, outcomes);
            }
        }
    }

    #[inline(always)]
    fn rebound_with(&self, wall: &Constants, columns: &Columns, outcomes: &mut Outcomes) {
        for i in 0..self.length() {
            let (state, ..) = self.run(i, LAST, wall, columns);
            outcomes.normal_restitution[i] = state.normal_restitution;
            outcomes.tangential_restitution[i] = state.rebound.restitution;
            outcomes.sticking_probability[i] = state.probability;
            outcomes.spin[i] = state.rebound.spin;
            outcomes.stuck[i] = u32::from(state.captured);
            outcomes.outside_range[i] = u32::from(state.outside_range);
            let [particle, wall] = [state.sticky.is_particle_sticky(), state.sticky.is_wall_sticky()];
            outcomes.regime[i] = 2 * u32::from(particle) + u32::from(wall);
        }
    }

    /// Probability of capture and range of both shares, with those of the place that the impact does not meet.
    #[inline(always)]
    fn other(&self, columns: &Columns, outcomes: &mut Outcomes) {
        // No rebound is asked for.
        let tangential = Tangential::Constant(0.0);
        match self.wall.constant {
            None => {
                let wall = Constants { constant: None, tangential, ..*self.wall };
                self.other_with(&wall, columns, outcomes);
            }
            Some(e_n) => {
                let wall = Constants { constant: Some(e_n), tangential, ..*self.wall };
                self.other_with(&wall, columns, outcomes);
            }
        }
    }

    #[inline(always)]
    fn other_with(&self, wall: &Constants, columns: &Columns, outcomes: &mut Outcomes) {
        for i in 0..self.length() {
            let (state, ..) = self.run(i, StepSet::NORMAL.union(LAST), wall, columns);
            let coverage = columns.coverage[i];
            let share = if columns.covered[i] == 1 { coverage } else { 1.0 - coverage };
            let met = outcomes.sticking_probability[i];
            let both = both_shares(share, met, state.probability);
            outcomes.sticking_probability[i] = if share == 0.0 { met } else { both };
            outcomes.outside_range[i] |= u32::from(state.outside_range) & u32::from(share != 0.0);
        }
    }

    /// Runs the steps of `selected` on the impact `i`, from what the columns hold. With the state, what the melt leaves a dry particle and
    /// whether the normal law was left.
    #[inline(always)]
    fn run(
        &self,
        i: usize,
        selected: StepSet,
        wall: &Constants,
        columns: &Columns,
    ) -> (ImpactState<Contact>, f64, bool) {
        let input = |input: usize| self.block.inputs[input][i];
        let impact = Impact {
            normal_speed: input(Impact::NORMAL_SPEED),
            tangential_speed: input(Impact::TANGENTIAL_SPEED),
            diameter: input(Impact::DIAMETER),
            particle_temperature: input(Impact::PARTICLE_TEMPERATURE),
            wall_temperature: input(Impact::WALL_TEMPERATURE),
            conversion: input(Impact::CONVERSION),
            spin: input(Impact::SPIN),
            ..Impact::default()
        };
        let [_, _, bare, powder] = &columns.solids;
        let partner = bare.or(powder, i, columns.covered[i]);
        let met = Met {
            particle_solids: [
                columns.solids[0].at(i, wall.fitted[0]),
                columns.solids[1].at(i, wall.fitted[1]),
            ],
            particle: columns.particle[i],
            flight_holds: columns.flight.holds[i] == 1,
            slag: WallState {
                stickiness: columns.slag.stickiness[i],
                viscosity: columns.slag.viscosity[i],
                holds: columns.slag.holds[i] == 1,
            },
            melt: None,
            on_melt: columns.slag_rebound[i],
            chance: columns.chance[i],
            density: columns.density[i],
        };
        let mut steps = VaryingImpact::<false> {
            terms: &[],
            wall,
            partner,
            met: &met,
            reaching: None,
            covered: columns.covered[i] == 1,
            on_melt: columns.on_melt[i],
            left_range: columns.left_range[i] == 1,
        };
        let [reduced_modulus, work_of_adhesion, yield_strength, stiffness_ratio] =
            columns.contact.each_ref().map(|column| column[i]);
        let mut state = ImpactState {
            impact,
            contact: Contact {
                density: columns.density[i],
                reduced_modulus,
                work_of_adhesion,
                yield_strength,
                yield_ratio: wall.adhesion.yield_ratio,
                stiffness_ratio,
                melt: None,
            },
            sticky: Stickiness::default(),
            normal: NormalRebound { restitution: columns.restitution[i], held: columns.held[i] == 1 },
            ..ImpactState::default()
        };
        let Ok(()) = evaluate(&mut steps, selected, &mut state);
        (state, steps.on_melt, steps.left_range)
    }
}
