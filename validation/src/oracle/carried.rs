//! A sphere carried along a line by air: Runge and Kutta's classical method, fixed step, Schiller
//! and Naumann's drag and Ranz and Marshall's heat; for Stokes' drag in a steady stream also the
//! closed form.
//!
//! `dx/dt = v`, `dv/dt = (18 mu/(rho d²)) (1 + 0.15 Re^0.687) (u - v) + g (1 - rho_a/rho)`, `Re = rho_a |u - v| d/mu`,
//! `dT/dt = 6 Nu k/(rho c d²) (T_a - T)`, `Nu = 2 + 0.6 Re^½ Pr^⅓`. SI units.

const GRAVITY: f64 = 9.81;

/// Air at 1 atm.
#[derive(Debug, Clone, Copy)]
pub struct Air {
    /// [K].
    pub temperature: f64,
    /// [kg/m³].
    pub density: f64,
    /// [Pa s].
    pub viscosity: f64,
    /// [W/(m K)].
    pub conductivity: f64,
}

/// Heat capacity of air [J/(kg K)].
const AIR_HEAT: f64 = 1007.0;

impl Air {
    /// Ideal gas of 28.96 g/mol; Sutherland's viscosity; conductivity from 0.0243 at 0 °C to 0.0335
    /// W/(m K) at 130 °C (handbook).
    pub fn at(temperature: f64) -> Self {
        Self {
            temperature,
            density: 101_325.0 * 0.02896 / (8.314_463 * temperature),
            viscosity: 1.458e-6 * temperature.powf(1.5) / (temperature + 110.4),
            conductivity: 0.0243 + (0.0335 - 0.0243) * (temperature - 273.15) / 130.0,
        }
    }
}

/// A sphere.
#[derive(Debug, Clone, Copy)]
pub struct Sphere {
    /// [m].
    pub diameter: f64,
    /// [kg/m³].
    pub density: f64,
    /// [J/(kg K)].
    pub heat_capacity: f64,
}

/// Where it is on its way: time [s], place [m], speed [m/s], temperature [K].
#[derive(Debug, Clone, Copy)]
pub struct OnTheWay {
    /// [s].
    pub time: f64,
    /// [m].
    pub at: f64,
    /// [m/s].
    pub speed: f64,
    /// [K].
    pub temperature: f64,
}

/// The law of drag.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Law {
    /// `Re -> 0`.
    Stokes,
    /// Up to `Re = 1000`.
    SchillerNaumann,
}

/// Relaxation time `rho d²/(18 mu)` [s].
pub fn relaxation_time(sphere: &Sphere, air: &Air) -> f64 {
    sphere.density * sphere.diameter * sphere.diameter / (18.0 * air.viscosity)
}

/// A flight along a line on which air moves and gravity acts.
pub struct CarriedFlight<'a> {
    /// The sphere.
    pub sphere: Sphere,
    /// The air.
    pub air: Air,
    /// Its drag.
    pub law: Law,
    /// 1 where gravity acts along the line, -1 against, 0 across.
    pub downwards: f64,
    /// Speed of the air [m/s] at a place [m].
    pub air_speed: &'a dyn Fn(f64) -> f64,
}

impl CarriedFlight<'_> {
    fn slope(&self, [at, speed, temperature]: [f64; 3]) -> [f64; 3] {
        let Self { sphere, air, .. } = self;
        let slip = (self.air_speed)(at) - speed;
        let reynolds = air.density * slip.abs() * sphere.diameter / air.viscosity;
        let inertia = if self.law == Law::Stokes { 1.0 } else { 1.0 + 0.15 * reynolds.powf(0.687) };
        let weight = GRAVITY * self.downwards * (1.0 - air.density / sphere.density);
        let prandtl = AIR_HEAT * air.viscosity / air.conductivity;
        let nusselt = 2.0 + 0.6 * reynolds.sqrt() * prandtl.cbrt();
        let heating = 6.0 * nusselt * air.conductivity
            / (sphere.density * sphere.heat_capacity * sphere.diameter * sphere.diameter);
        [
            speed,
            slip * inertia / relaxation_time(sphere, air) + weight,
            heating * (air.temperature - temperature),
        ]
    }

    /// One step.
    fn step(&self, from: OnTheWay, time: f64) -> OnTheWay {
        let y = [from.at, from.speed, from.temperature];
        let along = |slope: [f64; 3], by: f64| [0, 1, 2].map(|i| y[i] + by * slope[i]);
        let a = self.slope(y);
        let b = self.slope(along(a, 0.5 * time));
        let c = self.slope(along(b, 0.5 * time));
        let d = self.slope(along(c, time));
        let [at, speed, temperature] =
            [0, 1, 2].map(|i| y[i] + time / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]));
        OnTheWay { time: from.time + time, at, speed, temperature }
    }

    /// The way from `start` in steps of `step` [s] as long as `goes_on`; the last place is the first where it does not.
    pub fn way(&self, start: OnTheWay, step: f64, goes_on: impl Fn(&OnTheWay) -> bool) -> Vec<OnTheWay> {
        let mut way = vec![start];
        let mut here = start;
        while goes_on(&here) && way.len() < 1_000_000 {
            here = self.step(here, step);
            way.push(here);
        }
        way
    }

    /// The place where it comes to `end` [m]; the last step is shortened until it ends there.
    pub fn arrives(&self, start: OnTheWay, step: f64, end: f64) -> OnTheWay {
        let ahead = (end - start.at).signum();
        let way = self.way(start, step, |place| (end - place.at) * ahead > 0.0);
        let before = way[way.len().saturating_sub(2)];
        let (mut low, mut high) = (0.0, step);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if (end - self.step(before, middle).at) * ahead > 0.0 { low = middle } else { high = middle }
        }
        self.step(before, high)
    }
}

/// Terminal speed [m/s] of a wax sphere (1000 kg/m³) of `diameter` [m] in air at rest, by balance of drag and weight.
pub fn terminal_speed(diameter: f64, air: &Air) -> f64 {
    let stokes = (1000.0 - air.density) * diameter * diameter * GRAVITY / (18.0 * air.viscosity);
    // v = v_Stokes / (1 + 0.15 Re^0.687): a contraction.
    (0..60).fold(stokes, |speed, _| {
        let reynolds = air.density * speed * diameter / air.viscosity;
        0.5 * (speed + stokes / (1.0 + 0.15 * reynolds.powf(0.687)))
    })
}

/// Speed [m/s] and way [m] after `time` [s] of a sphere that starts with `first` [m/s] towards
/// `last` [m/s] with Stokes' drag.
pub fn stokes_closed_form(first: f64, last: f64, relaxation: f64, time: f64) -> [f64; 2] {
    let left = (-time / relaxation).exp();
    [last + (first - last) * left, last * time + (first - last) * relaxation * (1.0 - left)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runge–Kutta against the closed form: a fourth-order method with steps of a hundredth of the relaxation time.
    #[test]
    fn stokes_drag_follows_its_closed_form() {
        let sphere = Sphere { diameter: 80e-6, density: 1000.0, heat_capacity: 2000.0 };
        let air = Air::at(293.15);
        let tau = relaxation_time(&sphere, &air);
        let flight = CarriedFlight { sphere, air, law: Law::Stokes, downwards: 1.0, air_speed: &|_| 1.8 };
        let start = OnTheWay { time: 0.0, at: 0.0, speed: 0.1, temperature: 293.15 };
        let last = 1.8 + tau * GRAVITY * (1.0 - air.density / 1000.0);
        for place in flight.way(start, tau / 100.0, |place| place.time < 8.0 * tau).iter().step_by(50) {
            let [speed, way] = stokes_closed_form(0.1, last, tau, place.time);
            assert!((place.speed - speed).abs() < 1e-9 && (place.at - way).abs() < 1e-10, "{place:?}");
        }
    }

    #[test]
    fn what_falls_long_enough_has_its_terminal_speed() {
        let sphere = Sphere { diameter: 100e-6, density: 1000.0, heat_capacity: 2000.0 };
        let air = Air::at(293.15);
        let flight =
            CarriedFlight { sphere, air, law: Law::SchillerNaumann, downwards: 1.0, air_speed: &|_| 0.0 };
        let start = OnTheWay { time: 0.0, at: 0.0, speed: 0.0, temperature: 293.15 };
        let way = flight.way(start, 1e-4, |place| place.time < 0.6);
        let terminal = terminal_speed(100e-6, &air);
        assert!((way[way.len() - 1].speed / terminal - 1.0).abs() < 1e-6);
        // Hinds, Aerosol Technology: 100 µm of unit density settle at 0.25 m/s.
        assert!((terminal - 0.25).abs() < 0.01, "{terminal}");
    }
}
