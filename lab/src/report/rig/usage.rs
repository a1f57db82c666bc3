//! What these data cannot show, and how to run the extended model.

use super::super::diagnosis::fit::extends;
use super::super::diagnosis::quoted;
use super::super::diagnosis::usage::{extra_inputs, not_examined_table, openfoam};
use super::super::page::Page;
use super::{RigPage, RigSource};
use crate::diagnose::Diagnosis;
use crate::diagnose::rig::RigDiagnosis;

pub(super) fn add_not_examined(page: &mut Page, diagnosis: &Diagnosis) {
    if !diagnosis.not_examined.is_empty() {
        page.heading("What these experiments cannot show");
        page.table(not_examined_table(diagnosis));
    }
}

pub(super) fn add_commands(page: &mut Page, found: &RigDiagnosis, from: &RigPage<'_>) {
    let file = found.diagnosis.extended_model;
    page.heading("How to run the extended model");
    page.text(if extends(&found.diagnosis) {
        format!("{file} is next to this page. It is the base model with the findings added:")
    } else {
        format!("{file} is next to this page. Nothing was added, so it equals the base model:")
    });
    page.code(found.extended.trim_end());
    if let RigSource::Case { file: case, .. } = from.source {
        page.text(
            "To simulate the rig with it, name it in the case instead of the base model and run the case:",
        );
        let case = quoted(case);
        page.code(format!(
            "model = \"{file}\"              # in the case file; the path is relative to it\n\n\
             nearwall check {file}\nnearwall simulate {case} -o extended"
        ));
    }
    if found.extended_case.is_some() {
        page.text(
            "extended_case.toml is next to this page, too: the case with its wrong numbers corrected. A number that \
             the data file sets for each experiment is wrong likewise in each: correct that of a new one as well.",
        );
    }
    page.text(format!(
        "In OpenFOAM: copy {file} to constant/nearWall.toml of the case and add these lines (every shell that runs a \
            solver needs openfoam/environment):"
    ));
    page.code(openfoam(&extra_inputs(&found.extended)));
    if !found.draws.is_empty() {
        page.text(format!(
            "draws/ has {} model files whose parameters are drawn together from the fit. Run each; the range of the \
                results is the uncertainty of the prediction (over 39 draws, a 95 % band).",
            found.draws.len()
        ));
    }
}
