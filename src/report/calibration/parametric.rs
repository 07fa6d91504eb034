//! Parameters of a fitted model, in words.

use std::fmt::Write;

use crate::calibration::parametric_fit::Parametric;
use crate::metrology::rounding::{Rounded, format_significant};
use crate::study::calibrate::{Calibrated, CalibratedChannel};

/// Standard deviations of χ² beyond which a model is said not to explain the readings.
const MISFIT: f64 = 3.0;

/// The parameters, how well the model explains the readings, and where it alone says how the curve goes on.
pub(super) fn parametric_text(text: &mut String, calibrated: &Calibrated, channel: &CalibratedChannel, fit: &Parametric) {
    let (chi_squared, nu) = (channel.curve.chi_squared, fit.degrees_of_freedom as f64);
    let _ = writeln!(
        text,
        "  Model: {}; {} of {} searches end in a minimum, the lowest is taken",
        calibrated.prior.0, fit.searches.1, fit.searches.0
    );
    for p in &fit.parameters {
        let unit = if p.unit.is_empty() { channel.unit.as_str() } else { p.unit };
        let unit = if unit == "1" { "" } else { unit };
        let value = Rounded::new(p.value, p.standard_uncertainty).map_or_else(|| "–".to_owned(), |r| r.with_unit(unit));
        let open = if p.determined { "" } else { "   not determined by the readings: what was plausible before" };
        let _ = writeln!(text, "    {:<22}{}{open}", p.name, value.trim());
    }
    if fit.degrees_of_freedom == 0 {
        text.push_str("  As many parameters as readings: nothing shows whether the model holds.\n");
    } else if chi_squared > nu + MISFIT * (2.0 * nu).sqrt() {
        let _ = writeln!(
            text,
            "  The model does not explain the readings: χ²/ν = {} (ν = {nu}). Uncertainties are widened by {}, which is the least that this means; take another \
             model, or none.",
            format_significant(chi_squared / nu, 3),
            format_significant(fit.widening, 3)
        );
    } else {
        let widened = if fit.widening > 1.0 {
            format!("; uncertainties are widened by {}", format_significant(fit.widening, 3))
        } else {
            String::new()
        };
        let _ =
            writeln!(text, "  The model explains the readings: χ²/ν = {} (ν = {nu}){widened}.", format_significant(chi_squared / nu, 2));
    }
    let nodes = &calibrated.nodes_nm;
    let ends = calibrated.exposures.lit_nm().zip(nodes.first().copied().zip(nodes.last().copied()));
    if let Some(((from, to), (first, last))) = ends.filter(|((from, to), (first, last))| from > first || to < last) {
        let low = if from > first { format!("below {from} nm") } else { String::new() };
        let high = if to < last { format!("above {to} nm") } else { String::new() };
        let and = if low.is_empty() || high.is_empty() { "" } else { " and " };
        let _ = writeln!(
            text,
            "  No exposure has light {low}{and}{high}: there, and wherever no exposure shines, the curve rests on the model alone."
        );
    }
}
