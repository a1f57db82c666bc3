//! A rigid doublet: two equal spheres that hit a smooth plane as one body.
//!
//! Each sphere has the mass `m` and the radius `R`; the doublet has the mass `M = 2 m` and, about
//! an axis across the line of centres, the moment of inertia `I = 2 (2/5 m R² + m R²) = 14/5 m R²`.
//! Without friction the wall pushes along its normal only. The end that hits has its centre at the
//! lever arm `b = R sin(phi)` beside the common centre (`phi` is the angle of the line of centres
//! from the normal), and closes on the wall with the speed `c`:
//! - effective mass `1/m* = 1/M + b²/I`, so `m*/m = 1/(1/2 + 5/14 sin²(phi))`, from 2 end-on to 7/6 flat;
//! - impulse `J = (1 + e) c m*`; the centre gains `J/M` away from the wall, the spin `J b/I`;
//! - between hits the body flies and turns freely; the ends hit in turn until it leaves.
//!
//! Without spin and with a single hit the centre of mass has `e_cm = (1 + e)/(1 + M b²/I) - 1`,
//! below `e`: the difference turns the doublet, and a second hit of the other end may return part
//! of it.
//!
//! The contact is that of one sphere of radius `R` with the mass `m*` in place of `m`. `v_y` and
//! `v_adh` of Thornton & Ning are proportional to `m^(-1/2)` at a given `R`, so they are those of a
//! sphere of density `rho m*/m` ([`contact_restitution`]).
//!
//! Symbols: `e` contact restitution [1], `v` speed of the centre [m/s], `omega` spin [rad/s].
//! Rigid-body mechanics (Newton's impulse law at each contact), no fit. Valid for a neck that
//! neither bends nor breaks, contacts short against one turn, and smooth walls. Limits: without
//! friction neither the speed along the wall nor the spin about the line of centres changes (the
//! latter is left out); flat impacts hit the two ends in turn rather than at once; gravity is left
//! out.

use std::f64::consts::TAU;

use nearwall::normal::{Contact, NormalLaw};

/// Number of hits after which a doublet counts as at rest on the wall.
const MOST_DOUBLET_HITS: u32 = 1000;

/// Motion of a doublet. The third direction is the wall's normal, away from the wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoubletMotion {
    /// Speed away from the wall [m/s]; negative on arrival.
    pub speed: f64,
    /// Unit vector along the line of centres.
    pub axis: [f64; 3],
    /// Spin `omega` [rad/s], perpendicular to `axis`.
    pub spin: [f64; 3],
}

impl DoubletMotion {
    /// A doublet that arrives with `normal_speed` [m/s]; `axis` has any length; only the part of `spin` [rad/s]
    /// perpendicular to it counts.
    pub fn arriving(normal_speed: f64, axis: [f64; 3], spin: [f64; 3]) -> Self {
        let axis = scaled(axis, 1.0 / dot(axis, axis).sqrt());
        Self { speed: -normal_speed, axis, spin: sum(spin, scaled(axis, -dot(spin, axis))) }
    }
}

/// A doublet that leaves the wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoubletRebound {
    /// Its motion.
    pub motion: DoubletMotion,
    /// Restitution of the centre of mass `e_cm` [1]: speed away over speed towards the wall.
    pub restitution: f64,
    /// Number of hits of its ends.
    pub hits: u32,
}

/// Effective mass `m*/m` [1] of a contact, over one sphere's mass.
///
/// `axis_normal` [1] is the cosine of the angle `phi` between the line of centres and the wall's normal.
pub fn effective_mass(axis_normal: f64) -> f64 {
    1.0 / (0.5 + 5.0 / 14.0 * (1.0 - axis_normal * axis_normal).max(0.0))
}

/// Restitution [1] of one contact after Thornton & Ning; `None` when adhesion holds it.
///
/// `diameter` [m] is that of one sphere, `speed` [m/s] the closing speed of its surface,
/// `effective_mass` [1] the result of [`effective_mass`].
pub fn contact_restitution(contact: &Contact, diameter: f64, speed: f64, effective_mass: f64) -> Option<f64> {
    let contact = Contact { density: contact.density * effective_mass, ..*contact };
    NormalLaw::ThorntonNing.restitution(&contact, diameter, speed)
}

/// Follows a doublet of spheres of `radius` [m] from where its centre is `2 R` above the wall, out
/// of reach, until it leaves; `None` when adhesion holds a contact or the doublet comes to rest.
/// `arriving.axis` is its orientation there.
///
/// `restitution` gives the contact's `e` [1] from the closing speed [m/s] and the effective mass
/// `m*/m` [1]; `None` holds.
pub fn rebound(
    arriving: &DoubletMotion,
    radius: f64,
    restitution: impl Fn(f64, f64) -> Option<f64>,
) -> Option<DoubletRebound> {
    let mut flight = DoubletFlight { motion: *arriving, height: 2.0 * radius, radius };
    for hits in 0..MOST_DOUBLET_HITS {
        let Some((time, end)) = flight.next_touch() else {
            let restitution = flight.motion.speed / -arriving.speed;
            return Some(DoubletRebound { motion: flight.motion, restitution, hits });
        };
        flight.pass(time);
        flight.hit(end, &restitution)?;
    }
    None
}

/// A doublet in flight.
struct DoubletFlight {
    motion: DoubletMotion,
    /// Height of the centre of mass above the wall [m].
    height: f64,
    radius: f64,
}

impl DoubletFlight {
    /// The axis after `time` [s]: it turns at a constant rate in the plane perpendicular to the spin.
    fn axis_after(&self, time: f64) -> [f64; 3] {
        let DoubletMotion { axis, spin, .. } = self.motion;
        let rate = dot(spin, spin).sqrt();
        if rate == 0.0 {
            return axis;
        }
        let (sine, cosine) = (rate * time).sin_cos();
        sum(scaled(axis, cosine), scaled(cross(spin, axis), sine / rate))
    }

    fn pass(&mut self, time: f64) {
        let axis = self.axis_after(time);
        self.motion.axis = scaled(axis, 1.0 / dot(axis, axis).sqrt());
        self.height += self.motion.speed * time;
    }

    /// Gap [m] between the wall and an end (1 or -1 along the axis) after `time` [s].
    fn gap(&self, end: f64, time: f64) -> f64 {
        self.height + self.motion.speed * time - self.radius + end * self.radius * self.axis_after(time)[2]
    }

    /// Time [s] until the next touch, and the end that touches.
    fn next_touch(&self) -> Option<(f64, f64)> {
        let touches = [1.0, -1.0].map(|end| self.touch(end).map(|time| (time, end)));
        touches.into_iter().flatten().min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Time [s] until this end touches. Its gap is a line plus a sine and is monotonic between
    /// turning points, which are known: no touch is missed.
    fn touch(&self, end: f64) -> Option<f64> {
        let DoubletMotion { speed, axis, spin } = self.motion;
        let rate = dot(spin, spin).sqrt();
        let last = if speed > 0.0 {
            (2.0 * self.radius - self.height) / speed
        } else if speed < 0.0 {
            (self.height + self.radius) / -speed
        } else if rate > 0.0 {
            TAU / rate
        } else {
            return None;
        };
        // Height of the axis' end: `swing sin(start + rate t)`; the gap turns where the cosine is `turning`.
        let across = if rate > 0.0 { cross(spin, axis)[2] / rate } else { 0.0 };
        let (start, swing) = (axis[2].atan2(across), axis[2].hypot(across));
        let turning = -speed / (end * self.radius * rate * swing);
        let mut turns: Vec<f64> = Vec::new();
        if turning.abs() < 1.0 {
            let angle = turning.acos();
            let rounds = (last * rate / TAU).ceil() as i64 + 2;
            let times = (-1..rounds)
                .flat_map(|round| [angle, -angle].map(|angle| (angle - start + TAU * round as f64) / rate));
            turns = times.filter(|time| (0.0..last).contains(time)).collect();
            turns.sort_by(f64::total_cmp);
        }
        let mut from = 0.0;
        for to in turns.into_iter().chain([last]) {
            let (before, after) = (self.gap(end, from), self.gap(end, to));
            if after < before && after < 0.0 {
                return Some(if before > 0.0 { self.crossing(end, from, to) } else { from });
            }
            from = to;
        }
        None
    }

    /// Time [s] at which the gap, positive at `from` and negative at `to`, is zero; by bisection.
    fn crossing(&self, end: f64, mut from: f64, mut to: f64) -> f64 {
        for _ in 0..100 {
            let middle = 0.5 * (from + to);
            if self.gap(end, middle) > 0.0 { from = middle } else { to = middle }
        }
        0.5 * (from + to)
    }

    /// Applies the impulse at an end that touches; `None` when adhesion holds the contact.
    fn hit(&mut self, end: f64, restitution: &impl Fn(f64, f64) -> Option<f64>) -> Option<()> {
        let DoubletMotion { speed, axis, spin } = &mut self.motion;
        let closing = -(*speed + end * self.radius * cross(*spin, *axis)[2]);
        let mass = effective_mass(axis[2]);
        let impulse = (1.0 + restitution(closing, mass)?) * closing * mass;
        *speed += 0.5 * impulse;
        let turn = 5.0 / 14.0 * end * impulse / self.radius;
        *spin = sum(*spin, scaled(cross(*axis, [0.0, 0.0, 1.0]), turn));
        Some(())
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn scaled(a: [f64; 3], by: f64) -> [f64; 3] {
    a.map(|value| by * value)
}

fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nearwall::ImpactRng;
    use nearwall::normal::{adhesive_velocity, restitution, yield_velocity};

    const R: f64 = 4.5e-6;

    impl DoubletMotion {
        /// Energy over one sphere's mass [J/kg] without the motion along the wall: `v² + 7/5 R² omega²`.
        fn energy(&self, radius: f64) -> f64 {
            self.speed * self.speed + 1.4 * radius * radius * dot(self.spin, self.spin)
        }
    }

    fn leaning(phi: f64) -> [f64; 3] {
        [phi.sin(), 0.0, phi.cos()]
    }

    /// Evenly over the sphere, with spins up to `R omega / v = 2` in any direction.
    fn any(key: u64) -> DoubletMotion {
        let draw = ImpactRng::new(7, key);
        let direction = |stream| {
            let (z, turn) = (2.0 * draw.uniform(stream) - 1.0, TAU * draw.uniform(stream + 1));
            let across = (1.0 - z * z).sqrt();
            [across * turn.cos(), across * turn.sin(), z]
        };
        DoubletMotion::arriving(3.0, direction(0), scaled(direction(2), 6.0 / R * draw.uniform(4)))
    }

    #[test]
    fn perfect_contacts_keep_energy_through_every_hit() {
        let mut most = 0;
        for key in 0..2000 {
            let before = any(key);
            let after = rebound(&before, R, |_, _| Some(1.0)).unwrap();
            assert_relative_eq!(after.motion.energy(R), before.energy(R), max_relative = 1e-12);
            most = most.max(after.hits);
        }
        assert_eq!(most, 2, "seed 7: some are hit twice, none more often");
    }

    /// A wall without friction has no torque about its normal, and none about the line of centres.
    #[test]
    fn spin_about_the_normal_and_about_the_axis_is_kept() {
        for key in 0..2000 {
            let before = any(key);
            let after = rebound(&before, R, |_, _| Some(0.5)).unwrap().motion;
            let scale = 3.0 / R;
            assert!((after.spin[2] - before.spin[2]).abs() < 1e-9 * scale, "seed 7, key {key}");
            assert!(dot(after.spin, after.axis).abs() < 1e-9 * scale, "seed 7, key {key}");
        }
    }

    /// The wall's impulse goes through the contact, about which the angular momentum
    /// `I omega + M (r x v)` is the same before and after.
    #[test]
    fn one_hit_keeps_the_angular_momentum_about_the_contact() {
        for phi in [0.1, 0.3, 0.5] {
            let before = DoubletMotion::arriving(2.0, leaning(phi), [0.0; 3]);
            let after = rebound(&before, R, |_, _| Some(0.9)).unwrap();
            assert_eq!(after.hits, 1);
            // The lower end lies R sin(phi) towards negative x, so the centre stands that much to its right.
            let momentum =
                |motion: &DoubletMotion| 2.8 * R * R * motion.spin[1] - 2.0 * R * phi.sin() * motion.speed;
            assert_relative_eq!(momentum(&after.motion), momentum(&before), max_relative = 1e-12);
            assert_eq!([after.motion.spin[0], after.motion.spin[2]], [0.0; 2]);
        }
    }

    #[test]
    fn end_on_it_is_one_body_of_twice_the_mass() {
        let after = rebound(&DoubletMotion::arriving(2.0, leaning(0.0), [0.0; 3]), R, |_, mass| {
            assert_relative_eq!(mass, 2.0);
            Some(0.37)
        });
        assert_relative_eq!(after.unwrap().restitution, 0.37, max_relative = 1e-14);
        assert_relative_eq!(effective_mass(0.0), 7.0 / 6.0, max_relative = 1e-15);
    }

    /// `e_cm = (1 + e)/(1 + M b²/I) - 1`, with `M b²/I = 5/7 sin²(phi)`.
    #[test]
    fn a_single_hit_has_the_closed_form() {
        for (phi, e) in [(0.2, 0.4), (0.5, 0.6), (0.5, 0.9), (0.7, 1.0)] {
            let after =
                rebound(&DoubletMotion::arriving(1.0, leaning(phi), [0.0; 3]), R, |_, _| Some(e)).unwrap();
            assert_eq!(after.hits, 1, "phi {phi}");
            let closed = (1.0 + e) / (1.0 + 5.0 / 7.0 * phi.sin().powi(2)) - 1.0;
            assert_relative_eq!(after.restitution, closed, max_relative = 1e-12);
        }
    }

    #[test]
    fn a_contact_that_holds_captures_the_doublet() {
        assert_eq!(rebound(&any(1), R, |_, _| None), None);
        // Slow second hits stick where fast first ones do not.
        let flat = DoubletMotion::arriving(1.0, leaning(1.3), [0.0; 3]);
        assert!(rebound(&flat, R, |speed, _| (speed > 0.9).then_some(0.1)).is_none());
    }

    /// Another way to the same: two soft springs at the ends, followed in small steps. Stiff
    /// springs tend to perfect hits; cases where ends touch almost at once are left out, since
    /// there a spring and a sequence of hits differ.
    #[test]
    fn springs_in_small_steps_say_the_same() {
        let mut compared = 0;
        for key in 0..40 {
            let before = any(key);
            let ours = rebound(&before, R, |_, _| Some(1.0)).unwrap();
            if let Some(theirs) = by_springs(&before) {
                compared += 1;
                assert_relative_eq!(ours.restitution, theirs, epsilon = 0.02);
            }
        }
        assert!(compared >= 25, "seed 7: {compared} compared");
    }

    /// Restitution of the centre in units `R = m = 1`, `v = 3`; `None` when both springs were ever pressed at once.
    fn by_springs(before: &DoubletMotion) -> Option<f64> {
        const STIFFNESS: f64 = 4e6;
        const STEP: f64 = 2e-6;
        let (mut height, mut speed) = (2.0, before.speed);
        let (mut axis, mut spin) = (before.axis, scaled(before.spin, R));
        while speed < 0.0 || height < 2.05 {
            let mut turn = [0.0; 3];
            let mut pressed = 0;
            for end in [1.0, -1.0] {
                let depth = 1.0 - height - end * axis[2];
                if depth > 0.0 {
                    pressed += 1;
                    let force = STIFFNESS * depth;
                    speed += STEP * force / 2.0;
                    turn = sum(turn, scaled(cross(scaled(axis, end), [0.0, 0.0, 1.0]), force / 2.8));
                }
            }
            if pressed == 2 {
                return None;
            }
            spin = sum(spin, scaled(turn, STEP));
            axis = sum(axis, scaled(cross(spin, axis), STEP));
            axis = scaled(axis, 1.0 / dot(axis, axis).sqrt());
            height += STEP * speed;
        }
        Some(speed / 3.0)
    }

    /// `v_y` and `v_adh` of a sphere whose mass is replaced: both with the power -1/2.
    #[test]
    fn the_contact_feels_the_effective_mass() {
        let contact = Contact {
            density: 18300.0,
            reduced_modulus: 139e9,
            work_of_adhesion: 6.5,
            yield_strength: 300e6,
            yield_ratio: 4.0,
            stiffness_ratio: 0.8,
            melt: None,
        };
        let root = 2f64.sqrt();
        let slow = (adhesive_velocity(&contact, 9e-6) / root, yield_velocity(&contact) / root);
        let expected = restitution(3.0, slow.0, slow.1);
        assert_relative_eq!(
            contact_restitution(&contact, 9e-6, 3.0, 2.0).unwrap(),
            expected,
            max_relative = 1e-12
        );
    }
}
