//! Tests of the generator: laws, noise, plants, gains and scoring.

use serde_json::{Value, json};

use crate::campaign::{Campaign, KNOWN, System};
use crate::contact::{Body, Contact, Tangential};
use crate::gates::at_most;
use crate::plant::Hook;
use crate::score::{Verdict, judge};
use crate::set_rng::SetRng;
use crate::sets::{Design, EFFECTS, Kind, Recipe, Set, recipes};
use crate::world::{Inputs, normal};
use crate::{random, runner};

fn close(ours: f64, other: f64, relative: f64, absolute: f64) {
    assert!((ours - other).abs() <= (relative * other.abs()).max(absolute), "{ours:e} against {other:e}");
}

#[test]
fn thornton_ning_agrees_with_forty_digits() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/thornton_ning.csv");
    let mut table = csv::Reader::from_path(path).unwrap();
    for row in table.deserialize::<[f64; 14]>() {
        let [e1, nu1, e2, nu2, density, d, adhesion, pressure, v, e_star, v_adh, v_y, v_s, e_n] =
            row.unwrap();
        let body = |modulus, poisson| Body { modulus, poisson };
        let (particle, wall) = (body(e1, nu1), body(e2, nu2));
        let contact =
            Contact { particle, wall, density, yield_strength: pressure, yield_ratio: 1.0, adhesion };
        close(contact.reduced_modulus(), e_star, 1e-12, 0.0);
        close(contact.adhesive_speed(d), v_adh, 1e-12, 0.0);
        close(contact.yield_speed(), v_y, 1e-12, 0.0);
        close(contact.sticking_speed(d), v_s, 1e-9, 0.0);
        close(contact.restitution(v, d), e_n, 1e-9, 1e-9);
    }
}

/// The set of this name.
fn planted(name: &str, seed: u64) -> Set {
    recipes(1).into_iter().find(|recipe| recipe.name == name).unwrap().make(seed)
}

/// A set of no effect on this base.
fn plain(system: System, law: Tangential, name: &str) -> Set {
    let recipe = Recipe::new(name.into(), Kind::Null, move |rng| {
        let mut campaign = Campaign::new(system, law, rng);
        campaign.columns = KNOWN.to_vec();
        campaign.v_n.0 /= 5.0;
        campaign.theta = (1.0, 85.0);
        Design { campaign, plants: vec![] }
    });
    recipe.make(random::seed())
}

#[test]
fn with_nothing_planted_the_command_says_the_same() {
    let laws = [
        Tangential::Constant(0.77),
        Tangential::Sliding { friction: 0.21 },
        Tangential::SlidingRolling { friction: 0.28 },
    ];
    for system in [System::Wax, System::Tungsten, System::Char, System::HotTungsten] {
        for law in laws {
            let set = plain(system, law, &format!("{system:?}{law:?}"));
            let folder = tempfile::tempdir().unwrap();
            std::fs::write(folder.path().join("base.toml"), set.model()).unwrap();
            let impacts: Vec<_> = set.rows.iter().map(|row| row.x).collect();
            let predicted = runner::predict(&set, folder.path(), "base.toml", &impacts);
            for (x, theirs) in impacts.iter().zip(predicted) {
                let ours = set.world.truth(x, [0.3, 0.7]);
                assert_eq!(ours.stick, theirs.stick, "{x:?}");
                close(ours.e_n, theirs.e_n, 1e-9, 1e-9);
                if ours.stick == 0.0 {
                    close(ours.e_t, theirs.e_t, 1e-9, 1e-9);
                }
            }
        }
    }
}

#[test]
fn noise_has_the_stated_deviation_and_no_bias() {
    let mut rng = SetRng::new(random::seed(), "noise");
    let (mean, deviation, count) = (0.4, 0.05, 20_000);
    let noise: Vec<_> = (0..count).map(|_| rng.noise(mean, deviation)).collect();
    let average = noise.iter().sum::<f64>() / f64::from(count);
    let spread = (noise.iter().map(|n| n * n).sum::<f64>() / f64::from(count)).sqrt();
    close(average, 0.0, 0.0, 5.0 * deviation / f64::from(count).sqrt());
    close(spread, deviation, 0.03, 0.0);
    assert!((0..10_000).all(|_| rng.noise(0.01, deviation) > -0.01));
}

#[test]
fn tilts_are_normal() {
    let mut rng = SetRng::new(random::seed(), "tilts");
    let count = 40_000;
    let all: Vec<_> = (0..count).map(|_| normal([rng.unit(), rng.unit()])).collect();
    let share = |from: f64| all.iter().filter(|z| **z > from).count() as f64 / f64::from(count);
    close(share(0.0), 0.5, 0.0, 0.015);
    close(share(1.959_964), 0.025, 0.0, 0.005);
}

/// The residuals of the measured rows have the deviation of the noise.
#[test]
fn residuals_of_a_set_are_its_noise() {
    for recipe in recipes(1).iter().filter(|recipe| recipe.kind == Kind::Planted) {
        let set = recipe.make(random::seed());
        if set.world.scatters() {
            continue;
        }
        let squares: Vec<f64> = set
            .rows
            .iter()
            .filter_map(|row| {
                let truth = set.world.truth(&row.x, [0.5; 2]);
                let clear = truth.e_n > 3.5 * set.campaign.noise_e_n;
                row.e_n.filter(|_| clear).map(|e_n| (e_n - truth.e_n).powi(2))
            })
            .collect();
        if squares.len() > 100 {
            let spread = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
            let share = 5.0 / (2.0 * squares.len() as f64).sqrt();
            close(spread, set.campaign.noise_e_n, share, 0.0);
        }
    }
}

/// The inputs that an effect may depend on, beside v_n and v_t.
fn inputs_of(cause: &str) -> &'static [&'static str] {
    match cause {
        "gas-lift" => &["v_gas"],
        "powder-layer" => &["layer_thickness"],
        "liquid-film" => &["film_thickness", "d"],
        "melting-transition" | "thermal-softening" => &["T_p"],
        "conversion-transition" => &["conversion"],
        "size-dependent-yield" => &["d"],
        _ => &[],
    }
}

/// The truth changes with the inputs of its plant and with no other.
#[test]
fn a_plant_depends_on_its_own_inputs() {
    let seed = random::seed();
    for effect in EFFECTS {
        let name = format!("{effect}:2");
        let set = planted(&name, seed);
        let mut rng = SetRng::new(seed, "inputs");
        let draws = [0.37, 0.02];
        let mut moved = vec![];
        for row in &set.rows {
            let other = set.campaign.inputs(&mut rng);
            for name in
                ["T_p", "T_w", "v_gas", "layer_thickness", "film_thickness", "roughness", "conversion"]
            {
                let mut x = row.x;
                match name {
                    "T_p" => x.t_p = other.t_p,
                    "T_w" => x.t_w = other.t_w,
                    "v_gas" => x.v_gas = other.v_gas,
                    "layer_thickness" => x.layer = other.layer,
                    "film_thickness" => x.film = other.film,
                    "roughness" => x.roughness = other.roughness,
                    _ => x.conversion = other.conversion,
                }
                let (one, two) = (set.world.truth(&row.x, draws), set.world.truth(&x, draws));
                if (one.e_n, one.e_t, one.stick) != (two.e_n, two.e_t, two.stick) && !moved.contains(&name) {
                    moved.push(name);
                }
            }
        }
        let cause = set.causes()[0];
        let allowed: Vec<_> = inputs_of(cause).iter().filter(|name| **name != "d").collect();
        assert!(moved.iter().all(|name| allowed.contains(&name)), "{effect} depends on {moved:?}");
        assert_eq!(moved.len(), allowed.len(), "{effect} depends on {moved:?}");
    }
}

/// Plants of e_t do not change e_n and capture; plants of e_n change a constant e_t only by tilting the wall.
#[test]
fn a_plant_touches_its_own_observables() {
    let seed = random::seed();
    for effect in EFFECTS {
        let name = format!("{effect}:1");
        let set = planted(&name, seed);
        let constant = matches!(set.campaign.law, Tangential::Constant(_));
        for row in &set.rows {
            let (base, truth) = (set.world.base(&row.x), set.world.truth(&row.x, [0.4, 0.01]));
            match set.world.plants[0].hook {
                Hook::Tangential(_) => assert_eq!((base.e_n, base.stick), (truth.e_n, truth.stick)),
                Hook::Tilt(_) => {}
                Hook::Solid(_) | Hook::Normal(_) if constant => assert_eq!(base.e_t, truth.e_t),
                Hook::Solid(_) | Hook::Normal(_) => {}
            }
        }
    }
}

/// e_n changes with the sign that physics demands.
#[test]
fn signs_are_those_of_the_physics() {
    let seed = random::seed();
    let up = ["oblique-angle-rise", "gas-lift", "strain-rate-hardening", "agglomerates"];
    let down = [
        "oblique-angle",
        "powder-layer",
        "liquid-film",
        "melting-transition",
        "thermal-softening",
        "viscoelastic-loss",
    ];
    for (effects, sign) in [(&up[..], 1.0), (&down[..], -1.0)] {
        for effect in effects {
            let name = format!("{effect}:1");
            let set = planted(&name, seed);
            for row in &set.rows {
                let change = set.world.truth(&row.x, [0.4, 0.01]).e_n - set.world.base(&row.x).e_n;
                assert!(sign * change >= -1e-12, "{effect}: {change} at {:?}", row.x);
            }
        }
    }
}

#[test]
fn every_planted_set_can_be_told() {
    for recipe in recipes(1).iter().filter(|recipe| recipe.kind == Kind::Planted) {
        let set = recipe.make(random::seed());
        assert!(set.gain.over_base > 30.0, "{}: {:?}", set.name, set.gain);
        let rebounds = set.rows.iter().filter(|row| !row.stuck).count();
        assert!(rebounds > 100, "{}: {rebounds} rebounds", set.name);
    }
}

/// For Gaussian noise alone, the gain equals the textbook's.
#[test]
fn the_gain_of_a_known_shift() {
    let recipe = Recipe::new("known-shift".into(), Kind::Planted, |rng| {
        let mut campaign = Campaign::new(System::Wax, Tangential::Constant(0.7), rng);
        campaign.v_n = (2.0, 5.0);
        Design { campaign, plants: vec![crate::plant::yield_ratio(1.2)] }
    });
    let set = recipe.make(random::seed());
    let off = |pick: &dyn Fn(&Inputs) -> f64| {
        set.rows.iter().map(|row| (row.e_n.unwrap() - pick(&row.x)).powi(2)).sum::<f64>()
    };
    let (base, truth) = (off(&|x| set.world.base(x).e_n), off(&|x| set.world.truth(x, [0.5; 2]).e_n));
    let expected = 0.75 * set.rows.len() as f64 / 2.0 * (base / truth).ln();
    close(set.gain.over_base, expected, 0.0, 8.0);
}

#[test]
fn the_same_seed_makes_the_same_set() {
    let seed = random::seed();
    let texts: Vec<_> = [seed, seed, seed + 1].iter().map(|seed| planted("gas-lift:1", *seed).csv).collect();
    assert!(texts[0] == texts[1] && texts[0] != texts[2]);
}

#[test]
fn a_decoy_follows_its_input() {
    for recipe in recipes(1).iter().filter(|recipe| recipe.kind == Kind::Decoy) {
        let set = recipe.make(random::seed());
        let input = set.campaign.decoy.unwrap().input;
        let pairs: Vec<_> = set.rows.iter().map(|row| (row.x.value(input), row.x.foreign)).collect();
        close(correlation(&pairs), 0.85, 0.0, 0.08);
    }
}

fn correlation(pairs: &[(f64, f64)]) -> f64 {
    let count = pairs.len() as f64;
    let (a, b) = pairs.iter().fold((0.0, 0.0), |sum, pair| (sum.0 + pair.0 / count, sum.1 + pair.1 / count));
    let moment = |f: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>();
    moment(&|p| (p.0 - a) * (p.1 - b))
        / (moment(&|p| (p.0 - a).powi(2)) * moment(&|p| (p.1 - b).powi(2))).sqrt()
}

#[test]
fn broken_lines_are_where_they_are_said() {
    let recipe = recipes(1).into_iter().find(|recipe| recipe.kind == Kind::Broken).unwrap();
    let set = recipe.make(random::seed());
    assert!(set.broken_lines.len() >= 6);
    let header: Vec<_> = set.csv.lines().next().unwrap().split(',').collect();
    let at = |name: &str| header.iter().position(|column| *column == name).unwrap();
    for (index, line) in set.csv.lines().enumerate().skip(1) {
        let cells: Vec<_> = line.split(',').collect();
        let positive = |name: &str| cells[at(name)].parse::<f64>().is_ok_and(|value| value > 0.0);
        let sound = positive("v_n")
            && positive("d")
            // A small one is written as 0.0000.
            && (cells[at("e_n")].is_empty() || cells[at("e_n")].parse::<f64>().is_ok_and(|value| value >= 0.0))
            && ["", "stick", "rebound"].contains(&cells[at("outcome")]);
        assert_eq!(!sound, set.broken_lines.contains(&(index + 1)), "{line}");
    }
}

/// A diagnosis with these findings.
fn answer(findings: &[Value]) -> Value {
    json!({ "rows": { "rejected": [] }, "findings": findings })
}

#[test]
fn verdicts() {
    let set = planted("melting-transition:1", 1);
    let half = set.world.plants[0].parameters[0].1;
    let stated = json!({ "temperature": { "value": half + 1.0, "low": half - 1.0, "high": half + 3.0 } });
    let melting = json!({ "cause": "melting-transition", "parameters": stated });
    let other = json!({ "cause": "thermal-softening", "indistinguishable_from": [] });
    let unsure = json!({ "cause": "thermal-softening", "indistinguishable_from": ["melting-transition"] });
    let right = judge(&set, &answer(std::slice::from_ref(&melting)));
    assert!(right.verdict == Verdict::Right && right.exact && right.intervals[0].holds());
    let both = judge(&set, &answer(&[other.clone(), melting]));
    assert!(both.verdict == Verdict::False && !both.exact);
    assert_eq!(judge(&set, &answer(&[unsure])).verdict, Verdict::CannotTell);
    assert_eq!(judge(&set, &answer(&[])).verdict, Verdict::Missed);
    let null = planted("null:0", 1);
    assert!(judge(&null, &answer(&[])).trap_passed && !judge(&null, &answer(&[other])).trap_passed);
}

/// The diagnosis that knows the truth.
fn perfect(set: &Set) -> Value {
    let cause = |plant: &std::sync::Arc<crate::plant::Plant>| {
        let interval = |value: f64| json!({ "value": value, "low": 0.9 * value, "high": 1.1 * value });
        let parameters: serde_json::Map<_, _> =
            plant.parameters.iter().map(|(name, value)| ((*name).to_string(), interval(*value))).collect();
        json!({ "cause": plant.cause, "parameters": parameters, "indistinguishable_from": [] })
    };
    let lines: Vec<_> = set.broken_lines.iter().map(|line| json!({ "line": line, "reason": "" })).collect();
    let findings: Vec<_> = set.world.plants.iter().map(cause).collect();
    let calibration = [json!({ "key": "tangential.e_t", "value": 0.81 })];
    json!({ "rows": { "rejected": lines }, "findings": findings, "calibration": calibration })
}

/// The diagnosis that knows the truth passes; an empty one and a constant one do not.
#[test]
fn the_demands_can_be_met_and_missed() {
    let sets: Vec<_> = recipes(1).iter().map(|recipe| recipe.make(random::seed())).collect();
    let score = |answer: &dyn Fn(&Set) -> Value| {
        crate::score::report(&sets.iter().map(|set| judge(set, &answer(set))).collect::<Vec<_>>())
    };
    assert_eq!(score(&perfect), Vec::<String>::new());
    assert!(score(&|_| answer(&[])).len() >= 2);
    let always = json!({ "cause": "agglomerates", "indistinguishable_from": [] });
    assert!(score(&|_| answer(std::slice::from_ref(&always))).len() >= 3);
}

/// The error of the base model is far above the attainable one; that of the truth equals it.
#[test]
fn held_out_errors() {
    for (name, observable) in [("powder-layer:2", "e_n"), ("melting-transition:2", "stick")] {
        let set = planted(name, random::seed());
        let fresh = runner::fresh_impacts(&set, 5);
        let truth: Vec<_> = fresh.iter().map(|x| set.world.truth(x, [0.5; 2])).collect();
        let base: Vec<_> = fresh.iter().map(|x| set.world.base(x)).collect();
        assert!(runner::compare(&set, observable, &truth, &truth).close());
        assert!(!runner::compare(&set, observable, &truth, &base).close(), "{name}");
    }
}

#[test]
fn binomial_tail() {
    close(at_most(3, 3, 0.95), 1.0, 1e-12, 0.0);
    close(at_most(17, 20, 0.95), 0.075_483_67, 1e-6, 0.0);
}
