//! The memory of the walls: a `[deposit]` in a case.
//!
//! The particles of each injection are released evenly over the duration of the feed. The duration
//! has equal steps. Particles that are released in a step meet the walls as they were at its
//! beginning; at its end the captured ones are added ([`nearwall::Model::add_captured`],
//! [`Deposit::with`]) and the carbon of the powder burns for the length of the step, by the case's
//! law of conversion at the temperature of the wall ([`burn_off`]), while they arrive evenly over
//! the step. Then the processes of [`nearwall::deposit::PROCESSES`] act
//! ([`nearwall::Model::advance`]). So the flight has to be short against a step, and what one step
//! adds has to be small. The sums go in the order of the particles, so that they do not depend on
//! the number of threads. A wall has equal bins along a pipe, or rings of equal width on a disc;
//! each is one [`Deposit`].

use nalgebra::Vector3;

use super::case::Case;
use super::deposit_settings::DepositSettings;
use super::error::SimulationError;
use super::shrinkage::ASH_DENSITY;
use super::surface::{Surface, SurfaceKind, SurfaceShape};
use super::trajectory::{Fate, Trajectory};
use super::wall_surroundings::surroundings;
use nearwall::deposit::{Deposit, DepositSource, Losses, burn_off};
use nearwall::impact::{Impact, ImpactError};
use nearwall::model::{Model, WallHeat, WallHeatError};

/// Sub-steps for each time in which the powder burns down by a factor e.
const PARTS_PER_TIME: f64 = 4.0;
/// Largest number of sub-steps; powder that burns faster covers nothing.
const MOST_PARTS: f64 = 64.0;

/// What lies on the walls over time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DepositHistory {
    /// The walls, in the order of the case.
    pub walls: Vec<WallHistory>,
}

/// What lies on one wall over time.
#[derive(Debug, Clone, PartialEq)]
pub struct WallHistory {
    /// Index of the surface.
    pub surface: usize,
    /// Its bins.
    pub bins: Vec<BinHistory>,
}

/// What lies on one bin of a wall, at the start and after each step.
#[derive(Debug, Clone, PartialEq)]
pub struct BinHistory {
    /// Where it begins and ends [m]: along a pipe, from the middle of a disc.
    pub range: [f64; 2],
    /// Area [m²].
    pub area: f64,
    /// Mass that was captured here up to then [kg].
    pub arrived: Vec<f64>,
    /// Mass that burnt away up to then [kg].
    pub burnt: Vec<f64>,
    /// Mass that each process took up to then [kg], in the order of [`nearwall::deposit::PROCESSES`].
    pub lost: Vec<Losses>,
    /// The deposit then.
    pub states: Vec<Deposit>,
    /// Temperatures then, of a cooled wall.
    pub heat: Vec<WallHeat>,
    /// Heat flux that particles brought in the step before [W/m²], of a cooled wall.
    pub particle_flux: Vec<f64>,
}

/// The walls while a case runs.
#[derive(Debug)]
pub(super) struct WallDeposits {
    settings: DepositSettings,
    /// In the order of the surfaces; `None` for an exit.
    walls: Vec<Option<Vec<Bin>>>,
}

#[derive(Debug)]
struct Bin {
    history: BinHistory,
    deposit: Deposit,
    source: DepositSource,
    powder: PowderCarbon,
    /// Of the captured powder in this step.
    powder_source: PowderCarbon,
    /// What came and went in this step.
    step: BinStep,
}

/// Mass that came to a bin and left it in a step [kg/m²].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct BinStep {
    caught: f64,
    burnt: f64,
    lost: Losses,
    /// Heat that particles brought [J/m²].
    heat: f64,
}

/// Combustible matter in the outer powder per area of wall.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct PowderCarbon {
    /// What is left [kg/m²].
    left: f64,
    /// What the same particles had unburnt [kg/m²].
    unburnt: f64,
}

impl WallDeposits {
    pub(super) fn new(case: &Case, settings: DepositSettings) -> Result<Self, SimulationError> {
        let wall = |surface: &Surface| {
            let SurfaceKind::Wall { model, .. } = &surface.kind else { return Ok(None) };
            let initial = case.model.initial_deposit(*model, settings.voidage);
            let initial = initial.map_err(SimulationError::at_wall(&surface.name))?;
            let mut bins = bins(&surface.shape, settings.bins, initial);
            bins.iter_mut().try_for_each(|bin| bin.record_heat(case, surface, settings.voidage, 0.0))?;
            Ok(Some(bins))
        };
        Ok(Self { settings, walls: case.surfaces.iter().map(wall).collect::<Result<_, SimulationError>>()? })
    }

    /// What an impact on a surface meets, at a point near it; as it is at an exit.
    pub(super) fn apply(
        &self,
        case: &Case,
        surface: usize,
        position: &Vector3<f64>,
        model: &Model,
        wall: usize,
        impact: &Impact,
    ) -> Result<Impact, ImpactError> {
        let bins = self.walls.get(surface).and_then(Option::as_ref);
        let here = |bins: &Vec<Bin>| bin_at(bins, case.surfaces[surface].shape.coordinate(position));
        let Some(bin) = bins.and_then(|bins| bins.get(here(bins))) else { return Ok(*impact) };
        let wall_temperature = bin.temperature().unwrap_or(impact.wall_temperature);
        let under = bin.history.heat.last().map_or(0.0, |heat| heat.wall_temperature);
        let impact = Impact { wall_temperature, temperature_under: under, ..*impact };
        model.apply_deposit(wall, &bin.deposit, self.settings.voidage, &impact)
    }

    /// The bin of a surface near a point; `None` at an exit.
    fn bin_near(&mut self, case: &Case, surface: usize, position: &Vector3<f64>) -> Option<&mut Bin> {
        let bins = self.walls.get_mut(surface)?.as_mut()?;
        let index = bin_at(bins, case.surfaces[surface].shape.coordinate(position));
        bins.get_mut(index)
    }

    /// Adds a particle of this step: the heat of its rebounds, and itself where it was captured.
    pub(super) fn collect(&mut self, case: &Case, trajectory: &Trajectory) -> Result<(), SimulationError> {
        for hit in trajectory.hits.iter().filter(|hit| hit.heat != 0.0) {
            if let Some(bin) = self.bin_near(case, hit.surface, &hit.position) {
                bin.step.heat += hit.heat / bin.history.area;
            }
        }
        let (Fate::Stuck(surface), Some(hit)) = (&trajectory.fate, trajectory.hits.last()) else {
            return Ok(());
        };
        let SurfaceKind::Wall { model: wall, .. } = &case.surfaces[*surface].kind else { return Ok(()) };
        let Some(bin) = self.bin_near(case, *surface, &hit.position) else { return Ok(()) };
        let injection = &case.injections[trajectory.injection];
        let (model, wall) = (case.model_of(injection), injection.wall(*wall));
        let mass = hit.mass / bin.history.area;
        let powder = bin.source.powder;
        bin.source = model.add_captured(wall, &hit.impact, mass, hit.density, bin.source)?;
        bin.step.caught += mass;
        bin.step.heat += mass * model.heat_brought(&hit.impact, injection.heat_capacity).unwrap_or(0.0);
        if bin.source.powder > powder {
            let share = injection.burning.carbon;
            let unburnt = mass * share / (1.0 - share * hit.impact.conversion);
            let left = unburnt * (1.0 - hit.impact.conversion);
            bin.powder_source = bin.powder_source.with(&PowderCarbon { left, unburnt });
        }
        Ok(())
    }

    /// Adds what was captured in this step, and lets the powder burn.
    pub(super) fn end_step(&mut self, case: &Case) -> Result<(), SimulationError> {
        let (duration, voidage) = (self.settings.step(), self.settings.voidage);
        for (surface, bins) in case.surfaces.iter().zip(&mut self.walls) {
            let (SurfaceKind::Wall { model, temperature, .. }, Some(bins)) = (&surface.kind, bins) else {
                continue;
            };
            for (number, bin) in bins.iter_mut().enumerate() {
                let middle = surface.shape.point_at(bin.middle());
                let met = bin.temperature().unwrap_or_else(|| temperature.at(&middle));
                bin.step.burnt = bin.end_step(case, *model, met, duration)?;
                bin.advance(case, surface, number, voidage, duration)
                    .map_err(SimulationError::at_wall(&surface.name))?;
                let step = std::mem::take(&mut bin.step);
                bin.history.record(bin.deposit, &step);
                bin.record_heat(case, surface, voidage, step.heat / duration)?;
            }
        }
        Ok(())
    }

    /// What lay on the walls over time.
    pub(super) fn into_history(self) -> DepositHistory {
        let history = |bins: Vec<Bin>| bins.into_iter().map(|bin| bin.history).collect();
        let walls = self.walls.into_iter().enumerate();
        let walls = walls.filter_map(|(surface, bins)| Some(WallHistory { surface, bins: history(bins?) }));
        DepositHistory { walls: walls.collect() }
    }
}

impl Bin {
    /// What was captured arrives evenly over the step while the powder burns: sub-steps of half the
    /// burning, a part of the captured particles, and the other half. Returns the mass that burns
    /// [kg/m²].
    fn end_step(
        &mut self,
        case: &Case,
        wall: usize,
        temperature: f64,
        duration: f64,
    ) -> Result<f64, SimulationError> {
        let rate = case.injections.first().map_or(0.0, |injection| injection.burning.rate(temperature, 0.0));
        let has_carbon = self.powder.left + self.powder_source.left > 0.0;
        let parts =
            if has_carbon { (PARTS_PER_TIME * rate * duration).ceil().clamp(1.0, MOST_PARTS) } else { 1.0 };
        let source = part_of(&std::mem::take(&mut self.source), parts);
        let carbon = std::mem::take(&mut self.powder_source).times(1.0 / parts);
        let half = 0.5 * duration / parts;
        let mut burnt = 0.0;
        for _ in 0..parts as u32 {
            burnt += self.burn(case, wall, temperature, half)?;
            let powder = self.deposit.layers().outer_powder + source.powder;
            self.deposit = self.deposit.with(&source);
            // Melt buries powder of every kind alike; what is buried does not burn.
            let kept = if powder > 0.0 { self.deposit.layers().outer_powder / powder } else { 0.0 };
            self.powder = self.powder.with(&carbon).times(kept);
            burnt += self.burn(case, wall, temperature, half)?;
        }
        Ok(burnt)
    }

    /// Middle of the bin along its wall [m].
    fn middle(&self) -> f64 {
        let [from, to] = self.history.range;
        0.5 * (from + to)
    }

    /// Temperature of the surface that impacts meet [K]; of a cooled wall only.
    fn temperature(&self) -> Option<f64> {
        self.history.heat.last().map(|heat| heat.surface_temperature)
    }

    /// Records the temperatures of a cooled wall under its deposit, with what particles bring [W/m²].
    fn record_heat(
        &mut self,
        case: &Case,
        surface: &Surface,
        voidage: f64,
        particle_flux: f64,
    ) -> Result<(), SimulationError> {
        let SurfaceKind::Wall { model, cooling: Some(cooling), .. } = &surface.kind else { return Ok(()) };
        let place = surface.shape.point_at(self.middle());
        let cooling = cooling.at(&case.gas, &place, particle_flux);
        self.history.particle_flux.push(particle_flux);
        let heat = case.model.wall_heat(*model, &self.deposit, voidage, &cooling);
        let heat = heat.map_err(SimulationError::at_wall(&surface.name))?;
        self.history.heat.push(heat);
        Ok(())
    }

    /// Lets the processes act for a step [s], on a cooled wall at its present temperatures.
    fn advance(
        &mut self,
        case: &Case,
        surface: &Surface,
        number: usize,
        voidage: f64,
        duration: f64,
    ) -> Result<(), WallHeatError> {
        let SurfaceKind::Wall { model: wall, friction_velocity, temperature, cooling, .. } = &surface.kind
        else {
            return Ok(());
        };
        let place = surface.shape.point_at(self.middle());
        let flux = self.step.heat / duration;
        let cooling = cooling.as_ref().map(|cooling| cooling.at(&case.gas, &place, flux));
        let heat = cooling.ok_or_else(|| temperature.at(&place));
        let around = surroundings(case, surface, *friction_velocity, &place, number, voidage, heat);
        let before = self.deposit.layers().outer_powder;
        (self.deposit, self.step.lost, _) = case.model.advance(*wall, &self.deposit, &around, duration)?;
        // What melts, is enclosed or leaves takes its carbon along.
        let kept = if before > 0.0 { self.deposit.layers().outer_powder / before } else { 1.0 };
        self.powder = self.powder.times(kept);
        Ok(())
    }

    /// Lets the powder burn; returns the mass that is gone [kg/m²].
    fn burn(
        &mut self,
        case: &Case,
        wall: usize,
        temperature: f64,
        duration: f64,
    ) -> Result<f64, SimulationError> {
        // The law is that of the case, the same for all injections.
        let Some(injection) = case.injections.first() else { return Ok(0.0) };
        let (law, carbon) = (injection.burning, self.powder);
        if carbon.left <= 0.0 {
            return Ok(0.0);
        }
        let conversion = 1.0 - carbon.left / carbon.unburnt;
        let left = (1.0 - law.after(temperature, conversion, duration)) / (1.0 - conversion);
        let burning = burn_off::PowderBurning {
            combustible: carbon.left,
            left,
            conversion,
            diameter_exponent: law.diameter_exponent,
            ash_density: injection.ash_density(&case.model, temperature),
            ash_melts: ash_melts(case, wall, temperature)?,
        };
        self.deposit = burn_off::after(&self.deposit, &burning);
        // Where burnt-out particles melt away, their unburnt mass goes with them.
        let unburnt = if burning.ash_melts { carbon.unburnt * left } else { carbon.unburnt };
        self.powder = PowderCarbon { left: carbon.left * left, unburnt };
        Ok(carbon.left * (1.0 - left))
    }
}

/// One of so many equal parts.
fn part_of(source: &DepositSource, parts: f64) -> DepositSource {
    let DepositSource { molten, powder, solid, cover, buried, converted } = *source;
    let [molten, powder, solid, cover, buried, converted] =
        [molten, powder, solid, cover, buried, converted].map(|value| value / parts);
    DepositSource { molten, powder, solid, cover, buried, converted }
}

/// Whether ash without carbon is molten on a wall of the case's model at a temperature [K].
fn ash_melts(case: &Case, wall: usize, temperature: f64) -> Result<bool, ImpactError> {
    let ash = Impact {
        particle_temperature: temperature,
        wall_temperature: temperature,
        conversion: 1.0,
        ..Impact::default()
    };
    let arrived = case.model.add_captured(wall, &ash, 1.0, ASH_DENSITY, DepositSource::default());
    Ok(arrived?.molten > 0.0)
}

impl PowderCarbon {
    fn with(self, other: &Self) -> Self {
        Self { left: self.left + other.left, unburnt: self.unburnt + other.unburnt }
    }

    fn times(self, factor: f64) -> Self {
        Self { left: self.left * factor, unburnt: self.unburnt * factor }
    }
}

impl BinHistory {
    /// Adds a state after a step.
    fn record(&mut self, deposit: Deposit, step: &BinStep) {
        let BinStep { caught, burnt, lost, .. } = *step;
        for (sum, more) in [(&mut self.arrived, caught), (&mut self.burnt, burnt)] {
            sum.push(sum.last().copied().unwrap_or(0.0) + more * self.area);
        }
        let mut sums = self.lost.last().copied().unwrap_or_default();
        sums.iter_mut().zip(lost).for_each(|(sum, more)| *sum += more * self.area);
        self.lost.push(sums);
        self.states.push(deposit);
    }
}

/// The bins of a wall of this shape with its initial deposit.
fn bins(shape: &SurfaceShape, count: usize, deposit: Deposit) -> Vec<Bin> {
    let [from, to] = shape.extent().unwrap_or_default();
    let edge = |number: usize| from + (to - from) * number as f64 / count as f64;
    let bin = |number: usize| {
        let range = [edge(number), edge(number + 1)];
        let area = shape.area_between(range);
        let mut history = BinHistory {
            range,
            area,
            arrived: vec![],
            burnt: vec![],
            lost: vec![],
            states: vec![],
            heat: vec![],
            particle_flux: vec![],
        };
        history.record(deposit, &BinStep::default());
        Bin {
            history,
            deposit,
            source: DepositSource::default(),
            powder: PowderCarbon::default(),
            powder_source: PowderCarbon::default(),
            step: BinStep::default(),
        }
    };
    (0..count).map(bin).collect()
}

/// The bin of a coordinate; beyond the ends the nearest one.
fn bin_at(bins: &[Bin], coordinate: f64) -> usize {
    let [from, _] = bins[0].history.range;
    let [_, to] = bins[bins.len() - 1].history.range;
    let share = (coordinate - from) / (to - from);
    ((share * bins.len() as f64).max(0.0) as usize).min(bins.len() - 1)
}
