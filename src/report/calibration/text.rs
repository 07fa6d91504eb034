//! A calibration as a page for a person.

use std::fmt::Write;

use crate::metrology::rounding::{Rounded, format_significant};
use crate::study::calibrate::{Calibrated, CalibratedChannel};

/// Rows of the curve that are printed; the files hold them all.
const ROWS: usize = 17;
/// Share of a reading from outside of the nodes that is told.
const TOLD_OUTSIDE: f64 = 1e-4;

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
    let _ = writeln!(text, "{rays}; curves smooth over {:.0} nm ({})", calibrated.prior.1, calibrated.prior.0);
    if calibrated.scale_uncertainty > 0.0 {
        let _ =
            writeln!(text, "common to all readings: {} % of the irradiance", format_significant(100.0 * calibrated.scale_uncertainty, 2));
    }
    for channel in &calibrated.channels {
        text.push('\n');
        channel_text(&mut text, calibrated, channel);
    }
    if !calibrated.suggestions.is_empty() {
        text.push_str("\nFurther exposures that would help most\n");
        for (i, s) in calibrated.suggestions.iter().enumerate() {
            let percent = |x: f64| format_significant(100.0 * x, 3);
            let _ = writeln!(
                text,
                "  {}. {}: u of the curve {} % → {} % of its peak (RMS)",
                i + 1,
                s.label,
                percent(s.before),
                percent(s.after)
            );
        }
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
    match channel.unseen_nm.as_slice() {
        [] => text.push_str("  The readings determine the curve at every node.\n"),
        ranges => {
            let words: Vec<String> = ranges.iter().map(|(a, b)| format!("{a} nm to {b} nm")).collect();
            let _ = writeln!(text, "  The readings do not determine the curve at {}: there it is a guess.", words.join(", "));
        }
    }
    if let Some((share, label)) = channel.outside.as_ref().filter(|(share, _)| *share > TOLD_OUTSIDE) {
        let _ = writeln!(
            text,
            "  Up to {} % of a reading ({label}) comes from wavelengths outside of the curve; the fit does not know them. Widen `curve`.",
            format_significant(100.0 * share, 2)
        );
    }
    curve_rows(text, calibrated, channel);
    if !channel.uses.is_empty() {
        let truth = if channel.truth.is_some() { "      true curve   apart by" } else { "" };
        let _ = writeln!(text, "  In use              value ± u (linear)        u (Monte Carlo){truth}");
        for q in &channel.uses {
            let rounded = Rounded::new(q.value, q.standard_uncertainty).map_or_else(|| "–".to_owned(), |r| r.with_unit(""));
            let truth = q.truth.map_or_else(String::new, |truth| {
                let apart = (q.value - truth) / q.standard_uncertainty;
                let apart = if apart.is_finite() { format!("{apart:+.1} u").replace('-', "−") } else { String::new() };
                format!("   {:>12}   {apart:>8}", format_significant(truth, 6))
            });
            let unit = if q.unit == "1" { String::new() } else { format!(" ({} {})", channel.readings.measurand.unit(), q.unit) };
            let name = format!("{}{unit}", q.name);
            let _ = writeln!(text, "  {name:<18}  {:<26}{:<12}{truth}", rounded.trim(), format_significant(q.monte_carlo, 2));
        }
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
