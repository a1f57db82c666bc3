//! The record of a diagnosis of a rig, and its verdict.

use serde::Serialize;

use super::super::chi_square;
use super::super::closed_form::ClosedForm;
use super::super::constant_capture::CaptureConstant;
use super::super::constants::REFUTED;
use super::super::finding::{equation, group_words, sigma};
use super::super::form_finding;
use super::super::goodness_of_fit::MOST_LISTED;
use super::super::part::{Part, rounded};
use super::super::record::{
    Calibration, CauseCurve, CauseForm, Diagnosis, Finding, Fit, FitTest, FormPoint, Gain, LargeMisfit,
    NotExamined, Options, Rows,
};
use super::super::sentences::{Words, fit_sentence, found, nothing_found, probability_words, worse_sentence};
use super::super::verdict::not_examined;
use super::addition::{Kind, RigAddition};
use super::blame::{self, Blame, Parties};
use super::choice::{Named, RigChoice};
use super::form::RigForm;
use super::gain::{HeldOutExperiments, predict_file};
use super::inputs::Over;
use super::next::{NextExperiment, table};
use super::noise::{FittedScatter, Noise};
use super::prediction_table::predict;
use super::study::RigStudy;
use crate::dataset::RigMeasurements;
use crate::rig::{CaseNumber, PredictedReading, PredictionError, SettingError};
use nearwall::effect::{EFFECTS, FittedCurve};
use nearwall::model::Model;

/// With fewer experiments the verdict warns that effects may go undetected.
const FEW_EXPERIMENTS: usize = 6;

/// A diagnosis of a rig: `diagnosis.json`.
#[derive(Debug, Clone, Serialize)]
pub struct RigDiagnosis {
    /// As for impacts; rows are those of the file, held-out ones are experiments.
    #[serde(flatten)]
    pub diagnosis: Diagnosis,
    /// Every reading beside both models.
    pub readings: Vec<RigRow>,
    /// Errors by kind of observable, on the readings that were fitted.
    pub errors: Vec<KindErrors>,
    /// Whose fault the misfit is.
    pub parties: Parties,
    /// What they carry of it, the largest share first.
    pub blame: Vec<Blame>,
    /// Experiments worth making, the most telling first.
    pub next: Vec<NextExperiment>,
    /// The same as a table to be filled in.
    #[serde(skip)]
    pub next_table: String,
    /// What was assumed about the data.
    pub notes: Vec<String>,
    /// Text of the extended model.
    #[serde(skip)]
    pub extended: String,
    /// Text of the case with the numbers that were found wrong and the extended model; `None` without any.
    #[serde(skip)]
    pub extended_case: Option<String>,
    /// Texts of model files with parameters drawn from the fit.
    #[serde(skip)]
    pub draws: Vec<String>,
}

/// A reading beside both models.
#[derive(Debug, Clone, Serialize)]
pub struct RigRow {
    /// The experiment.
    pub experiment: String,
    /// Line in the file.
    pub line: u64,
    /// The column, as in `captured@target`.
    pub observable: String,
    /// Settings of the experiment.
    pub settings: Vec<(String, String)>,
    /// Measured value [1].
    pub measured: f64,
    /// Its standard error under the extended model [1], a fitted one where none is stated.
    pub error: f64,
    /// Predicted by the base model [1]; `None` where nothing of the kind happens.
    pub base: Option<f64>,
    /// Predicted by the extended model [1].
    pub extended: Option<f64>,
    /// Predicted by a model that has not seen the experiment [1].
    pub held_out: Option<f64>,
}

/// Root mean square errors of a kind of readings [1].
#[derive(Debug, Clone, Serialize)]
pub struct KindErrors {
    /// The kind.
    pub observable: &'static str,
    /// Number of readings.
    pub readings: usize,
    /// Of the base model.
    pub rmse_base: f64,
    /// Of the extended model.
    pub rmse_extended: f64,
}

/// What a diagnosis found.
pub(super) struct RigFindings<'a> {
    pub study: &'a RigStudy<'a>,
    pub choice: RigChoice,
    /// Causes that predict experiments that they have not seen worse.
    pub refuted: Vec<String>,
    pub held_out: Option<HeldOutExperiments>,
    pub text: String,
    pub extended_case: Option<String>,
    pub draws: Vec<String>,
    pub next: Vec<NextExperiment>,
}

impl RigFindings<'_> {
    /// The record.
    ///
    /// # Errors
    /// Why an impact cannot be decided.
    pub fn record(self, file: &RigMeasurements, options: &Options) -> Result<RigDiagnosis, PredictionError> {
        let Self { study, choice, .. } = &self;
        let base = &study.table.base;
        let model = Model::from_toml("extended.toml", &self.text).map_err(SettingError::from)?;
        let extended = predict_file(study, &model, &choice.additions())?;
        let mut diagnosis = self.diagnosis(file, options, &extended)?;
        let counts = [study.data.experiments, study.data.readings.len()];
        let (parties, blame) = (Parties::of(choice), blame::blame(study, choice)?);
        let beside = if study.forward.case_numbers().is_empty() { "" } else { " of readings and case" };
        diagnosis.verdict = verdict(&diagnosis, counts, beside, (&parties, &blame));
        if study.forward.most_causes() == 1 && !diagnosis.findings.is_empty() {
            diagnosis.verdict += " A replay names one cause at a time: run the cases again with extended.toml, and \
                diagnose their new record for more.";
        }
        diagnosis.verdict += &self.gross_error_sentences(&extended);
        let scatter = study.data.scatter(&extended, &vec![1.0; study.data.experiments]);
        Ok(RigDiagnosis {
            diagnosis,
            readings: self.rows(base, &extended, &scatter),
            errors: self.errors(base, &extended),
            parties,
            blame,
            next_table: table(&self.next),
            notes: [file.notes.clone(), study.data.scatter_notes(&scatter)].concat(),
            next: self.next,
            extended: self.text,
            extended_case: self.extended_case,
            draws: self.draws,
        })
    }

    /// The record without its verdict; `extended` are the predictions of the written model.
    fn diagnosis(
        &self,
        file: &RigMeasurements,
        options: &Options,
        extended: &[PredictedReading],
    ) -> Result<Diagnosis, PredictionError> {
        let Self { study, choice, held_out, .. } = self;
        let base = &study.table.base;
        let parameters = choice.named.iter().map(|one| one.addition.axes.len()).sum();
        let all: Vec<usize> = (0..study.data.readings.len()).collect();
        let regular = study.data.regular(extended, &vec![1.0; study.data.experiments]);
        let fit = Fit {
            base: self.fit_test(base, &all, 0, choice.structure[0]),
            extended: self.fit_test(extended, &regular, parameters, choice.structure[1]),
            largest: self.largest(base),
        };
        let (findings, calibration) = self.found()?;
        let gains: Vec<_> = held_out.iter().flat_map(|held_out| held_out.gains(study)).collect();
        let first = findings.first().map_or("", |finding| finding.observable);
        let gain = gains.iter().find(|gain| gain.observable == first).or(gains.first()).cloned();
        let nothing = choice.named.is_empty() && self.refuted.is_empty();
        let held_out = gain.as_ref().map_or(0, |gain| gain.held_out_rows);
        Ok(Diagnosis {
            schema: "nearwall.diagnosis/2",
            seed: options.seed,
            level: options.level,
            rows: rows(file, held_out),
            fit,
            findings,
            explanations: choice.explanations.record(),
            undecided: if nothing { choice.explanations.undecided() } else { Vec::new() },
            refuted: self.refuted.clone(),
            calibration,
            not_examined: self.left_out(),
            gain,
            gains,
            extended_model: "extended.toml",
            ..Diagnosis::default()
        })
    }

    /// Why effects and numbers of the case were no candidates.
    fn left_out(&self) -> Vec<NotExamined> {
        let Self { study, .. } = self;
        let range = |input: &str| study.inputs.range(input);
        let mut all = not_examined(study.forward.base(0), range, "over the impacts");
        if study.forward.case_numbers().is_empty() {
            all.push(NotExamined { cause: "case", reason: NO_CASE.to_owned() });
        }
        let capture = study.forward.base(0).capture();
        if capture.criterion.is_some() && capture.numbers().is_empty() {
            all.push(NotExamined { cause: CAPTURE, reason: NO_NUMBER.to_owned() });
        }
        all
    }

    /// The causes and the changed numbers of the base model.
    fn found(&self) -> Result<(Vec<Finding>, Vec<Calibration>), PredictionError> {
        let (mut findings, mut calibration) = (Vec::new(), Vec::new());
        for named in &self.choice.named {
            match self.calibration(named) {
                Some(one) => calibration.push(one),
                None => findings.push(self.finding(named)?),
            }
        }
        Ok((findings, calibration))
    }

    /// How well predictions fit these readings with so many parameters fitted.
    fn fit_test(
        &self,
        predicted: &[PredictedReading],
        readings: &[usize],
        parameters: usize,
        structure: f64,
    ) -> FitTest {
        let all = readings.len();
        let (chi_square, readings) = self.study.data.chi_square(predicted, readings);
        if readings < all || readings <= parameters {
            return FitTest { against: "structure", p_value: Some(structure), ..FitTest::default() };
        }
        let freedom = readings - parameters;
        FitTest {
            against: "stated errors",
            chi_square: Some(chi_square),
            degrees_of_freedom: Some(freedom),
            p_value: Some(chi_square::p_value(chi_square, freedom as f64)),
        }
    }

    /// The readings farthest from the base model, of those with a known error.
    fn largest(&self, base: &[PredictedReading]) -> Vec<LargeMisfit> {
        let data = &self.study.data;
        let mut all: Vec<LargeMisfit> = Vec::new();
        for (index, datum) in data.readings.iter().enumerate() {
            if matches!(datum.noise, Noise::Shared { .. }) || !base[index].value.is_finite() {
                continue;
            }
            let reading = &self.study.forward.experiments()[datum.experiment].readings[datum.place];
            let error = data.variance(index, &base[index], &FittedScatter::default()).sqrt();
            all.push(LargeMisfit {
                line: reading.line,
                observable: data.kinds[datum.kind],
                measured: datum.value,
                predicted: base[index].value,
                standard_errors: (datum.value - base[index].value) / error,
            });
        }
        all.sort_by(|a, b| b.standard_errors.abs().total_cmp(&a.standard_errors.abs()));
        all.truncate(MOST_LISTED);
        all
    }

    /// A sentence on each reading that counts as a gross error about predictions.
    fn gross_error_sentences(&self, predicted: &[PredictedReading]) -> String {
        let Self { study, .. } = self;
        let data = &study.data;
        let note = |(index, gross): (usize, f64)| {
            let datum = &data.readings[index];
            let line = study.forward.experiments()[datum.experiment].readings[datum.place].line;
            format!(
                " Line {line} counts as a gross error (probability {gross:.2}): {} is {} where {:.3} is predicted; check it.",
                data.kinds[datum.kind], datum.value, predicted[index].value
            )
        };
        data.gross_errors(predicted, &vec![1.0; data.experiments]).into_iter().map(note).collect()
    }

    fn calibration(&self, Named { addition, p_value, .. }: &Named) -> Option<Calibration> {
        let Kind::Part(Part::LawParameter(parameter)) = addition.kind else { return None };
        let [low, high] = addition.intervals.first()?.map(rounded);
        Some(Calibration {
            key: addition.name(),
            from: parameter.of(self.study.forward.base(0))?,
            value: rounded(*addition.values().first()?),
            low,
            high,
            p_value: *p_value,
            q_value: *p_value,
        })
    }

    fn finding(&self, named: &Named) -> Result<Finding, PredictionError> {
        let Named { addition, gain, p_value, line } = named;
        let (gain, p_value) = (*gain, *p_value);
        let explanations = &self.choice.explanations;
        let observable = self.observable(addition)?;
        let cause = addition.name();
        let mut finding = Finding {
            observable,
            variables: addition.variables(),
            gain,
            chi_square: 2.0 * (gain + addition.axes.len() as f64),
            sigma: sigma(p_value),
            probability: explanations.probability(&cause),
            certainty: explanations.certainty(&cause),
            lack_of_fit: None,
            not_separable: addition.over().map(together).into_iter().flatten().collect(),
            p_value,
            q_value: p_value,
            parameters: addition.estimates().into_iter().collect(),
            alternatives: explanations.alternatives(&cause),
            indistinguishable_from: explanations.in_stead_of(&cause),
            measure_next: Vec::new(),
            curve: addition.fitted_curve().map(cause_curve),
            forms: form(addition, line).into_iter().collect(),
            surface: None,
            explanation: String::new(),
            cause,
        };
        finding.explanation = explain(&finding);
        if let Some((_, number, _)) = addition.case_number() {
            finding.explanation = wrong_number(&finding, number);
        }
        Ok(finding)
    }

    /// The kind of observable that an addition changes most, in standard errors.
    fn observable(&self, addition: &RigAddition) -> Result<&'static str, PredictionError> {
        let (study, data) = (self.study, &self.study.data);
        let all = &self.choice.additions();
        let rest: Vec<RigAddition> = all.iter().filter(|one| one.key() != addition.key()).cloned().collect();
        let [with, without] = [predict(study.forward, all)?, predict(study.forward, &rest)?];
        let scatter = data.scatter(&with, &vec![1.0; data.experiments]);
        let mut changes = vec![0.0; data.kinds.len()];
        for (index, datum) in data.readings.iter().enumerate() {
            let change = (with[index].value - without[index].value).powi(2);
            if change.is_finite() {
                changes[datum.kind] += change / data.variance(index, &with[index], &scatter);
            }
        }
        let most = (0..changes.len()).max_by(|&a, &b| changes[a].total_cmp(&changes[b]));
        Ok(most.map_or("captured", |kind| data.kinds[kind]))
    }

    fn rows(
        &self,
        base: &[PredictedReading],
        extended: &[PredictedReading],
        scatter: &FittedScatter,
    ) -> Vec<RigRow> {
        let finite = |one: &PredictedReading| one.value.is_finite().then_some(one.value);
        let row = |(index, datum): (usize, &super::noise::Datum)| {
            let experiment = &self.study.forward.experiments()[datum.experiment];
            let reading = &experiment.readings[datum.place];
            RigRow {
                experiment: experiment.name.clone(),
                line: reading.line,
                observable: reading.column.clone(),
                settings: experiment.settings.clone(),
                measured: datum.value,
                error: self.study.data.variance(index, &extended[index], scatter).sqrt(),
                base: finite(&base[index]),
                extended: finite(&extended[index]),
                held_out: self.held_out.as_ref().and_then(|held_out| finite(&held_out.predicted[index][1])),
            }
        };
        self.study.data.readings.iter().enumerate().map(row).collect()
    }

    fn errors(&self, base: &[PredictedReading], extended: &[PredictedReading]) -> Vec<KindErrors> {
        let data = &self.study.data;
        let of = |(kind, name): (usize, &&'static str)| {
            let own = data.readings.iter().enumerate().filter(|(_, datum)| datum.kind == kind);
            let squares = |predicted: &[PredictedReading]| {
                let all: Vec<f64> =
                    own.clone().map(|(i, datum)| (datum.value - predicted[i].value).powi(2)).collect();
                let finite: Vec<f64> = all.into_iter().filter(|square| square.is_finite()).collect();
                (finite.iter().sum::<f64>() / finite.len().max(1) as f64).sqrt()
            };
            KindErrors {
                observable: name,
                readings: own.clone().count(),
                rmse_base: squares(base),
                rmse_extended: squares(extended),
            }
        };
        data.kinds.iter().enumerate().map(of).collect()
    }
}

fn rows(file: &RigMeasurements, held_out: usize) -> Rows {
    let used = file.read - file.rejected.len();
    Rows { read: file.read, used, held_out, rejected: file.rejected.clone(), ..Rows::default() }
}

fn cause_curve(curve: FittedCurve) -> CauseCurve {
    let knots = curve.axes.iter().flat_map(|axis| &axis.knots);
    CauseCurve {
        factor: curve.on != nearwall::effect::CurveTarget::Capture,
        at: knots.map(|knot| rounded(*knot).to_string()).collect(),
        adds: curve.values.iter().map(|value| rounded(*value)).collect(),
    }
}

/// A wrong number of the case in a few sentences.
fn wrong_number(finding: &Finding, number: &CaseNumber) -> String {
    let CaseNumber { key, value: from, error, unit, instrument, .. } = number;
    let found =
        finding.parameters.get("value").map(|one| format!("{} ({} to {})", one.value, one.low, one.high));
    let others = match finding.indistinguishable_from.as_slice() {
        [] => String::new(),
        others => format!(" These experiments do not exclude {}.", others.join(" or ")),
    };
    if let Some(force) = number.missing_force() {
        return format!(
            "The wall law is not needed for this: the case leaves out {force}, with which the readings fit. What tells \
                it: {instrument}.{others}"
        );
    }
    format!(
        "The wall law is not needed for this: the readings fit {key} = {} {unit} instead of {from}, which has an \
            error of {}. Where experiments set it, theirs is off in the same way. What tells it: {instrument}.{others}",
        found.unwrap_or_default(),
        rounded(*error)
    )
}

/// What is said of a closed form.
fn form(addition: &RigAddition, line: &[FormPoint]) -> Option<CauseForm> {
    let form = addition.as_form()?;
    let RigForm { over, tried, .. } = form;
    let closed = ClosedForm { line: line.to_vec(), ..addition.closed_form()? };
    let column = (over.name.as_str(), over.unit, Some(over.seen));
    Some(form_finding::record(&closed, form.observable(), column, tried))
}

/// Which inputs and groups cannot be told from that of a curve, as a sentence.
fn together(over: &Over) -> Option<String> {
    let [one, others] = ["changes", "change"].map(|verb| format!("{verb} together with {}", over.name));
    let (who, change) = match over.also.split_last()? {
        (last, []) => (last.clone(), one),
        (last, rest) => (format!("{} and {last}", rest.join(", ")), others),
    };
    Some(format!("In these experiments {who} {change}: a curve over one is a curve over the others."))
}

/// A finding in a few sentences.
fn explain(finding: &Finding) -> String {
    let known = EFFECTS.iter().find(|effect| effect.id == finding.cause);
    let what = match (known, finding.cause.split_once(':')) {
        (Some(effect), _) => format!("{}: {}.", effect.id, effect.about),
        (None, Some(("unknown", input))) => {
            let what = group_words(input).map_or_else(|| input.to_owned(), |group| format!("the {group}"));
            let forms: String = finding.forms.iter().map(equation).collect();
            format!(
                "What the rig shows depends on {what} in a way that no effect of the library explains.{forms}"
            )
        }
        (None, Some(("level", what))) => format!(
            "All impacts differ by the same amount in {what}; no input explains where, and nothing tells a law from a \
                constant."
        ),
        (None, None) if finding.cause == CaptureConstant::Ceiling.name() => {
            "Only a share of what the wall law captures is: the others bounce, and no input shows why."
                .to_owned()
        }
        _ => finding.cause.clone(),
    };
    let others = match finding.indistinguishable_from.as_slice() {
        [] => String::new(),
        others => format!(" These experiments do not exclude {}.", others.join(" or ")),
    };
    format!(
        "{what} It acts most on {}; chi-square falls by {:.1}. By chance any of the candidates gains as much at most \
            once in {:.0}.{others}",
        finding.observable,
        finding.chi_square,
        1.0 / finding.q_value.max(1e-9)
    )
}

/// The table of a model file with the criterion of capture, and why its numbers were no candidates.
const CAPTURE: &str = "capture";
const NO_NUMBER: &str = "its criterion uses numbers of the material, which are taken as they are: captures may be \
                         wrong by them, too";

/// Why no number of the case was a candidate.
const NO_CASE: &str =
    "recorded flights, and walls with a deposit, are not followed anew with another number of the case";

/// The words for a rig.
const RIG: Words = Words {
    subject: "wall law",
    data: "experiments",
    unseen: "experiments",
    carries: "No wall law of the library carries the misfit: the errors are larger than stated, or the cause is not \
        at the wall; check the gas, the particles' size and speed, and what counts as captured.",
};

/// The words where nothing is named.
const NOTHING: Words = Words { subject: "simulation", ..RIG };

/// How the id of a force begins that the case leaves out.
const LEFT_OUT: &str = "case:without-";

/// What the wall law lacks and which numbers of the case are wrong, or what `nothing` says. The case alone is at
/// fault with the probability `alone`.
fn law_and_case(diagnosis: &Diagnosis, alone: f64, nothing: impl FnOnce() -> String) -> String {
    let (case, law): (Vec<Finding>, Vec<Finding>) =
        diagnosis.findings.iter().cloned().partition(|finding| finding.cause.starts_with("case:"));
    let numbers: Vec<String> = case
        .iter()
        .map(|finding| {
            let words = probability_words(finding.probability);
            format!("{} ({words})", &finding.cause["case:".len()..])
        })
        .collect();
    let is_force = |finding: &Finding| finding.cause.starts_with(LEFT_OUT);
    let wrong = match numbers.as_slice() {
        [] => return found(diagnosis, &RIG, nothing),
        all if case.iter().all(is_force) => {
            let words: Vec<String> = all.iter().map(|one| one.replacen('-', " ", 1)).collect();
            format!("it is {}.", words.join(" and "))
        }
        [one] => format!("{one} is wrong by more than its error."),
        several => format!("{} are wrong by more than their errors.", several.join(" and ")),
    };
    if law.is_empty() && diagnosis.calibration.is_empty() {
        let criterion = diagnosis.not_examined.iter().any(|one| one.cause == CAPTURE);
        let unless = if criterion { "; what the material gives to [capture] is not examined" } else { "" };
        return format!("The case is at fault, not the wall ({}{unless}): {wrong}", probability_words(alone));
    }
    let law = Diagnosis { findings: law, ..diagnosis.clone() };
    format!("The case is at fault: {wrong} {}", found(&law, &RIG, String::new))
}

/// The verdict: the result in a few sentences.
fn verdict(
    diagnosis: &Diagnosis,
    [experiments, readings]: [usize; 2],
    beside: &str,
    (parties, blame): (&Parties, &[Blame]),
) -> String {
    let seen = format!("{experiments} experiments with {readings} readings");
    let nothing = || nothing_found(diagnosis, &NOTHING, &seen);
    let mut text = fit_sentence(diagnosis, beside) + &law_and_case(diagnosis, parties.case, nothing);
    let numbers = diagnosis.calibration.iter().map(|number| number.key.as_str());
    let named: Vec<&str> =
        diagnosis.findings.iter().map(|finding| finding.cause.as_str()).chain(numbers).collect();
    text += &blame::sentences(parties, blame, &named);
    let left = &diagnosis.fit.extended;
    let extends = !(diagnosis.findings.is_empty() && diagnosis.calibration.is_empty());
    if let (Some(chi_square), Some(freedom), Some(p)) =
        (left.chi_square, left.degrees_of_freedom, left.p_value)
        && extends
        && p < REFUTED
    {
        text += &format!(
            " A misfit is left (chi-square {chi_square:.1} for {freedom}): errors larger than stated, or a cause that \
                is not among the candidates."
        );
    }
    if let Some(gain) = &diagnosis.gain {
        let held_out = format!("held-out experiments ({}, cross-validated)", gain.held_out_rows);
        text += &if diagnosis.refuted.is_empty() {
            let falls = if gain.ci95[1] < 1.0 { "falls" } else { "goes, not significantly," };
            let Gain { observable, rmse_before, rmse_after, .. } = gain;
            format!(
                " On {held_out} the root mean square error in {observable} {falls} from {rmse_before:.3} to \
                 {rmse_after:.3}."
            )
        } else {
            worse_sentence(gain, &held_out)
        };
    }
    if experiments < FEW_EXPERIMENTS {
        text += &format!(" With only {experiments} experiments, an effect of usual size may go undetected.");
    }
    text
}
