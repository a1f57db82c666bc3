//! Sums over all particles: per wall, per exit, and the balance.

use super::surface::{Role, Surface};
use super::trajectory::{Fate, Hit, Trajectory};
use crate::impact::Regime;

/// Bins of the histograms: restitution 0 to 1.5 in steps of 0.025.
pub const RESTITUTION_BINS: usize = 60;
/// Upper end of the restitution histograms.
pub const RESTITUTION_TOP: f64 = 1.5;
/// Bins of conversion at capture, 0 to 1, as the OpenFOAM library counts them.
pub const CONVERSION_BINS: usize = 10;

/// Number, mean and spread of a quantity (Welford's sums).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Moments {
    /// How many values.
    pub count: u64,
    /// Their mean.
    pub mean: f64,
    squares: f64,
}

impl Moments {
    /// Adds a value.
    pub fn add(&mut self, value: f64) {
        self.count += 1;
        let before = value - self.mean;
        self.mean += before / self.count as f64;
        self.squares += before * (value - self.mean);
    }

    /// Standard deviation of the values.
    pub fn deviation(&self) -> f64 {
        if self.count < 2 { 0.0 } else { (self.squares / (self.count - 1) as f64).sqrt() }
    }

    /// Standard error of the mean.
    pub fn error(&self) -> f64 {
        if self.count < 2 { 0.0 } else { self.deviation() / (self.count as f64).sqrt() }
    }
}

/// A mass that many small ones are added to, without losing them (Neumaier's sum) [kg].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Mass {
    sum: f64,
    lost: f64,
}

impl Mass {
    /// Adds a mass [kg].
    pub fn add(&mut self, mass: f64) {
        let sum = self.sum + mass;
        self.lost +=
            if self.sum.abs() >= mass.abs() { (self.sum - sum) + mass } else { (mass - sum) + self.sum };
        self.sum = sum;
    }

    /// The total [kg].
    pub fn total(self) -> f64 {
        self.sum + self.lost
    }
}

/// Particles and their mass.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Share {
    /// How many.
    pub count: u64,
    mass: Mass,
}

impl Share {
    fn add(&mut self, mass: f64) {
        self.count += 1;
        self.mass.add(mass);
    }

    /// Mass [kg].
    pub fn mass(&self) -> f64 {
        self.mass.total()
    }
}

/// What happened at one wall.
#[derive(Debug, Clone, PartialEq)]
pub struct WallTally {
    /// Index of the surface.
    pub surface: usize,
    /// All hits.
    pub hits: Share,
    /// Hits that ended in capture.
    pub stuck: Share,
    /// Hits of particles that had not hit anything before, and how many of them were captured.
    pub first_hits: [u64; 2],
    /// Hits in each regime, in the order of [`Regime::ALL`].
    pub regime_hits: [u64; 4],
    /// What was captured in each regime.
    pub regime_stuck: [Share; 4],
    /// Captured mass by carbon conversion [kg].
    pub conversion_at_capture: [f64; CONVERSION_BINS],
    /// Normal restitution of rebounds.
    pub e_n: Moments,
    /// Normal restitution of first hits, a capture counted as 0.
    pub first_e_n: Moments,
    /// Tangential restitution of rebounds.
    pub e_t: Moments,
    /// Rebounds by normal restitution.
    pub e_n_histogram: [u64; RESTITUTION_BINS],
    /// Rebounds by tangential restitution.
    pub e_t_histogram: [u64; RESTITUTION_BINS],
    /// Impact speed [m/s].
    pub speed: Moments,
    /// Angle from the surface [degrees].
    pub angle: Moments,
    /// Conversion of what was captured, each particle once.
    pub captured_conversion: Moments,
    /// Hits outside the range that a property or a term is stated for.
    pub outside_range: u64,
}

impl WallTally {
    fn new(surface: usize) -> Self {
        Self {
            surface,
            hits: Share::default(),
            stuck: Share::default(),
            first_hits: [0; 2],
            regime_hits: [0; 4],
            regime_stuck: [Share::default(); 4],
            conversion_at_capture: [0.0; CONVERSION_BINS],
            e_n: Moments::default(),
            first_e_n: Moments::default(),
            e_t: Moments::default(),
            e_n_histogram: [0; RESTITUTION_BINS],
            e_t_histogram: [0; RESTITUTION_BINS],
            speed: Moments::default(),
            angle: Moments::default(),
            captured_conversion: Moments::default(),
            outside_range: 0,
        }
    }

    /// Share of hits that end in capture [1].
    pub fn capture_efficiency(&self) -> f64 {
        ratio(self.stuck.count as f64, self.hits.count as f64)
    }

    /// Share of first hits that end in capture [1]: what a rig that watches single impacts sees.
    pub fn first_capture(&self) -> f64 {
        ratio(self.first_hits[1] as f64, self.first_hits[0] as f64)
    }

    fn add(&mut self, hit: &Hit, first: bool) {
        let outcome = &hit.outcome;
        let regime = outcome.regime as usize;
        self.hits.add(hit.mass);
        self.regime_hits[regime] += 1;
        self.speed.add(hit.impact.speed());
        self.angle.add(hit.impact.angle_from_surface().to_degrees());
        self.outside_range += u64::from(outcome.outside_range);
        if first {
            self.first_hits[0] += 1;
            self.first_hits[1] += u64::from(outcome.stuck);
            self.first_e_n.add(if outcome.stuck { 0.0 } else { outcome.normal_restitution });
        }
        if outcome.stuck {
            self.stuck.add(hit.mass);
            self.regime_stuck[regime].add(hit.mass);
            self.captured_conversion.add(hit.impact.conversion);
            self.conversion_at_capture[bin(hit.impact.conversion, 1.0, CONVERSION_BINS)] += hit.mass;
        } else {
            self.e_n.add(outcome.normal_restitution);
            self.e_t.add(outcome.tangential_restitution);
            self.e_n_histogram[bin(outcome.normal_restitution, RESTITUTION_TOP, RESTITUTION_BINS)] += 1;
            self.e_t_histogram[bin(outcome.tangential_restitution, RESTITUTION_TOP, RESTITUTION_BINS)] += 1;
        }
    }
}

/// One particle that a wall caught.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capture {
    /// Index of the surface.
    pub surface: usize,
    /// Place on the surface, see [`super::Shape::unrolled`] [m].
    pub place: [f64; 2],
    /// Mass of what the particle stands for [kg].
    pub mass: f64,
    /// Diameter [m].
    pub diameter: f64,
    /// Carbon conversion [1].
    pub conversion: f64,
    /// Regime of the last hit.
    pub regime: Regime,
}

/// Everything that is summed up in a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Tally {
    /// All that started.
    pub injected: Share,
    /// Mass that reacted away on the way [kg].
    pub reacted: Mass,
    /// Captured, over all walls.
    pub stuck: Share,
    /// Gone through exits, over all exits.
    pub escaped: Share,
    /// Under way when the time was up.
    pub airborne: Share,
    /// Given up: too many hits, or at rest on a wall that does not hold them.
    pub given_up: Share,
    /// Could not be decided or followed.
    pub unusable: Share,
    /// Why the first unusable particle was.
    pub first_trouble: Option<String>,
    /// One for each wall.
    pub walls: Vec<WallTally>,
    /// Index and sums of each exit.
    pub exits: Vec<(usize, Share)>,
    /// Every capture, in the order of the particles.
    pub captures: Vec<Capture>,
    /// Most hits of one particle.
    pub most_hits: usize,
}

impl Tally {
    pub(super) fn new(surfaces: &[Surface]) -> Self {
        let (mut walls, mut exits) = (Vec::new(), Vec::new());
        for (index, surface) in surfaces.iter().enumerate() {
            match surface.role {
                Role::Wall { .. } => walls.push(WallTally::new(index)),
                Role::Exit => exits.push((index, Share::default())),
            }
        }
        Self {
            injected: Share::default(),
            reacted: Mass::default(),
            stuck: Share::default(),
            escaped: Share::default(),
            airborne: Share::default(),
            given_up: Share::default(),
            unusable: Share::default(),
            first_trouble: None,
            walls,
            exits,
            captures: Vec::new(),
            most_hits: 0,
        }
    }

    pub(super) fn add(&mut self, life: &Trajectory, surfaces: &[Surface]) {
        let [before, after] = life.mass;
        self.injected.add(before);
        self.reacted.add(before - after);
        self.most_hits = self.most_hits.max(life.hits.len());
        for (number, hit) in life.hits.iter().enumerate() {
            if let Some(wall) = self.walls.iter_mut().find(|wall| wall.surface == hit.surface) {
                wall.add(hit, number == 0);
            }
        }
        match &life.fate {
            Fate::Stuck(surface) => {
                self.stuck.add(after);
                if let Some(hit) = life.hits.last() {
                    self.captures.push(Capture {
                        surface: *surface,
                        place: surfaces[*surface].shape.unrolled(&hit.position),
                        mass: after,
                        diameter: life.diameter,
                        conversion: life.conversion,
                        regime: hit.outcome.regime,
                    });
                }
            }
            Fate::Escaped(surface) => {
                self.escaped.add(after);
                if let Some((_, share)) = self.exits.iter_mut().find(|(index, _)| index == surface) {
                    share.add(after);
                }
            }
            Fate::Airborne => self.airborne.add(after),
            Fate::GivenUp => self.given_up.add(after),
            Fate::Unusable(reason) => {
                self.unusable.add(after);
                self.first_trouble.get_or_insert_with(|| reason.clone());
            }
        }
    }

    /// What is left of injected - stuck - escaped - airborne - given up - unusable - reacted, over injected [1].
    pub fn balance_error(&self) -> f64 {
        let ends = [&self.stuck, &self.escaped, &self.airborne, &self.given_up, &self.unusable];
        let accounted = ends.iter().map(|share| share.mass()).sum::<f64>() + self.reacted.total();
        ratio(self.injected.mass() - accounted, self.injected.mass())
    }

    /// Captured mass over injected mass [1].
    pub fn capture_share(&self) -> f64 {
        ratio(self.stuck.mass(), self.injected.mass())
    }

    /// Share of all particles that a later hit than their first captured [1].
    pub fn stuck_later(&self) -> f64 {
        let [_, first] = self.first_hits();
        ratio(self.stuck.count.saturating_sub(first) as f64, self.injected.count as f64)
    }

    /// First hits on any wall, and how many of them were captured.
    pub fn first_hits(&self) -> [u64; 2] {
        self.walls
            .iter()
            .fold([0, 0], |[all, stuck], wall| [all + wall.first_hits[0], stuck + wall.first_hits[1]])
    }
}

/// The bin of a value between 0 and `top`; what lies outside goes to the nearest end.
fn bin(value: f64, top: f64, bins: usize) -> usize {
    ((value / top * bins as f64) as usize).min(bins - 1)
}

/// A ratio that is 0 where there is nothing to divide by.
pub(crate) fn ratio(part: f64, whole: f64) -> f64 {
    if whole == 0.0 { 0.0 } else { part / whole }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_those_of_the_textbook() {
        let mut moments = Moments::default();
        for value in [2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0] {
            moments.add(value);
        }
        assert_eq!((moments.count, moments.mean), (8, 5.0));
        assert!((moments.deviation() - (32.0f64 / 7.0).sqrt()).abs() < 1e-15);
    }

    #[test]
    fn small_masses_are_not_lost() {
        let mut mass = Mass::default();
        for part in [1.0, 1e-17, 1e-17, -1.0] {
            mass.add(part);
        }
        assert_eq!(mass.total(), 2e-17);
    }
}
