//! Expected captures of a case, wall by wall and particle by particle.

use rayon::prelude::*;

use super::PredictionError;
use crate::simulate::{Case, Fate, PathTree, SimulationError, SurfaceKind, run_once};
use nearwall::model::Model;

/// What each wall captures of each particle. Particles in the same order can be compared one by one.
#[derive(Debug, Clone)]
pub struct Captures {
    /// Names of the walls.
    pub walls: Vec<String>,
    /// For each wall, the captured mass of each particle [kg] and its captured share [1].
    of: Vec<Vec<[f64; 2]>>,
    /// Mass of each particle at the start [kg]; 0 for one that cannot be used.
    injected: Vec<f64>,
    /// The first reason why a particle could not be followed to its end.
    pub trouble: Option<String>,
}

impl Captures {
    fn new(case: &Case, particles: usize) -> Self {
        let walls: Vec<String> = walls(case).map(|(_, name)| name.to_owned()).collect();
        let of = vec![vec![[0.0; 2]; particles]; walls.len()];
        Self { walls, of, injected: vec![0.0; particles], trouble: None }
    }

    /// Captured share of the injected mass at a wall [1].
    pub fn mass_share(&self, wall: usize) -> f64 {
        self.of[wall].iter().map(|[mass, _]| mass).sum::<f64>() / self.injected.iter().sum::<f64>()
    }

    /// Captured share of the particles at a wall [1].
    pub fn number_share(&self, wall: usize) -> f64 {
        self.of[wall].iter().map(|[_, number]| number).sum::<f64>() / self.injected.len() as f64
    }

    /// Standard error of the difference in [`Captures::mass_share`] from captures of the same particles [1].
    pub fn error_of_difference(&self, other: &Self, wall: usize) -> f64 {
        let share =
            |of: &Self, particle: usize, mean: f64| of.of[wall][particle][0] - mean * of.injected[particle];
        let means = [self.mass_share(wall), other.mass_share(wall)];
        let change = |particle: usize| share(self, particle, means[0]) - share(other, particle, means[1]);
        let squares: f64 = (0..self.injected.len()).map(|particle| change(particle).powi(2)).sum();
        squares.sqrt() / self.injected.iter().sum::<f64>()
    }
}

/// The walls of a case: index of the surface and name.
pub fn walls(case: &Case) -> impl Iterator<Item = (usize, &str)> {
    let is_wall = |surface: &crate::simulate::Surface| matches!(surface.kind, SurfaceKind::Wall { .. });
    let all = case.surfaces.iter().enumerate().filter(move |(_, surface)| is_wall(surface));
    all.map(|(index, surface)| (index, surface.name.as_str()))
}

/// The particles of a case without deposit at their first contact, which all compared models share.
#[derive(Debug)]
pub struct Flights<'a> {
    case: &'a Case,
    particles: Vec<Result<PathTree<'a>, SimulationError>>,
}

impl<'a> Flights<'a> {
    /// Flies at most `particles` particles, spread evenly over all of the case.
    pub fn new(case: &'a Case, particles: u64) -> Self {
        Self { case, particles: PathTree::sample(case, particles) }
    }

    /// What the walls capture under a model; particles with a model of their own keep it.
    ///
    /// # Errors
    /// [`PredictionError::NoParticle`] where none of the particles can be used.
    pub fn captures(&self, model: &Model) -> Result<Captures, PredictionError> {
        let surfaces: Vec<usize> = walls(self.case).map(|(index, _)| index).collect();
        let mut captures = Captures::new(self.case, self.particles.len());
        let follow = |path: &Result<PathTree<'a>, SimulationError>| {
            let mut caught = vec![[0.0; 2]; surfaces.len()];
            let path = path.as_ref().map_err(ToString::to_string)?;
            let followed = path.follow(path.own_model().unwrap_or(model), |hit| {
                let share = hit.share * hit.outcome.sticking_probability;
                if let Some(wall) = surfaces.iter().position(|surface| *surface == hit.surface) {
                    caught[wall][0] += share * hit.mass;
                    caught[wall][1] += share;
                }
            });
            Ok((path.mass, caught, followed.err().map(|error| error.to_string())))
        };
        let followed: Vec<Result<_, String>> = self.particles.par_iter().map(follow).collect();
        for (particle, followed) in followed.into_iter().enumerate() {
            let trouble = match followed {
                Ok((mass, caught, trouble)) => {
                    captures.injected[particle] = mass;
                    caught.into_iter().zip(&mut captures.of).for_each(|(caught, of)| of[particle] = caught);
                    trouble
                }
                Err(trouble) => Some(trouble),
            };
            captures.trouble = captures.trouble.or(trouble);
        }
        captures.usable()
    }
}

impl Captures {
    fn usable(self) -> Result<Self, PredictionError> {
        if self.injected.iter().any(|mass| *mass > 0.0) {
            return Ok(self);
        }
        let trouble = self.trouble.unwrap_or_else(|| "no particle could be used".to_owned());
        Err(PredictionError::NoParticle(trouble))
    }
}

/// What the walls of a case capture when it is run with random captures, as a deposit requires it.
///
/// # Errors
/// As `nearwall simulate`, and why none of the particles can be used.
pub fn run_captures(case: &Case) -> Result<Captures, PredictionError> {
    let surfaces: Vec<usize> = walls(case).map(|(index, _)| index).collect();
    let mut captures = Captures::new(case, usize::try_from(case.count()).unwrap_or(usize::MAX));
    run_once::<String>(case, None, &mut |_, _, number, trajectory| {
        let particle = usize::try_from(number).unwrap_or(usize::MAX);
        match &trajectory.fate {
            Fate::Unusable(reason) => {
                captures.trouble = captures.trouble.take().or_else(|| Some(reason.to_string()))
            }
            fate => {
                captures.injected[particle] = trajectory.mass[0];
                if let Fate::Stuck(at) = fate
                    && let Some(wall) = surfaces.iter().position(|surface| surface == at)
                {
                    captures.of[wall][particle] = [trajectory.mass[1], 1.0];
                }
            }
        }
        Ok(())
    })
    .map_err(PredictionError::NoParticle)?;
    captures.usable()
}
