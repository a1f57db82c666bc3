//! `oka`: erosion fitted over the hardness of metals, for three kinds of particles.
//!
//! `E = g E_90` [mm³ of wall per kg of particles], `E_90 = K Hv^k1 (v/v')^k2 (d/d')^k3`, `g = (sin
//! a)^n1 (1 + Hv (1 - sin a))^n2`, `n1 = s1 Hv^q1`, `n2 = s2 Hv^q2`, `k2 = k Hv^r`. `Hv` Vickers
//! hardness of the wall [GPa] (`hardness` [Pa] in the model file), `v` impact speed [m/s], `a`
//! angle between path and surface, `d` diameter of the particle. `particles` chooses the constants:
//!
//! | `particles` | `K` | `k1` | `k` | `r` | `k3` | `v'` [m/s] | `d'` [µm] | `s1` | `q1` | `s2` | `q2` |
//! |---|---|---|---|---|---|---|---|---|---|---|---|
//! | `silica` (default) | 65 | -0.12 | 2.3 | 0.038 | 0.19 | 104 | 326 | 0.71 | 0.14 | 2.4 | -0.94 |
//! | `silicon-carbide` | 45 | -0.05 | 3.0 | 0.085 | 0.19 | 99 | 326 | 0.71 | 0.14 | 2.8 | -1.00 |
//! | `glass-beads` | 27 | -0.16 | 2.1 | 0 | 0.19 | 100 | 200 | 2.8 | 0.41 | 2.6 | -1.46 |
//!
//! Oka, Okamura and Yoshida, Wear 259 (2005) 95; Oka and Yoshida, Wear 259 (2005) 102. Second
//! sources: the form in the manual of EDEM ("Oka wear model"); `K`, `k1`, `k2`, `k3`, `v'`, `d'` of
//! all three in the public code `gemini_model`, `K = 65 mm³/kg` also as default of COMSOL. `s1` to
//! `q2` are from memory of the first paper, not re-read: for sand on steel of 1.8 GPa they give `n1
//! = 0.77`, `n2 = 1.38`, where the Fluent manual has 0.8 and 1.3 (and `k2` = 2.35 as here). Its
//! `E_90`, 6.154e-4 kg/kg, is 79 mm³/kg for steel of 7800 kg/m³, where these constants give 61.
//!
//! Case of the fit: metals of 0.2 to 8 GPa at room temperature, jets of angular silica and silicon
//! carbide and of glass beads, speeds of 50 to 170 m/s (range from memory). Far below these speeds,
//! as in most furnaces, the power of the speed is an extrapolation.

use std::sync::Arc;

use super::{Erosion, ErosionLaw, required_strength};
use crate::impact::Impact;
use crate::input::{InputError, Section};

pub(super) static OKA: ErosionLaw = ErosionLaw { name: "oka", read };

/// Constants of one kind of particles, in the units of the fit.
#[derive(Debug)]
struct Particles {
    name: &'static str,
    /// `K` [mm³/kg] and `k1`.
    rate: [f64; 2],
    /// `k` and `r` of `k2`, and `v'` [m/s].
    speed: [f64; 3],
    /// `k3` and `d'` [m].
    diameter: [f64; 2],
    /// `s1`, `q1`, `s2`, `q2`.
    angle: [f64; 4],
}

static PARTICLES: [Particles; 3] = [
    Particles {
        name: "silica",
        rate: [65.0, -0.12],
        speed: [2.3, 0.038, 104.0],
        diameter: [0.19, 326e-6],
        angle: [0.71, 0.14, 2.4, -0.94],
    },
    Particles {
        name: "silicon-carbide",
        rate: [45.0, -0.05],
        speed: [3.0, 0.085, 99.0],
        diameter: [0.19, 326e-6],
        angle: [0.71, 0.14, 2.8, -1.0],
    },
    Particles {
        name: "glass-beads",
        rate: [27.0, -0.16],
        speed: [2.1, 0.0, 100.0],
        diameter: [0.19, 200e-6],
        angle: [2.8, 0.41, 2.6, -1.46],
    },
];

#[derive(Debug)]
struct Oka {
    /// Vickers hardness [GPa].
    hardness: f64,
    particles: &'static Particles,
}

fn read(section: &Section<'_>) -> Result<Arc<dyn Erosion>, InputError> {
    let hardness = required_strength(section, "hardness", "Vickers hardness of the wall [Pa]")? / 1e9;
    let given = section.choice("particles", &PARTICLES.each_ref().map(|kind| kind.name))?;
    let [silica, ..] = &PARTICLES;
    let kind = PARTICLES.iter().find(|kind| given.as_deref() == Some(kind.name));
    Ok(Arc::new(Oka { hardness, particles: kind.unwrap_or(silica) }))
}

impl Erosion for Oka {
    fn volume_per_mass(&self, impact: &Impact) -> f64 {
        let speed = impact.speed();
        if speed == 0.0 {
            return 0.0;
        }
        let (hardness, Particles { rate, speed: of_speed, diameter, angle, .. }) =
            (self.hardness, self.particles);
        let sine = impact.normal_speed / speed;
        let head_on = rate[0]
            * hardness.powf(rate[1])
            * (speed / of_speed[2]).powf(of_speed[0] * hardness.powf(of_speed[1]))
            * (impact.diameter / diameter[1]).powf(diameter[0]);
        let cutting = 1.0 + hardness * (1.0 - sine);
        let of_angle =
            sine.powf(angle[0] * hardness.powf(angle[1])) * cutting.powf(angle[2] * hardness.powf(angle[3]));
        1e-9 * head_on * of_angle
    }

    fn describe(&self) -> String {
        format!("oka, hardness {} Pa, particles {}", 1e9 * self.hardness, self.particles.name)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{at, model};
    use crate::impact::Impact;
    use approx::assert_relative_eq;

    fn eroded(hardness: f64, particles: &str, impact: &Impact) -> f64 {
        let text = format!("[erosion]\nlaw = \"oka\"\nhardness = {hardness}\n{particles}");
        1e9 * model(&text).erosion(0, impact, 1.0).unwrap()
    }

    /// At the reference state and 1 GPa, `E_90` is `K` for each kind of particles.
    #[test]
    fn the_reference_state_gives_the_leading_constant() {
        for (kind, speed, diameter, rate) in [
            ("silica", 104.0, 326e-6, 65.0),
            ("silicon-carbide", 99.0, 326e-6, 45.0),
            ("glass-beads", 100.0, 200e-6, 27.0),
        ] {
            let found =
                eroded(1e9, &format!("particles = \"{kind}\"\n"), &Impact { diameter, ..at(speed, 90.0) });
            assert_relative_eq!(found, rate, max_relative = 1e-12);
        }
    }

    /// Worked by hand for sand on steel of 1.8 GPa: `n1` = 0.770897, `n2` = 1.381195, `k2` =
    /// 2.351951, so at 30° and 52 m/s `E_90` = 65 * 0.931896 * 0.195881 = 11.865143 and `g` =
    /// 0.586053 * 2.426684 = 1.422165.
    #[test]
    fn volumes_are_those_by_hand() {
        let found = eroded(1.8e9, "", &Impact { diameter: 326e-6, ..at(52.0, 30.0) });
        assert_relative_eq!(found, 16.874_19, max_relative = 1e-6);
    }

    /// A hard metal loses most at oblique impact of some 20° to 40°, a soft one as well; at 0° nothing.
    #[test]
    fn erosion_peaks_at_oblique_impact() {
        let at_angle = |degrees| eroded(1.8e9, "", &at(50.0, degrees));
        assert_eq!(at_angle(0.0), 0.0);
        assert!(at_angle(30.0) > at_angle(90.0) && at_angle(30.0) > at_angle(5.0));
    }
}
