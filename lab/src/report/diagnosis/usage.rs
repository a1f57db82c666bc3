//! What to measure next, and how to run the extended model.

use super::super::format::{listed, with_unit};
use super::super::page::{Page, Table};
use super::plot::title;
use super::rivals::undecided_title;
use super::{cause_title, fit};
use crate::diagnose::{Diagnosis, Finding, FittedRows, NextMeasurement, NotExamined};
use nearwall::effect::EFFECTS;
use nearwall::impact::INPUTS;
use toml_edit::{DocumentMut, Item, Value};

/// A measurement in a sentence.
pub(super) fn sentence(measure: &NextMeasurement) -> String {
    let NextMeasurement { cause, against, vary, unit, impacts, .. } = measure;
    let name = |causes: &str| match causes {
        "" => "the base model as it is".to_owned(),
        causes => causes.split(" and ").map(cause_title).collect::<Vec<_>>().join(" and "),
    };
    let [from, to] = measure.range.map(|end| with_unit(end, unit));
    let observe =
        if measure.observable == "outcome" { "which impacts are captured" } else { measure.observable };
    format!(
        "To tell {} from {}: measure {observe} at {vary} = {from} and at {vary} = {to} with everything else constant. \
            About {impacts} impacts are enough, half of them at each value.",
        name(cause),
        name(against)
    )
}

pub(super) fn add_next(page: &mut Page, diagnosis: &Diagnosis) {
    page.heading("What to measure next");
    let mut asked = false;
    if !diagnosis.undecided.is_empty() {
        let title = undecided_title(&diagnosis.undecided);
        page.text(format!("See \"{title}\" at the top for what would decide it."));
        asked = true;
    }
    for measure in &diagnosis.measure_next {
        page.text(sentence(measure));
    }
    for finding in &diagnosis.findings {
        for measure in &finding.measure_next {
            page.text(sentence(measure));
            asked = true;
        }
        if finding.cause.starts_with("unknown:") {
            page.text(to_explain(finding));
            asked = true;
        }
    }
    if !diagnosis.not_examined.is_empty() {
        page.table(not_examined_table(diagnosis));
    } else if !asked && !fit::base_is_refuted(diagnosis) {
        page.text(
            "Every effect of the library was examined, and these data can tell all of them apart. More rows make the \
             intervals narrower: four times as many halve them.",
        );
    }
}

/// What to measure where no law explains a dependence.
fn to_explain(finding: &Finding) -> String {
    let columns = listed(&finding.variables, "and");
    let known = |column: &String| INPUTS.iter().any(|input| input.name == column);
    if finding.variables.iter().all(known) {
        return format!(
            "No law of the library has this dependence on {columns}. The fitted curve holds only between the measured \
                values: measure more of them where it bends, and beyond its ends where the model will be used."
        );
    }
    format!(
        "{} depends on {columns} or on something that changes with it. Vary {columns} with everything else constant, \
            or record what changes with it (temperature, humidity, cleaning, supplier) as further columns: the next \
            diagnosis will examine them.",
        title(finding.observable)
    )
}

/// Effects that were no candidates, and what would make them so.
pub(in crate::report) fn not_examined_table(diagnosis: &Diagnosis) -> Table {
    Table::new(
        "Effects of the library that these data cannot show.",
        4,
        &["effect", "what it does", "why not examined", "to examine it"],
        diagnosis.not_examined.iter().map(not_examined).collect(),
    )
}

fn not_examined(one: &NotExamined) -> Vec<String> {
    let about = EFFECTS.iter().find(|effect| effect.id == one.cause).map_or("", |effect| effect.about);
    let endings = [" does not vary in the data", " does not vary over the impacts"];
    let inputs = endings.iter().find_map(|ending| one.reason.strip_suffix(ending));
    let advice = inputs.map_or("–".to_owned(), |inputs| format!("vary and record {inputs}"));
    vec![one.cause.to_owned(), about.to_owned(), one.reason.clone(), advice]
}

pub(super) fn add_commands(page: &mut Page, diagnosis: &Diagnosis, extended: &str) {
    page.heading("How to run the extended model");
    let file = diagnosis.extended_model;
    page.text(if diagnosis.findings.is_empty() && diagnosis.calibration.is_empty() {
        format!("{file} is next to this page. Nothing was added, so it equals the base model:")
    } else {
        format!("{file} is next to this page. It is the base model with the findings added:")
    });
    page.code(FittedRows::removed_from(extended).trim_end());
    let changes = &diagnosis.scatter.changes_with;
    if !changes.is_empty() {
        page.text(format!(
            "A model file predicts means and random effects, not the error of a measurement: the scatter that changes \
                with {} is not in it.",
            listed(changes, "and")
        ));
    }
    let inputs = extra_inputs(extended);
    page.text("Predict any impacts, and explain what each term does to one of them:");
    page.code(format!(
        "nearwall check {file}\nnearwall predict --model {file} impacts.csv -o predicted.csv\n\
         nearwall predict --model {file} impacts.csv --explain 2"
    ));
    if !inputs.is_empty() {
        page.text(inputs_of_rows(&inputs));
    }
    page.text(format!(
        "In OpenFOAM: copy {file} to constant/nearWall.toml of the case and add these lines (every shell that runs a \
            solver needs openfoam/environment):"
    ));
    page.code(openfoam(&inputs));
}

/// An input that the model file declares.
pub(in crate::report) struct DeclaredInput {
    name: String,
    /// Its default as it is written in the file; empty where it has none.
    default: String,
    /// The words that it can be, as they are written; empty for a number.
    labels: Vec<String>,
}

/// The tables `[inputs.NAME]` of a model file.
pub(in crate::report) fn extra_inputs(model: &str) -> Vec<DeclaredInput> {
    let Ok(document) = model.parse::<DocumentMut>() else { return Vec::new() };
    let written = |value: &Value| value.clone().decorated("", "").to_string();
    let input = |(name, item): (&str, &Item)| {
        let labels = item.get("labels").and_then(Item::as_array);
        DeclaredInput {
            name: name.to_owned(),
            default: item.get("default").and_then(Item::as_value).map_or(String::new(), written),
            labels: labels.into_iter().flatten().map(written).collect(),
        }
    };
    let tables = document.get("inputs").and_then(Item::as_table_like);
    tables.into_iter().flat_map(|table| table.iter()).map(input).collect()
}

/// What `predict` needs beside the inputs that every model has.
fn inputs_of_rows(inputs: &[DeclaredInput]) -> String {
    let names: Vec<&str> = inputs.iter().map(|input| input.name.as_str()).collect();
    let mut text = format!(
        "The model depends on {}, which the library does not know: impacts.csv needs a column of that name for each.",
        listed(&names, "and")
    );
    if inputs.iter().any(|input| !input.default.is_empty()) {
        text += " Where a number is blank or its column absent, the default of the model file is used.";
    }
    if inputs.iter().any(|input| !input.labels.is_empty()) {
        text += " A label that the model file does not list leaves the impact unchanged.";
    }
    text
}

/// The lines that put a model file into an OpenFOAM case.
pub(in crate::report) fn openfoam(inputs: &[DeclaredInput]) -> String {
    let mut text = "libs (\"libnearWallInteraction.so\");              // system/controlDict\n\n\
                    patchInteractionModel nearWallInteraction;       // constant/<cloud>Properties, subModels\n\
                    nearWallInteractionCoeffs\n{\n    model \"<constant>/nearWall.toml\";\n"
        .to_owned();
    if !inputs.is_empty() {
        text += "    extraInputs                                  // the values of this case\n    {\n";
        for DeclaredInput { name, default, labels } in inputs {
            let value = if default.is_empty() { labels.first().map_or("0", String::as_str) } else { default };
            text += &format!("        {} {value};", keyword(name));
            if !labels.is_empty() {
                text += &format!("    // one of {}", labels.join(", "));
            }
            text.push('\n');
        }
        text += "    }\n";
    }
    text + "}"
}

/// A keyword of a dictionary, quoted where it is not a word.
fn keyword(name: &str) -> String {
    let plain = name.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_');
    if plain { name.to_owned() } else { format!("\"{name}\"") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_input_of_the_model_file_gets_its_line_in_the_case() {
        let model = "[inputs.humidity]\ndefault = 0.4 # share\n[inputs.\"p l\"]\nlabels = [\"dry\", \"old, \
            worn\"]\n[[effects]]\nkind = \"yield-ratio\"\n";
        let lines = openfoam(&extra_inputs(model));
        assert!(lines.contains("    extraInputs ") && lines.contains("        humidity 0.4;\n"), "{lines}");
        assert!(lines.contains("\"p l\" \"dry\";    // one of \"dry\", \"old, worn\"\n"), "{lines}");
        assert!(!openfoam(&extra_inputs("[particle]\nmaterial = \"x\"\n")).contains("extraInputs"));
    }
}
