//! A rigid sphere with spin hits a plane with Coulomb friction: integration over the normal impulse.
//!
//! Routh's method (E. J. Routh, Dynamics of a System of Rigid Bodies, 1860; W. J. Stronge, Impact Mechanics, 2000): the
//! impulse `p` of the wall per mass [m/s] grows from 0 to `(1+e_n) v_n` and takes the place of time. While the contact
//! point slips, `du = -f sign(s) dp` and `d omega = 5 f sign(s) dp/d`, with `s = u - omega d/2` the slip; the friction
//! follows the slip as it changes. Where the slip vanishes the contact sticks: for a sphere no tangential impulse is
//! then needed (normal and tangential motion are not coupled), so that any friction holds it and slip never reverses.
//!
//! `u` speed along the wall [m/s], `omega` spin [rad/s], positive when it rolls forward, `d`
//! diameter [m], `f` friction [1]. Limits: no compliance of the contact, no rolling friction.

/// A sphere as it arrives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidSphere {
    /// Speed towards the wall `v_n` [m/s].
    pub normal_speed: f64,
    /// Speed along the wall `u` [m/s].
    pub tangential_speed: f64,
    /// Spin [rad/s].
    pub spin: f64,
    /// Diameter [m].
    pub diameter: f64,
}

/// How it leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidRebound {
    /// Speed along the wall [m/s].
    pub tangential_speed: f64,
    /// Spin [rad/s].
    pub spin: f64,
    /// Whether the contact point stopped slipping.
    pub sticks: bool,
    /// How often the slip changed its sign.
    pub reversals: u32,
}

impl RigidSphere {
    /// The impact in `steps` steps of the normal impulse, with friction `f` [1] and normal restitution `e_n` [1].
    pub fn impact(&self, friction: f64, normal_restitution: f64, steps: u32) -> RigidRebound {
        let step = (1.0 + normal_restitution) * self.normal_speed / f64::from(steps);
        let slip = |u: f64, spin: f64| u - 0.5 * self.diameter * spin;
        // What rounding leaves of a slip that has stopped.
        let none = 1e-9 * slip(self.tangential_speed, self.spin).abs();
        let mut left = RigidRebound {
            tangential_speed: self.tangential_speed,
            spin: self.spin,
            sticks: false,
            reversals: 0,
        };
        for _ in 0..steps {
            let before = slip(left.tangential_speed, left.spin);
            // What friction may do in this step, and what stopping the slip takes: a unit of
            // impulse changes u by one and d omega/2 by 5/2.
            let to_stick = before / (1.0 + 2.5);
            let change = (friction * step).min(to_stick.abs()).copysign(before);
            left.sticks = to_stick.abs() <= friction * step;
            left.tangential_speed -= change;
            left.spin += 5.0 * change / self.diameter;
            let after = slip(left.tangential_speed, left.spin);
            left.reversals += u32::from(before * after < 0.0 && after.abs() > none);
        }
        left
    }

    /// Kinetic energy per mass [m²/s²] of a motion along the wall with a spin: `u²/2 + omega² d²/20`.
    pub fn energy(&self, tangential_speed: f64, spin: f64) -> f64 {
        0.5 * tangential_speed.powi(2) + (spin * self.diameter).powi(2) / 20.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(ours: f64, expected: f64) {
        assert!((ours - expected).abs() < 1e-11 * (1.0 + expected.abs()), "{ours} against {expected}");
    }

    /// Angular momentum about the contact point, `u + omega d/5`, has no torque; a sphere that sticks rolls.
    #[test]
    fn it_keeps_its_angular_momentum_and_rolls_when_it_sticks() {
        for spin in [-40.0, -3.0, 0.0, 5.0, 60.0] {
            for friction in [0.0, 0.05, 0.3, 3.0] {
                let sphere = RigidSphere { normal_speed: 1.0, tangential_speed: 2.0, spin, diameter: 0.1 };
                let left = sphere.impact(friction, 0.6, 500);
                near(left.tangential_speed + 0.02 * left.spin, 2.0 + 0.02 * spin);
                assert!(sphere.energy(left.tangential_speed, left.spin) <= sphere.energy(2.0, spin) + 1e-12);
                assert_eq!(left.reversals, 0);
                if left.sticks {
                    near(left.tangential_speed, 0.05 * left.spin);
                }
            }
        }
    }

    /// Any number of steps gives the same: friction does not depend on the speed.
    #[test]
    fn steps_do_not_matter() {
        let sphere = RigidSphere { normal_speed: 1.0, tangential_speed: 1.5, spin: -7.0, diameter: 0.1 };
        let [coarse, fine] = [3, 3000].map(|steps| sphere.impact(0.25, 0.5, steps));
        near(coarse.tangential_speed, fine.tangential_speed);
        near(coarse.spin, fine.spin);
    }
}
