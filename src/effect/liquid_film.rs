//! `liquid-film`: a liquid film on the wall slows the particle on approach and on rebound.
//!
//! `e_n -> e_n (1 - St_c/St)`, and the particle is held where `St <= St_c`, with `St = rho d v_n/(9
//! mu)` and `St_c = (1 + 1/e_n) ln(h/h_a)` for a film thicker than `h_a`, 0 otherwise. `rho`
//! particle density [kg/m³], `d` diameter [m], `mu` the film's `viscosity` [Pa s], `h` its
//! thickness [m], `h_a` the `asperity` [m] at which the solids touch, `e_n` the dry restitution.
//!
//! Derived from the lubrication force `6 pi mu R² v/x` on a sphere at a distance `x` from a plane:
//! crossing the film costs `9 mu/(rho d) ln(h/h_a)` of speed, once each way. The critical Stokes
//! number is that of Ennis, Tardos & Pfeffer (Powder Technology 65 (1991) 257) for granules; Davis,
//! Rager & Good (J. Fluid Mech. 468 (2002) 107) measured spheres on a wetted plane and observed the
//! same law. Meant for walls covered with slag.
//!
//! Valid for films thin against `d` and slow flow within them; it neglects capillary and inertial
//! forces, cavitation on rebound and deformation by the pressure of the film, which lowers `St_c`.
//! The film is the caller's `film_thickness`, or the melt of earlier particles where that is
//! thicker; without a `viscosity` its viscosity is that of the slag at the wall's temperature.
//! Under a powder layer the film does not act (Troiano et al., Fig 10, found powder on syrup like
//! powder on a dry target).

use super::{Effect, EffectInfo, Parameter, Search};
use crate::impact::Impact;
use crate::normal::Contact;

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "liquid-film",
    about: "a liquid film on the wall brakes the particle and may hold it",
    inputs: &["film_thickness", "v_n", "d"],
    stream: None,
    parameters: &[
        Parameter::new("viscosity", "Pa s", (0.0, 1e6), Search::Log(1e-4, 10.0))
            .absent(0.0)
            .about("viscosity of the film; 0 takes that of the melt on the wall"),
        Parameter::new("asperity", "m", (1e-12, 1.0), Search::Log(1e-8, 1e-4))
            .about("distance at which the solids touch through the film"),
    ],
    build: |values| Box::new(LiquidFilm { viscosity: values[0], asperity: values[1] }),
};

#[derive(Debug)]
struct LiquidFilm {
    viscosity: f64,
    asperity: f64,
}

impl LiquidFilm {
    /// Speed [m/s] that crossing the film costs, `v_n ln(h/h_a) / St`.
    fn cost(&self, impact: &Impact, contact: &Contact) -> f64 {
        let melt = contact.melt.map_or(0.0, |melt| melt.viscosity);
        let viscosity = if self.viscosity > 0.0 { self.viscosity } else { melt };
        // A wall's memory knows its melt, which is a film where it is liquid.
        let deposit = if contact.melt.is_some() { impact.melt_thickness } else { 0.0 };
        let depth = (impact.film_thickness.max(deposit) / self.asperity).ln().max(0.0);
        9.0 * viscosity * depth / (contact.density * impact.diameter)
    }
}

impl Effect for LiquidFilm {
    fn uses_melt(&self) -> bool {
        true
    }

    fn film_viscosity(&self) -> Option<f64> {
        (self.viscosity > 0.0).then_some(self.viscosity)
    }

    fn normal_restitution(
        &self,
        impact: &Impact,
        contact: &Contact,
        restitution: f64,
        _: f64,
    ) -> Option<f64> {
        let cost = self.cost(impact, contact);
        if cost <= 0.0 {
            return Some(restitution);
        }
        // e (1 - St_c/St), written without the division by e.
        let wet = restitution - (1.0 + restitution) * cost / impact.normal_speed;
        (wet > 0.0).then_some(wet)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::wax_on_pyrex;
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    const DRY: f64 = 0.5;

    fn e_n(viscosity: f64, film_thickness: f64, normal_speed: f64) -> Option<f64> {
        let impact = Impact { normal_speed, film_thickness, diameter: 100e-6, ..Impact::default() };
        let effect = (INFO.build)(&[viscosity, 1e-7]);
        effect.normal_restitution(&impact, &wax_on_pyrex(), DRY, 0.0)
    }

    /// Newton's law with the lubrication force, integrated through a film of 10 µm and out of it
    /// again (Heun's method in the logarithm of the distance); wax, 1000 kg/m³.
    fn by_integration(viscosity: f64, speed: f64) -> f64 {
        let radius = 50e-6;
        let mass = 1000.0 * 4.0 / 3.0 * PI * f64::powi(radius, 3);
        let braked = |speed: f64| {
            let steps = 20_000;
            let [from, to] = [1e-5_f64, 1e-7].map(f64::ln);
            let step = (from - to) / f64::from(steps);
            // dv/dx = -F/(m v), F = 6 pi mu R² v / x.
            let slope = |x: f64| -6.0 * PI * viscosity * radius * radius / (mass * x) * x;
            (0..steps).fold(speed, |speed, index| {
                let log = from - step * f64::from(index);
                speed + 0.5 * step * (slope(log.exp()) + slope((log - step).exp()))
            })
        };
        braked(DRY * braked(speed)) / speed
    }

    #[test]
    fn the_film_costs_what_lubrication_says() {
        for (viscosity, speed) in [(1e-3, 5.0), (1e-3, 2.0), (1e-2, 20.0)] {
            let wet = e_n(viscosity, 1e-5, speed).unwrap();
            assert_relative_eq!(wet, by_integration(viscosity, speed), max_relative = 1e-6);
        }
    }

    /// St = rho d v/(9 mu) is 11.11 at 1 m/s and 1 mPa s; St_c = 3 ln 100 = 13.82: held up to 1.243 m/s.
    #[test]
    fn held_up_to_the_critical_stokes_number() {
        assert_eq!(e_n(1e-3, 1e-5, 1.243), None);
        assert!(e_n(1e-3, 1e-5, 1.245).is_some_and(|e_n| e_n > 0.0 && e_n < 0.01));
        assert_eq!(e_n(1e-3, 1e-5, 0.0), None);
    }

    #[test]
    fn dry_and_inviscid_walls_do_nothing() {
        assert_eq!(e_n(1e-3, 0.0, 1.0), Some(DRY));
        assert_eq!(e_n(1e-3, 1e-7, 1.0), Some(DRY));
        assert_eq!(e_n(0.0, 1e-5, 0.0), Some(DRY));
        assert_relative_eq!(e_n(1e-3, 1e-5, 1e9).unwrap(), DRY, max_relative = 1e-6);
    }
}
