//! A calibration as a page for a person.

use std::fmt::Write;

use super::consistency::consistency_text;
use super::parametric::parametric_text;
use crate::metrology::rounding::{Rounded, format_significant};
use crate::study::calibrate::propagate::{DRAWS, Propagated};
use crate::study::calibrate::suggest::Wanted;
use crate::study::calibrate::{Calibrated, CalibratedChannel, UNDETERMINED};

/// Rows of the curve that are printed; the files hold them all.
const ROWS: usize = 17;
/// Share of a reading from outside of the nodes that is told.
const TOLD_OUTSIDE: f64 = 1e-4;
/// Relative uncertainty common to all readings that is told: rays on a bench by formulas leave less.
const TOLD_SCALE: f64 = 1e-6;
/// Relative difference of linear and drawn uncertainties that is told.
const LINEAR: f64 = 0.25;

/// The page.
#[must_use]
pub fn to_text(calibrated: &Calibrated) -> String {
    let mut text = format!("{}\n", calibrated.title);
    let origin = if calibrated.simulated { format!("simulated, seed {}", calibrated.seed) } else { "given".to_owned() };
    let _ = writeln!(text, "sensor: {}; {} exposures, readings {origin}", calibrated.sensor, calibrated.labels.len());
    let rays = match calibrated.samples {
        0 => "bench by formulas, without a ray".to_owned(),
        n => format!("bench by {n} samples, one tracing for all spectra"),
    };
    let curves = match calibrated.prior.1 {
        length if length.is_finite() => format!("curves smooth over {length:.0} nm ({})", calibrated.prior.0),
        _ => format!("curves of a model: {}", calibrated.prior.0),
    };
    let _ = writeln!(text, "{rays}; {curves}");
    if let Some(beam) = &calibrated.beam {
        let ends = beam.powers.iter().fold((f64::INFINITY, 0.0f64), |(low, high), p| (low.min(*p), high.max(*p)));
        let worst = beam.relative_uncertainties.iter().fold(0.0f64, |most, u| most.max(*u));
        let _ = writeln!(
            text,
            "light measured by substitution: {}; beam at {} to {} of its nominal power, each known within {} %",
            beam.reference,
            format_significant(ends.0, 4),
            format_significant(ends.1, 4),
            format_significant(100.0 * worst, 2)
        );
    }
    if calibrated.scale_uncertainty > TOLD_SCALE {
        let _ =
            writeln!(text, "common to all readings: {} % of the irradiance", format_significant(100.0 * calibrated.scale_uncertainty, 2));
    }
    for channel in &calibrated.channels {
        text.push('\n');
        channel_text(&mut text, calibrated, channel);
    }
    if !calibrated.colours.is_empty() {
        text.push_str("\nColours of the 24 patches of a ColorChecker, by the matrix that suits them best, against those that the CIE 1931 observer sees\n");
        uses_text(&mut text, &calibrated.colours, "");
    }
    if !calibrated.suggestions.is_empty() {
        text.push_str("\nFurther exposures that would help most, by the error that is expected with them\n");
        for (i, s) in calibrated.suggestions.iter().enumerate() {
            let (before, after) = match &calibrated.wanted {
                Wanted::Curve => {
                    let percent = |x: f64| format!("{} %", format_significant(100.0 * x, 3));
                    (format!("error of the curve {}", percent(s.before)), format!("{} of its peak (RMS)", percent(s.after)))
                }
                Wanted::Quantity(name) => (format!("error of {name} {}", format_significant(s.before, 2)), format_significant(s.after, 2)),
            };
            let _ = writeln!(text, "  {}. {}: {before} → {after}", i + 1, s.label);
        }
        text.push_str(
            "  Expected where the fitted curve is right about where it is small; the stated u does not rely on that, and is larger.\n",
        );
    }
    for remark in &calibrated.remarks {
        let _ = writeln!(text, "note: {remark}");
    }
    text
}

fn channel_text(text: &mut String, calibrated: &Calibrated, channel: &CalibratedChannel) {
    let curve = &channel.curve;
    let readings = channel.readings.values.len();
    let _ = writeln!(
        text,
        "{} ({}), curve in {}: χ² = {} for {readings} readings, which determine {} numbers",
        channel.readings.channel,
        channel.readings.measurand.name(),
        channel.unit,
        format_significant(curve.chi_squared, 3),
        format_significant(curve.effective_parameters, 2),
    );
    if let Some(parametric) = &curve.parametric {
        parametric_text(text, calibrated, channel, parametric);
    }
    match channel.unseen_nm.as_slice() {
        [] if curve.parametric.is_some() => text.push_str("  If the model holds, the readings determine the curve at every node.\n"),
        [] => text.push_str("  The readings determine the curve at every node.\n"),
        ranges => {
            let words: Vec<String> = ranges.iter().map(|(a, b)| format!("{a} nm to {b} nm")).collect();
            let _ = writeln!(text, "  The readings do not determine the curve at {}: there it is a guess.", words.join(", "));
            let _ = writeln!(
                text,
                "  (A node is open if more than {0} % of what was unknown before the readings still is, if they miss more than {0} % of a curve that is 1 \
                 everywhere, or if it lies beyond the width at half maximum of the outermost exposures.)",
                100.0 * UNDETERMINED
            );
        }
    }
    if let Some(factor) = channel.simultaneous {
        let _ = writeln!(
            text,
            "  ±1.96 u holds each of its nodes with 95 %, ±{} u all that are determined at once.",
            format_significant(factor, 3)
        );
    }
    if let Some((share, label)) = channel.outside.as_ref().filter(|(share, _)| *share > TOLD_OUTSIDE) {
        let _ = writeln!(
            text,
            "  Up to {} % of a reading ({label}) comes from wavelengths outside of the curve; the fit does not know them. Widen `curve`.",
            format_significant(100.0 * share, 2)
        );
    }
    consistency_text(text, channel);
    curve_rows(text, calibrated, channel);
    if !channel.uses.is_empty() {
        uses_text(text, &channel.uses, channel.readings.measurand.unit());
    }
}

/// What the curve is worth in use: of readings in `unit`.
fn uses_text(text: &mut String, uses: &[Propagated], reading_unit: &str) {
    let name = |q: &Propagated| match q.unit.as_str() {
        "1" => q.name.clone(),
        unit => format!("{} ({reading_unit} {unit})", q.name),
    };
    let width = uses.iter().map(|q| name(q).chars().count()).fold(8, usize::max);
    let truth = if uses.iter().any(|q| q.truth.is_some()) { format!("{:>13}{:>10}", "true curve", "apart") } else { String::new() };
    let _ = writeln!(text, "  {:<width$}  {:<24}{:>14}{truth}", "In use", "value ± u", "Monte Carlo u");
    for q in uses {
        let rounded = Rounded::new(q.value, q.standard_uncertainty).map_or_else(|| "–".to_owned(), |r| r.with_unit(""));
        let truth = q.truth.map_or_else(String::new, |truth| {
            let apart = (q.value - truth) / q.standard_uncertainty;
            let apart = if apart.is_finite() { format!("{apart:+.1} u").replace('-', "−") } else { String::new() };
            format!("{:>13}{apart:>10}", format_significant(truth, 6))
        });
        let _ = writeln!(text, "  {:<width$}  {:<24}{:>14}{truth}", name(q), rounded.trim(), format_significant(q.monte_carlo, 2));
    }
    let apart = |q: &&Propagated| (q.monte_carlo / q.standard_uncertainty - 1.0).abs() > LINEAR;
    let bent: Vec<&str> = uses.iter().filter(apart).map(|q| q.name.as_str()).collect();
    if !bent.is_empty() {
        let _ = writeln!(
            text,
            "  The linear u and that of {DRAWS} draws differ for {}: the curve is too uncertain for linear propagation.",
            bent.join(", ")
        );
    }
}

fn curve_rows(text: &mut String, calibrated: &Calibrated, channel: &CalibratedChannel) {
    let nodes = calibrated.nodes_nm.len();
    let every = nodes.saturating_sub(1).div_ceil(ROWS - 1).max(1);
    let truth = if channel.truth.is_some() { "        truth" } else { "" };
    let _ = writeln!(text, "  nm        s ± u{truth:>28}   open");
    for k in (0..nodes).step_by(every) {
        let (s, u) = (channel.curve.values[k], channel.standard_uncertainties[k]);
        let rounded = Rounded::new(s, u).map_or_else(|| "–".to_owned(), |r| r.with_unit(""));
        let truth = channel.truth.as_ref().map_or_else(String::new, |t| format!("{:>12}", format_significant(t[k], 5)));
        let open = 100.0 * channel.curve.undetermined[k];
        let _ = writeln!(text, "  {:<8}  {:<22}{truth}   {open:>3.0} %", calibrated.nodes_nm[k], rounded.trim());
    }
}
