//! The tables that come with the library, by name.
//!
//! A name is compared without case and separators: `LED-B3`, `led b3` and `ledb3` are one. Files with several columns hold one entry a
//! column, called by the name of the file and that of the column: `ColorChecker dark skin`. The tables and their pedigrees are
//! listed in `data/README.md`.

use std::sync::OnceLock;

use super::table_text::{TableText, TextRules, parse};
use super::{Density, Factor, Outside, Table};

/// The files, as text.
pub(super) const FILES: [&str; 13] = [
    include_str!("../../data/v_lambda_1nm.csv"),
    include_str!("../../data/xyz_1931_1nm.csv"),
    include_str!("../../data/d50_5nm.csv"),
    include_str!("../../data/d65_5nm.csv"),
    include_str!("../../data/fl2_5nm.csv"),
    include_str!("../../data/fl11_5nm.csv"),
    include_str!("../../data/hp1_5nm.csv"),
    include_str!("../../data/led_b1_5nm.csv"),
    include_str!("../../data/led_b2_5nm.csv"),
    include_str!("../../data/led_b3_5nm.csv"),
    include_str!("../../data/led_b4_5nm.csv"),
    include_str!("../../data/led_b5_5nm.csv"),
    include_str!("../../data/colorchecker_babel_10nm.csv"),
];

/// What an entry of the library is.
#[derive(Debug, Clone, PartialEq)]
pub enum Curve {
    /// A reflectance, a responsivity, a weighting function.
    Factor(Factor),
    /// A spectral distribution; relative unless its unit says otherwise.
    Density(Density),
}

impl Curve {
    fn kind(&self) -> &'static str {
        match self {
            Self::Factor(_) => "factor (reflectance, responsivity, weighting function)",
            Self::Density(_) => "spectral distribution",
        }
    }
}

/// A curve with its names and its pedigree.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Official name.
    pub name: String,
    /// Other names.
    pub aliases: Vec<String>,
    /// What it is, in words.
    pub quantity: String,
    /// Unit of its values.
    pub unit: String,
    /// Where the numbers come from.
    pub source: String,
    /// Under which licence.
    pub licence: String,
    /// The function of wavelength.
    pub curve: Curve,
}

/// A name that the library does not have, or has as the other kind.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LookupError {
    /// No entry of this name.
    #[error("the library has no `{name}`; nearest names: {}", nearest.join(", "))]
    Unknown {
        /// What was asked for.
        name: String,
        /// Official names and aliases that are closest, best first.
        nearest: Vec<String>,
    },
    /// A density where a factor was asked for, or the other way round.
    #[error("`{name}` is a {found}; a {wanted} is needed here")]
    OtherKind {
        /// Official name of the entry.
        name: String,
        /// What it is.
        found: &'static str,
        /// What was asked for.
        wanted: &'static str,
    },
}

/// All entries, in the order of the files; the two illuminants by formula come first.
pub fn entries() -> &'static [Entry] {
    static ENTRIES: OnceLock<Vec<Entry>> = OnceLock::new();
    ENTRIES.get_or_init(|| {
        let mut entries = formulas();
        for file in FILES {
            // Negative values are allowed because factors may have them; a density with one is refused by its constructor.
            let rules = TextRules { negative_values: true, ..TextRules::default() };
            // The tests hold every file to this; a file that did not parse would be an unknown name, never a wrong number.
            entries.extend(parse(file, &rules).ok().iter().flat_map(entries_of));
        }
        entries
    })
}

/// Illuminants A and E, which need no table.
fn formulas() -> Vec<Entry> {
    let entry = |name: &str, aliases: &[&str], source: &str, density| Entry {
        name: name.to_owned(),
        aliases: aliases.iter().map(|alias| (*alias).to_owned()).collect(),
        quantity: "relative spectral distribution".to_owned(),
        unit: "1/nm (relative)".to_owned(),
        source: source.to_owned(),
        licence: "a formula".to_owned(),
        curve: Curve::Density(density),
    };
    let a = entry(
        "A",
        &["CIE illuminant A", "illuminant A", "incandescent"],
        "CIE 015:2018, formula of illuminant A, 300-830 nm",
        Density::illuminant_a(),
    );
    let equal_energy = Density::flat(360.0, 830.0, 100.0).ok();
    let e = equal_energy.map(|density| {
        let aliases = ["CIE illuminant E", "illuminant E", "equal energy"];
        entry("E", &aliases, "100 from 360 nm to 830 nm, the range of the colour-matching functions", density)
    });
    [a].into_iter().chain(e).collect()
}

/// One entry a column.
fn entries_of(text: &TableText) -> Vec<Entry> {
    let value = |key: &str| text.header_value(key).unwrap_or_default().to_owned();
    let list =
        |key: &str| -> Vec<String> { value(key).split(';').map(|item| item.trim().to_owned()).filter(|item| !item.is_empty()).collect() };
    let (names, column_aliases) = ([vec![value("name")], list("aliases")].concat(), list("column_aliases"));
    let outside = if value("outside") == "hold" { Outside::Hold } else { Outside::Zero };
    let mut entries = Vec::new();
    for (index, values) in text.columns.iter().enumerate() {
        let mut names = names.clone();
        if text.columns.len() > 1 {
            let column = text.column_names.get(index).cloned().unwrap_or_default();
            names.iter_mut().for_each(|name| *name = format!("{name} {column}"));
            names.extend(column_aliases.get(index).cloned());
        }
        let Ok(table) = Table::new(text.wavelengths_nm.clone(), values.clone(), outside) else {
            continue;
        };
        let curve = match value("kind").as_str() {
            "factor" => Some(Curve::Factor(Factor::Table(table))),
            "density" => Density::table(table).ok().map(Curve::Density),
            _ => None,
        };
        let Some(curve) = curve else { continue };
        entries.push(Entry {
            name: names.remove(0),
            aliases: names,
            quantity: value("quantity"),
            unit: value("unit"),
            source: value("source"),
            licence: value("licence"),
            curve,
        });
    }
    entries
}

/// What is compared: letters and digits, in lower case. Primes and Greek lambda keep their meaning: V′ is not V.
pub(super) fn key(name: &str) -> String {
    let mut key = String::new();
    for character in name.chars() {
        match character {
            'λ' => key.push_str("lambda"),
            '\'' | '′' | '’' => key.push_str("prime"),
            '\u{304}' => key.push_str("bar"),
            'ȳ' => key.push_str("ybar"),
            _ => key.extend(character.to_lowercase().filter(|letter| letter.is_alphanumeric())),
        }
    }
    key
}

/// The entry of this name. Errors with the nearest names if there is none.
pub fn entry(name: &str) -> Result<&'static Entry, LookupError> {
    let wanted = key(name);
    let names = |entry: &'static Entry| std::iter::once(&entry.name).chain(&entry.aliases);
    if let Some(found) = entries().iter().find(|entry| names(entry).any(|name| key(name) == wanted)) {
        return Ok(found);
    }
    let mut ranked: Vec<(usize, &String)> =
        entries().iter().flat_map(names).map(|name| (edit_distance(&wanted, &key(name)), name)).collect();
    ranked.sort();
    let nearest = ranked.into_iter().take(3).map(|(_, name)| name.clone()).collect();
    Err(LookupError::Unknown { name: name.chars().take(80).collect(), nearest })
}

/// The factor of this name. Errors if there is none or it is a density.
pub fn factor(name: &str) -> Result<Factor, LookupError> {
    let entry = entry(name)?;
    match &entry.curve {
        Curve::Factor(factor) => Ok(factor.clone()),
        other => Err(other_kind(entry, other, "factor (reflectance, responsivity, weighting function)")),
    }
}

/// The density of this name. Errors if there is none or it is a factor.
pub fn density(name: &str) -> Result<Density, LookupError> {
    let entry = entry(name)?;
    match &entry.curve {
        Curve::Density(density) => Ok(density.clone()),
        other => Err(other_kind(entry, other, "spectral distribution")),
    }
}

fn other_kind(entry: &Entry, curve: &Curve, wanted: &'static str) -> LookupError {
    LookupError::OtherKind { name: entry.name.clone(), found: curve.kind(), wanted }
}

/// V(λ), CIE 1924, 1 nm, 360–830 nm. NaN everywhere if the embedded table could not be read, which the tests exclude.
pub fn v_lambda() -> Factor {
    factor("V(lambda)").unwrap_or(Factor::Constant(f64::NAN))
}

/// Levenshtein's distance in characters; long names are cut, so the work is bounded.
fn edit_distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().take(80).collect(), b.chars().take(80).collect());
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.iter().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, to) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(from != to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}
