//! Charts of a data sheet: responsivity beside its target, deviation from the cosine, mismatch of lamps.

use crate::characterization::sheet::{ChannelSheet, DataSheet};
use crate::report::plot::chart::{Axis, Chart, Curve, Ink};

/// Every chart of a sheet, with the stem of its file.
#[must_use]
pub fn charts(sheet: &DataSheet) -> Vec<(String, Chart)> {
    let mut charts: Vec<(String, Chart)> = directional(sheet).map(|chart| ("directional".to_owned(), chart)).into_iter().collect();
    for channel in &sheet.channels {
        let several = sheet.channels.len() > 1;
        let stem = |what: &str| if several { format!("{what}-{}", stem_of(&channel.name)) } else { what.to_owned() };
        charts.extend(responsivity(sheet, channel).map(|chart| (stem("responsivity"), chart)));
        charts.extend(lamps(sheet, channel).map(|chart| (stem("lamps"), chart)));
    }
    charts
}

/// A name as part of the name of a file.
fn stem_of(name: &str) -> String {
    name.chars().map(|c| if c.is_alphanumeric() || c == '_' || c == '-' { c } else { '-' }).collect()
}

/// The measured responsivity as it is adjusted, its target behind, and ten times their difference; `None` without a target.
fn responsivity(sheet: &DataSheet, channel: &ChannelSheet) -> Option<Chart> {
    let found = &channel.responsivity;
    let target = channel.target.as_ref();
    let peak = found.readings.iter().map(|f| f.value).fold(0.0, f64::max);
    // A target has its own scale; the sensor is brought to it as it would be adjusted.
    let (scale, unit) = match target {
        Some(target) => {
            let sum = |s: &dyn Fn(usize, f64) -> f64| -> f64 {
                found.wavelengths_nm.iter().enumerate().map(|(i, nm)| target.calibration.continuum_at(*nm) * s(i, *nm)).sum()
            };
            let top = found.wavelengths_nm.iter().map(|nm| target.curve.at(*nm)).fold(0.0, f64::max);
            let adjusted = sum(&|_, nm| target.curve.at(nm)) / sum(&|i, _| found.readings[i].value);
            (adjusted / top, 1.0 / top)
        }
        None => (1.0 / peak, 1.0),
    };
    if !(scale.is_finite() && scale > 0.0) {
        return None;
    }
    let seen: Vec<f64> = found
        .wavelengths_nm
        .iter()
        .zip(&found.readings)
        .filter(|(nm, f)| f.value > 1e-4 * peak || target.is_some_and(|t| unit * t.curve.at(**nm) > 1e-4))
        .map(|(nm, _)| *nm)
        .collect();
    let (from, to) = (seen.first()? - 10.0, seen.last()? + 10.0);
    let points = |y: &dyn Fn(usize, f64) -> f64| -> Vec<[f64; 2]> {
        let inside = found.wavelengths_nm.iter().enumerate().filter(|(_, nm)| (from..=to).contains(*nm));
        inside.map(|(i, nm)| [*nm, y(i, *nm)]).collect()
    };
    let measured = points(&|i, _| scale * found.readings[i].value);
    let top = measured.iter().map(|p| p[1]).fold(1.0, f64::max);
    let mut curves = Vec::new();
    let mut low = 0.0;
    if let Some(target) = target {
        let apart = points(&|i, nm| scale * found.readings[i].value - unit * target.curve.at(nm));
        let largest = apart.iter().map(|p| p[1].abs()).fold(0.0, f64::max);
        // As large as fits under the peak.
        let times = [100.0, 50.0, 20.0, 10.0, 5.0, 2.0].into_iter().find(|k| k * largest <= top).unwrap_or(1.0);
        let difference: Vec<[f64; 2]> = apart.iter().map(|p| [p[0], times * p[1]]).collect();
        let zero = vec![[from, 0.0], [to, 0.0]];
        low = difference.iter().map(|p| p[1]).fold(0.0, f64::min).max(-top);
        curves.push(Curve::new(&target.name, points(&|_, nm| unit * target.curve.at(nm)), Ink::Muted).behind());
        curves.push(Curve::new("zero", zero, Ink::Grid).unwritten());
        curves.push(Curve::new(&format!("{times} × difference"), difference, Ink::Palette(1)));
    }
    curves.push(Curve::new(&format!("{}, measured", channel.name), measured, Ink::Palette(0)));
    let adjusted = target.map_or("relative to the peak", |_| "as adjusted");
    let x = Axis::linear("Wavelength λ", "nm", from, to);
    let y = Axis::linear("Relative spectral responsivity", "1 at the peak of the target", 1.1 * low, 1.08 * top);
    let mut chart = Chart::new("Spectral responsivity", &format!("{}; {adjusted}, by lines of a monochromator", sheet.title), x, y);
    chart.curves = curves;
    Some(chart)
}

/// R(ε)/R(0) − 1 in each plane of the goniometer.
fn directional(sheet: &DataSheet) -> Option<Chart> {
    let found = sheet.goniogram.as_ref()?;
    let curves: Vec<Curve> = (0..found.phi_rad.len())
        .map(|plane| {
            let points = found.theta_rad.iter().zip(found.response(plane)).map(|(t, r)| [t.to_degrees(), 100.0 * (r.value - 1.0)]);
            let label =
                if found.phi_rad.len() == 1 { "measured".to_owned() } else { format!("φ = {:.0}°", found.phi_rad[plane].to_degrees()) };
            Curve::new(&label, points.collect(), Ink::Palette(plane))
        })
        .collect();
    let (low, high) = curves.iter().flat_map(|c| &c.points).fold((-1.0_f64, 1.0_f64), |(low, high), p| (low.min(p[1]), high.max(p[1])));
    let margin = 0.08 * (high - low);
    let to = found.theta_rad.last()?.to_degrees();
    let x = Axis::linear("Angle of incidence ε", "°", 0.0, to);
    let y = Axis::linear("Deviation from the cosine", "%", low - margin, high + margin);
    let mut chart = Chart::new("Directional response", &format!("{}; by goniometer", sheet.title), x, y);
    chart.curves.push(Curve::new("cos ε", vec![[0.0, 0.0], [to, 0.0]], Ink::Muted).behind());
    chart.curves.extend(curves);
    Some(chart)
}

/// What the meter reads too much for each lamp, in percent, as bars.
fn lamps(sheet: &DataSheet, channel: &ChannelSheet) -> Option<Chart> {
    use crate::report::plot::chart::Area;
    if channel.lamps.is_empty() {
        return None;
    }
    let off: Vec<f64> = channel.lamps.iter().map(|lamp| 100.0 / lamp.measured.value - 100.0).collect();
    let (low, high) = off.iter().fold((-0.5_f64, 0.5_f64), |(low, high), y| (low.min(*y), high.max(*y)));
    let margin = 0.08 * (high - low);
    let count = off.len() as f64;
    // The first lamp on top.
    let row = |i: usize| count - i as f64 - 0.5;
    let x = Axis::linear("Reading over truth − 1", "%", low - margin, high + margin);
    let ticks = channel.lamps.iter().enumerate().map(|(i, lamp)| (row(i), lamp.name.clone())).collect();
    let y = Axis { ticks, ..Axis::linear("Lamp", "by name", 0.0, count) };
    let adjusted = channel.target.as_ref().map_or("", |target| target.calibration_name);
    let subtitle = format!("{}, {}; adjusted with {adjusted}", sheet.title, channel.name);
    let mut chart = Chart::new("Spectral mismatch of lamps", &subtitle, x, y);
    for (i, off) in off.iter().enumerate() {
        let (lower, upper) = (row(i) - 0.35, row(i) + 0.35);
        chart.areas.push(Area {
            points: vec![[0.0, lower], [*off, lower], [*off, upper], [0.0, upper]],
            ink: Ink::Palette(usize::from(*off < 0.0)),
            opacity: 0.85,
        });
    }
    chart.curves.push(Curve::new("truth", vec![[0.0, 0.0], [0.0, count]], Ink::Muted).behind().unwritten());
    Some(chart)
}
