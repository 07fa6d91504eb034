//! Colour-matching functions over wavelength: x̄ ȳ z̄ and r̄ ḡ b̄.

use crate::observer::Matching;

use super::PlotError;
use super::chart::{Axis, Chart, Curve, Dash, Ink};
use super::sample::{of_factor, strip, subscripted};

const FROM_NM: f64 = 380.0;
const TO_NM: f64 = 780.0;
/// How the sets are told apart: dashes, and width.
const LINES: [(Dash, f64); 4] = [(Dash::Solid, 1.0), (Dash::Dashed, 1.0), (Dash::Dotted, 1.0), (Dash::Solid, 0.5)];
const INKS: [Ink; 3] = [Ink::Palette(1), Ink::Palette(2), Ink::Palette(0)];

/// Sets of colour-matching functions. Errors if there is none, more than four, or sets with real and with imaginary primaries, whose units
/// differ.
pub fn chart(sets: &[Matching]) -> Result<Chart, PlotError> {
    if sets.is_empty() || sets.len() > LINES.len() {
        let what = format!("{} sets of colour-matching functions; 1 to {} can be told apart in one plot", sets.len(), LINES.len());
        return Err(PlotError::Request { what });
    }
    let real = sets[0].has_real_primaries();
    if let Some(other) = sets.iter().find(|set| set.has_real_primaries() != real) {
        let what = format!(
            "`{}` and `{}` in one plot: r̄ ḡ b̄ are in units of their own primaries, x̄ ȳ z̄ in those of Y; draw them apart",
            sets[0].title(),
            other.title()
        );
        return Err(PlotError::Request { what });
    }
    let mut curves = Vec::new();
    if real {
        curves.push(Curve::new("", vec![[FROM_NM, 0.0], [TO_NM, 0.0]], Ink::Muted).behind());
    }
    for (set, (dash, width)) in sets.iter().zip(LINES) {
        for ((function, name), ink) in set.functions().iter().zip(set.names()).zip(INKS) {
            let label = if sets.len() == 1 { subscripted(name) } else { distinct(*set, name) };
            curves.push(Curve { width, ..Curve::new(&label, of_factor(function, FROM_NM, TO_NM), ink).dashed(dash) });
        }
    }
    let values = || curves.iter().flat_map(|curve| &curve.points).map(|point| point[1]);
    let (least, largest) = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
    let bottom = if least < 0.0 { least - 0.06 * (largest - least) } else { 0.0 };
    let symbols = if real { "r̄, ḡ, b̄" } else { "x̄, ȳ, z̄" };
    let y = Axis::linear(&format!("Colour-matching functions {symbols}"), "1", bottom, 1.08 * largest);
    let x = Axis::linear("Wavelength λ", "nm", FROM_NM, TO_NM);
    let titles: Vec<&str> = sets.iter().map(|set| set.title()).collect();
    Ok(Chart { curves, strip: strip(FROM_NM, TO_NM), ..Chart::new("Colour-matching functions", &titles.join(" · "), x, y) })
}

/// Symbol and year, for a plot with several sets.
fn distinct(set: Matching, name: &str) -> String {
    let year = set.title().split_whitespace().find(|word| word.len() == 4 && word.chars().all(|c| c.is_ascii_digit())).unwrap_or_default();
    format!("{} {year}", subscripted(name))
}
