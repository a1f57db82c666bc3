//! Arrivals at walls as OpenFOAM's own cloud function `patchPostProcessing` records them:
//! `postProcessing/lagrangian/<cloud>/<function>/<time>/<patch>.post`, one line a parcel, before the wall model acts.
//!
//! The same function works in every case, whatever its wall model, so cases can be compared by what arrives.

use std::f64::consts::PI;
use std::path::Path;

use super::{folders, time_folders};

/// One parcel as it arrives at a patch.
#[derive(Debug, Clone, PartialEq)]
pub struct Arrival {
    /// Name of the patch.
    pub patch: String,
    /// Time [s].
    pub time: f64,
    /// Position [m].
    pub position: [f64; 3],
    /// Mass of all its particles [kg].
    pub mass: f64,
    /// Diameter [m].
    pub diameter: f64,
    /// Speed [m/s].
    pub speed: f64,
    /// Temperature [K], where the cloud has one.
    pub temperature: Option<f64>,
    /// Carbon conversion [1], where the cloud has carbon.
    pub conversion: Option<f64>,
    /// Whether it was still under way.
    pub active: bool,
}

/// The carbon of fresh coal, from `constant/<cloud>Properties`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carbon {
    /// Share of a fresh parcel's mass [1].
    pub share: f64,
    /// Its place among the solid components.
    pub place: usize,
}

impl Carbon {
    /// Reads `singleMixtureFractionCoeffs`: the solid components in their order and `YSolidTot0`.
    pub fn of(case: &Path, cloud: &str) -> Option<Self> {
        let text = std::fs::read_to_string(case.join(format!("constant/{cloud}Properties"))).ok()?;
        Self::in_dictionary(&text)
    }

    fn in_dictionary(text: &str) -> Option<Self> {
        let plain: String =
            text.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join(" ");
        let mixture = plain.split_once("singleMixtureFractionCoeffs")?.1;
        let solid = mixture.split_once("solid")?.1.split_once('{')?.1.split_once('}')?.0;
        let parts: Vec<(&str, f64)> = solid
            .split(';')
            .filter_map(|entry| {
                let mut words = entry.split_whitespace();
                Some((words.next()?, words.next()?.parse().ok()?))
            })
            .collect();
        let total = mixture.split_once("YSolidTot0")?.1.split(';').next()?.trim().parse::<f64>().ok()?;
        let place = parts.iter().position(|(name, _)| *name == "C")?;
        let share = total * parts[place].1;
        (share > 0.0).then_some(Self { share, place })
    }

    /// Conversion from the mass when fresh and now [kg], the solid share and carbon's share of the solids [1].
    fn conversion(&self, fresh: f64, now: f64, solid: f64, carbon: f64) -> f64 {
        (1.0 - now * solid * carbon / (fresh * self.share)).clamp(0.0, 1.0)
    }
}

/// Every arrival that is recorded for a cloud. A patch that two functions record is taken once, from the first.
pub(super) fn read_all(case: &Path, cloud: &str, carbon: Option<&Carbon>) -> Vec<Arrival> {
    let root = case.join("postProcessing/lagrangian").join(cloud);
    let mut arrivals: Vec<Arrival> = Vec::new();
    for function in folders(&root) {
        let mut own = Vec::new();
        for (_, folder) in time_folders(&root.join(&function)) {
            let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
            let mut paths: Vec<_> = entries.map(|entry| entry.path()).collect();
            paths.sort();
            for path in paths.iter().filter(|path| path.extension().is_some_and(|e| e == "post")) {
                let Some(patch) = path.file_stem().and_then(|stem| stem.to_str()) else { continue };
                if arrivals.iter().any(|arrival| arrival.patch == patch) {
                    continue;
                }
                if let Ok(text) = std::fs::read_to_string(path) {
                    own.extend(read(&text, patch, carbon));
                }
            }
        }
        arrivals.extend(own);
    }
    arrivals.sort_by(|a, b| a.time.total_cmp(&b.time));
    arrivals
}

/// The arrivals in one file.
pub fn read(text: &str, patch: &str, carbon: Option<&Carbon>) -> Vec<Arrival> {
    let mut header = Vec::new();
    let mut arrivals = Vec::new();
    for line in text.lines() {
        if let Some(names) = line.strip_prefix('#') {
            header = groups(names).into_iter().map(base_name).collect();
            continue;
        }
        let values = groups(line);
        if values.len() == header.len() && !values.is_empty() {
            arrivals.extend(to_arrival(&header, &values, patch, carbon));
        }
    }
    arrivals
}

/// Splits a line at blanks; what stands in brackets, with the count before them, is one piece.
fn groups(line: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    let (mut depth, mut start) = (0_usize, None);
    for (index, symbol) in line.char_indices() {
        match symbol {
            '(' | '{' => depth += 1,
            ')' | '}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if symbol.is_whitespace() && depth == 0 {
            pieces.extend(start.take().map(|from| &line[from..index]));
        } else if start.is_none() {
            start = Some(index);
        }
    }
    pieces.extend(start.map(|from| &line[from..]));
    pieces
}

/// `position` for `(position0 position1 position2)`, `YSolid` for `N(YSolid0 YSolid1)`, `d` for `d`.
fn base_name(piece: &str) -> String {
    let Some((_, inside)) = piece.split_once('(') else { return piece.to_owned() };
    let first = inside.trim_end_matches(')').split_whitespace().next().unwrap_or_default();
    first.trim_end_matches(|c: char| c.is_ascii_digit()).to_owned()
}

/// The numbers of a piece: `(1 2 3)`, `2(0.1 0.9)`, `3{0}` (three zeros) or a plain number.
fn numbers(piece: &str) -> Vec<f64> {
    if let Some((count, value)) = piece.split_once('{') {
        let value = value.trim_end_matches('}').parse().unwrap_or(f64::NAN);
        return vec![value; count.parse::<usize>().unwrap_or(1).min(1000)];
    }
    let inside = piece.split_once('(').map_or(piece, |(_, rest)| rest.trim_end_matches(')'));
    inside.split_whitespace().filter_map(|word| word.parse().ok()).collect()
}

fn to_arrival(header: &[String], values: &[&str], patch: &str, carbon: Option<&Carbon>) -> Option<Arrival> {
    let list = |name: &str| header.iter().position(|n| n == name).map(|index| numbers(values[index]));
    let single = |name: &str| list(name).and_then(|list| list.first().copied());
    let diameter = single("d")?;
    let own_mass = PI / 6.0 * diameter.powi(3) * single("rho")?;
    let conversion = carbon.and_then(|carbon| {
        let solid = *list("Y")?.get(2)?;
        let share = *list("YSolid")?.get(carbon.place)?;
        Some(carbon.conversion(single("mass0")?, own_mass, solid, share))
    });
    Some(Arrival {
        patch: patch.to_owned(),
        time: single("Time")?,
        position: list("position")?.try_into().ok()?,
        mass: own_mass * single("nParticle").unwrap_or(1.0),
        diameter,
        speed: list("U").map_or(f64::NAN, |u| u.iter().map(|part| part * part).sum::<f64>().sqrt()),
        temperature: single("T"),
        conversion,
        active: single("active").is_none_or(|active| active != 0.0),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const COAL: &str = "singleMixtureFractionCoeffs { phases ( gas { CO 1; } liquid { H2O 1; } solid // comment\n\
                        { ash 0.16; C 0.84; } ); YGasTot0 0.4; YLiquidTot0 0; YSolidTot0 0.6; }";

    #[test]
    fn carbon_is_found_in_the_dictionary() {
        let carbon = Carbon::in_dictionary(COAL).unwrap();
        assert_eq!(carbon.place, 1);
        assert!((carbon.share - 0.504).abs() < 1e-15);
        assert_eq!(Carbon::in_dictionary("solid { sand 1; }"), None);
    }

    #[test]
    fn a_line_of_the_stock_function_is_read() {
        let text = "# Time currentProc  (position0 position1 position2) active nParticle d rho T mass0 N(Y0 Y1 Y2) \
                    N(YGas0 YGas1) N(YSolid0 YSolid1)\n\
                    0.201 0 (-0.19 0.03 -0.34) 1 10 1e-4 1000 1886.2 1e-9 3(0 0 1) 2{0} 2(0.5 0.5)\n";
        let carbon = Carbon::in_dictionary(COAL);
        let arrivals = read(text, "slagWall", carbon.as_ref());
        let one = &arrivals[0];
        let mass = PI / 6.0 * 1e-9;
        assert_eq!((one.position, one.temperature, one.active), ([-0.19, 0.03, -0.34], Some(1886.2), true));
        assert!((one.mass - 10.0 * mass).abs() < 1e-20);
        assert!((one.conversion.unwrap() - (1.0 - mass * 0.5 / (1e-9 * 0.504))).abs() < 1e-12);
    }
}
