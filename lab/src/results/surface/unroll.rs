//! A wall unrolled into a plane.
//!
//! - A **flat** wall is projected on its plane.
//! - A wall **around an axis** with one cross-section (a pipe, part of a pipe, a duct) is unrolled
//!   along the outline of the section. The axis is the direction in which the normals of the faces
//!   spread least, its place the centre of the circle that fits the corners best. Every face keeps
//!   its area.
//! - A **body of revolution** (a pipe with a cone) becomes the angle at a mean radius over the axis.
//! - Any **other** wall is projected on the two main axes over which it extends most, which the text says.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix2, Matrix3, SymmetricEigen, Vector2, Vector3};

use super::WallFace;
use crate::results::map_cells::area;
use crate::results::range;

/// Largest extent of a flat wall across its plane, over that along it [1].
const FLATNESS: f64 = 0.02;
/// Largest root mean square of the part of the normals along the axis of a pipe, or around that of
/// a body of revolution [1].
const ACROSS: f64 = 0.1;
/// Largest mean change of a face's area by unrolling a pipe [1].
const AREA_CHANGE: f64 = 0.03;
/// Corners of a cross-section that are closer to each other are one [radians].
const SAME_ANGLE: f64 = 1e-4;
/// Largest share of the area that may close the ends of a body of revolution [1].
const CLOSED_ENDS: f64 = 0.1;

/// The faces of a wall in a plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Unrolled {
    /// Corners of each face [m].
    pub outlines: Vec<Vec<[f64; 2]>>,
    /// What the two axes are.
    pub axes: [PlaneAxis; 2],
    /// How the wall was unrolled.
    pub how: Unrolling,
}

/// An axis of the plane, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PlaneAxis {
    /// The coordinate along a direction, a unit vector.
    Along([f64; 3]),
    /// The length around the axis of the wall.
    Around,
}

/// How a wall was unrolled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unrolling {
    /// A flat wall on its plane.
    Flat,
    /// Along the outline of the one cross-section that the wall has around an axis.
    Section(WallAxis),
    /// The angle around an axis.
    Angle {
        /// The axis.
        axis: WallAxis,
        /// Radius at which the angle is drawn as length [m].
        radius: f64,
        /// Least and largest radius of the wall [m].
        radii: [f64; 2],
    },
    /// Projected on the two main axes over which the wall extends most.
    Projected,
}

/// The axis of a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallAxis {
    /// Its direction, a unit vector.
    pub direction: [f64; 3],
    /// A place on it [m].
    pub place: [f64; 3],
    /// The direction from the axis to where the length around it begins, a unit vector.
    pub begin: [f64; 3],
}

/// Unrolls the faces of a wall.
pub fn unroll(faces: &[WallFace]) -> Unrolled {
    let unrolled = flat(faces).or_else(|| around_axis(faces)).or_else(|| revolved(faces));
    lying(unrolled.unwrap_or_else(|| projected(faces)))
}

/// The unit vector of x, y or z.
fn main_axis(which: usize) -> Vector3<f64> {
    Vector3::ith(which, 1.0)
}

/// Which part of a vector is the largest.
fn largest_part(a: &Vector3<f64>) -> usize {
    (0..3).max_by(|i, j| a[*i].abs().total_cmp(&a[*j].abs())).unwrap_or(0)
}

/// The direction of a vector; a vector without length stays.
fn unit(a: Vector3<f64>) -> Vector3<f64> {
    a.try_normalize(0.0).unwrap_or(a)
}

/// A direction as it is given to a reader: along its largest part, and the axis itself where it is nearly one.
fn tidy(direction: Vector3<f64>) -> Vector3<f64> {
    let largest = largest_part(&direction);
    let direction = if direction[largest] < 0.0 { -direction } else { direction };
    if direction[largest] > 0.99995 { main_axis(largest) } else { direction }
}

/// The directions in which some weighted vectors spread, the least first: eigenvectors of the sum of their squares.
fn spread(vectors: impl Iterator<Item = (Vector3<f64>, f64)>) -> [Vector3<f64>; 3] {
    let moment: Matrix3<f64> = vectors.map(|(vector, weight)| weight * vector * vector.transpose()).sum();
    let found = SymmetricEigen::new(moment);
    let mut order = [0, 1, 2];
    order.sort_by(|i, j| found.eigenvalues[*i].total_cmp(&found.eigenvalues[*j]));
    order.map(|place| found.eigenvectors.column(place).into_owned())
}

/// Centre of the circle that fits some points best (Kåsa's least squares); `None` where they lie on a line.
fn circle_centre(points: &[Vector2<f64>]) -> Option<Vector2<f64>> {
    let mean = points.iter().sum::<Vector2<f64>>() / points.len() as f64;
    let (mut moment, mut sum) = (Matrix2::zeros(), Vector2::zeros());
    for point in points {
        let from = point - mean;
        moment += from * from.transpose();
        sum += 0.5 * from.norm_squared() * from;
    }
    let is_round = moment.determinant() > 1e-9 * moment.trace().powi(2);
    Some(mean + moment.try_inverse().filter(|_| is_round)? * sum)
}

/// Extent of the corners along a direction [m].
fn extent(faces: &[WallFace], direction: &Vector3<f64>) -> f64 {
    let [low, high] = range(corners(faces).map(|corner| corner.dot(direction)));
    high - low
}

fn corners(faces: &[WallFace]) -> impl Iterator<Item = &Vector3<f64>> {
    faces.iter().flat_map(|face| &face.corners)
}

/// The wall with its longer axis horizontal.
fn lying(mut unrolled: Unrolled) -> Unrolled {
    let size = |axis: usize| {
        let [low, high] = range(unrolled.outlines.iter().flatten().map(|corner| corner[axis]));
        high - low
    };
    if size(1) > size(0) * (1.0 + 1e-6) {
        unrolled.axes.swap(0, 1);
        unrolled.outlines.iter_mut().flatten().for_each(|corner| corner.swap(0, 1));
    }
    unrolled
}

/// The faces along two directions.
fn along(faces: &[WallFace], directions: [Vector3<f64>; 2], how: Unrolling) -> Unrolled {
    let corner = |corner: &Vector3<f64>| directions.map(|direction| corner.dot(&direction));
    let outlines = faces.iter().map(|face| face.corners.iter().map(corner).collect()).collect();
    Unrolled { outlines, axes: directions.map(|direction| PlaneAxis::Along(direction.into())), how }
}

fn flat(faces: &[WallFace]) -> Option<Unrolled> {
    let sum: Vector3<f64> = faces.iter().map(|face| face.normal).sum();
    let area: f64 = faces.iter().map(|face| face.area).sum();
    if sum.norm() < 0.99 * area || area <= 0.0 {
        return None;
    }
    let normal = unit(sum);
    let directions = directions_in_plane(faces, normal);
    let size = directions.iter().map(|direction| extent(faces, direction)).fold(0.0, f64::max);
    let is_flat = extent(faces, &normal) <= FLATNESS * size;
    is_flat.then(|| along(faces, directions, Unrolling::Flat))
}

/// The main axis after that of a direction (x for z, y for x, z for y) as far as it is across the direction.
fn across(direction: &Vector3<f64>) -> Vector3<f64> {
    let first = main_axis((largest_part(direction) + 1) % 3);
    unit(first - first.dot(direction) * direction)
}

/// Two directions in a plane: those of main axes, unless the wall fits better into a rectangle
/// along the spread of its corners.
fn directions_in_plane(faces: &[WallFace], normal: Vector3<f64>) -> [Vector3<f64>; 2] {
    let first = tidy(across(&normal));
    let straight = [first, tidy(normal.cross(&first))];
    let middle = corners(faces).sum::<Vector3<f64>>() / corners(faces).count().max(1) as f64;
    let [_, second, first] = spread(corners(faces).map(|corner| (corner - middle, 1.0)));
    let turned = [tidy(first), tidy(second)];
    let rectangle = |[a, b]: &[Vector3<f64>; 2]| extent(faces, a) * extent(faces, b);
    if rectangle(&turned) < 0.98 * rectangle(&straight) { turned } else { straight }
}

/// Projects a wall of another form.
fn projected(faces: &[WallFace]) -> Unrolled {
    let mut axes = [0, 1, 2];
    axes.sort_by(|i, j| extent(faces, &main_axis(*j)).total_cmp(&extent(faces, &main_axis(*i))));
    along(faces, [main_axis(axes[0]), main_axis(axes[1])], Unrolling::Projected)
}

/// A direction, the directions across it, and the place of the axis along these.
struct RoundAxis {
    direction: Vector3<f64>,
    across: [Vector3<f64>; 2],
    centre: Vector2<f64>,
}

impl RoundAxis {
    fn of(faces: &[WallFace]) -> Option<Self> {
        let direction = tidy(spread(faces.iter().map(|face| (unit(face.normal), face.area)))[0]);
        let first = across(&direction);
        let across = [first, direction.cross(&first)];
        let points: Vec<Vector2<f64>> =
            corners(faces).map(|corner| across.map(|side| corner.dot(&side)).into()).collect();
        Some(Self { direction, across, centre: circle_centre(&points)? })
    }

    /// Angle [radians], distance from the axis and place along it [m].
    fn polar(&self, place: &Vector3<f64>) -> [f64; 3] {
        let [x, y] = [0, 1].map(|side| place.dot(&self.across[side]) - self.centre[side]);
        [y.atan2(x), x.hypot(y), place.dot(&self.direction)]
    }

    /// The corners of a face as angle, distance and place along the axis; angles are within half a
    /// turn of the face's centre, which is within a turn after `start`.
    fn corners(&self, face: &WallFace, start: f64) -> Vec<[f64; 3]> {
        let middle = start + (self.polar(&face.centre)[0] - start).rem_euclid(TAU);
        let near = |corner: &Vector3<f64>| {
            let [angle, radius, along] = self.polar(corner);
            [middle + (angle - middle + PI).rem_euclid(TAU) - PI, radius, along]
        };
        face.corners.iter().map(near).collect()
    }

    /// Root mean square over the area of the part of the normals in a direction, which a face's centre gives [1].
    fn normals_along(&self, faces: &[WallFace], direction: impl Fn(&WallFace) -> Vector3<f64>) -> f64 {
        let square = |face: &WallFace| face.area * unit(face.normal).dot(&direction(face)).powi(2);
        let area: f64 = faces.iter().map(|face| face.area).sum();
        (faces.iter().map(square).sum::<f64>() / area).sqrt()
    }

    /// The axis, with the direction at an angle [radians].
    fn with_begin(&self, angle: f64) -> WallAxis {
        let of = |x: f64, y: f64| (x * self.across[0] + y * self.across[1]).into();
        let (direction, place) = (self.direction.into(), of(self.centre[0], self.centre[1]));
        WallAxis { direction, place, begin: of(angle.cos(), angle.sin()) }
    }
}

fn around_axis(faces: &[WallFace]) -> Option<Unrolled> {
    let axis = RoundAxis::of(faces)?;
    if axis.normals_along(faces, |_| axis.direction) > ACROSS {
        return None;
    }
    let profile = CrossSection::of(&axis, faces)?;
    let corner = |[angle, _, along]: [f64; 3]| [along, profile.arc(angle)];
    let outline = |face: &WallFace| axis.corners(face, profile.start()).into_iter().map(corner).collect();
    let outlines: Vec<Vec<[f64; 2]>> = faces.iter().map(outline).collect();
    let change = |(face, outline): (&WallFace, &Vec<[f64; 2]>)| (area(outline) - face.area).abs();
    let changes: f64 = faces.iter().zip(&outlines).map(change).sum();
    if changes > AREA_CHANGE * faces.iter().map(|face| face.area).sum::<f64>() {
        return None;
    }
    let how = Unrolling::Section(axis.with_begin(profile.start()));
    Some(Unrolled { outlines, axes: [PlaneAxis::Along(axis.direction.into()), PlaneAxis::Around], how })
}

/// The outline of a cross-section: corners in the order of their angles.
struct CrossSection {
    /// Angles [radians], the first one where the outline is cut.
    angles: Vec<f64>,
    /// Length of the outline up to each corner [m].
    arcs: Vec<f64>,
    /// Length all around [m]; `None` where the outline is open.
    whole: Option<f64>,
}

impl CrossSection {
    /// `None` where one angle has several distances from the axis.
    fn of(axis: &RoundAxis, faces: &[WallFace]) -> Option<Self> {
        let corners = corners(faces).map(|corner| axis.polar(corner));
        let mut corners: Vec<[f64; 2]> = corners.map(|[angle, radius, _]| [angle, radius]).collect();
        corners.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut points: Vec<[f64; 2]> = Vec::new();
        for [angle, radius] in corners {
            match points.last() {
                Some([last, same]) if angle - last < SAME_ANGLE => {
                    ((radius - same).abs() < 0.02 * same).then_some(())?;
                }
                _ => points.push([angle, radius]),
            }
        }
        // The same corner may be at either end of the turn.
        if points.len() > 2 && points[0][0] + TAU - points[points.len() - 1][0] < SAME_ANGLE {
            points.pop();
        }
        (points.len() > 2).then(|| Self::cut(axis, faces, &points))
    }

    /// Cuts the outline where no face is, else opposite of the first direction across the axis.
    fn cut(axis: &RoundAxis, faces: &[WallFace], points: &[[f64; 2]]) -> Self {
        let gap = |place: usize| (points[(place + 1) % points.len()][0] - points[place][0]).rem_euclid(TAU);
        let widest = (0..points.len()).max_by(|a, b| gap(*a).total_cmp(&gap(*b))).unwrap_or(0);
        let hole = points[widest][0] + 0.5 * gap(widest);
        let bridges = |face: &WallFace| {
            let [low, high] = range(axis.corners(face, hole - PI).iter().map(|corner| corner[0]));
            low < hole && hole < high
        };
        let is_closed = faces.iter().any(bridges);
        let from_back = |place: &usize| (PI - points[*place][0].rem_euclid(TAU)).abs();
        let back = (0..points.len()).min_by(|a, b| from_back(a).total_cmp(&from_back(b))).unwrap_or(0);
        let first = if is_closed { back } else { (widest + 1) % points.len() };
        let turned = |place: usize| points[(first + place) % points.len()];
        let chord = |place: usize| {
            let ([a, r], [b, s]) = (turned(place), turned(place + 1));
            (r * r + s * s - 2.0 * r * s * (b - a).cos()).max(0.0).sqrt()
        };
        let start = turned(0)[0];
        let angles =
            (0..points.len()).map(|place| start + (turned(place)[0] - start).rem_euclid(TAU)).collect();
        let mut arcs = vec![0.0];
        for place in 0..points.len() - 1 {
            arcs.push(arcs[place] + chord(place));
        }
        let whole = is_closed.then(|| arcs[points.len() - 1] + chord(points.len() - 1));
        Self { angles, arcs, whole }
    }

    fn start(&self) -> f64 {
        self.angles[0]
    }

    /// Length of the outline from its beginning to an angle [m].
    fn arc(&self, angle: f64) -> f64 {
        let Some(whole) = self.whole else { return self.within(angle) };
        let turns = ((angle - self.start() + 1e-9) / TAU).floor();
        turns * whole + self.within(angle - turns * TAU)
    }

    /// The same within the first turn.
    fn within(&self, angle: f64) -> f64 {
        let after = self.angles.partition_point(|corner| *corner <= angle).max(1);
        let (a, s) = (self.angles[after - 1], self.arcs[after - 1]);
        let end = self.whole.map(|whole| (self.start() + TAU, whole));
        let next = self.angles.get(after).map(|b| (*b, self.arcs[after])).or(end);
        next.map_or(s, |(b, t)| s + (t - s) * ((angle - a) / (b - a)))
    }
}

fn revolved(faces: &[WallFace]) -> Option<Unrolled> {
    let axis = RoundAxis::of(faces)?;
    let around = |face: &WallFace| {
        let [angle, ..] = axis.polar(&face.centre);
        angle.cos() * axis.across[1] - angle.sin() * axis.across[0]
    };
    let is_end = |face: &&WallFace| unit(face.normal).dot(&axis.direction).abs() > 0.95;
    let whole: f64 = faces.iter().map(|face| face.area).sum();
    let ends: f64 = faces.iter().filter(is_end).map(|face| face.area).sum();
    if axis.normals_along(faces, around) > ACROSS || ends > CLOSED_ENDS * whole {
        return None;
    }
    let corner = |[angle, _, along]: [f64; 3]| [along, angle + PI];
    let outline = |face: &WallFace| axis.corners(face, -PI).into_iter().map(corner).collect();
    let mut outlines: Vec<Vec<[f64; 2]>> = faces.iter().map(outline).collect();
    let radius = whole / outlines.iter().map(|outline| area(outline)).sum::<f64>();
    outlines.iter_mut().flatten().for_each(|corner| corner[1] *= radius);
    let [low, high] = range(corners(faces).map(|corner| axis.polar(corner)[1]));
    let how = Unrolling::Angle { axis: axis.with_begin(PI), radius, radii: [low, high] };
    let axes = [PlaneAxis::Along(axis.direction.into()), PlaneAxis::Around];
    radius.is_finite().then_some(Unrolled { outlines, axes, how })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_in_the_order_of_their_spread() {
        // Spreads of 1, 2, 4 along axes that are turned by 30 degrees about z.
        let (sin, cos) = 30f64.to_radians().sin_cos();
        let axes = [[cos, sin, 0.0], [0.0, 0.0, 1.0], [-sin, cos, 0.0]].map(Vector3::from);
        for (found, wanted) in spread(axes.into_iter().zip([1.0, 2.0, 4.0])).into_iter().zip(axes) {
            assert!((found.dot(&wanted).abs() - 1.0).abs() < 1e-12, "{found:?} {wanted:?}");
        }
    }

    #[test]
    fn part_of_a_circle_has_its_centre() {
        let turn = |i: i32| 0.2 * f64::from(i);
        let point = |turn: f64| Vector2::new(3.0 + 2.0 * turn.cos(), -1.0 + 2.0 * turn.sin());
        let points: Vec<Vector2<f64>> = (0..9).map(turn).map(point).collect();
        let centre = circle_centre(&points).unwrap();
        assert!((centre - Vector2::new(3.0, -1.0)).norm() < 1e-12, "{centre:?}");
        assert_eq!(circle_centre(&[0.0, 1.0, 2.0].map(|x| Vector2::new(x, x))), None);
    }
}
