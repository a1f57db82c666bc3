//! Deposits as a model sees them: which particles are molten on a wall, what an impact meets there, how the melt flows.

use super::Model;
use super::wall::Wall;
use super::wall_heat::WallHeatError;
use crate::capture::{Stickiness, lowest};
use crate::deposit::process::{DepositHeat, PowderMaterial, Step};
use crate::deposit::{
    CapturedParticles, Deposit, DepositSource, Losses, StepHeat, Surroundings, WallMelt, cover, layers,
    wetting,
};
use crate::impact::{Impact, ImpactError};
use crate::material::Material;

impl Model {
    /// Adds captured particles of this impact to `arrivals`: their `mass` per area of wall [kg/m²],
    /// with the particle's `density` [kg/m³].
    ///
    /// They are molten when the wall is hotter than their material is solid
    /// ([`StickinessCriterion::solid_below`](crate::capture::StickinessCriterion::solid_below)), unless
    /// an effect on the particle's stickiness leaves less than [`Stickiness::THRESHOLD`] there, as
    /// carbon does. In a model whose stickiness does not depend on the particle temperature, their
    /// state is that of the impact.
    ///
    /// # Errors
    /// [`ImpactError`] for an impact, a mass or a density without physical meaning, or an unknown wall.
    pub fn add_captured(
        &self,
        wall: usize,
        impact: &Impact,
        mass: f64,
        density: f64,
        arrivals: DepositSource,
    ) -> Result<DepositSource, ImpactError> {
        self.at_wall(wall, &mut { *impact })?;
        at_least_zero("mass", mass)?;
        if !(density.is_finite() && density > 0.0) {
            let reason = "must be positive and finite";
            return Err(ImpactError::Unusable { quantity: "density".into(), value: density, reason });
        }
        let molten = self.is_liquid(impact, impact.conversion);
        let Impact { diameter, conversion, .. } = *impact;
        Ok(arrivals.with(&CapturedParticles { mass, density, diameter, conversion, molten }))
    }

    /// The deposit on a wall according to the model file, with a share `voidage` of voids in the
    /// powder [1]: the initial and minimum deposit. A `coverage` alone has no mass, which the file
    /// does not give; a `layer_thickness` is powder of the particles' density and covers the wall
    /// as grains of 100 µm do (*assumed*).
    ///
    /// # Errors
    /// [`ImpactError`] for a voidage without physical meaning, an unknown wall, or an unknown density.
    pub fn initial_deposit(&self, wall: usize, voidage: f64) -> Result<Deposit, ImpactError> {
        check_voidage(voidage)?;
        let wall = self.walls.get(wall).ok_or(ImpactError::NoSuchWall(wall))?;
        let solid = wall.covering.layer_thickness * (1.0 - voidage);
        let powder = solid * self.particle.material.density_near(Impact::default().wall_temperature)?;
        let covered = -(1.0 - wall.covering.coverage).max(f64::MIN_POSITIVE).ln();
        let cover = covered.max(cover::of_layer(wall.covering.layer_thickness, Impact::default().diameter));
        Ok(Deposit { powder, solid, cover, ..Deposit::default() })
    }

    /// The impact with a deposit on the wall: sets the share of the wall that powder with a `voidage`
    /// [1] covers, its mean thickness over the wall, and the thickness of the slag, which is stiff or
    /// liquid by the temperature of its surface.
    ///
    /// # Errors
    /// [`ImpactError`] for a deposit or a voidage without physical meaning, or an unknown wall.
    pub fn apply_deposit(
        &self,
        wall: usize,
        deposit: &Deposit,
        voidage: f64,
        impact: &Impact,
    ) -> Result<Impact, ImpactError> {
        let Deposit { molten, powder, solid, cover, closed, frozen, behind, .. } = *deposit;
        let sizes = [
            ("molten", molten),
            ("powder", powder),
            ("solid", solid),
            ("cover", cover),
            ("closed", closed),
            ("frozen", frozen),
            ("behind", behind),
        ];
        for (quantity, value) in sizes {
            at_least_zero(quantity, value)?;
        }
        check_voidage(voidage)?;
        let melt_thickness = deposit.slag() / self.melt(wall, impact.wall_temperature)?.density;
        let enclosed = deposit.enclosed();
        let thickness = deposit.layer_thickness(voidage);
        let [coverage, layer_thickness] = layers::powder_met(
            [deposit.coverage(), cover::share(deposit.cover * enclosed)],
            [thickness * (1.0 - enclosed), thickness * enclosed],
            melt_thickness,
            impact.diameter,
        );
        Ok(Impact { layer_thickness, coverage, melt_thickness, ..*impact })
    }

    /// The melt on a wall at a temperature [K]: that of the wall's slag, else that of the
    /// particles. Outside the temperatures of a table, its value at the nearest end is used.
    ///
    /// # Errors
    /// [`ImpactError::NoSuchWall`], or an unknown density.
    pub fn melt(&self, wall: usize, temperature: f64) -> Result<WallMelt, ImpactError> {
        let wall = self.walls.get(wall).ok_or(ImpactError::NoSuchWall(wall))?;
        self.wall_melt(wall, temperature)
    }

    /// What melt on a wall consists of: its slag, else what melts of the particles.
    pub(super) fn melt_material<'a>(&'a self, wall: &'a Wall) -> &'a Material {
        wall.slag.as_ref().unwrap_or_else(|| self.particle.melting())
    }

    fn wall_melt(&self, wall: &Wall, temperature: f64) -> Result<WallMelt, ImpactError> {
        let material = self.melt_material(wall);
        let criterion = if wall.slag.is_some() { &wall.melt } else { &self.stickiness };
        let viscosity = criterion.as_ref().map_or(f64::INFINITY, |melt| melt.film_viscosity(temperature));
        let surface_tension = material.surface_tension_near(temperature);
        Ok(WallMelt { density: material.density_near(temperature)?, viscosity, surface_tension })
    }

    /// The slag that an impact meets as a solid between the powder: stiff, and on more than half of the
    /// wall.
    pub(super) fn frozen_slag<'a>(&'a self, wall: &'a Wall, impact: &Impact) -> Option<&'a Material> {
        let thickness = impact.melt_thickness;
        let is_solid = || self.slag_melts_at(wall).is_some_and(|limit| impact.wall_temperature < limit);
        let is_met = thickness > 0.0 && wetting::share(thickness, impact.diameter) > 0.5 && is_solid();
        is_met.then(|| self.melt_material(wall))
    }

    /// The melt that an impact meets on bare wall, with the thickness of its film; `None` where
    /// there is none, or it is stiff.
    pub(super) fn melt_met(&self, wall: &Wall, impact: &Impact) -> Result<Option<WallMelt>, ImpactError> {
        if wall.slag.is_none() && impact.melt_thickness == 0.0 {
            return Ok(None);
        }
        let melt = self.wall_melt(wall, impact.wall_temperature)?;
        Ok(melt.viscosity.is_finite().then_some(melt))
    }

    /// Stickiness of the bare wall [1]: the larger of that of its slag and that of the melt from
    /// earlier particles, where the melt wets the wall.
    pub(super) fn wall_stickiness(&self, wall: &Wall, impact: &Impact) -> f64 {
        let own = wall.slag_stickiness(impact);
        if impact.melt_thickness == 0.0 || !self.stickiness_depends_on_temperature() {
            return own;
        }
        let wet = wetting::share(impact.melt_thickness, impact.diameter);
        own.max(wet * self.stickiness_as_melt(impact, 1.0))
    }

    /// Whether the melt on the wall is within the range for which the capture criterion is stated.
    pub(super) fn melt_holds(&self, impact: &Impact) -> bool {
        let mut criteria = self.stickiness.iter();
        impact.melt_thickness == 0.0
            || criteria.all(|criterion| criterion.holds_on_wall(impact.wall_temperature))
    }

    /// Stickiness [1] of the particle's material on the wall, at the wall's temperature and with a
    /// conversion [1]: the product of what the capture criterion and the effects give, 0 without
    /// any.
    fn stickiness_as_melt(&self, impact: &Impact, conversion: f64) -> f64 {
        let on_wall = Impact { particle_temperature: impact.wall_temperature, conversion, ..*impact };
        let criterion = self.stickiness.as_ref().map(|criterion| criterion.on_wall(&on_wall));
        let terms = self.stickiness_of_terms(&on_wall);
        criterion.into_iter().chain(terms).reduce(|product, share| product * share).unwrap_or(0.0)
    }

    /// What each effect on the particle's stickiness gives [1].
    fn stickiness_of_terms(&self, impact: &Impact) -> impl Iterator<Item = f64> {
        self.terms.iter().filter_map(move |term| term.effect().particle_stickiness(impact))
    }

    /// Whether material of the particles with a carbon conversion [1] is liquid on the wall of an impact.
    fn is_liquid(&self, impact: &Impact, conversion: f64) -> bool {
        let on_wall = Impact { particle_temperature: impact.wall_temperature, conversion, ..*impact };
        let by_terms = self.stickiness_of_terms(&on_wall).reduce(|product, share| product * share);
        let hot = self.solid_below.is_some_and(|limit| impact.wall_temperature >= limit);
        match by_terms {
            Some(sticky) => (self.stickiness.is_none() || hot) && sticky >= Stickiness::THRESHOLD,
            None => self.stickiness.is_some() && hot,
        }
    }

    /// As [`Self::is_liquid`], of an impact of which only the wall's temperature [K] counts.
    fn is_liquid_at(&self, wall_temperature: f64, conversion: f64) -> bool {
        self.is_liquid(&Impact { wall_temperature, ..Impact::default() }, conversion)
    }

    /// Heat [J/kg] that a captured particle of this impact brings to the surface: sensible heat down to
    /// the temperature of the wall, `c_p (T_p - T_w)`, and the heat of fusion where it was liquid and
    /// lands as a solid; less that heat where it was solid and lands as melt. `heat_capacity` [J/(kg K)]
    /// where the caller knows it, else that of the particles' material. `None` where neither is known.
    pub fn heat_brought(&self, impact: &Impact, heat_capacity: Option<f64>) -> Option<f64> {
        let Impact { particle_temperature, wall_temperature, conversion, .. } = *impact;
        let material = self.particle.melting();
        let capacity = heat_capacity.or_else(|| material.heat_capacity_near(impact.mean_temperature()))?;
        let melts_at = self.liquid_from.unwrap_or(f64::INFINITY);
        let liquid = [particle_temperature >= melts_at, self.is_liquid(impact, conversion)];
        let [before, after] = liquid.map(|liquid| f64::from(u8::from(liquid)));
        let fusion = material.heat_of_fusion_near(particle_temperature).unwrap_or(0.0);
        Some(capacity * (particle_temperature - wall_temperature) + fusion * (before - after))
    }

    /// The lowest temperature [K] at which material of the particles with a carbon conversion [1] is
    /// liquid; `None` where there is none, or no temperature decides it.
    fn lowest_liquid(&self, conversion: f64) -> Option<f64> {
        let liquid = |temperature: f64| self.is_liquid_at(temperature, conversion);
        if !self.stickiness_depends_on_temperature() {
            return None;
        }
        self.solid_below.filter(|limit| *limit > 0.0 && liquid(*limit)).or_else(|| lowest(liquid))
    }

    /// Temperature [K] below which slag on a wall is solid; `None` where it is not known.
    pub(super) fn slag_melts_at(&self, wall: &Wall) -> Option<f64> {
        if wall.slag.is_some() { wall.slag_solid_below } else { self.liquid_from }
    }

    /// Temperature [K] from which powder with a carbon conversion [1] melts; infinite for powder that
    /// does not.
    pub(super) fn powder_melts_at(&self, conversion: f64) -> f64 {
        let same = |from: &f64| self.is_liquid_at(*from, conversion);
        self.liquid_from.filter(same).or_else(|| self.lowest_liquid(conversion)).unwrap_or(f64::INFINITY)
    }

    /// Computes what depends on the criteria and the terms alone.
    pub(super) fn set_melting(&mut self) {
        self.solid_below = self.stickiness.as_ref().and_then(|criterion| criterion.solid_below());
        self.liquid_from = self.lowest_liquid(1.0);
        for wall in &mut self.walls {
            wall.slag_solid_below = wall.melt.as_ref().and_then(|melt| melt.solid_below());
        }
    }

    /// The deposit on a wall after a time step [s] in these surroundings, the mass that each process
    /// took from it [kg/m²], by the table [`PROCESSES`](crate::deposit::PROCESSES), and the heat that
    /// crossed it.
    ///
    /// # Errors
    /// [`WallHeatError`] for surroundings or a duration without physical meaning, an unknown wall, or
    /// a cooled wall without a heat balance.
    pub fn advance(
        &self,
        wall: usize,
        deposit: &Deposit,
        surroundings: &Surroundings,
        duration: f64,
    ) -> Result<(Deposit, Losses, StepHeat), WallHeatError> {
        surroundings.check()?;
        at_least_zero("duration", duration)?;
        let of = self.walls.get(wall).ok_or(ImpactError::NoSuchWall(wall))?;
        let heat = match (&surroundings.cooling, surroundings.wall_temperature) {
            (Some(cooling), _) => {
                let (thermal, flow, _) = self.thermal_layers(wall, deposit, surroundings.voidage, cooling)?;
                let resistance = thermal.resistance(&deposit.layers());
                let front = thermal.after_flow(&deposit.layers(), &flow, duration)?;
                let released = (thermal.hot.particle_flux - cooling.hot.particle_flux) * duration;
                DepositHeat::Cooled { flow, front, released, resistance }
            }
            (None, Some(temperature)) => DepositHeat::Isothermal {
                liquid: self.slag_melts_at(of).map(|melts_at| temperature >= melts_at),
            },
            _ => DepositHeat::Unknown,
        };
        let step = Step { powder: self, surroundings, heat, duration };
        let (left, losses) = of.processes.advance(deposit, &step);
        Ok((left, losses, heat.crossed()))
    }

    /// Whether the stickiness of the particles depends on their temperature.
    fn stickiness_depends_on_temperature(&self) -> bool {
        let depends = |term: &crate::effect::Term| {
            let sticky = term.effect().particle_stickiness(&Impact::default()).is_some();
            sticky && term.kind().inputs.contains(&"T_p")
        };
        self.stickiness.is_some() || self.terms.iter().any(depends)
    }
}

impl PowderMaterial for Model {
    /// Those of the particles' melt.
    fn sintering(&self, temperature: f64) -> Option<[f64; 2]> {
        let viscosity = self.stickiness.as_ref()?.glass_viscosity(temperature);
        Some([viscosity, self.particle.melting().surface_tension_near(temperature)?])
    }
}

pub(super) fn check_voidage(voidage: f64) -> Result<(), ImpactError> {
    if (0.0..1.0).contains(&voidage) {
        return Ok(());
    }
    let reason = "must be at least 0 and below 1";
    Err(ImpactError::Unusable { quantity: "voidage".into(), value: voidage, reason })
}

pub(super) fn at_least_zero(quantity: &'static str, value: f64) -> Result<(), ImpactError> {
    if value.is_finite() && value >= 0.0 {
        return Ok(());
    }
    Err(ImpactError::Unusable { quantity: quantity.into(), value, reason: "must be finite and not negative" })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::Regime;
    use crate::rng::ImpactRng;
    use approx::assert_relative_eq;

    const ASH: &str = r#"
[particle]
material = "fly-ash"
[walls.default]
material = "refractory"
[walls.slag]
material = "refractory"
slag = "coal-slag"
[normal]
model = "constant"
e_n = 0.4
[tangential]
model = "constant"
e_t = 0.7
[capture]
model = "viscosity"
law = "kalmanovitch-frank"
reference_viscosity = 25
[[effects]]
kind = "conversion-transition"
threshold = 0.9
width = 0.01
"#;

    fn model() -> Model {
        Model::from_toml("m", ASH).unwrap()
    }

    fn at(wall_temperature: f64) -> Impact {
        Impact {
            normal_speed: 1.0,
            diameter: 60e-6,
            particle_temperature: 1900.0,
            wall_temperature,
            conversion: 1.0,
            ..Impact::default()
        }
    }

    fn captured(impact: &Impact) -> f64 {
        // A dry particle: only the wall captures it.
        let dry = Impact { conversion: 0.2, ..*impact };
        model().resolve(0, &dry, ImpactRng::default()).unwrap().sticking_probability
    }

    #[test]
    fn particles_that_freeze_or_contain_carbon_are_powder() {
        let arrive =
            |impact: &Impact| model().add_captured(0, impact, 1.0, 2000.0, DepositSource::default()).unwrap();
        assert_eq!(arrive(&at(1900.0)).molten, 1.0);
        assert_eq!(arrive(&at(1100.0)).powder, 1.0);
        assert_eq!(arrive(&Impact { conversion: 0.5, ..at(1900.0) }).powder, 1.0);
        let area = 1.5 / (2000.0 * 60e-6);
        assert_relative_eq!(arrive(&at(1100.0)).cover, area);
        // The melt spreads to twice its diameter.
        assert_relative_eq!(arrive(&at(1900.0)).buried, 4.0 * area);
    }

    #[test]
    fn melt_on_a_hot_wall_makes_it_sticky_and_on_a_cold_one_never() {
        let melt = |wall_temperature, melt_thickness| Impact { melt_thickness, ..at(wall_temperature) };
        let dry = captured(&melt(1900.0, 0.0));
        assert!(dry < 1e-6, "{dry}");
        let shares = [1e-7, 1e-6, 1e-5, 1e-3].map(|thickness| captured(&melt(1900.0, thickness)));
        assert!(shares.is_sorted() && shares[3] > 0.999, "{shares:?}");
        // p_stick of a dry particle is the wall's stickiness: here what is wet, 1 - exp(-6/60), times what the
        // conversion-transition leaves of a burnt-out particle's, 1/(1 + exp(-10)).
        let wall: f64 = (1.0 - (-0.1_f64).exp()) / (1.0 + (-10.0_f64).exp());
        assert_relative_eq!(shares[1], wall, max_relative = 1e-12);
        for thickness in [1e-6, 1e-3, 1.0] {
            assert!(captured(&melt(1000.0, thickness)) < 1e-3, "{thickness}");
        }
        let hot = Impact { conversion: 0.2, ..melt(1900.0, 1e-3) };
        assert_eq!(model().resolve(0, &hot, ImpactRng::default()).unwrap().regime, Regime::NspSw);
        let covered = Impact { coverage: 1.0, ..hot };
        assert_eq!(model().resolve(0, &covered, ImpactRng::default()).unwrap().regime, Regime::NspNsw);
    }

    #[test]
    fn without_a_melting_temperature_no_wall_is_sticky() {
        let text = ASH
            .replace(
                "[capture]",
                "[[effects]]\nkind = \"powder-layer\"\nthickness = 1e-4\nresidual = 0.25\n#",
            )
            .replace("model = \"viscosity\"\nlaw", "#law")
            .replace("reference_viscosity", "#reference_viscosity")
            .replace("slag = \"coal-slag\"", "");
        let model = Model::from_toml("m", &text).unwrap();
        let wet = Impact { conversion: 0.2, melt_thickness: 1.0, ..at(1900.0) };
        assert!(model.resolve(0, &wet, ImpactRng::default()).unwrap().sticking_probability < 1e-6);
        assert_eq!(model.melt(0, 1900.0).unwrap().viscosity, f64::INFINITY);
    }

    const WAX: &str = r#"
[particle]
material = "montan-wax"
[walls.default]
material = "pyrex"
[normal]
model = "constant"
e_n = 0.4
[tangential]
model = "constant"
e_t = 0.7
[capture]
model = "droplet"
"#;

    /// The wax melts at 80 °C, and its viscosity there is given from 80 to 130 °C.
    #[test]
    fn by_the_droplet_criterion_a_deposit_is_molten_above_the_melting_point() {
        let wax = Model::from_toml("m", WAX).unwrap();
        // Fast enough to splash; captured nevertheless.
        let at = |wall_temperature, particle_temperature| Impact {
            normal_speed: 30.0,
            diameter: 120e-6,
            particle_temperature,
            wall_temperature,
            ..Impact::default()
        };
        let arrive =
            |impact: &Impact| wax.add_captured(0, impact, 1.0, 960.0, DepositSource::default()).unwrap();
        assert_eq!(arrive(&at(370.0, 300.0)).molten, 1.0);
        assert_eq!(arrive(&at(350.0, 370.0)).powder, 1.0);
        assert_eq!(wax.melt(0, 350.0).unwrap().viscosity, f64::INFINITY);
        let known = wax.particle().viscosity(370.0).unwrap();
        assert_eq!(wax.melt(0, 370.0).unwrap().viscosity, known);
        assert_eq!(wax.melt(0, 500.0).unwrap().viscosity, wax.particle().viscosity(403.15).unwrap());

        let resolve = |melt_thickness, impact| {
            wax.resolve(0, &Impact { melt_thickness, ..impact }, ImpactRng::default()).unwrap()
        };
        let wet: f64 = 1.0 - (-6.0_f64 * 10.0 / 120.0).exp();
        let solid = resolve(10e-6, at(370.0, 300.0));
        assert_relative_eq!(solid.sticking_probability, wet, max_relative = 1e-12);
        assert_eq!(resolve(10e-6, at(350.0, 300.0)).sticking_probability, 0.0);
        let [dry, drowned] = [0.0, 1.0].map(|thickness| resolve(thickness, at(370.0, 370.0)));
        assert!(dry.sticking_probability < 1.0, "{dry:?}");
        assert_eq!(drowned.sticking_probability, dry.sticking_probability);
        assert_eq!((dry.regime, drowned.regime), (Regime::NspNsw, Regime::NspSw));
    }

    #[test]
    fn a_deposit_sets_the_inputs_of_an_impact() {
        let deposit = Deposit {
            molten: 0.055,
            powder: 0.1,
            solid: 1e-4,
            cover: 2.0,
            conversion: 0.5,
            ..Deposit::default()
        };
        let changed = model().apply_deposit(1, &deposit, 0.5, &at(1700.0)).unwrap();
        assert_eq!(changed.layer_thickness, 2e-4);
        assert_relative_eq!(changed.coverage, 1.0 - (-2.0_f64).exp(), max_relative = 1e-15);
        // The slag's 2750 kg/m³ on its wall, the ash's own 2300 elsewhere.
        assert_relative_eq!(changed.melt_thickness, 2e-5);
        let elsewhere = model().apply_deposit(0, &deposit, 0.5, &at(1700.0)).unwrap();
        assert_relative_eq!(elsewhere.melt_thickness, 0.055 / 2300.0);
        let none = model().apply_deposit(0, &Deposit::default(), 0.5, &at(1700.0)).unwrap();
        assert_eq!(none, at(1700.0));
    }

    /// 1 - exp(-A) = 0.4 for A = ln(1/0.6); 0.2 mm of powder with half voids, of the ash's 2300
    /// kg/m³, covers like a hundred micrometre grains, 1.5 * 1e-4/1e-4.
    #[test]
    fn the_initial_deposit_is_that_of_the_model_file() {
        let given = |text: &str| {
            let text = ASH.replace("slag = \"coal-slag\"", &format!("slag = \"coal-slag\"\n{text}"));
            Model::from_toml("m", &text).unwrap().initial_deposit(1, 0.5).unwrap()
        };
        assert_eq!(given(""), Deposit::default());
        let char = given("coverage = 0.4");
        assert_relative_eq!(char.cover, (1.0_f64 / 0.6).ln(), max_relative = 1e-15);
        assert_eq!(char.mass(), 0.0);
        let powder = given("layer_thickness = 2e-4");
        assert_relative_eq!(powder.layer_thickness(0.5), 2e-4);
        assert_relative_eq!(powder.powder, 0.23);
        assert_relative_eq!(powder.cover, 1.5);
        assert!(given("coverage = 1").cover.is_finite());
        assert!(model().initial_deposit(9, 0.5).is_err() && model().initial_deposit(0, 1.0).is_err());
    }

    /// Steel that is known up to 873 K, under ash whose surface has 1000 K: steel is met at its own 633 K.
    #[test]
    fn the_wall_is_met_at_its_own_temperature() {
        let text = ASH.replace("\"refractory\"\n[walls.slag]", "\"stainless-steel\"\n[walls.slag]");
        let model = Model::from_toml("m", &text).unwrap();
        let hot = Impact { particle_temperature: 1000.0, ..at(1000.0) };
        let under = Impact { temperature_under: 633.0, ..hot };
        assert!(model.check(0, &hot).is_err() && model.resolve(0, &hot, ImpactRng::default()).is_err());
        assert!(model.check(0, &under).is_ok() && model.resolve(0, &under, ImpactRng::default()).is_ok());
        let contact = |impact: &Impact| {
            let wall = &model.walls[0];
            wall.contact(&model.particle, impact, crate::model::WallPlace::Bare, None).unwrap()
        };
        let at_633 = contact(&Impact { wall_temperature: 633.0, ..hot });
        assert_eq!(contact(&under), at_633);
    }

    /// On a share of 0.39 the layer is thicker than its mean over the wall: e_n of 0.4 (1/4 + 3/4
    /// exp(-h/(c t))) by hand.
    #[test]
    fn powder_is_as_thick_as_it_lies() {
        let text = ASH
            .replace("refractory\"\n[walls.slag]", "refractory\"\npowder = \"fly-ash\"\n[walls.slag]")
            + "[[effects]]\nkind = \"powder-layer\"\nthickness = 1e-4\nresidual = 0.25\n";
        let model = Model::from_toml("m", &text).unwrap();
        let dry = Impact { conversion: 0.0, coverage: 0.39, layer_thickness: 5e-5, ..at(900.0) };
        let covered = model.resolve_place_with(0, &dry, |_| 0.999).unwrap();
        let expected = 0.4 * (0.25 + 0.75 * (-0.5_f64 / 0.39).exp());
        assert_relative_eq!(covered.normal_restitution, expected, max_relative = 1e-12);
    }

    /// What lies still has no energy: salt of 1e23 Pa s is solid, at rest and under fast impacts, and so
    /// is what lands on it. By the flow point of 1e4 Pa s, B/ln(1e4/A) with the constants below.
    #[test]
    fn no_speed_melts_a_deposit() {
        let text = ASH
            .replace("model = \"viscosity\"", "model = \"kinetic-energy\"")
            .replace("reference_viscosity = 25\n", "")
            .replace("\"fly-ash\"", "\"salt\"")
            + "[materials.salt]\ndensity = 2000\nyoungs_modulus = 2e10\npoisson_ratio = 0.2\n\
               yield_strength = 1e8\nsurface_energy = 0.1\n\
               viscosity = { arrhenius = [1e-10, 40000], valid = [300, 3000] }\n";
        let model = Model::from_toml("m", &text).unwrap();
        let melts_at = 40000.0 / 1e14_f64.ln();
        assert_relative_eq!(model.liquid_from.unwrap(), melts_at, max_relative = 1e-9);
        for (wall_temperature, molten) in [(530.0, false), (0.99 * melts_at, false), (1.01 * melts_at, true)]
        {
            for normal_speed in [0.0, 5.0, 100.0] {
                let impact = Impact { normal_speed, ..at(wall_temperature) };
                let sum = model.add_captured(0, &impact, 1.0, 2000.0, DepositSource::default()).unwrap();
                assert_eq!(sum.molten > 0.0, molten, "{wall_temperature} K at {normal_speed} m/s");
            }
        }
    }

    /// Frozen slag that covers the wall is what an impact meets; where it is liquid, the wall under it.
    #[test]
    fn frozen_slag_is_a_partner_of_its_own() {
        let text = ASH.replace("slag = \"coal-slag\"\n", "");
        let model = Model::from_toml("m", &text).unwrap();
        let limit = model.liquid_from.unwrap();
        let met = |melt_thickness, wall_temperature| {
            let impact = Impact { melt_thickness, ..at(wall_temperature) };
            model.frozen_slag(&model.walls[0], &impact).map(Material::name)
        };
        assert_eq!(met(1e-3, limit - 1.0), Some("fly-ash"));
        assert_eq!([met(1e-3, limit + 1.0), met(1e-7, limit - 1.0), met(0.0, limit - 1.0)], [None; 3]);
    }

    #[test]
    fn what_lands_brings_its_heat() {
        let text = ASH.replace("\"fly-ash\"", "\"ash\"")
            + "[materials.ash]\ndensity = 2000\nyoungs_modulus = 2e10\npoisson_ratio = 0.2\n\
               yield_strength = 1e8\nsurface_energy = 0.1\nviscosity = 10\n\
               critical_viscosity_temperature = 1400\nheat_capacity = 1000\nheat_of_fusion = 2e5\n";
        let model = Model::from_toml("m", &text).unwrap();
        let brought = |particle_temperature, wall_temperature, capacity| {
            let impact = Impact { particle_temperature, ..at(wall_temperature) };
            model.heat_brought(&impact, capacity).unwrap()
        };
        assert_eq!(brought(1600.0, 1500.0, None), 1e5);
        assert_eq!(brought(1600.0, 1300.0, None), 3e5 + 2e5);
        assert_eq!(brought(1300.0, 1500.0, Some(1200.0)), -1200.0 * 200.0 - 2e5);
        assert_eq!(brought(1300.0, 1200.0, None), 1e5);
        assert_eq!(Model::from_toml("m", WAX).unwrap().heat_brought(&at(300.0), None), None);
    }

    #[test]
    fn nonsense_is_refused() {
        let model = model();
        let bad = Deposit { cover: f64::NAN, ..Deposit::default() };
        assert!(model.apply_deposit(0, &bad, 0.5, &at(1700.0)).is_err());
        assert!(model.apply_deposit(0, &Deposit::default(), 1.0, &at(1700.0)).is_err());
        assert!(model.apply_deposit(9, &Deposit::default(), 0.5, &at(1700.0)).is_err());
        let arrive =
            |mass, density| model.add_captured(0, &at(1700.0), mass, density, DepositSource::default());
        assert!(arrive(-1.0, 1000.0).is_err() && arrive(1.0, 0.0).is_err() && arrive(1.0, f64::NAN).is_err());
        assert!(arrive(0.0, 1000.0).is_ok());
    }
}
