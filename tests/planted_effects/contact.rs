//! The base laws, written again from the equations alone: Thornton–Ning, constant, sliding and sliding–rolling.

use std::f64::consts::PI;

/// One body.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Young's modulus, Pa.
    pub modulus: f64,
    /// Poisson ratio.
    pub poisson: f64,
}

impl Body {
    fn shear_modulus(&self) -> f64 {
        self.modulus / (2.0 * (1.0 + self.poisson))
    }
}

/// A sphere on a plane.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    pub particle: Body,
    pub wall: Body,
    /// Density of the particle, kg/m³.
    pub density: f64,
    /// Yield strength of the softer body, Pa.
    pub yield_strength: f64,
    /// Contact pressure at yield over yield strength.
    pub yield_ratio: f64,
    /// Work of adhesion, J/m².
    pub adhesion: f64,
}

impl Contact {
    /// E*, Pa.
    pub fn reduced_modulus(&self) -> f64 {
        let compliance = |body: &Body| (1.0 - body.poisson * body.poisson) / body.modulus;
        1.0 / (compliance(&self.particle) + compliance(&self.wall))
    }

    /// The speed that adhesion alone takes away, m/s.
    pub fn adhesive_speed(&self, diameter: f64) -> f64 {
        let c1 = 3_f64.sqrt() / 2.0 * PI.cbrt() * ((1.0 + 6.0 * 4_f64.cbrt()) / 5.0).sqrt();
        let stiffness = self.density.powi(3) * self.reduced_modulus().powi(2) * (diameter / 2.0).powi(5);
        c1 * (self.adhesion.powi(5) / stiffness).powf(1.0 / 6.0)
    }

    /// The speed at which the contact begins to yield, m/s.
    pub fn yield_speed(&self) -> f64 {
        let pressure = self.yield_ratio * self.yield_strength;
        PI * PI / (2.0 * 10_f64.sqrt())
            * (pressure.powi(5) / (self.density * self.reduced_modulus().powi(4))).sqrt()
    }

    /// Normal restitution; zero is capture.
    pub fn restitution(&self, speed: f64, diameter: f64) -> f64 {
        let (adhesive, yielding) = (self.adhesive_speed(diameter), self.yield_speed());
        let kept = if speed <= yielding { 1.0 } else { plastic(yielding / speed) };
        (kept - (adhesive / speed).powi(2)).max(0.0).sqrt()
    }

    /// Sticking speed, m/s: bisection on where the restitution leaves zero.
    pub fn sticking_speed(&self, diameter: f64) -> f64 {
        let (mut low, mut high): (f64, f64) = (1e-9, 1e6);
        for _ in 0..200 {
            let middle = (low * high).sqrt();
            *(if self.restitution(middle, diameter) > 0.0 { &mut high } else { &mut low }) = middle;
        }
        high
    }

    /// Mindlin's ratio of tangential to normal stiffness.
    pub fn stiffness_ratio(&self) -> f64 {
        let sum = |share: f64| -> f64 {
            [self.particle, self.wall].iter().map(|b| (1.0 - share * b.poisson) / b.shear_modulus()).sum()
        };
        sum(1.0) / sum(0.5)
    }
}

/// Share of the energy that a plastic contact gives back, of the ratio of yield to impact speed.
fn plastic(w: f64) -> f64 {
    let loss = (6.0 - w * w) / 5.0;
    6.0 * 3_f64.sqrt() / 5.0 * (1.0 - w * w / 6.0) * (w / (w + 2.0 * loss.sqrt())).sqrt()
}

/// The base law along the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tangential {
    Constant(f64),
    Sliding { friction: f64 },
    SlidingRolling { friction: f64 },
}

/// A rigid sphere that rolls away keeps this.
pub const ROLLING: f64 = 5.0 / 7.0;

/// What gross sliding leaves of the tangential speed.
pub fn sliding(friction: f64, e_n: f64, v_n: f64, v_t: f64) -> f64 {
    (1.0 - friction * (1.0 + e_n) * v_n / v_t).max(0.0)
}

/// v_t / v_n at which sliding ends: the cotangent of the critical angle.
pub fn critical_slope(friction: f64, e_n: f64, stiffness_ratio: f64) -> f64 {
    (7.0 * stiffness_ratio - 1.0) / stiffness_ratio * friction / 2.0 * (1.0 + e_n)
}

impl Tangential {
    /// Tangential restitution.
    pub fn restitution(&self, stiffness_ratio: f64, e_n: f64, v_n: f64, v_t: f64) -> f64 {
        match *self {
            Self::Constant(e_t) => e_t,
            Self::Sliding { friction } => sliding(friction, e_n, v_n, v_t),
            Self::SlidingRolling { friction }
                if v_t / v_n > critical_slope(friction, e_n, stiffness_ratio) =>
            {
                sliding(friction, e_n, v_n, v_t)
            }
            Self::SlidingRolling { .. } => ROLLING,
        }
    }
}
