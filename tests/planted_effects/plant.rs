//! The planted effects, each with a law that the library does not have. A strength runs from 0 (weak) to 1 (strong).

use crate::contact::{Contact, ROLLING, critical_slope, sliding};
use crate::world::{Inputs, Normal};

type ChangeSolid = Box<dyn Fn(&Inputs, f64, &mut Contact) + Send + Sync>;
type ChangeNormal = Box<dyn Fn(&Inputs, f64, &mut Normal) + Send + Sync>;
type ChangeTangential = Box<dyn Fn(&Inputs, f64, f64, f64) -> f64 + Send + Sync>;

/// Where a plant acts.
pub enum Hook {
    /// Of inputs and a hidden draw: the solids.
    Solid(ChangeSolid),
    /// Of inputs and a hidden draw: capture and normal restitution.
    Normal(ChangeNormal),
    /// Of inputs, e_n, stiffness ratio and base e_t: the tangential restitution.
    Tangential(ChangeTangential),
    /// Root mean square tilt of the local wall, rad.
    Tilt(f64),
}

/// A planted effect.
pub struct Plant {
    /// The cause to be found.
    pub cause: &'static str,
    pub hook: Hook,
    /// Whether equal impacts have different outcomes.
    pub scatters: bool,
    /// The observable by which it is judged: `e_n`, `e_t` or `stick`.
    pub observable: &'static str,
    /// Parameters that a diagnosis may state.
    pub parameters: Vec<(&'static str, f64)>,
}

impl Plant {
    fn new(cause: &'static str, observable: &'static str, hook: Hook) -> Self {
        Self { cause, hook, scatters: false, observable, parameters: vec![] }
    }

    pub fn solid(
        cause: &'static str,
        change: impl Fn(&Inputs, f64, &mut Contact) + Send + Sync + 'static,
    ) -> Self {
        Self::new(cause, "e_n", Hook::Solid(Box::new(change)))
    }

    pub fn normal(
        cause: &'static str,
        change: impl Fn(&Inputs, f64, &mut Normal) + Send + Sync + 'static,
    ) -> Self {
        Self::new(cause, "e_n", Hook::Normal(Box::new(change)))
    }

    pub fn tangential(
        cause: &'static str,
        change: impl Fn(&Inputs, f64, f64, f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        Self::new(cause, "e_t", Hook::Tangential(Box::new(change)))
    }

    pub fn with(mut self, name: &'static str, value: f64) -> Self {
        self.parameters.push((name, value));
        self
    }

    fn scattering(mut self) -> Self {
        self.scatters = true;
        self
    }
}

/// Between two ends, by strength.
fn between(strength: f64, weak: f64, strong: f64) -> f64 {
    weak + (strong - weak) * strength
}

/// 0 below `from`, 1 above `to`, a straight line between.
fn ramp(x: f64, from: f64, to: f64) -> f64 {
    ((x - from) / (to - from)).clamp(0.0, 1.0)
}

/// Another ratio of contact pressure to yield strength.
pub fn yield_ratio(ratio: f64) -> Plant {
    Plant::solid("yield-ratio", move |_, _, c| c.yield_ratio = ratio).with("ratio", ratio)
}

/// Another work of adhesion.
pub fn adhesion_energy(work: f64) -> Plant {
    Plant::solid("adhesion-energy", move |_, _, c| c.adhesion = work).with("work_of_adhesion", work)
}

/// e_n falls (negative sign) or rises with the square of the obliquity, more so when fast.
pub fn oblique_angle(strength: f64, sign: f64, v_half: f64) -> Plant {
    let most = sign * between(strength, 0.55, 1.3);
    Plant::normal("oblique-angle", move |x, _, n| {
        let change = most * x.obliquity().powi(2) * x.v_n / (x.v_n + v_half);
        n.e_n *= if change > 0.0 { 1.0 + change } else { 1.0 / (1.0 - change) };
    })
}

/// e_n falls past an obliquity, in a straight line, more so when fast: what the published set 4 shows.
pub fn oblique_loss(most: f64, v_half: f64) -> Plant {
    Plant::normal("oblique-angle", move |x, _, n| {
        n.e_n /= 1.0 + most * ramp(x.obliquity(), 0.35, 0.8) * x.v_n / (x.v_n + v_half);
    })
}

/// Another constant e_t: a number of the base, no effect.
pub fn tangential_level(e_t: f64) -> Plant {
    Plant::tangential("calibration:tangential.e_t", move |_, _, _, _| e_t).with("e_t", e_t)
}

/// One series of molten particles, which all stick.
pub fn molten_series(group: usize) -> Plant {
    let mut plant = Plant::normal("molten-series", move |x, _, n| {
        if x.group == group {
            n.stick = 1.0;
        }
    });
    plant.observable = "stick";
    plant
}

/// Gas along the wall raises e_n past an obliquity, in straight lines.
pub fn gas_lift(strength: f64, v_half: f64, onset: f64) -> Plant {
    let most = between(strength, 0.7, 1.6);
    Plant::normal("gas-lift", move |x, _, n| {
        n.e_n *= 1.0 + most * ramp(x.obliquity(), onset, 0.95) * (x.v_gas / v_half).min(2.0) / 2.0;
    })
}

/// Sliding ends: past the critical slope a straight line over `blend` of it leads to rolling.
pub fn sliding_to_rolling(friction: f64, blend: f64) -> Plant {
    Plant::tangential("sliding-to-rolling", move |x, e_n, k, _| {
        let critical = critical_slope(friction, e_n, k);
        let slope = x.v_t / x.v_n;
        if slope >= critical {
            return sliding(friction, e_n, x.v_n, x.v_t);
        }
        let end = sliding(friction, e_n, 1.0, critical);
        ROLLING + (end - ROLLING) * ramp(slope, critical * (1.0 - blend), critical)
    })
    .with("friction", friction)
}

/// Below the critical slope the contact springs back: e_t dips at the slope and rises to `top` at normal impact.
pub fn tangential_compliance(strength: f64, friction: f64, top: f64) -> Plant {
    let share = between(strength, 0.4, 1.0);
    Plant::tangential("tangential-compliance", move |x, e_n, k, base| {
        let critical = critical_slope(friction, e_n, k);
        let part = x.v_t / x.v_n / critical;
        if part >= 1.0 {
            return base;
        }
        let end = sliding(friction, e_n, 1.0, critical);
        let spring = top + (end - top) * 2.0 * part / (1.0 + part * part);
        ROLLING + share * (spring - ROLLING)
    })
}

/// Asperities: the work of adhesion is drawn between 0 and its full value, often small.
pub fn nano_roughness(strength: f64, power: f64) -> Plant {
    let most = between(strength, 0.35, 1.0);
    Plant::solid("nano-roughness", move |_, draw, c| c.adhesion *= 1.0 - most * draw.powf(power)).scattering()
}

/// Facets tilted at random.
pub fn micro_roughness(angle: f64) -> Plant {
    Plant::new("micro-roughness", "e_n", Hook::Tilt(angle)).with("angle", angle).scattering()
}

/// A share of loose agglomerates keeps most of its speed; adhesion still takes its part.
pub fn agglomerates(fraction: f64, low: f64, high: f64) -> Plant {
    Plant::normal("agglomerates", move |_, draw, n| {
        if draw < fraction {
            let part = draw / fraction;
            let dry = low + (high - low) * (part * part * (3.0 - 2.0 * part));
            let kept = dry * dry - n.adhesion_share;
            *n = Normal { stick: f64::from(u8::from(kept <= 0.0)), e_n: kept.max(0.0).sqrt(), ..*n };
        }
    })
    .with("fraction", fraction)
    .scattering()
}

/// Powder takes energy by its thickness over `scale`, down to a rest: a rational law.
pub fn powder_layer(strength: f64, scale: f64, power: f64) -> Plant {
    let rest = between(strength, 0.7, 0.2);
    Plant::normal("powder-layer", move |x, _, n| {
        n.e_n *= rest + (1.0 - rest) / (1.0 + (x.layer / scale).powf(power));
    })
}

/// A film of this viscosity takes its share; the critical Stokes number grows with the film's thickness.
pub fn liquid_film(viscosity: f64, density: f64, asperity: f64) -> Plant {
    Plant::normal("liquid-film", move |x, _, n| {
        let critical = (1.0 + x.film / asperity).ln();
        let stokes = density * x.v_n * x.d / (9.0 * viscosity);
        n.e_n *= (1.0 - critical / stokes).max(0.0);
    })
}

/// Past `onset` the particle melts: a Hill curve that is half at `temperature`. It sticks and turns soft.
pub fn melting_transition(temperature: f64, onset: f64, power: f64, softening: f64) -> Plant {
    let molten = move |t: f64| 1.0 / (1.0 + ((temperature - onset) / (t - onset).max(1e-9)).powf(power));
    let mut plant = Plant::normal("melting-transition", move |x, _, n| {
        let share = molten(x.t_p);
        n.stick = n.stick.max(share);
        n.e_n *= 1.0 - softening * share;
    });
    plant.observable = "stick";
    plant.with("temperature", temperature)
}

/// Past a conversion the char's ash is bare and sticks: a smooth step from `-width` to `+width`.
pub fn conversion_transition(threshold: f64, width: f64) -> Plant {
    let mut plant = Plant::normal("conversion-transition", move |x, _, n| {
        let part = ramp(x.conversion, threshold - width, threshold + width);
        n.stick = n.stick.max(part * part * (3.0 - 2.0 * part));
    });
    plant.observable = "stick";
    plant.with("threshold", threshold)
}

/// Strength and modulus hold up to `from`, then fall in a straight line towards `to`.
pub fn thermal_softening(strength: f64, from: f64, to: f64) -> Plant {
    let lost = between(strength, 0.35, 0.75);
    Plant::solid("thermal-softening", move |x, _, c| {
        let part = ramp(x.t_p, from, to);
        c.yield_strength *= 1.0 - lost * part;
        c.particle.modulus *= 1.0 - 0.35 * lost * part;
    })
}

/// Small particles are stronger: with the logarithm of the size below `reference`, up to a limit.
pub fn size_dependent_yield(strength: f64, reference: f64) -> Plant {
    let slope = between(strength, 0.25, 1.3);
    Plant::solid("size-dependent-yield", move |x, _, c| {
        c.yield_strength *= (1.0 + slope * (reference / x.d).ln()).clamp(0.3, 6.0);
    })
}

/// Fast contacts are stronger: rational in the speed, half of the gain at `v_half`.
pub fn strain_rate_hardening(strength: f64, v_half: f64) -> Plant {
    let most = between(strength, 0.7, 3.0);
    Plant::solid("strain-rate-hardening", move |x, _, c| {
        c.yield_strength *= 1.0 + most * x.v_n / (x.v_n + v_half);
    })
}

/// Extra loss of energy that grows with speed, by a tanh.
pub fn viscoelastic_loss(strength: f64, v_scale: f64) -> Plant {
    let most = between(strength, 0.35, 0.9);
    Plant::normal("viscoelastic-loss", move |x, _, n| {
        n.e_n *= (1.0 - most * (x.v_n / v_scale).tanh()).sqrt();
    })
}

/// A column that no model knows lowers e_n.
pub fn unknown_number(slope: f64) -> Plant {
    Plant::normal("unknown:humidity", move |x, _, n| {
        let part = x.foreign / 100.0;
        n.e_n *= 1.0 - slope * part * part * (3.0 - 2.0 * part);
    })
}

/// Groups differ.
pub fn unknown_group(shifts: Vec<f64>) -> Plant {
    Plant::normal("unknown:batch", move |x, _, n| n.e_n *= 1.0 + shifts[x.group])
}
