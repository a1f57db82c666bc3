//! Both normal laws beside an impact that is followed through time.

use nearwall::normal::{Contact, NormalLaw};
use nearwall::report::{Chart, number};

use crate::claim::{Basis, Claim, Published};
use crate::oracle::normal_contact::{Impact, follow};
use crate::study::{Extent, Part};

/// Error of a step of the integration.
const TOLERANCE: f64 = 1e-10;
/// Diameter of the particle of the figures [m]; the result depends on `v_adh/v_y` and `v/v_y` alone.
const DIAMETER: f64 = 20e-6;

/// A contact whose adhesive velocity is so many times its yield velocity.
fn contact(ratio: f64) -> Contact {
    let without = Contact {
        density: 1000.0,
        reduced_modulus: 1e9,
        work_of_adhesion: 1.0,
        yield_strength: 1e7,
        yield_ratio: 1.0,
        stiffness_ratio: 0.7,
    };
    let speeds = NormalLaw::ThorntonNing.speeds(&without, DIAMETER);
    // v_adh goes with W^(5/6).
    Contact { work_of_adhesion: (ratio * speeds.yielding / speeds.adhesive).powf(1.2), ..without }
}

/// Ammonium fluorescein of 4.9 µm, the case of which Thornton & Ning's numerical result is known.
const FLUORESCEIN_DIAMETER: f64 = 4.9e-6;

fn fluorescein() -> Contact {
    let compliance = |modulus: f64| (1.0 - 0.3 * 0.3) / modulus;
    Contact {
        density: 1350.0,
        reduced_modulus: 1.0 / (compliance(1.2e9) + compliance(182e9)),
        work_of_adhesion: 0.2,
        yield_strength: 35.3e6,
        yield_ratio: 1.0,
        stiffness_ratio: 0.7,
    }
}

/// `e_n` of the impact as it is followed.
fn followed(contact: &Contact, diameter: f64, speed: f64) -> f64 {
    let impact = Impact {
        radius: 0.5 * diameter,
        density: contact.density,
        reduced_modulus: contact.reduced_modulus,
        work_of_adhesion: contact.work_of_adhesion,
        limiting_pressure: contact.limiting_pressure(),
        speed,
    };
    follow(&impact, TOLERANCE).rebound_speed / speed
}

fn restitution(law: NormalLaw, contact: &Contact, diameter: f64, speed: f64) -> f64 {
    law.restitution(contact, diameter, speed).unwrap_or(0.0)
}

/// Evenly in the logarithm from one end to the other.
fn decades(low: f64, high: f64, count: usize) -> Vec<f64> {
    let step = (high / low).ln() / (count - 1) as f64;
    (0..count).map(|i| low * (step * i as f64).exp()).collect()
}

/// Heading of the part.
pub(super) const HEADING: &str = "Normal impact, followed through time";

/// The part.
pub fn part(extent: Extent) -> Part {
    let steps = extent.count(120).max(25);
    let mut worst = 0.0_f64;
    let mut curves =
        Chart::new("Where the closed form parts from the contact", "v / v_y [1]", "e_n [1]").log_x();
    for ratio in [0.3, 3.0, 30.0] {
        let contact = contact(ratio);
        let plain = NormalLaw::ThorntonNing.speeds(&contact, DIAMETER);
        let raised = NormalLaw::RaisedPullOff.speeds(&contact, DIAMETER);
        let speeds = decades(0.9 * plain.sticking, 30.0 * raised.sticking, steps);
        let line = |e_n: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
            speeds.iter().map(|v| [v / plain.yielding, e_n(*v)]).collect()
        };
        let of = |law: NormalLaw| line(&|v| restitution(law, &contact, DIAMETER, v));
        let (closed, raised) = (of(NormalLaw::ThorntonNing), of(NormalLaw::RaisedPullOff));
        let truth = line(&|v| followed(&contact, DIAMETER, v));
        let gap = raised.iter().zip(&truth).map(|(a, b)| (a[1] - b[1]).abs()).fold(0.0, f64::max);
        worst = worst.max(gap);
        let few: Vec<[f64; 2]> = truth.iter().step_by(6).copied().collect();
        curves = curves
            .line(&format!("closed form, v_adh/v_y = {ratio}"), &closed)
            .line(&format!("raised pull-off, {ratio}"), &raised)
            .points(&format!("followed, {ratio}"), &few);
    }
    let curves = curves.figure(
        "checks-normal-contact",
        "Points: an impact followed through time, JKR in, pressure cut at p_y, JKR out with the flattened radius. The closed form \
         lets particles go that the flattened contact still holds, the more the larger v_adh/v_y.",
    );
    Part {
        heading: HEADING.to_owned(),
        text: vec![
            "The closed form of Thornton & Ning adds what adhesion and yielding take. Yielding also flattens the contact, and a \
             flatter contact is harder to part: the law thornton-ning-raised-pull-off has that, the default has not. The oracle \
             integrates the motion and uses neither formula; law and oracle share the assumptions of Thornton & Ning's contact, \
             so their agreement proves the algebra, not the physics."
                .to_owned(),
        ],
        figures: vec![curves, ratios(extent)],
        claims: claims(worst),
        ..Part::default()
    }
}

fn ratios(extent: Extent) -> nearwall::report::Figure {
    let ratios = decades(0.05, 100.0, extent.count(80).max(20));
    let line: Vec<[f64; 2]> = ratios
        .iter()
        .map(|&ratio| {
            let contact = contact(ratio);
            let sticking = |law: NormalLaw| law.speeds(&contact, DIAMETER).sticking;
            [ratio, sticking(NormalLaw::RaisedPullOff) / sticking(NormalLaw::ThorntonNing)]
        })
        .collect();
    Chart::new(
        "How much the closed form under-predicts sticking",
        "v_adh / v_y [1]",
        "v_s raised / v_s closed [1]",
    )
    .log_x()
    .log_y()
    .line("ratio of sticking velocities", &line)
    .mark_x(1.3, "wax on wax")
    .mark_x(3.1, "fluorescein")
    .mark_x(17.8, "wax on Pyrex")
    .figure(
        "checks-normal-ratio",
        "Below v_adh/v_y = 0.5 both say the same. Beyond, adhesion alone begins to yield the contact.",
    )
}

fn claims(worst: f64) -> Vec<Claim> {
    let fluorescein = fluorescein();
    let sticking = |law: NormalLaw| law.speeds(&fluorescein, FLUORESCEIN_DIAMETER).sticking;
    let source = "Thornton & Ning 1998";
    let what = "v_s of ammonium fluorescein, 4.9 µm [m/s]";
    vec![
        Claim::number(
            "oracle",
            "e_n of raised pull-off less that of the followed impact, largest over the figure [1]",
            Published::Below(1e-8),
            worst,
            Basis::Derived,
        )
        .because("400 further cases, all branches: cargo test --test contact_integration"),
        Claim::number(
            source,
            &format!("{what}, closed form"),
            Published::within(0.69, 0.005),
            sticking(NormalLaw::ThorntonNing),
            Basis::Predicted,
        ),
        Claim::number(
            source,
            &format!("{what}, their numerical solution"),
            Published::within(1.6, 0.05),
            sticking(NormalLaw::RaisedPullOff),
            Basis::Predicted,
        )
        .because(&format!(
            "{} % low. How adhesion enters after yield is read differently: cutting the pressure at p_y all the time gives 1.46, a \
             stiffness after yield as we recall it of the paper (not at hand) 1.82. The default law gives 0.69, so most of the gap is \
             closed",
            number((100.0 * (1.0 - sticking(NormalLaw::RaisedPullOff) / 1.6)).round())
        )),
    ]
}
