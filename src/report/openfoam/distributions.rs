//! The distributions of `nearWallInteraction` by patch and injector:
//! `postProcessing/nearWallInteraction/<cloud>/<start time>/<patch>.distributions.dat`.
//!
//! One line a class of a quantity, all numbers from the start of the case; empty classes have none. Where a run was
//! started again from an earlier time, the later start counts.

use std::path::Path;

use super::time_folders;

/// What ends the name of such a table, after the patch.
const SUFFIX: &str = ".distributions";

/// The quantities that are classed: column `quantity`, and a unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Speed against the wall [m/s].
    Speed,
    /// Angle from the wall [°]: 0 glances, 90 is head-on.
    Angle,
    /// Diameter [m].
    Diameter,
}

impl Quantity {
    fn named(name: &str) -> Option<Self> {
        match name {
            "speed_m_s" => Some(Self::Speed),
            "angle_deg" => Some(Self::Angle),
            "diameter_m" => Some(Self::Diameter),
            _ => None,
        }
    }
}

/// One class of one quantity, of one injector or of several together.
#[derive(Debug, Clone, PartialEq)]
pub struct Class {
    /// The injector's name, or the number of its parcels.
    pub injector: String,
    /// What is classed.
    pub quantity: Quantity,
    /// Lower end, which belongs to the class.
    pub low: f64,
    /// Upper end; infinite for the last class.
    pub high: f64,
    /// What arrived.
    pub sums: Sums,
}

/// What arrived in a class.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sums {
    /// Parcels.
    pub hits: f64,
    /// Particles.
    pub particles: f64,
    /// Sum over the parcels of the square of their particles.
    pub particles_squared: f64,
    /// Mass [kg].
    pub mass: f64,
    /// Particles that stuck.
    pub stick_particles: f64,
    /// Their mass [kg].
    pub stick_mass: f64,
    /// Kinetic energy that came [J].
    pub energy_in: f64,
    /// Kinetic energy that left again [J].
    pub energy_out: f64,
}

impl Sums {
    /// Adds another class.
    pub fn add(&mut self, other: &Self) {
        self.hits += other.hits;
        self.particles += other.particles;
        self.particles_squared += other.particles_squared;
        self.mass += other.mass;
        self.stick_particles += other.stick_particles;
        self.stick_mass += other.stick_mass;
        self.energy_in += other.energy_in;
        self.energy_out += other.energy_out;
    }

    /// Share of the particles that stuck [1] and its 95 % interval (Wilson's), with as many independent arrivals as parcels
    /// of equal weight would tell as much: (sum of weights)² / sum of squared weights. `None` where nothing arrived.
    pub fn captured(&self) -> Option<[f64; 3]> {
        let count = self.particles * self.particles / self.particles_squared;
        if count.is_nan() || count <= 0.0 {
            return None;
        }
        // The 97.5 % point of the normal distribution.
        let z = 1.959_963_984_540_054_f64;
        let share = self.stick_particles / self.particles;
        let spread = 1.0 + z * z / count;
        let middle = (share + z * z / (2.0 * count)) / spread;
        let half = z / spread * (share * (1.0 - share) / count + z * z / (4.0 * count * count)).sqrt();
        Some([share, (middle - half).min(share), (middle + half).max(share)])
    }
}

/// The distributions at one patch, over time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Distributions {
    /// Name of the patch.
    pub patch: String,
    /// Time [s] and all classes that are not empty, in the order of time.
    pub tables: Vec<(f64, Vec<Class>)>,
}

impl Distributions {
    /// The classes at a time [s]: the last written before it.
    pub fn at(&self, time: f64) -> &[Class] {
        let after = self.tables.partition_point(|(t, _)| *t <= time * (1.0 + 1e-9));
        after.checked_sub(1).map_or(&[], |index| &self.tables[index].1)
    }
}

/// The classes of a quantity in the order of size, injectors together.
pub fn together(classes: &[Class], quantity: Quantity) -> Vec<Class> {
    let mut all: Vec<Class> = classes.iter().filter(|class| class.quantity == quantity).cloned().collect();
    all.sort_by(|a, b| a.low.total_cmp(&b.low));
    let mut merged: Vec<Class> = Vec::new();
    for class in all {
        match merged.last_mut() {
            Some(last) if last.low == class.low => last.sums.add(&class.sums),
            _ => merged.push(Class { injector: String::new(), ..class }),
        }
    }
    merged
}

/// Whether a table of this stem is no table of a patch's totals.
pub(super) fn is_other_table(stem: &str) -> bool {
    stem.ends_with(SUFFIX) || stem.ends_with(".flux")
}

/// All patches of a cloud that have distributions.
pub(super) fn read_all(case: &Path, cloud: &str) -> Vec<Distributions> {
    let mut patches: Vec<Distributions> = Vec::new();
    for (begin, start) in time_folders(&case.join("postProcessing/nearWallInteraction").join(cloud)) {
        let mut paths: Vec<_> =
            std::fs::read_dir(&start).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
        paths.sort();
        for path in paths.iter().filter(|path| path.extension().is_some_and(|e| e == "dat")) {
            let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
            let Some(patch) = stem.strip_suffix(SUFFIX) else { continue };
            let tables = tables(&std::fs::read_to_string(path).unwrap_or_default());
            if tables.is_empty() {
                continue;
            }
            let index = patches.iter().position(|known| known.patch == patch).unwrap_or_else(|| {
                patches.push(Distributions { patch: patch.to_owned(), tables: Vec::new() });
                patches.len() - 1
            });
            let known = &mut patches[index].tables;
            known.retain(|(time, _)| *time <= begin * (1.0 + 1e-9));
            known.extend(tables);
        }
    }
    patches
}

/// The tables in a file: columns by name, a line that was cut off left out.
fn tables(text: &str) -> Vec<(f64, Vec<Class>)> {
    let mut header: Vec<&str> = Vec::new();
    let mut tables: Vec<(f64, Vec<Class>)> = Vec::new();
    for line in text.lines() {
        if let Some(names) = line.strip_prefix('#') {
            header = names.split_whitespace().collect();
            continue;
        }
        let Some((time, class)) = class(&header, line) else { continue };
        match tables.last_mut() {
            Some((last, classes)) if *last == time => classes.push(class),
            _ => tables.push((time, vec![class])),
        }
    }
    tables
}

fn class(header: &[&str], line: &str) -> Option<(f64, Class)> {
    let cells: Vec<&str> = line.split_whitespace().collect();
    if cells.len() != header.len() {
        return None;
    }
    let cell = |name: &str| header.iter().position(|column| *column == name).map(|index| cells[index]);
    let get = |name: &str| cell(name)?.parse::<f64>().ok();
    let sums = Sums {
        hits: get("hits")?,
        particles: get("particles")?,
        particles_squared: get("particles_squared")?,
        mass: get("mass_kg")?,
        stick_particles: get("stick_particles")?,
        stick_mass: get("stick_mass_kg")?,
        energy_in: get("energy_in_J")?,
        energy_out: get("energy_out_J")?,
    };
    let class = Class {
        injector: cell("injector")?.to_owned(),
        quantity: Quantity::named(cell("quantity")?)?,
        low: get("low")?,
        high: get("high")?,
        sums,
    };
    Some((get("time_s")?, class))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "# time_s injector quantity low high hits particles particles_squared mass_kg sticks stick_particles \
                        stick_mass_kg energy_in_J energy_out_J\n\
                        0.1 a speed_m_s 1 2 4 40 400 4e-9 1 10 1e-9 8e-9 1e-9\n\
                        0.1 b speed_m_s 1 2 2 20 200 2e-9 0 0 0 4e-9 2e-9\n\
                        0.1 a speed_m_s 1000 inf 1 10 100 1e-9 0 0 0 1 0.5\n\
                        0.2 a speed_m_s 1 2 5 50 5";

    #[test]
    fn injectors_are_added_and_torn_lines_left_out() {
        let tables = tables(TEXT);
        assert_eq!(tables.len(), 1);
        let patch = Distributions { patch: "floor".into(), tables };
        assert!(patch.at(0.05).is_empty() && patch.at(0.1).len() == 3);
        let speed = together(patch.at(9.0), Quantity::Speed);
        assert_eq!(speed.len(), 2);
        assert_eq!((speed[0].sums.hits, speed[0].sums.stick_particles), (6.0, 10.0));
        assert!((speed[0].sums.mass - 6e-9).abs() < 1e-20 && speed[1].high.is_infinite());
        assert!(together(patch.at(9.0), Quantity::Angle).is_empty());
    }

    /// Wilson's interval for 3 of 10 as statistics books print it: 0.108 to 0.603.
    #[test]
    fn equal_weights_give_the_binomial_interval() {
        let sums = |weight: f64| Sums {
            particles: 10.0 * weight,
            particles_squared: 10.0 * weight * weight,
            stick_particles: 3.0 * weight,
            ..Sums::default()
        };
        for weight in [1.0, 250.0] {
            let [share, low, high] = sums(weight).captured().unwrap();
            assert!(
                (share - 0.3).abs() < 1e-12 && (low - 0.1078).abs() < 5e-5 && (high - 0.6032).abs() < 5e-5
            );
        }
        // One heavy parcel among nine light ones tells hardly more than itself.
        let uneven =
            Sums { particles: 109.0, particles_squared: 10_009.0, stick_particles: 100.0, ..Sums::default() };
        let [_, low, high] = uneven.captured().unwrap();
        assert!(low < 0.25 && high > 0.99, "{low} {high}");
        assert_eq!(Sums::default().captured(), None);
    }
}
