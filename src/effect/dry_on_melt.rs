//! `dry-on-melt`: a dry particle on molten slag sinks, is held by surface tension, or bounces.
//!
//! The energy of the impact against viscosity and surface tension decides, as
//! `src/capture/rebound_from_slag.rs` derives it: drag over one diameter in and one out brakes the
//! particle; it is held when what is left does not pull it out of the surface, `pi R² sigma (1 +
//! cos theta)²`, and it sinks when what is left on the way in submerges it. Otherwise it leaves
//! with `e_n = sqrt(v_out² - 2 W/m)/v_n`. On a melt of more than some 0.1 Pa s drag holds every
//! particle below 0.1 mm.
//!
//! `theta` [degrees] contact angle of the melt on the particle, measured through the melt; slag on char is said to be
//! between 90 and 160 (assumed; see there). The stickiness `P_s` of the slag stays the probability that it acts
//! as a liquid in this impact; where it does not, the particle rebounds from it as from a solid. The melt's viscosity,
//! density and surface tension are those of the wall's slag, or of the melt that earlier particles left, at the wall's
//! temperature; a melt without a surface tension has no such law. The particle's own stickiness and the wall's
//! ([`crate::capture::Combination`]) stay: this effect says what a liquid wall does to what is dry. Valid for smooth
//! spheres small against the depth of the melt.

use super::{Effect, EffectInfo, OnMelt, Parameter, Precomputed, QuantityKind, Search};
use crate::capture::{rebound_from_slag, sinks_into_slag};
use crate::impact::Impact;
use crate::normal::Contact;

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "dry-on-melt",
    about: "a dry particle on molten slag sinks, is held by surface tension, or bounces",
    inputs: &["v_n", "d", "T_w"],
    stream: None,
    parameters: &[Parameter::new("contact_angle", "degrees", (0.0, 180.0), Search::Linear(60.0, 170.0))
        .kind(QuantityKind::Angle)
        .about("contact angle of the melt on the particle, through the melt")],
    build: |values| Box::new(DryOnMelt { cosine: values[0].to_radians().cos() }),
};

/// The effect, prepared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DryOnMelt {
    /// Cosine of the contact angle [1].
    cosine: f64,
}

impl DryOnMelt {
    /// Normal restitution [1] of a particle of a density [kg/m³] on melt of a viscosity [Pa s] and
    /// a surface tension [N/m]; 0 when it stays. Without branches, for vectors.
    #[inline(always)]
    pub(crate) fn rebound(&self, impact: &Impact, density: f64, viscosity: f64, surface_tension: f64) -> f64 {
        rebound_from_slag(
            [impact.diameter, density, impact.normal_speed],
            [viscosity, surface_tension],
            self.cosine,
        )
    }
}

impl Effect for DryOnMelt {
    fn uses_melt(&self) -> bool {
        true
    }

    fn on_melt(&self, impact: &Impact, contact: &Contact) -> Option<OnMelt> {
        let melt = contact.melt?.molten()?;
        let e_n = self.rebound(impact, contact.density, melt.viscosity, melt.surface_tension);
        if e_n > 0.0 {
            return Some(OnMelt::Rebounds(e_n));
        }
        let particle = [impact.diameter, contact.density, impact.normal_speed];
        let sinks = sinks_into_slag(particle, [melt.viscosity, melt.surface_tension], self.cosine);
        Some(if sinks { OnMelt::Sinks } else { OnMelt::Held })
    }

    fn precompute(&self) -> Option<Precomputed> {
        Some(Precomputed::OnMelt(*self))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::wax_on_pyrex;
    use super::*;
    use crate::deposit::WallMelt;

    fn on_melt(viscosity: f64, normal_speed: f64, contact_angle: f64) -> Option<OnMelt> {
        let melt = WallMelt { density: 2750.0, viscosity, surface_tension: Some(0.55) };
        let contact = Contact { density: 700.0, melt: Some(melt), ..wax_on_pyrex() };
        let impact = Impact { normal_speed, diameter: 75e-6, ..Impact::default() };
        (INFO.build)(&[contact_angle]).on_melt(&impact, &contact)
    }

    /// Drag on slag of 1 Pa s takes 18/(700 * 75e-6) = 343 m/s each way. Without drag, by hand for
    /// 75 µm and 120 degrees: submerging takes v² = 3 sigma (1.5)²/(rho d) = 70.7 m²/s², 8.41 m/s;
    /// detaching a ninth of that, 7.86 m²/s², 2.80 m/s.
    #[test]
    fn viscous_slag_holds_and_thin_slag_lets_go() {
        assert_eq!(on_melt(1.0, 100.0, 120.0), Some(OnMelt::Held));
        assert_eq!(on_melt(1.0, 353.0, 120.0), Some(OnMelt::Sinks));
        assert_eq!(on_melt(1e-12, 2.7, 120.0), Some(OnMelt::Held));
        let leaves = on_melt(1e-12, 3.0, 120.0);
        assert!(matches!(leaves, Some(OnMelt::Rebounds(e_n)) if (e_n - 0.356).abs() < 0.005), "{leaves:?}");
        assert_eq!(on_melt(1e-12, 8.5, 120.0), Some(OnMelt::Sinks));
        // What the melt wets it keeps.
        assert_eq!(on_melt(1e-9, 3.0, 0.0), Some(OnMelt::Sinks));
    }
}
