//! The true world: a base model and planted effects.

use std::sync::Arc;

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

    /// The input of this column.
    pub fn value(&self, column: &str) -> f64 {
        match column {
            "T_p" => self.t_p,
            "T_w" => self.t_w,
            "d" => self.d,
            "v_gas" => self.v_gas,
            "layer_thickness" => self.layer,
            "film_thickness" => self.film,
            "roughness" => self.roughness,
            "conversion" => self.conversion,
            _ => panic!("{column} is no input"),
        }
    }
}

/// The outcome of an impact: probability of capture, and the restitutions of a rebound.
#[derive(Clone, Copy, Debug)]
pub struct Response {
    pub stick: f64,
    pub e_n: f64,
    pub e_t: f64,
}

/// The normal part during its evaluation.
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
    pub plants: Vec<Arc<Plant>>,
}

/// Number of hidden draws of an impact.
pub const DRAWS: usize = 2;

impl World {
    /// The outcome under the base model.
    pub fn base(&self, x: &Inputs) -> Response {
        evaluate(&self.contact, self.tangential, &[], x, [0.5; DRAWS])
    }

    /// The truth for one pair of hidden draws (each uniform in 0..1).
    pub fn truth(&self, x: &Inputs, draws: [f64; DRAWS]) -> Response {
        for plant in &self.plants {
            if let Hook::Tilt(angle) = plant.hook {
                return self.tilted(x, angle, draws);
            }
        }
        evaluate(&self.contact, self.tangential, &self.plants, x, draws)
    }

    /// This world without its plant `index`.
    pub fn without(&self, index: usize) -> Self {
        let mut plants = self.plants.clone();
        plants.remove(index);
        Self { plants, ..*self }
    }

    /// Whether a plant makes the outcome of equal impacts random.
    pub fn scatters(&self) -> bool {
        self.plants.iter().any(|plant| plant.scatters)
    }

    /// The impact on a facet that is tilted in the plane of impact. The tilt is halved while the facet faces away or
    /// reflects the particle into the wall.
    fn tilted(&self, x: &Inputs, angle: f64, draws: [f64; DRAWS]) -> Response {
        let mut tilt = angle * normal(draws);
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
    plants: &[Arc<Plant>],
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

/// A standard normal number from two uniform ones (Box and Muller).
pub fn normal([one, two]: [f64; DRAWS]) -> f64 {
    (-2.0 * (1.0 - one).ln()).sqrt() * (std::f64::consts::TAU * two).cos()
}
