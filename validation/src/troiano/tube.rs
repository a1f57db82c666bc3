//! Eq. 13: the tube that brings the particles up to speed.

use std::path::Path;

use nearwall_lab::report::{Chart, Figure, Table, number};
use nearwall_lab::simulate::{self, Case, Hit, SurfaceShape};

use super::published::{FUSION_TIME, RESIDENCE, TUBE, TUBE_LENGTH, TUBE_SPEED, WAX_DENSITY};
use super::{Result, passes};
use crate::oracle::carried::{
    Air, CarriedFlight, Law, OnTheWay, Sphere, relaxation_time, stokes_closed_form, terminal_speed,
};
use crate::steps::even;
use crate::study::table;
use crate::{Claim, ClaimBasis, Extent, Published, StudyPart};

/// The air of `tube.toml` at 20 and 105 °C: the numbers of its tables.
pub(super) const ROOM_AIR: Air =
    Air { temperature: 293.15, density: 1.204, viscosity: 1.813e-5, conductivity: 0.025_715_384_615 };
const WARM: Air = Air {
    temperature: 378.15,
    density: 0.934_333_333_333,
    viscosity: 2.196e-5,
    conductivity: 0.031_730_769_231,
};
/// Speed of its air and of its particles at the end of the inner tube [m/s].
pub(super) const AIR_SPEED: f64 = 1.81;
const FIRST_SPEED: f64 = 0.17;
/// Heat capacity of the wax [J/(kg K)]: assumed, paraffin-like.
const WAX_HEAT_CAPACITY: f64 = 2000.0;

pub(super) fn read(name: &str, text: &str) -> Result<Case> {
    Ok(Case::from_toml(name, text, Path::new(""))?)
}

/// First hits of all particles of a case.
pub(super) fn hits(case: &mut Case) -> Result<Vec<Hit>> {
    let mut first = Vec::new();
    simulate::run_once::<String>(case, None, &mut |_, _, _, life| {
        first.extend(life.hits.first().copied());
        Ok(())
    })?;
    Ok(first)
}

/// The tube's particle of `diameter` [m] as it passes the place `end` [m], by the library.
fn tracked(case: &mut Case, diameter: f64, end: f64) -> Result<Hit> {
    case.set("diameter", diameter)?;
    for surface in &mut case.surfaces {
        if let SurfaceShape::Plane { point, .. } = &mut surface.shape {
            point.z = end;
        }
    }
    Ok(*hits(case)?.first().ok_or("the particle does not arrive")?)
}

pub(super) fn wax(diameter: f64) -> Sphere {
    Sphere { diameter, density: WAX_DENSITY, heat_capacity: WAX_HEAT_CAPACITY }
}

/// The same by Runge and Kutta.
fn integrated(diameter: f64, air: Air, end: f64) -> OnTheWay {
    let flight = CarriedFlight {
        sphere: wax(diameter),
        air,
        law: Law::SchillerNaumann,
        downwards: 1.0,
        air_speed: &|_| AIR_SPEED,
    };
    let start = OnTheWay { time: 0.0, at: TUBE[2], speed: FIRST_SPEED, temperature: 293.15 };
    // The library's wall is touched by the particle's surface.
    flight.arrives(start, 1e-4, end - 0.5 * diameter)
}

/// Way from the inner tube's end [m] on which a particle of `diameter` [m] comes to a speed [m/s], by Runge and Kutta.
fn way_to(diameter: f64, speed: f64) -> f64 {
    let flight = CarriedFlight {
        sphere: wax(diameter),
        air: ROOM_AIR,
        law: Law::SchillerNaumann,
        downwards: 1.0,
        air_speed: &|_| AIR_SPEED,
    };
    let start = OnTheWay { time: 0.0, at: 0.0, speed: FIRST_SPEED, temperature: 293.15 };
    let way = flight.way(start, 1e-4, |place| place.speed < speed);
    way[way.len() - 1].at
}

/// Relative difference.
fn apart(ours: f64, other: f64) -> f64 {
    (ours / other - 1.0).abs()
}

/// Way [m] after which Stokes' drag from rest leaves `lack` of the last speed, over relaxation time and last speed [1].
fn way_until(lack: f64) -> f64 {
    -lack.ln() - (1.0 - lack)
}

/// Time [s] to melt a wax particle in air: first to the melting point, then at it, `Nu = 2`; air
/// [K], latent heat [J/kg].
fn fusion_time(diameter: f64, air: f64, latent: f64) -> f64 {
    let conductivity = Air::at(air).conductivity;
    let melting = 353.15;
    let warming = heating_time(diameter, air) * ((air - 293.15) / (air - melting)).ln();
    warming + WAX_DENSITY * latent * diameter * diameter / (12.0 * conductivity * (air - melting))
}

/// Relaxation time [s] of a wax particle's temperature in air [K], `Nu = 2`.
fn heating_time(diameter: f64, air: f64) -> f64 {
    WAX_DENSITY * WAX_HEAT_CAPACITY * diameter * diameter / (12.0 * Air::at(air).conductivity)
}

/// Diameters [m] that are followed.
const TUBE_SIZES: [f64; 4] = [50e-6, 80e-6, 100e-6, 120e-6];
/// Of these, the one of Fig. 12, and the paper's largest.
const EIGHTY: usize = 1;
const HUNDRED: usize = 2;

/// A particle on its way, by the library and by Runge and Kutta.
struct Track {
    diameter: f64,
    /// Way [m] and speed [m/s], by the library and by the other.
    line: Vec<[f64; 2]>,
    others: Vec<[f64; 2]>,
    /// Speed [m/s] and time [s] at the end.
    speed: f64,
    time: f64,
    /// Largest relative difference between the two [1].
    apart: f64,
}

impl Track {
    fn new(case: &mut Case, diameter: f64, extent: Extent) -> Result<Self> {
        let mut line = vec![[0.0, FIRST_SPEED]];
        let mut largest = 0.0_f64;
        for share in even([0.1, 1.0], extent.count(80).max(12)) {
            // Closer together where the speed changes.
            let end = TUBE[2] + (TUBE[1] - TUBE[2]) * share.powi(3);
            let hit = tracked(case, diameter, end)?;
            let other = integrated(diameter, ROOM_AIR, end);
            line.push([end - TUBE[2], hit.impact.speed()]);
            largest = largest.max(apart(hit.impact.speed(), other.speed)).max(apart(hit.time, other.time));
        }
        let other = |end: f64| [end - TUBE[2], integrated(diameter, ROOM_AIR, end).speed];
        let last = tracked(case, diameter, TUBE[1])?;
        Ok(Self {
            diameter,
            line,
            others: [0.12, 0.2, 0.35, 0.5].map(other).to_vec(),
            speed: last.impact.speed(),
            time: last.time,
            apart: largest,
        })
    }

    /// Air plus terminal velocity [m/s].
    fn last_speed(&self) -> f64 {
        AIR_SPEED + terminal_speed(self.diameter, &ROOM_AIR)
    }

    /// Speed at the end over air plus terminal velocity [1].
    fn share(&self) -> f64 {
        self.speed / self.last_speed()
    }

    fn row(&self) -> Vec<String> {
        let tau = relaxation_time(&wax(self.diameter), &ROOM_AIR);
        let last = self.last_speed();
        vec![
            format!("{:.0}", self.diameter * 1e6),
            format!("{:.1}", 1e3 * tau),
            format!("{:.2}", 10.0 * tau * TUBE_SPEED.value),
            format!("{:.3}", terminal_speed(self.diameter, &ROOM_AIR)),
            format!("{last:.3}"),
            format!("{:.3}", self.speed),
            format!("{:.3}", 100.0 * self.share()),
            format!("{:.2}", way_until(0.01) * tau * last),
            format!("{:.2}", way_to(self.diameter, 0.99 * last)),
            format!("{:.3}", self.time),
        ]
    }
}

/// The part on the tube.
pub(super) fn part(extent: Extent) -> Result<StudyPart> {
    let mut case = read("validation/troiano/tube.toml", include_str!("../../troiano/tube.toml"))?;
    let mut tracks = Vec::new();
    for diameter in TUBE_SIZES {
        tracks.push(Track::new(&mut case, diameter, extent)?);
    }
    let usual = usual_speed(&mut case)?;
    let warm = warmed(&mut case)?;
    let fusion = FusionTimes::new(tracks[EIGHTY].time, tracks[HUNDRED].time);
    Ok(StudyPart {
        heading: "Eq. 13 and Fig 3: the tube".to_owned(),
        text: vec![case_text(), length_text(&tracks), fusion.text()],
        tables: vec![ways(&tracks)],
        figures: vec![chart(&tracks)],
        claims: [
            length_claims(&tracks),
            speed_claims(&tracks),
            fusion.claims(),
            vec![air_temperature(&warm)],
            checks(&tracks, usual, &warm),
        ]
        .concat(),
    })
}

fn case_text() -> String {
    let area = std::f64::consts::FRAC_PI_4 * TUBE[0] * TUBE[0];
    format!(
        "`validation/troiano/tube.toml` is the tube as a case of `nearwall simulate`: particles leave the \
         inner tube, {} m down, at their speed of fall, air of {AIR_SPEED} m/s ({:.1} m³/h at 273 K) \
         carries them to the end at {} m. Every speed and time was also computed by the Runge–Kutta method \
         with independent code for drag and heat, which was itself compared with the closed form of Stokes' \
         drag.",
        TUBE[2],
        3600.0 * area * AIR_SPEED * 273.15 / ROOM_AIR.temperature,
        TUBE[1]
    )
}

fn length_text(tracks: &[Track]) -> String {
    let ten = relaxation_time(&wax(TUBE_SIZES[HUNDRED]), &ROOM_AIR);
    let time = passes(|t| stokes_closed_form(0.0, 2.0, ten, t)[1], 20.0 * ten, [0.0, 40.0 * ten]);
    let reached = stokes_closed_form(0.0, 2.0, ten, time)[0] / 2.0;
    let largest = &tracks[tracks.len() - 1];
    format!(
        "Eq. 13's {length} m is that of 100 µm, the largest particle, at {} m/s in air of 0 °C. Ten \
         relaxation times are indeed generous: {:.4} % of the speed is reached then, and 99 % after {:.2} τ \
         v_i. What reaches {length} m has {:.1} % of it even at {:.0} µm, with {:.2} m to go in place of \
         {length}.",
        TUBE_SPEED.value,
        100.0 * reached,
        way_until(0.01),
        // Rounded down: it has not all of it.
        (1000.0 * largest.share()).floor() / 10.0,
        1e6 * largest.diameter,
        TUBE[1] - TUBE[2],
        length = TUBE_LENGTH.value
    )
}

fn ways(tracks: &[Track]) -> Table {
    table(
        &format!("air {AIR_SPEED} m/s, 20 °C"),
        0,
        "d [µm] | τ [ms] | 10 τ · 2 m/s [m] | terminal [m/s] | air + terminal [m/s] | at 0.65 m [m/s] | of \
         it [%] | way to 99 % from rest, Stokes [m] | way to 99 % [m] | time [s]",
        tracks.iter().map(Track::row).collect(),
    )
}

fn chart(tracks: &[Track]) -> Figure {
    let mut chart = Chart::new("Speed in the tube", "way from the end of the inner tube [m]", "speed [m/s]")
        .x_range(0.0, 0.6)
        .y_range(0.0, 2.5);
    for track in tracks {
        chart = chart.line(&format!("{:.0} µm", track.diameter * 1e6), &track.line);
    }
    let others: Vec<[f64; 2]> = tracks.iter().flat_map(|track| track.others.iter().copied()).collect();
    chart
        .points("Runge–Kutta", &others)
        .figure("troiano-tube", "Lines: nearwall simulate. Marks: Runge and Kutta, drag written anew.")
}

/// Of the length and what it is for.
fn length_claims(tracks: &[Track]) -> Vec<Claim> {
    let needed =
        |air: f64| 10.0 * relaxation_time(&wax(TUBE_SIZES[HUNDRED]), &Air::at(air)) * TUBE_SPEED.value;
    let least = tracks.iter().map(Track::share).fold(1.0, f64::min);
    vec![
        TUBE_LENGTH.beside(needed(273.15), ClaimBasis::Predicted).because(&format!(
            "100 µm, 2 m/s, air of 0 °C, to which the paper refers its flows; {:.2} m with air of 20 °C. \
             \"Typical values\" are not given.",
            needed(293.15)
        )),
        Claim::predicted(
            "Eq 13",
            "least share of the final speed at the end of the tube, 50 to 120 µm [1]",
            Published::Above(0.99),
            least,
        )
        .because("\"Conservatively\"; 0.99 taken for it."),
        Claim::predicted(
            "Sec 3.1",
            "speed at the end, 80 µm, over air plus terminal velocity [1]",
            Published::within(1.0, 0.01),
            tracks[EIGHTY].share(),
        ),
    ]
}

/// Of speed and time at the end.
fn speed_claims(tracks: &[Track]) -> Vec<Claim> {
    let [small, large] = [65e-6, 95e-6].map(|diameter| terminal_speed(diameter, &ROOM_AIR));
    vec![
        TUBE_SPEED
            .beside(tracks[EIGHTY].speed, ClaimBasis::Fitted)
            .because("The air speed is chosen for it."),
        Claim::predicted(
            "Fig 12",
            "spread of the impact speed from 80 ± 15 µm alone [m/s]",
            Published::Below(TUBE_SPEED.tolerance),
            0.5 * (large - small),
        )
        .because("At the tube's end; the stated ± 0.1 m/s holds. At the plate it is more, see below."),
        RESIDENCE.beside(tracks[HUNDRED].time / FUSION_TIME, ClaimBasis::Predicted).because(&format!(
            "100 µm from the inner tube's end; {} m at {} m/s would be {:.2} times. \"About three\" is \
             taken as ± half a unit.",
            TUBE_LENGTH.value,
            TUBE_SPEED.value,
            TUBE_LENGTH.value / TUBE_SPEED.value / FUSION_TIME
        )),
    ]
}

/// What melting takes.
struct FusionTimes {
    /// Time [s] that 80 and 100 µm have in the tube.
    eighty: f64,
    hundred: f64,
    /// Time [s] that 100 µm take in air of 110 and 120 °C, for [`LATENT`].
    at_110: [f64; 2],
    at_120: [f64; 2],
    /// Time [s] that 80 µm take in air of 85 °C.
    slow: f64,
}

/// Heat of fusion [J/kg]: assumed, and its middle.
const LATENT: [f64; 2] = [100e3, 200e3];
const MIDDLE_LATENT: f64 = 150e3;

impl FusionTimes {
    fn new(eighty: f64, hundred: f64) -> Self {
        let of_hundred = |air: f64| LATENT.map(|latent| fusion_time(TUBE_SIZES[HUNDRED], air, latent));
        Self {
            eighty,
            hundred,
            at_110: of_hundred(383.15),
            at_120: of_hundred(393.15),
            slow: fusion_time(TUBE_SIZES[EIGHTY], 358.15, MIDDLE_LATENT),
        }
    }

    fn text(&self) -> String {
        let Self { at_110, at_120, slow, .. } = self;
        format!(
            "The fusion time {FUSION_TIME} s of 100 µm is stated without its air temperature or heat of \
             fusion. With Nu = 2, {WAX_HEAT_CAPACITY} J/(kg K), melting at 80 °C and {:.0} to {:.0} kJ/kg (assumed) it \
             is {:.2} to {:.2} s in air of 110 °C and {:.2} to {:.2} s at 120 °C; warming alone takes {:.2} \
             s. So \"three times\" is {:.1} to {:.1} times at 120 °C. Just above the melting range it is \
             not even one: in air of 85 °C an 80 µm particle needs {slow:.2} s and has {:.1}.",
            LATENT[0] / 1e3,
            LATENT[1] / 1e3,
            at_110[0],
            at_110[1],
            at_120[0],
            at_120[1],
            fusion_time(TUBE_SIZES[HUNDRED], 393.15, 0.0),
            self.hundred / at_120[1],
            self.hundred / at_120[0],
            self.eighty
        )
    }

    fn claims(&self) -> Vec<Claim> {
        let Self { at_110, at_120, slow, eighty, .. } = self;
        let time = |air| fusion_time(TUBE_SIZES[EIGHTY], air, MIDDLE_LATENT);
        let molten = passes(time, *eighty, [354.0, 450.0]) - 273.15;
        vec![
            Claim::unchecked(
                "Sec 3.1",
                "fusion time of 100 µm [s]",
                "about 0.11",
                &format!(
                    "Air temperature and heat of fusion are not given. {:.2} to {:.2} s with 100 to 200 \
                     kJ/kg at 120 °C, {:.2} to {:.2} at 110 °C: the right order of magnitude, at the lower \
                     end.",
                    at_120[0], at_120[1], at_110[0], at_110[1]
                ),
            ),
            Claim::predicted_statement(
                "Fig 12",
                "\"temperature equal to that of the air\", taken as molten where the air is above the \
                 melting range: 80 µm in air of 85 °C",
                "time in the tube suffices",
                &format!("{slow:.2} s to melt, {eighty:.2} s in the tube"),
                slow < eighty,
            )
            .because(&format!(
                "Sensible heat takes five relaxation times, {:.2} s; the heat of fusion ({:.0} kJ/kg \
                 assumed) flows at a difference of 5 K only. From 80 °C (melting assumed there) to \
                 {molten:.0} °C of air, particles arrive partly molten.",
                5.0 * heating_time(TUBE_SIZES[EIGHTY], 358.15),
                MIDDLE_LATENT / 1e3
            )),
        ]
    }
}

/// Temperature at the end.
fn air_temperature(warm: &Hit) -> Claim {
    let costs = |latent| {
        fusion_time(TUBE_SIZES[EIGHTY], WARM.temperature, latent)
            - fusion_time(TUBE_SIZES[EIGHTY], WARM.temperature, 0.0)
    };
    Claim::predicted(
        "Fig 12",
        "particle at the end of the tube, air of 105 °C: temperature deficit [K]",
        Published::Below(1.0),
        WARM.temperature - warm.impact.particle_temperature,
    )
    .because(&format!(
        "80 µm, without the heat of fusion, which costs {:.2} to {:.2} s more of its {:.1} s.",
        costs(LATENT[0]),
        costs(LATENT[1]),
        warm.time
    ))
}

/// Speed [m/s] of 80 µm at the end of the tube with the default tolerance.
fn usual_speed(case: &mut Case) -> Result<f64> {
    let strict = std::mem::replace(&mut case.tolerance, 1e-6);
    let hit = tracked(case, TUBE_SIZES[EIGHTY], TUBE[1]);
    case.tolerance = strict;
    Ok(hit?.impact.speed())
}

/// The particle of 80 µm at the end of the tube with warm air, which the case keeps.
fn warmed(case: &mut Case) -> Result<Hit> {
    case.set("gas_temperature", WARM.temperature)?;
    tracked(case, TUBE_SIZES[EIGHTY], TUBE[1])
}

/// The library against Runge and Kutta: all tracks, the speed [m/s] with the default tolerance, and warm air.
fn checks(tracks: &[Track], usual: f64, warm: &Hit) -> Vec<Claim> {
    let other = integrated(TUBE_SIZES[EIGHTY], ROOM_AIR, TUBE[1]).speed;
    let warmth = integrated(TUBE_SIZES[EIGHTY], WARM, TUBE[1]).temperature;
    vec![
        Claim::derived(
            "check",
            "`simulate` against Runge–Kutta: largest relative difference of speed and time, 4 sizes along \
             the tube",
            Published::Below(1e-6),
            tracks.iter().map(|track| track.apart).fold(0.0, f64::max),
        )
        .because(&format!(
            "Tolerance 1e-11; the difference is the error of the library and decreases with the tolerance. \
             At the default 1e-6 it is {} at the end.",
            number(apart(usual, other))
        )),
        Claim::derived(
            "check",
            "`simulate` against Runge–Kutta: particle temperature at the end, air of 105 °C [K]",
            Published::Below(1e-3),
            (warm.impact.particle_temperature - warmth).abs(),
        ),
    ]
}
