//! One normal impact of an adhesive, elastic–perfectly plastic sphere on a plane, followed through time.
//!
//! The contact is that of Thornton & Ning (Powder Technology 99 (1998) 154), and nothing is solved in closed form:
//! - Loading: `delta = a²/R - sqrt(2πWa/E*)` (JKR), from `delta = 0`. The force is the integral
//!   over the contact of the JKR pressure `p0 u - p1/u`, cut off at `p_y`; `u = sqrt(1 - r²/a²)`,
//!   `p0 = 2E*a/πR`, `p1 = sqrt(2WE*/πa)`. So adhesion enters the yield criterion: it takes `p1`
//!   from the Hertz pressure at the centre, where yield begins.
//! - Unloading: JKR with the radius of curvature `R_p` that has the same force at the same `a` where the motion turns.
//! - The particle is free when `delta` has come to its minimum on that curve, and stuck when it stops before.
//!
//! Equations of motion `m dv/dt = -F`, `d delta/dt = v` for the sphere's mass `m = (4/3)πrho R³`.
//! The state is the root of the contact radius, since `delta` and `F` are smooth in it, and the
//! clock `tau` has `dt = (d delta/d sqrt(a)) dtau`, since that derivative vanishes where the
//! contact parts. Dormand & Prince's pair of orders 5 and 4 with error control; `tolerance` is the
//! error of a step relative to the state. The points of yield, turning and parting are hit to
//! rounding.

use std::f64::consts::PI;

/// The sphere, the contact and the impact, in SI units.
#[derive(Debug, Clone, Copy)]
pub struct ContactImpact {
    /// Radius `R` [m].
    pub radius: f64,
    /// Density `rho` [kg/m³].
    pub density: f64,
    /// Reduced modulus `E*` [Pa].
    pub reduced_modulus: f64,
    /// Work of adhesion `W` [J/m²].
    pub work_of_adhesion: f64,
    /// Limiting contact pressure `p_y` [Pa].
    pub limiting_pressure: f64,
    /// ContactImpact speed `v` [m/s].
    pub speed: f64,
}

/// What came of it.
#[derive(Debug, Clone, Copy)]
pub struct Bounce {
    /// Rebound speed [m/s], 0 when adhesion holds the particle.
    pub rebound_speed: f64,
    /// Force at the turning point [N], the largest.
    pub largest_force: f64,
    /// `R_p/R` [1], and so the pull-off force over JKR's `(3/2)πWR`.
    pub flattening: f64,
    /// Energy that plasticity took, over the kinetic energy of the impact [1].
    pub plastic_loss: f64,
    /// Energy that the contact kept, over the kinetic energy of the impact [1]: the work of parting where it parts.
    pub adhesive_loss: f64,
    /// Kinetic energy of the impact less that of the rebound and the losses, relative to it [1]: an
    /// error of integration.
    pub energy_defect: f64,
    /// From first contact to parting or standstill [s].
    pub duration: f64,
    /// Steps of the integration.
    pub steps: usize,
}

/// Follows one impact.
pub fn follow(impact: &ContactImpact, tolerance: f64) -> Bounce {
    ContactMotion::new(impact, tolerance).run(impact)
}

/// Unit system: lengths over `R`, pressures over `E*`, masses so that `rho` is 1.
struct ContactMotion {
    adhesion: f64,
    limit: f64,
    mass: f64,
    speed: f64,
    tolerance: f64,
    steps: usize,
}

/// Root of the contact radius, speed into the wall, work done against the contact, time.
type ContactState = [f64; 4];

/// Which curve the contact follows.
#[derive(Clone, Copy)]
enum Curve {
    Elastic { radius: f64 },
    Limited,
}

impl ContactMotion {
    fn new(impact: &ContactImpact, tolerance: f64) -> Self {
        let sound = (impact.reduced_modulus / impact.density).sqrt();
        Self {
            adhesion: impact.work_of_adhesion / (impact.reduced_modulus * impact.radius),
            limit: impact.limiting_pressure / impact.reduced_modulus,
            mass: 4.0 / 3.0 * PI,
            speed: impact.speed / sound,
            tolerance,
            steps: 0,
        }
    }

    fn run(mut self, impact: &ContactImpact) -> Bounce {
        let state = [self.touching(1.0), self.speed, 0.0, 0.0];
        let (turn, curve) = self.way_in(state);
        let force = self.force(turn[0], curve);
        let radius = match curve {
            Curve::Elastic { radius } => radius,
            Curve::Limited => {
                let a = turn[0] * turn[0];
                4.0 * a.powi(3) / (3.0 * (force + (8.0 * PI * self.adhesion * a.powi(3)).sqrt()))
            }
        };
        let parting = (PI * self.adhesion * radius * radius / 8.0).cbrt().sqrt();
        let halt = |s: &ContactState| (s[0] - parting).min(-s[1]);
        let end = self.until([turn[0], 0.0, 0.0, turn[3]], Curve::Elastic { radius }, halt);
        // The motion ended either at the parting or at a standstill before it.
        let free = end[0] - parting <= -end[1];

        let initial = 0.5 * self.mass * self.speed * self.speed;
        let kinetic = if free { 0.5 * self.mass * end[1] * end[1] } else { 0.0 };
        let touching = self.potential(self.touching(radius), radius);
        let plastic = turn[2] - (self.potential(turn[0], radius) - touching);
        let kept = self.potential(end[0], radius) - touching;
        let sound = impact.speed / self.speed;
        Bounce {
            rebound_speed: if free { end[1].abs() * sound } else { 0.0 },
            largest_force: force * impact.reduced_modulus * impact.radius.powi(2),
            flattening: radius,
            plastic_loss: plastic / initial,
            adhesive_loss: kept / initial,
            energy_defect: (initial - kinetic - plastic - kept) / initial,
            duration: end[3] * impact.radius / sound,
            steps: self.steps,
        }
    }

    /// Follows the contact to its turning point; the curve it is on there.
    fn way_in(&mut self, first: ContactState) -> (ContactState, Curve) {
        let elastic = Curve::Elastic { radius: 1.0 };
        let yielding = self.yield_root();
        if yielding <= first[0] {
            return (self.until(first, Curve::Limited, |s| s[1]), Curve::Limited);
        }
        let state = self.until(first, elastic, |s| (yielding - s[0]).min(s[1]));
        let turned = state[1] < yielding - state[0];
        if turned {
            return (state, elastic);
        }
        (self.until(state, Curve::Limited, |s| s[1]), Curve::Limited)
    }

    /// Root of the contact radius where JKR's `delta` is 0: `a³ = 2πWR²/E*`.
    fn touching(&self, radius: f64) -> f64 {
        (2.0 * PI * self.adhesion * radius * radius).cbrt().sqrt()
    }

    /// Root of the contact radius where the pressure at the centre comes to the limit, by halving.
    fn yield_root(&self) -> f64 {
        let excess = |root: f64| {
            let [hertz, tension] = self.pressures(root * root);
            hertz - tension - self.limit
        };
        let mut high = 1.0;
        while excess(high) < 0.0 {
            high *= 2.0;
        }
        bisect(0.0, high, excess, 200)
    }

    /// `p0` and `p1` at the contact radius `a`.
    fn pressures(&self, a: f64) -> [f64; 2] {
        [2.0 * a / PI, (2.0 * self.adhesion / (PI * a)).sqrt()]
    }

    /// Force at `sqrt(a)`.
    fn force(&self, root: f64, curve: Curve) -> f64 {
        let a = root * root;
        match curve {
            Curve::Elastic { radius } => {
                4.0 * a.powi(3) / (3.0 * radius) - (8.0 * PI * self.adhesion * a.powi(3)).sqrt()
            }
            Curve::Limited => self.limited_force(a),
        }
    }

    /// `∫ min(p, p_y) dA`: over `u`, `dA = 2πa² u du`, so the integrand is a polynomial on either
    /// side of the edge of the limit, and Simpson's rule is exact.
    fn limited_force(&self, a: f64) -> f64 {
        let [hertz, tension] = self.pressures(a);
        // The force is stationary in the edge, so 40 halvings leave no error.
        let edge = bisect(0.0, 1.0, |u| hertz * u * u - tension - self.limit * u, 40);
        let load = |u: f64| hertz * u * u - tension;
        let rim = edge / 6.0 * (load(0.0) + 4.0 * load(0.5 * edge) + load(edge));
        2.0 * PI * a * a * (rim + 0.5 * self.limit * (1.0 - edge * edge))
    }

    /// `d delta / d sqrt(a)`.
    fn approach(&self, root: f64, curve: Curve) -> f64 {
        let radius = if let Curve::Elastic { radius } = curve { radius } else { 1.0 };
        4.0 * root.powi(3) / radius - (2.0 * PI * self.adhesion).sqrt()
    }

    /// Work `∫F d delta` of the JKR curve from a radius of 0.
    fn potential(&self, root: f64, radius: f64) -> f64 {
        let (w, a) = (self.adhesion, root * root);
        let hertz = 8.0 * a.powi(5) / (15.0 * radius * radius);
        let mixed = 4.0 / 3.0 * (2.0 * PI * w).sqrt() * a.powf(3.5) / radius;
        hertz - mixed + PI * w * a * a
    }

    fn rates(&self, state: &ContactState, curve: Curve) -> ContactState {
        let stretch = self.approach(state[0], curve);
        let force = self.force(state[0], curve);
        [state[1], -force * stretch / self.mass, force * stretch * state[1], stretch]
    }

    /// Follows the motion until `left`, positive on the way, comes to 0.
    fn until(
        &mut self,
        start: ContactState,
        curve: Curve,
        left: impl Fn(&ContactState) -> f64,
    ) -> ContactState {
        let mut state = start;
        let mut step = self.first_step(&state, curve);
        loop {
            let (next, error) = self.stride(&state, curve, step);
            if error > 1.0 {
                step *= (0.9 * error.powf(-0.2)).max(0.2);
                continue;
            }
            self.steps += 1;
            if left(&next) <= 0.0 {
                // The length of the last step, by halving.
                let length = bisect(0.0, step, |h| -left(&self.stride(&state, curve, h).0), 60);
                return self.stride(&state, curve, length).0;
            }
            state = next;
            step *= (0.9 * error.powf(-0.2)).min(5.0);
        }
    }

    /// A step that is short against the motion: a thousandth of the contact's change of size.
    fn first_step(&self, state: &ContactState, curve: Curve) -> f64 {
        let size = state[0].max(1e-3 * self.speed.powf(0.2));
        let acceleration = self.rates(state, curve)[1].abs();
        1e-3 * size / (state[1].abs() + (acceleration * size).sqrt())
    }

    /// One step of Dormand & Prince (1980), order 5, and its error by their order 4 over what is allowed.
    fn stride(&self, state: &ContactState, curve: Curve, step: f64) -> (ContactState, f64) {
        const STAGES: [&[f64]; 6] = [
            &[1.0 / 5.0],
            &[3.0 / 40.0, 9.0 / 40.0],
            &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
            &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
            &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
            &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
        ];
        const ERROR: [f64; 7] = [
            71.0 / 57600.0,
            0.0,
            -71.0 / 16695.0,
            71.0 / 1920.0,
            -17253.0 / 339200.0,
            22.0 / 525.0,
            -1.0 / 40.0,
        ];
        let mut rates = [[0.0; 4]; 7];
        rates[0] = self.rates(state, curve);
        let mut next = *state;
        for (stage, weights) in STAGES.iter().enumerate() {
            next = advance(state, &rates, weights, step);
            rates[stage + 1] = self.rates(&next, curve);
        }
        let error = advance(&[0.0; 4], &rates, &ERROR, step);
        let scale = [next[0].abs(), self.speed.max(next[1].abs())];
        let worst = (error[0] / scale[0]).abs().max((error[1] / scale[1]).abs());
        (next, (worst / self.tolerance).max(1e-10))
    }
}

/// `state + step sum(weights rates)`.
fn advance(state: &ContactState, rates: &[ContactState; 7], weights: &[f64], step: f64) -> ContactState {
    let mut sum = *state;
    for (rate, weight) in rates.iter().zip(weights) {
        for (value, slope) in sum.iter_mut().zip(rate) {
            *value += step * weight * slope;
        }
    }
    sum
}

/// Root between `low`, where `excess` is negative, and `high`, by halving.
fn bisect(mut low: f64, mut high: f64, excess: impl Fn(f64) -> f64, rounds: u32) -> f64 {
    for _ in 0..rounds {
        let middle = 0.5 * (low + high);
        *(if excess(middle) > 0.0 { &mut high } else { &mut low }) = middle;
    }
    0.5 * (low + high)
}
