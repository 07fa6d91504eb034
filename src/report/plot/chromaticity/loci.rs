//! Lines of a chromaticity diagram: spectral locus, purple line, Planckian and daylight locus, lines of equal correlated temperature.

use super::super::chart::{Anchor, Chart, Curve, Dash, Ink, Note};
use super::{Diagram, unnamed};
use crate::observer::colour::{Chromaticity, LOCUS_RANGE_NM, PlanckianLocus, Tristimulus, spectral_locus};
use crate::spectrum::{Density, Factor};

/// Temperatures with a line across the Planckian locus, K; the last stands for infinity.
const TICKS_K: [f64; 9] = [1500.0, 2000.0, 2500.0, 3000.0, 4000.0, 5000.0, 6500.0, 10_000.0, f64::INFINITY];
/// Half the length of such a line in CIE 1960 u, v.
const HALF_DUV: f64 = 0.011;
/// Coolest temperature of the drawn locus, K.
const COOLEST_K: f64 = 1000.0;
/// Hottest temperature that is computed; closer to infinity than a line is wide.
const HOTTEST_K: f64 = 1e9;

/// The spectral locus from 380 nm to 780 nm, every nm; the purple line closes it.
pub(super) fn spectral(diagram: Diagram, matching: &[Factor; 3]) -> Vec<[f64; 2]> {
    let (from_nm, to_nm) = LOCUS_RANGE_NM;
    spectral_locus(matching, from_nm, to_nm, 1.0).iter().map(|point| diagram.place(&point.chromaticity)).collect()
}

/// Planckian locus with its lines, daylight locus.
pub(super) fn draw(chart: &mut Chart, diagram: Diagram, matching: &[Factor; 3], em: f64) {
    let planckian = PlanckianLocus::new(matching);
    // Equal steps of reciprocal temperature are about equal steps along the locus.
    let count = 240;
    let points = (0..=count).filter_map(|i| {
        let per_k = 1.0 / COOLEST_K + (1.0 / HOTTEST_K - 1.0 / COOLEST_K) * f64::from(i) / f64::from(count);
        planckian.chromaticity(1.0 / per_k).map(|c| diagram.place(&c))
    });
    let mut curve = Curve::new("Planckian locus", points.collect(), Ink::Text);
    curve.width = 0.75;
    chart.curves.push(curve);

    let mut lines = Vec::new();
    for cct_k in TICKS_K {
        let Some([upper, lower]) = isotemperature(&planckian, cct_k.min(HOTTEST_K)).map(|ends| ends.map(|c| diagram.place(&c))) else {
            continue;
        };
        lines.extend([upper, lower, [f64::NAN; 2]]);
        let text = if cct_k.is_finite() { grouped(cct_k) } else { "∞".to_owned() };
        let along = unit([lower[0] - upper[0], lower[1] - upper[1]]);
        let half = [0.27 * text.chars().count() as f64, 0.36];
        let distance = 0.3 + along[0].abs() * half[0] + along[1].abs() * half[1];
        let shift_em = [along[0] * distance, along[1] * distance];
        chart.notes.push(Note { text, at: lower, shift_em, anchor: Anchor::Middle, ink: Ink::Text });
    }
    chart.curves.push(unnamed(lines, Ink::Text, 0.5));
    let _ = em;

    let daylight = (0..=60).filter_map(|i| {
        let per_k = 1.0 / 4000.0 + (1.0 / 25_000.0 - 1.0 / 4000.0) * f64::from(i) / 60.0;
        // Rounding must not lead out of the range of the series.
        let density = Density::daylight((1.0 / per_k).clamp(4000.0, 25_000.0)).ok()?;
        Tristimulus::of(&density, matching).chromaticity().map(|c| diagram.place(&c))
    });
    let mut curve = Curve::new("Daylight locus", daylight.collect(), Ink::Text).dashed(Dash::Dotted);
    curve.width = 0.75;
    chart.curves.push(curve);
}

/// Ends of a line through the Planckian point, normal to the locus in CIE 1960 u, v: above (towards green) and below it.
fn isotemperature(planckian: &PlanckianLocus, cct_k: f64) -> Option<[Chromaticity; 2]> {
    let uv = |t: f64| planckian.chromaticity(t).map(|c| c.uv_1960());
    let (u, v) = uv(cct_k)?;
    let (before, after) = (uv(1.0 / (1.0 / cct_k * (1.0 + 1e-4) + 1e-9))?, uv((1.0 / (1.0 / cct_k * (1.0 - 1e-4))).min(HOTTEST_K))?);
    let [du, dv] = unit([after.0 - before.0, after.1 - before.1]);
    // Towards higher temperature the locus runs to the left; green is at its right hand.
    let end = |side: f64| Chromaticity::from_uv_1960(u + side * HALF_DUV * dv, v - side * HALF_DUV * du);
    Some([end(1.0), end(-1.0)])
}

/// A direction of length one.
pub(super) fn unit(v: [f64; 2]) -> [f64; 2] {
    let length = v[0].hypot(v[1]);
    [v[0] / length, v[1] / length]
}

/// `10 000`, with a thin space.
fn grouped(value: f64) -> String {
    let digits = format!("{value:.0}");
    match digits.len() {
        5.. => format!("{}\u{2009}{}", &digits[..digits.len() - 3], &digits[digits.len() - 3..]),
        _ => digits,
    }
}
