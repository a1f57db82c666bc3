//! An elastic sphere with a compliant contact and friction hits a plane: integration over time.
//!
//! The problem of Maw, Barber & Fawcett (Wear 38 (1976) 101): Hertz's contact along the normal,
//! Mindlin's stiffness along the wall, Coulomb friction at every point of the contact, so that an
//! outer ring slips while the middle sticks. It is solved by the mapping of a round contact to a
//! row of independent springs (Popov & Heß, Method of Dimensionality Reduction, 2015), which is
//! exact for Hertz's normal contact and, for any history of loads, for the partial slip of Cattaneo
//! and Mindlin: the spring at `x` carries `E* dx (delta - x²/R)` along the normal and `k E* dx
//! w(x)` along the wall, no more than `f` times the former; `w` is its stretch, which follows the
//! slip until friction gives. A spring that leaves the contact forgets its stretch.
//!
//! `delta` approach [m], `E*` reduced modulus [Pa], `k` Mindlin's ratio of tangential to normal
//! stiffness [1], `f` friction [1], `s = u - omega d/2` slip speed [m/s]. SlipMotion: `m
//! d²delta/dt² = -F_n`, `m du/dt = -F_t`, `m ds/dt = -(7/2) F_t` (sphere). What comes out depends
//! on `k` and on `psi = k s/(f v_n)` alone; units are chosen so that mass, `v_n`, `R` and `E*` are
//! one.
//!
//! Limits: elastic (`e_n = 1`), quasi-static, similar materials in the sense that normal and
//! tangential tractions do not couple (exact for equal solids, or Poisson's ratio one half),
//! friction the same at rest and in motion.

/// A contact and how finely it is integrated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompliantSphere {
    /// Mindlin's `k` [1].
    pub stiffness_ratio: f64,
    /// Springs over the radius of the largest contact.
    pub springs: usize,
    /// Steps of time over the impact, about.
    pub steps: usize,
}

/// How it leaves, in units of the slip before the impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompliantRebound {
    /// Tangential impulse over mass and slip speed before [1]: `(u - u')/s`.
    pub impulse: f64,
    /// Slip after over slip before [1]; negative where the slip is reversed.
    pub slip: f64,
    /// Normal restitution [1]: 1 but for the steps of time.
    pub normal_restitution: f64,
    /// Tangential kinetic energy (speed and spin) lost over what the slip could give, `(1/7) s²` per mass [1]: 0 to 1.
    pub energy_lost: f64,
}

impl CompliantRebound {
    /// Tangential restitution [1] of a sphere that came without spin.
    pub fn tangential_restitution(&self) -> f64 {
        1.0 - self.impulse
    }
}

/// Approach and contact of mass one, `v_n` one, `R` one, `E*` one at the deepest point: `8/15 delta^(5/2) = 1/2`.
const DEEPEST: f64 = 0.974_514_96;

impl CompliantSphere {
    /// The impact with the friction `f` [1] and a slip before it of `slip` [1] times `v_n`.
    pub fn impact(&self, friction: f64, slip: f64) -> CompliantRebound {
        let radius = DEEPEST.sqrt() * 1.02;
        let width = radius / self.springs as f64;
        // Springs lie on both sides of the middle: each stands for two. Midpoints, so that half widths count.
        let places: Vec<f64> = (0..self.springs).map(|i| ((i as f64 + 0.5) * width).powi(2)).collect();
        let mut stretch = vec![0.0; self.springs];
        let mut forces = |depth: f64, moved: f64| {
            let (mut normal, mut tangential) = (0.0, 0.0);
            for (place, stretch) in places.iter().zip(&mut stretch) {
                let press = depth - place;
                if press <= 0.0 {
                    *stretch = 0.0;
                    continue;
                }
                let most = friction * press / self.stiffness_ratio;
                *stretch = (*stretch + moved).clamp(-most, most);
                normal += press;
                tangential += *stretch;
            }
            [2.0 * width * normal, 2.0 * width * self.stiffness_ratio * tangential]
        };
        // Hertz: the contact lasts 2.9432 deepest/v_n.
        let step = 2.9432 * DEEPEST / self.steps as f64;
        let mut motion = SlipMotion { depth: 0.0, approach: 1.0, slip, impulse: 0.0 };
        let mut force = [0.0; 2];
        loop {
            // Velocity Verlet.
            motion.kick(force, 0.5 * step);
            motion.depth += motion.approach * step;
            if motion.depth <= 0.0 {
                break;
            }
            force = forces(motion.depth, motion.slip * step);
            motion.kick(force, 0.5 * step);
        }
        let impulse = motion.impulse / slip;
        CompliantRebound {
            impulse,
            slip: motion.slip / slip,
            normal_restitution: -motion.approach,
            // Energy per mass: u²/2 + omega² d²/20 changes by -s J + 7/4 J².
            energy_lost: (impulse - 1.75 * impulse * impulse) * 7.0,
        }
    }

    /// Tangential force over friction times normal force [1] when the contact is pressed to `depth`
    /// and then sheared by `shear` (both in units of `R`), standing still: for comparison with
    /// Mindlin.
    pub fn sheared(&self, friction: f64, depth: f64, shear: f64) -> f64 {
        let width = depth.sqrt() / self.springs as f64;
        let (mut normal, mut tangential) = (0.0, 0.0);
        for index in 0..self.springs {
            let press = depth - ((index as f64 + 0.5) * width).powi(2);
            normal += press;
            tangential += (self.stiffness_ratio * shear).min(friction * press);
        }
        tangential / (friction * normal)
    }
}

struct SlipMotion {
    depth: f64,
    approach: f64,
    slip: f64,
    impulse: f64,
}

impl SlipMotion {
    fn kick(&mut self, [normal, tangential]: [f64; 2], time: f64) {
        self.approach -= normal * time;
        self.slip -= 3.5 * tangential * time;
        self.impulse += tangential * time;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sphere(stiffness_ratio: f64) -> CompliantSphere {
        CompliantSphere { stiffness_ratio, springs: 200, steps: 2000 }
    }

    #[test]
    fn deepest_is_hertz() {
        assert!((8.0 / 15.0 * f64::powf(DEEPEST, 2.5) - 0.5).abs() < 1e-6);
    }

    /// Mindlin: `F_t = f F_n (1 - (1 - k shear/(f depth))^(3/2))` until all of the contact slips.
    #[test]
    fn shear_at_rest_is_mindlins() {
        for shear in [0.001, 0.004, 0.01, 0.02, 0.1] {
            let share: f64 = 0.7 * shear / (0.3 * 0.04);
            let expected = 1.0 - (1.0 - share.min(1.0)).powf(1.5);
            let ours = sphere(0.7).sheared(0.3, 0.04, shear);
            assert!((ours - expected).abs() < 1e-4, "{shear}: {ours} against {expected}");
        }
    }

    #[test]
    fn without_friction_nothing_happens_and_the_normal_impact_is_elastic() {
        let left = sphere(0.7).impact(0.0, 1.0);
        assert_eq!(left.impulse, 0.0);
        assert!((left.normal_restitution - 1.0).abs() < 1e-3, "{left:?}");
    }

    /// Gross slip: from `psi = 7k - 1` on friction acts through the whole contact, `J = 2 f v_n`; below it, less.
    #[test]
    fn gross_slip_begins_where_maw_barber_and_fawcett_say() {
        for k in [0.667, 0.75, 1.0] {
            let impulse = |psi: f64| {
                let slip = psi * 0.3 / k;
                sphere(k).impact(0.3, slip).impulse * slip / (2.0 * 0.3)
            };
            for above in [1.01, 1.5, 4.0] {
                let share = impulse(above * (7.0 * k - 1.0));
                assert!((share - 1.0).abs() < 2e-3, "k = {k}: {share}");
            }
            assert!(impulse(0.9 * (7.0 * k - 1.0)) < 0.998);
        }
    }

    /// A contact without tangential stiffness takes nothing; a very stiff one is the rigid sphere,
    /// which leaves rolling. What is left to swing falls with `1/sqrt(k)`, its period.
    #[test]
    fn soft_and_stiff_limits() {
        assert!(sphere(1e-5).impact(0.3, 0.5).impulse < 1e-3);
        let away = |k: f64| {
            let fine = CompliantSphere { stiffness_ratio: k, springs: 200, steps: 20_000 };
            (fine.impact(0.3, 1.0).tangential_restitution() - 5.0 / 7.0).abs()
        };
        let (stiff, stiffer) = (away(30.0), away(3000.0));
        assert!(stiff < 0.02 && stiffer < 0.2 * stiff, "{stiff} {stiffer}");
    }

    #[test]
    fn energy_is_never_made_and_only_the_ratio_psi_counts() {
        for psi in [0.01, 0.5, 1.0, 1.5, 2.0, 3.0, 3.7, 5.0] {
            let at = |friction: f64| sphere(0.676).impact(friction, psi * friction / 0.676);
            let (one, other) = (at(0.28), at(0.05));
            assert!(one.energy_lost > -1e-3, "{psi}: {one:?}");
            assert!((one.impulse - other.impulse).abs() < 1e-9, "{psi}");
        }
    }
}
