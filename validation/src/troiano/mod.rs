//! Troiano, Solimene, Salatino & Montagnaro: wax particles against targets, from 20 to 120 °C.
//!
//! [`published`] holds the paper's numbers, `validation/troiano/*.toml` the models and cases that answer them.

mod angle;
mod best_fit;
mod char_on_slag;
mod conclusions;
mod droplets;
mod entrapment;
mod equations;
mod layers;
mod materials;
mod oblique;
mod operation;
mod plate;
mod published;
mod speed;
mod targets;
mod temperature;
mod tube;
mod velocities;

use nearwall::normal::{Contact, NormalLaw};
use nearwall::{Impact, ImpactError, Model, Outcome};

use crate::steps::even;
use crate::{Extent, Result, SourceStudy};

/// The study.
///
/// # Errors
/// A model or case file that cannot be read, an impact that cannot be decided.
pub fn study(extent: Extent) -> Result<SourceStudy> {
    let mut parts = vec![
        equations::part()?,
        oblique::part()?,
        materials::part()?,
        operation::part(),
        velocities::part()?,
    ];
    parts.extend([angle::part()?, best_fit::part()]);
    parts.extend([speed::part()?, targets::part()?, layers::part()?]);
    parts.extend([
        temperature::melting()?,
        temperature::conversion()?,
        droplets::part()?,
        entrapment::part(),
    ]);
    parts.extend([tube::part(extent)?, plate::part(extent)?, conclusions::part()?]);
    Ok(SourceStudy {
        title: "Wax on targets (Troiano et al.)".to_owned(),
        source: "M. Troiano, R. Solimene, P. Salatino, F. Montagnaro: Multiphase flow patterns in \
            entrained-flow slagging gasifiers: physical modelling of particle–wall impact at near-ambient \
            conditions. Read from a scan: what looks like a slip of print may be one of the copy. \
            Tolerances: the stated uncertainty, else half of the last digit; where the paper says \
            \"around\" or \"about\", one unit of that digit unless the row says otherwise."
            .to_owned(),
        lead: lead()?,
        parts,
    })
}

fn lead() -> Result<String> {
    Ok(format!(
        "Near the normal on stiff targets (mean e_n {:.2} against {}), over the temperature and in the tube \
         the library agrees with the paper. It does not reproduce the equal rebound on soft targets, nor \
         glancing angles without a fitted term. Most other differences are printing errors.",
        speed::mean_on_pyrex()?,
        published::E_N_MEAN.value
    ))
}

/// A model of `validation/troiano/`.
macro_rules! model {
    ($name:literal) => {
        nearwall::Model::from_toml(
            concat!("validation/troiano/", $name),
            include_str!(concat!("../../troiano/", $name)),
        )
    };
}
use model;

/// A 75 µm particle at 20 °C that arrives at `normal_speed` [m/s] and `angle` [degrees from the surface].
fn arriving(normal_speed: f64, angle: f64) -> Impact {
    Impact {
        normal_speed,
        tangential_speed: normal_speed / angle.to_radians().tan(),
        diameter: published::WAX_DIAMETER,
        ..Impact::default()
    }
}

/// Decides an impact on the wall of this name, what is left to chance at its median.
fn decide(model: &Model, wall: &str, impact: &Impact) -> Result<Outcome> {
    let wall = model.find_wall(wall).ok_or_else(|| format!("no wall {wall}"))?;
    Ok(model.resolve_with(wall, impact, |_| 0.5)?)
}

/// The contact of wax at 20 °C and a wall of a model, with `c` as `yield_ratio`, and changes to the wax.
fn contact(
    model: &Model,
    wall: &str,
    yield_ratio: f64,
    change: impl Fn(&mut nearwall::material::Mechanical),
) -> Result<Contact> {
    let wall = model.find_wall(wall).ok_or_else(|| format!("no wall {wall}"))?;
    let room = Impact::default().particle_temperature;
    let solid = |material: &nearwall::material::Material| -> std::result::Result<_, ImpactError> {
        material.mechanical(room)
    };
    let mut wax = solid(model.particle())?;
    change(&mut wax);
    Ok(Contact::new(&wax, &solid(model.walls()[wall].material())?, yield_ratio, None))
}

/// `e_n` of Thornton and Ning [1] for a diameter [m] and a normal speed [m/s]; what sticks has 0.
fn thornton_ning(contact: &Contact, diameter: f64, speed: f64) -> f64 {
    NormalLaw::ThorntonNing.restitution(contact, diameter, speed).unwrap_or(0.0)
}

/// Mean of a quantity over the speeds of Figs 8 and 10, evenly spaced.
fn mean_over_speeds(quantity: impl Fn(f64) -> f64) -> f64 {
    const COUNT: usize = 251;
    even(published::FIGURE_SPEEDS, COUNT).map(quantity).sum::<f64>() / COUNT as f64
}

/// Where a rising or falling quantity passes `target`, between two numbers.
fn passes(quantity: impl Fn(f64) -> f64, target: f64, [mut low, mut high]: [f64; 2]) -> f64 {
    let rises = quantity(high) > quantity(low);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if (quantity(middle) < target) == rises { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use crate::Verdict;

    #[test]
    fn every_difference_has_its_reason() {
        let study = study(Extent::Short).unwrap();
        let silent: Vec<_> = study.unexplained().collect();
        assert!(silent.is_empty(), "{silent:?}");
    }

    /// What has to agree whatever becomes of the models: the library's own arithmetic, and its particle tracking.
    #[test]
    fn the_checks_agree() {
        let study = study(Extent::Short).unwrap();
        let checks: Vec<_> = study
            .claims()
            .filter(|claim| claim.place == "check" || claim.what.contains("over library"))
            .collect();
        assert!(checks.len() >= 4, "{checks:?}");
        assert!(checks.iter().all(|claim| claim.verdict == Verdict::Agrees), "{checks:?}");
    }
}
