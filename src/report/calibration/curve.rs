//! Curves of a calibration as CSV files.

use std::fmt::Write;

use crate::calibration::propagation;
use crate::characterization::campaign::ChannelReadings;
use crate::spectrum::file::{Meaning, write_csv};
use crate::spectrum::{Outside, SpectrumError, Table};
use crate::study::calibrate::{Calibrated, CalibratedChannel};

/// Where a curve comes from, as lines of a header.
fn header(calibrated: &Calibrated, channel: &CalibratedChannel) -> Vec<(String, String)> {
    let origin =
        if calibrated.simulated { format!("simulated readings, seed {}", calibrated.seed) } else { "readings of a laboratory".to_owned() };
    [
        ("name", format!("{}: {}", calibrated.sensor, channel.readings.channel)),
        ("source", format!("{}; etendue {} calibrate, {origin}", calibrated.title, env!("CARGO_PKG_VERSION"))),
        ("licence", "whatever the readings allow".to_owned()),
        ("quantity", "spectral responsivity, fitted".to_owned()),
        ("unit", channel.unit.clone()),
        ("readings", calibrated.labels.len().to_string()),
        match calibrated.prior.1 {
            length if length.is_finite() => ("prior", format!("{}, {length:.0} nm", calibrated.prior.0)),
            _ => ("model", calibrated.prior.0.clone()),
        },
        ("simultaneous_factor_95", channel.simultaneous.map_or_else(|| "none".to_owned(), |k| format!("{k:.3}"))),
        ("not_determined_nm", in_words(&channel.unseen_nm)),
    ]
    .map(|(key, value)| (key.to_owned(), value))
    .to_vec()
}

fn in_words(ranges: &[(f64, f64)]) -> String {
    match ranges {
        [] => "none".to_owned(),
        _ => ranges.iter().map(|(a, b)| format!("{a} to {b}")).collect::<Vec<_>>().join("; "),
    }
}

/// The curve with its standard uncertainties, as sensor files read it.
///
/// # Errors
/// Nodes that are no table.
pub fn curve_to_csv(calibrated: &Calibrated, channel: &CalibratedChannel) -> Result<String, SpectrumError> {
    let table = Table::new(calibrated.nodes_nm.clone(), channel.curve.values.clone(), Outside::Zero)?;
    write_csv(&table, Some(&channel.standard_uncertainties), Meaning::Factor, &header(calibrated, channel))
}

/// A root F of the covariance, a row a node: covariance = F Fᵀ + u_s² s sᵀ, with u_s and s in the header and in the curve's file.
#[must_use]
pub fn covariance_root_to_csv(calibrated: &Calibrated, channel: &CalibratedChannel) -> String {
    let root = propagation::covariance_root(&channel.curve);
    let columns = root.first().map_or(0, Vec::len);
    let mut text = format!(
        "# covariance = F F^T + u_s^2 s s^T, unit ({})^2\n# u_s: {:e}, relative standard uncertainty common to the whole curve s\nwavelength_nm",
        channel.unit, calibrated.scale_uncertainty
    );
    (1..=columns).for_each(|j| text.push_str(&format!(",F{j}")));
    text.push('\n');
    for (nm, row) in calibrated.nodes_nm.iter().zip(&root) {
        let _ = write!(text, "{nm}");
        row.iter().for_each(|f| text.push_str(&format!(",{f:.7e}")));
        text.push('\n');
    }
    text
}

/// Readings of all channels, as `--data` reads them.
#[must_use]
pub fn readings_to_csv(calibrated: &Calibrated) -> String {
    let quoted = |name: &str| if name.contains([',', '"', '\n']) { format!("\"{}\"", name.replace('"', "\"\"")) } else { name.to_owned() };
    let mut text = "exposure".to_owned();
    let all: Vec<&ChannelReadings> =
        calibrated.channels.iter().map(|c| &c.readings).chain(calibrated.beam.iter().map(|b| &b.readings)).collect();
    for readings in &all {
        let unit = readings.measurand.unit();
        text.push_str(&format!(",{0} ({unit}),u({0}) ({unit})", quoted(&readings.channel)));
    }
    text.push('\n');
    for (i, label) in calibrated.labels.iter().enumerate() {
        text.push_str(&quoted(label));
        for readings in &all {
            text.push_str(&format!(",{:e},{:e}", readings.values[i], readings.standard_uncertainties[i]));
        }
        text.push('\n');
    }
    text
}
