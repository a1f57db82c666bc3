//! What the abstract and the conclusions say, against what the parts found.

use super::published::{DENSITY, DIAMETER, STEEP, TARGETS};
use super::{Answer, arriving, decide, model};
use crate::oracle::carried::{Air, Flight, Law, Place, Sphere};
use crate::{Basis, Claim, Part};

/// How far a particle flies off the wall [mm] in still air without gravity, until 1 % of its rebound speed [m/s] is left.
fn reach(speed: f64) -> f64 {
    let sphere = Sphere { diameter: DIAMETER, density: DENSITY, heat_capacity: 2000.0 };
    let flight = Flight {
        sphere,
        air: Air::at(293.15),
        law: Law::SchillerNaumann,
        downwards: 0.0,
        air_speed: &|_| 0.0,
    };
    let start = Place { time: 0.0, at: 0.0, speed, temperature: 293.15 };
    let way = flight.way(start, 1e-4, |place| place.speed > 0.01 * speed);
    1e3 * way[way.len() - 1].at
}

/// The part on the conclusions.
pub(super) fn part() -> Answer<Part> {
    let targets = model!("targets.toml")?;
    let layers = model!("layers.toml")?;
    let melting = model!("melting.toml")?;
    let e_n =
        |wall: &str| -> Answer<f64> { Ok(decide(&layers, wall, &arriving(1.0, STEEP))?.normal_restitution) };
    let far = ["bare", "thin", "thick"].map(|wall| e_n(wall).map(reach));
    let [bare, thin, thick] = far;
    let (bare, thin, thick) = (bare?, thin?, thick?);
    let mut stated = Vec::new();
    for target in &TARGETS {
        stated.push(decide(&targets, target.wall, &arriving(1.25, STEEP))?.normal_restitution);
    }
    let glancing = decide(&targets, "pyrex", &arriving(1.0, 35.0))?.normal_restitution;
    let hot =
        nearwall::Impact { particle_temperature: 378.15, wall_temperature: 378.15, ..arriving(2.0, STEEP) };
    let hot = decide(&melting, "default", &hot)?;
    let within = |value: f64, target: f64| (value / target - 1.0).abs() < 0.15;
    let names = TARGETS.iter().map(|target| target.name).chain(["35°"]);
    let cases: Vec<(&str, bool)> =
        names.zip(stated.iter().map(|e_n| within(*e_n, 0.28)).chain([within(glancing, 0.41)])).collect();
    let named = |met: bool| {
        let names: Vec<&str> = cases.iter().filter(|case| case.1 == met).map(|case| case.0).collect();
        names.join(", ")
    };
    let count = cases.iter().filter(|case| case.1).count();
    Ok(Part {
        heading: "What the abstract concludes".to_owned(),
        text: vec![
            "Four sentences carry the paper. Two stand. The first stands for stiff targets near the normal, \
             which is where its parameter was fitted; the one on gasifiers cannot be posed."
                .to_owned(),
        ],
        claims: vec![
            Claim::statement(
                "Abstract",
                "\"the elastic–plastic adhesive model provides an adequate representation\": stated e_n met \
                 within 15 % with c = 0.7",
                "adequate",
                &format!("{count} of 5: {}; not {}", named(true), named(false)),
                count == 5,
                Basis::Predicted,
            )
            .because(
                "See the parts on targets and angle. 0.28 on all targets, 0.41 at 35°; Teflon and steel by \
             \"negligible influence\". 15 % taken for \"adequate\".",
            ),
            Claim::statement(
                "Abstract",
                "powder \"favours accumulation of particles close to the surface\": how far a rebound at 1 \
                 m/s carries over bare glass, 0.25 mm and 1.4 mm of powder [mm]",
                "closer",
                &format!("{bare:.1}, {thin:.1}, {thick:.1}"),
                bare > thin && thin > thick,
                Basis::Fitted,
            )
            .because("75 µm in still air without gravity; follows from the fitted e_n."),
            Claim::unchecked(
                "Abstract",
                "\"promotes the establishment of a dense-dispersed phase\" in gasifiers",
                "promotes",
                "Needs a gasifier: many particles, their feedback on the gas and on each other. No such \
                 measurement is in the paper.",
            ),
            Claim::statement(
                "Abstract",
                "hot particles: restitution \"vanishingly small\", deposition prevails: e_n, capture at 105 \
                 °C",
                "near 0; prevails",
                &format!("{:.2}, {:.2}", hot.normal_restitution, hot.sticking_probability),
                hot.normal_restitution < 0.05 && hot.sticking_probability > 0.5,
                Basis::Fitted,
            )
            .because("Capture is set at this temperature; e_n follows."),
        ],
        ..Part::default()
    })
}
