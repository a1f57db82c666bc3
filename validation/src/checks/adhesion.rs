//! The elastic–adhesive branch beside the energy of JKR's cycle.

use std::f64::consts::PI;

use nearwall::normal::{Contact, adhesive_velocity, restitution};
use nearwall_lab::report::{Chart, Figure, Table, number};

use super::{Result, WAX_PARTICLE_DIAMETER, wax_on_pyrex};
use crate::claim::{Claim, Published};
use crate::oracle::jkr::{Cycle, Jkr};
use crate::steps::{even, even_in_logarithm};
use crate::study::{StudyPart, table};

const PLACE: &str = "Thornton & Ning 1998";

/// Quadrature in double precision: what is left of sixteen digits after some thousand operations.
const QUADRATURE: f64 = 1e-10;

pub fn part() -> Result<StudyPart> {
    Ok(StudyPart {
        heading: "Adhesion: energy of the JKR cycle".to_owned(),
        text: text(),
        tables: vec![conventions()],
        figures: vec![curve(), restitutions()],
        claims: claims()?,
    })
}

fn text() -> Vec<String> {
    vec![
        "The force of Johnson, Kendall & Roberts is integrated over the displacement: contact forms at zero \
         separation, where the force snaps to -8/9 of the largest pull without doing work; in and out along \
         the same curve; past zero load and past the largest pull to where the contact opens although the \
         displacement is held (5/9 of the largest pull). What is lost equals m v_adh²/2."
            .to_owned(),
        format!(
            "Other conventions give other constants: Thornton and Ning's is the first row. Energy that is \
             free when the contact forms counts as lost in it; if it sped the particle up instead, only {} \
             of the energy would be lost.",
            number(Jkr::UNIT.lost(Cycle::SnapInCounted) / Jkr::UNIT.lost(Cycle::FixedGrips))
        ),
    ]
}

fn claims() -> Result<Vec<Claim>> {
    let closed = 3f64.sqrt() / 2.0 * PI.cbrt() * ((1.0 + 6.0 * 4f64.cbrt()) / 5.0).sqrt();
    let factor = Jkr::UNIT.adhesive_velocity(Cycle::FixedGrips);
    let none = |what: &str, ours| Claim::derived(PLACE, what, Published::within(0.0, QUADRATURE), ours);
    Ok(vec![
        Claim::derived(
            PLACE,
            "factor C1 of the adhesive velocity, from the work of the JKR force by quadrature",
            Published::within(1.84, 0.005),
            factor,
        ),
        none(
            "C1 by quadrature over its closed form (√3/2) π^(1/3) √((1+6·2^(2/3))/5), less 1",
            factor / closed - 1.0,
        ),
        none(
            "v_adh of the library over that of the quadrature, less 1: largest of 81 contacts",
            worst_adhesive_velocity()?,
        ),
        none(
            "e_n of an elastic impact, library less whole cycle in and out: largest for v = 1.001 to 10⁴ \
             v_adh",
            worst_restitution(),
        ),
    ])
}

fn conventions() -> Table {
    let row = |name: &str, cycle| {
        let factor = Jkr::UNIT.adhesive_velocity(cycle);
        vec![name.to_owned(), format!("{factor:.10}"), number(Jkr::UNIT.lost(cycle))]
    };
    table(
        "C1 in v_adh = C1 (W⁵/(rho³ E*² R⁵))^(1/6), and the energy lost in units of (W⁵ R⁴/E*²)^(1/3)",
        1,
        "cycle | C1 | lost",
        vec![
            row("forms without work, opens at fixed grips (Thornton & Ning)", Cycle::FixedGrips),
            row("forms without work, opens at the largest pull (dead weight)", Cycle::FixedLoad),
            row("snap-in speeds the particle up, opens at fixed grips", Cycle::SnapInCounted),
        ],
    )
}

/// Wax on Pyrex, with each of size, stiffness, density and adhesion a thousandth and a thousandfold of it.
fn worst_adhesive_velocity() -> Result<f64> {
    let wax = wax_on_pyrex()?;
    let factors = [1e-3, 1.0, 1e3];
    let mut worst = 0.0;
    for code in 0..81_usize {
        let factor = |place: u32| factors[code / 3_usize.pow(place) % 3];
        let contact = Contact {
            density: wax.density * factor(0),
            reduced_modulus: wax.reduced_modulus * factor(1),
            work_of_adhesion: wax.work_of_adhesion * factor(2),
            ..wax
        };
        let diameter = WAX_PARTICLE_DIAMETER * factor(3);
        let sphere = Jkr {
            radius: 0.5 * diameter,
            density: contact.density,
            reduced_modulus: contact.reduced_modulus,
            work_of_adhesion: contact.work_of_adhesion,
        };
        let off = adhesive_velocity(&contact, diameter) / sphere.adhesive_velocity(Cycle::FixedGrips) - 1.0;
        worst = larger(worst, off);
    }
    Ok(worst)
}

fn worst_restitution() -> f64 {
    let adhesive = Jkr::UNIT.adhesive_velocity(Cycle::FixedGrips);
    even_in_logarithm([1.001, 1.001e4], 60).fold(0.0, |worst, ratio| {
        larger(
            worst,
            restitution(ratio * adhesive, adhesive, f64::INFINITY) - Jkr::UNIT.restitution(ratio * adhesive),
        )
    })
}

/// The one farther from zero.
fn larger(one: f64, other: f64) -> f64 {
    if other.abs() > one.abs() { other } else { one }
}

fn curve() -> Figure {
    let sphere = Jkr::UNIT;
    let (opens, formed) = (sphere.opens_at_fixed_grips(), sphere.formed());
    let pull = -sphere.force(sphere.opens_at_fixed_load());
    let depth = -sphere.approach(opens);
    let along = |from: f64, to: f64| -> Vec<[f64; 2]> {
        let radii = even([from, to], 80);
        radii.map(|a| [sphere.approach(a) / depth, sphere.force(a) / pull]).collect()
    };
    let snap = [[0.0, 0.0], [0.0, sphere.force(formed) / pull]];
    Chart::new("The JKR cycle", "approach over that at opening [1]", "force over largest pull [1]")
        .line("in, and out as far as zero", &along(formed, 1.35 * formed))
        .line("out: the work that is lost", &along(formed, opens))
        .line("contact forms", &snap)
        .line("contact opens", &[[-1.0, sphere.force(opens) / pull], [-1.0, 0.0]])
        .figure(
            "checks-jkr",
            "Positive forces push apart. The loss is the area between the lower branch and zero.",
        )
}

fn restitutions() -> Figure {
    let adhesive = Jkr::UNIT.adhesive_velocity(Cycle::FixedGrips);
    let library: Vec<[f64; 2]> =
        even([0.8, 5.0], 200).map(|v| [v, restitution(v, 1.0, f64::INFINITY)]).collect();
    let oracle: Vec<[f64; 2]> = [1.02, 1.1, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0]
        .map(|ratio| [ratio, Jkr::UNIT.restitution(ratio * adhesive)])
        .to_vec();
    Chart::new("Elastic impact with adhesion", "speed over adhesive velocity [1]", "e_n [1]")
        .line("library", &library)
        .points("cycle in and out by quadrature", &oracle)
        .y_range(0.0, 1.0)
        .figure("checks-adhesion", "Restitution of an impact that does not yield.")
}
