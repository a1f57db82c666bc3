//! Independent checks: the library beside oracles that share no code with it, and beside measured viscosities.

mod adhesion;
mod compliance;
mod normal_contact;
mod properties;
mod spin;
mod viscosity;

use std::error::Error;

use nearwall::material::Library;
use nearwall::normal::Contact;

use crate::study::{Extent, Study};

/// What one of its parts may stumble over.
type Outcome<T> = Result<T, Box<dyn Error>>;

/// Friction of wax on Pyrex [1] (Troiano et al., Fig 7), used wherever one is needed.
const FRICTION: f64 = 0.28;

/// Diameter of the wax particles [m] (Troiano et al.).
const DIAMETER: f64 = 75e-6;

/// Runs every check.
///
/// # Errors
/// When a material or the measured table cannot be read.
pub fn study(extent: Extent) -> Outcome<Study> {
    let parts = vec![
        adhesion::part()?,
        normal_contact::part(extent),
        spin::part(extent)?,
        compliance::part(extent)?,
        viscosity::part()?,
        properties::part(),
    ];
    Ok(Study {
        title: "Independent checks".to_owned(),
        source: "No paper: the same quantities computed another way (validation/src/oracle, which uses nothing of the library), \
                 measured viscosities of 1161 melts, and properties that hold for every model."
            .to_owned(),
        lead: "The elastic–adhesive law is the energy of JKR's cycle to rounding, and the law with raised pull-off is the contact \
               followed through time; the closed form under-predicts sticking once adhesion rivals yield. Sliding and rolling are those of a rigid sphere \
               with any spin, but for a window of angles below the paper's transition. The assumed power law of \
               tangential-compliance is not what elastic theory gives: that dips deeper past the transition and, for wax on \
               Pyrex, never rises above rolling. The viscosity laws meet their stated errors."
            .to_owned(),
        parts,
    })
}

/// Wax on Pyrex at room temperature, with Troiano's yield ratio.
fn wax_on_pyrex() -> Outcome<Contact> {
    let library = Library::built_in()?;
    let solid = |name: &str| -> Outcome<_> {
        let material = library.get(name).ok_or_else(|| format!("no material {name}"))?;
        Ok(material.mechanical(293.15)?)
    };
    Ok(Contact::new(&solid("montan-wax")?, &solid("pyrex")?, 0.7, None))
}

/// `count` numbers from `low` to `high`, even.
fn steps(low: f64, high: f64, count: usize) -> impl Iterator<Item = f64> + Clone {
    (0..count).map(move |i| low + (high - low) * i as f64 / (count - 1).max(1) as f64)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]
    use super::*;
    use crate::claim::Verdict;

    /// What differs is what is known to: the elastic theory of tangential compliance against the assumed one and the paper's
    /// 0.85, and the published sticking velocity of ammonium fluorescein.
    #[test]
    fn only_what_is_known_differs() {
        let study = study(Extent::Short).unwrap();
        assert_eq!(study.unexplained().count(), 0);
        for part in &study.parts {
            let differs = part.claims.iter().any(|claim| claim.verdict != Verdict::Agrees);
            let known = [compliance::HEADING, normal_contact::HEADING].contains(&part.heading.as_str());
            assert_eq!(differs, known, "{}: {:#?}", part.heading, part.claims);
        }
    }
}
