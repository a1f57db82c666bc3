//! In which order a deposit lies on a wall: the only file that says it.
//!
//! From the wall outwards ([`Layers`]):
//!
//! 1. **inner powder**, which slag has enclosed;
//! 2. **frozen slag**, below the temperature at which it is solid;
//! 3. **molten slag**;
//! 4. **outer powder**, which lies on the slag as islands, or on the wall.
//!
//! Without slag all powder is outer powder.
//!
//! - **Arrival**: powder lands on the outside, molten particles on the slag. They bury the outer powder
//!   that they spread over ([`grown_cover`]); what is buried becomes inner powder, with its mass. It
//!   melts there if it is hot enough, by heat ([`super::front`]).
//! - **Front**: one front separates what is solid (1, 2) from molten slag (3). Melting takes frozen slag
//!   first, then inner powder; freezing adds frozen slag. Outer powder whose outside is hotter than it
//!   melts becomes inner powder, so that its melt lies outside of what stays solid. *Assumed*: frozen
//!   slag that lies below such powder changes places with it; the thermal resistances in series are
//!   the same.
//! - **Impacts** meet outer powder on the share that it covers ([`covered`]), elsewhere slag, or inner
//!   powder and the wall where slag is too thin to cover them ([`bare`]).

use super::{cover, wetting};
use crate::impact::Impact;

/// One value for each layer of a deposit.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Layers<T> {
    /// Of powder that slag has enclosed.
    pub inner_powder: T,
    /// Of slag that is solid.
    pub frozen: T,
    /// Of slag that is liquid.
    pub molten: T,
    /// Of powder on the outside.
    pub outer_powder: T,
}

impl<T> Layers<T> {
    /// The values from the wall outwards.
    pub fn outwards(self) -> [T; 4] {
        [self.inner_powder, self.frozen, self.molten, self.outer_powder]
    }

    /// The values of [`Self::outwards`].
    pub fn from_outwards([inner_powder, frozen, molten, outer_powder]: [T; 4]) -> Self {
        Self { inner_powder, frozen, molten, outer_powder }
    }
}

/// What an impact meets where powder covers the wall: neither film nor melt. The layer there is thicker
/// than its mean over the wall, `h/c`.
#[inline]
pub(crate) fn covered(impact: &Impact) -> Impact {
    let spread = if impact.coverage > 0.0 { 1.0 / impact.coverage } else { 1.0 };
    Impact {
        coverage: 1.0,
        layer_thickness: impact.layer_thickness * spread,
        film_thickness: 0.0,
        melt_thickness: 0.0,
        ..*impact
    }
}

/// What an impact meets between the powder.
#[inline]
pub(crate) fn bare(impact: &Impact) -> Impact {
    Impact { coverage: 0.0, layer_thickness: 0.0, ..*impact }
}

/// Projected area of outer powder [1] after `landed` of powder and `buried` of spread melt [both 1] have
/// arrived on `before` [1].
pub(super) fn grown_cover(before: f64, landed: f64, buried: f64) -> f64 {
    cover::after(before, landed, buried).min(before + landed)
}

/// Share of the wall [1] on which impacts meet powder, and the mean thickness of that powder over the
/// wall [m]: the outer powder, and the inner powder where slag does not cover it. From the covered shares
/// [1] and the thicknesses [m] of outer and inner powder, and the thickness of the slag [m] with the
/// diameter [m] of what arrives.
pub(crate) fn powder_met(
    [outer, inner]: [f64; 2],
    [outer_thickness, inner_thickness]: [f64; 2],
    slag: f64,
    diameter: f64,
) -> [f64; 2] {
    let dry = 1.0 - wetting::share(slag, diameter);
    [outer + (1.0 - outer) * inner * dry, outer_thickness + inner_thickness * dry]
}
