//! On which numbers the captures of a case depend.
//!
//! Every number of the materials in use, of the model's laws and effects and of the case is moved
//! down and up within its range, one at a time and with the same random numbers, and the captures
//! are computed anew ([`super::Captures`]). The range is the stated one: `low` and `high` of a fit,
//! or `uncertainty` of a property. Otherwise it is assumed from the quality of the source
//! ([`Quality`]): 10 % with a source; for an assumed number a factor of 2, for densities, heat and
//! the case's own numbers 25 %, shares as odds, temperatures 10 or 50 K, angles 5 or 20 degrees. A
//! number that is then refused is moved half as far, and so on.

use serde::Serialize;
use toml_edit::{DocumentMut, Item, TableLike, Value};

use super::PredictionError;
use super::captures::{Captures, Flights, run_captures};
use super::case_number::SPREAD;
use super::case_text::{CaseText, change_value};
use super::number_name::{name_of, unit_of_key};
use crate::simulate::{DistributionKey, number_of};
use nearwall::law::QuantityKind;
use nearwall::material::BUILT_IN_TEXT;
use nearwall::material::SHEET_BAND;
use nearwall::slag::ash_fusion;

/// The kinds of a case's own numbers, by key; those of the model state theirs.
const CASE_KINDS: [(&str, QuantityKind); 10] = [
    ("carbon", QuantityKind::Share),
    ("conversion", QuantityKind::Share),
    ("voidage", QuantityKind::Share),
    ("accommodation", QuantityKind::Share),
    ("emissivity", QuantityKind::Share),
    ("temperature", QuantityKind::Temperature),
    ("radiation_temperature", QuantityKind::Temperature),
    ("melting_point", QuantityKind::Temperature),
    ("angle_deg", QuantityKind::Angle),
    ("azimuth_deg", QuantityKind::Angle),
];
/// Numbers of materials that are known better than strengths and energies, also where they are assumed.
const WELL_KNOWN: [&str; 5] =
    ["density", "heat_capacity", "thermal_conductivity", "heat_of_fusion", "composition"];
/// Properties that change a flight; for all other numbers of the model the flights up to the first contact are shared.
const OF_FLIGHT: [&str; 4] = ["density", "melting_point", "heat_capacity", "heat_of_fusion"];
/// Keys that are no physical numbers, or that are not uncertain.
const NOT_MOVED: [&str; 22] = [
    "source",
    "about",
    "unit",
    "valid",
    "uncertainty",
    "low",
    "high",
    "knots",
    "input",
    "kind",
    "on",
    "form",
    "count",
    "position",
    "direction",
    "name",
    "steps",
    "bins",
    "duration",
    "axis",
    "at",
    "T",
];
/// Times that a range is halved before a number is given up.
const RANGE_HALVINGS: usize = 6;

/// A part of the way to an item.
#[derive(Debug, Clone, PartialEq)]
enum KeyStep {
    Key(String),
    Index(usize),
}

/// How a number is moved.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Move {
    /// By a factor, either way.
    Factor(f64),
    /// By a factor on the odds of a share, either way.
    Odds(f64),
    /// By a difference.
    Difference(f64),
    /// To these ends, as factors.
    Ends([f64; 2]),
}

impl Move {
    /// The number at the low end (`side` -1) or the high end (1), `halvings` times half as far.
    fn apply(self, value: f64, side: f64, halvings: usize) -> f64 {
        let part = side * 0.5_f64.powi(i32::try_from(halvings).unwrap_or(i32::MAX));
        match self {
            Self::Factor(factor) => value * factor.powf(part),
            Self::Odds(factor) => {
                let odds = value / (1.0 - value) * factor.powf(part);
                odds / (1.0 + odds)
            }
            Self::Difference(difference) => value + part * difference,
            Self::Ends([low, high]) => {
                let end = if side < 0.0 { low } else { high };
                value * (1.0 + part.abs() * (end - 1.0))
            }
        }
    }
}

/// What the value and the ends of a number are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum NumberScale {
    /// Values in its unit.
    Value,
    /// Factors on all values of a table, polynomial or list.
    Factor,
    /// Differences of all values of a table, polynomial or list, in its unit.
    Difference,
}

impl NumberScale {
    /// Its name in files.
    fn name(self) -> &'static str {
        match self {
            Self::Value => "value",
            Self::Factor => "factor",
            Self::Difference => "difference",
        }
    }
}

/// How well a number is known without a stated range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Quality {
    /// Its range is stated.
    Stated,
    /// It has a source.
    Sourced,
    /// It is marked as assumed, or has no source.
    Assumed,
}

/// A number of a case that can be moved.
#[derive(Debug, Clone)]
struct Number {
    /// Dotted key.
    key: String,
    /// The items that hold it: a number, or a list that is moved as a whole.
    items: Vec<Vec<KeyStep>>,
    /// Its value; `None` for a table, polynomial or list.
    value: Option<f64>,
    how: Move,
    quality: Quality,
    source: Option<String>,
    range: String,
    /// Whether it changes flights up to the first contact.
    of_flight: bool,
}

impl Number {
    /// What its value and its ends are.
    fn scale(&self) -> NumberScale {
        match (self.value, self.how) {
            (Some(_), _) => NumberScale::Value,
            (None, Move::Difference(_)) => NumberScale::Difference,
            (None, _) => NumberScale::Factor,
        }
    }

    /// Its value; for all values of a table together the factor 1 or the difference 0.
    fn start(&self) -> f64 {
        let all = if matches!(self.how, Move::Difference(_)) { 0.0 } else { 1.0 };
        self.value.unwrap_or(all)
    }
}

/// A wall's captures under a moved number.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WallEffect {
    /// The wall.
    pub wall: String,
    /// Captured share of the injected mass with the number at its low end [1].
    pub captured_low: f64,
    /// With the number as it is [1].
    pub captured: f64,
    /// With the number at its high end [1].
    pub captured_high: f64,
    /// Largest difference between these [1].
    pub change: f64,
    /// Monte Carlo standard error of the difference between the ends [1].
    pub change_error: f64,
}

/// The effect of a number.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NumberEffect {
    /// Dotted key in the case, with the model as `model`.
    pub key: String,
    /// The same in words.
    pub name: String,
    /// Its unit: "1" for none, "" where it is not known.
    pub unit: &'static str,
    /// What value and ends are.
    pub scale: NumberScale,
    /// Its value; for a table, polynomial or list the factor 1 or the difference 0 of all its values.
    pub value: f64,
    /// The low end of its range; for a table a factor or a difference.
    pub low: f64,
    /// The high end.
    pub high: f64,
    /// What the ends of the range are.
    pub range: String,
    /// Where the range comes from.
    pub quality: Quality,
    /// The number's source or comment.
    pub source: Option<String>,
    /// By wall.
    pub walls: Vec<WallEffect>,
    /// Largest change at any wall [1].
    pub largest: f64,
}

/// The numbers of a case by their effect, largest first.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Sensitivity {
    /// `nearwall.sensitivity/1`.
    pub schema: &'static str,
    /// Title of the case.
    pub title: String,
    /// Number of followed particles.
    pub particles: u64,
    /// Whether the walls kept a deposit.
    pub deposit: bool,
    /// The numbers.
    pub numbers: Vec<NumberEffect>,
    /// What was left out.
    pub notes: Vec<String>,
}

impl Sensitivity {
    /// Writes a row for each number and wall.
    ///
    /// # Errors
    /// When the sink cannot be written to.
    pub fn write_csv<W: std::io::Write>(&self, sink: W) -> csv::Result<W> {
        let mut writer = csv::Writer::from_writer(sink);
        writer.write_record([
            "rank",
            "number",
            "name",
            "unit",
            "scale",
            "wall",
            "value",
            "low",
            "high",
            "captured_low",
            "captured",
            "captured_high",
            "change",
            "change_error",
            "quality",
            "range",
            "source",
        ])?;
        for (rank, number) in self.numbers.iter().enumerate() {
            for wall in &number.walls {
                let mut row = vec![(rank + 1).to_string(), number.key.clone(), number.name.clone()];
                row.extend([number.unit, number.scale.name(), &wall.wall].map(str::to_owned));
                row.extend([number.value, number.low, number.high].map(|value| value.to_string()));
                let shares =
                    [wall.captured_low, wall.captured, wall.captured_high, wall.change, wall.change_error];
                row.extend(shares.map(|share| share.to_string()));
                row.push(format!("{:?}", number.quality).to_lowercase());
                row.extend([number.range.clone(), number.source.clone().unwrap_or_default()]);
                writer.write_record(&row)?;
            }
        }
        writer.into_inner().map_err(|error| error.into_error().into())
    }
}

/// The text of a case whose numbers are moved.
#[derive(Debug)]
pub struct SensitivityCase {
    text: CaseText,
    document: DocumentMut,
    numbers: Vec<Number>,
    notes: Vec<String>,
    /// Number of particles that the case states.
    stated: u64,
}

impl SensitivityCase {
    /// The case with at most `particles` particles; with `clean_walls` without its `[deposit]`.
    ///
    /// # Errors
    /// What is wrong with the case.
    pub fn new(text: CaseText, particles: u64, clean_walls: bool) -> Result<Self, PredictionError> {
        let mut document = text.document().clone();
        let mut notes = Vec::new();
        if clean_walls && document.remove("deposit").is_some() {
            notes.push("walls without a memory".to_owned());
        }
        add_materials(&mut document);
        if text.has_sweep() {
            notes.push("the [sweep] is left out: each number is that of the case or of --set".to_owned());
        }
        let base = text.read(&document)?;
        let stated = base.count();
        if stated > particles {
            for place in injections(&document) {
                if let Some(count) = item_mut(&mut document, &place).and_then(|item| item.get_mut("count"))
                    && let Some(own) = count.as_integer()
                {
                    let share = (own as f64 * particles as f64 / stated as f64).ceil().max(1.0);
                    *count = toml_edit::value(share as i64);
                }
            }
        }
        if base.has_own_models() {
            notes.push("numbers in the model files of single [[particles]] were not moved".to_owned());
        }
        let numbers = numbers(&document);
        Ok(Self { text, document, numbers, notes, stated })
    }

    /// How many numbers are moved.
    pub fn count(&self) -> usize {
        self.numbers.len()
    }

    /// Moves every number. `progress` is called after each.
    ///
    /// # Errors
    /// Why the case cannot be computed as it is.
    pub fn run(mut self, progress: &(dyn Fn() + Sync)) -> Result<Sensitivity, PredictionError> {
        let case = self.text.read(&self.document)?;
        let flights = case.deposit.is_none().then(|| Flights::new(&case, u64::MAX));
        let base = match &flights {
            Some(flights) => flights.captures(&case.model)?,
            None => run_captures(&case)?,
        };
        let mut notes = std::mem::take(&mut self.notes);
        notes.extend(self.fewer_particles(case.count()));
        notes.extend(
            base.trouble.iter().map(|trouble| format!("not every particle could be used: {trouble}")),
        );
        let mut found = Vec::new();
        for number in &self.numbers {
            match self.effect(number, flights.as_ref(), &base) {
                Ok(effect) => found.push(effect),
                Err(reason) => notes.push(format!("{} could not be moved: {reason}", number.key)),
            }
            progress();
        }
        found.sort_by(|a, b| b.largest.total_cmp(&a.largest));
        Ok(Sensitivity {
            schema: "nearwall.sensitivity/1",
            title: case.title.clone(),
            particles: case.count(),
            deposit: case.deposit.is_some(),
            numbers: found,
            notes,
        })
    }

    /// Why the captures of the unchanged case are not those of its report, where fewer particles are followed.
    fn fewer_particles(&self, followed: u64) -> Option<String> {
        (followed < self.stated).then(|| {
            format!(
                "{followed} of the case's {} particles are followed, so that what it captures unchanged may differ \
                 from `nearwall simulate`; --particles {} follows all",
                self.stated, self.stated
            )
        })
    }

    fn effect(
        &self,
        number: &Number,
        flights: Option<&Flights<'_>>,
        base: &Captures,
    ) -> Result<NumberEffect, PredictionError> {
        // An end that is refused stays where the number is.
        let unmoved = || (number.how.apply(number.start(), 0.0, 0), base.clone());
        let sound = base.trouble.is_none();
        let ends = [-1.0, 1.0].map(|side| self.moved(number, side, flights, sound));
        if let [Err(reason), Err(_)] = &ends {
            return Err(reason.clone());
        }
        let [(low, low_captures), (high, high_captures)] = ends.map(|end| end.unwrap_or_else(|_| unmoved()));
        let walls = wall_effects([&low_captures, base, &high_captures]);
        Ok(NumberEffect {
            key: number.key.clone(),
            name: name_of(&number.key),
            unit: unit_of_key(&number.key),
            scale: number.scale(),
            value: number.start(),
            low,
            high,
            range: number.range.clone(),
            quality: number.quality,
            source: number.source.clone(),
            largest: walls.iter().map(|wall| wall.change).fold(0.0, f64::max),
            walls,
        })
    }

    /// The number at an end of its range and the captures there; nearer where the end is refused, or some particles
    /// cannot be used that could (`sound`) where the number is.
    fn moved(
        &self,
        number: &Number,
        side: f64,
        flights: Option<&Flights<'_>>,
        sound: bool,
    ) -> Result<(f64, Captures), PredictionError> {
        let mut refused = PredictionError::NoParticle(String::new());
        for halvings in 0..RANGE_HALVINGS {
            let mut document = self.document.clone();
            for place in &number.items {
                if let Some(item) = item_mut(&mut document, place) {
                    change(item, &|value| number.how.apply(value, side, halvings));
                }
            }
            let case = self.text.read(&document).map_err(PredictionError::from);
            let captures = case.and_then(|case| match flights {
                Some(flights) if !number.of_flight => flights.captures(&case.model),
                Some(_) => Flights::new(&case, u64::MAX).captures(&case.model),
                None => run_captures(&case),
            });
            match captures {
                Ok(Captures { trouble: Some(reason), .. }) if sound => {
                    refused = PredictionError::NoParticle(reason)
                }
                Ok(captures) => return Ok((number.how.apply(number.start(), side, halvings), captures)),
                Err(reason) => refused = reason,
            }
        }
        Err(refused)
    }
}

/// Copies the built-in materials in use into the model, so that their numbers can be moved.
fn add_materials(document: &mut DocumentMut) {
    let names = materials(document);
    let Ok(built_in) = BUILT_IN_TEXT.parse::<DocumentMut>() else { return };
    let Some(model) = document.get_mut("model").and_then(Item::as_table_mut) else { return };
    let own = model.entry("materials").or_insert(toml_edit::table());
    let Some(own) = own.as_table_like_mut() else { return };
    write_out_likes(own, &built_in);
    for name in names {
        if let Some(material) = built_in.get(&name).filter(|_| !own.contains_key(&name)) {
            own.insert(&name, material.clone());
        }
    }
}

/// Gives each material that is `like` another the numbers that it takes from that one.
fn write_out_likes(own: &mut dyn TableLike, built_in: &DocumentMut) {
    let names: Vec<String> = own.iter().map(|(name, _)| name.to_owned()).collect();
    for (place, name) in names.iter().enumerate() {
        let like = own.get(name).and_then(|material| material.get("like")).and_then(Item::as_str);
        let Some(like) = like.map(str::to_owned) else { continue };
        let base = if names[..place].contains(&like) { own.get(&like) } else { built_in.get(&like) };
        let (Some(base), Some(table)) = (base.cloned(), own.get_mut(name)) else { continue };
        let (Some(base), Some(table)) = (base.as_table_like(), table.as_table_like_mut()) else { continue };
        table.remove("like");
        for (key, item) in base.iter() {
            if !table.contains_key(key) {
                table.insert(key, item.clone());
            }
        }
    }
}

/// Names of the materials in use.
fn materials(document: &DocumentMut) -> Vec<String> {
    let Some(model) = document.get("model") else { return Vec::new() };
    let named = |table: Option<&Item>, keys: &[&str]| -> Vec<String> {
        let text = |key: &&str| table?.get(key)?.as_str().map(str::to_owned);
        keys.iter().filter_map(text).collect()
    };
    let mut names = named(model.get("particle"), &["material", "ash"]);
    let walls = model.get("walls").and_then(Item::as_table_like);
    for (_, wall) in walls.iter().flat_map(|walls| walls.iter()) {
        names.extend(named(Some(wall), &["material", "slag", "powder"]));
    }
    names.sort();
    names.dedup();
    names
}

/// The tables of the particles.
fn injections(document: &DocumentMut) -> Vec<Vec<KeyStep>> {
    let particles = vec![KeyStep::Key("particles".to_owned())];
    match document.get("particles") {
        Some(Item::ArrayOfTables(tables)) => {
            let one = |index| particles.iter().cloned().chain([KeyStep::Index(index)]).collect();
            (0..tables.len()).map(one).collect()
        }
        _ => vec![particles],
    }
}

fn item_mut<'a>(document: &'a mut DocumentMut, place: &[KeyStep]) -> Option<&'a mut Item> {
    let mut item = document.as_item_mut();
    for step in place {
        item = match step {
            KeyStep::Key(key) => item.get_mut(key.as_str())?,
            KeyStep::Index(index) => item.get_mut(*index)?,
        };
    }
    Some(item)
}

/// Changes a number, or every number of a list.
fn change(item: &mut Item, with: &dyn Fn(f64) -> f64) {
    if let Some(value) = item.as_value_mut() {
        change_value(value, with);
    }
}

/// The first number of an item, and whether it is the only one.
fn first_number(item: &Item) -> Option<(f64, bool)> {
    let value = item.as_value()?;
    match value {
        Value::Array(list) => {
            let mut numbers = list.iter().filter_map(number_of).filter(|number| *number != 0.0);
            numbers.next().map(|first| (first, false))
        }
        other => number_of(other).filter(|number| *number != 0.0).map(|number| (number, true)),
    }
}

/// Where numbers are looked for: key of a table, and whether it belongs to the model.
fn numbers(document: &DocumentMut) -> Vec<Number> {
    let mut found = Finder { used: materials(document), source_of_table: None, found: Vec::new() };
    for key in ["model", "particles", "conversion", "gas", "deposit"] {
        if let Some(item) = document.get(key) {
            found.item(item, &[KeyStep::Key(key.to_owned())], key);
        }
    }
    if let Some(Item::ArrayOfTables(walls)) = document.get("walls") {
        for (index, wall) in walls.iter().enumerate() {
            let name = wall.get("name").and_then(Item::as_str).unwrap_or("?");
            if let Some(item) = wall.get("temperature") {
                let place = ["walls", "temperature"].map(|key| KeyStep::Key(key.to_owned()));
                let [walls, temperature] = place;
                found.item(
                    item,
                    &[walls, KeyStep::Index(index), temperature],
                    &format!("walls.{name}.temperature"),
                );
            }
        }
    }
    found.found
}

struct Finder {
    /// Materials in use.
    used: Vec<String>,
    /// The source of the table that holds the present number, or the comment after it; true for a source.
    source_of_table: Option<(String, bool)>,
    found: Vec<Number>,
}

impl Finder {
    fn item(&mut self, item: &Item, place: &[KeyStep], key: &str) {
        let join = |step: KeyStep| place.iter().cloned().chain([step]).collect::<Vec<_>>();
        if let Some(tables) = item.as_array_of_tables() {
            for (index, table) in tables.iter().enumerate() {
                let named = ["name", "kind"].iter().find_map(|key| table.get(key)?.as_str());
                let key = format!("{key}.{}", named.map_or(index.to_string(), str::to_owned));
                self.item(&Item::Table(table.clone()), &join(KeyStep::Index(index)), &key);
            }
        } else if let Some(list) = item.as_array().filter(|list| list.iter().all(Value::is_inline_table)) {
            for (index, table) in list.iter().enumerate() {
                let named = table.as_inline_table().and_then(|table| table.get("kind")?.as_str());
                let key = format!("{key}.{}", named.map_or(index.to_string(), str::to_owned));
                self.item(&Item::Value(table.clone()), &join(KeyStep::Index(index)), &key);
            }
        } else if is_quantity(item) {
            self.quantity(item, place, key);
        } else if let Some(table) = item.as_table_like() {
            let spread = table.contains_key("distribution");
            let of_materials = key == "model.materials";
            let source = table.get("source").and_then(Item::as_str).map(|source| (source.to_owned(), true));
            let source = source.or_else(|| Some((comment(item)?, false)));
            let outer = std::mem::replace(&mut self.source_of_table, source);
            for (name, item) in table.iter() {
                let skipped = NOT_MOVED.contains(&name)
                    || (spread && DistributionKey::of(name) == Some(DistributionKey::Bound))
                    || (of_materials && !self.used.iter().any(|used| used == name));
                if !skipped {
                    self.item(item, &join(KeyStep::Key(name.to_owned())), &format!("{key}.{name}"));
                }
            }
            self.source_of_table = outer;
        } else if first_number(item).is_some() {
            self.quantity(item, place, key);
        }
    }

    /// Adds a number, or a table with `value`, `polynomial` or `arrhenius`, or an ash sheet.
    fn quantity(&mut self, item: &Item, place: &[KeyStep], key: &str) {
        let mut items = Vec::new();
        leaves(item, place, &mut items);
        let Some((first, only)) = items.iter().find_map(|(_, leaf)| first_number(leaf)) else { return };
        let value = (only && items.len() == 1).then_some(first);
        let stated = |name: &str| item.get(name).and_then(Item::as_value).and_then(number_of);
        let own = item.get("source").and_then(Item::as_str).map(|source| (source.to_owned(), true));
        let own = own.or_else(|| Some((comment(item)?, false)));
        let source = own.or_else(|| self.source_of_table.clone());
        let assumed = source.as_ref().is_none_or(|(source, stated)| is_assumed(source, *stated));
        let source = source.map(|(source, _)| source);
        let quality = if assumed { Quality::Assumed } else { Quality::Sourced };
        let own = quality_range(key, first, assumed);
        let (how, quality, range) = match (value, stated("low").zip(stated("high")), stated("uncertainty")) {
            (Some(value), Some((low, high)), _) if low <= value && value <= high => {
                (Move::Ends([low / value, high / value]), Quality::Stated, "interval of the fit".to_owned())
            }
            (_, _, Some(uncertainty)) if uncertainty > 0.0 && uncertainty < first.abs() => {
                let share = uncertainty / first.abs();
                let how = match value {
                    None if is_temperature(key, first) => Move::Difference(uncertainty),
                    _ => Move::Ends([1.0 - share, 1.0 + share]),
                };
                (how, Quality::Stated, "stated uncertainty".to_owned())
            }
            _ => match source.as_deref().and_then(stated_factor) {
                Some(factor) => {
                    (Move::Factor(factor), Quality::Stated, format!("factor {factor}, as its source says"))
                }
                None => (own.0, quality, own.1),
            },
        };
        let of_model = key.starts_with("model.");
        let last = key.rsplit('.').next().unwrap_or(key);
        self.found.push(Number {
            key: key.to_owned(),
            items: items.into_iter().map(|(place, _)| place).collect(),
            value,
            how,
            quality,
            source,
            range,
            of_flight: !of_model || (key.starts_with("model.materials.") && OF_FLIGHT.contains(&last)),
        });
    }
}

/// Whether an item is a table with the number or numbers of one quantity.
fn is_quantity(item: &Item) -> bool {
    let holds = |key: &str| item.get(key).is_some_and(|item| first_number(item).is_some());
    item.as_table_like()
        .is_some_and(|table| !table.contains_key("kind") && !table.contains_key("distribution"))
        && ["value", "polynomial", "arrhenius", "deformation"].iter().any(|key| holds(key))
}

/// The items that hold the numbers of a quantity.
fn leaves(item: &Item, place: &[KeyStep], found: &mut Vec<(Vec<KeyStep>, Item)>) {
    let join = |key: &str| place.iter().cloned().chain([KeyStep::Key(key.to_owned())]).collect::<Vec<_>>();
    if item.as_table_like().is_none() {
        found.push((place.to_vec(), item.clone()));
        return;
    }
    for key in ["value", "polynomial"].into_iter().chain(ash_fusion::NAMES) {
        if let Some(item) = item.get(key) {
            found.push((join(key), item.clone()));
        }
    }
    if let Some(factor) = item.get("arrhenius").and_then(|pair| pair.get(0)) {
        let place: Vec<KeyStep> = join("arrhenius").into_iter().chain([KeyStep::Index(0)]).collect();
        found.push((place, factor.clone()));
    }
    if let Some(melt) = item.get("melt") {
        leaves(melt, &join("melt"), found);
    }
}

/// The comment after a number, on the same line.
fn comment(item: &Item) -> Option<String> {
    let text = item.as_value()?.decor().suffix()?.as_str()?.to_owned();
    let comment = text.lines().next()?.trim().trim_start_matches('#').trim();
    (comment.split_whitespace().count() > 2).then(|| comment.to_owned())
}

/// Whether a source says that a number is assumed; `own` for a key `source`, which then starts with it.
fn is_assumed(source: &str, own: bool) -> bool {
    let source = source.to_lowercase();
    if own { source.starts_with("assumed") } else { source.contains("assumed") }
}

/// The factor that a source states: "uncertain by a factor 10".
fn stated_factor(source: &str) -> Option<f64> {
    let (_, rest) = source.split_once("uncertain by a factor ")?;
    let digits = rest.trim_start_matches("of ");
    let end = digits.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(digits.len());
    digits[..end].trim_end_matches('.').parse().ok().filter(|factor: &f64| *factor > 1.0)
}

/// The kind of a number by its dotted key.
fn kind_of(key: &str) -> QuantityKind {
    let parts: Vec<&str> = key.split('.').collect();
    let [before @ .., last] = parts.as_slice() else { return QuantityKind::Amount };
    if let ["model", path @ ..] = parts.as_slice() {
        return nearwall::model::kind_of(path).unwrap_or(QuantityKind::Amount);
    }
    let of = |part: &&str| CASE_KINDS.iter().find(|(name, _)| name == part).map(|(_, kind)| *kind);
    // The numbers of a distribution: only its middle and its ends are temperatures or angles.
    let is_spread = SPREAD.iter().any(|spread| DistributionKey::of(last) == Some(*spread));
    of(last).unwrap_or_else(|| match before.last().and_then(of) {
        Some(kind @ (QuantityKind::Temperature | QuantityKind::Angle)) if !is_spread => kind,
        _ => QuantityKind::Amount,
    })
}

/// Whether a number is a temperature in K that is not 0 or a factor.
fn is_temperature(key: &str, value: f64) -> bool {
    value > 100.0 && kind_of(key) == QuantityKind::Temperature
}

/// How a number without a stated range is moved, and in words.
fn quality_range(key: &str, value: f64, assumed: bool) -> (Move, String) {
    let parts: Vec<&str> = key.split('.').collect();
    let either = |yes: f64, no: f64| if assumed { yes } else { no };
    let by_difference =
        |difference: f64, unit: &str| (Move::Difference(difference), format!("± {difference} {unit}"));
    let well_known = !key.starts_with("model.") || parts.iter().any(|part| WELL_KNOWN.contains(part));
    // An activation energy stands in an exponent; its pre-exponential factor belongs to it.
    let in_exponent = parts.last() == Some(&"activation_energy");
    let factor = if in_exponent { 1.1 } else { either(if well_known { 1.25 } else { 2.0 }, 1.1) };
    match kind_of(key) {
        _ if parts.last() == Some(&"fusion_temperatures") => by_difference(SHEET_BAND, "K"),
        QuantityKind::Temperature if value > 100.0 => by_difference(either(50.0, 10.0), "K"),
        QuantityKind::Angle => by_difference(either(20.0, 5.0), "degrees"),
        QuantityKind::Share if value > 0.0 && value < 1.0 => {
            (Move::Odds(factor), format!("factor {factor} on the odds"))
        }
        _ => (Move::Factor(factor), format!("factor {factor}")),
    }
}

/// What a number moves on each wall, from the captures at its low end, where it is, and at its high end.
fn wall_effects([low, middle, high]: [&Captures; 3]) -> Vec<WallEffect> {
    let of = |(place, wall): (usize, &String)| {
        let [captured_low, captured, captured_high] = [low, middle, high].map(|one| one.mass_share(place));
        let most = captured_low.max(captured).max(captured_high);
        let least = captured_low.min(captured).min(captured_high);
        WallEffect {
            wall: wall.clone(),
            captured_low,
            captured,
            captured_high,
            change: most - least,
            change_error: high.error_of_difference(low, place),
        }
    };
    middle.walls.iter().enumerate().map(of).collect()
}
