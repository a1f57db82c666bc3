//! Sums over the trajectories of a run: per wall, per exit, and the mass balance.

use super::doubts::Doubts;
use super::summary::over;
use crate::results::{
    Amount, BalanceLine, CONVERSION_BINS, Capture, History, MapQuantity, Mass, NearWall, PipeZones,
    RunResults, WallMap, WallModel, WallTotals, bin,
};
use crate::simulate::{Case, Fate, Hit, StayTime, SurfaceKind, SurfaceShape, Trajectory};

/// Bins of the restitution histograms.
const RESTITUTION_BINS: usize = 60;
/// Width of a bin [1].
pub const RESTITUTION_STEP: f64 = 0.025;
/// Share of the hits at each of the four sides of a map, or one hit, that are left out where they would lengthen the
/// axis by more than this part of what the others need [1].
const FAR_SHARE: f64 = 0.0025;
const FAR_REACH: f64 = 0.15;
/// To either side of a map's middle where all hits are at one place [m].
const LEAST_RANGE: f64 = 1e-9;

impl WallTotals {
    /// A wall without a hit, with every statistic that a standalone case has.
    fn empty() -> Self {
        Self {
            hits: Some(Amount::default()),
            first_hits: Some([0; 2]),
            regime_hits: Some([0; 4]),
            regimes: Some([Amount::default(); 4]),
            conversions: Some([0.0; CONVERSION_BINS]),
            restitutions: [vec![0; RESTITUTION_BINS], vec![0; RESTITUTION_BINS]],
            outside_range: Some(0),
            eroded: Some(0.0),
            contact_heat: Some(0.0),
            ..Self::default()
        }
    }

    /// Adds a hit; `first` is true for the first hit of a particle.
    fn add(&mut self, hit: &Hit, first: bool) {
        let outcome = &hit.outcome;
        let regime = outcome.regime as usize;
        self.hits.get_or_insert_default().add(hit.mass);
        self.regime_hits.get_or_insert_default()[regime] += 1;
        self.speed.add(hit.impact.speed());
        self.angle.add(hit.impact.angle_from_surface().to_degrees());
        *self.outside_range.get_or_insert_default() += u64::from(outcome.outside_range);
        *self.eroded.get_or_insert_default() += hit.eroded;
        *self.contact_heat.get_or_insert_default() += hit.heat;
        if first {
            let [hits, captured] = self.first_hits.get_or_insert_default();
            *hits += 1;
            *captured += u64::from(outcome.stuck);
            self.first_e_n.add(if outcome.stuck { 0.0 } else { outcome.normal_restitution });
        }
        if outcome.stuck {
            self.captured.add(hit.mass);
            self.regimes.get_or_insert_default()[regime].add(hit.mass);
            self.captured_conversion.add(hit.impact.conversion);
            let tenth = bin(hit.impact.conversion, 1.0, CONVERSION_BINS);
            self.conversions.get_or_insert_default()[tenth] += hit.mass;
        } else {
            self.e_n.add(outcome.normal_restitution);
            self.e_t.add(outcome.tangential_restitution);
            let values = [outcome.normal_restitution, outcome.tangential_restitution];
            for (counts, value) in self.restitutions.iter_mut().zip(values) {
                counts[bin(value, RESTITUTION_STEP * RESTITUTION_BINS as f64, RESTITUTION_BINS)] += 1;
            }
        }
    }
}

impl NearWall {
    fn new(distance: f64, shape: &SurfaceShape) -> Self {
        let volumes = match shape {
            SurfaceShape::Pipe { radius, .. } => {
                let inner = (radius - distance).max(0.0);
                Some(1.0 - (inner / radius).powi(2))
            }
            SurfaceShape::Plane { .. } => None,
        };
        Self { distance, volumes, ..Self::default() }
    }

    /// Adds a particle that stands for `weight` real ones of `mass` in all [kg].
    fn add(&mut self, stay: &StayTime, weight: f64, mass: f64) {
        if stay.near > 0.0 {
            self.stays.add(stay.near);
        }
        for (sums, time) in [(&mut self.near, stay.near), (&mut self.section, stay.section)] {
            sums[0].add(weight * time);
            sums[1].add(mass * time);
        }
    }
}

/// How particles ended.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ParticleEnds {
    /// Particles that started.
    pub injected: Amount,
    /// Mass that reacted away during the flights [kg].
    pub reacted: Mass,
    /// Captured, over all walls.
    pub captured: Amount,
    /// Left through exits, over all exits.
    pub escaped: Amount,
    /// In the gas at the time limit.
    pub airborne: Amount,
    /// Given up after too many hits, or at rest on a wall that does not capture them.
    pub given_up: Amount,
    /// Not decided or not followed.
    pub unusable: Amount,
}

impl ParticleEnds {
    fn add(&mut self, trajectory: &Trajectory) {
        let [before, after] = trajectory.mass;
        self.injected.add(before);
        self.reacted.add(before - after);
        let end = match &trajectory.fate {
            Fate::Stuck(_) => &mut self.captured,
            Fate::Escaped(_) => &mut self.escaped,
            Fate::Airborne => &mut self.airborne,
            Fate::GivenUp => &mut self.given_up,
            Fate::Unusable(_) => &mut self.unusable,
        };
        end.add(after);
    }

    /// Injected - stuck - escaped - airborne - given up - unusable - reacted mass, over injected [1].
    pub fn balance_error(&self) -> f64 {
        let ends = [&self.captured, &self.escaped, &self.airborne, &self.given_up, &self.unusable];
        let accounted = ends.iter().map(|amount| amount.mass()).sum::<f64>() + self.reacted.total();
        over(self.injected.mass() - accounted, self.injected.mass())
    }
}

/// Sums over all particles of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunTotals {
    /// How all particles ended.
    pub ends: ParticleEnds,
    /// How those of each injection ended, in the order of the case.
    pub injections: Vec<ParticleEnds>,
    /// Why the first unusable particle could not be used.
    pub first_trouble: Option<String>,
    /// Index of each wall's surface, and its totals.
    pub walls: Vec<(usize, WallTotals)>,
    /// Index of each exit's surface, and what left there.
    pub exits: Vec<(usize, Amount)>,
    /// Every capture, in the order of the particles.
    pub captures: Vec<Capture>,
    /// Every hit that removed something: number of the wall, place [m] and volume [m³].
    pub erosion: Vec<(usize, [f64; 3], f64)>,
    /// Whether the particles start with carbon.
    pub has_carbon: bool,
    /// What the results are not good for.
    pub doubts: Doubts,
}

impl RunTotals {
    pub(super) fn new(case: &Case) -> Self {
        let injections = vec![ParticleEnds::default(); case.injections.len()];
        let (has_carbon, doubts) = (case.has_carbon(), Doubts::new(case));
        let mut totals = Self { injections, has_carbon, doubts, ..Self::default() };
        for (index, surface) in case.surfaces.iter().enumerate() {
            match surface.kind {
                SurfaceKind::Wall { .. } => {
                    let near_wall = Some(NearWall::new(case.near_wall_distance, &surface.shape));
                    totals.walls.push((index, WallTotals { near_wall, ..WallTotals::empty() }));
                }
                SurfaceKind::Exit => totals.exits.push((index, Amount::default())),
            }
        }
        totals
    }

    pub(super) fn add(&mut self, trajectory: &Trajectory) {
        let [_, after] = trajectory.mass;
        self.ends.add(trajectory);
        self.injections[trajectory.injection].add(trajectory);
        for (number, hit) in trajectory.hits.iter().enumerate() {
            let wall = self.walls.iter().position(|(surface, _)| *surface == hit.surface);
            if let Some(wall) = wall {
                self.walls[wall].1.add(hit, number == 0);
                let erodes = (hit.eroded > 0.0).then(|| (wall, hit.position.into(), hit.eroded));
                self.erosion.extend(erodes);
            }
        }
        for (surface, wall) in &mut self.walls {
            if let (Some(near), Some(stay)) = (&mut wall.near_wall, trajectory.stays.get(*surface)) {
                near.add(stay, trajectory.weight, after);
            }
        }
        match &trajectory.fate {
            Fate::Stuck(surface) => {
                if let Some(hit) = trajectory.hits.last() {
                    self.captures.push(Capture {
                        wall: self.walls.iter().position(|(index, _)| index == surface),
                        position: hit.position.into(),
                        mass: after,
                        diameter: trajectory.diameter,
                        regime: Some(hit.outcome.regime),
                    });
                }
            }
            Fate::Escaped(surface) => {
                if let Some((_, amount)) = self.exits.iter_mut().find(|(index, _)| index == surface) {
                    amount.add(after);
                }
            }
            Fate::Unusable(reason) => {
                self.first_trouble.get_or_insert_with(|| reason.to_string());
            }
            Fate::Airborne | Fate::GivenUp => {}
        }
    }

    /// How many particles could not be used, and why the first; `None` if all could.
    pub fn trouble_note(&self) -> Option<String> {
        let (first, count) = (self.first_trouble.as_ref()?, self.ends.unusable.count);
        Some(format!("{count} particles could not be used; the first: {first}"))
    }

    /// First hits on any wall, and how many of them were captured.
    pub fn first_hits(&self) -> [u64; 2] {
        self.walls
            .iter()
            .filter_map(|(_, wall)| wall.first_hits)
            .fold([0, 0], |[all, captured], [hits, stuck]| [all + hits, captured + stuck])
    }

    /// Share of all particles that were captured at a later hit than their first [1].
    pub fn captured_later(&self) -> f64 {
        let [_, first] = self.first_hits();
        over(self.ends.captured.count.saturating_sub(first) as f64, self.ends.injected.count as f64)
    }

    /// The results for the page.
    pub fn results(&self, case: &Case) -> RunResults {
        let surface = |index: usize| &case.surfaces[index];
        let end = case.deposit.map_or(case.time_limit, |deposit| deposit.duration);
        let injected = self.ends.injected.mass();
        let history = |(index, totals): &(usize, WallTotals)| History {
            wall: surface(*index).name.clone(),
            rows: vec![(end, totals.clone())],
        };
        RunResults {
            case: case.title.clone(),
            wall_model: WallModel::Nearwall,
            walls: self.walls.iter().map(history).collect(),
            injected: vec![[end, injected]],
            balance: self.balance(case),
            residual: Some(self.ends.balance_error()),
            captures: self.captures.clone(),
            maps: self.maps(case),
            pipe: self.pipe(case),
            injections: self.by_injection(case),
            has_carbon: self.has_carbon,
            outside_ranges: self.doubts.lines(),
            trouble: self.first_trouble.clone().map(|reason| (self.ends.unusable.count, reason)),
            ..RunResults::default()
        }
    }

    /// The injections of a case with several, for the page.
    fn by_injection(&self, case: &Case) -> Vec<(String, Amount, Amount)> {
        let ends = case.injections.iter().zip(&self.injections);
        let named = ends.map(|(injection, ends)| (injection.name.clone(), ends.injected, ends.captured));
        if self.injections.len() > 1 { named.collect() } else { Vec::new() }
    }

    fn balance(&self, case: &Case) -> Vec<BalanceLine> {
        let line = |what: String, amount: &Amount| BalanceLine {
            what,
            count: Some(amount.count),
            mass: Some(amount.mass()),
        };
        let mut lines =
            vec![line("injected".into(), &self.ends.injected), line("captured".into(), &self.ends.captured)];
        for (surface, amount) in &self.exits {
            lines.push(line(format!("left through {}", case.surfaces[*surface].name), amount));
        }
        lines.push(line("airborne at the time limit".into(), &self.ends.airborne));
        lines.push(line(
            format!("given up (more than {} hits, or at rest)", case.hit_limit),
            &self.ends.given_up,
        ));
        lines.push(line("unusable".into(), &self.ends.unusable));
        let reacted = Some(self.ends.reacted.total());
        lines.push(BalanceLine { what: "reacted".into(), count: None, mass: reacted });
        lines
    }

    fn maps(&self, case: &Case) -> Vec<WallMap> {
        let captured = self.captures.iter().filter_map(|c| Some((c.wall?, c.position, c.mass)));
        let captured = self.maps_of(case, MapQuantity::Captured, captured);
        let eroded = self.maps_of(case, MapQuantity::Eroded, self.erosion.iter().copied());
        captured.into_iter().chain(eroded).collect()
    }

    /// A map for each wall on which anything was left: by index of the wall, place [m] and amount.
    fn maps_of(
        &self,
        case: &Case,
        quantity: MapQuantity,
        left: impl Iterator<Item = (usize, [f64; 3], f64)>,
    ) -> Vec<WallMap> {
        let mut places = vec![Vec::new(); self.walls.len()];
        let shape = |wall: usize| &case.surfaces[self.walls[wall].0].shape;
        left.for_each(|(wall, place, amount)| {
            places[wall].push((shape(wall).unrolled(&place.into()), amount));
        });
        let surfaces = self.walls.iter().map(|(index, _)| &case.surfaces[*index]);
        let with_any = surfaces.zip(places).filter(|(_, places)| !places.is_empty());
        let maps = with_any.map(|(surface, places)| {
            let (axes, ranges) = (surface.shape.axes(), map_ranges(&surface.shape, &places));
            WallMap { quantity, wall: surface.name.clone(), axes, ranges, places }
        });
        maps.collect()
    }

    fn pipe(&self, case: &Case) -> Option<PipeZones> {
        let mut pipe = PipeZones { range: [f64::INFINITY, f64::NEG_INFINITY], ..PipeZones::default() };
        for (number, (index, _)) in self.walls.iter().enumerate() {
            if let SurfaceShape::Pipe { zone, .. } = case.surfaces[*index].shape {
                pipe.walls.push(number);
                pipe.range = [pipe.range[0].min(zone[0]), pipe.range[1].max(zone[1])];
                pipe.marks.push((zone[0], case.surfaces[*index].name.clone()));
            }
        }
        let from = pipe.range[0];
        pipe.marks.retain(|(begin, _)| *begin > from);
        (!pipe.walls.is_empty()).then_some(pipe)
    }
}

/// The part of a wall that its map shows [m]: all of a pipe, the hit part of a plane without a few hits far away.
fn map_ranges(shape: &SurfaceShape, places: &[([f64; 2], f64)]) -> [[f64; 2]; 2] {
    if let SurfaceShape::Pipe { radius, zone } = shape {
        let half = std::f64::consts::PI * radius;
        return [*zone, [-half, half]];
    }
    [0, 1].map(|axis| near_range(places.iter().map(|(place, _)| place[axis]).collect()))
}

/// The ends of some values without those that are far out.
fn near_range(mut values: Vec<f64>) -> [f64; 2] {
    values.sort_by(f64::total_cmp);
    let ends = |out: usize| Some([*values.get(out)?, *values.get(values.len().checked_sub(out + 1)?)?]);
    let [first, last] = ends(0).unwrap_or_default();
    let out = ((FAR_SHARE * values.len() as f64) as usize).max(1);
    let [low, high] = ends(out).filter(|[low, high]| low < high).unwrap_or([first, last]);
    let reach = FAR_REACH * (high - low);
    let low = if low - first <= reach { first } else { low };
    let high = if last - high <= reach { last } else { high };
    if low < high { [low, high] } else { [low - LEAST_RANGE, low + LEAST_RANGE] }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of 1 m about 7 m away, in steps of a tenth.
    fn square() -> Vec<([f64; 2], f64)> {
        let step = |number: usize| 0.1 * number as f64;
        (0..121).map(|place| ([7.0 + step(place % 11), step(place / 11) - 0.5], 1.0)).collect()
    }

    fn shown(places: &[([f64; 2], f64)]) -> [[f64; 2]; 2] {
        let normal = nalgebra::Vector3::z();
        map_ranges(&SurfaceShape::Plane { point: nalgebra::Vector3::zeros(), normal, radius: None }, places)
    }

    #[test]
    fn a_map_shows_the_hit_part_of_a_plane() {
        let near = |found: [[f64; 2]; 2]| {
            let wanted = [[7.0, 8.0], [-0.5, 0.5]];
            let pairs = found.as_flattened().iter().zip(wanted.as_flattened());
            pairs.map(|(found, wanted)| (found - wanted).abs()).fold(0.0, f64::max)
        };
        assert!(near(shown(&square())) < 1e-12, "{:?}", shown(&square()));
        let mut with_far = square();
        with_far.push(([7.5, 1000.0], 1.0));
        assert!(near(shown(&with_far)) < 1e-12, "{:?}", shown(&with_far));
        let quantity = MapQuantity::Captured;
        let (wall, axes, ranges) = (String::new(), [""; 2], shown(&with_far));
        let map = WallMap { quantity, wall, axes, ranges, places: with_far };
        assert_eq!(map.outside(), (1, 1.0 / 122.0));
        // All of a strip, without two that lie far out; one place; none.
        let mut strip: Vec<_> = (0..1000).map(|place| ([f64::from(place), 0.0], 1.0)).collect();
        strip.extend([([1e6, 0.0], 1.0), ([2e6, 0.0], 1.0)]);
        assert_eq!(shown(&strip)[0], [0.0, 999.0]);
        for places in [&strip[..1], &[]] {
            assert!(shown(places).iter().all(|[low, high]| low < high));
        }
    }
}
