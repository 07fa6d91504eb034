//! The embedded files: headers to entries, columns to curves.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use super::{Curve, Entry, Group, Kind, Place, key};
use crate::spectrum::table_text::{TextRules, parse};
use crate::spectrum::{Density, Factor, Outside, Table};

/// How many files there are.
const COUNT: usize = 32;

/// The files, as text.
pub(in crate::spectrum) const FILES: [&str; COUNT] = [
    include_str!("../../../data/v_lambda_1nm.csv"),
    include_str!("../../../data/v_prime_1nm.csv"),
    include_str!("../../../data/v_judd_vos_1nm.csv"),
    include_str!("../../../data/v_10_1nm.csv"),
    include_str!("../../../data/v_f_1nm.csv"),
    include_str!("../../../data/xyz_1931_1nm.csv"),
    include_str!("../../../data/xyz_1964_1nm.csv"),
    include_str!("../../../data/xyz_2015_2deg_1nm.csv"),
    include_str!("../../../data/xyz_2015_10deg_1nm.csv"),
    include_str!("../../../data/cones_2deg_1nm.csv"),
    include_str!("../../../data/cones_10deg_1nm.csv"),
    include_str!("../../../data/cones_smith_pokorny_5nm.csv"),
    include_str!("../../../data/rgb_wright_guild_5nm.csv"),
    include_str!("../../../data/rgb_stiles_burch_1955_5nm.csv"),
    include_str!("../../../data/rgb_stiles_burch_1959_5nm.csv"),
    include_str!("../../../data/s026_1nm.csv"),
    include_str!("../../../data/b_5nm.csv"),
    include_str!("../../../data/c_5nm.csv"),
    include_str!("../../../data/daylight_5nm.csv"),
    include_str!("../../../data/indoor_daylight_5nm.csv"),
    include_str!("../../../data/fluorescent_5nm.csv"),
    include_str!("../../../data/fluorescent_3_5nm.csv"),
    include_str!("../../../data/high_pressure_5nm.csv"),
    include_str!("../../../data/led_5nm.csv"),
    include_str!("../../../data/astm_g173.csv"),
    include_str!("../../../data/colorchecker_babel_10nm.csv"),
    include_str!("../../../data/colorchecker_ohta_5nm.csv"),
    include_str!("../../../data/camera_nikon_5100_5nm.csv"),
    include_str!("../../../data/camera_sigma_sdmerill_10nm.csv"),
    include_str!("../../../data/camera_components_10nm.csv"),
    include_str!("../../../data/cie170_components_5nm.csv"),
    include_str!("../../../data/d_series_basis_5nm.csv"),
];

/// The header of a file, read without its rows.
struct Header {
    values: BTreeMap<&'static str, &'static str>,
    /// Names of the value columns.
    columns: Vec<&'static str>,
}

impl Header {
    fn of(text: &'static str) -> Self {
        let mut header = Self { values: BTreeMap::new(), columns: Vec::new() };
        for line in text.lines() {
            match line.strip_prefix('#') {
                Some(comment) => header.values.extend(comment.split_once(':').map(|(key, value)| (key.trim(), value.trim()))),
                None => {
                    header.columns = line.split(',').skip(1).map(str::trim).collect();
                    break;
                }
            }
        }
        header
    }

    fn value(&self, key: &str) -> &'static str {
        self.values.get(key).copied().unwrap_or_default()
    }

    /// The parts of a value between semicolons.
    fn list(&self, key: &str) -> Vec<&'static str> {
        self.value(key).split(';').map(str::trim).filter(|item| !item.is_empty()).collect()
    }

    /// Official name of the file and its other names.
    fn names(&self) -> Vec<&'static str> {
        [vec![self.value("name")], self.list("aliases")].concat()
    }

    /// Whether the columns are entries under their own names, and not parts of one thing.
    fn is_series(&self) -> bool {
        self.value("column_names_are") == "entries"
    }

    fn group(&self) -> Option<Group> {
        Group::ALL.into_iter().find(|group| group.word() == self.value("group"))
    }

    fn kind(&self) -> Option<Kind> {
        match self.value("kind") {
            "factor" => Some(Kind::Factor),
            "density" => Some(Kind::Density),
            _ => None,
        }
    }

    fn range_nm(&self) -> Option<(f64, f64)> {
        let (from, to) = self.value("range").split_once('-')?;
        Some((from.parse().ok()?, to.parse().ok()?))
    }

    /// All names of a column as an entry: the official one, its own short ones, then those it has from the file.
    fn names_of(&self, column: usize) -> Vec<String> {
        let Some(own) = self.columns.get(column) else { return Vec::new() };
        let mut whole = self.names().into_iter();
        if self.columns.len() < 2 {
            return whole.map(str::to_owned).collect();
        }
        let aliases = self.list("column_aliases").get(column).copied().unwrap_or_default();
        let short = aliases.split('|').map(|alias| alias.trim().to_owned()).filter(|alias| !alias.is_empty());
        if self.is_series() {
            return std::iter::once((*own).to_owned()).chain(short).collect();
        }
        let long = |name: &str| format!("{name} {own}");
        let official = long(whole.next().unwrap_or_default());
        std::iter::once(official).chain(short).chain(whole.map(long)).collect()
    }

    /// The entry of a column. `None` if the header is not complete, which the tests exclude.
    fn entry(&self, file: usize, column: usize) -> Option<Entry> {
        let several = self.columns.len() > 1;
        let mut names = self.names_of(column).into_iter();
        let quantity = self.list("column_quantities").get(column).copied().unwrap_or(self.value("quantity"));
        Some(Entry {
            name: names.next()?,
            aliases: names.collect(),
            group: self.group()?,
            kind: self.kind()?,
            set: several.then(|| self.value("name").to_owned()),
            column: if several { (*self.columns.get(column)?).to_owned() } else { String::new() },
            quantity: quantity.to_owned(),
            unit: self.value("unit").to_owned(),
            range_nm: self.range_nm()?,
            step_nm: self.value("step").parse().ok(),
            source: self.value("source").to_owned(),
            licence: self.value("licence").to_owned(),
            place: Place::File(file, column),
        })
    }
}

/// The headers of all files.
fn headers() -> impl Iterator<Item = Header> {
    FILES.into_iter().map(Header::of)
}

/// One entry a column, in the order of the files.
pub(super) fn entries() -> Vec<Entry> {
    let of_file = |(file, header): (usize, Header)| -> Vec<Entry> {
        (0..header.columns.len()).filter_map(|column| header.entry(file, column)).collect()
    };
    headers().enumerate().flat_map(of_file).collect()
}

/// Keys of the names of files with several columns; the columns as indices of [`entries`].
pub(super) fn set_names() -> BTreeMap<String, Vec<usize>> {
    let mut sets = BTreeMap::new();
    let mut first = 0;
    for header in headers() {
        let next = first + header.columns.len();
        if header.columns.len() > 1 {
            for name in header.names() {
                sets.insert(key(name), (first..next).collect());
            }
        }
        first = next;
    }
    sets
}

/// The curves of a file, one a column, read once. `None` for a column that is not what its header says, which the tests exclude.
pub(super) fn curves_of(file: usize) -> &'static [Option<Curve>] {
    static CURVES: [OnceLock<Vec<Option<Curve>>>; COUNT] = [const { OnceLock::new() }; COUNT];
    match (CURVES.get(file), FILES.get(file)) {
        (Some(curves), Some(text)) => curves.get_or_init(|| read(text)),
        _ => &[],
    }
}

fn read(text: &'static str) -> Vec<Option<Curve>> {
    let header = Header::of(text);
    let outside = if header.value("outside") == "hold" { Outside::Hold } else { Outside::Zero };
    // Negative values are allowed because factors may have them; a density with one is refused by its constructor.
    let rules = TextRules { negative_values: true, ..TextRules::default() };
    let Ok(rows) = parse(text, &rules) else { return Vec::new() };
    let curve = |values: Vec<f64>| {
        let table = Table::new(rows.wavelengths_nm.clone(), values, outside).ok()?;
        match header.kind()? {
            Kind::Factor => Some(Curve::Factor(Factor::Table(table))),
            Kind::Density => Density::table(table).ok().map(Curve::Density),
        }
    };
    rows.columns.iter().cloned().map(curve).collect()
}
