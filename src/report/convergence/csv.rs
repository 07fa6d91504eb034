//! Error against run time as CSV: a header row, then a row a rung of each curve.
//!
//! | columns | |
//! |---|---|
//! | `plan`, `curve`, `readings` | `planned` or `naive`; `all readings`, or instrument and channel; how many |
//! | `samples`, `samples_in_all` | asked of each sampled contribution and pose; taken by a run |
//! | `seeds` | runs |
//! | `cpu_seconds`, `wall_seconds`, `rays` | means of a run |
//! | `error`, `claimed` | true error and claimed u_c, RMS, relative |
//! | `reference_uncertainty`, `reference_limits` | of the reference, RMS, relative; whether it hides the error |
//!
//! A plan that is exact has one row, with zero samples, its largest deviation from a reference that was given, and its largest u.

use super::ConvergenceReport;

const COLUMNS: [&str; 13] = [
    "plan",
    "curve",
    "readings",
    "samples",
    "samples_in_all",
    "seeds",
    "cpu_seconds",
    "wall_seconds",
    "rays",
    "error",
    "claimed",
    "reference_uncertainty",
    "reference_limits",
];

/// The report as CSV text.
#[must_use]
pub fn to_csv(report: &ConvergenceReport) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut rows: Vec<Vec<String>> = vec![COLUMNS.map(str::to_owned).to_vec()];
    for plan in &report.study.plans {
        if let Some(exact) = &plan.exact {
            let deviation = exact.deviation.map_or(String::new(), |(relative, _)| relative.to_string());
            let times = [exact.cpu_seconds.to_string(), exact.wall_seconds.to_string()];
            let [cpu, wall] = times;
            let name = "all readings".to_owned();
            let count = exact.values.len().to_string();
            let zero = || "0".to_owned();
            rows.push(vec![
                plan.name.clone(),
                name,
                count,
                zero(),
                zero(),
                exact.runs.to_string(),
                cpu,
                wall,
                zero(),
                deviation,
                exact.claimed.to_string(),
                String::new(),
                String::new(),
            ]);
        }
        for curve in &plan.curves {
            rows.extend(curve.rungs.iter().map(|rung| {
                vec![
                    plan.name.clone(),
                    curve.name.clone(),
                    curve.readings.to_string(),
                    rung.samples.to_string(),
                    rung.samples_in_all.to_string(),
                    rung.seeds.to_string(),
                    rung.cpu_seconds.to_string(),
                    rung.wall_seconds.to_string(),
                    rung.rays.to_string(),
                    rung.error.to_string(),
                    rung.claimed.to_string(),
                    curve.reference_uncertainty.to_string(),
                    rung.reference_limits.to_string(),
                ]
            }));
        }
    }
    for row in rows {
        // A vector takes whatever is written to it.
        let _ = writer.write_record(&row);
    }
    writer.into_inner().ok().and_then(|bytes| String::from_utf8(bytes).ok()).unwrap_or_default()
}
