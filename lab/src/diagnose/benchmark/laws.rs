//! The laws of the library by name, and the laws of a model file, with the materials of a measured set.

use nearwall::law::{Parameter, Search};
use nearwall::slag::VISCOSITY_LAWS;
use nearwall::slag::urbain::KALMANOVITCH_FRANK;
use nearwall::{normal, tangential};
use toml_edit::{DocumentMut, Item, Table, TomlError, value};

/// Tables of a model file that hold its laws; the others hold materials and walls.
const LAW_TABLES: [&str; 6] = ["normal", "tangential", "capture", "inputs", "groups", "effects"];
/// The adhesion of a pair of materials, which a set may state.
const ADHESION: &str = "work_of_adhesion";
/// Values of a number that is fitted: so many steps over its range.
const STEPS: u32 = 12;

/// What a law decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// `[normal]`: `e_n`, and captures by adhesion.
    Normal,
    /// `[tangential]`: `e_t`.
    Tangential,
    /// `[capture]`: captures by a melt.
    Capture,
}

impl Side {
    fn table(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Tangential => "tangential",
            Self::Capture => "capture",
        }
    }
}

/// A law with the numbers that are fitted to the other sources.
#[derive(Debug, Clone)]
pub(super) struct NamedLaw {
    pub side: Side,
    model: &'static str,
    /// The law of viscosity that a law of capture uses.
    viscosity: Option<&'static str>,
    numbers: Vec<(&'static str, Search)>,
}

/// Every law of the library.
pub(super) fn named_laws() -> Vec<NamedLaw> {
    let law = |side, model, numbers: &[(&'static str, Search)]| NamedLaw {
        side,
        model,
        viscosity: None,
        numbers: numbers.to_vec(),
    };
    let share = Search::Linear(0.05, 1.0);
    let yielding = Search::Log(0.35, 5.6);
    let friction = Search::Linear(0.03, 0.9);
    let mut laws = vec![
        law(Side::Normal, "thornton-ning", &[("yield_ratio", yielding)]),
        law(Side::Normal, "thornton-ning-raised-pull-off", &[("yield_ratio", yielding)]),
        law(Side::Normal, "constant", &[("e_n", share)]),
        law(Side::Tangential, "constant", &[("e_t", share)]),
        law(Side::Tangential, "sliding", &[("friction", friction)]),
        law(Side::Tangential, "sliding-rolling", &[("friction", friction)]),
    ];
    laws.extend(normal::LISTED_LAWS.iter().map(|one| law(Side::Normal, one.name, &fitted(one.parameters))));
    laws.extend(
        tangential::LISTED_LAWS.iter().map(|one| law(Side::Tangential, one.name, &fitted(one.parameters))),
    );
    laws
}

/// Adhesion alone, beside which the laws of capture stand.
pub(super) fn adhesion_alone() -> NamedLaw {
    NamedLaw { side: Side::Capture, model: "none", viscosity: None, numbers: Vec::new() }
}

/// Every law of capture by a melt; the constant limit of viscosity with each law of viscosity, the others that need one
/// with Kalmanovitch and Frank's.
pub(super) fn capture_laws() -> Vec<NamedLaw> {
    let law = |model, viscosity, numbers| NamedLaw { side: Side::Capture, model, viscosity, numbers };
    // The literature has 8 to 1e7 Pa s.
    let reference = ("reference_viscosity", Search::Log(1.0, 1e8));
    let by_sheet = ["fusion", "melt-fraction"].map(|model| law(model, None, Vec::new()));
    let by_viscosity = VISCOSITY_LAWS.iter().map(|one| law("viscosity", Some(one.name), vec![reference]));
    let others =
        ["kinetic-energy", "droplet"].map(|model| law(model, Some(KALMANOVITCH_FRANK.name), Vec::new()));
    by_sheet.into_iter().chain(by_viscosity).chain(others).collect()
}

/// The parameters without a default: every fit searches them.
fn fitted(parameters: &[Parameter]) -> Vec<(&'static str, Search)> {
    let searched = parameters.iter().filter(|parameter| parameter.default.is_none());
    searched.map(|parameter| (parameter.name, parameter.search)).collect()
}

/// Values of a fitted number with their names, as the keys of a law table.
pub(super) type Numbers = Vec<(&'static str, f64)>;

impl NamedLaw {
    /// The law; of a law of capture with the law of viscosity that it uses.
    pub fn name(&self) -> String {
        [self.model].into_iter().chain(self.viscosity).collect::<Vec<_>>().join(" ")
    }

    /// Every combination of the values of its numbers; one without any for a law that has none.
    pub fn trials(&self) -> Vec<Numbers> {
        let mut all: Vec<Numbers> = vec![Vec::new()];
        for &(name, search) in &self.numbers {
            let values = values(search);
            all = all
                .iter()
                .flat_map(|one| values.iter().map(|&value| [one.clone(), vec![(name, value)]].concat()))
                .collect();
        }
        all
    }

    /// The model of a set under this law with these numbers; the other law of a rebound is the default one.
    pub fn model_text(&self, base: &str, numbers: &Numbers) -> Result<String, TomlError> {
        let mut laws = DocumentMut::new();
        laws["normal"] =
            Item::Table(Table::from_iter([("model", value("thornton-ning")), ("yield_ratio", value(1.6))]));
        laws["tangential"] =
            Item::Table(Table::from_iter([("model", value("constant")), ("e_t", value(0.8))]));
        let mut own = Table::from_iter([("model", value(self.model))]);
        own.extend(self.viscosity.map(|viscosity| ("law", value(viscosity))));
        own.extend(numbers.iter().map(|(name, number)| (*name, value(*number))));
        laws[self.side.table()] = Item::Table(own);
        with_laws(base, &laws)
    }
}

/// The values of a number that a fit tries.
fn values(search: Search) -> Vec<f64> {
    let steps = |low: f64, high: f64| {
        (0..=STEPS).map(move |step| low + (high - low) * f64::from(step) / f64::from(STEPS))
    };
    match search {
        Search::Log(low, high) => steps(low.ln(), high.ln()).map(f64::exp).collect(),
        Search::Linear(low, high) => steps(low, high).collect(),
        // No law has a number that is searched within the range of an input.
        Search::InputRange(_) | Search::InputWidth(_) => Vec::new(),
    }
}

/// The materials and walls of one model text with the laws of another.
///
/// The adhesion of the pair of materials stays where the laws do not give one.
pub(super) fn with_laws(base: &str, laws: &DocumentMut) -> Result<String, TomlError> {
    let mut model: DocumentMut = base.parse()?;
    let adhesion = model.get("normal").and_then(|normal| normal.get(ADHESION)).cloned();
    for table in LAW_TABLES {
        model.remove(table);
        if let Some(own) = laws.get(table) {
            model.insert(table, own.clone());
        }
    }
    let normal = model.get_mut("normal").and_then(Item::as_table_mut);
    if let (Some(adhesion), Some(normal)) = (adhesion, normal)
        && !normal.contains_key(ADHESION)
    {
        normal.insert(ADHESION, adhesion);
    }
    Ok(model.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use nearwall::model::Model;

    const BASE: &str = "[particle]\nmaterial = \"montan-wax\"\n[walls.plate]\nmaterial = \"pyrex\"\n\
        [normal]\nmodel = \"constant\"\ne_n = 0.5\nwork_of_adhesion = 0.2\n[tangential]\nmodel = \"constant\"\ne_t = \
        1\n\
        [[effects]]\nkind = \"oblique-angle\"\nstrength = 0.3\n";

    /// Every law of the library can be put on the materials of a set with each of its trial numbers.
    #[test]
    fn every_law_is_a_model_with_the_materials_of_a_set() {
        for law in named_laws() {
            let trials = law.trials();
            for numbers in [trials.first(), trials.last()].into_iter().flatten() {
                let text = law.model_text(BASE, numbers).unwrap();
                let model =
                    Model::from_toml("m.toml", &text).unwrap_or_else(|error| panic!("{error}\n{text}"));
                let names = [model.normal_law().name(), model.tangential_law().name()];
                assert_eq!(names[law.side as usize], law.name());
                assert!(model.terms().is_empty() && text.contains("work_of_adhesion = 0.2"), "{text}");
            }
        }
    }

    /// The captures of a melt are told by a material that has what every law asks for.
    #[test]
    fn every_law_of_capture_is_a_model_of_a_fitting_material() {
        let melt = "[materials.melt]\nlike = \"coal-slag\"\nmelt_fraction = 0.5\n";
        let base = BASE.replace("montan-wax", "melt") + melt;
        for law in capture_laws() {
            let trials = law.trials();
            let text = law.model_text(&base, &trials[0]).unwrap();
            assert!(text.contains("[capture]"), "{text}");
            Model::from_toml("m.toml", &text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        }
    }

    #[test]
    fn a_law_with_two_numbers_is_tried_with_all_pairs() {
        let laws = named_laws();
        let count = |name: &str| laws.iter().find(|law| law.name() == name).unwrap().trials().len();
        assert_eq!((count("brach-dunn"), count("bons"), count("el-batsh")), (169, 1, 13));
    }
}
