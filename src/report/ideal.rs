//! What ideal instruments would indicate, as a table for a person.
//!
//! A row for each channel of an instrument; for a list or a grid, means over its poses. Parts are shares of the ideal reading, with U at k = 2;
//! a share without one is known better than its last digit.

use std::fmt::Write;

use crate::measurement::{Cause, IdealReading, Measurement, Reading};
use crate::metrology::Rounded;
use crate::metrology::rounding::format_significant;

/// One row: all readings of a channel of an instrument that have an ideal.
struct Row<'m> {
    first: &'m Reading,
    pairs: Vec<(&'m Reading, &'m IdealReading)>,
}

impl Row<'_> {
    fn mean(&self, of: impl Fn(&Reading, &IdealReading) -> f64) -> f64 {
        self.pairs.iter().map(|(r, i)| of(r, i)).sum::<f64>() / self.pairs.len() as f64
    }

    /// A cause's share of the ideal reading with its U, and whether the row has it at all. Uncertainties of poses are taken as common to
    /// all, so that their mean is not too small.
    fn share(&self, cause: Cause) -> Option<(f64, f64)> {
        let part = |i: &IdealReading| i.parts.iter().find(|p| p.cause == cause).copied();
        self.pairs.iter().any(|(_, i)| part(i).is_some()).then(|| {
            let ideal = self.mean(|_, i| i.value);
            let value = self.mean(|_, i| part(i).map_or(0.0, |p| p.value));
            let expanded = 2.0 * self.mean(|_, i| part(i).map_or(0.0, |p| p.share_uncertainty));
            (100.0 * value / ideal, 100.0 * expanded)
        })
    }
}

/// A signed share in percent with its U.
fn percent((value, expanded): (f64, f64)) -> String {
    if !value.is_finite() {
        return "-".to_owned();
    }
    let sign = |x: f64, text: &str| {
        if x < 0.0 || text.starts_with(['-', '−']) { format!("−{}", text.trim_start_matches(['-', '−'])) } else { format!("+{text}") }
    };
    // A hundredth of a percent is the finest that a table shows.
    if expanded < 0.005 {
        return format!("{} %", sign(value, &format!("{value:.2}")));
    }
    match Rounded::new(value, expanded) {
        Some(r) => format!("{} ± {} %", sign(value, &r.value), r.uncertainty),
        None => format!("{} %", sign(value, &format_significant(value, 3))),
    }
}

/// The table; nothing where no reading has an ideal.
pub(super) fn write_ideal(m: &Measurement, out: &mut String) -> std::fmt::Result {
    let mut rows: Vec<Row<'_>> = Vec::new();
    for reading in &m.readings {
        let Some(ideal) = &reading.ideal else { continue };
        let same = |row: &&mut Row<'_>| row.first.instrument == reading.instrument && row.first.channel == reading.channel;
        match rows.iter_mut().rev().find(same) {
            Some(row) => row.pairs.push((reading, ideal)),
            None => rows.push(Row { first: reading, pairs: vec![(reading, ideal)] }),
        }
    }
    if rows.is_empty() {
        return Ok(());
    }
    let causes: Vec<Cause> = Cause::ALL.into_iter().filter(|&cause| rows.iter().any(|row| row.share(cause).is_some())).collect();
    let mut head = vec!["instrument".to_owned(), "indicates".to_owned(), "ideal".to_owned(), String::new(), "difference".to_owned()];
    head.extend(causes.iter().map(|cause| cause.words().to_owned()));
    let mut cells = vec![head];
    for row in &rows {
        let poses = match row.pairs.len() {
            1 => String::new(),
            n => format!(", mean of {n}"),
        };
        let alone = rows.iter().filter(|other| other.first.instrument == row.first.instrument).count() == 1;
        let channel = if alone { String::new() } else { format!(" {}", row.first.channel) };
        let (indicated, ideal) = (row.mean(|r, _| r.value), row.mean(|_, i| i.value));
        let expanded = 2.0 * row.mean(|_, i| i.standard_uncertainty);
        let ideal_text = match Rounded::new(ideal, expanded).filter(|_| expanded > 1e-9 * ideal.abs()) {
            Some(r) => format!("{} ± {}", r.value, r.uncertainty),
            None => format_significant(ideal, 6),
        };
        let whole = if ideal == 0.0 { "-".to_owned() } else { percent((100.0 * (indicated - ideal) / ideal, 0.0)) };
        let mut line = vec![
            format!("{}{channel}{poses}", row.first.instrument),
            format_significant(indicated, 5),
            ideal_text,
            row.first.measurand.unit().to_owned(),
            whole,
        ];
        line.extend(causes.iter().map(|&cause| row.share(cause).map_or_else(String::new, percent)));
        cells.push(line);
    }
    writeln!(out, "  what an ideal instrument would indicate, and where the difference comes from\n")?;
    let width: Vec<usize> = (0..cells[0].len()).map(|c| cells.iter().map(|row| row[c].chars().count()).max().unwrap_or(0)).collect();
    for (k, row) in cells.iter().enumerate() {
        let padded = row.iter().enumerate().map(|(c, cell)| {
            let pad = " ".repeat(width[c] - cell.chars().count());
            // Numbers end in one column, names and units begin in one.
            if c == 0 || c == 3 { format!("{cell}{pad}") } else { format!("{pad}{cell}") }
        });
        writeln!(out, "  {}", padded.collect::<Vec<_>>().join("  ").trim_end())?;
        if k == 0 {
            writeln!(out, "  {}", "─".repeat(width.iter().map(|w| w + 2).sum::<usize>() - 2))?;
        }
    }
    writeln!(out, "\n  shares of the ideal reading, ± U with k = 2; the parts add up to the difference\n")
}
