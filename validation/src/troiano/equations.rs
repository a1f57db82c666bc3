//! Equations 1 to 6: the normal impact, as printed and as it has to be.

use std::f64::consts::PI;

use nearwall::Model;
use nearwall::normal::{
    Contact, NormalLaw, adhesive_velocity, plastic_term, reduced_modulus, restitution, yield_velocity,
};
use nearwall_lab::report::number;

use super::published::{PYREX, SOLIDS, TARGETS, WAX_DIAMETER, YIELD_RATIO};
use super::{Result, contact, model};
use crate::steps::even;
use crate::{Claim, Published, StudyPart};

/// Number under the root of Eq. 1: as printed, and as it has to be.
pub(super) const AS_PRINTED: f64 = 4.0 / 3.0;
const MENDED: f64 = 16.0 / 9.0;

/// The paper's composite modulus `K` [Pa].
fn composite_modulus(contact: &Contact) -> f64 {
    4.0 / 3.0 * contact.reduced_modulus
}

/// Eq. 1 [m/s] with `factor` under the root, for a diameter [m].
pub(super) fn equation_1(factor: f64, contact: &Contact, diameter: f64) -> f64 {
    let (energy, k) = (contact.work_of_adhesion, composite_modulus(contact));
    let root = factor * (2.0 * energy / diameter).powi(5) / (contact.density.powi(3) * k * k);
    1.84 * root.powf(1.0 / 6.0)
}

/// Eq. 6 without adhesion [1], with the inner root's argument given.
fn equation_6(w: f64, inner: f64) -> f64 {
    6.0 * 3f64.sqrt() / 5.0 * (1.0 - w * w / 6.0) * (w / (w + 2.0 * inner.sqrt())).sqrt()
}

/// The part on the normal impact.
pub(super) fn part() -> Result<StudyPart> {
    let model = model!("targets.toml")?;
    let on = |wall: &str| contact(&model, wall, YIELD_RATIO.value, |_| {});
    let (pyrex, teflon) = (on("pyrex")?, on("teflon")?);
    Ok(StudyPart {
        heading: "Equations 1 to 6: the normal impact".to_owned(),
        text: vec![
            "Each equation was computed as printed and compared with Thornton and Ning's closed form, which \
             the library uses and which the study of independent checks integrates numerically. Two of six \
             contain an error. Neither changes a conclusion of the paper by itself; the one in Eq. 6 cannot \
             have been in the authors' calculation, since e_n would jump at v_y."
                .to_owned(),
            "A third point is a gap, not an error: Eq. 4 lets particles rebound from v_s on, while Eq. 6 \
             with the same v_s is negative up to about twice that speed when v_y < v_s, as it is here. By \
             these equations wax sticks on Pyrex up to the speed at which Eq. 6 vanishes."
                .to_owned(),
        ],
        claims: vec![
            sticking_velocity(&pyrex),
            modulus(&model)?,
            yielding(&pyrex),
            sticking(&pyrex),
            elastic(&teflon),
            plastic(),
        ],
        ..StudyPart::default()
    })
}

/// An equation over what the library has in its place [1]: to rounding.
fn same(place: &str, what: &str, ratio: f64) -> Claim {
    Claim::derived(place, what, Published::within(1.0, 1e-9), ratio)
}

/// Eq 1.
fn sticking_velocity(pyrex: &Contact) -> Claim {
    let ratio = |factor| equation_1(factor, pyrex, WAX_DIAMETER) / adhesive_velocity(pyrex, WAX_DIAMETER);
    Claim::derived_statement(
        "Eq 1",
        "number under the sixth root, with K = 4E*/3",
        "4/3",
        &format!("16/9; as printed v_s is {} of Thornton and Ning's", number(ratio(AS_PRINTED))),
        (ratio(AS_PRINTED) - 1.0).abs() < 0.005,
    )
    .because(&format!(
        "K² = 16 E*²/9 in the denominator needs 16/9 in the numerator; with it the ratio is {}.",
        number(ratio(MENDED))
    ))
}

/// Eq 2.
fn modulus(model: &Model) -> Result<Claim> {
    let pyrex = model.find_wall("pyrex").ok_or("no wall pyrex")?;
    let wax = model.particle().mechanical(293.15)?;
    let glass = model.walls()[pyrex].material().mechanical(293.15)?;
    let [_, on_wax, ..] = &TARGETS;
    let [(_, _, [wax_modulus, _], _), ..] = SOLIDS;
    let compliance = |poisson: f64, modulus: f64| (1.0 - poisson.powi(2)) / modulus;
    let printed =
        4.0 / 3.0 / (compliance(on_wax.poisson, wax_modulus) + compliance(PYREX.poisson, PYREX.modulus));
    Ok(same(
        "Eq 2",
        "K of wax on Pyrex over 4E*/3 of the library [1]",
        printed / (4.0 / 3.0 * reduced_modulus(&wax, &glass)),
    ))
}

/// Eq 3.
fn yielding(pyrex: &Contact) -> Claim {
    let stiffness = (2.0 * PI / (3.0 * composite_modulus(pyrex))).powi(2);
    let printed = stiffness * (0.4 / pyrex.density).sqrt() * pyrex.limiting_pressure().powf(2.5);
    same("Eq 3", "v_y as printed over v_y of the library [1]", printed / yield_velocity(pyrex))
}

/// Eq 4.
fn sticking(pyrex: &Contact) -> Claim {
    let printed = equation_1(AS_PRINTED, pyrex, WAX_DIAMETER);
    let speeds = NormalLaw::ThorntonNing.speeds(pyrex, WAX_DIAMETER);
    Claim::derived_statement(
        "Eq 4",
        "wax on Pyrex, c = 0.7: the speed up to which e_n is 0 [m/s]",
        &format!("v_s of Eq. 1: {}", number(printed)),
        &format!("{}, where Eq. 6 vanishes", number(speeds.sticking)),
        (speeds.sticking / speeds.adhesive - 1.0).abs() < 0.05,
    )
    .because(&format!(
        "Here v_y is {:.0} times less than v_s, so the loss by yielding adds to adhesion and the sticking \
         velocity grows {:.1} times. Eq. 4 belongs to an impact that stays elastic (v_s < v_y). No test of \
         the paper had such low speeds.",
        printed / speeds.yielding,
        speeds.sticking / printed
    ))
}

/// Eq 5.
fn elastic(teflon: &Contact) -> Claim {
    let (adhesive, yielding) = (adhesive_velocity(teflon, WAX_DIAMETER), yield_velocity(teflon));
    let speed = 0.5 * (adhesive + yielding);
    let printed = (1.0 - (adhesive / speed).powi(2)).sqrt();
    same(
        "Eq 5",
        "e_n between v_s and v_y (Teflon, its only elastic window), formula over library [1]",
        printed / restitution(speed, adhesive, yielding),
    )
}

/// Eq 6.
fn plastic() -> Claim {
    let [plus, product] = [equation_6(1.0, 1.4), equation_6(1.0, 0.24)].map(f64::sqrt);
    let largest_gap = even([0.001, 1.0], 1000)
        .map(|w| (equation_6(w, 1.2 - w * w / 5.0) - plastic_term(w)).abs())
        .fold(0.0, f64::max);
    Claim::derived_statement(
        "Eq 6",
        "inner root: e_n at v_y without adhesion (1 if the branches join)",
        "no sign between 6/5 and 1/5 (v_y/v_i)²",
        &format!("1 with a minus; {} with a plus, {} as a product", number(plus), number(product)),
        (plus - 1.0).abs() < 0.005 || (product - 1.0).abs() < 0.005,
    )
    .because(&format!(
        "A minus sign is missing, in print or in the scan: only 6/5 - (v_y/v_i)²/5 joins Eq. 5. With it Eq. \
         6 is the library's plastic term within {}.",
        number(largest_gap)
    ))
}
