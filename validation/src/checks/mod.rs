//! Independent checks: the library beside oracles that share no code with it, and beside measured viscosities.

mod adhesion;
mod compliance;
mod normal_contact;
mod properties;
mod resuspension;
mod spin;
mod viscosity;

use crate::Result;
use nearwall::material::Library;
use nearwall::normal::Contact;

use crate::study::{Extent, SourceStudy};

/// Friction of wax on Pyrex [1] (Troiano et al., Fig 7), used wherever one is needed.
const WAX_ON_PYREX_FRICTION: f64 = 0.28;

/// Diameter of the wax particles [m] (Troiano et al.).
const WAX_PARTICLE_DIAMETER: f64 = 75e-6;

/// Runs every check.
///
/// # Errors
/// When a material or the measured table cannot be read.
pub fn study(extent: Extent) -> Result<SourceStudy> {
    let parts = vec![
        adhesion::part()?,
        normal_contact::part(extent)?,
        spin::part(extent)?,
        compliance::part(extent)?,
        viscosity::part()?,
        resuspension::part(),
        properties::part(),
    ];
    Ok(SourceStudy {
        title: "Independent checks".to_owned(),
        source: format!(
            "Not a paper: independent computation of the same quantities (validation/src/oracle, without \
             code of the library), measured viscosities of {} melts, and properties that hold for every \
             model.",
            viscosity::melts()
        ),
        lead:
            "The laws of adhesion, yielding, sliding and rolling agree with the integrated contact, and the \
             viscosity laws with their stated errors. Known differences: the default law under-predicts \
             sticking where adhesion is as strong as yield, and tangential-compliance differs from elastic \
             theory, which the law maw-barber-fawcett follows; resuspension of alumina spheres is less steep over \
             the friction velocity than measured, and its tail is too short."
                .to_owned(),
        parts,
    })
}

/// Wax on Pyrex at room temperature, with Troiano's yield ratio.
fn wax_on_pyrex() -> Result<Contact> {
    wax_on("pyrex")
}

/// The same on another material.
fn wax_on(target: &str) -> Result<Contact> {
    let library = Library::built_in()?;
    let solid = |name: &str| -> Result<_> {
        let material = library.get(name).ok_or_else(|| format!("no material {name}"))?;
        Ok(material.mechanical(293.15)?)
    };
    Ok(Contact::new(&solid("montan-wax")?, &solid(target)?, 0.7, None))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]
    use super::*;
    use crate::claim::Verdict;

    /// What differs is what is known to: the elastic theory of tangential compliance against the
    /// assumed one and the paper's 0.85, the published sticking velocity of ammonium fluorescein,
    /// and the measured resuspension.
    #[test]
    fn only_what_is_known_differs() {
        let study = study(Extent::Short).unwrap();
        assert_eq!(study.unexplained().count(), 0);
        for part in &study.parts {
            let differs = part.claims.iter().any(|claim| claim.verdict != Verdict::Agrees);
            let known = [compliance::HEADING, normal_contact::HEADING, resuspension::HEADING]
                .contains(&part.heading.as_str());
            assert_eq!(differs, known, "{}: {:#?}", part.heading, part.claims);
        }
    }
}
