//! The deposit: what earlier particles left on a piece of wall, and its growth.
//!
//! A solver keeps one [`Deposit`] for each piece of wall. Within a time step it sums captured
//! particles in a [`DepositSource`] ([`Model::add_captured`]) and adds the sum at the end of the
//! step ([`Deposit::with`]); the sum does not depend on the order of the particles.
//! [`Model::apply_deposit`] sets the inputs of an impact from the deposit.
//!
//! A particle that stays is **molten** when the surface is hotter than its material is solid, and
//! **powder** otherwise: a frozen droplet, or char that encloses its ash. What lies where stands in
//! `layers.rs`. The carbon of powder burns off where the solver asks for it ([`burn_off`]; `simulate`
//! does). [`Model::advance`] lets a deposit melt and freeze, sinter, leave with the gas and fall off
//! over a time step, by the table [`PROCESSES`].
//!
//! [`Model::add_captured`]: crate::Model::add_captured
//! [`Model::apply_deposit`]: crate::Model::apply_deposit
//! [`Model::advance`]: crate::Model::advance

pub mod burn_off;
pub mod conduction;
pub mod conductivity;
pub mod cover;
pub mod front;
pub mod layers;
mod melting;
pub mod process;
pub mod resuspension;
mod shedding;
pub(crate) mod sintering;
pub mod vapour_condensation;
mod wall_processes;
pub mod wetting;

use crate::slag::Molten;
use layers::Layers;
pub use process::{ProcessInfo, StepHeat, Surroundings, VapourSide, VoidGas, WallCooling, WallGas};
pub use wall_processes::{Losses, PROCESS_COUNT, PROCESSES, WallProcesses};

/// Properties of the melt on a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallMelt {
    /// Density [kg/m³].
    pub density: f64,
    /// Viscosity [Pa s]; infinite where it is stiff or frozen, or the model has none.
    pub viscosity: f64,
    /// Surface tension [N/m]; `None` for a material without one.
    pub surface_tension: Option<f64>,
}

impl WallMelt {
    /// Its properties with the surface tension, where it has one.
    pub fn molten(&self) -> Option<Molten> {
        let Self { density, viscosity, .. } = *self;
        self.surface_tension.map(|surface_tension| Molten { density, viscosity, surface_tension })
    }
}

/// Deposit on a piece of wall, per area of that wall.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Deposit {
    /// Mass of molten slag [kg/m²].
    pub molten: f64,
    /// Mass of powder [kg/m²], inner and outer.
    pub powder: f64,
    /// Volume of the powder's particles without the voids between them [m³/m²].
    pub solid: f64,
    /// Projected area of the powder's particles [1], overlaps counted.
    pub cover: f64,
    /// Mean carbon conversion by mass [1].
    pub conversion: f64,
    /// Volume of the powder's voids that sintering has closed [m³/m²].
    pub closed: f64,
    /// Share of the outer powder that landed and has left with the gas [1] ([`resuspension`]).
    pub resuspended: f64,
    /// Mass of frozen slag [kg/m²].
    pub frozen: f64,
    /// Share of the powder that slag has enclosed [1]: the inner powder, of its mass, volume and
    /// projected area alike.
    pub behind: f64,
}

/// A part of the powder of a deposit, per area of wall.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Powder {
    /// Mass [kg/m²].
    pub mass: f64,
    /// Volume of the particles [m³/m²].
    pub solid: f64,
    /// Projected area of the particles [1].
    pub cover: f64,
    /// Volume of the voids that sintering has closed [m³/m²].
    pub closed: f64,
}

impl Powder {
    /// A share of it [1].
    #[must_use]
    pub fn times(self, share: f64) -> Self {
        let Self { mass, solid, cover, closed } = self;
        Self { mass: mass * share, solid: solid * share, cover: cover * share, closed: closed * share }
    }
}

/// Sum of captured particles on a piece of wall, per area of that wall.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DepositSource {
    /// Molten mass [kg/m²].
    pub molten: f64,
    /// Mass of powder [kg/m²].
    pub powder: f64,
    /// Volume of the powder's particles [m³/m²].
    pub solid: f64,
    /// Projected area of the powder's particles [1].
    pub cover: f64,
    /// Area that the molten particles cover once they have spread [1].
    pub buried: f64,
    /// Mass times carbon conversion [kg/m²].
    pub converted: f64,
}

/// Captured particles of one kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CapturedParticles {
    /// Their mass per area of wall [kg/m²].
    pub mass: f64,
    /// Density of the particles [kg/m³].
    pub density: f64,
    /// Their diameter [m].
    pub diameter: f64,
    /// Their carbon conversion [1].
    pub conversion: f64,
    /// Whether they are molten at the wall's temperature.
    pub molten: bool,
}

impl DepositSource {
    /// The sum with further particles. Spheres of diameter `d`, density `rho` and mass `m` on an
    /// area have a projected area of `3 m/(2 rho d)` on it.
    #[must_use]
    pub fn with(self, arrival: &CapturedParticles) -> Self {
        let CapturedParticles { mass, density, diameter, conversion, molten } = *arrival;
        let area = 1.5 * mass / (density * diameter);
        let converted = self.converted + mass * conversion;
        if molten {
            let buried = self.buried + area * wetting::SPREAD * wetting::SPREAD;
            Self { molten: self.molten + mass, buried, converted, ..self }
        } else {
            let solid = self.solid + mass / density;
            Self { powder: self.powder + mass, solid, cover: self.cover + area, converted, ..self }
        }
    }
}

impl Deposit {
    /// Total mass [kg/m²].
    pub fn mass(&self) -> f64 {
        self.slag() + self.powder
    }

    /// Mass of slag [kg/m²], frozen and molten.
    pub fn slag(&self) -> f64 {
        self.frozen + self.molten
    }

    /// Share of the powder that is inner powder [1]: none without slag.
    pub fn enclosed(&self) -> f64 {
        if self.slag() > 0.0 { self.behind } else { 0.0 }
    }

    /// The masses of its layers [kg/m²].
    pub fn layers(&self) -> Layers<f64> {
        let inner_powder = self.powder * self.enclosed();
        let outer_powder = self.powder - inner_powder;
        Layers { inner_powder, frozen: self.frozen, molten: self.molten, outer_powder }
    }

    /// The deposit with other masses of its layers [kg/m²]: powder keeps its size, density and voids.
    #[must_use]
    pub fn with_layers(self, layers: Layers<f64>) -> Self {
        let Layers { inner_powder, frozen, molten, outer_powder } = layers;
        let powder = inner_powder + outer_powder;
        let left = if self.powder > 0.0 { powder / self.powder } else { 1.0 };
        let [solid, cover, closed] = [self.solid, self.cover, self.closed].map(|of| of * left);
        let enclosed = if powder > 0.0 { inner_powder / powder } else { 0.0 };
        let behind = if frozen + molten > 0.0 { enclosed.min(1.0) } else { 0.0 };
        Self { molten, frozen, powder, solid, cover, closed, behind, ..self }
    }

    /// Its inner and its outer powder.
    pub fn powders(&self) -> [Powder; 2] {
        let Self { powder: mass, solid, cover, closed, .. } = *self;
        let (all, enclosed) = (Powder { mass, solid, cover, closed }, self.enclosed());
        [all.times(enclosed), all.times(1.0 - enclosed)]
    }

    /// The deposit with other powder, inner and outer.
    #[must_use]
    pub fn with_powders(self, [inner, outer]: [Powder; 2]) -> Self {
        let powder = inner.mass + outer.mass;
        let behind = if powder > 0.0 && self.slag() > 0.0 { (inner.mass / powder).min(1.0) } else { 0.0 };
        let [solid, cover, closed] =
            [inner.solid + outer.solid, inner.cover + outer.cover, inner.closed + outer.closed];
        Self { powder, solid, cover, closed, behind, ..self }
    }

    /// The deposit after captured particles were added, in the order of `layers.rs`. Nothing melts or
    /// freezes here: powder that melt buries becomes inner powder.
    #[must_use]
    pub fn with(self, arrivals: &DepositSource) -> Self {
        let mass = self.mass() + arrivals.molten + arrivals.powder;
        if mass <= 0.0 {
            return self;
        }
        let (outer, all) = (self.cover * (1.0 - self.enclosed()), self.cover + arrivals.cover);
        let left = layers::grown_cover(outer, arrivals.cover, arrivals.buried);
        let powder = self.powder + arrivals.powder;
        let conversion = (self.mass() * self.conversion + arrivals.converted) / mass;
        let [resting, landed] = [self.layers().outer_powder, self.layers().outer_powder + arrivals.powder];
        let gone =
            if self.resuspended < 1.0 { resting * self.resuspended / (1.0 - self.resuspended) } else { 0.0 };
        let molten = self.molten + arrivals.molten;
        let encloses = molten + self.frozen > 0.0 && all > 0.0;
        Self {
            molten,
            powder,
            solid: self.solid + arrivals.solid,
            cover: all,
            conversion: conversion.clamp(0.0, 1.0),
            resuspended: if landed > 0.0 { gone / (landed + gone) } else { 0.0 },
            behind: if encloses { (1.0 - left / all).clamp(0.0, 1.0) } else { 0.0 },
            ..self
        }
    }

    /// Share of the wall that the outer powder covers [1].
    pub fn coverage(&self) -> f64 {
        cover::share(self.cover * (1.0 - self.enclosed()))
    }

    /// Thickness of the powder [m], evenly spread, with `voidage` [1] the share of voids in it: 0.5
    /// is a usual assumption, between 0.4 of a dense random packing and the higher values of loose
    /// cohesive powder.
    pub fn layer_thickness(&self, voidage: f64) -> f64 {
        (self.solid / (1.0 - voidage) - self.closed).max(self.solid)
    }

    /// Share of voids in the powder [1], with `voidage` that of fresh powder.
    pub fn porosity(&self, voidage: f64) -> f64 {
        let thickness = self.layer_thickness(voidage);
        if thickness > 0.0 { 1.0 - self.solid / thickness } else { voidage }
    }

    /// Diameter of spheres with the powder's volume and projected area [m]; 0 without powder.
    pub fn powder_diameter(&self) -> f64 {
        if self.cover > 0.0 { 1.5 * self.solid / self.cover } else { 0.0 }
    }

    /// The deposit with its inner and its outer powder sintered to porosities [1], each if that is less
    /// than it has. Both then have the porosity of their mean.
    #[must_use]
    pub fn sintered(self, voidage: f64, porosities: [f64; 2]) -> Self {
        let closed = |porosity: f64| self.solid / (1.0 - voidage) - self.solid / (1.0 - porosity);
        let [inner, outer] = porosities.map(|porosity| closed(porosity).max(self.closed));
        let enclosed = self.enclosed();
        Self { closed: inner * enclosed + outer * (1.0 - enclosed), ..self }
    }

    /// The deposit after the gas carried a share of its outer powder [1] away.
    #[must_use]
    pub fn blown(self, share: f64) -> Self {
        let (left, [inner, outer]) = (1.0 - share, self.powders());
        Self { resuspended: 1.0 - (1.0 - self.resuspended) * left, ..self }
            .with_powders([inner, outer.times(left)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const CHAR: CapturedParticles =
        CapturedParticles { mass: 2e-3, density: 800.0, diameter: 60e-6, conversion: 0.3, molten: false };
    const MELT: CapturedParticles =
        CapturedParticles { mass: 5e-3, density: 2500.0, diameter: 40e-6, conversion: 0.98, molten: true };

    /// The projected area and the volume of spheres, counted: N pi d²/4 and N pi d³/6.
    #[test]
    fn spheres_bring_their_projected_area_and_volume() {
        let number = CHAR.mass / (CHAR.density * std::f64::consts::PI / 6.0 * CHAR.diameter.powi(3));
        let arrivals = DepositSource::default().with(&CHAR);
        assert_relative_eq!(
            arrivals.cover,
            number * std::f64::consts::PI / 4.0 * CHAR.diameter.powi(2),
            max_relative = 1e-14
        );
        let deposit = Deposit::default().with(&arrivals);
        let volume = number * std::f64::consts::PI / 6.0 * CHAR.diameter.powi(3);
        assert_relative_eq!(deposit.layer_thickness(0.5), 2.0 * volume, max_relative = 1e-14);
        assert_relative_eq!(deposit.coverage(), 1.0 - (-arrivals.cover).exp(), max_relative = 1e-12);
    }

    #[test]
    fn mass_and_converted_mass_are_kept_and_the_order_within_a_step_does_not_count() {
        let mut deposit = Deposit {
            molten: 0.1,
            powder: 0.02,
            solid: 3e-5,
            cover: 0.7,
            conversion: 0.5,
            ..Deposit::default()
        };
        let before = deposit;
        let (mut mass, mut converted) = (before.mass(), before.mass() * before.conversion);
        for step in 0..40 {
            let [one, other] = if step % 3 == 0 { [CHAR, MELT] } else { [CHAR, CHAR] };
            let forth = DepositSource::default().with(&one).with(&other);
            let back = DepositSource::default().with(&other).with(&one);
            assert_eq!(deposit.with(&forth), deposit.with(&back));
            deposit = deposit.with(&forth);
            mass += one.mass + other.mass;
            converted += one.mass * one.conversion + other.mass * other.conversion;
            assert_relative_eq!(deposit.mass(), mass, max_relative = 1e-13);
            assert_relative_eq!(deposit.mass() * deposit.conversion, converted, max_relative = 1e-12);
        }
        assert!(deposit.cover > before.cover && deposit.solid > before.solid);
    }

    /// Melt spreads to twice its diameter and buries what lies there: by hand, thin cover decays as
    /// exp(-4 b) with the projected area `b` of the melt. The mass stays powder, now below the melt.
    #[test]
    fn melt_buries_the_powder_under_it_and_melts_nothing() {
        let thin = CapturedParticles { mass: 2e-8, ..CHAR };
        let dusty = Deposit::default().with(&DepositSource::default().with(&thin));
        let after = dusty.with(&DepositSource::default().with(&MELT));
        let area = 1.5 * MELT.mass / (MELT.density * MELT.diameter);
        assert_relative_eq!(1.0 - after.behind, (-4.0 * area).exp(), max_relative = 1e-5);
        assert_eq!((after.powder, after.solid, after.molten), (dusty.powder, dusty.solid, MELT.mass));
        // Powder that lands later lies outside, and what was enclosed stays enclosed.
        let later = after.with(&DepositSource::default().with(&CHAR));
        assert_relative_eq!(later.layers().inner_powder, after.layers().inner_powder, max_relative = 1e-9);
        // Without slag nothing is enclosed.
        assert_eq!(Deposit { molten: 0.0, ..after }.with_layers(dusty.layers()).behind, 0.0);
        // A bare wall stays as it is when nothing arrives.
        assert_eq!(Deposit::default().with(&DepositSource::default()), Deposit::default());
    }
}
