//! Section 3.1: what becomes of particles that slag, or molten wax, has caught.

use nearwall::slag::Molten;
use nearwall_lab::report::{Table, number};

use super::char_on_slag::{CharFate, CharOnSlag, Judgement};
use super::published::{COAL_SLAG, FEED, MOLTEN_WAX, StatedMelt, TUBE_SPEED};
use crate::steps::{even, range};
use crate::study::table;
use crate::{Claim, Published, StudyPart};

/// Speed [m/s] of the impacts.
const SPEED: f64 = TUBE_SPEED.value;

/// Assumed where the paper has nothing: fresh slag [kg/(m² s)], burn-off [s], char [1/(m² s)].
const SLAG_FLUX: f64 = 0.01;
const BURN: f64 = 5.0;
const CHAR_FLUX: f64 = 1e7;

/// A liquid wall and the particle that hits it.
struct EntrapmentWall {
    name: &'static str,
    melt: StatedMelt,
    /// Density of the particle [kg/m³].
    particle: [f64; 2],
}

/// Slag with char of 700 to 1000 kg/m³ (assumed), and wax with particles of the same.
const WALLS: [EntrapmentWall; 2] = [
    EntrapmentWall { name: "coal slag", melt: COAL_SLAG, particle: [700.0, 1000.0] },
    EntrapmentWall { name: "molten wax", melt: MOLTEN_WAX, particle: MOLTEN_WAX.density },
];

impl EntrapmentWall {
    /// Every corner of its ranges, at a contact angle [degrees], speed [m/s] and with the drag or without.
    fn judged(&self, degrees: f64, normal_speed: f64, drag: bool) -> Vec<Judgement> {
        let mut all = Vec::new();
        for corner in 0..32_usize {
            let pick = |ends: [f64; 2], bit: usize| ends[(corner >> bit) & 1];
            let viscosity = if drag { pick(self.melt.viscosity, 1) } else { 1e-12 };
            let slag = Molten {
                density: pick(self.melt.density, 2),
                viscosity,
                surface_tension: pick(self.melt.tension, 0),
            };
            let char = CharOnSlag {
                diameter: pick(FEED, 3),
                density: pick(self.particle, 4),
                normal_speed,
                slag,
                contact_angle: degrees.to_radians(),
                gravity: 0.0,
                slag_flux: SLAG_FLUX,
                char_flux: CHAR_FLUX,
                burn_time: BURN,
                drain_time: f64::INFINITY,
            };
            all.push(char.judge());
        }
        all
    }

    /// Largest kinetic energy over the work of immersion [1] at the paper's speed.
    fn inertia(&self, degrees: f64, drag: bool) -> f64 {
        range(self.judged(degrees, SPEED, drag).iter().map(|judged| judged.inertia))[1]
    }

    /// The largest of these from 90° on.
    fn most_inertia(&self, drag: bool) -> f64 {
        range([90.0, 120.0, 160.0].into_iter().map(|degrees| self.inertia(degrees, drag)))[1]
    }

    /// Largest fresh slag over what buries [1].
    fn burial(&self, degrees: f64) -> f64 {
        range(self.judged(degrees, SPEED, true).iter().map(|judged| judged.burial))[1]
    }

    fn entrapped(&self, degrees: f64, speed: f64, drag: bool) -> bool {
        self.judged(degrees, speed, drag).iter().any(|judged| judged.fate == CharFate::Entrapment)
    }

    /// Speed [m/s] at which the first corner is entrapped.
    fn entrapping_speed(&self, degrees: f64, drag: bool) -> f64 {
        even([0.0, 200.0], 2001).find(|v| self.entrapped(degrees, *v, drag)).unwrap_or(f64::INFINITY)
    }
}

/// The part on section 3.1's statement about entrapment and over-layering.
pub(super) fn part() -> StudyPart {
    StudyPart {
        heading: "Section 3.1: neither entrapped nor over-layered".to_owned(),
        text: text(),
        tables: vec![corners()],
        claims: [slag(&WALLS[0]), wax(&WALLS[1])].concat(),
        ..StudyPart::default()
    }
}

fn text() -> Vec<String> {
    vec![
        format!(
            "The paper says of slag and of wax that the criteria of entrapment and over-layering are not \
             met, and does not write them down. The forms here are derived from surface energy, Stokes drag \
             and a balance of fresh slag, so the claim is tested by criteria of the \
             same names, not by the same criteria. From the paper: tension, viscosity and density, {SPEED} \
             m/s, {:.0} to {:.0} µm. Assumed: contact angle, {SLAG_FLUX} kg/(m² s) of slag, {BURN} s to \
             burn off, char density.",
            1e6 * FEED[0],
            1e6 * FEED[1]
        ),
        format!(
            "Largest value over all corners of these ranges; 1 or more entraps or buries. For slag the \
             statement on entrapment is robust: the surface alone stops char at {SPEED} m/s from 90° on, \
             drag aside. For wax it is not: the surface is some twenty times weaker, drag alone stops the \
             particle, and wax on its own melt has a small contact angle, at which it is immersed. \
             Over-layering depends on the flux of slag and the residence time, which the paper does not \
             give."
        ),
    ]
}

/// The worst corner of each wall's ranges over the contact angle.
fn corners() -> Table {
    let row = |(wall, degrees): (&EntrapmentWall, f64)| {
        let burial = wall.burial(degrees);
        vec![
            wall.name.to_owned(),
            format!("{degrees}"),
            format!("{:.3}", wall.inertia(degrees, true)),
            format!("{:.3}", wall.inertia(degrees, false)),
            format!("{:.1}", wall.entrapping_speed(degrees, true)),
            if wall.melt == COAL_SLAG { format!("{burial:.2}") } else { "–".to_owned() },
            number(SLAG_FLUX / burial),
        ]
    };
    let angles = [30.0, 60.0, 90.0, 120.0, 160.0];
    let cells = WALLS.iter().flat_map(|wall| angles.map(|degrees| (wall, degrees)));
    table(
        &format!("at {SPEED} m/s; the last column is the flux of slag that would bury"),
        1,
        &format!(
            "wall | contact angle [°] | inertia | inertia without drag | speed that entraps [m/s] | burial \
             | burying flux in {BURN} s [kg/(m² s)]"
        ),
        cells.map(row).collect(),
    )
}

/// A ratio [1] that section 3.1 has below one.
fn below_one(what: &str, ours: f64) -> Claim {
    Claim::predicted("Sec 3.1", what, Published::Below(1.0), ours)
}

fn slag(slag: &EntrapmentWall) -> Vec<Claim> {
    let burial = slag.burial(90.0);
    vec![
        below_one(
            "slag: kinetic energy over the work of immersion, 90° to 160° [1]",
            slag.most_inertia(true),
        )
        .because(&format!(
            "Without drag {}. The contact angle is assumed.",
            number(slag.most_inertia(false))
        )),
        below_one("slag: fresh slag over what buries, 90° [1]", burial).because(&format!(
            "Depends on the assumed flux and burn-off time: a gasifier with {} kg/(m² s) would bury the \
             smallest.",
            number(SLAG_FLUX / burial)
        )),
    ]
}

fn wax(wax: &EntrapmentWall) -> Vec<Claim> {
    vec![
        below_one(
            "wax: kinetic energy over the work of immersion, 90° to 160° [1]",
            wax.most_inertia(true),
        )
        .because(&format!(
            "Drag alone: without it {} at 90°, and the statement fails. Full drag is an overestimate for a \
             half-immersed particle.",
            number(wax.inertia(90.0, false))
        )),
        Claim::unchecked(
            "Sec 3.1",
            "wax: entrapment by wetting",
            "not met",
            "The contact angle of molten wax on solid wax is not given; near 0°, as for most melts on their \
             own solid, the particle is immersed at any speed.",
        ),
        Claim::unchecked(
            "Sec 3.1",
            "wax: over-layering",
            "not met",
            "The flux of molten wax on the wall is that of another rig (refs. 17, 18) and is not given.",
        ),
    ]
}
