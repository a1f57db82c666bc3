//! Materials of particles and walls: properties over temperature, built in or given by the user.

mod estimate;
mod fusion;
mod library;
mod property;
mod table;

use crate::impact::ImpactError;
use crate::input::{InputError, Limits, Section};
use crate::law::QuantityKind;
use crate::slag::{Composition, CompositionError, FusionTemperatures, Molten, surface_tension};

pub use fusion::SHEET_BAND;
pub use library::{BUILT_IN_TEXT, Library, built_in_toml};
pub use property::{OutOfRange, Property};

/// Key of a property in files, its kind, its limits, and whether it is required.
struct PropertyField {
    key: &'static str,
    kind: QuantityKind,
    required: bool,
    limits: Limits,
}

const fn limits(unit: &'static str, low: f64, high: f64, known: &'static str) -> Limits {
    Limits { unit, low, high, known }
}

macro_rules! define_fields {
    ($($field:ident, $key:literal, $kind:ident, $required:literal, $limits:expr;)*) => {
        /// A property by its place in [`PROPERTY_FIELDS`].
        #[derive(Debug, Clone, Copy)]
        #[allow(dead_code, reason = "some are only read by their key")]
        enum Field {
            $($field,)*
        }

        const PROPERTY_FIELDS: [PropertyField; [$($key),*].len()] = [$(
            PropertyField { key: $key, kind: QuantityKind::$kind, required: $required, limits: $limits },
        )*];
    };
}

// Every property of a material, in the order of display; the first five are required. The limits
// lie about a factor of ten beyond the most extreme known materials, which their texts name (round
// numbers as commonly tabulated, not re-read); they admit a rigid wall, and one that never yields.
// Viscosity has no upper limit: a formula continued to low temperatures rises without bound and
// means a solid.
define_fields! {
    Density, "density", Amount, true, limits("kg/m3", 0.01, 2.5e5, "lightest aerogels 0.16, osmium 22590");
    YoungsModulus, "youngs_modulus", Amount, true, limits("Pa", 1.0, 1e13, "soft gels some 10, diamond 1.1e12");
    PoissonRatio, "poisson_ratio", Share, true, limits("1", -0.999, 0.5, "an elastic body is between -1 and 0.5");
    YieldStrength, "yield_strength", Amount, true, limits("Pa", 0.01, 1e12, "weak gels some 0.1, diamond 1e11");
    SurfaceEnergy, "surface_energy", Amount, true, limits("J/m2", 0.0, 100.0, "clean tungsten 3.3, diamond some 6");
    Viscosity, "viscosity", Amount, false, limits("Pa s", 1e-7, f64::INFINITY, "liquid helium 3e-6");
    SurfaceTension, "surface_tension", Amount, false, limits("N/m", 1e-5, 30.0, "liquid helium 1e-4, molten tungsten \
        2.5");
    MeltingPoint, "melting_point", Temperature, false, limits("K", 0.1, 5e4, "helium some 1, carbides 4200");
    CriticalViscosityTemperature, "critical_viscosity_temperature", Temperature, false, limits("K", 0.1, 5e4, "coal \
        slags 1400 to 1800");
    Liquidus, "liquidus", Temperature, false, limits("K", 0.1, 5e4, "coal slags 1500 to 1900");
    Solidus, "solidus", Temperature, false, limits("K", 0.1, 5e4, "coal slags 1200 to 1500");
    WorkOfAdhesion, "work_of_adhesion", Amount, false, limits("J/m2", 0.0, 1e3, "clean tungsten 6.5, fitted to \
        impacts 50");
    MeltFraction, "melt_fraction", Share, false, limits("1", 0.0, 1.0, "a share of the mass");
    HeatCapacity, "heat_capacity", Amount, false, limits("J/(kg K)", 0.01, 2e5, "hot metals 100, liquid hydrogen 1e4");
    ThermalConductivity, "thermal_conductivity", Amount, false, limits("W/(m K)", 1e-4, 1e5, "powder in vacuum 1e-3, \
        diamond 2000");
    HeatOfFusion, "heat_of_fusion", Amount, false, limits("J/kg", 100.0, 5e7, "mercury 1.1e4, boron 4.6e6");
    Emissivity, "emissivity", Share, false, limits("1", 0.0, 1.0, "a black body has 1");
}

/// The properties of [`Mechanical`], in their order; `work_of_adhesion` is one where it is given.
const MECHANICAL: [Field; 5] =
    [Field::Density, Field::YoungsModulus, Field::PoissonRatio, Field::YieldStrength, Field::SurfaceEnergy];

/// The kind of a property by its key in files.
pub fn kind_of(key: &str) -> Option<QuantityKind> {
    let property = PROPERTY_FIELDS.iter().find(|field| field.key == key).map(|field| field.kind);
    property.or((key == fusion::KEY).then_some(QuantityKind::Temperature))
}

/// The SI unit of a property by its key in files; of a composition per cent.
pub fn unit_of(key: &str) -> Option<&'static str> {
    match key {
        "composition" => Some("%"),
        fusion::KEY => Some("K"),
        _ => PROPERTY_FIELDS.iter().find(|field| field.key == key).map(|field| field.limits.unit),
    }
}

/// A solid that a particle or a wall is made of.
#[derive(Debug, Clone)]
pub struct Material {
    name: String,
    about: Option<String>,
    properties: [Option<Property>; PROPERTY_FIELDS.len()],
    composition: Option<Composition>,
    fusion_temperatures: Option<FusionTemperatures>,
    crystalline: bool,
}

/// The mechanical properties at one temperature.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Mechanical {
    /// Density `rho` [kg/m³].
    pub density: f64,
    /// Young's modulus `E` [Pa].
    pub youngs_modulus: f64,
    /// Poisson's ratio `nu` [1].
    pub poisson_ratio: f64,
    /// Yield strength `sigma_y` [Pa].
    pub yield_strength: f64,
    /// Surface energy `gamma` [J/m²].
    pub surface_energy: f64,
    /// Effective work of adhesion `W` [J/m²] of its impacts on any wall, where one was fitted to them.
    pub work_of_adhesion: Option<f64>,
}

impl Mechanical {
    /// Between these properties and those of another solid, linear in `share` [1]: 0 these, 1 the others.
    #[must_use]
    #[inline(always)]
    pub fn mixed(&self, other: &Self, share: f64) -> Self {
        let between = |of: fn(&Self) -> f64| of(self) + (of(other) - of(self)) * share;
        Self {
            density: between(|m| m.density),
            youngs_modulus: between(|m| m.youngs_modulus),
            poisson_ratio: between(|m| m.poisson_ratio),
            yield_strength: between(|m| m.yield_strength),
            surface_energy: between(|m| m.surface_energy),
            // A fitted value holds for one material; of a mixture each contact knows its own.
            work_of_adhesion: None,
        }
    }
}

impl Material {
    /// Reads one `[materials.<name>]` table. What it does not give is taken from `base`, the material
    /// that it is `like`.
    ///
    /// # Errors
    /// [`InputError::Fault`] for a missing, unknown or unphysical property.
    pub fn read(name: &str, section: &Section<'_>, base: Option<&Self>) -> Result<Self, InputError> {
        let mut properties = [const { None }; PROPERTY_FIELDS.len()];
        for (place, (field, property)) in PROPERTY_FIELDS.iter().zip(&mut properties).enumerate() {
            let own = Property::read(section, field.key, &field.limits)?;
            *property = own.or_else(|| base?.properties[place].clone());
        }
        let composition = section.section("composition")?.map(|s| read_composition(&s)).transpose()?;
        let fusion_temperatures = fusion::read(section)?.or_else(|| base?.fusion_temperatures);
        let composition = composition.or_else(|| base?.composition.clone());
        for (field, property) in
            PROPERTY_FIELDS.iter().zip(&mut properties).filter(|(field, _)| field.required)
        {
            if property.is_none() {
                *property = composition.as_ref().and_then(|oxides| estimate::estimated(field.key, oxides));
            }
            if property.is_none() {
                return Err(section.missing(field.key, &how_to_give(field, composition.as_ref())));
            }
        }
        let about = section.text("about")?.or(section.text("source")?);
        let about = about.or_else(|| base.map(|base| format!("like {}", base.name)));
        let crystalline = section.boolean("crystalline")?;
        let crystalline = crystalline.or(base.map(|base| base.crystalline)).unwrap_or(false);
        section.finish()?;
        if crystalline && properties[Field::MeltingPoint as usize].is_none() {
            let what = "the temperature [K] below which a crystalline material is solid,";
            return Err(section.missing("melting_point", what));
        }
        Ok(Self { name: name.to_owned(), about, properties, composition, fusion_temperatures, crystalline })
    }

    /// The name in model files.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// One line of description, or the source that the user gives.
    pub fn about(&self) -> Option<&str> {
        self.about.as_deref()
    }

    /// Oxide composition of an ash or slag.
    pub fn composition(&self) -> Option<&Composition> {
        self.composition.as_ref()
    }

    /// What its analysis adds up to [wt%], where that is too little for a whole sheet.
    pub fn incomplete_sum(&self) -> Option<f64> {
        self.composition.as_ref().map(Composition::given_sum).filter(|sum| *sum < LEAST_SUM)
    }

    /// A property by its key, for instance `youngs_modulus`.
    pub fn property(&self, key: &str) -> Option<&Property> {
        let index = PROPERTY_FIELDS.iter().position(|field| field.key == key)?;
        self.properties[index].as_ref()
    }

    /// Its properties with key and unit, in a fixed order.
    pub fn properties(&self) -> impl Iterator<Item = (&'static str, &'static str, &Property)> {
        let fields = PROPERTY_FIELDS.iter().zip(&self.properties);
        fields.filter_map(|(field, p)| Some((field.key, field.limits.unit, p.as_ref()?)))
    }

    /// The properties that follow from its composition and are not given: key, and the law with its error.
    pub fn estimated(&self) -> Vec<(&'static str, &str)> {
        let mechanical = self.properties().filter(|(.., property)| property.is_estimated());
        let mechanical = mechanical.filter_map(|(key, _, property)| Some((key, property.source()?)));
        let tension =
            self.surface_tension_by_composition().map(|_| ("surface_tension", surface_tension::ORIGIN));
        mechanical.chain(tension).collect()
    }

    /// Viscosity [Pa s] of the melt at a temperature [K].
    ///
    /// # Errors
    /// [`ImpactError::OutOfRange`] outside the known range, and for a material without a viscosity.
    pub fn viscosity(&self, temperature: f64) -> Result<f64, ImpactError> {
        self.value(Field::Viscosity, temperature)
    }

    /// Surface tension [N/m] of the melt at a temperature [K]; without one of its own, that of its composition
    /// ([`surface_tension::kucuk`]).
    ///
    /// # Errors
    /// As [`Material::viscosity`].
    pub fn surface_tension(&self, temperature: f64) -> Result<f64, ImpactError> {
        let composed = self.surface_tension_by_composition();
        composed.map_or_else(|| self.value(Field::SurfaceTension, temperature), Ok)
    }

    /// Surface tension [N/m] by the composition, for a material without one of its own.
    fn surface_tension_by_composition(&self) -> Option<f64> {
        let composition = self
            .composition
            .as_ref()
            .filter(|_| self.properties[Field::SurfaceTension as usize].is_none())?;
        surface_tension::kucuk(composition)
    }

    /// Density [kg/m³] at a temperature [K].
    ///
    /// # Errors
    /// [`ImpactError::OutOfRange`] outside a table.
    pub fn density(&self, temperature: f64) -> Result<f64, ImpactError> {
        self.value(Field::Density, temperature)
    }

    /// Temperatures [K] at which the density is known.
    pub fn density_range(&self) -> [f64; 2] {
        overlap(self.properties[Field::Density as usize].iter().filter_map(Property::known_range))
    }

    fn value(&self, field: Field, temperature: f64) -> Result<f64, ImpactError> {
        let nowhere = OutOfRange { low: f64::NAN, high: f64::NAN };
        let found = self.properties[field as usize].as_ref().map_or(Err(nowhere), |p| p.at(temperature));
        found.map_err(|OutOfRange { low, high }| ImpactError::OutOfRange {
            material: self.name.clone(),
            property: PROPERTY_FIELDS[field as usize].key,
            temperature,
            low,
            high,
        })
    }

    /// The five mechanical properties at a temperature [K].
    ///
    /// # Errors
    /// [`ImpactError::OutOfRange`] outside a table.
    pub fn mechanical(&self, temperature: f64) -> Result<Mechanical, ImpactError> {
        Ok(Mechanical {
            density: self.density(temperature)?,
            youngs_modulus: self.value(Field::YoungsModulus, temperature)?,
            poisson_ratio: self.value(Field::PoissonRatio, temperature)?,
            yield_strength: self.value(Field::YieldStrength, temperature)?,
            surface_energy: self.value(Field::SurfaceEnergy, temperature)?,
            work_of_adhesion: match self.properties[Field::WorkOfAdhesion as usize] {
                Some(_) => Some(self.value(Field::WorkOfAdhesion, temperature)?),
                None => None,
            },
        })
    }

    /// The mechanical properties, in the order of [`Mechanical`]; the last is `None` for a material
    /// without a fitted work of adhesion.
    pub(crate) fn mechanical_by_field(&self) -> Option<([&Property; MECHANICAL.len()], Option<&Property>)> {
        let [a, b, c, d, e] = MECHANICAL.map(|field| self.properties[field as usize].as_ref());
        Some(([a?, b?, c?, d?, e?], self.properties[Field::WorkOfAdhesion as usize].as_ref()))
    }

    /// Temperatures [K] at which every mechanical property is stated to hold, where they are one
    /// range; `None` where a property has a melt of its own.
    pub(crate) fn stated_range(&self) -> Option<[f64; 2]> {
        let ranges: Option<Vec<_>> = self.mechanical_properties().map(Property::stated_range).collect();
        Some(overlap(ranges?.into_iter()))
    }

    /// The properties of its melt at a temperature [K].
    ///
    /// # Errors
    /// [`ImpactError::OutOfRange`] outside the known range, and for a material without one of them.
    pub fn molten(&self, temperature: f64) -> Result<Molten, ImpactError> {
        Ok(Molten {
            density: self.density(temperature)?,
            viscosity: self.viscosity(temperature)?,
            surface_tension: self.surface_tension(temperature)?,
        })
    }

    /// Surface tension [N/m] of its melt at a temperature [K], or at the nearest temperature at
    /// which it is known; `None` without one and without a composition.
    pub fn surface_tension_near(&self, temperature: f64) -> Option<f64> {
        self.surface_tension_by_composition().or_else(|| self.near(Field::SurfaceTension, temperature))
    }

    /// As [`Material::surface_tension_near`], the viscosity [Pa s] of its melt.
    pub fn viscosity_near(&self, temperature: f64) -> Option<f64> {
        self.near(Field::Viscosity, temperature)
    }

    /// As [`Material::surface_tension_near`], the share of liquid in its mass [1].
    pub fn melt_fraction_near(&self, temperature: f64) -> Option<f64> {
        self.near(Field::MeltFraction, temperature)
    }

    /// As [`Material::surface_tension_near`], the heat capacity [J/(kg K)].
    pub fn heat_capacity_near(&self, temperature: f64) -> Option<f64> {
        self.near(Field::HeatCapacity, temperature)
    }

    /// As [`Material::surface_tension_near`], the thermal conductivity [W/(m K)].
    pub fn thermal_conductivity_near(&self, temperature: f64) -> Option<f64> {
        self.near(Field::ThermalConductivity, temperature)
    }

    /// As [`Material::surface_tension_near`], the heat of fusion [J/kg].
    pub fn heat_of_fusion_near(&self, temperature: f64) -> Option<f64> {
        self.near(Field::HeatOfFusion, temperature)
    }

    /// As [`Material::surface_tension_near`], the total emissivity of its surface [1].
    pub fn emissivity_near(&self, temperature: f64) -> Option<f64> {
        self.near(Field::Emissivity, temperature)
    }

    /// The melting point [K] of a crystalline material: below it there is no melt, not even a stiff one.
    /// `None` for a glass, whose melt only stiffens.
    pub fn crystalline_below(&self) -> Option<f64> {
        self.melting_point_near(293.15).filter(|_| self.crystalline)
    }

    /// As [`Material::surface_tension_near`], the melting point [K].
    pub fn melting_point_near(&self, temperature: f64) -> Option<f64> {
        self.near(Field::MeltingPoint, temperature)
    }

    fn near(&self, field: Field, temperature: f64) -> Option<f64> {
        let property = self.properties[field as usize].as_ref()?;
        let [low, high] = property.known_range().unwrap_or([0.0, f64::INFINITY]);
        property.at(temperature.clamp(low, high)).ok()
    }

    /// Density [kg/m³] at a temperature [K], or at the nearest temperature at which it is known.
    ///
    /// # Errors
    /// As [`Material::density`].
    pub fn density_near(&self, temperature: f64) -> Result<f64, ImpactError> {
        let [low, high] = self.density_range();
        self.density(temperature.clamp(low, high))
    }

    /// Whether a temperature [K] is above the melting point.
    ///
    /// # Errors
    /// As [`Material::molten`].
    pub fn is_molten(&self, temperature: f64) -> Result<bool, ImpactError> {
        Ok(temperature > self.value(Field::MeltingPoint, temperature)?)
    }

    /// Temperatures [K] at which every property of the melt is known.
    pub fn molten_range(&self) -> [f64; 2] {
        overlap(self.molten_properties().filter_map(Property::known_range))
    }

    /// Whether every property of the melt is stated to hold at a temperature [K].
    pub fn melt_holds_at(&self, temperature: f64) -> bool {
        let composed = self.composition.as_ref().filter(|_| self.surface_tension_by_composition().is_some());
        self.molten_properties().all(|p| p.holds_at(temperature))
            && composed.is_none_or(|composition| surface_tension::holds(composition, temperature))
    }

    fn mechanical_properties(&self) -> impl Iterator<Item = &Property> {
        let fields = MECHANICAL.into_iter().chain([Field::WorkOfAdhesion]);
        fields.filter_map(|field| self.properties[field as usize].as_ref())
    }

    fn molten_properties(&self) -> impl Iterator<Item = &Property> {
        let fields = [Field::Density, Field::Viscosity, Field::SurfaceTension];
        fields.into_iter().filter_map(|field| self.properties[field as usize].as_ref())
    }

    /// Temperatures [K] at which every mechanical property is known.
    pub fn known_range(&self) -> [f64; 2] {
        overlap(self.mechanical_properties().filter_map(Property::known_range))
    }

    /// Temperatures [K] at which the material's own viscosity is known.
    pub fn viscosity_range(&self) -> [f64; 2] {
        overlap(self.properties[Field::Viscosity as usize].iter().filter_map(Property::known_range))
    }

    /// Whether every mechanical property is stated to hold at this temperature [K].
    pub fn holds_at(&self, temperature: f64) -> bool {
        self.mechanical_properties().all(|p| p.holds_at(temperature))
    }

    /// Key and stated range [K] of each mechanical property that is held outside of it at a temperature [K].
    pub(crate) fn not_stated_at(&self, temperature: f64) -> impl Iterator<Item = (&'static str, [f64; 2])> {
        let fields = MECHANICAL.into_iter().chain([Field::WorkOfAdhesion]);
        fields.filter_map(move |field| {
            let property = self.properties[field as usize].as_ref()?;
            let held = !property.holds_at(temperature);
            held.then(|| {
                (PROPERTY_FIELDS[field as usize].key, property.valid().unwrap_or([0.0, f64::INFINITY]))
            })
        })
    }

    /// Key of each mechanical property that is stated for some temperatures only, and its relative
    /// uncertainty [1], 0 where none is stated.
    pub(crate) fn limited_properties(&self) -> impl Iterator<Item = (&'static str, f64)> {
        let fields = MECHANICAL.into_iter().chain([Field::WorkOfAdhesion]);
        fields.filter_map(|field| {
            let property = self.properties[field as usize].as_ref()?;
            property.valid()?;
            Some((PROPERTY_FIELDS[field as usize].key, property.relative_uncertainty().unwrap_or(0.0)))
        })
    }

    /// The same material with one property multiplied by a factor [1], within its limits.
    pub(crate) fn scaled(&self, key: &str, factor: f64) -> Self {
        let mut changed = self.clone();
        for (field, property) in PROPERTY_FIELDS.iter().zip(&mut changed.properties) {
            if field.key == key {
                *property = property.take().map(|p| p.scaled(factor, &field.limits));
            }
        }
        changed
    }

    /// Whether the mechanical properties are the same at every temperature.
    pub fn is_constant(&self) -> bool {
        self.mechanical_properties().all(Property::is_constant)
    }
}

/// The intersection of all ranges; all temperatures without any.
pub(crate) fn overlap(ranges: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    ranges.fold([0.0, f64::INFINITY], |[low, high], [l, h]| [low.max(l), high.min(h)])
}

/// What to add for a required property that is missing, in words.
fn how_to_give(field: &PropertyField, composition: Option<&Composition>) -> String {
    let unit = field.limits.unit;
    match composition {
        None => format!("a value in {unit}"),
        Some(_) if estimate::ESTIMATED.contains(&field.key) => {
            format!("a value in {unit} (the composition is outside the law that estimates it)")
        }
        Some(_) => {
            format!(
                "a value in {unit} (no law gives it by composition; like = \"fly-ash\" takes that of fly ash)"
            )
        }
    }
}

/// An analysis that adds up to more has a slip [wt%].
const LARGEST_SUM: f64 = 110.0;
/// One that adds up to less has a slip, or leaves out enough to change a viscosity [wt%].
const LEAST_SUM: f64 = 90.0;

fn read_composition(section: &Section<'_>) -> Result<Composition, InputError> {
    const NOTES: [&str; 2] = ["unit", "source"];
    section.choice("unit", &["wt%"])?;
    section.text("source")?;
    let mut oxides = Vec::new();
    for key in section.keys().iter().filter(|key| !NOTES.contains(&key.as_str())) {
        oxides.push((key.clone(), section.required_number(key)?));
    }
    let sum: f64 = oxides.iter().map(|(_, share)| share).sum();
    if sum > LARGEST_SUM {
        return Err(section.fault("", format!("the shares add up to {sum:.1} wt%; correct the sheet")));
    }
    let named = oxides.iter().map(|(name, share)| (name.as_str(), *share));
    Composition::new(named).map_err(|error| match &error {
        CompositionError::UnknownOxide { name } if name.contains("Cl") => {
            section.fault(name, "no oxide; leave chlorine out, and give what melts early as `melt_fraction`")
        }
        CompositionError::UnknownOxide { name } => section.fault(name, error.to_string()),
        _ => section.fault("", error),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Document;

    #[test]
    fn every_built_in_number_names_unit_range_and_source() {
        let library = Library::built_in().unwrap();
        assert!(library.names().len() >= 27);
        for name in library.names() {
            let material = library.get(name).unwrap();
            assert!(material.about().is_some(), "{name}");
            for (key, _, property) in material.properties() {
                assert!(property.source().is_some_and(|s| s.len() > 5), "{name}.{key}: source");
                let [low, high] = property.valid().unwrap_or_else(|| panic!("{name}.{key}: valid"));
                for temperature in [low, 0.5 * (low + high), high] {
                    assert!(property.at(temperature).unwrap() >= 0.0, "{name}.{key} at {temperature}");
                }
            }
        }
    }

    /// Every material of a deposit or of the wall under it conducts, stores and radiates heat at any temperature.
    #[test]
    fn deposits_and_walls_have_thermal_properties() {
        let library = Library::built_in().unwrap();
        for name in ["fly-ash", "coal-slag", "refractory", "stainless-steel", "alloy-800h"] {
            let material = library.get(name).unwrap();
            for temperature in [250.0, 900.0, 1600.0, 2500.0] {
                let capacity = material.heat_capacity_near(temperature).unwrap();
                let conductivity = material.thermal_conductivity_near(temperature).unwrap();
                let emissivity = material.emissivity_near(temperature).unwrap();
                assert!((400.0..1500.0).contains(&capacity), "{name}: {capacity}");
                assert!((1.0..30.0).contains(&conductivity), "{name}: {conductivity}");
                assert!((0.5..=1.0).contains(&emissivity), "{name}: {emissivity}");
            }
        }
        assert_eq!(library.get("teflon").unwrap().emissivity_near(300.0), None);
    }

    /// Both ends of every property's limits, just within and just beyond.
    #[test]
    fn a_number_that_no_material_has_is_refused() {
        let usual = [
            "2300", "7e10", "0.2", "3e8", "0.05", "1", "0.4", "1600", "1500", "1700", "1400", "0.5", "0.5",
            "1000", "2", "4e5", "0.8",
        ];
        let read = |place: usize, value: f64| {
            let lines = PROPERTY_FIELDS.iter().zip(usual).enumerate().map(|(at, (field, usual))| {
                let value = if at == place { format!("{value:e}") } else { usual.to_owned() };
                format!("{} = {value}\n", field.key)
            });
            let document = Document::new("m.toml", format!("[p]\n{}", lines.collect::<String>()));
            document.read(|top| Library::default().with(top)).map_err(|error| error.to_string())
        };
        for (place, field) in PROPERTY_FIELDS.iter().enumerate() {
            let Limits { low, high, .. } = field.limits;
            for inside in [low, high].into_iter().filter(|end| end.is_finite()) {
                assert!(read(place, inside).is_ok(), "{} {inside}", field.key);
            }
            let beyond_high = if high > 0.0 { 1.001 * high } else { 0.999 * high };
            let beyond_low = if low > 0.0 { 0.999 * low } else { 1.001 * low - 1e-300 };
            for outside in [beyond_low, beyond_high].into_iter().filter(|number| number.is_finite()) {
                let message = read(place, outside).unwrap_err();
                let start = format!("m.toml:{}:1: p.{}: ", place + 2, field.key);
                let remedy = format!("check the exponent and the unit, {}", field.limits.unit);
                assert!(message.starts_with(&start) && message.ends_with(&remedy), "{message}");
                assert!(message.contains(field.limits.known), "{message}");
            }
        }
        assert_eq!(
            read(1, 70e90).unwrap_err(),
            "m.toml:3:1: p.youngs_modulus: 7e91 is outside the allowed range 1 to 1e13 (soft gels some 10, diamond \
                1.1e12); check the exponent and the unit, Pa"
        );
        assert!(read(0, 1e-320).unwrap_err().contains("p.density: 1e-320 is outside"));
    }

    #[test]
    fn wax_has_the_papers_numbers() {
        let library = Library::built_in().unwrap();
        let wax = library.get("montan-wax").unwrap().mechanical(293.15).unwrap();
        assert_eq!(wax.youngs_modulus, 700e6);
        assert_eq!(wax.yield_strength, 9.5e6);
        assert_eq!(wax.poisson_ratio, 0.49);
        assert_eq!(wax.surface_energy, 0.03);
    }
}
