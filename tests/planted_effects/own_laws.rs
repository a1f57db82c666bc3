//! Plants whose law is the library's own, written again from the equations of docs/why/physics.md.

use crate::plant::Plant;

/// `e_n (residual + (1 - residual) exp(-h/thickness))`.
pub fn powder_layer(thickness: f64, residual: f64) -> Plant {
    Plant::normal("powder-layer", move |x, _, n| {
        n.e_n *= residual + (1.0 - residual) * (-x.layer / thickness).exp();
    })
    .with("thickness", thickness)
    .with("residual", residual)
}

/// The stickiness `S = 1/(1 + exp((temperature - T_p)/width))`, and `e_n (1 - softening S)`.
pub fn melting(temperature: f64, width: f64, softening: f64) -> Plant {
    let mut plant = Plant::normal("melting-transition", move |x, _, n| {
        let share = 1.0 / (1.0 + ((temperature - x.t_p) / width).exp());
        n.stick = n.stick.max(share);
        n.e_n *= 1.0 - softening * share;
    });
    plant.observable = "stick";
    let plant = plant.with("temperature", temperature).with("width", width);
    if softening > 0.0 { plant.with("softening", softening) } else { plant }
}

/// `sigma_y (diameter/d)^exponent`: with the yield strength free, only the curve that both describe is known.
pub fn size(diameter: f64, exponent: f64) -> Plant {
    Plant::solid("size-dependent-yield", move |x, _, c| c.yield_strength *= (diameter / x.d).powf(exponent))
        .with("diameter", diameter)
        .with("exponent", exponent)
}

/// `sigma_y s` and `E* sqrt(s)` with `s = exp(-max(0, T_p - onset)/scale)`.
pub fn softening(onset: f64, scale: f64) -> Plant {
    Plant::solid("thermal-softening", move |x, _, c| {
        let left = (-(x.t_p - onset).max(0.0) / scale).exp();
        c.yield_strength *= left;
        c.particle.modulus *= left.sqrt();
        c.wall.modulus *= left.sqrt();
    })
    .with("onset", onset)
    .with("scale", scale)
}

/// `e_n exp(-(v_n/speed)^exponent)`.
pub fn viscous(speed: f64, exponent: f64) -> Plant {
    Plant::normal("viscoelastic-loss", move |x, _, n| n.e_n *= (-(x.v_n / speed).powf(exponent)).exp())
        .with("speed", speed)
        .with("exponent", exponent)
}
