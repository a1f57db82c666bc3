//! Whose fault a misfit is: the wall law's, or that of the case's numbers.

use serde::Serialize;

use super::super::chi_square;
use super::super::constants::LISTED;
use super::super::part::rounded;
use super::addition::RigAddition;
use super::choice::RigChoice;
use super::prediction_table::predict;
use super::study::RigStudy;
use crate::rig::{CaseNumber, PredictedReading, PredictionError};

/// Least fall of chi-square of which shares are told [1]: that of one parameter by chance once in a
/// hundred.
const LEAST_FALL: f64 = 6.63;
/// p-value of the readings under the base model as it is, with the case as it is, above which there is no misfit to
/// share [1].
const NO_MISFIT: f64 = 0.05;
/// Half a 95 % interval in standard deviations.
const NORMAL_95: f64 = 1.96;

/// Probabilities of the parties [1]; they sum up to 1.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Parties {
    /// The wall law lacks something and the case is right.
    pub wall_law: f64,
    /// Numbers of the case are wrong by more than their errors and the wall law is right.
    pub case: f64,
    /// Both.
    pub both: f64,
    /// Neither: the readings agree with both within the errors of readings and case.
    pub neither: f64,
}

/// What one party carries of a misfit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Blame {
    /// `wall law`, a number of the case as `case:gas.temperature`, or a force that the case leaves out as
    /// `case:without-gravity`.
    pub party: String,
    /// Share of the fall of chi-square [1].
    pub share: f64,
    /// Of a number of the case.
    #[serde(flatten)]
    pub number: Option<BlamedNumber>,
}

/// A number of the case as the readings show it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BlamedNumber {
    /// SI unit or degrees.
    pub unit: &'static str,
    /// In the case.
    pub from: f64,
    /// Its standard error.
    pub error: f64,
    /// Whether the case states that error.
    pub stated: bool,
    /// Most likely value.
    pub value: f64,
    /// Lower end of its 95 % interval.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// What tells the number once more.
    pub measure: &'static str,
}

impl Parties {
    /// Of the explanations of a choice.
    pub(super) fn of(choice: &RigChoice) -> Self {
        let mut parties = Self::default();
        for one in choice.explanations.all() {
            let is_case = |addition: &RigAddition| addition.case_number().is_some();
            let own = &one.told.additions;
            let party = match (own.iter().any(is_case), own.iter().all(is_case)) {
                (false, true) => &mut parties.neither,
                (true, true) => &mut parties.case,
                (false, false) => &mut parties.wall_law,
                (true, false) => &mut parties.both,
            };
            *party += one.probability;
        }
        parties
    }
}

/// What a number of the case carries.
#[derive(Debug, Clone, Copy, Default)]
struct Carried {
    /// Its distance from the case's value and half the 95 % interval of that, in its standard errors.
    widths: [f64; 2],
    /// Fall of chi-square [1].
    fall: f64,
}

/// What all parties carry.
struct Carriers {
    /// p-value of the base model without errors of the case [1].
    misfit: f64,
    /// Fall of chi-square by the wall law [1].
    by_law: f64,
    /// By number of the case.
    by_number: Vec<Carried>,
}

/// What the parties of the most probable explanation carry, the largest share first, as many as carry 95 %;
/// none where nothing more than chance is carried.
///
/// # Errors
/// Why an impact cannot be decided.
pub(super) fn blame(study: &RigStudy<'_>, choice: &RigChoice) -> Result<Vec<Blame>, PredictionError> {
    let numbers = study.forward.case_numbers();
    let additions = choice.explanations.best_additions();
    let Carriers { misfit, by_law, by_number } = carried(study, additions)?;
    let total = by_law + by_number.iter().map(|one| one.fall).sum::<f64>();
    if total < LEAST_FALL || additions.is_empty() && misfit > NO_MISFIT {
        return Ok(Vec::new());
    }
    let of = |(number, one): (&CaseNumber, &Carried)| Blame {
        party: format!("case:{}", number.key),
        share: one.fall / total,
        number: number.missing_force().is_none().then(|| blamed(number, one.widths)),
    };
    let law = Blame { party: "wall law".to_owned(), share: by_law / total, number: None };
    let mut all: Vec<Blame> = numbers.iter().zip(&by_number).map(of).chain([law]).collect();
    all.sort_by(|a, b| b.share.total_cmp(&a.share));
    let mut held = 0.0;
    all.retain(|one| {
        let open = held < LISTED && one.share > 0.0;
        held += one.share;
        open
    });
    Ok(all)
}

/// Additions with each number of the case where the addition and the error of its instrument put it together: both move
/// the same number, and readings with these weights by experiment tell only their sum.
///
/// # Errors
/// Why an impact cannot be decided.
pub(super) fn settled(
    study: &RigStudy<'_>,
    additions: Vec<RigAddition>,
    weights: &[f64],
) -> Result<Vec<RigAddition>, PredictionError> {
    if additions.iter().all(|one| one.case_number().is_none()) {
        return Ok(additions);
    }
    let whole = predict(study.forward, &additions)?;
    let regular = study.data.regular(&whole, weights);
    let errors = study.data.case_fit(&regular, &whole, &study.data.scatter(&whole, weights)).errors;
    let of = |addition: RigAddition| match addition.case_number() {
        Some((place, ..)) => addition.moved_on(errors[place][0], NORMAL_95 * errors[place][1]),
        None => addition,
    };
    Ok(additions.into_iter().map(of).collect())
}

/// By how much chi-square falls by the wall law of these additions, then by each number of the case.
fn carried(study: &RigStudy<'_>, additions: &[RigAddition]) -> Result<Carriers, PredictionError> {
    let (case, law): (Vec<_>, Vec<_>) =
        additions.iter().cloned().partition(|addition| addition.case_number().is_some());
    let whole = predict(study.forward, additions)?;
    let weights = vec![1.0; study.data.experiments];
    let scatter = study.data.scatter(&whole, &weights);
    let regular = study.data.regular(&whole, &weights);
    let fit = |predicted: &[PredictedReading]| study.data.case_fit(&regular, predicted, &scatter);
    let mut left = fit(&study.table.base).chi_square;
    let misfit = chi_square::p_value(left, regular.len() as f64);
    let mut fall = |predicted: &[PredictedReading]| {
        let before = left;
        left = fit(predicted).chi_square;
        (before - left).max(0.0)
    };
    let by_law = fall(&predict(study.forward, &law)?);
    let mut by_number = vec![Carried::default(); study.forward.case_numbers().len()];
    for count in 1..=case.len() {
        let own = fall(&predict(study.forward, &[&law[..], &case[..count]].concat())?);
        if let Some((place, _, widths)) = case[count - 1].case_number() {
            by_number[place] = Carried { widths: [widths, 0.0], fall: own };
        }
    }
    // What the errors of the instruments carry comes last.
    let last = fit(&whole);
    for ((one, [error, deviation]), fall) in by_number.iter_mut().zip(&last.errors).zip(&last.carried) {
        one.widths = [one.widths[0] + error, NORMAL_95 * deviation];
        one.fall += fall.max(0.0);
    }
    Ok(Carriers { misfit, by_law, by_number })
}

/// A number of the case at a distance from its value, with half the interval of that.
fn blamed(number: &CaseNumber, [widths, half]: [f64; 2]) -> BlamedNumber {
    let at = |widths: f64| rounded(number.moved(number.value, widths));
    BlamedNumber {
        unit: number.unit,
        from: number.value,
        error: rounded(number.error),
        stated: number.stated,
        value: at(widths),
        low: at(widths - half).min(at(widths + half)),
        high: at(widths - half).max(at(widths + half)),
        measure: number.instrument,
    }
}

/// Sentences on whose fault the misfit is, and what tells the parties apart; none without a misfit.
pub(super) fn sentences(parties: &Parties, blame: &[Blame], named: &[&str]) -> String {
    if blame.is_empty() {
        return String::new();
    }
    let short = |value: &f64| format!("{value:.2e}").parse::<f64>().unwrap_or(*value);
    let share = |one: &Blame| {
        let percent = 100.0 * one.share;
        match &one.number {
            None => match one.party.strip_prefix("case:") {
                Some(force) => format!("the case {} {percent:.0} %", force.replace('-', " ")),
                None => format!("the {} {percent:.0} %", one.party),
            },
            Some(BlamedNumber { unit, from, value, low, high, .. }) => {
                let key = one.party.trim_start_matches("case:");
                let [value, low, high] = [value, low, high].map(short);
                format!("{key} {percent:.0} % ({value} {unit}, {low} to {high}, instead of {from})")
            }
        }
    };
    let shares: Vec<String> = blame.iter().map(share).collect();
    let by = if named.is_empty() { " by the most probable explanation" } else { "" };
    let mut text = format!(" Shares of the misfit{by}: {}.", shares.join(", "));
    let Parties { wall_law, case, both, neither } = *parties;
    if neither > wall_law + case + both {
        text += " The numbers of the case are not known better than that: no wall law is needed.";
    } else if !named.is_empty() {
        return text + &measures(blame);
    } else {
        text += &format!(
            " It is the fault of the wall law with a probability of {wall_law:.2}, of the case with {case:.2}, of \
                both with {both:.2}."
        );
    }
    text + &measures(blame)
}

/// What to measure, that the numbers of the case be no question.
fn measures(blame: &[Blame]) -> String {
    let mut all: Vec<&str> = Vec::new();
    for number in blame.iter().filter_map(|one| one.number.as_ref()) {
        if !all.contains(&number.measure) {
            all.push(number.measure);
        }
    }
    if all.is_empty() {
        return String::new();
    }
    format!(
        " To tell the case from the wall law: {}; or the same shots on a second wall, on which a wrong case stays \
            wrong.",
        all.join("; ")
    )
}
