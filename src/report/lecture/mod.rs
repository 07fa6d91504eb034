//! The lecture for a person: the list of its equations, one answer, and the table of quantities and systems.

pub mod json;

use crate::lecture::{Answer, Domain, Equation, Group, Input, equations};
use crate::metrology::rounding::format_significant;
use crate::quantity::cell::{CELLS, Row, SYSTEMS};

/// Significant digits of a computed number: closed forms are exact, spectra are tabulated to six or seven digits.
const DIGITS: usize = 10;

/// A number to [`DIGITS`] significant digits, zeros at its end left out.
fn number(x: f64) -> String {
    let text = format_significant(x, DIGITS);
    let (mantissa, exponent) = text.split_once('e').map_or((text.as_str(), None), |(m, e)| (m, Some(e)));
    let mantissa = if mantissa.contains('.') { mantissa.trim_end_matches('0').trim_end_matches('.') } else { mantissa };
    exponent.map_or_else(|| mantissa.to_owned(), |e| format!("{mantissa}e{e}"))
}

fn with_unit(text: &str, unit: &str) -> String {
    if matches!(unit, "" | "1") { text.to_owned() } else { format!("{text} {unit}") }
}

fn width<'a>(texts: impl IntoIterator<Item = &'a str>) -> usize {
    texts.into_iter().map(|text| text.chars().count()).max().unwrap_or(0)
}

/// `intensity_w_sr|_cd|_per_s_sr`: the keys under which an input may be given.
fn keys(input: &Input) -> String {
    let keys = input.keys();
    let first = keys.first().map_or_else(String::new, |(key, ..)| key.clone());
    let others: Vec<&str> = keys.iter().skip(1).filter_map(|(key, ..)| key.strip_prefix(input.key)).collect();
    if others.is_empty() { first } else { format!("{first}|{}", others.join("|")) }
}

fn inputs_in_short(equation: &Equation) -> String {
    let keys: Vec<String> = equation.inputs.iter().map(keys).collect();
    if keys.is_empty() { "no inputs".into() } else { keys.join(" ") }
}

/// All equations, by chapter: name, formula, keys of the inputs.
#[must_use]
pub fn list() -> String {
    let all: Vec<&Equation> = equations().collect();
    let (names, formulas) = (width(all.iter().map(|e| e.name)), 44);
    let mut text = String::new();
    let mut group: Option<Group> = None;
    for equation in all {
        if group != Some(equation.group) {
            group = Some(equation.group);
            text.push_str(&format!("{}{}\n", if text.is_empty() { "" } else { "\n" }, equation.group.title()));
        }
        let pad = |s: &str, width: usize| format!("{s}{}", " ".repeat(width.saturating_sub(s.chars().count())));
        text.push_str(&format!("  {}  {}  {}\n", pad(equation.name, names), pad(equation.formula, formulas), inputs_in_short(equation)));
    }
    text.push_str("\nkeys that end in |_… name the same input in another unit; the result is then in that system\n");
    text.push_str("etendue equation NAME KEY=VALUE …   computes one, for example: etendue equation photon-energy wavelength_nm=555\n");
    text.push_str("etendue equation --table            the table of quantities and systems\n");
    text
}

/// One answer: formula, inputs with units, result with unit, other forms.
#[must_use]
pub fn answer(answer: &Answer) -> String {
    let equation = answer.equation;
    let mut rows: Vec<[String; 3]> = Vec::new();
    for input in &answer.inputs {
        rows.push([input.symbol.to_owned(), with_unit(&input.value, input.unit), format!("{} ({})", input.meaning, input.key)]);
    }
    rows.push([answer.symbol.to_owned(), with_unit(&number(answer.value), answer.unit), answer.name.to_owned()]);
    for form in &answer.also {
        rows.push([String::new(), with_unit(&number(form.value), form.unit), form.what.to_owned()]);
    }
    let columns = [0, 1].map(|i| width(rows.iter().map(|row| row[i].as_str())));
    let mut text = format!("{}: {}\n\n  {}\n\n", equation.name, equation.about, equation.formula);
    let result = answer.inputs.len();
    for (index, row) in rows.iter().enumerate() {
        let pad = |i: usize| format!("{}{}", row[i], " ".repeat(columns[i] - row[i].chars().count()));
        let sign = if row[0].is_empty() { " " } else { "=" };
        if index == result && index > 0 {
            text.push('\n');
        }
        text.push_str(&format!("  {} {sign} {}   {}\n", pad(0), pad(1), row[2]));
    }
    text.push_str(&format!("\nsource: {}\n", equation.source));
    text
}

/// What an equation wants, for a message: every input with its keys, unit and domain.
#[must_use]
pub fn inputs(equation: &Equation) -> String {
    let mut text = format!("{}   {}\n", equation.formula, equation.about);
    for input in equation.inputs {
        let units: Vec<&str> = input.keys().iter().map(|(_, unit, _)| *unit).filter(|unit| !matches!(*unit, "" | "1")).collect();
        let unit = if units.is_empty() { String::new() } else { format!(" in {}", units.join(", ")) };
        let domain = if input.domain == Domain::Spectrum { String::new() } else { format!(", {}", input.domain.words()) };
        text.push_str(&format!("  {}   {} = {}{unit}{domain}\n", keys(input), input.symbol, input.meaning));
    }
    text
}

/// The table of quantities and systems: name, symbol, unit, name of the unit, other units.
#[must_use]
pub fn table() -> String {
    let mut text = String::new();
    for row in Row::ALL {
        text.push_str(&format!("{}: {}\n", row.name(), row.definition()));
        let cells: Vec<_> = SYSTEMS.iter().filter_map(|system| CELLS.iter().find(|c| c.row == row && c.system == *system)).collect();
        let columns = [
            width(cells.iter().map(|c| c.system)),
            width(cells.iter().map(|c| c.name)),
            width(cells.iter().map(|c| c.symbol)),
            width(cells.iter().map(|c| c.unit)),
        ];
        for cell in cells {
            let pad = |s: &str, i: usize| format!("{s}{}", " ".repeat(columns[i] - s.chars().count()));
            let others: Vec<String> = row
                .other_units(cell.system)
                .iter()
                .map(|o| format!("{} ({}) = {}", o.unit, o.name, with_unit(&number(o.size), cell.unit)))
                .collect();
            let others = if others.is_empty() { String::new() } else { format!(";  {}", others.join(", ")) };
            let words = [pad(cell.system, 0), pad(cell.name, 1), pad(cell.symbol, 2), pad(cell.unit, 3)].join("  ");
            text.push_str(&format!("  {words}  {}{others}\n", cell.unit_name));
        }
        text.push('\n');
    }
    text.push_str(
        "683 lm/W at 540 THz, which is 683.002 lm/W times V(λ) with wavelengths in air; a mesopic quantity belongs to one adaptation.\n",
    );
    text
}
