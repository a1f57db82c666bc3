//! The title and the sentences at the top of the page.

use super::{RunComparison, RunResults, WallModel, deposit, number, percent};
use crate::results::{ByConversion, share, wilson};
use nearwall::impact::Regime;
use std::iter;

/// Conversion below which carbon still covers the ash of captured char (Troiano et al.: threshold 0.88 to 0.90).
const RAW: f64 = 0.8;

pub(super) fn title(comparison: &RunComparison<'_>) -> String {
    match comparison.labels.as_slice() {
        [one] => format!("Wall hits in {one}"),
        several => format!("Wall hits: {}", several.join(", ")),
    }
}

pub(super) fn lead(comparison: &RunComparison<'_>) -> String {
    let models = comparison.each().map(|(label, run)| {
        let model = match &run.wall_model {
            WallModel::Nearwall => "the impact model of nearwall (nearWallInteraction)",
            WallModel::Other(name) => name,
            WallModel::Unknown => "a wall model that the case does not name",
        };
        format!("{label} uses {model}")
    });
    let models = models.collect::<Vec<_>>().join("; ");
    let at = if comparison.is_single() { "Results are those" } else { "All cases are compared" };
    format!("{models}. {at} at {}.", comparison.when())
}

/// At most four sentences, however many runs there are.
pub(super) fn lines(comparison: &RunComparison<'_>) -> Vec<String> {
    if let [run] = comparison.runs {
        // Of a wall that takes heat the figures tell the regime.
        let why = deposit::heat_words(comparison).or_else(|| reason(comparison, run));
        let sentences = [busiest(comparison, run), why, certainty(comparison, run)];
        return iter::once(single(comparison, run)).chain(sentences.into_iter().flatten()).collect();
    }
    let mut lines = several(comparison);
    let walls: Vec<&str> = comparison.walls.iter().map(String::as_str).collect();
    let raw: Vec<String> = comparison
        .each()
        .filter_map(|(label, run)| {
            let share = percent(raw_share(&run.captured_by_conversion(&walls, comparison.time)?));
            Some(format!("{share} of {label}"))
        })
        .collect();
    if !raw.is_empty() {
        lines.push(format!("Captured mass with a conversion below {RAW} at capture: {}.", raw.join(", ")));
    }
    lines
}

/// What several runs capture, in which regimes, and what stock models say beside them.
fn several(comparison: &RunComparison<'_>) -> Vec<String> {
    let own = || comparison.each().filter(|(_, run)| run.is_ours());
    let share = |run: &RunResults| share(run.captured_mass(comparison.time), comparison.injected(run));
    let totals = comparison.each().map(|(label, run)| format!("{label} {}", percent(share(run))));
    let mut lines =
        vec![format!("Captured of the injected mass: {}.", totals.collect::<Vec<_>>().join(", "))];
    let regimes: Vec<String> = own()
        .filter_map(|(label, run)| {
            let (regime, share) = main_regime(comparison, run, &comparison.walls)?;
            Some(format!("{} of the captured mass of {label} is caught as {}", percent(share), regime.name()))
        })
        .collect();
    // A stock model is compared with the first run of the same cloud with our model.
    let first = |label: &str, run: &RunResults| {
        own().find(|(_, o)| o.cloud == run.cloud).is_some_and(|(l, _)| l == label)
    };
    let beside: Vec<String> = own()
        .filter(|(label, run)| first(label, run))
        .filter_map(|(label, run)| beside_stock(comparison, label, run))
        .collect();
    lines.extend([regimes, beside].iter().filter(|list| !list.is_empty()).map(|list| list.join("; ") + "."));
    lines
}

fn single(comparison: &RunComparison<'_>, run: &RunResults) -> String {
    let injected = comparison.injected(run);
    let part = |starts: &str| {
        let lines = run.balance.iter().filter(|line| line.what.starts_with(starts));
        let masses: Vec<f64> = lines.filter_map(|line| line.mass).collect();
        (!masses.is_empty()).then(|| percent(share(masses.iter().sum(), injected)))
    };
    let captured = percent(share(run.captured_mass(comparison.time), injected));
    let mut parts = vec![format!("{captured} of the injected mass is captured")];
    parts.extend(part("escaped").or_else(|| part("left through")).map(|share| format!("{share} leaves")));
    parts.extend(
        part("reacted")
            .filter(|share| *share != percent(0.0))
            .map(|share| format!("{share} has reacted to gas")),
    );
    parts.extend(part("airborne").map(|share| format!("{share} is airborne at the end")));
    parts.join(", ") + "."
}

fn busiest_wall<'a>(comparison: &'a RunComparison<'_>, run: &RunResults) -> Option<&'a String> {
    let mass = |wall: &String| run.captured(wall, comparison.time).map_or(0.0, |amount| amount.mass());
    comparison.walls.iter().max_by(|a, b| mass(a).total_cmp(&mass(b)))
}

/// Why it is captured: the regime of most of it, and how much of it is raw.
fn reason(comparison: &RunComparison<'_>, run: &RunResults) -> Option<String> {
    let (regime, share) = main_regime(comparison, run, &comparison.walls)?;
    let mut text = format!("{} of the captured mass is caught as {}", percent(share), regime_words(regime));
    let walls: Vec<&str> = comparison.walls.iter().map(String::as_str).collect();
    if let Some(masses) = run.captured_by_conversion(&walls, comparison.time) {
        text += &format!("; {} has a conversion below {RAW} at capture", percent(raw_share(&masses)));
    }
    Some(text + ".")
}

fn regime_words(regime: Regime) -> String {
    let what = match regime {
        Regime::NspNsw => "non-sticky particles on a non-sticky wall, by adhesion alone",
        Regime::NspSw => "non-sticky particles on a sticky wall",
        Regime::SpNsw => "sticky particles on a non-sticky wall",
        Regime::SpSw => "sticky particles on a sticky wall",
    };
    format!("{} ({what})", regime.name())
}

/// How sure the share of captures at the busiest wall is, and how many hits leave a stated range.
fn certainty(comparison: &RunComparison<'_>, run: &RunResults) -> Option<String> {
    let wall = busiest_wall(comparison, run)?;
    let totals = comparison.totals(run, wall)?;
    let hits = run.arrived(wall, comparison.time).map(|(hits, _)| hits.count).filter(|hits| *hits > 0)?;
    let [low, high] = wilson(share(totals.captured.count as f64, hits as f64), hits as f64).map(percent);
    let mut text = format!(
        "With {hits} hits, chance alone leaves {low} to {high} for the share captured by {wall} (95 %, independent \
            hits)"
    );
    let outside = comparison.walls.iter().filter_map(|wall| {
        let totals = comparison.totals(run, wall)?;
        Some([totals.outside_range? as f64, totals.hits?.count as f64])
    });
    let [outside, all] = outside.fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d]);
    if all > 0.0 {
        text += &format!(
            "; {} of all hits use a property or law outside of its stated range",
            percent(outside / all)
        );
    }
    Some(text + ".")
}

/// The wall that captures most.
fn busiest(comparison: &RunComparison<'_>, run: &RunResults) -> Option<String> {
    let wall = busiest_wall(comparison, run)?;
    let totals = comparison.totals(run, wall)?;
    let hits = run.arrived(wall, comparison.time).map(|(hits, _)| hits.count);
    let share = hits.map(|hits| (percent(share(totals.captured.count as f64, hits as f64)), hits));
    let mut text = match share {
        _ if totals.captured.count == 0 => return None,
        Some((share, hits)) => format!("Most is captured by {wall}: {share} of its {hits} hits"),
        None => format!("Most is captured by {wall}"),
    };
    if run.has_carbon && totals.captured_conversion.count > 0 {
        text += &format!(", at a mean conversion of {}", number(totals.captured_conversion.mean));
    }
    Some(text + ".")
}

/// The regime with most captured mass at some walls, and its share [1].
fn main_regime(comparison: &RunComparison<'_>, run: &RunResults, walls: &[String]) -> Option<(Regime, f64)> {
    let mut masses = [0.0; 4];
    for regimes in walls.iter().filter_map(|wall| comparison.totals(run, wall)?.regimes) {
        masses.iter_mut().zip(regimes).for_each(|(sum, amount)| *sum += amount.mass());
    }
    let all: f64 = masses.iter().sum();
    let regime =
        Regime::ALL.into_iter().max_by(|a, b| masses[*a as usize].total_cmp(&masses[*b as usize]))?;
    (all > 0.0).then(|| (regime, masses[regime as usize] / all))
}

/// What stock models do with the same cloud at walls where our model captures a part of what arrives.
fn beside_stock(comparison: &RunComparison<'_>, own_label: &str, ours: &RunResults) -> Option<String> {
    let time = comparison.time;
    let part = |wall: &String| {
        let arriving = ours.arrived(wall, time).filter(|(hits, _)| hits.mass() > 0.0)?.0.mass();
        Some(format!("{} at {wall}", percent(ours.captured(wall, time)?.mass() / arriving)))
    };
    let held: Vec<String> = comparison.walls.iter().filter_map(part).collect();
    let stock = comparison.each().filter(|(_, other)| !other.is_ours() && other.cloud == ours.cloud);
    let constants: Vec<String> = stock
        .filter_map(|(label, stock)| {
            let walls = |wanted: &dyn Fn(&str) -> bool| {
                let names = comparison.walls.iter().map(String::as_str).filter(|wall| wanted(wall));
                names.collect::<Vec<_>>().join(", ")
            };
            let all = walls(&|wall| stock.captures_all(wall, time));
            let nothing =
                walls(&|wall| stock.captured(wall, time).is_some_and(|amount| amount.mass() == 0.0));
            let parts =
                [("all", all), ("nothing", nothing)].into_iter().filter(|(_, walls)| !walls.is_empty());
            let parts: Vec<String> = parts.map(|(what, walls)| format!("{what} at {walls}")).collect();
            (!parts.is_empty()).then(|| format!("{label} holds {}", parts.join(" and ")))
        })
        .collect();
    (!held.is_empty() && !constants.is_empty()).then(|| {
        format!(
            "Of the arriving mass {own_label} holds {}, where {}",
            held.join(", "),
            constants.join(", and ")
        )
    })
}

/// Share of the captured mass below the conversion [`RAW`] [1].
fn raw_share(masses: &ByConversion) -> f64 {
    share(masses[..(10.0 * RAW) as usize].iter().sum(), masses.iter().sum())
}
