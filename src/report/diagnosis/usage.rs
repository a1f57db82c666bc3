//! What to measure next, and how to run the extended model.

use super::super::format::with_unit;
use super::super::page::{Page, Table};
use super::cause_title;
use crate::diagnose::{Diagnosis, Measure, NotExamined};
use crate::effect::EFFECTS;

/// The lines that put a model file into an OpenFOAM case.
const OPENFOAM: &str = "libs (\"libnearWallInteraction.so\");              // system/controlDict

patchInteractionModel nearWallInteraction;       // constant/<cloud>Properties, subModels
nearWallInteractionCoeffs
{
    model \"<constant>/nearWall.toml\";
}";

/// A measurement in a sentence.
pub(super) fn sentence(measure: &Measure, cause: &str) -> String {
    let Measure { against, vary, unit, impacts, .. } = measure;
    let [from, to] = measure.range.map(|end| with_unit(end, unit));
    let observe =
        if measure.observable == "outcome" { "which impacts are captured" } else { measure.observable };
    format!(
        "To tell {} from {}: measure {observe} at {vary} = {from} and at {vary} = {to} with everything else constant. About \
         {impacts} impacts are enough, half of them at each value.",
        cause_title(cause),
        cause_title(against)
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
                "{} depends on {column} or on something that changes with it. Vary {column} alone, or record what changes with \
                 it (temperature, humidity, cleaning, supplier) as further columns: the next diagnosis will examine them.",
                finding.observable
            ));
            asked = true;
        }
    }
    if !diagnosis.not_examined.is_empty() {
        page.table(Table::new(
            "Effects of the library that these data cannot show.",
            4,
            &["effect", "what it does", "why not examined", "to examine it"],
            diagnosis.not_examined.iter().map(not_examined).collect(),
        ));
    } else if !asked {
        page.text(
            "Every effect of the library was examined, and these data can tell all of them apart. More rows make the \
             intervals narrower: four times as many halve them.",
        );
    }
}

fn not_examined(one: &NotExamined) -> Vec<String> {
    let about = EFFECTS.iter().find(|effect| effect.id == one.cause).map_or("", |effect| effect.about);
    let inputs = one.reason.strip_suffix(" does not vary in the data");
    let advice = inputs.map_or("–".to_owned(), |inputs| format!("vary and record {inputs}"));
    vec![one.cause.to_owned(), about.to_owned(), one.reason.clone(), advice]
}

pub(super) fn add_commands(page: &mut Page, diagnosis: &Diagnosis, extended: &str) {
    page.heading("How to run the extended model");
    let file = diagnosis.extended_model;
    page.text(if diagnosis.findings.is_empty() && diagnosis.calibration.is_empty() {
        format!("{file} is next to this page. Nothing was found, so it equals the base model:")
    } else {
        format!("{file} is next to this page. It is the base model with the findings added:")
    });
    page.code(extended.trim_end());
    let not_carried = not_carried(diagnosis);
    if !not_carried.is_empty() {
        page.text(format!("What the model file cannot carry: {}.", not_carried.join("; ")));
    }
    page.text("Predict any impacts, and explain what each term does to one of them:");
    page.code(format!(
        "nearwall check {file}\nnearwall predict --model {file} impacts.csv -o predicted.csv\n\
         nearwall predict --model {file} impacts.csv --explain 2"
    ));
    page.text(format!(
        "In OpenFOAM: copy {file} to constant/nearWall.toml of the case and add these lines (every shell that runs a solver \
         needs openfoam/environment):"
    ));
    page.code(OPENFOAM);
}

fn not_carried(diagnosis: &Diagnosis) -> Vec<String> {
    let curves = diagnosis.findings.iter().filter(|finding| finding.curve.is_some());
    let curve = |finding: &crate::diagnose::Finding| {
        format!(
            "the {} that acts on {} (see diagnosis.json)",
            cause_title(&finding.cause),
            finding.observable
        )
    };
    let changes = diagnosis.scatter.changes_with.join(", ");
    let scatter = (!changes.is_empty()).then(|| format!("the scatter that changes with {changes}"));
    curves.map(curve).chain(scatter).collect()
}
