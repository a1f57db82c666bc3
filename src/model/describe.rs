//! The content of a model in words, for `nearwall check`.

use std::collections::BTreeSet;

use super::wall::Covering;
use super::{Model, Wall};
use crate::effect::{CurveInput, Term};
use crate::group::GROUPS;
use crate::law::{Origin, Parameter, describe_values};
use crate::material::Material;
use crate::normal::NormalLaw;
use crate::tangential::TangentialLaw;

/// Temperature [K] at which a property that depends on it is shown.
const ROOM_TEMPERATURE: f64 = 293.15;

/// Of a wall whose slag has no critical viscosity temperature.
const UNKNOWN_STIFFENING: &str = " that counts as a liquid at every temperature: it is outside the range of Watt's \
    equation, and has neither critical_viscosity_temperature nor fusion_temperatures";

/// A remark where the analysis of a material leaves much out.
fn incomplete(material: &Material) -> Option<String> {
    let (name, sum) = (material.name(), material.incomplete_sum()?);
    Some(format!("the composition of {name} adds up to {sum:.1} wt% and is taken as 100; check the sheet"))
}

impl Model {
    /// The content of the model as pairs of a heading and its numbers with units, in the order of
    /// the steps of an impact.
    pub fn describe(&self) -> Vec<(&'static str, String)> {
        let mut particle = self.particle().name().to_owned();
        if let Some(ash) = self.ash() {
            particle += &format!(", burning to {}", ash.name());
        }
        let mut lines = vec![("particle", particle)];
        lines.extend(self.walls.iter().map(|wall| ("wall", wall.describe())));
        lines.extend(self.extra_inputs.iter().map(|input| ("input", input.describe())));
        lines.extend(self.products.iter().map(|product| ("group", product.describe(&self.extra_inputs))));
        lines.extend(self.used_groups().map(|group| ("group", group)));
        lines.push(("normal", self.describe_normal()));
        lines.push(("tangential", self.describe_tangential()));
        let capture = self.capture.describe().map_or_else(
            || "below the sticking velocity, and what effects add".to_owned(),
            |criterion| format!("also by {criterion}"),
        );
        lines.push(("capture", capture));
        for term in &self.terms {
            lines.push(("effect", term.describe(&self.declared())));
        }
        lines.extend(self.estimates());
        lines.extend(self.notes().into_iter().map(|note| ("note", note)));
        lines
    }

    /// What in the model is probably a mistake: an analysis that leaves much out, or a temperature that counts twice.
    pub fn notes(&self) -> Vec<String> {
        let notes: BTreeSet<String> =
            self.used_materials().filter_map(incomplete).chain(self.counted_twice()).collect();
        notes.into_iter().collect()
    }

    /// The materials in use, some of them more than once.
    fn used_materials(&self) -> impl Iterator<Item = &Material> {
        let of_walls = self
            .walls
            .iter()
            .flat_map(|wall| [Some(&wall.material), wall.slag.as_ref(), wall.powder.as_ref()]);
        [Some(self.particle()), self.ash()].into_iter().chain(of_walls).flatten()
    }

    /// The built-in groups on which terms depend, each once, in words.
    fn used_groups(&self) -> impl Iterator<Item = String> {
        let ranges = |term: &Term| term.valid_groups().iter().map(|(group, _)| *group).collect();
        let of_term = |term: &Term| [term.corrected_by(), ranges(term)].concat();
        let used: Vec<CurveInput> = self.terms.iter().flat_map(of_term).collect();
        let is_used = move |place: &usize| used.contains(&CurveInput::Group(*place));
        let groups = GROUPS.iter().enumerate().filter(move |(place, _)| is_used(place));
        groups.map(|(_, group)| format!("{} = {}, {}", group.name, group.formula, group.words))
    }

    /// What decides the stickiness of the particles and has a band, and the properties of the materials in use that
    /// follow from a composition, each with the error that its law states. Fusion temperatures and viscosity have 90 %
    /// bands; density, elastic constants and surface tension a bound; the temperature of critical viscosity after Watt
    /// and all that is given or built in have none.
    pub fn estimates(&self) -> Vec<(&'static str, String)> {
        let known = self.stickiness.as_ref().and_then(|criterion| criterion.describe());
        let mut lines: Vec<_> = known.map(|known| ("stickiness", known)).into_iter().collect();
        for material in self.used_materials() {
            for (key, origin) in material.estimated() {
                let line = ("estimated", format!("{key} of {}, {origin}", material.name()));
                if !lines.contains(&line) {
                    lines.push(line);
                }
            }
        }
        lines
    }

    /// A remark where criterion and effects multiply two stickinesses that both follow the particle's temperature.
    fn counted_twice(&self) -> Option<String> {
        let criterion = self.stickiness.as_ref()?.name();
        let term = self.terms.iter().find(|term| term.kind().id == "melting-transition")?;
        Some(format!(
            "[capture] model = \"{criterion}\" and the effect {} both make the particle sticky by its temperature, \
                and are multiplied: the temperature counts twice; remove one of them, unless they were fitted together",
            term.kind().id
        ))
    }

    fn describe_tangential(&self) -> String {
        match self.tangential {
            TangentialLaw::Constant { restitution } => format!("constant, e_t = {restitution}"),
            TangentialLaw::Sliding { friction } => format!("sliding, friction {friction}"),
            TangentialLaw::SlidingRolling { friction } => format!("sliding-rolling, friction {friction}"),
            TangentialLaw::Listed { law, values } => listed(law.name, law.parameters, &values, law.origin),
        }
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
            None => self.describe_own_adhesion(),
        };
        format!("{}, yield_ratio {ratio}, work of adhesion {work}", self.normal.name())
    }

    /// The work of adhesion where the model file does not give it; of the source of the particle's
    /// own the part before `;`.
    fn describe_own_adhesion(&self) -> String {
        let Some(property) = self.particle().property("work_of_adhesion") else {
            return "2 sqrt(gamma_p gamma_w)".to_owned();
        };
        let value = property.at(ROOM_TEMPERATURE).map_or_else(
            |range| format!("known from {} to {} K", range.low, range.high),
            |work| format!("{work} J/m2 at {ROOM_TEMPERATURE} K"),
        );
        let source = property.source().and_then(|text| text.split(';').next()).unwrap_or("no source given");
        format!("of {}: {value}, {source}", self.particle().name())
    }
}

impl Wall {
    fn describe(&self) -> String {
        let mut text = format!("{} of {}", self.name, self.material.name());
        if let Some(slag) = &self.slag {
            text += &format!(", under {}", slag.name());
        }
        if let Some(melt) = &self.melt {
            text +=
                &melt.stiff_below().map_or_else(String::new, |t| format!(" that is stiff below {t:.0} K"));
            text += if melt.stiffening_is_known() { "" } else { UNKNOWN_STIFFENING };
            text += &melt.describe().map_or_else(String::new, |melt| format!(" ({melt})"));
        }
        if let Some(powder) = &self.powder {
            text += &format!(", covered by {}", powder.name());
        }
        let Covering { layer_thickness, film_thickness, coverage } = self.covering;
        let covering =
            [("film", film_thickness, " m"), ("coverage", coverage, ""), ("layer", layer_thickness, " m")];
        for (what, value, unit) in covering.into_iter().filter(|(_, value, _)| *value > 0.0) {
            text += &format!(", {what} {value}{unit}");
        }
        if self.contact_heat {
            text += ", exchanges heat with what bounces";
        }
        if let Some(erosion) = &self.erosion {
            text += &format!(", eroded by {}", erosion.describe());
        }
        text += &self.processes.describe();
        text
    }
}

/// A listed law with its parameters and the case to which it was fitted.
fn listed(name: &str, parameters: &[Parameter], values: &[f64], origin: &Origin) -> String {
    let mut parts = vec![name.to_owned()];
    parts.extend(describe_values(parameters, values));
    format!("{} ({})", parts.join(", "), origin.describe())
}
