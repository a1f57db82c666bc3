//! Dimensionless groups of an impact, as inputs of fitted corrections. One row of [`GROUPS`] a group.
//!
//! A new group is a row of the table; model files, the C library and OpenFOAM then know it, and tests
//! demand its row in the documents. What a group is computed from is a [`Quantity`]; a model gives it
//! for an impact on a wall ([`Circumstances`]). Density, viscosity and surface tension are, in this
//! order, those that the impact states (`rho_p`, or an input that the model file declares: `mu_p`,
//! `sigma_p`) and those of the particle's material at its temperature. A solid has no surface tension.
//! A group that cannot be computed for an impact is not a number, and what depends on it does not act.
//!
//! A model file may declare further groups as products of powers of inputs ([`ProductGroup`]).

mod product;
mod quantity;

pub(crate) use product::read_products;
pub use product::{ProductGroup, ProductInput};
pub use quantity::{Circumstances, Quantity};

use crate::impact::ExtraInput;
use Quantity::{
    Density, FilmViscosity, Friction, GasViscosity, MeltingPoint, NormalRestitution, ReferenceViscosity,
    StickingVelocity, SurfaceTension, Viscosity, YieldVelocity,
};

/// Standard acceleration of gravity [m/s²] (CGPM 1901).
const GRAVITY: f64 = 9.80665;

const TEXTBOOK: &str = "textbook definition";

/// A dimensionless group.
#[derive(Debug)]
pub struct GroupInfo {
    /// Its name in model files and reports.
    pub name: &'static str,
    /// Its name in words.
    pub words: &'static str,
    /// Its formula, in the names of inputs and quantities.
    pub formula: &'static str,
    /// What it needs beside the inputs of every impact.
    pub needs: &'static [Quantity],
    /// Where its definition comes from.
    pub source: &'static str,
    /// Its value [1]; not finite where it has none.
    value: fn(&dyn Circumstances) -> f64,
}

impl GroupInfo {
    /// Its value [1] for an impact; NaN where it has none.
    pub fn value(&self, of: &dyn Circumstances) -> f64 {
        finite((self.value)(of))
    }

    /// The place in [`GROUPS`] of the group of this name.
    pub fn place(name: &str) -> Option<usize> {
        GROUPS.iter().position(|group| group.name == name)
    }
}

/// Every built-in group.
pub static GROUPS: [GroupInfo; 15] = [
    GroupInfo {
        name: "We",
        words: "Weber number: kinetic energy over surface energy",
        formula: "rho_p v_n^2 d/sigma_p",
        needs: &[Density, SurfaceTension],
        source: TEXTBOOK,
        value: weber,
    },
    GroupInfo {
        name: "Oh",
        words: "Ohnesorge number: viscosity against inertia and surface tension, at any speed",
        formula: "mu_p/sqrt(rho_p sigma_p d)",
        needs: &[Density, Viscosity, SurfaceTension],
        source: TEXTBOOK,
        value: |of| {
            of.quantity(Viscosity)
                / (of.quantity(Density) * of.quantity(SurfaceTension) * of.impact().diameter).sqrt()
        },
    },
    GroupInfo {
        name: "Re",
        words: "Reynolds number of the particle's liquid: inertia over viscosity",
        formula: "rho_p v_n d/mu_p",
        needs: &[Density, Viscosity],
        source: TEXTBOOK,
        value: reynolds,
    },
    GroupInfo {
        name: "Ca",
        words: "capillary number: viscosity over surface tension",
        formula: "mu_p v_n/sigma_p",
        needs: &[Viscosity, SurfaceTension],
        source: TEXTBOOK,
        value: |of| of.quantity(Viscosity) * of.impact().normal_speed / of.quantity(SurfaceTension),
    },
    GroupInfo {
        name: "Bo",
        words: "Bond number: weight over surface tension",
        formula: "rho_p g d^2/sigma_p, g = 9.80665 m/s2",
        needs: &[Density, SurfaceTension],
        source: TEXTBOOK,
        value: |of| {
            let diameter = of.impact().diameter;
            of.quantity(Density) * GRAVITY * diameter * diameter / of.quantity(SurfaceTension)
        },
    },
    GroupInfo {
        name: "K",
        words: "splashing number of Mundo et al.",
        formula: "We^(1/2) Re^(1/4)",
        needs: &[Density, Viscosity, SurfaceTension],
        source: "Mundo, Sommerfeld & Tropea, Int. J. Multiphase Flow 21 (1995) 151 (not re-read)",
        value: |of| weber(of).sqrt() * reynolds(of).sqrt().sqrt(),
    },
    GroupInfo {
        name: "v_n/v_s",
        words: "speed towards the wall over the sticking velocity of the normal law",
        formula: "v_n/v_s",
        needs: &[StickingVelocity],
        source: TEXTBOOK,
        value: |of| of.impact().normal_speed / of.quantity(StickingVelocity),
    },
    GroupInfo {
        name: "v_n/v_y",
        words: "speed towards the wall over the yield velocity of the normal law",
        formula: "v_n/v_y",
        needs: &[YieldVelocity],
        source: TEXTBOOK,
        value: |of| of.impact().normal_speed / of.quantity(YieldVelocity),
    },
    GroupInfo {
        name: "tan_alpha",
        words: "tangent of the effective impact angle, from the normal: a rigid sphere slides throughout from 7",
        formula: "2 v_t/((1 + e_n) f v_n), e_n before corrections, f the friction coefficient or 1",
        needs: &[NormalRestitution, Friction],
        source: "normalised impact angle of Wu, Thornton & Li, Adv. Powder Technol. 14 (2003) 435 (not re-read)",
        value: |of| {
            let impulse = (1.0 + of.quantity(NormalRestitution)) * of.impact().normal_speed;
            2.0 * of.impact().tangential_speed / (of.quantity(Friction) * impulse)
        },
    },
    GroupInfo {
        name: "T_p/T_melt",
        words: "temperature of the particle over its melting point",
        formula: "T_p/T_melt",
        needs: &[MeltingPoint],
        source: TEXTBOOK,
        value: |of| of.impact().particle_temperature / of.quantity(MeltingPoint),
    },
    GroupInfo {
        name: "mu/mu_ref",
        words: "viscosity of the particle over that at and below which every impact sticks",
        formula: "mu_p/mu_ref",
        needs: &[Viscosity, ReferenceViscosity],
        source: "Walsh et al. 1990, as the capture criterion `viscosity`",
        value: |of| of.quantity(Viscosity) / of.quantity(ReferenceViscosity),
    },
    GroupInfo {
        name: "layer/d",
        words: "thickness of the powder layer over the particle's diameter",
        formula: "layer_thickness/d",
        needs: &[],
        source: TEXTBOOK,
        value: |of| of.impact().layer_thickness / of.impact().diameter,
    },
    GroupInfo {
        name: "film/d",
        words: "thickness of the liquid film over the particle's diameter",
        formula: "film_thickness/d",
        needs: &[],
        source: TEXTBOOK,
        value: |of| of.impact().film_thickness / of.impact().diameter,
    },
    GroupInfo {
        name: "St_film",
        words: "Stokes number of the liquid film: inertia over its drag",
        formula: "rho_p d v_n/(9 mu_film)",
        needs: &[Density, FilmViscosity],
        source: "Davis, Rager & Good, J. Fluid Mech. 468 (2002) 107, as the effect `liquid-film`",
        value: |of| stokes(of, FilmViscosity),
    },
    GroupInfo {
        name: "St_gas",
        words: "Stokes number of the gas: inertia over its drag",
        formula: "rho_p d v_n/(9 mu_gas)",
        needs: &[Density, GasViscosity],
        source: "impacts on walls in a fluid, Joseph et al., J. Fluid Mech. 433 (2001) 329 (abstract)",
        value: |of| stokes(of, GasViscosity),
    },
];

fn weber(of: &dyn Circumstances) -> f64 {
    let speed = of.impact().normal_speed;
    of.quantity(Density) * speed * speed * of.impact().diameter / of.quantity(SurfaceTension)
}

fn reynolds(of: &dyn Circumstances) -> f64 {
    of.quantity(Density) * of.impact().normal_speed * of.impact().diameter / of.quantity(Viscosity)
}

/// `rho d v_n/(9 mu)` with the viscosity of what surrounds the particle.
fn stokes(of: &dyn Circumstances, viscosity: Quantity) -> f64 {
    of.quantity(Density) * of.impact().diameter * of.impact().normal_speed / (9.0 * of.quantity(viscosity))
}

/// A number that is finite, else NaN.
fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { f64::NAN }
}

/// What a model file declares: inputs that no law knows, and groups.
#[derive(Debug, Clone, Copy, Default)]
pub struct Declared<'a> {
    /// Inputs, by place in [`Impact::extra`](crate::Impact::extra).
    pub inputs: &'a [ExtraInput],
    /// Groups, products of powers of inputs.
    pub products: &'a [ProductGroup],
}
