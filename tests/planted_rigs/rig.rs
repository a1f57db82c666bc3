//! A rig without drag: straight or parabolic flight between plane walls, computed in closed form, and its case file.

use std::fmt::Write;

use crate::set_rng::SetRng;
use crate::source::{Particle, Source};
use crate::world::{Inputs, World};

/// Where particles start, m above the floor.
pub const START: f64 = 0.01;
/// Where the lid or the upper exit lies, m.
const TOP: f64 = 0.02;
/// Radius at which particles leave a channel, m.
const RIM: f64 = 0.06;
/// Radius of the floor, m: no particle comes down outside.
const RADIUS: f64 = 10.0;
/// Names of the walls.
pub const WALLS: [&str; 2] = ["target", "lid"];

/// What happens after the first impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Rebounds leave at the top.
    Shot,
    /// Rebounds fall back by gravity.
    Bounce,
    /// Rebounds hit a lid, then the floor again, until they leave at the rim.
    Channel,
    /// A gas blows the particles onto the floor; nothing is followed after the first impact.
    Blown,
}

/// The rig.
#[derive(Clone, Copy, Debug)]
pub struct Rig {
    pub shape: Shape,
    /// s.
    pub time_limit: f64,
    /// Whether particles have a weight.
    pub falls: bool,
}

/// An impact of a particle.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    pub wall: usize,
    /// Probability of the rebound.
    pub rebounds: f64,
    pub e_n: f64,
    pub e_t: f64,
}

/// The life of a particle.
#[derive(Clone, Debug)]
pub struct Track {
    /// d³: the mass but for a factor that all share.
    pub mass: f64,
    pub d: f64,
    pub hits: Vec<Hit>,
    /// Probability of capture, by wall.
    pub captured: [f64; 2],
    /// Distance of the last hit from the middle, m.
    pub place: f64,
}

impl Track {
    /// Without hits so far.
    pub fn new(d: f64) -> Self {
        Self { mass: d.powi(3), d, hits: vec![], captured: [0.0; 2], place: 0.0 }
    }
}

/// What a flight reaches first.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Goal {
    Wall(usize),
    Exit,
}

impl Rig {
    fn gravity(&self) -> f64 {
        if self.falls { 9.81 } else { 0.0 }
    }

    /// A rig of a shape whose rebounds fall back if that is one of the shape.
    pub fn new(shape: Shape, time_limit: f64) -> Self {
        Self { shape, time_limit, falls: shape == Shape::Bounce }
    }

    /// Whether each particle hits once, so that its chances need no draws.
    pub fn hits_once(&self) -> bool {
        matches!(self.shape, Shape::Shot | Shape::Blown)
    }

    /// Names of the walls that there are.
    pub fn walls(&self) -> &'static [&'static str] {
        if self.shape == Shape::Channel { &WALLS } else { &WALLS[..1] }
    }

    /// The first impact.
    pub fn first(particle: &Particle) -> Inputs {
        let Particle { speed, angle, inputs, .. } = *particle;
        Inputs { v_n: speed * angle.sin(), v_t: speed * angle.cos(), ..inputs }
    }

    /// Distance of the first impact from the middle, without gravity.
    pub fn first_place(particle: &Particle) -> f64 {
        let [aside, above] = particle.offset;
        let along = (START + above - particle.inputs.d / 2.0) / particle.angle.tan();
        (aside + along * particle.azimuth.cos()).hypot(along * particle.azimuth.sin())
    }

    /// Follows a particle.
    pub fn follow(&self, particle: &Particle, world: &World) -> Track {
        let mut rng = SetRng::new(particle.seed, "flight");
        let mut track = Track::new(particle.inputs.d);
        if self.hits_once() {
            let x = match self.shape {
                Shape::Blown => blown(particle, world.contact.density),
                _ => Self::first(particle),
            };
            let r = world.truth(&x, [rng.unit(), rng.unit()]);
            track.hits.push(Hit { wall: 0, rebounds: 1.0 - r.stick, e_n: r.e_n, e_t: r.e_t });
            track.captured[0] = r.stick;
            track.place = Self::first_place(particle);
            return track;
        }
        let radius = particle.inputs.d / 2.0;
        let (sine, cosine) = particle.azimuth.sin_cos();
        let along = particle.speed * particle.angle.cos();
        let [aside, above] = particle.offset;
        let mut place = [aside, 0.0, START + above];
        let mut speed = [along * cosine, along * sine, -particle.speed * particle.angle.sin()];
        let mut left = self.time_limit;
        while let Some((time, Goal::Wall(wall))) = self.next(place, speed, radius, left) {
            for i in 0..3 {
                place[i] += speed[i] * time;
            }
            place[2] -= self.gravity() * time * time / 2.0;
            speed[2] -= self.gravity() * time;
            left -= time;
            let x = Inputs { v_n: speed[2].abs(), v_t: speed[0].hypot(speed[1]), ..particle.inputs };
            let r = world.truth(&x, [rng.unit(), rng.unit()]);
            let sticks = rng.chance(r.stick);
            track.hits.push(Hit { wall, rebounds: f64::from(u8::from(!sticks)), e_n: r.e_n, e_t: r.e_t });
            if sticks {
                track.captured[wall] = 1.0;
                track.place = place[0].hypot(place[1]);
                break;
            }
            place[2] = if wall == 0 { radius } else { TOP - radius };
            speed = [r.e_t * speed[0], r.e_t * speed[1], -r.e_n * speed[2]];
        }
        track
    }

    /// Time to what is reached first, within the time that is left.
    fn next(&self, place: [f64; 3], speed: [f64; 3], radius: f64, left: f64) -> Option<(f64, Goal)> {
        let [x, y, z] = place;
        let [u, v, w] = speed;
        let (g, height) = (self.gravity(), (z - radius).max(0.0));
        let floor = if g > 0.0 {
            (w + (w * w + 2.0 * g * height).sqrt()) / g
        } else if w < 0.0 {
            height / -w
        } else {
            f64::INFINITY
        };
        let channel = self.shape == Shape::Channel;
        let rise = if channel { TOP - radius - z } else { TOP - z };
        let discriminant = w * w - 2.0 * g * rise;
        let top = if w > 0.0 && discriminant >= 0.0 {
            2.0 * rise / (w + discriminant.sqrt())
        } else {
            f64::INFINITY
        };
        let rim = if channel && u.hypot(v) > 0.0 {
            let (a, b, c) = (u * u + v * v, x * u + y * v, x * x + y * y - RIM * RIM);
            ((b * b - a * c).sqrt() - b) / a
        } else {
            f64::INFINITY
        };
        let lid = if channel { Goal::Wall(1) } else { Goal::Exit };
        [(floor, Goal::Wall(0)), (top, lid), (rim, Goal::Exit)]
            .into_iter()
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .filter(|(time, _)| *time <= left)
    }

    /// The case file of these particles, with the model beside it.
    pub fn case(&self, source: &Source, model: &str, count: usize, seed: u64) -> String {
        let Source { wall_temperature, gas_speed, gas_temperature, .. } = source;
        let (gravity, time_limit) = (0.0 - self.gravity(), self.time_limit);
        let (velocity, properties, limit) = match self.shape {
            Shape::Blown => {
                let [density, viscosity] = AIR;
                (
                    format!("[0, 0, {:e}]", -gas_speed),
                    format!("density = {density}\nviscosity = {viscosity:e}\nconductivity = 0.026"),
                    "hit_limit = 1\n",
                )
            }
            _ => (
                format!("[{gas_speed:e}, 0, 0]"),
                "density = 1e-9\nviscosity = 1e-15\nconductivity = 1e-9".to_owned(),
                "",
            ),
        };
        let mut text = format!(
            "title = \"A rig without drag\"\nmodel = \"{model}\"\n\n[run]\nseed = {seed}\n\
             time_limit = {time_limit}\ngravity = [0, 0, {gravity:?}]\nrecorded_impacts = 1000000\n{limit}\n\
             [gas]\nfield = \"uniform\"\nvelocity = {velocity}\ntemperature = {gas_temperature}\n\
             {properties}\nheat_capacity = 1000\n\n\
             [particles]\ncount = {count}\nposition = {{ shape = \"point\", at = [0, 0, {START}] }}\n\
             direction = [0, 0, -1]\n{}",
            source.toml()
        );
        for (wall, (z, up)) in self.walls().iter().zip([(0.0, 1), (TOP, -1)]) {
            write!(
                text,
                "\n[[walls]]\nname = \"{wall}\"\nwall = \"default\"\nshape = \"plane\"\npoint = [0, 0, {z}]\n\
                 normal = [0, 0, {up}]\nradius = {RADIUS}\ntemperature = {wall_temperature}\n"
            )
            .unwrap();
        }
        let exit = if self.shape == Shape::Channel {
            format!("name = \"rim\"\nshape = \"pipe\"\nradius = {RIM}\nzone = [-1, 1]\n")
        } else {
            format!("name = \"top\"\nshape = \"plane\"\npoint = [0, 0, {TOP}]\nnormal = [0, 0, -1]\n")
        };
        write!(text, "\n[[exits]]\n{exit}").unwrap();
        text
    }
}

/// Density and viscosity of the gas that blows, kg/m³ and Pa s.
const AIR: [f64; 2] = [1.2, 1.8e-5];
/// Steps of a flight through it.
const STEPS: usize = 60;

/// The impact of a particle that a gas blows straight onto the floor: Schiller and Naumann's drag,
/// integrated by Runge and Kutta's method over the time in which it falls without drag, again and again.
fn blown(particle: &Particle, density: f64) -> Inputs {
    let Particle { speed, angle, inputs, .. } = *particle;
    let (d, gas) = (inputs.d, inputs.v_gas);
    let slope = |[_, along, down]: [f64; 3]| {
        let slip = along.hypot(gas - down);
        let reynolds = AIR[0] * slip * d / AIR[1];
        let rate = 18.0 * AIR[1] / (density * d * d) * (1.0 + 0.15 * reynolds.powf(0.687));
        [down, -rate * along, rate * (gas - down)]
    };
    let step = |at: [f64; 3], time: f64| {
        let moved = |by: [f64; 3], share: f64| [0, 1, 2].map(|i| at[i] + share * time * by[i]);
        let a = slope(at);
        let b = slope(moved(a, 0.5));
        let c = slope(moved(b, 0.5));
        let e = slope(moved(c, 1.0));
        [0, 1, 2].map(|i| at[i] + time / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + e[i]))
    };
    let goal = START + particle.offset[1] - d / 2.0;
    let time = goal / gas.max(speed * angle.sin()) / STEPS as f64;
    let mut at = [0.0, speed * angle.cos(), speed * angle.sin()];
    loop {
        let next = step(at, time);
        if next[0] >= goal {
            // Newton's method on the last part of a step.
            let mut last = time * (goal - at[0]) / (next[0] - at[0]);
            for _ in 0..3 {
                let there = step(at, last);
                last += (goal - there[0]) / there[2];
            }
            let [_, v_t, v_n] = step(at, last);
            return Inputs { v_n, v_t, ..inputs };
        }
        at = next;
    }
}

/// What is measured at a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Observable {
    Captured,
    CaptureEfficiency,
    MeanEn,
    MeanEt,
    ShareEnBelow(f64),
    QuantileEn(f64),
    CapturedFrom(f64, f64),
    CapturedSize(f64, f64),
}

impl Observable {
    /// Its name in the file.
    pub fn name(&self) -> String {
        match self {
            Self::Captured => "captured".into(),
            Self::CaptureEfficiency => "capture_efficiency".into(),
            Self::MeanEn => "mean_e_n".into(),
            Self::MeanEt => "mean_e_t".into(),
            Self::ShareEnBelow(bound) => format!("share_e_n_below_{bound}"),
            Self::QuantileEn(share) => format!("quantile_{share}_e_n"),
            Self::CapturedFrom(from, to) => format!("captured_from_{from}_to_{to}"),
            Self::CapturedSize(from, to) => format!("captured_d_{from:e}_to_{to:e}"),
        }
    }

    /// Whether it is a share of counted particles.
    pub fn is_share(&self) -> bool {
        !matches!(self, Self::MeanEn | Self::MeanEt | Self::QuantileEn(_))
    }

    /// Its value at a wall.
    pub fn of(&self, tracks: &[Track], wall: usize) -> f64 {
        let injected = || tracks.iter().map(|track| track.mass).sum::<f64>();
        let caught = |counts: &dyn Fn(&Track) -> bool| {
            let caught = tracks.iter().filter(|track| counts(track));
            caught.map(|track| track.mass * track.captured[wall]).sum::<f64>() / injected()
        };
        let rebounds = || {
            let hits = tracks.iter().flat_map(|track| &track.hits);
            hits.filter(|hit| hit.wall == wall && hit.rebounds > 0.0)
        };
        let mean = |pick: &dyn Fn(&Hit) -> f64| {
            let (sum, count) = rebounds()
                .fold((0.0, 0.0), |(sum, count), hit| (sum + hit.rebounds * pick(hit), count + hit.rebounds));
            sum / count
        };
        match *self {
            Self::Captured => caught(&|_| true),
            Self::CapturedFrom(from, to) => caught(&|track| (from..to).contains(&track.place)),
            Self::CapturedSize(from, to) => caught(&|track| (from..to).contains(&track.d)),
            Self::CaptureEfficiency => {
                let hit = |track: &&Track| track.hits.iter().any(|hit| hit.wall == wall);
                let captured: f64 = tracks.iter().map(|track| track.captured[wall]).sum();
                captured / tracks.iter().filter(hit).count() as f64
            }
            Self::MeanEn => mean(&|hit| hit.e_n),
            Self::MeanEt => mean(&|hit| hit.e_t),
            Self::ShareEnBelow(bound) => mean(&|hit| f64::from(u8::from(hit.e_n < bound))),
            Self::QuantileEn(share) => {
                let mut all: Vec<(f64, f64)> = rebounds().map(|hit| (hit.e_n, hit.rebounds)).collect();
                all.sort_by(|a, b| a.0.total_cmp(&b.0));
                let goal = share * all.iter().map(|one| one.1).sum::<f64>();
                let mut sum = 0.0;
                let reached = |one: &&(f64, f64)| {
                    sum += one.1;
                    sum >= goal
                };
                all.iter().find(reached).map_or(f64::NAN, |one| one.0)
            }
        }
    }
}
