//! Published observations of drops that bounce or stay beside what the law says of them.
//!
//! `tests/data/drop_rebound_published.csv` has the observations. The test writes their table in
//! `docs/why/published-sticking.md`: `NEARWALL_BLESS=1 cargo test --test library drop_published`. A
//! difference is shown as a difference; the test fails only when page and law say different things.

use std::path::Path;

use nearwall::capture::drop_bounce::BounceNumbers;
use nearwall::capture::drop_pinning::ContactAngles;
use nearwall::capture::drop_restitution::drop_restitution;

use crate::published_sticking::{replaced, short};

struct Observation {
    cells: Vec<String>,
}

impl Observation {
    fn text(&self, column: usize) -> &str {
        &self.cells[column]
    }

    fn number(&self, column: usize) -> f64 {
        self.text(column).parse().unwrap_or(f64::NAN)
    }

    fn angles(&self) -> ContactAngles {
        let receding = self.number(6);
        ContactAngles {
            contact: self.number(5).to_radians(),
            receding: (!receding.is_nan()).then(|| receding.to_radians()),
        }
    }

    fn at(&self, weber: f64) -> Option<f64> {
        let [gravity, density, viscosity, tension, diameter] =
            [7, 8, 9, 10, 11].map(|column| self.number(column));
        let ohnesorge = viscosity / (density * tension * diameter).sqrt();
        let bond = density * gravity * diameter * diameter / tension;
        drop_restitution(&BounceNumbers { weber, ohnesorge, bond }, &self.angles())
    }

    /// Weber numbers from the lowest to the highest of the row.
    fn webers(&self, count: u32) -> impl Iterator<Item = f64> {
        let [low, high] = [12, 13].map(|column| self.number(column));
        (0..count).map(move |step| low * (high / low).powf(f64::from(step) / f64::from(count - 1)))
    }

    fn answer(&self) -> f64 {
        let weber = self.number(12);
        match self.text(2) {
            "bounces" => self.webers(9).filter(|weber| self.at(*weber).is_some()).count() as f64 / 9.0,
            "first speed" => {
                let first = self.webers(2000).find(|weber| self.at(*weber).is_some()).unwrap();
                (first * self.number(10) / (self.number(8) * self.number(11))).sqrt()
            }
            "last Oh" => self.last_ohnesorge(weber),
            "rebounds" => {
                let next = |weber: &f64| self.at(*weber).map(|e_n| weber * e_n * e_n);
                (std::iter::successors(Some(weber), next).count() - 1) as f64
            }
            "e_n" => self.at(weber).unwrap_or(0.0),
            other => panic!("{other}"),
        }
    }

    /// The largest Ohnesorge number by radius that bounces; `gravity` is the Bond number by radius here.
    fn last_ohnesorge(&self, weber: f64) -> f64 {
        let bond = 4.0 * self.number(7);
        let bounces = |by_radius: &f64| {
            let ohnesorge = by_radius / std::f64::consts::SQRT_2;
            drop_restitution(&BounceNumbers { weber, ohnesorge, bond }, &self.angles()).is_some()
        };
        (1..1000_u16).rev().map(|step| f64::from(step) / 500.0).find(bounces).unwrap_or(0.0)
    }

    fn agrees(&self) -> bool {
        (self.number(3)..=self.number(4)).contains(&self.answer())
    }

    fn line(&self) -> String {
        let [low, high] = [3, 4].map(|column| self.number(column));
        let published = if low == high { short(low) } else { format!("{} to {}", short(low), short(high)) };
        let [id, what, quantity] = [0, 1, 2].map(|column| self.text(column));
        format!("| {id} | {what} | {quantity} | {published} | {} |", short(self.answer()))
    }
}

fn observations() -> Vec<Observation> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/drop_rebound_published.csv");
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(path).unwrap();
    let row = |record: csv::Result<csv::StringRecord>| Observation {
        cells: record.unwrap().iter().map(str::to_owned).collect(),
    };
    reader.records().map(row).collect()
}

/// The page and the law say the same.
#[test]
fn the_page_shows_what_the_law_says_of_drops() {
    let rows = observations();
    for row in &rows {
        println!("{}", row.line());
    }
    let missed: Vec<String> = rows.iter().filter(|row| !row.agrees()).map(Observation::line).collect();
    let table = format!(
        "{} of {} agree. The others:\n\n| | observation | quantity | published | here |\n|---|---|---|---|---|\n{}\n",
        rows.len() - missed.len(),
        rows.len(),
        missed.join("\n")
    );
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/why/published-sticking.md");
    let page = std::fs::read_to_string(&path).unwrap();
    let fresh = replaced(&page, "drops", &table);
    if std::env::var_os("NEARWALL_BLESS").is_some() {
        std::fs::write(path, fresh).unwrap();
        return;
    }
    assert!(
        page == fresh,
        "docs/why/published-sticking.md is out of date; \
         `NEARWALL_BLESS=1 cargo test --test library drop_published` writes it again"
    );
}
