//! A calibration: fitted curves with their bands against readings and truth, what they miss, residuals, averaging kernels.
//!
//! ```text
//! band       s ± 2 u          shaded   what the readings do not determine          points   yᵢ / Σₖ Aᵢₖ at the exposure's mean wavelength
//! kernels    rows of G A: how a node of the fitted curve weighs the true one
//! ```

use crate::study::calibrate::{Calibrated, CalibratedChannel};

use super::PlotError;
use super::chart::{Axis, Band, Chart, Curve, Dash, Ink, Point, Span};
use super::sample::{strip, subscripted};

/// Half-width of the band in standard uncertainties.
const COVERAGE: f64 = 2.0;
/// Exposures beyond which readings are not drawn as points: broad light has no wavelength of its own.
const NARROW_NM: f64 = 40.0;
/// How many averaging kernels are drawn.
const KERNELS: usize = 9;
/// Share of the axis that a span takes if the words "not determined" stand in it: inside of the picture, and at its ends.
const ROOM: (f64, f64) = (0.05, 0.15);

/// All pictures, each with a part of its file's name.
///
/// # Errors
/// A calibration without channels.
pub fn charts(calibrated: &Calibrated) -> Result<Vec<(String, Chart)>, PlotError> {
    let mut all = vec![("fit".to_owned(), fit(calibrated)?), ("residuals".to_owned(), residuals(calibrated)?)];
    all.extend(deviations(calibrated).map(|chart| ("deviations".to_owned(), chart)));
    if let Some(first) = calibrated.channels.first() {
        all.push(("kernels".to_owned(), kernels(calibrated, first)));
    }
    all.extend(super::calibration_statistics::charts(calibrated));
    Ok(all)
}

fn range(calibrated: &Calibrated) -> (f64, f64) {
    let nodes = &calibrated.nodes_nm;
    (nodes.first().copied().unwrap_or(380.0), nodes.last().copied().unwrap_or(780.0))
}

fn unseen(calibrated: &Calibrated, channel: &CalibratedChannel) -> Vec<Span> {
    // The widest may have room for the words, which reach beyond a narrow one: not where the picture ends.
    let (first, last) = range(calibrated);
    let width = |i: &usize| channel.unseen_nm[*i].1 - channel.unseen_nm[*i].0;
    let widest = (0..channel.unseen_nm.len()).max_by(|a, b| width(a).total_cmp(&width(b)));
    let inside = |i: &usize| channel.unseen_nm[*i].0 > first && channel.unseen_nm[*i].1 < last;
    let widest = widest.filter(|i| width(i) > if inside(i) { ROOM.0 } else { ROOM.1 } * (last - first));
    let label = |i: usize| if Some(i) == widest { "not determined".to_owned() } else { String::new() };
    channel.unseen_nm.iter().enumerate().map(|(i, &(from, to))| Span { label: label(i), from, to }).collect()
}

/// Channels for red, green and blue have these colours, as their names say.
pub(super) fn ink(index: usize, channel: &CalibratedChannel) -> Ink {
    let name = channel.readings.channel.to_lowercase();
    match name.split_whitespace().next().unwrap_or_default() {
        "r" | "red" => Ink::Fixed([200, 50, 45]),
        "g" | "green" => Ink::Fixed([40, 140, 70]),
        "b" | "blue" => Ink::Fixed([45, 95, 200]),
        _ => Ink::Palette(index),
    }
}

/// Fit minus truth, with the band that the fit claims, in percent of each curve's peak; none if the truth is not known.
fn deviations(calibrated: &Calibrated) -> Option<Chart> {
    let (from, to) = range(calibrated);
    let first = calibrated.channels.first()?;
    let (mut curves, mut bands, mut largest) = (Vec::new(), Vec::new(), 0.0f64);
    for (c, channel) in calibrated.channels.iter().enumerate() {
        let truth = channel.truth.as_ref()?;
        let peak = truth.iter().fold(0.0f64, |most, s| most.max(*s));
        if peak <= 0.0 {
            return None;
        }
        let (ink, percent) = (ink(c, channel), 100.0 / peak);
        let nodes = || calibrated.nodes_nm.iter().enumerate();
        let u = |k: usize| COVERAGE * percent * channel.standard_uncertainties[k];
        let apart: Vec<[f64; 2]> = nodes().map(|(k, nm)| [*nm, percent * (channel.curve.values[k] - truth[k])]).collect();
        largest = apart.iter().fold(largest, |most, p| most.max(p[1].abs()));
        // The ends of a curve may be far less certain: they are cut at the frame.
        let mut widths: Vec<f64> = nodes().map(|(k, _)| u(k)).collect();
        widths.sort_by(f64::total_cmp);
        largest = largest.max(widths[widths.len() * 9 / 10]);
        bands.push(Band {
            label: format!("{}, ±2 u", channel.readings.channel),
            points: nodes().map(|(k, nm)| [*nm, -u(k), u(k)]).collect(),
            ink,
        });
        curves.push(Curve::new(&subscripted(&channel.readings.channel), apart, ink));
    }
    let top = 1.2 * largest.max(f64::MIN_POSITIVE);
    bands.iter_mut().flat_map(|band| &mut band.points).for_each(|p| (p[1], p[2]) = (p[1].max(-top), p[2].min(top)));
    let x = Axis::linear("Wavelength λ", "nm", from, to);
    let y = Axis::linear("Fit minus truth", "% of the peak", -top, top);
    let subtitle = format!("{}; band: ±2 u about zero", calibrated.sensor);
    let title = format!("{}: what the fit misses", calibrated.title);
    Some(Chart { curves, bands, spans: unseen(calibrated, first), strip: strip(from, to), ..Chart::new(&title, &subtitle, x, y) })
}

/// The curves of all channels.
///
/// # Errors
/// A calibration without channels.
pub fn fit(calibrated: &Calibrated) -> Result<Chart, PlotError> {
    let Some(first) = calibrated.channels.first() else {
        return Err(PlotError::Nothing { what: "the calibration has no channel".to_owned() });
    };
    let (from, to) = range(calibrated);
    let nodes = &calibrated.nodes_nm;
    let several = calibrated.channels.len() > 1;
    let mut curves = Vec::new();
    let (mut bands, mut points) = (Vec::new(), Vec::new());
    let mut highest = 0.0f64;
    for (c, channel) in calibrated.channels.iter().enumerate() {
        let name = subscripted(&channel.readings.channel);
        let values = &channel.curve.values;
        let u = &channel.standard_uncertainties;
        highest = values.iter().chain(channel.truth.iter().flatten()).fold(highest, |most, s| most.max(*s));
        let pairs = |y: &[f64]| nodes.iter().zip(y).map(|(nm, s)| [*nm, *s]).collect::<Vec<_>>();
        bands.push(Band {
            label: format!("{name}, ±2 u"),
            points: (0..nodes.len()).map(|k| [nodes[k], (values[k] - COVERAGE * u[k]).max(0.0), values[k] + COVERAGE * u[k]]).collect(),
            ink: ink(c, channel),
        });
        curves.push(Curve::new(&if several { name.clone() } else { "fit".to_owned() }, pairs(values), ink(c, channel)));
        if let Some(truth) = &channel.truth {
            let curve = Curve::new("truth", pairs(truth), Ink::Text).dashed(Dash::Dashed);
            curves.push(if several { curve.unwritten() } else { curve });
        }
        points.extend(narrow_readings(calibrated, channel).into_iter().map(|at| Point {
            label: String::new(),
            at,
            ink: ink(c, channel),
            radius: 0.55,
            written: false,
        }));
    }
    highest = points.iter().fold(highest, |most, p| most.max(p.at[1]));
    let top = 1.12 * highest.max(f64::MIN_POSITIVE);
    // A band that is far wider than the curve is cut at the frame: its width is in the table.
    bands.iter_mut().flat_map(|band| &mut band.points).for_each(|p| (p[1], p[2]) = (p[1].min(top), p[2].min(top)));
    let x = Axis::linear("Wavelength λ", "nm", from, to);
    let y = Axis::linear("Spectral responsivity", &first.unit, 0.0, top);
    let origin = if calibrated.simulated { "simulated readings" } else { "readings" };
    let subtitle = format!("{}; {} {origin}; band: ±2 u", calibrated.sensor, calibrated.labels.len());
    Ok(Chart {
        curves,
        bands,
        points,
        spans: unseen(calibrated, first),
        strip: strip(from, to),
        ..Chart::new(&calibrated.title, &subtitle, x, y)
    })
}

/// Mean wavelength and reading over weight of exposures that are narrow.
fn narrow_readings(calibrated: &Calibrated, channel: &CalibratedChannel) -> Vec<[f64; 2]> {
    let readings = channel.curve.residuals.len().min(calibrated.centres_nm.len());
    (0..readings)
        .filter_map(|i| {
            let row = calibrated.exposures.row(i);
            let sum: f64 = row.iter().sum();
            let centre = calibrated.centres_nm[i];
            let spread = row.iter().zip(&calibrated.nodes_nm).map(|(a, nm)| a * (nm - centre).powi(2)).sum::<f64>() / sum;
            let at = [centre, channel.readings.values[i] / channel.per_irradiance / sum];
            (sum > 0.0 && spread.sqrt() < NARROW_NM / 2.0 && at[0] >= calibrated.nodes_nm[0] && at[1] >= 0.0).then_some(at)
        })
        .collect()
}

/// Residuals in units of the stated uncertainties.
///
/// # Errors
/// A calibration without readings.
pub fn residuals(calibrated: &Calibrated) -> Result<Chart, PlotError> {
    let all = calibrated.channels.iter().flat_map(|c| &c.curve.residuals);
    let largest = all.fold(2.5f64, |most, r| most.max(r.abs()));
    if calibrated.labels.is_empty() {
        return Err(PlotError::Nothing { what: "the calibration has no readings".to_owned() });
    }
    let count = calibrated.labels.len() as f64;
    let y = Axis::linear("Residual", "standard uncertainties", -1.1 * largest, 1.1 * largest);
    let mut chart = Chart::new("Residuals of the fit", &calibrated.title, Axis::linear("Exposure", "number", 0.0, count + 1.0), y);
    for level in [-2.0, 0.0, 2.0] {
        chart.curves.push(Curve::new("", vec![[0.0, level], [count + 1.0, level]], Ink::Muted).behind());
    }
    for (c, channel) in calibrated.channels.iter().enumerate() {
        chart.points.extend(channel.curve.residuals.iter().enumerate().map(|(i, r)| Point {
            label: calibrated.labels.get(i).cloned().unwrap_or_default(),
            at: [i as f64 + 1.0, *r],
            ink: ink(c, channel),
            radius: 0.7,
            written: false,
        }));
    }
    Ok(chart)
}

/// Averaging kernels of some nodes of a channel.
fn kernels(calibrated: &Calibrated, channel: &CalibratedChannel) -> Chart {
    let nodes = &calibrated.nodes_nm;
    let (from, to) = range(calibrated);
    let rows: Vec<Vec<f64>> = (0..calibrated.exposures.len()).map(|i| calibrated.exposures.row(i)).collect();
    let mut curves = Vec::new();
    for j in 0..KERNELS {
        let k = ((nodes.len() - 1) as f64 * (j as f64 + 0.5) / KERNELS as f64).round() as usize;
        // Over the width that a node stands for, so that kernels on any nodes compare: 1/nm.
        let per_nm = |l: usize| 0.5 * (nodes[(l + 1).min(nodes.len() - 1)] - nodes[l.saturating_sub(1)]);
        let points: Vec<[f64; 2]> = (0..nodes.len())
            .map(|l| {
                let weight: f64 = rows.iter().enumerate().map(|(i, row)| channel.curve.gain[(k, i)] * row[l]).sum();
                [nodes[l], weight / per_nm(l)]
            })
            .collect();
        curves.push(Curve::new(&format!("{:.0} nm", nodes[k]), points, super::sample::wavelength_ink(nodes[k])));
    }
    let ends = curves.iter().flat_map(|c| &c.points).fold((0.0f64, 0.0f64), |(low, high), p| (low.min(p[1]), high.max(p[1])));
    let y = Axis::linear("Weight of the true curve", "1/nm", 1.1 * ends.0, 1.1 * ends.1.max(f64::MIN_POSITIVE));
    let title = format!("Averaging kernels, {}", subscripted(&channel.readings.channel));
    let x = Axis::linear("Wavelength λ", "nm", from, to);
    Chart { curves, spans: unseen(calibrated, channel), strip: strip(from, to), ..Chart::new(&title, &calibrated.title, x, y) }
}
