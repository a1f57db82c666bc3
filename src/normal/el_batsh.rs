//! El-Batsh & Haselbacher: Brach & Dunn's critical velocity with a Young's modulus that falls with temperature.
//!
//! ```text
//! E_Y  = 3e20 exp(-0.02365 T) Pa,  of particle and wall alike;  nu = 0.27
//! v_cr = (2 S/d)^(10/7),  S = 0.51 (5 pi² (k1+k2)/(4 rho^1.5))^(2/5),  k = (1-nu²)/(pi E_Y)
//! ```
//!
//! Up to `v_cr` [m/s] the particle sticks, above it rebounds with the given `e_n` [1]. `T` [K]
//! temperature, `d` diameter [m], `rho` density of the particle [kg/m³], `nu` Poisson's ratio [1].
//!
//! Sources: H. El-Batsh, H. Haselbacher, "Numerical investigation of the effect of ash particle
//! deposition on the flow field through turbine cascades", ASME GT-2002-30600; the modulus is a
//! later fit to deposits of coal ash (Ai & Fletcher, Brigham Young University, about 2008). Neither
//! was re-read; all numbers here agree with a published Fluent function of that model, which takes
//! the mean temperature of gas and surface. Here `T` is the mean of particle and wall (assumed): an
//! impact does not know the gas. That function rebounds with 0.8 along the normal and 0.4 along the
//! wall, for any speed above `v_cr`; there is no default here.
//!
//! Fitted to ash of 1 to 20 µm on turbine vanes of 1100 to 1500 K (range from memory). Below it the
//! modulus exceeds that of any solid (1.3e12 Pa at 815 K), so that nothing sticks.

use std::f64::consts::PI;

use super::brach_dunn::critical_velocity;
use super::{Contact, ListedNormalLaw};
use crate::impact::Impact;
use crate::law::{FitLimit, Origin, Parameter, ParameterValues, QuantityKind, Search};

/// Poisson's ratio of particle and wall [1].
const POISSON_RATIO: f64 = 0.27;

/// The law.
pub(super) static EL_BATSH: ListedNormalLaw = ListedNormalLaw {
    name: "el-batsh",
    origin: &Origin {
        source: "El-Batsh & Haselbacher 2002; modulus of Ai & Fletcher",
        case: "coal ash on hot turbine vanes",
        range: &[FitLimit::diameter(1e-6, 20e-6), FitLimit::temperature(1100.0, 1500.0)],
    },
    parameters: &[Parameter::new("e_n", "1", (0.0, 1.0), Search::Linear(0.02, 1.0))
        .kind(QuantityKind::Share)
        .about("normal restitution above the critical velocity")],
    restitution: |impact, contact, values| {
        (impact.normal_speed > critical(impact, contact, values)).then_some(values[0])
    },
    sticking_velocity: Some(critical),
};

fn critical(impact: &Impact, contact: &Contact, _: &ParameterValues) -> f64 {
    let modulus = 3e20 * (-0.02365 * impact.mean_temperature()).exp();
    let compliance = 2.0 * (1.0 - POISSON_RATIO * POISSON_RATIO) / (PI * modulus);
    critical_velocity(impact.diameter, contact.density, compliance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// By hand at 1300 K, 5 µm, 2500 kg/m³: E_Y = 3e20 e^-30.745 = 1.332715e7 Pa; k1+k2 =
    /// 2*0.9271/(pi E_Y) = 4.428629e-8/Pa; 5 pi² (k1+k2)/5e5 = 4.370882e-12, to the 0.4:
    /// 2.859088e-5; S = 1.458135e-5; 2S/d = 5.832541; v_cr = 12.41888 m/s.
    #[test]
    fn the_critical_velocity_by_hand() {
        let impact = Impact {
            diameter: 5e-6,
            particle_temperature: 1250.0,
            wall_temperature: 1350.0,
            ..Impact::default()
        };
        let contact = Contact { density: 2500.0, ..Contact::default() };
        assert_relative_eq!(critical(&impact, &contact, &[0.8; 4]), 12.41888, max_relative = 1e-6);
        let at =
            |normal_speed| (EL_BATSH.restitution)(&Impact { normal_speed, ..impact }, &contact, &[0.8; 4]);
        assert_eq!([at(12.0), at(13.0)], [None, Some(0.8)]);
    }
}
