//! `etendue list [GROUP]`: the curves of the library and the sensor files at hand, by name.

use clap::ValueEnum;
use etendue::spectrum::library::{Entry, Group, entries_in};

use crate::{Failure, disk, print};

/// The curves of the library and the sensor files at hand, by name.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// What to list; all groups with their numbers if not given.
    #[arg(value_enum)]
    group: Option<Listed>,
    /// How to write the list.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Listed {
    /// Luminous efficiencies, colour-matching functions, cone fundamentals, action spectra.
    #[value(alias = "observer")]
    Observers,
    /// Spectral distributions of lamps, daylight and the sun.
    #[value(alias = "illuminant")]
    Illuminants,
    /// Reflectances of colour charts.
    #[value(alias = "reflectance")]
    Reflectances,
    /// Spectral responsivities of cameras.
    #[value(alias = "responsivity")]
    Responsivities,
    /// Parts from which observers and illuminants are computed.
    #[value(alias = "component")]
    Components,
    /// Sensor files of the folder `sensors` here or above.
    #[value(alias = "sensor")]
    Sensors,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// A table for a person.
    Text,
    /// Everything, for programs.
    Json,
    /// A row an entry.
    Csv,
}

impl Listed {
    fn name(self) -> String {
        self.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
    }

    fn help(self) -> String {
        self.to_possible_value().and_then(|value| value.get_help().map(ToString::to_string)).unwrap_or_default()
    }

    /// The group of the library; sensors are files and in none.
    fn group(self) -> Option<Group> {
        match self {
            Self::Observers => Some(Group::Observer),
            Self::Illuminants => Some(Group::Illuminant),
            Self::Reflectances => Some(Group::Reflectance),
            Self::Responsivities => Some(Group::Responsivity),
            Self::Components => Some(Group::Component),
            Self::Sensors => None,
        }
    }
}

/// Columns and rows of text; a number is text that JSON leaves without quotes.
struct Table {
    columns: Vec<&'static str>,
    rows: Vec<Vec<Cell>>,
}

enum Cell {
    Text(String),
    Number(f64),
    List(Vec<String>),
    Nothing,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let text = matches!(arguments.format, Format::Text);
    let table = match arguments.group {
        None => overview(),
        Some(listed) => match listed.group() {
            Some(group) if text => short(group),
            Some(group) => complete(group),
            None => sensors()?,
        },
    };
    print(&match arguments.format {
        Format::Text => table.to_text(),
        Format::Json => table.to_json(),
        Format::Csv => table.to_csv(),
    })
}

/// All groups with the number of their members.
fn overview() -> Table {
    let row = |listed: &Listed| {
        let count = match listed.group() {
            Some(group) => entries_in(group).count(),
            None => sensor_files().map_or(0, |files| files.len()),
        };
        vec![Cell::Text(listed.name()), Cell::Number(count as f64), Cell::Text(listed.help())]
    };
    Table { columns: vec!["group", "entries", "what"], rows: Listed::value_variants().iter().map(row).collect() }
}

/// What a person looks for: a name to type, what it is, where it ends.
fn short(group: Group) -> Table {
    let row = |entry: &'static Entry| {
        let (from_nm, to_nm) = entry.range_nm;
        let step = entry.step_nm.map_or_else(String::new, |step| format!(", {step}"));
        let also = entry.aliases.first().cloned().unwrap_or_default();
        let source = entry.source.split(';').next().unwrap_or_default();
        let texts = [entry.name.clone(), also, entry.quantity.clone(), format!("{from_nm}-{to_nm}{step}"), entry.unit.clone()];
        texts.into_iter().chain([source.to_owned()]).map(Cell::Text).collect()
    };
    let columns = vec!["name", "also", "what", "range, step in nm", "unit", "source"];
    Table { columns, rows: entries_in(group).map(row).collect() }
}

/// Everything that the library says of an entry.
fn complete(group: Group) -> Table {
    let text = |text: &str| Cell::Text(text.to_owned());
    let row = |entry: &'static Entry| {
        vec![
            text(&entry.name),
            Cell::List(entry.aliases.clone()),
            text(group.word()),
            entry.set.as_deref().map_or(Cell::Nothing, text),
            text(&entry.quantity),
            text(&entry.unit),
            Cell::Number(entry.range_nm.0),
            Cell::Number(entry.range_nm.1),
            entry.step_nm.map_or(Cell::Nothing, Cell::Number),
            text(&entry.source),
            text(&entry.licence),
        ]
    };
    let columns = vec!["name", "aliases", "group", "set", "quantity", "unit", "from_nm", "to_nm", "step_nm", "source", "licence"];
    Table { columns, rows: entries_in(group).map(row).collect() }
}

/// Path and text of the sensor files; `None` if there is no folder of them.
fn sensor_files() -> Option<Vec<(String, String)>> {
    Some(disk::shelf("sensors")?.into_iter().filter(|(path, _)| path.ends_with(".ron")).collect())
}

/// The sensor files with the first lines of their headers.
fn sensors() -> Result<Table, Failure> {
    let files = sensor_files().ok_or_else(|| {
        Failure::Input("error: no folder `sensors` here or above\n  = help: go to the folder that holds `scenes` and `sensors`".to_owned())
    })?;
    let row = |(path, text): (String, String)| {
        let title = text.lines().next().unwrap_or_default().trim_start_matches(['/', ' ']).to_owned();
        vec![Cell::Text(path), Cell::Text(title)]
    };
    Ok(Table { columns: vec!["file", "what"], rows: files.into_iter().map(row).collect() })
}

impl Cell {
    /// One line for a person or a cell of a CSV file.
    fn plain(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(number) => number.to_string(),
            Self::List(texts) => texts.join("; "),
            Self::Nothing => String::new(),
        }
    }

    fn json(&self) -> String {
        match self {
            Self::Text(text) => quoted(text),
            Self::Number(number) => number.to_string(),
            Self::List(texts) => format!("[{}]", texts.iter().map(|text| quoted(text)).collect::<Vec<_>>().join(", ")),
            Self::Nothing => "null".to_owned(),
        }
    }
}

/// A JSON string.
fn quoted(text: &str) -> String {
    let mut quoted = String::from('"');
    for character in text.chars() {
        match character {
            '"' | '\\' => quoted.extend(['\\', character]),
            control if control < ' ' => quoted.push_str(&format!("\\u{:04x}", u32::from(control))),
            other => quoted.push(other),
        }
    }
    quoted.push('"');
    quoted
}

impl Table {
    /// Columns as wide as their longest cell; the last one ends where it ends. Numbers stand to the right.
    fn to_text(&self) -> String {
        let header = self.columns.iter().map(|name| (*name).to_owned()).collect();
        let cells = self.rows.iter().map(|row| row.iter().map(Cell::plain).collect());
        let lines: Vec<Vec<String>> = std::iter::once(header).chain(cells).collect();
        let width = |column: usize| lines.iter().filter_map(|line| line.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..self.columns.len()).map(width).collect();
        let is_number = |column: usize| self.rows.iter().all(|row| matches!(row.get(column), Some(Cell::Number(_))));
        let mut text = String::new();
        for line in &lines {
            let cell = |(column, cell): (usize, &String)| {
                let width = widths.get(column).copied().unwrap_or(0);
                if is_number(column) { format!("{cell:>width$}") } else { format!("{cell:<width$}") }
            };
            let joined = line.iter().enumerate().map(cell).collect::<Vec<_>>().join("  ");
            text.push_str(joined.trim_end());
            text.push('\n');
        }
        text
    }

    /// A list of objects, one a row.
    fn to_json(&self) -> String {
        let object = |row: &Vec<Cell>| {
            let fields = self.columns.iter().zip(row).map(|(name, cell)| format!("{}: {}", quoted(name), cell.json()));
            format!("  {{{}}}", fields.collect::<Vec<_>>().join(", "))
        };
        format!("[\n{}\n]\n", self.rows.iter().map(object).collect::<Vec<_>>().join(",\n"))
    }

    /// A header row, then a row each.
    fn to_csv(&self) -> String {
        let cell = |cell: String| if cell.contains([',', '"', '\n']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell };
        let mut text = format!("{}\n", self.columns.join(","));
        for row in &self.rows {
            text.push_str(&row.iter().map(|value| cell(value.plain())).collect::<Vec<_>>().join(","));
            text.push('\n');
        }
        text
    }
}
