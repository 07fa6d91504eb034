//! The text of a table of readings, as instruments write it: a preamble, a head, rows.
//!
//! | what instruments write | how it is read |
//! |---|---|
//! | a byte order mark, `\r\n`, empty lines, lines that begin with `#`, `%` or `//` | left out |
//! | lines about the instrument before the head | left out: the head is the first line with a column for the exposure or its wavelength |
//! | `;`, a tab or `,` between columns; one more at the end of each line | the head decides |
//! | a second line of the head with units in brackets and nothing else | belongs to the head |
//! | decimal commas, where no comma separates columns | as numbers, if they cannot be separators of thousands |

use crate::spectrum::decimal_comma;

/// A cell, and the column of its first character.
pub(super) struct Cell {
    pub(super) text: String,
    pub(super) column: usize,
}

/// A line, from 1, and its cells.
pub(super) struct Row<'t> {
    pub(super) number: usize,
    pub(super) text: &'t str,
    pub(super) cells: Vec<Cell>,
}

/// A table: its head, its rows, and whether commas in numbers are decimal ones.
pub(super) struct Readable<'t> {
    pub(super) head: Row<'t>,
    pub(super) rows: Vec<Row<'t>>,
    pub(super) decimal_comma: bool,
    /// Commas that may be either: line, column, message, help.
    pub(super) unclear: Option<(usize, usize, String, String)>,
}

impl Readable<'_> {
    /// The number that a cell holds.
    pub(super) fn number(&self, cell: &Cell) -> Option<f64> {
        if self.decimal_comma { cell.text.replace(',', ".").parse().ok() } else { cell.text.parse().ok() }
    }
}

/// Finds head and rows; `is_exposure` tells the title of the column that says which exposure a row belongs to. `None` if nothing is there.
pub(super) fn readable(text: &str, is_exposure: impl Fn(&str) -> bool) -> Option<Readable<'_>> {
    let comment = |line: &str| ["#", "%", "//"].iter().any(|mark| line.starts_with(mark));
    let lines: Vec<(usize, &str)> = text
        .lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line.trim_start_matches('\u{feff}')))
        .filter(|(_, line)| !line.trim().is_empty() && !comment(line))
        .collect();
    let separator_of = |line: &str| [';', '\t'].into_iter().find(|c| line.contains(*c)).unwrap_or(',');
    let is_head = |line: &str| {
        let cells = cells(line, separator_of(line));
        cells.len() > 1 && cells.iter().any(|cell| is_exposure(&cell.text))
    };
    let at = lines.iter().position(|(_, line)| is_head(line)).unwrap_or(0);
    let &(number, line) = lines.get(at)?;
    let separator = separator_of(line);
    let mut head = Row { number, text: line, cells: cells(line, separator) };
    while head.cells.len() > 1 && head.cells.last().is_some_and(|cell| cell.text.is_empty()) {
        head.cells.pop();
    }
    let width = head.cells.len();
    let mut rows: Vec<Row> = lines[at + 1..]
        .iter()
        .map(|&(number, text)| {
            let mut cells = cells(text, separator);
            while cells.len() > width && cells.last().is_some_and(|cell| cell.text.is_empty()) {
                cells.pop();
            }
            Row { number, text, cells }
        })
        .collect();
    if rows.first().is_some_and(|row| row.cells.len() == width && holds_units(row)) {
        let units = rows.remove(0);
        for (title, unit) in head.cells.iter_mut().zip(units.cells).filter(|(_, unit)| !unit.text.is_empty()) {
            title.text = format!("{} {}", title.text, unit.text);
        }
    }
    let decided = text.lines().any(|line| line.trim() == "# decimal: comma");
    // Beside numbers with points a comma is a mistake, told where it stands.
    let points = rows.iter().flat_map(|row| &row.cells).any(|cell| cell.text.contains('.') && cell.text.parse::<f64>().is_ok());
    let unclear = match separator {
        ',' => None,
        _ if points => None,
        _ if decided => None,
        _ => {
            // Lines before the table are no numbers of it; they keep their count.
            let table: Vec<&str> = text.lines().enumerate().map(|(i, line)| if i < number { "" } else { line }).collect();
            decimal_comma::unclear(&table.join("\n"), separator)
        }
    };
    Some(Readable { head, rows, decimal_comma: separator != ',' && !points && unclear.is_none(), unclear })
}

/// Whether a row has units in brackets and nothing else.
fn holds_units(row: &Row) -> bool {
    let unit = |text: &str| (text.starts_with('[') && text.ends_with(']')) || (text.starts_with('(') && text.ends_with(')'));
    row.cells.iter().all(|cell| cell.text.is_empty() || unit(&cell.text)) && row.cells.iter().any(|cell| !cell.text.is_empty())
}

/// A title and the unit behind it: `E_v (lx)`, `E_v [lx]`, `E_v / lx`, `E_v in lx`.
pub(super) fn title_and_unit(text: &str) -> (&str, Option<&str>) {
    for (open, close) in [('(', ')'), ('[', ']')] {
        if let Some((title, unit)) = text.strip_suffix(close).and_then(|inner| inner.rsplit_once(open)) {
            // `u(E_v)` is a title.
            if title.trim() != "u" {
                return (title.trim(), Some(unit.trim()));
            }
        }
    }
    for between in [" / ", " in "] {
        if let Some((title, unit)) = text.split_once(between) {
            return (title.trim(), Some(unit.trim()));
        }
    }
    (text, None)
}

/// Cells of a line; quotes hold separators.
fn cells(line: &str, separator: char) -> Vec<Cell> {
    let mut cells = vec![Cell { text: String::new(), column: 1 }];
    let mut quoted = false;
    for (i, c) in line.chars().enumerate() {
        match c {
            '"' => quoted = !quoted,
            c if c == separator && !quoted => cells.push(Cell { text: String::new(), column: i + 2 }),
            c => {
                if let Some(cell) = cells.last_mut() {
                    cell.text.push(c);
                }
            }
        }
    }
    for cell in &mut cells {
        cell.column += cell.text.chars().take_while(|c| c.is_whitespace()).count();
        cell.text = cell.text.trim().to_owned();
    }
    cells
}
