//! Rebound of a dry particle from molten slag, derived here; *assumed* in this form.
//!
//! A sphere of radius `R = d/2` crosses a flat surface with the free energy
//! `F(h) = pi sigma (h² - 2 R h (1 + cos theta))`, `h` [m] the depth to which it is wetted and
//! `theta` [rad] the contact angle through the slag. It rests at `h = R (1 + cos theta)`.
//!
//! - Stokes' drag along one diameter takes the speed `18 mu/(rho d)`, once inwards and once outwards.
//! - The particle sinks when the energy after the way in reaches the work of submerging from the rest
//!   position, `pi R² sigma (1 - cos theta)²`.
//! - It leaves when the energy after the way out exceeds `pi R² sigma (1 + cos theta)²`, the free
//!   energy `-F` of the rest position. Otherwise surface tension holds it.
//!
//! `d` [m] and `rho` [kg/m³] of the particle; `sigma` [N/m] and `mu` [Pa s] of the slag. Valid for
//! smooth spheres that are small against the capillary length `sqrt(sigma/(rho_s g))`, some 4 mm for
//! slag, and against the layer's thickness. Neglected: slag entering porous char, a contact angle
//! that falls by reaction, added mass, solid slag. The result depends strongly on `theta`: slag is
//! called highly non-wetting on char (AIChE J. 62 (2016) 659, abstract), and wets graphite poorly at
//! first, better as it reacts (Mater. Chem. Phys. 2009, a Mn-Ti-silicate slag, abstract).

/// Normal restitution [1] of a particle on slag, 0 for one that stays: from its diameter [m], density
/// [kg/m³] and speed towards the slag [m/s], the slag's viscosity [Pa s] and surface tension [N/m],
/// and the cosine of the contact angle [1]. Without branches, for vectors.
#[inline(always)]
pub(crate) fn rebound_from_slag(
    [diameter, density, normal_speed]: [f64; 3],
    [viscosity, surface_tension]: [f64; 2],
    cosine: f64,
) -> f64 {
    // Speeds: drag along one diameter takes `18 mu/(rho d)`, a work `pi R² sigma x²` leaves `v² - 3 sigma x²/(rho d)`.
    let size = 1.0 / (density * diameter);
    let drag = 18.0 * viscosity * size;
    let squared = |part: f64| 3.0 * surface_tension * (part * part) * size;
    let inwards = at_least_zero(normal_speed - drag);
    let outwards = at_least_zero(2.0 * inwards - normal_speed);
    let left = outwards * outwards - squared(1.0 + cosine);
    let leaves = (inwards * inwards < squared(1.0 - cosine)) & (left > 0.0);
    let e_n = at_least_zero(left).sqrt() / normal_speed;
    if leaves { e_n } else { 0.0 }
}

/// Whether the slag draws such a particle in; arguments as of [`rebound_from_slag`].
pub(crate) fn sinks_into_slag(
    [diameter, density, normal_speed]: [f64; 3],
    [viscosity, surface_tension]: [f64; 2],
    cosine: f64,
) -> bool {
    let size = 1.0 / (density * diameter);
    let inwards = at_least_zero(normal_speed - 18.0 * viscosity * size);
    inwards * inwards >= 3.0 * surface_tension * (1.0 - cosine) * (1.0 - cosine) * size
}

#[inline(always)]
fn at_least_zero(speed: f64) -> f64 {
    if speed > 0.0 { speed } else { 0.0 }
}
