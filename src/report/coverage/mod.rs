//! Coverage of intervals as text, Markdown, JSON and CSV.
//!
//! | file | what |
//! |---|---|
//! | `mod.rs` | tables for a person, for a terminal and for documentation |
//! | `json.rs`, `csv.rs` | every row, for programs |

pub mod csv;
pub mod json;

use super::stability::{aligned, table};
use crate::study::coverage::{CoverageRow, SceneCoverage, Verdict, lowest_share};

/// A scene file and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct StudiedScene {
    /// The file as it was named.
    pub file: String,
    /// The target of the stopping rule, relative.
    pub target: f64,
    /// What came of it.
    pub found: SceneCoverage,
}

const HEAD: [&str; 13] = [
    "scene",
    "target",
    "reading",
    "samples",
    "truth",
    "u of it",
    "from",
    "covered",
    "limit",
    "bias",
    "outside the target",
    "u over rms",
    "verdict",
];

/// A row a reading, then scenes without samples, remarks and the verdict.
#[must_use]
pub fn to_text(studied: &[StudiedScene]) -> String {
    let mut text = String::new();
    let rows: Vec<[String; 13]> = every(studied).map(|(scene, row)| cells(scene, row)).collect();
    if !rows.is_empty() {
        text.push_str(&aligned(&std::iter::once(HEAD.map(str::to_owned)).chain(rows).collect::<Vec<_>>()));
        text.push('\n');
    }
    for line in exact(studied).into_iter().chain(remarks(studied)) {
        text.push_str(&format!("  {line}\n"));
    }
    text.push_str(&verdict(studied));
    text
}

/// The same for documentation.
#[must_use]
pub fn to_markdown(studied: &[StudiedScene], command: &str) -> String {
    let mut text = format!(
        "# Intervals that hold\n\n\
         Written by `{command}`.\n\n\
         Every scene is read with as many seeds as told, the stopping rule on, and each sampled reading is held against its truth: a closed form\n\
         that the samples do not use, or a long run with a seed of its own. *Covered* counts the readings whose 95 % interval holds the truth,\n\
         the uncertainty of the truth in quadrature; *limit* is 0.95 − 3 √(0.95 · 0.05 / N). *Bias* is the mean deviation in its own standard\n\
         errors, *outside the target* the share of the readings that are off by more than the target, *u over rms* the mean claimed\n\
         standard uncertainty over the root mean square deviation; above one, more is claimed than is needed, as where a bound for what was\n\
         missed is part of u. *Samples* is the mean of a reading. Poses of a grid are pooled: each has random numbers of its own, so they\n\
         are independent, and truth and u are means over them.\n\n",
    );
    text.push_str(&table(&HEAD, every(studied).map(|(scene, row)| cells(scene, row))));
    text.push_str(&format!("\n{}", verdict(studied)));
    let notes: Vec<String> = remarks(studied);
    if !notes.is_empty() {
        text.push_str("\n## Remarks\n\n");
        notes.iter().for_each(|line| text.push_str(&format!("* {line}\n")));
    }
    let exact = exact(studied);
    if !exact.is_empty() {
        text.push_str("\n## Formulas alone\n\n");
        exact.iter().for_each(|line| text.push_str(&format!("* {line}\n")));
    }
    text
}

/// How many rows are wrong.
#[must_use]
pub fn wrong(studied: &[StudiedScene]) -> usize {
    every(studied).filter(|(_, row)| row.verdict.is_wrong()).count()
}

fn every(studied: &[StudiedScene]) -> impl Iterator<Item = (&StudiedScene, &CoverageRow)> {
    studied.iter().flat_map(|scene| scene.found.rows.iter().map(move |row| (scene, row)))
}

fn cells(scene: &StudiedScene, row: &CoverageRow) -> [String; 13] {
    [
        scene.file.clone(),
        format!("{} %", trimmed(100.0 * scene.target)),
        row.reading.clone(),
        format!("{:.0}", row.samples),
        format!("{} {}", digits(row.truth), row.unit),
        format!("{} u", two_digits(row.truth_share)),
        row.origin.words(),
        format!("{:.1} % of {}", 100.0 * row.covered_share(), row.runs),
        format!("{:.1} %", 100.0 * lowest_share(row.runs)),
        format!("{:+.1}", row.bias),
        format!("{:.1} %", 100.0 * row.outside_target),
        if row.claimed_over_rms.is_finite() { two_digits(row.claimed_over_rms) } else { "never off".to_owned() },
        row.verdict.words().to_owned(),
    ]
}

/// Scenes with readings from formulas, each once.
fn exact(studied: &[StudiedScene]) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for scene in studied.iter().filter(|scene| scene.found.exact > 0) {
        let line = match scene.found.rows.is_empty() {
            true => format!("{}: exact, nothing sampled", scene.file),
            false => format!("{}: {} readings are exact, nothing sampled", scene.file, scene.found.exact),
        };
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    lines
}

/// What a reader should know, each once.
fn remarks(studied: &[StudiedScene]) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for scene in studied {
        let (made, asked) = scene.found.seeds;
        let short = !scene.found.rows.is_empty() && made < asked;
        let short = short.then(|| format!("{made} seeds of {asked} at {} %: the time was over", trimmed(100.0 * scene.target)));
        for line in scene.found.remarks.iter().cloned().chain(short).map(|line| format!("{}: {line}", scene.file)) {
            if !lines.contains(&line) {
                lines.push(line);
            }
        }
    }
    lines
}

/// How many rows there are, and what became of them.
fn verdict(studied: &[StudiedScene]) -> String {
    let count = |verdict: Verdict| every(studied).filter(|(_, row)| row.verdict == verdict).count();
    let lowest = every(studied).filter(|(_, row)| row.verdict != Verdict::TruthTooCoarse).map(|(_, row)| row.covered_share());
    let lowest = lowest.fold(f64::INFINITY, f64::min);
    let least = if lowest.is_finite() { format!("; least coverage {:.1} %", 100.0 * lowest) } else { String::new() };
    format!(
        "{} rows: {} hold, {} too low, {} biased, {} with a truth too coarse to tell{least}.\n",
        every(studied).count(),
        count(Verdict::Holds),
        count(Verdict::TooLow),
        count(Verdict::Biased),
        count(Verdict::TruthTooCoarse),
    )
}

/// Six significant digits.
fn digits(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        size if (1e-3..1e6).contains(&size) => format!("{x:.*}", (5 - size.log10().floor() as i32).max(0) as usize),
        _ => format!("{x:.5e}"),
    }
}

fn two_digits(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        size if size < 0.01 => format!("{x:.0e}"),
        size if size < 100.0 => format!("{x:.2}"),
        _ => format!("{x:.0e}"),
    }
}

/// A number without the zeros of its rounding.
fn trimmed(x: f64) -> String {
    format!("{}", (x * 1e9).round() / 1e9)
}
