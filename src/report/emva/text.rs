//! The figures as a table for a person: value, expanded uncertainty, unit.

use std::fmt::Write;

use crate::characterization::emva::Figures;
use crate::metrology::rounding::{Rounded, format_significant};

/// Coverage factor of the uncertainties that are shown.
const COVERAGE_FACTOR: f64 = 2.0;

/// The figures as text.
#[must_use]
pub fn to_text(title: &str, figures: &Figures) -> String {
    let mut rows = vec![["figure", "", "value", "U (k = 2)", "unit"].map(str::to_owned)];
    for figure in &figures.list {
        let expanded = COVERAGE_FACTOR * figure.standard_uncertainty;
        let (value, expanded) = match Rounded::new(figure.value, expanded) {
            Some(rounded) => (rounded.value, rounded.uncertainty),
            None => (format_significant(figure.value, 6), format_significant(expanded, 2)),
        };
        rows.push([figure.name.into(), figure.symbol.into(), value, format!("± {expanded}"), figure.unit.into()]);
    }
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; 5] = std::array::from_fn(width);
    let mut text = format!("{title}\n\n");
    for (i, row) in rows.iter().enumerate() {
        let mut line = String::new();
        for (column, cell) in row.iter().enumerate() {
            let pad = " ".repeat(widths[column] - cell.chars().count());
            // Values end in one column.
            let (before, after) = if column == 2 { (pad.as_str(), "") } else { ("", pad.as_str()) };
            line += &format!("  {before}{cell}{after}");
        }
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", line.trim_end());
        if i == 0 {
            let _ = writeln!(text, "  {}", "─".repeat(widths.iter().sum::<usize>() + 8));
        }
    }
    let mut notes: Vec<(&str, String)> = Vec::new();
    for figure in &figures.list {
        let Some(note) = figure.note else { continue };
        match notes.iter_mut().find(|(known, _)| *known == note) {
            Some((_, symbols)) => *symbols += &format!(", {}", figure.symbol),
            None => notes.push((note, figure.symbol.to_owned())),
        }
    }
    for (note, symbols) in notes {
        let _ = write!(text, "\n  note: {symbols}: {note}");
    }
    text + "\n  EMVA 1288 release 4.0 linear; not checked against the text of the standard, which was not at hand\n"
}
