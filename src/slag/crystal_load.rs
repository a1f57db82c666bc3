//! Crystals in a slag between its liquidus and its solidus, and how much they thicken it (Einstein–Roscoe).
//!
//! ```text
//! phi = (T_liquidus - T) / (T_liquidus - T_solidus)        0 above the liquidus, 1 below the solidus
//! mu / mu_liquid = (1 - 1.35 phi)^-2.5                     infinite from phi = 1/1.35 = 0.741 on
//! ```
//!
//! `phi` share of crystals [1], `T` temperature [K], `mu` viscosity of the suspension and
//! `mu_liquid` of the melt between the crystals [both Pa s].
//!
//! Source of the factor: R. Roscoe, "The viscosity of suspensions of rigid spheres", Br. J. Appl.
//! Phys. 3 (1952) 267–269, for equal spheres, of which 74 % by volume fill the space (not re-read).
//! Assumed by us: the straight line between liquidus and solidus; that the share by mass is the
//! share by volume; that the melt between the crystals keeps the composition of the slag; and
//! equilibrium, that is, a slag that has had minutes. Needles and plates thicken more than spheres.

/// Volume of the space that one volume of packed crystals fills [1].
pub const PACKING: f64 = 1.35;

/// Share of crystals [1] at a temperature, between solidus and liquidus [all K].
///
/// A liquidus at or below the solidus is a sharp melting point: 0 from the liquidus on, 1 below.
#[inline(always)]
pub fn crystal_share(temperature: f64, solidus: f64, liquidus: f64) -> f64 {
    if temperature >= liquidus {
        0.0
    } else if temperature <= solidus {
        1.0
    } else {
        (liquidus - temperature) / (liquidus - solidus)
    }
}

/// Factor [1] by which a share of crystals [1] raises the viscosity; infinite from `1/1.35` on.
#[inline(always)]
pub fn einstein_roscoe(share: f64) -> f64 {
    let room = 1.0 - PACKING * share;
    if room <= 0.0 { f64::INFINITY } else { 1.0 / (room * room * room.sqrt()) }
}

/// Temperature at and below which the crystals touch and the slag is stiff, between solidus and liquidus [all K].
pub fn stiff_temperature(solidus: f64, liquidus: f64) -> f64 {
    liquidus - (liquidus - solidus).max(0.0) / PACKING
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const SOLIDUS: f64 = 1400.0;
    const LIQUIDUS: f64 = 1670.0;

    #[test]
    fn crystals_grow_from_the_liquidus_down() {
        let share = |t| crystal_share(t, SOLIDUS, LIQUIDUS);
        assert_eq!([share(1700.0), share(LIQUIDUS), share(SOLIDUS), share(300.0)], [0.0, 0.0, 1.0, 1.0]);
        assert_relative_eq!(share(1535.0), 0.5, max_relative = 1e-15);
        assert_relative_eq!(share(1643.0), 0.1, max_relative = 1e-14);
        assert!(share(f64::NAN).is_nan());
        assert_eq!(
            [crystal_share(1500.0, 1500.0, 1500.0), crystal_share(1499.0, 1500.0, 1500.0)],
            [0.0, 1.0]
        );
    }

    /// By hand: 0.865^-2.5 = 1.437010, and 0.325^-2.5 = 16.60702. Few crystals: 1.35 * 2.5 = 3.375 times the share.
    #[test]
    fn factor_by_hand() {
        assert_eq!(einstein_roscoe(0.0), 1.0);
        assert_relative_eq!(einstein_roscoe(0.1), 1.437010, max_relative = 1e-6);
        assert_relative_eq!(einstein_roscoe(0.5), 16.60702, max_relative = 1e-6);
        assert_relative_eq!((einstein_roscoe(1e-6) - 1.0) / 1e-6, 3.375, max_relative = 1e-4);
        assert_eq!([einstein_roscoe(0.7408), einstein_roscoe(1.0)], [f64::INFINITY; 2]);
        assert!(einstein_roscoe(f64::NAN).is_nan());
    }

    /// The crystals touch at 1670 - 270/1.35 = 1470 K.
    #[test]
    fn a_slag_is_stiff_where_the_factor_is_infinite() {
        let stiff = stiff_temperature(SOLIDUS, LIQUIDUS);
        assert_relative_eq!(stiff, 1470.0, max_relative = 1e-14);
        let factor = |t| einstein_roscoe(crystal_share(t, SOLIDUS, LIQUIDUS));
        assert!(factor(stiff - 0.01).is_infinite() && factor(stiff + 0.01).is_finite());
        assert_eq!(stiff_temperature(1500.0, 1500.0), 1500.0);
        let upwards: Vec<f64> = (0..24).map(|i| factor(1471.0 + 10.0 * f64::from(i))).collect();
        assert!(upwards.windows(2).all(|pair| pair[0] >= pair[1]));
    }
}
