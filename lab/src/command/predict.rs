//! `nearwall predict`: the model's prediction of each impact in a CSV file.

use std::fs::File;
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use crate::atomic_file::{AtomicFile, WriteError};
use crate::dataset::{BadRow, DatasetError, ImpactReader, ImpactRow};
use crate::predict::{BANDS, BEYOND, CONTACT_TIME, PredictedRow, Predictor, RowNotes, VALUES, file_notes};
use nearwall::effect::stream;
use nearwall::impact::INPUTS;
use nearwall::{ImpactRng, Model};
use rayon::prelude::*;

use super::{CommandResult, progress};

/// Adds the model's e_n, e_t, p_stick and regime, and the stated ranges that it leaves, to each impact
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
    /// Add a column `contact_time`: how long a solid particle touches the wall [s]
    #[arg(long, conflicts_with = "explain")]
    contact_time: bool,
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
         Every other column is kept. A row that cannot be used is reported on standard error and left out. The \
         command\n\
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
    let predictor = Predictor::new(&model, arguments.wall.as_deref(), &reader)?;
    let mut predictor = predictor.with_contact_time(arguments.contact_time);
    if let Some(line) = arguments.explain {
        return explain(&predictor, &mut reader, line);
    }
    super::note(model.notes().into_iter().chain(file_notes(&file, &reader)));
    if let Some(folder) = &arguments.draws {
        predictor.read_draws(folder)?;
    }
    let Some(path) = &arguments.output else {
        let done = predict(&predictor, &mut reader, &mut std::io::stdout().lock());
        return done.map_err(|error| at(Path::new("standard output"), error));
    };
    let mut output = AtomicFile::new(path, &[&arguments.impacts, &arguments.model])?;
    predict(&predictor, &mut reader, &mut output).map_err(|error| at(path, error))?;
    Ok(AtomicFile::commit([output])?)
}

/// Adds the file to a write error, except for a closed pipe.
fn at(place: &Path, error: Box<dyn std::error::Error>) -> Box<dyn std::error::Error> {
    match error.downcast::<std::io::Error>() {
        Ok(error) if error.kind() == ErrorKind::BrokenPipe => error,
        Ok(error) => WriteError::new(place, *error).into(),
        Err(other) => other,
    }
}

fn predict(
    predictor: &Predictor<'_>,
    reader: &mut ImpactReader<impl Read + Send>,
    output: &mut impl Write,
) -> CommandResult {
    output.write_all(&header(predictor, reader)?)?;
    let mut notes = RowNotes::default();
    let (mut block, mut next) = (RowBlock::default(), RowBlock::default());
    block.read(reader);
    while block.count > 0 {
        // The next rows are read meanwhile.
        rayon::join(|| block.predict(predictor), || next.read(reader)).0?;
        block.write(output, &mut notes)?;
        if let Some(error) = block.fault {
            return Err(error.into());
        }
        std::mem::swap(&mut block, &mut next);
    }
    if let Some(error) = block.fault {
        return Err(error.into());
    }
    output.flush()?;
    report(&notes)
}

/// The names of the columns of the file and of those that are added.
fn header(predictor: &Predictor<'_>, reader: &ImpactReader<impl Read>) -> csv::Result<Vec<u8>> {
    let bands: &[&str] = if predictor.has_bands() { &BANDS } else { &[] };
    let mut header = reader.headers().clone();
    let time: &[&str] = if predictor.has_contact_time() { &[CONTACT_TIME] } else { &[] };
    for name in VALUES.iter().chain(&["regime"]).chain(bands).chain(time).chain(&[BEYOND]) {
        // A column of the file keeps its name.
        let more = if reader.column(name).is_some() { "_predicted" } else { "" };
        header.push_field(&format!("{name}{more}"));
    }
    let mut text = Vec::new();
    csv::Writer::from_writer(&mut text).write_record(&header)?;
    Ok(text)
}

/// Rows that are predicted together, and rows of one task.
const ROWS_A_BLOCK: usize = 8192;
const ROWS_A_TASK: usize = 256;

/// Consecutive rows of the file. The memory of a block is used again by a later one.
#[derive(Default)]
struct RowBlock {
    /// Rows, and why those that cannot be used are bad.
    rows: Vec<(ImpactRow, Option<BadRow>)>,
    /// Number of rows that were read.
    count: usize,
    /// Why no more rows can be read.
    fault: Option<DatasetError>,
    /// What was predicted for each task.
    parts: Vec<PredictedText>,
}

impl RowBlock {
    /// Reads the next rows in place of these.
    fn read(&mut self, reader: &mut ImpactReader<impl Read>) {
        (self.count, self.fault) = (0, None);
        while self.count < ROWS_A_BLOCK {
            if self.count == self.rows.len() {
                self.rows.push(Default::default());
            }
            let (row, bad) = &mut self.rows[self.count];
            match reader.next_into(row) {
                Ok(Some(next)) => *bad = next.err(),
                Ok(None) => return,
                Err(error) => {
                    self.fault = Some(error);
                    return;
                }
            }
            self.count += 1;
        }
    }

    /// Predicts the rows on all cores; the parts have their order.
    fn predict(&mut self, predictor: &Predictor<'_>) -> csv::Result<()> {
        let tasks = self.rows[..self.count].par_chunks(ROWS_A_TASK);
        self.parts.resize_with(tasks.len(), PredictedText::default);
        tasks.zip(&mut self.parts).try_for_each(|(rows, part)| part.predict(predictor, rows))
    }

    /// Writes the rows and adds their notes.
    fn write(&mut self, output: &mut impl Write, notes: &mut RowNotes) -> std::io::Result<()> {
        for part in &mut self.parts {
            for BadRow { line, reason } in part.left_out.drain(..) {
                eprintln!("nearwall: line {line} left out: {reason}");
            }
            output.write_all(&part.text)?;
            notes.add(std::mem::take(&mut part.notes));
        }
        Ok(())
    }
}

/// Predicted rows as text, and the notes about them.
#[derive(Default)]
struct PredictedText {
    text: Vec<u8>,
    left_out: Vec<BadRow>,
    notes: RowNotes,
}

impl PredictedText {
    fn predict(
        &mut self,
        predictor: &Predictor<'_>,
        rows: &[(ImpactRow, Option<BadRow>)],
    ) -> csv::Result<()> {
        self.text.clear();
        let mut writer = csv::WriterBuilder::new().flexible(true).from_writer(&mut self.text);
        for (row, bad) in rows {
            match self.notes.predict(predictor, bad.as_ref().map_or(Ok(row), Err)) {
                Ok((row, predicted)) => write_row(row, &predicted, &mut writer)?,
                Err(bad) => self.left_out.push(bad),
            }
        }
        Ok(writer.flush()?)
    }
}

/// Writes the cells of a row and its prediction, each number with as few digits as give the same
/// bits when they are read.
fn write_row(
    row: &ImpactRow,
    predicted: &PredictedRow,
    writer: &mut csv::Writer<impl Write>,
) -> csv::Result<()> {
    let mut digits = zmij::Buffer::new();
    row.cells.iter().try_for_each(|cell| writer.write_field(cell))?;
    for value in predicted.values {
        writer.write_field(digits.format(value))?;
    }
    writer.write_field(predicted.regime)?;
    for value in predicted.bands.as_flattened().iter().chain(&predicted.contact_time) {
        writer.write_field(digits.format(*value))?;
    }
    writer.write_field(predicted.beyond_text())?;
    writer.write_record(None::<&[u8]>)
}

/// Prints the notes about all rows.
fn report(notes: &RowNotes) -> CommandResult {
    super::note(notes.warnings());
    super::note(notes.outside_range());
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
                // Of covered and bare wall the share that is met more probably.
                let uniform =
                    |wanted| if wanted == stream::COVER { 0.5 } else { ImpactRng::default().uniform(wanted) };
                let (_, entries) = model.explain_with(wall, &row.impact, uniform)?;
                let predicted = predictor.row(&row).map_err(|bad| bad.reason)?;
                let regime = predicted.regime;
                let speeds = model.speeds(wall, &row.impact)?;
                let mut text = format!(
                    "wall {}, regime {regime}\nv_adh {:.4e} m/s, v_y {:.4e} m/s, v_s {:.4e} m/s\n",
                    model.walls()[wall].name(),
                    speeds.adhesive,
                    speeds.yielding,
                    speeds.sticking
                );
                let notes = model.notes().into_iter().map(|note| ("note", note));
                for (what, words) in model.estimates().into_iter().chain(notes) {
                    text += &format!("{what}: {words}\n");
                }
                for reason in &predicted.beyond {
                    text += &format!("outside its range: {reason}\n");
                }
                for entry in entries {
                    text += &format!("{:<24} {:<22} {:.6}\n", entry.term, entry.quantity, entry.value);
                }
                return super::print(&text);
            }
            _ => {}
        }
    }
    Err(format!("--explain {line}: there is no row on this line (the header is line 1)").into())
}
