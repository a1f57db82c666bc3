//! Following `next_experiments.csv` identifies the planted cause in fewer impacts than a uniform design.
//!
//! Both laboratories begin with the same few experiments, which leave the cause open. In every
//! round they then spend the same number of impacts: one on the best rows of the advice, the other
//! on settings spread evenly over the ranges of what it varies. A laboratory stops when the
//! diagnosis names the planted cause first and alone.

use std::path::Path;

use rayon::prelude::*;
use serde_json::Value;

use crate::effects::{self, CAUSES, Plan};
use crate::expected::is_one_of;
use crate::lab::{Errors, Experiment, Lab, rounded};
use crate::rig::{Observable, WALLS};
use crate::run::{self, Folder};
use crate::score;
use crate::set_rng::SetRng;
use crate::source::{Knob, Source, Spread};

/// Experiments that both laboratories begin with.
const FIRST: usize = 6;
/// Strength of the effect in these, in deviations.
const STRENGTH: (f64, f64) = (2.5, 4.5);
/// Particles of each.
const COUNTS: (f64, f64) = (8.0, 30.0);
/// Particles in a trial of a plan.
const TRIAL: usize = 200;
/// Impacts of a round over those of a first experiment; the last is the cap.
const ROUNDS: [f64; 4] = [2.0, 2.0, 4.0, 6.0];
/// Most experiments of a round.
const EXPERIMENTS: usize = 4;
/// Settings that a laboratory can move when the advice asks for it.
const LEVERS: [Knob; 4] = [Knob::Speed, Knob::Size, Knob::Angle, Knob::Temperature];

/// How a laboratory chooses what to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Design {
    Advice,
    Uniform,
}

/// A rig whose first experiments leave the cause open.
pub struct Start {
    pub name: String,
    plan: Plan,
    experiments: Vec<Experiment>,
    /// Particles of a first experiment.
    count: f64,
    /// Number of settings that the laboratory varies by itself.
    varied: usize,
    /// With the files of the first diagnosis.
    folder: Folder,
    /// What the first diagnosis named.
    said: String,
}

/// What a laboratory needed.
pub struct Course {
    /// Impacts after the first experiments, over those of one of them.
    pub spent: f64,
    pub found: bool,
    /// What was named after each round.
    pub said: Vec<String>,
}

impl Course {
    /// Impacts until the cause is found; as many again are assumed to be missing where it is not.
    fn cost(&self) -> f64 {
        if self.found { self.spent } else { 2.0 * self.spent }
    }
}

/// Both laboratories on one rig, the one that follows the advice first.
pub struct Comparison {
    pub name: String,
    pub seed: u64,
    pub count: f64,
    pub courses: [Course; 2],
}

/// Rigs of this seed whose cause is open after the first experiments, the first ones, and what both
/// laboratories need for it.
pub fn compare(seed: u64, wanted: usize) -> Vec<Comparison> {
    let mut starts: Vec<Start> = Vec::new();
    let mut begin = 0;
    while starts.len() < wanted && begin < 20 * wanted {
        let numbers = begin..begin + wanted;
        begin += wanted;
        starts.extend(
            numbers.into_par_iter().filter_map(|number| Start::open(seed, number)).collect::<Vec<_>>(),
        );
    }
    starts.truncate(wanted);
    let both = |start: Start| {
        let (advice, uniform) =
            rayon::join(|| start.follow(Design::Advice, seed), || start.follow(Design::Uniform, seed));
        for (name, course) in [("advice", &advice), ("uniform", &uniform)] {
            println!("{} {name} {}: {}", start.name, course.spent, course.said.join(" -> "));
        }
        Comparison { name: start.name, seed, count: start.count, courses: [advice, uniform] }
    };
    starts.into_par_iter().map(both).collect()
}

impl Start {
    /// A rig of single impacts whose first diagnosis leaves the cause open; none if it does not.
    fn open(seed: u64, number: usize) -> Option<Self> {
        let mut start = Self::draw(seed, number)?;
        let (identified, said) = start.diagnose(&start.experiments, &start.folder.path, seed);
        start.said = said;
        (!identified).then_some(start)
    }

    /// A rig of single impacts; none if no plan has the strength.
    fn draw(seed: u64, number: usize) -> Option<Self> {
        let cause = CAUSES[number % CAUSES.len()];
        let name = format!("advice-{}#{number}", cause.replace(':', "-"));
        let mut rng = SetRng::new(seed, &name);
        (0..1000).find_map(|_| {
            let mut plan = effects::plan(cause, &mut rng);
            let lab = &plan.lab;
            if !lab.rig.hits_once() || lab.errors == Errors::Absent {
                return None;
            }
            let designs = lab.design(FIRST, &mut rng);
            let strength = rng.uniform(STRENGTH);
            let count = strength.powi(2) / lab.information(&designs, TRIAL, &mut rng)?;
            if !(COUNTS.0..=COUNTS.1).contains(&count) {
                return None;
            }
            let varied = lab.knobs.len();
            let designs = with_levers(&mut plan.lab, designs);
            let measure = |settings| plan.lab.measure(settings, count.round(), &mut rng);
            let experiments = designs.into_iter().map(measure).collect::<Option<Vec<_>>>()?;
            let (name, folder) = (name.clone(), Folder::of(&name));
            let count = count.round();
            Some(Self { name, plan, experiments, count, varied, folder, said: String::new() })
        })
    }

    /// Has experiments diagnosed: whether the planted cause is first and alone, and what is named.
    fn diagnose(&self, experiments: &[Experiment], folder: &Path, seed: u64) -> (bool, String) {
        let diagnosis = run::diagnose(&self.plan.lab, experiments, folder, seed);
        let diagnosis = diagnosis.unwrap_or_else(|message| panic!("{}: {message}", self.name));
        let beside = diagnosis["findings"][0]["indistinguishable_from"].as_array().into_iter().flatten();
        let beside: Vec<&str> = beside.filter_map(Value::as_str).collect();
        // A free curve is no other cause.
        let other = |name: &&str| !name.starts_with("unknown:") && !is_one_of(&self.plan.names, name, &[]);
        let alone = !beside.iter().any(other);
        let mut said = score::said(&diagnosis);
        said.extend(beside.iter().map(|other| format!("~{other}")));
        (alone && score::is_first(&self.plan.names, &diagnosis), said.join(" "))
    }

    /// Measures until the cause is identified.
    fn follow(&self, design: Design, seed: u64) -> Course {
        let name = format!("{}-{design:?}", self.name);
        let folder = Folder::of(&name);
        let folder = folder.path.as_path();
        let mut rng = SetRng::new(seed, &name);
        let mut experiments = self.experiments.clone();
        let mut course = Course { spent: 0.0, found: false, said: vec![self.said.clone()] };
        let shift: Vec<f64> = (0..self.varied).map(|_| rng.unit()).collect();
        for (round, share) in ROUNDS.iter().enumerate() {
            let last = if round == 0 { self.folder.path.as_path() } else { folder };
            let impacts = (share * self.count).round();
            let advised = match design {
                Design::Advice => self.advised(&last.join("out/next_experiments.csv"), impacts),
                Design::Uniform => vec![],
            };
            let settings =
                if advised.is_empty() { self.spread(round * EXPERIMENTS, &shift, impacts) } else { advised };
            for (settings, count) in settings {
                experiments.extend(self.plan.lab.measure(settings, count, &mut rng));
            }
            course.spent += share;
            let (identified, said) = self.diagnose(&experiments, folder, seed);
            course.said.push(said);
            if identified {
                course.found = true;
                break;
            }
        }
        course
    }

    /// Settings spread evenly, with the number of particles of each: a shifted Halton sequence from this place on.
    fn spread(&self, begin: usize, shift: &[f64], impacts: f64) -> Vec<(Vec<f64>, f64)> {
        let lab = &self.plan.lab;
        let at = |index: usize| {
            let mut settings = self.experiments[0].settings.clone();
            for (place, (knob, range)) in lab.knobs.iter().take(self.varied).enumerate() {
                let base = [2, 3, 5, 7, 11][place];
                let share = (radical_inverse(begin + index + 1, base) + shift[place]).fract();
                settings[place] = Lab::within(*knob, *range, share);
            }
            (settings, (impacts / EXPERIMENTS as f64).round())
        };
        (0..EXPERIMENTS).map(at).collect()
    }

    /// The number of particles that a row asks for: its count, or what its error takes; 0 where the cell is blank.
    fn particles(&self, header: &csv::StringRecord, row: &csv::StringRecord) -> f64 {
        let lab = &self.plan.lab;
        let cell = |name: String| {
            let place = header.iter().position(|column| column == name)?;
            row[place].parse::<f64>().ok()
        };
        let wanted = |(index, (observable, wall)): (usize, &(_, usize))| {
            let observable: &Observable = observable;
            let name = format!("{}@{}", observable.name(), WALLS[*wall]);
            let by_error = cell(format!("{name}_err"))
                .map(|error| self.count * (usual_error(&self.experiments, index) / error).powi(2));
            by_error.or_else(|| cell(format!("{name}_n")))
        };
        lab.readings.iter().enumerate().find_map(wanted).unwrap_or(0.0).round()
    }

    /// The best rows of the advice with the number of particles of each, the same number of impacts in all.
    fn advised(&self, path: &Path, impacts: f64) -> Vec<(Vec<f64>, f64)> {
        let lab = &self.plan.lab;
        let Ok(mut table) = csv::Reader::from_path(path) else { return vec![] };
        let header = table.headers().unwrap().clone();
        let mut all: Vec<(Vec<f64>, f64)> = vec![];
        let mut left = impacts;
        for row in table.records() {
            let row = row.unwrap();
            let cell = |name: &str| header.iter().position(|column| column == name).map(|place| &row[place]);
            let set = |(knob, _): &(Knob, _)| Source::value(cell(&lab.source.key(*knob)).unwrap());
            let settings: Vec<f64> = lab.knobs.iter().map(set).collect();
            if all.len() == EXPERIMENTS || left < 1.0 {
                break;
            }
            if all.iter().any(|(known, _)| *known == settings) {
                continue;
            }
            let stated = self.particles(&header, &row);
            let count = stated.max((impacts / EXPERIMENTS as f64).round()).min(left);
            let known = lab.measure(settings.clone(), 1.0, &mut SetRng::new(0, "possible"));
            if known.is_some() {
                left -= count;
                all.push((settings, count));
            }
        }
        if let Some((_, count)) = all.last_mut() {
            *count += left;
        }
        all
    }
}

/// The median of the errors of a reading in the first experiments.
fn usual_error(experiments: &[Experiment], reading: usize) -> f64 {
    let mut all: Vec<f64> = experiments.iter().map(|one| one.readings[reading].sigma).collect();
    all.sort_by(f64::total_cmp);
    all[all.len() / 2]
}

/// Adds the levers that are not varied, as they are in the case, to the settings.
fn with_levers(lab: &mut Lab, mut designs: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    for knob in LEVERS {
        let uniform = knob == Knob::Angle && matches!(lab.source.angle.spread, Spread::Uniform { .. });
        if !uniform && lab.knobs.iter().all(|(known, _)| *known != knob) {
            let middle = rounded(lab.source.get(knob));
            lab.source.set(knob, middle);
            lab.knobs.push((knob, (middle, middle)));
            designs.iter_mut().for_each(|settings| settings.push(middle));
        }
    }
    designs
}

/// The digits of a number behind the point, mirrored.
fn radical_inverse(mut number: usize, base: usize) -> f64 {
    let (mut value, mut unit) = (0.0, 1.0);
    while number > 0 {
        unit /= base as f64;
        value += unit * (number % base) as f64;
        number /= base;
    }
    value
}

/// Prints the table; the impacts of both in all, over those of a first experiment.
pub fn report(all: &[Comparison]) -> [f64; 2] {
    println!("\n| set | particles of a first experiment | advice | uniform |\n|---|---|---|---|");
    for one in all {
        let cell = |course: &Course| {
            let impacts = (course.spent * one.count).round();
            if course.found { format!("{impacts}") } else { format!("> {impacts}") }
        };
        let [advice, uniform] = &one.courses;
        println!(
            "| {} of seed {} | {} | {} | {} |",
            one.name,
            one.seed,
            one.count,
            cell(advice),
            cell(uniform)
        );
    }
    let sum = |place: usize| all.iter().map(|one| one.courses[place].cost()).sum::<f64>();
    let found = |place: usize| all.iter().filter(|one| one.courses[place].found).count();
    println!(
        "| all, in first experiments | | {} (found {}) | {} (found {}) |\n",
        sum(0),
        found(0),
        sum(1),
        found(1)
    );
    [sum(0), sum(1)]
}
