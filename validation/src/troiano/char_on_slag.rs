//! Fate of a char particle on a molten slag layer: the four fates of Montagnaro & Salatino,
//! Combust. Flame 157 (2010) 874, in their words. Their criteria were not available: the forms
//! below are derived here, *assumed*.
//!
//! *Entrapment*, drawn into the melt. A sphere of radius `R = d/2` crosses a flat surface with the
//! free energy `F(h) = pi sigma (h² - 2 R h (1 + cos theta))`, `h` [m] the depth to which it is
//! wetted and `theta` [rad] the contact angle through the slag. It rests at `h = R (1 + cos
//! theta)`; from there, submerging takes `W = pi R² sigma (1 - cos theta)²`. Stokes' drag along one
//! diameter reduces the speed by `18 mu/(rho_c d)`. Therefore, entrapment
//! - by inertia: `m (v_n - 18 mu/(rho_c d))² / 2 >= W`. The energy released by wetting up to the
//!   rest position counts as lost;
//! - by weight: `(rho_c - rho_s) g` times the sphere's volume against the most the surface can
//!   hold, `pi R sigma (1 - cos theta)`; only what is denser than the slag sinks, and `g` is the
//!   gravity into the layer (0 at a vertical wall);
//! - by wetting: at `theta = 0` it submerges by itself.
//!
//! *Over-layering*, burial on the surface: fresh slag as high as the char stands out, `d (1 - cos
//! theta)/2`, arrives before the char has burned off or the layer has carried it away. Assumed:
//! slag does not lift the char; a particle that rises with the surface is buried later or never.
//!
//! *Segregation*: it stays on the surface and burns there. *Segregation–coverage*: so much char
//! lies there that the next one hits char rather than slag: with `N = n pi d²/4 t` (`n` char
//! particles a second and area [1/(m² s)], `t` [s] their stay) the char on the wall has the
//! projected area `A = N exp(-A)`, because char that hits char is not held, and covers the share
//! `1 - exp(-A)` of [`cover::share`]. The limit is a share of one half, as for
//! [`Stickiness::THRESHOLD`](nearwall::capture::Stickiness::THRESHOLD). A simulation of falling
//! discs (in the tests) gives 0.47 at `N = 1` where this says 0.43.
//!
//! Symbols: `d` [m], `rho_c` [kg/m³], `v_n` [m/s] and `m` [kg] of the char; `sigma` [N/m], `mu` [Pa
//! s] and `rho_s` [kg/m³] of the slag. Valid for smooth spheres that are small against the
//! capillary length `sqrt(sigma/(rho_s g))`, some 4 mm for slag, and against the layer's thickness.
//! Neglected: slag entering porous char, a contact angle that falls by reaction, added mass, solid
//! slag.
//!
//! The result depends strongly on `theta`, which is poorly known: slag is called highly non-wetting
//! on char (AIChE J. 62 (2016) 659, abstract), and wets graphite poorly at first, better as it
//! reacts (Mater. Chem. Phys. 2009, a Mn-Ti-silicate slag, abstract). 90 to 160° is assumed.

use std::f64::consts::PI;

use nearwall::deposit::cover;
use nearwall::slag::Molten;

/// A char particle and the slag it has reached. All finite and positive unless said.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CharOnSlag {
    /// Diameter `d` [m].
    pub diameter: f64,
    /// Density [kg/m³].
    pub density: f64,
    /// Speed towards the slag `v_n` [m/s], not negative.
    pub normal_speed: f64,
    /// The slag at its temperature.
    pub slag: Molten,
    /// Contact angle of slag on char, measured through the slag, `theta` [rad], 0 (wets) to pi.
    pub contact_angle: f64,
    /// Gravity into the layer `g` [m/s²]: 0 at a vertical wall, 9.81 on a floor.
    pub gravity: f64,
    /// Mass of fresh slag that arrives on the wall [kg/(m² s)], not negative.
    pub slag_flux: f64,
    /// Number of char particles that arrive on the wall, `n` [1/(m² s)], not negative.
    pub char_flux: f64,
    /// Time the char takes to burn off [s].
    pub burn_time: f64,
    /// Time the flowing layer takes to carry it away [s]; may be infinite.
    pub drain_time: f64,
}

/// Fate of the char.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CharFate {
    /// The melt draws it in.
    Entrapment,
    /// Fresh slag buries it.
    OverLayering,
    /// It stays on the surface and burns there.
    Segregation,
    /// It stays on a surface that char covers.
    SegregationCoverage,
}

/// The fate of a char particle and the numbers that decide it, in the order of their tests.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judgement {
    /// The fate.
    pub fate: CharFate,
    /// Kinetic energy left after drag over the work of submerging [1]: entrapped from 1 on.
    pub inertia: f64,
    /// Weight less buoyancy over the force that the surface can hold [1]: entrapped from 1 on;
    /// negative where it floats.
    pub weight: f64,
    /// Share of its height that is under the surface at rest, `(1 + cos theta)/2` [1]: entrapped at 1.
    pub immersion: f64,
    /// Fresh slag during its stay over the slag that buries it [1]: over-layered from 1 on.
    pub burial: f64,
    /// Share of the wall that char covers [1]: segregation–coverage from a half on.
    pub coverage: f64,
}

/// Work [J] to submerge a floating sphere, `pi R² sigma (1 - cos theta)²`, from its diameter [m], the surface tension
/// [N/m] and the contact angle [rad].
pub fn submerging_work(diameter: f64, surface_tension: f64, contact_angle: f64) -> f64 {
    PI / 4.0 * diameter * diameter * surface_tension * (1.0 - contact_angle.cos()).powi(2)
}

/// Largest force [N] with which a surface holds a small sphere up, `pi R sigma (1 - cos theta)`,
/// from its diameter [m], the surface tension [N/m] and the contact angle [rad].
pub fn holding_force(diameter: f64, surface_tension: f64, contact_angle: f64) -> f64 {
    PI / 2.0 * diameter * surface_tension * (1.0 - contact_angle.cos())
}

/// Share of a wall that char covers [1], `1 - exp(-A)` with `A exp(A) = N`, from the area `N` [1]
/// that would arrive within one stay.
pub fn char_coverage(arriving: f64) -> f64 {
    if arriving.is_infinite() {
        return 1.0;
    }
    // Newton's method on the convex A exp(A) - N, from above; ln(1 + N) is never below the root.
    let mut area = arriving.ln_1p();
    for _ in 0..20 {
        area -= (area - arriving * (-area).exp()) / (1.0 + area);
    }
    cover::share(area)
}

/// A quotient with 0/0 = 0.
fn over(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}

impl CharOnSlag {
    /// Time on the wall without burial, `t` [s].
    pub fn stay(&self) -> f64 {
        self.burn_time.min(self.drain_time)
    }

    /// Speed [m/s] left after one diameter of Stokes' drag in the slag.
    pub fn speed_left(&self) -> f64 {
        (self.normal_speed - 18.0 * self.slag.viscosity / (self.density * self.diameter)).max(0.0)
    }

    /// Fresh slag [kg/m²] that buries it, as high as the char stands out.
    pub fn burying_slag(&self) -> f64 {
        0.5 * self.diameter * (1.0 - self.contact_angle.cos()) * self.slag.density
    }

    /// Its fate and the numbers that decide it.
    pub fn judge(&self) -> Judgement {
        let volume = PI / 6.0 * self.diameter.powi(3);
        let energy = 0.5 * self.density * volume * self.speed_left().powi(2);
        let sinking = (self.density - self.slag.density) * volume * self.gravity;
        let tension = self.slag.surface_tension;
        let inertia = over(energy, submerging_work(self.diameter, tension, self.contact_angle));
        let weight = over(sinking, holding_force(self.diameter, tension, self.contact_angle));
        let immersion = 0.5 * (1.0 + self.contact_angle.cos());
        let burial = over(self.stay() * self.slag_flux, self.burying_slag());
        let coverage = char_coverage(self.char_flux * PI / 4.0 * self.diameter * self.diameter * self.stay());
        let fate = if inertia >= 1.0 || weight >= 1.0 || immersion >= 1.0 {
            CharFate::Entrapment
        } else if burial >= 1.0 {
            CharFate::OverLayering
        } else if coverage >= 0.5 {
            CharFate::SegregationCoverage
        } else {
            CharFate::Segregation
        };
        Judgement { fate, inertia, weight, immersion, burial, coverage }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nearwall::ImpactRng;

    const DEGREE: f64 = PI / 180.0;

    /// Char of 75 µm at 2 m/s on the middle of Troiano's slag; contact angle, fluxes and burn time assumed.
    const CHAR: CharOnSlag = CharOnSlag {
        diameter: 75e-6,
        density: 700.0,
        normal_speed: 2.0,
        slag: Molten { density: 2750.0, viscosity: 0.1, surface_tension: 0.55 },
        contact_angle: 120.0 * DEGREE,
        gravity: 0.0,
        slag_flux: 0.01,
        char_flux: 1e7,
        burn_time: 3.0,
        drain_time: f64::INFINITY,
    };

    fn midpoints(low: f64, high: f64, steps: u32) -> impl Iterator<Item = (f64, f64)> {
        let step = (high - low) / f64::from(steps);
        (0..steps).map(move |i| (low + step * (f64::from(i) + 0.5), step))
    }

    /// The free energy of a sphere that crosses a flat surface, by summing rings of wetted solid
    /// and of lost surface from the bottom up. Its least value and its value when all of it is
    /// wetted differ by the work.
    #[test]
    fn the_work_is_the_barrier_of_the_summed_free_energy() {
        let (radius, sigma) = (40e-6, 0.5);
        for degrees in [10.0, 60.0, 90.0, 130.0, 170.0] {
            let angle = degrees * DEGREE;
            let (mut energy, mut least) = (0.0, 0.0_f64);
            for (polar, step) in midpoints(0.0, PI, 20_000) {
                // Wetted solid changes gamma by -sigma cos(theta) (Young); the disc r = R
                // sin(polar) of surface is lost.
                let wetted = 2.0 * PI * radius * radius * polar.sin() * step;
                let lost = 2.0 * PI * radius * polar.sin() * (radius * polar.cos() * step);
                energy -= sigma * (wetted * angle.cos() + lost);
                least = least.min(energy);
            }
            let work = submerging_work(2.0 * radius, sigma, angle);
            assert_relative_eq!(
                energy - least,
                work,
                max_relative = 1e-5,
                epsilon = 1e-6 * sigma * radius * radius
            );
        }
    }

    /// The surface pulls at the contact ring `R sin(polar)` with the slope that the contact angle leaves it,
    /// `polar + theta - pi`; the largest upward part over all rings is what it can hold.
    #[test]
    fn the_holding_force_is_the_largest_pull_of_the_contact_ring() {
        for degrees in [20.0, 90.0, 120.0, 175.0] {
            let angle = degrees * DEGREE;
            let pull = |polar: f64| 2.0 * PI * 40e-6 * 0.5 * polar.sin() * (polar + angle - PI).sin();
            let most = midpoints(0.0, PI, 20_000).map(|(polar, _)| pull(polar)).fold(0.0, f64::max);
            assert_relative_eq!(holding_force(80e-6, 0.5, angle), most, max_relative = 1e-6);
        }
    }

    /// Newton's law from the rest position on, with the surface's pull and Stokes' drag together:
    /// what is called entrapped by inertia gets under; what lacks a quarter of the energy for the
    /// surface alone does not.
    #[test]
    fn what_is_entrapped_by_inertia_gets_under() {
        let gets_under = |char: &CharOnSlag| {
            let radius = 0.5 * char.diameter;
            let mass = char.density * 4.0 / 3.0 * PI * radius.powi(3);
            let mut squared = char.normal_speed.powi(2);
            for (depth, step) in midpoints(radius * (1.0 + char.contact_angle.cos()), char.diameter, 20_000) {
                let slope = 2.0
                    * PI
                    * char.slag.surface_tension
                    * (depth - radius * (1.0 + char.contact_angle.cos()));
                let drag = 6.0 * PI * char.slag.viscosity * radius * squared.sqrt();
                squared -= 2.0 * (slope + drag) / mass * step;
                if squared < 0.0 {
                    return false;
                }
            }
            true
        };
        for (viscosity, degrees) in [(1e-4, 90.0), (1e-2, 90.0), (1e-2, 140.0), (0.1, 120.0), (1.0, 30.0)] {
            let slag = Molten { viscosity, ..CHAR.slag };
            let at =
                |normal_speed| CharOnSlag { slag, contact_angle: degrees * DEGREE, normal_speed, ..CHAR };
            // The speed at which the number is one, from its definition.
            let mass = CHAR.density * PI / 6.0 * CHAR.diameter.powi(3);
            let work = submerging_work(CHAR.diameter, CHAR.slag.surface_tension, degrees * DEGREE);
            let bare = (2.0 * work / mass).sqrt();
            let needed = bare + 18.0 * viscosity / (CHAR.density * CHAR.diameter);
            assert_relative_eq!(at(needed).judge().inertia, 1.0, max_relative = 1e-9);
            assert!(gets_under(&at(1.0001 * needed)), "{viscosity} {degrees}");
            assert!(!gets_under(&at(0.866 * bare)), "{viscosity} {degrees}");
        }
    }

    #[test]
    fn stokes_drag_along_one_diameter_costs_what_newtons_law_says() {
        let char = CharOnSlag { slag: Molten { viscosity: 1e-3, ..CHAR.slag }, ..CHAR };
        let (mut speed, mut depth, step) = (char.normal_speed, 0.0, 1e-9);
        let rate = 6.0 * PI * 1e-3 * 37.5e-6 / (700.0 * 4.0 / 3.0 * PI * f64::powi(37.5e-6, 3));
        while depth < char.diameter {
            depth += speed * step;
            speed -= rate * speed * step;
        }
        assert_relative_eq!(char.speed_left(), speed, max_relative = 1e-3);
    }

    #[test]
    fn limits() {
        // What the slag wets completely goes under at any speed; what it does not wet at all stands on it.
        let wetted = CharOnSlag { contact_angle: 0.0, normal_speed: 0.0, ..CHAR }.judge();
        assert_eq!((wetted.fate, wetted.immersion), (CharFate::Entrapment, 1.0));
        assert_eq!((wetted.inertia, wetted.weight), (0.0, 0.0));
        assert_eq!(CharOnSlag { contact_angle: PI, ..CHAR }.judge().immersion, 0.0);
        // Light char floats on a floor of slag; a heavy millimetre sinks, a heavy dust grain does not.
        let on_floor = |density, diameter| {
            CharOnSlag { density, diameter, gravity: 9.81, normal_speed: 0.0, ..CHAR }.judge()
        };
        assert!(on_floor(700.0, 75e-6).weight < 0.0);
        assert_ne!(on_floor(7800.0, 75e-6).fate, CharFate::Entrapment);
        assert_eq!(on_floor(7800.0, 10e-3).fate, CharFate::Entrapment);
        // No fresh slag, no burial; no other char, no coverage.
        let alone = CharOnSlag { slag_flux: 0.0, char_flux: 0.0, ..CHAR }.judge();
        assert_eq!((alone.fate, alone.burial, alone.coverage), (CharFate::Segregation, 0.0, 0.0));
        assert_eq!(CharOnSlag { slag_flux: 1.0, ..CHAR }.judge().fate, CharFate::OverLayering);
        assert_eq!(CharOnSlag { char_flux: 1e9, ..CHAR }.judge().fate, CharFate::SegregationCoverage);
        assert_eq!(CharOnSlag { normal_speed: 100.0, ..CHAR }.judge().fate, CharFate::Entrapment);
    }

    #[test]
    fn every_number_goes_one_way() {
        let rises = |of: &dyn Fn(f64) -> f64| {
            let values: Vec<f64> = (1..=50_u8).map(|i| of(f64::from(i))).collect();
            assert!(values.windows(2).all(|pair| pair[1] >= pair[0]), "{values:?}");
            assert!(values[49] > values[0]);
        };
        rises(&|x| CharOnSlag { normal_speed: x, ..CHAR }.judge().inertia);
        rises(&|x| {
            -CharOnSlag { normal_speed: 60.0, contact_angle: x * 3.0 * DEGREE, ..CHAR }.judge().inertia
        });
        rises(&|x| {
            -CharOnSlag { normal_speed: 60.0, slag: Molten { viscosity: 0.02 * x, ..CHAR.slag }, ..CHAR }
                .judge()
                .inertia
        });
        rises(&|x| CharOnSlag { gravity: 9.81, density: 100.0 * x, ..CHAR }.judge().weight);
        rises(&|x| -CharOnSlag { contact_angle: x * 3.0 * DEGREE, ..CHAR }.judge().burial);
        rises(&|x| CharOnSlag { slag_flux: 0.01 * x, ..CHAR }.judge().burial);
        rises(&|x| CharOnSlag { burn_time: x, ..CHAR }.judge().coverage);
        rises(&|x| CharOnSlag { char_flux: 1e6 * x, ..CHAR }.judge().coverage);
        assert_eq!(CharOnSlag { drain_time: 1.0, ..CHAR }.stay(), 1.0);
    }

    /// Discs fall at random on a wall without edges; one whose centre hits another is not held, the
    /// others stay for the same time. With `x = N (1 - c)`, the area held, the covered share `c` is
    /// at most `x` (no overlap: `N/(1+N)`) and at least `1 - exp(-x)` (overlap as if they did not
    /// avoid each other). 0.01 is three standard errors of the count.
    #[test]
    fn coverage_lies_between_its_bounds_and_the_formula_is_the_lower_one() {
        let seed = 20_100_874;
        println!("seed {seed}");
        let radius: f64 = 0.05;
        let apart = |a: f64, b: f64| (a - b).abs().min(1.0 - (a - b).abs());
        for arriving in [0.2, 1.0, 3.0] {
            let interval = PI * radius * radius / arriving;
            let (mut lying, mut hits, mut counted) = (std::collections::VecDeque::new(), 0.0, 0.0);
            for number in 0..30_000_u32 {
                let draw = ImpactRng::new(seed, u64::from(number));
                let (time, x, y) = (f64::from(number) * interval, draw.uniform(1), draw.uniform(2));
                while lying.front().is_some_and(|&(since, _, _): &(f64, f64, f64)| since < time - 1.0) {
                    lying.pop_front();
                }
                let hit = lying.iter().any(|&(_, a, b)| apart(x, a).hypot(apart(y, b)) < radius);
                if time > 3.0 {
                    counted += 1.0;
                    hits += if hit { 1.0 } else { 0.0 };
                }
                if !hit {
                    lying.push_back((time, x, y));
                }
            }
            let covered = hits / counted;
            let held = arriving * (1.0 - covered);
            println!("N = {arriving}: covered {covered}, formula {}", char_coverage(arriving));
            assert!(covered < held + 0.01 && covered > 1.0 - (-held).exp() - 0.01, "{arriving}: {covered}");
            assert!(covered > char_coverage(arriving) - 0.01);
        }
    }

    /// Troiano et al., section 3.1: with coal slag (0.4 to 0.7 N/m, 2500 to 3000 kg/m³, 0.01 to 1
    /// Pa s) and char of 50 to 100 µm at about 2 m/s, entrapment and over-layering do not come
    /// about. Assumed here: 90 to 160°, char of 700 to 1000 kg/m³, up to 0.01 kg/(m² s) of slag, 1
    /// to 5 s to burn off.
    #[test]
    fn troiano_coal_slag_leads_to_segregation() {
        let mut fates = std::collections::BTreeSet::new();
        let mut largest = [0.0_f64; 2];
        let ends = |low: f64, high: f64| [low, high].into_iter();
        for (surface_tension, viscosity) in ends(0.4, 0.7).flat_map(|s| [0.01, 0.1, 1.0].map(|v| (s, v))) {
            for (slag_density, diameter) in ends(2500.0, 3000.0).flat_map(|s| [50e-6, 100e-6].map(|d| (s, d)))
            {
                for (degrees, density) in
                    [90.0, 120.0, 160.0].into_iter().flat_map(|a| [700.0, 1000.0].map(|r| (a, r)))
                {
                    for (burn_time, char_flux) in ends(1.0, 5.0).flat_map(|t| [1e6, 1e8].map(|n| (t, n))) {
                        let slag = Molten { density: slag_density, viscosity, surface_tension };
                        let contact_angle = degrees * DEGREE;
                        let char = CharOnSlag {
                            diameter,
                            density,
                            slag,
                            contact_angle,
                            burn_time,
                            char_flux,
                            ..CHAR
                        };
                        let judged = char.judge();
                        fates.insert(judged.fate);
                        largest = [largest[0].max(judged.inertia), largest[1].max(judged.burial)];
                        // Without any drag: the surface alone holds it.
                        let thin = Molten { viscosity: 1e-9, ..slag };
                        assert!(CharOnSlag { slag: thin, ..char }.judge().inertia < 0.5);
                    }
                }
            }
        }
        println!("largest inertia {}, burial {}", largest[0], largest[1]);
        assert_eq!(
            fates.into_iter().collect::<Vec<_>>(),
            [CharFate::Segregation, CharFate::SegregationCoverage]
        );
    }

    /// How far that goes: over-layering is excluded while less than `rho_s d (1 - cos theta)/2` of
    /// slag arrives during the stay, by hand 2500 · 25e-6 = 0.0625 kg/m² for 50 µm at 90°.
    #[test]
    fn over_layering_is_excluded_by_the_assumed_slag_flux_alone() {
        let slag = Molten { density: 2500.0, ..CHAR.slag };
        let small = CharOnSlag { diameter: 50e-6, contact_angle: 0.5 * PI, burn_time: 5.0, slag, ..CHAR };
        let at = |slag_flux| CharOnSlag { slag_flux, ..small }.judge().fate;
        assert_eq!(at(0.0624 / 5.0), CharFate::Segregation);
        assert_eq!(at(0.0626 / 5.0), CharFate::OverLayering);
    }

    /// The wax of the same section (0.03 N/m, 1000 kg/m³, 0.02 to 0.1 Pa s): drag alone stops it.
    /// The surface alone would not, and a melt that wets its own solid would draw it in: for wax
    /// the statement stands on the contact angle, which is not given.
    #[test]
    fn troiano_wax_is_held_back_by_drag_not_by_the_surface() {
        let wax = |diameter, viscosity, contact_angle| {
            let slag = Molten { density: 1000.0, viscosity, surface_tension: 0.03 };
            CharOnSlag { diameter, density: 1000.0, slag, contact_angle, slag_flux: 1e-3, ..CHAR }.judge()
        };
        for (diameter, viscosity) in [(50e-6, 0.1), (100e-6, 0.1), (50e-6, 0.02), (100e-6, 0.02)] {
            let judged = wax(diameter, viscosity, 0.5 * PI);
            assert_eq!((judged.fate, judged.inertia), (CharFate::Segregation, 0.0));
            assert_eq!(wax(diameter, viscosity, 0.0).fate, CharFate::Entrapment);
        }
        // By hand: 1000 · 100e-6 · 4 / (3 · 0.03 · 1) = 4.44.
        assert_relative_eq!(wax(100e-6, 1e-12, 0.5 * PI).inertia, 4.444, max_relative = 1e-3);
    }
}
