//! Pages of diagnoses that are built by hand, so that every sentence can be traced to a number.

use std::collections::BTreeMap;

use super::page;
use crate::diagnose::{
    Alternative, DataView, Diagnosis, Estimate, Finding, Fit, FitTest, Gain, GroupsFound, LargeMisfit,
    NextMeasurement, Rival, Rows, Sample, SampleRow, ScatterFound,
};

const EXTENDED: &str = "[particle]\nmaterial = \"montan-wax\"\n";

/// The text of a page without tags, each piece of white space one blank.
fn text(diagnosis: &Diagnosis, extended: &str) -> String {
    let html = page(diagnosis, &["lab.csv".to_owned(), "wax.toml".to_owned()], extended).unwrap();
    assert!(!html.contains("NaN") && !html.contains("nats"), "{html}");
    let body = html.split_once("<body>").map_or("", |(_, body)| body);
    let pieces = body.split('<').map(|piece| piece.split_once('>').map_or(piece, |(_, text)| text));
    let text = pieces.collect::<Vec<_>>().join(" ").replace("&#34;", "\"").replace("&#39;", "'");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn shows(text: &str, sentences: &[&str]) {
    for sentence in sentences {
        assert!(text.contains(sentence), "`{sentence}` is not on the page: {text}");
    }
}

/// `e_t` over `v_t`: measured minus base and minus extended model are `off` stated errors of 0.01.
fn sample(off: &[[f64; 2]], error: Option<f64>) -> Sample {
    let rows = off.iter().enumerate().map(|(i, off)| {
        let x = 0.5 + 0.25 * i as f64;
        let measured = 0.7 + 0.02 * x;
        let models = off.map(|off| measured - 0.01 * off);
        let values = [None, Some([measured, models[0], models[1]]), None];
        SampleRow { held_out: false, cells: vec![x], errors: [None, error], values }
    });
    let rows: Vec<SampleRow> = rows.collect();
    let curve = rows.iter().filter_map(|row| Some((row.cells[0], row.values[1]?)));
    let curve = curve.map(|(x, [_, base, extended])| [x, base, extended]).collect();
    Sample {
        columns: vec![("v_t".into(), "m/s".into())],
        words: vec![None],
        views: vec![DataView { observable: "e_t", column: "v_t".into(), within: None, curve }],
        rows,
        notes: Vec::new(),
    }
}

fn stated(chi_square: f64, degrees_of_freedom: usize, p_value: f64) -> FitTest {
    FitTest {
        against: "stated errors",
        chi_square: Some(chi_square),
        degrees_of_freedom: Some(degrees_of_freedom),
        p_value: Some(p_value),
    }
}

fn diagnosis(sample: Sample, fit: Fit) -> Diagnosis {
    let used = sample.rows.len();
    Diagnosis {
        schema: "nearwall.diagnosis/2",
        seed: 1,
        level: 0.05,
        verdict: "The verdict.".into(),
        rows: Rows { read: used, used, ..Rows::default() },
        extended_model: "extended.toml",
        scatter: ScatterFound { e_t: 0.01, ..ScatterFound::default() },
        sample,
        fit,
        ..Diagnosis::default()
    }
}

fn finding(cause: &str) -> Finding {
    let value = Estimate { value: 0.8, low: 0.7, high: 0.9, unit: "1" };
    Finding {
        cause: cause.into(),
        observable: "e_t",
        variables: vec!["v_t".into()],
        gain: 20.25,
        chi_square: 40.5,
        sigma: 5.2,
        probability: 0.97,
        certainty: 0.86,
        lack_of_fit: Some(0.4),
        not_separable: Vec::new(),
        p_value: 1e-8,
        q_value: 2.1e-7,
        parameters: BTreeMap::from([("friction", value)]),
        alternatives: vec![Alternative {
            cause: "gas-lift".into(),
            score_difference: 2.0,
            probability: 0.02,
        }],
        indistinguishable_from: Vec::new(),
        measure_next: Vec::new(),
        curve: None,
        forms: Vec::new(),
        surface: None,
        explanation: "It acts on e_t.".into(),
    }
}

fn gain(rmse_before: f64, rmse_after: f64, ci95: [f64; 2]) -> Gain {
    Gain {
        held_out_rows: 8,
        measured: "cross-validated",
        observable: "e_t",
        rmse_before,
        rmse_after,
        ci95,
        noise_floor: Some(0.01),
        log_score_before: 1.0,
        log_score_after: 1.5,
    }
}

#[test]
fn averages_far_from_the_model_are_not_called_noise() {
    let off: Vec<[f64; 2]> = (0..8).map(|i| [20.0 + 6.0 * f64::from(i); 2]).collect();
    let largest =
        LargeMisfit { line: 9, observable: "e_t", measured: 0.745, predicted: 0.125, standard_errors: 62.0 };
    let fit = Fit { base: stated(14_568.0, 8, 0.0), largest: vec![largest], ..Fit::default() };
    let mut diagnosis = diagnosis(sample(&off, Some(0.01)), fit);
    diagnosis.undecided = vec!["sliding-to-rolling".into(), "thermal-softening".into(), "unknown:day".into()];
    diagnosis.sample.notes =
        vec!["T_p is blank, taken as 293.15 K".into(), "column T_w looks like Celsius".into()];
    let text = text(&diagnosis, EXTENDED);
    shows(
        &text,
        &[
            "Does the model fit? No. The base model misses the data by more than chance allows.",
            "chi-square is 14568 with 8 degrees of freedom, 1821 for each",
            "A misfit this large happens by chance less than once in 1e12 data sets.",
            "standard deviation of 0.01 in e_t beyond the stated errors.",
            "9 e_t 0.745 0.125 +62.0",
            "cannot tell which of sliding-to-rolling, thermal-softening or curve over day the model lacks",
            "vary one of these with everything else constant: T_p (only thermal-softening depends on it), day (only",
            "T_p is blank, taken as 293.15 K.",
            "Column T_w looks like Celsius.",
            "bars are the stated standard errors. Within 1 and 2 stated standard errors lie 0 % and 0 % for the base \
                model",
        ],
    );
    assert!(
        !text.contains("No column stands out") && !text.contains("Every effect of the library was examined")
    );
    diagnosis.undecided.truncate(1);
    let text = self::text(&diagnosis, EXTENDED);
    shows(
        &text,
        &["A cause that may be missing", "cannot tell whether the model lacks sliding-to-rolling. It is not"],
    );
}

/// Points beyond three stated errors refute a model even where no test was made.
#[test]
fn far_points_alone_speak_against_the_model() {
    let fit = Fit { base: FitTest { against: "none", ..FitTest::default() }, ..Fit::default() };
    let off = [[3.5, 3.5], [-4.0, -4.0], [1.0, 1.0]];
    let far = text(&diagnosis(sample(&off, Some(0.01)), fit.clone()), EXTENDED);
    assert!(far.contains("No. The base model") && !far.contains("No column stands out"), "{far}");
    let near = text(&diagnosis(sample(&off[1..], Some(0.02)), fit.clone()), EXTENDED);
    assert!(near.contains("No column stands out"), "{near}");
    let unknown = text(&diagnosis(sample(&off, None), fit), EXTENDED);
    shows(&unknown, &["This cannot be said: the file states no standard errors", "No column stands out"]);
}

#[test]
fn a_model_that_fits_is_said_to_fit() {
    let off = [[0.5, 0.5], [-1.5, -1.5], [0.9, 0.9], [-0.2, -0.2]];
    let fit = Fit { base: stated(3.35, 4, 0.501), ..Fit::default() };
    let text = text(&diagnosis(sample(&off, Some(0.01)), fit), EXTENDED);
    shows(
        &text,
        &[
            "Yes. The misfit of the base model is no larger than chance allows.",
            "happens by chance in 50 % of data sets",
            "Within 1 and 2 stated standard errors lie 75 % and 100 % for the base model",
            "No column stands out",
            "Nothing was added, so it equals the base model",
        ],
    );
}

/// A fit to random numbers has a chi-square near its degrees of freedom, not far below.
#[test]
fn errors_that_are_stated_too_large_are_noticed() {
    let fit = Fit { base: stated(90.0, 8, 0.0), extended: stated(0.1, 7, 0.999_999), ..Fit::default() };
    let mut diagnosis = diagnosis(sample(&[[3.0, 0.1]; 8], Some(0.01)), fit);
    diagnosis.findings = vec![finding("sliding-to-rolling")];
    let text = text(&diagnosis, EXTENDED);
    shows(&text, &["the extended model does", "The stated errors are probably too large"]);
}

#[test]
fn a_cause_says_how_sure_it_is() {
    let off: Vec<[f64; 2]> =
        (0..12).map(|i| [1.9 * f64::from(i % 3), 0.9 * f64::from(i % 3) - 0.9]).collect();
    let fit = Fit { base: stated(80.0, 12, 4e-12), extended: stated(8.0, 11, 0.713), ..Fit::default() };
    let mut diagnosis = diagnosis(sample(&off, Some(0.01)), fit);
    let mut found = finding("sliding-to-rolling");
    found.indistinguishable_from = vec!["tangential-compliance".into(), "unknown:day".into()];
    found.not_separable = vec!["Only the product of `friction` and `strength` is known.".into()];
    found.measure_next = vec![NextMeasurement {
        cause: "sliding-to-rolling".into(),
        against: "tangential-compliance".into(),
        vary: "v_t".into(),
        range: [0.2, 9.0],
        unit: "m/s",
        observable: "e_t",
        impacts: 40,
    }];
    let mut other = finding("unknown:day");
    (other.certainty, other.lack_of_fit) = (0.41, Some(1e-5));
    diagnosis.findings = vec![found, other];
    diagnosis.gains = vec![gain(0.013, 0.0102, [0.7, 0.9])];
    diagnosis.gain = diagnosis.gains.first().cloned();
    diagnosis.groups = Some(GroupsFound {
        column: "burst".into(),
        count: 6,
        declared: false,
        scatter: [0.0, 0.02],
        share: [0.0, 0.45],
    });
    let text = text(&diagnosis, EXTENDED);
    shows(
        &text,
        &[
            "sliding-to-rolling e_t tangential-compliance, curve over day 5.2 4.8e6 86 %",
            "With it chi-square falls by 40.5. That is 5.2 sigma: it happens by chance once in 4.8e6 data sets",
            "named in 86 % of resampled data sets. These data do not exclude tangential-compliance or curve over day.",
            "named in only 41 % of resampled data sets: take it as a hint",
            "The shape of this law fits",
            "The shape of this law does not fit: a free curve over its inputs fits better, which happens by chance \
                once in 100000",
            "Only the product of friction and strength is known.",
            "gas-lift +4.0 0.02",
            "measure e_t at v_t = 0.2 m/s and at v_t = 9 m/s",
            "The 6 values of burst were noticed as groups",
            "e_t 0.02 45 %",
            "e_t: the error falls from 0.013 to 0.0102. The noise floor is 0.01: what is left is noise.",
            "Each row was predicted by a model file that was chosen",
            "12 rows. Bars are the stated standard errors. The closer to the line, the better the prediction. The \
                extended model was fitted to these rows",
            "lie 33 % and 67 % for the base model, 100 % and 100 % for the extended model",
        ],
    );
}

#[test]
fn the_score_is_named_only_where_the_mean_does_not_gain() {
    let mut diagnosis = diagnosis(sample(&[[1.0, 0.5]; 8], None), Fit::default());
    diagnosis.findings = vec![finding("agglomerates")];
    let mut sentence = |gain: Gain| {
        diagnosis.gains = vec![gain];
        text(&diagnosis, EXTENDED)
    };
    let falls = sentence(gain(0.04, 0.02, [0.4, 0.6]));
    assert!(!falls.contains("log score"), "{falls}");
    shows(&falls, &["The noise floor is 0.01; the other 75 % of the mean square error are the model's"]);
    let same = sentence(gain(0.04, 0.0399, [0.9, 1.1]));
    shows(
        &same,
        &["its mean is not predicted better", "1.000 before and 1.500 after", "1.649 times as likely"],
    );
    let worse = Gain { log_score_after: 0.9, ..gain(0.04, 0.041, [0.9, 1.1]) };
    shows(&sentence(worse), &["neither its mean"]);
    shows(&sentence(gain(0.04, 0.08, [1.5, 2.5])), &["The extended model predicts it worse."]);
}

#[test]
fn slips_of_input_stand_above_the_causes() {
    let mut diagnosis = diagnosis(sample(&[[1.0, 0.5]; 8], None), Fit::default());
    diagnosis.findings = vec![finding("yield-ratio")];
    diagnosis.rivals = vec![Rival {
        id: "slip:diameter-is-radius".into(),
        observable: "e_t",
        gain: 30.0,
        lead: 9.75,
        probability: 0.9,
        explanation: "these numbers fit if d were twice as large: is the radius given?".into(),
    }];
    let text = text(&diagnosis, EXTENDED);
    shows(
        &text,
        &[
            "Input: These numbers fit if d were twice as large: is the radius given? With it chi-square of e_t falls \
                by 60, 20 more than with the best cause; its probability is 0.90.",
        ],
    );
    assert!(text.find("Before physics is blamed").unwrap() < text.find("Cause 1").unwrap());
}

#[test]
fn an_extended_model_with_inputs_says_where_they_come_from() {
    let mut diagnosis = diagnosis(sample(&[[1.0, 0.5]; 8], None), Fit::default());
    diagnosis.findings = vec![finding("fitted-curve")];
    let extended = "[inputs.humidity]\ndefault = 0.4\n";
    let text = text(&diagnosis, extended);
    shows(&text, &["depends on humidity, which the library does not know", "extraInputs", "humidity 0.4;"]);
    assert!(!text.contains("cannot carry"), "{text}");
}

/// 20 rows of which none is captured, as expected, and 20 of which all are.
#[test]
fn means_of_captures_have_the_errors_that_the_model_expects() {
    let row = |i: u32| {
        let x = f64::from(i % 2);
        let values = [None, None, Some([x, 0.01, if x < 0.5 { 0.01 } else { 0.97 }])];
        SampleRow { held_out: false, cells: vec![x], errors: [None; 2], values }
    };
    let sample = Sample {
        columns: vec![("T_p".into(), "K".into())],
        words: vec![None],
        rows: (0..40).map(row).collect(),
        ..Sample::default()
    };
    let mut diagnosis = diagnosis(sample, Fit::default());
    diagnosis.findings = vec![Finding {
        observable: "outcome",
        variables: vec!["T_p".into()],
        ..finding("melting-transition")
    }];
    let text = text(&diagnosis, EXTENDED);
    shows(&text, &["from zero: of the base model 1 of 2, of the extended model 0 of 2; by chance 1 in 20."]);
}
