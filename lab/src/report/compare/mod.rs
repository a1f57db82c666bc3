//! The result of a comparison of models: as a page and as text.

use super::chart::{Chart, Figure};
use super::format::{number, with_interval};
use super::page::{Page, Table};
use crate::diagnose::comparison::{Comparison, Difference, Interval, ModelErrors, ModelResult};

/// A measure as a reader sees it.
struct Shown {
    id: &'static str,
    title: &'static str,
    axis: &'static str,
    unit: &'static str,
    of: fn(&ModelErrors) -> Option<Interval>,
}

const MEASURES: [Shown; 5] = [
    Shown {
        id: "log-likelihood",
        title: "Mean log likelihood, higher is better",
        axis: "mean log likelihood",
        unit: "nats",
        of: |errors| errors.log_likelihood,
    },
    Shown {
        id: "rmse-e-n",
        title: "Root mean square error of e_n",
        axis: "rms error of e_n",
        unit: "1",
        of: |errors| errors.rmse_e_n,
    },
    Shown {
        id: "rmse-e-t",
        title: "Root mean square error of e_t",
        axis: "rms error of e_t",
        unit: "1",
        of: |errors| errors.rmse_e_t,
    },
    Shown {
        id: "rmse-share",
        title: "Root mean square error of the other readings",
        axis: "rms error of the other readings",
        unit: "1",
        of: |errors| errors.rmse_share,
    },
    Shown {
        id: "log-loss",
        title: "Log loss of capture",
        axis: "log loss of an impact",
        unit: "nats",
        of: |errors| errors.log_loss_stick,
    },
];

/// What every reader of the numbers has to know.
const METHOD: [&str; 3] = [
    "No parameter of a model is fitted here: rows are held out if they did not fit the model before. The scatter of \
        e_n and e_t about each model is estimated on four fifths of the groups and used for the log likelihood of the \
        others.",
    "The models are ranked by the mean log likelihood of a row, all observables together. Stated standard errors \
        weigh there; the root mean square errors count each reading once, the log loss each impact.",
    "Intervals hold 95 % of 1000 bootstrap resamples of the groups, the same for all models. A difference whose \
        interval includes 0 does not tell two models apart.",
];

/// The same of the readings of a rig.
const METHOD_OF_RIGS: [&str; 3] = [
    "No parameter of a model is fitted here. The case simulates every experiment with each model, with the same \
        particles and the same random numbers.",
    "The models are ranked by the mean log likelihood of a reading, as nearwall diagnose --case computes it: errors \
        of counts, stated errors, scatter between runs, and the errors of the case's own numbers.",
    "Intervals hold 95 % of 1000 bootstrap resamples of the experiments, the same for all models. A difference whose \
        interval includes 0 does not tell two models apart.",
];

/// The page of a comparison on the data file `data`.
///
/// # Errors
/// When the template cannot be filled.
pub fn page(comparison: &Comparison, data: &str, notes: &[String]) -> Result<String, askama::Error> {
    let name = data.rsplit(['/', '\\']).next().unwrap_or(data);
    let mut page = Page::new(&format!("Models compared on {name}"));
    page.verdict(vec![comparison.verdict.clone(), rows(comparison)]);
    for note in notes {
        page.note(format!("About the data file: {note}."));
    }
    page.figures(MEASURES.iter().filter_map(|measure| figure(comparison, measure)));
    page.heading("Numbers");
    for table in tables(comparison) {
        page.table(table);
    }
    page.heading("Method");
    for sentence in if is_rig(comparison) { METHOD_OF_RIGS } else { METHOD } {
        page.text(sentence);
    }
    page.foot(&format!("Made from {data} with seed {}.", comparison.seed));
    page.html()
}

/// The same as text for a terminal.
pub fn text(comparison: &Comparison) -> String {
    let mut text = format!("{}\n{}\n", comparison.verdict, rows(comparison));
    for table in tables(comparison) {
        text += &table.text();
    }
    text
}

/// Whether the models are ranked on the readings of a rig.
fn is_rig(comparison: &Comparison) -> bool {
    comparison.rows.group_by == "experiment"
}

fn rows(comparison: &Comparison) -> String {
    let rows = comparison.rows;
    if is_rig(comparison) {
        return format!("{} of {} readings rank them, of {} experiments.", rows.used, rows.read, rows.groups);
    }
    let groups = match rows.group_by {
        "series" => format!("in {} series", rows.groups),
        _ => "each a group of its own".to_owned(),
    };
    let selected = rows
        .selected
        .map_or(String::new(), |count| format!(" {count} of them, selected at random, stand for all;"));
    let (read, used) = (rows.read, rows.used);
    format!("{read} rows read;{selected} {used} can be decided by every model and rank them, {groups}.")
}

/// One table a measure, and one of the rows.
fn tables(comparison: &Comparison) -> Vec<Table> {
    let mut tables: Vec<Table> = MEASURES.iter().filter_map(|measure| table(comparison, measure)).collect();
    if is_rig(comparison) {
        return tables;
    }
    let row = |model: &ModelResult| {
        let rows = &model.rows;
        let reason = rows.first_reason.clone().unwrap_or_default();
        let counts = [rows.fitted, rows.undecided, rows.outside_range].map(|count| count.to_string());
        std::iter::once(model.model.clone()).chain(counts).chain([reason]).collect()
    };
    let header =
        ["model", "fitted it", "not decided", "outside its range", "the first row that is not decided"];
    let rows = comparison.models.iter().map(row).collect();
    tables.push(Table::new(
        "Rows of each model; those outside the range of a law are used",
        5,
        &header,
        rows,
    ));
    tables
}

/// A measure of all models, the best first; `None` where nothing was measured.
fn table<'a>(comparison: &'a Comparison, measure: &Shown) -> Option<Table> {
    let measured = |model: &'a ModelResult| Some((model, (measure.of)(&model.errors)?));
    let mut models: Vec<(&'a ModelResult, Interval)> =
        comparison.models.iter().filter_map(measured).collect();
    models.sort_by(|a, b| a.1.behind_best.value.total_cmp(&b.1.behind_best.value));
    let row = |(place, (model, interval)): (usize, &(&ModelResult, Interval))| {
        let (difference, judgement) = match place {
            0 => (String::new(), "best"),
            _ => (
                in_interval(interval.behind_best.value, interval.behind_best.ci95),
                judgement(&interval.behind_best),
            ),
        };
        let place = (place + 1).to_string();
        vec![
            place,
            model.model.clone(),
            in_interval(interval.value, interval.ci95),
            difference,
            judgement.to_owned(),
        ]
    };
    let unit = if measure.unit == "1" { String::new() } else { format!(" [{}]", measure.unit) };
    let rows: Vec<Vec<String>> = models.iter().enumerate().map(row).collect();
    let header = ["", "model", "value (95 %)", "worse than the best by (95 %)", ""];
    (!rows.is_empty()).then(|| Table::new(&format!("{}{unit}", measure.title), 5, &header, rows))
}

fn judgement(difference: &Difference) -> &'static str {
    match (difference.told_apart, difference.ci95) {
        (true, _) => "worse",
        (false, Some(_)) => "cannot be told apart",
        (false, None) => "too few groups for an interval",
    }
}

fn in_interval(value: f64, ci95: Option<[f64; 2]>) -> String {
    let Some(ends) = ci95 else { return number(value) };
    let (value, interval) = with_interval(value, ends);
    format!("{value} ({interval})")
}

/// A measure of all models with its intervals; `None` where nothing was measured.
fn figure(comparison: &Comparison, measure: &Shown) -> Option<Figure> {
    let names = short_names(&comparison.models);
    let measured = |(model, name): (&ModelResult, String)| Some((name, (measure.of)(&model.errors)?));
    let models: Vec<(String, Interval)> = comparison.models.iter().zip(names).filter_map(measured).collect();
    if models.is_empty() {
        return None;
    }
    let points: Vec<[f64; 2]> =
        models.iter().enumerate().map(|(place, (_, one))| [place as f64 + 1.0, one.value]).collect();
    let bars = models.iter().map(|(_, one)| {
        let [low, high] = one.ci95.unwrap_or([one.value; 2]);
        ((one.value - low).max(0.0), (high - one.value).max(0.0))
    });
    let words: Vec<String> = models.iter().map(|(name, _)| name.clone()).collect();
    let chart = Chart::new(
        measure.title,
        "model, in the order of the ranking",
        &format!("{} [{}]", measure.axis, measure.unit),
    );
    let chart = chart.words(&words).points_with_errors("", &points, &bars.collect());
    let caption = "With 95 % intervals. They overlap more than those of the differences in the table, which are \
        paired.";
    Some(chart.figure(measure.id, caption))
}

/// The models' file names without folder and ending, or as they are where two would be the same.
fn short_names(models: &[ModelResult]) -> Vec<String> {
    let short = |model: &ModelResult| {
        let name = model.model.rsplit(['/', '\\']).next().unwrap_or_default();
        name.strip_suffix(".toml").unwrap_or(name).to_owned()
    };
    let names: Vec<String> = models.iter().map(short).collect();
    let mut unique = names.clone();
    unique.sort_unstable();
    unique.dedup();
    let full = || models.iter().map(|model| model.model.clone()).collect();
    if unique.len() == names.len() { names } else { full() }
}
