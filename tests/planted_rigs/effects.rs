//! What is planted in a rig, and the rig in which it shows.

use std::sync::Arc;

use crate::campaign::System;
use crate::contact::Tangential;
use crate::lab::{Errors, Lab, rounded};
use crate::own_laws::{melting, powder_layer, size, softening, viscous};
use crate::plant::{self, Plant};
use crate::rig::{Observable, Rig, Shape};
use crate::set_rng::SetRng;
use crate::source::{Knob, Source, Spread, State};
use crate::world::World;

use Observable::{
    CaptureEfficiency, Captured, CapturedFrom, CapturedSize, MeanEn, MeanEt, QuantileEn, ShareEnBelow,
};

/// A laboratory, and what is right to say of its measurements.
pub struct Plan {
    pub lab: Lab,
    /// Right names of the planted cause; none for a null.
    pub names: Vec<&'static str>,
    /// Cause, name and true value of parameters of the library's own laws.
    pub parameters: Vec<(&'static str, &'static str, f64)>,
    /// Whether the true law is one that the library has.
    pub own: bool,
}

/// Every planted cause.
pub const CAUSES: [&str; 19] = [
    "melting-transition",
    "conversion-transition",
    "conversion-decline",
    "adhesion-energy",
    "yield-ratio",
    "powder-layer",
    "oblique-angle",
    "thermal-softening",
    "size-dependent-yield",
    "strain-rate-hardening",
    "viscoelastic-loss",
    "gas-lift",
    "sliding-to-rolling",
    "calibration:normal.e_n",
    "calibration:tangential.e_t",
    "calibration:tangential.friction",
    "unknown-hump",
    "unknown-sticky-hump",
    "unknown-wall-hump",
];

/// Middle of the speeds, sizes and temperatures of a system.
fn source(system: System, spread: bool) -> Source {
    let (speed, d, t, sizes) = match system {
        System::Wax => (2.0, 80e-6, 300.0, (30e-6, 160e-6)),
        System::Tungsten => (5.0, 10e-6, 300.0, (3e-6, 30e-6)),
        System::Char => (3.0, 80e-6, 1600.0, (30e-6, 160e-6)),
        System::HotTungsten => (5.0, 12e-6, 2900.0, (4e-6, 30e-6)),
    };
    let fixed = State::fixed;
    let mut source = Source {
        speed: fixed(speed),
        angle: fixed(70.0),
        diameter: fixed(d),
        temperature: fixed(t),
        conversion: 0.5,
        wall_temperature: 295.0,
        layer: 0.0,
        gas_speed: 0.0,
        gas_temperature: 300.0,
        offset: [0.0; 2],
    };
    if spread {
        source.speed = State::normal(speed, 0.1 * speed, (0.02 * speed, 20.0 * speed));
        source.angle.spread = Spread::Uniform { half: 15.0 };
        source.diameter.spread = Spread::RosinRammler { exponent: 4.0, min: sizes.0, max: sizes.1 };
        source.temperature = State::normal(t, 0.01 * t, (0.5 * t, 2.0 * t));
    }
    source
}

/// A laboratory of this system with nothing planted.
pub fn lab(system: System, law: Tangential, rng: &mut SetRng) -> Lab {
    let world = || World { contact: system.contact(), tangential: law, plants: vec![] };
    Lab {
        rig: Rig::new(Shape::Shot, 10.0),
        system,
        law,
        constant_e_n: None,
        effects: String::new(),
        source: source(system, rng.chance(0.5)),
        knobs: vec![],
        readings: vec![(MeanEn, 0)],
        deviation: rounded(rng.log_uniform((0.05, 0.3))),
        errors: [Errors::Stated, Errors::Counts, Errors::Counts, Errors::Absent][rng.below(4)],
        base: world(),
        truth: world(),
        liquid: None,
        case_error: None,
    }
}

impl Lab {
    fn base_plant(&mut self, plant: Plant) {
        let plant = Arc::new(plant);
        self.base.plants.push(plant.clone());
        self.truth.plants.push(plant);
    }

    /// Replaces Thornton–Ning by a constant.
    pub fn constant(&mut self, e_n: f64) {
        self.constant_e_n = Some(e_n);
        self.base_plant(level(e_n));
    }

    /// A base that melts or burns out.
    pub fn sticky_base(&mut self, kind: &'static str, at: f64, width: f64) {
        let (name, plant) = match kind {
            "melting-transition" => ("temperature", melting(at, width, 0.0)),
            _ => ("threshold", conversion(at, width)),
        };
        self.effects +=
            &format!("\n[[effects]]\nkind = \"{kind}\"\n{name} = {at}\nwidth = {width}\nsoftening = 0\n");
        self.base_plant(plant);
    }

    /// Further settings that vary, besides the first.
    fn vary(&mut self, knobs: &[(Knob, (f64, f64))], rng: &mut SetRng) {
        for (knob, range) in knobs {
            if rng.chance(0.4) && self.knobs.iter().all(|one| one.0 != *knob) {
                self.knobs.push((*knob, *range));
            }
        }
    }

    /// Lets some rigs have more than one impact.
    fn again(&mut self, rng: &mut SetRng) {
        match rng.below(4) {
            0 => self.rig = Rig::new(Shape::Bounce, rounded(rng.log_uniform((0.02, 0.3)))),
            1 => self.rig.shape = Shape::Channel,
            _ => {}
        }
    }

    /// Readings of capture.
    fn captures(&mut self, rng: &mut SetRng) {
        let (channel, once) = (self.rig.shape == Shape::Channel, self.rig.hits_once());
        let sizes = matches!(self.source.diameter.spread, Spread::RosinRammler { .. })
            && self.knobs.iter().all(|(knob, _)| *knob != Knob::Size);
        let angles = self.source.angle.spread != Spread::Fixed;
        self.readings = match rng.below(5) {
            0 => vec![(Captured, 0)],
            1 => vec![(CaptureEfficiency, 0), (MeanEn, 0)],
            2 if once && angles => along(self),
            2 | 3 if sizes => by_size(self),
            3 => vec![(Captured, 0), (MeanEn, 0)],
            _ => vec![(CaptureEfficiency, 0)],
        };
        if channel {
            self.readings.push((Captured, 1));
        }
    }

    /// Readings of `e_n`.
    fn restitutions(&mut self, rng: &mut SetRng) {
        let usual = self.system.contact().restitution(self.source.speed.middle, self.source.diameter.middle);
        self.readings = match rng.below(5) {
            0 => vec![(MeanEn, 0), (MeanEt, 0)],
            3 if self.source.speed.spread != Spread::Fixed => vec![(ShareEnBelow(rounded(usual)), 0)],
            1 => vec![(MeanEn, 0), (Captured, 0)],
            2 if self.source.speed.spread != Spread::Fixed => vec![(MeanEn, 0), (QuantileEn(0.9), 0)],
            _ => vec![(MeanEn, 0)],
        };
        if self.rig.shape == Shape::Channel {
            self.readings.push((MeanEn, 1));
        }
    }
}

/// Capture in three bins along the wall.
fn along(lab: &Lab) -> Vec<(Observable, usize)> {
    let middle = lab.source.angle.middle;
    let place = |angle: f64| crate::rig::START / angle.to_radians().tan();
    let bounds = [0.0, place(middle + 6.0), place(middle - 5.0), 2.0 * place(middle - 15.0)].map(rounded);
    bounds.windows(2).map(|pair| (CapturedFrom(pair[0], pair[1]), 0)).collect()
}

/// Capture in three classes of size.
fn by_size(lab: &Lab) -> Vec<(Observable, usize)> {
    let d = lab.source.diameter.middle;
    let bounds = [0.3 * d, 0.85 * d, 1.05 * d, 4.0 * d].map(rounded);
    bounds.windows(2).map(|pair| (CapturedSize(pair[0], pair[1]), 0)).collect()
}

/// A constant `e_n`.
fn level(e_n: f64) -> Plant {
    Plant::normal("constant", move |_, _, n| (n.e_n, n.stick) = (e_n, 0.0))
}

/// The stickiness `1/(1 + exp((threshold - X)/width))`.
fn conversion(threshold: f64, width: f64) -> Plant {
    Plant::normal("conversion-transition", move |x, _, n| {
        n.stick = n.stick.max(1.0 / (1.0 + ((threshold - x.conversion) / width).exp()));
    })
    .with("threshold", threshold)
    .with("width", width)
}

/// Past `peak` the stickiness falls in a straight line to `residual` at full conversion.
fn decline(peak: f64, residual: f64) -> Plant {
    Plant::normal("conversion-decline", move |x, _, n| {
        if n.e_n > 0.0 && x.conversion > peak {
            n.stick *= 1.0 - (1.0 - residual) * (x.conversion - peak) / (1.0 - peak);
        }
    })
    .with("peak", peak)
    .with("residual", residual)
}

/// `e_n (1 + strength v_gas cos(alpha))`.
fn gas_lift(strength: f64) -> Plant {
    Plant::normal("gas-lift", move |x, _, n| {
        n.e_n *= 1.0 + strength * x.v_gas * x.v_t / x.v_t.hypot(x.v_n);
    })
    .with("strength", strength)
}

/// Around an input's middle `e_n` falls, and rises again.
fn hump(pick: fn(&crate::world::Inputs) -> f64, middle: f64, width: f64, depth: f64) -> Plant {
    Plant::normal("unknown", move |x, _, n| {
        n.e_n *= 1.0 - depth * (-((pick(x) - middle) / width).powi(2)).exp();
    })
}

/// Around a temperature a share sticks.
fn sticky_hump(middle: f64, width: f64, share: f64) -> Plant {
    Plant::normal("unknown", move |x, _, n| {
        n.stick = n.stick.max(share * (-((x.t_p - middle) / width).powi(2)).exp());
    })
}

/// A rig in which the cause shows.
pub fn plan(cause: &'static str, rng: &mut SetRng) -> Plan {
    particle_state(cause, rng)
        .or_else(|| solid(cause, rng))
        .or_else(|| other(cause, rng))
        .unwrap_or_else(|| panic!("{cause} is no cause"))
}

/// The plan of one plant.
fn planted(mut lab: Lab, plant: Plant, own: bool, names: &[&'static str]) -> Plan {
    let parameters = plant.parameters.iter().map(|(name, value)| (plant.cause, *name, *value)).collect();
    lab.truth.plants.push(Arc::new(plant));
    Plan { lab, names: names.to_vec(), parameters, own }
}

pub fn constant_law(rng: &mut SetRng) -> Tangential {
    Tangential::Constant(rounded(rng.uniform((0.6, 0.9))))
}

/// Effects of temperature and conversion.
fn particle_state(cause: &'static str, rng: &mut SetRng) -> Option<Plan> {
    let system = if cause.starts_with("conversion") { System::Char } else { System::Wax };
    let law = constant_law(rng);
    let mut lab = lab(system, law, rng);
    let plan = match cause {
        "melting-transition" => {
            let (half, width) = (rng.uniform((340.0, 370.0)), rng.uniform((4.0, 12.0)));
            lab.knobs = vec![(Knob::Temperature, (300.0, half + width * rng.uniform((-3.0, 2.0))))];
            lab.vary(&[(Knob::Speed, (1.2, 4.0)), (Knob::GasTemperature, (290.0, 350.0))], rng);
            lab.again(rng);
            lab.captures(rng);
            if rng.chance(0.6) {
                planted(lab, melting(half, width, rng.uniform((0.2, 0.9))), true, &[cause])
            } else {
                let (onset, power) = (half - 32.0, rng.uniform((3.0, 6.0)));
                planted(lab, plant::melting_transition(half, onset, power, 0.5), false, &[cause])
            }
        }
        "conversion-transition" => {
            let (half, width) = (rng.uniform((0.6, 0.9)), rng.uniform((0.02, 0.08)));
            let high = (half + width * rng.uniform((-2.5, 2.0))).min(1.0);
            lab.knobs = vec![(Knob::Conversion, (half - 0.4, high))];
            lab.vary(&[(Knob::Speed, (1.5, 5.0)), (Knob::Temperature, (1500.0, 1700.0))], rng);
            lab.again(rng);
            lab.captures(rng);
            let own = rng.chance(0.6);
            let plant =
                if own { conversion(half, width) } else { plant::conversion_transition(half, 2.0 * width) };
            planted(lab, plant, own, &[cause])
        }
        "conversion-decline" => {
            lab.sticky_base("conversion-transition", rounded(rng.uniform((0.5, 0.65))), 0.06);
            let peak = rng.uniform((0.65, 0.8));
            lab.knobs = vec![(Knob::Conversion, (0.5, 1.0))];
            lab.vary(&[(Knob::Speed, (1.5, 5.0)), (Knob::Temperature, (1500.0, 1700.0))], rng);
            lab.readings = vec![([Captured, CaptureEfficiency][rng.below(2)], 0)];
            planted(lab, decline(peak, 1.0 - rng.log_uniform((0.05, 0.8))), true, &[cause])
        }
        "thermal-softening" => {
            let onset = rng.uniform((295.0, 312.0));
            lab.source.temperature.spread = Spread::Fixed;
            lab.knobs = vec![(Knob::Temperature, (290.0, 340.0))];
            lab.vary(&[(Knob::Speed, (1.2, 4.0)), (Knob::Size, (55e-6, 120e-6))], rng);
            lab.again(rng);
            lab.restitutions(rng);
            planted(lab, softening(onset, rng.log_uniform((10.0, 300.0))), true, &[cause])
        }
        "unknown-hump" | "unknown-wall-hump" => {
            let wall = cause == "unknown-wall-hump";
            let knob = if wall { Knob::WallTemperature } else { Knob::Temperature };
            lab.source.temperature.spread = Spread::Fixed;
            lab.knobs = vec![(knob, (290.0, 340.0))];
            lab.vary(&[(Knob::Speed, (1.2, 4.0)), (Knob::GasTemperature, (290.0, 350.0))], rng);
            lab.restitutions(rng);
            let pick = |x: &crate::world::Inputs| x.t_p;
            let pick_wall = |x: &crate::world::Inputs| x.t_w;
            let depth = rng.log_uniform((0.03, 0.4));
            let (middle, width) = (rng.uniform((308.0, 322.0)), rng.uniform((7.0, 12.0)));
            let plant = hump(if wall { pick_wall } else { pick }, middle, width, depth);
            planted(lab, plant, false, &[if wall { "unknown:T_w" } else { "unknown:T_p" }])
        }
        "unknown-sticky-hump" => {
            lab.source.temperature.spread = Spread::Fixed;
            lab.knobs = vec![(Knob::Temperature, (290.0, 390.0))];
            lab.vary(&[(Knob::Speed, (1.2, 4.0)), (Knob::GasTemperature, (290.0, 350.0))], rng);
            lab.readings = vec![([Captured, CaptureEfficiency][rng.below(2)], 0)];
            let plant = sticky_hump(rng.uniform((325.0, 350.0)), 18.0, rng.log_uniform((0.03, 0.8)));
            planted(lab, plant, false, &["unknown:T_p"])
        }
        _ => return None,
    };
    Some(plan)
}

/// Effects on the solids.
fn solid(cause: &'static str, rng: &mut SetRng) -> Option<Plan> {
    let system = [System::Wax, System::Tungsten][rng.below(2)];
    let law = constant_law(rng);
    let mut lab = lab(system, law, rng);
    let wax = system == System::Wax;
    let speeds = if wax { (0.8, 5.0) } else { (2.0, 12.0) };
    let sizes = if wax { (40e-6, 140e-6) } else { (5e-6, 22e-6) };
    let contact = system.contact();
    let either = |factor: f64, rng: &mut SetRng| if rng.chance(0.5) { factor } else { 1.0 / factor };
    lab.knobs = vec![(Knob::Speed, speeds)];
    let plan = match cause {
        "adhesion-energy" => {
            let sticking = contact.sticking_speed(lab.source.diameter.middle);
            lab.source.speed = State::normal(2.0 * sticking, 0.3 * sticking, (0.05 * sticking, 1e3));
            lab.knobs[0].1 = (1.2 * sticking, 4.0 * sticking);
            if rng.chance(0.4) {
                let middle = lab.source.diameter.middle;
                lab.knobs = vec![(Knob::Size, (0.6 * middle, 1.6 * middle))];
            }
            lab.captures(rng);
            let factor = either(rng.uniform((1.2, 2.5)), rng);
            planted(lab, plant::adhesion_energy(contact.adhesion * factor), true, &[cause])
        }
        "yield-ratio" => {
            lab.vary(&[(Knob::Size, sizes)], rng);
            lab.again(rng);
            lab.restitutions(rng);
            let ratio = contact.yield_ratio * either(rng.log_uniform((1.05, 2.0)), rng);
            planted(lab, plant::yield_ratio(ratio), true, &[cause, "calibration:normal*", "level*"])
        }
        "size-dependent-yield" => {
            lab.source.diameter.spread = Spread::Fixed;
            lab.knobs = vec![(Knob::Size, sizes)];
            lab.vary(&[(Knob::Speed, speeds)], rng);
            lab.again(rng);
            lab.restitutions(rng);
            planted(lab, size(rng.log_uniform(sizes), rng.uniform((0.1, 1.0))), true, &[cause])
        }
        "strain-rate-hardening" => {
            lab.vary(&[(Knob::Size, sizes)], rng);
            lab.restitutions(rng);
            let half = rng.uniform(if wax { (1.5, 3.5) } else { (4.0, 8.0) });
            planted(lab, plant::strain_rate_hardening(rng.uniform((-0.2, 1.0)), half), false, &[cause])
        }
        "viscoelastic-loss" => {
            lab.vary(&[(Knob::Size, sizes)], rng);
            lab.restitutions(rng);
            let law = viscous(rng.log_uniform((1.5, 15.0)) * speeds.1, rng.uniform((0.4, 1.2)));
            planted(lab, law, true, &[cause])
        }
        _ => return None,
    };
    Some(plan)
}

/// Effects of layers, gas and angle, and wrong numbers of the base.
fn other(cause: &'static str, rng: &mut SetRng) -> Option<Plan> {
    let friction = rounded(rng.uniform((0.15, 0.3)));
    let law = match cause {
        "calibration:tangential.friction" => Tangential::Sliding { friction },
        "sliding-to-rolling" => Tangential::Constant(rounded(rng.uniform((0.66, 0.76)))),
        _ => constant_law(rng),
    };
    let mut lab = lab(System::Wax, law, rng);
    let angles = |lab: &mut Lab, low: f64| {
        lab.source.angle = State::fixed(60.0);
        lab.knobs = vec![(Knob::Angle, (low, 85.0))];
    };
    let more = [(Knob::Speed, (1.2, 4.0)), (Knob::GasTemperature, (290.0, 350.0))];
    let plan = match cause {
        "powder-layer" => {
            lab.knobs = vec![(Knob::Layer, (0.0, rounded(rng.log_uniform((0.1e-3, 1.2e-3)))))];
            lab.vary(&more, rng);
            lab.again(rng);
            lab.restitutions(rng);
            let plant = powder_layer(rng.uniform((0.1e-3, 0.4e-3)), rng.uniform((0.2, 0.95)));
            planted(lab, plant, true, &[cause])
        }
        "oblique-angle" => {
            angles(&mut lab, 20.0);
            lab.vary(&more, rng);
            lab.restitutions(rng);
            let sign = if rng.chance(0.5) { 1.0 } else { -1.0 };
            planted(lab, plant::oblique_angle(rng.uniform((-0.6, 0.8)), sign, 1.0), false, &[cause])
        }
        "gas-lift" => {
            lab.source.angle = State::fixed(40.0);
            lab.knobs = vec![(Knob::GasSpeed, (0.0, 20.0)), (Knob::Angle, (25.0, 80.0))];
            lab.vary(&more, rng);
            lab.restitutions(rng);
            planted(lab, gas_lift(rng.log_uniform((0.003, 0.05))), true, &[cause])
        }
        "sliding-to-rolling" => {
            angles(&mut lab, rng.uniform((15.0, 45.0)));
            lab.vary(&more, rng);
            lab.readings = vec![(MeanEt, 0)];
            lab.truth.tangential = Tangential::SlidingRolling { friction };
            let parameters = vec![(cause, "friction", friction)];
            Plan { lab, names: vec![cause], parameters, own: true }
        }
        "calibration:normal.e_n" => {
            let e_n = rounded(rng.uniform((0.3, 0.7)));
            lab.constant(e_n);
            lab.knobs = vec![(Knob::Speed, (1.2, 4.0)), (Knob::Temperature, (290.0, 340.0))];
            lab.readings = vec![(MeanEn, 0)];
            let value = e_n + rng.uniform((-0.15, 0.15));
            let plan = planted(lab, level(value), true, &[cause, "level*"]);
            Plan { parameters: vec![(cause, "value", value)], ..plan }
        }
        "calibration:tangential.e_t" => {
            let Tangential::Constant(old) = law else { return None };
            lab.knobs = vec![(Knob::Speed, (1.2, 4.0)), (Knob::Temperature, (290.0, 340.0))];
            lab.readings = vec![(MeanEt, 0)];
            if rng.chance(0.5) {
                lab.readings.push((MeanEn, 0));
            }
            let value = old + rng.uniform((-0.2, 0.2));
            lab.truth.tangential = Tangential::Constant(value);
            Plan { lab, names: vec![cause, "level*"], parameters: vec![(cause, "value", value)], own: true }
        }
        "calibration:tangential.friction" => {
            angles(&mut lab, 25.0);
            lab.knobs[0].1.1 = 50.0;
            lab.vary(&more, rng);
            lab.readings = vec![(MeanEt, 0)];
            let value = friction * rng.uniform((0.6, 1.5));
            lab.truth.tangential = Tangential::Sliding { friction: value };
            Plan { lab, names: vec![cause], parameters: vec![(cause, "value", value)], own: true }
        }
        _ => return None,
    };
    Some(plan)
}

/// A base that is right.
pub fn null(index: usize, rng: &mut SetRng) -> Plan {
    let system = [System::Wax, System::Tungsten, System::Char][index % 3];
    let law = constant_law(rng);
    let mut lab = lab(system, law, rng);
    lab.errors = [Errors::Stated, Errors::Counts, Errors::Absent][index / 3 % 3];
    let middle = lab.source.speed.middle;
    let t = lab.source.temperature.middle;
    let d = lab.source.diameter.middle;
    lab.knobs = vec![(Knob::Speed, (0.6 * middle, 2.0 * middle))];
    lab.vary(
        &[
            (Knob::Temperature, (0.97 * t, 1.1 * t)),
            (Knob::Size, (0.7 * d, 1.4 * d)),
            (Knob::WallTemperature, (290.0, 330.0)),
            (Knob::GasTemperature, (290.0, 350.0)),
            (Knob::GasSpeed, (0.0, 15.0)),
            (Knob::Conversion, (0.2, 1.0)),
        ],
        rng,
    );
    match rng.below(3) {
        0 => lab.sticky_base("melting-transition", rounded(1.05 * t), rounded(0.03 * t)),
        1 => lab.sticky_base("conversion-transition", 0.6, 0.15),
        _ => {}
    }
    lab.again(rng);
    if lab.base.plants.is_empty() {
        lab.restitutions(rng)
    } else {
        lab.captures(rng)
    }
    Plan { lab, names: vec![], parameters: vec![], own: false }
}
