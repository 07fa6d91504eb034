//! Error against run time as tables for a person.

use std::fmt::Write;

use super::ConvergenceReport;
use crate::metrology::rounding::format_significant;
use crate::study::converge::{ErrorCurve, ExactRun, PlanConvergence, PowerLaw, Reference, ReferenceOrigin, TARGETS, TimeTo};

/// Channels beyond this number are in the other formats only.
const MOST_CURVES: usize = 12;

/// The report as text.
#[must_use]
pub fn to_text(report: &ConvergenceReport) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = write_all(report, &mut text);
    text
}

fn write_all(report: &ConvergenceReport, out: &mut String) -> std::fmt::Result {
    let study = &report.study;
    writeln!(out, "{}\n", study.scene)?;
    let sampled = study.plans.iter().any(|p| !p.curves.is_empty());
    if sampled || matches!(study.reference.origin, ReferenceOrigin::Given(_)) {
        write_reference(&study.reference, study.plans.iter().find_map(|p| p.curves.first()), out)?;
    }
    let threads = if report.threads == 1 { "1 thread".to_owned() } else { format!("{} threads", report.threads) };
    writeln!(out, "  times      means of a run on {threads}; {}", report.cpu_clock)?;
    if sampled {
        writeln!(
            out,
            "  errors     relative, RMS over {} seeds and all readings of a curve; claimed: the standard uncertainty u of the reading",
            study.plans.iter().flat_map(|p| p.curves.first()).flat_map(|c| c.rungs.first()).map(|r| r.seeds).min().unwrap_or(0)
        )?;
    }
    for plan in &study.plans {
        writeln!(out)?;
        write_plan(plan, out)?;
    }
    write_gains(report, out)?;
    for remark in &study.remarks {
        writeln!(out, "\n  note: {remark}")?;
    }
    Ok(())
}

fn write_reference(reference: &Reference, all: Option<&ErrorCurve>, out: &mut String) -> std::fmt::Result {
    let what = match &reference.origin {
        ReferenceOrigin::Given(name) => format!("{name}; {}", stated(reference)),
        ReferenceOrigin::ClosedForm => "the closed form of the planned reading, no samples".to_owned(),
        ReferenceOrigin::LongRun { seed, samples, cpu_seconds, .. } => {
            format!("a run of its own, seed {seed}, {samples} samples, {}", time(*cpu_seconds))
        }
    };
    write!(out, "  reference  {what}")?;
    if let (Some(curve), ReferenceOrigin::LongRun { .. }) = (all, &reference.origin) {
        write!(out, ", u = {}", share(curve.reference_uncertainty))?;
        let limits = curve.rungs.iter().any(|r| r.reference_limits);
        let part = if limits { "at some rungs more" } else { "less" };
        write!(out, ": {part} than a third of the error")?;
    }
    writeln!(out)
}

fn stated(reference: &Reference) -> &'static str {
    let with = reference.values.iter().filter(|v| v.standard_uncertainty.is_some()).count();
    match with {
        0 => "no uncertainty stated, taken as exact",
        n if n == reference.values.len() => "with its stated uncertainty",
        _ => "some of it without an uncertainty, and taken as exact there",
    }
}

fn write_plan(plan: &PlanConvergence, out: &mut String) -> std::fmt::Result {
    if let Some(exact) = &plan.exact {
        return write_exact(plan, exact, out);
    }
    if plan.exact_readings > 0 {
        writeln!(out, "{}: {} readings are exact, by formulas, and in no curve", plan.name, plan.exact_readings)?;
    }
    let Some((all, channels)) = plan.curves.split_first() else { return Ok(()) };
    write_curve(&plan.name, all, out)?;
    if channels.is_empty() {
        return Ok(());
    }
    let width = channels.iter().take(MOST_CURVES).map(|c| c.name.chars().count()).max().unwrap_or(0).max(12);
    writeln!(out, "\n  {:<width$} {:>8} {:>14} {:>13}   CPU time to 1 %, 0.1 %", "of these", "readings", "slope by time", "claimed/true")?;
    for curve in channels.iter().take(MOST_CURVES) {
        let ratio = curve.ratio.map_or("-".to_owned(), |r| format!("{r:.2}"));
        let [percent, permille, _] = &curve.times;
        writeln!(
            out,
            "  {:<width$} {:>8} {:>14} {ratio:>13}   {}, {}",
            curve.name,
            curve.readings,
            slope(curve.error_by_time.as_ref()),
            time_to(percent),
            time_to(permille)
        )?;
    }
    if channels.len() > MOST_CURVES {
        writeln!(out, "  … and {} more; all of them rung by rung: --format csv or json", channels.len() - MOST_CURVES)?;
    }
    Ok(())
}

fn write_exact(plan: &PlanConvergence, exact: &ExactRun, out: &mut String) -> std::fmt::Result {
    let count = if exact.values.len() == 1 { "the reading is".to_owned() } else { format!("all {} readings are", exact.values.len()) };
    writeln!(out, "{}: exact. {count} from formulas, without samples: there is no error to follow", plan.name)?;
    writeln!(
        out,
        "  {} a run (mean of {}), claimed u at most {} of the reading",
        time(exact.cpu_seconds),
        exact.runs,
        share(exact.claimed)
    )?;
    match exact.deviation {
        None => Ok(()),
        Some((relative, in_u)) if in_u.is_finite() => {
            writeln!(out, "  deviation from the reference: {} at most, {in_u:.2} joint standard uncertainties", share(relative))
        }
        Some((relative, _)) => writeln!(out, "  deviation from the reference: {} at most", share(relative)),
    }
}

fn write_curve(plan: &str, curve: &ErrorCurve, out: &mut String) -> std::fmt::Result {
    let count = if curve.readings == 1 { String::new() } else { format!(" ({} readings)", curve.readings) };
    writeln!(out, "{plan}: {}{count}", curve.name)?;
    writeln!(
        out,
        "  {:>11} {:>11} {:>11} {:>12} {:>11} {:>13} {:>10}",
        "samples", "CPU s", "wall s", "true error", "claimed u", "claimed/true", "rays"
    )?;
    for rung in &curve.rungs {
        let mark = if rung.reference_limits { "*" } else { "" };
        let ratio = if rung.reference_limits || rung.error == 0.0 { "-".to_owned() } else { format!("{:.2}", rung.ratio()) };
        writeln!(
            out,
            "  {:>11} {:>11} {:>11} {:>12} {:>11} {ratio:>13} {:>10}",
            rung.samples,
            format_significant(rung.cpu_seconds, 3),
            format_significant(rung.wall_seconds, 3),
            format!("{}{mark}", share(rung.error)),
            share(rung.claimed),
            format_significant(rung.rays, 3),
        )?;
    }
    writeln!(
        out,
        "  slopes: true error {} against CPU time, {} against samples; claimed {}{}",
        slope(curve.error_by_time.as_ref()),
        slope(curve.error_by_samples.as_ref()),
        slope(curve.claimed_by_time.as_ref()),
        curve
            .error_by_samples
            .as_ref()
            .map_or(String::new(), |l| format!("   ({} rungs, {} to {} samples)", l.points, l.range.0, l.range.1))
    )?;
    if let Some(ratio) = curve.ratio {
        writeln!(out, "  claimed/true: {ratio:.2} over these rungs")?;
    }
    let times: Vec<String> = TARGETS.iter().zip(&curve.times).map(|(target, t)| format!("{}: {}", share(*target), time_to(t))).collect();
    writeln!(out, "  CPU time to {}", times.join(";  "))
}

/// What the first plan saves against the others.
fn write_gains(report: &ConvergenceReport, out: &mut String) -> std::fmt::Result {
    let Some((first, others)) = report.study.plans.split_first().filter(|(_, others)| !others.is_empty()) else { return Ok(()) };
    writeln!(out)?;
    for other in others.iter().filter(|other| !report.study.gains.iter().any(|gain| gain.other == other.name)) {
        writeln!(
            out,
            "  {} over {}: not known, for there is no error that both have reached; give more time (--budget)",
            other.name, first.name
        )?;
    }
    for gain in &report.study.gains {
        let at_most = if gain.measured { "" } else { " (one of them in less than the lowest rung takes)" };
        writeln!(
            out,
            "  {} over {}: {} times the CPU time to {}{at_most}",
            gain.other,
            first.name,
            format_significant(gain.factor, 2),
            share(gain.error)
        )?;
    }
    Ok(())
}

fn time_to(time_to: &TimeTo) -> String {
    match time_to {
        TimeTo::AtMost(s) => format!("at most {}", time(*s)),
        TimeTo::Interpolated(s) => time(*s),
        TimeTo::Extrapolated(s) => format!("{} (extrapolated)", time(*s)),
        TimeTo::Unknown => "not known".to_owned(),
    }
}

pub(super) fn time(seconds: f64) -> String {
    let (scale, unit) = match seconds {
        s if s >= 1.0 || s == 0.0 => (1.0, "s"),
        s if s >= 1e-3 => (1e3, "ms"),
        _ => (1e6, "µs"),
    };
    format!("{} {unit}", format_significant(seconds * scale, 3))
}

pub(super) fn slope(law: Option<&PowerLaw>) -> String {
    law.map_or("not known".to_owned(), |l| format!("{} ± {:.2}", signed(l.exponent), l.standard_uncertainty))
}

/// A share in percent.
pub(super) fn share(x: f64) -> String {
    format!("{} %", format_significant(100.0 * x, if TARGETS.contains(&x) { 1 } else { 3 }))
}

fn signed(x: f64) -> String {
    format!("{}{:.2}", if x < 0.0 { "−" } else { "+" }, x.abs())
}
