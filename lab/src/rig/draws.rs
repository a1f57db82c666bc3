//! Models drawn from a fit, and the bands that they give.

use std::path::{Path, PathBuf};

use serde::Serialize;

use super::PredictionError;
use super::captures::{Captures, Flights, run_captures};
use crate::results::standalone::Run;
use crate::simulate::Case;
use nearwall::input::InputError;
use nearwall::model::Model;

/// Most particles of a case whose expected captures make a band.
const BAND_PARTICLES: u64 = 1000;
/// The ends of a 95 % band.
const BAND_ENDS: [f64; 2] = [0.025, 0.975];

/// Why a folder's models cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum DrawsError {
    /// The folder cannot be read.
    #[error("{}: {reason}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// The reason, with the remedy.
        reason: String,
    },
    /// A model file cannot be read.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A model is not a draw of the model in use.
    #[error("{}: {reason}", file.display())]
    Other {
        /// The model file.
        file: PathBuf,
        /// The reason, with the remedy.
        reason: String,
    },
}

/// The models of a folder that `nearwall diagnose --draws` wrote.
#[derive(Debug)]
pub struct DrawnModels {
    /// The models, in the order of their file names.
    pub models: Vec<Model>,
    /// The files.
    pub files: Vec<PathBuf>,
}

impl DrawnModels {
    /// Reads the files `*.toml` of a folder, which have to be draws of `model`: with the same walls and inputs.
    ///
    /// # Errors
    /// [`DrawsError`].
    pub fn from_folder(folder: &Path, model: &Model) -> Result<Self, DrawsError> {
        let fault = |reason: String| DrawsError::Folder { folder: folder.to_owned(), reason };
        let entries = std::fs::read_dir(folder).map_err(|error| fault(error.to_string()))?;
        let paths = entries.map(|entry| entry.map(|entry| entry.path()));
        let mut files = paths.collect::<Result<Vec<_>, _>>().map_err(|error| fault(error.to_string()))?;
        files.retain(|file| file.extension().is_some_and(|ending| ending == "toml"));
        files.sort();
        if files.len() < 2 {
            let reason = "has fewer than two model files; `nearwall diagnose --draws 39` writes them";
            return Err(fault(reason.to_owned()));
        }
        let walls =
            |model: &Model| model.walls().iter().map(|wall| wall.name().to_owned()).collect::<Vec<_>>();
        let read = |file: &PathBuf| {
            let drawn = Model::from_file(file)?;
            let reason = if walls(&drawn) != walls(model) {
                "has other walls than the model; give both from the same diagnosis"
            } else if drawn.extra_inputs() != model.extra_inputs() {
                "has other [inputs] than the model; use the extended.toml of the same diagnosis as the model"
            } else {
                return Ok(drawn);
            };
            Err(DrawsError::Other { file: file.clone(), reason: reason.to_owned() })
        };
        Ok(Self { models: files.iter().map(read).collect::<Result<_, DrawsError>>()?, files })
    }
}

/// A band over draws.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Band {
    /// 2.5 % point; with 39 draws or fewer the smallest.
    pub low: f64,
    /// Median.
    pub median: f64,
    /// 97.5 % point; with 39 draws or fewer the largest.
    pub high: f64,
}

impl Band {
    /// The band of these values, one for each draw; NaN without any.
    pub fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        // The i-th of n values lies at i/(n + 1): 39 draws span 95 %.
        let at = |share: f64| {
            let place =
                (share * (values.len() + 1) as f64 - 1.0).clamp(0.0, (values.len().max(1) - 1) as f64);
            let value = |place: f64| values.get(place as usize).copied().unwrap_or(f64::NAN);
            let rest = place.fract();
            value(place.floor()) * (1.0 - rest) + value(place.ceil()) * rest
        };
        Self { low: at(BAND_ENDS[0]), median: at(0.5), high: at(BAND_ENDS[1]) }
    }

    fn times(self, factor: f64) -> Self {
        Self { low: self.low * factor, median: self.median * factor, high: self.high * factor }
    }
}

/// The band of what a wall captures.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CaptureBand {
    /// The wall.
    pub wall: String,
    /// Number of draws.
    pub draws: usize,
    /// Captured mass [kg].
    pub captured_mass: Band,
    /// Captured particles.
    pub captured_particles: Band,
    /// Captured mass over injected mass [1].
    pub mass_share: Band,
}

/// Adds the bands of what the walls capture to the runs of a case. `progress` is called after each draw.
///
/// # Errors
/// [`PredictionError`] where a drawn model cannot decide the case.
pub fn add_capture_bands(
    case: &mut Case,
    runs: &mut [Run],
    draws: &DrawnModels,
    progress: &(dyn Fn() + Sync),
) -> Result<(), PredictionError> {
    let key = case.sweep.as_ref().map(|sweep| sweep.key.clone());
    for run in runs {
        if let Some((key, value)) = key.as_ref().zip(run.value) {
            case.set(key, value)?;
        }
        run.bands = capture_bands(case, run, draws, progress)?;
    }
    Ok(())
}

/// The bands of the walls of a case, which gave `run` with its own model. `progress` is called after each draw.
///
/// Without a deposit they are expected captures of at most a thousand particles, scaled to what was
/// injected; with one the case is run anew with each model and the same random numbers.
///
/// # Errors
/// [`PredictionError`] where a drawn model cannot decide the case.
fn capture_bands(
    case: &mut Case,
    run: &Run,
    draws: &DrawnModels,
    progress: &(dyn Fn() + Sync),
) -> Result<Vec<CaptureBand>, PredictionError> {
    let mut captures: Vec<Captures> = Vec::new();
    if case.deposit.is_some() {
        for model in &draws.models {
            let own = std::mem::replace(&mut case.model, model.clone());
            let captured = run_captures(case);
            case.model = own;
            captures.push(captured?);
            progress();
        }
    } else {
        let flights = Flights::new(case, BAND_PARTICLES);
        for model in &draws.models {
            captures.push(flights.captures(model)?);
            progress();
        }
    }
    let injected = &run.totals.ends.injected;
    let walls = captures.first().map_or(&[][..], |first| &first.walls);
    let band = |(wall, name): (usize, &String)| {
        let mass_share = Band::of(captures.iter().map(|one| one.mass_share(wall)).collect());
        let number = Band::of(captures.iter().map(|one| one.number_share(wall)).collect());
        CaptureBand {
            wall: name.clone(),
            draws: captures.len(),
            captured_mass: mass_share.times(injected.mass()),
            captured_particles: number.times(injected.count as f64),
            mass_share,
        }
    };
    Ok(walls.iter().enumerate().map(band).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_band_of_39_draws_is_their_range() {
        let values = |count: u32| (1..=count).map(f64::from).rev().collect::<Vec<_>>();
        assert_eq!(Band::of(values(39)), Band { low: 1.0, median: 20.0, high: 39.0 });
        assert_eq!(Band::of(values(10)), Band { low: 1.0, median: 5.5, high: 10.0 });
        assert_eq!(Band::of(values(199)), Band { low: 5.0, median: 100.0, high: 195.0 });
        assert!(Band::of(Vec::new()).low.is_nan());
    }
}
