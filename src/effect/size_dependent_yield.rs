//! `size-dependent-yield`: small particles are stronger.
//!
//! `sigma_y -> sigma_y (d0/d)^m` with `d` the particle's diameter [m], `d0` the `diameter` [m] for
//! which the material's strength holds and `m` the `exponent` [1]. The yield velocity is
//! proportional to `d^(-5m/2)`. Strength changes by twelve decades at most.
//!
//! That metals of few micrometres are stronger is known (fewer sources of dislocations, finer grains: Hall–Petch has
//! `m = 1/2` in the grain size), and the MIGRAINE dust study lets tungsten's strength depend on size without giving the
//! law: the power is assumed. Valid over the fitted sizes. With one size in the data `d0` and `m` are one number.

use super::{Effect, EffectInfo, Parameter, Search, bounded};
use crate::impact::Impact;
use crate::normal::Contact;

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "size-dependent-yield",
    about: "the yield strength rises as the particle gets smaller",
    inputs: &["d"],
    stream: None,
    parameters: &[
        Parameter::new("diameter", "m", (1e-9, 1.0), Search::Log(1e-8, 1e-2))
            .about("diameter for which the material's yield strength holds"),
        Parameter::new("exponent", "1", (0.0, 3.0), Search::Linear(0.1, 1.5))
            .about("power with which the strength rises as the size falls"),
    ],
    build: |values| Box::new(SizeDependentYield { diameter: values[0], exponent: values[1] }),
};

#[derive(Debug)]
struct SizeDependentYield {
    diameter: f64,
    exponent: f64,
}

impl Effect for SizeDependentYield {
    fn contact(&self, impact: &Impact, contact: Contact, _: f64) -> Contact {
        let factor = bounded((self.diameter / impact.diameter).powf(self.exponent));
        Contact { yield_strength: contact.yield_strength * factor, ..contact }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::wax_on_pyrex;
    use super::*;
    use crate::normal::yield_velocity;
    use approx::assert_relative_eq;

    fn yields_at(diameter: f64) -> f64 {
        let impact = Impact { diameter, ..Impact::default() };
        yield_velocity(&(INFO.build)(&[10e-6, 0.5]).contact(&impact, wax_on_pyrex(), 0.0))
    }

    /// Hall–Petch: a quarter of the size has twice the strength, so `2^(5/2)` of the yield velocity.
    #[test]
    fn a_quarter_of_the_size_has_twice_the_strength() {
        let plain = yield_velocity(&wax_on_pyrex());
        assert_relative_eq!(yields_at(10e-6), plain, max_relative = 1e-12);
        assert_relative_eq!(yields_at(2.5e-6) / plain, 5.656_854, max_relative = 1e-6);
        assert_relative_eq!(yields_at(40e-6) / plain, 1.0 / 5.656_854, max_relative = 1e-6);
    }
}
