//! `finnie`: erosion of a ductile metal by cutting.
//!
//! `Q = m v²/(p psi K) (sin 2a - 6/K sin² a)` for `tan a <= K/6`, and `Q = m v²/(6 p psi) cos² a`
//! above. `Q` volume removed [m³], `m` mass of the particles [kg], `v` impact speed [m/s], `a`
//! angle between path and surface, `p` plastic flow stress of the wall (`flow_stress` [Pa]), `psi`
//! ratio of the length of contact to the depth of cut (`depth_ratio` [1], default 2), `K` ratio of
//! the vertical to the horizontal force on the particle (`force_ratio` [1], default 2).
//!
//! Finnie, "Erosion of surfaces by solid particles", Wear 3 (1960) 87. Second source: the cloud
//! function `particleErosion` of OpenFOAM (keys `p`, `psi`, `K` with the same defaults), which
//! names Finnie and McFadden, Wear 48 (1978) 181, and Finnie, Levy and McFadden, ASTM STP 664
//! (1979) 36; the same sums come out (`tests/openfoam/run erosion`).
//!
//! Case of the fit: angular silicon carbide on ductile metals at room temperature, shallow angles.
//! Finnie multiplies by the share of the particles that cut (0.1 to 0.5); here, as in OpenFOAM,
//! that share is part of `p`. Limits: nothing is removed at 90°, where real metals lose about a
//! third of their maximum; measured exponents of the speed are 2.3 to 2.5. Not for brittle walls
//! (refractory).

use std::sync::Arc;

use super::{Erosion, ErosionLaw, required_strength};
use crate::impact::Impact;
use crate::input::{InputError, Section};

pub(super) static FINNIE: ErosionLaw = ErosionLaw { name: "finnie", read };

#[derive(Debug)]
struct Finnie {
    flow_stress: f64,
    depth_ratio: f64,
    force_ratio: f64,
}

fn read(section: &Section<'_>) -> Result<Arc<dyn Erosion>, InputError> {
    let ratio = |key| Ok(section.number_within(key, 0.01, 100.0)?.unwrap_or(2.0));
    Ok(Arc::new(Finnie {
        flow_stress: required_strength(section, "flow_stress", "plastic flow stress of the wall [Pa]")?,
        depth_ratio: ratio("depth_ratio")?,
        force_ratio: ratio("force_ratio")?,
    }))
}

impl Erosion for Finnie {
    fn volume_per_mass(&self, impact: &Impact) -> f64 {
        let (normal, along) = (impact.normal_speed, impact.tangential_speed);
        let (flow_stress, ratio) = (self.flow_stress, self.force_ratio);
        // v sin a = v_n and v cos a = v_t, so that no angle is needed.
        let cut = if normal <= along * ratio / 6.0 {
            (2.0 * along - 6.0 / ratio * normal) * normal / ratio
        } else {
            along * along / 6.0
        };
        cut / (flow_stress * self.depth_ratio)
    }

    fn describe(&self) -> String {
        let Self { flow_stress, depth_ratio, force_ratio } = self;
        format!("finnie, flow stress {flow_stress} Pa, depth ratio {depth_ratio}, force ratio {force_ratio}")
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{at, model};
    use approx::assert_relative_eq;

    fn eroded(speed: f64, degrees: f64) -> f64 {
        model("[erosion]\nlaw = \"finnie\"\nflow_stress = 1e9\n")
            .erosion(0, &at(speed, degrees), 1.0)
            .unwrap()
    }

    /// By hand with psi = K = 2: 1 kg at 100 m/s has m v²/(p psi K) = 2.5e-6 m³. At 15° times sin
    /// 30° - 3 sin² 15° = 0.299038106; at 60° times 2/6 cos² 60° = 1/12.
    #[test]
    fn volumes_are_those_by_hand() {
        assert_relative_eq!(eroded(100.0, 15.0), 2.5e-6 * 0.299_038_106, max_relative = 1e-8);
        assert_relative_eq!(eroded(100.0, 60.0), 2.5e-6 / 12.0, max_relative = 1e-14);
        assert!(eroded(100.0, 90.0) < 1e-30);
    }

    /// The two branches meet at tan a = K/6, and the maximum lies at tan 2a = K/3 (16.8°), below that angle (18.4°).
    #[test]
    fn the_maximum_lies_where_finnie_puts_it() {
        let change = (1.0_f64 / 3.0).atan().to_degrees();
        assert_relative_eq!(eroded(50.0, change - 1e-9), eroded(50.0, change + 1e-9), max_relative = 1e-8);
        let most = 0.5 * (2.0_f64 / 3.0).atan().to_degrees();
        assert!((16.8..16.9).contains(&most));
        assert!((0..=900).all(|tenths| eroded(50.0, f64::from(tenths) / 10.0) <= eroded(50.0, most)));
    }
}
