//! Pages that are built by hand, so that every sentence can be traced to a number.

use std::collections::BTreeMap;

use super::{RigPage, RigSource, page};
use crate::dataset::BadRow;
use crate::diagnose::rig::{KindErrors, NextExperiment, RigDiagnosis, RigRow};
use crate::diagnose::{
    Alternative, Calibration, CauseCurve, Diagnosis, Estimate, Finding, Fit, FitTest, Gain, LargeMisfit,
    NotExamined, Rows,
};

/// The number of figures of the page, and its text without tags, each piece of white space one blank.
fn seen(found: &RigDiagnosis) -> (usize, String) {
    let in_case = |key: &str| (key == "particles.temperature").then_some(300.0);
    let source = RigSource::Case { file: "my rig/case.toml", number: &in_case };
    let html = page(found, &RigPage { data: "lab/rig.csv", source }).unwrap();
    assert!(!html.contains("NaN") && !html.contains("inf ") && !html.contains("nats"), "{html}");
    assert!(!html.contains("https:") && !html.contains("src="), "{html}");
    for figure in html.split("<figure id=\"").skip(1) {
        let figure = figure.split("</figure>").next().unwrap_or("");
        let id = figure.split('"').next().unwrap_or("");
        let drawn = figure.matches("<circle").count()
            + figure.matches("<rect").count()
            + figure.matches("<path").count();
        assert!(drawn > 2, "the figure {id} is empty: {figure}");
        assert_eq!(html.matches(&format!("<figure id=\"{id}\"")).count(), 1, "two figures are called {id}");
    }
    let body = html.split_once("<body>").map_or("", |(_, body)| body);
    let pieces = body.split('<').map(|piece| piece.split_once('>').map_or(piece, |(_, text)| text));
    let text = pieces.collect::<Vec<_>>().join(" ").replace("&#34;", "\"").replace("&#39;", "'");
    (html.matches("<figure").count(), text.split_whitespace().collect::<Vec<_>>().join(" "))
}

fn shows(text: &str, sentences: &[&str]) {
    for sentence in sentences {
        assert!(text.contains(sentence), "`{sentence}` is not on the page: {text}");
    }
}

/// A reading whose base model is off by `off` errors of 0.02 and whose extended model is off by a tenth of it.
fn row(experiment: usize, observable: &str, settings: &[(&str, f64)], measured: f64, off: f64) -> RigRow {
    RigRow {
        experiment: format!("run {}", experiment + 1),
        line: experiment as u64 + 2,
        observable: observable.into(),
        settings: settings.iter().map(|(key, value)| ((*key).to_owned(), value.to_string())).collect(),
        measured,
        error: 0.02,
        base: Some(measured - 0.02 * off),
        extended: Some(measured - 0.002 * off),
        held_out: Some(measured - 0.004 * off),
    }
}

/// Readings of `observables`, whose base model is worse the hotter the particles are.
fn rows(experiments: usize, observables: &[&str]) -> Vec<RigRow> {
    let of = |experiment: usize| {
        let hot = experiment as f64 / experiments as f64;
        let settings = [
            ("particles.temperature", 300.0 + 60.0 * hot),
            ("particles.speed", 1.0 + (experiment % 5) as f64),
        ];
        let one = move |(place, observable): (usize, &&str)| {
            row(experiment, observable, &settings, 0.1 + 0.6 * hot + 0.05 * place as f64, 9.0 * hot * hot)
        };
        observables.iter().enumerate().map(one).collect::<Vec<RigRow>>()
    };
    (0..experiments).flat_map(of).collect()
}

fn errors(kinds: &[&'static str]) -> Vec<KindErrors> {
    let one = |kind: &&'static str| KindErrors {
        observable: kind,
        readings: 9,
        rmse_base: 0.16,
        rmse_extended: 0.016,
    };
    kinds.iter().map(one).collect()
}

fn stated(chi_square: f64, freedom: usize, p_value: f64) -> FitTest {
    FitTest {
        against: "stated errors",
        chi_square: Some(chi_square),
        degrees_of_freedom: Some(freedom),
        p_value: Some(p_value),
    }
}

fn found(readings: Vec<RigRow>, kinds: &[&'static str]) -> RigDiagnosis {
    let read = readings.len();
    RigDiagnosis {
        diagnosis: Diagnosis {
            schema: "nearwall.diagnosis/2",
            seed: 1,
            level: 0.05,
            verdict: "The verdict.".into(),
            rows: Rows { read, used: read, ..Rows::default() },
            fit: Fit {
                base: stated(9.0, read.max(1), 0.6),
                extended: stated(9.0, read.max(1), 0.6),
                ..Fit::default()
            },
            extended_model: "extended.toml",
            ..Diagnosis::default()
        },
        readings,
        errors: errors(kinds),
        next: Vec::new(),
        next_table: String::new(),
        parties: crate::diagnose::rig::Parties::default(),
        blame: Vec::new(),
        extended_case: None,
        notes: Vec::new(),
        extended: "[particle]\nmaterial = \"montan-wax\"\n".into(),
        draws: Vec::new(),
    }
}

/// The same with a cause.
fn with_cause(mut found: RigDiagnosis, cause: &str) -> RigDiagnosis {
    let diagnosis = &mut found.diagnosis;
    diagnosis.fit.base = stated(84.0, 12, 6e-13);
    diagnosis.fit.largest = vec![LargeMisfit {
        line: 4,
        observable: "captured",
        measured: found.readings.get(6).map_or(0.1, |row| row.measured),
        predicted: 0.01,
        standard_errors: 4.5,
    }];
    diagnosis.findings = vec![finding(cause)];
    diagnosis.gains = vec![gain(0.16, 0.016, [0.05, 0.4])];
    diagnosis.gain = diagnosis.gains.first().cloned();
    found
}

fn finding(cause: &str) -> Finding {
    let value = Estimate { value: 345.0, low: 341.0, high: 349.0, unit: "K" };
    Finding {
        cause: cause.into(),
        observable: "captured",
        variables: vec!["T_p".into()],
        gain: 36.0,
        chi_square: 75.0,
        sigma: 5.8,
        probability: 0.93,
        certainty: 0.93,
        lack_of_fit: None,
        not_separable: Vec::new(),
        p_value: 1e-8,
        q_value: 1e-8,
        parameters: BTreeMap::from([("temperature", value)]),
        alternatives: vec![Alternative {
            cause: "level:capture".into(),
            score_difference: 4.0,
            probability: 0.0,
        }],
        indistinguishable_from: Vec::new(),
        measure_next: Vec::new(),
        curve: None,
        forms: Vec::new(),
        surface: None,
        explanation: "It acts most on captured.".into(),
    }
}

fn gain(rmse_before: f64, rmse_after: f64, ci95: [f64; 2]) -> Gain {
    Gain {
        held_out_rows: 12,
        measured: "cross-validated",
        observable: "captured",
        rmse_before,
        rmse_after,
        ci95,
        noise_floor: Some(0.02),
        log_score_before: 1.0,
        log_score_after: 1.5,
    }
}

#[test]
fn a_cause_on_several_walls_is_shown_in_full() {
    let observables = ["captured@target", "captured@lid", "mean_e_n@target"];
    let readings = rows(12, &observables);
    let mut found = with_cause(found(readings, &["captured", "mean_e_n"]), "melting-transition");
    let diagnosis = &mut found.diagnosis;
    diagnosis.findings[0].indistinguishable_from = vec!["thermal-softening".into()];
    diagnosis.calibration = vec![Calibration {
        key: "tangential.e_t".into(),
        from: 1.0,
        value: 0.8,
        low: 0.7,
        high: 0.9,
        p_value: 1e-4,
        q_value: 1e-4,
    }];
    diagnosis.not_examined =
        vec![NotExamined { cause: "gas-lift", reason: "v_t does not vary over the impacts".into() }];
    diagnosis.rows.rejected = vec![BadRow { line: 9, reason: "no observable has a value".into() }];
    found.notes = vec!["columns taken as notes: remark".into()];
    found.draws = vec![String::new(); 39];
    found.next = vec![NextExperiment {
        settings: vec![("particles.temperature".into(), "345".into())],
        observable: "captured@lid".into(),
        repeats: Some(60),
        error: None,
        tells_causes: 2.0,
        pins_numbers: 0.7,
        predicted: vec![("melting-transition".into(), 0.5), ("level:capture".into(), 0.25)],
    }];
    let (figures, text) = seen(&found);
    assert_eq!(figures, 5, "three columns and the parity of two kinds");
    shows(
        &text,
        &[
            "36 rows read, 36 used: 12 experiments with 36 readings. 1 row was left out",
            "Columns taken as notes: remark.",
            "The base model does not; the extended model does.",
            "chi-square is 84 with 12 degrees of freedom, 7 for each",
            "4 run 3 captured@target",
            "Captured / injected mass, wall lid, over particles.temperature",
            "12 readings over particles.temperature. Other settings vary as well",
            "the base model 6 of 12, the extended model 0 of 12; by chance 1 in 20",
            "Measured against predicted: captured share of the injected mass",
            "a model chosen and fitted without the experiment, so they are true predictions",
            "melting-transition captured share of the injected mass thermal-softening 5.8",
            "Cause 1: melting-transition",
            "341 to 349 K",
            "shift of capture +8.0 &#60; 0.01",
            "What these experiments do not exclude",
            "tangential.e_t 1 0.8 0.7 to 0.9",
            "the extended model is off by 0.016 instead of 0.16 (root mean square). The noise floor is 0.02: what is \
                left is noise.",
            "1 particles.temperature = 345 captured@lid melting-transition: 0.5, shift of capture: 0.25 7.4 2.0 60",
            "gas-lift",
            "vary and record v_t",
            "run 1 particles.temperature = 300, particles.speed = 1 captured@target 0.1 ± 0.02 0.1 0.1 0.1",
            "9 no observable has a value",
            "nearwall simulate 'my rig/case.toml' -o extended",
            "model \"&#60;constant&#62;/nearWall.toml\";",
            "draws/ has 39 model files",
        ],
    );
    assert!(text.find("Does the simulation fit?") < text.find("Causes at a glance"));
    assert!(text.find("All readings") < text.rfind("Rows left out"));
}

#[test]
fn nothing_found_is_a_short_page() {
    let (figures, text) = seen(&found(rows(6, &["capture_efficiency@a"]), &["capture_efficiency"]));
    assert_eq!(figures, 2);
    shows(&text, &["Yes. The misfit of the base model is no larger", "Nothing was added to the model."]);
    for absent in ["extended model 0", "Causes at a glance", "What to measure next", "held out [1]"] {
        assert!(!text.contains(absent), "`{absent}`: {text}");
    }
}

/// Three readings of one run: nothing to draw them over, one figure for all.
#[test]
fn one_experiment_is_enough_for_a_page() {
    let readings = rows(1, &["captured@a", "mean_e_n@a", "mean_e_t@a"]);
    let (figures, text) = seen(&found(readings, &["captured", "mean_e_n", "mean_e_t"]));
    assert_eq!(figures, 1);
    shows(
        &text,
        &["1 experiment with 3 readings", "No setting differs", "Measured against predicted: all readings"],
    );
}

#[test]
fn bins_along_a_wall_are_a_profile() {
    let bins: Vec<String> = (0..8)
        .map(|i| format!("captured_from_{}_to_{}@tube", 0.1 * f64::from(i), 0.1 * f64::from(i + 1)))
        .collect();
    let bins: Vec<&str> = bins.iter().map(String::as_str).collect();
    let found = with_cause(found(rows(12, &bins), &["captured"]), "unknown:T_p");
    let (figures, text) = seen(&found);
    assert_eq!(figures, 9, "eight profiles and one parity");
    shows(
        &text,
        &[
            "8 of 12 figures",
            "Captured along the wall, wall tube: run 12",
            "8 bins of experiment run 12, at their middles",
        ],
    );
}

#[test]
fn two_hundred_readings_of_many_kinds_stay_few_figures() {
    let observables = [
        "captured@a",
        "captured@b",
        "captured@c",
        "capture_efficiency@a",
        "mean_e_n@a",
        "mean_e_n@b",
        "mean_e_t@a",
        "share_e_n_below_0.6@a",
        "quantile_0.9_e_n@a",
        "mean_conversion@a",
    ];
    let kinds = [
        "captured",
        "capture_efficiency",
        "mean_e_n",
        "mean_e_t",
        "share_e_n_below",
        "quantile_e_n",
        "mean_conversion",
    ];
    let (figures, text) = seen(&with_cause(found(rows(20, &observables), &kinds), "melting-transition"));
    assert_eq!(figures, 15, "eight figures over a setting, seven parities");
    shows(&text, &["20 experiments with 200 readings", "8 of 10 figures", "90 % quantile of e_n"]);
}

/// Where no reading has an error, chi-square is not known; a model without a value for a reading has a dash.
#[test]
fn readings_without_errors_and_predictions_are_said_to_be_so() {
    let mut readings = rows(9, &["mean_e_n@a"]);
    for row in &mut readings {
        row.settings.clear();
        (row.base, row.held_out) = (None, None);
    }
    let structure = FitTest { against: "structure", p_value: Some(0.002), ..FitTest::default() };
    let mut found = with_cause(found(readings, &["mean_e_n"]), "unknown:T_p");
    found.diagnosis.fit.base = structure;
    found.diagnosis.gains.clear();
    found.diagnosis.findings[0].curve = Some(CauseCurve {
        factor: true,
        at: vec!["300".into(), "330".into(), "360".into()],
        adds: vec![0.0, 0.2, -0.1],
    });
    let (figures, text) = seen(&found);
    assert_eq!(figures, 3);
    shows(
        &text,
        &[
            "the test asks whether any candidate explains what is left",
            "9 readings, experiments side by side.",
            "the base model 0 of 0 (and has no value for 9)",
            "Fitted curve over T_p",
            "The experiments are too few to hold some of them back",
            "run 1 mean_e_n@a 0.1 ± 0.02 – 0.1",
        ],
    );
}
