//! Which way round powder and melt lie on a wall: the only file that says it.
//!
//! Two statements stand here, and they contradict each other:
//!
//! - **Impacts and growth**: powder lies outside. It covers melt or wall as islands, which an impact
//!   meets first ([`covered`], [`bare`]); melt that arrives later buries it and takes it up
//!   ([`grown_cover`]).
//! - **Heat**: melt lies outside of all powder ([`outwards`], [`powder_sides`]). Melt flows above the
//!   temperature of critical viscosity, so it is assumed to end up outside of the colder powder.
//!
//! The first holds for thin powder on a slagging wall, the second for a thick deposit on a cooled one.

use super::cover;
use crate::impact::Impact;

/// What an impact meets where powder covers the wall: neither film nor melt.
#[inline]
pub(crate) fn covered(impact: &Impact) -> Impact {
    Impact { coverage: 1.0, film_thickness: 0.0, melt_thickness: 0.0, ..*impact }
}

/// What an impact meets between the powder.
#[inline]
pub(crate) fn bare(impact: &Impact) -> Impact {
    Impact { coverage: 0.0, layer_thickness: 0.0, ..*impact }
}

/// Projected area of powder [1] on the outside after `landed` of powder and `buried` of melt [both 1]
/// have arrived on `before` [1].
pub(super) fn grown_cover(before: f64, landed: f64, buried: f64) -> f64 {
    cover::after(before, landed, buried).min(before + landed)
}

/// Powder and melt as heat crosses them, from the wall outwards.
pub(crate) fn outwards<T>(powder: T, melt: T) -> [T; 2] {
    [powder, melt]
}

/// Temperatures [K] of the cold and the hot side of the powder, from those of the cold sides of the two
/// layers of [`outwards`] and of the surface.
pub(crate) fn powder_sides([first, second]: [f64; 2], _surface: f64) -> [f64; 2] {
    [first, second]
}
