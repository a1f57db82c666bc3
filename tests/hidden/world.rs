//! The world that is measured: a base model and what is planted on it.

use crate::contact::{Contact, Tangential};
use crate::plant::{Hook, Plant};

/// The inputs of one impact, SI.
#[derive(Clone, Copy, Debug, Default)]
pub struct Inputs {
    pub v_n: f64,
    pub v_t: f64,
    pub d: f64,
    pub t_p: f64,
    pub t_w: f64,
    pub v_gas: f64,
    pub layer: f64,
    pub film: f64,
    pub roughness: f64,
    pub conversion: f64,
    /// Of a column that no model knows: a number, and a group.
    pub foreign: f64,
    pub group: usize,
}

impl Inputs {
    /// Angle from the normal over 90°, 0 to 1.
    pub fn obliquity(&self) -> f64 {
        self.v_t.atan2(self.v_n) / std::f64::consts::FRAC_PI_2
    }
}

/// What becomes of the impact: probability of capture, and the restitutions if it rebounds.
#[derive(Clone, Copy, Debug)]
pub struct Response {
    pub stick: f64,
    pub e_n: f64,
    pub e_t: f64,
}

/// The normal part while it is worked out.
#[derive(Clone, Copy, Debug)]
pub struct Normal {
    pub stick: f64,
    pub e_n: f64,
    /// Share of the impact energy that adhesion takes.
    pub adhesion_share: f64,
}

/// Base and plants.
pub struct World {
    pub contact: Contact,
    pub tangential: Tangential,
    pub plants: Vec<Plant>,
}

/// How many hidden draws an impact has.
pub const DRAWS: usize = 2;

impl World {
    /// What the base model says.
    pub fn base(&self, x: &Inputs) -> Response {
        evaluate(&self.contact, self.tangential, &[], x, [0.5; DRAWS])
    }

    /// The truth for one pair of hidden draws (each uniform in 0..1).
    pub fn truth(&self, x: &Inputs, draws: [f64; DRAWS]) -> Response {
        let tilt = self.plants.iter().find_map(|plant| match plant.hook {
            Hook::Tilt(angle) => Some(angle),
            _ => None,
        });
        match tilt {
            Some(angle) => self.tilted(x, angle, draws),
            None => evaluate(&self.contact, self.tangential, &self.plants, x, draws),
        }
    }

    /// Whether the outcome of one and the same impact is scattered by what is planted.
    pub fn scatters(&self) -> bool {
        self.plants.iter().any(|plant| plant.scatters)
    }

    /// The impact in the frame of a facet that is tilted in the plane of impact, and back in the wall's frame.
    /// A facet that faces away, or sends the particle into the wall, is not what was hit: half the tilt then.
    fn tilted(&self, x: &Inputs, angle: f64, draws: [f64; DRAWS]) -> Response {
        let mut tilt = angle * normal_quantile(draws[0]);
        for _ in 0..20 {
            let (sine, cosine) = tilt.sin_cos();
            let local =
                Inputs { v_n: x.v_n * cosine + x.v_t * sine, v_t: x.v_t * cosine - x.v_n * sine, ..*x };
            if local.v_n > 0.0 && local.v_t > 0.0 {
                let r = evaluate(&self.contact, self.tangential, &self.plants, &local, draws);
                let (out, along) = (r.e_n * local.v_n, r.e_t * local.v_t);
                let (e_n, e_t) =
                    ((out * cosine + along * sine) / x.v_n, (along * cosine - out * sine) / x.v_t);
                if r.stick >= 1.0 || e_n > 0.0 && e_t > 0.0 {
                    return Response { stick: r.stick, e_n, e_t };
                }
            }
            tilt /= 2.0;
        }
        evaluate(&self.contact, self.tangential, &self.plants, x, draws)
    }
}

/// Solids, then the normal part, then the tangential part, each with its plants.
fn evaluate(
    contact: &Contact,
    law: Tangential,
    plants: &[Plant],
    x: &Inputs,
    draws: [f64; DRAWS],
) -> Response {
    let mut contact = *contact;
    for plant in plants {
        if let Hook::Solid(change) = &plant.hook {
            change(x, draws[0], &mut contact);
        }
    }
    let e_n = contact.restitution(x.v_n, x.d);
    let adhesion_share = (contact.adhesive_speed(x.d) / x.v_n).powi(2);
    let mut normal = Normal { stick: f64::from(u8::from(e_n == 0.0)), e_n, adhesion_share };
    for plant in plants {
        if let Hook::Normal(change) = &plant.hook {
            change(x, draws[1], &mut normal);
        }
    }
    if normal.e_n <= 0.0 {
        normal = Normal { stick: 1.0, e_n: 0.0, ..normal };
    }
    let stiffness_ratio = contact.stiffness_ratio();
    let mut e_t = law.restitution(stiffness_ratio, normal.e_n, x.v_n, x.v_t);
    for plant in plants {
        if let Hook::Tangential(change) = &plant.hook {
            e_t = change(x, normal.e_n, stiffness_ratio, e_t);
        }
    }
    Response { stick: normal.stick, e_n: normal.e_n, e_t }
}

/// Quantile of the standard normal (logit approximation refined by Newton steps on an integrated density).
pub fn normal_quantile(share: f64) -> f64 {
    let share = share.clamp(1e-6, 1.0 - 1e-6);
    let mut z = (share / (1.0 - share)).ln() / 1.702;
    for _ in 0..6 {
        let density = (-z * z / 2.0).exp() / std::f64::consts::TAU.sqrt();
        z -= (normal_share(z) - share) / density.max(1e-8);
    }
    z
}

/// Share of the standard normal below `z`: Simpson's rule from 0.
fn normal_share(z: f64) -> f64 {
    let steps = 40;
    let width = z / f64::from(steps);
    let density = |i: i32| (-(f64::from(i) * width).powi(2) / 2.0).exp() / std::f64::consts::TAU.sqrt();
    let weight = |i: i32| if i == 0 || i == steps { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
    0.5 + width / 3.0 * (0..=steps).map(|i| weight(i) * density(i)).sum::<f64>()
}
