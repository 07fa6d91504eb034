//! Lines of a chromaticity diagram: spectral locus, purple line, Planckian and daylight locus, lines of equal correlated temperature.

use super::super::chart::{Chart, Curve, Dash, Ink};
use super::Diagram;
use crate::observer::colour::{Chromaticity, LOCUS_RANGE_NM, PlanckianLocus, Tristimulus, spectral_locus};
use crate::spectrum::{Density, Factor};

/// Temperatures with a line across the Planckian locus, K, those first whose numbers are written first; the last stands for infinity.
const TICKS_K: [f64; 9] = [2000.0, 10_000.0, 3000.0, f64::INFINITY, 5000.0, 1500.0, 4000.0, 6500.0, 2500.0];
/// Half the length of such a line in CIE 1960 u, v.
const HALF_DUV: f64 = 0.007;
/// Coolest temperature of the drawn locus, K.
const COOLEST_K: f64 = 1000.0;
/// Hottest temperature that is computed; closer to infinity than a line is wide.
const HOTTEST_K: f64 = 1e9;

/// Wavelengths between which the locus is drawn: up to 700 nm, where it stands still for the 2° observer and folds back for the others.
pub(super) const DRAWN_NM: (f64, f64) = (LOCUS_RANGE_NM.0, 700.0);

/// The spectral locus, every nm; the purple line closes it.
pub(super) fn spectral(diagram: Diagram, matching: &[Factor; 3]) -> Vec<[f64; 2]> {
    spectral_locus(matching, DRAWN_NM.0, DRAWN_NM.1, 1.0).iter().map(|point| diagram.place(&point.chromaticity)).collect()
}

/// Planckian locus with its lines, daylight locus. Returns temperature and upper and lower end of each line.
pub(super) fn draw(chart: &mut Chart, diagram: Diagram, matching: &[Factor; 3]) -> Crossings {
    let planckian = PlanckianLocus::new(matching);
    // Equal steps of reciprocal temperature are about equal steps along the locus.
    let count = 240;
    let points = (0..=count).filter_map(|i| {
        let per_k = 1.0 / COOLEST_K + (1.0 / HOTTEST_K - 1.0 / COOLEST_K) * f64::from(i) / f64::from(count);
        planckian.chromaticity(1.0 / per_k).map(|c| diagram.place(&c))
    });
    let points: Vec<[f64; 2]> = points.collect();
    chart.curves.push(line("Planckian locus", points, 0.75));

    let mut lines = Vec::new();
    let mut crossings = Vec::new();
    for cct_k in TICKS_K {
        let ends = isotemperature(&planckian, cct_k.min(HOTTEST_K)).map(|ends| ends.map(|c| diagram.place(&c)));
        let Some(ends) = ends else { continue };
        lines.extend([ends[0], ends[1], [f64::NAN; 2]]);
        crossings.push((if cct_k.is_finite() { grouped(cct_k) } else { "∞".to_owned() }, ends));
    }
    chart.curves.push(line("Equal correlated colour temperature", lines, 0.5));

    let daylight = (0..=60).filter_map(|i| {
        let per_k = 1.0 / 4000.0 + (1.0 / 25_000.0 - 1.0 / 4000.0) * f64::from(i) / 60.0;
        // Rounding must not lead out of the range of the series.
        let density = Density::daylight((1.0 / per_k).clamp(4000.0, 25_000.0)).ok()?;
        Tristimulus::of(&density, matching).chromaticity().map(|c| diagram.place(&c))
    });
    chart.curves.push(line("Daylight locus", daylight.collect(), 0.75).dashed(Dash::Dotted));
    crossings
}

/// Temperature and upper and lower end of each line across the Planckian locus.
pub(super) type Crossings = Vec<(String, [[f64; 2]; 2])>;

/// A line on the shade.
fn line(label: &str, points: Vec<[f64; 2]>, width: f64) -> Curve {
    Curve { width, ..Curve::new(label, points, Ink::OnShade).unwritten() }
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
