//! Resuspension of dry spheres by turbulent gas beside measured fractions.

use nearwall_lab::report::{Chart, Figure};

use crate::claim::{Claim, Published};
use crate::steps::even_in_logarithm;
use crate::study::StudyPart;

/// The table and its reader are those of the library's own tests: one copy of the data.
#[path = "../../../tests/common/measured_resuspension.rs"]
mod measured_resuspension;

use measured_resuspension::{alumina, measured};

const PLACE: &str = "Reeks & Hall 2001, as read off by V. Bourgin";

pub(super) const HEADING: &str = "Resuspension: alumina spheres on polished steel";

pub fn part() -> StudyPart {
    StudyPart {
        heading: HEADING.to_owned(),
        text: vec![
            "The law of Reeks & Hall with the reduced adhesion of Biasi et al. 2001, 0.56 J/m² and air at room \
             temperature; the fraction that remains after 1 s. No blind test, for Biasi et al. fitted \
             resuspension data, these probably among them."
                .to_owned(),
        ],
        figures: [10, 20].map(figure).to_vec(),
        claims: claims(),
        ..StudyPart::default()
    }
}

/// Friction velocity [m/s] at which this fraction [1] of the spheres [µm] remains after a time [s], from
/// 1e-4 to 1e4 m/s.
fn critical_friction_velocity(diameter: u32, fraction: f64, time: f64) -> f64 {
    let (mut low, mut high) = (1e-4_f64, 1e4_f64);
    for _ in 0..60 {
        let middle = (low * high).sqrt();
        let remaining = alumina(diameter, middle).fraction_remaining(time);
        if remaining > fraction { low = middle } else { high = middle }
    }
    (low * high).sqrt()
}

fn claims() -> Vec<Claim> {
    let half = |diameter: u32, low: f64, high: f64| {
        let ours = critical_friction_velocity(diameter, 0.5, 1.0);
        Claim::predicted(
            PLACE,
            &format!("friction velocity at which half of the spheres of {diameter} µm stay [m/s]"),
            Published::Between(low, high),
            ours,
        )
    };
    let stays = |diameter: u32, velocity: f64, low: f64, high: f64| {
        Claim::predicted(
            PLACE,
            &format!("fraction of {diameter} µm that stays at {velocity} m/s"),
            Published::Between(low, high),
            alumina(diameter, velocity).fraction_remaining(1.0),
        )
    };
    let steeper = "the measured curve is steeper; the kind of gas is not certain either";
    let tail = "some measured spheres stick more strongly than the log-normal adhesion has it";
    vec![
        half(10, 0.68, 0.75).because(steeper),
        half(20, 0.45, 0.58),
        stays(10, 1.5, 0.119, 0.144).because(steeper),
        stays(10, 4.0, 0.022, 0.046).because(tail),
        stays(20, 2.2, 0.049, 0.076).because(tail),
        stays(20, 4.2, 0.025, 0.042).because(tail),
    ]
}

fn figure(diameter: u32) -> Figure {
    let points: Vec<[f64; 2]> =
        measured(diameter).iter().map(|point| [point.friction_velocity, point.remaining]).collect();
    let law: Vec<[f64; 2]> = even_in_logarithm([0.1, 6.0], 100)
        .map(|velocity| [velocity, alumina(diameter, velocity).fraction_remaining(1.0)])
        .collect();
    Chart::new(&format!("Alumina of {diameter} µm"), "friction velocity [m/s]", "remains after 1 s [1]")
        .line("library", &law)
        .cloud("measured", &points)
        .y_range(0.0, 1.0)
        .figure(&format!("checks-resuspension-{diameter}"), "One point a reading of the published figure.")
}
