//! Readings of a laboratory: a CSV file, as an instrument writes it, for the exposures of a calibration.
//!
//! ```text
//! # any number of lines that begin with #
//! exposure,E_v (lx),u(E_v) (lx)
//! 380 nm,0.0123,0.0004
//! 385 nm,0.0161,0.0004
//! ```
//!
//! | column | meaning |
//! |---|---|
//! | `exposure` | the label of an exposure of the calibration file |
//! | `E_v (lx)` | readings of the channel `E_v`, their unit in brackets: that of what the channel reads |
//! | `u(E_v) (lx)` | their standard uncertainties (k = 1), above zero |
//!
//! Columns and rows come in any order; a semicolon or a tab may separate them. Each exposure has exactly one row, each channel both columns. Every problem is
//! told with its line and column.

use super::campaign::ChannelReadings;
use crate::naming::suggestion;
use crate::scene::{Calibration, Diagnostic, Diagnostics};

/// Problems that are told at most.
const MOST_TOLD: usize = 50;

/// Largest reading and uncertainty that are taken for ones: their squares are numbers.
const LARGEST: f64 = 1e90;

/// A cell, and the column of its first character.
struct Cell {
    text: String,
    column: usize,
}

struct Row<'t> {
    number: usize,
    text: &'t str,
    cells: Vec<Cell>,
}

struct Problems<'f> {
    file: &'f str,
    list: Vec<Diagnostic>,
}

impl Problems<'_> {
    fn at(&mut self, row: &Row, column: usize, message: impl Into<String>, help: impl Into<String>) {
        if self.list.len() < MOST_TOLD {
            self.list.push(Diagnostic::of_column(self.file, row.number, column, row.text, message, help));
        }
    }
}

/// Which columns belong to a channel.
struct Columns {
    value: Option<usize>,
    uncertainty: Option<usize>,
}

/// Reads readings for the exposures and channels of a calibration, in the order of these.
///
/// # Errors
/// Every problem, at least one.
///
/// ```
/// use etendue::characterization::readings_table::readings_from_csv;
/// use etendue::scene::{MemoryFiles, read_calibration};
///
/// let bench = r#"Scene(
///     sources: [(name: "lamp", shape: Point, at: (0, 0, 1), strength: Watts(1), spectrum: "A")],
///     instruments: [(name: "head", at: (0, 0, 0), facing: (0, 0, 1), sensor: Sensor(aperture: Point, acceptance: Cosine,
///         channels: [(name: "E_v", responsivity: "V", reads: Illuminance)]))],
/// )"#;
/// let campaign = r#"Calibration(bench: "bench.ron", noise: (relative: 0.01), curve: (from_nm: 400, to_nm: 700, step_nm: 10),
///     exposures: [Leds(spectra: ["LED-B1"], labels: ["white"])])"#;
/// let files = MemoryFiles::new().with("bench.ron", bench).with("c.ron", campaign);
/// let calibration = read_calibration("c.ron", &files, None)?;
/// let read = readings_from_csv("r.csv", "exposure,E_v (lx),u(E_v) (lx)\nwhite,25.1,0.2\n", &calibration)?;
/// assert_eq!((read[0].values[0], read[0].standard_uncertainties[0]), (25.1, 0.2));
/// let wrong = readings_from_csv("r.csv", "exposure,E_v (mlx),u(E_v) (lx)\nwhite,25.1,0\n", &calibration).unwrap_err();
/// assert_eq!(wrong.0.len(), 2, "{wrong}");
/// # Ok::<(), etendue::scene::Diagnostics>(())
/// ```
pub fn readings_from_csv(file: &str, text: &str, calibration: &Calibration) -> Result<Vec<ChannelReadings>, Diagnostics> {
    let mut problems = Problems { file, list: Vec::new() };
    let lines: Vec<(usize, &str)> = text
        .lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line.trim_start_matches('\u{feff}')))
        .filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'))
        .collect();
    let Some(&(number, head_text)) = lines.first() else {
        let help = "write a row `exposure,E_v (lx),u(E_v) (lx)` and a row for each exposure".to_owned();
        return Err(Diagnostics(vec![Diagnostic::of_file(file, "the file of readings is empty", Some(help))]));
    };
    let separator = [';', '\t'].into_iter().find(|c| head_text.contains(*c)).unwrap_or(',');
    let head = Row { number, text: head_text, cells: cells(head_text, separator) };
    let channels = &calibration.bench.instruments[0].sensor.channels;
    let names: Vec<(String, String)> = channels.iter().map(|c| (c.name.clone(), c.reads.unit().to_owned())).collect();
    let (label_column, columns) = read_head(&head, &names, &mut problems);
    let rows: Vec<Row> = lines[1..].iter().map(|&(number, text)| Row { number, text, cells: cells(text, separator) }).collect();
    let labels: Vec<&str> = calibration.exposures.iter().map(|e| e.label.as_str()).collect();
    let mut found: Vec<Option<usize>> = vec![None; labels.len()];
    if let Some(at) = label_column {
        for (r, row) in rows.iter().enumerate() {
            place(row, r, at, head.cells.len(), &labels, &mut found, &rows, &mut problems);
        }
        let missing: Vec<&str> = labels.iter().zip(&found).filter(|(_, f)| f.is_none()).map(|(l, _)| *l).collect();
        if !missing.is_empty() {
            let few: Vec<String> = missing.iter().take(5).map(|l| format!("\"{l}\"")).collect();
            let more = if missing.len() > 5 { format!(" and {} more", missing.len() - 5) } else { String::new() };
            let message = format!("exposures without readings: {}{more}", few.join(", "));
            problems.at(&head, 1, message, "add a row for each, or leave them out of the calibration file");
        }
    }
    let mut channels_read = Vec::new();
    for ((channel, columns), (name, _)) in channels.iter().zip(&columns).zip(&names) {
        let (mut values, mut uncertainties) = (Vec::new(), Vec::new());
        for row in found.iter().flatten().map(|r| &rows[*r]) {
            values.extend(columns.value.and_then(|k| number_at(row, k, &format!("the reading of {name}"), false, &mut problems)));
            let what = format!("the standard uncertainty of {name}");
            uncertainties.extend(columns.uncertainty.and_then(|k| number_at(row, k, &what, true, &mut problems)));
        }
        channels_read.push(ChannelReadings {
            channel: channel.name.clone(),
            measurand: channel.reads.clone(),
            values,
            standard_uncertainties: uncertainties,
        });
    }
    if problems.list.is_empty() {
        return Ok(channels_read);
    }
    problems.list.sort_by_key(|p| (p.line, p.column));
    Err(Diagnostics(problems.list))
}

/// The column of the labels, and those of each channel.
fn read_head(head: &Row, names: &[(String, String)], problems: &mut Problems) -> (Option<usize>, Vec<Columns>) {
    let mut columns: Vec<Columns> = names.iter().map(|_| Columns { value: None, uncertainty: None }).collect();
    let mut label = None;
    let expected: Vec<String> = std::iter::once("exposure".to_owned())
        .chain(names.iter().flat_map(|(name, unit)| [format!("{name} ({unit})"), format!("u({name}) ({unit})")]))
        .collect();
    let allowed: Vec<&str> = expected.iter().map(String::as_str).collect();
    let mut unknown = false;
    for (k, cell) in head.cells.iter().enumerate() {
        if cell.text == "exposure" {
            label = Some(k);
            continue;
        }
        let (title, unit) = match cell.text.strip_suffix(')').and_then(|t| t.rsplit_once('(')) {
            Some((title, unit)) if title.trim() != "u" => (title.trim(), Some(unit.trim())),
            _ => (cell.text.as_str(), None),
        };
        let inner = title.strip_prefix("u(").and_then(|t| t.strip_suffix(')'));
        let Some(c) = names.iter().position(|(name, _)| name == inner.unwrap_or(title)) else {
            unknown = true;
            problems.at(
                head,
                cell.column,
                format!("the column `{}` is not one of this calibration", cell.text),
                suggestion(&cell.text, &allowed),
            );
            continue;
        };
        let due = &names[c].1;
        let slot = if inner.is_some() { &mut columns[c].uncertainty } else { &mut columns[c].value };
        *slot = Some(k);
        match unit {
            None => {
                problems.at(head, cell.column, format!("the column `{}` states no unit", cell.text), format!("write `{title} ({due})`"))
            }
            Some(unit) if unit != due => {
                let help = format!("convert the readings and write `{title} ({due})`");
                problems.at(head, cell.column, format!("the unit of `{title}` is {unit}, and the channel reads {due}"), help);
            }
            Some(_) => {}
        }
    }
    // A renamed column is told once: as the unknown one.
    if !unknown {
        let missing = expected.iter().filter(|e| match names.iter().position(|(n, _)| e.starts_with(&format!("u({n}) "))) {
            _ if *e == "exposure" => label.is_none(),
            Some(c) => columns[c].uncertainty.is_none(),
            None => names.iter().position(|(n, _)| e.starts_with(&format!("{n} "))).is_some_and(|c| columns[c].value.is_none()),
        });
        for column in missing {
            problems.at(head, 1, format!("there is no column `{column}`"), format!("the columns are {}", expected.join(", ")));
        }
    }
    (label, columns)
}

/// Finds the exposure of a row.
#[allow(clippy::too_many_arguments)]
fn place(
    row: &Row,
    index: usize,
    at: usize,
    width: usize,
    labels: &[&str],
    found: &mut [Option<usize>],
    rows: &[Row],
    problems: &mut Problems,
) {
    if row.cells.len() != width {
        let other = [';', '\t', ','].into_iter().find(|c| row.cells.len() == 1 && row.text.contains(*c));
        let help = match other {
            Some(c) => {
                format!("the head separates its columns by another character than this row's `{}`: use one for both", c.escape_default())
            }
            None if row.cells.len() > width && !row.text.contains([';', '\t']) => {
                "write one value for each column, with decimal points: a decimal comma makes two cells of one number".to_owned()
            }
            None => "write one value for each column".to_owned(),
        };
        problems.at(row, 1, format!("{} cells where the head has {width}", row.cells.len()), help);
        return;
    }
    let cell = &row.cells[at];
    match labels.iter().position(|label| *label == cell.text) {
        None => problems.at(row, cell.column, format!("there is no exposure called \"{}\"", cell.text), suggestion(&cell.text, labels)),
        Some(i) => match found[i] {
            Some(earlier) => {
                let help = format!("the first is in line {}; average repeats and give the uncertainty of the mean", rows[earlier].number);
                problems.at(row, cell.column, format!("the exposure \"{}\" has two rows", cell.text), help);
            }
            None => found[i] = Some(index),
        },
    }
}

fn number_at(row: &Row, k: usize, what: &str, above_zero: bool, problems: &mut Problems) -> Option<f64> {
    let cell = &row.cells[k];
    let (message, help) = match cell.text.parse::<f64>() {
        Ok(x) if x.abs() <= LARGEST && (x > 0.0 || !above_zero) => return Some(x),
        Ok(x) if x.is_finite() && x.abs() > LARGEST => (
            format!("{what} is {x:e}, which is absurd"),
            format!("allowed: up to {LARGEST:e}; a value that stands for none is left out, row and exposure"),
        ),
        Ok(x) if x.is_finite() => {
            let help = "give the standard uncertainty (k = 1) of the reading, above 0; without one nothing can be said about the curve. A reading of zero has one, \
                        too: the scatter of readings in the dark, or the last digit of the display over √12";
            (format!("{what} is {x}"), help.to_owned())
        }
        Ok(x) => (format!("{what} is {x}"), "every number is finite; leave the exposure out of both files".to_owned()),
        Err(_) if cell.text.contains(',') && cell.text.replacen(',', ".", 1).parse::<f64>().is_ok() => {
            let help = format!("write a decimal point: {}", cell.text.replacen(',', ".", 1));
            (format!("{what} has a decimal comma: `{}`", cell.text), help)
        }
        Err(_) if cell.text.is_empty() => {
            (format!("{what} is missing"), "every exposure has a reading and an uncertainty in each channel".to_owned())
        }
        Err(_) => (format!("{what} is no number: `{}`", cell.text), "write it with a decimal point, such as 0.0123".to_owned()),
    };
    problems.at(row, cell.column, message, help);
    None
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
