//! `nearwall map`: what a model decides over any two or three inputs of an impact.

use std::path::PathBuf;

use crate::atomic_file::write_texts;
use crate::dataset::WallChoice;
use crate::map::{Cell, DEFAULT_POINTS, InputAxis, MapSeries, SLIDER_POINTS, Setting, default_axes};
use crate::report::map_page;
use nearwall::Model;
use nearwall::impact::{INPUTS, Impact};

use super::CommandResult;

/// Draws e_n, e_t, sticking probability and regime over any two inputs, and a third one by a slider
#[derive(clap::Args)]
#[command(after_help = after_help())]
pub struct Arguments {
    /// The model file
    model: PathBuf,
    /// The input along the x axis, its range and its number of points; by default v_n
    #[arg(long, value_name = "INPUT=LOW:HIGH[:N]")]
    x: Option<InputAxis>,
    /// The input along the y axis; by default the first of T_w, d, T_p, conversion, v_t that changes the outcome
    #[arg(long, value_name = "INPUT=LOW:HIGH[:N]")]
    y: Option<InputAxis>,
    /// A third input: the page has a slider over its values
    #[arg(long, value_name = "INPUT=LOW:HIGH[:N]", value_parser = InputAxis::slider)]
    slider: Option<InputAxis>,
    /// Value of another input; may be given several times
    #[arg(long, value_name = "INPUT=VALUE")]
    set: Vec<Setting>,
    /// The wall that is hit; by default the wall `default`, then the only wall
    #[arg(long)]
    wall: Option<String>,
    /// Output folder
    #[arg(short, value_name = "DIR", default_value = "map")]
    output: PathBuf,
}

fn after_help() -> String {
    let inputs: Vec<String> = INPUTS.iter().map(|input| format!("{} [{}]", input.name, input.unit)).collect();
    format!(
        "Examples:\n  nearwall map nearWall.toml --wall slagWall --x T_w=1200:1800 --y conversion=0:1 --set \
            T_p=1700\n  nearwall map nearWall.toml --x v_n=0.1:30 --y d=1e-6:1e-3 --slider T_p=900:1700:9\n\n\
         Writes map.html and map.csv into the folder. The inputs are\n{}.\n\
         An axis has {DEFAULT_POINTS} points, a slider {SLIDER_POINTS}, evenly spaced in the logarithm from a ratio \
         of\n\
         30 of both ends on. docs/how-to/map.md describes the numbers.",
        inputs.join(", ")
    )
}

pub fn run(arguments: &Arguments) -> CommandResult {
    let model = Model::from_file(&arguments.model)?;
    let walls = WallChoice::new(&model, arguments.wall.as_deref())?;
    walls.check(false)?;
    let wall = walls.of(None)?;
    let fixed = fixed_inputs(arguments)?;
    let axes = default_axes(&model, wall, &fixed, given_axes(arguments), DEFAULT_POINTS);
    let axes = axes.ok_or("no default range for the axes; give --x and --y")?;
    let map = MapSeries::new(&model, wall, axes, arguments.slider, fixed);
    if let Some(reason) = map.first_refusal().filter(|_| map.undecided() == map.count()) {
        return Err(
            format!("{}: no impact of this map can be decided: {reason}", arguments.model.display()).into()
        );
    }
    write(arguments, &map)?;
    super::print_page(&summary(&map), &arguments.output.join("map.html"))
}

/// The inputs along x and y and of the slider.
fn given_axes(arguments: &Arguments) -> [Option<InputAxis>; 3] {
    [arguments.x, arguments.y, arguments.slider]
}

/// The inputs that are the same in all impacts.
fn fixed_inputs(arguments: &Arguments) -> CommandResult<Impact> {
    let mut fixed = Impact { normal_speed: 1.0, ..Impact::default() };
    let axes: Vec<&str> = given_axes(arguments).iter().flatten().map(|axis| axis.input().name).collect();
    let name = |axis: Option<InputAxis>| axis.map(|axis| axis.input().name);
    let [x, y, third] = given_axes(arguments).map(name);
    if let Some(y) = y.filter(|_| y == x) {
        return Err(format!("--y {y}: the input is already along x").into());
    }
    if let Some(third) = third.filter(|_| third == x || third == y) {
        return Err(format!("--slider {third}: the input is already along an axis").into());
    }
    for (place, setting) in arguments.set.iter().enumerate() {
        let name = setting.input().name;
        if axes.contains(&name) {
            return Err(format!("--set {name}: the input is along an axis").into());
        }
        if arguments.set[..place].iter().any(|other| other.input().name == name) {
            return Err(format!("--set {name}: given twice").into());
        }
        setting.apply(&mut fixed);
    }
    Ok(fixed)
}

/// Writes both files, or none.
fn write(arguments: &Arguments, map: &MapSeries) -> CommandResult {
    let Arguments { model, output, .. } = arguments;
    let page = map_page(map, &model.display().to_string())?;
    Ok(write_texts(output, &[model], [("map.csv", table(map)?), ("map.html", page)])?)
}

/// One row for each impact; blank where nothing is decided, and `e_n`, `e_t` where no particle rebounds.
fn table(map: &MapSeries) -> CommandResult<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let inputs = map.axes().into_iter().map(|axis| axis.input().name);
    let outcomes = ["e_n", "e_t", "p_stick", "regime", "outside_range", "matters"];
    writer.write_record(inputs.chain(outcomes))?;
    for (value, map) in map.by_value() {
        for (place, cell) in map.places().zip(&map.cells) {
            let decided = cell.map_or_else(Default::default, |cell| texts(&cell));
            let inputs = place.into_iter().chain(value).map(|input| input.to_string());
            writer.write_record(inputs.chain(decided))?;
        }
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// The cells of a decided impact.
fn texts(cell: &Cell) -> [String; 6] {
    let restitution =
        |which: usize| cell.restitution.map_or(String::new(), |pair| format!("{:.16e}", pair[which]));
    [
        restitution(0),
        restitution(1),
        format!("{:.16e}", cell.sticking_probability),
        cell.regime.name().to_owned(),
        cell.outside_range.to_string(),
        cell.beyond.to_string(),
    ]
}

fn summary(map: &MapSeries) -> String {
    let all = map.count();
    let wall = map.maps.first().map_or("", |map| &map.wall);
    let inputs: Vec<&str> = map.axes().iter().map(|axis| axis.input().name).collect();
    let mut text = format!("{all} impacts on the wall {wall}: {}\n", inputs.join(" x "));
    if let Some(reason) = map.first_refusal() {
        text += &format!(
            "{} of {all} could not be decided and are blank; the first: {reason}\n",
            map.undecided()
        );
    }
    for line in map.ranges().lines("impacts") {
        text += &format!("{line}\n");
    }
    text
}
