//! The built-in materials, and those that a model file adds or builds on them.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use super::Material;
use crate::input::{Document, InputError, Section, unknown, unknown_meaning};

/// The file of the built-in materials.
pub const BUILT_IN_TEXT: &str = include_str!("materials.toml");

/// The table of a built-in material as a model file takes it; `None` where there is none of this name.
pub fn built_in_toml(name: &str) -> Option<String> {
    let header = format!("\n[{name}]\n");
    let start = BUILT_IN_TEXT.find(&header)? + header.len();
    let rest = &BUILT_IN_TEXT[start..];
    let body = &rest[..rest.find("\n[").unwrap_or(rest.len())];
    Some(format!("[materials.{name}]\n{}\n", body.trim_end()))
}

static BUILT_IN: LazyLock<Result<Library, InputError>> = LazyLock::new(|| {
    let document = Document::new("built-in materials", BUILT_IN_TEXT);
    document.read(|top| Library::default().with(top))
});

/// Materials by name.
#[derive(Debug, Clone, Default)]
pub struct Library {
    materials: BTreeMap<String, Material>,
}

impl Library {
    /// The built-in materials.
    ///
    /// # Errors
    /// [`InputError`] for an error in the built-in data (a test excludes it).
    pub fn built_in() -> Result<Self, InputError> {
        BUILT_IN.clone()
    }

    /// The built-in materials and those of the table `materials` of a model file.
    ///
    /// # Errors
    /// As [`Library::with`].
    pub fn of_model(top: &Section<'_>) -> Result<Self, InputError> {
        let library = Self::built_in()?;
        let Some(own) = top.section("materials")? else { return Ok(library) };
        let library = library.with(&own)?;
        own.finish()?;
        Ok(library)
    }

    /// The same of a whole file, whose other tables are not looked at.
    ///
    /// # Errors
    /// As [`Library::with`], and [`InputError`] for text that is not TOML.
    pub fn of_file(document: &Document) -> Result<Self, InputError> {
        document.read(|top| {
            // All other keys count as known.
            top.keys().iter().for_each(|key| _ = top.has(key));
            Self::of_model(top)
        })
    }

    /// Adds every table of `section`, in the order of the file; a material of the same name is
    /// replaced. A table with `like` extends a material that was there before it.
    ///
    /// # Errors
    /// [`InputError::Fault`] for a material that cannot be read.
    pub fn with(mut self, section: &Section<'_>) -> Result<Self, InputError> {
        let names = section.keys();
        for (place, name) in names.iter().enumerate() {
            let table = section.required_section(name)?;
            let base = self.base(&table, name, &names[place + 1..])?;
            let material = Material::read(name, &table, base)?;
            self.materials.insert(name.clone(), material);
        }
        Ok(self)
    }

    /// The material that the table of `name` is `like`; the tables of `later` follow it in the file.
    fn base(
        &self,
        table: &Section<'_>,
        name: &str,
        later: &[String],
    ) -> Result<Option<&Material>, InputError> {
        let Some(base) = table.text("like")? else { return Ok(None) };
        if later.contains(&base) {
            let problem = format!(
                "[materials.{base}] follows further down; move it above [materials.{name}], which is built on it"
            );
            return Err(table.fault("like", problem));
        }
        match self.get(&base) {
            Some(material) => Ok(Some(material)),
            None if base == name => {
                let problem =
                    format!("`{name}` is not built in, so it has nothing to extend; name another one");
                Err(table.fault("like", problem))
            }
            None => Err(table.fault("like", self.unknown(&base))),
        }
    }

    /// A material by its name.
    pub fn get(&self, name: &str) -> Option<&Material> {
        self.materials.get(name)
    }

    /// All names, sorted.
    pub fn names(&self) -> Vec<&str> {
        self.materials.keys().map(String::as_str).collect()
    }

    /// The message for a name that no material has, with those whose name or description contains it as a word: `KCl`
    /// is potassium chloride.
    pub fn unknown(&self, name: &str) -> String {
        let is_word = |text: &str| {
            text.split(|c: char| !c.is_alphanumeric()).any(|word| word.eq_ignore_ascii_case(name))
        };
        let described = |material: &Material| material.about().is_some_and(is_word);
        let meant = self.materials.iter().filter(|(own, material)| is_word(own) || described(material));
        let meant: Vec<&str> = meant.map(|(own, _)| own.as_str()).collect();
        match meant.as_slice() {
            [] => unknown(name, "material", &self.names()),
            meant => unknown_meaning(name, "material", &self.names(), meant),
        }
    }

    /// The material that `key` of a section names.
    ///
    /// # Errors
    /// [`InputError::Fault`] with the nearest known name when there is none.
    pub fn named_by(&self, section: &Section<'_>, key: &str) -> Result<Option<Material>, InputError> {
        let Some(name) = section.text(key)? else { return Ok(None) };
        match self.get(&name) {
            Some(material) => Ok(Some(material.clone())),
            None => Err(section.fault(key, self.unknown(&name))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Library, String> {
        let document = Document::new("m.toml", text);
        let with = |top: &Section<'_>| Library::built_in()?.with(&top.required_section("materials")?);
        document.read(with).map_err(|error| error.to_string())
    }

    #[test]
    fn a_formula_or_a_part_of_a_name_leads_to_the_material() {
        let library = Library::built_in().unwrap();
        for (word, meant) in
            [("KCl", "`potassium-chloride`?"), ("straw", "`straw-ash`?"), ("tungstn", "`tungsten`?")]
        {
            let message = library.unknown(word);
            assert!(message.contains(&format!("did you mean {meant}")), "{message}");
        }
        assert!(!library.unknown("xyz").contains("did you mean"));
    }

    /// What a property is, in bits: the written form of a number is that of its bits.
    fn written(material: &Material) -> String {
        let properties: Vec<_> = material.properties().collect();
        let rest = (material.composition(), material.about(), material.crystalline_below());
        format!("{properties:?} {rest:?}")
    }

    #[test]
    fn a_material_like_another_differs_only_in_what_is_given() {
        let text = "[materials.plant]\nlike = \"coal-slag\"\ndensity = 2600\ncomposition = { SiO2 = 60, CaO = 40 }\n\
                    [materials.wet]\nlike = \"plant\"\nemissivity = 0.5\n";
        let library = read(text).unwrap();
        let of = |name: &str| library.get(name).unwrap().clone();
        let (slag, plant, wet) = (of("coal-slag"), of("plant"), of("wet"));
        assert_eq!(plant.density(900.0), Ok(2600.0));
        for (key, _, property) in slag.properties().filter(|(key, ..)| *key != "density") {
            assert_eq!(plant.property(key), Some(property), "{key}");
        }
        assert_eq!(plant.composition().unwrap().oxides().count(), 2);
        assert_eq!((wet.density(900.0), wet.emissivity_near(900.0)), (Ok(2600.0), Some(0.5)));
        assert_eq!(wet.composition(), plant.composition());
    }

    #[test]
    fn a_built_in_name_is_overridden_from_itself() {
        let library = read("[materials.fly-ash]\nlike = \"fly-ash\"\npoisson_ratio = 0.25\n").unwrap();
        let built_in = Library::built_in().unwrap();
        let [own, before] = [&library, &built_in].map(|library| library.get("fly-ash").unwrap().clone());
        assert_eq!(own.mechanical(300.0).unwrap().poisson_ratio, 0.25);
        assert_eq!(own.property("youngs_modulus"), before.property("youngs_modulus"));
    }

    /// Hill's mean of Young's modulus and Voigt's of Poisson's ratio, from the elastic constants [GPa] of both cubic
    /// salts.
    #[test]
    fn salts_have_the_modulus_of_their_crystals() {
        let library = Library::built_in().unwrap();
        for (name, [c11, c12, c44]) in
            [("potassium-chloride", [39.8, 6.2, 6.25]), ("sodium-chloride", [49.47, 12.88, 12.87])]
        {
            let bulk: f64 = (c11 + 2.0 * c12) / 3.0;
            let voigt: f64 = (c11 - c12 + 3.0 * c44) / 5.0;
            let reuss = 5.0 * (c11 - c12) * c44 / (4.0 * c44 + 3.0 * (c11 - c12));
            let shear = 0.5 * (voigt + reuss);
            let modulus = 9.0 * bulk * shear / (3.0 * bulk + shear);
            let poisson = (3.0 * bulk - 2.0 * voigt) / (2.0 * (3.0 * bulk + voigt));
            let salt = library.get(name).unwrap().mechanical(300.0).unwrap();
            assert!((salt.youngs_modulus / (1e9 * modulus) - 1.0).abs() < 0.01, "{name}: {modulus}");
            assert!((salt.poisson_ratio - poisson).abs() < 0.01, "{name}: {poisson}");
        }
    }

    /// Alloy 800H by other sources than the table's: 28.5 million psi, 0.11 BTU/(lb °F) and 80 BTU in/(ft² h °F) near
    /// 24 °C, a mean expansion of 16.6e-6/K from 21 to 427 °C, and the least yield strength of ASME III-5 at 550 °C,
    /// 108 MPa, above which a mean lies by less than a third.
    #[test]
    fn alloy_800h_agrees_with_data_sheets_and_code() {
        let library = Library::built_in().unwrap();
        let alloy = library.get("alloy-800h").unwrap();
        let near = |value: f64, sheet: f64| (value / sheet - 1.0).abs() < 0.01;
        let cold = alloy.mechanical(297.0).unwrap();
        assert!(near(cold.youngs_modulus, 28.5e6 * 6894.757), "{cold:?}");
        assert!(near(alloy.heat_capacity_near(294.26).unwrap(), 0.11 * 4186.8));
        assert!(near(alloy.thermal_conductivity_near(294.26).unwrap(), 80.0 * 0.144_227_9));
        let grown: f64 = 1.0 + 16.6e-6 * (427.0 - 21.0);
        assert!(near(alloy.density(700.15).unwrap() * grown.powi(3), 7940.0));
        let hot = alloy.mechanical(823.15).unwrap().yield_strength / 108e6;
        assert!((1.0..4.0 / 3.0).contains(&hot), "{hot}");
        let known = alloy.properties().all(|(key, _, property)| {
            key == "melting_point" || property.valid().is_some_and(|[_, high]| high > 1000.0)
        });
        assert!(known, "up to 1000 K");
    }

    /// Density, modulus and Poisson's ratio follow; strength and surface energy have no law, and the refusal says
    /// what to do.
    #[test]
    fn a_composition_gives_what_laws_give() {
        let oxides = "composition = { SiO2 = 43.2, Al2O3 = 36.6, CaO = 20.2 }\n";
        let glass =
            read(&format!("[materials.a]\nyield_strength = 3e8\nsurface_energy = 0.05\n{oxides}")).unwrap();
        let glass = glass.get("a").unwrap();
        let cold = glass.mechanical(293.15).unwrap();
        assert!(
            (cold.density / 2700.0 - 1.0).abs() < 0.04 && (cold.youngs_modulus / 90e9 - 1.0).abs() < 0.12,
            "{cold:?}"
        );
        let keys: Vec<_> = glass.estimated().iter().map(|(key, _)| *key).collect();
        assert_eq!(keys, ["density", "youngs_modulus", "poisson_ratio", "surface_tension"]);
        assert!(glass.mechanical(1723.15).unwrap().youngs_modulus < 0.1 * cold.youngs_modulus);
        let alone = read(&format!("[materials.a]\n{oxides}")).unwrap_err();
        assert!(
            alone.contains("materials.a.yield_strength: missing; add a value in Pa (no law gives it"),
            "{alone}"
        );
        assert!(alone.contains("like = \"fly-ash\""), "{alone}");
        let lime = read("[materials.a]\ncomposition = { CaO = 90, SiO2 = 10 }\n").unwrap_err();
        assert!(lime.contains("materials.a.density: missing") && lime.contains("outside the law"), "{lime}");
        let like = read(&format!("[materials.a]\nlike = \"fly-ash\"\n{oxides}")).unwrap();
        assert_eq!(like.get("a").unwrap().density(293.15), Ok(2300.0), "taken, not estimated");
    }

    #[test]
    fn slips_of_a_sheet_are_named() {
        let refused = |oxides: &str| {
            read(&format!("[materials.a]\nlike = \"fly-ash\"\ncomposition = {{ {oxides} }}\n")).unwrap_err()
        };
        let twice = refused("CaO = 90, SiO2 = 59");
        assert!(twice.contains("materials.a.composition: the shares add up to 149.0 wt%"), "{twice}");
        let salt = refused("CaO = 30, SiO2 = 59, Cl = 5");
        assert!(salt.contains("materials.a.composition.Cl: no oxide; leave chlorine out"), "{salt}");
        let unknown = refused("SiO = 30");
        assert!(
            unknown.contains("materials.a.composition.SiO: unknown oxide `SiO`; known: SiO2"),
            "{unknown}"
        );
    }

    #[test]
    fn a_wrong_base_is_named_with_the_remedy() {
        let refused = |text: &str| read(text).unwrap_err();
        assert!(refused("[materials.a]\nlike = \"coal-slak\"\n").starts_with(
            "m.toml:2:1: materials.a.like: unknown material `coal-slak`; did you mean `coal-slag`?"
        ));
        let later = "[materials.a]\nlike = \"b\"\n[materials.b]\nlike = \"a\"\n";
        assert!(
            refused(later).contains("materials.a.like: [materials.b] follows further down; move it above")
        );
        assert!(refused("[materials.a]\nlike = \"a\"\n").contains("`a` is not built in"));
        let misspelt = refused("[materials.a]\nlike = \"pyrex\"\nemisivity = 0.5\n");
        assert!(misspelt.contains("did you mean `emissivity`?"), "{misspelt}");
    }

    #[test]
    fn the_printed_block_of_every_built_in_material_reads_back_to_the_same_bits() {
        let built_in = Library::built_in().unwrap();
        for name in built_in.names() {
            let block = built_in_toml(name).unwrap();
            let header = format!("[materials.{name}]\n");
            let text = block.replace(&header, "[materials.pasted]\n");
            assert_ne!(text, block, "{name}");
            let pasted = read(&text).unwrap();
            let [pasted, before] = [pasted.get("pasted").unwrap(), built_in.get(name).unwrap()];
            assert_eq!(written(pasted), written(before), "{name}");
            for temperature in [293.15, 700.0, 1300.0, 1800.0, 3000.0] {
                let bits = |material: &Material| {
                    let at =
                        |property: &super::super::Property| property.at(temperature).ok().map(f64::to_bits);
                    material.properties().map(|(.., property)| at(property)).collect::<Vec<_>>()
                };
                assert_eq!(bits(pasted), bits(before), "{name} at {temperature} K");
            }
        }
        assert_eq!(built_in_toml("unobtainium"), None);
    }
}
