//! Listed laws: the documents name them, a model file can use each, and their range is marked.

use nearwall::law::{Origin, Parameter, Search};
use nearwall::{Impact, ImpactRng, Model, normal, tangential};

/// Every listed law: its table in the model file, name, parameters and origin.
fn laws() -> Vec<(&'static str, &'static str, &'static [Parameter], &'static Origin)> {
    let normal = normal::LISTED_LAWS.map(|law| ("normal", law.name, law.parameters, law.origin));
    let tangential = tangential::LISTED_LAWS.map(|law| ("tangential", law.name, law.parameters, law.origin));
    [normal.as_slice(), tangential.as_slice()].concat()
}

/// A value in the middle of what a fit searches.
fn typical(parameter: &Parameter) -> f64 {
    match parameter.search {
        Search::Linear(low, high) => 0.5 * (low + high),
        Search::Log(low, high) => (low * high).sqrt(),
        other => unreachable!("{other:?}"),
    }
}

fn lines(name: &str, parameters: &[Parameter], value: impl Fn(&Parameter) -> f64) -> String {
    let lines = parameters.iter().map(|p| format!("{} = {:e}\n", p.name, value(p)));
    format!("model = \"{name}\"\n{}", lines.collect::<String>())
}

/// A model with a law in one of the two tables.
fn model(table: &str, law: &str) -> Result<Model, nearwall::input::InputError> {
    let (normal, tangential) = match table {
        "normal" => (law, "model = \"constant\"\ne_t = 1\n"),
        _ => ("model = \"constant\"\ne_n = 0.5\n", law),
    };
    let text = format!(
        "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n\
         [normal]\n{normal}[tangential]\n{tangential}"
    );
    Model::from_toml("m", &text)
}

/// The rows of a document's section whose first column is a law's name.
fn rows(document: &str, heading: &str) -> Vec<String> {
    let path = format!("{}/docs/{document}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    let section = text.split("\n## ").find(|section| section.starts_with(heading)).unwrap();
    section.lines().filter(|line| line.starts_with("| `")).map(str::to_owned).collect()
}

#[test]
fn the_model_file_document_has_every_law_with_its_parameters_and_units() {
    let rows = rows("reference/model-file.md", "Laws by name");
    for (table, name, parameters, _) in laws() {
        let row = rows.iter().find(|row| row.starts_with(&format!("| `{name}` | `[{table}]` |")));
        let row = row.unwrap_or_else(|| panic!("docs/reference/model-file.md has no row for {table} {name}"));
        for parameter in parameters {
            let unit = parameter.unit.replace("m2", "m²");
            assert!(row.contains(&format!("`{}` [{unit}]", parameter.name)), "{row}");
        }
    }
    assert_eq!(rows.len(), laws().len());
}

#[test]
fn the_physics_document_has_every_law_with_its_source() {
    let rows = [rows("why/physics.md", "3. Normal"), rows("why/physics.md", "4. Tangential")].concat();
    for (_, name, _, origin) in laws() {
        let row = rows.iter().find(|row| row.starts_with(&format!("| `{name}` |")));
        let row = row.unwrap_or_else(|| panic!("docs/why/physics.md has no row for {name}"));
        let year = origin.source.split(|c: char| !c.is_ascii_digit()).find(|part| part.len() == 4).unwrap();
        assert!(row.contains(year), "{row}: {}", origin.source);
    }
}

#[test]
fn a_model_file_reaches_every_law_and_refuses_what_does_not_fit() {
    for (table, name, parameters, origin) in laws() {
        let read = model(table, &lines(name, parameters, typical)).unwrap();
        assert!(read.is_prepared(0), "{name}");
        let found = if table == "normal" { read.normal_law().name() } else { read.tangential_law().name() };
        assert_eq!(found, name);
        let described = read.describe().into_iter().find(|(heading, _)| *heading == table).unwrap().1;
        assert!(described.contains(name) && described.contains(origin.case), "{described}");
        for wrong in parameters {
            let (low, high) = wrong.bounds;
            for value in [low - (low.abs() + 1.0), high * 2.0 + 1.0] {
                let law = lines(name, parameters, |p| if p == wrong { value } else { typical(p) });
                let error = model(table, &law).unwrap_err().to_string();
                assert!(error.contains(wrong.name), "{error}");
            }
            let left_out = lines(name, parameters, typical).replace(&format!("\n{} = ", wrong.name), "\n# ");
            assert_eq!(model(table, &left_out).is_ok(), wrong.default.is_some(), "{name} {}", wrong.name);
        }
    }
}

/// At each end of each range, and just beyond it.
#[test]
fn outside_the_range_of_the_fit_the_outcome_is_marked() {
    let inside = Impact {
        normal_speed: 40.0,
        tangential_speed: 40.0,
        diameter: 50e-6,
        particle_temperature: 1300.0,
        wall_temperature: 1300.0,
        ..Impact::default()
    };
    for (table, name, parameters, origin) in laws() {
        let model = model(table, &lines(name, parameters, typical)).unwrap();
        for limit in origin.range {
            let [low, high] = limit.range;
            assert!(low < high, "{name} {}", limit.quantity);
        }
        // Materials whose properties are stated for room temperature only mark the impact themselves.
        let marked = |impact: &Impact| {
            let law = if table == "normal" {
                model.normal_law().holds_for(&normal::Contact::default(), impact)
            } else {
                model.tangential_law().holds_for(impact)
            };
            let outcome = model.resolve(0, impact, ImpactRng::default()).unwrap();
            assert!(law || outcome.outside_range, "{name}");
            !law
        };
        let slow = Impact { normal_speed: 1e-3, tangential_speed: 1e-3, ..inside };
        let large = Impact { diameter: 1.0, ..inside };
        let glancing = Impact { normal_speed: 1.0, tangential_speed: 80.0, ..inside };
        let cold = Impact { particle_temperature: 293.15, wall_temperature: 293.15, ..inside };
        let expected = |quantity: &str| origin.range.iter().any(|limit| limit.quantity == quantity);
        if expected("diameter") {
            assert!(marked(&large), "{name}");
        }
        if expected("angle from the surface") {
            assert!(marked(&glancing), "{name}");
        }
        if expected("mean temperature") {
            assert!(marked(&cold), "{name}");
        }
        if origin.range.iter().any(|limit| limit.quantity == "speed" && limit.range[0] > 0.0) {
            assert!(marked(&slow), "{name}");
        }
    }
}

/// The fits over the angle, as both laws of one model: nearly nothing is lost along a glancing
/// path, and most towards a wall hit head-on. Mistaking the angle for that from the normal would
/// turn this round.
#[test]
fn angles_are_counted_from_the_surface() {
    for name in ["grant-tabakoff", "tabakoff-wakeman"] {
        let text = format!(
            "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n\
             [normal]\nmodel = \"{name}\"\n[tangential]\nmodel = \"{name}\"\n"
        );
        let model = Model::from_toml("m", &text).unwrap();
        let at = |degrees: f64| {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let impact =
                Impact { normal_speed: 100.0 * sine, tangential_speed: 100.0 * cosine, ..Impact::default() };
            model.resolve(0, &impact, ImpactRng::default()).unwrap()
        };
        let (glancing, steep) = (at(2.0), at(88.0));
        assert!(glancing.normal_restitution > 0.9 && glancing.tangential_restitution > 0.9, "{glancing:?}");
        assert!(steep.normal_restitution < 0.35, "{steep:?}");
        assert!(!glancing.stuck && !steep.stuck);
    }
}

/// Measured critical velocities of fly ash on steel (Energies 6 (2013) 3245 and 4288; 14 (2021)
/// 5231): diameter [m], velocity [m/s].
const ASH: [[f64; 2]; 6] =
    [[88e-6, 1.92], [96e-6, 1.25], [104e-6, 0.69], [85e-6, 0.19], [65e-6, 0.42], [23e-6, 1.06]];

/// What the documents say of `brach-dunn` and ash.
#[test]
fn brach_and_dunn_do_not_describe_ash() {
    let text = "[particle]\nmaterial = \"fly-ash\"\n[walls.default]\nmaterial = \"stainless-steel\"\n\
                [normal]\nmodel = \"brach-dunn\"\nloss_speed = 200\nloss_exponent = 0.7\n\
                [tangential]\nmodel = \"constant\"\ne_t = 1\n";
    let model = Model::from_toml("m", text).unwrap();
    for [diameter, measured] in ASH {
        let law = model.speeds(0, &Impact { diameter, ..Impact::default() }).unwrap().sticking;
        println!("{:.0} µm: {law:.4} m/s, measured {measured}", 1e6 * diameter);
        assert!((80.0..3000.0).contains(&(measured / law)), "{diameter}: {law}");
    }
}
