//! The tables that come with the library, by name.
//!
//! A name is compared without case, blanks and separators: `LED-B3`, `led b3` and `ledb3` are one, and so are `2°`, `2 degree` and
//! `2 deg`. Primes and Greek letters keep their meaning: `V'` is not `V`. A file with several columns holds one entry a column, called
//! by the name of the file and that of the column (`ColorChecker dark skin`) or, in a series, by the column alone (`FL11`). The name of
//! the file alone names all its columns ([`set`]); where one curve is wanted that is an error that lists them.
//!
//! | file | what |
//! |---|---|
//! | `library/files.rs` | the embedded files: headers at the first question, rows of a file when one of its curves is asked for |
//! | `library/names.rs` | what is compared of a name, and which names are near |
//!
//! The tables and their pedigrees are listed in `data/README.md`.

mod files;
mod names;

use std::collections::BTreeMap;
use std::sync::OnceLock;

use super::{Density, Factor};
#[cfg(test)]
pub(super) use files::FILES;
pub(super) use names::key;

/// What an entry of the library is.
#[derive(Debug, Clone, PartialEq)]
pub enum Curve {
    /// A reflectance, a responsivity, a weighting function.
    Factor(Factor),
    /// A spectral distribution; relative unless the unit of its entry says otherwise.
    Density(Density),
}

/// Whether an entry multiplies or is multiplied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A reflectance, a responsivity, a weighting function.
    Factor,
    /// A spectral distribution.
    Density,
}

impl Kind {
    fn in_words(self) -> &'static str {
        match self {
            Self::Factor => "factor (reflectance, responsivity, weighting function)",
            Self::Density => "spectral distribution",
        }
    }
}

/// What an entry is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Group {
    /// Luminous efficiencies, colour-matching functions, cone fundamentals, action spectra.
    Observer,
    /// Spectral distributions of light.
    Illuminant,
    /// Spectral reflectance factors.
    Reflectance,
    /// Spectral responsivities of devices.
    Responsivity,
    /// Parts from which observers and illuminants are computed.
    Component,
}

impl Group {
    /// All groups.
    pub const ALL: [Self; 5] = [Self::Observer, Self::Illuminant, Self::Reflectance, Self::Responsivity, Self::Component];

    /// The word for the group in the header of a table.
    pub fn word(self) -> &'static str {
        match self {
            Self::Observer => "observer",
            Self::Illuminant => "illuminant",
            Self::Reflectance => "reflectance",
            Self::Responsivity => "responsivity",
            Self::Component => "component",
        }
    }
}

/// The unit of a density of which only the shape is meant.
pub const RELATIVE: &str = "1/nm (relative)";

/// A curve with its names and its pedigree. The curve itself is read when [`Entry::curve`] asks for it.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Official name.
    pub name: String,
    /// Other names.
    pub aliases: Vec<String>,
    /// What it is for.
    pub group: Group,
    /// Factor or density.
    pub kind: Kind,
    /// Official name of the set of which it is one column; `None` if it stands alone.
    pub set: Option<String>,
    /// Name of its column in the set; empty if it stands alone.
    pub column: String,
    /// What it is, in words.
    pub quantity: String,
    /// Unit of its values; [`RELATIVE`] if only the shape is meant.
    pub unit: String,
    /// First and last wavelength, nm.
    pub range_nm: (f64, f64),
    /// Distance of the rows, nm; `None` if it is not the same everywhere or there are no rows.
    pub step_nm: Option<f64>,
    /// Where the numbers come from.
    pub source: String,
    /// Under which licence.
    pub licence: String,
    place: Place,
}

/// Where the curve of an entry is.
#[derive(Debug, Clone, PartialEq)]
enum Place {
    /// It has no table.
    Formula(Curve),
    /// A column of one of the files, both counted from 0.
    File(usize, usize),
}

impl Entry {
    /// The function of wavelength. Errors if its file is damaged, which the tests of the library exclude.
    pub fn curve(&self) -> Result<&Curve, LookupError> {
        let curve = match &self.place {
            Place::Formula(curve) => Some(curve),
            Place::File(file, column) => files::curves_of(*file).get(*column).and_then(Option::as_ref),
        };
        curve.ok_or_else(|| LookupError::Unreadable { name: self.name.clone() })
    }

    /// Whether the values of a density are in physical units, so that they may be used as they are; no for relative shapes and factors.
    pub fn is_absolute(&self) -> bool {
        self.kind == Kind::Density && self.unit != RELATIVE
    }

    /// Official name and aliases.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        std::iter::once(&self.name).chain(&self.aliases).map(String::as_str)
    }
}

/// A name that is not the name of one curve of the wanted kind.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LookupError {
    /// No entry of this name.
    #[error("the library has no `{name}`; nearest names: {}", nearest.join(", "))]
    Unknown {
        /// What was asked for.
        name: String,
        /// Official names and aliases that are closest, best first; of the wanted kind if a kind was wanted.
        nearest: Vec<String>,
    },
    /// The name of several entries.
    #[error("`{name}` names several curves; say which: {}", listed(candidates))]
    Ambiguous {
        /// What was asked for.
        name: String,
        /// Official names of all that it may mean.
        candidates: Vec<String>,
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
    /// The table of this entry is damaged.
    #[error("the table of `{name}` in this build of the library cannot be read")]
    Unreadable {
        /// Official name of the entry.
        name: String,
    },
}

/// The first few of many names.
fn listed(names: &[String]) -> String {
    const SHOWN: usize = 8;
    let more = names.len().saturating_sub(SHOWN);
    let shown = names[..names.len() - more].join(", ");
    if more > 0 { format!("{shown} and {more} more") } else { shown }
}

/// All entries, in the order of the files; the two illuminants by formula come first.
pub fn entries() -> &'static [Entry] {
    static ENTRIES: OnceLock<Vec<Entry>> = OnceLock::new();
    ENTRIES.get_or_init(|| formulas().into_iter().chain(files::entries()).collect())
}

/// The entries of one group, in their order.
pub fn entries_in(group: Group) -> impl Iterator<Item = &'static Entry> {
    entries().iter().filter(move |entry| entry.group == group)
}

/// Illuminants A and E, which need no table.
fn formulas() -> Vec<Entry> {
    let entry = |name: &str, aliases: &[&str], source: &str, range_nm, density| Entry {
        name: name.to_owned(),
        aliases: aliases.iter().map(|alias| (*alias).to_owned()).collect(),
        group: Group::Illuminant,
        kind: Kind::Density,
        set: None,
        column: String::new(),
        quantity: "relative spectral distribution".to_owned(),
        unit: RELATIVE.to_owned(),
        range_nm,
        step_nm: None,
        source: source.to_owned(),
        licence: "a formula".to_owned(),
        place: Place::Formula(Curve::Density(density)),
    };
    let a = entry(
        "A",
        &["incandescent", "tungsten", "CIE illuminant A"],
        "CIE 015:2018, formula of illuminant A, 300-830 nm",
        super::black_body::ILLUMINANT_A_RANGE_NM,
        Density::illuminant_a(),
    );
    let equal_energy = Density::flat(360.0, 830.0, 100.0).ok();
    let e = equal_energy.map(|density| {
        let source = "100 from 360 nm to 830 nm, the range of the colour-matching functions";
        entry("E", &["equal energy", "CIE illuminant E"], source, (360.0, 830.0), density)
    });
    [a].into_iter().chain(e).collect()
}

/// What the keys of names stand for, as indices of [`entries`].
struct Index {
    /// Official names and aliases.
    names: BTreeMap<String, Vec<usize>>,
    /// Names of sets, each with its columns.
    sets: BTreeMap<String, Vec<usize>>,
    /// Names of columns without their set.
    columns: BTreeMap<String, Vec<usize>>,
}

fn index() -> &'static Index {
    static INDEX: OnceLock<Index> = OnceLock::new();
    INDEX.get_or_init(|| {
        let mut index = Index { names: BTreeMap::new(), sets: files::set_names(), columns: BTreeMap::new() };
        let add = |map: &mut BTreeMap<String, Vec<usize>>, name: &str, at: usize| {
            let found = map.entry(key(name)).or_default();
            if !found.contains(&at) {
                found.push(at);
            }
        };
        // The files count their entries from 0; the formulas stand before them.
        let before = formulas().len();
        index.sets.values_mut().flatten().for_each(|at| *at += before);
        for (at, entry) in entries().iter().enumerate() {
            entry.names().for_each(|name| add(&mut index.names, name, at));
            if !entry.column.is_empty() {
                add(&mut index.columns, &entry.column, at);
            }
        }
        index
    })
}

/// What may stand before the name of an illuminant.
const ILLUMINANT_PREFIXES: [&str; 5] = ["ciestandardilluminant", "standardilluminant", "cieilluminant", "illuminant", "cie"];

/// All entries that a name may mean, the closest reading first: a name, an illuminant with its title, a set, a column.
fn meant(name: &str) -> Vec<&'static Entry> {
    let wanted = key(name);
    let (index, all) = (index(), entries());
    let found = |map: &BTreeMap<String, Vec<usize>>, key: &str| -> Vec<&'static Entry> {
        map.get(key).into_iter().flatten().filter_map(|at| all.get(*at)).collect()
    };
    let titled = || {
        let rest = ILLUMINANT_PREFIXES.iter().find_map(|prefix| wanted.strip_prefix(prefix)).unwrap_or_default();
        let mut found = found(&index.names, rest);
        found.retain(|entry| entry.group == Group::Illuminant);
        found
    };
    let mut meant = found(&index.names, &wanted);
    if meant.is_empty() {
        meant = titled();
    }
    if meant.is_empty() {
        meant = found(&index.sets, &wanted);
    }
    if meant.is_empty() {
        meant = found(&index.columns, &wanted);
    }
    meant
}

/// The entry of this name. Errors with the nearest names if there is none, and with all candidates if there are several.
pub fn entry(name: &str) -> Result<&'static Entry, LookupError> {
    lookup(name, None)
}

fn lookup(name: &str, wanted: Option<Kind>) -> Result<&'static Entry, LookupError> {
    let found = meant(name);
    match found[..] {
        [] => Err(unknown(name, wanted)),
        [entry] => match wanted {
            Some(kind) if kind != entry.kind => {
                Err(LookupError::OtherKind { name: entry.name.clone(), found: entry.kind.in_words(), wanted: kind.in_words() })
            }
            _ => Ok(entry),
        },
        _ => Err(LookupError::Ambiguous { name: cut(name), candidates: found.iter().map(|entry| entry.name.clone()).collect() }),
    }
}

fn unknown(name: &str, wanted: Option<Kind>) -> LookupError {
    let entries = entries().iter().filter(|entry| wanted.is_none_or(|kind| kind == entry.kind));
    LookupError::Unknown { name: cut(name), nearest: names::nearest(name, entries) }
}

/// A name as it is repeated in a message.
fn cut(name: &str) -> String {
    name.chars().take(80).collect()
}

/// The columns of a set (`CIE 1931`, `ColorChecker`, `CIE FL series`), or the one entry of this name. Errors if there is neither.
pub fn set(name: &str) -> Result<Vec<&'static Entry>, LookupError> {
    let (index, all) = (index(), entries());
    match index.sets.get(&key(name)) {
        Some(columns) => Ok(columns.iter().filter_map(|at| all.get(*at)).collect()),
        None => entry(name).map(|entry| vec![entry]),
    }
}

/// The factor of this name. Errors if there is none or it is a density, see [`LookupError`].
pub fn factor(name: &str) -> Result<Factor, LookupError> {
    let entry = lookup(name, Some(Kind::Factor))?;
    match entry.curve()? {
        Curve::Factor(factor) => Ok(factor.clone()),
        Curve::Density(_) => Err(LookupError::Unreadable { name: entry.name.clone() }),
    }
}

/// The density of this name. Errors if there is none or it is a factor, see [`LookupError`].
pub fn density(name: &str) -> Result<Density, LookupError> {
    let entry = lookup(name, Some(Kind::Density))?;
    match entry.curve()? {
        Curve::Density(density) => Ok(density.clone()),
        Curve::Factor(_) => Err(LookupError::Unreadable { name: entry.name.clone() }),
    }
}

/// V(λ), CIE 1924, 1 nm, 360–830 nm. NaN everywhere if the embedded table could not be read, which the tests exclude.
pub fn v_lambda() -> Factor {
    factor("V(lambda)").unwrap_or(Factor::Constant(f64::NAN))
}
