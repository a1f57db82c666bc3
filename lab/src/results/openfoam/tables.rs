//! The tables of nearWallInteraction, `postProcessing/nearWallInteraction/<cloud>/<start time>/*.dat`, and the names of
//! their columns. `openfoam/` writes them.

use std::path::Path;

use super::super::classes::{Class, ClassQuantity, ClassSums};
use super::super::{Amount, History, Moments, WallTotals};
use super::deposit::{self, DepositState};
use super::table::{TableRow, histories};
use super::{BalanceLine, RunResults};
use nearwall::impact::Regime;

/// In every table: time of the row [s].
const TIME: &str = "time_s";
/// Endings of the other tables beside `<patch>.dat`.
const BALANCE: &str = "balance.dat";
const CLASS_TABLE: &str = ".distributions.dat";
const DEPOSIT: &str = ".wall.dat";
const FLUX: &str = ".flux.dat";
const STAY: &str = ".nearWall.dat";

/// The quantities of a table of classes.
const QUANTITIES: [(&str, ClassQuantity); 3] = [
    ("speed_m_s", ClassQuantity::Speed),
    ("angle_deg", ClassQuantity::Angle),
    ("diameter_m", ClassQuantity::Diameter),
];

/// Lines of the balance and the columns that each sums.
const BALANCE_LINES: [(&str, &[&str]); 6] = [
    ("injected", &["injected_kg"]),
    ("airborne", &["airborne_kg"]),
    ("stuck, mass now", &["stuck_in_cloud_kg", "stuck_removed_kg"]),
    ("escaped", &["escaped_kg"]),
    ("reacted", &["reacted_kg"]),
    ("unusable", &["unusable_removed_kg"]),
];

/// Fills in what the tables in a cloud's folder state.
pub(super) fn read_into(results: &mut RunResults, folder: &Path) {
    results.walls = histories(folder, ".dat", &[BALANCE, CLASS_TABLE, DEPOSIT, FLUX, STAY], wall_totals);
    results.classes = histories(folder, CLASS_TABLE, &[], class).into_iter().map(by_time).collect();
    results.deposits = histories(folder, DEPOSIT, &[], deposit_state);
    let balance = histories(folder, BALANCE, &[], |row| {
        let line = |(what, columns): &(&str, &[&str])| BalanceLine {
            what: (*what).to_owned(),
            count: None,
            mass: columns.iter().map(|column| row.number(column)).sum(),
        };
        let lines: Vec<BalanceLine> = BALANCE_LINES.iter().map(line).collect();
        Some((row.number(TIME)?, (lines, row.number("residual"))))
    });
    let Some(balance) = balance.into_iter().find(|history| history.wall.is_empty()) else { return };
    let injected = |(time, (lines, _)): &(f64, (Vec<BalanceLine>, _))| Some([*time, lines[0].mass?]);
    results.injected = balance.rows.iter().filter_map(injected).collect();
    if let Some((_, (lines, residual))) = balance.rows.into_iter().last() {
        (results.balance, results.residual) = (lines, residual);
    }
}

/// Number of parcels that the injectors have made, where the balance counts them.
pub(super) fn injected_parcels(folder: &Path) -> Option<u64> {
    let balance =
        histories(folder, BALANCE, &[], |row| Some((row.number(TIME)?, row.number("injected_parcels")?)));
    let own = balance.into_iter().find(|history| history.wall.is_empty())?;
    own.rows.last().map(|(_, count)| *count as u64)
}

/// Impacts at all patches that the model refused.
pub(super) fn unusable(folder: &Path) -> u64 {
    let patches = histories(folder, ".dat", &[BALANCE, CLASS_TABLE, DEPOSIT, FLUX, STAY], |row| {
        Some((row.number(TIME)?, row.number("unusable")?))
    });
    patches.iter().filter_map(|patch| patch.rows.last()).map(|(_, count)| *count as u64).sum()
}

fn wall_totals(row: &TableRow<'_>) -> Option<(f64, WallTotals)> {
    let or = |name: &str, otherwise: f64| row.number(name).unwrap_or(otherwise);
    let amount = |count: &str, mass: &str| Amount::new(or(count, 0.0), or(mass, 0.0));
    let moments = |count: &str, sum: &str, squares: &str| {
        Some(Moments::from_sums(or(count, 0.0), row.number(sum)?, or(squares, f64::NAN)))
    };
    let [counts, masses] = [["sticks_", ""], ["stick_mass_", "_kg"]].map(|[before, after]| {
        row.all(Regime::ALL.iter().map(|regime| format!("{before}{}{after}", regime.name())))
    });
    let regimes = masses.map(|masses| {
        let counts = counts.unwrap_or_else(|| vec![0.0; masses.len()]);
        let mut amounts = counts.iter().zip(&masses).map(|(count, mass)| Amount::new(*count, *mass));
        std::array::from_fn(|_| amounts.next().unwrap_or_default())
    });
    let conversions = row.all((0..10).map(|tenth| format!("stick_mass_conversion_0.{tenth}_kg")));
    let totals = WallTotals {
        hits: row.number("hits").map(|_| amount("hits", "hit_mass_kg")),
        captured: amount("sticks", "stick_mass_kg"),
        escaped: amount("escapes", "escape_mass_kg"),
        regimes,
        conversions: conversions.and_then(|list| list.try_into().ok()),
        speed: moments("hits", "impact_speed_sum_m_s", "").unwrap_or_default(),
        e_n: moments("rebounds", "e_n_sum", "e_n2_sum").unwrap_or_default(),
        outside_range: row.number("outside_range").map(|count| count as u64),
        eroded: row.number("eroded_volume_m3"),
        contact_heat: row.number("contact_heat_J"),
        ..WallTotals::default()
    };
    Some((row.number(TIME)?, totals))
}

fn class(row: &TableRow<'_>) -> Option<(f64, Class)> {
    let number = |name: &str| row.number(name);
    let named = row.text("quantity")?;
    let class = Class {
        injector: row.text("injector")?.to_owned(),
        quantity: QUANTITIES.iter().find(|(name, _)| *name == named)?.1,
        low: number("low")?,
        high: number("high")?,
        sums: ClassSums {
            hits: number("hits")?,
            particles: number("particles")?,
            particles_squared: number("particles_squared")?,
            mass: number("mass_kg")?,
            captured_particles: number("stick_particles")?,
            captured_mass: number("stick_mass_kg")?,
            energy_in: number("energy_in_J")?,
            energy_out: number("energy_out_J")?,
        },
    };
    Some((number(TIME)?, class))
}

/// All classes of one time together.
fn by_time(history: History<Class>) -> History<Vec<Class>> {
    let mut rows: Vec<(f64, Vec<Class>)> = Vec::new();
    for (time, class) in history.rows {
        match rows.last_mut() {
            Some((last, classes)) if *last == time => classes.push(class),
            _ => rows.push((time, vec![class])),
        }
    }
    History { wall: history.wall, rows }
}

fn deposit_state(row: &TableRow<'_>) -> Option<(f64, DepositState)> {
    Some((row.number(TIME)?, deposit::COLUMNS.map(|column| row.number(column).unwrap_or(f64::NAN))))
}

#[cfg(test)]
mod tests {
    use super::super::super::classes::together;
    use super::super::table::read;
    use super::*;

    #[test]
    fn totals_are_read_from_the_columns_that_exist() {
        let rows =
            read("# time_s sticks stick_mass_kg hits\n0.1 2 1e-6 5\n0.2 3 2e-6 9\n0.3 4 3e", wall_totals);
        assert_eq!(rows.len(), 2);
        let (time, totals) = &rows[1];
        let hits = totals.hits.map(|hits| hits.count);
        assert_eq!((*time, totals.captured, hits), (0.2, Amount::new(3.0, 2e-6), Some(9)));
        assert_eq!(totals.regimes, None);
    }

    #[test]
    fn classes_of_several_injectors_are_added() {
        let text = "# time_s injector quantity low high hits particles particles_squared mass_kg sticks \
            stick_particles stick_mass_kg energy_in_J energy_out_J\n\
                    0.1 a speed_m_s 1 2 4 40 400 4e-9 1 10 1e-9 8e-9 1e-9\n\
                    0.1 b speed_m_s 1 2 2 20 200 2e-9 0 0 0 4e-9 2e-9\n\
                    0.1 a speed_m_s 1000 inf 1 10 100 1e-9 0 0 0 1 0.5\n\
                    0.2 a speed_m_s 1 2 5 50 5";
        let history = by_time(History { wall: "floor".into(), rows: read(text, class) });
        assert_eq!(history.rows.len(), 1);
        assert!(history.at(0.05).is_none());
        let classes = history.at(9.0).unwrap();
        let speed = together(classes, ClassQuantity::Speed);
        assert_eq!((classes.len(), speed.len()), (3, 2));
        assert_eq!((speed[0].sums.hits, speed[0].sums.captured_particles), (6.0, 10.0));
        assert!((speed[0].sums.mass - 6e-9).abs() < 1e-20 && speed[1].high.is_infinite());
        assert!(together(classes, ClassQuantity::Angle).is_empty());
    }
}
