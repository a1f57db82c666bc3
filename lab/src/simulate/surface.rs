//! Walls and exits: planes, discs and pipes, and how far a point is from them.
//!
//! A particle touches a wall when its surface does, that is with its centre at `R = d/2`; it leaves
//! through an exit when its centre does. OpenFOAM's clouds by default let the centre touch the
//! wall; for a target that is flat on the scale of a particle the difference is a shift of the hit
//! by one radius.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::cooling::Cooling;
use super::geometry::{across, direction, required_vector, required_within};
use super::linear_profile::LinearProfile;
use nearwall::input::{InputError, Section, unknown};
use nearwall::model::Model;

/// The form of a wall or an exit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SurfaceShape {
    /// A plane, or a disc of it; particles come from the side that the normal points to.
    Plane {
        /// A point on it, the centre of a disc [m].
        point: Vector3<f64>,
        /// Length 1, into the gas.
        normal: Vector3<f64>,
        /// Radius of a disc [m].
        radius: Option<f64>,
    },
    /// The inside of a circular pipe about the z axis, from one z to another.
    Pipe {
        /// Radius [m].
        radius: f64,
        /// Where this part begins and ends [m].
        zone: [f64; 2],
    },
}

impl SurfaceShape {
    fn read(section: &Section<'_>) -> Result<Self, InputError> {
        match section.choice("shape", &["plane", "pipe"])?.as_deref() {
            Some("plane") => Ok(Self::Plane {
                point: required_vector(section, "point")?,
                normal: direction(section, "normal")?,
                radius: section.number_within("radius", f64::MIN_POSITIVE, f64::INFINITY)?,
            }),
            Some(_) => Ok(Self::Pipe {
                radius: required_within(section, "radius", f64::MIN_POSITIVE, f64::INFINITY)?,
                zone: section
                    .range("zone")?
                    .ok_or_else(|| section.missing("zone", "[from, to] along z [m]"))?,
            }),
            None => Err(section.missing("shape", "\"plane\" or \"pipe\"")),
        }
    }

    /// Distance of a point from the surface [m], negative behind it.
    pub fn distance(&self, position: &Vector3<f64>) -> f64 {
        match self {
            Self::Plane { point, normal, .. } => normal.dot(&(position - point)),
            Self::Pipe { radius, .. } => radius - position.xy().norm(),
        }
    }

    /// The most by which the distance from the surface changes along a vector, in its unit.
    pub fn closing(&self, vector: &Vector3<f64>) -> f64 {
        match self {
            Self::Plane { normal, .. } => normal.dot(vector).abs(),
            Self::Pipe { .. } => vector.xy().norm(),
        }
    }

    /// Direction into the gas at a point near the surface, of length 1.
    pub fn normal(&self, position: &Vector3<f64>) -> Vector3<f64> {
        match self {
            Self::Plane { normal, .. } => *normal,
            Self::Pipe { .. } => {
                let outward = Vector3::new(position.x, position.y, 0.0);
                -outward.try_normalize(0.0).unwrap_or_else(Vector3::x)
            }
        }
    }

    /// Divergence of the normal [1/m] at a point: `-1/r` in a pipe.
    pub fn normal_divergence(&self, position: &Vector3<f64>) -> f64 {
        match self {
            Self::Plane { .. } => 0.0,
            Self::Pipe { radius, .. } => -1.0 / position.xy().norm().max(1e-3 * radius),
        }
    }

    /// Whether the surface extends to a point near it; a disc and a part of a pipe are bounded.
    pub fn covers(&self, position: &Vector3<f64>) -> bool {
        match self {
            Self::Plane { radius: None, .. } => true,
            Self::Plane { radius: Some(radius), .. } => self.coordinate(position) <= *radius,
            Self::Pipe { zone: [from, to], .. } => (*from..*to).contains(&position.z),
        }
    }

    /// Where its bins begin and end [m]: along the axis of a pipe, from the middle of a disc
    /// outwards; `None` without an end.
    pub fn extent(&self) -> Option<[f64; 2]> {
        match *self {
            Self::Plane { radius, .. } => radius.map(|radius| [0.0, radius]),
            Self::Pipe { zone, .. } => zone.iter().all(|end| end.is_finite()).then_some(zone),
        }
    }

    /// The coordinate of [`SurfaceShape::extent`] at a point near the surface [m].
    pub fn coordinate(&self, position: &Vector3<f64>) -> f64 {
        match self {
            Self::Plane { point, normal, .. } => {
                let offset = position - point;
                (offset - normal * normal.dot(&offset)).norm()
            }
            Self::Pipe { .. } => position.z,
        }
    }

    /// A point of the surface [m] with a coordinate of [`SurfaceShape::extent`]; all of them lie on one line.
    pub fn point_at(&self, coordinate: f64) -> Vector3<f64> {
        match self {
            Self::Plane { point, normal, .. } => point + coordinate * across(normal)[0],
            Self::Pipe { radius, .. } => Vector3::new(*radius, 0.0, coordinate),
        }
    }

    /// Area [m²] between two coordinates of [`SurfaceShape::extent`].
    pub fn area_between(&self, [from, to]: [f64; 2]) -> f64 {
        match self {
            Self::Plane { .. } => PI * (to * to - from * from),
            Self::Pipe { radius, .. } => 2.0 * PI * radius * (to - from),
        }
    }

    /// A point of the surface in the surface's own coordinates [m]: along and around a pipe, across a plane.
    pub fn unrolled(&self, position: &Vector3<f64>) -> [f64; 2] {
        match self {
            Self::Plane { point, normal, .. } => {
                let offset = position - point;
                across(normal).map(|axis| axis.dot(&offset))
            }
            Self::Pipe { radius, .. } => [position.z, radius * position.y.atan2(position.x)],
        }
    }

    /// The two axes of [`SurfaceShape::unrolled`], for a figure.
    pub fn axes(&self) -> [&'static str; 2] {
        match self {
            Self::Plane { .. } => ["across the wall, first axis [m]", "across the wall, second axis [m]"],
            Self::Pipe { .. } => ["along the pipe, z [m]", "around the pipe [m]"],
        }
    }
}

/// A wall or an exit.
#[derive(Debug)]
pub struct Surface {
    /// Its name in the case file.
    pub name: String,
    /// Its form.
    pub shape: SurfaceShape,
    /// Wall or exit.
    pub kind: SurfaceKind,
}

/// Whether particles hit a surface or leave through it.
#[derive(Debug)]
pub enum SurfaceKind {
    /// A wall: the model decides.
    Wall {
        /// Index of the model's wall.
        model: usize,
        /// Wall temperature [K]; of a cooled wall that of its coolant.
        temperature: LinearProfile,
        /// What makes the temperature follow from the deposit.
        cooling: Option<Cooling>,
        /// Friction velocity of the gas at it [m/s].
        friction_velocity: f64,
        /// Height of its peaks over the plane of the wall [m]: where particles touch it.
        peak_height: f64,
    },
    /// The particle leaves.
    Exit,
}

impl Surface {
    /// Distance at which a particle of this diameter touches, subtracted: 0 at contact [m]. On a rough wall it touches
    /// the peaks, while the gas and its fluctuations end at the plane of the wall: the way in which roughness that lies
    /// within the viscous layer catches fine particles (Wood, J. Aerosol Sci. 12 (1981) 275; Li and Ahmadi, Aerosol
    /// Sci. Technol. 18 (1993) 11, who shift the wall by a share of the roughness). Peaks above some 5 viscous lengths
    /// change the gas, too, which is left out.
    pub fn gap(&self, position: &Vector3<f64>, diameter: f64) -> f64 {
        let reach = match self.kind {
            SurfaceKind::Exit => 0.0,
            SurfaceKind::Wall { peak_height, .. } => 0.5 * diameter + peak_height,
        };
        self.shape.distance(position) - reach
    }

    /// Reads the `[[walls]]` and `[[exits]]` of a case.
    ///
    /// # Errors
    /// [`InputError::Fault`] for a wall that the model does not have, a name given twice, or no wall at all.
    pub(super) fn read_all(top: &Section<'_>, model: &Model) -> Result<Vec<Self>, InputError> {
        let walls = top.sections("walls")?;
        if walls.is_empty() {
            return Err(top.missing("walls", "at least one [[walls]]"));
        }
        let mut surfaces = walls.iter().map(|s| Self::read_wall(s, model)).collect::<Result<Vec<_>, _>>()?;
        for section in top.sections("exits")? {
            let exit = Self {
                name: section.required_text("name")?,
                shape: SurfaceShape::read(&section)?,
                kind: SurfaceKind::Exit,
            };
            section.finish()?;
            surfaces.push(exit);
        }
        for (index, surface) in surfaces.iter().enumerate() {
            if surfaces.iter().take(index).any(|earlier| earlier.name == surface.name) {
                let problem = format!("the name `{}` is given twice; rename one", surface.name);
                return Err(top.fault("walls", problem));
            }
        }
        Ok(surfaces)
    }

    fn read_wall(section: &Section<'_>, model: &Model) -> Result<Self, InputError> {
        let name = section.required_text("name")?;
        let wanted = section.text("wall")?;
        let found = match &wanted {
            Some(wanted) => model.find_wall(wanted),
            None => model.find_wall(&name).or_else(|| model.find_wall("default")),
        };
        let Some(index) = found else {
            let known: Vec<&str> = model.walls().iter().map(|wall| wall.name()).collect();
            let (key, word) = wanted.as_ref().map_or(("name", &name), |wanted| ("wall", wanted));
            return Err(section.fault(key, unknown(word, "wall of the model", &known)));
        };
        let cooling = section.section("cooling")?.map(|s| Cooling::read(&s, model, index)).transpose()?;
        let given = LinearProfile::read(section, "temperature", 1.0, 1e5)?;
        let temperature = match (given, &cooling) {
            (Some(temperature), None) => temperature,
            (None, Some(cooling)) => LinearProfile::constant(cooling.coolant.temperature),
            (Some(_), Some(_)) => {
                return Err(section.fault("temperature", "follows from `cooling`; remove one of them"));
            }
            (None, None) => return Err(section.missing("temperature", "the wall's temperature [K]")),
        };
        let friction_velocity = section.number_within("friction_velocity", 0.0, 1e3)?.unwrap_or(0.0);
        let peak_height = section.number_within("peak_height", 0.0, 1.0)?.unwrap_or(0.0);
        let shape = SurfaceShape::read(section)?;
        section.finish()?;
        let kind = SurfaceKind::Wall { model: index, temperature, cooling, friction_velocity, peak_height };
        Ok(Self { name, shape, kind })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_and_normals() {
        let normal = Vector3::new(0.0, 0.6, 0.8);
        let plane = SurfaceShape::Plane { point: Vector3::zeros(), normal, radius: Some(1.0) };
        assert!((plane.distance(&(2.0 * normal)) - 2.0).abs() < 1e-15);
        assert!(plane.covers(&(2.0 * normal)) && !plane.covers(&Vector3::new(1.1, 0.0, 0.0)));
        let pipe = SurfaceShape::Pipe { radius: 0.2, zone: [0.0, 1.0] };
        let point = Vector3::new(0.0, 0.15, 0.4);
        assert!((pipe.distance(&point) - 0.05).abs() < 1e-15);
        assert_eq!(pipe.normal(&point), Vector3::new(0.0, -1.0, 0.0));
        assert!(!pipe.covers(&Vector3::new(0.2, 0.0, 1.0)));
        assert!(
            (pipe.area_between([0.0, 1.0]) - 0.4 * PI).abs() < 1e-15 && pipe.extent() == Some([0.0, 1.0])
        );
        assert!(
            (plane.area_between([0.5, 1.0]) - 0.75 * PI).abs() < 1e-15 && plane.extent() == Some([0.0, 1.0])
        );
        assert!((plane.coordinate(&plane.point_at(0.7)) - 0.7).abs() < 1e-15);
        assert!(plane.distance(&plane.point_at(0.7)).abs() < 1e-15);
        let [along, around] = pipe.unrolled(&Vector3::new(0.0, 0.2, 0.4));
        assert!((along - 0.4).abs() < 1e-15 && (around - 0.2 * std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    }
}
