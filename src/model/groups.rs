//! The groups of an impact on a wall of a model: what gives each quantity, and which groups a model can compute.
//!
//! A quantity is that of the input that the impact states, else that of the materials and laws. The contact
//! of the normal law is that of [`Model::speeds`]: with the wall as a whole, random numbers at their median.

use super::general_wall::Watcher;
use super::wall::WallPlace;
use super::{Model, Wall};
use crate::effect::CurveInput;
use crate::group::{Circumstances, Declared, GROUPS, GroupInfo, ProductGroup, Quantity};
use crate::impact::{Impact, ImpactError};
use crate::normal::Speeds;

/// An impact that reaches a wall of a model.
pub(super) struct ImpactOnWall<'a> {
    pub model: &'a Model,
    pub wall: &'a Wall,
    /// With what lies on the wall.
    pub impact: &'a Impact,
    /// `e_n` [1] before fitted corrections.
    pub normal_restitution: f64,
}

impl Circumstances for ImpactOnWall<'_> {
    fn impact(&self) -> &Impact {
        self.impact
    }

    fn quantity(&self, quantity: Quantity) -> f64 {
        let stated = quantity.input().and_then(|input| self.stated(input));
        let value = stated.or_else(|| self.by_model(quantity));
        let has_meaning = |value: &f64| *value > 0.0 || quantity == Quantity::NormalRestitution;
        value.filter(has_meaning).filter(|value| value.is_finite()).unwrap_or(f64::NAN)
    }

    fn products(&self) -> &[ProductGroup] {
        &self.model.products
    }
}

impl ImpactOnWall<'_> {
    /// The value of an input that the model file declares, where the impact has it.
    fn stated(&self, name: &str) -> Option<f64> {
        let value = self.impact.extra.get(self.model.declared_number(name)?).copied();
        value.filter(|value| !value.is_nan())
    }

    /// What materials and laws give, in the unit of the quantity.
    fn by_model(&self, quantity: Quantity) -> Option<f64> {
        let Self { model, impact, .. } = *self;
        let (temperature, liquid) = (impact.particle_temperature, model.particle.melting());
        match quantity {
            Quantity::Density if impact.particle_density > 0.0 => Some(impact.particle_density),
            Quantity::Density => model.particle_density(impact).ok(),
            Quantity::Viscosity => model.liquid_viscosity(temperature),
            Quantity::SurfaceTension => {
                let solid = liquid.melting_point_near(temperature).is_some_and(|melts| temperature <= melts);
                if solid { None } else { liquid.surface_tension(temperature).ok() }
            }
            Quantity::StickingVelocity if model.normal.has_sticking_velocity() => {
                Some(self.speeds()?.sticking)
            }
            Quantity::YieldVelocity if model.normal.is_contact_law() => Some(self.speeds()?.yielding),
            Quantity::StickingVelocity | Quantity::YieldVelocity | Quantity::GasViscosity => None,
            Quantity::MeltingPoint => liquid.melting_point_near(temperature),
            Quantity::ReferenceViscosity => model.stickiness.as_ref()?.reference_viscosity(impact),
            Quantity::FilmViscosity => self.film_viscosity(),
            Quantity::NormalRestitution => Some(self.normal_restitution),
            Quantity::Friction => Some(model.friction().unwrap_or(1.0)),
        }
    }

    fn speeds(&self) -> Option<Speeds> {
        let contact = self.model.contact(self.wall, self.impact, WallPlace::Anywhere, &|_| 0.5).ok()?;
        Some(self.model.normal.speeds_of(&contact, self.impact))
    }

    fn film_viscosity(&self) -> Option<f64> {
        let stated = self.model.terms.iter().find_map(|term| term.effect().film_viscosity());
        let melt = || Some(self.model.melt_met(self.wall, self.impact).ok()??.viscosity);
        stated.or_else(melt)
    }
}

impl Model {
    /// Place in [`Impact::extra`] of a number that the model file declares.
    fn declared_number(&self, name: &str) -> Option<usize> {
        self.extra_inputs.iter().position(|input| input.name == name && !input.is_label())
    }

    /// Viscosity [Pa s] of the particle's liquid at a temperature [K]: by the capture criterion, else the
    /// material's own; `None` for crystals and where it is not known.
    fn liquid_viscosity(&self, temperature: f64) -> Option<f64> {
        let by_criterion = self.stickiness.as_ref().and_then(|one| one.liquid_viscosity(temperature));
        let liquid = self.particle.melting();
        let crystals = liquid.crystalline_below().is_some_and(|melts| temperature < melts);
        by_criterion.or_else(|| if crystals { None } else { liquid.viscosity(temperature).ok() })
    }

    /// Friction coefficient [1] of the tangential law, or of the effect that replaces it.
    fn friction(&self) -> Option<f64> {
        let of_term = self.terms.iter().rev().find_map(|term| {
            let place = term.kind().parameters.iter().position(|parameter| parameter.name == "friction")?;
            term.values().get(place).copied()
        });
        of_term.or_else(|| self.tangential.friction())
    }

    /// What the model file declares.
    pub fn declared(&self) -> Declared<'_> {
        Declared { inputs: &self.extra_inputs, products: &self.products }
    }

    /// The groups that the model file declares.
    pub fn products(&self) -> &[ProductGroup] {
        &self.products
    }

    /// The same model with other groups of its own.
    #[must_use]
    pub fn with_products(&self, products: Vec<ProductGroup>) -> Self {
        Self { products, ..self.clone() }.prepare()
    }

    /// The places in [`GROUPS`] of the groups that the model can compute, with its materials and laws, the inputs
    /// that its file declares, and further columns that state a quantity ([`Quantity::input`]). A group may have no
    /// value for some impacts: a solid has no surface tension.
    pub fn groups_known(&self, stated: &[&str]) -> Vec<usize> {
        let known = |group: &GroupInfo| group.needs.iter().all(|need| self.knows(*need, stated));
        GROUPS.iter().enumerate().filter(|(_, group)| known(group)).map(|(place, _)| place).collect()
    }

    /// Whether a quantity is known for some impacts at least.
    fn knows(&self, quantity: Quantity, stated: &[&str]) -> bool {
        let by_input = |name| stated.contains(&name) || self.declared_number(name).is_some();
        quantity.input().is_some_and(by_input) || self.gives(quantity)
    }

    /// Whether materials and laws give a quantity for some impacts at least.
    fn gives(&self, quantity: Quantity) -> bool {
        let liquid = self.particle.melting();
        let has = |key: &str| liquid.property(key).is_some();
        match quantity {
            Quantity::Density | Quantity::NormalRestitution | Quantity::Friction => true,
            Quantity::Viscosity => {
                // A law for a composition has a viscosity at every temperature.
                let by_law = |hot| self.stickiness.as_ref().and_then(|one| one.liquid_viscosity(hot));
                has("viscosity") || by_law(HOT).is_some()
            }
            Quantity::SurfaceTension => liquid.surface_tension_near(HOT).is_some(),
            Quantity::StickingVelocity => self.normal.has_sticking_velocity(),
            Quantity::YieldVelocity => self.normal.is_contact_law(),
            Quantity::MeltingPoint => has("melting_point"),
            Quantity::ReferenceViscosity => {
                let mut criteria = self.stickiness.iter();
                criteria.any(|criterion| criterion.reference_viscosity(&Impact::default()).is_some())
            }
            Quantity::FilmViscosity => {
                let stated = self.terms.iter().any(|term| term.effect().film_viscosity().is_some());
                stated || self.stickiness.is_some() || self.walls.iter().any(|wall| wall.slag.is_some())
            }
            Quantity::GasViscosity => false,
        }
    }

    /// Why a correction or a range cannot use a group, with the remedy; `None` for one that it can.
    pub(super) fn lacks(&self, group: CurveInput) -> Option<String> {
        let CurveInput::Group(place) = group else { return None };
        let info = GROUPS.get(place)?;
        let need = info.needs.iter().find(|need| !self.knows(**need, &[]))?;
        let (name, what) = (info.name, need.words());
        Some(format!("the group {name} needs {what}, which this file does not give; {}", need.remedy()))
    }

    /// The value of an input or a group for an impact on the wall with index `wall`, in its unit; NaN where it has
    /// none. `e_n` before corrections is that of random numbers at their median, 0.5.
    ///
    /// # Errors
    /// [`ImpactError`] for an impact that cannot be, or a wall that the model does not have; for a group that needs
    /// `e_n` as [`Model::resolve`].
    pub fn group_value(&self, wall: usize, impact: &Impact, input: CurveInput) -> Result<f64, ImpactError> {
        let mut reaching = *impact;
        let of = self.at_wall(wall, &mut reaching)?;
        let needs = |place: usize| GROUPS.get(place).map_or(&[][..], |group| group.needs);
        let by_rebound = match input {
            CurveInput::Group(place) => needs(place).contains(&Quantity::NormalRestitution),
            _ => false,
        };
        let mut before = RestitutionBefore(f64::NAN);
        if by_rebound {
            self.evaluate(wall, impact, |_| 0.5, &mut before)?;
        }
        let RestitutionBefore(normal_restitution) = before;
        Ok(input.value(&ImpactOnWall { model: self, wall: of, impact: &reaching, normal_restitution }))
    }
}

/// A temperature [K] at which ashes and metals are liquid; only whether there is a law is asked.
const HOT: f64 = 2000.0;

/// Keeps `e_n` [1] before fitted corrections.
struct RestitutionBefore(f64);

impl Watcher<'_> for RestitutionBefore {
    fn before_corrections(&mut self, normal_restitution: f64) {
        self.0 = normal_restitution;
    }
}
