//! Reads a file of any size in bounded memory. Rows that are not selected still count in the errors of the base model.

use std::io::Read;

use super::data_split::{COARSE_DRAWS, DataSplit};
use super::evaluation::Evaluation;
use super::{fault, gain};
use crate::dataset::{ColumnMap, DatasetError, MOST_ROWS, Measurement, Measurements, Unselected, WallChoice};
use nearwall::model::Model;

/// Rows that are evaluated together.
const ROWS_AT_ONCE: usize = 25_000;

/// Reads measured impacts in bounded memory: of a file with more than [`crate::dataset::MOST_ROWS`]
/// usable rows a selection, and the sums of the others that [`super::diagnose`] needs. `base` is
/// the model of `walls`.
///
/// # Errors
/// As [`Measurements::read`].
pub fn read_measurements(
    file: &str,
    source: impl Read,
    map: Option<&ColumnMap>,
    walls: &WallChoice<'_>,
    base: &Model,
) -> Result<Measurements, DatasetError> {
    read_at_most(MOST_ROWS, file, source, map, walls, base)
}

/// The same with another largest number of rows.
fn read_at_most(
    most: usize,
    file: &str,
    source: impl Read,
    map: Option<&ColumnMap>,
    walls: &WallChoice<'_>,
    base: &Model,
) -> Result<Measurements, DatasetError> {
    let mut sums =
        UnselectedSums { base, block: Vec::new(), sums: Unselected::default(), stated_errors: false };
    let mut data = Measurements::read_at_most(file, source, map, walls, most, &mut |row| sums.add(row))?;
    sums.evaluate();
    if sums.stated_errors {
        // The errors of the selected rows are those at the expected inputs, which depend on all rows.
        sums.sums.misfits = Default::default();
        data.notes.push("the errors of the base model are those of the selected rows".to_owned());
    }
    data.unselected = sums.sums;
    Ok(data)
}

struct UnselectedSums<'a> {
    base: &'a Model,
    block: Vec<Measurement>,
    sums: Unselected,
    /// Whether a row states errors of its inputs.
    stated_errors: bool,
}

impl UnselectedSums<'_> {
    fn add(&mut self, row: Measurement) {
        if fault(self.base, &row).is_some() {
            return;
        }
        self.sums.rows += 1;
        self.stated_errors |= row.input_errors.each().next().is_some();
        self.block.push(row);
        if self.block.len() == ROWS_AT_ONCE {
            self.evaluate();
        }
    }

    /// Adds the errors of the block.
    fn evaluate(&mut self) {
        let split = DataSplit::bare(self.base, &self.block, COARSE_DRAWS);
        let rows = Evaluation::new(&split, self.base, split.all(), split.noise.to_vec(), [0.0; 2]);
        for (sum, more) in self.sums.misfits.iter_mut().zip(gain::misfits(&rows)) {
            *sum = (sum.0 + more.0, sum.1 + more.1);
        }
        self.block.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Diagnosis, Options, diagnose};
    use super::*;
    use nearwall::impact::Impact;
    use nearwall::rng::ImpactRng;
    use std::fmt::Write;

    const BASE: &str = "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n\
        [normal]\nmodel = \"thornton-ning\"\nyield_ratio = 0.7\n[tangential]\nmodel = \"constant\"\ne_t = 0.76\n";
    const SOFTENING: &str = "[[effects]]\nkind = \"thermal-softening\"\nonset = 310.0\nscale = 80.0\n";

    /// Rows of wax that softens, a tenth of them without a plausible size, with a rare operator and a rare capture.
    fn rows(count: u64) -> String {
        let truth = Model::from_toml("truth.toml", &format!("{BASE}{SOFTENING}")).unwrap();
        let mut text = "v_n,v_t,d,T_p,e_n,outcome,operator,burst\n".to_owned();
        for row in 0..count {
            let draw = |stream| ImpactRng::new(5, row).uniform(stream);
            let impact = Impact {
                normal_speed: 1.5 + 3.0 * draw(0),
                tangential_speed: draw(1),
                diameter: if row % 10 == 9 { 1e-16 } else { 2e-5 + 8e-5 * draw(2) },
                particle_temperature: 300.0 + 60.0 * draw(3),
                ..Impact::default()
            };
            let Impact { normal_speed, tangential_speed, diameter, particle_temperature, .. } = impact;
            let noise = 0.02 * (draw(4) + draw(5) - 1.0);
            let e_n = truth.expect(0, &impact, 1).map_or(0.5, |mean| mean.normal_restitution) + noise;
            let outcome = if row == 1001 { "stick" } else { "" };
            let operator = if row == 1000 { "Bob" } else { "Ann" };
            write!(
                text,
                "{normal_speed},{tangential_speed},{diameter:e},{particle_temperature},{}",
                e_n.max(0.01)
            )
            .unwrap();
            writeln!(text, ",{outcome},{operator},{}", row / 5).unwrap();
        }
        text
    }

    fn read(text: &str, most: usize) -> Measurements {
        let model = Model::from_toml("base.toml", BASE).unwrap();
        let walls = WallChoice::new(&model, None).unwrap();
        read_at_most(most, "t.csv", text.as_bytes(), None, &walls, &model).unwrap()
    }

    fn diagnosed(data: &Measurements) -> Diagnosis {
        let model = Model::from_toml("base.toml", BASE).unwrap();
        diagnose(&model, BASE, data, &Options::default(), &|_| ()).unwrap().0
    }

    #[test]
    fn a_selection_gives_the_errors_counts_and_cause_of_all_rows() {
        let text = rows(2500);
        let [part, all] = [800, usize::MAX].map(|most| diagnosed(&read(&text, most)));
        let near = |a: Option<f64>, b: Option<f64>| (a.unwrap() - b.unwrap()).abs() < 1e-12;
        assert!(near(part.base.rmse_e_n, all.base.rmse_e_n), "{:?} {:?}", part.base, all.base);
        assert!(near(part.base.log_loss_stick, all.base.log_loss_stick));
        assert_eq!((part.rows.read, part.rows.used, part.rows.left_out()), (2500, 2250, 250));
        assert_eq!((all.rows.read, all.rows.used, all.rows.selected), (2500, 2250, None));
        assert!((500..=800).contains(&part.rows.selected.unwrap()), "{:?}", part.rows.selected);
        for diagnosis in [&part, &all] {
            let names: Vec<&str> = diagnosis.findings.iter().map(|finding| finding.cause.as_str()).collect();
            assert_eq!(names, ["thermal-softening"]);
            let onset = diagnosis.findings[0].parameters["onset"];
            assert!((onset.low..=onset.high).contains(&310.0), "{onset:?}");
        }
        let [one, other] = [&part, &all].map(|diagnosis| diagnosis.gain.clone().unwrap().ci95);
        assert!(one[0] < other[1] && other[0] < one[1], "{one:?} and {other:?}");
    }

    #[test]
    fn what_a_selection_leaves_out_is_noted() {
        let data = read(&rows(2500), 800);
        let selected = data.rows.len();
        for part in [
            format!("{selected} of 2500 usable rows were selected at random"),
            "groups of burst".to_owned(),
            "column `operator`: 1 labels are rare and in no selected row: Bob".to_owned(),
            "only 0 of 1 rows with a capture were selected".to_owned(),
        ] {
            assert!(
                data.notes.iter().any(|note| note.contains(&part)),
                "`{part}` is not in {:#?}",
                data.notes
            );
        }
        let whole = read(&rows(2500), 2500);
        assert!(whole.unselected.rows == 0 && !whole.notes.iter().any(|note| note.contains("selected")));
    }
}
