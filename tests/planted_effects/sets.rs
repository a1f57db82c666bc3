//! The sets: every effect at three strengths, nothing at all, and traps.

use std::sync::Arc;

use serde_json::{Value, json};

use crate::campaign::{Campaign, FOREIGN, Row, Spread, System};
use crate::contact::{Tangential, critical_slope};
use crate::gain::{Gain, gain};
use crate::plant::{self, Plant};
use crate::set_rng::SetRng;
use crate::world::World;

/// What a set is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// One effect.
    Planted,
    /// No effect: there must be no finding.
    Null,
    /// Two effects.
    Pair,
    /// One effect, and a column that follows its input.
    Decoy,
    /// A cause outside every known effect.
    Unknown,
    /// Rows that cannot be used.
    Broken,
    /// Too few rows to distinguish effects.
    Few,
    /// The published tungsten campaign.
    Migraine,
}

/// One set: a campaign, its world, the measurements and their information.
pub struct Set {
    pub name: String,
    pub kind: Kind,
    pub campaign: Campaign,
    pub world: World,
    pub rows: Vec<Row>,
    pub csv: String,
    pub broken_lines: Vec<usize>,
    pub gain: Gain,
}

/// The design of a set: its campaign and its planted effects.
pub struct Design {
    pub campaign: Campaign,
    pub plants: Vec<Plant>,
}

/// Name, kind and recipe of a set; nothing is drawn before `make`.
pub struct Recipe {
    pub name: String,
    pub kind: Kind,
    plan: Box<dyn Fn(&mut SetRng) -> Design + Send + Sync>,
}

/// Least gain of the data [nats].
const LEAST: Gain = Gain { over_base: 30.0, over_refitted: 20.0, least_plant: 30.0 };

impl Recipe {
    pub fn new(
        name: String,
        kind: Kind,
        plan: impl Fn(&mut SetRng) -> Design + Send + Sync + 'static,
    ) -> Self {
        Self { name, kind, plan: Box::new(plan) }
    }

    /// The set of this seed: redrawn until the data are informative.
    pub fn make(&self, seed: u64) -> Set {
        let mut rng = SetRng::new(seed, &self.name);
        for _ in 0..200 {
            let set = self.draw(&mut rng);
            if self.is_informative(&set) {
                return set;
            }
        }
        panic!("{}: no draw can be distinguished from its base", self.name);
    }

    fn draw(&self, rng: &mut SetRng) -> Set {
        let Design { campaign, plants } = (self.plan)(rng);
        let plants = plants.into_iter().map(Arc::new).collect();
        let world = World { contact: campaign.system.contact(), tangential: campaign.law, plants };
        let rows = campaign.run(&world, rng);
        let gain = gain(&campaign, &world, &rows);
        let (csv, broken_lines) = campaign.csv(&rows, rng);
        Set { name: self.name.clone(), kind: self.kind, campaign, world, rows, csv, broken_lines, gain }
    }

    /// Whether the data distinguish the truth from the base, from a refitted base, and each plant from its absence.
    fn is_informative(&self, set: &Set) -> bool {
        match self.kind {
            Kind::Null | Kind::Few => true,
            Kind::Migraine => set.gain.over_base > LEAST.over_base,
            _ => {
                set.gain.over_base > LEAST.over_base
                    && set.gain.least_plant > LEAST.least_plant
                    && set.gain.over_refitted > LEAST.over_refitted
            }
        }
    }
}

impl Set {
    /// The planted causes.
    pub fn causes(&self) -> Vec<&'static str> {
        self.world.plants.iter().map(|plant| plant.cause).collect()
    }

    /// The model file.
    pub fn model(&self) -> String {
        self.campaign.system.model(self.campaign.law)
    }

    /// The truth, for development.
    pub fn truth(&self) -> Value {
        let plants: Vec<Value> = self
            .world
            .plants
            .iter()
            .map(|plant| {
                let parameters: serde_json::Map<_, _> =
                    plant.parameters.iter().map(|(name, value)| ((*name).into(), json!(value))).collect();
                json!({ "cause": plant.cause, "observable": plant.observable, "parameters": parameters })
            })
            .collect();
        json!({
            "name": self.name, "kind": format!("{:?}", self.kind), "causes": plants, "rows": self.rows.len(),
            "stuck": self.rows.iter().filter(|row| row.stuck).count(),
            "base_law": format!("{:?}", self.campaign.law), "noise_e_n": self.campaign.noise_e_n, "noise_e_t": self.campaign.noise_e_t,
            "spread": format!("{:?}", self.campaign.spread), "outliers": self.campaign.outliers,
            "gain_nats": self.gain_block(),
            "rejected_lines": self.broken_lines,
        })
    }

    /// The gains, if anything is planted.
    fn gain_block(&self) -> Value {
        if self.world.plants.is_empty() {
            return Value::Null;
        }
        let Gain { over_base, over_refitted, least_plant } = self.gain;
        json!({ "over_base": over_base, "over_refitted_base": over_refitted, "least_plant": least_plant })
    }

    /// The name without its index: a row of the table.
    pub fn family(&self) -> &str {
        self.name.split(':').next().unwrap()
    }
}

/// Every effect that is planted, as the table in physics.md has them; oblique-angle stands twice, for both signs.
pub const EFFECTS: [&str; 18] = [
    "yield-ratio",
    "adhesion-energy",
    "oblique-angle",
    "oblique-angle-rise",
    "gas-lift",
    "sliding-to-rolling",
    "tangential-compliance",
    "nano-roughness",
    "micro-roughness",
    "agglomerates",
    "powder-layer",
    "liquid-film",
    "melting-transition",
    "conversion-transition",
    "thermal-softening",
    "size-dependent-yield",
    "strain-rate-hardening",
    "viscoelastic-loss",
];

/// The sets that this run is asked for: `NEARWALL_PLANTED_SETS` repeats (1), and of those only
/// `NEARWALL_PLANTED_ONLY`, a name (`gas-lift:2`) or a family (`gas-lift`), several with commas.
pub fn wanted() -> Vec<Recipe> {
    let repeats = std::env::var("NEARWALL_PLANTED_SETS").map_or(1, |count| count.parse().unwrap());
    let mut all = recipes(repeats);
    all.retain(|recipe| is_wanted(&recipe.name));
    all
}

/// Whether `NEARWALL_PLANTED_ONLY` lets a set run; `weak*` stands for every name that begins with `weak`.
pub fn is_wanted(name: &str) -> bool {
    let Ok(only) = std::env::var("NEARWALL_PLANTED_ONLY") else { return true };
    only.split(',').any(|one| match one.strip_suffix('*') {
        Some(begin) => name.starts_with(begin),
        None => name == one || name.split(':').next() == Some(one),
    })
}

/// All sets, each effect `repeats` times at three strengths.
pub fn recipes(repeats: usize) -> Vec<Recipe> {
    let mut all = planted(repeats);
    all.extend((0..20 * repeats).map(null));
    all.extend((0..repeats).flat_map(traps));
    let migraine = |index| Recipe::new(format!("migraine:{index}"), Kind::Migraine, crate::migraine::plan);
    all.extend((0..repeats).map(migraine));
    all
}

fn planted(repeats: usize) -> Vec<Recipe> {
    let one = |effect: &'static str, index: usize| {
        Recipe::new(format!("{effect}:{index}"), Kind::Planted, move |rng| plan(effect, index % 3, rng))
    };
    EFFECTS.iter().flat_map(|effect| (0..3 * repeats).map(move |index| one(effect, index))).collect()
}

/// No effect, a dozen nuisance columns, a different kind of noise in each.
fn null(index: usize) -> Recipe {
    Recipe::new(format!("null:{index}"), Kind::Null, move |rng| {
        let system = [System::Wax, System::Tungsten][index % 2];
        let mut campaign = Campaign::new(system, any_law(system, rng), rng);
        campaign.extras = FOREIGN.to_vec();
        campaign.spread =
            [Spread::Even, Spread::Random, Spread::WithSpeed, Spread::WithForeign][index / 2 % 4];
        campaign.outliers = if index % 5 == 4 { 0.0 } else { 0.02 };
        Design { campaign, plants: vec![] }
    })
}

/// Sixteen traps.
fn traps(repeat: usize) -> Vec<Recipe> {
    let mut all: Vec<Recipe> = DECOYS.iter().map(|(effect, input)| decoy(effect, input, repeat)).collect();
    all.extend(PAIRS.iter().map(|(one, other)| pair(one, other, repeat)));
    all.extend((2 * repeat..2 * repeat + 2).flat_map(|index| [unknown_number(index), unknown_group(index)]));
    all.extend((2 * repeat..2 * repeat + 2).flat_map(|index| [broken(index), few(index)]));
    all
}

/// Effect, and the input that the decoy is correlated with.
const DECOYS: [(&str, &str); 4] = [
    ("thermal-softening", "T_p"),
    ("powder-layer", "layer_thickness"),
    ("conversion-transition", "conversion"),
    ("size-dependent-yield", "d"),
];

/// Two effects on different inputs.
pub const PAIRS: [(&str, &str); 4] = [
    ("powder-layer", "thermal-softening"),
    ("agglomerates", "sliding-to-rolling"),
    ("size-dependent-yield", "oblique-angle"),
    ("liquid-film", "gas-lift"),
];

fn decoy(effect: &'static str, input: &'static str, repeat: usize) -> Recipe {
    Recipe::new(format!("decoy-{effect}:{repeat}"), Kind::Decoy, move |rng| {
        let mut plan = plan(effect, 1, rng);
        plan.campaign.needs("humidity");
        plan.campaign.follow(input, rng);
        plan
    })
}

/// Both effects at full strength, in a campaign that has the ranges of both.
fn pair(one: &'static str, other: &'static str, repeat: usize) -> Recipe {
    Recipe::new(format!("pair-{one}-{other}:{repeat}"), Kind::Pair, move |rng| plan_pair(one, other, rng))
}

/// The design of a pair.
pub fn plan_pair(one: &'static str, other: &'static str, rng: &mut SetRng) -> Design {
    let system = if other == "oblique-angle" { System::Tungsten } else { System::Wax };
    let law = law_for(other, system, rng);
    let mut campaign = Campaign::new(system, law, rng);
    campaign.rows = 600 + rng.below(401);
    campaign.noise_e_n = campaign.noise_e_n.min(0.05);
    let plants =
        [one, other].into_iter().map(|effect| plant_effect(effect, 0.9, &mut campaign, rng)).collect();
    Design { campaign, plants }
}

fn unknown_number(index: usize) -> Recipe {
    Recipe::new(format!("unknown-humidity:{index}"), Kind::Unknown, move |rng| {
        let system = any_system(rng);
        let mut campaign = Campaign::new(system, any_law(system, rng), rng);
        campaign.needs("humidity");
        Design { plants: vec![plant::unknown_number(rng.uniform((0.3, 0.6)))], campaign }
    })
}

fn unknown_group(index: usize) -> Recipe {
    Recipe::new(format!("unknown-batch:{index}"), Kind::Unknown, move |rng| {
        let system = any_system(rng);
        let mut campaign = Campaign::new(system, any_law(system, rng), rng);
        campaign.needs("batch");
        let size = rng.uniform((0.2, 0.4));
        Design { plants: vec![plant::unknown_group(vec![0.0, -size, 0.3 * size, 0.8 * size])], campaign }
    })
}

/// One effect, blanks, and invalid rows.
fn broken(index: usize) -> Recipe {
    Recipe::new(format!("broken:{index}"), Kind::Broken, move |rng| {
        let effect = ["powder-layer", "yield-ratio", "oblique-angle", "melting-transition"][rng.below(4)];
        let mut plan = plan(effect, 2, rng);
        plan.campaign.blanks = 0.12;
        plan.campaign.broken = 6 + rng.below(7);
        plan
    })
}

/// Too few rows.
fn few(index: usize) -> Recipe {
    Recipe::new(format!("few:{index}"), Kind::Few, move |rng| {
        let mut plan = plan(EFFECTS[rng.below(EFFECTS.len())], 0, rng);
        plan.campaign.rows = 15 + rng.below(6);
        plan
    })
}

/// One effect at level 0, 1 or 2, in a campaign in which it is visible.
pub fn plan(effect: &'static str, level: usize, rng: &mut SetRng) -> Design {
    let strength = (level as f64 / 2.0 + rng.uniform((-0.2, 0.2))).clamp(0.0, 1.0);
    let system = system_for(effect, rng);
    let law = law_for(effect, system, rng);
    let mut campaign = Campaign::new(system, law, rng);
    let plants = vec![plant_effect(effect, strength, &mut campaign, rng)];
    Design { campaign, plants }
}

pub fn any_system(rng: &mut SetRng) -> System {
    [System::Wax, System::Tungsten][rng.below(2)]
}

/// The system in which the effect occurs.
pub fn system_for(effect: &str, rng: &mut SetRng) -> System {
    match effect {
        "gas-lift" | "powder-layer" | "liquid-film" | "melting-transition" | "viscoelastic-loss" => {
            System::Wax
        }
        "conversion-transition" => System::Char,
        _ => any_system(rng),
    }
}

pub fn any_law(system: System, rng: &mut SetRng) -> Tangential {
    let e_t = rounded(rng.uniform(if system == System::Tungsten { (0.75, 0.95) } else { (0.65, 0.85) }));
    let friction = rounded(rng.uniform((0.1, 0.35)));
    [Tangential::Constant(e_t), Tangential::SlidingRolling { friction }][rng.below(2)]
}

/// Rounded to three places, so that the model file contains it exactly.
pub fn rounded(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

/// The base law on which the effect can be planted.
pub fn law_for(effect: &str, system: System, rng: &mut SetRng) -> Tangential {
    let friction = rounded(rng.uniform((0.12, 0.35)));
    match effect {
        "sliding-to-rolling" if rng.chance(0.5) => Tangential::Sliding { friction },
        "sliding-to-rolling" => Tangential::Constant(rounded(rng.uniform((0.65, 0.85)))),
        "tangential-compliance" if rng.chance(0.7) => Tangential::SlidingRolling { friction },
        "tangential-compliance" => Tangential::Constant(rounded(rng.uniform((0.65, 0.8)))),
        _ => any_law(system, rng),
    }
}

/// Friction of the law, or one of this campaign's own.
fn friction_of(law: Tangential, rng: &mut SetRng) -> f64 {
    match law {
        Tangential::Sliding { friction } | Tangential::SlidingRolling { friction } => friction,
        Tangential::Constant(_) => rng.uniform((0.12, 0.35)),
    }
}

/// Sets the campaign's ranges so that the effect is visible, and plants it.
pub fn plant_effect(effect: &'static str, strength: f64, campaign: &mut Campaign, rng: &mut SetRng) -> Plant {
    solid_effect(effect, strength, campaign, rng)
        .or_else(|| scatter_effect(effect, strength, campaign, rng))
        .or_else(|| surface_effect(effect, strength, campaign, rng))
        .or_else(|| particle_effect(effect, strength, campaign, rng))
        .or_else(|| oblique_effect(effect, strength, campaign, rng))
        .unwrap_or_else(|| panic!("{effect} is no effect"))
}

/// Effects on the solids.
fn solid_effect(effect: &str, strength: f64, campaign: &mut Campaign, rng: &mut SetRng) -> Option<Plant> {
    let tungsten = campaign.system == System::Tungsten;
    let contact = campaign.system.contact();
    let plant = match effect {
        "yield-ratio" => {
            let factor = 1.15 + 0.85 * strength;
            plant::yield_ratio(contact.yield_ratio * if rng.chance(0.7) { factor } else { 1.0 / factor })
        }
        "adhesion-energy" => {
            let factor = if rng.chance(0.7) { 0.85 - 0.7 * strength } else { 1.2 + 1.5 * strength };
            slow_down(campaign, factor.max(1.0));
            plant::adhesion_energy(contact.adhesion * factor)
        }
        "thermal-softening" => softening(strength, campaign, rng),
        "size-dependent-yield" => {
            campaign.d = if tungsten { (4e-6, 24e-6) } else { (35e-6, 180e-6) };
            let middle = (campaign.d.0 * campaign.d.1).sqrt();
            plant::size_dependent_yield(strength, rng.log_uniform((middle, campaign.d.1)))
        }
        "strain-rate-hardening" => plant::strain_rate_hardening(
            strength,
            rng.uniform(if tungsten { (4.0, 8.0) } else { (1.5, 3.5) }),
        ),
        _ => return None,
    };
    Some(plant)
}

/// Effects with hidden draws.
fn scatter_effect(effect: &str, strength: f64, campaign: &mut Campaign, rng: &mut SetRng) -> Option<Plant> {
    let plant = match effect {
        "nano-roughness" => {
            slow_down(campaign, 1.0);
            plant::nano_roughness(strength, rng.uniform((0.5, 1.2)))
        }
        "micro-roughness" => {
            campaign.theta = (15.0, 80.0);
            plant::micro_roughness(0.03 + 0.09 * strength)
        }
        "agglomerates" => {
            let low = rng.uniform((0.6, 0.66));
            plant::agglomerates(0.05 + 0.25 * strength, low, rng.uniform((0.85, 0.97)))
        }
        _ => return None,
    };
    Some(plant)
}

/// Effects of layers, films and gas.
fn surface_effect(effect: &str, strength: f64, campaign: &mut Campaign, rng: &mut SetRng) -> Option<Plant> {
    let plant = match effect {
        "gas-lift" => {
            campaign.needs("v_gas");
            campaign.theta = (5.0, 80.0);
            campaign.v_gas = (0.0, 30.0);
            plant::gas_lift(strength, rng.uniform((10.0, 20.0)), rng.uniform((0.2, 0.4)))
        }
        "powder-layer" => {
            campaign.needs("layer_thickness");
            campaign.layer = (2e-5, 1.5e-3);
            plant::powder_layer(strength, rng.uniform((0.08e-3, 0.25e-3)), rng.uniform((0.8, 1.6)))
        }
        "liquid-film" => {
            campaign.needs("film_thickness");
            campaign.film = (2e-6, 2e-4);
            let viscosity = 0.3e-3 * 8_f64.powf(strength);
            plant::liquid_film(viscosity, campaign.system.contact().density, rng.uniform((1e-6, 3e-6)))
        }
        _ => return None,
    };
    Some(plant)
}

/// Effects of the particle's state and speed.
fn particle_effect(effect: &str, strength: f64, campaign: &mut Campaign, rng: &mut SetRng) -> Option<Plant> {
    let plant = match effect {
        "melting-transition" => melting(strength, campaign, rng),
        "conversion-transition" => {
            campaign.needs("conversion");
            let (threshold, width) = (rng.uniform((0.84, 0.91)), rng.uniform((0.02, 0.08)));
            campaign.conversion = (0.4, (threshold + 0.02 + 0.14 * strength).min(1.0));
            plant::conversion_transition(threshold, width)
        }
        "viscoelastic-loss" => plant::viscoelastic_loss(strength, rng.uniform((3.0, 6.0))),
        _ => return None,
    };
    Some(plant)
}

/// Effects of the angle, and on the tangential law.
fn oblique_effect(effect: &str, strength: f64, campaign: &mut Campaign, rng: &mut SetRng) -> Option<Plant> {
    let tungsten = campaign.system == System::Tungsten;
    let plant = match effect {
        "oblique-angle" | "oblique-angle-rise" => {
            campaign.theta = (3.0, rng.uniform((70.0, 80.0)));
            let sign = if effect == "oblique-angle" { -1.0 } else { 1.0 };
            plant::oblique_angle(strength, sign, if tungsten { 3.0 } else { 1.0 })
        }
        "sliding-to-rolling" => {
            let friction = friction_of(campaign.law, rng);
            let stiffness_ratio = campaign.system.contact().stiffness_ratio();
            let end = critical_slope(friction, 0.35, stiffness_ratio).atan().to_degrees();
            campaign.theta = (end * (0.75 - 0.65 * strength), 75.0);
            plant::sliding_to_rolling(friction, rng.uniform((0.02, 0.08)))
        }
        "tangential-compliance" => compliance(strength, campaign, rng),
        _ => return None,
    };
    Some(plant)
}

/// Impacts from about the sticking speed to some four times that.
pub fn slow_down(campaign: &mut Campaign, factor: f64) {
    let mut contact = campaign.system.contact();
    contact.adhesion *= factor;
    let speed = contact.sticking_speed((campaign.d.0 * campaign.d.1).sqrt());
    campaign.v_n = (0.6 * speed, 4.5 * speed);
}

/// On a constant law, only impacts that do not slide, so that no other effect is missing.
fn compliance(strength: f64, campaign: &mut Campaign, rng: &mut SetRng) -> Plant {
    let constant = matches!(campaign.law, Tangential::Constant(_));
    let friction = if constant { rng.uniform((0.3, 0.45)) } else { friction_of(campaign.law, rng) };
    let critical = critical_slope(friction, 0.3, campaign.system.contact().stiffness_ratio());
    let top = critical.atan().to_degrees();
    campaign.theta = if constant { (2.0, 0.9 * top) } else { (2.0, (1.8 * top).min(75.0)) };
    plant::tangential_compliance(strength, friction, rng.uniform((0.88, 0.97)))
}

fn melting(strength: f64, campaign: &mut Campaign, rng: &mut SetRng) -> Plant {
    let half = rng.uniform((348.0, 362.0));
    campaign.t_p = (290.0, (half + 4.0 + 40.0 * strength).min(400.0));
    plant::melting_transition(half, half - 32.0, rng.uniform((3.0, 6.0)), rng.uniform((0.4, 0.9)))
}

fn softening(strength: f64, campaign: &mut Campaign, rng: &mut SetRng) -> Plant {
    if campaign.system == System::Tungsten {
        campaign.t_p = (300.0, 2800.0);
        return plant::thermal_softening(strength, rng.uniform((350.0, 900.0)), 2900.0);
    }
    campaign.t_p = (288.0, 342.0);
    plant::thermal_softening(strength, rng.uniform((292.0, 305.0)), 344.0)
}
