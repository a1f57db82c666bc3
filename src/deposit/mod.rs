//! The deposit: what earlier particles left on a piece of wall, and its growth.
//!
//! A solver keeps one [`Deposit`] for each piece of wall. Within a time step it sums captured
//! particles in a [`DepositSource`] ([`Model::add_captured`]) and adds the sum at the end of the
//! step ([`Deposit::with`]); the sum does not depend on the order of the particles.
//! [`Model::apply_deposit`] sets the inputs of an impact from the deposit.
//!
//! A particle that stays is **molten** when it is sticky at the temperature of the wall, and
//! **powder** otherwise: a frozen droplet, or char that encloses its ash. Its carbon burns off
//! where the solver asks for it ([`burn_off`]; `simulate` does). [`Model::advance`] lets a deposit
//! melt, sinter, leave with the gas and fall off over a time step, by the table [`PROCESSES`]. Melt
//! on a wall that cools later is stiff by its viscosity.
//!
//! [`Model::add_captured`]: crate::Model::add_captured
//! [`Model::apply_deposit`]: crate::Model::apply_deposit
//! [`Model::advance`]: crate::Model::advance

pub mod burn_off;
pub mod conduction;
pub mod conductivity;
pub mod cover;
pub(crate) mod layers;
mod melting;
pub mod process;
pub mod resuspension;
mod shedding;
pub(crate) mod sintering;
mod wall_processes;
pub mod wetting;

use crate::slag::Molten;
pub use process::{ProcessInfo, Surroundings, WallGas};
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
    /// Molten mass [kg/m²].
    pub molten: f64,
    /// Mass of powder [kg/m²].
    pub powder: f64,
    /// Volume of the powder's particles without the voids between them [m³/m²].
    pub solid: f64,
    /// Projected area of the powder's particles [1], overlaps counted.
    pub cover: f64,
    /// Mean carbon conversion by mass [1].
    pub conversion: f64,
    /// Volume of the powder's voids that sintering has closed [m³/m²].
    pub closed: f64,
    /// Share of the powder that landed and has left with the gas [1] ([`resuspension`]).
    pub resuspended: f64,
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
    /// Projected area of the molten particles [1].
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
            Self { molten: self.molten + mass, buried: self.buried + area, converted, ..self }
        } else {
            let solid = self.solid + mass / density;
            Self { powder: self.powder + mass, solid, cover: self.cover + area, converted, ..self }
        }
    }
}

impl Deposit {
    /// Total mass [kg/m²].
    pub fn mass(&self) -> f64 {
        self.molten + self.powder
    }

    /// The deposit after captured particles were added. Powder that melt buries becomes part of the melt.
    #[must_use]
    pub fn with(self, arrivals: &DepositSource) -> Self {
        let mass = self.mass() + arrivals.molten + arrivals.powder;
        if mass <= 0.0 {
            return self;
        }
        let all = self.cover + arrivals.cover;
        let cover = layers::grown_cover(self.cover, arrivals.cover, arrivals.buried);
        let left = if all > 0.0 { cover / all } else { 1.0 };
        let powder = self.powder + arrivals.powder;
        let conversion = (self.mass() * self.conversion + arrivals.converted) / mass;
        let gone = if self.powder > 0.0 && self.resuspended < 1.0 {
            self.powder * self.resuspended / (1.0 - self.resuspended)
        } else {
            0.0
        };
        Self {
            molten: self.molten + arrivals.molten + powder * (1.0 - left),
            powder: powder * left,
            solid: (self.solid + arrivals.solid) * left,
            cover,
            conversion: conversion.clamp(0.0, 1.0),
            closed: self.closed * left,
            resuspended: if powder > 0.0 { gone / (powder + gone) } else { 0.0 },
        }
    }

    /// Share of the wall that the powder covers [1].
    pub fn coverage(&self) -> f64 {
        cover::share(self.cover)
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

    /// The deposit with its powder sintered to a porosity [1], if that is less than it has.
    #[must_use]
    pub fn sintered(self, voidage: f64, porosity: f64) -> Self {
        let closed = self.solid / (1.0 - voidage) - self.solid / (1.0 - porosity);
        Self { closed: closed.max(self.closed), ..self }
    }

    /// The deposit after a share of its powder [1] has melted.
    #[must_use]
    pub fn melted(self, share: f64) -> Self {
        Self { molten: self.molten + self.powder * share, ..self.with_powder_left(1.0 - share) }
    }

    /// The deposit after the gas carried a share of its powder [1] away.
    #[must_use]
    pub fn blown(self, share: f64) -> Self {
        let left = 1.0 - share;
        Self { resuspended: 1.0 - (1.0 - self.resuspended) * left, ..self.with_powder_left(left) }
    }

    fn with_powder_left(self, left: f64) -> Self {
        Self {
            powder: self.powder * left,
            solid: self.solid * left,
            cover: self.cover * left,
            closed: self.closed * left,
            ..self
        }
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

    #[test]
    fn melt_takes_powder_up_in_proportion_to_the_cover_it_buries() {
        let dusty = Deposit::default().with(&DepositSource::default().with(&CHAR));
        let after = dusty.with(&DepositSource::default().with(&MELT));
        let left = after.cover / dusty.cover;
        assert!(left < 1.0);
        assert_relative_eq!(after.powder, dusty.powder * left, max_relative = 1e-14);
        assert_relative_eq!(after.solid, dusty.solid * left, max_relative = 1e-14);
        assert_relative_eq!(after.molten, MELT.mass + dusty.powder * (1.0 - left), max_relative = 1e-14);
        // A bare wall stays as it is when nothing arrives.
        assert_eq!(Deposit::default().with(&DepositSource::default()), Deposit::default());
    }
}
