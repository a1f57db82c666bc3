//! What the abstract and the conclusions say, against what the parts found.

use nearwall::{Impact, Model};

use super::published::{
    E_N_GLANCING, E_N_NEAR_NORMAL, GLANCING, STEEP, TARGETS, WAX_DENSITY, WAX_DIAMETER, YIELD_RATIO,
};
use super::{Result, arriving, decide, model};
use crate::oracle::carried::{Air, CarriedFlight, Law, OnTheWay, Sphere};
use crate::{Claim, StudyPart};

/// How far a particle flies off the wall [mm] in still air without gravity, until 1 % of its
/// rebound speed [m/s] is left.
fn reach(speed: f64) -> f64 {
    let sphere = Sphere { diameter: WAX_DIAMETER, density: WAX_DENSITY, heat_capacity: 2000.0 };
    let flight = CarriedFlight {
        sphere,
        air: Air::at(293.15),
        law: Law::SchillerNaumann,
        downwards: 0.0,
        air_speed: &|_| 0.0,
    };
    let start = OnTheWay { time: 0.0, at: 0.0, speed, temperature: 293.15 };
    let way = flight.way(start, 1e-4, |place| place.speed > 0.01 * speed);
    1e3 * way[way.len() - 1].at
}

/// Temperature [K] of the hot particles: 105 °C.
const HOT: f64 = 378.15;

fn e_n(model: &Model, wall: &str, speed: f64, angle: f64) -> Result<f64> {
    Ok(decide(model, wall, &arriving(speed, angle))?.normal_restitution)
}

/// The part on the conclusions.
pub(super) fn part() -> Result<StudyPart> {
    Ok(StudyPart {
        heading: "Conclusions of the abstract".to_owned(),
        text: vec![
            "Four sentences summarise the paper. The first holds for stiff targets near the normal, which \
             is where its parameter was fitted; the one on gasifiers cannot be tested with the paper's \
             data."
                .to_owned(),
        ],
        claims: vec![adequate()?, accumulation()?, dense_phase(), hot_particles()?],
        ..StudyPart::default()
    })
}

/// The stated e_n that the model meets or does not: name, whether.
fn met() -> Result<Vec<(&'static str, bool)>> {
    let model = model!("targets.toml")?;
    let within = |ours: f64, stated: f64| (ours / stated - 1.0).abs() < 0.15;
    let mut cases = Vec::new();
    for target in &TARGETS {
        cases.push((target.name, within(e_n(&model, target.wall, 1.25, STEEP)?, E_N_NEAR_NORMAL.value)));
    }
    cases.push(("35°", within(e_n(&model, "pyrex", 1.0, GLANCING)?, E_N_GLANCING.value)));
    Ok(cases)
}

fn adequate() -> Result<Claim> {
    let cases = met()?;
    let named = |met: bool| {
        let names: Vec<&str> = cases.iter().filter(|case| case.1 == met).map(|case| case.0).collect();
        names.join(", ")
    };
    let (count, all) = (cases.iter().filter(|case| case.1).count(), cases.len());
    Ok(Claim::predicted_statement(
        "Abstract",
        &format!(
            "\"the elastic–plastic adhesive model provides an adequate representation\": stated e_n met \
             within 15 % with c = {}",
            YIELD_RATIO.value
        ),
        "adequate",
        &format!("{count} of {all}: {}; not {}", named(true), named(false)),
        count == all,
    )
    .because(&format!(
        "See the parts on targets and on the angle. Stated: {} on all targets, {} at {GLANCING}°; Teflon and steel by \
         \"negligible influence\". \"Adequate\" is taken as 15 %.",
        E_N_NEAR_NORMAL.value, E_N_GLANCING.value
    )))
}

fn accumulation() -> Result<Claim> {
    let model = model!("layers.toml")?;
    let far = |wall: &str| -> Result<f64> { Ok(reach(e_n(&model, wall, 1.0, STEEP)?)) };
    let (bare, thin, thick) = (far("bare")?, far("thin")?, far("thick")?);
    Ok(Claim::fitted_statement(
        "Abstract",
        "powder \"favours accumulation of particles close to the surface\": distance of a rebound at 1 m/s \
         over bare glass, 0.25 mm and 1.4 mm of powder [mm]",
        "closer",
        &format!("{bare:.1}, {thin:.1}, {thick:.1}"),
        bare > thin && thin > thick,
    )
    .because("75 µm in still air without gravity; follows from the fitted e_n."))
}

fn dense_phase() -> Claim {
    Claim::unchecked(
        "Abstract",
        "\"promotes the establishment of a dense-dispersed phase\" in gasifiers",
        "promotes",
        "No such measurement is in the paper. Simulated, without collisions of particles: tutorials/slaggingGasifier \
         states concentration and time near each wall, with this wall model and with constants.",
    )
}

fn hot_particles() -> Result<Claim> {
    let impact = Impact { particle_temperature: HOT, wall_temperature: HOT, ..arriving(2.0, STEEP) };
    let hot = decide(&model!("melting.toml")?, "default", &impact)?;
    Ok(Claim::fitted_statement(
        "Abstract",
        "hot particles: restitution \"vanishingly small\", deposition prevails: e_n, capture at 105 °C",
        "near 0; prevails",
        &format!("{:.2}, {:.2}", hot.normal_restitution, hot.sticking_probability),
        hot.normal_restitution < 0.05 && hot.sticking_probability > 0.5,
    )
    .because("Capture is fitted at this temperature; e_n follows."))
}
