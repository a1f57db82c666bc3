//! How long a dry, elastic–perfectly plastic sphere touches a plane, and over which area.
//!
//! The motion `m d²delta/dt² = -F(delta)` of the contact of Thornton & Ning (Powder Technology 99 (1998) 154)
//! without adhesion, `m = (4/3) pi rho R³`, in three parts that add:
//! - elastic loading, `F = (4/3) E* sqrt(R) delta^(3/2)` (Hertz), up to yield at `delta_y = R (pi p_y/2E*)²`:
//!   `t = T I_z(2/5, 1/2) delta_e/v`, `z = (v_y/v)²`, `delta_e = (15 m v²/(16 E* sqrt(R)))^(2/5)`;
//! - plastic loading, `F = pi p_y R (delta - delta_y/3)`, a quarter of a harmonic motion with
//!   `omega = sqrt(pi p_y R/m)`: `t = atan(v_1/(omega 2 delta_y/3))/omega`, `v_1² = v² - v_y²`;
//! - elastic unloading as after Hertz, with the radius of curvature `R_p = 4 E* a³/(3 F)` that plastic
//!   flow leaves: `t = T h/v_r`, `h = a²/R_p`, `v_r² = 4 F h/(5 m)`; `F` and `a² = R delta` at the turning point.
//!
//! `T = (2/5) B(2/5, 1/2) = 1.4716`; `I` is the regularised incomplete beta function. An impact slower than the
//! yield velocity takes Hertz' `2 T delta_e/v = 2.943 delta_e/v` (Hertz 1882; Johnson, Contact Mechanics, section
//! 11.4, not re-read).
//!
//! `v` normal speed [m/s], `R` radius [m], `rho` density of the particle [kg/m³], `E*` reduced modulus [Pa], `p_y`
//! limiting pressure [Pa], `delta` approach and `a` contact radius [m], `v_y` yield velocity [m/s]. Valid for
//! `a` small against `R` and speeds well above the sticking velocity: adhesion, which draws a slow contact out,
//! is left out: it takes up to 1.25 times as long above ten times the sticking velocity and up to 1.5 times below
//! (400 integrated contacts, tests/library/contact_integration.rs). A particle that is held stays; then this is the
//! time in which it is stopped and pushed back.

use std::f64::consts::PI;

use statrs::function::beta::{beta, beta_reg};

use super::{Contact, yield_velocity};

/// How long a particle touches a plane, and over which area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Time of contact [s]; infinite without speed.
    pub duration: f64,
    /// Largest radius `a` of the area of contact [m].
    pub radius: f64,
}

/// Time of contact [s] of a particle of `diameter` [m] at `normal_speed` [m/s]; infinite without speed.
pub fn contact_time(contact: &Contact, diameter: f64, normal_speed: f64) -> f64 {
    touch(contact, diameter, normal_speed).duration
}

/// The touch of a particle of `diameter` [m] at `normal_speed` [m/s].
pub fn touch(contact: &Contact, diameter: f64, normal_speed: f64) -> Touch {
    if normal_speed <= 0.0 {
        return Touch { duration: f64::INFINITY, radius: 0.0 };
    }
    let (radius, modulus) = (0.5 * diameter, contact.reduced_modulus);
    let mass = PI / 6.0 * contact.density * diameter.powi(3);
    // Depth and time that a Hertz contact of a curvature takes to stop a speed.
    let depth = (15.0 * mass * normal_speed * normal_speed / (16.0 * modulus * radius.sqrt())).powf(0.4);
    let quarter = 0.4 * beta(0.4, 0.5);
    let yielding = yield_velocity(contact);
    if normal_speed <= yielding {
        return Touch { duration: 2.0 * quarter * depth / normal_speed, radius: (radius * depth).sqrt() };
    }
    let pressure = contact.limiting_pressure();
    let elastic = quarter * beta_reg(0.4, 0.5, (yielding / normal_speed).powi(2)) * depth / normal_speed;
    let at_yield = radius * (0.5 * PI * pressure / modulus).powi(2);
    let stiffness = PI * pressure * radius;
    let frequency = (stiffness / mass).sqrt();
    let left = (normal_speed - yielding).sqrt() * (normal_speed + yielding).sqrt();
    let (from, swing) = (2.0 / 3.0 * at_yield, left / frequency);
    let plastic = swing.atan2(from) / frequency;
    let reach = from.hypot(swing);
    let (force, approach) = (stiffness * reach, at_yield / 3.0 + reach);
    let widest = (radius * approach).sqrt();
    let recovered = 0.75 * force / (modulus * widest);
    let rebound = (0.8 * force * recovered / mass).sqrt();
    Touch { duration: elastic + plastic + quarter * recovered / rebound, radius: widest }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Library;
    use crate::normal::plastic_term;
    use approx::assert_relative_eq;

    /// Tungsten of 9 µm at 3000 K on 1000 K, `p_y = 4 sigma_y`, as in the paper on tungsten dust.
    fn tungsten() -> Contact {
        let library = Library::built_in().unwrap();
        let at = |t| library.get("tungsten").unwrap().mechanical(t).unwrap();
        Contact::new(&at(3000.0), &at(1000.0), 4.0, Some(0.0))
    }

    /// The motion itself, by small steps of the fourth order: the force while the approach grows, and along the
    /// curve of the flattened sphere while it shrinks. Time of contact [s] and rebound over impact speed.
    fn integrated(contact: &Contact, diameter: f64, speed: f64, steps: f64) -> [f64; 2] {
        let (radius, modulus, pressure) =
            (0.5 * diameter, contact.reduced_modulus, contact.limiting_pressure());
        let mass = 4.0 / 3.0 * PI * contact.density * radius.powi(3);
        let hertz =
            |approach: f64, radius: f64| 4.0 / 3.0 * modulus * radius.sqrt() * approach.max(0.0).powf(1.5);
        let yielding = radius * (PI * pressure / (2.0 * modulus)).powi(2);
        let loading = |approach: f64| {
            if approach < yielding {
                hertz(approach, radius)
            } else {
                hertz(yielding, radius) + PI * pressure * radius * (approach - yielding)
            }
        };
        let step = |force: &dyn Fn(f64) -> f64, [x, v]: [f64; 2], dt: f64| {
            let slope = |x: f64, v: f64| [v, -force(x) / mass];
            let a = slope(x, v);
            let b = slope(x + 0.5 * dt * a[0], v + 0.5 * dt * a[1]);
            let c = slope(x + 0.5 * dt * b[0], v + 0.5 * dt * b[1]);
            let d = slope(x + dt * c[0], v + dt * c[1]);
            [0, 1].map(|i| [x, v][i] + dt / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
        };
        let dt = contact_time(contact, diameter, speed) / steps;
        let (mut time, mut state) = (0.0, [0.0, speed]);
        let before = loop {
            let next = step(&loading, state, dt);
            if next[1] < 0.0 {
                break state;
            }
            (state, time) = (next, time + dt);
        };
        let braking = loading(before[0]) / mass;
        let rest = before[1] / braking;
        let deepest = before[0] + 0.5 * before[1] * rest;
        time += rest;
        let force = loading(deepest);
        let contact_radius = (radius * deepest).sqrt();
        let curvature =
            if deepest < yielding { radius } else { 4.0 * modulus * contact_radius.powi(3) / (3.0 * force) };
        let plastic = deepest - contact_radius * contact_radius / curvature;
        let unloading = |x: f64| hertz(x - plastic, curvature);
        state = [deepest, 0.0];
        loop {
            let next = step(&unloading, state, dt);
            if next[0] < plastic {
                return [time + (state[0] - plastic) / -state[1], -state[1] / speed];
            }
            (state, time) = (next, time + dt);
        }
    }

    #[test]
    fn the_motion_integrated_takes_as_long() {
        let contact = tungsten();
        let yielding = yield_velocity(&contact);
        let speeds = [0.5 * yielding, 1.01 * yielding, 3.0 * yielding, 0.5, 1.0, 4.0, 12.0];
        for speed in speeds {
            let [time, e_n] = integrated(&contact, 9e-6, speed, 2e5);
            assert_relative_eq!(contact_time(&contact, 9e-6, speed), time, max_relative = 1e-5);
            // The integrated motion is that of the law: the same share of speed comes back.
            let plain = if speed < yielding { 1.0 } else { plastic_term(yielding / speed).sqrt() };
            assert_relative_eq!(e_n, plain, max_relative = 1e-4);
        }
    }

    /// The paper on tungsten dust gives some 10 ns for its 9 µm at 0.5 to 4 m/s: the same order.
    #[test]
    fn tungsten_dust_touches_for_tens_of_nanoseconds() {
        for speed in [0.5, 1.0, 2.0, 4.0] {
            let time = contact_time(&tungsten(), 9e-6, speed);
            assert!((10e-9..100e-9).contains(&time), "{speed} m/s: {time:e} s");
        }
    }

    /// Hertz' law: `t` as `v^(-1/5)` and as the size; continuous at yield.
    #[test]
    fn elastic_times_scale_as_hertz_has_them() {
        let contact = Contact { yield_strength: 1e15, ..tungsten() };
        let time = |diameter, speed| contact_time(&contact, diameter, speed);
        assert_relative_eq!(time(9e-6, 32.0) / time(9e-6, 1.0), 0.5, max_relative = 1e-12);
        assert_relative_eq!(time(18e-6, 1.0) / time(9e-6, 1.0), 2.0, max_relative = 1e-12);
        let yielding = yield_velocity(&tungsten());
        let near = [1.0 - 1e-9, 1.0 + 1e-9].map(|share| contact_time(&tungsten(), 9e-6, share * yielding));
        assert_relative_eq!(near[0], near[1], max_relative = 1e-4);
        assert_eq!(time(9e-6, 0.0), f64::INFINITY);
    }
}
