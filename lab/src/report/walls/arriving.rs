//! What arrives at each wall by speed, angle and size, which part of it is captured, and its kinetic energy.

use super::{RunComparison, number, percent};
use crate::report::page::TableColumn;
use crate::report::{BarChart, Chart, Figure, Table};
use crate::results::classes::{Class, ClassQuantity, ClassSums, together, total};
use crate::results::share;

pub(super) fn figures(comparison: &RunComparison<'_>) -> Vec<Figure> {
    let mut figures = Vec::new();
    let mut walls = Vec::new();
    for (index, wall) in comparison.walls.iter().enumerate() {
        if each(comparison, wall).next().is_some() {
            for quantity in [ClassQuantity::Speed, ClassQuantity::Angle, ClassQuantity::Diameter] {
                figures.extend(distribution(comparison, index, quantity));
            }
            figures.extend(capture(comparison, index));
            walls.push(wall.clone());
        }
    }
    if !walls.is_empty() {
        figures.push(energy(comparison, &walls));
    }
    figures
}

/// The cases with classes at a wall.
fn each<'a>(
    comparison: &'a RunComparison<'_>,
    wall: &'a str,
) -> impl Iterator<Item = (&'a String, &'a [Class])> {
    comparison.each().filter_map(move |(label, run)| {
        let classes = run.classes.iter().find(|history| history.wall == wall)?.at(comparison.time)?;
        (!classes.is_empty()).then_some((label, classes.as_slice()))
    })
}

/// What the classes of speeds and diameters are.
const CLASSES: &str = "Eight classes a decade. Each arrival of a parcel that rebounds counts.";

fn distribution(comparison: &RunComparison<'_>, index: usize, quantity: ClassQuantity) -> Option<Figure> {
    let wall = &comparison.walls[index];
    let (name, what, x_label) = match quantity {
        ClassQuantity::Speed => ("speed", "Impact speed", "speed relative to the wall [m/s]"),
        ClassQuantity::Angle => ("angle", "Impact angle", "angle from the wall [°]"),
        ClassQuantity::Diameter => ("size", "Size", "diameter [µm]"),
    };
    let mut chart = Chart::new(&format!("{what} at {wall}"), x_label, "mass in a class [% of what arrives]");
    let mut any = false;
    for (label, classes) in each(comparison, wall) {
        let classes = together(classes, quantity);
        let all: f64 = classes.iter().map(|class| class.sums.mass).sum();
        let colour = comparison.colour(label, wall);
        let mut captured = |name: &str, dash: usize, mass: fn(&ClassSums) -> f64, chart: Chart| {
            let heights: Vec<f64> =
                classes.iter().map(|class| 100.0 * share(mass(&class.sums), all)).collect();
            if !heights.iter().any(|height| *height > 0.0) {
                return chart;
            }
            any = true;
            let (edges, heights) = filled(&classes, &heights);
            chart.dashed(colour, dash).stairs(name, &edges, &heights)
        };
        chart = captured(label, 0, |sums| sums.mass, chart);
        chart = captured(&format!("{label}, captured"), 1, |sums| sums.captured_mass, chart);
    }
    let (chart, caption) = match quantity {
        ClassQuantity::Angle => (
            chart.x_range(0.0, 90.0),
            "Classes of 5°; 0° is grazing, 90° is head-on. Each arrival of a parcel counts.",
        ),
        ClassQuantity::Diameter => (chart.log_x().x_factor(1e6), CLASSES),
        ClassQuantity::Speed => (chart.log_x(), CLASSES),
    };
    any.then(|| chart.figure(&format!("{name}-{index}"), caption))
}

fn capture(comparison: &RunComparison<'_>, index: usize) -> Option<Figure> {
    let wall = &comparison.walls[index];
    let title = format!("Captured by size at {wall}");
    let mut chart = Chart::new(&title, "diameter [µm]", "captured of the arriving particles [%]");
    let mut any = false;
    for (label, classes) in each(comparison, wall) {
        let (mut points, mut errors) = (Vec::new(), Vec::new());
        for class in together(classes, ClassQuantity::Diameter) {
            if let Some([share, low, high]) = class.sums.captured() {
                let [left, right] = ends(&class);
                points.push([(left * right).sqrt(), 100.0 * share]);
                errors.push((100.0 * (share - low), 100.0 * (high - share)));
                any |= share > 0.0;
            }
        }
        let colour = comparison.colour(label, wall);
        chart = chart.coloured(colour).points_with_errors(label, &points, &errors);
    }
    let caption = "Captured share of the particles in each class, with its 95 % interval. The interval allows for \
        parcels of unequal weight.";
    any.then(|| chart.log_x().x_factor(1e6).y_range(0.0, 100.0).figure(&format!("capture-{index}"), caption))
}

fn energy(comparison: &RunComparison<'_>, walls: &[String]) -> Figure {
    let title = "Kinetic energy after the hits";
    let mut bars = BarChart::new(title, "of the kinetic energy before [%]", walls);
    for (label, run) in comparison.each() {
        let part = |wall: &String| {
            let classes = run.classes.iter().find(|history| history.wall == *wall);
            let sums =
                classes.and_then(|classes| classes.at(comparison.time)).map(|classes| total(classes, None));
            sums.map_or(f64::NAN, |sums| 100.0 * share(sums.energy_out, sums.energy_in))
        };
        bars = bars.series(label, &walls.iter().map(part).collect::<Vec<f64>>());
    }
    let caption = "Relative to the wall. The rest goes into the wall, the particle and the deposit.";
    bars.figure("energy", caption)
}

/// One row for each case, wall and injector.
pub(super) fn table(comparison: &RunComparison<'_>) -> Option<Table> {
    let mut items = Vec::new();
    for wall in &comparison.walls {
        for (label, classes) in each(comparison, wall) {
            let mut injectors: Vec<&str> = classes.iter().map(|class| class.injector.as_str()).collect();
            injectors.sort_unstable();
            injectors.dedup();
            let sums = |injector| ([label.as_str(), wall, injector], total(classes, Some(injector)));
            items.extend(injectors.into_iter().map(sums));
        }
    }
    let caption = format!(
        "{}, as the wall model decided. With several injectors, parcels that hit in the step of their \
         injection have the injector -1.",
        comparison.span()
    );
    let columns: [TableColumn<'_, ([&str; 3], ClassSums)>; 9] = [
        ("case", &|([case, _, _], _)| (*case).to_owned()),
        ("wall", &|([_, wall, _], _)| (*wall).to_owned()),
        ("injector", &|([_, _, injector], _)| (*injector).to_owned()),
        ("arrivals", &|(_, sums)| number(sums.hits)),
        ("arriving mass [kg]", &|(_, sums)| number(sums.mass)),
        ("captured / arriving", &|(_, sums)| percent(share(sums.captured_mass, sums.mass))),
        ("kinetic energy before [J]", &|(_, sums)| number(sums.energy_in)),
        ("after [J]", &|(_, sums)| number(sums.energy_out)),
        ("after / before", &|(_, sums)| percent(share(sums.energy_out, sums.energy_in))),
    ];
    Some(Table::of_items(&caption, 3, &items, &columns))
}

/// The ends of a class for a logarithmic axis: an open class is as wide as the others.
fn ends(class: &Class) -> [f64; 2] {
    let width = 10_f64.powf(0.125);
    match class.quantity {
        ClassQuantity::Angle => [class.low, class.high],
        _ if class.low == 0.0 => [class.high / width, class.high],
        _ if class.high.is_infinite() => [class.low, class.low * width],
        _ => [class.low, class.high],
    }
}

/// Edges and heights without gaps: an empty class has the height 0.
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
            quantity: ClassQuantity::Speed,
            low,
            high,
            sums: ClassSums::default(),
        };
        let (edges, heights) =
            filled(&[class(0.0, 1e-3), class(1e-3, 2e-3), class(4e-3, 5e-3)], &[1.0, 2.0, 3.0]);
        assert_eq!((&edges[1..], &heights[..]), (&[1e-3, 2e-3, 4e-3, 5e-3][..], &[1.0, 2.0, 0.0, 3.0][..]));
        assert!((edges[0] - 1e-3 / 10_f64.powf(0.125)).abs() < 1e-12);
    }
}
