//! Measured impacts with every column that may be a cause.

use super::column::{ColumnValues, DataColumn};
use super::detection::Detection;
use super::input_errors::InputErrors;
use super::{BadRow, DatasetError};
use nearwall::impact::{INPUTS, Impact};
use nearwall::input::unknown;

/// The content of a file of measured impacts.
#[derive(Debug, Clone)]
pub struct Measurements {
    /// The name of the file.
    pub file: String,
    /// The usable rows, in the order of the file; possibly none. Of a large file a selection, if it was read by
    /// [`crate::diagnose::read_measurements`].
    pub rows: Vec<Measurement>,
    /// The usable rows that were not selected.
    pub unselected: Unselected,
    /// The columns that are not inputs, in the order of the file.
    pub columns: Vec<DataColumn>,
    /// The inputs that a column states, or two columns together.
    pub given: Vec<&'static str>,
    /// The rebounds that the apparatus cannot see.
    pub detection: Detection,
    /// The inputs that the model declares and a column states, by place in [`Impact::extra`].
    pub given_extra: Vec<usize>,
    /// Number of usable and rejected rows.
    pub read: usize,
    /// The rejected rows, with the reason; of a large file the first ones, if it was read so.
    pub rejected: Vec<BadRow>,
    /// Assumptions, and warnings about likely mistakes.
    pub notes: Vec<String>,
}

/// Usable rows of a large file that were not selected, as sums.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Unselected {
    /// Their number.
    pub rows: usize,
    /// Sum and number of the base model's squared errors of `e_n` and `e_t` and log losses of captures [nats].
    pub misfits: [(f64, usize); 3],
}

/// One row: one impact, or an average over several.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Measurement {
    /// Line in the file, counted from 1.
    pub line: u64,
    /// The impact; inputs that the row does not state have their default.
    pub impact: Impact,
    /// Standard errors of the inputs.
    pub input_errors: InputErrors,
    /// For each of [`INPUTS`] whether the row states it.
    pub stated: [bool; INPUTS.len()],
    /// Index of the model's wall that is hit.
    pub wall: usize,
    /// Number of impacts of the row, 1 for a single one.
    pub impacts: f64,
    /// Number of rebounds that `e_n` and `e_t` average: all impacts if captures were not recorded.
    pub rebounds: f64,
    /// Normal restitution [1], not negative.
    pub e_n: Option<Reading>,
    /// Tangential restitution [1], negative if the tangential velocity is reversed.
    pub e_t: Option<Reading>,
    /// Captured share of the impacts [1], 0 or 1 for a single one.
    pub captured: Option<f64>,
    /// What is known of `e_n` and `e_t` where a limit takes the place of the value.
    pub limits: [Option<Limit>; 2],
}

/// A censored value: it is known to be below or above a limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// The limit [1], with the standard error of such a reading, if known.
    pub reading: Reading,
    /// Whether the value is below the limit rather than above it.
    pub below: bool,
}

/// A measured value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// The value [1].
    pub value: f64,
    /// Its standard error [1], positive, if known.
    pub error: Option<f64>,
}

impl Measurement {
    /// Whether it is a rebound although no outcome says so: a single impact with `e_n` above 0.
    pub fn is_unstated_rebound(&self) -> bool {
        let above_zero = |limit: Limit| !limit.below && limit.reading.value >= 0.0;
        let rebounds = self.e_n.is_some_and(|e_n| e_n.value > 0.0) || self.limits[0].is_some_and(above_zero);
        self.captured.is_none() && self.impacts <= 1.0 && rebounds
    }
}

impl Measurements {
    /// Checks that a column of labels has this name, so that it can tell groups of rows apart.
    ///
    /// # Errors
    /// [`DatasetError::Group`] naming the columns of labels.
    pub fn check_group(&self, name: &str) -> Result<(), DatasetError> {
        let is_label = |column: &&DataColumn| matches!(column.values, ColumnValues::Labels { .. });
        let labels: Vec<&str> =
            self.columns.iter().filter(is_label).map(|column| column.name.as_str()).collect();
        if labels.contains(&name) {
            return Ok(());
        }
        let problem = match INPUTS.iter().any(|input| input.name == name) {
            true => {
                format!("`{name}` is an input and cannot be the group; choose one of {}", labels.join(", "))
            }
            false => unknown(name, "group column", &labels),
        };
        Err(DatasetError::Group { file: self.file.clone(), problem })
    }

    /// The data without the rows for which `fault` returns a reason; those rows become rejected rows.
    #[must_use]
    pub fn without(&self, fault: impl Fn(&Measurement) -> Option<String>) -> Self {
        let faults: Vec<Option<String>> = self.rows.iter().map(fault).collect();
        let keep: Vec<usize> = (0..self.rows.len()).filter(|&row| faults[row].is_none()).collect();
        let mut rejected = self.rejected.clone();
        let bad =
            |(row, reason): (&Measurement, Option<String>)| Some(BadRow { line: row.line, reason: reason? });
        rejected.extend(self.rows.iter().zip(faults).filter_map(bad));
        rejected.sort_by_key(|bad| bad.line);
        Self {
            rows: keep.iter().map(|&row| self.rows[row]).collect(),
            columns: self.columns.iter().map(|column| column.at(&keep)).collect(),
            rejected,
            ..self.clone()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::column::tests::words;
    use super::super::{ColumnMap, ColumnValues, DatasetError, WallChoice};
    use super::*;
    use nearwall::model::Model;

    const MODEL: &str = "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n\
        [walls.roof]\nmaterial = \"pyrex\"\n[normal]\nmodel = \"constant\"\ne_n = 0.5\n\
        [tangential]\nmodel = \"constant\"\ne_t = 0.76\n";

    fn try_read(text: &[u8], map: &str, wall: Option<&str>) -> Result<Measurements, DatasetError> {
        let model = Model::from_toml("m.toml", MODEL).unwrap();
        let map = ColumnMap::from_toml("map.toml", map).unwrap();
        Measurements::read("t.csv", text, Some(&map), &WallChoice::new(&model, wall)?)
    }

    fn read(text: &str) -> Measurements {
        try_read(text.as_bytes(), "", None).unwrap()
    }

    fn mapped(text: &str, map: &str) -> Measurements {
        try_read(text.as_bytes(), map, None).unwrap()
    }

    fn refused(text: &str, map: &str) -> String {
        try_read(text.as_bytes(), map, None).unwrap_err().to_string()
    }

    fn reasons(data: &Measurements) -> Vec<String> {
        data.rejected.iter().map(|bad| format!("{}: {}", bad.line, bad.reason)).collect()
    }

    fn exact(value: f64) -> Option<Reading> {
        Some(Reading { value, error: None })
    }

    #[test]
    fn rows_hold_impacts_observations_and_causes() {
        let data = read(
            "\u{feff}series,v_n,T_p,e_n,e_n_err,e_t,outcome,operator,humidity\r\n\
             7,2.5,350,0.4,0.02,-0.1,Bounce,\"Ann, B.\",40\r\n\
             # pause\r\n\r\n\
             8,1,NA,n/a,,-,STUCK,,-\r\n",
        );
        assert!(data.rejected.is_empty(), "{:?}", data.rejected);
        assert_eq!((data.file.as_str(), data.read), ("t.csv", 2));
        assert_eq!(data.given, ["v_n", "T_p"]);
        let first = data.rows[0];
        let expected = Impact { normal_speed: 2.5, particle_temperature: 350.0, ..Impact::default() };
        assert_eq!((first.line, first.impact, first.captured), (2, expected, Some(0.0)));
        assert_eq!(first.e_n, Some(Reading { value: 0.4, error: Some(0.02) }));
        assert_eq!((first.e_t, first.impacts, first.rebounds), (exact(-0.1), 1.0, 1.0));
        let second = data.rows[1];
        assert_eq!((second.line, second.impact.particle_temperature), (5, 293.15));
        assert_eq!((second.stated[0], second.stated[3]), (true, false));
        assert_eq!((second.captured, second.e_n, second.rebounds), (Some(1.0), None, 0.0));
        let names: Vec<&str> = data.columns.iter().map(|column| column.name.as_str()).collect();
        assert_eq!(names, ["series", "operator", "humidity"]);
        assert_eq!(data.columns[0].values, words(&["7", "8"], &[Some(0), Some(1)]));
        assert_eq!(data.columns[1].values, words(&["Ann, B."], &[Some(0), None]));
        let ColumnValues::Numbers(humidity) = &data.columns[2].values else { unreachable!() };
        assert!(humidity[0] == 40.0 && humidity[1].is_nan());
        assert!(
            data.notes.iter().any(|note| note.contains("T_p is blank in 1 of 2 rows, taken as 293.15 K"))
        );
        assert!(data.notes.iter().any(|note| note.contains("assumed: d = 0.0001 m")), "{:?}", data.notes);
    }

    #[test]
    fn identities_of_parcels_are_no_causes() {
        let record = "v_n,e_n,origProcId,origId,parcel_age,n_particles,mass\n1,0.5,0,7,0.1,50,1e-6\n";
        let names = |data: &Measurements| -> Vec<String> {
            data.columns.iter().map(|column| column.name.clone()).collect()
        };
        let data = read(record);
        assert_eq!(names(&data), ["mass"]);
        assert!(
            data.notes.iter().any(|note| note.contains("origProcId, origId") && note.contains("no possible"))
        );
        let labelled = mapped(record, "[labels]\ncolumns = [\"origId\"]\n");
        assert_eq!(names(&labelled), ["origId", "mass"]);
        // Of a laboratory's own file one of the names may be a cause.
        assert_eq!(names(&read("v_n,e_n,n_particles\n1,0.5,3\n")), ["n_particles"]);
    }

    #[test]
    fn bad_rows_are_listed_and_leave_no_cell_behind() {
        let data = read(
            "v_n,d,e_n,e_t,outcome,e_n_err,note\n\
             1,,0.5,,,,kept\n\
             1,,-0.1,,,,a\n\
             1,,high,,,,b\n\
             1,,0.5,,,,c,d\n\
             1,,inf,,,,e\n\
             nan,,0.5,,,,f\n\
             -1,,0.5,,,,g\n\
             1,0,0.5,,,,h\n\
             1,,3.5,,,,i\n\
             1,,,-3.5,,,j\n\
             1,,0.5,,melted,,k\n\
             1,,,,,,l\n\
             1,,0.5,,,-1,m\n\
             inf,,0.5,,,,n\n\
             1,,\"0,5\",,,,o\n",
        );
        assert_eq!((data.read, data.rows.len()), (15, 1));
        assert_eq!(data.columns[0].values, words(&["kept"], &[Some(0)]));
        assert_eq!(
            reasons(&data),
            [
                "3: e_n is negative",
                "4: e_n `high` is not a number",
                "5: the row has 8 cells, the header 7",
                "6: e_n is not finite",
                "7: v_n is blank",
                "8: v_n = -1: must be finite and not negative",
                "9: d = 0: must be positive and finite",
                "10: e_n is 3.5, above 3; check its unit",
                "11: e_t is -3.5, below -3",
                "12: outcome `melted` is unknown; use one of rebound, bounce, stick, stuck, captured",
                "13: the row has no observation: all columns of observations are blank",
                "14: e_n_err is negative",
                "15: v_n = inf: must be finite and not negative",
                "16: e_n `0,5` is not a number; for a decimal comma set decimal = \",\" in the column map",
            ]
        );
    }

    #[test]
    fn no_rebound_is_capture_and_capture_is_no_rebound() {
        let data = read(
            "v_n,e_n,e_t,outcome\n1,0,,\n1,0,0,\n1,0,0.3,\n1,0,0,rebound\n1,9,x,stick\n1,0.5,,\n1,,0,\n",
        );
        let seen: Vec<_> = data.rows.iter().map(|row| (row.captured, row.e_n, row.e_t)).collect();
        assert_eq!(
            seen,
            [
                (Some(1.0), None, None),
                (Some(1.0), None, None),
                (None, exact(0.0), exact(0.3)),
                (Some(0.0), exact(0.0), exact(0.0)),
                (Some(1.0), None, None),
                // Where captures are recorded, a rebound is one although no outcome says so.
                (Some(0.0), exact(0.5), None),
                (None, None, exact(0.0)),
            ]
        );
        let without = read("v_n,e_n,n_impacts\n1,0.5,\n1,0.5,10\n");
        assert!(without.rows.iter().all(|row| row.captured.is_none()));
        assert_eq!(
            without.rows.iter().map(Measurement::is_unstated_rebound).collect::<Vec<_>>(),
            [true, false]
        );
    }

    #[test]
    fn averages_stand_for_their_impacts() {
        let data = read(
            "v_n,n_impacts,captured,capture_efficiency,e_n,outcome\n\
             1,10,4,,0.5,\n1,10,,0.25,0.5,\n1,10,,,0.5,\n1,10,10,,0.5,stick\n1,3,1,0.33,,\n\
             1,,,0.4,0.5,\n1,100,,0.999,0.5,\n\
             1,10,11,,,\n1,10,,1.2,,\n1,10,,-0.1,,\n1,10,3,0.5,,\n1,2.5,,0.5,,\n1,0,,,0.5,\n1,10,1.5,,,\n\
             1,,5,,,\n1,10,,,0.5,stick\n1,10,4,,,rebound\n1,1,,0.4,,\n",
        );
        let seen: Vec<_> = data.rows.iter().map(|row| (row.impacts, row.captured, row.rebounds)).collect();
        assert_eq!(
            seen,
            [
                (10.0, Some(0.4), 6.0),
                (10.0, Some(0.25), 7.5),
                (10.0, None, 10.0),
                (10.0, Some(1.0), 0.0),
                (3.0, Some(1.0 / 3.0), 3.0 * (1.0 - 1.0 / 3.0)),
                (1.0, Some(0.4), 1.0),
                (100.0, Some(0.999), 1.0),
            ]
        );
        assert_eq!(data.rows[3].e_n, None);
        assert!(
            data.notes.iter().any(|note| note.contains("in 1 of 7 rows capture_efficiency is given without"))
        );
        assert_eq!(
            reasons(&data),
            [
                "9: captured is 11, more than n_impacts = 10",
                "10: capture_efficiency is 1.2; it must be between 0 and 1",
                "11: capture_efficiency is -0.1; it must be between 0 and 1",
                "12: captured / n_impacts is 0.3000, but capture_efficiency is 0.5",
                "13: n_impacts is 2.5; it must be a whole number from 1",
                "14: n_impacts is 0; it must be a whole number from 1",
                "15: captured is 1.5; it must be a whole number from 0",
                "16: captured is 5, but n_impacts is blank",
                "17: one outcome cannot describe 10 impacts; give captured or capture_efficiency",
                "18: outcome is rebound, but the captured share is 0.4",
                "19: capture_efficiency is 0.4, but n_impacts is 1",
            ]
        );
    }

    const GERMAN: &str = "separator = \";\"\ndecimal = \",\"\nheader_line = 2\n[columns]\n\
        d = { column = \"Größe\", unit = \"µm\" }\nT_p = { column = \"temp\", unit = \"C\" }\n\
        e_n = { column = \"COR_n\", unit = \"%\" }\nspeed = { column = \"V\", unit = \"cm/s\" }\n\
        angle = { column = \"theta\", unit = \"deg\", from = \"normal\" }\n\
        outcome = { column = \"result\", rebound = [\"Abprall\"], stick = [\"haftet\", \"-\"] }\n\
        [ignore]\ncolumns = [\"row id\"]\n[labels]\ncolumns = [\"plate\"]\n";

    #[test]
    fn a_laboratorys_own_file_is_read_untouched() {
        let data = mapped(
            "Prüfstand 3; \"2024\r\nrow id;Größe;temp;COR_n;V;theta;result;plate;rate;row id;;\r\n\
             1;75;20;35,5;200;0;ABPRALL;01;1,5;1;;\r\n2;;-10;;200;90;-;1;-2;2;;\r\n3;75;20;1.5;200;30;;1;1;3;;\r\n",
            GERMAN,
        );
        assert_eq!(
            reasons(&data),
            [
                "5: e_n `1.5` is not a number; numbers have decimal commas here, or set decimal = \".\" in the column \
                    map"
            ]
        );
        let [first, second] = data.rows[..] else { unreachable!() };
        let expected = Impact { normal_speed: 2.0, diameter: 75e-6, ..Impact::default() };
        assert_eq!((first.line, first.impact, first.e_n), (3, expected, exact(0.355)));
        assert_eq!((second.impact.normal_speed, second.impact.tangential_speed), (0.0, 2.0));
        assert_eq!((second.impact.particle_temperature, second.captured), (263.15, Some(1.0)));
        assert_eq!(data.given, ["v_n", "v_t", "d", "T_p"]);
        assert_eq!(data.columns.len(), 2, "{:?}", data.columns);
        assert_eq!(data.columns[0].values, words(&["01", "1"], &[Some(0), Some(1)]));
        assert_eq!(data.columns[1].values, ColumnValues::Numbers(vec![1.5, -2.0]));
        assert!(data.notes.iter().any(|note| note == "2 columns without a name are not used"));
    }

    /// Four rows in nearwall's own format, and as the programs of laboratories write them.
    #[test]
    fn files_of_laboratories_are_read_without_a_column_map() {
        let plain = "v_n,d,T_p,T_p_err,e_n,outcome,temper\n1.5,7.5e-5,293.15,2,0.5,rebound,0.5\n\
                     2,5e-5,300.65,2,,stick,1.5\n";
        let same = |bytes: &[u8], notes: &[&str]| {
            let [expected, found] = [plain.as_bytes(), bytes].map(|bytes| try_read(bytes, "", None).unwrap());
            let text = String::from_utf8_lossy(bytes);
            assert_eq!(found.rejected, [], "{text}");
            for (row, expected) in found.rows.iter().zip(&expected.rows) {
                assert_eq!(
                    (row.e_n, row.captured, row.stated),
                    (expected.e_n, expected.captured, expected.stated)
                );
                assert_eq!(row.input_errors, expected.input_errors, "{text}");
                for input in &INPUTS {
                    let [one, other] = [row, expected].map(|row| (input.value)(&row.impact));
                    assert!((one - other).abs() <= 1e-12 * other.abs(), "{}: {one}, {other}", input.name);
                }
            }
            assert_eq!((found.rows.len(), &found.columns), (2, &expected.columns), "{text}");
            for note in notes {
                assert!(found.notes.iter().any(|one| one == note), "`{note}` is not in {:#?}", found.notes);
            }
        };
        same(plain.as_bytes(), &[]);
        let german = "v_n;d;T_p;T_p_err;e_n;outcome;temper\n1,5;7,5e-5;293,15;2;0,5;rebound;0,5\n\
                      2;5e-5;300,65;2;;stick;1,5\n";
        same(german.as_bytes(), &["read with semicolons and decimal commas"]);
        same(plain.replace(',', "\t").as_bytes(), &["read with tabs"]);
        same(german.replace(';', "\t").as_bytes(), &["read with tabs and decimal commas"]);
        for order in [u16::to_le_bytes, u16::to_be_bytes] {
            let bytes: Vec<u8> = german.encode_utf16().flat_map(order).collect();
            same(&bytes, &["read as UTF-16", "read with semicolons and decimal commas"]);
        }
        let units = "v_n [cm/s],d (um),T_p [C],T_p_err [F],e_n [%],outcome,temper\n150,75,20,3.6,50,rebound,0.5\n\
                     200,50,27.5,3.6,,stick,1.5\n";
        same(
            units.as_bytes(),
            &["column `d (um)` is read as d in um", "column `e_n [%]` is read as e_n in %"],
        );
        let row = "V_N,d,T_P,t_p_err,E_N,Outcome,temper\ncm/s,µm,C,F,%,-,-\n150,75,20,3.6,50,rebound,0.5\n\
                   200,50,27.5,3.6,,stick,1.5\n";
        same(row.as_bytes(), &["line 2 states units", "column `V_N [cm/s]` is read as v_n in cm/s"]);
        let latin: Vec<u8> = row.chars().map(|mark| mark as u8).collect();
        same(&latin, &["read as windows-1252, because it is not UTF-8"]);
    }

    #[test]
    fn what_a_column_map_states_takes_precedence_over_headings() {
        let data = mapped(
            "v_n;d [um];e_n;D\n1,5;75;0,5;3\n",
            "decimal = \",\"\n[columns]\nd = { column = \"d [um]\", unit = \"mm\" }\n",
        );
        assert_eq!(data.rows[0].impact.diameter, 0.075);
        assert_eq!(data.columns.len(), 1, "a single capital is another quantity");
        let text = "v_n,size,e_n\nm/s,um,-\n1,75,0.5\n";
        let data = mapped(text, "[columns]\nd = { column = \"size\", unit = \"mm\" }\n");
        assert_eq!((data.rows[0].impact.diameter, data.read), (0.075, 1));
        let text = "v_n,e_n,wall (old),Wall\n1,0.5,x,roof\n";
        assert_eq!(read(text).rows[0].wall, 0, "other words in brackets and capitals of words are causes");
    }

    #[test]
    fn a_limit_is_a_censored_value() {
        let data = read(
            "v_n,e_n,e_n_err,e_t,outcome\n1,<0.2,0.01,,\n1,> 0.9,,<=-0.1,\n1,≥0,,,\n1,<x,,,\n1,<0.2,,0,\n1,<4,,,\n\
             1,<0.2,,,stick\n",
        );
        let limit = |value, error, below| Some(Limit { reading: Reading { value, error }, below });
        let limits: Vec<_> = data.rows.iter().map(|row| row.limits).collect();
        assert_eq!(limits[0], [limit(0.2, Some(0.01), true), None]);
        assert_eq!(limits[1], [limit(0.9, None, false), limit(-0.1, None, true)]);
        assert_eq!(limits[2], [limit(0.0, None, false), None]);
        assert_eq!((limits[4], data.rows[4].captured), ([None; 2], Some(1.0)));
        assert_eq!(data.rows[3].captured, None, "below 0.2 may be captured, and e_t = 0 too");
        assert!(data.rows.iter().all(|row| row.e_n.is_none()));
        assert_eq!(reasons(&data), ["5: e_n `<x` is not a number", "7: e_n is 4, above 3; check its unit"]);
        let rebounds: Vec<Option<f64>> = data.rows.iter().map(|row| row.captured).collect();
        assert_eq!(rebounds, [None, Some(0.0), Some(0.0), None, Some(1.0)]);
    }

    #[test]
    fn angles_give_the_other_speed() {
        let speeds = |key: &str, unit: &str, from: &str, cells: &str| {
            let map = format!(
                "[columns]\n{key} = \"V\"\nangle = {{ column = \"a\", unit = \"{unit}\", from = \"{from}\" }}\n"
            );
            let data = mapped(&format!("V,a,e_n\n{cells},0.5\n"), &map);
            match data.rows.first() {
                Some(row) => Ok((row.impact.normal_speed, row.impact.tangential_speed)),
                None => Err(data.rejected[0].reason.clone()),
            }
        };
        let near = |found: Result<(f64, f64), String>, v_n: f64, v_t: f64| {
            let (n, t) = found.unwrap();
            assert!((n - v_n).abs() < 1e-12 && (t - v_t).abs() < 1e-12, "{n}, {t}");
        };
        near(speeds("speed", "deg", "surface", "2,30"), 1.0, 3f64.sqrt());
        near(speeds("speed", "deg", "normal", "2,30"), 3f64.sqrt(), 1.0);
        near(speeds("v_n", "deg", "surface", "2,45"), 2.0, 2.0);
        near(speeds("v_t", "deg", "normal", "1,30"), 3f64.sqrt(), 1.0);
        assert_eq!(speeds("speed", "rad", "surface", "2,1.5708"), Ok((2.0, 0.0)));
        assert_eq!(speeds("v_n", "deg", "normal", "2,"), Ok((2.0, 0.0)));
        assert!(speeds("v_n", "deg", "surface", "2,0").unwrap_err().contains("v_n is 0 at this angle"));
        assert!(speeds("v_t", "deg", "normal", "2,0").unwrap_err().contains("v_t is 0 at this angle"));
        assert!(speeds("speed", "deg", "normal", "2,120").unwrap_err().contains("angle = 120°"));
        assert_eq!(speeds("speed", "deg", "normal", "2,"), Err("angle is blank".to_owned()));
        assert_eq!(speeds("speed", "deg", "normal", "-2,3"), Err("speed is negative".to_owned()));
    }

    #[test]
    fn headers_at_fault_are_named_with_the_remedy() {
        let part = |text: &str, map: &str, part: &str| {
            let message = refused(text, map);
            assert!(message.contains(part), "`{part}` is not in: {message}");
        };
        part("v_n,e_n\n# 1,2\n", "", "t.csv: there is no row under the header");
        part("speed,e_n\n1,1\n", "", "no column `v_n`");
        part(
            "v_n,d [furlong],e_n\n1,1,1\n",
            "",
            "t.csv:1: column `d [furlong]`: unknown unit `furlong`; use one of m,",
        );
        part("d [um],d [mm],v_n,e_n\n1,1,1,1\n", "", "columns `d [um]` and `d [mm]` both mean d; rename one");
        part(
            "v_n,d,e_n\nm/s,furlong,-\n1,1,1\n",
            "",
            "t.csv:2: the row states units, but `furlong` is no unit of d",
        );
        part("v_n,d,e_n\n1,5,75,0,5\n", "", "t.csv:2: more cells than the header");
        part("v_n,d,e_n\n1,1e-4,1\n1,88,0.5\n", "", "t.csv:3: d = 88 m: no length of an impact");
        part(
            "v_n,d [mm],e_n\n1,1e4,1\n",
            "",
            "state the unit, as `d [um]` in the heading or in a column map",
        );
        part("v_n,humidity\n1,1\n", "", "the file has no observation; add a column e_n, e_t, outcome");
        part("Vn (m/s),e_n\n1,1\n", "[columns]\nv_n = \"Vn [m/s]\"\n", "did you mean `Vn (m/s)`?");
        part("V,v_n,e_n\n1,1,1\n", "[columns]\nv_n = \"V\"\n", "a column `v_n` exists too");
        part("V,e_n\n1,1\n", "[columns]\nspeed = \"V\"\n", "speed alone does not determine");
        part("V,v_n,e_n\n1,1,1\n", "[columns]\nspeed = \"V\"\n", "v_n, speed over-determine the velocity");
        assert!(refused("v_n,e_n\n1,1\n", "[ignore]\ncolumns = [\"e_n\"]\n").contains("has no observation"));
    }

    #[test]
    fn a_column_may_be_called_like_another_quantity() {
        let data = mapped("v_n,e_n,V\n5,0.5,3\n", "[columns]\nv_n = \"V\"\nv_t = \"v_n\"\n");
        assert_eq!((data.rows[0].impact.normal_speed, data.rows[0].impact.tangential_speed), (3.0, 5.0));
    }

    #[test]
    fn walls_are_chosen_as_in_predict_and_may_be_causes() {
        let text = "v_n,e_n,wall\n1,0.5,roof\n1,0.5,\n1,0.5,floor\n1,0.5,NA\n";
        let data = read(text);
        assert_eq!(data.rows.iter().map(|row| row.wall).collect::<Vec<_>>(), [1, 0, 0, 0]);
        assert_eq!(data.columns[0].values, words(&["floor", "roof"], &[Some(1), None, Some(0), None]));
        let data = try_read(text.as_bytes(), "", Some("roof")).unwrap();
        assert!(data.rows.iter().all(|row| row.wall == 1));
        assert!(read("v_n,e_n,wall\n1,0.5,roof\n1,0.4,roof\n").columns.is_empty());
        assert!(matches!(try_read(b"v_n,e_n\n1,1\n", "", Some("door")), Err(DatasetError::Wall(_))));
    }

    #[test]
    fn an_unterminated_quotation_mark_is_reported() {
        let data = read("v_n,e_n,note\n1,0.5,fine\n1,0.4,\"broken\n1,0.3,lost\n1,0.2,lost\n");
        assert_eq!(data.rows.len(), 1);
        assert!(reasons(&data)[0].starts_with("3: unterminated quotation mark"), "{:?}", data.rejected);
        let data = read("v_n,e_n,note\n1,0.5,\n1,\"0.4,broken\n1,0.3,lost");
        assert!(
            reasons(&data)[0].starts_with("3: the row has 2 cells, the header 3; a quoted cell continues")
        );
        let data = read("v_n,e_n,note\n1,0.5,\"two\nlines\"\n1,0.4,\n");
        assert_eq!((data.rows.len(), data.rows[1].line), (2, 4));
    }

    /// The stated input errors of a row by name.
    fn errors(data: &Measurements, row: usize) -> Vec<(&'static str, f64)> {
        data.rows[row].input_errors.each().map(|(input, error)| (input.name, error)).collect()
    }

    #[test]
    fn standard_errors_of_inputs_are_no_causes() {
        let data = read(
            "v_n,d,T_p,e_n,v_n_err,v_t_err,d_err,T_p_err,T_w_err\n\
             2,1e-4,350,0.5,0.1,0.2,5e-6,3,4\n2,1e-4,350,0.5,,,0,,\n2,1e-4,350,0.5,-0.1,,,,\n\
             2,1e-4,350,0.5,,,inf,,\n2,1e-4,350,0.5,,,,x,\n2,1e-4,350,0.5,,,75,,\n",
        );
        let all = [("v_n", 0.1), ("v_t", 0.2), ("d", 5e-6), ("T_p", 3.0), ("T_w", 4.0)];
        assert_eq!(errors(&data, 0), all);
        assert_eq!((errors(&data, 1), data.rows[1].input_errors.of("d")), (vec![], 0.0));
        assert_eq!(data.rows[0].input_errors.of("T_w"), 4.0);
        assert_eq!(
            reasons(&data),
            ["4: v_n_err is negative", "5: d_err is not finite", "6: T_p_err `x` is not a number"]
        );
        assert!(data.columns.is_empty() && data.given == ["v_n", "d", "T_p"], "{:?}", data.columns);
        for part in [
            "the standard error of v_n is given in 1 of 3 rows; in the others v_n counts as exact",
            "in 1 of 3 rows d_err is above d; check its unit",
        ] {
            assert!(data.notes.iter().any(|note| note == part), "`{part}` is not in {:#?}", data.notes);
        }
        assert!(!data.notes.iter().any(|note| note.contains("possible cause")), "{:#?}", data.notes);
    }

    #[test]
    fn standard_errors_have_units_without_offset() {
        let data = mapped(
            "V,size,temp,e_n,dV,dsize,dtemp\n200,75,20,0.5,10,5,9\n",
            "[columns]\nv_n = { column = \"V\", unit = \"cm/s\" }\nd = { column = \"size\", unit = \"um\" }\n\
             T_p = { column = \"temp\", unit = \"C\" }\nv_n_err = { column = \"dV\", unit = \"cm/s\" }\n\
             d_err = { column = \"dsize\", unit = \"um\" }\nT_p_err = { column = \"dtemp\", unit = \"F\" }\n",
        );
        assert_eq!(errors(&data, 0), [("v_n", 0.1), ("d", 5e-6), ("T_p", 5.0)]);
        assert_eq!(data.rows[0].impact.particle_temperature, 293.15);
    }

    #[test]
    fn errors_of_speed_and_angle_are_propagated() {
        let errors = |columns: &str, row: &str, speed: &str| {
            let map = format!(
                "[columns]\n{speed} = \"V\"\n{}\
                 angle = {{ column = \"a\", unit = \"deg\", from = \"surface\" }}\n\
                 angle_err = {{ column = \"da\", unit = \"rad\" }}\n",
                if speed == "speed" { "speed_err = \"dV\"\n" } else { "" }
            );
            let data = mapped(&format!("V,a,e_n,{columns}\n{row}\n"), &map);
            assert_eq!(data.rejected, []);
            ["v_n", "v_t"].map(|name| data.rows[0].input_errors.of(name))
        };
        let near = |found: [f64; 2], expected: [f64; 2]| {
            assert!(
                found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 1e-12),
                "{found:?}, {expected:?}"
            );
        };
        let root = 3f64.sqrt();
        // 2 m/s at 30 degrees: v_n = 1, v_t = sqrt 3; d v_n = dV / 2 and dv_n = v_t da; dv_t = dV
        // sqrt 3 / 2 and v_n da.
        near(errors("dV,da", "2,30,0.5,0.2,0", "speed"), [0.1, 0.1 * root]);
        near(errors("dV,da", "2,30,0.5,,0.01", "speed"), [0.01 * root, 0.01]);
        near(errors("dV,da", "2,30,0.5,0.2,0.1", "speed"), [0.04f64.sqrt(), 0.04f64.sqrt()]);
        near(errors("dV,da", "0,30,0.5,0.2,0.1", "speed"), [0.0, 0.0]);
        // An error of v_n itself is taken as it is; a blank one is propagated.
        near(errors("dV,da,v_n_err", "2,30,0.5,0.2,0,0.3", "speed"), [0.3, 0.1 * root]);
        near(errors("dV,da,v_n_err", "2,30,0.5,0.2,0,", "speed"), [0.1, 0.1 * root]);
        // v_t = v_n / tan a: at 45 degrees dv_t = dv_n, and 2 v_n da.
        near(errors("da,v_n_err", "1,45,0.5,0,0.1", "v_n"), [0.1, 0.1]);
        near(errors("da,v_n_err", "1,45,0.5,0.01,", "v_n"), [0.0, 0.02]);
        near(errors("da,v_t_err", "1,45,0.5,0.01,0.1", "v_t"), [0.0104f64.sqrt(), 0.1]);
    }

    #[test]
    fn columns_of_groups_are_labels() {
        let map = "[columns]\nseries = \"plate\"\n";
        let model = Model::from_toml("m.toml", MODEL).unwrap();
        let text = "v_n,e_n,Batch,rig,plate,humidity\n1,0.5,1,1,7,30\n1,0.5,2,,8,40\n";
        let grouped = |column: &str| {
            let mut map = ColumnMap::from_toml("map.toml", map).unwrap();
            let name = map.label(column);
            let walls = WallChoice::new(&model, None).unwrap();
            let data = Measurements::read("t.csv", text.as_bytes(), Some(&map), &walls).unwrap();
            data.check_group(&name).map(|()| (name, data)).map_err(|error| error.to_string())
        };
        let (name, data) = grouped("rig").unwrap();
        let column = |wanted: &str| data.columns.iter().find(|column| column.name == wanted).unwrap();
        assert_eq!((name.as_str(), &column("rig").values), ("rig", &words(&["1"], &[Some(0), None])));
        assert_eq!(column("Batch").values, words(&["1", "2"], &[Some(0), Some(1)]));
        assert_eq!(column("humidity").values, ColumnValues::Numbers(vec![30.0, 40.0]));
        // A mapped column may be named as in the file or as in nearwall.
        assert_eq!(["plate", "series"].map(|column| grouped(column).unwrap().0), ["series", "series"]);
        assert!(!data.notes.iter().any(|note| note.contains("does not exist")), "{:?}", data.notes);
        let error = grouped("batsch").unwrap_err();
        assert!(error.starts_with("t.csv: unknown group column `batsch`"), "{error}");
        assert!(error.contains("(known here: Batch, series)"), "{error}");
        assert!(grouped("v_n").unwrap_err().contains("`v_n` is an input and cannot be the group"));
    }

    #[test]
    fn rebounds_below_the_detection_limit_and_missing_errors_are_noted() {
        let data = mapped(
            "v_n,e_n,e_n_err\n1,0.3,0.01\n1,0.1,0.01\n0.2,0.4,\n",
            "[detection]\ne_n = 0.2\nrebound_speed = 0.1\n",
        );
        assert_eq!(
            (data.rows.len(), data.detection.e_n, data.detection.rebound_speed),
            (3, Some(0.2), Some(0.1))
        );
        for part in [
            "in 2 of 3 rows e_n is below the detection limit of the column map; check the limit",
            "e_n_err is given in 2 of 3 rows with e_n, unknown in the others",
        ] {
            assert!(data.notes.iter().any(|note| note == part), "`{part}` is not in {:#?}", data.notes);
        }
    }

    #[test]
    fn likely_mistakes_are_noted() {
        let data = mapped(
            "v_n,Tp,T_w,en,e_n,e_n_err,angle,dirt\n1,300,20,0.3,1.2,0,30,1\n1,300,20,0.3,0.5,0.1,30,2\n1,1,20,1,1,,1,<1\n",
            "[ignore]\ncolumns = [\"gone\"]\n",
        );
        for part in [
            "column `Tp` is only a possible cause; rename it if it is the input `T_p`",
            "column `angle` is only a possible cause; a column map can convert it to v_n and v_t",
            "the column map names a column `gone`",
            "20 K; is that °C?",
            "in 1 of 3 rows e_n is above 1",
            "in 1 of 3 rows a standard error is 0",
            "column `dirt` is read as text because `<1` on line 4 is not a number",
        ] {
            assert!(
                data.notes.iter().any(|note| note.contains(part)),
                "`{part}` is not in {:#?}",
                data.notes
            );
        }
        assert_eq!(data.rows[0].e_n, exact(1.2));
    }

    #[test]
    fn the_examples_of_the_page_are_read() {
        let page = include_str!("../../../docs/reference/data-file.md");
        let data = read(page.split("```\n").nth(1).unwrap());
        assert_eq!((data.rows.len(), data.rejected.len(), data.columns.len()), (2, 0, 2));
        let data = mapped(
            "Rig\n\nwall temperature;size;temp;COR_n;V;theta;result;row id;plate;dV;dtheta;dsize\n% pause\n\
             300;75;20;41,5;2;0;1;1;7;0,1;0;5\n300;75;20;41,5;2;0;Bounced;2;7;0,1;0;5\n",
            page.split("```toml\n").nth(1).unwrap().split("```").next().unwrap(),
        );
        assert_eq!(data.rejected, []);
        assert_eq!((data.rows[0].captured, data.rows[1].e_n), (Some(1.0), exact(0.415)));
        assert_eq!((data.rows[1].line, data.rows[1].impact.wall_temperature), (6, 300.0));
        assert_eq!(errors(&data, 0), [("v_n", 0.1), ("d", 5e-6)]);
        assert_eq!((data.detection.e_n, data.detection.rebound_speed), (Some(0.2), Some(0.05)));
        assert_eq!(
            data.columns,
            [DataColumn { name: "plate".into(), unit: "", values: words(&["7"], &[Some(0), Some(0)]) }]
        );
    }

    /// 100,000 rows of 30 columns; run with `cargo test --release -- --ignored --nocapture`.
    #[test]
    #[ignore = "a measurement of time"]
    fn a_large_file_is_read_in_about_a_second() {
        let mut text = "v_n,d,T_p,e_n,outcome".to_owned();
        (0..25).for_each(|column| text += &format!(",c{column}"));
        for row in 0..100_000 {
            text += &format!("\n{}.5,75e-6,350.25,0.4{},rebound", row % 7, row % 10);
            (0..25).for_each(|column| text += &format!(",{}.25", row * column % 1013));
        }
        let start = std::time::Instant::now();
        let data = read(&text);
        println!("{} rows, {} bytes: {:?}", data.rows.len(), text.len(), start.elapsed());
        assert_eq!(data.rows.len(), 100_000);
    }
}
