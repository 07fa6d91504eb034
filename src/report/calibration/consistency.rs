//! Readings that contradict the rest, in words.

use std::fmt::Write;

use crate::calibration::consistency::LEVEL;
use crate::metrology::rounding::format_significant;
use crate::study::calibrate::CalibratedChannel;

/// Readings and pairs of readings that are told one by one.
const TOLD: usize = 12;

/// Says which readings contradict the rest, or that none does.
pub(super) fn consistency_text(text: &mut String, channel: &CalibratedChannel) {
    let (curve, unit) = (&channel.curve, channel.readings.measurand.unit());
    let found = &curve.consistency;
    let told = found.studentised.iter().flatten().count();
    if told == 0 {
        return;
    }
    let limit = format_significant(found.limit, 2);
    if found.outliers.is_empty() {
        let worst = found.studentised.iter().flatten().fold(0.0f64, |most, t| most.max(t.abs()));
        // So many contradict each other that none was named: a remark says so.
        if worst <= found.limit {
            let _ = writeln!(
                text,
                "  No reading contradicts the others: each left out in turn, the worst is {} u from what the rest expects; {limit} u is told.",
                format_significant(worst, 2)
            );
        }
    } else {
        let _ = writeln!(
            text,
            "  Readings that contradict the others (beyond {limit} u, which noise alone exceeds in {} of 100 campaigns):",
            format_significant(100.0 * LEVEL, 1)
        );
        for outlier in found.outliers.iter().take(TOLD) {
            let weight = curve.weights.get(outlier.index).copied().filter(|w| *w != 1.0);
            let weight = weight.map_or_else(String::new, |w| format!("; weight {}", format_significant(w, 2)));
            let _ = writeln!(
                text,
                "    {}: reads {} {unit}, the others expect {} {unit}: {} u{weight}",
                outlier.label,
                format_significant(outlier.reading, 5),
                format_significant(outlier.expected, 5),
                format!("{:+.1}", outlier.studentised).replace('-', "−"),
            );
        }
        more(text, found.outliers.len());
        if curve.weights.iter().all(|w| *w == 1.0) {
            text.push_str("    The curve takes them as they are stated. Read them again, or weigh them down with --robust.\n");
        }
    }
    if !found.contradictions.is_empty() {
        text.push_str("  Readings of the same light that contradict each other, whatever the curve is:\n");
        for pair in found.contradictions.iter().take(TOLD) {
            let _ = writeln!(
                text,
                "    {} and {}: {} {unit} and {} {unit}, {} u apart",
                pair.labels[0],
                pair.labels[1],
                format_significant(pair.readings[0], 5),
                format_significant(pair.readings[1], 5),
                format_significant(pair.in_u.abs(), 3)
            );
        }
        more(text, found.contradictions.len());
    }
}

fn more(text: &mut String, count: usize) {
    if count > TOLD {
        let _ = writeln!(text, "    and {} more", count - TOLD);
    }
}
