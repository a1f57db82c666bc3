//! Tungsten dust on tungsten in Pilot-PSI: the paper that calibrated MIGRAINE's impact model, gone
//! through statement by statement.
//!
//! How to read it. The paper's figures were not at hand, only its text: counts, ranges, means.
//! `published.rs` holds each of these once. The parts follow the paper:
//! - `curves.rs`: `e_n` against `v_n` (Figs 1, 3 to 6), what the unknown yield strength does, what
//!   `p_y` the counts allow;
//! - `adhesion.rs`: work of adhesion, sticking velocity, and whether any of it explains the sticking counts;
//! - `along.rs`: the laws of `e_t` (Fig 2, Eq. 4);
//! - `roughness.rs`: the two probabilistic models;
//! - `oblique.rs`: set 4;
//! - `doublets.rs`: rigid doublets, followed hit by hit (`rigid_doublet.rs`);
//! - `molten.rs`: set 6;
//! - `campaigns.rs`: all sets drawn again, under the old and the calibrated model; what is fitted,
//!   what is predicted, the gain.
//!
//! Model files stand in `validation/migraine/`; copy them. All chance comes from
//! `nearwall::ImpactRng` with the seeds named on the page.

mod adhesion;
mod along;
mod campaigns;
mod curves;
mod doublets;
mod molten;
mod oblique;
mod published;
mod rigid_doublet;
mod roughness;
mod sample;
mod statistics;

use crate::Result;
use nearwall::{Impact, Model};

use crate::study::{Extent, SourceStudy};
use crate::terms::term;
use published::FIGURE_TEMPERATURES;

/// The paper's model with its new numbers and nothing else: `validation/migraine/plain.toml`.
pub(crate) const PLAIN: &str = include_str!("../../migraine/plain.toml");
const OLD: &str = include_str!("../../migraine/old.toml");
const CALIBRATED: &str = include_str!("../../migraine/calibrated.toml");
const MOLYBDENUM: &str = include_str!("../../migraine/molybdenum.toml");

/// Work of adhesion [J/m²] measured between tungsten and steel (J. Phys. D 7 (1974) 1243); not from the paper.
const MEASURED_ADHESION: f64 = 0.13;

/// The study.
///
/// # Errors
/// When a model cannot be read or an impact not be resolved.
pub fn study(extent: Extent) -> Result<SourceStudy> {
    let (campaigns, gain) = campaigns::part(extent)?;
    let parts = vec![
        curves::part()?,
        adhesion::part(extent)?,
        along::part(extent)?,
        roughness::part(extent)?,
        oblique::part(extent)?,
        doublets::part(extent)?,
        molten::part()?,
        campaigns,
    ];
    Ok(SourceStudy {
        title: "Tungsten dust in Pilot-PSI (MIGRAINE)".to_owned(),
        source: "\"Experimental validation of the analytical model for tungsten dust - wall mechanical \
            impacts incorporated in the MIGRAINE dust dynamics code\" (Pilot-PSI, 520 impacts in six sets). \
            The data points of its figures are not printed, so only statements in the text are compared."
            .to_owned(),
        lead: format!(
            "{gain} It does not predict which particles stick. The experiment calibrates p_y, not \
             p_y/sigma_y."
        ),
        parts,
    })
}

fn model(text: &str) -> Result<Model> {
    Ok(Model::from_toml("validation/migraine", text)?)
}

/// The model with further effects, each with its parameters in the order of its file.
fn with(model: &Model, effects: &[(&str, &[f64])]) -> Result<Model> {
    let mut terms = model.terms().to_vec();
    for (id, values) in effects {
        terms.push(term(id, values)?);
    }
    Ok(model.with_terms(terms))
}

/// An impact at the temperatures of the paper's figures; diameter [m], speeds [m/s].
fn impact(diameter: f64, normal_speed: f64, tangential_speed: f64) -> Impact {
    Impact {
        normal_speed,
        tangential_speed,
        diameter,
        particle_temperature: FIGURE_TEMPERATURES[0],
        wall_temperature: FIGURE_TEMPERATURES[1],
        ..Impact::default()
    }
}

/// `e_n` of a head-on impact; 0 where it sticks. Chance, if the model has any, is at `uniform`.
fn e_n(model: &Model, diameter: f64, speed: f64, uniform: f64) -> Result<f64> {
    let outcome = model.resolve_with(0, &impact(diameter, speed, 0.0), |_| uniform)?;
    Ok(if outcome.stuck { 0.0 } else { outcome.normal_restitution })
}
