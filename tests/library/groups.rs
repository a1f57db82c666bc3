//! Dimensionless groups and closed forms in model files, against numbers by hand.

use nearwall::effect::{CurveInput, CurveTarget, FORMS, FittedForm, FormInfo, Operation, Term};
use nearwall::group::{GROUPS, GroupInfo, ProductGroup, ProductInput};
use nearwall::impact::{ExtraInput, INPUTS};
use nearwall::model::block::{Block, Outcomes, Workspace};
use nearwall::tangential::critical_angle;
use nearwall::{Impact, ImpactRng, Model, Outcome};

use crate::fitted_curves::{PLAIN, fault, model};

const WEBER: &str = "[[effects]]\nkind = \"fitted-curve\"\ninput = \"We\"\non = \"e_n\"\n\
                     knots = [50, 150]\nvalues = [0, 0.2]\n";

fn read(text: &str) -> Model {
    Model::from_toml("m.toml", text).unwrap()
}

/// Molten wax of 120 µm at 5 m/s and 120 °C.
fn wax() -> Impact {
    Impact { normal_speed: 5.0, diameter: 120e-6, particle_temperature: 393.15, ..Impact::default() }
}

fn resolve(model: &Model, impact: &Impact) -> Outcome {
    model.resolve(0, impact, ImpactRng::default()).unwrap()
}

fn group(model: &Model, impact: &Impact, name: &str) -> f64 {
    let input = CurveInput::named(name, &model.declared()).unwrap();
    model.group_value(0, impact, input).unwrap()
}

fn near(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance * expected.abs(), "{value} against {expected}");
}

fn close(value: f64, expected: f64) {
    assert!((value - expected).abs() < 1e-12, "{value} against {expected}");
}

/// By hand from Troiano 3.1: 1000 kg/m³, 0.03 N/m, and between 0.1 Pa s at 90 °C and 0.02 at 130 °C, linear in 1/T,
/// 0.0290 Pa s at 120 °C.
#[test]
fn groups_of_molten_wax() {
    let model = model("");
    for (name, expected) in [
        ("We", 100.0),
        ("Re", 20.688),
        ("Oh", 0.48338),
        ("Ca", 4.8338),
        ("Bo", 4.7072e-3),
        ("K", 21.327),
        ("T_p/T_melt", 1.11327),
    ] {
        near(group(&model, &wax(), name), expected, 2e-5);
    }
}

/// By hand: 9330 kg/m³, 2.29 N/m and 0.27e-3 exp(8780/2896.1) = 5.5976 mPa s just above the melting point.
#[test]
fn groups_of_molten_molybdenum() {
    let model = read(&PLAIN.replace("montan-wax", "molybdenum"));
    let drop = Impact { diameter: 14e-6, particle_temperature: 2896.1, ..wax() };
    for (name, expected) in
        [("We", 1.42598), ("Re", 116.676), ("Oh", 0.0102347), ("Ca", 0.0122217), ("Bo", 7.8311e-6)]
    {
        near(group(&model, &drop, name), expected, 3e-5);
    }
    let solid = Impact { particle_temperature: 2800.0, ..drop };
    for name in ["We", "Oh", "Re", "Ca", "Bo", "K"] {
        assert!(group(&model, &solid, name).is_nan(), "{name} of a solid");
    }
    near(group(&model, &solid, "T_p/T_melt"), 2800.0 / 2896.0, 1e-12);
}

/// Water of 1 mm at 1 m/s, 998 kg/m³, 1 mPa s, 0.072 N/m, all stated with the impact on a model of glass beads.
#[test]
fn what_an_impact_states_goes_before_the_material() {
    let text = PLAIN.replace("montan-wax", "pyrex")
        + "[inputs.mu_p]\ndefault = 5e-3\n[inputs.sigma_p]\ndefault = 0.05\n[inputs.mu_gas]\ndefault = 1.8e-5\n";
    let model = read(&text);
    let mut water =
        Impact { normal_speed: 1.0, diameter: 1e-3, particle_density: 998.0, ..Impact::default() };
    near(group(&model, &water, "We"), 19.96, 1e-12);
    water.extra[..2].copy_from_slice(&[1e-3, 0.072]);
    for (name, expected) in [
        ("We", 13.86111),
        ("Re", 998.0),
        ("Oh", 3.730512e-3),
        ("Ca", 0.01388889),
        ("Bo", 0.1359311),
        ("K", 20.92578),
        ("St_gas", 998e-3 / (9.0 * 1.8e-5)),
    ] {
        near(group(&model, &water, name), expected, 1e-6);
    }
    // What is not positive has no meaning.
    water.extra[1] = 0.0;
    assert!(group(&model, &water, "We").is_nan() && group(&model, &water, "Re") == 998.0);
}

/// Steel of 1 mm on steel at 0.1 m/s by the equations of Thornton and Ning: E* = 104.396 GPa, p_y = 2.8 · 207 MPa,
/// v_y = 1.56 sqrt(p_y⁵/(E*⁴ 7900)) = 0.013025 m/s, v_s = v_adh = 1.84 ((1.6/R)⁵/(7900³ E*²))^(1/6) = 3.665 mm/s.
#[test]
fn speeds_of_the_contact_law() {
    let law = "\"thornton-ning\"\nyield_ratio = 2.8";
    let text = PLAIN.replace("montan-wax", "stainless-steel").replace("pyrex", "stainless-steel");
    let model = read(&text.replace("\"constant\"\ne_n = 0.5", law));
    let bead = Impact { normal_speed: 0.1, diameter: 1e-3, ..Impact::default() };
    near(group(&model, &bead, "v_n/v_s"), 27.285, 2e-3);
    near(group(&model, &bead, "v_n/v_y"), 7.6777, 2e-3);
    let speeds = model.speeds(0, &bead).unwrap();
    assert_eq!(group(&model, &bead, "v_n/v_s"), 0.1 / speeds.sticking);
}

/// A rigid sphere slides throughout where 2 v_t/((1 + e_n) f v_n) is at least 7 (Coulomb and the angular momentum).
#[test]
fn the_effective_angle_is_that_of_the_rebound_before_corrections() {
    let oblique = Impact { normal_speed: 2.0, tangential_speed: 3.0, ..wax() };
    close(group(&model(""), &oblique, "tan_alpha"), 2.0);
    close(group(&model(WEBER), &oblique, "tan_alpha"), 2.0);
    let sliding = PLAIN.replace("\"constant\"\ne_t = 0.8", "\"sliding-rolling\"\nfriction = 0.25");
    close(group(&read(&sliding), &oblique, "tan_alpha"), 8.0);
    let (sine, cosine) = critical_angle(0.25, 0.5, 1e12).sin_cos();
    let limit = Impact { normal_speed: sine, tangential_speed: cosine, ..wax() };
    near(group(&read(&sliding), &limit, "tan_alpha"), 7.0, 1e-9);
    // An effect that replaces the tangential law brings its own friction.
    let effect = "[[effects]]\nkind = \"sliding-to-rolling\"\nfriction = 0.5\n";
    close(group(&read(&format!("{sliding}{effect}")), &oblique, "tan_alpha"), 4.0);
    assert!(group(&model(""), &Impact { normal_speed: 0.0, ..oblique }, "tan_alpha").is_nan());
}

#[test]
fn groups_of_layers_films_and_reference_viscosity() {
    let wall = PLAIN.replace("\"pyrex\"", "\"pyrex\"\nlayer_thickness = 12e-6\nfilm_thickness = 6e-6");
    near(group(&read(&wall), &wax(), "layer/d"), 0.1, 1e-12);
    near(group(&read(&wall), &wax(), "film/d"), 0.05, 1e-12);
    let capture = "[capture]\nmodel = \"viscosity\"\nlaw = \"urbain\"\nreference_viscosity = 0.05\n";
    near(group(&model(capture), &wax(), "mu/mu_ref"), 0.580054, 1e-5);
    // St = rho d v_n/(9 mu) = 0.6/(9 mu): a film of 1 mPa s, one that is stated, and slag of wax at 120 °C.
    let film = "[[effects]]\nkind = \"liquid-film\"\nviscosity = 1e-3\nasperity = 1e-6\n";
    near(group(&model(film), &wax(), "St_film"), 66.66667, 1e-6);
    let stated = model(&format!("{film}[inputs.mu_film]\ndefault = 2e-3\n"));
    near(group(&stated, &wax(), "St_film"), 33.33333, 1e-6);
    let slag = read(&(PLAIN.replace("\"pyrex\"", "\"pyrex\"\nslag = \"montan-wax\"") + capture));
    let hot = Impact { wall_temperature: 393.15, ..wax() };
    near(group(&slag, &hot, "St_film"), 2.29864, 1e-5);
    assert!(group(&slag, &wax(), "St_film").is_nan(), "frozen slag");
}

/// Kalmanovitch and Frank say 15.12 Pa s for this ash at 1700 K (as the example of `slag`).
#[test]
fn an_ash_has_the_viscosity_of_the_capture_law() {
    let text = PLAIN.replace("\"montan-wax\"", "\"ash\"")
        + "[capture]\nmodel = \"viscosity\"\nlaw = \"kalmanovitch-frank\"\nreference_viscosity = 100\n\
           [materials.ash]\nlike = \"fly-ash\"\ndensity = 2500\nsurface_tension = 0.4\n\
           composition = { SiO2 = 50, Al2O3 = 25, CaO = 15, FeO = 10 }\n";
    let ash =
        Impact { normal_speed: 3.0, diameter: 50e-6, particle_temperature: 1700.0, ..Impact::default() };
    let model = read(&text);
    near(group(&model, &ash, "mu/mu_ref"), 0.1512, 1e-3);
    near(group(&model, &ash, "Re"), 0.375 / 15.12, 1e-3);
}

#[test]
fn a_model_knows_which_groups_it_can_compute() {
    let names = |model: &Model, stated: &[&str]| -> Vec<&str> {
        model.groups_known(stated).into_iter().map(|place| GROUPS[place].name).collect()
    };
    let always = ["tan_alpha", "layer/d", "film/d"];
    let glass = read(&PLAIN.replace("montan-wax", "pyrex"));
    assert_eq!(names(&glass, &[]), always);
    assert_eq!(names(&glass, &["sigma_p"]), [&["We", "Bo"], &always[..]].concat());
    let liquid = ["We", "Oh", "Re", "Ca", "Bo", "K"];
    assert_eq!(names(&glass, &["sigma_p", "mu_p"]), [&liquid[..], &always].concat());
    assert_eq!(
        names(&model(""), &["mu_gas"]),
        [&liquid[..], &["tan_alpha", "T_p/T_melt", "layer/d", "film/d", "St_gas"]].concat()
    );
    let law = PLAIN.replace("\"constant\"\ne_n = 0.5", "\"thornton-ning\"\nyield_ratio = 0.7");
    assert!(["v_n/v_s", "v_n/v_y"].iter().all(|name| names(&read(&law), &[]).contains(name)));
    let droplet = model("[capture]\nmodel = \"droplet\"\n");
    assert!(names(&droplet, &[]).contains(&"St_film") && !names(&droplet, &[]).contains(&"mu/mu_ref"));
}

/// At We = 100 the curve is half way up: 0.5 + 0.1.
#[test]
fn a_curve_runs_over_a_group() {
    let model = model(WEBER);
    close(resolve(&model, &wax()).normal_restitution, 0.6);
    // sqrt(0.75) of the speed: We = 75.
    let slower = Impact { normal_speed: 5.0 * 0.75_f64.sqrt(), ..wax() };
    close(resolve(&model, &slower).normal_restitution, 0.55);
    let solid = Impact { particle_temperature: 300.0, ..wax() };
    assert_eq!(resolve(&model, &solid).normal_restitution, 0.5);
    let surface = "[[effects]]\nkind = \"fitted-curve\"\ninput = [\"We\", \"T_p/T_melt\"]\non = \"e_t\"\n\
                   knots = [[0, 200], [1, 2]]\nvalues = [[0, 0], [-0.4, -0.4]]\n";
    close(resolve(&self::model(surface), &wax()).tangential_restitution, 0.6);
    let (_, trace) = model.explain(0, &wax(), ImpactRng::default()).unwrap();
    let [.., shown, last] = &trace[..] else { panic!("no trace") };
    assert_eq!((shown.term, shown.quantity, last.quantity), ("fitted-curve", "We", "e_n"));
    near(shown.value, 100.0, 1e-12);
    let lines = model.describe();
    let line =
        ("group", "We = rho_p v_n^2 d/sigma_p, Weber number: kinetic energy over surface energy".to_owned());
    assert!(lines.contains(&line), "{lines:#?}");
}

#[test]
fn batches_give_the_bits_of_single_impacts() {
    let model = model(&format!("{WEBER}{}", form("capture", "logistic", "x_0 = 60\nn = 3")));
    let mut block = Block { length: 7, ..Block::default() };
    let impact = |index: usize| Impact { normal_speed: 1.0 + index as f64, ..wax() };
    for index in 0..block.length {
        for (input, values) in INPUTS.iter().zip(&mut block.inputs) {
            values[index] = (input.value)(&impact(index));
        }
    }
    let mut outcomes = Outcomes::default();
    model.resolve_block(0, &block, 1, &mut outcomes, &mut Workspace::default()).unwrap();
    for index in 0..block.length {
        let one = resolve(&model, &impact(index));
        assert_eq!(one.normal_restitution.to_bits(), outcomes.normal_restitution[index].to_bits());
        assert_eq!(one.sticking_probability.to_bits(), outcomes.sticking_probability[index].to_bits());
    }
}

#[test]
fn products_of_powers_are_groups() {
    let text = "[inputs.sigma_l]\ndefault = 0.03\n[inputs.lot]\nlabels = [\"A\"]\n\
                [groups]\npi_1 = { rho_p = 1, v_n = 2, d = 1, sigma_l = -1 }\n\
                \"v_n/v_t\" = { v_n = 0.5, v_t = -0.5 }\n";
    let curve = WEBER.replace("We", "pi_1");
    let model = model(&format!("{text}{curve}"));
    // rho_p is that of the wax where the impact states none.
    near(group(&model, &wax(), "pi_1"), 100.0, 1e-12);
    close(resolve(&model, &wax()).normal_restitution, 0.6);
    let mut other = Impact { particle_density: 500.0, ..wax() };
    other.extra[0] = 0.06;
    near(group(&model, &other, "pi_1"), 25.0, 1e-12);
    close(group(&model, &Impact { tangential_speed: 20.0, ..wax() }, "v_n/v_t"), 0.5);
    assert!(group(&model, &wax(), "v_n/v_t").is_nan(), "divided by 0");
    let lines: Vec<String> =
        model.describe().into_iter().map(|(what, text)| format!("{what} {text}")).collect();
    assert!(lines.contains(&"group pi_1 = rho_p v_n^2 d sigma_l^-1".to_owned()), "{lines:#?}");
    let input =
        |name: &str| INPUTS.iter().position(|input| input.name == name).map(ProductInput::Input).unwrap();
    let factors =
        vec![(input("rho_p"), 1.0), (input("v_n"), 2.0), (input("d"), 1.0), (ProductInput::Extra(0), -1.0)];
    assert_eq!(model.products()[0], ProductGroup { name: "pi_1".to_owned(), factors });
    let built = self::model("")
        .with_extra_inputs(vec![ExtraInput::number("sigma_l", 0.03)])
        .with_products(model.products().to_vec())
        .with_terms(model.terms().to_vec());
    assert_eq!(resolve(&built, &wax()), resolve(&model, &wax()));
}

/// A measured column may have the name of a group: then it is the column.
#[test]
fn a_declared_input_goes_before_a_group_of_its_name() {
    let model = model(&format!("{WEBER}valid = {{ We = [0, 90] }}\n[inputs.We]\ndefault = 50\n"));
    let mut impact = wax();
    assert_eq!(resolve(&model, &impact).normal_restitution, 0.5);
    impact.extra[0] = 100.0;
    close(resolve(&model, &impact).normal_restitution, 0.6);
    assert_eq!(model.beyond(0, &impact).unwrap().iter().filter(|one| !one.is_held()).count(), 1);
}

#[test]
fn a_range_may_name_a_group() {
    let text = "[groups]\ninverse = { v_n = -1 }\n[[effects]]\nkind = \"level-shift\"\non = \"e_t\"\nvalue = 0.1\n\
                valid = { We = [0.1, 30], inverse = [0.3, 10] }\n";
    let law = "[[effects]]\nkind = \"yield-ratio\"\nratio = 0.7\nvalid = { We = [0.1, 30] }\n";
    let said = |text: &str, impact: &Impact| -> (bool, Vec<String>) {
        let model = model(text);
        let beyond = model.beyond(0, impact).unwrap();
        let texts = beyond.iter().filter(|one| !one.is_held()).map(ToString::to_string).collect();
        (resolve(&model, impact).outside_range, texts)
    };
    let at = |normal_speed: f64| Impact { normal_speed, ..wax() };
    let cold = |normal_speed: f64| Impact { particle_temperature: 300.0, ..at(normal_speed) };
    // The wax is stated as a solid, as a liquid it is held: the flag is for both, the texts for the range.
    let over = "level-shift is stated for We 0.1 to 30, here 100".to_owned();
    let slow = "level-shift is stated for inverse 0.3 to 10, here 0.2".to_owned();
    assert_eq!(said(text, &at(5.0)), (true, vec![slow, over]));
    assert_eq!(said(text, &at(1.0)).1, Vec::<String>::new());
    assert_eq!(said(law, &at(5.0)).1, ["yield-ratio is stated for We 0.1 to 30, here 100"]);
    assert_eq!(
        said(text, &cold(1.0)),
        (true, vec!["level-shift is stated for We 0.1 to 30, here no value".to_owned()])
    );
    let inverse = text.replace("We = [0.1, 30], ", "");
    assert_eq!(said(&inverse, &cold(1.0)), (false, Vec::new()));
    assert!(said(&inverse, &cold(5.0)).0);
    // On a wall with covered and bare share the reason is given once.
    let covered =
        read(&(PLAIN.replace("\"pyrex\"", "\"pyrex\"\npowder = \"montan-wax\"\ncoverage = 0.4") + text));
    let beyond = covered.beyond(0, &cold(1.0)).unwrap();
    assert_eq!(beyond.iter().filter(|one| !one.is_held()).count(), 1, "{beyond:?}");
}

fn form(on: &str, form: &str, rest: &str) -> String {
    format!("[[effects]]\nkind = \"fitted-form\"\ninput = \"We\"\non = \"{on}\"\nform = \"{form}\"\n{rest}\n")
}

/// By hand at We = 100: 2/sqrt(100) = 0.2; 1/(1 + (100/50)^-2) = 0.8; 0.1 + 0.6 e^-1 = 0.320728; 0.9 · 100/150 = 0.6.
#[test]
fn forms_set_add_and_multiply() {
    let e_n = |text: &str| resolve(&model(text), &wax()).normal_restitution;
    let power = "a = 2\nb = -0.5";
    close(e_n(&form("e_n", "power", power)), 0.2);
    close(e_n(&form("e_n", "power", &format!("{power}\nacts = \"add\""))), 0.7);
    close(e_n(&form("e_n", "power", &format!("{power}\nacts = \"factor\""))), 0.6);
    close(e_n(&form("e_n", "power", &format!("{power}\nacts = \"times\""))), 0.1);
    close(e_n(&form("e_n", "exponential", "a = 0.6\nx_0 = 100\nfloor = 0.1")), 0.320727664702865);
    close(e_n(&form("e_n", "saturating", "a = 0.9\nx_0 = 50")), 0.6);
    close(e_n(&form("e_n", "line", "a = 0.9\nb = -0.002")), 0.7);
    close(e_n(&form("e_n", "constant", "a = 0.3")), 0.3);
    assert_eq!(e_n(&form("e_n", "constant", "a = -0.3")), 0.0);
    let e_t = resolve(&model(&form("e_t", "power", power)), &wax());
    close(e_t.tangential_restitution, 0.2);
    // In the order of the file: what is set forgets what came before.
    let [set, add] = [form("e_n", "constant", "a = 0.3"), form("e_n", "constant", "a = 0.1\nacts = \"add\"")];
    close(e_n(&format!("{add}{set}")), 0.3);
    close(e_n(&format!("{set}{add}")), 0.4);
}

#[test]
fn a_threshold_of_capture_replaces_what_the_laws_say() {
    let p = |text: &str, impact: &Impact| resolve(&model(text), impact).sticking_probability;
    let rising = form("capture", "logistic", "x_0 = 50\nn = 2");
    let falling = form("capture", "logistic", "x_0 = 50\nn = -2");
    close(p(&rising, &wax()), 0.8);
    close(p(&falling, &wax()), 0.2);
    let step = form("capture", "logistic", "x_0 = 99\nn = 5000");
    assert!(p(&step, &wax()) > 1.0 - 1e-12);
    assert!(p(&step, &Impact { normal_speed: 4.9, ..wax() }) < 1e-12);
    assert_eq!(p(&form("capture", "constant", "a = 1.7"), &wax()), 1.0);
    // logit 0.2 + 1.5 with the margins of the page: b = 0.203, odds 0.25470515 e^1.5 = 1.1415, (0.53303 - 0.005)/0.99.
    let shift = "[[effects]]\nkind = \"level-shift\"\non = \"capture\"\nvalue = 1.5\n";
    assert!((p(&format!("{falling}{shift}"), &wax()) - 0.533368).abs() < 1e-5);
    close(p(&format!("{shift}{falling}"), &wax()), 0.2);
    // A particle that the law holds is released, and a solid is left alone.
    let adhesive = PLAIN.replace("\"constant\"\ne_n = 0.5", "\"thornton-ning\"\nyield_ratio = 0.7");
    let held = |text: &str, impact: &Impact| {
        resolve(&read(&format!("{adhesive}{text}")), impact).sticking_probability
    };
    let slow = Impact { normal_speed: 1e-3, ..wax() };
    assert_eq!((held("", &slow), held(&form("capture", "constant", "a = 0.25"), &slow)), (1.0, 0.25));
    assert_eq!(p(&rising, &Impact { particle_temperature: 300.0, ..wax() }), 0.0);
}

#[test]
fn a_form_built_in_code_is_that_of_a_file() {
    let text = form(
        "e_n",
        "power",
        "acts = \"factor\"\na = { value = 0.5, low = 0.4, high = 0.6, unit = \"1\" }\n\
                     b = { value = -0.25, low = -0.3, high = -0.2 }\nvalid = { We = [1, 200] }\nsource = \"a fit\"",
    );
    let from_file = model(&text);
    let (on, acts) = (CurveTarget::NormalRestitution, Operation::Factor);
    let (form, parameters) = (FormInfo::from_name("power").unwrap(), vec![0.5, -0.25]);
    let input = CurveInput::Group(GroupInfo::place("We").unwrap());
    let term = Term::fitted_form(FittedForm { on, acts, form, input, parameters });
    let built = model("").with_terms(vec![term]);
    for normal_speed in [0.5, 5.0, 7.0] {
        let impact = Impact { normal_speed, ..wax() };
        let [one, two] = [&from_file, &built].map(|model| resolve(model, &impact));
        assert_eq!(one.normal_restitution.to_bits(), two.normal_restitution.to_bits());
        let expected = 0.5 * (1.0 + form.value(&[0.5, -0.25], group(&built, &impact, "We")));
        close(one.normal_restitution, expected);
    }
    let lines = built.describe();
    let line = "fitted-form: e_n (1 + f), f = a x^b, a = 0.5, b = -0.25, x = We".to_owned();
    assert!(lines.contains(&("effect", line)), "{lines:#?}");
    assert_eq!(from_file.terms()[0].valid_groups(), [(input, [1.0, 200.0])]);
    assert_eq!(from_file.terms()[0].corrected_by(), [input]);
}

#[test]
fn errors_name_the_key_and_the_remedy() {
    let part = |message: String, parts: &[&str]| {
        assert!(parts.iter().all(|part| message.contains(part)), "{message} lacks one of {parts:?}");
    };
    let curve = |name: &str| fault(&WEBER.replace("We", name));
    part(curve("Weber"), &["m.toml:14:1: effects[1].input", "unknown input `Weber`", "[inputs.Weber]"]);
    part(
        curve("St_film"),
        &[
            "effects[1].input: the group St_film needs the viscosity of the film",
            "slag to a wall",
            "or declare [inputs.mu_film]",
        ],
    );
    part(curve("St_gas"), &["effects[1].input", "the viscosity of the gas", "declare [inputs.mu_gas]"]);
    part(curve("v_n/v_s"), &["effects[1].input", "a sticking velocity", "\"thornton-ning\""]);
    part(curve("mu/mu_ref"), &["a reference viscosity", "[capture] model = \"viscosity\""]);
    let glass = |text: &str| {
        let text = format!("{}{text}", PLAIN.replace("montan-wax", "pyrex"));
        Model::from_toml("m.toml", &text).unwrap_err().to_string()
    };
    part(
        glass(WEBER),
        &["surface tension", "give surface_tension to the particle's material", "[inputs.sigma_p]"],
    );
    part(glass(&WEBER.replace("We", "T_p/T_melt")), &["give melting_point"]);
    let level = "[[effects]]\nkind = \"level-shift\"\non = \"e_t\"\nvalue = 0.1\nvalid = { K = [0, 1] }\n";
    part(glass(level), &["m.toml:16:1: effects[1].valid: the group K needs"]);
    part(fault(&level.replace("K =", "Kk =")), &["effects[1].valid.Kk", "unknown key `Kk`"]);

    part(fault(&form("e_n", "powr", "a = 1")), &["effects[1].form", "did you mean `power`?"]);
    part(fault(&form("e_n", "power", "a = 1")), &["effects[1].b: missing", "the exponent"]);
    part(fault(&form("e_n", "line", "a = 1\nb = 2\nx_0 = 3")), &["effects[1].x_0", "unknown key"]);
    part(fault(&form("e_n", "exponential", "a = 1\nx_0 = -3")), &["effects[1].x_0", "above 0"]);
    part(
        fault(&form("e_n", "constant", "a = 1\nacts = \"replace\"")),
        &["effects[1].acts", "known here: add, factor, times, set"],
    );
    part(fault(&form("e_m", "constant", "a = 1")), &["effects[1].on", "known here: e_n, e_t, capture"]);
    let constant = form("e_n", "constant", "a = 1");
    part(
        fault(&constant.replace("form = \"constant\"\n", "")),
        &["effects[1].form: missing", "one of constant, line"],
    );
    part(fault(&constant.replace("input = \"We\"\n", "")), &["effects[1].input: missing"]);
    let word = format!("[inputs.lot]\nlabels = [\"A\"]\n{}", constant.replace("We", "lot"));
    part(fault(&word), &["effects[1].input: lot is a word", "fitted-curve"]);

    part(fault("[groups]\nWe = { v_n = 1 }\n"), &["groups.We", "is a built-in group", "another name"]);
    part(fault("[groups]\nT_p = { v_n = 1 }\n"), &["groups.T_p", "is an input that every model has"]);
    part(
        fault("[inputs.dose]\ndefault = 1\n[groups]\ndose = { v_n = 1 }\n"),
        &["groups.dose", "input of this file"],
    );
    part(fault("[groups]\npi = {}\n"), &["groups.pi", "empty"]);
    part(fault("[groups]\npi = { speed = 1 }\n"), &["groups.pi.speed", "unknown input", "[inputs.speed]"]);
    part(fault("[groups]\npi = { v_n = \"2\" }\n"), &["groups.pi.v_n", "expected a number"]);
    part(fault("[groups]\npi = { v_n = inf }\n"), &["groups.pi.v_n", "not finite"]);
}

#[test]
fn the_documents_list_every_group_and_form() {
    let page = include_str!("../../docs/reference/model-file.md");
    let physics = include_str!("../../docs/why/physics.md");
    for group in &GROUPS {
        assert!(
            physics.contains(&format!("| `{}` |", group.name)),
            "docs/why/physics.md lacks {}",
            group.name
        );
    }
    for form in &FORMS {
        let row = format!("| `{}` | `{}`", form.name, form.equation.split(',').next().unwrap());
        assert!(physics.contains(&row), "docs/why/physics.md lacks {row}");
    }
    let section = page.split("\n## ").find(|section| section.starts_with("Groups and closed forms")).unwrap();
    let example = section.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    for text in [example, &example.replace("\n# ", "\n")] {
        assert_eq!(model(text).terms().len(), 2);
    }
}
