//! Lines of a file that repeat an earlier one, as where a table was pasted twice: they count once.
//!
//! Replicates can coincide by rounding. So lines are copies only where every restitution at their inputs occurs at
//! least twice, and only in a file in which this holds for three inputs, and for at least half of those with several
//! restitutions. A capture has no restitution to be told by: of captures at equal inputs as many stay as the table was
//! pasted less often.

use std::collections::BTreeMap;

use super::constants::LEAST_ROWS;
use crate::dataset::{Measurement, Measurements};

/// The bits of some numbers.
type Bits = Vec<u64>;
/// A line of a file, and whether it states a restitution.
type Line = (u64, bool);

/// The data without lines that repeat an earlier one.
pub(super) fn without_copies(data: &Measurements) -> Measurements {
    let first = first_lines(data);
    data.without(|row| {
        first.get(&row.line).map(|first| format!("it repeats line {first}, which counts once"))
    })
}

/// The earlier line of each one that repeats it.
fn first_lines(data: &Measurements) -> BTreeMap<u64, u64> {
    let at_inputs = lines(data);
    let restitutions = |at: &&BTreeMap<Bits, Vec<Line>>| -> Vec<usize> {
        at.values().filter(|lines| lines[0].1).map(Vec::len).collect()
    };
    let several: Vec<Vec<usize>> =
        at_inputs.values().map(|at| restitutions(&at)).filter(|one| one.iter().sum::<usize>() > 1).collect();
    let pasted = |counts: &Vec<usize>| counts.iter().all(|count| *count > 1);
    let repeated: Vec<&Vec<usize>> = several.iter().filter(|counts| pasted(counts)).collect();
    let Some(times) = repeated.iter().copied().flatten().min() else { return BTreeMap::new() };
    if repeated.len() < LEAST_ROWS || 2 * repeated.len() < several.len() {
        return BTreeMap::new();
    }
    let at_copies = at_inputs.values().filter(|at| pasted(&restitutions(at)));
    let lines = at_copies.flat_map(BTreeMap::values);
    let copies = lines.flat_map(|lines| {
        let originals = lines.len().div_ceil(*times);
        let copy = move |(place, line): (usize, &Line)| (line.0, lines[place % originals].0);
        lines.iter().enumerate().skip(originals).map(copy)
    });
    copies.collect()
}

/// The lines with each reading at each of the inputs.
fn lines(data: &Measurements) -> BTreeMap<Bits, BTreeMap<Bits, Vec<Line>>> {
    let mut lines: BTreeMap<Line, [Bits; 2]> = BTreeMap::new();
    for row in &data.rows {
        let [inputs, readings] = lines.entry((row.line, row.e_n.is_some() || row.e_t.is_some())).or_default();
        inputs.extend(nearwall::impact::INPUTS.iter().map(|input| (input.value)(&row.impact).to_bits()));
        readings.extend(numbers_read(row));
    }
    let mut all: BTreeMap<Bits, BTreeMap<Bits, Vec<Line>>> = BTreeMap::new();
    for (line, [inputs, readings]) in lines {
        all.entry(inputs).or_default().entry(readings).or_default().push(line);
    }
    all
}

/// What was measured in a row, and of how many impacts.
fn numbers_read(row: &Measurement) -> Bits {
    let readings = [row.e_n, row.e_t].map(|one| one.map_or(f64::NAN, |one| one.value));
    let all = [readings[0], readings[1], row.captured.unwrap_or(f64::NAN), row.impacts];
    all.map(f64::to_bits).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::WallChoice;
    use nearwall::model::Model;

    fn kept(rows: &[&str]) -> Vec<u64> {
        let text = format!("v_n,T_p,e_n,outcome\n{}\n", rows.join("\n"));
        let model = Model::from_toml(
            "m.toml",
            "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n[normal]\n\
             model = \"constant\"\ne_n = 0.5\n[tangential]\nmodel = \"constant\"\ne_t = 0.8\n",
        );
        let model = model.unwrap();
        let walls = WallChoice::new(&model, None).unwrap();
        let data = Measurements::read("t.csv", text.as_bytes(), None, &walls).unwrap();
        without_copies(&data).rows.iter().map(|row| row.line).collect()
    }

    const TABLE: [&str; 4] =
        ["1,300,0.51,rebound", "2,300,0.47,rebound", "3,300,,captured", "4,300,0.4,rebound"];

    #[test]
    fn a_table_pasted_three_times_counts_once() {
        assert_eq!(kept(&[TABLE, TABLE, TABLE].concat()), [2, 3, 4, 5]);
        assert_eq!(kept(&TABLE), [2, 3, 4, 5]);
    }

    #[test]
    fn replicates_that_coincide_and_captures_at_equal_inputs_stay() {
        let replicates = [
            "1,300,0.5,rebound",
            "1,300,0.5,rebound",
            "1,300,0.4,rebound",
            "2,300,,captured",
            "2,300,,captured",
        ];
        assert_eq!(kept(&replicates).len(), 5);
        let twice = [["2,300,,captured"; 3].as_slice(), &TABLE].concat();
        assert_eq!(kept(&[twice.clone(), twice].concat()).len(), 7);
    }
}
