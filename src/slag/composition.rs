//! The oxide composition of an ash or slag.

/// An oxide that an ash analysis may list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "a variant is the oxide it names")]
pub enum Oxide {
    SiO2,
    Al2O3,
    Fe2O3,
    FeO,
    CaO,
    MgO,
    Na2O,
    K2O,
    TiO2,
    P2O5,
    MnO,
    SO3,
    B2O3,
}

/// Role of an oxide in the silicate network of a melt (Urbain's grouping).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum OxideRole {
    /// Builds the network: more of it makes the melt stiffer.
    GlassFormer,
    /// Breaks the network.
    Modifier,
    /// Builds or breaks it, depending on how much modifier there is to balance its charge.
    Amphoteric,
    /// Leaves as gas before the ash melts; enters no viscosity law.
    Volatile,
}

/// Why a list of oxides is not a composition.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CompositionError {
    /// The name is not one of [`Oxide::ALL`].
    #[error("unknown oxide `{name}`; known: {}", Oxide::names())]
    UnknownOxide {
        /// The name as it was given.
        name: String,
    },
    /// The same oxide stands twice in the list.
    #[error("{oxide} is given twice")]
    Repeated {
        /// The oxide's formula.
        oxide: &'static str,
    },
    /// A share below zero.
    #[error("{oxide} = {share} wt%: a share cannot be negative")]
    Negative {
        /// The oxide's formula.
        oxide: &'static str,
        /// The share that was given [wt%].
        share: f64,
    },
    /// A share that is no number.
    #[error("{oxide} = {share} wt%: a share must be a finite number")]
    NotFinite {
        /// The oxide's formula.
        oxide: &'static str,
        /// The share that was given [wt%].
        share: f64,
    },
    /// No oxide has a share above zero.
    #[error("the shares add up to zero")]
    Empty,
}

/// Formula, molar mass [kg/mol] and role of each oxide, in the order of the enum.
const OXIDES: [(Oxide, &str, f64, OxideRole); 13] = [
    (Oxide::SiO2, "SiO2", 60.083e-3, OxideRole::GlassFormer),
    (Oxide::Al2O3, "Al2O3", 101.961e-3, OxideRole::Amphoteric),
    (Oxide::Fe2O3, "Fe2O3", 159.687e-3, OxideRole::Amphoteric),
    (Oxide::FeO, "FeO", 71.844e-3, OxideRole::Modifier),
    (Oxide::CaO, "CaO", 56.077e-3, OxideRole::Modifier),
    (Oxide::MgO, "MgO", 40.304e-3, OxideRole::Modifier),
    (Oxide::Na2O, "Na2O", 61.979e-3, OxideRole::Modifier),
    (Oxide::K2O, "K2O", 94.195e-3, OxideRole::Modifier),
    (Oxide::TiO2, "TiO2", 79.865e-3, OxideRole::Modifier),
    (Oxide::P2O5, "P2O5", 141.943e-3, OxideRole::GlassFormer),
    (Oxide::MnO, "MnO", 70.937e-3, OxideRole::Modifier),
    (Oxide::SO3, "SO3", 80.057e-3, OxideRole::Volatile),
    (Oxide::B2O3, "B2O3", 69.617e-3, OxideRole::Amphoteric),
];

impl Oxide {
    /// Every oxide, in the order in which a composition lists them.
    pub const ALL: [Self; 13] = {
        let mut all = [Self::SiO2; 13];
        let mut index = 0;
        while index < all.len() {
            all[index] = OXIDES[index].0;
            index += 1;
        }
        all
    };

    /// The chemical formula, as files write it.
    pub fn name(self) -> &'static str {
        OXIDES[self as usize].1
    }

    /// The oxide of this formula, capitals as in chemistry.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|oxide| oxide.name() == name)
    }

    /// Molar mass [kg/mol], from the IUPAC abridged standard atomic weights.
    pub fn molar_mass(self) -> f64 {
        OXIDES[self as usize].2
    }

    /// Its role in the network of a silicate melt.
    pub fn role(self) -> OxideRole {
        OXIDES[self as usize].3
    }

    fn names() -> String {
        Self::ALL.map(Self::name).join(", ")
    }
}

/// Oxides and their shares. Only ratios matter: an analysis need not add up to 100.
///
/// ```
/// use nearwall::slag::{Composition, Oxide};
///
/// let ash = Composition::new([("SiO2", 60.0), ("CaO", 20.0)])?;
/// assert_eq!(ash.weight_percent(Oxide::SiO2), 75.0);
/// # Ok::<(), nearwall::slag::CompositionError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Composition {
    /// [wt%], by [`Oxide`] as index; their sum is 100.
    shares: [f64; Oxide::ALL.len()],
    /// Their sum as given [wt%].
    given: f64,
}

impl Composition {
    /// Takes pairs of formula and share [wt%]; oxides that are not named are absent.
    ///
    /// # Errors
    /// [`CompositionError`] for an unknown or repeated oxide, a negative or non-finite share, or nothing at all.
    pub fn new<'a>(oxides: impl IntoIterator<Item = (&'a str, f64)>) -> Result<Self, CompositionError> {
        let mut given = [None; Oxide::ALL.len()];
        for (name, share) in oxides {
            let oxide = Oxide::from_name(name)
                .ok_or_else(|| CompositionError::UnknownOxide { name: name.to_owned() })?;
            if !share.is_finite() {
                return Err(CompositionError::NotFinite { oxide: oxide.name(), share });
            }
            if share < 0.0 {
                return Err(CompositionError::Negative { oxide: oxide.name(), share });
            }
            if given[oxide as usize].replace(share).is_some() {
                return Err(CompositionError::Repeated { oxide: oxide.name() });
            }
        }
        let shares = given.map(|share| share.unwrap_or(0.0));
        // Scaled by the largest share first, so that the sum of huge shares stays finite.
        let largest = shares.iter().copied().fold(0.0, f64::max);
        if largest <= 0.0 {
            return Err(CompositionError::Empty);
        }
        let total: f64 = shares.iter().map(|share| share / largest).sum();
        let given = total * largest;
        Ok(Self { shares: shares.map(|share| 100.0 * (share / largest) / total), given })
    }

    /// What the shares of the analysis added up to before they were scaled [wt%].
    pub fn given_sum(&self) -> f64 {
        self.given
    }

    /// Share of an oxide [wt%], scaled so that all oxides add up to 100.
    pub fn weight_percent(&self, oxide: Oxide) -> f64 {
        self.shares[oxide as usize]
    }

    /// Amount of an oxide in 100 kg of ash or slag [mol].
    pub fn moles(&self, oxide: Oxide) -> f64 {
        self.weight_percent(oxide) / oxide.molar_mass()
    }

    /// Mole fraction of an oxide [1], among all oxides that the composition lists.
    pub fn mole_fraction(&self, oxide: Oxide) -> f64 {
        let total: f64 = Oxide::ALL.iter().map(|o| self.moles(*o)).sum();
        self.moles(oxide) / total
    }

    /// The oxides that are present with their shares [wt%].
    pub fn oxides(&self) -> impl Iterator<Item = (Oxide, f64)> {
        let all = Oxide::ALL.into_iter().map(|oxide| (oxide, self.weight_percent(oxide)));
        all.filter(|(_, share)| *share > 0.0)
    }
}

/// Composition of a test from its shares [wt%], as in `"SiO2 60, CaO 40"`.
#[cfg(test)]
pub(super) fn oxides(text: &str) -> Composition {
    let pairs = text.split(", ").map(|pair| pair.split_once(' ').unwrap());
    Composition::new(pairs.map(|(oxide, share)| (oxide, share.parse().unwrap()))).unwrap()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn shares_are_scaled_and_absent_oxides_are_zero() {
        let ash = Composition::new([("SiO2", 30.0), ("Al2O3", 10.0), ("CaO", 0.0)]).unwrap();
        assert_relative_eq!(ash.weight_percent(Oxide::SiO2), 75.0);
        assert_relative_eq!(ash.weight_percent(Oxide::Al2O3), 25.0);
        assert_eq!(ash.weight_percent(Oxide::K2O), 0.0);
        assert_eq!(ash.oxides().count(), 2);
    }

    #[test]
    fn mole_fractions_follow_the_molar_masses() {
        // One mole of each.
        let ash = Composition::new([("SiO2", 60.083), ("CaO", 56.077)]).unwrap();
        assert_relative_eq!(ash.mole_fraction(Oxide::SiO2), 0.5, max_relative = 1e-15);
        let total: f64 = Oxide::ALL.iter().map(|oxide| ash.mole_fraction(*oxide)).sum();
        assert_relative_eq!(total, 1.0, max_relative = 1e-15);
    }

    #[test]
    fn molar_masses_are_those_of_the_atoms() {
        let oxygen = 15.999e-3;
        let atoms = [
            (Oxide::SiO2, 28.085e-3 + 2.0 * oxygen),
            (Oxide::Al2O3, 2.0 * 26.982e-3 + 3.0 * oxygen),
            (Oxide::Fe2O3, 2.0 * 55.845e-3 + 3.0 * oxygen),
            (Oxide::FeO, 55.845e-3 + oxygen),
            (Oxide::CaO, 40.078e-3 + oxygen),
            (Oxide::MgO, 24.305e-3 + oxygen),
            (Oxide::Na2O, 2.0 * 22.990e-3 + oxygen),
            (Oxide::K2O, 2.0 * 39.098e-3 + oxygen),
            (Oxide::TiO2, 47.867e-3 + 2.0 * oxygen),
            (Oxide::P2O5, 2.0 * 30.974e-3 + 5.0 * oxygen),
            (Oxide::MnO, 54.938e-3 + oxygen),
            (Oxide::SO3, 32.06e-3 + 3.0 * oxygen),
            (Oxide::B2O3, 2.0 * 10.81e-3 + 3.0 * oxygen),
        ];
        assert_eq!(atoms.map(|(oxide, _)| oxide), Oxide::ALL);
        for (oxide, mass) in atoms {
            assert_relative_eq!(oxide.molar_mass(), mass, max_relative = 2e-5);
        }
    }

    #[test]
    fn every_name_leads_back_to_its_oxide() {
        for oxide in Oxide::ALL {
            assert_eq!(Oxide::from_name(oxide.name()), Some(oxide));
            assert_eq!(Oxide::ALL[oxide as usize], oxide);
        }
    }

    #[test]
    fn bad_compositions_say_what_is_wrong() {
        let message =
            |oxides: &[(&str, f64)]| Composition::new(oxides.iter().copied()).unwrap_err().to_string();
        assert!(message(&[("SiO", 1.0)]).starts_with("unknown oxide `SiO`; known: SiO2, Al2O3"));
        assert!(message(&[("SiO2", -1.0)]).contains("SiO2 = -1 wt%"));
        assert!(message(&[("SiO2", f64::NAN)]).contains("finite"));
        assert!(message(&[("CaO", f64::INFINITY)]).contains("finite"));
        assert!(message(&[("CaO", 1.0), ("CaO", 2.0)]).contains("twice"));
        assert!(message(&[]).contains("zero"));
        assert!(message(&[("SiO2", 0.0)]).contains("zero"));
        // Ratios are all that counts, so neither end of the scale may overflow.
        let extreme = Composition::new([("SiO2", 1e308), ("CaO", 1e308)]).unwrap();
        assert_relative_eq!(extreme.weight_percent(Oxide::SiO2), 50.0);
    }
}
