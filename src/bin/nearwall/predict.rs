//! `nearwall predict`: what the model says of each impact in a CSV file.

use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use nearwall::atomic_file::{AtomicFile, of_csv, refused};
use nearwall::dataset::{ImpactReader, Row, WallChoice, WallError, assumed, unlikely};
use nearwall::{ImpactRng, Model};

use crate::{CommandResult, progress};

/// Adds the model's e_n, e_t, p_stick and regime to each impact
#[derive(clap::Args)]
#[command(after_help = "Example:\n  nearwall predict --model wax.toml impacts.csv -o predicted.csv\n\n\
    impacts.csv needs a column v_n [m/s]; v_t [m/s], d [m], T_p [K], T_w [K], conversion, layer_thickness [m],\n\
    film_thickness [m], v_gas [m/s], roughness [m], omega [rad/s], coverage, melt_thickness [m] and wall are used where they are there.\n\
    Every other column is kept. A row that cannot be used is named on standard error and left out; that is no failure as\n\
    long as one row can be used.")]
pub struct Arguments {
    /// The impacts, one a row
    impacts: PathBuf,
    /// The model file
    #[arg(long)]
    model: PathBuf,
    /// Where to write; standard output if not given
    #[arg(short)]
    output: Option<PathBuf>,
    /// The model's wall that is hit; otherwise the column `wall`, then `default`, then the only one
    #[arg(long)]
    wall: Option<String>,
    /// Print what each term did to the impact on this line of the file, instead of the table
    #[arg(long, value_name = "LINE")]
    explain: Option<u64>,
}

/// The columns that are added.
const ADDED: [&str; 4] = ["e_n", "e_t", "p_stick", "regime"];

pub fn run(arguments: &Arguments) -> CommandResult {
    let model = Model::from_file(&arguments.model)?;
    let file = arguments.impacts.display().to_string();
    let source = File::open(&arguments.impacts).map_err(|error| format!("{file}: {error}"))?;
    let bar = progress::bytes(source.metadata().map_or(0, |data| data.len()), "predicting");
    let mut reader = ImpactReader::new(&file, bar.wrap_read(source))?;
    let walls = Walls::new(&model, arguments.wall.as_deref(), reader.column("wall"))?;
    if let Some(line) = arguments.explain {
        return explain(&model, &walls, &mut reader, line);
    }
    note_assumptions(&file, &reader);
    match &arguments.output {
        None => {
            let done = predict(&model, &walls, &mut reader, &mut std::io::stdout().lock());
            done.map_err(|error| at(Path::new("standard output"), error))
        }
        Some(path) => {
            let mut aside = AtomicFile::new(path, &[&arguments.impacts, &arguments.model])?;
            predict(&model, &walls, &mut reader, &mut aside).map_err(|error| at(path, error))?;
            Ok(AtomicFile::commit(vec![aside])?)
        }
    }
}

/// Says what stands in for inputs that the file does not give, where that is more than "none".
fn note_assumptions(file: &str, reader: &ImpactReader<impl std::io::Read>) {
    for (column, input) in reader.near_misses() {
        eprintln!(
            "nearwall: {file}: column `{column}` is not used; if it is `{input}` in SI units, call it so"
        );
    }
    if let Some(assumed) = assumed(&reader.absent()) {
        eprintln!("nearwall: not in {file}, assumed: {assumed}");
    }
}

/// Names the place in an error of writing; a reader that goes away is left as it is.
fn at(place: &Path, error: Box<dyn std::error::Error>) -> Box<dyn std::error::Error> {
    match error.downcast::<csv::Error>().map(|error| of_csv(*error)) {
        Ok(error) if error.kind() == ErrorKind::BrokenPipe => error.into(),
        Ok(error) => refused(place, &error).into(),
        Err(other) => other,
    }
}

fn predict(
    model: &Model,
    walls: &Walls<'_>,
    reader: &mut ImpactReader<impl std::io::Read>,
    output: &mut impl Write,
) -> CommandResult {
    let mut writer = csv::Writer::from_writer(output);
    let mut header = reader.headers().clone();
    for name in ADDED {
        // A measured column keeps its name.
        let taken = reader.column(name).is_some();
        header.push_field(&if taken { format!("{name}_predicted") } else { name.to_owned() });
    }
    writer.write_record(&header)?;
    let (mut done, mut left_out, mut outside) = (0_u64, 0_u64, 0_u64);
    let mut strange = None;
    while let Some(next) = reader.next_row()? {
        let predicted = next.map_err(|bad| (bad.line, bad.reason)).and_then(|row| {
            strange = strange.take().or_else(|| unlikely(row.line, &row.impact));
            predict_row(model, walls, &row).map_err(|reason| (row.line, reason))
        });
        match predicted {
            Ok((record, outside_range)) => {
                writer.write_record(&record)?;
                done += 1;
                outside += u64::from(outside_range);
            }
            Err((line, reason)) => {
                eprintln!("nearwall: line {line} left out: {reason}");
                left_out += 1;
            }
        }
    }
    writer.flush().map_err(csv::Error::from)?;
    if let Some(note) = strange {
        eprintln!("nearwall: {note}");
    }
    if outside > 0 {
        eprintln!(
            "nearwall: {outside} of {done} rows lie outside the range that a property or a fitted term is stated for \
             (--explain LINE, `nearwall materials NAME`)"
        );
    }
    if left_out > 0 {
        eprintln!("nearwall: {done} rows predicted, {left_out} left out");
    }
    if done == 0 {
        return Err("no row could be used".into());
    }
    Ok(())
}

fn predict_row(model: &Model, walls: &Walls<'_>, row: &Row) -> Result<(csv::StringRecord, bool), String> {
    let wall = walls.of(row)?;
    let outcome =
        model.resolve(wall, &row.impact, ImpactRng::default()).map_err(|error| error.to_string())?;
    let mut record = row.cells.clone();
    for value in [outcome.normal_restitution, outcome.tangential_restitution, outcome.sticking_probability] {
        record.push_field(&format!("{value:.16e}"));
    }
    record.push_field(outcome.regime.name());
    Ok((record, outcome.outside_range))
}

/// Which wall a row hits.
struct Walls<'a> {
    choice: WallChoice<'a>,
    column: Option<usize>,
}

impl<'a> Walls<'a> {
    fn new(model: &'a Model, named: Option<&str>, column: Option<usize>) -> Result<Self, WallError> {
        let choice = WallChoice::new(model, named)?;
        choice.check(column.is_some())?;
        Ok(Self { choice, column })
    }

    fn of(&self, row: &Row) -> Result<usize, String> {
        let cell = self.column.and_then(|column| row.cells.get(column));
        self.choice.of(cell).map_err(|error| error.to_string())
    }
}

/// Prints the walk of one impact, a line a term.
fn explain(
    model: &Model,
    walls: &Walls<'_>,
    reader: &mut ImpactReader<impl std::io::Read>,
    line: u64,
) -> CommandResult {
    while let Some(next) = reader.next_row()? {
        match next {
            Err(bad) if bad.line == line => return Err(format!("line {line}: {}", bad.reason).into()),
            Ok(row) if row.line == line => {
                let wall = walls.of(&row)?;
                let (outcome, shares) = model.explain(wall, &row.impact, ImpactRng::default())?;
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
                    text += "outside the range that a property or a fitted term is stated for\n";
                }
                for share in shares {
                    text += &format!("{:<24} {:<22} {:.6}\n", share.term, share.quantity, share.value);
                }
                return crate::print(&text);
            }
            _ => {}
        }
    }
    Err(format!("--explain {line}: no row stands on this line (the header is the first line)").into())
}
