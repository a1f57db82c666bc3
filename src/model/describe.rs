//! The content of a model in words, for `nearwall check`.

use super::Model;
use crate::law::{Origin, Parameter, describe_values};
use crate::normal::NormalLaw;
use crate::tangential::TangentialLaw;

impl Model {
    /// The content of the model as pairs of a heading and its numbers with units, in the order of the steps of an impact.
    pub fn describe(&self) -> Vec<(&'static str, String)> {
        let mut lines = vec![("particle", self.particle.name().to_owned())];
        for wall in &self.walls {
            let mut text = format!("{} of {}", wall.name(), wall.material().name());
            if let Some(slag) = &wall.slag {
                text += &format!(", under {}", slag.name());
            }
            if wall.coverage > 0.0 {
                text += &format!(", coverage {}", wall.coverage);
            }
            if wall.layer_thickness > 0.0 {
                text += &format!(", layer {} m", wall.layer_thickness);
            }
            lines.push(("wall", text));
        }
        lines.push(("normal", self.describe_normal()));
        lines.push((
            "tangential",
            match self.tangential {
                TangentialLaw::Constant { restitution } => format!("constant, e_t = {restitution}"),
                TangentialLaw::Sliding { friction } => format!("sliding, friction {friction}"),
                TangentialLaw::SlidingRolling { friction } => format!("sliding-rolling, friction {friction}"),
                TangentialLaw::Listed { law, values } => {
                    listed(law.name, law.parameters, &values, law.origin)
                }
            },
        ));
        let capture = self.criterion.map_or_else(
            || "below the sticking velocity, and what effects add".to_owned(),
            |criterion| format!("also by {}", criterion.describe()),
        );
        lines.push(("capture", capture));
        for term in &self.terms {
            let parameters = describe_values(term.kind().parameters, term.values());
            lines.push(("effect", format!("{}: {}", term.kind().id, parameters.join(", "))));
        }
        lines
    }

    fn describe_normal(&self) -> String {
        if let NormalLaw::Constant { restitution } = self.normal {
            return format!("constant, e_n = {restitution}");
        }
        if let NormalLaw::Listed { law, values } = self.normal {
            return listed(law.name, law.parameters, &values, law.origin);
        }
        let adhesion = self.walls.first().map(|wall| wall.adhesion);
        let ratio = adhesion.map_or(f64::NAN, |a| a.yield_ratio);
        let work = match adhesion.and_then(|a| a.work) {
            Some(work) => format!("{work} J/m2"),
            None => "2 sqrt(gamma_p gamma_w)".to_owned(),
        };
        format!("{}, yield_ratio {ratio}, work of adhesion {work}", self.normal.name())
    }
}

/// A listed law with its parameters and the case to which it was fitted.
fn listed(name: &str, parameters: &[Parameter], values: &[f64], origin: &Origin) -> String {
    let mut parts = vec![name.to_owned()];
    parts.extend(describe_values(parameters, values));
    format!("{} ({})", parts.join(", "), origin.describe())
}
