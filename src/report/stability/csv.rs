//! Sweeps of numerical stability as CSV: a row a point, every digit kept; an empty cell is no number.

use crate::study::stability::SweepResult;

const HEAD: [&str; 16] = [
    "sweep",
    "series",
    "parameter",
    "parameter_unit",
    "value",
    "reading",
    "unit",
    "reference",
    "relative_deviation",
    "deviation_in_u",
    "relative_expanded_uncertainty",
    "share_within_99_percent_bands",
    "samples",
    "seconds",
    "judgement",
    "note",
];

/// All rows as CSV.
#[must_use]
pub fn to_csv(results: &[SweepResult]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:e}"));
    // Writing into memory does not fail.
    let _ = writer.write_record(HEAD);
    for result in results {
        for row in &result.rows {
            let _ = writer.write_record([
                result.sweep.name.to_owned(),
                row.series.to_owned(),
                result.sweep.parameter.to_owned(),
                result.sweep.unit.to_owned(),
                format!("{:e}", row.parameter),
                number(row.reading),
                row.unit.clone(),
                number(row.reference),
                number(row.deviation),
                number(row.deviation_u),
                number(row.expanded),
                number(row.inside),
                row.samples.to_string(),
                format!("{:.6}", row.seconds),
                row.judgement.word().to_owned(),
                row.note.clone(),
            ]);
        }
    }
    writer.into_inner().map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).unwrap_or_default()
}
