//! Colour matching functions: `X = k ∫ X_e,λ x̄ dλ`, and so on for Y and Z; `R = k ∫ X_e,λ r̄ dλ` for sets of real primaries.
//!
//! | variant | functions | field | primaries |
//! |---|---|---|---|
//! | `Cie1931`, `Cie1964` | x̄ ȳ z̄ | 2°, 10° | imaginary; ȳ = V(λ) for 2° |
//! | `Cie2015TwoDegree`, `Cie2015TenDegree` | x̄_F ȳ_F z̄_F | 2°, 10° | imaginary; a linear map of the cone fundamentals |
//! | `WrightGuild1931` | r̄ ḡ b̄ | 2° | 700 nm, 546.1 nm, 435.8 nm |
//! | `StilesBurch1955` | r̄ ḡ b̄ | 2° | 645.16 nm, 526.32 nm, 444.44 nm |
//! | `StilesBurch1959` | r̄ ḡ b̄ | 10° | 645.16 nm, 526.32 nm, 444.44 nm |
//!
//! Sets of real primaries are negative where a primary has to be added to the light that is matched.

use super::names::find;
use super::{Efficiency, ObserverError, embedded};
use crate::spectrum::Factor;

/// A set of three colour matching functions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Matching {
    /// CIE 1931 standard observer, 2°.
    Cie1931,
    /// CIE 1964 supplementary standard observer, 10°.
    Cie1964,
    /// CIE 2015 (CIE 170-2), 2°, from cone fundamentals.
    Cie2015TwoDegree,
    /// CIE 2015 (CIE 170-2), 10°, from cone fundamentals.
    Cie2015TenDegree,
    /// CIE 1931 RGB of Wright and Guild, 2°.
    WrightGuild1931,
    /// Stiles and Burch 1955, 2°.
    StilesBurch1955,
    /// Stiles and Burch 1959, 10°.
    StilesBurch1959,
}

impl Matching {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Cie1931,
        Self::Cie1964,
        Self::Cie2015TwoDegree,
        Self::Cie2015TenDegree,
        Self::WrightGuild1931,
        Self::StilesBurch1955,
        Self::StilesBurch1959,
    ];

    /// The three functions, in the order of [`Matching::names`], zero outside their table.
    ///
    /// ```
    /// use etendue::observer::Matching;
    ///
    /// let [x, y, z] = Matching::Cie1931.functions();
    /// assert_eq!((x.at(600.0), y.at(600.0), z.at(600.0)), (1.0622, 0.631, 0.0008));
    /// ```
    pub fn functions(self) -> [Factor; 3] {
        self.columns().map(|column| embedded(&format!("{} {column}", self.title())))
    }

    /// Name of the set, that of its table in the library.
    pub fn title(self) -> &'static str {
        match self {
            Self::Cie1931 => "CIE 1931 2 Degree Standard Observer",
            Self::Cie1964 => "CIE 1964 10 Degree Standard Observer",
            Self::Cie2015TwoDegree => "CIE 2015 2 Degree Standard Observer",
            Self::Cie2015TenDegree => "CIE 2015 10 Degree Standard Observer",
            Self::WrightGuild1931 => "Wright & Guild 1931 2 Degree RGB CMFs",
            Self::StilesBurch1955 => "Stiles & Burch 1955 2 Degree RGB CMFs",
            Self::StilesBurch1959 => "Stiles & Burch 1959 10 Degree RGB CMFs",
        }
    }

    /// The set of this name: its title, or a short one such as "CIE 1931". Errors with all names if there is none.
    ///
    /// ```
    /// use etendue::observer::Matching;
    ///
    /// assert_eq!(Matching::named("cie 1964")?, Matching::Cie1964);
    /// # Ok::<(), etendue::observer::ObserverError>(())
    /// ```
    pub fn named(name: &str) -> Result<Self, ObserverError> {
        find("set of colour matching functions", name, &Self::ALL, Self::aliases)
    }

    /// All names, the short one first.
    fn aliases(self) -> &'static [&'static str] {
        match self {
            Self::Cie1931 => &["CIE 1931", "CIE 1931 2 Degree Standard Observer", "XYZ 1931"],
            Self::Cie1964 => &["CIE 1964", "CIE 1964 10 Degree Standard Observer", "XYZ 1964"],
            Self::Cie2015TwoDegree => &["CIE 2015 2 degree", "CIE 2015 2 Degree Standard Observer"],
            Self::Cie2015TenDegree => &["CIE 2015 10 degree", "CIE 2015 10 Degree Standard Observer"],
            Self::WrightGuild1931 => &["Wright & Guild 1931", "Wright & Guild 1931 2 Degree RGB CMFs", "Wright-Guild", "CIE RGB"],
            Self::StilesBurch1955 => &["Stiles & Burch 1955", "Stiles & Burch 1955 2 Degree RGB CMFs"],
            Self::StilesBurch1959 => &["Stiles & Burch 1959", "Stiles & Burch 1959 10 Degree RGB CMFs"],
        }
    }

    /// Short name, such as "CIE 1931".
    pub fn short_title(self) -> &'static str {
        self.aliases()[0]
    }

    /// The luminous efficiency function that the second function is, and with it the constant k that makes Y a luminous quantity. None
    /// for real primaries, whose units are their own.
    pub fn efficiency(self) -> Option<Efficiency> {
        match self {
            Self::Cie1931 => Some(Efficiency::Photopic1924),
            Self::Cie1964 => Some(Efficiency::TenDegree1964),
            Self::Cie2015TwoDegree => Some(Efficiency::Physiological2),
            Self::Cie2015TenDegree => Some(Efficiency::Physiological10),
            Self::WrightGuild1931 | Self::StilesBurch1955 | Self::StilesBurch1959 => None,
        }
    }

    /// Whether the functions belong to real primaries and are negative somewhere.
    pub fn has_real_primaries(self) -> bool {
        matches!(self, Self::WrightGuild1931 | Self::StilesBurch1955 | Self::StilesBurch1959)
    }

    /// Symbols of the three functions.
    pub fn names(self) -> [&'static str; 3] {
        match self {
            Self::Cie1931 => ["x̄", "ȳ", "z̄"],
            Self::Cie1964 => ["x̄_10", "ȳ_10", "z̄_10"],
            Self::Cie2015TwoDegree => ["x̄_F", "ȳ_F", "z̄_F"],
            Self::Cie2015TenDegree => ["x̄_F,10", "ȳ_F,10", "z̄_F,10"],
            Self::WrightGuild1931 | Self::StilesBurch1955 => ["r̄", "ḡ", "b̄"],
            Self::StilesBurch1959 => ["r̄_10", "ḡ_10", "b̄_10"],
        }
    }

    /// Names of the columns in the library.
    fn columns(self) -> [&'static str; 3] {
        if self.has_real_primaries() { ["r_bar", "g_bar", "b_bar"] } else { ["x_bar", "y_bar", "z_bar"] }
    }

    /// Symbols of the three tristimulus values.
    pub fn values(self) -> [&'static str; 3] {
        match self {
            Self::Cie1931 => ["X", "Y", "Z"],
            Self::Cie1964 => ["X_10", "Y_10", "Z_10"],
            Self::Cie2015TwoDegree => ["X_F", "Y_F", "Z_F"],
            Self::Cie2015TenDegree => ["X_F,10", "Y_F,10", "Z_F,10"],
            Self::WrightGuild1931 | Self::StilesBurch1955 => ["R", "G", "B"],
            Self::StilesBurch1959 => ["R_10", "G_10", "B_10"],
        }
    }
}
