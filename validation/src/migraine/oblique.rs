//! Set 4: impacts at 43 to 77 degrees from the normal, and what the paper's words fix of `oblique-angle`.

use nearwall::{ImpactRng, Model};
use nearwall_lab::report::{Chart, Figure, Table, number};
use statrs::distribution::{Discrete, Hypergeometric};

use super::published::{PARTING, RATIO, SETS, Set, near_normal};
use super::sample::{Sampler, Spread};
use super::statistics::{binomial, mean};
use super::{MEASURED_ADHESION, PLAIN, Result, impact, model, with};
use crate::claim::{Claim, Published};
use crate::steps::even;
use crate::study::{Extent, StudyPart, table};

const SEED: u64 = 14;
const EXPONENTS: [f64; 3] = [0.0, 0.5, 1.0];
const STRENGTHS: [f64; 7] = [0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5];
/// Restitution of agglomerates and its spread [1]: assumed.
const AGGLOMERATES: [f64; 2] = [0.8, 0.1];
/// Strength and exponent of `validation/migraine/calibrated.toml`.
const CHOSEN: [f64; 2] = [1.0, 0.5];

pub fn part(extent: Extent) -> Result<StudyPart> {
    let plain = with(&model(PLAIN)?, &[("adhesion-energy", &[MEASURED_ADHESION])])?;
    Ok(StudyPart {
        heading: "Oblique impacts (set 4, Fig 5)".to_owned(),
        text: text(),
        tables: vec![strengths(&plain, extent)?],
        figures: vec![figure(&plain)?],
        claims: claims(&plain)?,
    })
}

fn text() -> Vec<String> {
    let [below, rebounds] = near_normal();
    let [least, _, largest] = SETS[3].angle;
    let oblique = SETS[3].rebounds();
    vec![
        format!(
            "The paper fixes three things: T&N overestimates e_n at {least:.0} to {largest:.0}°; more so as \
             v_n grows; below about 45° e_n depends on v_n alone (other works). The only e_n it prints is \
             \"all below 0.6\". The form of oblique-angle, exp(-a sin⁴(theta) (v_n/1 m/s)^p), is assumed; \
             the paper's words fix only the signs of its parameters a and p."
        ),
        format!(
            "\"All below 0.6\" is no evidence against T&N by itself: its curve for {} sigma_y lies below \
             0.6 there. It does show that the quarter of weak dissipation is missing: {} of {oblique}, \
             where the near-normal sets have {} of {rebounds}. Either obliquity also lowers those impacts, \
             or that run had no agglomerates.",
            RATIO[0],
            oblique - SETS[3].below,
            rebounds - below
        ),
    ]
}

/// `e_n` at an angle from the normal [degrees].
fn at(model: &Model, speed: f64, angle: f64) -> Result<f64> {
    let arriving = impact(9e-6, speed, speed * angle.to_radians().tan());
    Ok(model.resolve_with(0, &arriving, |_| 0.5)?.normal_restitution)
}

fn figure(plain: &Model) -> Result<Figure> {
    let mut chart = Chart::new("Head-on over oblique e_n", "normal speed v_n [m/s]", "e_n(0)/e_n(60.6°) [1]")
        .y_range(0.8, 4.0);
    for exponent in EXPONENTS {
        let oblique = with(plain, &[("oblique-angle", &[CHOSEN[0], exponent, 2.0])])?;
        let mut line = Vec::new();
        for speed in even(SETS[3].normal, 60) {
            line.push([speed, ratio(&oblique, speed, SETS[3].angle[1])?]);
        }
        chart = chart.line(&format!("a = {}, p = {exponent}", CHOSEN[0]), &line);
    }
    Ok(chart.mark_y(1.0, "T&N").figure(
        "migraine-oblique",
        "The ratio must exceed 1 and grow with v_n: so a > 0 and p > 0. Size and curvature are free, as no \
         e_n of set 4 is printed.",
    ))
}

/// For each strength: the fraction of agglomerates with which set 1 has its published share below
/// 0.6, and the share of campaigns like set 4 in which all 41 rebounds lie below.
fn strengths(plain: &Model, extent: Extent) -> Result<Table> {
    let replicates = extent.count(1000) as u64;
    let mut rows = Vec::new();
    for strength in STRENGTHS {
        let mut row = vec![number(strength)];
        for (spread, _) in Spread::ALL {
            row.extend(both_numbers(plain, strength, spread, replicates)?);
        }
        rows.push(row);
    }
    let caption = format!(
        "Both parameters: fraction of agglomerates (restitution {}, spread {}, assumed) with which set 1 \
         has {} % below 0.6 although obliquity also lowers agglomerates, the resulting share of campaigns \
         like set 4 that have all {} below 0.6, and their mean e_n, against the strength a (p = {}, \
         assumed; seed {SEED}). The calibrated model takes the weakest a, in quarters, that keeps most \
         campaigns below.",
        AGGLOMERATES[0],
        AGGLOMERATES[1],
        SETS[0].below_percent,
        SETS[3].rebounds(),
        CHOSEN[1]
    );
    let header = "strength a [1] | v_n even: fraction | all below | mean e_n of set 4 | v_n log-even: \
        fraction | all below | mean e_n of set 4";
    Ok(table(&caption, 0, header, rows))
}

/// The fraction, the share of campaigns and their mean `e_n` of one strength.
fn both_numbers(plain: &Model, strength: f64, spread: Spread, replicates: u64) -> Result<[String; 3]> {
    let [restitution, deviation] = AGGLOMERATES;
    let population = |fraction: f64| {
        let effects: [(&str, &[f64]); 2] = [
            ("agglomerates", &[fraction, restitution, deviation]),
            ("oblique-angle", &[strength, CHOSEN[1], 2.0]),
        ];
        with(plain, &effects)
    };
    let needed = 1.0 - SETS[0].below as f64 / SETS[0].rebounds() as f64;
    // Grains alone never pass 0.6, so the share goes with the fraction.
    let above: Vec<f64> = e_n(&population(1.0)?, SETS[0], spread, 20 * replicates)?
        .map(|e| f64::from(u8::from(e > PARTING)))
        .collect();
    let fraction = needed / mean(&above);
    if fraction > 1.0 {
        return Ok(["more than all", "–", "–"].map(str::to_owned));
    }
    let count = SETS[3].impacts;
    let found: Vec<f64> = e_n(&population(fraction)?, SETS[3], spread, count as u64 * replicates)?.collect();
    let all = found.chunks(count).filter(|campaign| campaign.iter().all(|e| *e < PARTING)).count();
    let share = all as f64 / replicates as f64;
    Ok([format!("{fraction:.2}"), format!("{share:.2}"), format!("{:.2}", mean(&found))])
}

/// Normal restitutions of `count` impacts of a set.
fn e_n(model: &Model, set: Set, spread: Spread, count: u64) -> Result<impl Iterator<Item = f64>> {
    let sampler = Sampler::new(set, spread)?;
    let mut found = Vec::new();
    for key in 0..count {
        let draw = ImpactRng::new(SEED, key);
        found.push(model.resolve(0, &sampler.impact(draw), draw)?.normal_restitution);
    }
    Ok(found.into_iter())
}

fn claims(plain: &Model) -> Result<Vec<Claim>> {
    let oblique = with(plain, &[("oblique-angle", &[CHOSEN[0], CHOSEN[1], 2.0])])?;
    Ok(vec![
        differs_from_near_normal()?,
        overestimate(&oblique)?,
        below_45(&oblique)?,
        Claim::unchecked(
            "Fig 5",
            "size of the overestimate",
            "\"significantly\"",
            "No e_n of set 4 is printed, so a and p cannot be fitted, only bounded by 0.6.",
        ),
    ])
}

/// Head-on over oblique `e_n` at an angle from the normal [degrees].
fn ratio(model: &Model, speed: f64, angle: f64) -> Result<f64> {
    Ok(at(model, speed, 0.0)? / at(model, speed, angle)?)
}

fn differs_from_near_normal() -> Result<Claim> {
    let [below, rebounds] = near_normal();
    let above = rebounds - below;
    let oblique = SETS[3].rebounds();
    let chance = Hypergeometric::new((rebounds + oblique) as u64, above as u64, oblique as u64)?.pmf(0);
    let at_most = binomial(0, oblique, 0.05)?[1];
    Ok(Claim::derived_statement(
        "set 4 against sets 1, 2, 3, 5",
        &format!(
            "oblique impacts differ from near-normal ones: probability of 0 of {oblique} above 0.6 when the \
             others have {above} of {rebounds}"
        ),
        "e_n depends on the angle, too",
        &format!("{chance:.1e} (exact test); at most {:.1} % above 0.6 in set 4 (95 %)", 100.0 * at_most),
        chance < 0.01,
    )
    .because(
        "The test shows that the sets differ, not that the angle is the cause: set 4 also had a weaker \
         plasma and another target.",
    ))
}

fn overestimate(oblique: &Model) -> Result<Claim> {
    let ([slow, fast], angle) = (SETS[3].normal, SETS[3].angle[1]);
    let (at_slow, at_fast) = (ratio(oblique, slow, angle)?, ratio(oblique, fast, angle)?);
    Ok(Claim::fitted_statement(
        "section 4, near-tangential",
        &format!(
            "T&N overestimates e_n, the more the higher v_n: e_n(0)/e_n({angle}°) at {slow} and {fast} m/s"
        ),
        "> 1 and rising",
        &format!("{at_slow:.2} and {at_fast:.2}"),
        at_slow > 1.0 && at_fast > at_slow,
    )
    .because("The signs of a and p were chosen for it."))
}

fn below_45(oblique: &Model) -> Result<Claim> {
    Ok(Claim::predicted(
        "section 4, near-tangential",
        "up to about 45° e_n depends on v_n alone: e_n(0)/e_n(30°) at 3 m/s",
        Published::Between(0.95, 1.25),
        ratio(oblique, 3.0, 30.0)?,
    )
    .because(
        "\"Alone\" is taken as within 25 % of e_n, far inside the scatter; sin⁴ leaves 1/16 of a at 30° but \
         a quarter at 45°, where the effect is not small.",
    ))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]
    use super::super::CALIBRATED;
    use super::*;

    #[test]
    fn the_calibrated_model_has_what_is_chosen_here() {
        let calibrated = model(CALIBRATED).unwrap();
        let term = calibrated.terms().iter().find(|term| term.kind().id == "oblique-angle").unwrap();
        assert_eq!(term.values()[..2], CHOSEN);
    }
}
