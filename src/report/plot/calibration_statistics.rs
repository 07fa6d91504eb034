//! More of a calibration: correlations of the curve, what the rules for the smoothness look at, mismatch before and after its correction.
//!
//! ```text
//! correlation    rₖₗ = Cₖₗ / √(Cₖₖ Cₗₗ), C with the common scale: white 0, red +1, blue −1
//! L-curve        |curve| in the norm of the prior against χ, a point a scale; the corner is the choice
//! GCV            χ²/(m − p)² against the scale
//! mismatch       1/F* − 1 without a correction; F*/F*(true) − 1 with it
//! ```

use crate::calibration::evidence::RulePoint;
use crate::study::calibrate::{Calibrated, CalibratedChannel};

use super::calibration::ink;
use super::chart::{Axis, Chart, Curve, Dash, Ink, Point, Shade, ShadeRow, Stop};
use super::sample::subscripted;

/// Most rows of a picture of correlations.
const ROWS: usize = 80;

/// All of them that there is something to draw for, each with a part of its file's name.
pub(super) fn charts(calibrated: &Calibrated) -> Vec<(String, Chart)> {
    let mut all = Vec::new();
    if let Some(channel) = calibrated.channels.first() {
        all.push(("correlation".to_owned(), correlation(calibrated, channel)));
        all.extend(mismatch(calibrated, channel).map(|chart| ("mismatch".to_owned(), chart)));
    }
    if calibrated.rule_points.iter().any(|points| !points.is_empty()) {
        all.push(("l-curve".to_owned(), l_curve(calibrated)));
        all.push(("gcv".to_owned(), cross_validation(calibrated)));
    }
    all
}

/// Correlations of the nodes of a channel as colours.
fn correlation(calibrated: &Calibrated, channel: &CalibratedChannel) -> Chart {
    let nodes = &calibrated.nodes_nm;
    let covariance = channel.curve.covariance();
    let (s, scale) = (&channel.curve.values, calibrated.scale_uncertainty);
    let of = |k: usize, l: usize| covariance[(k, l)] + scale * scale * s[k] * s[l];
    let step = nodes.len().div_ceil(ROWS).max(1);
    let picked: Vec<usize> = (0..nodes.len()).step_by(step).collect();
    let (first, last) = (nodes[picked[0]], nodes[picked[picked.len() - 1]]);
    let half = 0.5 * (last - first) / (picked.len().max(2) - 1) as f64;
    let (from, to) = (first - half, last + half);
    let row = |&k: &usize| {
        let colour = |&l: &usize| {
            let square = of(k, k) * of(l, l);
            Stop { x: nodes[l], colour: diverging(if square > 0.0 { of(k, l) / square.sqrt() } else { 0.0 }), opacity: 1.0 }
        };
        let mut stops: Vec<Stop> = picked.iter().map(colour).collect();
        // Half a step beyond the outer nodes, as high as rows are.
        if let (Some(&low), Some(&high)) = (stops.first(), stops.last()) {
            stops.insert(0, Stop { x: from, ..low });
            stops.push(Stop { x: to, ..high });
        }
        ShadeRow { from: nodes[k] - half, to: nodes[k] + half, stops }
    };
    let rows = picked.iter().map(row).collect();
    let axis = || Axis::linear("Wavelength λ", "nm", from, to);
    let title = format!("Correlations of the fitted curve, {}", subscripted(&channel.readings.channel));
    let mut chart = Chart::new(&title, "red: together, white: independent, blue: against each other", axis(), axis());
    chart.equal_scale = true;
    chart.proportion = Some(1.0);
    chart.shade = Some(Shade { outline: vec![[from, from], [to, from], [to, to], [from, to]], rows });
    chart
}

/// From blue at −1 through white to red at 1.
fn diverging(r: f64) -> [u8; 3] {
    let end = if r < 0.0 { [40.0, 90.0, 190.0] } else { [190.0, 45.0, 40.0] };
    let share = r.abs().min(1.0);
    end.map(|c: f64| (255.0 + share * (c - 255.0)).round() as u8)
}

/// Points of a rule that can be drawn on logarithmic axes, and the index of each.
fn finite(points: &[RulePoint]) -> Vec<(usize, &RulePoint)> {
    let positive = |x: f64| x.is_finite() && x > 0.0;
    points
        .iter()
        .enumerate()
        .filter(|(_, p)| positive(p.chi_squared) && positive(p.roughness) && positive(p.cross_validation) && positive(p.scale))
        .collect()
}

/// The scale of least cross-validation, and the stiffest whose residuals are as large as the noise.
fn marked(points: &[RulePoint], readings: usize) -> Vec<(&'static str, usize)> {
    let least =
        points.iter().enumerate().min_by(|a, b| a.1.cross_validation.total_cmp(&b.1.cross_validation)).map(|(i, _)| ("least GCV", i));
    let discrepancy = points.iter().position(|p| p.chi_squared <= readings as f64).map(|i| ("χ² = readings", i));
    least.into_iter().chain(discrepancy).collect()
}

fn of_rules(calibrated: &Calibrated, title: &str, axes: [(&str, &str); 2], at: impl Fn(&RulePoint) -> [f64; 2]) -> Chart {
    let (mut curves, mut points) = (Vec::new(), Vec::new());
    let (mut low, mut high) = ([f64::INFINITY; 2], [0.0f64; 2]);
    for (c, (channel, of)) in calibrated.channels.iter().zip(&calibrated.rule_points).enumerate() {
        let drawn: Vec<[f64; 2]> = finite(of).into_iter().map(|(_, p)| at(p)).collect();
        for p in &drawn {
            low = [low[0].min(p[0]), low[1].min(p[1])];
            high = [high[0].max(p[0]), high[1].max(p[1])];
        }
        curves.push(Curve::new(&subscripted(&channel.readings.channel), drawn, ink(c, channel)));
        points.extend(marked(of, channel.readings.values.len()).into_iter().map(|(label, i)| Point {
            label: label.to_owned(),
            at: at(&of[i]),
            ink: ink(c, channel),
            radius: 1.2,
            written: c == 0,
        }));
    }
    let axis = |k: usize| Axis::log(axes[k].0, axes[k].1, 0.8 * low[k], (1.25 * high[k]).max(low[k] * 2.0));
    Chart { curves, points, ..Chart::new(title, &calibrated.title, axis(0), axis(1)) }
}

fn l_curve(calibrated: &Calibrated) -> Chart {
    let axes = [("Residuals χ", "standard uncertainties"), ("Roughness of the curve", "prior's norm")];
    of_rules(calibrated, "L-curve", axes, |p| [p.chi_squared.sqrt(), p.roughness.sqrt()])
}

fn cross_validation(calibrated: &Calibrated) -> Chart {
    let axes = [("Scale a of the curve", "unit of the curve"), ("χ²/(m − p)²", "1")];
    of_rules(calibrated, "Generalised cross-validation", axes, |p| [p.scale, p.cross_validation])
}

/// Relative error of readings of each lamp, as adjusted with illuminant A and after the correction by the fitted curve.
fn mismatch(calibrated: &Calibrated, channel: &CalibratedChannel) -> Option<Chart> {
    let lamps: Vec<_> = channel.uses.iter().filter_map(|q| Some((q.name.strip_prefix("F* for ")?, q))).collect();
    if lamps.is_empty() {
        return None;
    }
    let (mut before, mut after, mut bars, mut largest) = (Vec::new(), Vec::new(), Vec::new(), 0.0f64);
    for (i, (name, q)) in lamps.iter().enumerate() {
        let x = i as f64 + 1.0;
        let truth = q.truth.unwrap_or(q.value);
        let (raw, corrected, u) = (100.0 * (1.0 / truth - 1.0), 100.0 * (q.value / truth - 1.0), 200.0 * q.standard_uncertainty / q.value);
        largest = largest.max(raw.abs()).max(corrected.abs() + u);
        let point =
            |label: &str, y: f64, ink: Ink| Point { label: format!("{name}, {label}"), at: [x, y], ink, radius: 1.2, written: false };
        before.push(point("before", raw, Ink::Palette(1)));
        after.push(point("after", corrected, Ink::Palette(0)));
        bars.push(Curve::new("", vec![[x, corrected - u], [x, corrected + u]], Ink::Palette(0)));
        bars.push(Curve::new("", vec![[x, raw], [x, corrected]], Ink::Muted).dashed(Dash::Dotted));
    }
    let ends = 0.5 + lamps.len() as f64;
    bars.push(Curve::new("", vec![[0.5, 0.0], [ends + 0.5, 0.0]], Ink::Muted).behind());
    if let (Some(first), Some(last)) = (before.first_mut(), after.last_mut()) {
        (first.label, first.written) = ("before".to_owned(), true);
        (last.label, last.written) = ("after, ±2 u".to_owned(), true);
    }
    let mut x = Axis::linear("Lamp", "adjusted with A", 0.5, ends + 0.5);
    x.ticks = lamps.iter().enumerate().map(|(i, (name, _))| (i as f64 + 1.0, (*name).to_owned())).collect();
    let y = Axis::linear("Error of the reading", "%", -1.2 * largest, 1.2 * largest);
    let what = if channel.truth.is_some() { "against the true curve" } else { "by the fitted curve" };
    let title = format!("Spectral mismatch before and after its correction, {}", subscripted(&channel.readings.channel));
    let chart = Chart::new(&title, &format!("{}; {what}", calibrated.sensor), x, y);
    Some(Chart { curves: bars, points: before.into_iter().chain(after).collect(), ..chart })
}
