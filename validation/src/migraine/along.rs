//! Laws of `e_t` (Fig 2, Eq. 4): constant, sliding, sliding or rolling, compliance, over the angles of each set.

use nearwall::tangential::TangentialLaw;
use nearwall::{Impact, ImpactRng, Model};
use nearwall_lab::report::{Chart, Figure, Table, number};

use super::curves::contact;
use super::published::{E_T, RATIO, SETS, Set};
use super::sample::{Sampler, Spread, angle};
use super::statistics::{mean, quantile};
use super::{PLAIN, Result, impact, model, with};
use crate::claim::{Claim, Published};
use crate::steps::even_in_logarithm;
use crate::study::{Extent, StudyPart, table};

const SEED: u64 = 12;

/// Impacts of every set under the first assumption.
type Drawn = Vec<Vec<Impact>>;

pub fn part(extent: Extent) -> Result<StudyPart> {
    let plain = model(PLAIN)?;
    let drawn = drawn(extent.count(4000) as u64)?;
    let friction = friction_of_set_4(&plain, &drawn)?;
    let mut claims = constant().to_vec();
    claims.extend([order(&plain, &drawn)?, rolling(&plain, &drawn, friction)?]);
    claims.extend([least(&plain, &SETS[0])?, least(&plain, &SETS[3])?]);
    claims.extend(dissipation(&plain, &drawn)?);
    Ok(StudyPart {
        heading: "Tangential restitution (Fig 2, Eq. 4)".to_owned(),
        text: vec![
            format!(
                "Eq. 4, e_t = 1 - mu (v_n/v_t)(1 + e_n), takes much where v_t is small and little where it \
                 is large. The sets print the opposite: the oblique set 4, with the largest v_t, keeps \
                 least ({}). The mu that gives set 4 its mean is {}; over the angles of sets 1, 2, 3 and 5 \
                 the same mu stops most of the motion along the wall if it goes on sliding, and leaves \
                 rolling's 5/7 = 0.714 if it does not.",
                SETS[3].e_t,
                number(friction)
            ),
            format!(
                "Rolling would be independent of both speeds, as printed, for near-normal impacts, and 5/7 \
                 lies close to {} to {}; but {} and {} lie above it. tangential-compliance can lie above \
                 5/7 near head-on (its `near_normal`), with a shape that is assumed. No law with friction \
                 explains minima of {} and {}: sliding ends where 1 - 2k/(7k-1) = {:.2} is left.",
                SETS[3].e_t,
                SETS[4].e_t,
                SETS[2].e_t,
                SETS[0].e_t,
                SETS[0].least_e_t.unwrap_or(f64::NAN),
                SETS[3].least_e_t.unwrap_or(f64::NAN),
                end_of_sliding(&plain)?
            ),
        ],
        tables: vec![means_table(&plain, &drawn, friction)?],
        figures: vec![figure(&plain, friction)?],
        claims,
    })
}

fn drawn(count: u64) -> Result<Drawn> {
    let of = |set: &Set| -> Result<Vec<Impact>> {
        let sampler = Sampler::new(*set, Spread::Even)?;
        Ok((0..count).map(|key| sampler.impact(ImpactRng::new(SEED, key))).collect())
    };
    SETS.iter().map(of).collect()
}

/// The law in place of the constant one.
fn law(plain: &Model, tangential: TangentialLaw) -> Model {
    plain.with_laws(plain.normal_law(), tangential)
}

/// Restitution along the wall of each rebound.
fn e_t(model: &Model, impacts: &[Impact]) -> Result<Vec<f64>> {
    let mut kept = Vec::new();
    for impact in impacts {
        let outcome = model.resolve_with(0, impact, |_| 0.5)?;
        if !outcome.stuck {
            kept.push(outcome.tangential_restitution);
        }
    }
    Ok(kept)
}

fn friction_of_set_4(plain: &Model, drawn: &Drawn) -> Result<f64> {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..20 {
        let friction = 0.5 * (low + high);
        let sliding = law(plain, TangentialLaw::Sliding { friction });
        if mean(&e_t(&sliding, &drawn[3])?) > SETS[3].e_t { low = friction } else { high = friction }
    }
    Ok(0.5 * (low + high))
}

/// Largest mu with which half of campaigns like set 1 keep the least e_t above the printed 0.61:
/// the smallest of n angles lies at the quantile `1 - 2^(-1/n)`.
fn friction_bound(plain: &Model, drawn: &Drawn) -> Result<f64> {
    let mut largest = Vec::new();
    let allowed = 1.0 - SETS[0].least_e_t.unwrap_or(0.0);
    for impact in &drawn[0] {
        let e_n = plain.resolve_with(0, impact, |_| 0.5)?.normal_restitution;
        largest.push(allowed * impact.tangential_speed / impact.normal_speed / (1.0 + e_n));
    }
    Ok(quantile(&largest, 1.0 - 0.5f64.powf(1.0 / SETS[0].rebounds() as f64)))
}

fn laws(plain: &Model, friction: f64) -> Result<Vec<(String, Model)>> {
    Ok(vec![
        ("constant 1 (old)".to_owned(), law(plain, TangentialLaw::Constant { restitution: 1.0 })),
        ("constant 0.8 (new)".to_owned(), plain.clone()),
        (format!("Eq. 4, mu = {}", number(friction)), law(plain, TangentialLaw::Sliding { friction })),
        (
            format!("sliding-rolling, {}", number(friction)),
            law(plain, TangentialLaw::SlidingRolling { friction }),
        ),
        (
            format!("tangential-compliance, {}, 1, 2.2", number(friction)),
            with(plain, &[("tangential-compliance", &[friction, 1.0, 2.2])])?,
        ),
    ])
}

fn means_table(plain: &Model, drawn: &Drawn, friction: f64) -> Result<Table> {
    let printed = |set: &Set| match set.least_e_t {
        Some(least) => format!("{} (least {least})", set.e_t),
        None => set.e_t.to_string(),
    };
    let mut rows =
        vec![std::iter::once("published".to_owned()).chain(SETS.iter().map(printed)).collect::<Vec<_>>()];
    for (name, model) in laws(plain, friction)? {
        let mut row = vec![name];
        for impacts in drawn {
            let kept = e_t(&model, impacts)?;
            let least = kept.iter().copied().fold(f64::INFINITY, f64::min);
            row.push(format!("{:.2} (least {least:.2})", mean(&kept)));
        }
        rows.push(row);
    }
    Ok(table(
        "Mean and least e_t over each set's angles (v_n spread evenly, assumed; seed 12; clean-metal \
         adhesion). mu is set to the mean of set 4. Sliding is stopped at 0 here; Eq. 4 itself goes below. \
         The compliance has wax's 1 and 2.2, which are not fitted to tungsten.",
        1,
        "law | set 1 | set 2 | set 3 | set 4 | set 5",
        rows,
    ))
}

fn figure(plain: &Model, friction: f64) -> Result<Figure> {
    let mut chart = Chart::new(
        "Tangential restitution against the ratio of the speeds",
        "v_n/v_t [1]: near-normal to the right",
        "e_t [1]",
    )
    .log_x()
    .y_range(0.0, 1.1)
    .y_step(0.2);
    for (name, model) in laws(plain, friction)?.into_iter().skip(1) {
        let mut line = Vec::new();
        for slope in even_in_logarithm([0.15, 60.0], 150) {
            let outcome = model.resolve_with(0, &impact(9e-6, 4.0, 4.0 / slope), |_| 0.5)?;
            line.push([slope, outcome.tangential_restitution]);
        }
        chart = chart.line(&name, &line);
    }
    let at_mean = |set: &Set| [1.0 / set.angle[1].to_radians().tan(), set.e_t];
    let points: Vec<[f64; 2]> = SETS.iter().map(at_mean).collect();
    Ok(chart.reference("published mean e_t at each set's mean angle", &points).figure(
        "migraine-e-t",
        "v_n = 4 m/s, 9 µm. Set 4 is the point on the left. A law with friction rises to the left; the \
         printed means do not.",
    ))
}

/// The mean over all sets.
fn constant() -> [Claim; 2] {
    let rebounds: f64 = SETS.iter().map(|set| set.rebounds() as f64).sum();
    let all: f64 = SETS.iter().map(|set| set.e_t * set.rebounds() as f64).sum::<f64>() / rebounds;
    let off = |constant: f64| mean(&SETS.map(|set| (set.e_t - constant).abs()));
    [
        Claim::derived(
            "section 4, 5 (ii)",
            "mean e_t of all rebounds, from the sets' means",
            Published::within(E_T, 0.05),
            all,
        ),
        Claim::fitted_statement(
            "section 4",
            "0.8 is more accurate than 1",
            "yes",
            &format!("mean distance from the sets' means {:.2}, against {:.2}", off(E_T), off(1.0)),
            off(E_T) < off(1.0),
        ),
    ]
}

/// Whether any friction gives the printed order of sets.
fn order(plain: &Model, drawn: &Drawn) -> Result<Claim> {
    let bound = friction_bound(plain, drawn)?;
    let sliding = law(plain, TangentialLaw::Sliding { friction: bound });
    let [near_normal, oblique] = [mean(&e_t(&sliding, &drawn[0])?), mean(&e_t(&sliding, &drawn[3])?)];
    Ok(Claim::derived_statement(
        "section 2, Eq. 4; sets 1 and 4",
        "the theory of e_t can be deemed oversimplified: no mu > 0 in Eq. 4 gives the printed order of sets \
         1 and 4",
        "0.86 near normal, 0.74 oblique",
        &format!(
            "mu = {} (largest with which set 1 stays above 0.61): {near_normal:.3} near normal, \
             {oblique:.3} oblique",
            number(bound)
        ),
        near_normal < oblique && oblique > SETS[3].e_t + 0.1,
    )
    .because(
        "d e_t/d(v_t/v_n) > 0 for every mu > 0, so the oblique set should have a larger e_t. It has a \
         smaller one. Independence of both speeds holds exactly for mu = 0 only, with which nothing is \
         lost.",
    ))
}

/// Set 1 by the friction of set 4.
fn rolling(plain: &Model, drawn: &Drawn, friction: f64) -> Result<Claim> {
    let rolling = law(plain, TangentialLaw::SlidingRolling { friction });
    Ok(Claim::predicted(
        "set 1",
        "mean e_t of set 1 by sliding or rolling, with the mu of set 4",
        Published::within(SETS[0].e_t, 0.005),
        mean(&e_t(&rolling, &drawn[0])?),
    )
    .because(&format!("A rigid sphere rolls (5/7) where set 1 has {}.", SETS[0].e_t)))
}

/// The least of a set against the least that a law leaves.
fn least(plain: &Model, set: &Set) -> Result<Claim> {
    Ok(Claim::derived(
        &set.name(),
        "least e_t (\"always exceeded\", taken as the least), against the least that sliding, rolling or \
         compliance leave above the critical angle",
        Published::within(set.least_e_t.unwrap_or(f64::NAN), 0.005),
        end_of_sliding(plain)?,
    )
    .because(
        "Scatter of single impacts (spin before the impact, agglomerates, measurement) is not described by \
         any law of a sphere without initial spin.",
    ))
}

/// `e_t` at the critical angle, where an elastic contact ceases to slide all through the impact.
fn end_of_sliding(plain: &Model) -> Result<f64> {
    let k = contact(plain, RATIO[0], None)?.stiffness_ratio;
    Ok(1.0 - 2.0 * k / (7.0 * k - 1.0))
}

/// Energy lost along the wall over energy lost towards it, with the printed mean e_t. What a sphere
/// gains as spin is not lost: friction gives it `R omega = 5/2 (1 - e_t) v_t`.
fn dissipation(plain: &Model, drawn: &Drawn) -> Result<Vec<Claim>> {
    let mut claims = Vec::new();
    for (set, impacts) in SETS.iter().zip(drawn) {
        let (mut along, mut towards) = (0.0, 0.0);
        let lost = 1.0 - set.e_t * set.e_t - 0.4 * (2.5 * (1.0 - set.e_t)).powi(2);
        for impact in impacts {
            let e_n = plain.resolve_with(0, impact, |_| 0.5)?.normal_restitution;
            along += lost * impact.tangential_speed.powi(2);
            towards += (1.0 - e_n * e_n) * impact.normal_speed.powi(2);
        }
        let angles: Vec<f64> = impacts.iter().map(angle).collect();
        claims.push(
            Claim::predicted(
                &format!("section 4, {}", set.name()),
                &format!("tangential over normal energy loss (mean angle {:.0}°)", mean(&angles)),
                Published::Below(1.0 / 3.0),
                along / towards,
            )
            .because(if set.number == 4 {
                "The oblique set 4 has mostly tangential speed; energy transferred to spin is not counted. \
                 \"Much less\" is taken as below a third."
            } else {
                "\"Much less\" is taken as below a third. The tangential speed is small, so its loss is \
                 small."
            }),
        );
    }
    Ok(claims)
}
