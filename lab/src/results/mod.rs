//! Wall results of a run, from whichever program followed the particles.
//!
//! [`standalone`] sums up the trajectories of `nearwall simulate`, [`openfoam`] reads the files of a finished case.
//! Both fill [`RunResults`], which [`crate::report`] draws. Masses are in kg; all numbers count from the start of the
//! run. A new statistic is a field of [`WallTotals`] that the sources fill and a figure or column that shows it.

pub mod classes;
pub mod gas;
mod map_cells;
pub mod openfoam;
pub mod standalone;
mod statistics;
pub mod surface;

use regex_lite::Regex;

pub use map_cells::{Grid, MapCell, extent};
pub use statistics::{Amount, Mass, Moments, bin, range, share, wilson};

use classes::Class;
use gas::GasCut;
use nearwall::impact::Regime;
use openfoam::deposit::DepositState;
use surface::WallSurface;

/// Number of equal classes of carbon conversion from 0 to 1.
pub const CONVERSION_BINS: usize = 10;

/// Mass by carbon conversion [kg].
pub type ByConversion = [f64; CONVERSION_BINS];

/// What happened at one wall up to a time. A source fills the statistics that it has.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct WallTotals {
    /// All hits; `None` when the source does not count them.
    pub hits: Option<Amount>,
    /// Hits that ended in capture, with the mass at capture.
    pub captured: Amount,
    /// Parcels that left here.
    pub escaped: Amount,
    /// Hits of particles that had not hit anything before, and how many of them were captured.
    pub first_hits: Option<[u64; 2]>,
    /// Hits in each regime, in the order of [`Regime::ALL`].
    pub regime_hits: Option<[u64; 4]>,
    /// Captures in each regime.
    pub regimes: Option<[Amount; 4]>,
    /// Captured mass by carbon conversion at capture [kg].
    pub conversions: Option<ByConversion>,
    /// Impact speed of all hits [m/s].
    pub speed: Moments,
    /// Angle of all hits from the surface [degrees].
    pub angle: Moments,
    /// Normal restitution of rebounds [1].
    pub e_n: Moments,
    /// Normal restitution of first hits [1]; a capture counts as 0.
    pub first_e_n: Moments,
    /// Tangential restitution of rebounds [1].
    pub e_t: Moments,
    /// Rebounds by normal and by tangential restitution, in bins of [`standalone::RESTITUTION_STEP`].
    pub restitutions: [Vec<u64>; 2],
    /// Carbon conversion of captured particles [1], each particle once.
    pub captured_conversion: Moments,
    /// Hits outside the range that a property or a term is stated for.
    pub outside_range: Option<u64>,
    /// Volume of wall that impacts removed [m³].
    pub eroded: Option<f64>,
    /// Heat that particles gave to the wall while they touched it and rebounded [J].
    pub contact_heat: Option<f64>,
    /// How long particles stay near the wall, where the source follows them there.
    pub near_wall: Option<NearWall>,
}

/// Stays of particles near a wall, and in the cross-section of the pipe that it belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct NearWall {
    /// Gap up to which a particle is near the wall [m].
    pub distance: f64,
    /// Volume of the layer near the wall over that of the pipe [1]; `None` for a wall that is no pipe.
    pub volumes: Option<f64>,
    /// Time near the wall [s] of each followed particle that came near.
    pub stays: Moments,
    /// Number of real particles times time [s] near the wall, and mass times time [kg s].
    pub near: [Mass; 2],
    /// The same in the whole cross-section between the ends of the wall.
    pub section: [Mass; 2],
}

impl NearWall {
    /// Mean concentration near the wall over that in the whole cross-section [1]: by number and by
    /// mass. 1 when the particles are spread evenly; `None` without a cross-section.
    pub fn concentration(&self) -> Option<[f64; 2]> {
        let volumes = self.volumes?;
        let ratio = |of: usize| share(self.near[of].total(), volumes * self.section[of].total());
        Some([ratio(0), ratio(1)])
    }
}

/// Values of one wall over time, in the order of time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct History<T> {
    /// Name of the wall or patch, or an OpenFOAM pattern of several.
    pub wall: String,
    /// Time [s] and the value then.
    pub rows: Vec<(f64, T)>,
}

impl<T> History<T> {
    /// The last value up to a time [s].
    pub fn at(&self, time: f64) -> Option<&T> {
        let after = self.rows.partition_point(|(t, _)| *t <= time * (1.0 + 1e-9));
        after.checked_sub(1).map(|index| &self.rows[index].1)
    }

    /// Whether a wall belongs to this history, by name or by pattern.
    pub fn covers(&self, wall: &str) -> bool {
        self.wall == wall
            || self.is_pattern()
                && Regex::new(&format!("^(?:{})$", self.wall)).is_ok_and(|pattern| pattern.is_match(wall))
    }

    /// Whether the name stands for several patches.
    pub fn is_pattern(&self) -> bool {
        self.wall.contains(['(', '*', '|', '[', '.'])
    }
}

/// The last time [s] that all runs have reached.
pub fn common_time<'a>(runs: impl Iterator<Item = &'a RunResults>) -> f64 {
    runs.map(RunResults::last_time).fold(f64::INFINITY, f64::min)
}

/// The history of a wall, made when it does not exist.
pub(crate) fn history_of<'a, T>(histories: &'a mut Vec<History<T>>, wall: &str) -> &'a mut History<T> {
    let index = histories.iter().position(|history| history.wall == wall).unwrap_or_else(|| {
        histories.push(History { wall: wall.to_owned(), rows: Vec::new() });
        histories.len() - 1
    });
    &mut histories[index]
}

/// A particle or parcel that lies on a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capture {
    /// Index of the wall in [`RunResults::walls`], when the source tells it.
    pub wall: Option<usize>,
    /// Position [m].
    pub position: [f64; 3],
    /// Mass of all that it stands for [kg].
    pub mass: f64,
    /// Diameter [m].
    pub diameter: f64,
    /// Regime of the last hit, when the source tells it.
    pub regime: Option<Regime>,
}

/// Arrivals at a patch as OpenFOAM's own cloud function records them, before the wall model acts,
/// up to the time at which the run is compared with others.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RecordedArrivals {
    /// Name of the patch.
    pub patch: String,
    /// Parcels, and the mass of all their particles.
    pub hits: Amount,
    /// Their speed [m/s].
    pub speed: Moments,
    /// Arriving mass by carbon conversion [kg].
    pub conversions: ByConversion,
    /// Arrivals of unknown conversion, as without carbon.
    pub unknown_conversions: u64,
    /// Arrivals during the whole run.
    pub whole_run: Amount,
}

/// What hits leave on a wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MapQuantity {
    /// The mass of captured particles [kg].
    Captured,
    /// The volume of wall that hits removed [m³].
    Eroded,
}

/// What hits left on the unrolled surface of a wall.
#[derive(Debug, Clone, PartialEq)]
pub struct WallMap {
    /// What they left.
    pub quantity: MapQuantity,
    /// Name of the wall.
    pub wall: String,
    /// Labels of the two axes, with units.
    pub axes: [&'static str; 2],
    /// Ends of both axes [m].
    pub ranges: [[f64; 2]; 2],
    /// Place [m] of each hit that left something, and how much.
    pub places: Vec<([f64; 2], f64)>,
}

impl WallMap {
    /// Whether a place [m] is on the map.
    pub fn shows(&self, place: &[f64; 2]) -> bool {
        self.ranges.iter().zip(place).all(|([low, high], value)| (low..=high).contains(&value))
    }

    /// Number of the hits that are not on the map, and their share of all that hits left [1].
    pub fn outside(&self) -> (usize, f64) {
        let outside = || self.places.iter().filter(|(place, _)| !self.shows(place));
        let all: f64 = self.places.iter().map(|(_, amount)| amount).sum();
        (outside().count(), share(outside().map(|(_, amount)| amount).sum(), all))
    }
}

/// Pipes about the z axis, along which captures are drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PipeZones {
    /// Indices of the pipes in [`RunResults::walls`].
    pub walls: Vec<usize>,
    /// Ends of the whole pipe along z [m].
    pub range: [f64; 2],
    /// Where a further part begins [m], and its name.
    pub marks: Vec<(f64, String)>,
}

/// One line of a mass balance.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BalanceLine {
    /// What is counted.
    pub what: String,
    /// Number of particles, if it is counted.
    pub count: Option<u64>,
    /// Mass [kg], if it is known.
    pub mass: Option<f64>,
}

/// The wall model of a run.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum WallModel {
    /// The case does not name it.
    #[default]
    Unknown,
    /// The impact model of this crate.
    Nearwall,
    /// Another model of OpenFOAM, by its name, for instance `localInteraction`.
    Other(String),
}

/// Results of one run: a standalone case at one value of its sweep, or one cloud of an OpenFOAM case.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunResults {
    /// Name of the case.
    pub case: String,
    /// Name of the cloud; empty for a standalone case.
    pub cloud: String,
    /// What decided the hits.
    pub wall_model: WallModel,
    /// The key `stuck` of nearWallInteraction: what becomes of captured parcels.
    pub stuck: Option<String>,
    /// Whether the cloud is solved for a steady flow: times are then numbers of iterations, and
    /// sums those of one solve.
    pub steady: bool,
    /// Totals of each wall or patch.
    pub walls: Vec<History<WallTotals>>,
    /// Patches of type `wall`; empty when the mesh is absent.
    pub wall_patches: Vec<String>,
    /// What arrived at each wall by speed, angle and size.
    pub classes: Vec<History<Vec<Class>>>,
    /// What lies on each wall that keeps a deposit.
    pub deposits: Vec<History<DepositState>>,
    /// Deposit, temperature and heat flux on the faces of the walls at the last written time.
    pub surfaces: Vec<WallSurface>,
    /// Gas and parcels in a plane, at the last written time with parcels.
    pub gas: Option<GasCut>,
    /// Arrivals recorded by OpenFOAM's own cloud function at each patch that any reached.
    pub arrivals: Vec<RecordedArrivals>,
    /// Time [s] and injected mass [kg].
    pub injected: Vec<[f64; 2]>,
    /// Time [s] and mass [kg] that left through any patch, where a log states it.
    pub escaped: Vec<[f64; 2]>,
    /// Mass balance at the last time, and its residual over the injected mass [1].
    pub balance: Vec<BalanceLine>,
    /// Injected minus all other terms, over injected [1]; `None` when the source keeps no balance.
    pub residual: Option<f64>,
    /// What lies on the walls at the last time.
    pub captures: Vec<Capture>,
    /// Maps of the walls whose surface can be unrolled.
    pub maps: Vec<WallMap>,
    /// Injections of a case with several: name, injected and captured.
    pub injections: Vec<(String, Amount, Amount)>,
    /// The pipes of a standalone case.
    pub pipe: Option<PipeZones>,
    /// Whether the particles contain carbon.
    pub has_carbon: bool,
    /// Why the first unusable particle could not be used, with the number of such particles.
    pub trouble: Option<(u64, String)>,
    /// What hits used outside of its stated range, in lines.
    pub outside_ranges: Vec<String>,
    /// What could not be found.
    pub missing: Vec<String>,
}

impl RunResults {
    /// Whether the impact model of this crate decided the hits.
    pub fn is_ours(&self) -> bool {
        self.wall_model == WallModel::Nearwall
    }

    /// Injected mass [kg] up to a time [s].
    pub fn injected_at(&self, time: f64) -> Option<f64> {
        self.injected.iter().take_while(|[t, _]| *t <= time * (1.0 + 1e-9)).last().map(|[_, mass]| *mass)
    }

    /// The last time [s] of which anything is known.
    pub fn last_time(&self) -> f64 {
        let tables = self.walls.iter().filter_map(|wall| wall.rows.last()).map(|(time, _)| *time);
        tables.chain(self.injected.iter().map(|[time, _]| *time)).fold(0.0, f64::max)
    }

    /// The wall of this name.
    pub fn wall(&self, name: &str) -> Option<&History<WallTotals>> {
        self.walls.iter().find(|wall| wall.covers(name))
    }

    /// Totals of a wall at a time [s].
    pub fn totals(&self, wall: &str, time: f64) -> Option<&WallTotals> {
        self.wall(wall)?.at(time)
    }

    /// Captures at a wall up to a time [s]; `None` when the source counts several patches together.
    pub fn captured(&self, wall: &str, time: f64) -> Option<Amount> {
        let history = self.wall(wall)?;
        let captured = history.at(time)?.captured;
        (!history.is_pattern() || captured.count == 0).then_some(captured)
    }

    /// Arrivals at a wall up to a time [s] and their speed: those that the source counts, else those recorded.
    pub fn arrived(&self, wall: &str, time: f64) -> Option<(Amount, Moments)> {
        let totals = self.totals(wall, time);
        if let Some((totals, hits)) = totals.and_then(|totals| Some((totals, totals.hits?))) {
            return Some((hits, totals.speed));
        }
        let at_wall = self.recorded(wall).map_or_else(Default::default, |sums| (sums.hits, sums.speed));
        (!self.arrivals.is_empty()).then_some(at_wall)
    }

    /// Recorded arrivals at a wall.
    pub fn recorded(&self, wall: &str) -> Option<&RecordedArrivals> {
        self.arrivals.iter().find(|arrivals| arrivals.patch == wall)
    }

    /// Mass [kg] captured at all walls up to a time [s].
    pub fn captured_mass(&self, time: f64) -> f64 {
        self.walls.iter().filter_map(|wall| wall.at(time)).map(|totals| totals.captured.mass()).sum()
    }

    /// Whether a wall captures every parcel that arrives (a constant `stick`).
    pub fn captures_all(&self, wall: &str, time: f64) -> bool {
        match (self.captured(wall, time), self.arrived(wall, time)) {
            (Some(captured), Some((hits, _))) => {
                captured.count > 0 && captured.count as f64 >= 0.98 * hits.count as f64
            }
            _ => false,
        }
    }

    /// Captured mass by conversion at some walls [kg]. For a stock model it is that of the recorded arrivals at walls
    /// that capture all of them. `None` when nothing is known or nothing was captured.
    pub fn captured_by_conversion(&self, walls: &[&str], time: f64) -> Option<ByConversion> {
        let mut sums = ByConversion::default();
        if self.is_ours() {
            let covered = self.walls.iter().filter(|wall| walls.iter().any(|name| wall.covers(name)));
            for totals in covered.filter_map(|wall| wall.at(time)) {
                sums.iter_mut().zip(totals.conversions?).for_each(|(sum, mass)| *sum += mass);
            }
            // Particles without carbon count as fully converted.
            if !self.has_carbon && sums[..CONVERSION_BINS - 1].iter().all(|sum| *sum == 0.0) {
                return None;
            }
        } else {
            for wall in walls.iter().filter(|wall| self.captures_all(wall, time)) {
                let Some(arrivals) = self.recorded(wall) else { continue };
                if arrivals.unknown_conversions > 0 {
                    return None;
                }
                sums.iter_mut().zip(arrivals.conversions).for_each(|(sum, mass)| *sum += mass);
            }
        }
        (sums.iter().sum::<f64>() > 0.0).then_some(sums)
    }
}
