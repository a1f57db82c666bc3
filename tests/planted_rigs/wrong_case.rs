//! Rigs whose wall law is right and of whose case one number is wrong, or a force is left out.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::campaign::System;
use crate::effects::{Plan, constant_law, lab};
use crate::expected::is_one_of;
use crate::gates::require;
use crate::lab::{Errors, Lab};
use crate::rig::{Observable, Rig, START, Shape};
use crate::score;
use crate::set_rng::SetRng;
use crate::sets::Set;
use crate::source::{Knob, Source, Spread, State};

/// Every number that is wrong in a set.
pub const NUMBERS: [WrongNumber; 8] = [
    WrongNumber::Speed,
    WrongNumber::Size,
    WrongNumber::Temperature,
    WrongNumber::Angle,
    WrongNumber::GasSpeed,
    WrongNumber::Spread,
    WrongNumber::Place,
    WrongNumber::Weight,
];

/// A number of the case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WrongNumber {
    Speed,
    Size,
    Temperature,
    Angle,
    GasSpeed,
    /// Of the sizes.
    Spread,
    /// Of injection, beside the middle of the target.
    Place,
    /// No number: the case leaves the weight out.
    Weight,
}

/// What is wrong with a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CaseError {
    pub number: WrongNumber,
    /// How far the true number lies from the stated one, in usual errors of an instrument.
    pub widths: f64,
}

impl CaseError {
    /// The particles and the gas as they really were.
    pub fn apply(&self, source: &mut Source) {
        let factor = |width: f64| (width * self.widths).exp();
        match self.number {
            WrongNumber::Speed => source.speed.middle *= factor(0.05),
            WrongNumber::Size => source.diameter.middle *= factor(0.05),
            WrongNumber::GasSpeed => source.gas_speed *= factor(0.05),
            WrongNumber::Temperature => source.temperature.middle += 10.0 * self.widths,
            WrongNumber::Angle => source.angle.middle += 2.0 * self.widths,
            WrongNumber::Spread => {
                if let Spread::Normal { deviation } = &mut source.diameter.spread {
                    *deviation *= factor(0.1);
                }
            }
            WrongNumber::Place => source.offset[0] += 0.05 * START * self.widths,
            WrongNumber::Weight => {}
        }
    }

    /// The rig as it really was.
    pub fn rig(&self, rig: Rig) -> Rig {
        Rig { falls: rig.falls || self.number == WrongNumber::Weight, ..rig }
    }
}

impl WrongNumber {
    /// The name of its sets.
    pub fn family(self) -> &'static str {
        match self {
            Self::Speed => "case-speed",
            Self::Size => "case-size",
            Self::Temperature => "case-temperature",
            Self::Angle => "case-angle",
            Self::GasSpeed => "case-gas-speed",
            Self::Spread => "case-spread",
            Self::Place => "case-place",
            Self::Weight => "case-weight",
        }
    }

    /// The cause that is right.
    fn cause(self) -> &'static str {
        match self {
            Self::Speed => "case:particles.speed*",
            Self::Size => "case:particles.diameter",
            Self::Temperature => "case:particles.temperature*",
            Self::Angle => "case:particles.angle_deg",
            Self::GasSpeed => "case:gas.velocity",
            Self::Spread => "case:particles.diameter.deviation",
            Self::Place => "case:particles.position.x",
            Self::Weight => "case:without-gravity",
        }
    }
}

/// How wrong it is: of three sets two lie within four usual errors.
fn widths(index: usize, rng: &mut SetRng) -> f64 {
    let size = if index % 3 == 2 { rng.uniform((5.0, 9.0)) } else { rng.uniform((1.0, 4.0)) };
    if rng.chance(0.5) { size } else { -size }
}

/// A rig on which the number is wrong.
pub fn plan(number: WrongNumber, index: usize, rng: &mut SetRng) -> Plan {
    let law = constant_law(rng);
    let mut lab = lab([System::Wax, System::Tungsten][rng.below(2)], law, rng);
    lab.errors = [Errors::Stated, Errors::Counts][rng.below(2)];
    lab.source.diameter.spread = Spread::Fixed;
    lab.rig.shape = Shape::Shot;
    match number {
        WrongNumber::Temperature => melting(&mut lab, rng),
        WrongNumber::GasSpeed => blown(&mut lab, rng),
        WrongNumber::Spread => spread(&mut lab, rng),
        WrongNumber::Angle => oblique(&mut lab, rng),
        WrongNumber::Place => aside(&mut lab, rng),
        WrongNumber::Weight => weightless(&mut lab, rng),
        WrongNumber::Speed | WrongNumber::Size if rng.chance(0.4) => blown(&mut lab, rng),
        WrongNumber::Speed | WrongNumber::Size => sticking(&mut lab, rng),
    }
    lab.case_error = Some(CaseError { number, widths: widths(index, rng) });
    Plan { lab, names: vec![number.cause()], parameters: vec![], own: false }
}

/// Readings of rebound, of capture, or of both.
fn readings(lab: &mut Lab, rng: &mut SetRng) {
    use Observable::{Captured, MeanEn, MeanEt};
    lab.readings = match rng.below(3) {
        0 => vec![(Captured, 0), (MeanEn, 0)],
        1 => vec![(MeanEn, 0), (MeanEt, 0)],
        _ => vec![(MeanEn, 0)],
    };
}

/// Speeds about that below which adhesion holds the particle.
fn sticking(lab: &mut Lab, rng: &mut SetRng) {
    let sticking = lab.system.contact().sticking_speed(lab.source.diameter.middle);
    lab.source.speed = State::normal(2.0 * sticking, 0.3 * sticking, (0.05 * sticking, 1e3 * sticking));
    lab.knobs = vec![(Knob::Speed, (1.1 * sticking, 4.0 * sticking))];
    readings(lab, rng);
    if rng.chance(0.4) {
        lab.readings = vec![(Observable::Captured, 0)];
    }
}

/// A base that melts within the range of temperatures.
fn melting(lab: &mut Lab, rng: &mut SetRng) {
    *lab = Lab { errors: lab.errors, ..crate::effects::lab(System::Wax, lab.law, rng) };
    lab.source.diameter.spread = Spread::Fixed;
    lab.sticky_base("melting-transition", crate::lab::rounded(rng.uniform((335.0, 350.0))), 8.0);
    lab.knobs = vec![(Knob::Temperature, (310.0, 370.0))];
    if rng.chance(0.5) {
        lab.knobs.push((Knob::Speed, (1.2, 4.0)));
    }
    readings(lab, rng);
    if lab.readings[0].0 != Observable::Captured {
        lab.readings = vec![(Observable::Captured, 0)];
    }
}

/// Particles that a gas blows onto the plate.
fn blown(lab: &mut Lab, rng: &mut SetRng) {
    *lab = Lab { errors: lab.errors, ..crate::effects::lab(System::Wax, lab.law, rng) };
    lab.rig = Rig::new(Shape::Blown, 1.0);
    lab.source.diameter = State::fixed(crate::lab::rounded(rng.log_uniform((25e-6, 60e-6))));
    lab.source.gas_speed = crate::lab::rounded(rng.uniform((4.0, 10.0)));
    lab.knobs = vec![(Knob::Speed, (0.5, 3.0))];
    readings(lab, rng);
}

/// Sizes that are spread, captured where they are large enough to lose no speed to adhesion.
fn spread(lab: &mut Lab, rng: &mut SetRng) {
    sticking(lab, rng);
    let middle = lab.source.diameter.middle;
    let deviation = rng.uniform((0.12, 0.25)) * middle;
    lab.source.diameter = State::normal(middle, deviation, (0.05 * middle, 5.0 * middle));
    let bounds = [0.05, 0.8, 1.1, 5.0].map(|share| crate::lab::rounded(share * middle));
    let by_size = bounds.windows(2).map(|pair| (Observable::CapturedSize(pair[0], pair[1]), 0)).collect();
    lab.readings = if rng.chance(0.7) { by_size } else { vec![(Observable::Captured, 0)] };
}

/// Angles at which a small change is one of the normal velocity.
fn oblique(lab: &mut Lab, rng: &mut SetRng) {
    sticking(lab, rng);
    lab.source.angle = State::fixed(45.0);
    lab.knobs.push((Knob::Angle, (22.0, 60.0)));
}

/// A target of which the deposit is weighed in rings, struck on one spot.
fn aside(lab: &mut Lab, rng: &mut SetRng) {
    sticking(lab, rng);
    lab.source.angle = State::fixed(crate::lab::rounded(rng.uniform((75.0, 85.0))));
    let middle = START / lab.source.angle.middle.to_radians().tan();
    let bounds = [0.0, 0.6, 1.0, 1.6, 10.0].map(|share| crate::lab::rounded(share * middle));
    let rings = bounds.windows(2).map(|pair| (Observable::CapturedFrom(pair[0], pair[1]), 0));
    lab.readings = rings.collect();
}

/// Rebounds that fall back, of which the case knows nothing.
fn weightless(lab: &mut Lab, rng: &mut SetRng) {
    sticking(lab, rng);
    lab.rig = Rig { falls: false, ..Rig::new(Shape::Bounce, crate::lab::rounded(rng.uniform((0.1, 0.3)))) };
    readings(lab, rng);
}

/// What a diagnosis says of a set.
pub struct CaseJudgement {
    pub name: String,
    family: String,
    widths: f64,
    /// Whether the readings show the error.
    noticed: bool,
    /// Deviations that they show of it.
    seen: f64,
    /// Whether an effect or another number of the wall law is named.
    pub blames_the_law: bool,
    /// Whether the right number is the first finding.
    named: bool,
    /// Whether it is named or left open.
    listed: bool,
    pub said: Vec<String>,
    failed: bool,
    pub seconds: f64,
}

/// Judges one answer.
pub fn judge(set: &Set, diagnosis: &Result<Value, String>, seconds: f64) -> CaseJudgement {
    let empty = Value::Null;
    let found = diagnosis.as_ref().unwrap_or(&empty);
    let names = &set.plan.names;
    let list = |key: &str| found[key].as_array().cloned().unwrap_or_default();
    let is_right = |name: &Value| name.as_str().is_some_and(|name| is_one_of(names, name, &[]));
    let causes: Vec<Value> = list("findings").iter().map(|one| one["cause"].clone()).collect();
    let is_law = |name: &Value| name.as_str().is_some_and(|name| !name.starts_with("case:"));
    let open = list("explanations").into_iter().flat_map(|one| one["causes"].as_array().cloned()).flatten();
    let blamed = list("blame").into_iter().map(|one| one["party"].clone());
    let listed = open.chain(list("undecided")).chain(blamed).any(|name| is_right(&name));
    let said = match diagnosis {
        Ok(diagnosis) => score::said(diagnosis),
        Err(message) => vec![message.trim().to_owned()],
    };
    CaseJudgement {
        name: set.name.clone(),
        family: set.family().to_owned(),
        widths: set.lab().case_error.map_or(0.0, |error| error.widths),
        noticed: set.oracle.notices,
        seen: set.oracle.seen,
        blames_the_law: causes.iter().any(is_law) || !list("calibration").is_empty(),
        named: causes.first().is_some_and(is_right),
        listed: listed || causes.iter().any(is_right),
        said,
        failed: diagnosis.is_err(),
        seconds,
    }
}

impl CaseJudgement {
    /// One line.
    pub fn line(&self) -> String {
        let Self { name, widths, seen, seconds, .. } = self;
        let verdict = match (self.blames_the_law, self.named, self.listed) {
            (true, ..) => "BLAMES THE LAW",
            (_, true, _) => "named",
            (_, _, true) => "listed",
            _ if self.noticed => "missed",
            _ => "not to be seen",
        };
        let said = self.said.join(", ");
        format!(
            "{verdict}: {name} off by {widths:.1} widths, seen by {seen:.1} deviations, {seconds:.1} s: {said}"
        )
    }
}

/// Prints the table; what fails.
pub fn report(all: &[CaseJudgement]) -> Vec<String> {
    println!(
        "\n| wrong number | sets | seen | wall law blamed | right one named | named or listed | longest [s] |"
    );
    println!("|---|---|---|---|---|---|---|");
    let mut families: BTreeMap<&str, Vec<&CaseJudgement>> = BTreeMap::new();
    all.iter().for_each(|one| families.entry(&one.family).or_default().push(one));
    families.insert("within four usual errors", all.iter().filter(|one| one.widths.abs() <= 4.0).collect());
    families.insert("beyond", all.iter().filter(|one| one.widths.abs() > 4.0).collect());
    for (name, sets) in &families {
        let count = |what: &dyn Fn(&CaseJudgement) -> bool| sets.iter().filter(|one| what(one)).count();
        let longest = sets.iter().map(|one| one.seconds).fold(0.0, f64::max);
        println!(
            "| {name} | {} | {} | {} | {} | {} | {longest:.1} |",
            sets.len(),
            count(&|one| one.noticed),
            count(&|one| one.blames_the_law),
            count(&|one| one.noticed && one.named),
            count(&|one| one.noticed && one.listed)
        );
    }
    let innocent = all.iter().filter(|one| !one.blames_the_law).count();
    let noticed = all.iter().filter(|one| one.noticed).count();
    let listed = all.iter().filter(|one| one.noticed && one.listed).count();
    let failed = all.iter().filter(|one| one.failed).map(|one| Err(one.line()));
    [
        require("wall law not blamed for an error of the case", innocent, all.len(), 0.95),
        require("right number named or listed, where it is seen", listed, noticed, 0.9),
    ]
    .into_iter()
    .chain(failed)
    .filter_map(Result::err)
    .collect()
}
