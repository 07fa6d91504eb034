//! What an equation consists of: its formula, its inputs with units and ranges, its result, and the function that computes it.

use crate::quantity::cell::{CELLS, Cell, Row, Words};
use crate::spectrum::Density;

/// The chapters of the lecture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// Photons and energy.
    Photons,
    /// What lamps emit.
    Emission,
    /// Solid angles and projected solid angles.
    SolidAngles,
    /// Flux, étendue, the measurement equation, light on a surface.
    Collecting,
    /// From radiant quantities to luminous ones and others, through a spectrum.
    Photometry,
    /// Black bodies.
    BlackBodies,
}

impl Group {
    /// What it is called.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Photons => "Photons and energy",
            Self::Emission => "Emission",
            Self::SolidAngles => "Solid angles",
            Self::Collecting => "Collecting light: étendue, cos θ/r², the measurement equation",
            Self::Photometry => "Photometry: through a spectrum",
            Self::BlackBodies => "Black bodies",
        }
    }
}

/// What values an input may have. What is not finite is never allowed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Domain {
    /// Above zero.
    Positive,
    /// Zero and above.
    NotNegative,
    /// Any number.
    Real,
    /// From and to, both included.
    Between(f64, f64),
    /// Above a number.
    Above(f64),
    /// Above a number and up to another.
    AboveUpTo(f64, f64),
    /// A spectrum: a name of the library, a form of scene files such as `BlackBody(2856)`, or a wavelength in nm, which is a line.
    Spectrum,
}

impl Domain {
    /// Whether a number is allowed. No number is a spectrum.
    pub fn contains(self, x: f64) -> bool {
        x.is_finite()
            && match self {
                Self::Positive => x > 0.0,
                Self::NotNegative => x >= 0.0,
                Self::Real => true,
                Self::Between(from, to) => from <= x && x <= to,
                Self::Above(least) => x > least,
                Self::AboveUpTo(least, most) => least < x && x <= most,
                Self::Spectrum => false,
            }
    }

    /// What is allowed, in words.
    pub fn words(self) -> String {
        match self {
            Self::Positive => "finite and above 0".into(),
            Self::NotNegative => "finite and not below 0".into(),
            Self::Real => "finite".into(),
            Self::Between(from, to) => format!("{from} to {to}"),
            Self::Above(least) => format!("finite and above {least}"),
            Self::AboveUpTo(least, most) => format!("above {least}, up to {most}"),
            Self::Spectrum => {
                "a spectrum of the library such as D65, a form such as BlackBody(2856), or a wavelength in nm for a line".into()
            }
        }
    }
}

/// The unit of an input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Always the same; "1" for a pure number, "" for a spectrum.
    Fixed(&'static str),
    /// A row of the table of quantities: given in any of the systems of [`SYSTEMS_IN_KEYS`], which the key tells.
    Of(Row),
}

/// The systems in which a quantity may be given where the equation is the same for all.
pub const SYSTEMS_IN_KEYS: [&str; 3] = ["radiant", "luminous", "photon"];

/// The words of a cell of the table.
pub(super) fn words(row: Row, system: &str) -> &'static Words {
    // Every system has every row, which the tests of the table hold it to.
    CELLS.iter().find(|words| words.row == row && words.system == system).unwrap_or(&CELLS[0])
}

/// A unit as part of a key: "W/(m² sr)" → "w_m2_sr", "1/s" → "per_s".
fn unit_in_key(unit: &str) -> String {
    let plain: String = unit.chars().filter(|c| !"()".contains(*c)).map(|c| if c == '²' { '2' } else { c }).collect();
    if plain == "1" {
        return "photons".into();
    }
    plain.replace("1/", "per_").replace(['/', ' '], "_").to_lowercase()
}

/// One input of an equation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Input {
    /// The key, with its unit, e.g. "wavelength_nm"; the stem of the keys, e.g. "intensity", where [`Input::unit`] is [`Unit::Of`].
    pub key: &'static str,
    /// Symbol in the formula, e.g. "λ".
    pub symbol: &'static str,
    /// Unit.
    pub unit: Unit,
    /// What is allowed.
    pub domain: Domain,
    /// What it means.
    pub meaning: &'static str,
}

impl Input {
    /// The keys under which it may be given, each with its unit and its system ("" if the unit is fixed).
    pub fn keys(&self) -> Vec<(String, &'static str, &'static str)> {
        match self.unit {
            Unit::Fixed(unit) => vec![(self.key.to_owned(), unit, "")],
            Unit::Of(row) => SYSTEMS_IN_KEYS
                .iter()
                .map(|system| {
                    let unit = words(row, system).unit;
                    (format!("{}_{}", self.key, unit_in_key(unit)), unit, *system)
                })
                .collect(),
        }
    }
}

/// An input with a fixed unit.
pub(super) const fn input(key: &'static str, symbol: &'static str, unit: &'static str, domain: Domain, meaning: &'static str) -> Input {
    Input { key, symbol, unit: Unit::Fixed(unit), domain, meaning }
}

/// A quantity of the table in any system, zero and above.
pub(super) const fn in_any_system(key: &'static str, symbol: &'static str, row: Row, meaning: &'static str) -> Input {
    Input { key, symbol, unit: Unit::Of(row), domain: Domain::NotNegative, meaning }
}

/// A spectrum by name.
pub(super) const SPECTRUM: Input = input("spectrum", "S(λ)", "", Domain::Spectrum, "spectrum of the light");

/// What an equation answers with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// Always the same quantity.
    Fixed {
        /// Standard term.
        name: &'static str,
        /// Symbol.
        symbol: &'static str,
        /// Unit; "1" for a number.
        unit: &'static str,
    },
    /// A row of the table, in the system of the input.
    Of(Row),
}

impl Outcome {
    /// Name, symbol and unit in a system; the system matters only for [`Outcome::Of`].
    pub fn words(self, system: &str) -> [&'static str; 3] {
        match self {
            Self::Fixed { name, symbol, unit } => [name, symbol, unit],
            Self::Of(row) => {
                let words = words(row, system);
                [words.name, words.symbol, words.unit]
            }
        }
    }
}

/// An outcome that is a cell of the table.
pub(super) const fn cell<C: Cell>() -> Outcome {
    Outcome::Fixed { name: C::NAME, symbol: C::SYMBOL, unit: C::UNIT }
}

/// An outcome that is none.
pub(super) const fn outcome(name: &'static str, symbol: &'static str, unit: &'static str) -> Outcome {
    Outcome::Fixed { name, symbol, unit }
}

/// The values of the inputs.
#[derive(Debug, Clone, Default)]
pub struct Given {
    /// Key (or stem) and number.
    pub(super) numbers: Vec<(&'static str, f64)>,
    /// The spectrum, if one is among the inputs.
    pub(super) spectrum: Option<Density>,
}

impl Given {
    /// The number of an input; NaN if it is none of the equation, which the tests exclude.
    pub fn number(&self, key: &str) -> f64 {
        self.numbers.iter().find(|(name, _)| *name == key).map_or(f64::NAN, |(_, value)| *value)
    }

    /// The spectrum; empty if the equation has none.
    pub fn spectrum(&self) -> Density {
        self.spectrum.clone().unwrap_or_else(Density::zero)
    }
}

/// The same result in another form.
#[derive(Debug, Clone, Copy)]
pub struct Also {
    /// What it is.
    pub what: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// From the inputs and the result.
    pub compute: fn(&Given, f64) -> f64,
}

/// An equation of the lecture.
#[derive(Debug, Clone, Copy)]
pub struct Equation {
    /// The name by which it is called, e.g. "photon-energy".
    pub name: &'static str,
    /// Its chapter.
    pub group: Group,
    /// The formula in the symbols of its inputs.
    pub formula: &'static str,
    /// What it says, in words.
    pub about: &'static str,
    /// Its inputs.
    pub inputs: &'static [Input],
    /// Its result.
    pub outcome: Outcome,
    /// Where it is from.
    pub source: &'static str,
    /// Inputs with which it can be tried: keys and values.
    pub example: &'static [(&'static str, &'static str)],
    /// The result from the inputs, or why there is none.
    pub compute: fn(&Given) -> Result<f64, String>,
    /// Other forms of the result.
    pub also: &'static [Also],
}
