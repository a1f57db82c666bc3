//! The page of wall results: of one run, of several runs side by side, or of a sweep.
//!
//! A figure or a column of a table is one function; it is shown when the results contain what it needs. [`SECTIONS`]
//! lists the figures.

mod arriving;
mod balance;
mod captured;
mod conversion;
mod deposit;
mod gas;
mod injections;
mod near_wall;
mod opening;
mod places;
mod rebound;
mod surfaces;
mod sweep;
mod verdict;

use super::format::{duration, with_deviation};
use super::{Chart, Figure, Page, Table, number, percent};
use crate::results::standalone::Run;
use crate::results::{Moments, RunResults, WallModel, WallTotals, common_time};
use crate::rig::{Band, CaptureBand};
use crate::simulate::Case;

/// The sections of a page before and after the maps of the deposit: heading, figures, and the table under them.
const SECTIONS: [PageSection; 9] = [
    (
        "Where material is captured",
        &[captured::by_wall, captured::regimes, captured::hit_regimes, places::along, captured::history],
        captured::table,
    ),
    ("At which carbon conversion", &[conversion::captured, conversion::arriving], nothing),
    ("Which sizes are captured", &[captured::sizes], nothing),
    ("What arrives at the walls", &[arriving::figures], arriving::table),
    ("How particles rebound", &[rebound::normal, rebound::tangential], rebound::table),
    ("How densely particles linger at the walls", &[near_wall::figures], near_wall::table),
    ("Where captured particles lie", &[places::captured_maps, places::scatter], nothing),
    ("Where walls are eroded", &[places::eroded_maps], nothing),
    ("What lies on the walls over time", &[deposit::figures], nothing),
];
const LAST_SECTIONS: [PageSection; 2] =
    [("Which injection is captured", &[], injections::table), ("Balance", &[], balance::table)];

/// Hits of a wall from which on it has figures.
const FEW_HITS: u64 = 30;

type PageSection =
    (&'static str, &'static [fn(&RunComparison<'_>) -> Vec<Figure>], fn(&RunComparison<'_>) -> Option<Table>);

fn nothing(_: &RunComparison<'_>) -> Option<Table> {
    None
}

/// Makes the page of one or more finished OpenFOAM cases.
///
/// # Errors
/// When the template cannot be filled.
pub fn openfoam_page(runs: &[RunResults]) -> Result<String, askama::Error> {
    let comparison = RunComparison::new(runs);
    let mut page = Page::new(&verdict::title(&comparison));
    page.lead(verdict::lead(&comparison));
    page.figures(opening::figures(&comparison));
    comparison.add_to(&mut page);
    page.heading("Sources");
    page.text("The tables of nearWallInteraction give its hits, captures, regimes, conversions and balance. The stock \
        models write only counts and masses to the solver's log; the arrivals at their walls are those that the cloud \
         function patchPostProcessing recorded. Where a stock model captures every arrival, its conversion at capture \
         is that of the arrivals. A parcel that rebounds may arrive many times. Places are those of parcels that lie \
         still at the last written time.");
    for (label, run) in comparison.each() {
        for missing in &run.missing {
            page.note(format!("{label}: {missing}."));
        }
    }
    page.html()
}

/// Makes the page of a standalone case. `left_out` is the number of hits that are not in `impacts.csv`.
///
/// # Errors
/// When the template cannot be filled.
pub fn standalone_page(case: &Case, runs: &[Run], left_out: u64) -> Result<String, askama::Error> {
    let mut page = Page::new(&case.title);
    if let Some(about) = &case.about {
        page.lead(about.clone());
    }
    match (&case.sweep, runs) {
        (Some(sweep), _) => sweep::add_to(&mut page, case, sweep, runs),
        (None, [run]) => {
            let results = [run.results(case)];
            RunComparison::new(&results).add_to(&mut page);
        }
        _ => {}
    }
    if let Some(table) = bands(case, runs) {
        page.heading("Captures over the drawn models");
        page.text("95 % bands of what each wall captures over models drawn from a fit: the uncertainty of the fitted \
            parameters. The bands contain neither the uncertainty of other numbers nor the scatter of single runs.");
        page.table(table);
    }
    add_method(&mut page, case, runs.iter().any(|run| run.totals.has_carbon));
    if left_out > 0 {
        page.note(format!(
            "impacts.csv contains all hits of the first particles (of each value of a sweep), at most {} rows; \
             {left_out} hits of later particles are in the figures but not in the file (run.recorded_impacts).",
            case.recorded
        ));
    }
    page.foot(&format!("Seed {}, {} particles.", case.seed, case.count()));
    page.html()
}

/// What moves the particles, and how a deposit grows.
fn add_method(page: &mut Page, case: &Case, has_carbon: bool) {
    page.heading("How this was computed");
    let gas = &case.gas;
    let also = [
        (gas.turbulence.is_some(), ", a normalised Langevin walk for the turbulence"),
        (gas.thermophoresis, ", thermophoresis"),
        (gas.brownian, ", Brownian motion"),
    ];
    let also: String = also.iter().filter(|(is_there, _)| *is_there).map(|(_, what)| *what).collect();
    let without = if gas.turbulence.is_some() { "" } else { " There is no turbulence." };
    let (before, after) =
        if has_carbon { ("", ", and the stated law of carbon conversion") } else { ("and ", "") };
    page.text(format!(
        "Particles move alone in a prescribed, steady gas that they do not act on: drag of Schiller and Naumann, \
            weight{also}, {before}convective heat of Ranz and Marshall{after}.{without} A particle touches a wall \
            with its surface, half a diameter from its centre. The impact model decides each hit; its random draw \
            depends only on seed, particle and hit number."
    ));
    if let Some(deposit) = &case.deposit {
        let burnt = if has_carbon {
            ", and the carbon in the powder burns by the law of the case at the temperature of the wall"
        } else {
            ""
        };
        page.text(format!(
            "Particles are released evenly over {}. In each of {} steps they meet the walls as they were at its \
                beginning; at its end the captured ones are added{burnt}. deposit.csv has every wall, bin and time.",
            duration(deposit.duration),
            deposit.steps
        ));
    }
}

/// The bands of the captures; `None` without drawn models.
fn bands(case: &Case, runs: &[Run]) -> Option<Table> {
    let row = |run: &Run, band: &CaptureBand| {
        let CaptureBand { wall, draws, captured_mass, captured_particles, mass_share } = band;
        let swept = case
            .sweep
            .as_ref()
            .zip(run.value)
            .map(|(sweep, value)| format!("{} {}", sweep.key, number(value)));
        let range = |band: &Band, text: fn(f64) -> String| {
            format!("{} to {} (median {})", text(band.low), text(band.high), text(band.median))
        };
        vec![
            swept.unwrap_or_default(),
            wall.clone(),
            range(mass_share, percent),
            range(captured_mass, number),
            range(captured_particles, |value| format!("{value:.0}")),
            draws.to_string(),
        ]
    };
    let rows: Vec<Vec<String>> =
        runs.iter().flat_map(|run| run.bands.iter().map(move |band| row(run, band))).collect();
    let header =
        ["run", "wall", "captured share of the mass", "captured mass [kg]", "captured particles", "draws"];
    (!rows.is_empty()).then(|| Table::new("", 2, &header, rows))
}

/// Runs side by side, with the walls and the time at which they are compared.
struct RunComparison<'a> {
    runs: &'a [RunResults],
    labels: Vec<String>,
    walls: Vec<String>,
    /// Walls with fewer than [`FEW_HITS`] hits, which get a line and no figures.
    few: Vec<String>,
    /// The last time that all runs have reached [s].
    time: f64,
}

/// One series of a figure: a wall of a single run, or all walls of one of several runs.
struct Series<'a> {
    label: &'a str,
    run: &'a RunResults,
    walls: Vec<&'a str>,
}

impl<'a> RunComparison<'a> {
    fn new(runs: &'a [RunResults]) -> Self {
        let time = common_time(runs.iter());
        let mut comparison = Self { runs, labels: labels(runs), walls: Vec::new(), few: Vec::new(), time };
        comparison.walls = comparison.find_walls();
        comparison.set_few_aside();
        comparison
    }

    /// Most hits of a wall in a run; `None` where they are not counted.
    fn most_hits(&self, wall: &str) -> Option<u64> {
        self.runs.iter().filter_map(|run| run.arrived(wall, self.time)).map(|(hits, _)| hits.count).max()
    }

    /// Takes walls with few hits from the figures, unless all have few.
    fn set_few_aside(&mut self) {
        let walls = std::mem::take(&mut self.walls);
        let is_few = |wall: &String| self.most_hits(wall).is_some_and(|hits| hits < FEW_HITS);
        let (few, many): (Vec<_>, Vec<_>) = walls.into_iter().partition(is_few);
        (self.few, self.walls) = if many.is_empty() { (Vec::new(), few) } else { (few, many) };
    }

    /// The walls with few hits, in a sentence.
    fn few_words(&self) -> Option<String> {
        let hits = |wall: &String| format!("{wall} ({})", self.most_hits(wall).unwrap_or(0));
        let walls: Vec<String> = self.few.iter().map(hits).collect();
        let at_most = if self.is_single() { "" } else { ", the most of a case" };
        (!walls.is_empty()).then(|| {
            format!("Walls with fewer than {FEW_HITS} hits{at_most}, in no figure: {}.", walls.join(", "))
        })
    }

    /// The walls of a standalone case in its order. Of OpenFOAM cases those walls of the mesh, or,
    /// without a mesh, those patches that captured something or let it rebound.
    fn find_walls(&self) -> Vec<String> {
        if let [run] = self.runs
            && run.cloud.is_empty()
        {
            return run.walls.iter().map(|wall| wall.wall.clone()).collect();
        }
        let mut walls: Vec<String> = self.runs.iter().flat_map(|run| run.wall_patches.clone()).collect();
        if walls.is_empty() {
            let is_wall = |totals: &WallTotals| {
                totals.captured.count > 0 || totals.hits.is_some_and(|hits| hits.count > totals.escaped.count)
            };
            let patches = self.runs.iter().flat_map(|run| &run.walls).filter(|patch| !patch.is_pattern());
            let found = patches.filter(|patch| patch.at(self.time).is_some_and(is_wall));
            walls = found.map(|patch| patch.wall.clone()).collect();
        }
        walls.sort();
        walls.dedup();
        walls.retain(|wall| {
            self.runs.iter().any(|run| {
                run.captured(wall, self.time).is_some_and(|amount| amount.count > 0)
                    || run.arrived(wall, self.time).is_some_and(|(hits, _)| hits.count > 0)
            })
        });
        walls
    }

    fn add_to(&self, page: &mut Page) {
        page.verdict(verdict::lines(self));
        if let Some(words) = self.few_words() {
            page.text(words);
        }
        for (label, run) in self.each() {
            if let Some((count, reason)) = &run.trouble {
                let of = if self.is_single() { String::new() } else { format!(" of {label}") };
                let text = format!("{count} particles{of} could not be used. The first: {reason}.");
                page.text(text);
            }
            if let Some(line) = run.outside_ranges.first() {
                let of = if self.is_single() { String::new() } else { format!("{label}: ") };
                page.text(format!("{of}{line}."));
            }
            page_later_captures(page, run);
        }
        SECTIONS.iter().for_each(|section| self.add_section(page, section));
        gas::add_to(self, page);
        surfaces::add_to(self, page);
        LAST_SECTIONS.iter().for_each(|section| self.add_section(page, section));
        if self.runs.iter().any(|run| run.outside_ranges.len() > 1) {
            page.heading("Outside of stated ranges");
        }
        for (label, run) in self.each().filter(|(_, run)| run.outside_ranges.len() > 1) {
            if !self.is_single() {
                page.subheading(label);
            }
            run.outside_ranges[1..].iter().for_each(|line| page.note(format!("{line}.")));
        }
    }

    /// Adds a section that has anything to show.
    fn add_section(&self, page: &mut Page, (heading, figures, table): &PageSection) {
        let figures: Vec<Figure> = figures.iter().flat_map(|figures| figures(self)).collect();
        let table = table(self).filter(|table| !table.rows.is_empty());
        if figures.is_empty() && table.is_none() {
            return;
        }
        page.heading(*heading);
        if let Some(table) = table {
            page.table(table);
        }
        page.figures(figures);
    }

    /// The time of the comparison in words.
    fn when(&self) -> String {
        if self.is_steady() { format!("iteration {}", number(self.time)) } else { duration(self.time) }
    }

    /// What sums up to the time of the comparison cover, in words.
    fn span(&self) -> String {
        if self.is_steady() {
            format!("The solve of iteration {}", number(self.time))
        } else {
            format!("From the start to {}", duration(self.time))
        }
    }

    /// The label of an axis of times.
    fn clock(&self) -> &'static str {
        if self.is_steady() { "iteration" } else { "time [s]" }
    }

    fn is_steady(&self) -> bool {
        self.runs.iter().all(|run| run.steady)
    }

    fn is_single(&self) -> bool {
        self.runs.len() == 1
    }

    fn each(&self) -> impl Iterator<Item = (&String, &'a RunResults)> {
        self.labels.iter().zip(self.runs)
    }

    /// The place of the colour of a wall of a single run, or of one of several runs.
    fn colour(&self, label: &str, wall: &str) -> usize {
        let (names, own) = if self.is_single() { (&self.walls, wall) } else { (&self.labels, label) };
        names.iter().position(|name| name == own).unwrap_or(0)
    }

    fn totals(&self, run: &'a RunResults, wall: &str) -> Option<&'a WallTotals> {
        run.totals(wall, self.time)
    }

    fn injected(&self, run: &RunResults) -> f64 {
        run.injected_at(self.time).unwrap_or(f64::NAN)
    }

    /// The series of a figure: the walls of a single run, or one for each of several runs.
    fn series(&self) -> Vec<Series<'_>> {
        let walls = self.walls.iter().map(String::as_str);
        match self.runs {
            [run] => walls.map(|wall| Series { label: wall, run, walls: vec![wall] }).collect(),
            _ => self
                .each()
                .map(|(label, run)| Series { label, run, walls: walls.clone().collect() })
                .collect(),
        }
    }

    /// Adds a histogram of each series that has one; no figure when none has.
    fn histogram(
        &self,
        [id, caption]: [&str; 2],
        mut chart: Chart,
        edges: &[f64],
        heights: impl Fn(&Series<'_>) -> Option<Vec<f64>>,
    ) -> Vec<Figure> {
        let mut any = false;
        for (place, series) in self.series().into_iter().enumerate() {
            if let Some(heights) =
                heights(&series).filter(|heights| heights.iter().any(|height| *height > 0.0))
            {
                chart = chart.coloured(place).histogram(series.label, edges, &heights);
                any = true;
            }
        }
        if any { vec![chart.figure(id, caption)] } else { Vec::new() }
    }

    /// A table with a row for each run and wall. A column without any value is left out, as is the run's name where
    /// there is one run only.
    fn wall_table(&self, caption: &str, columns: &[WallColumn]) -> Option<Table> {
        let places: Vec<(&String, &RunResults, &String)> = self
            .each()
            .flat_map(|(label, run)| self.walls.iter().map(move |wall| (label, run, wall)))
            .collect();
        let mut header = vec!["case".to_owned(), "wall".to_owned()];
        let mut rows: Vec<Vec<String>> =
            places.iter().map(|(label, _, wall)| vec![(*label).clone(), (*wall).clone()]).collect();
        for (head, value) in columns {
            let values: Vec<Option<String>> = places
                .iter()
                .map(|(_, run, wall)| value(self, run, wall).filter(|text| text != "–"))
                .collect();
            if values.iter().any(Option::is_some) {
                header.push((*head).to_owned());
                let cells = values.into_iter().map(|value| value.unwrap_or_else(|| "–".to_owned()));
                rows.iter_mut().zip(cells).for_each(|(row, cell)| row.push(cell));
            }
        }
        if self.is_single() {
            header.remove(0);
            rows.iter_mut().for_each(|row| drop(row.remove(0)));
        }
        let text_columns = if self.is_single() { 1 } else { 2 };
        let caption = caption.to_owned();
        (header.len() > text_columns).then_some(Table { caption, header, rows, text_columns })
    }
}

/// Head of a column, and its value for a run and a wall.
type WallColumn = (&'static str, fn(&RunComparison<'_>, &RunResults, &str) -> Option<String>);

/// Explains why far more particles are captured in the end than at their first hit.
fn page_later_captures(page: &mut Page, run: &RunResults) {
    let totals = || run.walls.iter().filter_map(|wall| wall.rows.last()).map(|(_, totals)| totals);
    let first = totals().filter_map(|totals| totals.first_hits);
    let [hits, captured] = first.fold([0, 0], |[a, b], [c, d]| [a + c, b + d]);
    let all = totals().fold(0_u64, |sum, totals| sum.saturating_add(totals.captured.count));
    if hits > 0 && (all - captured) as f64 > 0.1 * run.balance[0].count.unwrap_or(hits) as f64 {
        page.text(later_captures([hits, captured], all, run.has_carbon));
    }
}

/// Captures at first hits beside all captures.
fn later_captures([hits, captured]: [u64; 2], all: u64, has_carbon: bool) -> String {
    let burnt = if has_carbon { " and carbon is converted" } else { "" };
    format!(
        "Of the particles that reach a wall, {} are captured at their first hit and {} in the end: each rebound takes \
         away speed{burnt}, so that particles which return after a few small hops are captured. A measurement of \
         single impacts sees the first share.",
        percent(captured as f64 / hits as f64),
        percent(all as f64 / hits as f64),
    )
}

/// Mean and standard deviation, the latter with two digits; a dash without values.
fn spread(moments: &Moments) -> String {
    let deviation = moments.deviation();
    if moments.count == 0 {
        return "–".to_owned();
    }
    if !deviation.is_finite() {
        return number(moments.mean);
    }
    with_deviation(moments.mean, deviation)
}

/// The names of the cases, with the cloud where one case has several.
fn labels(runs: &[RunResults]) -> Vec<String> {
    let twice = |run: &RunResults| runs.iter().filter(|other| other.case == run.case).count() > 1;
    let label =
        |run: &RunResults| if twice(run) { format!("{} {}", run.case, run.cloud) } else { run.case.clone() };
    runs.iter().map(label).collect()
}

/// A name as the id of a figure: letters, digits and hyphens.
fn identifier(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' }).collect()
}
