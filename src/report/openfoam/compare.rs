//! The page of finished cases: one alone, or several side by side.

use super::arriving::Arriving;
use super::tables::{PatchRow, value};
use super::{CloudResult, memory};
use crate::impact::Regime;
use crate::report::{BarChart, Chart, Figure, Page, Table, number, percent, round_edges};

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
    page.lead(view.lead());
    page.verdict(view.verdict());
    page.heading("Where material is captured");
    let mut capture = drawn(vec![view.by_wall()]);
    capture.extend(view.regimes());
    capture.extend(drawn(vec![view.along(), view.history()]));
    page.figures(capture);
    page.table(view.wall_table());
    let conversion = drawn(vec![view.conversion(), view.arriving()]);
    if !conversion.is_empty() {
        page.heading("At which carbon conversion");
        page.figures(conversion);
    }
    let View { labels, results, walls, time, .. } = &view;
    Arriving { labels, results, walls, time: *time }.add(&mut page);
    let places = view.places();
    if !places.is_empty() {
        page.heading("Where captured parcels lie");
        page.figures(places);
    }
    let remembered = memory::figures(view.each());
    if !remembered.is_empty() {
        page.heading("What the walls remember");
        page.figures(remembered);
    }
    page.heading("Balance");
    page.table(view.balance());
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
            // A cloud without carbon (limestone) counts as burnt out; that says nothing.
            if !result.has_carbon && sums[..9].iter().all(|sum| *sum == 0.0) {
                return None;
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

    /// Four lines at most, however many cases there are.
    fn verdict(&self) -> Vec<String> {
        let share =
            |result: &CloudResult| ratio(self.captured_in_all(result, self.time), self.injected(result));
        let totals: Vec<String> =
            self.each().map(|(label, result)| format!("{label} {}", percent(share(result)))).collect();
        let ours = || self.each().filter(|(_, result)| result.is_ours());
        let findings: Vec<String> =
            ours().filter_map(|(label, ours)| self.own_finding(label, ours)).collect();
        // A stock model is set beside our first run of the same cloud.
        let beside: Vec<_> = ours()
            .filter(|(label, own)| {
                ours().find(|(_, o)| o.cloud == own.cloud).is_some_and(|(l, _)| l == *label)
            })
            .filter_map(|(label, own)| self.what_constants_get_wrong(label, own))
            .collect();
        let raw: Vec<String> = self
            .each()
            .filter_map(|(label, result)| {
                let sums = self.captured_by_conversion(result)?;
                Some(format!("{} of {label}", percent(raw_share(&sums))))
            })
            .collect();
        let mut lines = vec![format!("Captured of the injected mass: {}.", totals.join(", "))];
        for list in [findings, beside] {
            if !list.is_empty() {
                lines.push(format!("{}.", list.join("; ")));
            }
        }
        if !raw.is_empty() {
            lines.push(format!(
                "Captured mass that is below a conversion of {RAW} at capture: {}.",
                raw.join(", ")
            ));
        }
        lines
    }

    fn own_finding(&self, label: &str, ours: &CloudResult) -> Option<String> {
        let rows = ours.patches.iter().filter_map(|patch| patch.at(self.time));
        let mut regimes = [0.0; 4];
        for row in rows {
            regimes.iter_mut().zip(row.regimes?).for_each(|(sum, mass)| *sum += mass);
        }
        let all: f64 = regimes.iter().sum();
        let most =
            Regime::ALL.iter().max_by(|a, b| regimes[**a as usize].total_cmp(&regimes[**b as usize]))?;
        let share = percent(ratio(regimes[*most as usize], all));
        (all > 0.0).then(|| format!("{share} of the captured mass of {label} is caught as {}", most.name()))
    }

    /// What stock models of the same cloud do at walls where our model holds a part of what arrives.
    fn what_constants_get_wrong(&self, own_label: &str, ours: &CloudResult) -> Option<String> {
        let mut held = Vec::new();
        let mut constants = Vec::new();
        for wall in &self.walls {
            let (Some((_, own)), Some((_, arriving))) = (self.captured(ours, wall), self.arrived(ours, wall))
            else {
                continue;
            };
            if arriving > 0.0 {
                held.push(format!("{} at {wall}", percent(ratio(own, arriving))));
            }
        }
        for (label, stock) in self.each().filter(|(_, other)| !other.is_ours() && other.cloud == ours.cloud) {
            let (mut all, mut nothing) = (Vec::new(), Vec::new());
            for wall in &self.walls {
                if self.holds_all(stock, wall) {
                    all.push(wall.as_str());
                } else if self.captured(stock, wall).is_some_and(|(_, mass)| mass == 0.0) {
                    nothing.push(wall.as_str());
                }
            }
            let all = (!all.is_empty()).then(|| format!("all at {}", all.join(", ")));
            let nothing = (!nothing.is_empty()).then(|| format!("nothing at {}", nothing.join(", ")));
            let parts: Vec<String> = all.into_iter().chain(nothing).collect();
            if !parts.is_empty() {
                constants.push(format!("{label} holds {}", parts.join(" and ")));
            }
        }
        (!held.is_empty() && !constants.is_empty()).then(|| {
            format!(
                "Of the arriving mass {own_label} holds {}, where {}",
                held.join(", "),
                constants.join(", and ")
            )
        })
    }

    fn add_notes(&self, page: &mut Page) {
        page.heading("What this rests on");
        page.text(
            "nearWallInteraction's own tables give hits, captures, regimes and conversion at capture. The stock models \
             leave only counts and masses in the solver's log; what arrives at their walls comes from the cloud function \
             patchPostProcessing. Where a stock model captures every arrival, its conversion at capture is that of the \
             arrivals. A parcel that rebounds may arrive many times. Places are those of parcels that lie still at the \
             last written time.");
        for (label, result) in self.each() {
            for missing in &result.missing {
                page.note(format!("{label}: {missing}."));
            }
        }
    }

    // --- figures -----------------------------------------------------------------------------------------------------

    fn by_wall(&self) -> Option<Figure> {
        if self.walls.is_empty() {
            return None;
        }
        let title = "Captured mass by wall, at capture";
        let mut bars = BarChart::new(title, "mass at capture [% of injected]", &self.walls);
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
        let mut chart = Chart::new("Captured mass over time", "time [s]", "mass at capture [kg]");
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
        Some(chart.figure("history", "All walls together, from the start of the case, with the mass that parcels have when they are captured."))
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
        let title = format!("Captured mass along {axis}, as it is now");
        let mut chart = Chart::new(&title, &format!("{axis} [m]"), "mass now [% of injected]");
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
                       captured parcels go on burning, so this is less than their mass at capture.";
        Some(chart.figure("along", caption))
    }

    /// One figure for each cloud that our model decided.
    fn regimes(&self) -> Vec<Figure> {
        let ours: Vec<_> = self.each().filter(|(_, result)| result.is_ours()).collect();
        let draw = |(number, (label, ours)): (usize, &(&String, &CloudResult))| {
            let row = |wall: &String| {
                ours.patch(wall).and_then(|patch| patch.at(self.time)).and_then(|row| row.regimes)
            };
            let title = format!("Regime of capture, {label}");
            let mut bars = BarChart::new(&title, "mass at capture [% of injected]", &self.walls).stacked();
            for regime in Regime::ALL {
                let share = |w: &String| {
                    100.0 * ratio(row(w).map_or(0.0, |r| r[regime as usize]), self.injected(ours))
                };
                bars = bars.series(regime.name(), &self.walls.iter().map(share).collect::<Vec<f64>>());
            }
            let caption = format!(
                "{label} only: sticky particle or not (SP, NSP) on a sticky wall or not (SW, NSW). The stock models know \
                 no regime."
            );
            let id = if number == 0 { "regimes".to_owned() } else { format!("regimes-{number}") };
            bars.figure(&id, &caption)
        };
        ours.iter().enumerate().map(draw).collect()
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

    /// Where captured parcels lie: along the main axis and around it, or, where the wall is not round, from the side. All
    /// cases have the same axes.
    fn places(&self) -> Vec<Figure> {
        let name = |axis: usize| ["x", "y", "z"][axis];
        let stuck = |result: &'a CloudResult| result.parcels.iter().filter(|p| !p.active).map(|p| p.position);
        let all: Vec<[f64; 3]> = self.results.iter().flat_map(stuck).collect();
        let [first, second] = around(self.axis);
        let range = |axis: usize| {
            let places = || all.iter().map(move |place| place[axis]);
            [places().fold(f64::INFINITY, f64::min), places().fold(f64::NEG_INFINITY, f64::max)]
        };
        let round = is_round(&all, self.axis);
        let width = |axis: usize| range(axis)[1] - range(axis)[0];
        let across = if width(second) > width(first) { second } else { first };
        let [low, high] = range(self.axis);
        let mut figures = Vec::new();
        for (number, (label, result)) in self.each().enumerate() {
            let height =
                |p: &[f64; 3]| if round { p[second].atan2(p[first]).to_degrees() } else { p[across] };
            let points: Vec<[f64; 2]> = stuck(result).map(|p| [p[self.axis], height(&p)]).collect();
            if points.is_empty() {
                continue;
            }
            let y_label = if round {
                format!("angle about {} [°]", name(self.axis))
            } else {
                format!("{} [m]", name(across))
            };
            let title = format!("Captured parcels, {label}");
            let mut chart =
                Chart::new(&title, &format!("{} [m]", name(self.axis)), &y_label).points("", &points);
            if low < high {
                chart = chart.x_range(low, high);
            }
            if round {
                chart = chart.y_range(-180.0, 180.0).y_step(90.0);
            } else if let [bottom, top] = range(across)
                && bottom < top
            {
                let edges = round_edges(bottom, top, 5);
                chart = chart.y_range(edges[0], edges[edges.len() - 1]).y_step(edges[1] - edges[0]);
            }
            let view = if round { "the wall unrolled" } else { "seen from the side" };
            let caption = format!("{} parcels, one point each; {view}.", points.len());
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

/// The two axes across this one.
fn around(axis: usize) -> [usize; 2] {
    [[1, 2], [2, 0], [0, 1]][axis]
}

/// Whether places lie roughly on round walls about an axis through the origin: all around it, and at each place along it
/// most at one radius.
fn is_round(places: &[[f64; 3]], axis: usize) -> bool {
    let [first, second] = around(axis);
    let along = || places.iter().map(|place| place[axis]);
    let (low, high) = (along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max));
    let mut sectors = [false; 12];
    let mut slices: Vec<Vec<f64>> = vec![Vec::new(); BINS];
    for place in places {
        let turn = place[second].atan2(place[first]) / std::f64::consts::TAU + 0.5;
        sectors[((12.0 * turn) as usize).min(11)] = true;
        let slice = (ratio(place[axis] - low, high - low) * BINS as f64).max(0.0) as usize;
        slices[slice.min(BINS - 1)].push(place[first].hypot(place[second]));
    }
    let at_one_radius = |radii: &mut Vec<f64>| {
        radii.sort_by(f64::total_cmp);
        let middle = radii.get(radii.len() / 2).copied().unwrap_or(0.0);
        radii.iter().filter(|radius| (**radius - middle).abs() <= 0.1 * middle).count()
    };
    let regular: usize = slices.iter_mut().map(at_one_radius).sum();
    sectors.iter().filter(|hit| **hit).count() >= 8 && regular * 10 >= places.len() * 8
}

/// The share of captured mass that is still raw [1].
fn raw_share(sums: &[f64; 10]) -> f64 {
    ratio(sums[..(10.0 * RAW) as usize].iter().sum(), sums.iter().sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pipe_is_round_and_a_plate_is_not() {
        let turn = |i: usize| i as f64 * 0.7;
        let pipe: Vec<[f64; 3]> =
            (0..200).map(|i| [0.2 * turn(i).cos(), 0.2 * turn(i).sin(), 0.01 * i as f64]).collect();
        let plate: Vec<[f64; 3]> =
            (0..200).map(|i| [turn(i).sin(), 0.0, 0.01 * ((7 * i) % 200) as f64]).collect();
        assert!(is_round(&pipe, 2) && !is_round(&plate, 2) && !is_round(&[], 2));
    }
}
