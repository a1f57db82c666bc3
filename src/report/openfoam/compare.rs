//! The page of finished cases: one alone, or several side by side.

use super::CloudResult;
use super::tables::{PatchRow, value};
use crate::impact::Regime;
use crate::report::{Bars, Block, Chart, Figure, Page, Table, number, percent, round_edges};

/// Conversion below which captured char still hides its ash behind carbon (Troiano et al.: threshold 0.88 to 0.90).
const RAW: f64 = 0.8;
/// Bins along the main axis of a case.
const BINS: usize = 40;

/// Makes the page of one or more cases.
///
/// # Errors
/// When the template cannot be filled.
pub fn page(results: &[CloudResult]) -> Result<String, String> {
    let view = View::new(results);
    let mut page = Page::new(&view.title());
    page.add(Block::Lead(view.lead()));
    page.add(Block::Verdict(view.verdict()));
    page.add(Block::Heading("Where material is captured".into()));
    page.add(Block::Figures(drawn(vec![view.by_wall(), view.regimes(), view.along(), view.history()])));
    page.add(Block::Table(view.wall_table()));
    page.add(Block::Heading("At which carbon conversion".into()));
    page.add(Block::Figures(drawn(vec![view.conversion(), view.arriving()])));
    let places = view.places();
    if !places.is_empty() {
        page.add(Block::Heading("The walls unrolled".into()));
        page.add(Block::Figures(places));
    }
    page.add(Block::Heading("Balance".into()));
    page.add(Block::Table(view.balance()));
    view.add_notes(&mut page);
    page.html().map_err(|error| error.to_string())
}

fn drawn(figures: Vec<Option<Figure>>) -> Vec<Figure> {
    figures.into_iter().flatten().collect()
}

fn ratio(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { f64::NAN }
}

/// The results with what they share: the walls, and the time at which they are compared.
struct View<'a> {
    results: &'a [CloudResult],
    labels: Vec<String>,
    walls: Vec<String>,
    /// The last time that all cases have reached [s].
    time: f64,
    /// Index of the longest extent of the captured parcels: 0, 1, 2 for x, y, z.
    axis: usize,
}

impl<'a> View<'a> {
    fn new(results: &'a [CloudResult]) -> Self {
        let time = results.iter().map(CloudResult::last_time).fold(f64::INFINITY, f64::min);
        let mut view =
            Self { results, labels: labels(results), walls: Vec::new(), time, axis: main_axis(results) };
        view.walls = view.find_walls();
        view
    }

    /// The walls of the mesh; where it is not there, the patches that hold something or let it rebound.
    fn find_walls(&self) -> Vec<String> {
        let mut walls: Vec<String> =
            self.results.iter().flat_map(|result| result.wall_patches.clone()).collect();
        if walls.is_empty() {
            let holds = |row: &PatchRow| row.sticks > 0.0 || row.hits.is_some_and(|hits| hits > row.escapes);
            let tables =
                self.results.iter().flat_map(|result| &result.patches).filter(|patch| !patch.is_pattern());
            let held = tables.filter(|patch| patch.at(self.time).is_some_and(holds));
            walls = held.map(|patch| patch.name.clone()).collect();
        }
        walls.sort();
        walls.dedup();
        let happened = |wall: &String| {
            self.results.iter().any(|result| {
                self.captured(result, wall).is_some_and(|(count, _)| count > 0.0)
                    || self.arrived(result, wall).is_some_and(|(count, _)| count > 0.0)
            })
        };
        walls.retain(happened);
        walls
    }

    fn each(&self) -> impl Iterator<Item = (&String, &'a CloudResult)> {
        self.labels.iter().zip(self.results)
    }

    fn injected(&self, result: &CloudResult) -> f64 {
        result.injected_at(self.time).unwrap_or(f64::NAN)
    }

    /// Captured parcels and mass at a wall; `None` where the log tells only of several patches together.
    fn captured(&self, result: &CloudResult, wall: &str) -> Option<(f64, f64)> {
        let patch = result.patch(wall)?;
        let row = patch.at(self.time)?;
        (!patch.is_pattern() || row.sticks == 0.0).then_some((row.sticks, row.stick_mass))
    }

    /// Arrivals and their mass at a wall: from the tables, else from the record.
    fn arrived(&self, result: &CloudResult, wall: &str) -> Option<(f64, f64)> {
        let row = result.patch(wall).and_then(|patch| patch.at(self.time));
        if let Some((hits, mass)) = row.and_then(|row| Some((row.hits?, row.hit_mass?))) {
            return Some((hits, mass));
        }
        (!result.arrivals.is_empty()).then(|| {
            let here = result.arrivals.iter().filter(|a| a.patch == wall && a.time <= self.time);
            here.fold((0.0, 0.0), |(count, mass), arrival| (count + 1.0, mass + arrival.mass))
        })
    }

    /// Mean impact speed at a wall [m/s].
    fn speed(&self, result: &CloudResult, wall: &str) -> Option<f64> {
        if let Some(sum) = result.patch(wall)?.at(self.time)?.speed_sum {
            let hits = result.patch(wall)?.at(self.time)?.hits?;
            return (hits > 0.0).then(|| sum / hits);
        }
        let here = result.arrivals.iter().filter(|a| a.patch == wall && a.time <= self.time);
        let (count, sum) = here.fold((0.0, 0.0), |(count, sum), arrival| (count + 1.0, sum + arrival.speed));
        (count > 0.0).then(|| sum / count)
    }

    /// All that a case has captured [kg].
    fn captured_in_all(&self, result: &CloudResult, time: f64) -> f64 {
        result.patches.iter().filter_map(|patch| patch.at(time)).map(|row| row.stick_mass).sum()
    }

    /// Captured mass by tenths of conversion [kg]; for a stock model from the arrivals at walls that hold everything.
    fn captured_by_conversion(&self, result: &CloudResult) -> Option<[f64; 10]> {
        let mut sums = [0.0; 10];
        if result.is_ours() {
            for row in result.patches.iter().filter_map(|patch| patch.at(self.time)) {
                for (sum, mass) in sums.iter_mut().zip(row.conversions?) {
                    *sum += mass;
                }
            }
        } else {
            for wall in self.walls.iter().filter(|wall| self.holds_all(result, wall)) {
                for arrival in result.arrivals.iter().filter(|a| a.patch == *wall && a.time <= self.time) {
                    sums[tenth(arrival.conversion?)] += arrival.mass;
                }
            }
        }
        (sums.iter().sum::<f64>() > 0.0).then_some(sums)
    }

    /// Whether a wall captures each parcel that arrives (a constant `stick`).
    fn holds_all(&self, result: &CloudResult, wall: &str) -> bool {
        match (self.captured(result, wall), self.arrived(result, wall)) {
            (Some((sticks, _)), Some((hits, _))) => sticks > 0.0 && sticks >= 0.98 * hits,
            _ => false,
        }
    }

    // --- words -------------------------------------------------------------------------------------------------------

    fn title(&self) -> String {
        match self.labels.as_slice() {
            [one] => format!("Wall hits in {one}"),
            _ => format!("Wall hits: {}", self.labels.join(", ")),
        }
    }

    fn lead(&self) -> String {
        let each = self.each().map(|(label, result)| {
            let model = result.model.as_deref().unwrap_or("a wall model that the case does not name");
            let model =
                if result.is_ours() { "the impact model of nearwall (nearWallInteraction)" } else { model };
            format!("{label} runs with {model}")
        });
        format!("{}. Everything is compared at {} s.", each.collect::<Vec<_>>().join("; "), number(self.time))
    }

    fn verdict(&self) -> Vec<String> {
        let share =
            |result: &CloudResult| ratio(self.captured_in_all(result, self.time), self.injected(result));
        let totals: Vec<String> =
            self.each().map(|(label, result)| format!("{label} {}", percent(share(result)))).collect();
        let mut sentences = vec![format!("Captured of the injected mass: {}.", totals.join(", "))];
        if let Some((_, ours)) = self.each().find(|(_, result)| result.is_ours()) {
            sentences.extend(self.own_finding(ours));
            for (label, stock) in self.each().filter(|(_, result)| !result.is_ours()) {
                sentences.extend(self.what_constants_get_wrong(label, stock, ours));
            }
        }
        sentences
    }

    fn own_finding(&self, ours: &CloudResult) -> Option<String> {
        let rows = ours.patches.iter().filter_map(|patch| patch.at(self.time));
        let mut regimes = [0.0; 4];
        for row in rows {
            regimes.iter_mut().zip(row.regimes?).for_each(|(sum, mass)| *sum += mass);
        }
        let all: f64 = regimes.iter().sum();
        let most =
            Regime::ALL.iter().max_by(|a, b| regimes[**a as usize].total_cmp(&regimes[**b as usize]))?;
        let conversions = self.captured_by_conversion(ours)?;
        let raw: f64 = conversions[..(10.0 * RAW) as usize].iter().sum();
        Some(format!(
            "With the impact model {} of the captured mass is caught as {} and {} of it at a conversion below {RAW}.",
            percent(ratio(regimes[*most as usize], all)),
            most.name(),
            percent(ratio(raw, conversions.iter().sum())),
        ))
    }

    /// Sentences on one stock model, each from the numbers of both runs.
    fn what_constants_get_wrong(&self, label: &str, stock: &CloudResult, ours: &CloudResult) -> Vec<String> {
        let (mut all, mut nothing) = (Vec::new(), Vec::new());
        for wall in &self.walls {
            let (Some((_, theirs)), Some((_, own)), Some((_, arriving))) =
                (self.captured(stock, wall), self.captured(ours, wall), self.arrived(ours, wall))
            else {
                continue;
            };
            let share = ratio(own, arriving);
            if self.holds_all(stock, wall) && share < 0.98 {
                all.push(format!("{wall} {}", percent(1.0 - share)));
            } else if theirs == 0.0 && own > 0.0 {
                nothing.push(format!("{wall} {}", percent(share)));
            }
        }
        let mut sentences = Vec::new();
        if !all.is_empty() {
            sentences.push(format!(
                "{label} holds all that arrives where speed, temperature and conversion let this share of the arriving \
                 mass rebound: {}.",
                all.join(", ")
            ));
        }
        if !nothing.is_empty() {
            sentences.push(format!(
                "{label} holds nothing where this share of the arriving mass sticks: {}.",
                nothing.join(", ")
            ));
        }
        let both = (self.captured_by_conversion(stock), self.captured_by_conversion(ours));
        if let (Some(theirs), Some(own)) = both {
            let raw = |sums: &[f64; 10]| ratio(sums[..(10.0 * RAW) as usize].iter().sum(), sums.iter().sum());
            sentences.push(format!(
                "What {label} captures is below a conversion of {RAW} for {} of its mass, against {}.",
                percent(raw(&theirs)),
                percent(raw(&own))
            ));
        }
        sentences
    }

    fn add_notes(&self, page: &mut Page) {
        page.add(Block::Heading("What this rests on".into()));
        page.add(Block::Text(
            "nearWallInteraction's own tables give hits, captures, regimes and conversion at capture. The stock models \
             leave only counts and masses in the solver's log; what arrives at their walls comes from the cloud function \
             patchPostProcessing. Where a stock model captures every arrival, its conversion at capture is that of the \
             arrivals. A parcel that rebounds may arrive many times. Places are those of parcels that lie still at the \
             last written time."
                .into(),
        ));
        for (label, result) in self.each() {
            for missing in &result.missing {
                page.add(Block::Note(format!("{label}: {missing}.")));
            }
        }
    }

    // --- figures -----------------------------------------------------------------------------------------------------

    fn by_wall(&self) -> Option<Figure> {
        if self.walls.is_empty() {
            return None;
        }
        let title = "Captured mass by wall";
        let mut bars = Bars::new(title, "captured mass [% of injected]", &self.walls);
        for (label, result) in self.each() {
            let share = |wall: &String| {
                100.0
                    * ratio(
                        self.captured(result, wall).map_or(f64::NAN, |(_, mass)| mass),
                        self.injected(result),
                    )
            };
            bars = bars.series(label, &self.walls.iter().map(share).collect::<Vec<f64>>());
        }
        Some(bars.figure("by-wall", "Mass at the moment of capture, as a share of the mass injected so far."))
    }

    fn history(&self) -> Option<Figure> {
        let mut chart = Chart::new("Captured mass over time", "time [s]", "captured mass [kg]");
        for (label, result) in self.each() {
            let mut times: Vec<f64> =
                result.patches.iter().flat_map(|p| p.rows.iter().map(|row| row.time)).collect();
            times.sort_by(f64::total_cmp);
            times.dedup();
            // A few hundred places are as many as a reader can see.
            let stride = times.len().div_ceil(300).max(1);
            let last = times.last().copied();
            let shown = times.iter().copied().step_by(stride).chain(last);
            let line: Vec<[f64; 2]> = shown.map(|time| [time, self.captured_in_all(result, time)]).collect();
            chart = chart.line(label, &line);
        }
        Some(chart.figure("history", "All walls together, from the start of the case."))
    }

    fn along(&self) -> Option<Figure> {
        let captured = |result: &'a CloudResult| result.parcels.iter().filter(|parcel| !parcel.active);
        let place = |parcel: &super::parcels::Parcel| parcel.position[self.axis];
        let all = || self.results.iter().flat_map(captured).map(place);
        let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
        if low >= high {
            return None;
        }
        let edges = round_edges(low, high, BINS);
        let (low, step) = (edges[0], edges[1] - edges[0]);
        let axis = ["x", "y", "z"][self.axis];
        let title = format!("Captured mass along {axis}");
        let mut chart = Chart::new(&title, &format!("{axis} [m]"), "captured mass [% of injected]");
        for (label, result) in self.each() {
            let injected = result.injected.last().map_or(f64::NAN, |[_, mass]| *mass);
            let mut heights = vec![0.0; edges.len() - 1];
            for parcel in captured(result) {
                let bin = (((place(parcel) - low) / step) as usize).min(edges.len() - 2);
                heights[bin] += 100.0 * ratio(parcel.mass, injected);
            }
            if heights.iter().any(|height| *height > 0.0) {
                chart = chart.histogram(label, &edges, &heights);
            }
        }
        let caption = "Parcels that lie still at the last written time, with the mass that they have then: OpenFOAM lets \
                       captured parcels go on burning.";
        Some(chart.figure("along", caption))
    }

    fn regimes(&self) -> Option<Figure> {
        let ours = self.results.iter().find(|result| result.is_ours())?;
        let row = |wall: &String| {
            ours.patch(wall).and_then(|patch| patch.at(self.time)).and_then(|row| row.regimes)
        };
        let mut bars = Bars::new("Regime of capture", "captured mass [% of injected]", &self.walls).stacked();
        for regime in Regime::ALL {
            let share =
                |w: &String| 100.0 * ratio(row(w).map_or(0.0, |r| r[regime as usize]), self.injected(ours));
            bars = bars.series(regime.name(), &self.walls.iter().map(share).collect::<Vec<f64>>());
        }
        let caption = "Sticky particle or not (SP, NSP) on a sticky wall or not (SW, NSW); impact model only, the stock \
                       models know no regime.";
        Some(bars.figure("regimes", caption))
    }

    fn conversion(&self) -> Option<Figure> {
        let title = "Carbon conversion at capture";
        let mut chart = Chart::new(title, "carbon conversion [1]", "share of the captured mass [%]");
        let mut any = false;
        for (label, result) in self.each() {
            if let Some(sums) = self.captured_by_conversion(result) {
                chart = chart.histogram(label, &tenths(), &shares(&sums));
                any = true;
            }
        }
        any.then(|| chart.x_range(0.0, 1.0).figure("conversion", "Each case's captured mass is 100 %."))
    }

    fn arriving(&self) -> Option<Figure> {
        let title = "Carbon conversion of what arrives";
        let mut chart = Chart::new(title, "carbon conversion [1]", "share of the arriving mass [%]");
        let mut any = false;
        for (label, result) in self.each() {
            let mut sums = [0.0; 10];
            for arrival in
                result.arrivals.iter().filter(|a| a.time <= self.time && self.walls.contains(&a.patch))
            {
                if let Some(conversion) = arrival.conversion {
                    sums[tenth(conversion)] += arrival.mass;
                }
            }
            if sums.iter().any(|sum| *sum > 0.0) {
                chart = chart.histogram(label, &tenths(), &shares(&sums));
                any = true;
            }
        }
        let caption = "All arrivals at walls, also repeated ones of parcels that rebound.";
        any.then(|| chart.x_range(0.0, 1.0).figure("arriving", caption))
    }

    /// Where captured parcels lie: along the main axis and around it.
    fn places(&self) -> Vec<Figure> {
        let axis = ["x", "y", "z"][self.axis];
        let [first, second] = [[1, 2], [2, 0], [0, 1]][self.axis];
        let mut figures = Vec::new();
        for (number, (label, result)) in self.each().enumerate() {
            let stuck = result.parcels.iter().filter(|parcel| !parcel.active);
            let angle = |p: &[f64; 3]| p[second].atan2(p[first]).to_degrees();
            let points: Vec<[f64; 2]> = stuck.map(|p| [p.position[self.axis], angle(&p.position)]).collect();
            if points.is_empty() {
                continue;
            }
            let around = format!("angle about {axis} [°]");
            let chart = Chart::new(&format!("Captured parcels, {label}"), &format!("{axis} [m]"), &around);
            let caption = format!("{} parcels, one point each.", points.len());
            let chart = chart.points("", &points).y_range(-180.0, 180.0);
            figures.push(chart.figure(&format!("places-{number}"), &caption));
        }
        figures
    }

    // --- tables ------------------------------------------------------------------------------------------------------

    fn wall_table(&self) -> Table {
        let mut rows = Vec::new();
        for (label, result) in self.each() {
            for wall in &self.walls {
                let arrived = self.arrived(result, wall);
                let captured = self.captured(result, wall);
                let mass = captured.map(|(_, mass)| mass);
                let shown = |value: Option<f64>| value.map_or("–".to_owned(), number);
                rows.push(vec![
                    label.clone(),
                    wall.clone(),
                    shown(arrived.map(|(count, _)| count)),
                    shown(arrived.map(|(_, mass)| mass)),
                    shown(captured.map(|(count, _)| count)),
                    shown(mass),
                    percent(ratio(mass.unwrap_or(f64::NAN), arrived.map_or(f64::NAN, |(_, mass)| mass))),
                    percent(ratio(mass.unwrap_or(f64::NAN), self.injected(result))),
                    shown(self.speed(result, wall)),
                ]);
            }
        }
        let header = [
            "case",
            "wall",
            "arrivals",
            "arriving mass [kg]",
            "captured parcels",
            "captured mass [kg]",
            "captured / arriving",
            "captured / injected",
            "mean impact speed [m/s]",
        ];
        Table {
            caption: format!("From the start to {} s.", number(self.time)),
            header: header.map(str::to_owned).to_vec(),
            rows,
            text_columns: 2,
        }
    }

    fn balance(&self) -> Table {
        let mut rows = Vec::new();
        for (label, result) in self.each() {
            let at = |name: &str| value(&result.balance, name).map_or("–".to_owned(), number);
            let stuck = match (
                value(&result.balance, "stuck_in_cloud_kg"),
                value(&result.balance, "stuck_removed_kg"),
            ) {
                (Some(kept), Some(removed)) => number(kept + removed),
                _ => "–".to_owned(),
            };
            rows.push(vec![
                label.clone(),
                result.injected.last().map_or("–".to_owned(), |[_, mass]| number(*mass)),
                at("airborne_kg"),
                number(self.captured_in_all(result, f64::MAX)),
                stuck,
                result.escaped_mass().map_or("–".to_owned(), number),
                at("reacted_kg"),
                at("residual"),
            ]);
        }
        let header = [
            "case",
            "injected [kg]",
            "airborne [kg]",
            "captured, at capture [kg]",
            "stuck, as it is now [kg]",
            "escaped [kg]",
            "reacted [kg]",
            "residual / injected",
        ];
        Table {
            caption: "At each case's own last time. The stock models keep no balance; where their patches count no escapes, \
                      escaped is the log's sum over all patches, else what was recorded as leaving."
                .into(),
            header: header.map(str::to_owned).to_vec(),
            rows,
            text_columns: 1,
        }
    }
}

fn tenth(conversion: f64) -> usize {
    ((10.0 * conversion) as usize).min(9)
}

fn tenths() -> Vec<f64> {
    (0..=10).map(|i| f64::from(i) / 10.0).collect()
}

fn shares(sums: &[f64; 10]) -> Vec<f64> {
    let all: f64 = sums.iter().sum();
    sums.iter().map(|sum| 100.0 * ratio(*sum, all)).collect()
}

/// The cases' names, with the cloud where one case has several.
fn labels(results: &[CloudResult]) -> Vec<String> {
    let twice = |result: &CloudResult| results.iter().filter(|other| other.case == result.case).count() > 1;
    results
        .iter()
        .map(
            |result| {
                if twice(result) { format!("{} {}", result.case, result.cloud) } else { result.case.clone() }
            },
        )
        .collect()
}

/// The direction in which captured parcels, else all, spread most.
fn main_axis(results: &[CloudResult]) -> usize {
    let parcels = || results.iter().flat_map(|result| &result.parcels);
    let extent = |axis: usize| {
        let places = || parcels().map(move |parcel| parcel.position[axis]);
        places().fold(f64::NEG_INFINITY, f64::max) - places().fold(f64::INFINITY, f64::min)
    };
    (0..3).max_by(|a, b| extent(*a).total_cmp(&extent(*b))).unwrap_or(2)
}
