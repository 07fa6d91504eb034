//! Sweeps of numerical stability as text, Markdown, JSON, CSV and charts.
//!
//! | file | what |
//! |---|---|
//! | `mod.rs` | tables for a person, for a terminal and for documentation |
//! | `json.rs`, `csv.rs` | every row, for programs |
//! | `chart.rs` | deviation and time against the parameter (feature `plot`) |

#[cfg(feature = "plot")]
pub mod chart;
pub mod csv;
pub mod json;

use crate::study::stability::{COSTLY_SECONDS, Failing, Judgement, Row, SweepResult};

/// Most characters of a note in a table for a terminal.
const NOTE_WIDTH: usize = 100;

/// Every sweep as a table, and where each starts to fail.
#[must_use]
pub fn to_text(results: &[SweepResult]) -> String {
    let mut text = String::new();
    for result in results {
        let sweep = &result.sweep;
        text.push_str(&format!("{}: {} ({})\n  {}\n", sweep.name, sweep.parameter, sweep.unit, sweep.law));
        let head = ["series", "parameter", "reading", "reference", "deviation", "in u", "U", "in bands", "samples", "s", "", "note"]
            .map(str::to_owned);
        let rows = result.rows.iter().map(|row| {
            let note: String = row.note.chars().take(NOTE_WIDTH).collect();
            let cut = if note.len() < row.note.len() { "…" } else { "" };
            cells(row, format!("{note}{cut}"))
        });
        text.push_str(&aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>()));
        text.push('\n');
    }
    text.push_str("Where it starts to fail\n");
    let head = SUMMARY_HEAD.map(str::to_owned);
    let rows = results.iter().flat_map(|result| result.summary().into_iter().map(|failing| summary_cells(result, &failing)));
    text.push_str(&aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>()));
    text.push_str(&verdict(results));
    text
}

/// The same for documentation: the summary, then every row.
#[must_use]
pub fn to_markdown(results: &[SweepResult]) -> String {
    let mut text = String::from(
        "# Numerical stability\n\n\
         Written by `etendue stability --markdown docs/stability.md`; times are those of the machine that wrote it.\n\n\
         Each row is a scene that is read as a user would read it and held against a closed form or a law. *Deviation* is |S − S₀|/|S₀|,\n\
         *in u* the same in standard uncertainties that the reading states, *U* its expanded uncertainty at 95 % over |S₀| (absolute where\n\
         S₀ is zero). A row holds if it deviates by at most 2 U (one reading in twenty lies outside of U by its definition), or, where a law\n\
         ties two runs with the same random numbers, by no more than rounding. *Told* means: no reading, and the note is what the user is told.\n\n\
         In the sweeps `fit-…` a row is a responsivity curve fitted to sets of readings (*samples* is their number, the time that of one fit). *Deviation* is the\n\
         RMS error of the curve over its peak, *in u* the RMS of the errors over their stated uncertainties, *U* twice the RMS of these over the peak; reading\n\
         and reference are those of the node that is furthest off. A row holds if at least 95 % of the nodes are within their 99 % bands (*in bands*). It is\n\
         *told* if there is no fit, or if the note says that its uncertainty means nothing.\n\n\
         ## Where it starts to fail\n\n",
    );
    let rows = results.iter().flat_map(|result| result.summary().into_iter().map(|failing| summary_cells(result, &failing)));
    text.push_str(&table(&SUMMARY_HEAD, rows));
    text.push_str(&format!("\n{}", verdict(results)));
    for result in results {
        let sweep = &result.sweep;
        text.push_str(&format!("\n## {}\n\n{} ({}); {}.\n\n", sweep.name, capitalised(sweep.parameter), sweep.unit, sweep.law));
        let head =
            ["series", "parameter", "reading", "reference", "deviation", "in u", "U", "in bands", "samples", "s", "judgement", "note"];
        text.push_str(&table(&head, result.rows.iter().map(|row| cells(row, row.note.clone()))));
    }
    text
}

const SUMMARY_HEAD: [&str; 9] =
    ["sweep", "series", "from", "to", "largest deviation", "in u", "fails at", "a second or more from", "what the user is told"];

fn summary_cells(result: &SweepResult, failing: &Failing) -> [String; 9] {
    let at = match (failing.wrong, &failing.told) {
        (Some(parameter), _) => format!("WRONG at {}", number(parameter)),
        (None, Some((parameter, _))) => format!("{}, told", number(*parameter)),
        (None, None) => "nowhere".to_owned(),
    };
    [
        result.sweep.name.to_owned(),
        failing.series.to_owned(),
        number(failing.from),
        number(failing.to),
        size(failing.largest_deviation),
        size(failing.largest_deviation_u),
        at,
        failing.costly.map_or("nowhere".to_owned(), |(parameter, seconds)| format!("{} ({seconds:.1} s)", number(parameter))),
        failing.told.as_ref().map_or(String::new(), |(_, message)| message.clone()),
    ]
}

fn cells(row: &Row, note: String) -> [String; 12] {
    let or_none = |x: Option<f64>, how: fn(f64) -> String| x.map_or("—".to_owned(), how);
    [
        row.series.to_owned(),
        number(row.parameter),
        or_none(row.reading, digits),
        or_none(row.reference, digits),
        or_none(row.deviation, size),
        or_none(row.deviation_u, size),
        or_none(row.expanded, size),
        row.inside.map_or(String::new(), |share| format!("{:.1} %", 100.0 * share)),
        row.samples.to_string(),
        format!("{:.4}", row.seconds),
        row.judgement.word().to_owned(),
        note,
    ]
}

/// How many rows there are, and what became of them.
fn verdict(results: &[SweepResult]) -> String {
    let rows = || results.iter().flat_map(|r| &r.rows);
    let wrong = results.iter().flat_map(SweepResult::wrong).count();
    let told = rows().filter(|r| r.judgement == Judgement::Told).count();
    let seconds: f64 = rows().map(|r| r.seconds).sum();
    let slow = rows().filter(|r| r.seconds >= COSTLY_SECONDS).count();
    format!(
        "{} rows: {} hold, {told} told, {wrong} wrong; {seconds:.1} s in all, {slow} of {COSTLY_SECONDS} s or more.\n",
        rows().count(),
        rows().count() - told - wrong
    )
}

/// A parameter, with a power of ten where it is large or small.
fn number(x: f64) -> String {
    if x == 0.0 || (1e-3..1e6).contains(&x.abs()) { format!("{x}") } else { format!("{x:e}") }
}

/// A reading with nine digits.
fn digits(x: f64) -> String {
    if x == 0.0 { "0".to_owned() } else { format!("{x:.8e}") }
}

/// An order of magnitude.
fn size(x: f64) -> String {
    match x {
        0.0 => "0".to_owned(),
        x if (0.01..1000.0).contains(&x) => format!("{x:.2}"),
        x => format!("{x:.1e}"),
    }
}

fn capitalised(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or(String::new(), |first| first.to_uppercase().chain(rest).collect())
}

/// Columns aligned with blanks, the last one as it is.
pub(super) fn aligned<const N: usize>(rows: &[[String; N]]) -> String {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..N).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::from(" ");
        for (cell, width) in row.iter().zip(&widths) {
            line.push_str(&format!(" {cell:width$} "));
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// A table of Markdown.
pub(super) fn table<const N: usize>(head: &[&str; N], rows: impl Iterator<Item = [String; N]>) -> String {
    let mut text = format!("| {} |\n|{}\n", head.join(" | "), "---|".repeat(N));
    for row in rows {
        text.push_str(&format!("| {} |\n", row.map(|cell| cell.replace('|', "\\|")).join(" | ")));
    }
    text
}
