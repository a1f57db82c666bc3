//! A cut through the gas with the parcels in it, of an OpenFOAM case.

use super::{Comparison, number, range};
use crate::report::chart::{ColourScale, GasPicture, Palette};
use crate::report::{Figure, Page};
use crate::results::RunResults;
use crate::results::gas::{GasCut, ParcelQuantity, on_grid};

/// Most parcels that are drawn.
const MOST_DOTS: usize = 5000;

/// Adds the section of the page: one picture for each run.
pub(super) fn add_to(comparison: &Comparison<'_>, page: &mut Page) {
    let picture = |(place, (label, run)): (usize, (&String, &RunResults))| {
        let cloud = &run.cloud;
        let title = if comparison.is_single() { cloud.clone() } else { format!("{cloud}, {label}") };
        picture(run, run.gas.as_ref()?, &format!("gas-{place}"), &title)
    };
    let figures: Vec<Figure> = comparison.each().enumerate().filter_map(picture).collect();
    if !figures.is_empty() {
        page.heading("Gas and parcels");
        page.text(
            "A cut through the middle of the domain, with the parcels in flight near it. ParaView shows the same with the walls: start \
             paraview --script=PATH/gasWithParcels.py in the folder of the case; the script is in openfoam/paraview of nearwall.",
        );
        page.figures(figures);
    }
}

fn picture(run: &RunResults, gas: &GasCut, id: &str, title: &str) -> Option<Figure> {
    let cells = on_grid(&gas.cells);
    let shown = gas.shown();
    let every = shown.len().div_ceil(MOST_DOTS).max(1);
    let dots: Vec<([f64; 2], f64)> = shown.iter().copied().step_by(every).collect();
    let picture = GasPicture::of(&cells, dots.len())?;
    let [low, high] = widened(range(cells.iter().map(|cell| cell.value).filter(|value| value.is_finite())));
    let gas_scale = ColourScale::new(low, high).with(Palette::Heat);
    let gas_label = format!("{} [{}]", gas.quantity.name(), gas.quantity.unit());
    let parcel_scale = gas.coloured_by.filter(|_| !dots.is_empty()).map(|quantity| {
        let [low, high] = match quantity {
            ParcelQuantity::Conversion => [0.0, 1.0],
            ParcelQuantity::Temperature => {
                widened(range(dots.iter().map(|(_, value)| *value).filter(|value| value.is_finite())))
            }
        };
        let label = format!("{} [{}]", quantity.name(), quantity.unit());
        (ColourScale::new(low, high).with(Palette::CharToAsh), label)
    });
    let caption = caption(run, gas, [cells.len(), shown.len(), every]);
    let axes = gas.plane.axes().map(|axis| format!("{} [m]", ["x", "y", "z"][axis]));
    let parcels = parcel_scale.as_ref().map(|(scale, label)| (scale, label.as_str()));
    Some(picture.figure([id, title, &caption], &axes, (&gas_scale, &gas_label), &dots, parcels))
}

/// Ends of a scale that differ: around a single value by a thousandth of it.
fn widened([low, high]: [f64; 2]) -> [f64; 2] {
    if !low.is_finite() || !high.is_finite() {
        return [0.0, 1.0];
    }
    let least = 1e-3 * high.abs().max(low.abs()).max(1e-9);
    if high - low < least { [low - least, high + least] } else { [low, high] }
}

/// Time, plane, and which parcels are shown; `drawn` are the numbers of cells and of parcels in the slab, and of parcels a dot.
fn caption(run: &RunResults, gas: &GasCut, [cells, near, every]: [usize; 3]) -> String {
    let time = number(gas.time);
    let when = if run.steady { format!("Iteration {time}") } else { format!("Time {time} s") };
    let mut words = vec![match gas.slab() {
        None => format!(
            "{when}. The mesh is one cell thick and seen along {}.",
            ["x", "y", "z"][gas.plane.normal]
        ),
        Some(_) => format!("{when}, cut along {}.", gas.plane.words()),
    }];
    if cells != gas.cells.len() {
        words.push(format!(
            "The plane cuts {} cells; drawn are the values at the centres of {cells} equal squares.",
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
