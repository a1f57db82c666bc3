//! What an impact uses outside of the range that it is stated for: which property or law, by how much.
//!
//! Two grades ([`Beyond::is_held`]): a property of a material that is held at its value outside of the
//! temperatures of its source, and a law, a criterion or a fitted term beyond its fit.
//! [`Outcome::outside_range`](crate::Outcome::outside_range) says that there is at least one.

use std::fmt;

use super::general_wall::Watcher;
use super::groups::ImpactOnWall;
use super::wall::WallPlace;
use super::{Model, Wall};
use crate::capture::drop_bounce::StatedNumber;
use crate::capture::{Stickiness, StickinessCriterion};
use crate::effect::Term;
use crate::impact::{INPUTS, Impact, ImpactError};
use crate::law::Origin;
use crate::material::Material;
use crate::normal::{Contact, LARGEST_CONTACT_RADIUS, NormalLaw};

/// One thing that is used outside of its stated range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beyond<'m> {
    /// What is used.
    pub what: Stated<'m>,
    /// Where the impact lies.
    pub limit: Limit<'m>,
}

/// What has a stated range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stated<'m> {
    /// A property of a material, by its key.
    Property {
        /// The material's name.
        material: &'m str,
        /// The key, for instance `surface_energy`.
        key: &'static str,
    },
    /// A capture criterion with its law of viscosity, for a material or slag.
    Criterion {
        /// Its name in `[capture]`.
        name: &'static str,
    },
    /// A capture criterion that knows no speed.
    CriterionSpeed {
        /// Its name in `[capture]`.
        name: &'static str,
    },
    /// A normal or tangential law, or an effect.
    Law {
        /// Its name in the model file.
        name: &'static str,
    },
}

/// The range that was left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limit<'m> {
    /// Of a quantity of the impact.
    Quantity {
        /// Name of the input, or of the quantity in words.
        name: &'m str,
        /// Its unit.
        unit: &'m str,
        /// Its value.
        value: f64,
        /// The lowest and the highest stated value.
        range: [f64; 2],
    },
    /// Of the compositions to which a law was fitted.
    Composition {
        /// These compositions in words, where they are known.
        stated_for: Option<&'static str>,
    },
}

impl Beyond<'_> {
    /// Whether a property is held constant; otherwise a law, a criterion or a term is beyond its fit.
    pub fn is_held(&self) -> bool {
        matches!(self.what, Stated::Property { .. })
    }

    /// What is used and its range, without the value of this impact: the same text for every impact
    /// that leaves the same range.
    pub fn stated(&self) -> String {
        match self.limit {
            Limit::Quantity { name, unit, range: [low, high], .. } => {
                format!("{} is stated for {name} {}", self.what, range_text(low, high, unit))
            }
            Limit::Composition { stated_for } => {
                let only = stated_for.map_or(String::new(), |words| format!(", only for {words}"));
                format!("{} is not stated for the composition{only}", self.what)
            }
        }
    }

    /// The value of this impact, with its unit; `None` for a composition.
    pub fn value(&self) -> Option<String> {
        match self.limit {
            Limit::Quantity { value, .. } if value.is_nan() => Some("no value".to_owned()),
            Limit::Quantity { value, unit, .. } => Some(with_unit(&short(value), unit)),
            Limit::Composition { .. } => None,
        }
    }
}

impl fmt::Display for Stated<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Property { material, key } => write!(f, "{key} of {material}"),
            Self::Criterion { name } | Self::CriterionSpeed { name } => write!(f, "capture {name}"),
            Self::Law { name } => f.write_str(name),
        }
    }
}

impl fmt::Display for Beyond<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.stated())?;
        self.value().map_or(Ok(()), |value| write!(f, ", here {value}"))
    }
}

/// A number with at most five digits.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.4e}").parse().unwrap_or(value);
    let size = rounded.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) { format!("{rounded:e}") } else { rounded.to_string() }
}

fn with_unit(text: &str, unit: &str) -> String {
    if unit.is_empty() { text.to_owned() } else { format!("{text} {unit}") }
}

fn range_text(low: f64, high: f64, unit: &str) -> String {
    let range = match (low.is_finite() && low != 0.0, high.is_finite()) {
        (true, false) => format!("from {}", short(low)),
        (false, true) => format!("up to {}", short(high)),
        _ => format!("{} to {}", short(low), short(high)),
    };
    with_unit(&range, unit)
}

/// Calls `found` for everything that is used outside of its range.
pub(super) type Found<'m, 'f> = dyn FnMut(Beyond<'m>) + 'f;

/// Properties of a material that are held constant at a temperature [K] of the input `name`.
fn of_material<'m>(material: &'m Material, name: &'static str, kelvin: f64, found: &mut Found<'m, '_>) {
    for (key, range) in material.not_stated_at(kelvin) {
        let what = Stated::Property { material: material.name(), key };
        found(Beyond { what, limit: Limit::Quantity { name, unit: "K", value: kelvin, range } });
    }
}

/// A criterion at a temperature [K] of the input `name`. Within its temperatures the composition is
/// what it is not stated for.
fn of_criterion(
    criterion: &dyn StickinessCriterion,
    name: &'static str,
    kelvin: f64,
    found: &mut Found<'_, '_>,
) {
    let [low, high] = criterion.stated_range();
    let limit = if low > high || (low..=high).contains(&kelvin) {
        Limit::Composition { stated_for: criterion.stated_for() }
    } else {
        Limit::Quantity { name, unit: "K", value: kelvin, range: [low, high] }
    };
    found(Beyond { what: Stated::Criterion { name: criterion.name() }, limit });
}

/// A criterion that knows no speed, where something sticks faster than it is stated for.
fn of_speed(criterion: &dyn StickinessCriterion, impact: &Impact, found: &mut Found<'_, '_>) {
    let (value, range) = (impact.normal_speed, [0.0, criterion.fastest()]);
    let limit = Limit::Quantity { name: "v_n", unit: "m/s", value, range };
    found(Beyond { what: Stated::CriterionSpeed { name: criterion.name() }, limit });
}

/// The rebound of a droplet, by its dimensionless numbers and its contact angle.
fn of_drop_rebound(criterion: &dyn StickinessCriterion, impact: &Impact, found: &mut Found<'_, '_>) {
    let what = Stated::Law { name: "droplet rebound" };
    for StatedNumber { name, unit, value, range } in criterion.left_by_rebound(impact) {
        found(Beyond { what, limit: Limit::Quantity { name, unit, value, range } });
    }
}

/// A law that was fitted to a case.
fn of_origin(name: &'static str, origin: &'static Origin, impact: &Impact, found: &mut Found<'_, '_>) {
    for limit in origin.left_by(impact) {
        let (value, range) = ((limit.value)(impact), limit.range);
        let limit = Limit::Quantity { name: limit.quantity, unit: limit.unit, value, range };
        found(Beyond { what: Stated::Law { name }, limit });
    }
}

/// A term with `valid` ranges.
fn of_term<'m>(model: &'m Model, term: &'m Term, impact: &Impact, found: &mut Found<'m, '_>) {
    let what = Stated::Law { name: term.kind().id };
    let mut check = |name: &'m str, unit: &'m str, value: f64, range: [f64; 2]| {
        if !(range[0]..=range[1]).contains(&value) {
            found(Beyond { what, limit: Limit::Quantity { name, unit, value, range } });
        }
    };
    for &(input, range) in term.valid() {
        check(INPUTS[input].name, INPUTS[input].unit, (INPUTS[input].value)(impact), range);
    }
    for &(input, range) in term.valid_extra() {
        if let (Some(declared), Some(value)) = (model.extra_inputs.get(input), impact.extra.get(input)) {
            check(&declared.name, "", *value, range);
        }
    }
}

/// The normal law, once the contact is known. A contact law holds while the contact stays small
/// against the particle: `a/R` goes with the fourth root of the energy.
pub(super) fn of_normal_law(law: NormalLaw, contact: &Contact, impact: &Impact, found: &mut Found<'_, '_>) {
    let name = law.name();
    match law {
        NormalLaw::Listed { law, .. } => of_origin(name, law.origin, impact, found),
        _ if law.holds_for(contact, impact) => {}
        _ => {
            let pressure = contact.density * impact.normal_speed * impact.normal_speed;
            let share = pressure / contact.largest_impact_pressure();
            let limit = Limit::Quantity {
                name: "contact radius over particle radius",
                unit: "",
                value: LARGEST_CONTACT_RADIUS * share.sqrt().sqrt(),
                range: [0.0, LARGEST_CONTACT_RADIUS],
            };
            found(Beyond { what: Stated::Law { name }, limit });
        }
    }
}

/// A dry contact law where the wall is sticky.
pub(super) fn of_dry_contact(law: NormalLaw, wall: f64, found: &mut Found<'_, '_>) {
    let range = [0.0, Stickiness::THRESHOLD];
    let limit = Limit::Quantity { name: "wall stickiness", unit: "", value: wall, range };
    found(Beyond { what: Stated::Law { name: law.name() }, limit });
}

impl Model {
    /// What an impact at one place of a wall uses outside of its range, but for the normal law.
    pub(super) fn beyond_before<'m>(
        &'m self,
        wall: &'m Wall,
        place: WallPlace,
        impact: &Impact,
        found: &mut Found<'m, '_>,
    ) {
        let Impact { particle_temperature, wall_temperature, .. } = *impact;
        if let Some(criterion) = &self.stickiness {
            if !criterion.holds_in_flight(particle_temperature) {
                of_criterion(criterion.as_ref(), "T_p", particle_temperature, found);
            } else if !criterion.holds_for_particle(impact) {
                of_speed(criterion.as_ref(), impact, found);
            }
            if impact.melt_thickness > 0.0 && !criterion.holds_on_wall(wall_temperature) {
                of_criterion(criterion.as_ref(), "T_w", wall_temperature, found);
            }
            if self.may_bounce(wall, place, impact) == Ok(true) {
                of_drop_rebound(criterion.as_ref(), impact, found);
            }
        }
        let melt = wall.melt.as_ref().filter(|_| place != WallPlace::Covered);
        if let Some(melt) = melt.filter(|melt| !melt.holds_for_wall(impact)) {
            if melt.holds_on_wall(wall_temperature) {
                of_speed(melt.as_ref(), impact, found);
            } else {
                of_criterion(melt.as_ref(), "T_w", wall_temperature, found);
            }
        }
        if let Some(origin) = self.tangential.origin() {
            of_origin(self.tangential.name(), origin, impact, found);
        }
        of_material(self.particle.stated_material(impact), "T_p", particle_temperature, found);
        match self.frozen_slag(wall, impact).filter(|_| place != WallPlace::Covered) {
            Some(slag) => of_material(slag, "T_w", wall_temperature, found),
            None => of_material(&wall.material, "T_w", impact.own_wall_temperature(), found),
        }
        self.terms.iter().for_each(|term| of_term(self, term, impact, found));
    }

    /// The terms whose ranges of groups an impact leaves.
    pub(super) fn beyond_groups<'m>(&'m self, of: &ImpactOnWall<'_>, found: &mut Found<'m, '_>) {
        let declared = self.declared();
        for term in &self.terms {
            let what = Stated::Law { name: term.kind().id };
            for &(group, range) in term.valid_groups() {
                let value = group.value(of);
                if !(range[0]..=range[1]).contains(&value) {
                    let name = group.name(&declared);
                    found(Beyond { what, limit: Limit::Quantity { name, unit: "", value, range } });
                }
            }
        }
    }

    /// What an impact uses outside of its stated range, at both shares of a wall that is covered in
    /// part, each thing once; random numbers are at their median. Empty exactly where the outcome of
    /// the same draws has no [`outside_range`](crate::Outcome::outside_range).
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn beyond(&self, wall: usize, impact: &Impact) -> Result<Vec<Beyond<'_>>, ImpactError> {
        let mut all = Vec::new();
        self.evaluate(wall, impact, |_| 0.5, &mut all)?;
        Ok(all)
    }
}

impl<'m> Watcher<'m> for Vec<Beyond<'m>> {
    fn beyond(&mut self, beyond: Beyond<'m>) {
        // Texts, not values: a group without a value is not equal to itself.
        if !self.iter().any(|known| known.what == beyond.what && known.to_string() == beyond.to_string()) {
            self.push(beyond);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WAX_ON_STEEL: &str = r#"
[particle]
material = "montan-wax"
[walls.default]
material = "stainless-steel"
[normal]
model = "thornton-ning"
yield_ratio = 0.7
[tangential]
model = "grant-tabakoff"
"#;

    /// The steel's surface energy is stated for 0 to 130 °C, its other properties at least to 810 K;
    /// the law of Grant and Tabakoff has the speeds of their sand.
    #[test]
    fn every_range_that_is_left_is_named_with_the_value() {
        let model = Model::from_toml("m", WAX_ON_STEEL).unwrap();
        let impact = Impact { wall_temperature: 500.0, normal_speed: 100.0, ..Impact::default() };
        let texts: Vec<String> = model.beyond(0, &impact).unwrap().iter().map(Beyond::to_string).collect();
        let held = "surface_energy of stainless-steel is stated for T_w 273.15 to 403.15 K, here 500 K";
        assert!(texts.contains(&held.to_owned()), "{texts:#?}");
        let slow = model.beyond(0, &Impact { normal_speed: 1.0, ..impact }).unwrap();
        let law = slow.iter().find(|beyond| !beyond.is_held()).unwrap().to_string();
        assert!(
            law.starts_with("grant-tabakoff is stated for speed ") && law.ends_with("m/s, here 1 m/s"),
            "{law}"
        );
    }

    #[test]
    fn numbers_and_ranges_are_short() {
        assert_eq!([273.15, 1e-5, 0.0, 1.23456e7].map(short), ["273.15", "1e-5", "0", "1.2346e7"]);
        assert_eq!(range_text(-3.0, 3.0, "m/s"), "-3 to 3 m/s");
        assert_eq!(range_text(300.0, f64::INFINITY, "K"), "from 300 K");
        assert_eq!(range_text(f64::NEG_INFINITY, 3.0, "m"), "up to 3 m");
    }
}
