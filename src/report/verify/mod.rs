//! A verification for a person: case by case, then a summary by part and group.
//!
//! | column | |
//! |---|---|
//! | reference, reading | in the unit of the case |
//! | relative | (reading − reference) / abs(reference) |
//! | in u | (reading − reference) / u, where the reading states a standard uncertainty u |
//! | of limit | abs(reading − reference) over the largest that passes: the tolerance, or for a sampled reading k u at the level 1 − 1e-4 if that is larger; above 1 the case fails |
//! | ms | time that the case took |
//!
//! `json` and `csv` are for programs, `html` is a page with plots.

#[cfg(feature = "plot")]
pub mod chart;
pub mod csv;
#[cfg(feature = "plot")]
pub mod html;
pub mod json;

use crate::metrology::rounding::format_significant;
use crate::study::verify::{Check, Summary, Verdict, Verification};

/// Significant digits of references and readings on screen.
const DIGITS: usize = 10;

/// A number to [`DIGITS`] significant digits.
fn number(x: f64) -> String {
    format_significant(x, DIGITS)
}

/// A deviation: two digits are enough; nothing where there is none.
fn small(x: Option<f64>) -> String {
    match x {
        None => "–".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(x) => format!("{x:.1e}"),
    }
}

/// Milliseconds.
fn ms(seconds: f64) -> String {
    format!("{:.2}", 1e3 * seconds)
}

fn with_unit(text: String, unit: &str) -> String {
    if matches!(unit, "" | "1") { text } else { format!("{text} {unit}") }
}

/// The cells of a case that has a value.
fn cells(check: &Check) -> Option<[String; 7]> {
    let found = check.found()?;
    Some([
        check.id.clone(),
        with_unit(check.reference.map_or_else(String::new, number), &check.unit),
        number(found.value),
        small(check.relative_deviation()),
        small(check.deviation_in_u()),
        small(check.deviation_in_limits()),
        ms(check.seconds),
    ])
}

const HEADS: [&str; 7] = ["case", "reference", "reading", "relative", "in u", "of limit", "ms"];

fn padded(text: &str, width: usize, left: bool) -> String {
    let room = " ".repeat(width.saturating_sub(text.chars().count()));
    if left { format!("{text}{room}") } else { format!("{room}{text}") }
}

/// Rows under heads, the first column to the left, the others to the right.
fn table(heads: &[&str], rows: &[Vec<String>]) -> Vec<String> {
    let widths: Vec<usize> = (0..heads.len())
        .map(|i| rows.iter().map(|row| row[i].chars().count()).chain([heads[i].chars().count()]).max().unwrap_or(0))
        .collect();
    let line = |cells: &[String]| {
        let cells: Vec<String> = cells.iter().zip(&widths).enumerate().map(|(i, (cell, width))| padded(cell, *width, i == 0)).collect();
        cells.join("  ").trim_end().to_owned()
    };
    let heads: Vec<String> = heads.iter().map(|head| (*head).to_owned()).collect();
    std::iter::once(&heads).chain(rows).map(|row| line(row)).collect()
}

/// What stands in place of a value.
fn in_place_of_value(check: &Check) -> String {
    match &check.verdict {
        Verdict::Waits(why) => format!("waits: {why}"),
        Verdict::Behaviour(_) => "states a behaviour and no number; the tests hold it".to_owned(),
        _ => format!("FAILED: {}", check.reason().unwrap_or_default().lines().next().unwrap_or_default()),
    }
}

fn largest(of: &Option<(f64, String)>) -> [String; 2] {
    of.as_ref().map_or_else(|| ["–".to_owned(), String::new()], |(x, id)| [small(Some(*x)), id.clone()])
}

fn summary_row(sum: &Summary) -> Vec<String> {
    let [limit, case] = largest(&sum.largest);
    let counts = [sum.cases(), sum.agree, sum.fail, sum.wait, sum.behaviours].map(|count| count.to_string());
    let [u, _] = largest(&sum.largest_in_u);
    [vec![sum.name.clone()], counts.to_vec(), vec![limit, u, format!("{:.2}", sum.seconds), case]].concat()
}

const SUMMARY_HEADS: [&str; 10] = ["group", "cases", "agree", "fail", "wait", "behaviour", "of limit", "in u", "s", "largest"];

/// One sentence: what passed, what failed, how long it took.
#[must_use]
pub fn sentence(of: &Verification) -> String {
    let total = of.total();
    let computed = total.agree + total.fail;
    let waits = if total.wait + total.behaviours > 0 {
        format!("; {} wait for a stated reason, {} state a behaviour that the tests hold", total.wait, total.behaviours)
    } else {
        String::new()
    };
    let verdict = match (computed, total.fail) {
        (0, _) => "nothing was computed".to_owned(),
        (_, 0) => format!("all {computed} cases agree with their references"),
        (_, fail) => format!("{fail} of {computed} cases fail"),
    };
    format!("{verdict} ({:.1} s){waits}", of.seconds)
}

/// Every failure with its numbers; empty if there is none.
#[must_use]
pub fn failures(of: &Verification) -> String {
    let words = |check: &Check| match check.found() {
        Some(found) => format!(
            "{}: {:e} instead of {:e} {}, {} times the limit\n",
            check.id,
            found.value,
            check.reference.unwrap_or(f64::NAN),
            check.unit,
            small(check.deviation_in_limits())
        ),
        None => format!("{}: {}\n", check.id, check.reason().unwrap_or_default().lines().next().unwrap_or_default()),
    };
    of.checks.iter().filter(|check| check.fails()).map(words).collect()
}

/// The verification as text.
#[must_use]
pub fn text(of: &Verification) -> String {
    let mut out = String::new();
    let rows: Vec<Vec<String>> = of
        .checks
        .iter()
        .filter_map(|check| {
            let mut row = cells(check)?.to_vec();
            row.push(if check.fails() { check.word().to_owned() } else { String::new() });
            Some(row)
        })
        .collect();
    let heads = [&HEADS[..], &[""]].concat();
    let mut lines = table(&heads, &rows).into_iter();
    out.extend(lines.next().map(|head| head + "\n"));
    let mut part = "";
    for check in &of.checks {
        if check.part != part {
            part = &check.part;
            out.push('\n');
        }
        let line =
            if check.found().is_some() { lines.next().unwrap_or_default() } else { format!("{}  {}", check.id, in_place_of_value(check)) };
        out.push_str(&line);
        out.push('\n');
    }
    let mut rows: Vec<Vec<String>> = of.parts().iter().map(summary_row).collect();
    let groups = of.groups();
    rows.extend(groups.iter().map(summary_row));
    rows.push(summary_row(&of.total()));
    out.push('\n');
    for line in table(&SUMMARY_HEADS, &rows) {
        out.push_str(&line);
        out.push('\n');
    }
    out.push('\n');
    for group in groups.iter().filter(|group| !group.title.is_empty()) {
        out.push_str(&format!("{}: {}\n", group.name, group.title));
    }
    out.push_str("of limit: deviation over the tolerance of the case, or for a sampled reading over k u at the level 1 - 1e-4 if that is larger\nin u: deviation over the standard uncertainty that the reading states\n");
    out.push_str(&format!("\n{}\n", sentence(of)));
    out
}
