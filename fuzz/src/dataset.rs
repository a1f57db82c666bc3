//! A data file with its column map: the map, a zero, the file.

use nearwall::{ImpactRng, Model};
use nearwall_lab::dataset::{ColumnMap, ImpactReader, Measurements, WallChoice};

use super::place;

const FILE: &str = "d.csv";
const MAP: &str = "map.toml";

const MODEL: &str = r#"
[particle]
material = "montan-wax"
[walls.default]
material = "pyrex"
[walls."roof.*"]
material = "stainless-steel"
[normal]
model = "thornton-ning"
yield_ratio = 0.7
[tangential]
model = "sliding-rolling"
friction = 0.3
"#;

/// Any file is refused in words, or every row is used or named with a line that is in the file.
pub fn dataset(bytes: &[u8]) {
    let middle = bytes.iter().position(|byte| *byte == 0);
    let (map, file) = middle.map_or((&[][..], bytes), |at| (&bytes[..at], &bytes[at + 1..]));
    let model = Model::from_toml("m.toml", MODEL).expect("our own model");
    planned(&model, file);
    let Ok(text) = std::str::from_utf8(map) else { return };
    let walls = WallChoice::new(&model, None).expect("there is a default");
    match ColumnMap::from_toml(MAP, text) {
        Err(error) => place(&error.to_string(), MAP, text),
        Ok(map) => measured(file, &map, &walls),
    }
}

/// No text has more lines than this.
fn most_lines(file: &[u8]) -> u64 {
    1 + file.iter().filter(|byte| matches!(byte, b'\n' | b'\r')).count() as u64
}

fn planned(model: &Model, file: &[u8]) {
    let mut reader = match ImpactReader::new(FILE, file) {
        Ok(reader) => reader,
        Err(error) => return assert!(error.to_string().starts_with(FILE), "{error}"),
    };
    let _ = (reader.near_misses(), reader.absent());
    let columns = reader.headers().len();
    let mut last = 1;
    while let Some(next) = reader.next_row().expect("memory does not fail") {
        let line = match next {
            Ok(row) => {
                assert_eq!(row.cells.len(), columns);
                row.impact.check().expect("a row that can be used");
                model.resolve(0, &row.impact, ImpactRng::default()).expect("constant properties");
                row.line
            }
            Err(bad) => bad.line,
        };
        assert!(line >= last && line <= most_lines(file), "line {line} after {last} of {}", most_lines(file));
        last = line;
    }
}

fn measured(file: &[u8], map: &ColumnMap, walls: &WallChoice<'_>) {
    let data = match Measurements::read(FILE, file, Some(map), walls) {
        Ok(data) => data,
        Err(error) => {
            let said = error.to_string();
            return assert!(said.len() > 10 && !said.contains("panicked"), "{said}");
        }
    };
    assert_eq!(data.rows.len() + data.rejected.len(), data.read);
    let most = most_lines(file);
    assert!(data.rejected.iter().all(|bad| (1..=most).contains(&bad.line) && !bad.reason.is_empty()));
    for row in &data.rows {
        assert!((1..=most).contains(&row.line));
        row.impact.check().expect("a row that can be used");
        assert!(row.impacts >= 1.0 && row.rebounds >= 0.0, "{row:?}");
        assert!(row.captured.is_none_or(|share| (0.0..=1.0).contains(&share)), "{row:?}");
        assert!(row.input_errors.each().all(|(_, error)| error > 0.0 && error.is_finite()), "{row:?}");
        assert!(data.detection.least_e_n(&row.impact) >= 0.0, "{row:?}");
        for reading in [row.e_n, row.e_t].into_iter().flatten() {
            assert!(reading.value.is_finite(), "{row:?}");
        }
    }
    let half = data.without(|row| (row.line % 2 == 0).then(|| "even".to_owned()));
    assert_eq!(half.rows.len() + half.rejected.len(), data.read);
}
