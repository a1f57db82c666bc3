//! Monotonic dependences that theory predicts.

use nearwall::effect::Term;
use nearwall::normal::{restitution, sticking_velocity};
use nearwall::{Impact, ImpactRng, Model};
use proptest::prelude::*;

use crate::cases::{
    FREE, THORNTON_NING, config, constant_normal, decades, e_n, impacts, resolve, table, wax,
};

/// Values from `low` to `high`, uniform in the logarithm.
fn ladder(low: f64, high: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| low * (high / low).powf(i as f64 / (count - 1) as f64)).collect()
}

/// The numbers never fall, but for rounding.
fn rise(numbers: &[f64]) -> Result<(), TestCaseError> {
    let falls = numbers.windows(2).position(|pair| pair[1] < pair[0] - 1e-12 * pair[0].abs());
    falls.map_or(Ok(()), |at| Err(TestCaseError::fail(format!("not one-way at {at}: {numbers:?}"))))
}

fn fall(numbers: &[f64]) -> Result<(), TestCaseError> {
    rise(&numbers.iter().map(|number| -number).collect::<Vec<_>>())
}

/// A function over a ladder of its input.
fn over(values: &[f64], of: impl Fn(f64) -> f64) -> Vec<f64> {
    values.iter().map(|value| of(*value)).collect()
}

fn with_work(work: f64) -> String {
    format!("{THORNTON_NING}\nwork_of_adhesion = {work:e}")
}

/// A melt whose viscosity is 1e4 Pa s at 1500 K and falls with temperature, on the particle and on a wall.
fn melt(reference: f64) -> Model {
    let solid = "density = 2500\nyoungs_modulus = 5e10\npoisson_ratio = 0.2\nyield_strength = 1e8\nsurface_energy = 0.3\n\
                 viscosity = { arrhenius = [2.061e-5, 3e4], valid = [1, 1e5] }\n";
    let text = format!(
        "[particle]\nmaterial = \"ash\"\n[walls.default]\nmaterial = \"pyrex\"\nslag = \"ash\"\n\
         [normal]\n{THORNTON_NING}\n[tangential]\n{FREE}\n\
         [capture]\nmodel = \"viscosity\"\nlaw = \"urbain\"\nreference_viscosity = {reference:e}\n[materials.ash]\n{solid}"
    );
    Model::from_toml("melt", &text).unwrap()
}

proptest! {
    #![proptest_config(config(100))]

    /// Without adhesion `e_n` is 1 up to `v_y` and falls above. With it `e_n` first rises from
    /// `v_s`, then falls: one hill.
    #[test]
    fn restitution_over_speed_is_one_hill(yielding in decades(1e-5, 10.0), ratio in decades(1e-3, 1e3)) {
        let speeds = ladder(0.5 * yielding, 1e6 * yielding, 300);
        fall(&over(&speeds, |v| restitution(v, 0.0, yielding)))?;
        let adhesive = ratio * yielding;
        let speeds = ladder(sticking_velocity(adhesive, yielding), 1e6 * adhesive.max(yielding), 300);
        let e_n = over(&speeds, |v| restitution(v, adhesive, yielding));
        let top = (0..e_n.len()).max_by(|a, b| e_n[*a].total_cmp(&e_n[*b])).unwrap();
        rise(&e_n[..=top])?;
        fall(&e_n[top..])?;
        // The faster it comes, the faster it goes.
        rise(&speeds.iter().zip(&e_n).map(|(v, e)| v * e).collect::<Vec<_>>())?;
    }

    #[test]
    fn sticking_velocity_rises_with_adhesion_and_falls_with_size(
        work in decades(1e-4, 10.0),
        diameter in decades(1e-7, 1e-2),
        strength in decades(0.1, 10.0),
    ) {
        let sticking = |work: f64, diameter: f64| {
            let model = wax(&with_work(work), FREE, &table("yield-ratio", &[strength]));
            model.speeds(0, &Impact { diameter, ..Impact::default() }).unwrap().sticking
        };
        rise(&over(&ladder(work, 30.0 * work, 8), |work| sticking(work, diameter)))?;
        fall(&over(&ladder(diameter, 30.0 * diameter, 8), |d| sticking(work, d)))?;
    }

    /// Of the laws by name that have one: small particles stick up to higher speeds, and hot ones
    /// where the law knows heat.
    #[test]
    fn sticking_velocities_of_listed_laws(diameter in decades(1e-6, 1e-3), temperature in 600.0..1400.0) {
        let sticking = |law: &str, diameter: f64, temperature: f64| {
            let impact = Impact {
                diameter,
                particle_temperature: temperature,
                wall_temperature: temperature,
                ..Impact::default()
            };
            wax(law, FREE, "").speeds(0, &impact).unwrap().sticking
        };
        let vane = "model = \"el-batsh\"\ne_n = 0.8";
        let bons = "model = \"bons\"\nwork_of_adhesion = 1e-3";
        let spheres = "model = \"brach-dunn\"\nloss_speed = 200\nloss_exponent = 0.7";
        for law in [vane, bons, spheres] {
            fall(&over(&ladder(diameter, 30.0 * diameter, 8), |d| sticking(law, d, temperature)))?;
        }
        rise(&over(&ladder(temperature, 1.5 * temperature, 8), |t| sticking(vane, diameter, t)))?;
        let adhesive = |work: f64| format!("model = \"bons\"\nwork_of_adhesion = {work:e}");
        rise(&over(&ladder(1e-5, 1e-1, 8), |work| sticking(&adhesive(work), diameter, temperature)))?;
    }

    #[test]
    fn restitution_falls_with_adhesion_and_rises_with_strength_and_size(impact in impacts()) {
        fall(&over(&ladder(1e-5, 10.0, 10), |work| e_n(&wax(&with_work(work), FREE, ""), &impact)))?;
        let ratio = |ratio: f64| e_n(&wax(THORNTON_NING, FREE, &table("yield-ratio", &[ratio])), &impact);
        rise(&over(&ladder(0.1, 10.0, 10), ratio))?;
        let plain = wax(THORNTON_NING, FREE, "");
        rise(&over(&ladder(1e-7, 1e-2, 10), |d| e_n(&plain, &Impact { diameter: d, ..impact })))?;
    }

    /// At one speed, whatever the normal law makes of `v_n`.
    #[test]
    fn sliding_loses_more_the_steeper(friction in decades(1e-2, 3.0), speed in decades(1e-2, 1e2)) {
        let sliding = format!("model = \"sliding\"\nfriction = {friction:e}");
        for normal in [constant_normal(0.4), THORNTON_NING.to_owned()] {
            let model = wax(&normal, &sliding, "");
            let e_t = |degrees: f64| {
                let (sine, cosine) = degrees.to_radians().sin_cos();
                let impact = Impact { normal_speed: speed * sine, tangential_speed: speed * cosine, ..Impact::default() };
                resolve(&model, &impact).tangential_restitution
            };
            fall(&over(&ladder(0.5, 89.5, 40), e_t))?;
        }
    }

    #[test]
    fn capture_rises_as_particles_melt_and_burn_out(
        impact in impacts(),
        width in decades(1.0, 300.0),
        asymmetry in decades(0.2, 10.0),
    ) {
        let temperatures = ladder(250.0, 2500.0, 30);
        let model = wax(&constant_normal(0.5), FREE, &table("melting-transition", &[900.0, width, 1.0, asymmetry]));
        let at = |particle_temperature: f64| resolve(&model, &Impact { particle_temperature, ..impact });
        rise(&over(&temperatures, |t| at(t).sticking_probability))?;
        fall(&over(&temperatures, |t| at(t).normal_restitution))?;
        let melt = ladder(1e-9, 1e-2, 20);
        rise(&over(&melt, |melt_thickness| resolve(&model, &Impact { melt_thickness, ..impact }).sticking_probability))?;
        let effect = table("conversion-transition", &[0.8, width * 1e-3, 0.0, asymmetry]);
        let model = wax(&constant_normal(0.5), FREE, &effect);
        let at = |conversion: f64| resolve(&model, &Impact { conversion, ..impact }).sticking_probability;
        rise(&over(&ladder(0.01, 1.0, 30), at))?;
    }

    /// A hotter melt is thinner and sticks more, on the particle and on the wall; what covers the wall hides it.
    #[test]
    fn capture_rises_as_slag_thins(reference in decades(1.0, 1e6), impact in impacts()) {
        let model = melt(reference);
        let impact = Impact { normal_speed: 1e2, layer_thickness: 0.0, melt_thickness: 0.0, ..impact };
        let p = |impact: Impact| resolve(&model, &impact).sticking_probability;
        let temperatures = ladder(250.0, 2500.0, 20);
        rise(&over(&temperatures, |particle_temperature| p(Impact { particle_temperature, ..impact })))?;
        rise(&over(&temperatures, |wall_temperature| p(Impact { wall_temperature, ..impact })))?;
        fall(&over(&ladder(1e-3, 1.0, 10), |coverage| p(Impact { coverage, ..impact })))?;
        // Where it is liquid: frozen slag is a material of its own.
        let hot = Impact { wall_temperature: 2300.0, ..impact };
        rise(&over(&ladder(1e-9, 1e-2, 10), |melt_thickness| p(Impact { melt_thickness, ..hot })))?;
        let thickness = ladder(0.01 * impact.diameter, 10.0 * impact.diameter, 10);
        fall(&over(&thickness, |layer_thickness| p(Impact { layer_thickness, ..impact })))?;
        let references = over(&ladder(1.0, 1e7, 10), |r| resolve(&melt(r), &impact).sticking_probability);
        rise(&references)?;
    }

    /// What lies on the wall, heat, size and speed, each by its own effect.
    #[test]
    fn effects_go_the_way_they_say(impact in impacts(), e in 0.05..1.0) {
        let constant = constant_normal(e);
        let layer = wax(&constant, FREE, &table("powder-layer", &[1e-4, 0.3]));
        fall(&over(&ladder(1e-7, 1e-2, 20), |layer_thickness| e_n(&layer, &Impact { layer_thickness, ..impact })))?;
        let film = wax(&constant, FREE, &table("liquid-film", &[1e-2, 1e-7]));
        fall(&over(&ladder(1e-8, 1e-2, 20), |film_thickness| e_n(&film, &Impact { film_thickness, ..impact })))?;
        let wet = Impact { film_thickness: 1e-5, ..impact };
        let syrup = |viscosity: f64| e_n(&wax(&constant, FREE, &table("liquid-film", &[viscosity, 1e-7])), &wet);
        fall(&over(&ladder(1e-5, 10.0, 10), syrup))?;
        rise(&over(&ladder(1e-3, 1e3, 20), |normal_speed| e_n(&film, &Impact { normal_speed, ..wet })))?;
        let hot = wax(THORNTON_NING, FREE, &table("thermal-softening", &[400.0, 200.0]));
        fall(&over(&ladder(250.0, 2500.0, 20), |t| e_n(&hot, &Impact { particle_temperature: t, ..impact })))?;
        let lossy = wax(&constant, FREE, &table("viscoelastic-loss", &[10.0, 0.5]));
        fall(&over(&ladder(1e-3, 1e3, 20), |normal_speed| e_n(&lossy, &Impact { normal_speed, ..impact })))?;
        let lift = wax(&constant, FREE, &table("gas-lift", &[0.05]));
        rise(&over(&ladder(0.1, 100.0, 10), |gas_speed| e_n(&lift, &Impact { gas_speed, ..impact })))?;
        let oblique = wax(&constant, FREE, &table("oblique-angle", &[1.0, 0.5, 2.0]));
        fall(&over(&ladder(1e-3, 1e3, 20), |tangential_speed| e_n(&oblique, &Impact { tangential_speed, ..impact })))?;
        let small = wax(&with_work(0.0), FREE, &table("size-dependent-yield", &[1e-5, 0.5]));
        fall(&over(&ladder(1e-7, 1e-2, 20), |diameter| e_n(&small, &Impact { diameter, ..impact })))?;
    }

    /// Roughness that takes adhesion away lets more rebound.
    #[test]
    fn nano_roughness_only_helps_the_rebound(impact in impacts(), spread in 0.0..=1.0, key in any::<u64>()) {
        let plain = wax(THORNTON_NING, FREE, "");
        let rough = plain.with_terms(vec![Term::new(nearwall::effect::EFFECTS[6], &[spread])]);
        prop_assert_eq!(rough.terms()[0].kind().id, "nano-roughness");
        let rough = rough.resolve(0, &impact, ImpactRng::new(1, key)).unwrap().normal_restitution;
        prop_assert!(rough >= e_n(&plain, &impact) - 1e-15);
    }
}
