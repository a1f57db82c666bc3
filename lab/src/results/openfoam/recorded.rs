//! Arrivals at patches as OpenFOAM's own cloud function `patchPostProcessing` records them, before
//! the wall model acts: `postProcessing/lagrangian/<cloud>/<function>/<time>/<patch>.post`, one
//! line a parcel. Since v2306 it is `particlePostProcessing`, the file ends with `.dat` and the
//! names of the columns are in quotation marks. The function works with every wall model, so that
//! cases can be compared by what arrives.

use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use super::super::{CONVERSION_BINS, RecordedArrivals, bin};
use super::table::{TableRow, for_each};
use super::{entries, file_name, time_folders};

/// The carbon of fresh coal, from `constant/<cloud>Properties`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carbon {
    /// Share of a fresh parcel's mass [1].
    share: f64,
    /// Its place among the solid components.
    place: usize,
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

    /// Conversion [1] from the mass of a particle at injection and its present carbon [kg]: 1 - m_C/(m_0 Y_C0).
    pub(super) fn conversion_of(&self, fresh: f64, carbon: f64) -> f64 {
        self.conversion(fresh, carbon, 1.0, 1.0)
    }

    /// Conversion [1] from the fresh and the present mass [kg], the share of solids and carbon's share of them [1].
    fn conversion(&self, fresh: f64, now: f64, solid: f64, carbon: f64) -> f64 {
        (1.0 - now * solid * carbon / (fresh * self.share)).clamp(0.0, 1.0)
    }
}

/// One arrival at a patch.
#[derive(Debug, Clone, PartialEq)]
struct Arrival {
    /// Time [s].
    time: f64,
    /// Mass of all particles of the parcel [kg].
    mass: f64,
    /// Speed [m/s].
    speed: f64,
    /// Carbon conversion [1], where the cloud has carbon.
    conversion: Option<f64>,
}

/// The recorded arrivals of a cloud at each patch, summed up to a time [s]. A patch that two
/// functions record is taken from the first.
pub(super) fn read_all(
    case: &Path,
    cloud: &str,
    carbon: Option<&Carbon>,
    until: f64,
) -> Vec<RecordedArrivals> {
    let root = case.join("postProcessing/lagrangian").join(cloud);
    let mut all: Vec<RecordedArrivals> = Vec::new();
    for function in entries(&root, Path::is_dir) {
        let mut own: Vec<RecordedArrivals> = Vec::new();
        let files = |(_, folder): (f64, PathBuf)| entries(&folder, Path::is_file);
        for path in time_folders(&function).into_iter().flat_map(files) {
            let name = file_name(&path);
            let Some(patch) = name.strip_suffix(".post").or(name.strip_suffix(".dat")) else { continue };
            if all.iter().any(|other| other.patch == patch) {
                continue;
            }
            let place = own.iter().position(|sums| sums.patch == patch).unwrap_or_else(|| {
                own.push(RecordedArrivals { patch: patch.to_owned(), ..RecordedArrivals::default() });
                own.len() - 1
            });
            for_each(&path, |row| {
                if let Some(arrival) = to_arrival(row, carbon) {
                    add(&mut own[place], &arrival, until);
                }
            });
        }
        all.extend(own.into_iter().filter(|sums| sums.whole_run.count > 0));
    }
    all
}

fn add(sums: &mut RecordedArrivals, arrival: &Arrival, until: f64) {
    sums.whole_run.add(arrival.mass);
    if arrival.time > until {
        return;
    }
    sums.hits.add(arrival.mass);
    sums.speed.add(arrival.speed);
    match arrival.conversion {
        Some(conversion) => sums.conversions[bin(conversion, 1.0, CONVERSION_BINS)] += arrival.mass,
        None => sums.unknown_conversions += 1,
    }
}

fn to_arrival(row: &TableRow<'_>, carbon: Option<&Carbon>) -> Option<Arrival> {
    let own_mass = PI / 6.0 * row.number("d")?.powi(3) * row.number("rho")?;
    let conversion = carbon.and_then(|carbon| {
        let solid = *row.list("Y")?.get(2)?;
        let share = *row.list("YSolid")?.get(carbon.place)?;
        Some(carbon.conversion(row.number("mass0")?, own_mass, solid, share))
    });
    let speed = |velocity: Vec<f64>| velocity.iter().map(|part| part * part).sum::<f64>().sqrt();
    Some(Arrival {
        time: row.number("Time")?,
        mass: own_mass * row.number("nParticle").unwrap_or(1.0),
        speed: row.list("U").map_or(f64::NAN, speed),
        conversion,
    })
}

#[cfg(test)]
mod tests {
    use super::super::table::read;
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
    fn names_in_quotation_marks_are_read() {
        let text = "# Time                   currentProc \" (position0 position1 position2) d rho nParticle (U0 U1 \
            U2)\"\n\
                    0.11\t0 (0.0785 0.031 0) 0.0001 1000 159 (-1 0 -2)\n";
        let arrivals = read(text, |row| to_arrival(row, None));
        assert!((arrivals[0].mass - 159.0 * PI / 6.0 * 1e-9).abs() < 1e-20);
        assert!((arrivals[0].speed - 5.0_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_line_of_the_stock_function_is_read() {
        let text = "# Time currentProc  (position0 position1 position2) active nParticle d rho T mass0 N(Y0 Y1 Y2) \
                    N(YGas0 YGas1) N(YSolid0 YSolid1)\n\
                    0.201 0 (-0.19 0.03 -0.34) 1 10 1e-4 1000 1886.2 1e-9 3(0 0 1) 2{0} 2(0.5 0.5)\n";
        let carbon = Carbon::in_dictionary(COAL);
        let arrivals = read(text, |row| to_arrival(row, carbon.as_ref()));
        let one = &arrivals[0];
        let mass = PI / 6.0 * 1e-9;
        let rest =
            |row: &TableRow<'_>| Some((row.list("position")?, row.number("T")?, row.number("active")?));
        assert_eq!(read(text, rest), [(vec![-0.19, 0.03, -0.34], 1886.2, 1.0)]);
        assert!((one.mass - 10.0 * mass).abs() < 1e-20);
        assert!((one.conversion.unwrap() - (1.0 - mass * 0.5 / (1e-9 * 0.504))).abs() < 1e-12);
    }
}
