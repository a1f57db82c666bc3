//! A recorded flight between flat parallel walls, begun again with another rebound.
//!
//! Along the normal, and along the wall, the acceleration decays with the drag: `v(t) = s + a (1 -
//! exp(-r t))/r`. The record gives the speed at both ends, the time and the way between the walls,
//! and so `a` and `r`; with another speed `s'` at the start the acceleration is `a - r (s' - s)`,
//! as the gas and gravity stay. The time until the particle is at the wall follows, and from it the
//! speed there and the way along the wall. Exact for Stokes drag in a gas of one velocity.

use nalgebra::Vector3;

/// Distance of a point from its wall, as a share of the wall's size, up to which the wall is flat [1].
const WALL_FLATNESS: f64 = 1e-3;
/// How far beyond the recorded impacts of a wall a particle may arrive, as a share of the wall's size [1].
const BEYOND_IMPACTS: f64 = 0.02;
/// Most times that a flight may take of what was recorded [1].
const LONGEST: f64 = 100.0;
/// Shares of a change of speed that lie in the mean of a flight, `(mean - end)/(start - end)` [1],
/// which the law above can have, with the largest one that the time steps of the solver explain.
const MEAN: [f64; 2] = [0.02, 0.6];

/// Difference to the share of drag alone, without gravity and gas across, up to which it is taken
/// to be that [1]. Where drag is small the share tells little of it, and drag grows with the speed.
const DRAG_ALONE: f64 = 0.02;

/// A flat wall as its recorded impacts show it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FlatWall {
    /// Orthonormal directions along the wall: one if all impacts lie on a line.
    along: Vec<Vector3<f64>>,
    /// Corners of the box around the impacts [m].
    ends: [Vector3<f64>; 2],
    size: f64,
}

impl FlatWall {
    /// The wall with impacts at these points; `None` if it is not flat, or has fewer than three.
    pub fn of(points: &[Vector3<f64>]) -> Option<Self> {
        let first = *points.first().filter(|_| points.len() > 2)?;
        let mut along: Vec<Vector3<f64>> = Vec::new();
        let mut size = 0.0;
        while along.len() < 3 {
            let rest = points.iter().map(|point| beside(point - first, &along));
            let farthest = rest.max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
            let far = farthest.norm();
            size = f64::max(size, far);
            if far <= WALL_FLATNESS * size {
                break;
            }
            along.push(farthest / far);
        }
        let ends = points.iter().fold([first; 2], |[low, high], point| [low.inf(point), high.sup(point)]);
        (1..3).contains(&along.len()).then_some(Self { along, ends, size })
    }

    /// Whether impacts were recorded around a point.
    pub fn has(&self, point: Vector3<f64>) -> bool {
        let beyond = BEYOND_IMPACTS * self.size;
        (0..3).all(|axis| (self.ends[0][axis] - beyond..=self.ends[1][axis] + beyond).contains(&point[axis]))
    }

    /// The directions along both walls, if they are parallel.
    fn shared<'a>(&'a self, other: &'a Self) -> Option<&'a [Vector3<f64>]> {
        let [few, many] = if self.along.len() < other.along.len() { [self, other] } else { [other, self] };
        let inside = |direction: &Vector3<f64>| beside(*direction, &many.along).norm() < 10.0 * WALL_FLATNESS;
        few.along.iter().all(inside).then_some(&many.along)
    }
}

/// What of a vector is perpendicular to these directions.
fn beside(vector: Vector3<f64>, along: &[Vector3<f64>]) -> Vector3<f64> {
    along.iter().fold(vector, |rest, direction| rest - direction * rest.dot(direction))
}

/// One end of a recorded flight.
#[derive(Debug, Clone, Copy)]
pub(super) struct RecordedContact<'a> {
    pub wall: &'a FlatWall,
    pub position: Vector3<f64>,
    pub age: f64,
    /// Normal and tangential speed [m/s]; at the start those of the rebound.
    pub speeds: [f64; 2],
}

/// A recorded flight.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RecordedFlight {
    time: f64,
    /// From wall to wall [m]; 0 if the particle returns to its wall.
    way: f64,
    /// Along the wall [m].
    drift: Vector3<f64>,
    /// Speeds at the start [m/s], and accelerations there [m/s²].
    speeds: [f64; 2],
    accelerations: [f64; 2],
    /// Rate at which the acceleration decays [1/s].
    rate: f64,
}

/// Where a flight ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Landing {
    /// Normal and tangential speed [m/s].
    pub speeds: [f64; 2],
    /// Distance from the recorded impact [m].
    pub shift: Vector3<f64>,
}

impl RecordedFlight {
    /// The flight between two recorded impacts; `None` unless the walls are parallel and the law above describes it.
    pub fn new(from: &RecordedContact<'_>, to: &RecordedContact<'_>) -> Option<Self> {
        let along = from.wall.shared(to.wall)?;
        let whole = to.position - from.position;
        let off = beside(whole, along);
        let (across, drift) = (off.norm(), whole - off);
        let time = to.age - from.age;
        let returns = across <= WALL_FLATNESS * from.wall.size.max(to.wall.size) && from.wall == to.wall;
        let (way, end) = if returns { (0.0, -to.speeds[0]) } else { (across, to.speeds[0]) };
        let [start, along_start] = from.speeds;
        if !(time > 0.0 && start > 0.0 && (returns || way > 0.0)) {
            return None;
        }
        let mean = (way / time - end) / (start - end);
        let drag = (start / end).ln();
        let rate = if (start - end).abs() <= 1e-6 * start {
            0.0
        } else if drag > 0.0 && (mean - mean_of(drag)).abs() < DRAG_ALONE {
            drag / time
        } else if (MEAN[0]..=MEAN[1]).contains(&mean) {
            decay(mean) / time
        } else {
            return None;
        };
        let built_up = build_up(rate, time);
        let accelerations = [(end - start) / built_up, (to.speeds[1] - along_start) / built_up];
        Some(Self { time, way, drift, speeds: from.speeds, accelerations, rate })
    }

    /// The flight with other speeds of the rebound at its start; `None` if it does not end at the wall.
    pub fn again(&self, speeds: [f64; 2]) -> Option<Landing> {
        let acceleration =
            |which: usize| self.accelerations[which] - self.rate * (speeds[which] - self.speeds[which]);
        let time = self.arrival(speeds[0], acceleration(0))?;
        let speed = |which: usize| (speeds[which] + acceleration(which) * build_up(self.rate, time)).abs();
        let recorded = self.distance(self.speeds[1], self.accelerations[1], self.time);
        let now = self.distance(speeds[1], acceleration(1), time);
        let longer = if recorded.abs() > 1e-3 * self.drift.norm() { now / recorded - 1.0 } else { 0.0 };
        Some(Landing { speeds: [speed(0), speed(1)], shift: self.drift * longer })
    }

    /// The way after this time.
    fn distance(&self, start: f64, acceleration: f64, time: f64) -> f64 {
        let decayed = self.rate * time;
        let late = if decayed > 1e-4 {
            (time - build_up(self.rate, time)) / self.rate
        } else {
            0.5 * time * time * (1.0 - decayed / 3.0)
        };
        start * time + acceleration * late
    }

    /// The time at which the particle is at the wall.
    fn arrival(&self, start: f64, acceleration: f64) -> Option<f64> {
        if start <= 0.0 {
            return None;
        }
        let (mut low, mut high) = self.bracket(start, acceleration)?;
        // Newton's method within the bracket.
        let mut time = 0.5 * (low + high);
        for _ in 0..60 {
            let off = self.beyond(start, acceleration, time);
            if off < 0.0 {
                low = time
            } else {
                high = time
            }
            let slope = start + acceleration * build_up(self.rate, time);
            let next = time - off / if self.way > 0.0 { slope } else { -slope };
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if (next - time).abs() <= 1e-9 * time {
                return Some(next);
            }
            time = next;
        }
        Some(time)
    }

    /// How far it is beyond the wall that it flies to, or behind its own, after this time.
    fn beyond(&self, start: f64, acceleration: f64, time: f64) -> f64 {
        let at = self.distance(start, acceleration, time);
        if self.way > 0.0 { at - self.way } else { -at }
    }

    /// Times before and after the arrival; `None` where it turns before the wall or takes too long.
    fn bracket(&self, start: f64, acceleration: f64) -> Option<(f64, f64)> {
        let there = |time: f64| self.beyond(start, acceleration, time);
        // Where it turns, if it does.
        let built_up = if acceleration < 0.0 { -start / acceleration } else { f64::INFINITY };
        let turns = match built_up * self.rate {
            done if done >= 1.0 || built_up.is_infinite() => f64::INFINITY,
            done if done > 1e-9 => -(-done).ln_1p() / self.rate,
            _ => built_up,
        };
        let (mut low, mut high) = (0.0, turns);
        if self.way > 0.0 {
            if turns.is_infinite() {
                high = 2.0 * self.time;
            } else if there(turns) < 0.0 {
                return None;
            }
        } else {
            low = turns;
            high = 2.0 * turns;
        }
        while there(high) < 0.0 {
            low = high;
            high *= 2.0;
            if high >= LONGEST * self.time || high.is_nan() {
                return None;
            }
        }
        Some((low, high))
    }
}

/// `(1 - exp(-r t))/r`.
fn build_up(rate: f64, time: f64) -> f64 {
    if rate * time > 1e-9 { -(-rate * time).exp_m1() / rate } else { time }
}

/// `1/k - 1/(exp(k) - 1)`: the share [`MEAN`] of a flight over which the acceleration decays by `exp(-k)`.
fn mean_of(k: f64) -> f64 {
    if k > 1e-3 { 1.0 / k - 1.0 / k.exp_m1() } else { 0.5 - k / 12.0 }
}

/// The decay `k` over a flight with this share, at least 0.
fn decay(share: f64) -> f64 {
    let (mut low, mut high) = (1e-3, 60.0);
    if share >= mean_of(low) {
        return 0.0;
    }
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if mean_of(middle) > share { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Follows a particle from x = 0 in a gas of velocity `gas` along z and of gravity `g` (x, z),
    /// with drag of this rate, up to x = `width` or back: position, speeds and time.
    fn followed(
        width: f64,
        gas: f64,
        g: [f64; 2],
        rate: f64,
        start: [f64; 2],
    ) -> Option<(f64, [f64; 2], f64)> {
        let (mut at, mut v, step) = ([0.0, 0.0], start, 1e-6);
        for number in 1..2_000_000 {
            let pull = [g[0] - rate * v[0], g[1] - rate * (v[1] - gas)];
            let next = [v[0] + step * pull[0], v[1] + step * pull[1]];
            at = [at[0] + 0.5 * step * (v[0] + next[0]), at[1] + 0.5 * step * (v[1] + next[1])];
            v = next;
            if at[0] >= width || at[0] <= 0.0 {
                return Some((at[1], [v[0].abs(), v[1]], f64::from(number) * step));
            }
        }
        None
    }

    fn wall(x: f64) -> FlatWall {
        FlatWall::of(&[0.0, 0.1, 0.2].map(|z| Vector3::new(x, 0.0, z))).unwrap()
    }

    #[test]
    fn flights_with_another_rebound_end_as_followed() {
        for (width, g, rate, start, other) in [
            (0.01, [0.0, 9.81], 25.0, [0.6, 1.0], [[0.4, 1.1], [0.8, 0.7]]),
            (0.01, [0.0, 0.0], 0.0, [0.6, 1.0], [[0.1, 1.0], [0.8, 0.7]]),
            (1.0, [-9.81, 0.0], 0.0, [0.6, 1.0], [[0.3, 1.0], [0.8, 0.7]]),
            (1.0, [-9.81, 0.0], 8.0, [0.6, 1.0], [[0.3, 1.2], [0.8, 0.7]]),
        ] {
            let go = |start: [f64; 2]| followed(width, 2.0, g, rate, start).unwrap();
            let (at, speeds, time) = go(start);
            let [low, high] = [wall(0.0), wall(width)];
            let (to, x) = if g[0] < 0.0 { (&low, 0.0) } else { (&high, width) };
            let from = RecordedContact { wall: &low, position: Vector3::zeros(), age: 1.0, speeds: start };
            let to =
                RecordedContact { wall: to, position: Vector3::new(x, 0.0, at), age: 1.0 + time, speeds };
            let flight = RecordedFlight::new(&from, &to).unwrap();
            assert!(flight.again(start).unwrap().shift.iter().all(|x| x.abs() < 1e-6));
            for other in other {
                let (at_other, expected, _) = go(other);
                let landing = flight.again(other).unwrap();
                let off = |a: f64, b: f64| (a - b).abs() / b;
                println!("{landing:?} {expected:?} {}", at_other - at);
                assert!(
                    off(landing.speeds[0], expected[0]) < 0.01 && off(landing.speeds[1], expected[1]) < 0.01
                );
                assert!((landing.shift[2] - (at_other - at)).abs() < 0.01 * at);
            }
        }
    }

    #[test]
    fn a_particle_that_the_gas_stops_does_not_arrive() {
        let (at, speeds, time) = followed(0.01, 2.0, [0.0; 2], 25.0, [0.6, 1.0]).unwrap();
        let [low, high] = [wall(0.0), wall(0.01)];
        let from = RecordedContact { wall: &low, position: Vector3::zeros(), age: 0.0, speeds: [0.6, 1.0] };
        let to = RecordedContact { wall: &high, position: Vector3::new(0.01, 0.0, at), age: time, speeds };
        let flight = RecordedFlight::new(&from, &to).unwrap();
        assert_eq!(flight.again([0.24, 1.0]), None);
        assert!(flight.again([0.26, 1.0]).is_some());
    }

    #[test]
    fn only_flat_parallel_walls_have_flights() {
        let circle: Vec<Vector3<f64>> =
            (0..20).map(|i| Vector3::new(f64::from(i).cos(), f64::from(i).sin(), f64::from(i))).collect();
        assert_eq!(FlatWall::of(&circle), None);
        let side = FlatWall::of(&[0.0, 0.1, 0.05].map(|x| Vector3::new(x, 0.0, 0.0))).unwrap();
        let from = RecordedContact {
            wall: &side,
            position: Vector3::new(0.05, 0.0, 0.0),
            age: 0.0,
            speeds: [1.0, 1.0],
        };
        let floor = wall(0.1);
        let to = RecordedContact {
            wall: &floor,
            position: Vector3::new(0.1, 0.0, 0.05),
            age: 0.05,
            speeds: [1.0, 1.0],
        };
        assert_eq!(RecordedFlight::new(&from, &to), None);
        let square = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[x, y]| Vector3::new(x, y, 0.0));
        let square = FlatWall::of(&square).unwrap();
        assert!(
            square.has(Vector3::new(0.5, 0.5, 0.0))
                && !square.has(Vector3::new(1.2, 0.5, 0.0))
                && square.along.len() == 2
        );
    }
}
