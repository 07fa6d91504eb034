//! The photon-transfer plot: temporal variance over mean, both above the dark, with the fit and the saturation.

use crate::characterization::emva::{FITTED_UP_TO, Figures};
use crate::characterization::sheet::camera::CameraSheet;
use crate::metrology::rounding::Rounded;
use crate::report::plot::chart::{Anchor, Axis, Chart, Curve, Dash, Ink, Note, Point};

/// A photon-transfer plot for each channel of a camera, with the stem of its file.
#[must_use]
pub fn charts(sheet: &CameraSheet) -> Vec<(String, Chart)> {
    let of = |name: &str| -> String { name.chars().map(|c| if c.is_alphanumeric() || c == '_' { c } else { '-' }).collect() };
    let several = sheet.channels.len() > 1;
    let charts = sheet.channels.iter().map(|channel| {
        let stem = if several { format!("photon-transfer-{}", of(&channel.name)) } else { "photon-transfer".to_owned() };
        let title = format!("{}, {} at {} nm", sheet.title, channel.name, channel.wavelength_nm);
        (stem, photon_transfer(&title, &channel.measured))
    });
    charts.collect()
}

/// Variance over mean.
#[must_use]
pub fn photon_transfer(title: &str, figures: &Figures) -> Chart {
    let places: Vec<[f64; 2]> = figures.points.iter().map(Figures::above_dark).map(|(mean, variance)| [mean, variance]).collect();
    let largest = |axis: usize| places.iter().map(|at| at[axis]).fold(f64::MIN_POSITIVE, f64::max);
    let saturation = places.get(figures.saturation).copied().unwrap_or([0.0, 0.0]);
    let (right, top) = (1.08 * largest(0), 1.25 * largest(1));
    let x = Axis::linear("Mean above the dark μ_y − μ_y.dark", "DN", 0.0, right);
    let y = Axis::linear("Temporal variance above the dark σ_y² − σ_y.dark²", "DN²", 0.0, top);
    let mut chart = Chart::new("Photon transfer", title, x, y);
    if let Some(gain) = figures.get("gain_dn_per_e") {
        let fitted = FITTED_UP_TO * saturation[0];
        let end = saturation[0].min(top / gain.value);
        let on = |mean: f64| [mean, gain.value * mean];
        let slope = Rounded::new(gain.value, gain.standard_uncertainty).map(|r| format!("K = {r} DN/e⁻")).unwrap_or_default();
        chart.curves.push(Curve::new("line beyond the fit", vec![on(fitted), on(end)], Ink::Palette(1)).dashed(Dash::Dotted).unwritten());
        chart.curves.push(Curve::new("fit through the origin", vec![[0.0, 0.0], on(fitted)], Ink::Palette(1)).unwritten());
        let middle = on(0.5 * fitted);
        chart.notes.push(Note { text: slope, at: middle, shift_em: [1.2, -0.8], anchor: Anchor::Start, ink: Ink::Palette(1) });
    }
    chart
        .curves
        .push(Curve::new("saturation", vec![[saturation[0], 0.0], saturation], Ink::Muted).behind().dashed(Dash::Dashed).unwritten());
    chart.points.extend(places.iter().enumerate().map(|(i, at)| {
        let saturated = i == figures.saturation;
        let label = if saturated { "saturation".to_owned() } else { String::new() };
        Point { label, at: *at, ink: Ink::Palette(0), radius: if saturated { 1.0 } else { 0.55 }, written: false }
    }));
    let text = figures.get("saturation_e").and_then(|f| Rounded::new(f.value, f.standard_uncertainty));
    let text = text.map(|r| format!("saturation: μ_e.sat = {r} e⁻")).unwrap_or_default();
    chart.notes.push(Note { text, at: saturation, shift_em: [1.0, 2.2], anchor: Anchor::End, ink: Ink::Text });
    chart
}
