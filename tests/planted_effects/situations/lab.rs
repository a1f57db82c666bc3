//! A laboratory: ranges of the inputs, the model of its file, what acts in truth, and how it measures.

use crate::campaign::{Campaign, System};
use crate::contact::Tangential;
use crate::set_rng::SetRng;
use crate::sets::Design;
use crate::world::{Inputs, Response, World};

/// Distribution of the errors of single values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Noise {
    Normal,
    /// Student's distribution with three degrees of freedom.
    HeavyTails,
    /// Only downwards: the absolute value of a normal number.
    HalfNormal,
    /// Only downwards: an exponential.
    Exponential,
    /// Its deviation grows with the normal speed.
    WithSpeed,
}

/// Rows that share an error.
#[derive(Clone, Debug)]
pub struct Groups {
    /// The column that names the group, if the file has one.
    pub column: Option<&'static str>,
    /// Number of groups; the rows are divided evenly.
    pub count: usize,
    /// The errors of `e_n` and `e_t` that each group shares.
    pub shared: Shared,
    pub common: Common,
}

/// The inputs that all rows of a group have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Common {
    Nothing,
    /// All but speed, angle and size.
    Setting,
    Everything,
}

/// The error of a group.
#[derive(Clone, Copy, Debug)]
pub enum Shared {
    /// Normal, with this deviation in deviations of the noise.
    Drawn(f64),
    /// The same, with errors that belong to the groups: later rows of a group have them, too.
    Kept { size: f64, seed: u64 },
    /// Half of this many deviations of the noise up and down in turn.
    Alternating(f64),
}

/// What the outcome column holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcomes {
    /// There is none; captured impacts are absent.
    Absent,
    /// One impact a row.
    Single,
    /// Classes of at least and at most so many impacts, outcomes of one class correlated.
    Classes { impacts: (u32, u32), correlation: f64 },
}

/// One row.
#[derive(Clone, Debug)]
pub struct Row {
    /// As it happened.
    pub x: Inputs,
    /// As the file has it.
    pub seen: Inputs,
    /// Cells of the laboratory's further columns.
    pub given: Vec<String>,
    pub truth: Response,
    /// By the model file at the inputs of the file.
    pub base: Response,
    /// Deviations of `e_n` and `e_t`.
    pub sigma: [f64; 2],
    pub measured: [Option<f64>; 2],
    pub outcome: Outcome,
}

/// The outcome of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    Unknown,
    Stuck,
    Rebound,
    Counts { impacts: u32, captured: u32 },
}

/// A laboratory.
pub struct Lab {
    pub campaign: Campaign,
    /// The world of the model file.
    pub model: World,
    /// The world that acts.
    pub truth: World,
    /// Share of the difference between both that acts [1].
    pub share: f64,
    /// `[[effects]]` of the model file, which `model` has as plants.
    pub effects: String,
    pub noise: Noise,
    /// Whether `e_n_err` and `e_t_err` are stated.
    pub stated: bool,
    /// Which of `e_n` and `e_t` are measured.
    pub observed: [bool; 2],
    pub outcomes: Outcomes,
    pub groups: Option<Groups>,
    /// Impacts that a row averages, if they are stated.
    pub averaged: Option<u32>,
    /// Names of the further columns.
    pub given: Vec<&'static str>,
}

impl Lab {
    /// Nothing acts beside the base.
    pub fn new(system: System, law: Tangential, rng: &mut SetRng) -> Self {
        Self::of(Design { campaign: Campaign::new(system, law, rng), plants: vec![] })
    }

    /// The laboratory of a design.
    pub fn of(design: Design) -> Self {
        let Design { campaign, plants } = design;
        let world = |plants| World { contact: campaign.system.contact(), tangential: campaign.law, plants };
        Self {
            model: world(vec![]),
            truth: world(plants.into_iter().map(std::sync::Arc::new).collect()),
            campaign,
            share: 1.0,
            effects: String::new(),
            noise: Noise::Normal,
            stated: false,
            observed: [true; 2],
            outcomes: Outcomes::Single,
            groups: None,
            averaged: None,
            given: vec![],
        }
    }

    /// Speeds so far above sticking that every impact rebounds.
    pub fn fast(&mut self) {
        let speed = self.truth.contact.sticking_speed(self.campaign.d.0);
        let ends = self.campaign.v_n;
        self.campaign.v_n = (ends.0.max(4.0 * speed), ends.1.max(15.0 * speed));
    }

    /// Adds a plant.
    pub fn plant(&mut self, plant: crate::plant::Plant) {
        self.truth.plants.push(std::sync::Arc::new(plant));
    }

    /// No input but the speed varies, and no column is irrelevant.
    pub fn only_speed(&mut self) {
        let campaign = &mut self.campaign;
        campaign.columns.clear();
        campaign.extras.clear();
        for range in [&mut campaign.d, &mut campaign.t_p, &mut campaign.theta] {
            let middle = (range.0 + range.1) / 2.0;
            *range = (middle, middle);
        }
    }

    /// The truth at these inputs.
    pub fn response(&self, x: &Inputs, draws: [f64; 2]) -> Response {
        let truth = self.truth.truth(x, draws);
        if self.share == 1.0 {
            return truth;
        }
        let base = self.model.truth(x, draws);
        let mix = |base: f64, truth: f64| base + self.share * (truth - base);
        Response { stick: truth.stick, e_n: mix(base.e_n, truth.e_n), e_t: mix(base.e_t, truth.e_t) }
    }

    /// What the model file says of a row of the file.
    pub fn base(&self, seen: &Inputs) -> Response {
        self.model.truth(seen, [0.5; 2])
    }

    /// Root mean square of the effect on the rebounds' `e_n` and `e_t`.
    pub fn effect(&self, rng: &mut SetRng) -> [f64; 2] {
        let (mut sums, mut count) = ([0.0; 2], 0.0);
        for _ in 0..1000 {
            let x = self.campaign.inputs(rng);
            let (base, truth) = (self.base(&x), self.response(&x, [0.5; 2]));
            if base.stick < 0.5 && truth.stick < 0.5 {
                sums[0] += (truth.e_n - base.e_n).powi(2);
                sums[1] += (truth.e_t - base.e_t).powi(2);
                count += 1.0;
            }
        }
        sums.map(|sum| f64::sqrt(sum / f64::max(count, 1.0)))
    }

    /// Makes the effect on `e_n` so many deviations of the noise: by less of the effect, or by less noise.
    pub fn scale_effect(&mut self, deviations: f64, rng: &mut SetRng) {
        let [effect, _] = self.effect(rng);
        self.share = (deviations * self.campaign.noise_e_n / effect).min(1.0);
        self.campaign.noise_e_n = self.share * effect / deviations;
    }

    /// Draws so many rows.
    pub fn rows(&self, count: usize, rng: &mut SetRng) -> Vec<Row> {
        let mut rows = vec![];
        let groups = self.groups.as_ref().map_or(1, |groups| groups.count);
        for group in 0..groups {
            let errors = self.group_errors(group, rng);
            let from = rows.len();
            while rows.len() * groups < count * (group + 1) {
                let x = self.inputs(rows.get(from), rng);
                if let Some(mut row) = self.measure(x, errors, rng) {
                    let named = self.groups.iter().filter(|groups| groups.column.is_some());
                    row.given = named.map(|_| format!("{}", group + 1)).collect();
                    rows.push(row);
                }
            }
        }
        rows
    }

    /// The inputs of a row of the group that begins with `first`.
    fn inputs(&self, first: Option<&Row>, rng: &mut SetRng) -> Inputs {
        let own = self.campaign.inputs(rng);
        let common = self.groups.as_ref().map_or(Common::Nothing, |groups| groups.common);
        match (common, first) {
            (Common::Everything, Some(first)) => first.x,
            (Common::Setting, Some(first)) => Inputs { v_n: own.v_n, v_t: own.v_t, d: own.d, ..first.x },
            _ => own,
        }
    }

    fn group_errors(&self, group: usize, rng: &mut SetRng) -> [f64; 2] {
        let Some(groups) = &self.groups else { return [0.0; 2] };
        [self.campaign.noise_e_n, self.campaign.noise_e_t].map(|noise| match groups.shared {
            Shared::Drawn(size) => noise * size * rng.normal(),
            Shared::Kept { size, seed } => {
                noise * size * SetRng::new(seed, &format!("{group}{noise}")).normal()
            }
            Shared::Alternating(size) => noise * size * if group.is_multiple_of(2) { -0.5 } else { 0.5 },
        })
    }

    /// Measures an impact; `None` if it is captured and captures are absent.
    pub fn measure(&self, x: Inputs, shared: [f64; 2], rng: &mut SetRng) -> Option<Row> {
        let truth = self.response(&x, [rng.unit(), rng.unit()]);
        let outcome = match self.outcomes {
            Outcomes::Classes { impacts, correlation } => {
                let count = impacts.0 + rng.below((impacts.1 - impacts.0 + 1) as usize) as u32;
                Outcome::Counts {
                    impacts: count,
                    captured: rng.beta_binomial(count, truth.stick, correlation),
                }
            }
            _ if rng.chance(truth.stick) => Outcome::Stuck,
            Outcomes::Single => Outcome::Rebound,
            Outcomes::Absent => Outcome::Unknown,
        };
        if outcome == Outcome::Stuck && self.outcomes == Outcomes::Absent {
            return None;
        }
        let scale = if self.stated { rng.uniform((0.7, 1.4)) } else { 1.0 } * self.spread(&x);
        let sigma = [self.campaign.noise_e_n * scale, self.campaign.noise_e_t * scale];
        let single = matches!(outcome, Outcome::Rebound | Outcome::Unknown);
        let means = [truth.e_n, truth.e_t];
        let measured = std::array::from_fn(|i| {
            let error = self.error(means[i], sigma[i], rng);
            (single && self.observed[i]).then(|| (means[i] + shared[i] + error).max(0.0))
        });
        let base = self.base(&x);
        Some(Row { x, seen: x, given: vec![], truth, base, sigma, measured, outcome })
    }

    /// Of the deviation, by speed.
    fn spread(&self, x: &Inputs) -> f64 {
        let (low, high) = self.campaign.v_n;
        if self.noise == Noise::WithSpeed { 0.3 + 1.7 * (x.v_n / low).ln() / (high / low).ln() } else { 1.0 }
    }

    fn error(&self, mean: f64, deviation: f64, rng: &mut SetRng) -> f64 {
        match self.noise {
            Noise::Normal | Noise::WithSpeed => rng.noise(mean, deviation),
            Noise::HalfNormal => -rng.noise(mean, deviation).abs(),
            Noise::Exponential => (deviation * (1.0 - rng.unit()).ln()).max(-mean),
            Noise::HeavyTails => {
                let square = (0..3).map(|_| rng.normal().powi(2)).sum::<f64>() / 3.0;
                (deviation * rng.normal() / square.sqrt()).clamp(-mean, mean)
            }
        }
    }
}
