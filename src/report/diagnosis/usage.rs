//! What to do with a diagnosis: what to measure next, and how to run the extended model.

use super::super::page::{Page, Table};
use super::{cause_title, strings, with_unit};
use crate::diagnose::{Diagnosis, Measure, NotExamined};
use crate::effect::EFFECTS;

/// The five lines that put a model file into an OpenFOAM case.
const OPENFOAM: &str = "libs (\"libnearWallInteraction.so\");              // system/controlDict

patchInteractionModel nearWallInteraction;       // constant/<cloud>Properties, subModels
nearWallInteractionCoeffs
{
    model \"<constant>/nearWall.toml\";
}";

/// A measurement in a sentence.
pub(super) fn sentence(measure: &Measure, cause: &str) -> String {
    let [from, to] = measure.range;
    let watch = match measure.observable {
        "outcome" => "what is captured",
        other => other,
    };
    format!(
        "To tell {} from {}: vary {} from {} to {}, everything else as it was, and watch {watch}. About {} impacts, half of \
         them at each end, will do.",
        cause_title(cause),
        cause_title(&measure.against),
        measure.vary,
        with_unit(from, measure.unit),
        with_unit(to, measure.unit),
        measure.impacts
    )
}

pub(super) fn add_next(page: &mut Page, diagnosis: &Diagnosis) {
    page.heading("What to measure next");
    let mut asked = false;
    for finding in &diagnosis.findings {
        for measure in &finding.measure_next {
            page.text(sentence(measure, &finding.cause));
            asked = true;
        }
        if let Some(column) = finding.cause.strip_prefix("unknown:") {
            page.text(format!(
                "Something that goes with {column} acts on {}. Hold everything else and vary {column} alone, or write down \
                 what changes along with it (temperature, humidity, cleaning, supplier) as columns of their own: the next \
                 diagnosis will look at them.",
                finding.observable
            ));
            asked = true;
        }
    }
    if !diagnosis.not_examined.is_empty() {
        page.table(Table {
            caption: "Effects of the library that these data cannot speak of.".into(),
            header: strings(["effect", "what it does", "why not examined", "to examine it"]),
            rows: diagnosis.not_examined.iter().map(not_examined).collect(),
            text_columns: 4,
        });
    } else if !asked {
        page.text(
            "Every effect of the library was examined, and no two causes were left that these data cannot tell apart. \
             Further rows sharpen the intervals: four times as many halve them.");
    }
}

fn not_examined(one: &NotExamined) -> Vec<String> {
    let about = EFFECTS.iter().find(|kind| kind.id == one.cause).map_or("", |kind| kind.about);
    let advice = one
        .reason
        .strip_suffix(" does not vary in the data")
        .map_or("–".to_owned(), |inputs| format!("vary and record {inputs}"));
    vec![one.cause.to_owned(), about.to_owned(), one.reason.clone(), advice]
}

pub(super) fn add_commands(page: &mut Page, diagnosis: &Diagnosis, extended: &str) {
    page.heading("How to run the extended model");
    let file = diagnosis.extended_model;
    page.text(if diagnosis.findings.is_empty() && diagnosis.calibration.is_empty() {
        format!("{file} lies beside this page. Nothing was found, so it is the base model as it was:")
    } else {
        format!("{file} lies beside this page; it is the base model's file with what was found:")
    });
    page.code(extended.trim_end());
    let not_carried = not_carried(diagnosis);
    if !not_carried.is_empty() {
        page.text(format!("What the model file cannot carry: {}.", not_carried.join("; ")));
    }
    page.text("Forecasts of any impacts, and what each term does to one of them:");
    page.code(format!(
        "nearwall check {file}\nnearwall predict --model {file} impacts.csv -o predicted.csv\n\
         nearwall predict --model {file} impacts.csv --explain 2"
    ));
    page.text(format!(
        "In OpenFOAM: copy {file} to constant/nearWall.toml of the case and give it these five lines (every shell that runs a \
         solver needs openfoam/environment):"
    ));
    page.code(OPENFOAM);
}

fn not_carried(diagnosis: &Diagnosis) -> Vec<String> {
    let curves = diagnosis.findings.iter().filter(|finding| finding.curve.is_some());
    let mut all: Vec<String> = curves
        .map(|finding| {
            format!(
                "the {} that acts on {} (diagnosis.json has it)",
                cause_title(&finding.cause),
                finding.observable
            )
        })
        .collect();
    if !diagnosis.scatter.changes_with.is_empty() {
        all.push(format!("the scatter that changes with {}", diagnosis.scatter.changes_with.join(", ")));
    }
    all
}
