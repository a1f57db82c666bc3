//! Figures and a table of what arrives at each wall: speed, angle, size, what of it stays, and its energy.

use super::CloudResult;
use super::distributions::{Class, Quantity, Sums, together};
use crate::report::{BarChart, Chart, Figure, Page, Table, number, percent};

/// The cases with what they share.
pub(super) struct Arriving<'a> {
    pub(super) labels: &'a [String],
    pub(super) results: &'a [CloudResult],
    pub(super) walls: &'a [String],
    /// The time at which they are compared [s].
    pub(super) time: f64,
}

impl<'a> Arriving<'a> {
    /// Adds its part to the page, or nothing where no case has distributions.
    pub(super) fn add(&self, page: &mut Page) {
        let walls: Vec<(usize, &String)> =
            self.walls.iter().enumerate().filter(|(_, wall)| self.each(wall).next().is_some()).collect();
        if walls.is_empty() {
            return;
        }
        page.heading("What arrives at the walls");
        for (index, wall) in &walls {
            let figures = [
                self.distribution(*index, wall, Quantity::Speed),
                self.distribution(*index, wall, Quantity::Angle),
                self.distribution(*index, wall, Quantity::Diameter),
                self.capture(*index, wall),
            ];
            page.figures(figures.into_iter().flatten());
        }
        let walls: Vec<String> = walls.iter().map(|(_, wall)| (*wall).clone()).collect();
        page.figures(vec![self.energy(&walls)]);
        page.table(self.table());
    }

    /// The cases that have distributions at a wall, with their classes.
    fn each(&self, wall: &str) -> impl Iterator<Item = (&'a String, &'a [Class])> {
        self.labels.iter().zip(self.results).filter_map(move |(label, result)| {
            let patch = result.distributions.iter().find(|patch| patch.patch == wall)?;
            let classes = patch.at(self.time);
            (!classes.is_empty()).then_some((label, classes))
        })
    }

    fn distribution(&self, index: usize, wall: &str, quantity: Quantity) -> Option<Figure> {
        let (name, what, x_label) = match quantity {
            Quantity::Speed => ("speed", "Impact speed", "speed against the wall [m/s]"),
            Quantity::Angle => ("angle", "Impact angle", "angle from the wall [°]"),
            Quantity::Diameter => ("size", "Size", "diameter [m]"),
        };
        let mut chart =
            Chart::new(&format!("{what} at {wall}"), x_label, "mass in a class [% of what arrives]");
        let mut any = false;
        for (label, classes) in self.each(wall) {
            let classes = together(classes, quantity);
            let all: f64 = classes.iter().map(|class| class.sums.mass).sum();
            let percent_of = |mass: &dyn Fn(&Sums) -> f64| {
                let heights = classes.iter().map(|class| 100.0 * mass(&class.sums) / all);
                filled(&classes, &heights.collect::<Vec<f64>>())
            };
            if all <= 0.0 {
                continue;
            }
            any = true;
            let (edges, heights) = percent_of(&|sums| sums.mass);
            chart = chart.stairs(label, &edges, &heights);
            if classes.iter().any(|class| class.sums.stick_mass > 0.0) {
                let (edges, heights) = percent_of(&|sums| sums.stick_mass);
                chart = chart.stairs(&format!("{label}, what sticks"), &edges, &heights);
            }
        }
        chart = match quantity {
            Quantity::Angle => chart.x_range(0.0, 90.0),
            _ => chart.log_x(),
        };
        let caption = match quantity {
            Quantity::Angle => "Classes of 5°; 0° glances, 90° is head-on. Repeated arrivals count again.",
            _ => "Eight classes a decade. Repeated arrivals of parcels that rebound count again.",
        };
        any.then(|| chart.figure(&format!("{name}-{index}"), caption))
    }

    fn capture(&self, index: usize, wall: &str) -> Option<Figure> {
        let title = format!("Captured by size at {wall}");
        let mut chart = Chart::new(&title, "diameter [m]", "captured of the arriving particles [%]");
        let mut any = false;
        for (label, classes) in self.each(wall) {
            let (mut points, mut errors) = (Vec::new(), Vec::new());
            for class in together(classes, Quantity::Diameter) {
                if let Some([share, low, high]) = class.sums.captured() {
                    let [left, right] = ends(&class);
                    points.push([(left * right).sqrt(), 100.0 * share]);
                    errors.push((100.0 * (share - low), 100.0 * (high - share)));
                    any |= share > 0.0;
                }
            }
            chart = chart.points_with_errors(label, &points, &errors);
        }
        let caption = "Particles that stick of those that arrive in a class, with the 95 % interval of so many independent \
                       arrivals as the parcels' weights are worth.";
        any.then(|| chart.log_x().y_range(0.0, 100.0).figure(&format!("capture-{index}"), caption))
    }

    fn energy(&self, walls: &[String]) -> Figure {
        let title = "Kinetic energy that leaves again";
        let mut bars = BarChart::new(title, "of the arriving kinetic energy [%]", walls);
        for (label, result) in self.labels.iter().zip(self.results) {
            let share = |wall: &String| {
                let patch = result.distributions.iter().find(|patch| patch.patch == *wall);
                let sums = total(patch.map_or(&[], |patch| patch.at(self.time)), None);
                100.0 * sums.energy_out / sums.energy_in
            };
            bars = bars.series(label, &walls.iter().map(share).collect::<Vec<f64>>());
        }
        let caption =
            "Against the wall's own motion; the rest goes into the wall, the particle and the deposit.";
        bars.figure("energy", caption)
    }

    /// One row for each case, wall and injector.
    fn table(&self) -> Table {
        let mut rows = Vec::new();
        for wall in self.walls {
            for (label, classes) in self.each(wall) {
                let mut injectors: Vec<&str> = classes.iter().map(|class| class.injector.as_str()).collect();
                injectors.sort_unstable();
                injectors.dedup();
                for injector in injectors {
                    let sums = total(classes, Some(injector));
                    rows.push(vec![
                        label.clone(),
                        wall.clone(),
                        injector.to_owned(),
                        number(sums.hits),
                        number(sums.mass),
                        percent(sums.stick_mass / sums.mass),
                        number(sums.energy_in),
                        number(sums.energy_out),
                        percent(sums.energy_out / sums.energy_in),
                    ]);
                }
            }
        }
        let header = [
            "case",
            "wall",
            "injector",
            "arrivals",
            "arriving mass [kg]",
            "captured / arriving",
            "kinetic energy in [J]",
            "out [J]",
            "out / in",
        ];
        Table {
            caption: format!(
                "What the wall model decided, from the start to {} s. Parcels that hit in the step of their injection have \
                 the injector -1 where there are several.",
                number(self.time)
            ),
            header: header.map(str::to_owned).to_vec(),
            rows,
            text_columns: 3,
        }
    }
}

/// All classes of one quantity together, of one injector or of all.
fn total(classes: &[Class], injector: Option<&str>) -> Sums {
    let mut sums = Sums::default();
    for class in classes.iter().filter(|class| class.quantity == Quantity::Diameter) {
        if injector.is_none_or(|injector| class.injector == injector) {
            sums.add(&class.sums);
        }
    }
    sums
}

/// The ends of a class as far as they can be drawn on a logarithmic axis: an open class is as wide as the others.
fn ends(class: &Class) -> [f64; 2] {
    let width = 10_f64.powf(0.125);
    match class.quantity {
        Quantity::Angle => [class.low, class.high],
        _ if class.low == 0.0 => [class.high / width, class.high],
        _ if class.high.is_infinite() => [class.low, class.low * width],
        _ => [class.low, class.high],
    }
}

/// Edges and heights without gaps: where classes are empty the height is 0.
fn filled(classes: &[Class], heights: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (mut edges, mut all): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    for (class, height) in classes.iter().zip(heights) {
        let [low, high] = ends(class);
        match edges.last() {
            Some(last) if (last / low - 1.0).abs() < 1e-9 => {}
            Some(_) => {
                edges.push(low);
                all.push(0.0);
            }
            None => edges.push(low),
        }
        edges.push(high);
        all.push(*height);
    }
    (edges, all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_classes_are_drawn_as_empty() {
        let class = |low: f64, high: f64| Class {
            injector: String::new(),
            quantity: Quantity::Speed,
            low,
            high,
            sums: Sums::default(),
        };
        let (edges, heights) =
            filled(&[class(0.0, 1e-3), class(1e-3, 2e-3), class(4e-3, 5e-3)], &[1.0, 2.0, 3.0]);
        assert_eq!((&edges[1..], &heights[..]), (&[1e-3, 2e-3, 4e-3, 5e-3][..], &[1.0, 2.0, 0.0, 3.0][..]));
        assert!((edges[0] - 1e-3 / 10_f64.powf(0.125)).abs() < 1e-12);
    }
}
