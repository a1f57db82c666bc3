//! Measured rows as readings, each of one observable: a reading counts once, whatever it averages.

use super::super::observable::Observable;
use crate::dataset::Measurement;

/// Number of impacts that marks an average, whose score is that of one impact.
const ONE_OF_AN_AVERAGE: f64 = 1.0 + f64::EPSILON;

/// The readings of a row. Captures of an average score as those of one impact. The scatter of its `e_n` and
/// `e_t` is that of a single reading: it is the error of the prediction, which no average makes smaller.
pub(super) fn readings(row: &Measurement) -> Vec<(Observable, Measurement)> {
    let impacts = if row.impacts > 1.0 { ONE_OF_AN_AVERAGE } else { 1.0 };
    let bare = Measurement { impacts, rebounds: 1.0, e_n: None, e_t: None, captured: None, limits: [None; 2], ..*row };
    let mut readings = Vec::new();
    if row.e_n.is_some() || row.limits[0].is_some() {
        let limits = [row.limits[0], None];
        readings.push((Observable::NormalRestitution, Measurement { e_n: row.e_n, limits, ..bare }));
    }
    if row.e_t.is_some() || row.limits[1].is_some() {
        let limits = [None, row.limits[1]];
        readings.push((Observable::TangentialRestitution, Measurement { e_t: row.e_t, limits, ..bare }));
    }
    // The e_n of a single impact tells that it is a rebound and scores as one.
    let stated = row.captured.filter(|_| row.impacts > 1.0 || row.e_n.is_none());
    if let Some(share) = stated {
        let impacts = ONE_OF_AN_AVERAGE;
        readings.push((Observable::Capture, Measurement { captured: Some(share), impacts, ..bare }));
    }
    readings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::Reading;

    #[test]
    fn a_row_gives_one_reading_for_each_observable() {
        let e_n = Some(Reading { value: 0.4, error: None });
        let row = Measurement { e_n, e_t: e_n, captured: Some(0.3), impacts: 50.0, rebounds: 35.0, ..Measurement::default() };
        let found = readings(&row);
        let kinds: Vec<Observable> = found.iter().map(|(observable, _)| *observable).collect();
        assert_eq!(kinds, Observable::ALL);
        assert!(found.iter().all(|(_, row)| row.impacts > 1.0 && row.impacts < 1.001 && row.rebounds == 1.0));
        let single = Measurement { captured: Some(0.0), impacts: 1.0, ..row };
        assert_eq!(readings(&single).len(), 2, "the rebound of a single impact stands in its e_n");
    }
}
