//! Reads a model from TOML: every key is checked, nothing is assumed silently.

use std::sync::Arc;

use regex_lite::Regex;

use super::wall::{ContactSettings, Covering, Wall};
use super::{Model, Particle};
use crate::capture::{Capture, Criterion, StickinessCriterion};
use crate::deposit::WallProcesses;
use crate::effect::Term;
use crate::erosion::{self, Erosion};
use crate::group::{Declared, read_products};
use crate::impact::read_extra_inputs;
use crate::input::{Document, InputError, Limits, Section};
use crate::material::{Library, Material};
use crate::normal::{Contact, NormalLaw};
use crate::tangential::TangentialLaw;

/// The limits of the effect `adhesion-energy`.
const WORK_OF_ADHESION: Limits =
    Limits { unit: "J/m2", low: 0.0, high: 1e3, known: "diamond on diamond some 12" };

const LAYER_THICKNESS: Limits =
    Limits { unit: "m", low: 0.0, high: 100.0, known: "no furnace is that large" };

/// The tables of a model file.
const MODEL_TABLES: [&str; 11] = [
    "particle",
    "walls",
    "normal",
    "tangential",
    "capture",
    "inputs",
    "groups",
    "effects",
    "erosion",
    "materials",
    "fitted",
];

/// The particle, and its stickiness where the criterion knows it.
fn read_particle(
    section: &Section<'_>,
    library: &Library,
    capture: &Capture,
) -> Result<(Particle, Option<Arc<dyn StickinessCriterion>>), InputError> {
    let material = library.named_by(section, "material")?.ok_or_else(|| missing_material(section))?;
    let particle = Particle { material, ash: library.named_by(section, "ash")? };
    let stickiness = capture.of_particle(particle.melting());
    let stickiness = stickiness.map_err(|error| section.fault("material", error))?;
    Ok((particle, stickiness))
}

impl Model {
    pub(super) fn read(document: &Document) -> Result<Self, InputError> {
        document.read(Self::read_section)
    }

    /// Reads a model from a table of another file; the caller refuses the table's unknown keys.
    ///
    /// # Errors
    /// [`InputError`] naming line, column and key.
    pub fn read_section(top: &Section<'_>) -> Result<Self, InputError> {
        // A misspelt table name is reported before the errors that follow from it.
        for key in MODEL_TABLES {
            top.has(key);
        }
        top.finish()?;
        let library = Library::of_model(top)?;
        let capture = optional(top, "capture", Capture::read)?.unwrap_or_default();
        let (particle, stickiness) = finished(top.required_section("particle")?, |section| {
            read_particle(section, &library, &capture)
        })?;
        let (normal, adhesion) = finished(top.required_section("normal")?, read_normal)?;
        let tangential = finished(top.required_section("tangential")?, TangentialLaw::read)?;
        let erosion = optional(top, "erosion", erosion::read)?;
        // A record of the fit for `nearwall compare`.
        optional(top, "fitted", |section| section.texts("rows"))?;
        let reader = WallReader { library: &library, capture, particle: &particle, adhesion, erosion };
        let walls = reader.read_all(top)?;
        let extra_inputs = read_extra_inputs(top)?;
        let products = read_products(top, &extra_inputs)?;
        let sections = top.sections("effects")?;
        let declared = Declared { inputs: &extra_inputs, products: &products };
        let terms =
            sections.iter().map(|section| Term::read(section, &declared)).collect::<Result<_, _>>()?;
        if let (Some(criterion), None) = (capture.criterion, &stickiness)
            && walls.iter().all(|wall| wall.melt.is_none())
        {
            let needs = criterion.needs();
            let problem =
                format!("neither the particle nor the slag of a wall has {needs}; give one to a material");
            return Err(top.fault("capture", problem));
        }
        let model = Self {
            particle,
            capture,
            stickiness,
            solid_below: None,
            liquid_from: None,
            walls,
            normal,
            tangential,
            extra_inputs,
            products,
            terms,
            uses_melt: false,
            adds_energy: false,
            has_corrections: false,
            has_group_ranges: false,
            prepared: Vec::new(),
            decided: Vec::new(),
        };
        let model = model.prepare();
        model.check_groups(&sections)?;
        Ok(model)
    }

    /// Checks that the groups of the terms, in the order of their sections, can be computed.
    fn check_groups(&self, sections: &[Section<'_>]) -> Result<(), InputError> {
        for (section, term) in sections.iter().zip(&self.terms) {
            let corrected = term.corrected_by().into_iter().map(|input| ("input", input));
            let valid = term.valid_groups().iter().map(|(group, _)| ("valid", *group));
            for (key, group) in corrected.chain(valid) {
                if let Some(problem) = self.lacks(group) {
                    return Err(section.fault(key, problem));
                }
            }
        }
        Ok(())
    }
}

/// Reads a section and refuses its unknown keys.
fn finished<T>(
    section: Section<'_>,
    read: impl FnOnce(&Section<'_>) -> Result<T, InputError>,
) -> Result<T, InputError> {
    let value = read(&section)?;
    section.finish()?;
    Ok(value)
}

/// Reads a table that may be absent, and refuses its unknown keys.
fn optional<T>(
    section: &Section<'_>,
    key: &str,
    read: impl FnOnce(&Section<'_>) -> Result<T, InputError>,
) -> Result<Option<T>, InputError> {
    section.section(key)?.map(|table| finished(table, read)).transpose()
}

fn missing_material(section: &Section<'_>) -> InputError {
    section.missing("material", "a built-in or own material (`nearwall materials` lists them)")
}

fn read_normal(section: &Section<'_>) -> Result<(NormalLaw, ContactSettings), InputError> {
    let law = NormalLaw::read(section)?;
    let yield_ratio = section.number_within("yield_ratio", 1e-6, 1e6)?;
    let work = section.quantity("work_of_adhesion", &WORK_OF_ADHESION)?;
    let yield_ratio = match (yield_ratio, law) {
        (Some(ratio), _) => ratio,
        (None, NormalLaw::Constant { .. } | NormalLaw::Listed { .. }) => 1.0,
        (None, NormalLaw::ThorntonNing | NormalLaw::PlasticJkr) => {
            let what = "p_y / sigma_y (1.6 to 4 for hard, 0.7 for soft particles)";
            return Err(section.missing("yield_ratio", what));
        }
    };
    Ok((law, ContactSettings { yield_ratio, work, set: None }))
}

/// What all walls of a model have in common.
struct WallReader<'a> {
    library: &'a Library,
    capture: Capture,
    particle: &'a Particle,
    adhesion: ContactSettings,
    /// The law of walls without one of their own.
    erosion: Option<Arc<dyn Erosion>>,
}

impl WallReader<'_> {
    fn read_all(&self, top: &Section<'_>) -> Result<Vec<Wall>, InputError> {
        let table = top.required_section("walls")?;
        let names = table.keys();
        if names.is_empty() {
            return Err(table.missing("default", "a wall"));
        }
        names
            .iter()
            .map(|name| finished(table.required_section(name)?, |section| self.read_one(name, section)))
            .collect()
    }

    fn read_one(&self, name: &str, section: &Section<'_>) -> Result<Wall, InputError> {
        let material = self.library.named_by(section, "material")?;
        let material = material.ok_or_else(|| missing_material(section))?;
        let slag = self.library.named_by(section, "slag")?;
        let melt = slag.as_ref().map(|slag| self.read_melt(slag, section)).transpose()?;
        let prepared = self.constant_contact(&material, section)?;
        let coverage = section.number_within("coverage", 0.0, 1.0)?.unwrap_or(0.0);
        let processes = WallProcesses::read(section)?;
        let own_erosion = optional(section, "erosion", erosion::read)?;
        let powder = self.library.named_by(section, "powder")?;
        let met = [Some(&material), slag.as_ref(), powder.as_ref()];
        let contact_heat = self.read_contact_heat(section, met)?;
        let thickness = |key: &str| Ok(section.quantity(key, &LAYER_THICKNESS)?.unwrap_or(0.0));
        Ok(Wall {
            name: name.to_owned(),
            pattern: read_pattern(name, section)?,
            material,
            slag,
            melt,
            slag_solid_below: None,
            powder,
            covering: Covering {
                layer_thickness: thickness("layer_thickness")?,
                film_thickness: thickness("film_thickness")?,
                coverage,
            },
            erosion: own_erosion.or_else(|| self.erosion.clone()),
            processes,
            contact_heat,
            adhesion: self.adhesion,
            prepared,
        })
    }

    /// Whether particles exchange heat with a wall while they touch it, for which they and all that they may `met`
    /// there need thermal properties.
    fn read_contact_heat(
        &self,
        section: &Section<'_>,
        met: [Option<&Material>; 3],
    ) -> Result<bool, InputError> {
        let key = "contact_heat";
        if !section.boolean(key)?.unwrap_or(false) {
            return Ok(false);
        }
        let solids = [Some(self.particle.material()), self.particle.ash()];
        for material in solids.into_iter().chain(met).flatten() {
            for property in ["heat_capacity", "thermal_conductivity"] {
                if material.property(property).is_none() {
                    return Err(section.fault(key, format!("`{}` has no {property}", material.name())));
                }
            }
        }
        Ok(true)
    }

    /// The stickiness of the slag of a wall.
    fn read_melt(
        &self,
        slag: &Material,
        section: &Section<'_>,
    ) -> Result<Arc<dyn StickinessCriterion>, InputError> {
        let melt = self.capture.of_slag(slag, self.particle.melting());
        let melt = melt.map_err(|error| section.fault("slag", error))?;
        melt.ok_or_else(|| section.fault("slag", self.without_criterion(slag)))
    }

    /// The contact of particle and wall, where no property depends on temperature.
    fn constant_contact(
        &self,
        material: &Material,
        section: &Section<'_>,
    ) -> Result<Option<Contact>, InputError> {
        if !self.particle.is_constant() || !material.is_constant() {
            return Ok(None);
        }
        let ContactSettings { yield_ratio, work, .. } = self.adhesion;
        let at = |m: &Material| m.mechanical(293.15).map_err(|e| section.fault("material", e));
        Ok(Some(Contact::new(&at(self.particle.material())?, &at(material)?, yield_ratio, work)))
    }

    /// Why there is no criterion for the slag of a wall.
    fn without_criterion(&self, slag: &Material) -> String {
        match self.capture.criterion {
            None | Some(Criterion::Droplet(_)) => {
                "a wall with slag needs [capture] model = \"viscosity\", \"kinetic-energy\", \"melt-fraction\" or \
                 \"fusion\" to say when it is sticky"
                    .to_owned()
            }
            Some(criterion) => format!("`{}` lacks {}", slag.name(), criterion.needs()),
        }
    }
}

/// A name with regular-expression characters is a regular expression; it has to match the whole patch name.
fn read_pattern(name: &str, section: &Section<'_>) -> Result<Option<Regex>, InputError> {
    if !name.contains(['*', '+', '?', '|', '(', ')', '[', ']', '^', '$', '\\', '.', '{']) {
        return Ok(None);
    }
    Regex::new(&format!("^(?:{name})$"))
        .map(Some)
        .map_err(|error| section.fault("", format!("`{name}` is not a regular expression: {error}")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::{Impact, Regime};
    use crate::rng::ImpactRng;

    const SMALLEST: &str = r#"
[particle]
material = "montan-wax"
[walls.default]
material = "pyrex"
[normal]
model = "thornton-ning"
yield_ratio = 0.7
[tangential]
model = "constant"
e_t = 0.76
"#;

    fn error(text: &str) -> String {
        Model::from_toml("m.toml", text).unwrap_err().to_string()
    }

    #[test]
    fn the_smallest_file_gives_the_papers_wax() {
        let model = Model::from_toml("m.toml", SMALLEST).unwrap();
        let impact = Impact { normal_speed: 1.0, diameter: 75e-6, ..Impact::default() };
        let outcome = model.resolve(0, &impact, ImpactRng::default()).unwrap();
        assert!((outcome.normal_restitution - 0.28).abs() < 0.06, "{outcome:?}");
        assert_eq!(outcome.tangential_restitution, 0.76);
        assert_eq!((outcome.sticking_probability, outcome.stuck), (0.0, false));
        assert_eq!(outcome.regime, Regime::NspNsw);
        let slow = Impact { normal_speed: 0.05, ..impact };
        assert!(model.resolve(0, &slow, ImpactRng::default()).unwrap().stuck);
    }

    #[test]
    fn the_raised_pull_off_is_read_named_and_needs_its_ratio() {
        let text = SMALLEST.replace("thornton-ning", "thornton-ning-raised-pull-off");
        let model = Model::from_toml("m.toml", &text).unwrap();
        assert_eq!(model.normal_law().name(), "thornton-ning-raised-pull-off");
        let normal = model.describe().into_iter().find(|line| line.0 == "normal").unwrap().1;
        assert!(normal.starts_with("thornton-ning-raised-pull-off, yield_ratio 0.7"), "{normal}");
        let impact = Impact { normal_speed: 1.0, diameter: 75e-6, ..Impact::default() };
        let sticking = model.speeds(0, &impact).unwrap().sticking;
        for (share, stuck) in [(0.999, true), (1.001, false)] {
            let near = Impact { normal_speed: share * sticking, ..impact };
            assert_eq!(model.resolve(0, &near, ImpactRng::default()).unwrap().stuck, stuck);
        }
        let no_ratio = error(&text.replace("yield_ratio = 0.7", ""));
        assert!(no_ratio.contains("normal.yield_ratio: missing"), "{no_ratio}");
    }

    #[test]
    fn errors_name_the_place_and_the_remedy() {
        let misspelt = error(&SMALLEST.replace("montan-wax", "montanwax"));
        assert!(
            misspelt.starts_with(
                "m.toml:3:1: particle.material: unknown material `montanwax`; \
                                      did you mean `montan-wax`?"
            ),
            "{misspelt}"
        );
        let no_walls = error(&SMALLEST.replace("walls.default", "wall.default"));
        assert!(no_walls.contains("did you mean `walls`?"), "{no_walls}");
        let no_ratio = error(&SMALLEST.replace("yield_ratio = 0.7", ""));
        assert!(no_ratio.contains("normal.yield_ratio: missing"), "{no_ratio}");
        let bad_effect = error(&format!("{SMALLEST}[[effects]]\nkind = \"melting\"\n"));
        assert!(bad_effect.contains("did you mean `melting-transition`?"), "{bad_effect}");
        let no_parameter = error(&format!("{SMALLEST}[[effects]]\nkind = \"melting-transition\"\n"));
        assert!(no_parameter.contains("effects[1].temperature: missing"), "{no_parameter}");
    }

    #[test]
    fn numbers_that_cannot_be_are_refused() {
        let work =
            error(&SMALLEST.replace("yield_ratio = 0.7", "yield_ratio = 0.7\nwork_of_adhesion = 1e200"));
        assert_eq!(
            work,
            "m.toml:9:1: normal.work_of_adhesion: 1e200 is outside the allowed range 0 to 1000 \
             (diamond on diamond some 12); check the exponent and the unit, J/m2"
        );
        let layer = error(&SMALLEST.replace("\"pyrex\"", "\"pyrex\"\nlayer_thickness = 250"));
        assert_eq!(
            layer,
            "m.toml:6:1: walls.default.layer_thickness: 250 is outside the allowed range 0 to 100 \
             (no furnace is that large); check the exponent and the unit, m"
        );
        let capture = format!(
            "{SMALLEST}[capture]\nmodel = \"viscosity\"\nlaw = \"urbain\"\nreference_viscosity = 70e90\n"
        );
        assert_eq!(
            error(&capture),
            "m.toml:15:1: capture.reference_viscosity: 7e91 is outside the allowed range 1e-7 to 1e20 \
             (literature 8 to 1e7; glass is solid above 1e12); check the exponent and the unit, Pa s"
        );
        // A negative zero is no adhesion; it used to be an infinite one.
        let none = SMALLEST.replace("yield_ratio = 0.7", "yield_ratio = 0.7\nwork_of_adhesion = -0.0");
        let speeds = Model::from_toml("m", &none).unwrap().speeds(0, &Impact::default()).unwrap();
        assert_eq!(speeds.adhesive, 0.0);
    }

    #[test]
    fn walls_are_found_by_name_then_by_the_last_pattern() {
        let text = format!(
            "{SMALLEST}[walls.\"slag.*\"]\nmaterial = \"teflon\"\n[walls.\"sl.*\"]\nmaterial = \"pyrex\"\n\
             [walls.slag]\nmaterial = \"stainless-steel\"\n"
        );
        let model = Model::from_toml("m.toml", &text).unwrap();
        let name = |patch: &str| model.find_wall(patch).map(|wall| model.walls()[wall].name());
        assert_eq!(name("slag"), Some("slag"));
        assert_eq!(name("slagWall"), Some("sl.*"));
        assert_eq!(name("noslag"), None);
        assert_eq!(name("default"), Some("default"));
    }

    #[test]
    fn temperature_ranges_are_what_all_tables_share() {
        let text = SMALLEST.replace("\"pyrex\"", "\"own\"")
            + "[materials.own]\ndensity = 1000\nyoungs_modulus = { T = [300, 900], value = [1e9, 1e8] }\n\
               poisson_ratio = 0.3\nyield_strength = { T = [250, 800], value = [1e9, 1e8] }\n\
               surface_energy = 0.03\n";
        let ranges = Model::from_toml("m.toml", &text).unwrap().temperature_ranges(0).unwrap();
        assert_eq!(ranges.wall, [300.0, 800.0]);
        assert_eq!(ranges.particle, [0.0, f64::INFINITY]);
    }

    #[test]
    fn a_viscosity_law_reports_where_it_is_not_stated() {
        let outside = |law: &str, silica: f64, temperature: f64| {
            let text = SMALLEST.replace("\"montan-wax\"", "\"own\"")
                + &format!(
                    "[capture]\nmodel = \"viscosity\"\nlaw = \"{law}\"\nreference_viscosity = 25\n\
                     [materials.own]\ndensity = 2500\nyoungs_modulus = 7e10\npoisson_ratio = 0.2\n\
                     yield_strength = 1e9\nsurface_energy = 0.4\n\
                     composition = {{ SiO2 = {silica}, Al2O3 = 20, CaO = 30 }}\n"
                );
            let model = Model::from_toml("m.toml", &text).unwrap();
            assert!(model.describe().iter().any(|(_, text)| text.contains(law)));
            let impact = Impact {
                normal_speed: 2.0,
                diameter: 80e-6,
                particle_temperature: temperature,
                ..Impact::default()
            };
            model.resolve(0, &impact, ImpactRng::default()).unwrap().outside_range
        };
        for law in ["kalmanovitch-frank", "urbain"] {
            assert!(!outside(law, 50.0, 1700.0));
            assert!(outside(law, 50.0, 1400.0));
            assert!(outside(law, 10.0, 1700.0));
        }
        assert!(outside("watt-fereday", 50.0, 1700.0), "no iron and no magnesia");
        assert!(outside("giordano-russell-dingwell", 50.0, 1700.0), "no alkali");
    }

    #[test]
    fn the_trace_names_every_term() {
        let text = format!(
            "{SMALLEST}[[effects]]\nkind = \"melting-transition\"\ntemperature = 360.1\nwidth = 6.96\n"
        );
        let model = Model::from_toml("m.toml", &text).unwrap();
        let impact =
            Impact { normal_speed: 2.0, diameter: 80e-6, particle_temperature: 378.15, ..Impact::default() };
        let (outcome, trace) = model.explain(0, &impact, ImpactRng::default()).unwrap();
        assert_eq!(outcome.regime, Regime::SpNsw);
        assert!(outcome.outside_range, "the wax's solid properties do not hold at 105 °C");
        let melting = trace.iter().find(|entry| entry.term == "melting-transition").unwrap();
        assert!((melting.value - 0.93).abs() < 0.01);
        assert!(trace.iter().any(|entry| entry.term == "thornton-ning"));
    }
}
