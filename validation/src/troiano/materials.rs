//! Tables 1 and 2, and the melts of section 3.1.

use nearwall::material::Library;
use nearwall_lab::report::{Table, number};

use super::published::{
    CAMERA, COAL_SLAG, MELTING, MOLTEN_WAX, SLAG, SOLIDS, StatedMelt, StatedSolid, TARGETS, TUBE_SPEED,
    VISCOSITY_AT, WAX_DENSITY,
};
use crate::steps::range;
use crate::study::table;
use crate::{Claim, Published, Result, StudyPart};

const ROOM: f64 = 293.15;

/// The library's materials, read by name and key.
struct WallMaterial(Library);

impl WallMaterial {
    /// A property at a temperature [K].
    fn value(&self, material: &str, key: &str, temperature: f64) -> Result<f64> {
        let found = self.0.get(material).and_then(|material| material.property(key));
        let found = found.ok_or_else(|| format!("{material} has no {key}"))?;
        found
            .at(temperature)
            .map_err(|range| format!("{material} {key}: {} to {} K", range.low, range.high).into())
    }

    /// Its stated uncertainty.
    fn spread(&self, material: &str, key: &str) -> Option<f64> {
        self.0.get(material).and_then(|material| material.property(key)).and_then(|p| p.uncertainty())
    }
}

/// The part on materials.
pub(super) fn part() -> Result<StudyPart> {
    let shelf = WallMaterial(Library::built_in()?);
    let (rows, same) = table_1(&shelf)?;
    Ok(StudyPart {
        heading: "Tables 1 and 2: the materials".to_owned(),
        text: vec![
            "The library's materials against the printed ones, room temperature, MPa. The table says that \
             the wax resembles coal. It does so in the middle of a range of two decades: what a char \
             particle does at a wall cannot be read off the wax alone."
                .to_owned(),
        ],
        tables: vec![solids(rows)],
        claims: vec![
            as_printed(same),
            slag_modulus(&shelf)?,
            resemblance(),
            surface_energies(&shelf)?,
            wax_melt(&shelf)?,
            slag_melt(&shelf)?,
            pixel(),
            viscosity(&shelf, "130", 0, 0.005)?,
            viscosity(&shelf, "90", 1, 0.05)?,
            kinematic_viscosity(&shelf)?,
        ],
        ..StudyPart::default()
    })
}

fn solids(rows: Vec<Vec<String>>) -> Table {
    table(
        "Table 1 beside the library, MPa",
        2,
        "printed as | material | E, printed | E, library | strength, printed | strength, library",
        rows,
    )
}

/// Table 1 row by row, and how many rows are the library's.
fn table_1(shelf: &WallMaterial) -> Result<(Vec<Vec<String>>, u32)> {
    let (mut rows, mut same) = (Vec::new(), 0);
    for (name, material, modulus, strength) in SOLIDS {
        let read =
            |key| -> Result<_> { Ok((shelf.value(material, key, ROOM)?, shelf.spread(material, key))) };
        let (e, e_spread) = read("youngs_modulus")?;
        let (y, y_spread) = read("yield_strength")?;
        let ours = [[Some(e), e_spread], [Some(y), y_spread]];
        same += u32::from(ours == [modulus, strength].map(|printed| printed.map(Some)));
        let mega = |value: f64| number(value / 1e6);
        rows.push(vec![
            name.to_owned(),
            material.to_owned(),
            format!("{} ± {}", mega(modulus[0]), mega(modulus[1])),
            format!("{} ± {}", mega(e), e_spread.map_or("–".to_owned(), mega)),
            format!("{} ± {}", mega(strength[0]), mega(strength[1])),
            format!("{} ± {}", mega(y), y_spread.map_or("–".to_owned(), mega)),
        ]);
    }
    Ok((rows, same))
}

/// Of the solids; `same` rows of Table 1 are the library's.
fn as_printed(same: u32) -> Claim {
    let all = SOLIDS.len();
    Claim::derived(
        "Table 1",
        &format!("materials whose modulus, strength and their deviations are the printed ones, of {all}"),
        Published::within(all as f64, 0.0),
        f64::from(same),
    )
    .because(
        "Inputs, not results. Coal 801's ± 41.37 MPa is a tenth of what the others have; it is kept as \
         printed.",
    )
}

fn slag_modulus(shelf: &WallMaterial) -> Result<Claim> {
    let mut same = true;
    for [temperature, modulus] in SLAG {
        same &= shelf.value("coal-slag", "youngs_modulus", temperature)? == modulus;
    }
    Ok(Claim::derived_statement(
        "Table 1",
        "modulus of slag at 1000 and 1450 °C",
        "20000–5000 MPa",
        "the same",
        same,
    ))
}

fn resemblance() -> Claim {
    let others = |of: fn(&StatedSolid) -> f64| range(SOLIDS.iter().skip(1).map(of));
    let (modulus, strength) = (others(|solid| solid.2[0]), others(|solid| solid.3[0]));
    let [(_, _, wax_modulus, wax_strength), ..] = SOLIDS;
    let within = |[low, high]: [f64; 2], value: f64| (low..=high).contains(&value);
    let span = |[low, high]: [f64; 2]| format!("{} to {} MPa", number(low / 1e6), number(high / 1e6));
    // To ten.
    let fold = 10.0 * (0.1 * modulus[1] / modulus[0]).round();
    Claim::derived_statement(
        "Table 1",
        "\"the mechanical properties of the wax agree quite well\" with coal and char",
        "700 MPa, 9.5 MPa",
        &format!("inside {} and {}", span(modulus), span(strength)),
        within(modulus, wax_modulus[0]) && within(strength, wax_strength[0]),
    )
    .because(&format!(
        "The range is {fold:.0}-fold in E. By Eq. 3, v_y goes with sigma_y^(5/2)/E² and spreads over far \
         more."
    ))
}

fn surface_energies(shelf: &WallMaterial) -> Result<Claim> {
    let mut same = true;
    for target in &TARGETS {
        let read = |key| shelf.value(target.material, key, ROOM);
        same &= read("surface_energy")? == target.surface_energy
            && read("youngs_modulus")? == target.modulus
            && read("poisson_ratio")? == target.poisson;
    }
    Ok(Claim::derived_statement(
        "Tables 2, 4",
        "surface energy, modulus and Poisson's ratio of the four targets",
        "as printed",
        "the same in the library",
        same,
    ))
}

fn wax_melt(shelf: &WallMaterial) -> Result<Claim> {
    let density = shelf.value("montan-wax", "density", 373.15)?;
    let tension = shelf.value("montan-wax", "surface_tension", 373.15)?;
    let melting = shelf.value("montan-wax", "melting_point", 353.15)? - 273.15;
    let same = density == WAX_DENSITY
        && tension == MOLTEN_WAX.tension[0]
        && (MELTING[0]..=MELTING[1]).contains(&melting);
    Ok(Claim::derived_statement(
        "Sec 3.1",
        "wax: density [kg/m³], surface tension [N/m], melting [°C]",
        "around 1000; 0.03; 75 to 85",
        &format!("{}; {}; {}", number(density), number(tension), number(melting)),
        same,
    )
    .because("Inputs: properties of the library's wax."))
}

fn slag_melt(shelf: &WallMaterial) -> Result<Claim> {
    let density = shelf.value("coal-slag", "density", 1673.15)?;
    let tension = shelf.value("coal-slag", "surface_tension", 1673.15)?;
    let within = |[low, high]: [f64; 2], value: f64| (low..=high).contains(&value);
    Ok(Claim::derived_statement(
        "Sec 3.1",
        "slag: density [kg/m³], surface tension [N/m]",
        "2500 to 3000; 0.4 to 0.7",
        &format!("{}; {}", number(density), number(tension)),
        within(COAL_SLAG.density, density) && within(COAL_SLAG.tension, tension),
    )
    .because("Inputs: properties of the library's coal slag, the middles of the ranges."))
}

/// Of the camera.
fn pixel() -> Claim {
    let (speed, exposure) = (TUBE_SPEED.value, 1e6 * CAMERA.exposure);
    Claim::derived(
        "Sec 3.2",
        "width of a pixel, 0.028 m over 1024 [µm], \"about\"",
        Published::within(27.0, 0.5),
        CAMERA.pixel(),
    )
    .because(&format!(
        "The shutter of {exposure:.0} µs smears {speed} m/s over {:.0} µm: three pixels, one particle.",
        speed * exposure
    ))
}

/// Of the wax at one of the paper's two temperatures [°C].
fn viscosity(shelf: &WallMaterial, celsius: &str, place: usize, tolerance: f64) -> Result<Claim> {
    Ok(Claim::fitted(
        "Sec 3.1",
        &format!("viscosity of the wax at {celsius} °C [Pa s]"),
        Published::within(MOLTEN_WAX.viscosity[place], tolerance),
        shelf.value("montan-wax", "viscosity", VISCOSITY_AT[place])?,
    ))
}

fn kinematic_viscosity(shelf: &WallMaterial) -> Result<Claim> {
    let [thin, thick] = VISCOSITY_AT.map(|temperature| shelf.value("montan-wax", "viscosity", temperature));
    let wax = [thin? / WAX_DENSITY, thick? / WAX_DENSITY];
    let StatedMelt { viscosity, density, .. } = COAL_SLAG;
    let slag = [viscosity[0] / density[1], viscosity[1] / density[0]];
    let span = |[low, high]: [f64; 2]| format!("{} to {}", number(low), number(high));
    Ok(Claim::derived_statement(
        "Sec 3.1",
        "kinematic viscosity of wax \"consistent\" with that of slag [m²/s]",
        "both 1e-5 to 1e-4",
        &format!("wax {}; slag {}", span(wax), span(slag)),
        slag[0] > 0.5e-5 && slag[1] < 1.5e-4,
    )
    .because(&format!(
        "The slag's own numbers ({} Pa s, {} kg/m³) span two decades. They lie {:.0} times \
         below and {:.0} times above those of the wax. The wax covers the middle.",
        span(viscosity),
        span(density),
        wax[0] / slag[0],
        slag[1] / wax[1]
    )))
}
