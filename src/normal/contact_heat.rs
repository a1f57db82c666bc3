//! Heat that a particle gives to a wall while it touches it.
//!
//! `Q = (T_p - T_w) (Q_q^(4/3) + Q_s^(4/3))^(3/4)`, with what a touch conducts per kelvin
//! - if it is quick, of Fourier number `Fo = kappa t/a² << 1`: `Q_q = 0.871 pi a² sqrt(t)/(1/b_p + 1/b_w)`,
//!   `b = sqrt(k rho c)`. Every spot of the contact conducts as two half-spaces do for as long as it touches,
//!   `2 sqrt(tau/pi)/(1/b_p + 1/b_w)` (Carslaw & Jaeger), and 0.871 is the mean over the spots of Hertz' contact. Sun &
//!   Chen (Int. J. Heat Mass Transfer 31 (1988) 969) give 0.87; the paper was not read, the formula is that of two
//!   codes which cite it (Kratos, DEMLab). Where the particle flows plastically, it is 0.871 to 0.880;
//! - if it is slow, `Fo >> 1`: `Q_s = 4 <a> t k_p k_w/(k_p + k_w)`, the constriction of two half-spaces by a disc
//!   (Carslaw & Jaeger), `<a> = 0.754 a` the mean radius over Hertz' time of contact (plastic: up to 0.763).
//!
//! The power 4/3 joins the two limits as Churchill & Usagi (AIChE J. 18 (1972) 1121) do. Conduction integrated through
//! the growing and shrinking disc is met within 3 % for `Fo` from 0.003 to 30 and conductivities in a ratio of 0.03 to
//! 30 (`tests/library/contact_heat.rs` repeats some of it). The correction of Zhou, Yu & Horio (Chem. Eng. J. 139
//! (2008) 510), as those codes have it, is not used: of equal materials it gives 0.90 instead of 0.87 for `Fo` = 0, and
//! 2.1 instead of the integrated 3.5 for 10.
//!
//! `T` temperatures [K], `a` largest radius of the contact [m], `t` its duration [s] ([`touch`](super::touch)), `k`
//! conductivity [W/(m K)], `rho` density [kg/m³], `c` heat capacity [J/(kg K)], `kappa = k/(rho c)` [m²/s]. Valid for a
//! contact that is small against the particle, smooth and dry, without the gas in the gap around it. A sphere that
//! flattens plastically without piling up has up to 1.4 times Thornton's area. Heat of friction and of plastic flow is
//! left out.

use std::f64::consts::PI;

use super::Touch;

/// Mean over the area of Hertz' contact of `2 sqrt(tau/(pi t))`, `tau` the time for which a spot touches [1].
const QUICK: f64 = 0.870_926;
/// Four times the mean of the contact's radius over time, in its largest radius [1].
const SLOW: f64 = 3.016_506;
/// Power with which the limits are joined [1].
const POWER: f64 = 4.0 / 3.0;

/// Thermal properties of one of the two solids.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSpace {
    /// Density [kg/m³].
    pub density: f64,
    /// Heat capacity [J/(kg K)].
    pub heat_capacity: f64,
    /// Conductivity [W/(m K)].
    pub conductivity: f64,
}

impl HalfSpace {
    /// Effusivity `b` [W sqrt(s)/(m² K)].
    fn effusivity(&self) -> f64 {
        (self.conductivity * self.density * self.heat_capacity).sqrt()
    }
}

/// Heat over the difference of temperatures [J/K] that a touch conducts from one solid to the other; 0 for a touch
/// without an area.
pub fn contact_heat(touch: &Touch, particle: &HalfSpace, wall: &HalfSpace) -> f64 {
    let Touch { duration, radius } = *touch;
    if radius <= 0.0 {
        return 0.0;
    }
    let effusivity = 1.0 / (1.0 / particle.effusivity() + 1.0 / wall.effusivity());
    let conductivity = 1.0 / (1.0 / particle.conductivity + 1.0 / wall.conductivity);
    let quick = QUICK * PI * radius * radius * duration.sqrt() * effusivity;
    let slow = SLOW * radius * duration * conductivity;
    (quick.powf(POWER) + slow.powf(POWER)).powf(1.0 / POWER)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use statrs::function::beta::{beta, beta_reg};

    const GLASS: HalfSpace = HalfSpace { density: 2500.0, heat_capacity: 800.0, conductivity: 1.0 };
    const STEEL: HalfSpace = HalfSpace { density: 7900.0, heat_capacity: 480.0, conductivity: 15.0 };

    /// Means over Hertz' contact by the midpoint rule: the approach `x` [1] is the area in that of the largest contact.
    fn hertz(of: impl Fn(f64, f64) -> f64) -> f64 {
        let steps = 20_000;
        let step = 1.0 / f64::from(steps);
        let at = |i: i32| {
            let x = (f64::from(i) + 0.5) * step;
            of(x, beta_reg(0.4, 0.5, x.powf(2.5)))
        };
        (0..steps).map(at).sum::<f64>() * step
    }

    /// A spot touches from the time at which the contact has grown over it until it has shrunk to it again.
    #[test]
    fn the_numbers_are_the_means_over_hertz_contact() {
        let quick = hertz(|_, time| 2.0 * ((1.0 - time) / PI).sqrt());
        assert_relative_eq!(quick, QUICK, max_relative = 2e-5);
        assert_relative_eq!(quick, 0.87, max_relative = 2e-3);
        // dt = dx/sqrt(1 - x^(5/2)): the integral of sqrt(x) dt is a beta function.
        assert_relative_eq!(4.0 * beta(0.6, 0.5) / beta(0.4, 0.5), SLOW, max_relative = 1e-6);
    }

    /// Two half-spaces that touch over a fixed area exchange `2 dT A sqrt(t/pi)/(1/b_1 + 1/b_2)`: as the square root of
    /// time, and of two equal ones half of what one of them takes from a surface held at the other's temperature.
    #[test]
    fn quick_touches_conduct_as_two_half_spaces() {
        let of = |duration| contact_heat(&Touch { duration, radius: 1e-3 }, &GLASS, &GLASS);
        assert_relative_eq!(of(4e-6) / of(1e-6), 2.0, max_relative = 2e-3);
        let held = 2.0 * GLASS.effusivity() * (1e-6 / PI).sqrt() * PI * 1e-6;
        let hertz = QUICK / (2.0 / PI.sqrt());
        assert_relative_eq!(of(1e-6), 0.5 * hertz * held, max_relative = 1e-2);
        let both = |one, other| contact_heat(&Touch { duration: 1e-7, radius: 1e-4 }, one, other);
        assert_eq!(both(&GLASS, &STEEL), both(&STEEL, &GLASS));
        // What conducts poorly decides.
        let copper = HalfSpace { density: 8900.0, heat_capacity: 385.0, conductivity: 400.0 };
        assert!(both(&GLASS, &copper) < 2.1 * both(&GLASS, &GLASS));
    }

    /// A disc of radius `a` between half-spaces conducts `4 a k/2` for equal ones, as long as it touches.
    #[test]
    fn slow_touches_conduct_as_a_constriction() {
        let touch = Touch { duration: 1e3, radius: 1e-5 };
        let steady = 2.0 * GLASS.conductivity * touch.radius * touch.duration;
        assert_relative_eq!(contact_heat(&touch, &GLASS, &GLASS), 0.25 * SLOW * steady, max_relative = 1e-2);
        assert_eq!(contact_heat(&Touch { duration: f64::INFINITY, radius: 0.0 }, &GLASS, &GLASS), 0.0);
    }
}
