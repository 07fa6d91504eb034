//! Error of a calibrated curve as tables for a person, and as CSV: a row a rung.

use std::fmt::Write;

use super::CampaignReport;
use super::text::{share, slope, time};
use crate::metrology::rounding::format_significant;
use crate::study::converge::campaign::{CampaignLadder, LadderKind};

const COLUMNS: [&str; 12] = [
    "ladder",
    "parameter",
    "exposures",
    "noise_factor",
    "samples",
    "seeds",
    "cpu_seconds",
    "wall_seconds",
    "error",
    "claimed",
    "share_within_95_percent_bands",
    "fits_that_say_they_do_not_hold",
];

/// The report as text.
#[must_use]
pub fn campaign_to_text(report: &CampaignReport) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = write_all(report, &mut text);
    text
}

fn write_all(report: &CampaignReport, out: &mut String) -> std::fmt::Result {
    let study = &report.study;
    writeln!(out, "{}\n", study.title)?;
    writeln!(out, "  reference  the true curve of the simulated sensor at the nodes")?;
    let threads = if report.threads == 1 { "1 thread".to_owned() } else { format!("{} threads", report.threads) };
    writeln!(out, "  times      means of a run on {threads}: fit, and tracing where the bench is sampled; {}", report.cpu_clock)?;
    let seeds = study.ladders.iter().flat_map(|l| &l.rungs).map(|r| r.seeds).min().unwrap_or(0);
    writeln!(
        out,
        "  errors     over the peak of the curve, RMS over {seeds} seeds and all nodes; claimed: the standard uncertainty u of the curve"
    )?;
    for ladder in &study.ladders {
        writeln!(out)?;
        write_ladder(ladder, out)?;
    }
    for remark in &study.remarks {
        writeln!(out, "\n  note: {remark}")?;
    }
    Ok(())
}

fn write_ladder(ladder: &CampaignLadder, out: &mut String) -> std::fmt::Result {
    writeln!(out, "{}: {}", ladder.kind.name(), ladder.kind.rule())?;
    writeln!(
        out,
        "  {:>11} {:>11} {:>11} {:>12} {:>11} {:>13} {:>13}",
        ladder.kind.name(),
        "CPU s",
        "wall s",
        "true error",
        "claimed u",
        "claimed/true",
        "in 95 % band"
    )?;
    for rung in &ladder.rungs {
        let parameter = if ladder.kind == LadderKind::Noise { share(rung.parameter) } else { format!("{}", rung.parameter) };
        let ratio = if rung.error > 0.0 { format!("{:.2}", rung.ratio()) } else { "-".to_owned() };
        writeln!(
            out,
            "  {parameter:>11} {:>11} {:>11} {:>12} {:>11} {ratio:>13} {:>13}",
            format_significant(rung.cpu_seconds, 3),
            format_significant(rung.wall_seconds, 3),
            format!("{}{}", share(rung.error), if rung.told > 0 { "*" } else { "" }),
            share(rung.claimed),
            format!("{:.1} %", 100.0 * rung.within_95)
        )?;
    }
    if ladder.rungs.iter().any(|r| r.told > 0) {
        writeln!(
            out,
            "  *: the fit itself says that more is uncertain there than its bands hold, as `etendue calibrate` would; in no slope"
        )?;
    }
    write!(
        out,
        "  slopes: true error {} against {}, claimed {}",
        slope(ladder.error_by_parameter.as_ref()),
        ladder.kind.parameter(),
        slope(ladder.claimed_by_parameter.as_ref())
    )?;
    match &ladder.error_by_time {
        Some(law) => writeln!(out, "; true error {} against CPU time", slope(Some(law)))?,
        None => writeln!(out)?,
    }
    if let Some(ratio) = ladder.ratio {
        writeln!(out, "  claimed/true: {ratio:.2} over these rungs")?;
    }
    if let Some(last) = ladder.rungs.last() {
        writeln!(out, "  a run of the last rung: {} of CPU time", time(last.cpu_seconds))?;
    }
    Ok(())
}

/// The report as CSV text.
#[must_use]
pub fn campaign_to_csv(report: &CampaignReport) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // A vector takes whatever is written to it.
    let _ = writer.write_record(COLUMNS);
    for ladder in &report.study.ladders {
        for rung in &ladder.rungs {
            let _ = writer.write_record([
                ladder.kind.name().to_owned(),
                rung.parameter.to_string(),
                rung.exposures.to_string(),
                rung.noise_factor.to_string(),
                rung.samples.to_string(),
                rung.seeds.to_string(),
                rung.cpu_seconds.to_string(),
                rung.wall_seconds.to_string(),
                rung.error.to_string(),
                rung.claimed.to_string(),
                rung.within_95.to_string(),
                rung.told.to_string(),
            ]);
        }
    }
    writer.into_inner().ok().and_then(|bytes| String::from_utf8(bytes).ok()).unwrap_or_default()
}
