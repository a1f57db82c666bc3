//! Rebound of a droplet by energy balance on spreading (Mao, Kuhn & Tran 1997).
//!
//! A droplet that does not splash spreads to a disc of diameter `xi d`, where `(1/4 (1 - cos
//! theta) + 0.2 We^0.83/Re^0.33) xi³ - (We/12 + 1) xi + 2/3 = 0` (its largest root), and recoils. In units
//! of its surface energy `pi d² sigma`, what is left of the disc's surface energy beyond that of a
//! sphere and the loss of recoiling is `E = 1/4 xi² (1 - cos theta) - 0.12 xi^2.3 (1 - cos
//! theta)^0.63 + 2/(3 xi) - 1`. It leaves the wall when `E > 0`.
//!
//! `We = rho v_n² d/sigma`, `Re = rho v_n d/mu` (see [`DropletNumbers`](super::DropletNumbers)),
//! `theta` contact angle of the melt on the wall [rad], 0 (wets) to pi. The first equation is the
//! energy balance of a sphere (kinetic `We/12`, surface 1) and a flat disc of equal volume (base
//! `xi²/4 (1 - cos theta)`, rim `2/(3 xi)`), less a fitted viscous loss.
//!
//! The balance was derived again here; the fitted numbers 0.2, 0.83, 0.33, 0.12, 2.3 and 0.63 are
//! those of Mao, Kuhn & Tran, AIChE J. 43 (1997) 2169, **not re-read and without a second source**.
//! Their case: drops of some millimetres of water and sucrose solutions at 0.5 to 6 m/s on glass,
//! steel and paraffin wax, contact angles of some 30 to 120° (from memory). In agreement with other
//! work: water on wax (97°) rebounds and on glass (37°) not; aqueous drops of 30 to 50 µm on Teflon
//! begin to bounce at up to 6 m/s (McLauchlan et al., arXiv 2503.22527, abstract), where `E` is
//! -0.07 at 115° and becomes positive at 7.9 m/s.
//!
//! Restitution: if all of `E` becomes motion, `e_n = sqrt(12 E/We)`, from `m (e_n v_n)²/2 = pi d²
//! sigma E`. It is an upper bound (*assumed* to hold), as a drop that leaves still oscillates, and
//! is below 1 by the energy balance.
//!
//! Neglected: a receding contact angle below that of their walls ([`drop_pinning`](super::drop_pinning)),
//! roughness, gas under
//! the drop, freezing (see [`freezing`](super::drop_freezing)). The equation has no root with
//! `xi >= 1` for slow drops (`We` below some 1) on walls that are hardly wetted (above 109°), which in
//! truth bounce ([`drop_bounce`](super::drop_bounce) takes over from 120° on), and for very viscous
//! ones, which hardly spread: they count as deposited.

/// Largest diameter of the disc over that of the droplet, `xi` [1], from Weber and Reynolds number
/// [1] and the contact angle [rad]; `None` where the energy balance has no solution that is wider
/// than the droplet.
pub fn maximum_spread(weber: f64, reynolds: f64, contact_angle: f64) -> Option<f64> {
    let surface = 0.25 * (1.0 - contact_angle.cos());
    let cubic = surface + 0.2 * weber.powf(0.83) / reynolds.powf(0.33);
    let linear = weber / 12.0 + 1.0;
    // The largest of the three real roots, by cosines.
    let argument = (3.0 * cubic / linear).sqrt() / linear;
    let spread = 2.0 * (linear / (3.0 * cubic)).sqrt() * ((-argument).acos() / 3.0).cos();
    // An argument above 1 gives no number, and no root.
    (spread >= 1.0).then_some(spread)
}

/// Energy left for a rebound over the surface energy of the droplet, `E` [1], from the spread `xi`
/// [1] and the contact angle [rad].
pub fn excess_rebound_energy(spread: f64, contact_angle: f64) -> f64 {
    let unwetted = 1.0 - contact_angle.cos();
    let recoil_loss = 0.12 * spread.powf(2.3) * unwetted.powf(0.63);
    0.25 * spread * spread * unwetted - recoil_loss + 2.0 / (3.0 * spread) - 1.0
}

/// Longest time [s] that a drop of low viscosity stays on a wall from which it bounces, `2.6
/// sqrt(rho R³/sigma)` (Richard, Clanet & Quéré, Nature 417 (2002) 811, not re-read), close to the
/// period of a free drop's slowest oscillation, `pi/sqrt(2) sqrt(rho R³/sigma)` (Rayleigh). From
/// density [kg/m³], surface tension [N/m] and diameter [m].
pub fn contact_time(density: f64, surface_tension: f64, diameter: f64) -> f64 {
    2.6 * (density * (0.5 * diameter).powi(3) / surface_tension).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::drop_bounce::BounceNumbers;
    use super::super::drop_pinning::ContactAngles;
    use super::super::drop_restitution::drop_restitution;
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    const DEGREE: f64 = PI / 180.0;

    /// On a wall of one angle, without weight.
    fn droplet_restitution(weber: f64, reynolds: f64, contact: f64) -> Option<f64> {
        let numbers = BounceNumbers { weber, ohnesorge: weber.sqrt() / reynolds, bond: 0.0 };
        drop_restitution(&numbers, &ContactAngles { contact, receding: None })
    }

    /// The balance of the first doc comment in joules, for a drop and a disc of equal volume.
    #[test]
    fn the_spread_balances_the_energies_of_sphere_and_disc() {
        let (density, sigma, viscosity, diameter) = (1000.0, 0.072, 1e-3, 2e-3_f64);
        for (speed, degrees) in [(0.5, 37.0), (1.0, 97.0), (3.0, 120.0), (1.0, 0.0)] {
            let angle = degrees * DEGREE;
            let weber = density * speed * speed * diameter / sigma;
            let reynolds = density * speed * diameter / viscosity;
            let wide = maximum_spread(weber, reynolds, angle).unwrap() * diameter;
            let high = 2.0 * diameter.powi(3) / (3.0 * wide * wide);
            assert_relative_eq!(
                PI / 4.0 * wide * wide * high,
                PI / 6.0 * diameter.powi(3),
                max_relative = 1e-12
            );
            let arriving =
                PI / 12.0 * density * diameter.powi(3) * speed * speed + PI * diameter * diameter * sigma;
            let surface = sigma * (PI / 4.0 * wide * wide * (1.0 - angle.cos()) + PI * wide * high);
            let lost = 0.2 * weber.powf(0.83) / reynolds.powf(0.33) * PI * wide * wide * sigma;
            assert_relative_eq!(arriving, surface + lost, max_relative = 1e-9);
        }
    }

    /// By hand: We 50, Re 2000, 97°: coefficients 0.699 and 5.167, xi = 2.652, E = 0.0085.
    #[test]
    fn water_bounces_from_wax_and_stays_on_glass() {
        let spread = maximum_spread(50.0, 2000.0, 97.0 * DEGREE).unwrap();
        assert_relative_eq!(spread, 2.652, max_relative = 1e-3);
        let left = excess_rebound_energy(spread, 97.0 * DEGREE);
        assert_relative_eq!(left, 0.0085, epsilon = 1e-3);
        let e_n = droplet_restitution(50.0, 2000.0, 97.0 * DEGREE).unwrap();
        assert_relative_eq!(e_n, (12.0 * left / 50.0).sqrt(), max_relative = 1e-12);
        assert_eq!(droplet_restitution(50.0, 2000.0, 37.0 * DEGREE), None);
    }

    /// Aqueous drops of 40 µm on a hydrophobic wall: "as high as 6 m/s" (McLauchlan et al., abstract).
    #[test]
    fn microscopic_drops_bounce_above_some_metres_a_second() {
        let bounces = |speed: f64| {
            let weber = 1000.0 * speed * speed * 40e-6 / 0.072;
            droplet_restitution(weber, 1000.0 * speed * 40e-6 / 1e-3, 115.0 * DEGREE).is_some()
        };
        let first = (10..200_u8).map(|tenth| f64::from(tenth) / 10.0).find(|speed| bounces(*speed));
        assert!(first.is_some_and(|speed| (3.0..12.0).contains(&speed)), "{first:?}");
        assert!(!bounces(1.0));
    }

    /// The energy left cannot exceed the kinetic energy that came, whatever the fitted numbers say.
    #[test]
    fn no_rebound_is_faster_than_the_impact() {
        for degrees in [0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0] {
            for weber in [1e-12, 1e-3, 0.5, 3.0, 20.0, 100.0, 1e4, 1e12] {
                for reynolds in [1e-9, 1.0, 50.0, 1e3, 1e5, 1e12] {
                    let angle = degrees * DEGREE;
                    if let Some(spread) = maximum_spread(weber, reynolds, angle) {
                        let left = excess_rebound_energy(spread, angle);
                        assert!(left < weber / 12.0 * (1.0 + 1e-9), "{degrees} {weber} {reynolds}: {left}");
                    }
                    let e_n = droplet_restitution(weber, reynolds, angle);
                    assert!(e_n.is_none_or(|e_n| (0.0..=1.0).contains(&e_n)));
                }
            }
        }
    }

    #[test]
    fn what_wets_never_bounces_and_viscous_drops_do_not_either() {
        for weber in [1.0, 10.0, 100.0, 1e3] {
            for degrees in [0.0, 20.0, 30.0] {
                assert_eq!(droplet_restitution(weber, 1e3, degrees * DEGREE), None);
            }
        }
        assert!(droplet_restitution(30.0, 1e4, 150.0 * DEGREE).is_some());
        assert_eq!(droplet_restitution(30.0, 0.1, 150.0 * DEGREE), None);
    }

    /// Water of 2 mm: 9.7 ms, against 2.221 of Rayleigh's 2.6.
    #[test]
    fn the_contact_time_is_near_the_period_of_a_free_drop() {
        let time = contact_time(1000.0, 0.072, 2e-3);
        let rayleigh = 2.0 * PI * f64::sqrt(1000.0 * 1e-9 / (8.0 * 0.072));
        assert_relative_eq!(time, 9.69e-3, max_relative = 1e-3);
        assert!((1.0..1.3).contains(&(time / rayleigh)));
    }
}
