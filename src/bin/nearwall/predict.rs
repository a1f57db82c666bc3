//! `nearwall predict`: the model's prediction of each impact in a CSV file.

use std::fs::File;
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use nearwall::atomic_file::{AtomicFile, of_csv, refused};
use nearwall::dataset::{BadRow, DatasetError, ImpactReader, Row};
use nearwall::impact::INPUTS;
use nearwall::predict::{BANDS, PredictedRow, Predictor, RowNotes, VALUES, file_notes};
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

pub fn run(arguments: &Arguments) -> CommandResult {
    let model = Model::from_file(&arguments.model)?;
    let file = arguments.impacts.display().to_string();
    let source = File::open(&arguments.impacts).map_err(|error| format!("{file}: {error}"))?;
    let bar = progress::bytes(source.metadata().map_or(0, |data| data.len()), "predicting");
    let mut reader = ImpactReader::new(&file, bar.wrap_read(source))?.with_extra_inputs(model.extra_inputs());
    let mut predictor = Predictor::new(&model, arguments.wall.as_deref(), &reader)?;
    if let Some(line) = arguments.explain {
        return explain(&predictor, &mut reader, line);
    }
    for note in file_notes(&file, &reader) {
        eprintln!("nearwall: {note}");
    }
    if let Some(folder) = &arguments.draws {
        predictor.read_draws(folder)?;
    }
    let Some(path) = &arguments.output else {
        let done = predict(&predictor, &mut reader, &mut std::io::stdout().lock());
        return done.map_err(|error| at(Path::new("standard output"), error));
    };
    let mut output = AtomicFile::new(path, &[&arguments.impacts, &arguments.model])?;
    predict(&predictor, &mut reader, &mut output).map_err(|error| at(path, error))?;
    Ok(AtomicFile::commit(vec![output])?)
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
    predictor: &Predictor<'_>,
    reader: &mut ImpactReader<impl Read + Send>,
    output: &mut impl Write,
) -> CommandResult {
    let mut header = reader.headers().clone();
    let bands: &[&str] = if predictor.has_bands() { &BANDS } else { &[] };
    for name in VALUES.iter().chain(&["regime"]).chain(bands) {
        // A column of the file keeps its name.
        let taken = reader.column(name).is_some();
        header.push_field(&if taken { format!("{name}_predicted") } else { (*name).to_owned() });
    }
    let mut first = csv::Writer::from_writer(&mut *output);
    first.write_record(&header)?;
    first.flush().map_err(csv::Error::from)?;
    drop(first);
    let mut notes = RowNotes::default();
    let mut block = Block::read(reader);
    while !block.rows.is_empty() {
        // The next rows are read meanwhile.
        let (parts, next) = rayon::join(|| block.predict(predictor), || Block::read(reader));
        for part in parts {
            notes.add(part?.write(output)?);
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
    report(&notes)
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
    fn predict(&self, predictor: &Predictor<'_>) -> Vec<csv::Result<Predicted>> {
        self.rows.par_chunks(TASK).map(|rows| Predicted::of(predictor, rows)).collect()
    }
}

/// Predicted rows as text, and the notes about them.
#[derive(Default)]
struct Predicted {
    text: Vec<u8>,
    left_out: Vec<BadRow>,
    notes: RowNotes,
}

impl Predicted {
    fn of(predictor: &Predictor<'_>, rows: &[Result<Row, BadRow>]) -> csv::Result<Self> {
        let mut part = Self::default();
        let mut writer = csv::Writer::from_writer(Vec::new());
        for next in rows {
            match part.notes.predict(predictor, next) {
                Ok((row, predicted)) => write_row(row, &predicted, &mut writer)?,
                Err(bad) => part.left_out.push(bad),
            }
        }
        part.text = writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))?;
        Ok(part)
    }

    /// Writes the rows and returns their notes.
    fn write(self, output: &mut impl Write) -> csv::Result<RowNotes> {
        for BadRow { line, reason } in &self.left_out {
            eprintln!("nearwall: line {line} left out: {reason}");
        }
        output.write_all(&self.text)?;
        Ok(self.notes)
    }
}

/// Writes the cells of a row and its prediction.
fn write_row(row: &Row, predicted: &PredictedRow, writer: &mut csv::Writer<Vec<u8>>) -> csv::Result<()> {
    for cell in &row.cells {
        writer.write_field(cell)?;
    }
    for value in predicted.values {
        writer.write_field(format!("{value:.16e}"))?;
    }
    writer.write_field(predicted.regime)?;
    for value in predicted.bands.as_flattened() {
        writer.write_field(format!("{value:.16e}"))?;
    }
    writer.write_record(None::<&[u8]>)
}

/// Prints the notes about all rows.
fn report(notes: &RowNotes) -> CommandResult {
    for warning in notes.warnings() {
        eprintln!("nearwall: {warning}");
    }
    if let Some(outside) = notes.outside_range() {
        eprintln!("nearwall: {outside} (see --explain LINE, `nearwall materials NAME`)");
    }
    let (predicted, left_out) = (notes.predicted(), notes.left_out());
    if left_out > 0 {
        eprintln!("nearwall: {predicted} rows predicted, {left_out} left out");
    }
    if predicted == 0 {
        return Err("no row could be used".into());
    }
    Ok(())
}

/// Prints the evaluation of one impact, one line per term.
fn explain(predictor: &Predictor<'_>, reader: &mut ImpactReader<impl Read>, line: u64) -> CommandResult {
    let model = predictor.model();
    while let Some(next) = reader.next_row()? {
        match next {
            Err(bad) if bad.line == line => return Err(format!("line {line}: {}", bad.reason).into()),
            Ok(row) if row.line == line => {
                let wall = predictor.wall(&row)?;
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
