//! Droplet criterion: a molten particle is deposited when it does not splash (Mundo, Sommerfeld & Tropea 1995).
//!
//! `We = rho v_n² d/sigma`, `Re = rho v_n d/mu`, `K = We^½ Re^¼ = Oh Re^1.25` with `Oh = We^½/Re`.
//! Up to `K_cr` all of the droplet stays, above it a share of its mass splashes. `rho` density
//! [kg/m³], `sigma` surface tension [N/m] and `mu` viscosity [Pa s] of the melt at the particle's
//! own temperature, `v_n` speed towards the wall [m/s], `d` diameter [m]. A particle is a droplet
//! when it is hotter than the `melting_point` of its material; a solid one is not sticky.
//!
//! Ash and slag: the viscosity follows from the composition by the `law` of the `[capture]` table
//! and the surface tension from the composition ([`crate::slag::surface_tension`]), if the material
//! has none of its own. An ash in flight is quenched glass: without a `melting_point` it is a
//! droplet from [`WORKING_VISCOSITY`] down. That is the working point of glass makers, 1e4 poise;
//! and a glass of shear modulus `G` = 3e10 Pa flows within the 1e-7 s of an elastic contact (50 µm
//! at some metres a second, Hertz) when `mu/G` is shorter, below 3e3 Pa s (*assumed* as the bound).
//! What is stiffer has stickiness 0 here; the criteria `viscosity` and `kinetic-energy` are made
//! for it.
//!
//! `K_cr = 57.7` and the normal speed in `K`: Mundo et al., Int. J. Multiphase Flow 21 (1995) 151
//! (not re-read), drops of 60 to 150 µm at 12 to 18 m/s.
//!
//! Splashed share of the mass: `min(0.75, 1.8e-4 (K² - K_cr²))`, after O'Rourke & Amsden, SAE
//! 2000-01-0271 (not re-read). They write `E² = We/(h/d + Re^-½)` with the film's thickness `h`,
//! which is `K²` on a dry wall, and `E_cr = 57.7`; the share meets its bound at their `E² = 7500`.
//! Solvers cannot split a parcel, so the deposited share is taken as the probability that all of it
//! stays (assumed).
//!
//! Valid for dry walls. `K_cr` is not universal: water drops of 12 to 100 µm at up to 100 m/s did
//! not splash at all (Visser et al., arXiv 1206.1574, abstract; `K` is 240 for the smallest at the
//! highest speed): in such cases use a larger `splash_K`. Roughness promotes prompt splashing: use
//! a smaller one. Neglected: a liquid film; the gas, without which drops splash less (arXiv
//! 1203.2718, abstract, as for roughness).
//!
//! Rebound: with a `contact_angle` of the melt on the wall [degrees] a droplet that does not splash
//! leaves whole where energy is left for it ([`drop_restitution`](super::drop_restitution)), and with
//! that restitution. `receding_angle` [degrees] pins it, `gravity` [m/s²] weighs on it where the wall is
//! below; without it a drop of `Bo` above 0.1 at 9.81 m/s² counts as outside the range. It stays if it freezes
//! before it can recoil ([`drop_freezing`](super::drop_freezing)), which is judged where the droplet has
//! `melting_point`, `heat_capacity`, `thermal_conductivity` and `heat_of_fusion`, and the wall `heat_capacity` and
//! `thermal_conductivity`. Without a contact angle all that does not splash counts as deposited; on a molten wall
//! too, where drops merge.

use super::drop_bounce::{BounceNumbers, StatedNumber};
use super::drop_freezing::{FreezingDroplet, ThermalProperties};
use super::drop_pinning::ContactAngles;
use super::drop_rebound::{contact_time, maximum_spread};
use super::drop_restitution::{BOUNCES_FROM, bounce_share, drop_restitution};
use super::melt::{Melt, MeltLaws};
use super::{StickinessCriterion, Unsuitable};
use crate::impact::{Impact, ImpactError};
use crate::input::{InputError, Section};
use crate::material::{Material, overlap};
use crate::slag::Molten;

/// `K_cr` of Mundo et al. [1]: above it a droplet splashes.
pub const SPLASH_K: f64 = 57.7;
/// `1.8e-4` of O'Rourke & Amsden [1]: splashed share for each unit of `K² - K_cr²`.
const SPLASHED_PER_K_SQUARED: f64 = 1.8e-4;
/// Largest splashed share of O'Rourke & Amsden [1].
const MOST_SPLASHED: f64 = 0.75;

/// The dimensionless numbers of a droplet that hits a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DropletNumbers {
    /// Weber number `We = rho v_n² d/sigma` [1].
    pub weber: f64,
    /// Reynolds number `Re = rho v_n d/mu` [1].
    pub reynolds: f64,
    /// `K = We^½ Re^¼` [1].
    pub splash: f64,
}

impl DropletNumbers {
    /// From the melt, the speed towards the wall `v_n` [m/s] and the diameter `d` [m].
    pub fn new(melt: &Molten, normal_speed: f64, diameter: f64) -> Self {
        let Molten { density, viscosity, surface_tension } = *melt;
        let weber = density * normal_speed * normal_speed * diameter / surface_tension;
        let reynolds = density * normal_speed * diameter / viscosity;
        Self { weber, reynolds, splash: weber.sqrt() * reynolds.sqrt().sqrt() }
    }
}

/// Share of a droplet's mass that stays on the wall [1], from `K` and `K_cr` [both 1].
pub fn deposited_share(splash: f64, splash_limit: f64) -> f64 {
    if splash <= splash_limit {
        return 1.0;
    }
    let excess = (splash - splash_limit) * (splash + splash_limit);
    1.0 - (SPLASHED_PER_K_SQUARED * excess).min(MOST_SPLASHED)
}

/// Viscosity [Pa s] from which an ash without a melting point counts as a droplet: the working point of glass.
pub const WORKING_VISCOSITY: f64 = 1e3;

/// The droplet criterion of a `[capture]` table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DropletCriterion {
    splash_limit: f64,
    laws: MeltLaws,
    contact_angles: Option<ContactAngles>,
    /// Towards the wall [m/s²], where it is given.
    gravity: Option<f64>,
}

/// Gravity [m/s²] that says whether a drop would have a weight on a floor, where the model gives none.
const USUAL_GRAVITY: f64 = 9.81;
/// Largest Bond number [1] of a drop whose weight may be left out (*assumed*; it changes `e_n` by some hundredths).
const WEIGHTLESS: f64 = 0.1;

impl DropletCriterion {
    pub(super) fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let given = section.number_within("splash_K", f64::MIN_POSITIVE, f64::INFINITY)?;
        Ok(Self {
            splash_limit: given.unwrap_or(SPLASH_K),
            laws: MeltLaws::read_optional(section)?,
            contact_angles: read_angles(section)?,
            gravity: section.number_within("gravity", 0.0, f64::INFINITY)?,
        })
    }

    pub(super) fn describe(self) -> String {
        let angle = self.contact_angles.map_or_else(String::new, |ContactAngles { contact, receding }| {
            let receding = receding.map(|angle| format!(", receding_angle {:.6}", angle.to_degrees()));
            let gravity = self.gravity.map(|gravity| format!(", gravity {gravity} m/s2"));
            let [receding, gravity] = [receding, gravity].map(Option::unwrap_or_default);
            format!(", rebound at a contact_angle of {:.6} degrees{receding}{gravity}", contact.to_degrees())
        });
        let law = self.laws.describe().map_or_else(String::new, |law| format!(", viscosity by {law}"));
        format!("droplet, splash_K {}{law}{angle}", self.splash_limit)
    }

    /// The criterion for the particle's material.
    ///
    /// # Errors
    /// [`Unsuitable`] when the material lacks properties, or the law does not apply to its composition.
    pub(super) fn prepare(self, material: &Material) -> Result<Droplet, Unsuitable> {
        let melt = self.laws.prepare(material)?;
        let name = || material.name().to_owned();
        let has = |key: &str| material.property(key).is_some();
        let composed = material.composition().is_some();
        let mut lacking = vec!["melting_point", "viscosity", "surface_tension"];
        lacking.retain(|key| match *key {
            "melting_point" => !has(key) && !composed,
            "viscosity" => melt.is_none() && !composed,
            _ => material.surface_tension_near(Impact::default().particle_temperature).is_none(),
        });
        match melt {
            _ if !lacking.is_empty() => {
                Err(Unsuitable::Lacking { material: name(), needed_by: "model = \"droplet\"", lacking })
            }
            Some(melt) => Ok(Droplet { material: Box::new(material.clone()), melt, criterion: self }),
            None => Err(Unsuitable::NoLaw { material: name() }),
        }
    }
}

/// `Bo = rho g d²/sigma` [1] of a melt, gravity `g` [m/s²] and the diameter `d` [m].
fn bond_number(melt: &Molten, gravity: f64, diameter: f64) -> f64 {
    melt.density * gravity * diameter * diameter / melt.surface_tension
}

/// `contact_angle` and `receding_angle` of a `[capture]` table.
fn read_angles(section: &Section<'_>) -> Result<Option<ContactAngles>, InputError> {
    let contact = section.number_within("contact_angle", 0.0, 180.0)?;
    let receding = section.number_within("receding_angle", 0.0, contact.unwrap_or(180.0))?;
    if contact.is_none() && receding.is_some() {
        return Err(section.fault("receding_angle", "needs a contact_angle beside it"));
    }
    Ok(contact.map(|contact| ContactAngles {
        contact: contact.to_radians(),
        receding: receding.map(f64::to_radians),
    }))
}

/// The criterion for one material.
#[derive(Debug, Clone)]
pub struct Droplet {
    material: Box<Material>,
    melt: Melt,
    criterion: DropletCriterion,
}

impl Droplet {
    /// Whether a particle at a temperature [K] is a droplet.
    fn is_molten(&self, temperature: f64) -> Result<bool, ImpactError> {
        match self.material.property("melting_point") {
            Some(_) => self.material.is_molten(temperature),
            None => Ok(self.melt.viscosity(temperature)? <= WORKING_VISCOSITY),
        }
    }

    /// The melt of an impact; `None` for a solid.
    fn molten(&self, impact: &Impact) -> Result<Option<Molten>, ImpactError> {
        let temperature = impact.particle_temperature;
        if !self.is_molten(temperature)? {
            return Ok(None);
        }
        let given = impact.particle_density;
        Ok(Some(Molten {
            density: if given > 0.0 { given } else { self.material.density(temperature)? },
            viscosity: self.melt.viscosity(temperature)?,
            surface_tension: self.material.surface_tension(temperature)?,
        }))
    }

    /// The melt of a droplet that may leave whole, with its contact angles; `None` for a solid, one that
    /// splashes, and without a contact angle.
    fn whole(&self, impact: &Impact) -> Result<Option<(ContactAngles, Molten)>, ImpactError> {
        let Some(angles) = self.criterion.contact_angles else { return Ok(None) };
        let Some(melt) = self.molten(impact)? else { return Ok(None) };
        let splash = DropletNumbers::new(&melt, impact.normal_speed, impact.diameter).splash;
        Ok((splash <= self.criterion.splash_limit).then_some((angles, melt)))
    }

    /// The numbers of the rebound.
    fn bounce_numbers(&self, impact: &Impact, melt: &Molten) -> BounceNumbers {
        let Molten { density, viscosity, surface_tension } = *melt;
        let diameter = impact.diameter;
        BounceNumbers {
            weber: DropletNumbers::new(melt, impact.normal_speed, diameter).weber,
            ohnesorge: viscosity / (density * surface_tension * diameter).sqrt(),
            bond: bond_number(melt, self.criterion.gravity.unwrap_or(0.0), diameter),
        }
    }

    /// Whether freezing on a wall arrests a droplet that would bounce; no where a thermal property is not known.
    fn is_arrested(&self, impact: &Impact, melt: &Molten, spread: f64, wall: &Material) -> bool {
        let thermal = |material: &Material, density: f64, temperature: f64| {
            Some(ThermalProperties {
                density,
                heat_capacity: material.heat_capacity_near(temperature)?,
                conductivity: material.thermal_conductivity_near(temperature)?,
            })
        };
        let freezing = || {
            let Impact { particle_temperature, wall_temperature, .. } = *impact;
            let wall_density = wall.density_near(wall_temperature).ok()?;
            Some(FreezingDroplet {
                droplet: thermal(&self.material, melt.density, particle_temperature)?,
                wall: thermal(wall, wall_density, wall_temperature)?,
                temperature: particle_temperature,
                wall_temperature,
                melting_point: self.material.melting_point_near(particle_temperature)?,
                heat_of_fusion: self.material.heat_of_fusion_near(particle_temperature)?,
            })
        };
        let time = contact_time(melt.density, melt.surface_tension, impact.diameter);
        freezing().is_some_and(|freezing| freezing.is_arrested(impact.diameter, spread, time))
    }
}

impl StickinessCriterion for Droplet {
    fn name(&self) -> &'static str {
        "droplet"
    }

    /// 0 for a solid, the deposited share for a droplet.
    fn in_flight(&self, impact: &Impact) -> Result<f64, ImpactError> {
        let Some(melt) = self.molten(impact)? else { return Ok(0.0) };
        let numbers = DropletNumbers::new(&melt, impact.normal_speed, impact.diameter);
        Ok(deposited_share(numbers.splash, self.criterion.splash_limit))
    }

    fn on_wall(&self, impact: &Impact) -> f64 {
        let temperature = impact.wall_temperature;
        // A melting point says that it is liquid; a glass is, unless it has crystallised.
        let liquid = || {
            self.material.property("melting_point").is_some() || self.film_viscosity(temperature).is_finite()
        };
        f64::from(self.is_droplet(temperature) && liquid())
    }

    fn film_viscosity(&self, temperature: f64) -> f64 {
        if self.is_droplet(temperature) { self.melt.film_viscosity(temperature) } else { f64::INFINITY }
    }

    fn liquid_viscosity(&self, temperature: f64) -> Option<f64> {
        self.melt.viscosity(temperature).ok()
    }

    fn droplet_rebound(&self, impact: &Impact, wall: &Material) -> Result<Option<f64>, ImpactError> {
        let Some((angles, melt)) = self.whole(impact)? else { return Ok(None) };
        let numbers = self.bounce_numbers(impact, &melt);
        // A disc as wide as the drop where the balance on spreading has no root.
        let reynolds = numbers.weber.sqrt() / numbers.ohnesorge;
        let spread = maximum_spread(numbers.weber, reynolds, angles.contact).unwrap_or(1.0);
        let bounces = drop_restitution(&numbers, &angles);
        Ok(bounces.filter(|_| !self.is_arrested(impact, &melt, spread, wall)))
    }

    fn left_by_rebound(&self, impact: &Impact) -> Vec<StatedNumber> {
        let Ok(Some((angles, melt))) = self.whole(impact) else { return Vec::new() };
        if bounce_share(angles.contact) == 0.0 {
            return Vec::new();
        }
        let value = angles.contact.to_degrees();
        let range = [BOUNCES_FROM.to_degrees(), 180.0];
        let mut all = vec![StatedNumber { name: "contact angle", unit: "degrees", value, range }];
        all.extend(self.bounce_numbers(impact, &melt).stated());
        if self.criterion.gravity.is_none() {
            let value = bond_number(&melt, USUAL_GRAVITY, impact.diameter);
            let name = "Bo at 9.81 m/s² (no gravity is given)";
            all.push(StatedNumber { name, unit: "", value, range: [0.0, WEIGHTLESS] });
        }
        all.retain(|number| !number.holds());
        all
    }

    /// Whether the material is molten; no where that is not known.
    fn has_droplets(&self) -> bool {
        true
    }

    fn is_droplet(&self, temperature: f64) -> bool {
        self.is_molten(temperature).unwrap_or(false)
    }

    fn known_range(&self) -> [f64; 2] {
        let [low, high] = overlap([self.material.molten_range(), self.melt.known_range()].into_iter());
        // A solid needs no property of the melt.
        let melts_known = self.is_molten(low).is_ok_and(|molten| !molten);
        [if melts_known { 0.0 } else { low }, high]
    }

    /// Whether the properties are stated to hold; a solid needs none.
    fn holds_in_flight(&self, temperature: f64) -> bool {
        let melt_holds =
            || self.material.melt_holds_at(temperature) && self.melt.holds_in_flight(temperature);
        self.is_molten(temperature) == Ok(false) || melt_holds()
    }

    fn holds_on_wall(&self, temperature: f64) -> bool {
        self.is_molten(temperature) == Ok(false)
            || self.material.melt_holds_at(temperature) && self.melt.holds_on_wall(temperature)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Document;
    use crate::material::Library;
    use approx::assert_relative_eq;

    fn droplet(material: &str) -> Droplet {
        let library = Library::built_in().unwrap();
        let document = Document::new("m.toml", "");
        let criterion = document.read(DropletCriterion::read).unwrap();
        criterion.prepare(library.get(material).unwrap()).unwrap()
    }

    fn numbers(material: &str, diameter: f64, speed: f64, temperature: f64) -> DropletNumbers {
        let melt = droplet(material).material.molten(temperature).unwrap();
        DropletNumbers::new(&melt, speed, diameter)
    }

    /// By hand from Troiano 3.1: 1000 kg/m³, 0.03 N/m and, between 0.1 Pa s at 90 °C and 0.02 at 130 °C, linear in 1/T,
    /// 0.0290 Pa s at 120 °C. We = 1000·25·120e-6/0.03 = 100; Re = 0.6/0.0290 = 20.7; K = 10·20.7^¼ = 21.3.
    #[test]
    fn wax_of_120_micrometres_at_5_metres_a_second() {
        let wax = numbers("montan-wax", 120e-6, 5.0, 393.15);
        assert_relative_eq!(wax.weber, 100.0, max_relative = 1e-12);
        assert_relative_eq!(wax.reynolds, 20.7, max_relative = 2e-3);
        assert_relative_eq!(wax.splash, 21.3, max_relative = 2e-3);
    }

    /// By hand from 9330 kg/m³, 2.29 N/m and 5.6 mPa s at the melting point: We = 1.426, Re = 116.6, K = 3.92.
    #[test]
    fn molybdenum_of_14_micrometres_at_5_metres_a_second() {
        let molybdenum = numbers("molybdenum", 14e-6, 5.0, 2896.1);
        assert_relative_eq!(molybdenum.weber, 1.426, max_relative = 2e-3);
        assert_relative_eq!(molybdenum.reynolds, 116.6, max_relative = 5e-3);
        assert_relative_eq!(molybdenum.splash, 3.92, max_relative = 3e-3);
    }

    /// Mundo et al.: K = Oh Re^1.25 with Oh = mu/sqrt(rho sigma d), which does not know the speed.
    #[test]
    fn k_is_ohnesorge_times_a_power_of_reynolds() {
        for (density, viscosity, surface_tension, diameter, speed) in [
            (1000.0, 0.029, 0.03, 120e-6, 5.0),
            (9330.0, 5.6e-3, 2.29, 14e-6, 1.0),
            (998.0, 1e-3, 0.072, 1e-3, 18.0),
        ] {
            let k = DropletNumbers::new(&Molten { density, viscosity, surface_tension }, speed, diameter);
            let ohnesorge = viscosity / f64::sqrt(density * surface_tension * diameter);
            assert_relative_eq!(k.splash, ohnesorge * k.reynolds.powf(1.25), max_relative = 1e-12);
        }
    }

    /// O'Rourke & Amsden's bound of 0.75 belongs to E² = 7500: their three numbers agree with one another.
    #[test]
    fn the_deposited_share_is_continuous_falls_and_ends() {
        assert_eq!(deposited_share(0.0, SPLASH_K), 1.0);
        assert_eq!(deposited_share(SPLASH_K, SPLASH_K), 1.0);
        assert!((deposited_share(SPLASH_K * (1.0 + 1e-9), SPLASH_K) - 1.0).abs() < 1e-8);
        let shares: Vec<f64> = (0..200_u8).map(|k| deposited_share(f64::from(k), SPLASH_K)).collect();
        assert!(shares.windows(2).all(|pair| pair[1] <= pair[0]));
        assert_relative_eq!(deposited_share(7500_f64.sqrt(), SPLASH_K), 0.25, max_relative = 4e-3);
        assert_eq!(deposited_share(1e200, SPLASH_K), 0.25);
        assert_eq!(deposited_share(f64::INFINITY, 1e200), 0.25);
    }

    #[test]
    fn solids_are_not_sticky_and_melts_have_an_end() {
        let wax = droplet("montan-wax");
        let at = |particle_temperature| {
            wax.in_flight(&Impact { normal_speed: 1.0, particle_temperature, ..Impact::default() })
        };
        assert_eq!((at(293.15), at(353.15), at(353.2)), (Ok(0.0), Ok(0.0), Ok(1.0)));
        assert!(matches!(at(404.0), Err(ImpactError::OutOfRange { property: "viscosity", .. })));
        assert_eq!(wax.known_range(), [0.0, 403.15]);
        assert!(wax.holds_in_flight(293.15) && !wax.holds_in_flight(354.0) && wax.holds_in_flight(380.0));
    }
}
