//! `nearwall predict`: the model's prediction of each impact in a CSV file.

use std::fs::File;
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use nearwall::atomic_file::{AtomicFile, of_csv, refused};
use nearwall::dataset::{BadRow, DatasetError, ImpactReader, Row, WallChoice, WallError, assumed, unlikely};
use nearwall::impact::INPUTS;
use nearwall::model::ExtraInput;
use nearwall::rig::{Band, DrawnModels};
use nearwall::{ImpactRng, Model};
use rayon::prelude::*;

use crate::{CommandResult, progress};

/// Adds the model's e_n, e_t, p_stick and regime to each impact
#[derive(clap::Args)]
#[command(after_help = after_help())]
pub struct Arguments {
    /// The impacts, one per row
    impacts: PathBuf,
    /// The model file
    #[arg(long)]
    model: PathBuf,
    /// Output file; standard output by default
    #[arg(short)]
    output: Option<PathBuf>,
    /// The wall that is hit; by default the column `wall`, then the wall `default`, then the only wall
    #[arg(long)]
    wall: Option<String>,
    /// Folder of model files that `nearwall diagnose --draws` wrote: adds the 95 % bands of e_n, e_t and p_stick
    #[arg(long, value_name = "FOLDER", conflicts_with = "explain")]
    draws: Option<PathBuf>,
    /// Print the effect of each term on the impact on this line of the file, instead of the table
    #[arg(long, value_name = "LINE")]
    explain: Option<u64>,
}

fn after_help() -> String {
    let inputs: Vec<String> =
        INPUTS[1..].iter().map(|input| format!("{} [{}]", input.name, input.unit)).collect();
    format!(
        "Examples:\n  nearwall predict --model wax.toml impacts.csv -o predicted.csv\n  \
         nearwall predict --model diagnosis/extended.toml --draws diagnosis/draws impacts.csv -o predicted.csv\n\n\
         impacts.csv needs a column v_n [m/s]. Optional columns are wall and the other inputs:\n{}.\n\
         Every other column is kept. A row that cannot be used is reported on standard error and left out. The command\n\
         fails only if no row can be used.",
        inputs.join(", ")
    )
}

/// Draws of what a model draws by chance, for the mean of each row.
const DRAWS: usize = 64;

/// The columns that are added.
const ADDED: [&str; 4] = ["e_n", "e_t", "p_stick", "regime"];
/// The columns that are added with `--draws`.
const BANDS: [&str; 6] = ["e_n_low", "e_n_high", "e_t_low", "e_t_high", "p_stick_low", "p_stick_high"];

pub fn run(arguments: &Arguments) -> CommandResult {
    let model = Model::from_file(&arguments.model)?;
    let file = arguments.impacts.display().to_string();
    let source = File::open(&arguments.impacts).map_err(|error| format!("{file}: {error}"))?;
    let bar = progress::bytes(source.metadata().map_or(0, |data| data.len()), "predicting");
    let mut reader = ImpactReader::new(&file, bar.wrap_read(source))?.with_extra_inputs(model.extra_inputs());
    let (walls, column) = (WallChoice::new(&model, arguments.wall.as_deref())?, reader.column("wall"));
    walls.check(column.is_some())?;
    let wall_of = |row: &Row| walls.of(column.and_then(|column| row.cells.get(column)));
    if let Some(line) = arguments.explain {
        return explain(&model, &wall_of, &mut reader, line);
    }
    note_assumptions(&file, &reader);
    let draws =
        arguments.draws.as_deref().map(|draws| DrawnModels::from_folder(draws, &model)).transpose()?;
    let models = Models { model: &model, draws: draws.as_ref().map_or(&[], |draws| &draws.models) };
    let Some(path) = &arguments.output else {
        let done = predict(&models, &wall_of, &mut reader, &mut std::io::stdout().lock());
        return done.map_err(|error| at(Path::new("standard output"), error));
    };
    let mut output = AtomicFile::new(path, &[&arguments.impacts, &arguments.model])?;
    predict(&models, &wall_of, &mut reader, &mut output).map_err(|error| at(path, error))?;
    Ok(AtomicFile::commit(vec![output])?)
}

/// The model, and those drawn from its fit.
struct Models<'a> {
    model: &'a Model,
    draws: &'a [Model],
}

/// Finds the wall of a row.
type WallOf<'a> = dyn Fn(&Row) -> Result<usize, WallError> + Sync + 'a;

/// Reports unused columns that resemble an input, and the assumed values of absent inputs.
fn note_assumptions(file: &str, reader: &ImpactReader<impl Read>) {
    for (column, input) in reader.near_misses() {
        eprintln!(
            "nearwall: {file}: column `{column}` is not used; rename it if it is the input `{input}` in SI units"
        );
    }
    let own = reader.absent_extra().filter_map(ExtraInput::describe_default);
    let assumed: Vec<String> = assumed(&reader.absent()).into_iter().chain(own).collect();
    if !assumed.is_empty() {
        eprintln!("nearwall: not in {file}, assumed: {}", assumed.join(", "));
    }
}

/// Adds the file to a write error, except for a closed pipe.
fn at(place: &Path, error: Box<dyn std::error::Error>) -> Box<dyn std::error::Error> {
    match error.downcast::<csv::Error>().map(|error| of_csv(*error)) {
        Ok(error) if error.kind() == ErrorKind::BrokenPipe => error.into(),
        Ok(error) => refused(place, &error).into(),
        Err(other) => other,
    }
}

fn predict(
    models: &Models<'_>,
    wall_of: &WallOf<'_>,
    reader: &mut ImpactReader<impl Read + Send>,
    output: &mut impl Write,
) -> CommandResult {
    let mut header = reader.headers().clone();
    let bands: &[&str] = if models.draws.is_empty() { &[] } else { &BANDS };
    for name in ADDED.iter().chain(bands) {
        // A column of the file keeps its name.
        let taken = reader.column(name).is_some();
        header.push_field(&if taken { format!("{name}_predicted") } else { (*name).to_owned() });
    }
    let mut first = csv::Writer::from_writer(&mut *output);
    first.write_record(&header)?;
    first.flush().map_err(csv::Error::from)?;
    drop(first);
    let mut all = Predicted::default();
    let mut block = Block::read(reader);
    while !block.rows.is_empty() {
        // The next rows are read meanwhile.
        let (parts, next) = rayon::join(|| block.predict(models, wall_of), || Block::read(reader));
        for part in parts {
            all.write(part?, output)?;
        }
        if let Some(error) = block.fault {
            return Err(error.into());
        }
        block = next;
    }
    if let Some(error) = block.fault {
        return Err(error.into());
    }
    output.flush().map_err(csv::Error::from)?;
    all.report()
}

/// Rows that are predicted together, and rows of one task.
const BLOCK: usize = 8192;
const TASK: usize = 256;

/// Consecutive rows of the file.
struct Block {
    rows: Vec<Result<Row, BadRow>>,
    /// Why no more rows can be read.
    fault: Option<DatasetError>,
}

impl Block {
    fn read(reader: &mut ImpactReader<impl Read>) -> Self {
        let (mut rows, mut fault) = (Vec::with_capacity(BLOCK), None);
        while rows.len() < BLOCK && fault.is_none() {
            match reader.next_row() {
                Ok(Some(next)) => rows.push(next),
                Ok(None) => break,
                Err(error) => fault = Some(error),
            }
        }
        Self { rows, fault }
    }

    /// Predicts the rows on all cores; the parts have their order.
    fn predict(&self, models: &Models<'_>, wall_of: &WallOf<'_>) -> Vec<csv::Result<Predicted>> {
        self.rows.par_chunks(TASK).map(|rows| Predicted::of(models, wall_of, rows)).collect()
    }
}

/// Predicted rows as text, and what has to be said of them.
#[derive(Default)]
struct Predicted {
    text: Vec<u8>,
    done: u64,
    /// Rows outside a valid range.
    outside: u64,
    /// Rows that cannot be used: line and reason.
    left_out: Vec<(u64, String)>,
    left_out_count: u64,
    /// The first warning about a unit, and about a word that the model does not list.
    warning: Option<String>,
    unknown: Option<String>,
}

impl Predicted {
    fn of(models: &Models<'_>, wall_of: &WallOf<'_>, rows: &[Result<Row, BadRow>]) -> csv::Result<Self> {
        let mut part = Self::default();
        let mut writer = csv::Writer::from_writer(Vec::new());
        for next in rows {
            let predicted = next.as_ref().map_err(|bad| (bad.line, bad.reason.clone())).and_then(|row| {
                part.warning = part.warning.take().or_else(|| unlikely(row.line, &row.impact));
                part.unknown = part.unknown.take().or_else(|| unknown_label(models.model, row));
                let predicted = PredictedRow::of(models, wall_of, row);
                Ok((row, predicted.map_err(|reason| (row.line, reason))?))
            });
            match predicted {
                Ok((row, predicted)) => {
                    predicted.write(row, &mut writer)?;
                    part.done += 1;
                    part.outside += u64::from(predicted.outside_range);
                }
                Err(bad) => part.left_out.push(bad),
            }
        }
        part.text = writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))?;
        Ok(part)
    }

    /// Writes later rows and adds their counts and warnings.
    fn write(&mut self, part: Self, output: &mut impl Write) -> csv::Result<()> {
        for (line, reason) in &part.left_out {
            eprintln!("nearwall: line {line} left out: {reason}");
        }
        output.write_all(&part.text)?;
        self.done += part.done;
        self.outside += part.outside;
        self.left_out_count += part.left_out.len() as u64;
        self.warning = self.warning.take().or(part.warning);
        self.unknown = self.unknown.take().or(part.unknown);
        Ok(())
    }

    fn report(&self) -> CommandResult {
        let Self { done, outside, left_out_count, .. } = self;
        for warning in self.warning.iter().chain(&self.unknown) {
            eprintln!("nearwall: {warning}");
        }
        if *outside > 0 {
            eprintln!(
                "nearwall: {outside} of {done} rows lie outside the valid range of a property, a law or a fitted term \
                 (see --explain LINE, `nearwall materials NAME`)"
            );
        }
        if *left_out_count > 0 {
            eprintln!("nearwall: {done} rows predicted, {left_out_count} left out");
        }
        if *done == 0 {
            return Err("no row could be used".into());
        }
        Ok(())
    }
}

/// The predictions of one row.
struct PredictedRow {
    /// `e_n`, `e_t` and `p_stick`.
    values: [f64; 3],
    regime: &'static str,
    /// The bands of the values, with `--draws`.
    bands: Vec<[f64; 2]>,
    outside_range: bool,
}

impl PredictedRow {
    fn of(models: &Models<'_>, wall_of: &WallOf<'_>, row: &Row) -> Result<Self, String> {
        let wall = wall_of(row).map_err(|error| error.to_string())?;
        let expect = |model: &Model| {
            let mean = model.expect(wall, &row.impact, DRAWS).map_err(|error| error.to_string())?;
            let values = [mean.normal_restitution, mean.tangential_restitution, mean.sticking_probability];
            Ok::<_, String>((values, mean))
        };
        let (values, mean) = expect(models.model)?;
        let drawn = models.draws.iter().map(|model| expect(model).map(|(values, _)| values));
        let drawn: Vec<[f64; 3]> = drawn.collect::<Result<_, _>>()?;
        let band = |which: usize| {
            let Band { low, high, .. } = Band::of(drawn.iter().map(|values| values[which]).collect());
            [low, high]
        };
        let bands = if drawn.is_empty() { Vec::new() } else { (0..3).map(band).collect() };
        Ok(Self { values, regime: mean.regime.name(), bands, outside_range: mean.outside_range })
    }

    /// Writes the cells of the row and the predictions.
    fn write(&self, row: &Row, writer: &mut csv::Writer<Vec<u8>>) -> csv::Result<()> {
        for cell in &row.cells {
            writer.write_field(cell)?;
        }
        for value in self.values {
            writer.write_field(format!("{value:.16e}"))?;
        }
        writer.write_field(self.regime)?;
        for value in self.bands.as_flattened() {
            writer.write_field(format!("{value:.16e}"))?;
        }
        writer.write_record(None::<&[u8]>)
    }
}

/// A warning if a row has a word that the model file does not list.
fn unknown_label(model: &Model, row: &Row) -> Option<String> {
    let mut extra = model.extra_inputs().iter().zip(row.impact.extra.iter());
    let (input, _) = extra.find(|(input, value)| input.is_unknown(**value))?;
    let (line, name, known) = (row.line, &input.name, input.labels.join(", "));
    Some(format!("line {line}: {name} is none of {known}; such rows are predicted without it"))
}

/// Prints the evaluation of one impact, one line per term.
fn explain(
    model: &Model,
    wall_of: &WallOf<'_>,
    reader: &mut ImpactReader<impl Read>,
    line: u64,
) -> CommandResult {
    while let Some(next) = reader.next_row()? {
        match next {
            Err(bad) if bad.line == line => return Err(format!("line {line}: {}", bad.reason).into()),
            Ok(row) if row.line == line => {
                let wall = wall_of(&row)?;
                let (outcome, entries) = model.explain(wall, &row.impact, ImpactRng::default())?;
                let speeds = model.speeds(wall, &row.impact)?;
                let mut text = format!(
                    "wall {}, regime {}\nv_adh {:.4e} m/s, v_y {:.4e} m/s, v_s {:.4e} m/s\n",
                    model.walls()[wall].name(),
                    outcome.regime.name(),
                    speeds.adhesive,
                    speeds.yielding,
                    speeds.sticking
                );
                if outcome.outside_range {
                    text += "outside the valid range of a property, a law or a fitted term\n";
                }
                for entry in entries {
                    text += &format!("{:<24} {:<22} {:.6}\n", entry.term, entry.quantity, entry.value);
                }
                return crate::print(&text);
            }
            _ => {}
        }
    }
    Err(format!("--explain {line}: there is no row on this line (the header is line 1)").into())
}
