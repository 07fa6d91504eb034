//! The sheet of a spectrum as a page for a person: lists and small tables, decimal points one under the other.
//!
//! Remarks are not on the page; they are messages. A number with an uncertainty is rounded to two digits of it and followed by `±` and the standard uncertainty.

use super::SpectrumReport;
use crate::metrology::rounding::{Rounded, format_significant};
use crate::observer::sheet::{Digits, Group, SheetRow, SheetValue};

/// Widest page, characters; longer reasons are wrapped.
const PAGE: usize = 100;

/// The report as text.
#[must_use]
pub fn to_text(report: &SpectrumReport) -> String {
    let mut lines = vec![report.spectrum.clone(), format!("  {}", report.sheet.scale)];
    if report.sheet.rows.iter().any(|row| row.standard_uncertainty.is_some()) {
        lines.push("  ± standard uncertainty (k = 1)".to_owned());
    }
    for group in Group::ALL {
        let rows: Vec<&SheetRow> = report.sheet.rows.iter().filter(|row| row.group == group).collect();
        if rows.is_empty() {
            continue;
        }
        lines.extend([String::new(), group.title().to_owned()]);
        let table = rows.iter().any(|row| !row.column.is_empty());
        lines.extend(if table { table_lines(&rows) } else { list_lines(&rows) });
    }
    lines.iter().map(|line| format!("{}\n", line.trim_end())).collect()
}

/// Name, symbol, value, unit.
fn list_lines(rows: &[&SheetRow]) -> Vec<String> {
    let names = width(rows.iter().map(|row| row.name.as_str()));
    let symbols = width(rows.iter().map(|row| row.symbol.as_str()));
    let numbers: Vec<String> = rows.iter().map(|row| number(row).unwrap_or_default()).collect();
    let column = Column::of(numbers.iter().map(String::as_str));
    let mut lines = Vec::new();
    for (row, number) in rows.iter().zip(&numbers) {
        let head = format!("  {}  {}  ", padded(&row.name, names), padded(&row.symbol, symbols));
        match &row.value {
            SheetValue::Number(_) => {
                let unit = if row.unit == "1" { "" } else { &row.unit };
                lines.push(format!("{head}{} {unit}", column.aligned(number)));
            }
            SheetValue::Text(text) => lines.push(format!("{head}{}{text}", " ".repeat(column.indent()))),
            SheetValue::Undefined(why) => {
                let indent = " ".repeat(head.chars().count() + column.indent());
                lines.extend(wrapped(&format!("– {why}"), &format!("{head}{}", " ".repeat(column.indent())), &format!("{indent}  ")));
            }
        }
    }
    lines
}

/// A line a name, a column a heading; units beside the headings, or at the end of a line whose columns share one.
fn table_lines(rows: &[&SheetRow]) -> Vec<String> {
    let mut columns: Vec<&str> = Vec::new();
    let mut names: Vec<&str> = Vec::new();
    for row in rows {
        if !columns.contains(&row.column.as_str()) {
            columns.push(&row.column);
        }
        if !names.contains(&row.name.as_str()) {
            names.push(&row.name);
        }
    }
    let cell = |name: &str, column: &str| rows.iter().find(|row| row.name == name && row.column == column);
    let label_width = width(names.iter().copied());
    let mut lines = vec![" ".repeat(label_width + 2)];
    let mut reasons: Vec<String> = Vec::new();
    lines.extend(names.iter().map(|name| format!("  {}", padded(name, label_width))));
    for heading in &columns {
        let cells: Vec<Option<&&SheetRow>> = names.iter().map(|name| cell(name, heading)).collect();
        let texts: Vec<String> =
            cells.iter().map(|row| row.map_or(String::new(), |row| number(row).unwrap_or_else(|| "–".into()))).collect();
        for row in cells.iter().flatten() {
            if let SheetValue::Undefined(why) = &row.value
                && !reasons.contains(why)
            {
                reasons.push(why.clone());
            }
        }
        let unit = cells.iter().flatten().map(|row| row.unit.as_str()).find(|unit| *unit != "1").unwrap_or_default();
        let title = if unit.is_empty() { (*heading).to_owned() } else { format!("{heading} / {}", bracketed(unit)) };
        let column = Column::of(texts.iter().map(String::as_str));
        let aligned: Vec<String> = texts.iter().map(|text| column.aligned(text)).collect();
        let wide = width(aligned.iter().map(String::as_str)).max(title.chars().count());
        for (line, text) in lines.iter_mut().zip(std::iter::once(&title).chain(&aligned)) {
            line.push_str(&format!("   {}{text}", " ".repeat(wide - text.chars().count())));
        }
    }
    lines.extend(reasons.iter().flat_map(|why| wrapped(&format!("– {why}"), "  ", "    ")));
    lines
}

/// A unit below a stroke.
fn bracketed(unit: &str) -> String {
    if unit.contains('/') { format!("({unit})") } else { unit.to_owned() }
}

/// The number of a row as text; none if it has none.
fn number(row: &SheetRow) -> Option<String> {
    let SheetValue::Number(value) = row.value else { return None };
    if let Some(rounded) = row.standard_uncertainty.filter(|u| *u > 0.0).and_then(|u| Rounded::new(value, u)) {
        return Some(rounded.to_string());
    }
    Some(match row.digits {
        // A reader of a page wants 109503 lx, not 1.0950e5 lx.
        Digits::Significant(digits) => match value.abs() {
            size if (1e5..9_999_999.5).contains(&size) => format!("{value:.0}"),
            _ => format_significant(value, digits),
        },
        Digits::Decimals(places) => {
            let text = format!("{value:.places$}");
            // Rounding to nothing leaves a sign behind.
            let zero = text.chars().all(|c| !c.is_ascii_digit() || c == '0');
            if zero { text.trim_start_matches('-').to_owned() } else { text }
        }
    })
}

/// Numbers one under the other at their decimal points.
struct Column {
    before: usize,
    after: usize,
}

impl Column {
    fn of<'a>(texts: impl Iterator<Item = &'a str>) -> Self {
        let (mut before, mut after) = (0, 0);
        for text in texts {
            let (left, right) = parts(text);
            before = before.max(left);
            after = after.max(right);
        }
        Self { before, after }
    }

    fn aligned(&self, text: &str) -> String {
        let (left, right) = parts(text);
        format!("{}{text}{}", " ".repeat(self.before - left), " ".repeat(self.after - right))
    }

    /// Where text instead of a number begins.
    fn indent(&self) -> usize {
        self.before.saturating_sub(1).min(8)
    }
}

/// Characters before the first point, or before whatever ends the first number, and from there on.
fn parts(text: &str) -> (usize, usize) {
    let length = text.chars().count();
    let left = text.chars().position(|c| !(c.is_ascii_digit() || c == '-' || c == '(')).unwrap_or(length);
    (left, length - left)
}

fn width<'a>(texts: impl Iterator<Item = &'a str>) -> usize {
    texts.map(|text| text.chars().count()).max().unwrap_or(0)
}

fn padded(text: &str, width: usize) -> String {
    format!("{text}{}", " ".repeat(width.saturating_sub(text.chars().count())))
}

/// Words in lines of at most [`PAGE`] characters; the first line begins with `first`, the others with `next`.
fn wrapped(text: &str, first: &str, next: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let (mut line, mut empty) = (first.to_owned(), true);
    for word in text.split_whitespace() {
        if !empty && line.chars().count() + 1 + word.chars().count() > PAGE {
            lines.push(std::mem::replace(&mut line, next.to_owned()));
            empty = true;
        }
        if !empty {
            line.push(' ');
        }
        line.push_str(word);
        empty = false;
    }
    lines.push(line);
    lines
}
