//! Readings of a laboratory: a CSV file, as an instrument writes it, for the exposures of a calibration.
//!
//! ```text
//! Picoammeter PA-1; serial 0815
//! Wavelength [nm];E_v [lx];u(E_v) [lx];Temperature [°C]
//! 380;0,0123;0,0004;23,1
//! 385;0,0161;0,0004;23,1
//! ```
//!
//! | column | meaning |
//! |---|---|
//! | `exposure` | the label of an exposure of the calibration file |
//! | `wavelength (nm)` | instead of it, for exposures that are settings of a monochromator |
//! | `E_v (lx)` | readings of the channel `E_v`; the unit, in brackets or behind ` / `, is that of what the channel reads |
//! | `u(E_v) (lx)` | their standard uncertainties (k = 1), above zero; `u(E_v) (%)` as a share of the reading |
//! | `reference (A)`, `u(reference) (A)` | the same of the detector that measures the light, if the calibration has one |
//!
//! Columns and rows come in any order; further columns, such as times and temperatures, are not read. Each exposure has exactly one row, each channel
//! both columns. How the text itself may look: `readings_text.rs`. Every problem is told with its line and column.

use super::campaign::ChannelReadings;
use super::readings_text::{Readable, Row, readable, title_and_unit};
use super::substitution::REFERENCE;
use crate::naming::{nearest, suggestion};
use crate::quantity::Measurand;
use crate::scene::{Calibration, Diagnostic, Diagnostics};

/// Problems that are told at most.
const MOST_TOLD: usize = 50;
/// Wavelengths that are the same, nm: below the last digit that instruments write.
const SAME_NM: f64 = 1e-3;
/// Largest reading and uncertainty that are taken for ones: their squares are numbers.
const LARGEST: f64 = 1e90;
/// What to do about an uncertainty of zero or less.
const NO_UNCERTAINTY: &str = "give the standard uncertainty (k = 1) of the reading, above 0; without one nothing can be said about the curve. A reading of \
                              zero has one, too: the scatter of readings in the dark, or the last digit of the display over √12";

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

/// What a channel is called, what it reads, and which columns belong to it.
struct Columns<'c> {
    name: &'c str,
    reads: &'c Measurand,
    value: Option<usize>,
    uncertainty: Option<usize>,
    /// Whether the uncertainties are percent of the readings.
    percent: bool,
}

/// The column that says which exposure a row belongs to.
#[derive(Clone, Copy, PartialEq)]
enum Key {
    Label(usize),
    Wavelength(usize),
}

/// Reads readings for the exposures and channels of a calibration, in the order of these; the reference's, if there is one, come last.
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
    let Some(table) = readable(text, |title| is_label(title) || is_wavelength(title_and_unit(title).0)) else {
        let help = "write a row `exposure,E_v (lx),u(E_v) (lx)` and a row for each exposure".to_owned();
        return Err(Diagnostics(vec![Diagnostic::of_file(file, "the file of readings is empty", Some(help))]));
    };
    if let Some((line, column, message, help)) = &table.unclear {
        let text = text.lines().nth(line - 1).unwrap_or_default();
        return Err(Diagnostics(vec![Diagnostic::of_column(file, *line, *column, text, message.clone(), help.clone())]));
    }
    let channels = calibration.bench.instruments[0].sensor.channels.iter().map(|c| (c.name.as_str(), &c.reads));
    let reference = calibration.reference.iter().flat_map(|r| &r.sensor.channels).map(|c| (REFERENCE, &c.reads));
    let of = |(name, reads)| Columns { name, reads, value: None, uncertainty: None, percent: false };
    let mut columns: Vec<Columns> = channels.chain(reference).map(of).collect();
    let labels: Vec<&str> = calibration.exposures.iter().map(|e| e.label.as_str()).collect();
    let key = read_head(&table.head, &mut columns, &labels, &mut problems);
    let found = key.map_or_else(|| vec![None; labels.len()], |key| placed(&table, key, &labels, &mut problems));
    let mut readings = Vec::new();
    for of in &columns {
        let (mut values, mut standard_uncertainties) = (Vec::new(), Vec::new());
        for row in found.iter().flatten().map(|r| &table.rows[*r]) {
            let value = of.value.and_then(|k| number_at(&table, row, k, &format!("the reading of {}", of.name), None, &mut problems));
            let what = format!("the standard uncertainty of {}", of.name);
            let u = of.uncertainty.and_then(|k| number_at(&table, row, k, &what, Some(NO_UNCERTAINTY), &mut problems));
            let u = u.map(|u| if of.percent { 0.01 * u * value.unwrap_or(0.0).abs() } else { u });
            if let (Some(0.0), Some(value), Some(k)) = (u, value, of.uncertainty) {
                let help = format!("state it in {} for a reading of {value}", of.reads.unit());
                problems.at(row, row.cells[k].column, format!("{what} is a share of a reading of zero"), help);
            }
            values.extend(value);
            standard_uncertainties.extend(u);
        }
        readings.push(ChannelReadings { channel: of.name.to_owned(), measurand: of.reads.clone(), values, standard_uncertainties });
    }
    if problems.list.is_empty() {
        return Ok(readings);
    }
    problems.list.sort_by_key(|p| (p.line, p.column));
    Err(Diagnostics(problems.list))
}

fn is_label(title: &str) -> bool {
    title.eq_ignore_ascii_case("exposure")
}

fn is_wavelength(title: &str) -> bool {
    ["wavelength", "wavelength_nm", "lambda", "λ"].contains(&title.to_lowercase().as_str())
}

/// The column of the exposures; those of the channels go into `columns`.
fn read_head(head: &Row, columns: &mut [Columns], labels: &[&str], problems: &mut Problems) -> Option<Key> {
    let (mut by_label, mut by_wavelength) = (None, None);
    let mut unknown = Vec::new();
    for (k, cell) in head.cells.iter().enumerate() {
        let (title, unit) = title_and_unit(&cell.text);
        if is_label(title) {
            by_label = Some(Key::Label(k));
        } else if is_wavelength(title) {
            by_wavelength = Some((k, unit.or(title.ends_with("_nm").then_some("nm"))));
        } else {
            let inner = title.strip_prefix("u(").and_then(|t| t.strip_suffix(')'));
            match columns.iter_mut().find(|of| of.name == inner.unwrap_or(title)) {
                Some(of) => read_title(head, k, (title, unit), inner.is_some(), of, problems),
                None => unknown.push(k),
            }
        }
    }
    let key = by_label.or_else(|| {
        let (k, unit) = by_wavelength?;
        let column = head.cells[k].column;
        if unit != Some("nm") {
            let message = unit.map_or("the wavelengths state no unit".to_owned(), |unit| format!("the unit of the wavelengths is {unit}"));
            problems.at(head, column, message, "allowed: nm; write `wavelength (nm)`");
        }
        if labels.iter().any(|label| setting_nm(label).is_some()) {
            return Some(Key::Wavelength(k));
        }
        let few: Vec<&str> = labels.iter().take(3).copied().collect();
        let help = format!("name them in a column `exposure`: {}", few.join(", "));
        problems.at(head, column, "the exposures of this calibration are no settings of one wavelength", help);
        None
    });
    let expected = |of: &Columns| [format!("{} ({})", of.name, of.reads.unit()), format!("u({}) ({})", of.name, of.reads.unit())];
    let allowed: Vec<String> = std::iter::once("exposure".to_owned()).chain(columns.iter().flat_map(expected)).collect();
    let mut missing: Vec<String> = if by_label.is_none() && by_wavelength.is_none() { vec!["exposure".to_owned()] } else { Vec::new() };
    for of in columns.iter() {
        let [value, uncertainty] = expected(of);
        missing.extend(of.value.is_none().then_some(value));
        missing.extend(of.uncertainty.is_none().then_some(uncertainty));
    }
    // A column that was renamed is told where it stands; others that are not known are times, temperatures and the like.
    for cell in unknown.iter().map(|k| &head.cells[*k]) {
        if let Some(meant) = nearest(&cell.text, missing.iter().map(String::as_str)).map(str::to_owned) {
            let message = format!("the column `{}` is not one of this calibration", cell.text);
            problems.at(head, cell.column, message, format!("did you mean `{meant}`? allowed: {}", allowed.join(", ")));
            missing.retain(|name| *name != meant);
        }
    }
    for column in missing {
        problems.at(head, 1, format!("there is no column `{column}`"), format!("the columns are {}", allowed.join(", ")));
    }
    key
}

/// One column of a channel.
fn read_title(head: &Row, k: usize, (title, unit): (&str, Option<&str>), is_u: bool, of: &mut Columns, problems: &mut Problems) {
    let (column, due) = (head.cells[k].column, of.reads.unit());
    let slot = if is_u { &mut of.uncertainty } else { &mut of.value };
    if slot.replace(k).is_some() {
        problems.at(head, column, format!("there are two columns for `{title}`"), "keep one of them");
    }
    of.percent |= is_u && unit == Some("%");
    match unit {
        None => problems.at(head, column, format!("the column `{title}` states no unit"), format!("write `{title} ({due})`")),
        Some(unit) if unit != due && !(is_u && unit == "%") => {
            let help = format!("convert the readings and write `{title} ({due})`");
            problems.at(head, column, format!("the unit of `{title}` is {unit}, and the channel reads {due}"), help);
        }
        Some(_) => {}
    }
}

/// The wavelength of an exposure that is called "550 nm".
fn setting_nm(label: &str) -> Option<f64> {
    label.strip_suffix("nm")?.trim_end().parse().ok()
}

/// The row of each exposure.
fn placed(table: &Readable, key: Key, labels: &[&str], problems: &mut Problems) -> Vec<Option<usize>> {
    let mut found: Vec<Option<usize>> = vec![None; labels.len()];
    let width = table.head.cells.len();
    for (r, row) in table.rows.iter().enumerate() {
        if row.cells.len() != width {
            problems.at(row, 1, format!("{} cells where the head has {width}", row.cells.len()), on_width(row, width));
            continue;
        }
        let (Key::Label(at) | Key::Wavelength(at)) = key;
        let cell = &row.cells[at];
        let exposure = match key {
            Key::Label(_) => {
                let exposure = labels.iter().position(|label| *label == cell.text);
                if exposure.is_none() {
                    problems.at(row, cell.column, format!("there is no exposure called \"{}\"", cell.text), suggestion(&cell.text, labels));
                }
                exposure
            }
            Key::Wavelength(_) => at_wavelength(table, row, at, labels, problems),
        };
        let Some(i) = exposure else { continue };
        match found[i] {
            Some(earlier) => {
                let help =
                    format!("the first is in line {}; average repeats and give the uncertainty of the mean", table.rows[earlier].number);
                problems.at(row, cell.column, format!("the exposure \"{}\" has two rows", labels[i]), help);
            }
            None => found[i] = Some(r),
        }
    }
    let missing: Vec<&str> = labels.iter().zip(&found).filter(|(_, f)| f.is_none()).map(|(l, _)| *l).collect();
    if !missing.is_empty() {
        let few: Vec<String> = missing.iter().take(5).map(|l| format!("\"{l}\"")).collect();
        let more = if missing.len() > 5 { format!(" and {} more", missing.len() - 5) } else { String::new() };
        let message = format!("exposures without readings: {}{more}", few.join(", "));
        problems.at(&table.head, 1, message, "add a row for each, or leave them out of the calibration file");
    }
    found
}

/// The exposure at the wavelength of a row.
fn at_wavelength(table: &Readable, row: &Row, at: usize, labels: &[&str], problems: &mut Problems) -> Option<usize> {
    let nm = number_at(table, row, at, "the wavelength", Some("allowed: above 0 nm"), problems)?;
    let apart = |label: &str| setting_nm(label).map(|setting| (setting - nm).abs());
    let nearest = labels.iter().enumerate().filter_map(|(i, label)| Some((i, apart(label)?))).min_by(|a, b| a.1.total_cmp(&b.1));
    match nearest {
        Some((i, apart)) if apart <= SAME_NM => Some(i),
        _ => {
            let help = nearest.map_or_else(String::new, |(i, _)| format!("the nearest is \"{}\"; ", labels[i]));
            let message = format!("there is no exposure at {nm} nm");
            problems.at(row, row.cells[at].column, message, format!("{help}write the wavelength that the calibration file sets"));
            None
        }
    }
}

/// What to do about a row with another number of cells than the head.
fn on_width(row: &Row, width: usize) -> String {
    match [';', '\t', ','].into_iter().find(|c| row.cells.len() == 1 && row.text.contains(*c)) {
        Some(c) => {
            format!("the head separates its columns by another character than this row's `{}`: use one for both", c.escape_default())
        }
        None if row.cells.len() > width && !row.text.contains([';', '\t']) => {
            "write one value for each column, with decimal points: a decimal comma makes two cells of one number".to_owned()
        }
        None => "write one value for each column".to_owned(),
    }
}

/// The finite number of a cell; above zero if `above` says what to do about others.
fn number_at(table: &Readable, row: &Row, k: usize, what: &str, above: Option<&str>, problems: &mut Problems) -> Option<f64> {
    let cell = &row.cells[k];
    let with_point = cell.text.replacen(',', ".", 1);
    let (message, help) = match (table.number(cell), above) {
        (Some(x), above) if x.abs() <= LARGEST && (x > 0.0 || above.is_none()) => return Some(x),
        (Some(x), _) if x.is_finite() && x.abs() > LARGEST => (
            format!("{what} is {x:e}, which is absurd"),
            format!("allowed: up to {LARGEST:e}; a value that stands for none is left out, row and exposure"),
        ),
        (Some(x), Some(help)) if x.is_finite() => (format!("{what} is {x}"), help.to_owned()),
        (Some(x), _) => (format!("{what} is {x}"), "every number is finite; leave the exposure out of both files".to_owned()),
        (None, _) if cell.text.contains(',') && with_point.parse::<f64>().is_ok() => {
            (format!("{what} has a decimal comma: `{}`", cell.text), format!("write a decimal point: {with_point}"))
        }
        (None, _) if cell.text.is_empty() => {
            (format!("{what} is missing"), "every exposure has a reading and an uncertainty in each channel".to_owned())
        }
        (None, _) => (format!("{what} is no number: `{}`", cell.text), "write it with a decimal point, such as 0.0123".to_owned()),
    };
    problems.at(row, cell.column, message, help);
    None
}
