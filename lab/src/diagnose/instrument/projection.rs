//! One camera that sees a part of the tangential speed.
//!
//! A camera whose picture lies at the angle `φ` [rad] to the plane of impact sees `v_t cos φ`, before and after: `v_t`
//! is too small by that factor, `e_t` and `e_n` are right. Friction too small by `cos φ` does the same to a particle
//! that slides.

use super::super::data_split::DataSplit;
use super::super::reading::OtherReading;
use super::values;

/// Largest angle [degrees]: beyond, little is seen.
const LARGEST: f64 = 75.0;

pub(super) fn reading(data: &DataSplit) -> Option<OtherReading> {
    data.range("v_t")?;
    Some(OtherReading {
        id: "artefact:projection".to_owned(),
        question: Box::new(|angle: f64| {
            format!(
                "These numbers fit if v_t were seen by one camera, turned by {angle:.0} degrees from the plane of \
                 impact: does a second one, or a mirror, see the other part?"
            )
        }),
        change: Box::new(|row, _, angle: f64| {
            row.impact.tangential_speed /= angle.to_radians().cos();
            Some(0.0)
        }),
        values: values(0.0, LARGEST, 16),
        freedom: 1.0,
        model: None,
    })
}
