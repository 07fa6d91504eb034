//! Sweeps of numerical stability as JSON.
//!
//! Schema 1: `{"schema", "sweeps": [{"name", "parameter", "unit", "law", "rows": [...]}]}`. What is not there or not finite is `null`.

use serde::Serialize;

use crate::study::stability::{Row, SweepResult};

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    sweeps: Vec<Swept<'a>>,
}

#[derive(Serialize)]
struct Swept<'a> {
    name: &'a str,
    parameter: &'a str,
    unit: &'a str,
    law: &'a str,
    rows: Vec<Line<'a>>,
}

#[derive(Serialize)]
struct Line<'a> {
    series: &'a str,
    parameter: f64,
    reading: Option<f64>,
    unit: &'a str,
    reference: Option<f64>,
    relative_deviation: Option<f64>,
    deviation_in_standard_uncertainties: Option<f64>,
    relative_expanded_uncertainty: Option<f64>,
    share_within_99_percent_bands: Option<f64>,
    samples: u64,
    seconds: f64,
    judgement: &'a str,
    note: &'a str,
}

fn line(row: &Row) -> Line<'_> {
    let finite = |x: Option<f64>| x.filter(|x| x.is_finite());
    Line {
        series: row.series,
        parameter: row.parameter,
        reading: finite(row.reading),
        unit: &row.unit,
        reference: finite(row.reference),
        relative_deviation: finite(row.deviation),
        deviation_in_standard_uncertainties: finite(row.deviation_u),
        relative_expanded_uncertainty: finite(row.expanded),
        share_within_99_percent_bands: finite(row.inside),
        samples: row.samples,
        seconds: row.seconds,
        judgement: row.judgement.word(),
        note: &row.note,
    }
}

fn swept(result: &SweepResult) -> Swept<'_> {
    let SweepResult { sweep, rows } = result;
    Swept { name: sweep.name, parameter: sweep.parameter, unit: sweep.unit, law: sweep.law, rows: rows.iter().map(line).collect() }
}

/// All rows as JSON text, ending in a line break.
#[must_use]
pub fn to_json(results: &[SweepResult]) -> String {
    let document = Document { schema: 1, sweeps: results.iter().map(swept).collect() };
    // Strings and numbers only: there is nothing that could not be written.
    let mut text = serde_json::to_string_pretty(&document).unwrap_or_default();
    text.push('\n');
    text
}
