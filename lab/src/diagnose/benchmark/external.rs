//! A law that runs as another program: a filter from impacts to `e_n`, `e_t` and `p`.
//!
//! It reads a table with a heading on standard input, one impact a line, and writes a table with a
//! heading on standard output, one line for each impact in the same order. A blank cell is no answer.

use std::io::Write;
use std::process::{Command, Stdio};

/// What a program answers for one impact; NaN where it does not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ExternalAnswer {
    /// `e_n`, `e_t` and the probability of capture [1].
    pub values: [f64; 3],
    /// Low and high end of its own bands of `e_n` and `e_t` [1].
    pub bands: [[f64; 2]; 2],
}

/// Columns of an answer; the bands may be absent.
const COLUMNS: [&str; 7] = ["e_n", "e_t", "p", "e_n_low", "e_n_high", "e_t_low", "e_t_high"];

/// Runs the command in a shell with these impacts.
pub(super) fn ask(command: &str, impacts: String, count: usize) -> Result<Vec<ExternalAnswer>, String> {
    let mut child = Command::new("sh")
        .args(["-c", command])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .map_err(|error| format!("it cannot be started: {error}"))?;
    let input = child.stdin.take();
    // A program may write before it has read everything.
    let writer = std::thread::spawn(move || input.map(|mut input| input.write_all(impacts.as_bytes())));
    let output = child.wait_with_output().map_err(|error| error.to_string())?;
    // A program that does not read to the end closes the pipe: its answer shows what is missing.
    drop(writer.join());
    if !output.status.success() {
        return Err(format!("it ended with {}", output.status));
    }
    let answers = answers(&output.stdout)?;
    if answers.len() != count {
        let rows = answers.len();
        return Err(format!(
            "it wrote {rows} rows for {count} impacts; write one row for each, in the same order"
        ));
    }
    Ok(answers)
}

/// Reads the table of answers.
fn answers(text: &[u8]) -> Result<Vec<ExternalAnswer>, String> {
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text);
    let header = reader.headers().map_err(|error| error.to_string())?.clone();
    let places = COLUMNS.map(|name| header.iter().position(|head| head == name));
    if places[..3].iter().all(Option::is_none) {
        let found = header.iter().collect::<Vec<_>>().join(",");
        return Err(format!("the first line it wrote is `{found}`; write a heading with e_n, e_t and p"));
    }
    reader.records().map(|record| answer(&record.map_err(|error| error.to_string())?, places)).collect()
}

fn answer(record: &csv::StringRecord, places: [Option<usize>; 7]) -> Result<ExternalAnswer, String> {
    let mut numbers = [f64::NAN; 7];
    for (column, number) in numbers.iter_mut().enumerate() {
        let cell = places[column].and_then(|place| record.get(place)).unwrap_or_default();
        if cell.is_empty() {
            continue;
        }
        let line = record.position().map_or(0, csv::Position::line);
        let fault = |problem| format!("line {line} of what it wrote: {} `{cell}` {problem}", COLUMNS[column]);
        *number = cell.parse().map_err(|_| fault("is not a number"))?;
        if column == 2 && !(0.0..=1.0).contains(number) {
            return Err(fault("is no probability, 0 to 1"));
        }
    }
    let [e_n, e_t, p, bands @ ..] = numbers;
    Ok(ExternalAnswer { values: [e_n, e_t, p], bands: [[bands[0], bands[1]], [bands[2], bands[3]]] })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_filter_answers_every_impact() {
        let found = ask("sed '1s/.*/p,e_n/; 2,$s/.*/0,0.5/'", "v_n\n1\n2\n".to_owned(), 2).unwrap();
        assert_eq!(found.len(), 2);
        assert_eq!((found[1].values[0], found[1].values[2]), (0.5, 0.0));
        assert!(found[0].values[1].is_nan() && found[0].bands[0][0].is_nan());
    }

    #[test]
    fn faults_of_a_program_name_the_line_and_the_remedy() {
        let fault = |command: &str| ask(command, "v_n\n1\n2\n".to_owned(), 2).unwrap_err();
        assert!(fault("exit 3").contains('3'));
        assert!(fault("cat > /dev/null; echo e_n; echo 0.5").contains("1 rows for 2 impacts"));
        assert!(fault("cat").contains("a heading with e_n, e_t and p"));
        assert!(fault("echo p; echo 0; echo 2").contains("line 3 of what it wrote: p `2` is no probability"));
        assert!(
            fault("echo e_n; echo x; echo 1").contains("line 2 of what it wrote: e_n `x` is not a number")
        );
    }
}
