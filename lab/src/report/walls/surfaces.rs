//! What lies on the faces of the walls of an OpenFOAM case, as maps of the unrolled walls.

use super::{RunComparison, identifier, number};
use crate::report::chart::{ColourScale, PlanePicture, hatching, regime_colour, swatch};
use crate::report::format::{REGIME_NAMES, duration, with_unit};
use crate::report::{Figure, Page, percent};
use crate::results::surface::{
    MOST_FACES, PlaneAxis, SurfaceQuantity, Unrolled, Unrolling, WALL_GRID, WallAxis, WallSurface, shapes,
    unroll,
};
use crate::results::{MapCell, RunResults, extent, range};
use nearwall::impact::Regime;

/// Relative change over a wall up to which a quantity gets a sentence instead of a map [1].
const EVEN: f64 = 1e-3;
/// The scale ends at this share of the area that has anything, where the largest value is `FAR_ABOVE` times larger [1].
const SCALE_AREA: f64 = 0.98;
const FAR_ABOVE: f64 = 2.5;
/// Width of a drawing and of its plot, and the least height of the plot [px]: one of three figures side by side.
const SURFACE_WIDTH: f64 = 420.0;
const PLOT_WIDTH: f64 = 262.0;
const LEAST_MAP_HEIGHT: f64 = 92.0;

/// Adds the section of the page: one row of maps for each wall.
pub(super) fn add_to(comparison: &RunComparison<'_>, page: &mut Page) {
    if comparison.runs.iter().all(|run| run.surfaces.is_empty()) {
        return;
    }
    page.heading("Deposit on the walls");
    page.text(
        "The values on each face of the walls that the wall model writes, at the last written time. Each map has a \
            scale of its own.",
    );
    for (place, (label, run)) in comparison.each().enumerate() {
        for (count, wall) in run.surfaces.iter().enumerate() {
            if comparison.few.contains(&wall.wall) {
                continue;
            }
            let name =
                if comparison.is_single() { wall.wall.clone() } else { format!("{}, {label}", wall.wall) };
            page.subheading(format!("{name}, {}", when(run, wall)));
            add_wall(page, wall, &format!("surface-{place}-{count}"));
        }
    }
}

fn when(run: &RunResults, wall: &WallSurface) -> String {
    if run.steady { format!("iteration {}", number(wall.time)) } else { duration(wall.time) }
}

/// The maps of a wall, and a sentence for each quantity that is the same everywhere.
fn add_wall(page: &mut Page, wall: &WallSurface, id: &str) {
    let is_even = |(_, values): &&(SurfaceQuantity, Vec<f64>)| {
        let [low, high] = range(values.iter().copied());
        high - low <= EVEN * high.abs().max(low.abs())
    };
    let (even, mapped): (Vec<_>, Vec<_>) = wall.quantities.iter().partition(is_even);
    let unrolled = unroll(&wall.faces);
    let mut figures: Vec<(Figure, bool)> =
        mapped.iter().filter_map(|(quantity, values)| map(wall, &unrolled, id, *quantity, values)).collect();
    figures.extend(regimes(wall, &unrolled, id));
    let mut words = Vec::new();
    if !figures.is_empty() {
        words.push(how(&unrolled.how));
        if figures.iter().any(|(_, stretched)| *stretched) {
            words.push("The upright axis is stretched.".to_owned());
        }
        if wall.faces.len() > MOST_FACES {
            let [columns, rows] = WALL_GRID;
            words.push(format!("Means over the area in {columns} by {rows} cells."));
        }
    }
    words.push(format!("{} faces, {} m².", wall.faces.len(), number(wall.area())));
    words.extend(even.iter().filter_map(|(quantity, values)| everywhere(*quantity, values)));
    words.extend(only_regime(wall));
    page.text(words.join(" "));
    page.panels(figures.into_iter().map(|(figure, _)| figure));
}

/// A quantity that is the same on all faces, in a sentence; none for the thickness of no powder.
fn everywhere(quantity: SurfaceQuantity, values: &[f64]) -> Option<String> {
    let value = values.first().copied().unwrap_or(0.0);
    match quantity {
        SurfaceQuantity::Deposit | SurfaceQuantity::Captured if value == 0.0 => {
            Some("Nothing lies on it.".to_owned())
        }
        SurfaceQuantity::Layer if value == 0.0 => None,
        _ => Some(format!("{}: {} everywhere.", quantity.name(), with_unit(value, quantity.unit()))),
    }
}

/// The map of a quantity, and whether its upright axis is stretched.
fn map(
    wall: &WallSurface,
    unrolled: &Unrolled,
    id: &str,
    quantity: SurfaceQuantity,
    values: &[f64],
) -> Option<(Figure, bool)> {
    let cells = shapes(&wall.faces, unrolled, values);
    let [low, high] = scale_ends(quantity, &cells);
    let scale = ColourScale::new(low, high);
    let title = format!("{} [{}]", quantity.name(), quantity.unit());
    let id = format!("{id}-{}", identifier(quantity.name()));
    let fills: Vec<String> = cells.iter().map(|cell| scale.colour_or_grey(cell.value)).collect();
    let (mut map, is_stretched) = picture([&id, &title], unrolled, &cells, &fills)?;
    map.bar(&scale, quantity.unit(), 0, map.height());
    let caption = caption(wall, quantity, values) + &above(&cells, high);
    Some((finished(map, &caption), is_stretched))
}

/// A map of the unrolled wall without what is beside it, and whether its upright axis is stretched;
/// `None` for a wall without an extent.
fn picture<'a>(
    texts: [&'a str; 2],
    unrolled: &Unrolled,
    cells: &[MapCell],
    fills: &[String],
) -> Option<(PlanePicture<'a>, bool)> {
    let ends = extent(cells)?;
    let [width, height] = ends.map(|[low, high]| high - low);
    let proper = PLOT_WIDTH * height / width;
    let height = proper.clamp(LEAST_MAP_HEIGHT, PLOT_WIDTH);
    let mut map = PlanePicture::new(texts, ends, [PLOT_WIDTH, height]);
    map.add(&hatching(texts[0]));
    map.cells(cells, fills);
    let [across, up] = unrolled.axes.map(axis_label);
    map.axes([&across, &up], true);
    Some((map, height > 1.001 * proper))
}

fn finished(map: PlanePicture<'_>, caption: &str) -> Figure {
    let height = map.below()[1];
    map.figure(caption, [SURFACE_WIDTH, height], SURFACE_WIDTH)
}

/// Captured mass [kg] by regime.
fn regime_masses(wall: &WallSurface) -> Option<[f64; 4]> {
    let captured = wall.captured.as_ref()?;
    Some(Regime::ALL.map(|regime| wall.integral(&captured[regime as usize])))
}

/// The regime of all captures, in a sentence, where there is only one.
fn only_regime(wall: &WallSurface) -> Option<String> {
    let masses = regime_masses(wall)?;
    let mut found = Regime::ALL.into_iter().filter(|regime| masses[*regime as usize] > 0.0);
    let only = found.next().filter(|_| found.next().is_none())?;
    Some(format!("All parcels of the deposit cloud that lie on it were captured as {}.", only.name()))
}

/// The map of the regime in which most of the mass on each face was captured, where there are several.
fn regimes(wall: &WallSurface, unrolled: &Unrolled, id: &str) -> Option<(Figure, bool)> {
    let masses = regime_masses(wall)?;
    let found = || Regime::ALL.into_iter().filter(|regime| masses[*regime as usize] > 0.0);
    if found().count() < 2 {
        return None;
    }
    let captured = wall.captured.as_ref()?;
    let by_regime = captured.each_ref().map(|values| shapes(&wall.faces, unrolled, values));
    let id = format!("{id}-regime");
    let fill = |place: usize| {
        let mass = |regime: &Regime| by_regime[*regime as usize][place].value;
        let most = Regime::ALL.into_iter().max_by(|a, b| mass(a).total_cmp(&mass(b)));
        let most = most.filter(|regime| mass(regime) > 0.0).map(regime_colour);
        most.map_or_else(|| format!("url(#{id}-hatch)"), str::to_owned)
    };
    let fills: Vec<String> = (0..by_regime[0].len()).map(fill).collect();
    let (mut map, is_stretched) = picture([&id, "Regime of capture"], unrolled, &by_regime[0], &fills)?;
    let [x, y] = map.beside();
    for (place, regime) in found().enumerate() {
        let share = percent(masses[regime as usize] / masses.iter().sum::<f64>());
        let at = [x, y + 36.0 * place as f64];
        map.add(&swatch(regime_colour(regime), at, &[regime.name(), &share]));
    }
    let caption = format!(
        "The regime in which most of the mass on a face was captured, of the parcels in the deposit cloud; per cent \
            of their mass. {REGIME_NAMES} Hatched: no such parcel."
    );
    Some((finished(map, &caption), is_stretched))
}

/// The ends of the scale: from zero for what piles up, or nearly so, and without a few far larger values.
pub(super) fn scale_ends(quantity: SurfaceQuantity, cells: &[MapCell]) -> [f64; 2] {
    let finite = || cells.iter().filter(|cell| cell.value.is_finite());
    let [low, high] = range(finite().map(|cell| cell.value));
    let from_low = match quantity {
        SurfaceQuantity::Deposit | SurfaceQuantity::Captured | SurfaceQuantity::Layer => low < 0.0,
        SurfaceQuantity::Temperature => true,
        SurfaceQuantity::HeatFlux => low < 0.0 || low > 0.3 * high,
    };
    if from_low {
        return [low, high];
    }
    let mut lying: Vec<&MapCell> = finite().filter(|cell| cell.value > 1e-6 * high).collect();
    lying.sort_by(|a, b| a.value.total_cmp(&b.value));
    let wanted = SCALE_AREA * lying.iter().map(|cell| cell.area).sum::<f64>();
    let mut area = 0.0;
    let end = lying.iter().find(|cell| {
        area += cell.area;
        area >= wanted
    });
    let end = end.map_or(high, |cell| cell.value);
    [0.0, if high > FAR_ABOVE * end { end } else { high }]
}

/// Range, mean and integral.
fn caption(wall: &WallSurface, quantity: SurfaceQuantity, values: &[f64]) -> String {
    let [low, high] = range(values.iter().copied());
    // A film that has drained leaves numbers like 1e-200.
    let low = if low.abs() < 1e-9 * high.abs() { 0.0 } else { low };
    let (sum, unit) = (wall.integral(values), quantity.unit());
    let mean = number(sum / wall.area());
    let mut caption = format!("{} to {}, mean {mean} over the area", number(low), with_unit(high, unit));
    match quantity {
        SurfaceQuantity::Deposit | SurfaceQuantity::Captured => {
            caption += &format!("; {} kg in all", number(sum))
        }
        SurfaceQuantity::HeatFlux => caption += &format!("; {} W in all", number(sum)),
        SurfaceQuantity::Layer | SurfaceQuantity::Temperature => {}
    }
    caption + "."
}

/// The share of the area above the scale, which ends at `top`, in a sentence; none without any.
fn above(cells: &[MapCell], top: f64) -> String {
    let is_beyond = |cell: &&MapCell| cell.value > top * (1.0 + 1e-9);
    let beyond: f64 = cells.iter().filter(is_beyond).map(|cell| cell.area).sum();
    if beyond <= 0.0 {
        return String::new();
    }
    let whole: f64 = cells.iter().map(|cell| cell.area).sum();
    format!(" {} of the area is above the scale.", percent(beyond / whole))
}

/// How a wall was unrolled, in sentences.
fn how(how: &Unrolling) -> String {
    match how {
        Unrolling::Flat => "A flat wall, seen at right angles.".to_owned(),
        Unrolling::Section(axis) => format!(
            "Unrolled around the axis {}: the length along the cross-section, from the side {} on, and the place \
                along the axis.",
            axis_words(axis),
            side(axis.begin)
        ),
        Unrolling::Angle { axis, radius, radii } => format!(
            "Unrolled around the axis {}: the angle, from the side {} on, as length at a radius of {} m, and the \
                place along the axis. Where the radius differs ({} to {} m) faces look wider or narrower than they \
                are.",
            axis_words(axis),
            side(axis.begin),
            number(*radius),
            number(radii[0]),
            number(radii[1])
        ),
        Unrolling::Projected => "The wall is neither flat nor around one axis: it is projected on the two main axes \
            over which it extends most. Parts hide others that lie behind them, and steep parts look smaller than \
            they are."
            .to_owned(),
    }
}

/// An axis by its direction and a place on it.
fn axis_words(axis: &WallAxis) -> String {
    // Without the rounding errors of zero.
    let [x, y, z] = axis.place.map(|part| number(if part.abs() < 1e-9 { 0.0 } else { part }));
    format!("{} through ({x}, {y}, {z}) m", direction(axis.direction))
}

/// `z`, or the parts of a direction that is along no main axis.
fn direction(direction: [f64; 3]) -> String {
    match direction.iter().position(|part| *part > 0.9999) {
        Some(axis) => ["x", "y", "z"][axis].to_owned(),
        None => {
            let [x, y, z] = direction.map(|part| format!("{:.2}", part + 0.0));
            format!("({x}, {y}, {z})")
        }
    }
}

/// A direction with its sign: `−x`.
fn side(begin: [f64; 3]) -> String {
    match begin.iter().position(|part| part.abs() > 0.99) {
        Some(axis) => format!("{}{}", if begin[axis] < 0.0 { "−" } else { "+" }, ["x", "y", "z"][axis]),
        None => direction(begin),
    }
}

fn axis_label(axis: PlaneAxis) -> String {
    match axis {
        PlaneAxis::Along(along) => format!("{} [m]", direction(along)),
        PlaneAxis::Around => "around the axis [m]".to_owned(),
    }
}
