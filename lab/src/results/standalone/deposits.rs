//! `deposit.csv`: what lies on each bin of each wall over time, and the same summed up by wall for the page.

use std::io::Write;

use super::Run;
use super::impacts::text;
use crate::results::History;
use crate::results::openfoam::deposit::{COLUMNS, DepositState};
use crate::simulate::{BinHistory, Case, WallHistory};
use nearwall::deposit::PROCESSES;
use nearwall::model::{Wall, WallHeat};

const HEADER: [&str; 16] = [
    "time_s",
    "wall",
    "from_m",
    "to_m",
    "area_m2",
    "coverage",
    "molten_kg_m2",
    "powder_kg_m2",
    "frozen_kg_m2",
    "inner_powder_kg_m2",
    "layer_thickness_m",
    "projected_area",
    "conversion",
    "arrived_kg",
    "burnt_kg",
    "on_wall_kg",
];

/// Further columns of a case with a cooled wall; blank for walls of a given temperature.
const HEAT_HEADER: [&str; 6] = [
    "porosity",
    "surface_temperature_K",
    "wall_temperature_K",
    "heat_flux_W_m2",
    "coolant_flux_W_m2",
    "particle_flux_W_m2",
];

/// Further columns of a case with a wall that loses deposits, or gains some other than by particles: the place of each
/// process in [`PROCESSES`], the name of its loss or gain, and the sign of a loss.
fn exchanges() -> impl Iterator<Item = (usize, &'static str, f64)> {
    PROCESSES.iter().enumerate().filter_map(|(place, process)| {
        let loss = process.loss.map(|name| (place, name, 1.0));
        loss.or_else(|| process.gain.map(|name| (place, name, -1.0)))
    })
}

/// Writes the table: one row for each time, wall and bin, and for each value of a sweep. Masses in kg are of the bin.
///
/// # Errors
/// When the sink cannot be written to.
pub fn write<W: Write>(sink: W, case: &Case, runs: &[Run]) -> csv::Result<W> {
    let mut writer = csv::Writer::from_writer(sink);
    let swept = case.sweep.as_ref().map(|sweep| format!("swept_{}", sweep.key));
    let cooled = |run: &Run| {
        run.deposits
            .iter()
            .flat_map(|all| &all.walls)
            .flat_map(|wall| &wall.bins)
            .any(|bin| !bin.heat.is_empty())
    };
    let heat = if runs.iter().any(cooled) { HEAT_HEADER.len() } else { 0 };
    let acts = |place: usize| move |wall: &Wall| wall.processes().any(|(acting, _)| acting == place);
    let lost: Vec<_> =
        exchanges().filter(|(place, ..)| case.model.walls().iter().any(acts(*place))).collect();
    let header = HEADER.into_iter().chain(HEAT_HEADER.into_iter().take(heat)).map(str::to_owned);
    let header = header.chain(lost.iter().map(|(_, name, _)| format!("{name}_kg")));
    writer.write_record(header.chain(swept))?;
    let Some(settings) = case.deposit else { return into_sink(writer) };
    for run in runs {
        let walls = || run.deposits.iter().flat_map(|deposits| &deposits.walls);
        for step in 0..=settings.steps as usize {
            let time = settings.duration * step as f64 / settings.steps as f64;
            for (wall, bin) in walls().flat_map(|wall| wall.bins.iter().map(move |bin| (wall, bin))) {
                let name = case.surfaces[wall.surface].name.clone();
                let cells = row(bin, step, settings.voidage).map(text);
                let heat = heat_row(bin, step, settings.voidage).into_iter().take(heat);
                let losses = lost.iter().map(|(place, _, sign)| text(sign * bin.lost[step][*place]));
                let cells = [text(time), name].into_iter().chain(cells).chain(heat).chain(losses);
                let cells = cells.chain(run.value.map(text));
                writer.write_record(cells)?;
            }
        }
    }
    into_sink(writer)
}

fn into_sink<W: Write>(writer: csv::Writer<W>) -> csv::Result<W> {
    writer.into_inner().map_err(|error| error.into_error().into())
}

fn row(bin: &BinHistory, step: usize, voidage: f64) -> [f64; 14] {
    let state = &bin.states[step];
    [
        bin.range[0],
        bin.range[1],
        bin.area,
        state.coverage(),
        state.molten,
        state.powder,
        state.frozen,
        state.layers().inner_powder,
        state.layer_thickness(voidage),
        state.cover,
        state.conversion,
        bin.arrived[step],
        bin.burnt[step],
        state.mass() * bin.area,
    ]
}

/// The cells of [`HEAT_HEADER`].
fn heat_row(bin: &BinHistory, step: usize, voidage: f64) -> [String; 6] {
    let Some((heat, particles)) = bin.heat.get(step).zip(bin.particle_flux.get(step)) else {
        return Default::default();
    };
    [
        bin.states[step].porosity(voidage),
        heat.surface_temperature,
        heat.wall_temperature,
        heat.heat_flux,
        heat.coolant_flux,
        *particles,
    ]
    .map(text)
}

/// The deposits of a run by wall, in the columns of the page.
pub(super) fn by_wall(case: &Case, run: &Run) -> Vec<History<DepositState>> {
    let Some((settings, deposits)) = case.deposit.zip(run.deposits.as_ref()) else { return Vec::new() };
    let time = |step: usize| settings.duration * step as f64 / settings.steps as f64;
    let history = |wall: &WallHistory| History {
        wall: case.surfaces[wall.surface].name.clone(),
        rows: (0..=settings.steps as usize)
            .map(|step| (time(step), state(&wall.bins, step, settings.voidage)))
            .collect(),
    };
    deposits.walls.iter().map(history).collect()
}

/// The columns of [`COLUMNS`] for a wall after a step.
fn state(bins: &[BinHistory], step: usize, voidage: f64) -> DepositState {
    let sum = |of: &dyn Fn(&BinHistory) -> f64| bins.iter().map(of).sum::<f64>();
    let largest = |of: &dyn Fn(&BinHistory) -> f64| bins.iter().map(of).fold(f64::NAN, f64::max);
    let area = sum(&|bin| bin.area);
    let coverage = |bin: &BinHistory| bin.states[step].coverage();
    let layer = |bin: &BinHistory| bin.states[step].layer_thickness(voidage);
    // Of a cooled wall; that of another one is given.
    let heat = |bin: &BinHistory, of: fn(&WallHeat) -> f64| bin.heat.get(step).map_or(f64::NAN, of);
    let surface = |bin: &BinHistory| heat(bin, |heat| heat.surface_temperature);
    let flux = |bin: &BinHistory| heat(bin, |heat| heat.heat_flux);
    COLUMNS.map(|column| match column {
        "initial_kg" => sum(&|bin| bin.states[0].mass() * bin.area),
        "arrived_kg" => sum(&|bin| bin.arrived[step]),
        "molten_kg" => sum(&|bin| bin.states[step].molten * bin.area),
        "frozen_kg" => sum(&|bin| bin.states[step].frozen * bin.area),
        "powder_kg" => sum(&|bin| bin.states[step].powder * bin.area),
        "coverage_mean" => sum(&|bin| coverage(bin) * bin.area) / area,
        "coverage_max" => largest(&coverage),
        "layer_thickness_mean_m" => sum(&|bin| layer(bin) * bin.area) / area,
        "layer_thickness_max_m" => largest(&layer),
        "wall_temperature_mean_K" => sum(&|bin| surface(bin) * bin.area) / area,
        "wall_temperature_max_K" => largest(&surface),
        "heat_flux_mean_W_m2" => sum(&|bin| flux(bin) * bin.area) / area,
        "heat_flux_max_W_m2" => largest(&flux),
        // Nothing drains in a standalone case.
        _ => exchanges()
            .find(|(_, name, _)| column.strip_suffix("_kg") == Some(name))
            .map_or(0.0, |(place, _, sign)| sum(&|bin| sign * bin.lost[step][place])),
    })
}
