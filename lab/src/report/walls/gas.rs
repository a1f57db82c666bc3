//! A cut through the gas with the parcels in it, of an OpenFOAM case.

use super::{RunComparison, number};
use crate::report::chart::{COLUMN_WIDTH, ColourScale, Palette, PlanePicture};
use crate::report::format::duration;
use crate::report::{Figure, Page};
use crate::results::gas::{GasCut, ParcelQuantity};
use crate::results::{RunResults, extent, range};

/// Most parcels that are drawn.
const MOST_DOTS: usize = 5000;
/// Largest width and height of the plot, and the least of either [px].
const MOST: [f64; 2] = [300.0, 450.0];
const LEAST_SIDE: f64 = 24.0;
/// Least and largest height of the bars of colours, and least size of the drawing [px].
const BAR_HEIGHT: [f64; 2] = [150.0, 260.0];
const LEAST_WIDTH: f64 = 470.0;
const LEAST_GAS_HEIGHT: f64 = 190.0;

/// Adds the section of the page: one picture for each run.
pub(super) fn add_to(comparison: &RunComparison<'_>, page: &mut Page) {
    let picture = |(place, (label, run)): (usize, (&String, &RunResults))| {
        let cloud = &run.cloud;
        let title = if comparison.is_single() { cloud.clone() } else { format!("{cloud}, {label}") };
        picture(run, run.gas.as_ref()?, &format!("gas-{place}"), &title)
    };
    let figures: Vec<Figure> = comparison.each().enumerate().filter_map(picture).collect();
    if !figures.is_empty() {
        page.heading("Gas and parcels");
        page.text(
            "A cut through the middle of the domain, with the parcels in flight near it. ParaView shows the same with \
                the walls: start paraview --script=PATH/gasWithParcels.py in the folder of the case; the script is in \
                openfoam/paraview of nearwall.",
        );
        page.figures(figures);
    }
}

fn picture(run: &RunResults, gas: &GasCut, id: &str, title: &str) -> Option<Figure> {
    let cells = gas.drawn();
    let ends = extent(&cells)?;
    let shown = gas.shown();
    let every = shown.len().div_ceil(MOST_DOTS).max(1);
    let dots: Vec<([f64; 2], f64)> = shown.iter().copied().step_by(every).collect();
    let gas_scale = scale_of(&mut cells.iter().map(|cell| cell.value)).with(Palette::Heat);
    let parcels = gas.coloured_by.filter(|_| !dots.is_empty()).map(|quantity| {
        let scale = match quantity {
            ParcelQuantity::Conversion => ColourScale::new(0.0, 1.0),
            ParcelQuantity::Temperature => scale_of(&mut dots.iter().map(|(_, value)| *value)),
        };
        (scale.with(Palette::CharToAsh), format!("{} [{}]", quantity.name(), quantity.unit()))
    });
    // One metre is equally long along both axes, unless the domain is very thin.
    let [width, height] = ends.map(|[low, high]| high - low);
    let scale = (MOST[0] / width).min(MOST[1] / height);
    let size = [width, height].map(|length| (scale * length).max(LEAST_SIDE));
    let mut picture = PlanePicture::new([id, title], ends, size);
    let colours: Vec<String> = cells.iter().map(|cell| gas_scale.colour_or_grey(cell.value)).collect();
    picture.cells(&cells, &colours);
    picture.outline();
    picture.dots(&dots, parcels.as_ref().map(|(scale, _)| scale));
    let axes = gas.plane.axes().map(|axis| format!("{} [m]", ["x", "y", "z"][axis]));
    picture.axes([&axes[0], &axes[1]], false);
    let label = format!("{} [{}]", gas.quantity.name(), gas.quantity.unit());
    let bar = size[1].clamp(BAR_HEIGHT[0], BAR_HEIGHT[1]);
    picture.bar(&gas_scale, &label, 0, bar);
    let bars = if let Some((scale, label)) = &parcels {
        picture.bar(scale, label, 1, bar);
        2.0
    } else {
        1.0
    };
    let ([used, _], [_, below]) = (picture.beside(), picture.below());
    let used = used + bars * COLUMN_WIDTH;
    let size = [used.max(LEAST_WIDTH), below.max(LEAST_GAS_HEIGHT)];
    Some(picture.figure(&caption(run, gas, [cells.len(), shown.len(), every]), size, used))
}

fn scale_of(values: &mut dyn Iterator<Item = f64>) -> ColourScale {
    let [low, high] = widened(range(values.filter(|value| value.is_finite())));
    ColourScale::new(low, high)
}

/// Ends of a scale that differ: around a single value by a thousandth of it.
fn widened([low, high]: [f64; 2]) -> [f64; 2] {
    if !low.is_finite() || !high.is_finite() {
        return [0.0, 1.0];
    }
    let least = 1e-3 * high.abs().max(low.abs()).max(1e-9);
    if high - low < least { [low - least, high + least] } else { [low, high] }
}

/// Time, plane, and which parcels are shown; `drawn` are the numbers of cells and of parcels in the
/// slab, and of parcels a dot.
fn caption(run: &RunResults, gas: &GasCut, [cells, near, every]: [usize; 3]) -> String {
    let when = if run.steady {
        format!("Iteration {}", number(gas.time))
    } else {
        format!("Time {}", duration(gas.time))
    };
    let mut words = vec![match gas.slab() {
        None => format!(
            "{when}. The mesh is one cell thick and seen along {}.",
            ["x", "y", "z"][gas.plane.normal]
        ),
        Some(_) => format!("{when}, cut along {}.", gas.plane.words()),
    }];
    if cells != gas.cells.len() {
        words.push(format!(
            "The plane cuts {} cells; drawn are the means over {cells} equal rectangles.",
            gas.cells.len()
        ));
    }
    let all = gas.parcels.len();
    words.push(match gas.slab() {
        None => format!("The cloud has {all} parcels in flight."),
        Some(slab) => format!(
            "{near} of the {all} parcels of the cloud in flight: those within {} m of the plane.",
            number(0.5 * slab)
        ),
    });
    if every > 1 {
        words.push(format!("One in {every} of them is drawn."));
    }
    if gas.resting > 0 {
        words.push(format!("{} parcels at rest are not drawn.", gas.resting));
    }
    words.join(" ")
}
