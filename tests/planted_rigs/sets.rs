//! The sets: every cause at one of three strengths, and rigs whose base is right.

use crate::effects::{self, CAUSES, Plan};
use crate::groups;
use crate::lab::{Errors, Experiment, Lab, PARTICLES, Reading};
use crate::oracle::Oracle;
use crate::set_rng::SetRng;
use crate::source::Knob;
use crate::wrong_case::{self, WrongNumber};

/// Strengths in deviations of all readings together.
const STRENGTHS: [f64; 3] = [10.0, 5.0, 2.8];
/// Particles of an experiment.
const COUNTS: (f64, f64) = (30.0, 500.0);
/// Particles in a trial of a plan, in rigs of one impact and of several.
const TRIAL: [usize; 2] = [200, 1500];
/// Fresh experiments.
const FRESH: usize = 6;

/// How runs of a rig with a right base scatter beyond their stated errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scatter {
    /// Every reading scatters four times as much as its error says; a share as a beta-binomial one.
    Fourfold,
    /// Every reading is off by a factor with a standard deviation of 3 %.
    Readings,
    /// Every setting was off by 3 % (standard deviation) of the range over which it varies.
    Settings,
}

impl Scatter {
    /// All of them, with the names of their sets.
    const ALL: [(Self, &str); 3] =
        [(Self::Fourfold, "fourfold"), (Self::Readings, "readings"), (Self::Settings, "settings")];
    /// Standard deviation, as a share.
    const DEVIATION: f64 = 0.03;
    /// Factor on the error of a reading.
    const FACTOR: f64 = 4.0;

    /// The settings that a run really had.
    fn settings(self, lab: &Lab, stated: &[f64], rng: &mut SetRng) -> Vec<f64> {
        let moved = |(value, (_, (low, high))): (&f64, &(Knob, (f64, f64)))| {
            value + Self::DEVIATION * (high - low) * rng.normal()
        };
        match self {
            Self::Settings => stated.iter().zip(&lab.knobs).map(moved).collect(),
            _ => stated.to_vec(),
        }
    }

    /// Moves a reading; a counted share stays one of its count.
    fn reading(self, reading: &mut Reading, is_share: bool, rng: &mut SetRng) {
        let Reading { value, truth, count, particles, .. } = *reading;
        let all = particles.round();
        let moved = match self {
            Self::Fourfold if is_share => {
                let correlation = (Self::FACTOR * Self::FACTOR - 1.0) / (all - 1.0);
                f64::from(rng.beta_binomial(all as u32, truth, correlation)) / all
            }
            Self::Fourfold => truth + Self::FACTOR * (value - truth),
            Self::Readings => value * Self::DEVIATION.mul_add(rng.normal(), 1.0),
            Self::Settings => value,
        };
        let within = if is_share { moved.clamp(0.0, 1.0) } else { moved };
        reading.value = count.map_or(within, |count| (within * count).round() / count);
    }
}

/// A set.
pub struct Set {
    pub name: String,
    pub plan: Plan,
    pub experiments: Vec<Experiment>,
    /// New settings with their true readings.
    pub fresh: Vec<Experiment>,
    /// Whether each reading has a row of its own.
    pub rows_apart: bool,
    pub oracle: Oracle,
}

impl Set {
    /// The name without its index.
    pub fn family(&self) -> &str {
        self.name.rsplit_once('#').unwrap().0
    }

    pub fn lab(&self) -> &Lab {
        &self.plan.lab
    }

    pub fn is_null(&self) -> bool {
        self.plan.names.is_empty()
    }

    /// The file of measurements.
    pub fn csv(&self) -> String {
        self.lab().csv(&self.experiments, self.rows_apart)
    }
}

/// A set that is not drawn yet.
pub struct Recipe {
    pub name: String,
    cause: Option<&'static str>,
    /// Whether the cause is a law over a group.
    over_group: bool,
    index: usize,
    scatter: Option<Scatter>,
    wrong: Option<WrongNumber>,
}

impl Recipe {
    /// The set of this seed: plans are drawn until one has the strength with a possible number of particles.
    pub fn make(&self, seed: u64) -> Set {
        let mut rng = SetRng::new(seed, &self.name);
        for _ in 0..4000 {
            if let Some(set) = self.draw(&mut rng) {
                return set;
            }
        }
        panic!("{}: no plan has this strength", self.name)
    }

    fn draw(&self, rng: &mut SetRng) -> Option<Set> {
        let mut plan = match self.cause {
            Some(law) if self.over_group => groups::plan(law, rng),
            Some(cause) => effects::plan(cause, rng),
            None => match self.wrong {
                Some(number) => wrong_case::plan(number, self.index, rng),
                None => effects::null(self.index, rng),
            },
        };
        if self.scatter.is_some() {
            plan.lab.errors = [Errors::Stated, Errors::Counts][self.index / 3 % 2];
        }
        let lab = &plan.lab;
        let count = 6 + rng.below(15);
        let designs = lab.design(count, rng);
        let strength = STRENGTHS[self.index % 3] * rng.uniform((0.9, 1.1));
        // A law over a group is told from one over speed or size by more than from none.
        let particles = match self.cause {
            None => rng.log_uniform(COUNTS),
            Some(_) if self.over_group => rng.log_uniform(COUNTS),
            Some(_) => {
                strength.powi(2) / lab.information(&designs, TRIAL[usize::from(!lab.rig.hits_once())], rng)?
            }
        };
        if !(COUNTS.0..=COUNTS.1).contains(&particles) {
            return None;
        }
        let mut measure = |designs: Vec<Vec<f64>>| -> Option<Vec<Experiment>> {
            designs
                .into_iter()
                .map(|settings| {
                    let even = lab.errors == crate::lab::Errors::Absent;
                    let share = if even { 1.0 } else { rng.uniform((0.6, 1.4)) };
                    self.measure(lab, settings, particles * share, rng)
                })
                .collect()
        };
        let mut experiments = measure(designs)?;
        lab.even_errors(&mut experiments);
        let oracle = Oracle::of(&experiments, lab.errors);
        let of_strength = (0.75..1.35).contains(&(oracle.expected / strength));
        if self.cause.is_some() && !self.over_group && !of_strength {
            return None;
        }
        let fresh_designs = lab.design(FRESH, &mut SetRng::new(count as u64, &self.name));
        let fresh = measure(fresh_designs)?;
        let rows_apart = lab.readings.len() > 1 && rng.chance(0.4);
        Some(Set { name: self.name.clone(), experiments, fresh, rows_apart, oracle, plan })
    }
}

impl Recipe {
    /// Measures an experiment, with the scatter of these runs.
    fn measure(&self, lab: &Lab, settings: Vec<f64>, count: f64, rng: &mut SetRng) -> Option<Experiment> {
        let Some(scatter) = self.scatter else { return lab.measure(settings, count, rng) };
        let mut one = lab.measure(scatter.settings(lab, &settings, rng), count, rng)?;
        for (reading, (observable, _)) in one.readings.iter_mut().zip(&lab.readings) {
            scatter.reading(reading, observable.is_share(), rng);
        }
        Some(Experiment { settings, ..one })
    }
}

/// The sets that this run is asked for: `NEARWALL_RIGS_SETS` repeats (1; 3 for every strength), and
/// of those only `NEARWALL_RIGS_ONLY`, names (`powder-layer#1`), families (`powder-layer`) or
/// beginnings (`calib*`), several with commas.
pub fn wanted() -> Vec<Recipe> {
    let repeats = std::env::var("NEARWALL_RIGS_SETS").map_or(1, |count| count.parse().unwrap());
    recipes(repeats).into_iter().filter(|recipe| is_wanted(&recipe.name)).collect()
}

/// So many sets of each cause, at a strength after the other, and nine times as many nulls.
pub fn recipes(repeats: usize) -> Vec<Recipe> {
    let one = |family: &str, cause, index| Recipe {
        name: format!("{family}#{index}"),
        cause,
        over_group: false,
        index,
        scatter: None,
        wrong: None,
    };
    // The first strength differs from cause to cause.
    let of = |(place, cause): (usize, &'static str)| {
        let indices = (0..repeats).map(move |index| 3 * (index / 3) + (place + index) % 3);
        indices.map(move |index| one(&cause.replace(':', "-"), Some(cause), index))
    };
    let nulls = (0..9 * repeats).map(|index| one("null", None, index));
    CAUSES.into_iter().enumerate().flat_map(of).chain(nulls).collect()
}

/// Rigs with a right base whose runs scatter: six times `NEARWALL_RIGS_SETS` (1) of each kind, and of
/// these only `NEARWALL_RIGS_ONLY`.
pub fn scattered() -> Vec<Recipe> {
    let count = 6 * std::env::var("NEARWALL_RIGS_SETS").map_or(1, |count| count.parse().unwrap());
    let of = |(scatter, name): (Scatter, &str)| {
        let name = name.to_owned();
        (0..count).map(move |index| Recipe {
            name: format!("scatter-{name}#{index}"),
            cause: None,
            over_group: false,
            index,
            scatter: Some(scatter),
            wrong: None,
        })
    };
    Scatter::ALL.into_iter().flat_map(of).filter(|recipe| is_wanted(&recipe.name)).collect()
}

/// Rigs with a right wall law and a wrong number of the case: three times `NEARWALL_RIGS_SETS` (1) of
/// each number, and of these only `NEARWALL_RIGS_ONLY`.
pub fn wrong_cases() -> Vec<Recipe> {
    let count = 3 * std::env::var("NEARWALL_RIGS_SETS").map_or(1, |count| count.parse().unwrap());
    let of = |number: WrongNumber| {
        (0..count).map(move |index| Recipe {
            name: format!("{}#{index}", number.family()),
            cause: None,
            over_group: false,
            index,
            scatter: None,
            wrong: Some(number),
        })
    };
    wrong_case::NUMBERS.into_iter().flat_map(of).filter(|recipe| is_wanted(&recipe.name)).collect()
}

/// Rigs whose law depends on a group: three times `NEARWALL_RIGS_SETS` (1) of each law, and of these only
/// `NEARWALL_RIGS_ONLY`.
pub fn over_groups() -> Vec<Recipe> {
    let count = 3 * std::env::var("NEARWALL_RIGS_SETS").map_or(1, |count| count.parse().unwrap());
    let of = |law: &'static str| {
        (0..count).map(move |index| Recipe {
            name: format!("{law}#{index}"),
            cause: Some(law),
            over_group: true,
            index,
            scatter: None,
            wrong: None,
        })
    };
    groups::LAWS.into_iter().flat_map(of).filter(|recipe| is_wanted(&recipe.name)).collect()
}

fn is_wanted(name: &str) -> bool {
    let Ok(only) = std::env::var("NEARWALL_RIGS_ONLY") else { return true };
    only.split(',').any(|one| match one.strip_suffix('*') {
        Some(begin) => name.starts_with(begin),
        None => name == one || name.split('#').next() == Some(one),
    })
}

/// Particles in a prediction of the fresh experiments.
pub const PREDICTED: usize = PARTICLES;
