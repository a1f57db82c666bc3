//! Freezing of a droplet on a colder wall: it is arrested when it is solid before it can recoil.
//!
//! Where the melt touches the wall both take at once the contact temperature `T_c = (e_p T_p + e_w
//! T_w)/(e_p + e_w)`, `e = sqrt(k rho c)` the effusivity [J/(m² K s^½)] of droplet and wall. Below
//! the melting point `T_m` a solid layer grows from the wall as `2 lambda sqrt(a t)`, `a = k/(rho
//! c)` [m²/s] of the droplet, where `sqrt(pi) lambda exp(lambda²) (erf(lambda) + e_p/e_w) = c
//! (T_m - T_w)/L'` (Neumann's solution on a conducting wall; Carslaw & Jaeger, Conduction of Heat in
//! Solids, derived again here) with `L' = L + c (T_p - T_m)`: the superheat counts as heat of
//! fusion (*assumed*). The disc of the maximum spread `xi` is `h = 2 d/(3 xi²)` high and solid
//! after `t_f = h²/(4 a lambda²)`. The droplet is arrested when `T_c < T_m` and `t_f` is below the
//! contact time of a bouncing drop, `2.6 sqrt(rho R³/sigma)`.
//!
//! `k` conductivity [W/(m K)], `rho` density [kg/m³], `c` heat capacity [J/(kg K)], `L` heat of
//! fusion [J/kg], `T_p` droplet, `T_w` wall [K], `d` diameter [m]. The comparison of freezing with
//! spreading is usual for thermal spraying (Madejski, Int. J. Heat Mass Transfer 19 (1976) 1009,
//! not re-read).
//!
//! Observed: molten molybdenum above 2900 K on tungsten below 1000 K flattened, froze at the wall
//! and began to recoil; the front caught up after some oscillations; all 13 impacts stuck (MIGRAINE
//! dust study, Fig 7b and set 6). For 14 µm at 5 m/s the formula gives freezing within half of a
//! contact time, by properties of the solid metals as commonly tabulated (not re-read).
//!
//! *Assumed*: perfect thermal contact (a thermal contact resistance of 1e-6 m² K/W would dominate
//! for drops below some micrometres), the same properties in the solid and in the melt, a wall
//! thick against `sqrt(a t)`, freezing that does not slow the spreading, and that a frozen disc
//! stays: thermal stress may detach it. A glass has no heat of fusion and no melting point; the
//! criterion is not for slags.

/// Thermal properties of a droplet or a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThermalProperties {
    /// Density `rho` [kg/m³].
    pub density: f64,
    /// Heat capacity `c` [J/(kg K)].
    pub heat_capacity: f64,
    /// Thermal conductivity `k` [W/(m K)].
    pub conductivity: f64,
}

impl ThermalProperties {
    /// Effusivity `sqrt(k rho c)` [J/(m² K s^½)].
    pub fn effusivity(&self) -> f64 {
        (self.conductivity * self.density * self.heat_capacity).sqrt()
    }

    /// Diffusivity `k/(rho c)` [m²/s].
    pub fn diffusivity(&self) -> f64 {
        self.conductivity / (self.density * self.heat_capacity)
    }
}

/// A droplet that touches a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreezingDroplet {
    /// The droplet.
    pub droplet: ThermalProperties,
    /// The wall.
    pub wall: ThermalProperties,
    /// Temperature of the droplet [K], at or above the melting point.
    pub temperature: f64,
    /// Temperature of the wall [K].
    pub wall_temperature: f64,
    /// Melting point `T_m` [K].
    pub melting_point: f64,
    /// Heat of fusion `L` [J/kg].
    pub heat_of_fusion: f64,
}

impl FreezingDroplet {
    /// Temperature [K] of the interface at first contact, `T_c`.
    pub fn contact_temperature(&self) -> f64 {
        let [droplet, wall] = [self.droplet.effusivity(), self.wall.effusivity()];
        (droplet * self.temperature + wall * self.wall_temperature) / (droplet + wall)
    }

    /// Time [s] in which a disc of this height [m] is solid, `t_f`; infinite where it does not freeze.
    pub fn freezing_time(&self, height: f64) -> f64 {
        if self.contact_temperature() >= self.melting_point {
            return f64::INFINITY;
        }
        let lambda = self.growth();
        height * height / (4.0 * self.droplet.diffusivity() * lambda * lambda)
    }

    /// Whether the droplet, spread to `spread` [1] times its diameter [m], is solid within the contact time [s].
    pub fn is_arrested(&self, diameter: f64, spread: f64, contact_time: f64) -> bool {
        self.freezing_time(2.0 * diameter / (3.0 * spread * spread)) <= contact_time
    }

    /// `lambda` [1] by bisection.
    fn growth(&self) -> f64 {
        let capacity = self.droplet.heat_capacity;
        let heat = self.heat_of_fusion + capacity * (self.temperature - self.melting_point);
        let driving = capacity * (self.melting_point - self.wall_temperature) / heat;
        let ratio = self.droplet.effusivity() / self.wall.effusivity();
        let (mut low, mut high) = (0.0, LARGEST_GROWTH);
        for _ in 0..ROOT_HALVINGS {
            let middle = 0.5 * (low + high);
            if neumann(middle, ratio) < driving { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }
}

/// Upper end of the search for `lambda`: at 5 the layer has needed 1e11 times its heat of fusion.
const LARGEST_GROWTH: f64 = 5.0;
/// Halvings of that range, down to rounding.
const ROOT_HALVINGS: u32 = 55;
/// Terms of the series, enough for `lambda` up to [`LARGEST_GROWTH`].
const TERMS: u32 = 150;

/// `sqrt(pi) lambda exp(lambda²) (erf(lambda) + ratio)`, rising in `lambda`, by
/// `sqrt(pi) exp(x²) erf(x) = 2 x sum_n (2 x²)^n/(1·3·…·(2n+1))`.
fn neumann(lambda: f64, ratio: f64) -> f64 {
    let square = lambda * lambda;
    let (mut term, mut sum) = (1.0, 1.0);
    for n in 1..TERMS {
        term *= 2.0 * square / f64::from(2 * n + 1);
        sum += term;
    }
    2.0 * square * sum + std::f64::consts::PI.sqrt() * lambda * square.exp() * ratio
}

#[cfg(test)]
mod tests {
    use super::super::drop_rebound::contact_time;
    use super::*;
    use approx::assert_relative_eq;

    /// Molybdenum droplet on tungsten: conductivity 85 and 118 W/(m K), heat capacity 400 and 148
    /// J/(kg K) near the temperatures of the impact, heat of fusion 3.9e5 J/kg, as commonly
    /// tabulated (not re-read).
    const MOLYBDENUM_ON_TUNGSTEN: FreezingDroplet = FreezingDroplet {
        droplet: ThermalProperties { density: 9330.0, heat_capacity: 400.0, conductivity: 85.0 },
        wall: ThermalProperties { density: 19000.0, heat_capacity: 148.0, conductivity: 118.0 },
        temperature: 2900.0,
        wall_temperature: 1000.0,
        melting_point: 2896.0,
        heat_of_fusion: 3.9e5,
    };

    /// By hand: effusivities sqrt(85·9330·400) = 17811 and sqrt(118·19000·148) = 18216; 1939.3 K.
    #[test]
    fn the_contact_temperature_lies_between_by_effusivity() {
        assert_relative_eq!(MOLYBDENUM_ON_TUNGSTEN.droplet.effusivity(), 17811.0, max_relative = 1e-4);
        assert_relative_eq!(MOLYBDENUM_ON_TUNGSTEN.contact_temperature(), 1939.3, max_relative = 1e-4);
        let insulator = ThermalProperties { conductivity: 1e-12, ..MOLYBDENUM_ON_TUNGSTEN.wall };
        let isolated = FreezingDroplet { wall: insulator, ..MOLYBDENUM_ON_TUNGSTEN };
        assert_eq!(isolated.freezing_time(1e-6), f64::INFINITY);
    }

    /// MIGRAINE, Fig 7b: droplets of 14 µm on a wall below 1000 K freeze before they can leave.
    #[test]
    fn molybdenum_is_arrested_on_cold_tungsten_and_not_on_hot() {
        let contact = contact_time(9330.0, 2.29, 14e-6);
        for spread in [1.2, 2.0] {
            assert!(MOLYBDENUM_ON_TUNGSTEN.is_arrested(14e-6, spread, contact));
            let hot = FreezingDroplet { wall_temperature: 2890.0, ..MOLYBDENUM_ON_TUNGSTEN };
            assert!(!hot.is_arrested(14e-6, spread, contact));
        }
        let share = MOLYBDENUM_ON_TUNGSTEN.freezing_time(2.0 * 14e-6 / (3.0 * 1.44)) / contact;
        assert!((0.4..0.7).contains(&share), "{share}");
    }

    /// Conduction by finite differences in wall and drop, with the heat of fusion in the enthalpy
    /// of each cell: the front has passed the height after the freezing time. Drop at its melting
    /// point, as in Neumann's solution.
    #[test]
    fn the_freezing_time_is_that_of_conduction_with_an_enthalpy() {
        let case = FreezingDroplet { temperature: 2896.0, ..MOLYBDENUM_ON_TUNGSTEN };
        let (cells, front) = (600_usize, 100_usize);
        let size = 5e-6 / front as f64;
        // Cells below `cells` are wall, those above drop; energies [J/m³] over the frozen drop at its melting point.
        let [drop, wall] = [case.droplet, case.wall];
        let capacity = |of: ThermalProperties| of.density * of.heat_capacity;
        let fusion = drop.density * case.heat_of_fusion;
        let mut energy = vec![capacity(wall) * (1000.0 - 2896.0); cells];
        energy.extend(vec![fusion; cells]);
        let step = 0.2 * size * size / wall.diffusivity().max(drop.diffusivity());
        let mut time = 0.0;
        while energy[cells + front] > 0.5 * fusion {
            let temperature = |cell: usize| {
                let of = if cell < cells { wall } else { drop };
                if cell >= cells && energy[cell] > 0.0 { 0.0 } else { energy[cell] / capacity(of) }
            };
            let flux: Vec<f64> = (1..2 * cells)
                .map(|right| {
                    let of = |cell| if cell < cells { wall } else { drop };
                    let resistance =
                        0.5 * size / of(right - 1).conductivity + 0.5 * size / of(right).conductivity;
                    (temperature(right - 1) - temperature(right)) / resistance
                })
                .collect();
            for (left, flux) in flux.iter().enumerate() {
                energy[left] -= flux * step / size;
                energy[left + 1] += flux * step / size;
            }
            time += step;
        }
        let height = (front as f64 + 0.5) * size;
        assert_relative_eq!(case.freezing_time(height), time, max_relative = 0.02);
    }
}
