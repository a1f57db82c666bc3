//! Erosion: the volume of wall that impacts remove. A tally: it changes neither the impact nor the
//! wall. One law a file.
//!
//! A new law is one file with an [`ErosionLaw`] and one line in [`EROSION_LAWS`]; the model file,
//! the C library and OpenFOAM then know it. [`Model::erosion`](crate::Model::erosion) applies the
//! law of a wall.
//!
//! The laws are fitted per mass of particles that reach the bare surface, whatever becomes of them.
//! So every impact counts, also one that ends with capture, and a deposit that protects the wall is
//! not regarded: the result is an upper bound where walls are covered.

mod finnie;
mod oka;

use std::sync::Arc;

use crate::impact::Impact;
use crate::input::{InputError, Limits, Section};

/// Every erosion law.
pub static EROSION_LAWS: [&ErosionLaw; 2] = [&finnie::FINNIE, &oka::OKA];

/// An erosion law of the model file.
#[derive(Debug)]
pub struct ErosionLaw {
    /// The name in model files.
    pub name: &'static str,
    /// Reads the constants from the table of the law.
    read: fn(&Section<'_>) -> Result<Arc<dyn Erosion>, InputError>,
}

/// A law with its constants for a wall.
pub trait Erosion: Send + Sync + std::fmt::Debug {
    /// Volume of wall removed per mass of particles [m³/kg] by impacts like this one.
    fn volume_per_mass(&self, impact: &Impact) -> f64;

    /// Name and constants in words.
    fn describe(&self) -> String;
}

/// Reads an `[erosion]` table.
///
/// # Errors
/// [`InputError::Fault`] for an unknown law, or a missing or impossible constant.
pub fn read(section: &Section<'_>) -> Result<Arc<dyn Erosion>, InputError> {
    let names = EROSION_LAWS.map(|law| law.name);
    let given = section.choice("law", &names)?;
    let law = EROSION_LAWS.into_iter().find(|law| given.as_deref() == Some(law.name));
    let law = law.ok_or_else(|| section.missing("law", &format!("one of {}", names.join(", "))))?;
    (law.read)(section)
}

/// Limits of a strength or hardness [Pa].
const STRENGTH: Limits = Limits { unit: "Pa", low: 1e3, high: 1e12, known: "diamond some 1e11" };

/// A required strength or hardness [Pa].
fn required_strength(section: &Section<'_>, key: &str, what: &str) -> Result<f64, InputError> {
    section.quantity(key, &STRENGTH)?.ok_or_else(|| section.missing(key, what))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Model;

    pub(super) const BASE: &str = r#"
[particle]
material = "fly-ash"
[walls.default]
material = "stainless-steel"
[walls.lined]
material = "refractory"
[normal]
model = "constant"
e_n = 0.4
[tangential]
model = "constant"
e_t = 0.7
"#;

    pub(super) fn model(erosion: &str) -> Model {
        Model::from_toml("m.toml", &format!("{BASE}{erosion}")).unwrap()
    }

    /// Impacts at a speed [m/s] and an angle from the surface [degrees].
    pub(super) fn at(speed: f64, degrees: f64) -> Impact {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        Impact { normal_speed: speed * sine, tangential_speed: speed * cosine, ..Impact::default() }
    }

    #[test]
    fn every_law_is_documented() {
        let page = include_str!("../../docs/reference/model-file.md");
        for law in EROSION_LAWS {
            assert!(
                page.contains(&format!("`{}`", law.name)),
                "docs/reference/model-file.md does not name {}",
                law.name
            );
        }
    }

    #[test]
    fn a_wall_has_the_law_of_its_own_table_or_of_the_file() {
        let impact = at(10.0, 30.0);
        let volume = |text: &str, wall| model(text).erosion(wall, &impact, 2.0).unwrap();
        let (all, own) = ("[erosion]\nlaw = \"finnie\"\nflow_stress = 1e9\n", "[walls.lined.erosion]\n");
        assert_eq!(volume("", 0), 0.0);
        assert_eq!(volume(all, 0), volume(all, 1));
        let harder = format!("{all}{own}law = \"finnie\"\nflow_stress = 4e9\n");
        assert_eq!(volume(&harder, 1), 0.25 * volume(&harder, 0));
        let alone = format!("{own}law = \"finnie\"\nflow_stress = 1e9\n");
        assert_eq!((volume(&alone, 0), volume(&alone, 1)), (0.0, volume(all, 1)));
    }

    #[test]
    fn faults_are_named() {
        let error =
            |text: &str| Model::from_toml("m.toml", &format!("{BASE}{text}")).unwrap_err().to_string();
        assert!(error("[erosion]\n").contains("one of finnie, oka"));
        assert!(error("[erosion]\nlaw = \"finie\"\n").contains("did you mean `finnie`"));
        assert!(error("[erosion]\nlaw = \"finnie\"\n").contains("flow_stress"));
        assert!(
            error("[erosion]\nlaw = \"finnie\"\nflow_stress = 1\n").contains("1e3")
                || error("[erosion]\nlaw = \"finnie\"\nflow_stress = 1\n").contains("1000")
        );
        assert!(
            error("[erosion]\nlaw = \"oka\"\nhardness = 2e9\nflow_stress = 1e9\n").contains("unknown key")
        );
        assert!(model("").erosion(7, &at(1.0, 45.0), 1.0).is_err());
        let eroded = model("[erosion]\nlaw = \"finnie\"\nflow_stress = 1e9\n");
        assert!(eroded.erosion(0, &at(1.0, 45.0), -1.0).is_err());
        assert!(eroded.erosion(0, &at(f64::NAN, 45.0), 1.0).is_err());
    }

    /// Volume grows with speed and never is negative or infinite, at any angle.
    #[test]
    fn every_law_is_finite_and_grows_with_speed() {
        for text in ["finnie\"\nflow_stress = 1e9\n", "oka\"\nhardness = 2e9\n"] {
            let model = model(&format!("[erosion]\nlaw = \"{text}"));
            for degrees in [0.0, 1e-9, 10.0, 45.0, 89.999_999, 90.0] {
                let volumes =
                    [0.0, 1e-6, 1.0, 30.0, 300.0].map(|v| model.erosion(0, &at(v, degrees), 1.0).unwrap());
                assert!(volumes.is_sorted() && volumes[0] == 0.0, "{text} {degrees}: {volumes:?}");
                assert!(volumes[4].is_finite());
            }
        }
    }
}
