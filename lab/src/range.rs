//! What impacts use outside of its stated range, and whether that matters: the reasons of one impact
//! and their counts over many. `predict`, `map` and `simulate` show them.
//!
//! The ranges themselves are the library's ([`Model::beyond`]); what a held property moves comes from
//! the model with that property raised and lowered ([`Displaced`]).

use std::cell::LazyCell;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use nearwall::impact::Impact;
use nearwall::model::{Displaced, MATTERS_FROM, Model};

/// Draws of what a model draws by chance, for the mean of an impact.
const DRAWS: usize = 64;
/// Impacts of each reason whose outcome is also computed with the property displaced.
const MEASURED: u64 = 200;
/// Smaller changes of `e_n`, `e_t` or `p_stick` count as none.
const MOVES_FROM: f64 = 1e-4;
/// The reason of an impact that leaves a range in some draws of its effects only.
const SOME_DRAWS: &str = "a law is left in some draws of the effects";

/// Finds the reasons of impacts on one model.
#[derive(Debug, Clone)]
pub struct RangeReader<'m> {
    displaced: Displaced<'m>,
}

/// One range that an impact leaves.
#[derive(Debug, Clone, PartialEq)]
pub struct Reason {
    /// What is stated for which range.
    pub stated: String,
    /// The value of the impact with its unit; `None` where it has none.
    pub value: Option<String>,
    /// What was changed to see whether it matters; `None` for a law whose alternative nobody knows.
    pub trial: Option<String>,
    /// How far that moves `e_n`, `e_t` or `p_stick` [1]; `None` where it was not tried.
    pub moved: Option<f64>,
}

impl<'m> RangeReader<'m> {
    /// For the impacts on a model.
    pub fn new(model: &'m Model) -> Self {
        Self { displaced: Displaced::new(model) }
    }

    /// The ranges that an impact outside of its ranges leaves, with what those move for which
    /// `measured` is true.
    fn find(&self, wall: usize, impact: &Impact, measured: impl Fn(&str) -> bool) -> Vec<Reason> {
        let model = self.displaced.model();
        let found = model.beyond(wall, impact).unwrap_or_default();
        let plain = LazyCell::new(|| model.expect(wall, impact, DRAWS));
        let reason = |beyond: &nearwall::model::Beyond<'_>| {
            let stated = beyond.stated();
            let moved = || {
                let plain = plain.as_ref().ok()?;
                self.displaced.moved(wall, impact, plain, beyond, DRAWS).ok()?
            };
            let moved = if measured(&stated) { moved() } else { None };
            Reason { stated, value: beyond.value(), trial: self.displaced.trial(beyond), moved }
        };
        let reasons: Vec<Reason> = found.iter().map(reason).collect();
        if reasons.is_empty() {
            vec![Reason { stated: SOME_DRAWS.to_owned(), value: None, trial: None, moved: None }]
        } else {
            reasons
        }
    }

    /// The ranges that an impact whose outcome is marked leaves, with what they move.
    pub fn reasons(&self, wall: usize, impact: &Impact) -> Vec<Reason> {
        self.find(wall, impact, |_| true)
    }
}

impl Reason {
    /// Whether the outcome depends on it, or may do so for all that is known.
    pub fn matters(&self) -> bool {
        self.moved.is_none_or(|moved| moved >= MATTERS_FROM)
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.stated)?;
        if let Some(value) = &self.value {
            write!(f, ", here {value}")?;
        }
        match self.moved {
            Some(moved) => write!(f, " (moves {})", change("", moved)),
            None => Ok(()),
        }
    }
}

/// A change of an outcome in words, after `many` for one of several.
fn change(many: &str, moved: f64) -> String {
    if moved < MOVES_FROM { "less than 0.0001".to_owned() } else { format!("{many}{moved:.4}") }
}

/// Impacts outside of ranges, by reason.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RangeCounts {
    impacts: u64,
    outside: u64,
    matter: u64,
    reasons: BTreeMap<String, ReasonCount>,
}

#[derive(Debug, Clone, PartialEq, Default)]
struct ReasonCount {
    impacts: u64,
    measured: u64,
    trial: Option<String>,
    most: f64,
}

impl ReasonCount {
    /// Whether it was tried and moved nothing.
    fn is_idle(&self) -> bool {
        self.measured > 0 && self.most < MOVES_FROM
    }
}

/// The properties and laws of reasons, each once.
fn properties(reasons: &[(&String, &ReasonCount)]) -> String {
    let names: BTreeSet<String> = reasons.iter().map(|(stated, _)| named(stated)).collect();
    names.into_iter().collect::<Vec<_>>().join(", ")
}

/// What a reason is about.
fn named(stated: &str) -> String {
    stated.split(" is ").next().unwrap_or_default().to_owned()
}

impl RangeCounts {
    /// Adds an impact with the reasons why it lies outside of a range; none for one that does not.
    pub fn add(&mut self, reasons: &[Reason]) {
        self.impacts += 1;
        self.outside += u64::from(!reasons.is_empty());
        self.matter += u64::from(reasons.iter().any(Reason::matters));
        for (place, reason) in reasons.iter().enumerate() {
            let count = self.reasons.entry(reason.stated.clone()).or_default();
            // Particle and wall of one material leave the same range.
            count.impacts += u64::from(reasons[..place].iter().all(|other| other.stated != reason.stated));
            count.trial.clone_from(&reason.trial);
            if let Some(moved) = reason.moved {
                count.measured += 1;
                count.most = count.most.max(moved);
            }
        }
    }

    /// Adds an impact, of which the first ones of each reason are also computed with the property
    /// displaced; a later one counts as the first ones of its reasons did at most.
    pub fn count(&mut self, reader: &RangeReader<'_>, wall: usize, impact: &Impact, outside: bool) {
        if !outside {
            return self.add(&[]);
        }
        let known = &self.reasons;
        let few = |stated: &str| known.get(stated).is_none_or(|count| count.measured < MEASURED);
        let mut reasons = reader.find(wall, impact, few);
        for reason in reasons.iter_mut().filter(|reason| reason.trial.is_some() && reason.moved.is_none()) {
            reason.moved = known.get(&reason.stated).map(|count| count.most);
        }
        self.add(&reasons);
    }

    /// Adds the counts of other impacts.
    pub fn merge(&mut self, other: Self) {
        self.impacts += other.impacts;
        self.outside += other.outside;
        self.matter += other.matter;
        for (stated, more) in other.reasons {
            let count = self.reasons.entry(stated).or_default();
            count.impacts += more.impacts;
            count.measured += more.measured;
            count.trial = more.trial;
            count.most = count.most.max(more.most);
        }
    }

    /// The counts in words: how many of the `things`, such as "rows", then a line a reason, those
    /// that matter first, and one for all that move nothing. Empty where all lie inside.
    pub fn lines(&self, things: &str) -> Vec<String> {
        let Self { impacts, outside, matter, reasons } = self;
        if *outside == 0 {
            return Vec::new();
        }
        let first = format!(
            "{outside} of {impacts} {things} lie outside of a stated range; it may matter for {matter} \
             (at least {MATTERS_FROM} in e_n, e_t or p_stick, or not known)"
        );
        let mut sorted: Vec<(&String, &ReasonCount)> = reasons.iter().collect();
        sorted.sort_by(|(_, one), (_, other)| {
            let key = |count: &ReasonCount| (count.trial.is_some(), -count.most);
            key(one).partial_cmp(&key(other)).unwrap_or(std::cmp::Ordering::Equal)
        });
        let line = |alike: &[(&String, &ReasonCount)]| reason_line(alike, *outside);
        let (idle, moving): (Vec<_>, Vec<_>) = sorted.into_iter().partition(|(_, count)| count.is_idle());
        let others: Vec<String> = moving.iter().map(|(stated, _)| named(stated)).collect();
        let idle: Vec<_> = idle.into_iter().filter(|(stated, _)| !others.contains(&named(stated))).collect();
        let idle = match idle.as_slice() {
            [] | [_] => idle.chunks(1).map(line).collect(),
            several => vec![format!("held without moving the outcome: {}", properties(several))],
        };
        let moving = alike(moving);
        std::iter::once(first).chain(moving.iter().map(|alike| line(alike))).chain(idle).collect()
    }
}

/// What a reason says of a material: the property, and the rest from the material on.
fn property_and_range(stated: &str) -> Option<(&str, &str)> {
    stated.split_once(" of ")
}

/// Reasons with those of other properties of the same material and range, the order of the first ones kept.
fn alike<'a>(reasons: Vec<(&'a String, &'a ReasonCount)>) -> Vec<Vec<(&'a String, &'a ReasonCount)>> {
    let mut groups: Vec<Vec<(&String, &ReasonCount)>> = Vec::new();
    for (stated, count) in reasons {
        let is_like = |group: &&mut Vec<(&String, &ReasonCount)>| {
            let (first, known) = group[0];
            let range = |stated| property_and_range(stated).map(|(_, range)| range);
            range(stated).is_some() && range(stated) == range(first) && known.trial == count.trial
        };
        match groups.iter_mut().find(is_like) {
            Some(group) => group.push((stated, count)),
            None => groups.push(vec![(stated, count)]),
        }
    }
    groups
}

/// The line of properties of one material and range, of which the first one moves the outcome most.
fn reason_line(alike: &[(&String, &ReasonCount)], outside: u64) -> String {
    let impacts = alike.iter().map(|(_, count)| count.impacts).max().unwrap_or(0);
    let Some((stated, count)) = alike.first() else { return String::new() };
    let several = |(name, range): (&str, &str)| {
        let others = alike[1..].iter().filter_map(|(other, _)| Some(property_and_range(other)?.0));
        let names: Vec<&str> = std::iter::once(name).chain(others).collect();
        format!("{} of {}", names.join(", "), range.replacen(" is ", " are ", 1))
    };
    let stated = match alike {
        [_] => (*stated).clone(),
        _ => property_and_range(stated).map_or_else(|| (*stated).clone(), several),
    };
    let moved = count.trial.as_ref().map(|trial| {
        let trial = match alike {
            [_] => trial.clone(),
            _ => trial.replacen("its uncertainty", "the uncertainty of each", 1),
        };
        format!("; {trial} moves the outcome by {}", change("up to ", count.most))
    });
    format!("{impacts} of {outside}: {stated}{}", moved.unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: &str = "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"stainless-steel\"\n\
        [normal]\nmodel = \"thornton-ning\"\nyield_ratio = 0.7\n[tangential]\nmodel = \"constant\"\ne_t = 0.76\n";

    /// The steel's surface energy is stated up to 403.15 K; at 3 m/s adhesion does not count, at
    /// 0.2 m/s, near the sticking velocity, it does.
    #[test]
    fn a_held_surface_energy_matters_for_slow_particles() {
        let model = Model::from_toml("m", MODEL).unwrap();
        let reader = RangeReader::new(&model);
        let at = |normal_speed: f64| {
            let hot = Impact { wall_temperature: 450.0, diameter: 75e-6, ..Impact::default() };
            reader.reasons(0, &Impact { normal_speed, particle_temperature: 300.0, ..hot })
        };
        let [slow, fast] = [0.2, 3.0].map(at);
        assert!(slow[0].stated.starts_with("surface_energy of stainless-steel"), "{slow:?}");
        assert!(slow[0].matters() && !fast[0].matters(), "{slow:?} {fast:?}");
        let mut counts = RangeCounts::default();
        counts.add(&slow);
        counts.add(&fast);
        counts.add(&[]);
        let lines = counts.lines("rows");
        assert!(lines[0].starts_with("2 of 3 rows") && lines[0].contains("matter for 1 "), "{lines:?}");
        assert!(
            lines[1].starts_with("2 of 2: surface_energy of stainless-steel is stated for T_w"),
            "{lines:?}"
        );
    }

    fn reason(stated: &str, trial: &str, moved: f64) -> Reason {
        Reason { stated: stated.to_owned(), value: None, trial: Some(trial.to_owned()), moved: Some(moved) }
    }

    /// Of one impact a reason counts once, and reasons that moved nothing share a line.
    #[test]
    fn reasons_count_once_and_those_without_effect_share_a_line() {
        let reason = |stated: &str, moved: f64| reason(stated, "ten percent", moved);
        let [a, b, c] = ["a is stated for x", "b is stated for x", "c is stated for x"];
        let mut counts = RangeCounts::default();
        counts.add(&[reason(a, 0.5), reason(a, 0.5), reason(c, 0.0), reason(b, 1e-5)]);
        let lines = counts.lines("rows");
        assert_eq!(lines[1], "1 of 1: a is stated for x; ten percent moves the outcome by up to 0.5000");
        assert_eq!(lines[2..], ["held without moving the outcome: b, c"]);
    }

    /// Properties of one material and range share a line, the one that moves most first.
    #[test]
    fn properties_of_one_range_share_a_line() {
        let reason = |stated: &str, moved: f64| reason(stated, "held there; its uncertainty", moved);
        let mut counts = RangeCounts::default();
        let [weak, strong] = [("hardness of a is stated for x", 0.2), ("density of a is stated for x", 0.4)];
        let other = ("density of b is stated for x", 0.3);
        counts.add(&[weak, strong, other].map(|(stated, moved)| reason(stated, moved)));
        assert_eq!(
            counts.lines("rows")[1..],
            [
                "1 of 1: density, hardness of a are stated for x; held there; the uncertainty of each moves the outcome \
                 by up to 0.4000",
                "1 of 1: density of b is stated for x; held there; its uncertainty moves the outcome by up to 0.3000",
            ]
        );
    }
}
