//! Rigs whose wall law depends on a dimensionless group: speed and size both vary, and neither alone explains it.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::campaign::System;
use crate::effects::{Plan, constant_law, lab};
use crate::expected::is_one_of;
use crate::gates::require;
use crate::lab::{Lab, rounded};
use crate::plant::Plant;
use crate::rig::Observable;
use crate::score::Judgement;
use crate::set_rng::SetRng;
use crate::sets::Set;
use crate::source::{Knob, State};
use crate::world::Inputs;

/// Every planted dependence.
pub const LAWS: [&str; 5] =
    ["weber-capture", "weber-threshold", "weber-rebound", "sticking-speed-capture", "sticking-speed-rebound"];

/// A rig on which the law depends on a group.
pub fn plan(law: &'static str, rng: &mut SetRng) -> Plan {
    let is_drop = law.starts_with("weber");
    let system = if is_drop { System::Char } else { [System::Wax, System::Tungsten][rng.below(2)] };
    let mut lab = lab(system, constant_law(rng), rng);
    let (middle_speed, middle_size) = (lab.source.speed.middle, lab.source.diameter.middle);
    let range = |middle: f64, factor: f64| (middle / factor, middle * factor);
    let (speeds, sizes) = if is_drop {
        lab.constant(rounded(rng.uniform((0.4, 0.8))));
        lab.liquid = Some([rounded(rng.log_uniform((0.03, 0.5))), rounded(rng.log_uniform((1e-3, 1e-1)))]);
        (range(middle_speed, rng.uniform((2.0, 3.0))), range(middle_size, rng.uniform((1.7, 2.2))))
    } else {
        // Sticking takes place below all of these speeds.
        let sticking = lab.system.contact().sticking_speed(0.5 * middle_size);
        (range(4.0 * sticking, rng.uniform((2.0, 2.5))), range(middle_size, rng.uniform((1.7, 2.0))))
    };
    lab.source.diameter = State::fixed(middle_size);
    lab.source.speed = State::fixed((speeds.0 * speeds.1).sqrt());
    lab.knobs = vec![(Knob::Speed, speeds), (Knob::Size, sizes)];
    if rng.chance(0.3) {
        lab.knobs.push((Knob::WallTemperature, (290.0, 330.0)));
    }
    let group = group(&lab, is_drop);
    let middle = group(&Inputs { v_n: lab.source.speed.middle * 0.94, d: middle_size, ..Inputs::default() });
    lab.readings = match law {
        "weber-rebound" | "sticking-speed-rebound" => vec![(Observable::MeanEn, 0)],
        _ => [
            vec![(Observable::Captured, 0)],
            vec![(Observable::CaptureEfficiency, 0), (Observable::MeanEn, 0)],
        ][rng.below(2)]
        .clone(),
    };
    let plant = match law {
        "weber-capture" => captured(group, middle * rng.uniform((0.4, 2.5)), rng.uniform((1.0, 3.0))),
        "weber-threshold" => captured(group, middle * rng.uniform((0.1, 0.5)), rng.uniform((5.0, 30.0))),
        "sticking-speed-capture" => {
            captured(group, middle * rng.uniform((0.4, 1.5)), rng.uniform((2.0, 6.0)))
        }
        _ => {
            let least = group(&Inputs { v_n: 0.9 * speeds.0, d: sizes.0, ..Inputs::default() });
            slowed(group, least, rng.uniform((0.1, 0.35)))
        }
    };
    lab.truth.plants.push(std::sync::Arc::new(plant));
    let names = vec![if is_drop { "unknown:We" } else { "unknown:v_n/v_s" }];
    Plan { lab, names, parameters: vec![], own: false }
}

/// Weber's number, or the speed over that below which adhesion holds the particle.
fn group(lab: &Lab, is_drop: bool) -> impl Fn(&Inputs) -> f64 + Send + Sync + Clone + 'static {
    let (contact, liquid) = (lab.system.contact(), lab.liquid);
    move |x| match liquid {
        Some([tension, _]) if is_drop => contact.density * x.v_n * x.v_n * x.d / tension,
        _ => x.v_n / contact.sticking_speed(x.d),
    }
}

/// The share `1/(1 + (x/x_0)^n)` sticks.
fn captured(group: impl Fn(&Inputs) -> f64 + Send + Sync + 'static, at: f64, steepness: f64) -> Plant {
    Plant::normal("unknown", move |x, _, n| {
        n.stick = n.stick.max(1.0 / (1.0 + (group(x) / at).powf(steepness)));
    })
}

/// `e_n (x/x_0)^-b` with an `x_0` below nearly all impacts.
fn slowed(group: impl Fn(&Inputs) -> f64 + Send + Sync + 'static, at: f64, exponent: f64) -> Plant {
    Plant::normal("unknown", move |x, _, n| n.e_n *= (group(x) / at).powf(-exponent))
}

/// What a diagnosis says of the group.
pub struct GroupJudgement {
    pub judged: Judgement,
    /// Whether it is a finding.
    named: bool,
    /// Whether it is a finding or in the explanations that hold 95 %, also as what changes together with another one.
    listed: bool,
    /// Whether something else is a finding, and the group not open.
    wrong: bool,
    /// The equations.
    forms: Vec<String>,
}

/// Judges one answer.
pub fn judge(set: &Set, diagnosis: &Value, judged: Judgement) -> GroupJudgement {
    let list = |key: &str| diagnosis[key].as_array().cloned().unwrap_or_default();
    let is_right = |name: &Value| name.as_str().is_some_and(|name| is_one_of(&set.plan.names, name, &[]));
    let findings = list("findings");
    let named = findings.iter().any(|one| is_right(&one["cause"]));
    let inner = |one: &Value, key: &str| one[key].as_array().cloned().unwrap_or_default();
    let group = set.plan.names[0].trim_start_matches("unknown:");
    let is_together = |sentence: &Value| {
        let words = sentence.as_str().unwrap_or_default().split([' ', ',', ':']);
        words.into_iter().any(|word| word == group)
    };
    let open =
        list("explanations").into_iter().flat_map(|one| inner(&one, "causes")).chain(list("undecided"));
    let listed = named
        || open.into_iter().any(|name| is_right(&name))
        || findings.iter().flat_map(|one| inner(one, "not_separable")).any(|one| is_together(&one));
    let wrong = !(listed || findings.is_empty() && list("calibration").is_empty());
    let forms = findings.iter().flat_map(|one| inner(one, "forms"));
    let forms = forms.filter_map(|form| form["equation"].as_str().map(str::to_owned)).collect();
    GroupJudgement { judged, named, listed, wrong, forms }
}

impl GroupJudgement {
    /// One line.
    pub fn line(&self) -> String {
        let Judgement { name, deviations: [seen, _], said, seconds, gain, .. } = &self.judged;
        let verdict = match (self.named, self.listed, self.wrong) {
            (true, ..) => "named",
            (_, true, _) => "listed",
            (.., true) => "WRONG",
            _ => "silent",
        };
        let gain = gain.map_or(String::new(), |[reached, best]| format!(", rms {reached:.2} of {best:.2}"));
        let forms = self.forms.join("; ");
        format!("{verdict}: {name} seen by {seen:.1}{gain}, {seconds:.1} s: {} | {forms}", said.join(", "))
    }
}

/// Prints the table; what fails.
pub fn report(all: &[GroupJudgement]) -> Vec<String> {
    println!(
        "\n| law | sets | seen | named | named or listed | wrong | longest [s] |\n|---|---|---|---|---|---|---|"
    );
    let mut families: BTreeMap<&str, Vec<&GroupJudgement>> = BTreeMap::new();
    all.iter().for_each(|one| families.entry(&one.judged.family).or_default().push(one));
    families.insert("all", all.iter().collect());
    families.insert("all that are seen", all.iter().filter(|one| one.judged.notices).collect());
    for (name, sets) in &families {
        let count = |what: &dyn Fn(&GroupJudgement) -> bool| sets.iter().filter(|one| what(one)).count();
        let longest = sets.iter().map(|one| one.judged.seconds).fold(0.0, f64::max);
        println!(
            "| {name} | {} | {} | {} | {} | {} | {longest:.1} |",
            sets.len(),
            count(&|one| one.judged.notices),
            count(&|one| one.named),
            count(&|one| one.listed),
            count(&|one| one.wrong)
        );
    }
    let seen: Vec<_> = all.iter().filter(|one| one.judged.notices).collect();
    let listed = seen.iter().filter(|one| one.listed).count();
    let right = all.iter().filter(|one| !one.wrong).count();
    [
        require("group named or listed, where it is seen", listed, seen.len(), 0.9),
        require("nothing else named without it", right, all.len(), 0.95),
    ]
    .into_iter()
    .filter_map(Result::err)
    .collect()
}
