//! Coverage of intervals as JSON.
//!
//! Schema 1: `{"schema", "scenes": [{"file", "title", "target", "seeds", "seeds_asked", "seconds_per_run", "exact_readings", "remarks",
//! "rows": [...]}]}`. What is not finite is `null`.

use serde::Serialize;

use super::StudiedScene;
use crate::study::coverage::{CoverageRow, lowest_share};

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    scenes: Vec<Studied<'a>>,
}

#[derive(Serialize)]
struct Studied<'a> {
    file: &'a str,
    title: &'a str,
    target: f64,
    seeds: u64,
    seeds_asked: u64,
    seconds_per_run: f64,
    exact_readings: usize,
    remarks: &'a [String],
    rows: Vec<Line<'a>>,
}

#[derive(Serialize)]
struct Line<'a> {
    reading: &'a str,
    poses: usize,
    unit: &'a str,
    samples: f64,
    truth: f64,
    truth_standard_uncertainty: f64,
    truth_origin: String,
    truth_share_of_u: f64,
    readings: u64,
    covered: u64,
    covered_share: f64,
    lowest_share: f64,
    bias_in_standard_errors: Option<f64>,
    outside_target_share: f64,
    target_unmet_share: f64,
    claimed_over_rms: Option<f64>,
    verdict: &'a str,
}

fn line(row: &CoverageRow) -> Line<'_> {
    let finite = |x: f64| x.is_finite().then_some(x);
    Line {
        reading: &row.reading,
        poses: row.poses,
        unit: &row.unit,
        samples: row.samples,
        truth: row.truth,
        truth_standard_uncertainty: row.truth_standard_uncertainty,
        truth_origin: row.origin.words(),
        truth_share_of_u: row.truth_share,
        readings: row.runs,
        covered: row.covered,
        covered_share: row.covered_share(),
        lowest_share: lowest_share(row.runs),
        bias_in_standard_errors: finite(row.bias),
        outside_target_share: row.outside_target,
        target_unmet_share: row.target_unmet,
        claimed_over_rms: finite(row.claimed_over_rms),
        verdict: row.verdict.words(),
    }
}

/// All rows as JSON text, ending in a line break.
#[must_use]
pub fn to_json(studied: &[StudiedScene]) -> String {
    let scenes = studied.iter().map(|StudiedScene { file, target, found }| Studied {
        file,
        title: &found.title,
        target: *target,
        seeds: found.seeds.0,
        seeds_asked: found.seeds.1,
        seconds_per_run: found.seconds_per_run,
        exact_readings: found.exact,
        remarks: &found.remarks,
        rows: found.rows.iter().map(line).collect(),
    });
    // Strings and numbers only: there is nothing that could not be written.
    let mut text = serde_json::to_string_pretty(&Document { schema: 1, scenes: scenes.collect() }).unwrap_or_default();
    text.push('\n');
    text
}
