//! Measured rows as readings, each of one observable: a reading counts once, whatever it averages.

use super::super::observable::Observable;
use crate::dataset::Measurement;

/// Number of impacts of an average that scores as one impact.
const ONE_OF_AN_AVERAGE: f64 = 1.0 + f64::EPSILON;

/// The readings of a row, each scored as an average of one impact: a capture as that of one impact, `e_n` and `e_t`
/// as those of what rebounded, with the scatter of a single reading. It is the error of the prediction, which no
/// average makes smaller.
pub(super) fn readings(row: &Measurement) -> Vec<(Observable, Measurement)> {
    let bare = Measurement {
        impacts: ONE_OF_AN_AVERAGE,
        rebounds: 1.0,
        e_n: None,
        e_t: None,
        captured: None,
        limits: [None; 2],
        ..*row
    };
    let mut readings = Vec::new();
    if row.e_n.is_some() || row.limits[0].is_some() {
        let limits = [row.limits[0], None];
        readings.push((Observable::NormalRestitution, Measurement { e_n: row.e_n, limits, ..bare }));
    }
    if row.e_t.is_some() || row.limits[1].is_some() {
        let limits = [None, row.limits[1]];
        readings.push((Observable::TangentialRestitution, Measurement { e_t: row.e_t, limits, ..bare }));
    }
    if row.captured.is_some() {
        readings.push((Observable::Capture, Measurement { captured: row.captured, ..bare }));
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
        let row = Measurement {
            e_n,
            e_t: e_n,
            captured: Some(0.3),
            impacts: 50.0,
            rebounds: 35.0,
            ..Measurement::default()
        };
        let found = readings(&row);
        let kinds: Vec<Observable> = found.iter().map(|(observable, _)| *observable).collect();
        assert_eq!(kinds, Observable::ALL);
        assert!(found.iter().all(|(_, row)| row.impacts > 1.0 && row.impacts < 1.001 && row.rebounds == 1.0));
        // What rebounds says nothing about captures where none are recorded.
        let single = Measurement { captured: None, impacts: 1.0, ..row };
        assert_eq!(readings(&single).len(), 2);
    }
}
