//! The viscosity laws beside measured silicate melts.
//!
//! `tests/data/slag_viscosity_measured.csv` holds 1161 measured points from twelve sources, all in the ash window
//! (its header says which). Figures stated beforehand for this comparison are a root mean square error in log10 of
//! 0.17 (Kalmanovitch–Frank), 0.27 (Urbain) and 0.39 (Watt–Fereday). With every row used and the oxides grouped as
//! `nearwall::slag` documents, the table gives 0.183, 0.289 and 0.394. No treatment of iron gets to the first two:
//! the 44 rows that carry iron are too few (see `iron_is_not_what_sets_the_error`).
//!
//! `cargo test --test library slag_viscosity -- --nocapture` prints the comparison by source.

use crate::common::measured_slags::{Measured, OXIDES, measured};
use nearwall::slag::giordano_russell_dingwell::GIORDANO_RUSSELL_DINGWELL;
use nearwall::slag::urbain::{KALMANOVITCH_FRANK, URBAIN};
use nearwall::slag::watt_fereday::WATT_FEREDAY;
use nearwall::slag::{Composition, SlagViscosity, VISCOSITY_LAWS, ViscosityLaw};
use nearwall::{Impact, ImpactRng, Model};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Root mean square and mean of predicted minus measured log10 viscosity.
fn error<'a>(
    rows: impl IntoIterator<Item = &'a Measured>,
    law: &'static ViscosityLaw,
    composition: impl Fn(&Measured) -> Composition,
) -> (f64, f64) {
    let errors: Vec<f64> = rows
        .into_iter()
        .map(|row| {
            let slag = SlagViscosity::new(law, &composition(row)).unwrap();
            slag.at(row.temperature).log10() - row.log10_viscosity
        })
        .collect();
    let mean = |power: i32| errors.iter().map(|e| e.powi(power)).sum::<f64>() / errors.len() as f64;
    (mean(2).sqrt(), mean(1))
}

fn print_by_source(rows: &[Measured]) {
    let mut sources: Vec<&str> = rows.iter().map(|row| row.source).collect();
    sources.sort_unstable();
    sources.dedup();
    println!("{:40} {:>5}  rms and bias in log10: {:?}", "", "rows", VISCOSITY_LAWS.map(|law| law.name));
    // Molten silica and alumina alone have no viscosity after Giordano, Russell and Dingwell.
    let suits = |row: &&Measured| {
        VISCOSITY_LAWS.iter().all(|law| SlagViscosity::new(law, &row.composition()).is_ok())
    };
    for source in sources {
        let own: Vec<&Measured> = rows.iter().filter(|row| row.source == source).filter(suits).collect();
        let found = VISCOSITY_LAWS.map(|law| error(own.iter().copied(), law, Measured::composition));
        let columns = found.map(|(rms, bias)| format!("{rms:6.3} {bias:+6.3}")).join("   ");
        println!("{source:40} {:5}  {columns}", own.len());
    }
}

#[test]
fn the_table_is_read_whole() {
    let rows = measured();
    assert_eq!(rows.len(), 1161);
    assert!(rows.iter().all(|row| row.in_ash_window));
    for row in &rows {
        assert!((row.shares.iter().sum::<f64>() - 100.0).abs() < 0.01, "{}", row.source);
        assert!((30.0..=70.0).contains(&row.share("SiO2")));
        assert!((8.0..=40.0).contains(&row.share("Al2O3")));
    }
    assert_eq!(rows.iter().filter(|row| row.iron() > 0.0).count(), 44);
}

#[test]
fn laws_meet_the_measured_slags() {
    let rows = measured();
    print_by_source(&rows);
    // Law, what was stated beforehand, what this table gives, its bias.
    let expected = [
        (&KALMANOVITCH_FRANK, 0.17, 0.183, 0.043),
        (&URBAIN, 0.27, 0.289, 0.235),
        (&WATT_FEREDAY, 0.39, 0.394, -0.322),
    ];
    for (law, stated, own, own_bias) in expected {
        let (rms, bias) = error(&rows, law, Measured::composition);
        println!("{}: rms {rms:.4}, bias {bias:+.4}", law.name);
        assert!((rms - stated).abs() < 0.02, "{}: rms {rms} against {stated}", law.name);
        assert!((rms - own).abs() < 1e-3, "{}: rms {rms} against {own}", law.name);
        assert!((bias - own_bias).abs() < 1e-3, "{}: bias {bias} against {own_bias}", law.name);
    }
}

/// How many rows a law is stated for, and its error there. The table says little about
/// Watt–Fereday, which is for slags with iron and magnesia, and nothing about melts with alkali.
#[test]
fn errors_within_the_stated_ranges() {
    let rows = measured();
    let expected = [
        (&KALMANOVITCH_FRANK, 1161, 0.183),
        (&URBAIN, 1161, 0.289),
        (&WATT_FEREDAY, 0, 0.0),
        (&GIORDANO_RUSSELL_DINGWELL, 0, 0.0),
    ];
    for (law, count, rms) in expected {
        let stated = |row: &&Measured| {
            SlagViscosity::new(law, &row.composition()).is_ok_and(|slag| slag.holds_at(row.temperature))
        };
        let own: Vec<&Measured> = rows.iter().filter(stated).collect();
        let found = error(own.iter().copied(), law, Measured::composition);
        println!("{}: {} rows, rms and bias {found:.3?}", law.name, own.len());
        assert_eq!(own.len(), count);
        assert!(own.is_empty() || (found.0 - rms).abs() < 1e-3);
    }
}

/// The 90 % band of each law holds some 90 % of the measured melts for which it is stated, and of every reference more
/// than half.
#[test]
fn nine_of_ten_measured_slags_lie_in_the_band_of_their_law() {
    let rows = measured();
    for law in [&KALMANOVITCH_FRANK, &URBAIN] {
        let inside = |row: &Measured| {
            let slag = SlagViscosity::new(law, &row.composition()).unwrap();
            let factor = slag.band_at(row.temperature).unwrap();
            (slag.at(row.temperature).log10() - row.log10_viscosity).abs() <= factor.log10()
        };
        let share = rows.iter().filter(|row| inside(row)).count() as f64 / rows.len() as f64;
        println!("{}: {:.1} % within a factor of {:.2}", law.name, 100.0 * share, law.band().unwrap());
        assert!((0.85..0.97).contains(&share), "{}: {share}", law.name);
    }
    assert_eq!(WATT_FEREDAY.band(), None);
    let cold = SlagViscosity::new(&KALMANOVITCH_FRANK, &rows[0].composition()).unwrap();
    assert_eq!(cold.band_at(1300.0), None);
}

/// By hand: `mu_ref/mu` is 0.5 at the temperature where the slag has 20 Pa s; the factor `10^(1.645·0.18)` of
/// Kalmanovitch and Frank moves it to 0.5/1.978 = 0.253 and 0.989.
#[test]
fn the_band_of_the_viscosity_is_a_band_of_the_stickiness() {
    let model = Model::from_toml(
        "m",
        "particle = { material = \"slag\" }\nwalls = { default = { material = \"stainless-steel\" } }\n\
         normal = { model = \"constant\", e_n = 0.5 }\ntangential = { model = \"constant\", e_t = 0.8 }\n\
         [capture]\nmodel = \"viscosity\"\nlaw = \"kalmanovitch-frank\"\nreference_viscosity = 10\n\
         [materials.slag]\nyield_strength = 1e8\nsurface_energy = 0.1\n\
         composition = { SiO2 = 50, Al2O3 = 25, CaO = 15, FeO = 10 }\n",
    )
    .unwrap();
    let slag = SlagViscosity::new(
        &KALMANOVITCH_FRANK,
        &Composition::new([("SiO2", 50.0), ("Al2O3", 25.0), ("CaO", 15.0), ("FeO", 10.0)]).unwrap(),
    )
    .unwrap();
    let [mut low, mut high] = [1523.0, 2456.0];
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if slag.at(middle) > 20.0 { low = middle } else { high = middle }
    }
    let impact = Impact { normal_speed: 1.0, particle_temperature: low, ..Impact::default() };
    let entries = model.explain_with(0, &impact, |_| 0.5).unwrap().1;
    let of = |quantity: &str| {
        entries.iter().find(|entry| entry.quantity == quantity).unwrap_or_else(|| panic!("{entries:?}")).value
    };
    assert!((of("particle stickiness") - 0.5).abs() < 1e-9);
    assert!((of("stickiness at 5 %") - 0.253).abs() < 1e-3);
    assert!((of("stickiness at 95 %") - 0.989).abs() < 1e-3);
    // What follows from the composition says its error; what is given has none.
    let said = model.estimates();
    let has = |start: &str, error: &str| {
        said.iter().any(|(_, text)| text.starts_with(start) && text.contains(error))
    };
    assert!(has("slag: viscosity from the composition by kalmanovitch-frank", "factor of 2.0"), "{said:?}");
    assert!(has("density of slag", "within 4 %") && has("youngs_modulus of slag", "12 %"), "{said:?}");
    assert!(has("poisson_ratio of slag", "0.06") && has("surface_tension of slag", "15 %"), "{said:?}");
    assert!(
        !said.iter().any(|(_, text)| text.contains("yield_strength") || text.contains("steel")),
        "{said:?}"
    );
}

/// The laws do worse where there is iron. Counted as all ferrous or all ferric, the whole table moves by at most
/// 0.012: it can neither settle how iron should count nor explain the distance to the stated figures.
#[test]
fn iron_is_not_what_sets_the_error() {
    let with_iron = |row: &Measured, ferrous_share: f64| {
        let ferrous = row.share("FeO") + 2.0 * 71.844 / 159.687 * row.share("Fe2O3");
        let ferric = ferrous * 159.687 / (2.0 * 71.844);
        let shares = OXIDES.into_iter().zip(row.shares).map(|(oxide, share)| match oxide {
            "FeO" => (oxide, ferrous_share * ferrous),
            "Fe2O3" => (oxide, (1.0 - ferrous_share) * ferric),
            _ => (oxide, share),
        });
        Composition::new(shares).unwrap()
    };
    let rows = measured();
    let ferrous = |rows: &[Measured], law, share| error(rows, law, |row| with_iron(row, share)).0;
    for law in [&KALMANOVITCH_FRANK, &URBAIN] {
        let as_given = error(&rows, law, Measured::composition).0;
        let without = error(rows.iter().filter(|row| row.iron() == 0.0), law, Measured::composition).0;
        let only = error(rows.iter().filter(|row| row.iron() > 0.0), law, Measured::composition).0;
        let (all_ferrous, all_ferric) = (ferrous(&rows, law, 1.0), ferrous(&rows, law, 0.0));
        println!(
            "{}: as given {as_given:.4}, all FeO {all_ferrous:.4}, all Fe2O3 {all_ferric:.4}, \
             rows without iron {without:.4}, rows with iron {only:.4}",
            law.name
        );
        assert!(as_given - 0.003 < all_ferrous && all_ferrous < as_given);
        assert!(as_given < all_ferric && all_ferric < as_given + 0.013);
        assert!(without < as_given && as_given < only);
    }
}

/// An impact carries the flag exactly where the law of its melt is not stated: random ashes at random temperatures.
#[test]
fn outside_the_range_of_a_law_an_impact_is_flagged() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut below = |high: f64| high * (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let [mut inside, mut outside] = [0, 0];
    for law in VISCOSITY_LAWS {
        for _ in 0..200 {
            let ceilings = [60.0, 2.0, 35.0, 10.0, 5.0, 0.2, 4.0, 5.0, 5.0, 25.0, 0.5];
            let drawn: Vec<f64> = ceilings.into_iter().map(|high| 0.1 + below(high)).collect();
            let sum: f64 = drawn.iter().sum();
            let shares: Vec<(&str, f64)> =
                OXIDES.into_iter().zip(drawn).map(|(oxide, share)| (oxide, 100.0 * share / sum)).collect();
            let Ok(slag) = SlagViscosity::new(law, &Composition::new(shares.clone()).unwrap()) else {
                continue;
            };
            let temperature = 1300.0 + below(900.0);
            let oxides: Vec<String> =
                shares.iter().map(|(oxide, share)| format!("{oxide} = {share}")).collect();
            let model = Model::from_toml("m.toml", &model_file(law.name, &oxides.join(", "))).unwrap();
            let impact = Impact {
                normal_speed: 2.0,
                diameter: 80e-6,
                particle_temperature: temperature,
                wall_temperature: 300.0,
                ..Impact::default()
            };
            let found = model.resolve(0, &impact, ImpactRng::default()).unwrap().outside_range;
            let stated = slag.holds_at(temperature);
            assert_eq!(found, !stated, "{} at {temperature} K: {oxides:?}", law.name);
            *if stated { &mut inside } else { &mut outside } += 1;
        }
    }
    assert!(inside > 50 && outside > 300, "{inside} inside, {outside} outside");
}

/// A model of ash with these oxides, with a law of viscosity.
fn model_file(law: &str, oxides: &str) -> String {
    format!(
        "[particle]\nmaterial = \"ash\"\n[walls.default]\nmaterial = \"pyrex\"\n\
         [normal]\nmodel = \"thornton-ning\"\nyield_ratio = 0.7\n[tangential]\nmodel = \"constant\"\ne_t = 0.76\n\
         [capture]\nmodel = \"viscosity\"\nlaw = \"{law}\"\nreference_viscosity = 25\n\
         [materials.ash]\ndensity = 2500\nyoungs_modulus = 7e10\npoisson_ratio = 0.2\nyield_strength = 1e9\n\
         surface_energy = 0.4\ncomposition = {{ {oxides} }}\n"
    )
}
