//! What a fit can add to a base model: an effect, or another value of a parameter of its laws.

use toml_edit::{DocumentMut, Item, Value, value};

use super::data_split::DataSplit;
use super::record::Estimate;
use super::search::SearchAxis;
use nearwall::effect::{EFFECTS, EffectInfo};
use nearwall::law::QuantityKind;
use nearwall::model::{Model, kind_of};
use nearwall::normal::NormalLaw;
use nearwall::tangential::TangentialLaw;

/// A number of the base model: a parameter of its laws, or of an effect that it has.
#[derive(Debug, Clone, Copy)]
pub(super) enum LawParameter {
    /// `normal.e_n` of constant restitution.
    NormalRestitution,
    /// `tangential.e_t` of constant restitution.
    TangentialRestitution,
    /// `tangential.friction`.
    Friction,
    /// A number of the criterion of capture by its key, with its value in the base model.
    OfCapture(&'static str, f64),
    /// A parameter of an effect, by its place.
    OfEffect(&'static EffectInfo, usize),
}

/// How far a viscosity of the criterion of capture is searched, as a factor: the literature's span five decades [1].
const VISCOSITY_REACH: f64 = 1e3;

impl LawParameter {
    /// The numbers that a model has; not those of an effect that it has twice.
    pub fn all(model: &Model) -> Vec<Self> {
        let of_laws = [Self::NormalRestitution, Self::TangentialRestitution, Self::Friction];
        let of_effects = EFFECTS
            .into_iter()
            .flat_map(|effect| (0..effect.parameters.len()).map(move |place| Self::OfEffect(effect, place)));
        let of_capture =
            model.capture().numbers().into_iter().map(|(key, value)| Self::OfCapture(key, value));
        of_laws
            .into_iter()
            .chain(of_capture)
            .chain(of_effects)
            .filter(|parameter| parameter.of(model).is_some())
            .collect()
    }

    /// Table and key in the model file; of an effect its kind and key.
    fn key(self) -> [&'static str; 2] {
        match self {
            Self::NormalRestitution => ["normal", "e_n"],
            Self::TangentialRestitution => ["tangential", "e_t"],
            Self::Friction => ["tangential", "friction"],
            Self::OfCapture(key, _) => ["capture", key],
            Self::OfEffect(effect, place) => [effect.id, effect.parameters[place].name],
        }
    }

    /// Its value in a model, if the model has it.
    pub fn of(self, model: &Model) -> Option<f64> {
        if let Self::OfEffect(effect, place) = self {
            return term(model, effect).and_then(|at| model.terms()[at].values().get(place).copied());
        }
        if let Self::OfCapture(key, _) = self {
            return model
                .capture()
                .numbers()
                .into_iter()
                .find(|(own, _)| *own == key)
                .map(|(_, value)| value);
        }
        self.find(&mut model.normal_law(), &mut model.tangential_law()).copied()
    }

    /// The model with another value.
    pub fn set(self, model: &Model, value: f64) -> Model {
        if let Self::OfEffect(effect, place) = self {
            let mut terms = model.terms().to_vec();
            if let Some(term) = term(model, effect).and_then(|at| terms.get_mut(at)) {
                let mut values = term.values().to_vec();
                values.iter_mut().skip(place).take(1).for_each(|own| *own = value);
                *term = term.with_values(&values);
            }
            return model.with_terms(terms);
        }
        if let Self::OfCapture(key, _) = self {
            // A criterion that applies to a material does so with any number.
            return model
                .with_capture(model.capture().with_number(key, value))
                .unwrap_or_else(|_| model.clone());
        }
        let (mut normal, mut tangential) = (model.normal_law(), model.tangential_law());
        if let Some(parameter) = self.find(&mut normal, &mut tangential) {
            *parameter = value;
        }
        model.with_laws(normal, tangential)
    }

    /// Writes another value into a model file.
    pub fn write(self, document: &mut DocumentMut, number: f64) {
        let [table, key] = self.key();
        if !matches!(self, Self::OfEffect(..)) {
            document[table][key] = value(rounded(number));
            return;
        }
        let is_own = |kind: Option<&str>| kind == Some(table);
        match document.get_mut("effects") {
            Some(Item::ArrayOfTables(effects)) => {
                let own = effects.iter_mut().find(|one| is_own(one.get("kind").and_then(Item::as_str)));
                own.into_iter().for_each(|one| one[key] = value(rounded(number)));
            }
            Some(Item::Value(Value::Array(effects))) => {
                let mut tables = effects.iter_mut().filter_map(Value::as_inline_table_mut);
                let own = tables.find(|one| is_own(one.get("kind").and_then(Value::as_str)));
                own.into_iter().for_each(|one| drop(one.insert(key, rounded(number).into())));
            }
            _ => {}
        }
    }

    /// Its search range; `range` gives the least and largest value of an input in the data.
    fn axis(self, range: impl Fn(&str) -> Option<[f64; 2]>) -> Option<SearchAxis> {
        match self {
            Self::OfEffect(effect, place) => SearchAxis::of(&effect.parameters[place], range),
            Self::OfCapture(key, value) => Some(match kind_of(&["capture", key]) {
                Some(QuantityKind::Share) => SearchAxis::linear(0.0, 1.0),
                _ => SearchAxis::logarithmic(value / VISCOSITY_REACH, value * VISCOSITY_REACH),
            }),
            _ => Some(SearchAxis::linear(0.02, 1.1)),
        }
    }

    fn find<'a>(self, normal: &'a mut NormalLaw, tangential: &'a mut TangentialLaw) -> Option<&'a mut f64> {
        match (self, normal, tangential) {
            (Self::NormalRestitution, NormalLaw::Constant { restitution }, _)
            | (Self::TangentialRestitution, _, TangentialLaw::Constant { restitution }) => Some(restitution),
            (
                Self::Friction,
                _,
                TangentialLaw::Sliding { friction } | TangentialLaw::SlidingRolling { friction },
            ) => Some(friction),
            (Self::Friction, _, TangentialLaw::Listed { law, values }) => {
                let place = law.parameters.iter().position(|parameter| parameter.name == "friction")?;
                values.get_mut(place)
            }
            _ => None,
        }
    }
}

/// The place of the only term of an effect among those of a model.
fn term(model: &Model, effect: &EffectInfo) -> Option<usize> {
    let mut own = (0..model.terms().len()).filter(|at| model.terms()[*at].kind().id == effect.id);
    own.next().filter(|_| own.next().is_none())
}

/// An addition to the base model that has parameters.
#[derive(Debug, Clone, Copy)]
pub(super) enum Part {
    Effect(&'static EffectInfo),
    LawParameter(LawParameter),
}

impl Part {
    /// What a base model may lack: the effects that it does not have, and other values of its numbers. The effect
    /// `sliding-to-rolling` beside the law of that name is another friction of it.
    pub fn all(base: &Model) -> Vec<Self> {
        let rolls = matches!(base.tangential_law(), TangentialLaw::SlidingRolling { .. });
        let has = |id: &str| base.terms().iter().any(|term| term.kind().id == id);
        let is_open = |id: &str| !has(id) && (id != "sliding-to-rolling" || !rolls);
        let effects = EFFECTS.into_iter().filter(|effect| is_open(effect.id)).map(Self::Effect);
        effects.chain(LawParameter::all(base).into_iter().map(Self::LawParameter)).collect()
    }

    /// An effect's id, or the key of a law's parameter.
    pub fn name(&self) -> String {
        match self {
            Self::Effect(effect) => effect.id.to_owned(),
            Self::LawParameter(parameter) => parameter.key().join("."),
        }
    }

    /// Whether its outcome is drawn at random.
    pub fn is_stochastic(&self) -> bool {
        let effect = match self {
            Self::Effect(effect) | Self::LawParameter(LawParameter::OfEffect(effect, _)) => effect,
            Self::LawParameter(_) => return false,
        };
        effect.stream.is_some()
    }

    /// The inputs that it depends on.
    pub fn inputs(&self) -> &'static [&'static str] {
        match self {
            Self::Effect(effect) => effect.inputs,
            Self::LawParameter(LawParameter::OfEffect(effect, _)) => effect.inputs,
            Self::LawParameter(_) => &[],
        }
    }

    /// The search ranges of its parameters, with `refined` also of those with a default, which come
    /// last; `range` gives the least and largest value of an input in the data. `None` if the data
    /// do not vary in what it depends on.
    pub fn axes(&self, range: impl Fn(&str) -> Option<[f64; 2]>, refined: bool) -> Option<Vec<SearchAxis>> {
        let effect = match self {
            Self::Effect(effect) => effect,
            Self::LawParameter(parameter) => return Some(vec![parameter.axis(range)?]),
        };
        // Beside another input, speed and diameter need not vary: the plain laws depend on them too.
        let (plain, others): (Vec<&str>, Vec<&str>) =
            effect.inputs.iter().partition(|input| ["v_n", "d"].contains(*input));
        let needed = if others.is_empty() { plain } else { others };
        needed.iter().map(|input| range(input)).collect::<Option<Vec<_>>>()?;
        let free = effect.parameters.iter().filter(|p| refined || p.default.is_none());
        free.map(|p| SearchAxis::of(p, &range)).collect()
    }
}

/// A part with the values of its parameters.
#[derive(Debug, Clone)]
pub(super) struct FittedPart {
    pub part: Part,
    pub axes: Vec<SearchAxis>,
    /// Coordinates on the axes.
    pub at: Vec<f64>,
    /// 95 % intervals of the parameters that have an axis, in SI units; empty before the final fit.
    pub intervals: Vec<[f64; 2]>,
    /// Pairs of parameters, by place, of which the data determine only a combination, with their correlation [1].
    pub inseparable: Vec<([usize; 2], f64)>,
}

impl FittedPart {
    /// The part at the middle of its search ranges.
    pub fn middle(part: Part, axes: Vec<SearchAxis>) -> Self {
        Self { part, at: vec![0.5; axes.len()], axes, intervals: Vec::new(), inseparable: Vec::new() }
    }

    /// Whether a parameter is at the end of its search range, and could lie beyond.
    pub fn at_bound(&self) -> bool {
        self.axes.iter().zip(&self.at).any(|(axis, at)| axis.is_at_end(*at))
    }

    /// Makes the parameters that are left at their defaults free.
    pub fn free_defaults(&mut self, data: &DataSplit) {
        let (values, own) = (self.values(), self.axes.len());
        let Some(axes) = self.part.axes(|input| data.range(input), true) else { return };
        for (axis, value) in axes.into_iter().zip(values).skip(own) {
            self.axes.push(axis);
            self.at.push(axis.coordinate(value));
        }
    }

    /// The parameters in SI units; those without an axis have their defaults.
    pub fn values(&self) -> Vec<f64> {
        let mut values: Vec<f64> = self.axes.iter().zip(&self.at).map(|(axis, at)| axis.value(*at)).collect();
        if let Part::Effect(effect) = self.part {
            let further = effect.parameters.iter().skip(values.len());
            values.extend(further.filter_map(|parameter| parameter.default));
        }
        values
    }

    /// What the data cannot separate, in sentences.
    pub fn not_separable(&self) -> Vec<String> {
        let Part::Effect(effect) = self.part else { return Vec::new() };
        let name = |place: usize| effect.parameters.get(place).map_or("", |parameter| parameter.name);
        let sentence = |([one, two], correlation): &([usize; 2], f64)| {
            let (one, two) = (name(*one), name(*two));
            let together = if *correlation > 0.0 { "in the same direction" } else { "against each other" };
            format!(
                "These data determine only a combination of {one} and {two}: both can change {together} at almost no \
                    cost (correlation {correlation:.3})."
            )
        };
        self.inseparable.iter().map(sentence).collect()
    }

    /// The fitted parameters of an effect by name, with six digits; none before the final fit.
    pub fn estimates(&self) -> impl Iterator<Item = (&'static str, Estimate)> {
        let Self { part, intervals, .. } = self;
        let parameters = if let Part::Effect(effect) = part { effect.parameters } else { &[] };
        parameters.iter().zip(self.values()).zip(intervals).map(|((parameter, value), interval)| {
            let [low, high] = interval.map(rounded);
            (parameter.name, Estimate { value: rounded(value), low, high, unit: parameter.unit })
        })
    }
}

/// The number with six digits, which is more than the accuracy of a fit.
pub(super) fn rounded(number: f64) -> f64 {
    format!("{number:.5e}").parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAWS: &str = "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n\
        [normal]\nmodel = \"constant\"\ne_n = 0.5\n[tangential]\nmodel = \"constant\"\ne_t = 0.8\n";

    /// A number of an effect that the base has is set in the model and in both ways to write the file.
    #[test]
    fn numbers_of_effects_are_set_and_written() {
        let tables = "[[effects]]\nkind = \"melting-transition\"\ntemperature = 330\nwidth = 8\n";
        let inline = "effects = [{ kind = \"melting-transition\", temperature = 330, width = 8 }]\n";
        for text in [format!("{LAWS}{tables}"), format!("{inline}{LAWS}")] {
            let model = Model::from_toml("m.toml", &text).unwrap();
            let numbers = LawParameter::all(&model);
            let temperature = *numbers.iter().find(|one| one.key()[1] == "temperature").unwrap();
            assert_eq!(temperature.of(&model), Some(330.0));
            assert_eq!(temperature.of(&temperature.set(&model, 338.0)), Some(338.0));
            let mut document: DocumentMut = text.parse().unwrap();
            temperature.write(&mut document, 338.0);
            let read = Model::from_toml("m.toml", &document.to_string()).unwrap();
            assert_eq!(temperature.of(&read), Some(338.0));
        }
    }
}
